/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What points and frames against a light share: when they go by tiles through the loose grid, and when tiles give up. */
#ifndef CGT_TRACE_LIGHT_H
#define CGT_TRACE_LIGHT_H

#include "core/scratch_tasks.h"
#include "trace/bands/band_call.h"
#include "trace/point_batch.h"
#include "trace/trace_call.h"

/* Where a BVH may take over: the work for each point, in references and tests of groups, after which tiles give a task
 * up. The estimate takes primitives for evenly spread over the bounds of the scene; one far away makes it too small. The
 * work is bounded by a few times what the BVH takes. */
#define CGT_MAX_LIGHT_WORK 128u
/* Points of such a task share little: each counts as so many rays for the BVH's building. */
#define CGT_SCATTERED_POINTS 4u

#define CGT_LIGHT_GIVEN_UP 0xffu /* the first result of a task that tiles gave up, until it is traced otherwise */

/* Checks a light. */
cgt_result cgt_check_light(cgt_context *c, const cgt_light *light);

/* Whether the structure and the scene's size allow for tiles at all. */
bool cgt_light_allows_tiles(const cgt_committed_scene *s);

/* Whether neighbouring points, at most a chunk, are near enough to each other for tiles, as the light sees them. */
bool cgt_light_points_are_coherent(const cgt_scene *s, const cgt_light *light, const cgt_rays *points, uint64_t first,
                                   uint64_t count);

/* Points against a light, in tasks: each traces its points, in a scene in bands through *bands, and adds them to *given_up
 * where tiles gave them up. */
typedef struct cgt_light_tasks {
    const cgt_scene *scene;
    const cgt_light *light;
    cgt_scratch_task *trace, *trace_given_up;
    void *argument;
    uint32_t tasks;
    _Atomic uint64_t *given_up;
    const cgt_band_call **bands;
} cgt_light_tasks;

/* Runs them all, and those that tiles gave up once more: through the BVH, or by tiles with any work where there is none
 * yet. */
cgt_result cgt_light_run_structure(const cgt_light_tasks *tasks, cgt_trace_settings *settings);

/* Runs them in a scene in bands: by tiles, then what these gave up through BVHs, which are built for that. Rays of one direction go through
 * BVHs at once. points: of all tasks; chunk: the most that a task traces at once. */
cgt_result cgt_light_run_bands(const cgt_light_tasks *tasks, cgt_trace_settings *settings, uint64_t points,
                               uint32_t chunk);

#endif
