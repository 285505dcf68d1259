/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See frame_points.h. */
#include "trace/frame_points.h"

#include <string.h>

#define BLOCK CGT_SHADOW_BLOCK
#define WHOLE_BLOCK 0xffffu

void cgt_frame_points_store(const cgt_frame_source *s, uint32_t x0, uint32_t y0, const cgt_frame_points *p,
                            uint8_t *plane)
{
    const cgt_frame *f = s->frame;
    const uint32_t width = f->width - x0 < CGT_SHADOW_TILE ? f->width - x0 : CGT_SHADOW_TILE;
    const uint8_t *from = p->batch.occluded;
    uint8_t *to = plane + (size_t)y0 * s->row_stride + x0;
    for (uint32_t y = 0; y < CGT_SHADOW_TILE && y0 + y < f->height; y++)
        memset(to + y * s->row_stride, 0, width);
    for (uint32_t k = 0; k < p->blocks; k++) {
        const uint32_t corner = p->block[k].corner;
        uint8_t *pixel = to + corner / CGT_SHADOW_TILE * s->row_stride + corner % CGT_SHADOW_TILE;
        uint32_t live = p->block[k].live;
        for (uint32_t row = 0; live == WHOLE_BLOCK && row < BLOCK; row++, from += BLOCK)
            memcpy(pixel + row * s->row_stride, from, BLOCK);
        for (live = live == WHOLE_BLOCK ? 0 : live; live; live &= live - 1) {
            const uint32_t i = (uint32_t)__builtin_ctz(live);
            pixel[i / BLOCK * s->row_stride + i % BLOCK] = *from++;
        }
    }
}
