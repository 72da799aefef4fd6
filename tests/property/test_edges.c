/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cases.h"
#include "defocus/renderer.h"
#include "near.h"
#include "scenes.h"

#include <string.h>

/* Two surfaces with an edge between them, against brute force of the test's own: what a lens sees
   of the one beside, through and behind the other. */
enum { W = 96, H = 48, MARGIN = 16, LENS = 128, SUB = 4 };
static const wo_rect frame = {0, 0, W, H};
#define TILT 0.23 /* of the edges, px across for each px up */

typedef struct edge_case {
    const char *name;
    double half_width;        /* px; of the wire, or 0 for a half plane */
    double front_px, back_px; /* blur radii: front positive, behind negative */
    double picture, plate;    /* dB from Source and Depth alone, and with a clean plate: measured,
                                 less some 0.7 */
} edge_case;

static const edge_case cases[] = {
    {"wire of 2 px, blurred by 12 px", 1, 12, 0, 31.9, 40.8},
    {"wire of 4 px, blurred by 16 px", 2, 16, 0, 28.8, 43.2},
    {"wire of 6 px, blurred by 20 px", 3, 20, 0, 27.2, 45.0},
    {"background blurred by 10 px behind a sharp edge", 0, 0, -10, 40.1, 41.1},
};

/* px from the middle of the wire, or from the edge of the half plane; across. */
static double across(double x, double y)
{
    return (x - 0.5 * W + TILT * (y - 0.5 * H)) / sqrt(1 + TILT * TILT);
}

static bool in_front(const edge_case *c, double x, double y)
{
    const double d = across(x, y);
    return c->half_width > 0 ? fabs(d) < c->half_width : d < 0;
}

static double wave(double x)
{
    const double t = x - floor(x);
    return 16 * t * t * (1 - t) * (1 - t);
}

static void front_colour(double x, double y, double out[3])
{
    const double t = wave(0.04 * y + 0.02 * x);
    out[0] = 0.85 + 0.1 * t;
    out[1] = 0.12;
    out[2] = 0.08 + 0.1 * t;
}

static void back_colour(double x, double y, double out[3])
{
    const double stripes = wave(0.11 * x - 0.13 * y);
    const double rows = wave(0.05 * x + 0.1 * y);
    out[0] = 0.05 + 0.15 * stripes;
    out[1] = 0.25 + 0.6 * stripes * rows;
    out[2] = 0.3 + 0.4 * rows;
}

/* Vergence of the focus, and of something with that radius, at 16 px for each dioptre. */
#define PX    16.0
#define FOCUS 1.0 /* dioptres */
static double metres(double radius)
{
    return 1 / (FOCUS + radius / PX);
}

/* Mean over the square of a pixel of what the lens sees, point by point. */
static void lens_sees(const edge_case *c, int32_t x, int32_t y, double out[3])
{
    memset(out, 0, 3 * sizeof *out);
    const double golden = 0.6180339887498949;
    for (int i = 0; i < SUB * SUB; i++)
        for (int j = 0; j < LENS; j++) {
            /* A spiral over the lens, turned for every point of the pixel. */
            const double r = sqrt((j + (i + 0.5) / (SUB * SUB)) / LENS);
            const double turn = 2 * 3.14159265358979323846 * (golden * j + 0.37 * i);
            const double u = r * cos(turn);
            const double v = r * sin(turn);
            const double px = x + (i % SUB + 0.5) / SUB;
            const double py = y + (i / SUB + 0.5) / SUB;
            double colour[3];
            if (in_front(c, px + c->front_px * u, py + c->front_px * v))
                front_colour(px + c->front_px * u, py + c->front_px * v, colour);
            else
                back_colour(px + c->back_px * u, py + c->back_px * v, colour);
            for (int k = 0; k < 3; k++)
                out[k] += colour[k] / (SUB * SUB * LENS);
        }
}

static wo_image truth_of(const edge_case *c)
{
    wo_image out = picture_make(frame, 4);
    for (int32_t y = 0; y < H; y++)
        for (int32_t x = 0; x < W; x++) {
            double sum[3];
            lens_sees(c, x, y, sum);
            for (int k = 0; k < 3; k++)
                wo_image_at(&out, x, y)[k] = (float)sum[k];
            wo_image_at(&out, x, y)[3] = 1;
        }
    return out;
}

typedef enum kind { LAYERS, PICTURE, SOFT_DEPTH, PLATE, PLATE_WITHOUT_DEPTH, AS_IT_IS } kind;

/* What the pinhole sees of both, over the square of the pixel. */
static double pinhole(const edge_case *c, int32_t x, int32_t y, double front[3], double back[3])
{
    enum { FINE = 8 };
    double part = 0;
    for (int k = 0; k < 3; k++)
        front[k] = back[k] = 0;
    for (int i = 0; i < FINE * FINE; i++) {
        const double px = x + (i % FINE + 0.5) / FINE;
        const double py = y + ((double)(i / FINE) + 0.5) / FINE;
        double f[3];
        double b[3];
        const bool inside = in_front(c, px, py);
        front_colour(px, py, f);
        back_colour(px, py, b);
        part += inside ? 1.0 / (FINE * FINE) : 0;
        for (int k = 0; k < 3; k++) {
            front[k] += inside ? f[k] / (FINE * FINE) : 0;
            back[k] += b[k] / (FINE * FINE);
        }
    }
    return part;
}

/* What shows of the background where it is not covered. */
static void seen_back(const edge_case *c, int32_t x, int32_t y, double out[3])
{
    enum { FINE = 8 };
    for (int k = 0; k < 3; k++)
        out[k] = 0;
    for (int i = 0; i < FINE * FINE; i++) {
        const double px = x + (i % FINE + 0.5) / FINE;
        const double py = y + ((double)(i / FINE) + 0.5) / FINE;
        double b[3];
        back_colour(px, py, b);
        for (int k = 0; k < 3 && !in_front(c, px, py); k++)
            out[k] += b[k] / (FINE * FINE);
    }
}

/* Depth through the pixel filter of path tracers: Blackman-Harris over 3 px. */
static double soft_depth(const edge_case *c, int32_t x, int32_t y)
{
    enum { FINE = 12 };
    double sum = 0;
    double all = 0;
    for (int i = 0; i < FINE * FINE; i++) {
        const double ox = 3 * ((i % FINE + 0.5) / FINE - 0.5);
        const double oy = 3 * (((double)(i / FINE) + 0.5) / FINE - 0.5);
        double weight = 1;
        for (int k = 0; k < 2; k++) {
            const double t = 2 * 3.14159265358979323846 * ((k ? oy : ox) / 3 + 0.5);
            weight *= 0.35875 - 0.48829 * cos(t) + 0.14128 * cos(2 * t) - 0.01168 * cos(3 * t);
        }
        const bool inside = in_front(c, x + 0.5 + ox, y + 0.5 + oy);
        sum += weight * metres(inside ? c->front_px : c->back_px);
        all += weight;
    }
    return sum / all;
}

static scene scene_of(const edge_case *c, kind how)
{
    scene s;
    scene_init(&s, (wo_rect){-MARGIN, -MARGIN, W + MARGIN, H + MARGIN});
    s.geometry.format = frame;
    scene_px_per_dioptre(&s, PX);
    s.params.focus_distance = 1 / FOCUS;
    s.params.samples = 1024;
    s.params.edge_repair = how == AS_IT_IS ? WO_EDGES_AS_THEY_ARE : WO_EDGES_OF_COLOUR_AND_DEPTH;
    const int other = how == LAYERS ? 2 : WO_CLIP_BACKGROUND;
    const bool two = how == LAYERS || how == PLATE || how == PLATE_WITHOUT_DEPTH;
    const wo_rect e = s.geometry.extent;
    wo_image *const source = scene_clip(&s, WO_CLIP_SOURCE, 4);
    wo_image *const depth = scene_clip(&s, WO_CLIP_DEPTH, 1);
    wo_image *const far = two ? scene_clip(&s, other, 4) : NULL;
    wo_image *const far_depth =
        two && how != PLATE_WITHOUT_DEPTH ? scene_clip(&s, other + 1, 1) : NULL;
    for (int32_t y = e.y1; y < e.y2; y++)
        for (int32_t x = e.x1; x < e.x2; x++) {
            double front[3];
            double back[3];
            double seen[3];
            const double part = pinhole(c, x, y, front, back);
            seen_back(c, x, y, seen);
            float *const to = wo_image_at(source, x, y);
            for (int k = 0; k < 3; k++)
                to[k] = (float)(how == LAYERS ? front[k] : front[k] + seen[k]);
            to[3] = how == LAYERS ? (float)part : 1;
            const bool centre = how == LAYERS || in_front(c, x + 0.5, y + 0.5);
            *wo_image_at(depth, x, y) = (float)(how == SOFT_DEPTH || how == AS_IT_IS
                                                    ? soft_depth(c, x, y)
                                                    : metres(centre ? c->front_px : c->back_px));
            for (int k = 0; far && k < 4; k++)
                wo_image_at(far, x, y)[k] = k < 3 ? (float)back[k] : 1;
            if (far_depth)
                *wo_image_at(far_depth, x, y) = (float)metres(c->back_px);
        }
    return s;
}

typedef struct verdict {
    double guessed; /* of the report */
    double psnr;    /* dB, within the band that the edge's blur reaches */
    double profile; /* largest mean error of a strip along the edge, relative to the contrast */
} verdict;

/* The contrast of the two surfaces: about 0.7 in red. */
#define CONTRAST 0.7

static verdict judge(const edge_case *c, const wo_image *truth, kind how)
{
    scene s = scene_of(c, how);
    wo_report report = {0};
    wo_image out = scene_render(&s, &report);
    const double reach = c->half_width + fmax(c->front_px, -c->back_px) + 1;
    enum { STRIPS = 2 * (32 + 1) };
    double strip[STRIPS][3] = {{0}};
    int count[STRIPS] = {0};
    double square = 0;
    int64_t n = 0;
    for (int32_t y = 0; y < H; y++)
        for (int32_t x = 0; x < W; x++) {
            const double d = across(x + 0.5, y + 0.5);
            const int at = (int)floor(d + STRIPS / 2);
            if (fabs(d) > reach || at < 0 || at >= STRIPS)
                continue;
            for (int k = 0; k < 3; k++) {
                const double e =
                    (double)wo_image_at(&out, x, y)[k] - (double)wo_image_at(truth, x, y)[k];
                strip[at][k] += e;
                square += e * e;
            }
            count[at]++;
            n += 3;
            assert_true(wo_image_at(&out, x, y)[3] == 1);
        }
    verdict v = {report.guessed, 10 * log10((double)n / square), 0};
    for (int i = 0; i < STRIPS; i++)
        for (int k = 0; k < 3; k++)
            if (count[i] >= H / 2)
                v.profile = fmax(v.profile, fabs(strip[i][k] / count[i]) / CONTRAST);
    picture_free(&out);
    scene_free(&s);
    return v;
}

/* The background shows behind the wire, and no rim is darker or brighter than it should be. */
static void edges_are_honest(void **state)
{
    (void)state;
    /* Few: the finest wire and the half plane. */
    for (size_t i = 0; i < WO_COUNT(cases); i += (size_t)cases_of(1, 3)) {
        const edge_case *c = &cases[i];
        print_message("           %s\n", c->name);
        wo_image truth = truth_of(c);
        verdict v = judge(c, &truth, LAYERS);
        assert_at_most(50, v.psnr);
        assert_at_most(v.profile, 0.01);
        /* What is hidden is guessed. */
        const verdict picture = judge(c, &truth, PICTURE);
        assert_at_most(c->picture, picture.psnr);
        assert_at_most(picture.profile, 0.045);
        assert_true(picture.guessed > 0);
        /* Antialiased depth: an error at most 15 % larger, and far from what it was. */
        const verdict soft = judge(c, &truth, SOFT_DEPTH);
        assert_at_most(c->picture - 1.2, soft.psnr);
        assert_at_most(soft.profile, 0.05);
        v = judge(c, &truth, AS_IT_IS);
        assert_at_most(v.psnr, soft.psnr - 5);
        /* With a clean plate nothing is. */
        for (kind how = PLATE; how <= PLATE_WITHOUT_DEPTH; how++) {
            v = judge(c, &truth, how);
            assert_at_most(c->plate, v.psnr);
            assert_at_most(v.profile, 0.022);
            assert_at_most(v.guessed, 0.1 * picture.guessed);
        }
        picture_free(&truth);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_are_honest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
