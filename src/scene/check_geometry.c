/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks of descriptions of geometries. Nothing is read from the arrays here. */
#include "scene/check_geometry.h"

#include <math.h>

/* An array as the caller describes it. */
typedef struct described_array {
    const char *kind, *name; /* of the geometry and of the array, for messages */
    uint32_t count;          /* elements */
    size_t element;          /* bytes */
    size_t *stride;          /* bytes; 0 is replaced by that of an element */
} described_array;

/* Checks an array that is there: its elements do not overlap, and fit into the address space. */
static cgt_result check_stride(cgt_context *c, const described_array *a)
{
    const size_t stride = *a->stride ? *a->stride : a->element;
    if (stride < a->element)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "%s: a stride of %zu bytes in %s, of which an element has %zu bytes", a->kind, stride, a->name,
                        a->element);
    if (a->count && stride > (SIZE_MAX / 2 - a->element) / a->count)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: a stride of %zu bytes in %s is too large", a->kind, stride,
                        a->name);
    *a->stride = stride;
    return CGT_OK;
}

static cgt_result check_one(cgt_context *c, const char *kind, const char *name, const void *a, const void *b)
{
    if (a && b)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: %s are given twice, in two types", kind, name);
    return CGT_OK;
}

static cgt_result check_origin(cgt_context *c, const char *kind, const double origin[3])
{
    for (int a = 0; a < 3; a++)
        if (!isfinite(origin[a]))
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: origin is not finite", kind);
    return CGT_OK;
}

static cgt_result check_points(cgt_context *c, const described_array *a, const float *points,
                               const double *points_double, const double origin[3])
{
    cgt_result result = check_one(c, a->kind, a->name, points, points_double);
    if (result == CGT_OK && a->count && !points && !points_double)
        result = cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: %s is NULL", a->kind, a->name);
    if (result == CGT_OK)
        result = check_origin(c, a->kind, origin);
    return result == CGT_OK ? check_stride(c, a) : result;
}

static cgt_result check_indices(cgt_context *c, const described_array *a, const uint32_t *indices,
                                const uint16_t *indices16)
{
    const cgt_result result = check_one(c, a->kind, a->name, indices, indices16);
    return result == CGT_OK && (indices || indices16) ? check_stride(c, a) : result;
}

/* ---- radii ---- */

static cgt_result check_types(cgt_context *c, const char *kind, uint32_t count, cgt_radii *r)
{
    const size_t bytes = r->types8 ? sizeof(uint8_t) : r->types16 ? sizeof(uint16_t) : sizeof(uint32_t);
    const described_array types = {kind, "types", count, bytes, &r->type_stride};
    if (!!r->types8 + !!r->types16 + !!r->types32 > 1)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: types are given twice, in two types of numbers", kind);
    if (!r->radii && !r->radii_double)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: types without radii", kind);
    return check_stride(c, &types);
}

/* count: primitives. */
static cgt_result check_radii(cgt_context *c, const char *kind, uint32_t count, cgt_radii *r)
{
    const bool typed = cgt_radii_have_types(r);
    const described_array radii = {kind, "radii", typed ? r->type_count : count,
                                   r->radii_double ? sizeof(double) : sizeof(float), &r->radius_stride};
    cgt_result result = check_one(c, kind, "radii", r->radii, r->radii_double);
    if (result == CGT_OK && (r->radii || r->radii_double))
        result = check_stride(c, &radii);
    if (result == CGT_OK && typed)
        result = check_types(c, kind, count, r);
    if (result == CGT_OK && !r->radii && !r->radii_double && !(r->radius >= 0 && isfinite(r->radius)))
        result =
            cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: radius %g: 0 or more, and finite", kind, (double)r->radius);
    return result;
}

/* ---- spheres ---- */

cgt_result cgt_check_spheres(cgt_context *c, cgt_spheres *s)
{
    const size_t number = s->centers_double ? sizeof(double) : sizeof(float);
    const described_array centers = {"spheres", "centers", s->count, 3 * number, &s->center_stride};
    cgt_radii radii = CGT_RADII_OF(s);
    cgt_result result = check_points(c, &centers, s->centers, s->centers_double, s->origin);
    if (result == CGT_OK)
        result = check_radii(c, "spheres", s->count, &radii);
    s->radius_stride = radii.radius_stride;
    s->type_stride = radii.type_stride;
    return result;
}

/* ---- capsules ---- */

/* What capsules have without indices: two points each, in one array or in two. */
static cgt_result check_ends(cgt_context *c, const cgt_capsules *q)
{
    const bool ends = q->ends || q->ends_double;
    if (q->count > UINT32_MAX / 2) /* ends are numbered */
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "capsules: %u of them: at most 2^31 - 1", q->count);
    if ((q->ends && q->vertices_double) || (q->ends_double && q->vertices))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "capsules: vertices and ends are of two types");
    if (q->indices || q->indices16)
        return ends ? cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "capsules: both indices and ends") : CGT_OK;
    if (q->vertex_count / (ends ? 1 : 2) < q->count)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "capsules: %u of them without indices need more than %u vertices", q->count, q->vertex_count);
    return CGT_OK;
}

cgt_result cgt_check_capsules(cgt_context *c, cgt_capsules *q)
{
    const size_t number = q->vertices_double ? sizeof(double) : sizeof(float);
    const size_t index = q->indices16 ? sizeof(uint16_t) : sizeof(uint32_t);
    const described_array vertices = {"capsules", "vertices", q->vertex_count, 3 * number, &q->vertex_stride},
                          indices = {"capsules", "indices", q->count, 2 * index, &q->index_stride};
    cgt_radii radii = CGT_RADII_OF(q);
    cgt_result result = check_one(c, "capsules", "ends", q->ends, q->ends_double);
    if (result == CGT_OK)
        result = check_points(c, &vertices, q->vertices, q->vertices_double, q->origin);
    if (result == CGT_OK)
        result = check_indices(c, &indices, q->indices, q->indices16);
    if (result == CGT_OK)
        result = check_ends(c, q);
    if (result == CGT_OK)
        result = check_radii(c, "capsules", q->count, &radii);
    q->radius_stride = radii.radius_stride;
    q->type_stride = radii.type_stride;
    return result;
}

/* ---- triangles ---- */

cgt_result cgt_check_triangles(cgt_context *c, cgt_triangles *t)
{
    const size_t number = t->vertices_double ? sizeof(double) : sizeof(float);
    const size_t index = t->indices16 ? sizeof(uint16_t) : sizeof(uint32_t);
    const described_array vertices = {"triangles", "vertices", t->vertex_count, 3 * number, &t->vertex_stride},
                          indices = {"triangles", "indices", t->count, 3 * index, &t->index_stride};
    cgt_result result = check_points(c, &vertices, t->vertices, t->vertices_double, t->origin);
    if (result == CGT_OK)
        result = check_indices(c, &indices, t->indices, t->indices16);
    if (result == CGT_OK && !t->indices && !t->indices16 && t->vertex_count / 3 < t->count)
        result =
            cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "triangles: %u of them without indices need more than %u vertices",
                     t->count, t->vertex_count);
    return result;
}
