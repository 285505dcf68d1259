/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the program's files need of words: an SPU has quadwords and no scalars, so values that a loop uses stay in all
 * four lanes, and memory is read and written by quadwords. */
#ifndef GRID_WORDS_H
#define GRID_WORDS_H

#include "vector.h"

#define GRID_WORD(n) 4 * (n), 4 * (n) + 1, 4 * (n) + 2, 4 * (n) + 3 /* of a pattern: a word of both operands */

/* Lane k in all lanes: one shuffle. */
#define GRID_LANE(vector, k) spu_shuffle(vector, vector, grid_lane_pattern(k))

CGT_SPU_INLINE vec_uchar16 grid_lane_pattern(int k)
{
    const vec_uchar16 pattern[4] = {{GRID_WORD(0), GRID_WORD(0), GRID_WORD(0), GRID_WORD(0)},
                                    {GRID_WORD(1), GRID_WORD(1), GRID_WORD(1), GRID_WORD(1)},
                                    {GRID_WORD(2), GRID_WORD(2), GRID_WORD(2), GRID_WORD(2)},
                                    {GRID_WORD(3), GRID_WORD(3), GRID_WORD(3), GRID_WORD(3)}};
    return pattern[k];
}

/* Rows a, b, c, d to columns. */
#define GRID_TRANSPOSE(a, b, c, d, to)                                                                                 \
    do {                                                                                                               \
        const vec_uchar16 low_ = {GRID_WORD(0), GRID_WORD(4), GRID_WORD(1), GRID_WORD(5)};                             \
        const vec_uchar16 high_ = {GRID_WORD(2), GRID_WORD(6), GRID_WORD(3), GRID_WORD(7)};                            \
        const __typeof__(a) low02_ = spu_shuffle(a, c, low_), low13_ = spu_shuffle(b, d, low_);                        \
        const __typeof__(a) high02_ = spu_shuffle(a, c, high_), high13_ = spu_shuffle(b, d, high_);                    \
        (to)[0] = spu_shuffle(low02_, low13_, low_);                                                                   \
        (to)[1] = spu_shuffle(low02_, low13_, high_);                                                                  \
        (to)[2] = spu_shuffle(high02_, high13_, low_);                                                                 \
        (to)[3] = spu_shuffle(high02_, high13_, high_);                                                                \
    } while (0)

/* Products of words below 2^15: an SPU multiplies halfwords, and the lower ones of words are the odd ones there. */
CGT_SPU_INLINE vec_int4 grid_multiply(vec_int4 a, vec_int4 b)
{
#if defined(__SPU__)
    return spu_mulo((vec_short8)a, (vec_short8)b);
#else
    return a * b;
#endif
}

/* The quadword that holds an address: an SPU's loads and stores drop the low bits by themselves. */
#if defined(__SPU__)
#define GRID_QUADWORD(type, address) ((type *)(void *)(address))
#else
#define GRID_QUADWORD(type, address) ((type *)((uintptr_t)(address) & ~(uintptr_t)15))
#endif

/* Loads at a byte offset, which may be any. */
#define GRID_LOAD(type, base, offset) (*GRID_QUADWORD(const type, (const char *)(base) + (offset)))

/* Branches that are taken once in a while: the compiler lays the other way out without a jump. */
#define GRID_RARELY(condition) __builtin_expect(!!(condition), 0)
#define GRID_MOSTLY(condition) __builtin_expect(!!(condition), 1)

/* An SPU truncates: its unit roundoff is twice that of rounding to nearest. A test makes less of it. */
#ifndef GRID_ROUNDOFF
#define GRID_ROUNDOFF 0x1p-23f
#endif

#define GRID_MOST 0x1.fffffep127f /* the largest number that is one on a host, too */

#endif
