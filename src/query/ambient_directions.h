/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The directions of ambient occlusion. Integers and unfused float arithmetic alone, without functions of the C library
 * but sqrtf, give the same bits everywhere. A header, so that a test sees it. */
#ifndef CGT_AMBIENT_DIRECTIONS_H
#define CGT_AMBIENT_DIRECTIONS_H

#include <math.h>
#include <stdbool.h>

#include <cgt/cgt.h>

#include "query/trace_settings.h"

#define CGT_AMBIENT_SAMPLES 1024u /* at most */

/* Points of a sequence in the unit square, in units of 2^-32. */
typedef struct cgt_ambient_points {
    uint32_t coordinate[2][CGT_AMBIENT_SAMPLES];
} cgt_ambient_points;

#define CGT_AMBIENT_PIXELS 2048u /* of a batch, at most */
#define CGT_AMBIENT_PAD 16u      /* vectors are loaded and stored whole */

/* Pixels with a hit, as the kernels take them. */
typedef struct cgt_ambient_pixels {
    uint32_t count;
    float x[CGT_AMBIENT_PIXELS + CGT_AMBIENT_PAD], y[CGT_AMBIENT_PIXELS + CGT_AMBIENT_PAD]; /* whole numbers */
    float t[CGT_AMBIENT_PIXELS + CGT_AMBIENT_PAD], normal[3][CGT_AMBIENT_PIXELS + CGT_AMBIENT_PAD];
    uint32_t primitive[CGT_AMBIENT_PIXELS + CGT_AMBIENT_PAD], geometry[CGT_AMBIENT_PIXELS + CGT_AMBIENT_PAD];
    uint32_t scramble[2][CGT_AMBIENT_PIXELS + CGT_AMBIENT_PAD]; /* of cgt_ambient_scramble */
} cgt_ambient_pixels;

/* Their rays. The pixels of a vector lie together, their first rays before their second ones: ray k of pixel j among
 * `count` pixels from number i on, i a multiple of the kernel's lanes, is number i * samples + k * count + j. */
typedef struct cgt_ambient_rays {
    float org[3][CGT_STREAM_CHUNK + CGT_AMBIENT_PAD], dir[3][CGT_STREAM_CHUNK + CGT_AMBIENT_PAD];
    uint32_t primitive[CGT_STREAM_CHUNK + CGT_AMBIENT_PAD], geometry[CGT_STREAM_CHUNK + CGT_AMBIENT_PAD];
} cgt_ambient_rays;

/* A bijective hash of 32 bits. */
static inline uint32_t cgt_ambient_mix(uint32_t x)
{
    x += 0x9e3779b9u;
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

/* Point i of Sobol's sequence in its first two dimensions: of 2^k points that start at a multiple of 2^k, each of 2^k
 * equal boxes of a grid has one. */
static inline void cgt_ambient_sobol(uint32_t i, uint32_t point[2])
{
    uint32_t first = 1u << 31, second = 1u << 31;
    point[0] = point[1] = 0;
    for (; i; i >>= 1, first >>= 1, second ^= second >> 1) {
        point[0] ^= i & 1 ? first : 0;
        point[1] ^= i & 1 ? second : 0;
    }
}

/* Points `begin` to begin + count - 1 of the sequence that all pixels have. */
static inline void cgt_ambient_points_init(uint32_t begin, uint32_t count, cgt_ambient_points *p)
{
    for (uint32_t k = 0; k < count; k++) {
        uint32_t point[2];
        cgt_ambient_sobol(begin + k, point);
        p->coordinate[0][k] = point[0];
        p->coordinate[1][k] = point[1];
    }
}

/* The number of a place in a square of 4x4, by which each square of 2x2 in it has four that begin alike. */
static inline uint32_t cgt_ambient_place(uint32_t x, uint32_t y)
{
    return ((x ^ y) & 1) | (y & 1) << 1 | ((x ^ y) & 2) << 1 | (y & 2) << 2;
}

/* What a pixel's points are moved by, bit by bit, which keeps each pixel's sequence as even as Sobol's: what bits of
 * its place in a square of 16x16 pixels add up to, and a hash below.
 *   bits 0 to 3: of its place in a square of 4x4. A search has found these: with the first 1, 2 or 4 points of each
 *                pixel the 16, 32 or 64 points of such a square, and those of each 2x2 in it, are as even as Sobol's
 *                first ones, and with 8, 16 and 32 nearly so
 *   bits 4 to 7: of that square's place among 4x4 of them. These are Sobol's own: with one point of each pixel the 256
 *                are nearly as even as with 16 of each in a square
 * So a mean over neighbours has a fraction of the noise that pixels would have which know nothing of each other. */
static inline void cgt_ambient_scramble(const cgt_ambient_options *ambient, uint32_t x, uint32_t y,
                                        uint32_t scramble[2])
{
    static const uint32_t of_bit[2][8] = {
        {0xbaf00000u, 0x69900000u, 0x8c700000u, 0x71100000u, 1u << 31, 1u << 30, 1u << 29, 1u << 28},
        {0x7fa00000u, 0xa7200000u, 0x39800000u, 0x6b700000u, 1u << 31, 3u << 30, 5u << 29, 15u << 28}};
    const uint32_t seed = cgt_ambient_mix(ambient->seed), hash = cgt_ambient_mix(x ^ cgt_ambient_mix(y ^ seed));
    const uint32_t place = cgt_ambient_place(x, y) | cgt_ambient_place(x >> 2, y >> 2) << 4;
    scramble[0] = seed ^ hash >> 12;
    scramble[1] = cgt_ambient_mix(seed) ^ cgt_ambient_mix(hash) >> 12;
    for (uint32_t bit = 0; bit < 8; bit++)
        for (int a = 0; a < 2; a++)
            scramble[a] ^= of_bit[a][bit] & (0u - (place >> bit & 1));
}

/* Maps 32 bits to (-1, 1), never to 0. */
static inline float cgt_ambient_centred(uint32_t x) { return ((float)(x >> 9) + 0.5f) * 0x1p-22f - 1; }

/* Two axes orthogonal to a unit vector (Duff and others, "Building an Orthonormal Basis, Revisited", 2017). */
static inline void cgt_ambient_axes(const float n[3], float across[2][3])
{
    const float sign = n[2] < 0 ? -1.f : 1.f, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    across[0][0] = 1 + sign * n[0] * n[0] * a;
    across[0][1] = sign * b;
    across[0][2] = -sign * n[0];
    across[1][0] = b;
    across[1][1] = sign + n[1] * n[1] * a;
    across[1][2] = -n[1];
}

/* The directions of pixel (x, y) about the unit vector n: points on a disc (Shirley, Chiu 1997), projected up to the
 * sphere, so that their density is the cosine. An angle on the disc is at most pi / 4 from an axis; there these terms
 * of sine and cosine are within 2^-24. The kernels compute the same (kernel/entry/entry_ambient.c). */
static inline void cgt_ambient_directions(const cgt_ambient_points *points, const cgt_ambient_options *ambient,
                                          uint32_t x, uint32_t y, const float n[3], float *const dir[3])
{
    uint32_t scramble[2];
    float across[2][3];
    cgt_ambient_scramble(ambient, x, y, scramble);
    cgt_ambient_axes(n, across);
    for (uint32_t k = 0; k < ambient->samples; k++) {
        const float p = cgt_ambient_centred(points->coordinate[0][k] ^ scramble[0]);
        const float q = cgt_ambient_centred(points->coordinate[1][k] ^ scramble[1]);
        const bool along_p = fabsf(p) > fabsf(q);
        const float r = along_p ? p : q, share = (along_p ? q : p) / r, w = share * share;
        const float sine =
            share * (0.785398163f +
                     w * (-0.0807455122f + w * (0.00249039457f + w * (-0.0000365762042f + w * 0.000000313361689f))));
        const float cosine =
            1 + w * (-0.308425138f + w * (0.0158543442f + w * (-0.000325991887f + w * 0.00000359086045f)));
        const float u = r * (along_p ? cosine : sine), v = r * (along_p ? sine : cosine), up = sqrtf(1 - r * r);
        for (int a = 0; a < 3; a++)
            dir[a][k] = (u * across[0][a] + v * across[1][a]) + up * n[a];
    }
}

#endif
