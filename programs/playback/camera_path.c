/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The camera during a run; see camera_path.h. In double, so that a camera far from the origin does not drift. */
#include "playback/camera_path.h"

#include <float.h>
#include <math.h>

static const double pi = 3.14159265358979323846;
static const double margin = 1.04; /* room around the box */

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

/* The distance from the box's centre, in the direction of the unit vector view, from which all its corners are in the
 * picture. A corner c is inside where |c.right| <= (distance - c.view) * tangent of half the angle. */
static double distance_for(const double half[3], const double view[3], const double up[3], double tan_x, double tan_y)
{
    double right[3], picture_up[3], distance = 0.0;
    cross(up, view, right);
    normalize(right);
    cross(view, right, picture_up);
    for (int corner = 0; corner < 8; corner++) {
        double c[3];
        for (int k = 0; k < 3; k++)
            c[k] = corner >> k & 1 ? half[k] : -half[k];
        const double side = fabs(dot(c, right)) / tan_x, height = fabs(dot(c, picture_up)) / tan_y;
        const double needed = dot(c, view) + margin * (side > height ? side : height);
        if (needed > distance)
            distance = needed;
    }
    return distance;
}

/* Half edges of the box, at least so large that eye and target differ in float, however small or far off it is. */
static int half_edges(const float min[3], const float max[3], double centre[3], double half[3])
{
    double largest = 0.0;
    for (int c = 0; c < 3; c++) {
        if (!isfinite(min[c]) || !isfinite(max[c]) || min[c] > max[c])
            return -1;
        centre[c] = 0.5 * ((double)min[c] + (double)max[c]);
        half[c] = 0.5 * ((double)max[c] - (double)min[c]);
        const double off = fabs(centre[c] - (double)(float)centre[c]); /* of the target, which is a float */
        half[c] += off > 0.01 * half[c] ? off : 0.0;                   /* the margin has room for less */
        largest = fmax(largest, fmax(fabs((double)min[c]), fabs((double)max[c])));
    }
    const double spacing = fmax(largest * (double)FLT_EPSILON, (double)FLT_MIN); /* of floats there, at most */
    for (int c = 0; c < 3; c++)
        half[c] = fmax(half[c], 4.0 * spacing);
    return 0;
}

int camera_path_frame(camera_path *path, const float min[3], const float max[3], const float view[3], const float up[3],
                      float fov, double aspect, double orbit_degrees)
{
    enum { STOPS = 72 }; /* positions on the orbit at which the box is measured */
    double centre[3], half[3], from[3], axis[3], distance = 0.0;
    if (half_edges(min, max, centre, half))
        return -1;
    for (int c = 0; c < 3; c++) {
        from[c] = (double)view[c];
        axis[c] = (double)up[c];
    }
    if (normalize(from) || normalize(axis))
        return -1;
    const double tan_y = tan((double)fov * pi / 360.0), tan_x = tan_y * aspect;
    const int stops = orbit_degrees != 0.0 ? STOPS : 0;
    for (int stop = 0; stop <= stops; stop++) {
        double turned[3] = {from[0], from[1], from[2]};
        if (stop)
            rotate(turned, axis, orbit_degrees * pi / 180.0 * stop / STOPS);
        distance = fmax(distance, distance_for(half, turned, axis, tan_x, tan_y));
    }
    cgt_camera_init(&path->start);
    path->start.fov = fov;
    path->orbit_degrees = orbit_degrees;
    for (int c = 0; c < 3; c++) {
        const double eye = centre[c] + distance * from[c];
        if (!(fabs(eye) < FLT_MAX / 16.0) || !(distance < FLT_MAX / 16.0))
            return -1;
        path->start.eye[c] = (float)eye;
        path->start.target[c] = (float)centre[c];
        path->start.up[c] = (float)axis[c];
    }
    return 0;
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
