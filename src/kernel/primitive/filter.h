/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shared by all tests in single precision: a sphere's second root, and the decision of what a test leaves open. */
#ifndef CGT_FILTER_H
#define CGT_FILTER_H

#include <float.h>
#include <math.h>

#include "exact/decide.h"
#include "exact/triangle_double.h"
#include "kernel/packet/ray_mask.h"
#include "kernel/primitive/lane_vectors.h"
#include "kernel/tunables.h"

/* Lanes whose first root of a sphere certainly lies before the range take the second one, whose interval ends at `end`
 * and is t_width long (sphere_filter.h). inside: lanes that certainly have both roots. Returns those that took it. */
CGT_SPU_INLINE vmask filter_second_root(vmask inside, vfloat t_min, vfloat end, vfloat t_width, vfloat *low,
                                        vfloat *high)
{
    /* an end of minus infinity is that of an overflow */
    const vmask before = spu_and(spu_cmpgt(t_min, *high), spux_cmpge(*high, spux_vfloat(-FLT_MAX)));
    const vmask second = spu_and(inside, before);
    *low = spux_select(*low, spu_sub(end, t_width), second);
    *high = spux_select(*high, end, second);
    return second;
}

/* Whether a ray that hits one of two primitives hits the other at the same t. Capsules with exchanged ends are one
 * surface, but their t may round to neighbouring floats, which an end of the range tells apart; not 0, since the sign
 * is right. */
CGT_SPU_INLINE bool filter_are_copies(const cgt_primitive *a, const cgt_primitive *b, float t_min, float t_max)
{
    return cgt_same_surface(a, b) && (a->kind != CGT_KIND_CAPSULES || (t_min == 0 && t_max == INFINITY) ||
                                      !memcmp(&a->capsule, &b->capsule, sizeof a->capsule));
}

/* Decides whether the ray hits `prim` before its closest hit so far (CGT_INVALID_ID: none yet), and where. */
CGT_SPU_INLINE bool filter_is_closer(const cgt_primitives *prims, const cgt_ray *ray, uint32_t best_prim, uint32_t prim,
                                     double *t, cgt_counts *counts)
{
    uint64_t exact = 0;
    cgt_decided_hit hit = {.primitive = cgt_primitives_get(prims, prim)}, best;
    if (best_prim != CGT_INVALID_ID) {
        best.primitive = cgt_primitives_get(prims, best_prim);
        if (prim > best_prim && filter_are_copies(&hit.primitive, &best.primitive, ray->t_min, ray->t_max))
            return false; /* of copies the first one */
    }
    if (hit.primitive.kind == CGT_KIND_TRIANGLES && cgt_triangle_is_parallel(ray->line.dir, &hit.primitive.triangle))
        return false;
    counts->double_tests++;
    const bool is_hit = cgt_decide_hit(ray, &hit, &exact), was_exact = exact != 0;
    counts->exact_tests += was_exact;
    *t = hit.t;
    if (!is_hit || best_prim == CGT_INVALID_ID)
        return is_hit;
    const bool is_closer = cgt_decide_is_closer(ray, prim, &hit, best_prim, &best, &exact);
    counts->exact_tests += exact && !was_exact; /* count a test once */
    return is_closer;
}

/* Ray i of a packet as the caller described it. */
CGT_SPU_INLINE cgt_ray filter_ray(const packet *p, uint32_t i)
{
    return (cgt_ray){
        .line = {.org = {p->org[0][i], p->org[1][i], p->org[2][i]}, .dir = {p->dir[0][i], p->dir[1][i], p->dir[2][i]}},
        .t_min = p->t_min[i],
        .t_max = p->t_max[i]};
}

/* Whether `prim` may become the closest hit of ray i: it is not yet, the ray takes part, and it does not skip it. */
CGT_SPU_INLINE bool filter_may_hit(const cgt_primitives *prims, const packet *p, uint32_t i, uint32_t prim)
{
    return p->prim[i] != prim && p->high[i] != -INFINITY &&
           !(p->skips_prims && ray_skips(p, i, prim, skip_mask_of(prims, p, prim)));
}

/* Decides whether `prim` is the closest hit of ray i, and stores it. */
__attribute__((noinline, unused)) static void filter_decide(const cgt_primitives *prims, packet *p, uint32_t i,
                                                            uint32_t prim, cgt_counts *counts)
{
    const cgt_ray ray = filter_ray(p, i);
    double t;
    if (!filter_may_hit(prims, p, i, prim) ||
        !filter_is_closer(prims, &ray, p->any_hit ? CGT_INVALID_ID : p->prim[i], prim, &t, counts))
        return;
    p->prim[i] = prim;
    if (p->any_hit) {
        p->low[i] = p->high[i] = -INFINITY;
        return;
    }
    const float rounded = (float)t, width = fabsf(rounded) * 0x1p-22f + 0x1p-140f;
    p->low[i] = rounded - width;
    p->high[i] = rounded + width;
}

#endif
