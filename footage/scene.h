/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_FOOTAGE_SCENE_H
#define WO_FOOTAGE_SCENE_H

#include "bridge/raycast.h"
#include "footage.h"
#include "texture.h"
#include "worker.h"

/* A scene ready to be seen: shapes in a ray caster, their textures, and maps of the light that
   falls on them. Everything is in camera coordinates. Const after wo_scene_light; then any number
   of threads may use it. */

/* How the light map lies on a shape. */
typedef enum wo_shape_kind {
    WO_SHAPE_SCREEN, /* one quadrangle; a map as seen from the camera */
    WO_SHAPE_QUADS,  /* one map for each quadrangle, by its u and v */
    WO_SHAPE_GRID,   /* a mesh of quadrangles; light at its vertices, normals too */
    WO_SHAPE_BALLS,  /* spheres, one octahedral map for each */
    WO_SHAPE_RODS    /* chains of capsules; light and its lean at their points */
} wo_shape_kind;

typedef struct wo_shape {
    wo_shape_kind kind;
    wo_texture texture;
    wo_affine to_texture; /* camera coordinates to cells */
    uint32_t primitives;
    uint32_t per_piece;  /* primitives that form one piece: something a ray enters once at most,
                            unless sheet says otherwise */
    float sheet;         /* m: faces of a piece further apart than this are different surfaces */
    bool both_sides;     /* light of both sides is shared: leaves, sheets */
    bool lit;            /* false: the texture is the radiance, there is no map */
    float (*tint)[3];    /* [pieces] factor of the texture, or NULL */
    float (*glow)[3];    /* [primitives] radiance added, or NULL */
    uint32_t first_lamp; /* of the scene's lamps, when glow is not NULL */
    int map_width, map_height; /* of one map */
    size_t texels;             /* of all maps, each of texel_floats numbers */
    int texel_floats;          /* RGB; RODS: RGB and three leans */
    float *map;
    float (*points)[4];   /* vertices, centres with radii, points with radii; for lighting */
    uint32_t (*quads)[4]; /* QUADS and SCREEN: corners of each */
    uint32_t *first;      /* RODS: first point of each */
    wo_vec *normals;      /* GRID: at vertices; of unit length */
    size_t point_count;
} wo_shape;

/* A glowing ball. */
typedef struct wo_lamp {
    wo_vec centre;
    float radius;
    float radiance[3];
} wo_lamp;

typedef struct wo_sun {
    wo_vec towards;  /* unit, to the light */
    float radius;    /* angular, radians */
    float colour[3]; /* irradiance across the beam over pi */
} wo_sun;

typedef struct wo_sky {
    wo_vec up;
    float zenith[3], horizon[3], ground[3]; /* radiance of the three directions */
    float bounce[3];                        /* radiance assumed where something is in the way */
} wo_sky;

#define WO_SUNS_MAX 2

typedef struct wo_scene {
    wo_raycast *cast;
    wo_noise noise;
    wo_shape *shapes; /* numbered as the geometries of cast */
    size_t shape_count, shape_room;
    wo_lamp *lamps;
    size_t lamp_count, lamp_room;
    wo_sky sky;
    wo_sun suns[WO_SUNS_MAX];
    int sun_count;
    float screen_x, screen_y; /* tangents of the half field, with room for a wide lens */
} wo_scene;

/* What a hit looks like. */
typedef struct wo_look {
    float rgb[3]; /* radiance without glow */
    int64_t lamp; /* number of the lamp that was hit, -1 = none */
} wo_look;

void wo_scene_shade(const wo_scene *scene, const wo_ray *ray, const wo_hit *hit, wo_look *look);

/* Adds the glow of look's lamp to rgb. */
static inline void wo_scene_add_glow(const wo_scene *scene, const wo_look *look, float rgb[3])
{
    if (look->lamp >= 0)
        for (int c = 0; c < 3; c++)
            rgb[c] += scene->lamps[look->lamp].radiance[c];
}

/* Unit normal of a hit for people: smooth, towards the viewer on open surfaces. */
wo_vec wo_scene_normal(const wo_scene *scene, const wo_ray *ray, const wo_hit *hit);

/* Names the piece that was hit; equal for the primitives of one piece. */
static inline uint64_t wo_scene_piece(const wo_scene *scene, const wo_hit *hit)
{
    const uint32_t piece = hit->primitive / scene->shapes[hit->geometry].per_piece;
    return (uint64_t)hit->geometry << 32 | piece;
}

/* Fills the light maps, as the progress's next stage of this share. */
WO_NODISCARD wo_status wo_scene_light(const wo_context *context, wo_scene *scene,
                                      wo_progress *progress, double share, wo_error *error);

/* Where a texel of a shape's maps lies and which way it looks. False where there is no surface. */
bool wo_shape_texel(const wo_scene *scene, const wo_shape *shape, size_t texel, wo_vec *point,
                    wo_vec *normal);

void wo_scene_destroy(const wo_context *context, wo_scene **scene);

#endif
