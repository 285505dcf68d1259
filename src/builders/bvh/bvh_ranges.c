/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The ranges of cells, each the work of one task. They are subtrees of the binary tree over all cells: within each part
 * by the bits of its keys, then over the parts by halves. A node exists only where both sides hold primitives. A tree
 * over consecutive items is described by the depths at which neighbours part. */
#include "builders/bvh/bvh_build.h"

/* The part's cells that are still to be visited, the first ones last. */
typedef struct range_stack {
    struct {
        uint32_t cell, bits, depth, parting;
    } entry[CGT_BVH_KEY_BITS + 2];
    uint32_t count;
} range_stack;

static void push_cells(range_stack *s, uint32_t cell, uint32_t bits, uint32_t depth, uint32_t parting)
{
    s->entry[s->count].cell = cell;
    s->entry[s->count].bits = bits;
    s->entry[s->count].depth = depth;
    s->entry[s->count++].parting = parting;
}

/* Finds, for parts in a row that are halved again and again, how deep part k lies, and at which depth it parts from the
 * one before. */
static void locate_part(uint32_t parts, uint32_t k, uint32_t *depth, uint32_t *parting)
{
    uint32_t first = 0, end = parts;
    *parting = 0;
    for (*depth = 0; end - first > 1; ++*depth) {
        const uint32_t middle = first + (end - first + 1) / 2;
        if (k == middle)
            *parting = *depth;
        if (k < middle)
            end = middle;
        else
            first = middle;
    }
}

typedef struct range_list {
    const uint32_t *start;
    cgt_bvh_range *range; /* NULL: only counted */
    uint32_t count, most;
    cgt_kind kind;
} range_list;

static void add_range(range_list *l, uint32_t cell, uint32_t bits, uint32_t depth, uint32_t parting)
{
    if (l->range)
        l->range[l->count] = (cgt_bvh_range){.kind = l->kind,
                                             .cell = cell,
                                             .bits = bits,
                                             .begin = l->start[cell],
                                             .end = l->start[cell + (UINT32_C(1) << bits)],
                                             .depth = depth,
                                             .parting = parting};
    l->count++;
}

static void list_part(range_list *l, const cgt_bvh_part *part, uint32_t depth, uint32_t parting)
{
    range_stack s = {.count = 0};
    push_cells(&s, part->first, part->curve.bits, depth, parting);
    while (s.count) {
        const uint32_t i = --s.count, cell = s.entry[i].cell, bits = s.entry[i].bits, node_depth = s.entry[i].depth;
        const uint32_t previous_parting = s.entry[i].parting, half = (UINT32_C(1) << bits) / 2;
        const uint32_t begin = l->start[cell], end = l->start[cell + (UINT32_C(1) << bits)];
        if (!bits || end - begin <= l->most) {
            add_range(l, cell, bits, node_depth, previous_parting);
            continue;
        }
        const uint32_t middle = l->start[cell + half];
        const bool splits = middle > begin && middle < end;
        if (middle < end)
            push_cells(&s, cell + half, bits - 1, node_depth + splits, splits ? node_depth : previous_parting);
        if (middle > begin)
            push_cells(&s, cell, bits - 1, node_depth + splits, previous_parting);
    }
}

static bool part_is_used(const cgt_bvh_part *part, const uint32_t *start)
{
    return start[part->first] < start[part->first + (UINT32_C(1) << part->curve.bits)];
}

uint32_t cgt_bvh_list_ranges(const cgt_bvh_plan *plan, const uint32_t *start, uint32_t prims, uint32_t prims_each,
                             cgt_bvh_range *range)
{
    const uint32_t share = prims / CGT_BVH_RANGES, parts = plan->first[CGT_KINDS];
    const uint32_t least = CGT_BVH_RANGE_PRIMS / prims_each;
    range_list l = {.start = start, .range = range, .most = share > least ? share : least};
    uint32_t used_parts = 0, k = 0, depth, parting;
    for (uint32_t i = 0; i < parts; i++)
        used_parts += part_is_used(&plan->part[i], start);
    l.kind = CGT_KIND_SPHERES;
    for (uint32_t i = 0; i < parts; i++) {
        if (!part_is_used(&plan->part[i], start))
            continue;
        locate_part(used_parts, k++, &depth, &parting);
        while (i >= plan->first[l.kind + 1])
            l.kind++;
        list_part(&l, &plan->part[i], depth, parting);
    }
    return l.count;
}
