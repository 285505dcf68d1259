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

/* Bonds are often listed from both of their atoms. */
static inline bool cgt_same_capsule(const cgt_capsule *a, const cgt_capsule *b)
{
    const bool is_turned = !memcmp(a->p, b->q, sizeof a->p) && !memcmp(a->q, b->p, sizeof a->q);
    return (is_turned && !memcmp(&a->r, &b->r, sizeof a->r)) || !memcmp(a, b, sizeof *a);
}

/* Whether two primitives are one surface, by their bits: of the same kind and numbers, or capsules with exchanged
 * ends. */
static inline bool cgt_same_surface(const cgt_primitive *a, const cgt_primitive *b)
{
    if (a->kind != b->kind)
        return false;
    return a->kind == CGT_KIND_SPHERES    ? !memcmp(&a->sphere, &b->sphere, sizeof a->sphere)
           : a->kind == CGT_KIND_CAPSULES ? cgt_same_capsule(&a->capsule, &b->capsule)
                                          : !memcmp(&a->triangle, &b->triangle, sizeof a->triangle);
}

#endif
