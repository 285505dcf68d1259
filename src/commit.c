/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The commit: from the caller's arrays to a structure, from scratch.
 *   1 list the arrays   2 bounds and validity of every object   3 plan the grid   4 fill it   5 sort what overflowed */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "float_environment.h"
#include "scene.h"

/* ---- 1 ---- */

static cgt_object_array array_of(const cgt_geometry *g)
{
    const cgt_spheres *s = &g->spheres;
    const cgt_triangles *t = &g->triangles;
    if (g->kind == CGT_KIND_SPHERES)
        return (cgt_object_array){.kind = g->kind,
                                  .count = s->count,
                                  .point = (const char *)s->centers,
                                  .point_stride = s->center_stride,
                                  .radius = (const char *)(s->radii ? s->radii : &s->radius),
                                  .radius_stride = s->radii ? s->radius_stride : 0};
    return (cgt_object_array){.kind = g->kind,
                              .count = t->count,
                              .points = t->vertex_count,
                              .point = (const char *)t->vertices,
                              .point_stride = t->vertex_stride,
                              .index = (const char *)t->indices,
                              .index_stride = t->index_stride};
}

static cgt_result list_arrays(cgt_scene *scene)
{
    const cgt_geometry *geometry = scene->geometry.data;
    const cgt_result result =
        cgt_buffer_reserve(&scene->context->memory, &scene->arrays, scene->geometries, sizeof(cgt_object_array));
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory for %u geometries", scene->geometries);
    cgt_object_array *array = scene->arrays.data;
    cgt_objects objects = {.array = array};
    scene->statistics.geometries = 0;
    for (uint32_t id = 0; id < scene->geometries; id++) {
        if (!geometry[id].used)
            continue;
        scene->statistics.geometries++;
        cgt_object_array a = array_of(&geometry[id]);
        if (!a.count)
            continue;
        a.first = objects.count;
        a.geometry = id;
        array[objects.arrays++] = a;
        objects.count += a.count;
        *(a.kind == CGT_KIND_SPHERES ? &objects.spheres : &objects.triangles) += a.count;
    }
    scene->grid.objects = objects;
    scene->statistics.primitives = objects.count;
    scene->statistics.spheres = objects.spheres;
    scene->statistics.triangles = objects.triangles;
    return CGT_OK;
}

/* ---- 2: by chunks of fixed size, put together in order, so that the sums do not depend on the threads ---- */

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
    const cgt_object_array *a = cgt_objects_array(&scene->grid.objects, object);
    uint32_t corner[3], k = 0;
    cgt_array_corners(a, object - a->first, corner);
    while (k < 2 && corner[k] < a->points)
        k++;
    return cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT,
                    "commit: geometry %u: triangle %u has index %u, but there are %u vertices", a->geometry,
                    object - a->first, corner[k], a->points);
}

static cgt_result summarise(cgt_scene *scene, cgt_object_summary *s)
{
    const cgt_objects *o = &scene->grid.objects;
    const uint32_t chunks = (uint32_t)(((uint64_t)o->count + CHUNK - 1) / CHUNK);
    const cgt_result result =
        cgt_buffer_reserve(&scene->context->memory, &scene->summaries, chunks, sizeof(cgt_object_summary));
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory to bound %u primitives", o->count);
    summary_job job = {.objects = o, .part = scene->summaries.data};
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

/* ---- 4 ---- */

/* Room in the overflow list to begin with: a push asks for as much as it might spill, though it rarely spills. */
#define LEAST_OVERFLOW 1024

static cgt_result fill(cgt_scene *scene)
{
    cgt_context *c = scene->context;
    cgt_queue_grid *g = &scene->grid;
    cgt_overflow_list list = {.entry = scene->overflow[0].data,
                              .capacity = (uint32_t)(scene->overflow[0].bytes / sizeof(cgt_overflow))};
    cgt_fill_counts counts = {0};
    const size_t voxel_bytes = cgt_queue_grid_voxel_bytes(g);
    const cgt_result result = cgt_buffer_reserve(&c->memory, &scene->voxels, g->most_cells, voxel_bytes);
    if (result != CGT_OK)
        return cgt_fail(c, result, "commit: out of memory for %u voxels of %zu bytes", g->most_cells, voxel_bytes);
    g->voxel = scene->voxels.data;
    g->wide_voxel = scene->voxels.data;
    memset(scene->voxels.data, 0xff, g->cells * voxel_bytes);
    for (uint32_t object = 0; object < g->objects.count;) {
        object = c->kernel->queue_grid_fill(g, object, g->objects.count, &list, &counts);
        if (object == g->objects.count)
            break;
        const uint64_t needed = (uint64_t)list.count + list.wanted;
        const uint64_t wanted = needed < LEAST_OVERFLOW ? LEAST_OVERFLOW : needed;
        const cgt_result grown = wanted > UINT32_MAX ? CGT_ERROR_TOO_LARGE
                                                     : cgt_buffer_grow(&c->memory, &scene->overflow[0], (size_t)wanted,
                                                                       sizeof(cgt_overflow));
        if (grown != CGT_OK)
            return cgt_fail(c, grown, "commit: out of memory for %llu overflow references", (unsigned long long)wanted);
        list.entry = scene->overflow[0].data;
        list.capacity = (uint32_t)(scene->overflow[0].bytes / sizeof(cgt_overflow));
    }
    g->overflow = list.entry;
    g->overflows = list.count;
    scene->statistics.references = counts.references;
    scene->statistics.large_primitives = counts.large_primitives;
    return CGT_OK;
}

/* ---- 5: two passes of 12 bits, since there are at most 2^24 cells; the order within a cell stays ---- */

static void sort_pass(const cgt_overflow *from, cgt_overflow *to, uint32_t count, unsigned shift)
{
    uint32_t start[4096] = {0}, sum = 0;
    for (uint32_t i = 0; i < count; i++)
        start[from[i].cell >> shift & 4095]++;
    for (int k = 0; k < 4096; k++) {
        const uint32_t n = start[k];
        start[k] = sum;
        sum += n;
    }
    for (uint32_t i = 0; i < count; i++)
        to[start[from[i].cell >> shift & 4095]++] = from[i];
}

static cgt_result sort_overflow(cgt_scene *scene)
{
    cgt_queue_grid *g = &scene->grid;
    const cgt_result result =
        cgt_buffer_grow(&scene->context->memory, &scene->overflow[1], g->overflows, sizeof(cgt_overflow));
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory to sort %u overflow references", g->overflows);
    cgt_overflow *entry = scene->overflow[0].data;
    sort_pass(entry, scene->overflow[1].data, g->overflows, 0);
    sort_pass(scene->overflow[1].data, entry, g->overflows, 12);
    scene->statistics.overflow_references = g->overflows;
    for (uint32_t i = 0; i < g->overflows; i++)
        scene->statistics.overflow_cells += i == 0 || entry[i].cell != entry[i - 1].cell;
    return CGT_OK;
}

/* ---- the whole ---- */

static void report(cgt_scene *scene, const cgt_object_summary *s)
{
    cgt_scene_statistics *st = &scene->statistics;
    const cgt_queue_grid *g = &scene->grid;
    st->structure = CGT_STRUCTURE_QUEUE_GRID;
    st->skipped_not_finite = s->skipped_not_finite;
    st->skipped_radius = s->skipped_radius;
    st->skipped_degenerate = s->skipped_degenerate;
    st->reference_bits = g->wide ? 32 : 16;
    bool small = true;
    for (int a = 0; a < 3; a++) {
        st->bounds_min[a] = s->min[a];
        st->bounds_max[a] = s->max[a];
        st->resolution[a] = g->resolution[a];
        small &= g->resolution[a] <= 16;
    }
    st->cells = g->cells;
    st->bytes = sizeof *scene + scene->geometry.bytes + scene->arrays.bytes + scene->summaries.bytes +
                scene->voxels.bytes + scene->overflow[0].bytes + scene->overflow[1].bytes;
    st->local_store_bytes =
        (size_t)g->cells * cgt_queue_grid_voxel_bytes(g) + (size_t)g->overflows * sizeof(cgt_overflow) +
        (size_t)g->objects.spheres * sizeof(cgt_sphere) + (size_t)g->objects.triangles * sizeof(cgt_triangle);
    st->fits_local_store = small && st->local_store_bytes + (64u << 10) <= 256u << 10;
}

static void log_commit(const cgt_scene *scene)
{
    const cgt_scene_statistics *st = &scene->statistics;
    const cgt_log_hook *log = &scene->context->log;
    char text[CGT_MESSAGE_BYTES];
    if (!log->write)
        return;
    if (st->skipped_not_finite || st->skipped_radius || st->skipped_degenerate) {
        snprintf(text, sizeof text,
                 "commit: of %u primitives %u skipped: not finite, %u skipped: negative radius, %u skipped: no area",
                 st->primitives, st->skipped_not_finite, st->skipped_radius, st->skipped_degenerate);
        log->write(log->user, CGT_LOG_WARNING, text);
    }
    snprintf(text, sizeof text, "commit: %u spheres, %u triangles, %ux%ux%u cells, %.3f ms; %s", st->spheres,
             st->triangles, st->resolution[0], st->resolution[1], st->resolution[2], st->commit_ms, st->reason);
    log->write(log->user, CGT_LOG_INFO, text);
}

static cgt_result build(cgt_scene *scene)
{
    cgt_object_summary summary = {0};
    const double start = cgt_now_ms();
    cgt_result result = list_arrays(scene);
    if (result == CGT_OK)
        result = summarise(scene, &summary);
    if (result != CGT_OK)
        return result;
    const double bounded = cgt_now_ms();
    result = cgt_queue_grid_plan(&scene->grid, &summary, scene->options.resolution, scene->statistics.reason);
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: the resolution is beyond the limits");
    if (summary.valid) {
        result = fill(scene);
        if (result == CGT_OK && scene->grid.overflows)
            result = sort_overflow(scene);
        if (result != CGT_OK)
            return result;
    }
    report(scene, &summary);
    const double end = cgt_now_ms();
    scene->statistics.bounds_ms = bounded - start;
    scene->statistics.build_ms = end - bounded;
    scene->statistics.commit_ms = end - start;
    return CGT_OK;
}

cgt_result cgt_scene_commit(cgt_scene *scene)
{
    fenv_t callers;
    if (!scene)
        return CGT_ERROR_INVALID_ARGUMENT;
    scene->committed = false;
    scene->statistics = (cgt_scene_statistics){0};
    scene->grid = (cgt_queue_grid){0};
    cgt_float_environment_enter(&callers);
    const cgt_result result = build(scene);
    cgt_float_environment_leave(&callers);
    if (result != CGT_OK)
        return result;
    scene->committed = true;
    log_commit(scene);
    return CGT_OK;
}
