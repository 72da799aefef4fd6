/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Margin round a tile's own buffer in strict hosts: what is written there is found out. */
#define MARGIN_X    3
#define MARGIN_Y    2
#define WORKERS_MAX 256

typedef struct render {
    wo_host_instance *instance;
    const wo_host_render_args *args;
    wo_host_render_result *result;
    double scale[2];
    double aspect;
    wo_rect region;           /* region of definition in pixels */
    wo_host_region canonical; /* the same */
    wo_rect asked;            /* what the caller wants */
    wo_rect window;           /* what the plugin renders: the part of it that has pixels, or all */
    wo_image view;            /* the caller's memory */
    wo_tile *tiles;
    size_t tile_count;
    wo_host_region *needed; /* [tile_count][port_count] */
    pthread_mutex_t lock;   /* next, failed, failure, seconds */
    size_t next;
    size_t failed; /* tile; tile_count = none */
    wo_status status;
    wo_error failure;
} render;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void wo_host_image_free(wo_image *image)
{
    free(image->data);
    *image = (wo_image){0};
}

void wo_host_abort(wo_host_instance *instance)
{
    if (atomic_load(&instance->rendering))
        atomic_store(&instance->stop, true);
}

/* ------------------------------------------------------------------------------------ arguments */

static void sequence_arguments(const render *r, wo_props *in, bool render_action)
{
    const wo_host_render_args *a = r->args;
    static const char *const gpus[] = {
        kOfxImageEffectPropOpenGLEnabled, kOfxImageEffectPropCudaEnabled,
        kOfxImageEffectPropMetalEnabled, kOfxImageEffectPropOpenCLEnabled};
    wo_props_add_one(in, kOfxImageEffectPropSequentialRenderStatus, WO_PROP_INT, 1, false);
    wo_props_add_one(in, kOfxImageEffectPropInteractiveRenderStatus, WO_PROP_INT, 1, false);
    wo_props_set_int(in, kOfxImageEffectPropInteractiveRenderStatus, 0, a->interactive);
    for (size_t i = 0; i < WO_COUNT(gpus); i++)
        wo_props_add_one(in, gpus[i], WO_PROP_INT, 1, false);
    if (render_action)
        return;
    const bool alone = a->first_frame == 0 && a->last_frame == 0 && a->frame_step == 0;
    wo_props_add_one(in, kOfxImageEffectPropFrameRange, WO_PROP_DOUBLE, 2, false);
    wo_props_add_one(in, kOfxImageEffectPropFrameStep, WO_PROP_DOUBLE, 1, false);
    wo_props_add_one(in, kOfxPropIsInteractive, WO_PROP_INT, 1, false);
    wo_props_set_double(in, kOfxImageEffectPropFrameRange, 0, alone ? a->time : a->first_frame);
    wo_props_set_double(in, kOfxImageEffectPropFrameRange, 1, alone ? a->time : a->last_frame);
    wo_props_set_double(in, kOfxImageEffectPropFrameStep, 0, alone ? 1 : a->frame_step);
    wo_props_set_int(in, kOfxPropIsInteractive, 0, r->instance->project.interactive);
}

static void say_false(wo_props *in, const char *name)
{
    wo_props_add_one(in, name, WO_PROP_STRING, 1, false);
    wo_props_set_text(in, name, 0, "false");
}

static wo_status bracket(const render *r, wo_action action, wo_error *error)
{
    wo_props in, out;
    wo_arguments(&in, &out, r->instance, r->args->time, r->scale);
    sequence_arguments(r, &in, false);
    if (action == WO_ACTION_BEGIN_RENDER)
        say_false(&in, kOfxImageEffectPropNoSpatialAwareness);
    wo_frame frame = {.action = action, .time = r->args->time, .scale = {r->scale[0], r->scale[1]}};
    const wo_status status = wo_act_on(r->instance, &frame, &in, NULL, NULL, error);
    wo_props_clear(&in);
    wo_props_clear(&out);
    return status;
}

/* ---------------------------------------------------------------------------------------- tiles */

static wo_status make_output(const render *r, wo_tile *tile, wo_error *error)
{
    wo_host *host = r->instance->object.host;
    const wo_port *output = wo_object_port(&r->instance->object, kOfxImageEffectOutputClipName);
    const bool whole = wo_rect_equal(wo_rect_intersect(r->asked, r->region), r->window);
    if (!host->config.strict && host->config.layout == 0 && whole) {
        wo_image *view = &tile->output.view;
        *view = r->view;
        view->bounds = r->window;
        view->data = wo_image_at(&r->view, r->window.x1, r->window.y1);
        tile->direct = true;
        return WO_OK;
    }
    wo_rect bounds = tile->window;
    if (host->config.strict)
        bounds = wo_rect_intersect(wo_rect_grow(bounds, MARGIN_X, MARGIN_Y), r->region);
    if (!wo_buffer_make(host, &tile->output, bounds, output->components))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %d x %d pixels of the Output",
                       wo_rect_width(bounds), wo_rect_height(bounds));
    if (host->config.strict)
        wo_buffer_blank(&tile->output);
    return WO_OK;
}

static void check_output(const render *r, const wo_frame *frame, const wo_tile *tile, bool rendered)
{
    if (!wo_buffer_intact(&tile->output))
        wo_violate_in(frame, "bytes outside of the output image were written");
    if (r->instance->object.host->config.strict && rendered)
        wo_buffer_check(frame, &tile->output, tile->window);
}

static wo_status render_tile(const render *r, wo_tile *tile, double *seconds, wo_error *error)
{
    wo_host_instance *instance = r->instance;
    wo_props in, out;
    WO_TRY(make_output(r, tile, error));
    wo_arguments(&in, &out, instance, r->args->time, r->scale);
    sequence_arguments(r, &in, true);
    wo_props_add_one(&in, kOfxImageEffectPropFieldToRender, WO_PROP_STRING, 1, false);
    wo_props_set_text(&in, kOfxImageEffectPropFieldToRender, 0, kOfxImageFieldNone);
    wo_props_add_one(&in, kOfxImageEffectPropRenderWindow, WO_PROP_INT, 4, false);
    wo_props_set_int(&in, kOfxImageEffectPropRenderWindow, 0, tile->window.x1);
    wo_props_set_int(&in, kOfxImageEffectPropRenderWindow, 1, tile->window.y1);
    wo_props_set_int(&in, kOfxImageEffectPropRenderWindow, 2, tile->window.x2);
    wo_props_set_int(&in, kOfxImageEffectPropRenderWindow, 3, tile->window.y2);
    wo_props_add_one(&in, kOfxImageEffectPropRenderQualityDraft, WO_PROP_INT, 1, false);
    wo_props_set_int(&in, kOfxImageEffectPropRenderQualityDraft, 0, r->args->draft);
    say_false(&in, kOfxImageEffectPropNoSpatialAwareness);
    wo_frame frame = {.action = WO_ACTION_RENDER,
                      .time = r->args->time,
                      .scale = {r->scale[0], r->scale[1]},
                      .tile = tile};
    const double start = now();
    wo_status status = wo_act_on(instance, &frame, &in, NULL, NULL, error);
    *seconds = now() - start;
    wo_props_clear(&in);
    wo_props_clear(&out);
    const bool stopped = atomic_load(&instance->stop);
    const bool rendered = status == WO_OK && !stopped && r->args->report != WO_HOST_REPORT_EXPLAIN;
    if (!tile->direct) {
        check_output(r, &frame, tile, rendered);
        if (rendered)
            wo_copy_window(&tile->output.view, &r->view, wo_rect_intersect(tile->window, r->asked));
        wo_buffer_free(&tile->output);
    }
    return stopped ? WO_ABORTED : status;
}

/* Renders tiles until there are none left, one has failed, or somebody wants to stop. */
static void *work(void *user)
{
    render *r = user;
    for (;;) {
        double seconds = 0;
        wo_error error = {0};
        const bool stop = wo_host_wants_stop(r->instance);
        pthread_mutex_lock(&r->lock);
        const size_t i = r->next;
        const bool more = !stop && i < r->tile_count && r->failed == r->tile_count;
        r->next += more;
        pthread_mutex_unlock(&r->lock);
        if (!more)
            return NULL;
        const wo_status status = render_tile(r, &r->tiles[i], &seconds, &error);
        pthread_mutex_lock(&r->lock);
        r->result->tiles++;
        r->result->seconds += seconds;
        if (status != WO_OK && i < r->failed) {
            r->failed = i;
            r->status = status;
            r->failure = error;
        }
        pthread_mutex_unlock(&r->lock);
    }
}

static void work_together(render *r)
{
    const wo_host_plugin *plugin = &r->instance->object.entry->info;
    pthread_t threads[WORKERS_MAX];
    unsigned wanted = r->args->parallel_tiles, made = 0;
    if (plugin->safety != WO_HOST_FULLY_SAFE ||
        !wo_props_int(&r->instance->object.entry->descriptor->props,
                      kOfxImageEffectPluginPropHostFrameThreading, 0, 1))
        wanted = 1;
    if (wanted > r->tile_count)
        wanted = (unsigned)r->tile_count;
    while (made + 1 < wanted && made < WORKERS_MAX &&
           pthread_create(&threads[made], NULL, work, r) == 0)
        made++;
    (void)work(r);
    for (unsigned i = 0; i < made; i++)
        pthread_join(threads[i], NULL);
}

static wo_status cut_tiles(render *r, wo_error *error)
{
    const bool tiles =
        wo_props_int(&r->instance->object.props, kOfxImageEffectPropSupportsTiles, 0, 1);
    const size_t ports = r->instance->object.port_count;
    const int32_t width = wo_rect_width(r->window), height = wo_rect_height(r->window);
    const int32_t tw = r->args->tile_width, th = r->args->tile_height;
    const int32_t w = tiles && tw > 0 && tw < width ? tw : width;
    const int32_t h = tiles && th > 0 && th < height ? th : height;
    const size_t columns = (size_t)((width + w - 1) / w), rows = (size_t)((height + h - 1) / h);
    r->tile_count = columns * rows;
    r->tiles = calloc(r->tile_count, sizeof *r->tiles);
    r->needed = calloc(r->tile_count * ports, sizeof *r->needed);
    if (!r->tiles || !r->needed)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %zu tiles", r->tile_count);
    for (size_t i = 0; i < r->tile_count; i++) {
        const int32_t x = r->window.x1 + (int32_t)(i % columns) * w;
        const int32_t y = r->window.y1 + (int32_t)(i / columns) * h;
        wo_tile *tile = &r->tiles[i];
        tile->window = wo_rect_intersect((wo_rect){x, y, x + w, y + h}, r->window);
        tile->needed = &r->needed[i * ports];
        tile->region = r->region;
        tile->canonical = r->canonical;
        WO_TRY(
            wo_host_get_needed(r->instance, r->args->time, r->scale[0], r->scale[1],
                               wo_pixels_region(tile->window, r->scale[0], r->scale[1], r->aspect),
                               tile->needed, ports, error));
    }
    return WO_OK;
}

/* ---------------------------------------------------------------------------------------- whole */

/* Copies the clip the plugin has named instead of rendering. */
static wo_status copy_clip(render *r, wo_port *port, double time, wo_error *error)
{
    wo_host_region defined;
    wo_buffer buffer;
    wo_error local = {0};
    wo_status status = wo_port_region(port, time, &defined, &local);
    if (status == WO_ERR_NOT_FOUND) /* no picture: black */
        return WO_OK;
    if (status != WO_OK)
        return wo_fail(error, status, "%s", local.text);
    if (wo_region_infinite(defined))
        defined = wo_project_region(r->instance);
    const wo_rect window = wo_rect_intersect(
        r->asked, wo_region_pixels(defined, r->scale[0], r->scale[1], port->source.pixel_aspect));
    if (wo_rect_empty(window))
        return WO_OK;
    if (!wo_buffer_make(r->instance->object.host, &buffer, window, r->view.components))
        return wo_fail(error, WO_ERR_NOMEM, "no memory for pixels of %.60s", port->name);
    status = wo_fetch_pixels(port, time, r->scale, &buffer.view, &local);
    if (status == WO_OK)
        wo_copy_window(&buffer.view, &r->view, window);
    wo_buffer_free(&buffer);
    if (status == WO_OK || status == WO_ERR_NOT_FOUND)
        return WO_OK;
    return wo_fail(error, status, "%s", local.text);
}

/* Plugins that do not take images of different sizes get only those of the project's. */
static wo_status check_resolution(const render *r, wo_error *error)
{
    const wo_host_region p = wo_project_region(r->instance);
    if (r->instance->object.entry->info.multi_resolution)
        return WO_OK;
    for (size_t i = 0; i < r->instance->object.port_count; i++) {
        wo_port *port = r->instance->object.ports[i];
        wo_host_region d;
        if (!port->connected)
            continue;
        wo_error local = {0};
        const wo_status status = wo_port_region(port, r->args->time, &d, &local);
        if (status == WO_ERR_NOT_FOUND)
            continue;
        if (status != WO_OK)
            return wo_fail(error, status, "%s", local.text);
        if (d.x1 != p.x1 || d.y1 != p.y1 || d.x2 != p.x2 || d.y2 != p.y2)
            return wo_fail(error, WO_ERR_UNSUPPORTED,
                           "%.80s wants clips of the project's size; %.60s is not",
                           r->instance->object.entry->info.identifier, port->name);
    }
    return WO_OK;
}

static wo_status prepare_view(render *r, wo_image *output, wo_error *error)
{
    const wo_port *port = wo_object_port(&r->instance->object, kOfxImageEffectOutputClipName);
    if (output->data) {
        WO_TRY(wo_image_validate(output, "output", error));
        if (output->components != port->components || !wo_rect_contains(output->bounds, r->asked))
            return wo_fail(error, WO_ERR_ARGUMENT,
                           "the output has %d components; the plugin makes %d, of %d,%d to %d,%d",
                           output->components, port->components, r->asked.x1, r->asked.y1,
                           r->asked.x2, r->asked.y2);
        r->view = *output;
        for (int32_t y = r->asked.y1; y < r->asked.y2; y++)
            memset(wo_image_at(output, r->asked.x1, y), 0,
                   (size_t)wo_rect_width(r->asked) * (size_t)output->components * sizeof(float));
        return WO_OK;
    }
    const int64_t width = (int64_t)r->asked.x2 - r->asked.x1;
    const int64_t height = (int64_t)r->asked.y2 - r->asked.y1;
    if (width > WO_MAX_SIDE || height > WO_MAX_SIDE)
        return wo_fail(error, WO_ERR_RANGE,
                       "%lld x %lld pixels are too many; %d is the longest side", (long long)width,
                       (long long)height, WO_MAX_SIDE);
    const size_t row = (size_t)width * (size_t)port->components * sizeof(float);
    r->view = (wo_image){.data = calloc((size_t)height, row),
                         .bounds = r->asked,
                         .row_bytes = (ptrdiff_t)row,
                         .components = port->components};
    if (!r->view.data)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %lld x %lld pixels", (long long)width,
                       (long long)height);
    return WO_OK;
}

static wo_status render_sequence(render *r, wo_error *error)
{
    wo_host_instance *instance = r->instance;
    const bool unsafe = instance->object.entry->info.safety == WO_HOST_UNSAFE;
    if (unsafe && wo_frame_now()) /* it may be this plugin that waits for us */
        return wo_fail(error, WO_ERR_UNSUPPORTED,
                       "%.80s is not thread-safe and cannot render inside of another render",
                       instance->object.entry->info.identifier);
    if (unsafe)
        pthread_mutex_lock(wo_entry_render_lock(instance->object.entry));
    wo_status status = bracket(r, WO_ACTION_BEGIN_RENDER, error);
    if (status == WO_OK) {
        work_together(r);
        if (r->failed < r->tile_count) {
            status = r->status;
            if (error)
                *error = r->failure;
        }
        const wo_status ended = bracket(r, WO_ACTION_END_RENDER, status == WO_OK ? error : NULL);
        if (status == WO_OK)
            status = ended;
    }
    if (unsafe)
        pthread_mutex_unlock(wo_entry_render_lock(instance->object.entry));
    pthread_mutex_lock(&instance->lock);
    const wo_error source = instance->source_error;
    r->result->input_pixels = instance->input_pixels;
    pthread_mutex_unlock(&instance->lock);
    if (atomic_load(&instance->stop))
        return wo_fail(error, WO_ABORTED, "the render was stopped");
    if (source.status != WO_OK) {
        if (error)
            *error = source;
        return source.status;
    }
    return status;
}

static wo_status render_all(render *r, wo_image *output, wo_error *error)
{
    wo_host_instance *instance = r->instance;
    const wo_host_render_args *a = r->args;
    wo_port *identity;
    double identity_time;
    double(*ranges)[2];
    WO_TRY(wo_prepare(instance, error));
    WO_TRY(check_resolution(r, error));
    WO_TRY(wo_host_get_region(instance, a->time, r->scale[0], r->scale[1], &r->canonical,
                              &r->region, error));
    r->aspect =
        wo_props_double(&wo_object_port(&instance->object, kOfxImageEffectOutputClipName)->props,
                        kOfxImagePropPixelAspectRatio, 0, 1);
    r->asked = wo_rect_empty(a->window) ? r->region : a->window;
    r->result->region = r->canonical;
    r->result->window = r->asked;
    if (wo_rect_empty(r->asked))
        return wo_fail(error, WO_ERR_RANGE, "there is nothing to render: the region is empty");
    WO_TRY(prepare_view(r, output, error));
    r->window = wo_rect_intersect(r->asked, r->region);
    if (wo_rect_empty(r->window)) /* nothing there: black */
        return WO_OK;
    if (!wo_props_int(&instance->object.props, kOfxImageEffectPropSupportsTiles, 0, 1))
        r->window = r->region;
    WO_TRY(
        wo_ask_identity(instance, a->time, r->scale, r->window, &identity, &identity_time, error));
    if (identity && identity->connected) {
        r->result->identity = true;
        r->result->identity_clip = wo_host_find_clip(instance->context, identity->name)->name;
        r->result->identity_time = identity_time;
        return copy_clip(r, identity, identity_time, error);
    }
    if (instance->object.entry->info.temporal) {
        ranges = calloc(instance->object.port_count, sizeof *ranges);
        if (!ranges)
            return wo_fail(error, WO_ERR_NOMEM, "no memory for ranges of frames");
        const wo_status status = wo_host_get_frames_needed(instance, a->time, ranges,
                                                           instance->object.port_count, error);
        free(ranges);
        WO_TRY(status);
    }
    WO_TRY(cut_tiles(r, error));
    r->failed = r->tile_count;
    return render_sequence(r, error);
}

wo_status wo_host_render(wo_host_instance *instance, const wo_host_render_args *args,
                         wo_image *output, wo_host_render_result *result, wo_error *error)
{
    wo_host_render_result unwanted;
    render r = {.instance = instance,
                .args = args,
                .result = result ? result : &unwanted,
                .scale = {args->scale_x, args->scale_y}};
    *r.result = (wo_host_render_result){0};
    if (args->tile_width < 0 || args->tile_height < 0 ||
        (unsigned)args->report > WO_HOST_REPORT_EXPLAIN)
        return wo_fail(error, WO_ERR_ARGUMENT, "tiles of %d x %d, report %d", args->tile_width,
                       args->tile_height, (int)args->report);
    if (pthread_mutex_init(&r.lock, NULL) != 0)
        return wo_fail(error, WO_ERR_NOMEM, "no mutex for a render");
    pthread_mutex_lock(&instance->lock);
    instance->source_error = (wo_error){0};
    instance->input_pixels = 0;
    pthread_mutex_unlock(&instance->lock);
    pthread_mutex_lock(&instance->publish_lock);
    instance->publish = args->publish;
    instance->report_user = args->report_user;
    pthread_mutex_unlock(&instance->publish_lock);
    atomic_store(&instance->report, (int)args->report);
    atomic_store(&instance->stop, false);
    atomic_store(&instance->rendering, true);
    const double time = instance->time;
    instance->time = args->time;

    const bool given = output->data != NULL;
    const wo_status status = render_all(&r, output, error);
    if (!given && status == WO_OK)
        *output = r.view;
    else if (!given)
        free(r.view.data);

    instance->time = time;
    atomic_store(&instance->rendering, false);
    atomic_store(&instance->report, WO_HOST_REPORT_NONE);
    free(r.tiles);
    free(r.needed);
    pthread_mutex_destroy(&r.lock);
    return status;
}
