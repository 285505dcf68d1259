/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cell --kd: the thesis' tracer on simulated SPEs; what each of its choices costs, a section for each. */
#include <string.h>

#include "cell/kd_run.h"
#include "cell/spu/timing/timing.h"

#define CYCLES_PER_MS 3.2e6

static const char *const layouts[] = {"", "depth first", "breadth first", "mixed"};

bool kd_run_frame(kd_run *run, const cgt_kd_frame_options *options, const cgt_kd_frame_output *output)
{
    const cgt_camera camera = kd_bench_camera();
    const cgt_kd_frame_output none = {.ids = NULL};
    const bool is_bih = run->scene.image.bih;
    cgt_kd_frame_options o = *options;
    o.cell.elf = is_bih ? run->programs->bih : run->programs->elf;
    o.cell.elf_bytes = is_bih ? run->programs->bih_bytes : run->programs->elf_bytes;
    o.cell.spes = o.cell.spes ? o.cell.spes : 1;
    o.cell.cycle_limit = run->cycle_limit;
    if (cgt_kd_frame_trace(&run->scene.image, &camera, run->width, run->height, &o, output ? output : &none,
                           &run->result) == CGT_OK)
        return true;
    program_error("%s", run->result.message);
    return false;
}

/* ---- cells that sections share ---- */

/* All SPEs together. */
typedef struct sums {
    double node_fetches, reference_fetches, leaf_fetches, triangle_fetches; /* for each pixel */
    double bytes;                                                           /* that DMA fetches, for each pixel */
    double waits, idle;                                                     /* percent of the cycles */
    double cycles; /* for each pixel, as if one SPE had done it all */
    uint64_t messages, commands;
} sums;

static sums add_up(const kd_run *run, unsigned spes)
{
    const double pixels = (double)run->width * run->height, all = (double)run->result.cycles * spes;
    sums sum = {.cycles = 0};
    for (unsigned i = 0; i < spes; i++) {
        const cgt_cell_frame_spe *const q = &run->result.spe[i];
        sum.node_fetches += q->report.kd.node_fetches / pixels;
        sum.reference_fetches += q->report.kd.reference_fetches / pixels;
        sum.leaf_fetches += q->report.kd.leaf_fetches / pixels;
        sum.triangle_fetches += q->report.kd.triangle_fetches / pixels;
        sum.bytes += (double)q->counts.bytes_in / pixels;
        sum.waits += 100 * (double)q->waits / all;
        sum.idle += 100 * (double)q->idle / all;
        sum.cycles += (double)q->cycles / pixels;
        sum.messages += q->messages;
        sum.commands += q->counts.gets + q->counts.puts + q->counts.lists;
    }
    return sum;
}

static void traffic_cells(bench_table *table, const sums *sum)
{
    BENCH_ROW(table, CELL("nodes_pixel", sum->node_fetches), CELL("references_pixel", sum->reference_fetches),
              CELL("leaves_pixel", sum->leaf_fetches), CELL("triangles_pixel", sum->triangle_fetches),
              CELL("bytes_pixel", sum->bytes), CELL("waits_percent", sum->waits), CELL("cycles_pixel", sum->cycles));
}

static const char *structure_of(const kd_run *k) { return k->scene.image.bih ? "bih" : "kd"; }

static void build_cells(const kd_run *k)
{
    const cgt_kd_scene_part *const p = &k->scene.image.part[0];
    BENCH_CELLS(k->table, CELL("structure", structure_of(k)), CELL("build_ms", k->build_ms),
                CELL("image_ms", k->image_ms), CELL("node_kb", p->node_bytes / 1024),
                CELL("reference_kb", p->reference_bytes / 1024), CELL("scene_nodes", p->image.nodes));
}

/* ---- sections ---- */

/* What a row is of: scene, rays and case. */
typedef struct kd_case {
    cgt_structure structure;
    cgt_kd_layout layout;
    uint32_t parts;
    unsigned number;
    const char *rays;
} kd_case;

static void show_functions(void *user, unsigned spe, const cgt_spu *spu)
{
    (void)spe;
    bench_table_section(user, "functions");
    cell_function_rows(user, spu->timing);
}

static void set_kernel(kd_run *k, const kd_case *c, cgt_kd_frame_options *o)
{
    (void)c;
    o->cell.inspect = show_functions;
    o->cell.user = k->table;
}

static void kernel_row(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o)
{
    const cgt_kd_report *const p = &k->result.spe[0].report.kd;
    const double count = (double)k->width * k->height;
    (void)c, (void)o;
    bench_table_section(k->table, "kernel");
    BENCH_ROW(k->table, CELL("structure", structure_of(k)), CELL("cycles", k->result.cycles),
              CELL("cycles_ray", (double)k->result.cycles / count), CELL("setup_ray", 40.0 * p->setup / count),
              CELL("nodes_vector", 4 * p->nodes / count), CELL("leaves_vector", 4 * p->leaves / count),
              CELL("tests_vector", 4 * p->tests / count), CELL("node_fetches_ray", p->node_fetches / count),
              CELL("reference_fetches_ray", p->reference_fetches / count),
              CELL("triangle_fetches_ray", p->triangle_fetches / count), CELL("waits", k->result.spe[0].waits),
              CELL("doubts", k->result.doubts), CELL("changed", k->result.changed));
}

/* Sizes are those of nodes of kd-trees; nodes of hierarchies are twice as large. */
static const cgt_kd_cache_size sizes[] = {{4, 5}, {16, 5}, {4, 7}, {16, 7}, {64, 5}, {16, 8}, {64, 6}};

static void set_layout(kd_run *k, const kd_case *c, cgt_kd_frame_options *o)
{
    o->nodes = (cgt_kd_cache_size){sizes[c->number].blocks, sizes[c->number].log2 - k->scene.image.bih};
}

static void layout_row(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o)
{
    const cgt_kd_cache_size *const size = &sizes[c->number];
    const sums sum = add_up(k, 1);
    (void)o;
    BENCH_CELLS(k->table, CELL("rays", c->rays), CELL("layout", layouts[c->layout]),
                CELL("cache_bytes", (uint64_t)size->blocks * 8 << size->log2),
                CELL("block_bytes", UINT64_C(8) << size->log2),
                CELL("node_bytes_pixel", sum.node_fetches * (8u << size->log2)));
    traffic_cells(k->table, &sum);
}

/* Triangles, fetched ahead or not; smallest caches. */
static const cgt_kd_cache_size slots[] = {{1024, 10}, {256, 9}, {64, 8}, {1, 0}};

static void set_triangles(kd_run *k, const kd_case *c, cgt_kd_frame_options *o)
{
    (void)k;
    o->triangles = slots[c->number / 2];
    o->prefetch = c->number & 1;
}

static void triangles_row(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o)
{
    const sums sum = add_up(k, 1);
    BENCH_CELLS(k->table, CELL("rays", c->rays), CELL("places", o->triangles.blocks),
                CELL("ahead", o->prefetch ? "yes" : "no"));
    traffic_cells(k->table, &sum);
}

/* Stack or ropes. */
static void traversal_row(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o)
{
    const sums sum = add_up(k, 1);
    const cgt_kd_report *const p = &k->result.spe[0].report.kd;
    (void)o;
    BENCH_CELLS(k->table, CELL("rays", c->rays),
                CELL("traversal", c->structure == CGT_STRUCTURE_KD_ROPES ? "ropes" : "stack"), CELL("nodes", p->nodes),
                CELL("leaves", p->leaves), CELL("tests", p->tests), CELL("exact_steps", p->exact_steps));
    traffic_cells(k->table, &sum);
}

static const uint32_t envelopes[][2] = {{1, 1}, {2, 2}, {4, 4}, {8, 8}, {16, 4}, {64, 1}, {1, 64}};

static void set_envelope(kd_run *k, const kd_case *c, cgt_kd_frame_options *o)
{
    (void)k;
    o->cell.spes = 6;
    o->tiles_x = envelopes[c->number][0];
    o->tiles_y = envelopes[c->number][1];
    o->triangles = (cgt_kd_cache_size){256, 9};
}

static void envelope_row(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o)
{
    const sums sum = add_up(k, 6);
    (void)c;
    BENCH_CELLS(k->table, CELL("tiles_x", o->tiles_x), CELL("tiles_y", o->tiles_y),
                CELL("frame_cycles", k->result.cycles), CELL("idle_percent", sum.idle), CELL("commands", sum.commands));
    traffic_cells(k->table, &sum);
}

static const unsigned spes[] = {1, 2, 4, 6, 8};

static void set_assignment(kd_run *k, const kd_case *c, cgt_kd_frame_options *o)
{
    (void)k;
    o->cell.spes = spes[c->number / CGT_ASSIGNMENTS];
    o->cell.assignment = (cgt_assignment)(c->number % CGT_ASSIGNMENTS);
}

static void assignment_row(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o)
{
    const sums sum = add_up(k, o->cell.spes);
    (void)c;
    BENCH_ROW(k->table, CELL("spes", o->cell.spes), CELL("assignment", cell_assignments[o->cell.assignment]),
              CELL("frame_cycles", k->result.cycles), CELL("idle_percent", sum.idle), CELL("waits_percent", sum.waits),
              CELL("messages", sum.messages));
}

static void set_parts(kd_run *k, const kd_case *c, cgt_kd_frame_options *o)
{
    (void)k;
    o->cell.spes = 6;
    o->cell.assignment = c->number ? CGT_ASSIGN_DYNAMIC : CGT_ASSIGN_INTERLEAVED;
}

static void parts_row(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o)
{
    const sums sum = add_up(k, 6);
    BENCH_CELLS(k->table, CELL("parts", c->parts), CELL("assignment", cell_assignments[o->cell.assignment]),
                CELL("frame_cycles", k->result.cycles));
    traffic_cells(k->table, &sum);
}

/* kd-trees beside hierarchies: builds, memory, what rays visit and fetch. */
static void structure_row(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o)
{
    const cgt_kd_report *const r = &k->result.spe[0].report.kd;
    const bool is_bih = k->scene.image.bih;
    const cgt_kd_cache_size block = is_bih ? CGT_KD_BIH_BLOCKS : CGT_KD_NODE_BLOCKS;
    const size_t node_bytes = is_bih ? sizeof(cgt_bih_node) : sizeof(cgt_kd_node);
    const sums sum = add_up(k, 1);
    (void)o;
    BENCH_CELLS(k->table, CELL("rays", c->rays));
    build_cells(k);
    BENCH_ROW(k->table, CELL("nodes", r->nodes), CELL("leaves", r->leaves), CELL("tests", r->tests),
              CELL("node_bytes_pixel", sum.node_fetches * (double)(node_bytes << block.log2)),
              CELL("reference_bytes_pixel", sum.reference_fetches * (double)(4u << CGT_KD_REFERENCE_BLOCKS.log2)),
              CELL("triangle_bytes_pixel", sum.triangle_fetches * (double)sizeof(cgt_leaf_triangle)),
              CELL("doubts", k->result.doubts), CELL("waits_percent", sum.waits), CELL("cycles_pixel", sum.cycles));
}

/* Frames that are built anew. */
static void set_rebuilt(kd_run *k, const kd_case *c, cgt_kd_frame_options *o)
{
    (void)k, (void)c;
    o->cell.spes = 6;
    o->cell.assignment = CGT_ASSIGN_DYNAMIC;
}

static void rebuilt_row(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o)
{
    (void)o;
    BENCH_CELLS(k->table, CELL("rays", c->rays));
    build_cells(k);
    BENCH_ROW(k->table, CELL("frame_cycles", k->result.cycles),
              CELL("trace_ms", (double)k->result.cycles / CYCLES_PER_MS));
}

/* ---- the list ---- */

typedef struct kd_scene_choice {
    cgt_structure structure;
    cgt_kd_layout layout;
    uint32_t parts;
} kd_scene_choice;

#define ALL_LAYOUTS(structure)                                                                                         \
    {structure, CGT_KD_LAYOUT_DEPTH_FIRST, 1}, {structure, CGT_KD_LAYOUT_BREADTH_FIRST, 1},                            \
    {                                                                                                                  \
        structure, CGT_KD_LAYOUT_MIXED, 1                                                                              \
    }
static const kd_scene_choice scenes[] = {ALL_LAYOUTS(CGT_STRUCTURE_KD),
                                         ALL_LAYOUTS(CGT_STRUCTURE_BIH),
                                         {CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 1},
                                         {CGT_STRUCTURE_KD_ROPES, CGT_KD_LAYOUT_DEPTH_FIRST, 1},
                                         {CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 1},
                                         {CGT_STRUCTURE_BIH, CGT_KD_LAYOUT_DEPTH_FIRST, 1},
                                         {CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 1},
                                         {CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 2},
                                         {CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 4},
                                         {CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 8}};
enum { KD_LAYOUTS = 0, BIH_LAYOUTS = 3, STACK_AND_ROPES = 6, BOTH = 8, IN_PARTS = 10 };

typedef struct kd_section {
    const char *name;
    unsigned first, scenes; /* of the list above */
    int rays;               /* kinds of rays, camera first */
    unsigned cases;
    void (*set)(kd_run *k, const kd_case *c, cgt_kd_frame_options *o); /* NULL: the defaults */
    void (*row)(kd_run *k, const kd_case *c, const cgt_kd_frame_options *o);
    bool is_large, needs_bih, builds;
} kd_section;

static const kd_section sections[] = {
    {"kernel", BOTH, 2, 1, 1, set_kernel, kernel_row, true, false, false},
    {"layouts", KD_LAYOUTS, 3, KD_BENCH_BOUNCED, 7, set_layout, layout_row, false, false, false},
    {"triangles", KD_LAYOUTS, 1, KD_BENCH_BOUNCED, 8, set_triangles, triangles_row, false, false, false},
    {"traversals", STACK_AND_ROPES, 2, KD_BENCH_BOUNCED, 1, NULL, traversal_row, false, false, false},
    {"envelopes", KD_LAYOUTS, 1, 1, 7, set_envelope, envelope_row, false, false, false},
    {"assignments", KD_LAYOUTS, 1, 1, 5 * CGT_ASSIGNMENTS, set_assignment, assignment_row, false, false, false},
    {"parts", IN_PARTS, 4, 1, 2, set_parts, parts_row, false, false, false},
    {"modes", KD_LAYOUTS, 1, 0, 0, NULL, NULL, false, false, false},
    {"structures", BOTH, 2, KD_BENCH_RAYS, 1, NULL, structure_row, false, true, true},
    {"hierarchies", BIH_LAYOUTS, 3, KD_BENCH_RAYS, 7, set_layout, layout_row, false, true, false},
    {"rebuilt", BOTH, 2, KD_BENCH_RAYS, 1, set_rebuilt, rebuilt_row, true, true, true}};

/* All rays and cases of a scene. */
static bool run_scene(kd_run *k, const kd_section *section, const kd_scene_choice *scene)
{
    bool done = true;
    if (!section->row)
        return kd_run_modes(k);
    for (int rays = 0; rays < section->rays; rays++)
        for (unsigned i = 0; i < section->cases && done; i++) {
            const kd_case c = {scene->structure, scene->layout, scene->parts, i, kd_bench_rays_names[rays]};
            cgt_kd_frame_options o = {.batch = 0};
            if (section->row == rebuilt_row && rays == KD_BENCH_AMBIENT)
                continue; /* four rays a pixel take minutes to simulate */
            kd_bench_add_rays(&o, (kd_bench_rays)rays);
            if (section->set)
                section->set(k, &c, &o);
            done = kd_run_frame(k, &o, NULL);
            if (done)
                section->row(k, &c, &o);
        }
    return done;
}

static bool run_section(kd_run *k, const kd_section *section)
{
    bool done = true;
    k->width = section->is_large ? 640 : 160;
    k->height = section->is_large ? 360 : 90;
    bench_table_section(k->table, section->name);
    for (unsigned i = 0; i < section->scenes && done; i++) {
        const kd_scene_choice *scene = &scenes[section->first + i];
        if (scene->structure == CGT_STRUCTURE_BIH && !k->programs->bih)
            continue;
        if (section->builds && !kd_bench_build(scene->structure, &k->build_ms, &k->image_ms))
            return false;
        if (!kd_bench_scene_make(&k->scene, scene->structure, scene->layout, scene->parts))
            return false;
        done = run_scene(k, section, scene);
        kd_bench_scene_release(&k->scene);
    }
    return done;
}

bool cell_kd_run(bench_table *table, const bench_settings *settings, const cell_programs *programs)
{
    static kd_run k;
    bool done = true, any = false;
    k = (kd_run){.table = table, .programs = programs, .cycle_limit = settings->cycles};
    for (size_t i = 0; done && i < sizeof sections / sizeof sections[0]; i++) {
        const kd_section *section = &sections[i];
        if (settings->section && strcmp(settings->section, section->name) != 0)
            continue;
        any = true;
        if (section->needs_bih && !programs->bih && settings->section) {
            program_error("section %s wants --bih", section->name);
            return false;
        }
        if (!section->needs_bih || programs->bih)
            done = run_section(&k, section);
    }
    if (!any)
        program_error("there is no section %s of --kd", settings->section);
    return done && any;
}
