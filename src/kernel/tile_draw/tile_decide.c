/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decides the queue of a tile (tile_queue.h). Where rays have one origin, spheres of one array go a vector at a time
 * (tile_decide_spheres.c), and triangles by runs of one pair of them (tile_decide_triangles.c). */
#include "kernel/tile_draw/tile_queue.h"

/* Of copies the lower number wins. */
CGT_SPU_INLINE bool tile_are_copies(const cgt_primitives *prims, const tile *t, uint32_t a, uint32_t b)
{
    const cgt_primitive p = cgt_primitives_get(prims, a), q = cgt_primitives_get(prims, b);
    return filter_are_copies(&p, &q, t->rays->t_min, t->rays->t_max);
}

void CGT_KERNEL(cgt_tile_decide)(const cgt_primitives *prims, tile *t, uint32_t i, uint32_t prim, cgt_counts *counts)
{
    const uint32_t closest = t->prim[i];
    double hit_t;
    if (closest == prim || t->z[i] == -INFINITY)
        return;
    if (closest != CGT_INVALID_ID && tile_are_copies(prims, t, prim, closest)) {
        tile_set_closest(t, i, prim < closest ? prim : closest);
        return;
    }
    const cgt_ray ray = tile_pixel_ray(t, i);
    if (!filter_is_closer(prims, &ray, closest, prim, &hit_t, counts))
        return;
    tile_set_closest(t, i, prim);
    t->z[i] = tile_compute_depth(t, i, hit_t);
}

void CGT_KERNEL(cgt_tile_flush)(const cgt_primitives *prims, tile *t, tile_queue *q, cgt_counts *counts)
{
    if (prims->triangles && !t->parallel)
        CGT_KERNEL(cgt_tile_flush_triangles)(prims, t, q, counts);
    else if (prims->arrays == 1 && prims->spheres && !t->parallel)
        CGT_KERNEL(cgt_tile_flush_spheres)(prims, t, q, counts);
    else
        for (uint32_t k = 0; k < q->entries; k++)
            CGT_KERNEL(cgt_tile_decide)(prims, t, q->pixel[k], q->prim[k], counts);
    q->entries = 0;
}

/* Most lanes are decided: four vectors are looked at at once. */
void CGT_KERNEL(cgt_tile_queue_undecided)(const cgt_primitives *prims, tile *t, uint32_t prim, tile_rect rect,
                                          uint32_t windows, const uint16_t *undecided, tile_queue *queue,
                                          cgt_counts *counts)
{
    const uint32_t end = windows * (rect.y1 / 2 - rect.y0 / 2 + 1);
    for (uint32_t k = 0; k < end; k += 4) {
        uint64_t four;
        memcpy(&four, undecided + k, sizeof four);
        for (uint32_t w = k; four && w < k + 4 && w < end; w++) {
            const uint32_t i = (rect.y0 / 2 + w / windows) * TILE_ROW_PAIR + 2 * rect.x0 + w % windows * CGT_LANES;
            for (unsigned undecided_lanes = undecided[w]; undecided_lanes; undecided_lanes &= undecided_lanes - 1)
                tile_queue_push(prims, t, queue, i + (uint32_t)__builtin_ctz(undecided_lanes), prim, counts);
        }
    }
}

void CGT_KERNEL(cgt_tile_queue_small)(const cgt_primitives *prims, tile *t, uint32_t prim, uint32_t first,
                                      uint64_t undecided, tile_queue *queue, cgt_counts *counts)
{
    for (; undecided; undecided &= undecided - 1) {
        const uint32_t bit = (uint32_t)__builtin_ctzll(undecided);
        tile_queue_push(prims, t, queue, first + bit / 16 * TILE_ROW_PAIR + bit % 16, prim, counts);
    }
}
