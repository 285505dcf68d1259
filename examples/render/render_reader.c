/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reading ahead; see render_reader.h. */
#define _POSIX_C_SOURCE 200809L
#include "render/render_reader.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Waits for a copy that is free: NULL where the reader is being closed. */
static read_frame *wait_for_room(render_reader *r)
{
    pthread_mutex_lock(&r->lock);
    while (!r->closing && r->read - r->given_back == READ_AHEAD)
        pthread_cond_wait(&r->changed, &r->lock);
    read_frame *const frame = r->closing ? NULL : &r->frames[r->read % READ_AHEAD];
    pthread_mutex_unlock(&r->lock);
    return frame;
}

/* Colours the frame that was read, into the index of the copy. */
static int color_frame(render_reader *r, read_frame *frame)
{
    coloring *const c = &r->coloring;
    c->index = frame->index;
    c->capacity = frame->index_capacity;
    const int failed = coloring_apply(c, &r->source->frame, r->source->speed);
    frame->index = c->index;
    frame->index_capacity = c->capacity;
    frame->per_vertex = c->per_vertex;
    c->index = NULL;
    c->capacity = 0;
    return failed;
}

/* Reads one frame into a copy. Results as frame_source_read. */
static int read_one(render_reader *r, read_frame *frame)
{
    const double begin = program_seconds();
    const uint64_t number = r->range.first + frame->chosen * r->range.every;
    const int result = frame_source_read(r->source, number, r->error, sizeof r->error);
    if (result != 1)
        return result;
    if (r->read == 0 && r->check && r->check(r->user, &r->source->frame))
        return -1;
    const double middle = program_seconds();
    const int failed = color_frame(r, frame) || frame_copy_set(&frame->copy, &r->source->frame);
    frame->speed_from = r->source->speed_from;
    frame->read_ms = (middle - begin) * 1e3;
    if (!failed &&
        render_scene_prepare(r->renderer, &r->source->frame, frame->index, &frame->parts, r->error, sizeof r->error))
        return -1;
    frame->color_ms = (program_seconds() - middle) * 1e3;
    if (!failed)
        return 1;
    snprintf(r->error, sizeof r->error, "out of memory for the %" PRIu32 " primitives of frame %" PRIu64,
             frame_primitives(&r->source->frame), number);
    return -1;
}

static void *read_frames(void *user)
{
    render_reader *const r = user;
    int result = 1;
    while (result == 1 && !*r->stop) {
        read_frame *const frame = wait_for_room(r);
        if (!frame || !share_next(r->share, &frame->chosen))
            break;
        result = read_one(r, frame);
        if (result != 1)
            share_end_at(r->share, frame->chosen);
        pthread_mutex_lock(&r->lock);
        r->read += result == 1;
        r->failed = result < 0;
        pthread_cond_broadcast(&r->changed);
        pthread_mutex_unlock(&r->lock);
    }
    pthread_mutex_lock(&r->lock);
    r->ended = 1;
    pthread_cond_broadcast(&r->changed);
    pthread_mutex_unlock(&r->lock);
    return NULL;
}

int render_reader_start(render_reader *r)
{
    free(r->coloring.index);
    r->coloring.index = NULL;
    r->coloring.capacity = 0;
    for (int i = 0; i < READ_AHEAD; i++) /* coloring_apply grows an index that is there */
        r->frames[i].index = calloc(1, sizeof *r->frames[i].index);
    pthread_mutex_init(&r->lock, NULL);
    pthread_cond_init(&r->changed, NULL);
    r->has_thread =
        r->frames[0].index && r->frames[READ_AHEAD - 1].index && pthread_create(&r->thread, NULL, read_frames, r) == 0;
    if (!r->has_thread)
        program_error("cannot start a thread that reads");
    return r->has_thread ? 0 : -1;
}

int render_reader_take(render_reader *r, read_frame **frame)
{
    int result = 1;
    pthread_mutex_lock(&r->lock);
    while (r->read == r->taken && !r->ended)
        pthread_cond_wait(&r->changed, &r->lock);
    if (r->read > r->taken)
        *frame = &r->frames[r->taken++ % READ_AHEAD];
    else
        result = r->failed ? -1 : 0;
    pthread_mutex_unlock(&r->lock);
    if (result < 0 && *r->error)
        program_error("%s", r->error);
    return result;
}

void render_reader_give_back(render_reader *r)
{
    pthread_mutex_lock(&r->lock);
    r->given_back = r->taken;
    pthread_cond_broadcast(&r->changed);
    pthread_mutex_unlock(&r->lock);
}

void render_reader_finish(render_reader *r)
{
    if (r->has_thread) {
        pthread_mutex_lock(&r->lock);
        r->closing = 1;
        pthread_cond_broadcast(&r->changed);
        pthread_mutex_unlock(&r->lock);
        pthread_join(r->thread, NULL);
        r->has_thread = 0;
    }
    for (int i = 0; i < READ_AHEAD; i++) {
        frame_copy_free(&r->frames[i].copy);
        frame_parts_free(&r->frames[i].parts);
        free(r->frames[i].index);
        r->frames[i].index = NULL;
    }
}
