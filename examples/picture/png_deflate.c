/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Compression for PNG; see png_deflate.h. The fastest level of each library: pictures that went through the filter Up
 * become hardly smaller at higher ones. */
#include "picture/png_deflate.h"

#include <stdlib.h>

/* Streams are at most this much longer than what they hold: five bytes for each 65,535 that are stored as they are, and
 * head and checksum; with room for the ends of blocks that a library leaves unused. */
size_t png_deflate_bound(size_t size) { return size + size / 1024 + 4096; }

#if defined(CGT_HAVE_ISAL)

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

struct png_deflate {
    struct isal_zstream stream;
    uint8_t level_buffer[ISAL_DEF_LVL1_DEFAULT];
};

png_deflate *png_deflate_create(void) { return malloc(sizeof(png_deflate)); }

void png_deflate_release(png_deflate *deflate) { free(deflate); }

size_t png_deflate_run(png_deflate *deflate, const uint8_t *bytes, size_t size, uint8_t *out)
{
    struct isal_zstream *const s = &deflate->stream;
    isal_deflate_init(s);
    s->level = 1;
    s->level_buf = deflate->level_buffer;
    s->level_buf_size = sizeof deflate->level_buffer;
    s->gzip_flag = IGZIP_ZLIB;
    s->end_of_stream = 1;
    s->next_in = (uint8_t *)(uintptr_t)bytes; /* which it only reads */
    s->avail_in = (uint32_t)size;
    s->next_out = out;
    s->avail_out = (uint32_t)png_deflate_bound(size);
    const int result = isal_deflate(s);
    return result == COMP_OK && s->internal_state.state == ZSTATE_END ? (size_t)(s->next_out - out) : 0;
}

uint32_t png_crc(uint32_t crc, const uint8_t *bytes, size_t size) { return crc32_gzip_refl(crc, bytes, size); }

const char *png_deflate_name(void) { return "ISA-L"; }

#elif defined(CGT_HAVE_LIBDEFLATE)

#include <libdeflate.h>

struct png_deflate {
    struct libdeflate_compressor *compressor;
};

png_deflate *png_deflate_create(void)
{
    png_deflate *deflate = malloc(sizeof *deflate);
    if (!deflate)
        return NULL;
    deflate->compressor = libdeflate_alloc_compressor(1);
    if (deflate->compressor)
        return deflate;
    free(deflate);
    return NULL;
}

void png_deflate_release(png_deflate *deflate)
{
    if (deflate)
        libdeflate_free_compressor(deflate->compressor);
    free(deflate);
}

size_t png_deflate_run(png_deflate *deflate, const uint8_t *bytes, size_t size, uint8_t *out)
{
    return libdeflate_zlib_compress(deflate->compressor, bytes, size, out, png_deflate_bound(size));
}

uint32_t png_crc(uint32_t crc, const uint8_t *bytes, size_t size) { return libdeflate_crc32(crc, bytes, size); }

const char *png_deflate_name(void) { return "libdeflate"; }

#else

#include <zlib.h>

struct png_deflate {
    int unused;
};

png_deflate *png_deflate_create(void) { return calloc(1, sizeof(png_deflate)); }

void png_deflate_release(png_deflate *deflate) { free(deflate); }

size_t png_deflate_run(png_deflate *deflate, const uint8_t *bytes, size_t size, uint8_t *out)
{
    uLongf length = png_deflate_bound(size);
    (void)deflate;
    return compress2(out, &length, bytes, size, 1) == Z_OK ? length : 0;
}

uint32_t png_crc(uint32_t crc, const uint8_t *bytes, size_t size) { return (uint32_t)crc32_z(crc, bytes, size); }

const char *png_deflate_name(void) { return "zlib"; }

#endif
