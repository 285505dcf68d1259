/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of the grid program, see cell_frames.h. */
#include "cell/cell_frames.h"

#include <stdint.h>

#include "cell/ppe/frame.h"
#include "cell/cell_waits.h"
#include "cell/spu/timing/timing.h"
#include "common/program.h"

#define SPHERES 2000u
#define WIDTH 320u
#define HEIGHT 180u

static const char *const assignments[CGT_ASSIGNMENTS] = {"interleaved", "static", "dynamic", "hybrid"};
static const char *const culls[] = {"", "none", "frustum", "blocks"};

/* Spheres of radius 0.03 in a cube of edge 2, by a generator of its own: the scene is part of the figures. */
static void make_spheres(cgt_sphere *sphere)
{
    uint32_t bits = 1;
    for (uint32_t i = 0; i < SPHERES; i++) {
        float c[3];
        for (int a = 0; a < 3; a++) {
            bits = bits * 1664525u + 1013904223u;
            c[a] = (float)(bits >> 8) * 0x1p-23f - 1;
        }
        sphere[i] = (cgt_sphere){c[0], c[1], c[2], 0.03f};
    }
}

typedef struct measured {
    cgt_spu_counts counts; /* of SPE 0 */
} measured;

static void inspect(void *user, unsigned spe, const cgt_spu *spu)
{
    measured *const m = user;
    if (spe == 0)
        m->counts = cgt_spu_timing_total(spu->timing);
}

static bool run(const cgt_grid_scene *scene, const cgt_cell_frame_options *o, cgt_cell_frame_result *r)
{
    static uint32_t ids[WIDTH * HEIGHT];
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 3;
    if (cgt_cell_frame_trace(scene, &camera, WIDTH, HEIGHT, o, ids, r) == CGT_OK)
        return true;
    program_error("%s", r->message);
    return false;
}

static bool run_kernels(bench_table *table, const cgt_grid_scene *scene, cgt_cell_frame_options o)
{
    static cgt_cell_frame_result r;
    measured m;
    bench_table_section(table, "kernel");
    o.spes = 1;
    o.inspect = inspect;
    o.user = &m;
    for (int k = 0; k < 6; k++) {
        o.flattened = k & 1;
        o.cull = (cgt_cull)(CGT_CULL_NONE + k / 2);
        if (!run(scene, &o, &r))
            return false;
        const cgt_spe_report *const p = &r.spe[0].report;
        bench_table_text(table, "loop", o.flattened ? "flattened" : "nested");
        bench_table_text(table, "cull", culls[o.cull]);
        bench_table_count(table, "cycles", r.cycles);
        bench_table_real(table, "cycles_ray", (double)r.cycles / (WIDTH * HEIGHT));
        bench_table_count(table, "build", UINT64_C(40) * p->built);
        bench_table_count(table, "cells", p->cells);
        bench_table_count(table, "tests", p->tests);
        bench_table_count(table, "mispredicts", m.counts.mispredicts);
        bench_table_count(table, "waits", r.spe[0].waits);
        bench_table_count(table, "doubts", r.doubts);
        bench_table_count(table, "changed", r.changed);
        bench_table_end_row(table);
    }
    return true;
}

static bool run_assignments(bench_table *table, const cgt_grid_scene *scene, cgt_cell_frame_options o)
{
    static cgt_cell_frame_result r;
    static const unsigned spes[] = {1, 2, 4, 6, 8};
    bench_table_section(table, "assignment");
    for (unsigned k = 0; k < sizeof spes / sizeof spes[0]; k++)
        for (int a = 0; a < CGT_ASSIGNMENTS; a++) {
            uint64_t idle = 0, messages = 0;
            o.spes = spes[k];
            o.assignment = (cgt_assignment)a;
            if (!run(scene, &o, &r))
                return false;
            for (unsigned i = 0; i < o.spes; i++) {
                idle += r.spe[i].idle;
                messages += r.spe[i].messages;
            }
            bench_table_count(table, "spes", o.spes);
            bench_table_text(table, "assignment", assignments[a]);
            bench_table_count(table, "cycles", r.cycles);
            bench_table_real(table, "idle_percent", 100 * (double)idle / ((double)r.cycles * o.spes));
            bench_table_count(table, "messages", messages);
            bench_table_end_row(table);
        }
    return true;
}

bool cell_frames_run(bench_table *table, const void *elf, size_t bytes)
{
    static cgt_sphere sphere[SPHERES];
    const cgt_memory_hooks memory = cgt_memory_default();
    const cgt_cell_frame_options o = {.elf = elf, .elf_bytes = bytes};
    char message[CGT_PPE_MESSAGE_BYTES];
    cgt_grid_scene scene;
    make_spheres(sphere);
    if (cgt_grid_scene_init(&scene, &memory, sphere, SPHERES, NULL, message) != CGT_OK) {
        program_error("%s", message);
        return false;
    }
    const bool done =
        run_kernels(table, &scene, o) && run_assignments(table, &scene, o) && cell_waits_run(table, &scene, &o);
    cgt_grid_scene_release(&scene);
    return done;
}
