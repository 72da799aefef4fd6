/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _XOPEN_SOURCE 700
#include "bridge_test.h"
#include "new_file.h"

static const char *const rgba[] = {"R", "G", "B", "A"};

static wo_io_part picture(int width, int height, int channels)
{
    const wo_rect window = {0, 0, width, height};
    wo_io_part part = {0};
    assert_ok(wo_io_part_init(&part, NULL, window, window, rgba, channels, &fault));
    return part;
}

/* Blocks of every size about that of their pixels, where noise does not compress. */
static void noise_is_not_mistaken(void **state)
{
    (void)state;
    static const char *const kinds[] = {"rle", "zips", "zip", "piz"};
    for (size_t kind = 0; kind < WO_COUNT(kinds); kind++)
        for (int i = 0; i < 120; i++) {
            wo_io_part part = picture(8 + i % 40, 4, 4);
            wo_io_file *file = NULL;
            const size_t samples = (size_t)wo_rect_width(part.data_window) * 16;
            for (size_t k = 0; k < samples; k++)
                part.pixels[k] = k % 4 == 3 && k / 4 % 4 != 1
                                     ? (float)(k / 4 % 4)
                                     : noise((uint32_t)(k * 7 + (size_t)i * 1000003));
            assert_ok(wo_io_part_set_text(&part, "compression", kinds[kind], &fault));
            assert_ok(wo_io_write(in_folder("a.exr"), &part, 1, WO_IO_SINGLE, &fault));
            assert_ok(wo_io_read(in_folder("a.exr"), false, &file, &fault));
            if (memcmp(file->parts->pixels, part.pixels, samples * sizeof(float)) != 0)
                fail_msg("%s, picture %d comes back as another", kinds[kind], i);
            wo_io_file_destroy(&file);
            wo_io_part_clear(&part);
        }
}

/* What a camera wrote goes into a directory of its own; the picture is to be found nevertheless. */
static void tiff_with_exif_is_readable(void **state)
{
    (void)state;
    wo_io_part part = picture(9, 5, 3);
    wo_io_file *file = NULL;
    fill_noise(&part, 0, 1);
    assert_ok(wo_io_part_set_number(&part, "FNumber", 2.8, &fault));
    assert_ok(wo_io_part_set_number(&part, "Exif:FocalLength", 50, &fault));
    free(part.colour_space);
    part.colour_space = strdup("sRGB");
    assert_ok(wo_io_write(in_folder("a.tif"), &part, 1, WO_IO_SINGLE, &fault));
    assert_ok(wo_io_read(in_folder("a.tif"), false, &file, &fault));
    assert_memory_equal(file->parts->pixels, part.pixels, 9 * 5 * 3 * sizeof(float));
    assert_string_equal(file->parts->colour_space, "sRGB");
    const wo_io_attribute *const stop = wo_io_part_find(file->parts, "FNumber");
    assert_non_null(stop);
    assert_float_equal((float)stop->number, 2.8f, 1e-6f);
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}

/* Of the two colours beside it that three bytes and an exponent hold, the nearer one. */
static void hdr_is_rounded(void **state)
{
    (void)state;
    enum { SIDE = 32 };
    wo_io_part part = picture(SIDE, SIDE, 3);
    wo_io_file *file = NULL;
    for (int i = 0; i < SIDE * SIDE * 3; i++)
        part.pixels[i] = noise((uint32_t)i) * powf(4, (float)(i / 3 % 12) - 6);
    assert_ok(wo_io_write(in_folder("a.hdr"), &part, 1, WO_IO_AUTO, &fault));
    assert_ok(wo_io_read(in_folder("a.hdr"), false, &file, &fault));
    for (int i = 0; i < SIDE * SIDE; i++) {
        const float *const wanted = part.pixels + 3 * (size_t)i;
        const float *const found = file->parts->pixels + 3 * (size_t)i;
        int exponent;
        (void)frexpf(fmaxf(found[0], fmaxf(found[1], found[2])), &exponent);
        for (int c = 0; c < 3; c++)
            if (!(fabsf(found[c] - wanted[c]) <= ldexpf(0.5f, exponent - 8) * 1.0001f))
                fail_msg("pixel %d: %.9g for %.9g", i, (double)found[c], (double)wanted[c]);
    }
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}

/* A wide picture, dark but for red above and green at the left: stored in all ways, seen in one. */
static void pictures_come_upright(void **state)
{
    (void)state;
    enum { W = 48, H = 32, EDGE = 8 };
    static const char *const names[] = {"a.jpg", "a.tif"};
    /* sides of the stored picture on which the upper and the left one are */
    static const char sides_of[9][3] = {"", "TL", "TR", "BR", "BL", "LT", "LB", "RB", "RT"};
    for (size_t n = 0; n < WO_COUNT(names); n++)
        for (int orientation = 1; orientation <= 8; orientation++) {
            const int w = orientation > 4 ? H : W, h = orientation > 4 ? W : H;
            const char *const sides = sides_of[orientation];
            wo_io_part part = picture(w, h, 3);
            for (int y = 0; y < h; y++)
                for (int x = 0; x < w; x++)
                    for (int side = 0; side < 2; side++)
                        if ((sides[side] == 'T' && y >= h - EDGE) ||
                            (sides[side] == 'B' && y < EDGE) || (sides[side] == 'L' && x < EDGE) ||
                            (sides[side] == 'R' && x >= w - EDGE))
                            *(sample_at(&part, x, y, side)) = 1;
            const wo_io_attribute said = {(char *)(uintptr_t) "Orientation", WO_IO_INT, orientation,
                                          NULL, (char *)(uintptr_t) ""};
            assert_ok(wo_io_part_set(&part, &said, &fault));
            assert_ok(wo_io_write(in_folder(names[n]), &part, 1, WO_IO_AUTO, &fault));
            wo_io_part_clear(&part);

            wo_io_file *file = NULL;
            assert_ok(wo_io_read(in_folder(names[n]), true, &file, &fault));
            assert_int_equal(wo_rect_width(file->parts->display_window), W);
            wo_io_file_destroy(&file);
            assert_ok(wo_io_read(in_folder(names[n]), false, &file, &fault));
            const wo_io_part *const seen = file->parts;
            assert_int_equal(wo_rect_width(seen->data_window), W);
            assert_int_equal(wo_rect_height(seen->data_window), H);
            for (int y = EDGE / 2; y < H; y += EDGE)
                for (int x = EDGE / 2; x < W; x += EDGE)
                    if (fabsf(*sample_at(seen, x, y, 0) - (y >= H - EDGE ? 1 : 0)) > 0.25f ||
                        fabsf(*sample_at(seen, x, y, 1) - (x < EDGE ? 1 : 0)) > 0.25f)
                        fail_msg("%s, orientation %d: %g %g at %d,%d", names[n], orientation,
                                 (double)*sample_at(seen, x, y, 0),
                                 (double)*sample_at(seen, x, y, 1), x, y);
            const wo_io_attribute *const now = wo_io_part_find(seen, "Orientation");
            assert_true(!now || (int)now->number == 1);
            wo_io_file_destroy(&file);
        }
}

static void save(const char *path)
{
    wo_io_part part = picture(2, 2, 3);
    assert_ok(wo_io_write(path, &part, 1, WO_IO_AUTO, &fault));
    wo_io_part_clear(&part);
}

static bool is_link(const char *name)
{
    struct stat about;
    return lstat(in_folder(name), &about) == 0 && S_ISLNK(about.st_mode);
}

/* A link stays one, whether something is at its end yet or not. */
static void links_are_followed(void **state)
{
    (void)state;
    struct stat about;
    assert_int_equal(symlink("middle", in_folder("first.exr")), 0);
    assert_int_equal(symlink(in_folder("last.exr"), in_folder("middle")), 0);
    for (int i = 0; i < 2; i++) {
        save(in_folder("first.exr"));
        assert_true(is_link("first.exr") && is_link("middle") && !is_link("last.exr"));
        assert_int_equal(count_files(false), 3);
        if (i == 0)
            assert_int_equal(chmod(in_folder("last.exr"), 0640), 0);
    }
    assert_int_equal(stat(in_folder("last.exr"), &about), 0);
    assert_int_equal(about.st_mode & 0777, 0640);

    wo_io_part part = picture(2, 2, 3);
    assert_int_equal(symlink("no-folder/x.exr", in_folder("nowhere.exr")), 0);
    assert_fault(wo_io_write(in_folder("nowhere.exr"), &part, 1, WO_IO_AUTO, &fault), WO_ERR_IO,
                 "nowhere.exr");
    assert_int_equal(symlink("round.exr", in_folder("round.exr")), 0);
    assert_fault(wo_io_write(in_folder("round.exr"), &part, 1, WO_IO_AUTO, &fault), WO_ERR_IO,
                 "round.exr");
    assert_true(is_link("nowhere.exr") && is_link("round.exr"));
    wo_io_part_clear(&part);
}

/* What a signal leaves: nothing half, and what was there. */
static void half_files_are_removed(void **state)
{
    (void)state;
    enum { MANY = 20 };
    wo_new_file files[MANY];
    save(in_folder("old.exr"));
    for (int i = 0; i < MANY; i++)
        assert_ok(wo_new_file_begin(in_folder("old.exr"), &files[i], &fault));
    assert_int_equal(count_files(false), 1 + MANY);
    wo_new_file_remove_all();
    assert_int_equal(count_files(false), 1 + MANY - 16); /* as many as are remembered */
    for (int i = 0; i < MANY; i++)
        assert_int_equal(wo_new_file_end(&files[i], WO_ABORTED, &fault), WO_ABORTED);
    assert_int_equal(count_files(false), 1);
    /* places are free again */
    assert_ok(wo_new_file_begin(in_folder("old.exr"), &files[0], &fault));
    wo_new_file_remove_all();
    assert_int_equal(count_files(false), 1);
    assert_int_equal(wo_new_file_end(&files[0], WO_OK, &fault), WO_ERR_IO);
}

#define TEST(name) cmocka_unit_test_setup(name, empty_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(noise_is_not_mistaken), TEST(tiff_with_exif_is_readable), TEST(hdr_is_rounded),
        TEST(pictures_come_upright), TEST(links_are_followed),         TEST(half_files_are_removed),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
