/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray through the BVH, and the rays of a packet, one at a time. Hits are decided exactly, whatever triangle_test
 * says. The stack of the traversal takes 8 KB: nothing else that takes much may be in its functions. */
#include "kernel/bvh/bvh_single.h"

__attribute__((noinline)) static void trace_closest(const bvh_call *c, bvh_ray *r) { bvh_single_trace(c, r, 0, false); }

__attribute__((noinline)) static void trace_any(const bvh_call *c, bvh_ray *r) { bvh_single_trace(c, r, 0, true); }

uint32_t CGT_KERNEL(cgt_bvh_trace_ray)(const cgt_committed_scene *committed_scene, const cgt_ray *ray,
                                       uint32_t skip_prim, uint32_t mask, bool any_hit, cgt_counts *counts)
{
    bvh_call c;
    bvh_ray r;
    const bool fits = bvh_call_init(committed_scene, counts, &c);
    const ray_limits limits = bvh_ray_limits(c.scale);
    const ray_state state = ray_classify(ray, &limits);
    counts->bvh_rays++;
    counts->invalid_rays += state == RAY_INVALID;
    if (state > RAY_UNUSUAL || !committed_scene->valid)
        return CGT_INVALID_ID;
    if (state == RAY_UNUSUAL || !fits || committed_scene->brute_force)
        return CGT_KERNEL(cgt_trace_unusual)(committed_scene, ray, true, skip_prim, mask, any_hit, counts);
    c.ray = ray;
    c.any_hit = any_hit;
    c.skip_prim = skip_prim == CGT_INVALID_ID ? NULL : &skip_prim;
    c.mask = committed_scene->has_masks && mask != UINT32_MAX ? &mask : NULL;
    c.skips_prims = c.skip_prim || c.mask;
    bvh_ray_normalise(&c, ray, 0, &r);
    if (any_hit)
        trace_any(&c, &r);
    else
        trace_closest(&c, &r);
    return r.best.prim;
}

void CGT_KERNEL(cgt_bvh_trace)(const cgt_committed_scene *committed_scene, packet *p,
                               const cgt_trace_settings *settings, cgt_counts *counts)
{
    (void)settings;
    p->fast = false; /* decided exactly, and so resolved as such */
    for (uint32_t i = 0; i < p->lanes; i++) {
        const cgt_ray ray = filter_ray(p, i);
        if (p->high[i] == -INFINITY)
            continue; /* takes no part */
        counts->packets++;
        p->prim[i] =
            CGT_KERNEL(cgt_bvh_trace_ray)(committed_scene, &ray, p->skips_prims ? p->skip_prim[i] : CGT_INVALID_ID,
                                          p->has_masks ? p->mask[i] : UINT32_MAX, p->any_hit, counts);
        if (p->prim[i] != CGT_INVALID_ID)
            p->low[i] = p->high[i] = -INFINITY; /* settled */
    }
}
