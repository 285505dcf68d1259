/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points against a light in tasks, as arrays (trace_light.c) and frames (trace_shadows.c) have them: all of them once,
 * by the way that is chosen, and what tiles gave up once more. */
#ifndef CGT_LIGHT_TASKS_H
#define CGT_LIGHT_TASKS_H

#include "core/scratch_tasks.h"
#include "trace/bands/band_trace.h"
#include "trace/light_choice.h"
#include "trace/trace_call.h"

/* Checks a light. */
cgt_result cgt_check_light(cgt_context *c, const cgt_light *light);

typedef struct cgt_light_tasks cgt_light_tasks;
struct cgt_light_tasks {
    const cgt_scene *scene;
    const cgt_light *light;
    cgt_trace_settings *settings;
    cgt_trace_counter *counter;
    uint32_t count;
    uint64_t points; /* of all tasks, about */
    uint32_t most;   /* points of a task */
    void *owner;
    /* Traces the points of task `index` by cgt_light_trace_points, and returns what that returned. */
    bool (*trace)(void *owner, cgt_light_tasks *tasks, uint32_t index, cgt_counts *counts);
    /* The first result of a task, of whatever point. */
    uint8_t *(*first_result)(const void *owner, uint32_t index);
    /* of cgt_light_run */
    uint32_t step;              /* from one task to the next */
    bool again;                 /* only tasks that tiles gave up */
    const cgt_band_call *bands; /* NULL: the scene has none */
    cgt_light_choice choice;
};

/* Traces points 0 to count - 1 of task `index`. Returns false if tiles gave them up: then another pass traces them. */
bool cgt_light_trace_points(cgt_light_tasks *tasks, uint32_t index, const cgt_rays *points, uint64_t first,
                            uint64_t end, uint8_t *occluded, cgt_counts *counts);

/* Runs all tasks. */
cgt_result cgt_light_run(cgt_light_tasks *tasks);

#endif
