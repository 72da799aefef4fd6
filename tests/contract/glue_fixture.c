/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "glue_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <dlfcn.h>

OfxPlugin *probe;
int (*probe_count)(void);
OfxPlugin *(*probe_get)(int nth);
OfxStatus (*probe_set_host)(const OfxHost *host);

static void *library;
static void *garbage[512];
static size_t garbage_count;

static void *keep(void *memory)
{
    assert_non_null(memory);
    assert_true(garbage_count < WO_COUNT(garbage));
    return garbage[garbage_count++] = memory;
}

static void *symbol(const char *name)
{
    void *const address = dlsym(library, name);
    assert_non_null(address);
    return address;
}

int fixture_open(void **state)
{
    (void)state;
    library = dlopen(PROBE_BINARY, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        print_error("%s\n", dlerror());
    assert_non_null(library);
    *(void **)&probe_count = symbol("OfxGetNumberOfPlugins");
    *(void **)&probe_get = symbol("OfxGetPlugin");
    *(void **)&probe_set_host = symbol("OfxSetHost");
    probe = probe_get(0);
    assert_non_null(probe);
    return 0;
}

int fixture_close(void **state)
{
    (void)state;
    return dlclose(library);
}

int fixture_load(void **state)
{
    (void)state;
    mock_reset();
    probe->setHost(mock_host());
    assert_int_equal(probe->mainEntry(kOfxActionLoad, NULL, NULL, NULL), kOfxStatOK);
    return 0;
}

int fixture_unload(void **state)
{
    (void)state;
    assert_int_equal(probe->mainEntry(kOfxActionUnload, NULL, NULL, NULL), kOfxStatOK);
    assert_int_equal(mock.live_blocks, 0);
    assert_int_equal(mock.live_images, 0);
    assert_int_equal(mock.live_sets, 0);
    assert_int_equal(mock.progress_starts, mock.progress_ends);
    fixture_free_pictures();
    return 0;
}

void fixture_free_pictures(void)
{
    while (garbage_count > 0)
        free(garbage[--garbage_count]);
    memset(mock.pictures, 0, sizeof mock.pictures);
}

static wo_depth depth_of(const char *depth)
{
    return strcmp(depth, kOfxBitDepthByte) == 0    ? WO_DEPTH_BYTE
           : strcmp(depth, kOfxBitDepthShort) == 0 ? WO_DEPTH_SHORT
           : strcmp(depth, kOfxBitDepthHalf) == 0  ? WO_DEPTH_HALF
                                                   : WO_DEPTH_FLOAT;
}

static int count_of(const char *components)
{
    return strcmp(components, kOfxImageComponentRGBA) == 0  ? 4
           : strcmp(components, kOfxImageComponentRGB) == 0 ? 3
                                                            : 1;
}

static uint32_t noise(unsigned seed, int32_t x, int32_t y, int component)
{
    uint32_t h = seed * 2654435761u + (uint32_t)x * 374761393u + (uint32_t)y * 668265263u +
                 (uint32_t)component * 2246822519u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return h ^ (h >> 16);
}

static unsigned char *place(const mock_picture *p, int32_t x, int32_t y, int component)
{
    const int bytes = (int)wo_depth_bytes(depth_of(p->depth));
    return (unsigned char *)p->data + (ptrdiff_t)(y - p->bounds.y1) * p->row_bytes +
           ((ptrdiff_t)(x - p->bounds.x1) * count_of(p->components) + component) * bytes;
}

void picture_make(mock_picture *picture, wo_rect bounds, const char *depth, const char *components,
                  unsigned layout, unsigned seed)
{
    const size_t row = (size_t)wo_rect_width(bounds) * (size_t)count_of(components) *
                       wo_depth_bytes(depth_of(depth));
    const size_t pitch = row + (layout & PICTURE_PADDED ? 20 : 0);
    const size_t height = (size_t)wo_rect_height(bounds);
    const size_t shift = layout & PICTURE_MISALIGNED ? 2 : 0;
    unsigned char *const memory = keep(malloc(shift + pitch * (height - 1) + row));

    memset(memory, 0xee, shift + pitch * (height - 1) + row);
    *picture = (mock_picture){.data = memory + shift,
                              .bounds = bounds,
                              .row_bytes = (int)pitch,
                              .depth = depth,
                              .components = components,
                              .connected = true};
    if (layout & PICTURE_NEGATIVE) {
        picture->data = memory + shift + pitch * (height - 1);
        picture->row_bytes = -picture->row_bytes;
    }
    for (int32_t y = bounds.y1; y < bounds.y2; y++)
        for (int32_t x = bounds.x1; x < bounds.x2; x++)
            for (int c = 0; c < count_of(components); c++) {
                const uint32_t n = noise(seed, x, y, c);
                unsigned char *const at = place(picture, x, y, c);
                const uint16_t half = wo_float_to_half((float)(n & 1023) / 1024);
                const uint16_t word = (uint16_t)n;
                const float value = (float)(n & 0xffffff) / 16777216;
                switch (depth_of(depth)) {
                case WO_DEPTH_BYTE:
                    *at = (unsigned char)n;
                    break;
                case WO_DEPTH_SHORT:
                    memcpy(at, &word, sizeof word);
                    break;
                case WO_DEPTH_HALF:
                    memcpy(at, &half, sizeof half);
                    break;
                case WO_DEPTH_FLOAT:
                    memcpy(at, &value, sizeof value);
                    break;
                }
            }
}

void picture_fill(const mock_picture *p, int byte)
{
    const size_t row = (size_t)wo_rect_width(p->bounds) * (size_t)count_of(p->components) *
                       wo_depth_bytes(depth_of(p->depth));
    for (int32_t y = p->bounds.y1; y < p->bounds.y2; y++)
        memset(place(p, p->bounds.x1, y, 0), byte, row);
}

float picture_value(const mock_picture *p, int32_t x, int32_t y, int component)
{
    const unsigned char *const at = place(p, x, y, component);
    uint16_t word;
    float value;
    switch (depth_of(p->depth)) {
    case WO_DEPTH_BYTE:
        return (float)*at / 255;
    case WO_DEPTH_SHORT:
        memcpy(&word, at, sizeof word);
        return (float)word / 65535;
    case WO_DEPTH_HALF:
        memcpy(&word, at, sizeof word);
        return wo_half_to_float(word);
    case WO_DEPTH_FLOAT:
        break;
    }
    memcpy(&value, at, sizeof value);
    return value;
}

wo_image picture_floats(const mock_picture *p)
{
    if (!p->data || !p->connected || p->silent)
        return (wo_image){.data = NULL};
    const int count = count_of(p->components);
    const int32_t width = wo_rect_width(p->bounds);
    const ptrdiff_t row = (ptrdiff_t)width * count * (ptrdiff_t)sizeof(float);
    const wo_image image = {keep(malloc((size_t)row * (size_t)wo_rect_height(p->bounds))),
                            p->bounds, row, count};
    for (int32_t y = p->bounds.y1; y < p->bounds.y2; y++)
        for (int32_t x = p->bounds.x1; x < p->bounds.x2; x++)
            for (int c = 0; c < count; c++)
                wo_image_at(&image, x, y)[c] = picture_value(p, x, y, c);
    return image;
}

wo_image picture_border(const wo_image *image, wo_rect bounds)
{
    const int count = image->components == 1 ? 1 : 4;
    const ptrdiff_t row = (ptrdiff_t)wo_rect_width(bounds) * count * (ptrdiff_t)sizeof(float);
    const wo_image bordered = {keep(calloc((size_t)wo_rect_height(bounds), (size_t)row)), bounds,
                               row, count};
    const wo_rect inside = wo_rect_intersect(bounds, image->bounds);
    for (int32_t y = inside.y1; y < inside.y2; y++)
        for (int32_t x = inside.x1; x < inside.x2; x++) {
            float *const to = wo_image_at(&bordered, x, y);
            if (count == 4)
                to[3] = 1;
            memcpy(to, wo_image_at(image, x, y), (size_t)image->components * sizeof(float));
        }
    return bordered;
}

void expect_defaults(expected *e)
{
    memset(e, 0, sizeof *e);
    wo_params_default(probe_effect.params, probe_effect.param_count, &e->params);
    e->geometry = (wo_geometry){.format = {0, 0, 100, 50},
                                .extent = mock.pictures[0].bounds,
                                .render_scale = 1,
                                .pixel_stretch = 1,
                                .pixel_aspect = 1,
                                .connected = {true}};
}

const float *expect_pixels(const expected *e, wo_rect window)
{
    const wo_context context = WO_CONTEXT_INIT;
    const size_t row = (size_t)wo_rect_width(window) * 4;
    wo_image inputs[PROBE_CLIPS];
    wo_plan_args args = {.geometry = e->geometry, .window = window, .inputs = inputs};
    wo_plan *plan = NULL;
    const wo_image output = {keep(malloc(row * (size_t)wo_rect_height(window) * sizeof(float))),
                             window, (ptrdiff_t)(row * sizeof(float)), 4};

    for (int i = 0; i < PROBE_CLIPS; i++) {
        inputs[i] = picture_floats(&mock.pictures[i]);
        if (inputs[i].data && i >= PROBE_MASK &&
            !wo_rect_contains(inputs[i].bounds, e->geometry.extent))
            inputs[i] = picture_border(&inputs[i], e->geometry.extent);
    }
    args.alpha[0] = e->alpha;
    assert_int_equal(probe_effect.plan_create(&context, &e->params, &args, &plan, NULL), WO_OK);
    assert_int_equal(probe_effect.render(plan, window, &output, NULL, NULL), WO_OK);
    probe_effect.plan_destroy(&plan);
    return output.data;
}

static float stored(float value, wo_depth depth)
{
    const float cut = value > 0 ? fminf(value, 1) : 0;
    switch (depth) {
    case WO_DEPTH_BYTE:
        return roundf(cut * 255) / 255;
    case WO_DEPTH_SHORT:
        return roundf(cut * 65535) / 65535;
    case WO_DEPTH_HALF:
        return wo_half_to_float(wo_float_to_half(value));
    case WO_DEPTH_FLOAT:
        break;
    }
    return value;
}

void assert_output(const float *pixels, wo_rect window)
{
    const mock_picture *const p = &mock.pictures[MOCK_OUTPUT];
    const int count = count_of(p->components);
    for (int32_t y = window.y1; y < window.y2; y++)
        for (int32_t x = window.x1; x < window.x2; x++, pixels += 4)
            for (int c = 0; c < count; c++) {
                const float wanted = stored(pixels[count == 1 ? 3 : c], depth_of(p->depth));
                const float got = picture_value(p, x, y, c);
                if (memcmp(&wanted, &got, sizeof got) != 0)
                    fail_msg("pixel %d,%d component %d: %.9g for %.9g", (int)x, (int)y, c,
                             (double)got, (double)wanted);
            }
}

OfxImageEffectHandle create(const char *context)
{
    OfxStatus status = kOfxStatFailed;
    const OfxImageEffectHandle effect = mock_create(probe, context, &status);
    assert_int_equal(status, kOfxStatOK);
    assert_non_null(effect);
    return effect;
}

void render(OfxImageEffectHandle effect, wo_rect window, OfxStatus status)
{
    const double scale[2] = {1, 1};
    const OfxStatus got = mock_render(probe, effect, window, scale, kOfxImageFieldNone);
    if (got != status)
        print_error("message: %s\n", mock.message);
    assert_int_equal(got, status);
}

const char *explain(OfxImageEffectHandle effect, wo_rect window, const double scale[2])
{
    mock.report_mode = kWideOpenReportExplain;
    assert_int_equal(mock_render(probe, effect, window, scale, NULL), kOfxStatOK);
    mock.report_mode = kWideOpenReportNone;
    assert_string_equal(mock.kind, "plan");
    return mock.published;
}
