/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The objects of a committed scene: the primitives of all its geometries, numbered through in the order of geometry
 * and primitive id, so that the lower object is the one that wins a tie. Nothing is copied from the caller's arrays. */
#ifndef CGT_OBJECTS_H
#define CGT_OBJECTS_H

#include <cgt/cgt.h>

#include "model/primitive.h"

typedef struct cgt_object_array {
    cgt_kind kind;
    uint32_t first;    /* object of its primitive 0 */
    uint32_t others;   /* spheres among the objects before a triangle array */
    uint32_t geometry; /* id */
    uint32_t mask;     /* the geometry's; not 0 */
    const char *point; /* x, y, z of centre or vertex i at point + i * point_stride */
    size_t point_stride;
    const char *radius; /* of spheres, at radius + i * radius_stride; stride 0: one radius for all */
    size_t radius_stride;
    const char *index; /* of triangles, three at index + i * index_stride; NULL: 3i, 3i + 1, 3i + 2 */
    size_t index_stride;
    uint32_t count;  /* primitives */
    uint32_t points; /* vertices of triangles */
} cgt_object_array;

typedef struct cgt_objects {
    const cgt_object_array *array; /* ascending by geometry and first; empty geometries are left out */
    uint32_t arrays;
    uint32_t count; /* objects in all */
    uint32_t spheres, triangles;
} cgt_objects;

/* Whether a primitive takes part, or why it is skipped. */
typedef enum cgt_object_state {
    CGT_OBJECT_VALID = 0,
    CGT_OBJECT_NOT_FINITE,
    CGT_OBJECT_NEGATIVE_RADIUS,
    CGT_OBJECT_DEGENERATE
} cgt_object_state;

/* The array that holds an object: the last one that starts at it or before. */
static inline const cgt_object_array *cgt_objects_array(const cgt_objects *objects, uint32_t object)
{
    uint32_t low = 0, high = objects->arrays;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (objects->array[middle].first <= object)
            low = middle;
        else
            high = middle;
    }
    return &objects->array[low];
}

/* Whether rays of a mask pass over some object. */
static inline bool cgt_objects_hidden(const cgt_objects *objects, uint32_t mask)
{
    bool hidden = false;
    for (uint32_t i = 0; i < objects->arrays; i++)
        hidden |= !(objects->array[i].mask & mask);
    return hidden;
}

/* The object of a primitive; CGT_INVALID_ID where there is no such geometry, or the geometry has no such primitive. */
static inline uint32_t cgt_objects_number(const cgt_objects *objects, uint32_t geometry, uint32_t primitive)
{
    uint32_t low = 0, high = objects->arrays;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (objects->array[middle].geometry < geometry)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == objects->arrays || objects->array[low].geometry != geometry || primitive >= objects->array[low].count)
        return CGT_INVALID_ID;
    return objects->array[low].first + primitive;
}

static inline const float *cgt_array_point(const cgt_object_array *a, uint32_t i)
{
    return (const float *)(const void *)(a->point + (size_t)i * a->point_stride);
}

static inline cgt_sphere cgt_array_sphere(const cgt_object_array *a, uint32_t i)
{
    const float *c = cgt_array_point(a, i);
    const float *r = (const float *)(const void *)(a->radius + (size_t)i * a->radius_stride);
    return (cgt_sphere){c[0], c[1], c[2], *r};
}

static inline void cgt_array_corners(const cgt_object_array *a, uint32_t i, uint32_t corner[3])
{
    const uint32_t *index = a->index ? (const uint32_t *)(const void *)(a->index + (size_t)i * a->index_stride) : NULL;
    for (uint32_t k = 0; k < 3; k++)
        corner[k] = index ? index[k] : 3 * i + k;
}

static inline cgt_triangle cgt_array_triangle(const cgt_object_array *a, uint32_t i)
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

/* Which triangle of all triangles an object is. */
static inline uint32_t cgt_array_triangle_number(const cgt_object_array *a, uint32_t object)
{
    return object - a->others;
}

static inline cgt_sphere cgt_objects_sphere(const cgt_objects *objects, uint32_t object)
{
    const cgt_object_array *a = cgt_objects_array(objects, object);
    return cgt_array_sphere(a, object - a->first);
}

static inline cgt_triangle cgt_objects_triangle(const cgt_objects *objects, uint32_t object)
{
    const cgt_object_array *a = cgt_objects_array(objects, object);
    return cgt_array_triangle(a, object - a->first);
}

static inline cgt_shape cgt_array_shape(const cgt_object_array *a, uint32_t i)
{
    cgt_shape shape = {.kind = a->kind};
    if (a->kind == CGT_KIND_SPHERES)
        shape.sphere = cgt_array_sphere(a, i);
    else
        shape.triangle = cgt_array_triangle(a, i);
    return shape;
}

static inline cgt_shape cgt_objects_shape(const cgt_objects *objects, uint32_t object)
{
    const cgt_object_array *a = cgt_objects_array(objects, object);
    return cgt_array_shape(a, object - a->first);
}

static inline cgt_object_state cgt_sphere_check(cgt_sphere q)
{
    /* finite times zero is zero; infinity and NaN give NaN, and NaN stays */
    const float zero = q.x * 0 + q.y * 0 + q.z * 0 + q.r * 0;
    return zero != 0 ? CGT_OBJECT_NOT_FINITE : q.r < 0 ? CGT_OBJECT_NEGATIVE_RADIUS : CGT_OBJECT_VALID;
}

/* Whether a triangle has an area, decided exactly. */
bool cgt_triangle_has_area(const cgt_triangle *q);

static inline cgt_object_state cgt_triangle_check(const cgt_triangle *q)
{
    float zero = 0;
    for (int k = 0; k < 3; k++)
        zero += q->v[k][0] * 0 + q->v[k][1] * 0 + q->v[k][2] * 0;
    return zero != 0 ? CGT_OBJECT_NOT_FINITE : cgt_triangle_has_area(q) ? CGT_OBJECT_VALID : CGT_OBJECT_DEGENERATE;
}

static inline cgt_object_state cgt_shape_check(const cgt_shape *shape)
{
    return shape->kind == CGT_KIND_SPHERES ? cgt_sphere_check(shape->sphere) : cgt_triangle_check(&shape->triangle);
}

#endif
