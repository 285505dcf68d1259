/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray through the BVH: lanes are the children of a node, or the primitives of a leaf. */
#ifndef CGT_BVH_SINGLE_H
#define CGT_BVH_SINGLE_H

#include "kernel/bvh/bvh_turned.h"
#include "kernel/primitive/decide_lanes.h"
#include "kernel/primitive/lane_capsules.h"

/* A normalised ray. Planes are unscaled, as in the tree: rdir is times the scene's scale. */
typedef struct bvh_ray {
    float org[3], dir[3];
    float rdir[3], first[3], last[3]; /* t = plane rdir + first or last */
    float near, far;                  /* far: of best.high too */
    uint32_t octant;
    uint32_t still;  /* axes along which it does not move, as bits */
    uint32_t number; /* of the call */
    best_hit best;
} bvh_ray;

/* Sets the fields that slabs need besides origin and direction. */
CGT_SPU_INLINE void bvh_ray_set_slabs(const bvh_call *c, const float rdir[3], const float slab_error[3], bvh_ray *r)
{
    r->octant = 0;
    for (int a = 0; a < 3; a++) {
        const float shift = r->org[a] * rdir[a], t_error = slab_error[a] * fabsf(rdir[a]);
        r->rdir[a] = rdir[a] * c->scale;
        r->first[a] = -shift - t_error;
        r->last[a] = t_error - shift;
        r->octant |= (uint32_t)(rdir[a] < 0) << a;
    }
}

/* Sets ray `number` of the call, a plain one. */
CGT_SPU_INLINE void bvh_ray_normalise(const bvh_call *c, const cgt_ray *ray, uint32_t number, bvh_ray *r)
{
    float longest = 0, org[3], slab_error[3], rdir[3];
    uint32_t bits, inverse_bits;
    float power, inverse; /* 2^k and 2^-k */
    for (int a = 0; a < 3; a++)
        longest = fabsf(ray->line.dir[a]) > longest ? fabsf(ray->line.dir[a]) : longest;
    memcpy(&bits, &longest, sizeof bits);
    bits &= 0x7f800000; /* of a normal number: others are unusual */
    inverse_bits = 0x7f000000 - bits;
    memcpy(&power, &bits, sizeof power);
    memcpy(&inverse, &inverse_bits, sizeof inverse);
    const float speed = power * c->scale;
    r->still = 0;
    for (int a = 0; a < 3; a++) {
        r->org[a] = ray->line.org[a] * c->scale;
        r->dir[a] = ray->line.dir[a] * inverse;
        org[a] = fabsf(r->org[a]);
        rdir[a] = 1 / (fabsf(r->dir[a]) < BVH_MIN_DIR ? copysignf(BVH_MIN_DIR, r->dir[a]) : r->dir[a]);
        r->still |= (uint32_t)(ray->line.dir[a] == 0) << a;
    }
    r->near = (ray->t_min - fabsf(ray->t_min) * 0x1p-20f) * speed - 0x1p-86f;
    r->far = (ray->t_max + fabsf(ray->t_max) * 0x1p-20f) * speed + 0x1p-86f;
    r->near = r->near > -BVH_MAX_T ? r->near : -BVH_MAX_T;
    r->far = r->far < BVH_MAX_T ? r->far : BVH_MAX_T;
    r->number = number;
    r->best = (best_hit){r->far - fabsf(r->far) * 0x1p-18f - 0x1p-84f, r->far, CGT_INVALID_ID, 0};
    bvh_slab_error(c, org, slab_error);
    bvh_ray_set_slabs(c, rdir, slab_error, r);
}

/* ---- a leaf ---- */

typedef struct bvh_leaf_ray {
    lane_rays ray;   /* the same in every lane; t_min is `near` */
    vfloat t_inside; /* t beyond is certainly in the range */
} bvh_leaf_ray;

CGT_SPU_INLINE void bvh_leaf_ray_init(const bvh_call *c, const bvh_ray *r, bvh_leaf_ray *l)
{
    for (int a = 0; a < 3; a++) {
        l->ray.org[a] = spux_vfloat(r->org[a]);
        l->ray.dir[a] = spux_vfloat(r->dir[a]);
    }
    l->ray.rdd = spux_vfloat(1);
    if (c->tree->sphere_blocks | c->tree->capsule_blocks) {
        const float x = r->dir[0] * r->dir[0] + r->dir[1] * r->dir[1] + r->dir[2] * r->dir[2];
        l->ray.rdd = spux_vfloat(1 / x);
    }
    /* |d| is from 1 to 2 sqrt(3), its largest component below 2: bounds of all directions will do */
    l->ray.rlength = spux_vfloat(1);
    l->ray.max_dir = spux_vfloat(2);
    l->ray.underflow = spux_vfloat(0x1.8p-117f);
    for (int a = 0; a < 3; a++)
        l->ray.scaled_org[a] = l->ray.org[a];
    l->ray.unscale = spux_vfloat(1);
    l->ray.t_min = spux_vfloat(r->near);
    l->ray.org_error = spux_vfloat(c->org_error);
    l->t_inside = spux_vfloat(r->near + fabsf(r->near) * 0x1p-18f + c->range_error[0]);
}

/* Decides several primitives at once. Returns those that are left to decide. */
__attribute__((noinline, cold, unused)) static unsigned
bvh_single_decide(const bvh_call *c, const bvh_ray *r, const float low[CGT_LANES], const uint32_t *prim, unsigned lanes)
{
    const cgt_ray ray = bvh_input_ray(c, r->number);
    for (unsigned remaining = lanes; remaining; remaining &= remaining - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(remaining);
        if (low[k] > r->best.high || (c->skips_prims && bvh_ray_skips(c, r->number, prim[k])))
            lanes &= ~(1u << k);
    }
    return CGT_KERNEL(cgt_decide_ray)(&c->committed_scene->prims, &ray, r->best.prim, c->any_hit, prim, lanes,
                                      c->counts);
}

/* Updates the ray's best hit by what the test found about the lanes' primitives. */
CGT_SPU_INLINE void bvh_single_update(const bvh_call *c, bvh_ray *r, const bvh_leaf_ray *l, const lane_hits *q,
                                      const uint32_t *prim, unsigned used_lanes, bool any_hit)
{
    const vmask in_range = spu_and(q->certain_hit, spu_cmpgt(q->low, l->t_inside));
    const vmask possible = spu_andc(spu_or(q->certain_hit, q->undecided), spu_cmpgt(q->low, spux_vfloat(r->best.high)));
    unsigned certain_hit = spux_mask_bits(spu_and(possible, in_range)) & used_lanes,
             undecided = spux_mask_bits(spu_andc(possible, in_range)) & used_lanes;
    if (!(certain_hit | undecided))
        return;
    _Alignas(CGT_VECTOR_BYTES) float low[CGT_LANES], high[CGT_LANES];
    spux_store(low, q->low);
    spux_store(high, q->high);
    for (; certain_hit; certain_hit &= certain_hit - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(certain_hit);
        if (c->skips_prims && bvh_ray_skips(c, r->number, prim[k]))
            continue;
        if (high[k] < r->best.low) {
            r->best.prim = prim[k];
            r->best.low = any_hit ? -INFINITY : low[k];
            r->best.high = any_hit ? -INFINITY : high[k];
        } else if (low[k] <= r->best.high)
            undecided |= 1u << k;
    }
    if (__builtin_expect(spux_count_bits(undecided) >= DECIDE_MIN_LANES, 0))
        undecided = bvh_single_decide(c, r, low, prim, undecided);
    for (; undecided; undecided &= undecided - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(undecided);
        if (low[k] > r->best.high || (c->skips_prims && bvh_ray_skips(c, r->number, prim[k])))
            continue;
        bvh_decide(c, r->number, prim[k], &r->best);
    }
    r->far = r->best.high;
}

CGT_SPU_INLINE void bvh_load_centers(const bvh_call *c, const sphere_block *b, vfloat center[3])
{
    for (int a = 0; a < 3; a++)
        center[a] = spu_mul(spux_load(b->center[a]), spux_vfloat(c->scale));
}

CGT_SPU_INLINE void bvh_load_triangles(const triangle_block *b, lane_triangles *t)
{
    for (int a = 0; a < 3; a++) {
        t->vertex[a] = spux_load(b->vertex[a]);
        t->edge[0][a] = spux_load(b->edge[0][a]);
        t->edge[1][a] = spux_load(b->edge[1][a]);
    }
    t->sum[0] = spux_load(b->sum[0]);
    t->sum[1] = spux_load(b->sum[1]);
}

CGT_SPU_INLINE void bvh_single_spheres(const bvh_call *c, bvh_ray *r, const bvh_leaf_ray *l, const sphere_block *b,
                                       unsigned used_lanes, bool any_hit)
{
    const vfloat radius = spu_mul(spux_load(b->radius), spux_vfloat(c->scale));
    lane_hits q;
    vfloat center[3];
    bvh_load_centers(c, b, center);
    if (lane_test_sphere_from(&l->ray, center, radius, true, &q))
        bvh_single_update(c, r, l, &q, b->prim, used_lanes, any_hit);
}

CGT_SPU_INLINE void bvh_single_triangles(const bvh_call *c, bvh_ray *r, const bvh_leaf_ray *l, const triangle_block *b,
                                         unsigned used_lanes, bool any_hit)
{
    lane_hits q;
    lane_triangles t;
    bvh_load_triangles(b, &t);
    if (lane_test_triangle_from(&l->ray, &t, true, &q))
        bvh_single_update(c, r, l, &q, b->prim, used_lanes, any_hit);
}

CGT_SPU_INLINE void bvh_load_capsules(const capsule_block *b, vfloat end[2][3])
{
    for (int k = 0; k < 2; k++)
        for (int a = 0; a < 3; a++)
            end[k][a] = spux_load(b->end[k][a]);
}

/* Out of line: most scenes have no capsules. */
__attribute__((noinline, unused)) static void bvh_single_capsules(const bvh_call *c, bvh_ray *r, const bvh_leaf_ray *l,
                                                                  const capsule_block *b, unsigned used_lanes,
                                                                  bool any_hit)
{
    vfloat end[2][3];
    lane_hits q;
    bvh_load_capsules(b, end);
    if (lane_test_capsule_from(&l->ray, end[0], end[1], spux_load(b->radius), true, &q))
        bvh_single_update(c, r, l, &q, b->prim, used_lanes, any_hit);
}

CGT_SPU_INLINE void bvh_single_leaf(const bvh_call *c, bvh_ray *r, const bvh_leaf_ray *l, uint32_t code, bool any_hit)
{
    const uint32_t count = bvh_leaf_count(code);
    const cgt_bvh_leaf leaf = cgt_bvh_find_leaf(c->tree, code);
    const unsigned used_lanes = CGT_ALL_LANES >> (CGT_LANES - count);
    c->counts->leaves++;
    c->counts->packet_tests += count;
    c->counts->ray_tests += CGT_LANES;
    if (leaf.kind == CGT_KIND_SPHERES)
        bvh_single_spheres(c, r, l, (const sphere_block *)c->tree->sphere + leaf.block, used_lanes, any_hit);
    else if (leaf.kind == CGT_KIND_TRIANGLES)
        bvh_single_triangles(c, r, l, (const triangle_block *)c->tree->triangle + leaf.block, used_lanes, any_hit);
    else
        bvh_single_capsules(c, r, l, (const capsule_block *)c->tree->capsule + leaf.block, used_lanes, any_hit);
}

/* ---- a node ---- */

/* A node pushes all its children but the first; stores are of whole vectors. */
#define BVH_STACK_SIZE (CGT_BVH_MAX_DEPTH * (CGT_LANES - 1) + 1)

typedef struct bvh_stack {
    uint32_t code[BVH_STACK_SIZE];
    float near[BVH_STACK_SIZE]; /* where the ray enters; for closest hits only */
    uint32_t top;
} bvh_stack;

/* Returns the lanes of children, those to be visited last first. */
CGT_SPU_INLINE vuint bvh_push_order(const bvh_node *n, uint32_t octant)
{
    const bool reverse = octant > 3;
    const vuint order = spux_load_bytes(n->order[reverse ? 7 - octant : octant]);
    if (reverse)
        return order;
    return spux_permute(order, spu_sub(spux_vuint(n->children - 1), spux_lane_index()));
}

/* `leave`, so that the ray passes no children that it is parallel to. */
CGT_SPU_INLINE vfloat bvh_leave_parallel(const bvh_node *n, uint32_t still, vfloat leave)
{
    return spux_select(leave, spux_vfloat(-INFINITY), spux_mask_from_bits(bvh_parallel_children(n, still)));
}

/* Clips the ray's range to the children's boxes. near and far: the planes that the ray meets first and last along each
 * axis. */
CGT_SPU_INLINE void bvh_clip_to_boxes(const bvh_ray *r, const float *const near[3], const float *const far[3],
                                      vfloat *enter, vfloat *leave)
{
    *enter = spux_vfloat(r->near);
    *leave = spux_vfloat(r->far);
    for (int a = 0; a < 3; a++) {
        const vfloat rdir = spux_vfloat(r->rdir[a]);
        *enter = spux_max(spu_madd(spux_load(near[a]), rdir, spux_vfloat(r->first[a])), *enter);
        *leave = spux_min(spu_madd(spux_load(far[a]), rdir, spux_vfloat(r->last[a])), *leave);
    }
}

/* A ray's slabs in every lane, and where its planes are in a node. */
typedef struct bvh_slabs {
    vfloat rdir[3], first[3], last[3];
    uint32_t enter[3], leave[3]; /* bytes from a node to the planes that the ray meets first along an axis, and last */
} bvh_slabs;

CGT_SPU_INLINE void bvh_slabs_init(const bvh_ray *r, bvh_slabs *q)
{
    for (uint32_t a = 0; a < 3; a++) {
        const uint32_t low = offsetof(bvh_node, low) + a * CGT_VECTOR_BYTES;
        const uint32_t high = offsetof(bvh_node, high) + a * CGT_VECTOR_BYTES;
        const bool from_above = r->octant >> a & 1;
        q->enter[a] = from_above ? high : low;
        q->leave[a] = from_above ? low : high;
        q->rdir[a] = spux_vfloat(r->rdir[a]);
        q->first[a] = spux_vfloat(r->first[a]);
        q->last[a] = spux_vfloat(r->last[a]);
    }
}

/* The child at lane `lane` of bvh_push_order. */
CGT_SPU_INLINE uint32_t bvh_child_in_order(const bvh_node *n, uint32_t octant, uint32_t lane)
{
    return octant > 3 ? n->child[n->order[7 - octant][lane]] : n->child[n->order[octant][n->children - 1 - lane]];
}

/* Returns the child that the ray passes first, CGT_BVH_NO_CHILD for none, and pushes the others. The first one does not
 * take the way over the stack: reading back part of a vector that was just stored takes as long as half the step. */
CGT_SPU_INLINE uint32_t bvh_single_step(const bvh_call *c, const bvh_ray *r, const bvh_slabs *q, const bvh_node *n,
                                        bvh_stack *s, bool any_hit)
{
    vfloat enter = spux_vfloat(r->near), leave = spux_vfloat(r->far);
    for (int a = 0; a < 3; a++) {
        const float *near = (const float *)(const void *)((const char *)n + q->enter[a]);
        const float *far = (const float *)(const void *)((const char *)n + q->leave[a]);
        enter = spux_max(spu_madd(spux_load(near), q->rdir[a], q->first[a]), enter);
        leave = spux_min(spu_madd(spux_load(far), q->rdir[a], q->last[a]), leave);
    }
    if (__builtin_expect(r->still, 0))
        leave = bvh_leave_parallel(n, r->still, leave);
    if (__builtin_expect(n->flat[0] & BVH_TURNED, 0))
        bvh_clip_ray_to_turned(c, n, r->org, r->dir, &enter, &leave);
    const unsigned children = CGT_ALL_LANES >> (CGT_LANES - n->children);
    unsigned passed = spux_mask_bits(spux_cmpge(leave, enter)) & children;
    if (!(passed & (passed - 1)))
        return passed ? n->child[__builtin_ctz(passed)] : CGT_BVH_NO_CHILD;
    vuint code = spux_load_uint(n->child);
    uint32_t first;
    if (any_hit) {
        first = n->child[__builtin_ctz(passed)];
        passed &= passed - 1;
    } else {
        const vuint order = bvh_push_order(n, r->octant);
        enter = spux_permute(enter, order);
        code = spux_permute(code, order);
        passed = spux_mask_bits(spux_cmpge(spux_permute(leave, order), enter)) & children;
        const uint32_t lane = 31 - (uint32_t)__builtin_clz(passed);
        first = bvh_child_in_order(n, r->octant, lane);
        passed ^= 1u << lane;
    }
    const vmask others = spux_mask_from_bits(passed);
    spux_store_unaligned_uint(s->code + s->top, spux_compress(code, others));
    if (!any_hit)
        spux_store_unaligned(s->near + s->top, spux_compress(enter, others));
    s->top += spux_count_bits(passed);
    return first;
}

/* Pops the next child that the ray reaches; CGT_BVH_NO_CHILD: there is none. */
CGT_SPU_INLINE uint32_t bvh_single_pop(bvh_stack *s, float far, bool any_hit)
{
    while (s->top) {
        s->top--;
        if (any_hit || s->near[s->top] <= far)
            return s->code[s->top];
    }
    return CGT_BVH_NO_CHILD;
}

/* Traces the ray through the subtree of a code. */
CGT_SPU_INLINE void bvh_single_trace(const bvh_call *c, bvh_ray *r, uint32_t code, bool any_hit)
{
    bvh_stack s;
    bvh_leaf_ray l;
    bvh_slabs q;
    bvh_slabs_init(r, &q);
    bvh_leaf_ray_init(c, r, &l);
    s.top = 0;
    while (code != CGT_BVH_NO_CHILD) {
        if (code & CGT_BVH_LEAF) {
            bvh_single_leaf(c, r, &l, code, any_hit);
            if (any_hit && r->far == -INFINITY)
                return;
            code = CGT_BVH_NO_CHILD;
        } else {
            c->counts->nodes++;
            code = bvh_single_step(c, r, &q, (const bvh_node *)c->tree->node + code, &s, any_hit);
        }
        if (code == CGT_BVH_NO_CHILD)
            code = bvh_single_pop(&s, r->far, any_hit);
    }
}

#endif
