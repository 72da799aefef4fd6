/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Lens models where they must agree with the thin lens: each in the limit without aberration. */
#include "lens_test.h"
#include "optics/lens_choice.h"
#include "optics/pencil_table.h"
#include "scenes.h"

#define FOCAL_PX (1920.0 * 50 / 36)

static const double d_line[] = {WO_NM_D};

static wo_lens_choice choice_of(wo_lens_kind kind, double f_number)
{
    return (wo_lens_choice){.kind = kind,
                            .design = "dgauss_codev_100_f2",
                            .diagram = WO_DIAGRAM_PERFECT,
                            .residual = 1,
                            .thickness_mm = 5,
                            .focal_mm = 50,
                            .f_number = f_number,
                            .vf = 0.4,
                            .half_field = 0.3,
                            .nm = d_line,
                            .lines = 1};
}

static void choose(const wo_lens_choice *choice, wo_chosen_lens *out)
{
    wo_error error = {WO_OK, ""};
    if (wo_lens_choose(choice, out, &error) != WO_OK)
        fail_msg("%s", error.text);
}

/* Rays b = E u, a = 0 to pupil_bar of E and px_bar px, at tangents up to h. */
static void check_thin(const wo_lens_model *model, double radius, double h, double pupil_bar,
                       double px_bar)
{
    rng random = {7};
    double worst_b = 0;
    double worst_a = 0;
    for (int i = 0; i < 300; i++) {
        const double r = sqrt(rng_unit(&random));
        const double angle = rng_range(&random, 0, 6.283185307179586);
        const double u[2] = {r * cos(angle), r * sin(angle)};
        wo_model_ray ray;
        assert_true(wo_lens_model_ray(model, rng_range(&random, 0, h), u, WO_NM_D, &ray));
        worst_b = fmax(worst_b, hypot(ray.b[0] - radius * u[0], ray.b[1] - radius * u[1]) / radius);
        worst_a = fmax(worst_a, FOCAL_PX * hypot(ray.a[0], ray.a[1]));
        assert_near(ray.weight, 1, 1e-5);
        for (int k = 0; k < model->clips; k++)
            assert_true(ray.clip[k] < 1);
    }
    assert_at_most(worst_b, pupil_bar);
    assert_at_most(worst_a, px_bar);
}

static void perfect_diagram(void **state)
{
    (void)state;
    wo_chosen_lens lens;
    const wo_lens_choice choice = choice_of(WO_LENS_DIAGRAM, 1.4);
    choose(&choice, &lens);
    assert_near(lens.f_number, 1.4, 0);
    check_thin(&lens.model, 0.05 / 2.8, 0.3, 1e-12, 1e-9);
    assert_near(wo_lens_model_best_focus(&lens.model), 0, 1e-12);
}

static void thin_lens(void **state)
{
    (void)state;
    wo_chosen_lens lens;
    const wo_lens_choice choice = choice_of(WO_LENS_THIN, 1.4);
    choose(&choice, &lens);
    check_thin(&lens.model, 0.05 / 2.8, 0.3, 1e-12, 1e-9);
}

static void diagram_without_residual(void **state)
{
    (void)state;
    wo_chosen_lens lens;
    wo_lens_choice choice = choice_of(WO_LENS_DIAGRAM, 1.4);
    choice.diagram = WO_DIAGRAM_SPHERICAL;
    choice.residual = 0;
    choose(&choice, &lens);
    check_thin(&lens.model, 0.05 / 2.8, 0.3, 1e-12, 1e-9);
}

static void thick_lens_of_one_wavelength(void **state)
{
    (void)state;
    static const char *const glasses[] = {"N-BK7", "N-SF6", "CAF2", "N-LAK9"};
    for (int glass = 0; glass < 4; glass++) {
        wo_chosen_lens lens;
        wo_lens_choice choice = choice_of(WO_LENS_THICK, 2);
        choice.glass = glass;
        choice.bending = 0.5 * glass - 1;
        choose(&choice, &lens);
        check_thin(&lens.model, 0.05 / 4, 0.3, 1e-12, 1e-9);

        /* Other wavelengths: the power goes with n - 1 of a thin lens. */
        static const double nm[] = {WO_NM_F, WO_NM_D, WO_NM_C};
        choice.nm = nm;
        choice.lines = 3;
        choice.thickness_mm = 0;
        choose(&choice, &lens);
        const wo_glass *const material = wo_glass_find(glasses[glass]);
        assert_non_null(material);
        for (int i = 0; i < 3; i++) {
            const double u[2] = {0.6, -0.8};
            wo_model_ray ray;
            assert_true(wo_lens_model_ray(&lens.model, 0, u, nm[i], &ray));
            const double n = wo_glass_index(material, nm[i], NULL);
            const double shift = 20 * ((n - 1) / (wo_glass_index(material, WO_NM_D, NULL) - 1) - 1);
            assert_near(ray.a[0], -ray.b[0] * shift, 1e-13);
            assert_near(ray.a[1], -ray.b[1] * shift, 1e-13);
        }
    }
}

static void seidel_stopped_down(void **state)
{
    (void)state;
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        if (strstr(wo_lens_name_at(i), "anamorphic"))
            continue;
        wo_chosen_lens lens;
        wo_lens_choice choice = choice_of(WO_LENS_SEIDEL, 1000);
        choice.design = wo_lens_name_at(i);
        choose(&choice, &lens);
        assert_close(lens.f_number, 1000, 1e-12);
        check_thin(&lens.model, 0.05 / 2000, 0.005, 1e-12, 1e-3);
    }
}

static void prescriptions_stopped_down(void **state)
{
    (void)state;
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        if (strstr(wo_lens_name_at(i), "anamorphic"))
            continue;
        wo_chosen_lens lens;
        wo_lens_choice choice = choice_of(WO_LENS_PRESCRIPTION, 2000);
        choice.design = wo_lens_name_at(i);
        choice.half_field = 0.01;
        choose(&choice, &lens);
        assert_near(lens.f_number, 2000, 1e-9);
        check_thin(&lens.model, 0.05 / 4000, 1e-5, 1e-6, 1e-3);
    }
}

static void singlets_stopped_down(void **state)
{
    (void)state;
    for (int bending = -2; bending <= 2; bending++) {
        wo_chosen_lens lens;
        wo_lens_choice choice = choice_of(WO_LENS_SINGLET, 500);
        choice.bending = bending;
        choice.half_field = 0.01;
        choose(&choice, &lens);
        check_thin(&lens.model, 0.05 / 1000, 1e-4, 1e-6, 1e-3);
    }
}

/* An exact lens and its third order agree once stopped down, off the axis too. */
static void seidel_and_exact(void **state)
{
    (void)state;
    static const char *const names[] = {"dgauss_codev_100_f2", "cooke_triplet_50_f5",
                                        "tessar_brendel_100_f28", "singlet_pcx_edmund_49847",
                                        "doublet_thorlabs_ac508_250a"};
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        wo_chosen_lens third;
        wo_chosen_lens exact;
        wo_lens_choice choice = choice_of(WO_LENS_SEIDEL, 16);
        choice.design = names[i];
        choice.half_field = 0.05;
        choice.vf = 0;
        choose(&choice, &third);
        choice.kind = WO_LENS_PRESCRIPTION;
        choose(&choice, &exact);
        double worst = 0;
        double longest = 0;
        for (int k = 0; k < 24; k++) {
            const double u[2] = {cos(k), sin(k)};
            const double h = 0.04 * (k % 4) / 3;
            wo_model_ray a;
            wo_model_ray b;
            assert_true(wo_lens_model_ray(&third.model, h, u, WO_NM_D, &a));
            assert_true(wo_lens_model_ray(&exact.model, h, u, WO_NM_D, &b));
            worst = fmax(worst, hypot(a.a[0] - b.a[0], a.a[1] - b.a[1]));
            longest = fmax(longest, hypot(b.a[0], b.a[1]));
        }
        print_message("%-28s third order is off by %.3g px of %.3g px\n", names[i],
                      worst * FOCAL_PX, longest * FOCAL_PX);
        assert_at_most(worst, 0.06 * longest);
    }
}

/* The same of axial colour. */
static void seidel_and_exact_colours(void **state)
{
    (void)state;
    static const double nm[] = {WO_NM_F, WO_NM_D, WO_NM_C};
    static const char *const names[] = {"petzval_kodak_100", "singlet_pcx_edmund_49847",
                                        "doublet_thorlabs_ac508_250a"};
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        wo_chosen_lens third;
        wo_chosen_lens exact;
        wo_lens_choice choice = choice_of(WO_LENS_SEIDEL, 100);
        choice.design = names[i];
        choice.vf = 0;
        choice.nm = nm;
        choice.lines = 3;
        choose(&choice, &third);
        choice.kind = WO_LENS_PRESCRIPTION;
        choose(&choice, &exact);
        double longest = 0;
        for (int line = 0; line < 3; line++) {
            const double u[2] = {0.5, 0.5};
            wo_model_ray a;
            wo_model_ray b;
            assert_true(wo_lens_model_ray(&third.model, 0, u, nm[line], &a));
            assert_true(wo_lens_model_ray(&exact.model, 0, u, nm[line], &b));
            longest = fmax(longest, fabs(b.a[0]));
            assert_near(a.a[0], b.a[0], 0.03 * longest + 2e-7);
            assert_near(a.a[1], b.a[1], 0.03 * longest + 2e-7);
        }
        assert_true(longest > 1e-6);
    }
}

/* Square of the spot on the axis, as the refocus is said to make it smallest. */
static double spot(const wo_lens_model *model)
{
    double sum = 0;
    double light = 0;
    for (int i = 0; i < 500; i++) {
        const double u[2] = {sqrt((i + 0.5) / 500), 0};
        wo_model_ray ray;
        assert_true(wo_lens_model_ray(model, 0, u, model->reference_nm, &ray));
        sum += ray.weight * (ray.a[0] * ray.a[0] + ray.a[1] * ray.a[1]);
        light += ray.weight;
    }
    return sum / light;
}

static void best_focus(void **state)
{
    (void)state;
    static const struct {
        wo_lens_kind kind;
        double f_number;
    } cases[] = {
        {WO_LENS_PRESCRIPTION, 2}, {WO_LENS_SEIDEL, 2}, {WO_LENS_SINGLET, 4}, {WO_LENS_DIAGRAM, 2}};
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_chosen_lens lens;
        wo_lens_choice choice = choice_of(cases[i].kind, cases[i].f_number);
        choice.diagram = WO_DIAGRAM_SPHERICAL;
        choose(&choice, &lens);
        assert_near(lens.model.refocus, 0, 0);
        const double paraxial = spot(&lens.model);
        choice.best_focus = true;
        choose(&choice, &lens);
        /* Undercorrected lenses have marginal rays that focus nearer. */
        assert_true(lens.model.refocus > 0);
        const double best = spot(&lens.model);
        assert_true(best < 0.5 * paraxial);
        for (int side = -1; side <= 1; side += 2) {
            wo_lens_model moved = lens.model;
            moved.refocus *= 1 + 0.05 * side;
            assert_true(spot(&moved) > best);
        }
    }
}

static void pencils_of_a_perfect_lens(void **state)
{
    (void)state;
    wo_error error = {WO_OK, ""};
    const wo_context context = WO_CONTEXT_INIT;
    wo_aperture apertures[2] = {WO_APERTURE_INIT, WO_APERTURE_INIT};
    apertures[1].blades = 6;
    apertures[1].edge = 0.5;
    apertures[1].rotation = 10;
    wo_chosen_lens lens;
    const wo_lens_choice choice = choice_of(WO_LENS_DIAGRAM, 2);
    choose(&choice, &lens);
    for (int shape = 0; shape < 2; shape++) {
        const double stretch = shape == 0 ? 1 : 0.5;
        const double k = FOCAL_PX * 0.05 / 4;
        const wo_thin_lens thin_lens = {.k = k, .vf = 0, .focal_px = FOCAL_PX};
        const wo_table_pencil_options options = {.aperture = &apertures[shape],
                                                 .focal_px = FOCAL_PX,
                                                 .stretch = stretch,
                                                 .centre_x = 960,
                                                 .centre_y = 540,
                                                 .px_per_dioptre = k,
                                                 .max_reach = 4000,
                                                 .v_limit = 3,
                                                 .count = 700,
                                                 .wavelengths = 7,
                                                 .seed = 5};
        wo_thin_pencils *thin;
        wo_table_pencils *table;
        wo_table_facts facts;
        assert_int_equal(wo_thin_pencils_create(&context, &thin_lens, &apertures[shape], stretch,
                                                options.count, options.seed, &thin, &error),
                         WO_OK);
        assert_int_equal(
            wo_table_pencils_create(&context, &lens.model, &options, &table, &facts, &error),
            WO_OK);
        assert_true(facts.ideal);
        assert_int_equal(facts.wavelengths, 1);
        const wo_lens a = wo_thin_pencils_lens(thin);
        const wo_lens b = wo_table_pencils_lens(table);
        assert_int_equal(a.sets, b.sets);
        assert_int_equal(a.count, b.count);
        static const double places[][2] = {{960, 540}, {0, 0}, {1500, 900}, {960, 1000}};
        int compared = 0;
        for (unsigned set = 0; set < a.sets; set++)
            for (int first = 0; first < options.count; first += WO_PENCIL_PIECE) {
                static wo_pencil_room rooms[2];
                wo_pencil p;
                wo_pencil q;
                const double *const at = places[set % 4];
                a.pencil(a.self, at[0], at[1], set, first, &rooms[0], &p);
                b.pencil(b.self, at[0], at[1], set, first, &rooms[1], &q);
                assert_int_equal(p.count, q.count);
                assert_int_equal(p.weight[0] == NULL, q.weight[0] == NULL);
                for (int i = 0; i < p.count; i++) {
                    assert_near((double)q.ax[i], (double)p.ax[i], 1e-5 * k);
                    assert_near((double)q.ay[i], (double)p.ay[i], 1e-5 * k);
                    assert_near((double)q.bx[i], (double)p.bx[i], 1e-5 * k);
                    assert_near((double)q.by[i], (double)p.by[i], 1e-5 * k);
                    for (int c = 0; c < 3 && p.weight[0]; c++)
                        assert_close((double)q.weight[c][i], (double)p.weight[c][i], 1e-5);
                    compared++;
                }
            }
        assert_int_equal(compared, (int)a.sets * options.count);
        assert_near(b.reach(b.self, -1, 2), a.reach(a.self, -1, 2), 0.12 * k);
        assert_true(b.reach(b.self, -1, 2) >= a.reach(a.self, -1, 2));
        wo_thin_pencils_destroy(&context, &thin);
        wo_table_pencils_destroy(&context, &table);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thin_lens),
        cmocka_unit_test(perfect_diagram),
        cmocka_unit_test(diagram_without_residual),
        cmocka_unit_test(thick_lens_of_one_wavelength),
        cmocka_unit_test(seidel_stopped_down),
        cmocka_unit_test(prescriptions_stopped_down),
        cmocka_unit_test(singlets_stopped_down),
        cmocka_unit_test(seidel_and_exact),
        cmocka_unit_test(seidel_and_exact_colours),
        cmocka_unit_test(best_focus),
        cmocka_unit_test(pencils_of_a_perfect_lens),
    };
    return cmocka_run_group_tests_name("lens_models", tests, NULL, NULL);
}
