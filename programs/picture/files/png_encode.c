/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * PNG pictures; see png_encode.h. Portable Network Graphics (PNG) Specification, ISO/IEC 15948. Every row takes the
 * filter Up, the difference to the row above: it suits rendered pictures, and its loop is a vector subtraction. A trial
 * of all five filters makes files a tenth smaller for three times the time. */
#include "picture/files/png_encode.h"

#include <stdlib.h>
#include <string.h>

#include "picture/files/png_deflate.h"

struct png_encoder {
    png_deflate *deflate;
    uint8_t *file;
    size_t file_capacity;
};

enum {
    CHUNK_FRAME = 12, /* length, name and checksum */
    FILTER_UP = 2,
    MOST_KEY = 79
};

png_encoder *png_encoder_create(void)
{
    png_encoder *encoder = calloc(1, sizeof *encoder);
    if (!encoder)
        return NULL;
    encoder->deflate = png_deflate_create();
    if (encoder->deflate)
        return encoder;
    free(encoder);
    return NULL;
}

void png_encoder_release(png_encoder *encoder)
{
    if (!encoder)
        return;
    png_deflate_release(encoder->deflate);
    free(encoder->file);
    free(encoder);
}

/* ---- Chunks ------------------------------------------------------------------------------------------------- */

static uint8_t *put_u32(uint8_t *to, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(value >> (24 - 8 * i));
    return to + 4;
}

/* Completes a chunk whose `size` bytes of data stand at chunk + 8. Returns its end. */
static uint8_t *end_chunk(uint8_t *chunk, const char name[4], size_t size)
{
    put_u32(chunk, (uint32_t)size);
    memcpy(chunk + 4, name, 4);
    return put_u32(chunk + 8 + size, png_crc(0, chunk + 4, size + 4));
}

static uint8_t *put_head(uint8_t *to, const png_picture *picture)
{
    static const uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    memcpy(to, signature, sizeof signature);
    to += sizeof signature;
    uint8_t *data = put_u32(put_u32(to + 8, picture->width), picture->height);
    const uint8_t kind[5] = {8, picture->channels == 4 ? 6 : 2, 0, 0,
                             0}; /* bits, colours; the only methods there are */
    memcpy(data, kind, sizeof kind);
    to = end_chunk(to, "IHDR", 13);
    to[8] = 0; /* perceptual intent */
    return end_chunk(to, "sRGB", 1);
}

/* iTXt: key, 0, not compressed (two zeros), no language (0), no translation (0), text. */
static uint8_t *put_text(uint8_t *to, const png_text *text)
{
    const size_t key = strlen(text->key), value = strlen(text->value);
    memcpy(to + 8, text->key, key);
    memset(to + 8 + key, 0, 5);
    memcpy(to + 8 + key + 5, text->value, value);
    return end_chunk(to, "iTXt", key + 5 + value);
}

/* ---- Pictures ----------------------------------------------------------------------------------------------- */

static int reserve(uint8_t **bytes, size_t *capacity, size_t size)
{
    if (size <= *capacity)
        return 0;
    free(*bytes); /* nothing in it is needed any more */
    *bytes = malloc(size);
    *capacity = *bytes ? size : 0;
    return *bytes ? 0 : -1;
}

/* The filtered rows of a picture, band after band. A row is its filter's number and its bytes; the row above the first
 * is zero. */
typedef struct row_source {
    const png_picture *picture;
    uint32_t y;
    size_t at; /* in row y, the filter's number included */
} row_source;

/* Writes filtered bytes [at, at + count) of row y. */
static void filter_row(const png_picture *picture, uint32_t y, size_t at, size_t count, uint8_t *to)
{
    const size_t row = (size_t)picture->width * picture->channels;
    if (at == 0) {
        *to++ = FILTER_UP;
        at = 1;
        count--;
    }
    const uint8_t *const here = picture->pixels + y * row + at - 1;
    if (y == 0) {
        memcpy(to, here, count);
        return;
    }
    const uint8_t *const above = here - row;
    for (size_t x = 0; x < count; x++)
        to[x] = (uint8_t)(here[x] - above[x]);
}

static size_t next_band(void *user, uint8_t *bytes)
{
    row_source *const s = user;
    const size_t row = (size_t)s->picture->width * s->picture->channels + 1;
    size_t used = 0;
    while (used < PNG_BAND && s->y < s->picture->height) {
        const size_t room = PNG_BAND - used, rest = row - s->at, count = rest < room ? rest : room;
        filter_row(s->picture, s->y, s->at, count, bytes + used);
        used += count;
        s->at += count;
        if (s->at == row) {
            s->at = 0;
            s->y++;
        }
    }
    return used;
}

/* The bytes of all texts as chunks; 0 with *wrong set where one cannot be written. */
static size_t text_bytes(const png_picture *picture, const char **wrong)
{
    size_t bytes = 0;
    for (size_t i = 0; i < picture->text_count; i++) {
        const size_t key = strlen(picture->texts[i].key), value = strlen(picture->texts[i].value);
        if (key < 1 || key > MOST_KEY || value > 1u << 20) {
            *wrong = "a text's key must have 1 to 79 bytes, its value at most 1,048,576";
            return 0;
        }
        bytes += CHUNK_FRAME + key + 5 + value;
    }
    return bytes;
}

const uint8_t *png_encode(png_encoder *encoder, const png_picture *picture, size_t *size, const char **wrong)
{
    enum { FIXED = 8 + CHUNK_FRAME + 13 + CHUNK_FRAME + 1 + CHUNK_FRAME + CHUNK_FRAME };
    const uint64_t bytes = ((uint64_t)picture->width * picture->channels + 1) * picture->height;
    *wrong = NULL;
    if (!picture->width || !picture->height || picture->width > 65536 || picture->height > 65536 ||
        (picture->channels != 3 && picture->channels != 4) || bytes > (UINT64_C(1) << 31) - (1 << 24)) {
        *wrong = "a PNG of this size is not written";
        return NULL;
    }
    const size_t texts = text_bytes(picture, wrong), bound = png_deflate_bound((size_t)bytes);
    if (*wrong)
        return NULL;
    *wrong = "out of memory for the picture";
    if (reserve(&encoder->file, &encoder->file_capacity, FIXED + texts + bound))
        return NULL;
    uint8_t *end = put_head(encoder->file, picture);
    for (size_t i = 0; i < picture->text_count; i++)
        end = put_text(end, &picture->texts[i]);
    row_source source = {picture, 0, 0};
    const size_t deflated = png_deflate_run(encoder->deflate, next_band, &source, (size_t)bytes, end + 8);
    if (!deflated) {
        *wrong = "the picture cannot be compressed";
        return NULL;
    }
    end = end_chunk(end_chunk(end, "IDAT", deflated), "IEND", 0);
    *size = (size_t)(end - encoder->file);
    return encoder->file;
}
