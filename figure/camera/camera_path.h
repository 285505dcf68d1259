/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The camera during a run: fixed, or on an orbit around its target. */
#ifndef CAMERA_PATH_H
#define CAMERA_PATH_H

#include "camera_reach.h"
#include <stdint.h>

#include <cgt/picture.h>

typedef struct camera_path {
    cgt_camera start;     /* at the start of the run */
    double middle[3];     /* from the target to what is seen in the middle of the room for the scene */
    double orbit_degrees; /* angle over the whole run, about the axis through the target along `up`; positive is
                             counter-clockwise seen from the tip of up; 0: the camera is fixed */
} camera_path;

/* Sets up a path for a given camera. */
void cgt_camera_path_fixed(camera_path *path, const cgt_camera *camera, double orbit_degrees);

/* Sets up a path that shows all of what was added, in the middle of the picture at the start, and all along the orbit,
 * with a small margin. min, max: the bounds of it; their centre is as far off as the target, and what an orbit goes
 * around. Returns 0, or -1 where floats cannot hold such a camera: bounds that are not finite or too large. */
int cgt_camera_path_fit(camera_path *path, const camera_directions *fit, const camera_reach *reach, const float min[3],
                        const float max[3]);

/* A part of the picture that has the scene to itself: how far it reaches from the middle to the right, left, up and
 * down, in halves of the picture, above 0 to 1. */
typedef struct camera_room {
    double share[4];
} camera_room;

/* The room between two corners, in pixels from the upper left one. */
static inline camera_room cgt_camera_room_between(float x0, float y0, float x1, float y1, uint32_t width,
                                                  uint32_t height)
{
    const double w = 0.5 * (double)width, h = 0.5 * (double)height;
    return (camera_room){{(double)x1 / w - 1.0, 1.0 - (double)x0 / w, 1.0 - (double)y0 / h, (double)y1 / h - 1.0}};
}

/* The same for a scene in one of several rooms, in which it is largest: *chosen. `fit` has plain directions where the
 * camera is a perspective one. An orbit goes around the middle of the picture. */
int cgt_camera_path_fit_room(camera_path *path, const camera_directions *fit, const camera_reach *reach,
                             const float min[3], const float max[3], const camera_room *rooms, uint32_t count,
                             uint32_t *chosen);

/* Narrows the angle so that all is drawn `factor` times as large, above 0, about the middle of the room. */
void cgt_camera_path_zoom(camera_path *path, float factor);

/* The camera at share 0 to 1 of the run. Share 0 is exactly the start. */
void cgt_camera_path_at(const camera_path *path, double share, cgt_camera *camera);

/* Whether a direction, of any length but zero, is parallel or nearly parallel to a coordinate axis: 1 or 0. */
int cgt_camera_path_is_along(const float direction[3], const float axis[3]);

#endif
