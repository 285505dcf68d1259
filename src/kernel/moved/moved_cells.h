/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A moved ray (moved_ray.h) through the cells of a grid, in double: slice by slice along the largest component of its
 * direction, whatever that is. In each slice, a box of cells and their reach, the part of the ray is a box again, whose
 * cells are visited. Cells are computed within 2^-40 of their number and of the ray's error, and widened by that. */
#ifndef CGT_MOVED_CELLS_H
#define CGT_MOVED_CELLS_H

#include "kernel/moved/moved_prims.h"

/* Through a structure of the papers. */
void CGT_KERNEL(cgt_papers_trace_unusual)(moved_query *u);

/* A grid in the space of the scene's scale. What cell i of an axis holds lies from low + i cell - reach to
 * low + (i + 1) cell + reach. */
typedef struct moved_grid {
    double low[3], cell[3], reach[3];
    double rcell[3]; /* 1 / cell */
    uint32_t size[3];
} moved_grid;

/* Tests what cell (x, y, z) holds. */
typedef void moved_visit(moved_query *u, const void *of, const uint32_t cell[3]);

/* Cells of axis a, from the first to the last, that hold anything between two coordinates; false: none. */
static bool moved_cells(const moved_grid *g, int a, double low, double high, uint32_t cells[2])
{
    const double first = (low - g->reach[a] - g->low[a]) * g->rcell[a],
                 last = (high + g->reach[a] - g->low[a]) * g->rcell[a];
    const double pad = (fabs(low) + fabs(high) + fabs(g->low[a]) + g->reach[a]) * g->rcell[a] * 0x1p-40 + 0x1p-40;
    const double most = g->size[a] - 1, begin = floor(first - pad), end = floor(last + pad);
    if (begin > most || end < 0)
        return false;
    cells[0] = begin > 0 ? (uint32_t)begin : 0;
    cells[1] = end < most ? (uint32_t)end : (uint32_t)most;
    return true;
}

/* The same of what the ray may meet between two T'. */
static bool moved_cells_between(const moved_query *u, const moved_grid *g, int a, double near, double far,
                                uint32_t cells[2])
{
    const moved_ray *m = &u->moved;
    const double p = m->org[a] + near * m->dir[a], q = m->org[a] + far * m->dir[a];
    const double error = m->org_error[a] + (fabs(m->org[a]) + (fabs(near) + fabs(far)) * fabs(m->dir[a])) * 0x1p-50;
    return moved_cells(g, a, (p < q ? p : q) - error, (p < q ? q : p) + error, cells);
}

/* Visits the cells of slice k of the main axis w that the ray may need; false: no later slice has any. */
static bool moved_visit_slice(moved_query *u, const moved_grid *g, int w, uint32_t k, moved_visit *visit,
                              const void *of)
{
    const int v[2] = {(w + 1) % 3, (w + 2) % 3};
    const double low = g->low[w] + k * g->cell[w] - g->reach[w], high = g->low[w] + (k + 1) * g->cell[w] + g->reach[w];
    const double pad = (fabs(g->low[w]) + high - low + k * g->cell[w]) * 0x1p-48;
    double near = u->moved.near, far = u->moved.far;
    uint32_t box[2][2], cell[3];
    if (!moved_ray_clip(&u->moved, w, low - pad, high + pad, &near, &far))
        return true;
    if (near > (double)u->high)
        return false;
    for (int i = 0; i < 2; i++)
        if (!moved_cells_between(u, g, v[i], near, far, box[i]))
            return true;
    cell[w] = k;
    for (uint32_t i = box[0][0]; i <= box[0][1]; i++)
        for (uint32_t j = box[1][0]; j <= box[1][1] && !u->done; j++) {
            cell[v[0]] = i;
            cell[v[1]] = j;
            visit(u, of, cell);
        }
    return !u->done;
}

/* Visits all cells that the ray may need. */
static void moved_visit_cells(moved_query *u, const moved_grid *g, moved_visit *visit, const void *of)
{
    const double *d = u->moved.dir;
    const int larger = fabs(d[1]) > fabs(d[0]), w = fabs(d[2]) > fabs(d[larger]) ? 2 : larger;
    uint32_t slices[2];
    if (!moved_cells_between(u, g, w, u->moved.near, u->moved.far, slices))
        return;
    for (uint32_t i = slices[0]; i <= slices[1]; i++)
        if (!moved_visit_slice(u, g, w, d[w] > 0 ? i : slices[1] - (i - slices[0]), visit, of))
            return;
}

#endif
