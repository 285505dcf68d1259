/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Copies of frames; see frame_copy.h. */
#include "data/frame_copy.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Copies count elements of so many floats or indices each; the array is not NULL even where there are none. */
static int copy_array(void **array, size_t *capacity, const void *from, size_t count, size_t numbers)
{
    if (count > SIZE_MAX / (numbers * sizeof(float)))
        return -1;
    const size_t bytes = count * numbers * sizeof(float), wanted = bytes ? bytes : 1;
    if (wanted > *capacity) {
        free(*array); /* what it held is of another frame */
        *array = malloc(wanted);
        *capacity = *array ? wanted : 0;
        if (!*array)
            return -1;
    }
    if (bytes)
        memcpy(*array, from, bytes);
    return 0;
}

void cgt_frame_copy_refer(frame_copy *copy, const cgt_trajectory_frame *frame)
{
    copy->frame = *frame;
    copy->frame.id = copy->frame.type = copy->frame.bond = NULL;
    copy->frame.velocity = NULL;
    copy->frame.element = NULL;
    copy->frame.column = NULL;
    copy->frame.bonds = copy->frame.columns = 0;
}

int cgt_frame_copy_set(frame_copy *copy, const cgt_trajectory_frame *frame)
{
    const int triangles = frame->kind == CGT_TRAJECTORY_TRIANGLES;
    cgt_frame_copy_refer(copy, frame);
    if (copy_array(&copy->places, &copy->place_bytes, triangles ? frame->position : frame->xyzr, frame->count,
                   triangles ? 3 : 4))
        return -1;
    if (triangles)
        copy->frame.position = copy->places;
    else
        copy->frame.xyzr = copy->places;
    if (!frame->vertex_normal)
        return 0;
    if (copy_array(&copy->normals, &copy->normal_bytes, frame->vertex_normal, frame->count, 3))
        return -1;
    copy->frame.vertex_normal = copy->normals;
    return 0;
}

int cgt_frame_copy_index(frame_copy *copy)
{
    cgt_trajectory_frame *const f = &copy->frame;
    if (f->kind != CGT_TRAJECTORY_TRIANGLES)
        return 0;
    if (copy_array(&copy->corners, &copy->corner_bytes, f->index, f->triangles, 3))
        return -1;
    f->index = copy->corners;
    return 0;
}

void cgt_frame_copy_free(frame_copy *copy)
{
    free(copy->places);
    free(copy->normals);
    free(copy->corners);
    memset(copy, 0, sizeof *copy);
}

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
    f.index = put(b, f.index, 3 * (size_t)f.triangles * sizeof *f.index); /* a reader that goes back frees its own */
    f.bond = put(b, f.bond, 2 * (size_t)f.bonds * sizeof *f.bond);
    put_columns(b, &f);
    if (to)
        *to = f;
}

cgt_trajectory_frame *cgt_frame_clone(const cgt_trajectory_frame *frame, size_t *bytes)
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
