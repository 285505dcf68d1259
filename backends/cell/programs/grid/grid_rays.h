/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The canonical rays of a packet of 4x4 pixels, bit by bit: a column's and a row's vector come from the PPE, and their
 * sum is rounded to nearest, which an SPU's floats do not do. Its doubles do: the sum of two floats, rounded to double
 * and again to float, is the sum rounded once, since 53 bits are more than 2 * 24 + 1. */
#ifndef GRID_RAYS_H
#define GRID_RAYS_H

#include "cell/programs/grid/grid_store.h"
#include "kernel/packet/packet.h"

/* The host's doubles round to nearest outside the SPU's mode alone. */
#if defined(CGT_SPU_EXACT_X86)
#define GRID_NEAREST ((cgt_spu_arithmetic){0x1f80})
#else
#define GRID_NEAREST ((cgt_spu_arithmetic){0})
#endif

/* Apart from what computes in the SPU's mode (spu_arithmetic_mode.h). */
static __attribute__((noinline)) void grid_add_nearest(const float (*column)[4], const float (*row)[4], packet *p)
{
    for (uint32_t a = 0; a < 3; a++) {
        const vec_double2 left = {(double)column[0][a], (double)column[1][a]};
        const vec_double2 right = {(double)column[2][a], (double)column[3][a]};
        for (uint32_t y = 0; y < 4; y++) {
            const vec_double2 r = {(double)row[y][a], (double)row[y][a]};
            const vec_double2 l = left + r, h = right + r;
            float *to = p->dir[a] + 4 * y;
            to[0] = (float)l[0];
            to[1] = (float)l[1];
            to[2] = (float)h[0];
            to[3] = (float)h[1];
        }
    }
}

static inline void grid_sum_rays(const float (*column)[4], const float (*row)[4], packet *p)
{
#if defined(__SPU__)
    grid_add_nearest(column, row, p);
#else
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    cgt_spu_leave_arithmetic(GRID_NEAREST);
    grid_add_nearest(column, row, p);
    cgt_spu_leave_arithmetic(saved);
#endif
}

/* What all packets share. */
static void grid_init_packet(packet *p)
{
    const cgt_camera_image *c = &s()->camera;
    memset(p, 0, sizeof *p);
    p->lanes = PACKET_MAX_RAYS;
    p->common_origin = true;
    p->from_origin = c->t_min == 0;
    for (uint32_t i = 0; i < PACKET_MAX_RAYS; i += CGT_LANES) {
        for (uint32_t a = 0; a < 3; a++)
            spux_store(p->org[a] + i, spux_vfloat(c->eye[a]));
        spux_store(p->t_min + i, spux_vfloat(c->t_min));
        spux_store(p->t_max + i, spux_vfloat(c->t_max));
    }
    for (uint32_t i = 0; i < PACKET_MAX_RAYS; i++)
        p->u[i] = (float)i;
}

/* Lanes beyond the picture repeat its edge's rays, as the PPE's tables do, and take no part. */
static void grid_make_rays(const float (*column)[4], const float (*row)[4], uint32_t columns, uint32_t rows, packet *p)
{
    grid_sum_rays(column, row, p);
    for (uint32_t i = 0; i < PACKET_MAX_RAYS; i += CGT_LANES) {
        vfloat dd = spux_vfloat(0);
        for (uint32_t a = 0; a < 3; a++) {
            const vfloat d = spux_load(p->dir[a] + i);
            dd = spu_add(dd, spu_mul(d, d));
        }
        spux_store(p->rdd + i, spux_div(spux_vfloat(1), dd));
        spux_store(p->low + i, spux_vfloat(s()->camera.t_max));
        spux_store(p->high + i, spux_vfloat(s()->camera.t_max));
        spux_store_uint(p->prim + i, spux_vuint(CGT_INVALID_ID));
    }
    p->rays = columns * rows;
    if (columns == 4 && rows == 4)
        return;
    for (uint32_t i = 0; i < PACKET_MAX_RAYS; i++)
        if (i % 4 >= columns || i / 4 >= rows)
            p->low[i] = p->high[i] = -INFINITY;
}

#endif
