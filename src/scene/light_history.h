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
    _Atomic uint64_t points, work, table_read, table_kept;
} cgt_light_experience;

typedef struct cgt_light_history {
    cgt_light_experience of[CGT_LIGHT_HASHES][CGT_LIGHT_ESTIMATES];
    _Atomic uint64_t excess; /* work beyond what a tree takes, not yet counted for building one */
    atomic_bool used;
} cgt_light_history;

static inline void cgt_light_history_forget(cgt_light_history *h)
{
    if (!atomic_load_explicit(&h->used, memory_order_relaxed))
        return;
    for (uint32_t i = 0; i < CGT_LIGHT_HASHES; i++)
        for (uint32_t k = 0; k < CGT_LIGHT_ESTIMATES; k++) {
            atomic_store_explicit(&h->of[i][k].points, 0, memory_order_relaxed);
            atomic_store_explicit(&h->of[i][k].work, 0, memory_order_relaxed);
            atomic_store_explicit(&h->of[i][k].table_read, 0, memory_order_relaxed);
            atomic_store_explicit(&h->of[i][k].table_kept, 0, memory_order_relaxed);
        }
    atomic_store_explicit(&h->excess, 0, memory_order_relaxed);
    atomic_store_explicit(&h->used, false, memory_order_relaxed);
}

#endif
