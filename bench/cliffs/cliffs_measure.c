/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Measures a scene within bounded time: each call begins with few rays and grows by four until it takes too long. */
#define _POSIX_C_SOURCE 200809L

#include "cliffs/bench_cliffs.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "common/bench_timing.h"

enum { MOST_RUNS = 5, SINGLE_STEPS = 2 };

int cliffs_input_make(cliffs_input *input, const cliff *c, bool disturbed, uint32_t count, uint32_t steps)
{
    const uint32_t rays = (uint32_t)CLIFFS_RAYS << 2 * (steps - 1);
    memset(input, 0, sizeof *input);
    input->cliff = c;
    input->disturbed = disturbed;
    input->steps = steps;
    input->rays = malloc(rays * sizeof *input->rays);
    if (!input->rays || !cliff_make(&input->scene, c, disturbed, count)) {
        program_error("out of memory for %u primitives", (unsigned)count);
        free(input->rays);
        return -1;
    }
    cliff_make_rays(&input->scene, c, disturbed, input->rays, rays);
    return 0;
}

void cliffs_input_free(cliffs_input *input)
{
    for (uint32_t k = 0; k < CLIFFS_STEPS; k++)
        cliff_points_free(&input->points[k]);
    cliff_free(&input->scene);
    free(input->rays);
}

/* Milliseconds. Of one thread the processor's time, which other programs on the machine do not add to. */
static double now_ms(const cliffs_settings *settings)
{
    struct timespec now;
    if (settings->shared.threads != 1 || clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now))
        return bench_now_ms();
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

/* The shortest of a few runs that together stay within the limit. Returns what prepare does. */
static int measure_step(const cliffs_settings *settings, const cliffs_program *program, cliff_call call, uint32_t step,
                        cliffs_times *times)
{
    double spent = 0, least = 0;
    for (int run = 0; run < MOST_RUNS && (run == 0 || spent + least < settings->limit_ms); run++) {
        const int prepared = program->prepare(program->self, call, step);
        if (prepared)
            return prepared;
        const double begin = now_ms(settings);
        if (program->run(program->self, call, step))
            return -1;
        const double ms = now_ms(settings) - begin;
        least = run == 0 || ms < least ? ms : least;
        spent += ms;
    }
    times->hits[step] = program->hits(program->self, call, step);
    times->ms[step] = least;
    times->steps = step + 1;
    return 0;
}

static uint32_t steps_of(const cliffs_settings *settings, cliff_call call)
{
    if (call == CLIFF_COMMIT)
        return 1;
    return call == CLIFF_SINGLE && settings->steps > SINGLE_STEPS ? SINGLE_STEPS : settings->steps;
}

static uint64_t rays_of(const cliffs_input *input, cliff_call call, uint32_t step)
{
    if (call == CLIFF_COMMIT)
        return 0;
    return call == CLIFF_LIGHT ? input->points[step].count : (uint64_t)CLIFFS_RAYS << 2 * step;
}

static int measure_call(const cliffs_settings *settings, const cliffs_input *input, const cliffs_program *program,
                        cliff_call call, cliffs_times *times)
{
    const uint32_t steps = steps_of(settings, call);
    for (uint32_t k = 0; k < steps && (k == 0 || 4 * times->ms[k - 1] <= settings->limit_ms); k++) {
        const int code = measure_step(settings, program, call, k, times);
        if (code)
            return code < 0 ? -1 : 0;
        times->rays[k] = rays_of(input, call, k);
    }
    return 0;
}

int cliffs_measure(const cliffs_settings *settings, const cliffs_input *input, const cliffs_program *program,
                   cliffs_result *result)
{
    memset(result, 0, sizeof *result);
    for (int call = 0; call < CLIFF_CALLS; call++)
        if ((!input->disturbed || cliff_concerns(input->cliff, (cliff_call)call)) &&
            bench_is_chosen(settings->call, CLIFF_CALLS, call) &&
            measure_call(settings, input, program, (cliff_call)call, &result->call[call]))
            return -1;
    return 0;
}
