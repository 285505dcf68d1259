/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bounds and validity of every primitive: by chunks of fixed size, merged in order, so that the sums do not depend on
 * the threads. Spheres and capsules that need a copy are copied here, chunk by chunk. */
#include "builders/commit.h"

#include <math.h>
#include <string.h>

#include "builders/order/cell_sort.h"
#include "builders/order/copy_arrays.h"
#include "builders/order/size_levels.h"
#include "core/scratch_tasks.h"

#define CHUNK 8192u
#define MAX_VECTOR 16u /* clusters are written by whole vectors */

_Static_assert(CHUNK % (MAX_VECTOR * CGT_CLUSTER) == 0, "chunks have whole vectors of clusters");

typedef struct bounds_job {
    const cgt_primitives *prims;
    const cgt_geometry *geometry; /* from which those are copied that need it; NULL: they have been */
    const cgt_kernel *kernel;
    cgt_bounds_request request; /* classes: one for each chunk, or NULL */
    cgt_primitive_bounds *chunk_bounds;
    float max_half_area; /* of clusters */
} bounds_job;

static void bounds_clear(cgt_primitive_bounds *s)
{
    *s = (cgt_primitive_bounds){
        .min = {INFINITY, INFINITY, INFINITY}, .max = {-INFINITY, -INFINITY, -INFINITY}, .bad_index = CGT_INVALID_ID};
}

/* Completes the clusters of a chunk's triangles: chunks have whole ones, except the last. Returns the large ones. */
static uint32_t compute_cluster_bounds(const bounds_job *job, uint32_t first, uint32_t end, cgt_size_classes *classes,
                                       cgt_scratch *scratch)
{
    cgt_cluster *cluster = job->request.cluster + first / CGT_CLUSTER;
    return job->kernel->compute_cluster_bounds(cluster, cgt_clusters(end - first), job->max_half_area, classes,
                                               scratch);
}

/* Returns false at an index or a type out of range. */
static bool copy_chunk(const bounds_job *job, const cgt_primitive_array *a, uint32_t prim, uint32_t stop,
                       cgt_primitive_bounds *s)
{
    if (!job->geometry || !a->copy || a->kind == CGT_KIND_TRIANGLES)
        return true;
    const uint32_t bad = cgt_copy_chunk(a, &job->geometry[a->geometry], prim - a->first, stop - prim);
    s->bad_index = bad == CGT_INVALID_ID ? CGT_INVALID_ID : a->first + bad;
    return bad == CGT_INVALID_ID;
}

static void compute_chunk_bounds(void *argument, uint32_t index, cgt_scratch *scratch)
{
    const bounds_job *job = argument;
    const cgt_primitives *o = job->prims;
    const uint32_t first = index * CHUNK, end = o->count - first < CHUNK ? o->count : first + CHUNK;
    const cgt_primitive_array *a = cgt_primitives_array(o, first);
    cgt_bounds_request request = job->request;
    cgt_primitive_bounds s;
    request.scratch = scratch;
    bounds_clear(&s);
    if (request.classes) {
        request.classes += index;
        memset(request.classes->used_classes, 0, sizeof request.classes->used_classes);
    }
    for (uint32_t prim = first; prim < end && s.bad_index == CGT_INVALID_ID; a++) {
        const uint32_t stop = end - a->first < a->count ? end : a->first + a->count;
        if (copy_chunk(job, a, prim, stop, &s))
            job->kernel->compute_bounds(a, prim, stop, &request, &s);
        prim = stop;
    }
    if (request.cluster && s.bad_index == CGT_INVALID_ID)
        s.large_clusters = compute_cluster_bounds(job, first, end, request.classes, scratch);
    job->chunk_bounds[index] = s;
}

static void bounds_merge(cgt_primitive_bounds *s, const cgt_primitive_bounds *chunk_bounds)
{
    s->valid += chunk_bounds->valid;
    s->large_clusters += chunk_bounds->large_clusters;
    s->skipped_not_finite += chunk_bounds->skipped_not_finite;
    s->skipped_radius += chunk_bounds->skipped_radius;
    s->skipped_degenerate += chunk_bounds->skipped_degenerate;
    s->bad_index = chunk_bounds->bad_index < s->bad_index ? chunk_bounds->bad_index : s->bad_index;
    for (int a = 0; a < 3; a++) {
        s->min[a] = fminf(s->min[a], chunk_bounds->min[a]);
        s->max[a] = fmaxf(s->max[a], chunk_bounds->max[a]);
    }
    for (int k = 1; k < 4; k++)
        s->diameter[k] += chunk_bounds->diameter[k];
}

static cgt_result bad_type(const cgt_scene *scene, const cgt_primitive_array *a, const char *kind, uint32_t i,
                           const cgt_radii *radii)
{
    return cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT,
                    "commit: geometry %u: %s %u has type %llu, but there are %u types", a->geometry, kind, i,
                    (unsigned long long)cgt_array_get_whole(&radii->types, i, 1, 0), radii->type_count);
}

/* The first index of primitive i out of range; `points` if there is none. */
static uint64_t find_bad_index(const cgt_array *indices, uint32_t i, uint32_t width, uint32_t points)
{
    for (uint32_t k = 0; k < width && indices->data; k++)
        if (cgt_array_get_whole(indices, i, width, k) >= points)
            return cgt_array_get_whole(indices, i, width, k);
    return points;
}

static cgt_result bad_point(const cgt_scene *scene, const cgt_primitive_array *a, const char *kind, uint32_t i,
                            uint64_t index, uint32_t points)
{
    return cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT,
                    "commit: geometry %u: %s %u has index %llu, but there are %u vertices", a->geometry, kind, i,
                    (unsigned long long)index, points);
}

static cgt_result bad_index(const cgt_scene *scene, uint32_t prim)
{
    const cgt_primitive_array *a = cgt_primitives_array(&scene->committed_scene.prims, prim);
    const cgt_geometry *g = (const cgt_geometry *)scene->buffer[CGT_BUFFER_GEOMETRY].data + a->geometry;
    const uint32_t i = prim - a->first;
    if (a->kind == CGT_KIND_TRIANGLES)
        return bad_point(scene, a, "triangle", i, find_bad_index(&g->triangles.indices, i, 3, a->points), a->points);
    const bool sphere = a->kind == CGT_KIND_SPHERES;
    const cgt_radii radii = sphere ? CGT_RADII_OF(&g->spheres) : CGT_RADII_OF(&g->capsules);
    if (sphere)
        return bad_type(scene, a, "sphere", i, &radii);
    const uint32_t points = g->capsules.vertex_count;
    const uint64_t index = find_bad_index(&g->capsules.indices, i, 2, points);
    if (radii.types.data && cgt_array_get_whole(&radii.types, i, 1, 0) >= radii.type_count && index == points)
        return bad_type(scene, a, "capsule", i, &radii);
    return bad_point(scene, a, "capsule", i, index, points);
}

static cgt_result reserve_clusters(cgt_scene *scene, bounds_job *job)
{
    cgt_buffer *buffer = &scene->buffer[CGT_BUFFER_CLUSTERS];
    const size_t count = (size_t)cgt_clusters(job->prims->count) + MAX_VECTOR;
    const cgt_result result = cgt_buffer_reserve(&scene->context->memory, buffer, count, sizeof(cgt_cluster));
    job->request.cluster = buffer->data;
    return result;
}

static cgt_result reserve(cgt_scene *scene, uint32_t chunks, bool clusters, bounds_job *job)
{
    const cgt_memory_hooks *hooks = &scene->context->memory;
    const cgt_primitives *o = &scene->committed_scene.prims;
    const cgt_structure structure = scene->committed_scene.structure;
    const bool loose = structure == CGT_STRUCTURE_LOOSE_GRID || structure == CGT_STRUCTURE_BVH;
    cgt_buffer *buffer = scene->buffer;
    cgt_result result = cgt_buffer_reserve(hooks, &buffer[CGT_BUFFER_BOUNDS], chunks, sizeof(cgt_primitive_bounds));
    if (result == CGT_OK && loose)
        result = cgt_buffer_reserve(hooks, &buffer[CGT_BUFFER_SIZE_CLASSES], chunks, sizeof(cgt_size_classes));
    if (result == CGT_OK && loose)
        result = cgt_cell_sort_reserve_work(scene, clusters);
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory to bound %u primitives", o->count);
    *job =
        (bounds_job){.prims = o,
                     .kernel = scene->context->kernel,
                     .request = {.diameters = structure == CGT_STRUCTURE_QUEUE_GRID, .boxed = cgt_primitives_boxed(o)},
                     .chunk_bounds = buffer[CGT_BUFFER_BOUNDS].data};
    if (loose) {
        job->request.classes = buffer[CGT_BUFFER_SIZE_CLASSES].data;
        job->request.middle = buffer[CGT_BUFFER_CELL_SORT_WORK].data;
    }
    if (clusters && (result = reserve_clusters(scene, job)) != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory for clusters of %u triangles", o->count);
    return CGT_OK;
}

/* Arrays that need it are copied, too, where a commit has not done so yet. */
typedef enum copies { COPIES_MISSING, COPIES_MADE } copies;

/* max_half_area: of clusters that are not large. */
static cgt_result compute_bounds(cgt_scene *scene, copies made, bool clusters, float max_half_area,
                                 cgt_primitive_bounds *s)
{
    const uint32_t chunks = (uint32_t)(((uint64_t)scene->committed_scene.prims.count + CHUNK - 1) / CHUNK);
    bounds_job job;
    cgt_result result = reserve(scene, chunks, clusters, &job);
    if (result != CGT_OK)
        return result;
    job.max_half_area = max_half_area;
    job.geometry = made == COPIES_MADE ? NULL : scene->buffer[CGT_BUFFER_GEOMETRY].data;
    result = cgt_run_scratch_tasks(scene->context, compute_chunk_bounds, &job, chunks);
    if (result != CGT_OK)
        return result;
    bounds_clear(s);
    for (uint32_t i = 0; i < chunks; i++)
        bounds_merge(s, &job.chunk_bounds[i]);
    if (s->bad_index != CGT_INVALID_ID)
        return bad_index(scene, s->bad_index);
    if (job.request.classes)
        cgt_size_classes_merge(job.request.classes, chunks);
    s->diameter[0] = s->valid;
    for (int a = 0; a < 3; a++) {
        /* the sums were rounded to nearest, which one step outwards covers */
        s->min[a] = s->valid ? nextafterf(s->min[a], -INFINITY) : 0;
        s->max[a] = s->valid ? nextafterf(s->max[a], INFINITY) : 0;
        s->magnitude = fmaxf(s->magnitude, fmaxf(fabsf(s->min[a]), fabsf(s->max[a])));
    }
    return CGT_OK;
}

cgt_result cgt_compute_bounds(cgt_scene *scene, cgt_primitive_bounds *s)
{
    const cgt_structure structure = scene->committed_scene.structure;
    const bool loose = structure == CGT_STRUCTURE_LOOSE_GRID && !scene->options.research->resolution[0];
    const bool tree = structure == CGT_STRUCTURE_BVH;
    const cgt_primitives *prims = &scene->committed_scene.prims;
    float max_half_area = INFINITY;
    cgt_copy_triangles(scene);
    cgt_cluster_use use = loose || tree ? cgt_choose_clusters(prims, &max_half_area) : CGT_CLUSTERS_NONE;
    bool clusters = use == CGT_CLUSTERS_ALL || (use == CGT_CLUSTERS_GRID && loose);
    cgt_result result = compute_bounds(scene, COPIES_MISSING, clusters, max_half_area, s);
    if (result == CGT_OK && clusters && cgt_clusters_are_loose(s->large_clusters, cgt_clusters(prims->count))) {
        clusters = false;
        use = CGT_CLUSTERS_NONE;
        result = compute_bounds(scene, COPIES_MADE, false, INFINITY, s);
    }
    scene->committed_scene.cluster = clusters ? scene->buffer[CGT_BUFFER_CLUSTERS].data : NULL;
    scene->committed_scene.bvh_of_clusters = use == CGT_CLUSTERS_ALL;
    return result;
}

cgt_result cgt_compute_size_classes(cgt_scene *scene)
{
    cgt_primitive_bounds s;
    return compute_bounds(scene, COPIES_MADE, false, INFINITY, &s);
}
