/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The primitives of a committed scene: the primitives of all its geometries, numbered consecutively by geometry and
 * primitive id, so that the lower number wins a tie. They lie in the caller's arrays, or in float copies of those that
 * cannot be read in place (builders/order/copy_arrays.h). */
#ifndef CGT_PRIMITIVES_H
#define CGT_PRIMITIVES_H

#include <cgt/cgt.h>

#include "model/primitive.h"

typedef struct cgt_primitive_array {
    cgt_kind kind;
    uint32_t first;          /* primitive of its primitive 0 */
    uint32_t spheres_before; /* spheres among the primitives before it */
    uint32_t geometry;       /* id */
    uint32_t mask;           /* the geometry's; not 0 */
    const char *point;       /* x, y, z of centre, vertex or end i at point + i * point_stride */
    size_t point_stride;
    const char *radius; /* of spheres and capsules, at radius + i * radius_stride; stride 0: one radius for all */
    size_t radius_stride;
    const char *index;    /* of triangles, three at index + i * index_stride; NULL: 3i, 3i + 1, 3i + 2 */
    size_t index_stride;  /* of capsules, two: p and q; NULL: 2i, 2i + 1 */
    uint32_t count;       /* primitives */
    uint32_t points;      /* vertices of triangles, ends of capsules */
    float *copy;          /* what point and radius point to, where the commit copies them; else NULL */
    uint32_t *index_copy; /* what index points to, likewise */
} cgt_primitive_array;

typedef struct cgt_primitives {
    const cgt_primitive_array *array; /* ascending by geometry and first; empty geometries are left out */
    uint32_t arrays;
    uint32_t count; /* primitives in all */
    uint32_t spheres, triangles, capsules;
} cgt_primitives;

/* Primitives that are not spheres: builders keep the middles of their boxes. */
static inline uint32_t cgt_primitives_boxed(const cgt_primitives *prims) { return prims->count - prims->spheres; }

/* How many kinds there are. */
static inline int cgt_primitives_kinds(const cgt_primitives *prims)
{
    return (prims->spheres != 0) + (prims->triangles != 0) + (prims->capsules != 0);
}

/* One that there is: of a scene of one kind, that. */
static inline cgt_kind cgt_primitives_first_kind(const cgt_primitives *prims)
{
    return prims->spheres ? CGT_KIND_SPHERES : prims->triangles ? CGT_KIND_TRIANGLES : CGT_KIND_CAPSULES;
}

/* The array that holds a primitive: the last one that starts at it or before. */
static inline const cgt_primitive_array *cgt_primitives_array(const cgt_primitives *prims, uint32_t prim)
{
    uint32_t low = 0, high = prims->arrays;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (prims->array[middle].first <= prim)
            low = middle;
        else
            high = middle;
    }
    return &prims->array[low];
}

/* Whether some primitive is hidden from rays of a mask. */
static inline bool cgt_primitives_masked_out(const cgt_primitives *prims, uint32_t mask)
{
    bool hidden = false;
    for (uint32_t i = 0; i < prims->arrays; i++)
        hidden |= !(prims->array[i].mask & mask);
    return hidden;
}

/* The primitive of a primitive; CGT_INVALID_ID where there is no such geometry, or the geometry has no such
 * primitive. */
static inline uint32_t cgt_primitives_number(const cgt_primitives *prims, uint32_t geometry, uint32_t primitive)
{
    uint32_t low = 0, high = prims->arrays;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (prims->array[middle].geometry < geometry)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == prims->arrays || prims->array[low].geometry != geometry || primitive >= prims->array[low].count)
        return CGT_INVALID_ID;
    return prims->array[low].first + primitive;
}

static inline const float *cgt_array_point(const cgt_primitive_array *a, uint32_t i)
{
    return (const float *)(const void *)(a->point + (size_t)i * a->point_stride);
}

static inline cgt_sphere cgt_array_sphere(const cgt_primitive_array *a, uint32_t i)
{
    const float *c = cgt_array_point(a, i);
    const float *r = (const float *)(const void *)(a->radius + (size_t)i * a->radius_stride);
    return (cgt_sphere){c[0], c[1], c[2], *r};
}

static inline void cgt_array_corners(const cgt_primitive_array *a, uint32_t i, uint32_t corner[3])
{
    const uint32_t *index = a->index ? (const uint32_t *)(const void *)(a->index + (size_t)i * a->index_stride) : NULL;
    for (uint32_t k = 0; k < 3; k++)
        corner[k] = index ? index[k] : 3 * i + k;
}

static inline cgt_triangle cgt_array_triangle(const cgt_primitive_array *a, uint32_t i)
{
    cgt_triangle q;
    uint32_t corner[3];
    cgt_array_corners(a, i, corner);
    for (int k = 0; k < 3; k++) {
        const float *p = cgt_array_point(a, corner[k]);
        q.v[k][0] = p[0];
        q.v[k][1] = p[1];
        q.v[k][2] = p[2];
    }
    return q;
}

static inline void cgt_array_ends(const cgt_primitive_array *a, uint32_t i, uint32_t end[2])
{
    const uint32_t *index = a->index ? (const uint32_t *)(const void *)(a->index + (size_t)i * a->index_stride) : NULL;
    for (uint32_t k = 0; k < 2; k++)
        end[k] = index ? index[k] : 2 * i + k;
}

static inline cgt_capsule cgt_array_capsule(const cgt_primitive_array *a, uint32_t i)
{
    uint32_t end[2];
    cgt_array_ends(a, i, end);
    const float *p = cgt_array_point(a, end[0]), *q = cgt_array_point(a, end[1]);
    const float *r = (const float *)(const void *)(a->radius + (size_t)i * a->radius_stride);
    return (cgt_capsule){{p[0], p[1], p[2]}, {q[0], q[1], q[2]}, *r};
}

/* Lists the points of a primitive, by number: centre, vertices or ends. Returns how many. */
static inline uint32_t cgt_array_points(const cgt_primitive_array *a, uint32_t i, uint32_t point[3])
{
    switch (a->kind) {
    case CGT_KIND_TRIANGLES: cgt_array_corners(a, i, point); return 3;
    case CGT_KIND_CAPSULES: cgt_array_ends(a, i, point); return 2;
    case CGT_KIND_SPHERES: break;
    }
    point[0] = i;
    return 1;
}

/* Which of all primitives that are not spheres one is. */
static inline uint32_t cgt_array_boxed_number(const cgt_primitive_array *a, uint32_t prim)
{
    return prim - a->spheres_before;
}

static inline cgt_sphere cgt_primitives_sphere(const cgt_primitives *prims, uint32_t prim)
{
    const cgt_primitive_array *a = cgt_primitives_array(prims, prim);
    return cgt_array_sphere(a, prim - a->first);
}

static inline cgt_triangle cgt_primitives_triangle(const cgt_primitives *prims, uint32_t prim)
{
    const cgt_primitive_array *a = cgt_primitives_array(prims, prim);
    return cgt_array_triangle(a, prim - a->first);
}

static inline cgt_primitive cgt_array_primitive(const cgt_primitive_array *a, uint32_t i)
{
    cgt_primitive primitive = {.kind = a->kind};
    switch (a->kind) {
    case CGT_KIND_SPHERES: primitive.sphere = cgt_array_sphere(a, i); break;
    case CGT_KIND_TRIANGLES: primitive.triangle = cgt_array_triangle(a, i); break;
    case CGT_KIND_CAPSULES: primitive.capsule = cgt_array_capsule(a, i); break;
    }
    return primitive;
}

static inline cgt_primitive cgt_primitives_get(const cgt_primitives *prims, uint32_t prim)
{
    const cgt_primitive_array *a = cgt_primitives_array(prims, prim);
    return cgt_array_primitive(a, prim - a->first);
}

#endif
