/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Boxes against a tile, a vector of them at a time: against its window, and what its parts still see.
 *
 * In camera space (tile.h) a box is z, x, y of its middle and half its extents along those. All of it is in front of the
 * eye where z is above its extent; the columns under it are then between the least and the most of x / z of its ends.
 * Of parallel rays, any box's are those under x, and its extents have what origins are off by in them.
 *
 * Rounding, with u = 2^-24 and c the sum over the axes of all that a middle and its extents are made of: the middle, from
 * the eye, is off by 2 u c, its product with `dual` by 4 u c more, and a canonical direction by 3.5 u |d|, which is
 * 3.5 u c where a box is. 2^-19 c is added to the extents, and 1/16 of a column to the windows (tile_spheres.h). */
#ifndef CGT_TILE_BOXES_H
#define CGT_TILE_BOXES_H

#include "kernel/tile_draw/tile_parallel_spheres.h"
#include "kernel/tile_draw/tile_triangles.h"

/* The columns or rows, from the tile's first, that boxes in front cover; r: the reciprocals of their least and most z. */
CGT_SPU_INLINE vmask tile_boxes_window(const tile_span *of, vfloat middle, vfloat half, const vfloat r[2],
                                       uint32_t *from, uint32_t *to)
{
    const vfloat low = spu_sub(middle, half), high = spu_add(middle, half);
    const vfloat least = spux_min(spu_mul(low, r[0]), spu_mul(low, r[1]));
    const vfloat most = spux_max(spu_mul(high, r[0]), spu_mul(high, r[1]));
    const vfloat a = spu_mul(least, spux_vfloat(of->scale)), b = spu_mul(most, spux_vfloat(of->scale));
    return tile_window(spu_sub(spux_min(a, b), spux_vfloat(of->first)), spu_sub(spux_max(a, b), spux_vfloat(of->first)),
                       of, from, to);
}

CGT_SPU_INLINE vmask tile_parallel_boxes_unwanted(const tile *t, const vfloat v[3], const vfloat half[3])
{
    _Alignas(64) uint32_t x0[CGT_LANES], x1[CGT_LANES], y0[CGT_LANES], y1[CGT_LANES];
    vmask apart;
    const vfloat nearest = spu_sub(v[0], half[0]), far = spu_add(v[0], half[0]);
    const vmask outside = tile_parallel_windows(t, v[1], v[2], half[1], half[2], x0, x1, y0, y1);
    const vfloat seen = tile_windows_far(t, x0, x1, y0, y1, &apart);
    const vmask hidden =
        spu_or(spu_cmpgt(nearest, spux_vfloat(t->farthest)), spu_andc(spu_cmpgt(nearest, seen), apart));
    return spu_or(spu_cmpgt(spux_vfloat(0), far), spu_or(outside, hidden));
}

CGT_SPU_INLINE vmask tile_perspective_boxes_unwanted(const tile *t, const vfloat v[3], const vfloat half[3])
{
    _Alignas(64) uint32_t x0[CGT_LANES], x1[CGT_LANES], y0[CGT_LANES], y1[CGT_LANES];
    vfloat r[2];
    vmask apart;
    const vfloat near = spu_sub(v[0], half[0]), far = spu_add(v[0], half[0]);
    const vmask front = spu_cmpgt(near, spu_mul(half[0], spux_vfloat(0x1p-10f)));
    const vmask behind = spu_cmpgt(spux_vfloat(0), far);
    const vfloat nearest = spu_mul(near, spux_vfloat(tile_nearest_scale(t)));
    r[0] = spux_div(spux_vfloat(1), near);
    r[1] = spux_div(spux_vfloat(1), far);
    const vmask beside = tile_boxes_window(&t->across, v[1], half[1], r, x0, x1);
    const vmask above = tile_boxes_window(&t->down, v[2], half[2], r, y0, y1);
    const vfloat seen = tile_windows_far(t, x0, x1, y0, y1, &apart);
    const vmask hidden =
        spu_or(spu_cmpgt(nearest, spux_vfloat(t->farthest)), spu_andc(spu_cmpgt(nearest, seen), apart));
    return spu_or(behind, spu_and(front, spu_or(spu_or(beside, above), hidden)));
}

/* Boxes that the tile does not want. middle: from the eye, along the world's axes; half: along z, x, y of the camera. */
CGT_SPU_INLINE vmask tile_boxes_unwanted(const tile *t, const vfloat middle[3], const vfloat half[3])
{
    const float(*dual)[3] = t->camera.dual;
    vfloat v[3];
    for (int k = 0; k < 3; k++)
        v[k] = spu_madd(middle[0], spux_vfloat(dual[k][0]),
                        spu_madd(middle[1], spux_vfloat(dual[k][1]), spu_mul(middle[2], spux_vfloat(dual[k][2]))));
    return t->parallel ? tile_parallel_boxes_unwanted(t, v, half) : tile_perspective_boxes_unwanted(t, v, half);
}

/* Of a vector of clusters those that the tile wants, as bits. */
CGT_SPU_INLINE unsigned tile_clusters_wanted(const tile *t, const cgt_cluster *cluster, const uint32_t *reference,
                                             uint32_t count)
{
    vfloat d[8], middle[3], half[3], sum = spux_vfloat(0);
    fetch_clusters_of(cluster, reference, count, d);
    for (int a = 0; a < 3; a++) {
        middle[a] = spu_sub(d[a], spux_vfloat(t->rays->eye[a]));
        sum = spu_add(sum, spu_add(spux_abs(middle[a]), d[4 + a]));
    }
    const vfloat slack = spu_madd(sum, spux_vfloat(0x1p-19f), spux_vfloat(t->parallel ? t->slack : 0));
    for (int k = 0; k < 3; k++) {
        const float *dual = t->camera.dual[k];
        half[k] =
            spu_madd(d[4], spux_vfloat(fabsf(dual[0])),
                     spu_madd(d[5], spux_vfloat(fabsf(dual[1])), spu_madd(d[6], spux_vfloat(fabsf(dual[2])), slack)));
    }
    return ~spux_mask_bits(tile_boxes_unwanted(t, middle, half)) & tile_first_lanes(count);
}

#endif
