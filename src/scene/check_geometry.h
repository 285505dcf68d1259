/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Descriptions of geometries: whether they are valid, and which arrays a scene can read in place. */
#ifndef CGT_CHECK_GEOMETRY_H
#define CGT_CHECK_GEOMETRY_H

#include "core/context.h"

/* Fill in the strides that are 0. Fail with a message that names the field. */
cgt_result cgt_check_spheres(cgt_context *c, cgt_spheres *s);
cgt_result cgt_check_triangles(cgt_context *c, cgt_triangles *t);

/* Whether an array of 4-byte numbers lies at multiples of 4. */
static inline bool cgt_is_aligned(const void *array, size_t stride)
{
    return ((uintptr_t)array | stride) % sizeof(float) == 0;
}

static inline bool cgt_has_origin(const double origin[3]) { return origin[0] != 0 || origin[1] != 0 || origin[2] != 0; }

/* Whether the commit copies these, which have been checked. */
static inline bool cgt_spheres_are_copied(const cgt_spheres *s)
{
    return s->centers_double || s->radii_double || s->types8 || s->types16 || s->types32 || cgt_has_origin(s->origin) ||
           !cgt_is_aligned(s->centers, s->center_stride) || (s->radii && !cgt_is_aligned(s->radii, s->radius_stride));
}

static inline bool cgt_vertices_are_copied(const cgt_triangles *t)
{
    return t->vertices_double || cgt_has_origin(t->origin) || !cgt_is_aligned(t->vertices, t->vertex_stride);
}

static inline bool cgt_indices_are_copied(const cgt_triangles *t)
{
    return t->indices16 || (t->indices && !cgt_is_aligned(t->indices, t->index_stride));
}

#endif
