/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Paraxial data and axial rays of the designs that come with the library, against values computed
   elsewhere. */
#include "lens_checks.h"
#include "lens_test.h"

#include "lens_checks.inc"
#include "lens_lsa_checks.inc"
#include "lens_pencil_checks.inc"

static const double lines_nm[3] = {WO_NM_F, WO_NM_D, WO_NM_C};

static void first_order(void **state)
{
    (void)state;
    static const char *const what[FIRST_VALUES] = {"efl",    "bfd",  "ffd",    "H1",   "H2",
                                                   "ep_z",   "ep_d", "ep_mag", "xp_z", "xp_d",
                                                   "xp_mag", "fno",  "oal"};
    int compared = 0;
    int lenses = 0;
    for (size_t i = 0; i < WO_COUNT(first_checks); i++) {
        const first_check *const check = &first_checks[i];
        const wo_system system = builtin_system(check->name, WO_NM_D);
        lenses += check->meridian == WO_MERIDIAN_X;
        wo_first_order o;
        wo_system_first_order(&system, check->meridian, &o);
        const double got[FIRST_VALUES] = {o.efl,    o.bfd,  o.ffd,  o.H1,     o.H2,  o.ep_z, o.ep_d,
                                          o.ep_mag, o.xp_z, o.xp_d, o.xp_mag, o.fno, o.oal};
        for (int k = 0; k < FIRST_VALUES; k++) {
            const double want = check->value[k];
            if (!(fabs(got[k] - want) <= 1e-4 * fmax(fabs(want), 1e-2)))
                fail_msg("%s: %s is %.9g, should be %.9g", check->name, what[k], got[k], want);
            compared++;
        }
    }
    assert_int_equal(lenses, 30);
    assert_int_equal(compared, 31 * FIRST_VALUES);
}

static void axial_colour(void **state)
{
    (void)state;
    static const double nm[COLOUR_VALUES] = {404.6561, 435.8343, WO_NM_F, 546.0740,
                                             WO_NM_D,  WO_NM_C,  706.5188};
    int compared = 0;
    for (size_t i = 0; i < WO_COUNT(colour_checks); i++) {
        const colour_check *const check = &colour_checks[i];
        const wo_system middle = builtin_system(check->name, WO_NM_D);
        wo_first_order d;
        wo_system_first_order(&middle, WO_MERIDIAN_X, &d);
        for (int k = 0; k < COLOUR_VALUES; k++) {
            const wo_system system = builtin_system(check->name, nm[k]);
            wo_first_order o;
            wo_system_first_order(&system, WO_MERIDIAN_X, &o);
            if (!(fabs(o.bfd - d.bfd - check->shift[k]) <= 2e-4))
                fail_msg("%s at %g nm: bfd moves by %.7g, should by %.7g", check->name, nm[k],
                         o.bfd - d.bfd, check->shift[k]);
            compared++;
        }
    }
    assert_int_equal(compared, 30 * COLOUR_VALUES);
}

/* Where the ray at this height crosses the axis, from the last vertex; NAN when it does not. */
static double crossing(const wo_system *system, double height)
{
    const test_ray r = trace_whole(system, 0, parallel_ray(0, fmax(height, 1e-4)));
    return r.outcome == WO_RAY_PASSED ? r.p[2] - system->z_last - r.p[1] / r.d[1] * r.d[2] : NAN;
}

static int compare_crossings(const char *name, const double *fractions, int count, double semi,
                             const double *want, int line, double bfd, double bar)
{
    const wo_system system = builtin_system(name, lines_nm[line]);
    int compared = 0;
    for (int k = 0; k < count; k++) {
        const double got = crossing(&system, fractions[k] * semi) - bfd;
        if (isnan(want[k]) != isnan(got) || fabs(got - want[k]) > bar)
            fail_msg("%s at %g nm, pupil %g: %.8g, should be %.8g", name, lines_nm[line],
                     fractions[k], got, want[k]);
        compared += !isnan(want[k]);
    }
    return compared;
}

static void longitudinal_spherical_aberration(void **state)
{
    (void)state;
    int compared = 0;
    for (size_t i = 0; i < WO_COUNT(lsa_checks); i++) {
        const lsa_check *const check = &lsa_checks[i];
        const wo_system system = builtin_system(check->name, WO_NM_D);
        wo_first_order o;
        wo_system_first_order(&system, WO_MERIDIAN_X, &o);
        for (int line = 0; line < 3; line++)
            compared += compare_crossings(check->name, lsa_fractions, LSA_VALUES, check->semi,
                                          check->shift[line], line, o.bfd, 1e-3);
    }
    assert_int_equal(compared, 29 * 3 * LSA_VALUES);
}

static void pencils_on_the_axis(void **state)
{
    (void)state;
    double fractions[PENCIL_VALUES];
    for (int k = 0; k < PENCIL_VALUES; k++)
        fractions[k] = k / (PENCIL_VALUES - 1.0);
    int compared = 0;
    for (size_t i = 0; i < WO_COUNT(pencil_checks); i++) {
        const pencil_check *const check = &pencil_checks[i];
        for (int line = 0; line < 3; line++)
            compared += compare_crossings(check->name, fractions, PENCIL_VALUES, check->semi,
                                          check->shift[line], line, check->bfd, 1e-4);
    }
    assert_int_equal(compared, 29 * 3 * PENCIL_VALUES);
}

/* The image of a plane in front of the lens by the Gaussian formula from the principal planes. */
static void images_of_near_planes(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(first_checks); i++) {
        const first_check *const check = &first_checks[i];
        const wo_system system = builtin_system(check->name, WO_NM_D);
        wo_first_order o;
        wo_system_first_order(&system, check->meridian, &o);
        assert_close(wo_system_image(&system, check->meridian, 0), o.bfd, 1e-12);
        static const double vergences[] = {0.05, 0.5, 1, -0.3};
        for (size_t k = 0; k < WO_COUNT(vergences); k++) {
            const double object = o.ep_z - 1e3 / vergences[k] - o.H1;
            const double image = 1 / (1 / o.efl + 1 / object) + o.H2;
            assert_close(wo_system_image(&system, check->meridian, vergences[k]), image, 1e-9);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_order),
        cmocka_unit_test(axial_colour),
        cmocka_unit_test(longitudinal_spherical_aberration),
        cmocka_unit_test(pencils_on_the_axis),
        cmocka_unit_test(images_of_near_planes),
    };
    return cmocka_run_group_tests_name("lens_first_order", tests, NULL, NULL);
}
