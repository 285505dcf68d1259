/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which primitives take part. The bounds of a commit, and loops over all primitives, skip the others. */
#ifndef CGT_VALID_PRIMITIVE_H
#define CGT_VALID_PRIMITIVE_H

#include "model/primitives.h"

/* Whether a primitive takes part, or why it is skipped. */
typedef enum cgt_primitive_state {
    CGT_PRIMITIVE_VALID = 0,
    CGT_PRIMITIVE_NOT_FINITE,
    CGT_PRIMITIVE_NEGATIVE_RADIUS,
    CGT_PRIMITIVE_DEGENERATE
} cgt_primitive_state;

static inline cgt_primitive_state cgt_sphere_check(cgt_sphere q)
{
    /* finite times zero is zero; infinity and NaN give NaN, and NaN stays */
    const float zero = q.x * 0 + q.y * 0 + q.z * 0 + q.r * 0;
    return zero != 0 ? CGT_PRIMITIVE_NOT_FINITE : q.r < 0 ? CGT_PRIMITIVE_NEGATIVE_RADIUS : CGT_PRIMITIVE_VALID;
}

/* Whether a triangle has an area, decided exactly. */
bool cgt_triangle_has_area(const cgt_triangle *q);

static inline cgt_primitive_state cgt_triangle_check(const cgt_triangle *q)
{
    float zero = 0;
    for (int k = 0; k < 3; k++)
        zero += q->v[k][0] * 0 + q->v[k][1] * 0 + q->v[k][2] * 0;
    return zero != 0                  ? CGT_PRIMITIVE_NOT_FINITE
           : cgt_triangle_has_area(q) ? CGT_PRIMITIVE_VALID
                                      : CGT_PRIMITIVE_DEGENERATE;
}

static inline cgt_primitive_state cgt_capsule_check(const cgt_capsule *q)
{
    float zero = q->r * 0;
    for (int a = 0; a < 3; a++)
        zero += q->p[a] * 0 + q->q[a] * 0;
    return zero != 0 ? CGT_PRIMITIVE_NOT_FINITE : q->r < 0 ? CGT_PRIMITIVE_NEGATIVE_RADIUS : CGT_PRIMITIVE_VALID;
}

static inline cgt_primitive_state cgt_primitive_check(const cgt_primitive *primitive)
{
    switch (primitive->kind) {
    case CGT_KIND_SPHERES: return cgt_sphere_check(primitive->sphere);
    case CGT_KIND_CAPSULES: return cgt_capsule_check(&primitive->capsule);
    case CGT_KIND_TRIANGLES: break;
    }
    return cgt_triangle_check(&primitive->triangle);
}

/* Returns the first valid primitive from `prim` on, or prims->count. */
static inline uint32_t cgt_next_valid(const cgt_primitives *prims, uint32_t prim)
{
    for (; prim < prims->count; prim++) {
        const cgt_primitive primitive = cgt_primitives_get(prims, prim);
        if (cgt_primitive_check(&primitive) == CGT_PRIMITIVE_VALID)
            break;
    }
    return prim;
}

#endif
