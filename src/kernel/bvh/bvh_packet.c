/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays of a packet through the BVH, one at a time. Hits are decided exactly, whatever triangle_test says. */
#include "kernel/bvh/bvh_single.h"

/* Ray i, normalised. Returns false where the bounds do not cover it. */
CGT_SPU_INLINE bool bvh_ray_from_packet(const bvh_call *c, uint32_t i, bvh_ray *r)
{
    const packet *p = c->p;
    const cgt_ray ray = {
        .line = {.org = {p->org[0][i], p->org[1][i], p->org[2][i]}, .dir = {p->dir[0][i], p->dir[1][i], p->dir[2][i]}},
        .t_min = p->t_min[i],
        .t_max = p->t_max[i]};
    return bvh_ray_normalise(c, &ray, i, r);
}

/* A ray that takes part and that the bounds do not cover. */
__attribute__((noinline, cold)) static void bvh_packet_ray_unusual(const bvh_call *c, packet *p, uint32_t i)
{
    const cgt_ray ray = filter_ray(p, i);
    const uint32_t skip_prim = c->skip_prim ? c->skip_prim[i] : CGT_INVALID_ID;
    const uint32_t mask = c->mask ? c->mask[i] : UINT32_MAX;
    p->prim[i] = CGT_KERNEL(cgt_trace_unusual)(c->committed_scene, &ray, true, skip_prim, mask, p->any_hit, c->counts);
    if (p->prim[i] != CGT_INVALID_ID)
        p->low[i] = p->high[i] = -INFINITY; /* settled */
}

CGT_SPU_INLINE void bvh_packet_trace_rays(const bvh_call *c, packet *p, bool any_hit)
{
    for (uint32_t i = 0; i < p->lanes; i++) {
        bvh_ray r;
        if (p->high[i] == -INFINITY || p->t_min[i] > FLT_MAX || p->t_max[i] < -FLT_MAX)
            continue; /* takes no part, or no t is in its range */
        c->counts->packets++;
        if (c->scale > 0x1p60f || c->scale < 0x1p-60f || !bvh_ray_from_packet(c, i, &r)) {
            bvh_packet_ray_unusual(c, p, i);
            continue;
        }
        bvh_single_trace(c, &r, 0, any_hit);
        if (r.best.prim == CGT_INVALID_ID)
            continue;
        p->prim[i] = r.best.prim;
        p->low[i] = p->high[i] = -INFINITY; /* settled */
    }
}

void CGT_KERNEL(cgt_bvh_trace)(const cgt_committed_scene *committed_scene, packet *p,
                               const cgt_trace_settings *settings, cgt_counts *counts)
{
    bvh_call c;
    (void)settings;
    p->fast = false; /* decided exactly, and so resolved as such */
    bvh_call_init(committed_scene, counts, &c);
    c.p = p;
    counts->bvh_rays += p->rays;
    c.any_hit = p->any_hit;
    if (p->skips_prims) {
        c.skips_prims = true;
        c.skip_prim = p->skip_prim;
        c.mask = p->has_masks ? p->mask : NULL;
    }
    if (p->any_hit)
        bvh_packet_trace_rays(&c, p, true);
    else
        bvh_packet_trace_rays(&c, p, false);
}
