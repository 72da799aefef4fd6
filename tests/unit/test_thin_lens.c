/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/optics.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

static wo_thin_lens lens_of(double focal_mm, double sensor_mm, double f_stop, double focus_m,
                            bool breathing, double width_px)
{
    wo_thin_lens lens;
    wo_error error = {WO_OK, ""};
    if (wo_thin_lens_make(focal_mm, sensor_mm, f_stop, focus_m, breathing, width_px, &lens,
                          &error) != WO_OK)
        fail_msg("%s", error.text);
    return lens;
}

/* Diameter on the sensor, in metres, of the circle of confusion as the text books give it: similar
   triangles behind a lens of diameter f / N whose image distance for the focus is s. */
static double textbook_diameter(double f, double n, double s, double df, double d)
{
    return f / n * s * fabs(d - df) / (d * df);
}

static void closed_form(void **state)
{
    (void)state;
    rng r = {1};
    for (int i = 0; i < 2000; i++) {
        const double f = exp(rng_range(&r, log(4), log(800)));
        const double sensor = rng_range(&r, 4, 70);
        const double n = exp(rng_range(&r, log(0.5), log(32)));
        const double df = exp(rng_range(&r, log(1), log(1000)));
        const double d = exp(rng_range(&r, log(0.05), log(1e4)));
        const double width = rng_int(&r, 1, 8192);
        /* The difference of vergences loses digits near the focus, whatever the formula. */
        const double tolerance = 1e-9 + 4e-16 * (d + df) / fabs(d - df);
        const wo_thin_lens cg = lens_of(f, sensor, n, df, false, width);
        const double c = textbook_diameter(f * 1e-3, n, f * 1e-3, df, d);
        assert_close(wo_thin_lens_coc(&cg, 1 / d), c / 2 * width / (sensor * 1e-3), tolerance);
        assert_close(cg.focal_px, width * f / sensor, 1e-12);
        assert_close(cg.vf, 1 / df, 1e-15);
        const wo_thin_lens real = lens_of(f, sensor, n, df, true, width);
        const double s = f * 1e-3 * df / (df - f * 1e-3);
        const double c_real = textbook_diameter(f * 1e-3, n, s, df, d);
        assert_close(wo_thin_lens_coc(&real, 1 / d), c_real / 2 * width / (sensor * 1e-3),
                     tolerance);
    }
}

static void one_lens_by_hand(void **state)
{
    (void)state;
    /* 50 mm f/2 focused at 2 m, object at 1 m: f^2 / N * 1 / 2 = 0.625 mm across on the sensor. */
    const wo_thin_lens lens = lens_of(50, 36, 2, 2, false, 1920);
    assert_close(wo_thin_lens_coc(&lens, 1), 0.625 / 2 / 36 * 1920, 1e-12);
    /* At infinity f^2 / (N df) = 0.625 mm too. */
    assert_close(wo_thin_lens_coc(&lens, 0), 0.625 / 2 / 36 * 1920, 1e-12);
    assert_true(wo_thin_lens_coc(&lens, lens.vf) == 0);
    /* Breathing stretches it by s / f = df / (df - f). */
    const wo_thin_lens real = lens_of(50, 36, 2, 2, true, 1920);
    assert_close(wo_thin_lens_coc(&real, 1), 0.625 / 2 / 36 * 1920 * 2 / 1.95, 1e-12);
    assert_close(real.focal_px, 1920 * 50.0 / 36 * 2 / 1.95, 1e-12);
}

static void focus_at_infinity_and_beyond(void **state)
{
    (void)state;
    const wo_thin_lens far = lens_of(50, 36, 2, 0, false, 1000);
    assert_true(far.vf == 0);
    assert_true(wo_thin_lens_coc(&far, 0) == 0);
    /* f^2 / (N d) on the sensor. */
    assert_close(wo_thin_lens_coc(&far, 1 / 5.0), 0.05 * 0.05 / (2 * 5) / 2 * 1000 / 0.036, 1e-12);
    const wo_thin_lens far_breathing = lens_of(50, 36, 2, 0, true, 1000);
    assert_close(far_breathing.k, far.k, 1e-15);
    const wo_thin_lens beyond = lens_of(50, 36, 2, -4, false, 1000);
    assert_close(beyond.vf, -0.25, 1e-15);
    assert_close(wo_thin_lens_coc(&beyond, 0), 0.25 * far.k, 1e-12);
    assert_true(wo_thin_lens_coc(&beyond, 1) > wo_thin_lens_coc(&beyond, 0));
    /* Beyond infinity the lens moves closer to the sensor. */
    assert_true(lens_of(50, 36, 2, -4, true, 1000).focal_px < far.focal_px);
}

static void scales(void **state)
{
    (void)state;
    const wo_thin_lens lens = lens_of(85, 24, 1.4, 3, false, 640);
    assert_close(lens_of(85, 24, 2.8, 3, false, 640).k, lens.k / 2, 1e-14);
    assert_close(lens_of(170, 24, 1.4, 3, false, 640).k, lens.k * 4, 1e-14);
    assert_close(lens_of(85, 48, 1.4, 3, false, 640).k, lens.k / 2, 1e-14);
    assert_close(lens_of(85, 24, 1.4, 3, false, 320).k, lens.k / 2, 1e-14);
    double last = INFINITY;
    for (int i = 0; i <= 40; i++) {
        const double c = wo_thin_lens_coc(&lens, lens.vf * i / 40);
        assert_true(c < last);
        last = c;
    }
    for (int i = 41; i <= 400; i++) {
        const double c = wo_thin_lens_coc(&lens, lens.vf * i / 40);
        assert_true(c > last);
        last = c;
    }
}

static void refused_values(void **state)
{
    (void)state;
    const struct {
        double focal, sensor, f_stop, focus, width;
        int breathing;
        const char *word;
    } bad[] = {
        {0, 36, 2, 2, 100, 0, "focal length"},
        {-50, 36, 2, 2, 100, 0, "focal length"},
        {NAN, 36, 2, 2, 100, 0, "focal length"},
        {INFINITY, 36, 2, 2, 100, 0, "focal length"},
        {50, 0, 2, 2, 100, 0, "sensor"},
        {50, -1, 2, 2, 100, 0, "sensor"},
        {50, NAN, 2, 2, 100, 0, "sensor"},
        {50, INFINITY, 2, 2, 100, 0, "sensor"},
        {50, 36, 0, 2, 100, 0, "f-number"},
        {50, 36, -2, 2, 100, 0, "f-number"},
        {50, 36, NAN, 2, 100, 0, "f-number"},
        {50, 36, INFINITY, 2, 100, 0, "f-number"},
        {50, 36, 2, NAN, 100, 0, "focus"},
        {50, 36, 2, INFINITY, 100, 0, "focus"},
        {50, 36, 2, 2, 0, 0, "width"},
        {50, 36, 2, 2, -5, 0, "width"},
        {50, 36, 2, 2, NAN, 0, "width"},
        {50, 36, 2, 2, INFINITY, 0, "width"},
        {50, 36, 2, 0.05, 100, 1, "focal length"},
        {50, 36, 2, 0.01, 100, 1, "focal length"},
    };
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        wo_thin_lens lens = {9, 9, 9};
        wo_error error = {WO_OK, ""};
        const wo_status status =
            wo_thin_lens_make(bad[i].focal, bad[i].sensor, bad[i].f_stop, bad[i].focus,
                              bad[i].breathing != 0, bad[i].width, &lens, &error);
        if (status != WO_ERR_RANGE || !strstr(error.text, bad[i].word))
            print_error("row %zu: status %d, \"%s\"\n", i, (int)status, error.text);
        assert_int_equal(status, WO_ERR_RANGE);
        assert_int_equal(error.status, WO_ERR_RANGE);
        assert_non_null(strstr(error.text, bad[i].word));
        assert_true(lens.k == 0 && lens.vf == 0 && lens.focal_px == 0);
    }
    wo_thin_lens lens;
    assert_int_equal(wo_thin_lens_make(50, 36, 0, 2, false, 100, &lens, NULL), WO_ERR_RANGE);
    /* Without breathing a focus inside the focal length is a number like any other. */
    assert_close(lens_of(50, 36, 2, 0.01, false, 100).vf, 100, 1e-12);
}

static void odd_lenses_stay_finite(void **state)
{
    (void)state;
    const double focus[] = {0, 1e-300, -1e-300, 1e-9, -1e-9, 1e9, -1e9, 1e-4, 3};
    for (size_t i = 0; i < WO_COUNT(focus); i++) {
        for (int breathing = 0; breathing < 2; breathing++) {
            wo_thin_lens lens;
            wo_error error = {WO_OK, ""};
            if (wo_thin_lens_make(50, 36, 0.01, focus[i], breathing != 0, 65536, &lens, &error) !=
                WO_OK) {
                assert_true(error.text[0] != 0);
                continue;
            }
            assert_true(isfinite(lens.k) && lens.k > 0);
            assert_true(isfinite(lens.vf) && isfinite(lens.focal_px));
            assert_true(isfinite(wo_thin_lens_coc(&lens, WO_VERGENCE_MAX)));
            /* The renderer counts vergences in floats. */
            assert_true(lens.k > 1e-30 && lens.k < 1e30);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_form),
        cmocka_unit_test(one_lens_by_hand),
        cmocka_unit_test(focus_at_infinity_and_beyond),
        cmocka_unit_test(scales),
        cmocka_unit_test(refused_values),
        cmocka_unit_test(odd_lenses_stay_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
