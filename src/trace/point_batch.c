/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See point_batch.h. What is off or invalid here is what kernels take for that (kernel/packet/ray_packet.h). */
#include "trace/point_batch.h"

#include <math.h>
#include <string.h>

/* ---- the caller's arrays ---- */

static size_t stride_of(const cgt_rays *points) { return points->stride ? points->stride : sizeof(float); }

static const void *element(const void *array, size_t stride, uint64_t i)
{
    return (const char *)array + (size_t)i * stride;
}
static float float_at(const float *array, size_t stride, uint64_t i)
{
    return *(const float *)element(array, stride, i);
}
static uint32_t number_at(const uint32_t *array, size_t stride, uint64_t i)
{
    return *(const uint32_t *)element(array, stride, i);
}

/* ---- live points ---- */

#define MAGNITUDE 0x7fffffff /* the bits of a float but its sign: they order as magnitudes do */
#define INFINITE 0x7f800000

static inline int32_t magnitude_bits(float f)
{
    int32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return bits & MAGNITUDE;
}

/* In whole numbers: the compiler makes vectors of the loop. */
bool cgt_points_are_live(const cgt_rays *points, const cgt_light *light)
{
    const bool is_point = light->kind == CGT_LIGHT_POINT;
    const float *x = points->org[0], *y = points->org[1], *z = points->org[2];
    const float lx = is_point ? light->position[0] : 0, ly = is_point ? light->position[1] : 0,
                lz = is_point ? light->position[2] : 0;
    int32_t most = 0, least = MAGNITUDE;
    if (stride_of(points) != sizeof(float) || points->t_min || points->t_max)
        return false;
    for (uint64_t i = 0; i < points->count; i++) {
        const int32_t px = magnitude_bits(x[i]), py = magnitude_bits(y[i]), pz = magnitude_bits(z[i]);
        const int32_t dx = magnitude_bits(lx - x[i]), dy = magnitude_bits(ly - y[i]), dz = magnitude_bits(lz - z[i]);
        most = px > most ? px : most;
        most = py > most ? py : most;
        most = pz > most ? pz : most;
        most = dx > most ? dx : most;
        most = dy > most ? dy : most;
        most = dz > most ? dz : most;
        least = (dx | dy | dz) < least ? dx | dy | dz : least;
    }
    return most < INFINITE && (!is_point || least > 0);
}

/* ---- batches ---- */

static void copy_numbers(const uint32_t *array, size_t stride, const uint32_t *number, uint32_t count, uint32_t *to)
{
    for (uint32_t k = 0; array && k < count; k++)
        to[k] = number_at(array, stride, number[k]);
}

static void copy_floats(const float *array, size_t stride, const uint32_t *number, uint32_t count, float *to)
{
    for (uint32_t k = 0; array && k < count; k++)
        to[k] = float_at(array, stride, number[k]);
}

void cgt_point_batch_fill(cgt_point_batch *b, const cgt_rays *points, const uint32_t *number, uint32_t count)
{
    const size_t stride = stride_of(points);
    for (int a = 0; a < 3; a++)
        copy_floats(points->org[a], stride, number, count, b->position[a]);
    copy_floats(points->t_min, stride, number, count, b->t_min);
    copy_floats(points->t_max, stride, number, count, b->t_max);
    copy_numbers(points->mask, stride, number, count, b->mask);
    copy_numbers(points->skip_primitive, stride, number, count, b->primitive);
    copy_numbers(points->skip_geometry, stride, number, count, b->geometry);
    b->rays = (cgt_rays){.count = count,
                         .org = {b->position[0], b->position[1], b->position[2]},
                         .t_min = points->t_min ? b->t_min : NULL,
                         .t_max = points->t_max ? b->t_max : NULL,
                         .mask = points->mask ? b->mask : NULL,
                         .skip_primitive = points->skip_primitive ? b->primitive : NULL,
                         .skip_geometry = points->skip_geometry ? b->geometry : NULL};
}
