/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Drawing on a finished picture; see canvas.h. */
#include "text/canvas.h"

#include <math.h>
#include <stddef.h>

/* Colours of pixels with an opacity are premultiplied, so one rule is good for all. */
static void blend_linear(cgt_linear_pixel *p, const float color[3], float share)
{
    p->r += share * (color[0] - p->r);
    p->g += share * (color[1] - p->g);
    p->b += share * (color[2] - p->b);
    p->a += share * (1.0f - p->a);
}

/* What is drawn lies over what the alpha leaves of the picture: colours are not premultiplied. */
static void blend_bytes(uint8_t *to, int has_fourth, uint8_t *plane, const float color[3], float share)
{
    uint8_t *const alpha = plane ? plane : to + 3;
    const float under = has_fourth || plane ? (float)*alpha / 255.0f * (1.0f - share) : 1.0f - share;
    const float sum = under + share;
    for (int k = 0; k < 3; k++)
        to[k] = cgt_srgb_encode((cgt_srgb_decode(to[k]) * under + color[k] * share) / sum);
    if (has_fourth || plane)
        *alpha = (uint8_t)(255.0f * sum + 0.5f);
    if (has_fourth && plane)
        to[3] = *plane;
}

void cgt_canvas_blend(const canvas *c, int32_t x, int32_t y, const float color[3], float coverage)
{
    if (x < 0 || y < 0 || (uint32_t)x >= c->width || (uint32_t)y >= c->height || !(coverage > 0.0f))
        return;
    const cgt_image *const image = &c->image;
    const size_t pixel = (size_t)y * c->width + (size_t)x, channels = image->channels == 4 ? 4 : 3;
    const size_t stride = image->row_stride ? image->row_stride : c->width * channels;
    const float share = coverage < 1.0f ? coverage : 1.0f;
    uint8_t *const alpha = image->alpha ? image->alpha + pixel : NULL;
    if (image->bytes)
        blend_bytes(image->bytes + (size_t)y * stride + (size_t)x * channels, channels == 4, alpha, color, share);
    if (image->linear)
        blend_linear(&image->linear[pixel], color, share);
}

/* The first pixel that begins at or after 0 and reaches beyond a coordinate, and the end of those below one. Far
 * coordinates and NaN give no pixels. */
static int32_t first_pixel(float x) { return x > 0.0f ? (int32_t)fminf(x, 1e6f) : 0; }
static int32_t end_pixel(float x, uint32_t size) { return x > 0.0f ? (int32_t)ceilf(fminf(x, (float)size)) : 0; }

void cgt_canvas_line(const canvas *c, const float a[2], const float b[2], float width, const float color[3])
{
    const float d[2] = {b[0] - a[0], b[1] - a[1]}, square = d[0] * d[0] + d[1] * d[1], reach = 0.5f * width + 1.0f;
    const int32_t x0 = first_pixel(fminf(a[0], b[0]) - reach), y0 = first_pixel(fminf(a[1], b[1]) - reach);
    const int32_t x1 = end_pixel(fmaxf(a[0], b[0]) + reach, c->width),
                  y1 = end_pixel(fmaxf(a[1], b[1]) + reach, c->height);
    for (int32_t y = y0; y < y1; y++)
        for (int32_t x = x0; x < x1; x++) {
            /* How far the pixel's centre is from the nearest point of the line. */
            const float v[2] = {(float)x + 0.5f - a[0], (float)y + 0.5f - a[1]};
            const float along = square > 0.0f ? fminf(1.0f, fmaxf(0.0f, (v[0] * d[0] + v[1] * d[1]) / square)) : 0.0f;
            const float off = hypotf(v[0] - along * d[0], v[1] - along * d[1]);
            cgt_canvas_blend(c, x, y, color, 0.5f * width + 0.5f - off);
        }
}

/* The part of pixel i that lies between two coordinates. */
static float covered(float from, float to, float i) { return fminf(to, i + 1.0f) - fmaxf(from, i); }

void cgt_canvas_fill(const canvas *c, float x, float y, float width, float height, const float color[3])
{
    const int32_t x1 = end_pixel(x + width, c->width), y1 = end_pixel(y + height, c->height);
    for (int32_t j = first_pixel(y); j < y1; j++)
        for (int32_t i = first_pixel(x); i < x1; i++)
            cgt_canvas_blend(c, i, j, color,
                             fmaxf(0.0f, covered(x, x + width, (float)i)) *
                                 fmaxf(0.0f, covered(y, y + height, (float)j)));
}
