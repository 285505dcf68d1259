/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours of hits, and the normals that light sees. */
#ifndef LOOK_H
#define LOOK_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/picture.h>

/* The look of a geometry, with what the picture takes from the scene. */
typedef struct picture_look {
    cgt_look of; /* the caller's, with the defaults in place of zeros */
    bool is_triangles;
    const uint32_t *indices; /* three a triangle, side by side; NULL: `of` interpolates nothing */
    uint32_t *copied;        /* these, if the scene has them otherwise */
    cgt_spheres spheres;     /* BOUNCES: the geometry, if it is one of these */
    cgt_triangles triangles;
    bool is_spheres, is_capsules;
} picture_look;

typedef struct picture_looks {
    picture_look *look; /* of geometry 0, 1, ...; the last one of all others */
    uint32_t count, room;
} picture_looks;

/* Sets the looks of all geometries of a scene, which may be NULL: then all are of spheres. Returns CGT_OK, or an error
 * with a sentence. */
cgt_result cgt_looks_set(picture_looks *looks, const cgt_scene *scene, const cgt_look *given, uint32_t count,
                         char *message, size_t size);
void cgt_looks_free(picture_looks *looks);

/* Where the colour of hit k is that has no vertices. */
static inline size_t look_element(const picture_look *l, uint32_t primitive, const float *u, size_t k)
{
    return l->of.halves ? 2 * (size_t)primitive + (u[k] > 0.5f) : primitive;
}

/* The palette entry of hit k on a primitive; of planes or a tile, (u[k], v[k]) on a triangle, u[k] along a capsule. */
static inline uint32_t look_entry(const picture_look *l, uint32_t primitive, const float *u, const float *v, size_t k)
{
    if (!l->indices || !l->of.per_vertex)
        return l->of.index[look_element(l, primitive, u, k)];
    const uint32_t *vertex = l->indices + 3 * (size_t)primitive;
    const float share[3] = {1.0f - u[k] - v[k], u[k], v[k]};
    float sum = 0.5f;
    for (int i = 0; i < 3; i++) {
        const uint32_t entry = l->of.index[vertex[i]];
        if (entry >= l->of.palette_steps)
            return entry;
        sum += share[i] * (float)entry;
    }
    return sum > 0.0f ? sum < (float)l->of.palette_steps ? (uint32_t)sum : l->of.palette_steps - 1 : 0;
}

/* Interpolates the colours of hit k's vertices; see look.c. Returns mixed. */
const float *cgt_look_mix_colors(const picture_look *l, uint32_t primitive, float u, float v, float mixed[3]);

/* The colour of hit k; mixed is where an interpolated one lies. */
static inline const float *look_color(const picture_look *l, uint32_t primitive, const float *u, const float *v,
                                      size_t k, float mixed[3])
{
    if (l->of.index)
        return l->of.palette + 3 * (size_t)look_entry(l, primitive, u, v, k);
    if (!l->of.colors)
        return l->of.color;
    return l->of.per_vertex ? cgt_look_mix_colors(l, primitive, u[k], v[k], mixed)
                            : l->of.colors + 3 * look_element(l, primitive, u, k);
}

/* Turns hit k's geometric normal n of a triangle to the eye's side, and puts the interpolated one of its vertices in
 * its place where there is one. dir: of the ray. */
void cgt_look_turn_normal(const picture_look *l, uint32_t primitive, const float *u, const float *v, size_t k,
                          const float dir[3], float n[3]);

#endif
