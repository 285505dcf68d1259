/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An inflater of RFC 1950 and 1951, bit by bit, so that no library judges itself. It checks all that it reads. */
#ifndef INFLATE_H
#define INFLATE_H

#include <stdint.h>
#include <string.h>

#include "support/test.h"

typedef struct bits {
    const uint8_t *bytes;
    size_t size, at; /* at: the next bit */
} bits;

static unsigned take(bits *b, unsigned count)
{
    unsigned value = 0;
    for (unsigned i = 0; i < count; i++, b->at++) {
        assert_true(b->at / 8 < b->size);
        value |= (unsigned)(b->bytes[b->at / 8] >> (b->at % 8) & 1) << i;
    }
    return value;
}

/* Codes by their lengths: how many there are of each, and the symbols in the order of their codes. */
typedef struct code {
    uint16_t count[16], symbol[288];
} code;

static void make_code(code *c, const uint8_t *length, unsigned symbols)
{
    uint16_t offset[16] = {0};
    memset(c, 0, sizeof *c);
    for (unsigned i = 0; i < symbols; i++)
        c->count[length[i]]++;
    c->count[0] = 0;
    for (unsigned i = 1; i < 15; i++)
        offset[i + 1] = (uint16_t)(offset[i] + c->count[i]);
    for (unsigned i = 0; i < symbols; i++)
        if (length[i])
            c->symbol[offset[length[i]]++] = (uint16_t)i;
}

static unsigned decode(bits *b, const code *c)
{
    int value = 0, first = 0, index = 0;
    for (unsigned length = 1; length < 16; length++) {
        value |= (int)take(b, 1);
        if (value - c->count[length] < first)
            return c->symbol[index + value - first];
        index += c->count[length];
        first = (first + c->count[length]) << 1;
        value <<= 1;
    }
    fail_msg("no such code");
    return 0;
}

static void read_codes(bits *b, code *literal, code *distance)
{
    static const uint8_t order[19] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    uint8_t length[320] = {0};
    code lengths;
    const unsigned literals = take(b, 5) + 257, distances = take(b, 5) + 1, given = take(b, 4) + 4;
    assert_true(literals <= 286 && distances <= 30);
    for (unsigned i = 0; i < given; i++)
        length[order[i]] = (uint8_t)take(b, 3);
    make_code(&lengths, length, 19);
    memset(length, 0, sizeof length);
    for (unsigned i = 0; i < literals + distances;) {
        const unsigned symbol = decode(b, &lengths);
        if (symbol < 16) {
            length[i++] = (uint8_t)symbol;
            continue;
        }
        assert_true(symbol > 16 || i > 0);
        const uint8_t again = symbol == 16 ? length[i - 1] : 0;
        unsigned times = symbol == 18 ? 11 + take(b, 7) : 3 + take(b, symbol == 16 ? 2 : 3);
        assert_true(i + times <= literals + distances);
        for (; times > 0; times--)
            length[i++] = again;
    }
    make_code(literal, length, literals);
    make_code(distance, length + literals, distances);
}

static void usual_codes(code *literal, code *distance)
{
    uint8_t length[288];
    for (unsigned i = 0; i < 288; i++)
        length[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    make_code(literal, length, 288);
    memset(length, 5, 30);
    make_code(distance, length, 30);
}

static size_t inflate_block(bits *b, const code *literal, const code *distance, uint8_t *out, size_t size, size_t at)
{
    for (unsigned symbol; (symbol = decode(b, literal)) != 256;) {
        if (symbol < 256) {
            assert_true(at < size);
            out[at++] = (uint8_t)symbol;
            continue;
        }
        assert_true(symbol < 286);
        const unsigned l = symbol - 257, more = l < 8 || l == 28 ? 0 : l / 4 - 1;
        const unsigned length = l == 28 ? 258 : 3 + (l < 8 ? l : (4 + l % 4) << more) + take(b, more);
        const unsigned d = decode(b, distance), far = d < 4 ? 0 : d / 2 - 1;
        assert_true(d < 30);
        const size_t back = 1 + (d < 4 ? d : (2 + d % 2) << far) + take(b, far);
        assert_true(back <= at && length <= size - at);
        for (unsigned i = 0; i < length; i++, at++)
            out[at] = out[at - back];
    }
    return at;
}

/* Inflates a whole stream and checks its head, its checksum and that nothing follows. Returns the size. */
static size_t inflate_all(const uint8_t *stream, size_t bytes, uint8_t *out, size_t size)
{
    bits b = {stream, bytes, 16};
    size_t at = 0;
    uint32_t low = 1, high = 0;
    assert_true(bytes > 6 && (stream[0] & 15) == 8 && (stream[0] * 256 + stream[1]) % 31 == 0 && !(stream[1] & 32));
    for (unsigned last = 0; !last;) {
        code literal, distance;
        last = take(&b, 1);
        const unsigned kind = take(&b, 2);
        assert_true(kind < 3);
        if (kind == 0) {
            b.at = (b.at + 7) / 8 * 8;
            const unsigned length = take(&b, 16);
            assert_int_equal(take(&b, 16), length ^ 0xFFFFu);
            assert_true(length <= size - at);
            for (unsigned i = 0; i < length; i++)
                out[at++] = (uint8_t)take(&b, 8);
            continue;
        }
        if (kind == 1)
            usual_codes(&literal, &distance);
        else
            read_codes(&b, &literal, &distance);
        at = inflate_block(&b, &literal, &distance, out, size, at);
    }
    for (size_t i = 0; i < at; i++) {
        low = (low + out[i]) % 65521;
        high = (high + low) % 65521;
    }
    b.at = (b.at + 7) / 8 * 8;
    for (unsigned i = 0; i < 4; i++)
        assert_int_equal(take(&b, 8), (high << 16 | low) >> (24 - 8 * i) & 255);
    assert_int_equal(b.at / 8, bytes);
    return at;
}

#endif
