/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_LENS_TEST_H
#define WO_TESTS_LENS_TEST_H

#include "wideopen/lens_trace.h"

#include "prescription_test.h"

/* One ray, followed through a system. */
typedef struct test_ray {
    double p[3], d[3];
    double weight;
    wo_outcome outcome;
    double stop[2];
} test_ray;

static inline test_ray trace_ray(const wo_system *system, int first, int last, bool reverse,
                                 unsigned flags, test_ray r)
{
    uint8_t outcome;
    r.weight = 1;
    const wo_rays rays = {&r.p[0], &r.p[1], &r.p[2],   &r.d[0],
                          &r.d[1], &r.d[2], &r.weight, &outcome};
    wo_system_trace(system, first, last, reverse, flags, &rays, 1, &r.stop[0], &r.stop[1]);
    r.outcome = (wo_outcome)outcome;
    return r;
}

static inline test_ray trace_whole(const wo_system *system, unsigned flags, test_ray r)
{
    return trace_ray(system, 0, system->count - 1, false, flags, r);
}

/* From (x, y) in front of the first vertex, along the axis. */
static inline test_ray parallel_ray(double x, double y)
{
    return (test_ray){.p = {x, y, -10}, .d = {0, 0, 1}};
}

static inline wo_system builtin_system(const char *name, double nm)
{
    const wo_prescription lens = builtin(name);
    wo_system system;
    wo_system_make(&lens, nm, &system);
    return system;
}

static inline bool is_round(const wo_system *system)
{
    for (int i = 0; i < system->count; i++)
        if (system->surface[i].meridian != WO_MERIDIAN_BOTH)
            return false;
    return true;
}

static inline bool is_spherical(const wo_system *system)
{
    for (int i = 0; i < system->count; i++)
        if (system->surface[i].k != 0 || system->surface[i].terms > 0)
            return false;
    return is_round(system);
}

/* A surface of a lens made for a test. */
typedef struct test_surface {
    double radius, thickness;
    double index; /* of the medium behind */
    double semi;
    bool stop;
} test_surface;

static inline wo_prescription lens_of(const test_surface *surfaces, int count)
{
    wo_prescription lens = {.count = count};
    strcpy(lens.name, "test");
    for (int i = 0; i < count; i++) {
        const test_surface *const from = &surfaces[i];
        wo_surface *const to = &lens.surface[i];
        wo_error error = {WO_OK, ""};
        if (wo_glass_abbe(from->index, 0, &to->glass, &error) != WO_OK)
            fail_msg("%s", error.text);
        to->curvature = from->radius == 0 ? 0 : 1 / from->radius;
        to->thickness = from->thickness;
        to->semi_aperture = from->semi;
        to->stop = from->stop;
        if (from->stop)
            lens.stop = i;
    }
    return lens;
}

#endif
