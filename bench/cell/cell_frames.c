/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of the grid program, see cell_frames.h. */
#include "cell/cell_frames.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cell/cell_waits.h"
#include "cell/ppe/grid/grid_frame.h"
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
    cgt_grid_frame_options options;
    cgt_cell_frame_result result;
    cgt_spu_counts counts, visit, fill; /* of SPE 0: all, its loops over cells, the grid's fill */
    bool profiles;                      /* a row for each function */
    uint32_t width, height, *ids;
} session;

/* Functions whose names begin with a word. */
static cgt_spu_counts count_functions(const cgt_spu_timing *timing, const char *word)
{
    cgt_spu_counts sum = {0};
    for (uint32_t i = 0; i < timing->functions; i++) {
        const cgt_spu_function *const f = &timing->function[i];
        if (strncmp(f->name, word, strlen(word)) != 0)
            continue;
        sum.instructions += f->counts.instructions;
        sum.mispredicts += f->counts.mispredicts;
        for (int k = 0; k < CGT_SPU_CAUSES; k++)
            sum.cycles[k] += f->counts.cycles[k];
    }
    return sum;
}

static void inspect(void *user, unsigned spe, const cgt_spu *spu)
{
    session *const m = user;
    if (spe)
        return;
    m->counts = cgt_spu_timing_total(spu->timing);
    m->visit = count_functions(spu->timing, "grid_visit_");
    m->fill = count_functions(spu->timing, "grid_fill");
    if (m->profiles)
        cell_function_rows(m->table, spu->timing);
}

static bool run(session *m)
{
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 3;
    if (cgt_grid_frame_trace(&m->scene, &camera, m->width, m->height, &m->options, m->ids, &m->result) == CGT_OK)
        return true;
    program_error("%s", m->result.message);
    return false;
}

static double share(uint64_t part, uint64_t all) { return all ? (double)part / (double)all : NAN; }

static void kernel_row(const session *m)
{
    bench_table *const table = m->table;
    const cgt_spe_report *const p = &m->result.spe[0].report.grid;
    const uint64_t branches = m->counts.classes[CGT_SPU_BR];
    bench_table_text(table, "loop", m->options.nested ? "nested" : "flattened");
    bench_table_text(table, "cull", culls[m->options.cull]);
    bench_table_text(table, "remembers", m->options.retest ? "no" : "yes");
    bench_table_count(table, "cycles", m->result.cycles);
    bench_table_real(table, "cycles_ray", (double)m->result.cycles / ((double)m->width * m->height));
    bench_table_count(table, "build", UINT64_C(40) * p->built);
    bench_table_count(table, "cells", p->cells);
    bench_table_real(table, "cycles_cell", share(cgt_spu_counts_cycles(&m->visit), p->cells));
    bench_table_real(table, "mispredicts_cell", share(m->visit.mispredicts, p->cells));
    bench_table_count(table, "listed", p->listed);
    bench_table_count(table, "tests", p->tests);
    bench_table_count(table, "remembered", p->remembered);
    bench_table_real(table, "mispredicts_branch", share(m->counts.mispredicts, branches));
    bench_table_real(table, "mispredict_percent", 100 * share(m->counts.cycles[CGT_SPU_MISPREDICT], m->result.cycles));
    bench_table_count(table, "waits", m->result.spe[0].waits);
    bench_table_count(table, "doubts", m->result.doubts);
    bench_table_count(table, "changed", m->result.changed);
    bench_table_end_row(table);
}

static bool run_kernels(session *m)
{
    bench_table_section(m->table, "kernel");
    for (int k = 0; k < 6; k++) {
        m->options.nested = !(k & 1);
        m->options.cull = k < 2 ? CGT_CULL_NONE : CGT_CULL_FRUSTUM;
        m->options.retest = k < 4;
        if (!run(m))
            return false;
        kernel_row(m);
    }
    m->options.nested = m->options.retest = false;
    return true;
}

/* What a push takes, all that finds its cell included. */
static bool run_push(session *m)
{
    bench_table *const table = m->table;
    if (!run(m))
        return false;
    const uint64_t pushes = UINT64_C(8) * m->scene.image.spheres, cycles = cgt_spu_counts_cycles(&m->fill);
    bench_table_section(table, "push");
    bench_table_count(table, "pushes", pushes);
    bench_table_count(table, "cycles", cycles);
    bench_table_real(table, "cycles_push", share(cycles, pushes));
    bench_table_real(table, "instructions_push", share(m->fill.instructions, pushes));
    bench_table_count(table, "references", m->result.spe[0].report.grid.references);
    bench_table_end_row(table);
    return true;
}

static bool run_assignments(session *m)
{
    static const unsigned spes[] = {1, 2, 4, 6, 8};
    bench_table *const table = m->table;
    cgt_cell_frame_options *const o = &m->options.cell;
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

/* ---- rays from hits ---- */

static bool run_light(session *m)
{
    static const cgt_grid_light lights[] = {{.shadow = true, .position = {1, 3, 4}},
                                            {.ambient = 1},
                                            {.ambient = 8},
                                            {.ambient = 8, .radius = 0.25f},
                                            {.shadow = true, .position = {1, 3, 4}, .ambient = 8}};
    bench_table *const table = m->table;
    uint64_t before;
    if (!run(m))
        return false;
    before = m->result.cycles;
    m->options.occluded = malloc((size_t)m->width * m->height * sizeof *m->options.occluded);
    if (!m->options.occluded) {
        program_error("out of memory");
        return false;
    }
    bool done = true;
    bench_table_section(table, "light");
    for (unsigned k = 0; done && k < sizeof lights / sizeof lights[0]; k++) {
        m->options.light = &lights[k];
        done = run(m);
        if (!done)
            break;
        const uint32_t rays = m->result.spe[0].report.grid.light_rays;
        bench_table_count(table, "shadow", lights[k].shadow);
        bench_table_count(table, "ambient", lights[k].ambient);
        bench_table_real(table, "radius", (double)lights[k].radius);
        bench_table_count(table, "cycles", m->result.cycles);
        bench_table_count(table, "rays", rays);
        bench_table_real(table, "cycles_ray", share(m->result.cycles - before, rays));
        bench_table_count(table, "doubts", m->result.light_doubts);
        bench_table_count(table, "pixels_of_ppe", m->result.light_pixels);
        bench_table_end_row(table);
    }
    m->options.light = NULL;
    free(m->options.occluded);
    m->options.occluded = NULL;
    return done;
}

/* ---- memory ---- */

#define CLOCK 3.2e9 /* cycles a second */

/* What the frame moves, with ports of main memory from 25.6 GB/s down. */
static bool run_memory(session *m)
{
    static const uint32_t ports[] = {8, 4, 2, 1};
    cgt_mfc_timing timing = cgt_mfc_default_timing;
    bench_table *const table = m->table;
    bool done = true;
    bench_table_section(table, "memory");
    m->options.cell.timing = &timing;
    m->options.cell.spes = 6;
    for (unsigned k = 0; done && k < sizeof ports / sizeof ports[0]; k++) {
        uint64_t in = 0, out = 0, waits = 0;
        timing.memory_bytes_per_cycle = ports[k];
        done = run(m);
        if (!done)
            break;
        for (unsigned i = 0; i < m->options.cell.spes; i++) {
            in += m->result.spe[i].counts.bytes_in;
            out += m->result.spe[i].counts.bytes_out;
            waits += m->result.spe[i].waits;
        }
        const double seconds = (double)m->result.cycles / CLOCK;
        bench_table_count(table, "spes", m->options.cell.spes);
        bench_table_real(table, "port_gb_s", ports[k] * CLOCK / 1e9);
        bench_table_count(table, "cycles", m->result.cycles);
        bench_table_real(table, "frames_s", 1 / seconds);
        bench_table_count(table, "bytes_in", in);
        bench_table_count(table, "bytes_out", out);
        bench_table_real(table, "gb_s", (double)(in + out) / seconds / 1e9);
        bench_table_real(table, "port_percent", 100 * (double)(in + out) / ((double)m->result.cycles * ports[k]));
        bench_table_real(table, "wait_percent", 100 * share(waits, m->result.cycles * m->options.cell.spes));
        bench_table_end_row(table);
    }
    m->options.cell.timing = NULL;
    m->options.cell.spes = 1;
    return done;
}

static bool run_waits(session *m)
{
    cgt_grid_frame_options o = m->options;
    o.cell.inspect = NULL;
    return cell_waits_run(m->table, &m->scene, &o);
}

/* ---- sessions ---- */

static bool begin(session *m, bench_table *table, const cell_frames *f, uint32_t spheres)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    char message[CGT_PPE_MESSAGE_BYTES];
    *m = (session){.table = table, .width = f->width ? f->width : 320, .height = f->height ? f->height : 180};
    m->options = (cgt_grid_frame_options){
        .cell = {.spes = 1, .elf = f->elf, .elf_bytes = f->bytes, .inspect = inspect, .user = m},
        .cull = CGT_CULL_FRUSTUM};
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

/* Spheres of one size, up to as many as local store has room for. */
static bool run_growth(bench_table *table, const cell_frames *frames)
{
    static const uint32_t counts[] = {125, 250, 500, 1000, 1500, CGT_GRID_SPHERES};
    static const unsigned spes[] = {1, 6, 8};
    static session m;
    bench_table_section(table, "spheres");
    for (unsigned k = 0; k < sizeof counts / sizeof counts[0]; k++)
        for (unsigned i = 0; i < sizeof spes / sizeof spes[0]; i++) {
            if (!begin(&m, table, frames, counts[k]))
                return false;
            m.options.cell.spes = spes[i];
            const bool done = run(&m);
            const cgt_spe_report *const p = &m.result.spe[0].report.grid;
            if (done) {
                bench_table_count(table, "spheres", counts[k]);
                bench_table_count(table, "spes", spes[i]);
                bench_table_count(table, "build", UINT64_C(40) * p->built);
                bench_table_count(table, "cycles", m.result.cycles);
                bench_table_real(table, "frames_s", CLOCK / (double)m.result.cycles);
                bench_table_end_row(table);
            }
            end(&m);
            if (!done)
                return false;
        }
    return true;
}

bool cell_frames_run(bench_table *table, const cell_frames *frames)
{
    static const struct {
        const char *name;
        bool (*run)(session *m);
    } sections[] = {{"kernel", run_kernels},         {"push", run_push},  {"light", run_light}, {"memory", run_memory},
                    {"assignment", run_assignments}, {"waits", run_waits}};
    static session m;
    bool done = begin(&m, table, frames, spheres_of(frames)), known = !frames->section;
    if (!done)
        return false;
    for (unsigned k = 0; done && k < sizeof sections / sizeof sections[0]; k++) {
        const bool wanted = !frames->section || strcmp(frames->section, sections[k].name) == 0;
        known |= wanted;
        done = !wanted || sections[k].run(&m);
    }
    end(&m);
    if (done && (!frames->section || strcmp(frames->section, "spheres") == 0))
        return run_growth(table, frames);
    if (done && !known)
        program_error("--section: kernel, push, light, memory, assignment, waits or spheres, not %s", frames->section);
    return done && known;
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
