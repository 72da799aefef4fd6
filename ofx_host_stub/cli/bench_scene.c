/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bench_scene.h"

#include "picture_file.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* folder/name */
static wo_status join(char *path, size_t size, const char *folder, const char *name,
                      wo_error *error)
{
    const int used = snprintf(path, size, "%s/%s", folder, name);
    if (used < 0 || (size_t)used >= size)
        return wo_fail(error, WO_ERR_RANGE, "the path of the folder is too long");
    return WO_OK;
}

static bool is_file(const char *folder, const char *name)
{
    char path[PATH_MAX];
    struct stat info;
    return join(path, sizeof path, folder, name, NULL) == WO_OK && stat(path, &info) == 0 &&
           S_ISREG(info.st_mode);
}

static wo_status make_folder(const char *path, wo_error *error)
{
    if (mkdir(path, 0777) == 0 || errno == EEXIST)
        return WO_OK;
    return wo_fail(error, WO_ERR_IO, "cannot make %s: %s", path, strerror(errno));
}

/* --------------------------------------------------------------------------------- making */

enum { FEW_RAYS = 1024, MORE_RAYS = 4096 };
#define QUIET_DB 50.0

static wo_status make_footage(const wo_context *context, wo_footage_options *options,
                              const char *folder, wo_error *error)
{
    wo_footage *set = NULL;
    const bool choose = options->reference_spp == 0;
    if (choose)
        options->reference_spp = FEW_RAYS;
    WO_TRY(wo_footage_make(context, options, &set, error));
    if (choose && set->noise_psnr < QUIET_DB) {
        wo_footage_destroy(context, &set);
        options->reference_spp = MORE_RAYS;
        WO_TRY(wo_footage_make(context, options, &set, error));
    }
    const wo_status status = wo_footage_write(set, folder, error);
    wo_footage_destroy(context, &set);
    return status;
}

wo_status wo_bench_footage(const wo_context *context, wo_footage_options options, const char *root,
                           bool fresh, char *folder, size_t size, wo_error *error)
{
    char name[160], rays[16] = "auto", last[PATH_MAX];
    if (options.reference_spp > 0)
        snprintf(rays, sizeof rays, "%d", options.reference_spp);
    snprintf(name, sizeof name, "%s-%dx%d+%d-%d-%s", options.scene, options.width, options.height,
             options.overscan, (int)options.seed, rays);
    WO_TRY(join(folder, size, root, name, error));
    /* The last file that is written: with it the set is complete. */
    if (!fresh && is_file(folder, WO_FOOTAGE_REFERENCE_ERROR))
        return WO_OK;
    WO_TRY(make_folder(root, error));
    WO_TRY(make_folder(folder, error));
    WO_TRY(join(last, sizeof last, folder, WO_FOOTAGE_REFERENCE_ERROR, error));
    remove(last); /* an old set is none while a new one takes its place */
    return make_footage(context, &options, folder, error);
}

/* -------------------------------------------------------------------------------- reading */

static wo_status add(wo_inputs *inputs, const wo_host_context_info *context, const char *clip,
                     const char *folder, const char *spec, wo_error *error)
{
    char path[PATH_MAX];
    const wo_host_clip_info *const info = wo_host_find_clip(context, clip);
    if (!info)
        return wo_fail(error, WO_ERR_NOT_FOUND, "the plugin has no clip %s", clip);
    WO_TRY(join(path, sizeof path, folder, spec, error));
    return wo_inputs_add(inputs, info, path, 1, error);
}

/* Layers of a folder; parts says whether they are those of layers.exr. */
static wo_status count_layers(const char *folder, bool *parts, int *count, wo_error *error)
{
    char name[32], path[PATH_MAX];
    *count = 0;
    *parts = is_file(folder, WO_FOOTAGE_LAYERS);
    if (!*parts) {
        while (snprintf(name, sizeof name, "layer%d.exr", *count + 1) > 0 && is_file(folder, name))
            (*count)++;
        return WO_OK;
    }
    wo_io_file *file = NULL;
    WO_TRY(join(path, sizeof path, folder, WO_FOOTAGE_LAYERS, error));
    WO_TRY(wo_io_read(path, true, &file, error));
    for (size_t i = 0; i < file->part_count; i++) {
        snprintf(name, sizeof name, "layer%d", *count + 1);
        if (strcmp(file->parts[i].name, name) == 0)
            (*count)++;
    }
    wo_io_file_destroy(&file);
    return WO_OK;
}

static wo_status add_layers(wo_inputs *inputs, const wo_host_context_info *context,
                            const char *folder, int *given, wo_error *error)
{
    bool parts;
    int count;
    *given = 0;
    WO_TRY(count_layers(folder, &parts, &count, error));
    for (int k = 1; k <= count; k++) {
        char colour[32] = "Source", depth[32] = "Depth", spec[64];
        if (k > 1) {
            snprintf(colour, sizeof colour, "Layer%d", k);
            snprintf(depth, sizeof depth, "Depth%d", k);
        }
        if (!wo_host_find_clip(context, colour) || !wo_host_find_clip(context, depth))
            break;
        snprintf(spec, sizeof spec, parts ? WO_FOOTAGE_LAYERS ":layer%d" : "layer%d.exr", k);
        WO_TRY(add(inputs, context, colour, folder, spec, error));
        snprintf(spec, sizeof spec,
                 parts ? WO_FOOTAGE_LAYERS ":layer%d_depth" : "layer%d_depth.exr", k);
        WO_TRY(add(inputs, context, depth, folder, spec, error));
        *given = k;
    }
    return WO_OK;
}

wo_status wo_bench_add_clips(wo_inputs *inputs, const wo_host_context_info *context,
                             const char *folder, bool layers, int *given, wo_error *error)
{
    if (layers)
        return add_layers(inputs, context, folder, given, error);
    *given = 1;
    WO_TRY(add(inputs, context, "Source", folder, WO_FOOTAGE_PINHOLE, error));
    return add(inputs, context, "Depth", folder,
               is_file(folder, "depth.exr") ? "depth.exr" : WO_FOOTAGE_PINHOLE ":depth", error);
}

wo_status wo_bench_reference(const wo_colour *colour, const char *folder, wo_image *image,
                             double *noise, wo_error *error)
{
    char path[PATH_MAX];
    wo_io_file *file = NULL;
    *image = (wo_image){0};
    *noise = NAN;
    WO_TRY(join(path, sizeof path, folder,
                is_file(folder, "truth.exr") ? "truth.exr" : WO_FOOTAGE_REFERENCE, error));
    WO_TRY(wo_io_read(path, true, &file, error));
    const wo_io_attribute *const db = wo_io_part_find(&file->parts[0], "wideopen:noisePSNR");
    if (db && db->type != WO_IO_TEXT)
        *noise = pow(10, -db->number / 20);
    wo_io_file_destroy(&file);
    return wo_picture_load(colour, NULL, path, image, error);
}

wo_status wo_bench_camera(wo_host_instance *instance, const wo_io_part *header, wo_error *error)
{
    static const char *const names[] = {"focalLength",   "sensorWidth", "fStop",
                                        "focusDistance", "blades",      "rotation"};
    const wo_host_context_info *const context = wo_host_instance_context(instance);
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        char key[64];
        snprintf(key, sizeof key, "wideopen:%s", names[i]);
        const wo_io_attribute *const fact = wo_io_part_find(header, key);
        const wo_host_param_info *const param = wo_host_find_param(context, names[i]);
        if (fact && fact->type != WO_IO_TEXT && param && param->dimension == 1)
            WO_TRY(wo_host_param_set(instance, param->name, &fact->number, 1, error));
    }
    return WO_OK;
}
