/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Items: primitives with their bounds, and how planes divide them. */
#include "papers/build/kd/split/kd_clip.h"

static inline float min_of(float a, float b) { return a < b ? a : b; }
static inline float max_of(float a, float b) { return a < b ? b : a; }

static void bound_sphere(cgt_sphere q, cgt_kd_item *item)
{
    const float c[3] = {q.x, q.y, q.z};
    for (int a = 0; a < 3; a++) { /* the sums are rounded to nearest: one step outwards covers it */
        item->low[a] = nextafterf(c[a] - q.r, -INFINITY);
        item->high[a] = nextafterf(c[a] + q.r, INFINITY);
    }
}

static void bound_triangle(const cgt_triangle *q, cgt_kd_item *item)
{
    for (int a = 0; a < 3; a++) {
        item->low[a] = min_of(q->v[0][a], min_of(q->v[1][a], q->v[2][a]));
        item->high[a] = max_of(q->v[0][a], max_of(q->v[1][a], q->v[2][a]));
    }
}

void cgt_kd_store_item(void *of, uint32_t place, uint32_t prim, const cgt_primitive *primitive)
{
    const cgt_kd_items *items = of;
    cgt_kd_item *item = items->item + place;
    if (primitive->kind == CGT_KIND_SPHERES)
        bound_sphere(primitive->sphere, item);
    else
        bound_triangle(&primitive->triangle, item);
    item->weight = (float)items->rules->costs.test[primitive->kind];
    item->prim = prim;
}

/* Narrows the bounds to those of a part, and keeps weight and primitive in the fourth elements. False where nothing is
 * left. */
static inline bool narrow(cgt_kd_item *item, cgt_float4 low, cgt_float4 high)
{
    const cgt_float4 l = cgt_load4(item->low), h = cgt_load4(item->high);
    const cgt_int4 first_three = {-1, -1, -1, 0};
    low = cgt_select4((low > l) & first_three, low, l);
    high = cgt_select4((high < h) & first_three, high, h);
    memcpy(item->low, &low, sizeof low);
    memcpy(item->high, &high, sizeof high);
    const cgt_int4 nonempty = low <= high;
    return nonempty[0] & nonempty[1] & nonempty[2];
}

/* Narrows an item to its part within a box. */
static bool narrow_to_box(cgt_kd_item *item, const cgt_triangle *q, const cgt_kd_box *box)
{
    cgt_kd_box part;
    memcpy(part.low, item->low, sizeof part.low);
    memcpy(part.high, item->high, sizeof part.high);
    if (!cgt_kd_clip_box(q, box, &part))
        return false;
    memcpy(item->low, part.low, sizeof part.low);
    memcpy(item->high, part.high, sizeof part.high);
    return true;
}

unsigned cgt_kd_split_item(const cgt_kd_rules *rules, const cgt_kd_item *item, const cgt_kd_box *box, uint32_t axis,
                           float split, bool clip_to_box, cgt_kd_item half[2])
{
    const cgt_primitive_array *a = cgt_primitives_array(rules->prims, item->prim);
    half[0] = half[1] = *item;
    if (a->kind == CGT_KIND_SPHERES) {
        half[0].high[axis] = half[1].low[axis] = split;
        return 3;
    }
    cgt_kd_bounds4 part[2];
    const cgt_triangle q = cgt_array_triangle(a, item->prim - a->first);
    cgt_kd_clip_sides(&q, axis, split, part);
    unsigned sides = 0;
    for (unsigned s = 0; s < 2; s++) {
        bool nonempty = narrow(&half[s], part[s].low, part[s].high);
        (s ? half[s].low : half[s].high)[axis] = split;
        if (nonempty && clip_to_box) {
            const cgt_kd_box child = cgt_kd_child_box(box, axis, split, s);
            nonempty = narrow_to_box(&half[s], &q, &child);
        }
        sides |= (unsigned)nonempty << s;
    }
    return sides;
}

void cgt_kd_partition(const cgt_kd_rules *rules, const cgt_kd_box *box, const cgt_kd_plane *plane,
                      const cgt_kd_item *item, uint32_t count, bool include_touching, cgt_kd_item *const to[2],
                      uint32_t counts[2])
{
    const uint32_t axis = plane->axis;
    const float split = plane->split;
    uint32_t lower = 0, upper = 0;
    for (uint32_t i = 0; i < count; i++) {
        const cgt_kd_item from = item[i];
        const bool below = from.low[axis] <= split, above = from.high[axis] >= split;
        if (below && above) {
            cgt_kd_item half[2];
            unsigned sides = cgt_kd_split_item(rules, &from, box, axis, split, false, half);
            if (include_touching && sides != 3) {
                half[0] = half[1] = from;
                half[0].high[axis] = half[1].low[axis] = split;
                sides = 3;
            }
            to[0][lower] = half[0];
            to[1][upper] = half[1];
            lower += sides & 1;
            upper += sides >> 1;
        } else if (below) {
            to[0][lower++] = from;
        } else {
            to[1][upper++] = from;
        }
    }
    counts[0] = lower;
    counts[1] = upper;
}
