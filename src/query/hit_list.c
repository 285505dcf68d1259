/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What intervals leave open about the hits of a ray. */
#include "query/hit_list.h"

#include "exact/crossing.h"
#include "exact/triangle_double.h"
#include "exact/valid_primitive.h"
#include "query/moved_ray.h"

/* Canonical values are within 2^-30, and the way within 2^-49 of itself. */
static void set_interval(const cgt_hit_list *list, cgt_listed_hit *h)
{
    const double place = h->t * list->speed, error = fabs(place) * 0x1p-29 + fabs(list->way) * 0x1p-48;
    h->low = moved_end(place - list->way, error, -1);
    h->high = moved_end(place - list->way, error, 1);
}

void cgt_hit_list_set_units(cgt_hit_list *list, double speed, double way)
{
    list->speed = speed;
    list->way = way;
    if (list->has_after)
        set_interval(list, &list->after);
}

/* A hit that was found by its interval. It is in the range, so that the near root is what the ray hits first. */
static cgt_decided_hit decided(const cgt_hit_list *list, cgt_listed_hit *h)
{
    cgt_decided_hit hit = {.primitive = cgt_primitives_get(list->prims, h->prim),
                           .t = h->t,
                           .far = h->far,
                           .part = (cgt_capsule_part)h->part};
    if (!h->decided) {
        cgt_decide_root(list->ray, &hit);
        h->t = hit.t;
        h->part = (uint8_t)hit.part;
        h->decided = true;
    }
    return hit;
}

int cgt_hit_list_compare(cgt_hit_list *list, cgt_listed_hit *a, cgt_listed_hit *b)
{
    if (a->prim == b->prim && a->far == b->far)
        return 0;
    const cgt_decided_hit p = decided(list, a), q = decided(list, b);
    uint64_t exact = 0;
    const int order = cgt_decide_order(list->ray, &p, &q, &exact);
    list->exact_tests += exact != 0;
    if (order)
        return order;
    return a->prim < b->prim || (a->prim == b->prim && b->far) ? -1 : 1;
}

int cgt_hit_list_side(const cgt_hit_list *list, const cgt_listed_hit *h)
{
    const cgt_decided_hit hit = {.primitive = cgt_primitives_get(list->prims, h->prim),
                                 .t = h->decided ? h->t : INFINITY, /* apart from the ends of the range */
                                 .far = h->far};
    uint64_t exact = 0;
    return cgt_decide_crossing_side(list->ray, &hit, &exact);
}

bool cgt_hit_list_set_after(cgt_hit_list *list, uint32_t prim, bool far)
{
    cgt_ray line = *list->ray;
    uint64_t exact = 0;
    cgt_decided_hit hit = {.primitive = cgt_primitives_get(list->prims, prim), .far = far};
    line.t_min = -FLT_MAX;
    line.t_max = INFINITY;
    const bool valid = cgt_primitive_check(&hit.primitive) == CGT_PRIMITIVE_VALID;
    const int roots = valid ? cgt_decide_roots(&line, &hit.primitive, &exact) : 0;
    if (list->kind == CGT_LIST_CROSSINGS && roots == 1)
        hit.far = far = false; /* its surface tells the side */
    list->has_after = roots > far && cgt_decide_root(&line, &hit);
    list->after = (cgt_listed_hit){.prim = prim, .far = far, .decided = true, .part = (uint8_t)hit.part, .t = hit.t};
    return list->has_after;
}

/* A list with a container ends the search. */
static void decide_container(cgt_hit_list *list, uint32_t prim, const cgt_primitive *primitive, uint64_t *exact)
{
    if (primitive->kind != CGT_KIND_SPHERES || !cgt_decide_sphere_contains(list->ray, primitive->sphere, exact))
        return;
    list->hit[0] = (cgt_listed_hit){.low = -INFINITY, .high = -INFINITY, .prim = prim};
    list->count = 1;
}

/* Lists those of the roots that are asked for. */
static void decide_roots(cgt_hit_list *list, uint32_t prim, const cgt_primitive *primitive, unsigned sides,
                         uint64_t *exact)
{
    const bool crossings = list->kind == CGT_LIST_CROSSINGS;
    const int roots = cgt_decide_roots(list->ray, primitive, exact);
    for (int k = 0; k < roots; k++) {
        cgt_decided_hit hit = {.primitive = *primitive, .far = k > 0};
        if (!(sides >> k & 1) || !cgt_decide_root(list->ray, &hit) ||
            (crossings && !cgt_decide_hit_crosses(list->ray, &hit, roots, exact)))
            continue;
        cgt_listed_hit h = {.prim = prim, .far = k > 0, .decided = true, .part = (uint8_t)hit.part, .t = hit.t};
        set_interval(list, &h);
        if (!list->has_after || cgt_hit_list_compare(list, &h, &list->after) > 0)
            cgt_hit_list_insert(list, &h);
    }
}

void cgt_hit_list_decide(cgt_hit_list *list, uint32_t prim, unsigned sides)
{
    const cgt_primitive primitive = cgt_primitives_get(list->prims, prim);
    uint64_t exact = 0;
    if (primitive.kind == CGT_KIND_TRIANGLES && cgt_triangle_is_parallel(list->ray->line.dir, &primitive.triangle))
        return;
    list->double_tests++;
    if (list->kind == CGT_LIST_CONTAINERS)
        decide_container(list, prim, &primitive, &exact);
    else
        decide_roots(list, prim, &primitive, sides, &exact);
    list->exact_tests += exact != 0;
}
