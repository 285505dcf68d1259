/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt_write_png: its files hold the pixels that were given, by another reader than itself, and are small where pictures
 * are smooth; what cannot be written is refused. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/picture.h>

#include "support/inflate.h"
#include "support/suite.h"
#include "support/test.h"

#define PATH "test_picture_png.png"

static uint32_t get(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* The checksum bit by bit: CRC-32 of ISO 3309. */
static uint32_t slow_crc(const uint8_t *bytes, size_t size)
{
    uint32_t crc = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1u ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

static uint8_t predict(unsigned filter, int left, int up, int corner)
{
    const int p = left + up - corner, a = abs(p - left), b = abs(p - up), c = abs(p - corner);
    return (uint8_t)(filter == 0        ? 0
                     : filter == 1      ? left
                     : filter == 2      ? up
                     : filter == 3      ? (left + up) / 2
                     : a <= b && a <= c ? left
                     : b <= c           ? up
                                        : corner);
}

/* What the file tells. */
typedef struct png_file {
    uint32_t width, height, channels, per_metre;
    uint8_t *pixels;
    size_t bytes; /* of the file */
} png_file;

static png_file read_png(void)
{
    png_file f = {0};
    uint8_t *file = NULL;
    FILE *const stream = fopen(PATH, "rb");
    assert_non_null(stream);
    assert_int_equal(fseek(stream, 0, SEEK_END), 0);
    f.bytes = (size_t)ftell(stream);
    rewind(stream);
    file = malloc(f.bytes);
    assert_non_null(file);
    assert_int_equal(fread(file, 1, f.bytes, stream), f.bytes);
    fclose(stream);
    assert_memory_equal(file, "\x89PNG\r\n\x1a\n", 8);
    for (size_t at = 8; at < f.bytes;) {
        const uint8_t *const chunk = file + at, *data = chunk + 8;
        const size_t size = get(chunk);
        assert_true(size <= f.bytes - at - 12);
        assert_int_equal(get(data + size), slow_crc(chunk + 4, size + 4));
        at += size + 12;
        if (!memcmp(chunk + 4, "IHDR", 4)) {
            f.width = get(data);
            f.height = get(data + 4);
            f.channels = data[9] == 6 ? 4 : 3;
            assert_true(data[8] == 8 && (data[9] == 2 || data[9] == 6) && !data[10] && !data[11] && !data[12]);
        } else if (!memcmp(chunk + 4, "pHYs", 4)) {
            assert_true(get(data) == get(data + 4) && data[8] == 1);
            f.per_metre = get(data);
        } else if (!memcmp(chunk + 4, "IDAT", 4)) {
            const size_t row = (size_t)f.width * f.channels, total = (row + 1) * f.height;
            uint8_t *const rows = malloc(total);
            f.pixels = calloc(row, f.height);
            assert_true(rows && f.pixels);
            assert_int_equal(inflate_all(data, size, rows, total), total);
            for (size_t i = 0; i < row * f.height; i++) {
                const size_t x = i % row, y = i / row;
                const uint8_t left = x < f.channels ? 0 : f.pixels[i - f.channels], up = y ? f.pixels[i - row] : 0,
                              corner = x < f.channels || !y ? 0 : f.pixels[i - row - f.channels];
                f.pixels[i] = (uint8_t)(rows[y * (row + 1) + 1 + x] + predict(rows[y * (row + 1)], left, up, corner));
            }
            free(rows);
        } else
            assert_memory_equal(chunk + 4, "IEND", 4);
    }
    free(file);
    assert_non_null(f.pixels);
    return f;
}

/* By kind: white; noise; smooth; few values; lengths of runs from 1 on; values that are rarer and rarer, whose codes
 * would be longer than fifteen bits. */
static uint8_t pixel_of(int kind, uint32_t i, test_random *r)
{
    static uint32_t run, left;
    run = i ? run : 0;
    left = i ? left : 0;
    switch (kind) {
    case 0: return 255;
    case 1: return (uint8_t)random_below(r, 256);
    case 2: return (uint8_t)(i % 771 * (i / 771) / 997);
    case 3: return (uint8_t)(i / 7 % 5 * 30);
    case 4:
        if (!left--)
            left = ++run;
        return (uint8_t)(run * 37);
    default: return (uint8_t)(__builtin_ctz(random_below(r, 1u << 24) | 1u << 24) * 7 + (int)(i % 771 / 700));
    }
}

TEST(files_hold_the_pixels)
{
    static const uint32_t sizes[][3] = {{257, 131, 3}, {1, 1, 3},    {1, 1, 4},
                                        {193, 400, 4}, {5, 1000, 3}, {21845, 2, 3}};
    test_random r = random_make(1);
    for (size_t k = 0; k < TEST_COUNT(sizes); k++)
        for (int kind = 0; kind < 6; kind++) {
            const uint32_t width = sizes[k][0], height = sizes[k][1], channels = sizes[k][2], pad = kind % 2 ? 5 : 0;
            const size_t row = (size_t)width * channels, stride = row + pad;
            uint8_t *const bytes = malloc(stride * height);
            assert_non_null(bytes);
            for (uint32_t i = 0; i < stride * height; i++)
                bytes[i] = pixel_of(kind, i, &r);
            const cgt_image image = {.bytes = bytes,
                                     .channels = channels == 3 && kind ? 0 : channels,
                                     .row_stride = pad ? stride : 0,
                                     .dpi = kind == 3 ? 300 : 0};
            assert_int_equal(cgt_write_png(PATH, &image, width, height), CGT_OK);
            const png_file f = read_png();
            assert_true(f.width == width && f.height == height && f.channels == channels);
            assert_int_equal(f.per_metre, kind == 3 ? 11811 : 0);
            for (uint32_t y = 0; y < height; y++)
                assert_memory_equal(f.pixels + y * row, bytes + y * stride, row);
            if (row * height > 50000) { /* noise is stored, all else far smaller */
                print_message("%ux%ux%u, kind %d: %zu of %zu bytes\n", width, height, channels, kind, f.bytes,
                              row * height);
                assert_true(kind == 1 ? f.bytes < row * height * 1.01 + 200 : f.bytes < row * height * 0.6);
                assert_true(kind || f.bytes < row * height / 80);
            }
            free(f.pixels);
            free(bytes);
        }
    remove(PATH);
}

TEST(what_cannot_be_written_is_refused)
{
    uint8_t bytes[12] = {0};
    const cgt_image image = {.bytes = bytes}, nothing = {0}, grey = {.bytes = bytes, .channels = 1},
                    dense = {.bytes = bytes, .dpi = 2e6f}, unknown = {.bytes = bytes, .dpi = NAN},
                    four = {.bytes = bytes, .channels = 4}, narrow = {.bytes = bytes, .row_stride = 5};
    assert_int_equal(cgt_write_png(NULL, &image, 2, 2), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, NULL, 2, 2), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, &nothing, 2, 2), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, &grey, 2, 2), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, &dense, 2, 2), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, &unknown, 2, 2), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, &narrow, 2, 2), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, &image, 0, 2), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, &image, 65537, 1), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, &image, 65536, 65536), CGT_ERROR_INVALID_ARGUMENT);
    assert_int_equal(cgt_write_png(PATH, &four, 65536, 16384), CGT_ERROR_INVALID_ARGUMENT); /* 4 GiB and 16 KiB */
    assert_int_equal(cgt_write_png("no/such/folder.png", &image, 2, 2), CGT_ERROR_FILE);
    assert_int_equal(errno, ENOENT);
}

SEEDED_SUITE("test_picture_png", NULL, NULL)
