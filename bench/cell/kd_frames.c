/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of the kd program, see kd_frames.h. */
#include "cell/kd_frames.h"

#include <stdint.h>

#include "cell/cell_tables.h"
#include "cell/kd_scenes.h"
#include "cell/spu/timing/timing.h"
#include "common/program.h"

typedef struct kd_run {
    bench_table *table;
    const void *elf;
    size_t elf_bytes;
    uint32_t width, height;
} kd_run;

static cgt_kd_frame_result result;

static bool run(const kd_run *k, const kd_bench_scene *scene, cgt_kd_frame_options o)
{
    const cgt_camera camera = kd_bench_camera();
    const cgt_kd_frame_output none = {NULL, NULL, NULL};
    o.cell.elf = k->elf;
    o.cell.elf_bytes = k->elf_bytes;
    if (o.cell.spes == 0)
        o.cell.spes = 1;
    if (cgt_kd_frame_trace(&scene->image, &camera, k->width, k->height, &o, &none, &result) == CGT_OK)
        return true;
    program_error("%s", result.message);
    return false;
}

/* ---- the kernel ---- */

static void show_functions(void *user, unsigned spe, const cgt_spu *spu)
{
    bench_table *const table = user;
    (void)spe;
    bench_table_section(table, "functions");
    cell_function_rows(table, spu->timing);
}

static bool run_kernel(kd_run k)
{
    kd_bench_scene scene;
    k.width = 640;
    k.height = 360;
    if (!kd_bench_scene_make(&scene, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_DEPTH_FIRST, 1))
        return false;
    const cgt_kd_frame_options o = {.cell = {.inspect = show_functions, .user = k.table}};
    const bool done = run(&k, &scene, o);
    const cgt_kd_report *const p = &result.spe[0].report;
    const double count = (double)k.width * k.height;
    if (done) {
        bench_table_section(k.table, "kernel");
        bench_table_count(k.table, "cycles", result.cycles);
        bench_table_real(k.table, "cycles_ray", (double)result.cycles / count);
        bench_table_real(k.table, "setup_ray", 40.0 * p->setup / count);
        bench_table_real(k.table, "nodes_ray", 4 * p->nodes / count);
        bench_table_real(k.table, "leaves_ray", 4 * p->leaves / count);
        bench_table_real(k.table, "tests_ray", 4 * p->tests / count);
        bench_table_real(k.table, "node_fetches_ray", p->node_fetches / count);
        bench_table_real(k.table, "reference_fetches_ray", p->reference_fetches / count);
        bench_table_real(k.table, "triangle_fetches_ray", p->triangle_fetches / count);
        bench_table_count(k.table, "waits", result.spe[0].waits);
        bench_table_count(k.table, "doubts", result.doubts);
        bench_table_count(k.table, "changed", result.changed);
        bench_table_end_row(k.table);
    }
    kd_bench_scene_release(&scene);
    return done;
}

bool kd_frames_run(bench_table *table, const void *elf, size_t bytes)
{
    const kd_run k = {.table = table, .elf = elf, .elf_bytes = bytes, .width = 160, .height = 90};
    return run_kernel(k);
}
