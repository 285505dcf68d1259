/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The cells of a frustum, four slices at a time, and the references in them as one list.
 *
 * Two loops visit the cells of some slices: three nested ones, and Chapman's single loop (section 3.3), which steps
 * cell, row and slice by selections: in words, as the compiler makes branches of C's. Either has a voxel's queue loaded
 * one cell ahead. A queue is appended to the list by its front quadword, whatever its length: what does not count is
 * overwritten by the next one. */
#ifndef GRID_CELLS_H
#define GRID_CELLS_H

#include "cell/programs/grid/grid_store.h"

#define GRID_RUN 12u /* cells whose references are collected before they are tested */
_Static_assert(16 + GRID_RUN * CGT_QUEUE_LENGTH + CGT_GRID_OVERFLOW <= GRID_LIST, "a run's references fit the list");

/* ---- four slices ---- */

/* Cells of u or v in four slices between lower bounds of k and k + 1: the first one, and how many; below 1: none. */
CGT_SPU_INLINE void grid_bound_slices(const grid_frustum *f, int k, vec_float4 along, vec_float4 last, vec_int4 *first,
                                      vec_int4 *count)
{
    const vec_float4 zero = spu_splats(0.f), one = spu_splats(1.f);
    const vec_float4 near = spu_madd(f->step[k], along, f->bound[k]), far = spu_add(near, f->step[k]);
    const vec_float4 down = spu_madd(f->step[k + 1], along, f->bound[k + 1]), up = spu_add(down, f->step[k + 1]);
    const vec_float4 low = spux_min(spux_max(spux_min(near, far), zero), spu_add(last, one));
    /* from -1 up: towards zero is down after a shift by one */
    const vec_float4 high = spux_min(spu_sub(one, spux_min(down, up)), spu_add(last, one));
    *first = spu_convts(low, 0);
    *count = spu_sub(spu_convts(spux_max(high, zero), 0), *first);
}

/* Appends a quadword {voxel of the first cell, cells of a row, rows, from a row's last cell to the next row's first}
 * for each slice from `slice` on that has cells, four at most. Returns their cells, in lane 0. */
CGT_SPU_INLINE uint32_t grid_find_slices(const grid_axes *x, const grid_frustum *f, uint32_t slice, uint32_t *slices)
{
    const vec_int4 lane = {0, 1, 2, 3}, number = spu_add(spu_splats((int32_t)slice), lane);
    const vec_int4 one = spu_splats((int32_t)1), end = spu_splats((int32_t)f->end);
    const vec_float4 along = spu_sub(spu_convtf(number, 0), f->w0);
    vec_int4 first[2], count[2], by_slice[4];
    grid_bound_slices(f, 0, along, x->last[0], &first[0], &count[0]);
    grid_bound_slices(f, 2, along, x->last[1], &first[1], &count[1]);
    const vec_uint4 empty = spu_or(spu_cmpgt(one, count[0]), spu_cmpgt(one, count[1]));
    const vec_int4 valid = (vec_int4)spu_andc(spu_cmpgt(end, number), empty);
    const vec_int4 along_w = spu_add(x->first_cell, grid_multiply(number, x->w_step));
    const vec_int4 along_uv = spu_add(grid_multiply(first[0], x->stride[0]), grid_multiply(first[1], x->stride[1]));
    const vec_int4 voxel = spu_sl(spu_add(along_w, along_uv), 5);
    const vec_int4 back = grid_multiply(spu_sub(count[0], one), x->stride[0]);
    const vec_int4 jump = spu_sl(spu_sub(x->stride[1], back), 5);
    GRID_TRANSPOSE(voxel, count[0], count[1], jump, by_slice);
    uint32_t n = 0;
    for (int k = 0; k < 4; k++) {
        s()->slice[n] = by_slice[k];
        n -= (uint32_t)spu_extract(valid, k);
    }
    const vec_int4 cells = spu_and(grid_multiply(count[0], count[1]), valid);
    const vec_int4 two = spu_add(cells, spu_rlqwbyte(cells, 8));
    *slices = n;
    return (uint32_t)spu_extract(spu_add(two, spu_rlqwbyte(two, 4)), 0);
}

/* ---- the list ---- */

/* What lies behind a queue's front half, and in the overflow list. n: bytes in the list. */
static __attribute__((noinline)) vec_uint4 grid_append_rest(uint32_t voxel, vec_uint4 bytes)
{
    const uint16_t *const queue = s()->voxel[voxel / sizeof(cgt_voxel)].reference;
    const uint32_t cell = voxel / (uint32_t)sizeof(cgt_voxel);
    uint32_t n = spu_extract(bytes, 0) / 2;
    for (uint32_t k = 8; k < CGT_QUEUE_LENGTH && queue[k] != CGT_QUEUE_NONE; k++)
        s()->list[n++] = queue[k];
    if (queue[CGT_QUEUE_LENGTH - 1] != CGT_QUEUE_NONE) {
        uint32_t low = 0, high = s()->overflows;
        while (low < high) {
            const uint32_t middle = low + (high - low) / 2;
            if (s()->overflow[middle].cell < cell)
                low = middle + 1;
            else
                high = middle;
        }
        for (; low < s()->overflows && s()->overflow[low].cell == cell; low++)
            s()->list[n++] = (uint16_t)s()->overflow[low].reference;
    }
    return spu_splats(2 * n);
}

/* Appends a queue by its front half; bytes: of the list, in all lanes. */
CGT_SPU_INLINE vec_uint4 grid_append(vec_ushort8 queue, uint32_t voxel, vec_uint4 bytes)
{
    const vec_ushort8 none = spu_splats((unsigned short)CGT_QUEUE_NONE);
    const vec_uint4 ends = spu_gather(spu_cmpeq(queue, none)), zeros = spu_cntlz(ends);
    const int at = (int)spu_extract(bytes, 0);
    const vec_ushort8 moved = spu_rlqwbyte(queue, -at), behind = spu_rlmaskqwbyte(none, -(at & 15));
    vec_ushort8 *const to = GRID_QUADWORD(vec_ushort8, (char *)s()->list + at);
    to[0] = spu_sel(to[0], moved, behind);
    to[1] = moved;
    const vec_uint4 length = GRID_LANE(zeros, 0); /* 24 more: a bit for each halfword, the first one highest */
    bytes = spu_add(bytes, spu_sub(spu_add(length, length), spu_splats(48u)));
    if (GRID_RARELY(!spu_extract(ends, 0)))
        bytes = grid_append_rest(voxel, bytes);
    return bytes;
}

/* Fills the list's last vector, and one more, with the number of a sphere that is none. */
CGT_SPU_INLINE void grid_end_list(vec_uint4 bytes)
{
    const int at = (int)spu_extract(bytes, 0);
    const vec_ushort8 ones = spu_splats((unsigned short)0xffff), nobody = spu_splats((unsigned short)CGT_GRID_SPHERES);
    const vec_ushort8 behind = spu_rlmaskqwbyte(ones, -(at & 15));
    vec_ushort8 *const to = GRID_QUADWORD(vec_ushort8, (char *)s()->list + at);
    to[0] = spu_sel(to[0], nobody, behind);
}

/* ---- the two loops ---- */

/* A place among the cells of slices; everything in all lanes. */
typedef struct grid_place {
    const vec_int4 *slice;
    vec_uint4 voxel, across, down; /* this cell's; cells left of its row, rows left of its slice, with this one */
    vec_uint4 row, jump, stride;   /* of the slice: cells of a row, jump to the next row; to the next cell */
} grid_place;

CGT_SPU_INLINE void grid_enter_slice(grid_place *a, vec_uint4 ends)
{
    const vec_uint4 q = *(const vec_uint4 *)a->slice;
    a->voxel = spu_sel(a->voxel, GRID_LANE(q, 0), ends);
    a->row = spu_sel(a->row, GRID_LANE(q, 1), ends);
    a->across = spu_sel(a->across, GRID_LANE(q, 1), ends);
    a->down = spu_sel(a->down, GRID_LANE(q, 2), ends);
    a->jump = spu_sel(a->jump, GRID_LANE(q, 3), ends);
}

/* To the next cell. */
CGT_SPU_INLINE void grid_step(grid_place *a)
{
    const vec_uint4 one = spu_splats(1u);
    const vec_uint4 row_ends = spu_cmpeq(a->across, one), slice_ends = spu_and(row_ends, spu_cmpeq(a->down, one));
    a->voxel = spu_add(a->voxel, spu_sel(a->stride, a->jump, row_ends));
    a->across = spu_sel(spu_sub(a->across, one), a->row, row_ends);
    a->down = spu_add(a->down, row_ends);
    a->slice = (const vec_int4 *)(const void *)((const char *)a->slice + (spu_extract(slice_ends, 0) & 16));
    grid_enter_slice(a, slice_ends);
}

CGT_SPU_INLINE vec_ushort8 grid_load_queue(vec_uint4 voxel)
{
    return GRID_LOAD(vec_ushort8, s()->voxel, spu_extract(voxel, 0));
}

/* The next `cells` cells, one at least, in one loop. */
CGT_SPU_INLINE vec_uint4 grid_collect_flattened(grid_place *a, uint32_t cells, vec_uint4 bytes)
{
    vec_ushort8 queue = grid_load_queue(a->voxel);
    do {
        const uint32_t voxel = spu_extract(a->voxel, 0);
        grid_step(a);
        const vec_ushort8 next = grid_load_queue(a->voxel);
        bytes = grid_append(queue, voxel, bytes);
        queue = next;
    } while (GRID_MOSTLY(--cells));
    return bytes;
}

#endif
