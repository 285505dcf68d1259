/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray through the wide tree: lanes are the children of a node, or the primitives of a leaf. */
#ifndef CGT_WIDE_SINGLE_H
#define CGT_WIDE_SINGLE_H

#include "kernel/bvh/bvh_ray.h"

/* A normalised ray. Numbers of planes are as the tree has them: rdir is times the world's scale. */
typedef struct wide_ray {
    float org[3], dir[3];
    float rdir[3], first[3], last[3]; /* t = plane rdir + first or last */
    float near, far;                  /* far: of best.high too */
    uint32_t octant;
    uint32_t number; /* of the call */
    wide_best best;
} wide_ray;

/* What slabs need besides origin and direction. */
CGT_SPU_INLINE void wide_ray_planes(const wide_call *c, const float rdir[3], const float slack[3], wide_ray *r)
{
    r->octant = 0;
    for (int a = 0; a < 3; a++) {
        const float shift = r->org[a] * rdir[a], wide = slack[a] * fabsf(rdir[a]);
        r->rdir[a] = rdir[a] * c->scale;
        r->first[a] = -shift - wide;
        r->last[a] = wide - shift;
        r->octant |= (uint32_t)(rdir[a] < 0) << a;
    }
}

/* ---- a leaf ---- */

typedef struct wide_lanes {
    lane_rays ray; /* the same in every lane; t_min is `near` */
    vfloat inside; /* after which t is in the range for certain */
} wide_lanes;

CGT_SPU_INLINE void wide_lanes_make(const wide_call *c, const wide_ray *r, wide_lanes *l)
{
    for (int a = 0; a < 3; a++) {
        l->ray.org[a] = spux_vfloat(r->org[a]);
        l->ray.dir[a] = spux_vfloat(r->dir[a]);
    }
    l->ray.rdd = spux_vfloat(1);
    if (c->tree->sphere_blocks) {
        const float x = r->dir[0] * r->dir[0] + r->dir[1] * r->dir[1] + r->dir[2] * r->dir[2];
        l->ray.rdd = spux_vfloat(1 / x);
    }
    /* |d| is from 1 to 2 sqrt(3), its largest component below 2: bounds of all directions will do */
    l->ray.rlength = spux_vfloat(1);
    l->ray.most = spux_vfloat(2);
    l->ray.underflow = spux_vfloat(0x1.8p-117f);
    for (int a = 0; a < 3; a++)
        l->ray.scaled_org[a] = l->ray.org[a];
    l->ray.unscale = spux_vfloat(1);
    l->ray.t_min = spux_vfloat(r->near);
    l->inside = spux_vfloat(r->near + fabsf(r->near) * 0x1p-18f + 0x1p-84f);
}

/* Keeps what the ray found out about the lanes' objects, as leaf_keep_ray does. */
CGT_SPU_INLINE void wide_single_keep(const wide_call *c, wide_ray *r, const wide_lanes *l, const lane_hits *q,
                                     const uint32_t *object, unsigned used, bool any_hit)
{
    const vmask sure = spu_and(q->certain, spu_cmpgt(q->low, l->inside));
    const vmask may = spu_andc(spu_or(q->certain, q->open), spu_cmpgt(q->low, spux_vfloat(r->best.high)));
    unsigned certain = spux_mask_bits(spu_and(may, sure)) & used, open = spux_mask_bits(spu_andc(may, sure)) & used;
    if (!(certain | open))
        return;
    _Alignas(CGT_VECTOR_BYTES) float low[CGT_LANES], high[CGT_LANES];
    spux_store(low, q->low);
    spux_store(high, q->high);
    for (; certain; certain &= certain - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(certain);
        if (c->hides && wide_hidden(c, r->number, object[k]))
            continue;
        if (high[k] < r->best.low) {
            r->best.object = object[k];
            r->best.low = any_hit ? -INFINITY : low[k];
            r->best.high = any_hit ? -INFINITY : high[k];
        } else if (low[k] <= r->best.high)
            open |= 1u << k;
    }
    for (; open; open &= open - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(open);
        if (low[k] > r->best.high || (c->hides && wide_hidden(c, r->number, object[k])))
            continue;
        wide_decide(c, r->number, object[k], &r->best);
    }
    r->far = r->best.high;
}

CGT_SPU_INLINE void wide_single_spheres(const wide_call *c, wide_ray *r, const wide_lanes *l, const wide_spheres *b,
                                        unsigned used, bool any_hit)
{
    const vfloat scale = spux_vfloat(c->scale);
    lane_hits q;
    vfloat center[3];
    for (int a = 0; a < 3; a++)
        center[a] = spu_mul(spux_load(b->center[a]), scale);
    if (lane_sphere(&l->ray, center, spu_mul(spux_load(b->radius), scale), &q))
        wide_single_keep(c, r, l, &q, b->object, used, any_hit);
}

CGT_SPU_INLINE void wide_single_triangles(const wide_call *c, wide_ray *r, const wide_lanes *l, const wide_triangles *b,
                                          unsigned used, bool any_hit)
{
    lane_hits q;
    lane_triangles t;
    for (int a = 0; a < 3; a++) {
        t.vertex[a] = spux_load(b->vertex[a]);
        t.edge[0][a] = spux_load(b->edge[0][a]);
        t.edge[1][a] = spux_load(b->edge[1][a]);
    }
    t.sum[0] = spux_load(b->sum[0]);
    t.sum[1] = spux_load(b->sum[1]);
    if (lane_triangle(&l->ray, &t, &q))
        wide_single_keep(c, r, l, &q, b->object, used, any_hit);
}

CGT_SPU_INLINE void wide_single_leaf(const wide_call *c, wide_ray *r, const wide_lanes *l, uint32_t code, bool any_hit)
{
    const uint32_t count = wide_leaf_count(code), index = code & CGT_WIDE_INDEX;
    const unsigned used = CGT_ALL_LANES >> (CGT_LANES - count);
    c->counts->leaves++;
    c->counts->packet_tests += count;
    c->counts->ray_tests += CGT_LANES;
    if (code & CGT_WIDE_TRIANGLES)
        wide_single_triangles(c, r, l, (const wide_triangles *)c->tree->triangle + index, used, any_hit);
    else
        wide_single_spheres(c, r, l, (const wide_spheres *)c->tree->sphere + index, used, any_hit);
}

/* ---- a node ---- */

/* A node takes one entry away and adds at most CGT_LANES; stores are of whole vectors. */
#define WIDE_STACK (CGT_WIDE_MAX_DEPTH * (CGT_LANES - 1) + 1 + CGT_LANES)

typedef struct wide_stack {
    uint32_t code[WIDE_STACK];
    float near[WIDE_STACK]; /* where the ray enters; of nearest hits only */
    uint32_t top;
} wide_stack;

/* The lanes of children, those to be visited last first. */
CGT_SPU_INLINE vuint wide_backwards(const wide_node *n, uint32_t octant)
{
    const bool reverse = octant > 3;
    const vuint order = spux_load_bytes(n->order[reverse ? 7 - octant : octant]);
    if (reverse)
        return order;
    return spux_permute(order, spu_sub(spux_vuint(n->children - 1), spux_lane_index()));
}

/* Pushes the children that the ray passes. */
CGT_SPU_INLINE void wide_single_node(const wide_call *c, const wide_ray *r, const wide_node *n, wide_stack *s,
                                     bool any_hit)
{
    vfloat enter = spux_vfloat(r->near), leave = spux_vfloat(r->far);
    for (int a = 0; a < 3; a++) {
        const bool from_above = r->octant >> a & 1;
        const vfloat rdir = spux_vfloat(r->rdir[a]);
        enter =
            spux_max(spu_madd(spux_load(from_above ? n->high[a] : n->low[a]), rdir, spux_vfloat(r->first[a])), enter);
        leave =
            spux_min(spu_madd(spux_load(from_above ? n->low[a] : n->high[a]), rdir, spux_vfloat(r->last[a])), leave);
    }
    vuint code = spux_load_uint(n->child);
    vmask passed = spu_and(spux_cmpge(leave, enter), spux_mask_first(n->children));
    c->counts->nodes++;
    if (!any_hit && spux_any(passed)) {
        const vuint back = wide_backwards(n, r->octant);
        enter = spux_permute(enter, back);
        code = spux_permute(code, back);
        passed = spu_and(spux_cmpge(spux_permute(leave, back), enter), spux_mask_first(n->children));
    }
    spux_store_unaligned_uint(s->code + s->top, spux_compress(code, passed));
    if (!any_hit)
        spux_store_unaligned(s->near + s->top, spux_compress(enter, passed));
    s->top += spux_count_bits(spux_mask_bits(passed));
}

/* The ray through what hangs on a code. */
CGT_SPU_INLINE void wide_single_trace(const wide_call *c, wide_ray *r, uint32_t code, bool any_hit)
{
    wide_stack s;
    wide_lanes l;
    wide_lanes_make(c, r, &l);
    s.top = 0;
    for (;;) {
        if (code & CGT_WIDE_LEAF) {
            wide_single_leaf(c, r, &l, code, any_hit);
            if (any_hit && r->far == -INFINITY)
                return;
        } else
            wide_single_node(c, r, (const wide_node *)c->tree->node + code, &s, any_hit);
        do {
            if (!s.top)
                return;
            s.top--;
        } while (!any_hit && s.near[s.top] > r->far);
        code = s.code[s.top];
    }
}

#endif
