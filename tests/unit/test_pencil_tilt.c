/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "optics/pencil_tilt.h"

#include "near.h"
#include "scenes.h"

static const wo_context plain = WO_CONTEXT_INIT;

/* A lens with rays that do not meet in a point, whatever the focus: A is not 0. */
enum { RAYS = 700 };
typedef struct rough_lens {
    float ax[RAYS], ay[RAYS], bx[RAYS], by[RAYS];
} rough_lens;

static void rough_pencil(const void *self, double x, double y, unsigned set, int first,
                         wo_pencil_room *room, wo_pencil *out)
{
    (void)x;
    (void)y;
    (void)set;
    (void)room;
    const rough_lens *l = self;
    const int left = RAYS - first;
    *out = (wo_pencil){.count = left < WO_PENCIL_PIECE ? left : WO_PENCIL_PIECE,
                       .ax = l->ax + first,
                       .ay = l->ay + first,
                       .bx = l->bx + first,
                       .by = l->by + first};
}

static double rough_reach(const void *self, double v_far, double v_near)
{
    (void)self;
    return 3 + 40 * fmax(fabs(v_far), fabs(v_near));
}

static wo_lens rough(rough_lens *l, uint64_t seed)
{
    rng r = {seed};
    for (int i = 0; i < RAYS; i++) {
        const double turn = rng_range(&r, 0, 6.28);
        const double b = 40 * sqrt(rng_unit(&r));
        l->ax[i] = (float)rng_range(&r, -2, 2);
        l->ay[i] = (float)rng_range(&r, -2, 2);
        l->bx[i] = (float)(b * cos(turn));
        l->by[i] = (float)(b * sin(turn));
    }
    return (wo_lens){.self = l,
                     .sets = 1,
                     .count = RAYS,
                     .pencil = rough_pencil,
                     .reach = rough_reach,
                     .px_per_dioptre = 30};
}

/* Where a ray crosses a surface that is w from the focus at its own pixel: follow the ray of the
   lens inside, at the vergence w + vf(p) of wherever it arrives, until it stays there. */
static void brute_force(const double a[2], const double b[2], const double tilt[2], double w,
                        double d[2])
{
    d[0] = d[1] = 0;
    for (int i = 0; i < 200; i++) {
        const double v = w + tilt[0] * d[0] + tilt[1] * d[1]; /* from vf(x) */
        d[0] = a[0] + b[0] * v;
        d[1] = a[1] + b[1] * v;
    }
}

static void rays_are_those_of_a_tilted_plane(void **state)
{
    (void)state;
    static rough_lens rays;
    const wo_lens inside = rough(&rays, 1);
    assert_near(wo_lens_slope(&inside), 40, 1e-9);
    rng r = {2};
    for (int n = 0; n < 30; n++) {
        const double slope = rng_range(&r, 0, 0.5);
        const double turn = rng_range(&r, 0, 6.28);
        const wo_tilted_pencils tilted = {
            &inside, {slope / 40 * cos(turn), slope / 40 * sin(turn)}, slope};
        const wo_lens lens = wo_tilted_pencils_lens(&tilted);
        assert_null(lens.connect);
        static wo_pencil_room room;
        int seen = 0;
        for (int first = 0; first < RAYS; first += WO_PENCIL_PIECE) {
            wo_pencil p;
            lens.pencil(lens.self, 7.5, 9.5, 0, first, &room, &p);
            for (int i = 0; i < p.count; i++, seen++) {
                const double a[2] = {(double)rays.ax[seen], (double)rays.ay[seen]};
                const double b[2] = {(double)rays.bx[seen], (double)rays.by[seen]};
                const double w = rng_range(&r, -2, 2);
                double want[2];
                brute_force(a, b, tilted.b, w, want);
                const double got[2] = {(double)p.ax[i] + w * (double)p.bx[i],
                                       (double)p.ay[i] + w * (double)p.by[i]};
                assert_near(got[0], want[0], 2e-4);
                assert_near(got[1], want[1], 2e-4);
                assert_at_most(hypot(got[0], got[1]), lens.reach(lens.self, w, w) + 1e-4);
            }
        }
        assert_int_equal(seen, RAYS);
    }
}

static void connections_keep_the_light(void **state)
{
    (void)state;
    const wo_thin_lens thin = {.k = 60, .vf = 0, .focal_px = 1000};
    const double stretches[] = {1, 0.6, 1.7};
    rng r = {3};
    for (int n = 0; n < 9; n++) {
        const wo_aperture aperture = {.blades = n % 3 ? 5 : 0, .aspect = 1, .opening = 1};
        wo_thin_pencils *pencils = NULL;
        assert_int_equal(wo_thin_pencils_create(&plain, &thin, &aperture, stretches[n / 3], 16, 0,
                                                &pencils, NULL),
                         WO_OK);
        const wo_lens inside = wo_thin_pencils_lens(pencils);
        const double slope = rng_range(&r, 0.1, 0.5);
        const double turn = rng_range(&r, 0, 6.28);
        const double steep = slope / wo_lens_slope(&inside);
        const wo_tilted_pencils tilted = {&inside, {steep * cos(turn), steep * sin(turn)}, slope};
        const wo_lens lens = wo_tilted_pencils_lens(&tilted);
        const double w = n % 2 ? 0.5 : -0.4;
        const int reach = (int)lens.reach(lens.self, w, w) + 2;
        const double step = 0.5;
        double sum = 0;
        for (double y = -reach; y <= reach; y += step)
            for (double x = -reach; x <= reach; x += step) {
                double line[4];
                const double density = lens.connect(lens.self, x, y, w, line);
                if (!(density > 0))
                    continue;
                sum += density * step * step;
                /* The line goes where it should, and is a ray of the lens inside. */
                assert_near(line[0] + w * line[2], x, 1e-9);
                assert_near(line[1] + w * line[3], y, 1e-9);
                assert_near(hypot(line[0], line[1]), 0, 1e-12);
            }
        assert_near(sum, 1, 0.01);
        wo_thin_pencils_destroy(&plain, &pencils);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_are_those_of_a_tilted_plane),
        cmocka_unit_test(connections_keep_the_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
