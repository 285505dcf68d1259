/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Boxes and ropes of the leaves of a flattened kd-tree (Popov et al. 2007, section 3.2), from the root down. The upper
 * faces of a lower child lead to its sibling, the lower face of an upper child likewise, and all other faces where the
 * parent's do. Ropes of single rays are pushed down at every node on the way, so that their children start from there.
 *
 * What a rope leads to holds the whole face in its closed box. Where a split lies in the plane of the face, and so cuts
 * off a box without thickness, the rope passes that by. */
#include "kd_build.h"

/* A node on the way down, its box and where its faces lead. */
typedef struct linked_node {
    uint32_t node;
    float low[3], high[3];
    uint32_t rope[6], wide_rope[6];
} linked_node;

/* The smallest node below `rope` that holds the whole face. */
static uint32_t push_down(const cgt_kd_node *node, uint32_t rope, const linked_node *from, uint32_t face)
{
    const uint32_t across = face / 2;
    const bool upwards = face & 1;
    while (rope != CGT_NONE && !cgt_kd_is_leaf(node[rope])) {
        const uint32_t axis = cgt_kd_axis(node[rope]);
        const float split = cgt_kd_split(node[rope]);
        bool upper;
        if (axis == across)
            upper = upwards ? split <= from->high[axis] : split < from->low[axis];
        else if (split >= from->high[axis])
            upper = false;
        else if (split <= from->low[axis])
            upper = true;
        else
            break;
        rope = node[rope].word[1] + upper;
    }
    return rope;
}

static void link_child(const linked_node *parent, cgt_kd_node n, bool upper, linked_node *child)
{
    const uint32_t axis = cgt_kd_axis(n), face = 2 * axis + !upper;
    *child = *parent;
    child->node = n.word[1] + upper;
    *(upper ? &child->low[axis] : &child->high[axis]) = cgt_kd_split(n);
    child->rope[face] = child->wide_rope[face] = n.word[1] + !upper;
}

static void link_leaf(const linked_node *from, cgt_kd_leaf *leaf)
{
    memcpy(leaf->low, from->low, sizeof leaf->low);
    memcpy(leaf->high, from->high, sizeof leaf->high);
    memcpy(leaf->rope, from->rope, sizeof leaf->rope);
    memcpy(leaf->wide_rope, from->wide_rope, sizeof leaf->wide_rope);
}

void cgt_kd_link_leaves(const cgt_kd_tree *tree, cgt_kd_leaf *leaf)
{
    linked_node stack[CGT_KD_MAX_DEPTH + 1], at;
    uint32_t top = 1;
    stack[0].node = 0;
    memcpy(stack[0].low, tree->low, sizeof tree->low);
    memcpy(stack[0].high, tree->high, sizeof tree->high);
    for (uint32_t face = 0; face < 6; face++)
        stack[0].rope[face] = stack[0].wide_rope[face] = CGT_NONE;
    while (top) {
        at = stack[--top];
        const cgt_kd_node n = tree->node[at.node];
        for (uint32_t face = 0; face < 6; face++)
            at.rope[face] = push_down(tree->node, at.rope[face], &at, face);
        if (cgt_kd_is_leaf(n)) {
            link_leaf(&at, &leaf[n.word[1]]);
            continue;
        }
        link_child(&at, n, true, &stack[top++]);
        link_child(&at, n, false, &stack[top++]);
    }
}
