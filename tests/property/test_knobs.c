/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "near.h"
#include "scenes.h"

#include <stdio.h>
#include <string.h>

/* Every parameter of LensBlur changes the picture. A row of the parameter table for which there is
   no rule here is a fault, as is a rule for a parameter that does not exist. */

/* What a scene has beside layers, depth and points in the frame. */
enum {
    PLAIN = 0,
    WITH_FOCUS = 1,     /* a Focus clip */
    WITH_MASK = 2,      /* a Mask clip */
    WITH_CAMERA = 4,    /* metadata that names a camera */
    FOUR_DEPTHS = 8,    /* Depth has another depth in each channel */
    UNIT_DEPTH = 16,    /* depth is 0..1 */
    POINT_OUTSIDE = 32, /* point 1 is beside the frame */
    ANTIALIASED = 64,   /* edges of colour and depth mix what is on both sides */
};

typedef struct knob {
    const char *key;    /* # stands for the number of a point */
    const char *values; /* each gives another picture; NULL: all there are */
    const char *with;   /* what makes it matter: KEY=VALUE ... */
    unsigned scene;
} knob;

#define ADAPTIVE      "sampling=adaptive method=rays "
#define POINTS        "focusBy=surface focusPoints=16"
#define FEW_LINES     "wavelengths=3 "
#define SLOW_AND_FAST "singlet_biconvex_thorlabs_50 dgauss_codev_100_f2"
#define ALL_SIDES     "focalLength=50 fStop=0.2"

static const knob knobs[] = {
    {"cameraFrom", NULL, "", WITH_CAMERA},
    {"focalLength", "150 200", "", PLAIN},
    {"sensorWidth", "24 36", "", PLAIN},
    {"fStop", "2.8 4", "", PLAIN},
    {"focusDistance", "2 5 0 -8", "", PLAIN},
    {"breathing", NULL, "", PLAIN},
    {"focusBy", NULL, "focusPoints=5", PLAIN},
    {"focusClip", NULL, "", WITH_FOCUS},
    {"fieldCurvature", "-0.4 0 0.4", "", PLAIN},
    {"protectNear", "0 0.5", "", PLAIN},
    {"protectFar", "0 0.5", "", PLAIN},
    {"nearGain", "0 0.5 1", "", PLAIN},
    {"farGain", "0 0.5 1", "", PLAIN},
    {"focusPoints", "3 5", "focusBy=surface", PLAIN},
    {"focusPoints", "3 5", "focusBy=plane", PLAIN},
    {"focusFalloff", "2 4", POINTS, PLAIN},
    {"focusFade", "0 0.8", POINTS, POINT_OUTSIDE},
    {"focusPoint#", "12,7 50,30", POINTS, PLAIN},
    {"focusOffset#", "-0.3 0 0.3", POINTS, PLAIN},
    {"focusWeight#", "0 1 4", POINTS, PLAIN},
    {"focusDof#", "0 1 2", POINTS, PLAIN},
    {"useDepth", NULL, "", PLAIN},
    {"depthMode", NULL, ALL_SIDES, PLAIN},
    {"depthScale", "1 2", "", PLAIN},
    {"near", "0.5 1", "depthMode=normalised", UNIT_DEPTH},
    {"far", "5 50", "depthMode=normalised", UNIT_DEPTH},
    {"depthChannel", NULL, "", FOUR_DEPTHS},
    {"layers", "1 2", "", PLAIN},
    {"edgeRepair", NULL, "", ANTIALIASED},
    {"useMask", NULL, "", WITH_MASK},
    {"blades", "0 3 6", "", PLAIN},
    {"curvature", "-1 0 1", "blades=5", PLAIN},
    {"curvature", "-1 0 1", "blades=5 apertureForm=star", PLAIN},
    {"rotation", "0 30", "blades=5", PLAIN},
    {"aspect", "0.5 1 2", "", PLAIN},
    {"apertureForm", NULL, "blades=5", PLAIN},
    {"opening", "0 1", "blades=5", PLAIN},
    {"obstruction", "0 0.6", "", PLAIN},
    {"apodization", "0 1", "", PLAIN},
    {"edge", "-1 0 1", "", PLAIN},
    {"ringAmount", "0 1", "", PLAIN},
    {"ringCount", "2 3", "ringAmount=1", PLAIN},
    {"grainAmount", "0 1", "", PLAIN},
    {"grainSeed", "0 1", "grainAmount=1", PLAIN},
    {"catsEye", "-1 0 1", "", PLAIN},
    {"doorLeft", "0 1", "", PLAIN},
    {"doorRight", "0 1", "", PLAIN},
    {"doorBottom", "0 1", "", PLAIN},
    {"doorTop", "0 1", "", PLAIN},
    {"lens", NULL, FEW_LINES, PLAIN},
    {"lensDesign", SLOW_AND_FAST, FEW_LINES "lens=prescription", PLAIN},
    {"lensDesign", SLOW_AND_FAST, FEW_LINES "lens=seidel", PLAIN},
    {"lensDiagram", NULL, FEW_LINES "lens=diagram", PLAIN},
    {"lensResidual", "0 1 2", FEW_LINES "lens=diagram", PLAIN},
    {"lensGlass", NULL, FEW_LINES "lens=thick", PLAIN},
    {"lensGlass", "crown flint", FEW_LINES "lens=singlet", PLAIN},
    {"lensBending", "0 1", FEW_LINES "lens=singlet", PLAIN},
    {"lensThickness", "5 30", FEW_LINES "lens=singlet", PLAIN},
    {"bestFocus", NULL, FEW_LINES "lens=singlet", PLAIN},
    {"wavelengths", "1 4", "lens=thick", PLAIN},
    /* The reference shows what rays shows: that is what it is for. */
    {"method", "hybrid rays filter spread accumulate", "", PLAIN},
    {"method", "hybrid reference", "", PLAIN},
    {"sampling", NULL, "", PLAIN},
    {"targetError", "0.002 0.02", ADAPTIVE, PLAIN},
    {"maxRays", "32 256", ADAPTIVE "targetError=0", PLAIN},
    {"samples", "16 64", "", PLAIN},
    {"samples", "16 64", "method=rays", PLAIN},
    {"samples", "16 64", "method=spread", PLAIN},
    {"seed", "0 1", "", PLAIN},
    {"maxRadius", "0 3 20", "", PLAIN},
    {"output", NULL, "", PLAIN},
};

/* A step of an 8-bit display: less is not seen. */
#define SEEN (1 / 255.0)
enum { VALUES_MAX = 16, VALUE_SIZE = 64 };

static void set_key(wo_lens_blur_params *params, const char *key, const char *text)
{
    wo_error error = {WO_OK, ""};
    const wo_param *const row = wo_param_find(wo_lens_blur_table, WO_LENS_BLUR_PARAMS, key);
    if (!row || wo_param_parse(row, text, params, &error) != WO_OK)
        fail_msg("%s=%s: %s", key, text, row ? error.text : "no such parameter");
}

static const char *next_word(const char *text, char word[VALUE_SIZE])
{
    text += strspn(text, " ");
    const size_t length = strcspn(text, " ");
    assert_true(length < VALUE_SIZE);
    memcpy(word, text, length);
    word[length] = '\0';
    return length ? text + length : NULL;
}

static void set_all(wo_lens_blur_params *params, const char *with)
{
    char word[VALUE_SIZE];
    while ((with = next_word(with, word))) {
        char *const equals = strchr(word, '=');
        assert_non_null(equals);
        *equals = '\0';
        set_key(params, word, equals + 1);
    }
}

/* Where no number gives depth a meaning of its own: a wave. */
static double wave(int32_t x, int32_t y, double phase)
{
    return 0.5 + 0.5 * sin(phase + 0.11 * x + 0.07 * y);
}

/* Every pixel and the one to its right, half and half. */
static void mix_with_neighbours(const wo_image *picture)
{
    const wo_rect b = picture->bounds;
    for (int32_t y = b.y1; y < b.y2; y++)
        for (int32_t x = b.x1; x < b.x2 - 1; x++)
            for (int32_t k = 0; k < picture->components; k++)
                wo_image_at(picture, x, y)[k] =
                    0.5f * (wo_image_at(picture, x, y)[k] + wo_image_at(picture, x + 1, y)[k]);
}

static void add_clips(scene *s, unsigned what)
{
    wo_image *const depth = &s->clip[WO_CLIP_DEPTH];
    const wo_rect e = s->geometry.extent;
    wo_image *const focus = what & WITH_FOCUS ? scene_clip(s, WO_CLIP_FOCUS, 1) : NULL;
    wo_image *const mask = what & WITH_MASK ? scene_clip(s, WO_CLIP_MASK, 1) : NULL;
    if (what & FOUR_DEPTHS) {
        picture_free(depth);
        (void)scene_clip(s, WO_CLIP_DEPTH, 4);
    }
    for (int32_t y = e.y1; y < e.y2; y++)
        for (int32_t x = e.x1; x < e.x2; x++) {
            if (focus)
                *wo_image_at(focus, x, y) = (float)(1.2 + wave(x, y, 0));
            if (mask)
                *wo_image_at(mask, x, y) = (float)wave(x, y, 1);
            for (int k = 0; k < 4 && what & FOUR_DEPTHS; k++)
                wo_image_at(depth, x, y)[k] = (float)(1 + k + wave(x, y, k));
            if (what & UNIT_DEPTH)
                *wo_image_at(depth, x, y) /= 12;
        }
    if (what & ANTIALIASED) {
        mix_with_neighbours(&s->clip[WO_CLIP_SOURCE]);
        mix_with_neighbours(depth);
    }
    if (what & WITH_CAMERA) {
        assert_true(wo_camera_read(&s->geometry.camera, "wideopen:focalLength", "150"));
        assert_true(wo_camera_read(&s->geometry.camera, "wideopen:fStop", "2"));
        assert_true(wo_camera_read(&s->geometry.camera, "wideopen:focusDistance", "1.5"));
    }
}

static void make_scene(scene *s, unsigned what)
{
    scene_init(s, (wo_rect){0, 0, 64, 40});
    scene_fill_layers(s, 5);
    add_clips(s, what);
    set_all(&s->params, "focalLength=200 samples=16 maxRadius=20");
    rng r = {11};
    for (int i = 0; i < WO_FOCUS_POINTS; i++) {
        s->params.focus_point[i][0] = rng_range(&r, 4, 60);
        s->params.focus_point[i][1] = rng_range(&r, 4, 36);
        s->params.focus_offset[i] = rng_range(&r, -0.2, 0.2);
    }
    if (what & POINT_OUTSIDE)
        s->params.focus_point[0][0] = 70;
}

static int list_values(const wo_param *row, const char *values, char list[][VALUE_SIZE])
{
    int count = 0;
    if (values) {
        while ((values = next_word(values, list[count])))
            assert_true(++count < VALUES_MAX);
    } else if (row->type == WO_PARAM_BOOL) {
        strcpy(list[count++], "false");
        strcpy(list[count++], "true");
    } else {
        count = wo_param_choice_count(row);
        assert_true(count < VALUES_MAX);
        for (int i = 0; i < count; i++)
            snprintf(list[i], VALUE_SIZE, "%s", row->choices[i]);
    }
    assert_true(count >= 2);
    return count;
}

/* Are all pictures finite and no two of them alike? If not, says which, unless quiet. */
static bool turns(const wo_param *row, const knob *k, bool quiet)
{
    char list[VALUES_MAX][VALUE_SIZE];
    const int count = list_values(row, k->values, list);
    wo_image out[VALUES_MAX];
    scene s;
    bool good = true;
    make_scene(&s, k->scene);
    set_all(&s.params, k->with);
    for (int i = 0; i < count; i++) {
        set_key(&s.params, row->key, list[i]);
        out[i] = scene_render(&s, NULL);
        good = good && picture_finite(&out[i]);
        for (int j = 0; j < i; j++) {
            const double seen = picture_difference(&out[i], &out[j], out[i].bounds);
            if (seen > SEEN)
                continue;
            good = false;
            if (!quiet)
                print_error("%s: %s and %s differ by %g (%s)\n", row->key, list[j], list[i], seen,
                            k->with);
        }
    }
    for (int i = 0; i < count; i++)
        picture_free(&out[i]);
    scene_free(&s);
    return good;
}

static bool is_for(const knob *k, const char *key)
{
    const size_t stem = strcspn(k->key, "#");
    const char *const rest = key + stem;
    return k->key[stem] ? strncmp(k->key, key, stem) == 0 && *rest &&
                              strspn(rest, "0123456789") == strlen(rest)
                        : strcmp(k->key, key) == 0;
}

static void every_knob_turns(void **state)
{
    (void)state;
    bool used[WO_COUNT(knobs)] = {false};
    int dead = 0;
    for (size_t i = 0; i < WO_LENS_BLUR_PARAMS; i++) {
        const wo_param *const row = &wo_lens_blur_table[i];
        bool covered = false;
        for (size_t n = 0; n < WO_COUNT(knobs); n++)
            if (is_for(&knobs[n], row->key)) {
                covered = used[n] = true;
                dead += !turns(row, &knobs[n], false);
            }
        if (!covered)
            print_error("%s: no rule here says how it changes the picture\n", row->key);
        dead += !covered;
    }
    for (size_t n = 0; n < WO_COUNT(knobs); n++)
        if (!used[n])
            fail_msg("%s: a rule for no parameter", knobs[n].key);
    assert_int_equal(dead, 0);
}

/* The test finds knobs that do nothing: without what makes them matter, these are dead. */
static void dead_knobs_are_found(void **state)
{
    (void)state;
    static const knob dead[] = {
        {"fStop", "2.8 2.8", "", PLAIN},          {"ringCount", "2 3", "", PLAIN},
        {"focusFalloff", "2 4", "", PLAIN},       {"cameraFrom", NULL, "", PLAIN},
        {"depthChannel", NULL, "", PLAIN},        {"lensBending", "0 1", "", PLAIN},
        {"targetError", "0.002 0.02", "", PLAIN},
    };
    for (size_t n = 0; n < WO_COUNT(dead); n++) {
        const wo_param *const row =
            wo_param_find(wo_lens_blur_table, WO_LENS_BLUR_PARAMS, dead[n].key);
        assert_non_null(row);
        assert_false(turns(row, &dead[n], true));
    }
    assert_true(is_for(&(knob){.key = "focusPoint#"}, "focusPoint16"));
    assert_false(is_for(&(knob){.key = "focusPoint#"}, "focusPoints"));
    assert_false(is_for(&(knob){.key = "focusPoint"}, "focusPoint1"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_knob_turns),
        cmocka_unit_test(dead_knobs_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
