/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Nodes of a tree that is built, and what they cost by the surface-area heuristic. */
#include "papers/build/kd/split/kd_builder.h"

static double share_of_root(const cgt_kd_rules *rules, const cgt_kd_box *box)
{
    return cgt_kd_half_area(box) / rules->root_area;
}

void cgt_kd_add_leaf(const cgt_kd_rules *rules, cgt_kd_output *out, uint32_t node, const cgt_kd_box *box,
                     const cgt_kd_item *item, uint32_t count)
{
    double weight = 0;
    out->node[node] = cgt_kd_leaf_node(count, out->next_reference);
    if (!count)
        return;
    for (uint32_t i = 0; i < count; i++) {
        out->reference[out->next_reference + i] = item[i].prim;
        weight += item[i].weight;
    }
    out->next_reference += count;
    out->cost += weight * share_of_root(rules, box);
}

uint32_t cgt_kd_add_inner(const cgt_kd_rules *rules, cgt_kd_output *out, uint32_t node, const cgt_kd_box *box,
                          const cgt_kd_plane *plane)
{
    const uint32_t lower = out->next_node;
    out->next_node += 2;
    out->node[node] = cgt_kd_inner(plane->axis, plane->split, lower);
    out->cost += rules->costs.inner * share_of_root(rules, box);
    return lower;
}

cgt_kd_ends cgt_kd_share_room(cgt_kd_output *out, uint32_t items, uint32_t sibling_items)
{
    const uint64_t item_sum = (uint64_t)items + sibling_items;
    const cgt_kd_ends ends = {out->end_node, out->end_reference};
    if (!item_sum)
        return ends;
    const uint32_t pairs = (out->end_node - out->next_node) / 2;
    const uint64_t spare_references = out->end_reference - out->next_reference - item_sum;
    out->end_node = out->next_node + 2 * (uint32_t)(pairs * (uint64_t)items / item_sum);
    out->end_reference = out->next_reference + items + (uint32_t)(spare_references * items / item_sum);
    return ends;
}

uint32_t cgt_kd_cut_off(const cgt_kd_rules *rules, cgt_kd_output *out, uint32_t node, cgt_kd_box *box,
                        const cgt_kd_plane *plane)
{
    const uint32_t lower = cgt_kd_add_inner(rules, out, node, box, plane), full_side = plane->lower_empty;
    cgt_kd_add_leaf(rules, out, lower + !full_side, box, NULL, 0);
    *box = cgt_kd_child_box(box, plane->axis, plane->split, full_side);
    return lower + full_side;
}

cgt_kd_step cgt_kd_next_step(const cgt_kd_rules *rules, cgt_kd_output *out, const cgt_kd_plane *plane, uint32_t count,
                             size_t room, uint32_t *node, uint32_t *depth, cgt_kd_box *box)
{
    if (plane->axis == 3)
        return CGT_KD_STOP;
    if (*depth == rules->max_leaf_depth || !cgt_kd_has_room(out, count, room)) {
        out->limited_leaves++;
        return CGT_KD_STOP;
    }
    if (!plane->lower_empty && !plane->upper_empty)
        return CGT_KD_DIVIDE;
    *node = cgt_kd_cut_off(rules, out, *node, box, plane);
    ++*depth;
    return CGT_KD_CUT;
}
