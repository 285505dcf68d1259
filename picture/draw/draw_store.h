/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the light of a pixel's rays to the pixel: sRGB, opacity, linear values with depth and primitive. Inline: these
 * are the loops of plain pictures. */
#ifndef DRAW_STORE_H
#define DRAW_STORE_H

#include <math.h>
#include <string.h>

#include "color/srgb.h"
#include "draw/draw.h"

/* The rays of a pixel. */
typedef struct pixel_sum {
    float all[3], hits[3]; /* light of all rays, of those with a hit */
    uint32_t count;        /* of those with a hit, */
    float cover;           /* and how much they cover, at most as much */
    float depth;           /* of the nearest hit, and what it is on */
    uint32_t id;
} pixel_sum;

static inline uint8_t *draw_bytes(const drawing *d, uint32_t x, uint32_t y)
{
    return d->image.bytes + y * d->image.row_stride + (size_t)x * d->image.channels;
}

static inline void draw_store(const drawing *d, const pixel_sum *sum, uint32_t x, uint32_t y)
{
    const srgb_table *srgb = d->srgb;
    const float share = d->share, cover = sum->cover;
    /* Alpha is not premultiplied: the colour of a transparent pixel is that of its hits. */
    const int shows_hits = d->options->style.transparent && sum->count;
    const uint8_t alpha = d->options->style.transparent ? (uint8_t)(255.0f * cover * share + 0.5f) : 255;
    const size_t pixel = (size_t)y * d->options->width + x;
    float color[3], shown[3];
    for (int c = 0; c < 3; c++) {
        color[c] = sum->all[c] * share;
        shown[c] = shows_hits ? sum->hits[c] / cover : color[c];
    }
    if (d->image.bytes) {
        uint8_t *const bytes = draw_bytes(d, x, y);
        for (int c = 0; c < 3; c++)
            bytes[c] = srgb_encode(srgb, shown[c]);
        if (d->image.channels == 4)
            bytes[3] = alpha;
    }
    if (d->image.alpha)
        d->image.alpha[pixel] = alpha;
    if (!d->image.linear)
        return;
    cgt_linear_pixel *to = &d->image.linear[pixel];
    *to = (cgt_linear_pixel){color[0], color[1], color[2], sum->depth, sum->id, 1.0f};
    if (!d->options->style.transparent)
        return;
    to->r = sum->hits[0] * share; /* linear values are premultiplied */
    to->g = sum->hits[1] * share;
    to->b = sum->hits[2] * share;
    to->a = cover * share;
}

/* Whether no ray of some pixels hits anything: of `width` rays in each of `height` rows, `stride` apart. CGT_INVALID_ID
 * is all ones. */
static inline int draw_is_background(const uint32_t *primitive, size_t stride, uint32_t width, uint32_t height)
{
    uint32_t combined = CGT_INVALID_ID;
    for (uint32_t row = 0; row < height; row++)
        for (uint32_t i = 0; i < width; i++)
            combined &= primitive[row * stride + i];
    return combined == CGT_INVALID_ID;
}

/* Four pixels at a time. */
static inline void draw_fill_rgb(uint8_t *to, const uint8_t pixel[3], uint32_t pixels)
{
    uint8_t four[12];
    for (int i = 0; i < 12; i++)
        four[i] = pixel[i % 3];
    for (; pixels >= 4; pixels -= 4, to += 12)
        memcpy(to, four, 12);
    for (uint32_t i = 0; i < pixels; i++)
        memcpy(to + 3 * (size_t)i, pixel, 3);
}

/* Stores pixels of a row whose rays hit nothing. Nothing is read back from the picture, which is seldom in cache. */
static inline void draw_fill_background(const drawing *d, uint32_t x, uint32_t y, uint32_t pixels)
{
    const float *const back = d->options->style.background;
    const size_t first = (size_t)y * d->options->width + x, channels = d->image.channels;
    cgt_linear_pixel none = {0.0f, 0.0f, 0.0f, INFINITY, CGT_INVALID_ID, 0.0f};
    const uint8_t alpha = d->options->style.transparent ? 0 : 255;
    uint8_t bytes[4] = {0, 0, 0, alpha}, *const to = d->image.bytes ? draw_bytes(d, x, y) : NULL;
    for (int c = 0; c < 3; c++)
        bytes[c] = srgb_encode(d->srgb, back[c]);
    if (to && channels == 3)
        draw_fill_rgb(to, bytes, pixels);
    for (uint32_t i = 0; i < pixels && to && channels == 4; i++)
        memcpy(to + 4 * (size_t)i, bytes, 4);
    if (d->image.alpha)
        memset(d->image.alpha + first, alpha, pixels);
    if (!d->options->style.transparent)
        none = (cgt_linear_pixel){back[0], back[1], back[2], INFINITY, CGT_INVALID_ID, 1.0f};
    for (uint32_t i = 0; i < pixels && d->image.linear; i++)
        d->image.linear[first + i] = none;
}

#endif
