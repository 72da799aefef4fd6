/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bridge/image_io.h"
#include "footage.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static wo_status set_camera(const wo_footage *f, wo_io_part *part, wo_error *error)
{
    const wo_footage_options *const o = &f->options;
    const struct {
        const char *name;
        double value;
    } numbers[] = {
        {"wideopen:focalLength", o->focal_mm},  {"wideopen:fStop", o->f_stop},
        {"wideopen:focusDistance", o->focus_m}, {"wideopen:sensorWidth", WO_FOOTAGE_SENSOR_MM},
        {"wideopen:blades", o->blades},         {"wideopen:rotation", o->rotation}};
    for (size_t i = 0; i < WO_COUNT(numbers); i++)
        WO_TRY(wo_io_part_set_number(part, numbers[i].name, numbers[i].value, error));
    char seed[24];
    snprintf(seed, sizeof seed, "%" PRIu64, o->seed);
    WO_TRY(wo_io_part_set_text(part, "wideopen:seed", seed, error));
    return wo_io_part_set_text(part, "wideopen:scene", o->scene, error);
}

static wo_status fill_part(const wo_footage *f, const char *name, const wo_image *image,
                           const char *const *channels, wo_io_part *part, wo_error *error)
{
    WO_TRY(
        wo_io_part_init(part, name, image->bounds, f->frame, channels, image->components, error));
    const size_t row = (size_t)wo_rect_width(image->bounds) * (size_t)image->components;
    for (int32_t y = 0; y < wo_rect_height(image->bounds); y++)
        memcpy(part->pixels + (size_t)y * row,
               wo_image_at(image, image->bounds.x1, image->bounds.y1 + y), row * sizeof(float));
    return set_camera(f, part, error);
}

static const char *const rgba_names[] = {"R", "G", "B", "A"};
static const char *const depth_names[] = {"Z"};
static const char *const normal_names[] = {"N.X", "N.Y", "N.Z"};

/* Writes the parts of file as folder/name, whatever became of them before; then file is gone. */
static wo_status save(wo_status status, wo_io_file *file, const char *folder, const char *name,
                      wo_io_depth depth, wo_error *error)
{
    char path[4096];
    if (status == WO_OK &&
        (size_t)snprintf(path, sizeof path, "%s/%s", folder, name) >= sizeof path)
        status = wo_fail(error, WO_ERR_RANGE, "the path of the folder is too long");
    if (status == WO_OK)
        status = wo_io_write(path, file->parts, file->part_count, depth, error);
    wo_io_file_destroy(&file);
    return status;
}

static wo_status write_pinhole(const wo_footage *f, const char *folder, wo_error *error)
{
    wo_io_file *file = NULL;
    WO_TRY(wo_io_file_create(3, &file, error));
    wo_status status = fill_part(f, "rgba", &f->colour, rgba_names, &file->parts[0], error);
    if (status == WO_OK)
        status = fill_part(f, "depth", &f->depth, depth_names, &file->parts[1], error);
    if (status == WO_OK)
        status = fill_part(f, "normal", &f->normal, normal_names, &file->parts[2], error);
    return save(status, file, folder, WO_FOOTAGE_PINHOLE, WO_IO_AUTO, error);
}

static wo_status write_layers(const wo_footage *f, const char *folder, wo_error *error)
{
    wo_io_file *file = NULL;
    WO_TRY(wo_io_file_create(2 * (size_t)f->layer_count, &file, error));
    wo_status status = WO_OK;
    for (int k = 0; k < f->layer_count && status == WO_OK; k++) {
        char name[32];
        snprintf(name, sizeof name, "layer%d", k + 1);
        status = fill_part(f, name, &f->layer[k], rgba_names, &file->parts[2 * k], error);
        if (status != WO_OK)
            break;
        snprintf(name, sizeof name, "layer%d_depth", k + 1);
        status =
            fill_part(f, name, &f->layer_depth[k], depth_names, &file->parts[2 * k + 1], error);
    }
    return save(status, file, folder, WO_FOOTAGE_LAYERS, WO_IO_AUTO, error);
}

static wo_status write_single(const wo_footage *f, const wo_image *image, const char *folder,
                              const char *name, wo_error *error)
{
    wo_io_file *file = NULL;
    WO_TRY(wo_io_file_create(1, &file, error));
    wo_io_part *const part = &file->parts[0];
    wo_status status = fill_part(f, NULL, image, rgba_names, part, error);
    if (status == WO_OK)
        status = wo_io_part_set_number(part, "wideopen:samples", f->options.reference_spp, error);
    if (status == WO_OK)
        status = wo_io_part_set_number(part, "wideopen:noisePSNR", f->noise_psnr, error);
    return save(status, file, folder, name, WO_IO_SINGLE, error);
}

wo_status wo_footage_write(const wo_footage *footage, const char *folder, wo_error *error)
{
    WO_TRY(write_pinhole(footage, folder, error));
    if (footage->layer_count > 0)
        WO_TRY(write_layers(footage, folder, error));
    if (!footage->reference.data)
        return WO_OK;
    WO_TRY(write_single(footage, &footage->reference, folder, WO_FOOTAGE_REFERENCE, error));
    return write_single(footage, &footage->reference_error, folder, WO_FOOTAGE_REFERENCE_ERROR,
                        error);
}

wo_status wo_footage_render(const wo_context *context, const wo_footage_options *options,
                            const char *folder, wo_footage **footage, wo_error *error)
{
    wo_footage *made = NULL;
    if (footage)
        *footage = NULL;
    WO_TRY(wo_footage_make(context, options, &made, error));
    const wo_status status = wo_footage_write(made, folder, error);
    if (status == WO_OK && footage)
        *footage = made;
    else
        wo_footage_destroy(context, &made);
    return status;
}
