/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Boxes and ropes of the leaves of a flattened kd-tree (Popov et al. 2007, section 3.2), from the root down. The upper
 * face of a lower child leads to its sibling, and so does the lower face of an upper child; all other faces lead where
 * the parent's do. Ropes of single rays are pushed down at every node on the way, so that their children start from
 * there.
 *
 * The node that a rope leads to holds the whole face in its closed box. Where a split lies in the plane of the face,
 * and so cuts off a box without thickness, the rope skips that box. */
#include "papers/build/kd/kd_build.h"

#define PARTS_DEPTH 6u

/* A node on the way down, its box and where its faces lead. */
typedef struct linked_node {
    uint32_t node;
    float low[3], high[3];
    uint32_t rope[6], packet_rope[6];
} linked_node;

/* The smallest node below `rope` that holds the whole face. */
static uint32_t push_down(const cgt_kd_node *node, uint32_t rope, const linked_node *from, uint32_t face)
{
    const uint32_t face_axis = face / 2;
    const bool is_upper_face = face & 1;
    while (rope != CGT_INVALID_ID && !cgt_kd_is_leaf(node[rope])) {
        const uint32_t axis = cgt_kd_axis(node[rope]);
        const float split = cgt_kd_split(node[rope]);
        bool upper;
        if (axis == face_axis)
            upper = is_upper_face ? split <= from->high[axis] : split < from->low[axis];
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
    child->rope[face] = child->packet_rope[face] = n.word[1] + !upper;
}

static void link_leaf(const linked_node *from, cgt_kd_leaf *leaf)
{
    memcpy(leaf->low, from->low, sizeof leaf->low);
    memcpy(leaf->high, from->high, sizeof leaf->high);
    memcpy(leaf->rope, from->rope, sizeof leaf->rope);
    memcpy(leaf->packet_rope, from->packet_rope, sizeof leaf->packet_rope);
}

typedef struct linking {
    const cgt_kd_tree *tree;
    cgt_kd_leaf *leaf;
    linked_node part[1u << PARTS_DEPTH]; /* inner nodes at this depth: each subtree is a task */
    uint32_t parts;
} linking;

/* Links the leaves below a node; those below nodes `levels` further down are left to parts. */
static void link_below(linking *l, const linked_node *from, uint32_t levels)
{
    linked_node stack[CGT_KD_MAX_DEPTH + 1];
    uint32_t levels_left[CGT_KD_MAX_DEPTH + 1], top = 1; /* levels to go */
    stack[0] = *from;
    levels_left[0] = levels;
    while (top) {
        linked_node current = stack[--top];
        const uint32_t levels_to_go = levels_left[top];
        const cgt_kd_node n = l->tree->node[current.node];
        for (uint32_t face = 0; face < 6; face++)
            current.rope[face] = push_down(l->tree->node, current.rope[face], &current, face);
        if (cgt_kd_is_leaf(n)) {
            link_leaf(&current, &l->leaf[n.word[1]]);
        } else if (!levels_to_go) {
            l->part[l->parts++] = current;
        } else {
            for (uint32_t side = 2; side-- > 0; top++) {
                link_child(&current, n, side, &stack[top]);
                levels_left[top] = levels_to_go - 1;
            }
        }
    }
}

static void link_part(void *argument, uint32_t index)
{
    linking *l = argument;
    link_below(l, &l->part[index], CGT_KD_MAX_DEPTH);
}

void cgt_kd_link_leaves(cgt_context *context, const cgt_kd_tree *tree, cgt_kd_leaf *leaf)
{
    linking l = {.tree = tree, .leaf = leaf};
    linked_node root = {.node = 0};
    memcpy(root.low, tree->low, sizeof tree->low);
    memcpy(root.high, tree->high, sizeof tree->high);
    for (uint32_t face = 0; face < 6; face++)
        root.rope[face] = root.packet_rope[face] = CGT_INVALID_ID;
    link_below(&l, &root, PARTS_DEPTH);
    cgt_run_tasks(context, link_part, &l, l.parts);
}
