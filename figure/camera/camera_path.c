/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The camera during a run; see camera_path.h. */
#include "camera/camera_path.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

void cgt_camera_path_fixed(camera_path *path, const cgt_camera *camera, double orbit_degrees)
{
    path->start = *camera;
    path->orbit_degrees = orbit_degrees;
}

void cgt_camera_path_at(const camera_path *path, double share, cgt_camera *camera)
{
    *camera = path->start;
    cgt_camera_orbit(camera, path->orbit_degrees * share);
}

int cgt_camera_path_fit(camera_path *path, const camera_directions *fit, const camera_reach *reach, const float min[3],
                        const float max[3])
{
    path->orbit_degrees = fit->orbit_degrees;
    return cgt_camera_reach_show(reach, fit, min, max, &path->start) == CGT_OK ? 0 : -1;
}

void cgt_camera_path_zoom(camera_path *path, float factor)
{
    const double half = (double)path->start.fov * pi / 360.0;
    path->start.fov = (float)(atan(tan(half) / (double)factor) * 360.0 / pi);
}

int cgt_camera_path_is_along(const float v[3], const float axis[3])
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
