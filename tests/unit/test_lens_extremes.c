/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Lenses that no picture can be taken through, and requests beyond what a lens does: each gives a
   clear error or a stated value. */
#include "lens_test.h"
#include "optics/lens_choice.h"
#include "optics/lens_table.h"

static const double d_line[] = {WO_NM_D};

static wo_status make(const wo_prescription *lens, double f_number, double vf, double half_field,
                      wo_exact_lens *out, wo_error *error)
{
    *error = (wo_error){WO_OK, ""};
    return wo_exact_lens_make(lens, f_number, vf, half_field, d_line, 1, out, error);
}

static void assert_says(const wo_error *error, const char *what)
{
    if (!strstr(error->text, what))
        fail_msg("\"%s\" does not say \"%s\"", error->text, what);
}

static wo_first_order first_order_of(const wo_prescription *lens)
{
    wo_system system;
    wo_first_order o;
    wo_system_make(lens, WO_NM_D, &system);
    wo_system_first_order(&system, WO_MERIDIAN_X, &o);
    return o;
}

static void lenses_without_power(void **state)
{
    (void)state;
    wo_error error;
    wo_exact_lens exact;
    wo_seidel_lens seidel;
    const test_surface plate[] = {{0, 5, 1.5, 10, true}, {0, 50, 1, 10, false}};
    wo_prescription lens = lens_of(plate, 2);
    wo_first_order o = first_order_of(&lens);
    assert_true(isinf(o.efl) && isinf(o.bfd) && isinf(o.ffd) && isinf(o.H1) && isinf(o.H2));
    assert_true(isinf(o.fno));
    assert_near(o.ep_z, 0, 0);
    assert_near(o.ep_d, 20, 1e-12);
    assert_true(make(&lens, 0, 0.4, 0.2, &exact, &error) != WO_OK);
    assert_true(error.text[0] != 0);

    /* Two surfaces whose powers cancel: parallel light leaves parallel. */
    const test_surface rod[] = {{10, 60, 1.5, 3, true}, {-10, 50, 1, 0, false}};
    lens = lens_of(rod, 2);
    o = first_order_of(&lens);
    assert_true(isinf(o.efl));
    assert_int_equal(make(&lens, 0, 0.4, 0.2, &exact, &error), WO_ERR_UNSUPPORTED);
    assert_says(&error, "no power");
    assert_int_equal(wo_seidel_lens_make(&lens, 2, 0.2, d_line, 1, &seidel, &error),
                     WO_ERR_UNSUPPORTED);

    /* Negative lenses make no real image. */
    const test_surface diverging[] = {{-50, 2, 1.5, 5, true}, {50, 50, 1, 0, false}};
    lens = lens_of(diverging, 2);
    assert_true(first_order_of(&lens).efl < 0);
    assert_true(make(&lens, 0, 0.4, 0.2, &exact, &error) != WO_OK);
    assert_true(wo_seidel_lens_make(&lens, 2, 0.2, d_line, 1, &seidel, &error) != WO_OK);
}

static void no_thickness(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    wo_prescription lens;
    wo_exact_lens exact;
    for (int bending = -3; bending <= 3; bending++) {
        assert_int_equal(wo_singlet(wo_glass_find("N-BK7"), 50, 8, bending, 0, &lens, &error),
                         WO_OK);
        const wo_first_order o = first_order_of(&lens);
        assert_close(o.efl, 50, 1e-12);
        assert_near(o.bfd, 50, 1e-10);
        assert_near(o.H1, 0, 1e-10);
        assert_near(o.H2, 0, 1e-10);
        assert_close(o.fno, 8, 1e-12);
        assert_int_equal(make(&lens, 8, 0.4, 0.1, &exact, &error), WO_OK);
        /* Gauss: 1 / s' = 1 / f - vf. */
        assert_near(exact.sensor_z, 1 / (0.02 - 0.0004), 1e-9);
    }
    /* Too thick for its focal length and bending. */
    assert_int_equal(wo_singlet(wo_glass_find("N-BK7"), 50, 8, 0.5, 5000, &lens, &error),
                     WO_ERR_RANGE);
    assert_says(&error, "thinner");
}

static void iris_in_front_and_behind(void **state)
{
    (void)state;
    wo_error error;
    wo_exact_lens exact;
    const double u[2] = {0.5, 0.25};
    wo_model_ray ray;
    const test_surface front[] = {
        {0, 20, 1, 2, true}, {60, 4, 1.5, 0, false}, {-60, 50, 1, 0, false}};
    wo_prescription lens = lens_of(front, 3);
    wo_first_order o = first_order_of(&lens);
    assert_near(o.ep_z, 0, 1e-12);
    assert_near(o.ep_mag, 1, 1e-12);
    assert_near(o.ep_d, 4, 1e-12);
    assert_int_equal(make(&lens, 0, 0.4, 0.1, &exact, &error), WO_OK);
    wo_lens_model model = wo_exact_lens_model(&exact);
    assert_true(wo_lens_model_ray(&model, 0.05, u, WO_NM_D, &ray));
    /* The iris itself is seen, from all field points. */
    assert_near(ray.b[0], 1e-3, 1e-12);
    assert_near(ray.b[1], 5e-4, 1e-12);

    const test_surface behind[] = {
        {60, 4, 1.5, 0, false}, {-60, 20, 1, 0, false}, {0, 30, 1, 2, true}};
    lens = lens_of(behind, 3);
    o = first_order_of(&lens);
    assert_near(o.xp_z, 0, 1e-12);
    assert_near(o.xp_mag, 1, 1e-12);
    assert_true(o.ep_mag > 1 && o.ep_z > 20);
    assert_int_equal(make(&lens, 0, 0.4, 0.1, &exact, &error), WO_OK);
    model = wo_exact_lens_model(&exact);
    assert_true(wo_lens_model_ray(&model, 0, u, WO_NM_D, &ray));
    assert_close(ray.b[0], 1e-3 * o.ep_mag, 1e-2);
}

static void iris_in_the_rear_focus(void **state)
{
    (void)state;
    wo_error error;
    wo_exact_lens exact;
    wo_seidel_lens seidel;
    const test_surface telecentric[] = {
        {0, 4, 1.5, 0, false}, {-25, 50, 1, 0, false}, {0, 20, 1, 2, true}};
    const wo_prescription lens = lens_of(telecentric, 3);
    const wo_first_order o = first_order_of(&lens);
    assert_true(isinf(o.ep_z));
    assert_true(isinf(o.ep_d));
    assert_near(o.efl, 50, 1e-9);
    assert_int_equal(make(&lens, 0, 0.4, 0.1, &exact, &error), WO_ERR_UNSUPPORTED);
    assert_says(&error, "entrance pupil at infinity");
    assert_int_equal(wo_seidel_lens_make(&lens, 2, 0.2, d_line, 1, &seidel, &error),
                     WO_ERR_UNSUPPORTED);
}

static void f_numbers(void **state)
{
    (void)state;
    wo_error error;
    wo_exact_lens exact;
    const wo_prescription lens = builtin("dgauss_codev_100_f2");
    const wo_first_order o = first_order_of(&lens);
    static const double fast[] = {0, 1, -3, NAN, -INFINITY, 1.99};
    for (size_t i = 0; i < WO_COUNT(fast); i++) {
        assert_int_equal(make(&lens, fast[i], 0.4, 0.2, &exact, &error), WO_OK);
        assert_near(exact.f_number, o.fno, 0);
        assert_close(exact.iris, lens.surface[lens.stop].semi_aperture, 1e-12);
    }
    assert_int_equal(make(&lens, 8, 0.4, 0.2, &exact, &error), WO_OK);
    assert_near(exact.f_number, 8, 0);
    assert_close(exact.iris, lens.surface[lens.stop].semi_aperture * o.fno / 8, 1e-12);

    wo_chosen_lens chosen;
    wo_lens_choice choice = {.kind = WO_LENS_SEIDEL,
                             .design = lens.name,
                             .focal_mm = 50,
                             .f_number = 0.7,
                             .vf = 0.4,
                             .half_field = 0.2,
                             .nm = d_line,
                             .lines = 1};
    assert_int_equal(wo_lens_choose(&choice, &chosen, &error), WO_OK);
    assert_close(chosen.f_number, o.fno, 1e-9);
    choice.kind = WO_LENS_PRESCRIPTION;
    assert_int_equal(wo_lens_choose(&choice, &chosen, &error), WO_OK);
    assert_close(chosen.f_number, o.fno, 1e-9);
}

static wo_status table_of(const wo_lens_model *model, double focal_px, wo_lens_table **table,
                          wo_error *error)
{
    const wo_context context = WO_CONTEXT_INIT;
    const wo_lens_request request = {d_line, 1, focal_px, 0.4, INFINITY};
    wo_lens_lit lit;
    WO_TRY(wo_lens_lit_measure(&context, model, &request, &lit, error));
    return wo_lens_table_create(&context, model, &request, &lit, 0.03, table, error);
}

static void fields(void **state)
{
    (void)state;
    wo_error error;
    wo_exact_lens exact;
    const wo_prescription lens = builtin("dgauss_codev_100_f2");
    static const double none[] = {0, NAN};
    for (size_t i = 0; i < WO_COUNT(none); i++) {
        assert_int_equal(make(&lens, 0, 0.4, none[i], &exact, &error), WO_ERR_UNSUPPORTED);
        assert_says(&error, "no light");
    }
    /* No more than chief rays that pass. */
    assert_int_equal(make(&lens, 0, 0.4, 1e6, &exact, &error), WO_ERR_UNSUPPORTED);
    assert_int_equal(make(&lens, 0, 0.4, 10, &exact, &error), WO_OK);
    assert_true(exact.field_max > 0 && exact.field_max < 5);

    assert_int_equal(make(&lens, 0, 0.4, 0.6, &exact, &error), WO_OK);
    const wo_lens_model model = wo_exact_lens_model(&exact);
    wo_lens_table *table;
    assert_int_equal(table_of(&model, 1920 / 0.36, &table, &error), WO_OK);
    assert_true(table->field > 0.2 && table->field < model.field_max);
    wo_table_node edge;
    wo_table_node beyond;
    wo_lens_table_node(table, 0, table->field, &edge);
    static const double far[] = {1.0001, 2, 1e6, INFINITY};
    for (size_t i = 0; i < WO_COUNT(far); i++) {
        wo_lens_table_node(table, 0, far[i] * table->field, &beyond);
        assert_memory_equal(&edge, &beyond, sizeof edge);
    }
    const wo_context context = WO_CONTEXT_INIT;
    wo_lens_table_destroy(&context, &table);
}

static void focus_where_no_image_is(void **state)
{
    (void)state;
    wo_error error;
    wo_exact_lens exact;
    const wo_prescription lens = builtin("dgauss_codev_100_f2");
    const wo_first_order o = first_order_of(&lens);
    const double front_focus = 1e3 / (o.ep_z - o.ffd);
    assert_int_equal(make(&lens, 0, 0.9 * front_focus, 0.2, &exact, &error), WO_OK);
    /* From the front focus to the entrance pupil. */
    const double distances[] = {o.ep_z - o.ffd, o.ep_z - 0.5 * o.ffd, o.ep_z + 1, o.ep_z,
                                o.ep_z - 5,     0.5 * o.ep_z,         1,          1e-3};
    for (size_t i = 0; i < WO_COUNT(distances); i++) {
        if (make(&lens, 0, 1e3 / distances[i], 0.2, &exact, &error) == WO_OK)
            fail_msg("%g mm in front of the entrance pupil: sensor at %g mm", distances[i],
                     exact.sensor_z);
        assert_says(&error, "focus farther away");
    }
    /* Lenses whose front focus lies inside: no matter where the formulas put the image. */
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        const wo_prescription other = builtin(wo_lens_name_at(i));
        const wo_first_order first = first_order_of(&other);
        if (!(first.ffd > 0) || strstr(other.name, "anamorphic"))
            continue;
        static const double parts[] = {0.999, 0.9, 0.5, 0.01};
        for (size_t k = 0; k < WO_COUNT(parts); k++) {
            if (make(&other, 0, 1e3 / (parts[k] * first.ep_z), 0.2, &exact, &error) == WO_OK)
                fail_msg("%s focuses inside of itself", other.name);
            assert_says(&error, "focus farther away");
        }
        assert_int_equal(make(&other, 0, 1e3 / (first.ep_z + 1000), 0.2, &exact, &error), WO_OK);
    }
    static const double numbers[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < WO_COUNT(numbers); i++)
        assert_int_equal(make(&lens, 0, numbers[i], 0.2, &exact, &error), WO_ERR_RANGE);
    /* Somewhat beyond infinity there is an image still. */
    assert_int_equal(make(&lens, 0, -0.5, 0.2, &exact, &error), WO_OK);
}

static void light_that_is_reflected(void **state)
{
    (void)state;
    wo_error error;
    wo_exact_lens exact;
    /* Parallel light beyond 10 / 3.9 mm from the axis stays inside. */
    const test_surface bead[] = {{0, 10, 3.9, 9.9, true}, {-10, 5, 1, 0, false}};
    const wo_prescription lens = lens_of(bead, 2);
    assert_int_equal(make(&lens, 0, 0, 0.1, &exact, &error), WO_OK);
    const wo_lens_model model = wo_exact_lens_model(&exact);
    wo_model_ray ray;
    const double inside[2] = {0.1, 0};
    const double outside[2] = {0.9, 0};
    assert_true(wo_lens_model_ray(&model, 0, inside, WO_NM_D, &ray));
    assert_false(wo_lens_model_ray(&model, 0, outside, WO_NM_D, &ray));
    wo_lens_table *table;
    assert_int_equal(table_of(&model, 1000, &table, &error), WO_ERR_UNSUPPORTED);
    assert_says(&error, "too few rays");
    assert_null(table);
}

static void wavelengths(void **state)
{
    (void)state;
    wo_error error;
    wo_exact_lens exact;
    wo_system system;
    const wo_prescription lens = builtin("cooke_triplet_50_f5");
    static const double far[] = {1e5, 10, 0, -500, INFINITY, -INFINITY};
    for (size_t i = 0; i < WO_COUNT(far); i++) {
        wo_system_make(&lens, far[i], &system);
        assert_true(system.clamped);
        for (int k = 0; k < system.count; k++)
            assert_true(system.surface[k].n1 >= 1 && system.surface[k].n1 <= 4);
    }
    static const double visible[] = {400, WO_NM_D, 700};
    for (size_t i = 0; i < WO_COUNT(visible); i++) {
        wo_system_make(&lens, visible[i], &system);
        assert_false(system.clamped);
    }
    /* No number: the d line. */
    wo_system d;
    wo_system_make(&lens, WO_NM_D, &d);
    wo_system_make(&lens, NAN, &system);
    for (int k = 0; k < d.count; k++)
        assert_near(system.surface[k].n1, d.surface[k].n1, 0);

    double nm[WO_LINES_MAX + 1];
    for (int i = 0; i <= WO_LINES_MAX; i++)
        nm[i] = 400 + 10 * i;
    static const int counts[] = {0, -1, WO_LINES_MAX + 1};
    for (size_t i = 0; i < WO_COUNT(counts); i++) {
        assert_int_equal(wo_exact_lens_make(&lens, 0, 0, 0.2, nm, counts[i], &exact, &error),
                         WO_ERR_RANGE);
        wo_seidel_lens seidel;
        assert_int_equal(wo_seidel_lens_make(&lens, 8, 0.2, nm, counts[i], &seidel, &error),
                         WO_ERR_RANGE);
    }
    assert_int_equal(wo_exact_lens_make(&lens, 0, 0, 0.2, nm, WO_LINES_MAX, &exact, &error), WO_OK);
}

static void cylinders(void **state)
{
    (void)state;
    wo_error error;
    wo_exact_lens exact;
    wo_seidel_lens seidel;
    const wo_prescription lens = builtin("anamorphic_schneider_31");
    assert_int_equal(make(&lens, 0, 0.4, 0.2, &exact, &error), WO_ERR_UNSUPPORTED);
    assert_says(&error, "anamorphic_schneider_31");
    assert_says(&error, "surface 1)");
    assert_int_equal(wo_seidel_lens_make(&lens, 8, 0.2, d_line, 1, &seidel, &error),
                     WO_ERR_UNSUPPORTED);
    assert_says(&error, "surface 1)");
    wo_prescription one = builtin("cooke_triplet_50_f5");
    one.surface[4].meridian = WO_MERIDIAN_Y;
    assert_int_equal(make(&one, 0, 0.4, 0.2, &exact, &error), WO_ERR_UNSUPPORTED);
    assert_says(&error, "surface 5)");
}

/* Every number of a choice that is none, in every kind of lens: an error, or finite rays. */
static void numbers_that_are_none(void **state)
{
    (void)state;
    static const double bad[] = {NAN, INFINITY, -INFINITY, -1, 0};
    for (int kind = WO_LENS_THIN; kind < WO_LENS_KIND_COUNT; kind++)
        for (size_t i = 0; i < WO_COUNT(bad); i++)
            for (int member = 0; member < 7; member++) {
                wo_lens_choice choice = {.kind = (wo_lens_kind)kind,
                                         .design = "cooke_triplet_50_f5",
                                         .diagram = WO_DIAGRAM_SPHERICAL,
                                         .residual = 1,
                                         .thickness_mm = 5,
                                         .focal_mm = 50,
                                         .f_number = 5,
                                         .best_focus = true,
                                         .vf = 0.4,
                                         .half_field = 0.2,
                                         .nm = d_line,
                                         .lines = 1};
                double *const members[] = {
                    &choice.residual, &choice.bending, &choice.thickness_mm, &choice.focal_mm,
                    &choice.f_number, &choice.vf,      &choice.half_field};
                *members[member] = bad[i];
                wo_error error = {WO_OK, ""};
                wo_chosen_lens lens;
                if (wo_lens_choose(&choice, &lens, &error) != WO_OK) {
                    assert_true(error.text[0] != 0);
                    continue;
                }
                assert_ptr_not_equal(members[member], &choice.focal_mm);
                const double u[2] = {0.3, -0.4};
                wo_model_ray ray;
                assert_true(isfinite(lens.f_number) && lens.f_number > 0);
                if (!wo_lens_model_ray(&lens.model, 0.01, u, WO_NM_D, &ray))
                    continue;
                if (!isfinite(ray.a[0] + ray.a[1] + ray.b[0] + ray.b[1] + ray.weight) ||
                    (lens.model.clips > 0 && !isfinite(ray.clip[0])))
                    fail_msg("kind %d, member %d is %g: the ray is %g %g", kind, member, bad[i],
                             ray.a[0], ray.b[0]);
            }
    wo_lens_choice choice = {
        .kind = WO_LENS_KIND_COUNT, .focal_mm = 50, .f_number = 5, .nm = d_line, .lines = 1};
    wo_chosen_lens lens;
    wo_error error = {WO_OK, ""};
    assert_int_equal(wo_lens_choose(&choice, &lens, &error), WO_ERR_ARGUMENT);
    choice.kind = WO_LENS_THICK;
    choice.glass = 4;
    assert_int_equal(wo_lens_choose(&choice, &lens, &error), WO_ERR_RANGE);
    assert_says(&error, "glass number 4");
    choice.kind = WO_LENS_PRESCRIPTION;
    choice.design = "no_such_lens";
    assert_int_equal(wo_lens_choose(&choice, &lens, &error), WO_ERR_NOT_FOUND);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lenses_without_power),
        cmocka_unit_test(no_thickness),
        cmocka_unit_test(iris_in_front_and_behind),
        cmocka_unit_test(iris_in_the_rear_focus),
        cmocka_unit_test(f_numbers),
        cmocka_unit_test(fields),
        cmocka_unit_test(focus_where_no_image_is),
        cmocka_unit_test(light_that_is_reflected),
        cmocka_unit_test(wavelengths),
        cmocka_unit_test(cylinders),
        cmocka_unit_test(numbers_that_are_none),
    };
    return cmocka_run_group_tests_name("lens_extremes", tests, NULL, NULL);
}
