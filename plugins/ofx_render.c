/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "ofx_render.h"

#include "ofx_geometry.h"
#include "ofx_images.h"
#include "ofx_runner.h"

#include <stdio.h>
#include <string.h>

/* A render action on its way: what abort polls and progress of all workers share. */
typedef struct watch {
    const wo_ofx_suites *suites;
    OfxImageEffectHandle handle;
    atomic_bool stopped; /* stays set, though the host may change its mind */
    atomic_bool telling; /* one worker at a time talks to the progress bar */
    atomic_int permille; /* told so far */
    wo_ofx_instance
        *owner; /* of the progress bar; NULL = another render has it, or there is none */
} watch;

static bool aborted(void *user)
{
    watch *const w = user;
    if (!atomic_load_explicit(&w->stopped, memory_order_relaxed) && w->suites->effect->abort &&
        w->suites->effect->abort(w->handle))
        atomic_store_explicit(&w->stopped, true, memory_order_relaxed);
    return atomic_load_explicit(&w->stopped, memory_order_relaxed);
}

static bool has_progress(const wo_ofx_suites *s)
{
    const OfxProgressSuiteV1 *const one = s->progress;
    const OfxProgressSuiteV2 *const two = s->progress2;
    return (two && two->progressStart && two->progressUpdate && two->progressEnd) ||
           (one && one->progressStart && one->progressUpdate && one->progressEnd);
}

static void progress_start(watch *w, wo_ofx_instance *instance, const char *label)
{
    const wo_ofx_suites *const s = w->suites;
    if (!instance || !has_progress(s) || atomic_exchange(&instance->progressing, true))
        return;
    const OfxProgressSuiteV2 *const two = s->progress2;
    const OfxStatus status = two && two->progressStart && two->progressUpdate && two->progressEnd
                                 ? two->progressStart(w->handle, label, "WideOpenRender")
                                 : s->progress->progressStart(w->handle, label);
    if (status == kOfxStatOK)
        w->owner = instance;
    else
        atomic_store(&instance->progressing, false);
}

static void progress(void *user, double fraction)
{
    watch *const w = user;
    if (!w->owner || !(fraction >= 0 && fraction <= 1))
        return;
    const int permille = (int)(fraction * 1000);
    if (permille <= atomic_load(&w->permille) || atomic_exchange(&w->telling, true))
        return;
    if (permille > atomic_load(&w->permille)) {
        const OfxProgressSuiteV2 *const two = w->suites->progress2;
        atomic_store(&w->permille, permille);
        if ((two && two->progressUpdate
                 ? two->progressUpdate(w->handle, fraction)
                 : w->suites->progress->progressUpdate(w->handle, fraction)) == kOfxStatReplyNo)
            atomic_store(&w->stopped, true);
    }
    atomic_store(&w->telling, false);
}

static void progress_end(watch *w)
{
    if (!w->owner)
        return;
    const OfxProgressSuiteV2 *const two = w->suites->progress2;
    if (two && two->progressEnd)
        two->progressEnd(w->handle);
    else
        w->suites->progress->progressEnd(w->handle);
    atomic_store(&w->owner->progressing, false);
}

/* What the host wants to hear about this render. */
static int report_mode(const wo_ofx_action *action)
{
    const WideOpenReportSuiteV1 *const report = action->suites->report;
    return report && report->mode && report->publish ? report->mode(action->handle)
                                                     : kWideOpenReportNone;
}

static wo_status publish_plan(wo_ofx_action *action, const wo_plan *plan)
{
    const int length = action->effect->plan_print(plan, NULL, 0);
    if (length < 0)
        return wo_fail(&action->error, WO_ERR_INTERNAL, "the plan cannot be printed");
    char *const text = wo_new(&action->context, &action->error, (size_t)length + 1, 1);
    if (!text)
        return action->error.status;
    action->effect->plan_print(plan, text, (size_t)length + 1);
    action->suites->report->publish(action->handle, "plan", text);
    wo_delete(&action->context, text);
    return WO_OK;
}

static wo_status publish_report(wo_ofx_action *action, const wo_report *report)
{
    const int length = wo_report_json(report, NULL, 0);
    char *const text = wo_new(&action->context, &action->error, (size_t)length + 1, 1);
    if (!text)
        return action->error.status;
    wo_report_json(report, text, (size_t)length + 1);
    action->suites->report->publish(action->handle, "report", text);
    wo_delete(&action->context, text);
    return WO_OK;
}

static void publish_warnings(wo_ofx_action *action, const wo_report *report)
{
    for (int i = 0; i < report->warning_count; i++) {
        char text[64 + WO_WARNING_SIZE];
        snprintf(text, sizeof text, "%s: %s", report->warnings[i].key, report->warnings[i].text);
        action->suites->report->publish(action->handle, "warning", text);
    }
}

static void warn_of_lost(const wo_ofx_action *action, wo_report *report)
{
    const wo_ofx_lost *const lost = &action->lost;
    const int others = lost->count - WO_OFX_LOST_NAMED;
    char more[48] = "";
    if (others > 0)
        snprintf(more, sizeof more, " and %d more", others);
    if (lost->count > 0)
        wo_report_warn(report, "parameter-missing",
                       "this host gives no value of %s%s: the default is taken", lost->keys, more);
}

typedef struct job {
    wo_rect asked;  /* by the host */
    wo_rect window; /* the part of it where Source is */
    wo_ofx_image output;
    wo_ofx_image inputs[WO_CLIPS_MAX];
    wo_image views[WO_CLIPS_MAX];
    wo_rect opened[WO_CLIPS_MAX]; /* what was asked for of each input */
    wo_plan_args args;
    wo_report report;
} job;

static wo_status read_window(wo_ofx_action *action, wo_rect *window)
{
    const char *const field =
        wo_ofx_get_string(action->suites, action->in, kOfxImageEffectPropFieldToRender);
    int sides[4];

    if (field && strcmp(field, kOfxImageFieldNone) != 0 && strcmp(field, kOfxImageFieldBoth) != 0)
        return wo_fail(&action->error, WO_ERR_UNSUPPORTED,
                       "single fields of interlaced video cannot be rendered, only whole frames");
    if (!wo_ofx_read_ints(action->suites, action->in, kOfxImageEffectPropRenderWindow, 4, sides))
        return wo_fail(&action->error, WO_ERR_ARGUMENT, "the host names no window to render");
    *window = (wo_rect){sides[0], sides[1], sides[2], sides[3]};
    return WO_OK;
}

/* Connected is what brings pixels, whatever the host says; and what is needed of one clip may
   depend on which others are connected, so that a clip without pixels calls for another look. */
static wo_status open_inputs(wo_ofx_action *action, job *j)
{
    const wo_effect *const effect = action->effect;
    bool again;
    do {
        again = false;
        for (size_t i = 0; i < effect->clip_count; i++) {
            wo_rect needed = {0, 0, 0, 0};
            WO_TRY(effect->region(action->params, &action->geometry, j->window, i, &needed,
                                  &action->error));
            if (!action->geometry.connected[i] || wo_rect_contains(j->opened[i], needed))
                continue;
            wo_ofx_close(action, &j->inputs[i]);
            WO_TRY(wo_ofx_open_input(action, i, needed, &j->inputs[i]));
            j->opened[i] = needed;
            j->views[i] = j->inputs[i].view;
            j->args.alpha[i] = j->inputs[i].alpha;
            if (!j->views[i].data)
                action->geometry.connected[i] = false;
            again |= !j->views[i].data;
        }
    } while (again);
    return WO_OK;
}

static wo_status plan_and_render(wo_ofx_action *action, job *j, int mode)
{
    const wo_effect *const effect = action->effect;
    wo_ofx_threads threads = wo_ofx_threads_of(action->suites);
    watch w = {.suites = action->suites, .handle = action->handle};
    wo_context context = action->context;
    wo_plan *plan = NULL;

    atomic_init(&w.stopped, false);
    atomic_init(&w.telling, false);
    atomic_init(&w.permille, 0);
    context.runner = wo_ofx_runner(&threads);
    context.cpu = wo_cpu_detect(WO_CPU_AUTO);
    context.abort_user = &w;
    context.aborted = aborted;
    context.progress_user = &w;
    context.progress = progress;
    j->args.geometry = action->geometry;
    j->args.window = j->window;
    j->args.inputs = j->views;

    if (mode != kWideOpenReportExplain)
        progress_start(&w, action->instance, effect->label);
    wo_status status =
        effect->plan_create(&context, action->params, &j->args, &plan, &action->error);
    if (status == WO_OK && mode == kWideOpenReportExplain) {
        publish_warnings(action, &j->report);
        if (effect->plan_report)
            publish_warnings(action, effect->plan_report(plan));
        status = publish_plan(action, plan);
    } else if (status == WO_OK) {
        status = effect->render(plan, j->window, &j->output.view, &j->report, &action->error);
    }
    effect->plan_destroy(&plan);
    progress_end(&w);
    if (status == WO_OK && mode != kWideOpenReportExplain) {
        wo_ofx_finish_output(&j->output);
        if (mode == kWideOpenReportRender) {
            publish_warnings(action, &j->report);
            status = publish_report(action, &j->report);
        }
    }
    return status;
}

/* Opens what is needed of all clips; where Source turns out to lie elsewhere than the host has
   said, once more. */
static wo_status open_all(wo_ofx_action *action, job *j)
{
    bool connected[WO_CLIPS_MAX];
    memcpy(connected, action->geometry.connected, sizeof connected);
    if (!wo_rect_contains(wo_rect_grow(action->geometry.extent, 1, 1), j->asked))
        WO_TRY(wo_ofx_look_at_source(action));
    for (int round = 0; round < 2; round++) {
        j->window = wo_rect_intersect(j->asked, action->geometry.extent);
        if (wo_rect_empty(j->window))
            return WO_OK;
        WO_TRY(open_inputs(action, j));
        if (!j->views[0].data ||
            !wo_ofx_adopt_pixels(action, j->inputs[0].handle, j->inputs[0].pixels.bounds))
            break;
        for (size_t i = 0; i < action->effect->clip_count; i++) {
            wo_ofx_close(action, &j->inputs[i]);
            j->views[i] = j->inputs[i].view;
            j->opened[i] = (wo_rect){0, 0, 0, 0};
        }
        memcpy(action->geometry.connected, connected, sizeof connected);
    }
    return WO_OK;
}

static wo_status render(wo_ofx_action *action, job *j)
{
    const int mode = report_mode(action);
    const bool shown = mode != kWideOpenReportExplain;
    WO_TRY(wo_ofx_action_read(action));
    warn_of_lost(action, &j->report);
    WO_TRY(read_window(action, &j->asked));
    if (shown) {
        WO_TRY(wo_ofx_open_output(action, &j->asked, &j->output));
        if (wo_rect_empty(j->asked))
            return WO_OK;
        wo_ofx_adopt_extent(action, j->output.handle);
    }
    WO_TRY(open_all(action, j));
    /* Beside Source there is nothing, whatever the host wants to see there; without it the standard
       wants transparent black. */
    const bool nothing = wo_rect_empty(j->window) || !j->views[0].data;
    if (shown && (nothing || !wo_rect_contains(j->window, j->asked)))
        wo_ofx_clear_output(&j->output);
    if (!nothing)
        return plan_and_render(action, j, mode);
    if (shown)
        wo_ofx_finish_output(&j->output);
    return WO_OK;
}

OfxStatus wo_ofx_render(const wo_ofx_plugin *plugin, OfxImageEffectHandle handle,
                        OfxPropertySetHandle in)
{
    wo_ofx_action action;
    job j = {.window = {0, 0, 0, 0}};
    wo_ofx_action_begin(&action, plugin, handle, in, NULL);
    const wo_status status = render(&action, &j);
    for (size_t i = 0; i < action.effect->clip_count; i++)
        wo_ofx_close(&action, &j.inputs[i]);
    wo_ofx_close(&action, &j.output);
    const OfxStatus answer = wo_ofx_action_end(&action, status, true);
    if (status == WO_OK && report_mode(&action) == kWideOpenReportNone)
        wo_ofx_warn(&action, &j.report, j.window);
    return answer;
}
