/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The way of a ray from leaf to leaf of a kd-tree with ropes, exactly.
 *
 * A ray is a point that moves along. Its position is the time T of the plane that it crossed last, exact as the pair of
 * plane and axis (plane_order.h), and a moment later: where it is in a split plane at T, its direction decides the
 * side. A component of the direction that is 0 leaves it on the side of its origin, or in the plane for ever: then
 * either side will do, since boxes are closed and primitives that touch a plane are listed on both sides of it.
 *   start  T is the latest of the times at which the ray enters the slabs of the root, and the start of its range; it
 *          misses the root where it leaves some slab before
 *   down   to the side of each split that the ray is on, a moment after T, down to a leaf
 *   leave  by the face of the leaf whose plane the ray crosses first, by any of several at one time. T is the time
 *          of that plane, and the rope of the face leads on
 *
 * The leaves cover the ray. Its point at T is in the closed box of the node that it goes down from: of the root at the
 * start; later it is in the face that it left by, which the node of the rope holds. Down keeps it in the closed box. So
 * from T to the time it leaves it is in the leaf, and then the next leaf takes over. The exact point of a hit is thus
 * in the closed box of a leaf that is visited; and that leaf lists the primitive.
 *
 * No leaf is visited twice, so the path ends. Suppose one were, and let C be the lowest node that holds all leaves from
 * one visit to the next. Some of them are below its split and some are above, so there are steps both ways. A rope
 * leads to the sibling S of a node that holds the leaf it comes from, or to a node in S (pushed down). Take a step from
 * below the split of C to above it: S holds something above the split, but not the leaf, so it is no node from C
 * upwards; and the parent of S holds the leaf, so S is not inside the upper child of C: it is that child. So the step
 * goes through an upper face across the axis of C, and a step back would go through a lower one. But a ray leaves by
 * the upper faces of an axis alone, or by the lower ones alone. This takes no thickness of boxes, and no arithmetic but
 * the sign of the direction: it is the hits that need the exact order. */
#ifndef CGT_KD_ROPE_H
#define CGT_KD_ROPE_H

#include <float.h>

#include "papers/model/plane_order.h"
#include "kernel/packet/packet.h"
#include "papers/kernel/paper_tunables.h"
#include "papers/kernel/spu_programs.h"

/* In place of an axis: T is the start of the ray's range. */
#define ROPE_START 3u

/* When a ray crossed its last plane. */
typedef struct rope_time {
    float plane;
    uint32_t axis;
} rope_time;

static inline cgt_plane_time rope_exact_time(const packet *p, uint32_t i, rope_time t)
{
    if (t.axis == ROPE_START)
        return (cgt_plane_time){t.plane, 0, 1};
    return (cgt_plane_time){t.plane, p->org[t.axis][i], p->dir[t.axis][i]};
}

/* Sign of the time of a less that of b. */
static inline int rope_order(const packet *p, uint32_t i, rope_time a, rope_time b)
{
    const cgt_plane_time first = rope_exact_time(p, i, a), second = rope_exact_time(p, i, b);
    return ROPE_PLANE_ORDER(&first, &second);
}

/* Where to start, before all that rounds to t_min or more; -infinity where that leaves the range of float. */
static inline float rope_start(float t_min) { return t_min - (fabsf(t_min) * 0x1p-22f + 0x1p-126f); }

/* The plane by which ray i enters a box across an axis, or leaves it. */
static inline rope_time rope_face(const packet *p, uint32_t i, const float low[3], const float high[3], uint32_t axis,
                                  bool leave)
{
    return (rope_time){(p->dir[axis][i] > 0) == leave ? high[axis] : low[axis], axis};
}

/* The first plane by which ray i leaves a box. */
__attribute__((noinline, unused)) static rope_time rope_leave(const packet *p, uint32_t i, const float low[3],
                                                              const float high[3])
{
    rope_time first = {0, ROPE_START};
    for (uint32_t a = 0; a < 3; a++) {
        const rope_time t = rope_face(p, i, low, high, a, true);
        if (p->dir[a][i] != 0 && (first.axis == ROPE_START || rope_order(p, i, t, first) < 0))
            first = t;
    }
    return first;
}

/* The time at which ray i enters the root within its range; false where it misses it. */
__attribute__((noinline, unused)) static bool rope_enter(const packet *p, uint32_t i, const float low[3],
                                                         const float high[3], rope_time *last)
{
    const float start = rope_start(p->t_min[i]);
    bool has_time = start >= -FLT_MAX;
    if (p->t_min[i] > FLT_MAX)
        return false; /* a range of nothing but infinity */
    *last = (rope_time){start, ROPE_START};
    for (uint32_t a = 0; a < 3; a++) {
        const rope_time t = rope_face(p, i, low, high, a, false);
        if (p->dir[a][i] == 0) {
            if (p->org[a][i] < low[a] || p->org[a][i] > high[a])
                return false;
        } else if (!has_time || rope_order(p, i, t, *last) > 0) {
            *last = t;
            has_time = true;
        }
    }
    return rope_order(p, i, *last, rope_leave(p, i, low, high)) <= 0;
}

/* Whether ray i is above a split a moment after T; in the plane of the split for ever: false. */
__attribute__((noinline, unused)) static bool rope_is_above(const packet *p, uint32_t i, uint32_t axis, float split,
                                                            rope_time last)
{
    if (p->dir[axis][i] == 0)
        return p->org[axis][i] > split;
    const bool crossed = rope_order(p, i, (rope_time){split, axis}, last) <= 0;
    return crossed == (p->dir[axis][i] > 0);
}

#endif
