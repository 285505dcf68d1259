/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks leaves and their ropes by the definitions: from the parents and boxes of all nodes, without relying on
 * anything that the library computed. */
#include "structures/check/kd_walk.h"

/* The sibling at the lowest ancestor that is split across the face; CGT_INVALID_ID beyond the root. */
static uint32_t across(const kd_walk *w, uint32_t node, uint32_t axis, bool upper)
{
    for (uint32_t parent; (parent = w->parent[node]) != CGT_INVALID_ID; node = parent) {
        const cgt_kd_node n = w->tree->node[parent];
        const bool is_upper = node != n.word[1];
        if (cgt_kd_axis(n) == axis && is_upper != upper)
            return is_upper ? n.word[1] : n.word[1] + 1;
    }
    return CGT_INVALID_ID;
}

static bool holds(const kd_box *box, const kd_box *face)
{
    for (int a = 0; a < 3; a++)
        if (face->low[a] < box->low[a] || face->high[a] > box->high[a])
            return false;
    return true;
}

static bool below(const kd_walk *w, uint32_t node, uint32_t ancestor)
{
    while (node != ancestor && node != CGT_INVALID_ID)
        node = w->parent[node];
    return node == ancestor;
}

/* A split in the plane of the face cuts off a box without thickness there, which a rope does not lead into. */
static void check_splits_in_face(kd_walk *w, uint32_t node, uint32_t side, uint32_t rope, uint32_t wide, float plane)
{
    for (uint32_t parent; rope != wide; rope = parent) {
        parent = w->parent[rope];
        const cgt_kd_node n = w->tree->node[parent];
        const uint32_t is_upper = rope != n.word[1];
        if (cgt_kd_axis(n) == side / 2 && cgt_kd_split(n) == plane && is_upper != (side & 1))
            kd_fault(w, "leaf %u, face %u: the rope leads into node %u, which has no thickness", node, side, rope);
    }
}

static void check_rope(kd_walk *w, uint32_t node, const cgt_kd_leaf *leaf, uint32_t side)
{
    const uint32_t axis = side / 2, rope = leaf->rope[side];
    const uint32_t wide = across(w, node, axis, side & 1);
    kd_box face = w->box[node];
    *(side & 1 ? &face.low[axis] : &face.high[axis]) = side & 1 ? face.high[axis] : face.low[axis];
    if (leaf->packet_rope[side] != wide) {
        kd_fault(w, "leaf %u, face %u: the wide rope leads to node %u, not to %u", node, side, leaf->packet_rope[side],
                 wide);
        return;
    }
    if (wide == CGT_INVALID_ID || rope == CGT_INVALID_ID) {
        if (wide != rope)
            kd_fault(w, "leaf %u, face %u: the rope leads to node %u, the wide one to %u", node, side, rope, wide);
        return;
    }
    if (rope >= w->tree->nodes || !w->reached[rope] || !below(w, rope, wide) || !holds(&w->box[rope], &face)) {
        kd_fault(w, "leaf %u, face %u: the rope leads to node %u, which does not hold the face", node, side, rope);
        return;
    }
    check_splits_in_face(w, node, side, rope, wide, face.low[axis]);
    const cgt_kd_node n = w->tree->node[rope];
    for (uint32_t i = 0; !cgt_kd_is_leaf(n) && i < 2; i++)
        if (holds(&w->box[n.word[1] + i], &face))
            kd_fault(w, "leaf %u, face %u: the rope leads to node %u, but its child %u holds the face", node, side,
                     rope, n.word[1] + i);
}

void kd_check_leaves(kd_walk *w)
{
    uint32_t number = 0;
    for (uint32_t node = 0; node < w->tree->nodes && !w->faulty; node++) {
        const cgt_kd_node n = w->tree->node[node];
        if (node == 1 || !cgt_kd_is_leaf(n))
            continue;
        const cgt_kd_leaf *leaf = &w->tree->leaf[number];
        if (n.word[1] != number)
            kd_fault(w, "leaf %u has number %u, not %u", node, n.word[1], number);
        for (int a = 0; a < 3; a++)
            if (leaf->low[a] != w->box[node].low[a] || leaf->high[a] != w->box[node].high[a])
                kd_fault(w, "leaf %u has a wrong box", node);
        for (uint32_t side = 0; side < 6; side++)
            check_rope(w, node, leaf, side);
        number++;
    }
}
