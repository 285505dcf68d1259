/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The compressed coordinates of .xtc. */
#ifndef XDR_COORDINATES_H
#define XDR_COORDINATES_H

#include <stddef.h>
#include <stdint.h>

/* What stands before the compressed bytes. */
typedef struct xdr_packed {
    float precision; /* coordinates are whole numbers divided by it */
    int32_t low[3], high[3];
    int32_t small; /* index of the first size of small differences */
} xdr_packed;

/* Decodes `count` coordinates to x, y and z of values, `stride` apart. Returns 0, or -1: the bytes are damaged. */
int xdr_decode(const xdr_packed *packed, const unsigned char *bytes, size_t size, float *values, size_t stride,
               uint32_t count);

#endif
