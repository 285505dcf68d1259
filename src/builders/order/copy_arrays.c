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

/* Reads `count` numbers that lie side by side, at any address. Formats are constants where this is called. */
static inline void read_numbers(const char *at, cgt_format format, uint32_t count, double *to)
{
    const cgt_array array = {at, 0, format};
    for (uint32_t k = 0; k < count; k++)
        to[k] = cgt_array_get_number(&array, 0, count, k);
}

/* Points: three numbers each. Written to records of to_words floats. For a float without an origin the difference and
 * its rounding are exact. */
static inline void copy_formatted_points(const char *from, size_t stride, cgt_format format, const double origin[3],
                                         uint32_t count, float *to, uint32_t to_words)
{
    const double x = origin[0], y = origin[1], z = origin[2];
    for (uint32_t i = 0; i < count; i++, from += stride, to += to_words) {
        double p[3];
        read_numbers(from, format, 3, p);
        to[0] = (float)(p[0] - x);
        to[1] = (float)(p[1] - y);
        to[2] = (float)(p[2] - z);
    }
}

/* Points first, first + 1, ... */
static void copy_points(const cgt_array *points, size_t first, const double origin[3], uint32_t count, float *to,
                        uint32_t to_words)
{
    const char *from = (const char *)points->data + first * points->stride;
    if (points->format == CGT_FORMAT_DOUBLE)
        copy_formatted_points(from, points->stride, CGT_FORMAT_DOUBLE, origin, count, to, to_words);
    else if (points->format == CGT_FORMAT_FLOAT)
        copy_formatted_points(from, points->stride, CGT_FORMAT_FLOAT, origin, count, to, to_words);
    else
        copy_formatted_points(from, points->stride, CGT_FORMAT_HALF, origin, count, to, to_words);
}

/* Index or type k of element i; beyond 32 bits, which no count reaches: CGT_INVALID_ID. */
static inline uint32_t read_whole(const cgt_array *a, uint32_t i, uint32_t width, uint32_t k)
{
    const uint64_t value = cgt_array_get_whole(a, i, width, k);
    return value < CGT_INVALID_ID ? (uint32_t)value : CGT_INVALID_ID;
}

/* ---- radii ---- */

/* Radii from `from` on, of a format that is a constant where this is called. */
static inline void copy_radius_list(const char *from, size_t stride, cgt_format format, uint32_t count, float *to,
                                    uint32_t to_words)
{
    for (uint32_t k = 0; k < count; k++, from += stride) {
        double radius;
        read_numbers(from, format, 1, &radius);
        to[k * to_words] = (float)radius;
    }
}

/* Returns how many were copied: count, or those before the first type out of range. */
static uint32_t copy_typed_radii(const cgt_radii *r, uint32_t i, uint32_t count, float *to, uint32_t to_words)
{
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t type = read_whole(&r->types, i + k, 1, 0);
        if (type >= r->type_count)
            return k;
        to[k * to_words] = (float)cgt_array_get_number(&r->radii, type, 1, 0);
    }
    return count;
}

/* The same. */
static uint32_t copy_radii(const cgt_radii *r, uint32_t i, uint32_t count, float *to, uint32_t to_words)
{
    const char *from = (const char *)r->radii.data;
    const size_t stride = r->radii.stride;
    if (r->types.data)
        return copy_typed_radii(r, i, count, to, to_words);
    if (!from)
        for (uint32_t k = 0; k < count; k++)
            to[k * to_words] = r->radius;
    else if (r->radii.format == CGT_FORMAT_DOUBLE)
        copy_radius_list(from + i * stride, stride, CGT_FORMAT_DOUBLE, count, to, to_words);
    else if (r->radii.format == CGT_FORMAT_FLOAT)
        copy_radius_list(from + i * stride, stride, CGT_FORMAT_FLOAT, count, to, to_words);
    else
        copy_radius_list(from + i * stride, stride, CGT_FORMAT_HALF, count, to, to_words);
    return count;
}

/* ---- spheres ---- */

static uint32_t copy_spheres(const cgt_primitive_array *a, const cgt_spheres *s, uint32_t i, uint32_t count)
{
    const cgt_radii radii = CGT_RADII_OF(s);
    float *to = a->copy + (size_t)i * SPHERE_WORDS;
    copy_points(&s->centers, i, s->origin, count, to, SPHERE_WORDS);
    return copy_radii(&radii, i, count, to + 3, SPHERE_WORDS);
}

/* ---- capsules ---- */

/* Copies both ends of capsules i to i + count - 1. Returns how many: count, or those before the first index out of
 * range. */
static uint32_t copy_ends(const cgt_capsules *q, uint32_t i, uint32_t count, float *to)
{
    const cgt_array *ends = q->ends.data ? &q->ends : &q->vertices;
    for (uint32_t k = 0; k < count; k++, to += CAPSULE_WORDS) {
        uint32_t end[2] = {2 * (i + k), 2 * (i + k) + 1};
        if (q->ends.data)
            end[0] = end[1] = i + k;
        for (uint32_t j = 0; j < 2 && q->indices.data; j++)
            end[j] = read_whole(&q->indices, i + k, 2, j);
        if (end[0] >= q->vertex_count || end[1] >= q->vertex_count)
            return k;
        copy_points(&q->vertices, end[0], q->origin, 1, to, 0);
        copy_points(ends, end[1], q->origin, 1, to + 4, 0);
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
    float *to = job->array->copy + (size_t)first * POINT_WORDS;
    copy_points(&t->vertices, first, t->origin, count, to, POINT_WORDS);
}

static void copy_indices(void *argument, uint32_t index)
{
    const copy_job *job = argument;
    const cgt_array *from = &job->triangles->indices;
    const uint32_t first = index * CHUNK, count = chunk_count(job->triangles->count, first);
    uint32_t *to = job->array->index_copy + (size_t)first * 3;
    for (uint32_t k = 0; k < count; k++)
        for (uint32_t j = 0; j < 3; j++)
            *to++ = read_whole(from, first + k, 3, j);
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
