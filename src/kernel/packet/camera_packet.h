/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Packets of a camera: rays from pixels, hits to planes. */
#ifndef CGT_CAMERA_PACKET_H
#define CGT_CAMERA_PACKET_H

#include "kernel/packet/packet.h"

#define PACKET_MAX_EDGE (PACKET_MAX_RAYS >= 256 ? 16 : PACKET_MAX_RAYS >= 64 ? 8 : 4)

/* Where lane i of a packet lies: blocks of 4x4 pixels in row order, and row by row in each (block_cones.h). */
CGT_SPU_INLINE uint32_t lane_column(uint32_t i, uint32_t edge) { return (i / 16 * 4 & (edge - 1)) + (i & 3); }
CGT_SPU_INLINE uint32_t lane_row(uint32_t i, uint32_t edge) { return i / (4 * edge) * 4 + (i >> 2 & 3); }

/* Coordinates of the pixels of a vector's lanes, the first of which is i: its fours lie in one row each. px and py are
 * read a vector long from any place. */
CGT_SPU_INLINE vfloat pixel_columns(const float *px, uint32_t i, uint32_t edge)
{
    const vuint column = spu_and(spux_lane_index(), spux_vuint(3));
    return spux_permute(spux_load_unaligned(px + lane_column(i, edge)), column);
}
CGT_SPU_INLINE vfloat pixel_rows(const float *py, uint32_t i, uint32_t edge)
{
    return spux_permute(spux_load_unaligned(py + lane_row(i, edge)), spu_sr(spux_lane_index(), 2));
}

/* Sets what all packets of a perspective camera share, and the range of t of any camera. masked: the camera's mask
 * hides something. */
CGT_SPU_INLINE void camera_packet_init(const cgt_camera_rays *c, const cgt_trace_settings *settings, uint32_t edge,
                                       bool has_masks, packet *p)
{
    p->fast = settings->triangle_test != CGT_TRIANGLE_TEST_AUTO;
    p->triangle_test = settings->triangle_test;
    p->lanes = edge * edge;
    p->common_origin = !c->orthographic;
    p->from_origin = p->common_origin && c->t_min == 0;
    p->to_light = false;
    p->any_hit = false;
    p->skips_prims = p->has_masks = has_masks;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        for (int a = 0; a < 3; a++) {
            spux_store(p->org[a] + i, spux_vfloat(c->eye[a]));
            spux_store(p->dir[a] + i, spux_vfloat(c->fwd[a]));
        }
        spux_store(p->t_min + i, spux_vfloat(c->t_min));
        spux_store(p->t_max + i, spux_vfloat(c->t_max));
        spux_store_uint(p->skip_prim + i, spux_vuint(CGT_INVALID_ID));
        spux_store_uint(p->mask + i, spux_vuint(c->mask));
    }
}

/* Pixels beyond the region take no part. */
CGT_SPU_INLINE void disable_outside(packet *p, uint32_t edge, uint32_t columns, uint32_t rows)
{
    for (uint32_t i = 0; i < edge * edge; i++)
        if (lane_column(i, edge) >= columns || lane_row(i, edge) >= rows)
            p->low[i] = p->high[i] = -INFINITY;
}

/* The canonical rays of the pixels (x0 .. x0 + edge - 1, y0 ..): unfused, in the order of camera.h.
 * Pixels beyond the region repeat its last column and row, and take no part. */
CGT_SPU_INLINE void camera_packet_rays(const cgt_camera_rays *c, uint32_t x0, uint32_t y0, uint32_t edge,
                                       uint32_t columns, uint32_t rows, packet *p)
{
    float px[PACKET_MAX_EDGE + CGT_LANES] = {0}, py[PACKET_MAX_EDGE + CGT_LANES] = {0};
    const vfloat t_max = spux_vfloat(c->t_max);
    for (uint32_t k = 0; k < edge; k++) {
        px[k] = ((float)(x0 + (k < columns ? k : columns - 1)) + 0.5f) * c->pixel[0] - 1;
        py[k] = 1 - ((float)(y0 + (k < rows ? k : rows - 1)) + 0.5f) * c->pixel[1];
    }
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const vfloat qx = pixel_columns(px, i, edge), qy = pixel_rows(py, i, edge);
        vfloat dd = spux_vfloat(0);
        for (int a = 0; a < 3; a++) {
            const vfloat right = spux_vfloat(c->right[a]), up = spux_vfloat(c->up[a]);
            const vfloat start = spux_vfloat(c->orthographic ? c->eye[a] : c->fwd[a]);
            const vfloat sum = spu_add(spu_add(start, spu_mul(qx, right)), spu_mul(qy, up));
            const vfloat d = c->orthographic ? spux_vfloat(c->fwd[a]) : sum;
            spux_store((c->orthographic ? p->org[a] : p->dir[a]) + i, sum);
            dd = spu_add(dd, spu_mul(d, d));
        }
        spux_store(p->rdd + i, spux_div(spux_vfloat(1), dd));
        spux_store(p->low + i, t_max);
        spux_store(p->high + i, t_max);
        spux_store_uint(p->prim + i, spux_vuint(CGT_INVALID_ID));
    }
    if (columns < edge || rows < edge)
        disable_outside(p, edge, columns, rows);
    p->rays = columns * rows;
}

/* Rays leave the range of the filter together: their lengths differ by the picture's diagonal at most. */
CGT_SPU_INLINE bool camera_is_extreme(const cgt_camera_rays *c)
{
    for (int a = 0; a < 3; a++) {
        const float reach = __builtin_fabsf(c->eye[a]) + __builtin_fabsf(c->right[a]) + __builtin_fabsf(c->up[a]);
        if (!(reach <= PACKET_MAX_COORDINATE))
            return true;
    }
    return false;
}

/* A row of a packet: the blocks' rows of four, one after the other. */
CGT_SPU_INLINE void store_row(uint32_t *to, const uint32_t *from, uint32_t row, uint32_t edge, uint32_t columns)
{
    const uint32_t *start = from + row / 4 * 4 * edge + row % 4 * 4;
    uint32_t k = 0;
    for (; k + 4 <= columns; k += 4)
        memcpy(to + k, start + k * 4, 16);
    for (; k < columns; k++)
        memcpy(to + k, start + k / 4 * 16 + k % 4, 4);
}

/* The fours of a vector are rows of one block; BLOCK_ROWS vectors of blocks side by side are rows of a vector's
 * length. */
#define BLOCK_ROWS (CGT_LANES / 4)

CGT_SPU_INLINE void store_whole_plane(uint32_t *to, size_t row_stride, const uint32_t *from, uint32_t edge)
{
    for (uint32_t y = 0; y < edge; y += BLOCK_ROWS)
        for (uint32_t x = 0; x < edge; x += CGT_LANES) {
            const uint32_t *block = from + y / 4 * 4 * edge + y % 4 * 4 + x * 4;
            vuint v[BLOCK_ROWS];
            for (uint32_t k = 0; k < BLOCK_ROWS; k++)
                v[k] = spux_load_uint(block + 16 * k);
            spux_transpose_fours(v);
            for (uint32_t k = 0; k < BLOCK_ROWS; k++)
                spux_store_unaligned_uint(to + (y + k) * row_stride + x, v[k]);
        }
}

CGT_SPU_INLINE void store_plane(uint32_t *plane, const uint32_t *from, uint32_t edge, uint32_t columns, uint32_t rows,
                                const cgt_region *r, size_t first)
{
    if (!plane)
        return;
    if (columns == edge && rows == edge && edge % CGT_LANES == 0) {
        store_whole_plane(plane + first, r->row_stride, from, edge);
        return;
    }
    for (uint32_t y = 0; y < rows; y++)
        store_row(plane + first + y * r->row_stride, from, y, edge, columns);
}

CGT_SPU_INLINE void camera_packet_store(const packet_hits *h, uint32_t edge, uint32_t columns, uint32_t rows,
                                        const cgt_region *r, size_t first)
{
    for (int k = 0; k < CGT_PLANES; k++)
        store_plane(r->plane[k], h->plane[k], edge, columns, rows, r, first);
}

#endif
