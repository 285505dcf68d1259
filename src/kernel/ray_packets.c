/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays: neighbours become packets as they come; the traversal splits those whose rays run apart. */
#include "kernel.h"
#include "ray_box.h"

#define RAY_PACKET 64

typedef struct ray_source {
    const cgt_rays *rays;
    size_t stride;
} ray_source;

static float element(const ray_source *s, const float *array, uint64_t i)
{
    return *(const float *)(const void *)((const char *)array + i * s->stride);
}

/* The first two take part. */
typedef enum ray_state { RAY_OPEN, RAY_EXTREME, RAY_OUTSIDE, RAY_EMPTY_RANGE, RAY_INVALID } ray_state;

static ray_state read_ray(const ray_source *s, uint64_t i, packet *p, uint32_t k)
{
    const cgt_rays *r = s->rays;
    float zero = 0, largest = 0, longest = 0, dd = 0;
    for (int a = 0; a < 3; a++) {
        const float o = element(s, r->org[a], i), d = element(s, r->dir[a], i);
        p->org[a][k] = o;
        p->dir[a][k] = d;
        zero += o * 0 + d * 0; /* not a number where o or d is not finite */
        /* selections, not fmaxf: that is a call */
        largest = fabsf(o) > largest ? fabsf(o) : largest;
        longest = fabsf(d) > longest ? fabsf(d) : longest;
        dd += d * d;
    }
    const float t_min = r->t_min ? element(s, r->t_min, i) : 0, t_max = r->t_max ? element(s, r->t_max, i) : INFINITY;
    p->rdd[k] = 1 / dd;
    p->t_min[k] = t_min;
    p->t_max[k] = t_max;
    if (zero != 0 || longest == 0 || t_min != t_min || t_max != t_max)
        return RAY_INVALID;
    if (t_min > t_max)
        return RAY_EMPTY_RANGE;
    return largest > PACKET_LARGEST || longest > PACKET_LARGEST || longest < PACKET_SHORTEST ? RAY_EXTREME : RAY_OPEN;
}

/* A lane that takes no part repeats one that does, so that it widens no bound. */
static void close_lane(packet *p, uint32_t k, uint32_t good)
{
    for (int a = 0; a < 3; a++) {
        p->org[a][k] = p->org[a][good];
        p->dir[a][k] = p->dir[a][good];
    }
    p->rdd[k] = p->rdd[good];
    p->t_min[k] = p->t_min[good];
    p->t_max[k] = p->t_max[good];
    p->low[k] = p->high[k] = -INFINITY;
}

/* Rays that miss the bounds of all objects take no part. */
static void leave_out_outside(const cgt_world *world, const packet *p, uint32_t count, ray_state *state)
{
    for (uint32_t i = 0; i < count; i += CGT_LANES) {
        const unsigned missed = spux_mask_bits(ray_box_missed(p, i, world->low, world->high));
        for (uint32_t k = i; k < count && k < i + CGT_LANES; k++)
            if (state[k] == RAY_OPEN && missed >> (k - i) & 1)
                state[k] = RAY_OUTSIDE;
    }
}

/* The rays that take part, and the others made to repeat one of them. */
static void gather_packet(packet *p, uint32_t count, const ray_state *state)
{
    uint32_t good = 0;
    for (uint32_t k = 0; k < count; k++)
        if (state[k] <= RAY_EXTREME)
            good = k;
    p->rays = 0;
    p->common_origin = true;
    for (uint32_t k = 0; k < p->lanes; k++) {
        p->object[k] = CGT_NONE;
        if (k < count && state[k] <= RAY_EXTREME)
            p->low[k] = p->high[k] = p->t_max[k], p->rays++;
        else
            close_lane(p, k, good);
        for (int a = 0; a < 3; a++)
            p->common_origin &= p->org[a][k] == p->org[a][good];
    }
}

/* Reads rays first to first + count - 1. Returns false where one of several is extreme: read them apart then. */
static bool make_packet(const cgt_world *world, const ray_source *s, uint64_t first, uint32_t count, packet *p,
                        cgt_counts *counts)
{
    ray_state state[RAY_PACKET];
    uint32_t invalid = 0;
    p->lanes = (count + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
    p->from_origin = false;
    p->extreme = false;
    for (uint32_t k = 0; k < count; k++) {
        state[k] = read_ray(s, first + k, p, k);
        if (state[k] == RAY_EXTREME && count > 1)
            return false;
        if (state[k] == RAY_EXTREME)
            p->extreme = true;
        invalid += state[k] == RAY_INVALID;
    }
    if (!p->extreme && !world->everything) {
        for (uint32_t k = count; k < p->lanes; k++)
            close_lane(p, k, 0);
        leave_out_outside(world, p, count, state);
    }
    gather_packet(p, count, state);
    counts->invalid_rays += invalid;
    return true;
}

static void store_hits(const packet_hits *h, uint64_t first, uint32_t count, const cgt_hits *hits)
{
    const size_t stride = hits->stride ? hits->stride : sizeof(float);
    for (uint32_t k = 0; k < count; k++) {
        const size_t at = (size_t)(first + k) * stride;
        if (hits->t)
            memcpy((char *)hits->t + at, &h->t[k], sizeof(float));
        if (hits->primitive)
            memcpy((char *)hits->primitive + at, &h->primitive[k], sizeof(uint32_t));
        if (hits->geometry)
            memcpy((char *)hits->geometry + at, &h->geometry[k], sizeof(uint32_t));
        for (int a = 0; a < 3; a++)
            if (hits->normal[a])
                memcpy((char *)hits->normal[a] + at, &h->normal[a][k], sizeof(float));
        if (hits->u)
            memcpy((char *)hits->u + at, &h->u[k], sizeof(float));
        if (hits->v)
            memcpy((char *)hits->v + at, &h->v[k], sizeof(float));
    }
}

static void trace_range(const cgt_world *world, const ray_source *s, uint64_t first, uint32_t count,
                        const cgt_trace_settings *settings, const cgt_hits *hits, uint8_t *occluded, packet *p,
                        cgt_counts *counts)
{
    packet_hits h;
    if (!make_packet(world, s, first, count, p, counts)) {
        for (uint32_t k = 0; k < count; k++)
            trace_range(world, s, first + k, 1, settings, hits, occluded, p, counts);
        return;
    }
    CGT_KERNEL(cgt_packet_trace)(world, p, settings, counts);
    if (hits) {
        CGT_KERNEL(cgt_packet_resolve)(world, p, settings, &h, counts);
        store_hits(&h, first, count, hits);
        return;
    }
    for (uint32_t k = 0; k < count; k++) {
        occluded[first + k] = p->object[k] != CGT_NONE;
        counts->hits += p->object[k] != CGT_NONE;
    }
}

void CGT_KERNEL(cgt_trace_rays)(const cgt_world *world, const cgt_rays *rays, uint64_t first, uint64_t end,
                                const cgt_trace_settings *settings, const cgt_hits *hits, uint8_t *occluded,
                                cgt_counts *counts)
{
    packet p;
    const ray_source s = {rays, rays->stride ? rays->stride : sizeof(float)};
    p.any_hit = hits == NULL;
    p.fast = settings->precision == CGT_PRECISION_FAST;
    p.triangle_test = settings->triangle_test;
    counts->rays += end - first;
    for (uint64_t i = first; i < end; i += RAY_PACKET) {
        const uint32_t count = end - i < RAY_PACKET ? (uint32_t)(end - i) : RAY_PACKET;
        trace_range(world, &s, i, count, settings, hits, occluded, &p, counts);
    }
}
