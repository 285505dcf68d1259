/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The camera during a run; see camera_path.h. */
#include "camera/camera_path.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

void cgt_camera_path_fixed(camera_path *path, const cgt_camera *camera, double orbit_degrees)
{
    *path = (camera_path){.start = *camera, .orbit_degrees = orbit_degrees};
}

void cgt_camera_path_at(const camera_path *path, double share, cgt_camera *camera)
{
    *camera = path->start;
    cgt_camera_orbit(camera, path->orbit_degrees * share);
}

int cgt_camera_path_fit(camera_path *path, const camera_directions *fit, const camera_reach *reach, const float min[3],
                        const float max[3])
{
    *path = (camera_path){.orbit_degrees = fit->orbit_degrees};
    return cgt_camera_reach_show(reach, fit, min, max, &path->start, NULL) == CGT_OK ? 0 : -1;
}

/* ---- Rooms ---------------------------------------------------------------------------------------------------- */

/* How far beyond the target the scene reaches across the edge of a side at a share of the angle's tangent, measured in
 * the plane of the picture: x + share * tangent * z of its points. That is convex in the share, so the line between
 * those at 0 and at 1 is above it, by a hundredth of a ball's radius or so. */
static double beyond(const camera_directions *fit, const camera_reach *reach, uint32_t position, uint32_t side,
                     double share, const double target[3])
{
    const uint32_t k = position * fit->sides + side, plain = fit->plain + position * 4 + side;
    const double tangent = fit->tangent[side / 2], whole = reach->along[k] - camera_along(fit, k, target);
    if (fit->sides == 5)
        return whole;
    return share * sqrt(1.0 + tangent * tangent) * whole +
           (1.0 - share) * (reach->along[plain] - camera_along(fit, plain, target));
}

/* How far the eye must be from the target, which moves to the right and up; on an orbit it stays. */
static double distance_in(const camera_directions *fit, const camera_reach *reach, const camera_room *room,
                          const double target[3], double spacing, double move[2])
{
    const int moves = fit->orbit_degrees == 0.0;
    const uint32_t positions = (fit->plain ? fit->plain : fit->count) / fit->sides;
    double distance = 0.0, far[4] = {0}, slope[4] = {0};
    for (uint32_t p = 0; p < positions; p++) {
        for (uint32_t side = 0; side < 4; side++) { /* at least so far that eye and target differ in float */
            slope[side] = room->share[side] * fit->tangent[side / 2];
            far[side] = beyond(fit, reach, p, side, room->share[side], target);
            if (!moves)
                distance = fmax(distance, fmax(far[side], 4.0 * spacing) / slope[side]);
        }
        for (int axis = 0; axis < 2 && moves; axis++)
            distance = fmax(distance, fmax(far[2 * axis] + far[2 * axis + 1], 8.0 * spacing) /
                                          (slope[2 * axis] + slope[2 * axis + 1]));
        if (fit->sides == 5) {
            const uint32_t eye = p * fit->sides + 4;
            distance = fmax(distance, reach->along[eye] - camera_along(fit, eye, target));
        }
    }
    for (int axis = 0; axis < 2; axis++) /* as much room left on one side as on the other */
        move[axis] =
            moves ? 0.5 * (far[2 * axis] - far[2 * axis + 1] + (slope[2 * axis + 1] - slope[2 * axis]) * distance)
                  : 0.0;
    return distance;
}

int cgt_camera_path_fit_room(camera_path *path, const camera_directions *fit, const camera_reach *reach,
                             const float min[3], const float max[3], const camera_room *rooms, uint32_t count,
                             uint32_t *chosen)
{
    double target[3], spacing, distance = INFINITY, move[2] = {0.0, 0.0};
    const uint32_t right = fit->sides == 5 ? 0 : fit->plain, up = right + 2;
    if (cgt_camera_path_fit(path, fit, reach, min, max) || camera_choose_target(fit, reach, min, max, target, &spacing))
        return -1;
    for (uint32_t i = 0; i < count; i++) {
        double moved[2];
        const double needed = distance_in(fit, reach, &rooms[i], target, spacing, moved);
        if (!(needed < distance))
            continue;
        distance = needed;
        memcpy(move, moved, sizeof move);
        *chosen = i;
    }
    const camera_room *const room = &rooms[*chosen];
    const double axis[2][3] = {{fit->x[right], fit->y[right], fit->z[right]}, {fit->x[up], fit->y[up], fit->z[up]}};
    for (int c = 0; c < 3; c++) {
        const double at = target[c] + move[0] * axis[0][c] + move[1] * axis[1][c], eye = at + distance * fit->view[c];
        if (!(fabs(eye) < (double)FLT_MAX / 16.0) || !(distance < (double)FLT_MAX / 16.0))
            return -1;
        path->start.eye[c] = (float)eye;
        path->start.target[c] = (float)at;
        for (int k = 0; k < 2 && fit->orbit_degrees == 0.0; k++)
            path->middle[c] +=
                0.5 * (room->share[2 * k] - room->share[2 * k + 1]) * fit->tangent[k] * distance * axis[k][c];
    }
    return 0;
}

void cgt_camera_path_zoom(camera_path *path, float factor)
{
    const double half = (double)path->start.fov * pi / 360.0;
    path->start.fov = (float)(atan(tan(half) / (double)factor) * 360.0 / pi);
    for (int c = 0; c < 3; c++) {
        const double move = path->middle[c] * (1.0 - 1.0 / (double)factor);
        path->start.eye[c] = (float)((double)path->start.eye[c] + move);
        path->start.target[c] = (float)((double)path->start.target[c] + move);
    }
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
