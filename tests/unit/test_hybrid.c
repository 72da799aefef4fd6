/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/hybrid.h"
#include "near.h"
#include "scenes.h"

#include <math.h>
#include <string.h>

enum { CELL = WO_HYBRID_CELL };

/* Two pictures of one cell: what the filter shows, and the same with an error of the filter
   (offset everywhere, wave of detail) and noise of the rays on top. */
typedef struct pair {
    float rays[CELL][CELL][4], filtered[CELL][CELL][4];
    wo_hybrid_noise noise;
} pair;

static void make(pair *p, rng *r, float offset, float wave, float noise)
{
    double square = 0;
    for (int y = 0; y < CELL; y++) {
        for (int x = 0; x < CELL; x++) {
            for (int k = 0; k < 4; k++) {
                const float light = 0.5f;
                const float grain = noise * (float)rng_range(r, -1, 1);
                p->filtered[y][x][k] = k < 3 ? light : 1;
                p->rays[y][x][k] =
                    k < 3 ? light + offset + ((x + y) & 1 ? wave : -wave) + grain : 1;
                const float e = grain * wo_hybrid_scale(light);
                square += k < 3 ? (double)(e * e) / (3 * CELL * CELL) : 0;
            }
        }
    }
    p->noise = (wo_hybrid_noise){.noise = (float)square, .shown = 1};
}

static wo_hybrid_lean lean_of(pair *p)
{
    float(*rays[CELL])[4];
    float(*filtered[CELL])[4];
    wo_hybrid_lean lean;
    for (int y = 0; y < CELL; y++) {
        rays[y] = p->rays[y];
        filtered[y] = p->filtered[y];
    }
    wo_hybrid_lean_on(rays, filtered, &p->noise, &lean);
    return lean;
}

/* Largest difference of the result from the picture without noise. */
static double mix_error(pair *p, const wo_hybrid_lean *lean, float offset, float wave)
{
    const wo_hybrid_lean *const around[3][3] = {
        {lean, lean, lean}, {lean, lean, lean}, {lean, lean, lean}};
    double worst = 0;
    for (int y = 0; y < CELL; y++) {
        for (int x = 0; x < CELL; x++) {
            float out[4];
            wo_hybrid_mix(around, x, y, p->rays[y][x], p->filtered[y][x], out);
            assert_true(out[3] == 1);
            const float want = p->filtered[y][x][0] + offset + ((x + y) & 1 ? wave : -wave);
            for (int k = 0; k < 3; k++)
                worst = fmax(worst, fabs((double)(out[k] - want)));
        }
    }
    return worst;
}

/* Without noise it is the rays' picture, whatever the filter says. */
static void without_noise_rays_stand(void **state)
{
    (void)state;
    rng r = {1};
    for (int i = 0; i < 20; i++) {
        pair p;
        const float offset = (float)rng_range(&r, -0.4, 0.4);
        const float wave = (float)rng_range(&r, -0.1, 0.1);
        make(&p, &r, offset, wave, 0);
        const wo_hybrid_lean lean = lean_of(&p);
        assert_at_most(mix_error(&p, &lean, offset, wave), 1e-6);
        assert_at_most(lean.error, 1e-12);
    }
}

/* Where the filter is right, noise goes: of 0.1 (largest) a tenth may stay, in the mean. */
static void noise_goes_where_the_filter_is_right(void **state)
{
    (void)state;
    rng r = {2};
    double worst = 0;
    for (int i = 0; i < 100; i++) {
        pair p;
        make(&p, &r, 0, 0, 0.1f);
        const wo_hybrid_lean lean = lean_of(&p);
        assert_true(lean.keep == 0);
        worst += mix_error(&p, &lean, 0, 0) / 100;
        assert_true(lean.error > 0 && lean.error < 0.5f * p.noise.noise);
    }
    assert_at_most(worst, 0.01);
}

/* What the filter misses by more than the noise comes from the rays: its mean without their noise,
   its detail with the part of it that is more than noise. */
static void what_the_filter_misses_is_found(void **state)
{
    (void)state;
    rng r = {3};
    for (int i = 0; i < 100; i++) {
        pair p;
        make(&p, &r, 0.2f, 0, 0.1f);
        wo_hybrid_lean lean = lean_of(&p);
        assert_at_most(mix_error(&p, &lean, 0.2f, 0), 0.03);
        make(&p, &r, 0, 0.2f, 0.05f);
        lean = lean_of(&p);
        assert_true(lean.keep > 0.95f);
        assert_at_most(mix_error(&p, &lean, 0, 0.2f), 0.07);
    }
}

/* A cell that is not known keeps its rays, and tells its neighbours nothing. */
static void unknown_cells_stand_alone(void **state)
{
    (void)state;
    rng r = {4};
    pair p;
    make(&p, &r, 0.2f, 0.1f, 0.1f);
    const wo_hybrid_lean known = lean_of(&p);
    const wo_hybrid_lean unknown = {.keep = 1, .shift = {9, 9, 9, 9}};
    const wo_hybrid_lean *const others[3][3] = {
        {&unknown, NULL, &unknown}, {NULL, &known, &unknown}, {&unknown, &unknown, NULL}};
    const wo_hybrid_lean *const alone[3][3] = {{NULL}, {NULL, &known, NULL}, {NULL}};
    const wo_hybrid_lean *const none[3][3] = {
        {&known, &known, &known}, {&known, &unknown, &known}, {&known, &known, &known}};
    for (int y = 0; y < CELL; y++) {
        for (int x = 0; x < CELL; x++) {
            float a[4];
            float b[4];
            wo_hybrid_mix(others, x, y, p.rays[y][x], p.filtered[y][x], a);
            wo_hybrid_mix(alone, x, y, p.rays[y][x], p.filtered[y][x], b);
            assert_memory_equal(a, b, sizeof a);
            wo_hybrid_mix(none, x, y, p.rays[y][x], p.filtered[y][x], a);
            assert_memory_equal(a, p.rays[y][x], sizeof a);
        }
    }
}

/* A lamp in focus that the two pictures show a little differently lights nothing beside it, and
   nothing gets darker than black. */
static void lamps_stay_where_they_are(void **state)
{
    (void)state;
    rng r = {5};
    pair p;
    make(&p, &r, 0, 0, 0.01f);
    for (int k = 0; k < 3; k++) {
        p.filtered[3][4][k] = 1990;
        p.rays[3][4][k] = 2000;
        p.filtered[0][0][k] = 0;
        p.rays[0][0][k] = 0.001f;
    }
    const wo_hybrid_lean lean = lean_of(&p);
    const wo_hybrid_lean *const around[3][3] = {{NULL}, {NULL, &lean, NULL}, {NULL}};
    for (int y = 0; y < CELL; y++) {
        for (int x = 0; x < CELL; x++) {
            float out[4];
            wo_hybrid_mix(around, x, y, p.rays[y][x], p.filtered[y][x], out);
            for (int k = 0; k < 3; k++) {
                assert_true(out[k] >= 0);
                if (y != 3 || x != 4)
                    assert_at_most(fabs((double)(out[k] - p.filtered[y][x][k])), 0.02);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_noise_rays_stand),
        cmocka_unit_test(noise_goes_where_the_filter_is_right),
        cmocka_unit_test(what_the_filter_misses_is_found),
        cmocka_unit_test(unknown_cells_stand_alone),
        cmocka_unit_test(lamps_stay_where_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
