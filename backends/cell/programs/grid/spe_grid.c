/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Chapman's tracer, a program of an SPE: the scene and its grid are in local store; every SPE builds the whole grid each
 * frame (the mirrored model of his section 3.4) and traces strips of four scanlines in packets of 4x4 rays. While a
 * strip is traced, the ids of the one before go to the frame. Kernels are the library's, in its row `spu`; the same
 * source is compiled for the host.
 *
 * Ids are final but for the doubts (grid_doubts.h): a ray's nearest sphere is the one stored or one of its doubts, since
 * any other one was certainly missed, certainly beyond a certain hit, or replaced by a hit that is certainly nearer. */
#include "cell/programs/grid/grid_store.h"

static void grid_add_doubt(uint32_t i, uint32_t object);

/* the kernels themselves: one translation unit, so that what the program does not need goes */
#include "kernel/builders/queue_grid_fill.c" /* NOLINT(bugprone-suspicious-include) */
#include "kernel/grid/queue_grid_traverse.c" /* NOLINT(bugprone-suspicious-include) */

#include "cell/programs/grid/grid_check.h"
#include "cell/programs/grid/grid_doubts.h"
#include "cell/programs/grid/grid_rays.h"

/* What the kernels see of the store. */
typedef struct grid_world {
    cgt_primitive_array array;
    cgt_committed_scene scene;
    cgt_trace_settings settings;
    cgt_counts counts;
    packet packet;
    _Alignas(CGT_ALIGNMENT) char scratch[CGT_SCRATCH_BYTES];
} grid_world;

_Static_assert(2 * sizeof(traversal) + sizeof(packet_part) + (PACKET_MAX_RAYS + 5 * 16) * sizeof(uint32_t) <=
                   CGT_SCRATCH_BYTES,
               "the scratch holds a packet and a part of it");

/* ---- setting up ---- */

static int grid_report(uint32_t state, uint32_t value)
{
    s()->report.state = state;
    s()->report.value = value;
    mfc_put(&s()->report, grid_ea(s()->control.report), sizeof s()->report, TAG_SETUP, 0, 0);
    grid_wait(TAG_SETUP);
    return state != CGT_REPORT_DONE;
}

static void grid_get(void *to, uint64_t ea, uint32_t bytes)
{
    for (uint32_t at = 0; at < bytes; at += 16384)
        mfc_get((char *)to + at, ea + at, bytes - at < 16384 ? bytes - at : 16384, TAG_SETUP, 0, 0);
    grid_wait(TAG_SETUP);
}

/* Returns the state: DONE where the scene fits. */
static uint32_t grid_fetch(void)
{
    const cgt_control_block *c = &s()->control;
    const cgt_grid_image *g = &s()->scene;
    grid_get(&s()->camera, grid_ea(c->camera), sizeof s()->camera);
    grid_get(&s()->scene, grid_ea(c->scene), sizeof s()->scene);
    if (!grid_check_images(g, &s()->camera))
        return CGT_REPORT_BAD_IMAGE;
    if (g->spheres > CGT_GRID_SPHERES)
        return CGT_REPORT_SPHERES;
    for (uint32_t a = 0, cells = 1; a < 3; a++) {
        if (g->resolution[a] == 0 || g->resolution[a] > CGT_GRID_MAX_RESOLUTION)
            return CGT_REPORT_CELLS;
        cells *= g->resolution[a];
        if (cells > CGT_GRID_CELLS)
            return CGT_REPORT_CELLS;
    }
    grid_get(s()->sphere, grid_ea(g->objects), (g->spheres + 7) / 8 * 128);
    return CGT_REPORT_DONE;
}

static void grid_init_world(grid_world *w)
{
    const cgt_grid_image *from = &s()->scene;
    const char *const sphere = (const char *)s()->sphere;
    memset(w, 0, sizeof *w);
    w->array = (cgt_primitive_array){.kind = CGT_KIND_SPHERES,
                                     .mask = UINT32_MAX,
                                     .point = sphere,
                                     .point_stride = 16,
                                     .radius = sphere + 12,
                                     .radius_stride = 16,
                                     .count = from->spheres};
    w->scene.prims =
        (cgt_primitives){.array = &w->array, .arrays = 1, .count = from->spheres, .spheres = from->spheres};
    w->scene.scale = from->scale;
    cgt_queue_grid *const g = &w->scene.grid;
    g->prims = &w->scene.prims;
    for (uint32_t a = 0, stride = 1; a < 3; a++) {
        g->org[a] = from->org[a];
        g->rcell[a] = from->rcell[a];
        g->cell_error[a] = from->cell_error[a];
        g->resolution[a] = from->resolution[a];
        g->stride[a] = stride;
        stride *= from->resolution[a];
        g->cells = stride;
    }
    g->voxel = s()->voxel;
    w->settings.flattened = (s()->control.flags & CGT_CONTROL_FLATTENED) != 0;
    w->settings.cull = (cgt_cull)(s()->control.flags >> CGT_CONTROL_CULL_SHIFT);
    grid_init_packet(&w->packet);
}

/* ---- the grid ---- */

/* By cell; those of a cell in any order. There are few. */
static void grid_sort_overflow(cgt_overflow *entry, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        const cgt_overflow moved = entry[i];
        uint32_t k = i;
        for (; k && entry[k - 1].cell > moved.cell; k--)
            entry[k] = entry[k - 1];
        entry[k] = moved;
    }
}

/* Returns whether it fits. */
static bool grid_build(cgt_queue_grid *g)
{
    cgt_overflow_list overflow = {.entry = s()->overflow, .capacity = CGT_GRID_OVERFLOW};
    cgt_fill_counts counts = {0};
    memset(s()->voxel, 0xff, g->cells * sizeof s()->voxel[0]);
    const uint32_t count = g->prims->count;
    if (count)
        CGT_KERNEL(cgt_queue_grid_fill)(g, 0, count, &overflow, &counts);
    if (overflow.count > CGT_GRID_OVERFLOW)
        return false;
    grid_sort_overflow(s()->overflow, overflow.count);
    g->overflow = s()->overflow;
    g->overflows = overflow.count;
    s()->report.references = (uint32_t)counts.references;
    s()->report.overflow = overflow.count;
    return true;
}

/* ---- strips ---- */

static void grid_get_columns(uint32_t x, uint32_t columns, uint32_t buffer)
{
    const uint32_t count = columns < CHUNK ? (columns + 3) / 4 * 4 : CHUNK;
    mfc_get(s()->column[buffer], grid_ea(s()->control.columns) + 16 * (uint64_t)x, 16 * count, TAG_COLUMN0 + buffer, 0,
            0);
}

/* The packets of CHUNK columns at most; x is the first, seen from the strip's line at `at`. */
static void grid_trace_chunk(grid_world *w, uint32_t x, uint32_t at, uint32_t columns, uint32_t rows, uint32_t buffer,
                             uint32_t line)
{
    packet *const p = &w->packet;
    for (uint32_t k = 0; k < columns; k += 4) {
        grid_make_rays((const float(*)[4])s()->column[buffer] + k, (const float(*)[4])s()->row,
                       columns - k < 4 ? columns - k : 4, rows, p);
        s()->x = x + k;
        if (w->scene.prims.count)
            CGT_KERNEL(cgt_queue_grid_trace)(&w->scene, p, &w->settings, &w->counts);
        for (uint32_t y = 0; y < CGT_STRIP_ROWS; y++)
            spux_store_uint(s()->line[line][y] + at + k, spux_load_uint(p->prim + 4 * y));
    }
}

/* Traces a strip to the buffer `line`, and starts to send it. */
static void grid_trace_strip(grid_world *w, uint32_t strip, uint32_t line)
{
    const cgt_control_block *c = &s()->control;
    const uint32_t x0 = strip % c->strip_columns * CGT_STRIP_WIDTH, y0 = strip / c->strip_columns * CGT_STRIP_ROWS;
    const uint32_t columns = c->width - x0 < CGT_STRIP_WIDTH ? c->width - x0 : CGT_STRIP_WIDTH;
    const uint32_t rows = c->height - y0 < CGT_STRIP_ROWS ? c->height - y0 : CGT_STRIP_ROWS;
    mfc_get(s()->row, grid_ea(c->rows) + 16 * (uint64_t)y0, sizeof s()->row, TAG_SETUP, 0, 0);
    grid_get_columns(x0, columns, 0);
    grid_wait(TAG_SETUP);
    grid_wait(TAG_LINE0 + line);
    s()->y = y0;
    for (uint32_t x = 0, buffer = 0; x < columns; x += CHUNK, buffer ^= 1) {
        grid_wait(TAG_COLUMN0 + buffer);
        if (x + CHUNK < columns)
            grid_get_columns(x0 + x + CHUNK, columns - x - CHUNK, buffer ^ 1);
        grid_trace_chunk(w, x0 + x, x, columns - x < CHUNK ? columns - x : CHUNK, rows, buffer, line);
    }
    for (uint32_t y = 0; y < rows; y++)
        mfc_put(s()->line[line][y], grid_ea(c->ids) + (uint64_t)(y0 + y) * c->row_bytes + 4 * x0,
                (columns + 3) / 4 * 16, TAG_LINE0 + line, 0, 0);
    s()->report.strips++;
}

static void grid_trace_strips(grid_world *w)
{
    const cgt_control_block *c = &s()->control;
    const uint32_t strips = grid_count_strips(c);
    uint32_t line = 0;
    for (uint32_t k = 0, strip = c->first; k < c->strips && strip < strips; k++, strip += c->step, line ^= 1)
        grid_trace_strip(w, strip, line);
    if (c->flags & CGT_CONTROL_MAILBOX)
        for (;; line ^= 1) {
            const uint32_t strip = spu_read_in_mbox();
            if (strip >= strips) /* CGT_STRIP_END is */
                break;
            spu_write_out_mbox(strip);
            grid_trace_strip(w, strip, line);
        }
    grid_wait(TAG_LINE0);
    grid_wait(TAG_LINE1);
}

CGT_SPE_MAIN(spe_grid)
{
    grid_world w;
    memset(s(), 0, offsetof(grid_store, voxel));
    s()->doubts = s()->half_doubts = s()->half = s()->unread = 0;
    grid_get(&s()->control, argument, sizeof s()->control);
    if (!grid_check_control(&s()->control))
        return grid_report(CGT_REPORT_BAD_CONTROL, 0);
    const uint32_t state = grid_fetch();
    if (state != CGT_REPORT_DONE)
        return grid_report(state, state == CGT_REPORT_SPHERES ? CGT_GRID_SPHERES : CGT_GRID_CELLS);
    spu_write_decrementer(0xffffffff);
    grid_init_world(&w);
    w.counts.scratch = cgt_scratch_init(w.scratch);
    if (!grid_build(&w.scene.grid))
        return grid_report(CGT_REPORT_OVERFLOW, CGT_GRID_OVERFLOW);
    s()->report.built = 0xffffffff - spu_read_decrementer();
    grid_trace_strips(&w);
    s()->report.traced = 0xffffffff - spu_read_decrementer() - s()->report.built;
    s()->report.packets = (uint32_t)w.counts.packets;
    s()->report.cells = (uint32_t)w.counts.cells;
    s()->report.culled = (uint32_t)w.counts.culled;
    s()->report.tests = (uint32_t)w.counts.packet_tests;
    grid_end_doubts();
    return grid_report(CGT_REPORT_DONE, 0);
}
