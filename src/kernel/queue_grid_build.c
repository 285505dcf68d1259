/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fills the queue grid (Chapman, section 3.4): the corners of each sphere's bounds are found for a vector of spheres
 * at once, and pushed as eight references. He assumes spheres smaller than a cell; where the corners are more than one
 * cell apart on any axis, the sphere goes to every cell of its bounds that it touches. */
#include "kernel.h"
#include "queue_push.h"

/* Cells of the lower and upper corner of the bounds, per axis, of a vector of spheres. */
typedef struct corners {
    int32_t low[3][CGT_LANES];
    int32_t high[3][CGT_LANES];
} corners;

static void find_corners(const cgt_queue_grid *grid, const float center[3][CGT_LANES], const float radius[CGT_LANES],
                         corners *c)
{
    const vfloat r = spux_load(radius);
    for (int a = 0; a < 3; a++) {
        const vfloat p = spux_load(center[a]), org = spux_vfloat(grid->org[a]), rcell = spux_vfloat(grid->rcell[a]);
        const vfloat slack = spux_vfloat(grid->slack[a]), last = spux_vfloat((float)(grid->resolution[a] - 1));
        const vfloat zero = spux_vfloat(0);
        const vfloat low = spu_sub(spu_mul(spu_sub(spu_sub(p, r), org), rcell), slack);
        const vfloat high = spu_add(spu_mul(spu_sub(spu_add(p, r), org), rcell), slack);
        /* clamped before the conversion: towards zero is down then */
        const vint l = spu_convts(spux_min(spux_max(low, zero), last), 0);
        const vint h = spu_convts(spux_min(spux_max(high, zero), last), 0);
        memcpy(c->low[a], &l, sizeof l);
        memcpy(c->high[a], &h, sizeof h);
    }
}

static void save_oldest(const cgt_queue_grid *grid, uint32_t cell, cgt_overflow_list *overflow)
{
    const uint16_t oldest = grid->voxel[cell].reference[CGT_QUEUE_LENGTH - 1];
    if (oldest != CGT_QUEUE_NONE)
        overflow->entry[overflow->count++] = (cgt_overflow){cell, oldest};
}

/* Saves the oldest reference of each different cell whose queue is full. */
static void save_oldest8(const cgt_queue_grid *grid, const uint32_t cell[8], cgt_overflow_list *overflow)
{
    for (int k = 0; k < 8; k++) {
        bool seen = false;
        for (int j = 0; j < k; j++)
            seen |= cell[j] == cell[k];
        if (!seen)
            save_oldest(grid, cell[k], overflow);
    }
}

static void push_corners(const cgt_queue_grid *grid, const corners *c, int lane, uint32_t object,
                         cgt_overflow_list *overflow)
{
    const uint32_t *stride = grid->stride;
    const uint32_t x[2] = {(uint32_t)c->low[0][lane], (uint32_t)c->high[0][lane]};
    const uint32_t y[2] = {(uint32_t)c->low[1][lane] * stride[1], (uint32_t)c->high[1][lane] * stride[1]};
    const uint32_t z[2] = {(uint32_t)c->low[2][lane] * stride[2], (uint32_t)c->high[2][lane] * stride[2]};
    uint32_t cell[8];
    uint16_t oldest = CGT_QUEUE_NONE;
    for (int k = 0; k < 8; k++)
        cell[k] = x[k & 1] + y[k >> 1 & 1] + z[k >> 2];
    for (int k = 0; k < 8; k++)
        oldest &= grid->voxel[cell[k]].reference[CGT_QUEUE_LENGTH - 1];
    if (oldest != CGT_QUEUE_NONE)
        save_oldest8(grid, cell, overflow);
    queue_push8(grid->voxel, cell, spu_splats((uint16_t)object));
}

/* Distance from a coordinate to the slab of cells i, in world units, never more than it is. */
static float slab_distance(const cgt_queue_grid *grid, int axis, int32_t i, float p)
{
    const float g = (p - grid->org[axis]) * grid->rcell[axis], slack = grid->slack[axis];
    const float d = g < (float)i ? (float)i - g : g > (float)(i + 1) ? g - (float)(i + 1) : 0;
    return d > slack ? (d - slack) / grid->rcell[axis] * (1 - 0x1p-20f) : 0;
}

static uint64_t push_bounds(const cgt_queue_grid *grid, const corners *c, int lane, const float p[3], float r,
                            uint32_t object, cgt_overflow_list *overflow)
{
    const vec_ushort8 reference = spu_splats((uint16_t)object);
    const float reach = r * r * (1 + 0x1p-20f);
    uint64_t pushed = 0;
    for (int32_t z = c->low[2][lane]; z <= c->high[2][lane]; z++) {
        const float dz = slab_distance(grid, 2, z, p[2]);
        for (int32_t y = c->low[1][lane]; y <= c->high[1][lane]; y++) {
            const float dy = slab_distance(grid, 1, y, p[1]), room = reach - dz * dz - dy * dy;
            for (int32_t x = c->low[0][lane]; x <= c->high[0][lane]; x++) {
                const float dx = slab_distance(grid, 0, x, p[0]);
                /* the bounds' own corners are always taken where squares underflow: room is then 0 and dx * dx too */
                if (dx * dx > room + 0x1p-20f * reach)
                    continue;
                const uint32_t cell = (uint32_t)x + (uint32_t)y * grid->stride[1] + (uint32_t)z * grid->stride[2];
                save_oldest(grid, cell, overflow);
                queue_push1(&grid->voxel[cell], reference);
                pushed++;
            }
        }
    }
    return pushed;
}

/* Pushes the spheres of one vector; returns how many of them it got to. */
static uint32_t push_vector(const cgt_queue_grid *grid, const float center[3][CGT_LANES], const float radius[CGT_LANES],
                            uint32_t object, uint32_t count, cgt_overflow_list *overflow, cgt_fill_counts *counts)
{
    corners c;
    find_corners(grid, center, radius, &c);
    for (uint32_t lane = 0; lane < count; lane++) {
        uint32_t span[3], touched = 1;
        if (!(radius[lane] >= 0))
            continue; /* marked as skipped */
        for (int a = 0; a < 3; a++) {
            span[a] = (uint32_t)(c.high[a][lane] - c.low[a][lane]) + 1;
            touched *= span[a];
        }
        const bool small = span[0] <= 2 && span[1] <= 2 && span[2] <= 2;
        if (overflow->capacity - overflow->count < touched) {
            overflow->wanted = touched;
            return lane;
        }
        if (small)
            push_corners(grid, &c, (int)lane, object + lane, overflow);
        else {
            const float p[3] = {center[0][lane], center[1][lane], center[2][lane]};
            touched = (uint32_t)push_bounds(grid, &c, (int)lane, p, radius[lane], object + lane, overflow);
            counts->large_primitives++;
        }
        counts->references += touched;
    }
    return count;
}

uint32_t CGT_KERNEL(cgt_queue_grid_fill)(const cgt_queue_grid *grid, uint32_t first, uint32_t end,
                                         cgt_overflow_list *overflow, cgt_fill_counts *counts)
{
    for (uint32_t object = first; object < end;) {
        const uint32_t count = end - object < CGT_LANES ? end - object : CGT_LANES;
        _Alignas(CGT_VECTOR_BYTES) float center[3][CGT_LANES] = {{0}}, radius[CGT_LANES] = {0};
        for (uint32_t lane = 0; lane < count; lane++) {
            const cgt_sphere q = cgt_objects_sphere(&grid->objects, object + lane);
            const bool valid = cgt_sphere_check(q) == CGT_SPHERE_VALID;
            center[0][lane] = valid ? q.x : 0;
            center[1][lane] = valid ? q.y : 0;
            center[2][lane] = valid ? q.z : 0;
            radius[lane] = valid ? q.r : -1;
        }
        const uint32_t done =
            push_vector(grid, (const float(*)[CGT_LANES])center, radius, object, count, overflow, counts);
        object += done;
        if (done < count)
            return object;
    }
    return end;
}
