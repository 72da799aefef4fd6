/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bench_run.h"

#include "bridge/picture.h"
#include "render_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Of the converged pictures: no other render has it, so that nothing is compared with a part of
   itself. */
#define CONVERGED_SEED 1000003.0

/* One shot on its way. */
typedef struct set {
    wo_bench_job *job;
    wo_bench_shot *shot;
    wo_inputs *inputs;
    wo_host_instance *instance;
    wo_image reference;
    wo_image converged[WO_BENCH_METHODS]; /* data NULL: there is none */
    double left[WO_BENCH_METHODS];        /* noise that these say they have; 0 = not known */
} set;

/* One render. */
typedef struct take {
    wo_image picture;
    double wall_seconds, cpu_seconds;
    char *report; /* JSON of the plugin, or NULL */
} take;

bool wo_bench_stopped(void *user)
{
    const wo_bench_job *const job = user;
    return wo_interrupted(NULL) || (job->deadline > 0 && wo_seconds() > job->deadline);
}

static wo_status set_number(set *s, const char *name, double value, wo_error *error)
{
    return wo_host_param_set(s->instance, name, &value, 1, error);
}

static wo_status set_method(set *s, int method, double seed, wo_error *error)
{
    WO_TRY(set_number(s, "method", s->job->choice[method], error));
    return set_number(s, "seed", seed, error);
}

/* What the setting does not say has its default again: nothing is left of the render before. */
static wo_status set_or_reset(set *s, const char *name, bool chosen, double value, wo_error *error)
{
    const wo_host_param_info *const param = wo_host_find_param(s->job->context, name);
    if (!param && !chosen)
        return WO_OK;
    return set_number(s, name, chosen ? value : param->initial[0], error);
}

static wo_status set_quality(set *s, const wo_bench_setting *setting, wo_error *error)
{
    if (wo_host_find_param(s->job->context, "sampling"))
        WO_TRY(wo_host_param_set_text(s->instance, "sampling",
                                      setting->adaptive ? "adaptive" : "fixed", error));
    WO_TRY(set_or_reset(s, "samples", !setting->adaptive, setting->value, error));
    return set_or_reset(s, "targetError", setting->adaptive, setting->value, error);
}

/* ------------------------------------------------------------------------------ one render */

static void keep_report(void *user, const char *kind, const char *text)
{
    take *const t = user;
    if (strcmp(kind, "report") == 0 && !t->report && wo_json_valid(text))
        t->report = strdup(text);
}

static void drop(take *t)
{
    wo_host_image_free(&t->picture);
    free(t->report);
    *t = (take){0};
}

/* A number of the report; NAN when it has none. */
static double reported(const take *t, const char *path)
{
    const char *begin;
    size_t length;
    char *end;
    if (!t->report || !wo_json_find(t->report, path, &begin, &length))
        return NAN;
    const double value = strtod(begin, &end);
    return end == begin + length ? value : NAN;
}

static double cpu_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static wo_status render(set *s, take *t, wo_error *error)
{
    wo_bench_job *const job = s->job;
    wo_host_render_args args = WO_HOST_RENDER_INIT;
    wo_host_render_result result = {0};
    args.time = args.first_frame = args.last_frame = args.frame_step = 1;
    args.window = s->reference.bounds;
    args.report = WO_HOST_REPORT_RENDER;
    args.report_user = t;
    args.publish = keep_report;
    *t = (take){0};
    WO_TRY(wo_host_purge(s->instance, error)); /* nothing is left of the render before */
    job->deadline = wo_seconds() + job->limit;
    const double start = cpu_seconds();
    const wo_status status = wo_host_render(s->instance, &args, &t->picture, &result, error);
    t->cpu_seconds = cpu_seconds() - start;
    t->wall_seconds = result.seconds;
    job->deadline = 0;
    wo_bar_move(&job->bar, (double)++job->rendered / job->to_render);
    if (status == WO_ABORTED && !wo_interrupted(NULL))
        return wo_fail(error, WO_ERR_RANGE, "stopped after %g s, see --limit", job->limit);
    if (status == WO_OK && !t->picture.data)
        return wo_fail(error, WO_ERR_INTERNAL, "the plugin made no picture");
    return status;
}

/* The root mean square of the difference of two pictures of one size. */
static wo_status difference(const wo_image *ref, const wo_image *out, int crop,
                            wo_picture_error *result, double *rmse, wo_error *error)
{
    WO_TRY(wo_picture_compare(ref, out, crop, result, error));
    if (result->nonfinite > 0)
        return wo_fail(error, WO_ERR_RANGE, "%lld samples are no finite numbers",
                       (long long)result->nonfinite);
    *rmse = pow(10, -result->psnr / 20);
    return WO_OK;
}

/* The sums of a point; wo_bench_point's means while runs go on are sums. */
static wo_status add_run(set *s, int method, wo_bench_point *p, const take *t, wo_error *error)
{
    wo_picture_error result, own;
    double rmse = NAN, sampling = NAN;
    WO_TRY(difference(&s->reference, &t->picture, s->job->bench->crop, &result, &rmse, error));
    if (s->converged[method].data) {
        WO_TRY(difference(&s->converged[method], &t->picture, 0, &own, &sampling, error));
        /* What the converged picture is wrong by itself is not this one's error. */
        sampling = sqrt(fmax(sampling * sampling - s->left[method] * s->left[method], 0));
    }
    const double estimate = reported(t, "estimated_error.all");
    const double own_seconds = reported(t, "seconds.total");
    p->wall_seconds = p->runs ? fmin(p->wall_seconds, t->wall_seconds) : t->wall_seconds;
    p->cpu_seconds = p->runs ? fmin(p->cpu_seconds, t->cpu_seconds) : t->cpu_seconds;
    p->own_seconds = p->runs ? fmin(p->own_seconds, own_seconds) : own_seconds;
    p->seconds = s->job->bench->cpu_clock ? p->cpu_seconds : p->wall_seconds;
    p->rays += reported(t, "rays");
    p->rmse += rmse * rmse;
    p->ssim += result.ssim;
    p->relmse += result.relmse;
    p->estimate += estimate * estimate;
    p->sampling += sampling * sampling;
    /* Exact, and known to be: as good as an estimate can be. */
    p->ratio[p->runs++] = estimate == 0 && sampling == 0 ? 1 : sampling / estimate;
    return WO_OK;
}

static void close_point(wo_bench_point *p)
{
    if (p->state != WO_BENCH_DONE)
        return;
    p->rays /= p->runs;
    p->ssim /= p->runs;
    p->relmse /= p->runs;
    p->rmse = sqrt(p->rmse / p->runs);
    p->estimate = sqrt(p->estimate / p->runs);
    p->sampling = sqrt(p->sampling / p->runs);
}

/* ----------------------------------------------------------------------------- all renders */

static void fail_point(wo_bench_point *p, wo_bench_state state, const char *why)
{
    *p = (wo_bench_point){.state = state};
    snprintf(p->why, sizeof p->why, "%s", why);
}

/* Without an estimate there is nothing to adapt to: such methods ignore the target. */
static void leave_out_adaptive(const wo_bench *bench, wo_bench_shot *shot, int method)
{
    for (int i = 0; i < bench->setting_count; i++)
        if (bench->setting[i].adaptive)
            fail_point(&shot->points[method * bench->setting_count + i], WO_BENCH_LEFT_OUT,
                       "the method estimates no error");
}

static wo_status run_point(set *s, int method, int setting, int run, wo_error *error)
{
    const wo_bench *const bench = s->job->bench;
    const wo_bench_setting *const chosen = &bench->setting[setting];
    wo_bench_point *const p = &s->shot->points[method * bench->setting_count + setting];
    if (p->state == WO_BENCH_FAILED || p->state == WO_BENCH_LEFT_OUT) {
        s->job->rendered++;
        return WO_OK;
    }
    take t = {0};
    wo_error why = {0};
    wo_status status = set_method(s, method, run, &why);
    if (status == WO_OK)
        status = set_quality(s, chosen, &why);
    if (status == WO_OK)
        status = render(s, &t, &why);
    if (status == WO_OK && chosen->adaptive && isnan(reported(&t, "estimated_error.all"))) {
        leave_out_adaptive(bench, s->shot, method);
        drop(&t);
        return WO_OK;
    }
    if (status == WO_OK)
        status = add_run(s, method, p, &t, &why);
    drop(&t);
    if (status == WO_OK)
        p->state = WO_BENCH_DONE;
    else if (wo_interrupted(NULL))
        return wo_fail(error, status, "%s", why.text);
    else
        fail_point(p, WO_BENCH_FAILED, why.text);
    return WO_OK;
}

/* Pictures with so many rays that what they differ from the others by is these others' noise. One
   that fails is not there. */
static wo_status render_converged(set *s, wo_error *error)
{
    const wo_bench *const bench = s->job->bench;
    wo_bench_setting many = {.value = bench->converged};
    for (int m = 0; m < bench->method_count && bench->converged > 0; m++) {
        take t = {0};
        wo_picture_error itself;
        wo_error why = {0};
        double none;
        wo_status status = set_method(s, m, CONVERGED_SEED, &why);
        if (status == WO_OK)
            status = set_quality(s, &many, &why);
        if (status == WO_OK)
            status = render(s, &t, &why);
        if (status == WO_OK) /* is every number of it finite? */
            status = difference(&s->reference, &t.picture, 0, &itself, &none, &why);
        if (status == WO_OK) {
            const double left = reported(&t, "estimated_error.all");
            s->left[m] = isnan(left) ? 0 : left;
            s->converged[m] = t.picture;
            t.picture = (wo_image){0};
        }
        drop(&t);
        if (status == WO_OK)
            continue;
        if (wo_interrupted(NULL))
            return wo_fail(error, status, "%s", why.text);
        wo_bar_end(&s->job->bar);
        wo_message("%s, %s: no converged picture of %s: %s", s->shot->scene,
                   wo_bench_given(s->shot), bench->method[m], why.text);
    }
    return WO_OK;
}

static wo_status render_all(set *s, wo_error *error)
{
    const wo_bench *const bench = s->job->bench;
    WO_TRY(render_converged(s, error));
    /* All methods in turn: a minute in which the machine has other work hits each of them. */
    for (int run = 0; run < bench->runs; run++)
        for (int i = 0; i < bench->setting_count; i++)
            for (int m = 0; m < bench->method_count; m++)
                WO_TRY(run_point(s, m, i, run, error));
    for (int i = 0; i < bench->method_count * bench->setting_count; i++)
        close_point(&s->shot->points[i]);
    return WO_OK;
}

/* ---------------------------------------------------------------------------- the instance */

static wo_status set_params(set *s, wo_error *error)
{
    const wo_args *const args = s->job->args;
    for (int i = 0; i < wo_args_count(args, "--set"); i++) {
        const char *const text = wo_args_value(args, "--set", i);
        const size_t length = strcspn(text, "=");
        char name[128];
        snprintf(name, sizeof name, "%.*s", (int)length, text);
        WO_TRY(wo_host_param_set_text(s->instance, name, text + length + 1, error));
    }
    return WO_OK;
}

static wo_status prepare(set *s, const char *folder, wo_error *error)
{
    wo_bench_job *const job = s->job;
    wo_bench_shot *const shot = s->shot;
    WO_TRY(wo_inputs_create(job->colour, NULL, &s->inputs, error));
    WO_TRY(wo_bench_add_clips(s->inputs, job->context, folder, shot->layers, &shot->given, error));
    if (shot->given == 0)
        return WO_OK;
    const wo_input *const source_clip = wo_inputs_find(s->inputs, "Source");
    const wo_project_pixels pixels = {.window = wo_input_header(source_clip)->display_window,
                                      .aspect = wo_part_aspect(wo_input_header(source_clip))};
    wo_inputs_fit(s->inputs, source_clip, &pixels);
    WO_TRY(wo_inputs_prepare(s->inputs, 1, error));
    WO_TRY(wo_bench_reference(job->colour, folder, &s->reference, &shot->noise, error));
    const wo_rect frame = s->reference.bounds;
    shot->width = wo_rect_width(frame);
    shot->height = wo_rect_height(frame);
    const wo_io_part *const header = wo_input_header(source_clip);
    const wo_rect format = header->display_window;
    wo_host_project project = WO_HOST_PROJECT_INIT;
    project.size[0] = wo_rect_width(format);
    project.size[1] = wo_rect_height(format);
    project.offset[0] = format.x1;
    project.offset[1] = format.y1;
    WO_TRY(wo_host_instance_create(job->host, job->plugin, job->context->name, &project,
                                   &s->instance, error));
    for (size_t i = 0; wo_inputs_at(s->inputs, i); i++) {
        wo_input *const input = wo_inputs_at(s->inputs, i);
        const wo_host_source source = wo_input_source(input, &project);
        WO_TRY(wo_host_set_clip(s->instance, wo_input_clip(input), &source, error));
    }
    WO_TRY(wo_bench_camera(s->instance, header, error));
    return set_params(s, error);
}

static void set_free(set *s)
{
    wo_host_instance_destroy(&s->instance);
    wo_inputs_destroy(&s->inputs);
    free(s->reference.data);
    for (int m = 0; m < WO_BENCH_METHODS; m++)
        wo_host_image_free(&s->converged[m]);
}

wo_status wo_bench_shoot(wo_bench_job *job, const char *folder, wo_bench_shot *shot,
                         wo_error *error)
{
    const wo_bench *const bench = job->bench;
    set s = {.job = job, .shot = shot};
    wo_error why = {0};
    shot->noise = NAN;
    shot->points =
        calloc((size_t)bench->method_count * (size_t)bench->setting_count, sizeof *shot->points);
    if (!shot->points)
        return wo_fail(error, WO_ERR_NOMEM, "out of memory for the results");
    wo_status status = prepare(&s, folder, &why);
    if (status == WO_OK && shot->given == 0) {
        shot->state = WO_BENCH_LEFT_OUT;
        snprintf(shot->why, sizeof shot->why, "%s has no layers", folder);
    } else if (status == WO_OK) {
        status = render_all(&s, &why);
        shot->state = WO_BENCH_DONE;
    }
    set_free(&s);
    if (status == WO_OK)
        return WO_OK;
    shot->state = WO_BENCH_FAILED;
    snprintf(shot->why, sizeof shot->why, "%s", why.text);
    return wo_interrupted(NULL) ? wo_fail(error, status, "%s", why.text) : WO_OK;
}
