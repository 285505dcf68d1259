/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The camera during a run: fixed, or on an orbit around its target. */
#ifndef CAMERA_PATH_H
#define CAMERA_PATH_H

#include <stdint.h>

#include <cgt/cgt.h>

typedef struct camera_path {
    cgt_camera start;     /* at the start of the run */
    double orbit_degrees; /* angle over the whole run, about the axis through the target along `up`; positive is
                             counter-clockwise seen from the tip of up; 0: the camera is fixed */
} camera_path;

/* Sets up a path for a given camera. */
void camera_path_fixed(camera_path *path, const cgt_camera *camera, double orbit_degrees);

/* ---- The automatic camera ---- */

enum { FIT_STOPS = 36, FIT_MOST = 5 * (FIT_STOPS + 1) };

/* The directions across the edges of a picture, outwards: how far the run reaches along them tells from where all of it
 * is seen. Four for each position on the orbit; a parallel projection has a fifth, towards the eye. */
typedef struct camera_fit {
    uint32_t count; /* of directions; 0: nothing is measured */
    uint32_t sides; /* directions a position */
    double x[FIT_MOST], y[FIT_MOST], z[FIT_MOST];
    double gain[5]; /* how far the edge moves along each as the eye moves away by 1 */
    double view[3]; /* unit vectors: to the eye at the start, and up */
    double up[3];
    float fov;
    double orbit_degrees;
} camera_fit;

/* How far a run reaches along each direction; -infinity where there is nothing. */
typedef struct camera_reach {
    double along[FIT_MOST];
} camera_reach;

/* view: from the scene towards the eye, any length but zero, not parallel to up. fov: vertical degrees. aspect: width /
 * height. */
void camera_fit_begin(camera_fit *fit, const float view[3], const float up[3], float fov, double aspect,
                      double orbit_degrees, int is_parallel);

void camera_reach_clear(camera_reach *reach);

/* Adds a ball. */
static inline void camera_reach_add(camera_reach *reach, const camera_fit *fit, const double p[3], double radius)
{
    for (uint32_t k = 0; k < fit->count; k++) {
        const double at = fit->x[k] * p[0] + fit->y[k] * p[1] + fit->z[k] * p[2] + radius;
        reach->along[k] = at > reach->along[k] ? at : reach->along[k];
    }
}

/* Adds the corners of a box. */
void camera_reach_add_box(camera_reach *reach, const camera_fit *fit, const float min[3], const float max[3]);

/* Sets up a path that shows all of what was added, in the middle of the picture at the start, and all along the orbit,
 * with a small margin. min, max: the bounds of it; their centre is as far off as the target, and what an orbit goes
 * around. Returns 0, or -1 where floats cannot hold such a camera: bounds that are not finite or too large. */
int camera_path_fit(camera_path *path, const camera_fit *fit, const camera_reach *reach, const float min[3],
                    const float max[3]);

/* Narrows the angle so that all is drawn `factor` times as large, above 0. */
void camera_path_zoom(camera_path *path, float factor);

/* The camera at share 0 to 1 of the run. Share 0 is exactly the start. */
void camera_path_at(const camera_path *path, double share, cgt_camera *camera);

/* Whether a direction, of any length but zero, is parallel or nearly parallel to a coordinate axis: 1 or 0. */
int camera_path_is_along(const float direction[3], const float axis[3]);

#endif
