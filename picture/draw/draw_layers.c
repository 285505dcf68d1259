/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Something transparent in front, such as a mesh among spheres: a picture is made without it, then with it, and the two
 * are mixed, so that what lies behind its nearest side shines through. It casts no shadows on what is seen through
 * it. */
#include <stdlib.h>

#include "color/srgb.h"
#include "draw/draw_store.h"

/* Mixes the picture with the one behind; depth and primitive stay those in front. */
static void mix(const drawing *d, const cgt_image *from)
{
    const float share = d->options->style.front;
    const uint32_t width = d->options->width;
    const size_t first = (size_t)d->options->work.first_row * width, count = (size_t)d->options->work.row_count * width;
    for (size_t i = first; i < first + count; i++) {
        uint8_t *const bytes = d->image.bytes ? draw_bytes(d, (uint32_t)(i % width), (uint32_t)(i / width)) : NULL;
        uint8_t *const alpha = d->image.alpha ? &d->image.alpha[i] : bytes && d->image.channels == 4 ? bytes + 3 : NULL;
        const uint8_t *const from_bytes = from->bytes + 4 * i;
        const float front = alpha ? share * (float)*alpha : share,
                    back = (1.0f - share) * (alpha ? (float)from_bytes[3] : 1.0f);
        for (int c = 0; c < 3 && bytes && front + back > 0.0f; c++) {
            const float ours = cgt_srgb_decode(bytes[c]), theirs = cgt_srgb_decode(from_bytes[c]);
            bytes[c] = srgb_encode(d->srgb, (front * ours + back * theirs) / (front + back));
        }
        if (alpha)
            *alpha = (uint8_t)(front + back + 0.5f);
        if (alpha && bytes && d->image.channels == 4)
            bytes[3] = *alpha;
        if (d->image.linear) {
            cgt_linear_pixel *p = &d->image.linear[i];
            p->r = share * p->r + (1.0f - share) * from->linear[i].r;
            p->g = share * p->g + (1.0f - share) * from->linear[i].g;
            p->b = share * p->b + (1.0f - share) * from->linear[i].b;
            p->a = share * p->a + (1.0f - share) * from->linear[i].a;
        }
    }
}

cgt_result cgt_draw_layers(drawing *front, drawing *behind)
{
    const size_t pixels = (size_t)front->options->width * front->options->height;
    const size_t linear = front->image.linear ? pixels * sizeof *front->image.linear : 0;
    char *const memory = malloc(linear + 4 * pixels);
    if (!memory)
        return CGT_ERROR_OUT_OF_MEMORY;
    behind->image = (cgt_image){.bytes = (uint8_t *)memory + linear,
                                .channels = 4,
                                .row_stride = (size_t)4 * front->options->width,
                                .linear = linear ? (cgt_linear_pixel *)(void *)memory : NULL};
    cgt_result result = cgt_draw_shade(behind);
    if (result == CGT_OK)
        result = cgt_draw_shade(front);
    if (result == CGT_OK)
        mix(front, &behind->image);
    free(memory);
    return result;
}
