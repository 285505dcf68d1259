/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays from hit pixels. bench_rays.h has the definitions, and the order of operations. */
#include "rays/bench_hit_rays.h"

#include "common/bench_clones.h"

#include <math.h>
#include <string.h>

enum {
    BLOCK = BENCH_BLOCK,
    GROUP = BENCH_GROUP,
    GROUPS_AHEAD = 8, /* whose hits are on their way */
    SHADOW_RUN = 256  /* shadow rays made at once */
};

/* ---- to a light ---- */

/* Makes shadow rays from a range of hits. Plain loops, which the compiler vectorises. dir: NULL if only origins are
 * needed. */
BENCH_CLONES
static void make_shadow_run(const bench_camera_axes *axes, const float light[3], const uint32_t *hit, const float *t,
                            uint32_t count, float *const org[3], float *const dir[3])
{
    const float sx = axes->step[0], sy = axes->step[1];
    float px[SHADOW_RUN], py[SHADOW_RUN], back[SHADOW_RUN];
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t pixel = hit[k], x = pixel & 0xffff, y = pixel >> 16;
        px[k] = ((float)x + 0.5f) * sx - 1.0f;
        py[k] = 1.0f - ((float)y + 0.5f) * sy;
        back[k] = t[k] * 0.9999f;
    }
    for (int a = 0; a < 3; a++) {
        const float eye = axes->eye[a], fwd = axes->fwd[a], right = axes->right[a], up = axes->up[a], to = light[a];
        float *o = org[a], *d = dir ? dir[a] : NULL;
        for (uint32_t k = 0; k < count; k++)
            o[k] = eye + back[k] * (fwd + px[k] * right + py[k] * up);
        for (uint32_t k = 0; k < count && d; k++)
            d[k] = to - o[k];
    }
}

void bench_make_shadow_rays(const bench_camera_axes *axes, const float light[3], const uint32_t *hit, const float *t,
                            uint32_t count, float *const org[3], float *const dir[3])
{
    for (uint32_t i = 0; i < count; i += SHADOW_RUN) {
        float *o[3], *d[3];
        for (int a = 0; a < 3; a++) {
            o[a] = org[a] + i;
            d[a] = dir ? dir[a] + i : NULL;
        }
        make_shadow_run(axes, light, hit + i, t + i, count - i < SHADOW_RUN ? count - i : SHADOW_RUN, o,
                        dir ? d : NULL);
    }
}

/* ---- to the sky ---- */

static float length3(const float v[3]) { return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static uint32_t mix(uint32_t v)
{
    v ^= v >> 16;
    v *= 0x7feb352du;
    v ^= v >> 15;
    v *= 0x846ca68bu;
    return v ^ v >> 16;
}

/* Where the rays of a group of neighbouring pixels start. Lanes beyond its pixels repeat the last one. */
typedef struct ao_group {
    float point[3][GROUP], normal[3][GROUP], side[GROUP];
    uint32_t order[GROUP];
} ao_group;

/* Points of the octahedron from a hash: two coordinates in [-1, 1), the corners folded over to the lower half. No
 * branches: half of them would be mispredicted. Plain loops, which the compiler vectorises. */
BENCH_INLINE void octahedron_points(const ao_group *g, uint32_t sample, float v[3][GROUP])
{
    for (int k = 0; k < GROUP; k++) {
        const uint32_t first = mix(g->order[k] * 64u + sample), second = mix(first + 0x9e3779b9u);
        const float x = (float)(int32_t)(first >> 8) * (2 / 16777216.0f) - 1;
        const float y = (float)(int32_t)(second >> 8) * (2 / 16777216.0f) - 1;
        const float z = 1 - fabsf(x) - fabsf(y), fold = -z > 0 ? -z : 0;
        v[0][k] = x - copysignf(fold, x);
        v[1][k] = y - copysignf(fold, y);
        v[2][k] = z;
    }
}

/* Moves the hashed points to the unit sphere around the tip of the normal: directions are distributed by the cosine. */
static void lean_to_normals(const ao_group *g, float v[3][GROUP])
{
    for (int k = 0; k < GROUP; k++) {
        const float point[3] = {v[0][k], v[1][k], v[2][k]}, length = length3(point);
        for (int i = 0; i < 3; i++)
            v[i][k] = v[i][k] / length + copysignf(1.0f, g->side[k]) * g->normal[i][k];
    }
}

/* Turns directions to the side of the surface that the eye sees. */
BENCH_INLINE void turn_to_eye(const ao_group *g, float v[3][GROUP])
{
    for (int k = 0; k < GROUP; k++) {
        const float cosine = v[0][k] * g->normal[0][k] + v[1][k] * g->normal[1][k] + v[2][k] * g->normal[2][k];
        const float sign = cosine * g->side[k] < 0 ? -1.0f : 1.0f;
        for (int i = 0; i < 3; i++)
            v[i][k] *= sign;
    }
}

/* Plain loops, as above. */
BENCH_INLINE void read_group(const bench_sky_rays *s, uint64_t first, uint32_t pixels, ao_group *g)
{
    const bench_camera_axes *axes = s->axes;
    const bench_planes *planes = s->planes;
    const float sx = axes->step[0], sy = axes->step[1], *t = s->t + first;
    const uint32_t *hit = s->hit + first, width = axes->width, columns = (axes->width + BLOCK - 1) / BLOCK;
    int32_t element[GROUP]; /* at most 2^28 pixels */
    float px[GROUP], py[GROUP], back[GROUP];
    uint32_t of[GROUP];
    for (uint32_t k = 0; k < GROUP; k++) {
        of[k] = hit[k < pixels ? k : pixels - 1];
        back[k] = t[k < pixels ? k : pixels - 1] * 0.9999f;
    }
    for (uint32_t k = 0; k < GROUP; k++) {
        const uint32_t x = of[k] & 0xffff, y = of[k] >> 16;
        element[k] = (int32_t)(y * width + x);
        px[k] = ((float)x + 0.5f) * sx - 1.0f;
        py[k] = 1.0f - ((float)y + 0.5f) * sy;
        g->order[k] = (y / BLOCK * columns + x / BLOCK) * GROUP + (y % BLOCK) * BLOCK + x % BLOCK;
        g->side[k] = 0;
    }
    for (int i = 0; i < 3; i++) {
        const float eye = axes->eye[i], fwd = axes->fwd[i], right = axes->right[i], up = axes->up[i];
        const float *normal = planes->normal[i];
        for (uint32_t k = 0; k < GROUP; k++) {
            const float dir = fwd + px[k] * right + py[k] * up;
            g->point[i][k] = eye + back[k] * dir;
            g->normal[i][k] = normal[element[k]];
            g->side[k] -= dir * g->normal[i][k];
        }
    }
}

/* Most groups are complete, and a copy of constant size takes a few instructions. */
BENCH_INLINE void put_group(float *to, const float from[GROUP], uint32_t pixels)
{
    if (pixels == GROUP)
        memcpy(to, from, GROUP * sizeof *to);
    else
        memcpy(to, from, pixels * sizeof *to);
}

/* Makes all samples of one group's pixels, sample by sample: neighbours in the arrays are neighbours in space. */
BENCH_CLONES
static void make_group(const bench_sky_rays *s, uint64_t first, uint32_t pixels)
{
    ao_group g;
    float v[3][GROUP];
    uint64_t ray = first * s->samples;
    read_group(s, first, pixels, &g);
    for (uint32_t sample = 0; sample < s->samples; sample++, ray += pixels) {
        octahedron_points(&g, sample, v);
        if (s->diffuse)
            lean_to_normals(&g, v);
        turn_to_eye(&g, v);
        for (int i = 0; i < 3; i++) {
            put_group(s->org[i] + ray, g.point[i], pixels);
            put_group(s->dir[i] + ray, v[i], pixels);
        }
    }
}

/* Prefetches the normals of a group to come. The planes were written past the caches, and a group's rows are far
 * apart. */
static void prefetch_group(const bench_sky_rays *s, uint64_t first)
{
    const bench_planes *planes = s->planes;
    const uint32_t *hit = s->hit + first, width = s->axes->width;
    for (uint32_t k = 0; k < GROUP; k += BLOCK) {
        const size_t element = (size_t)(hit[k] >> 16) * width + (hit[k] & 0xffff);
        for (int i = 0; i < 3; i++)
            __builtin_prefetch(planes->normal[i] + element);
    }
}

void bench_make_sky_rays(const bench_sky_rays *s, uint64_t first, uint64_t end)
{
    for (; first < end; first += GROUP) {
        const uint64_t ahead = first + (uint64_t)GROUPS_AHEAD * GROUP, left = end - first;
        if (ahead + GROUP <= s->hits)
            prefetch_group(s, ahead);
        make_group(s, first, left < GROUP ? (uint32_t)left : GROUP);
    }
}
