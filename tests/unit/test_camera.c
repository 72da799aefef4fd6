/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/camera.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* A list of names and texts, ending with NULL. */
static wo_camera camera_of(const char *const *pairs)
{
    wo_camera camera = {0};
    for (; *pairs; pairs += 2)
        wo_camera_read(&camera, pairs[0], pairs[1]);
    return camera;
}

#define CAMERA(...) camera_of((const char *const[]){__VA_ARGS__, NULL})

static void assert_value(const wo_camera *camera, wo_camera_value value, double wanted)
{
    double number = NAN;
    const char *name = NULL;
    if (!wo_camera_get(camera, value, 100, &number, &name))
        fail_msg("%s is not known", wo_camera_key(value));
    if (!(fabs(number - wanted) <= 1e-12 * fabs(wanted)))
        fail_msg("%s is %.17g, not %.17g", wo_camera_key(value), number, wanted);
    assert_non_null(name);
}

static void assert_unknown(const wo_camera *camera, wo_camera_value value)
{
    double number = 17;
    const char *name = "untouched";
    assert_false(wo_camera_get(camera, value, 100, &number, &name));
    assert_true(number == 17);
    assert_string_equal(name, "untouched");
}

static const char *from(const wo_camera *camera, wo_camera_value value)
{
    double number;
    const char *name = "";
    wo_camera_get(camera, value, 1, &number, &name);
    return name;
}

/* Every spelling, and what it means with 100 units to the metre. */
static void every_spelling_is_read(void **state)
{
    static const struct {
        const char *name, *text;
        wo_camera_value value;
        double wanted;
    } rows[] = {
        {"wideopen:focalLength", "50", WO_CAMERA_FOCAL_LENGTH, 50},
        {"wideopen:sensorWidth", "36", WO_CAMERA_SENSOR_WIDTH, 36},
        {"wideopen:fStop", "1.4", WO_CAMERA_F_NUMBER, 1.4},
        {"wideopen:focusDistance", "2.5", WO_CAMERA_FOCUS, 2.5},
        {"wideopen:focusDistance", "0", WO_CAMERA_FOCUS, 0},
        {"wideopen:focusDistance", "-3", WO_CAMERA_FOCUS, -3},
        {"wideopen:near", "0.25", WO_CAMERA_NEAR, 0.25},
        {"wideopen:far", "80", WO_CAMERA_FAR, 80},
        {"wideopen:depthScale", "1000", WO_CAMERA_UNITS, 1000},
        {"unreal/camera/FinalImage/focalLength", "35.0", WO_CAMERA_FOCAL_LENGTH, 35},
        {"unreal/camera/FinalImage/sensorWidth", "23.76", WO_CAMERA_SENSOR_WIDTH, 23.76},
        {"unreal/CineCam/Final/fstop", "2.8", WO_CAMERA_F_NUMBER, 2.8},
        {"unreal/camera/FinalImage/focalDistance", "250", WO_CAMERA_FOCUS, 2.5},
        {"unreal/camera/FinalImage/focalDistance", "250", WO_CAMERA_UNITS, 100},
        {"cameraFocalLength", "51.9469", WO_CAMERA_FOCAL_LENGTH, 51.9469},
        {"CameraFocalLength", "35", WO_CAMERA_FOCAL_LENGTH, 35},
        {"cameraAperture", "24.9294", WO_CAMERA_SENSOR_WIDTH, 24.9294},
        {"cameraFNumber", "8", WO_CAMERA_F_NUMBER, 8},
        {"cameraNearClip", "10", WO_CAMERA_NEAR, 0.1},
        {"cameraFarClip", "1e4", WO_CAMERA_FAR, 100},
        {"CameraFilmApertureHorizontal", "36", WO_CAMERA_SENSOR_WIDTH, 36},
        {"arnold/camera/near_clip", "10", WO_CAMERA_NEAR, 0.1},
        {"arnold/camera/far_clip", "1000", WO_CAMERA_FAR, 10},
        {"focal", "85", WO_CAMERA_FOCAL_LENGTH, 85},
        {"haperture", "36", WO_CAMERA_SENSOR_WIDTH, 36},
        {"fstop", "2", WO_CAMERA_F_NUMBER, 2},
        {"exrheader_focaldistance", "150", WO_CAMERA_FOCUS, 1.5},
        {"rs/camera/DOFFocusDistance", "150", WO_CAMERA_FOCUS, 1.5},
        {"rs/camera/nearPlane", "1", WO_CAMERA_NEAR, 0.01},
        {"rs/camera/farPlane", "5000", WO_CAMERA_FAR, 50},
        {"Lens", "50.00", WO_CAMERA_FOCAL_LENGTH, 50},
        {"pinholeFocalLength", "49.5", WO_CAMERA_FOCAL_LENGTH, 49.5},
        {"effectiveFocalLength", "49.7", WO_CAMERA_FOCAL_LENGTH, 49.7},
        {"nominalFocalLength", "50", WO_CAMERA_FOCAL_LENGTH, 50},
        {"aperture", "5.6", WO_CAMERA_F_NUMBER, 5.6},
        {"focus", "3", WO_CAMERA_FOCUS, 3},
        {"focus", "inf", WO_CAMERA_FOCUS, 0},
        {"sensorOverallDimensions", "28.25 18.17", WO_CAMERA_SENSOR_WIDTH, 28.25},
        {"exr/cameraFNumber", " 8 ", WO_CAMERA_F_NUMBER, 8},
        {"input/focal_length", "24", WO_CAMERA_FOCAL_LENGTH, 24},
        {"input/fnumber", "11", WO_CAMERA_F_NUMBER, 11},
    };
    (void)state;
    for (size_t i = 0; i < WO_COUNT(rows); i++) {
        wo_camera camera = {0};
        assert_true(wo_camera_read(&camera, rows[i].name, rows[i].text));
        assert_int_equal(camera.refused_count, 0);
        assert_value(&camera, rows[i].value, rows[i].wanted);
        assert_string_equal(from(&camera, rows[i].value), rows[i].name);
    }
}

static void other_names_say_nothing(void **state)
{
    static const char *const names[] = {
        "",
        "exr/",
        "owner",
        "focusPuller",
        "wideopen:fStops",
        "wideopen:",
        "unreal/fstop",
        "unreal//fstop",
        "unreal/camera/FinalImage/minFStop",
        "unreal/camera/FinalImage/maxFocalLength",
        "camera",
        "screenWindowWidth",
        "rs/camera/shift",
    };
    static const wo_camera nothing = {0};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(names); i++) {
        wo_camera camera = {0};
        assert_false(wo_camera_read(&camera, names[i], "5"));
        assert_memory_equal(&camera, &nothing, sizeof camera);
    }
}

static void hostile_values_are_refused(void **state)
{
    static const char *const texts[] = {"nan",   "-nan",  "inf",  "-inf", "-1",   "0",    "1e308",
                                        "1e999", "1e-30", "",     " ",    "fast", "5 mm", "5 6",
                                        "5,6",   "0x10",  "5\n6", "--5",  "."};
    static const struct {
        const char *name;
        wo_camera_value value;
    } rows[] = {{"wideopen:focalLength", WO_CAMERA_FOCAL_LENGTH},
                {"wideopen:sensorWidth", WO_CAMERA_SENSOR_WIDTH},
                {"wideopen:fStop", WO_CAMERA_F_NUMBER},
                {"wideopen:near", WO_CAMERA_NEAR},
                {"wideopen:far", WO_CAMERA_FAR},
                {"wideopen:depthScale", WO_CAMERA_UNITS},
                {"cameraNearClip", WO_CAMERA_NEAR},
                {"focal", WO_CAMERA_FOCAL_LENGTH},
                {"sensorPhotositePitch", WO_CAMERA_SENSOR_WIDTH},
                {"sensorAcquisitionRectangle", WO_CAMERA_SENSOR_WIDTH}};
    (void)state;
    for (size_t i = 0; i < WO_COUNT(rows); i++)
        for (size_t k = 0; k < WO_COUNT(texts); k++) {
            wo_camera camera = {0};
            assert_true(wo_camera_read(&camera, rows[i].name, texts[k]));
            assert_unknown(&camera, rows[i].value);
            assert_int_equal(camera.refused_count, 1);
            assert_string_equal(camera.refused[0].name, rows[i].name);
            assert_true(strlen(camera.refused[0].why) > 0);
            /* A good one after it counts. */
            if (strncmp(rows[i].name, "sensor", 6) != 0) {
                wo_camera_read(&camera, rows[i].name, "20");
                assert_true(from(&camera, rows[i].value)[0] != 0);
            }
        }
    for (size_t k = 0; k < WO_COUNT(texts); k++) {
        const bool fine = !strcmp(texts[k], "inf");
        const wo_camera camera = CAMERA("focus", texts[k]);
        assert_int_equal(camera.refused_count, !fine);
        if (!fine)
            assert_unknown(&camera, WO_CAMERA_FOCUS);
    }
}

static void names_of_two_meanings_are_refused(void **state)
{
    (void)state;
    wo_camera camera =
        CAMERA("rs/camera/fov", "54", "rs/camera/aperture", "1.417 0.9", "rs/camera/FStop", "8",
               "tStop", "2.1", "cameraTargetDistance", "200", "aperture", "41.4214");
    assert_int_equal(camera.refused_count, 6);
    for (int i = 0; i < WO_CAMERA_VALUES; i++)
        assert_unknown(&camera, (wo_camera_value)i);
    /* What may be inches. */
    camera = CAMERA("CameraFilmApertureHorizontal", "1.417");
    assert_unknown(&camera, WO_CAMERA_SENSOR_WIDTH);
    assert_non_null(strstr(camera.refused[0].why, "inches"));
}

static void the_more_particular_wins(void **state)
{
    (void)state;
    /* In either order. */
    wo_camera camera = CAMERA("aperture", "4", "wideopen:fStop", "2", "cameraFNumber", "8");
    assert_value(&camera, WO_CAMERA_F_NUMBER, 2);
    camera = CAMERA("cameraFNumber", "8", "aperture", "4");
    assert_value(&camera, WO_CAMERA_F_NUMBER, 8);
    camera = CAMERA("nominalFocalLength", "50", "pinholeFocalLength", "48");
    assert_value(&camera, WO_CAMERA_FOCAL_LENGTH, 48);
    /* Two of one spelling: the first, also under another case or prefix. */
    camera = CAMERA("exr/focal", "50", "FOCAL", "60");
    assert_value(&camera, WO_CAMERA_FOCAL_LENGTH, 50);
    /* A bad one does not stand in a good one's way. */
    camera = CAMERA("wideopen:fStop", "nan", "aperture", "4");
    assert_value(&camera, WO_CAMERA_F_NUMBER, 4);
    assert_int_equal(camera.refused_count, 1);
}

static void a_sensor_is_found_in_other_ways(void **state)
{
    (void)state;
    /* V-Ray, a square picture of a 36 mm film that is fitted by its height: 24 mm are seen. The
       numbers are those of a real file. */
    wo_camera camera =
        CAMERA("cameraAperture", "35.9999", "cameraFov", "37.8493", "cameraFocalLength", "35");
    double mm;
    const char *name;
    assert_true(wo_camera_get(&camera, WO_CAMERA_SENSOR_WIDTH, 1, &mm, &name));
    assert_true(fabs(mm - 24) < 1e-3);
    assert_string_equal(name, "cameraFov");
    /* Without the focal length the angle says nothing about millimetres. */
    camera = CAMERA("cameraAperture", "36", "cameraFov", "40");
    assert_value(&camera, WO_CAMERA_SENSOR_WIDTH, 36);
    camera = CAMERA("cameraFov", "40");
    assert_unknown(&camera, WO_CAMERA_SENSOR_WIDTH);
    /* What our own name says comes first. */
    camera = CAMERA("cameraFov", "40", "focal", "50", "wideopen:sensorWidth", "30");
    assert_value(&camera, WO_CAMERA_SENSOR_WIDTH, 30);
    /* 2880 photosites of 8.25 micrometres; the whole sensor is larger. */
    camera = CAMERA("sensorOverallDimensions", "28.25 18.17", "sensorPhotositePitch", "8.25",
                    "sensorAcquisitionRectangle", "272 0 3151 1619");
    assert_value(&camera, WO_CAMERA_SENSOR_WIDTH, 23.76);
}

static void units_of_the_scene(void **state)
{
    (void)state;
    wo_camera camera = CAMERA("focaldistance", "250", "wideopen:depthScale", "10");
    assert_value(&camera, WO_CAMERA_FOCUS, 25); /* the metadata's units, not the caller's 100 */
    camera = CAMERA("focaldistance", "250");
    double m;
    const char *name;
    const double bad[] = {NAN, 0, -1, INFINITY, 1e-300};
    for (size_t i = 0; i < WO_COUNT(bad); i++)
        assert_false(wo_camera_get(&camera, WO_CAMERA_FOCUS, bad[i], &m, &name));
}

static void names_are_tamed_and_lists_end(void **state)
{
    (void)state;
    char name[300] = "unreal/\033[2J\n";
    wo_camera camera = {0};
    memset(name + strlen(name), 'x', 200);
    strcat(name, "/fstop");
    assert_true(wo_camera_read(&camera, name, "4"));
    assert_value(&camera, WO_CAMERA_F_NUMBER, 4);
    assert_int_equal(strlen(from(&camera, WO_CAMERA_F_NUMBER)), WO_CAMERA_NAME_SIZE - 1);
    for (const char *c = from(&camera, WO_CAMERA_F_NUMBER); *c; c++)
        assert_true(*c >= ' ' && *c <= '~');
    for (int i = 0; i < 100; i++) {
        snprintf(name, sizeof name, "unreal/%d/fstop", i);
        wo_camera_read(&camera, name, "none");
        wo_camera_read(&camera, name, "none");
    }
    assert_int_equal(camera.refused_count, WO_CAMERA_REFUSALS_MAX);
    assert_string_equal(camera.refused[1].name, "unreal/1/fstop"); /* each once */
}

static void what_is_set_by_hand(void **state)
{
    (void)state;
    const wo_camera camera = CAMERA("wideopen:own", "  fStop near\tfStops depthScale ");
    for (int i = 0; i < WO_CAMERA_VALUES; i++)
        assert_int_equal(camera.own[i],
                         i == WO_CAMERA_F_NUMBER || i == WO_CAMERA_NEAR || i == WO_CAMERA_UNITS);
    assert_int_equal(camera.refused_count, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_spelling_is_read),
        cmocka_unit_test(other_names_say_nothing),
        cmocka_unit_test(hostile_values_are_refused),
        cmocka_unit_test(names_of_two_meanings_are_refused),
        cmocka_unit_test(the_more_particular_wins),
        cmocka_unit_test(a_sensor_is_found_in_other_ways),
        cmocka_unit_test(units_of_the_scene),
        cmocka_unit_test(names_are_tamed_and_lists_end),
        cmocka_unit_test(what_is_set_by_hand),
    };
    return cmocka_run_group_tests_name("camera", tests, NULL, NULL);
}
