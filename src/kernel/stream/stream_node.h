/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A node of the BVH and a list of rays of one octant: masks of the rays that pass each child, and lists of them; see
 * stream_trace.c. */
#ifndef CGT_STREAM_NODE_H
#define CGT_STREAM_NODE_H

#include "kernel/stream/stream.h"

/* Words of the masks of a piece of `chunks` vectors, in whole vectors; and of all that a piece of one vector takes. */
#define STREAM_MASK_WORDS(chunks) ((CGT_LANES * (chunks) / 2 + CGT_LANES - 1) / CGT_LANES * CGT_LANES)
#define STREAM_MIN_WORDS (STREAM_MASK_WORDS(1u) + STREAM_LIST_WORDS(CGT_LANES))

_Static_assert(CGT_STREAM_ARENA >= CGT_BVH_MAX_DEPTH * STREAM_MIN_WORDS, "a piece fits at every depth");

/* A node on the way down, and the current piece of its list. */
typedef struct stream_level {
    const bvh_node *node;
    const uint32_t *list;
    uint32_t count;           /* of the list */
    uint32_t first, rays;     /* the piece */
    uint32_t chunks;          /* vectors of it */
    uint32_t next;            /* position among the children below */
    uint32_t children;        /* those that rays pass */
    uint8_t child[CGT_LANES]; /* in the order in which the octant's rays meet them */
    uint8_t row[CGT_LANES];   /* of the masks */
    uint32_t updates;         /* the stream's, when the masks were computed */
    uint16_t *mask;           /* [row][chunk]: rays that pass the child */
    uint32_t *scratch;        /* after the masks */
} stream_level;

/* Planes of a node's children as the octant's rays meet them, moved outwards. */
typedef struct stream_planes {
    _Alignas(CGT_VECTOR_BYTES) float near[3][CGT_LANES];
    float far[3][CGT_LANES];
} stream_planes;

/* Returns the children that the stream's rays may reach, as bits. Near their origins rays pass nodes of which half the
 * children lie behind them. */
CGT_SPU_INLINE unsigned stream_planes_init(const stream *s, const bvh_node *n, stream_planes *p)
{
    const vfloat scale = spux_vfloat(s->call.scale);
    vfloat low[3], high[3];
    for (int a = 0; a < 3; a++) {
        const vfloat slab_error = spux_vfloat(s->slab_error[a]);
        const bool from_above = s->octant >> a & 1;
        low[a] = spu_msub(spux_load(n->low[a]), scale, slab_error);
        high[a] = spu_madd(spux_load(n->high[a]), scale, slab_error);
        spux_store(p->near[a], from_above ? high[a] : low[a]);
        spux_store(p->far[a], from_above ? low[a] : high[a]);
    }
    return stream_reachable(s, low, high);
}

/* Lists those children; branchless: the others are overwritten. */
CGT_SPU_INLINE void stream_list_children(const stream *s, unsigned reached, stream_level *v)
{
    const bvh_node *n = v->node;
    const bool backwards = s->octant >= 4;
    const uint8_t *order = backwards ? n->order[7 - s->octant] + n->children - 1 : n->order[s->octant];
    v->children = 0;
    for (uint32_t k = 0; k < n->children; k++) {
        const uint8_t child = backwards ? *order-- : *order++;
        v->child[v->children] = child;
        v->children += reached >> child & 1;
    }
}

/* Takes rays that do not move along an axis out of the masks of flat children across it. */
__attribute__((noinline, cold, unused)) static void stream_mask_parallel(stream *s, const stream_level *v,
                                                                         uint16_t passed[CGT_LANES])
{
    for (uint32_t a = 0; a < 3; a++)
        for (uint32_t k = v->next; k < v->children; k++) {
            uint16_t *mask = v->mask + (size_t)k * v->chunks;
            if (!(s->still >> a & v->node->flat[a] >> v->child[k] & 1))
                continue;
            passed[k] = 0;
            for (uint32_t i = 0; i < v->chunks; i++) {
                const uint32_t *offset = v->list + v->first + (size_t)i * CGT_LANES;
                const vfloat dir = spux_gather(stream_record(s, RECORD_DIR + a), (vint)spux_load_uint(offset));
                mask[i] &= (uint16_t)~spux_mask_bits(spu_cmpeq(dir, spux_vfloat(0)));
                passed[k] |= mask[i];
            }
        }
}

/* Masks of the rays of a piece that pass the remaining children; turned: of the node, NULL where it has none. */
CGT_SPU_INLINE void stream_mask_rays(stream *s, const stream_level *v, const stream_planes *p, const bvh_turned *turned,
                                     uint16_t passed[CGT_LANES])
{
    const uint32_t first = v->next, end = v->children, chunks = v->chunks;
    uint16_t *row = v->mask + (size_t)first * chunks;
    for (uint32_t i = 0; i < chunks; i++, row++) {
        const uint32_t *offset = v->list + v->first + (size_t)i * CGT_LANES;
        uint16_t *mask = row;
        bvh_turned_rays r;
        vfloat d[8];
        const vfloat *q = d + RECORD_SHIFT;
        if (turned) {
            spux_load_records8_at(stream_record(s, RECORD_ORG), offset, d);
            bvh_turned_rays_init(&s->call, turned, d, d + (RECORD_DIR - RECORD_ORG), &r);
        }
        spux_load_records8_at(stream_record(s, RECORD_RDIR), offset, d);
        for (uint32_t k = first; k < end; k++, mask += chunks) {
            const uint8_t child = v->child[k];
            const vfloat x0 = spu_madd(spux_vfloat(p->near[0][child]), d[0], q[0]);
            const vfloat y0 = spu_madd(spux_vfloat(p->near[1][child]), d[1], q[1]);
            const vfloat z0 = spu_madd(spux_vfloat(p->near[2][child]), d[2], q[2]);
            const vfloat x1 = spu_madd(spux_vfloat(p->far[0][child]), d[0], q[0]);
            const vfloat y1 = spu_madd(spux_vfloat(p->far[1][child]), d[1], q[1]);
            const vfloat z1 = spu_madd(spux_vfloat(p->far[2][child]), d[2], q[2]);
            vfloat enter = spux_max(spux_max(x0, y0), spux_max(z0, d[3]));
            vfloat leave = spux_min(spux_min(x1, y1), spux_min(z1, q[3]));
            if (turned)
                for (int axis = 0; axis < 2; axis++)
                    bvh_clip_to_turned(&r, axis, spux_vfloat(turned->low[axis][child]),
                                       spux_vfloat(turned->high[axis][child]), &enter, &leave);
            *mask = (uint16_t)spux_mask_bits(spux_cmpge(leave, enter));
            passed[k] |= *mask;
        }
    }
}

/* Not inlined: most nodes have no turned slabs. */
__attribute__((noinline, unused)) static void stream_mask_turned(stream *s, const stream_level *v,
                                                                 const stream_planes *p, uint16_t passed[CGT_LANES])
{
    stream_mask_rays(s, v, p, bvh_find_turned(&s->call, v->node), passed);
}

/* Tests the rays of a piece against the remaining children; children that no ray passes are dropped, as above. */
CGT_SPU_INLINE void stream_test_node(stream *s, stream_level *v, const stream_planes *p)
{
    const uint32_t first = v->next, end = v->children;
    uint16_t passed[CGT_LANES] = {0};
    v->updates = s->updates;
    if (__builtin_expect(v->node->flat[0] & BVH_TURNED, 0))
        stream_mask_turned(s, v, p, passed);
    else
        stream_mask_rays(s, v, p, NULL, passed);
    if (__builtin_expect(s->still, 0))
        stream_mask_parallel(s, v, passed);
    v->children = first;
    for (uint32_t k = first; k < end; k++) {
        v->child[v->children] = v->child[k];
        v->row[v->children] = (uint8_t)k;
        v->children += passed[k] != 0;
    }
}

/* Begins the next piece of a level's list. Returns false if there is none. */
CGT_SPU_INLINE bool stream_next_piece(stream *s, stream_level *v, uint32_t *scratch, uint32_t depth)
{
    v->first += v->rays;
    if (v->first >= v->count)
        return false;
    const uint32_t reserved = (CGT_BVH_MAX_DEPTH - 1 - depth) * STREAM_MIN_WORDS;
    const uint32_t free_words =
        (uint32_t)(s->arena + STREAM_ARENA_USED - scratch) - reserved; /* at least STREAM_MIN_WORDS */
    const uint32_t max_vectors =
        (free_words - STREAM_LIST_WORDS(0) - CGT_LANES) / (CGT_LANES + CGT_LANES / 2); /* vectors */
    const uint32_t remaining = v->count - v->first, vectors = (remaining + CGT_LANES - 1) / CGT_LANES;
    v->chunks = vectors <= max_vectors ? vectors : max_vectors ? max_vectors : 1;
    v->rays = vectors <= v->chunks ? remaining : v->chunks * CGT_LANES;
    v->mask = (uint16_t *)(void *)scratch;
    v->scratch = scratch + STREAM_MASK_WORDS(v->chunks);
    v->next = 0;
    stream_planes p;
    stream_list_children(s, stream_planes_init(s, v->node, &p), v);
    stream_test_node(s, v, &p);
    s->call.counts->nodes++;
    return true;
}

/* Removes any-hit rays that have found a hit from the masks of the remaining children. */
CGT_SPU_INLINE void stream_mask_occluded(stream *s, stream_level *v)
{
    const uint32_t chunks = v->chunks;
    uint16_t *column = v->mask;
    v->updates = s->updates;
    for (uint32_t i = 0; i < chunks; i++, column++) {
        const uint32_t *offset = v->list + v->first + (size_t)i * CGT_LANES;
        const vfloat far = spux_gather(stream_record(s, RECORD_FAR), (vint)spux_load_uint(offset));
        const uint16_t undecided = (uint16_t)spux_mask_bits(spu_cmpgt(far, spux_vfloat(-INFINITY)));
        for (uint32_t k = v->next; k < v->children; k++)
            column[(size_t)v->row[k] * chunks] &= undecided;
    }
}

/* Child masks go stale as rays end (any hit) or shorten (closest hit). Where more than 1/8 or 1/3 of a piece changed,
 * recomputes the masks of the remaining children; both shares were measured. */
CGT_SPU_INLINE void stream_refresh_masks(stream *s, stream_level *v, bool any_hit)
{
    const uint32_t updates = s->updates - v->updates;
    if (any_hit && updates * 8 >= v->rays)
        stream_mask_occluded(s, v);
    else if (!any_hit && updates * 3 > v->rays && v->children - v->next > 2) {
        stream_planes p;
        stream_planes_init(s, v->node, &p);
        stream_test_node(s, v, &p);
    }
}

/* Compacts the list of a child's rays; returns how many there are. Chunks that all miss are not skipped: the branch
 * would often be mispredicted. */
CGT_SPU_INLINE uint32_t stream_compact_list(const stream_level *v, uint32_t position)
{
    const uint16_t *mask = v->mask + (size_t)v->row[position] * v->chunks;
    const uint32_t *offset = v->list + v->first;
    uint32_t *to = v->scratch;
    for (uint32_t i = 0; i < v->chunks; i++, offset += CGT_LANES) {
        const unsigned bits = mask[i];
        spux_store_unaligned_uint(to, spux_compress(spux_load_uint(offset), spux_mask_from_bits(bits)));
        to += spux_count_bits(bits);
    }
    spux_store_unaligned_uint(to, spux_vuint(STREAM_DUMMY_RAY));
    return (uint32_t)(to - v->scratch);
}

#endif
