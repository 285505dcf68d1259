/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The first hits of one ray (query/hit_list.h) through the BVH, as bvh_single.h finds the nearest one: the last hit of
 * a full list ends the ray. What tests find for certain, in the range and after `after`, is listed by its interval;
 * what they leave open is decided.
 *
 * Neighbours go in streams (kernel/stream/stream_lists.h). Of others each alone would wait for memory half of its time:
 * some take turns, a node or a leaf each, and each prefetches what it needs at its next turn. */
#include "kernel/bvh/bvh_list.h"

#define LIST_RAYS 4u         /* that take turns: enough to hide memory, few enough for the buffers of its lines */
#define LIST_STREAM_RAYS 32u /* fewer are no stream */

/* The roots of one side of a leaf's primitives, in the lanes of `possible`; those of `certain` are in [low, high]. */
typedef struct list_roots {
    vfloat low, high;
    vmask possible, certain;
} list_roots;

/* Lists roots, or decides them. */
static void list_take(list_query *q, const list_roots *r, const uint32_t *prim, unsigned used_lanes, unsigned side)
{
    const vmask past = spu_cmpgt(r->low, spux_vfloat(q->ray.far));
    const vmask in_range = spu_and(spu_cmpgt(r->low, spux_vfloat(q->first)), spu_cmpgt(spux_vfloat(q->last), r->high));
    const unsigned certain = spux_mask_bits(spu_and(r->certain, in_range));
    unsigned remaining = spux_mask_bits(spu_andc(r->possible, past)) & used_lanes;
    _Alignas(CGT_VECTOR_BYTES) float low[CGT_LANES], high[CGT_LANES];
    if (!remaining)
        return;
    spux_store(low, r->low);
    spux_store(high, r->high);
    for (; remaining; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        if (low[k] > q->ray.far || (q->call->skips_prims && cgt_hit_list_skips(q->list, prim[k])))
            continue;
        if (certain >> k & 1) {
            cgt_listed_hit h = {.low = low[k], .high = high[k], .prim = prim[k], .far = side == CGT_FAR_SIDE};
            cgt_hit_list_insert(q->list, &h);
        } else
            cgt_hit_list_decide(q->list, prim[k], side);
        q->ray.far = cgt_hit_list_end(q->list, q->ray.far);
    }
}

static void list_spheres(list_query *q, const sphere_block *b, unsigned used_lanes)
{
    const vfloat near = spux_vfloat(q->ray.near), radius = spu_mul(spux_load(b->radius), spux_vfloat(q->call->scale));
    lane_chords chord;
    vfloat center[3];
    bvh_load_centers(q->call, b, center);
    if (!lane_pass_sphere(&q->leaf.ray, center, radius, true, &chord))
        return;
    const vmask possible = spux_not(spu_or(chord.missed, spu_cmpgt(near, chord.far)));
    if (q->list->kind == CGT_LIST_CONTAINERS) {
        const list_roots around = {chord.near, chord.far, possible, spux_mask_none()};
        list_take(q, &around, b->prim, used_lanes, CGT_BOTH_SIDES);
        return;
    }
    const vfloat near_end = spu_add(chord.near, chord.width), far_begin = spu_sub(chord.far, chord.width);
    /* a line that may touch is decided once, for both sides */
    const list_roots touched = {chord.near, chord.far, spu_andc(possible, chord.inside), spux_mask_none()};
    const vmask inside = spu_and(possible, chord.inside);
    const list_roots entered = {chord.near, near_end, spu_andc(inside, spu_cmpgt(near, near_end)), chord.inside},
                     left = {far_begin, chord.far, inside, chord.inside};
    list_take(q, &touched, b->prim, used_lanes, CGT_BOTH_SIDES);
    list_take(q, &entered, b->prim, used_lanes, CGT_NEAR_SIDE);
    list_take(q, &left, b->prim, used_lanes, CGT_FAR_SIDE);
}

static void list_triangles(list_query *q, const triangle_block *b, unsigned used_lanes)
{
    lane_hits h;
    lane_triangles t;
    bvh_load_triangles(b, &t);
    if (!lane_test_triangle_from(&q->leaf.ray, &t, true, &h))
        return;
    const list_roots met = {h.low, h.high, spu_or(h.certain_hit, h.undecided), h.certain_hit};
    list_take(q, &met, b->prim, used_lanes, CGT_NEAR_SIDE);
}

static void list_capsules(list_query *q, const capsule_block *b, unsigned used_lanes)
{
    const lane_rays *const ray = &q->leaf.ray;
    const vfloat radius = spux_load(b->radius);
    vfloat end[2][3];
    lane_hits h;
    list_roots left;
    bvh_load_capsules(b, end);
    if (!lane_test_capsule_from(ray, end[0], end[1], radius, true, &h))
        return;
    left.low = left.high = spux_vfloat(0);
    left.possible = left.certain =
        lane_leave_capsule(ray, end[0], end[1], radius, h.certain_hit, &left.low, &left.high);
    /* what is not certain of both sides is decided once */
    const vmask possible = spu_or(h.certain_hit, h.undecided);
    const list_roots touched = {h.low, spux_vfloat(INFINITY), spu_andc(possible, left.certain), spux_mask_none()},
                     entered = {h.low, h.high, left.certain, left.certain};
    list_take(q, &touched, b->prim, used_lanes, CGT_BOTH_SIDES);
    list_take(q, &entered, b->prim, used_lanes, CGT_NEAR_SIDE);
    list_take(q, &left, b->prim, used_lanes, CGT_FAR_SIDE);
}

static void list_leaf(list_query *q, uint32_t code)
{
    const cgt_bvh *tree = q->call->tree;
    const cgt_bvh_leaf leaf = cgt_bvh_find_leaf(tree, code);
    const uint32_t count = bvh_leaf_count(code);
    const unsigned used_lanes = CGT_ALL_LANES >> (CGT_LANES - count);
    q->call->counts->leaves++;
    q->call->counts->packet_tests += count;
    q->call->counts->ray_tests += CGT_LANES;
    if (leaf.kind == CGT_KIND_SPHERES ? q->list->without_spheres : q->list->kind == CGT_LIST_CONTAINERS)
        return;
    if (leaf.kind == CGT_KIND_SPHERES)
        list_spheres(q, (const sphere_block *)tree->sphere + leaf.block, used_lanes);
    else if (leaf.kind == CGT_KIND_TRIANGLES)
        list_triangles(q, (const triangle_block *)tree->triangle + leaf.block, used_lanes);
    else
        list_capsules(q, (const capsule_block *)tree->capsule + leaf.block, used_lanes);
}

/* Fetches the lines that the next step reads. */
static void list_prefetch(const list_query *q)
{
    static const size_t block_bytes[CGT_KINDS] = {sizeof(sphere_block), sizeof(triangle_block), sizeof(capsule_block)};
    const cgt_bvh *tree = q->call->tree;
    const char *const blocks[CGT_KINDS] = {tree->sphere, tree->triangle, tree->capsule};
    const char *from = (const char *)tree->node;
    size_t bytes = sizeof(bvh_node);
    if (!(q->code & CGT_BVH_LEAF)) {
        from += q->code * bytes;
    } else {
        const cgt_bvh_leaf leaf = cgt_bvh_find_leaf(tree, q->code);
        bytes = block_bytes[leaf.kind];
        from = blocks[leaf.kind] + leaf.block * bytes;
    }
    for (size_t i = 0; i < bytes; i += 64)
        __builtin_prefetch(from + i);
}

/* One turn of a ray. */
static void list_step(list_query *q)
{
    uint32_t code = q->code;
    if (code & CGT_BVH_LEAF) {
        list_leaf(q, code);
        code = CGT_BVH_NO_CHILD;
    } else {
        q->call->counts->nodes++;
        code = bvh_single_step(q->call, &q->ray, &q->slabs, (const bvh_node *)q->call->tree->node + code, &q->stack,
                               false);
    }
    q->code = code == CGT_BVH_NO_CHILD ? bvh_single_pop(&q->stack, q->ray.far, false) : code;
}

void CGT_KERNEL(cgt_list_finish)(list_query *q)
{
    while (q->code != CGT_BVH_NO_CHILD)
        list_step(q);
}

/* Normalises the ray, so that T is its T. */
static void list_begin(list_query *q)
{
    list_set_units(q->list, q->call->scale);
    bvh_ray_normalise(q->call, q->list->ray, 0, &q->ray);
    list_start(q, 0);
}

/* The lists of a call. */
typedef struct list_call {
    bvh_call bvh;
    ray_limits limits;
    cgt_hit_list *const *list;
    uint32_t count, next; /* the first that has not begun */
} list_call;

/* Begins the next ray that goes through the tree. False: there is none. */
static bool list_next(list_call *c, list_query *q)
{
    while (c->next < c->count) {
        cgt_hit_list *list = c->list[c->next++];
        if (ray_classify(list->ray, &c->limits) == RAY_UNUSUAL) {
            CGT_KERNEL(cgt_list_unusual)(c->bvh.committed_scene, true, list, 1, c->bvh.counts);
            continue;
        }
        q->call = &c->bvh;
        q->list = list;
        list_begin(q);
        if (q->code != CGT_BVH_NO_CHILD)
            return true;
    }
    return false;
}

void CGT_KERNEL(cgt_list_turns)(const cgt_committed_scene *committed_scene, cgt_hit_list *const *lists, uint32_t count,
                                cgt_counts *counts)
{
    list_call c = {.list = lists, .count = count};
    list_query *turn[LIST_RAYS];
    uint32_t rays = 0;
    bvh_call_init(committed_scene, counts, &c.bvh);
    c.bvh.skips_prims = true;
    c.limits = bvh_ray_limits(c.bvh.scale);
    list_query *q = cgt_scratch_take(counts->scratch, LIST_RAYS * sizeof *q);
    while (rays < LIST_RAYS && list_next(&c, &q[rays])) {
        turn[rays] = &q[rays];
        rays++;
    }
    while (rays)
        for (uint32_t k = 0; k < rays;) {
            list_step(turn[k]);
            if (turn[k]->code != CGT_BVH_NO_CHILD || list_next(&c, turn[k]))
                list_prefetch(turn[k++]);
            else
                turn[k] = turn[--rays];
        }
    cgt_scratch_return(counts->scratch, q);
}

/* Streams are for hits from a ray's begin on. */
void CGT_KERNEL(cgt_list_hits)(const cgt_committed_scene *committed_scene, bool use_bvh, cgt_hit_list *lists,
                               uint32_t count, cgt_counts *counts)
{
    if (!committed_scene->valid)
        return;
    if (!use_bvh || committed_scene->brute_force) { /* another thread may be building the tree */
        CGT_KERNEL(cgt_list_unusual)(committed_scene, use_bvh, lists, count, counts);
        return;
    }
    cgt_hit_list **to =
        cgt_scratch_take(counts->scratch, (count < LIST_CHUNK ? count : LIST_CHUNK) * sizeof(cgt_hit_list *));
    for (uint32_t i = 0; i < count;) {
        const uint32_t room = count - i < LIST_CHUNK ? count - i : LIST_CHUNK;
        uint32_t fresh = 0, others = room;
        for (; fresh < others; i++)
            if (lists[i].has_after || lists[i].kind == CGT_LIST_CONTAINERS)
                to[--others] = &lists[i];
            else
                to[fresh++] = &lists[i];
        if (fresh >= LIST_STREAM_RAYS)
            CGT_KERNEL(cgt_list_streams)(committed_scene, to, fresh, counts);
        else
            CGT_KERNEL(cgt_list_turns)(committed_scene, to, fresh, counts);
        CGT_KERNEL(cgt_list_turns)(committed_scene, to + others, room - others, counts);
    }
    cgt_scratch_return(counts->scratch, to);
}
