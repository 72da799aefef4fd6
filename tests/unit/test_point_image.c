/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/point_image.h"

#include "near.h"
#include "optics/lens_choice.h"
#include "optics/pencil_table.h"
#include "optics/pencil_tilt.h"
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;

enum { WIDTH = 640, HEIGHT = 360, RAYS = 65536 };

/* A lens and a point in front of or behind its focus. */
typedef struct sight {
    wo_lens_kind kind;
    const char *design;
    wo_diagram_preset diagram;
    double f_number, cats_eye;
    wo_aperture aperture;
    double door;         /* on the right */
    double x, y, radius; /* px; the sign is that of the vergence from the focus */
    int wavelengths;
    double tilt; /* |b.B| of the tilted lens */
} sight;

static const sight sights[] = {
    /* A bright ring and a bright middle: caustics. */
    {.kind = WO_LENS_DIAGRAM,
     .diagram = WO_DIAGRAM_SPHERICAL,
     .f_number = 3.5,
     .aperture = WO_APERTURE_INIT,
     .x = 320,
     .y = 180,
     .radius = 5,
     .wavelengths = 16},
    {.kind = WO_LENS_DIAGRAM,
     .diagram = WO_DIAGRAM_SPHERICAL,
     .f_number = 3.5,
     .aperture = WO_APERTURE_INIT,
     .x = 320,
     .y = 180,
     .radius = -5,
     .wavelengths = 1},
    /* Coma, astigmatism, cat's eyes, off the axis. */
    {.kind = WO_LENS_PRESCRIPTION,
     .design = "dgauss_codev_100_f2",
     .f_number = 2,
     .aperture = WO_APERTURE_INIT,
     .x = 40,
     .y = 300,
     .radius = 7,
     .wavelengths = 3},
    {.kind = WO_LENS_PRESCRIPTION,
     .design = "petzval_kodak_100",
     .f_number = 2.2,
     .aperture = WO_APERTURE_INIT,
     .x = 570,
     .y = 30,
     .radius = -7,
     .wavelengths = 1},
    /* Blades, and a mirror in the middle as catadioptric lenses have it. */
    {.kind = WO_LENS_DIAGRAM,
     .diagram = WO_DIAGRAM_APOCHROMAT,
     .f_number = 2,
     .cats_eye = 0.7,
     .aperture = {.aspect = 1, .blades = 5, .obstruction = 0.4, .rotation = 10},
     .door = 0.6,
     .x = 560,
     .y = 300,
     .radius = 9,
     .wavelengths = 1},
    {.kind = WO_LENS_DIAGRAM,
     .diagram = WO_DIAGRAM_APOCHROMAT,
     .f_number = 2,
     .aperture = {.aspect = 1.5, .edge = 0.6, .ring_amount = 0.5, .ring_count = 2},
     .x = 100,
     .y = 180,
     .radius = -8,
     .wavelengths = 1,
     .tilt = 0.2},
};

typedef struct made_lens {
    wo_chosen_lens *chosen;
    wo_table_pencils *pencils;
    wo_lens inside;
    wo_tilted_pencils tilted;
    wo_lens lens;
    double v;
} made_lens;

static void make_lens(const sight *s, int count, made_lens *m)
{
    wo_bands bands;
    wo_bands_make(s->wavelengths, &bands);
    const double focal_px = WIDTH / 0.72; /* 50 mm before 36 mm */
    const double k = focal_px * 0.025 / s->f_number;
    const wo_lens_choice choice = {.kind = s->kind,
                                   .design = s->design,
                                   .diagram = s->diagram,
                                   .residual = 1,
                                   .focal_mm = 50,
                                   .f_number = s->f_number,
                                   .cats_eye = s->cats_eye,
                                   .vf = 1,
                                   .half_field = 0.45,
                                   .nm = bands.nm,
                                   .lines = bands.count};
    const wo_table_pencil_options options = {.aperture = &s->aperture,
                                             .focal_px = focal_px,
                                             .stretch = 1,
                                             .centre_x = WIDTH / 2,
                                             .centre_y = HEIGHT / 2,
                                             .px_per_dioptre = k,
                                             .max_reach = 100,
                                             .v_limit = 3,
                                             .half_diagonal = 0.5 * hypot(WIDTH, HEIGHT),
                                             .doors = {.right = s->door},
                                             .count = count,
                                             .wavelengths = s->wavelengths};
    wo_error error = {WO_OK, ""};
    wo_table_facts facts;
    m->chosen = malloc(sizeof *m->chosen);
    assert_int_equal(wo_lens_choose(&choice, m->chosen, &error), WO_OK);
    assert_int_equal(
        wo_table_pencils_create(&plain, &m->chosen->model, &options, &m->pencils, &facts, &error),
        WO_OK);
    m->v = s->radius / k;
    m->lens = m->inside = wo_table_pencils_lens(m->pencils);
    if (s->tilt > 0) {
        const double b = s->tilt / wo_lens_slope(&m->inside);
        m->tilted = (wo_tilted_pencils){&m->inside, {0.8 * b, 0.6 * b}, s->tilt};
        m->lens = wo_tilted_pencils_lens(&m->tilted);
    }
}

static void free_lens(made_lens *m)
{
    wo_table_pencils_destroy(&plain, &m->pencils);
    free(m->chosen);
}

/* All rows of an image at once. */
typedef struct picture {
    float *memory;
    wo_point_image image;
    wo_point_pixel *pixels;
} picture;

static void draw(const made_lens *m, const sight *s, bool rays, picture *p)
{
    p->memory = malloc(wo_point_image_room(&m->lens, m->v) * sizeof *p->memory);
    wo_point_image_make(&m->lens, s->x, s->y, m->v, p->memory, &p->image);
    const wo_rect r = p->image.rect;
    const int32_t reach = wo_point_image_reach(&m->lens, m->v);
    assert_true(wo_rect_contains((wo_rect){-reach, -reach, reach + 1, reach + 1}, r));
    const int32_t rows = wo_rect_height(r);
    double *room = malloc(wo_point_image_draw_room(&m->lens, m->v, rows) * sizeof *room);
    p->pixels = malloc((size_t)rows * (size_t)wo_rect_width(r) * sizeof *p->pixels);
    wo_point_image_draw(&p->image, r.y1, r.y2, rays, room, p->pixels);
    free(room);
}

static void free_picture(picture *p)
{
    free(p->memory);
    free(p->pixels);
}

/* The slow twin: rays of the pencil at a pixel that meet the point's pixel. */
static void cast(const made_lens *m, const sight *s, int32_t x, int32_t y, double light[3])
{
    static wo_pencil_room room;
    double all[3] = {0};
    memset(light, 0, 3 * sizeof *light);
    for (unsigned set = 0; set < 16; set++)
        for (int first = 0; first < m->lens.count; first += WO_PENCIL_PIECE) {
            wo_pencil p;
            m->lens.pencil(m->lens.self, s->x + x, s->y + y, set, first, &room, &p);
            for (int i = 0; i < p.count; i++) {
                const double dx = x + (double)p.ax[i] + m->v * (double)p.bx[i];
                const double dy = y + (double)p.ay[i] + m->v * (double)p.by[i];
                const bool met = fabs(dx) <= 0.5 && fabs(dy) <= 0.5;
                for (int c = 0; c < 3; c++) {
                    const double w = p.weight[c] ? (double)p.weight[c][i] : 1;
                    all[c] += w;
                    light[c] += met ? w : 0;
                }
            }
        }
    for (int c = 0; c < 3; c++)
        light[c] /= all[c];
}

static void a_point_is_what_rays_make_of_it(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(sights); i++) {
        const sight *s = &sights[i];
        made_lens m;
        picture p;
        make_lens(s, RAYS / 16, &m);
        draw(&m, s, false, &p);
        const wo_rect r = p.image.rect;
        const wo_point_pixel *pixel = p.pixels;
        double sum[2][3] = {{0}};
        double square = 0;
        double peak = 0;
        for (int32_t y = r.y1; y < r.y2; y++)
            for (int32_t x = r.x1; x < r.x2; x++, pixel++) {
                double light[3];
                cast(&m, s, x, y, light);
                for (int c = 0; c < 3; c++) {
                    const double got = (double)pixel->light[c];
                    sum[0][c] += got;
                    sum[1][c] += light[c];
                    square += (got - light[c]) * (got - light[c]);
                    peak = fmax(peak, light[c]);
                }
            }
        /* Most of it is the noise of the rays. */
        const double pixels = 3.0 * wo_rect_width(r) * wo_rect_height(r);
        assert_at_most(sqrt(square / pixels) / peak, 0.013);
        for (int c = 0; c < 3; c++)
            assert_close(sum[0][c], sum[1][c], s->wavelengths == 1 ? 0.001 : 0.003);
        free_picture(&p);
        free_lens(&m);
    }
}

/* Whatever rows are drawn with it, and whether its rays are asked for, a row is the same. */
static void rows_stand_alone(void **state)
{
    (void)state;
    for (size_t i = 0; i < WO_COUNT(sights); i++) {
        made_lens m;
        picture whole;
        make_lens(&sights[i], 16, &m);
        draw(&m, &sights[i], false, &whole);
        const wo_rect r = whole.image.rect;
        const int32_t w = wo_rect_width(r);
        double *room = malloc(wo_point_image_draw_room(&m.lens, m.v, 5) * sizeof *room);
        wo_point_pixel *part = malloc(5 * (size_t)w * sizeof *part);
        for (int32_t y1 = r.y1; y1 < r.y2; y1 += 5) {
            const int32_t y2 = y1 + 5 < r.y2 ? y1 + 5 : r.y2;
            wo_point_image_draw(&whole.image, y1, y2, true, room, part);
            for (int32_t k = 0; k < (y2 - y1) * w; k++)
                assert_memory_equal(part[k].light, whole.pixels[(y1 - r.y1) * w + k].light,
                                    sizeof part[k].light);
        }
        free(room);
        free(part);
        free_picture(&whole);
        free_lens(&m);
    }
}

/* The mean rays of a pixel come from the side of the iris that sends light there. */
static void rays_come_from_the_iris(void **state)
{
    (void)state;
    const sight *s = &sights[4];
    made_lens m;
    picture p;
    make_lens(s, 16, &m);
    draw(&m, s, true, &p);
    const wo_rect r = p.image.rect;
    const wo_point_pixel *pixel = p.pixels;
    for (int32_t y = r.y1; y < r.y2; y++)
        for (int32_t x = r.x1; x < r.x2; x++, pixel++) {
            if (!(pixel->light[0] > 1e-4f))
                continue;
            assert_near((double)(pixel->part[0] + pixel->part[1]), 1, 1e-5);
            const int kind = pixel->part[0] > 0.5f ? 0 : 1;
            assert_true(pixel->part[kind] > 0.999f);
            /* x + B v = 0: this lens has next to no aberration. */
            assert_near(x + (double)pixel->b[kind][0] * m.v, 0, 0.75);
            assert_near(y + (double)pixel->b[kind][1] * m.v, 0, 0.75);
        }
    free_picture(&p);
    free_lens(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_is_what_rays_make_of_it),
        cmocka_unit_test(rows_stand_alone),
        cmocka_unit_test(rays_come_from_the_iris),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
