/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bounds of single precision over the pixels of a tile, for both kinds of primitives: a tile of 8x8 pixels, a camera,
 * what is tallied, and the tests that the bounds hold, and break where FILTER_ROUNDOFF is lowered below the unit
 * roundoff. Included by a test that has included the kind's kernels, with FILTER_ROUNDOFF as filter_u. */
#ifndef TILE_BOUNDS_H
#define TILE_BOUNDS_H

#include <math.h>
#include <string.h>

#include "support/suite.h"
#include "support/test.h"
#include "support/tightened.h"

#include "tile/tile_case.h"

typedef struct tally {
    uint64_t lanes, hits, certain, undecided, double_lanes, coarse;
    uint64_t culled_by_depth, culled_by_sides; /* triangles that are culled for the whole tile */
    uint64_t lost, invented, outside;          /* must be 0 */
} tally;

/* ---- tests ---- */

/* Makes a case of a primitive of the kind; false: it is not to be judged. */
static bool make_case(test_random *r, bool parallel);

/* Judges that case. form: which form of depths the tile takes. fresh: the tile's truth is not known yet. */
static void judge_case(uint32_t form, bool fresh, tally *sum);

static inline void print_tile_tally(const char *what, const tally *sum)
{
    print_message("%s: %llu lanes, %llu hits, %llu certain, %llu undecided; %llu slow, %llu coarse; lost %llu, "
                  "invented %llu, outside %llu\n",
                  what, (unsigned long long)sum->lanes, (unsigned long long)sum->hits, (unsigned long long)sum->certain,
                  (unsigned long long)sum->undecided, (unsigned long long)sum->double_lanes,
                  (unsigned long long)sum->coarse, (unsigned long long)sum->lost, (unsigned long long)sum->invented,
                  (unsigned long long)sum->outside);
}

/* Returns the tally, in which nothing is lost. */
static inline tally check_bounds(uint64_t stream, bool parallel, uint32_t forms, uint32_t cases)
{
    test_random r = random_make(stream);
    tally sum = {0};
    for (uint32_t k = 20 + test_scaled(cases + 80); k; k--)
        if (make_case(&r, parallel))
            for (uint32_t form = 0; form < forms; form++)
                judge_case(form, form == 0, &sum);
    print_tile_tally(parallel ? "parallel rays" : "perspective", &sum);
    assert_int_equal(sum.lost, 0);
    assert_int_equal(sum.invented, 0);
    assert_int_equal(sum.outside, 0);
    assert_true(sum.certain > 100 && sum.undecided > 20 && sum.hits > 100 &&
                sum.lanes - sum.certain - sum.undecided > 100);
    return sum;
}

/* The bounds are worst cases: random rays come within a few orders of magnitude. least: of what is lost, invented,
 * outside. */
static inline void check_tightened_bounds(uint64_t stream, bool parallel, uint32_t forms, const double least[3])
{
    test_random r = random_make(stream);
    tally sum[STEPS] = {{0}};
    for (uint32_t k = 100 + test_scaled(2300); k; k--) {
        float scale = 0x1p-24f;
        if (!make_case(&r, parallel))
            continue;
        for (int step = 0; step < bound_steps(); step++, scale *= 0.70710678f) {
            filter_u = scale;
            judge_case(k % forms, step == 0, &sum[step]);
        }
        filter_u = 0x1p-24f;
    }
    check_break("a hit lost", sum, sizeof *sum, offsetof(tally, lost), least[0]);
    check_break("a hit invented", sum, sizeof *sum, offsetof(tally, invented), least[1]);
    check_break("depth outside", sum, sizeof *sum, offsetof(tally, outside), least[2]);
}

#endif
