/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays through the wide tree, as streams (Wald, Gribble, Boulos, Kensler, "SIMD Ray Stream Tracing", 2007;
 * Barringer, Akenine-Moeller, "Dynamic Ray Stream Traversal", 2014): the rays of one octant go depth first from node to
 * node as a list. Lanes are rays; a node tests a vector of rays against one child after the other, which leaves a mask
 * for each. Children and primitives that lie behind where all the octant's rays begin, or beyond where all end, are left
 * out before. A child's list is made of the masks when its turn comes, so that there is one list for each node on the way
 * down. Where few rays are left, lanes are children or primitives instead (bvh_single.h); so they are from the root on
 * in a call of few rays that run apart (stream_interleaved.h).
 *
 * Lists lie in an arena, which the rays of a deep tree could fill. A node whose masks and largest list do not fit takes
 * its list in pieces, each through all that hangs on the node before the next. There is always room for a piece of one
 * vector: a level takes at most STREAM_LEAST words for that, levels are at most CGT_WIDE_MAX_DEPTH, the arena is at least
 * so many times as large, and a node leaves that much for each level below it. */
#include "kernel/packet/ray_hits.h"
#include "kernel/stream/stream_interleaved.h"
#include "kernel/stream/stream_node.h"
#include "kernel/stream/stream_read.h"
#include "kernel/stream/stream_spheres.h"
#include "kernel/stream/stream_triangles.h"

/* Lists of at most so many rays go ray by ray: at nodes and at leaves. Measured. */
#ifndef STREAM_FEW_AT_NODE
#define STREAM_FEW_AT_NODE (CGT_LANES == 16 ? 8u : CGT_LANES == 8 ? 5u : 1u)
#endif
#ifndef STREAM_FEW_AT_LEAF
#define STREAM_FEW_AT_LEAF (CGT_LANES == 16 ? 4u : CGT_LANES == 8 ? 3u : 1u)
#endif

/* A call's rays go in flight where streams would be short: where an octant has less than so many, more of them if they
 * begin far apart, up to a limit. Measured, with the rays of `cgt-bench structures`. Nearest hits: half the growth, half the
 * limit. */
#ifndef STREAM_FLY_LEAST
#define STREAM_FLY_LEAST 8.f
#define STREAM_FLY_APART (CGT_LANES == 16 ? 300.f : CGT_LANES == 8 ? 600.f : 1000.f)
#define STREAM_FLY_MOST (CGT_LANES == 16 ? 160.f : CGT_LANES == 8 ? 320.f : 640.f)
#endif

/* Winners among fewer objects are mostly in a cache as it is: to ask for them costs a tenth of all. */
#define ASK_OBJECTS 131072u

/* ---- ray by ray ---- */

/* One ray of the stream through what hangs on a code. */
CGT_SPU_INLINE void stream_trace_ray(stream *s, uint32_t at, uint32_t code, const float slack[3], bool any_hit)
{
    wide_ray r;
    stream_ray_load(s, at, any_hit, &r);
    if (r.far == -INFINITY)
        return;
    if (code & CGT_WIDE_LEAF) {
        wide_lanes l;
        wide_lanes_make(&s->call, &r, &l);
        wide_single_leaf(&s->call, &r, &l, code, any_hit);
    } else {
        wide_ray_planes(&s->call, stream_record(s, at) + RECORD_RDIR, slack, &r);
        wide_single_trace(&s->call, &r, code, any_hit);
    }
    stream_ray_keep(s, at, &r, any_hit);
}

__attribute__((noinline)) static void stream_trace_few(stream *s, const uint32_t *list, uint32_t count, uint32_t code)
{
    for (uint32_t i = 0; i < count; i++) {
        if (s->call.any_hit)
            stream_trace_ray(s, list[i], code, s->slack, true);
        else
            stream_trace_ray(s, list[i], code, s->slack, false);
    }
}

/* Rays from far away, each with an E of its own. */
__attribute__((noinline)) static void stream_trace_far(stream *s, const uint32_t *list, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const float *d = stream_record(s, list[i]) + RECORD_ORG;
        const float org[3] = {fabsf(d[0]), fabsf(d[1]), fabsf(d[2])};
        float slack[3];
        wide_slack(&s->call, org, slack);
        stream_trace_ray(s, list[i], 0, slack, s->call.any_hit);
    }
}

/* Rays with numbers beyond the bounds of single precision: against every object. */
__attribute__((noinline, cold)) static void stream_trace_extreme(stream *s, const uint32_t *list, uint32_t count)
{
    const cgt_objects *objects = &s->call.world->objects;
    for (uint32_t i = 0; i < count; i++) {
        wide_best best = {0, 0, CGT_INVALID_ID, 0};
        const uint32_t number = list[i] / STREAM_RECORD;
        const cgt_ray ray = wide_given_ray(&s->call, number);
        for (uint32_t object = 0; object < objects->count && !(s->call.any_hit && best.object != CGT_INVALID_ID);
             object++) {
            const cgt_shape shape = cgt_objects_shape(objects, object);
            double t;
            if (cgt_shape_check(&shape) != CGT_OBJECT_VALID || wide_hidden(&s->call, number, object))
                continue;
            s->call.counts->packet_tests++;
            s->call.counts->ray_tests++;
            if (filter_beats(objects, &ray, best.object, object, &t, s->call.counts))
                best.object = object;
        }
        if (best.object == CGT_INVALID_ID)
            continue;
        if (s->call.any_hit)
            stream_close(s, list[i]);
        else
            stream_keep(s, list[i], -INFINITY, -INFINITY, best.object);
    }
}

/* ---- all rays of an octant ---- */

CGT_SPU_INLINE void stream_leaf(stream *s, const wide_node *n, uint32_t child, const uint32_t *list, uint32_t rays,
                                bool any_hit, bool hides)
{
    const uint32_t code = n->child[child], index = code & CGT_WIDE_INDEX;
    const leaf_place place = leaf_place_make(n, child, s->call.scale);
    const wide_triangles *triangles = (const wide_triangles *)s->call.tree->triangle + index;
    const wide_spheres *spheres = (const wide_spheres *)s->call.tree->sphere + index;
    const bool flat = code & CGT_WIDE_TRIANGLES;
    leaf_members m;
    leaf_members_make(flat ? leaf_triangles_in_reach(s, triangles) : leaf_spheres_in_reach(s, spheres),
                      wide_leaf_count(code), &m);
    s->call.counts->leaves++;
    s->call.counts->packet_tests += m.count;
    s->call.counts->ray_tests += (uint64_t)m.count * ((rays + CGT_LANES - 1) / CGT_LANES * CGT_LANES);
    if (!m.count)
        return;
    if (flat)
        leaf_stream_triangles(s, triangles, &m, &place, list, rays, any_hit, hides);
    else
        leaf_stream_spheres(s, spheres, &m, &place, list, rays, any_hit, hides);
}

CGT_SPU_INLINE void stream_trace(stream *s, const uint32_t *list, uint32_t count, bool any_hit, bool hides)
{
    stream_level level[CGT_WIDE_MAX_DEPTH];
    uint32_t depth = 0;
    level[0] = (stream_level){.node = s->call.tree->node, .list = list, .count = count};
    s->call.counts->packets++;
    if (!stream_next_piece(s, &level[0], s->arena, 0))
        return;
    for (;;) {
        stream_level *v = &level[depth];
        if (v->next < v->children)
            stream_renew_masks(s, v, any_hit);
        if (v->next == v->children) {
            if (stream_next_piece(s, v, (uint32_t *)(void *)v->mask, depth))
                continue;
            if (!depth)
                return;
            depth--;
            continue;
        }
        const uint32_t child = v->child[v->next], code = v->node->child[child];
        const uint32_t rays = stream_make_list(v, v->next++);
        if (!rays)
            continue;
        if (rays <= (code & CGT_WIDE_LEAF ? STREAM_FEW_AT_LEAF : STREAM_FEW_AT_NODE)) {
            stream_trace_few(s, v->room, rays, code);
        } else if (code & CGT_WIDE_LEAF) {
            stream_leaf(s, v->node, child, v->room, rays, any_hit, hides);
        } else {
            level[++depth] =
                (stream_level){.node = (const wide_node *)s->call.tree->node + code, .list = v->room, .count = rays};
            stream_next_piece(s, &level[depth], v->room + (STREAM_LIST(rays) - CGT_LANES) / CGT_LANES * CGT_LANES,
                              depth);
        }
    }
}

__attribute__((noinline)) static void stream_trace_any(stream *s, const uint32_t *list, uint32_t count)
{
    stream_trace(s, list, count, true, false);
}

__attribute__((noinline)) static void stream_trace_nearest(stream *s, const uint32_t *list, uint32_t count)
{
    stream_trace(s, list, count, false, false);
}

__attribute__((noinline)) static void stream_trace_hiding(stream *s, const uint32_t *list, uint32_t count)
{
    if (s->call.any_hit)
        stream_trace(s, list, count, true, true);
    else
        stream_trace(s, list, count, false, true);
}

/* ---- hits ---- */

/* A packet of rays with their winners, ready to be resolved. */
CGT_SPU_INLINE void stream_fill_packet(const stream *s, uint32_t first, uint32_t count, packet *p)
{
    p->lanes = (count + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
    p->rays = p->lanes;
    p->common_origin = p->from_origin = p->to_light = p->any_hit = p->fast = p->extreme = false;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const uint32_t left = count - i;
        stream_lanes q;
        stream_lanes_load(&s->call, first + i, left < CGT_LANES ? left : CGT_LANES, &q);
        _Alignas(CGT_VECTOR_BYTES) uint32_t object[CGT_LANES];
        for (uint32_t k = 0; k < CGT_LANES; k++)
            object[k] = k < left ? s->best[first + i + k].object : CGT_INVALID_ID;
        const vuint winner = spux_load_uint(object);
        /* rays without a hit may be anything, and are replaced by one that does no harm */
        const vmask none = spu_cmpeq(winner, spux_vuint(CGT_INVALID_ID));
        vfloat dd = spux_vfloat(0);
        for (int a = 0; a < 3; a++) {
            const vfloat d = spux_select(q.dir[a], spux_vfloat(1), none);
            spux_store(p->org[a] + i, spux_select(q.org[a], spux_vfloat(0), none));
            spux_store(p->dir[a] + i, d);
            dd = spu_add(dd, spu_mul(d, d));
        }
        spux_store(p->rdd + i, spux_div(spux_vfloat(1), dd));
        spux_store(p->t_min + i, spux_max(spux_select(q.t_min, spux_vfloat(0), none), spux_vfloat(-FLT_MAX)));
        spux_store(p->t_max + i, q.t_max);
        spux_store_uint(p->object + i, winner);
    }
}

/* Winners of rays that run apart lie anywhere in memory. Asks for those of `rays` rays from `first` on: for indices of
 * triangles, and for the points of objects whose indices have come. */
__attribute__((noinline)) static void stream_ask(const stream *s, uint32_t first, uint32_t rays, uint32_t count,
                                                 bool points)
{
    const cgt_objects *objects = &s->call.world->objects;
    const cgt_object_array *a = objects->array;
    const uint32_t end = first + rays < count ? first + rays : count;
    if (objects->arrays != 1 || (!points && !a->index))
        return;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t object = s->best[i].object == CGT_INVALID_ID ? 0 : s->best[i].object;
        uint32_t corner[3];
        if (!points) {
            __builtin_prefetch((const char *)a->index + (size_t)object * a->index_stride);
        } else if (objects->triangles) {
            cgt_array_corners(a, object, corner);
            for (int k = 0; k < 3; k++)
                __builtin_prefetch(cgt_array_point(a, corner[k]));
        } else
            __builtin_prefetch(cgt_array_point(a, object));
    }
}

__attribute__((noinline)) static void stream_hand_out_nearest(stream *s, uint32_t count,
                                                              const cgt_trace_settings *settings, const cgt_hits *hits)
{
    packet p;
    packet_hits h;
    for (uint32_t i = 0; i < count; i += PACKET_MAX_RAYS) {
        const uint32_t rays = count - i < PACKET_MAX_RAYS ? count - i : PACKET_MAX_RAYS;
        const ray_order order = {s->call.first, NULL};
        if (s->call.world->objects.count >= ASK_OBJECTS) {
            stream_ask(s, i + 2 * PACKET_MAX_RAYS, PACKET_MAX_RAYS, count, false);
            stream_ask(s, i + PACKET_MAX_RAYS, PACKET_MAX_RAYS, count, true);
        }
        stream_fill_packet(s, i, rays, &p);
        CGT_KERNEL(cgt_packet_resolve)(s->call.world, &p, settings, &h, s->call.counts);
        ray_store_hits(&h, &order, i, rays, hits);
    }
}

/* ---- the call ---- */

/* What each ray ignores, as an object, and its mask where that hides anything. */
__attribute__((noinline, cold)) static void stream_find_hidden(stream *s, uint32_t count)
{
    const ray_source *source = s->call.source;
    const cgt_world *world = s->call.world;
    bool masked = false;
    for (uint32_t i = 0; i < count; i++) {
        s->ignored[i] = ray_ignored(&world->objects, source, s->call.first + i);
        s->mask[i] = source->rays->mask ? ray_number(source, source->rays->mask, s->call.first + i) : UINT32_MAX;
        masked |= !s->mask[i] || (world->masked && s->mask[i] != UINT32_MAX);
    }
    s->call.ignored = s->ignored;
    s->call.mask = masked ? s->mask : NULL;
    s->call.hides = true;
}

__attribute__((noinline)) static void stream_fly_any(stream *s, uint32_t count)
{
    flights_trace(s, s->arena, count, true);
}

__attribute__((noinline)) static void stream_fly_nearest(stream *s, uint32_t count)
{
    flights_trace(s, s->arena, count, false);
}

/* A call's rays of all octants, `count`, where they are few. */
static void stream_fly(stream *s, const uint32_t start[STREAM_KEYS], const uint32_t number[STREAM_KEYS], uint32_t count)
{
    uint32_t *to = s->arena;
    for (uint32_t k = 0; k < STREAM_SINGLE; k++)
        for (uint32_t i = 0; i < number[k]; i++)
            *to++ = s->all[start[k] + i];
    if (count <= 1)
        stream_trace_few(s, s->arena, count, 0);
    else if (s->call.any_hit)
        stream_fly_any(s, count);
    else
        stream_fly_nearest(s, count);
}

CGT_SPU_INLINE void stream_trace_octants(stream *s, const uint32_t start[STREAM_KEYS],
                                         const uint32_t number[STREAM_KEYS])
{
    for (uint32_t k = 0; k < STREAM_SINGLE; k++) {
        const uint32_t *list = s->all + start[k], count = number[k];
        if (!count)
            continue;
        stream_begin_octant(s, k);
        if (s->call.hides)
            stream_trace_hiding(s, list, count);
        else if (s->call.any_hit)
            stream_trace_any(s, list, count);
        else
            stream_trace_nearest(s, list, count);
    }
}

static bool stream_is_short(const stream *s, uint32_t rays, uint32_t octants)
{
    const float share = s->call.any_hit ? 1 : 0.5f, most = STREAM_FLY_MOST * share;
    const float wanted = STREAM_FLY_LEAST + STREAM_FLY_APART * share * s->apart;
    return (float)rays < (float)octants * (wanted < most ? wanted : most);
}

static void stream_trace_all(stream *s, const uint32_t start[STREAM_KEYS], const uint32_t number[STREAM_KEYS])
{
    uint32_t rays = 0, octants = 0;
    for (uint32_t k = 0; k < STREAM_SINGLE; k++) {
        rays += number[k];
        octants += number[k] > 0;
    }
    if (stream_is_short(s, rays, octants))
        stream_fly(s, start, number, rays);
    else
        stream_trace_octants(s, start, number);
    stream_trace_far(s, s->all + start[STREAM_SINGLE], number[STREAM_SINGLE]);
    stream_trace_extreme(s, s->all + start[STREAM_EXTREME], number[STREAM_EXTREME]);
}

void CGT_KERNEL(cgt_wide_trace_rays)(const cgt_world *world, const cgt_rays *rays, uint64_t first, uint64_t end,
                                     const cgt_trace_settings *settings, const cgt_hits *hits, uint8_t *occluded,
                                     cgt_counts *counts)
{
    stream s;
    uint32_t start[STREAM_KEYS], number[STREAM_KEYS];
    const uint32_t count = (uint32_t)(end - first);
    const ray_source source = ray_source_make(rays, NULL);
    const bool fits = wide_call_make(world, counts, &s.call);
    s.call.source = &source;
    s.call.first = first;
    s.call.any_hit = hits == NULL;
    s.occluded = hits ? NULL : occluded + first;
    if (!hits)
        memset(s.occluded, 0, count);
    counts->rays += count;
    counts->bvh_rays += count;
    if (s.call.any_hit)
        stream_read(&s, count, true, start, number);
    else
        stream_read(&s, count, false, start, number);
    if (rays->skip_primitive || rays->mask)
        stream_find_hidden(&s, count);
    if (world->valid && fits)
        stream_trace_all(&s, start, number);
    else if (world->valid)
        for (uint32_t k = 0; k <= STREAM_EXTREME; k++)
            stream_trace_extreme(&s, s.all + start[k], number[k]);
    if (!hits)
        counts->hits += s.changed;
    else
        stream_hand_out_nearest(&s, count, settings, hits);
}
