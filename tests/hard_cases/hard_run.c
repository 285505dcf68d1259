/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Traces hard cases and judges the hits by the oracle. */
#include "hard_cases/hard_run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static cgt_result add_geometry(cgt_scene *scene, const hard_geometry *g)
{
    if (g->triangles) {
        const cgt_triangles triangles = {.count = g->triangles,
                                         .indices = cgt_uint32s(g->index[0], 0),
                                         .vertex_count = g->vertices,
                                         .vertices = cgt_floats(g->vertex[0], 0)};
        return cgt_scene_set_triangles(scene, NULL, &triangles);
    }
    cgt_spheres spheres = {.count = g->spheres};
    if (g->spheres) {
        spheres.centers = cgt_floats(g->sphere[0], 0);
        spheres.centers.stride = sizeof *g->sphere;
        spheres.radii = cgt_floats(&g->sphere[0][3], 0);
        spheres.radii.stride = sizeof *g->sphere;
    }
    return cgt_scene_set_spheres(scene, NULL, &spheres);
}

cgt_result hard_commit(cgt_context *context, const hard_scene *s, const uint32_t resolution[3], cgt_scene **scene)
{
    cgt_research_scene_options research = {0};
    const cgt_scene_options options = {.structure = CGT_STRUCTURE_QUEUE_GRID, .research = &research};
    memcpy(research.resolution, resolution ? resolution : s->resolution, sizeof research.resolution);
    return hard_commit_with(context, s, &options, scene);
}

cgt_result hard_commit_with(cgt_context *context, const hard_scene *s, const cgt_scene_options *options,
                            cgt_scene **scene)
{
    *scene = NULL;
    cgt_result result = cgt_scene_create(context, options, scene);
    for (uint32_t g = 0; result == CGT_OK && g < s->geometries; g++)
        result = add_geometry(*scene, &s->geometry[g]);
    if (result == CGT_OK)
        result = cgt_scene_commit(*scene);
    if (result != CGT_OK) {
        cgt_scene_release(*scene);
        *scene = NULL;
    }
    return result;
}

cgt_result hard_follow(cgt_context *context, const hard_case *c, hard_scene *s)
{
    cgt_scene *scene;
    if (!c->follow || !s->rays)
        return CGT_OK;
    full_hit *hit = calloc(s->rays, sizeof *hit);
    hard_found *found = calloc(s->rays, sizeof *found);
    cgt_result result = hit && found ? hard_commit(context, s, NULL, &scene) : CGT_ERROR_OUT_OF_MEMORY;
    if (result == CGT_OK) {
        result = trace_array(scene, s->ray, s->rays, hit, NULL);
        cgt_scene_release(scene);
    }
    for (uint32_t i = 0; result == CGT_OK && i < s->rays; i++) {
        found[i].t = hit[i].geometry == CGT_INVALID_ID ? INFINITY : hit[i].t;
        memcpy(found[i].normal, hit[i].normal, sizeof found[i].normal);
    }
    if (result == CGT_OK)
        hard_case_follow(c, s, found);
    free(found);
    free(hit);
    return result;
}

/* ---- truth ---- */

bool hard_truth_make(const hard_scene *s, hard_truth *truth)
{
    *truth = (hard_truth){.hit = calloc((size_t)s->rays + 1, sizeof *truth->hit)};
    if (!truth->hit)
        return false;
    for (uint32_t g = 0; g < s->geometries; g++) {
        const hard_geometry *of = &s->geometry[g];
        oracle_scene_add_spheres(&truth->scene, g, (const float(*)[4])of->sphere, of->spheres);
        oracle_scene_add_triangles(&truth->scene, g, (const float(*)[3])of->vertex, of->vertices,
                                   (const uint32_t(*)[3])of->index, of->triangles);
    }
    for (uint32_t i = 0; i < s->rays; i++)
        truth->hit[i] = oracle_trace(&truth->scene, &s->ray[i]);
    return true;
}

void hard_truth_free(hard_truth *truth)
{
    oracle_scene_free(&truth->scene);
    free(truth->hit);
    truth->hit = NULL;
}

oracle_verdict hard_judge(const hard_scene *s, const hard_truth *truth, uint32_t i, const full_hit *answer,
                          oracle_hit *exact)
{
    const oracle_primitive *primitive =
        truth->hit[i].index == ORACLE_NONE ? NULL : &truth->scene.primitive[truth->hit[i].index];
    *exact = truth->hit[i];
    if (primitive ? primitive->geometry == answer->geometry && primitive->primitive == answer->primitive
                  : answer->geometry == ORACLE_NONE)
        return ORACLE_RIGHT;
    return oracle_judge(&truth->scene, &s->ray[i], answer->geometry, answer->primitive, exact);
}

hard_tally hard_judge_all(const hard_scene *s, const hard_truth *truth, const full_hit *answers)
{
    hard_tally tally = {.rays = s->rays};
    for (uint32_t i = 0; i < s->rays; i++) {
        oracle_hit exact;
        const oracle_verdict verdict = hard_judge(s, truth, i, &answers[i], &exact);
        tally.hits += exact.index != ORACLE_NONE;
        tally.missed += verdict == ORACLE_MISSED;
        tally.invented += verdict == ORACLE_INVENTED;
        tally.wrong += verdict == ORACLE_WRONG;
    }
    return tally;
}
