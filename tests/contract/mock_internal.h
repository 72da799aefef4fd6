/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_MOCK_INTERNAL_H
#define WO_TESTS_MOCK_INTERNAL_H

#include "mock_host.h"

/* mock_host.c: suites without objects. mock_props.c: property sets. mock_params.c: parameters.
   mock_objects.c: clips, actions. mock_overlay.c: interacts and what they draw. */

enum { PROPS_MAX = 64, VALUES_MAX = 24 };

typedef struct prop {
    char name[80];
    char type; /* 'i', 'd', 's', 'p' */
    int count;
    union {
        int i;
        double d;
        char *s;
        void *p;
    } values[VALUES_MAX];
} prop;

struct OfxPropertySetStruct {
    prop items[PROPS_MAX];
    int count;
};

enum { PARAMS_MAX = 32 };

struct OfxParamStruct {
    char name[64], type[32];
    OfxPropertySetHandle props;
    double numbers[3];
    char *text;
};

struct OfxParamSetStruct {
    struct OfxParamStruct items[PARAMS_MAX];
    int count;
};

struct OfxImageClipStruct {
    char name[32];
    OfxPropertySetHandle props;
    const mock_picture *picture;
};

struct OfxImageEffectStruct {
    OfxPropertySetHandle props;
    struct OfxParamSetStruct params;
    struct OfxImageClipStruct clips[MOCK_CLIPS];
    int clip_count;
};

OfxPropertySetHandle set_new(void);
void set_free(OfxPropertySetHandle set);
prop *prop_find(OfxPropertySetHandle set, const char *name); /* NULL: there is none */
void prop_clear(prop *p);
OfxStatus put_int(OfxPropertySetHandle set, const char *name, int index, int value);
OfxStatus put_double(OfxPropertySetHandle set, const char *name, int index, double value);
OfxStatus put_text(OfxPropertySetHandle set, const char *name, int index, const char *value);
OfxStatus put_pointer(OfxPropertySetHandle set, const char *name, int index, void *value);
OfxStatus get_int(OfxPropertySetHandle set, const char *name, int index, int *value);
OfxStatus get_double(OfxPropertySetHandle set, const char *name, int index, double *value);
OfxStatus get_text(OfxPropertySetHandle set, const char *name, int index, char **value);
OfxStatus get_pointer(OfxPropertySetHandle set, const char *name, int index, void **value);

void take_defaults(OfxImageEffectHandle effect); /* of the descriptor, as its values */

const void *mock_suite(const char *name, int version);
const void *mock_property_suite(void);
const void *mock_param_suite(void);
const void *mock_effect_suite(bool hollow);
const void *mock_interact_suite(void);
const void *mock_draw_suite(bool hollow);

OfxStatus mock_image_alloc(OfxImageEffectHandle effect, size_t bytes, OfxImageMemoryHandle *handle);
OfxStatus mock_image_free(OfxImageMemoryHandle handle);
OfxStatus mock_image_lock(OfxImageMemoryHandle handle, void **data);
OfxStatus mock_image_unlock(OfxImageMemoryHandle handle);
int mock_abort(OfxImageEffectHandle effect);

void mock_settle(void);

/* Property sets alive; forgets them if told so. */
int mock_allocations_of_sets(bool forget);

#endif
