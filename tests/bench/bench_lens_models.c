/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Error against run time of the lens models, for lenses that come with the library: RMS and worst
   error of the ray at the sensor (px on 1920 px of a 36 mm sensor, of rays through random places of
   field, iris and wavelength, focused at 2.5 m, in the plane of focus or at infinity) and
   nanoseconds for one ray on one core. trace: the exact ray through all surfaces alone; exact:
   aimed at a place in the iris, as the model gives it. */
#include "effects/lens_blur_plan.h"
#include "optics/lens_choice.h"
#include "optics/lens_table.h"
#include "tests/property/scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { RAYS = 4096, REPEATS = 20 };

static const double lines_nm[] = {430, 470, 510, 550, 590, 630, 670};

static double time_table(const wo_lens_table *table, wo_table_function *eval)
{
    static float s[RAYS], t[RAYS], out[5][RAYS];
    for (int i = 0; i < RAYS; i++) {
        const double r = sqrt((i + 0.5) / RAYS);
        s[i] = (float)(r * cos(2.4 * i));
        t[i] = (float)(r * sin(2.4 * i));
    }
    double best = 1e30;
    for (int k = 0; k < REPEATS; k++) {
        const double start = wo_seconds();
        wo_table_node node;
        /* 64 rays of one field point and wavelength, as in a render of some hundred rays. */
        for (int i = 0; i < RAYS; i += 64) {
            const wo_table_rays part = {out[0] + i, out[1] + i, out[2] + i,
                                        out[3] + i, out[4] + i, NULL};
            wo_lens_table_node(table, i / 64 % table->lines, table->field * i / RAYS, &node);
            eval(table, &node, s + i, t + i, 64, &part);
        }
        best = fmin(best, wo_seconds() - start);
    }
    return best / RAYS * 1e9;
}

/* One exact trace through the whole lens, as fast as it gets: no aiming. */
static double time_trace(const wo_prescription *lens)
{
    static double v[6][RAYS];
    static uint8_t outcome[RAYS];
    wo_system system;
    wo_system_make(lens, WO_NM_D, &system);
    wo_first_order first;
    wo_system_first_order(&system, WO_MERIDIAN_X, &first);
    const wo_rays rays = {v[0], v[1], v[2], v[3], v[4], v[5], NULL, outcome};
    double best = 1e30;
    for (int k = 0; k < REPEATS; k++) {
        for (int i = 0; i < RAYS; i++) {
            const double r = 0.35 * first.ep_d * sqrt((i + 0.5) / RAYS);
            v[0][i] = r * cos(2.4 * i);
            v[1][i] = r * sin(2.4 * i);
            v[2][i] = -1;
            v[3][i] = v[4][i] = 0;
            v[5][i] = 1;
        }
        const double start = wo_seconds();
        wo_system_trace(&system, 0, system.count - 1, false, 0, &rays, RAYS, NULL, NULL);
        best = fmin(best, wo_seconds() - start);
    }
    return best / RAYS * 1e9;
}

static double time_exact(const wo_lens_model *model)
{
    enum { COUNT = 256 };
    double u[COUNT][2];
    for (int i = 0; i < COUNT; i++) {
        const double r = sqrt((i + 0.5) / COUNT);
        u[i][0] = r * cos(2.4 * i);
        u[i][1] = r * sin(2.4 * i);
    }
    double best = 1e30;
    double sum = 0;
    for (int k = 0; k < 5; k++) {
        const double start = wo_seconds();
        for (int i = 0; i < COUNT; i++) {
            wo_model_ray ray = {.weight = 0};
            (void)wo_lens_model_ray(model, model->field_max * i / 400, u[i], WO_NM_D, &ray);
            sum += ray.a[0] + ray.b[0];
        }
        best = fmin(best, wo_seconds() - start);
    }
    return isfinite(sum) ? best / COUNT * 1e9 : NAN; /* the sum keeps the work alive */
}

/* RMS error of a model against the exact one in rays that get through, at best focus each: in the
   plane of focus and at infinity, the larger. */
static double model_error(const wo_lens_model *model, const wo_lens_model *exact, double focal_px,
                          double dv)
{
    rng r = {77};
    double sum = 0;
    int count = 0;
    wo_lens_model focused = *model;
    wo_lens_model truth = *exact;
    focused.refocus = wo_lens_model_best_focus(model);
    truth.refocus = wo_lens_model_best_focus(exact);
    for (int i = 0; i < 600; i++) {
        const double h = exact->field_max * sqrt(rng_unit(&r));
        const double radius = sqrt(rng_unit(&r));
        const double angle = rng_range(&r, 0, 6.283185307179586);
        const double u[2] = {radius * cos(angle), radius * sin(angle)};
        const double nm = lines_nm[rng_int(&r, 0, (int)WO_COUNT(lines_nm) - 1)];
        wo_model_ray got = {.weight = 0};
        wo_model_ray want = {.weight = 0};
        bool passes = wo_lens_model_ray(&truth, h, u, nm, &want);
        for (int k = 0; passes && k < exact->clips; k++)
            passes = want.clip[k] <= 1;
        if (!passes || !wo_lens_model_ray(&focused, h, u, nm, &got))
            continue;
        double worst = 0;
        for (int side = 0; side < 2; side++)
            worst = fmax(worst, hypot(got.a[0] - want.a[0] + side * dv * (got.b[0] - want.b[0]),
                                      got.a[1] - want.a[1] + side * dv * (got.b[1] - want.b[1])));
        sum += worst * worst;
        count++;
    }
    return count > 0 ? focal_px * sqrt(sum / count) : NAN;
}

/* The thin lens: nothing but its pupil. */
static bool thin_ray(const void *self, double h, const double u[2], double nm, wo_model_ray *ray)
{
    const double *radius = self;
    (void)h;
    (void)nm;
    for (int k = 0; k < 2; k++) {
        ray->a[k] = 0;
        ray->b[k] = *radius * u[k];
    }
    ray->weight = 1;
    return true;
}

/* The simpler models of the same lens. */
static void print_models(const wo_prescription *lens, const wo_lens_model *exact, double f_number,
                         double efl, double focal_px)
{
    wo_zonal_lens zonal = {.radius = 0.5e-3 * efl / f_number, .half_field = exact->field_max};
    wo_seidel_lens seidel;
    wo_error error = {0};
    const wo_lens_model zonal_model = wo_zonal_lens_model(&zonal);
    const wo_lens_model thin = {.self = &zonal.radius,
                                .field_max = exact->field_max,
                                .reference_nm = WO_NM_D,
                                .ray = thin_ray};
    printf("  thin %.2f px %.1f ns", model_error(&thin, exact, focal_px, 0.4), time_exact(&thin));
    if (wo_diagram_of_lens(lens, f_number, 0.4, lines_nm, (int)WO_COUNT(lines_nm), &zonal.diagram,
                           &error) == WO_OK) {
        zonal.radius = 1e-3 * zonal.diagram.radius;
        printf(", diagram %.2f px %.0f ns", model_error(&zonal_model, exact, focal_px, 0.4),
               time_exact(&zonal_model));
    } else
        printf(", diagram: %s", error.text);
    if (wo_seidel_lens_make(lens, f_number, exact->field_max, lines_nm, (int)WO_COUNT(lines_nm),
                            &seidel, &error) == WO_OK) {
        const wo_lens_model model = wo_seidel_lens_model(&seidel);
        printf(", Seidel %.2f px %.0f ns", model_error(&model, exact, focal_px, 0.4),
               time_exact(&model));
    }
    printf("\n");
}

int main(void)
{
    static const char *const names[] = {"dgauss_codev_100_f2",      "biotar_zeiss_100_f14",
                                        "cooke_triplet_50_f5",      "tessar_brendel_100_f28",
                                        "petzval_kodak_100",        "telephoto_laikin_f56",
                                        "retrofocus_nikon_100_f28", "masterprime_zeiss_asph",
                                        "zoom_canon_70_200_at_72",  "doublet_thorlabs_ac508_250a"};
    unsigned threads = (unsigned)sysconf(_SC_NPROCESSORS_ONLN);
    wo_context context = WO_CONTEXT_INIT;
    context.runner = threads_runner(&threads);
    printf("%-28s %5s  %-8s %-9s %6s %5s  %9s %9s  %8s %8s %8s\n", "lens", "f/", "RMS px",
           "worst px", "degree", "nodes", "table ns", "plain ns", "trace ns", "exact ns", "fit s");
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        static const double stops[] = {0, 2.8, 8};
        for (size_t k = 0; k < WO_COUNT(stops); k++) {
            wo_prescription lens;
            wo_error error = {0};
            wo_exact_lens exact;
            wo_lens_table *table;
            if (wo_lens_find(names[i], &lens, &error) != WO_OK)
                goto fail;
            wo_system system;
            wo_first_order first;
            wo_system_make(&lens, WO_NM_D, &system);
            wo_system_first_order(&system, WO_MERIDIAN_X, &first);
            if (stops[k] > 0 && stops[k] < first.fno)
                continue;
            const double half = tan((lens.half_field > 0 ? lens.half_field : 10) * 3.14159 / 180);
            if (wo_exact_lens_make(&lens, stops[k], 0.4, half, lines_nm, (int)WO_COUNT(lines_nm),
                                   &exact, &error) != WO_OK)
                goto fail;
            const wo_lens_model model = wo_exact_lens_model(&exact);
            const double focal_px = 1920 * first.efl / 36;
            const double start = wo_seconds();
            const wo_lens_request request = {lines_nm, (int)WO_COUNT(lines_nm), focal_px, 0.4,
                                             INFINITY};
            wo_lens_lit lit;
            if (wo_lens_lit_measure(&context, &model, &request, &lit, &error) != WO_OK ||
                wo_lens_table_create(&context, &model, &request, &lit, 0.03, &table, &error) !=
                    WO_OK)
                goto fail;
            const double seconds = wo_seconds() - start;
            printf("%-28s %5.2f  %-8.4f %-9.4f %6d %5d  %9.2f %9.2f  %8.1f %8.0f %8.3f\n", names[i],
                   exact.f_number, table->rms_px, table->worst_px, table->degree, table->nodes,
                   time_table(table, wo_table_choose(wo_cpu_detect(WO_CPU_AUTO))),
                   time_table(table, wo_table_eval_base), time_trace(&lens), time_exact(&model),
                   seconds);
            print_models(&lens, &model, exact.f_number, first.efl, focal_px);
            fflush(stdout);
            wo_lens_table_destroy(&context, &table);
            continue;
        fail:
            printf("%s: %s\n", names[i], error.text);
            break;
        }
    }
    return 0;
}
