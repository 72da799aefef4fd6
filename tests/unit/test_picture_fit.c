/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "cli/picture_fit.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A picture whose value is linear in the place of the pixel's centre. */
static wo_image ramp(wo_rect bounds, double at_x, double at_y, int32_t components)
{
    const size_t row = (size_t)wo_rect_width(bounds) * (size_t)components * sizeof(float);
    wo_image image = {malloc(row * (size_t)wo_rect_height(bounds)), bounds, (ptrdiff_t)row,
                      components};
    assert_non_null(image.data);
    for (int32_t y = bounds.y1; y < bounds.y2; y++)
        for (int32_t x = bounds.x1; x < bounds.x2; x++)
            for (int32_t c = 0; c < components; c++)
                wo_image_at(&image, x, y)[c] =
                    (float)(at_x * (x + 0.5) + at_y * (y + 0.5) + 1000 * c);
    return image;
}

static bool fit(wo_rect project, double aspect, wo_clip_size size, wo_rect display,
                double own_aspect, bool nearest, wo_image *image, wo_error *error)
{
    const wo_project_pixels pixels = {project, aspect, size};
    const wo_io_part part = {.display_window = display, .pixel_aspect = own_aspect};
    return wo_picture_fit(&pixels, &part, nearest, image, error) == WO_OK;
}

static void assert_bounds(const wo_image *image, wo_rect wanted)
{
    assert_int_equal(image->bounds.x1, wanted.x1);
    assert_int_equal(image->bounds.y1, wanted.y1);
    assert_int_equal(image->bounds.x2, wanted.x2);
    assert_int_equal(image->bounds.y2, wanted.y2);
}

static double value(const wo_image *image, int32_t x, int32_t y, int32_t c)
{
    return (double)wo_image_at(image, x, y)[c];
}

static void what_fits_is_left_alone(void **state)
{
    (void)state;
    const wo_rect frame = {0, 0, 16, 9}, data = {3, -2, 20, 5};
    for (int size = 0; size < 3; size++) {
        wo_image image = ramp(data, 1, 1, 3);
        const float *const before = image.data;
        assert_true(fit(frame, 1, (wo_clip_size)size, frame, 1, true, &image, NULL));
        assert_true(fit(frame, 1, (wo_clip_size)size, (wo_rect){5, 5, 21, 14}, 1, true, &image,
                        NULL)); /* as large, elsewhere */
        assert_true(fit(frame, 2, (wo_clip_size)size, frame, 2.00001, true, &image, NULL));
        assert_true(fit(frame, 1, (wo_clip_size)size, frame, NAN, true, &image, NULL));
        assert_ptr_equal(image.data, before);
        assert_bounds(&image, data);
        free(image.data);
    }
}

static void another_size_is_refused_unless_it_is_wanted(void **state)
{
    (void)state;
    const wo_rect frame = {0, 0, 16, 8}, half = {0, 0, 8, 4};
    wo_image image = ramp(half, 1, 0, 1);
    wo_error error = {0};
    assert_false(fit(frame, 1, WO_CLIP_SIZE_ERROR, half, 1, true, &image, &error));
    assert_int_equal(error.status, WO_ERR_RANGE);
    assert_non_null(strstr(error.text, "8 x 4 px"));
    assert_non_null(strstr(error.text, "16 x 8"));
    assert_non_null(strstr(error.text, "--clip-size scale"));
    assert_false(fit(frame, 2, WO_CLIP_SIZE_ERROR, frame, 1, true, &image, &error));
    assert_non_null(strstr(error.text, "of aspect 2"));
    assert_true(fit(frame, 1, WO_CLIP_SIZE_KEEP, half, 1, true, &image, &error));
    assert_bounds(&image, half);
    assert_true(fit(frame, 1, WO_CLIP_SIZE_SCALE, half, 1, true, &image, &error));
    assert_bounds(&image, frame);
    for (int32_t y = 0; y < 8; y++)
        for (int32_t x = 0; x < 16; x++)
            assert_true(value(&image, x, y, 0) == x / 2 + 0.5); /* picked */
    free(image.data);
}

/* Pixels twice as wide: each is as wide as two of the other picture. */
static void another_pixel_aspect_is_resampled(void **state)
{
    (void)state;
    for (int size = 0; size < 3; size++) {
        wo_image image = ramp((wo_rect){2, 0, 12, 4}, 1, 0, 1);
        assert_true(fit((wo_rect){0, 0, 8, 4}, 2, (wo_clip_size)size, (wo_rect){0, 0, 16, 4}, 1,
                        true, &image, NULL));
        assert_bounds(&image, (wo_rect){1, 0, 6, 4});
        for (int32_t x = 1; x < 6; x++)
            assert_true(value(&image, x, 3, 0) == 2 * x + 1.5);
        free(image.data);

        image = ramp((wo_rect){2, 0, 12, 4}, 1, 0, 1);
        assert_true(fit((wo_rect){0, 0, 8, 4}, 2, (wo_clip_size)size, (wo_rect){0, 0, 16, 4}, 1,
                        false, &image, NULL));
        for (int32_t x = 1; x < 6; x++)
            assert_true(fabs(value(&image, x, 3, 0) - (2 * x + 1)) < 1e-5); /* the mean of two */
        free(image.data);

        image = ramp((wo_rect){-1, 0, 8, 4}, 1, 0, 1);
        assert_true(fit((wo_rect){0, 0, 16, 4}, 1, (wo_clip_size)size, (wo_rect){0, 0, 8, 4}, 2,
                        true, &image, NULL));
        assert_bounds(&image, (wo_rect){-2, 0, 16, 4});
        for (int32_t x = -2; x < 16; x++)
            assert_true(value(&image, x, 0, 0) == floor(x / 2.0) + 0.5);
        free(image.data);
    }
    /* 1440 wide pixels that make 1919.95 of the others */
    wo_image image = ramp((wo_rect){0, 0, 1440, 3}, 1, 0, 1);
    assert_true(fit((wo_rect){0, 0, 1920, 3}, 1, WO_CLIP_SIZE_ERROR, (wo_rect){0, 0, 1440, 3},
                    1.3333, true, &image, NULL));
    assert_bounds(&image, (wo_rect){0, 0, 1920, 3});
    free(image.data);
}

/* Inside the picture the new value is that at its place: interpolation knows lines, the mean of
   whole pixels, too; that of parts of pixels does to an eighth of an old pixel's step. */
static void scaled_colours_stay_in_place(void **state)
{
    (void)state;
    const wo_rect from = {4, 2, 28, 14};
    const struct {
        int32_t width, height;
        double error;
    } sizes[] = {{24, 12, 0},   {48, 24, 2e-3}, {12, 6, 2e-3},  {37, 19, 2e-3},
                 {48, 6, 2e-3}, {8, 3, 2e-3},   {16, 8, 0.625}, {7, 5, 0.625}};
    for (size_t i = 0; i < WO_COUNT(sizes); i++) {
        const wo_rect to = {-3, 5, -3 + sizes[i].width, 5 + sizes[i].height};
        const double sx = sizes[i].width / 24.0, sy = sizes[i].height / 12.0;
        wo_image image = ramp(from, 3, -2, 4);
        assert_true(fit(to, 1, WO_CLIP_SIZE_SCALE, from, 1, false, &image, NULL));
        if (sizes[i].width == 24) { /* as large: it stays where its coordinates say */
            assert_bounds(&image, from);
            free(image.data);
            continue;
        }
        assert_bounds(&image, to);
        const int32_t rim_x = 1 + (int32_t)ceil(sx / 2), rim_y = 1 + (int32_t)ceil(sy / 2);
        for (int32_t y = to.y1 + rim_y; y < to.y2 - rim_y; y++)
            for (int32_t x = to.x1 + rim_x; x < to.x2 - rim_x; x++) {
                const double old_x = (x + 0.5 - to.x1) / sx + from.x1;
                const double old_y = (y + 0.5 - to.y1) / sy + from.y1;
                for (int c = 0; c < 4; c++)
                    assert_true(fabs(value(&image, x, y, c) - (3 * old_x - 2 * old_y + 1000 * c)) <
                                sizes[i].error);
            }
        free(image.data);
    }
}

static void nothing_is_made_up(void **state)
{
    (void)state;
    const wo_rect from = {0, 0, 10, 10}, to = {0, 0, 23, 17};
    wo_image image = ramp(from, 0, 0, 1); /* all 0 */
    for (int32_t i = 0; i < 10; i++)
        *wo_image_at(&image, i, 5) = INFINITY;
    assert_true(fit(to, 1, WO_CLIP_SIZE_SCALE, from, 1, false, &image, NULL));
    for (int32_t y = 0; y < 17; y++)
        for (int32_t x = 0; x < 23; x++)
            assert_true(value(&image, x, y, 0) == 0 || isinf(value(&image, x, y, 0)));
    free(image.data);

    wo_error error = {0};
    image = ramp(from, 1, 0, 1);
    assert_false(fit((wo_rect){0, 0, 60000, 10}, 1, WO_CLIP_SIZE_SCALE, (wo_rect){0, 0, 1, 10}, 1,
                     true, &image, &error));
    assert_int_equal(error.status, WO_ERR_RANGE);
    assert_bounds(&image, from);
    free(image.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_fits_is_left_alone),
        cmocka_unit_test(another_size_is_refused_unless_it_is_wanted),
        cmocka_unit_test(another_pixel_aspect_is_resampled),
        cmocka_unit_test(scaled_colours_stay_in_place),
        cmocka_unit_test(nothing_is_made_up),
    };
    return cmocka_run_group_tests_name("picture_fit", tests, NULL, NULL);
}
