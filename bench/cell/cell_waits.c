/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Waits of SPEs, see cell_waits.h. */
#include "cell/cell_waits.h"

#include "common/program.h"

#define WIDTH 320u
#define HEIGHT 180u

static const char *const assignments[CGT_ASSIGNMENTS] = {"interleaved", "static", "dynamic", "hybrid"};

static bool put_row(bench_table *table, const cgt_grid_scene *scene, const cgt_grid_frame_options *o)
{
    static uint32_t ids[WIDTH * HEIGHT];
    static cgt_cell_frame_result r;
    cgt_spe_waits sum = {0};
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 3;
    if (cgt_grid_frame_trace(scene, &camera, WIDTH, HEIGHT, o, ids, &r) != CGT_OK) {
        program_error("%s", r.message);
        return false;
    }
    for (unsigned i = 0; i < o->cell.spes; i++) {
        sum.dma += r.spe[i].waited.dma;
        sum.queue += r.spe[i].waited.queue;
        sum.mailbox += r.spe[i].waited.mailbox;
        sum.signal += r.spe[i].waited.signal;
    }
    bench_table_count(table, "spes", o->cell.spes);
    bench_table_text(table, "assignment", assignments[o->cell.assignment]);
    bench_table_count(table, "ppe_cycles", o->cell.ppe_cycles);
    bench_table_count(table, "cycles", r.cycles);
    bench_table_count(table, "dma", sum.dma);
    bench_table_count(table, "queue", sum.queue);
    bench_table_count(table, "mailbox", sum.mailbox);
    bench_table_count(table, "signal", sum.signal);
    bench_table_end_row(table);
    return true;
}

bool cell_waits_run(bench_table *table, const cgt_grid_scene *scene, const cgt_grid_frame_options *options)
{
    static const unsigned spes[] = {1, 6};
    static const uint32_t cycles[] = {20000, 200000, 500000, 1000000};
    cgt_grid_frame_options o = *options;
    bench_table_section(table, "waits");
    o.cell.ppe_cycles = CGT_PPE_CYCLES;
    for (unsigned k = 0; k < sizeof spes / sizeof spes[0]; k++)
        for (int a = 0; a < CGT_ASSIGNMENTS; a++) {
            o.cell.spes = spes[k];
            o.cell.assignment = (cgt_assignment)a;
            if (!put_row(table, scene, &o))
                return false;
        }
    bench_table_section(table, "ppe"); /* a slow one: when the next strip's number no longer comes in time */
    o.cell.spes = 6;
    for (unsigned k = 0; k < 2 * sizeof cycles / sizeof cycles[0]; k++) {
        o.cell.assignment = k % 2 ? CGT_ASSIGN_HYBRID : CGT_ASSIGN_DYNAMIC;
        o.cell.ppe_cycles = cycles[k / 2];
        if (!put_row(table, scene, &o))
            return false;
    }
    return true;
}
