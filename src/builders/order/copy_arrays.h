/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Float copies of the caller's arrays that cannot be read in place: doubles, arrays with an origin, packed structs,
 * other indices than 32-bit ones, radii by type. The commit makes them, and all else reads the copies alone. */
#ifndef CGT_COPY_ARRAYS_H
#define CGT_COPY_ARRAYS_H

#include "scene/check_geometry.h"
#include "scene/scene.h"

/* Copies the vertices and indices of all triangles that need it, by the context's threads. */
void cgt_copy_triangles(const cgt_scene *scene);

/* Copies the spheres or capsules i to i + count - 1 of an array that has a copy, from their geometry. Returns the first
 * with an index or a type out of range, or CGT_INVALID_ID; those from that one on are undefined. */
uint32_t cgt_copy_chunk(const cgt_primitive_array *a, const cgt_geometry *geometry, uint32_t i, uint32_t count);

#endif
