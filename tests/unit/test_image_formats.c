/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "bridge_test.h"

#include <locale.h>

static const char *const rgba[] = {"R", "G", "B", "A"};
static const char *const grey[] = {"Y", "A"};

static wo_io_part plain_part(wo_rect data, wo_rect display, int channels)
{
    wo_io_part part = {0};
    const char *const *const names = channels < 3 ? grey : rgba;
    assert_ok(wo_io_part_init(&part, NULL, data, display, names, channels, &fault));
    return part;
}

/* Every format keeps orientation, channel order and values to its own precision. */
static void formats_round_trip(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        wo_io_depth depth;
        int channels, back, bits;
        double tolerance;
    } cases[] = {
        {"a.png", WO_IO_AUTO, 3, 3, 8, 0.5 / 255},
        {"a.png", WO_IO_AUTO, 4, 4, 8, 0.5 / 255},
        {"a.png", WO_IO_AUTO, 1, 1, 8, 0.5 / 255},
        {"a.png", WO_IO_AUTO, 2, 2, 8, 0.5 / 255},
        {"a.png", WO_IO_SHORT, 4, 4, 16, 0.5 / 65535},
        {"a.png", WO_IO_BYTE, 4, 4, 8, 0.5 / 255},
        {"a.tif", WO_IO_AUTO, 4, 4, 16, 0.5 / 65535},
        {"a.tif", WO_IO_BYTE, 3, 3, 8, 0.5 / 255},
        {"a.tiff", WO_IO_SINGLE, 4, 4, 32, 0},
        {"a.tif", WO_IO_SINGLE, 1, 1, 32, 0},
        {"a.dpx", WO_IO_AUTO, 3, 3, 10, 0.51 / 1023},
        {"a.dpx", WO_IO_SHORT, 4, 4, 16, 0.5 / 65535},
        {"a.dpx", WO_IO_BYTE, 3, 3, 8, 0.5 / 255},
        {"a.dpx", WO_IO_AUTO, 1, 1, 10, 0.51 / 1023},
        {"a.hdr", WO_IO_AUTO, 3, 3, 32, 0.005},
        {"a.tga", WO_IO_AUTO, 4, 4, 8, 0.5 / 255},
        {"a.tga", WO_IO_AUTO, 3, 3, 8, 0.5 / 255},
        {"a.bmp", WO_IO_AUTO, 3, 3, 8, 0.5 / 255},
        {"a.ppm", WO_IO_AUTO, 3, 3, 8, 0.5 / 255},
        {"a.tif", WO_IO_SHORT, 3, 3, 16, 0.5 / 65535},
        {"a.jpg", WO_IO_AUTO, 3, 3, 8, 0.06},
        {"A.JPEG", WO_IO_AUTO, 1, 1, 8, 0.03},
        {"a.jpg", WO_IO_AUTO, 4, 3, 8, 0.06},
        {"a.bmp", WO_IO_AUTO, 4, 3, 8, 0.5 / 255},
        {"a.hdr", WO_IO_AUTO, 1, 3, 32, 0.005},
    };
    const wo_rect frame = {0, 0, 33, 17};
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_io_part part = plain_part(frame, frame, cases[i].channels);
        wo_io_file *file = NULL;
        for (int y = 0; y < 17; y++)
            for (int x = 0; x < 33; x++)
                for (int c = 0; c < cases[i].channels; c++)
                    *sample_at(&part, x, y, c) = c == 1   ? (float)y / 16
                                                 : c == 3 ? 1 - (float)x / 64
                                                          : (float)x / 32;
        assert_ok(wo_io_write(in_folder(cases[i].name), &part, 1, cases[i].depth, &fault));
        assert_ok(wo_io_read(in_folder(cases[i].name), false, &file, &fault));
        const wo_io_part *const back = &file->parts[0];
        if (back->channels != cases[i].back || back->bits != cases[i].bits)
            fail_msg("%s %zu: %d channels, %d bits", cases[i].name, i, back->channels, back->bits);
        assert_true(wo_rect_equal(back->data_window, frame));
        assert_true(wo_rect_equal(back->display_window, frame));
        for (int y = 0; y < 17; y++)
            for (int x = 0; x < 33; x++)
                for (int c = 0; c < back->channels; c++) {
                    const float was = *sample_at(&part, x, y, c < part.channels ? c : 0);
                    const float is = *sample_at(back, x, y, c);
                    if (!(fabs((double)is - (double)was) <= cases[i].tolerance + 1e-7))
                        fail_msg("%s %zu at %d %d channel %d: %g instead of %g", cases[i].name, i,
                                 x, y, c, (double)is, (double)was);
                }
        assert_int_equal(back->is_float, cases[i].bits == 32);
        wo_io_file_destroy(&file);
        wo_io_part_clear(&part);
        assert_int_equal(count_files(true), 1);
    }
}

/* A fine ramp lands on the nearest of the steps. */
static void integers_are_rounded(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        wo_io_depth depth;
        double steps, slack; /* slack: the library's own widening of 10 bits to 16 */
    } cases[] = {{"a.png", WO_IO_BYTE, 255, 1e-6},    {"a.png", WO_IO_SHORT, 65535, 1e-6},
                 {"a.tif", WO_IO_BYTE, 255, 1e-6},    {"a.dpx", WO_IO_AUTO, 1023, 0.016},
                 {"a.dpx", WO_IO_SHORT, 65535, 1e-6}, {"a.tga", WO_IO_BYTE, 255, 1e-6}};
    const wo_rect frame = {0, 0, 500, 20};
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_io_part part = plain_part(frame, frame, 3);
        wo_io_file *file = NULL;
        for (int k = 0; k < 30000; k++)
            part.pixels[k] = (float)k / 29999;
        assert_ok(wo_io_write(in_folder(cases[i].name), &part, 1, cases[i].depth, &fault));
        assert_ok(wo_io_read(in_folder(cases[i].name), false, &file, &fault));
        for (int k = 0; k < 30000; k++) {
            const double was = (double)part.pixels[k] * cases[i].steps;
            const double is = (double)file->parts[0].pixels[k] * cases[i].steps;
            if (!(fabs(is - was) <= 0.501 + cases[i].slack + was * 2e-7))
                fail_msg("%s: step %g instead of %g", cases[i].name, is, was);
        }
        wo_io_file_destroy(&file);
        wo_io_part_clear(&part);
    }
}

static void integers_are_clipped(void **state)
{
    (void)state;
    static const char *const names[] = {"a.png", "a.tif", "a.dpx", "a.tga"};
    static const float given[8] = {-1, -0.0f, 1, 1.5f, INFINITY, -INFINITY, NAN, 1e30f};
    static const float wanted[8] = {0, 0, 1, 1, 1, 0, 0, 1};
    const wo_rect frame = {0, 0, 8, 1};
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        wo_io_part part = plain_part(frame, frame, 3);
        wo_io_file *file = NULL;
        for (int k = 0; k < 24; k++)
            part.pixels[k] = given[k / 3];
        assert_ok(wo_io_write(in_folder(names[i]), &part, 1, WO_IO_AUTO, &fault));
        assert_ok(wo_io_read(in_folder(names[i]), false, &file, &fault));
        for (int k = 0; k < 24; k++)
            assert_float_equal(file->parts[0].pixels[k], wanted[k / 3], 0);
        wo_io_file_destroy(&file);
        wo_io_part_clear(&part);
    }
}

/* Nothing multiplies or divides colour by alpha on its way. */
static void alpha_stays_as_stored(void **state)
{
    (void)state;
    static const char *const names[] = {"a.png", "a.tga", "a.tif"};
    const wo_rect frame = {0, 0, 2, 1};
    static const float given[8] = {1, 0.2f, 0, 0.4f, 0.8f, 0.6f, 0.4f, 0};
    for (size_t i = 0; i < WO_COUNT(names); i++)
        for (int marked = 0; marked < 2; marked++) {
            wo_io_part part = plain_part(frame, frame, 4);
            wo_io_file *file = NULL;
            memcpy(part.pixels, given, sizeof given);
            if (marked)
                assert_ok(wo_io_part_set_number(&part, "oiio:UnassociatedAlpha", 1, &fault));
            assert_ok(wo_io_write(in_folder(names[i]), &part, 1, WO_IO_BYTE, &fault));
            assert_ok(wo_io_read(in_folder(names[i]), false, &file, &fault));
            for (int k = 0; k < 8; k++)
                assert_float_equal(file->parts[0].pixels[k], given[k], 1e-6f);
            const wo_io_attribute *const separate =
                wo_io_part_find(&file->parts[0], "oiio:UnassociatedAlpha");
            const bool said = separate && separate->number == 1;
            if (said != (i < 2 || marked))
                fail_msg("%s says %d", names[i], said);
            wo_io_file_destroy(&file);
            wo_io_part_clear(&part);
        }
}

static void alpha_multiplies(void **state)
{
    (void)state;
    float pixels[12] = {1, 0.5f, 0.25f, 0.5f, 1, 2, 3, 0, 4, 5, 6, 1};
    wo_image image = {
        .data = pixels, .bounds = {0, 0, 3, 1}, .row_bytes = sizeof pixels, .components = 4};
    static const float once[12] = {0.5f, 0.25f, 0.125f, 0.5f, 0, 0, 0, 0, 4, 5, 6, 1};
    static const float again[12] = {1, 0.5f, 0.25f, 0.5f, 0, 0, 0, 0, 4, 5, 6, 1};
    wo_io_premultiply(&image);
    assert_memory_equal(pixels, once, sizeof once);
    wo_io_unpremultiply(&image);
    assert_memory_equal(pixels, again, sizeof again);
    image.components = 3;
    image.bounds.x2 = 4;
    wo_io_premultiply(&image);
    assert_memory_equal(pixels, again, sizeof again);
}

/* Formats without windows show the display window. */
static void windows_are_cut_and_filled(void **state)
{
    (void)state;
    const wo_rect display = {0, 0, 10, 8}, data = {-2, 3, 6, 20};
    wo_io_part part = plain_part(data, display, 3);
    wo_io_file *file = NULL;
    for (int y = data.y1; y < data.y2; y++)
        for (int x = data.x1; x < data.x2; x++)
            for (int c = 0; c < 3; c++)
                *sample_at(&part, x, y, c) = 0.25f + (float)(x + 2 * y + c) / 128;
    assert_ok(wo_io_write(in_folder("a.tif"), &part, 1, WO_IO_SINGLE, &fault));
    assert_ok(wo_io_read(in_folder("a.tif"), false, &file, &fault));
    assert_true(wo_rect_equal(file->parts[0].data_window, display));
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 10; x++)
            for (int c = 0; c < 3; c++) {
                const bool known = x < 6 && y >= 3;
                assert_float_equal(*sample_at(&file->parts[0], x, y, c),
                                   (known ? *sample_at(&part, x, y, c) : 0), 0);
            }
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}

static void requests_that_cannot_be(void **state)
{
    (void)state;
    const wo_rect frame = {0, 0, 4, 4};
    static const char *const five[] = {"R", "G", "B", "A", "Z"};
    wo_io_part part = plain_part(frame, frame, 3), parts[2], wide = {0}, empty = {0};
    assert_ok(wo_io_part_init(&wide, NULL, frame, frame, five, 5, &fault));
    parts[0] = parts[1] = part;
#define REFUSED(name, from, count, depth, status, words)                                           \
    assert_fault(wo_io_write(name, from, count, depth, &fault), status, words)
    REFUSED(in_folder("a.png"), parts, 2, WO_IO_AUTO, WO_ERR_UNSUPPORTED, "2 parts need EXR");
    REFUSED(in_folder("a.png"), &wide, 1, WO_IO_AUTO, WO_ERR_UNSUPPORTED, "5 channels need EXR");
    REFUSED(in_folder("a.png"), &part, 1, WO_IO_SINGLE, WO_ERR_UNSUPPORTED,
            "of png are 8 or 16 only");
    REFUSED(in_folder("a.jpg"), &part, 1, WO_IO_SHORT, WO_ERR_UNSUPPORTED, "of jpg are 8 only");
    REFUSED(in_folder("a.tif"), &part, 1, WO_IO_HALF, WO_ERR_UNSUPPORTED,
            "of tif are 8 or 16 or float only");
    REFUSED(in_folder("a.exr"), &part, 1, WO_IO_BYTE, WO_ERR_UNSUPPORTED, "half or float");
    REFUSED(in_folder("a.webp"), &part, 1, WO_IO_AUTO, WO_ERR_UNSUPPORTED, "extension is none of");
    REFUSED(in_folder("exr"), &part, 1, WO_IO_AUTO, WO_ERR_UNSUPPORTED, "extension is none of");
    REFUSED(in_folder("a.exr"), &empty, 1, WO_IO_AUTO, WO_ERR_ARGUMENT, "without pixels");
    REFUSED(in_folder("a.exr"), &part, 0, WO_IO_AUTO, WO_ERR_ARGUMENT, "0 parts");
    REFUSED("", &part, 1, WO_IO_AUTO, WO_ERR_ARGUMENT, "no file name");
    REFUSED(NULL, &part, 1, WO_IO_AUTO, WO_ERR_ARGUMENT, "no file name");
    part.data_window.x2 = 100000;
    REFUSED(in_folder("a.exr"), &part, 1, WO_IO_AUTO, WO_ERR_RANGE, "100000 x 4");
    assert_int_equal(count_files(false), 0);
    part.data_window = frame;
    wo_io_part_clear(&part);
    wo_io_part_clear(&wide);

    const wo_rect huge = {0, 0, 65536, 65536};
    wo_io_file *file = NULL;
    assert_fault(wo_io_part_init(&part, NULL, huge, huge, five, 5, &fault), WO_ERR_RANGE, "GiB");
    assert_fault(wo_io_part_init(&part, NULL, frame, frame, five, 0, &fault), WO_ERR_RANGE,
                 "0 channels");
    assert_fault(wo_io_part_init(&part, NULL, (wo_rect){5, 5, 5, 9}, frame, five, 1, &fault),
                 WO_ERR_RANGE, "0 x 4");
    assert_null(part.channel_names);
    assert_fault(wo_io_file_create(0, &file, &fault), WO_ERR_RANGE, "0 parts");
    assert_null(file);
}

/* A file of two parts with many layers, to choose from. */
static wo_io_file *layered_file(void)
{
    static const char *const first[] = {"R",
                                        "G",
                                        "B",
                                        "A",
                                        "Z",
                                        "diffuse.R",
                                        "diffuse.G",
                                        "diffuse.B",
                                        "N.X",
                                        "N.Y",
                                        "N.Z",
                                        "id",
                                        "uv.u",
                                        "uv.v",
                                        "View.Combined.R",
                                        "View.Combined.G",
                                        "View.Combined.B",
                                        "View.Combined.A",
                                        "depth.Z"};
    static const char *const second[] = {"Z"};
    const wo_rect frame = {0, 0, 3, 2}, inner = {1, 0, 3, 2};
    wo_io_file *file = NULL;
    assert_ok(wo_io_file_create(2, &file, &fault));
    assert_ok(
        wo_io_part_init(&file->parts[0], "beauty", frame, frame, first, WO_COUNT(first), &fault));
    assert_ok(wo_io_part_init(&file->parts[1], "far:away", inner, frame, second, 1, &fault));
    for (int i = 0; i < 6 * (int)WO_COUNT(first); i++)
        file->parts[0].pixels[i] = (float)(i % (int)WO_COUNT(first));
    for (int i = 0; i < 4; i++)
        file->parts[1].pixels[i] = 100;
    return file;
}

static void channels_are_chosen(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        int part, count, channels[4];
    } cases[] = {
        {"", 0, 4, {0, 1, 2, 3}},
        {"Z", 0, 1, {4}},
        {"z", 0, 1, {4}},
        {"R,G,B", 0, 3, {0, 1, 2}},
        {"B,Z,R", 0, 3, {2, 4, 0}},
        {"diffuse.B", 0, 1, {7}},
        {"diffuse", 0, 3, {5, 6, 7}},
        {"DIFFUSE", 0, 3, {5, 6, 7}},
        {"N", 0, 3, {8, 9, 10}},
        {"id", 0, 1, {11}},
        {"depth", 0, 1, {18}},
        {"Combined", 0, 4, {14, 15, 16, 17}},
        {"View.Combined", 0, 4, {14, 15, 16, 17}},
        {"beauty", 0, 4, {0, 1, 2, 3}},
        {"beauty:Z", 0, 1, {4}},
        {"beauty:diffuse", 0, 3, {5, 6, 7}},
        {"beauty:", 0, 4, {0, 1, 2, 3}},
        {"far:away", 1, 1, {100}},
        {"far:away:Z", 1, 1, {100}},
        {"rgb", 0, 3, {0, 1, 2}},
        {"rgba", 0, 4, {0, 1, 2, 3}},
    };
    wo_io_file *file = layered_file();
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_image image;
        const wo_io_part *part = NULL;
        assert_ok(wo_io_select(file, cases[i].words, &image, &part, &fault));
        if (part != &file->parts[cases[i].part] || image.components != cases[i].count)
            fail_msg("'%s' gives %d components", cases[i].words, (int)image.components);
        assert_true(wo_rect_equal(image.bounds, part->data_window));
        for (int y = image.bounds.y1; y < image.bounds.y2; y++)
            for (int x = image.bounds.x1; x < image.bounds.x2; x++)
                for (int c = 0; c < cases[i].count; c++)
                    assert_float_equal(wo_image_at(&image, x, y)[c], cases[i].channels[c], 0);
        free(image.data);
    }
    wo_io_file_destroy(&file);
}

static void unknown_channels_are_explained(void **state)
{
    (void)state;
    static const char *const words[] = {"Q",    "R,Q", "beauty:Q", "far:away:R", ",",
                                        "R,,B", "R,",  ":",        "nobody:Z",   "0"};
    wo_io_file *file = layered_file();
    wo_image image;
    for (size_t i = 0; i < WO_COUNT(words); i++) {
        assert_fault(wo_io_select(file, words[i], &image, NULL, &fault), WO_ERR_NOT_FOUND,
                     "among beauty: R G B A Z diffuse.R");
        assert_non_null(strstr(fault.text, words[i]));
        assert_null(image.data);
    }
    assert_fault(wo_io_select(file, "R,G", &image, NULL, &fault), WO_ERR_UNSUPPORTED,
                 "choose 1, 3 or 4");
    assert_fault(wo_io_select(file, "R,G,B,A,Z", &image, NULL, &fault), WO_ERR_UNSUPPORTED,
                 "choose 1, 3 or 4");
    assert_fault(wo_io_select(file, "uv", &image, NULL, &fault), WO_ERR_NOT_FOUND, "'uv'");
    wo_io_file_destroy(&file);
}

/* What a file shows by itself, whatever its channels are called. */
static void defaults_are_sensible(void **state)
{
    (void)state;
    static const struct {
        const char *names[5];
        int count, wanted, first;
    } cases[] = {
        {{"Y"}, 1, 1, 0},
        {{"Y", "A"}, 2, 4, 0},
        {{"Z"}, 1, 1, 0},
        {{"mask"}, 1, 1, 0},
        {{"A"}, 1, 1, 0},
        {{"depth.Z"}, 1, 1, 0},
        {{"Z", "r", "g", "b"}, 4, 3, 1},
        {{"red", "green", "blue", "alpha"}, 4, 4, 0},
        {{"X", "Y", "Z"}, 3, 3, 0},
        {{"L.Depth.Z", "L.Combined.R", "L.Combined.G", "L.Combined.B"}, 4, 3, 1},
    };
    const wo_rect frame = {0, 0, 1, 1};
    wo_image image;
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        wo_io_file *file = NULL;
        assert_ok(wo_io_file_create(1, &file, &fault));
        assert_ok(wo_io_part_init(file->parts, NULL, frame, frame, cases[i].names, cases[i].count,
                                  &fault));
        for (int c = 0; c < cases[i].count; c++)
            file->parts[0].pixels[c] = (float)c;
        assert_ok(wo_io_select(file, NULL, &image, NULL, &fault));
        if (image.components != cases[i].wanted || image.data[0] != (float)cases[i].first)
            fail_msg("case %zu: %d components from %g", i, image.components, (double)image.data[0]);
        free(image.data);
        assert_ok(wo_io_select(file, "0", &image, NULL, &fault)); /* a part without a name */
        free(image.data);
        wo_io_file_destroy(&file);
    }
    static const char *const odd[] = {"u", "v"};
    wo_io_file *file = NULL;
    assert_ok(wo_io_file_create(1, &file, &fault));
    assert_ok(wo_io_part_init(file->parts, NULL, frame, frame, odd, 2, &fault));
    assert_fault(wo_io_select(file, "", &image, NULL, &fault), WO_ERR_NOT_FOUND, "among u v");
    wo_io_file_destroy(&file);
}

static void long_lists_are_cut(void **state)
{
    (void)state;
    enum { COUNT = 200 };
    static char text[COUNT][16];
    const char *names[COUNT];
    const wo_rect frame = {0, 0, 1, 1};
    wo_io_file *file = NULL;
    wo_image image;
    for (int i = 0; i < COUNT; i++) {
        snprintf(text[i], sizeof text[i], "c%03d", i);
        names[i] = text[i];
    }
    assert_ok(wo_io_file_create(1, &file, &fault));
    assert_ok(wo_io_part_init(file->parts, NULL, frame, frame, names, COUNT, &fault));
    assert_fault(wo_io_select(file, "nothing", &image, NULL, &fault), WO_ERR_NOT_FOUND,
                 "c000 c001 c002");
    assert_string_equal(fault.text + strlen(fault.text) - 4, " ...");
    assert_true(strlen(fault.text) < sizeof fault.text - 1);
    wo_io_file_destroy(&file);
}

static void frames_make_paths(void **state)
{
    (void)state;
    static const struct {
        const char *pattern;
        int frame;
        const char *wanted;
        bool sequence;
    } cases[] = {
        {"a.%04d.exr", 7, "a.0007.exr", true},
        {"a.####.exr", 1001, "a.1001.exr", true},
        {"a.%d.exr", 12, "a.12.exr", true},
        {"a.##.exr", 123, "a.123.exr", true},
        {"a.%4d.exr", 7, "a.7.exr", true},
        {"a.%04d.exr", -5, "a.-005.exr", true},
        {"a.exr", 7, "a.exr", false},
        {"a#1.exr", 7, "a#1.exr", false},
        {"100%.exr", 7, "100%.exr", false},
        {"a%s.exr", 7, "a%s.exr", false},
        {"%n%04d%x", 7, "%n0007%x", true},
        {"%03d/a.###.exr", 7, "007/a.007.exr", true},
        {"a.%012d.exr", 7, "a.%012d.exr", false},
        {"", 7, "", false},
        {"%", 1, "%", false},
        {"a.%04d", 2147483647, "a.2147483647", true},
    };
    char path[64];
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        assert_ok(wo_io_frame_path(cases[i].pattern, cases[i].frame, path, sizeof path, &fault));
        assert_string_equal(path, cases[i].wanted);
        assert_int_equal(wo_io_is_sequence(cases[i].pattern), cases[i].sequence);
    }
    assert_false(wo_io_is_sequence(NULL));
    assert_ok(wo_io_frame_path("a.####", 7, path, 7, &fault));
    assert_fault(wo_io_frame_path("a.####", 7, path, 6, &fault), WO_ERR_RANGE, "longer than 6");
}

#ifdef __GLIBC__
/* A locale with a decimal comma, made here because none need be installed: the file of LC_NUMERIC
   is a number for the kind, the number of its entries, their places, and the entries. */
static void use_decimal_comma(void)
{
    static const uint32_t head[8] = {0x20031114, 6, 32, 34, 35, 36, 40, 44};
    static const char entries[18] = ",\0\0\0"
                                    ",\0\0\0"
                                    "\0\0\0\0"
                                    "UTF-8";
    char bytes[sizeof head + sizeof entries];
    memcpy(bytes, head, sizeof head);
    memcpy(bytes + sizeof head, entries, sizeof entries);
    assert_int_equal(mkdir(in_folder("comma"), 0700), 0);
    write_bytes(in_folder("comma/LC_NUMERIC"), bytes, sizeof bytes);
    setenv("LOCPATH", test_folder, 1);
    assert_non_null(setlocale(LC_NUMERIC, "comma"));
    unsetenv("LOCPATH");
    unlink(in_folder("comma/LC_NUMERIC"));
    rmdir(in_folder("comma"));
}

/* Numbers in headers do not depend on the program's decimal point. */
static void locales_do_not_matter(void **state)
{
    (void)state;
    char text[32], numbers[] = "0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329";
    char name[] = "chromaticities";
    const wo_rect frame = {0, 0, 4, 4};
    wo_io_part part = plain_part(frame, frame, 3);
    wo_io_file *file = NULL;
    const wo_io_attribute primaries = {
        .name = name, .type = WO_IO_TEXT, .text = numbers, .kind = name};
    use_decimal_comma();
    assert_ok(wo_io_part_set(&part, &primaries, &fault));
    assert_ok(wo_io_write(in_folder("a.exr"), &part, 1, WO_IO_AUTO, &fault));
    assert_ok(wo_io_read(in_folder("a.exr"), true, &file, &fault));
    snprintf(text, sizeof text, "%g", 0.5);
    setlocale(LC_ALL, "C");
    assert_string_equal(text, "0,5"); /* the comma was in force, and still was afterwards */
    assert_string_equal(wo_io_part_find(file->parts, "chromaticities")->text, numbers);
    wo_io_file_destroy(&file);
    assert_ok(wo_io_read(in_folder("a.exr"), true, &file, &fault));
    assert_string_equal(wo_io_part_find(file->parts, "chromaticities")->text, numbers);
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}
#endif

int main(void)
{
#define TEST(name) cmocka_unit_test_setup(name, empty_folder)
    const struct CMUnitTest tests[] = {
        TEST(formats_round_trip),
        TEST(integers_are_rounded),
        TEST(integers_are_clipped),
        TEST(alpha_stays_as_stored),
        TEST(alpha_multiplies),
        TEST(windows_are_cut_and_filled),
        TEST(requests_that_cannot_be),
        TEST(channels_are_chosen),
        TEST(unknown_channels_are_explained),
        TEST(defaults_are_sensible),
        TEST(long_lists_are_cut),
        TEST(frames_make_paths),
#ifdef __GLIBC__
        TEST(locales_do_not_matter),
#endif
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
