/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Tables of lenses against the lenses themselves, in rays of the test's own. */
#include "lens_test.h"
#include "optics/lens_choice.h"
#include "optics/lens_table.h"
#include "scenes.h"

static const double lines_nm[] = {450, WO_NM_D, 650};
enum { LINES = 3, RAYS = 2000 };

static int tables; /* good ones so far */

typedef struct comparison {
    int open;                /* rays that the model passes */
    int disagreed;           /* on being blocked */
    double rms_px, worst_px; /* of rays that both pass */
    double lit;              /* largest difference of the lit part of the iris, over the field */
} comparison;

static bool ray_of_table(const wo_lens_table *table, int line, double h, const double u[2],
                         const wo_lens_request *request, double ray[4])
{
    wo_table_node node;
    wo_lens_table_node(table, line, h, &node);
    const float s[16] = {(float)u[0]};
    const float t[16] = {(float)u[1]};
    float out[5][16];
    const wo_table_rays rays = {out[0], out[1], out[2], out[3], out[4], NULL};
    wo_table_eval_base(table, &node, s, t, 1, &rays);
    for (int k = 0; k < 4; k++)
        ray[k] = (double)out[k][0];
    return out[4][0] > 0 && request->focal_px * (hypot(ray[0], ray[1]) +
                                                 request->blur_dioptres * hypot(ray[2], ray[3])) <=
                                request->max_px;
}

static bool ray_of_model(const wo_lens_model *model, int line, double h, const double u[2],
                         const wo_lens_request *request, wo_model_ray *ray)
{
    bool open = wo_lens_model_ray(model, h, u, request->nm[line], ray);
    for (int k = 0; k < model->clips; k++)
        open &= ray->clip[k] <= 1;
    return open && request->focal_px * (hypot(ray->a[0], ray->a[1]) +
                                        request->blur_dioptres * hypot(ray->b[0], ray->b[1])) <=
                       request->max_px;
}

static comparison compare(const wo_lens_table *table, const wo_lens_model *model,
                          const wo_lens_request *request, uint64_t seed)
{
    enum { FIELDS = 12, PLACES = 200 };
    rng random = {seed};
    comparison c = {0};
    double sum = 0;
    int both = 0;
    double got[4];
    wo_model_ray ray;
    for (int i = 0; i < RAYS; i++) {
        const int line = rng_int(&random, 0, LINES - 1);
        const double h = table->field * sqrt(rng_unit(&random));
        const double radius = sqrt(rng_unit(&random));
        const double angle = rng_range(&random, 0, 6.283185307179586);
        const double u[2] = {radius * cos(angle), radius * sin(angle)};
        const bool want = ray_of_model(model, line, h, u, request, &ray);
        const bool has = ray_of_table(table, line, h, u, request, got);
        c.disagreed += want != has;
        c.open += want;
        if (!want || !has)
            continue;
        double worst = 0;
        for (int side = 0; side < 2; side++) {
            const double dv = side * request->blur_dioptres;
            const double ex = got[0] - ray.a[0] + dv * (got[2] - ray.b[0]);
            const double ey = got[1] - ray.a[1] + dv * (got[3] - ray.b[1]);
            worst = fmax(worst, request->focal_px * hypot(ex, ey));
        }
        sum += worst * worst;
        c.worst_px = fmax(c.worst_px, worst);
        both++;
    }
    c.rms_px = both > 0 ? sqrt(sum / both) : INFINITY;
    for (int k = 0; k <= FIELDS; k++) {
        const double h = model->field_max * k / FIELDS;
        int more = 0;
        for (int i = 0; i < PLACES; i++) {
            const double radius = sqrt((i + 0.5) / PLACES);
            const double u[2] = {radius * cos(2.4 * i), radius * sin(2.4 * i)};
            more += h <= table->field && ray_of_table(table, 1, h, u, request, got);
            more -= ray_of_model(model, 1, h, u, request, &ray);
        }
        c.lit = fmax(c.lit, fabs((double)more) / PLACES);
    }
    return c;
}

/* The table of a design, and how good it is, at 50 mm on a sensor of 36 mm and 960 px. */
static void one_lens(const char *name, double f_number)
{
    wo_error error = {WO_OK, ""};
    wo_prescription lens = builtin(name);
    wo_system system;
    wo_first_order first;
    wo_system_make(&lens, WO_NM_D, &system);
    wo_system_first_order(&system, WO_MERIDIAN_X, &first);
    if (f_number > 0 && f_number < first.fno)
        return;
    wo_prescription_scale(&lens, 50 / first.efl);
    const double half_field = hypot(18, 18 * 9.0 / 16) / 50;
    wo_exact_lens exact;
    if (wo_exact_lens_make(&lens, f_number, 0.4, half_field, lines_nm, LINES, &exact, &error) !=
        WO_OK)
        fail_msg("%s", error.text);
    assert_close(exact.f_number, f_number > 0 ? f_number : first.fno, 1e-12);
    const wo_lens_model model = wo_exact_lens_model(&exact);
    const wo_lens_request request = {lines_nm, LINES, 960 * 50 / 36.0, 0.4, 200};
    wo_context context = WO_CONTEXT_INIT;
    unsigned threads = 4;
    context.runner = threads_runner(&threads);
    wo_lens_lit lit;
    wo_lens_table *table;
    if (wo_lens_lit_measure(&context, &model, &request, &lit, &error) != WO_OK ||
        wo_lens_table_create(&context, &model, &request, &lit, 0.03, &table, &error) != WO_OK)
        fail_msg("%s", error.text);
    assert_true(table->field > 0 && table->field <= model.field_max * (1 + 1e-12));
    const comparison c = compare(table, &model, &request, 11);
    const bool good = table->rms_px <= 0.25 && table->lit_error <= 0.02;
    print_message("%-28s f/%-5.2f said %.4f px, found %.4f px, worst %.3f px; %d of %d rays pass, "
                  "%d wrongly; lit said %.3f, found %.3f; degree %d, %d nodes%s\n",
                  name, exact.f_number, table->rms_px, c.rms_px, c.worst_px, c.open, RAYS,
                  c.disagreed, table->lit_error, c.lit, table->degree, table->nodes,
                  good ? "" : ": not good enough, and it says so");
    wo_lens_table_destroy(&context, &table);
    assert_null(table);
    if (!good)
        return;
    tables++;
    assert_at_most(c.rms_px, 0.25);
    assert_at_most(c.disagreed, 0.01 * RAYS);
    assert_at_most(c.lit, 0.025); /* 0.02, and one of 200 places */
}

/* Either a table is right, or it says that it is not; and most are. */
static void every_lens(void **state)
{
    (void)state;
    static const double stops[] = {0, 2.8, 8};
    tables = 0;
    int all = 0;
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        const wo_prescription lens = builtin(wo_lens_name_at(i));
        wo_error error;
        if (wo_lens_model_check(&lens, &error) != WO_OK)
            continue;
        all++;
        for (size_t k = 0; k < WO_COUNT(stops); k++)
            one_lens(wo_lens_name_at(i), stops[k]);
    }
    assert_true(tables >= 2 * all);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_of_one_family),
        cmocka_unit_test(every_lens),
    };
    return cmocka_run_group_tests_name("lens_table", tests, NULL, NULL);
}
