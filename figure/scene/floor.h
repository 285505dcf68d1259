/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A floor under the scene: a large square, chequered or of one piece. */
#ifndef FLOOR_H
#define FLOOR_H

#include <stdint.h>

#include <cgt/cgt.h>

enum { FLOOR_CHEQUERS = 48, FLOOR_SQUARES = FLOOR_CHEQUERS * FLOOR_CHEQUERS };

typedef struct floor_mesh {
    cgt_triangles triangles; /* two a square, of the arrays below; count 0: there is no floor */
    float corner[FLOOR_SQUARES * 4][3];
    uint32_t index[FLOOR_SQUARES * 2][3];
} floor_mesh;

/* Squares around a place, across the axis 0 to 2. size: of the scene. Chequers are a fifth of it wide, FLOOR_CHEQUERS
 * along each edge; one piece reaches beyond what cameras see that look down on the scene. */
void cgt_floor_make(floor_mesh *floor, const float middle[3], int axis, float size, int is_chequered);

#endif
