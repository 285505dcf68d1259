/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The canonical rays of a packet of 4x4 pixels, bit by bit: a column's and a row's vector come from the PPE, and their
 * sum is rounded to nearest (grid_nearest.h). Cameras with components too small for that are summed in doubles, as the
 * sum of two floats, rounded to double and again to float, is the sum rounded once: 53 bits are more than 2 * 24 +
 * 1. */
#ifndef GRID_RAYS_H
#define GRID_RAYS_H

#include "cell/programs/grid/grid_store.h" /* first: it says whose arithmetic it is */

#include "cell/image/light_rays.h"
#include "cell/programs/grid/grid_nearest.h"

/* The host's doubles round to nearest outside the SPU's mode alone. */
#if defined(CGT_SPU_EXACT_X86)
#define GRID_NEAREST ((cgt_spu_arithmetic){0x1f80})
#else
#define GRID_NEAREST ((cgt_spu_arithmetic){0})
#endif

/* Sums in doubles of four columns and a row, along an axis; apart from what computes in the SPU's mode
 * (spu_arithmetic_mode.h). */
static __attribute__((noinline)) vec_float4 grid_add_doubles(vec_float4 column, vec_float4 row)
{
    float sum[4];
    for (int k = 0; k < 4; k++)
        sum[k] = (float)((double)spu_extract(column, k) + (double)spu_extract(row, k));
    return (vec_float4){sum[0], sum[1], sum[2], sum[3]};
}

static __attribute__((noinline)) void grid_sum_doubles(const vec_float4 column[3], grid_packet *p)
{
#if !defined(__SPU__)
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    cgt_spu_leave_arithmetic(GRID_NEAREST);
#endif
    for (int a = 0; a < 3; a++)
        for (int y = 0; y < 4; y++)
            p->dir[a][y] = grid_add_doubles(column[a], s()->row_splats[a][y]);
#if !defined(__SPU__)
    cgt_spu_leave_arithmetic(saved);
#endif
}

/* A row's vectors in all lanes, for the packets of a strip. */
static void grid_splat_rows(void)
{
    const vec_float4 *const row = (const vec_float4 *)(const void *)s()->row;
    for (int y = 0; y < 4; y++) {
        s()->row_splats[0][y] = GRID_LANE(row[y], 0);
        s()->row_splats[1][y] = GRID_LANE(row[y], 1);
        s()->row_splats[2][y] = GRID_LANE(row[y], 2);
    }
}

/* Lanes beyond the picture repeat its edge's rays, as the PPE's tables do, and take no part. */
static __attribute__((noinline)) void grid_close_edges(uint32_t columns, uint32_t rows, grid_packet *p)
{
    const vec_uint4 lane = {0, 1, 2, 3}, across = spu_cmpgt(spu_splats(columns), lane);
    for (uint32_t y = 0; y < 4; y++) {
        const vec_uint4 inside = y < rows ? across : spu_splats(0u);
        p->low[y] = spu_sel(spu_splats(GRID_CLOSED), p->low[y], inside);
        p->high[y] = spu_sel(spu_splats(GRID_CLOSED), p->high[y], inside);
    }
}

/* Rays of four columns; the packet's origin and range are the camera's. */
CGT_SPU_INLINE void grid_make_rays(const vec_float4 *from, uint32_t columns, uint32_t rows, grid_packet *p)
{
    const vec_float4 t_max = spu_splats(s()->camera.t_max);
    vec_float4 column[4];
    GRID_TRANSPOSE(from[0], from[1], from[2], from[3], column);
    if (GRID_RARELY(s()->camera.tiny))
        grid_sum_doubles(column, p);
    else
        for (int y = 0; y < 4; y++)
            for (int a = 0; a < 3; a++)
                p->dir[a][y] = grid_add_nearest(column[a], s()->row_splats[a][y]);
    for (int y = 0; y < 4; y++) {
        const vec_float4 d[3] = {p->dir[0][y], p->dir[1][y], p->dir[2][y]};
        p->rdd[y] = cgt_light_rdd(d);
        p->low[y] = p->high[y] = t_max;
        p->prim[y] = spu_splats(CGT_INVALID_ID);
    }
    if (GRID_RARELY(columns < 4 || rows < 4))
        grid_close_edges(columns, rows, p);
}

#endif
