/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Memory, comparison and file format of the planes. */
#include "rays/bench_planes.h"
#include "system/system.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t pixels_of(const bench_planes *planes) { return (size_t)planes->width * planes->height; }

void *bench_planes_memory(size_t elements, unsigned planes, size_t *stride)
{
    enum { LINE = 64, PAGE = 4096 };
    if (elements > (SIZE_MAX / planes - PAGE - LINE) / sizeof(float))
        return NULL;
    *stride = (elements * sizeof(float) + PAGE - 1) / PAGE * PAGE + LINE;
    void *memory = system_allocate_aligned(LINE, *stride * planes);
    if (memory)
        memset(memory, 0, *stride * planes);
    return memory;
}

int bench_planes_create(bench_planes *planes, uint32_t width, uint32_t height)
{
    enum { PLANES = 5 };
    size_t stride;
    float *plane[PLANES];
    memset(planes, 0, sizeof *planes);
    planes->width = width;
    planes->height = height;
    if ((uint64_t)width * height > SIZE_MAX)
        return -1;
    char *memory = bench_planes_memory(pixels_of(planes), PLANES, &stride);
    if (!memory)
        return -1;
    for (size_t i = 0; i < PLANES; i++)
        plane[i] = (float *)(void *)(memory + i * stride);
    planes->memory = memory;
    planes->t = plane[0];
    planes->primitive = (uint32_t *)(void *)plane[1];
    memcpy(planes->normal, plane + 2, sizeof planes->normal);
    return 0;
}

void bench_planes_release(bench_planes *planes)
{
    system_free_aligned(planes->memory);
    memset(planes, 0, sizeof *planes);
}

void bench_planes_frame(const bench_planes *planes, cgt_frame *frame)
{
    cgt_frame_init(frame, planes->width, planes->height);
    frame->t = planes->t;
    frame->primitive = planes->primitive;
    frame->geometry = planes->geometry;
    for (int i = 0; i < 3; i++)
        frame->normal[i] = planes->normal[i];
}

uint64_t bench_planes_hits(const bench_planes *planes)
{
    const size_t pixels = pixels_of(planes);
    uint64_t hits = 0;
    for (size_t i = 0; i < pixels; i++)
        hits += planes->t[i] < INFINITY;
    return hits;
}

static void store_le(unsigned char *bytes, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)(value >> 8 * i);
}

int bench_planes_write(const bench_planes *planes, FILE *file)
{
    const size_t pixels = pixels_of(planes);
    unsigned char block[8 * 512];

    for (size_t first = 0; first < pixels; first += 512) {
        const size_t count = pixels - first < 512 ? pixels - first : 512;
        for (size_t i = 0; i < count; i++) {
            uint32_t t;
            memcpy(&t, &planes->t[first + i], sizeof t);
            store_le(block + 8 * i, t);
            store_le(block + 8 * i + 4, planes->primitive[first + i]);
        }
        errno = 0;
        if (fwrite(block, 8, count, file) != count)
            return -1;
    }
    errno = 0;
    return fflush(file) ? -1 : 0;
}
