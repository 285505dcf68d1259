/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What cameras are fitted by. cgt_camera_fit of cgt/picture.h has one of each; the surveys of the programs have several
 * reaches, which threads and processes put together. All is inline: libcgt-picture hides what its header does not
 * declare, and libraries over it fit cameras, too. In double, so that a camera far from the origin does not drift. */
#ifndef CAMERA_REACH_H
#define CAMERA_REACH_H

#include <float.h>
#include <math.h>

#include <cgt/picture.h>

enum { CAMERA_STOPS = 36, CAMERA_DIRECTIONS = 8 * (CAMERA_STOPS + 1) }; /* positions on an orbit but the first */

/* The directions across the edges of a picture, outwards: how far the scene reaches along them tells from where all of
 * it is seen. Four for each position on an orbit; a parallel projection has a fifth, towards the eye. Then those of
 * cgt_camera_directions_add_plain. */
typedef struct camera_directions {
    uint32_t count;    /* of directions */
    uint32_t sides;    /* directions a position */
    uint32_t plain;    /* the first of those to the right, left, up and down; 0: there are none */
    double tangent[2]; /* of half the angle across and up, less the margin */
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

static inline double camera_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline int camera_normalize(double v[3])
{
    const double length = sqrt(camera_dot(v, v));
    if (!(length > 0.0) || !isfinite(length))
        return -1;
    for (int c = 0; c < 3; c++)
        v[c] /= length;
    return 0;
}

static inline void camera_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Turns v about the unit vector axis (Rodrigues). */
static inline void camera_rotate(double v[3], const double axis[3], double radians)
{
    double side[3];
    camera_cross(axis, v, side);
    const double c = cos(radians), s = sin(radians), along = camera_dot(axis, v) * (1.0 - c);
    for (int k = 0; k < 3; k++)
        v[k] = v[k] * c + side[k] * s + axis[k] * along;
}

/* The directions at one position. A point at x to the right and z towards the eye, which is at e, is in the picture
 * where x <= (e - z) * tangent of half the angle: where its reach along cos * right + sin * view is below sin * e. */
static inline void camera_add_directions(camera_directions *fit, const double view[3], const double tangent[2],
                                         int is_parallel)
{
    double axis[2][3];
    camera_cross(fit->up, view, axis[0]);
    camera_normalize(axis[0]);
    camera_cross(view, axis[0], axis[1]);
    for (uint32_t side = 0; side < fit->sides; side++) {
        const double t = tangent[side / 2 % 2], cosine = is_parallel ? 1.0 : 1.0 / sqrt(1.0 + t * t);
        const double across = side == 4 ? 0.0 : side % 2 ? -cosine : cosine;
        const double towards = side == 4 ? 1.0 : is_parallel ? 0.0 : t * cosine;
        const double *const a = axis[side / 2 % 2];
        fit->x[fit->count] = across * a[0] + towards * view[0];
        fit->y[fit->count] = across * a[1] + towards * view[1];
        fit->z[fit->count] = across * a[2] + towards * view[2];
        fit->gain[side] = is_parallel && side < 4 ? t : towards;
        fit->count++;
    }
}

/* Makes the directions.
 *   view            from the scene towards the eye, of any length but zero, not parallel to up
 *   fov             vertical degrees
 *   aspect          width / height
 *   orbit_degrees   the scene is to be shown all along this way around it; 0: from the start alone
 *   is_parallel     of an orthographic camera */
static inline void cgt_camera_directions_set(camera_directions *fit, const float view[3], const float up[3], float fov,
                                             double aspect, double orbit_degrees, bool is_parallel)
{
    const double pi = 3.14159265358979323846;
    const double margin = 1.04; /* room around the scene */
    const double tan_y = tan((double)fov * pi / 360.0) / margin, tangent[2] = {tan_y * aspect, tan_y};
    fit->count = fit->plain = 0;
    fit->sides = is_parallel ? 5 : 4;
    fit->tangent[0] = tangent[0];
    fit->tangent[1] = tangent[1];
    fit->fov = fov;
    fit->orbit_degrees = orbit_degrees;
    for (int c = 0; c < 3; c++) {
        fit->view[c] = (double)view[c];
        fit->up[c] = (double)up[c];
    }
    camera_normalize(fit->view);
    camera_normalize(fit->up);
    for (int stop = 0; stop <= (orbit_degrees != 0.0 ? CAMERA_STOPS : 0); stop++) {
        double turned[3] = {fit->view[0], fit->view[1], fit->view[2]};
        if (stop)
            camera_rotate(turned, fit->up, orbit_degrees * pi / 180.0 * stop / CAMERA_STOPS);
        camera_add_directions(fit, turned, tangent, is_parallel);
    }
}

/* Adds to the directions of a perspective camera those in the plane of the picture, for each position: from both kinds
 * follows how far a scene reaches across edges that lie between its middle and those of the whole picture. */
static inline void cgt_camera_directions_add_plain(camera_directions *fit)
{
    const uint32_t count = fit->count;
    fit->plain = count;
    for (uint32_t k = 0; k < count; k++) { /* towards the eye a side and the opposite one are the same */
        const uint32_t other = k ^ 1u;
        double v[3] = {fit->x[k] - fit->x[other], fit->y[k] - fit->y[other], fit->z[k] - fit->z[other]};
        camera_normalize(v);
        fit->x[fit->count] = v[0];
        fit->y[fit->count] = v[1];
        fit->z[fit->count] = v[2];
        fit->count++;
    }
}

/* Empties a reach; adds a ball to it, or the corners of a box. */
static inline void cgt_camera_reach_clear(camera_reach *reach)
{
    for (uint32_t k = 0; k < CAMERA_DIRECTIONS; k++)
        reach->along[k] = -INFINITY;
}

static inline void cgt_camera_reach_add(camera_reach *reach, const camera_directions *fit, const double center[3],
                                        double radius)
{
    for (uint32_t k = 0; k < fit->count; k++) {
        const double at = fit->x[k] * center[0] + fit->y[k] * center[1] + fit->z[k] * center[2] + radius;
        reach->along[k] = at > reach->along[k] ? at : reach->along[k];
    }
}

static inline void cgt_camera_reach_add_box(camera_reach *reach, const camera_directions *fit, const float min[3],
                                            const float max[3])
{
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int c = 0; c < 3; c++)
            p[c] = (double)(corner >> c & 1 ? max[c] : min[c]);
        cgt_camera_reach_add(reach, fit, p, 0.0);
    }
}

static inline double camera_along(const camera_directions *fit, uint32_t k, const double p[3])
{
    return fit->x[k] * p[0] + fit->y[k] * p[1] + fit->z[k] * p[2];
}

/* The target, as float holds it, and the distance of floats there, at most. */
static inline int camera_choose_target(const camera_directions *fit, const camera_reach *reach, const float min[3],
                                       const float max[3], double target[3], double *spacing)
{
    double largest = 0.0;
    for (int c = 0; c < 3; c++) {
        if (!isfinite(min[c]) || !isfinite(max[c]) || min[c] > max[c])
            return -1;
        target[c] = 0.5 * ((double)min[c] + (double)max[c]);
        largest = fmax(largest, fmax(fabs((double)min[c]), fabs((double)max[c])));
    }
    /* in the middle between left and right, and between above and below */
    for (uint32_t k = 0; k < 4 && fit->orbit_degrees == 0.0; k += 2) {
        const double first[3] = {fit->x[k], fit->y[k], fit->z[k]};
        const double other[3] = {fit->x[k + 1], fit->y[k + 1], fit->z[k + 1]};
        const double more =
            (reach->along[k] - camera_dot(first, target)) - (reach->along[k + 1] - camera_dot(other, target));
        double square = 0.0;
        for (int c = 0; c < 3; c++)
            square += (first[c] - other[c]) * (first[c] - other[c]);
        for (int c = 0; c < 3; c++)
            target[c] += more / square * (first[c] - other[c]);
    }
    for (int c = 0; c < 3; c++)
        target[c] = (double)(float)target[c];
    *spacing = fmax(largest * (double)FLT_EPSILON, (double)FLT_MIN);
    return 0;
}

/* Sets up a perspective camera that shows all of what was added, in the middle of the picture at the start, and all
 * along the orbit, with a margin of 4 percent.
 *   min, max   bounds of it: their centre is as far off as the target, and what an orbit goes around
 *   across     gets how far off it would be to show what lies across the picture alone: of an orthographic camera the
 *              eye may be farther, in front of everything; NULL: not wanted
 * Errors: INVALID_ARGUMENT if floats cannot hold such a camera: bounds that are not finite or too large */
static inline cgt_result cgt_camera_reach_show(const camera_reach *reach, const camera_directions *fit,
                                               const float min[3], const float max[3], cgt_camera *camera,
                                               double *across)
{
    double target[3], spacing, distance = 0.0, widest = 0.0;
    if (camera_choose_target(fit, reach, min, max, target, &spacing))
        return CGT_ERROR_INVALID_ARGUMENT;
    const uint32_t count = fit->plain ? fit->plain : fit->count;
    for (uint32_t k = 0; k < count; k++) { /* at least so far that eye and target differ in float */
        const double beyond = fmax(reach->along[k] - camera_along(fit, k, target), 4.0 * spacing);
        distance = fmax(distance, beyond / fit->gain[k % fit->sides]);
        widest = k % fit->sides < 4 ? fmax(widest, beyond / fit->gain[k % fit->sides]) : widest;
    }
    if (across)
        *across = widest;
    cgt_camera_init(camera);
    camera->fov = fit->fov;
    for (int c = 0; c < 3; c++) {
        const double eye = target[c] + distance * fit->view[c];
        if (!(fabs(eye) < FLT_MAX / 16.0) || !(distance < FLT_MAX / 16.0))
            return CGT_ERROR_INVALID_ARGUMENT;
        camera->eye[c] = (float)eye;
        camera->target[c] = (float)target[c];
        camera->up[c] = (float)fit->up[c];
    }
    return CGT_OK;
}

#endif
