/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points whose rays have the usual ranges, from arrays of their own to a packet of a tile in one pass: the rays, what tests
 * take of them, and the slopes of their groups. It finds what light_points_load, light_margin, light_ways and tile_groups
 * do one after the other. */
#ifndef CGT_LIGHT_READ_H
#define CGT_LIGHT_READ_H

#include "kernel/light/light_groups.h"

/* The axes and the reference of a tile's packet, by any ray of it: the first packet's. False where there is no common
 * way. */
static bool tile_orient(light_tile *t, light_packet *l, const float org[3], const float dir[3])
{
    const light_packet *first = &t->packet[0];
    if (t->packets) {
        for (int a = 0; a < 3; a++) {
            l->axis[a] = first->axis[a];
            l->reference[a] = first->reference[a];
        }
        l->sign = first->sign;
        return true;
    }
    if (!light_orient(&l->rays, org, dir, l))
        return false;
    for (int a = 0; a < 2; a++)
        t->slope[a] = t->place ? 0 : dir[l->axis[a + 1]] / (l->sign * dir[l->axis[0]]);
    return true;
}

/* Lane k gets the least of all lanes of vector k; and the greatest. */
CGT_SPU_INLINE vfloat least_of_each(vfloat v[CGT_LANES])
{
    for (uint32_t n = CGT_LANES / 2; n; n /= 2)
        for (uint32_t k = 0; k < n; k++) {
            vuint two[2] = {(vuint)v[2 * k], (vuint)v[2 * k + 1]};
            spux_unzip(two);
            v[k] = spux_min((vfloat)two[0], (vfloat)two[1]);
        }
    return v[0];
}
CGT_SPU_INLINE vfloat most_of_each(vfloat v[CGT_LANES])
{
    for (uint32_t n = CGT_LANES / 2; n; n /= 2)
        for (uint32_t k = 0; k < n; k++) {
            vuint two[2] = {(vuint)v[2 * k], (vuint)v[2 * k + 1]};
            spux_unzip(two);
            v[k] = spux_max((vfloat)two[0], (vfloat)two[1]);
        }
    return v[0];
}

/* What the light sees of a packet's rays: slopes or offsets, and w. */
typedef struct light_seen {
    _Alignas(CGT_VECTOR_BYTES) float at[2][PACKET_MAX_RAYS], w[PACKET_MAX_RAYS];
} light_seen;

CGT_SPU_INLINE void seen_load(const float *of, uint32_t lanes, vfloat v[CGT_LANES])
{
    for (uint32_t k = 0; k < CGT_LANES; k++)
        v[k] = spux_load(of + (k * CGT_LANES < lanes ? k * CGT_LANES : 0));
}

/* The groups of packet `number`, with as many lanes, all of them open: a vector of groups at a time. Those beyond the
 * packet's end get any numbers. */
CGT_SPU_INLINE void tile_groups_store(light_tile *t, uint32_t number, const light_seen *seen, uint32_t lanes,
                                      bool place)
{
    for (uint32_t i = 0; i < lanes; i += CGT_LANES * CGT_LANES) {
        const uint32_t group = number * PACKET_GROUPS + i / CGT_LANES;
        vfloat v[CGT_LANES];
        for (int a = 0; a < 2; a++) {
            seen_load(seen->at[a] + i, lanes - i, v);
            spux_store(t->low[a] + group, least_of_each(v));
            seen_load(seen->at[a] + i, lanes - i, v);
            spux_store(t->high[a] + group, most_of_each(v));
        }
        seen_load(seen->w + i, lanes - i, v);
        spux_store(t->end + group, place ? most_of_each(v) : spu_xor(least_of_each(v), spux_vfloat(-0.f)));
    }
}

/* Bounds of squares where what PACKET_LARGEST and PACKET_SHORTEST bound is surely within. */
#define LIGHT_LARGEST2 0x1p109f
#define LIGHT_SHORTEST2 0x1p-107f

CGT_SPU_INLINE bool tile_read_rays(const light_call *c, light_tile *t, light_packet *l, uint32_t first, uint32_t count,
                                   bool place)
{
    const cgt_world *world = c->world;
    const bool triangles = world->objects.triangles != 0;
    const vfloat end = spux_vfloat(place ? 1 : INFINITY), scale = spux_vfloat(world->scale);
    packet *p = &l->rays;
    vfloat reach[3] = {spux_vfloat(0), spux_vfloat(0), spux_vfloat(0)}, longest = reach[0], farthest = reach[0];
    vmask good = spux_mask_all();
    light_seen seen;
    for (uint32_t i = 0; i < count; i += CGT_LANES) {
        vfloat org[3], at[2], w, square = spux_vfloat(0), sum = square, size = square;
        for (int a = 0; a < 3; a++) {
            const vfloat light = spux_vfloat(c->light.position[a]);
            org[a] = light_points_get(&c->order, c->source.rays->org[a], first + i);
            const vfloat d = place ? spu_sub(light, org[a]) : light;
            const vfloat x = place ? d : spu_sub(org[a], spux_vfloat(l->reference[a]));
            square = spu_madd(d, d, square);
            size = spu_add(size, spux_abs(org[a]));
            reach[a] = spux_max(reach[a], spux_abs(org[a]));
            longest = spux_max(longest, spux_abs(x));
            sum = spu_add(sum, spux_abs(x));
            spux_store(p->org[a] + i, org[a]);
            spux_store(p->dir[a] + i, d);
            if (triangles)
                spux_store(l->way[a] + i, spu_mul(x, scale));
        }
        farthest = spux_max(farthest, sum);
        /* false where a number is none */
        good = spu_and(good, spux_cmpge(spux_vfloat(PACKET_LARGEST), size));
        good = spu_and(good, spux_cmpge(spux_vfloat(LIGHT_LARGEST2), square));
        good = spu_and(good, spux_cmpge(square, spux_vfloat(LIGHT_SHORTEST2)));
        good = spu_andc(good, see_slopes(t, l, org, &w, at));
        spux_store(l->square + i, square);
        spux_store(p->t_min + i, spux_vfloat(0));
        spux_store(p->t_max + i, end);
        spux_store(p->high + i, end);
        spux_store_uint(p->object + i, spux_vuint(CGT_INVALID_ID));
        spux_store(seen.w + i, w);
        for (int a = 0; a < 2; a++)
            spux_store(seen.at[a] + i, at[a]);
    }
    if (!spux_all(good))
        return false;
    p->lanes = p->rays = count;
    p->common_origin = p->from_origin = p->extreme = p->selective = p->masked = false;
    l->plain = true;
    l->open = UINT64_MAX >> (64 - count / CGT_LANES);
    l->longest = spux_hmax(longest) * world->scale; /* a power of two */
    l->farthest = spux_hmax(farthest) * world->scale;
    light_margin_of(world, reach, l);
    tile_groups_store(t, t->packets, &seen, count, place);
    return true;
}

/* The tile's next packet: points first to first + count - 1 of the order, whole vectors of light_points_dense without
 * ranges of their own. False where something about them is unusual. */
static bool tile_read(const light_call *c, light_tile *t, light_packet *l, uint32_t first, uint32_t count)
{
    const ray_source *source = &c->source;
    const uint64_t last = ray_at(&c->order, first + count - 1);
    float org[3], dir[3];
    l->rays.to_light = t->place;
    for (int a = 0; a < 3; a++) {
        org[a] = ray_element(source, source->rays->org[a], last);
        dir[a] = ray_direction(source, last, a, org[a]);
        l->rays.light[a] = c->light.position[a];
    }
    if (!tile_orient(t, l, org, dir))
        return false;
    return t->place ? tile_read_rays(c, t, l, first, count, true) : tile_read_rays(c, t, l, first, count, false);
}

#endif
