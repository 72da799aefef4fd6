/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "focus/focus.h"

#include "near.h"
#include "scenes.h"

/* Points anywhere in and around the frame, vergences 0..2. */
static int random_points(rng *r, wo_focus_point *points)
{
    const int count = rng_int(r, 1, WO_FOCUS_POINTS);
    for (int i = 0; i < count; i++)
        points[i] = (wo_focus_point){rng_range(r, -1, 1), rng_range(r, -1, 1), rng_range(r, 0, 2),
                                     rng_range(r, 0, 3), rng_range(r, 0.1, 4)};
    return count;
}

static double surface(const wo_focus_point *points, int count, double falloff, double x, double y)
{
    double v = NAN;
    double dof;
    assert_true(wo_focus_surface_at(points, count, falloff, x, y, &v, &dof));
    assert_true(isfinite(v) && isfinite(dof));
    return v;
}

static void interpolates_its_points(void **state)
{
    (void)state;
    rng r = {1};
    for (int n = 0; n < 400; n++) {
        wo_focus_point p[WO_FOCUS_POINTS];
        const int count = random_points(&r, p);
        const double falloff = n % 2 ? rng_int(&r, 1, 8) : rng_range(&r, 1, 8);
        for (int i = 0; i < count; i++) {
            double v;
            double dof;
            assert_true(wo_focus_surface_at(p, count, falloff, p[i].x, p[i].y, &v, &dof));
            assert_close(v, p[i].v, 3e-16); /* a rounding */
            assert_close(dof, p[i].dof, 3e-16);
            /* And on the way to it, whatever the direction: no jump at the point. */
            const double turn = rng_range(&r, 0, 6.28);
            for (double d = 1e-3; d > 1e-9; d *= 0.1) {
                const double near =
                    surface(p, count, falloff, p[i].x + d * cos(turn), p[i].y + d * sin(turn));
                assert_near(near, p[i].v, 3000 * d + 1e-9);
            }
        }
        double v;
        double dof;
        for (int k = 0; k < 20; k++) {
            assert_true(wo_focus_surface_at(p, count, falloff, rng_range(&r, -3, 3),
                                            rng_range(&r, -3, 3), &v, &dof));
            assert_true(dof >= 0 && dof <= 3);
        }
    }
}

/* Finite and bounded however the points lie: in one place, in a line, opposed, far away. */
static void nothing_is_singular(void **state)
{
    (void)state;
    rng r = {2};
    for (int n = 0; n < 600; n++) {
        wo_focus_point p[WO_FOCUS_POINTS];
        const int count = random_points(&r, p);
        const double apart = pow(10, -rng_range(&r, 0, 18));
        for (int i = 0; i < count; i++) {
            const double along = rng_range(&r, -1, 1);
            if (n % 3 == 0) { /* (almost) in one place, opposed */
                p[i].x = 0.25 + apart * p[i].x;
                p[i].y = -0.5 + apart * p[i].y;
                p[i].v = i % 2 ? 1 : -1;
            } else if (n % 3 == 1) { /* (almost) in a line */
                p[i].x = 0.6 * along + apart * p[i].x;
                p[i].y = 0.8 * along + apart * p[i].y;
            } else if (i % 2) { /* pairs in the very same place */
                p[i].x = p[i - 1].x;
                p[i].y = p[i - 1].y;
            }
        }
        const double falloff = rng_range(&r, 1, 8);
        for (int k = 0; k < 40; k++) {
            const double far = k % 8 == 0 ? 1000 : 1.2;
            const double v =
                surface(p, count, falloff, rng_range(&r, -far, far), rng_range(&r, -far, far));
            assert_true(fabs(v) <= 14); /* 2 + 6 standard deviations of at most 2 */
        }
        wo_focus_plane plane;
        assert_true(wo_focus_plane_fit(p, count, &plane));
        assert_true(isfinite(plane.v) && isfinite(plane.gx) && isfinite(plane.gy));
    }
}

static void points_in_one_place_are_averaged(void **state)
{
    (void)state;
    const wo_focus_point p[3] = {{0.5, 0.5, 1, 1, 1}, {0.5, 0.5, 2, 2, 3}, {-0.5, 0, 0.25, 1, 1}};
    double v;
    double dof;
    assert_true(wo_focus_surface_at(p, 3, 3, 0.5, 0.5, &v, &dof));
    assert_near(v, 1.75, 1e-15);
    assert_near(dof, 1.75, 1e-15);
    assert_near(surface(p, 2, 3, -0.9, 0.1), 1.75, 1e-9);
    wo_focus_plane plane;
    assert_true(wo_focus_plane_fit(p, 2, &plane));
    assert_near(plane.v, 1.75, 1e-12);
    assert_true(plane.gx == 0 && plane.gy == 0);
    const wo_focus_point none[1] = {{0, 0, 1, 1, 0}};
    assert_false(wo_focus_surface_at(none, 1, 3, 0, 0, &v, &dof));
    assert_false(wo_focus_plane_fit(none, 1, &plane));
}

/* Along a straight way, second differences fall with the square of the step: no corner anywhere,
   neither at a point nor where the weights change. */
static void is_smooth(void **state)
{
    (void)state;
    rng r = {3};
    for (int n = 0; n < 60; n++) {
        wo_focus_point p[WO_FOCUS_POINTS];
        const int count = random_points(&r, p);
        const double falloff = rng_range(&r, 2, 4);
        const int through = rng_int(&r, 0, count - 1);
        const double turn = rng_range(&r, 0, 6.28);
        double bend[2] = {0, 0};
        for (int fine = 0; fine < 2; fine++) {
            const double h = fine ? 5e-4 : 1e-3;
            for (double t = -0.5; t < 0.5; t += h) {
                double v[3];
                for (int k = 0; k < 3; k++)
                    v[k] = surface(p, count, falloff, p[through].x + (t + k * h) * cos(turn),
                                   p[through].y + (t + k * h) * sin(turn));
                bend[fine] = fmax(bend[fine], fabs(v[0] - 2 * v[1] + v[2]));
            }
        }
        /* A corner would halve, a jump would stay; a smooth curve falls to a quarter. At falloff 2
           .. 4 the curvature itself is bounded, or grows slower than any power near a point. */
        assert_true(bend[1] <= 0.3 * bend[0] + 1e-9);
    }
}

/* Moving or weighing a point moves the surface smoothly: half the step, half the change, also when
   the point goes right through the place that is looked at. */
static void changes_smoothly_with_its_points(void **state)
{
    (void)state;
    rng r = {4};
    for (int n = 0; n < 40; n++) {
        wo_focus_point p[WO_FOCUS_POINTS];
        const int count = random_points(&r, p);
        const double x = rng_range(&r, -1, 1);
        const double y = rng_range(&r, -1, 1);
        const double from_x = p[0].x;
        double largest[2] = {0, 0};
        for (int fine = 0; fine < 2; fine++) {
            const int steps = fine ? 8000 : 4000;
            double last = NAN;
            for (int k = 0; k < steps; k++) {
                const double t = (double)k / steps;
                p[0].x = from_x + t * (2 * x - 2 * from_x);
                p[0].y = y + (n % 2 ? 0.2 * (t - 0.5) : 0.01);
                p[0].weight = 1 - 0.9 * t;
                const double v = surface(p, count, 3, x, y);
                largest[fine] = fmax(largest[fine], k > 0 ? fabs(v - last) : 0);
                last = v;
            }
        }
        assert_at_most(largest[1], 0.6 * largest[0] + 1e-9);
    }
}

static void a_plane_is_found(void **state)
{
    (void)state;
    rng r = {5};
    for (int n = 0; n < 300; n++) {
        wo_focus_point p[WO_FOCUS_POINTS];
        const int count = rng_int(&r, 3, WO_FOCUS_POINTS);
        const double g[3] = {rng_range(&r, 0.1, 2), rng_range(&r, -1, 1), rng_range(&r, -1, 1)};
        for (int i = 0; i < count; i++) {
            p[i] = (wo_focus_point){rng_range(&r, -1, 1), rng_range(&r, -1, 1), 0, 1,
                                    rng_range(&r, 0.5, 2)};
            if (i < 3) { /* three that are well apart */
                p[i].x = cos(2.1 * i + 0.3 * p[i].x);
                p[i].y = sin(2.1 * i + 0.3 * p[i].y);
            }
            p[i].v = g[0] + g[1] * p[i].x + g[2] * p[i].y;
        }
        wo_focus_plane plane;
        assert_true(wo_focus_plane_fit(p, count, &plane));
        assert_near(plane.v, g[0], 1e-6);
        assert_near(plane.gx, g[1], 1e-6);
        assert_near(plane.gy, g[2], 1e-6);
    }
    /* Two points: a slope along their line, none across. */
    const wo_focus_point two[2] = {{-0.3, -0.4, 1, 1, 1}, {0.3, 0.4, 2, 1, 1}};
    wo_focus_plane plane;
    assert_true(wo_focus_plane_fit(two, 2, &plane));
    assert_near(plane.gx, 0.6, 1e-6);
    assert_near(plane.gy, 0.8, 1e-6);
    assert_near(plane.v, 1.5, 1e-12);
}

static void picks_one_surface(void **state)
{
    (void)state;
    rng r = {6};
    for (int n = 0; n < 300; n++) {
        wo_focus_point s[25];
        const double front = rng_range(&r, 1, 2);
        const double slope = n % 3 ? rng_range(&r, -0.02, 0.02) : 0;
        const int columns = rng_int(&r, 3, 5); /* of the front surface; the point lies on it */
        for (int i = 0; i < 25; i++) {
            const double x = i % 5 - 2;
            const double y = i / 5 - 2;
            const bool in_front = i % 5 < columns;
            s[i] = (wo_focus_point){x, y, in_front ? front + slope * (x - 2 * y) : 0.2, 1, 1};
            if (i % 5 == columns && n % 2) /* depth that was antialiased */
                s[i].v = rng_range(&r, 0.3, 0.8);
        }
        assert_near(wo_focus_pick(s, 25), front, 1e-4 + 1e-6 * front);
    }
    /* Outliers do not matter, one sample is enough, of equals the nearer one counts. */
    wo_focus_point s[5] = {
        {0, 0, 1, 1, 1}, {1, 0, 9, 1, 1}, {0, 1, 1, 1, 1}, {1, 1, 0, 1, 1}, {2, 1, 1, 1, 1}};
    assert_near(wo_focus_pick(s, 5), 1, 1e-9);
    assert_near(wo_focus_pick(s, 1), 0, 1e-9);
    wo_focus_point two[2] = {{0, 0, 1, 1, 1}, {1, 0, 2, 1, 1}};
    const double v = wo_focus_pick(two, 2);
    assert_true(v >= 1 && v <= 2);
}

static wo_focus_options options_of(wo_focus_by by)
{
    return (wo_focus_options){.by = by,
                              .vf = 0.5,
                              .falloff = 3,
                              .near_gain = 1,
                              .far_gain = 1,
                              .format = {10, -20, 410, 280},
                              .stretch = 1};
}

static wo_focus focus_of(const wo_focus_options *options, double k)
{
    wo_focus f;
    wo_focus_make(options, &f);
    wo_focus_fit_lens(&f, k, k);
    return f;
}

static void points_fade_outside_the_frame(void **state)
{
    (void)state;
    wo_focus_options o = options_of(WO_FOCUS_BY_POINT);
    o.count = 1;
    double last = NAN;
    double largest = 0;
    for (double px = 300; px < 700; px += 0.25) {
        o.presence[0] = wo_focus_presence(&o, px, 130, 0.4); /* half a diagonal is 250 px */
        assert_true(o.presence[0] >= 0 && o.presence[0] <= 1);
        assert_true(px > 410 || o.presence[0] == 1);
        assert_true(px < 510 || o.presence[0] == 0);
        wo_focus_place(&o, px, 130, &o.points[0]);
        o.points[0].v = 2;
        o.points[0].dof = 1;
        o.points[0].weight = o.presence[0];
        const wo_focus f = focus_of(&o, 100);
        if (px > 300)
            largest = fmax(largest, fabs(f.v_axis - last));
        last = f.v_axis;
        assert_true(px > 410 || f.v_axis == 2);
        assert_true(px < 510 || f.v_axis == 0.5);
    }
    assert_true(largest < 1.5 * 1.6 * 0.25 / 100); /* no pop: the slope of a smooth step */
    assert_near(wo_focus_presence(&o, 5, -25, 0), 0, 0);
    assert_near(wo_focus_presence(&o, 10, -20, 0), 1, 0);
}

static void zones_and_gains(void **state)
{
    (void)state;
    wo_focus_options o = options_of(WO_FOCUS_BY_DISTANCE); /* 2 m */
    o.protect_near = 0.5;
    o.protect_far = 2;
    o.near_gain = 2;
    o.far_gain = 0.5;
    const double k = 80;
    const wo_focus f = focus_of(&o, k);
    const double order = 0.021 / k;
    assert_near(wo_focus_from(&f, 0, 0, 1 / 1.5), 0, order);
    assert_near(wo_focus_from(&f, 0, 0, 1 / 4.0), 0, order);
    assert_near(wo_focus_from(&f, 0, 0, 1 / 2.5), 0, order);
    assert_near(wo_focus_from(&f, 0, 0, 1), 2 * (1 - 1 / 1.5), order);
    assert_near(wo_focus_from(&f, 0, 0, 0), -0.5 / 4, order);
    /* Strictly in order, so that what is in front stays in front. */
    for (double v = 0; v < 3; v += 0.01)
        assert_true((float)wo_focus_from(&f, 0, 0, v + 0.01) > (float)wo_focus_from(&f, 0, 0, v));
    /* All in front protected; focus at infinity has no metres. */
    o.protect_near = 2.5;
    const wo_focus all = focus_of(&o, k);
    assert_near(wo_focus_from(&all, 0, 0, 1e6), 0, order);
    o.vf = 0;
    const wo_focus far = focus_of(&o, k);
    assert_near(wo_focus_from(&far, 0, 0, 0.5), 1, order);
}

static void curvature_of_field(void **state)
{
    (void)state;
    wo_focus_options o = options_of(WO_FOCUS_BY_DISTANCE);
    for (int sign = -1; sign <= 1; sign += 2) {
        o.curvature = 0.3 * sign;
        const wo_focus f = focus_of(&o, 80);
        double amount;
        assert_near(f.v_axis, 0.5, 0);
        assert_near(wo_focus_at(&f, 210, 130, &amount), 0.5, 1e-5);
        assert_near(wo_focus_at(&f, 410, 280, &amount), 0.5 + o.curvature, 2e-3);
        assert_near(wo_focus_at(&f, 310, 205, &amount), 0.5 + 0.25 * o.curvature, 1e-3);
        assert_near(wo_focus_from(&f, 410, 280, 1), 0.5 - o.curvature, 2e-3);
    }
}

static void maps(void **state)
{
    (void)state;
    float pixels[5] = {4, 0, NAN, -2, INFINITY};
    wo_focus_options o = options_of(WO_FOCUS_BY_DISTANCE);
    o.map = (wo_image){pixels, {0, 0, 5, 1}, sizeof pixels, 1};
    o.map_scale = 0.5;
    const double want[3][5] = {
        {0.75, 0.5, 0.5, 0.5, 0.5}, {-3, 1, 0.5, 3, 0.5}, {4 * 0.5 / 80, 0, 0, -2 * 0.5 / 80, 0}};
    for (int kind = 0; kind < 3; kind++) {
        o.map_is = (wo_focus_map)(WO_FOCUS_MAP_DISTANCE + kind);
        const wo_focus f = focus_of(&o, 80);
        for (int x = 0; x < 5; x++)
            assert_near(wo_focus_from(&f, x, 0, 1), want[kind][x], 1e-12);
        assert_near(wo_focus_from(&f, -9, 7, 1), want[kind][0], 1e-12);
    }
}

static void the_tilt_is_limited(void **state)
{
    (void)state;
    wo_focus_options o = options_of(WO_FOCUS_BY_PLANE);
    o.count = 3;
    for (int i = 0; i < 3; i++) {
        o.points[i] = (wo_focus_point){cos(2 * i), sin(2 * i), 1 + 30 * cos(2 * i), 1, 1};
        o.presence[i] = 1;
    }
    const wo_focus free = focus_of(&o, 2);
    assert_near(free.tilt[0], 30 / 250.0, 1e-5);
    assert_near(free.tilt_slope, 2 * 30 / 250.0, 1e-4);
    const wo_focus held = focus_of(&o, 200);
    assert_near(held.tilt_slope, WO_FOCUS_TILT_MAX, 0);
    assert_near(hypot(held.tilt[0], held.tilt[1]) * 200, WO_FOCUS_TILT_MAX, 1e-9);
    assert_near(held.tilt_asked, 24, 1e-2);
    double amount;
    assert_near(wo_focus_at(&held, 210, 130, &amount), 1, 1e-2);
    assert_near(wo_focus_at(&held, 211, 130, &amount) - wo_focus_at(&held, 210, 130, &amount),
                held.tilt[0], 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interpolates_its_points),
        cmocka_unit_test(nothing_is_singular),
        cmocka_unit_test(points_in_one_place_are_averaged),
        cmocka_unit_test(is_smooth),
        cmocka_unit_test(changes_smoothly_with_its_points),
        cmocka_unit_test(a_plane_is_found),
        cmocka_unit_test(picks_one_surface),
        cmocka_unit_test(points_fade_outside_the_frame),
        cmocka_unit_test(zones_and_gains),
        cmocka_unit_test(curvature_of_field),
        cmocka_unit_test(maps),
        cmocka_unit_test(the_tilt_is_limited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
