/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The thesis' table of errors between modes of execution (figure 7.6) with a row for the SPEs: how far directions of
 * rays are from those of the PPE, as differences of sizes, axis by axis. Beside the program's own rays stand two ways
 * that the thesis takes: adding up steps from tile to tile, from the picture's corner on a PPE and from each envelope's
 * on an SPE, whose sums are truncated. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cell/kd_run.h"
#include "query/camera.h"

#define MOST_PIXELS (160 * 90)

typedef float directions[MOST_PIXELS][3];

/* The sum as an SPU has it: towards zero. Exact in double for these sizes. */
static float truncated_sum(float a, float b)
{
    const double sum = (double)a + (double)b;
    const float nearest = (float)sum;
    return fabs((double)nearest) > fabs(sum) ? nextafterf(nearest, 0) : nearest;
}

static float nearest_sum(float a, float b) { return a + b; }

/* Directions by steps: each tile's from that of its left neighbour, each row's first from the row above. */
static void add_up(const cgt_camera_rays *c, uint32_t edge, float (*sum)(float, float), directions d)
{
    for (uint32_t top = 0; top < c->height; top += edge)
        for (uint32_t left = 0; left < c->width; left += edge) {
            float org[3], row[3];
            cgt_camera_pixel(c, left, top, org, row);
            for (uint32_t y = top; y < top + edge && y < c->height; y++) {
                float at[3] = {row[0], row[1], row[2]};
                for (uint32_t x = left; x < left + edge && x < c->width; x++)
                    for (int a = 0; a < 3; a++) {
                        d[y * c->width + x][a] = at[a];
                        at[a] = sum(at[a], c->pixel[0] * c->right[a]);
                    }
                for (int a = 0; a < 3; a++)
                    row[a] = sum(row[a], -c->pixel[1] * c->up[a]);
            }
        }
}

/* The cells of a row: the largest differences along each axis. */
static void mode_cells(kd_run *k, const char *mode, const directions canonical, const directions other)
{
    double most[3] = {0};
    uint64_t differ = 0;
    for (uint32_t i = 0; i < k->width * k->height; i++) {
        for (int a = 0; a < 3; a++)
            most[a] = fmax(most[a], fabs(fabs((double)canonical[i][a]) - fabs((double)other[i][a])));
        differ += memcmp(canonical[i], other[i], sizeof canonical[i]) != 0;
    }
    BENCH_CELLS(k->table, CELL("mode", mode), CELL("x", most[0]), CELL("y", most[1]), CELL("z", most[2]),
                CELL("rays_differ", differ));
}

static bool spe_row(kd_run *k, unsigned spes, const char *mode, const directions canonical)
{
    static directions found;
    static uint32_t exact[MOST_PIXELS], raw[MOST_PIXELS];
    uint64_t differ = 0;
    cgt_kd_frame_options o = {.cell = {.spes = spes, .keep_doubts = true}, .tiles_x = 1, .tiles_y = 1};
    if (!kd_run_frame(k, &o, &(cgt_kd_frame_output){.ids = raw}))
        return false;
    o.cell.keep_doubts = false;
    if (!kd_run_frame(k, &o, &(cgt_kd_frame_output){.ids = exact, .direction = found}))
        return false;
    for (uint32_t i = 0; i < k->width * k->height; i++)
        differ += exact[i] != raw[i];
    mode_cells(k, mode, canonical, (const float(*)[3])found);
    BENCH_ROW(k->table, CELL("ids_differ", (double)differ));
    return true;
}

static void host_row(kd_run *k, const char *mode, const directions canonical, const directions other)
{
    mode_cells(k, mode, canonical, other);
    BENCH_ROW(k->table, CELL("ids_differ", (double)NAN));
}

bool kd_run_modes(kd_run *k)
{
    static directions canonical, other;
    char message[CGT_CAMERA_MESSAGE_BYTES];
    const cgt_camera camera = kd_bench_camera();
    cgt_camera_rays rays;
    if (cgt_camera_prepare(&camera, k->width, k->height, &rays, message) != CGT_OK)
        return false;
    for (uint32_t i = 0; i < k->width * k->height; i++) {
        float org[3];
        cgt_camera_pixel(&rays, i % k->width, i / k->width, org, canonical[i]);
    }
    const float(*const right)[3] = (const float(*)[3])canonical;
    if (!spe_row(k, 1, "1 SPE, 1x1 tiles", right) || !spe_row(k, 6, "6 SPEs, 1x1 tiles", right))
        return false;
    add_up(&rays, 4096, nearest_sum, other);
    host_row(k, "PPE, step by step", right, (const float(*)[3])other);
    add_up(&rays, 4096, truncated_sum, other);
    host_row(k, "SPE, step by step", right, (const float(*)[3])other);
    add_up(&rays, 8, truncated_sum, other);
    host_row(k, "SPE, step by step in envelopes of 4x4", right, (const float(*)[3])other);
    return true;
}
