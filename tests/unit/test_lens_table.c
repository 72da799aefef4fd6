/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Tables of lenses against the lenses themselves, in rays of the test's own. */
#include "lens_test.h"
#include "optics/lens_table.h"
#include "scenes.h"

static const double lines_nm[] = {450, WO_NM_D, 650};
enum { LINES = 3, RAYS = 2000 };

typedef struct comparison {
    int open;      /* rays that the model passes, inside the image circle */
    int disagreed; /* on being blocked */
    double rms_px, worst_px;
} comparison;

static comparison compare(const wo_lens_table *table, const wo_lens_model *model, double focal_px,
                          double blur, uint64_t seed)
{
    rng random = {seed};
    comparison c = {0};
    double sum = 0;
    for (int i = 0; i < RAYS; i++) {
        const int line = rng_int(&random, 0, LINES - 1);
        const double h = table->field_lit * sqrt(rng_unit(&random));
        const double radius = sqrt(rng_unit(&random));
        const double angle = rng_range(&random, 0, 6.283185307179586);
        const double u[2] = {radius * cos(angle), radius * sin(angle)};
        wo_model_ray ray = {.weight = 0};
        double most = wo_lens_model_ray(model, h, u, lines_nm[line], &ray) ? 0 : INFINITY;
        for (int k = 0; k < model->clips; k++)
            most = fmax(most, ray.clip[k]);
        wo_table_node node;
        wo_lens_table_node(table, line, h, &node);
        const float s[16] = {(float)u[0]};
        const float t[16] = {(float)u[1]};
        float out[5][16];
        const wo_table_rays rays = {out[0], out[1], out[2], out[3], out[4], NULL};
        wo_table_eval_base(table, &node, s, t, 1, &rays);
        c.disagreed += (most <= 1) != (out[4][0] > 0);
        if (most > 1)
            continue;
        double worst = 0;
        for (int side = 0; side < 2; side++) {
            const double dv = side * blur;
            const double ex = (double)out[0][0] - ray.a[0] + dv * ((double)out[2][0] - ray.b[0]);
            const double ey = (double)out[1][0] - ray.a[1] + dv * ((double)out[3][0] - ray.b[1]);
            worst = fmax(worst, focal_px * hypot(ex, ey));
        }
        sum += worst * worst;
        c.worst_px = fmax(c.worst_px, worst);
        c.open++;
    }
    c.rms_px = c.open > 0 ? sqrt(sum / c.open) : INFINITY;
    return c;
}

static void one_lens(const char *name, double f_number)
{
    wo_error error = {WO_OK, ""};
    const wo_prescription lens = builtin(name);
    wo_system system;
    wo_first_order first;
    wo_system_make(&lens, WO_NM_D, &system);
    wo_system_first_order(&system, WO_MERIDIAN_X, &first);
    if (f_number > 0 && f_number < first.fno)
        return;
    const double degrees = lens.half_field > 0 ? lens.half_field : 10;
    wo_exact_lens exact;
    if (wo_exact_lens_make(&lens, f_number, 0.4, tan(degrees * 3.14159265358979 / 180), lines_nm,
                           LINES, &exact, &error) != WO_OK)
        fail_msg("%s", error.text);
    assert_close(exact.f_number, f_number > 0 ? f_number : first.fno, 1e-12);
    const wo_lens_model model = wo_exact_lens_model(&exact);
    const double focal_px = 1920 * first.efl / 36;
    wo_context context = WO_CONTEXT_INIT;
    unsigned threads = 4;
    context.runner = threads_runner(&threads);
    wo_lens_table *table;
    if (wo_lens_table_create(&context, &model, lines_nm, LINES, focal_px, 0.4, 0.03, &table,
                             &error) != WO_OK)
        fail_msg("%s", error.text);
    assert_true(table->field_lit > 0 && table->field_lit <= table->field_max * (1 + 1e-12));
    const comparison c = compare(table, &model, focal_px, 0.4, 11);
    print_message("%-28s f/%-5.2f said %.4f px, found %.4f px, worst %.3f px; %d of %d rays pass, "
                  "%d wrongly; degree %d, %d nodes\n",
                  name, exact.f_number, table->rms_px, c.rms_px, c.worst_px, c.open, RAYS,
                  c.disagreed, table->degree, table->nodes);
    wo_lens_table_destroy(&context, &table);
    assert_null(table);
    assert_true(c.open > RAYS / 4);
    assert_at_most(c.rms_px, 0.05);
    assert_at_most(c.disagreed, 0.01 * RAYS);
}

/* Newton's method must not end at the second ray of an iris point that lands at the same place,
   near to grazing: all quantities are smooth over the iris. */
static void rays_of_one_family(void **state)
{
    (void)state;
    enum { STEPS = 100 };
    wo_error error = {WO_OK, ""};
    const wo_prescription lens = builtin("tessar_brendel_100_f28");
    wo_exact_lens exact;
    assert_int_equal(wo_exact_lens_make(&lens, 0, 0.4, tan(22 * 3.14159265358979 / 180), lines_nm,
                                        LINES, &exact, &error),
                     WO_OK);
    const wo_lens_model model = wo_exact_lens_model(&exact);
    for (int line = 0; line < LINES; line++) {
        for (int field = 0; field <= 4; field++) {
            wo_model_ray before = {.weight = 0};
            for (int i = 0; i <= STEPS; i++) {
                const double u[2] = {-1 + 2.0 * i / STEPS, 0};
                wo_model_ray ray;
                assert_true(wo_lens_model_ray(&model, model.field_max * field / 4, u,
                                              lines_nm[line], &ray));
                if (i > 0) {
                    assert_near(ray.weight, before.weight, 0.02);
                    assert_near(ray.b[0] - before.b[0], 37e-3 / STEPS, 8e-3 / STEPS);
                    for (int k = 0; k < model.clips; k++)
                        assert_near(ray.clip[k], before.clip[k], 0.06);
                }
                before = ray;
            }
        }
    }
}

static const double stops[] = {0, 2.8, 8};

#define LENS_TEST(name)                                                                            \
    static void name(void **state)                                                                 \
    {                                                                                              \
        (void)state;                                                                               \
        for (size_t i = 0; i < WO_COUNT(stops); i++)                                               \
            one_lens(#name, stops[i]);                                                             \
    }

LENS_TEST(dgauss_codev_100_f2)
LENS_TEST(biotar_zeiss_100_f14)
LENS_TEST(cooke_triplet_50_f5)
LENS_TEST(tessar_brendel_100_f28)
LENS_TEST(petzval_kodak_100)
LENS_TEST(telephoto_laikin_f56)
LENS_TEST(retrofocus_nikon_100_f28)
LENS_TEST(masterprime_zeiss_asph)
LENS_TEST(zoom_canon_70_200_at_72)
LENS_TEST(doublet_thorlabs_ac508_250a)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_of_one_family),          cmocka_unit_test(dgauss_codev_100_f2),
        cmocka_unit_test(biotar_zeiss_100_f14),        cmocka_unit_test(cooke_triplet_50_f5),
        cmocka_unit_test(tessar_brendel_100_f28),      cmocka_unit_test(petzval_kodak_100),
        cmocka_unit_test(telephoto_laikin_f56),        cmocka_unit_test(retrofocus_nikon_100_f28),
        cmocka_unit_test(masterprime_zeiss_asph),      cmocka_unit_test(zoom_canon_70_200_at_72),
        cmocka_unit_test(doublet_thorlabs_ac508_250a),
    };
    return cmocka_run_group_tests_name("lens_table", tests, NULL, NULL);
}
