/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres as Embree's user geometry, as fast as possible: the rays of a packet by vectors. Point of the line closest to
 * the centre first, then half the chord (Haines, Guenther, Akenine-Moeller, "Precision improvements for ray/sphere
 * intersection", 2019), as Embree's own spheres do. */
#include "ways/embree.h"
#include "vector.h"

#include <math.h>

#define NAME(name, variant) NAME_(name, variant)
#define NAME_(name, variant) name##_##variant

/* What Embree passes to both callbacks: words of N rays, and of their hits in closest-hit queries. */
typedef struct call {
    float *words;
    const int *valid;
    const float *sphere; /* x, y, z, r */
    size_t rays;
    unsigned int geometry, primitive;
    int nearest;
} call;

/* Rays i to i + CGT_LANES - 1; sphere: x, y, z, r in all lanes. */
CGT_SPU_INLINE void meet_rays(const call *c, const vfloat sphere[4], size_t i)
{
    const size_t n = c->rays;
    float *ray = c->words + i;
    vfloat org[3], dir[3], off[3];
    vfloat dd = spux_vfloat(0.0f), dc = dd, apart = dd;
    for (size_t k = 0; k < 3; k++) {
        org[k] = spux_load_unaligned(ray + (EMBREE_ORG + k) * n);
        dir[k] = spux_load_unaligned(ray + (EMBREE_DIR + k) * n);
        off[k] = spu_sub(sphere[k], org[k]);
        dd = spu_madd(dir[k], dir[k], dd);
        dc = spu_madd(dir[k], off[k], dc);
    }
    const vfloat inverse = spux_div(spux_vfloat(1.0f), dd), middle = spu_mul(dc, inverse);
    for (size_t k = 0; k < 3; k++) {
        const vfloat p = spu_nmsub(middle, dir[k], off[k]);
        apart = spu_madd(p, p, apart);
    }
    const vfloat chord = spu_sub(spu_mul(sphere[3], sphere[3]), apart);
    const vfloat half = spux_sqrt(spu_mul(spux_max(chord, spux_vfloat(0.0f)), inverse));
    const vfloat begin = spux_load_unaligned(ray + EMBREE_NEAR * n), end = spux_load_unaligned(ray + EMBREE_FAR * n);
    const vfloat first = spu_sub(middle, half);
    const vfloat t = spux_select(spu_add(middle, half), first, spu_cmpgt(first, begin));
    const vuint valid = spux_load_unaligned_uint((const uint32_t *)c->valid + i);
    vmask hit = spu_and(spux_cmpge(chord, spux_vfloat(0.0f)), spu_cmpgt(t, begin));
    hit = spu_and(hit, spu_and(spu_cmpgt(end, t), spux_not(spu_cmpeq(valid, spux_vuint(0)))));
    if (spux_none(hit))
        return;
    spux_store_mask(ray + EMBREE_FAR * n, c->nearest ? t : spux_vfloat(-INFINITY), hit);
    if (!c->nearest)
        return;
    spux_store_mask_uint((uint32_t *)ray + EMBREE_PRIMITIVE * n, spux_vuint(c->primitive), hit);
    spux_store_mask_uint((uint32_t *)ray + EMBREE_GEOMETRY * n, spux_vuint(c->geometry), hit);
    for (size_t k = 0; k < 3; k++)
        spux_store_mask(ray + (EMBREE_NORMAL + k) * n, spu_nmsub(spux_vfloat(1.0f), off[k], spu_mul(t, dir[k])), hit);
}

/* One ray, for packets smaller than a vector. */
static void meet_ray(const call *c, size_t i)
{
    const size_t n = c->rays;
    float *ray = c->words + i;
    float off[3], dd = 0.0f, dc = 0.0f, apart = 0.0f;
    for (size_t k = 0; k < 3; k++) {
        const float d = ray[(EMBREE_DIR + k) * n];
        off[k] = c->sphere[k] - ray[(EMBREE_ORG + k) * n];
        dd += d * d;
        dc += d * off[k];
    }
    const float inverse = 1.0f / dd, middle = dc * inverse;
    for (size_t k = 0; k < 3; k++) {
        const float p = off[k] - middle * ray[(EMBREE_DIR + k) * n];
        apart += p * p;
    }
    const float chord = c->sphere[3] * c->sphere[3] - apart;
    if (!(chord >= 0.0f))
        return;
    const float half = sqrtf(chord * inverse), begin = ray[EMBREE_NEAR * n];
    const float t = middle - half > begin ? middle - half : middle + half;
    if (!(t > begin && t < ray[EMBREE_FAR * n]))
        return;
    ray[EMBREE_FAR * n] = c->nearest ? t : -INFINITY;
    if (!c->nearest)
        return;
    ((uint32_t *)ray)[EMBREE_PRIMITIVE * n] = c->primitive;
    ((uint32_t *)ray)[EMBREE_GEOMETRY * n] = c->geometry;
    for (size_t k = 0; k < 3; k++)
        ray[(EMBREE_NORMAL + k) * n] = t * ray[(EMBREE_DIR + k) * n] - off[k];
}

CGT_SPU_INLINE void meet_all(const call *c)
{
    if (c->rays % CGT_LANES) {
        for (size_t i = 0; i < c->rays; i++)
            if (c->valid[i])
                meet_ray(c, i);
        return;
    }
    const vfloat all[4] = {spux_vfloat(c->sphere[0]), spux_vfloat(c->sphere[1]), spux_vfloat(c->sphere[2]),
                           spux_vfloat(c->sphere[3])};
    for (size_t i = 0; i < c->rays; i += CGT_LANES)
        meet_rays(c, all, i);
}

void NAME(embree_sphere_intersect, CGT_VARIANT)(const struct RTCIntersectFunctionNArguments *a)
{
    const call c = {.words = (float *)a->rayhit,
                    .valid = a->valid,
                    .sphere = (const float *)a->geometryUserPtr + 4 * (size_t)a->primID,
                    .rays = a->N,
                    .geometry = a->geomID,
                    .primitive = a->primID,
                    .nearest = 1};
    meet_all(&c);
}

void NAME(embree_sphere_occluded, CGT_VARIANT)(const struct RTCOccludedFunctionNArguments *a)
{
    const call c = {.words = (float *)a->ray,
                    .valid = a->valid,
                    .sphere = (const float *)a->geometryUserPtr + 4 * (size_t)a->primID,
                    .rays = a->N};
    meet_all(&c);
}
