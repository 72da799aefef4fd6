/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/glass.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

static double index_of(const wo_glass *glass, double nm)
{
    bool clamped = false;
    const double n = wo_glass_index(glass, nm, &clamped);
    assert_false(clamped);
    return n;
}

static const wo_glass *find(const char *name)
{
    const wo_glass *const glass = wo_glass_find(name);
    if (!glass)
        fail_msg("no glass %s", name);
    return glass;
}

static wo_glass abbe(double nd, double vd)
{
    wo_error error = {WO_OK, ""};
    wo_glass glass;
    if (wo_glass_abbe(nd, vd, &glass, &error) != WO_OK)
        fail_msg("%s", error.text);
    return glass;
}

static double abbe_number(const wo_glass *glass)
{
    return (wo_glass_index(glass, WO_NM_D, NULL) - 1) /
           (wo_glass_index(glass, WO_NM_F, NULL) - wo_glass_index(glass, WO_NM_C, NULL));
}

/* Index at the lines d, e and g, and Abbe number, of the makers' data sheets. */
static void data_sheets(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double nd, vd, ne, ng;
    } rows[] = {
        {"N-BK7", 1.51680, 64.17, 1.518722, 1.526685},
        {"N-SF6", 1.80518, 25.36, 1.812659, 1.847380},
        {"SF2", 1.64769, 33.85, 1.652219, 1.672494},
        {"N-LAK8", 1.71300, 53.83, 1.716160, 1.729437},
        {"N-LASF31A", 1.88300, 40.76, 1.888149, 1.910502},
        {"S-FPL53", 1.43875, 94.95, 1.439854, 1.444423},
        {"SILICA", 1.45846, 67.82, 1.460078, 1.466693},
        {"CAF2", 1.43385, 95.00, 1.434940, 1.439485},
    };
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        const wo_glass *const glass = find(rows[i].name);
        assert_near(glass->nd, rows[i].nd, 5e-6);
        assert_near(glass->vd, rows[i].vd, 5.1e-3);
        assert_near(index_of(glass, 546.074), rows[i].ne, 1e-6);
        assert_near(index_of(glass, 435.8343), rows[i].ng, 1e-6);
    }
}

static void catalogue_agrees_with_its_formulas(void **state)
{
    (void)state;
    size_t count = 0;
    for (const wo_glass *glass; (glass = wo_glass_at(count)); count++) {
        assert_int_equal(glass->kind, WO_DISPERSION_SELLMEIER);
        assert_near(index_of(glass, WO_NM_D), glass->nd, 6e-6);
        assert_near(abbe_number(glass), glass->vd, 0.02);
        assert_ptr_equal(wo_glass_find(glass->name), glass);
        if (count > 0)
            assert_true(strcmp(wo_glass_at(count - 1)->name, glass->name) < 0);

        wo_error error = {WO_OK, ""};
        wo_glass made;
        if (wo_glass_formula(glass->name, glass->kind, glass->a, glass->low_nm, glass->high_nm,
                             &made, &error) != WO_OK)
            fail_msg("%s", error.text);
        assert_near(made.nd, glass->nd, 6e-6);
        assert_near(made.vd, glass->vd, 0.02);
    }
    assert_int_equal(count, 92);
    assert_null(wo_glass_at((size_t)-1));
}

static void names(void **state)
{
    (void)state;
    assert_ptr_equal(find("n-bk7"), find("N-BK7"));
    assert_null(wo_glass_find("N-BK"));
    assert_null(wo_glass_find("N-BK70"));
    assert_null(wo_glass_find(""));
}

static void range_clamps(void **state)
{
    (void)state;
    const wo_glass *const glass = find("N-BK7");
    bool clamped = false;
    const double low = wo_glass_index(glass, 300, &clamped);
    const double high = wo_glass_index(glass, 2500, &clamped);
    assert_false(clamped);
    assert_true(low > high);
    assert_true(wo_glass_index(glass, 299.99, &clamped) == low);
    assert_true(clamped);
    assert_true(wo_glass_index(glass, 500, &clamped) > high);
    assert_true(clamped);
    assert_true(wo_glass_index(glass, -INFINITY, NULL) == low);
    clamped = false;
    assert_true(wo_glass_index(glass, INFINITY, &clamped) == high);
    assert_true(clamped);
    assert_true(index_of(glass, NAN) == index_of(glass, WO_NM_D));
}

static void two_numbers_give_both_back(void **state)
{
    (void)state;
    rng r = {5};
    for (int i = 0; i < 1000; i++) {
        const double nd = rng_range(&r, 1.01, 2.2), vd = rng_range(&r, 12, 120);
        const wo_glass glass = abbe(nd, vd);
        assert_int_equal(glass.kind, WO_DISPERSION_ABBE);
        assert_near(index_of(&glass, WO_NM_D), nd, 1e-14);
        assert_close(abbe_number(&glass), vd, 1e-9);
        assert_true(wo_glass_index(&glass, 400, NULL) > wo_glass_index(&glass, 700, NULL));
    }
    /* Two terms of Cauchy stay near the real glass where the picture is. */
    const wo_glass model = abbe(1.5168, 64.17);
    for (double nm = 440; nm <= 660; nm += 20)
        assert_near(index_of(&model, nm), index_of(find("N-BK7"), nm), 2e-4);
}

static void without_dispersion(void **state)
{
    (void)state;
    const wo_glass glass = abbe(1.7, 0);
    assert_int_equal(glass.kind, WO_DISPERSION_NONE);
    for (double nm = 1; nm < 1e9; nm *= 3)
        assert_true(index_of(&glass, nm) == 1.7);
    const wo_glass air = wo_glass_air(), one = abbe(1, 0);
    assert_string_equal(air.name, "air");
    assert_string_equal(one.name, "air");
    assert_true(index_of(&air, 550) == 1);
}

static void always_one_to_four(void **state)
{
    (void)state;
    const double nds[] = {1, 1.0001, 1.5, 3.9, 4}, vds[] = {5, 20, 200};
    for (size_t i = 0; i < WO_COUNT(nds); i++)
        for (size_t j = 0; j < WO_COUNT(vds); j++) {
            const wo_glass glass = abbe(nds[i], vds[j]);
            for (double nm = 100; nm < 3000; nm += 7) {
                const double n = wo_glass_index(&glass, nm, NULL);
                assert_true(n >= 1 && n <= 4);
            }
        }
}

static void numbers_that_are_no_glass(void **state)
{
    (void)state;
    const double bad[][2] = {{0.99, 50}, {4.01, 50}, {NAN, 50},      {1.5, 4.99},
                             {1.5, 201}, {1.5, -60}, {INFINITY, 50}, {1.5, NAN}};
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        wo_error error = {WO_OK, ""};
        wo_glass glass;
        assert_int_equal(wo_glass_abbe(bad[i][0], bad[i][1], &glass, &error), WO_ERR_RANGE);
        assert_non_null(strstr(error.text, "must be"));
        assert_string_equal(glass.name, "air");
    }
}

/* N-BK7 in Schott's old formula, from the catalogue of 1992. */
static void schott(void **state)
{
    (void)state;
    const double a[6] = {2.2718929,    -1.0108077e-2, 1.0592509e-2,
                         2.0816965e-4, -7.6472538e-6, 4.9240991e-7};
    wo_error error = {WO_OK, ""};
    wo_glass glass;
    if (wo_glass_formula("BK7", WO_DISPERSION_SCHOTT, a, 365, 1014, &glass, &error) != WO_OK)
        fail_msg("%s", error.text);
    assert_near(glass.nd, 1.5168, 1e-5);
    assert_near(glass.vd, 64.17, 0.05);
    for (double nm = 370; nm <= 1000; nm += 10)
        assert_near(index_of(&glass, nm), index_of(find("N-BK7"), nm), 2e-5);
    assert_string_equal(glass.name, "BK7");
}

static wo_status formula(wo_dispersion kind, const double a[6], double low, double high,
                         wo_error *error)
{
    wo_glass glass;
    return wo_glass_formula("X1", kind, a, low, high, &glass, error);
}

static void poles(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    const wo_dispersion kind = WO_DISPERSION_SELLMEIER;
    /* So thin a resonance that no sampling meets it: at 500.0001 nm. */
    const double pole = 0.5000001 * 0.5000001;
    const double thin[6] = {1.2, 1e-18, 0, 0.01, pole, 0};
    assert_int_equal(formula(kind, thin, 400, 700, &error), WO_ERR_RANGE);
    assert_non_null(strstr(error.text, "C2"));
    assert_non_null(strstr(error.text, "pole"));
    assert_int_equal(formula(kind, thin, 510, 700, &error), WO_OK);
    const double ends[6] = {1.2, 0.1, 0, 0.01, 0.49, 0};
    assert_int_equal(formula(kind, ends, 400, 700, &error), WO_ERR_RANGE);
    assert_int_equal(formula(kind, ends, 400, 699.9, &error), WO_ERR_RANGE);
    assert_int_equal(formula(kind, ends, 400, 500, &error), WO_OK);
    assert_int_equal(formula(kind, ends, 700, 900, &error), WO_ERR_RANGE);
}

static void formulas_that_are_no_glass(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    const double high[6] = {17, 0, 0, 0, 0, 0}, low[6] = {0.9, 0, 0, 0, 0, 0};
    const double good[6] = {2.25, 0, 0, 0, 0, 0}, nan[6] = {2.25, 0, 0, 0, 0, NAN};
    const double inside[6] = {2, 0, 0, 0, 0, 0.0005};
    const wo_dispersion kind = WO_DISPERSION_SCHOTT;
    assert_int_equal(formula(kind, good, 400, 700, &error), WO_OK);
    assert_int_equal(formula(kind, high, 400, 700, &error), WO_ERR_RANGE);
    assert_int_equal(formula(kind, low, 400, 700, &error), WO_ERR_RANGE);
    assert_int_equal(formula(kind, nan, 400, 700, &error), WO_ERR_RANGE);
    assert_int_equal(formula(kind, inside, 400, 700, &error), WO_OK);
    assert_int_equal(formula(kind, inside, 200, 700, &error), WO_ERR_RANGE);
    assert_int_equal(formula(kind, good, 700, 400, &error), WO_ERR_RANGE);
    assert_int_equal(formula(kind, good, 50, 700, &error), WO_ERR_RANGE);
    assert_int_equal(formula(kind, good, NAN, 700, &error), WO_ERR_RANGE);
    assert_int_equal(formula(WO_DISPERSION_ABBE, good, 400, 700, &error), WO_ERR_ARGUMENT);
    const char *const bad[] = {
        "", "1.5", "air", "INF", "a b", "a/b", "a2345678901234567890123456789012"};
    for (size_t i = 0; i < WO_COUNT(bad); i++) {
        wo_glass glass;
        assert_int_equal(wo_glass_formula(bad[i], kind, good, 400, 700, &glass, &error),
                         WO_ERR_ARGUMENT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(data_sheets),
        cmocka_unit_test(catalogue_agrees_with_its_formulas),
        cmocka_unit_test(names),
        cmocka_unit_test(range_clamps),
        cmocka_unit_test(two_numbers_give_both_back),
        cmocka_unit_test(without_dispersion),
        cmocka_unit_test(always_one_to_four),
        cmocka_unit_test(numbers_that_are_no_glass),
        cmocka_unit_test(schott),
        cmocka_unit_test(poles),
        cmocka_unit_test(formulas_that_are_no_glass),
    };
    return cmocka_run_group_tests_name("glass", tests, NULL, NULL);
}
