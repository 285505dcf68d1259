/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How a box is divided into cells along a Morton curve. */
#include "model/morton_curve.h"

#include <stddef.h>

/* Returns the axis of the longest edge, or -1 where none is above 0. */
static int longest_edge(const float edge[3])
{
    int longest = -1;
    for (int a = 0; a < 3; a++)
        if (edge[a] > (longest < 0 ? 0 : edge[longest]))
            longest = a;
    return longest;
}

/* Moves bit `bit` of an axis to bit `key`. Neighbours that move equally far form one run. */
static void add_bit(cgt_morton_curve *c, int axis, uint32_t bit, uint32_t key)
{
    cgt_morton_bits *last = c->runs ? &c->run[c->runs - 1] : NULL;
    if (last && last->axis == (uint32_t)axis && last->shift == key - bit)
        last->mask |= UINT32_C(1) << bit;
    else
        c->run[c->runs++] = (cgt_morton_bits){(uint32_t)axis, UINT32_C(1) << bit, key - bit};
}

void cgt_morton_curve_init(const float low[3], const float high[3], uint32_t bits, cgt_morton_curve *curve)
{
    int axis[CGT_MORTON_BITS];
    uint32_t along[3] = {0, 0, 0};
    float edge[3];
    for (int a = 0; a < 3; a++)
        edge[a] = high[a] - low[a];
    curve->bits = 0;
    curve->runs = 0;
    for (int a = longest_edge(edge); curve->bits < bits && a >= 0; a = longest_edge(edge)) {
        axis[curve->bits++] = a;
        along[a]++;
        edge[a] *= 0.5f;
    }
    for (int a = 0; a < 3; a++) {
        const float cells = (float)(UINT32_C(1) << along[a]), extent = high[a] - low[a];
        curve->low[a] = low[a];
        curve->rcell[a] = along[a] ? cells / extent : 0;
        curve->last[a] = cells - 1;
    }
    for (uint32_t k = 0; k < curve->bits; k++)
        add_bit(curve, axis[k], --along[axis[k]], curve->bits - 1 - k);
}
