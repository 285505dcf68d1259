/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A region of a camera's frame, packet by packet. */
#include "kernel/packet/camera_packet.h"

void CGT_KERNEL(cgt_trace_region)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                                  const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts)
{
    packet *p = cgt_scratch_take(counts->scratch, sizeof *p);
    packet_hits *hits = cgt_scratch_take(counts->scratch, sizeof *hits);
    const uint32_t edge = settings->packet;
    camera_packet_init(camera, settings, edge, camera->mask != UINT32_MAX, p);
    p->extreme = camera_is_extreme(camera);
    for (uint32_t y = 0; y < region->height; y += edge)
        for (uint32_t x = 0; x < region->width; x += edge) {
            const uint32_t columns = region->width - x < edge ? region->width - x : edge;
            const uint32_t rows = region->height - y < edge ? region->height - y : edge;
            camera_packet_rays(camera, region->x + x, region->y + y, edge, columns, rows, p);
            counts->rays += p->rays;
            CGT_KERNEL(cgt_packet_trace)(committed_scene, p, settings, counts);
            CGT_KERNEL(cgt_packet_resolve)(committed_scene, p, settings, hits, counts);
            camera_packet_store(hits, edge, columns, rows, region, y * region->row_stride + x);
        }
    cgt_scratch_return(counts->scratch, p);
}
