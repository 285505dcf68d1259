/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Colours and normals; see look.h. */
#include "draw/look.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "refuse.h"
#include "vector_range.h"

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Interpolates a triangle's vertex normals, each as a unit vector, at (u, v). Returns 0 where the sum has no direction
 * or is not finite. */
static int mix_normal(const picture_look *l, uint32_t primitive, float u, float v, float n[3])
{
    const uint32_t *vertex = l->indices + 3 * (size_t)primitive;
    const float share[3] = {1.0f - u - v, u, v};
    n[0] = n[1] = n[2] = 0.0f;
    for (int k = 0; k < 3; k++) {
        float normal[3];
        memcpy(normal, l->of.vertex_normals + 3 * (size_t)vertex[k], sizeof normal);
        picture_bring_near(normal);
        const float square = picture_square(normal), scale = square > 0.0f ? share[k] / sqrtf(square) : 0.0f;
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

const float *cgt_look_mix_colors(const picture_look *l, uint32_t primitive, float u, float v, float mixed[3])
{
    const uint32_t *vertex = l->indices + 3 * (size_t)primitive;
    const float share[3] = {1.0f - u - v, u, v};
    for (int c = 0; c < 3; c++) {
        mixed[c] = 0.0f;
        for (int k = 0; k < 3; k++)
            mixed[c] += share[k] * l->of.colors[3 * (size_t)vertex[k] + (size_t)c];
    }
    return mixed;
}

void cgt_look_turn_normal(const picture_look *l, uint32_t primitive, const float *u, const float *v, size_t k,
                          const float dir[3], float n[3])
{
    float mixed[3];
    int flip = dot(n, dir) > 0.0f;
    if (l->of.vertex_normals && mix_normal(l, primitive, u[k], v[k], mixed)) {
        flip = (dot(n, mixed) < 0.0f) != flip;
        memcpy(n, mixed, sizeof mixed);
    }
    for (int c = 0; c < 3; c++)
        n[c] = flip ? -n[c] : n[c];
}

/* ---- Looks of a scene ----------------------------------------------------------------------------------------- */

static const float default_grey = 0.7f;

/* Takes the indices of triangles as they lie there, or copies them. */
static cgt_result take_indices(picture_look *l, char *message, size_t size)
{
    const cgt_triangles *const t = &l->triangles;
    const cgt_array *const a = &t->indices;
    if (a->data && a->format == CGT_FORMAT_UINT32 && a->stride == 3 * sizeof *l->indices &&
        (uintptr_t)a->data % sizeof *l->indices == 0) {
        l->indices = a->data;
        return CGT_OK;
    }
    l->indices = l->copied = malloc(3 * (size_t)t->count * sizeof *l->copied + 1);
    if (!l->copied) {
        picture_refuse(message, size, "out of memory for the indices of %u triangles", t->count);
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    for (size_t i = 0; i < 3 * (size_t)t->count; i++)
        l->copied[i] = a->data ? (uint32_t)cgt_array_get_whole(a, i / 3, 3, i % 3) : (uint32_t)i;
    return CGT_OK;
}

static cgt_result set_look(picture_look *p, const cgt_scene *scene, uint32_t i, char *message, size_t size)
{
    cgt_look *const l = &p->of;
    p->is_triangles = scene && cgt_scene_get_triangles(scene, i, &p->triangles);
    p->is_spheres = scene && cgt_scene_get_spheres(scene, i, &p->spheres);
    p->is_capsules = scene && cgt_scene_get_capsules(scene, i, &(cgt_capsules){0});
    if (l->index && !l->palette)
        return picture_refuse(message, size, "look %u: index without a palette", i);
    if (l->per_vertex && !p->is_triangles)
        return picture_refuse(message, size, "look %u: per_vertex is for triangles, and the geometry has none", i);
    if (l->halves && (p->is_triangles || p->is_spheres))
        return picture_refuse(message, size, "look %u: halves are for capsules, and the geometry has none", i);
    if (l->vertex_normals && !p->is_triangles)
        return picture_refuse(message, size, "look %u: vertex_normals are for triangles, and the geometry has none", i);
    const float *const c = l->color;
    if (!picture_is_color(c))
        return picture_refuse(message, size, "look %u: colour %g, %g, %g: 0 to 1e30", i, (double)c[0], (double)c[1],
                              (double)c[2]);
    if (c[0] == 0.0f && c[1] == 0.0f && c[2] == 0.0f)
        l->color[0] = l->color[1] = l->color[2] = default_grey;
    l->per_vertex = l->per_vertex && (l->index || l->colors);
    l->halves = l->halves && (l->index || l->colors);
    return l->per_vertex || l->vertex_normals ? take_indices(p, message, size) : CGT_OK;
}

static void forget(picture_looks *looks)
{
    for (uint32_t i = 0; i < looks->count; i++)
        free(looks->look[i].copied);
    looks->count = 0;
}

cgt_result cgt_looks_set(picture_looks *looks, const cgt_scene *scene, const cgt_look *given, uint32_t count,
                         char *message, size_t size)
{
    const uint32_t there = cgt_scene_get_geometries(scene), most = there > count ? there : count;
    forget(looks);
    if (most == UINT32_MAX) {
        picture_refuse(message, size, "looks for more geometries than there can be");
        return CGT_ERROR_TOO_LARGE;
    }
    if (most >= looks->room) {
        picture_look *const more = realloc(looks->look, ((size_t)most + 1) * sizeof *more);
        if (!more) {
            picture_refuse(message, size, "out of memory for the looks of a picture");
            return CGT_ERROR_OUT_OF_MEMORY;
        }
        looks->look = more;
        looks->room = most + 1;
    }
    cgt_result result = CGT_OK;
    for (; looks->count <= most && result == CGT_OK; looks->count++) {
        picture_look *const p = &looks->look[looks->count];
        *p = (picture_look){.of = looks->count < count ? given[looks->count] : (cgt_look){.color = {0}}};
        result = set_look(p, looks->count < there ? scene : NULL, looks->count, message, size);
    }
    return result;
}

void cgt_looks_free(picture_looks *looks)
{
    forget(looks);
    free(looks->look);
}
