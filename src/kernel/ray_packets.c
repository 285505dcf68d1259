/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays. Through a grid, neighbours become packets as they come, and the traversal splits those whose rays run
 * apart. Through a tree, packets are made of neighbours among the rays of like direction. */
#include <float.h>

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

/* Rays in the order in which packets take them: `from` of the array's, counted from its `first`. */
typedef struct ray_order {
    uint64_t first;
    const uint32_t *from; /* NULL: as they come */
} ray_order;

static uint64_t ray_at(const ray_order *o, uint32_t i) { return o->first + (o->from ? o->from[i] : i); }

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
    /* a t of minus infinity is no hit: where a sphere's first root is one, its second may still be a hit */
    p->t_min[k] = t_min < -FLT_MAX ? -FLT_MAX : t_min;
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

/* Reads rays first to first + count - 1 of the order. Returns false where one of several is extreme: read them apart
 * then. */
static bool make_packet(const cgt_world *world, const ray_source *s, const ray_order *order, uint32_t first,
                        uint32_t count, packet *p, cgt_counts *counts)
{
    ray_state state[RAY_PACKET];
    uint32_t invalid = 0;
    p->lanes = (count + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
    p->from_origin = false;
    p->extreme = false;
    for (uint32_t k = 0; k < count; k++) {
        state[k] = read_ray(s, ray_at(order, first + k), p, k);
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

static void store_hits(const packet_hits *h, const ray_order *order, uint32_t first, uint32_t count,
                       const cgt_hits *hits)
{
    const size_t stride = hits->stride ? hits->stride : sizeof(float);
    for (uint32_t k = 0; k < count; k++) {
        const size_t at = (size_t)ray_at(order, first + k) * stride;
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

/* The call, as all its packets see it. */
typedef struct rays_call {
    const cgt_world *world;
    ray_source source;
    const cgt_trace_settings *settings;
    const cgt_hits *hits;
    uint8_t *occluded;
    cgt_counts *counts;
} rays_call;

static void trace_range(const rays_call *c, const ray_order *order, uint32_t first, uint32_t count, packet *p)
{
    packet_hits h;
    if (!make_packet(c->world, &c->source, order, first, count, p, c->counts)) {
        for (uint32_t k = 0; k < count; k++)
            trace_range(c, order, first + k, 1, p);
        return;
    }
    CGT_KERNEL(cgt_packet_trace)(c->world, p, c->settings, c->counts);
    if (c->hits) {
        CGT_KERNEL(cgt_packet_resolve)(c->world, p, c->settings, &h, c->counts);
        store_hits(&h, order, first, count, c->hits);
        return;
    }
    for (uint32_t k = 0; k < count; k++) {
        c->occluded[ray_at(order, first + k)] = p->object[k] != CGT_NONE;
        c->counts->hits += p->object[k] != CGT_NONE;
    }
}

/* ---- rays of like direction together ---- */

#define DIRECTIONS 8u /* octants */

static uint32_t direction_of(const ray_source *s, uint64_t i)
{
    const float x = element(s, s->rays->dir[0], i), y = element(s, s->rays->dir[1], i),
                z = element(s, s->rays->dir[2], i);
    return (uint32_t)(x < 0) | (uint32_t)(y < 0) << 1 | (uint32_t)(z < 0) << 2;
}

/* A counting sort by direction: rays of one keep their order. Returns whether there are several. */
static bool order_rays(const ray_source *s, uint64_t first, uint32_t count, uint32_t *from)
{
    uint8_t direction[CGT_RAYS_CHUNK];
    uint32_t start[DIRECTIONS + 1] = {0}, directions = 0;
    for (uint32_t i = 0; i < count; i++) {
        direction[i] = (uint8_t)direction_of(s, first + i);
        start[direction[i] + 1]++;
    }
    for (uint32_t d = 0; d < DIRECTIONS; d++) {
        directions += start[d + 1] != 0;
        start[d + 1] += start[d];
    }
    if (directions < 2)
        return false;
    for (uint32_t i = 0; i < count; i++)
        from[start[direction[i]]++] = i;
    return true;
}

void CGT_KERNEL(cgt_trace_rays)(const cgt_world *world, const cgt_rays *rays, uint64_t first, uint64_t end,
                                const cgt_trace_settings *settings, const cgt_hits *hits, uint8_t *occluded,
                                cgt_counts *counts)
{
    packet p;
    uint32_t from[CGT_RAYS_CHUNK];
    const rays_call c = {.world = world,
                         .source = {rays, rays->stride ? rays->stride : sizeof(float)},
                         .settings = settings,
                         .hits = hits,
                         .occluded = occluded,
                         .counts = counts};
    const uint32_t count = (uint32_t)(end - first);
    const bool tree = world->structure == CGT_STRUCTURE_KD || world->structure == CGT_STRUCTURE_KD_ROPES;
    const ray_order order = {first, tree && order_rays(&c.source, first, count, from) ? from : NULL};
    p.any_hit = hits == NULL;
    p.fast = settings->precision == CGT_PRECISION_FAST;
    p.triangle_test = settings->triangle_test;
    counts->rays += count;
    for (uint32_t i = 0; i < count; i += RAY_PACKET)
        trace_range(&c, &order, i, count - i < RAY_PACKET ? count - i : RAY_PACKET, &p);
}
