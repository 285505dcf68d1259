/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The grid, voxelised anew by each SPE each frame (Chapman, section 3.4): four spheres at a time get the cells of their
 * bounds' corners in vectors; each is then pushed to the queues of eight cells by six words a push. No branch depends
 * on a sphere but the one for spheres larger than a cell, and the one for full queues, whose oldest references go to
 * the overflow list.
 *
 * The bounds are those of papers/kernel/grid/queue_grid_fill.c, in the same order of operations: grid space within
 * cell_error for any point of a sphere. */
#ifndef GRID_BUILD_H
#define GRID_BUILD_H

#include "cell/programs/grid/grid_store.h"
#include "cell/programs/grid/grid_words.h"
#include "papers/kernel/grid/queue_push.h"

/* Of four spheres. */
typedef struct grid_corners {
    vec_int4 low[3], high[3]; /* cells of their bounds' corners */
    vec_float4 sphere[4];     /* x, y, z, radius */
    vec_uint4 valid;
} grid_corners;

/* ---- full queues ---- */

static void grid_save(uint32_t cell, uint32_t reference)
{
    const uint32_t count = s()->overflows;
    if (count < CGT_GRID_OVERFLOW)
        s()->overflow[count] = (cgt_overflow){cell, reference};
    s()->overflows = count + 1; /* above the room: the frame is refused */
}

/* Saves the oldest references of different cells. */
static __attribute__((noinline)) void grid_save_oldest(const uint32_t *offset, uint32_t cells)
{
    for (uint32_t k = 0; k < cells; k++) {
        const cgt_voxel *const v = &s()->voxel[offset[k] / sizeof(cgt_voxel)];
        bool duplicate = false;
        for (uint32_t j = 0; j < k; j++)
            duplicate |= offset[j] == offset[k];
        if (!duplicate && v->reference[CGT_QUEUE_LENGTH - 1] != CGT_QUEUE_NONE)
            grid_save(offset[k] / (uint32_t)sizeof *v, v->reference[CGT_QUEUE_LENGTH - 1]);
    }
}

/* ---- pushes ---- */

/* Pushes a reference to eight cells, given by their bytes' offsets: all are read before any is written, so that equal
 * ones are written with equal queues. */
CGT_SPU_INLINE void grid_push8(const uint32_t offset[8], vec_ushort8 reference)
{
    char *const voxel = (char *)s()->voxel;
    vec_ushort8 front[8], back[8], oldest = spu_splats((unsigned short)0xffff);
    for (int k = 0; k < 8; k++) {
        front[k] = GRID_LOAD(vec_ushort8, voxel, offset[k]);
        back[k] = GRID_LOAD(vec_ushort8, voxel, offset[k] + 16);
        oldest = spu_and(oldest, back[k]);
    }
    if (GRID_RARELY(spu_extract(oldest, 7) != CGT_QUEUE_NONE)) {
        uint32_t cell[8];
        memcpy(cell, offset, sizeof cell);
        grid_save_oldest(cell, 8);
    }
    for (int k = 0; k < 8; k++) {
        *GRID_QUADWORD(vec_ushort8, voxel + offset[k]) = spu_shuffle(reference, front[k], CGT_QUEUE_FRONT);
        *GRID_QUADWORD(vec_ushort8, voxel + offset[k] + 16) = spu_shuffle(front[k], back[k], CGT_QUEUE_BACK);
    }
}

/* ---- spheres of more than eight corners ---- */

/* How far a sphere's centre is from the slab of cells i along an axis, in world units, never more than it is. */
static vec_float4 grid_slab_distance(int axis, int32_t i, vec_float4 p)
{
    const cgt_grid_image *const g = &s()->scene;
    const vec_float4 rcell = spu_splats(g->rcell[axis]), error = spu_splats(g->cell_error[axis]);
    const vec_float4 zero = spu_splats(0.f), low = spu_splats((float)i);
    const vec_float4 at = spu_mul(spu_sub(p, spu_splats(g->org[axis])), rcell), from_low = spu_sub(at, low);
    const vec_float4 above = spu_sub(from_low, spu_splats(1.f)), below = spu_sub(zero, from_low);
    const vec_float4 cells = spu_sub(spux_max(spux_max(above, below), zero), error);
    const vec_float4 world = spu_mul(spux_div(cells, rcell), spu_splats(1 - 0x1p-20f));
    return spu_sel(zero, world, spu_cmpgt(cells, zero));
}

/* Pushes sphere `lane` to each cell of its bounds that it touches, and returns their number. */
static __attribute__((noinline)) uint32_t grid_push_large(const grid_corners *c, int lane, uint32_t reference)
{
    const uint32_t *const n = s()->scene.resolution;
    const vec_float4 r = spu_splats(spu_extract(c->sphere[3], lane));
    const vec_float4 reach = spu_mul(spu_mul(r, r), spu_splats(1 + 0x1p-20f));
    vec_float4 p[3];
    int32_t low[3], high[3];
    uint32_t pushed = 0;
    for (int a = 0; a < 3; a++) {
        p[a] = spu_splats(spu_extract(c->sphere[a], lane));
        low[a] = spu_extract(c->low[a], lane);
        high[a] = spu_extract(c->high[a], lane);
    }
    for (int32_t z = low[2]; z <= high[2]; z++) {
        const vec_float4 dz = grid_slab_distance(2, z, p[2]);
        for (int32_t y = low[1]; y <= high[1]; y++) {
            const vec_float4 dy = grid_slab_distance(1, y, p[1]);
            const vec_float4 room = spu_nmsub(dy, dy, spu_nmsub(dz, dz, reach));
            for (int32_t x = low[0]; x <= high[0]; x++) {
                const vec_float4 dx = grid_slab_distance(0, x, p[0]);
                /* the bounds' own corners are always taken where squares underflow: room is then 0 and dx * dx too */
                const vec_float4 most = spu_madd(reach, spu_splats(0x1p-20f), room);
                if (spu_extract(spu_cmpgt(spu_mul(dx, dx), most), 0))
                    continue;
                const uint32_t offset = ((uint32_t)x + n[0] * ((uint32_t)y + n[1] * (uint32_t)z)) * 32;
                grid_save_oldest(&offset, 1);
                queue_push1(&s()->voxel[offset / 32], spu_splats((unsigned short)reference));
                pushed++;
            }
        }
    }
    return pushed;
}

/* ---- four spheres ---- */

CGT_SPU_INLINE void grid_find_corners(uint32_t first, grid_corners *c)
{
    const cgt_grid_image *const g = &s()->scene;
    const vec_float4 *const q = (const vec_float4 *)(const void *)s()->sphere[first];
    const vec_float4 zero = spu_splats(0.f);
    GRID_TRANSPOSE(q[0], q[1], q[2], q[3], c->sphere);
    const vec_float4 r = c->sphere[3];
    const vec_uint4 lane = {0, 1, 2, 3};
    c->valid = spu_andc(spu_cmpgt(spu_splats(g->spheres - first), lane), spu_cmpgt(zero, r));
    for (int a = 0; a < 3; a++) {
        const vec_float4 org = spu_splats(g->org[a]), rcell = spu_splats(g->rcell[a]);
        const vec_float4 error = spu_splats(g->cell_error[a]), last = spu_splats((float)(g->resolution[a] - 1));
        const vec_float4 lowest = spu_sub(c->sphere[a], r), highest = spu_add(c->sphere[a], r);
        const vec_float4 low = spu_sub(spu_mul(spu_sub(lowest, org), rcell), error);
        const vec_float4 high = spu_add(spu_mul(spu_sub(highest, org), rcell), error);
        /* clamped before the conversion: towards zero is down then */
        c->low[a] = spu_convts(spux_min(spux_max(low, zero), last), 0);
        c->high[a] = spu_convts(spux_min(spux_max(high, zero), last), 0);
    }
}

/* Offsets of the eight corners' voxels, of each of the four spheres. Products of cells and strides stay below 2^15: a
 * grid has at most 4,096 cells. */
CGT_SPU_INLINE void grid_corner_offsets(const grid_corners *c, vec_uint4 offset[8])
{
    const uint32_t *const n = s()->scene.resolution;
    const vec_int4 stride_y = spu_splats((int)n[0]), stride_z = spu_splats((int)(n[0] * n[1]));
    const vec_int4 x[2] = {c->low[0], c->high[0]};
    vec_int4 y[2], z[2];
    y[0] = grid_multiply(c->low[1], stride_y);
    y[1] = grid_multiply(c->high[1], stride_y);
    z[0] = grid_multiply(c->low[2], stride_z);
    z[1] = grid_multiply(c->high[2], stride_z);
    for (int k = 0; k < 8; k++)
        offset[k] = (vec_uint4)spu_sl(spu_add(x[k & 1], spu_add(y[k >> 1 & 1], z[k >> 2])), 5);
}

/* Lanes whose bounds span more than two cells along an axis. */
CGT_SPU_INLINE vec_uint4 grid_find_large(const grid_corners *c)
{
    vec_uint4 large = spu_splats(0u);
    for (int a = 0; a < 3; a++)
        large = spu_or(large, spu_cmpgt(spu_sub(c->high[a], c->low[a]), 1));
    return spu_and(large, c->valid);
}

/* References of the four, were each pushed to its different cells alone: 8, 4, 2 or 1 of each. */
CGT_SPU_INLINE vec_uint4 grid_count_corners(const grid_corners *c)
{
    vec_uint4 count = spu_and(c->valid, 1);
    for (int a = 0; a < 3; a++)
        count = spu_add(count, spu_andc(count, spu_cmpeq(c->low[a], c->high[a])));
    return count;
}

static void grid_fill(uint32_t spheres)
{
    vec_uint4 references = spu_splats(0u);
    uint32_t more = 0;
    for (uint32_t first = 0; first < spheres; first += 4) {
        grid_corners c;
        vec_uint4 corner[8], by_sphere[2][4];
        grid_find_corners(first, &c);
        grid_corner_offsets(&c, corner);
        const vec_uint4 large = grid_find_large(&c), pushed = spu_andc(c.valid, large);
        references = spu_add(references, spu_andc(grid_count_corners(&c), large));
        GRID_TRANSPOSE(corner[0], corner[1], corner[2], corner[3], by_sphere[0]);
        GRID_TRANSPOSE(corner[4], corner[5], corner[6], corner[7], by_sphere[1]);
        for (int lane = 0; lane < 4; lane++) {
            const uint32_t prim = first + (uint32_t)lane;
            uint32_t offset[8];
            if (GRID_RARELY(!spu_extract(pushed, lane))) {
                more += spu_extract(large, lane) ? grid_push_large(&c, lane, prim) : 0;
                continue;
            }
            for (int k = 0; k < 8; k++)
                offset[k] = spu_extract(by_sphere[k / 4][lane], k % 4);
            grid_push8(offset, spu_splats((unsigned short)prim));
        }
    }
    for (int k = 0; k < 4; k++)
        more += spu_extract(references, k);
    s()->report.references = more;
}

/* ---- the whole ---- */

/* By cell; those of a cell in any order. There are few. */
static void grid_sort_overflow(cgt_overflow *entry, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        const cgt_overflow moved = entry[i];
        uint32_t k = i;
        for (; k && entry[k - 1].cell > moved.cell; k--)
            entry[k] = entry[k - 1];
        entry[k] = moved;
    }
}

static void grid_clear(uint32_t cells)
{
    vec_uint4 *const q = (vec_uint4 *)(void *)s()->voxel;
    const vec_uint4 none = spu_splats(0xffffffffu);
    for (uint32_t k = 0; k < 2 * cells; k += 16) /* to a multiple of 8 voxels, which the store has */
        for (uint32_t j = 0; j < 16; j++)
            q[k + j] = none;
}

/* Builds the grid of the scene's spheres, whose DMA is under way. Returns whether it fits. */
static bool grid_build(void)
{
    const cgt_grid_image *const g = &s()->scene;
    s()->overflows = 0;
    grid_clear(g->resolution[0] * g->resolution[1] * g->resolution[2]);
    grid_wait(TAG_SETUP);
    grid_fill(g->spheres);
    s()->report.overflow = s()->overflows;
    if (s()->overflows > CGT_GRID_OVERFLOW)
        return false;
    grid_sort_overflow(s()->overflow, s()->overflows);
    return true;
}

#endif
