/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The first hits of one ray, in their exact order: by distance, then by primitive, then by surface. Whatever finds
 * hits, in any order, some of them twice, puts them here.
 *
 * A hit has an interval of floats that holds its T, the distance in the units of whoever finds it: T = t speed - way.
 * Hits whose intervals are apart are in the order of these. Others are compared exactly (exact/decide.h). The last hit
 * of a full list bounds the search. Whether there are more takes one more hit: until it is found there is no bound. */
#ifndef CGT_HIT_LIST_H
#define CGT_HIT_LIST_H

#include <math.h>
#include <string.h>

#include "exact/decide.h"
#include "model/primitives.h"

typedef struct cgt_listed_hit {
    float low, high; /* T is in this */
    uint32_t prim;
    bool far;     /* the second root of a sphere or a capsule */
    bool decided; /* t and part are known */
    uint8_t part; /* cgt_capsule_part */
    double t;     /* canonical */
} cgt_listed_hit;

/* What is listed. */
typedef enum cgt_list_kind {
    CGT_LIST_HITS = 0,
    CGT_LIST_CROSSINGS, /* hits that are crossings (exact/crossing.h) */
    CGT_LIST_CONTAINERS /* one sphere, if any, that the moved origin is in, which is within the scene's bounds; of a ray
                           from t = 0 to 0 through a BVH */
} cgt_list_kind;

typedef struct cgt_hit_list {
    cgt_list_kind kind;
    bool without_spheres; /* of crossings: those of spheres may be left out */
    const cgt_primitives *prims;
    const cgt_ray *ray;  /* as the caller gave it */
    uint32_t skip, mask; /* a primitive that it does not find, or CGT_INVALID_ID; all bits see everything */
    cgt_listed_hit *hit; /* ascending, room for `capacity`, 1 or more */
    uint32_t capacity, count;
    bool wants_more, more; /* whether anybody asks for more hits than the list holds; there are some */
    bool has_after;        /* hits up to `after` do not count */
    cgt_listed_hit after;
    double speed, way;
    uint64_t double_tests, exact_tests;
} cgt_hit_list;

/* Whether the ray must not find a primitive. */
static inline bool cgt_hit_list_skips(const cgt_hit_list *list, uint32_t prim)
{
    return prim == list->skip ||
           (list->mask != UINT32_MAX && !(cgt_primitives_array(list->prims, prim)->mask & list->mask));
}

/* Sets the hit after which others count. Returns false where the ray's line has no such hit. */
bool cgt_hit_list_set_after(cgt_hit_list *list, uint32_t prim, bool far);

/* Sets the list's last hit as that one. */
static inline bool cgt_hit_list_go_on(cgt_hit_list *list)
{
    return cgt_hit_list_set_after(list, list->hit[list->count - 1].prim, list->hit[list->count - 1].far);
}

/* Of a crossing: 1 where the ray leaves a body, -1 where it enters one. */
int cgt_hit_list_side(const cgt_hit_list *list, const cgt_listed_hit *h);

/* Says what T is. */
void cgt_hit_list_set_units(cgt_hit_list *list, double speed, double way);

/* -1 where a comes before b, 1 where it comes after it, 0 where they are the same hit; by exact distances. */
int cgt_hit_list_compare(cgt_hit_list *list, cgt_listed_hit *a, cgt_listed_hit *b);

/* Decides whether the ray hits a primitive, and where, and lists that. sides: bit 0 the near surface or a triangle, bit
 * 1 the far surface. */
#define CGT_NEAR_SIDE 1u
#define CGT_FAR_SIDE 2u
#define CGT_BOTH_SIDES (CGT_NEAR_SIDE | CGT_FAR_SIDE)
void cgt_hit_list_decide(cgt_hit_list *list, uint32_t prim, unsigned sides);

/* Whether hits after the last one need not be found. */
static inline bool cgt_hit_list_is_bounded(const cgt_hit_list *list)
{
    return list->count == list->capacity && (list->more || !list->wants_more);
}

/* The T up to which hits are to be found, at most `far`. */
static inline float cgt_hit_list_end(const cgt_hit_list *list, float far)
{
    if (!cgt_hit_list_is_bounded(list))
        return far;
    const float last = list->hit[list->count - 1].high;
    return last < far ? last : far;
}

/* Lists a hit that is in the range and after `after`. One that is there already is left out. */
static inline void cgt_hit_list_insert(cgt_hit_list *list, cgt_listed_hit *h)
{
    uint32_t i = list->count;
    for (; i; i--) {
        cgt_listed_hit *earlier = &list->hit[i - 1];
        if (h->low > earlier->high)
            break;
        if (h->high < earlier->low)
            continue;
        const int order = cgt_hit_list_compare(list, h, earlier);
        if (!order)
            return;
        if (order > 0)
            break;
    }
    if (list->count == list->capacity) {
        list->more = true;
        if (i == list->capacity)
            return;
        list->count--;
    }
    memmove(list->hit + i + 1, list->hit + i, (list->count - i) * sizeof *h);
    list->hit[i] = *h;
    list->count++;
}

#endif
