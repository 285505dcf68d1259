/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where the spheres of a frame were in the frames before it. */
#ifndef TRAIL_HISTORY_H
#define TRAIL_HISTORY_H

#include <stdint.h>

#include <cgt/trajectory.h>

enum { TRAIL_LONGEST = 1000 };

typedef struct trail_history trail_history;

/* length: frames before the newest that are kept, 1 to TRAIL_LONGEST. Each takes 16 bytes a sphere. Returns NULL where
 * there is no memory. */
trail_history *cgt_trail_history_create(uint32_t length);
void cgt_trail_history_release(trail_history *h); /* NULL is ignored */
uint32_t cgt_trail_history_length(const trail_history *h);

/* Forgets all frames. */
void cgt_trail_history_restart(trail_history *h);

/* Adds the frame that follows; of spheres. Returns 0, or -1 where there is no memory. */
int cgt_trail_history_add(trail_history *h, const cgt_trajectory_frame *frame);

/* The places of sphere i of the newest frame in it and in the frames before, the newest first: up to length + 1 of
 * three floats. They end where the sphere is new, where the numbers of frames do not increase, and before a place that
 * is not finite. Returns how many. A sphere is known by its id; where the file has none, by its index, and after a
 * frame with more spheres nothing is known. */
uint32_t cgt_trail_history_places(const trail_history *h, uint32_t i, float (*place)[3]);

#endif
