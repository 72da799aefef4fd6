/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "bridge_test.h"

#include "exr_samples.h"

#include <pthread.h>

static const char *const rgba[] = {"R", "G", "B", "A"};
static const char *const rgbaz[] = {"R", "G", "B", "A", "Z"};

/* A part of its own, filled with noise. */
static wo_io_part noisy_part(const char *name, wo_rect data, wo_rect display,
                             const char *const *names, int channels)
{
    wo_io_part part = {0};
    assert_ok(wo_io_part_init(&part, name, data, display, names, channels, &fault));
    fill_noise(&part, -2.0f, 3.0f);
    return part;
}

static wo_io_file *write_and_read(const char *name, const wo_io_part *parts, size_t count,
                                  wo_io_depth depth)
{
    wo_io_file *file = NULL;
    assert_ok(wo_io_write(in_folder(name), parts, count, depth, &fault));
    assert_ok(wo_io_read(in_folder(name), false, &file, &fault));
    assert_int_equal(file->part_count, count);
    return file;
}

/* Largest difference of two parts of the same shape. */
static double difference(const wo_io_part *a, const wo_io_part *b)
{
    double largest = 0;
    assert_true(wo_rect_equal(a->data_window, b->data_window));
    assert_true(wo_rect_equal(a->display_window, b->display_window));
    assert_int_equal(a->channels, b->channels);
    const size_t count = (size_t)wo_rect_width(a->data_window) *
                         (size_t)wo_rect_height(a->data_window) * (size_t)a->channels;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs((double)a->pixels[i] - (double)b->pixels[i]));
    return largest;
}

static void exr_float_is_exact(void **state)
{
    (void)state;
    const wo_rect frame = {0, 0, 37, 23};
    wo_io_part part = noisy_part("", frame, frame, rgbaz, 5);
    part.pixels[0] = INFINITY;
    part.pixels[1] = 1e30f;
    wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_SINGLE);
    const wo_io_part *const back = &file->parts[0];
    assert_string_equal(file->format, "openexr");
    assert_int_equal(back->bits, 32);
    assert_true(back->is_float);
    for (int i = 0; i < 5; i++)
        assert_string_equal(back->channel_names[i], rgbaz[i]);
    assert_memory_equal(back->pixels, part.pixels, 37 * 23 * 5 * sizeof(float));
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}

static void exr_auto_is_half_colour_and_float_depth(void **state)
{
    (void)state;
    const wo_rect frame = {0, 0, 40, 35};
    wo_io_part part = noisy_part("", frame, frame, rgbaz, 5);
    wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_AUTO);
    double colour = 0;
    for (int y = 0; y < 35; y++)
        for (int x = 0; x < 40; x++) {
            for (int c = 0; c < 4; c++) {
                const float was = *sample_at(&part, x, y, c);
                const float is = *sample_at(&file->parts[0], x, y, c);
                assert_true(fabsf(is - was) <= fabsf(was) / 2048 + 0x1p-25f);
                colour += is != was;
            }
            assert_true(*sample_at(&part, x, y, 4) == *sample_at(&file->parts[0], x, y, 4));
        }
    assert_true(colour > 1000);
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}

static void half_has_no_infinities(void **state)
{
    (void)state;
    const wo_rect frame = {0, 0, 11, 1};
    static const float given[11] = {65504, 65519, 65520,         1e9f,  INFINITY, -INFINITY,
                                    -7e4f, 1e-9f, 5.9604645e-8f, -0.0f, 6.1e-5f};
    static const float wanted[11] = {65504,  65504, 65504,         65504, 65504,  -65504,
                                     -65504, 0,     5.9604645e-8f, -0.0f, 6.1e-5f};
    wo_io_part part = noisy_part("", frame, frame, rgba, 1);
    memcpy(part.pixels, given, sizeof given);
    wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_HALF);
    for (int i = 0; i < 11; i++)
        assert_float_equal(file->parts[0].pixels[i], wanted[i], fabsf(wanted[i]) / 2048);
    wo_io_file_destroy(&file);
    part.pixels[0] = NAN;
    file = write_and_read("a.exr", &part, 1, WO_IO_HALF);
    assert_true(isnan(file->parts[0].pixels[0]));
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}

/* Every finite half comes back as the same bits: 65504 values a sign. */
static void all_halves_survive(void **state)
{
    (void)state;
    const wo_rect frame = {0, 0, 248, 256};
    wo_io_part part = noisy_part("", frame, frame, rgba, 1);
    size_t count = 0;
    for (int sign = -1; sign <= 1; sign += 2)
        for (int exponent = 0; exponent < 31; exponent++)
            for (int mantissa = 0; mantissa < 1024; mantissa++) {
                const double magnitude =
                    exponent == 0 ? ldexp(mantissa, -24) : ldexp(1024 + mantissa, exponent - 25);
                part.pixels[count++] = (float)(sign * magnitude);
            }
    assert_int_equal(count, 248 * 256);
    wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_HALF);
    assert_memory_equal(file->parts[0].pixels, part.pixels, count * sizeof(float));
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}

static void windows_keep_their_place(void **state)
{
    (void)state;
    static const wo_rect data[] = {{-7, -3, 12, 9}, {5, 6, 8, 40}, {90, 60, 120, 77}, {0, 0, 1, 1}};
    const wo_rect display = {0, 0, 100, 64};
    for (size_t i = 0; i < WO_COUNT(data); i++) {
        wo_io_part part = noisy_part("", data[i], display, rgba, 3);
        part.pixel_aspect = 2;
        wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_SINGLE);
        assert_true(difference(&file->parts[0], &part) == 0);
        assert_float_equal(file->parts[0].pixel_aspect, 2, 0);
        wo_io_file_destroy(&file);
        wo_io_part_clear(&part);
    }
}

/* Windows count from the display window's corner, whatever numbers that has. */
static void display_window_is_the_origin(void **state)
{
    (void)state;
    const wo_rect display = {10, 20, 110, 84}, data = {13, 25, 40, 61};
    wo_io_part part = noisy_part("", data, display, rgba, 4);
    wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_SINGLE);
    const wo_rect got = file->parts[0].data_window;
    assert_true(wo_rect_equal(got, (wo_rect){3, 5, 30, 41}));
    assert_true(wo_rect_equal(file->parts[0].display_window, (wo_rect){0, 0, 100, 64}));
    assert_memory_equal(file->parts[0].pixels, part.pixels, 27 * 36 * 4 * sizeof(float));
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}

static void many_parts(void **state)
{
    (void)state;
    static const char *const layer[] = {"diffuse.R", "diffuse.G", "diffuse.B"};
    static const char *const depth[] = {"Z"};
    const wo_rect frame = {0, 0, 30, 20};
    wo_io_part parts[3] = {noisy_part("beauty", frame, frame, rgba, 4),
                           noisy_part("light", (wo_rect){2, 3, 29, 20}, frame, layer, 3),
                           noisy_part("depth", (wo_rect){-4, 0, 30, 50}, frame, depth, 1)};
    wo_io_file *file = write_and_read("a.exr", parts, 3, WO_IO_SINGLE);
    for (int i = 0; i < 3; i++) {
        assert_string_equal(file->parts[i].name, parts[i].name);
        assert_true(difference(&file->parts[i], &parts[i]) == 0);
    }
    wo_io_file_destroy(&file);

    free(parts[2].name);
    parts[2].name = strdup("light");
    assert_fault(wo_io_write(in_folder("b.exr"), parts, 3, WO_IO_AUTO, &fault), WO_ERR_ARGUMENT,
                 "two parts are called light");
    parts[2].name[0] = '\0';
    assert_fault(wo_io_write(in_folder("b.exr"), parts, 3, WO_IO_AUTO, &fault), WO_ERR_ARGUMENT,
                 "needs a name");
    for (int i = 0; i < 3; i++)
        wo_io_part_clear(&parts[i]);
    assert_int_equal(count_files(false), 1);
}

static void many_channels(void **state)
{
    (void)state;
    enum { COUNT = 300 };
    static char text[COUNT][80];
    const char *names[COUNT];
    for (int i = 0; i < COUNT; i++) {
        snprintf(text[i], sizeof text[i], "a_layer_with_quite_a_long_name_%03d.%c", i / 3,
                 "RGB"[i % 3]);
        names[i] = text[i];
    }
    const wo_rect frame = {0, 0, 3, 2};
    wo_io_part part = noisy_part("", frame, frame, names, COUNT);
    wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_SINGLE);
    for (int i = 0; i < COUNT; i++)
        assert_string_equal(file->parts[0].channel_names[i], names[i]);
    assert_true(difference(&file->parts[0], &part) == 0);
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);

    names[1] = names[0];
    part = noisy_part("", frame, frame, names, 3);
    assert_fault(wo_io_write(in_folder("b.exr"), &part, 1, WO_IO_AUTO, &fault), WO_ERR_ARGUMENT,
                 "two channels");
    wo_io_part_clear(&part);
}

static void assert_same_attribute(const wo_io_part *part, const wo_io_attribute *wanted)
{
    const wo_io_attribute *const got = wo_io_part_find(part, wanted->name);
    if (!got)
        fail_msg("%s is gone", wanted->name);
    assert_int_equal(got->type, wanted->type);
    assert_string_equal(got->kind, wanted->kind);
    if (wanted->type == WO_IO_TEXT)
        assert_string_equal(got->text, wanted->text);
    else
        assert_float_equal(got->number, wanted->number, 0);
}

static void attributes_survive(void **state)
{
    (void)state;
#define NUMBER(name, type, number, kind)                                                           \
    {                                                                                              \
        name, type, number, NULL, kind                                                             \
    }
#define TEXT(name, text, kind)                                                                     \
    {                                                                                              \
        name, WO_IO_TEXT, 0, text, kind                                                            \
    }
    static char *const none = "";
    static const wo_io_attribute given[] = {
        NUMBER("frame", WO_IO_INT, -17, ""),
        NUMBER("wideopen:fStop", WO_IO_FLOAT, 1.75, ""),
        NUMBER("exact", WO_IO_FLOAT, 0.1, "double"),
        TEXT("comments", "Gr\303\274\303\237e, \"quoted\"\nand two lines", ""),
        TEXT("empty", "", ""),
        TEXT("screenWindowCenter", "0.25 -0.5", "v2f"),
        TEXT("v2i", "-3 4", "v2i"),
        TEXT("v2d", "0.1 1024.5", "v2d"),
        TEXT("v3i", "1 2 3", "v3i"),
        TEXT("v3f", "1.5 -2 3.1", "v3f"),
        TEXT("v3d", "1 2 3", "v3d"),
        TEXT("box2i", "-1 -2 3 4", "box2i"),
        TEXT("box2f", "-1.5 -2 3 4", "box2f"),
        TEXT("m33f", "1 0 0 0 1 0 0 0 1", "m33f"),
        TEXT("m33d", "1 0 0 0 1 0 0 0 1.5", "m33d"),
        TEXT("worldToCamera", "1 0 0 0 0 1 0 0 0 0 1 0 4 5 6 1", "m44f"),
        TEXT("m44d", "1 0 0 0 0 1 0 0 0 0 1 0 4 5 6 1.25", "m44d"),
        TEXT("chromaticities", "0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329", "chromaticities"),
        TEXT("framesPerSecond", "24000 1001", "rational"),
        TEXT("timeCode", "4294967295 7", "timecode"),
        TEXT("keyCode", "1 2 3 4 5 6 64", "keycode"),
        TEXT("floats", "1 2.5 3 4 5", "floatvector"),
        TEXT("multiView", "left\nright", "stringvector"),
        NUMBER("a_name_of_more_than_thirty_one_characters", WO_IO_FLOAT, 3, ""),
    };
    const wo_rect frame = {0, 0, 4, 3};
    wo_io_part part = noisy_part("", frame, frame, rgba, 4);
    for (size_t i = 0; i < WO_COUNT(given); i++)
        assert_ok(wo_io_part_set(&part, &given[i], &fault));
    wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_AUTO);
    for (size_t i = 0; i < WO_COUNT(given); i++)
        assert_same_attribute(&file->parts[0], &given[i]);

    /* a second generation */
    wo_io_file *again = write_and_read("b.exr", file->parts, 1, WO_IO_AUTO);
    assert_int_equal(again->parts[0].attribute_count, file->parts[0].attribute_count);
    for (size_t i = 0; i < file->parts[0].attribute_count; i++)
        assert_same_attribute(&again->parts[0], &file->parts[0].attributes[i]);
    wo_io_file_destroy(&again);
    wo_io_file_destroy(&file);

    const wo_io_attribute wrong = TEXT("v3f", "1 2 many", "v3f");
    assert_ok(wo_io_part_set(&part, &wrong, &fault));
    assert_fault(wo_io_write(in_folder("c.exr"), &part, 1, WO_IO_AUTO, &fault), WO_ERR_ARGUMENT,
                 "are not 3 numbers");
    wo_io_part_clear(&part);
    assert_string_equal(none, "");
}

static void attributes_are_replaced(void **state)
{
    (void)state;
    wo_io_part part = {0};
    assert_ok(wo_io_part_set_number(&part, "a", 1, &fault));
    assert_ok(wo_io_part_set_text(&part, "b", "first", &fault));
    assert_ok(wo_io_part_set_text(&part, "a", "now text", &fault));
    assert_ok(wo_io_part_set_number(&part, "b", 2, &fault));
    assert_int_equal(part.attribute_count, 2);
    assert_string_equal(wo_io_part_find(&part, "a")->text, "now text");
    assert_null(wo_io_part_find(&part, "b")->text);
    assert_null(wo_io_part_find(&part, "c"));
    assert_fault(wo_io_part_set_text(&part, "", "x", &fault), WO_ERR_ARGUMENT, "needs a name");
    wo_io_part_clear(&part);
}

/* A name that EXR reserves for another kind would make other programs refuse the file. */
static void reserved_names_keep_their_kind(void **state)
{
    (void)state;
    const wo_rect frame = {0, 0, 4, 3};
    wo_io_part part = noisy_part("", frame, frame, rgba, 4);
    assert_ok(wo_io_part_set_text(&part, "chromaticities", "like a cow", &fault));
    assert_ok(wo_io_part_set_text(&part, "dataWindow", "0 0 1 1", &fault));
    assert_ok(wo_io_part_set_number(&part, "owner", 5, &fault));
    wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_AUTO);
    assert_null(wo_io_part_find(&file->parts[0], "chromaticities"));
    assert_null(wo_io_part_find(&file->parts[0], "dataWindow"));
    assert_null(wo_io_part_find(&file->parts[0], "owner"));
    wo_io_file_destroy(&file);
    wo_io_part_clear(&part);
}

static void compressions(void **state)
{
    (void)state;
    static const char *const names[] = {"none", "rle", "zips", "zip", "piz"};
    const wo_rect frame = {0, 0, 67, 71};
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        wo_io_part part = noisy_part("", frame, frame, rgba, 4);
        assert_ok(wo_io_part_set_text(&part, "compression", names[i], &fault));
        wo_io_file *file = write_and_read("a.exr", &part, 1, WO_IO_SINGLE);
        assert_true(difference(&file->parts[0], &part) == 0);
        assert_string_equal(wo_io_part_find(&file->parts[0], "compression")->text, names[i]);
        wo_io_file_destroy(&file);
        wo_io_part_clear(&part);
    }
}

static void headers_only(void **state)
{
    (void)state;
    const wo_rect frame = {0, 0, 9, 5};
    wo_io_part part = noisy_part("", frame, frame, rgba, 4);
    wo_io_file *file = NULL;
    wo_image image;
    assert_ok(wo_io_write(in_folder("a.exr"), &part, 1, WO_IO_AUTO, &fault));
    assert_ok(wo_io_write(in_folder("a.png"), &part, 1, WO_IO_AUTO, &fault));
    static const char *const names[] = {"a.exr", "a.png"};
    for (int i = 0; i < 2; i++) {
        assert_ok(wo_io_read(in_folder(names[i]), true, &file, &fault));
        assert_null(file->parts[0].pixels);
        assert_int_equal(wo_rect_width(file->parts[0].data_window), 9);
        assert_fault(wo_io_select(file, "", &image, NULL, &fault), WO_ERR_ARGUMENT, "header");
        assert_null(image.data);
        wo_io_file_destroy(&file);
    }
    wo_io_part_clear(&part);
}

/* Files made by another program: DWA, B44 of floats, deep tiles and deep lines. */
static void foreign_kinds(void **state)
{
    (void)state;
    wo_io_file *file = NULL;
    for (int kind = 0; kind < 2; kind++) {
        if (kind == 0)
            write_bytes(in_folder("a.exr"), dwa_file, sizeof dwa_file);
        else
            write_bytes(in_folder("a.exr"), b44_file, sizeof b44_file);
        assert_ok(wo_io_read(in_folder("a.exr"), false, &file, &fault));
        for (int y = 0; y < 8; y++)
            for (int x = 0; x < 8; x++) {
                assert_float_equal(*sample_at(file->parts, x, y, 0), (float)x / 8, 0.01f);
                assert_float_equal(*sample_at(file->parts, x, y, 1), (float)(7 - y) / 8, 0.01f);
                assert_float_equal(*sample_at(file->parts, x, y, 2), 0.5f, 0.01f);
            }
        wo_io_file_destroy(&file);
    }
}

static void deep_pixels_are_flattened(void **state)
{
    (void)state;
    /* R, A, Z of the pixels from the top left */
    static const float wanted[6][3] = {{0.625f, 0.75f, 2},   {0, 0, 0},
                                       {0.125f, 1, 1},       {0.25f, 0.25f, 9},
                                       {0.4375f, 0.875f, 1}, {2, 1, 7}};
    wo_io_file *file = NULL;
    for (int kind = 0; kind < 2; kind++) {
        if (kind == 0)
            write_bytes(in_folder("a.exr"), deep_tiles, sizeof deep_tiles);
        else
            write_bytes(in_folder("a.exr"), deep_lines, sizeof deep_lines);
        assert_ok(wo_io_read(in_folder("a.exr"), false, &file, &fault));
        const wo_io_part *const part = &file->parts[0];
        assert_int_equal(part->channels, 3);
        assert_string_equal(part->channel_names[0], "R");
        assert_string_equal(part->channel_names[1], "A");
        assert_string_equal(part->channel_names[2], "Z");
        for (int i = 0; i < 6; i++)
            for (int c = 0; c < 3; c++)
                assert_float_equal(*sample_at(part, i % 3, 1 - i / 3, c), wanted[i][c], 1e-6f);
        assert_float_equal(wo_io_part_find(part, "wideopen:flattenedDeep")->number, 1, 0);
        wo_io_file_destroy(&file);
    }
}

/* One of several at the same time: files of its own, and faults whose words are its own. */
static void *busy_thread(void *argument)
{
    const int number = *(const int *)argument;
    char exr[512], png[512], missing[512];
    snprintf(exr, sizeof exr, "%s/%d.exr", test_folder, number);
    snprintf(png, sizeof png, "%s/%d.png", test_folder, number);
    snprintf(missing, sizeof missing, "%s/missing%d.png", test_folder, number);
    wo_error mine = {0};
    wo_io_file *file = NULL;
    const wo_rect frame = {0, 0, 30 + number, 20};
    wo_io_part part = {0};
    if (wo_io_part_init(&part, "p", frame, frame, rgba, 4, &mine) != WO_OK)
        return (void *)(uintptr_t) "no part";
    fill_noise(&part, 0, 1);
    const char *trouble = NULL;
    for (int round = 0; round < 10 && !trouble; round++) {
        if (wo_io_write(exr, &part, 1, WO_IO_SINGLE, &mine) != WO_OK ||
            wo_io_write(png, &part, 1, WO_IO_AUTO, &mine) != WO_OK)
            trouble = "not written";
        else if (wo_io_read(exr, false, &file, &mine) != WO_OK ||
                 memcmp(file->parts[0].pixels, part.pixels,
                        (size_t)frame.x2 * 20 * 4 * sizeof(float)) != 0)
            trouble = "EXR not read";
        wo_io_file_destroy(&file);
        if (!trouble && (wo_io_read(png, false, &file, &mine) != WO_OK ||
                         file->parts[0].data_window.x2 != frame.x2))
            trouble = "PNG not read";
        wo_io_file_destroy(&file);
        if (!trouble && (wo_io_read(missing, false, &file, &mine) != WO_ERR_IO ||
                         !strstr(mine.text, strrchr(missing, '/'))))
            trouble = "somebody else's words";
        if (!trouble && (truncate(png, 200) || wo_io_read(png, false, &file, &mine) == WO_OK ||
                         !strstr(mine.text, strrchr(png, '/'))))
            trouble = "somebody else's words about PNG";
    }
    wo_io_part_clear(&part);
    return (void *)(uintptr_t)trouble;
}

static void threads_do_not_meet(void **state)
{
    (void)state;
    enum { COUNT = 6 };
    pthread_t threads[COUNT];
    int numbers[COUNT];
    const char *first = NULL;
    for (int i = 0; i < COUNT; i++) {
        numbers[i] = i;
        assert_int_equal(pthread_create(&threads[i], NULL, busy_thread, &numbers[i]), 0);
    }
    for (int i = 0; i < COUNT; i++) {
        void *trouble = NULL;
        assert_int_equal(pthread_join(threads[i], &trouble), 0);
        if (trouble && !first)
            first = trouble;
    }
    if (first)
        fail_msg("%s", first);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup(name, empty_folder)
    const struct CMUnitTest tests[] = {
        TEST(exr_float_is_exact),
        TEST(exr_auto_is_half_colour_and_float_depth),
        TEST(half_has_no_infinities),
        TEST(all_halves_survive),
        TEST(windows_keep_their_place),
        TEST(display_window_is_the_origin),
        TEST(many_parts),
        TEST(many_channels),
        TEST(attributes_survive),
        TEST(attributes_are_replaced),
        TEST(reserved_names_keep_their_kind),
        TEST(compressions),
        TEST(headers_only),
        TEST(foreign_kinds),
        TEST(deep_pixels_are_flattened),
        TEST(threads_do_not_meet),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
