/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#ifndef WO_BRIDGE_RAYCAST_H
#define WO_BRIDGE_RAYCAST_H

#include "wideopen/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Straight rays against quadrangles, triangles, spheres and rods, by Embree. Geometries are added
   by one thread and numbered 0, 1, 2 ... in the order of adding; after wo_raycast_commit the set is
   constant and any number of threads may trace. On one machine the same geometry and the same
   array of rays give the same hits, bit for bit, whatever the number of threads. */
typedef struct wo_raycast wo_raycast;

WO_NODISCARD wo_status wo_raycast_create(wo_raycast **cast, wo_error *error);
void wo_raycast_destroy(wo_raycast **cast);

/* What a geometry is. CLOSED: its surface is the skin of a solid, outward normals are known, and
   WO_RAYS_FRONT_ONLY passes through the faces seen from inside. */
enum { WO_RAYCAST_OPEN = 0, WO_RAYCAST_CLOSED = 1 };

/* All arrays are copied. Counts are at least 1, indices below vertex_count. Faces wind
   counter-clockwise seen from outside. *geometry (if not NULL) gets the number.
   Quadrangles: hit.u runs from corner 0 to 1, hit.v from corner 0 to 3; equal corners 2 and 3 make
   a triangle.
   Spheres: x, y, z, radius. Rods: capsules from point first[i] to first[i] + 1, each point with a
   radius of its own; hit.u runs along; those of a chain share points. */
WO_NODISCARD wo_status wo_raycast_add_quads(wo_raycast *cast, int kind, const float (*vertices)[3],
                                            size_t vertex_count, const uint32_t (*faces)[4],
                                            size_t face_count, uint32_t *geometry, wo_error *error);
WO_NODISCARD wo_status wo_raycast_add_spheres(wo_raycast *cast, int kind, const float (*spheres)[4],
                                              size_t count, uint32_t *geometry, wo_error *error);
WO_NODISCARD wo_status wo_raycast_add_rods(wo_raycast *cast, int kind, const float (*points)[4],
                                           size_t point_count, const uint32_t *first, size_t count,
                                           uint32_t *geometry, wo_error *error);

/* Builds the search structure; nothing can be added afterwards. */
WO_NODISCARD wo_status wo_raycast_commit(wo_raycast *cast, wo_error *error);

/* A ray: points origin + t direction with 0 <= near <= t <= far. The direction has any length but
   0. */
typedef struct wo_ray {
    float origin[3];
    float near;
    float direction[3];
    float far;
} wo_ray;

#define WO_RAYCAST_NONE UINT32_MAX

typedef struct wo_hit {
    float t;
    uint32_t geometry; /* WO_RAYCAST_NONE = nothing was hit; the rest is then 0 */
    uint32_t primitive;
    float normal[3]; /* of any length; outwards for CLOSED */
    float u, v;      /* place on a quadrangle, or along a rod (u only) */
} wo_hit;

enum {
    WO_RAYS_ANY = 0,
    WO_RAYS_COHERENT = 1,  /* neighbours in the array go nearly the same way: a hint */
    WO_RAYS_FRONT_ONLY = 2 /* CLOSED geometries are hit from outside only */
};

/* Nearest hit of each ray. A ray whose near is above its far hits nothing. Does not fail. */
void wo_raycast_trace(const wo_raycast *cast, const wo_ray *rays, wo_hit *hits, size_t count,
                      int mode);

/* Is there anything between near and far? Does not fail. */
void wo_raycast_blocked(const wo_raycast *cast, const wo_ray *rays, bool *blocked, size_t count);

#ifdef __cplusplus
}
#endif
#endif
