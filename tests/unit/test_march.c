/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/march.h"

#include "cases.h"
#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

/* A stack around one block of pixels, wide enough for rays of REACH px, and its lens. */
enum { REACH = 60, ROWS = 8, RAYS = 300 };
static const wo_rect area = {-64, -72, 128, 80};
typedef struct field {
    wo_stack stack;
    wo_march_view view;
    wo_thin_pencils *pencils;
    wo_lens lens;
} field;

/* One random sheet: a base, a slope, steps, gaps and coverage of some kind; vergences within
   +-limit. */
static void random_sheet(wo_sheet *sheet, rng *r, double limit, bool opaque)
{
    assert_int_equal(wo_sheet_create(&plain, area, sheet, NULL), WO_OK);
    const double base = rng_range(r, -limit, limit);
    const double slope_x = rng_unit(r) < 0.5 ? rng_range(r, -limit, limit) / 20 : 0;
    const double slope_y = rng_unit(r) < 0.5 ? rng_range(r, -limit, limit) / 20 : 0;
    const double step = rng_unit(r) < 0.4 ? rng_range(r, 0, limit) : 0;
    const bool levels = rng_unit(r) < 0.3; /* only -limit, 0 and limit: sheets that meet */
    const double rough = rng_unit(r) < 0.3 ? rng_range(r, 0, limit) * 0.1 : 0;
    const double gaps = opaque || rng_unit(r) < 0.3 ? 0 : rng_range(r, 0, 0.9);
    const int32_t size = rng_int(r, 1, 9);
    const bool partial = !opaque && rng_unit(r) < 0.5;
    uint64_t salt = rng_bits(r);
    const int32_t w = wo_rect_width(area);
    for (int32_t i = 0; i < w * wo_rect_height(area); i++) {
        rng patch = {salt + (uint64_t)(i / w / size) * 977 + (uint64_t)(i % w / size)};
        const double v = base + slope_x * (i % w - 80) + slope_y * ((double)(i / w) - 80) +
                         step * rng_range(&patch, -1, 1) + rough * rng_range(r, -1, 1);
        const bool gap = rng_unit(&patch) < gaps;
        const double level = v < -limit / 2 ? -limit : v < limit / 2 ? 0 : limit;
        sheet->v[i] = gap ? NAN : (float)(levels ? level : fmin(fmax(v, -limit), limit));
        const float a = gap ? 0 : partial ? (float)rng_range(r, 0, 0.95) : 1;
        for (int k = 0; k < 3; k++)
            sheet->c[i][k] = a * (float)rng_unit(r);
        sheet->c[i][3] = a;
    }
    sheet->any = true;
}

/* radius: largest blur, px. */
static void field_make(field *f, rng *r, int sheets, double radius)
{
    const double k = pow(10, rng_range(r, -1, 3));
    const wo_thin_lens lens = {k, 0, 1000};
    const wo_aperture aperture = {.blades = rng_int(r, 0, 1) * 6, .rotation = 11, .aspect = 1};
    assert_int_equal(wo_thin_pencils_create(&plain, &lens, &aperture, 1, RAYS,
                                            (uint32_t)rng_bits(r), &f->pencils, NULL),
                     WO_OK);
    f->lens = wo_thin_pencils_lens(f->pencils);
    wo_sheet sheet[WO_SHEETS_MAX] = {{.v = NULL}};
    static uint8_t opaque[192 * 152];
    const bool solid = rng_unit(r) < 0.7;
    for (int s = 0; s < sheets; s++) {
        random_sheet(&sheet[s], r, radius / k, solid && s == sheets - 1);
        sheet[s].guessed = s > 0 && s % 3 == 0;
    }
    for (size_t i = 0; i < sizeof opaque; i++) {
        double left = 1;
        for (int s = 0; s < sheets; s++)
            left *= sheet[s].guessed ? 1 : 1 - (double)sheet[s].c[i][3];
        opaque[i] = left < 1e-3;
    }
    assert_int_equal(
        wo_stack_create(&plain, sheet, (size_t)sheets, opaque, area, area, &f->stack, NULL), WO_OK);
    f->view = (wo_march_view){.opaque = f->stack.opaque,
                              .run = f->stack.run,
                              .row = f->stack.row,
                              .span_columns = f->stack.cell_columns,
                              .v_connect = (float)(WO_CONNECT_PX / f->lens.px_per_dioptre)};
    const int32_t grow = rng_unit(r) < 0.5 ? (int32_t)ceil(radius) + 3 : 64;
    for (int s = 0; s < f->stack.sheets; s++) {
        unsigned flags = 0;
        const wo_rect near = wo_rect_grow((wo_rect){0, 0, WO_BLOCK, ROWS}, grow, grow);
        const wo_bounds bounds = wo_stack_bounds(&f->stack, s, near, &flags);
        if (bounds.v_min > bounds.v_max)
            continue;
        const int n = f->view.sheets++;
        f->view.bounds[n] = bounds;
        f->view.spans[n] = f->stack.spans[s];
        f->view.v[n] = f->stack.v[s];
        memcpy(f->view.c[n], f->stack.c[s], sizeof f->view.c[n]);
        f->view.guessed[n] = f->stack.guessed[s];
    }
    for (int s = 0; s < sheets; s++)
        wo_sheet_destroy(&plain, &sheet[s]);
}

static void field_free(field *f)
{
    wo_stack_destroy(&plain, &f->stack);
    wo_thin_pencils_destroy(&plain, &f->pencils);
}

static wo_pencil pencil_of(const field *f, unsigned set)
{
    wo_pencil pencil;
    static wo_pencil_room room;
    f->lens.pencil(f->lens.self, 0, 0, set % f->lens.sets, 0, &room, &pencil);
    return pencil;
}

static wo_pencil ray_of(const wo_pencil *pencil, int n)
{
    wo_pencil ray = {.count = 1,
                     .ax = pencil->ax + n,
                     .ay = pencil->ay + n,
                     .bx = pencil->bx + n,
                     .by = pencil->by + n};
    for (int k = 0; k < 3 && pencil->weight[0]; k++)
        ray.weight[k] = pencil->weight[k] + n;
    return ray;
}

static wo_march_sums run(wo_march_function *kernel, const field *f, int32_t row, int run_index,
                         const wo_pencil *pencil)
{
    wo_march_sums sums;
    memset(&sums, 0xff, sizeof sums); /* must be overwritten */
    kernel(&f->view, 0 - area.x1, row - area.y1, run_index, pencil, &sums);
    return sums;
}

/* Differs in any sum of this lane by more than part, relative to those above 1. */
static bool lane_differs(const wo_march_sums *a, const wo_march_sums *b, int lane, double part)
{
    const float *const p[6] = {a->c[0], a->c[1], a->c[2], a->c[3], a->weight[3], a->guessed};
    const float *const q[6] = {b->c[0], b->c[1], b->c[2], b->c[3], b->weight[3], b->guessed};
    for (int k = 0; k < 6; k++) {
        const double want = (double)q[k][lane];
        if (!(fabs((double)p[k][lane] - want) <= part * fmax(1, fabs(want))))
            return true;
    }
    return false;
}

typedef struct tally {
    int64_t rays, different;
} tally;
/* The same of the parts that are kept apart. */
static bool parts_differ(const wo_march_sums *a, const wo_march_sums *b, int lane, double part)
{
    for (int k = 0; k < 2 * WO_PART_SUMS; k++) {
        const int n = k % WO_PART_SUMS;
        const double got = (double)(k < WO_PART_SUMS ? a->near[n] : a->far[n])[lane];
        const double want = (double)(k < WO_PART_SUMS ? b->near[n] : b->far[n])[lane];
        if (!(fabs(got - want) <= part * fmax(1, fabs(want))))
            return true;
    }
    return false;
}

/* Ray by ray against the twin, on random scenes of 1..8 sheets. */
static tally compare(wo_march_function *kernel, bool apart, double radius, uint64_t seed,
                     int scenes)
{
    tally t = {0, 0};
    rng r = {seed};
    for (int try = 0; try < scenes; try++) {
        field f;
        field_make(&f, &r, 1 + try % 8, radius);
        f.view.v_apart = (float)rng_range(&r, 0.01, 0.8) * fmaxf(f.view.bounds[0].v_max, 0.1f);
        for (int run_index = 0; run_index < WO_PHASES; run_index++) {
            const int32_t row = rng_int(&r, 0, ROWS - 1);
            const wo_pencil pencil = pencil_of(&f, (unsigned)rng_int(&r, 0, 1000));
            for (int n = 0; n < 48; n++) {
                const wo_pencil ray = ray_of(&pencil, rng_int(&r, 0, RAYS - 1));
                const wo_march_sums got = run(kernel, &f, row, run_index, &ray);
                const wo_march_sums want = run(wo_march_reference.march, &f, row, run_index, &ray);
                for (int lane = 0; lane < WO_LANES; lane++)
                    t.different += lane_differs(&got, &want, lane, 1e-4) ||
                                   (apart && parts_differ(&got, &want, lane, 1e-4));
                t.rays += WO_LANES;
                assert_true(got.steps >= 0 && got.steps % WO_LANES == 0);
            }
        }
        field_free(&f);
    }
    return t;
}

typedef struct kernel_row {
    const char *name;
    const wo_march_kernels *kernels;
    int cpu;
} kernel_row;

static const kernel_row kernels[] = {
    {"base", &wo_march_base, WO_CPU_BASE},
#if defined(__x86_64__)
    {"AVX2", &wo_march_avx2, WO_CPU_AVX2},
#endif
};

static bool has(const kernel_row *row)
{
    return (wo_cpu_detect(row->cpu) & row->cpu) == row->cpu;
}

/* A ray whose hit or miss is decided by rounding (a vergence within an ulp of the edge of a patch,
   a ray midway between two pixels) may differ: 2 of 3.7 million on random scenes; 1 is allowed in
   each comparison here. */
#define BORDERLINE 3e-5
static double borderline(int64_t rays)
{
    return fmax(1, BORDERLINE * (double)rays);
}

static void rays_agree_with_the_twin(void **state)
{
    (void)state;
    const double radii[] = {0.3, 2, 9, REACH};
    const int few = cases_of(24, 8);
    for (size_t i = 0; i < WO_COUNT(kernels); i++) {
        for (size_t k = 0; k < WO_COUNT(radii) && has(&kernels[i]); k++) {
            const tally t = compare(kernels[i].kernels->march, false, radii[k], k, few);
            const tally apart = compare(kernels[i].kernels->march_apart, true, radii[k], k, few);
            assert_at_most((double)apart.different, borderline(apart.rays));
            print_message("           %s, %g px: %d of %d rays differ\n", kernels[i].name, radii[k],
                          (int)t.different, (int)t.rays);
            assert_at_most((double)t.different, borderline(t.rays));
        }
    }
}

/* Kernels that are wrong in one small way. */
static void blind_to_steps(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                           const wo_pencil *pencil, wo_march_sums *sums)
{
    static wo_span joined[192 * 152 / WO_CELL];
    wo_march_view wrong = *view;
    for (size_t i = 0; i < WO_COUNT(joined); i++)
        joined[i] = (wo_span){-1e6f, 1e6f, 0};
    for (int s = 0; s < view->sheets; s++)
        wrong.spans[s] = joined;
    wo_march_base.march(&wrong, x, y, run_index, pencil, sums);
}

static void blind_to_loss(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                          const wo_pencil *pencil, wo_march_sums *sums)
{
    static const float zeros[192 * 152 * 2];
    wo_march_view wrong = *view;
    wrong.opaque = zeros;
    wo_march_base.march(&wrong, x, y, run_index, pencil, sums);
}

static void stops_early(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                        const wo_pencil *pencil, wo_march_sums *sums)
{
    wo_march_view wrong = *view;
    for (int s = 0; s < view->sheets; s++)
        wrong.bounds[s].v_min += 0.02f * (view->bounds[s].v_max - view->bounds[s].v_min);
    wo_march_base.march(&wrong, x, y, run_index, pencil, sums);
}

static void rays_bent(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                      const wo_pencil *pencil, wo_march_sums *sums)
{
    const float bx = pencil->bx[0] * 1.002f;
    const wo_pencil wrong = {
        .count = 1, .ax = pencil->ax, .ay = pencil->ay, .bx = &bx, .by = pencil->by};
    wo_march_base.march(view, x, y, run_index, &wrong, sums);
}

static void next_run(const wo_march_view *view, int32_t x, int32_t y, int run_index,
                     const wo_pencil *pencil, wo_march_sums *sums)
{
    wo_march_base.march(view, x, y, (run_index + 1) % WO_PHASES, pencil, sums);
}

static void wrong_kernels_are_found(void **state)
{
    (void)state;
    wo_march_function *const wrong[] = {blind_to_steps, blind_to_loss, stops_early, rays_bent,
                                        next_run};
    for (size_t i = 0; i < WO_COUNT(wrong); i++) {
        const tally t = compare(wrong[i], false, 9, 2, 16);
        if (!((double)t.different > 100 * BORDERLINE * (double)t.rays))
            print_error("kernel %zu: %d of %d\n", i, (int)t.different, (int)t.rays);
        assert_true((double)t.different > 100 * BORDERLINE * (double)t.rays);
    }
}

/* Whole pencils are the sums of their rays, each times its weight. */
static void pencils_are_sums_of_rays(void **state)
{
    (void)state;
    rng r = {8};
    const int counts[] = {1, 2, 31, 32, 33, 64, 100, 299, 300};
    float weight[3][RAYS];
    for (int n = 0; n < 3 * RAYS; n++)
        weight[n % 3][n / 3] = n % 7 < 3 ? 0 : (float)rng_range(&r, 0, 2);
    for (size_t i = 0; i < WO_COUNT(counts); i++) {
        field f;
        field_make(&f, &r, 1 + (int)i % 8, 7);
        const kernel_row twin = {"twin", &wo_march_reference, WO_CPU_BASE};
        for (size_t k = 0; k <= WO_COUNT(kernels); k++) {
            const kernel_row *const row = k < WO_COUNT(kernels) ? &kernels[k] : &twin;
            if (!has(row))
                continue;
            wo_pencil pencil = pencil_of(&f, (unsigned)i);
            pencil.count = counts[i];
            for (int weighted = 0; weighted < 2; weighted++) {
                double sum[9][WO_LANES] = {{0}};
                for (int c = 0; c < 3; c++)
                    pencil.weight[c] = weighted ? weight[c] : NULL;
                const wo_march_sums got = run(row->kernels->march, &f, 3, (int)k, &pencil);
                for (int n = 0; n < pencil.count; n++) {
                    wo_pencil ray = ray_of(&pencil, n);
                    ray.weight[0] = NULL;
                    const wo_march_sums one = run(row->kernels->march, &f, 3, (int)k, &ray);
                    double w[4] = {1, 1, 1, 1};
                    for (int c = 0; c < 3 && weighted; c++)
                        w[c] = (double)weight[c][n];
                    w[3] = (w[0] + w[1] + w[2]) / 3;
                    for (int lane = 0; lane < WO_LANES; lane++) {
                        for (int c = 0; c < 4; c++) {
                            sum[c][lane] += w[c] * (double)one.c[c][lane];
                            sum[4 + c][lane] += w[c] * (double)one.weight[3][lane];
                        }
                        sum[8][lane] += w[3] * (double)one.guessed[lane];
                    }
                }
                for (int lane = 0; lane < WO_LANES; lane++) {
                    for (int c = 0; c < 4; c++) {
                        assert_near((double)got.c[c][lane], sum[c][lane], 2e-6 * pencil.count);
                        assert_near((double)got.weight[c][lane], sum[4 + c][lane],
                                    2e-6 * pencil.count);
                    }
                    assert_near((double)got.guessed[lane], sum[8][lane], 2e-6 * pencil.count);
                }
            }
        }
        field_free(&f);
    }
}

/* Rays that do not meet in the pixel itself: a lens with terms of its own in A. */
static void lines_with_an_offset(void **state)
{
    (void)state;
    rng r = {21};
    for (size_t i = 0; i < WO_COUNT(kernels); i++) {
        tally t = {0, 0};
        for (int try = 0; try < cases_of(24, 8) && has(&kernels[i]); try++) {
            field f;
            field_make(&f, &r, 1 + try % 8, 20);
            const float k = (float)f.lens.px_per_dioptre;
            for (int n = 0; n < 200; n++) {
                const float a[2] = {(float)rng_range(&r, -9, 9), (float)rng_range(&r, -9, 9)};
                const float b[2] = {k * (float)rng_range(&r, -0.6, 0.6),
                                    n % 10 == 0 ? 0 : k * (float)rng_range(&r, -0.6, 0.6)};
                const wo_pencil ray = {
                    .count = 1, .ax = &a[0], .ay = &a[1], .bx = &b[n & 1], .by = &b[1 - (n & 1)]};
                const wo_march_sums got = run(kernels[i].kernels->march, &f, n % ROWS, n % 4, &ray);
                const wo_march_sums want = run(wo_march_reference.march, &f, n % ROWS, n % 4, &ray);
                for (int lane = 0; lane < WO_LANES; lane++)
                    t.different += lane_differs(&got, &want, lane, 1e-4);
                t.rays += WO_LANES;
            }
            field_free(&f);
        }
        if (has(&kernels[i]))
            assert_at_most((double)t.different, borderline(t.rays));
    }
}

/* One depth: one lookup is what the march finds. */
static void single_depths(void **state)
{
    (void)state;
    rng r = {5};
    const double blur[] = {0, 0.4, -1.7, 2.2, -30, 55};
    for (size_t i = 0; i < WO_COUNT(kernels); i++) {
        for (size_t d = 0; d < WO_COUNT(blur) && has(&kernels[i]); d++) {
            field f;
            tally t = {0, 0};
            field_make(&f, &r, 1, 1);
            const float v = (float)(blur[d] / f.lens.px_per_dioptre);
            for (int32_t y = area.y1; y < area.y2; y++)
                for (int32_t x = area.x1; x < area.x2; x++)
                    f.stack.v[0][wo_stack_at(&f.stack, x, y)] = v;
            f.view.bounds[0] = (wo_bounds){v, v};
            f.view.guessed[0] = d % 2;
            for (int run_index = 0; run_index < WO_PHASES; run_index++) {
                const wo_pencil pencil = pencil_of(&f, (unsigned)run_index);
                for (int n = 0; n < RAYS; n++) {
                    const wo_pencil ray = ray_of(&pencil, n);
                    const wo_march_sums got =
                        run(kernels[i].kernels->single, &f, 2, run_index, &ray);
                    const wo_march_sums want =
                        run(wo_march_reference.march, &f, 2, run_index, &ray);
                    for (int lane = 0; lane < WO_LANES; lane++)
                        t.different += lane_differs(&got, &want, lane, 1e-4);
                    t.rays += WO_LANES;
                    assert_int_equal(got.steps, WO_LANES);
                }
            }
            assert_at_most((double)t.different / (double)t.rays, 2e-4);
            field_free(&f);
        }
    }
}

static void the_choice_of_kernels(void **state)
{
    (void)state;
    assert_ptr_equal(wo_march_choose(WO_CPU_BASE), &wo_march_base);
#if defined(__x86_64__)
    assert_ptr_equal(wo_march_choose(WO_CPU_AVX2), &wo_march_avx2);
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_agree_with_the_twin),
        cmocka_unit_test(wrong_kernels_are_found),
        cmocka_unit_test(pencils_are_sums_of_rays),
        cmocka_unit_test(lines_with_an_offset),
        cmocka_unit_test(single_depths),
        cmocka_unit_test(the_choice_of_kernels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
