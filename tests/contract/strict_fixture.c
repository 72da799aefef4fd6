/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "strict_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

float noise_at(const noise *n, int32_t x, int32_t y, int32_t component)
{
    uint32_t h = n->seed * 2654435761u + (uint32_t)x * 374761393u + (uint32_t)y * 668265263u +
                 (uint32_t)component * 2246822519u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return (float)((h ^ (h >> 16)) & 0xffffff) / 16777216;
}

static wo_status noise_region(void *user, double time, wo_host_region *region, wo_error *error)
{
    const noise *const n = user;
    (void)time;
    (void)error;
    *region = n->region;
    return WO_OK;
}

static void fill(const noise *n, const wo_image *image)
{
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++)
        for (int32_t x = image->bounds.x1; x < image->bounds.x2; x++)
            for (int32_t c = 0; c < image->components; c++)
                wo_image_at(image, x, y)[c] = noise_at(n, x, y, c);
}

static wo_status noise_pixels(void *user, const wo_host_request *request, const wo_image *image,
                              wo_error *error)
{
    const noise *const n = user;
    (void)request;
    if (n->missing)
        return wo_fail(error, WO_ERR_NOT_FOUND, "no picture");
    fill(n, image);
    return WO_OK;
}

noise clips[PROBE_CLIPS];

void reset_clips(double aspect)
{
    clips[0] = (noise){{-6, 4, 61, 40}, 4, 1, aspect, false};
    clips[1] = (noise){{10, -20, 41, 33}, 3, 2, aspect, false};
    clips[2] = (noise){{-30, 11, 48, 90}, 1, 3, aspect, false};
    clips[3] = (noise){{20, 8, 80, 30}, 3, 4, aspect, false};
}

wo_host_source source_of(noise *n)
{
    wo_host_source source = WO_HOST_SOURCE_INIT;
    source.user = n;
    source.components = n->components;
    source.pixel_aspect = n->aspect;
    source.region = noise_region;
    source.pixels = noise_pixels;
    return source;
}

/* ---- the host ---- */

watcher watch;

static bool aborted(void *user)
{
    watcher *const w = user;
    const int limit = atomic_load(&w->stop_after);
    return atomic_fetch_add(&w->polls, 1) >= limit && limit >= 0;
}

wo_host *open_host(unsigned threads, unsigned layout)
{
    static const char *const directories[] = {PROBE_DIRECTORY};
    wo_error error = {WO_OK, ""};
    wo_host *host = NULL;
    const wo_host_config config = {.threads = threads,
                                   .directories = directories,
                                   .directory_count = 1,
                                   .strict = true,
                                   .layout = layout,
                                   .user = &watch,
                                   .aborted = aborted};
    atomic_store(&watch.polls, 0);
    atomic_store(&watch.stop_after, -1);
    if (wo_host_create(&config, &host, &error) != WO_OK)
        fail_msg("%s", error.text);
    return host;
}

void assert_no_violations(wo_host *host)
{
    const size_t count = wo_host_violation_count(host);
    for (size_t i = 0; i < count; i++)
        print_error("violation: %s\n", wo_host_violation(host, i));
    assert_int_equal(count, 0);
    for (size_t i = 0; i < wo_host_note_count(host); i++)
        assert_null(strstr(wo_host_note(host, i), "beyond the region of interest"));
}

void close_host(wo_host **host)
{
    assert_no_violations(*host);
    wo_host_destroy(host);
}

const wo_host_plugin *probe_of(wo_host *host)
{
    const wo_host_plugin *plugin = NULL;
    wo_error error = {WO_OK, ""};
    if (wo_host_find_plugin(host, "Probe", &plugin, &error) != WO_OK)
        fail_msg("%s", error.text);
    return plugin;
}

wo_host_instance *create(wo_host *host, const char *context, double aspect)
{
    wo_host_project project = WO_HOST_PROJECT_INIT;
    wo_host_instance *instance = NULL;
    wo_error error = {WO_OK, ""};
    project.size[0] = 64;
    project.size[1] = 48;
    project.pixel_aspect = aspect;
    if (wo_host_instance_create(host, probe_of(host), context, &project, &instance, &error) !=
        WO_OK)
        fail_msg("%s", error.text);
    return instance;
}

void connect_clip(wo_host_instance *instance, int clip)
{
    const wo_host_source source = source_of(&clips[clip]);
    assert_int_equal(wo_host_set_clip(instance, probe_effect.clips[clip].name, &source, NULL),
                     WO_OK);
}

void set(wo_host_instance *instance, const char *name, const char *text)
{
    wo_error error = {WO_OK, ""};
    if (wo_host_param_set_text(instance, name, text, &error) != WO_OK)
        fail_msg("%s", error.text);
}

/* ---- what must come out ---- */

setup default_setup(void)
{
    setup s = {.scale = {1, 1}, .aspect = 1, .connected = {true, true, true, true}};
    wo_params_default(probe_effect.params, probe_effect.param_count, &s.params);
    return s;
}

void connect_only_source(setup *s)
{
    memset(s->connected, 0, sizeof s->connected);
    s->connected[PROBE_SOURCE] = true;
}

static wo_rect pixels_of(const setup *s, wo_host_region r)
{
    const double sx = s->scale[0] / s->aspect, sy = s->scale[1];
    return (wo_rect){(int32_t)floor(r.x1 * sx), (int32_t)floor(r.y1 * sy), (int32_t)ceil(r.x2 * sx),
                     (int32_t)ceil(r.y2 * sy)};
}

static wo_image new_image(wo_rect bounds, int32_t components)
{
    const size_t row = (size_t)wo_rect_width(bounds) * (size_t)components * sizeof(float);
    const wo_image image = {calloc((size_t)wo_rect_height(bounds), row), bounds, (ptrdiff_t)row,
                            components};
    assert_non_null(image.data);
    return image;
}

/* Colour and masks are zero where they end within the frame. */
static void add_border(wo_image *image, wo_rect bounds)
{
    const wo_image bordered = new_image(bounds, image->components == 1 ? 1 : 4);
    const wo_rect inside = wo_rect_intersect(bounds, image->bounds);
    for (int32_t y = inside.y1; y < inside.y2; y++)
        for (int32_t x = inside.x1; x < inside.x2; x++) {
            float *const to = wo_image_at(&bordered, x, y);
            if (bordered.components == 4)
                to[3] = 1;
            memcpy(to, wo_image_at(image, x, y), (size_t)image->components * sizeof(float));
        }
    free(image->data);
    *image = bordered;
}

wo_image expected(const setup *s)
{
    const wo_context context = WO_CONTEXT_INIT;
    wo_image inputs[PROBE_CLIPS] = {{.data = NULL}};
    wo_plan_args args = {.geometry = WO_GEOMETRY_INIT, .inputs = inputs};
    wo_plan *plan = NULL;
    args.geometry.format = pixels_of(s, (wo_host_region){0, 0, 64, 48});
    args.geometry.extent = args.window = pixels_of(s, clips[0].region);
    args.geometry.render_scale = s->scale[0];
    args.geometry.pixel_stretch = s->aspect * s->scale[1] / s->scale[0];
    args.geometry.pixel_aspect = s->aspect;
    for (int i = 0; i < PROBE_CLIPS; i++) {
        args.geometry.connected[i] = s->connected[i];
        if (!s->connected[i])
            continue;
        inputs[i] = new_image(pixels_of(s, clips[i].region), clips[i].components);
        fill(&clips[i], &inputs[i]);
        if (i >= PROBE_MASK)
            add_border(&inputs[i], args.geometry.extent);
    }
    const wo_image output = new_image(args.window, 4);
    assert_int_equal(probe_effect.plan_create(&context, &s->params, &args, &plan, NULL), WO_OK);
    assert_int_equal(probe_effect.render(plan, args.window, &output, NULL, NULL), WO_OK);
    probe_effect.plan_destroy(&plan);
    for (int i = 0; i < PROBE_CLIPS; i++)
        free(inputs[i].data);
    return output;
}

static void assert_same(const wo_image *wanted, const wo_image *got)
{
    assert_true(wo_rect_equal(wanted->bounds, got->bounds));
    assert_int_equal(got->components, 4);
    for (int32_t y = wanted->bounds.y1; y < wanted->bounds.y2; y++)
        for (int32_t x = wanted->bounds.x1; x < wanted->bounds.x2; x++) {
            const float *const a = wo_image_at(wanted, x, y), *const b = wo_image_at(got, x, y);
            if (memcmp(a, b, 4 * sizeof(float)) != 0)
                fail_msg("pixel %d,%d: %.9g %.9g %.9g %.9g for %.9g %.9g %.9g %.9g", (int)x, (int)y,
                         (double)b[0], (double)b[1], (double)b[2], (double)b[3], (double)a[0],
                         (double)a[1], (double)a[2], (double)a[3]);
        }
}

wo_host_render_args args_of(const setup *s)
{
    wo_host_render_args args = WO_HOST_RENDER_INIT;
    args.time = 1;
    args.scale_x = s->scale[0];
    args.scale_y = s->scale[1];
    return args;
}

void assert_render(wo_host_instance *instance, const setup *s, const wo_host_render_args *args)
{
    wo_error error = {WO_OK, ""};
    wo_image got = {.data = NULL};
    wo_image wanted = expected(s);
    wo_host_render_result result;
    if (wo_host_render(instance, args, &got, &result, &error) != WO_OK)
        fail_msg("%s", error.text);
    assert_false(result.identity);
    assert_same(&wanted, &got);
    wo_host_image_free(&got);
    free(wanted.data);
}
