/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bounds and validity of every object: by chunks of fixed size, put together in order, so that the sums do not depend
 * on the threads. */
#include "build/commit.h"

#include <math.h>
#include <string.h>

#include "build/choose_structure.h"
#include "core/float_environment.h"
#include "build/grid/loose_grid_build.h"

#define CHUNK 8192u
#define VECTOR_MOST 16u /* clusters are written by whole vectors */

_Static_assert(CHUNK % (VECTOR_MOST * CGT_CLUSTER) == 0, "chunks have whole vectors of clusters");

typedef struct summary_job {
    const cgt_objects *objects;
    const cgt_kernel *kernel;
    cgt_summary_wishes wishes; /* classes: one for each chunk, or NULL */
    cgt_object_summary *part;
} summary_job;

static void empty_summary(cgt_object_summary *s)
{
    *s = (cgt_object_summary){
        .min = {INFINITY, INFINITY, INFINITY}, .max = {-INFINITY, -INFINITY, -INFINITY}, .bad_index = CGT_INVALID_ID};
}

/* Clusters that the chunk's objects are in: chunks have whole ones, but for the last. */
static void summarise_clusters(const summary_job *job, uint32_t first, uint32_t end, cgt_size_classes *classes)
{
    cgt_cluster *cluster = job->wishes.cluster + first / CGT_CLUSTER;
    job->kernel->summarise_clusters(cluster, cgt_clusters(end - first), classes);
}

static void summarise_chunk(void *argument, uint32_t index)
{
    const summary_job *job = argument;
    const cgt_objects *o = job->objects;
    const uint32_t first = index * CHUNK, end = o->count - first < CHUNK ? o->count : first + CHUNK;
    const cgt_object_array *a = cgt_objects_array(o, first);
    cgt_summary_wishes wishes = job->wishes;
    cgt_object_summary s;
    cgt_float_environment callers;
    cgt_float_environment_enter(&callers);
    empty_summary(&s);
    if (wishes.classes) {
        wishes.classes += index;
        memset(wishes.classes->used, 0, sizeof wishes.classes->used);
    }
    for (uint32_t object = first; object < end && s.bad_index == CGT_INVALID_ID; a++) {
        const uint32_t stop = end - a->first < a->count ? end : a->first + a->count;
        job->kernel->summarise(a, object, stop, &wishes, &s);
        object = stop;
    }
    if (wishes.cluster && s.bad_index == CGT_INVALID_ID)
        summarise_clusters(job, first, end, wishes.classes);
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

/* All classes to those of the first chunk. */
static void merge_classes(cgt_size_classes *classes, uint32_t chunks)
{
    for (uint32_t i = 1; i < chunks; i++)
        for (uint32_t word = 0; word < CGT_SIZE_CLASSES / 32; word++)
            for (uint32_t left = classes[i].used[word]; left; left &= left - 1) {
                const uint32_t k = 32 * word + (uint32_t)__builtin_ctz(left);
                cgt_size_classes_add(classes, k, &classes[i].of[k]);
            }
}

static cgt_result reserve_clusters(cgt_scene *scene, summary_job *job)
{
    cgt_buffer *buffer = &scene->buffer[CGT_BUFFER_LOOSE_CLUSTERS];
    const size_t count = (size_t)cgt_clusters(job->objects->count) + VECTOR_MOST;
    const cgt_result result = cgt_buffer_reserve(&scene->context->memory, buffer, count, sizeof(cgt_cluster));
    job->wishes.cluster = buffer->data;
    return result;
}

static cgt_result reserve(cgt_scene *scene, uint32_t chunks, bool clusters, summary_job *job)
{
    const cgt_memory_hooks *hooks = &scene->context->memory;
    const cgt_objects *o = &scene->world.objects;
    const char *why;
    const cgt_structure structure = cgt_choose_structure(&scene->options, &why);
    const bool loose = structure == CGT_STRUCTURE_LOOSE_GRID || structure == CGT_STRUCTURE_BVH;
    cgt_buffer *buffer = scene->buffer;
    cgt_result result = cgt_buffer_reserve(hooks, &buffer[CGT_BUFFER_SUMMARIES], chunks, sizeof(cgt_object_summary));
    if (result == CGT_OK && loose)
        result = cgt_buffer_reserve(hooks, &buffer[CGT_BUFFER_SIZE_CLASSES], chunks, sizeof(cgt_size_classes));
    if (result == CGT_OK && loose)
        result = cgt_loose_grid_reserve_work(hooks, &buffer[CGT_BUFFER_LOOSE_WORK], o, clusters);
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory to bound %u primitives", o->count);
    *job = (summary_job){.objects = o,
                         .kernel = scene->context->kernel,
                         .wishes = {.diameters = structure == CGT_STRUCTURE_QUEUE_GRID, .triangles = o->triangles},
                         .part = buffer[CGT_BUFFER_SUMMARIES].data};
    if (loose) {
        job->wishes.classes = buffer[CGT_BUFFER_SIZE_CLASSES].data;
        job->wishes.middle = buffer[CGT_BUFFER_LOOSE_WORK].data;
    }
    if (clusters && (result = reserve_clusters(scene, job)) != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory for clusters of %u triangles", o->count);
    return CGT_OK;
}

static cgt_result summarise(cgt_scene *scene, bool clusters, cgt_object_summary *s)
{
    const uint32_t chunks = (uint32_t)(((uint64_t)scene->world.objects.count + CHUNK - 1) / CHUNK);
    summary_job job;
    const cgt_result result = reserve(scene, chunks, clusters, &job);
    if (result != CGT_OK)
        return result;
    cgt_run_tasks(scene->context, summarise_chunk, &job, chunks);
    empty_summary(s);
    for (uint32_t i = 0; i < chunks; i++)
        merge_summary(s, &job.part[i]);
    if (s->bad_index != CGT_INVALID_ID)
        return bad_index(scene, s->bad_index);
    if (job.wishes.classes)
        merge_classes(job.wishes.classes, chunks);
    s->diameter[0] = s->valid;
    for (int a = 0; a < 3; a++) {
        /* the sums were rounded to nearest: one step outwards covers it */
        s->min[a] = s->valid ? nextafterf(s->min[a], -INFINITY) : 0;
        s->max[a] = s->valid ? nextafterf(s->max[a], INFINITY) : 0;
        s->magnitude = fmaxf(s->magnitude, fmaxf(fabsf(s->min[a]), fabsf(s->max[a])));
    }
    return CGT_OK;
}

cgt_result cgt_summarise(cgt_scene *scene, cgt_object_summary *s)
{
    const char *why;
    const cgt_structure structure = cgt_choose_structure(&scene->options, &why);
    const bool loose = structure == CGT_STRUCTURE_LOOSE_GRID && !scene->options.resolution[0];
    const bool tree = structure == CGT_STRUCTURE_BVH;
    const cgt_cluster_use use = loose || tree ? cgt_choose_clusters(&scene->world.objects) : CGT_CLUSTERS_NONE;
    const bool clusters = use == CGT_CLUSTERS_ALL || (use == CGT_CLUSTERS_GRID && loose);
    const cgt_result result = summarise(scene, clusters, s);
    scene->world.cluster = clusters ? scene->buffer[CGT_BUFFER_LOOSE_CLUSTERS].data : NULL;
    scene->world.tree_of_clusters = use == CGT_CLUSTERS_ALL;
    return result;
}

cgt_result cgt_summarise_objects(cgt_scene *scene)
{
    cgt_object_summary s;
    return summarise(scene, false, &s);
}
