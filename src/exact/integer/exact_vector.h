/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Vectors of whole numbers for exact.h, converted from floats. The floats of a group (positions; directions) share a
 * unit, a power of two of which all are whole multiples. Two tiers:
 *   narrow  groups that span up to 61 bits, as ordinary scenes do: components of 64 bits, products of 128 and 192
 *   wide    any floats: cgt_exact_integer throughout
 * All vectors of one computation have the same tier; results are cgt_exact_integer in both.
 * Floats are read bit by bit, so that a processor mode that flushes denormals changes nothing. */
#ifndef CGT_EXACT_VECTOR_H
#define CGT_EXACT_VECTOR_H

#include <stdbool.h>
#include <string.h>

#include "exact/integer/exact_integer.h"
#include "model/primitive.h"

/* Tests count which tiers they reach, and switch the narrow one off. */
#ifndef CGT_EXACT_REACHED
#define CGT_EXACT_REACHED(tier) ((void)0)
#endif
#ifndef CGT_EXACT_NARROW_BITS
#define CGT_EXACT_NARROW_BITS 61
#endif

/* ---- Units ---------------------------------------------------------------------------------------------------- */

/* sign * magnitude * 2^exponent, up to a power of two that all floats have in common */
typedef struct cgt_exact_float {
    uint32_t magnitude;
    int exponent; /* of denormals as of the smallest others */
    int sign;     /* -1 or 1, of 0 as well */
} cgt_exact_float;

static inline cgt_exact_float cgt_exact_read(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint32_t exponent = bits >> 23 & 255, fraction = bits & 0x7fffff;
    return (cgt_exact_float){.magnitude = exponent ? fraction | 0x800000 : fraction,
                             .exponent = exponent ? (int)exponent : 1,
                             .sign = bits >> 31 ? -1 : 1};
}

/* The range of the magnitudes of a group's floats, without zeros: their bits without the sign, which order as the
 * magnitudes do, stored as 2 bits - 1 and 2 bits. */
typedef struct cgt_exact_range {
    uint32_t least, most;
} cgt_exact_range;

#define CGT_EXACT_NO_RANGE ((cgt_exact_range){.least = UINT32_MAX, .most = 0})

static inline cgt_exact_range cgt_exact_range_extend(cgt_exact_range range, const float value[3])
{
    for (int i = 0; i < 3; i++) {
        uint32_t bits;
        memcpy(&bits, &value[i], sizeof bits);
        bits *= 2;
        range.most = bits > range.most ? bits : range.most;
        range.least = bits - 1 < range.least ? bits - 1 : range.least;
    }
    return range;
}

/* The lowest and the highest exponent of a group's floats, 0 of denormals. A group without any has some. */
typedef struct cgt_exact_unit {
    int low, high;
} cgt_exact_unit;

static inline cgt_exact_unit cgt_exact_unit_of(cgt_exact_range range)
{
    return (cgt_exact_unit){.low = (int)((range.least + 1) >> 24), .high = (int)(range.most >> 24)};
}

static inline bool cgt_exact_is_narrow(cgt_exact_unit a, cgt_exact_unit b)
{
#ifdef CGT_EXACT_INT128
    return a.high - a.low + 24 <= CGT_EXACT_NARROW_BITS && b.high - b.low + 24 <= CGT_EXACT_NARROW_BITS;
#else
    (void)a, (void)b;
    return false;
#endif
}

/* ---- Vectors -------------------------------------------------------------------------------------------------- */

/* Three numbers, of degree 1 and 2, with their limbs. */
typedef struct cgt_exact_three_of_1 {
    cgt_exact_integer of[3];
    cgt_exact_limb limb[3][CGT_EXACT_LIMBS(1)];
} cgt_exact_three_of_1;
typedef struct cgt_exact_three_of_2 {
    cgt_exact_integer of[3];
    cgt_exact_limb limb[3][CGT_EXACT_LIMBS(2)];
} cgt_exact_three_of_2;

typedef struct cgt_exact_vector {
    bool narrow;
    int bits; /* narrow: components are below 2^bits, bits <= 62 */
    union {
        int64_t small[3];
        cgt_exact_three_of_1 large;
    };
} cgt_exact_vector;

/* A cross product. */
typedef struct cgt_exact_cross {
    bool narrow;
    int bits; /* narrow: components are below 2^bits, bits <= 125 */
    union {
#ifdef CGT_EXACT_INT128
        cgt_int128 small[3];
#endif
        cgt_exact_three_of_2 large;
    };
} cgt_exact_cross;

static inline void cgt_exact_measure(cgt_exact_vector *v)
{
    const int64_t x = v->small[0], y = v->small[1], z = v->small[2];
    const uint64_t any = (uint64_t)(x < 0 ? -x : x) | (uint64_t)(y < 0 ? -y : y) | (uint64_t)(z < 0 ? -z : z);
    v->bits = 64 - __builtin_clzll(any | 1);
}

static inline int64_t cgt_exact_load_small(float value, cgt_exact_unit unit)
{
    const cgt_exact_float f = cgt_exact_read(value);
    const int64_t magnitude = (int64_t)((uint64_t)f.magnitude << ((f.exponent - unit.low) & 63)); /* of 0: any shift */
    return f.sign < 0 ? -magnitude : magnitude;
}

static inline void cgt_exact_load_large(cgt_exact_integer *out, float value, cgt_exact_unit unit)
{
    const cgt_exact_float f = cgt_exact_read(value);
    cgt_exact_set(out, f.sign, f.magnitude, f.magnitude ? (uint32_t)(f.exponent - unit.low) : 0);
}

static inline void cgt_exact_load(cgt_exact_vector *v, const float value[3], cgt_exact_unit unit, bool narrow)
{
    v->narrow = narrow;
    v->bits = unit.high - unit.low + 24;
    if (narrow) {
        v->small[0] = cgt_exact_load_small(value[0], unit);
        v->small[1] = cgt_exact_load_small(value[1], unit);
        v->small[2] = cgt_exact_load_small(value[2], unit);
        return;
    }
    for (int i = 0; i < 3; i++) {
        v->large.of[i].limb = v->large.limb[i];
        cgt_exact_load_large(&v->large.of[i], value[i], unit);
    }
}

/* out = a - b; out was loaded */
static inline void cgt_exact_vector_subtract(cgt_exact_vector *out, const cgt_exact_vector *a,
                                             const cgt_exact_vector *b)
{
    out->narrow = a->narrow;
    if (a->narrow) {
        out->small[0] = a->small[0] - b->small[0];
        out->small[1] = a->small[1] - b->small[1];
        out->small[2] = a->small[2] - b->small[2];
        cgt_exact_measure(out);
        return;
    }
    for (int i = 0; i < 3; i++)
        cgt_exact_subtract(&out->large.of[i], &a->large.of[i], &b->large.of[i]);
}

/* out = value - from, the value in from's unit */
static inline void cgt_exact_load_relative(cgt_exact_vector *out, const float value[3], const cgt_exact_vector *from,
                                           cgt_exact_unit unit)
{
    if (from->narrow) { /* as above, but without a way through memory, which processors wait for */
        out->narrow = true;
        out->small[0] = cgt_exact_load_small(value[0], unit) - from->small[0];
        out->small[1] = cgt_exact_load_small(value[1], unit) - from->small[1];
        out->small[2] = cgt_exact_load_small(value[2], unit) - from->small[2];
        cgt_exact_measure(out);
        return;
    }
    cgt_exact_load(out, value, unit, false);
    cgt_exact_vector_subtract(out, out, from);
}

/* ---- Products of wide vectors ------------------------------------------------------------------------------------ */

/* Not inlined: each copy would have numbers of its own on the stack. */
__attribute__((noinline, unused)) static void
cgt_exact_big_cross(cgt_exact_integer out[3], const cgt_exact_integer a[3], const cgt_exact_integer b[3])
{
    CGT_EXACT_LOCAL(product, 2);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        cgt_exact_multiply(&out[i], &a[j], &b[k]);
        cgt_exact_multiply(&product, &a[k], &b[j]);
        cgt_exact_subtract(&out[i], &out[i], &product);
    }
}

/* At most of degree 3. */
__attribute__((noinline, unused)) static void cgt_exact_big_dot(cgt_exact_integer *out, const cgt_exact_integer a[3],
                                                                const cgt_exact_integer b[3])
{
    CGT_EXACT_LOCAL(product, 3);
    cgt_exact_multiply(out, &a[0], &b[0]);
    for (int i = 1; i < 3; i++) {
        cgt_exact_multiply(&product, &a[i], &b[i]);
        cgt_exact_add(out, out, &product);
    }
}

/* ---- Products of either tier ------------------------------------------------------------------------------------- */

#ifdef CGT_EXACT_INT128
/* Sum of products of 125 and 62 bits, which 192 bits hold: products of magnitudes, added or subtracted. */
static inline void cgt_exact_narrow_dot192(cgt_exact_integer *out, const cgt_int128 a[3], const int64_t b[3])
{
    uint64_t sum[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        const cgt_uint128 size_a = a[i] < 0 ? -(cgt_uint128)a[i] : (cgt_uint128)a[i];
        const uint64_t size_b = b[i] < 0 ? -(uint64_t)b[i] : (uint64_t)b[i];
        const uint64_t flip = (a[i] < 0) != (b[i] < 0) ? UINT64_MAX : 0;
        const cgt_uint128 low = (cgt_uint128)(uint64_t)size_a * size_b;
        const cgt_uint128 high = (cgt_uint128)(uint64_t)(size_a >> 64) * size_b + (uint64_t)(low >> 64);
        const uint64_t word[3] = {(uint64_t)low, (uint64_t)high, (uint64_t)(high >> 64)};
        cgt_uint128 carry = flip & 1;
        for (int k = 0; k < 3; k++) {
            carry += (cgt_uint128)sum[k] + (word[k] ^ flip);
            sum[k] = (uint64_t)carry;
            carry >>= 64;
        }
    }
    cgt_exact_set_int192(out, sum);
}
#endif

/* out = a x b */
static inline void cgt_exact_cross_product(cgt_exact_cross *out, const cgt_exact_vector *a, const cgt_exact_vector *b)
{
    out->narrow = a->narrow;
#ifdef CGT_EXACT_INT128
    if (a->narrow) {
        out->bits = a->bits + b->bits + 1;
        const cgt_int128 x = a->small[0], y = a->small[1], z = a->small[2];
        out->small[0] = y * b->small[2] - z * b->small[1];
        out->small[1] = z * b->small[0] - x * b->small[2];
        out->small[2] = x * b->small[1] - y * b->small[0];
        return;
    }
#endif
    for (int i = 0; i < 3; i++)
        out->large.of[i].limb = out->large.limb[i];
    cgt_exact_big_cross(out->large.of, a->large.of, b->large.of);
}

static inline void cgt_exact_cross_components(const cgt_exact_cross *cross, cgt_exact_integer out[3])
{
    for (int i = 0; i < 3; i++) {
#ifdef CGT_EXACT_INT128
        if (cross->narrow) {
            cgt_exact_set_int128(&out[i], cross->small[i]);
            continue;
        }
#endif
        cgt_exact_copy(&out[i], &cross->large.of[i]);
    }
}

/* *out = cross . v */
static inline void cgt_exact_triple_product(cgt_exact_integer *out, const cgt_exact_cross *cross,
                                            const cgt_exact_vector *v)
{
#ifdef CGT_EXACT_INT128
    if (v->narrow && cross->bits + v->bits + 2 <= 127) {
        CGT_EXACT_REACHED(128);
        cgt_exact_set_int128(out, cross->small[0] * v->small[0] + cross->small[1] * v->small[1] +
                                      cross->small[2] * v->small[2]);
        return;
    }
    if (v->narrow) {
        CGT_EXACT_REACHED(192);
        cgt_exact_narrow_dot192(out, cross->small, v->small);
        return;
    }
#endif
    CGT_EXACT_REACHED(wide);
    cgt_exact_big_dot(out, cross->large.of, v->large.of);
}

/* *out = a . b */
static inline void cgt_exact_dot_product(cgt_exact_integer *out, const cgt_exact_vector *a, const cgt_exact_vector *b)
{
#ifdef CGT_EXACT_INT128
    if (a->narrow) {
        CGT_EXACT_REACHED(dot);
        cgt_exact_set_int128(out, (cgt_int128)a->small[0] * b->small[0] + (cgt_int128)a->small[1] * b->small[1] +
                                      (cgt_int128)a->small[2] * b->small[2]);
        return;
    }
#endif
    CGT_EXACT_REACHED(wide_dot);
    cgt_exact_big_dot(out, a->large.of, b->large.of);
}

#endif
