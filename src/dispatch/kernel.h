/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The functions of a variant, in one table. The files of src/kernel/ are compiled once per row of the variant table;
 * CGT_KERNEL appends the variant's name to a function's, so that cgt_trace_region becomes cgt_trace_region_sse, and a
 * debugger and grep find it. */
#ifndef CGT_KERNEL_H
#define CGT_KERNEL_H

#include "model/committed_scene.h"
#include "query/camera.h"
#include "query/region.h"
#include "query/trace_settings.h"

/* Gets the references that found a full queue. */
typedef struct cgt_overflow_list {
    cgt_overflow *entry;
    uint32_t count, capacity;
    uint32_t needed_entries; /* of the next primitive, where the fill stopped for lack of room */
} cgt_overflow_list;

typedef struct cgt_fill_counts {
    uint64_t references;
    uint32_t large_primitives;
} cgt_fill_counts;

/* What keys are computed from. The key of a primitive is its cell, numbered through all levels; `skipped` is beyond. */
typedef struct cgt_loose_keys_job {
    const cgt_loose_grid *grid; /* its levels */
    const float *middle;        /* centres of triangles, see cgt_bounds_request */
    uint32_t triangles;
    uint32_t skipped;
} cgt_loose_keys_job;

struct cgt_cluster;

typedef struct cgt_kernel {
    const char *name;
    uint32_t lanes;
    const struct cgt_bvh_builder *bvh_builder; /* steps that build a BVH (builders/bvh/bvh_build.h) */

    /* Pushes the valid ones of primitives first to end - 1 to the voxels, in ascending order. Returns end, or the
     * primitive that it stopped before because the overflow list might not hold its references. */
    uint32_t (*queue_grid_fill)(const cgt_queue_grid *grid, uint32_t first, uint32_t end, cgt_overflow_list *overflow,
                                cgt_fill_counts *counts);

    /* Adds primitives first to end - 1, all of one array, to the bounds, in order, and fills in what is requested. Stops
     * at the first index that is out of range. */
    void (*compute_bounds)(const cgt_primitive_array *array, uint32_t first, uint32_t end,
                           const cgt_bounds_request *request, cgt_primitive_bounds *bounds);

    /* Turns the corners of a chunk's clusters, which are complete, into centres and sizes, and adds those to the classes.
     * Writes whole vectors. */
    void (*compute_cluster_bounds)(struct cgt_cluster *cluster, uint32_t count, cgt_size_classes *classes);

    /* Writes the keys of primitives first to end - 1, all of one array, to key[0] and on; skipped ones get job->skipped. */
    void (*loose_grid_keys)(const cgt_loose_keys_job *job, const cgt_primitive_array *array, uint32_t first,
                            uint32_t end, uint32_t *key);

    /* The same for clusters. */
    void (*loose_grid_cluster_keys)(const cgt_loose_keys_job *job, const struct cgt_cluster *cluster, uint32_t count,
                                    uint32_t *key);

    /* Traces the pixels of a region of a camera's frame by packets. */
    void (*trace_region)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                         const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts);

    /* The same by tiles, for frames that cgt_tile_supports (query/tile_limits.h). */
    void (*trace_tile)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                       const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts);

    /* Traces rays first to end - 1 of an array: at most CGT_RAYS_CHUNK, or CGT_STREAM_CHUNK where settings->use_bvh is set
     * and committed_scene->brute_force is not. hits is NULL where occluded is not. */
    void (*trace_rays)(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first, uint64_t end,
                       const cgt_trace_settings *settings, const cgt_hits *hits, uint8_t *occluded, cgt_counts *counts);

    /* Finds any hit between a light and points first to end - 1, at most CGT_RAYS_CHUNK; of `points` directions are not
     * used. */
    void (*trace_light)(const cgt_committed_scene *committed_scene, const cgt_rays *points, const cgt_light *light,
                        uint64_t first, uint64_t end, const cgt_trace_settings *settings, uint8_t *occluded,
                        cgt_counts *counts);

    /* Estimates, with a loose grid, how many primitives lie in the cone of the light and points first to end - 1, at most
     * CGT_RAYS_CHUNK. UINT32_MAX where the light cannot go by tiles. */
    uint64_t (*light_prims)(const cgt_committed_scene *committed_scene, const cgt_rays *points, const cgt_light *light,
                            uint64_t first, uint64_t end);
} cgt_kernel;

#define CGT_KERNEL_JOIN_(name, variant) name##_##variant
#define CGT_KERNEL_JOIN(name, variant) CGT_KERNEL_JOIN_(name, variant)
#define CGT_KERNEL(name) CGT_KERNEL_JOIN(name, CGT_VARIANT)

#endif
