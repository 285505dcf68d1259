/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Signed whole numbers for exact.h: sign and magnitude, only as many limbs as a value needs, so that small ones are
 * quick. Nothing is allocated, and nothing is checked: whoever declares a number gives it room for its degree, the
 * number of coordinates and components of directions that are multiplied in each of its terms. So little stack is
 * taken.
 *   Floats span 278 bits, so a difference of coordinates has at most 279 and a component of a direction 278; a product
 * of k of them, and a sum of few such, has 280 k bits but for a few, which two more limbs hold, as they hold what a
 * product or a shift writes before it is trimmed. The largest numbers are the squares where a sphere's root is compared
 * with a triangle's t, of degree 10, and where the roots of two cylinders are compared, of degree 32. */
#ifndef CGT_EXACT_INTEGER_H
#define CGT_EXACT_INTEGER_H

#include <stdint.h>

/* CGT_EXACT_HALVES: 32-bit limbs also where the compiler has 128-bit integers, for tests. */
#if defined(__SIZEOF_INT128__) && !defined(CGT_EXACT_HALVES)
__extension__ typedef __int128 cgt_int128;
__extension__ typedef unsigned __int128 cgt_uint128;
#define CGT_EXACT_INT128
#define CGT_EXACT_LIMB_BITS 64u
typedef uint64_t cgt_exact_limb;
typedef cgt_uint128 cgt_exact_two_limbs;
#else
#define CGT_EXACT_LIMB_BITS 32u
typedef uint32_t cgt_exact_limb;
typedef uint64_t cgt_exact_two_limbs;
#endif

/* Limbs for numbers of a degree. */
#define CGT_EXACT_LIMBS(degree) ((280 * (degree) + CGT_EXACT_LIMB_BITS - 1) / CGT_EXACT_LIMB_BITS + 2)

typedef struct cgt_exact_integer {
    int sign;             /* -1, 0, 1 */
    uint32_t size;        /* limbs in use, the last of them not 0; 0 for 0 */
    cgt_exact_limb *limb; /* the lowest first; those beyond size have no value */
} cgt_exact_integer;

/* Declares a local number of a degree. */
#define CGT_EXACT_LOCAL(name, degree)                                                                                  \
    cgt_exact_limb name##_limb[CGT_EXACT_LIMBS(degree)];                                                               \
    cgt_exact_integer name = {.limb = name##_limb}

/* ---- From small numbers --------------------------------------------------------------------------------------- */

static inline void cgt_exact_trim(cgt_exact_integer *x)
{
    while (x->size && !x->limb[x->size - 1])
        x->size--;
    if (!x->size)
        x->sign = 0;
}

/* sign * magnitude * 2^shift; the sign of 0 is free */
static inline void cgt_exact_set(cgt_exact_integer *x, int sign, uint32_t magnitude, uint32_t shift)
{
    const uint32_t zeros = shift / CGT_EXACT_LIMB_BITS;
    const cgt_exact_two_limbs value = (cgt_exact_two_limbs)magnitude << shift % CGT_EXACT_LIMB_BITS;
    for (uint32_t i = 0; i < zeros; i++)
        x->limb[i] = 0;
    x->limb[zeros] = (cgt_exact_limb)value;
    x->limb[zeros + 1] = (cgt_exact_limb)(value >> CGT_EXACT_LIMB_BITS);
    x->sign = sign;
    x->size = magnitude ? zeros + 2 : 0;
    cgt_exact_trim(x);
}

#ifdef CGT_EXACT_INT128
static inline void cgt_exact_set_int128(cgt_exact_integer *x, cgt_int128 value)
{
    const cgt_uint128 magnitude = value < 0 ? -(cgt_uint128)value : (cgt_uint128)value;
    x->limb[0] = (uint64_t)magnitude;
    x->limb[1] = (uint64_t)(magnitude >> 64);
    x->size = x->limb[1] ? 2 : x->limb[0] != 0;
    x->sign = value < 0 ? -1 : value != 0;
}

/* The two's complement number of 192 bits in word, the lowest first. */
static inline void cgt_exact_set_int192(cgt_exact_integer *x, const uint64_t word[3])
{
    const uint64_t flip = -(word[2] >> 63);
    cgt_uint128 sum = flip & 1;
    for (int i = 0; i < 3; i++) {
        sum += word[i] ^ flip;
        x->limb[i] = (uint64_t)sum;
        sum >>= 64;
    }
    x->sign = flip ? -1 : 1;
    x->size = 3;
    cgt_exact_trim(x);
}
#endif

static inline void cgt_exact_copy(cgt_exact_integer *to, const cgt_exact_integer *from)
{
    to->sign = from->sign;
    to->size = from->size;
    for (uint32_t i = 0; i < from->size; i++)
        to->limb[i] = from->limb[i];
}

/* ---- Sums ----------------------------------------------------------------------------------------------------- */

/* The sign of |a| - |b|. */
static inline int cgt_exact_compare_sizes(const cgt_exact_integer *a, const cgt_exact_integer *b)
{
    if (a->size != b->size)
        return a->size < b->size ? -1 : 1;
    for (uint32_t i = a->size; i-- > 0;)
        if (a->limb[i] != b->limb[i])
            return a->limb[i] < b->limb[i] ? -1 : 1;
    return 0;
}

/* The sign of a - b. */
static inline int cgt_exact_compare_signed(const cgt_exact_integer *a, const cgt_exact_integer *b)
{
    if (a->sign != b->sign)
        return a->sign < b->sign ? -1 : 1;
    return a->sign * cgt_exact_compare_sizes(a, b);
}

/* |a| + |b| with the sign given, |a| having as many limbs as |b| or more. */
static inline void cgt_exact_add_sizes(cgt_exact_integer *out, const cgt_exact_integer *a, const cgt_exact_integer *b,
                                       int sign)
{
    const uint32_t size = a->size, common = b->size;
    cgt_exact_two_limbs sum = 0;
    for (uint32_t i = 0; i < size; i++) {
        /* NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Assign): it cannot follow that limbs below size are set */
        sum += a->limb[i];
        sum += i < common ? b->limb[i] : 0;
        out->limb[i] = (cgt_exact_limb)sum;
        sum >>= CGT_EXACT_LIMB_BITS;
    }
    out->size = size;
    if (sum)
        out->limb[out->size++] = (cgt_exact_limb)sum;
    out->sign = sign;
}

/* |a| - |b| with the sign given, |a| being above |b|. */
static inline void cgt_exact_subtract_sizes(cgt_exact_integer *out, const cgt_exact_integer *a,
                                            const cgt_exact_integer *b, int sign)
{
    const uint32_t size = a->size, common = b->size;
    cgt_exact_limb borrow = 0;
    for (uint32_t i = 0; i < size; i++) {
        const cgt_exact_limb from = a->limb[i], subtrahend = i < common ? b->limb[i] : 0, rest = from - subtrahend;
        out->limb[i] = rest - borrow;
        borrow = (cgt_exact_limb)((from < subtrahend) | (rest < borrow));
    }
    out->size = size;
    out->sign = sign;
    cgt_exact_trim(out);
}

/* out = a + sign * b; out may be a or b */
static inline void cgt_exact_add_signed(cgt_exact_integer *out, const cgt_exact_integer *a, const cgt_exact_integer *b,
                                        int sign)
{
    const int sign_a = a->sign, sign_b = sign * b->sign;
    if (sign_a * sign_b >= 0) {
        if (a->size >= b->size)
            cgt_exact_add_sizes(out, a, b, sign_a ? sign_a : sign_b);
        else
            cgt_exact_add_sizes(out, b, a, sign_b);
        return;
    }
    const int larger = cgt_exact_compare_sizes(a, b);
    if (larger >= 0)
        cgt_exact_subtract_sizes(out, a, b, larger ? sign_a : 0);
    else
        cgt_exact_subtract_sizes(out, b, a, sign_b);
}

static inline void cgt_exact_add(cgt_exact_integer *out, const cgt_exact_integer *a, const cgt_exact_integer *b)
{
    cgt_exact_add_signed(out, a, b, 1);
}

static inline void cgt_exact_subtract(cgt_exact_integer *out, const cgt_exact_integer *a, const cgt_exact_integer *b)
{
    cgt_exact_add_signed(out, a, b, -1);
}

/* ---- Products ------------------------------------------------------------------------------------------------- */

/* out = a * b; out is neither of them. */
static inline void cgt_exact_multiply(cgt_exact_integer *out, const cgt_exact_integer *a, const cgt_exact_integer *b)
{
    out->sign = a->sign * b->sign;
    out->size = 0;
    if (!out->sign)
        return;
    for (uint32_t i = 0; i < a->size; i++) {
        cgt_exact_two_limbs sum = 0;
        for (uint32_t j = 0; j < b->size; j++) {
            sum += (cgt_exact_two_limbs)a->limb[i] * b->limb[j];
            /* NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Assign): the same */
            sum += i ? out->limb[i + j] : 0; /* the first row writes */
            out->limb[i + j] = (cgt_exact_limb)sum;
            sum >>= CGT_EXACT_LIMB_BITS;
        }
        out->limb[i + b->size] = (cgt_exact_limb)sum;
    }
    out->size = a->size + b->size;
    cgt_exact_trim(out);
}

/* x times 2^bits */
static inline void cgt_exact_shift_left(cgt_exact_integer *x, uint32_t bits)
{
    const uint32_t limbs = bits / CGT_EXACT_LIMB_BITS, rest = bits % CGT_EXACT_LIMB_BITS;
    if (!bits || !x->sign)
        return;
    cgt_exact_limb above = 0; /* the next round adds the carry into the limb above */
    for (uint32_t i = x->size; i-- > 0;) {
        const cgt_exact_two_limbs shifted = (cgt_exact_two_limbs)x->limb[i] << rest;
        x->limb[i + limbs + 1] = (cgt_exact_limb)(shifted >> CGT_EXACT_LIMB_BITS) | above;
        above = (cgt_exact_limb)shifted;
    }
    x->limb[limbs] = above;
    for (uint32_t i = 0; i < limbs; i++)
        x->limb[i] = 0;
    x->size += limbs + 1;
    cgt_exact_trim(x);
}

/* ---- The leading bits ------------------------------------------------------------------------------------------ */

/* 64 bits of the magnitude from bit `lowest` up, which lies in a limb in use. */
static inline uint64_t cgt_exact_bits(const cgt_exact_integer *x, uint32_t lowest)
{
    const uint32_t first = lowest / CGT_EXACT_LIMB_BITS, skip = lowest % CGT_EXACT_LIMB_BITS;
    uint64_t bits = (uint64_t)x->limb[first] >> skip;
    for (uint32_t i = 1; first + i < x->size && i * CGT_EXACT_LIMB_BITS - skip < 64; i++)
        bits |= (uint64_t)x->limb[first + i] << (i * CGT_EXACT_LIMB_BITS - skip);
    return bits;
}

/* The magnitude of an x that is not 0 as top * 2^exponent with the highest bit of top set. The lowest bit of top is
 * set where any bit below is, so that a conversion rounds as if it saw them all. */
static inline uint64_t cgt_exact_top(const cgt_exact_integer *x, int *exponent)
{
    const uint32_t leading = (uint32_t)__builtin_clzll(x->limb[x->size - 1]) - (64 - CGT_EXACT_LIMB_BITS);
    const uint32_t bits = x->size * CGT_EXACT_LIMB_BITS - leading;
    *exponent = (int)bits - 64;
    if (bits <= 64)
        return cgt_exact_bits(x, 0) << (64 - bits);
    const uint32_t lowest = bits - 64, first = lowest / CGT_EXACT_LIMB_BITS;
    cgt_exact_limb below = x->limb[first] & (((cgt_exact_limb)1 << lowest % CGT_EXACT_LIMB_BITS) - 1);
    for (uint32_t i = 0; i < first; i++)
        below |= x->limb[i];
    return cgt_exact_bits(x, lowest) | (below != 0);
}

#endif
