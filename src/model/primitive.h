/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One primitive by value, for decisions and for the resolve. */
#ifndef CGT_PRIMITIVE_H
#define CGT_PRIMITIVE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

typedef struct cgt_sphere {
    float x, y, z, r;
} cgt_sphere;

typedef struct cgt_triangle {
    float v[3][3]; /* v[k] is vertex k: x, y, z */
} cgt_triangle;

/* All points within r of the segment from p to q. */
typedef struct cgt_capsule {
    float p[3], q[3], r;
} cgt_capsule;

typedef enum cgt_kind { CGT_KIND_SPHERES = 0, CGT_KIND_TRIANGLES, CGT_KIND_CAPSULES } cgt_kind;

#define CGT_KINDS 3u

typedef struct cgt_primitive {
    cgt_kind kind;
    union {
        cgt_sphere sphere;
        cgt_triangle triangle;
        cgt_capsule capsule;
    };
} cgt_primitive;

/* Whether two primitives have the same kind and bits. */
static inline bool cgt_same_primitive(const cgt_primitive *a, const cgt_primitive *b)
{
    if (a->kind != b->kind)
        return false;
    return a->kind == CGT_KIND_SPHERES    ? !memcmp(&a->sphere, &b->sphere, sizeof a->sphere)
           : a->kind == CGT_KIND_CAPSULES ? !memcmp(&a->capsule, &b->capsule, sizeof a->capsule)
                                          : !memcmp(&a->triangle, &b->triangle, sizeof a->triangle);
}

#endif
