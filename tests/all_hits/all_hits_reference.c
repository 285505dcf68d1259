/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All hits by brute force; see all_hits_reference.h. */
#include "all_hits/all_hits_reference.h"

#include <stdlib.h>

#include "exact/decide_capsule.h"
#include "exact/valid_primitive.h"
#include "query/ray_intake.h"
#include "support/suite.h"

static cgt_exact_ray sorted_line; /* qsort has no argument for it */

static int compare(const void *a, const void *b)
{
    const reference_hit *p = a, *q = b;
    const cgt_exact_root root_p = {&p->shape, p->far}, root_q = {&q->shape, q->far};
    const int order = cgt_exact_compare(&sorted_line, &root_p, &root_q);
    if (order)
        return order;
    if (p->prim != q->prim)
        return p->prim < q->prim ? -1 : 1;
    return (int)p->far - (int)q->far;
}

static void add(reference_hits *hits, const reference_hit *hit)
{
    if (hits->count == hits->room) {
        hits->room = hits->room ? 2 * hits->room : 64;
        hits->hit = realloc(hits->hit, hits->room * sizeof *hits->hit);
        assert_non_null(hits->hit);
    }
    hits->hit[hits->count++] = *hit;
}

/* t of root hit->far. *other: it is the far root that is first in the range, not the near one. Of a capsule that it is
 * hit at an end, the shape becomes the sphere there. */
static double root_t(const cgt_ray *ray, reference_hit *hit, bool *other)
{
    const cgt_primitive q = hit->shape;
    cgt_capsule_part part;
    double t;
    *other = false;
    switch (q.kind) {
    case CGT_KIND_TRIANGLES: return cgt_canonical_triangle_t(ray, &q.triangle);
    case CGT_KIND_SPHERES:
        return hit->far ? cgt_canonical_sphere_far(ray, q.sphere) : cgt_canonical_sphere_t(ray, q.sphere, other);
    case CGT_KIND_CAPSULES: break;
    }
    t = hit->far ? cgt_canonical_capsule_far(ray, &q.capsule, &part)
                 : cgt_canonical_capsule_t(ray, &q.capsule, other, &part);
    if (part != CGT_CAPSULE_SIDE)
        hit->shape = (cgt_primitive){.kind = CGT_KIND_SPHERES, .sphere = cgt_capsule_end(&q.capsule, part)};
    return t;
}

static int exact_roots(const cgt_ray *ray, const cgt_primitive *q)
{
    cgt_capsule_part part[2];
    switch (q->kind) {
    case CGT_KIND_SPHERES: return cgt_exact_sphere_roots(&ray->line, q->sphere);
    case CGT_KIND_CAPSULES: return cgt_exact_capsule_roots(&ray->line, &q->capsule, part);
    case CGT_KIND_TRIANGLES: break;
    }
    return cgt_exact_line_hits_triangle(&ray->line, &q->triangle);
}

/* A root counts if its t, rounded once, is in the range. */
static void add_roots(const cgt_primitive_array *array, uint32_t i, const cgt_ray *ray, reference_hits *hits)
{
    const cgt_primitive shape = cgt_array_primitive(array, i);
    const int roots = exact_roots(ray, &shape);
    for (int k = 0; k < roots; k++) {
        reference_hit hit = {
            .prim = array->first + i, .geometry = array->geometry, .primitive = i, .shape = shape, .far = k > 0};
        bool other;
        hit.t = (float)root_t(ray, &hit, &other);
        if (!other && hit.t >= ray->t_min && hit.t <= ray->t_max && fabsf(hit.t) < INFINITY)
            add(hits, &hit);
    }
}

void reference_all_hits(const cgt_scene *scene, const cgt_rays *rays, uint64_t i, reference_hits *hits)
{
    const cgt_primitives *prims = &scene->committed_scene.prims;
    const ray_source source = ray_source_init(rays, NULL);
    const cgt_ray ray = ray_read(&source, i);
    const uint32_t mask = ray_read_mask(&source, i), skip = ray_read_skip(prims, &source, i);
    hits->count = 0;
    if (ray_classify(&ray, &RAY_NO_LIMITS) != RAY_PLAIN)
        return;
    for (uint32_t k = cgt_next_valid(prims, 0); k < prims->count; k = cgt_next_valid(prims, k + 1)) {
        const cgt_primitive_array *array = cgt_primitives_array(prims, k);
        if (k != skip && array->mask & mask)
            add_roots(array, k - array->first, &ray, hits);
    }
    sorted_line = ray.line;
    if (hits->count)
        qsort(hits->hit, hits->count, sizeof *hits->hit, compare);
}

uint32_t reference_after(const cgt_rays *rays, uint64_t i, const reference_hits *hits, const reference_hit *after)
{
    const ray_source source = ray_source_init(rays, NULL);
    const cgt_ray ray = ray_read(&source, i);
    uint32_t k = 0;
    sorted_line = ray.line;
    while (k < hits->count && compare(&hits->hit[k], after) <= 0)
        k++;
    return k;
}
