/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whether images in main memory are what the program expects: what is not must neither lead it beyond its arrays nor
 * let it run for ever. Floats are looked at by their bits, so that no infinity or NaN gets past, whatever the
 * arithmetic takes it for. Spheres and rays are not looked at: any bits in them are safe. Small rather than fast: local
 * store is full. */
#ifndef GRID_CHECK_H
#define GRID_CHECK_H

#include "cell/programs/grid/grid_store.h"

#define GRID_MOST_BITS 0x71800000u /* of 2^100, the scale of the smallest scene: above all other numbers */

/* Whether floats are at most that in size. */
static __attribute__((noinline)) bool grid_is_within(const float *x, uint32_t count)
{
    uint32_t bits, most = 0;
    for (uint32_t i = 0; i < count; i++) {
        memcpy(&bits, &x[i], sizeof bits);
        bits &= 0x7fffffff;
        most = bits > most ? bits : most;
    }
    return most <= GRID_MOST_BITS;
}

/* Strips of the picture; whoever asks for another one gets none. */
static uint32_t grid_count_strips(const cgt_control_block *c)
{
    return c->strip_columns * ((c->height + CGT_STRIP_ROWS - 1) / CGT_STRIP_ROWS);
}

static bool grid_check_control(const cgt_control_block *c)
{
    const uint32_t wide = CGT_STRIP_WIDTH * c->strip_columns; /* at least the width, by less than a strip */
    return c->magic == CGT_CONTROL_MAGIC && (c->width | c->height) < 0x10000 && wide - c->width < CGT_STRIP_WIDTH &&
           c->strip_columns < 0x100 && c->half - CGT_DOUBTS_LINE < 0x10000 && c->half % CGT_DOUBTS_LINE == 0 &&
           c->strips <= grid_count_strips(c);
}

/* The first members of both images are floats alone. */
static bool grid_check_images(const cgt_grid_image *g, const cgt_camera_image *c)
{
    _Static_assert(offsetof(cgt_grid_image, scale) == offsetof(cgt_grid_image, org) + 36, "ten floats from org on");
    return grid_is_within(g->org, 10) && grid_is_within(c->eye, 5);
}

#endif
