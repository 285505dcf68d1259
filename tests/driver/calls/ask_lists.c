/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All hits, and all crossings: by a visitor, in rows, one ray at a time, going on after a hit. */
#include <math.h>
#include <string.h>

#include "driver/driver.h"

static uint32_t listed(const driver_run *run) { return run->rays < DRIVER_LISTED ? run->rays : DRIVER_LISTED; }
static cgt_rays asked_rays(const driver_run *run) { return driver_ray_array(run->ray, listed(run)); }

/* ---- by a visitor ---- */

typedef struct list_call {
    driver_run *run;
    driver_lists *lists;
    bool crossings, fast;
    const char *name;
} list_call;

static cgt_visit take_hits(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    driver_lists *l = user;
    if (ray >= DRIVER_LISTED) { /* calls follow in order */
        if (l->nearest[ray].primitive == CGT_INVALID_ID)
            l->nearest[ray] = hits[0];
        return CGT_VISIT_CONTINUE;
    }
    for (uint32_t k = 0; k < count && l->count[ray] < DRIVER_LIST; k++)
        l->hit[ray][l->count[ray]++] = hits[k];
    return CGT_VISIT_CONTINUE;
}

static judge_answer answer_of(const cgt_hit *h)
{
    return (judge_answer){h->t, h->primitive, h->geometry, {h->normal[0], h->normal[1], h->normal[2]}, {h->u, h->v}};
}

static void judge_list(const list_call *c, uint32_t i)
{
    driver_run *run = c->run;
    const judge_ray *ray = &run->ray[i];
    const judge_truth *right = &c->lists->right[i];
    uint32_t at = 0, j = 0;
    run->count[COUNT_ANSWERS]++;
    for (; j < c->lists->count[i]; j++) {
        const cgt_hit *h = &c->lists->hit[i][j];
        const int64_t k = judge_next(&run->scene, &run->pool, right, &at, h->geometry, h->primitive, (int)h->surface,
                                     c->fast ? NAN : h->t);
        if (k < 0)
            break;
        const judge_answer answer = answer_of(h);
        const char *wrong = c->fast ? NULL : judge_values(&run->scene, ray, &run->pool.hit[k], &answer);
        run->count[COUNT_VALUES]++;
        if (wrong)
            driver_fail(run, ray, c->name, "hit %u of primitive %u.%u at %a: %s", (unsigned)j, (unsigned)h->geometry,
                        (unsigned)h->primitive, (double)h->t, wrong);
    }
    if (j == c->lists->count[i] && judge_is_end(&run->pool, right, at))
        return;
    const cgt_hit *got = j < c->lists->count[i] ? &c->lists->hit[i][j] : NULL;
    const judge_hit *due = j < right->count ? &run->pool.hit[right->first + j] : NULL;
    driver_fail(run, ray, c->name, "%u of %u; hit %u is %d.%d at %a side %d, not %d.%d at %a side %d",
                (unsigned)c->lists->count[i], (unsigned)right->count, (unsigned)j, got ? (int)got->geometry : -1,
                got ? (int)got->primitive : -1, got ? (double)got->t : 0, got ? (int)got->surface : -1,
                due ? (int)run->scene.primitive[due->index].geometry : -1,
                due ? (int)run->scene.primitive[due->index].primitive : -1, due ? (double)due->values.t : 0,
                due ? due->far : -1);
}

static void driver_fail_bits(const list_call *c, uint32_t i)
{
    const driver_lists *l = c->lists;
    uint32_t j = 0;
    while (j < l->count[i] && j < l->first_count[i] && !memcmp(&l->first[i][j], &l->hit[i][j], sizeof l->hit[i][j]))
        j++;
    const cgt_hit *a = &l->first[i][j], *b = &l->hit[i][j];
    if (j == l->count[i] || j == l->first_count[i])
        driver_fail(c->run, &c->run->ray[i], c->name, "%u hits, in the first setup %u", (unsigned)l->count[i],
                    (unsigned)l->first_count[i]);
    else
        driver_fail(c->run, &c->run->ray[i], c->name,
                    "hit %u: not the bits of the first setup: t %a, normal %a %a %a, u %a, v %a, surface %d, not t %a, "
                    "normal %a %a %a, u %a, v %a, surface %d",
                    (unsigned)j, (double)b->t, (double)b->normal[0], (double)b->normal[1], (double)b->normal[2],
                    (double)b->u, (double)b->v, (int)b->surface, (double)a->t, (double)a->normal[0],
                    (double)a->normal[1], (double)a->normal[2], (double)a->u, (double)a->v, (int)a->surface);
}

static void compare_with_first(const list_call *c, uint32_t i)
{
    driver_lists *l = c->lists;
    const size_t bytes = l->count[i] * sizeof l->hit[i][0];
    if (!c->run->setup.number) {
        l->first_count[i] = l->count[i];
        memcpy(l->first[i], l->hit[i], bytes);
    } else if (l->count[i] != l->first_count[i] || memcmp(l->first[i], l->hit[i], bytes) != 0)
        driver_fail_bits(c, i);
}

/* The first hit is the nearest one. */
static void judge_first(const list_call *c, uint32_t i)
{
    driver_run *const run = c->run;
    const judge_answer answer = answer_of(&c->lists->nearest[i]);
    const char *const wrong = judge_nearest(&run->scene, &run->pool, &run->right[i], &run->ray[i], c->fast, &answer);
    run->count[COUNT_ANSWERS]++;
    if (wrong)
        driver_fail(run, &run->ray[i], c->name, "the first of all: %s: %d.%d at %a", wrong, (int)answer.geometry,
                    (int)answer.primitive, (double)answer.t);
}

/* Of all rays, so that streams are long; of those beyond the first the nearest hit alone is judged. */
static bool visit_lists(const list_call *c)
{
    const cgt_rays rays = driver_ray_array(c->run->ray, c->run->rays);
    const cgt_all_hits_options all = {.crossings = c->crossings};
    const cgt_trace_options options = {.precision = c->fast ? CGT_PRECISION_FAST : CGT_PRECISION_EXACT};
    memset(c->lists->count, 0, sizeof c->lists->count);
    for (uint32_t i = 0; i < c->run->rays; i++)
        c->lists->nearest[i] = (cgt_hit){.t = INFINITY, .primitive = CGT_INVALID_ID, .geometry = CGT_INVALID_ID};
    if (!driver_succeeds(c->run,
                         cgt_visit_all_rays(c->run->setup.scene, &rays, &all, CGT_FIELD_NORMAL | CGT_FIELD_UV,
                                            take_hits, c->lists, &options),
                         "cgt_visit_all_rays"))
        return false;
    for (uint32_t i = 0; i < listed(c->run); i++) {
        judge_list(c, i);
        if (!c->fast)
            compare_with_first(c, i);
    }
    for (uint32_t i = listed(c->run); i < c->run->rays && !c->crossings; i++)
        judge_first(c, i);
    return true;
}

/* ---- rows ---- */

#define ROW_MOST 6u
#define ODD 0x77777777u

/* Elements of a row, with gaps: one hit is `step` words. */
typedef struct row_arrays {
    uint32_t step;
    uint32_t word[9][DRIVER_LISTED * ROW_MOST * 3];
    uint32_t count[DRIVER_LISTED];
    uint8_t more[DRIVER_LISTED];
    uint32_t from[DRIVER_LISTED], after[3][DRIVER_LISTED]; /* hits are left out up to one of them */
} row_arrays;

/* After a hit of the ray, or from its begin. */
static void go_on_after(const list_call *c, uint32_t i, bool goes_on, row_arrays *a)
{
    const uint32_t count = c->lists->count[i];
    a->from[i] = goes_on && count ? random_below(&c->run->scene.random, count + 1) : 0;
    const cgt_hit *const last = a->from[i] ? &c->lists->hit[i][a->from[i] - 1] : NULL;
    a->after[0][i] = last ? last->primitive : CGT_INVALID_ID;
    a->after[1][i] = last ? last->geometry : 0;
    a->after[2][i] = last ? (uint32_t)last->surface : 0;
}

static bool is_row(const list_call *c, const row_arrays *a, uint32_t capacity, uint32_t i, bool asks_more)
{
    const uint32_t first = a->from[i], all = c->lists->count[i] - first, kept = all < capacity ? all : capacity;
    if (a->count[i] != kept || (asks_more && a->more[i] != (all > capacity)))
        return false;
    for (uint32_t j = 0; j < capacity; j++)
        for (uint32_t k = 0; k < 9; k++) {
            const uint32_t *from = &a->word[k][(i * capacity + j) * a->step];
            uint32_t word = ODD;
            if (j < kept)
                memcpy(&word, (const char *)&c->lists->hit[i][first + j] + 4 * k, sizeof word);
            for (uint32_t gap = 0; gap < a->step; gap++)
                if (from[gap] != (gap ? ODD : word))
                    return false;
        }
    return true;
}

static void check_rows(const list_call *c)
{
    static row_arrays a;
    test_random *r = &c->run->scene.random;
    const uint32_t capacity = 1 + random_below(r, ROW_MOST);
    const bool asks_more = random_below(r, 3);
    const cgt_rays rays = asked_rays(c->run);
    const bool goes_on = random_below(r, 2);
    const cgt_all_hits_options all = {.crossings = c->crossings,
                                      .after_primitive = goes_on ? a.after[0] : NULL,
                                      .after_geometry = goes_on ? a.after[1] : NULL,
                                      .after_surface = goes_on ? a.after[2] : NULL};
    memset(&a, 0x77, sizeof a);
    for (uint32_t i = 0; i < listed(c->run); i++)
        go_on_after(c, i, goes_on, &a);
    a.step = 1 + random_below(r, 3);
    float *f[9];
    for (int k = 0; k < 9; k++)
        f[k] = (float *)(void *)a.word[k];
    const cgt_hit_rows rows = {.capacity = capacity,
                               .hits = {.stride = 4 * a.step,
                                        .t = f[0],
                                        .primitive = a.word[1],
                                        .geometry = a.word[2],
                                        .normal = {f[4], f[5], f[6]},
                                        .u = f[7],
                                        .v = f[8]},
                               .surface = a.word[3],
                               .count = a.count,
                               .more = asks_more ? a.more : NULL};
    if (!driver_succeeds(c->run, cgt_trace_all_rays(c->run->setup.scene, &rays, &all, &rows, NULL),
                         "cgt_trace_all_rays"))
        return;
    for (uint32_t i = 0; i < listed(c->run); i++)
        if (!is_row(c, &a, capacity, i, asks_more))
            driver_fail(c->run, &c->run->ray[i], c->name, "a row of %u is not what follows hit %u", (unsigned)capacity,
                        (unsigned)a.from[i]);
    c->run->count[COUNT_ANSWERS] += listed(c->run);
}

/* ---- one ray, going on ---- */

/* Calls of a few hits each, each after the last one of the call before. Returns whether they find what one finds. */
static bool goes_on(const list_call *c, uint32_t i, const cgt_single_ray *single, uint32_t capacity)
{
    cgt_all_hits_options all = {.crossings = c->crossings};
    cgt_hit hit[ROW_MOST + 1], last;
    uint32_t found = 0, count = 0;
    bool more = true;
    while (more) {
        memset(hit, 0x77, sizeof hit);
        if (!driver_succeeds(c->run,
                             cgt_trace_all_ray(c->run->setup.scene, single, &all, hit, capacity, &count, &more, NULL),
                             "cgt_trace_all_ray"))
            return false;
        uint32_t word;
        memcpy(&word, &hit[count], sizeof word);
        if (word != ODD || found + count > c->lists->count[i] || (more && !count) ||
            memcmp(hit, &c->lists->hit[i][found], count * sizeof *hit) != 0)
            return false;
        found += count;
        if (count)
            last = hit[count - 1];
        all.after_primitive = &last.primitive;
        all.after_geometry = &last.geometry;
        all.after_surface = &last.surface;
    }
    return found == c->lists->count[i];
}

static void check_single(const list_call *c)
{
    test_random *r = &c->run->scene.random;
    cgt_single_ray single;
    for (uint32_t i = random_below(r, 3); i < listed(c->run); i += 1 + random_below(r, 4)) {
        if (!driver_single(&c->run->ray[i], &single))
            continue;
        const uint32_t capacity = 1 + random_below(r, ROW_MOST);
        c->run->count[COUNT_ANSWERS]++;
        if (!goes_on(c, i, &single, c->lists->count[i] > 64 ? ROW_MOST : capacity)) /* each call looks at all */
            driver_fail(c->run, &c->run->ray[i], c->name, "one ray does not go on as all of its hits do");
    }
}

static void check_lists(driver_run *run, bool crossings)
{
    list_call c = {.run = run,
                   .lists = crossings ? &run->crossings : &run->hits,
                   .crossings = crossings,
                   .fast = random_below(&run->scene.random, 4) == 0,
                   .name = crossings ? "crossings" : "all hits"};
    if (c.fast && !visit_lists(&c))
        return;
    c.fast = false;
    if (!visit_lists(&c))
        return;
    check_rows(&c);
    check_single(&c);
}

static void begin(driver_run *run)
{
    for (uint32_t i = 0; i < listed(run); i++) {
        run->hits.right[i] = run->right[i];
        if (!driver_has_crossings(run))
            continue;
        run->crossings.right[i] = driver_trace(run, &run->ray[i], JUDGE_CROSSINGS, false);
        run->count[COUNT_CROSSINGS] += run->crossings.right[i].count;
    }
}

static void ask(driver_run *run)
{
    cgt_hit hit;
    uint32_t count;
    const cgt_all_hits_options all = {.crossings = true};
    const cgt_single_ray single = {.dir = {1, 0, 0}};
    check_lists(run, false);
    if (driver_has_crossings(run))
        check_lists(run, true);
    else if (cgt_trace_all_ray(run->setup.scene, &single, &all, &hit, 1, &count, NULL, NULL) != CGT_ERROR_UNSUPPORTED)
        driver_fail(run, NULL, "crossings", "capsules are not refused");
}

const driver_call call_lists = {begin, ask};
