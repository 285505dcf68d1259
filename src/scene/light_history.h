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
    atomic_bool wants_tree;       /* so many did before the last commit that they paid for building it */
    _Atomic uint64_t points, work, table_read, table_kept;
} cgt_light_experience;

typedef struct cgt_light_history {
    cgt_light_experience of[CGT_LIGHT_HASHES][CGT_LIGHT_ESTIMATES];
    _Atomic uint64_t tree_pays; /* that many points through a tree pay for building it; of the last call */
    uint32_t commits;           /* since lights came */
    atomic_bool used;
} cgt_light_history;

/* Each commit begins anew, but for one thing: where points needed a tree that paid, they will again, and a trial would
 * be lost. Every sixteenth commit tries anyhow, since scenes change. */
#define CGT_LIGHT_RETRIAL 16u

static inline void cgt_light_history_forget(cgt_light_history *h)
{
    if (!atomic_load_explicit(&h->used, memory_order_relaxed))
        return;
    uint64_t tree_points = 0;
    for (uint32_t i = 0; i < CGT_LIGHT_HASHES; i++)
        for (uint32_t k = 0; k < CGT_LIGHT_ESTIMATES; k++)
            tree_points += atomic_load_explicit(&h->of[i][k].tree_points, memory_order_relaxed);
    const bool pays = tree_points && tree_points >= atomic_load_explicit(&h->tree_pays, memory_order_relaxed) &&
                      ++h->commits % CGT_LIGHT_RETRIAL;
    for (uint32_t i = 0; i < CGT_LIGHT_HASHES; i++)
        for (uint32_t k = 0; k < CGT_LIGHT_ESTIMATES; k++) {
            cgt_light_experience *x = &h->of[i][k];
            atomic_store_explicit(&x->wants_tree,
                                  pays && atomic_load_explicit(&x->tree_points, memory_order_relaxed) > 0,
                                  memory_order_relaxed);
            atomic_store_explicit(&x->tree_points, 0, memory_order_relaxed);
            atomic_store_explicit(&x->points, 0, memory_order_relaxed);
            atomic_store_explicit(&x->work, 0, memory_order_relaxed);
            atomic_store_explicit(&x->table_read, 0, memory_order_relaxed);
            atomic_store_explicit(&x->table_kept, 0, memory_order_relaxed);
        }
    atomic_store_explicit(&h->used, false, memory_order_relaxed);
}

#endif
