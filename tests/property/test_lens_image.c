/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "near.h"
#include "scenes.h"

#include <string.h>

#define PI 3.14159265358979323846

/* One bright pixel on black, everything at one depth: the picture of it is the aperture. */
enum { LIGHT_X = 20, LIGHT_Y = -3 };
static const wo_rect frame = {-60, -70, 100, 66};

typedef struct light {
    double blur; /* px of radius, negative = in front of the focus */
    int blades;
    double rotation, aspect, stretch;
    double level;    /* of the light */
    double floating; /* the light's own depth; 0 = as everything */
} light;

static scene light_scene(const light *l)
{
    scene s;
    scene_init(&s, frame);
    s.geometry.pixel_stretch = l->stretch;
    s.params.focal_length = 200;
    s.params.focus_distance = 2;
    s.params.blades = l->blades;
    s.params.rotation = l->rotation;
    s.params.aspect = l->aspect;
    s.params.samples = 256;
    const double z = l->blur < 0 ? 1.25 : 8;
    scene_px_per_dioptre(&s, fabs(l->blur) / fabs(1 / z - 0.5));
    const float black[4] = {0, 0, 0, 1};
    const float back = (float)(l->floating > 0 ? l->floating : z);
    picture_fill(scene_clip(&s, WO_CLIP_SOURCE, 4), black);
    picture_fill(scene_clip(&s, WO_CLIP_DEPTH, 1), &back);
    float *const c = wo_image_at(&s.clip[WO_CLIP_SOURCE], LIGHT_X, LIGHT_Y);
    c[0] = (float)l->level;
    c[1] = (float)(0.5 * l->level);
    *wo_image_at(&s.clip[WO_CLIP_DEPTH], LIGHT_X, LIGHT_Y) = (float)z;
    return s;
}

static double sum_of(const wo_image *out, int channel)
{
    double sum = 0;
    for (int32_t y = out->bounds.y1; y < out->bounds.y2; y++)
        for (int32_t x = out->bounds.x1; x < out->bounds.x2; x++)
            sum += (double)wo_image_at(out, x, y)[channel];
    return sum;
}

/* Farthest that the lit pixels reach in a direction, from the light's pixel, px. */
static double support(const wo_image *out, double angle, double limit)
{
    double far = -INFINITY;
    for (int32_t y = out->bounds.y1; y < out->bounds.y2; y++)
        for (int32_t x = out->bounds.x1; x < out->bounds.x2; x++)
            if ((double)wo_image_at(out, x, y)[0] > limit)
                far = fmax(far, (x - LIGHT_X) * cos(angle) + (y - LIGHT_Y) * sin(angle));
    return far;
}

/* Where an offset from the light lies in the closed-form picture of the aperture: 1 on its border,
   below 1 inside. *px: how many px that border moves for a change of 1, at least. */
static double closed_form(const light *l, double dx, double dy, double *px)
{
    /* Behind the focus (positive blur) upright, in front of it upside down. */
    const double wide = l->blur * (l->aspect < 1 ? l->aspect : 1);
    const double high = l->blur * (l->aspect > 1 ? 1 / l->aspect : 1) * l->stretch;
    const double x = dx / wide;
    const double y = dy / high;
    *px = fmin(fabs(wide), fabs(high));
    if (l->blades == 0)
        return hypot(x, y);
    const double flat = cos(PI / l->blades);
    double most = -INFINITY;
    *px *= flat;
    for (int i = 0; i < l->blades; i++) {
        const double a = l->rotation * PI / 180 + PI * (2 * i + 1) / l->blades;
        most = fmax(most, (x * cos(a) + y * sin(a)) / flat);
    }
    return most;
}

static double aperture_area(const light *l)
{
    const double squeeze = l->aspect < 1 ? l->aspect : 1 / l->aspect;
    const double unit = l->blades ? 0.5 * l->blades * sin(2 * PI / l->blades) : PI;
    return unit * squeeze * l->stretch * l->blur * l->blur;
}

static const light lights[] = {
    {12, 0, 0, 1, 1, 5000, 0},     {-12, 0, 0, 1, 1, 5000, 0},    {12.4, 6, 17, 1, 1, 5000, 0},
    {-12.4, 6, 17, 1, 1, 5000, 0}, {25, 3, 0, 1, 1, 5000, 0},     {-25, 3, 0, 1, 1, 5000, 0},
    {25, 3, 90, 1, 1, 5000, 0},    {-25, 3, 90, 1, 1, 5000, 0},   {17, 5, 33, 1, 1, 5000, 0},
    {-17, 5, 33, 1, 1, 5000, 0},   {20, 0, 0, 0.5, 1, 5000, 0},   {-20, 5, 12, 1.8, 1, 5000, 0},
    {11, 0, 0, 1, 2, 5000, 0},     {-11, 3, 40, 1, 0.5, 5000, 0}, {3.3, 0, 0, 1, 1, 5000, 0},
    {-30, 0, 0, 1, 1, 5000, 0},    {-12, 0, 0, 1, 1, 5000, 6},    {-19, 3, 10, 1, 1, 5000, 2.5},
};

static void a_light_shows_the_aperture(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(lights); i++) {
        const light *const l = &lights[i];
        scene s = light_scene(l);
        wo_image out = scene_render(&s, NULL);
        assert_close(sum_of(&out, 0), l->level, 1e-3);
        assert_close(sum_of(&out, 1), 0.5 * l->level, 1e-3);
        assert_near(sum_of(&out, 2), 0, 0);
        /* Evenly lit; the rays' own noise stays far below half of it. */
        const double even = l->level / aperture_area(l);
        for (int32_t y = frame.y1; y < frame.y2; y++)
            for (int32_t x = frame.x1; x < frame.x2; x++) {
                double px;
                const double at = closed_form(l, x - LIGHT_X, y - LIGHT_Y, &px);
                const bool lit = (double)wo_image_at(&out, x, y)[0] > even / 2;
                if (fabs(at - 1) * px > 0.5 && lit != (at < 1)) {
                    print_error("light %zu: pixel %d,%d\n", i, x - LIGHT_X, y - LIGHT_Y);
                    fail();
                }
            }
        picture_free(&out);
        scene_free(&s);
    }
}

/* Whatever the aperture lets through, and where: a light keeps its energy. */
static void every_aperture_keeps_the_light(void **state)
{
    (void)state;
    static const struct {
        const char *key;
        double value;
    } options[][4] = {
        {{"blades", 5}, {"opening", 0.5}},
        {{"apertureForm", 1}, {"obstruction", 0.3}},
        {{"apertureForm", 2}, {"rotation", 15}, {"edge", -0.7}},
        {{"obstruction", 0.6}},
        {{"apodization", 1}},
        {{"edge", 1}, {"blades", 7}},
        {{"ringAmount", 0.8}, {"ringCount", 6}, {"aspect", 0.6}},
        {{"grainAmount", 1}, {"grainSeed", 3}, {"apodization", 0.3}, {"blades", 6}},
    };
    for (size_t i = 0; i < 2 * WO_COUNT(options); i++) {
        const light l = {i % 2 ? 23.3 : -17, 0, 0, 1, 1, 5000, 0};
        scene s = light_scene(&l);
        for (size_t k = 0; k < 4 && options[i / 2][k].key; k++) {
            const double values[3] = {options[i / 2][k].value};
            const wo_param *row =
                wo_param_find(wo_lens_blur_table, WO_LENS_BLUR_PARAMS, options[i / 2][k].key);
            assert_int_equal(wo_param_set(row, &s.params, values, NULL), WO_OK);
        }
        wo_image out = scene_render(&s, NULL);
        assert_close(sum_of(&out, 0), l.level, 1e-3);
        assert_close(sum_of(&out, 1), 0.5 * l.level, 1e-3);
        picture_free(&out);
        scene_free(&s);
    }
    /* Three slits so narrow that no pixel's centre sees the light: its rays still do. */
    const light tiny = {3.3, 3, 0, 1, 1, 5000, 0};
    scene slits = light_scene(&tiny);
    slits.params.obstruction = WO_OBSTRUCTION_MAX;
    wo_image seen = scene_render(&slits, NULL);
    assert_close(sum_of(&seen, 0), tiny.level, 0.05);
    picture_free(&seen);
    scene_free(&slits);
    /* Seen in the picture: the hole of a ring, and the smooth rim of an apodized disc. */
    const light wide = {24, 0, 0, 1, 1, 5000, 0};
    scene s = light_scene(&wide);
    s.params.obstruction = 0.5;
    wo_image out = scene_render(&s, NULL);
    const double even = wide.level / (aperture_area(&wide) * 0.75);
    assert_near((double)wo_image_at(&out, LIGHT_X + 3, LIGHT_Y + 8)[0], 0, 0.02 * even);
    assert_close((double)wo_image_at(&out, LIGHT_X + 18, LIGHT_Y)[0], even, 0.05);
    picture_free(&out);
    s.params.obstruction = 0;
    s.params.apodization = 0.5;
    out = scene_render(&s, NULL);
    const double middle = (double)wo_image_at(&out, LIGHT_X, LIGHT_Y)[0];
    for (int32_t x = 0; x < 24; x++)
        assert_near((double)wo_image_at(&out, LIGHT_X + x, LIGHT_Y)[0],
                    middle * pow(10, -x * x / (24.0 * 24.0)), 0.05 * middle);
    picture_free(&out);
    scene_free(&s);
}

/* Larger than the picture of the aperture is counted pixel by pixel. */
static void a_large_picture_keeps_its_light(void **state)
{
    (void)state;
    const light large[] = {
        {300, 0, 0, 1, 1, 1e7, 0}, {-400, 4, 20, 1, 1, 1e7, 0}, {-300, 7, 10, 0.7, 1, 1e7, 0}};
    for (size_t i = 0; i < WO_COUNT(large); i++) {
        scene s = light_scene(&large[i]);
        s.params.max_radius = 500;
        s.params.samples = 1;
        wo_image out = scene_render(&s, NULL);
        /* The whole of this frame lies inside: each pixel gets the same. */
        const double even = large[i].level / aperture_area(&large[i]);
        for (int32_t y = frame.y1; y < frame.y2; y += 9)
            for (int32_t x = frame.x1; x < frame.x2; x += 9)
                assert_close((double)wo_image_at(&out, x, y)[0], even, 1e-3);
        picture_free(&out);
        scene_free(&s);
    }
}

/* Too dark to be connected one by one: found by the rays alone. */
static void dim_lights_keep_their_energy(void **state)
{
    (void)state;
    const light dim[] = {
        {9, 0, 0, 1, 1, 3.5, 0}, {-9, 6, 0, 1, 1, 3.5, 0}, {-14, 0, 0, 1, 1, 3.5, 6}};
    for (size_t i = 0; i < WO_COUNT(dim); i++) {
        scene s = light_scene(&dim[i]);
        s.params.samples = 2048;
        wo_image out = scene_render(&s, NULL);
        assert_close(sum_of(&out, 0), dim[i].level, 0.02);
        assert_near(support(&out, 0, 0), fabs(dim[i].blur), 1);
        picture_free(&out);
        scene_free(&s);
    }
}

/* Root of the mean square distance of the light from its middle, in x. */
static double spread(const wo_image *out)
{
    double sum = 0;
    double mean = 0;
    double square = 0;
    for (int32_t y = out->bounds.y1; y < out->bounds.y2; y++)
        for (int32_t x = out->bounds.x1; x < out->bounds.x2; x++) {
            const double c = (double)wo_image_at(out, x, y)[0];
            sum += c;
            mean += c * x;
            square += c * x * x;
        }
    mean /= sum;
    return sqrt(square / sum - mean * mean);
}

/* The same picture at half the size: half the radius, also where the largest radius cuts it. */
static void half_the_scale_is_half_the_blur(void **state)
{
    (void)state;
    const double cuts[] = {100, 15};
    for (size_t i = 0; i < WO_COUNT(cuts); i++) {
        const light big = {24, 0, 0, 1, 1, 5000, 0};
        scene s = light_scene(&big);
        s.params.max_radius = cuts[i];
        wo_image whole = scene_render(&s, NULL);
        const double z = (double)wo_image_at(&s.clip[WO_CLIP_DEPTH], 0, 0)[0];
        scene half;
        scene_init(&half, (wo_rect){frame.x1 / 2, frame.y1 / 2, frame.x2 / 2, frame.y2 / 2});
        half.params = s.params;
        half.geometry.render_scale = 0.5;
        picture_fill(scene_clip(&half, WO_CLIP_SOURCE, 4), (const float[4]){0, 0, 0, 1});
        picture_fill(scene_clip(&half, WO_CLIP_DEPTH, 1), (const float[1]){(float)z});
        wo_image_at(&half.clip[WO_CLIP_SOURCE], 10, -2)[0] = 5000;
        wo_image small = scene_render(&half, NULL);
        const double radius = fmin(24, cuts[i]);
        assert_close(spread(&whole), radius / 2, 0.01);
        assert_close(spread(&small), radius / 4, 0.02);
        picture_free(&whole);
        picture_free(&small);
        scene_free(&s);
        scene_free(&half);
    }
}

/* Two planes: the view of the circle of confusion against f^2 / N |d - df| / (d df) / 2. */
static void circles_of_confusion(void **state)
{
    (void)state;
    const double focus[] = {2, 0, -5, 0.4};
    for (size_t i = 0; i < WO_COUNT(focus); i++) {
        for (int breathing = 0; breathing < 2; breathing++) {
            scene s;
            scene_init(&s, (wo_rect){0, 0, 192, 40});
            s.params.focal_length = 35;
            s.params.f_stop = 1.2;
            s.params.focus_distance = focus[i];
            s.params.breathing = breathing;
            s.params.output = WO_OUTPUT_COC;
            wo_image *const source = scene_clip(&s, WO_CLIP_SOURCE, 4);
            wo_image *const depth = scene_clip(&s, WO_CLIP_DEPTH, 1);
            picture_fill(source, (const float[4]){0.2f, 0.3f, 0.4f, 1});
            const double z[2] = {1.3, 7};
            for (int32_t y = 0; y < 40; y++)
                for (int32_t x = 0; x < 192; x++)
                    *wo_image_at(depth, x, y) = (float)z[x >= 100];
            wo_image out = scene_render(&s, NULL);
            s.params.output = WO_OUTPUT_DEPTH;
            wo_image metres = scene_render(&s, NULL);
            const double f = 0.035;
            const double vf = focus[i] != 0 ? 1 / focus[i] : 0;
            const double image = breathing ? 1 / (1 / f - vf) : f;
            for (int32_t y = 0; y < 40; y++)
                for (int32_t x = 0; x < 192; x++) {
                    const double d = (double)(float)z[x >= 100];
                    const double c = f / 1.2 * image * (1 / d - vf) / 2 * 192 / 0.036;
                    assert_near((double)wo_image_at(&out, x, y)[0], c, 0.01);
                    assert_near((double)wo_image_at(&out, x, y)[2], c, 0.01);
                    assert_close((double)wo_image_at(&metres, x, y)[1], d, 1e-5);
                }
            picture_free(&out);
            picture_free(&metres);
            scene_free(&s);
        }
    }
}

/* The edge of a plane in front of a black one: as wide as twice its circle of confusion, in the
   form of the disc's own edge. */
static void edges_spread_by_the_closed_form(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, (wo_rect){0, 0, 160, 32});
    s.params.focus_distance = 3;
    scene_px_per_dioptre(&s, 30); /* near plane at 1 m: 20 px; far one at 3 m: sharp */
    s.params.samples = 1024;
    wo_image *const source = scene_clip(&s, WO_CLIP_SOURCE, 4);
    wo_image *const depth = scene_clip(&s, WO_CLIP_DEPTH, 1);
    picture_fill(source, (const float[4]){0, 0, 0, 1});
    picture_fill(depth, (const float[1]){3});
    for (int32_t y = 0; y < 32; y++)
        for (int32_t x = 0; x < 80; x++) {
            wo_image_at(source, x, y)[0] = 1;
            *wo_image_at(depth, x, y) = 1;
        }
    wo_image out = scene_render(&s, NULL);
    for (int32_t x = 50; x < 110; x++) {
        double mean = 0;
        for (int32_t y = 8; y < 24; y++)
            mean += (double)wo_image_at(&out, x, y)[0] / 16;
        /* Part of a disc of 20 px around the pixel that lies left of x = 80. */
        const double t = fmin(fmax((80 - (x + 0.5)) / 20, -1), 1);
        const double part = 0.5 + (t * sqrt(1 - t * t) + asin(t)) / PI;
        assert_near(mean, part, 0.02);
    }
    picture_free(&out);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_light_shows_the_aperture),
        cmocka_unit_test(every_aperture_keeps_the_light),
        cmocka_unit_test(a_large_picture_keeps_its_light),
        cmocka_unit_test(dim_lights_keep_their_energy),
        cmocka_unit_test(half_the_scale_is_half_the_blur),
        cmocka_unit_test(circles_of_confusion),
        cmocka_unit_test(edges_spread_by_the_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
