/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What points and frames against a light share: when they go by tiles through the loose grid, and when tiles give up. */
#ifndef CGT_TRACE_LIGHT_H
#define CGT_TRACE_LIGHT_H

#include "core/scratch_tasks.h"
#include "trace/light_choice.h"
#include "trace/bands/band_call.h"
#include "trace/point_batch.h"
#include "trace/trace_call.h"

#define CGT_LIGHT_GIVEN_UP 0xffu /* the first result of a task that tiles gave up, until it is traced otherwise */

/* Checks a light. */
cgt_result cgt_check_light(cgt_context *c, const cgt_light *light);

/* Points against a light, in tasks: each traces its points, in a scene in bands through *bands, and adds them to
 * progress->given_up where tiles gave them up. */
typedef struct cgt_light_tasks {
    const cgt_scene *scene;
    const cgt_light *light;
    cgt_scratch_task *trace, *trace_given_up;
    void *argument;
    uint32_t tasks;
    cgt_light_progress *progress;
    const cgt_band_call **bands;
} cgt_light_tasks;

/* Runs them all as cgt_light_choose has set it, and what tiles gave up once more. */
cgt_result cgt_light_run_structure(const cgt_light_tasks *tasks, cgt_trace_settings *settings);

/* Runs them in a scene in bands: by tiles, then what these gave up through BVHs, which are built for that. Rays of one direction go through
 * BVHs at once. points: of all tasks; chunk: the most that a task traces at once. */
cgt_result cgt_light_run_bands(const cgt_light_tasks *tasks, cgt_trace_settings *settings, uint64_t points,
                               uint32_t chunk);

#endif
