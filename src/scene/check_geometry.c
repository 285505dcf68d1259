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

/* ---- spheres ---- */

static cgt_result check_centers(cgt_context *c, cgt_spheres *s)
{
    const size_t number = s->centers_double ? sizeof(double) : sizeof(float);
    const described_array centers = {"spheres", "centers", s->count, 3 * number, &s->center_stride};
    cgt_result result = check_one(c, "spheres", "centers", s->centers, s->centers_double);
    if (result == CGT_OK && s->count && !s->centers && !s->centers_double)
        result = cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "spheres: centers is NULL");
    if (result == CGT_OK)
        result = check_origin(c, "spheres", s->origin);
    return result == CGT_OK ? check_stride(c, &centers) : result;
}

static cgt_result check_types(cgt_context *c, cgt_spheres *s)
{
    const size_t bytes = s->types8 ? sizeof(uint8_t) : s->types16 ? sizeof(uint16_t) : sizeof(uint32_t);
    const described_array types = {"spheres", "types", s->count, bytes, &s->type_stride};
    if (!!s->types8 + !!s->types16 + !!s->types32 > 1)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "spheres: types are given twice, in two types of numbers");
    if (!s->radii && !s->radii_double)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "spheres: types without radii");
    return check_stride(c, &types);
}

cgt_result cgt_check_spheres(cgt_context *c, cgt_spheres *s)
{
    const bool typed = s->types8 || s->types16 || s->types32;
    const described_array radii = {"spheres", "radii", typed ? s->type_count : s->count,
                                   s->radii_double ? sizeof(double) : sizeof(float), &s->radius_stride};
    cgt_result result = check_centers(c, s);
    if (result == CGT_OK)
        result = check_one(c, "spheres", "radii", s->radii, s->radii_double);
    if (result == CGT_OK && (s->radii || s->radii_double))
        result = check_stride(c, &radii);
    if (result == CGT_OK && typed)
        result = check_types(c, s);
    if (result == CGT_OK && !s->radii && !s->radii_double && !(s->radius >= 0 && isfinite(s->radius)))
        result =
            cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "spheres: radius %g: 0 or more, and finite", (double)s->radius);
    return result;
}

/* ---- triangles ---- */

cgt_result cgt_check_triangles(cgt_context *c, cgt_triangles *t)
{
    const size_t number = t->vertices_double ? sizeof(double) : sizeof(float);
    const size_t index = t->indices16 ? sizeof(uint16_t) : sizeof(uint32_t);
    const described_array vertices = {"triangles", "vertices", t->vertex_count, 3 * number, &t->vertex_stride},
                          indices = {"triangles", "indices", t->count, 3 * index, &t->index_stride};
    const bool indexed = t->indices || t->indices16;
    cgt_result result = check_one(c, "triangles", "vertices", t->vertices, t->vertices_double);
    if (result == CGT_OK && t->vertex_count && !t->vertices && !t->vertices_double)
        result = cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "triangles: vertices is NULL");
    if (result == CGT_OK)
        result = check_one(c, "triangles", "indices", t->indices, t->indices16);
    if (result == CGT_OK)
        result = check_origin(c, "triangles", t->origin);
    if (result == CGT_OK)
        result = check_stride(c, &vertices);
    if (result == CGT_OK && indexed)
        result = check_stride(c, &indices);
    if (result == CGT_OK && !indexed && t->vertex_count / 3 < t->count)
        result =
            cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "triangles: %u of them without indices need more than %u vertices",
                     t->count, t->vertex_count);
    return result;
}
