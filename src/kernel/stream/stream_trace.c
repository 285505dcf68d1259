/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Arrays of rays through the BVH, as streams (Wald, Gribble, Boulos, Kensler, "SIMD Ray Stream Tracing", 2007;
 * Barringer, Akenine-Moeller, "Dynamic Ray Stream Traversal", 2014): the rays of one octant descend depth first from
 * node to node as a list. Lanes are rays; a node tests a vector of rays against one child after the other, which gives
 * a mask for each. Before that, children and primitives are culled that lie behind the origins or beyond the ends of
 * all the octant's rays. A child's list is made from the masks when its turn comes, so that there is one list for each
 * node on the way down. Where few rays are left, lanes are children or primitives instead (bvh_single.h), and so they
 * are from the root on in a call of few incoherent rays (stream_single.c). Rays with lists of hits (stream_lists.h) end
 * where their lists do.
 *
 * Lists lie in an arena, which the rays of a deep tree could fill. A node whose masks and largest list do not fit takes
 * its list in pieces, each through the node's whole subtree before the next. There is always room for a piece of one
 * vector: a level takes at most STREAM_MIN_WORDS words for that, there are at most CGT_BVH_MAX_DEPTH levels, the arena
 * is at least that many times as large, and a node leaves as much for each level below it. */
#include "kernel/bvh/bvh_list.h"
#include "kernel/stream/stream_capsules.h"
#include "kernel/stream/stream_node.h"
#include "kernel/stream/stream_read.h"
#include "kernel/stream/stream_spheres.h"
#include "kernel/stream/stream_triangles.h"

/* Lists of at most as many rays are traced ray by ray: at nodes and at leaves. Measured. */
#define STREAM_FEW_AT_NODE (CGT_LANES == 16 ? 8u : CGT_LANES == 8 ? 5u : 1u)
#define STREAM_FEW_AT_LEAF (CGT_LANES == 16 ? 4u : CGT_LANES == 8 ? 3u : 1u)

CGT_SPU_INLINE uint32_t stream_few(uint32_t code)
{
    return code & CGT_BVH_LEAF ? STREAM_FEW_AT_LEAF : STREAM_FEW_AT_NODE;
}

/* ---- all rays of an octant ---- */

CGT_SPU_INLINE void stream_leaf(stream *s, const bvh_node *n, uint32_t child, const uint32_t *list, uint32_t rays,
                                bool any_hit, bool skips_prims, bool lists)
{
    const uint32_t code = n->child[child];
    const cgt_bvh_leaf leaf = cgt_bvh_find_leaf(s->call.tree, code);
    const leaf_box box = leaf_box_init(n, child, s->call.scale);
    const cgt_bvh *const tree = s->call.tree;
    const sphere_block *spheres = NULL; /* the blocks of other kinds may be NULL */
    const triangle_block *triangles = NULL;
    const capsule_block *capsules = NULL;
    if (lists && leaf.kind == CGT_KIND_SPHERES && s->list[list[0] / STREAM_RECORD]->without_spheres)
        return;
    if (leaf.kind == CGT_KIND_TRIANGLES)
        triangles = (const triangle_block *)tree->triangle + leaf.block;
    else if (leaf.kind == CGT_KIND_SPHERES)
        spheres = (const sphere_block *)tree->sphere + leaf.block;
    else
        capsules = (const capsule_block *)tree->capsule + leaf.block;
    const unsigned in_reach = triangles ? leaf_reachable_triangles(s, triangles)
                              : spheres ? leaf_reachable_spheres(s, spheres)
                                        : leaf_reachable_capsules(s, capsules);
    leaf_candidates m;
    leaf_candidates_init(in_reach, bvh_leaf_count(code), &m);
    s->call.counts->leaves++;
    s->call.counts->packet_tests += m.count;
    s->call.counts->ray_tests += (uint64_t)m.count * ((rays + CGT_LANES - 1) / CGT_LANES * CGT_LANES);
    if (!m.count)
        return;
    if (triangles)
        leaf_stream_triangles(s, triangles, &m, &box, list, rays, any_hit, skips_prims, lists);
    else if (spheres)
        leaf_stream_spheres(s, spheres, &m, &box, list, rays, any_hit, skips_prims, lists);
    else
        leaf_stream_capsules(s, capsules, &m, &box, list, rays, any_hit, skips_prims, lists);
}

CGT_SPU_INLINE void stream_trace(stream *s, const uint32_t *list, uint32_t count, bool any_hit, bool skips_prims,
                                 bool lists)
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
        /* all children done: take the next piece of the list, or go back up */
        if (v->next == v->children) {
            if (stream_next_piece(s, v, (uint32_t *)(void *)v->mask, depth))
                continue;
            if (!depth)
                return;
            depth--;
            continue;
        }
        /* the rays that pass the next child */
        const uint32_t child = v->child[v->next], code = v->node->child[child];
        const uint32_t rays = stream_compact_list(v, v->next++);
        if (!rays)
            continue;
        if (code & CGT_BVH_LEAF)
            s->together += rays;
        else if (rays <= STREAM_FEW_AT_NODE)
            s->alone += rays;
        /* few rays singly, a leaf at once, a node one level down */
        if (rays <= stream_few(code)) {
            if (lists)
                CGT_KERNEL(cgt_stream_list_few)(s, v->scratch, rays, code);
            else
                CGT_KERNEL(cgt_stream_trace_few)(s, v->scratch, rays, code);
        } else if (code & CGT_BVH_LEAF) {
            stream_leaf(s, v->node, child, v->scratch, rays, any_hit, skips_prims, lists);
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
    stream_trace(s, list, count, true, false, false);
}

__attribute__((noinline)) static void stream_trace_closest(stream *s, const uint32_t *list, uint32_t count)
{
    stream_trace(s, list, count, false, false, false);
}

__attribute__((noinline)) static void stream_trace_lists(stream *s, const uint32_t *list, uint32_t count)
{
    stream_trace(s, list, count, false, false, true);
}

__attribute__((noinline)) static void stream_trace_masked(stream *s, const uint32_t *list, uint32_t count)
{
    if (s->call.any_hit)
        stream_trace(s, list, count, true, true, false);
    else
        stream_trace(s, list, count, false, true, false);
}

/* ---- the call ---- */

/* The primitives that rays i to i + CGT_LANES - 1 of a dense array skip. Neighbours mostly name the same geometry. */
CGT_SPU_INLINE void stream_load_skips(stream *s, uint32_t i)
{
    const cgt_primitives *prims = &s->call.committed_scene->prims;
    const cgt_rays *rays = s->call.source->rays;
    const uint64_t from = s->call.first + i;
    const uint32_t geometry = rays->skip_geometry ? rays->skip_geometry[from] : 0;
    if (rays->skip_geometry &&
        !spux_all(spu_cmpeq(spux_load_unaligned_uint(rays->skip_geometry + from), spux_vuint(geometry)))) {
        for (uint32_t k = i; k < i + CGT_LANES; k++)
            s->skip_prim[k] = ray_read_skip(prims, s->call.source, s->call.first + k);
        return;
    }
    const uint32_t base = cgt_primitives_number(prims, geometry, 0);
    const uint32_t end = base != CGT_INVALID_ID ? cgt_primitives_array(prims, base)->count : 0;
    const vuint primitive = spux_load_unaligned_uint(rays->skip_primitive + from);
    spux_store_uint(s->skip_prim + i, spux_select(spux_vuint(CGT_INVALID_ID), spu_add(primitive, spux_vuint(base)),
                                                  spu_cmpgt(spux_vuint(end), primitive)));
}

/* Loads the primitive that each ray skips, and its mask if that hides anything. */
__attribute__((noinline)) static void stream_load_masks(stream *s, uint32_t count)
{
    const ray_source *source = s->call.source;
    const cgt_committed_scene *committed_scene = s->call.committed_scene;
    bool has_masks = false;
    uint32_t i = 0;
    s->skip_prim[CGT_STREAM_CHUNK] = CGT_INVALID_ID; /* of the dummy */
    s->mask[CGT_STREAM_CHUNK] = UINT32_MAX;
    if (source->stride == sizeof(uint32_t) && !source->rays->mask && source->rays->skip_primitive)
        for (; i + CGT_LANES <= count; i += CGT_LANES)
            stream_load_skips(s, i);
    for (; i < count; i++) {
        s->skip_prim[i] = ray_read_skip(&committed_scene->prims, source, s->call.first + i);
        s->mask[i] = ray_read_mask(source, s->call.first + i);
        has_masks |= committed_scene->has_masks && s->mask[i] != UINT32_MAX;
    }
    s->call.skip_prim = s->skip_prim;
    s->call.mask = has_masks ? s->mask : NULL;
    s->call.skips_prims = true;
}

/* The order in which octants are traced: each before the one that it faces. */
static const uint8_t octant_order[STREAM_UNUSUAL] = {0, 7, 1, 6, 2, 5, 3, 4};

/* Traces a call's rays of the octants from place `first` on, interleaved. */
static void stream_interleave(stream *s, const uint32_t start[STREAM_KEYS], const uint32_t number[STREAM_KEYS],
                              uint32_t first)
{
    uint32_t *to = s->arena;
    for (uint32_t place = first; place < STREAM_UNUSUAL; place++)
        for (uint32_t k = octant_order[place], i = 0; i < number[k]; i++)
            *to++ = s->ray_list[start[k] + i];
    if (s->list)
        CGT_KERNEL(cgt_stream_list_turns)(s, s->arena, (uint32_t)(to - s->arena));
    else
        CGT_KERNEL(cgt_stream_interleave)(s, s->arena, (uint32_t)(to - s->arena));
}

/* Whether the streams of pairs of octants, of as many rays, have fallen apart. One octant tells little: from surfaces
 * some lead out of the scene, others into it. */
static bool stream_fell_apart(const stream *s, uint32_t octants, uint32_t rays)
{
    return octants % 2 == 0 && rays >= INTERLEAVE_JUDGED_RAYS &&
           (float)s->alone > INTERLEAVE_SHARE(s->call.any_hit) * (float)(s->alone + s->together);
}

CGT_SPU_INLINE void stream_trace_octants(stream *s, const uint32_t start[STREAM_KEYS],
                                         const uint32_t number[STREAM_KEYS])
{
    uint32_t traced = 0;
    for (uint32_t place = 0; place < STREAM_UNUSUAL; place++) {
        const uint32_t k = octant_order[place], count = number[k], *list = s->ray_list + start[k];
        if (!count)
            continue;
        if (stream_fell_apart(s, place, traced)) {
            stream_interleave(s, start, number, place);
            return;
        }
        traced += count;
        stream_set_octant(s, k);
        if (s->list)
            stream_trace_lists(s, list, count);
        else if (s->call.skips_prims)
            stream_trace_masked(s, list, count);
        else if (s->call.any_hit)
            stream_trace_any(s, list, count);
        else
            stream_trace_closest(s, list, count);
    }
}

/* Whether streams would be short: an octant has few rays, or more of them that start far apart. */
static bool stream_is_short(const stream *s, uint32_t rays, uint32_t octants)
{
    const float factor = s->call.any_hit || s->list ? 1 : 0.5f, max_rays = INTERLEAVE_MAX_RAYS * factor;
    const float min_rays = INTERLEAVE_MIN_RAYS + INTERLEAVE_SPREAD_RAYS * factor * s->origin_spread;
    return (float)rays < (float)octants * (min_rays < max_rays ? min_rays : max_rays);
}

/* Sets up a call. */
static void stream_begin(stream *s, const cgt_committed_scene *committed_scene, const ray_source *source,
                         uint64_t first, cgt_counts *counts)
{
    bvh_call_init(committed_scene, counts, &s->call);
    s->call.source = source;
    s->call.first = first;
    s->limits = bvh_ray_limits(s->call.scale);
    s->limits.max_org = STREAM_MAX_ORG / s->call.scale;
}

static void stream_trace_all(stream *s, const uint32_t start[STREAM_KEYS], const uint32_t number[STREAM_KEYS])
{
    uint32_t rays = 0, octants = 0;
    for (uint32_t k = 0; k < STREAM_UNUSUAL; k++) {
        rays += number[k];
        octants += number[k] > 0;
    }
    if (stream_is_short(s, rays, octants))
        stream_interleave(s, start, number, 0);
    else
        stream_trace_octants(s, start, number);
    if (s->list)
        CGT_KERNEL(cgt_stream_list_turns)(s, s->ray_list + start[STREAM_UNUSUAL], number[STREAM_UNUSUAL]);
    else
        CGT_KERNEL(cgt_stream_trace_unusual)(s, s->ray_list + start[STREAM_UNUSUAL], number[STREAM_UNUSUAL]);
}

void CGT_KERNEL(cgt_bvh_trace_rays)(const cgt_committed_scene *committed_scene, const cgt_rays *rays, uint64_t first,
                                    uint64_t end, const cgt_trace_settings *settings, const cgt_hits *hits,
                                    uint8_t *occluded, cgt_counts *counts)
{
    stream *s = cgt_scratch_take(counts->scratch, sizeof *s);
    uint32_t start[STREAM_KEYS], number[STREAM_KEYS];
    const uint32_t count = (uint32_t)(end - first);
    const ray_source source = ray_source_init(rays, NULL);
    stream_begin(s, committed_scene, &source, first, counts);
    s->list = NULL;
    s->call.any_hit = hits == NULL;
    s->call.moved = committed_scene->valid ? &s->limits : NULL;
    s->occluded = hits ? NULL : occluded + first;
    if (!hits)
        memset(s->occluded, 0, count);
    counts->rays += count;
    counts->bvh_rays += count;
    if (s->call.any_hit)
        stream_read_rays(s, count, true, start, number);
    else
        stream_read_rays(s, count, false, start, number);
    if (rays->skip_primitive || rays->mask)
        stream_load_masks(s, count);
    if (committed_scene->valid)
        stream_trace_all(s, start, number);
    if (!hits)
        counts->hits += s->updates;
    else
        CGT_KERNEL(cgt_stream_store_hits)(s, count, settings, hits);
    cgt_scratch_return(counts->scratch, s);
}

/* ---- lists of hits ---- */

/* Rays in arrays. */
typedef struct stream_arrays {
    float org[3][LIST_CHUNK], dir[3][LIST_CHUNK], t_min[LIST_CHUNK], t_max[LIST_CHUNK];
} stream_arrays;

static void stream_gather_rays(cgt_hit_list *const *lists, uint32_t count, float scale, stream_arrays *to)
{
    for (uint32_t k = 0; k < count; k++) {
        const cgt_ray *ray = lists[k]->ray;
        for (int a = 0; a < 3; a++) {
            to->org[a][k] = ray->line.org[a];
            to->dir[a][k] = ray->line.dir[a];
        }
        to->t_min[k] = ray->t_min;
        to->t_max[k] = ray->t_max;
        list_set_units(lists[k], scale);
    }
}

void CGT_KERNEL(cgt_list_streams)(const cgt_committed_scene *committed_scene, cgt_hit_list *const *lists,
                                  uint32_t count, cgt_counts *counts)
{
    stream *s = cgt_scratch_take(counts->scratch, sizeof *s);
    stream_arrays *given = cgt_scratch_take(counts->scratch, sizeof *given);
    const cgt_rays rays = {.count = count,
                           .org = {given->org[0], given->org[1], given->org[2]},
                           .dir = {given->dir[0], given->dir[1], given->dir[2]},
                           .t_min = given->t_min,
                           .t_max = given->t_max};
    const ray_source source = ray_source_init(&rays, NULL);
    uint32_t start[STREAM_KEYS], number[STREAM_KEYS];
    stream_begin(s, committed_scene, &source, 0, counts);
    s->list = lists;
    s->call.skips_prims = true; /* for rays that leave their stream */
    stream_gather_rays(lists, count, s->call.scale, given);
    stream_read_rays(s, count, false, start, number);
    stream_trace_all(s, start, number);
    cgt_scratch_return(counts->scratch, s);
}
