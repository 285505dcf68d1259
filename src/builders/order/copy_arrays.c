/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Copies of arrays. Spheres are copied chunk by chunk, just before they are bounded, so that the bounds are computed
 * from caches. Triangles share vertices, so these are copied before. */
#include "builders/order/copy_arrays.h"

#include <string.h>

#include "builders/commit.h"
#include "scene/check_geometry.h"

#define SPHERE_WORDS 4u /* x, y, z, radius: loaded as records, without a separate array of radii */
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

static inline void copy_radius_list(const char *from, size_t stride, bool doubles, uint32_t count, float *to)
{
    for (uint32_t k = 0; k < count; k++, from += stride)
        to[k * SPHERE_WORDS] = read_number(from, doubles);
}

uint32_t cgt_sphere_type(const cgt_spheres *s, uint32_t i)
{
    const size_t offset = (size_t)i * s->type_stride;
    uint16_t small;
    uint32_t large;
    if (s->types8)
        return ((const unsigned char *)s->types8)[offset];
    if (s->types16) {
        memcpy(&small, (const char *)s->types16 + offset, sizeof small);
        return small;
    }
    memcpy(&large, (const char *)s->types32 + offset, sizeof large);
    return large;
}

/* Returns how many were copied: count, or those before the first type out of range. */
static uint32_t copy_typed_radii(const cgt_spheres *s, uint32_t i, uint32_t count, float *to)
{
    const char *radii = s->radii_double ? (const char *)s->radii_double : (const char *)s->radii;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t type = cgt_sphere_type(s, i + k);
        if (type >= s->type_count)
            return k;
        to[k * SPHERE_WORDS] = read_number(radii + type * s->radius_stride, s->radii_double);
    }
    return count;
}

/* The same. */
static uint32_t copy_radii(const cgt_spheres *s, uint32_t i, uint32_t count, float *to)
{
    const size_t offset = (size_t)i * s->radius_stride;
    if (s->types8 || s->types16 || s->types32)
        return copy_typed_radii(s, i, count, to);
    if (s->radii_double)
        copy_radius_list((const char *)s->radii_double + offset, s->radius_stride, true, count, to);
    else if (s->radii)
        copy_radius_list((const char *)s->radii + offset, s->radius_stride, false, count, to);
    else
        for (uint32_t k = 0; k < count; k++)
            to[k * SPHERE_WORDS] = s->radius;
    return count;
}

uint32_t cgt_copy_spheres(const cgt_primitive_array *a, const cgt_geometry *geometry, uint32_t i, uint32_t count)
{
    const cgt_spheres *s = &geometry->spheres;
    float *to = a->copy + (size_t)i * SPHERE_WORDS;
    copy_centers(s, i, count, to);
    const uint32_t copied = copy_radii(s, i, count, to + 3);
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

/* Places the copies of one array after *end, which moves on; where data is not NULL, makes the array point to them. */
static void place_copies(cgt_primitive_array *a, const cgt_geometry *g, uint32_t *data, uint64_t *end)
{
    const bool spheres = a->kind == CGT_KIND_SPHERES;
    if (spheres ? cgt_spheres_are_copied(&g->spheres) : cgt_vertices_are_copied(&g->triangles)) {
        const uint32_t words = spheres ? SPHERE_WORDS : POINT_WORDS;
        const uint64_t at = place(end, (uint64_t)(spheres ? a->count : a->points) * words);
        if (data) {
            a->copy = (float *)(void *)(data + at);
            a->point = (const char *)a->copy;
            a->point_stride = words * sizeof(float);
            a->radius = a->point + POINT_WORDS * sizeof(float); /* of spheres */
            a->radius_stride = a->point_stride;
        }
    }
    if (!spheres && cgt_indices_are_copied(&g->triangles)) {
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
    const bool spheres = g->kind == CGT_KIND_SPHERES;
    cgt_primitive_array array = {.kind = g->kind,
                                 .count = spheres ? g->spheres.count : g->triangles.count,
                                 .points = spheres ? 0 : g->triangles.vertex_count};
    uint64_t words = 0;
    place_copies(&array, g, NULL, &words);
    *bytes = (size_t)(words * sizeof(float));
    return CGT_OK;
}
