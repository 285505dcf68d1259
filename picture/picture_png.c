/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * PNG files (W3C, "Portable Network Graphics Specification") without a dependency: rows are filtered, runs of a byte
 * and single bytes get a Huffman code for each block (RFC 1951). Backgrounds and smooth shades, which pictures consist
 * of, leave little to the searches for strings that a compressor makes besides. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/picture.h>

enum {
    BLOCK = 65535, /* bytes: what one can be stored as, too */
    SYMBOLS = 286, /* bytes, the end of a block, lengths of runs */
    BLOCK_END = 256,
    LEAST_RUN = 3,
    MOST_RUN = 258,
    MOST_BITS = 15, /* of a code */
    LENGTH_BITS = 4 /* of a code's length, which is from 0 to 15: all alike */
};

/* ---- bits ---- */

typedef struct bit_writer {
    uint8_t *at;
    uint64_t pending; /* the first bit is the lowest */
    uint32_t count;
} bit_writer;

static void put_bits(bit_writer *w, uint32_t bits, uint32_t count)
{
    w->pending |= (uint64_t)bits << w->count;
    for (w->count += count; w->count >= 8; w->count -= 8, w->pending >>= 8)
        *w->at++ = (uint8_t)w->pending;
}

static void fill_byte(bit_writer *w)
{
    if (w->count)
        put_bits(w, 0, 8 - w->count);
}

/* Codes come with their first bit the highest. */
static uint32_t reverse(uint32_t code, uint32_t bits)
{
    uint32_t reversed = 0;
    for (uint32_t i = 0; i < bits; i++)
        reversed |= (code >> i & 1) << (bits - 1 - i);
    return reversed;
}

/* ---- codes ---- */

typedef struct huffman {
    uint32_t frequency[SYMBOLS];
    uint8_t bits[SYMBOLS]; /* 0: the symbol does not come */
    uint16_t code[SYMBOLS];
} huffman;

/* Returns the index of the least weight that is not 0 among the first `count`, which is then taken out. */
static uint32_t take_least(uint32_t *weight, uint32_t count)
{
    uint32_t least = UINT32_MAX;
    for (uint32_t i = 0; i < count; i++)
        if (weight[i] && (least == UINT32_MAX || weight[i] < weight[least]))
            least = i;
    if (least != UINT32_MAX)
        weight[least] = 0;
    return least;
}

/* The lengths by Huffman's tree of the weights. Returns the longest. */
static uint32_t measure_codes(const uint32_t *frequency, uint8_t *bits)
{
    uint32_t weight[2 * SYMBOLS], sum[2 * SYMBOLS], parent[2 * SYMBOLS] = {0}, count = SYMBOLS, longest = 0;
    memcpy(weight, frequency, SYMBOLS * sizeof *weight);
    memcpy(sum, frequency, SYMBOLS * sizeof *sum);
    for (;;) {
        const uint32_t a = take_least(weight, count), b = take_least(weight, count);
        if (b == UINT32_MAX)
            break;
        parent[a] = parent[b] = count;
        weight[count] = sum[count] = sum[a] + sum[b];
        count++;
    }
    for (uint32_t i = 0; i < SYMBOLS; i++) {
        uint32_t length = 0;
        for (uint32_t k = i; frequency[i] && parent[k]; k = parent[k])
            length++;
        bits[i] = (uint8_t)length;
        longest = length > longest ? length : longest;
    }
    return longest;
}

/* Two symbols or more come. Rare ones count as less rare, until no code is too long. */
static void make_codes(huffman *h)
{
    uint32_t weight[SYMBOLS], next = 0;
    memcpy(weight, h->frequency, sizeof weight);
    while (measure_codes(weight, h->bits) > MOST_BITS)
        for (uint32_t i = 0; i < SYMBOLS; i++)
            weight[i] = weight[i] ? weight[i] / 2 | 1 : 0;
    for (uint32_t length = 1; length <= MOST_BITS; length++, next <<= 1)
        for (uint32_t i = 0; i < SYMBOLS; i++)
            if (h->bits[i] == length)
                h->code[i] = (uint16_t)reverse(next++, length);
}

/* ---- blocks ---- */

/* The symbol of a run's length; *extra, *extra_bits: what follows it. */
static uint32_t run_symbol(uint32_t length, uint32_t *extra, uint32_t *extra_bits)
{
    uint32_t bits = 0, from = length - LEAST_RUN;
    *extra = *extra_bits = 0;
    if (length == MOST_RUN)
        return SYMBOLS - 1;
    while (from >> bits > 7)
        bits++;
    *extra_bits = bits;
    *extra = from & ((1u << bits) - 1);
    return BLOCK_END + 1 + 4 * bits + (from >> bits);
}

/* How often the byte before `at` comes again. */
static uint32_t find_run(const uint8_t *bytes, size_t at, size_t end)
{
    uint32_t length = 0;
    while (at && at + length < end && length < MOST_RUN && bytes[at + length] == bytes[at - 1])
        length++;
    return length >= LEAST_RUN ? length : 0;
}

/* Counts the symbols of a block, or writes them. Returns the bits beside codes. */
static uint64_t visit_symbols(const uint8_t *bytes, size_t first, size_t end, huffman *h, bit_writer *w)
{
    uint64_t beside = 0;
    for (size_t i = first; i < end;) {
        uint32_t extra = 0, extra_bits = 0;
        const uint32_t run = find_run(bytes, i, end), symbol = run ? run_symbol(run, &extra, &extra_bits) : bytes[i];
        const uint32_t more = run ? extra_bits + 1 : 0; /* and the distance, whose only code is 0 */
        i += run ? run : 1;
        beside += more;
        if (w) {
            put_bits(w, h->code[symbol], h->bits[symbol]);
            put_bits(w, extra, more);
        } else
            h->frequency[symbol]++;
    }
    return beside;
}

static void put_codes(bit_writer *w, const huffman *h)
{
    put_bits(w, SYMBOLS - 257, 5);
    put_bits(w, 0, 5);  /* one distance */
    put_bits(w, 15, 4); /* all lengths of lengths, those of repetitions first, which do not come */
    for (int i = 0; i < 19; i++)
        put_bits(w, i < 3 ? 0 : LENGTH_BITS, 3);
    for (uint32_t i = 0; i < SYMBOLS; i++)
        put_bits(w, reverse(h->bits[i], LENGTH_BITS), LENGTH_BITS);
    put_bits(w, reverse(1, LENGTH_BITS), LENGTH_BITS); /* the distance's code has one bit */
}

static void put_block(bit_writer *w, const uint8_t *bytes, size_t first, size_t end, bool is_last)
{
    huffman h = {.frequency[BLOCK_END] = 1};
    uint64_t bits = visit_symbols(bytes, first, end, &h, NULL) + 17 + 3 * 19 + LENGTH_BITS * (SYMBOLS + 1);
    make_codes(&h);
    for (uint32_t i = 0; i < SYMBOLS; i++)
        bits += (uint64_t)h.frequency[i] * h.bits[i];
    put_bits(w, is_last, 1);
    if (bits < 8 * (end - first)) {
        put_bits(w, 2, 2);
        put_codes(w, &h);
        visit_symbols(bytes, first, end, &h, w);
        put_bits(w, h.code[BLOCK_END], h.bits[BLOCK_END]);
        return;
    }
    put_bits(w, 0, 2); /* noise: stored */
    fill_byte(w);
    put_bits(w, (uint32_t)(end - first), 16);
    put_bits(w, ~(uint32_t)(end - first) & 0xffff, 16);
    memcpy(w->at, bytes + first, end - first);
    w->at += end - first;
}

/* ---- rows ---- */

static uint8_t paeth(uint8_t left, uint8_t up, uint8_t corner)
{
    const int a = abs(up - corner), b = abs(left - corner), c = abs(left + up - 2 * corner);
    return a <= b && a <= c ? left : b <= c ? up : corner;
}

enum { NONE, SUB, UP, PAETH = 4 };

/* Filters a row. Returns how far its bytes are from 0, which tells how well they compress. */
static uint64_t filter_row(int filter, const uint8_t *row, const uint8_t *above, size_t bytes, uint32_t channels,
                           uint8_t *to)
{
    uint64_t sum = 0;
    *to++ = (uint8_t)filter;
    for (size_t i = 0; i < bytes; i++) {
        const uint8_t left = i >= channels ? row[i - channels] : 0, up = above ? above[i] : 0,
                      corner = above && i >= channels ? above[i - channels] : 0;
        const uint8_t expected = filter == SUB     ? left
                                 : filter == UP    ? up
                                 : filter == PAETH ? paeth(left, up, corner)
                                                   : 0;
        to[i] = (uint8_t)(row[i] - expected);
        sum += to[i] < 128 ? to[i] : 256u - to[i];
    }
    return sum;
}

/* Each row behind the number of the filter that suits it. trial: memory for a row. */
static void filter_rows(uint8_t *to, const cgt_image *image, size_t row, uint32_t channels, uint32_t height,
                        uint8_t *trial)
{
    static const int filters[] = {SUB, UP, PAETH};
    const size_t stride = image->row_stride ? image->row_stride : row;
    for (uint32_t y = 0; y < height; y++, to += row + 1) {
        const uint8_t *from = image->bytes + y * stride, *above = y ? from - stride : NULL;
        uint64_t least = filter_row(NONE, from, above, row, channels, to);
        for (size_t k = 0; k < sizeof filters / sizeof *filters && least; k++) {
            const uint64_t sum = filter_row(filters[k], from, above, row, channels, trial);
            if (sum < least)
                memcpy(to, trial, row + 1);
            least = sum < least ? sum : least;
        }
    }
}

/* ---- the file ---- */

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

/* The rows as a stream (RFC 1950). */
static uint8_t *put_rows(uint8_t *to, const uint8_t *rows, size_t total)
{
    uint32_t a = 1, b = 0; /* Adler's sums */
    bit_writer w = {.at = to};
    put_bits(&w, 0x0178, 16);
    for (size_t i = 0; i < total; i += BLOCK)
        put_block(&w, rows, i, total - i < BLOCK ? total : i + BLOCK, total - i <= BLOCK);
    fill_byte(&w);
    for (size_t i = 0; i < total; i++) {
        a = (a + rows[i]) % 65521;
        b = (b + a) % 65521;
    }
    return put(w.at, b << 16 | a);
}

static size_t make_file(uint8_t *memory, const uint8_t *rows, size_t total, uint32_t channels, const uint32_t size[2],
                        float dpi)
{
    static const uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    memcpy(memory, signature, sizeof signature);
    uint8_t *chunk = memory + sizeof signature, *at = put(put(chunk + 8, size[0]), size[1]);
    memcpy(at, channels == 4 ? "\10\6\0\0" : "\10\2\0\0", 5); /* 8 bits a channel; the last zero ends the string */
    at = end_chunk(chunk, "IHDR", at + 5);
    if (dpi > 0) {
        const uint32_t per_metre = (uint32_t)lrintf(dpi / 0.0254f);
        chunk = at;
        at = put(put(chunk + 8, per_metre), per_metre);
        *at++ = 1; /* metres */
        at = end_chunk(chunk, "pHYs", at);
    }
    chunk = at;
    at = end_chunk(chunk, "IDAT", put_rows(chunk + 8, rows, total));
    return (size_t)(end_chunk(at, "IEND", at + 8) - memory);
}

/* Returns errno, or 0. */
static int write_file(const char *path, const uint8_t *memory, size_t bytes)
{
    errno = 0;
    FILE *const file = fopen(path, "wb");
    int wrong = file ? 0 : errno;
    if (file && fwrite(memory, 1, bytes, file) != bytes)
        wrong = errno ? errno : EIO;
    if (file && fclose(file) && !wrong)
        wrong = errno ? errno : EIO;
    return wrong;
}

cgt_result cgt_write_png(const char *path, const cgt_image *image, uint32_t width, uint32_t height)
{
    const uint32_t channels = image && image->channels ? image->channels : 3;
    const uint64_t all = ((uint64_t)width * channels + 1) * height; /* which may be too large for a size_t */
    if (!path || !image || !image->bytes || (channels != 3 && channels != 4) || !width || !height || width > 65536 ||
        height > 65536 || all > INT32_MAX / 2 ||
        (image->row_stride && image->row_stride < (uint64_t)width * channels) ||
        !(image->dpi >= 0 && image->dpi <= 1e6f))
        return CGT_ERROR_INVALID_ARGUMENT;
    const size_t row = (size_t)width * channels, total = (size_t)all;
    const size_t most = total + (total / BLOCK + 1) * 8 + 256; /* if all is stored */
    uint8_t *const memory = malloc(most + total + row + 1);
    if (!memory)
        return CGT_ERROR_OUT_OF_MEMORY;
    filter_rows(memory + most, image, row, channels, height, memory + most + total);
    const size_t bytes =
        make_file(memory, memory + most, total, channels, (const uint32_t[]){width, height}, image->dpi);
    const int wrong = write_file(path, memory, bytes);
    free(memory);
    errno = wrong;
    return wrong ? CGT_ERROR_FILE : CGT_OK;
}
