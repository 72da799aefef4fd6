/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/depth_check.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

enum { WIDTH = 80, HEIGHT = 60 };
static const wo_rect frame = {0, 0, WIDTH, HEIGHT};

/* Metres at a pixel of a room: a floor that comes nearer downwards, two boxes on it, sky above; in
   sky the answer is infinity. */
static double room(int32_t x, int32_t y)
{
    if (x > 20 && x < 40 && y > 10 && y < 45)
        return 1.7 + 0.003 * x;
    if (x > 55 && x < 62 && y < 30)
        return 3.1 + 0.002 * y;
    return y < 48 ? 60 / (50 - y - 0.01 * x) : INFINITY;
}

static double steps_of(double value, double steps)
{
    return floor(value * steps + 0.5) / steps;
}

/* As a file of 16-bit floats keeps it. */
static double half_of(double value)
{
    int exponent;
    const double mantissa = frexp(value, &exponent);
    return isfinite(value) ? ldexp(steps_of(mantissa, 2048), exponent) : value;
}

static double dust(int32_t x, int32_t y)
{
    return fmod(fabs(sin(x * 12.9898 + y * 78.233)) * 43758.5453, 1);
}

/* What programs write for the room; z is finite unless it is sky. */
typedef enum way {
    METRES,      /* Blender: 1e10 is sky */
    METRES_HALF, /* infinity is sky */
    METRES_ZERO, /* 0 is sky */
    METRES_NAN,
    RINGING, /* scaled by a filter with negative lobes */
    CENTIMETRES,
    CENTIMETRES_HALF,
    MILLIMETRES,
    LANDSCAPE, /* 1024 m to 60 km, 16-bit floats: whole numbers */
    MACRO,     /* 0.1 to 0.9 m */
    CARDS,     /* a few flat things at whole metres */
    ONE_WALL,
    SKY,
    SKY_ZERO,
    DISTANT, /* all beyond 1e5 units */
    TINY,
    CAMERA_SPACE, /* -z, 0 is sky */
    CAMERA_SPACE_FAR,
    NORMAL,       /* a component of normals */
    INVERSE,      /* 1/z, 0 is sky */
    UNIT,         /* 0 nearest, 1 farthest */
    UNIT_CLAMPED, /* z-depth from near to far, white is near */
    BYTES,        /* estimated inverse depth in a file of 8 bits */
    SHORTS,
    SHORTS_MM, /* millimetres in a file of 16 bits, read as 0..1 */
    SENSOR,    /* whole millimetres */
    NUMBERS,   /* whole numbers 0..255 */
    NOTHING
} way;

static double written(way how, int32_t x, int32_t y)
{
    const double z = room(x, y);
    const bool sky = isinf(z);
    const double far = 30, inverse = sky ? 0 : 1 / z;
    switch (how) {
    case METRES:
        return sky ? 1e10 : z;
    case METRES_HALF:
        return half_of(z);
    case METRES_ZERO:
        return sky ? 0 : z;
    case METRES_NAN:
        return sky ? NAN : z;
    case RINGING:
        return dust(x, y) < 0.08 ? -0.4 * (sky ? 1e10 : z) : sky ? 1e10 : z;
    case CENTIMETRES:
        return sky ? 1e30 : 100 * z;
    case CENTIMETRES_HALF:
        return sky ? 65504 : half_of(100 * z);
    case MILLIMETRES:
        return sky ? 1e30 : 1000 * z;
    case LANDSCAPE:
        return sky ? INFINITY : half_of(600 * z);
    case MACRO:
        return sky ? 1e10 : 0.03 * z;
    case CARDS:
        return 1 + (x / 10) % 8;
    case ONE_WALL:
        return 2.5;
    case SKY:
        return 1e10;
    case SKY_ZERO:
    case NOTHING:
        return 0;
    case DISTANT:
        return 2e5 * (sky ? 1e9 : z);
    case TINY:
        return sky ? 1e10 : 1e-5 * z;
    case CAMERA_SPACE:
        return sky ? 0 : -z;
    case CAMERA_SPACE_FAR:
        return sky ? -1e10 : -z;
    case NORMAL:
        return dust(x, y) * 2 - 1;
    case INVERSE:
        return inverse;
    case UNIT:
        return sky ? 1 : (z - 1.2) / (far - 1.2);
    case UNIT_CLAMPED:
        return fmin(fmax(1 - (z - 2) / 12, 0), 1);
    case BYTES:
        return steps_of(inverse * 1.2, 255);
    case SHORTS:
        return steps_of(inverse * 1.2, 65535);
    case SHORTS_MM:
        return sky ? 0 : floor(1000 * z) / 65535;
    case SENSOR:
        return sky ? 0 : floor(300 * z);
    case NUMBERS:
        return floor(inverse * 255);
    }
    return NAN;
}

typedef struct tried {
    way how;
    wo_depth_reading reading;
    const char *key, *hint; /* NULL: no warning */
} tried;

#define AS(mode, scale)                                                                            \
    {                                                                                              \
        WO_DEPTH_##mode, scale, 0.1, 100                                                           \
    }

static const tried cases[] = {
    {METRES, AS(DISTANCE, 1), NULL, NULL},
    {METRES, AS(RAY, 1), NULL, NULL},
    {METRES_HALF, AS(DISTANCE, 1), NULL, NULL},
    {METRES_ZERO, AS(DISTANCE, 1), NULL, NULL},
    {METRES_NAN, AS(DISTANCE, 1), NULL, NULL},
    {RINGING, AS(DISTANCE, 1), NULL, NULL},
    {CENTIMETRES, AS(DISTANCE, 100), NULL, NULL},
    {CENTIMETRES, AS(DISTANCE, 1), NULL, NULL}, /* cannot be told */
    {CENTIMETRES_HALF, AS(DISTANCE, 100), NULL, NULL},
    {CENTIMETRES_HALF, AS(DISTANCE, 1), NULL, NULL},
    {MILLIMETRES, AS(DISTANCE, 1000), NULL, NULL},
    {LANDSCAPE, AS(DISTANCE, 1), NULL, NULL},
    {MACRO, AS(DISTANCE, 1), NULL, NULL},
    {CARDS, AS(DISTANCE, 1), NULL, NULL},
    {ONE_WALL, AS(DISTANCE, 1), NULL, NULL},
    {SKY, AS(DISTANCE, 1), NULL, NULL},
    {CAMERA_SPACE, AS(NEGATIVE, 1), NULL, NULL},
    {CAMERA_SPACE_FAR, AS(NEGATIVE, 1), NULL, NULL},
    {INVERSE, AS(INVERSE, 1), NULL, NULL},
    {INVERSE, AS(DISTANCE, 1), NULL, NULL}, /* cannot be told */
    {UNIT, AS(NORMALISED, 1), NULL, NULL},
    {UNIT_CLAMPED, AS(NORMALISED, 1), NULL, NULL},
    {BYTES, AS(NORMALISED, 1), NULL, NULL},
    {BYTES, AS(INVERSE, 1), NULL, NULL},
    {SHORTS, AS(INVERSE, 0.2), NULL, NULL},
    {SHORTS_MM, AS(DISTANCE, 1000 / 65535.0), NULL, NULL},

    {CAMERA_SPACE, AS(DISTANCE, 1), "depth-negative", "depthMode=negative"},
    {CAMERA_SPACE_FAR, AS(DISTANCE, 1), "depth-negative", "depthMode=negative"},
    {CAMERA_SPACE, AS(RAY, 1), "depth-negative", "depthMode=negative"},
    {METRES, AS(NEGATIVE, 1), "depth-negative", "depthMode=distance"},
    {NORMAL, AS(DISTANCE, 1), "depth-negative", "channel"},
    {CAMERA_SPACE, AS(INVERSE, 1), "depth-negative", "depthMode=negative"},
    {NOTHING, AS(DISTANCE, 1), "depth-zero", "useDepth=false"},
    {NOTHING, AS(INVERSE, 1), "depth-zero", "useDepth=false"},
    {UNIT, AS(DISTANCE, 1), "depth-normalised", "depthMode=normalised"},
    {UNIT, AS(DISTANCE, 100), "depth-normalised", "depthMode=normalised"},
    {UNIT_CLAMPED, AS(DISTANCE, 1), "depth-normalised", "depthMode=normalised"},
    {BYTES, AS(DISTANCE, 1), "depth-normalised", "depthMode=inverse"},
    {SHORTS, AS(RAY, 1), "depth-normalised", "depthMode=inverse"},
    {SHORTS_MM, AS(DISTANCE, 1), "depth-normalised", "whole numbers"},
    {SENSOR, AS(DISTANCE, 1), "depth-whole", "depthScale=1000"},
    {NUMBERS, AS(DISTANCE, 1), "depth-whole", "whole numbers"},
    {DISTANT, AS(DISTANCE, 1), "depth-far", "depthScale"},
    {METRES, AS(DISTANCE, 1e-6), "depth-far", "depthScale"},
    {TINY, AS(DISTANCE, 1), "depth-near", "depthScale"},
    {INVERSE, AS(INVERSE, 1e-6), "depth-far", "depthScale"},
    {INVERSE, AS(INVERSE, 1e6), "depth-near", "depthScale"},
    {METRES, AS(INVERSE, 1), "depth-inverse", "depthMode=distance"},
    {METRES_HALF, AS(INVERSE, 1), "depth-inverse", "depthMode=distance"},
    {METRES, AS(NORMALISED, 1), "depth-not-normalised", "depthMode=distance"},
};

static const wo_depth_clip first = {"Depth", false, false}, other = {"Depth2", true, false},
                           tile = {"Depth", false, true};

static wo_report check(way how, wo_depth_reading reading, const wo_depth_clip *clip)
{
    wo_image colour = picture_make(frame, 4), depth = picture_make(frame, 1);
    wo_report report = {.pixels = 0};
    wo_error error = {0};
    picture_fill(&colour, (const float[4]){0.5f, 0.5f, 0.5f, 1});
    for (int32_t y = 0; y < HEIGHT; y++)
        for (int32_t x = 0; x < WIDTH; x++)
            *wo_image_at(&depth, x, y) = (float)written(how, x, y);
    const wo_sheet_source source = {.colour = &colour, .depth = &depth, .reading = reading};
    const wo_status status = wo_depth_check(&plain, &source, frame, clip, &report, &error);
    picture_free(&colour);
    picture_free(&depth);
    assert_int_equal(status, WO_OK);
    return report;
}

static void what_programs_write_is_told_by_its_numbers(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        const tried *c = &cases[i];
        const wo_report report = check(c->how, c->reading, &first);
        const char *const key = report.warning_count ? report.warnings[0].key : "nothing";
        if (strcmp(key, c->key ? c->key : "nothing") != 0 ||
            (c->hint && !strstr(report.warnings[0].text, c->hint)) || report.warning_count > 1)
            fail_msg("case %zu (%d as %d): %s: %s", i, c->how, c->reading.mode, key,
                     report.warnings[0].text);
    }
    for (size_t i = 0; i < WO_COUNT(cases); i++)
        if (cases[i].key) /* what is told is told in full */
            assert_true(strlen(check(cases[i].how, cases[i].reading, &first).warnings[0].text) <
                        WO_WARNING_SIZE - 40);
}

static void a_layer_may_be_sky_alone(void **state)
{
    (void)state;
    const wo_depth_reading metres = AS(DISTANCE, 1);
    assert_int_equal(check(NOTHING, metres, &other).warning_count, 0);
    assert_int_equal(check(DISTANT, metres, &other).warning_count, 0);
    assert_int_equal(check(CAMERA_SPACE, metres, &other).warning_count, 1);
}

/* Of a part less is told: it may be sky, the rest of the picture may have what it lacks. */
static void a_part_is_judged_by_what_no_part_has(void **state)
{
    (void)state;
    static const struct {
        way how;
        bool told;
    } parts[] = {{METRES, false},  {RINGING, false}, {NOTHING, false},   {SKY, false},
                 {DISTANT, false}, {TINY, false},    {NORMAL, false},    {CAMERA_SPACE, true},
                 {UNIT, true},     {BYTES, true},    {SENSOR, true},     {MACRO, false},
                 {CARDS, false},   {INVERSE, false}, {LANDSCAPE, false}, {METRES_NAN, false}};
    const wo_depth_reading metres = AS(DISTANCE, 1), normalised = AS(NORMALISED, 1);
    for (size_t i = 0; i < WO_COUNT(parts); i++)
        if ((check(parts[i].how, metres, &tile).warning_count > 0) != parts[i].told)
            fail_msg("part %zu", i);
    assert_int_equal(check(METRES, normalised, &tile).warning_count, 0);
}

/* Depth of pixels that show nothing is nobody's. */
static void empty_pixels_do_not_count(void **state)
{
    (void)state;
    wo_image colour = picture_make(frame, 4), depth = picture_make(frame, 3);
    wo_report report = {.pixels = 0};
    wo_sheet_source source = {
        .colour = &colour, .depth = &depth, .depth_channel = 1, .reading = AS(DISTANCE, 1)};
    for (int32_t y = 0; y < HEIGHT; y++)
        for (int32_t x = 0; x < WIDTH; x++) {
            const bool shown = y < 30;
            wo_image_at(&colour, x, y)[3] = shown;
            wo_image_at(&depth, x, y)[1] = shown ? (float)written(METRES, x, y) : -1;
        }
    assert_int_equal(wo_depth_check(&plain, &source, frame, &first, &report, NULL), WO_OK);
    assert_int_equal(report.warning_count, 0);
    source.depth_channel = 3; /* the last one there is: all 0 */
    assert_int_equal(
        wo_depth_check(&plain, &source, frame, &(wo_depth_clip){.name = "Depth4"}, &report, NULL),
        WO_OK);
    assert_int_equal(report.warning_count, 1);
    assert_string_equal(report.warnings[0].key, "depth-zero");
    assert_non_null(strstr(report.warnings[0].text, "Depth4: "));
    picture_free(&colour);
    picture_free(&depth);
}

static void depth_that_ends_early_is_told(void **state)
{
    (void)state;
    const struct {
        wo_rect bounds;
        bool told;
    } sizes[] = {
        {{0, 0, WIDTH, HEIGHT}, false},     {{-9, -9, WIDTH + 9, HEIGHT + 9}, false},
        {{1, 1, WIDTH - 1, HEIGHT}, false}, {{0, 0, WIDTH / 2, HEIGHT / 2}, true},
        {{0, 0, WIDTH, HEIGHT / 2}, true},  {{200, 0, 200 + WIDTH, HEIGHT}, true},
    };
    wo_image colour = picture_make(frame, 4);
    picture_fill(&colour, (const float[4]){0.5f, 0.5f, 0.5f, 1});
    for (size_t i = 0; i < WO_COUNT(sizes); i++) {
        wo_image depth = picture_make(sizes[i].bounds, 1);
        wo_report report = {.pixels = 0};
        picture_fill(&depth, (const float[1]){3});
        const wo_sheet_source source = {
            .colour = &colour, .depth = &depth, .reading = AS(DISTANCE, 1)};
        assert_int_equal(wo_depth_check(&plain, &source, frame, &first, &report, NULL), WO_OK);
        assert_int_equal(report.warning_count, sizes[i].told);
        if (sizes[i].told)
            assert_string_equal(report.warnings[0].key, "depth-size");
        picture_free(&depth);
    }
    /* A layer that is cut in the same way misses nothing. */
    wo_image depth = picture_make((wo_rect){5, 5, 25, 25}, 1);
    wo_report report = {.pixels = 0};
    picture_fill(&depth, (const float[1]){3});
    picture_fill(&colour, (const float[4]){0, 0, 0, 0});
    for (int32_t y = 5; y < 25; y++)
        for (int32_t x = 5; x < 25; x++)
            wo_image_at(&colour, x, y)[3] = 1;
    const wo_sheet_source source = {.colour = &colour, .depth = &depth, .reading = AS(DISTANCE, 1)};
    assert_int_equal(wo_depth_check(&plain, &source, frame, &other, &report, NULL), WO_OK);
    assert_int_equal(report.warning_count, 0);
    picture_free(&depth);
    picture_free(&colour);
}

/* Through the effect: in report and plan, also where nothing is blurred; less of a part. */
static void the_effect_warns(void **state)
{
    (void)state;
    wo_error error = {0};
    char text[4096];
    scene s;
    scene_init(&s, frame);
    picture_fill(scene_clip(&s, WO_CLIP_SOURCE, 4), (const float[4]){0.5f, 0.5f, 0.5f, 1});
    wo_image *const depth = scene_clip(&s, WO_CLIP_DEPTH, 1);
    s.params.samples = 1;
    s.params.focus_distance = 0; /* infinity: all of it is sharp */
    for (int zero = 0; zero < 2; zero++) {
        wo_report report = {.pixels = 0}, part = {.pixels = 0};
        for (int32_t y = 0; y < HEIGHT; y++)
            for (int32_t x = 0; x < WIDTH; x++)
                *wo_image_at(depth, x, y) = (float)written(zero ? NOTHING : CAMERA_SPACE, x, y);
        wo_image out = scene_render(&s, &report);
        assert_int_equal(report.warning_count, 1);
        assert_string_equal(report.warnings[0].key, zero ? "depth-zero" : "depth-negative");
        assert_int_equal(
            scene_run(&s, &plain, (wo_rect){0, 0, WIDTH, HEIGHT / 2}, &out, &part, &error), WO_OK);
        assert_int_equal(part.warning_count, zero ? 0 : 1);
        picture_free(&out);

        const wo_plan_args args = scene_args(&s, frame);
        wo_plan *plan = NULL;
        assert_int_equal(wo_lens_blur.plan_create(&plain, &s.params, &args, &plan, &error), WO_OK);
        assert_true(wo_lens_blur.plan_print(plan, text, sizeof text) < (int)sizeof text);
        assert_non_null(strstr(text, "\nwarning     Depth: "));
        assert_int_equal(wo_lens_blur.plan_report(plan)->warning_count, 1);
        wo_lens_blur.plan_destroy(&plan);
    }
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_programs_write_is_told_by_its_numbers),
        cmocka_unit_test(a_layer_may_be_sky_alone),
        cmocka_unit_test(a_part_is_judged_by_what_no_part_has),
        cmocka_unit_test(empty_pixels_do_not_count),
        cmocka_unit_test(depth_that_ends_early_is_told),
        cmocka_unit_test(the_effect_warns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
