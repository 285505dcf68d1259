/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays in flight: single rays (bvh_single.h), some tens of which take turns, a step each: first those that are at a
 * node, then those at a leaf. The steps of one ray wait for each other, and its branches are foretold wrong; steps of
 * different rays overlap, and to which list a ray goes next is no branch. A call's rays, too few for a stream to fill its
 * lanes, go this way. Each ray has a small stack; one that needs more goes on alone. */
#ifndef CGT_WIDE_FLIGHT_H
#define CGT_WIDE_FLIGHT_H

#include "kernel/stream/stream.h"

#define FLIGHTS 32u
#define FLIGHT_STACK 64u
#ifndef FLIGHT_STACK_USED /* a test makes it as small as it may be */
#define FLIGHT_STACK_USED FLIGHT_STACK
#endif

typedef struct flight {
    wide_ray ray;
    uint32_t at;       /* its record */
    uint32_t code;     /* where it is; CGT_WIDE_NONE: at its end */
    uint32_t enter[3]; /* bytes from a node to the planes that the ray meets first along each axis, and to the others */
    uint32_t leave[3];
    uint32_t top;
    uint32_t stack[FLIGHT_STACK + CGT_LANES]; /* CGT_WIDE_NONE at the bottom; stores are of whole vectors */
    float near[FLIGHT_STACK + CGT_LANES];     /* of nearest hits: where the ray enters */
} flight;

CGT_SPU_INLINE void flight_pop(flight *f, bool any_hit)
{
    do
        f->top--;
    while (!any_hit && f->near[f->top] > f->ray.far);
    f->code = f->stack[f->top];
}

/* To the end, where the stack may not hold another node's children. */
__attribute__((noinline, cold)) static void flight_alone(const wide_call *c, flight *f)
{
    while (f->code != CGT_WIDE_NONE) {
        if (c->any_hit)
            wide_single_trace(c, &f->ray, f->code, true);
        else
            wide_single_trace(c, &f->ray, f->code, false);
        if (f->ray.far == -INFINITY)
            f->top = 1;
        flight_pop(f, c->any_hit);
    }
}

/* A step at a node: the children that the ray passes go onto the stack. */
CGT_SPU_INLINE void flight_node(const wide_call *c, flight *f, bool any_hit)
{
    const wide_node *n = (const wide_node *)c->tree->node + f->code;
    const char *plane = (const char *)n;
    vfloat enter = spux_vfloat(f->ray.near), leave = spux_vfloat(f->ray.far);
    for (int a = 0; a < 3; a++) {
        const vfloat rdir = spux_vfloat(f->ray.rdir[a]);
        const vfloat low = spux_load((const float *)(const void *)(plane + f->enter[a]));
        const vfloat high = spux_load((const float *)(const void *)(plane + f->leave[a]));
        enter = spux_max(spu_madd(low, rdir, spux_vfloat(f->ray.first[a])), enter);
        leave = spux_min(spu_madd(high, rdir, spux_vfloat(f->ray.last[a])), leave);
    }
    vuint code = spux_load_uint(n->child);
    c->counts->nodes++;
    if (!any_hit) {
        const vuint back = wide_backwards(n, f->ray.octant);
        enter = spux_permute(enter, back);
        leave = spux_permute(leave, back);
        code = spux_permute(code, back);
    }
    const vmask passed = spu_and(spux_cmpge(leave, enter), spux_mask_first(n->children));
    spux_store_unaligned_uint(f->stack + f->top, spux_compress(code, passed));
    if (!any_hit)
        spux_store_unaligned(f->near + f->top, spux_compress(enter, passed));
    f->top += spux_count_bits(spux_mask_bits(passed));
    flight_pop(f, any_hit);
    if (__builtin_expect(f->top > FLIGHT_STACK_USED, 0))
        flight_alone(c, f);
}

/* A step at a leaf. */
CGT_SPU_INLINE void flight_leaf(const wide_call *c, flight *f, bool any_hit)
{
    wide_lanes l;
    wide_lanes_make(c, &f->ray, &l);
    wide_single_leaf(c, &f->ray, &l, f->code, any_hit);
    if (any_hit && f->ray.far == -INFINITY)
        f->top = 1;
    flight_pop(f, any_hit);
}

/* A ray of a stream, at the root. */
CGT_SPU_INLINE void flight_begin(stream *s, uint32_t at, bool any_hit, flight *f)
{
    stream_ray_load(s, at, any_hit, &f->ray);
    wide_ray_planes(&s->call, stream_record(s, at) + RECORD_RDIR, s->slack, &f->ray);
    for (uint32_t a = 0; a < 3; a++) {
        const uint32_t low = offsetof(wide_node, low) + a * CGT_VECTOR_BYTES;
        const uint32_t high = offsetof(wide_node, high) + a * CGT_VECTOR_BYTES;
        const bool from_above = f->ray.octant >> a & 1;
        f->enter[a] = from_above ? high : low;
        f->leave[a] = from_above ? low : high;
    }
    f->at = at;
    f->code = 0;
    f->stack[0] = CGT_WIDE_NONE;
    f->near[0] = -INFINITY;
    f->top = 1;
}

/* Those in flight, by where they are. */
typedef struct flight_lists {
    uint32_t nodes, leaves;
    uint32_t node[FLIGHTS + 1], leaf[FLIGHTS + 1];
} flight_lists;

/* No branch: a ray's number is written to both lists, and stays in one. */
CGT_SPU_INLINE void flight_list(flight_lists *l, uint32_t number, uint32_t code)
{
    const uint32_t leaf = code >> 31;
    l->node[l->nodes] = l->leaf[l->leaves] = number;
    l->nodes += 1 - leaf;
    l->leaves += leaf;
}

/* Rays of all octants, none of which has a hit. */
CGT_SPU_INLINE void flights_trace(stream *s, const uint32_t *list, uint32_t count, bool any_hit)
{
    flight f[FLIGHTS];
    flight_lists l = {.nodes = 0, .leaves = 0};
    uint32_t begun = 0;
    for (; begun < count && begun < FLIGHTS; begun++) {
        flight_begin(s, list[begun], any_hit, &f[begun]);
        flight_list(&l, begun, 0);
    }
    while (l.nodes | l.leaves) {
        const uint32_t nodes = l.nodes;
        l.nodes = 0;
        for (uint32_t i = 0; i < nodes; i++) {
            const uint32_t number = l.node[i];
            flight_node(&s->call, &f[number], any_hit);
            flight_list(&l, number, f[number].code);
        }
        const uint32_t leaves = l.leaves;
        l.leaves = 0;
        for (uint32_t i = 0; i < leaves; i++) {
            const uint32_t number = l.leaf[i];
            flight *q = &f[number];
            if (q->code != CGT_WIDE_NONE)
                flight_leaf(&s->call, q, any_hit);
            if (q->code == CGT_WIDE_NONE) {
                stream_ray_keep(s, q->at, &q->ray, any_hit);
                if (begun == count)
                    continue;
                flight_begin(s, list[begun++], any_hit, q);
            }
            flight_list(&l, number, q->code);
        }
    }
}

#endif
