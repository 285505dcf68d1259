/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Coordinates as GROMACS compresses them (xdr3dfcoord of its library libxdrf, by F. van Hoesel). Whole numbers: each is
 * written relative to the lower corner of the box of all of them, in as many bits as that box needs, and a run of up to
 * eight atoms after it by differences, in fewer bits. How many changes by a step of the table below after each run. The
 * three parts of a place are one number in a mixed radix; its bytes are the low ones first, while bits fill bytes from
 * the top. */
#include "trajectory/gromacs/gromacs_frame.h"

#include <string.h>

/* About 2^(i/3): three numbers below it fit in i bits. The format is defined by exactly these. */
static const uint32_t sizes[] = {
    0,       0,       0,       0,       0,        0,        0,       0,       0,       8,       10,
    12,      16,      20,      25,      32,       40,       50,      64,      80,      101,     128,
    161,     203,     256,     322,     406,      512,      645,     812,     1024,    1290,    1625,
    2048,    2580,    3250,    4096,    5060,     6501,     8192,    10321,   13003,   16384,   20642,
    26007,   32768,   41285,   52015,   65536,    82570,    104031,  131072,  165140,  208063,  262144,
    330280,  416127,  524287,  660561,  832255,   1048576,  1321122, 1664510, 2097152, 2642245, 3329021,
    4194304, 5284491, 6658042, 8388607, 10568983, 13316085, 16777216};
enum { FIRST_SIZE = 9, LAST_SIZE = sizeof sizes / sizeof sizes[0] - 1 };

/* ---- Bits --------------------------------------------------------------------------------------------------- */

typedef struct bit_reader {
    const unsigned char *bytes;
    size_t size, at;
    uint32_t bits; /* the low `left` bits are not used yet */
    unsigned left;
    int is_over; /* more was asked for than there is */
} bit_reader;

/* At most 24 bits, the first of them on top. */
static uint32_t take_bits(bit_reader *b, unsigned count)
{
    while (b->left < count) {
        if (b->at == b->size) {
            b->is_over = 1;
            return 0;
        }
        b->bits = b->bits << 8 | b->bytes[b->at++];
        b->left += 8;
    }
    b->left -= count;
    return b->bits >> b->left & ((1u << count) - 1u);
}

/* Up to 32 bits. */
static uint32_t take_wide(bit_reader *b, unsigned count)
{
    const uint32_t top = count > 16 ? take_bits(b, count - 16) << 16 : 0;
    return top | take_bits(b, count > 16 ? 16 : count);
}

/* Three numbers below the sizes, as one of `count` bits, at most 72: repeated division, the last number first. */
static void take_three(bit_reader *b, unsigned count, const uint32_t size[3], uint32_t number[3])
{
    unsigned char digit[12] = {0};
    int digits = 0;
    for (; count > 8; count -= 8)
        digit[digits++] = (unsigned char)take_bits(b, 8);
    if (count > 0)
        digit[digits++] = (unsigned char)take_bits(b, count);
    if (digits <= 8) {
        uint64_t value = 0;
        for (int i = digits - 1; i >= 0; i--)
            value = value << 8 | digit[i];
        number[2] = (uint32_t)(value % size[2]);
        value /= size[2];
        number[1] = (uint32_t)(value % size[1]);
        number[0] = (uint32_t)(value / size[1]);
        return;
    }
    for (int i = 2; i > 0; i--) {
        uint32_t rest = 0;
        for (int k = digits - 1; k >= 0; k--) {
            rest = rest << 8 | digit[k]; /* sizes have 24 bits here */
            digit[k] = (unsigned char)(rest / size[i]);
            rest %= size[i];
        }
        number[i] = rest;
    }
    number[0] = digit[0] | (uint32_t)digit[1] << 8 | (uint32_t)digit[2] << 16 | (uint32_t)digit[3] << 24;
}

/* Bits of a number. */
static unsigned bits_of(uint32_t number)
{
    unsigned bits = 0;
    for (; number > 0; number >>= 1)
        bits++;
    return bits;
}

/* Bits of the product of three sizes of 24 bits. */
static unsigned bits_of_product(const uint32_t size[3])
{
    const uint64_t two = (uint64_t)size[0] * size[1]; /* 48 bits */
    const uint64_t low = (two & 0xffffffff) * size[2], high = (two >> 32) * size[2] + (low >> 32);
    return high >> 32 ? 64 + bits_of((uint32_t)(high >> 32))
           : high     ? 32 + bits_of((uint32_t)high)
                      : bits_of((uint32_t)low);
}

/* ---- Places ------------------------------------------------------------------------------------------------- */

typedef struct place_writer {
    float *values;
    size_t stride;
    float step;
    uint32_t done;
} place_writer;

static void put_place(place_writer *w, const uint32_t place[3])
{
    float *const to = w->values + w->stride * w->done++;
    for (int k = 0; k < 3; k++) {
        int32_t number;
        memcpy(&number, &place[k], sizeof number);
        to[k] = (float)number * w->step;
    }
}

typedef struct decoder {
    bit_reader in;
    uint32_t size[3], low[3];
    unsigned bits[3], all_bits; /* of each part; of all three as one number, 0 where a part has more than 24 bits */
    int small;                  /* index of the size of differences */
    uint32_t half, smaller_half;
} decoder;

static int begin_decoder(decoder *d, const xdr_packed *packed)
{
    int is_wide = 0;
    for (int k = 0; k < 3; k++) {
        d->low[k] = (uint32_t)packed->low[k];
        d->size[k] = (uint32_t)packed->high[k] - d->low[k] + 1u;
        d->bits[k] = bits_of(d->size[k]);
        is_wide |= d->size[k] > 0xffffff;
        if (packed->high[k] < packed->low[k] || d->size[k] == 0)
            return -1;
    }
    d->all_bits = is_wide ? 0 : bits_of_product(d->size);
    d->small = packed->small;
    if (d->small < FIRST_SIZE || d->small > LAST_SIZE || !(packed->precision > 0.0f))
        return -1;
    d->smaller_half = sizes[d->small > FIRST_SIZE ? d->small - 1 : FIRST_SIZE] / 2;
    d->half = sizes[d->small] / 2;
    return 0;
}

/* A place relative to the box of all. */
static void take_place(decoder *d, uint32_t place[3])
{
    if (d->all_bits > 0)
        take_three(&d->in, d->all_bits, d->size, place);
    for (int k = 0; k < 3; k++)
        place[k] = (d->all_bits > 0 ? place[k] : take_wide(&d->in, d->bits[k])) + d->low[k];
}

/* The places of a run, by their differences. The first two are swapped: of water the oxygen comes first in the file's
 * order, but between its hydrogens here. */
static void take_run(decoder *d, unsigned places, uint32_t previous[3], place_writer *out)
{
    const uint32_t size[3] = {sizes[d->small], sizes[d->small], sizes[d->small]};
    for (unsigned i = 0; i < places; i++) {
        uint32_t place[3] = {0};
        take_three(&d->in, (unsigned)d->small, size, place);
        for (int k = 0; k < 3; k++)
            place[k] += previous[k] - d->half;
        put_place(out, place);
        if (i == 0)
            put_place(out, previous);
        memcpy(previous, place, sizeof place);
    }
}

static int change_size(decoder *d, int change)
{
    d->small += change;
    if (d->small < FIRST_SIZE || d->small > LAST_SIZE)
        return -1;
    if (change < 0) {
        d->half = d->smaller_half;
        d->smaller_half = d->small > FIRST_SIZE ? sizes[d->small - 1] / 2 : 0;
    } else if (change > 0) {
        d->smaller_half = d->half;
        d->half = sizes[d->small] / 2;
    }
    return 0;
}

int xdr_decode(const xdr_packed *packed, const unsigned char *bytes, size_t size, float *values, size_t stride,
               uint32_t count)
{
    decoder d = {.in = {.bytes = bytes, .size = size}};
    place_writer out = {values, stride, 1.0f / packed->precision, 0};
    unsigned run = 0; /* places after the next one; stays until a flag changes it */
    if (begin_decoder(&d, packed))
        return -1;
    while (out.done < count) {
        uint32_t place[3] = {0};
        int change = 0;
        take_place(&d, place);
        if (take_bits(&d.in, 1)) {
            const unsigned code = take_bits(&d.in, 5);
            change = (int)(code % 3) - 1;
            run = code / 3;
        }
        if (d.in.is_over || run >= count - out.done)
            return -1;
        if (run > 0)
            take_run(&d, run, place, &out);
        else
            put_place(&out, place);
        if (change_size(&d, change))
            return -1;
    }
    return d.in.is_over ? -1 : 0;
}
