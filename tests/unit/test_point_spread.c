/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/point_spread.h"

#include "defocus/lens_rays.h"

#include "near.h"
#include "optics/lens_choice.h"
#include "optics/pencil_table.h"
#include "scenes.h"

static const wo_context plain = WO_CONTEXT_INIT;

/* A lens with a blur of v px at vergence v. */
static wo_thin_pencils *pencils_of(const wo_aperture *aperture, double stretch, wo_lens *lens)
{
    const wo_thin_lens thin = {.k = 1, .focal_px = 1000};
    wo_thin_pencils *pencils = NULL;
    assert_int_equal(
        wo_thin_pencils_create(&plain, &thin, aperture, stretch, 256, 3, &pencils, NULL), WO_OK);
    *lens = wo_thin_pencils_lens(pencils);
    return pencils;
}

/* The same lens by way of a table. */
static wo_table_pencils *table_of(const wo_aperture *aperture, double stretch, wo_lens *lens)
{
    static const double nm[] = {WO_NM_D};
    const wo_lens_choice choice = {.kind = WO_LENS_DIAGRAM,
                                   .diagram = WO_DIAGRAM_PERFECT,
                                   .focal_mm = 50,
                                   .f_number = 25,
                                   .half_field = 0.3,
                                   .nm = nm,
                                   .lines = 1};
    const wo_table_pencil_options options = {.aperture = aperture,
                                             .focal_px = 1000,
                                             .stretch = stretch,
                                             .px_per_dioptre = stretch,
                                             .max_reach = 200,
                                             .v_limit = 50,
                                             .half_diagonal = 300,
                                             .count = 256,
                                             .wavelengths = 1};
    wo_chosen_lens chosen;
    wo_table_facts facts;
    wo_table_pencils *pencils = NULL;
    assert_int_equal(wo_lens_choose(&choice, &chosen, NULL), WO_OK);
    assert_int_equal(
        wo_table_pencils_create(&plain, &chosen.model, &options, &pencils, &facts, NULL), WO_OK);
    *lens = wo_table_pencils_lens(pencils);
    return pencils;
}

static const wo_aperture apertures[] = {
    WO_APERTURE_INIT,
    {.aspect = 1, .blades = 6, .rotation = 13},
    {.aspect = 0.6, .obstruction = 0.5},
    {.aspect = 1, .apodization = 0.8},
};

static const double radii[] = {0.02, 0.3, 0.77, 2.5, 4.4, 7.9, -8.3, 13.1, -40.2};

/* Sum, middle and mean square of the offsets of a channel. */
static void moments(const wo_point_raster *raster, int channel, double m[4])
{
    const wo_rect r = raster->rect;
    const double *value =
        raster->value + (size_t)channel * (size_t)wo_rect_width(r) * (size_t)wo_rect_height(r);
    m[0] = m[1] = m[2] = m[3] = 0;
    for (int32_t y = r.y1; y < r.y2; y++)
        for (int32_t x = r.x1; x < r.x2; x++, value++) {
            m[0] += *value;
            m[1] += *value * x;
            m[2] += *value * y;
            m[3] += *value * (x * x + y * y);
        }
}

/* The same of the lens's rays; the light goes against them. */
static void ray_moments(const wo_lens *lens, double v, double m[4])
{
    static wo_pencil_room room;
    m[0] = m[1] = m[2] = m[3] = 0;
    for (unsigned set = 0; set < lens->sets; set++) {
        wo_pencil p;
        lens->pencil(lens->self, 0, 0, set, 0, &room, &p);
        for (int i = 0; i < p.count; i++) {
            const double w = p.weight[0] ? (double)p.weight[0][i] : 1;
            const double x = -((double)p.ax[i] + (double)p.bx[i] * v);
            const double y = -((double)p.ay[i] + (double)p.by[i] * v);
            m[0] += w;
            m[1] += w * x;
            m[2] += w * y;
            m[3] += w * (x * x + y * y);
        }
    }
    for (int k = 1; k < 4; k++)
        m[k] /= m[0];
}

static void energy_and_size_are_those_of_the_rays(void **state)
{
    (void)state;
    for (size_t a = 0; a < WO_COUNT(apertures); a++) {
        for (int connect = 0; connect < 2; connect++) {
            const double stretch = a == 1 ? 1.5 : 1;
            wo_lens lens;
            wo_thin_pencils *pencils = NULL;
            wo_table_pencils *table = NULL;
            if (connect)
                pencils = pencils_of(&apertures[a], stretch, &lens);
            else
                table = table_of(&apertures[a], stretch, &lens);
            for (size_t i = 0; i < WO_COUNT(radii); i++) {
                wo_point_raster raster;
                double m[4];
                double want[4];
                assert_int_equal(
                    wo_point_raster_create(&plain, &lens, 0, 0, radii[i], &raster, NULL), WO_OK);
                moments(&raster, 0, m);
                assert_near(m[0], 1, 1e-12);
                if (fabs(radii[i]) < WO_SHARP_PX) {
                    assert_true(m[3] == 0);
                } else {
                    ray_moments(&lens, radii[i], want);
                    const double r = fabs(radii[i]);
                    assert_near(m[1], want[1], 0.004 * r + 0.004);
                    assert_near(m[2], want[2], 0.004 * r + 0.004);
                    /* Pixels are squares, which adds 1/6; small spreads grow from a point. */
                    assert_near(m[3], want[3], 0.012 * r * r + fmin(0.35, 1.05 * want[3]));
                    assert_true(m[3] > 0.97 * want[3]);
                }
                wo_point_raster_destroy(&plain, &raster);
            }
            wo_thin_pencils_destroy(&plain, &pencils);
            wo_table_pencils_destroy(&plain, &table);
        }
    }
}

/* The disc: each pixel holds the area that the disc covers of it. */
static void a_disc_covers_pixels(void **state)
{
    (void)state;
    enum { SUB = 32 };
    const double r = 9.37;
    wo_lens lens;
    wo_thin_pencils *pencils = pencils_of(&apertures[0], 1, &lens);
    wo_point_raster raster;
    assert_int_equal(wo_point_raster_create(&plain, &lens, 0, 0, r, &raster, NULL), WO_OK);
    const double *value = raster.value;
    for (int32_t y = raster.rect.y1; y < raster.rect.y2; y++)
        for (int32_t x = raster.rect.x1; x < raster.rect.x2; x++, value++) {
            int inside = 0;
            for (int i = 0; i < SUB * SUB; i++)
                inside += hypot(x - 0.5 + (i % SUB + 0.5) / SUB,
                                y - 0.5 + ((double)(i / SUB) + 0.5) / SUB) <= r;
            const double area = (double)inside / (SUB * SUB);
            assert_near(*value * 3.14159265 * r * r, area, 0.05);
            assert_true(area > 0 || *value == 0);
        }
    wo_point_raster_destroy(&plain, &raster);
    wo_thin_pencils_destroy(&plain, &pencils);
}

/* Light goes the other way than the rays: a triangle stands on its head. */
static void the_spread_is_turned(void **state)
{
    (void)state;
    const wo_aperture triangle = {.aspect = 1, .blades = 3, .rotation = 90};
    wo_lens lens;
    wo_thin_pencils *pencils = pencils_of(&triangle, 1, &lens);
    for (int sign = -1; sign <= 1; sign += 2) {
        wo_point_raster raster;
        assert_int_equal(wo_point_raster_create(&plain, &lens, 0, 0, sign * 20.0, &raster, NULL),
                         WO_OK);
        const ptrdiff_t w = wo_rect_width(raster.rect);
        const double *middle = raster.value - raster.rect.y1 * w - raster.rect.x1;
        assert_true(middle[-sign * 18 * w] > 0); /* the tip */
        assert_true(middle[sign * 18 * w] == 0);
        wo_point_raster_destroy(&plain, &raster);
    }
    wo_thin_pencils_destroy(&plain, &pencils);
}

static void runs_are_the_raster(void **state)
{
    (void)state;
    for (size_t a = 0; a < WO_COUNT(apertures); a++) {
        wo_lens lens;
        wo_thin_pencils *pencils = pencils_of(&apertures[a], 1, &lens);
        for (size_t i = 0; i < WO_COUNT(radii); i++) {
            wo_point_raster raster;
            wo_point_spread spread;
            assert_int_equal(wo_point_raster_create(&plain, &lens, 0, 0, radii[i], &raster, NULL),
                             WO_OK);
            assert_int_equal(wo_point_spread_create(&plain, &raster, &spread, NULL), WO_OK);
            const wo_rect r = raster.rect;
            const double *value = raster.value;
            for (int32_t y = r.y1; y < r.y2; y++) {
                uint32_t s = spread.first[y - r.y1];
                const uint32_t end = spread.first[y - r.y1 + 1];
                float level = 0;
                for (int32_t x = r.x1; x < r.x2; x++, value++) {
                    for (; s < end && spread.steps[s].x <= x; s++)
                        level = spread.steps[s].level[1];
                    assert_near((double)level, *value, 1e-7 * fabs(*value));
                }
                assert_true(end == 0 || spread.first[y - r.y1] == end ||
                            spread.steps[end - 1].level[3] == 0);
            }
            /* An even aperture has a few steps a row. */
            if (a < 3 && fabs(radii[i]) > 5)
                assert_at_most(spread.first[wo_rect_height(r)], 14 * wo_rect_height(r));
            wo_point_spread_destroy(&plain, &spread);
            wo_point_raster_destroy(&plain, &raster);
        }
        wo_thin_pencils_destroy(&plain, &pencils);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_and_size_are_those_of_the_rays),
        cmocka_unit_test(a_disc_covers_pixels),
        cmocka_unit_test(the_spread_is_turned),
        cmocka_unit_test(runs_are_the_raster),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
