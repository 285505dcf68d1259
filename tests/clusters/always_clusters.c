/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Replaces the library's choose_clusters.c: every structure of triangles alone gets clusters, however few there are
 * and wherever they lie. */
#include "model/triangle_cluster.h"

cgt_cluster_use cgt_choose_clusters(const cgt_primitives *prims)
{
    return prims->spheres ? CGT_CLUSTERS_NONE : CGT_CLUSTERS_ALL;
}
