/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray of any kind: plain ones through the BVH if there is one, the others another way. The stack of the
 * traversal takes 8 KB: nothing else that takes much may be in its functions. */
#include "kernel/bvh/bvh_single.h"

__attribute__((noinline)) static void trace_closest(const bvh_call *c, bvh_ray *r) { bvh_single_trace(c, r, 0, false); }

__attribute__((noinline)) static void trace_any(const bvh_call *c, bvh_ray *r) { bvh_single_trace(c, r, 0, true); }

uint32_t CGT_KERNEL(cgt_ray_trace)(const cgt_committed_scene *committed_scene, const cgt_ray *ray, bool use_bvh,
                                   uint32_t skip_prim, uint32_t mask, bool any_hit, cgt_counts *counts)
{
    bvh_call c;
    bvh_ray r;
    ray_limits limits = RAY_NO_LIMITS;
    if (use_bvh) { /* else another thread may be building it */
        bvh_call_init(committed_scene, counts, &c);
        limits = bvh_ray_limits(c.scale);
    }
    const ray_state state = ray_classify(ray, &limits);
    counts->bvh_rays += use_bvh;
    counts->invalid_rays += state == RAY_INVALID;
    if (state > RAY_UNUSUAL || !committed_scene->valid)
        return CGT_INVALID_ID;
    if (!use_bvh || state == RAY_UNUSUAL || committed_scene->brute_force)
        return CGT_KERNEL(cgt_trace_unusual)(committed_scene, ray, use_bvh, skip_prim, mask, any_hit, counts);
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
