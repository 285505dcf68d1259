/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays through a kd-tree without a stack, along its ropes (Popov, Guenther, Seidel, Slusallek 2007; thesis, section
 * 4.2): one at a time, or a vector of them. */
#include "kernel/kd/kd_rope_packet.h"
#include "kernel/kd/kd_rope_single.h"

void CGT_KERNEL(cgt_kd_ropes_trace)(const cgt_committed_scene *committed_scene, packet *p,
                                    const cgt_trace_settings *settings, cgt_counts *counts)
{
    leaf_tests l;
    leaf_tests_init(committed_scene, p, settings, counts, &l);
    if (settings->kd_traversal == CGT_KD_TRAVERSAL_SINGLE) {
        for (uint32_t i = 0; i < p->lanes; i++)
            rope_trace_ray(&committed_scene->kd, &l, i);
        return;
    }
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES)
        rope_trace_vector(&committed_scene->kd, &l, i);
}
