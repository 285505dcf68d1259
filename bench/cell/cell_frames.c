/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of the grid program, see cell_frames.h. */
#include "cell/cell_frames.h"

#include <stdlib.h>

#include "cell/ppe/frame.h"
#include "cell/spu/timing/timing.h"
#include "common/program.h"

static const char *const assignments[CGT_ASSIGNMENTS] = {"interleaved", "static", "dynamic", "hybrid"};
static const char *const culls[] = {"", "none", "frustum", "blocks"};

/* Spheres of radius 0.03 in a cube of edge 2, by a generator of its own: the scene is part of the figures. */
static void make_spheres(cgt_sphere *sphere, uint32_t spheres)
{
    uint32_t bits = 1;
    for (uint32_t i = 0; i < spheres; i++) {
        float c[3];
        for (int a = 0; a < 3; a++) {
            bits = bits * 1664525u + 1013904223u;
            c[a] = (float)(bits >> 8) * 0x1p-23f - 1;
        }
        sphere[i] = (cgt_sphere){c[0], c[1], c[2], 0.03f};
    }
}

/* What the rows have in common. */
typedef struct session {
    bench_table *table;
    cgt_grid_scene scene;
    cgt_cell_frame_options options;
    cgt_cell_frame_result result;
    cgt_spu_counts counts; /* of SPE 0 */
    bool profiles;         /* a row for each function */
    uint32_t width, height, *ids;
} session;

static void inspect(void *user, unsigned spe, const cgt_spu *spu)
{
    session *const m = user;
    if (spe)
        return;
    m->counts = cgt_spu_timing_total(spu->timing);
    if (m->profiles)
        cell_function_rows(m->table, spu->timing);
}

static bool run(session *m)
{
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 3;
    if (cgt_cell_frame_trace(&m->scene, &camera, m->width, m->height, &m->options, m->ids, &m->result) == CGT_OK)
        return true;
    program_error("%s", m->result.message);
    return false;
}

static void kernel_row(const session *m)
{
    bench_table *const table = m->table;
    const cgt_spe_report *const p = &m->result.spe[0].report;
    bench_table_text(table, "loop", m->options.flattened ? "flattened" : "nested");
    bench_table_text(table, "cull", culls[m->options.cull]);
    bench_table_count(table, "cycles", m->result.cycles);
    bench_table_real(table, "cycles_ray", (double)m->result.cycles / ((double)m->width * m->height));
    bench_table_count(table, "build", UINT64_C(40) * p->built);
    bench_table_count(table, "cells", p->cells);
    bench_table_count(table, "tests", p->tests);
    bench_table_count(table, "mispredicts", m->counts.mispredicts);
    bench_table_count(table, "waits", m->result.spe[0].waits);
    bench_table_count(table, "doubts", m->result.doubts);
    bench_table_count(table, "changed", m->result.changed);
    bench_table_end_row(table);
}

static bool run_kernels(session *m)
{
    bench_table_section(m->table, "kernel");
    m->options.spes = 1;
    for (int k = 0; k < 4; k++) {
        m->options.flattened = k & 1;
        m->options.cull = (cgt_cull)(CGT_CULL_NONE + k / 2);
        if (!run(m))
            return false;
        kernel_row(m);
    }
    m->options.flattened = false;
    m->options.cull = CGT_CULL_FRUSTUM;
    return true;
}

static bool run_assignments(session *m)
{
    static const unsigned spes[] = {1, 2, 4, 6, 8};
    bench_table *const table = m->table;
    cgt_cell_frame_options *const o = &m->options;
    const cgt_cell_frame_result *const r = &m->result;
    bench_table_section(table, "assignment");
    for (unsigned k = 0; k < sizeof spes / sizeof spes[0]; k++)
        for (int a = 0; a < CGT_ASSIGNMENTS; a++) {
            uint64_t idle = 0, messages = 0;
            o->spes = spes[k];
            o->assignment = (cgt_assignment)a;
            if (!run(m))
                return false;
            for (unsigned i = 0; i < o->spes; i++) {
                idle += r->spe[i].idle;
                messages += r->spe[i].messages;
            }
            bench_table_count(table, "spes", o->spes);
            bench_table_text(table, "assignment", assignments[a]);
            bench_table_count(table, "cycles", r->cycles);
            bench_table_real(table, "idle_percent", 100 * (double)idle / ((double)r->cycles * o->spes));
            bench_table_count(table, "messages", messages);
            bench_table_end_row(table);
        }
    return true;
}

/* ---- sessions ---- */

static bool begin(session *m, bench_table *table, const cell_frames *f, uint32_t spheres)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    char message[CGT_PPE_MESSAGE_BYTES];
    *m = (session){.table = table, .width = f->width ? f->width : 320, .height = f->height ? f->height : 180};
    m->options = (cgt_cell_frame_options){
        .spes = 1, .elf = f->elf, .elf_bytes = f->bytes, .cull = CGT_CULL_FRUSTUM, .inspect = inspect, .user = m};
    cgt_sphere *const sphere = malloc((size_t)spheres * sizeof *sphere);
    m->ids = malloc((size_t)m->width * m->height * sizeof *m->ids);
    if (!sphere || !m->ids) {
        program_error("out of memory");
        free(sphere);
        free(m->ids);
        return false;
    }
    make_spheres(sphere, spheres);
    const cgt_result result = cgt_grid_scene_init(&m->scene, &memory, sphere, spheres, NULL, message);
    free(sphere);
    if (result == CGT_OK)
        return true;
    program_error("%s", message);
    free(m->ids);
    return false;
}

static void end(session *m)
{
    cgt_grid_scene_release(&m->scene);
    free(m->ids);
}

static uint32_t spheres_of(const cell_frames *f) { return f->spheres ? f->spheres : 2000; }

bool cell_frames_run(bench_table *table, const cell_frames *frames)
{
    static session m;
    if (!begin(&m, table, frames, spheres_of(frames)))
        return false;
    const bool done = run_kernels(&m) && run_assignments(&m);
    end(&m);
    return done;
}

bool cell_frames_profile(bench_table *table, const cell_frames *frames)
{
    static session m;
    if (!begin(&m, table, frames, spheres_of(frames)))
        return false;
    bench_table_section(table, "functions");
    m.profiles = true;
    const bool done = run(&m);
    bench_table_section(table, "classes");
    if (done)
        cell_class_rows(table, &m.counts);
    bench_table_section(table, "kernel");
    if (done)
        kernel_row(&m);
    end(&m);
    return done;
}
