/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a variant offers: one table of functions. The files of src/kernel/ are compiled once per row of the variant
 * table; CGT_KERNEL appends the row's name to a function's, so that cgt_trace_region becomes cgt_trace_region_sse, and
 * a debugger and grep find it. Each entry has one function type, which also serves its prototype. */
#ifndef CGT_KERNEL_H
#define CGT_KERNEL_H

#include "core/scratch.h"
#include "model/committed_scene.h"
#include "query/camera.h"
#include "query/light_view.h"
#include "query/region.h"
#include "query/trace_settings.h"

struct cgt_cluster;
struct cgt_hit_list;       /* query/hit_list.h */
struct cgt_ambient_pixels; /* query/ambient_directions.h, and the next two */
struct cgt_ambient_points;
struct cgt_ambient_rays;
struct cgt_bvh_builder;   /* dispatch/bvh_builder.h */
struct cgt_paper_kernels; /* papers/kernel/paper_kernels.h */

/* ---- building ---- */

/* Adds primitives first to end - 1, all of one array, to the bounds, in order, and to what else is requested. Stops at
 * the first index that is out of range. */
typedef void cgt_compute_bounds_fn(const cgt_primitive_array *array, uint32_t first, uint32_t end,
                                   const cgt_bounds_request *request, cgt_primitive_bounds *bounds);

/* Converts the corners of clusters, to which a chunk's primitives were all added, to middles and sizes, and adds these
 * to classes. Writes whole vectors. Returns how many have more half area than max_half_area. */
typedef uint32_t cgt_compute_cluster_bounds_fn(struct cgt_cluster *cluster, uint32_t count, float max_half_area,
                                               cgt_size_classes *classes, cgt_scratch *scratch);

/* How cells are found: each of a structure's cells has a key; skipped primitives get one beyond all cells. */
typedef struct cgt_cell_keys {
    const void *plan;    /* where the cells lie: a cgt_loose_grid with its levels, or a cgt_bvh_plan */
    const float *middle; /* of boxed primitives, see cgt_bounds_request */
    uint32_t boxed;
    uint32_t skipped; /* key of skipped primitives */
} cgt_cell_keys;

/* Writes the keys of primitives first to end - 1, all of one array, to key[0] and on. */
typedef void cgt_prim_keys_fn(const cgt_cell_keys *keys, const cgt_primitive_array *array, uint32_t first, uint32_t end,
                              uint32_t *key);

/* Writes the keys of clusters to key[0] and on. */
typedef void cgt_cluster_keys_fn(const cgt_cell_keys *keys, const struct cgt_cluster *cluster, uint32_t count,
                                 uint32_t *key);

/* Adds the same primitives, or clusters, to the sizes of a loose grid's levels: class k stands for level k. keys->plan:
 * the grid, whose levels need no cells yet. Half extents are sizes. key: is overwritten, as long. */
typedef void cgt_measure_levels_fn(const cgt_cell_keys *keys, const cgt_primitive_array *array, uint32_t first,
                                   uint32_t end, uint32_t *key, cgt_size_classes *levels, cgt_scratch *scratch);
typedef void cgt_measure_clusters_fn(const cgt_cell_keys *keys, const struct cgt_cluster *cluster, uint32_t count,
                                     uint32_t *key, cgt_size_classes *levels, cgt_scratch *scratch);

/* ---- tracing ----
 *
 * counts->scratch: of the task; only kernels of one ray do without. */

/* Traces the pixels of a region of a camera's frame. */
typedef void cgt_trace_region_fn(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                                 const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts);

/* Traces rays first to end - 1 of an array, at most CGT_RAYS_CHUNK, or CGT_STREAM_CHUNK where settings->use_bvh is set
 * and not committed_scene->brute_force; hits is NULL where occluded is not. */
typedef void cgt_trace_rays_fn(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first,
                               uint64_t end, const cgt_trace_settings *settings, const cgt_hits *hits,
                               uint8_t *occluded, cgt_counts *counts);

/* Traces one ray, through the BVH or else the structure of the commit. Returns the primitive that it hits first, or
 * with any_hit some, CGT_INVALID_ID for none. Counts the ray and its hit. */
typedef uint32_t cgt_trace_one_ray_fn(const cgt_committed_scene *committed_scene, const cgt_single_ray *from,
                                      bool use_bvh, bool any_hit, cgt_counts *counts);

/* Lists the first hits of each list's ray, a valid one that is not off, through the BVH or else the structure of the
 * commit. */
typedef void cgt_list_hits_fn(const cgt_committed_scene *committed_scene, bool use_bvh, struct cgt_hit_list *lists,
                              uint32_t count, cgt_counts *counts);

/* Finds any hit between a light and points first to end - 1, at most CGT_RAYS_CHUNK: origins and ranges of `points`.
 * Returns false if it would take more than settings->max_light_work: then the work is counted, the points are not, and
 * what `occluded` has of them is undefined. */
typedef bool cgt_trace_light_fn(const cgt_committed_scene *committed_scene, const cgt_rays *points,
                                const cgt_light *light, uint64_t first, uint64_t end,
                                const cgt_trace_settings *settings, uint8_t *occluded, cgt_counts *counts);

/* Whether all points, at most CGT_RAYS_CHUNK, need a ray: they are neither off nor invalid. */
typedef bool cgt_light_all_live_fn(const cgt_rays *points, const cgt_light *light);

/* Finds the keys of points first to end - 1, at most CGT_RAYS_CHUNK: key[0] is that of the first one. */
typedef void cgt_light_keys_fn(const cgt_rays *points, const cgt_light *light, const cgt_light_view *view,
                               uint64_t first, uint64_t end, uint16_t *key);

/* Lists the hits of a frame's tile, whose first pixel is (x0, y0), as points (dispatch/frame_points.h). */
struct cgt_frame_source;
struct cgt_frame_points;
typedef void cgt_list_frame_points_fn(const struct cgt_frame_source *source, uint32_t x0, uint32_t y0,
                                      struct cgt_frame_points *points);

/* Makes `samples` rays of ambient occlusion for each pixel, at most CGT_STREAM_CHUNK in all. */
typedef void cgt_ambient_rays_fn(const cgt_camera_rays *camera, const struct cgt_ambient_pixels *pixels,
                                 uint32_t samples, const struct cgt_ambient_points *points,
                                 struct cgt_ambient_rays *rays);

/* ---- values of hits ---- */

/* Computes and stores the hits of rays first to end - 1, in double and exactly: prim[i] is the primitive that ray
 * first + i hits, CGT_INVALID_ID for none. Counts hits and what their values took. */
typedef void cgt_resolve_rays_fn(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first,
                                 uint64_t end, const uint32_t *prim, const cgt_trace_settings *settings,
                                 const cgt_hits *hits, cgt_counts *counts);

/* Computes the hit of one ray, which hits that primitive: the same bits. */
typedef void cgt_resolve_one_ray_fn(const cgt_committed_scene *committed_scene, const cgt_single_ray *from,
                                    uint32_t prim, cgt_precision precision, cgt_hit *hit, cgt_counts *counts);

/* ---- the table ---- */

/* The type of each entry, its name, and the function of a row that it points to. trace_region goes by rays or packets;
 * trace_tile by whole tiles, for frames that cgt_tile_supports (query/tile_limits.h). */
#define CGT_KERNELS(K)                                                                                                 \
    K(cgt_compute_bounds_fn, compute_bounds, cgt_compute_array_bounds)                                                 \
    K(cgt_compute_cluster_bounds_fn, compute_cluster_bounds, cgt_compute_cluster_bounds)                               \
    K(cgt_prim_keys_fn, loose_grid_keys, cgt_loose_grid_keys)                                                          \
    K(cgt_cluster_keys_fn, loose_grid_cluster_keys, cgt_loose_grid_cluster_keys)                                       \
    K(cgt_measure_levels_fn, loose_grid_measure, cgt_loose_grid_measure)                                               \
    K(cgt_measure_clusters_fn, loose_grid_measure_clusters, cgt_loose_grid_measure_clusters)                           \
    K(cgt_trace_region_fn, trace_region, cgt_trace_region)                                                             \
    K(cgt_trace_region_fn, trace_tile, cgt_trace_tile)                                                                 \
    K(cgt_trace_rays_fn, trace_rays, cgt_trace_rays)                                                                   \
    K(cgt_trace_one_ray_fn, trace_one_ray, cgt_trace_one_ray)                                                          \
    K(cgt_list_hits_fn, list_hits, cgt_list_hits)                                                                      \
    K(cgt_trace_light_fn, trace_light, cgt_trace_light)                                                                \
    K(cgt_light_all_live_fn, light_all_live, cgt_light_all_live)                                                       \
    K(cgt_light_keys_fn, light_keys, cgt_light_keys)                                                                   \
    K(cgt_list_frame_points_fn, list_frame_points, cgt_list_frame_points)                                              \
    K(cgt_ambient_rays_fn, ambient_rays, cgt_ambient_rays)                                                             \
    K(cgt_resolve_rays_fn, resolve_rays, cgt_resolve_rays)                                                             \
    K(cgt_resolve_one_ray_fn, resolve_one_ray, cgt_resolve_one_ray)

typedef struct cgt_kernel {
    const char *name;
    uint32_t lanes;
    const struct cgt_bvh_builder *bvh_builder;
    const struct cgt_paper_kernels *papers;
#define CGT_KERNEL_ENTRY(type, name, function) type *name;
    CGT_KERNELS(CGT_KERNEL_ENTRY)
#undef CGT_KERNEL_ENTRY
} cgt_kernel;

#define CGT_KERNEL_JOIN_(name, variant) name##_##variant
#define CGT_KERNEL_JOIN(name, variant) CGT_KERNEL_JOIN_(name, variant)
#define CGT_KERNEL(name) CGT_KERNEL_JOIN(name, CGT_VARIANT)

#endif
