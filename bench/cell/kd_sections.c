/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What each choice of the kd program costs: a section of cgt-bench cell --kd for each. */
#include "cell/kd_run.h"

#include "common/program.h"

static const char *const assignments[CGT_ASSIGNMENTS] = {"interleaved", "static", "dynamic", "hybrid"};
static const char *const layouts[] = {"", "depth first", "breadth first", "mixed"};

static void traffic_cells(bench_table *table, const kd_run_sums *sum)
{
    bench_table_real(table, "nodes_pixel", sum->node_fetches);
    bench_table_real(table, "references_pixel", sum->reference_fetches);
    bench_table_real(table, "leaves_pixel", sum->leaf_fetches);
    bench_table_real(table, "triangles_pixel", sum->triangle_fetches);
    bench_table_real(table, "bytes_pixel", sum->bytes);
    bench_table_real(table, "waits_percent", sum->waits);
    bench_table_real(table, "cycles_pixel", sum->cycles);
    bench_table_end_row(table);
}

/* ---- layouts ---- */

/* Sizes are those of nodes of kd-trees; nodes of hierarchies are twice as large. */
static bool run_layout(kd_run *k, cgt_structure structure, cgt_kd_layout layout)
{
    static const cgt_kd_cache_size sizes[] = {{4, 5}, {16, 5}, {4, 7}, {16, 7}, {64, 5}, {16, 8}, {64, 6}};
    kd_bench_scene scene;
    if (!kd_bench_scene_make(&scene, structure, layout, 1))
        return false;
    const bool bih = structure == CGT_STRUCTURE_BIH;
    bool done = true;
    for (int rays = 0; rays < (bih ? KD_BENCH_RAYS : KD_BENCH_BOUNCED) && done; rays++)
        for (unsigned i = 0; i < sizeof sizes / sizeof sizes[0] && done; i++) {
            cgt_kd_frame_options o = {.nodes = {sizes[i].blocks, sizes[i].log2 - bih}};
            kd_bench_add_rays(&o, (kd_bench_rays)rays);
            done = kd_run_frame(k, &scene, &o, NULL);
            if (!done)
                break;
            const kd_run_sums sum = kd_run_add(k, 1);
            bench_table_text(k->table, "rays", kd_bench_rays_names[rays]);
            bench_table_text(k->table, "layout", layouts[layout]);
            bench_table_count(k->table, "cache_bytes", (uint64_t)sizes[i].blocks * 8 << sizes[i].log2);
            bench_table_count(k->table, "block_bytes", UINT64_C(8) << sizes[i].log2);
            bench_table_real(k->table, "node_bytes_pixel", sum.node_fetches * (8u << sizes[i].log2));
            traffic_cells(k->table, &sum);
        }
    kd_bench_scene_release(&scene);
    return done;
}

bool kd_section_layouts(kd_run *k)
{
    bench_table_section(k->table, "layouts");
    return run_layout(k, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST) &&
           run_layout(k, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_BREADTH_FIRST) &&
           run_layout(k, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_MIXED);
}

bool kd_section_hierarchies(kd_run *k)
{
    bench_table_section(k->table, "hierarchies");
    return run_layout(k, CGT_STRUCTURE_BIH, CGT_KD_LAYOUT_DEPTH_FIRST) &&
           run_layout(k, CGT_STRUCTURE_BIH, CGT_KD_LAYOUT_BREADTH_FIRST) &&
           run_layout(k, CGT_STRUCTURE_BIH, CGT_KD_LAYOUT_MIXED);
}

/* ---- triangles, fetched ahead or not; smallest caches ---- */

bool kd_section_triangles(kd_run *k)
{
    static const cgt_kd_cache_size slots[] = {{1024, 10}, {256, 9}, {64, 8}, {1, 0}};
    kd_bench_scene scene;
    if (!kd_bench_scene_make(&scene, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 1))
        return false;
    bool done = true;
    bench_table_section(k->table, "triangles");
    for (int rays = 0; rays < KD_BENCH_BOUNCED && done; rays++)
        for (unsigned i = 0; i < 2 * sizeof slots / sizeof slots[0] && done; i++) {
            cgt_kd_frame_options o = {.triangles = slots[i / 2], .prefetch = i & 1};
            kd_bench_add_rays(&o, (kd_bench_rays)rays);
            done = kd_run_frame(k, &scene, &o, NULL);
            if (!done)
                break;
            const kd_run_sums sum = kd_run_add(k, 1);
            bench_table_text(k->table, "rays", kd_bench_rays_names[rays]);
            bench_table_count(k->table, "places", slots[i / 2].blocks);
            bench_table_text(k->table, "ahead", i & 1 ? "yes" : "no");
            traffic_cells(k->table, &sum);
        }
    kd_bench_scene_release(&scene);
    return done;
}

/* ---- stack or ropes ---- */

bool kd_section_traversals(kd_run *k)
{
    bool done = true;
    bench_table_section(k->table, "traversals");
    for (int ropes = 0; ropes < 2 && done; ropes++) {
        kd_bench_scene scene;
        if (!kd_bench_scene_make(&scene, ropes ? CGT_STRUCTURE_KD_ROPES : CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST,
                                 1))
            return false;
        for (int rays = 0; rays < KD_BENCH_BOUNCED && done; rays++) {
            cgt_kd_frame_options o = {.batch = 0};
            kd_bench_add_rays(&o, (kd_bench_rays)rays);
            done = kd_run_frame(k, &scene, &o, NULL);
            if (!done)
                break;
            const kd_run_sums sum = kd_run_add(k, 1);
            const cgt_kd_report *const p = &k->result.spe[0].report.kd;
            bench_table_text(k->table, "rays", kd_bench_rays_names[rays]);
            bench_table_text(k->table, "traversal", ropes ? "ropes" : "stack");
            bench_table_count(k->table, "nodes", p->nodes);
            bench_table_count(k->table, "leaves", p->leaves);
            bench_table_count(k->table, "tests", p->tests);
            bench_table_count(k->table, "exact_steps", p->exact_steps);
            traffic_cells(k->table, &sum);
        }
        kd_bench_scene_release(&scene);
    }
    return done;
}

/* ---- envelopes ---- */

bool kd_section_envelopes(kd_run *k)
{
    static const uint32_t size[][2] = {{1, 1}, {2, 2}, {4, 4}, {8, 8}, {16, 4}, {64, 1}, {1, 64}};
    kd_bench_scene scene;
    if (!kd_bench_scene_make(&scene, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 1))
        return false;
    bool done = true;
    bench_table_section(k->table, "envelopes");
    for (unsigned i = 0; i < sizeof size / sizeof size[0] && done; i++) {
        const cgt_kd_frame_options o = {
            .cell = {.spes = 6}, .tiles_x = size[i][0], .tiles_y = size[i][1], .triangles = {256, 9}};
        done = kd_run_frame(k, &scene, &o, NULL);
        if (!done)
            break;
        const kd_run_sums sum = kd_run_add(k, 6);
        bench_table_count(k->table, "tiles_x", size[i][0]);
        bench_table_count(k->table, "tiles_y", size[i][1]);
        bench_table_count(k->table, "frame_cycles", k->result.cycles);
        bench_table_real(k->table, "idle_percent", sum.idle);
        bench_table_count(k->table, "commands", sum.commands);
        traffic_cells(k->table, &sum);
    }
    kd_bench_scene_release(&scene);
    return done;
}

/* ---- assignment ---- */

bool kd_section_assignments(kd_run *k)
{
    static const unsigned spes[] = {1, 2, 4, 6, 8};
    kd_bench_scene scene;
    if (!kd_bench_scene_make(&scene, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 1))
        return false;
    bool done = true;
    bench_table_section(k->table, "assignments");
    for (unsigned i = 0; i < sizeof spes / sizeof spes[0] && done; i++)
        for (int a = 0; a < CGT_ASSIGNMENTS && done; a++) {
            const cgt_kd_frame_options o = {.cell = {.spes = spes[i], .assignment = (cgt_assignment)a}};
            done = kd_run_frame(k, &scene, &o, NULL);
            if (!done)
                break;
            const kd_run_sums sum = kd_run_add(k, spes[i]);
            bench_table_count(k->table, "spes", spes[i]);
            bench_table_text(k->table, "assignment", assignments[a]);
            bench_table_count(k->table, "frame_cycles", k->result.cycles);
            bench_table_real(k->table, "idle_percent", sum.idle);
            bench_table_real(k->table, "waits_percent", sum.waits);
            bench_table_count(k->table, "messages", sum.messages);
            bench_table_end_row(k->table);
        }
    kd_bench_scene_release(&scene);
    return done;
}

/* ---- parts ---- */

bool kd_section_parts(kd_run *k)
{
    static const uint32_t parts[] = {1, 2, 4, 8};
    bool done = true;
    bench_table_section(k->table, "parts");
    for (unsigned i = 0; i < sizeof parts / sizeof parts[0] && done; i++) {
        kd_bench_scene scene;
        if (!kd_bench_scene_make(&scene, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, parts[i]))
            return false;
        for (unsigned dynamic = 0; dynamic < 2 && done; dynamic++) {
            const cgt_kd_frame_options o = {
                .cell = {.spes = 6, .assignment = dynamic ? CGT_ASSIGN_DYNAMIC : CGT_ASSIGN_INTERLEAVED}};
            done = kd_run_frame(k, &scene, &o, NULL);
            if (!done)
                break;
            const kd_run_sums sum = kd_run_add(k, 6);
            bench_table_count(k->table, "parts", parts[i]);
            bench_table_text(k->table, "assignment", assignments[o.cell.assignment]);
            bench_table_count(k->table, "frame_cycles", k->result.cycles);
            traffic_cells(k->table, &sum);
        }
        kd_bench_scene_release(&scene);
    }
    return done;
}

/* ---- kd-trees beside hierarchies: builds, memory, what rays visit and fetch ---- */

#define STRUCTURES 2

static const cgt_structure structures[STRUCTURES] = {CGT_STRUCTURE_KD, CGT_STRUCTURE_BIH};
static const char *const structure_names[STRUCTURES] = {"kd", "bih"};

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
    const cgt_kd_report *const r = &k->result.spe[0].report.kd;
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

/* A scene of one of the structures, and what its build takes. */
static bool build_structure(int i, kd_bench_scene *scene, double build[2])
{
    return kd_bench_build(structures[i], &build[0], &build[1]) &&
           kd_bench_scene_make(scene, structures[i], CGT_KD_LAYOUT_DEPTH_FIRST, 1);
}

bool kd_section_structures(kd_run *k)
{
    bool done = true;
    bench_table_section(k->table, "structures");
    for (int i = 0; i < STRUCTURES && done; i++) {
        kd_bench_scene scene;
        double build[2];
        if (!build_structure(i, &scene, build))
            return false;
        for (int rays = 0; rays < KD_BENCH_RAYS && done; rays++) {
            cgt_kd_frame_options o = {.batch = 0};
            kd_bench_add_rays(&o, (kd_bench_rays)rays);
            done = kd_run_frame(k, &scene, &o, NULL);
            if (!done)
                break;
            bench_table_text(k->table, "rays", kd_bench_rays_names[rays]);
            build_cells(k->table, structure_names[i], &scene, build);
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
        if (!build_structure(i, &scene, build))
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
            build_cells(k->table, structure_names[i], &scene, build);
            bench_table_count(k->table, "frame_cycles", k->result.cycles);
            bench_table_real(k->table, "trace_ms", (double)k->result.cycles / CYCLES_PER_MS);
            bench_table_end_row(k->table);
        }
        kd_bench_scene_release(&scene);
    }
    return done;
}
