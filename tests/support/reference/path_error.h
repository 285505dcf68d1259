/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The error of paths between mirrors after each bounce, against the same path in long double. Free of the test
 * framework: tests bound it, cgt-bench accuracy prints it. */
#ifndef PATH_ERROR_H
#define PATH_ERROR_H

#include <stdbool.h>
#include <stdint.h>

#include <cgt/cgt.h>

enum { PATH_BOUNCES = 12 };

/* Farther apart than this, in the units below, a path is another one than the exact one: it meets other mirrors. */
#define PATH_PARTED 0x1p19

typedef struct path_errors {
    uint32_t rays;                 /* that were traced */
    uint32_t paths[PATH_BOUNCES];  /* that reached the bounce */
    uint32_t parted[PATH_BOUNCES]; /* that parted at it; they end there, and do not count in what follows */
    double worst[PATH_BOUNCES];    /* distance from the exact place, in units of 2^-23 times the scene's size, 4 */
    double sum[PATH_BOUNCES];      /* of all paths, the same units */
} path_errors;

/* Traces up to `rays` paths between two plane mirrors 2 apart; balls: with 36 mirror balls of radius 0.4 between them.
 * stream: of random numbers, see random.h. variant: NULL for the widest. */
cgt_result path_errors_measure(bool balls, uint32_t rays, uint64_t stream, const char *variant, path_errors *errors);

#endif
