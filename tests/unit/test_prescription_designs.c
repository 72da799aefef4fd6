/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* The designs that come with the library, printing and scaling. */
#include "prescription_test.h"

#include "scenes.h"

/* Focal length and back focal distance of the d line, by a paraxial ray in x. */
static void paraxial(const wo_prescription *lens, double *focal, double *back)
{
    double y = 1, u = 0, n = 1;
    for (int i = 0; i < lens->count; i++) {
        const wo_surface *const s = &lens->surface[i];
        const double after = wo_glass_index(&s->glass, WO_NM_D, NULL);
        const double c = s->meridian == WO_MERIDIAN_Y ? 0 : s->curvature + 2 * s->asphere[0];
        u = (n * u - y * (after - n) * c) / after;
        n = after;
        if (i + 1 < lens->count)
            y += u * s->thickness;
    }
    *focal = -1 / u;
    *back = -y / u;
}

/* Focal length and back focal distance as an independent computation has them. */
static const struct {
    const char *name;
    double focal, back;
    int count;
} designs[] = {
    {"anamorphic_schneider_31", 31.48762, 43.33037, 19},
    {"asphere_edmund_54", 30.05538, 18.14522, 2},
    {"biotar_zeiss_100_f14", 99.91349, 65.32869, 11},
    {"cooke_triplet_50_f5", 50.02135, 42.43644, 6},
    {"dgauss_angenieux_100_f11", 99.93974, 55.9771, 15},
    {"dgauss_codev_100_f2", 100.00372, 61.4875, 11},
    {"dgauss_tronnier_100_f2", 100.71633, 72.21181, 11},
    {"dgauss_werfel_100_f125", 100.14546, 56.45975, 11},
    {"doublet_edmund_49291", 75.00254, 61.17317, 3},
    {"doublet_laikin_20in", 508.15228, 498.01761, 3},
    {"doublet_thorlabs_ac508_250a", 250.03556, 244.57977, 3},
    {"fisheye_laikin_170", 5.20836, 21.14619, 17},
    {"masterprime_zeiss_asph", 99.79494, 40.12213, 23},
    {"petzval_kodak_100", 99.97123, 56.49628, 8},
    {"petzval_laikin_f14", 50.58453, 10.19476, 9},
    {"planar_rudolph_583336", 49.38898, 41.60051, 11},
    {"prime_us8427765_asph", 30.80083, 21.4376, 11},
    {"retrofocus_nikon_100_f28", 100.05913, 130.84849, 15},
    {"singlet_biconvex_thorlabs_50", 49.82744, 48.08277, 3},
    {"singlet_pcx_edmund_49847", 25.3976, 21.47541, 2},
    {"telephoto_laikin_f56", 127.0166, 63.40606, 9},
    {"telephoto_sigler_250", 249.56661, 105.07039, 7},
    {"tessar_brendel_100_f28", 99.99629, 79.80878, 8},
    {"tessar_laikin_f45", 101.54355, 86.83639, 8},
    {"triplet_sasian_50_f4", 50.00099, 41.23765, 6},
    {"wide_laikin_100", 16.66965, 39.76115, 19},
    {"wide_nakamura_100", 100.1068, 65.08301, 13},
    {"zoom_canon_70_200_at_194", 193.90972, 52.42089, 34},
    {"zoom_canon_70_200_at_72", 72.11829, 52.44608, 34},
    {"zoom_itoh_100_145_at_100", 99.91799, 149.45766, 19},
};

static void designs_focus(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(designs); i++) {
        const wo_prescription lens = builtin(designs[i].name);
        double focal, back;
        paraxial(&lens, &focal, &back);
        assert_close(focal, designs[i].focal, 2e-6);
        assert_near(back, designs[i].back, 2e-5 * fabs(designs[i].focal));
        assert_int_equal(lens.count, designs[i].count);
        assert_string_equal(lens.name, designs[i].name);
        assert_true(lens.title[0] && lens.source[0]);
        /* The focal length said agrees with the computed one, and the image lies where said. */
        if (lens.focal_mm > 0)
            assert_close(lens.focal_mm, focal, 0.03);
        assert_near(lens.surface[lens.count - 1].thickness, back, 0.03 * fabs(focal));
    }
    for (size_t i = 0; i < WO_COUNT(designs); i++)
        assert_string_equal(wo_lens_name_at(i), designs[i].name);
    assert_null(wo_lens_name_at(WO_COUNT(designs)));
    assert_null(wo_lens_name_at((size_t)-1));
}

static void designs_have_their_details(void **state)
{
    (void)state;
    const wo_prescription prime = builtin("masterprime_zeiss_asph");
    assert_int_equal(prime.stop, 12);
    assert_true(prime.surface[12].semi_aperture == 19.87015);
    assert_int_equal(prime.surface[10].asphere_terms, 7);
    assert_true(prime.surface[10].asphere[1] == 8.669e-07);
    assert_true(prime.surface[10].asphere[6] == -8.587e-22);
    assert_true(prime.surface[10].curvature == 1 / -230.02127);

    const wo_prescription squeeze = builtin("anamorphic_schneider_31");
    assert_int_equal(squeeze.surface[0].meridian, WO_MERIDIAN_X);
    assert_int_equal(squeeze.surface[3].meridian, WO_MERIDIAN_BOTH);

    /* Names of glasses that are labels only, and glasses without dispersion. */
    const wo_prescription old = builtin("dgauss_angenieux_100_f11");
    assert_int_equal(old.surface[0].glass.kind, WO_DISPERSION_ABBE);
    const wo_prescription tele = builtin("telephoto_sigler_250");
    assert_int_equal(tele.surface[0].glass.kind, WO_DISPERSION_NONE);
    const wo_prescription cooke = builtin("cooke_triplet_50_f5");
    assert_string_equal(cooke.surface[0].glass.name, "N-SK16");
    assert_true(builtin("asphere_edmund_54").surface[0].conic == -1.103426);
}

static void designs_round_trip(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        wo_prescription lens = builtin(wo_lens_name_at(i));
        const char *wrong = round_trip(&lens, &error);
        if (wrong)
            fail_msg("%s: %s", lens.name, wrong);
        /* Curvatures that are no radius's, too. */
        wo_prescription_scale(&lens, 0.7312345678901);
        assert_int_equal(wo_prescription_validate(&lens, &error), WO_OK);
        wrong = round_trip(&lens, &error);
        if (wrong)
            fail_msg("%s, scaled: %s", lens.name, wrong);
    }
}

static void radii_are_printed_as_given(void **state)
{
    (void)state;
    char text[LENS_TEXT_SIZE];
    const wo_prescription lens = builtin("masterprime_zeiss_asph");
    wo_prescription_print(&lens, text, sizeof text);
    assert_non_null(strstr(text, "surface -1883.6 4.7 1.54075/47.23 44.53\n"));
    assert_non_null(strstr(text, "surface -230.02127 2.8 1.61344/44.29 26.78 A4=8.669e-7 A6="));
    assert_non_null(strstr(text, "surface 0 18.938 air 19.87015 stop\n"));
}

/* The radius of a nearly plane surface is more than a text may say. */
static void curvatures_are_printed_where_no_radius_is(void **state)
{
    (void)state;
    static const double curvatures[] = {1e-12, -3e-300, 5e-324, 9.999999999999999e-10, 10, -10};
    char text[LENS_TEXT_SIZE];
    wo_error error = {WO_OK, ""};
    for (size_t i = 0; i < WO_COUNT(curvatures); i++) {
        wo_prescription lens = builtin("singlet_pcx_edmund_49847");
        lens.surface[0].curvature = curvatures[i];
        wo_prescription_print(&lens, text, sizeof text);
        assert_true((strstr(text, "surface c=") != NULL) == (i < 4));
        const char *const wrong = round_trip(&lens, &error);
        if (wrong)
            fail_msg("%g: %s", curvatures[i], wrong);
    }
}

static void unknown_names(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    wo_prescription lens;
    assert_int_equal(wo_lens_find("planar", &lens, &error), WO_ERR_NOT_FOUND);
    assert_non_null(strstr(error.text, "\"planar\""));
    assert_non_null(strstr(error.text, "zoom_itoh_100_145_at_100"));
    assert_int_equal(lens.count, 0);
}

static void printing_into_too_little(void **state)
{
    (void)state;
    char text[200], whole[LENS_TEXT_SIZE];
    const wo_prescription lens = builtin("cooke_triplet_50_f5");
    const size_t length = wo_prescription_print(&lens, whole, sizeof whole);
    for (size_t size = 0; size < sizeof text; size++) {
        memset(text, 'z', sizeof text);
        assert_int_equal(wo_prescription_print(&lens, text, size), length);
        assert_int_equal(text[size], 'z');
        if (size > 0) {
            assert_int_equal(strlen(text), size - 1);
            assert_memory_equal(text, whole, size - 1);
        }
    }
    assert_int_equal(wo_prescription_print(&lens, NULL, 0), length);
}

static double sag(const wo_surface *s, double r)
{
    const double c = s->curvature;
    double z = c * r * r / (1 + sqrt(1 - (1 + s->conic) * c * c * r * r)), power = r * r;
    for (int i = 0; i < s->asphere_terms; i++, power *= r * r)
        z += s->asphere[i] * power;
    return z;
}

static void scaling(void **state)
{
    (void)state;
    const wo_prescription before = builtin("masterprime_zeiss_asph");
    wo_prescription after = before;
    wo_prescription_scale(&after, 0.35);
    for (int i = 0; i < before.count; i++) {
        const wo_surface *const a = &before.surface[i], *const b = &after.surface[i];
        assert_close(b->thickness, 0.35 * a->thickness, 1e-15);
        assert_close(b->semi_aperture, 0.35 * a->semi_aperture, 1e-15);
        for (double r = 1; r < 20; r += 3)
            assert_near(sag(b, 0.35 * r), 0.35 * sag(a, r), 1e-14);
    }
    assert_close(after.focal_mm, 35, 1e-15);
    assert_true(after.f_number == before.f_number && after.half_field == before.half_field);
    wo_prescription_scale(&after, NAN);
    wo_prescription_scale(&after, 0);
    assert_close(after.focal_mm, 35, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(designs_focus),
        cmocka_unit_test(designs_have_their_details),
        cmocka_unit_test(designs_round_trip),
        cmocka_unit_test(radii_are_printed_as_given),
        cmocka_unit_test(curvatures_are_printed_where_no_radius_is),
        cmocka_unit_test(unknown_names),
        cmocka_unit_test(printing_into_too_little),
        cmocka_unit_test(scaling),
    };
    return cmocka_run_group_tests_name("prescription_designs", tests, NULL, NULL);
}
