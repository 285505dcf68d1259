/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Exact arithmetic on dyadic rationals: schoolbook sums and products. */
#include "support/oracle/dyadic.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ends the program where a number would not fit: a wrong reference would be worse. */
static void check_capacity(int limbs)
{
    if (limbs > DYADIC_LIMBS) {
        fprintf(stderr, "dyadic: a number of %d limbs exceeds the capacity of %d\n", limbs, DYADIC_LIMBS);
        abort();
    }
}

/* Trims zero limbs at both ends. */
static void trim(dyadic *a)
{
    int zeros = 0;
    while (a->count > 0 && a->limb[a->count - 1] == 0)
        a->count--;
    while (zeros < a->count && a->limb[zeros] == 0)
        zeros++;
    if (zeros > 0) {
        a->count -= zeros;
        a->low += zeros;
        memmove(a->limb, a->limb + zeros, (size_t)a->count * sizeof a->limb[0]);
    }
    if (a->count == 0)
        a->sign = a->low = 0;
}

dyadic dyadic_make(int32_t m, int exponent)
{
    dyadic a;
    const int bits = (exponent % 32 + 32) % 32;
    const uint64_t m_abs = m < 0 ? 0 - (uint64_t)m : (uint64_t)m, magnitude = m_abs * (UINT64_C(1) << bits);
    a.sign = m < 0 ? -1 : m > 0;
    a.low = (exponent - bits) / 32;
    a.count = 2;
    a.limb[0] = (uint32_t)magnitude;
    a.limb[1] = (uint32_t)(magnitude >> 32);
    trim(&a);
    return a;
}

dyadic dyadic_of_float(float f)
{
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    const int field = (int)(bits >> 23 & 255);
    const int32_t m = (int32_t)(bits & 0x7fffff) | (field ? 0x800000 : 0);
    return dyadic_make(bits >> 31 ? -m : m, field ? field - 150 : -149);
}

static uint32_t limb_at(const dyadic *a, int position)
{
    const int i = position - a->low;
    return i >= 0 && i < a->count ? a->limb[i] : 0;
}

static int top(const dyadic *a) { return a->low + a->count; }

static int compare_magnitudes(const dyadic *a, const dyadic *b)
{
    if (top(a) != top(b))
        return top(a) < top(b) ? -1 : 1;
    const int low = a->low < b->low ? a->low : b->low;
    for (int i = top(a) - 1; i >= low; i--) {
        const uint32_t x = limb_at(a, i), y = limb_at(b, i);
        if (x != y)
            return x < y ? -1 : 1;
    }
    return 0;
}

/* |a| + |b|, or |a| - |b| for |a| >= |b|; neither is 0. */
static dyadic combine(const dyadic *a, const dyadic *b, bool subtract, int sign)
{
    dyadic r;
    const int high = top(a) > top(b) ? top(a) : top(b);
    int64_t carry = 0;
    r.sign = sign;
    r.low = a->low < b->low ? a->low : b->low;
    r.count = high - r.low + 1;
    check_capacity(r.count);
    for (int i = 0; i < r.count; i++) {
        const int64_t x = limb_at(a, r.low + i), y = limb_at(b, r.low + i);
        const int64_t sum = subtract ? x - y + carry : x + y + carry;
        r.limb[i] = (uint32_t)sum;
        carry = sum < 0 ? -1 : sum >> 32;
    }
    trim(&r);
    return r;
}

static dyadic sum_of(const dyadic *a, const dyadic *b, int sign_b)
{
    if (sign_b == 0)
        return *a;
    if (a->sign == 0)
        return dyadic_signed(b, sign_b * b->sign);
    if (a->sign == sign_b)
        return combine(a, b, false, a->sign);
    const int order = compare_magnitudes(a, b);
    if (order == 0)
        return dyadic_make(0, 0);
    return order > 0 ? combine(a, b, true, a->sign) : combine(b, a, true, sign_b);
}

dyadic dyadic_add(const dyadic *a, const dyadic *b) { return sum_of(a, b, b->sign); }

dyadic dyadic_sub(const dyadic *a, const dyadic *b) { return sum_of(a, b, -b->sign); }

dyadic dyadic_mul(const dyadic *a, const dyadic *b)
{
    dyadic r;
    if (a->sign == 0 || b->sign == 0)
        return dyadic_make(0, 0);
    r.sign = a->sign * b->sign;
    r.low = a->low + b->low;
    r.count = a->count + b->count;
    check_capacity(r.count);
    memset(r.limb, 0, (size_t)r.count * sizeof r.limb[0]);
    for (int i = 0; i < a->count; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < b->count; j++) {
            carry += (uint64_t)a->limb[i] * b->limb[j] + r.limb[i + j];
            r.limb[i + j] = (uint32_t)carry;
            carry >>= 32;
        }
        r.limb[i + b->count] = (uint32_t)carry;
    }
    trim(&r);
    return r;
}

dyadic dyadic_signed(const dyadic *a, int times)
{
    if (times == 0)
        return dyadic_make(0, 0);
    dyadic r = *a;
    r.sign *= times;
    return r;
}

truth_real dyadic_real(const dyadic *a)
{
    enum { KEPT = 5 }; /* limbs: 129 bits at least */
    truth_real r = 0;
    int i = a->count;
    while (i > 0 && a->count - i < KEPT)
        r = r * 0x1p32 + a->limb[--i];
    for (int scale = a->low + i; scale != 0; scale += scale < 0 ? 1 : -1)
        r *= scale < 0 ? 0x1p-32 : 0x1p32;
    return a->sign < 0 ? -r : r;
}

dyadic dyadic_dot(const dyadic a[3], const dyadic b[3])
{
    dyadic sum = dyadic_mul(&a[0], &b[0]);
    for (int i = 1; i < 3; i++) {
        const dyadic product = dyadic_mul(&a[i], &b[i]);
        sum = dyadic_add(&sum, &product);
    }
    return sum;
}

void dyadic_cross(const dyadic a[3], const dyadic b[3], dyadic result[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const dyadic plus = dyadic_mul(&a[j], &b[k]), minus = dyadic_mul(&a[k], &b[j]);
        result[i] = dyadic_sub(&plus, &minus);
    }
}
