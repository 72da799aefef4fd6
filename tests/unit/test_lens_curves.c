/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "lens_curves.h"
#include "slow_tracer.h"
#include "wideopen/lens_diagram.h"

#include "prescription_test.h"

/* The numbers of the page of a lens against rays of a tracer of its own. */

#define PI 3.14159265358979323846

static bool is_round(const wo_prescription *lens)
{
    for (int i = 0; i < lens->count; i++)
        if (lens->surface[i].meridian != WO_MERIDIAN_BOTH)
            return false;
    return true;
}

static wo_lens_view view_of(const wo_prescription *lens, double f_number, double focus,
                            double field)
{
    const wo_lens_setup setup = {WO_NM_D, f_number, focus, field};
    wo_lens_view view;
    wo_error error = {WO_OK, ""};
    if (wo_lens_view_make(lens, &setup, &view, &error) != WO_OK)
        fail_msg("%s: %s", lens->name, error.text);
    return view;
}

static double iris_of(const wo_lens_view *view)
{
    return view->lens.surface[view->lens.stop].semi_aperture;
}

/* A ray from the axis, far away or so many metres from the entrance pupil, that crosses the plane
   of that pupil at a height. */
static slow_ray axial_ray(const wo_lens_view *view, double nm, double height, double metres)
{
    const double pupil = view->first[1].ep_z, back = 2 * fabs(pupil) + 200;
    const double slope = isfinite(metres) ? height / (1000 * metres) : 0;
    const double length = sqrt(1 + slope * slope);
    slow_ray r = {{0, height - slope * back, pupil - back}, {0, slope / length, 1 / length}, 0, 0};
    slow_trace(&view->lens, nm, iris_of(view), &r);
    return r;
}

/* -------------------------------------------------------------------- longitudinal aberration */

static void check_aberration(const wo_lens_view *view, double metres)
{
    wo_lens_aberration a;
    wo_lens_aberration_make(view, 33, &a);
    if (!a.has[0])
        fail_msg("%s has no aberration", view->lens.name);
    for (int l = 0; l < WO_LENS_LINES; l++)
        for (int i = 1; i < 33; i++) {
            const slow_ray r =
                axial_ray(view, wo_lens_nm[l], a.radius[0] * i / 32 * (1 - 1e-9), metres);
            const double t = -r.p[1] / r.d[1];
            const double focus = r.p[2] + t * r.d[2] - wo_lens_sensor_z(view);
            if (r.passed && !(fabs(a.focus[0][l][i] - focus) <= 1e-5 * (1 + fabs(focus))))
                fail_msg("%s, zone %d at %g nm: %.9g, traced %.9g", view->lens.name, i,
                         wo_lens_nm[l], a.focus[0][l][i], focus);
            if (l == 1 && !r.passed)
                fail_msg("%s, zone %d: no light there", view->lens.name, i);
        }
    /* The last ray. */
    assert_false(axial_ray(view, WO_NM_D, a.radius[0] * (1 + 1e-6), metres).passed);
}

static void aberrations_of_real_rays(void **state)
{
    (void)state;
    wo_prescription lens;
    double least = 1, most = 1;
    for (size_t n = 0; wo_lens_name_at(n); n++) {
        assert_int_equal(wo_lens_find(wo_lens_name_at(n), &lens, NULL), WO_OK);
        if (!is_round(&lens))
            continue;
        for (int i = 0; i < 3; i++) {
            wo_lens_view view = view_of(&lens, 0, 0, 1);
            const double metres = i == 1 ? 25e-3 * fabs(view.first[1].efl) : INFINITY;
            if (i == 1)
                view = view_of(&lens, 0, metres, 1);
            if (i == 2)
                view = view_of(&lens, 2 * view.first[1].fno, 0, 1);
            check_aberration(&view, metres);
            wo_lens_aberration a;
            wo_lens_aberration_make(&view, 2, &a);
            least = fmin(least, a.radius[0] / (view.first[1].ep_d / 2));
            most = fmax(most, a.radius[0] / (view.first[1].ep_d / 2));
        }
    }
    print_message("radius of the last ray over that of the paraxial pupil: %.3f to %.3f\n", least,
                  most);
    assert_true(least < 0.95 && most > 1.02); /* or nothing was seen */
}

/* A zone of the diagram sees the point sharp that its shift says, with light that gets through. */
static void pencils_end_with_the_iris(void **state)
{
    (void)state;
    wo_prescription lens;
    for (size_t n = 0; wo_lens_name_at(n); n++) {
        assert_int_equal(wo_lens_find(wo_lens_name_at(n), &lens, NULL), WO_OK);
        if (!is_round(&lens))
            continue;
        for (int i = 0; i < 2; i++) {
            wo_lens_view view = view_of(&lens, 0, 0, 1);
            const double vf = i == 0 ? 0 : 1000 / (25 * fabs(view.first[1].efl));
            view = view_of(&lens, 0, i == 0 ? 0 : 1 / vf, 1);
            wo_diagram d;
            wo_error error = {WO_OK, ""};
            if (wo_diagram_of_lens(&lens, 0, vf, wo_lens_nm, WO_LENS_LINES, &d, &error) != WO_OK)
                fail_msg("%s: %s", lens.name, error.text);
            for (int z = 1; z < d.zones; z++) {
                const double height = d.radius * z / (d.zones - 1) * (1 - 1e-7);
                const slow_ray r =
                    axial_ray(&view, WO_NM_D, height, 1 / (vf + d.shift[1][z] + 1e-300));
                const double t = (wo_lens_sensor_z(&view) - r.p[2]) / r.d[2];
                if (!r.passed || !(fabs(r.p[1] + t * r.d[1]) < 2e-5))
                    fail_msg("%s, zone %d: %s, lands at %g mm", lens.name, z,
                             r.passed ? "passes" : "stopped", r.p[1] + t * r.d[1]);
            }
        }
    }
}

/* --------------------------------------------------------------------------- illumination */

/* A distant point, angle radians off the axis in y: the ray at (x, y) of the plane across its
   direction through the first vertex. */
static slow_ray oblique_ray(const wo_lens_view *view, double angle, double x, double y)
{
    const double s = sin(angle), c = cos(angle), back = 500;
    slow_ray r = {{x, y * c - back * s, -y * s - back * c}, {0, s, c}, 0, 0};
    slow_trace(&view->lens, WO_NM_D, iris_of(view), &r);
    return r;
}

typedef struct frame {
    double x, y1, y2; /* half width, from, to */
} frame;

static bool frame_within(const wo_lens_view *view, double angle, double wide, int across, int along,
                         frame *f)
{
    const double semi = view->lens.surface[0].semi_aperture;
    const double sag = fabs(slow_sag(&view->lens.surface[0], semi * semi));
    const double reach = semi + (isnan(sag) ? semi : sag) * sin(angle);
    bool any = false;
    *f = (frame){0, reach, -reach};
    for (int i = 0; i < across * along; i++) {
        const double x = wide * semi * (i / along + 0.5) / across;
        const double y = reach * ((i % along + 0.5) / along * 2 - 1);
        if (!oblique_ray(view, angle, x, y).passed)
            continue;
        any = true;
        *f = (frame){fmax(f->x, x + 2 * wide * semi / across), fmin(f->y1, y - 4 * reach / along),
                     fmax(f->y2, y + 4 * reach / along)};
    }
    return any;
}

/* Of a dome the beam is a small part. */
static bool frame_of(const wo_lens_view *view, double angle, frame *f)
{
    return frame_within(view, angle, 1, 60, 120, f) || frame_within(view, angle, 0.02, 20, 3000, f);
}

static double fraction(double x)
{
    return x - floor(x);
}

/* Light of an even bright sky on the ring of the sensor between two radii, by its area. The points
   of the sky lie between two angles, which must hold all that reaches the ring. */
static double light_on_ring(const wo_lens_view *view, double from, double to, double near,
                            double far, int rays)
{
    const int frames = far - near > 0.5 ? 12 : 2;
    frame f = {0, INFINITY, -INFINITY}, one;
    for (int i = 0; i <= frames; i++)
        if (frame_of(view, near + (far - near) * i / frames, &one))
            f = (frame){fmax(f.x, one.x), fmin(f.y1, one.y1), fmax(f.y2, one.y2)};
    if (f.x == 0)
        return 0;
    double sum = 0;
    for (int i = 0; i < rays; i++) {
        const double angle = near + (far - near) * (i + 0.5) / rays;
        const double x = f.x * fraction(0.7548776662466927 * i);
        const double y = f.y1 + (f.y2 - f.y1) * fraction(0.5698402909980532 * i);
        const slow_ray r = oblique_ray(view, angle, x, y);
        const double t = (wo_lens_sensor_z(view) - r.p[2]) / r.d[2];
        const double radius = hypot(r.p[0] + t * r.d[0], r.p[1] + t * r.d[1]);
        if (r.passed && radius >= from && radius < to)
            sum += sin(angle);
    }
    return sum * (far - near) / rays * 2 * f.x * (f.y2 - f.y1) / (0.5 * (to * to - from * from));
}

/* Middle of the light of one point, and how far from it any lands. */
static double middle_of(const wo_lens_view *view, double angle, double *spread)
{
    enum { RAYS = 3000 };
    frame f;
    double sum = 0, least = INFINITY, most = -INFINITY;
    int count = 0;
    *spread = NAN;
    if (!frame_of(view, angle, &f))
        return NAN;
    for (int i = 0; i < RAYS; i++) {
        const slow_ray r = oblique_ray(view, angle, f.x * fraction(0.7548776662466927 * i),
                                       f.y1 + (f.y2 - f.y1) * fraction(0.5698402909980532 * i));
        const double t = (wo_lens_sensor_z(view) - r.p[2]) / r.d[2];
        const double y = fabs(r.p[1] + t * r.d[1]), x = fabs(r.p[0] + t * r.d[0]);
        if (!r.passed)
            continue;
        sum += y;
        least = fmin(least, y);
        most = fmax(most, hypot(x, y));
        count++;
    }
    *spread = fmax(most - sum / count, sum / count - least);
    return count ? sum / count : NAN;
}

/* What the ring sees by the library, over the axis. */
static double seen_by_ring(const wo_lens_view *view, double from, double to)
{
    enum { PLACES = 6 };
    wo_lens_beam axis, beam;
    double light = 0, area = 0;
    assert_true(wo_lens_beam_make(view, 0, &axis));
    for (int i = 0; i < PLACES; i++) {
        const double radius = from + (to - from) * (i + 0.5) / PLACES;
        if (wo_lens_beam_make(view, radius, &beam))
            light += radius * beam.light;
        area += radius;
    }
    return light / area / axis.light;
}

/* Of the illumination where the chief ray lands, or of what a whole ring sees, whose light may come
   from many angles. False: the light of a point is spread too far for a ring to be of its angle. */
static bool check_light(const wo_lens_view *view, bool whole_ring, double *worst)
{
    enum { RAYS = 20000 };
    const double angle = view->half_field * (PI / 180), f = fabs(view->first[1].efl);
    wo_lens_field_curves c;
    wo_lens_field_curves_make(view, &c);
    const double found = c.illumination[WO_LENS_FIELD_STEPS - 1];
    double spread, axis_spread, ignored;
    middle_of(view, 0, &axis_spread);
    const double height = middle_of(view, angle, &spread);
    if (isnan(height)) {
        assert_near(found, 0, 0.005);
        return true;
    }
    const double ring = fmax(0.015 * height, 0.3 * spread);
    if (!whole_ring && ring + spread > 0.12 * height)
        return false;
    const double rate = (height - middle_of(view, 0.97 * angle, &ignored)) / (0.03 * angle);
    const double beside =
        whole_ring ? 0.3 * angle : 1.2 * (ring + 1.2 * spread) / fmin(rate, height / angle);
    const double out = light_on_ring(view, height - ring, height + ring, angle - beside,
                                     angle + beside, whole_ring ? 10 * RAYS : RAYS);
    const double disc = 0.01 * f;
    const double axis = light_on_ring(view, 0, disc, 0, (disc + 1.2 * axis_spread) / f * 1.2, RAYS);
    const double compared = whole_ring ? seen_by_ring(view, height - ring, height + ring) : found;
    if (!(fabs(compared - out / axis) < 0.01))
        print_message("%s at %.4g degrees: %.4f, brute force %.4f\n", view->lens.name,
                      view->half_field, compared, out / axis);
    *worst = fmax(*worst, fabs(compared - out / axis));
    return true;
}

static void light_of_an_even_sky(void **state)
{
    (void)state;
    wo_prescription lens;
    double worst = 0;
    int checked = 0;
    for (size_t n = 0; wo_lens_name_at(n); n++) {
        assert_int_equal(wo_lens_find(wo_lens_name_at(n), &lens, NULL), WO_OK);
        if (!is_round(&lens))
            continue;
        const wo_lens_view view = view_of(&lens, 0, 0, lens.half_field * 0.9);
        checked += check_light(&view, false, &worst);
    }
    print_message("%d lenses, largest difference %.4f\n", checked, worst);
    assert_true(checked > 20);
    assert_true(worst < 0.01);
}

/* ------------------------------------------------------------------------- beyond 90 degrees */

static const char dome_text[] = "lens 1\nname dome\nfield 105\n"
                                "surface 120 4 N-LAK9 118\nsurface 44 40 air 43.9\n"
                                "surface 110 3 N-LAK9 43\nsurface 18 24 air 17.95\n"
                                "surface 44 14 N-SF6 24\nsurface -70 20 air 24\n"
                                "surface 0 1 air 1.5 stop\nsurface 60 1.5 N-SF6 12\n"
                                "surface 18 8 N-LAK9 12\nsurface -22 30 air 12\n";

static wo_prescription dome(void)
{
    wo_prescription lens;
    wo_error error = {WO_OK, ""};
    if (wo_prescription_parse(dome_text, sizeof dome_text - 1, "dome", &lens, &error) != WO_OK)
        fail_msg("%s", error.text);
    return lens;
}

/* The rays of a bundle, by the library and by the test. */
static int same_rays(const wo_lens_view *view, double field)
{
    enum { ACROSS = 20, ALONG = 2400 };
    const double angle = field * (PI / 180), semi = view->lens.surface[0].semi_aperture;
    int passed = 0;
    for (int i = 0; i < ACROSS * ALONG; i++) {
        const double x = 0.006 * semi * (i / ALONG + 0.5) / ACROSS;
        const double y = 1.2 * semi * ((i % ALONG + 0.5) / ALONG * 2 - 1);
        const double s = sin(angle), c = cos(angle);
        double p[3] = {x, y * c - 500 * s, -y * s - 500 * c}, d[3] = {0, s, c};
        uint8_t outcome = 0;
        const wo_rays rays = {&p[0], &p[1], &p[2], &d[0], &d[1], &d[2], NULL, &outcome};
        wo_system_trace(&view->system, 0, view->system.count - 1, false,
                        WO_TRACE_CLIP | WO_TRACE_IRIS, &rays, 1, NULL, NULL);
        const slow_ray r = oblique_ray(view, angle, x, y);
        assert_int_equal(outcome == WO_RAY_PASSED, r.passed);
        for (int k = 0; k < 3 && r.passed; k++) {
            assert_near(p[k], r.p[k], 1e-9);
            assert_near(d[k], r.d[k], 1e-11);
        }
        passed += r.passed;
    }
    return passed;
}

static void light_from_the_side(void **state)
{
    (void)state;
    const wo_prescription lens = dome();
    const double fields[] = {0, 45, 80, 89.9, 90, 90.1, 95, 104};
    for (size_t i = 0; i < WO_COUNT(fields); i++) {
        const wo_lens_view view = view_of(&lens, 0, 0, fmax(fields[i], 1));
        const int passed = same_rays(&view, fields[i]);
        if (passed < 10)
            fail_msg("at %g degrees %d rays pass", fields[i], passed);
        wo_bundle bundle;
        assert_true(wo_bundle_fill(&view, WO_MERIDIAN_Y, fields[i], 100, &bundle));
        wo_bundle_free(&bundle);
    }
    double worst = 0;
    const double lit[] = {60, 80, 90};
    for (size_t i = 0; i < WO_COUNT(lit); i++) {
        const wo_lens_view view = view_of(&lens, 0, 0, lit[i]);
        assert_true(check_light(&view, true, &worst));
    }
    print_message("dome to 90 degrees: largest difference %.4f\n", worst);
    assert_true(worst < 0.02);
    /* Nothing from behind. */
    const wo_lens_view view = view_of(&lens, 0, 0, 120);
    wo_lens_field_curves c;
    wo_lens_field_curves_make(&view, &c);
    assert_true(c.equidistant);
    assert_true(c.illumination[16] > 0.7 && c.illumination[20] > 0.5); /* 80, 100 degrees */
    for (int i = 23; i < WO_LENS_FIELD_STEPS; i++)
        assert_true(c.illumination[i] == 0 && c.lit[i] == 0);
    assert_int_equal(same_rays(&view, 120), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(aberrations_of_real_rays),
        cmocka_unit_test(pencils_end_with_the_iris),
        cmocka_unit_test(light_of_an_even_sky),
        cmocka_unit_test(light_from_the_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
