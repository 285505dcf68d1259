/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cameras that show all of a scene, and go around it. In double, so that one far from the origin does not drift. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "camera_reach.h"

static const double pi = 3.14159265358979323846;
_Static_assert(CAMERA_DIRECTIONS == 5 * (CAMERA_STOPS + 1), "five directions for each position");
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

void cgt_camera_orbit(cgt_camera *camera, double degrees)
{
    double axis[3], arm[3];
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

/* The directions at one position. A point at x to the right and z towards the eye, which is at e, is in the picture
 * where x <= (e - z) * tangent of half the angle: where its reach along cos * right + sin * view is below sin * e. */
static void add_directions(camera_directions *fit, const double view[3], const double tangent[2], int is_parallel)
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

void cgt_camera_directions_set(camera_directions *fit, const float view[3], const float up[3], float fov, double aspect,
                               double orbit_degrees, bool is_parallel)
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
    for (int stop = 0; stop <= (orbit_degrees != 0.0 ? CAMERA_STOPS : 0); stop++) {
        double turned[3] = {fit->view[0], fit->view[1], fit->view[2]};
        if (stop)
            rotate(turned, fit->up, orbit_degrees * pi / 180.0 * stop / CAMERA_STOPS);
        add_directions(fit, turned, tangent, is_parallel);
    }
}

void cgt_camera_reach_clear(camera_reach *reach)
{
    for (uint32_t k = 0; k < CAMERA_DIRECTIONS; k++)
        reach->along[k] = -INFINITY;
}

void cgt_camera_reach_add(camera_reach *reach, const camera_directions *fit, const double center[3], double radius)
{
    for (uint32_t k = 0; k < fit->count; k++) {
        const double at = fit->x[k] * center[0] + fit->y[k] * center[1] + fit->z[k] * center[2] + radius;
        reach->along[k] = at > reach->along[k] ? at : reach->along[k];
    }
}

void cgt_camera_reach_add_box(camera_reach *reach, const camera_directions *fit, const float min[3], const float max[3])
{
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int c = 0; c < 3; c++)
            p[c] = (double)(corner >> c & 1 ? max[c] : min[c]);
        cgt_camera_reach_add(reach, fit, p, 0.0);
    }
}

static double along(const camera_directions *fit, uint32_t k, const double p[3])
{
    return fit->x[k] * p[0] + fit->y[k] * p[1] + fit->z[k] * p[2];
}

/* The target, as float holds it, and the distance of floats there, at most. */
static int choose_target(const camera_directions *fit, const camera_reach *reach, const float min[3],
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

cgt_result cgt_camera_reach_show(const camera_reach *reach, const camera_directions *fit, const float min[3],
                                 const float max[3], cgt_camera *camera)
{
    double target[3], spacing, distance = 0.0;
    if (choose_target(fit, reach, min, max, target, &spacing))
        return CGT_ERROR_INVALID_ARGUMENT;
    for (uint32_t k = 0; k < fit->count; k++) { /* at least so far that eye and target differ in float */
        const double beyond = fmax(reach->along[k] - along(fit, k, target), 4.0 * spacing);
        distance = fmax(distance, beyond / fit->gain[k % fit->sides]);
    }
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

/* ---- Spheres ------------------------------------------------------------------------------------------------ */

static void get_sphere(const cgt_spheres *s, uint32_t i, double center[3], double *radius)
{
    const uint64_t number = s->types.data ? cgt_array_get_whole(&s->types, i, 1, 0) : i;
    for (size_t c = 0; c < 3; c++)
        center[c] = cgt_array_get_number(&s->centers, i, 3, c) - s->origin[c];
    *radius = (double)s->radius;
    if (s->types.data && number >= s->type_count)
        *radius = NAN; /* which leaves it out */
    else if (s->radii.data)
        *radius = cgt_array_get_number(&s->radii, number, 1, 0);
}

/* Whether two directions have a length and are not parallel. */
static int can_look(const float view[3], const float up[3])
{
    double a[3], b[3], across[3];
    for (int c = 0; c < 3; c++) {
        a[c] = (double)view[c];
        b[c] = (double)up[c];
    }
    if (normalize(a) || normalize(b))
        return 0;
    cross(a, b, across);
    return dot(across, across) > 1e-12;
}

/* ---- Fits ------------------------------------------------------------------------------------------------- */

struct cgt_camera_fit {
    camera_directions directions;
    camera_reach reach;
    float min[3], max[3]; /* bounds of what was added */
    bool is_parallel;
};

/* Begins a fit. Returns 0, or -1: a camera looks nowhere. */
static int begin_fit(cgt_camera_fit *fit, const cgt_camera *camera, uint32_t width, uint32_t height,
                     double orbit_degrees)
{
    static const float default_up[3] = {0.0f, 1.0f, 0.0f};
    float view[3];
    if (!camera || !width || !height || !isfinite(orbit_degrees))
        return -1;
    const float *const up =
        camera->up[0] != 0.0f || camera->up[1] != 0.0f || camera->up[2] != 0.0f ? camera->up : default_up;
    const float fov = camera->fov > 0.0f ? camera->fov : 45.0f;
    for (int c = 0; c < 3; c++) {
        view[c] = camera->eye[c] - camera->target[c];
        fit->min[c] = INFINITY;
        fit->max[c] = -INFINITY;
    }
    if (!can_look(view, up) || !(fov < 180.0f))
        return -1;
    fit->is_parallel = camera->projection == CGT_PROJECTION_ORTHOGRAPHIC;
    cgt_camera_directions_set(&fit->directions, view, up, fov, (double)width / (double)height, orbit_degrees,
                              fit->is_parallel);
    cgt_camera_reach_clear(&fit->reach);
    return 0;
}

cgt_result cgt_camera_fit_create(const cgt_camera *camera, uint32_t width, uint32_t height, double orbit_degrees,
                                 cgt_camera_fit **fit)
{
    if (!fit)
        return CGT_ERROR_INVALID_ARGUMENT;
    *fit = NULL;
    cgt_camera_fit *const made = malloc(sizeof *made);
    if (!made)
        return CGT_ERROR_OUT_OF_MEMORY;
    if (begin_fit(made, camera, width, height, orbit_degrees)) {
        free(made);
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    *fit = made;
    return CGT_OK;
}

void cgt_camera_fit_release(cgt_camera_fit *fit) { free(fit); }

void cgt_camera_fit_add(cgt_camera_fit *fit, const double center[3], double radius)
{
    if (!isfinite(center[0] + center[1] + center[2] + radius) || radius < 0.0)
        return;
    cgt_camera_reach_add(&fit->reach, &fit->directions, center, radius);
    for (int c = 0; c < 3; c++) {
        fit->min[c] = fminf(fit->min[c], (float)(center[c] - radius));
        fit->max[c] = fmaxf(fit->max[c], (float)(center[c] + radius));
    }
}

void cgt_camera_fit_add_box(cgt_camera_fit *fit, const float min[3], const float max[3])
{
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int c = 0; c < 3; c++)
            p[c] = (double)(corner >> c & 1 ? max[c] : min[c]);
        cgt_camera_fit_add(fit, p, 0.0);
    }
}

cgt_result cgt_camera_fit_apply(const cgt_camera_fit *fit, cgt_camera *camera)
{
    cgt_camera fitted;
    const cgt_result result = cgt_camera_reach_show(&fit->reach, &fit->directions, fit->min, fit->max, &fitted);
    if (result != CGT_OK)
        return result;
    float distance = 0.0f;
    for (int c = 0; c < 3; c++)
        distance += (fitted.eye[c] - fitted.target[c]) * (fitted.eye[c] - fitted.target[c]);
    memcpy(camera->eye, fitted.eye, sizeof camera->eye);
    memcpy(camera->target, fitted.target, sizeof camera->target);
    if (fit->is_parallel) /* what a perspective camera of this angle shows at its target */
        camera->height = 2.0f * sqrtf(distance) * tanf(fit->directions.fov * 0.00872664626f);
    return CGT_OK;
}

cgt_result cgt_camera_fit_spheres(cgt_camera *camera, uint32_t width, uint32_t height, const cgt_spheres *spheres)
{
    cgt_camera_fit fit;
    if (!spheres || (spheres->count && !spheres->centers.data) || begin_fit(&fit, camera, width, height, 0.0))
        return CGT_ERROR_INVALID_ARGUMENT;
    for (uint32_t i = 0; i < spheres->count; i++) {
        double center[3], radius;
        get_sphere(spheres, i, center, &radius);
        cgt_camera_fit_add(&fit, center, radius);
    }
    return cgt_camera_fit_apply(&fit, camera);
}
