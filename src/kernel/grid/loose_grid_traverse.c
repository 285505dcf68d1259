/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Coherent traversal of a loose grid by a packet of any rays of one main axis: slice by slice, all levels together, the
 * references of the cells that the packet's frustum touches are collected; a vector of objects at a time is culled and
 * what is left tested against the rays. The packet is done when every ray's hit lies before the next slice. Few rays
 * are tested one by one against a vector of objects at a time. */
#include "kernel/grid/lane_primitives.h"
#include "kernel/grid/loose_grid_march.h"
#include "kernel/primitive/gather_primitives.h"
#include "kernel/grid/packet_primitives.h"
#include "kernel/packet/packet_split.h"

/* References that are tested before the next slice: fewer wait for more, since a vector costs the same when it is not
 * full. */
#define PENDING_ENOUGH CGT_LANES

#define CLUSTERS 64u /* collected in a slice, before their triangles are */

typedef struct loose_traversal {
    packet_objects objects;
    loose_march march;
    cgt_counts *counts;
    bool few; /* rays */
    lane_objects lanes;
    uint32_t pending; /* references collected and not yet tested */
    _Alignas(64) uint32_t reference[PACKET_OBJECTS_MOST];
    uint32_t clusters, cluster[CLUSTERS]; /* of which the triangles are not */
} loose_traversal;

/* ---- testing ---- */

/* Tests what was collected, and looks how far the rays still look. */
static void test_pending(loose_traversal *v)
{
    v->counts->references += v->pending;
    if (v->few)
        lane_objects_test(&v->lanes, v->reference, v->pending);
    else
        packet_test_objects(&v->objects, v->reference, v->pending);
    v->pending = 0;
}

static void look_again(loose_traversal *v) { v->objects.w_far = packet_far_coordinate(&v->objects); }

/* ---- collecting ---- */

CGT_SPU_INLINE void collect_run(loose_traversal *v, const uint32_t *object, uint32_t count)
{
    while (count) {
        const uint32_t room = PACKET_OBJECTS_MOST - v->pending, some = count < room ? count : room;
        for (uint32_t k = 0; k < some; k++)
            v->reference[v->pending + k] = object[k];
        v->pending += some;
        object += some;
        count -= some;
        if (v->pending == PACKET_OBJECTS_MOST)
            test_pending(v);
    }
}

/* Lanes whose cluster lies outside the frustum, or before or beyond what its rays still want. */
static unsigned clusters_outside(const packet_objects *v, const uint32_t *number, uint32_t count)
{
    const frustum *f = &v->frustum;
    const int axis[3] = {f->w, f->u, f->v};
    const vfloat error = spux_vfloat(f->plane_error);
    _Alignas(CGT_VECTOR_BYTES) float middle[3][CGT_LANES];
    vfloat d[8], half[3];
    fetch_clusters_of(v->world->cluster, number, count, d);
    for (int a = 0; a < 3; a++) {
        spux_store(middle[a], d[a]);
        half[a] = spu_mul(d[4 + axis[a]], spux_vfloat(v->space.rcell[axis[a]] * (1 + 0x1p-20f)));
    }
    const frustum_points p = points_in_frustum(v, (const float(*)[CGT_LANES])middle);
    const vfloat reach = spu_add(half[0], error);
    vmask outside = spu_or(spu_cmpgt(spu_sub(p.w, reach), spux_vfloat(v->w_far)),
                           spu_cmpgt(spux_vfloat(f->w_near), spu_add(p.w, reach)));
    for (int k = 0; k < 4; k++) {
        const vfloat most =
            spu_add(spu_madd(half[0], spux_vfloat(__builtin_fabsf(f->step[k])), half[1 + k / 2]), error);
        outside = spu_or(outside, spu_cmpgt(spux_vfloat(0), spu_add(inside_bound(v, &p, k), most)));
    }
    return spux_mask_bits(outside);
}

/* The triangles of the clusters that were collected, of those that the frustum touches. */
static void collect_triangles(loose_traversal *v)
{
    const cgt_cluster *cluster = v->objects.world->cluster;
    for (uint32_t i = 0; i < v->clusters; i += CGT_LANES) {
        const uint32_t left = v->clusters - i, count = left < CGT_LANES ? left : CGT_LANES;
        const uint32_t *number = v->cluster + i;
        unsigned lanes = CGT_ALL_LANES >> (CGT_LANES - count);
        if (v->objects.cull != CGT_CULL_NONE)
            lanes = count_culled(&v->objects, lanes, clusters_outside(&v->objects, number, count), count);
        for (; lanes; lanes &= lanes - 1) {
            const uint32_t k = number[__builtin_ctz(lanes)];
            if (PACKET_OBJECTS_MOST - v->pending < CGT_CLUSTER)
                test_pending(v);
            for (uint32_t valid = cluster[k].valid; valid; valid &= valid - 1)
                v->reference[v->pending++] = k * CGT_CLUSTER + (uint32_t)__builtin_ctz(valid);
        }
    }
    v->counts->references += v->clusters;
    v->clusters = 0;
}

static void collect_clusters(loose_traversal *v, const uint32_t *number, uint32_t count)
{
    for (; count; count--, number++) {
        if (v->clusters == CLUSTERS)
            collect_triangles(v);
        v->cluster[v->clusters++] = *number;
    }
}

CGT_SPU_INLINE void collect(loose_traversal *v, const uint32_t *reference, uint32_t count)
{
    if (v->objects.world->cluster)
        collect_clusters(v, reference, count);
    else
        collect_run(v, reference, count);
}

/* A row of cells along x is one run. */
static void collect_slice(loose_traversal *v, const loose_slice *s)
{
    const frustum *f = &v->objects.frustum;
    const uint32_t low_u = (uint32_t)s->cells[0], high_u = (uint32_t)s->cells[1];
    const uint32_t low_v = (uint32_t)s->cells[2], high_v = (uint32_t)s->cells[3];
    uint32_t count;
    v->counts->slices++;
    v->counts->cells += (uint64_t)(high_u - low_u + 1) * (high_v - low_v + 1);
    for (uint32_t j = low_v; j <= high_v; j++) {
        if (f->w != 0) {
            const uint32_t y = f->w == 1 ? s->along : j, z = f->w == 1 ? j : s->along;
            const uint32_t *run = loose_run(v->march.grid, s->level, low_u, y, z, high_u - low_u, &count);
            collect(v, run, count);
            continue;
        }
        for (uint32_t i = low_u; i <= high_u; i++) {
            const uint32_t *run = loose_run(v->march.grid, s->level, s->along, i, j, 0, &count);
            collect(v, run, count);
        }
    }
}

static void march(loose_traversal *v)
{
    const float w0 = v->objects.frustum.w0;
    loose_march_level *l;
    float begin = 0;
    while ((l = loose_march_nearest(&v->march, &begin)) != NULL) {
        /* w_far has the slack of what it came from, and `begin` that of this difference */
        if (v->objects.w_far - w0 < begin) {
            v->counts->early_exits++;
            break;
        }
        const loose_slice s = loose_march_take(&v->march, l);
        if (s.cells[0] > s.cells[1] || s.cells[2] > s.cells[3])
            continue;
        collect_slice(v, &s);
        if (v->clusters)
            collect_triangles(v);
        if (v->pending < PENDING_ENOUGH)
            continue;
        test_pending(v);
        look_again(v);
    }
    if (v->pending)
        test_pending(v);
}

/* ---- packets ---- */

/* A packet whose rays spread over more cells of a slice than SPREAD times those that one ray needs, and a share of
 * that for each ray, is split. Measured with ambient occlusion of spheres and triangles, and with shadows; flat from
 * half to twice as many. */
#define SPREAD 4.f
#define SPREAD_CLUSTERS 2.f /* of clusters, which reach far, but are culled by themselves */
#define SPREAD_OF_RAY 0.3f
#define SPLIT_FAR 4.f /* times as many: the rays have little in common */
#define SPLIT_FAR_PARTS 8u

/* Into how many parts to split a packet, by the level with most objects, half way; 1: none. */
static uint32_t parts_of(const loose_traversal *v)
{
    const loose_march *m = &v->march;
    const frustum *f = m->frustum;
    const uint32_t rays = v->objects.p->rays;
    uint32_t most = 0;
    for (uint32_t i = 1; i < m->grid->levels; i++)
        most = m->grid->level[i].objects > m->grid->level[most].objects ? i : most;
    const loose_march_level *l = &m->level[most];
    if (rays < 2 || l->next >= l->end)
        return 1;
    const cgt_loose_level *from = &m->grid->level[most];
    const vec_int4 b = loose_march_cells(m, l, l->next + (l->end - l->next) / 2);
    if (b[1] < b[0] || b[3] < b[2])
        return 1;
    const float cells = (float)(b[1] - b[0] + 1) * (float)(b[3] - b[2] + 1);
    const float of_ray =
        (1 + 2 * from->reach[f->u] * from->rcell[f->u]) * (1 + 2 * from->reach[f->v] * from->rcell[f->v]);
    const float enough = v->objects.world->cluster ? of_ray * SPREAD_CLUSTERS + SPREAD_OF_RAY * (float)rays
                                                   : of_ray * (SPREAD + SPREAD_OF_RAY * (float)rays);
    return !(cells > enough) ? 1 : rays > SPLIT_FAR_PARTS && cells > SPLIT_FAR * enough ? SPLIT_FAR_PARTS : 2;
}

/* Traces rays with one main axis and sign; or returns into how many parts to split them first: 1 where that is done.
 * A function of its own, so that its stack is free again while parts are traced. */
__attribute__((noinline)) static uint32_t traverse(const cgt_world *world, packet *p, uint32_t class,
                                                   const cgt_trace_settings *settings, cgt_counts *counts)
{
    loose_traversal v;
    v.objects.world = world;
    v.objects.p = p;
    v.objects.counts = counts;
    v.objects.cull = settings->cull;
    v.objects.frustum = (frustum){0};
    v.counts = counts;
    v.pending = v.clusters = 0;
    loose_space_make(world, &v.objects.space);
    if (!frustum_make(&v.objects.space, p, (int)(class >> 1), class & 1, &v.objects.frustum))
        return 1;
    loose_march_make(&world->loose, &v.objects.space, &v.objects.frustum, &v.march);
    const uint32_t parts = parts_of(&v);
    if (parts > 1)
        return parts;
    counts->packets++;
    v.few = p->rays <= LANE_MOST_RAYS && !p->fast;
    if (v.few)
        lane_objects_make(world, p, counts, &v.lanes);
    packet_objects_make(&v.objects);
    march(&v);
    return 1;
}

/* Splits by main axis and sign first. */
void CGT_KERNEL(cgt_loose_grid_trace)(const cgt_world *world, packet *p, const cgt_trace_settings *settings,
                                      cgt_counts *counts)
{
    _Alignas(64) uint32_t class[PACKET_MAX_RAYS];
    class[0] = 0; /* there is at least one ray, which the compiler cannot know */
    packet_classify(p, class);
    if (!packet_all_equal(class, p->lanes)) {
        packet_trace_parts(world, p, class, PACKET_CLASSES, CGT_KERNEL(cgt_loose_grid_trace), settings, counts);
        return;
    }
    const uint32_t parts = traverse(world, p, class[0], settings, counts);
    if (parts > 1)
        packet_trace_split(world, p, parts, CGT_KERNEL(cgt_loose_grid_trace), settings, counts);
}
