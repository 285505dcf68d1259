/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Luma and chroma of movies, against BT.709 in double; odd edges. */
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "picture/files/yuv.h"

static double luma(const double c[3]) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

TEST(greys_have_no_color)
{
    for (int grey = 0; grey < 256; grey++) {
        uint8_t rgb[12], yuv[6];
        memset(rgb, grey, sizeof rgb);
        assert_int_equal(yuv_bytes(2, 2), sizeof yuv);
        yuv_from_rgb(rgb, 2, 2, yuv);
        for (int i = 0; i < 4; i++)
            assert_true(fabs(yuv[i] - (16.0 + grey * 219.0 / 255.0)) < 0.51);
        assert_int_equal(yuv[4], 128);
        assert_int_equal(yuv[5], 128);
    }
}

/* Pixel (x, y) of a picture whose edges are continued. */
static void pixel(const uint8_t *rgb, uint32_t width, uint32_t height, uint32_t x, uint32_t y, double c[3])
{
    x = x < width ? x : width - 1;
    y = y < height ? y : height - 1;
    for (int k = 0; k < 3; k++)
        c[k] = rgb[3 * ((size_t)y * width + x) + (size_t)k];
}

static void check_picture(uint32_t width, uint32_t height, uint64_t seed)
{
    const uint32_t w = yuv_edge(width), h = yuv_edge(height);
    uint8_t *const rgb = malloc((size_t)width * height * 3), *const yuv = malloc(yuv_bytes(width, height));
    assert_non_null(rgb);
    assert_non_null(yuv);
    for (size_t i = 0; i < (size_t)width * height * 3; i++) {
        seed = seed * UINT64_C(6364136223846793005) + 1442695040888963407u;
        rgb[i] = seed >> 62 ? (uint8_t)(seed >> 40) : (seed >> 61 & 1 ? 255 : 0); /* ends of the range often */
    }
    yuv_from_rgb(rgb, width, height, yuv);
    for (uint32_t y = 0; y < h; y++)
        for (uint32_t x = 0; x < w; x++) {
            double c[3];
            pixel(rgb, width, height, x, y, c);
            assert_true(fabs(yuv[(size_t)y * w + x] - (16.0 + luma(c) * 219.0 / 255.0)) < 0.51);
        }
    const uint8_t *const cb = yuv + (size_t)w * h, *const cr = cb + (size_t)w / 2 * (h / 2);
    for (uint32_t y = 0; y < h / 2; y++)
        for (uint32_t x = 0; x < w / 2; x++) {
            double sum[3] = {0, 0, 0};
            for (uint32_t i = 0; i < 4; i++) {
                double c[3];
                pixel(rgb, width, height, 2 * x + i % 2, 2 * y + i / 2, c);
                for (int k = 0; k < 3; k++)
                    sum[k] += c[k] / 4.0;
            }
            const size_t at = (size_t)y * (w / 2) + x;
            assert_true(fabs(cb[at] - (128.0 + (sum[2] - luma(sum)) / 1.8556 * 224.0 / 255.0)) < 0.51);
            assert_true(fabs(cr[at] - (128.0 + (sum[0] - luma(sum)) / 1.5748 * 224.0 / 255.0)) < 0.51);
        }
    free(rgb);
    free(yuv);
}

TEST(pictures_are_converted)
{
    static const uint32_t edges[] = {1, 2, 3, 16, 17, 33};
    for (size_t i = 0; i < TEST_COUNT(edges); i++)
        for (size_t j = 0; j < TEST_COUNT(edges); j++)
            check_picture(edges[i], edges[j], 1 + i * 10 + j);
}

SEEDED_SUITE("test_yuv", NULL, NULL)
