/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Handing out frames, and what became of them; see render_share.h. Rank 0 has a thread that answers the others; its own
 * frames it hands out to itself by the same rules. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <time.h>

#include "common/program.h"
#include "render/share/share_messages.h"
#include "system/process.h"

enum { MOST_GRANTED = 8 }; /* frames at a time: a longer run saves reading frames for speeds, a shorter one waiting */

/* ---- Handing out -------------------------------------------------------------------------------------------- */

/* Remembers who got frames. Under the lock. */
static int remember_grant(render_share *s, uint64_t begin, uint64_t end, int rank)
{
    if (s->grant_count == s->grant_capacity) {
        const size_t capacity = s->grant_capacity ? 2 * s->grant_capacity : 64;
        share_grant *const grown = realloc(s->grants, capacity * sizeof *grown);
        if (!grown) {
            s->failed = 1;
            return -1;
        }
        s->grants = grown;
        s->grant_capacity = capacity;
    }
    s->grants[s->grant_count++] = (share_grant){begin, end, (uint32_t)rank, 0};
    return 0;
}

/* Hands out the next frames; none: an empty range. Under the lock. */
static void grant(render_share *s, int rank, uint64_t *begin, uint64_t *end)
{
    *begin = *end = s->next;
    if (s->failed || *s->stop || s->next >= s->end)
        return;
    uint64_t count = 1;
    if (s->end != UINT64_MAX) { /* few at the end, so that all end at about the same time */
        count = (s->end - s->next) / (4 * (uint64_t)s->link.size);
        count = count < 1 ? 1 : count > MOST_GRANTED ? MOST_GRANTED : count;
    }
    if (s->link.size > 1 && remember_grant(s, s->next, s->next + count, rank))
        return;
    *end = s->next += count;
    pthread_cond_broadcast(&s->changed);
}

int share_begin(render_share *s, uint64_t begin, uint64_t end)
{
    pthread_mutex_lock(&s->lock);
    s->next = begin;
    s->end = end;
    s->ready = 1;
    pthread_cond_broadcast(&s->changed);
    pthread_mutex_unlock(&s->lock);
    return 0;
}

static int ask(render_share *s, uint64_t range[2])
{
    const share_message message = {.event = EVENT_ASK};
    if (share_send_message(s, &message) != LINK_OK)
        return -1;
    return s->link.receive(0, TAG_GRANT, range, 2 * sizeof *range, NULL, NULL, share_stopped, s) == LINK_OK ? 0 : -1;
}

int share_next(render_share *s, uint64_t *chosen)
{
    uint64_t range[2] = {0, 0};
    int found = 0;
    pthread_mutex_lock(&s->lock);
    const int wanted = s->own == s->own_end && !s->failed;
    if (wanted && s->link.rank == 0)
        grant(s, 0, &range[0], &range[1]);
    if (wanted && s->link.rank > 0) {
        pthread_mutex_unlock(&s->lock);
        if (ask(s, range))
            range[1] = range[0];
        pthread_mutex_lock(&s->lock);
    }
    if (wanted) {
        s->own = range[0];
        s->own_end = range[1];
    }
    found = s->own < s->own_end && !s->failed;
    *chosen = s->own;
    s->own += (uint64_t)found;
    pthread_mutex_unlock(&s->lock);
    return found;
}

static void end_at(render_share *s, uint64_t chosen)
{
    s->end = chosen < s->end ? chosen : s->end;
    pthread_cond_broadcast(&s->changed);
}

void share_end_at(render_share *s, uint64_t chosen)
{
    const share_message message = {.event = EVENT_END, .chosen = chosen};
    pthread_mutex_lock(&s->lock);
    end_at(s, chosen);
    s->own = s->own_end = 0;
    pthread_mutex_unlock(&s->lock);
    if (s->link.rank > 0)
        share_send_message(s, &message);
}

/* ---- What became of the frames ------------------------------------------------------------------------------ */

/* The grant of a frame that was handed out. Under the lock. */
static share_grant *find_grant(const render_share *s, uint64_t chosen)
{
    size_t low = 0, high = s->grant_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (s->grants[middle].end <= chosen)
            low = middle + 1;
        else
            high = middle;
    }
    return low < s->grant_count && s->grants[low].begin <= chosen ? &s->grants[low] : NULL;
}

/* Under the lock, on rank 0. */
static void take_done(render_share *s, const share_done *done)
{
    share_grant *const granted = find_grant(s, done->chosen);
    if (granted)
        granted->done |= 1u << (done->chosen - granted->begin);
    s->done++;
    if (s->on_done(s->user, done))
        s->failed = 1;
}

void share_finish_frame(render_share *s, const share_done *done)
{
    if (s->link.rank > 0) {
        const share_message message = {.event = EVENT_DONE, .done = *done};
        share_send_message(s, &message);
        return;
    }
    pthread_mutex_lock(&s->lock);
    take_done(s, done);
    pthread_mutex_unlock(&s->lock);
}

static void set_failed(render_share *s)
{
    pthread_mutex_lock(&s->lock);
    s->failed = 1;
    pthread_cond_broadcast(&s->changed);
    pthread_mutex_unlock(&s->lock);
}

void share_fail(render_share *s)
{
    const share_message message = {.event = EVENT_FAILED};
    set_failed(s);
    if (s->link.rank > 0)
        share_send_message(s, &message);
}

int share_has_failed(render_share *s)
{
    pthread_mutex_lock(&s->lock);
    const int failed = s->failed;
    pthread_mutex_unlock(&s->lock);
    return failed;
}

uint64_t share_count_done(render_share *s)
{
    pthread_mutex_lock(&s->lock);
    const uint64_t done = s->done;
    pthread_mutex_unlock(&s->lock);
    return done;
}

/* ---- Rank 0's answers --------------------------------------------------------------------------------------- */

void share_wait_for_change(render_share *s)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += 100000000;
    if (until.tv_nsec >= 1000000000) {
        until.tv_nsec -= 1000000000;
        until.tv_sec++;
    }
    pthread_cond_timedwait(&s->changed, &s->lock, &until);
}

static void answer_ask(render_share *s, int rank)
{
    uint64_t range[2];
    pthread_mutex_lock(&s->lock);
    while (!s->ready && !s->failed && !*s->stop)
        share_wait_for_change(s);
    grant(s, rank, &range[0], &range[1]);
    pthread_mutex_unlock(&s->lock);
    s->link.send(rank, TAG_GRANT, range, sizeof range, share_stopped, s);
}

static void answer(render_share *s, const share_message *message, int rank)
{
    if (message->event == EVENT_ASK) {
        answer_ask(s, rank);
        return;
    }
    if (message->event == EVENT_TEXT) {
        program_error("%s", message->text);
        return;
    }
    pthread_mutex_lock(&s->lock);
    if (message->event == EVENT_DONE)
        take_done(s, &message->done);
    else if (message->event == EVENT_END)
        end_at(s, message->chosen);
    else if (message->event == EVENT_FAILED)
        s->failed = 1;
    else {
        s->left++;
        s->wrong |= message->wrong;
    }
    pthread_cond_broadcast(&s->changed);
    pthread_mutex_unlock(&s->lock);
}

static int all_left(render_share *s)
{
    pthread_mutex_lock(&s->lock);
    const int all = s->left == s->link.size - 1;
    pthread_mutex_unlock(&s->lock);
    return all;
}

void *share_serve(void *user)
{
    static share_message message; /* one server, and too large for a small stack */
    render_share *const s = user;
    int rank;
    while (!all_left(s) &&
           s->link.receive(LINK_ANY, TAG_CONTROL, &message, sizeof message, NULL, &rank, share_stopped, s) == LINK_OK)
        answer(s, &message, rank);
    return NULL;
}

/* ---- Pictures in order -------------------------------------------------------------------------------------- */

int share_find_owner(render_share *s, uint64_t chosen, int *rank)
{
    const share_grant *granted = NULL;
    pthread_mutex_lock(&s->lock);
    while (!s->failed && !*s->stop && chosen < s->end) {
        granted = find_grant(s, chosen);
        if (granted)
            break;
        share_wait_for_change(s);
    }
    const int found = granted && !s->failed && !*s->stop && chosen < s->end;
    if (found)
        *rank = (int)granted->rank;
    pthread_mutex_unlock(&s->lock);
    return found;
}

typedef struct picture_wait {
    render_share *share;
    uint64_t chosen;
} picture_wait;

/* The picture will not come. */
static int is_lost(void *user)
{
    const picture_wait *const w = user;
    pthread_mutex_lock(&w->share->lock);
    const int lost = w->share->failed || *w->share->stop || w->chosen >= w->share->end;
    pthread_mutex_unlock(&w->share->lock);
    return lost;
}

int share_send_picture(render_share *s, const uint8_t *rgb, size_t bytes)
{
    return s->link.send(0, TAG_PICTURE, rgb, bytes, share_stopped, s) == LINK_OK ? 0 : -1;
}

int share_receive_picture(render_share *s, uint64_t chosen, int rank, uint8_t *rgb, size_t bytes)
{
    picture_wait wait = {s, chosen};
    return s->link.receive(rank, TAG_PICTURE, rgb, bytes, NULL, NULL, is_lost, &wait) == LINK_OK ? 0 : -1;
}

static int is_over(void *user)
{
    render_share *const s = user;
    return *s->stop || all_left(s);
}

void share_drop_pictures(render_share *s, uint8_t *rgb, size_t bytes)
{
    while (s->link.receive(LINK_ANY, TAG_PICTURE, rgb, bytes, NULL, NULL, is_over, s) == LINK_OK)
        continue;
}

/* ---- What is missing ---------------------------------------------------------------------------------------- */

static void tell(const frame_range *range, uint64_t begin, uint64_t end, int rank)
{
    const uint64_t first = range->first + begin * range->every, last = range->first + (end - 1) * range->every;
    if (begin + 1 == end)
        program_error("frame %" PRIu64 " is missing: rank %d did not finish it", first, rank);
    else
        program_error("frames %" PRIu64 " to %" PRIu64 " are missing: rank %d did not finish them", first, last, rank);
}

void share_tell_missing(render_share *s, const frame_range *range)
{
    if (s->link.rank == 1 && s->first_pid && process_is_gone(s->first_pid))
        program_error(
            "rank 0 has died, which knows what became of the frames: movies and the report are lost, pictures that "
            "are there are whole");
    if (s->link.size < 2 || s->link.rank > 0)
        return;
    pthread_mutex_lock(&s->lock);
    for (size_t i = 0; i < s->grant_count; i++) {
        const share_grant *const g = &s->grants[i];
        const uint64_t end = g->end < s->end ? g->end : s->end;
        for (uint64_t k = g->begin; k < end;) {
            uint64_t after = k;
            while (after < end && !(g->done >> (after - g->begin) & 1u))
                after++;
            if (after > k)
                tell(range, k, after, (int)g->rank);
            k = after + 1;
        }
    }
    if (s->next < s->end)
        program_error("frames from %" PRIu64 " on are missing: they were not begun",
                      range->first + s->next * range->every);
    pthread_mutex_unlock(&s->lock);
}
