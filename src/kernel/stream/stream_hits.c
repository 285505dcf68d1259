/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The closest hits of a stream, resolved packet by packet, to the caller's arrays. */
#include "kernel/packet/ray_packet.h"
#include "kernel/stream/stream.h"
#include "kernel/stream/stream_read.h"

/* Hits among fewer primitives are mostly in a cache: prefetching them costs a tenth of the whole call. */
#define PREFETCH_MIN_PRIMS 131072u

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
        uint32_t prim[PACKET_MAX_RAYS];
        const ray_order order = {s->call.first, NULL};
        if (s->call.committed_scene->prims.count >= PREFETCH_MIN_PRIMS) {
            prefetch_hits(s, i + 2 * PACKET_MAX_RAYS, PACKET_MAX_RAYS, count, false);
            prefetch_hits(s, i + PACKET_MAX_RAYS, PACKET_MAX_RAYS, count, true);
        }
        for (uint32_t k = 0; k < rays; k++)
            prim[k] = s->best[i + k].prim;
        ray_packet_of_hits(s->call.source, s->call.first + i, rays, prim, p);
        CGT_KERNEL(cgt_packet_resolve)(s->call.committed_scene, p, settings, h, s->call.counts);
        ray_store_hits(h, &order, i, rays, hits);
    }
    cgt_scratch_return(scratch, p);
}
