/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the fuzz targets share: the function that libFuzzer and replay.c call, checks that end the program, and a reader
 * that takes an input apart into numbers. */
#ifndef FUZZ_H
#define FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Runs one input; every target defines it. Returns 0. A failed check ends the program by abort. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Prints a message and aborts. */
_Noreturn void fuzz_fail(const char *file, int line, const char *format, ...) __attribute__((format(printf, 3, 4)));

#define FUZZ_CHECK(condition, ...)                                                                                     \
    do {                                                                                                               \
        if (!(condition))                                                                                              \
            fuzz_fail(__FILE__, __LINE__, __VA_ARGS__);                                                                \
    } while (0)

/* Memory that must be there: a fuzz target cannot go on without. 0 bytes are valid. */
void *fuzz_allocate(size_t bytes);

/* ---- Bytes as numbers ---- */

typedef struct fuzz_bytes {
    const uint8_t *at;
    size_t left;
    float recent[8]; /* floats taken last, to be met again: equal coordinates are where the hard cases lie */
    uint32_t recents;
} fuzz_bytes;

fuzz_bytes fuzz_bytes_of(const uint8_t *data, size_t size);

/* The next byte; 0 behind the end. */
uint8_t fuzz_byte(fuzz_bytes *b);

/* 0 .. count - 1, from one byte: count is at most 256. */
uint32_t fuzz_below(fuzz_bytes *b, uint32_t count);

/* Four bytes, little-endian. */
uint32_t fuzz_word(fuzz_bytes *b);

/* From one byte a small multiple of a quarter, a number with a name (infinities, NaN, the smallest, the largest), or
 * one of the recent ones or a neighbour of it; from five bytes any float. */
float fuzz_float(fuzz_bytes *b);

/* The same without NaN and infinities. */
float fuzz_finite(fuzz_bytes *b);

#endif
