/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The planes that a frame is traced into: distance, primitive and normal, and u and v where wanted, of every pixel, in
 * row order. */
#ifndef BENCH_PLANES_H
#define BENCH_PLANES_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cgt/cgt.h>

typedef struct bench_planes {
    uint32_t width, height; /* pixels; a row of a plane has width elements */
    float *t;
    uint32_t *primitive;
    float *normal[3];
    float *uv[2]; /* NULL where they were not asked for */
    void *memory; /* of all of them */
} bench_planes;

/* Memory for some planes of so many elements of four bytes, the second one *stride bytes behind the first. They begin on
 * lines of the cache, as in a program that wants its frames fast, and each a line further into a page than the one before:
 * where lines of several planes are written in turn, some machines take them up to twice as fast. Zeros, so that the
 * first frame does not pay for pages. NULL where memory is refused. */
void *bench_planes_memory(size_t elements, unsigned planes, size_t *stride);

/* 0, or -1 where memory is refused. */
int bench_planes_create(bench_planes *planes, uint32_t width, uint32_t height);
int bench_planes_create_with_uv(bench_planes *planes, uint32_t width, uint32_t height);
void bench_planes_release(bench_planes *planes);

/* The frame that asks cgt_trace_camera for t, primitive and normal. */
void bench_planes_frame(const bench_planes *planes, cgt_frame *frame);

uint64_t bench_planes_hits(const bench_planes *planes);

/* A number that changes with any bit of t, primitive or normal (but for one chance in 2^64). */
uint64_t bench_planes_hash(const bench_planes *planes);

/* Writes, for each pixel in row order, float32 t and uint32 primitive, little-endian. 0, or -1 with errno set. */
int bench_planes_write(const bench_planes *planes, FILE *file);

#endif
