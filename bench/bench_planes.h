/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The planes that a frame is traced into: distance, primitive and normal of every pixel, in row order. */
#ifndef BENCH_PLANES_H
#define BENCH_PLANES_H

#include <stdint.h>
#include <stdio.h>

#include <cgt/cgt.h>

typedef struct bench_planes {
    uint32_t width, height; /* pixels; a row of a plane has width elements */
    float *t;
    uint32_t *primitive;
    float *normal[3];
} bench_planes;

/* 0, or -1 where memory is refused. */
int bench_planes_create(bench_planes *planes, uint32_t width, uint32_t height);
void bench_planes_release(bench_planes *planes);

/* The frame that asks cgt_trace_camera for t, primitive and normal. */
void bench_planes_frame(const bench_planes *planes, cgt_frame *frame);

uint64_t bench_planes_hits(const bench_planes *planes);

/* A number that changes with any bit of t, primitive or normal (but for one chance in 2^64). */
uint64_t bench_planes_hash(const bench_planes *planes);

/* Writes, for each pixel in row order, float32 t and uint32 primitive, little-endian. 0, or -1 with errno set. */
int bench_planes_write(const bench_planes *planes, FILE *file);

#endif
