/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Streams of rays through a bounding interval hierarchy (Wald, Gribble, Boulos, Kensler, "SIMD Ray Stream Tracing", 2007;
 * Barringer, Akenine-Moeller, "Dynamic Ray Stream Traversal", 2014): the rays of a packet go down as lists, one for each
 * octant of their directions, from which rays drop out that pass neither child. A vector so is full of rays that pass a
 * node, where a packet's has whatever neighbours do. Each ray takes its interval of t along.
 *
 * A node's list makes one of the rays that pass the first child, behind it, and one of those that pass the second, in
 * its own place. So lists lie one after the other on the way down, at most one for each split, and the arena has room
 * for all of them. A few rays go on singly. */
#ifndef CGT_BIH_STREAM_H
#define CGT_BIH_STREAM_H

#include "papers/kernel/bih/bih_rays.h"

/* Lists of at most as many rays are traced ray by ray. Measured. */
#define BIH_STREAM_FEW (CGT_LANES / 4)

/* Entries between a list and the next one: the list's end in whole vectors, and a vector that fills it up. */
#define BIH_STREAM_STEP(count) (((count) + CGT_LANES - 1) / CGT_LANES * CGT_LANES + CGT_LANES)
#define BIH_STREAM_ARENA ((CGT_BIH_MAX_DEPTH + 1) * BIH_STREAM_STEP(PACKET_MAX_RAYS))

typedef struct bih_list {
    uint32_t node;
    uint32_t at, count; /* in the arena; a multiple of CGT_LANES */
} bih_list;

/* In the task's scratch: 190 KB with 16 lanes. */
typedef struct bih_stream {
    /* of the packet's rays, see tree_rays */
    _Alignas(64) float rdir[3][PACKET_MAX_RAYS];
    _Alignas(64) float first[3][PACKET_MAX_RAYS];
    _Alignas(64) float last[3][PACKET_MAX_RAYS];
    _Alignas(64) float near[PACKET_MAX_RAYS];
    _Alignas(64) float far[PACKET_MAX_RAYS];
    uint8_t octant[PACKET_MAX_RAYS];
    uint32_t reverse; /* the octant that is being traced: axes along which its rays start above, as bits */
    bih_list stack[CGT_BIH_MAX_DEPTH];
    /* lists: rays of the packet, and their intervals */
    _Alignas(64) uint32_t ray[BIH_STREAM_ARENA];
    _Alignas(64) float enter[BIH_STREAM_ARENA];
    _Alignas(64) float leave[BIH_STREAM_ARENA];
} bih_stream;

enum { BIH_NO_STREAM = 8, BIH_SINGLE = 9 }; /* octants of rays that miss the tree, or are not for streams */

/* Where the first child's rays enter and leave planes, by the octant. */
CGT_SPU_INLINE vfloat bih_stream_plane(const float from[3][PACKET_MAX_RAYS], const bih_stream *s, uint32_t axis,
                                       float plane, vint ray)
{
    return spu_madd(spux_vfloat(plane), spux_gather(s->rdir[axis], ray), spux_gather(from[axis], ray));
}

/* Appends the chosen rays of a vector to a list that ends at `to`; returns its new end. Stores whole vectors. */
CGT_SPU_INLINE uint32_t bih_stream_append(bih_stream *s, uint32_t to, vuint ray, bih_part part, vmask chosen)
{
    spux_store_unaligned_uint(s->ray + to, spux_compress(ray, chosen));
    spux_store_unaligned(s->enter + to, spux_compress(part.near, chosen));
    spux_store_unaligned(s->leave + to, spux_compress(part.far, chosen));
    return to + (uint32_t)spux_count_bits(spux_mask_bits(chosen));
}

/* Fills a list's last vector up with ray 0, which gathers may load. Returns the list's rays. */
CGT_SPU_INLINE uint32_t bih_stream_end_list(bih_stream *s, uint32_t at, uint32_t to)
{
    spux_store_unaligned_uint(s->ray + to, spux_vuint(0));
    return to - at;
}

/* Splits a list at a node into those of the first child, at `to`, and of the second one, in place. */
CGT_SPU_INLINE void bih_stream_split(bih_stream *s, const cgt_bih_node *n, const bih_list *q, uint32_t to,
                                     uint32_t count[2])
{
    const uint32_t axis = cgt_bih_axis(n), first = s->reverse >> axis & 1;
    const float leave = cgt_bih_plane(n, first), enter = cgt_bih_plane(n, !first);
    uint32_t end[2] = {to, q->at};
    for (uint32_t k = 0; k < q->count; k += CGT_LANES) {
        const vmask rays = spux_mask_first(q->count - k);
        const vuint ray = spux_load_uint(s->ray + q->at + k);
        const bih_part whole = {spux_load(s->enter + q->at + k), spux_load(s->leave + q->at + k)};
        bih_part part[2] = {whole, whole};
        part[0].far = spux_min(bih_stream_plane(s->last, s, axis, leave, (vint)ray), whole.far);
        part[1].near = spux_max(bih_stream_plane(s->first, s, axis, enter, (vint)ray), whole.near);
        for (int c = 0; c < 2; c++)
            end[c] = bih_stream_append(s, end[c], ray, part[c], spu_and(rays, spux_cmpge(part[c].far, part[c].near)));
    }
    count[0] = bih_stream_end_list(s, to, end[0]);
    count[1] = bih_stream_end_list(s, q->at, end[1]);
}

/* Narrows a list's rays to a clip node's child, in place. Returns how many are left. */
CGT_SPU_INLINE uint32_t bih_stream_clip(bih_stream *s, const cgt_bih_node *n, const bih_list *q)
{
    const uint32_t axis = cgt_bih_axis(n), first = s->reverse >> axis & 1;
    const float enter = cgt_bih_plane(n, first), leave = cgt_bih_plane(n, !first);
    uint32_t end = q->at;
    for (uint32_t k = 0; k < q->count; k += CGT_LANES) {
        const vmask rays = spux_mask_first(q->count - k);
        const vuint ray = spux_load_uint(s->ray + q->at + k);
        bih_part part;
        part.near = spux_max(bih_stream_plane(s->first, s, axis, enter, (vint)ray), spux_load(s->enter + q->at + k));
        part.far = spux_min(bih_stream_plane(s->last, s, axis, leave, (vint)ray), spux_load(s->leave + q->at + k));
        end = bih_stream_append(s, end, ray, part, spu_and(rays, spux_cmpge(part.far, part.near)));
    }
    return bih_stream_end_list(s, q->at, end);
}

/* Drops the rays of a list that have found a nearer hit meanwhile, or are closed, in place. Returns how many are left. */
CGT_SPU_INLINE uint32_t bih_stream_refresh(bih_stream *s, const packet *p, const bih_list *q)
{
    uint32_t end = q->at;
    for (uint32_t k = 0; k < q->count; k += CGT_LANES) {
        const vmask rays = spux_mask_first(q->count - k);
        const vuint ray = spux_load_uint(s->ray + q->at + k);
        bih_part part;
        part.near = spux_load(s->enter + q->at + k);
        part.far = spux_min(spux_load(s->leave + q->at + k), spux_gather(p->high, (vint)ray));
        end = bih_stream_append(s, end, ray, part, spu_and(rays, spux_cmpge(part.far, part.near)));
    }
    return bih_stream_end_list(s, q->at, end);
}

/* ---- leaves ---- */

/* Keeps what the chosen lanes found out about a primitive; as leaf_update_vector. */
CGT_SPU_INLINE void bih_stream_update(leaf_tests *l, uint32_t prim, const uint32_t *ray, vmask rays, const lane_hits *q)
{
    packet *p = l->p;
    const vint index = (vint)spux_load_uint(ray);
    const vfloat low = spux_gather(p->low, index), high = spux_gather(p->high, index);
    const vmask same = spu_cmpeq(spux_gather_uint(p->prim, index), spux_vuint(prim));
    vmask nearer = spu_and(spu_and(rays, q->certain_hit), spu_cmpgt(low, q->high));
    vmask decided = spu_or(spu_or(nearer, spu_cmpgt(q->low, high)), same);
    if (p->skips_prims) {
        const uint32_t mask = skip_mask_of(l->prims, p, prim);
        unsigned skipping = 0;
        for (uint32_t k = 0; k < CGT_LANES; k++)
            skipping |= (unsigned)ray_skips(p, ray[k], prim, mask) << k;
        nearer = spu_andc(nearer, spux_mask_from_bits(skipping));
        decided = spu_or(decided, spux_mask_from_bits(skipping));
    }
    _Alignas(CGT_VECTOR_BYTES) float t[2][CGT_LANES];
    spux_store(t[0], p->any_hit ? spux_vfloat(-INFINITY) : q->low);
    spux_store(t[1], p->any_hit ? spux_vfloat(-INFINITY) : q->high);
    for (unsigned remaining = spux_mask_bits(nearer); remaining; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        p->low[ray[k]] = t[0][k];
        p->high[ray[k]] = t[1][k];
        p->prim[ray[k]] = prim;
    }
    const vmask unclear = spu_andc(spu_or(q->certain_hit, q->undecided), decided);
    for (unsigned remaining = spux_mask_bits(spu_and(rays, unclear)); remaining; remaining &= remaining - 1)
        filter_decide(l->prims, p, ray[(uint32_t)__builtin_ctz(remaining)], prim, l->counts);
}

CGT_SPU_INLINE void bih_stream_leaf(leaf_tests *l, const bih_stream *s, const bih_list *q, const uint32_t *reference,
                                    uint32_t count)
{
    l->counts->leaves++;
    l->counts->references += count;
    leaf_prefetch(l, reference, count);
    for (uint32_t k = 0; k < q->count; k += CGT_LANES) {
        const uint32_t *ray = s->ray + q->at + k;
        lane_rays r;
        lane_rays_of_list(l->p, ray, l->scale, &r);
        l->counts->packet_tests += count;
        l->counts->ray_tests += (uint64_t)count * CGT_LANES;
        for (uint32_t j = 0; j < count; j++) {
            lane_hits hits;
            if (leaf_test_lanes(l, &r, reference[j], &hits))
                bih_stream_update(l, reference[j], ray, spux_mask_first(q->count - k), &hits);
        }
    }
}

/* ---- the tree ---- */

/* Traces a list of rays singly through the subtree of a node. */
static void bih_traverse_subtree(const cgt_bih *tree, leaf_tests *l, uint32_t i, uint32_t node, float near, float far);

CGT_SPU_INLINE void bih_stream_few(const cgt_bih *tree, leaf_tests *l, const bih_stream *s, const bih_list *q)
{
    for (uint32_t k = 0; k < q->count; k++)
        bih_traverse_subtree(tree, l, s->ray[q->at + k], q->node, s->enter[q->at + k], s->leave[q->at + k]);
}

/* Traces the arena's first list, of the current octant. */
static void bih_stream_trace(const cgt_bih *tree, leaf_tests *l, bih_stream *s, uint32_t rays)
{
    bih_list q = {.node = 0, .at = 0, .count = rays};
    uint32_t top = 0;
    l->counts->packets++;
    for (;;) {
        const cgt_bih_node *n = &tree->node[q.node];
        if (q.count <= BIH_STREAM_FEW) {
            bih_stream_few(tree, l, s, &q);
        } else if (cgt_bih_is_leaf(n)) {
            bih_stream_leaf(l, s, &q, cgt_bih_references(tree, n), cgt_bih_count(n));
        } else if (cgt_bih_is_clip(n)) {
            l->counts->nodes++;
            q.count = bih_stream_clip(s, n, &q);
            q.node = n->word[3];
            if (q.count)
                continue;
        } else {
            const uint32_t to = q.at + BIH_STREAM_STEP(q.count), first = s->reverse >> cgt_bih_axis(n) & 1;
            uint32_t count[2];
            l->counts->nodes++;
            bih_stream_split(s, n, &q, to, count);
            if (count[1])
                s->stack[top++] = (bih_list){n->word[3] + !first, q.at, count[1]};
            if (count[0]) {
                q = (bih_list){n->word[3] + first, to, count[0]};
                continue;
            }
        }
        do {
            if (!top)
                return;
            q = s->stack[--top];
            q.count = bih_stream_refresh(s, l->p, &q);
        } while (!q.count);
    }
}

/* Where the rays of a vector of the packet enter the tree, and in which octant they run. */
static void bih_stream_enter(const cgt_bih *tree, const packet *p, bih_stream *s, uint32_t i)
{
    tree_rays r;
    bih_part part;
    vmask flat = spux_mask_none();
    ray_box_enter(p, i, tree->low, tree->high, BIH_RANGE_ERROR, &part.near, &part.far);
    const unsigned entering = spux_mask_bits(spux_cmpge(part.far, part.near));
    bih_rays_init(p, i, &r);
    spux_store(s->near + i, part.near);
    spux_store(s->far + i, part.far);
    for (int a = 0; a < 3; a++) {
        spux_store(s->rdir[a] + i, r.rdir[a]);
        spux_store(s->first[a] + i, r.first[a]);
        spux_store(s->last[a] + i, r.last[a]);
        flat = spu_or(flat, r.flat[a]);
    }
    const unsigned single = spux_mask_bits(flat);
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        const int octant = (p->dir[0][i + k] < 0) | (p->dir[1][i + k] < 0) << 1 | (p->dir[2][i + k] < 0) << 2;
        s->octant[i + k] = (uint8_t)(!(entering >> k & 1) ? BIH_NO_STREAM : single >> k & 1 ? BIH_SINGLE : octant);
    }
}

/* Lists the packet's rays of an octant. Returns how many there are. */
static uint32_t bih_stream_list(bih_stream *s, uint32_t lanes, uint32_t octant)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < lanes; i++) {
        if (s->octant[i] != octant)
            continue;
        s->ray[count] = i;
        s->enter[count] = s->near[i];
        s->leave[count++] = s->far[i];
    }
    return bih_stream_end_list(s, 0, count);
}

static void bih_traverse_stream(const cgt_bih *tree, leaf_tests *l)
{
    bih_stream *s = cgt_scratch_take(l->counts->scratch, sizeof *s);
    for (uint32_t i = 0; i < l->p->lanes; i += CGT_LANES)
        bih_stream_enter(tree, l->p, s, i);
    for (uint32_t octant = 0; octant < 8; octant++) {
        const uint32_t rays = bih_stream_list(s, l->p->lanes, octant);
        s->reverse = octant;
        if (rays)
            bih_stream_trace(tree, l, s, rays);
    }
    const bih_list flat = {.node = 0, .at = 0, .count = bih_stream_list(s, l->p->lanes, BIH_SINGLE)};
    bih_stream_few(tree, l, s, &flat);
    cgt_scratch_return(l->counts->scratch, s);
}

#endif
