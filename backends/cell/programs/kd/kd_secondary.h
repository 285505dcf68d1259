/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shadow and ambient-occlusion rays (thesis, section 8.2), and reflected ones: made on the SPE right after the rays of
 * their envelope, from the middle of the hit's interval of t. They go to main memory while they are traced, and after
 * them a bit for each ray that meets something; reflected ones go a second time, with the nearest triangles.
 *
 * A batch is one ray of each pixel: to a light, its direction from the hit to the light; or ambient, one of 64
 * directions, on the side of the triangle that the pixel's ray came from; or the pixel's ray, reflected, as long as
 * that. Which ambient direction depends on pixel and batch, so neighbours look elsewhere. Rays are what these words
 * compute: the PPE reads them and decides doubts for them. A ray whose direction is so short or long that bounds end
 * (docs/reports/cell_sizes.md) is none: its bit is 0. */
#ifndef KD_SECONDARY_H
#define KD_SECONDARY_H

#include "cell/programs/kd/kd_envelopes.h"
#include "cell/programs/kd/kd_triangles.h"

#define MAX_DIRECTION 0x1p20f
#define MIN_DIRECTION 0x1p-20f
#define TINY_COMPONENT 0x1p-60f /* in place of smaller ones: 0, so that nothing underflows */
#define TINY_COORDINATE 0x1p-100f

static inline vfloat kd_without_tiny(vfloat x, float tiny)
{
    return spux_select(x, spux_vfloat(0), spu_cmpgt(spux_vfloat(tiny), spux_abs(x)));
}

/* The normals of four hits, of any length, towards the rays' origins; any where there is none. */
static void kd_normals(const cgt_kd_hit_tile *hit, const cgt_kd_ray_tile *ray, vfloat n[3])
{
    _Alignas(16) float e[2][3][4];
    for (uint32_t k = 0; k < 4; k++) {
        uint32_t slot = 0;
        if (hit->prim[k] != CGT_INVALID_ID) {
            kd_triangles_bring(&hit->prim[k], 1, &slot, 0);
            kd_triangles_wait();
        }
        const cgt_leaf_triangle *const t = kd_triangle(slot);
        for (uint32_t a = 0; a < 3; a++) {
            e[0][a][k] = t->edge[0][a];
            e[1][a][k] = t->edge[1][a];
        }
    }
    const vfloat p[3] = {spux_load(e[0][0]), spux_load(e[0][1]), spux_load(e[0][2])};
    const vfloat q[3] = {spux_load(e[1][0]), spux_load(e[1][1]), spux_load(e[1][2])};
    const vfloat d[3] = {spux_load(ray->dir[0]), spux_load(ray->dir[1]), spux_load(ray->dir[2])};
    lane_cross(p, q, n);
    const vmask away = spu_cmpgt(lane_dot(n, d), spux_vfloat(0));
    for (uint32_t a = 0; a < 3; a++)
        n[a] = spux_select(n[a], spu_sub(spux_vfloat(0), n[a]), away);
}

/* Directions of an ambient batch. */
static void kd_ambient_directions(const cgt_kd_hit_tile *hit, const cgt_kd_ray_tile *ray, uint32_t batch, vfloat d[3])
{
    _Alignas(16) float direction[3][4];
    vfloat n[3];
    for (uint32_t k = 0; k < 4; k++) {
        const uint32_t x = hit->info.x + k % 2, y = hit->info.y + k / 2;
        const float *const from = s()->direction[(x * 5 + y * 19 + batch * 27) % CGT_KD_DIRECTIONS];
        for (uint32_t a = 0; a < 3; a++)
            direction[a][k] = from[a];
    }
    for (uint32_t a = 0; a < 3; a++)
        d[a] = spux_load(direction[a]);
    kd_normals(hit, ray, n);
    const vmask below = spu_cmpgt(spux_vfloat(0), lane_dot(n, d));
    for (uint32_t a = 0; a < 3; a++)
        d[a] = spux_select(d[a], spu_sub(spux_vfloat(0), d[a]), below);
}

/* d - 2 (d n) / (n n) n */
static void kd_mirror_directions(const cgt_kd_hit_tile *hit, const cgt_kd_ray_tile *ray, vfloat d[3])
{
    vfloat n[3];
    for (uint32_t a = 0; a < 3; a++)
        d[a] = spux_load(ray->dir[a]);
    kd_normals(hit, ray, n);
    const vfloat along = spux_div(lane_dot(n, d), lane_dot(n, n)), twice = spu_add(along, along);
    for (uint32_t a = 0; a < 3; a++)
        d[a] = spu_nmsub(twice, n[a], d[a]);
}

static inline uint32_t kd_batches(void) { return s()->frame.lights + s()->frame.ambient + s()->frame.mirror; }
static inline bool kd_is_mirror(uint32_t batch) { return batch == s()->frame.lights + s()->frame.ambient; }

/* The rays of a tile. Returns how many there are. */
static uint32_t kd_make_tile(const cgt_kd_hit_tile *hit, const cgt_kd_ray_tile *ray, uint32_t batch,
                             cgt_kd_secondary_tile *to)
{
    const cgt_kd_frame_image *const f = &s()->frame;
    const vfloat t = spu_mul(spu_add(spux_load(hit->low), spux_load(hit->high)), spux_vfloat(0.5f));
    const vmask is_hit = spux_not(spu_cmpeq(spux_load_uint(hit->prim), spux_vuint(CGT_INVALID_ID)));
    vfloat org[3], d[3], most = spux_vfloat(0);
    for (uint32_t a = 0; a < 3; a++)
        org[a] = kd_without_tiny(spu_madd(t, spux_load(ray->dir[a]), spux_vfloat(ray->org[a])), TINY_COORDINATE);
    if (batch < f->lights)
        for (uint32_t a = 0; a < 3; a++)
            d[a] = spu_sub(spux_vfloat(f->light[batch][a]), org[a]);
    else if (kd_is_mirror(batch))
        kd_mirror_directions(hit, ray, d);
    else
        kd_ambient_directions(hit, ray, batch - f->lights, d);
    for (uint32_t a = 0; a < 3; a++) {
        d[a] = kd_without_tiny(d[a], TINY_COMPONENT);
        most = spux_max(most, spux_abs(d[a]));
    }
    const vmask usual =
        spu_and(spu_cmpgt(spux_vfloat(MAX_DIRECTION), most), spu_cmpgt(most, spux_vfloat(MIN_DIRECTION)));
    const vmask active = spu_and(spu_and(is_hit, kd_active(&hit->info)), usual);
    for (uint32_t a = 0; a < 3; a++) { /* what is no ray has some numbers */
        spux_store(to->dir[a], spux_select(spux_vfloat(1), d[a], active));
        spux_store(to->org[a], spux_select(spux_vfloat(0), org[a], active));
    }
    to->info = hit->info;
    to->info.id_or_active = spux_mask_bits(active);
    return spux_count_bits(to->info.id_or_active);
}

/* The packet of a batch. Those that are occluded already, as bits of each tile, take no part. */
static void kd_load_secondary(uint32_t batch, uint32_t buffer)
{
    const cgt_kd_frame_image *const f = &s()->frame;
    packet *const p = &s()->packet;
    const bool light = batch < f->lights, mirror = kd_is_mirror(batch);
    const vfloat t_min = spux_vfloat(light    ? f->light_t_min
                                     : mirror ? f->mirror_t_min
                                              : f->ambient_t_min),
                 t_max = spux_vfloat(light    ? 1
                                     : mirror ? f->mirror_t_max
                                              : f->ambient_t_max);
    p->lanes = 4 * kd_tiles();
    p->any_hit = !mirror;
    s()->tile = NULL;
    for (uint32_t i = 0; i < p->lanes; i += 4) {
        const cgt_kd_secondary_tile *const ray = &s()->secondary[buffer][i / 4];
        const vmask active = spux_mask_from_bits(ray->info.id_or_active & ~s()->occlusion[buffer][i / 4]);
        for (uint32_t a = 0; a < 3; a++) {
            spux_store(p->dir[a] + i, spux_load(ray->dir[a]));
            spux_store(p->org[a] + i, spux_load(ray->org[a]));
        }
        spux_store(p->t_min + i, t_min);
        spux_store(p->t_max + i, t_max);
        spux_store(p->low + i, spux_select(spux_vfloat(-INFINITY), t_max, active));
        spux_store(p->high + i, spux_select(spux_vfloat(-INFINITY), t_max, active));
        spux_store_uint(p->prim + i, spux_vuint(CGT_INVALID_ID));
    }
}

static void kd_add_occlusion(uint32_t buffer)
{
    const packet *const p = &s()->packet;
    for (uint32_t i = 0; i < p->lanes; i += 4) {
        const vmask none = spu_cmpeq(spux_load_uint(p->prim + i), spux_vuint(CGT_INVALID_ID));
        s()->occlusion[buffer][i / 4] |= spux_mask_bits(spux_not(none));
    }
}

/* Where a batch of an envelope lies: its first tile. */
static inline uint64_t kd_secondary_place(uint32_t envelope, uint32_t batch)
{
    return ((uint64_t)envelope * kd_batches() + batch) * kd_tiles();
}

static inline uint64_t kd_occlusion_ea(uint32_t envelope, uint32_t batch)
{
    return kd_ea(s()->control.occlusion) + ((uint64_t)envelope * kd_batches() + batch) * ((kd_tiles() + 3) / 4 * 16);
}

static inline uint64_t kd_secondary_ea(uint32_t envelope, uint32_t batch)
{
    return kd_ea(s()->control.secondary) + kd_secondary_place(envelope, batch) * sizeof(cgt_kd_secondary_tile);
}

/* Sends a batch's nearest triangles behind its rays. */
static void kd_put_nearest(uint32_t envelope, uint32_t batch, uint32_t buffer)
{
    const packet *const p = &s()->packet;
    kd_wait(1u << (TAG_SECONDARY0 + buffer)); /* the rays themselves */
    for (uint32_t i = 0; i < p->lanes; i += 4)
        spux_store_uint(s()->secondary[buffer][i / 4].prim, spux_load_uint(p->prim + i));
    mfc_put(s()->secondary[buffer], kd_secondary_ea(envelope, batch), kd_tiles() * sizeof(cgt_kd_secondary_tile),
            TAG_SECONDARY0 + buffer, 0, 0);
}

/* Makes a batch's rays and sends them, or fetches those and their bits that an earlier part left. */
static void kd_begin_batch(uint32_t envelope, uint32_t batch, uint32_t from, uint32_t buffer, bool make)
{
    const uint32_t tiles = kd_tiles(), tag = TAG_SECONDARY0 + buffer;
    const uint64_t ea = kd_secondary_ea(envelope, batch);
    const uint32_t bytes = tiles * sizeof(cgt_kd_secondary_tile);
    kd_wait(1u << tag);
    if (!make) {
        for (uint32_t at = 0; at < bytes; at += 16384)
            mfc_get((char *)s()->secondary[buffer] + at, ea + at, bytes - at < 16384 ? bytes - at : 16384, tag, 0, 0);
        mfc_get(s()->occlusion[buffer], kd_occlusion_ea(envelope, batch), (tiles + 3) / 4 * 16, tag, 0, 0);
        kd_wait(1u << tag);
        return;
    }
    memset(s()->occlusion[buffer], 0, sizeof s()->occlusion[buffer]);
    for (uint32_t k = 0; k < tiles; k++)
        s()->report.secondary +=
            kd_make_tile(&s()->hit[from][k], &s()->ray[from][k], batch, &s()->secondary[buffer][k]);
    mfc_put(s()->secondary[buffer], ea, bytes, tag, 0, 0);
}

#endif
