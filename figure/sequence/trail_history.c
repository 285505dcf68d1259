/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Places in frames before; see trail_history.h. Each frame of a ring knows for its spheres their indices in the frame
 * before it, so that a trail is a walk from frame to frame, and ids are sought once a frame. */
#include "sequence/trail_history.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sequence/id_match.h"

typedef struct trail_frame {
    float *xyz;       /* 3 floats a sphere */
    uint32_t *before; /* its index in the frame before; UINT32_MAX: it was not there */
    uint32_t count, capacity;
} trail_frame;

struct trail_history {
    uint32_t length;
    trail_frame *frame; /* length + 1 of them: frame k lies at k % (length + 1) */
    uint64_t added;     /* since the start */
    uint64_t last_number;
    id_match last; /* the spheres of the newest */
};

trail_history *cgt_trail_history_create(uint32_t length)
{
    trail_history *h = calloc(1, sizeof *h);
    if (!h)
        return NULL;
    h->length = length;
    h->frame = calloc((size_t)length + 1, sizeof *h->frame);
    if (h->frame)
        return h;
    free(h);
    return NULL;
}

void cgt_trail_history_release(trail_history *h)
{
    if (!h)
        return;
    for (uint32_t k = 0; k <= h->length; k++) {
        free(h->frame[k].xyz);
        free(h->frame[k].before);
    }
    free(h->frame);
    cgt_id_match_free(&h->last);
    free(h);
}

uint32_t cgt_trail_history_length(const trail_history *h) { return h->length; }

void cgt_trail_history_restart(trail_history *h) { h->added = 0; }

static trail_frame *at(const trail_history *h, uint64_t number) { return &h->frame[number % (h->length + 1)]; }

static int reserve(trail_frame *t, uint32_t count)
{
    if (count <= t->capacity && t->xyz)
        return 0;
    const size_t wanted = count ? count : 1;
    free(t->xyz); /* what it holds is of a frame that is over */
    free(t->before);
    t->xyz = wanted <= SIZE_MAX / (3 * sizeof(float)) ? malloc(wanted * 3 * sizeof(float)) : NULL;
    t->before = malloc(wanted * sizeof *t->before);
    t->capacity = t->xyz && t->before ? count : 0;
    return t->xyz && t->before ? 0 : -1;
}

int cgt_trail_history_add(trail_history *h, const cgt_trajectory_frame *f)
{
    trail_frame *const t = at(h, h->added);
    const int follows = h->added > 0 && f->number > h->last_number;
    t->count = 0;
    if (reserve(t, f->count) || (follows && cgt_id_match_prepare(&h->last, f->id, f->count)))
        return -1;
    for (uint32_t i = 0; i < f->count; i++) {
        memcpy(t->xyz + 3 * (size_t)i, f->xyzr + 4 * (size_t)i, 3 * sizeof(float));
        t->before[i] = follows ? id_match_find(&h->last, f->id, f->count, i) : UINT32_MAX;
    }
    t->count = f->count;
    h->last_number = f->number;
    h->added++;
    return cgt_id_match_remember(&h->last, f->id, f->count);
}

uint32_t cgt_trail_history_places(const trail_history *h, uint32_t i, float (*place)[3])
{
    uint32_t count = 0;
    for (uint64_t age = 0; age <= h->length && age < h->added; age++) {
        const trail_frame *const t = at(h, h->added - 1 - age);
        if (i >= t->count)
            break;
        const float *const p = t->xyz + 3 * (size_t)i;
        if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2]))
            break;
        memcpy(place[count++], p, 3 * sizeof *p);
        i = t->before[i];
    }
    return count;
}
