/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/lens_diagram.h"

#include "near.h"

#include <math.h>
#include <string.h>

static wo_diagram make(wo_diagram_preset preset, double focal, double n, double residual)
{
    wo_diagram d;
    wo_error error = {WO_OK, ""};
    if (wo_diagram_make(preset, focal, n, residual, &d, &error) != WO_OK ||
        wo_diagram_validate(&d, &error) != WO_OK)
        fail_msg("%s", error.text);
    return d;
}

/* Outer radius for an object dv dioptres in front of the focus, over the one without aberration,
   and the density at the edge: the mean of the outermost hundredth of the disc's area. */
static double bokeh(const wo_diagram *d, double nm, double dv, double *edge)
{
    enum { RINGS = 20000 };
    double top = 0;
    for (int i = 1; i <= RINGS; i++) {
        const double rho = (double)i / RINGS;
        top = fmax(top, fabs(rho * (dv - wo_diagram_at(d, rho, nm))));
    }
    int inside = 0;
    for (int i = 0; i < RINGS; i++) {
        const double rho = sqrt((i + 0.5) / RINGS);
        const double r = rho * (dv - wo_diagram_at(d, rho, nm)) / top;
        inside += r * r > 0.99;
    }
    if (edge)
        *edge = inside / (0.01 * RINGS);
    return top / fabs(dv);
}

/* Kawase 2015: "front bokeh with red sharp edge, back bokeh with blue soft edge". */
static void singlet_edges(void **state)
{
    (void)state;
    const wo_diagram d = make(WO_DIAGRAM_SPHERICAL, 49.83, 1.9617, 1);
    /* The sensor 9 mm in front of and behind the paraxial focus of a distant point. Radii in mm
       traced through the lens: F 1.131 and C 1.269, F 4.304 and C 4.014. */
    const double f = 49.83e-3;
    const double front = 1 / (f - 9e-3) - 1 / f;
    const double back = 1 / (f + 9e-3) - 1 / f;
    double sharp, soft;
    const double mm_front = 12.7 * (f - 9e-3) * front;
    const double mm_back = 12.7 * (f + 9e-3) * -back;
    const double f_front = bokeh(&d, WO_NM_F, front, &sharp) * mm_front;
    const double c_front = bokeh(&d, WO_NM_C, front, NULL) * mm_front;
    const double f_back = bokeh(&d, WO_NM_F, back, &soft) * mm_back;
    const double c_back = bokeh(&d, WO_NM_C, back, NULL) * mm_back;
    assert_true(f_front < 0.95 * c_front && f_back > 1.05 * c_back);
    assert_close(f_front, 1.131, 0.05);
    assert_close(c_front, 1.269, 0.05);
    assert_close(f_back, 4.304, 0.05);
    assert_close(c_back, 4.014, 0.05);
    assert_true(sharp > 2 && soft < 0.6);
}

/* "Front bokeh has soft purple edge, back bokeh has sharp green edge". */
static void achromat_edges(void **state)
{
    (void)state;
    for (int type = WO_DIAGRAM_ACHROMAT_A; type <= WO_DIAGRAM_ACHROMAT_B; type++) {
        const wo_diagram d = make((wo_diagram_preset)type, 250, 4.922, 1);
        const double f = 0.25;
        const double nm[] = {WO_NM_F, WO_NM_D, WO_NM_C};
        const double front = 1 / (f - 5e-3) - 1 / f;
        const double back = 1 / (f + 5e-3) - 1 / f;
        double in_front[3], behind[3];
        for (int i = 0; i < 3; i++) {
            double edge;
            in_front[i] = bokeh(&d, nm[i], front, &edge) * 25.4 * (f - 5e-3) * front;
            assert_true(edge > 0.7 && edge < 0.97);
            behind[i] = bokeh(&d, nm[i], back, &edge) * 25.4 * (f + 5e-3) * -back;
            assert_true(edge > 1.03 && edge < 1.4);
        }
        assert_true(behind[1] > behind[2] && behind[1] > behind[0]);
        assert_true(in_front[1] < in_front[2] && in_front[1] < in_front[0]);
        if (type != WO_DIAGRAM_ACHROMAT_B)
            continue;
        const double traced_front[] = {0.546, 0.524, 0.532};
        const double traced_back[] = {0.475, 0.499, 0.490};
        for (int i = 0; i < 3; i++) {
            assert_close(in_front[i], traced_front[i], 0.015);
            assert_close(behind[i], traced_back[i], 0.015);
        }
    }
}

/* "The centre is darker in front and brighter behind" where the marginal rays focus short, and the
   other way round where they focus long. */
static void achromat_centre(void **state)
{
    (void)state;
    for (int type = WO_DIAGRAM_ACHROMAT_A; type <= WO_DIAGRAM_ACHROMAT_B; type++) {
        const wo_diagram d = make((wo_diagram_preset)type, 250, 4.922, 1);
        const double side = type == WO_DIAGRAM_ACHROMAT_A ? 1 : -1;
        const double front = bokeh(&d, WO_NM_D, 0.08, NULL);
        const double back = bokeh(&d, WO_NM_D, -0.08, NULL);
        assert_true(side * (front * front - 1) < -0.002);
        assert_true(side * (back * back - 1) > 0.002);
    }
}

static void asphere_has_colour_alone(void **state)
{
    (void)state;
    const wo_diagram d = make(WO_DIAGRAM_ASPHERICAL, 50, 2, 1);
    for (int i = 0; i <= 100; i++)
        assert_near(wo_diagram_at(&d, i / 100.0, WO_NM_D), 0, 1e-12);
    /* Power of N-BK7 at F and C against d: 1 / V_d in all. */
    const double f = wo_diagram_at(&d, 0, WO_NM_F);
    const double c = wo_diagram_at(&d, 0, WO_NM_C);
    assert_close((f - c) * 0.05, 1 / 64.167, 1e-3);
    assert_true(f > 0 && c < 0);
    double edge;
    assert_true(bokeh(&d, WO_NM_F, 1, NULL) < 0.9 * bokeh(&d, WO_NM_C, 1, NULL));
    bokeh(&d, WO_NM_D, 1, &edge);
    assert_near(edge, 1, 1e-3);
}

static void apochromat_is_even(void **state)
{
    (void)state;
    const wo_diagram d = make(WO_DIAGRAM_APOCHROMAT, 194, 2.9, 1);
    const double nm[] = {WO_NM_F, WO_NM_D, WO_NM_C};
    for (int side = -1; side <= 1; side += 2) {
        double low = 2, high = 0;
        for (int i = 0; i < 3; i++) {
            double edge;
            const double r = bokeh(&d, nm[i], side * 0.05 / 0.194, &edge);
            low = fmin(low, r);
            high = fmax(high, r);
            assert_near(edge, 1, 0.012);
        }
        assert_at_most(high / low, 1.004);
    }
}

static void scaling(void **state)
{
    (void)state;
    for (int type = 0; type < WO_DIAGRAM_PRESET_COUNT; type++) {
        const wo_diagram_preset preset = (wo_diagram_preset)type;
        const wo_diagram one = make(preset, 50, 2, 1);
        const wo_diagram longer = make(preset, 100, 2, 1);
        const wo_diagram half = make(preset, 50, 2, 0.5);
        const wo_diagram none = make(preset, 50, 2, 0);
        const wo_diagram slow = make(preset, 50, 4, 1);
        for (int l = 0; l < one.lines; l++) {
            for (int i = 0; i < one.zones; i++) {
                assert_near(longer.shift[l][i], one.shift[l][i] / 2, 1e-12);
                assert_near(half.shift[l][i], one.shift[l][i] / 2, 1e-12);
                assert_near(none.shift[l][i], 0, 0);
                assert_near(slow.shift[l][i] - slow.shift[l][0],
                            (one.shift[l][i] - one.shift[l][0]) / 4, 1e-12);
            }
            assert_near(one.shift[l][0], type == WO_DIAGRAM_PERFECT ? 0 : one.shift[l][0], 0);
        }
        assert_near(wo_diagram_at(&one, 0, WO_NM_D), 0, 1e-12);
    }
}

static void interpolation(void **state)
{
    (void)state;
    for (int type = 0; type < WO_DIAGRAM_PRESET_COUNT; type++) {
        const wo_diagram d = make((wo_diagram_preset)type, 50, 1.4, 1);
        for (int l = 0; l < d.lines; l++) {
            for (int i = 0; i < d.zones; i++)
                assert_near(wo_diagram_at(&d, i / 32.0, d.nm[l]), d.shift[l][i], 1e-12);

            for (int i = 0; i < 32; i++) {
                const double a = d.shift[l][i], b = d.shift[l][i + 1];
                for (int k = 1; k < 8; k++) {
                    const double y = wo_diagram_at(&d, (i + k / 8.0) / 32, d.nm[l]);
                    assert_true(y >= fmin(a, b) - 1e-12 && y <= fmax(a, b) + 1e-12);
                }
            }
        }
    }
    /* A zonal balance with its turning point: range 0.25. */
    wo_diagram smooth = {.zones = 33, .lines = 1, .nm = {500}};
    for (int i = 0; i < 33; i++)
        smooth.shift[0][i] = pow(i / 32.0, 2) - pow(i / 32.0, 4);
    for (int i = 0; i <= 1000; i++) {
        const double rho = i / 1000.0;
        assert_near(wo_diagram_at(&smooth, rho, 500), rho * rho - pow(rho, 4), 4e-4);
    }
    wo_diagram two = {.zones = 2, .lines = 2, .nm = {500, 600}, .shift = {{0, 1}, {2, 4}}};
    assert_near(wo_diagram_at(&two, 0.5, 500), 0.25, 1e-15);
    assert_near(wo_diagram_at(&two, 1, 550), 2.5, 1e-15);
}

static void any_place_is_finite(void **state)
{
    (void)state;
    const wo_diagram d = make(WO_DIAGRAM_SPHERICAL, 50, 2, 1);
    const double odd[] = {NAN, INFINITY, -INFINITY, -1, 0, 0.5, 1, 2, 400, 1e300, -1e300};
    for (size_t i = 0; i < WO_COUNT(odd); i++)
        for (size_t j = 0; j < WO_COUNT(odd); j++)
            assert_true(isfinite(wo_diagram_at(&d, odd[i], odd[j])));
    assert_near(wo_diagram_at(&d, 2, 1e9), d.shift[15][32], 0);
    assert_near(wo_diagram_at(&d, NAN, 0), d.shift[0][0], 0);
}

static void refused(void **state)
{
    (void)state;
    const double bad_focal[] = {0, -50, NAN, INFINITY, 0.5, 1e7};
    const double bad_stop[] = {0, -1, NAN, INFINITY, 0.1, 1e4};
    const double bad_residual[] = {-0.1, NAN, INFINITY, 11};
    wo_diagram d;
    wo_error error;
    for (size_t i = 0; i < WO_COUNT(bad_focal); i++)
        assert_int_equal(wo_diagram_make(WO_DIAGRAM_SPHERICAL, bad_focal[i], 2, 1, &d, &error),
                         WO_ERR_RANGE);
    for (size_t i = 0; i < WO_COUNT(bad_stop); i++)
        assert_int_equal(wo_diagram_make(WO_DIAGRAM_SPHERICAL, 50, bad_stop[i], 1, &d, &error),
                         WO_ERR_RANGE);
    for (size_t i = 0; i < WO_COUNT(bad_residual); i++)
        assert_int_equal(wo_diagram_make(WO_DIAGRAM_SPHERICAL, 50, 2, bad_residual[i], &d, &error),
                         WO_ERR_RANGE);
    assert_int_equal(wo_diagram_make((wo_diagram_preset)-1, 50, 2, 1, &d, NULL), WO_ERR_ARGUMENT);
    assert_int_equal(wo_diagram_make(WO_DIAGRAM_PRESET_COUNT, 50, 2, 1, &d, NULL), WO_ERR_ARGUMENT);
    for (int type = 0; type < WO_DIAGRAM_PRESET_COUNT; type++) {
        d = make((wo_diagram_preset)type, 1, 0.5, 10);
        d = make((wo_diagram_preset)type, 1e6, 1000, 10);
    }
    const wo_diagram good = d;
    d.zones = 1;
    assert_int_equal(wo_diagram_validate(&d, &error), WO_ERR_RANGE);
    d = good;
    d.zones = 34;
    assert_int_equal(wo_diagram_validate(&d, &error), WO_ERR_RANGE);
    d = good;
    d.lines = 0;
    assert_int_equal(wo_diagram_validate(&d, &error), WO_ERR_RANGE);
    d = good;
    d.lines = 17;
    assert_int_equal(wo_diagram_validate(&d, &error), WO_ERR_RANGE);
    d = good;
    d.nm[3] = d.nm[2];
    assert_int_equal(wo_diagram_validate(&d, &error), WO_ERR_RANGE);
    d = good;
    d.nm[0] = NAN;
    assert_int_equal(wo_diagram_validate(&d, &error), WO_ERR_RANGE);
    d = good;
    d.shift[2][7] = NAN;
    assert_int_equal(wo_diagram_validate(&d, &error), WO_ERR_RANGE);
    assert_non_null(strstr(error.text, "zone 7"));
    d = good;
    d.shift[15][32] = INFINITY;
    assert_int_equal(wo_diagram_validate(&d, &error), WO_ERR_RANGE);
}

typedef struct row {
    double radius, thickness;
    const char *glass;
} row;

static wo_prescription prescribe(const row *rows, int count, double semi)
{
    wo_prescription lens = {.name = "test", .count = count};
    for (int i = 0; i < count; i++) {
        wo_surface *const s = &lens.surface[i];
        s->curvature = rows[i].radius != 0 ? 1 / rows[i].radius : 0;
        s->thickness = rows[i].thickness;
        s->semi_aperture = semi;
        s->glass = rows[i].glass ? *wo_glass_find(rows[i].glass) : wo_glass_air();
        s->stop = i == 0;
    }
    return lens;
}

static const row singlet[] = {{0, 3, NULL}, {50.6, 5.2, "N-BK7"}, {-50.6, 48.2, NULL}};
static const row achromat[] = {
    {137.09, 7.5, "N-BK7"}, {-111.69, 2, "SF2"}, {-459.2, 244.676, NULL}};
static const double traced_nm[] = {435.83, WO_NM_F, WO_NM_D, WO_NM_C};

static void trace(const wo_prescription *lens, double n, double vf, wo_diagram *d)
{
    wo_error error = {WO_OK, ""};
    if (wo_diagram_of_lens(lens, n, vf, traced_nm, 4, d, &error) != WO_OK)
        fail_msg("%s", error.text);
}

/* The presets against the lenses they stand for, in units of 1/f, at equal heights. */
static void presets_are_those_lenses(void **state)
{
    (void)state;
    wo_prescription lens = prescribe(singlet, 3, 12.7);
    wo_diagram real;
    trace(&lens, 0, 0, &real);
    wo_diagram d = make(WO_DIAGRAM_SPHERICAL, 49.827, 1.9617, 1);
    for (int l = 0; l < 4; l++)
        for (int i = 0; i < 33; i++)
            assert_near(0.049827 * real.shift[l][i],
                        0.049827 *
                            wo_diagram_at(&d, i / 32.0 * real.radius / d.radius, traced_nm[l]),
                        60e-5);
    lens = prescribe(achromat, 3, 25.4);
    trace(&lens, 0, 0, &real);
    d = make(WO_DIAGRAM_ACHROMAT_B, 250.036, 4.922, 1);
    for (int l = 0; l < 4; l++)
        for (int i = 0; i < 33; i++)
            assert_near(0.250036 * real.shift[l][i],
                        0.250036 *
                            wo_diagram_at(&d, i / 32.0 * real.radius / d.radius, traced_nm[l]),
                        32e-5);
    /* Longitudinal aberrations in mm of a distant point, traced with the light. */
    const double dz[] = {0.348612, 0.120974, 0.207883};
    for (int l = 0; l < 3; l++)
        assert_close(real.shift[l + 1][32], -dz[l] / (250.036 * (250.036 + dz[l])) * 1e3, 0.02);
}

static void traced_lens_in_focus(void **state)
{
    (void)state;
    const wo_prescription lens = prescribe(achromat, 3, 25.4);
    const double focus[] = {-0.5, 0, 0.1, 1, 2.5};
    for (size_t i = 0; i < WO_COUNT(focus); i++) {
        wo_diagram d, narrow;
        trace(&lens, 0, focus[i], &d);
        assert_near(d.shift[2][0], 0, 1e-6);
        trace(&lens, 9.844, focus[i], &narrow);
        for (int l = 0; l < 4; l++)
            for (int z = 0; z < 33; z++)
                assert_near(narrow.shift[l][z],
                            wo_diagram_at(&d, z / 32.0 * narrow.radius / d.radius, traced_nm[l]),
                            3e-5);
    }
    wo_diagram d;
    wo_error error;
    assert_int_equal(wo_diagram_of_lens(&lens, -1, 0, traced_nm, 4, &d, &error), WO_ERR_RANGE);
    assert_int_equal(wo_diagram_of_lens(&lens, NAN, 0, traced_nm, 4, &d, &error), WO_ERR_RANGE);
    assert_int_equal(wo_diagram_of_lens(&lens, 0, NAN, traced_nm, 4, &d, &error), WO_ERR_RANGE);
    assert_int_equal(wo_diagram_of_lens(&lens, 0, 0, traced_nm, 0, &d, &error), WO_ERR_RANGE);
    assert_int_equal(wo_diagram_of_lens(&lens, 0, 0, traced_nm, 17, &d, &error), WO_ERR_RANGE);
    /* Focused on its own front focus, nothing reaches a sensor anywhere. */
    assert_true(wo_diagram_of_lens(&lens, 0, 1e3 / 249.31005, traced_nm, 4, &d, &error) != WO_OK);
    wo_prescription wide = prescribe(singlet, 3, 0);
    assert_int_equal(wo_diagram_of_lens(&wide, 0, 0, traced_nm, 4, &d, &error), WO_ERR_RANGE);
    /* Far less than f/0.4 gets through: the zones end with the rays. */
    wide.surface[0].semi_aperture = 100;
    trace(&wide, 0.4, 0, &d);
    assert_true(d.radius > 12.7 && d.radius < 0.5 * 49.83 / 0.4);
}

/* Every design of the library, focused at infinity and at 2 m, open and stopped down. */
static void designs(void **state)
{
    (void)state;
    int count = 0;
    for (const char *name; (name = wo_lens_name_at((size_t)count)) != NULL; count++) {
        wo_prescription lens;
        assert_int_equal(wo_lens_find(name, &lens, NULL), WO_OK);
        for (int i = 0; i < 4; i++) {
            wo_diagram d;
            wo_error error = {WO_OK, ""};
            const wo_status status =
                wo_diagram_of_lens(&lens, i < 2 ? 0 : 16, i % 2 * 0.5, traced_nm, 4, &d, &error);
            if (status != WO_OK)
                fail_msg("%s: %s", name, error.text);
            assert_int_equal(wo_diagram_validate(&d, NULL), WO_OK);
            assert_near(d.shift[2][0], 0, 2e-5);
        }
    }
    assert_true(count > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(singlet_edges),        cmocka_unit_test(achromat_edges),
        cmocka_unit_test(achromat_centre),      cmocka_unit_test(asphere_has_colour_alone),
        cmocka_unit_test(apochromat_is_even),   cmocka_unit_test(scaling),
        cmocka_unit_test(interpolation),        cmocka_unit_test(refused),
        cmocka_unit_test(any_place_is_finite),  cmocka_unit_test(presets_are_those_lenses),
        cmocka_unit_test(traced_lens_in_focus), cmocka_unit_test(designs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
