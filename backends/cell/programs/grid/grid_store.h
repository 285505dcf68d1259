/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What Chapman's program keeps in local store, and how it is compiled: packets of 4x4 rays, one mode of the filter,
 * spheres alone, undecided pairs to the PPE. The file that includes it is one translation unit with the kernels. */
#ifndef GRID_STORE_H
#define GRID_STORE_H

#define CGT_SPU_EXACT
#define CGT_SPE_TEXT_BYTES 37000
#define CGT_SPE_STACK_BYTES 16000
#define CGT_SCRATCH_BYTES ((size_t)4864) /* of the stack: a packet, and a part of it */
#define PACKET_MAX_RAYS 16
#define CGT_LOOSE_LEVELS 1u
#define FILL_STOPS false
#define PACKET_MAX_PRIMS 80u
#define CGT_GRID_MAX_RESOLUTION CGT_GRID_MAX_EDGE
#define GRID_REFS_ARE_32_BITS(grid) false
#define CGT_ONLY_SPHERES true
#define CELLS_PER_RAY 1e9f /* halving packets would take stack, and changes no result */
#define SCALAR_DIVIDE(a, b) spu_extract(spux_div(spu_splats((float)(a)), spu_splats((float)(b))), 0)
#define SCALAR_SQRT(a) spu_extract(spux_sqrt(spu_splats((float)(a))), 0)
#define FILTER_FOR_MODE(p, uv, call) call(((filter_mode){true, false, true, false}));
/* A packet's u, which only FAST precision uses, holds the numbers of the rays: parts of a packet keep them. */
#define FILTER_DEFER(p, i, prim) (grid_add_doubt((uint32_t)(p)->u[i], prim), true)

#include "cell/machine/spe_program.h"

#include "cell/image/control_block.h"
#include "cell/programs/grid/spe_grid.h"
#include "dispatch/kernel.h"

#define CHUNK 32u /* columns of rays that one DMA brings */

/* DMA goes to the first part. */
typedef struct grid_store {
    _Alignas(128) cgt_control_block control;
    _Alignas(128) cgt_grid_image scene;
    _Alignas(128) cgt_camera_image camera;
    _Alignas(128) cgt_spe_report report;
    _Alignas(128) cgt_doubt doubt[2][CGT_DOUBTS_LINE];
    _Alignas(128) float row[CGT_STRIP_ROWS][4];
    _Alignas(128) float column[2][CHUNK][4];
    _Alignas(128) uint32_t line[2][CGT_STRIP_ROWS][CGT_STRIP_WIDTH];
    _Alignas(128) float sphere[CGT_GRID_SPHERES][4];
    _Alignas(128) cgt_voxel voxel[CGT_GRID_CELLS];
    cgt_overflow overflow[CGT_GRID_OVERFLOW];
    /* of the doubts */
    uint32_t doubts, half_doubts, half, unread; /* in all; in the current half; which; halves unread, as bits */
    uint32_t x, y;                              /* the packet's first pixel */
} grid_store;
CGT_SPE_STORE(grid_store, s)

/* Tags of DMA. */
enum { TAG_SETUP, TAG_COLUMN0, TAG_COLUMN1, TAG_LINE0, TAG_LINE1, TAG_DOUBT0, TAG_DOUBT1 };

static inline uint64_t grid_ea(const uint32_t word[2]) { return (uint64_t)word[0] << 32 | word[1]; }

static inline void grid_wait(unsigned tag)
{
    mfc_write_tag_mask(1u << tag);
    mfc_read_tag_status_all();
}

#endif
