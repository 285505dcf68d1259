/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whether a scene's triangles are grouped into clusters: a sample tells how much area the clusters' boxes have compared
 * with those of their triangles. In meshes whose order is that of neighbours the ratio is 0.6 to 1.0; a few runs that
 * jump from one end to the other make it several times as much, random order hundreds of times. Measured: a grid is
 * faster with clusters up to a ratio of 4.3, since large boxes have a level of their own. A tree of clusters is traced
 * at least as fast as one of triangles at 0.66 to 0.76; it takes an eighth to a third longer at 1.0, half as long again
 * at 2.8. Where the sample happens to hold the only neighbours of a mesh, the clusters' areas tell: a sixteenth of them
 * cannot have LARGE times the mean of a fair sample. A file of its own: tests replace it. */
#include "model/triangle_cluster.h"

#include <math.h>

#define MIN_TRIANGLES 8192u  /* triangles: fewer are larger in the picture, and a cluster of them is too large */
#define SAMPLED_CLUSTERS 64u /* clusters in the sample */
/* Golden-ratio hashing: samples are evenly spread and do not alias with the rows of a regular mesh. */
#define GOLDEN 0x9e3779b9u
#define MAX_GRID_RATIO 5.0f /* times the area */
#define MAX_TREE_RATIO 0.8f /* the same */
#define LARGE 64.0f         /* times the area of the mean cluster of the sample */

typedef struct sample_box {
    float low[3], high[3];
} sample_box;

static const sample_box empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void enlarge(sample_box *b, const float low[3], const float high[3])
{
    for (int a = 0; a < 3; a++) {
        b->low[a] = fminf(b->low[a], low[a]);
        b->high[a] = fmaxf(b->high[a], high[a]);
    }
}

static float half_area(const sample_box *b)
{
    const float x = b->high[0] - b->low[0], y = b->high[1] - b->low[1], z = b->high[2] - b->low[2];
    return x * y + y * z + z * x;
}

/* False where an index is out of range. */
static bool bound_triangle(const cgt_primitives *prims, uint32_t prim, sample_box *b)
{
    const cgt_primitive_array *a = cgt_primitives_array(prims, prim);
    uint32_t corner[3];
    *b = empty_box;
    cgt_array_corners(a, prim - a->first, corner);
    for (int k = 0; k < 3; k++) {
        if (corner[k] >= a->points)
            return false;
        const float *p = cgt_array_point(a, corner[k]);
        enlarge(b, p, p);
    }
    return true;
}

/* Adds the areas of a full cluster and of its triangles, without triangles that are points or not finite. */
static void add_areas(const cgt_primitives *prims, uint32_t cluster, float *cluster_area, float *triangle_area)
{
    sample_box cluster_box = empty_box;
    float sum = 0;
    for (uint32_t k = 0; k < CGT_CLUSTER; k++) {
        sample_box b;
        if (!bound_triangle(prims, cluster * CGT_CLUSTER + k, &b) || !(half_area(&b) > 0 && half_area(&b) < INFINITY))
            continue;
        enlarge(&cluster_box, b.low, b.high);
        sum += half_area(&b);
    }
    if (sum > 0 && sum < INFINITY) {
        *cluster_area += half_area(&cluster_box);
        *triangle_area += sum;
    }
}

cgt_cluster_use cgt_choose_clusters(const cgt_primitives *prims, float *max_half_area)
{
    const uint32_t full = prims->count / CGT_CLUSTER;
    float cluster_area = 0, triangle_area = 0;
    *max_half_area = INFINITY;
    if (prims->triangles != prims->count || prims->count < MIN_TRIANGLES)
        return CGT_CLUSTERS_NONE;
    for (uint32_t k = 1; k <= SAMPLED_CLUSTERS; k++)
        add_areas(prims, (uint32_t)((uint64_t)(k * GOLDEN) * full >> 32), &cluster_area, &triangle_area);
    *max_half_area = cluster_area / SAMPLED_CLUSTERS * LARGE;
    if (!(cluster_area <= triangle_area * MAX_GRID_RATIO))
        return CGT_CLUSTERS_NONE;
    return cluster_area <= triangle_area * MAX_TREE_RATIO ? CGT_CLUSTERS_ALL : CGT_CLUSTERS_GRID;
}
