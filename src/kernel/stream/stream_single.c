/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays of a stream as single rays (bvh_single.h): few of a list, those that no bounds cover, and whole calls of too few
 * rays for streams.
 *
 * Interleaving. About 32 independent rays take turns, one traversal step each: first those at a node, then those at a
 * leaf. The steps of one ray wait for each other, and its branches are mispredicted; steps of different rays overlap,
 * and the list that a ray joins next is chosen without a branch. Each ray has a small stack; a ray that needs more is
 * traced to its end alone. */
#include "kernel/bvh/bvh_list.h"
#include "kernel/stream/stream.h"

/* ---- one after the other ---- */

/* Traces one ray of the stream through the subtree of a code. */
CGT_SPU_INLINE void stream_trace_ray(stream *s, uint32_t offset, uint32_t code, bool any_hit)
{
    bvh_ray r;
    stream_ray_load(s, offset, any_hit, &r);
    if (r.far == -INFINITY)
        return;
    if (code & CGT_BVH_LEAF) {
        bvh_leaf_ray l;
        bvh_leaf_ray_init(&s->call, &r, &l);
        bvh_single_leaf(&s->call, &r, &l, code, any_hit);
    } else {
        bvh_ray_set_slabs(&s->call, stream_record(s, offset) + RECORD_RDIR, s->slab_error, &r);
        bvh_single_trace(&s->call, &r, code, any_hit);
    }
    stream_ray_store(s, offset, &r, any_hit);
}

void CGT_KERNEL(cgt_stream_trace_few)(stream *s, const uint32_t *list, uint32_t count, uint32_t code)
{
    for (uint32_t i = 0; i < count; i++) {
        if (s->call.any_hit)
            stream_trace_ray(s, list[i], code, true);
        else
            stream_trace_ray(s, list[i], code, false);
    }
}

__attribute__((cold)) void CGT_KERNEL(cgt_stream_trace_unusual)(stream *s, const uint32_t *list, uint32_t count)
{
    const bvh_call *c = &s->call;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t number = list[i] / STREAM_RECORD;
        const cgt_ray ray = bvh_input_ray(c, number);
        const uint32_t skip_prim = c->skip_prim ? c->skip_prim[number] : CGT_INVALID_ID;
        const uint32_t mask = c->mask ? c->mask[number] : UINT32_MAX;
        const uint32_t prim =
            CGT_KERNEL(cgt_trace_unusual)(c->committed_scene, &ray, true, skip_prim, mask, c->any_hit, c->counts);
        if (prim == CGT_INVALID_ID)
            continue;
        if (c->any_hit)
            stream_set_occluded(s, list[i]);
        else
            stream_set_best(s, list[i], -INFINITY, -INFINITY, prim);
    }
}

/* ---- interleaved ---- */

#define INTERLEAVED_RAYS 32u
#define INTERLEAVED_STACK 64u

typedef struct interleaved_ray {
    bvh_ray ray;
    uint32_t offset;   /* its record */
    uint32_t code;     /* where it is; CGT_BVH_NO_CHILD: at its end */
    uint32_t enter[3]; /* bytes from a node to the planes that the ray meets first along each axis, and to the others */
    uint32_t leave[3];
    uint32_t top;
    uint32_t stack[INTERLEAVED_STACK + CGT_LANES]; /* CGT_BVH_NO_CHILD at the bottom; stores are of whole vectors */
    float near[INTERLEAVED_STACK + CGT_LANES];     /* of closest hits: where the ray enters */
} interleaved_ray;

CGT_SPU_INLINE void interleaved_pop(interleaved_ray *f, bool any_hit)
{
    do
        f->top--;
    /* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): the bottom is -infinity, and popped once */
    while (!any_hit && f->near[f->top] > f->ray.far);
    f->code = f->stack[f->top];
}

/* Traces a ray to its end, where its stack may not hold another node's children. */
__attribute__((noinline, cold)) static void interleaved_finish(const bvh_call *c, interleaved_ray *f)
{
    while (f->code != CGT_BVH_NO_CHILD) {
        if (c->any_hit)
            bvh_single_trace(c, &f->ray, f->code, true);
        else
            bvh_single_trace(c, &f->ray, f->code, false);
        if (f->ray.far == -INFINITY)
            f->top = 1;
        interleaved_pop(f, c->any_hit);
    }
}

/* A step at a node: pushes the children that the ray passes. */
CGT_SPU_INLINE void interleaved_step_node(const bvh_call *c, interleaved_ray *f, bool any_hit)
{
    const bvh_node *n = (const bvh_node *)c->tree->node + f->code;
    const char *plane = (const char *)n;
    const float *near[3], *far[3];
    vfloat enter, leave;
    for (int a = 0; a < 3; a++) {
        near[a] = (const float *)(const void *)(plane + f->enter[a]);
        far[a] = (const float *)(const void *)(plane + f->leave[a]);
    }
    bvh_clip_to_boxes(&f->ray, near, far, &enter, &leave);
    if (__builtin_expect(f->ray.still, 0))
        leave = bvh_leave_parallel(n, f->ray.still, leave);
    if (__builtin_expect(n->flat[0] & BVH_TURNED, 0))
        bvh_clip_ray_to_turned(c, n, f->ray.org, f->ray.dir, &enter, &leave);
    vuint code = spux_load_uint(n->child);
    c->counts->nodes++;
    if (!any_hit) {
        const vuint order = bvh_push_order(n, f->ray.octant);
        enter = spux_permute(enter, order);
        leave = spux_permute(leave, order);
        code = spux_permute(code, order);
    }
    const vmask passed = spu_and(spux_cmpge(leave, enter), spux_mask_first(n->children));
    spux_store_unaligned_uint(f->stack + f->top, spux_compress(code, passed));
    if (!any_hit)
        spux_store_unaligned(f->near + f->top, spux_compress(enter, passed));
    f->top += spux_count_bits(spux_mask_bits(passed));
    interleaved_pop(f, any_hit);
    if (__builtin_expect(f->top > INTERLEAVED_STACK_USED, 0))
        interleaved_finish(c, f);
}

/* A step at a leaf. */
CGT_SPU_INLINE void interleaved_step_leaf(const bvh_call *c, interleaved_ray *f, bool any_hit)
{
    bvh_leaf_ray l;
    bvh_leaf_ray_init(c, &f->ray, &l);
    bvh_single_leaf(c, &f->ray, &l, f->code, any_hit);
    if (any_hit && f->ray.far == -INFINITY)
        f->top = 1;
    interleaved_pop(f, any_hit);
}

/* Puts a ray of the stream at the root. */
CGT_SPU_INLINE void interleaved_start(stream *s, uint32_t offset, bool any_hit, interleaved_ray *f)
{
    stream_ray_load(s, offset, any_hit, &f->ray);
    bvh_ray_set_slabs(&s->call, stream_record(s, offset) + RECORD_RDIR, s->slab_error, &f->ray);
    for (uint32_t a = 0; a < 3; a++) {
        const uint32_t low = offsetof(bvh_node, low) + a * CGT_VECTOR_BYTES;
        const uint32_t high = offsetof(bvh_node, high) + a * CGT_VECTOR_BYTES;
        const bool from_above = f->ray.octant >> a & 1;
        f->enter[a] = from_above ? high : low;
        f->leave[a] = from_above ? low : high;
    }
    f->offset = offset;
    f->code = 0;
    f->stack[0] = CGT_BVH_NO_CHILD;
    f->near[0] = -INFINITY;
    f->top = 1;
}

/* The interleaved rays, by where they are. */
typedef struct interleaved_lists {
    uint32_t nodes, leaves;
    uint32_t node[INTERLEAVED_RAYS + 1], leaf[INTERLEAVED_RAYS + 1];
} interleaved_lists;

/* Branchless: a ray's number is written to both lists, and counts in one. */
CGT_SPU_INLINE void interleaved_enqueue(interleaved_lists *l, uint32_t number, uint32_t code)
{
    const uint32_t leaf = code >> 31;
    l->node[l->nodes] = l->leaf[l->leaves] = number;
    l->nodes += 1 - leaf;
    l->leaves += leaf;
}

/* Traces rays of all octants, none of which has a hit. */
CGT_SPU_INLINE void interleaved_trace(stream *s, const uint32_t *list, uint32_t count, bool any_hit)
{
    interleaved_ray f[INTERLEAVED_RAYS];
    interleaved_lists l = {.nodes = 0, .leaves = 0};
    uint32_t started = 0;
    for (; started < count && started < INTERLEAVED_RAYS; started++) {
        interleaved_start(s, list[started], any_hit, &f[started]);
        interleaved_enqueue(&l, started, 0);
    }
    while (l.nodes | l.leaves) {
        /* a step of each ray at a node */
        const uint32_t nodes = l.nodes;
        l.nodes = 0;
        for (uint32_t i = 0; i < nodes; i++) {
            const uint32_t number = l.node[i];
            interleaved_step_node(&s->call, &f[number], any_hit);
            interleaved_enqueue(&l, number, f[number].code);
        }
        /* a step of each ray at a leaf; rays at their end make room for the next */
        const uint32_t leaves = l.leaves;
        l.leaves = 0;
        for (uint32_t i = 0; i < leaves; i++) {
            const uint32_t number = l.leaf[i];
            interleaved_ray *q = &f[number];
            if (q->code != CGT_BVH_NO_CHILD)
                interleaved_step_leaf(&s->call, q, any_hit);
            if (q->code == CGT_BVH_NO_CHILD) {
                stream_ray_store(s, q->offset, &q->ray, any_hit);
                if (started == count)
                    continue;
                interleaved_start(s, list[started++], any_hit, q);
            }
            interleaved_enqueue(&l, number, q->code);
        }
    }
}

__attribute__((noinline)) static void interleave_any(stream *s, const uint32_t *list, uint32_t count)
{
    interleaved_trace(s, list, count, true);
}

__attribute__((noinline)) static void interleave_closest(stream *s, const uint32_t *list, uint32_t count)
{
    interleaved_trace(s, list, count, false);
}

void CGT_KERNEL(cgt_stream_interleave)(stream *s, const uint32_t *list, uint32_t count)
{
    if (count <= 1)
        CGT_KERNEL(cgt_stream_trace_few)(s, list, count, 0);
    else if (s->call.any_hit)
        interleave_any(s, list, count);
    else
        interleave_closest(s, list, count);
}

/* ---- lists of hits ---- */

void CGT_KERNEL(cgt_stream_list_few)(stream *s, const uint32_t *list, uint32_t count, uint32_t code)
{
    list_query q;
    q.call = &s->call;
    for (uint32_t i = 0; i < count; i++) {
        const float *const d = stream_record(s, list[i]);
        q.list = s->list[list[i] / STREAM_RECORD];
        stream_ray_load(s, list[i], false, &q.ray);
        bvh_ray_set_slabs(&s->call, d + RECORD_RDIR, s->slab_error, &q.ray);
        list_start(&q, code);
        CGT_KERNEL(cgt_list_finish)(&q);
        if (q.ray.far != d[RECORD_FAR])
            stream_set_end(s, list[i], q.ray.far);
    }
}

void CGT_KERNEL(cgt_stream_list_turns)(stream *s, const uint32_t *list, uint32_t count)
{
    cgt_hit_list **to = cgt_scratch_take(s->call.counts->scratch, count * sizeof(cgt_hit_list *));
    for (uint32_t i = 0; i < count; i++)
        to[i] = s->list[list[i] / STREAM_RECORD];
    CGT_KERNEL(cgt_list_turns)(s->call.committed_scene, to, count, s->call.counts);
    cgt_scratch_return(s->call.counts->scratch, to);
}
