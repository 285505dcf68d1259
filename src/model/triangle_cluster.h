/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Clusters: runs of consecutive triangles, cluster i the objects CGT_CLUSTER i and on. Meshes list neighbours one after
 * the other more often than not; loose grid and wide tree are made of such a mesh's clusters in place of its triangles,
 * so that there are an eighth as many things to sort, and a grid's whole clusters are left out by their boxes before any
 * vertex is read. Scenes of triangles alone, enough of them, whose order is that of neighbours, get clusters
 * (choose_clusters.c); a tree only where they are tight. */
#ifndef CGT_TRIANGLE_CLUSTER_H
#define CGT_TRIANGLE_CLUSTER_H

#include <stdint.h>

#include "model/primitives.h"

#define CGT_CLUSTER_SHIFT 3
#define CGT_CLUSTER                                                                                                    \
    (1u << CGT_CLUSTER_SHIFT) /* triangles, the last one fewer. 4 and 16 are slower, both building and tracing */

/* As kernels load it: eight floats. */
typedef struct cgt_cluster {
    float middle[3]; /* of the bounds of all its valid triangles; while they are gathered, the least corner */
    uint32_t
        valid; /* those that are not skipped, as bits; the rest of a cluster without any is of no use, but for size */
    float
        half[3]; /* half extents, seen from the middle, rounded upwards; while they are gathered, the largest corner */
    float size;  /* the largest half extent; -1 where nothing is valid */
} cgt_cluster;

/* What is made of clusters in place of triangles. */
typedef enum cgt_cluster_use { CGT_CLUSTERS_NONE = 0, CGT_CLUSTERS_GRID, CGT_CLUSTERS_ALL } cgt_cluster_use;

/* What should be, of these objects. */
cgt_cluster_use cgt_choose_clusters(const cgt_primitives *prims);

static inline uint32_t cgt_clusters(uint32_t prims) { return prims / CGT_CLUSTER + (prims % CGT_CLUSTER > 0); }

#endif
