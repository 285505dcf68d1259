/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A frame at work, and its run on simulated or native SPEs. */
#ifndef CGT_FRAME_RUN_H
#define CGT_FRAME_RUN_H

#include "cell/ppe/grid/doubts.h"
#include "cell/ppe/grid/frame.h"

#define CGT_FRAME_MAX_BYTES 0x80000000u /* of the id plane: from CGT_EA_IDS on */

typedef struct frame {
    const cgt_grid_scene *scene;
    const cgt_cell_frame_options *options;
    cgt_camera_tables tables;
    cgt_grid_image image;
    cgt_control_block control[CGT_MAX_SPES];
    cgt_spe_report report[CGT_MAX_SPES];
    cgt_assigner assigner;
    cgt_doubts doubts;
    cgt_frame_light light;
    cgt_cell *cell;
    uint32_t *ids, *nearest; /* the id plane, its rows row_bytes apart */
    cgt_doubt *ring;         /* of each SPE: two halves of `half` doubts */
    size_t id_bytes, nearest_bytes, ring_bytes;
    uint32_t row_bytes, half, interrupts;
    bool broken; /* the program does not keep the protocol */
} frame;

cgt_result cgt_frame_run_native(frame *f, cgt_ppe_function *ppe, char message[CGT_CELL_MESSAGE_BYTES]);
cgt_result cgt_frame_run_simulated(frame *f, cgt_ppe_function *ppe, char message[CGT_CELL_MESSAGE_BYTES]);

#endif
