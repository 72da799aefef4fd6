/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "random.h"
#include "scene.h"

#include <string.h>

/* Light maps. Every texel asks the same few sets of directions, so neighbours agree and there is no
   grain; flat maps take four sets in turn and are smoothed over them, so that every other direction
   is enough, and rods are thin: every third. */
enum {
    SKY_RAYS = 96, /* over the whole sphere; about half count on a surface */
    SUN_RAYS = 12,
    SETS = 4,
    BATCH = SKY_RAYS + WO_SUNS_MAX * SUN_RAYS,
    TEXELS_PER_JOB = 128,
    ROD_SIDES = 4
};

/* Rays start this far off their surface, m. */
#define LIFT 5e-4f
/* A lamp adding less than this to a texel is left out. */
#define FAINT 1e-3f

typedef struct directions {
    wo_vec sky[SETS][SKY_RAYS];
    wo_vec sun[SETS][WO_SUNS_MAX][SUN_RAYS];
} directions;

typedef struct lighting {
    wo_scene *scene;
    const directions *directions;
    const size_t *first_job; /* [shape_count + 1] */
    wo_progress *progress;
} lighting;

/* Two directions across n. */
static void across(wo_vec n, wo_vec *a, wo_vec *b)
{
    const wo_vec other = fabsf(n.y) < 0.9f ? (wo_vec){0, 1, 0} : (wo_vec){1, 0, 0};
    *a = wo_vec_unit(wo_vec_cross(other, n));
    *b = wo_vec_cross(n, *a);
}

/* Golden angle spirals: over the sphere, and over the face of each sun. */
static void make_directions(const wo_scene *scene, directions *d)
{
    const float golden = WO_PI * (3 - sqrtf(5));
    for (int set = 0; set < SETS; set++) {
        const float turn = 2 * WO_PI * (float)set / SETS, slip = ((float)set + 0.5f) / SETS;
        for (int i = 0; i < SKY_RAYS; i++) {
            const float z = 1 - 2 * ((float)i + slip) / SKY_RAYS;
            const float r = sqrtf(fmaxf(0, 1 - z * z)), angle = golden * (float)i + turn;
            d->sky[set][i] = (wo_vec){r * cosf(angle), r * sinf(angle), z};
        }
        for (int s = 0; s < scene->sun_count; s++) {
            const wo_sun *const sun = &scene->suns[s];
            wo_vec a, b;
            across(sun->towards, &a, &b);
            for (int i = 0; i < SUN_RAYS; i++) {
                const float r = tanf(sun->radius) * sqrtf(((float)i + slip) / SUN_RAYS);
                const float angle = golden * (float)i + turn;
                const wo_vec aside =
                    wo_vec_along(wo_vec_scale(a, r * cosf(angle)), b, r * sinf(angle));
                d->sun[set][s][i] = wo_vec_unit(wo_vec_add(sun->towards, aside));
            }
        }
    }
}

static void sky_radiance(const wo_sky *sky, wo_vec direction, float rgb[3])
{
    const float height = wo_vec_dot(sky->up, direction);
    const float *const end = height > 0 ? sky->zenith : sky->ground;
    const float t = height > 0 ? sqrtf(height) : fminf(1, -4 * height);
    for (int c = 0; c < 3; c++)
        rgb[c] = wo_mix(sky->horizon[c], end[c], t);
}

static wo_ray ray_to(wo_vec from, wo_vec direction, float far)
{
    return (wo_ray){{from.x, from.y, from.z}, 1e-4f, {direction.x, direction.y, direction.z}, far};
}

/* Lamps are small: one ray to the middle of each. */
static void add_lamps(const wo_scene *scene, wo_vec point, wo_vec normal, float rgb[3])
{
    wo_ray rays[BATCH];
    float light[BATCH][3];
    bool blocked[BATCH];
    size_t count = 0;
    for (size_t i = 0; i < scene->lamp_count; i++) {
        const wo_lamp *const lamp = &scene->lamps[i];
        const wo_vec way = wo_vec_sub(lamp->centre, point);
        const float distance = fmaxf(wo_vec_length(way), lamp->radius);
        const float cosine = wo_vec_dot(way, normal) / distance;
        const float share = lamp->radius * lamp->radius / (distance * distance) * cosine;
        const float *const l = lamp->radiance;
        const float most = fmaxf(l[0], fmaxf(l[1], l[2]));
        if (share * most > FAINT) {
            /* Fades to nothing at the limit; the ray ends before the lamp's own skin. */
            for (int c = 0; c < 3; c++)
                light[count][c] = l[c] * (share - FAINT / most);
            rays[count++] = ray_to(point, wo_vec_scale(way, 1 / distance),
                                   fmaxf(0, distance - 1.05f * lamp->radius));
        }
        if (count == BATCH || (i + 1 == scene->lamp_count && count > 0)) {
            wo_raycast_blocked(scene->cast, rays, blocked, count);
            for (size_t k = 0; k < count; k++)
                for (int c = 0; c < 3; c++)
                    rgb[c] += blocked[k] ? 0 : light[k][c];
            count = 0;
        }
    }
}

/* Irradiance over pi at a point of a surface, from every stride-th direction (1, 2, 3). */
static void gather(const wo_scene *scene, const directions *d, int set, int stride, wo_vec at,
                   wo_vec normal, float rgb[3])
{
    const wo_vec point = wo_vec_along(at, normal, LIFT);
    wo_ray rays[BATCH];
    float light[BATCH][3];
    bool blocked[BATCH], from_sky[BATCH];
    size_t count = 0;
    const float sky_weight = 4 * (float)stride / SKY_RAYS, sun_weight = (float)stride / SUN_RAYS;
    for (int i = set % stride; i < SKY_RAYS; i += stride) {
        const float cosine = wo_vec_dot(d->sky[set][i], normal);
        if (cosine <= 0)
            continue;
        sky_radiance(&scene->sky, d->sky[set][i], light[count]);
        for (int c = 0; c < 3; c++)
            light[count][c] *= cosine * sky_weight;
        from_sky[count] = true;
        rays[count++] = ray_to(point, d->sky[set][i], INFINITY);
    }
    for (int s = 0; s < scene->sun_count; s++)
        for (int i = set % stride; i < SUN_RAYS; i += stride) {
            const float cosine = wo_vec_dot(d->sun[set][s][i], normal);
            if (cosine <= 0)
                continue;
            for (int c = 0; c < 3; c++)
                light[count][c] = scene->suns[s].colour[c] * cosine * sun_weight;
            from_sky[count] = false;
            rays[count++] = ray_to(point, d->sun[set][s][i], INFINITY);
        }
    wo_raycast_blocked(scene->cast, rays, blocked, count);
    memset(rgb, 0, 3 * sizeof *rgb);
    for (size_t i = 0; i < count; i++) {
        const float cosine = wo_vec_dot(
            normal, (wo_vec){rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]});
        for (int c = 0; c < 3; c++) {
            const float instead = from_sky[i] ? scene->sky.bounce[c] * cosine * sky_weight : 0;
            rgb[c] += blocked[i] ? instead : light[i][c];
        }
    }
    add_lamps(scene, point, normal, rgb);
}

/* Mean light round a point of a rod, and how it leans: a first-order wave round the axis. */
static void gather_rod(const wo_scene *scene, const directions *d, const wo_shape *s, size_t texel,
                       float out[12])
{
    const size_t chain = texel / (s->per_piece + 1), place = texel % (s->per_piece + 1);
    const size_t from = place > 0 ? texel - 1 : texel;
    const float *const p = s->points[from], *const q = s->points[from + 1];
    const wo_vec axis = wo_vec_unit((wo_vec){q[0] - p[0], q[1] - p[1], q[2] - p[2]});
    const wo_vec centre = {s->points[texel][0], s->points[texel][1], s->points[texel][2]};
    wo_vec side[2];
    across(axis, &side[0], &side[1]);
    memset(out, 0, 12 * sizeof *out);
    for (int i = 0; i < ROD_SIDES; i++) {
        const wo_vec n = wo_vec_scale(side[i & 1], i < 2 ? 1.0f : -1.0f);
        float rgb[3];
        gather(scene, d, (int)((chain + (size_t)i) % SETS), 3,
               wo_vec_along(centre, n, s->points[texel][3]), n, rgb);
        for (int c = 0; c < 3; c++) {
            out[c] += rgb[c] / ROD_SIDES;
            out[3 + 3 * c] += n.x * rgb[c] * (2.0f / ROD_SIDES);
            out[4 + 3 * c] += n.y * rgb[c] * (2.0f / ROD_SIDES);
            out[5 + 3 * c] += n.z * rgb[c] * (2.0f / ROD_SIDES);
        }
    }
}

static bool is_flat(const wo_shape *s)
{
    return s->kind == WO_SHAPE_SCREEN || (s->kind == WO_SHAPE_QUADS && s->map_width > 2);
}

static void light_texel(const wo_scene *scene, const directions *d, wo_shape *s, size_t texel)
{
    float *const out = s->map + texel * (size_t)s->texel_floats;
    wo_vec point, normal;
    if (s->kind == WO_SHAPE_RODS) {
        gather_rod(scene, d, s, texel, out);
        return;
    }
    if (!wo_shape_texel(scene, s, texel, &point, &normal))
        return;
    int set = 0, stride = 1;
    if (is_flat(s)) {
        stride = 2;
        const size_t width = (size_t)s->map_width, place = texel % (width * (size_t)s->map_height);
        set = (int)(place % width % 2 + 2 * (place / width % 2));
    }
    gather(scene, d, set, stride, point, normal, out);
    if (s->both_sides) {
        float behind[3];
        gather(scene, d, set, stride, point, wo_vec_scale(normal, -1), behind);
        for (int c = 0; c < 3; c++)
            out[c] = 0.5f * (out[c] + behind[c]);
    }
}

static void light_job(void *user, size_t index, unsigned worker)
{
    (void)worker;
    const lighting *const job = user;
    if (wo_progress_aborted(job->progress))
        return;
    size_t shape = 0;
    while (job->first_job[shape + 1] <= index)
        shape++;
    wo_shape *const s = &job->scene->shapes[shape];
    const size_t from = (index - job->first_job[shape]) * TEXELS_PER_JOB;
    for (size_t i = from; i < from + TEXELS_PER_JOB && i < s->texels; i++)
        light_texel(job->scene, job->directions, s, i);
    wo_progress_add(job->progress, 1);
}

/* One binomial pass of three along a map's rows or columns: it weighs neighbours of a pair of sets
   alike, so that two passes make one set of four. line holds a row or column. */
static void smooth_line(float *texels, int count, ptrdiff_t stride, float (*line)[3])
{
    for (int i = 0; i < count; i++)
        memcpy(line[i], texels + i * stride, sizeof line[i]);
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            const float before = line[i > 0 ? i - 1 : 1][c];
            const float after = line[i + 1 < count ? i + 1 : count - 2][c];
            texels[i * stride + c] = 0.5f * line[i][c] + 0.25f * (before + after);
        }
}

static wo_status smooth(const wo_context *context, wo_scene *scene, wo_error *error)
{
    enum { LONGEST = 1024 };
    float(*line)[3] = wo_new(context, error, LONGEST, sizeof *line);
    if (!line)
        return WO_ERR_NOMEM;
    for (size_t i = 0; i < scene->shape_count; i++) {
        wo_shape *const s = &scene->shapes[i];
        if (!s->lit || !is_flat(s))
            continue;
        const int width = s->map_width, height = s->map_height;
        const size_t area = (size_t)width * (size_t)height;
        for (size_t at = 0; at < s->texels; at += area) {
            float *const map = s->map + 3 * at;
            for (int y = 0; y < height; y++)
                smooth_line(map + 3 * (ptrdiff_t)y * width, width, 3, line);
            for (int x = 0; x < width; x++)
                smooth_line(map + 3 * (ptrdiff_t)x, height, 3 * (ptrdiff_t)width, line);
        }
    }
    wo_delete(context, line);
    return WO_OK;
}

wo_status wo_scene_light(const wo_context *context, wo_scene *scene, wo_progress *progress,
                         double share, wo_error *error)
{
    size_t *first_job = wo_new(context, error, scene->shape_count + 1, sizeof *first_job);
    directions *d = wo_new(context, error, 1, sizeof *d);
    wo_status status = first_job && d ? WO_OK : WO_ERR_NOMEM;
    if (status == WO_OK) {
        size_t jobs = 0;
        for (size_t i = 0; i < scene->shape_count; i++) {
            const wo_shape *const s = &scene->shapes[i];
            first_job[i] = jobs;
            if (s->lit)
                jobs += (s->texels + TEXELS_PER_JOB - 1) / TEXELS_PER_JOB;
        }
        first_job[scene->shape_count] = jobs;
        make_directions(scene, d);
        wo_progress_stage(progress, share, jobs);
        lighting job = {scene, d, first_job, progress};
        wo_run(context, light_job, &job, jobs);
        status = wo_progress_aborted(progress) ? WO_ABORTED : smooth(context, scene, error);
    }
    wo_delete(context, first_job);
    wo_delete(context, d);
    return status;
}
