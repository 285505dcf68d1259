/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles for tests of the kd program, as the library has them and as the program does, and what must be equal. */
#ifndef KD_LIBRARY_H
#define KD_LIBRARY_H

#include <cgt/research.h>

#include "cell/ppe/cell_frames.h"
#include "cell/ppe/kd/kd_frame.h"

#define KD_MOST_PIXELS (96 * 96)
#define KD_MOST_TRIANGLES 4096u
#define KD_MOST_BATCHES 6u

/* The triangles of the next library. */
extern float kd_corner[KD_MOST_TRIANGLES][3][3];
extern uint32_t kd_triangles;

typedef struct kd_library {
    cgt_context *context;
    cgt_scene *scene[CGT_KD_PARTS], *all; /* all: what answers are compared with */
    uint32_t parts;
} kd_library;

/* The triangles in equal parts, in kd-trees with or without ropes, or in bounding interval hierarchies; and all of them
 * for the library's answers. */
kd_library kd_library_make(uint32_t parts, cgt_structure structure, cgt_kd_layout layout);

/* The program, native, for a structure. */
cgt_spe_function *kd_library_program(cgt_structure structure);
void kd_library_release(kd_library *q);

/* Traces a frame by the kd program; the output stays for the comparisons. */
cgt_result kd_library_run(const kd_library *q, const cgt_camera *camera, uint32_t width, uint32_t height,
                          const cgt_kd_frame_options *o, cgt_cell_frame_result *r);

/* Compares the ids, and the rays, with the library's. */
void kd_library_compare_ids(const kd_library *q, const cgt_camera *camera, uint32_t width, uint32_t height);

/* Traces a frame and compares everything. Where SPE_KD_ELF and SPE_BIH_ELF name the programs as the SPU's own compiler
 * made them, they are simulated as well: the same ids, rays, reports and counts of DMA. */
void kd_library_check(const kd_library *q, const cgt_camera *camera, uint32_t width, uint32_t height,
                      const cgt_kd_frame_options *o);

#endif
