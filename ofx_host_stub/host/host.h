/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_HOST_H
#define WO_HOST_H

#include "wideopen/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A small, strict OpenFX host. It finds plugin bundles, describes what is in them, makes instances,
   feeds them pixels and collects what they render; every breach of the standard that a plugin
   commits is written down as a sentence (a "violation") instead of being tolerated or crashing.

       wo_host_create -> wo_host_find_plugin -> wo_host_instance_create
           -> wo_host_set_clip, wo_host_param_set_text ... -> wo_host_render (as often as wanted)
           -> wo_host_instance_destroy -> wo_host_destroy

   Pictures are 32-bit float, 1, 3 or 4 interleaved components, y up. Three kinds of numbers:
     canonical   project units, square pixels, scale 1: wo_host_region
     pixel       at the render scale asked for: wo_rect;  x = canonical * scale_x / pixel_aspect
     time        frames, may be fractional

   Threads: scanning, describing and destroying a host: one thread per host. An instance is used by
   one thread at a time; different instances may be used by different threads at once. Functions
   that may be called from anywhere say "any thread". Callbacks are called on the thread that
   called into the host, or on one of its pool's threads where said so. A callback that delivers
   pixels may itself render another instance (a graph of plugins), but not of an UNSAFE plugin.

   Errors: functions that can fail return a wo_status and write a sentence into *error (may be
   NULL). Pointers given back live as long as the object they came from, unless said otherwise. */

typedef struct wo_host wo_host;
typedef struct wo_host_instance wo_host_instance;

/* ------------------------------------------------------------------------------------- the host */

typedef enum wo_host_message {
    WO_HOST_MESSAGE_FATAL,
    WO_HOST_MESSAGE_ERROR,
    WO_HOST_MESSAGE_WARNING,
    WO_HOST_MESSAGE_INFO,
    WO_HOST_MESSAGE_LOG,
    WO_HOST_MESSAGE_QUESTION
} wo_host_message;

/* How the images handed to plugins lie in memory; legal but unusual layouts find wrong code. */
enum {
    WO_HOST_NEGATIVE_ROWS = 1, /* row bytes are negative: the lowest row is last in memory */
    WO_HOST_PADDED_ROWS = 2,   /* rows are an odd number of floats apart */
    WO_HOST_LARGER_IMAGES =
        4 /* inputs reach a little further than was asked, where there is more */
};

typedef struct wo_host_config {
    unsigned threads;               /* of the multithread suite; 0 = all cores */
    const char *const *directories; /* searched first, in this order; borrowed for the call */
    size_t directory_count;
    bool search_path; /* search OFX_PLUGIN_PATH, then the system's default directory, as well */

    /* How plugins are looked at. NULL: all that are found are loaded and described in this process;
       one that crashes or hangs takes it along. Else the command line, NULL at its end, of a
       program that gives what follows to wo_host_describer: then plugins are described in processes
       of their own, and only the one that wo_host_find_plugin gives is loaded here. Both copied. */
    const char *const *describer;
    const char *cache;       /* folder for what describers found out; NULL or "" = none */
    double describe_seconds; /* a step of a describer may take so long; 0 = 30 */

    bool background; /* what plugins are told: nobody is watching */
    bool strict;     /* guard areas round all images and memory, outsides of windows compared */
    unsigned layout; /* WO_HOST_NEGATIVE_ROWS ... */

    void *user; /* given to the three callbacks */

    /* A plugin says something; id may be "". Persistent messages come here when they are too long
       for the error of a call that fails. The return value matters for questions only: true is
       yes. Any thread. NULL = dropped, questions are answered no. */
    bool (*message)(void *user, wo_host_message type, const char *id, const char *text);

    /* Progress of a plugin, 0..1, -1 when it has ended; false cancels. Any thread. NULL = none. */
    bool (*progress)(void *user, const char *label, double fraction);

    /* Polled while plugins work: true stops the render. Any thread. NULL = never. */
    bool (*aborted)(void *user);
} wo_host_config;

/* Makes a host and scans the directories of *config; with a describer this only lists the bundles.
   Directories that do not exist and files that are no plugins are no failure: each leaves a note
   (wo_host_note). *host is NULL after a failure. */
WO_NODISCARD wo_status wo_host_create(const wo_host_config *config, wo_host **host,
                                      wo_error *error);

/* Destroys instances that were forgotten, unloads the plugins, joins the threads. Takes NULL; sets
 *host to NULL. */
void wo_host_destroy(wo_host **host);

/* Destroys instances that were forgotten and unloads the plugins, so that what they left behind can
   be read as violations. Afterwards descriptions, notes and violations can be read, nothing be
   made. */
void wo_host_unload(wo_host *host);

/* Searches one more directory, and those below it, for NAME.ofx.bundle. Names that begin with '@'
   are skipped; a plugin whose identifier and major version are known already is skipped unless its
   minor version is higher. */
WO_NODISCARD wo_status wo_host_scan(wo_host *host, const char *directory, wo_error *error);

/* What scanning and loading left out, and why, and extensions of OpenFX that plugins set and this
   host does not have: one sentence each. */
size_t wo_host_note_count(const wo_host *host);
const char *wo_host_note(const wo_host *host, size_t index);

/* Breaches of the standard by plugins, in the order they happened, equal sentences once:
   "identifier: action: what was done". The texts live until wo_host_violations_clear or
   wo_host_destroy. Any thread. */
size_t wo_host_violation_count(wo_host *host);
const char *wo_host_violation(wo_host *host, size_t index);
void wo_host_violations_clear(wo_host *host);

/* Number of threads plugins may use at once. */
unsigned wo_host_threads(const wo_host *host);

/* ---------------------------------------------------------------------------------- the plugins */

typedef enum wo_host_param_type {
    WO_HOST_PARAM_INTEGER,
    WO_HOST_PARAM_DOUBLE,
    WO_HOST_PARAM_BOOLEAN,
    WO_HOST_PARAM_CHOICE,     /* a number: index of the choice */
    WO_HOST_PARAM_STR_CHOICE, /* a text: key of the choice */
    WO_HOST_PARAM_RGBA,
    WO_HOST_PARAM_RGB,
    WO_HOST_PARAM_DOUBLE_2D,
    WO_HOST_PARAM_DOUBLE_3D,
    WO_HOST_PARAM_INTEGER_2D,
    WO_HOST_PARAM_INTEGER_3D,
    WO_HOST_PARAM_STRING,
    WO_HOST_PARAM_CUSTOM, /* a text only the plugin understands */
    WO_HOST_PARAM_GROUP,
    WO_HOST_PARAM_PAGE,
    WO_HOST_PARAM_PUSH_BUTTON
} wo_host_param_type;

/* One parameter as the plugin described it. Numbers are given for every dimension. */
typedef struct wo_host_param_info {
    const char *name;        /* unique */
    const char *script_name; /* = name unless the plugin says otherwise; either is accepted */
    const char *label;
    const char *hint;
    const char *parent; /* name of its group, or "" */
    const char *type;   /* OFX name: "OfxParamTypeDouble" */
    wo_host_param_type kind;
    int dimension; /* numbers in a value; 0 for texts, groups, pages and buttons */
    double initial[4];
    const char *initial_text;    /* STRING, CUSTOM, STR_CHOICE; else "" */
    double min[4], max[4];       /* hard range */
    double ui_min[4], ui_max[4]; /* range of a slider */
    double increment;
    int digits;                     /* behind the point */
    const char *double_type;        /* "OfxParamDoubleTypeAngle" ...; "" when it is no double */
    const char *string_mode;        /* "OfxParamStringIsFilePath" ...; "" when it is no string */
    const char *const *choices;     /* labels of the choices */
    const char *const *choice_keys; /* STR_CHOICE: their keys; NULL for CHOICE */
    size_t choice_count;
    bool normalised; /* initial is in fractions of the project size */
    bool animates;
    bool secret;
    bool enabled;
    bool evaluates; /* a change makes a new picture */
    bool persistent;
    bool open; /* GROUP: shown open at first */
} wo_host_param_info;

/* Bits of wo_host_clip_info.components. */
enum { WO_HOST_ALPHA = 1, WO_HOST_RGB = 2, WO_HOST_RGBA = 4 };

typedef struct wo_host_clip_info {
    const char *name;
    const char *label;
    unsigned components; /* WO_HOST_ALPHA ..., or-ed */
    bool output;
    bool optional;
    bool mask;
    bool temporal; /* may be asked for at other times than the rendered one */
    bool tiles;
} wo_host_clip_info;

/* A plugin as it describes itself in one context. */
typedef struct wo_host_context_info {
    const char *name;       /* "OfxImageEffectContextFilter" */
    const char *short_name; /* "Filter" */
    const wo_host_clip_info *clips;
    size_t clip_count;
    const wo_host_param_info *params; /* in the order of definition */
    size_t param_count;
} wo_host_context_info;

typedef enum wo_host_safety {
    WO_HOST_UNSAFE,        /* one render in the whole process */
    WO_HOST_INSTANCE_SAFE, /* one render for each instance */
    WO_HOST_FULLY_SAFE
} wo_host_safety;

typedef struct wo_host_plugin {
    const char *identifier; /* "org.wideopen.LensBlur" */
    unsigned version_major, version_minor;
    const char *label;
    const char *group; /* "Filter/Blur", "" when it says nothing */
    const char *description;
    const char *bundle;               /* path of the .ofx.bundle */
    const char *binary;               /* path of the file inside */
    const char *const *context_names; /* full names of the contexts it supports, known or not */
    size_t context_name_count;
    const wo_host_context_info *contexts; /* those this host can run: Filter, General, Generator */
    size_t context_count;
    wo_host_safety safety;
    bool tiles;
    bool multi_resolution;
    bool temporal;
    bool float_pixels;        /* takes 32-bit float; this host makes instances of no others */
    const char *colour_style; /* "OfxImageEffectColourManagementCore" ... */
    void *internal;
} wo_host_plugin;

/* Every plugin that was described in this process: all that were found, or with a describer those
   that wo_host_find_plugin has given. Their descriptions are complete: a plugin that fails to load
   or to describe itself is left out with a note. */
size_t wo_host_plugin_count(const wo_host *host);
const wo_host_plugin *wo_host_plugin_at(const wo_host *host, size_t index);

/* Plugin by its whole identifier, or by its last part ("LensBlur"), the nearest that fits: folders
   are asked in the order of the search, in each of them first the bundle of that name, then the
   others. Among those that are asked together a whole identifier wins over a last part, and then
   the highest version; a last part that fits several is ambiguous. With a describer nobody beyond
   the nearest is asked, and only the one that is given is loaded here. The error of a miss lists
   what there is; of an ambiguous last part, the candidates. */
WO_NODISCARD wo_status wo_host_find_plugin(wo_host *host, const char *name,
                                           const wo_host_plugin **plugin, wo_error *error);

/* Context by full or short name; NULL when the plugin does not have it. */
const wo_host_context_info *wo_host_find_context(const wo_host_plugin *plugin, const char *name);

/* Parameter by name or script name; clip by name; NULL when there is none. */
const wo_host_param_info *wo_host_find_param(const wo_host_context_info *context, const char *name);
const wo_host_clip_info *wo_host_find_clip(const wo_host_context_info *context, const char *name);

/* Short word of a parameter type: "double", "choice" ... */
const char *wo_host_param_type_text(wo_host_param_type type);

/* -------------------------------------------------------------------------------- the instances */

/* Canonical rectangle. Sides at or beyond +-1e9 mean "infinite". */
typedef struct wo_host_region {
    double x1, y1, x2, y2;
} wo_host_region;

/* The project an instance lives in. */
typedef struct wo_host_project {
    double size[2];   /* canonical */
    double offset[2]; /* of the lower left corner */
    double extent[2]; /* 0, 0 = offset + size */
    double pixel_aspect;
    double frame_rate;
    double first_frame, last_frame;
    bool interactive; /* somebody is watching */
} wo_host_project;

#define WO_HOST_PROJECT_INIT                                                                       \
    {                                                                                              \
        .size = {1920, 1080}, .pixel_aspect = 1, .frame_rate = 24, .first_frame = 1,               \
        .last_frame = 1                                                                            \
    }

/* Makes an instance in a context (full or short name; NULL = General if there, else Filter, else
   Generator). All parameters have their defaults, no clip is connected. *instance is NULL after a
   failure. */
WO_NODISCARD wo_status wo_host_instance_create(wo_host *host, const wo_host_plugin *plugin,
                                               const char *context, const wo_host_project *project,
                                               wo_host_instance **instance, wo_error *error);

/* Takes NULL; sets *instance to NULL. What the plugin left behind becomes violations. */
void wo_host_instance_destroy(wo_host_instance **instance);

/* Description the instance was made from. */
const wo_host_plugin *wo_host_instance_plugin(const wo_host_instance *instance);
const wo_host_context_info *wo_host_instance_context(const wo_host_instance *instance);

/* Text of the last persistent message the plugin has set and not cleared; "" when there is none.
   Lives until the next call with this instance. */
const char *wo_host_persistent_message(const wo_host_instance *instance);

/* Drops the plugin's caches; asks it to write private data into its parameters. */
WO_NODISCARD wo_status wo_host_purge(wo_host_instance *instance, wo_error *error);
WO_NODISCARD wo_status wo_host_sync(wo_host_instance *instance, wo_error *error);

/* ------------------------------------------------------------------------------- the parameters */

/* Whether changes made through the functions below are told to the plugin (BeginInstanceChanged,
   InstanceChanged, EndInstanceChanged). On at first. */
void wo_host_set_notify(wo_host_instance *instance, bool notify);

/* Sets a parameter from text:
     2.8            integer, double; true/false/on/off/yes/no/1/0 for a boolean
     0.5,0.25       values of more dimensions; one number alone is taken for all of them
     hexagon        choice: its key, its label, or its index; case, blanks and signs do not matter
     key@1:0,key@25:1.5     animation: key@frame:value, one for every key; the word key may be left
   out
                            ("@1:0,@25:1.5"); with more dimensions "key@1:0,0,key@25:10,4"
     any text       string, custom

   Numbers are read in the C locale, whole text, range checked; NaN and infinity are refused. Keys
   need a parameter that can animate. Setting a plain value drops all keys. */
WO_NODISCARD wo_status wo_host_param_set_text(wo_host_instance *instance, const char *name,
                                              const char *text, wo_error *error);

/* Sets all dimensions of a number parameter, constant over time (keys are dropped) or as a key. */
WO_NODISCARD wo_status wo_host_param_set(wo_host_instance *instance, const char *name,
                                         const double *values, int count, wo_error *error);
WO_NODISCARD wo_status wo_host_param_set_at(wo_host_instance *instance, const char *name,
                                            double time, const double *values, int count,
                                            wo_error *error);

/* Value at a time. Between keys numbers go along straight lines (integers rounded to nearest,
   booleans, choices and texts keep the last key's value); beyond the ends they stay. */
WO_NODISCARD wo_status wo_host_param_get(wo_host_instance *instance, const char *name, double time,
                                         double *values, int count, wo_error *error);

/* Value at a time in the form wo_host_param_set_text reads, choices as their label; returns the
   length as snprintf does, or -1 when there is no such value. */
int wo_host_param_get_text(wo_host_instance *instance, const char *name, double time, char *buffer,
                           size_t size);

/* Number of keys; 0 when it does not change over time or does not exist. */
unsigned wo_host_param_key_count(wo_host_instance *instance, const char *name);

/* Presses a push button. */
WO_NODISCARD wo_status wo_host_param_press(wo_host_instance *instance, const char *name,
                                           wo_error *error);

/* Present state, which a plugin may change: shown, enabled. false when it does not exist. */
bool wo_host_param_visible(wo_host_instance *instance, const char *name);
bool wo_host_param_enabled(wo_host_instance *instance, const char *name);

/* ------------------------------------------------------------------------------------ the clips */

typedef enum wo_host_alpha {
    WO_HOST_OPAQUE,
    WO_HOST_PREMULTIPLIED,
    WO_HOST_UNPREMULTIPLIED
} wo_host_alpha;

/* One request for pixels. */
typedef struct wo_host_request {
    double time;
    double scale_x, scale_y; /* render scale */
    wo_rect region;          /* pixels wanted, at that scale: the bounds of the image to fill */
} wo_host_request;

typedef void wo_host_add_metadata(void *to, const char *name, const char *value);

/* Where a clip's pixels come from. The struct is copied; user and the callbacks must stay valid
   until the clip gets another source or the instance is destroyed. */
typedef struct wo_host_source {
    void *user;
    int32_t components; /* of the pixels that pixels() writes: 1, 3 or 4 */
    wo_host_alpha alpha;
    double pixel_aspect;
    double frame_rate;
    double first_frame, last_frame;
    bool continuous;         /* has pictures between frames, too */
    const char *colourspace; /* "lin_rec709_srgb", "ofx_raw" ...; NULL = unknown. Copied. */
    const char *identity;    /* text that changes when the pixels do; NULL = none. Copied. */

    /* Canonical rectangle that has pixels at this time. Any thread. */
    wo_status (*region)(void *user, double time, wo_host_region *region, wo_error *error);

    /* Fills *image, whose memory, bounds (= request->region) and components are the host's; the
       memory is zeroed, so what lies outside the picture may be left alone. WO_ERR_NOT_FOUND: no
       picture at this time, plugins get black; any other failure makes the render fail with its
       text. Any thread, also several at once. */
    wo_status (*pixels)(void *user, const wo_host_request *request, const wo_image *image,
                        wo_error *error);

    /* NULL, or what is known of the picture at this time: calls add(to, name, value) for each
       attribute; the texts are copied. Plugins get them as wideopen/ofx_camera.h says. On the
       thread that asks for a region or a render, before the plugin is. */
    wo_status (*metadata)(void *user, double time, wo_host_add_metadata *add, void *to,
                          wo_error *error);
} wo_host_source;

#define WO_HOST_SOURCE_INIT                                                                        \
    {                                                                                              \
        .components = 4, .alpha = WO_HOST_PREMULTIPLIED, .pixel_aspect = 1, .frame_rate = 24,      \
        .first_frame = 1, .last_frame = 1                                                          \
    }

/* Connects a clip; source NULL disconnects it. Where a plugin's clip does not take the source's
   components the host converts: one channel is spread over R, G, B with alpha 1; RGBA gives its
   alpha to an Alpha clip, RGB its first channel. */
WO_NODISCARD wo_status wo_host_set_clip(wo_host_instance *instance, const char *clip,
                                        const wo_host_source *source, wo_error *error);

/* A picture in memory as a source, the same at all times: fill `still`, then
   source.user = &still, source.region = wo_host_still_region, source.pixels = wo_host_still_pixels.
   At scales below 1 pixels are averaged, or with nearest (depth, object numbers) picked. */
typedef struct wo_host_still {
    wo_image image;      /* pixels at scale 1 */
    double pixel_aspect; /* 0 = 1 */
    bool nearest;
} wo_host_still;

wo_status wo_host_still_region(void *still, double time, wo_host_region *region, wo_error *error);
wo_status wo_host_still_pixels(void *still, const wo_host_request *request, const wo_image *image,
                               wo_error *error);

/* ------------------------------------------------------------- what a plugin says before pixels */

typedef struct wo_host_clip_preference {
    const char *clip;
    bool connected;
    int32_t components; /* 1, 3, 4 */
    double pixel_aspect;
    const char *const *colourspaces; /* the plugin's wishes, best first */
    size_t colourspace_count;
    const char *colourspace; /* what the clip carries now; "" = unset */
} wo_host_clip_preference;

/* Answers of GetClipPreferences (and GetOutputColourspace), valid until the next call with this
   instance that changes anything. The Output is among the clips. */
typedef struct wo_host_preferences {
    const wo_host_clip_preference *clips; /* in the order of wo_host_context_info.clips */
    size_t clip_count;
    wo_host_alpha alpha; /* of the Output */
    double frame_rate;
    bool continuous;
    bool frame_varying; /* pictures differ from frame to frame even when nothing is animated */
} wo_host_preferences;

WO_NODISCARD wo_status wo_host_get_preferences(wo_host_instance *instance,
                                               const wo_host_preferences **preferences,
                                               wo_error *error);

/* Where the plugin has pixels, canonical and as whole pixels; an infinite region is cut to the
 * project. */
WO_NODISCARD wo_status wo_host_get_region(wo_host_instance *instance, double time, double scale_x,
                                          double scale_y, wo_host_region *region, wo_rect *pixels,
                                          wo_error *error);

/* What it needs of each clip for a region; needed has one element per clip of the context, Output's
   stays empty. Not cut to the clips' own regions. */
WO_NODISCARD wo_status wo_host_get_needed(wo_host_instance *instance, double time, double scale_x,
                                          double scale_y, wo_host_region region,
                                          wo_host_region *needed, size_t count, wo_error *error);

/* Frames it needs of each clip at a time: [2 * i] first, [2 * i + 1] last of range i of a clip.
   Only the first range of each clip is given. */
WO_NODISCARD wo_status wo_host_get_frames_needed(wo_host_instance *instance, double time,
                                                 double (*ranges)[2], size_t count,
                                                 wo_error *error);

/* First and last frame that make sense; General context: the plugin is asked. */
WO_NODISCARD wo_status wo_host_get_time_domain(wo_host_instance *instance, double *first,
                                               double *last, wo_error *error);

/* ----------------------------------------------------------------------------------- the render */

/* What plugins with the WideOpen report suite are asked for. */
typedef enum wo_host_report {
    WO_HOST_REPORT_NONE,
    WO_HOST_REPORT_RENDER, /* render and say what it cost: kind "report" */
    WO_HOST_REPORT_EXPLAIN /* say what would be done, render nothing: kind "plan" */
} wo_host_report;

typedef struct wo_host_render_args {
    double time;
    double scale_x, scale_y;         /* 0 < scale <= 1 as a rule; 1, 1 = full size */
    wo_rect window;                  /* pixels at that scale; empty = all the plugin has */
    int32_t tile_width, tile_height; /* 0 = no tiles in this direction */
    unsigned parallel_tiles; /* tiles rendered at once, if the plugin is fully safe; 0 = 1 */
    double first_frame, last_frame,
        frame_step; /* of the sequence this is part of; all 0 = this time */
    bool interactive;
    bool draft;
    wo_host_report report;
    void *report_user;
    /* Texts the plugin publishes, one call at a time. Any thread. */
    void (*publish)(void *user, const char *kind, const char *text);
} wo_host_render_args;

#define WO_HOST_RENDER_INIT                                                                        \
    {                                                                                              \
        .scale_x = 1, .scale_y = 1                                                                 \
    }

/* What happened; filled also when the render fails, as far as it got. */
typedef struct wo_host_render_result {
    wo_rect window;            /* what was rendered */
    wo_host_region region;     /* region of definition */
    bool identity;             /* nothing was rendered: Output is a copy of a clip */
    const char *identity_clip; /* NULL when it is not; lives as long as the instance's context */
    double identity_time;
    unsigned tiles;       /* render actions sent */
    double seconds;       /* wall clock inside render actions, summed over tiles */
    int64_t input_pixels; /* handed to the plugin */
} wo_host_render_result;

/* Renders one picture with all calls in their legal order: GetClipPreferences (when something has
   changed), GetRegionOfDefinition, IsIdentity, GetRegionsOfInterest, GetFramesNeeded (if the plugin
   looks at other frames), BeginSequenceRender, Render for each tile, EndSequenceRender.

   output: a view whose bounds hold the window and whose components are those of the preferences, or
   one with data = NULL: the host then allocates it and the caller frees it with
   wo_host_image_free. Pixels of a given view outside the window stay untouched; those of the window
   that the plugin has no picture for, and all of them with WO_HOST_REPORT_EXPLAIN, are 0. A plugin
   that does no tiles renders all it has, and the window is cut out. After a failure an allocated
   output is NULL again. result may be NULL. Returns WO_ABORTED when it was stopped. */
WO_NODISCARD wo_status wo_host_render(wo_host_instance *instance, const wo_host_render_args *args,
                                      wo_image *output, wo_host_render_result *result,
                                      wo_error *error);

void wo_host_image_free(wo_image *image);

/* Stops the render that is going on in this instance; without one, nothing. Any thread. */
void wo_host_abort(wo_host_instance *instance);

#ifdef __cplusplus
}
#endif
#endif
