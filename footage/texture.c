/* SPDX-License-Identifier: BSD-3-Clause */
/* Copyright the WideOpen authors */
#include "texture.h"

#include "random.h"

/* Width of the ramp at edges, in cells. */
#define RAMP 0.02f

void wo_noise_make(uint64_t seed, wo_noise *noise)
{
    wo_random random = {seed ^ 0x5bd1e995u};
    for (size_t i = 0; i < WO_COUNT(noise->value); i++)
        noise->value[i] = wo_random_unit(&random);
}

static int floor_int(float x)
{
    const int i = (int)x;
    return i - (x < (float)i);
}

static float fraction(float x)
{
    return x - (float)floor_int(x);
}

static uint32_t cell_hash(int x, int y, int z)
{
    return (uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u ^ (uint32_t)z * 83492791u;
}

static float lattice(const wo_noise *noise, uint32_t h)
{
    return noise->value[(h ^ (h >> 12) ^ (h >> 21)) & 4095u];
}

static float ease(float t)
{
    return t * t * (3 - 2 * t);
}

float wo_noise_at(const wo_noise *noise, wo_vec q)
{
    const int ix = floor_int(q.x), iy = floor_int(q.y), iz = floor_int(q.z);
    const float tx = ease(q.x - (float)ix), ty = ease(q.y - (float)iy), tz = ease(q.z - (float)iz);
    float side[2];
    for (int k = 0; k < 2; k++) {
        const float a = lattice(noise, cell_hash(ix, iy, iz + k));
        const float b = lattice(noise, cell_hash(ix + 1, iy, iz + k));
        const float c = lattice(noise, cell_hash(ix, iy + 1, iz + k));
        const float d = lattice(noise, cell_hash(ix + 1, iy + 1, iz + k));
        side[k] = wo_mix(wo_mix(a, b, tx), wo_mix(c, d, tx), ty);
    }
    return wo_mix(side[0], side[1], tz);
}

float wo_noise_clouds(const wo_noise *noise, wo_vec q, int octaves)
{
    float sum = 0, weight = 0, strength = 1;
    for (int i = 0; i < octaves; i++) {
        sum += strength * wo_noise_at(noise, q);
        weight += strength;
        strength *= 0.5f;
        /* Not twice: lattices that coincide would show. */
        q = (wo_vec){q.x * 2.03f + 17.1f, q.y * 2.03f + 5.3f, q.z * 2.03f + 9.7f};
    }
    return sum / weight;
}

/* 0 below, 1 above, a ramp of the given width round 0. */
static float step(float x, float width)
{
    return ease(wo_clamp(x / width + 0.5f, 0, 1));
}

/* +1 and -1 in turn over unit intervals, +1 round 0, ramps between. */
static float square_wave(float x)
{
    const float triangle = fabsf(fraction(0.5f * x) - 0.5f) * 4 - 1;
    return wo_clamp(triangle / (2 * RAMP), -1, 1);
}

static float checker(wo_vec q)
{
    return 0.5f + 0.5f * square_wave(q.x) * square_wave(q.y) * square_wave(q.z);
}

static float dots(wo_vec q)
{
    const int ix = floor_int(q.x + 0.5f), iy = floor_int(q.y + 0.5f), iz = floor_int(q.z + 0.5f);
    const uint32_t h = wo_stir(cell_hash(ix, iy, iz), 77);
    const float radius = 0.26f + 0.14f * (float)(h & 1023u) / 1023;
    const wo_vec d = {q.x - (float)ix, q.y - (float)iy, q.z - (float)iz};
    return step(radius - wo_vec_length(d), 2 * RAMP);
}

static float veins(const wo_noise *noise, wo_vec q)
{
    const float turn = 3 * wo_noise_clouds(noise, q, 3);
    const float wave = fabsf(fraction(q.x * 0.5f + turn) - 0.5f) * 2;
    return 1 - step(wave - 0.12f, 0.2f);
}

/* t = 0 in the joints; *shade differs from brick to brick. */
static float bricks(wo_vec q, float *shade)
{
    const int row = floor_int(q.y);
    const float x = q.x * 0.5f + ((row & 1) ? 0.5f : 0.0f);
    const int column = floor_int(x);
    *shade = (float)(wo_stir(cell_hash(column, row, 3), 5) & 1023u) / 1023;
    const float ex = 2 * (0.5f - fabsf(fraction(x) - 0.5f)),
                ey = 0.5f - fabsf(fraction(q.y) - 0.5f);
    return step(fminf(ex, ey) - 0.06f, 0.04f);
}

static float boards(const wo_noise *noise, wo_vec q)
{
    const int board = floor_int(q.x);
    const float shade = (float)(wo_stir((uint32_t)board, 9) & 1023u) / 1023;
    const wo_vec stretched = {q.x * 5, (float)board * 3.1f, q.z * 0.6f};
    const float gap = step(0.5f - fabsf(fraction(q.x) - 0.5f) - 0.025f, 0.03f);
    return gap * (0.25f + 0.4f * shade + 0.35f * wo_noise_clouds(noise, stretched, 2));
}

static float rings(const wo_noise *noise, wo_vec q)
{
    const float radius = sqrtf(q.x * q.x + q.z * q.z);
    const float bend = 1.2f * wo_noise_clouds(noise, (wo_vec){q.x, 0.3f * q.y, q.z}, 2);
    const float wave = fraction(radius + bend);
    return wave < 0.85f ? ease(wave / 0.85f) : 1 - ease((wave - 0.85f) / 0.15f);
}

static float chart(wo_vec q)
{
    const int ix = floor_int(q.x), iz = floor_int(q.z);
    const float x = q.x - (float)ix - 0.5f, z = q.z - (float)iz - 0.5f;
    const float radius = sqrtf(x * x + z * z), side = fmaxf(fabsf(x), fabsf(z));
    const float base = ((ix + iz) & 1) ? 1.0f : 0.0f;
    float mark, inside = step(0.38f - side, RAMP);
    switch (wo_stir(cell_hash(ix, 0, iz), 21) % 4) {
    case 0: /* circles */
        mark = 0.5f + 0.5f * square_wave(10 * radius);
        inside = step(0.4f - radius, RAMP);
        break;
    case 1: /* rules */
        mark = 0.5f + 0.5f * square_wave(12 * x);
        break;
    case 2: /* small checker */
        mark = 0.5f + 0.5f * square_wave(5 * x) * square_wave(5 * z);
        break;
    default: /* cross */
        mark = 1 - step(fminf(fabsf(x), fabsf(z)) - 0.03f, RAMP);
        break;
    }
    return wo_mix(base, 1 - base, mark * inside);
}

void wo_texture_at(const wo_texture *texture, const wo_noise *noise, wo_vec q, float rgb[3])
{
    float t = 0, gain = 1;
    switch (texture->kind) {
    case WO_TEXTURE_PLAIN:
        break;
    case WO_TEXTURE_CHECKER:
        t = checker(q);
        break;
    case WO_TEXTURE_STRIPES:
        t = 0.5f + 0.5f * square_wave(q.x);
        break;
    case WO_TEXTURE_DOTS:
        t = dots(q);
        break;
    case WO_TEXTURE_MARBLE:
        t = step(wo_noise_clouds(noise, q, 3) - 0.5f, 0.35f);
        break;
    case WO_TEXTURE_VEINS:
        t = veins(noise, q);
        break;
    case WO_TEXTURE_BRICKS: {
        float shade;
        t = 1 - bricks(q, &shade);
        gain = wo_mix(0.7f + 0.5f * shade, 1, t);
        break;
    }
    case WO_TEXTURE_BOARDS:
        t = boards(noise, q);
        break;
    case WO_TEXTURE_RINGS:
        t = rings(noise, q);
        break;
    case WO_TEXTURE_CHART:
        t = chart(q);
        break;
    case WO_TEXTURE_WAVES:
        t = 0.5f + 0.25f * (sinf(2 * WO_PI * q.x) + sinf(2 * WO_PI * q.y));
        break;
    }
    if (texture->grain > 0) {
        const float clouds = wo_noise_clouds(noise, wo_vec_scale(q, texture->grain_scale), 2);
        gain *= 1 + texture->grain * (2 * clouds - 1);
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = gain * wo_mix(texture->a[c], texture->b[c], t);
}
