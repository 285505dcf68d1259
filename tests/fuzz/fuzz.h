/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Code shared by the fuzz targets: the function that libFuzzer and replay.c call, checks that abort, and a reader that
 * splits an input into numbers. */
#ifndef FUZZ_H
#define FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Runs one input; every target defines it. Returns 0. A failed check aborts. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Prints a message and aborts. */
_Noreturn void fuzz_fail(const char *file, int line, const char *format, ...) __attribute__((format(printf, 3, 4)));

#define FUZZ_CHECK(condition, ...)                                                                                     \
    do {                                                                                                               \
        if (!(condition))                                                                                              \
            fuzz_fail(__FILE__, __LINE__, __VA_ARGS__);                                                                \
    } while (0)

/* Allocates memory or aborts. 0 bytes are valid. */
void *fuzz_allocate(size_t bytes);

/* ---- Bytes as numbers ---- */

typedef struct fuzz_bytes {
    const uint8_t *at;
    size_t left;
    float recent[8]; /* floats taken last, to be reused: equal coordinates make hard cases */
    uint32_t recents;
} fuzz_bytes;

fuzz_bytes fuzz_bytes_of(const uint8_t *data, size_t size);

/* The next byte; 0 past the end. */
uint8_t fuzz_byte(fuzz_bytes *b);

/* 0 .. count - 1, from one byte: count is at most 256. */
uint32_t fuzz_below(fuzz_bytes *b, uint32_t count);

/* Four bytes, little-endian. */
uint32_t fuzz_word(fuzz_bytes *b);

/* From one byte: a small multiple of a quarter, a special value (infinity, NaN, the smallest, the largest), a recent
 * float or a neighbour of one. From five bytes: any float. */
float fuzz_float(fuzz_bytes *b);

/* The same without NaN and infinities. */
float fuzz_finite(fuzz_bytes *b);

#endif
