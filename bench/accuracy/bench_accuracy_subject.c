/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What accuracy is measured on: a hard case, or a frame of a file with rays of a camera's picture; with the exact hit
 * of each ray. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy/bench_accuracy.h"
#include "trajectory/trajectory.h"

#define BLOCK 8u /* edge of the squares of pixels that a file's rays are taken by */

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

/* Counts, and finds the truth. */
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

static int take_frame(accuracy_subject *subject, const trajectory_frame *frame)
{
    hard_geometry *g = &subject->scene.geometry[0];
    subject->scene.geometries = 1;
    /* the sizes cannot overflow: the reader holds as many bytes */
    if (frame->kind == TRAJECTORY_TRIANGLES) {
        g->vertex = malloc(((size_t)frame->count + 1) * sizeof *g->vertex);
        g->index = malloc(((size_t)frame->triangles + 1) * sizeof *g->index);
        if (!g->vertex || !g->index)
            return out_of_memory(subject);
        memcpy(g->vertex, frame->position, (size_t)frame->count * sizeof *g->vertex);
        memcpy(g->index, frame->index, (size_t)frame->triangles * sizeof *g->index);
        g->vertices = frame->count;
        g->triangles = frame->triangles;
        return PROGRAM_OK;
    }
    g->sphere = malloc(((size_t)frame->count + 1) * sizeof *g->sphere);
    if (!g->sphere)
        return out_of_memory(subject);
    if (frame->xyzr)
        memcpy(g->sphere, frame->xyzr, (size_t)frame->count * sizeof *g->sphere);
    g->spheres = frame->count;
    return PROGRAM_OK;
}

static int read_frame(accuracy_subject *subject, const char *path, uint64_t number)
{
    char error[PROGRAM_ERROR_SIZE] = "";
    trajectory_frame frame = {0};
    int code = PROGRAM_FAILED, got = 1;
    trajectory *file = trajectory_open(path, NULL, error, sizeof error);
    for (uint64_t i = 0; file && got == 1 && i < number; i++)
        got = trajectory_skip(file, error, sizeof error);
    if (file && got == 1)
        got = trajectory_read(file, &frame, error, sizeof error);
    if (!file || got < 0)
        program_error("%s", error);
    else if (got == 0)
        program_error("%s: no frame %llu in the file", path, (unsigned long long)number);
    else
        code = take_frame(subject, &frame);
    trajectory_close(file);
    return code;
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
    if (cgt_camera_prepare(&job->camera, job->width, job->height, &camera, message) != CGT_OK) {
        program_error("-c: %s", message);
        return PROGRAM_FAILED;
    }
    if (read_frame(subject, path, job->frame) != PROGRAM_OK)
        return PROGRAM_FAILED;
    subject->scene.wanted = job->rays;
    subject->scene.random = random_make(0);
    take_pixels(&subject->scene, &camera);
    return subject->scene.failed ? out_of_memory(subject) : finish(subject);
}
