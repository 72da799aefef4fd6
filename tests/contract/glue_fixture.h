/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_TESTS_GLUE_FIXTURE_H
#define WO_TESTS_GLUE_FIXTURE_H

#include "mock_host.h"
#include "ofx_pixels.h"
#include "plugins/probe_effect.h"

/* The probe plugin under the mock host, pictures for it, and what it must make of them. */

extern OfxPlugin *probe;
extern int (*probe_count)(void);
extern OfxPlugin *(*probe_get)(int nth);
extern OfxStatus (*probe_set_host)(const OfxHost *host);

/* cmocka fixtures: map the binary once; load the plugin into a friendly host, and check at the end
   that everything was given back. */
int fixture_open(void **state);
int fixture_close(void **state);
int fixture_load(void **state);
int fixture_unload(void **state);

/* Frees what pictures were made, here and below, and takes them from the mock. */
void fixture_free_pictures(void);

enum { PICTURE_NEGATIVE = 1, PICTURE_PADDED = 2, PICTURE_MISALIGNED = 4 };

/* Makes memory for a picture of exactly its pixels and fills it with noise in 0..1 that every depth
   can hold exactly. Freed by fixture_unload. */
void picture_make(mock_picture *picture, wo_rect bounds, const char *depth, const char *components,
                  unsigned layout, unsigned seed);

/* Fills all pixels with one byte. */
void picture_fill(const mock_picture *picture, int byte);

/* A view of an image with a border of zeros, RGBA with alpha 1 inside if it was RGB: what is
   expected of colour and masks that end within the frame. Freed by fixture_unload. */
wo_image picture_border(const wo_image *image, wo_rect bounds);

/* The same pixels as 32-bit float in the components that OpenFX gave, in memory of their own; data
   NULL for a picture that is not there. */
wo_image picture_floats(const mock_picture *picture);

/* One value of a picture as stored, decoded. */
float picture_value(const mock_picture *picture, int32_t x, int32_t y, int component);

/* What the effect itself makes of the mock's pictures: RGBA floats of the window. Freed by
   fixture_unload. */
typedef struct expected {
    probe_params params;
    wo_geometry geometry;
    wo_alpha alpha;
} expected;

void expect_defaults(expected *e); /* 100x50 project, Source alone, scale 1 */
const float *expect_pixels(const expected *e, wo_rect window);

/* Checks that Output holds those pixels inside the window, converted to its depth and components.
 */
void assert_output(const float *pixels, wo_rect window);

/* An instance in a context; fails the test if there is none. */
OfxImageEffectHandle create(const char *context);

/* Renders, wants this status. */
void render(OfxImageEffectHandle effect, wo_rect window, OfxStatus status);

/* Plan that the probe prints for a window. */
const char *explain(OfxImageEffectHandle effect, wo_rect window, const double scale[2]);

#endif
