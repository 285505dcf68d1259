/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The values of hits that are known by their primitives: those that the bands of a scene have found (scene/bands.h). */
#include "kernel/packet/ray_packet.h"

/* A ray with its hit. Without one it may hold anything: a harmless ray replaces it. */
static void load_ray(const ray_source *s, uint64_t i, uint32_t prim, packet *p, uint32_t k)
{
    if (prim != CGT_INVALID_ID)
        ray_packet_read(s, i, &RAY_NO_LIMITS, p, k);
    else {
        for (int a = 0; a < 3; a++) {
            p->org[a][k] = 0;
            p->dir[a][k] = 1;
        }
        p->rdd[k] = p->t_min[k] = p->t_max[k] = 0;
    }
    p->prim[k] = prim;
}

static void packet_of_hits(packet *p)
{
    p->common_origin = p->from_origin = p->to_light = p->any_hit = p->fast = p->extreme = false;
    p->skips_prims = p->has_masks = false;
    p->triangle_test = CGT_TRIANGLE_TEST_AUTO;
}

void CGT_KERNEL(cgt_resolve_rays)(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first,
                                  uint64_t end, const uint32_t *prim, const cgt_trace_settings *settings,
                                  const cgt_hits *hits, cgt_counts *counts)
{
    packet *p = cgt_scratch_take(counts->scratch, sizeof *p);
    packet_hits *h = cgt_scratch_take(counts->scratch, sizeof *h);
    const ray_source source = ray_source_init(rays, NULL);
    const ray_order order = {first, NULL};
    const uint32_t count = (uint32_t)(end - first);
    packet_of_hits(p);
    for (uint32_t i = 0; i < count; i += PACKET_MAX_RAYS) {
        const uint32_t lanes = count - i < PACKET_MAX_RAYS ? count - i : PACKET_MAX_RAYS;
        p->rays = p->lanes = (lanes + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
        for (uint32_t k = 0; k < p->lanes; k++)
            load_ray(&source, first + i + k, k < lanes ? prim[i + k] : CGT_INVALID_ID, p, k);
        CGT_KERNEL(cgt_packet_resolve)(committed_scene, p, settings, h, counts);
        ray_store_hits(h, &order, i, lanes, hits);
    }
    cgt_scratch_return(counts->scratch, p);
}
