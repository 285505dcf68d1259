/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Capsules against a tile of points: windows of their boxes, then the test of lane_capsules.h. Of a group's rays one or
 * two are mostly all that come near to a thin capsule. So lanes are pairs of a ray and a capsule, which the short test
 * of the line leaves; they are listed for one capsule of a vector after the other, and tested when they fill a vector.
 * Apart from light_grid.c, which inlines it, because most scenes have none. */
#ifndef CGT_LIGHT_CAPSULES_H
#define CGT_LIGHT_CAPSULES_H

#include "kernel/light/light_groups.h"
#include "kernel/primitive/lane_capsules.h"

/* Of four lanes as many are filled by a group, without listing them. */
#define LIGHT_LANES_ARE_PAIRS (CGT_LANES > 4)

/* Capsules of which box and window are known. */
typedef struct light_capsules {
    _Alignas(CGT_VECTOR_BYTES) float d[7][CGT_LANES];              /* the numbers of cgt_capsule */
    float axis[3][CGT_LANES], error[CGT_LANES], square[CGT_LANES]; /* of lane_strip_init */
    light_windows windows;
} light_capsules;

/* Returns the visible lanes, as bits. A middle is rounded once, a half extent twice, from differences below 2 M
 * (light_packet.h): 4 u M together, of which the margin of windows is a hundred times. */
CGT_SPU_INLINE unsigned light_project_capsules(const light_tile *t, const uint32_t *reference, uint32_t count,
                                               bool by_table, light_capsules *s)
{
    const vfloat share = spux_vfloat(0.5f);
    vfloat d[7], middle[3], half[3], n[3], error, square;
    gather_scene_capsules(&t->committed_scene->prims, reference, count, d);
    for (int k = 0; k < 7; k++)
        spux_store(s->d[k], d[k]);
    if (LIGHT_LANES_ARE_PAIRS) {
        lane_strip_init(d, d + 3, d[6], n, &error, &square);
        for (int a = 0; a < 3; a++)
            spux_store(s->axis[a], n[a]);
        spux_store(s->error, error);
        spux_store(s->square, square);
    }
    for (int a = 0; a < 3; a++) {
        middle[a] = spu_madd(d[a], share, spu_mul(d[3 + a], share));
        half[a] = spu_add(spux_abs(spu_msub(d[3 + a], share, spu_mul(d[a], share))), d[6]);
    }
    return light_project_boxes(t, middle, half, by_table, &s->windows) & first_lanes(count);
}

enum { LIGHT_PAIR_REALS = 9 };

/* Pairs of a ray of the tile and a capsule: fewer than two vectors of them. */
typedef struct light_pairs {
    uint32_t count;
    _Alignas(CGT_VECTOR_BYTES) float real[LIGHT_PAIR_REALS][2 * CGT_LANES]; /* org, dir, t_min, t_max and d.d */
    _Alignas(CGT_VECTOR_BYTES) uint32_t ray[2 * CGT_LANES], capsule[2 * CGT_LANES];
} light_pairs;

/* Rays against capsules, one of each in every lane. Returns false if all certainly miss; else those that certainly hit
 * within their ranges, and those that have to be decided. */
CGT_SPU_INLINE bool light_test_capsule_lanes(const vfloat real[LIGHT_PAIR_REALS], const vfloat d[7], vmask *certain_hit,
                                             vmask *undecided)
{
    lane_rays r = {.t_min = real[6]};
    lane_hits q;
    for (int a = 0; a < 3; a++) {
        r.org[a] = real[a];
        r.dir[a] = real[3 + a];
    }
    r.rdd = spux_div(spux_vfloat(1), real[8]);
    r.rlength = lane_length_reciprocal(r.rdd);
    if (!lane_test_capsule(&r, d, d + 3, d[6], &q))
        return false;
    const vfloat t_max = real[7];
    const vmask possible = spu_andc(spu_or(q.certain_hit, q.undecided), spu_cmpgt(q.low, t_max));
    const vmask within = spu_or(spu_cmpgt(t_max, q.high), spu_cmpeq(t_max, spux_vfloat(INFINITY)));
    *certain_hit = spu_and(spu_and(q.certain_hit, possible), within);
    *undecided = spu_andc(possible, *certain_hit);
    return spux_any(possible);
}

/* Rays i to i + CGT_LANES - 1 of a packet. */
CGT_SPU_INLINE void light_load_rays(const light_packet *l, uint32_t i, vfloat real[LIGHT_PAIR_REALS])
{
    const packet *p = &l->rays;
    for (int a = 0; a < 3; a++) {
        real[a] = spux_load(p->org[a] + i);
        real[3 + a] = spux_load(p->dir[a] + i);
    }
    real[6] = spux_load(p->t_min + i);
    real[7] = spux_load(p->t_max + i);
    real[8] = spux_load(l->square + i);
}

/* Capsule k against the rays of a group. */
CGT_SPU_INLINE void light_test_capsule(light_tile *t, const light_capsules *s, uint32_t k, uint32_t group,
                                       uint32_t prim)
{
    const uint32_t i = group % LIGHT_PACKET_GROUPS * CGT_LANES;
    light_packet *l = &t->packet[group / LIGHT_PACKET_GROUPS];
    vfloat real[LIGHT_PAIR_REALS], d[7];
    vmask certain_hit, undecided;
    light_load_rays(l, i, real);
    for (int a = 0; a < 7; a++)
        d[a] = spux_vfloat(s->d[a][k]);
    if (!light_test_capsule_lanes(real, d, &certain_hit, &undecided))
        return;
    const vmask open = spu_cmpgt(spux_load(l->rays.high + i), spux_vfloat(-INFINITY));
    light_store_hits(&t->committed_scene->prims, l, i, prim, certain_hit, spu_and(undecided, open), t->counts);
    light_update_group(t, group);
}

/* ---- pairs ---- */

/* The rays i to i + CGT_LANES - 1 of a packet whose lines may meet capsule k. Directions are brought to a length of 1,
 * which an estimate is near enough to: below 2, as the test asks, errors are half of those that it allows for, and that
 * of the product with the estimate is less than the other half. Where |d|^2 overflows or underflows no lane misses. */
CGT_SPU_INLINE vmask light_meets_strip(const vfloat real[LIGHT_PAIR_REALS], const light_capsules *s, uint32_t k)
{
    const vfloat rlength = spux_rsqrte(real[8]);
    vfloat c[3], n[3], dir[3];
    for (int a = 0; a < 3; a++) {
        c[a] = spu_sub(spux_vfloat(s->d[a][k]), real[a]);
        dir[a] = spu_mul(real[3 + a], rlength);
        n[a] = spux_vfloat(s->axis[a][k]);
    }
    const vfloat size = spu_madd(lane_sum(c), spux_vfloat(1 + 0x1p-20f), spux_vfloat(s->d[6][k]));
    return lane_meets_strip(dir, c, n, size, spux_vfloat(s->error[k]), spux_vfloat(s->square[k]));
}

/* A ray may be in several lanes: the first of them that hits ends it. */
CGT_SPU_INLINE void light_store_pairs(light_tile *t, const light_pairs *pairs, const uint32_t *prim, unsigned certain,
                                      unsigned undecided)
{
    for (unsigned left = certain | undecided; left; left &= left - 1) {
        const unsigned bit = left & -left;
        const uint32_t k = (uint32_t)__builtin_ctz(left), number = pairs->ray[k], group = number / CGT_LANES;
        const uint32_t i = number % PACKET_MAX_RAYS, first = i / CGT_LANES * CGT_LANES;
        light_packet *l = &t->packet[number / PACKET_MAX_RAYS];
        if (l->rays.high[i] == -INFINITY)
            continue;
        const vmask lane = spux_mask_from_bits(1u << (i - first)), none = spux_mask_none();
        light_store_hits(&t->committed_scene->prims, l, first, prim[pairs->capsule[k]], certain & bit ? lane : none,
                         certain & bit ? none : lane, t->counts);
        light_update_group(t, group);
    }
}

/* Tests the first pairs, a vector of them at most. */
CGT_SPU_INLINE void light_test_pairs(light_tile *t, const light_capsules *s, const light_pairs *pairs,
                                     const uint32_t *prim)
{
    const unsigned lanes = first_lanes(pairs->count);
    const vuint capsule = spux_load_uint(pairs->capsule);
    vfloat real[LIGHT_PAIR_REALS], d[7];
    vmask certain_hit, undecided;
    for (int a = 0; a < LIGHT_PAIR_REALS; a++)
        real[a] = spux_load(pairs->real[a]);
    for (int a = 0; a < 7; a++)
        d[a] = spux_permute(spux_load(s->d[a]), capsule);
    if (light_test_capsule_lanes(real, d, &certain_hit, &undecided))
        light_store_pairs(t, pairs, prim, spux_mask_bits(certain_hit) & lanes, spux_mask_bits(undecided) & lanes);
}

/* Lanes that no pair has filled yet are zeros. */
CGT_SPU_INLINE void light_begin_pairs(light_pairs *pairs)
{
    pairs->count = 0;
    for (int a = 0; a < LIGHT_PAIR_REALS; a++)
        spux_store(pairs->real[a], spux_vfloat(0));
    spux_store_uint(pairs->capsule, spux_vuint(0));
}

/* Lists the open rays of a group that come near to capsule k, and tests a vector of pairs once it is full. */
CGT_SPU_INLINE void light_add_pairs(light_tile *t, const light_capsules *s, uint32_t k, uint32_t group,
                                    const uint32_t *prim, light_pairs *pairs)
{
    const light_packet *l = &t->packet[group / LIGHT_PACKET_GROUPS];
    const uint32_t i = group % LIGHT_PACKET_GROUPS * CGT_LANES, end = pairs->count;
    vfloat real[LIGHT_PAIR_REALS];
    light_load_rays(l, i, real);
    const vmask open = spu_cmpgt(spux_load(l->rays.high + i), spux_vfloat(-INFINITY));
    const vmask near = spu_and(light_meets_strip(real, s, k), open);
    if (spux_none(near))
        return;
    for (int a = 0; a < LIGHT_PAIR_REALS; a++)
        spux_store_unaligned(pairs->real[a] + end, spux_compress(real[a], near));
    const vuint number = spu_add(spux_lane_index(), spux_vuint(group * CGT_LANES));
    spux_store_unaligned_uint(pairs->ray + end, spux_compress(number, near));
    spux_store_unaligned_uint(pairs->capsule + end, spux_vuint(k));
    pairs->count += spux_count_bits(spux_mask_bits(near));
    if (pairs->count < CGT_LANES)
        return;
    light_test_pairs(t, s, pairs, prim);
    pairs->count -= CGT_LANES;
    for (int a = 0; a < LIGHT_PAIR_REALS; a++)
        spux_store(pairs->real[a], spux_load(pairs->real[a] + CGT_LANES));
    spux_store_uint(pairs->ray, spux_load_uint(pairs->ray + CGT_LANES));
    spux_store_uint(pairs->capsule, spux_load_uint(pairs->capsule + CGT_LANES));
}

/* Tests what does not fill a vector. */
CGT_SPU_INLINE void light_end_pairs(light_tile *t, const light_capsules *s, const uint32_t *prim, light_pairs *pairs)
{
    if (pairs->count)
        light_test_pairs(t, s, pairs, prim);
}

#endif
