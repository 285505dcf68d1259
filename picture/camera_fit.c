/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cameras that show all of a scene, and go around it; see camera_reach.h. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "camera_reach.h"
#include "draw/draw.h"

void cgt_camera_orbit(cgt_camera *camera, double degrees)
{
    const double pi = 3.14159265358979323846;
    const cgt_camera seen = cgt_draw_default_view(camera);
    double axis[3], arm[3];
    for (int c = 0; c < 3; c++) {
        axis[c] = (double)seen.up[c];
        arm[c] = (double)seen.eye[c] - (double)seen.target[c];
    }
    if (degrees == 0.0 || camera_normalize(axis))
        return;
    camera_rotate(arm, axis, degrees * pi / 180.0);
    for (int c = 0; c < 3; c++)
        camera->eye[c] = (float)((double)camera->target[c] + arm[c]);
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
    if (camera_normalize(a) || camera_normalize(b))
        return 0;
    camera_cross(a, b, across);
    return camera_dot(across, across) > 1e-12;
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
    float view[3];
    if (!camera || !width || !height || !isfinite(orbit_degrees))
        return -1;
    const cgt_camera seen = cgt_draw_default_view(camera);
    fit->is_parallel = seen.projection == CGT_PROJECTION_ORTHOGRAPHIC;
    const float fov = seen.fov > 0.0f && !fit->is_parallel ? seen.fov : 45.0f; /* parallel rays have no angle */
    for (int c = 0; c < 3; c++) {
        view[c] = seen.eye[c] - seen.target[c];
        fit->min[c] = INFINITY;
        fit->max[c] = -INFINITY;
    }
    if (!can_look(view, seen.up) || !(fov < 180.0f))
        return -1;
    cgt_camera_directions_set(&fit->directions, view, seen.up, fov, (double)width / (double)height, orbit_degrees,
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
    double across;
    const cgt_result result =
        cgt_camera_reach_show(&fit->reach, &fit->directions, fit->min, fit->max, &fitted, &across);
    if (result != CGT_OK)
        return result;
    const double pi = 3.14159265358979323846;
    /* what a perspective camera of this angle shows so far off */
    const float height = (float)(2.0 * across * tan((double)fit->directions.fov * pi / 360.0));
    if (fit->is_parallel && !(height > 0.0f && isfinite(height)))
        return CGT_ERROR_INVALID_ARGUMENT;
    memcpy(camera->eye, fitted.eye, sizeof camera->eye);
    memcpy(camera->target, fitted.target, sizeof camera->target);
    camera->height = fit->is_parallel ? height : camera->height;
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
