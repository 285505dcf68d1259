/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours and normals; see look.h. */
#include "draw/look.h"

#include <math.h>
#include <string.h>

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Interpolates a triangle's vertex normals, each as a unit vector, at (u, v). Returns 0 where the sum has no direction
 * or is not finite. */
static int mix_normal(const cgt_look *l, uint32_t primitive, float u, float v, float n[3])
{
    const uint32_t *vertex = l->indices + 3 * (size_t)primitive;
    const float share[3] = {1.0f - u - v, u, v};
    n[0] = n[1] = n[2] = 0.0f;
    for (int k = 0; k < 3; k++) {
        const float *normal = l->vertex_normals + 3 * (size_t)vertex[k];
        const float square = dot(normal, normal), scale = square > 0.0f ? share[k] / sqrtf(square) : 0.0f;
        for (int c = 0; c < 3; c++)
            n[c] += normal[c] * scale;
    }
    const float square = dot(n, n);
    if (!(square > 1e-6f) || isinf(square))
        return 0;
    for (int c = 0; c < 3; c++)
        n[c] /= sqrtf(square);
    return 1;
}

const float *cgt_look_mix_colors(const cgt_look *l, uint32_t primitive, float u, float v, float mixed[3])
{
    const uint32_t *vertex = l->indices + 3 * (size_t)primitive;
    const float share[3] = {1.0f - u - v, u, v};
    for (int c = 0; c < 3; c++) {
        mixed[c] = 0.0f;
        for (int k = 0; k < 3; k++)
            mixed[c] += share[k] * l->colors[3 * (size_t)vertex[k] + (size_t)c];
    }
    return mixed;
}

void cgt_look_turn_normal(const cgt_look *l, uint32_t primitive, const float *u, const float *v, size_t k,
                          const float dir[3], float n[3])
{
    float mixed[3];
    int flip = dot(n, dir) > 0.0f;
    if (l->vertex_normals && mix_normal(l, primitive, u[k], v[k], mixed)) {
        flip = (dot(n, mixed) < 0.0f) != flip;
        memcpy(n, mixed, sizeof mixed);
    }
    for (int c = 0; c < 3; c++)
        n[c] = flip ? -n[c] : n[c];
}
