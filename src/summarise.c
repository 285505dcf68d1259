/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bounds and validity of every object: by chunks of fixed size, put together in order, so that the sums do not depend
 * on the threads. */
#include "commit.h"

#include <math.h>

#include "float_environment.h"

#define CHUNK 8192u

typedef struct summary_job {
    const cgt_objects *objects;
    cgt_object_summary *part;
} summary_job;

static void add_bounds(cgt_object_summary *s, const float low[3], const float high[3], double d)
{
    for (int a = 0; a < 3; a++) {
        s->min[a] = low[a] < s->min[a] ? low[a] : s->min[a];
        s->max[a] = high[a] > s->max[a] ? high[a] : s->max[a];
    }
    s->valid++;
    s->diameter[1] += d;
    s->diameter[2] += d * d;
    s->diameter[3] += d * d * d;
}

static void add_sphere(cgt_object_summary *s, cgt_sphere q)
{
    const float low[3] = {q.x - q.r, q.y - q.r, q.z - q.r}, high[3] = {q.x + q.r, q.y + q.r, q.z + q.r};
    const cgt_object_state state = cgt_sphere_check(q);
    s->skipped_not_finite += state == CGT_OBJECT_NOT_FINITE;
    s->skipped_radius += state == CGT_OBJECT_NEGATIVE_RADIUS;
    if (state == CGT_OBJECT_VALID)
        add_bounds(s, low, high, 2.0 * q.r);
}

/* A triangle's diameter is the mean edge of its bounds: it is flat, and touches fewer cells than they do. */
static void add_triangle(cgt_object_summary *s, const cgt_triangle *q)
{
    const cgt_object_state state = cgt_triangle_check(q);
    float low[3], high[3];
    double extent = 0;
    s->skipped_not_finite += state == CGT_OBJECT_NOT_FINITE;
    s->skipped_degenerate += state == CGT_OBJECT_DEGENERATE;
    if (state != CGT_OBJECT_VALID)
        return;
    for (int a = 0; a < 3; a++) {
        low[a] = fminf(q->v[0][a], fminf(q->v[1][a], q->v[2][a]));
        high[a] = fmaxf(q->v[0][a], fmaxf(q->v[1][a], q->v[2][a]));
        extent += (double)high[a] - (double)low[a];
    }
    add_bounds(s, low, high, extent / 3);
}

static void empty_summary(cgt_object_summary *s)
{
    *s = (cgt_object_summary){
        .min = {INFINITY, INFINITY, INFINITY}, .max = {-INFINITY, -INFINITY, -INFINITY}, .bad_index = CGT_NONE};
}

static bool indices_are_good(const cgt_object_array *a, uint32_t i)
{
    uint32_t corner[3];
    cgt_array_corners(a, i, corner);
    return corner[0] < a->points && corner[1] < a->points && corner[2] < a->points;
}

/* Objects first to end - 1, all of one array. Stops at a bad index. */
static void summarise_array(const cgt_object_array *a, uint32_t first, uint32_t end, cgt_object_summary *s)
{
    for (uint32_t object = first; object < end; object++) {
        const uint32_t i = object - a->first;
        if (a->kind == CGT_KIND_SPHERES) {
            add_sphere(s, cgt_array_sphere(a, i));
            continue;
        }
        if (!indices_are_good(a, i)) {
            s->bad_index = object;
            return;
        }
        const cgt_triangle q = cgt_array_triangle(a, i);
        add_triangle(s, &q);
    }
}

static void summarise_chunk(void *argument, uint32_t index)
{
    summary_job *job = argument;
    const cgt_objects *o = job->objects;
    const uint32_t first = index * CHUNK, end = o->count - first < CHUNK ? o->count : first + CHUNK;
    const cgt_object_array *a = cgt_objects_array(o, first);
    cgt_object_summary s;
    fenv_t callers;
    cgt_float_environment_enter(&callers);
    empty_summary(&s);
    for (uint32_t object = first; object < end && s.bad_index == CGT_NONE; a++) {
        const uint32_t stop = end - a->first < a->count ? end : a->first + a->count;
        summarise_array(a, object, stop, &s);
        object = stop;
    }
    job->part[index] = s;
    cgt_float_environment_leave(&callers);
}

static void merge_summary(cgt_object_summary *s, const cgt_object_summary *part)
{
    s->valid += part->valid;
    s->skipped_not_finite += part->skipped_not_finite;
    s->skipped_radius += part->skipped_radius;
    s->skipped_degenerate += part->skipped_degenerate;
    s->bad_index = part->bad_index < s->bad_index ? part->bad_index : s->bad_index;
    for (int a = 0; a < 3; a++) {
        s->min[a] = fminf(s->min[a], part->min[a]);
        s->max[a] = fmaxf(s->max[a], part->max[a]);
    }
    for (int k = 1; k < 4; k++)
        s->diameter[k] += part->diameter[k];
}

static cgt_result bad_index(const cgt_scene *scene, uint32_t object)
{
    const cgt_object_array *a = cgt_objects_array(&scene->world.objects, object);
    uint32_t corner[3], k = 0;
    cgt_array_corners(a, object - a->first, corner);
    while (k < 2 && corner[k] < a->points)
        k++;
    return cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT,
                    "commit: geometry %u: triangle %u has index %u, but there are %u vertices", a->geometry,
                    object - a->first, corner[k], a->points);
}

cgt_result cgt_summarise(cgt_scene *scene, cgt_object_summary *s)
{
    const cgt_objects *o = &scene->world.objects;
    const uint32_t chunks = (uint32_t)(((uint64_t)o->count + CHUNK - 1) / CHUNK);
    const cgt_result result = cgt_buffer_reserve(&scene->context->memory, &scene->buffer[CGT_BUFFER_SUMMARIES], chunks,
                                                 sizeof(cgt_object_summary));
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory to bound %u primitives", o->count);
    summary_job job = {.objects = o, .part = scene->buffer[CGT_BUFFER_SUMMARIES].data};
    cgt_run_tasks(scene->context, summarise_chunk, &job, chunks);
    empty_summary(s);
    for (uint32_t i = 0; i < chunks; i++)
        merge_summary(s, &job.part[i]);
    if (s->bad_index != CGT_NONE)
        return bad_index(scene, s->bad_index);
    s->diameter[0] = s->valid;
    for (int a = 0; a < 3; a++) {
        /* the sums were rounded to nearest: one step outwards covers it */
        s->min[a] = s->valid ? nextafterf(s->min[a], -INFINITY) : 0;
        s->max[a] = s->valid ? nextafterf(s->max[a], INFINITY) : 0;
        s->magnitude = fmaxf(s->magnitude, fmaxf(fabsf(s->min[a]), fabsf(s->max[a])));
    }
    return CGT_OK;
}
