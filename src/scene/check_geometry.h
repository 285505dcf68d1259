/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Descriptions of geometries: whether they are valid, and which arrays a scene can read in place. */
#ifndef CGT_CHECK_GEOMETRY_H
#define CGT_CHECK_GEOMETRY_H

#include "core/context.h"

/* Fill in the strides that are 0. Fail with a message that names the field. */
cgt_result cgt_check_spheres(cgt_context *c, cgt_spheres *s);
cgt_result cgt_check_capsules(cgt_context *c, cgt_capsules *q);
cgt_result cgt_check_triangles(cgt_context *c, cgt_triangles *t);

/* How radii are given: alike for all kinds that have them. */
typedef struct cgt_radii {
    cgt_array radii, types;
    float radius;
    uint32_t type_count;
} cgt_radii;

/* Of cgt_spheres or cgt_capsules. */
#define CGT_RADII_OF(s) ((cgt_radii){(s)->radii, (s)->types, (s)->radius, (s)->type_count})

/* Whether an array's 4-byte numbers are read where they are. No array needs no copy. */
static inline bool cgt_is_read_in_place(const cgt_array *a)
{
    return !a->data || ((a->format == CGT_FORMAT_FLOAT || a->format == CGT_FORMAT_UINT32) &&
                        ((uintptr_t)a->data | a->stride) % sizeof(float) == 0);
}

static inline bool cgt_has_origin(const double origin[3]) { return origin[0] != 0 || origin[1] != 0 || origin[2] != 0; }

/* Whether the commit copies these, which have been checked. */
static inline bool cgt_spheres_are_copied(const cgt_spheres *s)
{
    return s->types.data || cgt_has_origin(s->origin) || !cgt_is_read_in_place(&s->centers) ||
           !cgt_is_read_in_place(&s->radii);
}

static inline bool cgt_capsules_are_copied(const cgt_capsules *q)
{
    return q->types.data || q->ends.data || cgt_has_origin(q->origin) || !cgt_is_read_in_place(&q->vertices) ||
           !cgt_is_read_in_place(&q->indices) || !cgt_is_read_in_place(&q->radii);
}

static inline bool cgt_vertices_are_copied(const cgt_triangles *t)
{
    return cgt_has_origin(t->origin) || !cgt_is_read_in_place(&t->vertices);
}

static inline bool cgt_indices_are_copied(const cgt_triangles *t) { return !cgt_is_read_in_place(&t->indices); }

#endif
