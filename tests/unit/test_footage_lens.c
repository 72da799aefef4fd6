/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "footage_test.h"

#include "camera.h"
#include "random.h"
#include "scenes.h"
#include "tests/property/cases.h"

/* Facts of a lens and a picture, in doubles and from the formulas of the contract. */
typedef struct lens {
    double k, vf, focal_px;
} lens;

static lens lens_of(const wo_footage_options *o)
{
    const double focal_px = o->width * o->focal_mm / 36,
                 radius = o->focal_mm * 1e-3 / (2 * o->f_stop);
    return (lens){focal_px * radius, 1 / o->focus_m, focal_px};
}

typedef struct moments {
    double sum, x, y, xx, yy; /* weight, centroid, variances */
} moments;

static moments measure(const wo_image *image)
{
    moments m = {0};
    for (int32_t y = image->bounds.y1; y < image->bounds.y2; y++)
        for (int32_t x = image->bounds.x1; x < image->bounds.x2; x++) {
            const double w = wo_image_at(image, x, y)[0], px = x + 0.5, py = y + 0.5;
            m.sum += w;
            m.x += w * px;
            m.y += w * py;
            m.xx += w * px * px;
            m.yy += w * py * py;
        }
    m.x /= m.sum;
    m.y /= m.sum;
    m.xx = m.xx / m.sum - m.x * m.x;
    m.yy = m.yy / m.sum - m.y * m.y;
    return m;
}

/* A disc of radius R has the variance R^2 / 4 in each direction; the lamp's own disc and the pixel
   add theirs. Place and amount of light are known as well. */
static void lamp_has_the_circle_of_confusion(void **state)
{
    (void)state;
    static const struct {
        double f_stop, focus;
    } cases[] = {{1.4, 4}, {1.4, 0.6}, {2.8, 4}, {0.95, 0.7}, {2, (double)INFINITY},
                 {4, -2},  {2.8, 0.4}};
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_footage_options o = {.scene = "lamp",
                                .width = 160,
                                .height = 90,
                                .samples = 1,
                                .reference_spp = 256,
                                .f_stop = cases[i].f_stop,
                                .focus_m = cases[i].focus};
        wo_footage *set = make_set(&o, 4);
        const lens l = lens_of(&set->options);
        const wo_lamp *const lamp = &wo_single_lamp;
        const double v = -1 / (double)lamp->centre.z, own = l.focal_px * lamp->radius * v;
        const double expected = fabs(l.k * (v - l.vf));
        const moments m = measure(&set->reference);
        const double variance = 0.5 * (m.xx + m.yy) - own * own / 4 - 1.0 / 12;
        const double found = 2 * sqrt(fmax(variance, 0));
        if (fabs(found - expected) > 0.1)
            fail_msg("f/%g at %g m: radius %g px, expected %g", cases[i].f_stop, cases[i].focus,
                     found, expected);
        assert_true(fabs(m.x - (80 + l.focal_px * lamp->centre.x * v)) < 0.05);
        assert_true(fabs(m.y - (45 + l.focal_px * lamp->centre.y * v)) < 0.05);
        const double light = lamp->radiance[0] * 3.14159265358979 * own * own;
        if (fabs(m.sum / light - 1) > 0.03)
            fail_msg("f/%g at %g m: light %g, expected %g", cases[i].f_stop, cases[i].focus, m.sum,
                     light);
        free_set(&set);
    }
}

/* How bright the picture of the aperture is at an angle and a part of its radius. */
static double brightness(const wo_footage *set, double radius, double degrees)
{
    const lens l = lens_of(&set->options);
    const double cx = set->options.width / 2.0 + l.focal_px * wo_single_lamp.centre.x;
    const double cy = set->options.height / 2.0 + l.focal_px * wo_single_lamp.centre.y;
    const double angle = degrees * 3.14159265358979 / 180;
    return wo_image_at(&set->reference, (int32_t)floor(cx + radius * cos(angle)),
                       (int32_t)floor(cy + radius * sin(angle)))[0];
}

/* The unfocused lamp shows the polygon: upright when it is farther than the focus, turned round
   when it is nearer, corners at the angle asked for. */
static void blades_make_a_polygon(void **state)
{
    (void)state;
    static const struct {
        int blades;
        double rotation, focus;
    } cases[] = {{5, 18, 4}, {5, 18, 0.55}, {3, 100, 4}, {6, -10, 4}, {7, 30, 0.55}};
    for (size_t i = 0; i < (size_t)cases_of(WO_COUNT(cases), 3); i++) {
        wo_footage_options o = {.scene = "lamp",
                                .width = 240,
                                .height = 136,
                                .samples = 1,
                                .reference_spp = 128,
                                .f_stop = 0.45,
                                .focus_m = cases[i].focus,
                                .blades = cases[i].blades,
                                .rotation = cases[i].rotation};
        wo_footage *set = make_set(&o, 4);
        const lens l = lens_of(&set->options);
        const double signed_radius = l.k * (1 - l.vf), radius = fabs(signed_radius);
        const double step = 360.0 / cases[i].blades;
        const double turn = cases[i].rotation + (signed_radius > 0 ? 180 : 0);
        const double side = radius * cos(step * 3.14159265358979 / 360);
        assert_true(radius > 12);
        const double middle = brightness(set, 0, 0);
        assert_true(middle > 0);
        for (int k = 0; k < cases[i].blades; k++) {
            const double corner = turn + k * step, flank = corner + step / 2;
            assert_true(brightness(set, radius - 3.5, corner) > 0.5 * middle);
            assert_true(brightness(set, radius + 2.5, corner) == 0);
            assert_true(brightness(set, side - 2.5, flank) > 0.5 * middle);
            assert_true(brightness(set, side + 2.5, flank) == 0);
        }
        /* As much light as through the full circle: the picture is a mean over the opening. */
        const double own = l.focal_px * wo_single_lamp.radius;
        const double light = wo_single_lamp.radiance[0] * 3.14159265358979 * own * own;
        assert_true(fabs(measure(&set->reference).sum / light - 1) < 0.03);
        free_set(&set);
    }
}

/* Mean difference, and root mean square difference, of red, green and blue. */
static double difference(const wo_image *a, const wo_image *b, double *bias)
{
    double squares = 0, sum = 0;
    int count = 0;
    for (int32_t y = a->bounds.y1; y < a->bounds.y2; y++)
        for (int32_t x = a->bounds.x1; x < a->bounds.x2; x++)
            for (int c = 0; c < 3; c++, count++) {
                const double d = (double)wo_image_at(a, x, y)[c] - wo_image_at(b, x, y)[c];
                squares += d * d;
                sum += d;
            }
    *bias = sum / count;
    return sqrt(squares / count);
}

/* Through a pinprick the lens sees what the pinhole sees. */
static void tiny_aperture_is_the_pinhole(void **state)
{
    (void)state;
    /* The cheapest to build first. */
    static const char *const names[] = {"two-planes", "slanted-plane", "fence",
                                        "still-life", "night-lights",  "hair"};
    for (size_t i = 0; i < (size_t)cases_of(WO_COUNT(names), 3); i++) {
        wo_footage_options o = {.scene = names[i],
                                .width = 64,
                                .height = 36,
                                .samples = 128,
                                .reference_spp = 128,
                                .f_stop = 20000};
        wo_footage *set = make_set(&o, 4);
        double bias, error_sum = 0;
        const double rms = difference(&set->colour, &set->reference, &bias);
        const wo_image *const e = &set->reference_error;
        for (size_t k = 0; k < image_bytes(e) / sizeof(float); k++)
            error_sum += (double)e->data[k] * e->data[k];
        const double expected = sqrt(error_sum / (double)(image_bytes(e) / sizeof(float)));
        /* The pinhole's own noise is at most about as large as that of the reference. */
        if (rms > 1.6 * expected + 1e-5 || fabs(bias) > 0.1 * expected + 1e-5)
            fail_msg("%s: differs by %g (mean %g), noise %g", names[i], rms, bias, expected);
        free_set(&set);
    }
}

/* Two references that share nothing but the scene differ by what their errors say. */
static void standard_error_is_honest(void **state)
{
    (void)state;
    static const char *const names[] = {"two-planes", "slanted-plane", "lamp"};
    static const int rays[] = {32, 32, 256};
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        wo_footage_options o = {.scene = names[i],
                                .width = 192,
                                .height = 108,
                                .samples = 1,
                                .reference_spp = rays[i],
                                .focus_m = i == 2 ? 0.35 : 1};
        wo_footage *a = make_set(&o, 4);
        o.seed = 77;
        wo_footage *b = make_set(&o, 4);
        double bias, expected = 0;
        const double found = difference(&a->reference, &b->reference, &bias);
        const size_t count = image_bytes(&a->reference_error) / sizeof(float);
        for (size_t k = 0; k < count; k++)
            expected += pow(a->reference_error.data[k], 2) + pow(b->reference_error.data[k], 2);
        expected = sqrt(expected / (double)count);
        assert_true(expected > 0);
        if (!(found > 0.85 * expected && found < 1.15 * expected))
            fail_msg("%s: differ by %g, expected %g", names[i], found, expected);
        assert_int_equal(a->batches, rays[i] >= 256 ? 16 : 8);
        free_set(&a);
        free_set(&b);
    }
}

static double shown(double value)
{
    const double x = fmin(fmax(value, 0), 1);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

/* The noise that is announced in dB is the one that is there. */
static void noise_psnr_is_honest(void **state)
{
    (void)state;
    wo_footage_options o = {
        .scene = "slanted-plane", .width = 96, .height = 54, .samples = 1, .reference_spp = 64};
    wo_footage *a = make_set(&o, 4);
    o.seed = 3;
    wo_footage *b = make_set(&o, 4);
    double squares = 0;
    for (int32_t y = 0; y < 54; y++)
        for (int32_t x = 0; x < 96; x++)
            for (int c = 0; c < 3; c++)
                squares += pow(shown(wo_image_at(&a->reference, x, y)[c]) -
                                   shown(wo_image_at(&b->reference, x, y)[c]),
                               2);
    const double found = -10 * log10(squares / (96 * 54 * 3) / 2);
    assert_true(fabs(found - a->noise_psnr) < 0.5);
    assert_true(fabs(found - b->noise_psnr) < 0.5);
    free_set(&a);
    free_set(&b);
}

/* More rays, less error: better than 1 / sqrt(n) never hurts, worse is a fault. */
static void error_falls_with_rays(void **state)
{
    (void)state;
    wo_footage_options o = {
        .scene = "fence", .width = 64, .height = 36, .samples = 1, .reference_spp = 64};
    wo_footage *few = make_set(&o, 4);
    o.reference_spp = 1024;
    wo_footage *many = make_set(&o, 4);
    assert_true(many->noise_psnr > few->noise_psnr + 11);
    free_set(&few);
    free_set(&many);
}

static void aperture_is_filled_evenly(void **state)
{
    (void)state;
    enum { COUNT = 4096 };
    for (int blades = 0; blades <= 8; blades = blades ? blades + 1 : 3) {
        wo_camera camera;
        wo_camera_make(100, 100, 50, 36, 2, 3, blades, 25, &camera);
        double area = wo_camera_area(&camera), x = 0, y = 0;
        int inside_half = 0;
        for (uint32_t i = 0; i < COUNT; i++) {
            uint32_t bits[WO_SOBOL_DIMENSIONS];
            wo_sobol_mirrored(i, bits);
            float u[2];
            wo_camera_aperture(&camera, wo_scrambled(bits[2], 1), wo_scrambled(bits[3], 2), u);
            x += u[0];
            y += u[1];
            const float shrunk[2] = {0.999f * u[0], 0.999f * u[1]};
            assert_true(wo_camera_open(&camera, shrunk));
            const float doubled[2] = {2 * u[0], 2 * u[1]};
            inside_half += wo_camera_open(&camera, doubled);
        }
        /* A quarter of the area is a quarter of the points. */
        assert_true(fabs(inside_half / (double)COUNT - 0.25) < 0.01);
        assert_true(fabs(x / COUNT) < 0.01 && fabs(y / COUNT) < 0.01);
        int open = 0;
        for (int i = 0; i < 400 * 400; i++) {
            const float u[2] = {((float)(i % 400) - 199.5f) / 200,
                                ((float)(i / 400) - 199.5f) / 200};
            open += wo_camera_open(&camera, u);
        }
        assert_true(fabs(open / (200.0 * 200.0) / area - 1) < 0.005);
    }
}

/* 16 points fall one into each cell of every grid of 16 equal boxes, scrambled or not. */
static void samples_are_stratified(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < 50; seed++)
        for (int columns = 1; columns <= 16; columns *= 2) {
            int met[16] = {0};
            for (uint32_t i = 0; i < 16; i++) {
                uint32_t bits[WO_SOBOL_DIMENSIONS];
                wo_sobol_mirrored(i, bits);
                const int x = (int)(wo_scrambled(bits[0], wo_stir(seed, 0)) * (float)columns);
                const int y =
                    (int)(wo_scrambled(bits[1], wo_stir(seed, 1)) * (float)(16 / columns));
                met[y * columns + x]++;
            }
            for (int i = 0; i < 16; i++)
                assert_int_equal(met[i], 1);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamp_has_the_circle_of_confusion),
        cmocka_unit_test(blades_make_a_polygon),
        cmocka_unit_test(tiny_aperture_is_the_pinhole),
        cmocka_unit_test(standard_error_is_honest),
        cmocka_unit_test(noise_psnr_is_honest),
        cmocka_unit_test(error_falls_with_rays),
        cmocka_unit_test(aperture_is_filled_evenly),
        cmocka_unit_test(samples_are_stratified),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
