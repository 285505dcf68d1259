/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench cell --frames: Chapman's tracer on simulated SPEs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cell/cell_tables.h"
#include "cell/ppe/grid/grid_frame.h"
#include "cell/spu/timing/timing.h"

#define CLOCK 3.2e9 /* cycles a second */

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
    uint32_t width, height, *ids, *occluded;
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

static void kernel_row(const session *m)
{
    const cgt_spe_report *const p = &m->result.spe[0].report.grid;
    const uint64_t cycles = m->result.cycles;
    BENCH_ROW(
        m->table, CELL("loop", m->options.nested ? "nested" : "flattened"), CELL("cull", culls[m->options.cull]),
        CELL("remembers", m->options.retest ? "no" : "yes"), CELL("cycles", cycles),
        CELL("cycles_ray", (double)cycles / ((double)m->width * m->height)), CELL("build", UINT64_C(40) * p->built),
        CELL("cells", p->cells), CELL("cycles_cell", cell_share(cgt_spu_counts_cycles(&m->visit), p->cells)),
        CELL("mispredicts_cell", cell_share(m->visit.mispredicts, p->cells)), CELL("listed", p->listed),
        CELL("tests", p->tests), CELL("remembered", p->remembered),
        CELL("mispredicts_branch", cell_share(m->counts.mispredicts, m->counts.classes[CGT_SPU_BR])),
        CELL("mispredict_percent", 100 * cell_share(m->counts.cycles[CGT_SPU_MISPREDICT], cycles)),
        CELL("waits", m->result.spe[0].waits), CELL("doubts", m->result.doubts), CELL("changed", m->result.changed));
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
    if (!run(m))
        return false;
    const uint64_t pushes = UINT64_C(8) * m->scene.image.spheres, cycles = cgt_spu_counts_cycles(&m->fill);
    bench_table_section(m->table, "push");
    BENCH_ROW(m->table, CELL("pushes", pushes), CELL("cycles", cycles), CELL("cycles_push", cell_share(cycles, pushes)),
              CELL("instructions_push", cell_share(m->fill.instructions, pushes)),
              CELL("references", m->result.spe[0].report.grid.references));
    return true;
}

static bool run_assignments(session *m)
{
    static const unsigned spes[] = {1, 2, 4, 6, 8};
    const cgt_cell_frame_result *const r = &m->result;
    bench_table_section(m->table, "assignment");
    for (unsigned k = 0; k < CGT_ASSIGNMENTS * sizeof spes / sizeof spes[0]; k++) {
        uint64_t idle = 0, messages = 0;
        m->options.cell.spes = spes[k / CGT_ASSIGNMENTS];
        m->options.cell.assignment = (cgt_assignment)(k % CGT_ASSIGNMENTS);
        if (!run(m))
            return false;
        for (unsigned i = 0; i < m->options.cell.spes; i++) {
            idle += r->spe[i].idle;
            messages += r->spe[i].messages;
        }
        BENCH_ROW(m->table, CELL("spes", m->options.cell.spes),
                  CELL("assignment", cell_assignments[m->options.cell.assignment]), CELL("cycles", r->cycles),
                  CELL("idle_percent", 100 * cell_share(idle, r->cycles * m->options.cell.spes)),
                  CELL("messages", messages));
    }
    m->options.cell.spes = 1;
    m->options.cell.assignment = (cgt_assignment)0;
    return true;
}

/* Rays from hits. */
static bool run_light(session *m)
{
    static const cgt_grid_light lights[] = {{.shadow = true, .position = {1, 3, 4}},
                                            {.ambient = 1},
                                            {.ambient = 8},
                                            {.ambient = 8, .radius = 0.25f},
                                            {.shadow = true, .position = {1, 3, 4}, .ambient = 8}};
    if (!run(m))
        return false;
    const uint64_t before = m->result.cycles;
    bool done = true;
    m->options.occluded = m->occluded;
    bench_table_section(m->table, "light");
    for (unsigned k = 0; k < sizeof lights / sizeof lights[0] && done; k++) {
        m->options.light = &lights[k];
        done = run(m);
        const uint32_t rays = m->result.spe[0].report.grid.light_rays;
        if (done)
            BENCH_ROW(m->table, CELL("shadow", lights[k].shadow), CELL("ambient", lights[k].ambient),
                      CELL("radius", lights[k].radius), CELL("cycles", m->result.cycles), CELL("rays", rays),
                      CELL("cycles_ray", cell_share(m->result.cycles - before, rays)),
                      CELL("doubts", m->result.light_doubts), CELL("pixels_of_ppe", m->result.light_pixels));
    }
    m->options.light = NULL;
    m->options.occluded = NULL;
    return done;
}

/* What the frame moves, with ports of main memory from 25.6 GB/s down. */
static bool run_memory(session *m)
{
    static const uint32_t ports[] = {8, 4, 2, 1};
    cgt_mfc_timing timing = cgt_mfc_default_timing;
    bool done = true;
    bench_table_section(m->table, "memory");
    m->options.cell.timing = &timing;
    m->options.cell.spes = 6;
    for (unsigned k = 0; k < sizeof ports / sizeof ports[0] && done; k++) {
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
        BENCH_ROW(m->table, CELL("spes", m->options.cell.spes), CELL("port_gb_s", ports[k] * CLOCK / 1e9),
                  CELL("cycles", m->result.cycles), CELL("frames_s", 1 / seconds), CELL("bytes_in", in),
                  CELL("bytes_out", out), CELL("gb_s", (double)(in + out) / seconds / 1e9),
                  CELL("port_percent", 100 * cell_share(in + out, m->result.cycles * ports[k])),
                  CELL("wait_percent", 100 * cell_share(waits, m->result.cycles * m->options.cell.spes)));
    }
    m->options.cell.timing = NULL;
    m->options.cell.spes = 1;
    return done;
}

/* Cycles that all SPEs together wait, split: for DMA, a place in its queue, mailboxes, signals. */
static bool waits_row(session *m)
{
    cgt_spe_waits sum = {0};
    const cgt_cell_frame_options *const o = &m->options.cell;
    if (!run(m))
        return false;
    for (unsigned i = 0; i < o->spes; i++) {
        sum.dma += m->result.spe[i].waited.dma;
        sum.queue += m->result.spe[i].waited.queue;
        sum.mailbox += m->result.spe[i].waited.mailbox;
        sum.signal += m->result.spe[i].waited.signal;
    }
    BENCH_ROW(m->table, CELL("spes", o->spes), CELL("assignment", cell_assignments[o->assignment]),
              CELL("ppe_cycles", o->ppe_cycles), CELL("cycles", m->result.cycles), CELL("dma", sum.dma),
              CELL("queue", sum.queue), CELL("mailbox", sum.mailbox), CELL("signal", sum.signal));
    return true;
}

/* By number of SPEs and assignment; then with a slow PPE: when the next strip's number no longer comes in time. */
static bool run_waits(session *m)
{
    static const uint32_t cycles[] = {20000, 200000, 500000, 1000000};
    bool done = true;
    bench_table_section(m->table, "waits");
    m->options.cell.ppe_cycles = CGT_PPE_CYCLES;
    for (unsigned k = 0; k < 2 * CGT_ASSIGNMENTS && done; k++) {
        m->options.cell.spes = k < CGT_ASSIGNMENTS ? 1 : 6;
        m->options.cell.assignment = (cgt_assignment)(k % CGT_ASSIGNMENTS);
        done = waits_row(m);
    }
    bench_table_section(m->table, "ppe");
    for (unsigned k = 0; k < 2 * sizeof cycles / sizeof cycles[0] && done; k++) {
        m->options.cell.spes = 6;
        m->options.cell.assignment = k % 2 ? CGT_ASSIGN_HYBRID : CGT_ASSIGN_DYNAMIC;
        m->options.cell.ppe_cycles = cycles[k / 2];
        done = waits_row(m);
    }
    return done;
}

/* ---- sessions ---- */

static bool begin(session *m, bench_table *table, const bench_settings *s, const cell_programs *programs,
                  uint32_t spheres)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    char message[CGT_PPE_MESSAGE_BYTES] = "out of memory";
    *m = (session){.table = table, .width = s->width, .height = s->height};
    m->options = (cgt_grid_frame_options){.cell = {.spes = 1,
                                                   .elf = programs->elf,
                                                   .elf_bytes = programs->elf_bytes,
                                                   .cycle_limit = s->cycles,
                                                   .inspect = inspect,
                                                   .user = m},
                                          .cull = CGT_CULL_FRUSTUM};
    cgt_sphere *const sphere = malloc((size_t)spheres * sizeof *sphere);
    m->ids = malloc((size_t)m->width * m->height * sizeof *m->ids);
    m->occluded = malloc((size_t)m->width * m->height * sizeof *m->occluded);
    cgt_result result = sphere && m->ids && m->occluded ? CGT_OK : CGT_ERROR_OUT_OF_MEMORY;
    if (result == CGT_OK) {
        make_spheres(sphere, spheres);
        result = cgt_grid_scene_init(&m->scene, &memory, sphere, spheres, NULL, message);
    }
    free(sphere);
    if (result == CGT_OK)
        return true;
    program_error("%s", message);
    free(m->ids);
    free(m->occluded);
    return false;
}

static void end(session *m)
{
    cgt_grid_scene_release(&m->scene);
    free(m->ids);
    free(m->occluded);
}

/* Spheres of one size, up to as many as local store has room for. */
static bool run_growth(bench_table *table, const bench_settings *s, const cell_programs *programs)
{
    static const uint32_t counts[] = {125, 250, 500, 1000, 1500, CGT_GRID_SPHERES};
    static const unsigned spes[] = {1, 6, 8};
    static session m;
    bool done = true;
    bench_table_section(table, "spheres");
    for (unsigned k = 0; k < 3 * sizeof counts / sizeof counts[0] && done; k++) {
        if (!begin(&m, table, s, programs, counts[k / 3]))
            return false;
        m.options.cell.spes = spes[k % 3];
        done = run(&m);
        if (done)
            BENCH_ROW(table, CELL("spheres", counts[k / 3]), CELL("spes", spes[k % 3]),
                      CELL("build", UINT64_C(40) * m.result.spe[0].report.grid.built), CELL("cycles", m.result.cycles),
                      CELL("frames_s", CLOCK / (double)m.result.cycles));
        end(&m);
    }
    return done;
}

static bool run_profile(session *m)
{
    bench_table_section(m->table, "functions");
    m->profiles = true;
    if (!run(m))
        return false;
    bench_table_section(m->table, "classes");
    cell_class_rows(m->table, &m->counts);
    bench_table_section(m->table, "kernel");
    kernel_row(m);
    return true;
}

bool cell_grid_run(bench_table *table, const bench_settings *s, const cell_programs *programs)
{
    static const struct {
        const char *name;
        bool (*run)(session *m);
    } sections[] = {{"kernel", run_kernels},         {"push", run_push},  {"light", run_light}, {"memory", run_memory},
                    {"assignment", run_assignments}, {"waits", run_waits}};
    static session m;
    bool done = begin(&m, table, s, programs, s->spheres), known = !s->section || !strcmp(s->section, "spheres");
    if (!done)
        return false;
    if (s->profile)
        done = known = run_profile(&m);
    for (unsigned k = 0; k < sizeof sections / sizeof sections[0] && done && !s->profile; k++)
        if (!s->section || strcmp(s->section, sections[k].name) == 0) {
            known = true;
            done = sections[k].run(&m);
        }
    end(&m);
    if (done && !s->profile && (!s->section || strcmp(s->section, "spheres") == 0))
        done = run_growth(table, s, programs);
    if (!known)
        program_error("--section: kernel, push, light, memory, assignment, waits or spheres, not %s", s->section);
    return done && known;
}
