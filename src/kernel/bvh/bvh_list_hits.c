/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The first hits of one ray (query/hit_list.h) through the BVH, as bvh_single.h finds the nearest one: the last hit of
 * a full list ends the ray. What tests find for certain, in the range and after `after`, is listed by its interval; what
 * they leave open is decided. */
#include "kernel/bvh/bvh_single.h"
#include "query/hit_list.h"

typedef struct list_query {
    const bvh_call *call;
    cgt_hit_list *list;
    bvh_ray ray; /* `near` and `far` as the list allows */
    bvh_leaf_ray leaf;
    float first, last; /* hits whose intervals are between them are certainly in the range and after `after` */
} list_query;

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
        if (low[k] > q->ray.far || (q->call->skips_prims && bvh_ray_skips(q->call, 0, prim[k])))
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
    const vfloat scale = spux_vfloat(q->call->scale), near = spux_vfloat(q->ray.near);
    lane_chords chord;
    vfloat center[3];
    for (int a = 0; a < 3; a++)
        center[a] = spu_mul(spux_load(b->center[a]), scale);
    if (!lane_pass_sphere(&q->leaf.ray, center, spu_mul(spux_load(b->radius), scale), true, &chord))
        return;
    const vmask possible = spux_not(spu_or(chord.missed, spu_cmpgt(near, chord.far)));
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
    for (int a = 0; a < 3; a++) {
        t.vertex[a] = spux_load(b->vertex[a]);
        t.edge[0][a] = spux_load(b->edge[0][a]);
        t.edge[1][a] = spux_load(b->edge[1][a]);
    }
    t.sum[0] = spux_load(b->sum[0]);
    t.sum[1] = spux_load(b->sum[1]);
    if (!lane_test_triangle_from(&q->leaf.ray, &t, true, &h))
        return;
    const list_roots met = {h.low, h.high, spu_or(h.certain_hit, h.undecided), h.certain_hit};
    list_take(q, &met, b->prim, used_lanes, CGT_NEAR_SIDE);
}

static void list_leaf(list_query *q, uint32_t code)
{
    const cgt_bvh *tree = q->call->tree;
    const uint32_t count = bvh_leaf_count(code), index = code & CGT_BVH_INDEX_MASK;
    const unsigned used_lanes = CGT_ALL_LANES >> (CGT_LANES - count);
    q->call->counts->leaves++;
    q->call->counts->packet_tests += count;
    q->call->counts->ray_tests += CGT_LANES;
    if (code & CGT_BVH_TRIANGLE_LEAF)
        list_triangles(q, (const triangle_block *)tree->triangle + index, used_lanes);
    else
        list_spheres(q, (const sphere_block *)tree->sphere + index, used_lanes);
}

/* The stack takes 8 KB. */
__attribute__((noinline)) static void list_traverse(list_query *q)
{
    const bvh_node *node = q->call->tree->node;
    bvh_stack s;
    bvh_slabs slabs;
    uint32_t code = 0;
    bvh_slabs_init(&q->ray, &slabs);
    s.top = 0;
    while (code != CGT_BVH_NO_CHILD) {
        if (code & CGT_BVH_LEAF) {
            list_leaf(q, code);
            code = CGT_BVH_NO_CHILD;
        } else {
            q->call->counts->nodes++;
            code = bvh_single_step(&q->ray, &slabs, node + code, &s, false);
        }
        if (code == CGT_BVH_NO_CHILD)
            code = bvh_single_pop(&s, q->ray.far, false);
    }
}

/* Normalises the ray, so that T is its T. */
static void list_begin(list_query *q)
{
    const cgt_ray *ray = q->list->ray;
    float longest = 0;
    int exponent;
    for (int a = 0; a < 3; a++)
        longest = fabsf(ray->line.dir[a]) > longest ? fabsf(ray->line.dir[a]) : longest;
    frexpf(longest, &exponent); /* 2^exponent is twice 2^k */
    cgt_hit_list_set_units(q->list, ldexp((double)q->call->scale, exponent - 1), 0);
    bvh_ray_normalise(q->call, ray, 0, &q->ray);
    q->first = q->ray.near + fabsf(q->ray.near) * 0x1p-18f + q->call->range_error[0];
    q->last = q->ray.best.low;
    if (q->list->has_after) {
        const cgt_listed_hit *after = &q->list->after;
        q->first = after->high > q->first ? after->high : q->first;
        q->ray.near = after->low > q->ray.near ? after->low : q->ray.near;
    }
    bvh_leaf_ray_init(q->call, &q->ray, &q->leaf);
}

void CGT_KERNEL(cgt_list_hits)(const cgt_committed_scene *committed_scene, bool use_bvh, uint32_t skip_prim,
                               uint32_t mask, cgt_hit_list *list, cgt_counts *counts)
{
    bvh_call c;
    ray_limits limits = RAY_NO_LIMITS;
    if (!committed_scene->valid)
        return;
    if (use_bvh) { /* else another thread may be building it */
        bvh_call_init(committed_scene, counts, &c);
        limits = bvh_ray_limits(c.scale);
    }
    counts->bvh_rays += use_bvh;
    if (!use_bvh || committed_scene->brute_force || ray_classify(list->ray, &limits) == RAY_UNUSUAL) {
        CGT_KERNEL(cgt_list_unusual)(committed_scene, use_bvh, skip_prim, mask, list, counts);
        return;
    }
    c.ray = list->ray;
    c.skip_prim = skip_prim == CGT_INVALID_ID ? NULL : &skip_prim;
    c.mask = committed_scene->has_masks && mask != UINT32_MAX ? &mask : NULL;
    c.skips_prims = c.skip_prim || c.mask;
    list_query q = {.call = &c, .list = list};
    list_begin(&q);
    if (q.ray.near <= q.ray.far)
        list_traverse(&q);
}
