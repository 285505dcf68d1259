/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What a light sees of a chunk of points, and the order in which they go to groups. How well that goes changes no answer. */
#ifndef CGT_LIGHT_ORDER_H
#define CGT_LIGHT_ORDER_H

#include "kernel/light/light_points.h"

#define SORT_CELLS 32u /* along an edge of what the light sees of a chunk */
#define SORT_RUNS 4u   /* of a chunk, in turn: neighbours share cells, whose counters would wait for themselves */

_Static_assert(CGT_RAYS_CHUNK <= UINT16_MAX, "a chunk is counted in 16 bits");

/* Bits 0 to 7 to every second place. */
CGT_SPU_INLINE vuint spread_bits(vuint i)
{
    i = spu_and(spu_or(i, spu_sl(i, 4)), spux_vuint(0x0f0f));
    i = spu_and(spu_or(i, spu_sl(i, 2)), spux_vuint(0x3333));
    return spu_and(spu_or(i, spu_sl(i, 1)), spux_vuint(0x5555));
}

/* Where the light sees points, along two axes, in any unit: for orders and estimates, which change no answer. */
typedef struct light_view {
    bool place;
    uint32_t main;
    float reference[3], slope[2];
} light_view;

/* With the way of a chunk's middle point as the main one. */
static light_view view_make(const light_call *c, uint32_t count)
{
    light_view v = {.place = c->light.w == 1};
    float way[3];
    for (uint32_t a = 0; a < 3; a++) {
        const float o = ray_element(&c->source, c->source.rays->org[a], c->order.first + count / 2);
        way[a] = v.place ? o - c->light.position[a] : c->light.position[a];
        v.reference[a] = v.place ? c->light.position[a] : o;
        v.main = fabsf(way[a]) > fabsf(way[v.main]) ? a : v.main;
    }
    for (uint32_t a = 0; a < 2; a++)
        v.slope[a] = v.place ? 0 : way[(v.main + 1 + a) % 3] / way[v.main];
    return v;
}

CGT_SPU_INLINE void view_see(const light_view *v, const vfloat point[3], vfloat at[2])
{
    vfloat from[3];
    for (int a = 0; a < 3; a++)
        from[a] = spu_sub(point[a], spux_vfloat(v->reference[a]));
    const vfloat w = from[v->main], rw = v->place ? spux_div(spux_vfloat(1), w) : spux_vfloat(1);
    for (uint32_t a = 0; a < 2; a++)
        at[a] = spu_mul(spu_nmsub(spux_vfloat(v->slope[a]), w, from[(v->main + 1 + a) % 3]), rw);
}

/* Points k to k + CGT_LANES - 1 of a chunk; the last one again beyond its end. */
CGT_SPU_INLINE void chunk_load(const light_call *c, uint32_t k, uint32_t count, vfloat point[3])
{
    for (int a = 0; a < 3; a++) {
        const float *org = c->source.rays->org[a];
        _Alignas(CGT_VECTOR_BYTES) float o[CGT_LANES];
        if (c->source.stride == sizeof(float) && k + CGT_LANES <= count) {
            point[a] = spux_load_unaligned(org + c->order.first + k);
            continue;
        }
        for (uint32_t i = 0; i < CGT_LANES; i++)
            o[i] = ray_element(&c->source, org, c->order.first + (k + i < count ? k + i : count - 1));
        point[a] = spux_load(o);
    }
}

/* Points that the light sees side by side to the same groups, along a Morton curve. */
static void sort_points(const light_call *c, uint32_t count, uint32_t from[CGT_RAYS_CHUNK])
{
    _Alignas(64) float place[2][CGT_RAYS_CHUNK];
    _Alignas(64) uint32_t key[CGT_RAYS_CHUNK];
    uint16_t start[SORT_CELLS * SORT_CELLS][SORT_RUNS] = {{0}}, sum = 0;
    const uint32_t run = count / SORT_RUNS;
    const light_view view = view_make(c, count);
    vfloat least[2], most[2], scale[2];
    for (int a = 0; a < 2; a++) {
        least[a] = spux_vfloat(INFINITY);
        most[a] = spux_vfloat(-INFINITY);
    }
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vfloat point[3], at[2];
        chunk_load(c, k, count, point);
        view_see(&view, point, at);
        for (int a = 0; a < 2; a++) {
            spux_store(place[a] + k, at[a]);
            least[a] = spux_min(least[a], at[a]);
            most[a] = spux_max(most[a], at[a]);
        }
    }
    for (int a = 0; a < 2; a++) {
        const float first = spux_hmin(least[a]), length = spux_hmax(most[a]) - first;
        least[a] = spux_vfloat(first);
        scale[a] = spux_vfloat(length > 0 ? SORT_CELLS / length : 0);
    }
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        vuint cell[2];
        for (int a = 0; a < 2; a++) {
            const vfloat at = spu_mul(spu_sub(spux_load(place[a] + k), least[a]), scale[a]);
            cell[a] = (vuint)spu_convts(spux_min(spux_max(at, spux_vfloat(0)), spux_vfloat(SORT_CELLS - 1)), 0);
        }
        spux_store_uint(key + k, spu_and(spu_or(spread_bits(cell[0]), spu_sl(spread_bits(cell[1]), 1)),
                                         spux_vuint(SORT_CELLS * SORT_CELLS - 1)));
    }
    for (uint32_t i = 0; i < run; i++)
        for (uint32_t r = 0; r < SORT_RUNS; r++)
            start[key[r * run + i]][r]++;
    for (uint32_t k = run * SORT_RUNS; k < count; k++)
        start[key[k]][SORT_RUNS - 1]++;
    for (uint32_t k = 0; k < SORT_CELLS * SORT_CELLS; k++)
        for (uint32_t r = 0; r < SORT_RUNS; r++) {
            const uint16_t some = start[k][r];
            start[k][r] = sum;
            sum = (uint16_t)(sum + some);
        }
    for (uint32_t i = 0; i < run; i++) /* points of a cell keep their order: neighbours in the arrays lie together */
        for (uint32_t r = 0; r < SORT_RUNS; r++)
            from[start[key[r * run + i]][r]++] = r * run + i;
    for (uint32_t k = run * SORT_RUNS; k < count; k++)
        from[start[key[k]][SORT_RUNS - 1]++] = k;
}

/* Whether neighbours in the arrays are mostly far from each other, as far as some of them tell: a third of what the
 * light sees of their chunk. */
static bool is_scattered(const light_call *c, uint32_t count)
{
    const light_view view = view_make(c, count);
    float least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY}, sum = 0, all = 0;
    uint32_t groups = 0;
    for (uint32_t k = 0; k + CGT_LANES <= count; k += (count / 16 / CGT_LANES + 1) * CGT_LANES, groups++) {
        vfloat point[3], at[2];
        chunk_load(c, k, count, point);
        view_see(&view, point, at);
        for (int a = 0; a < 2; a++) {
            const float low = spux_hmin(at[a]), high = spux_hmax(at[a]);
            sum += high - low;
            least[a] = low < least[a] ? low : least[a];
            most[a] = larger(most[a], high);
        }
    }
    for (int a = 0; a < 2; a++)
        all += most[a] - least[a];
    return !(sum * 3 <= all * (float)groups);
}

#endif
