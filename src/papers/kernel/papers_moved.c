/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Moved rays (query/moved_ray.h) through the structures of the papers. */
#include "kernel/moved/moved_cells.h"
#include "papers/model/paper_structures.h"

/* ---- kd-tree ---- */

typedef struct moved_kd_entry {
    double near, far;
    uint32_t node;
} moved_kd_entry;

/* Descends to a leaf; children that the ray may reach later go to the stack. An interval ends a little beyond the split
 * on either side, by the bounds of moved_ray_clip. */
static uint32_t moved_descend(const moved_query *u, moved_kd_entry entry, moved_kd_entry *stack, uint32_t *top)
{
    const cgt_kd_tree *tree = &u->committed_scene->papers->kd;
    for (cgt_kd_node n = tree->node[entry.node]; !cgt_kd_is_leaf(n); n = tree->node[entry.node]) {
        const uint32_t a = cgt_kd_axis(n), upper_first = u->moved.dir[a] < 0;
        const double split = (double)cgt_kd_split(n) * (double)u->committed_scene->scale;
        moved_kd_entry part[2] = {entry, entry}; /* below, above */
        const bool below = moved_ray_clip(&u->moved, (int)a, -8, split, &part[0].near, &part[0].far);
        const bool above = moved_ray_clip(&u->moved, (int)a, split, 8, &part[1].near, &part[1].far);
        u->counts->nodes++;
        part[0].node = n.word[1];
        part[1].node = n.word[1] + 1;
        if (below && above)
            stack[(*top)++] = part[!upper_first];
        entry = below && above ? part[upper_first] : part[above];
    }
    return entry.node;
}

static void moved_trace_kd(moved_query *u)
{
    const cgt_kd_tree *tree = &u->committed_scene->papers->kd;
    moved_kd_entry stack[CGT_KD_MAX_DEPTH + 1], entry = {u->moved.near, u->moved.far, 0};
    uint32_t top = 0;
    for (;;) {
        const cgt_kd_node *leaf = &tree->node[moved_descend(u, entry, stack, &top)];
        u->counts->leaves++;
        u->counts->references += cgt_kd_count(*leaf);
        if (cgt_kd_count(*leaf))
            moved_test_prims(u, cgt_kd_references(tree, leaf), cgt_kd_count(*leaf));
        do {
            if (!top || u->done)
                return;
            entry = stack[--top];
        } while (entry.near > (double)u->high);
    }
}

/* ---- BIH ---- */

/* Steps from an inner node: entry becomes the child that the ray passes first, and the other one goes to the stack.
 * False where it passes none. */
static bool moved_bih_step(const moved_query *u, const cgt_bih_node *n, moved_kd_entry *entry, moved_kd_entry *stack,
                           uint32_t *top)
{
    const int a = (int)cgt_bih_axis(n);
    const uint32_t child = n->word[3], upper_first = u->moved.dir[a] < 0;
    const double scale = (double)u->committed_scene->scale, plane0 = (double)cgt_bih_plane(n, 0) * scale,
                 plane1 = (double)cgt_bih_plane(n, 1) * scale;
    moved_kd_entry part[2] = {*entry, *entry}; /* of the lower child, of the upper one */
    part[0].node = child;
    part[1].node = child + 1;
    if (cgt_bih_is_clip(n)) {
        *entry = part[0];
        return moved_ray_clip(&u->moved, a, plane0, plane1, &entry->near, &entry->far);
    }
    const bool below = moved_ray_clip(&u->moved, a, -8, plane0, &part[0].near, &part[0].far);
    const bool above = moved_ray_clip(&u->moved, a, plane1, 8, &part[1].near, &part[1].far);
    if (below && above)
        stack[(*top)++] = part[!upper_first];
    *entry = below && above ? part[upper_first] : part[above];
    return below || above;
}

static void moved_trace_bih(moved_query *u)
{
    const cgt_bih *tree = &u->committed_scene->papers->bih;
    moved_kd_entry stack[CGT_BIH_MAX_DEPTH], entry = {u->moved.near, u->moved.far, 0};
    uint32_t top = 0;
    for (;;) {
        const cgt_bih_node *n = &tree->node[entry.node];
        bool passes = true;
        for (; passes && !cgt_bih_is_leaf(n); n = &tree->node[entry.node]) {
            u->counts->nodes++;
            passes = moved_bih_step(u, n, &entry, stack, &top);
        }
        if (passes) {
            u->counts->leaves++;
            u->counts->references += cgt_bih_count(n);
            moved_test_prims(u, cgt_bih_references(tree, n), cgt_bih_count(n));
        }
        do {
            if (!top || u->done)
                return;
            entry = stack[--top];
        } while (entry.near > (double)u->high);
    }
}

/* ---- queue grid ---- */

static void moved_visit_queue(moved_query *u, const void *of, const uint32_t cell[3])
{
    const cgt_queue_grid *grid = of;
    const uint32_t number = cell[0] * grid->stride[0] + cell[1] * grid->stride[1] + cell[2] * grid->stride[2];
    uint32_t prim[CGT_QUEUE_LENGTH], count = 0;
    for (; count < CGT_QUEUE_LENGTH; count++) {
        prim[count] =
            grid->refs_are_32_bits ? grid->voxel32[number].reference[count] : grid->voxel[number].reference[count];
        if (prim[count] == (grid->refs_are_32_bits ? CGT_INVALID_ID : CGT_QUEUE_NONE))
            break;
    }
    u->counts->cells++;
    u->counts->references += count;
    moved_test_prims(u, prim, count);
    if (count < CGT_QUEUE_LENGTH || !grid->overflows)
        return;
    for (uint32_t i = cgt_queue_grid_overflow(grid, number); i < grid->overflows && grid->overflow[i].cell == number;
         i++)
        moved_test_prims(u, &grid->overflow[i].reference, 1);
}

/* Points beyond the grid count as in its outermost cells: by rounding, which is in cell_error. */
static void moved_trace_queue_grid(moved_query *u)
{
    const cgt_queue_grid *grid = &u->committed_scene->papers->grid;
    const double scale = (double)u->committed_scene->scale;
    moved_grid g;
    for (int a = 0; a < 3; a++) {
        g.low[a] = (double)grid->org[a] * scale;
        g.cell[a] = scale / (double)grid->rcell[a];
        g.rcell[a] = 1 / g.cell[a];
        g.reach[a] = (double)grid->cell_error[a] * g.cell[a];
        g.size[a] = grid->resolution[a];
    }
    moved_visit_cells(u, &g, moved_visit_queue, grid);
}

/* ---- any ---- */

void CGT_KERNEL(cgt_papers_trace_unusual)(moved_query *u)
{
    switch ((int)u->committed_scene->structure) {
    case CGT_STRUCTURE_QUEUE_GRID: moved_trace_queue_grid(u); break;
    case CGT_STRUCTURE_BIH: moved_trace_bih(u); break;
    default: moved_trace_kd(u); break;
    }
}
