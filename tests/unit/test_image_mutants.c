/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _GNU_SOURCE
#include "bridge_test.h"

#include "exr_samples.h"
#include "tests/property/cases.h"

#include <strings.h>
#include <time.h>

/* Image files changed at random: each is read or refused in words, and nothing else.

   usage: test_image_mutants [CASES [SEED [FORMAT]]]
   CASES of all formats together (a few hundred), SEED of the first (1). Prints a line for each
   format; the file of a case that goes wrong is kept and named. Several processes with different
   seeds read different files. */

/* Random numbers: xorshift64*. */

static uint64_t random_state;

static uint32_t random_word(void)
{
    random_state ^= random_state >> 12;
    random_state ^= random_state << 25;
    random_state ^= random_state >> 27;
    return (uint32_t)((random_state * 0x2545f4914f6cdd1dull) >> 32);
}

static size_t random_below(size_t end)
{
    return end ? random_word() % end : 0;
}

/* Sound files to begin with. */

typedef struct seed {
    char name[16];
    unsigned char *bytes;
    size_t size;
} seed;

enum { SEEDS_MAX = 64, SIZE_MAX_OF_CASE = 1 << 16 };

static seed seeds[SEEDS_MAX];
static size_t seed_count;

static void add_seed(const char *name, const void *bytes, size_t size)
{
    assert_true(seed_count < SEEDS_MAX);
    seed *const made = &seeds[seed_count++];
    snprintf(made->name, sizeof made->name, "%s", name);
    made->bytes = malloc(size);
    assert_non_null(made->bytes);
    memcpy(made->bytes, bytes, size);
    made->size = size;
}

static void write_seed(const char *name, const char *compression, wo_io_depth depth, int channels)
{
    static const char *const names[] = {"R", "G", "B", "A"};
    static const char *const grey[] = {"Y", "A"};
    const wo_rect frame = {0, 0, 19, 21};
    wo_io_part part = {0};
    size_t size;
    assert_ok(wo_io_part_init(&part, "part", frame, frame, channels < 3 ? grey : names, channels,
                              &fault));
    assert_ok(wo_io_part_set_text(&part, "owner", "somebody", &fault));
    if (compression)
        assert_ok(wo_io_part_set_text(&part, "compression", compression, &fault));
    fill_noise(&part, 0, 1);
    for (size_t i = 0; i < (size_t)(19 * 10 * channels); i++)
        part.pixels[i] = 0.25f; /* something to pack */
    assert_ok(wo_io_write(in_folder(name), &part, 1, depth, &fault));
    unsigned char *const bytes = read_bytes(in_folder(name), &size);
    add_seed(name, bytes, size);
    free(bytes);
    wo_io_part_clear(&part);
}

static void put_number(unsigned char *to, uint32_t value, int bytes, bool low_first)
{
    for (int i = 0; i < bytes; i++)
        to[low_first ? i : bytes - 1 - i] = (unsigned char)(value >> (8 * i));
}

/* Cineon: 16 x 4, three channels of 10 bits. */
static void add_cineon(void)
{
    static unsigned char bytes[2048 + 16 * 4 * 4];
    put_number(bytes, 0x802a5fd7u, 4, false);
    put_number(bytes + 4, 2048, 4, false);
    put_number(bytes + 8, 1024, 4, false);
    put_number(bytes + 12, 1024, 4, false);
    put_number(bytes + 20, sizeof bytes, 4, false);
    memcpy(bytes + 24, "V4.5", 4);
    bytes[193] = 3;
    for (int c = 0; c < 3; c++) {
        unsigned char *const channel = bytes + 196 + 28 * c;
        channel[1] = (unsigned char)(c + 1);
        channel[2] = 10;
        put_number(channel + 4, 16, 4, false);
        put_number(channel + 8, 4, 4, false);
    }
    bytes[680 + 1] = 5;
    for (size_t i = 2048; i < sizeof bytes; i++)
        bytes[i] = (unsigned char)random_word();
    add_seed("a.cin", bytes, sizeof bytes);
}

/* BMP of a palette: 16 x 8, plain or packed in runs, 1, 4 or 8 bits. */
static void add_bmp(uint32_t bits, uint32_t packing)
{
    unsigned char bytes[54 + 1024 + 512] = {'B', 'M'};
    const uint32_t colours = 1u << bits, start = 54 + 4 * colours;
    const uint32_t picture = packing ? 8 * 6 + 2 : 8 * ((16 * bits + 31) / 32 * 4);
    put_number(bytes + 2, start + picture, 4, true);
    put_number(bytes + 10, start, 4, true);
    put_number(bytes + 14, 40, 4, true);
    put_number(bytes + 18, 16, 4, true);
    put_number(bytes + 22, 8, 4, true);
    put_number(bytes + 26, 1, 2, true);
    put_number(bytes + 28, bits, 2, true);
    put_number(bytes + 30, packing, 4, true);
    put_number(bytes + 34, picture, 4, true);
    put_number(bytes + 46, colours, 4, true);
    for (uint32_t i = 54; i < start; i++)
        bytes[i] = (unsigned char)random_word();
    unsigned char *at = bytes + start;
    for (uint32_t i = 0; !packing && i < picture; i++)
        *at++ = (unsigned char)random_word();
    for (int line = 0; packing && line < 8; line++) {
        const unsigned char runs[6] = {9, (unsigned char)line, 7, 1, 0, 0};
        memcpy(at, runs, sizeof runs);
        at += sizeof runs;
    }
    if (packing)
        at[1] = 1;
    add_seed("a.bmp", bytes, start + picture);
}

/* TGA of type 1 to 3, plus 8 for runs: 16 x 8. */
static void add_tga(unsigned type, unsigned bits)
{
    unsigned char bytes[18 + 256 * 3 + 16 * 8 * 5] = {0};
    const bool palette = (type & 7) == 1;
    const unsigned pixel = (bits + 7) / 8;
    unsigned char *at = bytes + 18;
    bytes[2] = (unsigned char)type;
    if (palette) {
        bytes[1] = 1;
        put_number(bytes + 5, 256, 2, true);
        bytes[7] = 24;
        for (int i = 0; i < 256 * 3; i++)
            *at++ = (unsigned char)random_word();
    }
    put_number(bytes + 12, 16, 2, true);
    put_number(bytes + 14, 8, 2, true);
    bytes[16] = (unsigned char)bits;
    for (int run = 0; run < 16; run++) { /* half a line each */
        if (type & 8)
            *at++ = run % 2 ? 0x87 : 7;
        const unsigned count = type & 8 && run % 2 ? 1 : 8;
        for (unsigned i = 0; i < count * pixel; i++)
            *at++ = (unsigned char)random_word();
    }
    add_seed("a.tga", bytes, (size_t)(at - bytes));
}

static void make_seeds(void)
{
    for (int channels = 1; channels <= 4; channels++) {
        write_seed("a.png", NULL, WO_IO_BYTE, channels);
        write_seed("a.png", NULL, WO_IO_SHORT, channels);
        write_seed("a.tif", NULL, WO_IO_BYTE, channels);
        if (channels == 2)
            continue;
        write_seed("a.tif", NULL, channels == 3 ? WO_IO_SINGLE : WO_IO_SHORT, channels);
        write_seed("a.dpx", NULL, channels == 4 ? WO_IO_SHORT : WO_IO_AUTO, channels);
        write_seed("a.tga", NULL, WO_IO_BYTE, channels);
    }
    write_seed("a.hdr", NULL, WO_IO_SINGLE, 3);
    write_seed("a.bmp", NULL, WO_IO_BYTE, 3);
    add_bmp(1, 0);
    add_bmp(4, 0);
    add_bmp(8, 0);
    add_bmp(8, 1);
    add_bmp(4, 2);
    add_tga(1, 8);
    add_tga(2, 16);
    add_tga(2, 32);
    add_tga(9, 8);
    add_tga(10, 24);
    add_tga(11, 8);
    add_cineon();
    static const char *const packings[] = {"none", "rle", "zips", "zip", "piz"};
    for (size_t i = 0; i < WO_COUNT(packings); i++)
        write_seed("a.exr", packings[i], i % 2 ? WO_IO_HALF : WO_IO_SINGLE, i < 2 ? 2 : 4);
#if !defined(__SANITIZE_ADDRESS__)
    /* through the other library, which takes what memory it likes where there is no limit of it */
    add_seed("a.exr", dwa_file, sizeof dwa_file);
    add_seed("a.exr", b44_file, sizeof b44_file);
#endif
    add_seed("a.exr", deep_tiles, sizeof deep_tiles);
    add_seed("a.exr", deep_lines, sizeof deep_lines);
}

/* Changes. */

static unsigned char work[SIZE_MAX_OF_CASE];
static size_t work_size;

/* A place, as often in the first bytes as anywhere. */
static size_t some_place(size_t bytes)
{
    static const size_t heads[] = {32, 128, 1024, SIZE_MAX_OF_CASE};
    const size_t head = heads[random_below(WO_COUNT(heads))];
    const size_t end = work_size < head ? work_size : head;
    return end > bytes ? random_below(end - bytes) : 0;
}

static void change_number(void)
{
    static const uint32_t values[] = {0,      1,          2,          0x7f,       0x80,
                                      0xff,   0x7fff,     0x8000,     0xffff,     0x10000,
                                      100000, 0x7fffffff, 0x80000000, 0xffffffff, 0xfffffff0};
    const int bytes = 1 << random_below(3);
    if (work_size < 4)
        return;
    put_number(work + some_place(4), values[random_below(WO_COUNT(values))], bytes,
               random_word() & 1);
}

static void move_block(void)
{
    const size_t from = some_place(1), to = some_place(1);
    const size_t most = work_size - (from > to ? from : to);
    const size_t bytes = random_below(most < 64 ? most : 64);
    memmove(work + to, work + from, bytes);
}

static void cut_out(void)
{
    const size_t at = some_place(1), most = work_size - at;
    const size_t bytes = random_below(most < 64 ? most : 64);
    memmove(work + at, work + at + bytes, work_size - at - bytes);
    work_size -= bytes;
}

static void put_in(void)
{
    const size_t at = some_place(1), bytes = random_below(64);
    if (work_size + bytes > sizeof work)
        return;
    memmove(work + at + bytes, work + at, work_size - at);
    for (size_t i = 0; i < bytes; i++)
        work[at + i] = (unsigned char)random_word();
    work_size += bytes;
}

static void change_once(void)
{
    if (work_size < 2)
        return;
    switch (random_below(8)) {
    case 0:
    case 1:
        work[some_place(1)] ^= (unsigned char)(1u << random_below(8));
        break;
    case 2:
        work[some_place(1)] = (unsigned char)random_word();
        break;
    case 3:
    case 4:
        change_number();
        break;
    case 5:
        move_block();
        break;
    case 6:
        cut_out();
        break;
    default:
        put_in();
    }
}

static uint32_t crc_of(const unsigned char *bytes, size_t size)
{
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

/* Sums of a PNG's chunks that are right again: the reader looks behind them. */
static void mend_png(void)
{
    for (size_t at = 8; at + 12 <= work_size;) {
        const size_t length = (size_t)work[at] << 24 | (size_t)work[at + 1] << 16 |
                              (size_t)work[at + 2] << 8 | work[at + 3];
        if (length > work_size - at - 12)
            break;
        put_number(work + at + 8 + length, crc_of(work + at + 4, length + 4), 4, false);
        at += 12 + length;
    }
}

static void make_case(const seed *from)
{
    memcpy(work, from->bytes, from->size);
    work_size = from->size;
    const size_t changes = 1 + random_below(random_below(4) ? 3 : 12);
    for (size_t i = 0; i < changes; i++)
        change_once();
    if (random_below(16) == 0)
        work_size = random_below(work_size);
    if (!strcmp(from->name, "a.png") && random_below(4))
        mend_png();
    if (work_size == 0)
        work[work_size++] = 0;
}

/* Reading. */

typedef struct tally {
    const char *format;
    long cases, read, crashes, memory, late;
    double longest;
} tally;

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void keep_case(const seed *from, long number, const char *why)
{
    char name[64];
    snprintf(name, sizeof name, "kept-%ld.%s", number, strrchr(from->name, '.') + 1);
    write_bytes(in_folder(name), work, work_size);
    printf("case %ld, %s: %s\n", number, in_folder(name), why);
}

static const char *what_is_wrong(const wo_io_file *file, wo_status status)
{
    if ((status == WO_OK) != (file != NULL))
        return "a file and a failure at once, or neither";
    if (status != WO_OK && !fault.text[0])
        return "refused without a word";
    if (status == WO_ERR_LIBRARY || status == WO_ERR_INTERNAL || status == WO_ERR_IO)
        return fault.text;
    bool any = false;
    for (size_t i = 0; file && i < file->part_count; i++) {
        if (!file->parts[i].pixels == !file->parts[i].fault)
            return "pixels and a fault at once, or neither";
        any |= file->parts[i].pixels != NULL;
    }
    return file && !any ? "no part has pixels" : NULL;
}

static bool run_case(const seed *from, long number, tally *sum)
{
    wo_io_file *file = NULL;
    fault.text[0] = '\0';
    make_case(from);
    write_bytes(in_folder(from->name), work, work_size);
    const double begin = seconds();
    const wo_status status = wo_io_read(in_folder(from->name), false, &file, &fault);
    const double took = seconds() - begin;
    const char *const wrong = what_is_wrong(file, status);
    if (status == WO_OK)
        sum->read++;
    else if (strstr(fault.text, "crashed") || strstr(fault.text, "without a word"))
        sum->crashes++;
    else if (strstr(fault.text, "far more memory"))
        sum->memory++;
    else if (strstr(fault.text, "was stopped") || strstr(fault.text, "said nothing"))
        sum->late++;
    sum->cases++;
    if (took > sum->longest)
        sum->longest = took;
    wo_io_file_destroy(&file);
    if (wrong)
        keep_case(from, number, wrong);
    else if (getenv("WO_TEST_KEEP") && strstr(fault.text, getenv("WO_TEST_KEEP")))
        keep_case(from, number, fault.text);
    return !wrong;
}

static long cases_wanted;
static uint64_t first_seed = 1;
static const char *only;

static void mutants(void **state)
{
    static const char *const formats[] = {"png", "tif", "dpx", "cin", "tga", "bmp", "hdr", "exr"};
    long faults = 0, number = 0;
    (void)state;
    random_state = 0x9e3779b97f4a7c15ull;
    make_seeds();
    for (size_t f = 0; f < WO_COUNT(formats); f++) {
        const seed *mine[SEEDS_MAX];
        size_t count = 0;
        tally sum = {.format = formats[f]};
        for (size_t i = 0; i < seed_count; i++)
            if (!strcmp(seeds[i].name + 2, formats[f]))
                mine[count++] = &seeds[i];
        assert_true(count > 0);
        if (only && strcmp(only, formats[f]))
            continue;
        for (long i = 0; i < cases_wanted / (long)WO_COUNT(formats); i++, number++) {
            random_state = (first_seed << 32) + f * 0xbf58476d1ce4e5b9ull +
                           (uint64_t)number * 0x9e3779b97f4a7c15ull + 1;
            (void)random_word();
            faults += !run_case(mine[(size_t)i % count], number, &sum);
        }
        printf("%s: %ld cases, %ld read, %ld refused; readers: %ld crashed, %ld wanted too much "
               "memory, %ld too slow; longest %.3f s\n",
               sum.format, sum.cases, sum.read, sum.cases - sum.read, sum.crashes, sum.memory,
               sum.late, sum.longest);
        (void)fflush(stdout);
    }
    for (size_t i = 0; i < seed_count; i++)
        free(seeds[i].bytes);
    assert_int_equal(faults, 0);
}

int main(int count, char **words)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(mutants)};
    cases_wanted = count > 1 ? strtol(words[1], NULL, 10) : cases_of(1600, 400);
    first_seed = count > 2 ? strtoull(words[2], NULL, 10) : 1;
    only = count > 3 ? words[3] : NULL;
    wo_io_files_per_process(256, true);
    return cmocka_run_group_tests(tests, make_folder, count > 1 ? NULL : remove_folder);
}
