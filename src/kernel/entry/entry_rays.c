/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays, and the values of hits that are known. A loose grid takes rays one by one. In the papers' grid
 * neighbours become packets in their order, which split where they diverge; in a kd-tree or a BIH packets consist of
 * neighbours among the rays of one octant. */
#include "kernel/packet/ray_packet.h"

#define RAY_PACKET 64

/* The state of a call, common to its packets. */
typedef struct rays_call {
    const cgt_committed_scene *committed_scene;
    ray_source source;
    const cgt_trace_settings *settings;
    const cgt_hits *hits;
    uint8_t *occluded;
    packet_hits *packet_hits; /* of the packet that is being traced */
    cgt_counts *counts;
} rays_call;

static void trace_packet(const rays_call *c, const ray_order *order, uint32_t first, uint32_t count, packet *p);

/* Rays of which some are unusual: those apart, one by one, and the others as a packet. */
__attribute__((noinline, cold)) static void trace_mixed(const rays_call *c, const ray_order *order, uint32_t first,
                                                        uint32_t count, packet *p)
{
    const ray_limits limits = ray_packet_limits(c->committed_scene, &c->source);
    uint32_t from[PACKET_MAX_RAYS], others = 0;
    const ray_order of_others = {order->first, from};
    for (uint32_t k = 0; k < count; k++)
        if (ray_packet_read(&c->source, ray_index(order, first + k), &limits, p, 0) == RAY_UNUSUAL)
            trace_packet(c, order, first + k, 1, p);
        else
            from[others++] = (uint32_t)(ray_index(order, first + k) - order->first);
    if (others)
        trace_packet(c, &of_others, 0, others, p);
}

static void trace_packet(const rays_call *c, const ray_order *order, uint32_t first, uint32_t count, packet *p)
{
    if (!ray_packet_init(c->committed_scene, &c->source, order, first, count, p, c->counts)) {
        trace_mixed(c, order, first, count, p);
        return;
    }
    p->fast = c->settings->triangle_test != CGT_TRIANGLE_TEST_AUTO; /* a packet of unusual rays resets it */
    CGT_KERNEL(cgt_packet_trace)(c->committed_scene, p, c->settings, c->counts);
    if (c->hits) {
        CGT_KERNEL(cgt_packet_resolve)(c->committed_scene, p, c->settings, c->packet_hits, c->counts);
        ray_store_hits(c->packet_hits, order, first, count, c->hits);
        return;
    }
    for (uint32_t k = 0; k < count; k++) {
        c->occluded[ray_index(order, first + k)] = p->prim[k] != CGT_INVALID_ID;
        c->counts->hits += p->prim[k] != CGT_INVALID_ID;
    }
}

/* ---- rays of one octant together ---- */

#define DIRECTIONS 8u /* octants */

static uint32_t direction_of(const ray_source *s, uint64_t i)
{
    const float x = ray_component(s, s->rays->dir[0], i), y = ray_component(s, s->rays->dir[1], i),
                z = ray_component(s, s->rays->dir[2], i);
    return (uint32_t)(x < 0) | (uint32_t)(y < 0) << 1 | (uint32_t)(z < 0) << 2;
}

/* A stable counting sort by octant. Returns whether there are several. */
static bool order_rays(const ray_source *s, uint64_t first, uint32_t count, uint32_t *from)
{
    uint8_t direction[CGT_RAYS_CHUNK];
    uint32_t start[DIRECTIONS + 1] = {0}, directions = 0;
    for (uint32_t i = 0; i < count; i++) {
        direction[i] = (uint8_t)direction_of(s, first + i);
        start[direction[i] + 1]++;
    }
    for (uint32_t d = 0; d < DIRECTIONS; d++) {
        directions += start[d + 1] != 0;
        start[d + 1] += start[d];
    }
    if (directions < 2)
        return false;
    for (uint32_t i = 0; i < count; i++)
        from[start[direction[i]]++] = i;
    return true;
}

/* Traces packets through the committed structure. */
static void trace_packets(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first,
                          uint64_t end, const cgt_trace_settings *settings, const cgt_hits *hits, uint8_t *occluded,
                          cgt_counts *counts)
{
    packet *p = cgt_scratch_take(counts->scratch, sizeof *p);
    uint32_t *from = cgt_scratch_take(counts->scratch, CGT_RAYS_CHUNK * sizeof *from);
    const rays_call c = {.committed_scene = committed_scene,
                         .source = ray_source_init(rays, NULL),
                         .settings = settings,
                         .hits = hits,
                         .occluded = occluded,
                         .packet_hits = cgt_scratch_take(counts->scratch, sizeof(packet_hits)),
                         .counts = counts};
    const uint32_t count = (uint32_t)(end - first);
    const cgt_structure structure = committed_scene->structure;
    const bool tree =
        structure == CGT_STRUCTURE_KD || structure == CGT_STRUCTURE_KD_ROPES || structure == CGT_STRUCTURE_BIH;
    const ray_order order = {first, tree && order_rays(&c.source, first, count, from) ? from : NULL};
    p->any_hit = hits == NULL;
    p->triangle_test = settings->triangle_test;
    counts->rays += count;
    for (uint32_t i = 0; i < count; i += RAY_PACKET)
        trace_packet(&c, &order, i, count - i < RAY_PACKET ? count - i : RAY_PACKET, p);
    cgt_scratch_return(counts->scratch, p);
}

void CGT_KERNEL(cgt_trace_rays)(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first,
                                uint64_t end, const cgt_trace_settings *settings, const cgt_hits *hits,
                                uint8_t *occluded, cgt_counts *counts)
{
    if (settings->use_bvh && !committed_scene->brute_force)
        CGT_KERNEL(cgt_bvh_trace_rays)(committed_scene, rays, first, end, settings, hits, occluded, counts);
    else
        trace_packets(committed_scene, rays, first, end, settings, hits, occluded, counts);
}

/* ---- the values of hits that are known by their primitives: those of bands (scene/bands.h) and of lists ---- */

void CGT_KERNEL(cgt_resolve_rays)(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first,
                                  uint64_t end, const uint32_t *prim, const cgt_trace_settings *settings,
                                  const cgt_hits *hits, cgt_counts *counts)
{
    packet *p = cgt_scratch_take(counts->scratch, sizeof *p);
    packet_hits *h = cgt_scratch_take(counts->scratch, sizeof *h);
    const ray_source source = ray_source_init(rays, NULL);
    const ray_order order = {first, NULL};
    const uint32_t count = (uint32_t)(end - first);
    for (uint32_t i = 0; i < count; i += PACKET_MAX_RAYS) {
        const uint32_t lanes = count - i < PACKET_MAX_RAYS ? count - i : PACKET_MAX_RAYS;
        ray_packet_of_hits(&source, first + i, lanes, prim + i, p);
        CGT_KERNEL(cgt_packet_resolve)(committed_scene, p, settings, h, counts);
        ray_store_hits(h, &order, i, lanes, hits);
    }
    cgt_scratch_return(counts->scratch, p);
}
