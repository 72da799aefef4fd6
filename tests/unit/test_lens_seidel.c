/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */

/* Third-order aberrations: against values computed elsewhere, against Born and Wolf's formulas, and
   against exact rays. */
#include "lens_checks.h"
#include "lens_test.h"

#include "lens_sum_checks.inc"

#define PI 3.14159265358979323846

static void sums(void **state)
{
    (void)state;
    int compared = 0;
    for (size_t i = 0; i < WO_COUNT(seidel_checks); i++) {
        const seidel_check *const check = &seidel_checks[i];
        const wo_prescription lens = builtin(check->name);
        wo_system system;
        wo_seidel out;
        double chromatic[2];
        wo_system_make(&lens, WO_NM_D, &system);
        wo_system_seidel(&system, check->ep_d, check->field, &out);
        wo_system_chromatic_sums(&lens, check->ep_d, check->field, WO_NM_F, WO_NM_C, chromatic);
        assert_close(out.lagrange, 0.5 * check->ep_d * tan(check->field * (PI / 180)), 1e-12);
        for (int k = 0; k < 7; k++) {
            const double got = k < 5 ? out.s[k] : chromatic[k - 5];
            const double want = k < 5 ? check->s[k] : check->c[k - 5];
            /* Zero where the iris lies on a thin part of the lens. */
            if (!(fabs(got - want) <= 1e-4 * fabs(want) + 1e-12))
                fail_msg("%s: sum %d is %.8g, should be %.8g", check->name, k + 1, got, want);
            compared++;
        }
    }
    assert_int_equal(compared, 27 * 7);
}

static void born_wolf_values(void **state)
{
    (void)state;
    int compared = 0;
    for (size_t i = 0; i < WO_COUNT(wolf_checks); i++) {
        const wolf_check *const check = &wolf_checks[i];
        const wo_system system = builtin_system(check->name, WO_NM_D);
        wo_seidel out;
        wo_system_seidel(&system, check->ep_d, check->field, &out);
        const double got[5] = {out.b, out.c, out.d, out.e, out.f};
        for (int k = 0; k < 5; k++) {
            assert_close(got[k], check->value[k], 1e-4);
            compared++;
        }
    }
    assert_int_equal(compared, 4 * 5);
}

/* Born and Wolf 5.5.3, in vergences: an object at infinity, n0 = l0 = lambda0 = 1. sizes: sums of
   the parts' magnitudes. */
static void born_wolf(const wo_system *system, double out[5], double sizes[5])
{
    wo_first_order o;
    wo_system_first_order(system, WO_MERIDIAN_X, &o);
    double h = 1;
    double k = -o.ep_z;
    double object = 0; /* 1 / s */
    for (int m = 0; m < 5; m++)
        out[m] = sizes[m] = 0;
    for (int i = 0; i < system->count; i++) {
        const wo_system_surface *const s = &system->surface[i];
        const double kk = s->n0 * (s->c - object); /* Abbe's invariant */
        const double image = s->c - kk / s->n1;
        const double spread = image / s->n1 - object / s->n0;
        const double inverse2 = 1 / (s->n1 * s->n1) - 1 / (s->n0 * s->n0);
        const double h2 = h * h;
        const double q = h2 * k * kk;
        const double figure = h2 * h2 * (s->n1 - s->n0) *
                              (s->k * s->c * s->c * s->c + (s->terms > 1 ? 8 * s->a[1] : 0));
        assert_true(s->terms == 0 || s->a[0] == 0);
        const double parts[5] = {
            figure + h2 * h2 * kk * kk * spread,
            figure * k * k + (1 + q) * (1 + q) * spread,
            figure * k * k + q * (2 + q) * spread - kk * inverse2,
            figure * k * k * k + k * (1 + q) * (2 + q) * spread - (1 + q) / h2 * inverse2,
            figure * k + h2 * kk * (1 + q) * spread,
        };
        for (int m = 0; m < 5; m++) {
            out[m] += 0.5 * parts[m];
            sizes[m] += 0.5 * fabs(parts[m]);
        }
        if (i + 1 == system->count)
            break;
        const double gap = system->surface[i + 1].z - s->z;
        const double next = h * (1 - gap * image);
        k += gap / (s->n1 * h * next);
        object = image / (1 - gap * image);
        h = next;
    }
}

static void born_wolf_formulas(void **state)
{
    (void)state;
    int lenses = 0;
    for (size_t i = 0; wo_lens_name_at(i); i++) {
        const wo_system system = builtin_system(wo_lens_name_at(i), WO_NM_D);
        if (!is_round(&system))
            continue;
        double want[5];
        double sizes[5];
        born_wolf(&system, want, sizes);
        wo_seidel out;
        wo_system_seidel(&system, 10, 12, &out);
        const double got[5] = {out.b, out.c, out.d, out.e, out.f};
        for (int k = 0; k < 5; k++) {
            assert_near(got[k], want[k], 1e-4 * fabs(want[k]) + 1e-13 * sizes[k]);
            assert_near(got[k], want[k], 1e-11 * sizes[k]);
        }
        lenses++;
    }
    assert_int_equal(lenses, 29);
}

/* The sums by aperture and field; Born and Wolf's coefficients depend on neither. */
static void growth(void **state)
{
    (void)state;
    const wo_system system = builtin_system("tessar_brendel_100_f28", WO_NM_D);
    const double tangent = 0.3;
    wo_seidel one;
    wo_seidel other;
    wo_system_seidel(&system, 7, atan(tangent) * 180 / PI, &one);
    wo_system_seidel(&system, 21, atan(tangent / 2) * 180 / PI, &other);
    for (int k = 0; k < 5; k++) {
        static const double aperture[] = {81, 27, 9, 9, 3};
        static const double field[] = {1, 2, 4, 4, 8};
        assert_close(other.s[k], one.s[k] * aperture[k] / field[k], 1e-12);
    }
    assert_close(other.b, one.b, 1e-12);
    assert_close(other.c, one.c, 1e-12);
    assert_close(other.d, one.d, 1e-12);
    assert_close(other.e, one.e, 1e-12);
    assert_close(other.f, one.f, 1e-12);
}

/* Largest distance, over points of the pupil, of exact rays' landing places in the paraxial image
   plane from those of third order, as part of the longest aberration. */
static double remainder_of(const wo_system *system, double ep_d, double tangent)
{
    wo_first_order o;
    wo_seidel sums;
    wo_system_first_order(system, WO_MERIDIAN_X, &o);
    wo_system_seidel(system, ep_d, atan(tangent) * (180 / PI), &sums);
    const double *const s = sums.s;
    const double scale = -o.efl / ep_d; /* 1 / (2 n' u') */
    double worst = 0;
    double longest = 0;
    for (int k = 0; k < 12; k++) {
        const double rho = k < 6 ? 1 : 0.6;
        const double ux = rho * cos(0.3 + 2 * PI * k / 6);
        const double uy = rho * sin(0.3 + 2 * PI * k / 6);
        const double n = 1 / sqrt(1 + tangent * tangent);
        /* At the entrance pupil, and back to a plane in front of the lens. */
        const double z = fmin(-100, o.ep_z - 100);
        const test_ray ray = {
            .p = {0.5 * ep_d * ux + (z - o.ep_z) * tangent, 0.5 * ep_d * uy, z},
            .d = {tangent * n, 0, n},
        };
        const test_ray r = trace_whole(system, 0, ray);
        if (r.outcome != WO_RAY_PASSED)
            return INFINITY;
        const double to = system->z_last + o.bfd - r.p[2];
        const double ex = r.p[0] + to * r.d[0] / r.d[2] - o.efl * tangent;
        const double ey = r.p[1] + to * r.d[1] / r.d[2];
        const double rr = ux * ux + uy * uy;
        const double along =
            s[0] * rr * ux + s[1] * (3 * ux * ux + uy * uy) + (3 * s[2] + s[3]) * ux + s[4];
        const double across = s[0] * rr * uy + 2 * s[1] * ux * uy + (s[2] + s[3]) * uy;
        worst = fmax(worst, hypot(ex - scale * along, ey - scale * across));
        longest = fmax(longest, hypot(scale * along, scale * across));
    }
    return worst / longest;
}

static void third_order_is_the_limit_of_exact_rays(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(seidel_checks); i++) {
        const seidel_check *const check = &seidel_checks[i];
        const wo_system system = builtin_system(check->name, WO_NM_D);
        const double tangent = tan(check->field * (PI / 180));
        double before = 0;
        for (int k = 0; k < 3; k++) {
            const double part = 0.08 / (1 << k);
            const double now = remainder_of(&system, part * check->ep_d, part * tangent);
            if (k > 0 && !(before / now > 3.7 && before / now < 4.3))
                fail_msg("%s: the remainder falls from %g to %g", check->name, before, now);
            before = now;
        }
        if (!(before < 0.02))
            fail_msg("%s: the remainder is %g", check->name, before);
    }
}

/* A fast lens at half its aperture and field: third order is off by some 15 %. */
static void size_of_the_remainder(void **state)
{
    (void)state;
    const wo_system system = builtin_system("dgauss_codev_100_f2", WO_NM_D);
    const double tangent = tan(14 * (PI / 180));
    const double half = remainder_of(&system, 25, 0.5 * tangent);
    assert_near(half, 0.16, 0.04);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums),
        cmocka_unit_test(born_wolf_values),
        cmocka_unit_test(born_wolf_formulas),
        cmocka_unit_test(growth),
        cmocka_unit_test(third_order_is_the_limit_of_exact_rays),
        cmocka_unit_test(size_of_the_remainder),
    };
    return cmocka_run_group_tests_name("lens_seidel", tests, NULL, NULL);
}
