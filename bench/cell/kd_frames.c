/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of the kd program, see kd_frames.h. */
#include "cell/kd_frames.h"

#include <stdint.h>
#include <string.h>

#include "cell/cell_tables.h"
#include "cell/kd_run.h"
#include "cell/spu/timing/timing.h"
#include "common/program.h"

bool kd_run_frame(kd_run *run, const kd_bench_scene *scene, const cgt_kd_frame_options *options,
                  const cgt_kd_frame_output *output)
{
    const cgt_camera camera = kd_bench_camera();
    const cgt_kd_frame_output none = {.ids = NULL};
    cgt_kd_frame_options o = *options;
    o.cell.elf = scene->image.bih ? run->bih_elf : run->elf;
    o.cell.elf_bytes = scene->image.bih ? run->bih_bytes : run->elf_bytes;
    o.cell.spes = o.cell.spes ? o.cell.spes : 1;
    if (cgt_kd_frame_trace(&scene->image, &camera, run->width, run->height, &o, output ? output : &none,
                           &run->result) == CGT_OK)
        return true;
    program_error("%s", run->result.message);
    return false;
}

kd_run_sums kd_run_add(const kd_run *run, unsigned spes)
{
    const double pixels = (double)run->width * run->height, all = (double)run->result.cycles * spes;
    kd_run_sums sum = {.cycles = 0};
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

/* ---- the kernel ---- */

static void show_functions(void *user, unsigned spe, const cgt_spu *spu)
{
    bench_table *const table = user;
    (void)spe;
    bench_table_section(table, "functions");
    cell_function_rows(table, spu->timing);
}

static void kernel_row(kd_run *k, const char *structure)
{
    const cgt_kd_report *const p = &k->result.spe[0].report.kd;
    const double count = (double)k->width * k->height;
    bench_table_section(k->table, "kernel");
    bench_table_text(k->table, "structure", structure);
    bench_table_count(k->table, "cycles", k->result.cycles);
    bench_table_real(k->table, "cycles_ray", (double)k->result.cycles / count);
    bench_table_real(k->table, "setup_ray", 40.0 * p->setup / count);
    bench_table_real(k->table, "nodes_vector", 4 * p->nodes / count);
    bench_table_real(k->table, "leaves_vector", 4 * p->leaves / count);
    bench_table_real(k->table, "tests_vector", 4 * p->tests / count);
    bench_table_real(k->table, "node_fetches_ray", p->node_fetches / count);
    bench_table_real(k->table, "reference_fetches_ray", p->reference_fetches / count);
    bench_table_real(k->table, "triangle_fetches_ray", p->triangle_fetches / count);
    bench_table_count(k->table, "waits", k->result.spe[0].waits);
    bench_table_count(k->table, "doubts", k->result.doubts);
    bench_table_count(k->table, "changed", k->result.changed);
    bench_table_end_row(k->table);
}

static bool run_kernel_with(kd_run *k, cgt_structure structure)
{
    kd_bench_scene scene;
    if (!kd_bench_scene_make(&scene, structure, CGT_KD_LAYOUT_DEPTH_FIRST, 1))
        return false;
    const cgt_kd_frame_options o = {.cell = {.inspect = show_functions, .user = k->table}};
    const bool done = kd_run_frame(k, &scene, &o, NULL);
    if (done)
        kernel_row(k, structure == CGT_STRUCTURE_BIH ? "bih" : "kd");
    kd_bench_scene_release(&scene);
    return done;
}

static bool run_kernel(kd_run *k)
{
    k->width = 640;
    k->height = 360;
    return run_kernel_with(k, CGT_STRUCTURE_KD) && (!k->bih_elf || run_kernel_with(k, CGT_STRUCTURE_BIH));
}

bool kd_frames_run(bench_table *table, const kd_programs *programs, const char *section)
{
    static const struct {
        const char *name;
        bool (*run)(kd_run *);
        bool bih; /* of both programs */
    } sections[] = {{"kernel", run_kernel, false},
                    {"layouts", kd_section_layouts, false},
                    {"triangles", kd_section_triangles, false},
                    {"traversals", kd_section_traversals, false},
                    {"envelopes", kd_section_envelopes, false},
                    {"assignments", kd_section_assignments, false},
                    {"parts", kd_section_parts, false},
                    {"modes", kd_section_modes, false},
                    {"structures", kd_section_structures, true},
                    {"hierarchies", kd_section_hierarchies, true},
                    {"rebuilt", kd_section_rebuilt, true}};
    static kd_run k;
    bool done = true, any = false;
    k = (kd_run){.table = table,
                 .elf = programs->kd,
                 .elf_bytes = programs->kd_bytes,
                 .bih_elf = programs->bih,
                 .bih_bytes = programs->bih_bytes};
    for (size_t i = 0; done && i < sizeof sections / sizeof sections[0]; i++) {
        if (section && strcmp(section, sections[i].name) != 0)
            continue;
        any = true;
        if (sections[i].bih && !k.bih_elf) {
            if (!section)
                continue;
            program_error("section %s wants --bih", section);
            return false;
        }
        k.width = 160;
        k.height = 90;
        done = sections[i].run(&k);
    }
    if (!any)
        program_error("there is no section %s of --kd", section);
    return done && any;
}
