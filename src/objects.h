/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The objects of a committed scene: the primitives of all its geometries, numbered through in the order of geometry
 * and primitive id, so that the lower object is the one that wins a tie. Nothing is copied from the caller's arrays. */
#ifndef CGT_OBJECTS_H
#define CGT_OBJECTS_H

#include <math.h>

#include <cgt/cgt.h>

typedef struct cgt_sphere_array {
    const char *center; /* x, y, z at center + i * center_stride */
    const char *radius; /* at radius + i * radius_stride; stride 0: one radius for all */
    size_t center_stride;
    size_t radius_stride;
    uint32_t first;    /* object of its primitive 0 */
    uint32_t geometry; /* id */
} cgt_sphere_array;

typedef struct cgt_objects {
    const cgt_sphere_array *array; /* ascending by geometry and first; empty geometries are left out */
    uint32_t arrays;
    uint32_t count; /* objects in all */
} cgt_objects;

typedef struct cgt_sphere {
    float x, y, z, r;
} cgt_sphere;

typedef enum cgt_sphere_state {
    CGT_SPHERE_VALID = 0,
    CGT_SPHERE_NOT_FINITE,
    CGT_SPHERE_NEGATIVE_RADIUS
} cgt_sphere_state;

/* Whether a sphere takes part, or why it is skipped. */
static inline cgt_sphere_state cgt_sphere_check(cgt_sphere q)
{
    /* finite times zero is zero; infinity and NaN give NaN, and NaN stays */
    const float zero = q.x * 0 + q.y * 0 + q.z * 0 + q.r * 0;
    return zero != 0 ? CGT_SPHERE_NOT_FINITE : q.r < 0 ? CGT_SPHERE_NEGATIVE_RADIUS : CGT_SPHERE_VALID;
}

/* The array that holds an object: the last one that starts at it or before. */
static inline const cgt_sphere_array *cgt_objects_array(const cgt_objects *objects, uint32_t object)
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

static inline cgt_sphere cgt_objects_sphere(const cgt_objects *objects, uint32_t object)
{
    const cgt_sphere_array *a = cgt_objects_array(objects, object);
    const size_t i = object - a->first;
    const float *c = (const float *)(const void *)(a->center + i * a->center_stride);
    const float *r = (const float *)(const void *)(a->radius + i * a->radius_stride);
    return (cgt_sphere){c[0], c[1], c[2], *r};
}

#endif
