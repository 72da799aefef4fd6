/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "scene.h"

void wo_scene_destroy(const wo_context *context, wo_scene **scene)
{
    wo_scene *const old = *scene;
    if (!old)
        return;
    wo_raycast_destroy(&old->cast);
    for (size_t i = 0; i < old->shape_count; i++) {
        wo_shape *const s = &old->shapes[i];
        wo_delete(context, s->tint);
        wo_delete(context, s->glow);
        wo_delete(context, s->map);
        wo_delete(context, s->points);
        wo_delete(context, s->quads);
        wo_delete(context, s->first);
        wo_delete(context, s->normals);
    }
    wo_delete(context, old->shapes);
    wo_delete(context, old->lamps);
    wo_delete(context, old);
    *scene = NULL;
}

static wo_vec ray_point(const wo_ray *ray, float t)
{
    return (wo_vec){ray->origin[0] + t * ray->direction[0], ray->origin[1] + t * ray->direction[1],
                    ray->origin[2] + t * ray->direction[2]};
}

static wo_vec hit_normal(const wo_hit *hit)
{
    return wo_vec_unit((wo_vec){hit->normal[0], hit->normal[1], hit->normal[2]});
}

/* Bilinear look into a map whose first and last texels lie on its edges. */
static void look_up(const float *map, int width, int height, float s, float t, float rgb[3])
{
    const float x = wo_clamp(s, 0, 1) * (float)(width - 1);
    const float y = wo_clamp(t, 0, 1) * (float)(height - 1);
    int ix = (int)x, iy = (int)y;
    ix = ix > width - 2 ? width - 2 : ix;
    iy = iy > height - 2 ? height - 2 : iy;
    const float fx = x - (float)ix, fy = y - (float)iy;
    const float *const low = map + 3 * ((ptrdiff_t)iy * width + ix), *const high = low + 3 * width;
    for (int c = 0; c < 3; c++)
        rgb[c] = wo_mix(wo_mix(low[c], low[c + 3], fx), wo_mix(high[c], high[c + 3], fx), fy);
}

/* The octahedron unfolded into the unit square; the border is folded onto itself, so texels on it
   agree with their mirror images. */
static void octahedral(wo_vec n, float *s, float *t)
{
    const float sum = fabsf(n.x) + fabsf(n.y) + fabsf(n.z);
    float x = n.x / sum, y = n.y / sum;
    if (n.z < 0) {
        const float folded = (1 - fabsf(y)) * (x < 0 ? -1.0f : 1.0f);
        y = (1 - fabsf(x)) * (y < 0 ? -1.0f : 1.0f);
        x = folded;
    }
    *s = 0.5f + 0.5f * x;
    *t = 0.5f + 0.5f * y;
}

static wo_vec from_octahedral(float s, float t)
{
    wo_vec n = {2 * s - 1, 2 * t - 1, 0};
    n.z = 1 - fabsf(n.x) - fabsf(n.y);
    if (n.z < 0) {
        const float folded = (1 - fabsf(n.y)) * (n.x < 0 ? -1.0f : 1.0f);
        n.y = (1 - fabsf(n.x)) * (n.y < 0 ? -1.0f : 1.0f);
        n.x = folded;
    }
    return wo_vec_unit(n);
}

/* The vertices round a face of a GRID, in the order of look_up's corners. */
static void grid_corners(const wo_shape *s, uint32_t face, size_t corners[4])
{
    const uint32_t across = (uint32_t)s->map_width - 1;
    const size_t low = (size_t)(face / across) * (size_t)s->map_width + face % across;
    corners[0] = low;
    corners[1] = low + 1;
    corners[2] = low + (size_t)s->map_width;
    corners[3] = corners[2] + 1;
}

static void rod_light(const wo_shape *s, const wo_hit *hit, float rgb[3])
{
    const float *const from = s->map + (size_t)s->first[hit->primitive] * 12, *const to = from + 12;
    const wo_vec n = hit_normal(hit);
    for (int c = 0; c < 3; c++) {
        const float *const a = from + 3 + 3 * c, *const b = to + 3 + 3 * c;
        const wo_vec lean = {wo_mix(a[0], b[0], hit->u), wo_mix(a[1], b[1], hit->u),
                             wo_mix(a[2], b[2], hit->u)};
        rgb[c] = fmaxf(0, wo_mix(from[c], to[c], hit->u) + wo_vec_dot(lean, n));
    }
}

static void light_at(const wo_scene *scene, const wo_shape *s, const wo_hit *hit, wo_vec p,
                     float rgb[3])
{
    const size_t own = (size_t)hit->primitive * (size_t)s->map_width * (size_t)s->map_height * 3;
    float u, v;
    switch (s->kind) {
    case WO_SHAPE_SCREEN:
        look_up(s->map, s->map_width, s->map_height, 0.5f - 0.5f * p.x / (p.z * scene->screen_x),
                0.5f - 0.5f * p.y / (p.z * scene->screen_y), rgb);
        return;
    case WO_SHAPE_QUADS:
        look_up(s->map + own, s->map_width, s->map_height, hit->u, hit->v, rgb);
        return;
    case WO_SHAPE_BALLS:
        octahedral(hit_normal(hit), &u, &v);
        look_up(s->map + own, s->map_width, s->map_height, u, v, rgb);
        return;
    case WO_SHAPE_GRID: {
        size_t k[4];
        grid_corners(s, hit->primitive, k);
        for (size_t c = 0; c < 3; c++)
            rgb[c] = wo_mix(wo_mix(s->map[3 * k[0] + c], s->map[3 * k[1] + c], hit->u),
                            wo_mix(s->map[3 * k[2] + c], s->map[3 * k[3] + c], hit->u), hit->v);
        return;
    }
    case WO_SHAPE_RODS:
        rod_light(s, hit, rgb);
        return;
    }
}

void wo_scene_shade(const wo_scene *scene, const wo_ray *ray, const wo_hit *hit, wo_look *look)
{
    const wo_shape *const s = &scene->shapes[hit->geometry];
    if (s->glow) {
        *look = (wo_look){.lamp = (int64_t)s->first_lamp + hit->primitive};
        return;
    }
    look->lamp = -1;
    const wo_vec p = ray_point(ray, hit->t);
    wo_texture_at(&s->texture, &scene->noise, wo_affine_point(&s->to_texture, p), look->rgb);
    if (s->tint)
        for (int c = 0; c < 3; c++)
            look->rgb[c] *= s->tint[hit->primitive / s->per_piece][c];
    if (s->lit) {
        float light[3];
        light_at(scene, s, hit, p, light);
        for (int c = 0; c < 3; c++)
            look->rgb[c] *= light[c];
    }
}

wo_vec wo_scene_normal(const wo_scene *scene, const wo_ray *ray, const wo_hit *hit)
{
    const wo_shape *const s = &scene->shapes[hit->geometry];
    wo_vec n = hit_normal(hit);
    if (s->kind == WO_SHAPE_GRID) {
        size_t k[4];
        grid_corners(s, hit->primitive, k);
        const wo_vec low =
            wo_vec_along(wo_vec_scale(s->normals[k[0]], 1 - hit->u), s->normals[k[1]], hit->u);
        const wo_vec high =
            wo_vec_along(wo_vec_scale(s->normals[k[2]], 1 - hit->u), s->normals[k[3]], hit->u);
        return wo_vec_unit(wo_vec_along(wo_vec_scale(low, 1 - hit->v), high, hit->v));
    }
    const wo_vec direction = {ray->direction[0], ray->direction[1], ray->direction[2]};
    if ((s->kind == WO_SHAPE_SCREEN || s->kind == WO_SHAPE_QUADS) && s->per_piece == 1 &&
        wo_vec_dot(n, direction) > 0)
        n = wo_vec_scale(n, -1);
    return n;
}

static wo_vec point_of(const wo_shape *s, size_t i)
{
    return (wo_vec){s->points[i][0], s->points[i][1], s->points[i][2]};
}

static wo_vec quad_normal(const wo_shape *s, size_t face)
{
    const uint32_t *const k = s->quads[face];
    return wo_vec_unit(wo_vec_cross(wo_vec_sub(point_of(s, k[1]), point_of(s, k[0])),
                                    wo_vec_sub(point_of(s, k[3]), point_of(s, k[0]))));
}

bool wo_shape_texel(const wo_scene *scene, const wo_shape *s, size_t texel, wo_vec *point,
                    wo_vec *normal)
{
    if (s->kind == WO_SHAPE_GRID) {
        *point = point_of(s, texel);
        *normal = s->normals[texel];
        return true;
    }
    if (s->kind == WO_SHAPE_RODS) {
        *point = point_of(s, texel);
        *normal = (wo_vec){0};
        return true;
    }
    const size_t width = (size_t)s->map_width, area = width * (size_t)s->map_height;
    const size_t own = texel / area, x = texel % area % width, y = texel % area / width;
    const float u = (float)x / (float)(s->map_width - 1), v = (float)y / (float)(s->map_height - 1);
    if (s->kind == WO_SHAPE_BALLS) {
        *normal = from_octahedral(u, v);
        *point = wo_vec_along(point_of(s, own), *normal, s->points[own][3]);
        return true;
    }
    *normal = quad_normal(s, own);
    const wo_vec corner = point_of(s, s->quads[own][0]);
    if (s->kind == WO_SHAPE_SCREEN) {
        const wo_vec d = {(2 * u - 1) * scene->screen_x, (2 * v - 1) * scene->screen_y, -1};
        const float depth = wo_vec_dot(*normal, corner) / wo_vec_dot(*normal, d);
        *point = wo_vec_scale(d, depth);
        return depth > 0 && depth < 1000;
    }
    const wo_vec a = wo_vec_sub(point_of(s, s->quads[own][1]), corner);
    const wo_vec b = wo_vec_sub(point_of(s, s->quads[own][3]), corner);
    *point = wo_vec_along(wo_vec_along(corner, a, u), b, v);
    return true;
}
