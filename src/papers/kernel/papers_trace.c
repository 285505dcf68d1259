/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Packets through the structures of the papers, and the table of kernels for their builders. */
#include "kernel/packet/packet.h"
#include "papers/kernel/paper_kernels.h"

cgt_queue_grid_fill_fn CGT_KERNEL(cgt_queue_grid_fill);
cgt_trace_packet_fn CGT_KERNEL(cgt_queue_grid_trace), CGT_KERNEL(cgt_kd_trace), CGT_KERNEL(cgt_kd_ropes_trace),
    CGT_KERNEL(cgt_bih_trace);

const cgt_paper_kernels CGT_KERNEL(cgt_paper_kernels) = {.queue_grid_fill = CGT_KERNEL(cgt_queue_grid_fill)};

void CGT_KERNEL(cgt_papers_trace)(const cgt_committed_scene *committed_scene, packet *p,
                                  const cgt_trace_settings *settings, cgt_counts *counts)
{
    switch ((int)committed_scene->structure) {
    case CGT_STRUCTURE_QUEUE_GRID: CGT_KERNEL(cgt_queue_grid_trace)(committed_scene, p, settings, counts); break;
    case CGT_STRUCTURE_KD: CGT_KERNEL(cgt_kd_trace)(committed_scene, p, settings, counts); break;
    case CGT_STRUCTURE_KD_ROPES: CGT_KERNEL(cgt_kd_ropes_trace)(committed_scene, p, settings, counts); break;
    default: CGT_KERNEL(cgt_bih_trace)(committed_scene, p, settings, counts); break;
    }
}
