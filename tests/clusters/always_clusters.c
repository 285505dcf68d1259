/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Replaces the library's choose_clusters.c: every structure over triangles only gets clusters, however few and wherever
 * they are. */
#include "model/triangle_cluster.h"

#include <math.h>

cgt_cluster_use cgt_choose_clusters(const cgt_primitives *prims, float *max_half_area)
{
    *max_half_area = INFINITY;
    return prims->triangles == prims->count ? CGT_CLUSTERS_ALL : CGT_CLUSTERS_NONE;
}
