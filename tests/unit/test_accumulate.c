/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/accumulate.h"

#include "near.h"
#include "scenes.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

/* A stack of made-up sheets around a few tiles, and a thin lens of one pencil for all pixels. */
enum { REACH = 30, PIXELS = 64 * 16 };
static const wo_rect area = {-128, -64, 192, 72};
static const wo_rect window = {0, 0, 64, 16};

typedef struct field {
    wo_sheet sheet[WO_SHEETS_MAX];
    int sheets;
    double k; /* px per dioptre */
    wo_stack stack;
    wo_thin_pencils *pencils;
    wo_lens lens;
    wo_lens_rays rays;
} field;

static void field_start(field *f, double k)
{
    *f = (field){.k = k};
}

static wo_sheet *field_sheet(field *f)
{
    wo_sheet *sheet = &f->sheet[f->sheets++];
    assert_int_equal(wo_sheet_create(&plain, area, sheet, NULL), WO_OK);
    sheet->any = true;
    return sheet;
}

static void field_finish(field *f, int samples)
{
    static uint8_t opaque[320 * 136];
    const wo_thin_lens lens = {f->k, 0, 1000};
    const wo_aperture aperture = {.aspect = 1};
    assert_int_equal(
        wo_thin_pencils_create(&plain, &lens, &aperture, 1, samples, 7, &f->pencils, NULL), WO_OK);
    f->lens = wo_thin_pencils_lens(f->pencils);
    f->lens.sets = 1;
    for (size_t i = 0; i < sizeof opaque; i++) {
        double left = 1;
        for (int s = 0; s < f->sheets; s++)
            left *= f->sheet[s].guessed ? 1 : 1 - (double)f->sheet[s].c[i][3];
        opaque[i] = left < 1e-3;
    }
    assert_int_equal(
        wo_stack_create(&plain, f->sheet, (size_t)f->sheets, opaque, area, area, &f->stack, NULL),
        WO_OK);
    assert_int_equal(wo_lens_rays_create(&plain, &f->stack, &f->lens, window, REACH,
                                         WO_LEAVE_OUT_ALL & ~WO_LEAVE_OUT_HIDDEN, &f->rays, NULL),
                     WO_OK);
}

static void field_unfinish(field *f)
{
    wo_lens_rays_destroy(&plain, &f->rays);
    wo_stack_destroy(&plain, &f->stack);
    wo_thin_pencils_destroy(&plain, &f->pencils);
}

static void field_free(field *f)
{
    for (int s = 0; s < f->sheets; s++)
        wo_sheet_destroy(&plain, &f->sheet[s]);
}

/* One random sheet: a base, a slope, steps, gaps and coverage of some kind; vergences up to
   limit. */
static void random_sheet(wo_sheet *sheet, rng *r, double limit, bool opaque)
{
    const double base = rng_range(r, -limit, limit);
    const double slope_x = rng_unit(r) < 0.5 ? rng_range(r, -limit, limit) / 20 : 0;
    const double slope_y = rng_unit(r) < 0.5 ? rng_range(r, -limit, limit) / 20 : 0;
    const double step = rng_unit(r) < 0.4 ? rng_range(r, 0, limit) : 0;
    const double rough = rng_unit(r) < 0.3 ? rng_range(r, 0, limit) * 0.1 : 0;
    const double gaps = opaque || rng_unit(r) < 0.3 ? 0 : rng_range(r, 0, 0.9);
    const int32_t size = rng_int(r, 1, 9);
    const bool partial = !opaque && rng_unit(r) < 0.5;
    const uint64_t salt = rng_bits(r);
    const int32_t w = wo_rect_width(area);
    for (int32_t i = 0; i < w * wo_rect_height(area); i++) {
        rng patch = {salt + (uint64_t)(i / w / size) * 977 + (uint64_t)(i % w / size)};
        const double v = base + slope_x * (i % w - 128) + slope_y * ((double)(i / w) - 64) +
                         step * rng_range(&patch, -1, 1) + rough * rng_range(r, -1, 1);
        const bool gap = rng_unit(&patch) < gaps;
        sheet->v[i] = gap ? NAN : (float)fmin(fmax(v, -limit), limit);
        const float a = gap ? 0 : partial ? (float)rng_range(r, 0, 0.95) : 1;
        for (int k = 0; k < 3; k++)
            sheet->c[i][k] = a * (float)rng_unit(r);
        sheet->c[i][3] = a;
    }
}

/* All pixels of a window by one method. */
typedef struct result {
    float c[PIXELS][4];
    float guessed[PIXELS];
    float error[PIXELS];
    wo_report report;
} result;

static wo_status run_with(const field *f, const wo_renderer *method, const wo_context *context,
                          wo_quality quality, result *out)
{
    const wo_highlights none = {0};
    const wo_defocus job = {.context = context,
                            .stack = &f->stack,
                            .lens = &f->lens,
                            .levels = &f->lens,
                            .level_count = 1,
                            .highlights = &none,
                            .rays = &f->rays,
                            .extent = area,
                            .quality = quality};
    const wo_frame frame = {.window = window,
                            .tiles = wo_tiles_of(window),
                            .c = out->c,
                            .guessed = out->guessed,
                            .error = out->error};
    memset(out, 0, sizeof *out);
    return method->render(&job, &frame, &out->report, NULL);
}

static void run(const field *f, const wo_renderer *method, result *out)
{
    const wo_quality quality = {.samples = f->lens.count};
    assert_int_equal(run_with(f, method, &plain, quality, out), WO_OK);
}

static double amount_left_out(const result *r, const char *what)
{
    for (int i = 0; i < r->report.left_out_count; i++)
        if (strcmp(r->report.left_out[i].what, what) == 0)
            return r->report.left_out[i].amount;
    return 0;
}

static double pixel_difference(const result *a, const result *b, int i)
{
    double most = fabs((double)a->guessed[i] - (double)b->guessed[i]);
    for (int k = 0; k < 4; k++)
        most = fmax(most, fabs((double)a->c[i][k] - (double)b->c[i][k]));
    return most;
}

/* Fraction of pixels that differ by more than limit in colour, coverage or guessed light. */
static double different(const result *a, const result *b, double limit)
{
    int count = 0;
    for (int i = 0; i < PIXELS; i++)
        count += !(pixel_difference(a, b, i) <= limit);
    return count / (double)PIXELS;
}

static double rms(const result *a, const result *b)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++)
        for (int k = 0; k < 4; k++)
            sum += pow((double)a->c[i][k] - (double)b->c[i][k], 2);
    return sqrt(sum / (4 * PIXELS));
}

static result got, want, last;

/* One point of the lens, and seven: the same picture as brute force draws with the same points,
   but for pixels that rounding decides about, and surfaces that pass each other between pixels. */
static void views_agree_with_brute_force(void **state)
{
    (void)state;
    rng r = {3};
    double sum = 0;
    int count = 0;
    for (int try = 0; try < 40; try++) {
        field f;
        field_start(&f, pow(10, rng_range(&r, -1, 3)));
        const int sheets = 1 + try % 5;
        const double radius = (double[]){0.4, 2, 8, REACH}[try / 5 % 4];
        for (int s = 0; s < sheets; s++) {
            random_sheet(field_sheet(&f), &r, radius / f.k, s == sheets - 1);
            f.sheet[s].guessed = s > 0 && s % 3 == 0;
        }
        for (int samples = 1; samples < 8; samples += 6) {
            field_finish(&f, samples);
            const wo_tile_class class = wo_lens_rays_at(&f.rays, 0, 0)->class;
            run(&f, &wo_render_accumulate, &got);
            run(&f, &wo_render_reference, &want);
            field_unfinish(&f);
            /* What is sharp is copied, and coarser levels are another picture. */
            if (class == WO_TILE_SHARP || amount_left_out(&got, "pixels of views") > 0)
                continue;
            const double part = different(&got, &want, 2e-3);
            assert_at_most(part, 0.05);
            sum += part;
            count++;
        }
        field_free(&f);
    }
    print_message("           %.5f of the pixels differ\n", sum / count);
    assert_at_most(sum / count, 0.003);
}

/* Vergences of two planes, the nearer one a square in the middle; random blocks of colour. */
static void two_planes(wo_sheet *sheet, double v_near, double v_far, int32_t size)
{
    const int32_t w = wo_rect_width(area);
    for (int32_t i = 0; i < w * wo_rect_height(area); i++) {
        const int32_t x = i % w + area.x1;
        const int32_t y = i / w + area.y1;
        rng patch = {(uint64_t)((i / w) / size) * 977 + (uint64_t)((i % w) / size)};
        sheet->v[i] = (float)(x >= 20 && x < 44 && y >= 4 && y < 12 ? v_near : v_far);
        for (int k = 0; k < 3; k++)
            sheet->c[i][k] = (float)rng_unit(&patch);
        sheet->c[i][3] = 1;
    }
}

/* One raster position for all: drawn once, and each sample cast into that. */
static void reuse_changes_nothing(void **state)
{
    (void)state;
    for (int depth = 0; depth < 2; depth++) {
        field f;
        field_start(&f, 100);
        two_planes(field_sheet(&f), 0.004 * (1 + depth * 0.01), 0.004, 1);
        field_finish(&f, 64);
        run(&f, &wo_render_accumulate, &got);
        run(&f, &wo_render_reference, &want);
        assert_at_most(different(&got, &want, 2e-3), 0);
        assert_at_most(rms(&got, &want), depth == 0 ? 1e-5 : 1e-3);
        assert_near(amount_left_out(&got, "views of tiles"), 2 * 62, 0);
        assert_true(got.report.steps < want.report.steps / 20);
        field_unfinish(&f);
        field_free(&f);
    }
}

/* Levels of detail: less is drawn, the picture stays; it changes smoothly as the blur grows through
   the levels. */
static void levels_of_detail(void **state)
{
    (void)state;
    double change[80];
    int steps = 0;
    double saved = 0;
    for (double radius = 2.5; radius < 16; radius *= 1.03, steps++) {
        field f;
        field_start(&f, 100);
        two_planes(field_sheet(&f), radius / 100, radius / 100, 5);
        field_finish(&f, 32);
        run(&f, &wo_render_accumulate, &got);
        const double now = amount_left_out(&got, "pixels of views");
        assert_true(now >= saved);
        saved = now;
        if (steps > 0)
            change[steps - 1] = rms(&got, &last);
        last = got;
        field_unfinish(&f);
        field_free(&f);
    }
    /* At least half the samples at a quarter of the pixels. */
    assert_true(saved > 0.5 * 32 * 0.75 * PIXELS);
    field f;
    field_start(&f, 100);
    two_planes(field_sheet(&f), 0.25, 0.25, 5);
    field_finish(&f, 2048);
    run(&f, &wo_render_reference, &want);
    field_unfinish(&f);
    field_finish(&f, 32);
    run(&f, &wo_render_accumulate, &got);
    run(&f, &wo_render_reference, &last);
    assert_true(amount_left_out(&got, "pixels of views") > 0);
    print_message("           error %g, all samples in full %g\n", rms(&got, &want),
                  rms(&last, &want));
    assert_at_most(rms(&got, &want), rms(&last, &want));
    field_unfinish(&f);
    field_free(&f);
    double median = 0;
    double most = 0;
    for (int i = 0; i < steps - 1; i++) {
        int below = 0;
        for (int k = 0; k < steps - 1; k++)
            below += change[k] < change[i];
        median = below == (steps - 1) / 2 ? change[i] : median;
        most = fmax(most, change[i]);
    }
    assert_at_most(most, 2 * median);
}

static void levels_are_shared_evenly(void **state)
{
    (void)state;
    for (double level = 0; level <= 2; level += 0.13) {
        double sum = 0;
        for (int n = 0; n < 64; n++) {
            const int one = wo_accumulate_level_of(level, n);
            assert_true(one == (int)floor(level) || one == (int)ceil(level));
            sum += one;
            assert_near(sum / (n + 1), level, 3.0 / (n + 1));
        }
        assert_near(sum / 64, level, 1.0 / 64);
    }
}

/* A radius of 0..2 px; blocks of many depths, so that no two edges connect or part at once. */
static void small_blurs_grow_smoothly(void **state)
{
    (void)state;
    double change[64];
    int steps = 0;
    for (double radius = 0; radius < 2.001; radius += 0.05, steps++) {
        field f;
        field_start(&f, 100);
        wo_sheet *sheet = field_sheet(&f);
        two_planes(sheet, 0, 0, 2);
        for (int32_t i = 0; i < 320 * 136; i++) {
            rng patch = {(uint64_t)(i / 320 / 7 * 1000 + i % 320 / 7)};
            sheet->v[i] = (float)(rng_range(&patch, -1, 1) * radius / 100);
        }
        field_finish(&f, 64);
        run(&f, &wo_render_accumulate, &got);
        if (steps > 0)
            change[steps - 1] = rms(&got, &last);
        last = got;
        field_unfinish(&f);
        field_free(&f);
    }
    double sorted[64];
    memcpy(sorted, change, sizeof sorted);
    for (int i = 1; i < steps - 1; i++)
        for (int k = i; k > 0 && sorted[k] < sorted[k - 1]; k--) {
            const double swap = sorted[k];
            sorted[k] = sorted[k - 1];
            sorted[k - 1] = swap;
        }
    print_message("           steps: median %g, largest %g\n", sorted[(steps - 1) / 2],
                  sorted[steps - 2]);
    assert_at_most(sorted[steps - 2], 2 * sorted[(steps - 1) / 2]);
}

/* A ray that is cast less than a pixel beside the view: between neighbours of one surface it takes
   their mean; beside another surface it is stopped; beside nothing it goes on. */
static void rays_between_pixels(void **state)
{
    (void)state;
    const int32_t w = wo_rect_width(area);
    for (int beside = 0; beside < 3; beside++) {
        field f;
        field_start(&f, 100);
        wo_sheet *sheet = field_sheet(&f);
        for (int32_t i = 0; i < w * wo_rect_height(area); i++) {
            const bool left = i % w + area.x1 < 32;
            const float c[4] = {left ? 1 : 0, 0.5f, left ? 0 : 1, 1};
            sheet->v[i] = left ? 0.003f : beside == 0 ? 0.003f : -0.25f;
            memcpy(sheet->c[i], c, sizeof c);
            if (!left && beside == 2) {
                sheet->v[i] = NAN;
                memset(sheet->c[i], 0, sizeof c);
            }
        }
        field_finish(&f, 128);
        run(&f, &wo_render_accumulate, &got);
        const float *const edge = got.c[8 * 64 + 31];
        const float *const inside = got.c[8 * 64 + 28];
        assert_near((double)inside[0], 1, 1e-6);
        assert_near((double)inside[3], 1, beside == 2 ? 1e-6 : 0);
        if (beside == 0) {
            assert_true(edge[0] < 0.999f && edge[2] > 0.001f && edge[3] == 1);
        } else if (beside == 1) {
            assert_near((double)edge[0], 1, 1e-6);
            assert_near((double)edge[2], 0, 1e-6);
            assert_near((double)edge[3], 1, 0);
        } else {
            assert_true(edge[3] < 0.999f && edge[3] > 0.9f);
            assert_near((double)edge[0], (double)edge[3], 1e-6);
        }
        field_unfinish(&f);
        field_free(&f);
    }
}

/* In focus behind nothing blurred: the source; one colour: that colour, covered by 1. */
static void what_must_stay(void **state)
{
    (void)state;
    field f;
    field_start(&f, 100);
    two_planes(field_sheet(&f), 0, -0.08, 1);
    field_finish(&f, 50);
    run(&f, &wo_render_accumulate, &got);
    for (int32_t y = 4; y < 12; y++)
        for (int32_t x = 20; x < 44; x++)
            for (int k = 0; k < 4; k++)
                assert_near(
                    (double)got.c[y * 64 + x][k],
                    (double)f.sheet[0].c[(y - area.y1) * wo_rect_width(area) + x - area.x1][k],
                    1e-6);
    for (int i = 0; i < PIXELS; i++)
        assert_true(got.c[i][3] == 1);
    field_unfinish(&f);
    field_free(&f);
    for (int scene_number = 0; scene_number < 6; scene_number++) {
        rng r = {(uint64_t)scene_number};
        field_start(&f, 100);
        for (int s = 0; s < 3; s++) {
            random_sheet(field_sheet(&f), &r, 0.2, s == 2);
            const float a = s == 2 ? 1 : 0.6f;
            for (int32_t i = 0; i < wo_rect_width(area) * wo_rect_height(area); i++)
                for (int k = 0; k < 4; k++)
                    f.sheet[s].c[i][k] = isnan(f.sheet[s].v[i]) ? 0 : k < 3 ? 0.18f * a : a;
        }
        field_finish(&f, 200);
        run(&f, &wo_render_accumulate, &got);
        for (int i = 0; i < PIXELS; i++) {
            assert_true(got.c[i][3] == 1);
            for (int k = 0; k < 3; k++)
                assert_near((double)got.c[i][k], 0.18, 1e-6);
        }
        field_unfinish(&f);
        field_free(&f);
    }
}

/* Adaptive: fewer samples where fewer do; the error that is told is that which is there. */
static void errors_are_told(void **state)
{
    (void)state;
    field f;
    field_start(&f, 100);
    two_planes(field_sheet(&f), 0.06, -0.12, 3);
    field_finish(&f, 2048);
    run(&f, &wo_render_reference, &want);
    field_unfinish(&f);
    for (int samples = 16; samples <= 256; samples *= 4) {
        field_finish(&f, samples);
        const wo_quality quality = {
            .samples = samples, .adaptive = samples == 64, .target_error = 1, .max_rays = samples};
        assert_int_equal(run_with(&f, &wo_render_accumulate, &plain, quality, &got), WO_OK);
        double there = 0;
        double told = 0;
        for (int i = 0; i < PIXELS; i++) {
            for (int k = 0; k < 3; k++)
                there += pow((double)(wo_display(got.c[i][k]) - wo_display(want.c[i][k])), 2) / 3;
            told += pow((double)got.error[i], 2);
        }
        print_message("           %d samples: error %g, told %g\n", samples, sqrt(there / PIXELS),
                      sqrt(told / PIXELS));
        assert_true(told < 4 * there && there < 4 * told);
        field_unfinish(&f);
    }
    field_free(&f);
}

/* Base and AVX2 draw the same. */
static void instruction_sets_agree(void **state)
{
    (void)state;
    rng r = {11};
    field f;
    field_start(&f, 100);
    for (int s = 0; s < 4; s++)
        random_sheet(field_sheet(&f), &r, 0.1, s == 3);
    field_finish(&f, 20);
    wo_context base = plain;
    base.cpu = WO_CPU_BASE;
    run(&f, &wo_render_accumulate, &got);
    assert_int_equal(run_with(&f, &wo_render_accumulate, &base, (wo_quality){.samples = 20}, &want),
                     WO_OK);
    assert_at_most(different(&got, &want, 1e-4), 0.002);
    field_unfinish(&f);
    field_free(&f);
}

/* The effect with this method: the same bytes for any tiles and threads. */
static void tiles_and_threads(void **state)
{
    (void)state;
    static const wo_rect frame = {-13, -7, 150, 90};
    for (int kind = 0; kind < 3; kind++) {
        scene s;
        scene_init(&s, frame);
        scene_px_per_dioptre(&s, kind == 2 ? 90 : 14);
        s.params.method = WO_METHOD_ACCUMULATE;
        s.params.samples = 12;
        s.params.max_radius = 25;
        if (kind == 0)
            scene_fill_layers(&s, 5);
        else
            scene_fill_busy(&s, 6);
        wo_image whole = scene_render(&s, NULL);
        wo_image parts = picture_make(frame, 4);
        const unsigned count = 3;
        wo_context threads = WO_CONTEXT_INIT;
        threads.runner = threads_runner(&count);
        for (int32_t y = frame.y1; y < frame.y2; y += 41)
            for (int32_t x = frame.x1; x < frame.x2; x += 70) {
                const wo_rect part = wo_rect_intersect((wo_rect){x, y, x + 70, y + 41}, frame);
                assert_int_equal(scene_run(&s, &threads, part, &parts, NULL, NULL), WO_OK);
            }
        assert_true(picture_finite(&whole));
        assert_true(picture_same_bytes(&whole, &parts, frame));
        picture_free(&whole);
        picture_free(&parts);
        scene_free(&s);
    }
}

typedef struct bank {
    long calls, fail_at, live;
    long polls, stop_at;
} bank;

static void *bank_get(void *user, size_t bytes)
{
    bank *b = user;
    if (b->calls++ == b->fail_at)
        return NULL;
    b->live++;
    return aligned_alloc(WO_ALIGNMENT, (bytes + WO_ALIGNMENT - 1) / WO_ALIGNMENT * WO_ALIGNMENT);
}

static void bank_put(void *user, void *memory)
{
    bank *b = user;
    b->live -= memory != NULL;
    free(memory);
}

static bool bank_stops(void *user)
{
    bank *b = user;
    return b->polls++ >= b->stop_at;
}

static void no_memory_and_abort(void **state)
{
    (void)state;
    rng r = {5};
    field f;
    field_start(&f, 100);
    random_sheet(field_sheet(&f), &r, 0.05, false);
    random_sheet(field_sheet(&f), &r, 0.05, true);
    field_finish(&f, 3);
    for (int what = 0; what < 2; what++) {
        wo_status status = WO_ERR_NOMEM;
        for (long n = 0; status != WO_OK; n++) {
            bank b = {.fail_at = what == 0 ? n : -1, .stop_at = what == 0 ? LONG_MAX : n};
            wo_context context = plain;
            context.allocator = (wo_allocator){&b, bank_get, bank_put};
            context.abort_user = &b;
            context.aborted = bank_stops;
            status =
                run_with(&f, &wo_render_accumulate, &context, (wo_quality){.samples = 3}, &got);
            assert_int_equal(b.live, 0);
            assert_true(n < 1000);
            assert_true(status == WO_OK || status == (what == 0 ? WO_ERR_NOMEM : WO_ABORTED));
            assert_true(n > 0 || status != WO_OK);
        }
    }
    field_unfinish(&f);
    field_free(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views_agree_with_brute_force),
        cmocka_unit_test(reuse_changes_nothing),
        cmocka_unit_test(levels_of_detail),
        cmocka_unit_test(levels_are_shared_evenly),
        cmocka_unit_test(small_blurs_grow_smoothly),
        cmocka_unit_test(rays_between_pixels),
        cmocka_unit_test(what_must_stay),
        cmocka_unit_test(errors_are_told),
        cmocka_unit_test(instruction_sets_agree),
        cmocka_unit_test(tiles_and_threads),
        cmocka_unit_test(no_memory_and_abort),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
