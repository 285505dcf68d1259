/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Loads a trajectory, frame by frame. */
#define _POSIX_C_SOURCE 200809L /* access */
#include "common/bench_input.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "common/program.h"
#include "trajectory/trajectory_status.h"

/* Bytes of a sphere or a vertex. */
static size_t element_bytes(const bench_input *input)
{
    return (input->kind == CGT_TRAJECTORY_TRIANGLES ? 3 : 4) * sizeof(float);
}

/* Copies from the first frame what is the same in all frames. Returns 0, or -1 where memory is refused. */
static int take_kind(bench_input *input, const cgt_trajectory_frame *frame)
{
    input->kind = frame->kind;
    if (frame->kind != CGT_TRAJECTORY_TRIANGLES)
        return 0;
    /* The product cannot overflow: the reader holds as many bytes. */
    const size_t bytes = (size_t)frame->triangles * 3 * sizeof *input->index;
    input->index = malloc(bytes + 1);
    if (!input->index)
        return -1;
    memcpy(input->index, frame->index, bytes);
    input->triangles = frame->triangles;
    return 0;
}

/* Appends a copy of a frame. room: elements of the two arrays. Returns 0, or -1 where memory is refused. */
static int add_frame(bench_input *input, const cgt_trajectory_frame *frame, size_t *room)
{
    if (input->frames == *room) {
        const size_t wanted = *room ? 2 * *room : 64;
        if (wanted > SIZE_MAX / sizeof(float *) / 2)
            return -1;
        uint32_t *count = realloc(input->count, wanted * sizeof *count);
        if (!count)
            return -1;
        input->count = count;
        float **data = realloc(input->data, wanted * sizeof *data);
        if (!data)
            return -1;
        input->data = data;
        *room = wanted;
    }
    /* The product cannot overflow: the reader holds as many bytes. */
    const size_t bytes = (size_t)frame->count * element_bytes(input);
    float *copy = malloc(bytes + element_bytes(input));
    if (!copy)
        return -1;
    if (bytes)
        memcpy(copy, frame->kind == CGT_TRAJECTORY_TRIANGLES ? frame->position : frame->xyzr, bytes);
    input->count[input->frames] = frame->count;
    input->data[input->frames] = copy;
    input->frames++;
    if (frame->count > input->most)
        input->most = frame->count;
    return 0;
}

static int load_frames(bench_input *input, cgt_trajectory *source, uint64_t frames, char *error, size_t error_size)
{
    cgt_trajectory_frame frame;
    size_t room = 0;
    while (frames == 0 || input->frames < frames) {
        const int got = trajectory_status(source, cgt_trajectory_read(source, &frame), error, error_size);
        if (got < 0)
            return -1;
        if (got == 0)
            break;
        const char *warning;
        while ((warning = cgt_trajectory_take_warning(source)) != NULL)
            program_error("warning: %s", warning);
        if ((input->frames == 0 && take_kind(input, &frame)) || add_frame(input, &frame, &room)) {
            snprintf(error, error_size, "out of memory at frame %zu: %u %s", input->frames, (unsigned)frame.count,
                     frame.kind == CGT_TRAJECTORY_TRIANGLES ? "vertices" : "spheres");
            return -1;
        }
    }
    return 0;
}

/* Returns 0, or -1 with a text in error. */
static int load(bench_input *input, const bench_settings *settings, const char *path, char *error, size_t error_size)
{
    cgt_trajectory_options options;
    cgt_trajectory_options_init(&options);
    options.radius = settings->radius;
    options.wrapped = settings->wrapped;
    options.has_origin = true; /* 0, 0, 0: -c and the scene are in the file's coordinates */
    cgt_trajectory *source;
    const cgt_result opened = cgt_trajectory_open(path, &options, &source);
    int failed = trajectory_failed(source, opened, error, error_size);
    if (!failed)
        failed = load_frames(input, source, settings->frames, error, error_size);
    cgt_trajectory_close(source);
    if (failed)
        return -1;
    if (input->frames == 0) {
        snprintf(error, error_size, "%s: no frame in the file", path);
        return -1;
    }
    input->moving = calloc((size_t)input->most + 1, element_bytes(input));
    if (!input->moving)
        snprintf(error, error_size, "%s: out of memory", path);
    return input->moving ? 0 : -1;
}

int bench_input_load_file(bench_input *input, const bench_settings *settings, const char *path)
{
    char error[PROGRAM_ERROR_SIZE] = "";
    memset(input, 0, sizeof *input);
    if (!load(input, settings, path, error, sizeof error))
        return PROGRAM_OK;
    program_error("%s", error);
    bench_input_release(input);
    return PROGRAM_FAILED;
}

int bench_input_check_files(const bench_settings *settings)
{
    for (size_t i = 0; i < settings->files; i++)
        if (strcmp(settings->paths[i], "-") != 0 && access(settings->paths[i], R_OK)) {
            program_error("%s: %s", settings->paths[i], strerror(errno));
            return PROGRAM_FAILED;
        }
    return PROGRAM_OK;
}

void bench_input_release(bench_input *input)
{
    for (size_t i = 0; i < input->frames; i++)
        free(input->data[i]);
    free(input->data);
    free(input->index);
    free(input->count);
    free(input->moving);
    memset(input, 0, sizeof *input);
}

uint32_t bench_input_move(const bench_input *input, size_t frame)
{
    memcpy(input->moving, input->data[frame], (size_t)input->count[frame] * element_bytes(input));
    return input->count[frame];
}
