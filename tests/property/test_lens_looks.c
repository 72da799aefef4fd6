/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cases.h"
#include "defocus/renderer.h"
#include "near.h"
#include "optics/lens_choice.h"
#include "scenes.h"

#include <string.h>

#define PI 3.14159265358979323846

/* A small bright disc on black in the middle, everything at one depth: its picture shows how the
   lens spreads a point. Lights as bright as this are drawn without noise. */
#define LIGHT 256.0f
enum { SIDE = 160, BINS = 80, DOT = 3, DOT_LIGHT = 32 };

typedef struct look {
    int kind, diagram;
    double focal, n; /* mm, f-number */
    double dv;       /* dioptres in front of the focus */
    double px;       /* radius that a thin lens of it has */
    double residual;
} look;

static scene dot_scene(const look *l)
{
    scene s;
    scene_init(&s, (wo_rect){0, 0, SIDE, SIDE});
    s.params.lens = l->kind;
    s.params.lens_diagram = l->diagram;
    s.params.lens_residual = l->residual;
    s.params.focal_length = l->focal;
    s.params.f_stop = l->n;
    s.params.best_focus = 0;
    s.params.samples = 16;
    const double vf = 2 * fabs(l->dv);
    s.params.focus_distance = 1 / vf;
    s.params.sensor_width = SIDE * l->focal * l->focal * 1e-3 * fabs(l->dv) / (2 * l->n * l->px);
    wo_image *const source = scene_clip(&s, WO_CLIP_SOURCE, 4);
    picture_fill(source, (const float[4]){0, 0, 0, 1});
    picture_fill(scene_clip(&s, WO_CLIP_DEPTH, 1), (const float[1]){(float)(1 / (vf + l->dv))});
    for (int32_t y = 0; y < SIDE; y++)
        for (int32_t x = 0; x < SIDE; x++)
            if (hypot(x + 0.5 - SIDE / 2, y + 0.5 - SIDE / 2) < DOT)
                picture_fill(&(wo_image){wo_image_at(source, x, y), {x, y, x + 1, y + 1}, 0, 4},
                             (const float[4]){LIGHT, LIGHT, LIGHT, 1});
    return s;
}

/* Means over rings of 1 px, red, green and blue. */
typedef struct profile {
    double at[3][BINS];
    double sum[3];
} profile;

static void profile_of(const wo_image *out, profile *p)
{
    double area[BINS] = {0};
    memset(p, 0, sizeof *p);
    for (int32_t y = 0; y < SIDE; y++)
        for (int32_t x = 0; x < SIDE; x++) {
            const double r = hypot(x + 0.5 - SIDE / 2, y + 0.5 - SIDE / 2);
            const int i = (int)r;
            if (i >= BINS)
                continue;
            area[i]++;
            for (int c = 0; c < 3; c++) {
                const double light = (double)(wo_image_at(out, x, y)[c] / LIGHT);
                p->at[c][i] += light;
                p->sum[c] += light;
            }
        }
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < BINS; i++)
            p->at[c][i] /= area[i];
}

/* Radius that holds a part of the light. */
static double within(const profile *p, int c, double part)
{
    double left = part * p->sum[c];
    for (int i = 0; i < BINS; i++) {
        const double light = p->at[c][i] * (2 * i + 1) * PI;
        if (light >= left)
            return sqrt(i * i + left / light * (2 * i + 1));
        left -= light;
    }
    return BINS;
}

typedef struct shape {
    double rms;       /* radius, px */
    double outer;     /* radius that holds 98 % of the light */
    double rim, core; /* densities of the outermost 15 % and of the middle, over the mean */
    double peak;      /* densest ring of the outer third, over the mean */
} shape;

static shape shape_of(const profile *p, int c)
{
    const double r10 = within(p, c, 0.1);
    const double r80 = within(p, c, 0.8);
    const double r95 = within(p, c, 0.95);
    shape s = {.outer = within(p, c, 0.98)};
    const double mean = 0.98 * p->sum[c] / (PI * s.outer * s.outer);
    s.rim = 0.15 * p->sum[c] / (PI * (r95 * r95 - r80 * r80)) / mean;
    s.core = 0.1 * p->sum[c] / (PI * r10 * r10) / mean;
    double sum = 0;
    double light = 0;
    for (int i = 0; i < BINS; i++) {
        light += p->at[c][i] * (2 * i + 1);
        sum += p->at[c][i] * (2 * i + 1) * (i * (i + 1) + 0.5);
        if (i >= s.outer * 2 / 3)
            s.peak = fmax(s.peak, p->at[c][i] / mean);
    }
    s.rms = sqrt(sum / light - DOT * DOT / 2.0);
    return s;
}

enum { RED, GREEN, BLUE };

/* Shapes in front of (0) and behind (1) the focus, and the perfect lens's in the same place. */
typedef struct pair {
    shape is[2][3], perfect[2];
} pair;

static pair look_at(look l)
{
    pair both;
    const double dv = l.dv;
    for (int i = 0; i < 4; i++) {
        look here = l;
        here.dv = i % 2 ? -dv : dv;
        if (i >= 2)
            here.diagram = WO_DIAGRAM_PERFECT;
        scene s = dot_scene(&here);
        wo_image out = scene_render(&s, NULL);
        profile p;
        profile_of(&out, &p);
        for (int c = 0; c < 3; c++) {
            const shape one = shape_of(&p, c);
            assert_close(p.sum[c], DOT_LIGHT, 0.02);
            if (i < 2)
                both.is[i][c] = one;
            else
                both.perfect[i - 2] = one;
        }
        picture_free(&out);
        scene_free(&s);
    }
    return both;
}

/* Kawase 2015 of an uncorrected lens: red sharp edge in front of the focus, blue soft edge and a
   bright centre behind it. */
static void spherical_edges(void **state)
{
    (void)state;
    const pair p = look_at((look){WO_LENS_DIAGRAM, WO_DIAGRAM_SPHERICAL, 49.83, 1.9617, 4, 30, 1});
    const shape *front = p.is[0];
    const shape *back = p.is[1];
    assert_true(front[RED].outer > 1.02 * front[GREEN].outer);
    assert_true(front[GREEN].outer > 1.05 * front[BLUE].outer);
    assert_true(back[BLUE].outer > 1.03 * back[GREEN].outer);
    assert_true(back[GREEN].outer > 1.01 * back[RED].outer);
    for (int c = 0; c < 3; c++) {
        assert_true(front[c].peak > 1.7 && front[c].core < 0.6);
        assert_true(front[c].rim > 1.05 * p.perfect[0].rim);
        assert_true(back[c].rim < 0.75 && back[c].rim < 0.8 * p.perfect[1].rim);
        assert_true(back[c].core > 1.8);
    }
}

/* Colour alone: fringes as above, but flat discs. */
static void aspherical_edges(void **state)
{
    (void)state;
    const pair p = look_at((look){WO_LENS_DIAGRAM, WO_DIAGRAM_ASPHERICAL, 50, 2, 4, 30, 1});
    assert_true(p.is[0][RED].outer > 1.05 * p.is[0][BLUE].outer);
    assert_true(p.is[1][BLUE].outer > 1.05 * p.is[1][RED].outer);
    for (int i = 0; i < 2; i++)
        for (int c = 0; c < 3; c++) {
            assert_near(p.is[i][c].core, p.perfect[i].core, 0.1);
            assert_near(p.is[i][c].rim, p.perfect[i].rim, 0.08);
        }
}

/* The same of a doublet: purple soft edge in front, green sharp edge behind. */
static void achromat_edges(void **state)
{
    (void)state;
    for (int type = WO_DIAGRAM_ACHROMAT_A; type <= WO_DIAGRAM_ACHROMAT_B; type++) {
        const pair p = look_at((look){WO_LENS_DIAGRAM, type, 250, 4.922, 0.08, 40, 1});
        const shape *front = p.is[0];
        const shape *back = p.is[1];
        assert_true(front[RED].rms > 1.004 * front[GREEN].rms);
        assert_true(front[BLUE].rms > 1.05 * front[GREEN].rms);
        assert_true(back[GREEN].rms > 1.004 * back[RED].rms);
        assert_true(back[GREEN].rms > 1.05 * back[BLUE].rms);
        assert_true(front[GREEN].rim < 0.97 * p.perfect[0].rim);
        assert_true(back[GREEN].rim > 1.03 * p.perfect[1].rim);
        for (int c = 0; c < 3; c++)
            assert_true(front[c].rim < back[c].rim);
    }
}

/* Radii of the whole disc are resolved to some 0.1 % here: the root mean square of thousands of
   pixels. */
static void apochromat_is_even(void **state)
{
    (void)state;
    const pair p = look_at((look){WO_LENS_DIAGRAM, WO_DIAGRAM_APOCHROMAT, 194, 2.9, 0.26, 40, 1});
    for (int i = 0; i < 2; i++)
        for (int c = 0; c < 3; c++) {
            assert_close(p.is[i][c].rms, p.perfect[i].rms, 0.004);
            assert_close(p.is[i][c].rms, p.is[i][GREEN].rms, 0.004);
            assert_near(p.is[i][c].rim, p.perfect[i].rim, 0.03);
            assert_near(p.is[i][c].core, p.perfect[i].core, 0.05);
        }
}

static bool same_as_thin(const scene *s)
{
    scene thin = *s;
    thin.params.lens = WO_LENS_THIN;
    wo_image a = scene_render(s, NULL);
    wo_image b = scene_render(&thin, NULL);
    const bool same = picture_same_bytes(&a, &b, a.bounds);
    picture_free(&a);
    picture_free(&b);
    return same;
}

static void no_aberration_is_thin(void **state)
{
    (void)state;
    const int ways = cases_of(2, 1);
    for (int type = 0; type < WO_DIAGRAM_PRESET_COUNT; type++) {
        for (int way = 0; way < ways; way++) {
            scene s;
            scene_init(&s, (wo_rect){-9, 4, 119, 76});
            s.params.sensor_width = 5;
            s.params.f_stop = 2; /* 16 px per dioptre */
            scene_fill_busy(&s, 3);
            s.params.lens = WO_LENS_DIAGRAM;
            s.params.lens_diagram = type;
            s.params.best_focus = (type + way) & 1;
            s.params.samples = 32;
            s.params.lens_residual = 0;
            assert_true(same_as_thin(&s));
            s.params.lens_residual = 1;
            assert_int_equal(same_as_thin(&s), type == WO_DIAGRAM_PERFECT);
            scene_free(&s);
        }
    }
}

/* White at any depth, through every lens and many designs, also where few rays get through. */
static void white_stays_white(void **state)
{
    (void)state;
    const int step = cases_of(3, 9);
    for (int i = 1; i < WO_LENS_KIND_COUNT + WO_LENS_DESIGNS;
         i += i < WO_LENS_KIND_COUNT ? 1 : step) {
        scene s;
        scene_init(&s, (wo_rect){0, 0, 64, 36});
        s.params.sensor_width = i % 4 < 2 ? 36 : 10;
        s.params.f_stop = 1.4;
        scene_fill_busy(&s, 5);
        s.params.samples = i % 2 ? 48 : 9;
        s.params.wavelengths = 6;
        s.params.lens = i < WO_LENS_KIND_COUNT ? i : WO_LENS_PRESCRIPTION;
        if (i >= WO_LENS_KIND_COUNT)
            s.params.lens_design = i - WO_LENS_KIND_COUNT;
        picture_fill(&s.clip[WO_CLIP_SOURCE], (const float[4]){1, 1, 1, 1});
        const wo_context context = WO_CONTEXT_INIT;
        wo_error error = {WO_OK, ""};
        wo_image out = picture_make(s.geometry.extent, 4);
        const wo_status status = scene_run(&s, &context, s.geometry.extent, &out, NULL, &error);
        if (status == WO_OK)
            assert_at_most(picture_difference(&out, &s.clip[WO_CLIP_SOURCE], out.bounds), 1e-5);
        else
            fail_msg("lens %d, design %d: %s", s.params.lens, s.params.lens_design, error.text);
        picture_free(&out);
        scene_free(&s);
    }
}

/* Two discs behind the focus, one on the axis and one at the left border. */
enum { OFF_X = 24, WIDE = 320, HIGH = 180 };

static void two_dots(scene *s, const char *design, double n, double dv, double scale, float light)
{
    const int32_t w = (int32_t)(WIDE * scale);
    const int32_t h = (int32_t)(HIGH * scale);
    const double vf = dv > 0 ? 0.25 : 0.25 - dv;
    scene_init(s, (wo_rect){0, 0, w, h});
    s->geometry.render_scale = scale;
    s->params.lens = WO_LENS_PRESCRIPTION;
    s->params.lens_design = 0;
    while (strcmp(wo_lens_names[s->params.lens_design], design) != 0)
        s->params.lens_design++;
    s->params.focal_length = 60;
    s->params.f_stop = n;
    s->params.samples = 16;
    s->params.focus_distance = 1 / vf;
    s->params.sensor_width = 36;
    picture_fill(scene_clip(s, WO_CLIP_SOURCE, 4), (const float[4]){0, 0, 0, 1});
    picture_fill(scene_clip(s, WO_CLIP_DEPTH, 1), (const float[1]){(float)(1 / (vf + dv))});
    const double at[] = {OFF_X * scale, w / 2.0};
    for (int32_t y = 0; y < h; y++)
        for (int32_t x = 0; x < w; x++)
            for (int i = 0; i < 2; i++)
                if (hypot(x + 0.5 - at[i], y + 0.5 - h / 2.0) < DOT * scale)
                    for (int c = 0; c < 3; c++)
                        wo_image_at(&s->clip[WO_CLIP_SOURCE], x, y)[c] = light;
}

/* px of a half of the picture whose green is above half of that half's typical light. */
static double lit_area(const wo_image *out, int32_t x1, int32_t x2)
{
    double sum = 0;
    double square = 0;
    for (int32_t y = out->bounds.y1; y < out->bounds.y2; y++)
        for (int32_t x = x1; x < x2; x++) {
            const double c = (double)wo_image_at(out, x, y)[1];
            sum += c;
            square += c * c;
        }
    double area = 0;
    for (int32_t y = out->bounds.y1; y < out->bounds.y2; y++)
        for (int32_t x = x1; x < x2; x++)
            area += (double)wo_image_at(out, x, y)[1] > 0.4 * square / sum;
    return area;
}

/* Off the axis the mounts cut the open pupil. Stopped down they do not. */
static void cats_eyes(void **state)
{
    (void)state;
    static const char codev[] = "dgauss_codev_100_f2";
    static const char werfel[] = "dgauss_werfel_100_f125";
    static const struct {
        const char *design;
        double n, dv, least, most; /* of the area off the axis over that on it */
    } cases[] = {{codev, 2, 2.5, 0.82, 0.91},
                 {codev, 5.6, 7, 0.94, 1.02},
                 {werfel, 1.4, 1.7, 0, 0.85},
                 {werfel, 1.4, -1.7, 0, 0.85},
                 {werfel, 5.6, 7, 0.94, 1.06}};
    for (size_t i = 0; i < WO_COUNT(cases); i += (size_t)cases_of(1, 2)) {
        scene s;
        two_dots(&s, cases[i].design, cases[i].n, cases[i].dv, 1, 1);
        s.params.method = WO_METHOD_RAYS;
        s.params.samples = 256;
        wo_image out = scene_render(&s, NULL);
        s.params.lens = WO_LENS_THIN;
        wo_image thin = scene_render(&s, NULL);
        const double on = lit_area(&out, WIDE / 3, WIDE);
        const double off = lit_area(&out, 0, WIDE / 3);
        assert_close(on, lit_area(&thin, WIDE / 3, WIDE), 0.08);
        assert_close(lit_area(&thin, 0, WIDE / 3), lit_area(&thin, WIDE / 3, WIDE), 0.02);
        assert_true(off > cases[i].least * on && off < cases[i].most * on);
        picture_free(&thin);
        picture_free(&out);
        scene_free(&s);
    }
}

/* Root of the mean square distance of the green light from its middle. */
static double spread(const wo_image *out, int32_t x1, int32_t x2)
{
    double sum = 0, x_sum = 0, y_sum = 0, square = 0;
    for (int32_t y = out->bounds.y1; y < out->bounds.y2; y++)
        for (int32_t x = x1; x < x2; x++) {
            const double c = (double)wo_image_at(out, x, y)[1];
            sum += c;
            x_sum += c * x;
            y_sum += c * y;
            square += c * ((double)x * x + (double)y * y);
        }
    x_sum /= sum;
    y_sum /= sum;
    return sqrt(square / sum - x_sum * x_sum - y_sum * y_sum);
}

static void half_the_scale_is_half_the_blur(void **state)
{
    (void)state;
    scene whole;
    scene half;
    two_dots(&whole, "dgauss_werfel_100_f125", 1.4, 1.7, 1, LIGHT);
    two_dots(&half, "dgauss_werfel_100_f125", 1.4, 1.7, 0.5, LIGHT);
    wo_image large = scene_render(&whole, NULL);
    wo_image small = scene_render(&half, NULL);
    for (int i = 0; i < 2; i++) {
        const int32_t x1 = i * WIDE / 3;
        const int32_t x2 = i ? WIDE : WIDE / 3;
        const double ratio = spread(&large, x1, x2) / spread(&small, x1 / 2, x2 / 2);
        assert_close(ratio, 2, 0.015);
    }
    picture_free(&large);
    picture_free(&small);
    scene_free(&whole);
    scene_free(&half);
}

/* Tiles of any size, and any number of threads, make the same picture. */
static void tiles_and_threads(void **state)
{
    (void)state;
    scene s;
    scene_init(&s, (wo_rect){-20, 3, 140, 93});
    s.params.lens = WO_LENS_PRESCRIPTION;
    s.params.sensor_width = 24;
    s.params.f_stop = 2;
    s.params.max_radius = 20;
    s.params.samples = 48;
    s.params.wavelengths = 4;
    scene_fill_layers(&s, 7);
    wo_image whole = scene_render(&s, NULL);
    const unsigned threads[] = {2, 7, 1};
    for (size_t i = 0; i < (size_t)cases_of(WO_COUNT(threads), 1); i++) {
        wo_context context = WO_CONTEXT_INIT;
        context.runner = threads_runner(&threads[i]);
        wo_image out = picture_make(whole.bounds, 4);
        const int32_t step = 53 + 31 * (int32_t)i;
        for (int32_t y = whole.bounds.y1; y < whole.bounds.y2; y += step)
            for (int32_t x = whole.bounds.x1; x < whole.bounds.x2; x += step) {
                const wo_rect tile =
                    wo_rect_intersect((wo_rect){x, y, x + step, y + step}, whole.bounds);
                assert_int_equal(scene_run(&s, &context, tile, &out, NULL, NULL), WO_OK);
            }
        assert_true(picture_same_bytes(&out, &whole, whole.bounds));
        picture_free(&out);
    }
    picture_free(&whole);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spherical_edges),
        cmocka_unit_test(aspherical_edges),
        cmocka_unit_test(achromat_edges),
        cmocka_unit_test(apochromat_is_even),
        cmocka_unit_test(no_aberration_is_thin),
        cmocka_unit_test(white_stays_white),
        cmocka_unit_test(cats_eyes),
        cmocka_unit_test(tiles_and_threads),
        cmocka_unit_test(half_the_scale_is_half_the_blur),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
