/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A region of a camera's frame: its rays as streams through the BVH, or packet by packet through another structure. */
#include "kernel/packet/camera_packet.h"

/* ---- streams ---- */

/* Pixels that are traced together, as arrays. */
typedef struct region_rays {
    float org[3][CGT_RAYS_CHUNK], dir[3][CGT_RAYS_CHUNK], t_min[CGT_RAYS_CHUNK], t_max[CGT_RAYS_CHUNK];
    uint32_t mask[CGT_RAYS_CHUNK], hit[CGT_PLANES][CGT_RAYS_CHUNK];
} region_rays;

/* The rays of a row of pixels from (x, y) on. */
static void region_row(const cgt_camera_rays *camera, uint32_t x, uint32_t y, uint32_t columns, uint32_t first,
                       region_rays *to)
{
    const cgt_camera_rays c = *camera; /* a copy: what is stored may not change it */
    for (uint32_t k = 0; k < columns; k++) {
        float org[3], dir[3];
        cgt_camera_pixel(&c, x + k, y, org, dir);
        for (int a = 0; a < 3; a++) {
            to->org[a][first + k] = org[a];
            to->dir[a][first + k] = dir[a];
        }
        to->t_min[first + k] = c.t_min;
        to->t_max[first + k] = c.t_max;
        to->mask[first + k] = c.mask;
    }
}

/* At most CGT_RAYS_CHUNK pixels. */
static void region_stream(const cgt_committed_scene *committed_scene, const cgt_camera_rays *c,
                          const cgt_trace_settings *settings, const cgt_region *r, region_rays *q, cgt_counts *counts)
{
    cgt_rays rays = {.count = (uint64_t)r->width * r->height,
                     .t_min = c->t_min == 0 ? NULL : q->t_min,
                     .t_max = c->t_max == INFINITY ? NULL : q->t_max,
                     .mask = c->mask == UINT32_MAX ? NULL : q->mask};
    for (int a = 0; a < 3; a++) {
        rays.org[a] = q->org[a];
        rays.dir[a] = q->dir[a];
    }
    for (uint32_t y = 0; y < r->height; y++)
        region_row(c, r->x, r->y + y, r->width, y * r->width, q);
    cgt_region to = *r;
    for (int k = 0; k < CGT_PLANES; k++)
        to.plane[k] = r->plane[k] ? q->hit[k] : NULL;
    const cgt_hits hits = cgt_region_hits(&to);
    CGT_KERNEL(cgt_bvh_trace_rays)(committed_scene, &rays, 0, rays.count, settings, &hits, NULL, counts);
    for (int k = 0; k < CGT_PLANES; k++)
        for (uint32_t y = 0; y < r->height && r->plane[k]; y++)
            memcpy(r->plane[k] + y * r->row_stride, q->hit[k] + y * r->width, r->width * sizeof(uint32_t));
}

static void region_streams(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                           const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts)
{
    region_rays *q = cgt_scratch_take(counts->scratch, sizeof *q);
    const uint32_t columns = region->width < CGT_RAYS_CHUNK ? region->width : CGT_RAYS_CHUNK;
    const uint32_t rows = CGT_RAYS_CHUNK / columns;
    for (uint32_t y = 0; y < region->height; y += rows)
        for (uint32_t x = 0; x < region->width; x += columns) {
            const cgt_region part = cgt_region_part(region, x, y, columns, rows);
            region_stream(committed_scene, camera, settings, &part, q, counts);
        }
    cgt_scratch_return(counts->scratch, q);
}

/* ---- packets ---- */

static void region_packets(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
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

void CGT_KERNEL(cgt_trace_region)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                                  const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts)
{
    const bool use_bvh = settings->use_bvh || committed_scene->structure == CGT_STRUCTURE_BVH;
    (use_bvh && !committed_scene->brute_force ? region_streams : region_packets)(committed_scene, camera, settings,
                                                                                 region, counts);
}
