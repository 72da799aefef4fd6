/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Which places of the iris light comes through: exact lenses against a search of all slopes, which
   knows nothing of how they aim; and what pencils promise of lenses that no survey gets to know. */
#include "base/simd.h"
#include "cases.h"
#include "lens_test.h"
#include "optics/pencil_table.h"
#include "scenes.h"
#include "wideopen/aperture.h"

#include <stdlib.h>

/* Where a ray from place s of the iris lands; false when it does not get to the sensor. */
static bool land(const wo_exact_lens *lens, const double s[2], double p, double q, unsigned flags,
                 double at[2])
{
    const wo_system *system = &lens->reference;
    const double n = 1 / sqrt(1 + p * p + q * q);
    const test_ray r = trace_ray(
        system, system->stop, system->count - 1, false, flags,
        (test_ray){.p = {s[0], s[1], system->surface[system->stop].z}, .d = {p * n, q * n, n}});
    const double t = (lens->sensor_z - r.p[2]) / r.d[2];
    at[0] = r.p[0] + t * r.d[0];
    at[1] = r.p[1] + t * r.d[1];
    return r.outcome == WO_RAY_PASSED;
}

/* Back to the scene, through all clear radii. */
static bool leaves(const wo_exact_lens *lens, const double s[2], double p, double q)
{
    const wo_system *system = &lens->reference;
    const double n = -1 / sqrt(1 + p * p + q * q);
    return system->stop == 0 ||
           trace_ray(system, 0, system->stop - 1, true, WO_TRACE_CLIP,
                     (test_ray){.p = {s[0], s[1], system->surface[system->stop].z},
                                .d = {p * n, q * n, n}})
                   .outcome == WO_RAY_PASSED;
}

/* Newton's method from the middle of a square of slopes; true for a ray that gets through. */
static bool refine(const wo_exact_lens *lens, const double s[2], double x, double p, double q)
{
    const double h = 1e-6;
    double at[2] = {INFINITY, INFINITY};
    for (int i = 0; i < 30 && !(hypot(at[0] - x, at[1]) < 1e-8); i++) {
        double px[2];
        double py[2];
        if (i > 0) {
            if (!land(lens, s, p + h, q, 0, px) || !land(lens, s, p, q + h, 0, py))
                return false;
            const double a = (px[0] - at[0]) / h;
            const double b = (py[0] - at[0]) / h;
            const double c = (px[1] - at[1]) / h;
            const double d = (py[1] - at[1]) / h;
            p -= (d * (at[0] - x) - b * at[1]) / (a * d - b * c);
            q -= (a * at[1] - c * (at[0] - x)) / (a * d - b * c);
        }
        if (!land(lens, s, p, q, 0, at))
            return false;
    }
    return hypot(at[0] - x, at[1]) < 1e-8 && land(lens, s, p, q, WO_TRACE_CLIP, at) &&
           leaves(lens, s, p, q);
}

/* Is there a ray from s to (x, 0) on the sensor? Looks at squares of a grid of slopes whose corners
   land around it. */
static bool search(const wo_exact_lens *lens, const double s[2], double x)
{
    enum { GRID = 120 };
    static double at[GRID + 1][GRID + 1][2];
    static bool lands[GRID + 1][GRID + 1];
    const double most = 1.6;
    const double step = 2 * most / GRID;
    for (int i = 0; i <= GRID; i++)
        for (int j = 0; j <= GRID; j++)
            lands[i][j] = land(lens, s, i * step - most, j * step - most, 0, at[i][j]);
    for (int i = 0; i < GRID; i++)
        for (int j = 0; j < GRID; j++) {
            double low[2] = {INFINITY, INFINITY};
            double high[2] = {-INFINITY, -INFINITY};
            bool all = true;
            for (int k = 0; k < 4; k++) {
                all &= lands[i + k % 2][j + k / 2];
                for (int c = 0; c < 2; c++) {
                    low[c] = fmin(low[c], at[i + k % 2][j + k / 2][c]);
                    high[c] = fmax(high[c], at[i + k % 2][j + k / 2][c]);
                }
            }
            const double mx = 0.5 * (high[0] - low[0]);
            const double my = 0.5 * (high[1] - low[1]);
            if (all && x >= low[0] - mx && x <= high[0] + mx && low[1] - my <= 0 &&
                high[1] + my >= 0 &&
                refine(lens, s, x, (i + 0.5) * step - most, (j + 0.5) * step - most))
                return true;
        }
    return false;
}

/* Where the ray through the middle of the iris lands that shows tangent h: by halving its slope. */
static double chief_lands(const wo_exact_lens *lens, double h)
{
    static const double middle[2] = {0, 0};
    const wo_system *system = &lens->reference;
    double low = 0;
    double high = 3;
    double at[2];
    for (int i = 0; i < 100; i++) {
        const double p = 0.5 * (low + high);
        const double n = -1 / sqrt(1 + p * p);
        const test_ray r =
            trace_ray(system, 0, system->stop - 1, true, 0,
                      (test_ray){.p = {0, 0, system->surface[system->stop].z}, .d = {p * n, 0, n}});
        const double t = (lens->ep_z - r.p[2]) / r.d[2];
        const double seen = -r.d[0] / r.d[2] + (r.p[0] + t * r.d[0]) * 1e-3 * lens->vf;
        if (r.outcome == WO_RAY_PASSED && fabs(seen) < h)
            low = p;
        else
            high = p;
        if (i == 99 && seen < 0)
            low = -low;
    }
    assert_true(land(lens, middle, low, 0, 0, at));
    return at[0];
}

/* widen: clear radii are so much larger than in the design, so that rays die at surfaces and not at
   their rims. */
static void lit_by_search(const char *name, double widen, double f_number)
{
    enum { FIELDS = 3 };
    const int places = cases_of(60, 15);
    static const double d_line[] = {WO_NM_D};
    wo_error error = {WO_OK, ""};
    wo_prescription lens = builtin(name);
    wo_system system;
    wo_first_order first;
    wo_system_make(&lens, WO_NM_D, &system);
    wo_system_first_order(&system, WO_MERIDIAN_X, &first);
    wo_prescription_scale(&lens, 50 / first.efl);
    for (int i = 0; i < lens.count; i++)
        lens.surface[i].semi_aperture *= widen;
    wo_exact_lens exact;
    if (wo_exact_lens_make(&lens, f_number, 0.4, 0.4, d_line, 1, &exact, &error) != WO_OK)
        fail_msg("%s", error.text);
    const wo_lens_model model = wo_exact_lens_model(&exact);
    const wo_aperture aperture = WO_APERTURE_INIT;
    const wo_table_pencil_options options = {.aperture = &aperture,
                                             .focal_px = 960 * 50 / 36.0,
                                             .stretch = 1,
                                             .px_per_dioptre = 10,
                                             .max_reach = 1e5,
                                             .v_limit = 0.4,
                                             .half_diagonal = 550,
                                             .count = 4096,
                                             .wavelengths = 1};
    const wo_context context = WO_CONTEXT_INIT;
    wo_table_pencils *pencils;
    wo_table_facts facts;
    if (wo_table_pencils_create(&context, &model, &options, &pencils, &facts, &error) != WO_OK)
        fail_msg("%s", error.text);
    const wo_lens made = wo_table_pencils_lens(pencils);
    for (int f = 0; f < FIELDS; f++) {
        const double h = facts.field_lit * (0.15 + 0.35 * f);
        const double x = chief_lands(&exact, h);
        int counts[3] = {0};
        int differ = 0;
        for (int i = 0; i < places; i++) {
            const double radius = sqrt((i + 0.5) / places);
            const double u[2] = {radius * cos(2.4 * i), radius * sin(2.4 * i)};
            const double s[2] = {exact.iris * u[0], exact.iris * u[1]};
            wo_model_ray ray;
            bool there = wo_lens_model_ray(&model, h, u, WO_NM_D, &ray);
            for (int k = 0; k < model.clips; k++)
                there &= ray.clip[k] <= 1;
            const bool found = search(&exact, s, x);
            const float fs[16] = {(float)u[0]};
            const float ft[16] = {(float)u[1]};
            float out[6][16];
            const wo_iris_rays rays = {out[0], out[1], out[2], out[3], out[4], out[5]};
            made.iris.rays(made.self, h * options.focal_px, 0, 0, fs, ft, 1, &rays);
            counts[0] += found;
            counts[1] += there;
            counts[2] += out[5][0] <= 1;
            differ += found != there;
        }
        print_message("%s f/%.2f, %.1f degrees: %d of %d places lit, exact %d, %s %d\n", name,
                      exact.f_number, atan(h) * 57.29578, counts[0], places, counts[1],
                      facts.exact ? "pencils without a table" : "table", counts[2]);
        assert_at_most(differ, 1);
        assert_at_most(abs(counts[2] - counts[1]), 1);
    }
    wo_table_pencils_destroy(&context, &pencils);
}

static void clear_radii_stop_light(void **state)
{
    (void)state;
    lit_by_search("biotar_zeiss_100_f14", 1, 0);
    lit_by_search("petzval_laikin_f14", 1, 0);
    lit_by_search("dgauss_werfel_100_f125", 1, 2.8);
}

/* The iris of which 0.58 are lit showed as 0.80. */
static void surfaces_stop_light(void **state)
{
    (void)state;
    lit_by_search("biotar_zeiss_100_f14", 1.6, 0);
    lit_by_search("planar_rudolph_583336", 1.6, 0);
    lit_by_search("petzval_laikin_f14", 1.3, 0);
}

/* A lens with a needle: rays within 0.02 of one place of the iris go far astray, which no survey
   finds. */
static bool needle_ray(const void *self, double h, const double u[2], double nm, wo_model_ray *ray)
{
    (void)self;
    (void)h;
    (void)nm;
    const bool astray = hypot(u[0] - 0.4321, u[1] - 0.1234) < 0.02;
    for (int k = 0; k < 2; k++) {
        ray->a[k] = astray ? 0.2 : 0;
        ray->b[k] = (astray ? 0.5 : 0.01) * u[k];
    }
    ray->weight = 1;
    return true;
}

/* No ray of a pencil, and none that pictures of points are drawn with, goes beyond the promise. */
static void reach_is_kept(void **state)
{
    (void)state;
    enum { COUNT = 4096 };
    const wo_lens_model model = {.field_max = 0.5, .reference_nm = WO_NM_D, .ray = needle_ray};
    const wo_aperture aperture = WO_APERTURE_INIT;
    const wo_table_pencil_options options = {.aperture = &aperture,
                                             .focal_px = 1000,
                                             .stretch = 1.5,
                                             .centre_x = 320,
                                             .centre_y = 180,
                                             .px_per_dioptre = 10,
                                             .max_reach = 400,
                                             .v_limit = 1,
                                             .half_diagonal = 400,
                                             .count = COUNT,
                                             .wavelengths = 1,
                                             .exact = true};
    const wo_context context = WO_CONTEXT_INIT;
    wo_table_pencils *pencils;
    wo_table_facts facts;
    wo_error error = {WO_OK, ""};
    assert_int_equal(wo_table_pencils_create(&context, &model, &options, &pencils, &facts, &error),
                     WO_OK);
    assert_true(facts.exact);
    const wo_lens lens = wo_table_pencils_lens(pencils);
    assert_at_most(lens.reach(lens.self, 1, 1), 20); /* the needle was not found: it is not known */
    static wo_pencil_room room;
    static float s[WO_PENCIL_PIECE + WO_LANES], t[WO_PENCIL_PIECE + WO_LANES],
        out[6][WO_PENCIL_PIECE + WO_LANES];
    const wo_iris_rays iris = {out[0], out[1], out[2], out[3], out[4], out[5]};
    int cut[2] = {0};
    for (unsigned set = 0; set < lens.sets; set++)
        for (int first = 0; first < lens.count; first += WO_PENCIL_PIECE) {
            wo_pencil p;
            lens.pencil(lens.self, 100, 50, set, first, &room, &p);
            for (int i = 0; i < p.count; i++) {
                cut[0] += p.bx[i] == 0 && p.by[i] == 0;
                for (int k = -4; k <= 4; k++) {
                    const double v = 0.25 * k;
                    assert_at_most(hypot((double)p.ax[i] + v * (double)p.bx[i],
                                         (double)p.ay[i] + v * (double)p.by[i]),
                                   lens.reach(lens.self, v, v) * (1 + 1e-6));
                }
            }
        }
    rng random = {5};
    for (int n = 0; n < 200; n++) {
        for (int i = 0; i < WO_PENCIL_PIECE; i++) {
            s[i] = (float)(0.4321 + rng_range(&random, -0.04, 0.04));
            t[i] = (float)(0.1234 + rng_range(&random, -0.04, 0.04));
        }
        lens.iris.rays(lens.self, 320, 180, 0, s, t, WO_PENCIL_PIECE, &iris);
        for (int i = 0; i < WO_PENCIL_PIECE; i++) {
            cut[1] += out[5][i] > 1;
            if (out[5][i] <= 1)
                assert_at_most(
                    hypot((double)(out[0][i] + out[2][i]), (double)(out[1][i] + out[3][i])),
                    lens.reach(lens.self, 1, 1) * (1 + 1e-6));
        }
    }
    assert_true(cut[0] > 0);
    assert_true(cut[1] > 0);
    wo_table_pencils_destroy(&context, &pencils);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clear_radii_stop_light),
        cmocka_unit_test(surfaces_stop_light),
        cmocka_unit_test(reach_is_kept),
    };
    return cmocka_run_group_tests_name("lens_lit", tests, NULL, NULL);
}
