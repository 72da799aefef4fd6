/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _GNU_SOURCE
#include "bridge_test.h"

#include <pthread.h>
#include <signal.h>

/* Reading in a process of its own, and what of a file is read. */

static const char *const rgba[] = {"R", "G", "B", "A"};

static void put_number(unsigned char *to, uint32_t value, int bytes, bool low_first)
{
    for (int i = 0; i < bytes; i++)
        to[low_first ? i : bytes - 1 - i] = (unsigned char)(value >> (8 * i));
}

static void write_good(const char *name)
{
    const wo_rect frame = {0, 0, 5, 4};
    wo_io_part part = {0};
    assert_ok(wo_io_part_init(&part, NULL, frame, frame, rgba, 4, &fault));
    fill_noise(&part, 0, 1);
    assert_ok(wo_io_write(in_folder(name), &part, 1, WO_IO_AUTO, &fault));
    wo_io_part_clear(&part);
}

static void read_good(const char *name)
{
    wo_io_file *file = NULL;
    assert_ok(wo_io_read(in_folder(name), false, &file, &fault));
    for (size_t i = 0; i < 5 * 4 * 4; i++) {
        const float wanted = roundf(noise((uint32_t)i) * 255) / 255;
        assert_true(fabsf(file->parts[0].pixels[i] - wanted) < 1e-6f);
    }
    wo_io_file_destroy(&file);
}

/* Files that end the library, or would have it take gigabytes: one line each, and the next file is
   read as if nothing had been. */

static void spoilt_tga(void)
{
    unsigned char bytes[791] = {[1] = 1, [2] = 9, [7] = 24, [12] = 16, [15] = 46, [16] = 32};
    bytes[787] = 8;
    write_bytes(in_folder("bad.tga"), bytes, sizeof bytes);
}

static void spoilt_bmp(void)
{
    unsigned char bytes[67] = {'B', 'M', 67, [10] = 54, [14] = 40, [26] = 1, [28] = 24};
    put_number(bytes + 18, 0x7fffffff, 4, true);
    put_number(bytes + 22, 1, 4, true);
    write_bytes(in_folder("bad.bmp"), bytes, sizeof bytes);
}

static void spoilt_cin(void)
{
    static unsigned char bytes[2077];
    memset(bytes, 0xff, sizeof bytes);
    put_number(bytes, 0x802a5fd7u, 4, false);
    put_number(bytes + 4, 2048, 4, false);
    bytes[193] = 3;
    write_bytes(in_folder("bad.cin"), bytes, sizeof bytes);
}

/* A progressive JPEG of 65500 x 65500: its head, and one scan that ends at once. */
static void spoilt_jpg(void)
{
    static const unsigned char bytes[] = {
        0xff, 0xd8, 0xff, 0xc2, 0, 17, 8, 0xff, 0xdc, 0xff, 0xdc, 3, 1, 0x11, 0, 2, 0x11, 0,   3,
        0x11, 0,    0xff, 0xda, 0, 12, 3, 1,    0,    2,    0,    3, 0, 0,    0, 0, 0xff, 0xd9};
    write_bytes(in_folder("bad.jpg"), bytes, sizeof bytes);
}

static void damaged_files_end_nothing_else(void **state)
{
    (void)state;
    static const char *const names[] = {"bad.tga", "bad.bmp", "bad.cin", "bad.jpg"};
    spoilt_tga();
    spoilt_bmp();
    spoilt_cin();
    spoilt_jpg();
    write_good("good.png");
    for (int turn = 0; turn < 2; turn++)
        for (size_t i = 0; i < WO_COUNT(names); i++) {
            wo_io_file *file = NULL;
            const wo_status got = wo_io_read(in_folder(names[i]), false, &file, &fault);
            if ((got != WO_ERR_FORMAT && got != WO_ERR_RANGE) || !strstr(fault.text, names[i]) ||
                strchr(fault.text, '\n'))
                fail_msg("%s: %s, %s", names[i], wo_status_text(got), fault.text);
            assert_null(file);
            read_good("good.png");
        }
}

/* Processes that this one has started: /proc names them by thread. */
static int children(pid_t *first)
{
    char path[64];
    int count = 0;
    long pid;
    snprintf(path, sizeof path, "/proc/self/task/%d/children", (int)getpid());
    FILE *const list = fopen(path, "r");
    if (!list)
        return -1;
    for (; fscanf(list, "%ld", &pid) == 1; count++)
        if (first && count == 0)
            *first = (pid_t)pid;
    fclose(list);
    return count;
}

static void helpers_come_and_go(void **state)
{
    (void)state;
    pid_t helper = 0;
    write_good("good.png");
    read_good("good.png");
    if (children(NULL) < 0)
        return; /* a system that does not tell */
    assert_int_equal(children(&helper), 1);
    for (int i = 0; i < 5; i++)
        read_good("good.png");
    assert_int_equal(children(NULL), 1); /* one is enough */
    assert_int_equal(kill(helper, SIGKILL), 0);
    while (kill(helper, 0) == 0 && children(NULL) == 1) {
        char state_path[64], letter = 0;
        snprintf(state_path, sizeof state_path, "/proc/%d/stat", (int)helper);
        FILE *const about = fopen(state_path, "r");
        if (!about || fscanf(about, "%*d %*s %c", &letter) != 1 || letter == 'Z') {
            if (about)
                fclose(about);
            break;
        }
        fclose(about);
    }
    read_good("good.png"); /* somebody ended it: another takes its place */
    wo_io_end_helpers();
    assert_int_equal(children(NULL), 0);
    read_good("good.png");
    wo_io_end_helpers();
    wo_io_end_helpers();
}

static void *read_some(void *result)
{
    wo_error own;
    int *const failures = result;
    for (int i = 0; i < 6; i++) {
        wo_io_file *file = NULL;
        const bool good = i % 2 == 0;
        const wo_status got =
            wo_io_read(in_folder(good ? "good.png" : "bad.bmp"), false, &file, &own);
        *failures += (got == WO_OK) != good;
        wo_io_file_destroy(&file);
    }
    return NULL;
}

static void threads_read_at_once(void **state)
{
    (void)state;
    enum { THREADS = 6 };
    pthread_t threads[THREADS];
    int failures[THREADS] = {0};
    write_good("good.png");
    spoilt_bmp();
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, read_some, &failures[i]), 0);
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
        assert_int_equal(failures[i], 0);
    }
}

/* Descriptors that are closed here, and low ones that are something else, do not matter. */
static void descriptors_do_not_matter(void **state)
{
    (void)state;
    write_good("good.png");
    wo_io_end_helpers();
    const int kept = dup(0);
    close(0);
    read_good("good.png");
    wo_io_end_helpers();
    if (kept >= 0) {
        dup2(kept, 0);
        close(kept);
    }
}

/* Grey with alpha is a grey RGBA. */
static void grey_keeps_its_alpha(void **state)
{
    (void)state;
    static const char *const names[] = {"Y", "A"};
    static const char *const files[] = {"a.png", "a.exr"};
    const wo_rect frame = {0, 0, 4, 1};
    for (size_t f = 0; f < WO_COUNT(files); f++) {
        wo_io_part part = {0};
        wo_io_file *file = NULL;
        wo_image image;
        assert_ok(wo_io_part_init(&part, NULL, frame, frame, names, 2, &fault));
        for (int i = 0; i < 8; i++)
            part.pixels[i] = (float)(i * 17) / 255;
        assert_ok(
            wo_io_write(in_folder(files[f]), &part, 1, f ? WO_IO_SINGLE : WO_IO_BYTE, &fault));
        assert_ok(wo_io_read(in_folder(files[f]), false, &file, &fault));
        assert_ok(wo_io_select(file, "", &image, NULL, &fault));
        assert_int_equal(image.components, 4);
        for (int i = 0; i < 16; i++)
            assert_float_equal(image.data[i], part.pixels[2 * (i / 4) + (i % 4 == 3)], 1e-6f);
        free(image.data);
        wo_io_file_destroy(&file);
        wo_io_part_clear(&part);
    }
}

static void names_may_hold_commas(void **state)
{
    (void)state;
    static const char *const names[] = {"N,x", "N,y", "N", "x", "a,b,c"};
    static const struct {
        const char *words;
        int count, values[4];
    } cases[] = {{"N,x", 1, {0}},
                 {"a,b,c", 1, {4}},
                 {"N,y,N,x,N", 3, {1, 0, 2}},
                 {"x,N,x,x,N", 4, {3, 0, 3, 2}},
                 {"n,X", 1, {0}},
                 {"a,b,c,N,x,x", 3, {4, 0, 3}}};
    const wo_rect frame = {0, 0, 1, 1};
    wo_io_file *file = NULL;
    wo_image image;
    assert_ok(wo_io_file_create(1, &file, &fault));
    assert_ok(wo_io_part_init(file->parts, NULL, frame, frame, names, 5, &fault));
    for (int c = 0; c < 5; c++)
        file->parts[0].pixels[c] = (float)c;
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        assert_ok(wo_io_select(file, cases[i].words, &image, NULL, &fault));
        assert_int_equal(image.components, cases[i].count);
        for (int c = 0; c < cases[i].count; c++)
            assert_true(image.data[c] == (float)cases[i].values[c]);
        free(image.data);
    }
    assert_fault(wo_io_select(file, "N,z", &image, NULL, &fault), WO_ERR_NOT_FOUND, "N,z");
    wo_io_file_destroy(&file);
}

static void names_that_are_there_are_no_sequence(void **state)
{
    (void)state;
    char path[1024], pattern[600];
    assert_int_equal(mkdir(in_folder("50%done"), 0700), 0);
    snprintf(pattern, sizeof pattern, "%s/a.exr", in_folder("50%done"));
    assert_false(wo_io_is_sequence(pattern));
    assert_ok(wo_io_frame_path(pattern, 7, path, sizeof path, &fault));
    assert_string_equal(path, pattern);

    snprintf(pattern, sizeof pattern, "%s/a.%%03d.exr", in_folder("50%done"));
    assert_true(wo_io_is_sequence(pattern));
    assert_ok(wo_io_frame_path(pattern, 7, path, sizeof path, &fault));
    assert_non_null(strstr(path, "50%done/a.007.exr"));

    snprintf(pattern, sizeof pattern, "%s/a.exr", in_folder("51%done")); /* is not there */
    assert_true(wo_io_is_sequence(pattern));
    rmdir(in_folder("50%done"));

    write_bytes(in_folder("100%done.exr"), "x", 1);
    assert_false(wo_io_is_sequence(in_folder("100%done.exr")));
    assert_true(wo_io_is_sequence(in_folder("101%done.exr")));
}

/* EXR by hand: float channels of any sampling, lines as they are. */

typedef struct exr_text {
    unsigned char bytes[1 << 16];
    size_t size;
} exr_text;

static void add_bytes(exr_text *to, const void *bytes, size_t size)
{
    assert_true(to->size + size <= sizeof to->bytes);
    memcpy(to->bytes + to->size, bytes, size);
    to->size += size;
}

static void add_word(exr_text *to, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        const unsigned char byte = (unsigned char)(value >> (8 * i));
        add_bytes(to, &byte, 1);
    }
}

static void add_float(exr_text *to, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    add_word(to, bits, 4);
}

static void add_attribute(exr_text *to, const char *name, const char *type, size_t size)
{
    add_bytes(to, name, strlen(name) + 1);
    add_bytes(to, type, strlen(type) + 1);
    add_word(to, size, 4);
}

typedef struct exr_plane {
    const char *name; /* in order of name */
    int sampling;
    float (*value)(int x, int y); /* y down */
} exr_plane;

static void add_window(exr_text *to, const char *name, int x, int y, int width, int height)
{
    add_attribute(to, name, "box2i", 16);
    add_word(to, (uint32_t)x, 4);
    add_word(to, (uint32_t)y, 4);
    add_word(to, (uint32_t)(x + width - 1), 4);
    add_word(to, (uint32_t)(y + height - 1), 4);
}

static void write_planes(const char *name, const exr_plane *planes, int count, int x, int y,
                         int width, int height, const float *chromaticities)
{
    static exr_text text;
    text.size = 0;
    size_t list = 1;
    add_word(&text, 20000630, 4);
    add_word(&text, 2, 4);
    for (int c = 0; c < count; c++)
        list += strlen(planes[c].name) + 17;
    add_attribute(&text, "channels", "chlist", list);
    for (int c = 0; c < count; c++) {
        add_bytes(&text, planes[c].name, strlen(planes[c].name) + 1);
        add_word(&text, 2, 4); /* float */
        add_word(&text, 0, 4);
        add_word(&text, (uint32_t)planes[c].sampling, 4);
        add_word(&text, (uint32_t)planes[c].sampling, 4);
    }
    add_word(&text, 0, 1);
    if (chromaticities) {
        add_attribute(&text, "chromaticities", "chromaticities", 32);
        for (int i = 0; i < 8; i++)
            add_float(&text, chromaticities[i]);
    }
    add_attribute(&text, "compression", "compression", 1);
    add_word(&text, 0, 1);
    add_window(&text, "dataWindow", x, y, width, height);
    add_window(&text, "displayWindow", 0, 0, 16, 16);
    add_attribute(&text, "lineOrder", "lineOrder", 1);
    add_word(&text, 0, 1);
    add_attribute(&text, "pixelAspectRatio", "float", 4);
    add_float(&text, 1);
    add_attribute(&text, "screenWindowCenter", "v2f", 8);
    add_word(&text, 0, 8);
    add_attribute(&text, "screenWindowWidth", "float", 4);
    add_float(&text, 1);
    add_word(&text, 0, 1);
    const size_t table = text.size;
    for (int line = 0; line < height; line++)
        add_word(&text, 0, 8);
    for (int line = y; line < y + height; line++) {
        const size_t place = text.size;
        for (int i = 0; i < 8; i++)
            text.bytes[table + 8 * (size_t)(line - y) + (size_t)i] =
                (unsigned char)((uint64_t)place >> (8 * i));
        add_word(&text, (uint32_t)line, 4);
        add_word(&text, 0, 4);
        for (int c = 0; c < count; c++)
            for (int i = x; i < x + width; i++)
                if (line % planes[c].sampling == 0 && i % planes[c].sampling == 0)
                    add_float(&text, planes[c].value(i, line));
        put_number(text.bytes + place + 4, (uint32_t)(text.size - place - 8), 4, true);
    }
    write_bytes(in_folder(name), text.bytes, text.size);
}

static float luminance(int x, int y)
{
    return 0.25f + 0.03f * (float)x + 0.02f * (float)y;
}

/* Chroma is linear in x and y: interpolating it is exact. */
static float red_chroma(int x, int y)
{
    return -0.3f + 0.04f * (float)x + 0.01f * (float)y;
}

static float blue_chroma(int x, int y)
{
    return 0.2f - 0.02f * (float)x + 0.03f * (float)y;
}

static float one_of(const float *chroma, const float *y_value, const double weights[3], int c)
{
    const double luma = (double)*y_value, r = ((double)chroma[0] + 1) * luma,
                 b = ((double)chroma[1] + 1) * luma;
    return (float)(c == 0 ? r : c == 2 ? b : (luma - weights[0] * r - weights[2] * b) / weights[1]);
}

/* Compares a file of 8 x 6 at 2, -4 with what Y, RY and BY mean. */
static void check_colours(const char *name, const double weights[3], int sampling)
{
    wo_io_file *file = NULL;
    wo_image image, red;
    wo_io_file *view = NULL;
    size_t part = 9;
    assert_ok(wo_io_read(in_folder(name), false, &file, &fault));
    assert_string_equal(file->parts[0].channel_names[0], "R");
    assert_string_equal(file->parts[0].channel_names[1], "G");
    assert_string_equal(file->parts[0].channel_names[2], "B");
    assert_ok(wo_io_select(file, "", &image, NULL, &fault));
    assert_int_equal(image.components, 3);
    assert_ok(wo_io_read_view(in_folder(name), "G", &view, &red, &part, &fault));
    assert_int_equal(red.components, 1);
    for (int y = -4; y < 2; y++)
        for (int x = 2; x < 10; x++) {
            /* behind the last sample of a line its value is held */
            const int cx = x - x % sampling == 10 - sampling ? x - x % sampling : x;
            const int last = 2 - sampling;
            const int cy = y > last ? last : y;
            const float chroma[2] = {red_chroma(cx, cy), blue_chroma(cx, cy)};
            const float luma = luminance(x, y);
            const float *const got = wo_image_at(&image, x, 15 - y);
            for (int c = 0; c < 3; c++)
                if (fabsf(got[c] - one_of(chroma, &luma, weights, c)) > 2e-6f)
                    fail_msg("%s: %d, %d: channel %d is %g, not %g", name, x, y, c, (double)got[c],
                             (double)one_of(chroma, &luma, weights, c));
            assert_true(*wo_image_at(&red, x, 15 - y) == got[1]);
        }
    free(image.data);
    free(red.data);
    wo_io_file_destroy(&file);
    wo_io_file_destroy(&view);
}

static void luminance_and_chroma_are_colours(void **state)
{
    (void)state;
    static const double rec709[3] = {0.2126, 0.7152, 0.0722};
    /* ACEScg's: what its primaries and white give, 0.2722287168, 0.6740817658, 0.0536895174 */
    static const float ap1[8] = {0.713f, 0.293f, 0.165f, 0.83f, 0.128f, 0.044f, 0.32168f, 0.33767f};
    static const double ap1_weights[3] = {0.2722287168, 0.6740817658, 0.0536895174};
    exr_plane planes[] = {{"BY", 2, blue_chroma}, {"RY", 2, red_chroma}, {"Y", 1, luminance}};
    write_planes("half.exr", planes, 3, 2, -4, 8, 6, NULL);
    check_colours("half.exr", rec709, 2);
    write_planes("ap1.exr", planes, 3, 2, -4, 8, 6, ap1);
    check_colours("ap1.exr", ap1_weights, 2);
    planes[0].sampling = planes[1].sampling = 1;
    write_planes("full.exr", planes, 3, 2, -4, 8, 6, NULL);
    check_colours("full.exr", rec709, 1);

    /* a layer, beside other channels; and without RY no chroma at all */
    static const exr_plane mixed[] = {{"A", 1, luminance},
                                      {"L.BY", 2, blue_chroma},
                                      {"L.RY", 2, red_chroma},
                                      {"L.Y", 1, luminance},
                                      {"Z", 2, red_chroma}};
    wo_io_file *file = NULL;
    write_planes("layer.exr", mixed, 5, 2, -4, 8, 6, NULL);
    assert_ok(wo_io_read(in_folder("layer.exr"), false, &file, &fault));
    assert_string_equal(file->parts[0].channel_names[0], "A");
    assert_string_equal(file->parts[0].channel_names[2], "L.R");
    assert_string_equal(file->parts[0].channel_names[3], "L.G");
    assert_string_equal(file->parts[0].channel_names[4], "L.B");
    assert_float_equal(*sample_at(&file->parts[0], 3, 15 - 1 + 4, 1), red_chroma(3, -3), 1e-6f);
    wo_io_file_destroy(&file);
    write_planes("lone.exr", planes, 1, 2, -4, 8, 6, NULL);
    assert_ok(wo_io_read(in_folder("lone.exr"), false, &file, &fault));
    assert_string_equal(file->parts[0].channel_names[0], "BY");
    wo_io_file_destroy(&file);
    /* a window that the sampling does not divide */
    planes[0].sampling = 2;
    write_planes("odd.exr", planes, 1, 2, -4, 7, 6, NULL);
    assert_fault(wo_io_read(in_folder("odd.exr"), false, &file, &fault), WO_ERR_FORMAT, "odd.exr");
}

static wo_io_part layers[2];

static void make_layers(void)
{
    static const char *const names[] = {"R", "G", "B", "A", "Z", "d.R", "d.G", "d.B", "Y2", "id"};
    const wo_rect frame = {0, 0, 40, 30}, inner = {3, 2, 40, 29};
    for (int i = 0; i < 2; i++) {
        assert_ok(wo_io_part_init(&layers[i], i ? "second" : "first", i ? inner : frame, frame,
                                  names, i ? 10 : 5, &fault));
        fill_noise(&layers[i], 0, 1);
    }
}

static void clear_layers(void)
{
    for (int i = 0; i < 2; i++)
        wo_io_part_clear(&layers[i]);
}

static void views_are_what_select_gives(void **state)
{
    (void)state;
    static const char *const words[] = {"",        "Z", "second", "second:d", "second:Y2",
                                        "A,R,A,Z", "d", "id",     "rgb"};
    static const char *const files[] = {"a.exr", "a.png"};
    make_layers();
    for (size_t f = 0; f < WO_COUNT(files); f++) {
        wo_io_file *whole = NULL;
        if (f)
            layers[0].channels = 4; /* the last one is left out */
        assert_ok(wo_io_write(in_folder(files[f]), layers, f ? 1 : 2, WO_IO_AUTO, &fault));
        layers[0].channels = 5;
        assert_ok(wo_io_read(in_folder(files[f]), false, &whole, &fault));
        for (size_t i = 0; i < (f ? 1 : WO_COUNT(words)); i++) {
            wo_io_file *heads = NULL;
            const wo_io_part *from = NULL;
            wo_image wanted, got;
            size_t part = 9;
            assert_ok(wo_io_select(whole, words[i], &wanted, &from, &fault));
            assert_ok(wo_io_read_view(in_folder(files[f]), words[i], &heads, &got, &part, &fault));
            assert_int_equal(part, from - whole->parts);
            assert_int_equal(got.components, wanted.components);
            assert_memory_equal(&got.bounds, &wanted.bounds, sizeof got.bounds);
            assert_memory_equal(got.data, wanted.data,
                                (size_t)wanted.row_bytes * (size_t)wo_rect_height(wanted.bounds));
            for (size_t p = 0; p < heads->part_count; p++) {
                assert_null(heads->parts[p].pixels);
                assert_int_equal(heads->parts[p].channels, whole->parts[p].channels);
            }
            free(wanted.data);
            free(got.data);
            wo_io_file_destroy(&heads);
        }
        wo_io_file *heads = NULL;
        wo_image none;
        size_t part;
        assert_fault(wo_io_read_view(in_folder(files[f]), "none", &heads, &none, &part, &fault),
                     WO_ERR_NOT_FOUND, "none");
        assert_null(heads);
        assert_null(none.data);
        wo_io_file_destroy(&whole);
    }
    clear_layers();
}

static void good_parts_of_a_cut_file(void **state)
{
    (void)state;
    wo_io_file *file = NULL, *heads = NULL;
    wo_image image;
    size_t size, part;
    make_layers();
    assert_ok(wo_io_write(in_folder("a.exr"), layers, 2, WO_IO_SINGLE, &fault));
    unsigned char *const bytes = read_bytes(in_folder("a.exr"), &size);
    write_bytes(in_folder("cut.exr"), bytes, size - 200);
    assert_ok(wo_io_read(in_folder("cut.exr"), false, &file, &fault));
    assert_null(file->parts[0].fault);
    assert_memory_equal(file->parts[0].pixels, layers[0].pixels, 40 * 30 * 5 * sizeof(float));
    assert_null(file->parts[1].pixels);
    assert_non_null(strstr(file->parts[1].fault, "cut.exr"));
    assert_ok(wo_io_select(file, "first", &image, NULL, &fault));
    free(image.data);
    assert_fault(wo_io_select(file, "second", &image, NULL, &fault), WO_ERR_FORMAT, "cut.exr");
    wo_io_file_destroy(&file);
    assert_ok(wo_io_read_view(in_folder("cut.exr"), "Z", &heads, &image, &part, &fault));
    assert_int_equal(part, 0);
    free(image.data);
    wo_io_file_destroy(&heads);
    assert_fault(wo_io_read_view(in_folder("cut.exr"), "second:d", &heads, &image, &part, &fault),
                 WO_ERR_FORMAT, "cut.exr");
    free(bytes);
    clear_layers();
}

/* A program that was stopped leaves a table of zeros; the lines tell where they are. Cut lines are
   still refused. */
static void empty_tables_are_made_anew(void **state)
{
    (void)state;
    static const char *const packings[] = {"none", "zip", "zips", "piz"};
    make_layers();
    for (size_t i = 0; i < WO_COUNT(packings); i++) {
        wo_io_file *file = NULL;
        size_t size, at = 0;
        assert_ok(wo_io_part_set_text(&layers[0], "compression", packings[i], &fault));
        assert_ok(wo_io_write(in_folder("a.exr"), layers, 1, WO_IO_SINGLE, &fault));
        unsigned char *const bytes = read_bytes(in_folder("a.exr"), &size);
        const size_t lines = !strcmp(packings[i], "zip") ? 2 : !strcmp(packings[i], "piz") ? 1 : 30;
        /* the table begins where its first number points behind its end */
        for (at = 8; at + 8 * lines < size; at++) {
            const size_t first = bytes[at] | (size_t)bytes[at + 1] << 8;
            if (first == at + 8 * lines && !bytes[at + 2] && !bytes[at + 3] && !bytes[at + 4])
                break;
        }
        assert_true(at + 8 * lines < size);
        memset(bytes + at, 0, 8 * lines);
        write_bytes(in_folder("empty.exr"), bytes, size);
        assert_ok(wo_io_read(in_folder("empty.exr"), false, &file, &fault));
        assert_memory_equal(file->parts[0].pixels, layers[0].pixels, 40 * 30 * 5 * sizeof(float));
        wo_io_file_destroy(&file);
        write_bytes(in_folder("cut.exr"), bytes, size - 50);
        assert_fault(wo_io_read(in_folder("cut.exr"), false, &file, &fault), WO_ERR_FORMAT,
                     "cut.exr");
        free(bytes);
    }
    clear_layers();
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup(name, empty_folder)
    const struct CMUnitTest tests[] = {
        TEST(damaged_files_end_nothing_else),
        TEST(helpers_come_and_go),
        TEST(threads_read_at_once),
        TEST(descriptors_do_not_matter),
        TEST(grey_keeps_its_alpha),
        TEST(names_may_hold_commas),
        TEST(names_that_are_there_are_no_sequence),
        TEST(luminance_and_chroma_are_colours),
        TEST(views_are_what_select_gives),
        TEST(good_parts_of_a_cut_file),
        TEST(empty_tables_are_made_anew),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
