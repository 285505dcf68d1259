/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How the primitives of a geometry look: their colours, and the normals that light sees. */
#ifndef SURFACE_H
#define SURFACE_H

#include <stddef.h>
#include <stdint.h>

typedef struct surface {
    const uint16_t *index;      /* per primitive: entry of palette; per vertex where mix is set */
    int mix;                    /* triangles: 1: interpolate the entry of a hit from those of its vertices */
    const float (*palette)[3];  /* linear colours; interpolated ones lie in order, up to palette_steps */
    uint32_t palette_steps;     /* entries from here on are not interpolated: a hit takes that of a vertex */
    const uint32_t *triangle;   /* per primitive: its three vertices; NULL: primitives are spheres */
    const float *vertex_normal; /* per vertex: three floats, of any length; NULL: triangles are flat */
    const uint32_t *source;     /* per primitive: its number in the file, for pictures with ids; NULL: its index */
    uint32_t lineless; /* primitives from lineless - 1 on get no outlines, since they are lines themselves; 0: all do */
} surface;

/* The palette entry of hit k on a primitive; of planes or a tile, (u[k], v[k]) on a triangle. */
static inline uint32_t surface_entry(const surface *s, uint32_t primitive, const float *u, const float *v, size_t k)
{
    if (!s->mix || !s->triangle)
        return s->index[primitive];
    const uint32_t *vertex = s->triangle + 3 * (size_t)primitive;
    const float share[3] = {1.0f - u[k] - v[k], u[k], v[k]};
    float sum = 0.5f;
    for (int i = 0; i < 3; i++) {
        const uint32_t entry = s->index[vertex[i]];
        if (entry >= s->palette_steps)
            return entry;
        sum += share[i] * (float)entry;
    }
    return sum > 0.0f ? sum < (float)s->palette_steps ? (uint32_t)sum : s->palette_steps - 1 : 0;
}

/* Turns hit k's geometric normal n of a triangle to the eye's side, and puts the interpolated one of its vertices in
 * its place where there is one. dir: of the ray. */
void surface_turn_normal(const surface *s, uint32_t primitive, const float *u, const float *v, size_t k,
                         const float dir[3], float n[3]);

#endif
