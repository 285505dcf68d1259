/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which leaves hold bundles of capsules, and the turned slabs of nodes over them (kernel/bvh/bvh_turned.h); after
 * Woop, Benthin, Wald, Johnson, Tabellion, "Exploiting Local Orientation Similarity for Efficient Ray Traversal of Hair
 * and Fur", 2014, who turn the box of each child. Here the children of a node share their directions, and keep their
 * boxes along the axes, so that nodes without bundles are what they were.
 *
 * The axis of a node is the mean of one capsule of each child. Planes are found from all capsules below each child: in
 * all nodes over n capsules, each is visited once a level. A node is turned where that pays: its children's boxes, if
 * turned, have less than 0.6 of their surface, which is how many rays pass them. */
#ifndef CGT_BVH_TURN_H
#define CGT_BVH_TURN_H

#include <math.h>

#include "kernel/builders/bvh/bvh_binary.h"
#include "kernel/primitive/lane_vectors.h"

#define BUNDLE_SHARE 0.6f   /* of the surface */
#define BUNDLE_COSINE 0.95f /* of angles between what is parallel */

/* Whether a leaf's capsules, whose numbers are in d, are side by side and lean to the axes of its box. */
CGT_SPU_INLINE bool bvh_is_bundle(const vfloat d[7], const bvh_leaf_record *leaf)
{
    vfloat n[3], first[3];
    for (int a = 0; a < 3; a++) {
        n[a] = spu_sub(d[3 + a], d[a]);
        first[a] = spux_permute(n[a], spux_vuint(0));
    }
    const vfloat length = spux_sqrt(lane_dot(first, first));
    const vfloat product = spu_mul(spux_sqrt(lane_dot(n, n)), length);
    if (!spux_all(spu_cmpgt(spux_abs(lane_dot(n, first)), spu_mul(product, spux_vfloat(BUNDLE_COSINE)))))
        return false;
    float across = 0;
    for (int a = 0; a < 3; a++)
        across = fmaxf(across, leaf->high[a] - leaf->low[a] - spux_hmax(spux_abs(first[a])));
    return across * (2 * spux_hmax(length) + across) < BUNDLE_SHARE * bvh_half_area(leaf->low, leaf->high);
}

/* The block of a leaf, NULL if that has no capsules. */
CGT_SPU_INLINE const capsule_block *bvh_capsules_of(const cgt_bvh_build *b, uint32_t reference)
{
    const uint32_t code = bvh_leaf_at(b, reference)->code, block = code & CGT_BVH_INDEX_MASK;
    if (!(code & CGT_BVH_BOXED_LEAF) || block < b->triangle_blocks)
        return NULL;
    return (const capsule_block *)b->block[CGT_KIND_CAPSULES] + (block - b->triangle_blocks);
}

/* Finds the mean axis of children that begin with a bundle each. Returns false where they do not, or differ. */
static bool bvh_find_axis(const cgt_bvh_build *b, const uint32_t *child, uint32_t children, float axis[3])
{
    float sum[3] = {0, 0, 0};
    for (uint32_t k = 0; k < children; k++) {
        uint32_t r = child[k];
        float n[3];
        while (!(r & CGT_BVH_LEAF_REF))
            r = bvh_inner_records(b)[r].child[0];
        if (!bvh_leaf_at(b, r)->is_bundle)
            return false;
        const capsule_block *q = bvh_capsules_of(b, r);
        for (int a = 0; a < 3; a++)
            n[a] = q->end[1][a][0] - q->end[0][a][0];
        const float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        const float scale = copysignf(1 / length, n[0] * sum[0] + n[1] * sum[1] + n[2] * sum[2]);
        for (int a = 0; a < 3; a++)
            sum[a] += n[a] * scale;
    }
    const float length = sqrtf(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (int a = 0; a < 3; a++)
        axis[a] = sum[a] / length;
    return length > BUNDLE_COSINE * (float)children;
}

/* Directions across an axis, then the axis: of length 1 or less. */
static void bvh_make_frame(const float axis[3], float frame[3][3])
{
    static const float less = 1 - 0x1p-18f;
    int least = 0;
    for (int a = 1; a < 3; a++)
        least = fabsf(axis[a]) < fabsf(axis[least]) ? a : least;
    const int i = (least + 1) % 3, j = (least + 2) % 3;
    const float scale = less / sqrtf(axis[i] * axis[i] + axis[j] * axis[j]);
    frame[0][least] = 0;
    frame[0][i] = -axis[j] * scale;
    frame[0][j] = axis[i] * scale;
    for (int a = 0; a < 3; a++) {
        const int p = (a + 1) % 3, q = (a + 2) % 3;
        frame[1][a] = axis[p] * frame[0][q] - axis[q] * frame[0][p];
        frame[2][a] = axis[a] * less;
    }
}

/* Bounds all capsules below a child along the frame. Returns false if there is something else. */
static bool bvh_bound_turned(const cgt_bvh_build *b, uint32_t child, const float frame[3][3], float low[3],
                             float high[3])
{
    uint32_t stack[CGT_BVH_MAX_DEPTH + 2], top = 0;
    vfloat from[3], to[3];
    for (int k = 0; k < 3; k++) {
        from[k] = spux_vfloat(INFINITY);
        to[k] = spux_vfloat(-INFINITY);
    }
    stack[top++] = child;
    while (top) {
        const uint32_t r = stack[--top];
        if (!(r & CGT_BVH_LEAF_REF)) {
            stack[top++] = bvh_inner_records(b)[r].child[0];
            stack[top++] = bvh_inner_records(b)[r].child[1];
            continue;
        }
        const capsule_block *q = bvh_capsules_of(b, r);
        if (!q)
            return false;
        const vfloat radius = spux_abs(spux_load(q->radius));
        for (int k = 0; k < 3; k++) {
            vfloat at[2];
            for (int i = 0; i < 2; i++)
                at[i] = spu_madd(spux_load(q->end[i][0]), spux_vfloat(frame[k][0]),
                                 spu_madd(spux_load(q->end[i][1]), spux_vfloat(frame[k][1]),
                                          spu_mul(spux_load(q->end[i][2]), spux_vfloat(frame[k][2]))));
            from[k] = spux_min(from[k], spu_sub(spux_min(at[0], at[1]), radius));
            to[k] = spux_max(to[k], spu_add(spux_max(at[0], at[1]), radius));
        }
    }
    for (int k = 0; k < 3; k++) {
        low[k] = spux_hmin(from[k]);
        high[k] = spux_hmax(to[k]);
    }
    return true;
}

/* Turns a node where that pays. low, high: of the children's boxes. Planes are rounded outwards: products and sums are
 * off by 2^-22 of the 1-norm of an end, and of the radius by less than as much. 2^-100 is for underflow. */
__attribute__((unused)) static void bvh_turn_node(const cgt_bvh_build *b, const uint32_t *child, uint32_t children,
                                                  const vfloat low[3], const vfloat high[3], bvh_node *node)
{
    bvh_turned *turned = (bvh_turned *)b->turned + (node - (const bvh_node *)b->node);
    _Alignas(CGT_VECTOR_BYTES) float box_area[CGT_LANES], reach[CGT_LANES];
    float axis[3], frame[3][3], area = 0, turned_area = 0;
    vfloat size[3], most[3];
    if (!bvh_find_axis(b, child, children, axis))
        return;
    bvh_make_frame(axis, frame);
    const vfloat scale = spux_vfloat(b->scale);
    for (int a = 0; a < 3; a++) {
        size[a] = spu_mul(spu_sub(high[a], low[a]), scale);
        most[a] = spu_mul(spux_max(spux_abs(low[a]), spux_abs(high[a])), scale);
    }
    spux_store(reach, lane_sum(most));
    spux_store(box_area, spu_madd(size[0], size[1], spu_madd(size[1], size[2], spu_mul(size[2], size[0]))));
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        float from[3] = {0, 0, 0}, to[3] = {0, 0, 0};
        if (k < children && !bvh_bound_turned(b, child[k], frame, from, to))
            return;
        const float margin = reach[k] * 0x1p-20f + 0x1p-100f;
        for (int i = 0; i < 2; i++) {
            turned->low[i][k] = from[i] - margin;
            turned->high[i][k] = to[i] + margin;
        }
        area += k < children ? box_area[k] : 0;
        turned_area += bvh_half_area(from, to);
    }
    if (!(turned_area < BUNDLE_SHARE * area))
        return;
    memcpy(turned->across, frame, sizeof turned->across);
    node->flat[0] |= BVH_TURNED;
}

#endif
