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

/* The palette entry of a hit on a primitive, at (u, v) of a triangle. */
static inline uint32_t surface_entry(const surface *s, uint32_t primitive, float u, float v)
{
    const uint32_t *vertex = s->triangle + 3 * (size_t)primitive;
    const float share[3] = {1.0f - u - v, u, v};
    float sum = 0.5f;
    for (int k = 0; k < 3; k++) {
        const uint32_t entry = s->index[vertex[k]];
        if (entry >= s->palette_steps)
            return entry;
        sum += share[k] * (float)entry;
    }
    return sum > 0.0f ? sum < (float)s->palette_steps ? (uint32_t)sum : s->palette_steps - 1 : 0;
}

/* Interpolates a triangle's vertex normals, each as a unit vector, at (u, v). Returns 0 where the sum has no direction
 * or is not finite. */
int surface_mix_normal(const surface *s, uint32_t primitive, float u, float v, float n[3]);

#endif
