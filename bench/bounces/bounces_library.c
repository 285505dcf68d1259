/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The library's structures, each in a scene of its own, so that they can be measured by turns. */
#include <stdlib.h>
#include <string.h>

#include "bounces/bench_bounces.h"
#include "common/bench_timing.h"

/* bvh is what AUTO chooses for such rays. */
const char *const bounces_structure_names[BOUNCES_STRUCTURES] = {"bvh", "loose-grid", "kd", "bih"};

static cgt_result commit_often(bounces_structure *s, uint32_t count, uint32_t rounds)
{
    double *ms = calloc(rounds + 1, sizeof *ms);
    cgt_result result = ms ? CGT_OK : CGT_ERROR_OUT_OF_MEMORY;
    for (uint32_t k = 0; k <= rounds && result == CGT_OK; k++) {
        const double begin = bench_cpu_ms();
        result = bench_scene_commit(&s->scene, count);
        ms[k] = bench_cpu_ms() - begin;
    }
    if (result == CGT_OK)
        s->build_ms = bench_median(ms + 1, rounds);
    free(ms);
    return result;
}

cgt_result bounces_structure_build(bounces_structure *s, int which, cgt_context *context, const bench_input *input,
                                   uint32_t count, uint32_t rounds)
{
    static const uint32_t own[3] = {0, 0, 0};
    static const bench_kd_choice kd = {0};
    cgt_structure structure;
    memset(s, 0, sizeof *s);
    if (bench_structure_find(bounces_structure_names[which], &structure))
        return CGT_OK;
    cgt_result result = bench_scene_create(&s->scene, context, input->moving, own);
    if (result == CGT_OK && input->index)
        bench_scene_set_triangles(&s->scene, input->index, input->triangles);
    if (result == CGT_OK)
        result = bench_scene_structure(&s->scene, structure, CGT_RAY_KIND_INCOHERENT, &kd, own);
    if (result == CGT_OK)
        result = commit_often(s, count, rounds);
    s->is_built = result == CGT_OK;
    return result == CGT_ERROR_UNSUPPORTED ? CGT_OK : result;
}

cgt_result bounces_structure_trace(const bounces_structure *s, const bounces_rays *rays, uint64_t call, double *ms)
{
    cgt_result result = CGT_OK;
    const double begin = bench_cpu_ms();
    for (uint64_t i = 0; i < rays->count && result == CGT_OK; i += call) {
        const cgt_rays part = {.count = rays->count - i < call ? rays->count - i : call,
                               .org = {rays->org[0] + i, rays->org[1] + i, rays->org[2] + i},
                               .dir = {rays->dir[0] + i, rays->dir[1] + i, rays->dir[2] + i},
                               .t_min = rays->t_min + i,
                               .t_max = rays->t_max + i,
                               .skip_primitive = rays->skip + i};
        const cgt_hits hits = {.t = rays->t + i, .primitive = rays->primitive + i};
        result = cgt_trace_rays(s->scene.scene, &part, &hits, NULL);
    }
    *ms = bench_cpu_ms() - begin;
    return result;
}
