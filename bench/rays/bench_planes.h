/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The planes that a frame is traced into: distance, primitive and normal of every pixel, row by row. */
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
    uint32_t *geometry; /* NULL: not asked for; not owned */
    void *memory;       /* of all of them */
} bench_planes;

/* Memory for `planes` planes of `elements` elements of four bytes, each *stride bytes behind the one before. Planes are
 * aligned to cache lines, and each begins one line further into a page than the one before: some machines write up to
 * twice as fast then, when lines of several planes alternate. Zeroed, so that the first frame does not pay for page
 * faults. NULL where memory is refused. */
void *bench_planes_memory(size_t elements, unsigned planes, size_t *stride);

/* 0, or -1 where memory is refused. */
int bench_planes_create(bench_planes *planes, uint32_t width, uint32_t height);
void bench_planes_release(bench_planes *planes);

/* Makes a frame for cgt_trace_camera that requests t, primitive and normal. */
void bench_planes_frame(const bench_planes *planes, cgt_frame *frame);

uint64_t bench_planes_hits(const bench_planes *planes);

/* Writes, for each pixel in row order, float32 t and uint32 primitive, little-endian. 0, or -1 with errno set. */
int bench_planes_write(const bench_planes *planes, FILE *file);

#endif
