/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A tile of a camera's frame, ready for its first object. */
#ifndef CGT_TILE_MAKE_H
#define CGT_TILE_MAKE_H

#include "kernel/tile_draw/tile_parallel_triangles.h"

/* Distance from the eye to the farthest corner of the world's bounds, rounded up. */
CGT_SPU_INLINE float tile_max_corner_distance(const cgt_committed_scene *committed_scene, const float eye[3])
{
    double square = 0;
    for (int a = 0; a < 3; a++) {
        const double low = fabs((double)committed_scene->low[a] - (double)eye[a]);
        const double high = fabs((double)committed_scene->high[a] - (double)eye[a]), distance = low > high ? low : high;
        square += distance * distance;
    }
    return (float)(sqrt(square) * (1 + 0x1p-20));
}

/* The radius that the tile's gap is for. Larger spheres are slow, and smaller ones are left open where something lies
 * within the gap behind them, which is rarer: so the largest radius of which there is a good share of the objects, where
 * that is small beside the scene, else that of most objects. Levels go from large to small. */
CGT_SPU_INLINE float tile_typical_radius(const cgt_committed_scene *committed_scene, float farthest)
{
    const cgt_loose_level *level = committed_scene->loose.level, *largest = level;
    for (const cgt_loose_level *l = level; l < level + committed_scene->loose.levels; l++) {
        const float reach = fminf(l->reach[0], fminf(l->reach[1], l->reach[2]));
        if (l->prims >= committed_scene->valid / 64 && reach < farthest * 0.125f)
            return reach;
        largest = l->prims > largest->prims ? l : largest;
    }
    return fminf(largest->reach[0], fminf(largest->reach[1], largest->reach[2]));
}

/* c: as far from the eye as any object is; far_t: no t is beyond. */
CGT_SPU_INLINE void tile_init_depth_errors(tile *t, const cgt_committed_scene *committed_scene, float c, float far_t)
{
    const float r = committed_scene->prims.spheres ? tile_typical_radius(committed_scene, c) : 0;
    if (t->parallel) {
        tile_init_parallel_depth_error(t, c, r, far_t);
        if (committed_scene->prims.triangles)
            tile_widen_parallel_error(t, c, committed_scene->prims.spheres);
        return;
    }
    tile_init_sphere_depth_error(t, c, r, far_t);
    if (committed_scene->prims.triangles)
        tile_widen_depth_error(t, c);
}

CGT_SPU_INLINE void tile_init(tile *t, const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                              const cgt_region *r)
{
    const float c = tile_max_corner_distance(committed_scene, camera->eye);
    t->rays = camera;
    t->linear = !committed_scene->prims.spheres && !camera->orthographic;
    t->columns = r->width;
    t->rows = r->height;
    tile_init_camera(camera, &t->camera);
    tile_init_parallel(t);
    tile_init_tables(t, r->x, r->y);
    tile_init_norms(t);
    tile_init_parts(t);
    tile_init_cone(t);
    tile_init_depth_errors(t, committed_scene, c, c * (1 + 0x1p-18f) + t->length_error);
    tile_init_pixels(t, c * (1 + 0x1p-18f) + t->length_error);
}

#endif
