/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The row's functions as a table: cgt_kernel_sse and its like, for src/dispatch/variant.c. */
#include "dispatch/kernel.h"

uint32_t CGT_KERNEL(cgt_queue_grid_fill)(const cgt_queue_grid *grid, uint32_t first, uint32_t end,
                                         cgt_overflow_list *overflow, cgt_fill_counts *counts);
void CGT_KERNEL(cgt_compute_array_bounds)(const cgt_primitive_array *array, uint32_t first, uint32_t end,
                                          const cgt_bounds_request *request, cgt_primitive_bounds *bounds);
void CGT_KERNEL(cgt_loose_grid_compute_keys)(const cgt_loose_keys_job *job, const cgt_primitive_array *array,
                                             uint32_t first, uint32_t end, uint32_t *key);
void CGT_KERNEL(cgt_compute_cluster_bounds)(struct cgt_cluster *cluster, uint32_t count, cgt_size_classes *classes);
void CGT_KERNEL(cgt_loose_grid_cluster_keys)(const cgt_loose_keys_job *job, const struct cgt_cluster *cluster,
                                             uint32_t count, uint32_t *key);
void CGT_KERNEL(cgt_trace_region)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                                  const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts);
void CGT_KERNEL(cgt_trace_tile)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                                const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts);
void CGT_KERNEL(cgt_trace_rays)(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first,
                                uint64_t end, const cgt_trace_settings *settings, const cgt_hits *hits,
                                uint8_t *occluded, cgt_counts *counts);
void CGT_KERNEL(cgt_trace_light)(const cgt_committed_scene *committed_scene, const cgt_rays *points,
                                 const cgt_light *light, uint64_t first, uint64_t end,
                                 const cgt_trace_settings *settings, uint8_t *occluded, cgt_counts *counts);
uint64_t CGT_KERNEL(cgt_tile_light_prims)(const cgt_committed_scene *committed_scene, const cgt_rays *points,
                                          const cgt_light *light, uint64_t first, uint64_t end);

extern const struct cgt_bvh_builder CGT_KERNEL(cgt_bvh_builder);

#define NAME_(variant) #variant
#define NAME(variant) NAME_(variant)

const cgt_kernel CGT_KERNEL(cgt_kernel) = {
    .name = NAME(CGT_VARIANT),
    .lanes = CGT_LANES,
    .bvh_builder = &CGT_KERNEL(cgt_bvh_builder),
    .queue_grid_fill = CGT_KERNEL(cgt_queue_grid_fill),
    .compute_bounds = CGT_KERNEL(cgt_compute_array_bounds),
    .compute_cluster_bounds = CGT_KERNEL(cgt_compute_cluster_bounds),
    .loose_grid_keys = CGT_KERNEL(cgt_loose_grid_compute_keys),
    .loose_grid_cluster_keys = CGT_KERNEL(cgt_loose_grid_cluster_keys),
    .trace_region = CGT_KERNEL(cgt_trace_region),
    .trace_tile = CGT_KERNEL(cgt_trace_tile),
    .trace_rays = CGT_KERNEL(cgt_trace_rays),
    .trace_light = CGT_KERNEL(cgt_trace_light),
    .light_prims = CGT_KERNEL(cgt_tile_light_prims),
};
