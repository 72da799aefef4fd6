/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_HOST_INTERNAL_H
#define WO_HOST_INTERNAL_H

#include "found.h"

#include <fenv.h>
#include <pthread.h>
#include <stdatomic.h>

#define OFX_NO_DEFAULT_COLORSPACE_HEADER
#include "ofxColour.h"
#include "ofxCore.h"
#include "ofxGPURender.h"
#include "ofxImageEffect.h"

/* How it hangs together.

     host.c      the host, its notes and violations        process.c  what the whole process shares
     scan.c      directories and bundles                   load.c     binaries, Load and Unload
     binary.c    files that would bring dlopen down        find.c     plugins by name, all plugins
     catalogue.c what is known of plugins, as text         cache.c    the same in files
     apart.c     plugins described in other processes
     describe.c  descriptors -> plain structs              object.c   effects, clips, parameters
     props.c     property sets, prop_suite.c their suite   schema.c   which object has which
     extensions.c properties of makers of hosts
     actions.c   the one way into a plugin                 instance.c life of an instance
     clips.c     clips of an instance and their sources
     effect_suite.c images.c memory.c                      what plugins call for pixels
     param_suite.c values.c param_text.c                   what plugins and callers call for values
     threads.c messages.c                                  the other suites
     prepare.c   everything before pixels                  render.c   the render

   Plugins see handles that are numbers, never addresses: a slot of one table and the generation of
   that slot. A handle that was freed, or never existed, is found out without touching memory.

   Locks, outermost first: the binaries' lock (load.c), an instance's lock, the process lock
   (process.c: handles, property sets that plugins can reach), the host's lock (violations). No lock
   is held while a plugin or a callback of the caller runs, but for the binaries' locks while one is
   loaded, described or unloaded, and the render lock of plugins that are not thread-safe at all. */

/* The native colour config the host offers, by name. */
#define WO_NATIVE_CONFIG "ofx-native-v1.5_aces-v1.3_ocio-v2.3"

#define WO_INFINITE 1e9 /* canonical coordinates at or beyond this are "infinite" */

typedef struct wo_object wo_object;
typedef struct wo_entry wo_entry;

/* ----------------------------------------------------------------------------------- properties */

typedef enum wo_prop_type {
    WO_PROP_INT,
    WO_PROP_DOUBLE,
    WO_PROP_STRING,
    WO_PROP_POINTER
} wo_prop_type;

typedef union wo_prop_value {
    int number;
    double real;
    char *text;
    void *pointer;
} wo_prop_value;

/* A property an object has by nature. */
typedef struct wo_prop_row {
    const char *name;
    wo_prop_type type;
    int count; /* of values; 0 = any number, at first none */
    bool plugin_writes;
    double number; /* initial value of all */
    const char *text;
} wo_prop_row;

typedef struct wo_prop {
    char *name;
    wo_prop_type type;
    int fixed; /* dimension, 0 = any */
    int count;
    bool plugin_writes;
    bool touched; /* by the plugin */
    double number;
    const char *text; /* constant: for propReset */
    wo_prop_value *values;
} wo_prop;

/* In which actions a plugin may write into a set. */
typedef enum wo_props_when {
    WO_PROPS_NEVER,
    WO_PROPS_DESCRIBE, /* descriptors */
    WO_PROPS_INSTANCE, /* instances: in all actions but those of a render */
    WO_PROPS_ACTION    /* outArgs: while the action runs */
} wo_props_when;

typedef struct wo_props {
    void *handle;
    wo_host *host;
    wo_props_when when;
    char what[112]; /* "parameter 'mix'" */
    wo_prop *items;
    size_t count, capacity;
    bool failed;   /* some allocation failed: the set is not to be used */
    void *handout; /* the image this set describes, or NULL */
} wo_props;

/* Registers an empty set; failures show in ->failed, here and below. */
void wo_props_init(wo_props *props, wo_host *host, wo_props_when when, const char *format, ...)
    WO_PRINTF(4, 5);
void wo_props_clear(wo_props *props); /* unregisters, frees; takes a zeroed set */
void wo_props_add(wo_props *props, const wo_prop_row *rows, size_t count);
void wo_props_add_one(wo_props *props, const char *name, wo_prop_type type, int count,
                      bool plugin_writes);
void wo_props_copy(wo_props *to,
                   const wo_props *from); /* same names, types, values; none writable */
void wo_props_allow(wo_props *props, const char *name); /* the plugin may write it */

wo_prop *wo_props_find(const wo_props *props, const char *name);
void wo_props_set_int(wo_props *props, const char *name, int index, int value);
void wo_props_set_double(wo_props *props, const char *name, int index, double value);
void wo_props_set_text(wo_props *props, const char *name, int index, const char *value);
void wo_props_set_pointer(wo_props *props, const char *name, int index, void *value);
int wo_props_int(const wo_props *props, const char *name, int index, int otherwise);
double wo_props_double(const wo_props *props, const char *name, int index, double otherwise);
const char *wo_props_text(const wo_props *props, const char *name, int index,
                          const char *otherwise);
int wo_props_count(const wo_props *props, const char *name);
bool wo_props_has_text(const wo_props *props, const char *name, const char *value);

/* Helpers of prop_suite.c; the process lock is held. */
bool wo_prop_resize(wo_prop *prop, int count);
bool wo_prop_put_text(wo_prop *prop, int index, const char *value);
void wo_prop_reset(wo_prop *prop);

/* schema.c: rows by object. */
void wo_schema_host(wo_props *props, const wo_host_config *config);
void wo_schema_descriptor(wo_props *props);
void wo_schema_instance(wo_props *props);
void wo_schema_param_set(wo_props *props);
void wo_schema_clip(wo_props *props, const char *name);
void wo_schema_clip_instance(wo_props *props);
void wo_schema_image(wo_props *props);
bool wo_schema_param(wo_props *props, const char *type, const char *name);

/* extensions.c: whether a property no object of the standard has is somebody's extension; one note
   for each name that a plugin wants to write. */
bool wo_is_extension(const char *name);
void wo_note_extension(wo_host *host, const char *name);

/* -------------------------------------------------------------------------------------- process */

typedef enum wo_handle_kind {
    WO_HANDLE_PROPS = 1,
    WO_HANDLE_EFFECT,
    WO_HANDLE_PARAM_SET,
    WO_HANDLE_PARAM,
    WO_HANDLE_CLIP,
    WO_HANDLE_MEMORY,
    WO_HANDLE_MUTEX
} wo_handle_kind;

void wo_process_lock(void);
void wo_process_unlock(void);

/* NULL when there is no memory. Takes the process lock. */
void *wo_handle_add(wo_handle_kind kind, void *object);
/* The lock is held in these three. remove takes NULL. find gives NULL for a handle that is none.
   fault says what is wrong with it: "NULL", "freed already", "of another kind", "unknown". */
void wo_handle_remove(void *handle);
void *wo_handle_find(const void *handle, wo_handle_kind kind);
const char *wo_handle_fault(const void *handle, wo_handle_kind kind);

/* The host's side of OfxHost; one struct for the process, because a binary has one place to keep
 * it. */
OfxHost *wo_process_ofx_host(void);
WO_NODISCARD bool wo_process_enter(wo_host *host, const wo_host_config *config);
void wo_process_leave(wo_host *host);

/* What the code of plugins changes though it is not theirs: the working directory, the mask of new
   files, how this thread computes (a binary made for speed alone sets that as it is mapped). leave
   puts back how the thread computed at enter, and the rest as the process had it when its first
   host came. */
typedef struct wo_surroundings {
    fenv_t floats;
} wo_surroundings;

void wo_surroundings_enter(wo_surroundings *now);
void wo_surroundings_leave(const wo_surroundings *before);

/* --------------------------------------------------------------------------------------- frames */

#define WO_ACTION_LIST(X)                                                                          \
    X(WO_ACTION_LOAD, kOfxActionLoad)                                                              \
    X(WO_ACTION_UNLOAD, kOfxActionUnload)                                                          \
    X(WO_ACTION_DESCRIBE, kOfxActionDescribe)                                                      \
    X(WO_ACTION_DESCRIBE_IN_CONTEXT, kOfxImageEffectActionDescribeInContext)                       \
    X(WO_ACTION_CREATE, kOfxActionCreateInstance)                                                  \
    X(WO_ACTION_DESTROY, kOfxActionDestroyInstance)                                                \
    X(WO_ACTION_BEGIN_CHANGED, kOfxActionBeginInstanceChanged)                                     \
    X(WO_ACTION_CHANGED, kOfxActionInstanceChanged)                                                \
    X(WO_ACTION_END_CHANGED, kOfxActionEndInstanceChanged)                                         \
    X(WO_ACTION_PURGE, kOfxActionPurgeCaches)                                                      \
    X(WO_ACTION_SYNC, kOfxActionSyncPrivateData)                                                   \
    X(WO_ACTION_PREFERENCES, kOfxImageEffectActionGetClipPreferences)                              \
    X(WO_ACTION_COLOURSPACE, kOfxImageEffectActionGetOutputColourspace)                            \
    X(WO_ACTION_REGION, kOfxImageEffectActionGetRegionOfDefinition)                                \
    X(WO_ACTION_NEEDED, kOfxImageEffectActionGetRegionsOfInterest)                                 \
    X(WO_ACTION_FRAMES, kOfxImageEffectActionGetFramesNeeded)                                      \
    X(WO_ACTION_TIME_DOMAIN, kOfxImageEffectActionGetTimeDomain)                                   \
    X(WO_ACTION_IDENTITY, kOfxImageEffectActionIsIdentity)                                         \
    X(WO_ACTION_BEGIN_RENDER, kOfxImageEffectActionBeginSequenceRender)                            \
    X(WO_ACTION_RENDER, kOfxImageEffectActionRender)                                               \
    X(WO_ACTION_END_RENDER, kOfxImageEffectActionEndSequenceRender)

typedef enum wo_action {
#define WO_ACTION_ENUM(name, text) name,
    WO_ACTION_LIST(WO_ACTION_ENUM)
#undef WO_ACTION_ENUM
        WO_ACTION_COUNT
} wo_action;

typedef struct wo_tile wo_tile;

/* One action a thread is inside of; worker threads of the multithread suite hold a copy. */
typedef struct wo_frame {
    const struct wo_frame *outer;
    wo_host *host;
    wo_entry *entry;
    wo_object *object; /* NULL in Load and Unload */
    wo_action action;
    uint64_t serial;
    double time;
    double scale[2];
    wo_tile *tile; /* Render only */
    unsigned thread_index;
    bool spawned;
} wo_frame;

/* Of the calling thread; NULL outside of actions. */
const wo_frame *wo_frame_now(void);
void wo_frame_set(const wo_frame *frame);

/* May the action set parameters; fetch images; read parameters? */
bool wo_action_sets_params(wo_action action);
bool wo_action_gets_images(wo_action action);
const char *wo_action_text(wo_action action);

/* ------------------------------------------------------------------------------------- the host */

typedef struct wo_pool wo_pool;
typedef struct wo_module wo_module;
typedef struct wo_block wo_block;
typedef struct wo_mutex wo_mutex;

typedef struct wo_texts { /* a growing list of strings */
    char **items;
    size_t count, capacity;
} wo_texts;

typedef struct wo_binary wo_binary;

struct wo_host {
    wo_host_config config; /* without the directories */
    wo_pool *pool;
    pthread_mutex_t lock; /* violations, notes */
    wo_texts violations;
    wo_texts notes, failures;
    wo_texts noted;       /* keys of what is noted once */
    wo_texts describer;   /* command line; none = plugins are described here */
    char *cache;          /* folder, or NULL */
    bool cache_told;      /* that it cannot be written */
    wo_binary **binaries; /* in the order of the search */
    size_t binary_count, binary_capacity;
    size_t folder_count;         /* searched so far */
    const wo_host_found **found; /* by wo_host_survey */
    size_t found_count, found_capacity;
    wo_entry **entries;
    size_t entry_count, entry_capacity;
    wo_host_instance *instances;
    atomic_uint image_counter;    /* for unique identifiers */
    atomic_uint_least64_t serial; /* of the last action; images remember the one they belong to */
    wo_host *next;                /* process.c */
};

/* Writes down a breach. host may be NULL: the host of the present action, or any. Takes the host's
   lock only. */
void wo_violate(wo_host *host, const char *format, ...) WO_PRINTF(2, 3);
void wo_violate_in(const wo_frame *frame, const char *format, ...) WO_PRINTF(2, 3); /* afterwards */
wo_host *wo_host_to_blame(wo_host *host); /* host itself, or as above; NULL when there is none */
void wo_note(wo_host *host, const char *format, ...) WO_PRINTF(2, 3);
/* The same, once for each key. host may be NULL, as above. Any thread. */
void wo_note_once(wo_host *host, const char *key, const char *format, ...) WO_PRINTF(3, 4);
void wo_note_failure(wo_host *host, const char *format, ...) WO_PRINTF(2, 3); /* is a note, too */

/* false when out of memory. text is copied. */
bool wo_texts_add(wo_texts *texts, const char *text);
void wo_texts_clear(wo_texts *texts);
char *wo_text_copy(const char *text);
bool wo_text_set(char **place, const char *text); /* keeps the old one on failure */

/* Room for one more element of size bytes: the same or a new array; NULL when out of memory. */
void *wo_grow(void *array, size_t count, size_t *capacity, size_t size);

/* -------------------------------------------------------------------------------------- objects */

typedef struct wo_key {
    double time;
    double value[4];
    char *text;
} wo_key;

typedef struct wo_par { /* a parameter of a descriptor or an instance */
    void *handle;
    wo_object *owner;
    char *name;
    wo_host_param_type kind;
    int dimension;
    bool is_text;
    wo_props props;
    double value[4]; /* when there are no keys */
    char *text;
    wo_key *keys; /* by time */
    size_t key_count, key_capacity;
    bool plugin_changed; /* the plugin has set it and not been told yet */
    unsigned change;     /* as the how manieth of the instance */
} wo_par;

typedef struct wo_port { /* a clip of a descriptor or an instance */
    void *handle;
    wo_object *owner;
    char *name;
    wo_props props;
    bool output;
    /* of instances */
    bool connected;
    wo_host_source source;
    char *colourspace, *identity;
    int32_t components; /* as the plugin gets them */
    wo_texts wishes;    /* colourspaces */
    char *carries;      /* colourspace now, "" = unset */
    bool has_metadata;  /* props hold that of metadata_time */
    double metadata_time;
} wo_port;

struct wo_object { /* an effect: descriptor, descriptor in a context, or instance */
    void *handle;
    wo_host *host;
    wo_entry *entry;
    bool instance;
    char *context; /* full name; NULL for the plain descriptor */
    wo_props props;
    void *param_set;
    wo_props param_set_props;
    wo_par **params;
    size_t param_count, param_capacity;
    wo_port **ports;
    size_t port_count, port_capacity;
};

WO_NODISCARD bool wo_object_init(wo_object *object, wo_host *host, wo_entry *entry,
                                 const char *context, bool instance);
void wo_object_clear(wo_object *object);
wo_par *wo_object_param(const wo_object *object, const char *name); /* by name only */
wo_port *wo_object_port(const wo_object *object, const char *name);
/* NULL: out of memory, or for a parameter an unknown type. */
wo_par *wo_object_add_param(wo_object *object, const char *type, const char *name);
wo_port *wo_object_add_port(wo_object *object, const char *name);
/* Parameters and clips of a described context, with their properties and initial values. */
WO_NODISCARD bool wo_object_copy(wo_object *to, const wo_object *from,
                                 const wo_host_project *project);

/* values.c */
bool wo_param_type_of(const char *type, wo_host_param_type *kind, int *dimension, bool *is_text);
bool wo_par_is_integer(const wo_par *par);
bool wo_par_animates(const wo_par *par);
void wo_par_limits(const wo_par *par, int dimension, double *min, double *max);
void wo_par_at(const wo_par *par, double time, double values[4]);
const char *wo_par_text_at(const wo_par *par, double time);
WO_NODISCARD bool wo_par_set(wo_par *par, const double values[4], const char *text);
WO_NODISCARD bool wo_par_set_key(wo_par *par, double time, const double values[4],
                                 const char *text);
void wo_par_clear_keys(wo_par *par);
void wo_par_show_animating(wo_par *par); /* kOfxParamPropIsAnimating */
bool wo_par_delete_key(wo_par *par, double time);
int wo_par_find_key(const wo_par *par, double time, int direction);
void wo_par_slope(const wo_par *par, double time, double slope[4]);
void wo_par_integral(const wo_par *par, double from, double to, double integral[4]);
WO_NODISCARD bool wo_par_copy(wo_par *to, const wo_par *from, double offset, const double *range);
void wo_par_free_values(wo_par *par);

/* param_text.c: number at text in the C locale; NULL when there is none, else where it ends. */
const char *wo_read_number(const char *text, double *value);
int wo_print_number(char *buffer, size_t size, double value);
bool wo_words_match(const char *a, const char *b); /* but for case, blanks and signs */

/* -------------------------------------------------------------------------------------- plugins */

struct wo_entry {        /* a plugin of one host */
    wo_host_plugin info; /* its texts point into what follows */
    wo_host *host;
    wo_module *module;
    int index;         /* in the module */
    OfxPlugin *plugin; /* while it is loaded */
    char *identifier, *bundle, *binary;
    bool loaded;
    wo_object *descriptor;
    wo_object **contexts; /* described ones, parallel to context_infos */
    wo_host_context_info *context_infos;
    size_t context_count;
    const char **context_names;
    unsigned instance_count;
};

/* load.c; see catalogue.h, too */
void wo_entry_destroy(wo_entry **entry);
OfxStatus wo_entry_load(wo_entry *entry);
void wo_entry_unload(wo_entry *entry);
pthread_mutex_t *wo_entry_render_lock(wo_entry *entry);
/* binary.c: what is wrong with a file that is to be mapped; NULL when nothing is */
const char *wo_binary_fault(const char *path);
/* describe.c */
WO_NODISCARD bool wo_entry_describe(wo_entry *entry);
void wo_entry_forget(wo_entry *entry); /* frees what describing made */
/* A violation without the plugin's own name before it; NULL when there are not so many. */
const char *wo_own_violation(const wo_entry *entry, size_t index);
/* scan.c */
void wo_scan_directory(wo_host *host, const char *directory, bool must_exist);
void wo_scan_paths(wo_host *host, const char *paths);

/* ------------------------------------------------------------------------------------ instances */

typedef struct wo_buffer { /* memory of one picture, a row of guard below and above it */
    unsigned char *memory;
    size_t bytes;
    size_t pitch;  /* bytes from row to row, positive */
    size_t length; /* bytes of pixels in a row */
    wo_image view;
    uint64_t sum; /* of an input's pixels */
} wo_buffer;

typedef struct wo_handout { /* an image handle */
    struct wo_handout *next;
    wo_props props;
    wo_port *port;
    uint64_t serial;  /* of the action it was given in */
    wo_buffer buffer; /* inputs only */
} wo_handout;

struct wo_tile {
    wo_rect window;
    wo_host_region *needed; /* by port */
    wo_buffer output;
    bool direct;              /* output is the caller's memory */
    wo_host_region canonical; /* region of definition */
    wo_rect region;           /* the same in pixels */
    const wo_host_render_args *args;
};

struct wo_host_instance {
    wo_object object; /* first: handles of effects find it */
    const wo_host_context_info *context;
    wo_host_project project;
    double time; /* for paramGetValue outside of renders */
    bool alive;  /* CreateInstance has succeeded */
    bool notify;
    bool preferences_stale, colourspace_stale;
    bool has_region; /* the plugin has said where it has pixels at region_time */
    double region_time;
    wo_host_region region;
    wo_host_preferences preferences;
    wo_host_clip_preference *clip_preferences;
    pthread_mutex_t lock; /* what follows, up to the next comment */
    wo_handout *handouts;
    wo_error source_error;
    char *persistent;
    char *progress; /* label while a progress is going on */
    int edits;      /* paramEditBegin not ended */
    bool any_plugin_changed;
    unsigned changes;
    int64_t input_pixels;
    /* any thread */
    pthread_mutex_t publish_lock;
    atomic_bool rendering, stop;
    atomic_bool fatal; /* the plugin has declared it dead */
    atomic_int report;
    void *report_user;
    void (*publish)(void *user, const char *kind, const char *text);
    wo_host_instance *next;
};

/* Sends an action and checks the answer against the standard. frame gives object, action, time,
   scale and tile; the rest is filled in. An illegal answer becomes a violation and kOfxStatFailed.
 */
OfxStatus wo_act(wo_entry *entry, wo_frame *frame, wo_props *in, wo_props *out);
/* The same for an instance with a text when the answer is no success. */
WO_NODISCARD wo_status wo_act_on(wo_host_instance *instance, wo_frame *frame, wo_props *in,
                                 wo_props *out, OfxStatus *answer, wo_error *error);
const char *wo_ofx_status_text(OfxStatus status);
/* Tells the plugin that a parameter or clip has changed; then what it has changed itself. */
WO_NODISCARD wo_status wo_tell_changed(wo_host_instance *instance, const char *type,
                                       const char *name, const char *reason, wo_error *error);
void wo_mark_changed(wo_host_instance *instance, const char *param);

/* preferences.c: clip preferences and colourspaces, when they are stale */
WO_NODISCARD wo_status wo_prepare(wo_host_instance *instance, wo_error *error);

/* clips.c. Components a clip gets unless the plugin wishes others: of those it takes, the ones that
   suit its source best, or the first as long as it has none. */
int32_t wo_port_components(const wo_port *port);
wo_host_alpha wo_port_alpha(const wo_port *port); /* of the images a plugin gets of an input */
void wo_port_say_components(wo_port *port);       /* those of port->components */
/* Fills what all clips say of themselves and the defaults of the preferences; false when out of
   memory. */
WO_NODISCARD bool wo_clips_describe(wo_host_instance *instance);
/* First and last frame of all connected clips, those of the project when there is none. */
void wo_frames_of_inputs(const wo_host_instance *instance, double *first, double *last);

/* prepare.c */
typedef struct wo_clip_name {
    char text[256]; /* longer ones are cut, here and where they are read */
} wo_clip_name;
wo_clip_name wo_with_clip(const char *prefix, const wo_port *port); /* "OfxImageClipPropRoI_Mask" */
/* Begins the arguments of an action: its time, and with scale (or NULL) its render scale. */
void wo_arguments(wo_props *in, wo_props *out, wo_host_instance *instance, double time,
                  const double scale[2]);
wo_rect wo_region_pixels(wo_host_region region, double scale_x, double scale_y, double aspect);
wo_host_region wo_pixels_region(wo_rect pixels, double scale_x, double scale_y, double aspect);
bool wo_region_infinite(wo_host_region region);
wo_host_region wo_project_region(const wo_host_instance *instance);
WO_NODISCARD wo_status wo_default_region(wo_host_instance *instance, double time,
                                         wo_host_region *region, wo_error *error);
WO_NODISCARD wo_status wo_port_region(wo_port *port, double time, wo_host_region *region,
                                      wo_error *error);
WO_NODISCARD wo_status wo_ask_identity(wo_host_instance *instance, double time,
                                       const double scale[2], wo_rect window, wo_port **port,
                                       double *other_time, wo_error *error);

/* images.c */
WO_NODISCARD bool wo_buffer_make(wo_host *host, wo_buffer *buffer, wo_rect bounds,
                                 int32_t components);
void wo_buffer_free(wo_buffer *buffer);
bool wo_buffer_intact(const wo_buffer *buffer);  /* guards and padding */
uint64_t wo_buffer_sum(const wo_buffer *buffer); /* of the pixels */
/* Fills an output with a value no plugin writes; then looks for it inside and outside of the
 * window. */
void wo_buffer_blank(const wo_buffer *buffer);
void wo_buffer_check(const wo_frame *frame, const wo_buffer *buffer, wo_rect window);
WO_NODISCARD wo_status wo_fetch_pixels(wo_port *port, double time, const double scale[2],
                                       const wo_image *image, wo_error *error);
OfxStatus wo_image_hand_out(wo_host_instance *instance, wo_port *port, double time,
                            const OfxRectD *region, OfxPropertySetHandle *handle);
OfxStatus wo_image_take_back(OfxPropertySetHandle handle);
void wo_images_check_left(wo_host_instance *instance, uint64_t serial);
const char *wo_components_text(int32_t components);
int32_t wo_components_of(const char *text); /* 0 = none of ours */
void wo_convert_row(const float *from, int32_t from_components, float *to, int32_t to_components,
                    int32_t count);
/* Copies a window; both views hold it; components may differ. */
void wo_copy_window(const wo_image *from, const wo_image *to, wo_rect window);

/* memory.c */
void *wo_guarded_alloc(size_t bytes); /* zeroed, aligned to 64, guards round it; or NULL */
bool wo_guarded_intact(const void *memory, size_t bytes);
void wo_guarded_free(void *memory);
void wo_memory_forget(void); /* frees what belongs to no plugin, when the last host goes */
/* Violations for, and release of, what an instance (or with NULL the plugin) has not freed. */
void wo_memory_check_left(const OfxPlugin *plugin, const wo_object *object);

/* threads.c */
WO_NODISCARD wo_status wo_pool_create(unsigned threads, wo_pool **pool, wo_error *error);
void wo_pool_destroy(wo_pool **pool);
unsigned wo_pool_size(const wo_pool *pool);
void wo_mutexes_check_left(const OfxPlugin *plugin);

/* messages.c */
void wo_messages_check_left(wo_host_instance *instance);
bool wo_host_wants_stop(wo_host_instance *instance);

/* Table of a suite, or NULL. */
const void *wo_suite(const char *name, int version);

/* Effect of a handle, with a violation naming the function when it is none. The lock is not held.
 */
wo_object *wo_find_effect(const void *handle, const char *function);
wo_host_instance *wo_find_instance(const void *handle, const char *function);

#endif
