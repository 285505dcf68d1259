/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Chapman's tracer, a program of an SPE: the scene and its grid are in local store; every SPE builds the whole grid
 * each frame (the mirrored model of his section 3.4) and traces strips of four scanlines in packets of 4x4 rays. While
 * a strip is traced, the ids of the one before go to the frame. The same source is compiled for the host.
 *
 * Ids are final but for the doubts (grid_doubts.h): a ray's nearest sphere is the one stored or one of its doubts,
 * since any other one was certainly missed, certainly beyond a certain hit, or replaced by a hit that is certainly
 * nearer. */
#include "cell/programs/grid/grid_build.h"
#include "cell/programs/grid/grid_check.h"
#include "cell/programs/grid/grid_light.h"
#include "cell/programs/grid/grid_rays.h"

/* ---- setting up ---- */

static int grid_report(uint32_t state, uint32_t value)
{
    s()->report.state = state;
    s()->report.value = value;
    mfc_put(&s()->report, grid_ea(s()->control.report), sizeof s()->report, TAG_SETUP, 0, 0);
    grid_wait(TAG_SETUP);
    return state != CGT_REPORT_DONE;
}

static void grid_begin_get(void *to, uint64_t ea, uint32_t bytes)
{
    for (uint32_t at = 0; at < bytes; at += 16384)
        mfc_get((char *)to + at, ea + at, bytes - at < 16384 ? bytes - at : 16384, TAG_SETUP, 0, 0);
}

static void grid_get(void *to, uint64_t ea, uint32_t bytes)
{
    grid_begin_get(to, ea, bytes);
    grid_wait(TAG_SETUP);
}

/* Returns the state: DONE where the scene fits. Its spheres are on their way then. */
static uint32_t grid_fetch(void)
{
    const cgt_control_block *c = &s()->control;
    const cgt_grid_image *g = &s()->scene;
    grid_begin_get(&s()->camera, grid_ea(c->camera), sizeof s()->camera);
    s()->light.sets = 0;
    if (grid_ea(c->light))
        grid_begin_get(&s()->light, grid_ea(c->light), sizeof s()->light);
    grid_get(&s()->scene, grid_ea(c->scene), sizeof s()->scene);
    if (!grid_check_images(g, &s()->camera) || s()->light.sets > CGT_LIGHT_SETS)
        return CGT_REPORT_BAD_IMAGE;
    if (g->spheres > CGT_GRID_SPHERES)
        return CGT_REPORT_SPHERES;
    for (uint32_t a = 0, cells = 1; a < 3; a++) {
        if (g->resolution[a] == 0 || g->resolution[a] > CGT_GRID_MAX_EDGE)
            return CGT_REPORT_CELLS;
        cells *= g->resolution[a];
        if (cells > CGT_GRID_CELLS)
            return CGT_REPORT_CELLS;
    }
    grid_begin_get(s()->sphere, grid_ea(g->objects), (g->spheres + 7) / 8 * 128);
    return CGT_REPORT_DONE;
}

static void grid_init(void)
{
    const cgt_control_block *const c = &s()->control;
    s()->doubts = (spe_doubts){.ea = {c->doubts[0], c->doubts[1]}, .capacity = c->half, .tag = TAG_DOUBT0};
    s()->class = 0;
    memset(s()->counts, 0, sizeof s()->counts);
    for (int a = 0; a < 3; a++)
        s()->sphere[CGT_GRID_SPHERES][a] = 0;
    s()->sphere[CGT_GRID_SPHERES][3] = -1;
    for (uint32_t k = 0; k < GRID_CLASSES; k++)
        grid_axes_init(k, &s()->axes[k]);
    for (int a = 0; a < 3; a++)
        s()->frustum.org[a] = spu_splats(s()->camera.eye[a]);
    s()->frustum.org_reach = spu_splats(0.f);
    memset(s()->origin, 0, sizeof s()->origin);
}

/* ---- strips: offsets within the planes stay below 2^32 (ppe/grid/grid_frame.c, grid_light.c) ---- */

static void grid_get_columns(uint32_t x, uint32_t columns, uint32_t buffer)
{
    const uint32_t count = columns < CHUNK ? (columns + 3) / 4 * 4 : CHUNK;
    mfc_get(s()->column[buffer], grid_ea(s()->control.columns) + 16 * x, 16 * count, TAG_COLUMN0 + buffer, 0, 0);
}

/* Sends the bits of a chunk's rays from hits. */
static void grid_put_occluded(uint32_t x, uint32_t packets, uint32_t buffer)
{
    const cgt_control_block *c = &s()->control;
    const uint32_t words = (s()->light.sets + 1) / 2, bytes = (4 * words * packets + 15) / 16 * 16;
    mfc_put(s()->occluded[buffer],
            grid_ea(c->occluded) + s()->y / CGT_STRIP_ROWS * c->occluded_bytes + x / 4 * 4 * words, bytes,
            TAG_LIGHT0 + buffer, 0, 0);
}

/* The packets of CHUNK columns at most; x is the first. `at`: its place in the line's buffer. */
static void grid_trace_chunk(uint32_t x, uint32_t at, uint32_t columns, uint32_t rows, uint32_t buffer, uint32_t line)
{
    grid_packet *const p = &s()->packet;
    const uint32_t sets = s()->light.sets;
    if (GRID_RARELY(sets))
        grid_wait(TAG_LIGHT0 + buffer);
    for (uint32_t k = 0; k < columns; k += 4) {
        grid_make_rays((const vec_float4 *)(const void *)s()->column[buffer] + k, columns - k, rows, p);
        s()->x = x + k;
        grid_trace_camera(p);
        for (uint32_t y = 0; y < CGT_STRIP_ROWS; y++)
            *GRID_QUADWORD(vec_uint4, s()->line[line][y] + at + k) = p->prim[y];
        if (GRID_RARELY(sets))
            grid_trace_light(p, s()->occluded[buffer] + k / 4 * ((sets + 1) / 2));
    }
    if (GRID_RARELY(sets))
        grid_put_occluded(x, (columns + 3) / 4, buffer);
}

/* Sends the ids of a piece of the strip, scanline by scanline. */
static void grid_put_piece(uint32_t x, uint32_t columns, uint32_t rows, uint32_t line)
{
    const cgt_control_block *c = &s()->control;
    for (uint32_t y = 0; y < rows; y++)
        mfc_put(s()->line[line][y], grid_ea(c->ids) + (s()->y + y) * c->row_bytes + 4 * x, (columns + 3) / 4 * 16,
                TAG_LINE0 + line, 0, 0);
}

/* Traces a strip, piece by piece; each is sent while the next one is traced. */
static void grid_trace_strip(uint32_t strip)
{
    const cgt_control_block *c = &s()->control;
    const uint32_t x0 = strip % c->strip_columns * CGT_STRIP_WIDTH, y0 = strip / c->strip_columns * CGT_STRIP_ROWS;
    const uint32_t columns = c->width - x0 < CGT_STRIP_WIDTH ? c->width - x0 : CGT_STRIP_WIDTH;
    const uint32_t rows = c->height - y0 < CGT_STRIP_ROWS ? c->height - y0 : CGT_STRIP_ROWS;
    mfc_get(s()->row, grid_ea(c->rows) + 16 * y0, sizeof s()->row, TAG_SETUP, 0, 0);
    grid_get_columns(x0, columns, 0);
    grid_wait(TAG_SETUP);
    grid_splat_rows();
    s()->y = y0;
    for (uint32_t x = 0, buffer = 0; x < columns; x += CHUNK, buffer ^= 1) {
        const uint32_t at = x % CGT_STRIP_PIECE, line = x / CGT_STRIP_PIECE & 1,
                       end = columns - x < CHUNK ? columns : x + CHUNK;
        if (at == 0)
            grid_wait(TAG_LINE0 + line);
        grid_wait(TAG_COLUMN0 + buffer);
        if (end < columns)
            grid_get_columns(x0 + end, columns - end, buffer ^ 1);
        grid_trace_chunk(x0 + x, at, end - x, rows, buffer, line);
        if (end % CGT_STRIP_PIECE == 0 || end == columns)
            grid_put_piece(x0 + x - at, end - x + at, rows, line);
    }
    s()->report.strips++;
}

static void grid_trace_strips(void)
{
    const cgt_control_block *c = &s()->control;
    const uint32_t strips = grid_count_strips(c);
    for (uint32_t k = 0, strip = c->first; k < c->strips && strip < strips; k++, strip += c->step)
        grid_trace_strip(strip);
    if (c->flags & CGT_CONTROL_MAILBOX)
        for (;;) {
            const uint32_t strip = spu_read_in_mbox();
            if (strip >= strips) /* CGT_STRIP_END is */
                break;
            spu_write_out_mbox(strip);
            grid_trace_strip(strip);
        }
    mfc_write_tag_mask(1u << TAG_LINE0 | 1u << TAG_LINE1 | 1u << TAG_LIGHT0 | 1u << TAG_LIGHT1);
    mfc_read_tag_status_all();
}

static void grid_report_counts(void)
{
    cgt_spe_report *const r = &s()->report;
    r->packets = spu_extract(s()->counts[COUNT_PACKETS], 0);
    r->cells = spu_extract(s()->counts[COUNT_CELLS], 0);
    r->tests = spu_extract(s()->counts[COUNT_TESTS], 0);
    r->remembered = spu_extract(s()->counts[COUNT_REMEMBERED], 0);
    r->listed = spu_extract(s()->counts[COUNT_LISTED], 0);
    r->light_rays = spu_extract(s()->counts[COUNT_LIGHT], 0);
    r->culled = r->listed - r->tests - r->remembered;
}

CGT_SPE_MAIN(spe_grid)
{
    memset(&s()->report, 0, sizeof s()->report);
    grid_get(&s()->control, argument, sizeof s()->control);
    if (!grid_check_control(&s()->control))
        return grid_report(CGT_REPORT_BAD_CONTROL, 0);
    const uint32_t state = grid_fetch();
    if (state != CGT_REPORT_DONE)
        return grid_report(state, state == CGT_REPORT_SPHERES ? CGT_GRID_SPHERES : CGT_GRID_CELLS);
    spu_write_decrementer(0xffffffff);
    grid_init();
    if (!grid_build())
        return grid_report(CGT_REPORT_OVERFLOW, CGT_GRID_OVERFLOW);
    s()->report.built = 0xffffffff - spu_read_decrementer();
    grid_trace_strips();
    s()->report.traced = 0xffffffff - spu_read_decrementer() - s()->report.built;
    grid_report_counts();
    grid_end_doubts();
    return grid_report(CGT_REPORT_DONE, 0);
}
