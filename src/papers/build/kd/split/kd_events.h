/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Events of the sweep along an axis (Wald, Havran, "On building fast kd-trees for ray tracing, and on doing that in O(N
 * log N)", 2006). Planes are those that a node can hold. An item starts at the last plane before it, at which it is not
 * yet in the lower box, and ends at the first plane after it, at which it is no longer in the upper box. So each end
 * lies after its start, flat items need no special case, and all planes that matter are among the events: between two
 * of them no item changes sides.
 *
 * An event is a number whose order is that of the sweep: plane, end before start, item. */
#ifndef CGT_KD_EVENTS_H
#define CGT_KD_EVENTS_H

#include "papers/build/kd/split/kd_builder.h"

typedef uint64_t cgt_kd_event;

#define CGT_KD_EVENT_BIAS 0x20000000 /* numbers of planes are below in magnitude */

static inline cgt_kd_event cgt_kd_event_pack(int32_t plane, bool start, uint32_t item)
{
    return (uint64_t)(uint32_t)(plane + CGT_KD_EVENT_BIAS) << 33 | (uint64_t)start << 32 | item;
}

static inline int32_t cgt_kd_event_plane(cgt_kd_event e) { return (int32_t)(uint32_t)(e >> 33) - CGT_KD_EVENT_BIAS; }
static inline bool cgt_kd_event_is_start(cgt_kd_event e) { return e >> 32 & 1; }
static inline uint32_t cgt_kd_event_item(cgt_kd_event e) { return (uint32_t)e; }

/* The two events of an item. */
static inline void cgt_kd_add_events(cgt_kd_event to[2], const cgt_kd_item *item, uint32_t axis, uint32_t index)
{
    to[0] = cgt_kd_event_pack(cgt_kd_plane_below(item->low[axis]), true, index);
    to[1] = cgt_kd_event_pack(cgt_kd_plane_above(item->high[axis]), false, index);
}

/* Sorts; `other` has room for as many. */
void cgt_kd_sort_events(cgt_kd_event *event, size_t count, cgt_kd_event *scratch);

/* Merges sorted `added` into the sorted `event`, which has room for both. */
void cgt_kd_merge_events(cgt_kd_event *event, size_t count, const cgt_kd_event *added, size_t more);

/* Tries all planes; replaces *best by a cheaper one. */
void cgt_kd_sweep_events(const cgt_kd_rules *rules, const cgt_kd_box *box, uint32_t axis, const cgt_kd_item *item,
                         uint32_t count, const cgt_kd_event *event, double weight, cgt_kd_plane *best);

#endif
