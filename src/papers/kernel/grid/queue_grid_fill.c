/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fills the queue grid (Chapman, section 3.4): the corners of the bounds are found for a vector of primitives at once,
 * and pushed as eight references each. Chapman assumes primitives smaller than a cell; here, a primitive whose corners
 * are more than one cell apart on any axis is pushed to every cell of its bounds that it touches. */
#include "exact/valid_primitive.h"
#include "kernel/builders/triangle_box.h"
#include "papers/kernel/grid/queue_push.h"
#include "papers/kernel/paper_kernels.h"
#include "papers/kernel/spu_programs.h"

/* Bounds of a vector of primitives, and the cells of their lower and upper corners, per axis. */
typedef struct corners {
    _Alignas(CGT_VECTOR_BYTES) float lowest[3][CGT_LANES];
    _Alignas(CGT_VECTOR_BYTES) float highest[3][CGT_LANES];
    int32_t low[3][CGT_LANES];
    int32_t high[3][CGT_LANES];
    bool valid[CGT_LANES];
} corners;

static void compute_corner_cells(const cgt_queue_grid *grid, corners *c)
{
    for (int a = 0; a < 3; a++) {
        const vfloat org = spux_vfloat(grid->org[a]), rcell = spux_vfloat(grid->rcell[a]);
        const vfloat cell_error = spux_vfloat(grid->cell_error[a]),
                     last = spux_vfloat((float)(grid->resolution[a] - 1));
        const vfloat zero = spux_vfloat(0);
        const vfloat low = spu_sub(spu_mul(spu_sub(spux_load(c->lowest[a]), org), rcell), cell_error);
        const vfloat high = spu_add(spu_mul(spu_sub(spux_load(c->highest[a]), org), rcell), cell_error);
        /* clamped before the conversion: towards zero is down then */
        const vint l = spu_convts(spux_min(spux_max(low, zero), last), 0);
        const vint h = spu_convts(spux_min(spux_max(high, zero), last), 0);
        memcpy(c->low[a], &l, sizeof l);
        memcpy(c->high[a], &h, sizeof h);
    }
}

/* ---- pushes ---- */

/* CGT_INVALID_ID where the queue is not full. */
CGT_SPU_INLINE uint32_t oldest_reference(const cgt_queue_grid *grid, uint32_t cell)
{
    if (grid->refs_are_32_bits)
        return grid->voxel32[cell].reference[CGT_QUEUE_LENGTH - 1];
    const uint16_t oldest = grid->voxel[cell].reference[CGT_QUEUE_LENGTH - 1];
    return oldest == CGT_QUEUE_NONE ? CGT_INVALID_ID : oldest;
}

static void save_oldest(const cgt_queue_grid *grid, uint32_t cell, cgt_overflow_list *overflow)
{
    const uint32_t oldest = oldest_reference(grid, cell);
    if (oldest == CGT_INVALID_ID)
        return;
    overflow->entry[overflow->count++] = (cgt_overflow){cell, oldest};
}

/* Saves the oldest reference of each different cell whose queue is full. */
static void save_oldest8(const cgt_queue_grid *grid, const uint32_t cell[8], cgt_overflow_list *overflow)
{
    for (int k = 0; k < 8; k++) {
        bool duplicate = false;
        for (int j = 0; j < k; j++)
            duplicate |= cell[j] == cell[k];
        if (!duplicate)
            save_oldest(grid, cell[k], overflow);
    }
}

static void push1(const cgt_queue_grid *grid, uint32_t cell, uint32_t prim, cgt_overflow_list *overflow)
{
    save_oldest(grid, cell, overflow);
    if (grid->refs_are_32_bits)
        queue_push1_32(&grid->voxel32[cell], spu_splats(prim));
    else
        queue_push1(&grid->voxel[cell], spu_splats((uint16_t)prim));
}

static void push_corners(const cgt_queue_grid *grid, const corners *c, int lane, uint32_t prim,
                         cgt_overflow_list *overflow)
{
    const uint32_t *stride = grid->stride;
    const uint32_t x[2] = {(uint32_t)c->low[0][lane], (uint32_t)c->high[0][lane]};
    const uint32_t y[2] = {(uint32_t)c->low[1][lane] * stride[1], (uint32_t)c->high[1][lane] * stride[1]};
    const uint32_t z[2] = {(uint32_t)c->low[2][lane] * stride[2], (uint32_t)c->high[2][lane] * stride[2]};
    uint32_t cell[8], oldest = CGT_INVALID_ID;
    for (int k = 0; k < 8; k++)
        cell[k] = x[k & 1] + y[k >> 1 & 1] + z[k >> 2];
    for (int k = 0; k < 8; k++)
        oldest &= oldest_reference(grid, cell[k]);
    if (oldest != CGT_INVALID_ID)
        save_oldest8(grid, cell, overflow);
    if (grid->refs_are_32_bits)
        queue_push8_32(grid->voxel32, cell, prim);
    else
        queue_push8(grid->voxel, cell, spu_splats((uint16_t)prim));
}

/* ---- primitives of more than eight corners ---- */

/* Distance from a coordinate to the slab of cells i, in world units, never more than it is. */
static float slab_distance(const cgt_queue_grid *grid, int axis, int32_t i, float p)
{
    const float g = (p - grid->org[axis]) * grid->rcell[axis], cell_error = grid->cell_error[axis];
    const float d = g < (float)i ? (float)i - g : g > (float)(i + 1) ? g - (float)(i + 1) : 0;
    return d > cell_error ? SCALAR_DIVIDE(d - cell_error, grid->rcell[axis]) * (1 - 0x1p-20f) : 0;
}

static uint64_t push_large_sphere(const cgt_queue_grid *grid, const corners *c, int lane, uint32_t prim,
                                  cgt_overflow_list *overflow)
{
    const cgt_sphere q = cgt_primitives_sphere(grid->prims, prim);
    const float reach = q.r * q.r * (1 + 0x1p-20f);
    uint64_t pushed = 0;
    for (int32_t z = c->low[2][lane]; z <= c->high[2][lane]; z++) {
        const float dz = slab_distance(grid, 2, z, q.z);
        for (int32_t y = c->low[1][lane]; y <= c->high[1][lane]; y++) {
            const float dy = slab_distance(grid, 1, y, q.y), room = reach - dz * dz - dy * dy;
            for (int32_t x = c->low[0][lane]; x <= c->high[0][lane]; x++) {
                const float dx = slab_distance(grid, 0, x, q.x);
                /* the bounds' own corners are always taken where squares underflow: room is then 0 and dx * dx too */
                if (dx * dx > room + 0x1p-20f * reach)
                    continue;
                push1(grid, (uint32_t)x + (uint32_t)y * grid->stride[1] + (uint32_t)z * grid->stride[2], prim,
                      overflow);
                pushed++;
            }
        }
    }
    return pushed;
}

/* In grid space, where a cell is a box of edge 1, widened by the slack. */
static uint64_t push_large_triangle(const cgt_queue_grid *grid, const corners *c, int lane, uint32_t prim,
                                    cgt_overflow_list *overflow)
{
    const cgt_triangle q = cgt_primitives_triangle(grid->prims, prim);
    cgt_triangle_box box;
    double v[3][3], half[3];
    uint64_t pushed = 0;
    for (int a = 0; a < 3; a++) {
        half[a] = 0.5 + (double)grid->cell_error[a] + 0x1p-20;
        for (int k = 0; k < 3; k++)
            v[k][a] = ((double)q.v[k][a] - (double)grid->org[a]) * (double)grid->rcell[a];
    }
    cgt_triangle_box_init((const double(*)[3])v, half, &box);
    for (int32_t z = c->low[2][lane]; z <= c->high[2][lane]; z++)
        for (int32_t y = c->low[1][lane]; y <= c->high[1][lane]; y++)
            for (int32_t x = c->low[0][lane]; x <= c->high[0][lane]; x++) {
                const double center[3] = {x + 0.5, y + 0.5, z + 0.5};
                if (!cgt_triangle_box_touches(&box, center))
                    continue;
                push1(grid, (uint32_t)x + (uint32_t)y * grid->stride[1] + (uint32_t)z * grid->stride[2], prim,
                      overflow);
                pushed++;
            }
    return pushed;
}

/* ---- the whole ---- */

/* Pushes the primitives of one vector; returns how many of them it got to. */
static uint32_t push_vector(const cgt_queue_grid *grid, const corners *c, uint32_t prim, uint32_t count,
                            cgt_overflow_list *overflow, cgt_fill_counts *counts)
{
    for (uint32_t lane = 0; lane < count; lane++) {
        uint32_t span[3], touched_cells = 1;
        if (!c->valid[lane])
            continue;
        for (int a = 0; a < 3; a++) {
            span[a] = (uint32_t)(c->high[a][lane] - c->low[a][lane]) + 1;
            touched_cells *= span[a];
        }
        const bool small = span[0] <= 2 && span[1] <= 2 && span[2] <= 2;
        if (overflow->capacity - overflow->count < touched_cells) {
            overflow->needed_entries = touched_cells;
            return lane;
        }
        if (small)
            push_corners(grid, c, (int)lane, prim + lane, overflow);
        else {
            const bool sphere = cgt_primitives_array(grid->prims, prim + lane)->kind == CGT_KIND_SPHERES;
            touched_cells = (uint32_t)(sphere ? push_large_sphere(grid, c, (int)lane, prim + lane, overflow)
                                              : push_large_triangle(grid, c, (int)lane, prim + lane, overflow));
            counts->large_primitives++;
        }
        counts->references += touched_cells;
    }
    return count;
}

static void bound_sphere(corners *c, uint32_t lane, cgt_sphere q)
{
    const float center[3] = {q.x, q.y, q.z};
    c->valid[lane] = cgt_sphere_check(q) == CGT_PRIMITIVE_VALID;
    for (int a = 0; a < 3; a++) {
        c->lowest[a][lane] = c->valid[lane] ? center[a] - q.r : 0;
        c->highest[a][lane] = c->valid[lane] ? center[a] + q.r : 0;
    }
}

static void bound_triangle(corners *c, uint32_t lane, const cgt_triangle *q)
{
    c->valid[lane] = cgt_triangle_check(q) == CGT_PRIMITIVE_VALID;
    for (int a = 0; a < 3; a++) {
        const float p = q->v[0][a], r = q->v[1][a], s = q->v[2][a];
        const float low = p < r ? p : r, high = p < r ? r : p;
        c->lowest[a][lane] = c->valid[lane] ? low < s ? low : s : 0;
        c->highest[a][lane] = c->valid[lane] ? high > s ? high : s : 0;
    }
}

static void bound_vector(const cgt_queue_grid *grid, uint32_t prim, uint32_t count, corners *c)
{
    for (uint32_t lane = 0; lane < count; lane++) {
        const cgt_primitive_array *a = cgt_primitives_array(grid->prims, prim + lane);
        const uint32_t i = prim + lane - a->first;
        if (a->kind == CGT_KIND_SPHERES)
            bound_sphere(c, lane, cgt_array_sphere(a, i));
        else {
            const cgt_triangle q = cgt_array_triangle(a, i);
            bound_triangle(c, lane, &q);
        }
    }
    for (uint32_t lane = count; lane < CGT_LANES; lane++)
        for (int a = 0; a < 3; a++)
            c->lowest[a][lane] = c->highest[a][lane] = 0;
}

uint32_t CGT_KERNEL(cgt_queue_grid_fill)(const cgt_queue_grid *grid, uint32_t first, uint32_t end,
                                         cgt_overflow_list *overflow, cgt_fill_counts *counts)
{
    corners c;
    for (uint32_t prim = first; prim < end;) {
        const uint32_t count = end - prim < CGT_LANES ? end - prim : CGT_LANES;
        bound_vector(grid, prim, count, &c);
        compute_corner_cells(grid, &c);
        const uint32_t done = push_vector(grid, &c, prim, count, overflow, counts);
        prim += done;
        if (done < count)
            return prim;
    }
    return end;
}
