/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which bodies the triangles of a mesh close in: what glass needs. Vertices at the same place are one, whatever their
 * index, and triangles that share one belong to one body. A body is closed where each of its edges is used as often one
 * way as the other. Triangles without area count like others. */
#ifndef CLOSED_MESH_H
#define CLOSED_MESH_H

#include <stddef.h>
#include <stdint.h>

/* Numbers the bodies of a mesh.
 *   index      three vertices for each of `triangles` triangles; below `vertices`
 *   position   x, y, z of each vertex
 *   body       gets the number of each triangle's body, from 0 on in the order of their first triangles
 *   bodies     gets how many there are
 *   error      gets a sentence
 * Returns 0; 1 with a sentence where a body is not closed: body and bodies are set; -1 with a sentence where there is
 * no memory. It takes O(n log n). */
int closed_mesh_bodies(const uint32_t *index, uint32_t triangles, const float *position, uint32_t vertices,
                       uint32_t *body, uint32_t *bodies, char *error, size_t error_size);

#endif
