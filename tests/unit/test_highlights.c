/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "defocus/highlights.h"

#include "near.h"
#include "scenes.h"

#include <string.h>

static const wo_context plain = WO_CONTEXT_INIT;
static const wo_rect area = {-64, -48, 96, 64};
enum { WIDTH = 160, HEIGHT = 112 };

/* Black and opaque at one vergence. */
static wo_sheet sheet_make(float v)
{
    wo_sheet sheet;
    assert_int_equal(wo_sheet_create(&plain, area, &sheet, NULL), WO_OK);
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
        sheet.v[i] = v;
        memcpy(sheet.c[i], (const float[4]){0, 0, 0, 1}, sizeof sheet.c[i]);
    }
    sheet.any = true;
    return sheet;
}

static size_t at(int32_t x, int32_t y)
{
    return (size_t)((y - area.y1) * WIDTH + x - area.x1);
}

static wo_thin_pencils *pencils_make(double k)
{
    const wo_thin_lens lens = {k, 0, 1000};
    const wo_aperture aperture = WO_APERTURE_INIT;
    wo_thin_pencils *pencils = NULL;
    assert_int_equal(wo_thin_pencils_create(&plain, &lens, &aperture, 1, 1, 0, &pencils, NULL),
                     WO_OK);
    return pencils;
}

/* A lens that counts how often it is asked for a connection. */
typedef struct counting {
    wo_lens inner;
    int64_t calls;
} counting;

static double counted_connect(const void *self, double dx, double dy, double v, double line[4])
{
    union {
        const void *from;
        counting *to;
    } c = {.from = self};
    c.to->calls++;
    return c.to->inner.connect(c.to->inner.self, dx, dy, v, line);
}

static double counted_reach(const void *self, double v_far, double v_near)
{
    const counting *c = self;
    return c->inner.reach(c->inner.self, v_far, v_near);
}

static wo_lens counting_lens(counting *c, const wo_thin_pencils *pencils)
{
    *c = (counting){wo_thin_pencils_lens(pencils), 0};
    wo_lens lens = c->inner;
    lens.self = c;
    lens.connect = counted_connect;
    lens.reach = counted_reach;
    return lens;
}

static wo_highlights take(wo_sheet *sheets, size_t count, const wo_lens *lens)
{
    wo_highlights highlights;
    assert_int_equal(wo_highlights_take(&plain, sheets, count, area, lens, &highlights, NULL),
                     WO_OK);
    return highlights;
}

static void what_is_above_the_level_is_taken(void **state)
{
    (void)state;
    wo_thin_pencils *pencils = pencils_make(10);
    const wo_lens lens = wo_thin_pencils_lens(pencils);
    wo_sheet sheets[2] = {sheet_make(0.8f), {.area = area}};
    const float bright[4] = {100, 10, 1, 1};
    const float edge[4] = {4, 4, 4, 1};
    memcpy(sheets[0].c[at(5, 7)], bright, sizeof bright);
    memcpy(sheets[0].c[at(50, 40)], edge, sizeof edge);
    memcpy(sheets[0].c[at(-30, -20)], bright, sizeof bright);
    sheets[0].v[at(-30, -20)] = 0.09f; /* blur of 0.9 px: left to the rays */
    memcpy(sheets[0].c[at(-64, -48)], bright, sizeof bright);
    sheets[0].v[at(-64, -48)] = NAN;
    wo_highlights highlights = take(sheets, 2, &lens);
    assert_int_equal(highlights.count, 1);
    const wo_highlight *const h = &highlights.list[0];
    assert_int_equal(h->x, 5);
    assert_int_equal(h->y, 7);
    assert_near((double)h->v, 0.8, 0.5 / (32 * 10));
    assert_near((double)h->reach, 8, 0.02);
    /* In proportion: what stays has the hue of what was taken. */
    const float *const rest = sheets[0].c[at(5, 7)];
    assert_near((double)rest[0], 4, 1e-5);
    assert_near((double)rest[1], 0.4, 1e-5);
    assert_near((double)rest[2], 0.04, 1e-6);
    assert_true(rest[3] == 1);
    assert_memory_equal(sheets[0].c[at(50, 40)], edge, sizeof edge);
    assert_memory_equal(sheets[0].c[at(-30, -20)], bright, sizeof bright);
    wo_highlights_destroy(&plain, &highlights);
    wo_highlights_destroy(&plain, &highlights);
    wo_sheet_destroy(&plain, &sheets[0]);
    wo_thin_pencils_destroy(&plain, &pencils);
}

/* All of a light arrives, spread over the tiles around it. */
static void all_light_arrives(void **state)
{
    (void)state;
    wo_thin_pencils *pencils = pencils_make(10);
    const wo_lens lens = wo_thin_pencils_lens(pencils);
    wo_sheet sheet = sheet_make(1.17f);
    sheet.c[at(15, 9)][1] = 1004;
    wo_highlights highlights = take(&sheet, 1, &lens);
    uint8_t opaque[WIDTH * HEIGHT];
    memset(opaque, 1, sizeof opaque);
    wo_stack stack;
    assert_int_equal(wo_stack_create(&plain, &sheet, 1, opaque, area, area, &stack, NULL), WO_OK);
    double sum = 0;
    int64_t rays = 0;
    for (int32_t ty = -1; ty <= 2; ty++)
        for (int32_t tx = -1; tx <= 1; tx++) {
            const wo_rect tile = {tx * WO_TILE_WIDTH, ty * WO_TILE_HEIGHT, (tx + 1) * WO_TILE_WIDTH,
                                  (ty + 1) * WO_TILE_HEIGHT};
            float sums[WO_TILE_HEIGHT][WO_TILE_WIDTH][3] = {{{0}}};
            rays += wo_highlights_add(&highlights, &stack, &lens, tile, 1.17f, sums);
            for (int y = 0; y < WO_TILE_HEIGHT; y++)
                for (int x = 0; x < WO_TILE_WIDTH; x++) {
                    sum += (double)sums[y][x][1];
                    assert_true(sums[y][x][0] == 0 && sums[y][x][2] == 0);
                    const double d = hypot(tile.x1 + x - 15, tile.y1 + y - 9);
                    if (d < 11.2)
                        assert_true(sums[y][x][1] > 0);
                    if (d > 12.2)
                        assert_true(sums[y][x][1] == 0);
                }
        }
    assert_close(sum, 1000, 1e-5);
    assert_near((double)rays, 3.14159265 * 11.7 * 11.7, 25);
    wo_highlights_destroy(&plain, &highlights);
    wo_stack_destroy(&plain, &stack);
    wo_sheet_destroy(&plain, &sheet);
    wo_thin_pencils_destroy(&plain, &pencils);
}

/* A surface before the focus, beside the disc: rays of the disc's far side go through it, and it is
   not between the pixel and the highlight. */
static void what_is_near_hides_from_the_other_side(void **state)
{
    (void)state;
    wo_thin_pencils *pencils = pencils_make(10);
    const wo_lens lens = wo_thin_pencils_lens(pencils);
    wo_sheet sheets[2] = {sheet_make(-0.8f), sheet_make(0.8f)};
    for (int32_t i = 0; i < WIDTH * HEIGHT; i++)
        if (i % WIDTH + area.x1 < 10)
            sheets[1].v[i] = NAN;
    sheets[0].c[at(0, 0)][0] = 1004;
    wo_highlights highlights = take(sheets, 2, &lens);
    uint8_t opaque[WIDTH * HEIGHT];
    memset(opaque, 1, sizeof opaque);
    wo_stack stack;
    assert_int_equal(wo_stack_create(&plain, sheets, 2, opaque, area, area, &stack, NULL), WO_OK);
    float sums[WO_TILE_HEIGHT][WO_TILE_WIDTH][3] = {{{0}}};
    const wo_rect tile = {0, 0, WO_TILE_WIDTH, WO_TILE_HEIGHT};
    wo_highlights_add(&highlights, &stack, &lens, tile, 0.8f, sums);
    for (int x = 0; x < 8; x++)
        assert_int_equal(sums[0][x][0] > 0, x < 5);
    wo_highlights_destroy(&plain, &highlights);
    wo_stack_destroy(&plain, &stack);
    for (int i = 0; i < 2; i++)
        wo_sheet_destroy(&plain, &sheets[i]);
    wo_thin_pencils_destroy(&plain, &pencils);
}

static wo_highlights take_bounded(size_t max_bytes, const wo_lens *lens, wo_sheet sheets[2])
{
    wo_context context = plain;
    context.max_bytes = max_bytes;
    wo_highlights out;
    sheets[0] = sheet_make(-0.8f);
    sheets[1] = sheet_make(0.8f);
    for (int32_t i = 0; i < WIDTH * HEIGHT; i++)
        if (i % 7 < 5)
            sheets[1].v[i] = NAN;
    sheets[0].c[at(9, 3)][0] = 1004;
    sheets[0].c[at(31, 5)][1] = 504;
    sheets[0].v[at(31, 5)] = -0.3f; /* soft */
    assert_int_equal(wo_highlights_take(&context, sheets, 2, area, lens, &out, NULL), WO_OK);
    assert_int_equal(out.count, 2);
    return out;
}

/* Whether there is room to keep the images of highlights or not. */
static void the_same_without_room(void **state)
{
    (void)state;
    wo_thin_pencils *pencils = pencils_make(10);
    const wo_lens lens = wo_thin_pencils_lens(pencils);
    const wo_rect tile = {0, 0, WO_TILE_WIDTH, WO_TILE_HEIGHT};
    uint8_t opaque[WIDTH * HEIGHT];
    memset(opaque, 1, sizeof opaque);
    float sums[2][WO_TILE_HEIGHT][WO_TILE_WIDTH][3] = {{{{0}}}};
    int64_t rays[2];
    for (int i = 0; i < 2; i++) {
        wo_sheet sheets[2];
        wo_highlights highlights = take_bounded(i == 0 ? 0 : 1024, &lens, sheets);
        for (int k = 0; k < 2; k++)
            assert_int_equal(highlights.images[k].density != NULL, i == 0);
        wo_stack stack;
        assert_int_equal(wo_stack_create(&plain, sheets, 2, opaque, area, area, &stack, NULL),
                         WO_OK);
        rays[i] = wo_highlights_add(&highlights, &stack, &lens, tile, 0.8f, sums[i]);
        wo_highlights_destroy(&plain, &highlights);
        wo_stack_destroy(&plain, &stack);
        for (int k = 0; k < 2; k++)
            wo_sheet_destroy(&plain, &sheets[k]);
    }
    assert_true(rays[0] > 100);
    assert_int_equal(rays[0], rays[1]);
    assert_memory_equal(sums[0], sums[1], sizeof sums[0]);
    wo_thin_pencils_destroy(&plain, &pencils);
}

/* Many bright pixels together are an area of light and stay, also in the corner of the picture. */
static void areas_are_left_alone(void **state)
{
    (void)state;
    wo_thin_pencils *pencils = pencils_make(10);
    const wo_lens lens = wo_thin_pencils_lens(pencils);
    for (int part = 0; part < 3; part++) {
        wo_sheet sheet = sheet_make(0.7f);
        int64_t bright = 0;
        for (int32_t i = 0; i < WIDTH * HEIGHT; i++)
            if (part == 0 || (part == 1 && i % 4 == 0)) {
                sheet.c[i][0] = 50;
                bright++;
            }
        wo_highlights highlights = take(&sheet, 1, &lens);
        assert_int_equal(highlights.count, part == 0 ? 0 : bright);
        for (int32_t i = 0; i < WIDTH * HEIGHT; i++)
            assert_true(sheet.c[i][0] == (part == 0 ? 50 : part == 1 && i % 4 == 0 ? 4 : 0));
        wo_highlights_destroy(&plain, &highlights);
        wo_sheet_destroy(&plain, &sheet);
    }
    wo_thin_pencils_destroy(&plain, &pencils);
}

/* However large the blur, working out a light's share has an end. */
static void shares_are_cheap(void **state)
{
    (void)state;
    wo_thin_pencils *pencils = pencils_make(1000);
    counting c;
    const wo_lens lens = counting_lens(&c, pencils);
    wo_sheet sheet = sheet_make(2);
    sheet.c[at(3, 3)][0] = 1e6f;
    wo_highlights highlights = take(&sheet, 1, &lens);
    assert_int_equal(highlights.count, 1);
    assert_true(c.calls > 100000 && c.calls < 2000000);
    /* ... and comes out right: densities over all pixels make 1. */
    assert_close((double)highlights.list[0].c[0], 1e6 - 4, 1e-4);
    wo_highlights_destroy(&plain, &highlights);
    wo_sheet_destroy(&plain, &sheet);
    wo_thin_pencils_destroy(&plain, &pencils);
}

static void lenses_that_cannot_connect(void **state)
{
    (void)state;
    wo_thin_pencils *pencils = pencils_make(10);
    wo_lens lens = wo_thin_pencils_lens(pencils);
    lens.connect = NULL;
    wo_sheet sheet = sheet_make(1);
    sheet.c[at(3, 3)][0] = 1e6f;
    wo_highlights highlights = take(&sheet, 1, &lens);
    assert_int_equal(highlights.count, 0);
    assert_true(sheet.c[at(3, 3)][0] == 1e6f);
    wo_highlights_destroy(&plain, &highlights);
    wo_sheet_destroy(&plain, &sheet);
    wo_thin_pencils_destroy(&plain, &pencils);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_above_the_level_is_taken),
        cmocka_unit_test(all_light_arrives),
        cmocka_unit_test(what_is_near_hides_from_the_other_side),
        cmocka_unit_test(the_same_without_room),
        cmocka_unit_test(areas_are_left_alone),
        cmocka_unit_test(shares_are_cheap),
        cmocka_unit_test(lenses_that_cannot_connect),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
