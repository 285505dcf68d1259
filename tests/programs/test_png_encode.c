/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The structure of PNG files: chunks, their checksums, texts, the sizes that are refused. That the pictures are those
 * that were given, movie_cli.sh tests by another program. */
#include "support/suite.h"
#include "support/test.h"

#include <stdlib.h>
#include <string.h>

#include "picture/files/png_deflate.h"
#include "picture/files/png_encode.h"

static uint32_t get_u32(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* The checksum bit by bit: CRC-32 of ISO 3309. */
static uint32_t slow_crc(const uint8_t *bytes, size_t size)
{
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1u ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

TEST(checksums_are_those_of_png)
{
    uint8_t bytes[301];
    uint64_t seed = 7;
    for (size_t i = 0; i < sizeof bytes; i++) {
        seed = seed * UINT64_C(6364136223846793005) + 1442695040888963407u;
        bytes[i] = (uint8_t)(seed >> 56);
    }
    for (size_t size = 0; size <= sizeof bytes; size++) {
        assert_int_equal(png_crc(0, bytes, size), slow_crc(bytes, size));
        assert_int_equal(png_crc(png_crc(0, bytes, size / 2), bytes + size / 2, size - size / 2),
                         slow_crc(bytes, size));
    }
}

/* Walks the chunks and checks each; names gets them, four characters each. */
static void read_chunks(const uint8_t *file, size_t size, char names[200])
{
    static const uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    size_t at = 8, count = 0;
    assert_true(size > 8);
    assert_memory_equal(file, signature, 8);
    while (at < size) {
        assert_true(at + 12 <= size);
        const size_t length = get_u32(file + at);
        assert_true(length <= size - at - 12);
        assert_int_equal(get_u32(file + at + 8 + length), slow_crc(file + at + 4, length + 4));
        assert_true(count < 49);
        memcpy(names + 4 * count++, file + at + 4, 4);
        at += length + 12;
    }
    names[4 * count] = '\0';
}

TEST(files_have_all_chunks)
{
    static const uint32_t sizes[][3] = {{1, 1, 3}, {1, 1, 4}, {7, 3, 3}, {640, 2, 4}, {1, 500, 3}, {321, 200, 3}};
    const png_text texts[] = {{"Software", "cgt"}, {"Title", "\xc3\xa4"}};
    png_encoder *encoder = png_encoder_create();
    char names[200];
    assert_non_null(encoder);
    for (size_t i = 0; i < TEST_COUNT(sizes); i++) {
        const size_t bytes = (size_t)sizes[i][0] * sizes[i][1] * sizes[i][2];
        uint8_t *const pixels = malloc(bytes);
        assert_non_null(pixels);
        uint64_t seed = i + 1;
        for (size_t k = 0; k < bytes; k++) { /* noise, which no method compresses */
            seed = seed * UINT64_C(6364136223846793005) + 1442695040888963407u;
            pixels[k] = (uint8_t)(seed >> 56);
        }
        const png_picture picture = {sizes[i][0], sizes[i][1], sizes[i][2], pixels, texts, i % 3};
        size_t size;
        const char *wrong;
        const uint8_t *const file = png_encode(encoder, &picture, &size, &wrong);
        assert_non_null(file);
        read_chunks(file, size, names);
        assert_string_equal(names, i % 3 == 0   ? "IHDRsRGBIDATIEND"
                                   : i % 3 == 1 ? "IHDRsRGBiTXtIDATIEND"
                                                : "IHDRsRGBiTXtiTXtIDATIEND");
        assert_int_equal(get_u32(file + 16), sizes[i][0]);
        assert_int_equal(get_u32(file + 20), sizes[i][1]);
        assert_int_equal(file[25], sizes[i][2] == 4 ? 6 : 2);
        free(pixels);
    }
    png_encoder_release(encoder);
}

TEST(bad_pictures_are_refused)
{
    static const uint8_t pixels[16];
    static const struct {
        uint32_t width, height, channels;
        const char *key;
    } rows[] = {{0, 1, 3, "k"},     {1, 0, 3, "k"},         {1, 1, 1, "k"}, {1, 1, 5, "k"},
                {65537, 1, 3, "k"}, {65536, 65536, 4, "k"}, {1, 1, 3, ""}};
    png_encoder *encoder = png_encoder_create();
    assert_non_null(encoder);
    for (size_t i = 0; i < TEST_COUNT(rows); i++) {
        const png_text text = {rows[i].key, "v"};
        const png_picture picture = {rows[i].width, rows[i].height, rows[i].channels, pixels, &text, 1};
        size_t size;
        const char *wrong = NULL;
        assert_null(png_encode(encoder, &picture, &size, &wrong));
        assert_non_null(wrong);
    }
    png_encoder_release(encoder);
}

/* The file of a picture does not tell which encoder wrote it, nor where its memory was. What the pictures begin with
 * comes again, once. Their bytes are small, since noise is stored as it is. */
TEST(files_are_the_same_from_every_encoder)
{
    enum { ENCODERS = 16, PICTURES = 3000, WIDTH = 20, HEIGHT = 20, BYTES = 3 * WIDTH * HEIGHT };
    png_encoder *encoders[ENCODERS];
    uint8_t pixels[BYTES];
    uint64_t seed = 11;
    for (int i = 0; i < ENCODERS; i++)
        assert_non_null(encoders[i] = png_encoder_create());
    for (int k = 0; k < PICTURES; k++) {
        const png_picture picture = {WIDTH, HEIGHT, 3, pixels, NULL, 0};
        for (int i = 0; i < BYTES; i++) {
            seed = seed * UINT64_C(6364136223846793005) + 1442695040888963407u;
            pixels[i] = (uint8_t)(seed >> 60);
        }
        memcpy(pixels + 30, pixels, 12);
        size_t size, first_size = 0;
        const uint8_t *first = NULL;
        for (int i = 0; i < ENCODERS; i++) {
            const char *wrong;
            const uint8_t *const file = png_encode(encoders[i], &picture, &size, &wrong);
            assert_non_null(file);
            first = first ? first : file;
            first_size = i ? first_size : size;
            assert_int_equal(size, first_size);
            assert_memory_equal(file, first, size);
        }
    }
    for (int i = 0; i < ENCODERS; i++)
        png_encoder_release(encoders[i]);
}

SEEDED_SUITE("test_png_encode", NULL, NULL)
