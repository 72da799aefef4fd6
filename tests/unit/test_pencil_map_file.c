/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bridge_test.h"

#include "ofx_host_stub/cli/pencil_map_file.h"

static const double lines[] = {405.25, 486.1327, 587.5618, 656.2725, 700};

static wo_pencil_map *sample(void)
{
    wo_diagram d;
    wo_pencil_map *map = NULL;
    assert_int_equal(wo_diagram_make(WO_DIAGRAM_ACHROMAT_A, 50, 1.8, 1, &d, NULL), WO_OK);
    assert_int_equal(
        wo_pencil_map_create(NULL, &d, 123.456, -1.1, 2.3, 21, 33, lines, 5, &map, NULL), WO_OK);
    return map;
}

static void round_trip(void **state)
{
    (void)state;
    wo_pencil_map *map = sample(), *back = NULL;
    assert_ok(wo_pencil_map_save(in_folder("map.exr"), map, &fault));
    assert_ok(wo_pencil_map_load(NULL, in_folder("map.exr"), &back, &fault));
    assert_int_equal(back->distances, 21);
    assert_int_equal(back->radii, 33);
    assert_int_equal(back->lines, 5);
    assert_true(back->k == map->k && back->v_low == map->v_low && back->v_high == map->v_high);
    assert_memory_equal(back->nm, map->nm, sizeof lines);
    assert_memory_equal(back->density, map->density, 5 * 21 * 33 * sizeof(float));
    for (int i = 0; i < 5 * 21; i++)
        assert_true(fabs(back->height[i] - map->height[i]) <= 1e-7 * map->height[i]);
    assert_true(fabs(wo_pencil_map_at(back, 0.7, 50, 555) - wo_pencil_map_at(map, 0.7, 50, 555)) <
                1e-5);
    wo_pencil_map_destroy(NULL, &back);
    wo_pencil_map_destroy(NULL, &map);
}

static void expect_refused(const char *name)
{
    wo_pencil_map *map = NULL;
    assert_int_equal(wo_pencil_map_load(NULL, name, &map, &fault), WO_ERR_FORMAT);
    assert_null(map);
    assert_true(fault.text[0] != 0);
}

typedef void change(wo_io_file *file);

static void no_scale(wo_io_file *file)
{
    assert_int_equal(wo_io_part_set_text(&file->parts[0], "wideopen:pencilScale", "x", NULL),
                     WO_OK);
}

static void scale_zero(wo_io_file *file)
{
    assert_int_equal(wo_io_part_set_number(&file->parts[0], "wideopen:pencilScale", 0, NULL),
                     WO_OK);
}

static void falling_lines(wo_io_file *file)
{
    assert_int_equal(wo_io_part_set_number(&file->parts[0], "wideopen:pencilL003", 450, NULL),
                     WO_OK);
}

static void upside_down(wo_io_file *file)
{
    assert_int_equal(wo_io_part_set_number(&file->parts[0], "wideopen:pencilLow", 5, NULL), WO_OK);
}

static void no_height(wo_io_file *file)
{
    strcpy(file->parts[1].name, "heighT");
}

static void channel_gone(wo_io_file *file)
{
    strcpy(file->parts[1].channel_names[4], "L999");
}

static void not_a_number(wo_io_file *file)
{
    file->parts[0].pixels[100] = NAN;
}

static void negative(wo_io_file *file)
{
    file->parts[1].pixels[7] = -1;
}

static void brighter(wo_io_file *file)
{
    file->parts[0].pixels[5 * 33 * 3 + 5 * 20] += 1;
}

static void wider(wo_io_file *file)
{
    static const char *const channels[] = {"L000", "L001", "L002", "L003", "L004"};
    const wo_rect two = {0, 0, 2, 21};
    assert_int_equal(wo_io_part_init(&file->parts[1], "height", two, two, channels, 5, NULL),
                     WO_OK);
}

static void fewer_channels(wo_io_file *file)
{
    static const char *const channels[] = {"L000"};
    const wo_rect one = {0, 0, 1, 21};
    assert_int_equal(wo_io_part_init(&file->parts[1], "height", one, one, channels, 1, NULL),
                     WO_OK);
}

static void hostile(void **state)
{
    (void)state;
    static change *const changes[] = {no_scale,  scale_zero,   falling_lines, upside_down,
                                      no_height, channel_gone, not_a_number,  negative,
                                      brighter,  wider,        fewer_channels};
    wo_pencil_map *map = sample();
    const char *const whole = in_folder("whole.exr"), *const changed = in_folder("changed.exr");
    assert_int_equal(wo_pencil_map_save(whole, map, NULL), WO_OK);
    wo_pencil_map_destroy(NULL, &map);
    for (size_t i = 0; i < WO_COUNT(changes); i++) {
        wo_io_file *file = NULL;
        assert_int_equal(wo_io_read(whole, false, &file, NULL), WO_OK);
        changes[i](file);
        assert_int_equal(wo_io_write(changed, file->parts, file->part_count, WO_IO_SINGLE, NULL),
                         WO_OK);
        wo_io_file_destroy(&file);
        expect_refused(changed);
    }
    wo_io_part picture = {0};
    static const char *const rgb[] = {"R", "G", "B"};
    const wo_rect frame = {0, 0, 4, 4};
    assert_int_equal(wo_io_part_init(&picture, NULL, frame, frame, rgb, 3, NULL), WO_OK);
    assert_int_equal(wo_io_write(changed, &picture, 1, WO_IO_AUTO, NULL), WO_OK);
    wo_io_part_clear(&picture);
    expect_refused(changed);
    /* Cut anywhere, or with a byte turned over: an error, or a map that is legal. */
    size_t size;
    unsigned char *const bytes = read_bytes(whole, &size);
    assert_true(size > 1000);
    for (size_t at = 0; at < size; at += 97) {
        for (int cut = 0; cut < 2; cut++) {
            bytes[at] ^= 0x5a;
            write_bytes(changed, bytes, cut ? at : size);
            bytes[at] ^= 0x5a;
            wo_pencil_map *got = NULL;
            if (wo_pencil_map_load(NULL, changed, &got, &fault) == WO_OK)
                assert_int_equal(wo_pencil_map_validate(got, NULL), WO_OK);
            else
                assert_true(!got && fault.text[0] != 0);
            wo_pencil_map_destroy(NULL, &got);
        }
    }
    free(bytes);
    assert_int_equal(wo_pencil_map_load(NULL, in_folder("none.exr"), &map, NULL), WO_ERR_IO);
}

static void bad_map_is_not_written(void **state)
{
    (void)state;
    wo_pencil_map *map = sample();
    map->k = 0;
    assert_int_equal(wo_pencil_map_save(in_folder("bad.exr"), map, NULL), WO_ERR_RANGE);
    assert_int_equal(access(in_folder("bad.exr"), F_OK), -1);
    wo_pencil_map_destroy(NULL, &map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_trip),
        cmocka_unit_test(hostile),
        cmocka_unit_test(bad_map_is_not_written),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
