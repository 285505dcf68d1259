/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * t and normals of spheres in single precision, for tiles in FAST precision: twice the lanes of doubles. Which sphere is
 * hit was decided exactly. Lanes that would lose much are left to resolve_sphere_ray. Triangles are not worth it: what
 * they wait for is their vertices.
 *
 * With u = 2^-24, D = r^2 d.d - |c x d|^2 errs by about 2^3 u r |c| d.d at the silhouette: so t |d| is right to some u of the
 * distance in a sphere's middle, and to sqrt(2^3 u r |c|) at its edge. */
#ifndef CGT_RESOLVE_FAST_VECTORS_H
#define CGT_RESOLVE_FAST_VECTORS_H

#include "vector.h"

#define FAST_DOT(p, q) spu_madd((p)[0], (q)[0], spu_madd((p)[1], (q)[1], spu_mul((p)[2], (q)[2])))

CGT_SPU_INLINE void fast_cross(const vfloat p[3], const vfloat q[3], vfloat cross[3])
{
    for (int a = 0; a < 3; a++) {
        const int i = (a + 1) % 3, j = (a + 2) % 3;
        cross[a] = spu_sub(spu_mul(p[i], q[j]), spu_mul(p[j], q[i]));
    }
}

/* Returns the lanes whose sphere is hit from outside, where t_min lets them. A discriminant that rounding made negative is 0: the sphere is hit. */
CGT_SPU_INLINE vmask resolve_fast_spheres(const vfloat org[3], const vfloat dir[3], const vfloat sphere[4],
                                          vfloat t_min, bool normal, vfloat *t, vfloat n[3])
{
    const vfloat zero = spux_vfloat(0), r = sphere[3], rr = spu_mul(r, r);
    vfloat c[3], x[3];
    for (int a = 0; a < 3; a++)
        c[a] = spu_sub(sphere[a], org[a]);
    fast_cross(c, dir, x);
    const vfloat cc = FAST_DOT(c, c), middle = FAST_DOT(c, dir), product = spu_sub(cc, rr);
    const vfloat disc = spu_sub(spu_mul(rr, FAST_DOT(dir, dir)), FAST_DOT(x, x));
    const vfloat sum = spu_add(middle, spux_sqrt(spux_max(disc, zero)));
    *t = spux_div(product, sum);
    const vmask outside = spu_cmpgt(product, spu_mul(spu_add(cc, rr), spux_vfloat(0x1p-10f)));
    const vmask safe_lanes = spu_and(outside, spu_and(spu_cmpgt(middle, zero), spu_cmpgt(r, spux_vfloat(0x1p-56f))));
    if (normal) {
        const vfloat k = spux_div(spux_vfloat(1), r);
        for (int a = 0; a < 3; a++)
            n[a] = spu_mul(spu_sub(spu_mul(*t, dir[a]), c[a]), k);
    }
    return spu_and(spu_and(safe_lanes, spux_cmpge(*t, t_min)), spu_cmpgt(spux_vfloat(0x1p100f), spu_add(cc, rr)));
}

#undef FAST_DOT

#endif
