/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Capsules against a tile of points: windows of their boxes, then the test of lane_capsules.h with a ray in each lane.
 * Apart from light_grid.c, which inlines it, because most scenes have none. */
#ifndef CGT_LIGHT_CAPSULES_H
#define CGT_LIGHT_CAPSULES_H

#include "kernel/light/light_groups.h"
#include "kernel/primitive/lane_capsules.h"

/* Capsules of which box and window are known. */
typedef struct light_capsules {
    _Alignas(CGT_VECTOR_BYTES) float d[7][CGT_LANES]; /* the numbers of cgt_capsule */
    light_windows windows;
} light_capsules;

/* Returns the visible lanes, as bits. A middle is rounded once, a half extent twice, from differences below 2 M
 * (light_packet.h): 4 u M together, of which the margin of windows is a hundred times. */
CGT_SPU_INLINE unsigned light_project_capsules(const light_tile *t, const uint32_t *reference, uint32_t count,
                                               bool by_table, light_capsules *s)
{
    const vfloat share = spux_vfloat(0.5f);
    vfloat d[7], middle[3], half[3];
    gather_scene_capsules(&t->committed_scene->prims, reference, count, d);
    for (int k = 0; k < 7; k++)
        spux_store(s->d[k], d[k]);
    for (int a = 0; a < 3; a++) {
        middle[a] = spu_madd(d[a], share, spu_mul(d[3 + a], share));
        half[a] = spu_add(spux_abs(spu_msub(d[3 + a], share, spu_mul(d[a], share))), d[6]);
    }
    return light_project_boxes(t, middle, half, by_table, &s->windows) & first_lanes(count);
}

/* Capsule k against the rays i to i + CGT_LANES - 1 of a packet. */
CGT_SPU_INLINE void light_test_capsule(const cgt_committed_scene *committed_scene, light_packet *l,
                                       const light_capsules *s, uint32_t k, uint32_t i, uint32_t prim,
                                       cgt_counts *counts)
{
    packet *p = &l->rays;
    const vfloat t_max = spux_load(p->t_max + i);
    vfloat end[2][3];
    lane_rays r;
    lane_hits q;
    for (int a = 0; a < 3; a++) {
        end[0][a] = spux_vfloat(s->d[a][k]);
        end[1][a] = spux_vfloat(s->d[3 + a][k]);
    }
    spux_store(p->rdd + i, spux_div(spux_vfloat(1), spux_load(l->square + i)));
    lane_rays_of_packet(p, i, committed_scene->scale, &r);
    if (!lane_test_capsule(&r, end[0], end[1], spux_vfloat(s->d[6][k]), &q))
        return;
    const vmask open = spu_cmpgt(spux_load(p->high + i), spux_vfloat(-INFINITY));
    const vmask possible = spu_andc(spu_and(spu_or(q.certain_hit, q.undecided), open), spu_cmpgt(q.low, t_max));
    const vmask within = spu_or(spu_cmpgt(t_max, q.high), spu_cmpeq(t_max, spux_vfloat(INFINITY)));
    const vmask certain_hit = spu_and(spu_and(q.certain_hit, possible), within);
    if (spux_any(possible))
        light_store_hits(&committed_scene->prims, l, i, prim, certain_hit, spu_andc(possible, certain_hit), counts);
}

#endif
