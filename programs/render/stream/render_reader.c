/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Reading ahead; see render_reader.h. */
#define _POSIX_C_SOURCE 200809L
#include "render/stream/render_reader.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Waits for a copy that is free: NULL where the reader is being closed. */
static read_frame *wait_for_room(render_reader *r)
{
    const cgt_trajectory_frame *const f = &r->source->sequence->frame;
    const uint64_t copies = (uint64_t)f->count * 4 * sizeof(float) > READ_LARGE ? 1 : READ_AHEAD;
    pthread_mutex_lock(&r->lock);
    while (!r->closing && r->read - r->given_back >= copies)
        pthread_cond_wait(&r->changed, &r->lock);
    int place = 0; /* the first that is free: where there is one copy, it is always the same */
    while (place < READ_AHEAD - 1 && r->frames[place].busy)
        place++;
    r->place[r->read % READ_AHEAD] = place;
    read_frame *const frame = r->closing ? NULL : &r->frames[place];
    pthread_mutex_unlock(&r->lock);
    return frame;
}

/* The colours of the frame become the copy's; the copy's index is that of the next frame. */
static void swap_index(render_reader *r, read_frame *frame)
{
    coloring *const c = &r->coloring;
    uint16_t *const index = frame->index;
    const size_t capacity = frame->index_capacity;
    frame->index = c->index;
    frame->index_capacity = c->capacity;
    frame->per_vertex = c->per_vertex;
    c->index = index;
    c->capacity = capacity;
}

/* Reads one frame and finds its colours, then waits for a copy. Returns 1, 0 where the input ends, -1 on an error, 2
 * where the reader is being closed. */
static int read_one(render_reader *r, uint64_t chosen)
{
    const double begin = program_seconds();
    const uint64_t number = r->range.first + chosen * r->range.every;
    const int result = frame_source_read(r->source, number, r->error, sizeof r->error);
    if (result != 1)
        return result;
    if (r->read == 0 && r->check && r->check(r->user, &r->source->sequence->frame))
        return -1;
    const double read = program_seconds();
    int failed = cgt_coloring_apply(&r->coloring, &r->source->sequence->frame, r->source->sequence->speed);
    const double colored = program_seconds();
    read_frame *const frame = failed ? NULL : wait_for_room(r);
    if (!failed && !frame)
        return 2;
    if (frame) {
        const double copy = program_seconds();
        swap_index(r, frame);
        const int is_kept = frame_keep_has(&r->source->keep, &r->source->sequence->frame);
        if (is_kept)
            cgt_frame_copy_refer(&frame->copy, &r->source->sequence->frame);
        else
            failed = cgt_frame_copy_set(&frame->copy, &r->source->sequence->frame);
        frame->chosen = chosen;
        frame->speed_from = r->source->sequence->speed_from;
        frame->read_ms = (read - begin + program_seconds() - copy) * 1e3;
        frame->color_ms = (colored - read) * 1e3;
        if (!failed && cgt_figure_scene_prepare(r->figure, &r->source->sequence->frame, frame->index, &frame->parts,
                                                r->error, sizeof r->error))
            return -1;
    }
    if (!failed)
        return 1;
    snprintf(r->error, sizeof r->error, "out of memory for the %" PRIu32 " primitives of frame %" PRIu64,
             frame_primitives(&r->source->sequence->frame), number);
    return -1;
}

static void *read_frames(void *user)
{
    render_reader *const r = user;
    int result = 1;
    while (result == 1 && !*r->stop && r->next < r->end) {
        result = read_one(r, r->next++);
        pthread_mutex_lock(&r->lock);
        if (result == 1)
            r->frames[r->place[r->read++ % READ_AHEAD]].busy = 1;
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
    int wrong = 0;
    for (int i = 0; i < READ_AHEAD; i++) { /* cgt_coloring_apply grows an index that is there */
        r->frames[i].index = calloc(1, sizeof *r->frames[i].index);
        r->frames[i].index_capacity = 1;
        wrong |= !r->frames[i].index;
    }
    pthread_mutex_init(&r->lock, NULL);
    pthread_cond_init(&r->changed, NULL);
    r->has_thread = !wrong && pthread_create(&r->thread, NULL, read_frames, r) == 0;
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
        *frame = &r->frames[r->place[r->taken++ % READ_AHEAD]];
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
    r->frames[r->place[r->given_back++ % READ_AHEAD]].busy = 0;
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
        cgt_frame_copy_free(&r->frames[i].copy);
        cgt_frame_parts_free(&r->frames[i].parts);
        free(r->frames[i].index);
        r->frames[i].index = NULL;
    }
}
