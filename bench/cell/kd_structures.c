/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * kd-trees beside bounding interval hierarchies on the SPEs: builds, memory, what rays visit and fetch, cycles; and
 * frames that are built anew. */
#include "cell/kd_run.h"

#define STRUCTURES 2

static const cgt_structure structures[STRUCTURES] = {CGT_STRUCTURE_KD, CGT_STRUCTURE_BIH};
static const char *const names[STRUCTURES] = {"kd", "bih"};

static void build_cells(bench_table *table, const char *name, const kd_bench_scene *scene, const double build[2])
{
    const cgt_kd_scene_part *const p = &scene->image.part[0];
    bench_table_text(table, "structure", name);
    bench_table_real(table, "build_ms", build[0]);
    bench_table_real(table, "image_ms", build[1]);
    bench_table_count(table, "node_kb", p->node_bytes / 1024);
    bench_table_count(table, "reference_kb", p->reference_bytes / 1024);
    bench_table_count(table, "scene_nodes", p->image.nodes);
}

/* ---- what rays cost ---- */

static void ray_row(kd_run *k, const kd_bench_scene *scene)
{
    const cgt_kd_report *const r = &k->result.spe[0].report;
    const cgt_kd_cache_size block = scene->image.bih ? CGT_KD_BIH_BLOCKS : CGT_KD_NODE_BLOCKS;
    const uint32_t node_bytes = scene->image.bih ? sizeof(cgt_bih_node) : sizeof(cgt_kd_node);
    const double pixels = (double)k->width * k->height;
    const kd_run_sums sum = kd_run_add(k, 1);
    bench_table_count(k->table, "nodes", r->nodes);
    bench_table_count(k->table, "leaves", r->leaves);
    bench_table_count(k->table, "tests", r->tests);
    bench_table_real(k->table, "node_bytes_pixel", r->node_fetches * (double)(node_bytes << block.log2) / pixels);
    bench_table_real(k->table, "reference_bytes_pixel",
                     r->reference_fetches * (double)(4u << CGT_KD_REFERENCE_BLOCKS.log2) / pixels);
    bench_table_real(k->table, "triangle_bytes_pixel",
                     r->triangle_fetches * (double)sizeof(cgt_leaf_triangle) / pixels);
    bench_table_count(k->table, "doubts", k->result.doubts);
    bench_table_real(k->table, "waits_percent", sum.waits);
    bench_table_real(k->table, "cycles_pixel", sum.cycles);
    bench_table_end_row(k->table);
}

bool kd_section_structures(kd_run *k)
{
    bool done = true;
    bench_table_section(k->table, "structures");
    for (int i = 0; i < STRUCTURES && done; i++) {
        kd_bench_scene scene;
        double build[2];
        if (!kd_bench_build(structures[i], &build[0], &build[1]) ||
            !kd_bench_scene_make(&scene, structures[i], CGT_KD_LAYOUT_DEPTH_FIRST, 1))
            return false;
        for (int rays = 0; rays < KD_BENCH_RAYS && done; rays++) {
            cgt_kd_frame_options o = {.batch = 0};
            kd_bench_add_rays(&o, (kd_bench_rays)rays);
            done = kd_run_frame(k, &scene, &o, NULL);
            if (!done)
                break;
            bench_table_text(k->table, "rays", kd_bench_rays_names[rays]);
            build_cells(k->table, names[i], &scene, build);
            ray_row(k, &scene);
        }
        kd_bench_scene_release(&scene);
    }
    return done;
}

/* ---- frames that are built anew ---- */

#define CYCLES_PER_MS 3.2e6

bool kd_section_rebuilt(kd_run *k)
{
    bool done = true;
    k->width = 640;
    k->height = 360;
    bench_table_section(k->table, "rebuilt");
    for (int i = 0; i < STRUCTURES && done; i++) {
        kd_bench_scene scene;
        double build[2];
        if (!kd_bench_build(structures[i], &build[0], &build[1]) ||
            !kd_bench_scene_make(&scene, structures[i], CGT_KD_LAYOUT_DEPTH_FIRST, 1))
            return false;
        for (int rays = 0; rays < KD_BENCH_RAYS && done; rays++) {
            cgt_kd_frame_options o = {.cell = {.spes = 6, .assignment = CGT_ASSIGN_DYNAMIC}};
            if (rays == KD_BENCH_AMBIENT)
                continue; /* four rays a pixel take minutes to simulate */
            kd_bench_add_rays(&o, (kd_bench_rays)rays);
            done = kd_run_frame(k, &scene, &o, NULL);
            if (!done)
                break;
            bench_table_text(k->table, "rays", kd_bench_rays_names[rays]);
            build_cells(k->table, names[i], &scene, build);
            bench_table_count(k->table, "frame_cycles", k->result.cycles);
            bench_table_real(k->table, "trace_ms", (double)k->result.cycles / CYCLES_PER_MS);
            bench_table_end_row(k->table);
        }
        kd_bench_scene_release(&scene);
    }
    return done;
}
