/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures, shaded tile by tile. */
#include "rays/bench_shade.h"
#include "system/system.h"

#include <stdlib.h>
#include <string.h>

int bench_picture_create(bench_picture *picture, uint32_t width, uint32_t height)
{
    const size_t bytes = ((size_t)width * height * sizeof(uint32_t) + 63) / 64 * 64;
    *picture = (bench_picture){width, height, system_allocate_aligned(64, bytes)};
    if (!picture->rgba)
        return -1;
    memset(picture->rgba, 0, bytes); /* the first frame does not pay for page faults */
    return 0;
}

void bench_picture_release(bench_picture *picture)
{
    system_free_aligned(picture->rgba);
    *picture = (bench_picture){0};
}

BENCH_CLONES
static void shade_row(uint32_t *restrict to, const uint32_t *primitive, const float *x, const float *y, const float *z,
                      uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        to[i] = bench_shade(primitive[i], x[i], y[i], z[i]);
}

cgt_visit bench_shade_tile(void *picture, const cgt_tile *tile)
{
    const bench_picture *p = picture;
    for (uint32_t j = 0; j < tile->height; j++) {
        const size_t row = j * tile->row_stride;
        uint32_t *to = p->rgba + (size_t)(tile->y + j) * p->width + tile->x;
        shade_row(to, tile->primitive + row, tile->normal[0] + row, tile->normal[1] + row, tile->normal[2] + row,
                  tile->width);
    }
    return CGT_VISIT_CONTINUE;
}
