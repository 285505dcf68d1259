/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What cameras are fitted by. cgt_camera_fit of cgt/picture.h has one of each; the surveys of the programs have several
 * reaches, which threads and processes put together. */
#ifndef CAMERA_REACH_H
#define CAMERA_REACH_H

#include <cgt/picture.h>

enum { CAMERA_STOPS = 36, CAMERA_DIRECTIONS = 185 }; /* positions on an orbit but the first; directions */

/* The directions across the edges of a picture, outwards: how far the scene reaches along them tells from where all of
 * it is seen. Four for each position on an orbit; a parallel projection has a fifth, towards the eye. */
typedef struct camera_directions {
    uint32_t count; /* of directions */
    uint32_t sides; /* directions a position */
    double x[CAMERA_DIRECTIONS], y[CAMERA_DIRECTIONS], z[CAMERA_DIRECTIONS];
    double gain[5]; /* how far the edge moves along each as the eye moves away by 1 */
    double view[3]; /* unit vectors: to the eye at the start, and up */
    double up[3];
    float fov;
    double orbit_degrees;
} camera_directions;

/* How far a scene reaches along each direction; -infinity if there is nothing. The largest of several is that of their
 * union. */
typedef struct camera_reach {
    double along[CAMERA_DIRECTIONS];
} camera_reach;

/* Makes the directions.
 *   view            from the scene towards the eye, of any length but zero, not parallel to up
 *   fov             vertical degrees
 *   aspect          width / height
 *   orbit_degrees   the scene is to be shown all along this way around it; 0: from the start alone
 *   is_parallel     of an orthographic camera */
void cgt_camera_directions_set(camera_directions *d, const float view[3], const float up[3], float fov, double aspect,
                               double orbit_degrees, bool is_parallel);

/* Empties a reach; adds a ball to it, or the corners of a box. */
void cgt_camera_reach_clear(camera_reach *reach);
void cgt_camera_reach_add(camera_reach *reach, const camera_directions *d, const double center[3], double radius);
void cgt_camera_reach_add_box(camera_reach *reach, const camera_directions *d, const float min[3], const float max[3]);

/* Sets up a perspective camera that shows all of what was added, in the middle of the picture at the start, and all
 * along the orbit, with a margin of 4 percent.
 *   min, max   bounds of it: their centre is as far off as the target, and what an orbit goes around
 * Errors: INVALID_ARGUMENT if floats cannot hold such a camera: bounds that are not finite or too large */
cgt_result cgt_camera_reach_show(const camera_reach *reach, const camera_directions *d, const float min[3],
                                 const float max[3], cgt_camera *camera);

#endif
