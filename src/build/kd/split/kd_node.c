/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Nodes of a tree that is built, and what they cost by the surface-area heuristic. */
#include "build/kd/split/kd_builder.h"

static double share_of_root(const cgt_kd_rules *rules, const cgt_kd_box *box)
{
    return cgt_kd_half_area(box) / rules->root_area;
}

void cgt_kd_make_leaf(const cgt_kd_rules *rules, cgt_kd_output *out, uint32_t node, const cgt_kd_box *box,
                      const cgt_kd_item *item, uint32_t count)
{
    double weight = 0;
    out->node[node] = cgt_kd_leaf_node(count, out->next_reference);
    if (!count)
        return;
    for (uint32_t i = 0; i < count; i++) {
        out->reference[out->next_reference + i] = item[i].object;
        weight += item[i].weight;
    }
    out->next_reference += count;
    out->cost += weight * share_of_root(rules, box);
}

uint32_t cgt_kd_make_inner(const cgt_kd_rules *rules, cgt_kd_output *out, uint32_t node, const cgt_kd_box *box,
                           const cgt_kd_plane *plane)
{
    const uint32_t lower = out->next_node;
    out->next_node += 2;
    out->node[node] = cgt_kd_inner(plane->axis, plane->split, lower);
    out->cost += rules->costs.inner * share_of_root(rules, box);
    return lower;
}

void cgt_kd_share_room(cgt_kd_output *out, uint32_t items, uint32_t others)
{
    const uint64_t all = (uint64_t)items + others;
    if (!all)
        return;
    const uint32_t pairs = (out->end_node - out->next_node) / 2;
    const uint64_t spare = out->end_reference - out->next_reference - all;
    out->end_node = out->next_node + 2 * (uint32_t)(pairs * (uint64_t)items / all);
    out->end_reference = out->next_reference + items + (uint32_t)(spare * items / all);
}

uint32_t cgt_kd_cut_off(const cgt_kd_rules *rules, cgt_kd_output *out, uint32_t node, cgt_kd_box *box,
                        const cgt_kd_plane *plane)
{
    const uint32_t lower = cgt_kd_make_inner(rules, out, node, box, plane), kept = plane->lower_empty;
    cgt_kd_make_leaf(rules, out, lower + !kept, box, NULL, 0);
    *box = cgt_kd_child_box(box, plane->axis, plane->split, kept);
    return lower + kept;
}
