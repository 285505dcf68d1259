/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A tile of a camera's frame, ready for its first object. */
#ifndef CGT_TILE_MAKE_H
#define CGT_TILE_MAKE_H

#include "kernel/tile_draw/tile_parallel_triangles.h"

/* Distance from the eye to the farthest corner of the world's bounds, rounded up. */
CGT_SPU_INLINE float farthest_corner(const cgt_world *world, const float eye[3])
{
    double square = 0;
    for (int a = 0; a < 3; a++) {
        const double low = fabs((double)world->low[a] - (double)eye[a]);
        const double high = fabs((double)world->high[a] - (double)eye[a]), most = low > high ? low : high;
        square += most * most;
    }
    return (float)(sqrt(square) * (1 + 0x1p-20));
}

/* The radius that the tile's gap is for. Larger spheres are slow, and smaller ones are left open where something lies
 * within the gap behind them, which is rarer: so the largest radius of which there is a good share of the objects, where
 * that is small beside the scene, else that of most objects. Levels go from large to small. */
CGT_SPU_INLINE float usual_radius(const cgt_world *world, float farthest)
{
    const cgt_loose_level *level = world->loose.level, *most = level;
    for (const cgt_loose_level *l = level; l < level + world->loose.levels; l++) {
        const float reach = fminf(l->reach[0], fminf(l->reach[1], l->reach[2]));
        if (l->objects >= world->valid / 64 && reach < farthest * 0.125f)
            return reach;
        most = l->objects > most->objects ? l : most;
    }
    return fminf(most->reach[0], fminf(most->reach[1], most->reach[2]));
}

/* c: as far from the eye as any object is; far_t: no t is beyond. */
CGT_SPU_INLINE void tile_gaps_make(tile *t, const cgt_world *world, float c, float far_t)
{
    const float r = world->objects.spheres ? usual_radius(world, c) : 0;
    if (t->parallel) {
        tile_parallel_gap_make(t, c, r, far_t);
        if (world->objects.triangles)
            tile_parallel_gap_widen(t, c, world->objects.spheres);
        return;
    }
    tile_gap_make(t, c, r, far_t);
    if (world->objects.triangles)
        tile_gap_widen(t, c);
}

CGT_SPU_INLINE void tile_make(tile *t, const cgt_world *world, const cgt_camera_rays *camera, const cgt_region *r)
{
    const float c = farthest_corner(world, camera->eye);
    t->rays = camera;
    t->linear = !world->objects.spheres && !camera->orthographic;
    t->columns = r->width;
    t->rows = r->height;
    tile_camera_make(camera, &t->camera);
    tile_parallel_make(t);
    tile_tables_make(t, r->x, r->y);
    tile_norms_make(t);
    tile_parts_make(t);
    tile_cone_make(t);
    tile_gaps_make(t, world, c, c * (1 + 0x1p-18f) + t->slack);
    tile_open(t, c * (1 + 0x1p-18f) + t->slack);
}

#endif
