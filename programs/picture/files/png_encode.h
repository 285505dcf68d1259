/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * PNG pictures in memory: 8 bits a channel, RGB or RGBA, with lines of text about them. */
#ifndef PNG_ENCODE_H
#define PNG_ENCODE_H

#include <stddef.h>
#include <stdint.h>

/* Something to be told about a picture: "Title", "Software", ... */
typedef struct png_text {
    const char *key;   /* 1 to 79 bytes of ASCII */
    const char *value; /* UTF-8 */
} png_text;

typedef struct png_picture {
    uint32_t width, height; /* 1 to 65,536 */
    uint32_t channels;      /* 3: sRGB; 4: sRGB and opacity, not multiplied into the colour */
    const uint8_t *pixels;  /* channels * width * height bytes, first row at the top; fewer than 2^31 - 2^24 */
    const png_text *texts;
    size_t text_count; /* 0: none */
} png_picture;

typedef struct png_encoder png_encoder;

/* Buffers, which grow to the size of a picture and are used again. An encoder serves one thread at a time. Returns NULL
 * where there is no memory. */
png_encoder *png_encoder_create(void);
void png_encoder_release(png_encoder *encoder);

/* Encodes a picture. Returns its file, *size bytes, valid until the encoder's next use; or NULL with the reason in
 * *wrong: a size or text beyond its range, or no memory. */
const uint8_t *png_encode(png_encoder *encoder, const png_picture *picture, size_t *size, const char **wrong);

#endif
