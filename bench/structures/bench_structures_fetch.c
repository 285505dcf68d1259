/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench structures --fetch: which layout of a kd-tree's nodes makes the fewest transfers (thesis, chapter 7,
 * figure 7.4). The same rays walk the same tree in each layout, one at a time in the order of their arrays, and all
 * memories of bench_structures_cache.h see the nodes that they read. The first frame of the file is taken. A ray walks
 * to its nearest hit; where any hit would do, a traversal ends there at the latest. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "structures/bench_structures.h"
#include "structures/bench_structures_cache.h"
#include "structures/bench_structures_walk.h"
#include "scene/scene.h"

typedef struct layout {
    cgt_kd_layout layout;
    uint32_t break_level;
} layout;

/* One kind of ray, and where each ray ends. */
typedef struct walkers {
    const char *name;
    const structures_rays *rays;
    structures_hits hits;
} walkers;

enum { PRIMARY, SHADOW, AO, RANDOM, KINDS };

void structures_fetch_begin(accuracy_report *report)
{
    static const char *const columns[] = {
        "config",      "scene",        "primitives",    "kd_nodes",       "rays",          "ray_count", "memory",
        "block_bytes", "memory_bytes", "nodes_per_ray", "misses_per_ray", "bytes_per_ray", NULL};
    accuracy_report_table(report, "fetch", columns);
}

/* ---- Rays ---------------------------------------------------------------------------------------------------- */

/* The rays of all pixels, in blocks of 4x4. */
static cgt_result make_primary(const structures_job *job, structures_rays *rays)
{
    enum { EDGE = 4 };
    const bench_camera_axes *axes = &job->axes;
    rays->count = 0;
    const cgt_result result = structures_rays_reserve(rays, (uint64_t)axes->width * axes->height);
    if (result != CGT_OK)
        return result;
    for (uint32_t y0 = 0; y0 < axes->height; y0 += EDGE)
        for (uint32_t x0 = 0; x0 < axes->width; x0 += EDGE)
            for (uint32_t i = 0; i < EDGE * EDGE; i++) {
                const uint32_t x = x0 + i % EDGE, y = y0 + i / EDGE;
                if (x >= axes->width || y >= axes->height)
                    continue;
                const float px = ((float)x + 0.5f) * (2.0f / (float)axes->width) - 1.0f;
                const float py = 1.0f - ((float)y + 0.5f) * (2.0f / (float)axes->height);
                for (int a = 0; a < 3; a++) {
                    rays->org[a][rays->count] = axes->eye[a];
                    rays->dir[a][rays->count] = axes->fwd[a] + px * axes->right[a] + py * axes->up[a];
                }
                rays->count++;
            }
    return CGT_OK;
}

/* Where the rays end: at their nearest hits. */
static cgt_result find_ends(const structures_job *job, walkers *w)
{
    const cgt_rays array = structures_rays_array(w->rays);
    if (structures_hits_reset(&w->hits, array.count))
        return CGT_ERROR_OUT_OF_MEMORY;
    const cgt_hits into = {.t = w->hits.t};
    cgt_result result = CGT_OK;
    if (array.count)
        result = cgt_trace_rays(job->scene.scene, &array, &into, NULL);
    if (result == CGT_OK && w->rays->bounded) /* a shadow ray that meets nothing ends at the light */
        for (uint64_t i = 0; i < array.count; i++)
            w->hits.t[i] = fminf(w->hits.t[i], w->rays->t_max[i]);
    return result;
}

/* All rays of the first frame, from the scene as it is committed. */
static cgt_result make_walkers(structures_job *job, const structures_group *group, structures_rays *primary,
                               walkers kinds[KINDS])
{
    const structures_row row = {.group = 0};
    double ms[STRUCTURES_COLUMNS];
    kinds[PRIMARY] = (walkers){.name = "primary", .rays = primary};
    kinds[SHADOW] = (walkers){.name = "shadow", .rays = &job->shadow};
    kinds[AO] = (walkers){.name = "ao", .rays = &job->ao};
    kinds[RANDOM] = (walkers){.name = "random", .rays = &job->random};
    cgt_result result = structures_trace_primary(job, &row, &job->expected, NULL, ms);
    if (result == CGT_OK)
        result = structures_make_rays(job, group);
    if (result == CGT_OK)
        result = make_primary(job, primary);
    for (int k = 0; k < KINDS && result == CGT_OK; k++)
        result = find_ends(job, &kinds[k]);
    return result;
}

/* ---- One layout ---------------------------------------------------------------------------------------------- */

static void read_node(void *user, uint32_t node) { cache_set_read(user, node); }

static void walk_all(const cgt_kd_tree *tree, const walkers *w, cache_set *set)
{
    for (uint64_t i = 0; i < w->rays->count; i++) {
        const float org[3] = {w->rays->org[0][i], w->rays->org[1][i], w->rays->org[2][i]};
        const float dir[3] = {w->rays->dir[0][i], w->rays->dir[1][i], w->rays->dir[2][i]};
        cache_set_ray(set);
        structures_walk(tree, org, dir, (double)w->hits.t[i], read_node, set);
    }
}

static void report_counts(const structures_job *job, const char *config, const walkers *w, const cache_set *set,
                          accuracy_report *report)
{
    const cgt_scene_statistics *built = &job->groups[0].built;
    const double rays = (double)w->rays->count;
    const cache_count *count;
    for (uint32_t i = 0; (count = cache_set_count(set, i)) != NULL; i++) {
        accuracy_report_text(report, config);
        accuracy_report_text(report, job->scene_name);
        accuracy_report_count(report, built->primitives);
        accuracy_report_count(report, job->groups[0].research.kd_nodes);
        accuracy_report_text(report, w->name);
        accuracy_report_count(report, w->rays->count);
        accuracy_report_text(report, cache_kind_name(count->kind));
        accuracy_report_count(report, count->block_bytes);
        accuracy_report_count(report, count->bytes);
        accuracy_report_real(report, (double)cache_set_reads(set) / rays);
        accuracy_report_real(report, (double)count->misses / rays);
        accuracy_report_real(report, (double)count->bytes_transfer / rays);
    }
}

static int fetch_kinds(const structures_job *job, const char *config, const walkers kinds[KINDS],
                       accuracy_report *report)
{
    const cgt_kd_tree *tree = &job->scene.scene->committed_scene.kd;
    for (int k = 0; k < KINDS; k++) {
        if (!kinds[k].rays->count)
            continue;
        cache_set *set = cache_set_create(tree->nodes);
        if (!set) {
            program_error("%s: out of memory", job->path);
            return PROGRAM_FAILED;
        }
        walk_all(tree, &kinds[k], set);
        report_counts(job, config, &kinds[k], set, report);
        cache_set_release(set);
    }
    return PROGRAM_OK;
}

/* ---- One file ------------------------------------------------------------------------------------------------ */

static int has_tree(const structures_job *job, cgt_result result)
{
    const structures_group *group = &job->groups[0];
    if (result != CGT_OK) {
        bench_scene_failed(job->context, job->path, result);
        return 0;
    }
    if (!group->left_out && group->built.structure != CGT_STRUCTURE_KD)
        program_error("%s: no kd-tree over this scene: %s", job->path, group->built.reason);
    return !group->left_out && group->built.structure == CGT_STRUCTURE_KD;
}

/* All layouts of a file, the rays being made from the first. */
static int fetch_layouts(structures_job *job, structures_rays *primary, walkers kinds[KINDS], accuracy_report *report)
{
    static const layout layouts[] = {{CGT_KD_LAYOUT_DEPTH_FIRST, 0}, {CGT_KD_LAYOUT_BREADTH_FIRST, 0},
                                     {CGT_KD_LAYOUT_MIXED, 8},       {CGT_KD_LAYOUT_MIXED, 4},
                                     {CGT_KD_LAYOUT_MIXED, 12},      {CGT_KD_LAYOUT_MIXED, 16}};
    const size_t count = job->settings->all ? sizeof layouts / sizeof layouts[0] : 3;
    structures_group *group = &job->groups[0];
    const uint32_t elements = bench_input_move(&job->input, 0);
    int code = PROGRAM_OK;
    for (size_t i = 0; i < count && code == PROGRAM_OK; i++) {
        char name[BENCH_NAME_SIZE];
        double ms;
        group->kd.layout = layouts[i].layout;
        group->kd.break_level = layouts[i].break_level;
        if (!has_tree(job, structures_commit(job, group, elements, &ms)))
            return PROGRAM_FAILED;
        const cgt_result result = i ? CGT_OK : make_walkers(job, group, primary, kinds);
        if (result != CGT_OK)
            return bench_scene_failed(job->context, job->path, result);
        structures_row_name(job, &(structures_row){.group = 0}, name);
        code = fetch_kinds(job, name, kinds, report);
    }
    return code;
}

int structures_fetch_rows(structures_job *job, accuracy_report *report)
{
    const cgt_kd_builder builder = job->settings->structure.kd.builder;
    structures_rays primary = {.count = 0};
    walkers kinds[KINDS] = {{.name = NULL}};
    job->group_count = 1;
    job->groups[0] = (structures_group){.structure = CGT_STRUCTURE_KD};
    job->groups[0].kd.builder = builder == CGT_KD_BUILDER_AUTO ? CGT_KD_BUILDER_BINNED : builder;
    const int code = fetch_layouts(job, &primary, kinds, report);
    for (int k = 0; k < KINDS; k++)
        structures_hits_release(&kinds[k].hits);
    structures_rays_release(&primary);
    return code;
}
