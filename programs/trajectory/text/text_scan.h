/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decimal numbers of a usual form, eight digits at a time in one 64-bit word. The results are those of text_float and
 * text_double; what is of another form is left to them. Up to 15 bytes after the number are read: the text must have a
 * byte that is no digit after it, and 16 bytes of memory after that. */
#ifndef TEXT_SCAN_H
#define TEXT_SCAN_H

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Powers of ten that a double holds exactly. */
static const double scan_power[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
static const uint32_t scan_ten[9] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

/* Eight bytes, the first one lowest, whatever the machine's byte order. */
static inline uint64_t scan_load(const char *p)
{
    unsigned char b[8];
    memcpy(b, p, sizeof b);
    return (uint64_t)b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24 | (uint64_t)b[4] << 32 |
           (uint64_t)b[5] << 40 | (uint64_t)b[6] << 48 | (uint64_t)b[7] << 56;
}

/* Digits become bytes of 0 to 9. Returns the marks of the others, the top bit of each byte: adding 0x76 sets it from 10
 * on. A carry, from bytes of 0x8a on, goes to bytes behind one that is marked for certain. */
static inline uint64_t scan_marks(uint64_t x)
{
    return ((x + UINT64_C(0x7676767676767676)) | x) & UINT64_C(0x8080808080808080);
}

/* The number of eight digits, the first one lowest. Neighbours are joined: to two digits, four, eight. */
static inline uint32_t scan_join(uint64_t digits)
{
    const uint64_t y = 10 * digits + (digits >> 8);
    const uint64_t mask = UINT64_C(0x000000ff000000ff);
    const uint64_t by_1000000_and_100 = UINT64_C(0x000f424000000064), by_10000_and_1 = UINT64_C(0x0000271000000001);
    return (uint32_t)(((y & mask) * by_1000000_and_100 + ((y >> 16) & mask) * by_10000_and_1) >> 32);
}

#define SCAN_ZEROS UINT64_C(0x3030303030303030)

/* Reads the digits at p, at most eight. Returns how many there are: they are moved to the last bytes, with zeros before
 * them. */
static inline unsigned scan_eight(const char *p, uint64_t *value)
{
    const uint64_t x = scan_load(p) ^ SCAN_ZEROS, other = scan_marks(x);
    const unsigned count = other != 0 ? (unsigned)__builtin_ctzll(other) >> 3 : 8;
    *value = scan_join(count > 0 ? x << (64 - 8 * count) : 0);
    return count;
}

/* Reads a number of at most eight characters, a point among them, and a blank after it: most numbers of most files.
 * Returns what follows it, or NULL where it is of another form. Digits before the point move to its place; at most
 * seven digits are an exact float. */
static inline const char *scan_short(const char *p, uint32_t *mantissa, unsigned *fraction)
{
    const uint64_t x = scan_load(p) ^ SCAN_ZEROS, other = scan_marks(x);
    const uint64_t first = other & (0 - other), rest = other ^ first, through = 2 * first - 1;
    const unsigned point = first != 0 ? (unsigned)__builtin_ctzll(first) >> 3 : 0;
    const unsigned end = rest != 0 ? (unsigned)__builtin_ctzll(rest) >> 3 : 8;
    if (p[point] != '.' || end < 2 || (unsigned char)p[end] > ' ')
        return NULL;
    *mantissa = scan_join(((x & ~through) | (x << 8 & through)) << (64 - 8 * end));
    *fraction = end - point - 1;
    return p + end;
}

/* Reads an exponent after its e: one to three digits. Returns what follows, or NULL. */
static inline const char *scan_exponent(const char *p, int *exponent)
{
    uint64_t value;
    const int is_negative = *p == '-';
    p += is_negative || *p == '+';
    const unsigned count = scan_eight(p, &value);
    if (count == 0 || count > 3)
        return NULL;
    *exponent += is_negative ? -(int)value : (int)value;
    return p + count;
}

/* Reads a number that may be longer. Returns what follows it, or NULL where it is left to text_double: unusual, or with
 * so many digits or so large an exponent that one multiplication or division of exact doubles (Clinger 1990) does not
 * do. */
static inline const char *scan_long(const char *p, double *value)
{
    const int is_negative = *p == '-';
    uint64_t mantissa, part;
    p += is_negative;
    const unsigned whole = scan_eight(p, &mantissa);
    unsigned fraction = 0;
    p += whole;
    if (*p == '.') {
        fraction = scan_eight(++p, &part);
        p += fraction;
        mantissa = mantissa * scan_ten[fraction] + part;
        if (fraction == 8) {
            const unsigned more = scan_eight(p, &part);
            p += more;
            fraction += more;
            mantissa = mantissa * scan_ten[more] + part;
        }
    }
    int exponent = -(int)fraction;
    /* 18 digits fit 64 bits */
    if (whole == 8 || whole + fraction == 0 || whole + fraction > 18)
        return NULL;
    if ((*p | 0x20) == 'e')
        p = scan_exponent(p + 1, &exponent);
    if (FLT_EVAL_METHOD != 0 || p == NULL || mantissa > (uint64_t)1 << 53 || exponent < -22 || exponent > 22)
        return NULL;
    const double m = (double)mantissa;
    const double magnitude = exponent < 0 ? m / scan_power[-exponent] : m * scan_power[exponent];
    *value = is_negative ? -magnitude : magnitude;
    return p;
}

/* Reads a number. Returns as scan_long. */
static inline const char *scan_double(const char *p, double *value)
{
    uint32_t mantissa;
    unsigned fraction;
    const char *const after = scan_short(p + (*p == '-'), &mantissa, &fraction);
    if (FLT_EVAL_METHOD != 0 || after == NULL)
        return scan_long(p, value);
    const double magnitude = (double)mantissa / scan_power[fraction];
    *value = *p == '-' ? -magnitude : magnitude;
    return after;
}

/* The same for a float. Rounding to double first changes it only where the double lies half-way between two floats; all
 * long numbers, 0 or from 1e-22 to 2^53 * 1e22, are normal floats. Short ones are quotients of exact floats. */
static inline const char *scan_float(const char *p, float *value)
{
    double number;
    uint64_t bits;
    uint32_t mantissa;
    unsigned fraction;
    const char *after = scan_short(p + (*p == '-'), &mantissa, &fraction);
    if (FLT_EVAL_METHOD == 0 && after != NULL) {
        const float magnitude = (float)mantissa / (float)scan_ten[fraction];
        *value = *p == '-' ? -magnitude : magnitude;
        return after;
    }
    after = scan_long(p, &number);
    if (after == NULL)
        return NULL;
    memcpy(&bits, &number, sizeof bits);
    *value = (float)number;
    return (bits & 0x1fffffff) == 0x10000000 ? NULL : after;
}

/* Reads a whole number of at most seven digits, without a sign. Returns what follows it, or NULL. */
static inline const char *scan_whole(const char *p, uint32_t *value)
{
    uint64_t number;
    const unsigned count = scan_eight(p, &number);
    *value = (uint32_t)number;
    return count > 0 && count < 8 ? p + count : NULL;
}

#endif
