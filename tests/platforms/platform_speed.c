/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How long a frame takes: scripts/platform_speed.sh compares platforms by it. For 2,000 and 100,000 spheres, which all
 * move every frame, a line: variant, spheres, and the least milliseconds of 15 frames of 1280x720, commit and distances
 * with ids, by one thread. First by the variant portable, where there is one, then by the one for this CPU. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cgt/cgt.h>

enum { WIDTH = 1280, HEIGHT = 720, FRAMES = 15 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

/* Returns the least milliseconds; negative: a call failed. */
static double least_frame(cgt_context *context, uint32_t count)
{
    static float t[WIDTH * HEIGHT];
    static uint32_t primitive[WIDTH * HEIGHT];
    float *const center = malloc(count * 3 * sizeof *center);
    const float size = cbrtf((float)count);
    const cgt_spheres spheres = {.count = count, .centers = cgt_floats(center, 0), .radius = 0.5f};
    const cgt_camera camera = {.eye = {0.3f * size, 0.2f * size, 1.6f * size}, .fov = 45};
    const cgt_frame frame = {.width = WIDTH, .height = HEIGHT, .t = t, .primitive = primitive};
    const cgt_trace_options options = {.precision = CGT_PRECISION_FAST};
    cgt_scene *scene = NULL;
    uint32_t state = 1;
    double least = center ? INFINITY : -1;
    for (uint32_t i = 0; i < 3 * count && center; i++) {
        state = state * 1664525u + 1013904223u;
        center[i] = size * ((float)(state >> 8) * 0x1p-24f - 0.5f);
    }
    if (!center || cgt_scene_create(context, NULL, &scene) || cgt_scene_set_spheres(scene, NULL, &spheres))
        least = -1;
    for (int k = 0; k < FRAMES && least >= 0; k++) {
        for (uint32_t i = 0; i < 3 * count; i++)
            center[i] += k & 1 ? -0.01f : 0.01f;
        const double begin = now();
        if (cgt_scene_commit(scene) || cgt_trace_camera(scene, &camera, &frame, &options))
            least = -1;
        else
            least = fmin(least, now() - begin);
    }
    cgt_scene_release(scene);
    free(center);
    return least;
}

static bool print_lines(cgt_context *context)
{
    static const uint32_t counts[] = {2000, 100000};
    for (int i = 0; i < 2; i++) {
        const double least = least_frame(context, counts[i]);
        if (least < 0)
            return false;
        printf("%s\t%u\t%.2f\n", cgt_context_get_variant(context), (unsigned)counts[i], least);
    }
    return true;
}

int main(void)
{
    cgt_context *portable = NULL, *usual = NULL;
    bool done = !cgt_context_create(&(cgt_context_options){.threads = 1}, &usual);
    if (!cgt_context_create(&(cgt_context_options){.threads = 1, .variant = "portable"}, &portable) && done &&
        strcmp(cgt_context_get_variant(usual), "portable") != 0)
        done = print_lines(portable);
    done = done && print_lines(usual);
    cgt_context_release(portable);
    cgt_context_release(usual);
    if (!done)
        fprintf(stderr, "platform_speed: a call failed\n");
    return !done;
}
