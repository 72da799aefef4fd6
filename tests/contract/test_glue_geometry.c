/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "glue_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* Which coordinates hosts mean: what the render window asks for is filled whatever they say. */

static const wo_rect full = {0, 0, 40, 30}; /* pixels of the render */
static const double half[2] = {0.5, 0.5};

static void picture(int clip, wo_rect bounds, const char *components)
{
    picture_make(&mock.pictures[clip], bounds, kOfxBitDepthFloat, components, 0,
                 (unsigned)clip + 1);
}

/* Source, depth and mask over the whole picture, with regions as the host names them. */
static void pictures(OfxRectD region)
{
    picture(PROBE_SOURCE, full, kOfxImageComponentRGBA);
    picture(PROBE_DEPTH, full, kOfxImageComponentAlpha);
    picture(PROBE_MASK, full, kOfxImageComponentAlpha);
    picture(MOCK_OUTPUT, full, kOfxImageComponentRGBA);
    for (int i = 0; i <= PROBE_MASK; i++)
        mock.pictures[i].region = region;
}

static OfxImageEffectHandle project(double width, double height, double aspect)
{
    const double size[2] = {width, height};
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    mock_set_property(effect, kOfxImageEffectPropProjectSize, 2, size);
    mock_set_property(effect, kOfxImageEffectPropProjectPixelAspectRatio, 1, &aspect);
    mock_set_number(effect, "radius", 6, 0, 0);
    mock_set_number(effect, "centre", 3, 4, 0);
    return effect;
}

static void assert_render(OfxImageEffectHandle effect, wo_rect window, const double scale[2],
                          const expected *e)
{
    picture_fill(&mock.pictures[MOCK_OUTPUT], 0x7f);
    const OfxStatus status = mock_render(probe, effect, window, scale, NULL);
    if (status != kOfxStatOK)
        print_error("message: %s\n", mock.message);
    assert_int_equal(status, kOfxStatOK);
    const wo_rect asked = wo_rect_intersect(window, mock.pictures[MOCK_OUTPUT].bounds);
    const wo_rect filled = wo_rect_intersect(asked, e->geometry.extent);
    assert_output(expect_pixels(e, filled), filled);
    for (int32_t y = asked.y1; y < asked.y2; y++)
        for (int32_t x = asked.x1; x < asked.x2; x++)
            if (x < filled.x1 || x >= filled.x2 || y < filled.y1 || y >= filled.y2)
                assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], x, y, 3) == 0);
}

static expected whole(double scale_x, double aspect, double stretch)
{
    expected e;
    expect_defaults(&e);
    e.params.radius = 6;
    e.params.centre[0] = 3;
    e.params.centre[1] = 4;
    e.geometry = (wo_geometry){.format = full,
                               .extent = full,
                               .render_scale = scale_x,
                               .pixel_stretch = stretch,
                               .pixel_aspect = aspect,
                               .connected = {true, true, true}};
    return e;
}

static void assert_format(OfxImageEffectHandle effect, const double scale[2])
{
    static const char line[] = "format=0,0,40,30\nextent=0,0,40,30\n";
    const char *const text = explain(effect, full, scale);
    if (!strstr(text, line))
        fail_msg("%s is not in:\n%s", line, text);
}

/* As the standard has it: the project and all regions at full size, square pixels. */
static void canonical_hosts_are_believed(void **state)
{
    (void)state;
    const struct {
        double scale[2], aspect;
    } rows[] = {{{0.5, 0.5}, 1}, {{0.5, 0.25}, 1}, {{1, 1}, 2}, {{0.5, 0.5}, 2}, {{2, 2}, 1}};
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        const double sx = rows[i].scale[0], sy = rows[i].scale[1], a = rows[i].aspect;
        const OfxRectD region = {0, 0, 40 * a / sx, 30 / sy};
        const OfxImageEffectHandle effect = project(region.x2, region.y2, a);
        const expected e = whole(sx, a, a * sy / sx);
        pictures(region);
        assert_render(effect, full, rows[i].scale, &e);
        assert_render(effect, (wo_rect){7, 3, 31, 22}, rows[i].scale, &e);
        assert_format(effect, rows[i].scale);
        mock_destroy(probe, effect);
        fixture_free_pictures();
    }
}

/* Project and regions in pixels of the render; whole pictures and tiles. */
static void pixel_hosts_are_seen_through(void **state)
{
    (void)state;
    const struct {
        double scale[2], aspect;
    } rows[] = {{{0.5, 0.5}, 1}, {{0.25, 0.25}, 1}, {{0.5, 0.25}, 1},
                {{1, 1}, 2},     {{0.5, 0.5}, 2},   {{1 / 3.0, 1 / 3.0}, 1.5}};
    static const wo_rect windows[] = {{0, 0, 40, 30},  {0, 0, 20, 15},   {20, 0, 40, 15},
                                      {0, 15, 20, 30}, {20, 15, 40, 30}, {38, 28, 40, 30}};
    for (size_t i = 0; i < 2 * WO_COUNT(rows); i++) {
        const double *const scale = rows[i / 2].scale;
        const double sx = scale[0], sy = scale[1], a = rows[i / 2].aspect;
        /* the project is in pixels, too, or it is not */
        const OfxImageEffectHandle effect =
            i % 2 ? project(40 * a / sx, 30 / sy, a) : project(40, 30, a);
        const expected e = whole(sx, a, a * sy / sx);
        for (size_t k = 0; k < WO_COUNT(windows); k++) {
            pictures((OfxRectD){0, 0, 40, 30});
            assert_render(effect, windows[k], scale, &e);
            for (int clip = 0; clip <= PROBE_MASK; clip++) /* images may say so, too */
                mock.pictures[clip].defined = full;
            assert_render(effect, windows[k], scale, &e);
            assert_format(effect, scale);
            fixture_free_pictures();
        }
        mock_destroy(probe, effect);
    }
}

/* Where Source is without end, the project tells. */
static void endless_regions_of_pixel_hosts(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = project(40, 30, 1);
    const expected e = whole(0.5, 1, 1);
    pictures((OfxRectD){kOfxFlagInfiniteMin, kOfxFlagInfiniteMin, kOfxFlagInfiniteMax,
                        kOfxFlagInfiniteMax});
    assert_render(effect, full, half, &e);
    assert_render(effect, (wo_rect){0, 0, 20, 15}, half, &e);
    mock_destroy(probe, effect);
}

/* Regions that fit nothing: Source reaches as far as its image where somebody wants to see it. */
static void regions_without_sense_are_not_believed(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = project(40, 30, 1);
    const expected e = whole(1, 1, 1);
    pictures((OfxRectD){0, 0, 40, 30});
    mock.pictures[0].region = (OfxRectD){5, 5, 17, 11};
    assert_render(effect, full, NULL, &e);
    mock.pictures[0].defined = full;
    assert_render(effect, full, NULL, &e);
    mock_destroy(probe, effect);
}

/* A window at full size for images at half: what there is of it. */
static void a_window_may_be_canonical(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = project(80, 60, 1);
    const expected e = whole(0.5, 1, 1);
    pictures((OfxRectD){0, 0, 80, 60});
    assert_render(effect, (wo_rect){0, 0, 80, 60}, half, &e);
    mock_destroy(probe, effect);
}

/* What looks alike and is none: a Source as small as half the project, in a host that wants to see
   the whole of it; one whose image is larger than what is defined. */
static void small_sources_stay_small(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = project(80, 60, 1);
    const wo_rect small = {0, 0, 20, 15};
    expected e = whole(0.5, 1, 1);
    pictures((OfxRectD){0, 0, 80, 60});
    picture(PROBE_SOURCE, small, kOfxImageComponentRGBA);
    mock.pictures[PROBE_SOURCE].region = (OfxRectD){0, 0, 40, 30};
    mock.pictures[MOCK_OUTPUT].defined = full;
    e.geometry.extent = small;
    assert_render(effect, full, half, &e);
    picture(PROBE_SOURCE, full, kOfxImageComponentRGBA);
    mock.pictures[PROBE_SOURCE].region = (OfxRectD){10, 4, 30, 26};
    mock.pictures[PROBE_SOURCE].defined = (wo_rect){5, 2, 15, 13};
    e.geometry.extent = (wo_rect){5, 2, 15, 13};
    assert_render(effect, full, half, &e);
    mock_destroy(probe, effect);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, fixture_load, fixture_unload)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(canonical_hosts_are_believed),   TEST(pixel_hosts_are_seen_through),
        TEST(endless_regions_of_pixel_hosts), TEST(regions_without_sense_are_not_believed),
        TEST(a_window_may_be_canonical),      TEST(small_sources_stay_small),
    };
    return cmocka_run_group_tests_name("glue and coordinates", tests, fixture_open, fixture_close);
}
