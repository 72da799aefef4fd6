/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "peel.h"

#include <string.h>

enum { PATCHES_MAX = 64 };

/* Surfaces nearer to each other than this many pixel widths are one patch: no lens sees between. */
#define TOUCHING 4.0f
/* Coverage that counts as whole. */
#define WHOLE 0.999f

void wo_peel_first(const wo_peel_pixel *pixel, float rgba[4], float *z)
{
    memset(rgba, 0, 4 * sizeof *rgba);
    const float weight = 1 / (float)(pixel->samples - 1);
    for (int s = 1; s < pixel->samples; s++) {
        if (pixel->count[s] == 0)
            continue;
        for (int c = 0; c < 3; c++)
            rgba[c] += weight * pixel->hit[s][0].rgb[c];
        rgba[3] += weight;
    }
    *z = pixel->count[0] ? pixel->hit[0][0].z : 0;
}

int wo_peel_hits(const wo_peel_pixel *pixel, int layers, wo_peel_layer *out)
{
    memset(out, 0, (size_t)layers * sizeof *out);
    const float weight = 1 / (float)(pixel->samples - 1);
    int filled = 0;
    for (int k = 0; k < layers; k++) {
        for (int s = 1; s < pixel->samples; s++) {
            if (pixel->count[s] <= k)
                continue;
            for (int c = 0; c < 3; c++)
                out[k].rgba[c] += weight * pixel->hit[s][k].rgb[c];
            out[k].rgba[3] += weight;
            filled = k + 1;
        }
        if (pixel->count[0] > k)
            out[k].z = pixel->hit[0][k].z;
    }
    return filled;
}

/* Hits that belong together. */
typedef struct patch {
    uint64_t piece;
    float low, high;                /* depths */
    float z, offset;                /* depth of the sample nearest to the centre */
    int last;                       /* sample that joined last */
    int any, first;                 /* samples that hit it, that hit it before all else */
    float any_rgb[3], first_rgb[3]; /* sums */
} patch;

static float gap_to(const patch *p, float z)
{
    return fmaxf(0, fmaxf(p->low - z, z - p->high));
}

/* The patch a hit of this sample joins, or -1: the same piece, no further off than its sheets lie
   apart, and not one that the same ray has met already. */
static int find_patch(const patch *patches, int count, const wo_peel_hit *hit, int sample)
{
    int best = -1;
    float nearest = INFINITY;
    for (int i = 0; i < count; i++) {
        const patch *const p = &patches[i];
        if (p->piece != hit->piece || p->last == sample)
            continue;
        const float gap = gap_to(p, hit->z);
        if (gap <= hit->sheet && gap < nearest) {
            nearest = gap;
            best = i;
        }
    }
    return best;
}

/* When there is no room for another patch: the nearest of any piece. */
static int closest_patch(const patch *patches, int count, float z)
{
    int best = 0;
    for (int i = 1; i < count; i++)
        if (gap_to(&patches[i], z) < gap_to(&patches[best], z))
            best = i;
    return best;
}

static int form_patches(wo_peel_pixel *pixel, patch *patches)
{
    int count = 0;
    /* The centre comes last: it says how deep a patch is, and makes none. */
    for (int i = 1; i <= pixel->samples; i++) {
        const int s = i % pixel->samples;
        for (int k = 0; k < pixel->count[s]; k++) {
            wo_peel_hit *const hit = &pixel->hit[s][k];
            int at = find_patch(patches, count, hit, s);
            if (at < 0 && s == 0)
                continue;
            if (at < 0 && count == PATCHES_MAX)
                at = closest_patch(patches, count, hit->z);
            if (at < 0) {
                at = count++;
                patches[at] = (patch){.piece = hit->piece,
                                      .low = hit->z,
                                      .high = hit->z,
                                      .z = hit->z,
                                      .offset = pixel->offset[s]};
            }
            patch *const p = &patches[at];
            hit->patch = at;
            p->last = s;
            p->low = fminf(p->low, hit->z);
            p->high = fmaxf(p->high, hit->z);
            if (pixel->offset[s] < p->offset) {
                p->offset = pixel->offset[s];
                p->z = hit->z;
            }
        }
    }
    return count;
}

/* Orders patches by depth and joins those that touch: group[i] becomes the place of patch i among
   the joined ones, which are written to joined. Returns their number. */
static int join_touching(const patch *patches, int count, float footprint, int *group,
                         patch *joined)
{
    int order[PATCHES_MAX], groups = 0;
    for (int i = 0; i < count; i++) {
        int at = i;
        for (; at > 0 && patches[order[at - 1]].z > patches[i].z; at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
    for (int i = 0; i < count; i++) {
        const patch *const p = &patches[order[i]];
        patch *const front = groups ? &joined[groups - 1] : NULL;
        if (front && p->z - front->low <= TOUCHING * footprint * p->z) {
            if (p->offset < front->offset) {
                front->offset = p->offset;
                front->z = p->z;
            }
        } else {
            joined[groups] = *p;
            joined[groups++].low = p->z;
        }
        group[order[i]] = groups - 1;
    }
    return groups;
}

/* Counts and sums of colour; a ray that meets a group twice counts once, with its nearer hit. */
static void sum_groups(const wo_peel_pixel *pixel, const int *group, patch *joined, int groups)
{
    for (int g = 0; g < groups; g++) {
        joined[g].last = -1;
        joined[g].any = joined[g].first = 0;
        memset(joined[g].any_rgb, 0, sizeof joined[g].any_rgb);
        memset(joined[g].first_rgb, 0, sizeof joined[g].first_rgb);
    }
    for (int s = 1; s < pixel->samples; s++)
        for (int k = 0; k < pixel->count[s]; k++) {
            const wo_peel_hit *const hit = &pixel->hit[s][k];
            patch *const p = &joined[group[hit->patch]];
            if (p->last == s)
                continue;
            p->last = s;
            p->any++;
            p->first += k == 0;
            for (int c = 0; c < 3; c++) {
                p->any_rgb[c] += hit->rgb[c];
                p->first_rgb[c] += k == 0 ? hit->rgb[c] : 0;
            }
        }
}

/* Groups a and a + 1 become one; its depth is that of the more visible of the two. */
static void merge_groups(patch *joined, int groups, int a, int *group, int patches)
{
    patch *const front = &joined[a], *const back = &joined[a + 1];
    if (back->first > front->first)
        front->z = back->z;
    memmove(back, back + 1, (size_t)(groups - a - 2) * sizeof *back);
    for (int i = 0; i < patches; i++)
        if (group[i] > a)
            group[i]--;
}

/* Brings the number of groups down to layers. What hides behind a whole group goes first; then the
   neighbours in depth that differ least are taken for one. */
static int reduce_groups(const wo_peel_pixel *pixel, patch *joined, int groups, int layers,
                         int *group, int patches, int64_t *dropped)
{
    const int all = pixel->samples - 1;
    while (groups > layers) {
        bool hidden = joined[groups - 1].first == 0;
        bool covered = false;
        for (int g = 0; g + 1 < groups; g++)
            covered = covered || joined[g].any == all;
        if (hidden && covered) {
            groups--;
            ++*dropped;
            continue;
        }
        int best = 0;
        float least = INFINITY;
        for (int g = 0; g + 1 < groups; g++) {
            const float step = 1 / joined[g].z - 1 / joined[g + 1].z;
            if (step < least) {
                least = step;
                best = g;
            }
        }
        merge_groups(joined, groups, best, group, patches);
        groups--;
        for (int i = 0; i < patches; i++)
            group[i] = group[i] < groups ? group[i] : groups;
        sum_groups(pixel, group, joined, groups);
    }
    return groups;
}

/* What a group shows. Coverage is its share of what the groups in front leave open as seen from the
   lens centre, so that compositing gives back the picture and no light leaks between neighbours
   that meet in the pixel; where nothing is left open, it is the covered area. */
static void finish_group(const patch *p, int open, int all, wo_peel_layer *out)
{
    const float *const sums = open > 0 ? p->first_rgb : p->any_rgb;
    const int count = open > 0 ? p->first : p->any;
    const float coverage = (float)count / (float)(open > 0 ? open : all);
    for (int c = 0; c < 3; c++)
        out->rgba[c] = count > 0 ? coverage * sums[c] / (float)count : 0;
    out->rgba[3] = coverage;
    out->z = p->z;
}

int wo_peel_patches(wo_peel_pixel *pixel, int layers, wo_peel_layer *out, int64_t *dropped)
{
    patch patches[PATCHES_MAX], joined[PATCHES_MAX];
    int group[PATCHES_MAX] = {0};
    memset(out, 0, (size_t)layers * sizeof *out);
    const int count = form_patches(pixel, patches);
    int groups = join_touching(patches, count, pixel->footprint, group, joined);
    sum_groups(pixel, group, joined, groups);
    groups = reduce_groups(pixel, joined, groups, layers, group, count, dropped);
    int filled = 0, open = pixel->samples - 1;
    for (int g = 0; g < groups; g++) {
        finish_group(&joined[g], open, pixel->samples - 1, &out[filled]);
        open -= joined[g].first;
        if (out[filled].rgba[3] > 0)
            filled++;
        else
            out[filled] = (wo_peel_layer){0};
    }
    return filled;
}

/* Is the patch of layer j at (x, y) out of sight behind whole patches of all nine pixels? */
static bool hidden(const wo_camera *camera, const wo_image *layer, const wo_image *depth,
                   int layers, int32_t x, int32_t y, int j)
{
    const float v = 1 / *wo_image_at(&depth[j], x, y);
    const float k = camera->focal_px * camera->radius;
    const wo_rect bounds = layer[0].bounds;
    for (int32_t ny = y - 1; ny <= y + 1; ny++)
        for (int32_t nx = x - 1; nx <= x + 1; nx++) {
            if (nx < bounds.x1 || ny < bounds.y1 || nx >= bounds.x2 || ny >= bounds.y2)
                return false;
            bool covered = false;
            for (int i = 0; i < layers && !covered; i++) {
                const float front = *wo_image_at(&depth[i], nx, ny);
                const float *const rgba = wo_image_at(&layer[i], nx, ny);
                const float step = front > 0 ? 1 / front - v : -1;
                covered = rgba[3] >= WHOLE && step > 0 && k * step <= 1;
            }
            if (!covered)
                return false;
        }
    return true;
}

int64_t wo_peel_umbra(const wo_camera *camera, wo_image *layer, wo_image *layer_depth, int layers,
                      uint8_t *work)
{
    const wo_rect b = layer[0].bounds;
    int64_t dropped = 0;
    uint8_t *mark = work;
    for (int32_t y = b.y1; y < b.y2; y++)
        for (int32_t x = b.x1; x < b.x2; x++)
            for (int j = 0; j < layers; j++)
                *mark++ = wo_image_at(&layer[j], x, y)[3] > 0 &&
                          hidden(camera, layer, layer_depth, layers, x, y, j);
    mark = work;
    for (int32_t y = b.y1; y < b.y2; y++)
        for (int32_t x = b.x1; x < b.x2; x++, mark += layers) {
            int kept = 0;
            for (int j = 0; j < layers; j++) {
                float rgba[4], z = *wo_image_at(&layer_depth[j], x, y);
                memcpy(rgba, wo_image_at(&layer[j], x, y), sizeof rgba);
                memset(wo_image_at(&layer[j], x, y), 0, sizeof rgba);
                *wo_image_at(&layer_depth[j], x, y) = 0;
                if (mark[j]) {
                    dropped++;
                } else if (rgba[3] > 0) {
                    memcpy(wo_image_at(&layer[kept], x, y), rgba, sizeof rgba);
                    *wo_image_at(&layer_depth[kept], x, y) = z;
                    kept++;
                }
            }
        }
    return dropped;
}
