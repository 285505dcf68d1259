/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The commit: from the caller's arrays to a structure, from scratch.
 *   1 list the arrays   2 bounds and validity of every object   3 plan the grid   4 fill it   5 sort what overflowed */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene.h"

/* ---- 1 ---- */

static cgt_result list_arrays(cgt_scene *scene)
{
    const cgt_geometry *geometry = scene->geometry.data;
    const cgt_result result =
        cgt_buffer_reserve(&scene->context->memory, &scene->arrays, scene->geometries, sizeof(cgt_sphere_array));
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory for %u geometries", scene->geometries);
    cgt_sphere_array *array = scene->arrays.data;
    cgt_objects objects = {.array = array};
    scene->statistics.geometries = 0;
    for (uint32_t id = 0; id < scene->geometries; id++) {
        const cgt_spheres *s = &geometry[id].spheres;
        if (!geometry[id].used)
            continue;
        scene->statistics.geometries++;
        if (!s->count)
            continue;
        array[objects.arrays++] = (cgt_sphere_array){.center = (const char *)s->centers,
                                                     .radius = (const char *)(s->radii ? s->radii : &s->radius),
                                                     .center_stride = s->center_stride,
                                                     .radius_stride = s->radii ? s->radius_stride : 0,
                                                     .first = objects.count,
                                                     .geometry = id};
        objects.count += s->count;
    }
    scene->grid.objects = objects;
    scene->statistics.primitives = objects.count;
    return CGT_OK;
}

/* ---- 2: by chunks of fixed size, put together in order, so that the sums do not depend on the threads ---- */

#define CHUNK 8192u
#define CHUNKS ((CGT_QUEUE_MAX_OBJECTS + CHUNK - 1) / CHUNK)

typedef struct summary_job {
    const cgt_objects *objects;
    cgt_object_summary part[CHUNKS];
} summary_job;

static void add_sphere(cgt_object_summary *s, cgt_sphere q)
{
    const float center[3] = {q.x, q.y, q.z};
    const double d = 2.0 * q.r;
    for (int a = 0; a < 3; a++) {
        const float low = center[a] - q.r, high = center[a] + q.r;
        s->min[a] = low < s->min[a] ? low : s->min[a];
        s->max[a] = high > s->max[a] ? high : s->max[a];
    }
    s->valid++;
    s->diameter[1] += d;
    s->diameter[2] += d * d;
    s->diameter[3] += d * d * d;
}

static void empty_summary(cgt_object_summary *s)
{
    *s = (cgt_object_summary){.min = {INFINITY, INFINITY, INFINITY}, .max = {-INFINITY, -INFINITY, -INFINITY}};
}

static void summarise_chunk(void *argument, uint32_t index)
{
    summary_job *job = argument;
    cgt_object_summary s;
    const uint32_t first = index * CHUNK, count = job->objects->count;
    const uint32_t end = count - first < CHUNK ? count : first + CHUNK;
    empty_summary(&s);
    for (uint32_t i = first; i < end; i++) {
        const cgt_sphere q = cgt_objects_sphere(job->objects, i);
        const cgt_sphere_state state = cgt_sphere_check(q);
        s.skipped_not_finite += state == CGT_SPHERE_NOT_FINITE;
        s.skipped_radius += state == CGT_SPHERE_NEGATIVE_RADIUS;
        if (state == CGT_SPHERE_VALID)
            add_sphere(&s, q);
    }
    job->part[index] = s;
}

static void merge_summary(cgt_object_summary *s, const cgt_object_summary *part)
{
    s->valid += part->valid;
    s->skipped_not_finite += part->skipped_not_finite;
    s->skipped_radius += part->skipped_radius;
    for (int a = 0; a < 3; a++) {
        s->min[a] = fminf(s->min[a], part->min[a]);
        s->max[a] = fmaxf(s->max[a], part->max[a]);
    }
    for (int k = 1; k < 4; k++)
        s->diameter[k] += part->diameter[k];
}

static void summarise(cgt_scene *scene, cgt_object_summary *s)
{
    summary_job job = {.objects = &scene->grid.objects};
    const uint32_t chunks = (job.objects->count + CHUNK - 1) / CHUNK;
    cgt_run_tasks(scene->context, summarise_chunk, &job, chunks);
    empty_summary(s);
    for (uint32_t i = 0; i < chunks; i++)
        merge_summary(s, &job.part[i]);
    s->diameter[0] = s->valid;
    for (int a = 0; a < 3; a++) {
        /* the sums were rounded to nearest: one step outwards covers it */
        s->min[a] = s->valid ? nextafterf(s->min[a], -INFINITY) : 0;
        s->max[a] = s->valid ? nextafterf(s->max[a], INFINITY) : 0;
        s->magnitude = fmaxf(s->magnitude, fmaxf(fabsf(s->min[a]), fabsf(s->max[a])));
    }
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
    const cgt_result result = cgt_buffer_reserve(&c->memory, &scene->voxels, g->most_cells, sizeof(cgt_voxel));
    if (result != CGT_OK)
        return cgt_fail(c, result, "commit: out of memory for %u voxels of 32 bytes", g->most_cells);
    g->voxel = scene->voxels.data;
    memset(g->voxel, 0xff, g->cells * sizeof(cgt_voxel));
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
    bool small = true;
    for (int a = 0; a < 3; a++) {
        st->bounds_min[a] = s->min[a];
        st->bounds_max[a] = s->max[a];
        st->resolution[a] = g->resolution[a];
        small &= g->resolution[a] <= 16;
    }
    st->cells = g->cells;
    st->bytes = sizeof *scene + scene->geometry.bytes + scene->arrays.bytes + scene->voxels.bytes +
                scene->overflow[0].bytes + scene->overflow[1].bytes;
    st->local_store_bytes = (size_t)g->cells * sizeof(cgt_voxel) + (size_t)g->overflows * sizeof(cgt_overflow) +
                            (size_t)g->objects.count * sizeof(cgt_sphere);
    st->fits_local_store = small && st->local_store_bytes + (64u << 10) <= 256u << 10;
}

static void log_commit(const cgt_scene *scene)
{
    const cgt_scene_statistics *st = &scene->statistics;
    const cgt_log_hook *log = &scene->context->log;
    char text[CGT_MESSAGE_BYTES];
    if (!log->write)
        return;
    if (st->skipped_not_finite || st->skipped_radius) {
        snprintf(text, sizeof text, "commit: of %u spheres %u skipped: not finite, %u skipped: negative radius",
                 st->primitives, st->skipped_not_finite, st->skipped_radius);
        log->write(log->user, CGT_LOG_WARNING, text);
    }
    snprintf(text, sizeof text, "commit: %u spheres, %ux%ux%u cells, %.3f ms; %s", st->primitives, st->resolution[0],
             st->resolution[1], st->resolution[2], st->commit_ms, st->reason);
    log->write(log->user, CGT_LOG_INFO, text);
}

cgt_result cgt_scene_commit(cgt_scene *scene)
{
    cgt_object_summary summary;
    if (!scene)
        return CGT_ERROR_INVALID_ARGUMENT;
    const double start = cgt_now_ms();
    scene->committed = false;
    scene->statistics = (cgt_scene_statistics){0};
    scene->grid = (cgt_queue_grid){0};
    cgt_result result = list_arrays(scene);
    if (result != CGT_OK)
        return result;
    if (scene->grid.objects.count > CGT_QUEUE_MAX_OBJECTS)
        return cgt_fail(scene->context, CGT_ERROR_TOO_MANY_PRIMITIVES,
                        "commit: %u primitives: the 16-bit references of a queue grid reach %u",
                        scene->grid.objects.count, CGT_QUEUE_MAX_OBJECTS);
    summarise(scene, &summary);
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
    scene->committed = true;
    log_commit(scene);
    return CGT_OK;
}
