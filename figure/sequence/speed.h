/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The speed of each sphere: from the file's velocities where it has them, otherwise from the position of the sphere
 * with the same id one frame before. The same for the vertices of triangles. */
#ifndef SPEED_H
#define SPEED_H

#include <cgt/cgt.h>
#include <cgt/trajectory.h>

typedef struct speed_tracker speed_tracker;

typedef enum speed_source {
    SPEED_FROM_VELOCITY, /* in the file's units */
    SPEED_FROM_POSITIONS /* world units a frame: formats without the simulator's steps allow no other unit */
} speed_source;

/* context: whose threads look at large frames. The speeds are the same for any number. Returns NULL where there is no
 * memory. */
speed_tracker *cgt_speed_create(cgt_context *context);
void cgt_speed_release(speed_tracker *tracker);

/* Forgets the frame before: the next frame is the first. */
void cgt_speed_restart(speed_tracker *tracker);

/* Processes the next frame; *speeds gets one value per sphere or vertex, valid until the next call. It is NaN where
 * the speed is unknown: there is no frame before, the sphere is new, its numbers are not finite, or the frame's
 * number is not larger; steps may be what they like. A sphere that leaves the simulation box on one side and comes back
 * on the other has moved the short way, as periodic_box.h tells; through walls, and where positions are unwrapped, it
 * has moved as far as it says. Where the file has no ids a sphere keeps its index, and after a frame with more spheres
 * nothing is known. Returns 0, or -1 where there is no memory. */
int cgt_speed_next(speed_tracker *tracker, const cgt_trajectory_frame *frame, const float **speeds,
                   speed_source *source);

/* Looks ahead from the first frame, which was processed last, to the next one. From now on the speeds of the first
 * frame are those of the way to the next. Returns 0, or -1 where there is no memory. */
int cgt_speed_look_ahead(speed_tracker *tracker, const cgt_trajectory_frame *next);

/* The longest steps along each axis up to the last frame, 0 where it has a box: without one, what goes through a
 * boundary cannot be told from what is fast. */
void cgt_speed_boxless_steps(const speed_tracker *tracker, float longest[3]);

#endif
