/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Luma and chroma; see yuv.h. In whole numbers, 16 bits behind the point; each row of the matrix is rounded so that its
 * sum is exact: white is 235, 128, 128, and every grey has no colour. */
#include "picture/files/yuv.h"

/* Of BT.709: Y = 0.2126 R + 0.7152 G + 0.0722 B, Cb = (B - Y) / 1.8556, Cr = (R - Y) / 1.5748, times 219 / 255 and
 * 224 / 255, times 65,536. */
enum {
    Y_R = 11966,
    Y_G = 40254,
    Y_B = 4064, /* 56,284 = 219 / 255 * 65,536, rounded up, so that 255 becomes 219 */
    CB_R = -6596,
    CB_G = -22189,
    CB_B = 28785, /* sum 0 */
    CR_R = 28785,
    CR_G = -26145,
    CR_B = -2640, /* sum 0 */
    SHIFT = 16
};

size_t yuv_bytes(uint32_t width, uint32_t height)
{
    const size_t luma = (size_t)yuv_edge(width) * yuv_edge(height);
    return luma + luma / 2;
}

static void luma_row(const uint8_t *rgb, uint32_t width, uint8_t *y)
{
    const int32_t offset = (16 << SHIFT) + (1 << (SHIFT - 1));
    for (uint32_t x = 0; x < width; x++)
        y[x] = (uint8_t)((Y_R * rgb[3 * x] + Y_G * rgb[3 * x + 1] + Y_B * rgb[3 * x + 2] + offset) >> SHIFT);
    if (width & 1u)
        y[width] = y[width - 1];
}

/* One block of the sums of four pixels. Never negative before the shift: 128 outweighs any sum. */
static uint8_t chroma(int32_t r, int32_t g, int32_t b, int32_t by_r, int32_t by_g, int32_t by_b)
{
    const int32_t offset = (128 << (SHIFT + 2)) + (1 << (SHIFT + 1));
    return (uint8_t)((by_r * r + by_g * g + by_b * b + offset) >> (SHIFT + 2));
}

/* Two rows of pixels; the same row twice at an odd edge. */
static void chroma_row(const uint8_t *above, const uint8_t *below, uint32_t width, uint8_t *cb, uint8_t *cr)
{
    for (uint32_t x = 0; x < width / 2; x++) {
        const uint8_t *const a = above + 6 * (size_t)x, *const b = below + 6 * (size_t)x;
        const int32_t red = a[0] + a[3] + b[0] + b[3];
        const int32_t green = a[1] + a[4] + b[1] + b[4];
        const int32_t blue = a[2] + a[5] + b[2] + b[5];
        cb[x] = chroma(red, green, blue, CB_R, CB_G, CB_B);
        cr[x] = chroma(red, green, blue, CR_R, CR_G, CR_B);
    }
    if (width & 1u) {
        const uint8_t *const a = above + 3 * ((size_t)width - 1), *const b = below + 3 * ((size_t)width - 1);
        const int32_t red = 2 * (a[0] + b[0]), green = 2 * (a[1] + b[1]), blue = 2 * (a[2] + b[2]);
        cb[width / 2] = chroma(red, green, blue, CB_R, CB_G, CB_B);
        cr[width / 2] = chroma(red, green, blue, CR_R, CR_G, CR_B);
    }
}

void yuv_from_rgb(const uint8_t *rgb, uint32_t width, uint32_t height, uint8_t *yuv)
{
    const size_t row = (size_t)width * 3, luma_width = yuv_edge(width), chroma_width = luma_width / 2;
    const uint32_t rows = yuv_edge(height);
    uint8_t *const cb = yuv + luma_width * rows, *const cr = cb + chroma_width * (rows / 2);
    for (uint32_t y = 0; y < rows; y += 2) {
        const uint8_t *const above = rgb + y * row, *const below = y + 1 < height ? above + row : above;
        luma_row(above, width, yuv + y * luma_width);
        luma_row(below, width, yuv + (y + 1) * luma_width);
        chroma_row(above, below, width, cb + y / 2 * chroma_width, cr + y / 2 * chroma_width);
    }
}
