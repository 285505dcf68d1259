/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A sphere against the pixels of a tile in double, pixel by pixel: for those that the bounds of tile_spheres.h do not
 * hold for. They lie about the eye or behind it, are cut by the range's begin, or are so large that single precision is
 * coarse beside the tile's gap. The arithmetic is that of sphere_double.h, so what it is certain of is what decide.h
 * would say; the rest goes to the queue. */
#ifndef CGT_TILE_DOUBLE_H
#define CGT_TILE_DOUBLE_H

#include "../sphere_double.h"
#include "tile_decide.h"

/* What is known of a pair of rows: the depth of a certain hit, infinite for a certain miss, NaN where double is open. */
CGT_SPU_INLINE void tile_double_pair(const tile *t, cgt_sphere q, uint32_t pair, double depth[TILE_PAIR])
{
    const cgt_camera_rays *c = t->rays;
    const double t_min = (double)c->t_min, t_max = (double)c->t_max;
    for (uint32_t i = 0; i < TILE_PAIR; i++) {
        const float px = t->px[i], py = t->row[2 * pair + (i & 1)];
        float dir[3];
        for (int a = 0; a < 3; a++)
            dir[a] = (c->fwd[a] + px * c->right[a]) + py * c->up[a];
        const cgt_sphere_terms e = cgt_sphere_double_terms(c->eye, dir, q);
        const double error = cgt_sphere_double_disc_error(c->eye, dir, q);
        const double half = sqrt(e.disc);
        const cgt_sphere_roots root = cgt_sphere_double_roots(e, half);
        const double near = (double)(float)root.near, hit = near >= t_min ? root.near : root.far;
        const double rounded = (double)(float)hit;
        const double x = (double)px, y = (double)py;
        const double norm = 1 + (double)t->camera.a * x * x + (double)t->camera.b * y * y;
        const double inside = rounded >= t_min && rounded <= t_max && rounded < INFINITY ? hit * norm : INFINITY;
        const double known = e.disc < -error ? INFINITY : inside;
        const uint64_t open = cgt_sphere_double_unsafe(e, half) | !(e.disc > error || e.disc < -error);
        depth[i] = open && !(e.disc < -error) ? (double)NAN : known;
    }
}

/* Tests the rows of a window; columns beyond it cost less than to leave them out. */
__attribute__((noinline, unused)) static void tile_double_draw(const cgt_objects *objects, tile *t, uint32_t object,
                                                               uint32_t y0, uint32_t y1, tile_queue *queue,
                                                               cgt_counts *counts)
{
    const cgt_sphere q = cgt_objects_sphere(objects, object);
    const double gap = (double)t->gap;
    double depth[TILE_PAIR];
    counts->packet_tests++;
    for (uint32_t pair = y0 / 2; pair <= y1 / 2; pair++) {
        tile_double_pair(t, q, pair, depth);
        counts->double_tests += TILE_PAIR;
        for (uint32_t k = 0; k < TILE_PAIR; k++) {
            const uint32_t i = pair * TILE_PAIR + k;
            const double z = (double)t->z[i];
            if (depth[k] == INFINITY || depth[k] > z + gap || z == -INFINITY)
                continue;
            if (depth[k] * (1 + 0x1p-28) < z) {
                t->z[i] = (float)(depth[k] - 0.5 * gap);
                t->object[i] = object;
                continue;
            }
            tile_queue_push(objects, t, queue, i, object, counts);
        }
    }
}

#endif
