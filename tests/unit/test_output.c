/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#define _POSIX_C_SOURCE 200809L
#include "bridge/colour_label.h"
#include "cli/picture_file.h"
#include "cli/render_output.h"

#include "bridge_test.h"

/* What happens to a picture between two files when nothing is done to it. */

/* A configuration of the first version: no rules, what is not known is raw. */
static const char version_1[] =
    "ocio_profile_version: 1\n"
    "strictparsing: false\n"
    "roles: {default: raw, scene_linear: lnf, data: raw}\n"
    "displays: {d: [!<View> {name: v, colorspace: sRGB}]}\n"
    "colorspaces:\n"
    "  - !<ColorSpace> {name: lnf}\n"
    "  - !<ColorSpace>\n"
    "    name: ACES - ACEScg\n"
    "    to_reference: !<MatrixTransform> {matrix: [1.70505, -0.62179, -0.08326, 0, -0.13026,\n"
    "      1.14080, -0.01055, 0, -0.02400, -0.12897, 1.15297, 0, 0, 0, 0, 1]}\n"
    "  - !<ColorSpace>\n"
    "    name: sRGB\n"
    "    to_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1]}\n"
    "  - !<ColorSpace>\n"
    "    name: Cineon\n"
    "    from_reference: !<GroupTransform>\n"
    "      children:\n"
    "        - !<MatrixTransform> {offset: [0.01, 0.01, 0.01, 0]}\n"
    "        - !<LogTransform> {base: 10}\n"
    "        - !<MatrixTransform> {matrix: [0.3, 0, 0, 0, 0, 0.3, 0, 0, 0, 0, 0.3, 0, 0, 0, 0, "
    "1],\n"
    "          offset: [0.65, 0.65, 0.65, 0]}\n"
    "  - !<ColorSpace> {name: raw, isdata: true}\n";

/* The same without anything that files speak of. */
static const char version_1_poor[] =
    "ocio_profile_version: 1\n"
    "roles: {default: nc, scene_linear: lnf}\n"
    "displays: {d: [!<View> {name: v, colorspace: vd}]}\n"
    "colorspaces:\n"
    "  - !<ColorSpace> {name: lnf}\n"
    "  - !<ColorSpace> {name: vd, to_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}}\n"
    "  - !<ColorSpace> {name: nc, isdata: true}\n";

/* ACES by the library's own transforms, as its configurations have them: one rule. */
static const char aces[] =
    "ocio_profile_version: 2\n"
    "roles: {aces_interchange: ACES2065-1, scene_linear: ACEScg, default: ACES2065-1}\n"
    "file_rules:\n"
    "  - !<Rule> {name: matte, pattern: \"*_matte\", extension: png, colorspace: Raw}\n"
    "  - !<Rule> {name: Default, colorspace: default}\n"
    "displays: {d: [!<View> {name: v, colorspace: Raw}]}\n"
    "colorspaces:\n"
    "  - !<ColorSpace> {name: ACES2065-1, aliases: [lin_ap0]}\n"
    "  - !<ColorSpace>\n"
    "    name: ACEScg\n"
    "    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}\n"
    "  - !<ColorSpace>\n"
    "    name: ACEScct\n"
    "    to_scene_reference: !<BuiltinTransform> {style: ACEScct_to_ACES2065-1}\n"
    "  - !<ColorSpace>\n"
    "    name: Linear Rec.709 (sRGB)\n"
    "    from_scene_reference: !<MatrixTransform>\n"
    "      matrix: [2.52168618674, -1.13413098824, -0.387555198504, 0, -0.27647991423,\n"
    "        1.37271908767, -0.0962391734383, 0, -0.015378064966, -0.152975335867,\n"
    "        1.16835340083, 0, 0, 0, 0, 1]\n"
    "  - !<ColorSpace>\n"
    "    name: sRGB - Texture\n"
    "    from_scene_reference: !<GroupTransform>\n"
    "      children:\n"
    "        - !<ColorSpaceTransform> {src: ACES2065-1, dst: Linear Rec.709 (sRGB)}\n"
    "        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}\n"
    "  - !<ColorSpace> {name: Raw, isdata: true}\n";

static const struct {
    const char *name, *text;
} configurations[] = {{"our own", NULL},
                      {"version 1", version_1},
                      {"version 1, poor", version_1_poor},
                      {"ACES", aces}};

static const struct {
    const char *file;
    wo_io_depth depth;
    const char *says; /* oiio:ColorSpace */
    int channels;
    bool straight;
    float most; /* 0: codes are whole steps up to 1, else floats up to this */
    int steps;
} formats[] = {
    {"a.exr", WO_IO_HALF, "", 4, false, 100, 0},
    {"b.exr", WO_IO_SINGLE, "", 4, false, 100, 0},
    {"c.exr", WO_IO_SINGLE, "lin_ap1_scene", 4, false, 100, 0},
    {"d.exr", WO_IO_SINGLE, "srgb_rec709_scene", 4, false, 1, 0},
    {"a.png", WO_IO_BYTE, "", 4, true, 0, 255},
    {"b.png", WO_IO_SHORT, "sRGB", 3, true, 0, 65535},
    {"c.png", WO_IO_SHORT, "Linear", 4, true, 0, 65535},
    {"d_matte.png", WO_IO_BYTE, "", 3, true, 0, 255},
    {"a.tif", WO_IO_SHORT, "", 4, false, 0, 65535},
    {"b.tif", WO_IO_BYTE, "", 4, true, 0, 255},
    {"c.tif", WO_IO_SINGLE, "", 4, false, 1, 0},
    {"a.dpx", WO_IO_AUTO, "KodakLog", 4, false, 0, 1023},
    {"b.dpx", WO_IO_AUTO, "Linear", 4, false, 0, 1023},
    {"c.dpx", WO_IO_AUTO, "Rec709", 3, false, 0, 1023},
    {"d.dpx", WO_IO_SHORT, "", 4, false, 0, 65535},
    {"a.tga", WO_IO_BYTE, "", 4, true, 0, 255},
    {"a.bmp", WO_IO_BYTE, "", 3, false, 0, 255},
    {"a.ppm", WO_IO_BYTE, "", 3, false, 0, 255},
    {"a.hdr", WO_IO_SINGLE, "", 3, false, 1, 0},
};

enum { SIDE = 24 };

static float code(size_t format, uint32_t i)
{
    const float value = noise(i * 7 + (uint32_t)format);
    return formats[format].steps
               ? roundf(value * (float)formats[format].steps) / (float)formats[format].steps
               : value * formats[format].most;
}

/* Colours of every kind beside alpha: opaque, soft, thin, none; brighter than alpha, too. */
static void fill(wo_io_part *part, size_t format)
{
    const int n = part->channels;
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        float *const pixel = part->pixels + (size_t)n * i;
        for (int c = 0; c < n; c++)
            pixel[c] = code(format, i * 4 + (uint32_t)c);
        if (n < 4)
            continue;
        pixel[3] = i % 4 == 0   ? 1
                   : i % 4 == 1 ? fminf(pixel[3], 1)
                   : i % 4 == 2 ? 0
                                : pixel[3] / 16;
        if (formats[format].steps)
            pixel[3] =
                roundf(pixel[3] * (float)formats[format].steps) / (float)formats[format].steps;
        if (formats[format].straight && pixel[3] == 0)
            pixel[0] = pixel[1] = pixel[2] = 0; /* is lost when it is multiplied */
    }
}

static void make(size_t format, const char *path)
{
    static const char *const names[] = {"R", "G", "B", "A"};
    const wo_rect window = {0, 0, SIDE, SIDE};
    wo_io_part part = {0};
    assert_ok(wo_io_part_init(&part, "", window, window, names, formats[format].channels, &fault));
    fill(&part, format);
    if (strstr(path, ".exr")) {
        if (*formats[format].says)
            assert_ok(wo_io_part_set_text(&part, "colorInteropID", formats[format].says, &fault));
    } else {
        free(part.colour_space);
        part.colour_space = strdup(formats[format].says);
    }
    if (formats[format].straight)
        assert_ok(wo_io_part_set_number(&part, "oiio:UnassociatedAlpha", 1, &fault));
    assert_ok(wo_io_write(path, &part, 1, formats[format].depth, &fault));
    wo_io_part_clear(&part);
}

/* Reads a file and writes it as a render does that changes nothing. */
static void pass(const wo_colour *colour, const char *in_space, const char *out_space,
                 wo_io_depth depth, const char *from, const char *to, wo_written *written)
{
    wo_io_file *file = NULL;
    wo_image image;
    const wo_io_part *part = NULL;
    char space[256];
    assert_ok(wo_io_read(from, false, &file, &fault));
    assert_ok(wo_io_select(file, "", &image, &part, &fault));
    if (in_space)
        snprintf(space, sizeof space, "%s", in_space);
    else
        assert_ok(wo_label_space(colour, from, part, space, sizeof space, NULL, &fault));
    const bool raw = wo_colour_is_data(colour, space);
    if (!raw)
        assert_ok(wo_picture_linear(colour, file, 0, space, &image, &fault));
    const wo_origin origin = {part, from, raw ? NULL : space, in_space != NULL};
    const wo_output output = {.pattern = to,
                              .space = out_space,
                              .depth = depth,
                              .colour = (wo_colour *)(uintptr_t)colour,
                              .made_by = "test"};
    assert_ok(
        wo_output_write(&output, 1, &image, part->display_window, &origin, raw, written, &fault));
    free(image.data);
    wo_io_file_destroy(&file);
}

static wo_colour *open_configuration(size_t index)
{
    wo_colour *colour = NULL;
    unsetenv("OCIO");
    if (configurations[index].text) {
        char path[512];
        snprintf(path, sizeof path, "%s", in_folder("config.ocio"));
        write_bytes(path, configurations[index].text, strlen(configurations[index].text));
        assert_ok(wo_colour_create(path, &colour, &fault));
    } else {
        assert_ok(wo_colour_create(NULL, &colour, &fault));
    }
    return colour;
}

static void assert_same_codes(const char *first, const char *second, size_t format,
                              const char *what)
{
    wo_io_file *a = NULL, *b = NULL;
    assert_ok(wo_io_read(first, false, &a, &fault));
    assert_ok(wo_io_read(second, false, &b, &fault));
    const wo_io_part *const one = a->parts, *const two = b->parts;
    if (one->channels != two->channels)
        fail_msg("%s, %s: %d channels instead of %d", formats[format].file, what, two->channels,
                 one->channels);
    for (size_t i = 0; i < (size_t)(SIDE * SIDE * one->channels); i++) {
        const float wanted = one->pixels[i], got = two->pixels[i];
        const size_t pixel = i / (size_t)one->channels;
        const float *const whole = one->pixels + pixel * (size_t)one->channels;
        const float scale = fmaxf(1, fmaxf(whole[0], fmaxf(whole[1], whole[2])));
        const float near = formats[format].steps ? 0.1f / (float)formats[format].steps : 3e-6f;
        if (!(fabsf(got - wanted) <= near * scale))
            fail_msg("%s, %s: pixel %zu (%g %g %g, alpha %g) channel %zu: %.9g, not %.9g",
                     formats[format].file, what, pixel, (double)whole[0], (double)whole[1],
                     (double)whole[2], (double)(one->channels == 4 ? whole[3] : 1),
                     i % (size_t)one->channels, (double)got, (double)wanted);
    }
    wo_io_file_destroy(&a);
    wo_io_file_destroy(&b);
}

static void nothing_done_is_nothing_changed(void **state)
{
    (void)state;
    for (size_t c = 0; c < WO_COUNT(configurations); c++) {
        wo_colour *colour = open_configuration(c);
        for (size_t f = 0; f < WO_COUNT(formats); f++) {
            char from[512], to[512], again[512];
            wo_written written;
            snprintf(from, sizeof from, "%s", in_folder(formats[f].file));
            snprintf(to, sizeof to, "%s/out_%s", test_folder, formats[f].file);
            snprintf(again, sizeof again, "%s/again_%s", test_folder, formats[f].file);
            make(f, from);
            pass(colour, NULL, NULL, formats[f].depth, from, to, &written);
            assert_same_codes(from, to, f, configurations[c].name);
            assert_false(written.unsaid);
            /* and what was written is read as what it was */
            pass(colour, NULL, NULL, formats[f].depth, to, again, &written);
            assert_same_codes(from, again, f, configurations[c].name);
            /* a space that is told by hand stays, too */
            pass(colour, WO_COLOUR_WORKING, NULL, formats[f].depth, from, to, &written);
            assert_same_codes(from, to, f, "in-space");
            unlink(from);
            unlink(to);
            unlink(again);
        }
        wo_colour_destroy(&colour);
    }
}

/* --------------------------------------------------------------------------------- the labels */

#define AP1    "0.713 0.293 0.165 0.83 0.128 0.044 0.32168 0.33767"
#define REC709 "0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329"
#define CAMERA "0.78 0.3 0.2 0.9 0.1 -0.05 0.3127 0.329"

typedef struct label {
    const char *name, *text; /* of an attribute; NULL = none */
} label;

static void make_labelled(const char *path, const label labels[2])
{
    static const char *const names[] = {"R", "G", "B"};
    const wo_rect window = {0, 0, 2, 2};
    wo_io_part part = {0};
    assert_ok(wo_io_part_init(&part, "", window, window, names, 3, &fault));
    for (int i = 0; i < 12; i++)
        part.pixels[i] = i % 3 == 0 ? 0.18f : 0.02f;
    for (int i = 0; i < 2 && labels[i].name; i++) {
        wo_io_attribute attribute = {(char *)(uintptr_t)labels[i].name, WO_IO_TEXT, 0,
                                     (char *)(uintptr_t)labels[i].text, (char *)(uintptr_t) ""};
        if (!strcmp(labels[i].name, "chromaticities"))
            attribute.kind = attribute.name;
        assert_ok(wo_io_part_set(&part, &attribute, &fault));
    }
    assert_ok(wo_io_write(path, &part, 1, WO_IO_SINGLE, &fault));
    wo_io_part_clear(&part);
}

static void assert_attribute(const wo_io_part *part, const char *name, const char *wanted,
                             const char *what)
{
    const wo_io_attribute *const found = wo_io_part_find(part, name);
    const char *const text = found ? found->text : NULL;
    if ((text == NULL) != (wanted == NULL) || (text && strcmp(text, wanted) != 0))
        fail_msg("%s: %s is \"%s\" instead of \"%s\"", what, name, text ? text : "(none)",
                 wanted ? wanted : "(none)");
}

static void labels_say_what_the_pixels_are(void **state)
{
    (void)state;
    static const struct {
        const char *what;
        label given[2];
        const char *in_space, *out_space;
        double red;                        /* of 0.18 0.02 0.02, linear */
        const char *id, *primaries, *name; /* wanted; name is colorSpace */
    } cases[] = {
        {"nothing said", {{NULL, NULL}}, NULL, NULL, 0.18, "lin_rec709_scene", REC709, NULL},
        {"an id",
         {{"colorInteropID", "lin_ap1_scene"}},
         NULL,
         NULL,
         0.18,
         "lin_ap1_scene",
         AP1,
         NULL},
        {"an id that goes",
         {{"colorInteropID", "lin_ap1_scene"}},
         NULL,
         "lin_rec709",
         0.29281,
         "lin_rec709_scene",
         REC709,
         NULL},
        {"a name", {{"colorSpace", "ACEScg"}}, NULL, NULL, 0.18, "lin_ap1_scene", AP1, "ACEScg"},
        {"a name that goes",
         {{"colorSpace", "ACEScg"}},
         NULL,
         "lin_rec709",
         0.29281,
         "lin_rec709_scene",
         REC709,
         NULL},
        {"primaries", {{"chromaticities", AP1}}, NULL, NULL, 0.18, "lin_ap1_scene", AP1, NULL},
        {"primaries that go",
         {{"chromaticities", AP1}},
         NULL,
         "lin_rec709",
         0.29281,
         "lin_rec709_scene",
         REC709,
         NULL},
        {"usual primaries",
         {{"chromaticities", REC709}},
         NULL,
         NULL,
         0.18,
         "lin_rec709_scene",
         REC709,
         NULL},
        {"those of a camera", {{"chromaticities", CAMERA}}, NULL, NULL, 0.18, NULL, CAMERA, NULL},
        {"those of a camera go",
         {{"chromaticities", CAMERA}},
         NULL,
         "ACEScg",
         0.118096,
         "lin_ap1_scene",
         AP1,
         NULL},
        {"a foreign name", {{"colorSpace", "ours v3"}}, NULL, NULL, 0.18, NULL, NULL, "ours v3"},
        {"a contradiction",
         {{"colorInteropID", "lin_ap1_scene"}, {"chromaticities", REC709}},
         NULL,
         NULL,
         0.18,
         "lin_ap1_scene",
         AP1,
         NULL},
        {"a known name beside an unknown id",
         {{"colorInteropID", "unknown"}, {"colorSpace", "ACEScg"}},
         NULL,
         NULL,
         0.18,
         "lin_ap1_scene",
         AP1,
         "ACEScg"},
        {"told by hand",
         {{"colorInteropID", "lin_ap1_scene"}},
         "lin_rec709",
         NULL,
         0.18,
         "lin_rec709_scene",
         REC709,
         NULL},
        {"encoded", {{NULL, NULL}}, NULL, "sRGB", 0.46136, "srgb_rec709_scene", REC709, NULL},
        {"log", {{NULL, NULL}}, NULL, "Cineon", 0.45732, NULL, NULL, "Cineon"},
        {"numbers", {{"colorInteropID", "data"}}, NULL, NULL, 0.18, "data", NULL, NULL},
        {"told to be numbers",
         {{"colorInteropID", "lin_ap1_scene"}},
         "raw",
         NULL,
         0.18,
         "data",
         NULL,
         NULL},
    };
    wo_colour *colour = open_configuration(0);
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        char from[512], to[512], again[512];
        wo_written written;
        wo_io_file *file = NULL;
        snprintf(from, sizeof from, "%s/in.exr", test_folder);
        snprintf(to, sizeof to, "%s/out.exr", test_folder);
        snprintf(again, sizeof again, "%s/again.exr", test_folder);
        make_labelled(from, cases[i].given);
        pass(colour, cases[i].in_space, cases[i].out_space, WO_IO_SINGLE, from, to, &written);
        assert_false(written.unsaid);
        assert_ok(wo_io_read(to, false, &file, &fault));
        if (fabs((double)file->parts->pixels[0] - cases[i].red) > 2e-5)
            fail_msg("%s: %g instead of %g", cases[i].what, (double)file->parts->pixels[0],
                     cases[i].red);
        assert_attribute(file->parts, "colorInteropID", cases[i].id, cases[i].what);
        assert_attribute(file->parts, "chromaticities", cases[i].primaries, cases[i].what);
        assert_attribute(file->parts, "colorSpace", cases[i].name, cases[i].what);
        wo_io_file_destroy(&file);
        /* the next program does not convert again */
        pass(colour, NULL, NULL, WO_IO_SINGLE, to, again, &written);
        assert_ok(wo_io_read(again, false, &file, &fault));
        if (fabs((double)file->parts->pixels[0] - cases[i].red) > 2e-5)
            fail_msg("%s, again: %g", cases[i].what, (double)file->parts->pixels[0]);
        assert_attribute(file->parts, "colorInteropID", cases[i].id, cases[i].what);
        wo_io_file_destroy(&file);
        assert_int_equal(count_files(true), 3);
    }
    wo_colour_destroy(&colour);
}

static void formats_that_cannot_say_it(void **state)
{
    (void)state;
    static const struct {
        const char *from, *to, *space;
        bool unsaid;
    } cases[] = {{"in.exr", "out.png", NULL, false},     {"in.exr", "out.png", "ACEScg", false},
                 {"in.exr", "out.png", "Cineon", false}, {"in.exr", "out.tif", NULL, false},
                 {"in.exr", "out.tif", "ACEScg", true},  {"in.exr", "out.jpg", "lin_rec709", true},
                 {"in.exr", "out.dpx", NULL, false},     {"in.exr", "out.dpx", "lin_rec709", false},
                 {"in.exr", "out.dpx", "Rec709", false}, {"in.exr", "out.dpx", "ACEScg", true},
                 {"in.exr", "out.hdr", NULL, false},     {"in.exr", "out.hdr", "ACES2065-1", true},
                 {"in.exr", "out.exr", "bt1886", false}, {"in.exr", "out.tga", "sRGB", false},
                 {"in.exr", "out.ppm", "Rec709", true}};
    static const label ap1[2] = {{"colorInteropID", "lin_ap1_scene"}};
    wo_colour *colour = open_configuration(0);
    for (size_t i = 0; i < WO_COUNT(cases); i++) {
        char from[512], to[512];
        wo_written written;
        snprintf(from, sizeof from, "%s", in_folder(cases[i].from));
        snprintf(to, sizeof to, "%s", in_folder(cases[i].to));
        make_labelled(from, ap1);
        pass(colour, NULL, cases[i].space, WO_IO_AUTO, from, to, &written);
        if (written.unsaid != cases[i].unsaid)
            fail_msg("%s in %s: the file %s say so", cases[i].to, written.space,
                     written.unsaid ? "does not" : "does");
    }
    wo_colour_destroy(&colour);
}

/* ---------------------------------------------------------------------------------- the alpha */

/* Light that a code beside an alpha stands for. */
static double light_of(wo_colour *colour, const char *name, const char *says, bool straight,
                       float grey, float alpha)
{
    static const char *const names[] = {"R", "G", "B", "A"};
    const wo_rect window = {0, 0, 1, 1};
    wo_io_part part = {0};
    wo_image image = {0};
    char path[512];
    snprintf(path, sizeof path, "%s", in_folder(name));
    assert_ok(wo_io_part_init(&part, "", window, window, names, 4, &fault));
    part.pixels[0] = part.pixels[1] = part.pixels[2] = grey;
    part.pixels[3] = alpha;
    free(part.colour_space);
    part.colour_space = strdup(says);
    if (straight)
        assert_ok(wo_io_part_set_number(&part, "oiio:UnassociatedAlpha", 1, &fault));
    assert_ok(wo_io_write(path, &part, 1, WO_IO_SHORT, &fault));
    wo_io_part_clear(&part);
    assert_ok(wo_picture_load(colour, NULL, path, &image, &fault));
    const double light = (double)image.data[1];
    free(image.data);
    return light;
}

static void assert_near(double found, double wanted, double tolerance)
{
    if (!(fabs(found - wanted) <= tolerance))
        fail_msg("%.9g instead of %.9g", found, wanted);
}

static void soft_alpha_makes_no_light(void **state)
{
    (void)state;
    static const float alphas[] = {1, 0.51f, 0.25f, 0.03f, 1.0f / 65535, 0};
    wo_colour *colour = open_configuration(0);
    const double plate = light_of(colour, "a.dpx", "KodakLog", false, 0.5f, 1);
    assert_near(plate, (pow(10, (0.5 - 0.669599218) / 0.293255132) - 0.0107977516) / 0.989202248,
                5e-5);
    for (size_t i = 0; i < WO_COUNT(alphas); i++) {
        const float alpha = alphas[i];
        /* DPX says nothing of alpha */
        assert_near(light_of(colour, "a.dpx", "KodakLog", false, 0.5f, alpha), plate, 1e-6);
        assert_near(light_of(colour, "b.dpx", "Rec709", false, 0.5f, alpha), 0.25959, 1e-4);
        /* straight colour is linear before it is multiplied */
        assert_near(light_of(colour, "a.png", "", true, 0.5f, alpha), 0.21404 * (double)alpha,
                    3e-5);
        assert_near(light_of(colour, "a.tif", "", true, 0.5f, alpha), 0.21404 * (double)alpha,
                    3e-5);
        /* multiplied colour that is brighter than alpha is no more than it is */
        const double wanted = alpha > 0.5f ? 0.51 * pow((0.5 / 0.51 + 0.055) / 1.055, 2.4)
                              : alpha > 0  ? 0.5
                                           : 0.21404;
        assert_near(light_of(colour, "b.tif", "", false, 0.5f, alpha),
                    alpha == 1 ? 0.21404 : wanted, 1e-4);
    }
    wo_colour_destroy(&colour);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(labels_say_what_the_pixels_are, empty_folder),
        cmocka_unit_test_setup(formats_that_cannot_say_it, empty_folder),
        cmocka_unit_test_setup(soft_alpha_makes_no_light, empty_folder),
        cmocka_unit_test_setup(nothing_done_is_nothing_changed, empty_folder),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
