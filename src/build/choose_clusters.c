/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whether a scene's triangles go by clusters, as a sample of them tells: by how much area the clusters' boxes have beside
 * those of their triangles. In meshes whose order is that of neighbours it is 0.6 to 1.0 times as much; a few runs that
 * jump from one end to the other make it several times as much, random order hundreds of times. Measured: a grid gains up
 * to 4.3, since large boxes have a level of their own. A tree of clusters takes as long to trace as one of triangles, or
 * less, at 0.66 to 0.76; an eighth to a third longer at 1.0, half as long again at 2.8. */
#include "model/triangle_cluster.h"

#include <math.h>

#define LEAST 8192u /* triangles: fewer are larger in the picture, and a cluster of them is too large */
#define SAMPLES 64u /* clusters that are looked at */
#define GOLDEN                                                                                                         \
    0x9e3779b9u        /* the golden section of 2^32: its multiples come nowhere close, and keep no time with rows */
#define MOST_GRID 5.0f /* times the area */
#define MOST_TREE 0.8f /* the same */

typedef struct sample_box {
    float low[3], high[3];
} sample_box;

static const sample_box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

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
static bool bound(const cgt_objects *objects, uint32_t object, sample_box *b)
{
    const cgt_object_array *a = cgt_objects_array(objects, object);
    uint32_t corner[3];
    *b = nothing;
    cgt_array_corners(a, object - a->first, corner);
    for (int k = 0; k < 3; k++) {
        if (corner[k] >= a->points)
            return false;
        const float *p = cgt_array_point(a, corner[k]);
        enlarge(b, p, p);
    }
    return true;
}

/* Adds the areas of a cluster, which is full, and of its triangles. What is not finite, or is a point, is left out. */
static void add_areas(const cgt_objects *objects, uint32_t cluster, float *whole, float *parts)
{
    sample_box all = nothing;
    float sum = 0;
    for (uint32_t k = 0; k < CGT_CLUSTER; k++) {
        sample_box b;
        if (!bound(objects, cluster * CGT_CLUSTER + k, &b) || !(half_area(&b) > 0 && half_area(&b) < INFINITY))
            continue;
        enlarge(&all, b.low, b.high);
        sum += half_area(&b);
    }
    if (sum > 0 && sum < INFINITY) {
        *whole += half_area(&all);
        *parts += sum;
    }
}

cgt_cluster_use cgt_choose_clusters(const cgt_objects *objects)
{
    const uint32_t full = objects->count / CGT_CLUSTER;
    float whole = 0, parts = 0;
    if (objects->spheres || objects->count < LEAST)
        return CGT_CLUSTERS_NONE;
    for (uint32_t k = 1; k <= SAMPLES; k++)
        add_areas(objects, (uint32_t)((uint64_t)(k * GOLDEN) * full >> 32), &whole, &parts);
    if (!(whole <= parts * MOST_GRID))
        return CGT_CLUSTERS_NONE;
    return whole <= parts * MOST_TREE ? CGT_CLUSTERS_ALL : CGT_CLUSTERS_GRID;
}
