/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * From the light of a pixel's rays to the pixel: sRGB, opacity, linear values with depth and primitive. Inline: these
 * are the loops of plain pictures. */
#ifndef DRAW_STORE_H
#define DRAW_STORE_H

#include <math.h>
#include <string.h>

#include "picture/draw/draw.h"

/* The rays of a pixel. */
typedef struct pixel_sum {
    float all[3], hits[3]; /* light of all rays, of those with a hit */
    uint32_t count;        /* of those with a hit */
    float depth;           /* of the nearest hit, and what it is on */
    uint32_t id;
} pixel_sum;

static inline void draw_store(const drawing *d, const pixel_sum *sum, size_t pixel)
{
    const draw_settings *s = &d->settings;
    const srgb_tables *tables = d->tables;
    const float share = d->share, count = (float)sum->count;
    /* Alpha is not premultiplied: the colour of a transparent pixel is that of its hits. */
    const int shows_hits = s->transparent && sum->count;
    float color[3], shown[3];
    uint8_t *rgb = d->rgb + 3 * pixel;
    for (int c = 0; c < 3; c++) {
        color[c] = sum->all[c] * share;
        shown[c] = shows_hits ? sum->hits[c] / count : color[c];
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = srgb_encode(tables, shown[c]);
    if (d->alpha)
        d->alpha[pixel] = (uint8_t)(255.0f * count * share + 0.5f);
    if (!d->pixels)
        return;
    image_pixel *to = &d->pixels[pixel];
    *to = (image_pixel){color[0], color[1], color[2], sum->depth, sum->id, 1.0f};
    if (!s->transparent)
        return;
    to->r = sum->hits[0] * share; /* linear values are premultiplied */
    to->g = sum->hits[1] * share;
    to->b = sum->hits[2] * share;
    to->a = count * share;
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

/* Stores pixels whose rays hit nothing. Nothing is read back from the picture, which is seldom in cache. */
static inline void draw_fill_background(const drawing *d, size_t first, uint32_t pixels)
{
    const float *const back = d->settings.background;
    image_pixel none = {0.0f, 0.0f, 0.0f, INFINITY, CGT_INVALID_ID, 0.0f};
    uint8_t rgb[3];
    for (int c = 0; c < 3; c++)
        rgb[c] = srgb_encode(d->tables, back[c]);
    for (uint32_t i = 0; i < pixels; i++)
        memcpy(d->rgb + 3 * (first + i), rgb, sizeof rgb);
    if (d->alpha)
        memset(d->alpha + first, 0, pixels);
    if (!d->settings.transparent)
        none = (image_pixel){back[0], back[1], back[2], INFINITY, CGT_INVALID_ID, 1.0f};
    for (uint32_t i = 0; i < pixels && d->pixels; i++)
        d->pixels[first + i] = none;
}

#endif
