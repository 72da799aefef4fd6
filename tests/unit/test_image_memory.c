/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "bridge_test.h"

#include "exr_samples.h"

/* Every allocation of the bridge, and of OpenEXRCore under it, fails once. The linker sends malloc,
   calloc and realloc of our objects here. */
void *__real_malloc(size_t bytes);
void *__real_calloc(size_t count, size_t bytes);
void *__real_realloc(void *memory, size_t bytes);
void *__wrap_malloc(size_t bytes);
void *__wrap_calloc(size_t count, size_t bytes);
void *__wrap_realloc(void *memory, size_t bytes);

static long until_failure = -1; /* allocations that still succeed; below 0 = all */
static bool failed;

static bool fails_now(void)
{
    if (until_failure < 0)
        return false;
    if (until_failure > 0) {
        until_failure--;
        return false;
    }
    failed = true;
    until_failure = -1;
    return true;
}

void *__wrap_malloc(size_t bytes)
{
    return fails_now() ? NULL : __real_malloc(bytes);
}

void *__wrap_calloc(size_t count, size_t bytes)
{
    return fails_now() ? NULL : __real_calloc(count, bytes);
}

void *__wrap_realloc(void *memory, size_t bytes)
{
    return fails_now() ? NULL : __real_realloc(memory, bytes);
}

/* Something that allocates; returns what came of it and leaves nothing behind. */
typedef wo_status (*action)(const void *what);

/* Runs the action with its first, second, ... allocation failing until none fails any more. */
static void fail_each(const char *name, action act, const void *what, int at_least)
{
    int count = 0;
    for (;; count++) {
        until_failure = count;
        failed = false;
        fault.status = WO_OK;
        const wo_status got = act(what);
        until_failure = -1;
        if (!failed) {
            if (got != WO_OK)
                fail_msg("%s: %s", name, fault.text);
            break;
        }
        if (got != WO_ERR_NOMEM)
            fail_msg("%s, allocation %d: %s, %s", name, count, wo_status_text(got), fault.text);
    }
    if (count < at_least)
        fail_msg("%s: only %d allocations", name, count);
}

static wo_status read_file(const void *what)
{
    wo_io_file *file = NULL;
    const wo_status status = wo_io_read(what, false, &file, &fault);
    assert_true((status == WO_OK) == (file != NULL));
    wo_io_file_destroy(&file);
    return status;
}

static wo_io_part parts[2];

static wo_status write_file(const void *what)
{
    const wo_status status =
        wo_io_write(what, parts, strstr(what, ".exr") ? 2 : 1, WO_IO_AUTO, &fault);
    assert_int_equal(count_files(false), status == WO_OK ? 1 : 0);
    count_files(true);
    return status;
}

static wo_status make_part(const void *what)
{
    static const char *const names[] = {"R", "G", "B"};
    const wo_rect frame = {0, 0, 4, 4};
    wo_io_file *file = NULL;
    wo_image image = {0};
    (void)what;
    wo_status status = wo_io_file_create(2, &file, &fault);
    if (status == WO_OK)
        status = wo_io_part_init(&file->parts[1], "name", frame, frame, names, 3, &fault);
    if (status == WO_OK)
        status = wo_io_part_set_number(&file->parts[1], "number", 1, &fault);
    if (status == WO_OK)
        status = wo_io_part_set_text(&file->parts[1], "text", "some", &fault);
    if (status == WO_OK)
        status = wo_io_part_set_text(&file->parts[1], "number", "other", &fault);
    if (status == WO_OK)
        status = wo_io_select(file, "name", &image, NULL, &fault);
    assert_true((status == WO_OK) == (image.data != NULL));
    free(image.data);
    wo_io_file_destroy(&file);
    return status;
}

static void fill_parts(void)
{
    static const char *const names[] = {
        "R", "G", "B", "Z", "a.layer.with.a.rather.long.name.R", "b.R", "b.G", "b.B"};
    static const struct {
        const char *name, *text, *kind;
    } texts[] = {{"owner", "me", ""},
                 {"multiView", "left\nright", "stringvector"},
                 {"floats", "1 2 3", "floatvector"},
                 {"worldToCamera", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "m44f"},
                 {"chromaticities", "0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329", "chromaticities"},
                 {"colorInteropID", "lin_rec709_scene", ""}};
    const wo_rect frame = {0, 0, 40, 40};
    for (int i = 0; i < 2; i++) {
        assert_ok(wo_io_part_init(&parts[i], i ? "second" : "first", frame, frame, names, i ? 8 : 3,
                                  &fault));
        fill_noise(&parts[i], 0, 1);
        assert_ok(wo_io_part_set_number(&parts[i], "number", 4, &fault));
        for (size_t t = 0; t < WO_COUNT(texts); t++) {
            char name[64], text[128], kind[32];
            snprintf(name, sizeof name, "%s", texts[t].name);
            snprintf(text, sizeof text, "%s", texts[t].text);
            snprintf(kind, sizeof kind, "%s", texts[t].kind);
            const wo_io_attribute attribute = {
                .name = name, .type = WO_IO_TEXT, .text = text, .kind = kind};
            assert_ok(wo_io_part_set(&parts[i], &attribute, &fault));
        }
    }
}

static void nothing_to_be_had(void **state)
{
    (void)state;
    fill_parts();
    fail_each("making a part", make_part, NULL, 15);
    fail_each("writing EXR", write_file, in_folder("a.exr"), 40);
    fail_each("writing PNG", write_file, in_folder("a.png"), 2);

    assert_ok(wo_io_write(in_folder("a.exr"), parts, 2, WO_IO_AUTO, &fault));
    fail_each("reading EXR", read_file, in_folder("a.exr"), 60);
    assert_ok(wo_io_write(in_folder("a.png"), parts, 1, WO_IO_AUTO, &fault));
    fail_each("reading PNG", read_file, in_folder("a.png"), 10);
    assert_ok(wo_io_write(in_folder("a.jpg"), parts, 1, WO_IO_AUTO, &fault));
    fail_each("reading JPEG", read_file, in_folder("a.jpg"), 10);
    write_bytes(in_folder("deep.exr"), deep_lines, sizeof deep_lines);
    fail_each("reading deep lines", read_file, in_folder("deep.exr"), 40);
    write_bytes(in_folder("deep.exr"), deep_tiles, sizeof deep_tiles);
    fail_each("reading deep tiles", read_file, in_folder("deep.exr"), 40);
    write_bytes(in_folder("dwa.exr"), dwa_file, sizeof dwa_file);
    fail_each("reading DWA", read_file, in_folder("dwa.exr"), 30);
    for (int i = 0; i < 2; i++)
        wo_io_part_clear(&parts[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup(nothing_to_be_had, empty_folder)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
