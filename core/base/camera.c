/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "wideopen/camera.h"

#include "number.h"

#include <math.h>
#include <string.h>

/* What is wrong with a spelling; "" = nothing. */
#define NOT_F_NUMBER "a T-stop counts the glass's losses: no f-number"
#define NOT_FOCUS    "the camera's target need not be in focus"
#define NOT_APERTURE "an exposure setting, not the lens opening"
#define UNITS_DIFFER "programs disagree on its unit"

typedef enum shape { NUMBER, FIRST, BOX_WIDTH, CONSTANT } shape;

/* One spelling: lower case, without prefix; * stands for anything. The unit of the attribute times
   scale is that of the value. */
typedef struct spelling {
    const char *name;
    wo_camera_value value;
    shape shape;
    double scale; /* CONSTANT: the value */
    double min, max;
    bool scene_units;
    const char *refused;
} spelling;

#define ROW(name, value, shape, scale, min, max)                                                   \
    {                                                                                              \
        name, value, shape, scale, min, max, false, NULL                                           \
    }
#define FOCAL(name)        ROW(name, WO_CAMERA_FOCAL_LENGTH, NUMBER, 1, 1, 5000)
#define SENSOR(name)       ROW(name, WO_CAMERA_SENSOR_WIDTH, NUMBER, 1, 3, 1000)
#define F_NUMBER(name)     ROW(name, WO_CAMERA_F_NUMBER, NUMBER, 1, 0.1, 1024)
#define FOCUS(name, scale) ROW(name, WO_CAMERA_FOCUS, NUMBER, scale, 1e-3, 1e9)
#define SCENE(name, value)                                                                         \
    {                                                                                              \
        name, value, NUMBER, 1, 1e-6, 1e9, true, NULL                                              \
    }
#define REFUSED(name, value, why)                                                                  \
    {                                                                                              \
        name, value, NUMBER, 1, 0, 0, false, why                                                   \
    }

/* The first row wins; camera_metadata.md says where each comes from. */
static const spelling spellings[] = {
    /* our own: the keys of the parameters, and their ranges */
    ROW("wideopen:focallength", WO_CAMERA_FOCAL_LENGTH, NUMBER, 1, 0.1, 1e5),
    ROW("wideopen:sensorwidth", WO_CAMERA_SENSOR_WIDTH, NUMBER, 1, 0.1, 1e5),
    ROW("wideopen:fstop", WO_CAMERA_F_NUMBER, NUMBER, 1, 0.01, 1e6),
    ROW("wideopen:focusdistance", WO_CAMERA_FOCUS, NUMBER, 1, -1e9, 1e9),
    ROW("wideopen:near", WO_CAMERA_NEAR, NUMBER, 1, 1e-6, 1e9),
    ROW("wideopen:far", WO_CAMERA_FAR, NUMBER, 1, 1e-6, 1e9),
    ROW("wideopen:depthscale", WO_CAMERA_UNITS, NUMBER, 1, 1e-9, 1e9),

    /* Unreal: Movie Render Queue; centimetres */
    FOCAL("unreal/*/focallength"),
    SENSOR("unreal/*/sensorwidth"),
    F_NUMBER("unreal/*/fstop"),
    FOCUS("unreal/*/focaldistance", 0.01),
    ROW("unreal/*/focaldistance", WO_CAMERA_UNITS, CONSTANT, 100, 0, 0),

    /* V-Ray, and Arnold's focal length. The field of view, which counts the fit of the film, comes
       before the film's own width. */
    FOCAL("camerafocallength"),
    ROW("camerafov", WO_CAMERA_FIELD_OF_VIEW, NUMBER, 1, 0.1, 175),
    SENSOR("cameraaperture"),
    F_NUMBER("camerafnumber"),
    SCENE("cameranearclip", WO_CAMERA_NEAR),
    SCENE("camerafarclip", WO_CAMERA_FAR),
    REFUSED("cameratargetdistance", WO_CAMERA_FOCUS, NOT_FOCUS),

    /* Arnold */
    SENSOR("camerafilmaperturehorizontal"),
    SCENE("arnold/camera/near_clip", WO_CAMERA_NEAR),
    SCENE("arnold/camera/far_clip", WO_CAMERA_FAR),

    /* RenderMan for Blender */
    FOCAL("focal"),
    SENSOR("haperture"),
    F_NUMBER("fstop"),
    SCENE("focaldistance", WO_CAMERA_FOCUS),

    /* Redshift */
    SCENE("rs/camera/doffocusdistance", WO_CAMERA_FOCUS),
    SCENE("rs/camera/nearplane", WO_CAMERA_NEAR),
    SCENE("rs/camera/farplane", WO_CAMERA_FAR),
    REFUSED("rs/camera/fov", WO_CAMERA_FIELD_OF_VIEW, UNITS_DIFFER),
    REFUSED("rs/camera/aperture", WO_CAMERA_SENSOR_WIDTH, UNITS_DIFFER),
    REFUSED("rs/camera/fstop", WO_CAMERA_F_NUMBER, NOT_APERTURE),

    /* Blender */
    FOCAL("lens"),

    /* OpenEXR. What other programs call aperture is a film back: 41.4 is none. */
    FOCAL("pinholefocallength"),
    FOCAL("effectivefocallength"),
    FOCAL("nominalfocallength"),
    ROW("aperture", WO_CAMERA_F_NUMBER, NUMBER, 1, 0.1, 32),
    FOCUS("focus", 1),
    ROW("sensorphotositepitch", WO_CAMERA_PHOTOSITE_PITCH, NUMBER, 1, 0.1, 100),
    ROW("sensoracquisitionrectangle", WO_CAMERA_PHOTOSITES, BOX_WIDTH, 1, 1, 1e6),
    ROW("sensoroveralldimensions", WO_CAMERA_SENSOR_WIDTH, FIRST, 1, 3, 1000),
    REFUSED("tstop", WO_CAMERA_F_NUMBER, NOT_F_NUMBER),

    /* Nuke, of photographs */
    FOCAL("input/focal_length"),
    F_NUMBER("input/fnumber"),
};

static const struct {
    const char *key, *unit;
} about[] = {
#define WO_CAMERA_ABOUT(name, key, unit) {key, unit},
    WO_CAMERA_LIST(WO_CAMERA_ABOUT)
#undef WO_CAMERA_ABOUT
};

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool starts(const char *name, const char *prefix)
{
    while (*prefix && lower(*name) == *prefix) {
        name++;
        prefix++;
    }
    return *prefix == 0;
}

static const char *bare(const char *name)
{
    static const char *const prefixes[] = {"exr/", "exrheader_"};
    for (size_t i = 0; i < WO_COUNT(prefixes); i++)
        if (starts(name, prefixes[i]))
            name += strlen(prefixes[i]);
    return name;
}

static bool equal(const char *name, const char *pattern)
{
    return starts(name, pattern) && strlen(name) == strlen(pattern);
}

/* One * at most, which stands for one character or more. */
static bool matches(const char *name, const char *pattern)
{
    const char *const star = strchr(pattern, '*');
    if (!star)
        return equal(name, pattern);
    const size_t before = (size_t)(star - pattern), after = strlen(star + 1);
    const size_t length = strlen(name);
    if (length < before + after + 1)
        return false;
    for (size_t i = 0; i < before; i++)
        if (lower(name[i]) != pattern[i])
            return false;
    return equal(name + length - after, star + 1);
}

static const char *skip_blanks(const char *text)
{
    return text + strspn(text, " \t");
}

/* Reads up to 4 numbers, all there are; 0 if text holds anything else. */
static int read_numbers(const char *text, double numbers[4])
{
    int count = 0;
    for (text = skip_blanks(text); *text; text = skip_blanks(text)) {
        const char *end;
        if (count == 4 || !wo_number_read(text, &end, &numbers[count]))
            return 0;
        text = end;
        count++;
    }
    return count;
}

/* How OpenEXR's focus says infinity. */
static bool is_infinity(const char *text)
{
    text = skip_blanks(text);
    return equal(text, "inf") || equal(text, "infinity");
}

/* The value of an attribute, in the unit of the spelling's value but for units of the scene; NULL
   or what is wrong with it. */
static const char *evaluate(const spelling *s, const char *text, double *value)
{
    static const int counts[] = {[NUMBER] = 1, [FIRST] = 2, [BOX_WIDTH] = 4};
    double numbers[4] = {0};
    *value = 0;
    if (s->refused)
        return s->refused;
    if (s->shape == CONSTANT) {
        *value = s->scale;
        return NULL;
    }
    if (s->value == WO_CAMERA_FOCUS && is_infinity(text))
        return NULL;
    if (read_numbers(text, numbers) != counts[s->shape])
        return "not a number";
    const double number = s->shape == BOX_WIDTH ? numbers[2] - numbers[0] + 1 : numbers[0];
    *value = number * s->scale;
    if (!(*value >= s->min && *value <= s->max))
        return s->value == WO_CAMERA_SENSOR_WIDTH && number > 0.1 && number < s->min
                   ? "too small for millimetres; inches?"
                   : "no camera has this";
    return NULL;
}

static void copy_name(char to[WO_CAMERA_NAME_SIZE], const char *name)
{
    size_t i = 0;
    /* Names come from files: nothing in them may disturb a terminal. */
    for (; name[i] && i < WO_CAMERA_NAME_SIZE - 1; i++)
        to[i] = name[i] >= ' ' && name[i] <= '~' ? name[i] : '?';
    to[i] = 0;
}

static void refuse(wo_camera *camera, const char *name, const char *why)
{
    wo_camera_refusal refusal = {.why = why};
    copy_name(refusal.name, name);
    for (int i = 0; i < camera->refused_count; i++)
        if (strcmp(camera->refused[i].name, refusal.name) == 0)
            return;
    if (camera->refused_count < WO_CAMERA_REFUSALS_MAX)
        camera->refused[camera->refused_count++] = refusal;
}

static void read_own(wo_camera *camera, const char *text)
{
    for (text = skip_blanks(text); *text; text = skip_blanks(text)) {
        const size_t length = strcspn(text, " \t");
        for (int i = 0; i < WO_CAMERA_VALUES; i++)
            if (strlen(about[i].key) == length && strncmp(about[i].key, text, length) == 0)
                camera->own[i] = true;
        text += length;
    }
}

bool wo_camera_read(wo_camera *camera, const char *name, const char *text)
{
    const char *const plain = bare(name);
    bool known = equal(plain, "wideopen:own");
    if (known)
        read_own(camera, text);
    for (size_t i = 0; i < WO_COUNT(spellings); i++) {
        const spelling *const s = &spellings[i];
        if (!matches(plain, s->name))
            continue;
        double value;
        const char *const wrong = evaluate(s, text, &value);
        const int32_t rank = (int32_t)i + 1;
        wo_camera_fact *const fact = &camera->facts[s->value];
        known = true;
        if (wrong) {
            refuse(camera, name, wrong);
        } else if (fact->rank == 0 || rank < fact->rank) {
            *fact = (wo_camera_fact){.value = value, .rank = rank, .scene_units = s->scene_units};
            copy_name(fact->name, name);
        }
    }
    return known;
}

static bool better(const wo_camera_fact *a, const wo_camera_fact *b)
{
    return a->rank > 0 && (b->rank == 0 || a->rank < b->rank);
}

/* The best of what tells the sensor's width. A field of view makes it such that the lens keeps the
   diameter of its pupil and the picture its angle. */
static bool sensor_width(const wo_camera *camera, double *number, const char **name)
{
    const wo_camera_fact *const width = &camera->facts[WO_CAMERA_SENSOR_WIDTH];
    const wo_camera_fact *const field = &camera->facts[WO_CAMERA_FIELD_OF_VIEW];
    const wo_camera_fact *const focal = &camera->facts[WO_CAMERA_FOCAL_LENGTH];
    const wo_camera_fact *const pitch = &camera->facts[WO_CAMERA_PHOTOSITE_PITCH];
    const wo_camera_fact *const sites = &camera->facts[WO_CAMERA_PHOTOSITES];
    const wo_camera_fact *best = width;
    double mm = width->value;
    if (focal->rank > 0 && better(field, best)) {
        best = field;
        mm = 2 * focal->value * tan(field->value * (3.14159265358979323846 / 360));
    }
    if (sites->rank > 0 && better(pitch, best)) {
        best = pitch;
        mm = 1e-3 * pitch->value * sites->value;
    }
    if (best->rank == 0 || !(mm >= 0.1 && mm <= 1e5))
        return false;
    *number = mm;
    *name = best->name;
    return true;
}

bool wo_camera_get(const wo_camera *camera, wo_camera_value value, double units_per_metre,
                   double *number, const char **name)
{
    if (value == WO_CAMERA_SENSOR_WIDTH)
        return sensor_width(camera, number, name);
    const wo_camera_fact *const fact = &camera->facts[value];
    const wo_camera_fact *const units = &camera->facts[WO_CAMERA_UNITS];
    if (fact->rank == 0)
        return false;
    double v = fact->value;
    if (fact->scene_units)
        v /= units->rank > 0 ? units->value : units_per_metre;
    if (!(fabs(v) <= 1e9) || (fact->scene_units && fact->value != 0 && !(v >= 1e-6)))
        return false;
    *number = v;
    *name = fact->name;
    return true;
}

const char *wo_camera_key(wo_camera_value value)
{
    return about[value].key;
}

const char *wo_camera_unit(wo_camera_value value)
{
    return about[value].unit;
}
