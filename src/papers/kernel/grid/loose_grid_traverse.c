/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Coherent traversal of a loose grid by a packet of any rays of one main axis: slice by slice, all levels together, the
 * references of the cells that the packet's frustum touches are collected; a vector of primitives at a time is culled
 * and what is left tested against the rays. The packet is done when every ray's hit lies before the next slice. Few
 * rays are tested one by one against a vector of primitives at a time. */
#include "papers/kernel/grid/lane_prims.h"
#include "papers/kernel/grid/loose_grid_march.h"
#include "kernel/primitive/gather_primitives.h"
#include "papers/kernel/grid/packet_prims.h"
#include "papers/kernel/packet/packet_split.h"

/* References that are tested before the next slice: fewer wait for more, since a vector costs the same when it is not
 * full. */
#define PENDING_FLUSH CGT_LANES

#define MAX_CLUSTERS 64u /* collected in a slice, before their triangles are */

typedef struct loose_traversal {
    packet_prims prims;
    loose_grid_march march;
    cgt_counts *counts;
    bool few_rays; /* rays */
    lane_prims lanes;
    uint32_t pending; /* references collected and not yet tested */
    _Alignas(64) uint32_t reference[PACKET_MAX_PRIMS];
    uint32_t clusters, cluster[MAX_CLUSTERS]; /* of which the triangles are not */
} loose_traversal;

/* ---- testing ---- */

/* Tests what was collected, and looks how far the rays still look. */
static void flush_pending(loose_traversal *v)
{
    v->counts->references += v->pending;
    if (v->few_rays)
        lane_prims_test(&v->lanes, v->reference, v->pending);
    else
        packet_test_prims(&v->prims, v->reference, v->pending);
    v->pending = 0;
}

static void update_w_far(loose_traversal *v) { v->prims.w_far = packet_max_w(&v->prims); }

/* ---- collecting ---- */

CGT_SPU_INLINE void collect_run(loose_traversal *v, const uint32_t *prim, uint32_t count)
{
    while (count) {
        const uint32_t room = PACKET_MAX_PRIMS - v->pending, batch = count < room ? count : room;
        for (uint32_t k = 0; k < batch; k++)
            v->reference[v->pending + k] = prim[k];
        v->pending += batch;
        prim += batch;
        count -= batch;
        if (v->pending == PACKET_MAX_PRIMS)
            flush_pending(v);
    }
}

/* Returns the lanes whose cluster lies outside the frustum, or before or beyond the ranges of its rays. */
static unsigned clusters_outside(const packet_prims *v, const uint32_t *number, uint32_t count)
{
    const frustum *f = &v->frustum;
    const int axis[3] = {f->w, f->u, f->v};
    const vfloat error = spux_vfloat(f->plane_error);
    _Alignas(CGT_VECTOR_BYTES) float middle[3][CGT_LANES];
    vfloat d[8], half[3];
    gather_cluster_list(v->committed_scene->cluster, number, count, d);
    for (int a = 0; a < 3; a++) {
        spux_store(middle[a], d[a]);
        half[a] = spu_mul(d[4 + axis[a]], spux_vfloat(v->space.rcell[axis[a]] * (1 + 0x1p-20f)));
    }
    const frustum_points p = frustum_coordinates(v, (const float(*)[CGT_LANES])middle);
    const vfloat reach = spu_add(half[0], error);
    vmask outside = spu_or(spu_cmpgt(spu_sub(p.w, reach), spux_vfloat(v->w_far)),
                           spu_cmpgt(spux_vfloat(f->w_near), spu_add(p.w, reach)));
    for (int k = 0; k < 4; k++) {
        const vfloat most =
            spu_add(spu_madd(half[0], spux_vfloat(__builtin_fabsf(f->step[k])), half[1 + k / 2]), error);
        outside = spu_or(outside, spu_cmpgt(spux_vfloat(0), spu_add(frustum_bound_distance(v, &p, k), most)));
    }
    return spux_mask_bits(outside);
}

/* The triangles of the clusters that were collected, of those that the frustum touches. */
static void collect_triangles(loose_traversal *v)
{
    const cgt_cluster *cluster = v->prims.committed_scene->cluster;
    for (uint32_t i = 0; i < v->clusters; i += CGT_LANES) {
        const uint32_t remaining = v->clusters - i, count = remaining < CGT_LANES ? remaining : CGT_LANES;
        const uint32_t *number = v->cluster + i;
        unsigned lanes = CGT_ALL_LANES >> (CGT_LANES - count);
        if (v->prims.cull != CGT_CULL_NONE)
            lanes = count_culled(&v->prims, lanes, clusters_outside(&v->prims, number, count), count);
        for (; lanes; lanes &= lanes - 1) {
            const uint32_t k = number[__builtin_ctz(lanes)];
            if (PACKET_MAX_PRIMS - v->pending < CGT_CLUSTER)
                flush_pending(v);
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
        if (v->clusters == MAX_CLUSTERS)
            collect_triangles(v);
        v->cluster[v->clusters++] = *number;
    }
}

CGT_SPU_INLINE void collect(loose_traversal *v, const uint32_t *reference, uint32_t count)
{
    if (v->prims.committed_scene->cluster)
        collect_clusters(v, reference, count);
    else
        collect_run(v, reference, count);
}

/* A row of cells along x is one run. */
static void collect_slice(loose_traversal *v, const loose_grid_slice *s)
{
    const frustum *f = &v->prims.frustum;
    const uint32_t low_u = (uint32_t)s->cells[0], high_u = (uint32_t)s->cells[1];
    const uint32_t low_v = (uint32_t)s->cells[2], high_v = (uint32_t)s->cells[3];
    uint32_t count;
    v->counts->slices++;
    v->counts->cells += (uint64_t)(high_u - low_u + 1) * (high_v - low_v + 1);
    for (uint32_t j = low_v; j <= high_v; j++) {
        if (f->w != 0) {
            const uint32_t y = f->w == 1 ? s->w_cell : j, z = f->w == 1 ? j : s->w_cell;
            const uint32_t *run = loose_grid_cell_run(v->march.grid, s->level, low_u, y, z, high_u - low_u, &count);
            collect(v, run, count);
            continue;
        }
        for (uint32_t i = low_u; i <= high_u; i++) {
            const uint32_t *run = loose_grid_cell_run(v->march.grid, s->level, s->w_cell, i, j, 0, &count);
            collect(v, run, count);
        }
    }
}

static void march(loose_traversal *v)
{
    const float w0 = v->prims.frustum.w0;
    loose_grid_march_level *l;
    float slice_start = 0;
    while ((l = loose_grid_march_nearest(&v->march, &slice_start)) != NULL) {
        /* w_far has the slack of what it came from, and `begin` that of this difference */
        if (v->prims.w_far - w0 < slice_start) {
            v->counts->early_exits++;
            break;
        }
        const loose_grid_slice s = loose_grid_march_next_slice(&v->march, l);
        if (s.cells[0] > s.cells[1] || s.cells[2] > s.cells[3])
            continue;
        collect_slice(v, &s);
        if (v->clusters)
            collect_triangles(v);
        if (v->pending < PENDING_FLUSH)
            continue;
        flush_pending(v);
        update_w_far(v);
    }
    if (v->pending)
        flush_pending(v);
}

/* ---- packets ---- */

/* A packet whose rays spread over more cells of a slice than MAX_SPREAD times those that one ray needs, and a share of
 * that for each ray, is split. Measured with ambient occlusion of spheres and triangles, and with shadows; flat from
 * half to twice as many. */
#define MAX_SPREAD 4.f
#define MAX_SPREAD_CLUSTERS 2.f /* of clusters, which reach far, but are culled by themselves */
#define MAX_SPREAD_PER_RAY 0.3f
#define SPLIT_INCOHERENT 4.f /* times as many: the rays have little in common */
#define SPLIT_INCOHERENT_PARTS 8u

/* Into how many parts to split a packet, by the level with most primitives, half way; 1: none. */
static uint32_t choose_parts(const loose_traversal *v)
{
    const loose_grid_march *m = &v->march;
    const frustum *f = m->frustum;
    const uint32_t rays = v->prims.p->rays;
    uint32_t most = 0;
    for (uint32_t i = 1; i < m->grid->levels; i++)
        most = m->grid->level[i].prims > m->grid->level[most].prims ? i : most;
    const loose_grid_march_level *l = &m->level[most];
    if (rays < 2 || l->next >= l->end)
        return 1;
    const cgt_loose_level *from = &m->grid->level[most];
    const vec_int4 b = loose_grid_march_cells(m, l, l->next + (l->end - l->next) / 2);
    if (b[1] < b[0] || b[3] < b[2])
        return 1;
    const float cells = (float)(b[1] - b[0] + 1) * (float)(b[3] - b[2] + 1);
    const float ray_cells =
        (1 + 2 * from->reach[f->u] * from->rcell[f->u]) * (1 + 2 * from->reach[f->v] * from->rcell[f->v]);
    const float max_cells = v->prims.committed_scene->cluster
                                ? ray_cells * MAX_SPREAD_CLUSTERS + MAX_SPREAD_PER_RAY * (float)rays
                                : ray_cells * (MAX_SPREAD + MAX_SPREAD_PER_RAY * (float)rays);
    return !(cells > max_cells)                                                    ? 1
           : rays > SPLIT_INCOHERENT_PARTS && cells > SPLIT_INCOHERENT * max_cells ? SPLIT_INCOHERENT_PARTS
                                                                                   : 2;
}

/* Traces rays with one main axis and sign, and returns 1; or returns into how many parts to split them first. A
 * separate function, so that its stack is free while the parts are traced. */
__attribute__((noinline)) static uint32_t traverse(const cgt_committed_scene *committed_scene, packet *p,
                                                   uint32_t class, const cgt_trace_settings *settings,
                                                   cgt_counts *counts)
{
    loose_traversal v;
    v.prims.committed_scene = committed_scene;
    v.prims.p = p;
    v.prims.counts = counts;
    v.prims.cull = settings->cull;
    v.prims.frustum = (frustum){0};
    v.counts = counts;
    v.pending = v.clusters = 0;
    loose_grid_init_space(committed_scene, &v.prims.space);
    if (!frustum_init(&v.prims.space, p, (int)(class >> 1), class & 1, &v.prims.frustum))
        return 1;
    loose_grid_march_init(&committed_scene->loose, &v.prims.space, &v.prims.frustum, &v.march);
    const uint32_t parts = choose_parts(&v);
    if (parts > 1)
        return parts;
    counts->packets++;
    v.few_rays = p->rays <= LANE_MAX_RAYS && !p->fast;
    if (v.few_rays)
        lane_prims_init(committed_scene, p, counts, &v.lanes);
    packet_prims_init(&v.prims);
    march(&v);
    return 1;
}

/* Splits by main axis and sign first. */
void CGT_KERNEL(cgt_loose_grid_trace)(const cgt_committed_scene *committed_scene, packet *p,
                                      const cgt_trace_settings *settings, cgt_counts *counts)
{
    _Alignas(64) uint32_t class[PACKET_MAX_RAYS];
    class[0] = 0; /* there is at least one ray, which the compiler cannot know */
    packet_classify(p, class);
    if (!packet_all_equal(class, p->lanes)) {
        packet_trace_parts(committed_scene, p, class, PACKET_CLASSES, CGT_KERNEL(cgt_loose_grid_trace), settings,
                           counts);
        return;
    }
    const uint32_t parts = traverse(committed_scene, p, class[0], settings, counts);
    if (parts > 1)
        packet_trace_split(committed_scene, p, parts, CGT_KERNEL(cgt_loose_grid_trace), settings, counts);
}
