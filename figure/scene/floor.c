/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A floor; see floor.h. */
#include "scene/floor.h"

#include <string.h>

void cgt_floor_make(floor_mesh *floor, const float middle[3], int axis, float size, int is_chequered)
{
    const uint32_t side = is_chequered ? FLOOR_CHEQUERS : 1;
    const float square = (is_chequered ? 0.2f : 60.0f) * size, half = 0.5f * (float)side;
    const int a = (axis + 1) % 3, e = (axis + 2) % 3;
    for (uint32_t i = 0; i < side * side; i++) {
        const uint32_t first = 4 * i, two[2][3] = {{first, first + 1, first + 2}, {first + 1, first + 3, first + 2}};
        memcpy(floor->index[2 * i], two, sizeof two);
        for (uint32_t k = 0; k < 4; k++) {
            const uint32_t column = i % side + (k & 1), row = i / side + (k >> 1);
            float *const corner = floor->corner[first + k];
            corner[axis] = middle[axis];
            corner[a] = middle[a] + ((float)column - half) * square;
            corner[e] = middle[e] + ((float)row - half) * square;
        }
    }
    floor->triangles = (cgt_triangles){.count = 2 * side * side,
                                       .indices = cgt_uint32s(floor->index[0], 0),
                                       .vertex_count = 4 * side * side,
                                       .vertices = cgt_floats(floor->corner[0], 0)};
}
