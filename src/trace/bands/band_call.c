/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scratch memory, waves of tasks, and what bands' kernels are asked for. */
#include "trace/bands/band_call.h"

#include "builders/bvh/bvh_on_demand.h"

#define RUNNER_SLOTS 16u /* of a caller's runner, whose threads are not known */

/* Planes for call->slot_rays, a multiple of 16. */
cgt_band_scratch cgt_band_slot(const cgt_band_call *call, uint32_t slot)
{
    const uint32_t rays = call->slot_rays;
    void *memory = (char *)call->memory + slot * CGT_BAND_SCRATCH_BYTES((size_t)rays);
    cgt_band_scratch s = {.capacity = rays, .best = memory};
    uint32_t *plane = (uint32_t *)(void *)(s.best + rays);
    float **const floats[] = {&s.org[0], &s.org[1], &s.org[2], &s.dir[0], &s.dir[1],
                              &s.dir[2], &s.t_min,  &s.t_max,  &s.t};
    uint32_t **const integers[] = {&s.mask, &s.skip_primitive, &s.skip_geometry, &s.ray, &s.primitive, &s.geometry};
    for (size_t i = 0; i < sizeof floats / sizeof floats[0]; i++, plane += rays)
        *floats[i] = (float *)(void *)plane;
    for (size_t i = 0; i < sizeof integers / sizeof integers[0]; i++, plane += rays)
        *integers[i] = plane;
    s.exponent = (int32_t *)(void *)plane;
    s.occluded = (uint8_t *)(plane + rays);
    return s;
}

cgt_result cgt_bands_begin(const cgt_scene *scene, const cgt_trace_settings *settings, uint64_t rays,
                           uint32_t max_chunk, cgt_band_call *call)
{
    const cgt_context *c = scene->context;
    *call = (cgt_band_call){.scene = scene, .settings = settings};
    const uint64_t chunks = (rays + max_chunk - 1) / max_chunk,
                   slots = c->threads ? 2 * (uint64_t)c->threads : RUNNER_SLOTS;
    const uint64_t chunk = rays < max_chunk ? rays : max_chunk;
    call->slots = (uint32_t)(chunks < 1 ? 1 : chunks < slots ? chunks : slots);
    call->slot_rays = (uint32_t)(chunk + 15) / 16 * 16 + 16;
    call->bytes = (size_t)call->slots * CGT_BAND_SCRATCH_BYTES((size_t)call->slot_rays);
    call->memory = cgt_allocate(&c->memory, call->bytes);
    return call->memory ? CGT_OK
                        : cgt_fail(scene->context, CGT_ERROR_OUT_OF_MEMORY,
                                   "trace: out of memory for rays through bands of magnitudes");
}

cgt_result cgt_bands_build_bvh(cgt_band_call *call, uint64_t rays)
{
    const struct cgt_bands *bands = call->scene->bands;
    cgt_result result = CGT_OK;
    for (uint32_t b = 0; b < bands->count && result == CGT_OK; b++)
        result = cgt_bvh_build_on_demand(bands->band[b].scene, rays, &call->use_bvh[b]);
    return result;
}

void cgt_bands_end(cgt_band_call *call)
{
    if (call->memory)
        cgt_free(&call->scene->context->memory, call->memory, call->bytes);
    call->memory = NULL;
}

typedef struct band_wave {
    cgt_scratch_task *task;
    void *argument;
    uint32_t first;
} band_wave;

static void run_task(void *argument, uint32_t index, cgt_scratch *scratch)
{
    const band_wave *w = argument;
    w->task(w->argument, w->first + index, scratch);
}

cgt_result cgt_bands_run(const cgt_band_call *call, cgt_scratch_task *task, void *argument, uint32_t count)
{
    cgt_result result = CGT_OK;
    for (uint32_t first = 0; first < count && result == CGT_OK; first += call->slots) {
        band_wave w = {task, argument, first};
        const uint32_t tasks = count - first < call->slots ? count - first : call->slots;
        result = cgt_run_scratch_tasks(call->scene->context, run_task, &w, tasks);
    }
    return result;
}

cgt_trace_settings cgt_band_settings(const cgt_trace_settings *settings)
{
    cgt_trace_settings s = *settings;
    s.precision = CGT_PRECISION_EXACT;
    s.triangle_test = CGT_TRIANGLE_TEST_AUTO;
    s.fields = CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY;
    s.light_tiles = s.use_bvh = false;
    return s;
}

void cgt_band_add_counts(cgt_counts *to, const cgt_counts *counts)
{
    uint64_t sum[CGT_COUNTS], value[CGT_COUNTS];
    cgt_counts added = *counts;
    added.rays = added.invalid_rays = added.hits = added.exact_values = 0; /* those of the call */
    memcpy(sum, to, sizeof sum);
    memcpy(value, &added, sizeof value);
    for (size_t i = 0; i < CGT_COUNTS; i++)
        sum[i] += value[i];
    memcpy(to, sum, sizeof sum);
}
