/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Records tasks by the clock of the thread's CPU time, and simulates threads that share them. */
#include "scaling/scaling_times.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_timing.h"

const char scaling_serial[] = "serial";

/* ---- recording ---- */

void scaling_times_reset(scaling_times *times)
{
    times->batches = 0;
    times->serial_ms = 0;
    times->failed = false;
}

void scaling_times_release(scaling_times *times)
{
    free(times->ms);
    free(times->batch);
    memset(times, 0, sizeof *times);
}

void scaling_times_begin(scaling_times *times) { times->ended_ms = bench_thread_ms(); }

void scaling_times_end(scaling_times *times) { times->serial_ms += bench_thread_ms() - times->ended_ms; }

/* Makes room for `count` elements, and for twice as many as there were. */
static bool reserve(void **array, size_t *room, size_t count, size_t size)
{
    if (count <= *room)
        return true;
    const size_t more = count < 2 * *room ? 2 * *room : count;
    void *const larger = more <= SIZE_MAX / size ? realloc(*array, more * size) : NULL;
    if (!larger)
        return false;
    *array = larger;
    *room = more;
    return true;
}

/* Adds a batch, and room for all its tasks. */
static void add_batch(scaling_times *t, const char *phase, uint32_t tasks)
{
    const scaling_batch *last = t->batches ? &t->batch[t->batches - 1] : NULL;
    const scaling_batch added = {phase, last ? last->first + last->tasks : 0, tasks};
    void *batch = t->batch, *ms = t->ms;
    t->failed |= !reserve(&batch, &t->batch_room, t->batches + 1, sizeof *t->batch) ||
                 !reserve(&ms, &t->task_room, added.first + tasks, sizeof *t->ms);
    t->batch = batch;
    t->ms = ms;
    if (!t->failed && batch) /* it is there, which clang's analyzer does not see */
        t->batch[t->batches++] = added;
}

void scaling_times_watch(void *user, const char *phase, uint32_t tasks, uint32_t task, bool ended)
{
    scaling_times *const t = user;
    const double now = bench_thread_ms();
    if (ended) {
        if (!t->failed)
            t->ms[t->batch[t->batches - 1].first + task] = now - t->began_ms;
        t->ended_ms = now;
        return;
    }
    if (task == 0) {
        t->serial_ms += now - t->ended_ms;
        add_batch(t, phase, tasks);
    }
    t->began_ms = bench_thread_ms();
}

/* ---- simulation ---- */

/* Until the last task of a batch ends. */
static double run_batch(const double *ms, size_t tasks, uint32_t threads, double *busy_until)
{
    double end = 0;
    for (uint32_t k = 0; k < threads; k++)
        busy_until[k] = 0;
    for (size_t i = 0; i < tasks; i++) {
        uint32_t first = 0; /* the thread that is free first takes the next task */
        for (uint32_t k = 1; k < threads; k++)
            first = busy_until[k] < busy_until[first] ? k : first;
        busy_until[first] += ms[i];
        end = fmax(end, busy_until[first]);
    }
    return end;
}

scaling_figures scaling_simulate(const scaling_times *times, const char *phase, uint32_t threads, double *busy_until)
{
    scaling_figures f = {0};
    if (!phase || phase == scaling_serial)
        f.sum = f.simulated = f.limit = times->serial_ms;
    for (size_t i = 0; i < times->batches; i++) {
        const scaling_batch *b = &times->batch[i];
        const double *ms = times->ms + b->first;
        double longest = 0;
        if (phase && strcmp(phase, b->phase) != 0)
            continue;
        for (size_t k = 0; k < b->tasks; k++) {
            f.sum += ms[k];
            longest = fmax(longest, ms[k]);
        }
        f.tasks += (double)b->tasks;
        f.longest = fmax(f.longest, longest);
        f.limit += longest;
        f.simulated += run_batch(ms, b->tasks, threads, busy_until);
    }
    return f;
}
