/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Subjects: a hard case, or the first frame of a file with rays of the camera's picture. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy/bench_accuracy.h"
#include "common/bench_input.h"

#define BLOCK 8u /* pixels along the edge of the squares that a file's rays come from */

void accuracy_subject_free(accuracy_subject *subject)
{
    hard_truth_free(&subject->truth);
    hard_scene_free(&subject->scene);
}

static int out_of_memory(accuracy_subject *subject)
{
    program_error("%s: out of memory", subject->name);
    accuracy_subject_free(subject);
    return PROGRAM_FAILED;
}

/* Counts the triangles, and finds the truth. */
static int finish(accuracy_subject *subject)
{
    for (uint32_t g = 0; g < subject->scene.geometries; g++)
        subject->triangles += subject->scene.geometry[g].triangles;
    return hard_truth_make(&subject->scene, &subject->truth) ? PROGRAM_OK : out_of_memory(subject);
}

int accuracy_subject_case(accuracy_subject *subject, const hard_case *hard, uint32_t rays)
{
    cgt_context *context;
    memset(subject, 0, sizeof *subject);
    snprintf(subject->name, sizeof subject->name, "%s: %s", hard->row, hard->name);
    if (!hard_case_make(hard, rays, &subject->scene))
        return out_of_memory(subject);
    cgt_result result = bench_context_create(1, NULL, &context);
    if (result == CGT_OK) {
        result = hard_follow(context, hard, &subject->scene);
        if (result != CGT_OK)
            bench_scene_failed(context, subject->name, result);
        cgt_context_release(context);
    } else
        bench_scene_failed(NULL, subject->name, result);
    if (result != CGT_OK) {
        accuracy_subject_free(subject);
        return PROGRAM_FAILED;
    }
    return finish(subject);
}

/* ---- files ---- */

/* A copy of `bytes` bytes plus one, so that an empty copy is not NULL; NULL if memory is refused. */
static void *copy_of(const void *from, size_t bytes)
{
    void *copy = malloc(bytes + 1);
    if (copy && bytes)
        memcpy(copy, from, bytes);
    return copy;
}

/* The first frame of a file becomes the subject's geometry. */
static int read_frame(accuracy_subject *subject, const bench_settings *settings, const char *path)
{
    hard_geometry *g = &subject->scene.geometry[0];
    bench_settings first = *settings;
    bench_input input;
    first.frames = 1;
    if (bench_input_load_file(&input, &first, path))
        return PROGRAM_FAILED;
    const size_t count = input.count[0];
    int complete;
    subject->scene.geometries = 1;
    if (input.index) {
        g->vertices = input.count[0];
        g->triangles = input.triangles;
        g->vertex = copy_of(input.data[0], count * sizeof *g->vertex);
        g->index = copy_of(input.index, (size_t)input.triangles * sizeof *g->index);
        complete = g->vertex && g->index;
    } else {
        g->spheres = input.count[0];
        g->sphere = copy_of(input.data[0], count * sizeof *g->sphere);
        complete = g->sphere != NULL;
    }
    bench_input_release(&input);
    return complete ? PROGRAM_OK : out_of_memory(subject);
}

/* Squares of pixels at random places of the picture. */
static void take_pixels(hard_scene *scene, const cgt_camera_rays *camera)
{
    const uint32_t columns = (camera->width + BLOCK - 1) / BLOCK, rows = (camera->height + BLOCK - 1) / BLOCK;
    while (hard_wants_ray(scene)) {
        const uint32_t column = random_below(&scene->random, columns), row = random_below(&scene->random, rows);
        for (uint32_t i = 0; i < BLOCK * BLOCK; i++) {
            const uint32_t x = column * BLOCK + i % BLOCK, y = row * BLOCK + i / BLOCK;
            if (x < camera->width && y < camera->height) {
                const truth_ray ray = camera_ray(camera, x, y);
                hard_raw_ray(scene, &ray);
            }
        }
    }
}

int accuracy_subject_file(accuracy_subject *subject, const accuracy_job *job, const char *path)
{
    cgt_camera_rays camera;
    char message[160];
    memset(subject, 0, sizeof *subject);
    snprintf(subject->name, sizeof subject->name, "%s", path);
    if (cgt_camera_prepare(&job->shared.camera, job->shared.width, job->shared.height, &camera, message) != CGT_OK) {
        program_error("-c: %s", message);
        return PROGRAM_FAILED;
    }
    if (read_frame(subject, &job->shared, path) != PROGRAM_OK)
        return PROGRAM_FAILED;
    subject->scene.wanted = job->rays;
    subject->scene.random = random_make(0);
    take_pixels(&subject->scene, &camera);
    return subject->scene.failed ? out_of_memory(subject) : finish(subject);
}
