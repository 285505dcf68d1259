/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Numbers of any form that a text may have, one by one. The common ones take a path that is faster than strtof and
 * gives the same bits; rows of nothing but these go by text_scan.h. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/text/text_reader.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* Powers of ten that a double holds exactly. */
static const double power_of_ten[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                        1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static int is_digit(char c) { return c >= '0' && c <= '9'; }

/* Parses the exponent after its e: the remaining word, at most four digits. */
static int scan_exponent(const char *p, const char *end, int *exponent)
{
    int negative = 0;
    if (p < end && (*p == '-' || *p == '+'))
        negative = *p++ == '-';
    if (p == end || end - p > 4)
        return 0;
    int value = 0;
    for (; p < end; p++) {
        if (!is_digit(*p))
            return 0;
        value = 10 * value + (*p - '0');
    }
    *exponent += negative ? -value : value;
    return 1;
}

/* The fast path (Clinger 1990): mantissa and power of ten are both exact doubles, so one multiplication or division
 * rounds once, correctly. Returns 0 where the number is not of that kind, or is no number. */
static int fast_double(text_span word, double *value)
{
    const char *p = word.begin;
    int negative = 0;
    if (p < word.end && (*p == '-' || *p == '+'))
        negative = *p++ == '-';
    uint64_t mantissa = 0;
    int digits = 0, fraction = 0, point = 0;
    for (; p < word.end; p++) {
        if (is_digit(*p)) {
            mantissa = 10 * mantissa + (uint64_t)(*p - '0');
            fraction += point;
            if (++digits > 18) /* more might not fit 64 bits */
                return 0;
        } else if (*p == '.' && !point) {
            point = 1;
        } else {
            break;
        }
    }
    int exponent = -fraction;
    if (digits == 0 || (p < word.end && *p != 'e' && *p != 'E') ||
        (p < word.end && !scan_exponent(p + 1, word.end, &exponent)))
        return 0;
    if (FLT_EVAL_METHOD != 0 || mantissa > ((uint64_t)1 << 53) || exponent < -22 || exponent > 22)
        return 0;
    const double m = (double)mantissa;
    const double magnitude = exponent < 0 ? m / power_of_ten[-exponent] : m * power_of_ten[exponent];
    *value = negative ? -magnitude : magnitude;
    return 1;
}

/* The C library's functions also read hexadecimal numbers, which no trajectory holds. */
static int may_be_decimal(text_span word)
{
    const size_t length = text_length(word);
    return length > 0 && memchr(word.begin, 'x', length) == NULL && memchr(word.begin, 'X', length) == NULL;
}

/* Writes a word with another exponent's mark as C does: Fortran's 1.5D+01 and 1.5-101, whose third digit takes the
 * place of the mark, and Mathematica's 6.3*^-6. Returns 0 where the word is none of these. */
#define FOREIGN_LONGEST 62
static int copy_foreign(text_span word, char copy[FOREIGN_LONGEST + 2])
{
    const size_t length = text_length(word);
    if (length == 0 || length > FOREIGN_LONGEST)
        return 0;
    const char *p = word.begin;
    p += *p == '-' || *p == '+';
    while (p < word.end && (is_digit(*p) || *p == '.'))
        p++;
    const size_t mantissa = (size_t)(p - word.begin);
    const char *exponent = p;
    if (p < word.end && (*p == 'd' || *p == 'D'))
        exponent = p + 1;
    else if (word.end - p > 1 && p[0] == '*' && p[1] == '^')
        exponent = p + 2;
    else if (p == word.end || (*p != '-' && *p != '+'))
        return 0;
    int ignored = 0;
    if (!scan_exponent(exponent, word.end, &ignored))
        return 0;
    memcpy(copy, word.begin, mantissa);
    copy[mantissa] = 'e';
    const size_t rest = (size_t)(word.end - exponent);
    memcpy(copy + mantissa + 1, exponent, rest);
    copy[mantissa + 1 + rest] = '\0';
    return 1;
}

int text_double(text_span word, double *value)
{
    if (fast_double(word, value))
        return 1;
    if (!may_be_decimal(word))
        return 0;
    char *stop;
    char copy[FOREIGN_LONGEST + 2];
    double number = strtod(word.begin, &stop);
    if (stop != word.end) {
        if (!copy_foreign(word, copy))
            return 0;
        number = strtod(copy, &stop);
        if (*stop != '\0')
            return 0;
    }
    *value = number;
    return 1;
}

int text_float(text_span word, float *value)
{
    double number;
    if (fast_double(word, &number)) {
        /* Rounding to double first changes the float only where the double lies half-way between two floats. Numbers
         * of the fast path, 0 or from 1e-22 to 2^53 * 1e22, are all normal floats. */
        uint64_t bits;
        memcpy(&bits, &number, sizeof bits);
        const int halfway = (bits & 0x1fffffff) == 0x10000000;
        if (!halfway) {
            *value = (float)number;
            return 1;
        }
    }
    if (!may_be_decimal(word))
        return 0;
    char *stop;
    char copy[FOREIGN_LONGEST + 2];
    float exact = strtof(word.begin, &stop);
    if (stop != word.end) {
        if (!copy_foreign(word, copy))
            return 0;
        exact = strtof(copy, &stop);
        if (*stop != '\0')
            return 0;
    }
    *value = exact;
    return 1;
}

int text_u64(text_span word, uint64_t max, uint64_t *value)
{
    const char *p = word.begin;
    uint64_t number = 0;
    if (p < word.end && *p == '+')
        p++;
    if (p == word.end)
        return 0;
    for (; p < word.end; p++) {
        if (!is_digit(*p))
            return 0;
        const uint64_t digit = (uint64_t)(*p - '0');
        if (digit > max || number > (max - digit) / 10)
            return 0;
        number = 10 * number + digit;
    }
    *value = number;
    return 1;
}

int text_i64(text_span word, int64_t *value)
{
    const int negative = word.begin < word.end && *word.begin == '-';
    uint64_t magnitude;
    if (negative) {
        word.begin++;
        if (word.begin < word.end && *word.begin == '+')
            return 0;
    }
    if (!text_u64(word, (uint64_t)INT64_MAX, &magnitude))
        return 0;
    *value = negative ? -(int64_t)magnitude : (int64_t)magnitude;
    return 1;
}
