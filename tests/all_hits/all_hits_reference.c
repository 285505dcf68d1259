/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All hits by brute force; see all_hits_reference.h. */
#include "all_hits/all_hits_reference.h"

#include <stdlib.h>

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

/* A root counts if its t, rounded once, is in the range. */
static void add_roots(const cgt_primitive_array *array, uint32_t i, const cgt_ray *ray, reference_hits *hits)
{
    reference_hit hit = {
        .prim = array->first + i, .geometry = array->geometry, .primitive = i, .shape = cgt_array_primitive(array, i)};
    const bool sphere = hit.shape.kind == CGT_KIND_SPHERES;
    const int roots = sphere ? cgt_exact_sphere_roots(&ray->line, hit.shape.sphere)
                             : cgt_exact_line_hits_triangle(&ray->line, &hit.shape.triangle);
    for (int k = 0; k < roots; k++) {
        bool far = false;
        double t;
        hit.far = k > 0;
        if (!sphere)
            t = cgt_canonical_triangle_t(ray, &hit.shape.triangle);
        else if (!hit.far)
            t = cgt_canonical_sphere_t(ray, hit.shape.sphere, &far);
        else
            t = cgt_canonical_sphere_far(ray, hit.shape.sphere);
        hit.t = (float)t;
        if (!far && hit.t >= ray->t_min && hit.t <= ray->t_max && fabsf(hit.t) < INFINITY)
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
