/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The commit: from the caller's arrays to a structure, from scratch.
 *   1 list the arrays   2 bounds and validity of every primitive (bound_primitives.c)   3 build the structure, or
 *   bands of magnitudes with a structure each (bands/bands_commit.c) where the bounds reach far out or far in
 * The second step also copies the arrays that cannot be read in place.
 *
 * Grid or tree. A loose grid is built in a hundredth of a kd-tree's time, and camera frames traverse it several times
 * as fast. Each class of sizes has a level of its own, so that a teapot in a stadium does not crowd one cell.
 * Incoherent rays share no cells: a BVH suits them, and it is built in a few times the grid's time. Where a scene is
 * said to be traced by a camera, arrays of rays get a BVH when they come (bvh_on_demand.h). Where nothing else
 * comes, frame after frame, the grid would be built for nothing: then the commit builds the BVH in its place. */
#include <math.h>
#include <stdio.h>

#include "builders/bands/bands_commit.h"
#include "builders/commit.h"
#include "builders/report.h"
#include "core/float_environment.h"

/* Sizes below 2^-50, by the bits of a float's exponent. */
#define TINY_SIZE_CLASS 77u

/* After so many frames for a tree alone the next is taken for one, too: two, so that a program whose frames are for a
 * camera and for rays by turns is never taken wrongly. Whether tiles serve a light again, only a grid tells: it is
 * tried once in so many of them. */
#define FRAMES_FOR_TREE 2u
#define FRAMES_UNTIL_GRID 32u

/* Reads a flag and clears it. Nobody sets it meanwhile: a scene is not traced while it is committed. (An exchange of a
 * byte needs libatomic on some processors.) */
static bool take_flag(atomic_bool *flag)
{
    const bool was_set = cgt_flag_is_set(flag);
    atomic_store_explicit(flag, false, memory_order_relaxed);
    return was_set;
}

/* Counts the frames for a tree alone, of which that since the last commit may be one: rays or points came for which a
 * tree was built, and nothing that a grid serves. */
static void learn_from_frame(cgt_scene *scene)
{
    cgt_frame_record *record = &scene->record;
    uint32_t *frames = &scene->frames_for_tree;
    if (scene->band_of) {
        *frames = scene->band_of->frames_for_tree;
        return;
    }
    if (scene->has_failed) /* nothing was traced since: what was learned for that commit holds for this one */
        return;
    const bool camera = take_flag(&record->camera), rays = take_flag(&record->rays),
               points = take_flag(&record->points), tiles = take_flag(&record->light_tiles);
    scene->expects_tree = take_flag(&record->light_gave_up);
    atomic_store_explicit(&record->light_excess, 0, memory_order_relaxed);
    if (!rays || camera || tiles)
        *frames = 0;
    else if (*frames < FRAMES_FOR_TREE || points)
        *frames = *frames < FRAMES_UNTIL_GRID ? *frames + 1 : FRAMES_FOR_TREE - 1;
}

/* Chooses the structure, on which the pass over the primitives depends. reason: gets AUTO's reason, except for grids,
 * whose plan has one of its own. */
static cgt_structure choose_structure(const cgt_scene *scene, const char **reason)
{
    const cgt_scene_options *options = &scene->options;
    *reason = options->structure == CGT_STRUCTURE_BVH   ? "BVH: requested"
              : options->structure == CGT_STRUCTURE_BIH ? "BIH: requested"
                                                        : "kd-tree: requested";
    if (options->structure != CGT_STRUCTURE_AUTO)
        return options->structure;
    if (options->research->resolution[0]) /* a resolution only makes sense for the queue grid */
        return CGT_STRUCTURE_QUEUE_GRID;
    const bool coherent = options->rays == CGT_RAY_KIND_COHERENT;
    if (coherent && scene->frames_for_tree < FRAMES_FOR_TREE)
        return CGT_STRUCTURE_LOOSE_GRID;
    *reason = !coherent ? "BVH: incoherent rays share no cells of a grid"
                        : "BVH: the last frames had nothing that a grid serves";
    return CGT_STRUCTURE_BVH;
}

/* Research's structures know no capsules. */
static cgt_result check_structure(const cgt_scene *scene)
{
    const uint32_t capsules = scene->committed_scene.prims.capsules;
    const cgt_structure structure = scene->committed_scene.structure;
    if (!capsules || structure == CGT_STRUCTURE_BVH || structure == CGT_STRUCTURE_LOOSE_GRID)
        return CGT_OK;
    return cgt_fail(scene->context, CGT_ERROR_UNSUPPORTED,
                    "commit: %u capsules, which the structure that was asked for cannot hold: AUTO and BVH can",
                    capsules);
}

/* As the caller gives it; cgt_reserve_copies replaces what cannot be read in place. */
static cgt_primitive_array describe_array(const cgt_geometry *g)
{
    const cgt_spheres *s = &g->spheres;
    const cgt_triangles *t = &g->triangles;
    const cgt_capsules *q = &g->capsules;
    if (g->kind == CGT_KIND_SPHERES)
        return (cgt_primitive_array){.kind = g->kind,
                                     .count = s->count,
                                     .mask = s->mask ? s->mask : UINT32_MAX,
                                     .point = s->centers.data,
                                     .point_stride = s->centers.stride,
                                     .radius = s->radii.data ? s->radii.data : (const void *)&s->radius,
                                     .radius_stride = s->radii.data ? s->radii.stride : 0};
    if (g->kind == CGT_KIND_CAPSULES)
        return (cgt_primitive_array){.kind = g->kind,
                                     .count = q->count,
                                     .mask = q->mask ? q->mask : UINT32_MAX,
                                     .points = q->vertex_count,
                                     .point = q->vertices.data,
                                     .point_stride = q->vertices.stride,
                                     .radius = q->radii.data ? q->radii.data : (const void *)&q->radius,
                                     .radius_stride = q->radii.data ? q->radii.stride : 0,
                                     .index = q->indices.data,
                                     .index_stride = q->indices.stride};
    return (cgt_primitive_array){.kind = g->kind,
                                 .count = t->count,
                                 .mask = t->mask ? t->mask : UINT32_MAX,
                                 .points = t->vertex_count,
                                 .point = t->vertices.data,
                                 .point_stride = t->vertices.stride,
                                 .index = t->indices.data,
                                 .index_stride = t->indices.stride};
}

static cgt_result list_arrays(cgt_scene *scene)
{
    const cgt_geometry *geometry = scene->buffer[CGT_BUFFER_GEOMETRY].data;
    const cgt_result result = cgt_buffer_reserve(&scene->context->memory, &scene->buffer[CGT_BUFFER_ARRAYS],
                                                 scene->geometries, sizeof(cgt_primitive_array));
    if (result != CGT_OK)
        return cgt_fail(scene->context, result, "commit: out of memory for %u geometries", scene->geometries);
    cgt_primitive_array *array = scene->buffer[CGT_BUFFER_ARRAYS].data;
    cgt_primitives prims = {.array = array};
    scene->statistics.geometries = 0;
    for (uint32_t id = 0; id < scene->geometries; id++) {
        if (!geometry[id].used)
            continue;
        scene->statistics.geometries++;
        cgt_primitive_array a = describe_array(&geometry[id]);
        if (!a.count)
            continue;
        a.first = prims.count;
        a.spheres_before = prims.spheres;
        a.geometry = id;
        array[prims.arrays++] = a;
        scene->committed_scene.has_masks |= a.mask != UINT32_MAX;
        prims.count += a.count;
        *(a.kind == CGT_KIND_SPHERES    ? &prims.spheres
          : a.kind == CGT_KIND_CAPSULES ? &prims.capsules
                                        : &prims.triangles) += a.count;
    }
    scene->committed_scene.prims = prims;
    scene->statistics.primitives = prims.count;
    scene->statistics.spheres = prims.spheres;
    scene->statistics.triangles = prims.triangles;
    scene->statistics.capsules = prims.capsules;
    return cgt_reserve_copies(scene);
}

/* Returns a power of two. Beyond 2^100 the filter's products leave the range of float; smaller scenes are decided in
 * double. */
static float choose_scale(float magnitude)
{
    int exponent = 0;
    if (magnitude > 0 && magnitude <= CGT_MAX_COORDINATE)
        frexpf(magnitude, &exponent);
    return ldexpf(1, exponent < -100 ? 100 : -exponent);
}

static void set_scene_bounds(cgt_committed_scene *committed_scene, const cgt_primitive_bounds *s)
{
    committed_scene->valid = s->valid;
    committed_scene->scale = choose_scale(s->magnitude);
    for (int a = 0; a < 3; a++) {
        committed_scene->low[a] = s->min[a];
        committed_scene->high[a] = s->max[a];
    }
}

static cgt_result build_structure(cgt_scene *scene, const cgt_primitive_bounds *s, const char *structure_reason)
{
    const cgt_committed_scene *committed_scene = &scene->committed_scene;
    char *reason = scene->statistics.reason;
    const size_t bytes = sizeof scene->statistics.reason;
    if (!s->valid) {
        snprintf(reason, bytes, "no primitives");
        return CGT_OK;
    }
    if (committed_scene->structure == CGT_STRUCTURE_LOOSE_GRID)
        return cgt_loose_grid_commit(scene);
    snprintf(reason, bytes, "%s", structure_reason);
    if (committed_scene->structure == CGT_STRUCTURE_BVH)
        return cgt_bvh_commit(scene);
    return cgt_papers_commit(scene, s);
}

/* Whether some primitives are so much smaller than the scene, and so near to the origin, that single precision has no
 * bounds for them at the scene's scale. Told by classes of sizes, which loose grids and BVHs have. */
static bool has_tiny_parts(const cgt_scene *scene)
{
    const cgt_size_classes *classes = scene->buffer[CGT_BUFFER_SIZE_CLASSES].data;
    const cgt_structure structure = scene->committed_scene.structure;
    if (structure != CGT_STRUCTURE_LOOSE_GRID && structure != CGT_STRUCTURE_BVH)
        return false;
    for (uint32_t k = 1; k < TINY_SIZE_CLASS; k++) {
        float most = 0;
        for (int a = 0; a < 3 && cgt_size_class_is_used(classes, k); a++)
            most = fmaxf(most, fmaxf(-classes->of[k].low[a], classes->of[k].high[a]));
        if (cgt_size_class_is_used(classes, k) && most < CGT_COMFORTABLE_MIN)
            return true;
    }
    return false;
}

static cgt_result build_scene(cgt_scene *scene)
{
    cgt_primitive_bounds bounds = {0};
    const char *reason;
    const double start = cgt_now_ms();
    cgt_result result = list_arrays(scene);
    scene->committed_scene.structure = choose_structure(scene, &reason);
    if (result == CGT_OK)
        result = check_structure(scene);
    if (result == CGT_OK)
        result = cgt_compute_bounds(scene, &bounds);
    if (result != CGT_OK)
        return result;
    const double bounded = cgt_now_ms();
    set_scene_bounds(&scene->committed_scene, &bounds);
    if (bounds.valid && !scene->is_band && (cgt_bands_needed(bounds.magnitude) || has_tiny_parts(scene))) {
        scene->committed_scene.brute_force = true; /* for what is asked past the bands */
        result = cgt_bands_commit(scene);
    } else
        result = build_structure(scene, &bounds, reason);
    if (result != CGT_OK)
        return result;
    cgt_report_scene(scene, &bounds);
    const double end = cgt_now_ms();
    scene->statistics.bounds_ms = bounded - start;
    scene->statistics.build_ms = end - bounded;
    scene->statistics.commit_ms = end - start;
    return CGT_OK;
}

cgt_result cgt_scene_commit(cgt_scene *scene)
{
    cgt_float_environment callers;
    if (!scene)
        return CGT_ERROR_INVALID_ARGUMENT;
    scene->is_committed = scene->in_bands = false;
    scene->statistics = (cgt_scene_statistics){0};
    scene->research_statistics = (cgt_research_scene_statistics){0};
    scene->committed_scene = (cgt_committed_scene){0};
    atomic_store_explicit(&scene->bvh_state, CGT_BVH_STATE_NONE, memory_order_relaxed);
    atomic_store_explicit(&scene->bvh_rays, 0, memory_order_relaxed);
    learn_from_frame(scene);
    cgt_float_environment_enter(&callers);
    const cgt_result result = build_scene(scene);
    cgt_float_environment_leave(&callers);
    cgt_publish_statistics(scene);
    scene->has_failed = result != CGT_OK;
    if (result != CGT_OK)
        return result;
    scene->is_committed = true;
    cgt_log_commit(scene);
    return CGT_OK;
}
