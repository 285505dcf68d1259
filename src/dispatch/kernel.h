/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a variant offers: one table of functions. The files of this folder are compiled once per row of the variant
 * table; CGT_KERNEL puts the variant's name behind a function's, so that cgt_trace_region becomes
 * cgt_trace_region_sse, and a debugger and grep find it. */
#ifndef CGT_KERNEL_H
#define CGT_KERNEL_H

#include "query/camera.h"
#include "query/region.h"
#include "model/committed_scene.h"
#include "query/trace_settings.h"

/* Where a fill puts references that found a full queue. */
typedef struct cgt_overflow_list {
    cgt_overflow *entry;
    uint32_t count, capacity;
    uint32_t needed_entries; /* room that the next object needs, where the fill stopped for lack of it */
} cgt_overflow_list;

typedef struct cgt_fill_counts {
    uint64_t references;
    uint32_t large_primitives;
} cgt_fill_counts;

/* What the cells of objects are found from. A key is a cell of all levels; `skipped` is beyond them. */
typedef struct cgt_loose_keys_job {
    const cgt_loose_grid *grid; /* levels are there */
    const float *middle;        /* of triangles, see cgt_bounds_request */
    uint32_t triangles;
    uint32_t skipped;
} cgt_loose_keys_job;

struct cgt_cluster;

typedef struct cgt_kernel {
    const char *name;
    uint32_t lanes;
    const struct cgt_bvh_builder *bvh_builder; /* steps that build a wide tree (bvh_build.h) */

    /* Pushes the valid ones of objects first to end - 1 to the voxels, in ascending order. Returns end, or the object
     * before which it stopped because the overflow list might not hold what that object spills. */
    uint32_t (*queue_grid_fill)(const cgt_queue_grid *grid, uint32_t first, uint32_t end, cgt_overflow_list *overflow,
                                cgt_fill_counts *counts);

    /* Adds objects first to end - 1, all of one array, to a summary, in order, and to what else is wished for. Stops at
     * the first index that is out of range. */
    void (*compute_bounds)(const cgt_primitive_array *array, uint32_t first, uint32_t end,
                           const cgt_bounds_request *request, cgt_primitive_bounds *bounds);

    /* Turns the corners of clusters, gathered by all that a chunk's objects are in, to middles and sizes, and adds those to
     * classes. Writes whole vectors. */
    void (*compute_cluster_bounds)(struct cgt_cluster *cluster, uint32_t count, cgt_size_classes *classes);

    /* The cells of objects first to end - 1, all of one array, to key[0] and on; skipped ones get job->skipped. */
    void (*loose_grid_keys)(const cgt_loose_keys_job *job, const cgt_primitive_array *array, uint32_t first,
                            uint32_t end, uint32_t *key);

    /* The same of clusters, to key[0] and on. */
    void (*loose_grid_cluster_keys)(const cgt_loose_keys_job *job, const struct cgt_cluster *cluster, uint32_t count,
                                    uint32_t *key);

    /* Traces the pixels of a region of a camera's frame. */
    void (*trace_region)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                         const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts);

    /* The same, tile by tile, where tiles serve (tile_limits.h); else as trace_region does. */
    void (*trace_tile)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                       const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts);

    /* Traces rays first to end - 1 of an array, at most CGT_RAYS_CHUNK, or CGT_STREAM_CHUNK where settings->wide is set
     * and not world->everything; hits is NULL where occluded is not. */
    void (*trace_rays)(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first, uint64_t end,
                       const cgt_trace_settings *settings, const cgt_hits *hits, uint8_t *occluded, cgt_counts *counts);

    /* Any hit between a light and points first to end - 1, at most CGT_RAYS_CHUNK: origins and ranges of `points`. */
    void (*trace_light)(const cgt_committed_scene *committed_scene, const cgt_rays *points, const cgt_light *light,
                        uint64_t first, uint64_t end, const cgt_trace_settings *settings, uint8_t *occluded,
                        cgt_counts *counts);

    /* With a loose grid: about how many objects lie in the cone about the light and points first to end - 1, at most
     * CGT_RAYS_CHUNK. UINT32_MAX where tiles do not serve the light. */
    uint64_t (*light_prims)(const cgt_committed_scene *committed_scene, const cgt_rays *points, const cgt_light *light,
                            uint64_t first, uint64_t end);
} cgt_kernel;

#define CGT_KERNEL_JOIN_(name, variant) name##_##variant
#define CGT_KERNEL_JOIN(name, variant) CGT_KERNEL_JOIN_(name, variant)
#define CGT_KERNEL(name) CGT_KERNEL_JOIN(name, CGT_VARIANT)

#endif
