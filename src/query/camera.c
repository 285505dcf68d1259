/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cameras: defaults, checks, and the axes in double, rounded once. */
#include "query/camera.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct vec3 {
    double x, y, z;
} vec3;

static vec3 to_vec3(const float v[3]) { return (vec3){v[0], v[1], v[2]}; }
static vec3 sub(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static vec3 scale(vec3 a, double k) { return (vec3){a.x * k, a.y * k, a.z * k}; }
static double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec3 cross(vec3 a, vec3 b)
{
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static void round_to(float d[3], vec3 a)
{
    d[0] = (float)a.x;
    d[1] = (float)a.y;
    d[2] = (float)a.z;
}
static bool finite3(const float v[3]) { return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]); }

static bool is_zero3(const float v[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

void cgt_camera_init(cgt_camera *camera)
{
    *camera = (cgt_camera){.projection = CGT_PROJECTION_PERSPECTIVE,
                           .eye = {0, 0, 5},
                           .up = {0, 1, 0},
                           .fov = 45,
                           .height = 2,
                           .t_min = 0,
                           .t_max = INFINITY};
}

/* The camera with the defaults in place of zeros. */
static cgt_camera with_defaults(const cgt_camera *camera)
{
    cgt_camera c = *camera, defaults;
    cgt_camera_init(&defaults);
    if (is_zero3(c.up)) {
        if (is_zero3(c.eye) && is_zero3(c.target))
            memcpy(c.eye, defaults.eye, sizeof c.eye);
        memcpy(c.up, defaults.up, sizeof c.up);
    }
    c.fov = c.fov == 0 ? defaults.fov : c.fov;
    c.height = c.height == 0 ? defaults.height : c.height;
    c.t_max = c.t_max == 0 ? defaults.t_max : c.t_max;
    c.mask = c.mask ? c.mask : UINT32_MAX;
    return c;
}

/* Returns what is wrong, or NULL. */
static const char *check_camera(const cgt_camera *c)
{
    if (c->projection != CGT_PROJECTION_PERSPECTIVE && c->projection != CGT_PROJECTION_ORTHOGRAPHIC)
        return "projection is unknown";
    if (!finite3(c->eye))
        return "eye is not finite";
    if (!finite3(c->target))
        return "target is not finite";
    if (!finite3(c->up))
        return "up is not finite";
    if (c->projection == CGT_PROJECTION_PERSPECTIVE && !(c->fov > 0 && c->fov < 180))
        return "fov must be 0 or more and below 180 degrees";
    if (c->projection == CGT_PROJECTION_ORTHOGRAPHIC && !(c->height > 0 && isfinite(c->height)))
        return "height must be 0 or more and finite";
    if (!(c->t_min >= 0))
        return "t_min must be 0 or more";
    if (!(c->t_max >= c->t_min))
        return "t_max must not be below t_min";
    return NULL;
}

static const char *compute_axes(const cgt_camera *c, vec3 *fwd, vec3 *right, vec3 *up)
{
    vec3 f = sub(to_vec3(c->target), to_vec3(c->eye)), u = to_vec3(c->up);
    const double f_length = sqrt(dot(f, f)), u_length = sqrt(dot(u, u)); /* up is not 0, nor its square in double */
    if (!(f_length > 0))
        return "target must differ from eye";
    f = scale(f, 1 / f_length);
    vec3 r = cross(f, scale(u, 1 / u_length));
    const double r_length = sqrt(dot(r, r)); /* sine of the angle between them */
    if (!(r_length > 1e-6))
        return "up must not be parallel to target - eye";
    r = scale(r, 1 / r_length);
    *fwd = f;
    *right = r;
    *up = cross(r, f);
    return NULL;
}

/* The origins at the picture's corners are farther out than those of pixels. */
static bool origins_are_finite(const cgt_camera_rays *r)
{
    for (int a = 0; a < 3; a++)
        if (!isfinite(fabsf(r->eye[a]) + fabsf(r->right[a]) + fabsf(r->up[a])))
            return false;
    return true;
}

cgt_result cgt_camera_prepare(const cgt_camera *camera, uint32_t width, uint32_t height, cgt_camera_rays *rays,
                              char message[CGT_CAMERA_MESSAGE_BYTES])
{
    vec3 fwd, right, up;
    const cgt_camera c = with_defaults(camera);
    const char *error = check_camera(&c);
    if (!error)
        error = compute_axes(&c, &fwd, &right, &up);
    if (error) {
        snprintf(message, CGT_CAMERA_MESSAGE_BYTES, "camera: %s", error);
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    const bool orthographic = c.projection == CGT_PROJECTION_ORTHOGRAPHIC;
    const double half = orthographic ? 0.5 * c.height : tan(c.fov * (3.14159265358979323846 / 360));
    *rays = (cgt_camera_rays){.eye = {c.eye[0], c.eye[1], c.eye[2]},
                              .pixel = {2.f / (float)width, 2.f / (float)height},
                              .t_min = c.t_min,
                              .t_max = c.t_max,
                              .mask = c.mask,
                              .width = width,
                              .height = height,
                              .orthographic = orthographic};
    round_to(rays->fwd, fwd);
    round_to(rays->right, scale(right, half * width / height));
    round_to(rays->up, scale(up, half));
    if (finite3(rays->right) && finite3(rays->up) && (!orthographic || origins_are_finite(rays)))
        return CGT_OK;
    snprintf(message, CGT_CAMERA_MESSAGE_BYTES, "camera: the picture's width or height leaves the range of float");
    return CGT_ERROR_INVALID_ARGUMENT;
}
