/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The usual traversal with a stack. */
#include "structures/structures_walk.h"

#include <math.h>

typedef struct span {
    uint32_t node;
    double t_near, t_far;
} span;

/* The part of the ray in the root's box; t_near > t_far where there is none. */
static span clip(const cgt_kd_tree *tree, const float org[3], const float dir[3], double t_end)
{
    span s = {0, 0.0, t_end};
    for (int a = 0; a < 3; a++) {
        const double low = (double)tree->low[a] - (double)org[a], high = (double)tree->high[a] - (double)org[a];
        if (dir[a] == 0.0f) {
            if (low > 0.0 || high < 0.0)
                s.t_far = -1.0;
            continue;
        }
        const double t0 = low / (double)dir[a], t1 = high / (double)dir[a];
        s.t_near = fmax(s.t_near, fmin(t0, t1));
        s.t_far = fmin(s.t_far, fmax(t0, t1));
    }
    return s;
}

/* Steps from an inner node to the child that the ray enters first. If it also enters the other one, *later gets that
 * one and the result is 1. */
static int step(cgt_kd_node node, const float org[3], const float dir[3], span *now, span *later)
{
    const uint32_t axis = cgt_kd_axis(node), lower = node.word[1];
    const double split = (double)cgt_kd_split(node), from = (double)org[axis], along = (double)dir[axis];
    const uint32_t side = from > split || (!(from < split) && along > 0.0);
    const uint32_t first = lower + side, second = lower + (side ^ 1u);
    const double t = along == 0.0 ? INFINITY : (split - from) / along;
    now->node = first;
    if (t < 0.0 || t > now->t_far)
        return 0;
    if (t < now->t_near) {
        now->node = second;
        return 0;
    }
    *later = (span){second, t, now->t_far};
    now->t_far = t;
    return 1;
}

void structures_walk(const cgt_kd_tree *tree, const float org[3], const float dir[3], double t_end, walk_visitor *visit,
                     void *user)
{
    span stack[CGT_KD_MAX_DEPTH + 1];
    uint32_t held = 0;
    span now = clip(tree, org, dir, t_end);
    if (!tree->nodes || now.t_near > now.t_far)
        return;
    for (;;) {
        const cgt_kd_node node = tree->node[now.node];
        visit(user, now.node);
        if (!cgt_kd_is_leaf(node)) {
            if (held <= CGT_KD_MAX_DEPTH)
                held += (uint32_t)step(node, org, dir, &now, &stack[held]);
            continue;
        }
        if (!held || now.t_far >= t_end)
            return;
        now = stack[--held];
    }
}
