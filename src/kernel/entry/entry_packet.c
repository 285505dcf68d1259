/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hits of a packet, through the structure that the commit built. */
#include "kernel/primitive/filter.h"

/* Numbers too large or too small for the bounds of packets, or coordinates too large for any structure. */
static void trace_extreme(const cgt_committed_scene *committed_scene, packet *p, const cgt_trace_settings *settings,
                          cgt_counts *counts)
{
    const bool use_bvh = committed_scene->structure == CGT_STRUCTURE_BVH || settings->use_bvh;
    for (uint32_t i = 0; i < p->lanes; i++) {
        if (p->high[i] == -INFINITY)
            continue; /* takes no part */
        const cgt_ray ray = filter_ray(p, i);
        const uint32_t skip_prim = p->skips_prims ? p->skip_prim[i] : CGT_INVALID_ID;
        const uint32_t mask = p->has_masks ? p->mask[i] : UINT32_MAX;
        p->prim[i] = CGT_KERNEL(cgt_trace_unusual)(committed_scene, &ray, use_bvh, skip_prim, mask, p->any_hit, counts);
        if (p->prim[i] != CGT_INVALID_ID)
            p->low[i] = p->high[i] = -INFINITY; /* settled */
    }
}

void CGT_KERNEL(cgt_packet_trace)(const cgt_committed_scene *committed_scene, packet *p,
                                  const cgt_trace_settings *settings, cgt_counts *counts)
{
    if (!p->rays || !committed_scene->valid)
        return;
    if (committed_scene->brute_force || p->extreme)
        trace_extreme(committed_scene, p, settings, counts);
    else if (committed_scene->structure == CGT_STRUCTURE_BVH || settings->use_bvh)
        CGT_KERNEL(cgt_bvh_trace)(committed_scene, p, settings, counts);
    else if (committed_scene->structure == CGT_STRUCTURE_LOOSE_GRID)
        CGT_KERNEL(cgt_loose_grid_trace)(committed_scene, p, settings, counts);
    else
        CGT_KERNEL(cgt_papers_trace)(committed_scene, p, settings, counts);
}
