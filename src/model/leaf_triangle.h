/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles as leaves of trees test them (kernel/primitive/lane_tests.h): one line of the cache instead of an index and three
 * vertices in four, and what does not depend on the ray worked out once a commit. */
#ifndef CGT_LEAF_TRIANGLE_H
#define CGT_LEAF_TRIANGLE_H

#include "core/context.h"
#include "model/committed_scene.h"

/* All times the world's scale. */
struct cgt_leaf_triangle {
    float vertex[3];  /* the first */
    float edge[2][3]; /* from there to the second and to the third */
    float sum[2];     /* of the sizes of each edge's components */
    float unused;
};

/* Makes those of all triangles of the world, and hands them to it. Fails with OUT_OF_MEMORY, with a message. */
cgt_result cgt_leaf_triangles_init(cgt_context *context, cgt_buffer *memory, cgt_committed_scene *committed_scene);

#endif
