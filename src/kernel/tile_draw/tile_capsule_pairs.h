/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Draws capsules over the pixels of a tile. Of a vector of pixels one or two are mostly all that a thin capsule may be
 * seen at, and the test of lane_capsules.h takes as many operations as ten of others. So lanes are pairs of a pixel and
 * a capsule: those within the capsule's window and strip, where nothing nearer has been drawn. They are listed, for one
 * capsule of a vector after the other, and tested when they fill some vectors. Wide capsules fill vectors of pixels,
 * and are drawn one by one, as those that hold the eye (tile_capsules.h).
 *
 * A pixel may be in several lanes of a vector, each with another capsule. So its lanes are stored one after the other,
 * each by the depth that is there then. What lies behind the depth that was read before lies behind a hit, and stays
 * behind. What a pair's capsule and pixel are does not depend on the vector, so bounds are those of
 * tile_capsules.h. */
#ifndef CGT_TILE_CAPSULE_PAIRS_H
#define CGT_TILE_CAPSULE_PAIRS_H

#include "kernel/tile_draw/tile_capsules.h"

/* Of four lanes as many are filled by pixels, without listing them. */
#define TILE_LANES_ARE_PAIRS (CGT_LANES > 4)

/* Several vectors: those that were stored long ago are read faster. */
#define TILE_PAIRS (4 * CGT_LANES)

typedef struct tile_pairs {
    uint32_t count;
    _Alignas(CGT_VECTOR_BYTES) uint32_t pixel[TILE_PAIRS + CGT_LANES],
        lane[TILE_PAIRS + CGT_LANES]; /* of the capsule */
    _Alignas(CGT_VECTOR_BYTES) float px[TILE_PAIRS + CGT_LANES], py[TILE_PAIRS + CGT_LANES];
} tile_pairs;

/* What capsules are drawn with. */
typedef struct tile_capsule_draw {
    const cgt_primitives *prims;
    tile *t;
    const tile_capsules *capsules;
    const uint32_t *prim; /* of each lane */
    tile_queue *queue;
    cgt_counts *counts;
} tile_capsule_draw;

CGT_SPU_INLINE void tile_store_pairs(const tile_capsule_draw *w, const tile_pairs *pairs, uint32_t first,
                                     const tile_pixel_test *f)
{
    tile *t = w->t;
    _Alignas(CGT_VECTOR_BYTES) float depth[CGT_LANES];
    const unsigned certain = spux_mask_bits(f->certain);
    spux_store(depth, f->depth);
    for (unsigned left = certain | spux_mask_bits(f->possible); left; left &= left - 1) {
        const uint32_t k = (uint32_t)__builtin_ctz(left), i = pairs->pixel[first + k],
                       prim = w->prim[pairs->lane[first + k]];
        const float difference = depth[k] - t->z[i];
        if (certain >> k & 1 && difference < -t->padded_depth_error) {
            t->z[i] = depth[k];
            t->prim[i] = prim;
        } else if (!(difference > t->padded_depth_error))
            tile_queue_push(w->prims, t, w->queue, i, prim, w->counts);
    }
}

/* Tests a vector of pairs. */
CGT_SPU_INLINE void tile_test_pair_vector(const tile_capsule_draw *w, bool parallel, const tile_pairs *pairs,
                                          uint32_t first)
{
    const vuint lane = spux_load_uint(pairs->lane + first);
    const vfloat px = spux_load(pairs->px + first), py = spux_load(pairs->py + first);
    vfloat d[7];
    lane_rays ray;
    lane_hits h;
    for (int a = 0; a < 7; a++)
        d[a] = spux_permute(spux_load(w->capsules->d[a]), lane);
    w->counts->ray_tests += CGT_LANES;
    tile_load_lane_rays(w->t, parallel, px, py, &ray);
    ray.rlength = spux_vfloat(w->capsules->rlength);
    if (!lane_test_capsule(&ray, d, d + 3, d[6], &h))
        return;
    const vfloat best = spux_gather(w->t->z, (vint)spux_load_uint(pairs->pixel + first));
    const tile_pixel_test f = tile_test_depths(w->t, px, py, best, &h);
    tile_store_pairs(w, pairs, first, &f);
}

/* Tests whole vectors of pairs. */
CGT_SPU_INLINE void tile_test_pairs(const tile_capsule_draw *w, bool parallel, tile_pairs *pairs)
{
    uint32_t first = 0;
    for (; first + CGT_LANES <= pairs->count; first += CGT_LANES)
        tile_test_pair_vector(w, parallel, pairs, first);
    pairs->count -= first;
    spux_store_uint(pairs->pixel, spux_load_uint(pairs->pixel + first));
    spux_store_uint(pairs->lane, spux_load_uint(pairs->lane + first));
    spux_store(pairs->px, spux_load(pairs->px + first));
    spux_store(pairs->py, spux_load(pairs->py + first));
}

/* Tests what does not fill a vector: NaN as px is no pixel. */
CGT_SPU_INLINE void tile_end_pairs(const tile_capsule_draw *w, bool parallel, tile_pairs *pairs)
{
    if (!pairs->count)
        return;
    spux_store_unaligned_uint(pairs->pixel + pairs->count, spux_vuint(0));
    spux_store_unaligned_uint(pairs->lane + pairs->count, spux_vuint(0));
    spux_store_unaligned(pairs->px + pairs->count, spux_vfloat(NAN));
    spux_store_unaligned(pairs->py + pairs->count, spux_vfloat(0));
    for (uint32_t first = 0; first < pairs->count; first += CGT_LANES)
        tile_test_pair_vector(w, parallel, pairs, first);
}

/* Adds those of `seen`, lanes of a vector of pixels from i on. */
CGT_SPU_INLINE void tile_add_pairs(const tile_capsule_draw *w, bool parallel, tile_pairs *pairs, uint32_t i, vfloat px,
                                   vfloat py, vuint lane, vmask seen)
{
    const uint32_t end = pairs->count;
    spux_store_unaligned_uint(pairs->pixel + end, spux_compress(spu_add(spux_lane_index(), spux_vuint(i)), seen));
    spux_store_unaligned_uint(pairs->lane + end, lane);
    spux_store_unaligned(pairs->px + end, spux_compress(px, seen));
    spux_store_unaligned(pairs->py + end, spux_compress(py, seen));
    pairs->count += spux_count_bits(spux_mask_bits(seen));
    if (pairs->count > TILE_PAIRS - CGT_LANES)
        tile_test_pairs(w, parallel, pairs);
}

/* Lists the pixels of a window that capsule k may be seen at. */
CGT_SPU_INLINE void tile_list_pairs(const tile_capsule_draw *w, bool parallel, int k, tile_rect rect, tile_pairs *pairs)
{
    const tile *t = w->t;
    const tile_capsules *s = w->capsules;
    const vfloat nearest = spux_vfloat(tile_nearest_depth(t, s, k)), width = spux_vfloat(s->strip_width[k]);
    const vfloat m[3] = {spux_vfloat(s->strip[0][k]), spux_vfloat(s->strip[1][k]), spux_vfloat(s->strip[2][k])};
    const vuint lane = spux_vuint((uint32_t)k), end = spux_vuint(2 * rect.x1 + 2);
    for (uint32_t pair = rect.y0 / 2; pair <= rect.y1 / 2; pair++) {
        const vfloat py = spux_load(t->py[pair]), row = spu_madd(py, m[2], m[0]);
        for (uint32_t column = 2 * rect.x0; column <= 2 * rect.x1 + 1; column += CGT_LANES) {
            const uint32_t i = pair * TILE_ROW_PAIR + column;
            const vfloat px = spux_load_unaligned(t->px + column), from_axis = spux_abs(spu_madd(px, m[1], row));
            const vmask beside = spu_or(spu_cmpgt(nearest, spux_load_unaligned(t->z + i)), spu_cmpgt(from_axis, width));
            const vmask within = spu_cmpgt(end, spu_add(spux_lane_index(), spux_vuint(column)));
            const vmask seen = spu_andc(within, beside);
            if (!spux_none(seen))
                tile_add_pairs(w, parallel, pairs, i, px, py, lane, seen);
        }
    }
    w->counts->packet_tests++;
}

/* Not inlined, as few capsules are so wide or hold the eye. */
__attribute__((noinline)) static void tile_rasterise_wide(const cgt_primitives *prims, tile *t, const tile_capsules *s,
                                                          int k, uint32_t prim, tile_rect rect, tile_queue *queue,
                                                          cgt_counts *counts)
{
    tile_strip_columns crossed;
    if (s->enclosing >> k & 1)
        tile_rasterise_capsule_by(prims, t, false, true, NULL, s, k, prim, rect, queue, counts);
    else if (!tile_init_strip_columns(t, s, k, rect, &crossed))
        tile_rasterise_capsule_by(prims, t, t->parallel, false, NULL, s, k, prim, rect, queue, counts);
    else
        tile_rasterise_capsule_by(prims, t, t->parallel, false, &crossed, s, k, prim, rect, queue, counts);
}

/* Draws the visible ones, and returns how many. `parallel` is a constant: t->parallel. */
CGT_SPU_INLINE uint32_t tile_draw_capsules(const tile_capsule_draw *w, bool parallel)
{
    const tile_capsules *s = w->capsules;
    uint32_t drawn = 0;
    tile_pairs pairs;
    pairs.count = 0;
    for (unsigned left = s->visible; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        tile_rect rect;
        if (!tile_clip_window(w->t, &s->window, k, s->min_distance[k], &rect))
            continue;
        drawn++;
        if (rect.x1 - rect.x0 >= CGT_LANES || s->enclosing >> k & 1)
            tile_rasterise_wide(w->prims, w->t, s, k, w->prim[k], rect, w->queue, w->counts);
        else if (TILE_LANES_ARE_PAIRS)
            tile_list_pairs(w, parallel, k, rect, &pairs);
        else
            tile_rasterise_capsule_by(w->prims, w->t, parallel, false, NULL, s, k, w->prim[k], rect, w->queue,
                                      w->counts);
    }
    tile_end_pairs(w, parallel, &pairs);
    return drawn;
}

#endif
