/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Keeps rays: bench_rays.c makes them batch by batch, and hands each batch to a sink, which here appends it. */
#include "rays/bench_ray_arrays.h"

#include <stdlib.h>
#include <string.h>

#include "common/bench_random.h"

cgt_result bench_ray_array_reserve(bench_ray_array *rays, uint64_t more)
{
    if (more > SIZE_MAX / 4 / sizeof(float) - rays->count)
        return CGT_ERROR_TOO_LARGE;
    if (rays->count + more <= rays->room)
        return CGT_OK;
    uint64_t room = rays->count + more;
    if (room < 2 * rays->room)
        room = 2 * rays->room;
    float **const arrays[] = {&rays->org[0], &rays->org[1], &rays->org[2], &rays->dir[0],
                              &rays->dir[1], &rays->dir[2], &rays->t_max};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        float *larger = realloc(*arrays[i], (size_t)room * sizeof *larger);
        if (!larger)
            return CGT_ERROR_OUT_OF_MEMORY;
        *arrays[i] = larger;
    }
    rays->room = room;
    return CGT_OK;
}

static cgt_result keep_batch(void *user, const cgt_rays *batch, const cgt_hits *scratch, uint8_t *occluded)
{
    (void)scratch;
    bench_ray_array *rays = user;
    const cgt_result result = bench_ray_array_reserve(rays, batch->count);
    if (result != CGT_OK)
        return result;
    const size_t bytes = (size_t)batch->count * sizeof(float);
    for (int a = 0; a < 3; a++) {
        memcpy(rays->org[a] + rays->count, batch->org[a], bytes);
        memcpy(rays->dir[a] + rays->count, batch->dir[a], bytes);
    }
    rays->bounded = batch->t_max != NULL;
    if (batch->t_max)
        memcpy(rays->t_max + rays->count, batch->t_max, bytes);
    rays->count += batch->count;
    memset(occluded, 0, (size_t)batch->count);
    return CGT_OK;
}

cgt_result bench_ray_array_shadow(bench_ray_array *rays, bench_rays *maker, const float light[3])
{
    const bench_rays_sink sink = {.batch = keep_batch, .user = rays};
    uint64_t hidden = 0;
    rays->count = 0;
    return bench_rays_shadow(maker, &sink, light, &hidden);
}

cgt_result bench_ray_array_ao(bench_ray_array *rays, bench_rays *maker, uint32_t samples)
{
    const bench_rays_sink sink = {.batch = keep_batch, .user = rays};
    uint64_t open = 0;
    rays->count = 0;
    return bench_rays_ao(maker, &sink, samples, &open);
}

cgt_result bench_ray_array_bounce(bench_ray_array *rays, bench_rays *maker)
{
    const bench_rays_sink sink = {.batch = keep_batch, .user = rays};
    rays->count = 0;
    return bench_rays_bounce(maker, &sink);
}

cgt_result bench_ray_array_random(bench_ray_array *rays, uint32_t count, const float low[3], const float high[3])
{
    uint64_t state = bench_random_start;
    rays->count = 0;
    rays->bounded = 0;
    const cgt_result result = bench_ray_array_reserve(rays, count);
    if (result != CGT_OK)
        return result;
    for (uint32_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            const float size = high[a] - low[a];
            const float from = low[a] + bench_random(&state) * size, to = low[a] + bench_random(&state) * size;
            rays->org[a][i] = from;
            rays->dir[a][i] = to - from;
        }
    rays->count = count;
    return CGT_OK;
}

cgt_rays bench_ray_array_view(const bench_ray_array *rays)
{
    cgt_rays array;
    memset(&array, 0, sizeof array);
    array.count = rays->count;
    for (int a = 0; a < 3; a++) {
        array.org[a] = rays->org[a];
        array.dir[a] = rays->dir[a];
    }
    array.t_max = rays->bounded ? rays->t_max : NULL;
    return array;
}

void bench_ray_array_release(bench_ray_array *rays)
{
    for (int a = 0; a < 3; a++) {
        free(rays->org[a]);
        free(rays->dir[a]);
    }
    free(rays->t_max);
    memset(rays, 0, sizeof *rays);
}
