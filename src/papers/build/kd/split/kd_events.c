/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Events: sorted, merged, swept. */
#include "papers/build/kd/split/kd_events.h"

/* ---- sorting: by insertion where they are few, by merging runs, by digits where they are many ---- */

#define RUN_LENGTH 16
#define RADIX_MIN_EVENTS 2048

static void sort_run(cgt_kd_event *event, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        const cgt_kd_event e = event[i];
        size_t k = i;
        for (; k > 0 && event[k - 1] > e; k--)
            event[k] = event[k - 1];
        event[k] = e;
    }
}

static void merge_runs(const cgt_kd_event *from, size_t middle, size_t count, cgt_kd_event *to)
{
    size_t a = 0, b = middle;
    for (size_t i = 0; i < count; i++)
        to[i] = b == count || (a < middle && from[a] <= from[b]) ? from[a++] : from[b++];
}

static void sort_by_merging(cgt_kd_event *event, size_t count, cgt_kd_event *scratch)
{
    cgt_kd_event *from = event, *to = scratch;
    for (size_t i = 0; i < count; i += RUN_LENGTH)
        sort_run(event + i, count - i < RUN_LENGTH ? count - i : RUN_LENGTH);
    for (size_t run = RUN_LENGTH; run < count; run *= 2) {
        for (size_t i = 0; i < count; i += 2 * run) {
            const size_t pair_length = count - i < 2 * run ? count - i : 2 * run;
            merge_runs(from + i, pair_length < run ? pair_length : run, pair_length, to + i);
        }
        cgt_kd_event *swap = from;
        from = to;
        to = swap;
    }
    if (from != event)
        memcpy(event, from, count * sizeof *event);
}

/* The order of items within a plane stays, and was ascending among starts and among ends. */
static void sort_digit(const cgt_kd_event *from, size_t count, cgt_kd_event *to, unsigned shift)
{
    size_t start[2048] = {0}, sum = 0;
    for (size_t i = 0; i < count; i++)
        start[from[i] >> shift & 2047]++;
    for (int k = 0; k < 2048; k++) {
        const size_t n = start[k];
        start[k] = sum;
        sum += n;
    }
    for (size_t i = 0; i < count; i++)
        to[start[from[i] >> shift & 2047]++] = from[i];
}

void cgt_kd_sort_events(cgt_kd_event *event, size_t count, cgt_kd_event *scratch)
{
    if (count < RADIX_MIN_EVENTS) {
        sort_by_merging(event, count, scratch);
        return;
    }
    sort_digit(event, count, scratch, 32);
    sort_digit(scratch, count, event, 43);
    sort_digit(event, count, scratch, 54);
    memcpy(event, scratch, count * sizeof *event);
}

void cgt_kd_merge_events(cgt_kd_event *event, size_t count, const cgt_kd_event *added, size_t added_count)
{
    for (size_t to = count + added_count; added_count > 0;)
        event[--to] = count > 0 && event[count - 1] > added[added_count - 1] ? event[--count] : added[--added_count];
}

/* ---- the sweep ---- */

/* The items on the sides of a plane. */
typedef struct sides {
    double below, above; /* weights */
    uint32_t lower, upper;
} sides;

static void try_plane(const cgt_kd_rules *rules, const cgt_kd_box *box, const cgt_kd_shares *s, uint32_t axis,
                      float split, const sides *n, cgt_kd_plane *best)
{
    const double lower = (double)split - (double)box->low[axis], upper = (double)box->high[axis] - (double)split;
    const double below = n->lower ? n->below : 0, above = n->upper ? n->above : 0;
    const double cost_factor = n->lower && n->upper ? 1 : 1 - rules->costs.empty_cut_off;
    const double cost = (rules->costs.inner + (double)s->side[axis] * (below + above) +
                         (double)s->around[axis] * (lower * below + upper * above)) *
                        cost_factor;
    if (cost < best->cost && cgt_kd_is_inside(box, axis, split))
        *best = (cgt_kd_plane){axis, split, (float)cost, !n->lower, !n->upper, n->upper > n->lower};
}

void cgt_kd_sweep_events(const cgt_kd_rules *rules, const cgt_kd_box *box, uint32_t axis, const cgt_kd_item *item,
                         uint32_t count, const cgt_kd_event *event, double weight, cgt_kd_plane *best)
{
    const cgt_kd_shares s = cgt_kd_area_shares(box);
    const size_t events = 2 * (size_t)count;
    sides n = {0, weight, 0, count};
    for (size_t i = 0; i < events;) {
        const int32_t plane = cgt_kd_event_plane(event[i]);
        for (; i < events && cgt_kd_event_plane(event[i]) == plane && !cgt_kd_event_is_start(event[i]); i++) {
            n.above -= item[cgt_kd_event_item(event[i])].weight;
            n.upper--;
        }
        try_plane(rules, box, &s, axis, cgt_kd_plane_at(plane), &n, best);
        for (; i < events && cgt_kd_event_plane(event[i]) == plane; i++) {
            n.below += item[cgt_kd_event_item(event[i])].weight;
            n.lower++;
        }
    }
}
