/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_MOCK_HOST_H
#define WO_TESTS_MOCK_HOST_H

#include "ofx/ofxImageEffect.h"
#include "ofx/ofxMultiThread.h"
#include "wideopen/image.h"
#include "wideopen/ofx_camera.h"
#include "wideopen/ofx_report.h"

/* A host that does what real hosts do and should not: lacks suites, half fills them, hands out
   bytes, lies about clips, runs out of memory. One at a time; the strict host is for everything
   else. */

enum {
    MOCK_NO_MEMORY = 1, /* suites that are not there */
    MOCK_NO_THREADS = 2,
    MOCK_NO_MESSAGE1 = 4,
    MOCK_NO_MESSAGE2 = 8,
    MOCK_NO_PROGRESS = 16,
    MOCK_NO_REPORT = 32,
    MOCK_NO_PROPERTIES = 64,
    MOCK_NO_PARAMS = 128,
    MOCK_HOLLOW_MESSAGE2 = 256, /* suites whose members are NULL */
    MOCK_HOLLOW_THREADS = 512,
    MOCK_HOLLOW_PROGRESS = 1024,
    MOCK_HOLLOW_EFFECT = 2048,    /* abort and image memory only */
    MOCK_NO_INSTANCE_DATA = 4096, /* kOfxPropInstanceData cannot be kept */
    MOCK_OVERLAYS = 8192,         /* it says that it supports them */
    MOCK_NO_INTERACT = 16384,
    MOCK_NO_DRAW = 32768,
    MOCK_HOLLOW_DRAW = 65536,
    MOCK_READ_ONLY = 131072, /* no function that sets parameters */
    MOCK_TIMELESS = 262144   /* nor one that reads them at a time */
};

/* How a host does without a parameter. */
typedef enum mock_loss {
    MOCK_LOSE_NOTHING,
    MOCK_LOSE_DEFINE,   /* it cannot be defined */
    MOCK_LOSE_HANDLE,   /* it is defined, and not found */
    MOCK_LOSE_VALUE,    /* it has no value */
    MOCK_LOSE_AT_TIME,  /* it has none at a time */
    MOCK_LOSE_SILENTLY, /* all is well, says the host, and writes nothing */
    MOCK_LOSSES
} mock_loss;

enum { MOCK_OUTPUT = 4, MOCK_CLIPS };

typedef enum mock_threading {
    MOCK_THREADS_REAL,   /* one thread for each call */
    MOCK_THREADS_SERIAL, /* one after the other on the caller */
    MOCK_THREADS_SAME,   /* real, but all say they are number 0 */
    MOCK_THREADS_MORE,   /* real, twice as many as asked for */
    MOCK_THREADS_FAIL,   /* an error, nothing is run */
    MOCK_THREADS_EMPTY   /* ok, nothing is run */
} mock_threading;

/* Pixels of a clip as this host stores them; data NULL: there is no image. */
typedef struct mock_picture {
    void *data; /* pixel (bounds.x1, bounds.y1) */
    wo_rect bounds;
    int row_bytes;
    const char *depth;
    const char *components;
    const char *alpha;                /* NULL: the image does not say */
    OfxRectD region;                  /* of definition, canonical; all 0 = bounds */
    wo_rect defined;                  /* what the image says of it, in pixels, if not empty */
    wo_rect first;                    /* if not empty: what is given unless a region is named */
    bool silent;                      /* clipGetImage fails */
    bool starved;                     /* clipGetImage has no memory */
    bool connected;                   /* what the clip says */
    const char *names[3], *values[3]; /* of its metadata; NULL: not said */
} mock_picture;

typedef struct mock_state {
    /* Set by the test. */
    unsigned flags;
    mock_threading threading;
    unsigned cpus;
    bool spawned;       /* the calling thread is one of the host's */
    const char *refuse; /* paramDefine answers Unsupported for this type */
    mock_loss lose;     /* what happens to the parameter lost, or with "" to all */
    const char *lost;
    const char *forget; /* property that no set has */
    long fail_after;    /* memoryAlloc fails from this call on; < 0 = never */
    int abort_after;    /* abort answers 1 from this call on; < 0 = never */
    bool cancel;        /* progressUpdate answers No */
    int report_mode;
    mock_picture pictures[MOCK_CLIPS]; /* Source, Depth, Mask, Extra, Output */

    /* Read by the test. */
    long allocations;
    int live_blocks, live_images, live_sets;
    int threads_started, multi_thread_calls;
    int messages, persistent; /* shown */
    char message[512];
    bool persistent_set;
    int progress_starts, progress_updates, progress_ends;
    double progress_last;
    char published[4096], kind[16];
    int values_set, edits_begun, edits_ended; /* of parameters */
    char edit[64];
} mock_state;

extern mock_state mock;

/* Everything back to a friendly host of two threads without pictures. */
void mock_reset(void);

/* The OfxHost; two calls give two different ones. */
OfxHost *mock_host(void);

/* Describes the plugin and makes an instance of it. NULL, and the answer in *status, if an action
   failed. The caller destroys it. */
OfxImageEffectHandle mock_create(OfxPlugin *plugin, const char *context, OfxStatus *status);
void mock_destroy(OfxPlugin *plugin, OfxImageEffectHandle effect);

/* Value of a parameter; false if there is none. */
bool mock_set_number(OfxImageEffectHandle effect, const char *name, double x, double y, double z);
bool mock_get_number(OfxImageEffectHandle effect, const char *name, double values[3]);
bool mock_set_text(OfxImageEffectHandle effect, const char *name, const char *text);

/* Property of the instance; a count of 0 takes it away. */
void mock_set_property(OfxImageEffectHandle effect, const char *name, int count,
                       const double *values);

/* Render action of a window, args as in the standard; scale NULL: not said, field NULL: not said.
 */
OfxStatus mock_render(OfxPlugin *plugin, OfxImageEffectHandle effect, wo_rect window,
                      const double scale[2], const char *field);

/* The other actions; texts and rectangles of outArgs come back. */
OfxStatus mock_identity(OfxPlugin *plugin, OfxImageEffectHandle effect, char clip[64]);
OfxStatus mock_region(OfxPlugin *plugin, OfxImageEffectHandle effect, OfxRectD *region);
OfxStatus mock_needed(OfxPlugin *plugin, OfxImageEffectHandle effect, OfxRectD region,
                      const char *clip, OfxRectD *needed);

/* Text of a property of the descriptor of a parameter (or "" for the effect), or NULL. */
const char *mock_param_text(OfxImageEffectHandle effect, const char *param, const char *property,
                            int index);

/* Pointer property of the effect, or NULL. */
void *mock_effect_pointer(OfxImageEffectHandle effect, const char *property);

/* Number a property of a clip's descriptor has; -1 if there is none. */
int mock_clip_number(OfxImageEffectHandle effect, const char *clip, const char *property);
int mock_param_count(OfxImageEffectHandle effect);
bool mock_has_param(OfxImageEffectHandle effect, const char *param);

#endif
