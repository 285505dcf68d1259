/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames that are kept; see frame_keep.h. */
#include "playback/frames/frame_keep.h"
#include "trajectory/trajectory_status.h"

#include <stdlib.h>
#include <string.h>

/* ---- Clones ------------------------------------------------------------------------------------------------- */

enum { ALIGNMENT = 16 };

/* A block that is being filled, or, while base is NULL, measured. */
typedef struct block {
    char *base;
    size_t end;
} block;

/* Takes room, and copies so many bytes there; NULL stays NULL. */
static void *put(block *b, const void *from, size_t bytes)
{
    char *const to = b->base ? b->base + b->end : NULL;
    if (!from)
        return NULL;
    b->end += (bytes + ALIGNMENT) / ALIGNMENT * ALIGNMENT; /* one byte at least: a place is no NULL */
    return to ? memcpy(to, from, bytes) : NULL;
}

static void put_columns(block *b, cgt_trajectory_frame *f)
{
    const cgt_trajectory_column *const from = f->column;
    cgt_trajectory_column *const to = put(b, from, f->columns * sizeof *from);
    for (uint32_t i = 0; i < f->columns; i++) {
        cgt_trajectory_column column = from[i];
        const int has_words = column.value && column.kind == CGT_TRAJECTORY_WORD;
        column.name = put(b, from[i].name, strlen(from[i].name) + 1);
        column.value = put(b, from[i].value, f->count * sizeof *column.value);
        column.word = put(b, has_words ? from[i].word : NULL, has_words ? column.words * sizeof *column.word : 0);
        if (to)
            to[i] = column;
    }
    f->column = to;
}

/* Puts a frame and its arrays into a block. */
static void put_frame(block *b, const cgt_trajectory_frame *frame)
{
    cgt_trajectory_frame f = *frame;
    cgt_trajectory_frame *const to = put(b, frame, sizeof *frame);
    const size_t n = f.count;
    f.xyzr = put(b, f.xyzr, n * 4 * sizeof *f.xyzr);
    f.position = put(b, f.position, n * 3 * sizeof *f.position);
    f.vertex_normal = put(b, f.vertex_normal, n * 3 * sizeof *f.vertex_normal);
    f.id = put(b, f.id, n * sizeof *f.id);
    f.type = put(b, f.type, n * sizeof *f.type);
    f.velocity = put(b, f.velocity, n * 3 * sizeof *f.velocity);
    f.element = put(b, f.element, n * sizeof *f.element);
    f.bond = put(b, f.bond, 2 * (size_t)f.bonds * sizeof *f.bond);
    put_columns(b, &f);
    if (to)
        *to = f;
}

cgt_trajectory_frame *frame_clone(const cgt_trajectory_frame *frame, size_t *bytes)
{
    block b = {NULL, 0};
    put_frame(&b, frame);
    *bytes = b.end;
    b = (block){malloc(b.end), 0};
    if (!b.base)
        return NULL;
    put_frame(&b, frame);
    return (cgt_trajectory_frame *)(void *)b.base;
}

/* ---- What is kept ------------------------------------------------------------------------------------------- */

void frame_keep_release(frame_keep *keep)
{
    for (uint64_t i = 0; i < keep->room; i++)
        free(keep->frame[i].clone);
    free(keep->frame);
    *keep = (frame_keep){.most = keep->most};
}

void frame_keep_begin(frame_keep *keep)
{
    frame_keep_release(keep);
    keep->is_keeping = keep->most > 0;
}

void frame_keep_end(frame_keep *keep, int is_whole)
{
    keep->is_keeping = 0;
    keep->is_whole = is_whole;
    keep->end = keep->next;
}

static const cgt_trajectory_frame *find(const frame_keep *keep)
{
    return keep->next < keep->room ? keep->frame[keep->next].clone : NULL;
}

/* Keeps a frame, as number keep->next. The first that finds no room is the last. */
static void add(frame_keep *keep, const cgt_trajectory_frame *frame)
{
    const uint64_t at = keep->next;
    size_t bytes;
    if (at >= keep->room) {
        const uint64_t room = at + at / 2 + 64;
        kept_frame *const more = realloc(keep->frame, room * sizeof *more);
        keep->is_keeping = more != NULL;
        if (!more)
            return;
        memset(more + keep->room, 0, (room - keep->room) * sizeof *more);
        keep->frame = more;
        keep->room = room;
    }
    cgt_trajectory_frame *const clone = frame_clone(frame, &bytes);
    keep->is_keeping = clone && bytes <= keep->most - keep->bytes;
    if (keep->is_keeping) {
        keep->frame[at].clone = clone;
        keep->bytes += bytes;
    } else {
        free(clone);
    }
}

/* Moves the file to the run's next frame. Returns 1, 0 where it ends before, or -1 with a text. */
static int catch_up(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size)
{
    int result = keep->is_whole && keep->next >= keep->end ? 0 : 1;
    while (result == 1 && keep->file_next < keep->next) {
        result = trajectory_status(file, cgt_trajectory_skip(file), error, error_size);
        keep->file_next += result == 1;
    }
    return result;
}

int frame_keep_read(frame_keep *keep, cgt_trajectory *file, cgt_trajectory_frame *frame, char *error, size_t error_size)
{
    const cgt_trajectory_frame *const kept = find(keep);
    int result = 1;
    if (kept) {
        *frame = *kept;
    } else {
        result = catch_up(keep, file, error, error_size);
        result = result == 1 ? trajectory_status(file, cgt_trajectory_read(file, frame), error, error_size) : result;
        keep->file_next += result == 1;
        if (result == 1 && keep->is_keeping)
            add(keep, frame);
    }
    keep->next += result == 1;
    return result;
}

int frame_keep_skip(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size)
{
    int result = 1;
    if (!find(keep)) {
        result = catch_up(keep, file, error, error_size);
        result = result == 1 ? trajectory_status(file, cgt_trajectory_skip(file), error, error_size) : result;
        keep->file_next += result == 1;
    }
    keep->next += result == 1;
    return result;
}

int frame_keep_rewind(frame_keep *keep, cgt_trajectory *file, char *error, size_t error_size)
{
    keep->next = keep->file_next = 0;
    return trajectory_failed(file, cgt_trajectory_rewind(file), error, error_size);
}
