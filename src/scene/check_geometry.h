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
    const float *radii;
    const double *radii_double;
    size_t radius_stride;
    float radius;
    const uint8_t *types8;
    const uint16_t *types16;
    const uint32_t *types32;
    size_t type_stride;
    uint32_t type_count;
} cgt_radii;

/* Of cgt_spheres or cgt_capsules. */
#define CGT_RADII_OF(s)                                                                                                \
    ((cgt_radii){(s)->radii, (s)->radii_double, (s)->radius_stride, (s)->radius, (s)->types8, (s)->types16,            \
                 (s)->types32, (s)->type_stride, (s)->type_count})

static inline bool cgt_radii_have_types(const cgt_radii *r) { return r->types8 || r->types16 || r->types32; }

/* Whether an array of 4-byte numbers lies at multiples of 4. */
static inline bool cgt_is_aligned(const void *array, size_t stride)
{
    return ((uintptr_t)array | stride) % sizeof(float) == 0;
}

static inline bool cgt_has_origin(const double origin[3]) { return origin[0] != 0 || origin[1] != 0 || origin[2] != 0; }

/* Whether the commit copies these, which have been checked. */
static inline bool cgt_radii_are_copied(const cgt_radii *r)
{
    return r->radii_double || cgt_radii_have_types(r) || (r->radii && !cgt_is_aligned(r->radii, r->radius_stride));
}

static inline bool cgt_spheres_are_copied(const cgt_spheres *s)
{
    const cgt_radii radii = CGT_RADII_OF(s);
    return s->centers_double || cgt_has_origin(s->origin) || !cgt_is_aligned(s->centers, s->center_stride) ||
           cgt_radii_are_copied(&radii);
}

static inline bool cgt_capsules_are_copied(const cgt_capsules *q)
{
    const cgt_radii radii = CGT_RADII_OF(q);
    return q->vertices_double || q->ends || q->indices16 || cgt_has_origin(q->origin) ||
           !cgt_is_aligned(q->vertices, q->vertex_stride) ||
           (q->indices && !cgt_is_aligned(q->indices, q->index_stride)) || cgt_radii_are_copied(&radii);
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
