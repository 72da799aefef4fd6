/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "image_io_private.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Cut files that OpenImageIO's readers take for whole ones: they fill what is missing with grey
   (JPEG) or leave it (DPX). On a cut PNG the reader loses memory. */

static wo_status cut_off(const char *path, wo_error *error)
{
    return wo_fail(error, WO_ERR_FORMAT, "%s: the file ends too early", wo_io_shown(path));
}

/* Reads exactly size bytes at offset. */
static bool read_at(int fd, void *buffer, size_t size, uint64_t offset)
{
    size_t done = 0;
    while (done < size) {
        const ssize_t got = pread(fd, (char *)buffer + done, size - done, (off_t)(offset + done));
        if (got <= 0)
            return false;
        done += (size_t)got;
    }
    return true;
}

static uint32_t number(const unsigned char *at, int bytes, bool low_first)
{
    uint32_t value = 0;
    for (int i = 0; i < bytes; i++)
        value = value << 8 | at[low_first ? bytes - 1 - i : i];
    return value;
}

/* Bytes of a line of count samples, at least. */
static uint64_t dpx_line(uint64_t count, uint32_t bits, uint32_t packing)
{
    if (packing != 0 && bits == 10)
        return (count + 2) / 3 * 4;
    if (packing != 0 && bits == 12)
        return count * 2;
    return (count * bits + 7) / 8;
}

static wo_status check_dpx(const char *path, int fd, uint64_t size, wo_error *error)
{
    unsigned char head[812];
    if (!read_at(fd, head, sizeof head, 0))
        return cut_off(path, error);
    const bool low_first = !memcmp(head, "XPDS", 4);
    const uint32_t width = number(head + 772, 4, low_first);
    const uint32_t height = number(head + 776, 4, low_first);
    const uint32_t descriptor = head[800], bits = head[803];
    const uint32_t packing = number(head + 804, 2, low_first);
    const uint32_t user_bytes = number(head + 32, 4, low_first);
    if (user_bytes != UINT32_MAX && user_bytes > size) /* the library aborts on such a size */
        return cut_off(path, error);
    const bool packed_runs = number(head + 806, 2, low_first) == 1;
    const uint32_t start = number(head + 808, 4, low_first);
    const uint32_t samples = descriptor == 50 ? 3 : descriptor == 51 || descriptor == 52 ? 4 : 1;
    if (packed_runs || width > WO_MAX_SIDE || height > WO_MAX_SIDE)
        return WO_OK;
    const uint64_t line = dpx_line((uint64_t)width * samples, bits, packing);
    return start + line * height <= size ? WO_OK : cut_off(path, error);
}

/* Chunks must follow each other up to one called IEND. */
static wo_status check_png(const char *path, int fd, uint64_t size, wo_error *error)
{
    unsigned char head[8];
    for (uint64_t at = 8; read_at(fd, head, sizeof head, at);) {
        at += 12 + (uint64_t)number(head, 4, false);
        if (at > size)
            break;
        if (!memcmp(head + 4, "IEND", 4))
            return WO_OK;
    }
    return cut_off(path, error);
}

/* Does the mark begin a frame's header: SOF0 to SOF15 but for DHT, JPG and DAC? */
static bool is_jpeg_frame(unsigned char mark)
{
    return mark >= 0xc0 && mark <= 0xcf && mark != 0xc4 && mark != 0xc8 && mark != 0xcc;
}

/* Is there a mark that ends the picture, behind the first scan's header? Inside a scan 0xff is
   always followed by 0 or a mark. *samples is what the frame's header says. */
static bool jpeg_ends(const unsigned char *bytes, size_t size, uint64_t *samples)
{
    size_t at = 2;
    while (at + 4 <= size) {
        if (bytes[at] != 0xff)
            return false;
        const unsigned char mark = bytes[at + 1];
        if (mark == 0xff) {
            at++;
            continue;
        }
        if (is_jpeg_frame(mark) && at + 10 <= size)
            *samples = (uint64_t)number(bytes + at + 5, 2, false) *
                       number(bytes + at + 7, 2, false) * bytes[at + 9];
        at += 2 + number(bytes + at + 2, 2, false);
        if (mark == 0xda)
            break;
    }
    for (; at + 1 < size; at++)
        if (bytes[at] == 0xff && bytes[at + 1] == 0xd9)
            return true;
    return false;
}

static wo_status promise(const char *path, uint64_t samples, uint64_t *promised, wo_error *error)
{
    *promised = samples * sizeof(float);
    if (samples > WO_IO_MAX_BYTES / sizeof(float))
        return wo_fail(error, WO_ERR_RANGE, "%s: pixels need more than %llu GiB of memory",
                       wo_io_shown(path), (unsigned long long)(WO_IO_MAX_BYTES >> 30));
    return WO_OK;
}

/* A progressive JPEG is unpacked while its head is read: a short one of 65500 x 65500 takes seven
   gigabytes. No scan packs 4096 samples into a byte. */
static wo_status check_jpeg(const char *path, int fd, uint64_t size, uint64_t *promised,
                            wo_error *error)
{
    if (size > (uint64_t)1 << 31)
        return wo_fail(error, WO_ERR_FORMAT, "%s: too large for a JPEG", wo_io_shown(path));
    unsigned char *const bytes = malloc((size_t)size);
    if (!bytes)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for %s", wo_io_shown(path));
    uint64_t samples = 0;
    const bool whole =
        read_at(fd, bytes, (size_t)size, 0) && jpeg_ends(bytes, (size_t)size, &samples);
    free(bytes);
    WO_TRY(promise(path, samples, promised, error));
    if (whole && samples / 4096 > size)
        return wo_fail(error, WO_ERR_FORMAT, "%s: the file is too short for its picture",
                       wo_io_shown(path));
    return whole ? WO_OK : cut_off(path, error);
}

/* WebP and JPEG 2000 are unpacked while their heads are read, too; but a few bytes may be a large
   picture of one colour. */
static uint64_t webp_samples(int fd)
{
    unsigned char head[30];
    if (!read_at(fd, head, sizeof head, 0))
        return 0;
    uint64_t width = number(head + 26, 2, true) & 0x3fff; /* VP8, lossy */
    uint64_t height = number(head + 28, 2, true) & 0x3fff;
    if (!memcmp(head + 12, "VP8X", 4)) {
        width = 1 + (uint64_t)number(head + 24, 3, true);
        height = 1 + (uint64_t)number(head + 27, 3, true);
    } else if (!memcmp(head + 12, "VP8L", 4)) {
        const uint32_t both = number(head + 21, 4, true);
        width = 1 + (both & 0x3fff);
        height = 1 + (both >> 14 & 0x3fff);
    }
    return width * height * 4;
}

static uint64_t jp2_samples(int fd)
{
    unsigned char head[512] = {0};
    const ssize_t got = pread(fd, head, sizeof head, 0);
    for (ssize_t i = 0; i + 42 < got; i++) {
        if (!memcmp(head + i, "ihdr", 4)) /* the box of JP2 */
            return (uint64_t)number(head + i + 4, 4, false) * number(head + i + 8, 4, false) *
                   number(head + i + 12, 2, false);
        if (!memcmp(head + i, "\xff\x4f\xff\x51", 4)) { /* the start of a bare codestream */
            const uint64_t right = number(head + i + 8, 4, false);
            const uint64_t bottom = number(head + i + 12, 4, false);
            const uint64_t left = number(head + i + 16, 4, false);
            const uint64_t top = number(head + i + 20, 4, false);
            return right > left && bottom > top
                       ? (right - left) * (bottom - top) * number(head + i + 40, 2, false)
                       : 0;
        }
    }
    return 0;
}

wo_status wo_io_check_whole(const char *path, int fd, const wo_io_format *format,
                            uint64_t *promised, wo_error *error)
{
    struct stat about;
    *promised = 0;
    if (fstat(fd, &about))
        return wo_fail(error, WO_ERR_IO, "cannot read %s", wo_io_shown(path));
    if (!strcmp(format->library_name, "dpx"))
        return check_dpx(path, fd, (uint64_t)about.st_size, error);
    if (!strcmp(format->library_name, "png"))
        return check_png(path, fd, (uint64_t)about.st_size, error);
    if (!strcmp(format->library_name, "jpeg"))
        return check_jpeg(path, fd, (uint64_t)about.st_size, promised, error);
    if (!strcmp(format->library_name, "webp"))
        return promise(path, webp_samples(fd), promised, error);
    if (!strcmp(format->library_name, "jpeg2000"))
        return promise(path, jp2_samples(fd), promised, error);
    return WO_OK;
}
