/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Two more triangle tests for fast packets: that of Moeller and Trumbore, and the thesis' by projection. They decide
 * by comparisons with 0 and 1 in single precision, so rays may slip through a shared edge. */
#ifndef CGT_TRIANGLE_FAST_H
#define CGT_TRIANGLE_FAST_H

#include "papers/kernel/packet/accelerated_triangle.h"
#include "papers/kernel/packet/triangle_filter.h"

/* The common end: a hit if u, v and 1 - u - v are at least 0. */
CGT_SPU_INLINE bool triangle_test_end(const packet *p, uint32_t i, vuint prim, vfloat t, vfloat u, vfloat v,
                                      filter_result *f)
{
    const vfloat zero = spux_vfloat(0);
    const vmask inside =
        spu_and(spu_and(spux_cmpge(u, zero), spux_cmpge(v, zero)), spux_cmpge(spux_vfloat(1), spu_add(u, v)));
    f->low = f->high = t;
    f->u = u;
    f->v = v;
    f->certain_hit = spu_and(inside, filter_fast_closer(p, i, t, prim));
    f->undecided = spux_mask_none();
    return spux_any(f->certain_hit);
}

/* ---- Moeller and Trumbore ---- */

typedef struct moller_trumbore_triangle {
    vfloat v0[3], e1[3], e2[3];
    vuint prim;
} moller_trumbore_triangle;

CGT_SPU_INLINE moller_trumbore_triangle moller_trumbore_get(const filter_triangles *s, int k)
{
    moller_trumbore_triangle q = {.prim = spux_vuint(s->prim[k])};
    for (int a = 0; a < 3; a++) {
        q.v0[a] = spux_vfloat(s->vertex[0][a][k]);
        q.e1[a] = spux_vfloat(s->vertex[1][a][k] - s->vertex[0][a][k]);
        q.e2[a] = spux_vfloat(s->vertex[2][a][k] - s->vertex[0][a][k]);
    }
    return q;
}

CGT_SPU_INLINE bool moller_trumbore_rays(const packet *p, const void *primitive, uint32_t i, bool common_origin,
                                         filter_result *f)
{
    const moller_trumbore_triangle *q = primitive;
    vfloat d[3], s[3], h[3], g[3];
    (void)common_origin;
    for (int a = 0; a < 3; a++) {
        d[a] = spux_load(p->dir[a] + i);
        s[a] = spu_sub(spux_load(p->org[a] + i), q->v0[a]);
    }
    lane_cross(d, q->e2, h);
    const vfloat det = lane_dot(q->e1, h), r = spux_div(spux_vfloat(1), det);
    const vfloat u = spu_mul(lane_dot(s, h), r);
    lane_cross(s, q->e1, g);
    const vfloat v = spu_mul(lane_dot(d, g), r), t = spu_mul(lane_dot(q->e2, g), r);
    return triangle_test_end(p, i, q->prim, t, u, v, f);
}

/* ---- accelerated ---- */

typedef struct accelerated_triangle {
    cgt_accelerated_triangle triangle;
    vuint prim;
} accelerated_triangle;

CGT_SPU_INLINE accelerated_triangle accelerated_get(const filter_triangles *s, int k)
{
    cgt_triangle q;
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 3; a++)
            q.v[i][a] = s->vertex[i][a][k];
    return (accelerated_triangle){cgt_accelerated_triangle_init(&q), spux_vuint(s->prim[k])};
}

CGT_SPU_INLINE bool accelerated_rays(const packet *p, const void *primitive, uint32_t i, bool common_origin,
                                     filter_result *f)
{
    const accelerated_triangle *g = primitive;
    const cgt_accelerated_triangle *q = &g->triangle;
    const uint32_t k = q->k, ku = (k + 1) % 3, kv = (k + 2) % 3;
    const vfloat nu = spux_vfloat(q->nu), nv = spux_vfloat(q->nv);
    const vfloat ou = spux_load(p->org[ku] + i), ov = spux_load(p->org[kv] + i);
    const vfloat du = spux_load(p->dir[ku] + i), dv = spux_load(p->dir[kv] + i);
    (void)common_origin;
    const vfloat num =
        spu_sub(spu_sub(spux_vfloat(q->nw), spux_load(p->org[k] + i)), spu_madd(nu, ou, spu_mul(nv, ov)));
    const vfloat den = spu_madd(nu, du, spu_madd(nv, dv, spux_load(p->dir[k] + i)));
    const vfloat t = spu_mul(num, spux_div(spux_vfloat(1), den));
    const vfloat hu = spu_madd(t, du, ou), hv = spu_madd(t, dv, ov);
    const vfloat u = spu_madd(spux_vfloat(q->bnu), hu, spu_madd(spux_vfloat(q->bnv), hv, spux_vfloat(q->bd)));
    const vfloat v = spu_madd(spux_vfloat(q->cnu), hu, spu_madd(spux_vfloat(q->cnv), hv, spux_vfloat(q->cd)));
    return triangle_test_end(p, i, g->prim, t, u, v, f);
}

/* ---- the packet's choice ---- */

/* Expands to call(test, &q), with the test that the packet chooses and triangle k of a vector in its form. */
#define FILTER_WITH_TRIANGLE(p, of_packet, s, k, mode, call)                                                           \
    if ((mode).decides) {                                                                                              \
        const filter_triangle q = filter_triangle_get(of_packet, s, k, (mode).common_origin);                          \
        call(filter_triangle_rays, &q);                                                                                \
    } else if ((p)->triangle_test == CGT_TRIANGLE_TEST_MOLLER_TRUMBORE) {                                              \
        const moller_trumbore_triangle q = moller_trumbore_get(s, k);                                                  \
        call(moller_trumbore_rays, &q);                                                                                \
    } else if ((p)->triangle_test == CGT_TRIANGLE_TEST_ACCELERATED) {                                                  \
        const accelerated_triangle q = accelerated_get(s, k);                                                          \
        call(accelerated_rays, &q);                                                                                    \
    } else {                                                                                                           \
        const filter_triangle q = filter_triangle_get(of_packet, s, k, (mode).common_origin);                          \
        call(filter_triangle_rays_fast, &q);                                                                           \
    }

/* Tests triangle k of a vector against the packet's blocks that it may reach. */
CGT_SPU_INLINE void filter_test_triangle(const cgt_primitives *prims, packet *p, const filter_packet *of_packet,
                                         const filter_triangles *s, int k, block_cones *blocks, filter_mode mode,
                                         cgt_counts *counts)
{
    const uint32_t prim = s->prim[k];
    const float center[3] = {s->center[0][k], s->center[1][k], s->center[2][k]};
    const uint32_t reached = block_cones_test_sphere(blocks, center, s->radius[k], s->min_t[k]);
    if (!reached)
        return;
#define CALL(test, q) filter_blocks(prims, p, test, test, q, prim, reached, blocks, mode, counts)
    FILTER_WITH_TRIANGLE(p, of_packet, s, k, mode, CALL)
#undef CALL
}

#endif
