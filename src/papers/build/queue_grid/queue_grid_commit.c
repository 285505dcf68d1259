/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The queue grid of a commit: planned, filled, and what overflowed sorted by cell. */
#include <string.h>

#include "builders/report.h"
#include "papers/build/papers_build.h"
#include "papers/kernel/paper_kernels.h"

/* ---- filling ---- */

/* Room in the overflow list to begin with: a push needs as much as it might spill, though it rarely spills. */
#define MIN_OVERFLOW 1024

static cgt_result fill(cgt_scene *scene)
{
    cgt_context *c = scene->context;
    cgt_queue_grid *g = &scene->committed_scene.papers->grid;
    cgt_overflow_list list = {.entry = scene->buffer[CGT_BUFFER_OVERFLOW].data,
                              .capacity = (uint32_t)(scene->buffer[CGT_BUFFER_OVERFLOW].bytes / sizeof(cgt_overflow))};
    cgt_fill_counts counts = {0};
    const size_t voxel_bytes = cgt_queue_grid_voxel_bytes(g);
    const cgt_result result =
        cgt_buffer_reserve(&c->memory, &scene->buffer[CGT_BUFFER_VOXELS], g->max_cells, voxel_bytes);
    if (result != CGT_OK)
        return cgt_fail(c, result, "commit: out of memory for %u voxels of %zu bytes", g->max_cells, voxel_bytes);
    g->voxel = scene->buffer[CGT_BUFFER_VOXELS].data;
    g->voxel32 = scene->buffer[CGT_BUFFER_VOXELS].data;
    memset(scene->buffer[CGT_BUFFER_VOXELS].data, 0xff, g->cells * voxel_bytes);
    for (uint32_t prim = 0; prim < g->prims->count;) {
        prim = c->kernel->papers->queue_grid_fill(g, prim, g->prims->count, &list, &counts);
        if (prim == g->prims->count)
            break;
        const uint64_t needed = (uint64_t)list.count + list.needed_entries;
        const uint64_t needed_entries = needed < MIN_OVERFLOW ? MIN_OVERFLOW : needed;
        const cgt_result grown = needed_entries > UINT32_MAX
                                     ? CGT_ERROR_TOO_LARGE
                                     : cgt_buffer_grow(&c->memory, &scene->buffer[CGT_BUFFER_OVERFLOW],
                                                       (size_t)needed_entries, sizeof(cgt_overflow));
        if (grown != CGT_OK)
            return cgt_fail(c, grown, "commit: out of memory for %llu overflow references",
                            (unsigned long long)needed_entries);
        list.entry = scene->buffer[CGT_BUFFER_OVERFLOW].data;
        list.capacity = (uint32_t)(scene->buffer[CGT_BUFFER_OVERFLOW].bytes / sizeof(cgt_overflow));
    }
    g->overflow = list.entry;
    g->overflows = list.count;
    scene->research_statistics.references = counts.references;
    scene->research_statistics.large_primitives = counts.large_primitives;
    return CGT_OK;
}

/* ---- sorting: two passes of 12 bits, since there are at most 2^24 cells; the order within a cell stays ---- */

static void sort_pass(const cgt_overflow *from, cgt_overflow *to, uint32_t count, unsigned shift)
{
    uint32_t start[4096] = {0}, sum = 0;
    for (uint32_t i = 0; i < count; i++)
        start[from[i].cell >> shift & 4095]++;
    for (int k = 0; k < 4096; k++) {
        const uint32_t n = start[k];
        start[k] = sum;
        sum += n;
    }
    for (uint32_t i = 0; i < count; i++)
        to[start[from[i].cell >> shift & 4095]++] = from[i];
}

static cgt_result sort_overflow(cgt_scene *scene)
{
    cgt_queue_grid *g = &scene->committed_scene.papers->grid;
    const cgt_result result = cgt_buffer_grow(&scene->context->memory, &scene->buffer[CGT_BUFFER_OVERFLOW_SORTING],
                                              g->overflows, sizeof(cgt_overflow));
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory to sort %u overflow references", g->overflows);
    cgt_overflow *entry = scene->buffer[CGT_BUFFER_OVERFLOW].data;
    sort_pass(entry, scene->buffer[CGT_BUFFER_OVERFLOW_SORTING].data, g->overflows, 0);
    sort_pass(scene->buffer[CGT_BUFFER_OVERFLOW_SORTING].data, entry, g->overflows, 12);
    scene->research_statistics.overflow_references = g->overflows;
    for (uint32_t i = 0; i < g->overflows; i++)
        scene->research_statistics.overflow_cells += i == 0 || entry[i].cell != entry[i - 1].cell;
    return CGT_OK;
}

/* ---- the whole ---- */

static void report(cgt_scene *scene)
{
    cgt_scene_statistics *st = &scene->statistics;
    cgt_research_scene_statistics *research = &scene->research_statistics;
    const cgt_queue_grid *g = &scene->committed_scene.papers->grid;
    bool small = true;
    for (int a = 0; a < 3; a++) {
        research->resolution[a] = g->resolution[a];
        small &= g->resolution[a] <= 16;
    }
    research->reference_bits = g->refs_are_32_bits ? 32 : 16;
    research->cells = g->cells;
    st->structure_bytes =
        (size_t)g->cells * cgt_queue_grid_voxel_bytes(g) + (size_t)g->overflows * sizeof(cgt_overflow);
    cgt_report_local_store(scene, sizeof(cgt_sphere), sizeof(cgt_triangle));
    research->fits_local_store &= small;
}

cgt_result cgt_queue_grid_commit(cgt_scene *scene, const cgt_primitive_bounds *bounds)
{
    cgt_queue_grid *g = &scene->committed_scene.papers->grid;
    g->prims = &scene->committed_scene.prims;
    cgt_result result = cgt_queue_grid_plan(g, bounds, scene->options.research->resolution, scene->statistics.reason);
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: the resolution is beyond the limits");
    result = fill(scene);
    if (result == CGT_OK && g->overflows)
        result = sort_overflow(scene);
    if (result == CGT_OK)
        report(scene);
    return result;
}
