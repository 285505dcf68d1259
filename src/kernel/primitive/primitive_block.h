/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A vector of primitives as structure of arrays: the leaves of a BVH, and what tiles of points test against a light.
 * Lanes beyond the last primitive repeat it. */
#ifndef CGT_PRIMITIVE_BLOCK_H
#define CGT_PRIMITIVE_BLOCK_H

#include "dispatch/kernel.h"
#include "vector.h"

typedef struct sphere_block {
    _Alignas(CGT_VECTOR_BYTES) float center[3][CGT_LANES];
    float radius[CGT_LANES];
    uint32_t prim[CGT_LANES];
} sphere_block;

/* The fields of leaf_triangle.h, by the same arithmetic: times the scene's scale. */
typedef struct triangle_block {
    _Alignas(CGT_VECTOR_BYTES) float vertex[3][CGT_LANES];
    float edge[2][3][CGT_LANES];
    float sum[2][CGT_LANES];
    uint32_t prim[CGT_LANES];
} triangle_block;

/* Times the scene's scale, too. */
typedef struct capsule_block {
    _Alignas(CGT_VECTOR_BYTES) float end[2][3][CGT_LANES];
    float radius[CGT_LANES];
    uint32_t prim[CGT_LANES];
} capsule_block;

#endif
