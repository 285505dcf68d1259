/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The camera during a run; see camera_path.h. In double, so that a camera far from the origin does not drift. */
#include "playback/camera/camera_path.h"

#include <float.h>
#include <math.h>

static const double pi = 3.14159265358979323846;
static const double margin = 1.04; /* room around the scene */

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static int normalize(double v[3])
{
    const double length = sqrt(dot(v, v));
    if (!(length > 0.0) || !isfinite(length))
        return -1;
    for (int c = 0; c < 3; c++)
        v[c] /= length;
    return 0;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Turns v about the unit vector axis (Rodrigues). */
static void rotate(double v[3], const double axis[3], double radians)
{
    double side[3];
    cross(axis, v, side);
    const double c = cos(radians), s = sin(radians), along = dot(axis, v) * (1.0 - c);
    for (int k = 0; k < 3; k++)
        v[k] = v[k] * c + side[k] * s + axis[k] * along;
}

void camera_path_fixed(camera_path *path, const cgt_camera *camera, double orbit_degrees)
{
    path->start = *camera;
    path->orbit_degrees = orbit_degrees;
}

void camera_path_at(const camera_path *path, double share, cgt_camera *camera)
{
    double axis[3], arm[3];
    *camera = path->start;
    const double degrees = path->orbit_degrees * share;
    for (int c = 0; c < 3; c++) {
        axis[c] = (double)camera->up[c];
        arm[c] = (double)camera->eye[c] - (double)camera->target[c];
    }
    if (degrees == 0.0 || normalize(axis))
        return;
    rotate(arm, axis, degrees * pi / 180.0);
    for (int c = 0; c < 3; c++)
        camera->eye[c] = (float)((double)camera->target[c] + arm[c]);
}

/* ---- The automatic camera ----------------------------------------------------------------------------------- */

/* The directions at one position. A point at x to the right and z towards the eye, which is at e, is in the picture
 * where x <= (e - z) * tangent of half the angle: where its reach along cos * right + sin * view is below sin * e. */
static void add_directions(camera_fit *fit, const double view[3], const double tangent[2], int is_parallel)
{
    double axis[2][3];
    cross(fit->up, view, axis[0]);
    normalize(axis[0]);
    cross(view, axis[0], axis[1]);
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

void camera_fit_begin(camera_fit *fit, const float view[3], const float up[3], float fov, double aspect,
                      double orbit_degrees, int is_parallel)
{
    const double tan_y = tan((double)fov * pi / 360.0) / margin, tangent[2] = {tan_y * aspect, tan_y};
    fit->count = 0;
    fit->sides = is_parallel ? 5 : 4;
    fit->fov = fov;
    fit->orbit_degrees = orbit_degrees;
    for (int c = 0; c < 3; c++) {
        fit->view[c] = (double)view[c];
        fit->up[c] = (double)up[c];
    }
    normalize(fit->view);
    normalize(fit->up);
    for (int stop = 0; stop <= (orbit_degrees != 0.0 ? FIT_STOPS : 0); stop++) {
        double turned[3] = {fit->view[0], fit->view[1], fit->view[2]};
        if (stop)
            rotate(turned, fit->up, orbit_degrees * pi / 180.0 * stop / FIT_STOPS);
        add_directions(fit, turned, tangent, is_parallel);
    }
}

void camera_reach_clear(camera_reach *reach)
{
    for (uint32_t k = 0; k < FIT_MOST; k++)
        reach->along[k] = -INFINITY;
}

void camera_reach_add_box(camera_reach *reach, const camera_fit *fit, const float min[3], const float max[3])
{
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int c = 0; c < 3; c++)
            p[c] = (double)(corner >> c & 1 ? max[c] : min[c]);
        camera_reach_add(reach, fit, p, 0.0);
    }
}

static double along(const camera_fit *fit, uint32_t k, const double p[3])
{
    return fit->x[k] * p[0] + fit->y[k] * p[1] + fit->z[k] * p[2];
}

/* The target, as float holds it, and the distance of floats there, at most. */
static int choose_target(const camera_fit *fit, const camera_reach *reach, const float min[3], const float max[3],
                         double target[3], double *spacing)
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
        const double more = (reach->along[k] - dot(first, target)) - (reach->along[k + 1] - dot(other, target));
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

int camera_path_fit(camera_path *path, const camera_fit *fit, const camera_reach *reach, const float min[3],
                    const float max[3])
{
    double target[3], spacing, distance = 0.0;
    if (choose_target(fit, reach, min, max, target, &spacing))
        return -1;
    for (uint32_t k = 0; k < fit->count; k++) { /* at least so far that eye and target differ in float */
        const double beyond = fmax(reach->along[k] - along(fit, k, target), 4.0 * spacing);
        distance = fmax(distance, beyond / fit->gain[k % fit->sides]);
    }
    cgt_camera_init(&path->start);
    path->start.fov = fit->fov;
    path->orbit_degrees = fit->orbit_degrees;
    for (int c = 0; c < 3; c++) {
        const double eye = target[c] + distance * fit->view[c];
        if (!(fabs(eye) < FLT_MAX / 16.0) || !(distance < FLT_MAX / 16.0))
            return -1;
        path->start.eye[c] = (float)eye;
        path->start.target[c] = (float)target[c];
        path->start.up[c] = (float)fit->up[c];
    }
    return 0;
}

void camera_path_zoom(camera_path *path, float factor)
{
    const double half = (double)path->start.fov * pi / 360.0;
    path->start.fov = (float)(atan(tan(half) / (double)factor) * 360.0 / pi);
}

int camera_path_is_along(const float v[3], const float axis[3])
{
    float along = 0.0f, length = 0.0f, largest = 0.0f;
    for (int c = 0; c < 3; c++)
        largest = fmaxf(largest, fabsf(v[c]));
    for (int c = 0; c < 3; c++) { /* divide by the largest, so that squares of finite floats stay finite */
        const float x = v[c] / largest;
        length += x * x;
        along += x * x * axis[c];
    }
    return !(length - along > 1e-8f * length);
}
