/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pairs of spheres whose centres are near each other. */
#ifndef NEAR_PAIRS_H
#define NEAR_PAIRS_H

#include <stdint.h>

/* Calls `take` once for each two of the spheres (x y z r) that are at most `longest` apart, first < second, with the
 * square of their distance; take returns 0, or -1 to end. Spheres at places that are not finite have no pairs. Returns
 * 0, or -1: no memory, or take ended it. */
int cgt_near_pairs_find(const float *xyzr, uint32_t count, float longest,
                        int (*take)(void *user, uint32_t first, uint32_t second, float square), void *user);

#endif
