/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The closest hits of a stream, resolved packet by packet, to the caller's arrays. */
#include "kernel/stream/stream.h"
#include "kernel/stream/stream_read.h"

/* Hits among fewer primitives are mostly in a cache: prefetching them costs a tenth of the whole call. */
#define PREFETCH_MIN_PRIMS 131072u

/* Fills a packet with rays and their closest hits, ready to be resolved. */
static void make_hit_packet(const stream *s, uint32_t first, uint32_t count, packet *p)
{
    p->lanes = (count + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
    p->rays = p->lanes;
    p->common_origin = p->from_origin = p->to_light = p->any_hit = p->fast = p->extreme = false;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const uint32_t remaining = count - i;
        ray_lanes q;
        stream_lanes_load(&s->call, first + i, remaining < CGT_LANES ? remaining : CGT_LANES, &q);
        _Alignas(CGT_VECTOR_BYTES) uint32_t prim[CGT_LANES];
        for (uint32_t k = 0; k < CGT_LANES; k++)
            prim[k] = k < remaining ? s->best[first + i + k].prim : CGT_INVALID_ID;
        const vuint best_prim = spux_load_uint(prim);
        /* rays without a hit may hold anything: harmless ones replace them */
        const vmask none = spu_cmpeq(best_prim, spux_vuint(CGT_INVALID_ID));
        vfloat dd = spux_vfloat(0);
        for (int a = 0; a < 3; a++) {
            const vfloat d = spux_select(q.dir[a], spux_vfloat(1), none);
            spux_store(p->org[a] + i, spux_select(q.org[a], spux_vfloat(0), none));
            spux_store(p->dir[a] + i, d);
            dd = spu_add(dd, spu_mul(d, d));
        }
        spux_store(p->rdd + i, spux_div(spux_vfloat(1), dd));
        spux_store(p->t_min + i, spux_max(spux_select(q.t_min, spux_vfloat(0), none), spux_vfloat(-FLT_MAX)));
        spux_store(p->t_max + i, q.t_max);
        spux_store_uint(p->prim + i, best_prim);
    }
}

/* Prefetches what the closest hits of `rays` rays from `first` on are read from: indices, or the
 * points of primitives whose indices have arrived. The hits of incoherent rays lie anywhere in memory. */
static void prefetch_hits(const stream *s, uint32_t first, uint32_t rays, uint32_t count, bool points)
{
    const cgt_primitives *prims = &s->call.committed_scene->prims;
    const cgt_primitive_array *a = prims->array;
    const uint32_t end = first + rays < count ? first + rays : count;
    if (prims->arrays != 1 || (!points && !a->index))
        return;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t prim = s->best[i].prim == CGT_INVALID_ID ? 0 : s->best[i].prim;
        uint32_t point[3];
        if (!points) {
            __builtin_prefetch((const char *)a->index + (size_t)prim * a->index_stride);
            continue;
        }
        const uint32_t count_of_one = cgt_array_points(a, prim, point);
        for (uint32_t k = 0; k < count_of_one; k++)
            __builtin_prefetch(cgt_array_point(a, point[k]));
    }
}

void CGT_KERNEL(cgt_stream_store_hits)(stream *s, uint32_t count, const cgt_trace_settings *settings,
                                       const cgt_hits *hits)
{
    cgt_scratch *scratch = s->call.counts->scratch;
    packet *p = cgt_scratch_take(scratch, sizeof *p);
    packet_hits *h = cgt_scratch_take(scratch, sizeof *h);
    for (uint32_t i = 0; i < count; i += PACKET_MAX_RAYS) {
        const uint32_t rays = count - i < PACKET_MAX_RAYS ? count - i : PACKET_MAX_RAYS;
        const ray_order order = {s->call.first, NULL};
        if (s->call.committed_scene->prims.count >= PREFETCH_MIN_PRIMS) {
            prefetch_hits(s, i + 2 * PACKET_MAX_RAYS, PACKET_MAX_RAYS, count, false);
            prefetch_hits(s, i + PACKET_MAX_RAYS, PACKET_MAX_RAYS, count, true);
        }
        make_hit_packet(s, i, rays, p);
        CGT_KERNEL(cgt_packet_resolve)(s->call.committed_scene, p, settings, h, s->call.counts);
        ray_store_hits(h, &order, i, rays, hits);
    }
    cgt_scratch_return(scratch, p);
}
