/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A recount of queue grids. */
#include "grid/queue_grid_check.h"

static uint32_t reference_at(const cgt_queue_grid *g, uint32_t cell, int i)
{
    if (g->refs_are_32_bits)
        return g->voxel32[cell].reference[i];
    const uint32_t reference = g->voxel[cell].reference[i];
    return reference == CGT_QUEUE_NONE ? CGT_INVALID_ID : reference;
}

bool cell_holds(const cgt_queue_grid *g, uint32_t cell, uint32_t prim)
{
    unsigned found = 0;
    for (int i = 0; i < CGT_QUEUE_LENGTH; i++)
        found += reference_at(g, cell, i) == prim;
    for (uint32_t i = cgt_queue_grid_overflow(g, cell); i < g->overflows && g->overflow[i].cell == cell; i++)
        found += g->overflow[i].reference == prim;
    if (found > 1)
        fail_msg("cell %u holds primitive %u %u times", cell, prim, found);
    return found == 1;
}

/* Queues fill from the front, newest first. Returns how many references a cell's has. */
static int check_queue(const cgt_queue_grid *g, uint32_t cell)
{
    int used = 0;
    while (used < CGT_QUEUE_LENGTH && reference_at(g, cell, used) != CGT_INVALID_ID)
        used++;
    for (int i = 0; i < used; i++)
        assert_true(reference_at(g, cell, i) < (i ? reference_at(g, cell, i - 1) : g->prims->count));
    for (int i = used; i < CGT_QUEUE_LENGTH; i++)
        assert_int_equal(reference_at(g, cell, i), CGT_INVALID_ID);
    return used;
}

/* The overflow list is sorted by cell and holds older references. Returns all references. */
static uint64_t check_order(const cgt_queue_grid *g, uint32_t *overflow_cells)
{
    uint64_t references = g->overflows;
    *overflow_cells = 0;
    for (uint32_t cell = 0; cell < g->cells; cell++) {
        const int used = check_queue(g, cell);
        const uint32_t first = cgt_queue_grid_overflow(g, cell);
        references += (uint64_t)used;
        if (first == g->overflows)
            continue;
        assert_int_equal(used, CGT_QUEUE_LENGTH);
        ++*overflow_cells;
        for (uint32_t i = first; i < g->overflows && g->overflow[i].cell == cell; i++)
            assert_true(g->overflow[i].reference < reference_at(g, cell, CGT_QUEUE_LENGTH - 1));
    }
    for (uint32_t i = 1; i < g->overflows; i++)
        assert_true(g->overflow[i].cell >= g->overflow[i - 1].cell);
    return references;
}

cgt_research_scene_statistics queue_grid_check(const cgt_scene *scene)
{
    const cgt_research_scene_statistics s = research_of(scene);
    const cgt_paper_structures *papers = scene->committed_scene.papers;
    uint64_t references = 0;
    uint32_t overflow_cells = 0;
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_int_equal(st.structure, CGT_STRUCTURE_QUEUE_GRID);
    assert_true(st.reason[0] && memchr(st.reason, 0, sizeof st.reason));
    assert_int_equal((uint64_t)s.resolution[0] * s.resolution[1] * s.resolution[2], s.cells);
    if (papers) {
        references = check_order(&papers->grid, &overflow_cells);
        assert_int_equal(s.reference_bits, st.primitives > CGT_QUEUE_MAX_REFS16 ? 32 : 16);
    }
    assert_int_equal(s.references, references);
    assert_int_equal(s.overflow_references, papers ? papers->grid.overflows : 0);
    assert_int_equal(s.overflow_cells, overflow_cells);
    return s;
}
