/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles as leaves of trees test them (kernel/primitive/lane_tests.h): one cache line instead of an index and three
 * vertices in four lines; what does not depend on the ray is computed once per commit. */
#ifndef CGT_LEAF_TRIANGLE_H
#define CGT_LEAF_TRIANGLE_H

#include <math.h>

#include "core/memory.h"
#include "model/committed_scene.h"

/* All times the scene's scale. */
typedef struct cgt_leaf_triangle {
    float vertex[3];  /* the first */
    float edge[2][3]; /* from there to the second and to the third */
    float sum[2];     /* of the sizes of each edge's components */
    float unused;
} cgt_leaf_triangle;

/* One triangle of a scene of that scale. */
static inline void cgt_leaf_triangle_prepare(const cgt_triangle *q, float scale, cgt_leaf_triangle *t)
{
    for (int a = 0; a < 3; a++)
        t->vertex[a] = q->v[0][a] * scale;
    for (int k = 0; k < 2; k++) {
        for (int a = 0; a < 3; a++)
            t->edge[k][a] = q->v[k + 1][a] * scale - t->vertex[a];
        t->sum[k] = fabsf(t->edge[k][0]) + fabsf(t->edge[k][1]) + fabsf(t->edge[k][2]);
    }
}

/* Prepares all triangles of the scene and stores them there. Fails with OUT_OF_MEMORY, with a message. */
cgt_result cgt_leaf_triangles_init(cgt_context *context, cgt_buffer *memory, cgt_committed_scene *committed_scene);

#endif
