/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The first frame of a file of triangles as a scene with rays. */
#ifndef MESH_RAYS_H
#define MESH_RAYS_H

#include <stdbool.h>

#include <cgt/research.h>

#include "hard_cases/hard_scene.h"

/* True if the file exists and this build can read it; else prints the reason. */
bool mesh_is_here(const char *path);

/* Reads the file into a scene with room for `rays` rays and none yet; false with a message on failure. */
bool mesh_read(const char *path, uint32_t rays, hard_scene *s);

/* A camera whose eye and target are given relative to the bounds, 0 to 1 along each axis. */
cgt_camera mesh_camera(const hard_scene *s, const float eye[3], const float target[3]);

/* The rays of such a camera's picture, in squares of 8x8 pixels. False if the camera is invalid. */
bool mesh_aim_pixels(hard_scene *s, const float eye[3], const float target[3]);

/* Rays from random points in and around the bounds to vertices and points of edges, rounded. */
void mesh_aim_edges(hard_scene *s);

#endif
