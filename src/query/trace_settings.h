/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the tracing calls and the kernels hand to each other. */
#ifndef CGT_TRACE_SETTINGS_H
#define CGT_TRACE_SETTINGS_H

#include <stdbool.h>

#include <cgt/cgt.h>

#define CGT_RAYS_CHUNK 4096u /* rays of an array that one task traces */

/* The same, of calls that are large enough for all threads: streams of more rays share more of the way, and fill more
 * lanes. */
#define CGT_STREAM_CHUNK (2 * CGT_RAYS_CHUNK)

/* The choices of a call, made: no AUTO left. */
typedef struct cgt_trace_settings {
    uint32_t packet; /* edge of a camera's packets: 4, 8, 16 */
    bool strip;      /* tiles of four scanlines */
    bool tiled;      /* nothing is asked about packets and their tests: tiles of a loose grid may go without */
    bool flattened;
    cgt_cull cull;
    bool mailbox;
    cgt_kd_traversal kd_traversal;
    cgt_precision precision;
    cgt_triangle_test triangle_test;
    bool light_tiles; /* points against a light go through the loose grid, tile by tile */
    bool use_bvh;    /* there is a wide tree that rays may go through. Where it is false, another thread may be building
                        one: world->wide must not be looked at then */
    uint32_t fields; /* cgt_field values that anybody wants */
} cgt_trace_settings;

/* Counts of one task; summed into cgt_trace_statistics, whose fields they are. All are uint64_t: they are added up as
 * an array. */
typedef struct cgt_counts {
    uint64_t rays, invalid_rays, hits, bvh_rays, tiles, packets, split_packets, slices, cells, nodes, leaves,
        rope_steps, exact_steps, rope_loops, references, mailbox_skipped, cull_tests, culled, packet_tests, ray_tests,
        double_tests, exact_tests, exact_values, early_exits;
} cgt_counts;

#define CGT_COUNTS (sizeof(cgt_counts) / sizeof(uint64_t))

#endif
