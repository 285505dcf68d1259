/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The march of a packet through the grid (Wald et al. 2006; Chapman, section 3): four slices at a time, front to back,
 * until no ray needs more. */
#ifndef GRID_MARCH_H
#define GRID_MARCH_H

#include "cell/programs/grid/grid_cells.h"
#include "cell/programs/grid/grid_spheres.h"

#define GRID_FEW 8u /* references that are not tested alone while there are more cells: the fill of one quadword */

/* ---- cells ---- */

CGT_SPU_INLINE vec_uint4 grid_flush(const grid_axes *x, grid_packet *p, grid_frustum *f, vec_uint4 bytes,
                                    grid_rays kind)
{
    grid_end_list(bytes);
    if (kind == GRID_CAMERA)
        grid_test_camera(x, p, f, spu_extract(bytes, 0));
    else
        grid_test_light(x, p, f, spu_extract(bytes, 0));
    return spu_splats(0u);
}

/* The cells of `slices` slices in three loops, of a camera's rays. The loops are functions, so that a profile has their
 * cycles. */
static __attribute__((noinline)) vec_uint4 grid_visit_nested(const grid_axes *x, grid_packet *p, grid_frustum *f,
                                                             uint32_t slices, vec_uint4 bytes)
{
    const uint32_t stride = spu_extract((vec_uint4)x->stride[0], 0) * 32;
    uint32_t run = GRID_RUN;
    for (uint32_t k = 0; k < slices; k++) {
        const vec_uint4 q = (vec_uint4)s()->slice[k];
        const uint32_t row = spu_extract(q, 1), jump = spu_extract(q, 3);
        uint32_t voxel = spu_extract(q, 0);
        for (uint32_t rows = spu_extract(q, 2); rows; rows--) {
            for (uint32_t cells = row; cells; cells--) {
                bytes = grid_append(GRID_LOAD(vec_ushort8, s()->voxel, voxel), voxel, bytes);
                voxel += stride;
                if (GRID_RARELY(!--run)) {
                    run = GRID_RUN;
                    if (spu_extract(bytes, 0) > 2 * GRID_FEW)
                        bytes = grid_flush(x, p, f, bytes, GRID_CAMERA);
                }
            }
            voxel += jump - stride;
        }
    }
    return bytes;
}

/* The same in one, of any rays. */
CGT_SPU_INLINE vec_uint4 grid_visit_flattened(const grid_axes *x, grid_packet *p, grid_frustum *f, uint32_t slices,
                                              uint32_t cells, vec_uint4 bytes, grid_rays kind)
{
    grid_place a = {.slice = s()->slice, .stride = (vec_uint4)spu_sl(x->stride[0], 5)};
    a.voxel = a.across = a.down = a.row = a.jump = spu_splats(0u);
    s()->slice[slices] = s()->slice[0]; /* what the last cell is followed by is loaded, not used */
    grid_enter_slice(&a, spu_splats(0xffffffffu));
    while (GRID_RARELY(cells > GRID_RUN)) {
        bytes = grid_collect_flattened(&a, GRID_RUN, bytes);
        cells -= GRID_RUN;
        if (spu_extract(bytes, 0) > 2 * GRID_FEW)
            bytes = grid_flush(x, p, f, bytes, kind);
    }
    return grid_collect_flattened(&a, cells, bytes);
}

static __attribute__((noinline)) vec_uint4 grid_visit_flattened_camera(const grid_axes *x, grid_packet *p,
                                                                       grid_frustum *f, uint32_t slices, uint32_t cells,
                                                                       vec_uint4 bytes)
{
    return grid_visit_flattened(x, p, f, slices, cells, bytes, GRID_CAMERA);
}

CGT_SPU_INLINE void grid_march(const grid_axes *x, grid_packet *p, grid_frustum *f, grid_rays kind)
{
    const bool flattened = s()->control.flags & CGT_CONTROL_FLATTENED;
    vec_uint4 bytes = spu_splats(0u), visited = bytes;
    const uint32_t end = f->end;
    for (uint32_t slice = f->first; slice < end; slice += 4) {
        uint32_t slices;
        const uint32_t cells = grid_find_slices(x, f, slice, &slices);
        if (cells) {
            visited = spu_add(visited, spu_splats(cells));
            if (kind == GRID_LIGHT)
                bytes = grid_visit_flattened(x, p, f, slices, cells, bytes, kind);
            else if (flattened)
                bytes = grid_visit_flattened_camera(x, p, f, slices, cells, bytes);
            else
                bytes = grid_visit_nested(x, p, f, slices, bytes);
        }
        if (spu_extract(bytes, 0) > 2 * GRID_FEW || slice + 4 >= end) {
            if (spu_extract(bytes, 0))
                bytes = grid_flush(x, p, f, bytes, kind);
            if (spu_extract(spu_cmpgt(spu_splats((float)(slice + 4)), f->w_far), 0))
                break;
        }
    }
    s()->counts[COUNT_CELLS] = spu_add(s()->counts[COUNT_CELLS], visited);
}

/* ---- packets of the camera ---- */

/* Rays whose main axis may be w: they advance along it, and no more than `steepness` times as much along others. */
CGT_SPU_INLINE vec_uint4 grid_rays_of(const grid_axes *x, const grid_packet *p, int i, float steepness)
{
    const vec_float4 w = (vec_float4)spu_xor((vec_uint4)p->dir[x->w][i], x->w_sign);
    const vec_float4 most = spux_max(spux_abs(p->dir[x->u][i]), spux_abs(p->dir[x->v][i]));
    return spu_andc(spu_cmpgt(w, spu_splats(0.f)), spu_cmpgt(most, spu_mul(w, spu_splats(steepness))));
}

static inline bool grid_is_of(const grid_axes *x, const grid_packet *p, float steepness)
{
    const vec_uint4 yes = spu_and(spu_and(grid_rays_of(x, p, 0, steepness), grid_rays_of(x, p, 1, steepness)),
                                  spu_and(grid_rays_of(x, p, 2, steepness), grid_rays_of(x, p, 3, steepness)));
    return spu_extract(spu_gather(yes), 0) == 15;
}

CGT_SPU_INLINE void grid_trace_class(const grid_axes *x, grid_packet *p, grid_frustum *f)
{
    if (x->first >= x->slices || !grid_frustum_of_camera(x, p, f))
        return;
    grid_bound_lengths(p, f);
    f->w_far = spu_splats(GRID_MOST);
    s()->tested = spu_splats((unsigned short)CGT_QUEUE_NONE);
    grid_march(x, p, f, GRID_CAMERA);
}

static __attribute__((noinline)) void grid_trace_part(const grid_axes *x, grid_packet *p)
{
    grid_trace_class(x, p, &s()->frustum);
}

/* Rays that differ in their main axis, class by class: lanes of others repeat one of the class and take no part. */
static __attribute__((noinline)) void grid_trace_parts(grid_packet *p)
{
    grid_packet *const part = &s()->part;
    vec_uint4 done[4];
    for (int i = 0; i < 4; i++)
        done[i] = spu_splats(0u);
    for (uint32_t class = 0; class < GRID_CLASSES; class ++) {
        const grid_axes *const x = &s()->axes[class];
        vec_uint4 mine[4];
        uint32_t any = 0;
        int from = 0;
        for (int i = 3; i >= 0; i--) {
            mine[i] = spu_andc(grid_rays_of(x, p, i, 1), done[i]);
            done[i] = spu_or(done[i], mine[i]);
            const uint32_t bits = spu_extract(spu_gather(mine[i]), 0);
            from = bits ? 4 * i + __builtin_clz(bits) - 28 : from;
            any |= bits;
        }
        if (!any)
            continue;
        for (int i = 0; i < 4; i++) {
            for (int a = 0; a < 3; a++) {
                const vec_float4 d = spu_splats(spu_extract(spu_rlqwbyte(p->dir[a][from >> 2], 4 * (from & 3)), 0));
                part->dir[a][i] = spu_sel(d, p->dir[a][i], mine[i]);
            }
            const vec_float4 rdd = spu_splats(spu_extract(spu_rlqwbyte(p->rdd[from >> 2], 4 * (from & 3)), 0));
            part->rdd[i] = spu_sel(rdd, p->rdd[i], mine[i]);
            part->low[i] = spu_sel(spu_splats(GRID_CLOSED), p->low[i], mine[i]);
            part->high[i] = spu_sel(spu_splats(GRID_CLOSED), p->high[i], mine[i]);
            part->prim[i] = p->prim[i];
        }
        grid_trace_part(x, part);
        for (int i = 0; i < 4; i++)
            p->prim[i] = spu_sel(p->prim[i], part->prim[i], mine[i]);
    }
}

/* The class of a ray. */
static uint32_t grid_class_of(const grid_packet *p, uint32_t ray)
{
    uint32_t class = 0;
    for (uint32_t k = 0; k < GRID_CLASSES; k++) {
        const uint32_t bits = spu_extract(spu_gather(grid_rays_of(&s()->axes[k], p, (int)(ray >> 2), 1)), 0);
        class = bits << (ray & 3) & 8 ? k : class;
    }
    return class;
}

/* Neighbours are of one class nearly always: the last packet's is tried first. */
CGT_SPU_INLINE void grid_trace_camera(grid_packet *p)
{
    const grid_axes *x = &s()->axes[s()->class];
    s()->counts[COUNT_PACKETS] = spu_add(s()->counts[COUNT_PACKETS], spu_splats(1u));
    if (GRID_RARELY(!grid_is_of(x, p, 1.25f))) {
        s()->class = grid_class_of(p, 0);
        x = &s()->axes[s()->class];
        if (!grid_is_of(x, p, 4)) {
            grid_trace_parts(p);
            return;
        }
    }
    grid_trace_class(x, p, &s()->frustum);
}

#endif
