/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Copies of arrays. Spheres and capsules are copied chunk by chunk, just before they are bounded, so that the bounds
 * are computed from caches; each capsule gets its own ends. Triangles share vertices, so these are copied before. */
#include "builders/order/copy_arrays.h"

#include <string.h>

#include "builders/commit.h"

#define SPHERE_WORDS 4u  /* x, y, z, radius: loaded as records, without a separate array of radii */
#define CAPSULE_WORDS 8u /* p, radius, q, and one that is not used: points are four words apart */
#define POINT_WORDS 3u
#define ALIGNED_WORDS (CGT_ALIGNMENT / sizeof(float)) /* each copy begins at a cache line */
#define CHUNK 8192u                                   /* vertices, or triangles' indices, of a task */

/* ---- numbers ---- */

/* Points from doubles or floats at any address: three numbers each. Written to records of to_words floats. For a float
 * without an origin the difference and its rounding are exact. */
static inline void copy_points(const char *from, size_t stride, bool doubles, const double origin[3], uint32_t count,
                               float *to, uint32_t to_words)
{
    const double x = origin[0], y = origin[1], z = origin[2];
    for (uint32_t i = 0; i < count; i++, from += stride, to += to_words) {
        double p[3];
        float q[3];
        if (doubles) {
            memcpy(p, from, sizeof p);
        } else {
            memcpy(q, from, sizeof q);
            for (int a = 0; a < 3; a++)
                p[a] = (double)q[a];
        }
        to[0] = (float)(p[0] - x);
        to[1] = (float)(p[1] - y);
        to[2] = (float)(p[2] - z);
    }
}

static inline float read_number(const char *at, bool is_double)
{
    double d;
    float f;
    if (!is_double) {
        memcpy(&f, at, sizeof f);
        return f;
    }
    memcpy(&d, at, sizeof d);
    return (float)d;
}

/* ---- radii ---- */

static inline void copy_radius_list(const char *from, size_t stride, bool doubles, uint32_t count, float *to,
                                    uint32_t to_words)
{
    for (uint32_t k = 0; k < count; k++, from += stride)
        to[k * to_words] = read_number(from, doubles);
}

uint32_t cgt_radius_type(const cgt_radii *r, uint32_t i)
{
    const size_t offset = (size_t)i * r->type_stride;
    uint16_t small;
    uint32_t large;
    if (r->types8)
        return ((const unsigned char *)r->types8)[offset];
    if (r->types16) {
        memcpy(&small, (const char *)r->types16 + offset, sizeof small);
        return small;
    }
    memcpy(&large, (const char *)r->types32 + offset, sizeof large);
    return large;
}

/* Returns how many were copied: count, or those before the first type out of range. */
static uint32_t copy_typed_radii(const cgt_radii *r, uint32_t i, uint32_t count, float *to, uint32_t to_words)
{
    const char *radii = r->radii_double ? (const char *)r->radii_double : (const char *)r->radii;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t type = cgt_radius_type(r, i + k);
        if (type >= r->type_count)
            return k;
        to[k * to_words] = read_number(radii + type * r->radius_stride, r->radii_double);
    }
    return count;
}

/* The same. */
static uint32_t copy_radii(const cgt_radii *r, uint32_t i, uint32_t count, float *to, uint32_t to_words)
{
    const size_t offset = (size_t)i * r->radius_stride;
    if (cgt_radii_have_types(r))
        return copy_typed_radii(r, i, count, to, to_words);
    if (r->radii_double)
        copy_radius_list((const char *)r->radii_double + offset, r->radius_stride, true, count, to, to_words);
    else if (r->radii)
        copy_radius_list((const char *)r->radii + offset, r->radius_stride, false, count, to, to_words);
    else
        for (uint32_t k = 0; k < count; k++)
            to[k * to_words] = r->radius;
    return count;
}

/* ---- spheres ---- */

static void copy_centers(const cgt_spheres *s, uint32_t i, uint32_t count, float *to)
{
    const size_t offset = (size_t)i * s->center_stride;
    if (s->centers_double)
        copy_points((const char *)s->centers_double + offset, s->center_stride, true, s->origin, count, to,
                    SPHERE_WORDS);
    else
        copy_points((const char *)s->centers + offset, s->center_stride, false, s->origin, count, to, SPHERE_WORDS);
}

static uint32_t copy_spheres(const cgt_primitive_array *a, const cgt_spheres *s, uint32_t i, uint32_t count)
{
    const cgt_radii radii = CGT_RADII_OF(s);
    float *to = a->copy + (size_t)i * SPHERE_WORDS;
    copy_centers(s, i, count, to);
    return copy_radii(&radii, i, count, to + 3, SPHERE_WORDS);
}

/* ---- capsules ---- */

void cgt_capsule_indices(const cgt_capsules *q, uint32_t i, uint32_t end[2])
{
    const size_t offset = (size_t)i * q->index_stride;
    uint16_t small[2];
    end[0] = 2 * i;
    end[1] = 2 * i + 1;
    if (q->indices)
        memcpy(end, (const char *)q->indices + offset, 2 * sizeof *end);
    if (!q->indices16)
        return;
    memcpy(small, (const char *)q->indices16 + offset, sizeof small);
    end[0] = small[0];
    end[1] = small[1];
}

/* Copies both ends of capsules i to i + count - 1. Returns how many: count, or those before the first index out of
 * range. */
static uint32_t copy_ends(const cgt_capsules *q, uint32_t i, uint32_t count, float *to)
{
    const bool doubles = q->vertices_double != NULL;
    const char *vertices = doubles ? (const char *)q->vertices_double : (const char *)q->vertices;
    const char *ends = q->ends_double ? (const char *)q->ends_double : (const char *)q->ends;
    for (uint32_t k = 0; k < count; k++, to += CAPSULE_WORDS) {
        uint32_t end[2] = {i + k, i + k};
        if (!ends)
            cgt_capsule_indices(q, i + k, end);
        if (end[0] >= q->vertex_count || end[1] >= q->vertex_count)
            return k;
        copy_points(vertices + end[0] * q->vertex_stride, 0, doubles, q->origin, 1, to, 0);
        copy_points((ends ? ends : vertices) + end[1] * q->vertex_stride, 0, doubles, q->origin, 1, to + 4, 0);
        to[7] = 0;
    }
    return count;
}

static uint32_t copy_capsules(const cgt_primitive_array *a, const cgt_capsules *q, uint32_t i, uint32_t count)
{
    const cgt_radii radii = CGT_RADII_OF(q);
    float *to = a->copy + (size_t)i * CAPSULE_WORDS;
    return copy_radii(&radii, i, copy_ends(q, i, count, to), to + 3, CAPSULE_WORDS);
}

uint32_t cgt_copy_chunk(const cgt_primitive_array *a, const cgt_geometry *g, uint32_t i, uint32_t count)
{
    const uint32_t copied =
        a->kind == CGT_KIND_SPHERES ? copy_spheres(a, &g->spheres, i, count) : copy_capsules(a, &g->capsules, i, count);
    return copied == count ? CGT_INVALID_ID : i + copied;
}

/* ---- triangles ---- */

typedef struct copy_job {
    const cgt_primitive_array *array;
    const cgt_triangles *triangles;
} copy_job;

static uint32_t chunk_count(uint32_t all, uint32_t first) { return all - first < CHUNK ? all - first : CHUNK; }

static void copy_vertices(void *argument, uint32_t index)
{
    const copy_job *job = argument;
    const cgt_triangles *t = job->triangles;
    const uint32_t first = index * CHUNK, count = chunk_count(t->vertex_count, first);
    const size_t offset = (size_t)first * t->vertex_stride;
    float *to = job->array->copy + (size_t)first * POINT_WORDS;
    if (t->vertices_double)
        copy_points((const char *)t->vertices_double + offset, t->vertex_stride, true, t->origin, count, to,
                    POINT_WORDS);
    else
        copy_points((const char *)t->vertices + offset, t->vertex_stride, false, t->origin, count, to, POINT_WORDS);
}

static void copy_indices(void *argument, uint32_t index)
{
    const copy_job *job = argument;
    const cgt_triangles *t = job->triangles;
    const uint32_t first = index * CHUNK, count = chunk_count(t->count, first);
    const char *from =
        (t->indices16 ? (const char *)t->indices16 : (const char *)t->indices) + (size_t)first * t->index_stride;
    uint32_t *to = job->array->index_copy + (size_t)first * 3;
    for (uint32_t k = 0; k < count; k++, from += t->index_stride, to += 3) {
        uint16_t small[3];
        if (!t->indices16) {
            memcpy(to, from, 3 * sizeof *to);
            continue;
        }
        memcpy(small, from, sizeof small);
        for (int c = 0; c < 3; c++)
            to[c] = small[c];
    }
}

static uint32_t chunks_of(uint32_t count) { return count / CHUNK + (count % CHUNK != 0); }

void cgt_copy_triangles(const cgt_scene *scene)
{
    const cgt_geometry *geometry = scene->buffer[CGT_BUFFER_GEOMETRY].data;
    const cgt_primitives *prims = &scene->committed_scene.prims;
    for (uint32_t k = 0; k < prims->arrays; k++) {
        const cgt_primitive_array *a = &prims->array[k];
        copy_job job = {a, &geometry[a->geometry].triangles};
        if (a->kind != CGT_KIND_TRIANGLES)
            continue;
        if (a->copy)
            cgt_run_tasks(scene->context, copy_vertices, &job, chunks_of(a->points));
        if (a->index_copy)
            cgt_run_tasks(scene->context, copy_indices, &job, chunks_of(a->count));
    }
}

/* ---- memory ---- */

/* Places `words` words after *end, which moves on. Returns the place in words. */
static uint64_t place(uint64_t *end, uint64_t words)
{
    const uint64_t at = *end;
    *end += (words + ALIGNED_WORDS - 1) / ALIGNED_WORDS * ALIGNED_WORDS;
    return at;
}

/* Words of a copy of an array's points and radii; 0: they are read in place. *point_words: from one point to the next;
 * *radius_words: from one radius to the next. */
static uint64_t copied_words(const cgt_primitive_array *a, const cgt_geometry *g, uint32_t *point_words,
                             uint32_t *radius_words)
{
    *point_words = *radius_words = SPHERE_WORDS;
    switch (a->kind) {
    case CGT_KIND_SPHERES: return cgt_spheres_are_copied(&g->spheres) ? (uint64_t)a->count * SPHERE_WORDS : 0;
    case CGT_KIND_CAPSULES:
        *radius_words = CAPSULE_WORDS;
        return cgt_capsules_are_copied(&g->capsules) ? (uint64_t)a->count * CAPSULE_WORDS : 0;
    case CGT_KIND_TRIANGLES: break;
    }
    *point_words = POINT_WORDS;
    return cgt_vertices_are_copied(&g->triangles) ? (uint64_t)a->points * POINT_WORDS : 0;
}

/* Places the copies of one array after *end, which moves on; where data is not NULL, makes the array point to them. */
static void place_copies(cgt_primitive_array *a, const cgt_geometry *g, uint32_t *data, uint64_t *end)
{
    uint32_t point_words, radius_words;
    const uint64_t words = copied_words(a, g, &point_words, &radius_words);
    if (words) {
        const uint64_t at = place(end, words);
        if (data) {
            a->copy = (float *)(void *)(data + at);
            a->point = (const char *)a->copy;
            a->point_stride = point_words * sizeof(float);
            a->radius = a->point + POINT_WORDS * sizeof(float); /* of spheres and capsules */
            a->radius_stride = radius_words * sizeof(float);
            if (a->kind == CGT_KIND_CAPSULES) { /* ends side by side */
                a->index = NULL;
                a->points = 2 * a->count;
            }
        }
    }
    if (a->kind == CGT_KIND_TRIANGLES && cgt_indices_are_copied(&g->triangles)) {
        const uint64_t at = place(end, (uint64_t)a->count * 3);
        if (data) {
            a->index_copy = data + at;
            a->index = (const char *)a->index_copy;
            a->index_stride = 3 * sizeof *a->index_copy;
        }
    }
}

cgt_result cgt_reserve_copies(cgt_scene *scene)
{
    const cgt_geometry *geometry = scene->buffer[CGT_BUFFER_GEOMETRY].data;
    cgt_primitive_array *array = scene->buffer[CGT_BUFFER_ARRAYS].data;
    cgt_buffer *buffer = &scene->buffer[CGT_BUFFER_COPIES];
    const uint32_t arrays = scene->committed_scene.prims.arrays;
    uint64_t words = 0, end = 0, most = 0;
    uint32_t largest = 0;
    for (uint32_t k = 0; k < arrays; k++) {
        const uint64_t before = words;
        place_copies(&array[k], &geometry[array[k].geometry], NULL, &words);
        largest = words - before > most ? k : largest;
        most = words - before > most ? words - before : most;
    }
    scene->statistics.copied_bytes = (size_t)words * sizeof(float);
    if (!words)
        return CGT_OK;
    const cgt_result result = words > SIZE_MAX ? CGT_ERROR_TOO_LARGE
                                               : cgt_buffer_reserve_scattered(&scene->context->memory, buffer,
                                                                              (size_t)words, sizeof(uint32_t));
    if (result != CGT_OK)
        return cgt_fail(scene->context, result,
                        "commit: out of memory for %llu MB of float copies, most of geometry %u with %u primitives",
                        (unsigned long long)(words * sizeof(float) >> 20), array[largest].geometry,
                        array[largest].count);
    for (uint32_t k = 0; k < arrays; k++)
        place_copies(&array[k], &geometry[array[k].geometry], buffer->data, &end);
    return CGT_OK;
}

cgt_result cgt_scene_get_copied_bytes(const cgt_scene *scene, uint32_t geometry, size_t *bytes)
{
    if (!scene || !bytes)
        return cgt_fail_null(scene, __func__);
    const cgt_geometry *g = cgt_find_geometry(scene, geometry);
    if (!g)
        return CGT_ERROR_INVALID_ARGUMENT;
    cgt_primitive_array array = {.kind = g->kind,
                                 .count = cgt_geometry_count(g),
                                 .points = g->kind == CGT_KIND_TRIANGLES ? g->triangles.vertex_count : 0};
    uint64_t words = 0;
    place_copies(&array, g, NULL, &words);
    *bytes = (size_t)(words * sizeof(float));
    return CGT_OK;
}
