/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Normalised rays for the BVH, and its slabs (Kay, Kajiya, "Ray Tracing Complex Scenes", 1986), conservative: a child
 * is culled for a ray only where the ray certainly does not pass its closed box at a t that still counts.
 *
 * Normalised rays. Origins are times the scene's scale, a power of two that brings the scene's coordinates to at most
 * 2; directions are times 2^-k, so that their largest component is at least 1 and less than 2; and t is times s = 2^k
 * scale. All three are exact except for underflow, which is below 2^-149 and vanishes in the bounds below. Rays beyond
 * bvh_ray_limits are unusual (query/ray_intake.h), those from afar because E grows with |o|.
 *
 * Which t count: t is rounded to float before it is compared with the range. So the range is widened, by 2^-20 of its
 * ends and by 2^-86, which is more than 2^-149 s; beyond 2^100 no ray meets anything. `near` and `far` are these ends;
 * 2^-18 of them and 2^-84 further in, t is certainly inside.
 *
 * Slabs, for each axis a, with o and d of the ray, p of a plane, P the largest |p| of the root's box, and u = 2^-24. A
 * component of d below 2^-60 is replaced by 2^-60 of the same sign, also that of a zero, and r = 1 / d within 2^-21.
 * Planes lie outside of what they bound by 2^-20 |p|: nodes are built so (bvh_nodes.c), and so a large primitive widens
 * its own box alone. For a ray they are moved outwards by
 *   E = 2^-20 |o| + 2^-57 M + 2^-85,   M the largest |o| + P of the axes
 * more, and t = (p +- E) r - o r, fused or not.
 *   Rounding: r loses 2^-21 (|p| + |o|) |r|, the products and sums at most 5 u of it: together less than 0.82 times
 * 2^-20 (|p| + |o|) |r|. The remainder, 2.8 u of both, covers the roundings of E itself and of the nodes' planes, and
 * a moved origin, off by u / 2 |o| and 2^-90. 2^-85 covers that and underflow, also in the boxes.
 *   Components that were enlarged: a ray that counts is inside the root's box at t, and along the axis of its largest
 * component |t| |d| <= |o| + P, so |t| <= M. With d' for the original component, the ray is at p = o + t d', where the
 * slab's t is t d' / d, at most |t| away from 0, so at most 2 M from t; the planes' move is worth 2^-57 M |r| > 7 M.
 * A test shrinks E until hits are lost.
 *
 * Many rays may share one E: that of the largest |o|. */
#ifndef CGT_BVH_RAY_H
#define CGT_BVH_RAY_H

#include "kernel/primitive/lane_tests.h"
#include "kernel/packet/ray_packet.h"
#include "kernel/bvh/bvh_node.h"
#include "kernel/tunables.h"
#include "query/moved_ray.h"

/* Beyond these, rays are unusual: origins beyond 2^8 times the scene, s outside 2^-100 to 2^60, and directions of which
 * the power of two or its inverse is no normal float. */
CGT_SPU_INLINE ray_limits bvh_ray_limits(float scale)
{
    const float slowest = 0x1p-100f / scale, fastest = 0x1p60f / scale;
    return (ray_limits){0x1p8f / scale, slowest > 0x1p-120f ? slowest : 0x1p-120f,
                        fastest < 0x1p120f ? fastest : 0x1p120f};
}

#define BVH_MAX_T 0x1p100f
#define BVH_MIN_DIR 0x1p-60f

/* The state of a call, common to its rays, which are those of arrays, or one. */
typedef struct bvh_call {
    const cgt_committed_scene *committed_scene;
    const cgt_bvh *tree;
    const ray_source *source;
    uint64_t first;     /* ray 0 of the array */
    const cgt_ray *ray; /* the only one of the call; NULL: see above */
    cgt_counts *counts;
    float scale;
    float max_plane[3]; /* P */
    bool any_hit;
    bool skips_prims;          /* some rays skip primitives: bvh_ray_skips */
    const uint32_t *skip_prim; /* of each ray, a primitive or CGT_INVALID_ID; NULL: rays skip nothing */
    const uint32_t *mask;      /* of each ray; NULL: masks hide nothing */
    const ray_limits *moved;   /* rays beyond these were moved (query/moved_ray.h); NULL: none */
    float org_error;           /* of all rays, as in lane_tests.h */
    float range_error[2];      /* t is certainly inside 2^-18 of an end of the range and this further in */
} bvh_call;

CGT_SPU_INLINE void bvh_call_init(const cgt_committed_scene *committed_scene, cgt_counts *counts, bvh_call *c)
{
    memset(c, 0, sizeof *c);
    c->committed_scene = committed_scene;
    c->tree = &committed_scene->bvh;
    c->counts = counts;
    c->scale = committed_scene->scale;
    c->range_error[0] = c->range_error[1] = 0x1p-84f;
    for (int a = 0; a < 3; a++) {
        const float low = fabsf(committed_scene->bvh.low[a]), high = fabsf(committed_scene->bvh.high[a]);
        c->max_plane[a] = (low > high ? low : high) * c->scale * (1 + 0x1p-20f);
    }
}

/* Computes E of a ray; of several, org holds the largest components. */
CGT_SPU_INLINE void bvh_slab_error(const bvh_call *c, const float org[3], float slab_error[3])
{
    float most = 0;
    for (int a = 0; a < 3; a++)
        most = org[a] + c->max_plane[a] > most ? org[a] + c->max_plane[a] : most;
    for (int a = 0; a < 3; a++)
        slab_error[a] = (org[a] * 0x1p-20f + (most * 0x1p-57f + 0x1p-85f)) * BVH_ERROR_SCALE;
}

/* Whether ray i skips a primitive: the one that it names, or one of a geometry that its mask excludes. */
CGT_SPU_INLINE bool bvh_ray_skips(const bvh_call *c, uint32_t i, uint32_t prim)
{
    if (c->skip_prim && c->skip_prim[i] == prim)
        return true;
    return c->mask && !(c->mask[i] & cgt_primitives_array(&c->committed_scene->prims, prim)->mask);
}

/* ---- deciding ---- */

/* Returns ray i as the caller described it. */
CGT_SPU_INLINE cgt_ray bvh_input_ray(const bvh_call *c, uint32_t i)
{
    return c->ray ? *c->ray : ray_read(c->source, c->first + i);
}

/* A ray's best hit so far: its t is in [low, high]. */
typedef struct best_hit {
    float low, high;
    uint32_t prim; /* CGT_INVALID_ID: none yet */
    uint32_t unused;
} best_hit;

/* The same of a moved ray: t is rounded, within 2^-24 or, denormal, 2^-149; the way is within 2^-49. */
static inline void bvh_set_moved_best(const bvh_call *c, const cgt_ray *ray, double t, best_hit *best)
{
    moved_ray m = {.way = 0};
    moved_ray_init(&m, c->committed_scene, ray);
    const double place = t * m.speed;
    const double error = fabs(place) * 0x1p-23 + 0x1p-148 * m.speed + fabs(m.way) * 0x1p-48;
    best->low = moved_end(place - m.way, error, -1);
    best->high = moved_end(place - m.way, error, 1);
}

/* Sets the interval of a best hit from its t, rounded, on a given ray. */
CGT_SPU_INLINE void bvh_set_best(const bvh_call *c, const cgt_ray *ray, float t, best_hit *best)
{
    const float *dir = ray->line.dir;
    float longest = 0;
    int exponent;
    if (c->moved && ray_classify(ray, c->moved) == RAY_UNUSUAL) {
        bvh_set_moved_best(c, ray, (double)t, best);
        return;
    }
    for (int a = 0; a < 3; a++)
        longest = fabsf(dir[a]) > longest ? fabsf(dir[a]) : longest;
    frexpf(longest, &exponent); /* 2^exponent is twice 2^k */
    const float scaled = (float)(ldexp((double)t, exponent - 1) * (double)c->scale);
    const float width = fabsf(scaled) * 0x1p-22f + 0x1p-84f;
    best->low = scaled - width;
    best->high = scaled + width;
}

/* Decides whether primitive beats the best hit of ray i, which it then is. For any-hit rays, low and
 * high become -infinity. */
__attribute__((noinline, cold, unused)) static bool bvh_decide(const bvh_call *c, uint32_t i, uint32_t prim,
                                                               best_hit *best)
{
    double t;
    if (best->prim == prim || best->high == -INFINITY)
        return false;
    const cgt_ray ray = bvh_input_ray(c, i);
    if (!filter_is_closer(&c->committed_scene->prims, &ray, c->any_hit ? CGT_INVALID_ID : best->prim, prim, &t,
                          c->counts))
        return false;
    best->prim = prim;
    best->low = best->high = -INFINITY;
    if (!c->any_hit)
        bvh_set_best(c, &ray, (float)t, best);
    return true;
}

#endif
