/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "footage.h"

#include "render.h"
#include "scenes.h"

#include <string.h>
#include <time.h>

static double now(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

const wo_footage_scene *wo_footage_scene_at(size_t index)
{
    return index < wo_scene_entry_count ? &wo_scene_entries[index].about : NULL;
}

static const wo_scene_entry *find_entry(const char *name)
{
    for (size_t i = 0; name && i < wo_scene_entry_count; i++)
        if (strcmp(wo_scene_entries[i].about.name, name) == 0)
            return &wo_scene_entries[i];
    return NULL;
}

const wo_footage_scene *wo_footage_scene_find(const char *name)
{
    const wo_scene_entry *const entry = find_entry(name);
    return entry ? &entry->about : NULL;
}

static wo_status unknown_scene(const char *name, wo_error *error)
{
    char known[200] = "";
    for (size_t i = 0; i < wo_scene_entry_count; i++) {
        const char *const each = wo_scene_entries[i].about.name;
        if (strlen(known) + strlen(each) + 3 > sizeof known)
            break;
        strcat(strcat(known, i ? ", " : ""), each);
    }
    return wo_fail(error, WO_ERR_NOT_FOUND, "there is no scene \"%s\"; there are %s",
                   name ? name : "", known);
}

/* What is 0 gets its default; one side of the picture follows from the other. */
static void fill_options(const wo_footage_scene *scene, wo_footage_options *o)
{
    const double shape = (double)scene->width / scene->height;
    if (o->width == 0 && o->height == 0) {
        o->width = scene->width;
        o->height = scene->height;
    } else if (o->width == 0) {
        o->width = (int)fmax(1, fmin(o->height * shape + 0.5, WO_MAX_SIDE));
    } else if (o->height == 0) {
        o->height = (int)fmax(1, fmin(o->width / shape + 0.5, WO_MAX_SIDE));
    }
    o->scene = scene->name;
    o->samples = o->samples ? o->samples : 32;
    if (o->layers == 1)
        o->peel = WO_FOOTAGE_HITS;
    o->focal_mm = o->focal_mm != 0 ? o->focal_mm : scene->focal_mm;
    o->f_stop = o->f_stop != 0 ? o->f_stop : scene->f_stop;
    o->focus_m = o->focus_m != 0 ? o->focus_m : scene->focus_m;
}

static wo_status check_range(const char *name, double value, double low, double high,
                             wo_error *error)
{
    if (!(value >= low && value <= high))
        return wo_fail(error, WO_ERR_RANGE, "%s is %g; it must be in %g..%g", name, value, low,
                       high);
    return WO_OK;
}

static wo_status check_options(wo_footage_options *o, wo_error *error)
{
    WO_TRY(check_range("width", o->width, 1, WO_MAX_SIDE, error));
    WO_TRY(check_range("height", o->height, 1, WO_MAX_SIDE, error));
    WO_TRY(check_range("overscan in pixels", o->overscan, 0,
                       (o->width < o->height ? o->width : o->height) / 10, error));
    WO_TRY(check_range("samples", o->samples, 1, WO_FOOTAGE_SAMPLES_MAX, error));
    WO_TRY(check_range("layers", o->layers, 0, WO_FOOTAGE_LAYERS_MAX, error));
    WO_TRY(check_range("peel", o->peel, WO_FOOTAGE_PATCHES, WO_FOOTAGE_HITS, error));
    WO_TRY(check_range("focal length in mm", o->focal_mm, 1, 2000, error));
    WO_TRY(check_range("f-number", o->f_stop, 0.01, 1e6, error));
    WO_TRY(check_range("rotation", o->rotation, -1e6, 1e6, error));
    if (!(fabs(o->focus_m) >= 0.01))
        return wo_fail(error, WO_ERR_RANGE,
                       "the focus distance is %g m; it must be 0.01 m or more, "
                       "or beyond infinity -0.01 m or less",
                       o->focus_m);
    if (o->blades != 0)
        WO_TRY(check_range("blades (if not 0)", o->blades, 3, 16, error));
    if (o->reference_spp != 0) {
        int batches, rays;
        WO_TRY(
            check_range("rays of the reference (if not 0)", o->reference_spp, 16, 1 << 20, error));
        wo_render_batches(o->reference_spp, &batches, &rays);
        o->reference_spp = batches * rays;
    }
    return WO_OK;
}

static wo_status make_images(const wo_context *context, wo_footage *f, wo_error *error)
{
    const int beyond = f->options.overscan;
    const wo_rect frame = {0, 0, f->options.width, f->options.height};
    const wo_rect area = wo_rect_grow(frame, beyond, beyond);
    f->frame = frame;
    WO_TRY(wo_render_image(context, area, 4, &f->colour, error));
    WO_TRY(wo_render_image(context, area, 1, &f->depth, error));
    WO_TRY(wo_render_image(context, area, 3, &f->normal, error));
    if (f->options.reference_spp > 0) {
        WO_TRY(wo_render_image(context, frame, 4, &f->reference, error));
        WO_TRY(wo_render_image(context, frame, 3, &f->reference_error, error));
    }
    return WO_OK;
}

static wo_status make_stages(const wo_context *context, wo_footage *f, const wo_scene_entry *entry,
                             wo_scene **scene, wo_error *error)
{
    const wo_footage_options *const o = &f->options;
    const double tangent = 0.5 * WO_FOOTAGE_SENSOR_MM / o->focal_mm;
    /* Rays to trace, roughly; the bar on the screen needs no more. */
    const double pixels = (double)o->width * o->height;
    const double light = 4e7, peel = pixels * o->samples * (1 + 2 * o->layers);
    const double reference = pixels * o->reference_spp, all = light + peel + reference;
    wo_progress progress;
    wo_progress_begin(&progress, context);
    wo_camera camera;
    wo_camera_make(o->width, o->height, o->focal_mm, WO_FOOTAGE_SENSOR_MM, o->f_stop, o->focus_m,
                   o->blades, o->rotation, &camera);
    WO_TRY(make_images(context, f, error));
    double start = now();
    WO_TRY(wo_scene_create(context, entry, o->seed, tangent, tangent * o->height / o->width, scene,
                           error));
    WO_TRY(wo_scene_light(context, *scene, &progress, light / all, error));
    f->seconds[0] = now() - start;
    start = now();
    WO_TRY(wo_render_through_pinhole(context, *scene, &camera, f, &progress, peel / all, error));
    f->seconds[1] = now() - start;
    if (o->reference_spp == 0)
        return WO_OK;
    start = now();
    WO_TRY(wo_render_through_lens(context, *scene, &camera, f, &progress, reference / all, error));
    f->seconds[2] = now() - start;
    return WO_OK;
}

wo_status wo_footage_make(const wo_context *context, const wo_footage_options *options,
                          wo_footage **footage, wo_error *error)
{
    *footage = NULL;
    const wo_scene_entry *const entry = find_entry(options->scene);
    if (!entry)
        return unknown_scene(options->scene, error);
    wo_footage_options filled = *options;
    fill_options(&entry->about, &filled);
    WO_TRY(check_options(&filled, error));
    wo_footage *made = wo_new(context, error, 1, sizeof *made);
    if (!made)
        return WO_ERR_NOMEM;
    made->scene = &entry->about;
    made->options = filled;
    wo_scene *scene = NULL;
    const wo_status status = make_stages(context, made, entry, &scene, error);
    wo_scene_destroy(context, &scene);
    if (status != WO_OK)
        wo_footage_destroy(context, &made);
    *footage = made;
    return status;
}

void wo_footage_destroy(const wo_context *context, wo_footage **footage)
{
    wo_footage *const old = *footage;
    if (!old)
        return;
    wo_delete(context, old->colour.data);
    wo_delete(context, old->depth.data);
    wo_delete(context, old->normal.data);
    for (int k = 0; k < WO_FOOTAGE_LAYERS_MAX; k++) {
        wo_delete(context, old->layer[k].data);
        wo_delete(context, old->layer_depth[k].data);
    }
    wo_delete(context, old->reference.data);
    wo_delete(context, old->reference_error.data);
    wo_delete(context, old);
    *footage = NULL;
}
