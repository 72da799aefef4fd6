/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "bridge/raycast.h"

#include <embree3/rtcore.h>

#include <stdlib.h>
#include <string.h>

enum { PACKET = 8 };

struct wo_raycast {
    RTCDevice device;
    RTCScene scene;
};

static const char *error_name(enum RTCError code)
{
    switch (code) {
    case RTC_ERROR_INVALID_ARGUMENT:
        return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
        return "invalid operation";
    case RTC_ERROR_OUT_OF_MEMORY:
        return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU:
        return "this processor is not supported";
    case RTC_ERROR_CANCELLED:
        return "cancelled";
    default:
        return "unknown fault";
    }
}

/* Reads and clears this thread's error of the device (NULL: of one that could not be made). */
static wo_status check(RTCDevice device, const char *what, wo_error *error)
{
    const enum RTCError code = rtcGetDeviceError(device);
    if (code == RTC_ERROR_NONE)
        return WO_OK;
    return wo_fail(error, code == RTC_ERROR_OUT_OF_MEMORY ? WO_ERR_NOMEM : WO_ERR_LIBRARY,
                   "Embree, %s: %s", what, error_name(code));
}

wo_status wo_raycast_create(wo_raycast **cast, wo_error *error)
{
    *cast = NULL;
    wo_raycast *made = calloc(1, sizeof *made);
    if (!made)
        return wo_fail(error, WO_ERR_NOMEM, "no memory for a ray caster");
    /* One building thread: the search structure, and so ties between hits, never vary. */
    made->device = rtcNewDevice("threads=1,set_affinity=0");
    if (!made->device) {
        free(made);
        WO_TRY(check(NULL, "opening", error));
        return wo_fail(error, WO_ERR_LIBRARY, "Embree gave no device");
    }
    made->scene = rtcNewScene(made->device);
    if (made->scene)
        rtcSetSceneFlags(made->scene,
                         RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    wo_status status = check(made->device, "making a scene", error);
    if (status == WO_OK && !made->scene)
        status = wo_fail(error, WO_ERR_LIBRARY, "Embree gave no scene");
    if (status != WO_OK)
        wo_raycast_destroy(&made);
    *cast = made;
    return status;
}

void wo_raycast_destroy(wo_raycast **cast)
{
    wo_raycast *const old = *cast;
    if (!old)
        return;
    if (old->scene)
        rtcReleaseScene(old->scene);
    rtcReleaseDevice(old->device);
    free(old);
    *cast = NULL;
}

/* One buffer of a geometry: count records of bytes each, copied. */
typedef struct buffer {
    enum RTCBufferType type;
    enum RTCFormat format;
    const void *data;
    size_t bytes, count;
} buffer;

static wo_status add(wo_raycast *cast, enum RTCGeometryType type, int kind, const buffer *buffers,
                     size_t buffer_count, uint32_t *geometry, wo_error *error)
{
    for (size_t i = 0; i < buffer_count; i++)
        if (!buffers[i].data || buffers[i].count == 0 || buffers[i].count >= UINT32_MAX)
            return wo_fail(error, WO_ERR_ARGUMENT, "a geometry with an empty or huge array");
    RTCGeometry made = rtcNewGeometry(cast->device, type);
    if (!made) {
        WO_TRY(check(cast->device, "making a geometry", error));
        return wo_fail(error, WO_ERR_LIBRARY, "Embree gave no geometry");
    }
    for (size_t i = 0; i < buffer_count; i++) {
        const buffer *const b = &buffers[i];
        void *room = rtcSetNewGeometryBuffer(made, b->type, 0, b->format, b->bytes, b->count);
        if (room)
            memcpy(room, b->data, b->bytes * b->count);
    }
    /* The filter asks for this mark; any address that is not NULL does. */
    rtcSetGeometryUserData(made, kind == WO_RAYCAST_CLOSED ? cast : NULL);
    rtcCommitGeometry(made);
    const unsigned id = rtcAttachGeometry(cast->scene, made);
    rtcReleaseGeometry(made);
    WO_TRY(check(cast->device, "adding a geometry", error));
    if (geometry)
        *geometry = id;
    return WO_OK;
}

static wo_status check_indices(const uint32_t *indices, size_t count, size_t limit, wo_error *error)
{
    for (size_t i = 0; i < count; i++)
        if (indices[i] >= limit)
            return wo_fail(error, WO_ERR_RANGE,
                           "vertex %u is asked for, the last one usable is "
                           "number %zu",
                           indices[i], limit);
    return WO_OK;
}

wo_status wo_raycast_add_quads(wo_raycast *cast, int kind, const float (*vertices)[3],
                               size_t vertex_count, const uint32_t (*faces)[4], size_t face_count,
                               uint32_t *geometry, wo_error *error)
{
    for (size_t i = 0; i < face_count; i++)
        WO_TRY(check_indices(faces[i], 4, vertex_count, error));
    const buffer buffers[] = {
        {RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices, sizeof *vertices, vertex_count},
        {RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT4, faces, sizeof *faces, face_count}};
    return add(cast, RTC_GEOMETRY_TYPE_QUAD, kind, buffers, WO_COUNT(buffers), geometry, error);
}

wo_status wo_raycast_add_spheres(wo_raycast *cast, int kind, const float (*spheres)[4],
                                 size_t count, uint32_t *geometry, wo_error *error)
{
    const buffer buffers[] = {
        {RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, spheres, sizeof *spheres, count}};
    return add(cast, RTC_GEOMETRY_TYPE_SPHERE_POINT, kind, buffers, 1, geometry, error);
}

wo_status wo_raycast_add_rods(wo_raycast *cast, int kind, const float (*points)[4],
                              size_t point_count, const uint32_t *first, size_t count,
                              uint32_t *geometry, wo_error *error)
{
    WO_TRY(check_indices(first, count, point_count > 0 ? point_count - 1 : 0, error));
    const buffer buffers[] = {
        {RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, points, sizeof *points, point_count},
        {RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, first, sizeof *first, count}};
    return add(cast, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE, kind, buffers, WO_COUNT(buffers),
               geometry, error);
}

wo_status wo_raycast_commit(wo_raycast *cast, wo_error *error)
{
    rtcCommitScene(cast->scene);
    return check(cast->device, "building", error);
}

/* The filter sees a packet of any width n as arrays of n floats, one after the other. */
enum { RAY_DIR_X = 4, RAY_DIR_Y = 5, RAY_DIR_Z = 6, HIT_NORMAL_X = 0, HIT_NORMAL_Y, HIT_NORMAL_Z };

static void drop_back_faces(const struct RTCFilterFunctionNArguments *args)
{
    if (!args->geometryUserPtr)
        return;
    const size_t n = args->N;
    const float *const ray = (const float *)args->ray, *const hit = (const float *)args->hit;
    for (size_t i = 0; i < n; i++) {
        const float along = hit[HIT_NORMAL_X * n + i] * ray[RAY_DIR_X * n + i] +
                            hit[HIT_NORMAL_Y * n + i] * ray[RAY_DIR_Y * n + i] +
                            hit[HIT_NORMAL_Z * n + i] * ray[RAY_DIR_Z * n + i];
        if (args->valid[i] != 0 && along > 0)
            args->valid[i] = 0;
    }
}

static void load_ray(struct RTCRay8 *packet, size_t lane, const wo_ray *ray)
{
    packet->org_x[lane] = ray->origin[0];
    packet->org_y[lane] = ray->origin[1];
    packet->org_z[lane] = ray->origin[2];
    packet->dir_x[lane] = ray->direction[0];
    packet->dir_y[lane] = ray->direction[1];
    packet->dir_z[lane] = ray->direction[2];
    packet->tnear[lane] = ray->near;
    packet->tfar[lane] = ray->far;
    packet->time[lane] = 0;
    packet->mask[lane] = UINT32_MAX;
    packet->id[lane] = 0;
    packet->flags[lane] = 0;
}

/* Fills a packet from at most PACKET rays; lanes without a proper ray are switched off. */
static bool load_packet(struct RTCRay8 *packet, int valid[PACKET], const wo_ray *rays, size_t count)
{
    bool any = false;
    for (size_t i = 0; i < PACKET; i++) {
        load_ray(packet, i, &rays[i < count ? i : 0]);
        const bool use = i < count && rays[i].near <= rays[i].far;
        valid[i] = use ? -1 : 0;
        any = any || use;
    }
    return any;
}

static void store_hit(const struct RTCRayHit8 *packet, size_t lane, bool valid, wo_hit *hit)
{
    if (!valid || packet->hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) {
        *hit = (wo_hit){.geometry = WO_RAYCAST_NONE};
        return;
    }
    hit->t = packet->ray.tfar[lane];
    hit->geometry = packet->hit.geomID[lane];
    hit->primitive = packet->hit.primID[lane];
    hit->normal[0] = packet->hit.Ng_x[lane];
    hit->normal[1] = packet->hit.Ng_y[lane];
    hit->normal[2] = packet->hit.Ng_z[lane];
    hit->u = packet->hit.u[lane];
    hit->v = packet->hit.v[lane];
}

void wo_raycast_trace(const wo_raycast *cast, const wo_ray *rays, wo_hit *hits, size_t count,
                      int mode)
{
    for (size_t at = 0; at < count; at += PACKET) {
        const size_t lanes = count - at < PACKET ? count - at : PACKET;
        struct RTCRayHit8 packet;
        _Alignas(32) int valid[PACKET];
        const bool any = load_packet(&packet.ray, valid, rays + at, lanes);
        for (size_t i = 0; i < PACKET; i++) {
            packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        if (any) {
            struct RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            if (mode & WO_RAYS_COHERENT)
                context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
            if (mode & WO_RAYS_FRONT_ONLY)
                context.filter = drop_back_faces;
            rtcIntersect8(valid, cast->scene, &context, &packet);
        }
        for (size_t i = 0; i < lanes; i++)
            store_hit(&packet, i, valid[i] != 0, &hits[at + i]);
    }
}

void wo_raycast_blocked(const wo_raycast *cast, const wo_ray *rays, bool *blocked, size_t count)
{
    for (size_t at = 0; at < count; at += PACKET) {
        const size_t lanes = count - at < PACKET ? count - at : PACKET;
        struct RTCRay8 packet;
        _Alignas(32) int valid[PACKET];
        if (load_packet(&packet, valid, rays + at, lanes)) {
            struct RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            rtcOccluded8(valid, cast->scene, &context, &packet);
        }
        /* The library marks a blocked ray by an end before its start. */
        for (size_t i = 0; i < lanes; i++)
            blocked[at + i] = valid[i] != 0 && packet.tfar[i] < 0;
    }
}
