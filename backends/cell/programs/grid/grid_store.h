/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What Chapman's program keeps in local store, and how it is compiled: packets of 4x4 rays, one mode of the filter,
 * spheres alone, undecided pairs to the PPE. The file that includes it is one translation unit with the kernels. */
#ifndef GRID_STORE_H
#define GRID_STORE_H

#ifndef CGT_SPU_EXACT
#define CGT_SPU_EXACT
#endif
#define CGT_SPE_TEXT_BYTES 48000
#define CGT_SPE_STACK_BYTES 8192

#include <string.h>

#include <cgt/research.h>

#include "cell/machine/spe_program.h"

#include "cell/image/control_block.h"
#include "cell/programs/grid/grid_packet.h"
#include "cell/programs/grid/spe_grid.h"
#include "cell/programs/spe_doubts.h"
#include "papers/model/queue_grid.h"

#define CHUNK 32u      /* columns of rays that one DMA brings */
#define GRID_LIST 512u /* references of a packet's list */

enum { COUNT_PACKETS, COUNT_CELLS, COUNT_LISTED, COUNT_TESTS, COUNT_REMEMBERED, COUNT_LIGHT, GRID_COUNTS };

/* DMA goes to the first part. */
typedef struct grid_store {
    _Alignas(128) cgt_control_block control;
    _Alignas(128) cgt_grid_image scene;
    _Alignas(128) cgt_camera_image camera;
    _Alignas(128) cgt_spe_report report;
    _Alignas(128) spe_doubts doubts;
    _Alignas(128) cgt_light_image light;
    _Alignas(128) uint32_t occluded[2][CHUNK / 4 * CGT_LIGHT_SETS / 2];
    _Alignas(128) float row[CGT_STRIP_ROWS][4];
    _Alignas(128) float column[2][CHUNK][4];
    _Alignas(128) uint32_t line[2][CGT_STRIP_ROWS][CGT_STRIP_PIECE];
    _Alignas(128) float sphere[CGT_GRID_SPHERES + 1][4]; /* the last one is none: what lists end with */
    _Alignas(128) cgt_voxel voxel[CGT_GRID_CELLS];
    cgt_overflow overflow[CGT_GRID_OVERFLOW];
    /* of the packet */
    uint32_t x, y; /* its first pixel */
    grid_packet packet, part, from_hits;
    vec_float4 normal[3][4];             /* of hits */
    _Alignas(16) uint32_t origin[4 * 4]; /* what a doubt of the packet's rays says of their set and start */
    grid_frustum frustum, line_frustum;
    grid_axes axes[GRID_CLASSES];
    vec_float4 row_splats[3][4];                   /* of a strip: x, y, z of a row's vector, in all lanes */
    vec_int4 slice[5];                             /* grid_cells.h */
    _Alignas(16) uint16_t list[GRID_LIST + 2 * 8]; /* references to test */
    vec_uint4 counts[GRID_COUNTS];                 /* sums, in lane 0 */
    vec_ushort8 tested;                            /* the last references that were tested */
    uint32_t class;                                /* of the last packet */
    uint32_t overflows;                            /* of the grid; above the room: it does not fit */
} grid_store;
CGT_SPE_STORE(grid_store, s)

/* Tags of DMA. */
enum { TAG_SETUP, TAG_COLUMN0, TAG_COLUMN1, TAG_LINE0, TAG_LINE1, TAG_DOUBT0, TAG_DOUBT1, TAG_LIGHT0, TAG_LIGHT1 };

static inline uint64_t grid_ea(const uint32_t word[2]) { return (uint64_t)word[0] << 32 | word[1]; }

static inline void grid_wait(unsigned tag)
{
    mfc_write_tag_mask(1u << tag);
    mfc_read_tag_status_all();
}

#endif
