/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Undecided pairs of pixel and object go to the PPE (cell/programs/spe_doubts.h). */
#ifndef GRID_DOUBTS_H
#define GRID_DOUBTS_H

#include "cell/programs/grid/grid_store.h"

/* Ray i of the current packet and an object. The packet's number of a set, 0 for a camera's, says whose rays they
 * are. */
static __attribute__((noinline)) void grid_add_doubt(uint32_t i, uint32_t object)
{
    spe_doubts_add(&s()->doubts, (s()->y + i / 4) << 16 | (s()->x + i % 4), object | s()->origin[i]);
}

/* Sends what is left, and tells of it in the report. */
static void grid_end_doubts(void)
{
    const spe_doubts *const d = &s()->doubts;
    spe_doubts_end(&s()->doubts);
    s()->report.doubts = d->doubts;
    s()->report.rest_half = d->half;
    s()->report.rest = d->half_doubts;
}

#endif
