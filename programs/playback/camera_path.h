/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The camera during a run: fixed, or on an orbit around its target. */
#ifndef CAMERA_PATH_H
#define CAMERA_PATH_H

#include <cgt/cgt.h>

typedef struct camera_path {
    cgt_camera start;     /* at the start of the run */
    double orbit_degrees; /* angle over the whole run, about the axis through the target along `up`; positive is
                             counter-clockwise seen from the tip of up; 0: the camera is fixed */
} camera_path;

/* Sets up a path for a given camera. */
void camera_path_fixed(camera_path *path, const cgt_camera *camera, double orbit_degrees);

/* Sets up a path that shows the whole box from min to max, all along the orbit, with a small margin.
 * view: from the box's centre towards the eye, any length but zero, not parallel to up. fov: vertical degrees. aspect:
 * width / height. Returns 0, or -1 where floats cannot hold such a camera: a box that is not finite or too large. */
int camera_path_frame(camera_path *path, const float min[3], const float max[3], const float view[3], const float up[3],
                      float fov, double aspect, double orbit_degrees);

/* The camera at share 0 to 1 of the run. Share 0 is exactly the start. */
void camera_path_at(const camera_path *path, double share, cgt_camera *camera);

/* Whether a direction, of any length but zero, is parallel or nearly parallel to a coordinate axis: 1 or 0. */
int camera_path_is_along(const float direction[3], const float axis[3]);

#endif
