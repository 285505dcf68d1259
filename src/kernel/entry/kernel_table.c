/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The row's functions as a table: cgt_kernel_sse and the like, for src/dispatch/variant.c. */
#include "dispatch/kernel.h"

cgt_compute_bounds_fn CGT_KERNEL(cgt_compute_array_bounds);
cgt_compute_cluster_bounds_fn CGT_KERNEL(cgt_compute_cluster_bounds);
cgt_prim_keys_fn CGT_KERNEL(cgt_loose_grid_keys);
cgt_cluster_keys_fn CGT_KERNEL(cgt_loose_grid_cluster_keys);
cgt_measure_levels_fn CGT_KERNEL(cgt_loose_grid_measure);
cgt_measure_clusters_fn CGT_KERNEL(cgt_loose_grid_measure_clusters);
cgt_trace_region_fn CGT_KERNEL(cgt_trace_region), CGT_KERNEL(cgt_trace_tile);
cgt_trace_rays_fn CGT_KERNEL(cgt_trace_rays);
cgt_trace_one_ray_fn CGT_KERNEL(cgt_trace_one_ray);
cgt_occluded_one_ray_fn CGT_KERNEL(cgt_occluded_one_ray);
cgt_trace_light_fn CGT_KERNEL(cgt_trace_light);
cgt_light_prims_fn CGT_KERNEL(cgt_tile_light_prims);
cgt_light_keys_fn CGT_KERNEL(cgt_light_keys);
cgt_list_frame_points_fn CGT_KERNEL(cgt_list_frame_points);
cgt_ambient_rays_fn CGT_KERNEL(cgt_ambient_rays);
cgt_resolve_rays_fn CGT_KERNEL(cgt_resolve_rays);

extern const struct cgt_bvh_builder CGT_KERNEL(cgt_bvh_builder);
extern const struct cgt_paper_kernels CGT_KERNEL(cgt_paper_kernels);

#define NAME_(variant) #variant
#define NAME(variant) NAME_(variant)

const cgt_kernel CGT_KERNEL(cgt_kernel) = {
    .name = NAME(CGT_VARIANT),
    .lanes = CGT_LANES,
    .bvh_builder = &CGT_KERNEL(cgt_bvh_builder),
    .papers = &CGT_KERNEL(cgt_paper_kernels),
    .compute_bounds = CGT_KERNEL(cgt_compute_array_bounds),
    .compute_cluster_bounds = CGT_KERNEL(cgt_compute_cluster_bounds),
    .loose_grid_keys = CGT_KERNEL(cgt_loose_grid_keys),
    .loose_grid_cluster_keys = CGT_KERNEL(cgt_loose_grid_cluster_keys),
    .loose_grid_measure = CGT_KERNEL(cgt_loose_grid_measure),
    .loose_grid_measure_clusters = CGT_KERNEL(cgt_loose_grid_measure_clusters),
    .trace_region = CGT_KERNEL(cgt_trace_region),
    .trace_tile = CGT_KERNEL(cgt_trace_tile),
    .trace_rays = CGT_KERNEL(cgt_trace_rays),
    .trace_one_ray = CGT_KERNEL(cgt_trace_one_ray),
    .occluded_one_ray = CGT_KERNEL(cgt_occluded_one_ray),
    .trace_light = CGT_KERNEL(cgt_trace_light),
    .light_prims = CGT_KERNEL(cgt_tile_light_prims),
    .light_keys = CGT_KERNEL(cgt_light_keys),
    .list_frame_points = CGT_KERNEL(cgt_list_frame_points),
    .ambient_rays = CGT_KERNEL(cgt_ambient_rays),
    .resolve_rays = CGT_KERNEL(cgt_resolve_rays),
};
