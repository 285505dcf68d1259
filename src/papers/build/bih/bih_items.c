/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Items of a bounding interval hierarchy: their bounds, and how they are divided in place. */
#include <math.h>

#include "papers/build/bih/bih_build.h"

static inline cgt_bih_float4 min4(cgt_bih_float4 a, cgt_bih_float4 b)
{
    const cgt_bih_int4 less = a < b;
    return (cgt_bih_float4)(((cgt_bih_int4)a & less) | ((cgt_bih_int4)b & ~less));
}

static inline cgt_bih_float4 max4(cgt_bih_float4 a, cgt_bih_float4 b)
{
    const cgt_bih_int4 greater = a > b;
    return (cgt_bih_float4)(((cgt_bih_int4)a & greater) | ((cgt_bih_int4)b & ~greater));
}

/* ---- primitives ---- */

static inline void store_item(cgt_bih_item *item, cgt_bih_float4 low, cgt_bih_float4 high, uint32_t prim)
{
    item->low = low;
    item->high = high;
    memcpy((char *)&item->low + 3 * sizeof(float), &prim, sizeof prim);
}

static inline void bound_sphere(cgt_sphere q, uint32_t prim, cgt_bih_item *item)
{
    const cgt_bih_float4 center = {q.x, q.y, q.z, 0}, radius = {q.r, q.r, q.r, 0};
    store_item(item, center - radius, center + radius, prim);
}

static inline void bound_triangle(const cgt_triangle *q, uint32_t prim, cgt_bih_item *item)
{
    cgt_bih_float4 p[3];
    for (int k = 0; k < 3; k++)
        p[k] = (cgt_bih_float4){q->v[k][0], q->v[k][1], q->v[k][2], 0};
    store_item(item, min4(p[0], min4(p[1], p[2])), max4(p[0], max4(p[1], p[2])), prim);
}

void cgt_bih_store_item(void *of, uint32_t place, uint32_t prim, const cgt_primitive *primitive)
{
    cgt_bih_item *item = (cgt_bih_item *)of + place;
    if (primitive->kind == CGT_KIND_SPHERES)
        bound_sphere(primitive->sphere, prim, item);
    else
        bound_triangle(&primitive->triangle, prim, item);
}

/* ---- bounds ---- */

cgt_bih_bounds cgt_bih_merge(const cgt_bih_bounds *a, const cgt_bih_bounds *b)
{
    return (cgt_bih_bounds){min4(a->low, b->low), max4(a->high, b->high), min4(a->first_sum, b->first_sum),
                            max4(a->last_sum, b->last_sum)};
}

cgt_bih_bounds cgt_bih_bound(const cgt_bih_item *item, uint32_t count)
{
    const cgt_bih_float4 first = {INFINITY, INFINITY, INFINITY, 0}, last = {-INFINITY, -INFINITY, -INFINITY, 0};
    cgt_bih_bounds b = {first, last, first, last};
    for (uint32_t i = 0; i < count; i++) {
        const cgt_bih_float4 low = item[i].low, high = item[i].high, sum = low + high;
        b.low = min4(low, b.low);
        b.high = max4(high, b.high);
        b.first_sum = min4(sum, b.first_sum);
        b.last_sum = max4(sum, b.last_sum);
    }
    return b;
}

/* ---- dividing ---- */

static inline float key_of(const cgt_bih_item *item, cgt_bih_key key, uint32_t axis)
{
    return key == CGT_BIH_KEY_SUM    ? item->low[axis] + item->high[axis]
           : key == CGT_BIH_KEY_HIGH ? item->high[axis]
                                     : item->low[axis];
}

/* Without a branch that depends on an item: each is exchanged with the first one above, which is harmless where it is
 * above itself, and counts as below only where it is. */
static inline cgt_bih_sides divide_by(cgt_bih_item *item, uint32_t count, cgt_bih_key key, uint32_t axis,
                                      float threshold)
{
    cgt_bih_sides s = {0, -INFINITY, INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        const cgt_bih_item q = item[i];
        const float low = q.low[axis], high = q.high[axis];
        const bool is_below = key_of(&q, key, axis) <= threshold;
        const float end = is_below ? high : -INFINITY, begin = is_below ? INFINITY : low;
        s.end_of_lower = end > s.end_of_lower ? end : s.end_of_lower;
        s.begin_of_upper = begin < s.begin_of_upper ? begin : s.begin_of_upper;
        item[i] = item[s.below];
        item[s.below] = q;
        s.below += is_below;
    }
    return s;
}

/* The loop that matters, with constants for key and axis. */
cgt_bih_sides cgt_bih_divide(cgt_bih_item *item, uint32_t count, const cgt_bih_split *split)
{
    if (split->key != CGT_BIH_KEY_SUM)
        return divide_by(item, count, split->key, split->axis, split->threshold);
    if (split->axis == 0)
        return divide_by(item, count, CGT_BIH_KEY_SUM, 0, split->threshold);
    if (split->axis == 1)
        return divide_by(item, count, CGT_BIH_KEY_SUM, 1, split->threshold);
    return divide_by(item, count, CGT_BIH_KEY_SUM, 2, split->threshold);
}

/* Floats as whole numbers in the same order, and back. */
static inline uint32_t ordered(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits >> 31 ? ~bits : bits | 0x80000000u;
}

static inline float from_ordered(uint32_t number)
{
    const uint32_t bits = number >> 31 ? number & 0x7fffffffu : ~number;
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The key with so many lower ones before it, by its bytes, the highest first: four passes, whatever the keys. */
static float key_of_rank(const cgt_bih_item *item, uint32_t count, uint32_t rank, const cgt_bih_split *split)
{
    uint32_t prefix = 0, known = 0; /* bits of the answer */
    for (int shift = 24; shift >= 0; shift -= 8) {
        uint32_t keys[256] = {0}, byte = 0;
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t number = ordered(key_of(&item[i], split->key, split->axis));
            if ((number & known) == prefix)
                keys[number >> shift & 255]++;
        }
        while (rank >= keys[byte])
            rank -= keys[byte++];
        prefix |= byte << shift;
        known |= 255u << shift;
    }
    return from_ordered(prefix);
}

cgt_bih_sides cgt_bih_divide_at_median(cgt_bih_item *item, uint32_t count, const cgt_bih_split *split)
{
    const uint32_t axis = split->axis;
    const float median = key_of_rank(item, count, count / 2, split);
    /* those with lower keys, then those with this one, of which some go to either side */
    const uint32_t lower = divide_by(item, count, split->key, axis, nextafterf(median, -INFINITY)).below;
    divide_by(item + lower, count - lower, split->key, axis, median);
    cgt_bih_sides s = {count / 2, -INFINITY, INFINITY};
    for (uint32_t i = 0; i < s.below; i++)
        s.end_of_lower = fmaxf(s.end_of_lower, item[i].high[axis]);
    for (uint32_t i = s.below; i < count; i++)
        s.begin_of_upper = fminf(s.begin_of_upper, item[i].low[axis]);
    return s;
}
