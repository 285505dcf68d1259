/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Clusters: eight consecutive triangles each; cluster i begins with primitive CGT_CLUSTER i. Most meshes list
 * neighbours one after the other. Loose grid and BVH are built from the clusters of such a mesh instead of its
 * triangles, so that an eighth as many items are sorted, and a grid culls whole clusters by their boxes before any
 * vertex is read. Scenes of many triangles alone, in the order of neighbours, get clusters (choose_clusters.c); a tree
 * only where they are tight. */
#ifndef CGT_TRIANGLE_CLUSTER_H
#define CGT_TRIANGLE_CLUSTER_H

#include <stdint.h>

#include "model/primitives.h"

#define CGT_CLUSTER_SHIFT 3
#define CGT_CLUSTER (1u << CGT_CLUSTER_SHIFT) /* triangles, fewer in the last; 4 and 16 build and trace more slowly */

/* Eight floats, as kernels load them. While clusters are gathered, middle and half hold the least and the largest
 * corner. */
typedef struct cgt_cluster {
    float middle[3]; /* of the bounds of all its valid triangles */
    uint32_t valid;  /* those that are not skipped, as bits; of a cluster without any only `size` is defined */
    float half[3];   /* half extents, seen from the middle, rounded upwards */
    float size;      /* the largest half extent; -1 where nothing is valid */
} cgt_cluster;

/* Which structures are built from clusters instead of triangles. */
typedef enum cgt_cluster_use { CGT_CLUSTERS_NONE = 0, CGT_CLUSTERS_GRID, CGT_CLUSTERS_ALL } cgt_cluster_use;

/* Chooses it for these primitives, by a sample. *max_half_area: clusters with more half area than that are not what the
 * sample promised. */
cgt_cluster_use cgt_choose_clusters(const cgt_primitives *prims, float *max_half_area);

/* Whether so many clusters break the sample's promise that triangles serve better. */
static inline bool cgt_clusters_are_loose(uint32_t large, uint32_t clusters) { return large > clusters / 16; }

static inline uint32_t cgt_clusters(uint32_t prims) { return prims / CGT_CLUSTER + (prims % CGT_CLUSTER > 0); }

#endif
