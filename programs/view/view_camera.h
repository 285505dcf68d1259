/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * How a user moves a camera. `up` of the camera stays at right angles to its view, so that any direction will do. */
#ifndef VIEW_CAMERA_H
#define VIEW_CAMERA_H

#include <cgt/cgt.h>

/* Turns `up` to a right angle with the view. */
void view_camera_straighten(cgt_camera *camera);

/* Turns eye and target about a place, to the right about `axis` and up about the camera's right, in radians; never over
 * the axis' ends. */
void view_camera_turn(cgt_camera *camera, const float about[3], const float axis[3], float right, float up);

/* Moves by pixels of a picture so high, so that what lies as far off as the target stays under the pointer. */
void view_camera_pan(cgt_camera *camera, float right, float up, uint32_t height);

/* Moves so that everything seems `factor` times as far from a place that stays where it is in the picture. */
void view_camera_zoom(cgt_camera *camera, const float place[3], float factor);

/* Looks along -direction at the same target, from as far; `up`: what then points up. */
void view_camera_look(cgt_camera *camera, const float direction[3], const float up[3]);

/* Makes the target as far off as a place, on the same axis. is_parallel: the eye moves, so that sizes stay. */
void view_camera_target(cgt_camera *camera, const float place[3], int is_parallel);

/* The place that a pixel shows as far off as the target; aspect: width / height; x, y: shares of the picture from its
 * upper left corner. */
void view_camera_place(const cgt_camera *camera, float aspect, float x, float y, float place[3]);

/* Where a place is seen: shares of the picture. Returns 0 where it lies behind the eye. */
int view_camera_project(const cgt_camera *camera, int is_parallel, float aspect, const float place[3], float at[2]);

#endif
