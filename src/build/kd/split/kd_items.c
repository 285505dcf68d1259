/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Items: the objects with their bounds, and what becomes of them where a plane divides them. */
#include "build/kd/split/kd_clip.h"

static inline float least(float a, float b) { return a < b ? a : b; }
static inline float most(float a, float b) { return a < b ? b : a; }

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
        item->low[a] = least(q->v[0][a], least(q->v[1][a], q->v[2][a]));
        item->high[a] = most(q->v[0][a], most(q->v[1][a], q->v[2][a]));
    }
}

uint32_t cgt_kd_collect(const cgt_kd_rules *rules, uint32_t first, uint32_t end, bool all, cgt_kd_item *item)
{
    const cgt_object_array *a = cgt_objects_array(rules->objects, first);
    uint32_t count = 0;
    for (uint32_t object = first; object < end; object++) {
        while (object - a->first >= a->count)
            a++;
        const cgt_shape shape = cgt_array_shape(a, object - a->first);
        if (!all && cgt_shape_check(&shape) != CGT_OBJECT_VALID)
            continue;
        if (shape.kind == CGT_KIND_SPHERES)
            bound_sphere(shape.sphere, &item[count]);
        else
            bound_triangle(&shape.triangle, &item[count]);
        item[count].weight = (float)rules->costs.test[shape.kind];
        item[count++].object = object;
    }
    return count;
}

uint32_t cgt_kd_count_valid(const cgt_objects *objects, uint32_t first, uint32_t end)
{
    uint32_t count = 0;
    for (uint32_t object = first; object < end; object++) {
        const cgt_shape shape = cgt_objects_shape(objects, object);
        count += cgt_shape_check(&shape) == CGT_OBJECT_VALID;
    }
    return count;
}

/* Narrows the bounds to those of a part, and keeps weight and object in the fourth elements. False where nothing is
 * left. */
static inline bool narrow(cgt_kd_item *item, cgt_float4 low, cgt_float4 high)
{
    const cgt_float4 l = cgt_load4(item->low), h = cgt_load4(item->high);
    const cgt_int4 first_three = {-1, -1, -1, 0};
    low = cgt_select4((low > l) & first_three, low, l);
    high = cgt_select4((high < h) & first_three, high, h);
    memcpy(item->low, &low, sizeof low);
    memcpy(item->high, &high, sizeof high);
    const cgt_int4 some = low <= high;
    return some[0] & some[1] & some[2];
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

unsigned cgt_kd_divide(const cgt_kd_rules *rules, const cgt_kd_item *item, const cgt_kd_box *box, uint32_t axis,
                       float split, bool whole, cgt_kd_item half[2])
{
    const cgt_object_array *a = cgt_objects_array(rules->objects, item->object);
    half[0] = half[1] = *item;
    if (a->kind == CGT_KIND_SPHERES) {
        half[0].high[axis] = half[1].low[axis] = split;
        return 3;
    }
    cgt_kd_span part[2];
    const cgt_triangle q = cgt_array_triangle(a, item->object - a->first);
    cgt_kd_clip_sides(&q, axis, split, part);
    unsigned sides = 0;
    for (unsigned s = 0; s < 2; s++) {
        bool some = narrow(&half[s], part[s].low, part[s].high);
        (s ? half[s].low : half[s].high)[axis] = split;
        if (some && whole) {
            const cgt_kd_box child = cgt_kd_child_box(box, axis, split, s);
            some = narrow_to_box(&half[s], &q, &child);
        }
        sides |= (unsigned)some << s;
    }
    return sides;
}

void cgt_kd_partition(const cgt_kd_rules *rules, const cgt_kd_box *box, const cgt_kd_plane *plane,
                      const cgt_kd_item *item, uint32_t count, bool keep, cgt_kd_item *const to[2], uint32_t counts[2])
{
    const uint32_t axis = plane->axis;
    const float split = plane->split;
    uint32_t lower = 0, upper = 0;
    for (uint32_t i = 0; i < count; i++) {
        const cgt_kd_item from = item[i];
        const bool below = from.low[axis] <= split, above = from.high[axis] >= split;
        if (below && above) {
            cgt_kd_item half[2];
            unsigned sides = cgt_kd_divide(rules, &from, box, axis, split, false, half);
            if (keep && sides != 3) {
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
