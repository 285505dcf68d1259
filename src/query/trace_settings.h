/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the tracing calls pass to the kernels, and the counts that they get back. */
#ifndef CGT_TRACE_SETTINGS_H
#define CGT_TRACE_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>

#include <cgt/research.h>

#define CGT_RAYS_CHUNK 4096u /* rays of an array that one task traces */

/* The same, of calls with enough rays for all threads: larger streams share more of the traversal and fill more
 * lanes. */
#define CGT_STREAM_CHUNK (2 * CGT_RAYS_CHUNK)

/* Why points against a light go the way that they go (trace/light_choice.h). */
typedef enum cgt_light_way {
    CGT_LIGHT_WAY_NONE = 0, /* no light, or a scene in bands */
    CGT_LIGHT_WAY_UNSERVED, /* no tiles: they do not serve this light or this scene */
    CGT_LIGHT_WAY_TILES,    /* tiles, and their work was within a tree's and its price */
    CGT_LIGHT_WAY_TREE,     /* no tiles: a BVH is there, and tiles gave up before, or the points are few */
    CGT_LIGHT_WAY_GIVEN_UP, /* tiles, which gave some points up */
    CGT_LIGHT_WAYS
} cgt_light_way;

/* The choices of a call; no AUTO is left. */
typedef struct cgt_trace_settings {
    uint32_t packet; /* edge of a camera's packets: 4, 8, 16 */
    bool strip;      /* tiles of four scanlines */
    bool flattened;
    cgt_cull cull;
    bool mailbox;
    cgt_kd_traversal kd_traversal;
    cgt_precision precision;
    cgt_triangle_test triangle_test;
    bool light_tiles;        /* points against a light go through the loose grid, tile by tile */
    uint32_t max_light_work; /* for each point, that tiles may take; 0: any. trace/light_choice.h has the unit */
    cgt_light_way light_way;
    bool use_bvh;    /* rays go through committed_scene->bvh. Where it is false, another thread may be building that:
                         it must not be read then */
    uint32_t fields; /* cgt_field values that somebody asked for */
} cgt_trace_settings;

/* What a task has for itself: its counts, fields of cgt_trace_statistics and cgt_research_trace_statistics, which are
 * all uint64_t and added up as an array; and scratch memory. */
typedef struct cgt_counts {
    uint64_t rays, invalid_rays, hits, bvh_rays, tiles, packets, split_packets, slices, cells, nodes, leaves,
        rope_steps, exact_steps, rope_loops, references, mailbox_skipped, cull_tests, culled, packet_tests, ray_tests,
        double_tests, exact_tests, exact_values, early_exits, given_up, light_work;
    struct cgt_scratch *scratch; /* core/scratch.h; of no use to kernels of one ray */
} cgt_counts;

#define CGT_COUNTS (offsetof(cgt_counts, scratch) / sizeof(uint64_t))

#endif
