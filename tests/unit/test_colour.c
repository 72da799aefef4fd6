/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "colour.h"

#include "bridge_test.h"

static wo_colour *colour;

static int open_own(void **state)
{
    unsetenv("OCIO");
    return make_folder(state) || wo_colour_create(NULL, &colour, &fault) != WO_OK;
}

static int close_own(void **state)
{
    wo_colour_destroy(&colour);
    wo_colour_destroy(&colour);
    return count_files(true) < 0 || remove_folder(state);
}

static wo_image picture(float *data, int width, int height, int components)
{
    return (wo_image){.data = data,
                      .bounds = {0, 0, width, height},
                      .row_bytes = (ptrdiff_t)((size_t)width * (size_t)components * sizeof *data),
                      .components = components};
}

/* One RGB pixel goes from a space to another and is there this. */
static void assert_converts(const char *from, const char *to, const double given[3],
                            const double wanted[3], double tolerance)
{
    float pixel[3] = {(float)given[0], (float)given[1], (float)given[2]};
    wo_image image = picture(pixel, 1, 1, 3);
    assert_ok(wo_colour_convert(colour, from, to, &image, &fault));
    for (int c = 0; c < 3; c++)
        if (!(fabs((double)pixel[c] - wanted[c]) <= tolerance))
            fail_msg("%s to %s: %.9g instead of %.9g", from, to, (double)pixel[c], wanted[c]);
}

#define RGB(r, g, b) ((const double[3]){r, g, b})

static void names_are_listed(void **state)
{
    (void)state;
    static const char *const wanted[] = {"lin_rec709",      "ACEScg", "ACES2065-1",
                                         "lin_p3d65",       "sRGB",   "Rec.709 camera",
                                         "Rec.709 BT.1886", "Cineon", "raw"};
    char displays[256];
    assert_string_equal(wo_colour_origin(colour), "built in");
    for (size_t i = 0; i < WO_COUNT(wanted); i++) {
        bool found = false;
        for (size_t k = 0; k < wo_colour_count(colour); k++)
            found = found || !strcmp(wo_colour_name(colour, k), wanted[i]);
        if (!found)
            fail_msg("%s is missing", wanted[i]);
    }
    assert_null(wo_colour_name(colour, wo_colour_count(colour)));
    const int length = wo_colour_list_displays(colour, displays, sizeof displays);
    assert_int_equal(length, strlen(displays));
    assert_string_equal(displays, "sRGB: Standard, Soft highlights, Raw\n");
    assert_true(wo_colour_is_data(colour, "raw"));
    assert_true(wo_colour_is_data(colour, "data"));
    assert_false(wo_colour_is_data(colour, "sRGB"));
    assert_false(wo_colour_is_data(colour, "no such"));
}

static void curves(void **state)
{
    (void)state;
    const char *const linear = WO_COLOUR_WORKING;
    assert_converts("sRGB", linear, RGB(0.5, 0, 1), RGB(0.21404114, 0, 1), 1e-6);
    assert_converts("sRGB", linear, RGB(0.02, -0.1, 2), RGB(0.02 / 12.92, -0.1 / 12.92, 4.9538456),
                    1e-5);
    /* BT.709 rounds the constants where its line meets its power; here they meet exactly */
    assert_converts("Rec.709 camera", linear, RGB(0.5, 0.0405, 1), RGB(0.2595894, 0.009, 1), 3e-5);
    assert_converts("Rec.709 BT.1886", linear, RGB(0.5, -0.5, 1), RGB(0.18946457, -0.18946457, 1),
                    1e-6);
    assert_converts("Cineon", linear, RGB(685.0 / 1023, 95.0 / 1023, 1), RGB(1, 0, 13.52169), 1e-4);
    assert_converts(linear, "sRGB", RGB(0.18, 0.0031308, 5), RGB(0.46135613, 0.04045, 2.00796),
                    1e-4);
}

static void primaries(void **state)
{
    (void)state;
    /* published: AP1 to Rec.709 with Bradford, AP0 to AP1, P3 to Rec.709 */
    assert_converts("ACEScg", "lin_rec709", RGB(1, 0, 0), RGB(1.70505, -0.13026, -0.02400), 1e-5);
    assert_converts("ACEScg", "lin_rec709", RGB(0, 1, 0), RGB(-0.62179, 1.14080, -0.12897), 1e-5);
    assert_converts("ACEScg", "lin_rec709", RGB(1, 1, 1), RGB(1, 1, 1), 1e-6);
    assert_converts("ACES2065-1", "ACEScg", RGB(1, 0, 0),
                    RGB(1.4514393161, -0.0765537734, 0.0083161484), 1e-5);
    assert_converts("ACES2065-1", "ACEScg", RGB(0, 0, 1),
                    RGB(-0.2149285693, -0.0996759264, 0.9977163014), 1e-5);
    assert_converts("lin_p3d65", "lin_rec709", RGB(1, 0, 0),
                    RGB(1.2249401763, -0.0420569547, -0.0196375546), 1e-5);
    assert_converts("lin_rec709", "ACEScg", RGB(1, 0, 0), RGB(0.61309740, 0.07019372, 0.02061559),
                    1e-6);
}

/* Every space for textures of the Color Interop Forum goes by its id; an encoded one is the linear
   one of its primaries behind its curve. */
static void forum_ids(void **state)
{
    (void)state;
    static const char *const ids[] = {
        "lin_ap1_scene",    "lin_ap0_scene",       "lin_rec709_scene",
        "lin_p3d65_scene",  "lin_rec2020_scene",   "lin_adobergb_scene",
        "srgb_ap1_scene",   "lin_ciexyzd65_scene", "srgb_rec709_scene",
        "g22_rec709_scene", "g18_rec709_scene",    "g22_ap1_scene",
        "srgb_p3d65_scene", "g22_adobergb_scene",  "data"};
    static const struct {
        const char *encoded, *linear;
        double light; /* of code 0.5 */
    } curves_of[] = {{"srgb_rec709_scene", "lin_rec709_scene", 0.21404114},
                     {"g22_rec709_scene", "lin_rec709_scene", 0.21763764},
                     {"g18_rec709_scene", "lin_rec709_scene", 0.28717459},
                     {"srgb_ap1_scene", "lin_ap1_scene", 0.21404114},
                     {"g22_ap1_scene", "lin_ap1_scene", 0.21763764},
                     {"srgb_p3d65_scene", "lin_p3d65_scene", 0.21404114},
                     {"g22_adobergb_scene", "lin_adobergb_scene", 0.21763764}};
    char name[64];
    for (size_t i = 0; i < WO_COUNT(ids); i++) {
        if (!wo_colour_find(colour, ids[i], name, sizeof name))
            fail_msg("%s is missing", ids[i]);
        const wo_colour_standard *const standard = wo_colour_standard_of(colour, name);
        assert_non_null(standard);
        assert_string_equal(standard->id, ids[i]);
    }
    for (size_t i = 0; i < WO_COUNT(curves_of); i++)
        for (int c = 0; c < 3; c++) {
            double code[3] = {0}, light[3] = {0};
            code[c] = 0.5;
            light[c] = curves_of[i].light;
            assert_converts(curves_of[i].encoded, curves_of[i].linear, code, light, 2e-6);
        }
    /* published: Rec.2020 and XYZ to Rec.709; Adobe RGB and Rec.709 share red and blue */
    assert_converts("lin_rec2020", "lin_rec709", RGB(1, 0, 0), RGB(1.660491, -0.124550, -0.018151),
                    1e-6);
    assert_converts("lin_rec2020", "lin_rec709", RGB(1, 1, 1), RGB(1, 1, 1), 1e-6);
    assert_converts("lin_ciexyzd65", "lin_rec709", RGB(0, 1, 0),
                    RGB(-1.537383, 1.875968, -0.203977), 1e-6);
    assert_converts("lin_adobergb", "lin_rec709", RGB(1, 0, 0), RGB(1.398356, 0, 0), 1e-6);
}

/* From light through every two spaces and back, dark to very bright. */
static void round_trips(void **state)
{
    (void)state;
    static const char *const spaces[] = {"lin_rec709",      "ACEScg", "ACES2065-1",
                                         "lin_p3d65",       "sRGB",   "Rec.709 camera",
                                         "Rec.709 BT.1886", "Cineon"};
    for (size_t a = 0; a < WO_COUNT(spaces); a++)
        for (size_t b = 0; b < WO_COUNT(spaces); b++) {
            float pixels[40 * 3], before[40 * 3];
            for (int i = 0; i < 120; i++)
                before[i] = pixels[i] =
                    0.18f * powf(2, (float)(i / 3) / 3 - 7) * (0.5f + noise((uint32_t)i));
            wo_image image = picture(pixels, 40, 1, 3);
            assert_ok(wo_colour_convert(colour, WO_COLOUR_WORKING, spaces[a], &image, &fault));
            assert_ok(wo_colour_convert(colour, spaces[a], spaces[b], &image, &fault));
            assert_ok(wo_colour_convert(colour, spaces[b], WO_COLOUR_WORKING, &image, &fault));
            for (int i = 0; i < 120; i++) {
                const float *const whole = before + (i - i % 3);
                const float largest = fmaxf(whole[0], fmaxf(whole[1], whole[2]));
                if (!(fabsf(pixels[i] - before[i]) <= 1e-5f * fmaxf(largest, 0.01f)))
                    fail_msg("through %s and %s: %.9g instead of %.9g", spaces[a], spaces[b],
                             (double)pixels[i], (double)before[i]);
            }
        }
}

static void alpha_is_respected(void **state)
{
    (void)state;
    /* alpha 0.5, 0 (light that adds), 1, above 1, NaN */
    float given[5][4] = {{0.25f, 0, 0.5f, 0.5f},
                         {0.5f, 0.25f, 0, 0},
                         {0.5f, 0.25f, 0, 1},
                         {0.5f, 0.25f, 0, 2},
                         {0.5f, 0.25f, 0, NAN}};
    static const float wanted[5][3] = {{0.10702057f, 0, 0.5f},
                                       {0.21404114f, 0.05087609f, 0},
                                       {0.21404114f, 0.05087609f, 0},
                                       {0.10175218f, 0.02870010f, 0},
                                       {0.21404114f, 0.05087609f, 0}};
    wo_image image = picture(given[0], 5, 1, 4);
    assert_ok(wo_colour_convert(colour, "sRGB", "lin_rec709", &image, &fault));
    for (int i = 0; i < 5; i++)
        for (int c = 0; c < 3; c++)
            assert_float_equal(given[i][c], wanted[i][c], 1e-6f);
    assert_float_equal(given[0][3], 0.5f, 0);
    assert_float_equal(given[3][3], 2, 0);
    assert_true(isnan(given[4][3]));

    float straight[4] = {0.25f, 0, 0.5f, 0.5f};
    image = picture(straight, 1, 1, 4);
    assert_ok(wo_colour_convert_straight(colour, "sRGB", "lin_rec709", &image, &fault));
    assert_float_equal(straight[0], 0.05087609f, 1e-6f);
    assert_float_equal(straight[2], 0.21404114f, 1e-6f);
    assert_float_equal(straight[3], 0.5f, 0);
}

static void data_is_left_alone(void **state)
{
    (void)state;
    float depth[3] = {0.5f, 12, 1e10f}, pixel[3] = {0.5f, 12, NAN};
    wo_image image = picture(depth, 3, 1, 1);
    assert_ok(wo_colour_convert(colour, "sRGB", "lin_rec709", &image, &fault));
    assert_ok(wo_colour_display(colour, "lin_rec709", NULL, NULL, &image, &fault));
    assert_true(depth[0] == 0.5f && depth[1] == 12 && depth[2] == 1e10f);
    image = picture(pixel, 1, 1, 3);
    assert_ok(wo_colour_convert(colour, "raw", "lin_rec709", &image, &fault));
    assert_ok(wo_colour_convert(colour, "sRGB", "raw", &image, &fault));
    assert_ok(wo_colour_display(colour, "raw", "sRGB", "Standard", &image, &fault));
    assert_true(pixel[0] == 0.5f && pixel[1] == 12 && isnan(pixel[2]));
}

static void rows_may_be_anywhere(void **state)
{
    (void)state;
    enum { W = 5, H = 4, ROW = (W + 2) * 3 };
    float memory[H * ROW];
    for (int i = 0; i < H * ROW; i++)
        memory[i] = 0.5f;
    wo_image image = {.data = memory + (H - 1) * ROW,
                      .bounds = {-2, 9, -2 + W, 9 + H},
                      .row_bytes = -(ptrdiff_t)(ROW * sizeof(float)),
                      .components = 3};
    assert_ok(wo_colour_convert(colour, "sRGB", "lin_rec709", &image, &fault));
    for (int i = 0; i < H * ROW; i++)
        assert_float_equal(memory[i], (i % ROW < W * 3 ? 0.21404114f : 0.5f), 1e-6f);
}

static void files_have_spaces(void **state)
{
    (void)state;
    static const struct {
        const char *path, *says, *wanted;
    } cases[] = {
        {"/a/b.exr", NULL, "lin_rec709"},
        {"B.EXR", "", "lin_rec709"},
        {"x.hdr", "linear", "lin_rec709"},
        {"x.png", "sRGB", "sRGB"},
        {"x.jpeg", NULL, "sRGB"},
        {"x.JPG", NULL, "sRGB"},
        {"x.tif", NULL, "sRGB"},
        {"x.tiff", "Linear", "lin_rec709"},
        {"x.ppm", NULL, "sRGB"},
        {"x.dpx", NULL, "Cineon"},
        {"x.dpx", "Rec709", "Rec.709 camera"},
        {"x.cin", "KodakLog", "Cineon"},
        {"x.exr", "lin_ap1_scene", "ACEScg"},
        {"x.exr", "something else", "lin_rec709"},
        {"no extension", NULL, "lin_rec709"},
        {"exr.png/x.exr", NULL, "lin_rec709"},
        {"x.exr", "unknown", "lin_rec709"},
        {"x.exr", "data", "raw"},
        {"x.exr", "srgb_tx", "sRGB"},
    };
    char name[64];
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        const wo_colour_words says = {.words = {cases[i].says}};
        assert_ok(wo_colour_of_file(colour, cases[i].path, cases[i].says ? &says : NULL, name,
                                    sizeof name, NULL, &fault));
        if (strcmp(name, cases[i].wanted))
            fail_msg("%s is %s", cases[i].path, name);
    }
    assert_fault(wo_colour_of_file(colour, "x.exr", NULL, name, 4, NULL, &fault), WO_ERR_RANGE,
                 "longer than 4");
}

static void views(void **state)
{
    (void)state;
    float pixel[4] = {0.21404114f, 0.5f, 2, 1};
    wo_image image = picture(pixel, 1, 1, 4);
    assert_ok(wo_colour_display(colour, "lin_rec709", NULL, NULL, &image, &fault));
    assert_float_equal(pixel[0], 0.5f, 1e-5f);
    assert_float_equal(pixel[1], 0.73535698f, 1e-5f);
    assert_true(pixel[2] > 1);

    double last = -1;
    for (int i = 0; i <= 200; i++) {
        const double light = i ? 0.0003 * pow(10, i * 7.0 / 200) : 0;
        const double plain =
            light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
        float grey[3] = {(float)light, (float)light, (float)light};
        image = picture(grey, 1, 1, 3);
        assert_ok(
            wo_colour_display(colour, "scene_linear", "sRGB", "Soft highlights", &image, &fault));
        const double shown = (double)grey[1];
        if (!(shown >= last - 1e-6 && shown >= 0 && shown <= 1))
            fail_msg("light %g is shown as %g after %g", light, shown, last);
        if (light < 0.35 && fabs(shown - plain) > 4e-3)
            fail_msg("light %g is shown as %g, not as %g", light, shown, plain);
        if (light > 0.6 && light < 15 && !(shown < plain && shown < 1))
            fail_msg("light %g is not rolled off: %g", light, shown);
        last = shown;
    }
    assert_true(last == 1);
}

static void unknown_names(void **state)
{
    (void)state;
    float pixel[3] = {0.5f, 0.5f, 0.5f};
    wo_image image = picture(pixel, 1, 1, 3), none = {0};
    assert_fault(wo_colour_convert(colour, "sRGBB", "ACEScg", &image, &fault), WO_ERR_NOT_FOUND,
                 "no colour space 'sRGBB'; there are: lin_rec709, ACEScg, ACES2065-1, ");
    assert_fault(wo_colour_convert(colour, "sRGB", "", &image, &fault), WO_ERR_ARGUMENT, "named");
    assert_fault(wo_colour_convert(colour, NULL, "sRGB", &image, &fault), WO_ERR_ARGUMENT, "named");
    assert_fault(wo_colour_convert(colour, "sRGB", "raw", &none, &fault), WO_ERR_ARGUMENT,
                 "no picture");
    assert_fault(wo_colour_display(colour, "sRGB", "P3", NULL, &image, &fault), WO_ERR_NOT_FOUND,
                 "no display 'P3'; there are: sRGB: Standard");
    assert_fault(wo_colour_display(colour, "sRGB", NULL, "Film", &image, &fault), WO_ERR_NOT_FOUND,
                 "no view 'Film'; there are: sRGB: Standard");
    assert_true(pixel[0] == 0.5f);
    image.components = 2;
    assert_fault(wo_colour_convert(colour, "sRGB", "ACEScg", &image, &fault), WO_ERR_FORMAT, "2");
}

static void other_configurations(void **state)
{
    (void)state;
    static const char text[] = "ocio_profile_version: 1\n"
                               "roles: {default: a, scene_linear: a}\n"
                               "displays: {d: [!<View> {name: v, colorspace: b}]}\n"
                               "colorspaces:\n"
                               "  - !<ColorSpace> {name: a}\n"
                               "  - !<ColorSpace>\n"
                               "    name: b\n"
                               "    from_reference: !<CDLTransform> {slope: [2, 2, 2]}\n";
    wo_colour *other = NULL;
    char name[32];
    float pixel[3] = {0.5f, 1, 2};
    wo_image image = picture(pixel, 1, 1, 3);

    write_bytes(in_folder("small.ocio"), text, sizeof text - 1);
    setenv("OCIO", in_folder("small.ocio"), 1);
    assert_ok(wo_colour_create("", &other, &fault));
    assert_string_equal(wo_colour_origin(other), getenv("OCIO"));
    assert_int_equal(wo_colour_count(other), 2);
    assert_ok(wo_colour_convert(other, "a", "b", &image, &fault));
    assert_float_equal(pixel[2], 4, 1e-6f);
    const wo_colour_words linear = {.words = {"Linear"}};
    assert_ok(wo_colour_of_file(other, "x.png", &linear, name, sizeof name, NULL, &fault));
    assert_string_equal(name, "a");
    wo_colour_destroy(&other);

    /* a file that is named wins over the environment */
    assert_fault(wo_colour_create(in_folder("missing.ocio"), &other, &fault), WO_ERR_LIBRARY,
                 "missing.ocio");
    assert_null(other);
    setenv("OCIO", in_folder("missing.ocio"), 1);
    assert_ok(wo_colour_create(in_folder("small.ocio"), &other, &fault));
    wo_colour_destroy(&other);
    assert_fault(wo_colour_create(NULL, &other, &fault), WO_ERR_LIBRARY, "missing.ocio");

    /* damaged ones, cut anywhere */
    for (size_t length = 0; length < sizeof text - 1; length += 7) {
        write_bytes(in_folder("cut.ocio"), text, length);
        if (wo_colour_create(in_folder("cut.ocio"), &other, &fault) == WO_OK)
            wo_colour_destroy(&other);
        assert_null(other);
    }
    write_bytes(in_folder("cut.ocio"), "\x00\xff\xfe: [", 6);
    assert_int_equal(wo_colour_create(in_folder("cut.ocio"), &other, &fault), WO_ERR_LIBRARY);
    unsetenv("OCIO");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_listed),   cmocka_unit_test(curves),
        cmocka_unit_test(primaries),          cmocka_unit_test(forum_ids),
        cmocka_unit_test(round_trips),        cmocka_unit_test(alpha_is_respected),
        cmocka_unit_test(data_is_left_alone), cmocka_unit_test(rows_may_be_anywhere),
        cmocka_unit_test(files_have_spaces),  cmocka_unit_test(views),
        cmocka_unit_test(unknown_names),      cmocka_unit_test(other_configurations),
    };
    return cmocka_run_group_tests(tests, open_own, close_own);
}
