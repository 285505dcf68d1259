/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What points against lights have taken by tiles since the commit. Any thread adds to it, and reads what others have
 * added by then: it decides the way that points go, never what is found. */
#ifndef CGT_LIGHT_HISTORY_H
#define CGT_LIGHT_HISTORY_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#define CGT_LIGHT_HASHES 16u   /* lights share what they met where they have the same hash */
#define CGT_LIGHT_ESTIMATES 4u /* classes of primitives between light and points, as they were estimated */

/* Points that tiles tried, and the work that they took (CGT_LIGHT_MAX_WORK has the unit). References of cells for which
 * tables of open groups were asked, and those that these kept (kernel/light/light_table.h). */
typedef struct cgt_light_experience {
    _Atomic uint64_t tree_points; /* that went through a tree, since they took too much */
    atomic_bool wants_tree;       /* before the last commit, they would have paid for building it */
    _Atomic uint64_t points, work, table_read, table_kept;
} cgt_light_experience;

typedef struct cgt_light_history {
    cgt_light_experience of[CGT_LIGHT_HASHES][CGT_LIGHT_ESTIMATES];
    cgt_light_experience ordered; /* of points in the order of any light */
    _Atomic uint64_t build_work;  /* what a tree's building takes */
    _Atomic uint64_t tree_work;   /* what a point through it takes */
    uint32_t commits;             /* with lights that wanted trees */
    atomic_bool used;
} cgt_light_history;

/* The work beyond what a tree would have taken for the points of one light and estimate. */
static inline uint64_t cgt_light_excess(const cgt_light_history *h, const cgt_light_experience *x)
{
    const uint64_t work = atomic_load_explicit(&x->work, memory_order_relaxed),
                   by_tree = atomic_load_explicit(&x->points, memory_order_relaxed) *
                             atomic_load_explicit(&h->tree_work, memory_order_relaxed);
    return work > by_tree ? work - by_tree : 0;
}

/* Of all. */
static inline uint64_t cgt_light_history_excess(const cgt_light_history *h)
{
    uint64_t excess = 0;
    for (uint32_t i = 0; i < CGT_LIGHT_HASHES; i++)
        for (uint32_t k = 0; k < CGT_LIGHT_ESTIMATES; k++)
            excess += cgt_light_excess(h, &h->of[i][k]);
    return excess;
}

/* Whether a tree would have paid, had it been there from the commit on. A point that went through one is taken to have
 * spared as much as it took. */
static inline bool cgt_light_history_wants_tree(const cgt_light_history *h)
{
    uint64_t points = 0;
    for (uint32_t i = 0; i < CGT_LIGHT_HASHES; i++)
        for (uint32_t k = 0; k < CGT_LIGHT_ESTIMATES; k++)
            points += atomic_load_explicit(&h->of[i][k].tree_points, memory_order_relaxed);
    const uint64_t spared = points * atomic_load_explicit(&h->tree_work, memory_order_relaxed);
    return spared + cgt_light_history_excess(h) > atomic_load_explicit(&h->build_work, memory_order_relaxed);
}

/* Each commit begins anew, but for one thing: where points wanted a tree that pays, they will again, and to find that out
 * would be lost work. Every sixteenth commit tries tiles anyhow, since scenes change. */
#define CGT_LIGHT_RETRIAL 16u

static inline void cgt_light_history_forget(cgt_light_history *h)
{
    if (!atomic_load_explicit(&h->used, memory_order_relaxed))
        return;
    const bool pays = cgt_light_history_wants_tree(h) && ++h->commits % CGT_LIGHT_RETRIAL;
    for (uint32_t i = 0; i < CGT_LIGHT_HASHES; i++)
        for (uint32_t k = 0; k < CGT_LIGHT_ESTIMATES; k++) {
            cgt_light_experience *x = &h->of[i][k];
            const bool wanted = atomic_load_explicit(&x->tree_points, memory_order_relaxed) || cgt_light_excess(h, x);
            atomic_store_explicit(&x->wants_tree, pays && wanted, memory_order_relaxed);
            atomic_store_explicit(&x->tree_points, 0, memory_order_relaxed);
            atomic_store_explicit(&x->points, 0, memory_order_relaxed);
            atomic_store_explicit(&x->work, 0, memory_order_relaxed);
            atomic_store_explicit(&x->table_read, 0, memory_order_relaxed);
            atomic_store_explicit(&x->table_kept, 0, memory_order_relaxed);
        }
    atomic_store_explicit(&h->ordered.points, 0, memory_order_relaxed);
    atomic_store_explicit(&h->ordered.work, 0, memory_order_relaxed);
    atomic_store_explicit(&h->used, false, memory_order_relaxed);
}

#endif
