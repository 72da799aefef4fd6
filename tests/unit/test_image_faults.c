/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _GNU_SOURCE
#include "bridge_test.h"

#include "exr_samples.h"
#include "tests/property/cases.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>

static const char *const rgba[] = {"R", "G", "B", "A"};

static wo_io_part noisy_part(int width, int height)
{
    const wo_rect frame = {0, 0, width, height};
    wo_io_part part = {0};
    assert_ok(wo_io_part_init(&part, "part", frame, frame, rgba, 4, &fault));
    assert_ok(wo_io_part_set_text(&part, "owner", "somebody", &fault));
    fill_noise(&part, 0, 1);
    return part;
}

static wo_status try_read(const char *name)
{
    wo_io_file *file = NULL;
    fault.text[0] = '\0';
    const wo_status status = wo_io_read(in_folder(name), false, &file, &fault);
    if (status == WO_OK) {
        assert_non_null(file);
        for (size_t i = 0; i < file->part_count; i++)
            assert_non_null(file->parts[i].pixels);
    } else {
        assert_null(file);
        assert_true(fault.text[0]);
    }
    wo_io_file_destroy(&file);
    return status;
}

/* One file of each kind, and how its bytes came to be. */
static unsigned char *make_file(size_t kind, const char **name, size_t *size)
{
    static const struct {
        const char *name, *compression;
        wo_io_depth depth;
        int width, height;
    } kinds[] = {
        {"a.exr", "zip", WO_IO_HALF, 19, 21},  {"a.exr", "none", WO_IO_SINGLE, 5, 7},
        {"a.exr", "piz", WO_IO_HALF, 19, 40},  {"a.exr", "rle", WO_IO_HALF, 9, 4},
        {"a.exr", "zips", WO_IO_SINGLE, 9, 3}, {"a.png", "", WO_IO_AUTO, 19, 21},
        {"a.tif", "", WO_IO_AUTO, 19, 21},     {"a.dpx", "", WO_IO_AUTO, 19, 21},
        {"a.jpg", "", WO_IO_AUTO, 40, 40},     {"a.hdr", "", WO_IO_AUTO, 19, 21},
        {"a.tga", "", WO_IO_AUTO, 19, 21},     {"a.bmp", "", WO_IO_AUTO, 19, 21},
        {"a.ppm", "", WO_IO_AUTO, 19, 21},
    };
    static const struct {
        const unsigned char *bytes;
        size_t size;
    } foreign[] = {{dwa_file, sizeof dwa_file},
                   {b44_file, sizeof b44_file},
                   {deep_tiles, sizeof deep_tiles},
                   {deep_lines, sizeof deep_lines}};
    if (kind < WO_COUNT(kinds)) {
        wo_io_part part = noisy_part(kinds[kind].width, kinds[kind].height);
        *name = kinds[kind].name;
        if (kinds[kind].compression[0])
            assert_ok(wo_io_part_set_text(&part, "compression", kinds[kind].compression, &fault));
        assert_ok(wo_io_write(in_folder(*name), &part, 1, kinds[kind].depth, &fault));
        wo_io_part_clear(&part);
    } else if (kind < WO_COUNT(kinds) + WO_COUNT(foreign)) {
        const size_t i = kind - WO_COUNT(kinds);
        *name = "a.exr";
        write_bytes(in_folder(*name), foreign[i].bytes, foreign[i].size);
    } else {
        return NULL;
    }
    return read_bytes(in_folder(*name), size);
}

/* A file cut anywhere is refused; only what lies behind the pixels may be missing. */
static void cut_files(void **state)
{
    (void)state;
    const char *name;
    size_t size;
    for (size_t kind = 0;; kind++) {
        unsigned char *const bytes = make_file(kind, &name, &size);
        if (!bytes)
            break;
        size_t shortest = size;
        for (size_t length = 0; length < size; length += length < 64 ? 1 : 7 + size / 150) {
            write_bytes(in_folder(name), bytes, length);
            if (try_read(name) == WO_OK && length < shortest)
                shortest = length;
        }
        /* a TGA ends with a small copy of itself */
        if (size - shortest > (strcmp(name, "a.tga") ? 32 : 1024))
            fail_msg("kind %zu, %s: %zu of %zu bytes are enough", kind, name, shortest, size);
        write_bytes(in_folder(name), bytes, size);
        assert_int_equal(try_read(name), WO_OK);
        free(bytes);
        empty_folder(state);
    }
}

/* Bytes changed at random: any answer will do but a crash. */
static void spoilt_files(void **state)
{
    (void)state;
    const char *const rounds_text = getenv("WO_TEST_ROUNDS");
    const int rounds = rounds_text ? atoi(rounds_text) : cases_of(100, 40);
    const char *name;
    size_t size;
    uint32_t seed = 1;
    for (size_t kind = 0;; kind++) {
        unsigned char *const bytes = make_file(kind, &name, &size);
        if (!bytes)
            break;
        unsigned char *const spoilt = malloc(size);
        assert_non_null(spoilt);
        for (int round = 0; round < rounds; round++) {
            memcpy(spoilt, bytes, size);
            const int changes = 1 + round % 4;
            for (int i = 0; i < changes; i++) {
                /* half of them in the header */
                const size_t range = round % 2 && size > 400 ? 400 : size;
                const size_t place = (size_t)(noise(seed++) * (float)range);
                spoilt[place < size ? place : 0] = (unsigned char)(noise(seed++) * 256);
            }
            write_bytes(in_folder(name), spoilt, size);
            (void)try_read(name);
        }
        free(spoilt);
        free(bytes);
        empty_folder(state);
    }
}

static void garbage(void **state)
{
    (void)state;
    static const char *const names[] = {"a.exr",  "a.png", "a.tif", "a.dpx", "a.jpg",
                                        "a.hdr",  "a.tga", "a.bmp", "a.ppm", "a.cin",
                                        "a.webp", "a.jp2", "a.foo"};
    unsigned char bytes[3000];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (unsigned char)(noise((uint32_t)i) * 256);
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        write_bytes(in_folder(names[i]), bytes, 0);
        assert_int_equal(try_read(names[i]), WO_ERR_FORMAT);
        assert_non_null(strstr(fault.text, "empty"));
        for (size_t length = 1; length <= sizeof bytes; length = length * 2 + 1) {
            write_bytes(in_folder(names[i]), bytes, length);
            assert_int_equal(try_read(names[i]), WO_ERR_FORMAT);
        }
    }
    bytes[0] = 0x76; /* the mark of an EXR and then nothing of it, whatever the name */
    bytes[1] = 0x2f;
    bytes[2] = 0x31;
    bytes[3] = 0x01;
    for (size_t length = 4; length <= sizeof bytes; length += 17) {
        write_bytes(in_folder("a.png"), bytes, length);
        assert_int_equal(try_read("a.png"), WO_ERR_FORMAT);
    }
}

/* Overwrites four numbers after a name in an EXR header. */
static void patch_box(unsigned char *bytes, size_t size, const char *attribute,
                      const int32_t box[4])
{
    const size_t length = strlen(attribute) + 1;
    for (size_t i = 0; i + length + 26 < size; i++)
        if (!memcmp(bytes + i, attribute, length)) {
            unsigned char *at = bytes + i + length + sizeof "box2i" + 4;
            for (int k = 0; k < 4; k++)
                for (int b = 0; b < 4; b++)
                    *at++ = (unsigned char)((uint32_t)box[k] >> (8 * b));
            return;
        }
    fail_msg("no %s in the header", attribute);
}

static void absurd_sizes(void **state)
{
    (void)state;
    static const struct {
        int32_t box[4];
        wo_status wanted;
    } cases[] = {
        {{0, 0, 999999, 999999}, WO_ERR_RANGE},
        {{0, 0, 65536, 10}, WO_ERR_RANGE},
        {{0, 0, 65535, 65535}, WO_ERR_FORMAT}, /* allowed, but not in so short a file */
        {{0, 0, 4, 65535}, WO_ERR_FORMAT},
        {{-2147483647, -2147483647, 2147483647, 2147483647}, WO_ERR_FORMAT},
        {{5, 0, 4, 6}, WO_ERR_FORMAT},
        {{100000000, 0, 100000004, 6}, WO_ERR_RANGE},
    };
    const char *name;
    size_t size;
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        unsigned char *const bytes = make_file(1, &name, &size);
        patch_box(bytes, size, "dataWindow", cases[i].box);
        write_bytes(in_folder("a.exr"), bytes, size);
        const wo_status got = try_read("a.exr");
        if (got != cases[i].wanted && got != WO_ERR_RANGE)
            fail_msg("case %zu: %s, %s", i, wo_status_text(got), fault.text);
        free(bytes);
    }
    unsigned char *const bytes = make_file(1, &name, &size);
    patch_box(bytes, size, "displayWindow", cases[0].box);
    write_bytes(in_folder("a.exr"), bytes, size);
    assert_int_equal(try_read("a.exr"), WO_ERR_RANGE);
    free(bytes);

    /* a PNG header of 65000 x 65000 and nothing behind it */
    static const unsigned char png[] = {0x89, 'P',  'N', 'G', 13,  10, 26, 10,   0,    0,    0,
                                        13,   'I',  'H', 'D', 'R', 0,  0,  0xfd, 0xe8, 0,    0,
                                        0xfd, 0xe8, 8,   6,   0,   0,  0,  0x9c, 0xaf, 0x24, 0x2c};
    write_bytes(in_folder("a.png"), png, sizeof png);
    assert_int_equal(try_read("a.png"), WO_ERR_FORMAT);
}

static void places_that_are_none(void **state)
{
    (void)state;
    wo_io_file *file = NULL;
    wo_io_part part = noisy_part(8, 8);
    char long_path[6000];
    memset(long_path, 'x', sizeof long_path);
    strcpy(long_path + sizeof long_path - 5, ".exr");

    assert_fault(wo_io_read(in_folder("missing.exr"), false, &file, &fault), WO_ERR_IO,
                 "missing.exr: No such file");
    assert_fault(wo_io_read(in_folder("no/a.exr"), false, &file, &fault), WO_ERR_IO, "No such");
    assert_fault(wo_io_read(test_folder, false, &file, &fault), WO_ERR_IO, "no ordinary file");
    assert_fault(wo_io_read("", false, &file, &fault), WO_ERR_ARGUMENT, "no file name");
    assert_fault(wo_io_read(NULL, false, &file, &fault), WO_ERR_ARGUMENT, "no file name");
    assert_fault(wo_io_read(long_path, false, &file, &fault), WO_ERR_IO,
                 ".exr: File name too long");
    assert_int_equal(mkfifo(in_folder("pipe.exr"), 0600), 0);
    assert_fault(wo_io_read(in_folder("pipe.exr"), false, &file, &fault), WO_ERR_IO,
                 "no ordinary file");
    unlink(in_folder("pipe.exr"));

    static const char *const names[] = {"no/a.exr", "no/a.png"};
    for (int i = 0; i < 2; i++)
        assert_fault(wo_io_write(in_folder(names[i]), &part, 1, WO_IO_AUTO, &fault), WO_ERR_IO,
                     "No such file");
    write_bytes(in_folder("file"), "x", 1);
    assert_fault(wo_io_write(in_folder("file/a.exr"), &part, 1, WO_IO_AUTO, &fault), WO_ERR_IO,
                 "Not a directory");
    assert_int_equal(mkdir(in_folder("folder.exr"), 0700), 0);
    assert_fault(wo_io_write(in_folder("folder.exr"), &part, 1, WO_IO_AUTO, &fault), WO_ERR_IO,
                 "no ordinary file");
    rmdir(in_folder("folder.exr"));
    /* a device is never replaced by a file */
    assert_int_equal(symlink("/dev/full", in_folder("full.exr")), 0);
    assert_fault(wo_io_write(in_folder("full.exr"), &part, 1, WO_IO_AUTO, &fault), WO_ERR_IO,
                 "no ordinary file");
    struct stat about;
    assert_int_equal(stat("/dev/full", &about), 0);
    assert_true(S_ISCHR(about.st_mode));
    assert_int_equal(count_files(false), 2);
    wo_io_part_clear(&part);
}

/* A folder nobody may write to, also for root, who becomes somebody else for a moment. */
static void protected_folder(void **state)
{
    (void)state;
    wo_io_part part = noisy_part(8, 8);
    static const char *const names[] = {"a.exr", "a.png"};
    const uid_t me = geteuid();
    assert_int_equal(chmod(test_folder, 0555), 0);
    if (me == 0)
        assert_int_equal(seteuid(65534), 0);
    wo_status got[2];
    for (int i = 0; i < 2; i++)
        got[i] = wo_io_write(in_folder(names[i]), &part, 1, WO_IO_AUTO, &fault);
    if (me == 0)
        assert_int_equal(seteuid(me), 0);
    assert_int_equal(chmod(test_folder, 0700), 0);
    assert_int_equal(got[0], WO_ERR_IO);
    assert_int_equal(got[1], WO_ERR_IO);
    assert_non_null(strstr(fault.text, "Permission denied"));
    assert_int_equal(count_files(false), 0);
    wo_io_part_clear(&part);
}

/* A disk that is full after any number of bytes: the older file stays, and nothing else is left. */
static void full_disk(void **state)
{
    (void)state;
    static const char *const names[] = {"a.exr", "a.png", "a.tif", "a.dpx", "a.jpg",
                                        "a.hdr", "a.tga", "a.bmp", "a.ppm"};
    struct rlimit before, tight;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        wo_io_part part = noisy_part(40, 40), small = noisy_part(1, 1);
        size_t size, full;
        unsigned char *bytes = NULL;
        assert_ok(wo_io_write(in_folder(names[i]), &part, 1, WO_IO_AUTO, &fault));
        free(read_bytes(in_folder(names[i]), &full));
        assert_ok(wo_io_write(in_folder(names[i]), &small, 1, WO_IO_AUTO, &fault));
        unsigned char *const old = read_bytes(in_folder(names[i]), &size);
        for (size_t limit = 0; limit < full; limit += 1 + full / 23) {
            tight = before;
            tight.rlim_cur = limit;
            assert_int_equal(setrlimit(RLIMIT_FSIZE, &tight), 0);
            const wo_status got = wo_io_write(in_folder(names[i]), &part, 1, WO_IO_AUTO, &fault);
            assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
            if (got != WO_ERR_IO || !strstr(fault.text, "File too large"))
                fail_msg("%s, %zu of %zu bytes: %s, %s", names[i], limit, full, wo_status_text(got),
                         fault.text);
            size_t now;
            bytes = read_bytes(in_folder(names[i]), &now);
            assert_int_equal(now, size);
            assert_memory_equal(bytes, old, size);
            free(bytes);
            assert_int_equal(count_files(false), 1);
        }
        free(old);
        wo_io_part_clear(&part);
        wo_io_part_clear(&small);
        empty_folder(state);
    }
}

static void older_files(void **state)
{
    (void)state;
    wo_io_part part = noisy_part(8, 8);
    struct stat about;
    /* a mistake in the part leaves the older file as it is */
    write_bytes(in_folder("a.exr"), "old", 3);
    part.channel_names[1][0] = 'R';
    assert_fault(wo_io_write(in_folder("a.exr"), &part, 1, WO_IO_AUTO, &fault), WO_ERR_ARGUMENT,
                 "two channels");
    part.channel_names[1][0] = 'G';
    size_t size;
    unsigned char *const bytes = read_bytes(in_folder("a.exr"), &size);
    assert_int_equal(size, 3);
    free(bytes);
    assert_int_equal(count_files(false), 1);

    /* permissions of the older file are kept, a link is followed */
    assert_int_equal(chmod(in_folder("a.exr"), 0640), 0);
    assert_int_equal(symlink("a.exr", in_folder("link.exr")), 0);
    assert_ok(wo_io_write(in_folder("link.exr"), &part, 1, WO_IO_AUTO, &fault));
    assert_int_equal(lstat(in_folder("link.exr"), &about), 0);
    assert_true(S_ISLNK(about.st_mode));
    assert_int_equal(stat(in_folder("a.exr"), &about), 0);
    assert_int_equal(about.st_mode & 0777, 0640);
    assert_true(about.st_size > 300);
    assert_int_equal(count_files(false), 2);

    /* a new file has the permissions of any new file */
    const mode_t mask = umask(027);
    assert_ok(wo_io_write(in_folder("b.exr"), &part, 1, WO_IO_AUTO, &fault));
    umask(mask);
    assert_int_equal(stat(in_folder("b.exr"), &about), 0);
    assert_int_equal(about.st_mode & 0777, 0640);
    wo_io_part_clear(&part);
}

static void no_error_is_wanted(void **state)
{
    (void)state;
    wo_io_file *file = NULL;
    wo_image image;
    assert_int_equal(wo_io_read(in_folder("missing.exr"), false, &file, NULL), WO_ERR_IO);
    wo_io_part part = noisy_part(4, 4);
    assert_int_equal(wo_io_write(in_folder("no/a.png"), &part, 1, WO_IO_AUTO, NULL), WO_ERR_IO);
    wo_io_part_clear(&part);
    assert_int_equal(wo_io_file_create(1, &file, NULL), WO_OK);
    assert_int_equal(wo_io_part_init(file->parts, NULL, (wo_rect){0, 0, 1, 1},
                                     (wo_rect){0, 0, 1, 1}, rgba, 4, NULL),
                     WO_OK);
    assert_int_equal(wo_io_select(file, "Q", &image, NULL, NULL), WO_ERR_NOT_FOUND);
    wo_io_file_destroy(&file);
    wo_io_file_destroy(&file);
    wo_io_file_destroy(NULL);
    wo_io_part_clear(NULL);
}

int main(void)
{
    wo_io_files_per_process(64, true);
#define TEST(name) cmocka_unit_test_setup(name, empty_folder)
    const struct CMUnitTest tests[] = {
        TEST(cut_files),    TEST(spoilt_files),         TEST(garbage),
        TEST(absurd_sizes), TEST(places_that_are_none), TEST(protected_folder),
        TEST(full_disk),    TEST(older_files),          TEST(no_error_is_wanted),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
