/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cells along a Morton curve (model/morton_curve.h), a vector of middles at a time. */
#ifndef MORTON_CELLS_H
#define MORTON_CELLS_H

#include "dispatch/kernel.h"
#include "model/morton_curve.h"
#include "vector.h"

/* NaN, as 0 / 0 gives it, is in cell 0. */
CGT_SPU_INLINE vuint morton_cells(const cgt_morton_curve *c, const vfloat middle[3])
{
    vuint i[3], cell = spux_vuint(0);
    for (int a = 0; a < 3; a++) {
        const vfloat g = spu_mul(spu_sub(middle[a], spux_vfloat(c->low[a])), spux_vfloat(c->rcell[a]));
        i[a] = (vuint)spu_convts(spux_min(spux_max(g, spux_vfloat(0)), spux_vfloat(c->last[a])), 0);
    }
    for (uint32_t k = 0; k < c->runs; k++) {
        const cgt_morton_bits *run = &c->run[k];
        const vuint from = run->axis == 0 ? i[0] : run->axis == 1 ? i[1] : i[2];
        cell = spu_or(cell, spu_sl(spu_and(from, spux_vuint(run->mask)), run->shift));
    }
    return cell;
}

#endif
