/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hits of a packet: its rays one by one through the BVH or a loose grid, or together through a structure of the
 * papers, where their bounds cover it. */
#include "kernel/primitive/filter.h"

/* Hits are decided exactly, whatever triangle_test says. */
static void trace_rays(const cgt_committed_scene *committed_scene, packet *p, bool use_bvh, cgt_counts *counts)
{
    p->fast = false; /* exact tests need exact values */
    for (uint32_t i = 0; i < p->lanes; i++) {
        const cgt_ray ray = filter_ray(p, i);
        const uint32_t skip_prim = p->skips_prims ? p->skip_prim[i] : CGT_INVALID_ID;
        const uint32_t mask = p->has_masks ? p->mask[i] : UINT32_MAX;
        if (p->high[i] == -INFINITY)
            continue; /* takes no part */
        counts->packets++;
        p->prim[i] = CGT_KERNEL(cgt_ray_trace)(committed_scene, &ray, use_bvh, skip_prim, mask, p->any_hit, counts);
        if (p->prim[i] != CGT_INVALID_ID)
            p->low[i] = p->high[i] = -INFINITY; /* settled */
    }
}

void CGT_KERNEL(cgt_packet_trace)(const cgt_committed_scene *committed_scene, packet *p,
                                  const cgt_trace_settings *settings, cgt_counts *counts)
{
    const cgt_structure structure = committed_scene->structure;
    const bool use_bvh = structure == CGT_STRUCTURE_BVH || settings->use_bvh;
    if (!p->rays || !committed_scene->valid)
        return;
    if (use_bvh || structure == CGT_STRUCTURE_LOOSE_GRID || p->extreme || committed_scene->brute_force)
        trace_rays(committed_scene, p, use_bvh, counts);
    else
        CGT_KERNEL(cgt_papers_trace)(committed_scene, p, settings, counts);
}
