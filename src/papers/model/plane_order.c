/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The order of two planes in whole numbers: coordinates share a unit, components of the direction another, which leaves
 * the sign of a difference of two products. Where each group spans up to 61 bits, 128 hold the products: of a
 * difference below 2^62 and a component below 2^61. */
#include "papers/model/plane_order.h"

#include "exact/integer/exact_vector.h"

typedef struct plane_units {
    cgt_exact_unit position, dir;
} plane_units;

static plane_units units_of(const cgt_plane_time *a, const cgt_plane_time *b)
{
    const float from[3] = {a->plane, a->org, b->plane}, to[3] = {b->org, b->org, b->org};
    const float dir[3] = {a->dir, b->dir, b->dir};
    const cgt_exact_range position = cgt_exact_range_extend(cgt_exact_range_extend(CGT_EXACT_NO_RANGE, from), to);
    return (plane_units){.position = cgt_exact_unit_of(position),
                         .dir = cgt_exact_unit_of(cgt_exact_range_extend(CGT_EXACT_NO_RANGE, dir))};
}

#ifdef CGT_EXACT_INT128
static cgt_int128 narrow_product(const cgt_plane_time *t, float dir, const plane_units *units)
{
    const int64_t plane = cgt_exact_load_small(t->plane, units->position),
                  org = cgt_exact_load_small(t->org, units->position);
    return (cgt_int128)(plane - org) * cgt_exact_load_small(dir, units->dir);
}
#endif

/* out = (plane - org) dir */
static void big_product(cgt_exact_integer *out, const cgt_plane_time *t, float dir, const plane_units *units)
{
    CGT_EXACT_LOCAL(plane, 1);
    CGT_EXACT_LOCAL(org, 1);
    CGT_EXACT_LOCAL(factor, 1);
    cgt_exact_load_large(&plane, t->plane, units->position);
    cgt_exact_load_large(&org, t->org, units->position);
    cgt_exact_subtract(&plane, &plane, &org);
    cgt_exact_load_large(&factor, dir, units->dir);
    cgt_exact_multiply(out, &plane, &factor);
}

int cgt_plane_order_exact(const cgt_plane_time *a, const cgt_plane_time *b)
{
    const plane_units units = units_of(a, b);
    const int sign = (a->dir > 0) == (b->dir > 0) ? 1 : -1;
#ifdef CGT_EXACT_INT128
    if (cgt_exact_is_narrow(units.position, units.dir)) {
        const cgt_int128 left = narrow_product(a, b->dir, &units), right = narrow_product(b, a->dir, &units);
        return left > right ? sign : left < right ? -sign : 0;
    }
#endif
    CGT_EXACT_LOCAL(left, 2);
    CGT_EXACT_LOCAL(right, 2);
    big_product(&left, a, b->dir, &units);
    big_product(&right, b, a->dir, &units);
    return sign * cgt_exact_compare_signed(&left, &right);
}
