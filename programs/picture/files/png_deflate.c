/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Compression for PNG; see png_deflate.h. The fastest level of each library: pictures that went through the filter Up
 * become hardly smaller at higher ones. */
#include "picture/files/png_deflate.h"

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
    uint8_t band[PNG_BAND];
};

png_deflate *png_deflate_create(void) { return malloc(sizeof(png_deflate)); }

void png_deflate_release(png_deflate *deflate) { free(deflate); }

/* Compresses the next bytes. Returns 0, or -1 on a failure. */
static int deflate_bytes(struct isal_zstream *s, uint8_t *bytes, size_t size, int flush, int last)
{
    s->next_in = bytes;
    s->avail_in = (uint32_t)size;
    s->flush = (uint16_t)flush;
    s->end_of_stream = (uint16_t)last;
    return isal_deflate(s) != COMP_OK || s->avail_in > 0 ? -1 : 0;
}

/* ISA-L 2.30 at level 1 takes the third place of a stream for one whose bytes are those of the stream's own address
 * (igzip_icf_body_h1_gr_bt.asm, at write_first_byte), and so finds other matches in each process. It does not where
 * the stream begins with less than it looks ahead, so the first bytes go alone: a few bytes more a picture. */
enum { FIRST_BYTES = 8 };

size_t png_deflate_run(png_deflate *deflate, png_source *source, void *user, size_t size, uint8_t *out)
{
    struct isal_zstream *const s = &deflate->stream;
    size_t left = size;
    isal_deflate_init(s);
    s->level = 1;
    s->level_buf = deflate->level_buffer;
    s->level_buf_size = sizeof deflate->level_buffer;
    s->gzip_flag = IGZIP_ZLIB;
    s->next_out = out;
    s->avail_out = (uint32_t)png_deflate_bound(size);
    while (left > 0) {
        const size_t bytes = source(user, deflate->band);
        const size_t alone = left == size && bytes > FIRST_BYTES ? FIRST_BYTES : 0;
        left -= bytes;
        if (bytes == 0 || (alone && deflate_bytes(s, deflate->band, alone, SYNC_FLUSH, 0)) ||
            deflate_bytes(s, deflate->band + alone, bytes - alone, NO_FLUSH, left == 0))
            return 0;
    }
    return s->internal_state.state == ZSTATE_END ? (size_t)(s->next_out - out) : 0;
}

uint32_t png_crc(uint32_t crc, const uint8_t *bytes, size_t size) { return crc32_gzip_refl(crc, bytes, size); }

const char *png_deflate_name(void) { return "ISA-L"; }

#elif defined(CGT_HAVE_LIBDEFLATE)

#include <libdeflate.h>

struct png_deflate {
    struct libdeflate_compressor *compressor;
    uint8_t *bytes; /* all of a picture: this library has no streams */
    size_t capacity;
};

png_deflate *png_deflate_create(void)
{
    png_deflate *deflate = calloc(1, sizeof *deflate);
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
    if (!deflate)
        return;
    libdeflate_free_compressor(deflate->compressor);
    free(deflate->bytes);
    free(deflate);
}

size_t png_deflate_run(png_deflate *deflate, png_source *source, void *user, size_t size, uint8_t *out)
{
    size_t used = 0, more;
    if (size + PNG_BAND > deflate->capacity) {
        free(deflate->bytes);
        deflate->bytes = malloc(size + PNG_BAND);
        deflate->capacity = deflate->bytes ? size + PNG_BAND : 0;
        if (!deflate->bytes)
            return 0;
    }
    while (used < size && (more = source(user, deflate->bytes + used)) > 0)
        used += more;
    if (used < size)
        return 0;
    return libdeflate_zlib_compress(deflate->compressor, deflate->bytes, used, out, png_deflate_bound(size));
}

uint32_t png_crc(uint32_t crc, const uint8_t *bytes, size_t size) { return libdeflate_crc32(crc, bytes, size); }

const char *png_deflate_name(void) { return "libdeflate"; }

#else

#include <zlib.h>

struct png_deflate {
    z_stream stream;
    uint8_t band[PNG_BAND];
};

png_deflate *png_deflate_create(void)
{
    png_deflate *deflate = calloc(1, sizeof *deflate);
    if (deflate && deflateInit(&deflate->stream, 1) == Z_OK)
        return deflate;
    free(deflate);
    return NULL;
}

void png_deflate_release(png_deflate *deflate)
{
    if (deflate)
        deflateEnd(&deflate->stream);
    free(deflate);
}

/* Compresses what the stream was given. */
static int deflate_band(z_stream *stream, int last) { return deflate(stream, last ? Z_FINISH : Z_NO_FLUSH); }

size_t png_deflate_run(png_deflate *state, png_source *source, void *user, size_t size, uint8_t *out)
{
    z_stream *const s = &state->stream;
    size_t left = size;
    int result = deflateReset(s);
    s->next_out = out;
    s->avail_out = (uInt)png_deflate_bound(size);
    while (left > 0 && result == Z_OK) {
        const size_t bytes = source(user, state->band);
        left -= bytes;
        s->next_in = state->band;
        s->avail_in = (uInt)bytes;
        result = bytes ? deflate_band(s, left == 0) : Z_STREAM_ERROR;
    }
    return result == Z_STREAM_END ? (size_t)(s->next_out - out) : 0;
}

uint32_t png_crc(uint32_t crc, const uint8_t *bytes, size_t size) { return (uint32_t)crc32_z(crc, bytes, size); }

const char *png_deflate_name(void) { return "zlib"; }

#endif
