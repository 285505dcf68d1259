/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours of hits, and the normals that light sees. */
#ifndef LOOK_H
#define LOOK_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/picture.h>

/* Where the colour of hit k is that has no vertices. */
static inline size_t look_element(const cgt_look *l, uint32_t primitive, const float *u, size_t k)
{
    return l->halves ? 2 * (size_t)primitive + (u[k] > 0.5f) : primitive;
}

/* The palette entry of hit k on a primitive; of planes or a tile, (u[k], v[k]) on a triangle, u[k] along a capsule. */
static inline uint32_t look_entry(const cgt_look *l, uint32_t primitive, const float *u, const float *v, size_t k)
{
    if (!l->per_vertex || !l->indices) /* analysers do not know that per_vertex comes with them */
        return l->index[look_element(l, primitive, u, k)];
    const uint32_t *vertex = l->indices + 3 * (size_t)primitive;
    const float share[3] = {1.0f - u[k] - v[k], u[k], v[k]};
    float sum = 0.5f;
    for (int i = 0; i < 3; i++) {
        const uint32_t entry = l->index[vertex[i]];
        if (entry >= l->palette_steps)
            return entry;
        sum += share[i] * (float)entry;
    }
    return sum > 0.0f ? sum < (float)l->palette_steps ? (uint32_t)sum : l->palette_steps - 1 : 0;
}

/* Interpolates the colours of hit k's vertices; see look.c. Returns mixed. */
const float *cgt_look_mix_colors(const cgt_look *l, uint32_t primitive, float u, float v, float mixed[3]);

/* The colour of hit k; mixed is where an interpolated one lies. */
static inline const float *look_color(const cgt_look *l, uint32_t primitive, const float *u, const float *v, size_t k,
                                      float mixed[3])
{
    if (l->index)
        return l->palette + 3 * (size_t)look_entry(l, primitive, u, v, k);
    if (!l->colors)
        return l->color;
    return l->per_vertex ? cgt_look_mix_colors(l, primitive, u[k], v[k], mixed)
                         : l->colors + 3 * look_element(l, primitive, u, k);
}

/* Turns hit k's geometric normal n of a triangle to the eye's side, and puts the interpolated one of its vertices in
 * its place where there is one. dir: of the ray. */
void cgt_look_turn_normal(const cgt_look *l, uint32_t primitive, const float *u, const float *v, size_t k,
                          const float dir[3], float n[3]);

#endif
