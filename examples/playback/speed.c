/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The speed of each sphere; see speed.h. Spheres find their last position through a hash table of ids with open
 * addressing, which is built only where the order has changed. */
#include "playback/speed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "playback/frame_source.h"

struct speed_tracker {
    uint32_t capacity; /* spheres that the arrays hold */
    float *speed;
    float *last_xyz; /* of the frame before: 3 floats each */
    uint32_t *last_id;
    uint32_t last_count;
    int64_t last_step;
    int has_last;
    int last_has_id;
    uint32_t *slots;   /* index + 1 of the sphere in the frame before; 0 is free */
    size_t slot_count; /* a power of two, at least twice last_count */
    int slots_valid;
};

speed_tracker *speed_create(void) { return calloc(1, sizeof(speed_tracker)); }

void speed_release(speed_tracker *tracker)
{
    if (!tracker)
        return;
    free(tracker->speed);
    free(tracker->last_xyz);
    free(tracker->last_id);
    free(tracker->slots);
    free(tracker);
}

void speed_restart(speed_tracker *tracker) { tracker->has_last = 0; }

/* Grows one array to count elements of size bytes; its contents stay. */
static int grow(void **array, size_t count, size_t size)
{
    if (count > SIZE_MAX / size)
        return -1;
    void *grown = realloc(*array, count * size);
    if (!grown)
        return -1;
    *array = grown;
    return 0;
}

static int reserve(speed_tracker *t, uint32_t count)
{
    if (count <= t->capacity)
        return 0;
    void *speed = t->speed, *xyz = t->last_xyz, *id = t->last_id;
    const int failed = grow(&speed, count, sizeof(float)) || grow(&xyz, count, 3 * sizeof(float)) ||
                       grow(&id, count, sizeof(uint32_t));
    t->speed = speed;
    t->last_xyz = xyz;
    t->last_id = id;
    if (failed)
        return -1;
    t->capacity = count;
    return 0;
}

/* Ids of spheres; vertices keep their indices. */
static const uint32_t *ids(const trajectory_frame *frame)
{
    return frame->kind == TRAJECTORY_TRIANGLES ? NULL : frame->id;
}

static size_t slot_of(const speed_tracker *t, uint32_t id)
{
    return (size_t)((id * UINT64_C(0x9E3779B97F4A7C15)) >> 32) & (t->slot_count - 1);
}

/* Enters the ids of the frame before; of equal ids the first counts. */
static int make_slots(speed_tracker *t)
{
    size_t needed = 16;
    while (needed / 2 < t->last_count)
        needed *= 2;
    if (needed > t->slot_count) {
        void *slots = t->slots;
        if (grow(&slots, needed, sizeof(uint32_t)))
            return -1;
        t->slots = slots;
        t->slot_count = needed;
    }
    memset(t->slots, 0, t->slot_count * sizeof(uint32_t));
    for (uint32_t i = 0; i < t->last_count; i++) {
        size_t slot = slot_of(t, t->last_id[i]);
        while (t->slots[slot] && t->last_id[t->slots[slot] - 1] != t->last_id[i])
            slot = (slot + 1) & (t->slot_count - 1);
        if (!t->slots[slot])
            t->slots[slot] = i + 1;
    }
    t->slots_valid = 1;
    return 0;
}

/* The index of sphere i of frame in the frame before; UINT32_MAX where it has none. */
static uint32_t last_index(const speed_tracker *t, const trajectory_frame *frame, uint32_t i)
{
    if (!ids(frame) || !t->last_has_id)
        return i < t->last_count && frame->count >= t->last_count && !ids(frame) == !t->last_has_id ? i : UINT32_MAX;
    const uint32_t id = ids(frame)[i];
    if (i < t->last_count && t->last_id[i] == id)
        return i;
    if (!t->slots_valid)
        return UINT32_MAX;
    for (size_t slot = slot_of(t, id); t->slots[slot]; slot = (slot + 1) & (t->slot_count - 1))
        if (t->last_id[t->slots[slot] - 1] == id)
            return t->slots[slot] - 1;
    return UINT32_MAX;
}

/* Distance from a to b, the short way where the box is periodic. */
static double distance(const float *a, const float *b, const double edge[3])
{
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
        double d = (double)b[c] - (double)a[c];
        if (edge[c] > 0.0)
            d -= edge[c] * rint(d / edge[c]);
        sum += d * d;
    }
    return sqrt(sum);
}

static int ids_moved(const speed_tracker *t, const trajectory_frame *frame)
{
    return ids(frame) && frame->count && t->last_has_id &&
           (frame->count > t->last_count || memcmp(ids(frame), t->last_id, frame->count * sizeof(uint32_t)) != 0);
}

static int from_positions(speed_tracker *t, const trajectory_frame *frame)
{
    const int later = t->has_last && frame->step > t->last_step;
    double edge[3];
    for (int c = 0; c < 3; c++) {
        edge[c] = (double)frame->box_max[c] - (double)frame->box_min[c];
        if (!isfinite(edge[c]))
            edge[c] = 0.0;
    }
    t->slots_valid = 0;
    if (t->has_last && ids_moved(t, frame) && make_slots(t))
        return -1;
    for (uint32_t i = 0; i < frame->count; i++) {
        const uint32_t last = later ? last_index(t, frame, i) : UINT32_MAX;
        t->speed[i] = NAN;
        if (last == UINT32_MAX)
            continue;
        const double moved = distance(t->last_xyz + 3 * (size_t)last, frame_place(frame, i), edge);
        if (isfinite(moved))
            t->speed[i] = (float)moved;
    }
    return 0;
}

static void from_velocity(speed_tracker *t, const trajectory_frame *frame)
{
    for (uint32_t i = 0; i < frame->count; i++) {
        const float *v = frame->velocity + 3 * (size_t)i;
        const double x = (double)v[0], y = (double)v[1], z = (double)v[2];
        const double speed = sqrt(x * x + y * y + z * z);
        t->speed[i] = isfinite(speed) ? (float)speed : NAN;
    }
}

static void remember(speed_tracker *t, const trajectory_frame *frame)
{
    for (uint32_t i = 0; i < frame->count; i++)
        memcpy(t->last_xyz + 3 * (size_t)i, frame_place(frame, i), 3 * sizeof(float));
    t->last_has_id = ids(frame) != NULL;
    if (ids(frame) && frame->count)
        memcpy(t->last_id, ids(frame), frame->count * sizeof(uint32_t));
    t->last_count = frame->count;
    t->last_step = frame->step;
    t->has_last = 1;
}

int speed_next(speed_tracker *tracker, const trajectory_frame *frame, const float **speeds, speed_source *source)
{
    *speeds = NULL;
    *source = frame->velocity ? SPEED_FROM_VELOCITY : SPEED_FROM_POSITIONS;
    if (reserve(tracker, frame->count))
        return -1;
    if (frame->velocity)
        from_velocity(tracker, frame);
    else if (from_positions(tracker, frame))
        return -1;
    remember(tracker, frame);
    *speeds = tracker->speed;
    return 0;
}
