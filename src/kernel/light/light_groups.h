/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A tile of points against one light: 64 groups, a vector of rays each, with the slopes of each group's rays as the light
 * sees them; and the windows of objects, which tell the groups that may meet them.
 *
 * A window holds whatever a ray may meet: all numbers are widened by the frustum's margin, which is a share of 2^-17 of
 * the largest, where divisions here are within 2^-20. An object that reaches behind the light has no bounds in slopes: its
 * window is everything. */
#ifndef CGT_LIGHT_GROUPS_H
#define CGT_LIGHT_GROUPS_H

#include "kernel/light/light_leaf.h"
#include "kernel/tile/prefetch_queue.h"

#define GROUPS 64u
#define TILE_RAYS (GROUPS * CGT_LANES)
#define PACKETS (TILE_RAYS / PACKET_MAX_RAYS)
#define PACKET_GROUPS (PACKET_MAX_RAYS / CGT_LANES)

/* A tile. Of each group the least and the most slope along both axes, or offset; and w of its ray that is farthest from the
 * light, or the least one with its sign reversed where rays are parallel, so that what an object is compared with is its
 * end nearer to the light either way. A group that wants nothing any more has no slopes: infinity is their least. */
typedef struct light_tile {
    _Alignas(64) float low[2][GROUPS];
    float high[2][GROUPS], end[GROUPS];
    light_packet packet[PACKETS];
    uint32_t packets;
    uint64_t open;                /* groups as bits */
    uint64_t changed;             /* groups some of whose rays have met something since their slopes were found */
    uint32_t tested;              /* groups, since the slopes of all were found */
    float slope[2];               /* of parallel rays */
    float margin;                 /* of lines, so far apart from the numbers here along any axis */
    float least[2], most[2], far; /* of `low`, `high` and `end` */
    const cgt_world *world;
    cgt_counts *counts;
    bool place;
    waiting_lists waits;
} light_tile;

/* ---- objects ---- */

/* Groups whose slopes meet a window, as bits. */
CGT_SPU_INLINE uint64_t groups_met(const light_tile *t, const float low[2][CGT_LANES], const float high[2][CGT_LANES],
                                   const float near[CGT_LANES], uint32_t k)
{
    uint64_t met = 0;
    for (uint32_t g = 0; g < GROUPS; g += CGT_LANES) {
        vmask in = spux_cmpge(spux_load(t->end + g), spux_vfloat(near[k]));
        for (int a = 0; a < 2; a++) {
            in = spu_and(in, spux_cmpge(spux_vfloat(high[a][k]), spux_load(t->low[a] + g)));
            in = spu_and(in, spux_cmpge(spux_load(t->high[a] + g), spux_vfloat(low[a][k])));
        }
        met |= (uint64_t)spux_mask_bits(in) << g;
    }
    return met & t->open;
}

/* Groups without rays. */
CGT_SPU_INLINE void close_group(light_tile *t, uint32_t group)
{
    for (int a = 0; a < 2; a++) {
        t->low[a][group] = INFINITY;
        t->high[a][group] = -INFINITY;
    }
    t->end[group] = -INFINITY;
    t->open &= ~((uint64_t)1 << group);
}

/* After a test that may have closed rays of a group. */
CGT_SPU_INLINE void settle(light_tile *t, uint32_t group)
{
    t->changed |= (uint64_t)1 << group;
    if (!(t->packet[group / PACKET_GROUPS].open >> group % PACKET_GROUPS & 1))
        close_group(t, group);
}

/* Windows of a vector of objects. */
typedef struct light_windows {
    _Alignas(CGT_VECTOR_BYTES) float low[2][CGT_LANES], high[2][CGT_LANES];
    float near[CGT_LANES]; /* the end nearer to the light */
} light_windows;

/* Objects of which the tile may want something, as bits. near, far: their ends along w. */
CGT_SPU_INLINE unsigned windows_wanted(const light_tile *t, const vfloat low[2], const vfloat high[2], vfloat near,
                                       vfloat far, light_windows *w)
{
    const vfloat end = t->place ? near : spu_xor(far, spux_vfloat(-0.f)), zero = spux_vfloat(0);
    vmask out = spu_cmpgt(end, spux_vfloat(t->far));
    if (t->place)
        out = spu_or(out, spu_cmpgt(zero, far));
    const vmask front = t->place ? spu_cmpgt(near, zero) : spux_mask_all();
    for (int a = 0; a < 2; a++) {
        const vfloat l = spux_select(spux_vfloat(-INFINITY), low[a], front);
        const vfloat h = spux_select(spux_vfloat(INFINITY), high[a], front);
        out = spu_or(out, spu_or(spu_cmpgt(l, spux_vfloat(t->most[a])), spu_cmpgt(spux_vfloat(t->least[a]), h)));
        spux_store(w->low[a], l);
        spux_store(w->high[a], h);
    }
    spux_store(w->near, end);
    return ~spux_mask_bits(out) & CGT_ALL_LANES;
}

/* A point as the light sees it. */
CGT_SPU_INLINE void see_point(const light_packet *l, const vfloat point[3], vfloat *w, vfloat v[2])
{
    const int main = l->axis[0];
    *w = spu_mul(spu_sub(point[main], spux_vfloat(l->reference[main])), spux_vfloat(l->sign));
    for (int a = 0; a < 2; a++)
        v[a] = spu_sub(point[l->axis[a + 1]], spux_vfloat(l->reference[l->axis[a + 1]]));
}

/* Whatever lies within `half` of a middle along each axis. */
CGT_SPU_INLINE unsigned see_boxes(const light_tile *t, const vfloat middle[3], const vfloat half[3],
                                  light_windows *windows)
{
    const light_packet *l = &t->packet[0];
    vfloat w, v[2], low[2], high[2], wide[3];
    see_point(l, middle, &w, v);
    for (int k = 0; k < 3; k++)
        wide[k] = spu_madd(half[l->axis[k]], spux_vfloat(1 + 0x1p-20f), spux_vfloat(t->margin));
    const vfloat near = spu_sub(w, wide[0]), far = spu_add(w, wide[0]), one = spux_vfloat(1);
    const vfloat rnear = spux_div(one, near), rfar = spux_div(one, far);
    for (int a = 0; a < 2; a++) {
        if (t->place) {
            const vfloat least = spu_sub(v[a], wide[a + 1]), most = spu_add(v[a], wide[a + 1]);
            low[a] = spux_min(spu_mul(least, rnear), spu_mul(least, rfar));
            high[a] = spux_max(spu_mul(most, rnear), spu_mul(most, rfar));
        } else {
            const vfloat at = spu_nmsub(spux_vfloat(t->slope[a]), w, v[a]);
            const vfloat beside = spu_madd(wide[0], spux_vfloat(fabsf(t->slope[a])), wide[a + 1]);
            low[a] = spu_sub(at, beside);
            high[a] = spu_add(at, beside);
        }
    }
    return windows_wanted(t, low, high, near, far, windows);
}

CGT_SPU_INLINE unsigned see_spheres(const light_tile *t, const wide_spheres *s, light_windows *windows)
{
    const vfloat center[3] = {spux_load(s->center[0]), spux_load(s->center[1]), spux_load(s->center[2])};
    const vfloat radius = spux_load(s->radius), half[3] = {radius, radius, radius};
    return see_boxes(t, center, half, windows);
}

CGT_SPU_INLINE unsigned see_triangles(const light_tile *t, vfloat vertex[3][3], light_windows *windows)
{
    const vfloat margin = spux_vfloat(t->margin);
    vfloat w[3], v[3][2], low[2], high[2];
    for (int k = 0; k < 3; k++)
        see_point(&t->packet[0], vertex[k], &w[k], v[k]);
    const vfloat near = spu_sub(spux_min(w[0], spux_min(w[1], w[2])), margin);
    const vfloat far = spu_add(spux_max(w[0], spux_max(w[1], w[2])), margin);
    vfloat scale[3], beside = margin; /* what a margin comes to in slopes, but for their own size */
    for (int k = 0; k < 3; k++)
        scale[k] = t->place ? spux_div(spux_vfloat(1), w[k]) : spux_vfloat(1);
    if (t->place)
        beside = spux_div(spux_vfloat(2 * t->margin), near);
    for (int a = 0; a < 2; a++) {
        vfloat at[3];
        for (int k = 0; k < 3; k++)
            at[k] = t->place ? spu_mul(v[k][a], scale[k]) : spu_nmsub(spux_vfloat(t->slope[a]), w[k], v[k][a]);
        const vfloat least = spux_min(at[0], spux_min(at[1], at[2])), most = spux_max(at[0], spux_max(at[1], at[2]));
        const vfloat size = spux_max(spux_abs(least), spux_abs(most));
        const vfloat wide =
            t->place ? spu_madd(beside, size, beside) : spu_mul(margin, spux_vfloat(1 + fabsf(t->slope[a])));
        low[a] = spu_sub(least, wide);
        high[a] = spu_add(most, wide);
    }
    return windows_wanted(t, low, high, near, far, windows);
}

/* ---- slopes ---- */

/* Slopes or offsets of rays from points, and w. Returns the lanes that have too many directions to the light. */
CGT_SPU_INLINE vmask see_slopes(const light_tile *t, const light_packet *l, const vfloat org[3], vfloat *w,
                                vfloat at[2])
{
    vmask wild = spux_mask_none();
    vfloat v[2];
    see_point(l, org, w, v);
    const vfloat rw = t->place ? spux_div(spux_vfloat(1), *w) : spux_vfloat(1);
    if (t->place)
        wild = spux_not(spu_cmpgt(*w, spux_vfloat(0)));
    for (int a = 0; a < 2; a++) {
        at[a] = t->place ? spu_mul(v[a], rw) : spu_nmsub(spux_vfloat(t->slope[a]), *w, v[a]);
        if (t->place)
            wild = spu_or(wild, spux_not(spu_cmpgt(spux_vfloat(LIGHT_STEEPEST), spux_abs(at[a]))));
    }
    return wild;
}

/* Slopes of a group, of the rays that have met nothing. Returns the lanes that have too many. */
CGT_SPU_INLINE vmask group_find(light_tile *t, uint32_t group)
{
    const light_packet *l = &t->packet[group / PACKET_GROUPS];
    const packet *p = &l->rays;
    const uint32_t i = group % PACKET_GROUPS * CGT_LANES;
    const vmask open = spu_cmpgt(spux_load(p->high + i), spux_vfloat(-INFINITY));
    const vfloat none = spux_vfloat(INFINITY), minus = spux_vfloat(-INFINITY);
    vfloat org[3], w, at[2];
    for (int a = 0; a < 3; a++)
        org[a] = spux_load(p->org[a] + i);
    const vmask wild = see_slopes(t, l, org, &w, at);
    for (int a = 0; a < 2; a++) {
        t->low[a][group] = spux_hmin(spux_select(none, at[a], open));
        t->high[a][group] = spux_hmax(spux_select(minus, at[a], open));
    }
    t->end[group] = t->place ? spux_hmax(spux_select(minus, w, open)) : -spux_hmin(spux_select(none, w, open));
    return wild;
}

/* The groups of a packet. False where rays leave too many directions to the light. */
static bool tile_groups(light_tile *t, uint32_t number)
{
    vmask wild = spux_mask_none();
    for (uint32_t i = 0; i < t->packet[number].rays.lanes; i += CGT_LANES)
        wild = spu_or(wild, group_find(t, number * PACKET_GROUPS + i / CGT_LANES));
    return spux_none(wild);
}

/* What all groups have in common. */
static void tile_bounds_make(light_tile *t)
{
    vfloat far = spux_vfloat(-INFINITY);
    for (uint32_t g = 0; g < GROUPS; g += CGT_LANES)
        far = spux_max(far, spux_load(t->end + g));
    t->far = spux_hmax(far);
    for (int a = 0; a < 2; a++) {
        vfloat least = spux_vfloat(INFINITY), most = spux_vfloat(-INFINITY);
        for (uint32_t g = 0; g < GROUPS; g += CGT_LANES) {
            least = spux_min(least, spux_load(t->low[a] + g));
            most = spux_max(most, spux_load(t->high[a] + g));
        }
        t->least[a] = spux_hmin(least);
        t->most[a] = spux_hmax(most);
    }
}

/* Slopes of those rays alone that still want something. */
static void tile_refresh(light_tile *t)
{
    for (uint64_t left = t->changed & t->open; left; left &= left - 1)
        group_find(t, (uint32_t)__builtin_ctzll(left));
    t->changed = 0;
    t->tested = 0;
    tile_bounds_make(t);
}

#endif
