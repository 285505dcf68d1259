/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The simulation of cgt-bench scaling: made-up tasks whose schedules are worked out by hand, and what is recorded. */
#include "support/suite.h"

#include <string.h>

#include "scaling/scaling_times.h"

#define MOST 64u
#define MANY 20u
static double busy_until[MOST];

/* Two batches of one phase around one of another, and 5 ms that are serial. */
static double ms[] = {1, 1, 1, 3, /**/ 4, 4, /**/ 3, 1, 1, 1};
static scaling_batch batches[] = {{"sort", 0, 4}, {"trace", 4, 2}, {"sort", 6, 4}};
static const scaling_times call = {.ms = ms, .batch = batches, .batches = 3, .serial_ms = 5};

static void expect(const char *phase, uint32_t threads, const double figures[5])
{
    const scaling_figures f = scaling_simulate(&call, phase, threads, busy_until);
    assert_true(f.tasks == figures[0]);
    assert_true(f.longest == figures[1]);
    assert_true(f.sum == figures[2]);
    assert_true(f.simulated == figures[3]);
    assert_true(f.limit == figures[4]);
}

/* A long task at the end costs more than one at the beginning: 1 + 3 and 1 + 1; 3 and 1 + 1 + 1. */
TEST(tasks_are_taken_in_order)
{
    expect("sort", 1, (const double[5]){8, 3, 12, 12, 6});
    expect("sort", 2, (const double[5]){8, 3, 12, 4 + 3, 6});
    expect("sort", 3, (const double[5]){8, 3, 12, 4 + 3, 6});
    expect("sort", 4, (const double[5]){8, 3, 12, 3 + 3, 6});
    expect("sort", MOST, (const double[5]){8, 3, 12, 3 + 3, 6});
    expect("trace", 1, (const double[5]){2, 4, 8, 8, 4});
    expect("trace", 2, (const double[5]){2, 4, 8, 4, 4});
    expect("none", 2, (const double[5]){0, 0, 0, 0, 0});
}

/* No batch begins before the one ahead of it has ended, and what is serial has no share in any. */
TEST(batches_wait_and_serial_parts_stay)
{
    expect(scaling_serial, 1, (const double[5]){0, 0, 5, 5, 5});
    expect(scaling_serial, MOST, (const double[5]){0, 0, 5, 5, 5});
    expect(NULL, 1, (const double[5]){10, 4, 25, 25, 15});
    expect(NULL, 2, (const double[5]){10, 4, 25, 5 + 4 + 4 + 3, 15});
    expect(NULL, MOST, (const double[5]){10, 4, 25, 15, 15});
}

/* Works for as long as no thread's clock can miss. */
static void work(scaling_times *t, const char *phase, uint32_t tasks, uint32_t task)
{
    static volatile unsigned sum;
    scaling_times_watch(t, phase, tasks, task, false);
    for (unsigned i = 0; i < 100000; i++)
        sum += i;
    (void)sum;
    scaling_times_watch(t, phase, tasks, task, true);
}

TEST(tasks_are_recorded)
{
    scaling_times t = {0};
    for (int round = 0; round < 2; round++) { /* what was before is forgotten */
        scaling_times_reset(&t);
        for (int k = 0; k < 3; k++) { /* calls add up */
            scaling_times_begin(&t);
            work(&t, "one", 1, 0);
            for (uint32_t i = 0; i < MANY; i++)
                work(&t, "many", MANY, i);
            scaling_times_end(&t);
        }
        assert_false(t.failed);
        assert_int_equal(t.batches, 6);
        for (size_t i = 0; i < 6; i++) {
            assert_string_equal(t.batch[i].phase, i % 2 ? "many" : "one");
            assert_int_equal(t.batch[i].tasks, i % 2 ? MANY : 1);
            assert_int_equal(t.batch[i].first, i / 2 * (1 + MANY) + i % 2);
        }
        const scaling_figures f = scaling_simulate(&t, NULL, 2, busy_until);
        assert_true(f.tasks == 3 * (1 + MANY));
        assert_true(f.sum > 0 && t.serial_ms >= 0 && t.serial_ms < f.sum);
        assert_true(f.simulated <= f.sum && f.simulated >= f.limit && 2 * f.simulated >= f.sum);
    }
    scaling_times_release(&t);
}

SUITE(NULL, NULL)
