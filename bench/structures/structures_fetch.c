/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench structures --fetch: which layout of a kd-tree's nodes makes the fewest transfers (thesis, chapter 7, figure
 * 7.4). The same rays walk the same tree in each layout, one at a time in the order of their arrays, and all memories
 * of structures_cache.h see the nodes that they read. A ray walks to its closest hit; an any-hit traversal ends there
 * at the latest. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"
#include "structures/bench_structures.h"
#include "structures/structures_cache.h"
#include "structures/structures_walk.h"

/* One kind of rays, and where each ray ends. */
typedef struct walkers {
    const char *name;
    structures_kind kind;
    bench_ray_array rays;
    float *t_end;
} walkers;

enum { KINDS = 4 };

/* ---- Rays ---------------------------------------------------------------------------------------------------- */

/* Rays end at their closest hits; a shadow ray without a hit ends at the light. */
static cgt_result find_ends(const structures_job *job, walkers *w)
{
    const cgt_rays array = bench_ray_array_view(&w->rays);
    w->t_end = malloc(((size_t)array.count + 1) * sizeof *w->t_end);
    if (!w->t_end)
        return CGT_ERROR_OUT_OF_MEMORY;
    const cgt_hits into = {.t = w->t_end};
    const cgt_result result = array.count ? cgt_trace_rays(job->groups[0].scene.scene, &array, &into, NULL) : CGT_OK;
    for (uint64_t i = 0; result == CGT_OK && w->rays.bounded && i < array.count; i++)
        w->t_end[i] = fminf(w->t_end[i], w->rays.t_max[i]);
    return result;
}

/* All rays of the frame, from the scene as it is committed. */
static cgt_result make_walkers(structures_job *job, walkers kinds[KINDS])
{
    cgt_frame frame;
    bench_planes_frame(&job->planes, &frame);
    cgt_result result = cgt_trace_camera(job->groups[0].scene.scene, &job->settings->shared.camera, &frame, NULL);
    for (int k = 0; k < KINDS && result == CGT_OK; k++) {
        result = structures_make_set(job, kinds[k].kind);
        kinds[k].rays = job->set.made; /* moves it */
        memset(&job->set.made, 0, sizeof job->set.made);
        if (result == CGT_OK)
            result = find_ends(job, &kinds[k]);
    }
    return result;
}

/* ---- One layout ---------------------------------------------------------------------------------------------- */

static void read_node(void *user, uint32_t node) { cache_set_read(user, node); }

static void walk_all(const cgt_kd_tree *tree, const walkers *w, cache_set *set)
{
    for (uint64_t i = 0; i < w->rays.count; i++) {
        const float org[3] = {w->rays.org[0][i], w->rays.org[1][i], w->rays.org[2][i]};
        const float dir[3] = {w->rays.dir[0][i], w->rays.dir[1][i], w->rays.dir[2][i]};
        cache_set_ray(set);
        structures_walk(tree, org, dir, (double)w->t_end[i], read_node, set);
    }
}

static void write_counts(const structures_job *job, const char *config, const walkers *w, const cache_set *set,
                         bench_table *table)
{
    const bench_build *build = &job->groups[0].build;
    const double rays = (double)w->rays.count;
    const cache_count *count;
    for (uint32_t i = 0; (count = cache_set_count(set, i)) != NULL; i++) {
        bench_table_text(table, "config", config);
        bench_table_text(table, "scene", job->scene_name);
        bench_table_count(table, "primitives", build->built.primitives);
        bench_table_count(table, "kd_nodes", build->research.kd_nodes);
        bench_table_text(table, "kind", w->name);
        bench_table_count(table, "rays", w->rays.count);
        bench_table_text(table, "memory", cache_kind_name(count->kind));
        bench_table_count(table, "block_bytes", count->block_bytes);
        bench_table_count(table, "memory_bytes", count->bytes);
        bench_table_real(table, "nodes_per_ray", (double)cache_set_reads(set) / rays);
        bench_table_real(table, "misses_per_ray", (double)count->misses / rays);
        bench_table_real(table, "bytes_per_ray", (double)count->bytes_transfer / rays);
        bench_table_end_row(table);
    }
}

static int fetch_kinds(const structures_job *job, const char *config, const walkers kinds[KINDS], bench_table *table)
{
    const cgt_kd_tree *tree = &job->groups[0].scene.scene->committed_scene.papers->kd;
    for (int k = 0; k < KINDS; k++) {
        if (!kinds[k].rays.count)
            continue;
        cache_set *set = cache_set_create(tree->nodes);
        if (!set) {
            program_error("%s: out of memory", job->path);
            return PROGRAM_FAILED;
        }
        walk_all(tree, &kinds[k], set);
        write_counts(job, config, &kinds[k], set, table);
        cache_set_release(set);
    }
    return PROGRAM_OK;
}

/* ---- One file ------------------------------------------------------------------------------------------------ */

/* Builds the first group's kd-tree in a layout. */
static int build_tree(structures_job *job, cgt_kd_layout layout, uint32_t break_level)
{
    structures_group *group = &job->groups[0];
    bench_build *build = &group->build;
    double ms;
    build->structure = CGT_STRUCTURE_KD;
    build->kd.layout = layout;
    build->kd.break_level = break_level;
    const cgt_result result =
        bench_scene_build(&group->scene, build, job->count, job->settings->shared.resolution, job->path, &ms);
    if (result != CGT_OK)
        return bench_scene_failed(job->context, job->path, result);
    if (!build->left_out && build->built.structure != CGT_STRUCTURE_KD)
        program_error("%s: no kd-tree over this scene: %s", job->path, build->built.reason);
    return !build->left_out && build->built.structure == CGT_STRUCTURE_KD ? PROGRAM_OK : PROGRAM_FAILED;
}

/* All layouts of a file's tree, the rays being made from the first. */
static int fetch_layouts(structures_job *job, walkers kinds[KINDS], bench_table *table)
{
    static const struct {
        cgt_kd_layout layout;
        uint32_t break_level;
    } layouts[] = {{CGT_KD_LAYOUT_DEPTH_FIRST, 0}, {CGT_KD_LAYOUT_BREADTH_FIRST, 0}, {CGT_KD_LAYOUT_MIXED, 8},
                   {CGT_KD_LAYOUT_MIXED, 4},       {CGT_KD_LAYOUT_MIXED, 12},        {CGT_KD_LAYOUT_MIXED, 16}};
    const size_t count = job->settings->layouts ? sizeof layouts / sizeof layouts[0] : 3;
    structures_row *row = &job->rows[0];
    bench_table_section(table, "fetch");
    for (size_t i = 0; i < count; i++) {
        if (build_tree(job, layouts[i].layout, layouts[i].break_level) != PROGRAM_OK)
            return PROGRAM_FAILED;
        const cgt_result result = i ? CGT_OK : make_walkers(job, kinds);
        if (result != CGT_OK)
            return bench_scene_failed(job->context, job->path, result);
        row->choice.kd = job->groups[0].build.kd;
        structures_name_row(row);
        if (fetch_kinds(job, row->config, kinds, table) != PROGRAM_OK)
            return PROGRAM_FAILED;
    }
    return PROGRAM_OK;
}

int structures_fetch(structures_job *job, bench_table *table)
{
    walkers kinds[KINDS] = {{.name = "camera", .kind = STRUCTURES_CAMERA},
                            {.name = "shadow", .kind = STRUCTURES_SHADOW},
                            {.name = "ao", .kind = STRUCTURES_AO},
                            {.name = "random", .kind = STRUCTURES_RANDOM}};
    const int code = fetch_layouts(job, kinds, table);
    for (int k = 0; k < KINDS; k++) {
        bench_ray_array_release(&kinds[k].rays);
        free(kinds[k].t_end);
    }
    return code;
}
