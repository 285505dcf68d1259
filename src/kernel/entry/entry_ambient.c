/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The rays of ambient occlusion, a vector of pixels at a time: the operations of cgt_ambient_directions and
 * cgt_camera_pixel, in their order, and so the same bits in every variant. */
#include "dispatch/kernel.h"
#include "kernel/primitive/lane_vectors.h"
#include "query/ambient_directions.h"

/* A vector of pixels: where their rays begin, and the axes that directions are relative to. */
typedef struct ambient_lanes {
    vfloat org[3], n[3], across[2][3];
    vuint scramble[2];
} ambient_lanes;

/* The canonical rays of the camera. */
CGT_SPU_INLINE void ambient_camera_rays(const cgt_camera_rays *c, const cgt_ambient_pixels *p, uint32_t i,
                                        vfloat org[3], vfloat dir[3])
{
    const vfloat half = spux_vfloat(0.5f), one = spux_vfloat(1);
    const vfloat px = spu_sub(spu_mul(spu_add(spux_load_unaligned(p->x + i), half), spux_vfloat(c->pixel[0])), one);
    const vfloat py = spu_sub(one, spu_mul(spu_add(spux_load_unaligned(p->y + i), half), spux_vfloat(c->pixel[1])));
    for (int a = 0; a < 3; a++) {
        const vfloat from = spux_vfloat(c->orthographic ? c->eye[a] : c->fwd[a]);
        const vfloat sum =
            spu_add(spu_add(from, spu_mul(px, spux_vfloat(c->right[a]))), spu_mul(py, spux_vfloat(c->up[a])));
        org[a] = c->orthographic ? sum : spux_vfloat(c->eye[a]);
        dir[a] = c->orthographic ? spux_vfloat(c->fwd[a]) : sum;
    }
}

/* cgt_ambient_axes */
CGT_SPU_INLINE void ambient_axes(const vfloat n[3], vfloat across[2][3])
{
    const vfloat one = spux_vfloat(1), sign = spux_select(one, spux_vfloat(-1), spu_cmpgt(spux_vfloat(0), n[2]));
    const vfloat minus_sign = spu_sub(spux_vfloat(0), sign);
    const vfloat a = spux_div(spux_vfloat(-1), spu_add(sign, n[2])), b = spu_mul(spu_mul(n[0], n[1]), a);
    across[0][0] = spu_add(one, spu_mul(spu_mul(spu_mul(sign, n[0]), n[0]), a));
    across[0][1] = spu_mul(sign, b);
    across[0][2] = spu_mul(minus_sign, n[0]);
    across[1][0] = b;
    across[1][1] = spu_add(sign, spu_mul(spu_mul(n[1], n[1]), a));
    across[1][2] = spu_mul(n[1], spux_vfloat(-1));
}

/* Pixels i and on: the side of each surface that the camera sees. */
CGT_SPU_INLINE ambient_lanes ambient_load(const cgt_camera_rays *camera, const cgt_ambient_pixels *p, uint32_t i)
{
    vfloat eye[3], dir[3];
    ambient_lanes l;
    ambient_camera_rays(camera, p, i, eye, dir);
    for (int a = 0; a < 3; a++) {
        l.n[a] = spux_load_unaligned(p->normal[a] + i);
        l.org[a] = spu_add(eye[a], spu_mul(spux_load_unaligned(p->t + i), dir[a]));
    }
    const vmask away = spu_cmpgt(lane_dot_unfused(l.n, dir), spux_vfloat(0));
    for (int a = 0; a < 3; a++)
        l.n[a] = spux_select(l.n[a], spu_mul(l.n[a], spux_vfloat(-1)), away);
    ambient_axes(l.n, l.across);
    for (int k = 0; k < 2; k++)
        l.scramble[k] = spux_load_unaligned_uint(p->scramble[k] + i);
    return l;
}

/* cgt_ambient_centred */
CGT_SPU_INLINE vfloat ambient_centred(vuint x)
{
    const vfloat whole = spu_convtf((vint)spu_sr(x, 9), 0);
    return spu_sub(spu_mul(spu_add(whole, spux_vfloat(0.5f)), spux_vfloat(0x1p-22f)), spux_vfloat(1));
}

/* A polynomial in w, its coefficients from the highest power down to the first, and w times it. */
CGT_SPU_INLINE vfloat ambient_series(vfloat w, const float *coefficient, int count)
{
    vfloat sum = spux_vfloat(coefficient[0]);
    for (int k = 1; k < count; k++)
        sum = spu_add(spux_vfloat(coefficient[k]), spu_mul(w, sum));
    return sum;
}

/* One direction for each pixel: cgt_ambient_directions. */
CGT_SPU_INLINE void ambient_direction(const ambient_lanes *l, uint32_t first, uint32_t second, vfloat dir[3])
{
    static const float sine_of[] = {0.000000313361689f, -0.0000365762042f, 0.00249039457f, -0.0807455122f,
                                    0.785398163f};
    static const float cosine_of[] = {0.00000359086045f, -0.000325991887f, 0.0158543442f, -0.308425138f, 1};
    const vfloat p = ambient_centred(spu_xor(spux_vuint(first), l->scramble[0]));
    const vfloat q = ambient_centred(spu_xor(spux_vuint(second), l->scramble[1]));
    const vmask along_p = spu_cmpgt(spux_abs(p), spux_abs(q));
    const vfloat r = spux_select(q, p, along_p), share = spux_div(spux_select(p, q, along_p), r);
    const vfloat w = spu_mul(share, share), sine = spu_mul(share, ambient_series(w, sine_of, 5));
    const vfloat cosine = ambient_series(w, cosine_of, 5);
    const vfloat u = spu_mul(r, spux_select(sine, cosine, along_p));
    const vfloat v = spu_mul(r, spux_select(cosine, sine, along_p));
    const vfloat up = spux_sqrt(spu_sub(spux_vfloat(1), spu_mul(r, r)));
    for (int a = 0; a < 3; a++)
        dir[a] = spu_add(spu_add(spu_mul(u, l->across[0][a]), spu_mul(v, l->across[1][a])), spu_mul(up, l->n[a]));
}

void CGT_KERNEL(cgt_ambient_rays)(const cgt_camera_rays *camera, const cgt_ambient_pixels *pixels, uint32_t samples,
                                  const cgt_ambient_points *points, cgt_ambient_rays *rays)
{
    for (uint32_t i = 0; i < pixels->count; i += CGT_LANES) {
        const uint32_t count = pixels->count - i < CGT_LANES ? pixels->count - i : CGT_LANES;
        const ambient_lanes l = ambient_load(camera, pixels, i);
        const vuint primitive = spux_load_unaligned_uint(pixels->primitive + i);
        const vuint geometry = spux_load_unaligned_uint(pixels->geometry + i);
        uint32_t to = i * samples;
        /* whole vectors: what lies beyond the last pixel is overwritten by the next sample's rays */
        for (uint32_t k = 0; k < samples; k++, to += count) {
            vfloat dir[3];
            ambient_direction(&l, points->coordinate[0][k], points->coordinate[1][k], dir);
            for (int a = 0; a < 3; a++) {
                spux_store_unaligned(rays->org[a] + to, l.org[a]);
                spux_store_unaligned(rays->dir[a] + to, dir[a]);
            }
            spux_store_unaligned_uint(rays->primitive + to, primitive);
            spux_store_unaligned_uint(rays->geometry + to, geometry);
        }
    }
}
