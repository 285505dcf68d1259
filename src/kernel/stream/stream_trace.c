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
 * vector: a level takes at most STREAM_MIN_WORDS words for that, levels are at most CGT_BVH_MAX_DEPTH, the arena is at least
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
 * begin far apart, up to a limit. Measured, with the rays of `cgt-bench rays`. Nearest hits: half the growth, half the
 * limit. */
#ifndef INTERLEAVE_MIN_RAYS
#define INTERLEAVE_MIN_RAYS 8.f
#define INTERLEAVE_SPREAD_RAYS (CGT_LANES == 16 ? 300.f : CGT_LANES == 8 ? 600.f : 1000.f)
#define INTERLEAVE_MAX_RAYS (CGT_LANES == 16 ? 160.f : CGT_LANES == 8 ? 320.f : 640.f)
#endif

/* Winners among fewer objects are mostly in a cache as it is: to ask for them costs a tenth of all. */
#define PREFETCH_MIN_PRIMS 131072u

/* ---- ray by ray ---- */

/* One ray of the stream through what hangs on a code. */
CGT_SPU_INLINE void stream_trace_ray(stream *s, uint32_t offset, uint32_t code, const float slab_error[3], bool any_hit)
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
        bvh_ray_set_slabs(&s->call, stream_record(s, offset) + RECORD_RDIR, slab_error, &r);
        bvh_single_trace(&s->call, &r, code, any_hit);
    }
    stream_ray_store(s, offset, &r, any_hit);
}

__attribute__((noinline)) static void stream_trace_few(stream *s, const uint32_t *list, uint32_t count, uint32_t code)
{
    for (uint32_t i = 0; i < count; i++) {
        if (s->call.any_hit)
            stream_trace_ray(s, list[i], code, s->slab_error, true);
        else
            stream_trace_ray(s, list[i], code, s->slab_error, false);
    }
}

/* Rays from far away, each with an E of its own. */
__attribute__((noinline)) static void stream_trace_far(stream *s, const uint32_t *list, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const float *d = stream_record(s, list[i]) + RECORD_ORG;
        const float org[3] = {fabsf(d[0]), fabsf(d[1]), fabsf(d[2])};
        float slab_error[3];
        bvh_slab_error(&s->call, org, slab_error);
        stream_trace_ray(s, list[i], 0, slab_error, s->call.any_hit);
    }
}

/* Rays with numbers beyond the bounds of single precision: against every object. */
__attribute__((noinline, cold)) static void stream_trace_extreme(stream *s, const uint32_t *list, uint32_t count)
{
    const cgt_primitives *prims = &s->call.committed_scene->prims;
    for (uint32_t i = 0; i < count; i++) {
        best_hit best = {0, 0, CGT_INVALID_ID, 0};
        const uint32_t number = list[i] / STREAM_RECORD;
        const cgt_ray ray = bvh_input_ray(&s->call, number);
        for (uint32_t prim = 0; prim < prims->count && !(s->call.any_hit && best.prim != CGT_INVALID_ID); prim++) {
            const cgt_primitive primitive = cgt_primitives_get(prims, prim);
            double t;
            if (cgt_primitive_check(&primitive) != CGT_PRIMITIVE_VALID || bvh_ray_skips(&s->call, number, prim))
                continue;
            s->call.counts->packet_tests++;
            s->call.counts->ray_tests++;
            if (filter_is_closer(prims, &ray, best.prim, prim, &t, s->call.counts))
                best.prim = prim;
        }
        if (best.prim == CGT_INVALID_ID)
            continue;
        if (s->call.any_hit)
            stream_set_occluded(s, list[i]);
        else
            stream_set_best(s, list[i], -INFINITY, -INFINITY, best.prim);
    }
}

/* ---- all rays of an octant ---- */

CGT_SPU_INLINE void stream_leaf(stream *s, const bvh_node *n, uint32_t child, const uint32_t *list, uint32_t rays,
                                bool any_hit, bool skips_prims)
{
    const uint32_t code = n->child[child], index = code & CGT_BVH_INDEX_MASK;
    const leaf_box box = leaf_box_init(n, child, s->call.scale);
    const triangle_block *triangles = (const triangle_block *)s->call.tree->triangle + index;
    const sphere_block *spheres = (const sphere_block *)s->call.tree->sphere + index;
    const bool flat = code & CGT_BVH_TRIANGLE_LEAF;
    leaf_candidates m;
    leaf_candidates_init(flat ? leaf_reachable_triangles(s, triangles) : leaf_reachable_spheres(s, spheres),
                         bvh_leaf_count(code), &m);
    s->call.counts->leaves++;
    s->call.counts->packet_tests += m.count;
    s->call.counts->ray_tests += (uint64_t)m.count * ((rays + CGT_LANES - 1) / CGT_LANES * CGT_LANES);
    if (!m.count)
        return;
    if (flat)
        leaf_stream_triangles(s, triangles, &m, &box, list, rays, any_hit, skips_prims);
    else
        leaf_stream_spheres(s, spheres, &m, &box, list, rays, any_hit, skips_prims);
}

CGT_SPU_INLINE void stream_trace(stream *s, const uint32_t *list, uint32_t count, bool any_hit, bool skips_prims)
{
    stream_level level[CGT_BVH_MAX_DEPTH];
    uint32_t depth = 0;
    level[0] = (stream_level){.node = s->call.tree->node, .list = list, .count = count};
    s->call.counts->packets++;
    if (!stream_next_piece(s, &level[0], s->arena, 0))
        return;
    for (;;) {
        stream_level *v = &level[depth];
        if (v->next < v->children)
            stream_refresh_masks(s, v, any_hit);
        if (v->next == v->children) {
            if (stream_next_piece(s, v, (uint32_t *)(void *)v->mask, depth))
                continue;
            if (!depth)
                return;
            depth--;
            continue;
        }
        const uint32_t child = v->child[v->next], code = v->node->child[child];
        const uint32_t rays = stream_compact_list(v, v->next++);
        if (!rays)
            continue;
        if (rays <= (code & CGT_BVH_LEAF ? STREAM_FEW_AT_LEAF : STREAM_FEW_AT_NODE)) {
            stream_trace_few(s, v->scratch, rays, code);
        } else if (code & CGT_BVH_LEAF) {
            stream_leaf(s, v->node, child, v->scratch, rays, any_hit, skips_prims);
        } else {
            level[++depth] =
                (stream_level){.node = (const bvh_node *)s->call.tree->node + code, .list = v->scratch, .count = rays};
            stream_next_piece(s, &level[depth],
                              v->scratch + (STREAM_LIST_WORDS(rays) - CGT_LANES) / CGT_LANES * CGT_LANES, depth);
        }
    }
}

__attribute__((noinline)) static void stream_trace_any(stream *s, const uint32_t *list, uint32_t count)
{
    stream_trace(s, list, count, true, false);
}

__attribute__((noinline)) static void stream_trace_closest(stream *s, const uint32_t *list, uint32_t count)
{
    stream_trace(s, list, count, false, false);
}

__attribute__((noinline)) static void stream_trace_masked(stream *s, const uint32_t *list, uint32_t count)
{
    if (s->call.any_hit)
        stream_trace(s, list, count, true, true);
    else
        stream_trace(s, list, count, false, true);
}

/* ---- hits ---- */

/* A packet of rays with their winners, ready to be resolved. */
CGT_SPU_INLINE void stream_make_hit_packet(const stream *s, uint32_t first, uint32_t count, packet *p)
{
    p->lanes = (count + CGT_LANES - 1) / CGT_LANES * CGT_LANES;
    p->rays = p->lanes;
    p->common_origin = p->from_origin = p->to_light = p->any_hit = p->fast = p->extreme = false;
    for (uint32_t i = 0; i < p->lanes; i += CGT_LANES) {
        const uint32_t remaining = count - i;
        stream_lanes q;
        stream_lanes_load(&s->call, first + i, remaining < CGT_LANES ? remaining : CGT_LANES, &q);
        _Alignas(CGT_VECTOR_BYTES) uint32_t prim[CGT_LANES];
        for (uint32_t k = 0; k < CGT_LANES; k++)
            prim[k] = k < remaining ? s->best[first + i + k].prim : CGT_INVALID_ID;
        const vuint best_prim = spux_load_uint(prim);
        /* rays without a hit may be anything, and are replaced by one that does no harm */
        const vmask none = spu_cmpeq(best_prim, spux_vuint(CGT_INVALID_ID));
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
        spux_store_uint(p->prim + i, best_prim);
    }
}

/* Winners of rays that run apart lie anywhere in memory. Asks for those of `rays` rays from `first` on: for indices of
 * triangles, and for the points of objects whose indices have come. */
__attribute__((noinline)) static void stream_prefetch_hits(const stream *s, uint32_t first, uint32_t rays,
                                                           uint32_t count, bool points)
{
    const cgt_primitives *prims = &s->call.committed_scene->prims;
    const cgt_primitive_array *a = prims->array;
    const uint32_t end = first + rays < count ? first + rays : count;
    if (prims->arrays != 1 || (!points && !a->index))
        return;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t prim = s->best[i].prim == CGT_INVALID_ID ? 0 : s->best[i].prim;
        uint32_t corner[3];
        if (!points) {
            __builtin_prefetch((const char *)a->index + (size_t)prim * a->index_stride);
        } else if (prims->triangles) {
            cgt_array_corners(a, prim, corner);
            for (int k = 0; k < 3; k++)
                __builtin_prefetch(cgt_array_point(a, corner[k]));
        } else
            __builtin_prefetch(cgt_array_point(a, prim));
    }
}

__attribute__((noinline)) static void stream_store_closest(stream *s, uint32_t count,
                                                           const cgt_trace_settings *settings, const cgt_hits *hits)
{
    packet p;
    packet_hits h;
    for (uint32_t i = 0; i < count; i += PACKET_MAX_RAYS) {
        const uint32_t rays = count - i < PACKET_MAX_RAYS ? count - i : PACKET_MAX_RAYS;
        const ray_order order = {s->call.first, NULL};
        if (s->call.committed_scene->prims.count >= PREFETCH_MIN_PRIMS) {
            stream_prefetch_hits(s, i + 2 * PACKET_MAX_RAYS, PACKET_MAX_RAYS, count, false);
            stream_prefetch_hits(s, i + PACKET_MAX_RAYS, PACKET_MAX_RAYS, count, true);
        }
        stream_make_hit_packet(s, i, rays, &p);
        CGT_KERNEL(cgt_packet_resolve)(s->call.committed_scene, &p, settings, &h, s->call.counts);
        ray_store_hits(&h, &order, i, rays, hits);
    }
}

/* ---- the call ---- */

/* What each ray ignores, as an object, and its mask where that hides anything. */
__attribute__((noinline, cold)) static void stream_load_masks(stream *s, uint32_t count)
{
    const ray_source *source = s->call.source;
    const cgt_committed_scene *committed_scene = s->call.committed_scene;
    bool has_masks = false;
    for (uint32_t i = 0; i < count; i++) {
        s->skip_prim[i] = ray_ignored(&committed_scene->prims, source, s->call.first + i);
        s->mask[i] = ray_read_mask(source, s->call.first + i);
        has_masks |= committed_scene->has_masks && s->mask[i] != UINT32_MAX;
    }
    s->call.skip_prim = s->skip_prim;
    s->call.mask = has_masks ? s->mask : NULL;
    s->call.skips_prims = true;
}

__attribute__((noinline)) static void stream_interleave_any(stream *s, uint32_t count)
{
    interleaved_trace(s, s->arena, count, true);
}

__attribute__((noinline)) static void stream_interleave_closest(stream *s, uint32_t count)
{
    interleaved_trace(s, s->arena, count, false);
}

/* A call's rays of all octants, `count`, where they are few. */
static void stream_interleave(stream *s, const uint32_t start[STREAM_KEYS], const uint32_t number[STREAM_KEYS],
                              uint32_t count)
{
    uint32_t *to = s->arena;
    for (uint32_t k = 0; k < STREAM_SINGLE; k++)
        for (uint32_t i = 0; i < number[k]; i++)
            *to++ = s->ray_list[start[k] + i];
    if (count <= 1)
        stream_trace_few(s, s->arena, count, 0);
    else if (s->call.any_hit)
        stream_interleave_any(s, count);
    else
        stream_interleave_closest(s, count);
}

CGT_SPU_INLINE void stream_trace_octants(stream *s, const uint32_t start[STREAM_KEYS],
                                         const uint32_t number[STREAM_KEYS])
{
    for (uint32_t k = 0; k < STREAM_SINGLE; k++) {
        const uint32_t *list = s->ray_list + start[k], count = number[k];
        if (!count)
            continue;
        stream_set_octant(s, k);
        if (s->call.skips_prims)
            stream_trace_masked(s, list, count);
        else if (s->call.any_hit)
            stream_trace_any(s, list, count);
        else
            stream_trace_closest(s, list, count);
    }
}

static bool stream_is_short(const stream *s, uint32_t rays, uint32_t octants)
{
    const float factor = s->call.any_hit ? 1 : 0.5f, max_rays = INTERLEAVE_MAX_RAYS * factor;
    const float min_rays = INTERLEAVE_MIN_RAYS + INTERLEAVE_SPREAD_RAYS * factor * s->origin_spread;
    return (float)rays < (float)octants * (min_rays < max_rays ? min_rays : max_rays);
}

static void stream_trace_all(stream *s, const uint32_t start[STREAM_KEYS], const uint32_t number[STREAM_KEYS])
{
    uint32_t rays = 0, octants = 0;
    for (uint32_t k = 0; k < STREAM_SINGLE; k++) {
        rays += number[k];
        octants += number[k] > 0;
    }
    if (stream_is_short(s, rays, octants))
        stream_interleave(s, start, number, rays);
    else
        stream_trace_octants(s, start, number);
    stream_trace_far(s, s->ray_list + start[STREAM_SINGLE], number[STREAM_SINGLE]);
    stream_trace_extreme(s, s->ray_list + start[STREAM_EXTREME], number[STREAM_EXTREME]);
}

void CGT_KERNEL(cgt_bvh_trace_rays)(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first,
                                    uint64_t end, const cgt_trace_settings *settings, const cgt_hits *hits,
                                    uint8_t *occluded, cgt_counts *counts)
{
    stream s;
    uint32_t start[STREAM_KEYS], number[STREAM_KEYS];
    const uint32_t count = (uint32_t)(end - first);
    const ray_source source = ray_source_init(rays, NULL);
    const bool fits = bvh_call_init(committed_scene, counts, &s.call);
    s.call.source = &source;
    s.call.first = first;
    s.call.any_hit = hits == NULL;
    s.occluded = hits ? NULL : occluded + first;
    if (!hits)
        memset(s.occluded, 0, count);
    counts->rays += count;
    counts->bvh_rays += count;
    if (s.call.any_hit)
        stream_read_rays(&s, count, true, start, number);
    else
        stream_read_rays(&s, count, false, start, number);
    if (rays->skip_primitive || rays->mask)
        stream_load_masks(&s, count);
    if (committed_scene->valid && fits)
        stream_trace_all(&s, start, number);
    else if (committed_scene->valid)
        for (uint32_t k = 0; k <= STREAM_EXTREME; k++)
            stream_trace_extreme(&s, s.ray_list + start[k], number[k]);
    if (!hits)
        counts->hits += s.updates;
    else
        stream_store_closest(&s, count, settings, hits);
}
