/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One ray at a time along the ropes of single rays.
 *
 * Times are computed in double: of finite floats none leaves the range, and a difference, a reciprocal and a product
 * err by less than 2^-51 of the result together. So two of them are in order where they are further apart than 2^-50 of
 * their sum, which the rounding of that test does not use up; the others are compared exactly. */
#ifndef CGT_KD_ROPE_SINGLE_H
#define CGT_KD_ROPE_SINGLE_H

#include "papers/kernel/kd/kd_leaf.h"
#include "papers/kernel/kd/kd_rope.h"

#define ROPE_RAY_REL_ERROR 0x1p-50

/* Along an axis without a component of the direction splits are passed long before or long after; in the plane of a
 * split either side will do. Faces are never left by. */
#define ROPE_RAY_STEEP 0x1p500
#define ROPE_RAY_NEVER 0x1p600

typedef struct rope_ray {
    double org[4], rdir[4];           /* by axis, and ROPE_START */
    double face_org[3], face_rdir[3]; /* the same for faces to leave by */
    uint32_t forward[4];              /* 0 or 1 */
    rope_time last;
    double time; /* of last, rounded */
    uint64_t exact_steps;
} rope_ray;

static void rope_ray_init(const packet *p, uint32_t i, rope_ray *r)
{
    for (int a = 0; a < 3; a++) {
        const float d = p->dir[a][i];
        r->forward[a] = d >= 0;
        r->org[a] = (double)p->org[a][i];
        r->rdir[a] = d == 0 ? ROPE_RAY_STEEP : 1 / (double)d;
        r->face_org[a] = d == 0 ? -ROPE_RAY_NEVER : r->org[a];
        r->face_rdir[a] = d == 0 ? 1 : r->rdir[a];
    }
    r->org[ROPE_START] = 0;
    r->rdir[ROPE_START] = 1;
    r->forward[ROPE_START] = 0;
    r->exact_steps = 0;
}

CGT_SPU_INLINE void rope_ray_set_last(rope_ray *r, rope_time last)
{
    r->last = last;
    r->time = ((double)last.plane - r->org[last.axis]) * r->rdir[last.axis];
}

CGT_SPU_INLINE bool rope_ray_differ(double a, double b)
{
    return fabs(a - b) > (fabs(a) + fabs(b)) * ROPE_RAY_REL_ERROR;
}

/* Whether the ray is above the split of a node a moment after its last plane: 0 or 1. */
CGT_SPU_INLINE uint32_t rope_ray_above(const packet *p, uint32_t i, rope_ray *r, uint32_t axis, float split)
{
    const double t = ((double)split - r->org[axis]) * r->rdir[axis];
    if (__builtin_expect(rope_ray_differ(t, r->time), 1))
        return (t < r->time) == r->forward[axis];
    r->exact_steps++;
    return rope_is_above(p, i, axis, split, r->last);
}

/* Leaves a leaf; returns the node that the rope leads to. */
CGT_SPU_INLINE uint32_t rope_ray_leave(const packet *p, uint32_t i, rope_ray *r, const cgt_kd_leaf *leaf)
{
    float plane[3];
    double t[3];
    for (uint32_t a = 0; a < 3; a++) {
        plane[a] = r->forward[a] ? leaf->high[a] : leaf->low[a];
        t[a] = ((double)plane[a] - r->face_org[a]) * r->face_rdir[a];
    }
    const double first01 = t[1] < t[0] ? t[1] : t[0], second01 = t[1] < t[0] ? t[0] : t[1];
    const double first = t[2] < first01 ? t[2] : first01;
    const double later = t[2] < first01 ? first01 : t[2], second = later < second01 ? later : second01;
    const uint32_t axis = t[2] < first01 ? 2 : t[1] < t[0];
    r->last = (rope_time){plane[axis], axis};
    r->time = first;
    if (__builtin_expect(!rope_ray_differ(second, first), 0)) {
        rope_ray_set_last(r, rope_leave(p, i, leaf->low, leaf->high));
        r->exact_steps++;
    }
    /* never ROPE_START: a direction has some component */
    return leaf->rope[2 * r->last.axis + r->forward[r->last.axis]];
}

/* Whether nothing that counts can be met from now on. t rounds to the ends of the range. */
CGT_SPU_INLINE bool rope_ray_is_done(const packet *p, uint32_t i, const rope_ray *r)
{
    const double high = (double)p->high[i];
    return p->high[i] == -INFINITY || r->time > high + (fabs(high) * 0x1p-22 + 0x1p-126);
}

static void rope_trace_ray(const cgt_kd_tree *tree, leaf_tests *l, uint32_t i)
{
    const packet *p = l->p;
    uint32_t node_index = 0, nodes = 0, leaves = 0;
    rope_ray r;
    rope_time last;
    lane_rays test_rays;
    if (p->high[i] == -INFINITY)
        return;
    rope_ray_init(p, i, &r);
    l->counts->packets++;
    if (!rope_enter(p, i, tree->low, tree->high, &last))
        return;
    lane_rays_of_one(p, i, l->scale, &test_rays);
    leaf_mailbox_clear(l);
    rope_ray_set_last(&r, last);
    while (node_index != CGT_INVALID_ID && !rope_ray_is_done(p, i, &r)) {
        cgt_kd_node n = tree->node[node_index];
        while (!cgt_kd_is_leaf(n)) {
            nodes++;
            n = tree->node[n.word[1] + rope_ray_above(p, i, &r, cgt_kd_axis(n), cgt_kd_split(n))];
        }
        const cgt_kd_leaf *leaf = &tree->leaf[n.word[1]];
        if (leaves++ == tree->leaves) { /* more than there are: only a broken tree has loops */
            l->counts->rope_loops++;
            break;
        }
        ROPE_VISIT(i, 1u, n.word[1]);
        if (leaf->count)
            leaf_test_ray(l, &test_rays, tree->reference + leaf->first, leaf->count, i);
        node_index = rope_ray_leave(p, i, &r, leaf);
    }
    l->counts->nodes += nodes;
    l->counts->leaves += leaves;
    l->counts->rope_steps += leaves - (leaves > 0);
    l->counts->exact_steps += r.exact_steps;
}

#endif
