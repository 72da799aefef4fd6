/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_BUILD_H
#define WO_FOOTAGE_BUILD_H

#include "random.h"
#include "scene.h"

/* Tools that scene descriptions are written with. The world has y up and the floor at 0; the camera
   stands where wo_build_camera puts it, looking along -z. The first failure sticks in status and
   all later calls do nothing, so descriptions need no checks. One thread. */
typedef struct wo_builder {
    const wo_context *context;
    wo_error *error;
    wo_status status;
    wo_scene *scene;
    wo_affine to_camera;
    wo_random random;
} wo_builder;

/* Where a thing stands and how it is turned: degrees about y, then x, then z of its own. */
typedef struct wo_pose {
    wo_vec at;
    float yaw, pitch, roll;
} wo_pose;

/* A description in the table of scenes. */
typedef struct wo_scene_entry {
    wo_footage_scene about;
    void (*build)(wo_builder *builder);
} wo_scene_entry;

/* Makes the scene of an entry, its light not yet computed; tangents are those of the half field. */
WO_NODISCARD wo_status wo_scene_create(const wo_context *context, const wo_scene_entry *entry,
                                       uint64_t seed, double tangent_x, double tangent_y,
                                       wo_scene **scene, wo_error *error);

/* First of all: eye height and downward tilt in degrees. */
void wo_build_camera(wo_builder *b, float height, float tilt);
void wo_build_sky(wo_builder *b, const wo_sky *sky); /* up is set here */
/* yaw from +z towards +x, height above the horizon, radius: degrees. */
void wo_build_sun(wo_builder *b, float yaw, float height, float radius, const float colour[3]);

/* The point at depth behind a place of the picture, -1..1 from edge to edge in both directions. */
wo_vec wo_build_view(const wo_builder *b, float x, float y, float depth);

float wo_build_random(wo_builder *b, float low, float high);
/* A colour of the given brightness, any hue, saturation 0..1. */
void wo_build_colour(wo_builder *b, float saturation, float value, float rgb[3]);

/* Zeroed memory, NULL after a failure; a description gives back what it took for itself. */
void *wo_build_new(wo_builder *b, size_t count, size_t size);
void wo_build_free(wo_builder *b, void *room);

/* Flat things: centre and two half edges; the texture lies in their plane, y along the second. A
   ground is large and mapped from the camera, panels are ordinary. Unlit ones show their texture as
   it is. The side that looks along half_a x half_b is the lit one. */
void wo_build_ground(wo_builder *b, wo_vec centre, wo_vec half_a, wo_vec half_b,
                     const wo_texture *texture);
void wo_build_panel(wo_builder *b, wo_vec centre, wo_vec half_a, wo_vec half_b,
                    const wo_texture *texture);
void wo_build_chart(wo_builder *b, wo_vec centre, wo_vec half_a, wo_vec half_b,
                    const wo_texture *texture); /* unlit */

void wo_build_box(wo_builder *b, const wo_pose *pose, wo_vec half, const wo_texture *texture);
void wo_build_ball(wo_builder *b, const wo_pose *pose, float radius, const wo_texture *texture);

/* Closed meshes; y is their axis, the pose stands for the centre of a torus and for the foot of
   what is turned on a lathe. profile holds (radius, height) from the bottom to the top, joined by
   smooth curves; equal neighbours make a corner. */
void wo_build_torus(wo_builder *b, const wo_pose *pose, float radius, float tube,
                    const wo_texture *texture);
void wo_build_lathe(wo_builder *b, const wo_pose *pose, const float (*profile)[2], int count,
                    const wo_texture *texture);

/* Glowing balls: x, y, z, radius each, and radiance. */
void wo_build_lamps(wo_builder *b, const float (*balls)[4], const float (*radiance)[3], int count);

/* Chains of rods: each has length points (x, y, z, radius), one tint each. */
void wo_build_rods(wo_builder *b, const float (*points)[4], int chains, int length,
                   const float (*tints)[3], const wo_texture *texture);
/* One straight rod. */
void wo_build_rod(wo_builder *b, wo_vec from, wo_vec to, float radius, const wo_texture *texture);

/* Leaves: flat quadrangles lit from both sides, four corners and one tint each. */
void wo_build_leaves(wo_builder *b, const wo_vec (*corners)[4], int count, const float (*tints)[3],
                     const wo_texture *texture);

#endif
