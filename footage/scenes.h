/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_SCENES_H
#define WO_FOOTAGE_SCENES_H

#include "build.h"

/* The table of scenes. A new one is a row in scenes.c and a function. */
extern const wo_scene_entry wo_scene_entries[];
extern const size_t wo_scene_entry_count;

void wo_scene_still_life(wo_builder *b);
void wo_scene_night_lights(wo_builder *b);
void wo_scene_fence(wo_builder *b);
void wo_scene_hair(wo_builder *b);

/* Facts about the scenes with closed forms; all in camera coordinates, metres.
   two-planes: planes across the axis; the front one reaches from the left to a straight vertical
   edge, which the picture shows at width / 2 + F edge. The textures are waves of one cell round
   (centre_x, 0), colour a + (b - a) (0.5 + 0.25 (sin 2 pi X + sin 2 pi Y)), X and Y in cells. */
#define WO_TWO_PLANES_FRONT 0.8f
#define WO_TWO_PLANES_BACK  4.0f
#define WO_TWO_PLANES_EDGE  0.01f /* x / z */
typedef struct wo_wave_plane {
    float depth, centre_x, half;
    wo_texture texture;
} wo_wave_plane;
extern const wo_wave_plane wo_two_planes[2]; /* front, back */

/* lamp: one ball in the dark. */
extern const wo_lamp wo_single_lamp;

#endif
