/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * PNG files (W3C, "Portable Network Graphics Specification"), with their data stored as it is: no dependency,
 * and as fast as the disk. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/picture.h>

enum { MOST_STORED = 65535 }; /* bytes of a block (RFC 1951) */

static uint8_t *put(uint8_t *to, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(value >> (24 - 8 * i));
    return to + 4;
}

static uint32_t checksum(const uint8_t *bytes, size_t count)
{
    uint32_t table[256], crc = UINT32_MAX;
    for (uint32_t i = 0; i < 256; i++) {
        table[i] = i;
        for (int k = 0; k < 8; k++)
            table[i] = table[i] & 1 ? 0xedb88320u ^ table[i] >> 1 : table[i] >> 1;
    }
    for (size_t i = 0; i < count; i++)
        crc = table[(crc ^ bytes[i]) & 255] ^ crc >> 8;
    return ~crc;
}

/* Ends the chunk that begins at `chunk` with eight bytes for length and name. */
static uint8_t *end_chunk(uint8_t *chunk, const char *name, uint8_t *end)
{
    put(chunk, (uint32_t)(end - chunk) - 8);
    memcpy(chunk + 4, name, 4);
    return put(end, checksum(chunk + 4, (size_t)(end - chunk) - 4));
}

/* Rows, each behind its filter's number, as a stream of stored blocks (RFC 1950). */
static uint8_t *put_rows(uint8_t *to, const uint8_t *bytes, size_t row, size_t stride, uint32_t height)
{
    const size_t total = (row + 1) * height;
    uint32_t a = 1, b = 0; /* Adler's sums */
    *to++ = 0x78;
    *to++ = 0x01;
    for (size_t i = 0; i < total; i++) {
        if (i % MOST_STORED == 0) {
            const size_t left = total - i, size = left < MOST_STORED ? left : MOST_STORED;
            *to++ = left <= MOST_STORED;
            *to++ = (uint8_t)size;
            *to++ = (uint8_t)(size >> 8);
            *to++ = (uint8_t)~size;
            *to++ = (uint8_t)(~size >> 8);
        }
        *to = i % (row + 1) ? bytes[i / (row + 1) * stride + i % (row + 1) - 1] : 0;
        a = (a + *to++) % 65521;
        b = (b + a) % 65521;
    }
    return put(to, b << 16 | a);
}

cgt_result cgt_write_png(const char *path, const cgt_image *image, uint32_t width, uint32_t height)
{
    static const uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    const uint32_t channels = image && image->channels ? image->channels : 3;
    const size_t row = (size_t)width * channels, total = (row + 1) * height;
    if (!path || !image || !image->bytes || (channels != 3 && channels != 4) || !width || !height || width > 65536 ||
        height > 65536 || total > INT32_MAX / 2)
        return CGT_ERROR_INVALID_ARGUMENT;
    uint8_t *const memory = malloc(total + total / MOST_STORED * 5 + 128);
    if (!memory)
        return CGT_ERROR_OUT_OF_MEMORY;
    memcpy(memory, signature, sizeof signature);
    uint8_t *chunk = memory + sizeof signature, *at = put(put(chunk + 8, width), height);
    memcpy(at, channels == 4 ? "\10\6\0\0" : "\10\2\0\0", 5); /* 8 bits a channel; the last zero ends the string */
    at = end_chunk(chunk, "IHDR", at + 5);
    chunk = at;
    at = put_rows(chunk + 8, image->bytes, row, image->row_stride ? image->row_stride : row, height);
    at = end_chunk(chunk, "IDAT", at);
    at = end_chunk(at, "IEND", at + 8);
    errno = 0;
    FILE *const file = fopen(path, "wb");
    int wrong = file ? 0 : errno;
    if (file && fwrite(memory, 1, (size_t)(at - memory), file) != (size_t)(at - memory))
        wrong = errno ? errno : EIO;
    if (file && fclose(file) && !wrong)
        wrong = errno ? errno : EIO;
    free(memory);
    errno = wrong;
    return wrong ? CGT_ERROR_FILE : CGT_OK;
}
