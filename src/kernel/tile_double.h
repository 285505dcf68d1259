/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A sphere or a triangle against the pixels of a tile in double, pixel by pixel: for those that the bounds of
 * tile_spheres.h and tile_triangles.h do not hold for. They lie about the eye or behind it, are cut by the range's begin,
 * or are so large that single precision is coarse beside what the tile keeps. The arithmetic is that of sphere_double.h
 * and triangle_double.h, so what it is certain of is what decide.h would say; the rest goes to the queue. */
#ifndef CGT_TILE_DOUBLE_H
#define CGT_TILE_DOUBLE_H

#include "../triangle_double.h"
#include "tile_draw.h"

/* A hit's t as the depth of the tile, infinite where it is not in the range. */
CGT_SPU_INLINE double tile_double_depth(const tile *t, float px, float py, double hit, bool linear)
{
    const double rounded = (double)(float)hit, t_min = (double)t->rays->t_min, t_max = (double)t->rays->t_max;
    const double x = (double)px, y = (double)py;
    const double norm = 1 + (double)t->camera.a * x * x + (double)t->camera.b * y * y;
    const double depth = linear ? -1 / (hit > 0x1p-120 ? hit : 0x1p-120) : hit * norm; /* finite in float */
    const bool inside = (rounded >= t_min) & (rounded <= t_max) & (rounded < INFINITY);
    return inside ? depth : (double)INFINITY;
}

/* What is known of pixels first to end - 1 of a pair of rows: the depth of a certain hit, infinite for a certain miss, NaN where double is open. */
CGT_SPU_INLINE void tile_double_sphere(const tile *t, cgt_sphere q, uint32_t pair, bool parallel, uint32_t first,
                                       uint32_t end, double depth[TILE_PAIR])
{
    const cgt_camera_rays *c = t->rays;
    const double t_min = (double)c->t_min;
    for (uint32_t i = first; i < end; i++) {
        const float px = t->px[i], py = t->row[2 * pair + (i & 1)];
        const cgt_exact_ray line = tile_line(c, parallel, px, py);
        const cgt_sphere_terms e = cgt_sphere_double_terms(line.org, line.dir, q);
        const double error = cgt_sphere_double_disc_error(line.org, line.dir, q);
        const double half = sqrt(e.disc);
        const cgt_sphere_roots root = cgt_sphere_double_roots(e, half);
        const double near = (double)(float)root.near, hit = near >= t_min ? root.near : root.far;
        const double inside = tile_double_depth(t, px, py, hit, false);
        const double known = e.disc < -error ? INFINITY : inside;
        const uint64_t open = cgt_sphere_double_unsafe(e, half) | !(e.disc > error || e.disc < -error);
        depth[i] = open && !(e.disc < -error) ? (double)NAN : known;
    }
}

CGT_SPU_INLINE void tile_double_triangle(const tile *t, const cgt_triangle *q, uint32_t pair, tile_kind kind,
                                         uint32_t first, uint32_t end, double depth[TILE_PAIR])
{
    for (uint32_t i = first; i < end; i++) {
        const float px = t->px[i], py = t->row[2 * pair + (i & 1)];
        const cgt_exact_ray line = tile_line(t->rays, kind == TILE_PARALLEL, px, py);
        const cgt_triangle_sides s = cgt_triangle_double_sides(line.org, line.dir, q);
        const cgt_triangle_plane p = cgt_triangle_double_plane(line.org, line.dir, q);
        int left = 0, right = 0;
        for (int k = 0; k < 3; k++) {
            left += s.w[k] > s.error[k];
            right += s.w[k] < -s.error[k];
        }
        const double known = tile_double_depth(t, px, py, p.num / p.den, kind == TILE_LINEAR);
        const bool missed = (left != 0) & (right != 0);
        const bool hit = ((left == 3) | (right == 3)) & cgt_triangle_double_t_safe(&p);
        depth[i] = missed ? (double)INFINITY : hit ? known : (double)NAN;
    }
}

CGT_SPU_INLINE void tile_double_pair(const tile *t, const cgt_shape *q, uint32_t pair, uint32_t first, uint32_t end,
                                     double depth[TILE_PAIR])
{
    const bool sphere = q->kind == CGT_KIND_SPHERES;
    if (sphere && t->parallel)
        tile_double_sphere(t, q->sphere, pair, true, first, end, depth);
    else if (sphere)
        tile_double_sphere(t, q->sphere, pair, false, first, end, depth);
    else if (t->linear)
        tile_double_triangle(t, &q->triangle, pair, TILE_LINEAR, first, end, depth);
    else if (t->parallel)
        tile_double_triangle(t, &q->triangle, pair, TILE_PARALLEL, first, end, depth);
    else
        tile_double_triangle(t, &q->triangle, pair, TILE_PERSPECTIVE, first, end, depth);
}

/* Tests the pixels of a window. */
__attribute__((noinline, unused)) static void tile_double_draw(const cgt_objects *objects, tile *t, uint32_t object,
                                                               tile_box box, tile_queue *queue, cgt_counts *counts)
{
    const cgt_shape q = cgt_objects_shape(objects, object);
    const uint32_t first = 2 * box.x0, end = 2 * box.x1 + 2;
    double depth[TILE_PAIR];
    counts->packet_tests++;
    for (uint32_t pair = box.y0 / 2; pair <= box.y1 / 2; pair++) {
        tile_double_pair(t, &q, pair, first, end, depth);
        counts->ray_tests += end - first;
        counts->double_tests += end - first;
        for (uint32_t k = first; k < end; k++) {
            const uint32_t i = pair * TILE_PAIR + k;
            const double z = (double)t->z[i];
            if (depth[k] == INFINITY || depth[k] > tile_depth_end(t, z) || z == -INFINITY)
                continue;
            if (depth[k] + fabs(depth[k]) * 0x1p-28 < z) {
                t->z[i] = (float)(t->linear ? depth[k] * (1 + 0.5 * TILE_SHARE) : depth[k] - 0.5 * (double)t->gap);
                t->object[i] = object;
                continue;
            }
            counts->double_tests--; /* it is counted when it is decided */
            tile_queue_push(objects, t, queue, i, object, counts);
        }
    }
}

#endif
