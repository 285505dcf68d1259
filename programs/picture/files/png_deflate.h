/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Compression of a picture's bytes into one zlib stream, by the fastest library that the build found: ISA-L, libdeflate
 * or zlib. All write valid streams, but not the same bytes. */
#ifndef PNG_DEFLATE_H
#define PNG_DEFLATE_H

#include <stddef.h>
#include <stdint.h>

typedef struct png_deflate png_deflate;

/* The state and buffers of one thread. Returns NULL where there is no memory. */
png_deflate *png_deflate_create(void);
void png_deflate_release(png_deflate *deflate);

/* The most bytes that `size` bytes may become. size: below 2^31. */
size_t png_deflate_bound(size_t size);

/* Writes the next bytes of what is compressed to `bytes`, at least one and at most PNG_BAND; how many is the result. 0:
 * there are no more. */
enum { PNG_BAND = 1 << 16 }; /* stays in the cache between the two */
typedef size_t png_source(void *user, uint8_t *bytes);

/* Compresses `size` bytes, which source gives one band after the other, into out, which holds png_deflate_bound(size).
 * Returns the stream's size, 0 on a failure. */
size_t png_deflate_run(png_deflate *deflate, png_source *source, void *user, size_t size, uint8_t *out);

/* The checksum of PNG's chunks, continued: crc is 0 at the start. */
uint32_t png_crc(uint32_t crc, const uint8_t *bytes, size_t size);

/* The library's name. */
const char *png_deflate_name(void);

#endif
