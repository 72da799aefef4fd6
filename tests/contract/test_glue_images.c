/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "glue_fixture.h"

#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Hosts as they are, part two: images, regions, scales. */

static const char *const depths[] = {kOfxBitDepthByte, kOfxBitDepthShort, kOfxBitDepthHalf,
                                     kOfxBitDepthFloat};
static const char *const kinds[] = {kOfxImageComponentRGBA, kOfxImageComponentRGB,
                                    kOfxImageComponentAlpha};
static const wo_rect frame = {-3, 2, 14, 11};

static void source_and_output(void)
{
    picture_make(&mock.pictures[0], frame, kOfxBitDepthFloat, kOfxImageComponentRGBA, 0, 1);
    picture_make(&mock.pictures[MOCK_OUTPUT], frame, kOfxBitDepthFloat, kOfxImageComponentRGBA, 0,
                 9);
}

static void assert_picture(OfxImageEffectHandle effect, expected *e, wo_rect window)
{
    picture_fill(&mock.pictures[MOCK_OUTPUT], 0x7f);
    render(effect, window, kOfxStatOK);
    assert_output(expect_pixels(e, window), window);
}

static void inputs_of_any_kind_are_taken(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    for (size_t depth = 0; depth < WO_COUNT(depths); depth++)
        for (size_t kind = 0; kind < WO_COUNT(kinds); kind++)
            for (unsigned layout = 0; layout < 8; layout++) {
                expected e;
                picture_make(&mock.pictures[0], frame, depths[depth], kinds[kind], layout, 1);
                picture_make(&mock.pictures[1], frame, depths[depth], kinds[kind], layout, 2);
                picture_make(&mock.pictures[2], frame, depths[depth], kOfxImageComponentAlpha,
                             layout, 3);
                picture_make(&mock.pictures[MOCK_OUTPUT], frame, kOfxBitDepthFloat,
                             kOfxImageComponentRGBA, layout, 9);
                expect_defaults(&e);
                e.alpha = kind == 1 ? WO_ALPHA_OPAQUE : WO_ALPHA_PREMULTIPLIED;
                assert_picture(effect, &e, frame);
                fixture_free_pictures();
            }
    mock_destroy(probe, effect);
}

static void outputs_of_any_kind_are_written(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    const wo_rect window = {-1, 3, 12, 10};
    mock_set_number(effect, "tint", 1.5, 0, 1);    /* beyond 1, and 0 */
    mock_set_number(effect, "centre", 0, -200, 0); /* below 0 */
    for (size_t depth = 0; depth < WO_COUNT(depths); depth++)
        for (size_t kind = 0; kind < WO_COUNT(kinds); kind++)
            for (unsigned layout = 0; layout < 8; layout++) {
                expected e;
                picture_make(&mock.pictures[0], frame, kOfxBitDepthFloat, kOfxImageComponentRGBA, 0,
                             1);
                picture_make(&mock.pictures[MOCK_OUTPUT], frame, depths[depth], kinds[kind], layout,
                             9);
                expect_defaults(&e);
                e.params.tint[0] = 1.5;
                e.params.tint[1] = 0;
                e.params.centre[1] = -200;
                assert_picture(effect, &e, window);
                /* Nothing outside the window is touched. */
                const float outside = picture_value(&mock.pictures[MOCK_OUTPUT], -2, 3, 0);
                picture_fill(&mock.pictures[MOCK_OUTPUT], 0x7f);
                const float untouched = picture_value(&mock.pictures[MOCK_OUTPUT], -2, 3, 0);
                assert_memory_equal(&outside, &untouched, sizeof outside);
                fixture_free_pictures();
            }
    mock_destroy(probe, effect);
}

static void inputs_are_never_written(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    source_and_output();
    const wo_image before = picture_floats(&mock.pictures[0]);
    expected e;
    expect_defaults(&e);
    assert_picture(effect, &e, frame);
    const wo_image after = picture_floats(&mock.pictures[0]);
    assert_memory_equal(before.data, after.data, 17 * 9 * 4 * sizeof(float));
    mock_destroy(probe, effect);
}

static void alpha_is_taken_as_the_image_says(void **state)
{
    static const struct {
        const char *text;
        wo_alpha alpha;
    } rows[] = {{kOfxImageOpaque, WO_ALPHA_OPAQUE},
                {kOfxImagePreMultiplied, WO_ALPHA_PREMULTIPLIED},
                {kOfxImageUnPreMultiplied, WO_ALPHA_UNPREMULTIPLIED},
                {NULL, WO_ALPHA_PREMULTIPLIED}};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
        expected e;
        source_and_output();
        mock.pictures[0].alpha = rows[i].text;
        expect_defaults(&e);
        e.alpha = rows[i].alpha;
        assert_picture(effect, &e, frame);
        mock_destroy(probe, effect);
        fixture_free_pictures();
    }
}

static void images_that_are_not_there_are_not_connected(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    source_and_output();
    for (int how = 0; how < 4; how++) {
        for (int clip = 1; clip <= 2; clip++) {
            mock.pictures[clip] = mock.pictures[0];
            mock.pictures[clip].components = kOfxImageComponentAlpha;
            if (how == 0)
                mock.pictures[clip].silent = true;
            else if (how == 1)
                mock.pictures[clip].data = NULL;
            else if (how == 2)
                mock.pictures[clip].bounds = (wo_rect){5, 5, 5, 9};
            else
                mock.pictures[clip].connected = false;
            if (how == 2)
                mock.pictures[clip].region = (OfxRectD){0, 0, 9, 9};
        }
        assert_non_null(strstr(explain(effect, frame, NULL), "connected=1000\npixels=4000\n"));
        if (how == 2)
            mock.pictures[1].data = mock.pictures[2].data = NULL;
        expected e;
        expect_defaults(&e);
        assert_picture(effect, &e, frame);
    }
    mock_destroy(probe, effect);
}

static void without_source_the_picture_is_black(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    for (int how = 0; how < 3; how++)
        for (size_t depth = 0; depth < WO_COUNT(depths); depth++) {
            source_and_output();
            picture_make(&mock.pictures[MOCK_OUTPUT], frame, depths[depth], kOfxImageComponentRGBA,
                         0, 9);
            mock.pictures[0].silent = how == 0;
            mock.pictures[0].connected = how != 1;
            if (how == 2)
                mock.pictures[0].data = NULL;
            render(effect, (wo_rect){0, 3, 5, 6}, kOfxStatOK);
            for (int c = 0; c < 4; c++) {
                assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 0, 3, c) == 0);
                assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 4, 5, c) == 0);
            }
            assert_int_equal(mock.persistent, 0);
            fixture_free_pictures();
        }
    mock_destroy(probe, effect);
}

static void senseless_images_are_refused(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    for (int clip = 0; clip <= MOCK_OUTPUT; clip += MOCK_OUTPUT)
        for (int how = 0; how < 8; how++) {
            source_and_output();
            mock_picture *const p = &mock.pictures[clip];
            mock.persistent = 0;
            if (how == 0)
                p->depth = "OfxBitDepthMany";
            else if (how == 1)
                p->depth = NULL;
            else if (how == 2)
                p->components = "uk.co.example.Vectors";
            else if (how == 3)
                p->components = NULL;
            else if (how == 4)
                p->row_bytes = 17 * 16 - 4;
            else if (how == 5)
                p->row_bytes = 0;
            else /* bytes are converted, not borrowed */
                picture_make(p, frame, kOfxBitDepthByte, kOfxImageComponentRGBA, 0, 1);
            if (how >= 6)
                p->row_bytes = how == 6 ? 17 * 4 - 1 : 1 - 17 * 4;
            render(effect, frame, kOfxStatErrImageFormat);
            assert_int_equal(mock.persistent, 1);
            assert_non_null(strstr(mock.message, clip ? "Output: " : "Source: "));
            fixture_free_pictures();
        }
    source_and_output();
    mock.pictures[0].bounds = (wo_rect){0, 0, INT_MAX, 1};
    mock.pictures[0].row_bytes = INT_MAX;
    mock.pictures[0].depth = kOfxBitDepthByte;
    mock.pictures[0].region = (OfxRectD){0, 0, 10, 10};
    const wo_rect large = {0, 0, 200000, 1};
    mock.pictures[MOCK_OUTPUT].bounds = large;
    mock.pictures[MOCK_OUTPUT].row_bytes = INT_MAX;
    render(effect, large, kOfxStatFailed);
    assert_non_null(strstr(mock.message, "200000"));
    mock_destroy(probe, effect);
}

static void a_host_out_of_memory_is_a_failure(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    source_and_output();
    mock.pictures[1] = mock.pictures[0];
    mock.pictures[1].starved = true;
    render(effect, frame, kOfxStatErrMemory);
    assert_non_null(strstr(mock.message, "Depth: "));
    mock_destroy(probe, effect);
}

static void no_output_image_is_a_failure(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    source_and_output();
    mock.pictures[MOCK_OUTPUT].silent = true;
    render(effect, frame, kOfxStatFailed);
    assert_non_null(strstr(mock.message, "no image to render into"));
    mock_destroy(probe, effect);
}

static void windows_are_cut_to_the_output(void **state)
{
    (void)state;
    expected e;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    const wo_rect small = {0, 4, 5, 8};
    source_and_output();
    picture_make(&mock.pictures[MOCK_OUTPUT], small, kOfxBitDepthFloat, kOfxImageComponentRGBA, 0,
                 9);
    render(effect, (wo_rect){-100, -100, 100, 100}, kOfxStatOK);
    expect_defaults(&e);
    assert_output(expect_pixels(&e, small), small);
    render(effect, (wo_rect){50, 50, 60, 60}, kOfxStatOK);
    render(effect, (wo_rect){5, 5, 2, 2}, kOfxStatOK);
    mock_destroy(probe, effect);
}

static void too_small_an_image_is_asked_for_again(void **state)
{
    (void)state;
    expected e;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    const wo_rect window = {2, 4, 6, 8};
    source_and_output();
    mock.pictures[0].first = window; /* what a host gives that knows no regions of interest */
    expect_defaults(&e);
    assert_picture(effect, &e, window);
    mock_destroy(probe, effect);
}

/* The clip says it is larger than its images are: memory beyond them must not be read, which the
   address sanitizer watches, and the edge is repeated. */
static void bounds_may_be_smaller_than_the_region(void **state)
{
    (void)state;
    expected e;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    source_and_output();
    mock.pictures[0].region = (OfxRectD){-20, -20, 40, 40};
    expect_defaults(&e);
    assert_picture(effect, &e, frame);
    picture_make(&mock.pictures[MOCK_OUTPUT], (wo_rect){30, 30, 40, 40}, kOfxBitDepthFloat,
                 kOfxImageComponentRGBA, 0, 9);
    assert_picture(effect, &e, (wo_rect){30, 30, 40, 40});
    mock_destroy(probe, effect);
}

static void tiles_make_the_same_bytes(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    for (size_t depth = 0; depth < WO_COUNT(depths); depth++) {
        expected e;
        picture_make(&mock.pictures[0], frame, depths[depth], kOfxImageComponentRGBA, 0, 1);
        picture_make(&mock.pictures[1], frame, depths[depth], kOfxImageComponentRGB, 0, 2);
        picture_make(&mock.pictures[2], frame, depths[depth], kOfxImageComponentAlpha, 0, 3);
        picture_make(&mock.pictures[MOCK_OUTPUT], frame, depths[depth], kOfxImageComponentRGBA, 0,
                     9);
        expect_defaults(&e);
        picture_fill(&mock.pictures[MOCK_OUTPUT], 0x7f);
        for (int32_t y = frame.y1; y < frame.y2; y += 2)
            for (int32_t x = frame.x1; x < frame.x2; x += 5)
                render(effect, wo_rect_intersect((wo_rect){x, y, x + 5, y + 2}, frame), kOfxStatOK);
        assert_output(expect_pixels(&e, frame), frame);
        fixture_free_pictures();
    }
    mock_destroy(probe, effect);
}

/* Clips with small bounding boxes: depth repeats its edge, colour and masks end; tiles beside them
   see the same as the whole picture does. */
static void tiles_beside_small_clips_see_what_is_there(void **state)
{
    (void)state;
    static const char *const alphas[] = {kOfxImagePreMultiplied, kOfxImageOpaque};
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    for (size_t depth = 0; depth < WO_COUNT(depths); depth++)
        for (size_t kind = 0; kind < 2; kind++) {
            expected e;
            source_and_output();
            picture_make(&mock.pictures[1], (wo_rect){2, 5, 6, 8}, depths[depth],
                         kOfxImageComponentRGB, 0, 2);
            picture_make(&mock.pictures[2], (wo_rect){7, 3, 11, 7}, depths[depth],
                         kOfxImageComponentAlpha, 0, 3);
            picture_make(&mock.pictures[3], (wo_rect){-9, 4, 5, 9}, depths[depth], kinds[kind], 0,
                         4);
            mock.pictures[3].alpha = alphas[kind];
            expect_defaults(&e);
            assert_picture(effect, &e, frame);
            picture_fill(&mock.pictures[MOCK_OUTPUT], 0x7f);
            for (int32_t y = frame.y1; y < frame.y2; y++)
                for (int32_t x = frame.x1; x < frame.x2; x += 2)
                    render(effect, wo_rect_intersect((wo_rect){x, y, x + 2, y + 1}, frame),
                           kOfxStatOK);
            assert_output(expect_pixels(&e, frame), frame);
            fixture_free_pictures();
        }
    mock_destroy(probe, effect);
}

/* An opaque picture may carry rubbish in its alpha; its border must not become part of it. */
static void the_border_of_an_opaque_clip_is_not_opaque(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    source_and_output();
    picture_make(&mock.pictures[3], (wo_rect){0, 4, 5, 9}, kOfxBitDepthFloat,
                 kOfxImageComponentRGBA, 0, 4);
    mock.pictures[3].alpha = kOfxImageOpaque;
    mock_set_number(effect, "radius", 0, 0, 0);
    render(effect, frame, kOfxStatOK);
    for (int c = 0; c < 4; c++) {
        const float under = picture_value(&mock.pictures[0], 6, 5, c);
        assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 6, 5, c) == under);
        const float over = c == 3 ? 1 : picture_value(&mock.pictures[3], 1, 5, c);
        assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 1, 5, c) == over);
    }
    mock_destroy(probe, effect);
}

/* Where the host rounds its regions to one pixel more than we do, that pixel belongs to the
   picture; a larger difference is something else. */
static void the_hosts_rounding_counts(void **state)
{
    (void)state;
    expected e;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    source_and_output();
    mock.pictures[0].region = (OfxRectD){-2, 2, 13, 11};
    expect_defaults(&e);
    mock.pictures[MOCK_OUTPUT].defined = frame;
    assert_picture(effect, &e, frame);

    mock.pictures[MOCK_OUTPUT].defined = (wo_rect){0, 3, 1, 4};
    assert_picture(effect, &e, (wo_rect){-2, 2, 13, 11});
    mock.pictures[MOCK_OUTPUT].defined = (wo_rect){-5, 2, 14, 11};
    render(effect, frame, kOfxStatOK);
    for (int c = 0; c < 4; c++)
        assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], -3, 5, c) == 0);
    mock_destroy(probe, effect);
}

/* Hosts may want to see what is beside Source. */
static void beside_source_is_nothing(void **state)
{
    (void)state;
    expected e;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    const wo_rect wide = {-8, 0, 20, 15};
    for (size_t depth = 0; depth < WO_COUNT(depths); depth++) {
        source_and_output();
        picture_make(&mock.pictures[MOCK_OUTPUT], wide, depths[depth], kOfxImageComponentRGBA, 0,
                     9);
        expect_defaults(&e);
        render(effect, wide, kOfxStatOK);
        assert_output(expect_pixels(&e, frame), frame);
        for (int c = 0; c < 4; c++) {
            assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], -8, 0, c) == 0);
            assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 14, 5, c) == 0);
            assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 19, 14, c) == 0);
        }
        picture_fill(&mock.pictures[MOCK_OUTPUT], 0x7f);
        render(effect, (wo_rect){15, 0, 20, 15}, kOfxStatOK);
        assert_true(picture_value(&mock.pictures[MOCK_OUTPUT], 15, 5, 0) == 0);
        fixture_free_pictures();
    }
    mock_destroy(probe, effect);
}

static bool says(OfxImageEffectHandle effect, const double scale[2], const char *line)
{
    const char *const text = explain(effect, (wo_rect){-200, -200, 2000, 2000}, scale);
    if (!strstr(text, line))
        print_error("%s is not in:\n%s", line, text);
    return strstr(text, line) != NULL;
}

static void scales_and_aspects_reach_the_core(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    const double half[2] = {0.5, 0.5}, flat[2] = {0.5, 0.25}, third[2] = {1 / 3.0, 1 / 3.0};
    const double tiny[2] = {0.004, 0.004}, none[2] = {0, 0}, mad[2] = {NAN, -1};
    const double aspect = 2, zero = 0, size[2] = {1920, 1080}, offset[2] = {-100, 10};
    source_and_output();
    /* A piece of Source, which is there at every scale. */
    picture_make(&mock.pictures[0], (wo_rect){0, 0, 1, 1}, kOfxBitDepthFloat,
                 kOfxImageComponentRGBA, 0, 1);
    mock.pictures[0].region = (OfxRectD){-3, 2, 14, 11};
    mock_set_number(effect, "radius", 8, 0, 0);
    assert_true(says(effect, NULL, "scale=1.000000\nstretch=1.000000\n"));
    assert_true(says(effect, none, "scale=1.000000\nstretch=1.000000\n"));
    assert_true(says(effect, mad, "scale=1.000000\nstretch=1.000000\n"));
    assert_true(says(effect, half, "scale=0.500000\nstretch=1.000000\n"));
    assert_true(says(effect, half, "reach=4,4\n"));
    assert_true(says(effect, flat, "scale=0.500000\nstretch=0.500000\n"));
    assert_true(says(effect, flat, "format=0,0,50,13\nextent=-2,0,7,3\n"));
    assert_true(says(effect, tiny, "format=0,0,1,1\n"));
    mock_set_property(effect, kOfxImageEffectPropProjectSize, 2, size);
    assert_true(says(effect, third, "format=0,0,640,360\n"));
    mock_set_property(effect, kOfxImageEffectPropProjectOffset, 2, offset);
    assert_true(says(effect, half, "format=-50,5,910,545\n"));

    /* Pixels twice as wide as high: half as many across, blur half as wide in them. */
    mock_set_property(effect, kOfxImageEffectPropProjectPixelAspectRatio, 1, &aspect);
    assert_true(says(effect, half, "format=-25,5,455,545\n"));
    assert_true(says(effect, half, "scale=0.500000\nstretch=2.000000\n"));
    assert_true(says(effect, half, "reach=4,8\n"));
    mock_set_property(effect, kOfxImageEffectPropProjectPixelAspectRatio, 1, &zero);
    assert_true(says(effect, half, "stretch=1.000000\n"));
    mock_destroy(probe, effect);
}

static void endless_regions_end_at_the_project(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    const double half[2] = {0.5, 0.5};
    OfxRectD region;
    source_and_output();
    mock.pictures[0].region = (OfxRectD){kOfxFlagInfiniteMin, -7, kOfxFlagInfiniteMax, 1e12};
    assert_true(says(effect, NULL, "extent=0,-7,100,50\n"));
    assert_true(says(effect, half, "extent=0,-4,50,25\n"));
    assert_int_equal(mock_region(probe, effect, &region), kOfxStatOK);
    assert_true(region.x1 == 0 && region.y1 == -7 && region.x2 == 100 && region.y2 == 50);

    mock.pictures[0].region = (OfxRectD){-INFINITY, -INFINITY, INFINITY, INFINITY};
    assert_int_equal(mock_region(probe, effect, &region), kOfxStatOK);
    assert_true(region.x1 == 0 && region.y1 == 0 && region.x2 == 100 && region.y2 == 50);
    mock.pictures[0].region = (OfxRectD){10, 10, NAN, 20};
    assert_int_equal(mock_region(probe, effect, &region), kOfxStatOK);
    assert_true(region.x2 > region.x1 && region.x2 <= 100);

    /* A region of its own is passed on to the last bit. */
    mock.pictures[0].region = (OfxRectD){-1.25, 0.1, 33.3, 44};
    assert_int_equal(mock_region(probe, effect, &region), kOfxStatOK);
    assert_memory_equal(&region, &mock.pictures[0].region, sizeof region);
    mock.pictures[0].connected = false;
    assert_int_equal(mock_region(probe, effect, &region), kOfxStatReplyDefault);
    mock_destroy(probe, effect);
}

static void without_a_project_source_is_the_frame(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    const double senseless[2] = {0, 1e30}, extent[2] = {64, 32};
    source_and_output();
    mock_set_property(effect, kOfxImageEffectPropProjectSize, 0, NULL);
    assert_true(says(effect, NULL, "format=-3,2,14,11\nextent=-3,2,14,11\n"));
    mock_set_property(effect, kOfxImageEffectPropProjectSize, 2, senseless);
    assert_true(says(effect, NULL, "format=-3,2,14,11\n"));
    mock_set_property(effect, kOfxImageEffectPropProjectExtent, 2, extent);
    assert_true(says(effect, NULL, "format=0,0,64,32\n"));
    mock_destroy(probe, effect);
}

static void regions_of_interest_are_those_of_the_effect(void **state)
{
    (void)state;
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextGeneral);
    OfxRectD needed;
    source_and_output();
    mock.pictures[1] = mock.pictures[0];
    const OfxRectD region = {1, 3, 5, 7};
    assert_int_equal(mock_needed(probe, effect, region, "Source", &needed), kOfxStatOK);
    assert_true(needed.x1 == -1 && needed.y1 == 2 && needed.x2 == 7 && needed.y2 == 9);
    assert_int_equal(mock_needed(probe, effect, region, "Depth", &needed), kOfxStatOK);
    assert_true(needed.x1 == 1 && needed.y1 == 3 && needed.x2 == 5 && needed.y2 == 7);
    assert_int_equal(mock_needed(probe, effect, region, "Mask", &needed), kOfxStatOK);
    assert_true(needed.x2 == 0); /* not connected, not set */
    const OfxRectD endless = {kOfxFlagInfiniteMin, kOfxFlagInfiniteMin, kOfxFlagInfiniteMax,
                              kOfxFlagInfiniteMax};
    assert_int_equal(mock_needed(probe, effect, endless, "Depth", &needed), kOfxStatOK);
    assert_true(needed.x1 == -3 && needed.y1 == 2 && needed.x2 == 14 && needed.y2 == 11);
    const OfxRectD beside = {200, 3, 300, 4};
    assert_int_equal(mock_needed(probe, effect, beside, "Depth", &needed), kOfxStatOK);
    assert_true(needed.x1 == 13 && needed.y1 == 3 && needed.x2 == 14 && needed.y2 == 4);
    mock_destroy(probe, effect);
}

static void identity_is_a_copy_and_nothing_less(void **state)
{
    (void)state;
    char clip[64];
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    source_and_output();
    assert_int_equal(mock_identity(probe, effect, clip), kOfxStatReplyDefault);
    mock_set_number(effect, "on", 0, 0, 0);
    assert_int_equal(mock_identity(probe, effect, clip), kOfxStatOK);
    assert_string_equal(clip, "Source");
    mock.pictures[0].alpha = kOfxImageOpaque;
    assert_int_equal(mock_identity(probe, effect, clip), kOfxStatOK);
    mock.pictures[0].alpha = kOfxImageUnPreMultiplied;
    assert_int_equal(mock_identity(probe, effect, clip), kOfxStatReplyDefault);
    mock.pictures[0].alpha = kOfxImagePreMultiplied;
    mock.pictures[0].components = kOfxImageComponentRGB;
    assert_int_equal(mock_identity(probe, effect, clip), kOfxStatReplyDefault);
    mock.pictures[0].components = kOfxImageComponentRGBA;
    mock.pictures[0].connected = false;
    assert_int_equal(mock_identity(probe, effect, clip), kOfxStatReplyDefault);
    mock_destroy(probe, effect);
}

static void single_fields_are_refused(void **state)
{
    (void)state;
    const double scale[2] = {1, 1};
    const OfxImageEffectHandle effect = create(kOfxImageEffectContextFilter);
    source_and_output();
    assert_int_equal(mock_render(probe, effect, frame, scale, kOfxImageFieldBoth), kOfxStatOK);
    assert_int_equal(mock_render(probe, effect, frame, scale, NULL), kOfxStatOK);
    assert_int_equal(mock_render(probe, effect, frame, scale, kOfxImageFieldLower), kOfxStatFailed);
    assert_non_null(strstr(mock.message, "fields"));
    mock_destroy(probe, effect);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, fixture_load, fixture_unload)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(inputs_of_any_kind_are_taken),
        TEST(outputs_of_any_kind_are_written),
        TEST(inputs_are_never_written),
        TEST(alpha_is_taken_as_the_image_says),
        TEST(images_that_are_not_there_are_not_connected),
        TEST(without_source_the_picture_is_black),
        TEST(senseless_images_are_refused),
        TEST(a_host_out_of_memory_is_a_failure),
        TEST(no_output_image_is_a_failure),
        TEST(windows_are_cut_to_the_output),
        TEST(too_small_an_image_is_asked_for_again),
        TEST(bounds_may_be_smaller_than_the_region),
        TEST(tiles_make_the_same_bytes),
        TEST(tiles_beside_small_clips_see_what_is_there),
        TEST(the_border_of_an_opaque_clip_is_not_opaque),
        TEST(the_hosts_rounding_counts),
        TEST(beside_source_is_nothing),
        TEST(scales_and_aspects_reach_the_core),
        TEST(endless_regions_end_at_the_project),
        TEST(without_a_project_source_is_the_frame),
        TEST(regions_of_interest_are_those_of_the_effect),
        TEST(identity_is_a_copy_and_nothing_less),
        TEST(single_fields_are_refused),
    };
    return cmocka_run_group_tests_name("glue and odd images", tests, fixture_open, fixture_close);
}
