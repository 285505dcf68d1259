/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks of descriptions of geometries. Nothing is read from the arrays here. */
#include "scene/check_geometry.h"

#include <math.h>

/* What an array has to be. */
typedef struct wanted_array {
    const char *kind, *name; /* of the geometry and of the array, for messages */
    uint32_t count;          /* elements */
    uint32_t width;          /* numbers of an element */
    bool whole;              /* indices or types, not coordinates or radii */
} wanted_array;

static cgt_result check_format(cgt_context *c, const wanted_array *w, cgt_format format)
{
    const cgt_format first = w->whole ? CGT_FORMAT_UINT8 : CGT_FORMAT_FLOAT,
                     last = w->whole ? CGT_FORMAT_UINT64 : CGT_FORMAT_HALF;
    if (format >= first && format <= last)
        return CGT_OK;
    return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: %s have the format %d: must be of %s", w->kind, w->name,
                    (int)format, w->whole ? "whole numbers" : "floats, doubles or halves");
}

/* Checks an array that may not be there, and fills in its stride: its elements do not overlap, and fit into the address
 * space. */
static cgt_result check_array(cgt_context *c, const wanted_array *w, cgt_array *a)
{
    const size_t element = w->width * cgt_format_get_size(a->format), stride = a->stride ? a->stride : element;
    if (!a->data) {
        *a = (cgt_array){0};
        return CGT_OK;
    }
    const cgt_result result = check_format(c, w, a->format);
    if (result != CGT_OK)
        return result;
    if (stride < element)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "%s: a stride of %zu bytes in %s, of which an element has %zu bytes", w->kind, stride, w->name,
                        element);
    if (w->count && stride > (SIZE_MAX / 2 - element) / w->count)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: a stride of %zu bytes in %s is too large", w->kind, stride,
                        w->name);
    a->stride = stride;
    return CGT_OK;
}

static cgt_result check_points(cgt_context *c, const char *kind, const char *name, uint32_t count, cgt_array *points,
                               const double origin[3])
{
    const wanted_array wanted = {kind, name, count, 3, false};
    if (count && !points->data)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: %s is NULL", kind, name);
    for (int a = 0; a < 3; a++)
        if (!isfinite(origin[a]))
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: origin is not finite", kind);
    return check_array(c, &wanted, points);
}

/* Of spheres or capsules s, `kind` in words: a macro, since two structs have the same members. */
#define CHECK_RADII(c, kind, s) check_radii(c, kind, (s)->count, &(s)->radii, &(s)->types, (s)->radius, (s)->type_count)

static cgt_result check_radii(cgt_context *c, const char *kind, uint32_t count, cgt_array *radii, cgt_array *types,
                              float radius, uint32_t type_count)
{
    const wanted_array wanted = {kind, "radii", types->data ? type_count : count, 1, false},
                       wanted_types = {kind, "types", count, 1, true};
    if (types->data && !radii->data)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: types without radii", kind);
    if (!radii->data && !(radius >= 0 && isfinite(radius)))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: radius %g: 0 or more, and finite", kind, (double)radius);
    const cgt_result result = check_array(c, &wanted, radii);
    return result == CGT_OK ? check_array(c, &wanted_types, types) : result;
}

cgt_result cgt_check_spheres(cgt_context *c, cgt_spheres *s)
{
    const cgt_result result = check_points(c, "spheres", "centers", s->count, &s->centers, s->origin);
    return result == CGT_OK ? CHECK_RADII(c, "spheres", s) : result;
}

/* What capsules have without indices: two points each, in one array or in two. */
static cgt_result check_ends(cgt_context *c, cgt_capsules *q)
{
    const wanted_array ends = {"capsules", "ends", q->vertex_count, 3, false};
    if (q->count > UINT32_MAX / 2) /* ends are numbered */
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "capsules: %u of them: at most 2^31 - 1", q->count);
    if (q->indices.data)
        return q->ends.data ? cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "capsules: both indices and ends") : CGT_OK;
    if (q->vertex_count / (q->ends.data ? 1 : 2) < q->count)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT,
                        "capsules: %u of them without indices need more than %u vertices", q->count, q->vertex_count);
    return check_array(c, &ends, &q->ends);
}

cgt_result cgt_check_capsules(cgt_context *c, cgt_capsules *q)
{
    const wanted_array indices = {"capsules", "indices", q->count, 2, true};
    cgt_result result = check_points(c, "capsules", "vertices", q->vertex_count, &q->vertices, q->origin);
    if (result == CGT_OK)
        result = check_array(c, &indices, &q->indices);
    if (result == CGT_OK)
        result = check_ends(c, q);
    return result == CGT_OK ? CHECK_RADII(c, "capsules", q) : result;
}

cgt_result cgt_check_triangles(cgt_context *c, cgt_triangles *t)
{
    const wanted_array indices = {"triangles", "indices", t->count, 3, true};
    cgt_result result = check_points(c, "triangles", "vertices", t->vertex_count, &t->vertices, t->origin);
    if (result == CGT_OK)
        result = check_array(c, &indices, &t->indices);
    if (result == CGT_OK && !t->indices.data && t->vertex_count / 3 < t->count)
        result =
            cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "triangles: %u of them without indices need more than %u vertices",
                     t->count, t->vertex_count);
    return result;
}
