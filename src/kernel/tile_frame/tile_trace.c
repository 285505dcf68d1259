/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's frame tile by tile: objects of a loose grid, front to back, to the pixels that they may reach. The hits are
 * those that every other way finds. */
#include "kernel/tile_frame/tile_cells.h"
#include "kernel/tile_draw/tile_double.h"
#include "kernel/tile_draw/tile_sphere_draw.h"
#include "kernel/tile_frame/tile_make.h"
#include "kernel/tile_frame/tile_resolve.h"
#include "kernel/tile_draw/tile_triangle_draw.h"
#include "kernel/tile/prefetch_queue.h"

#define REFRESH_INTERVAL 128u /* objects after which it pays to look how far the parts still see */

#define MIN_CELL_REFERENCES 96u /* references of a slice: to look at cells costs more */
#define MAX_RUNS 16u            /* of references, looked up together */

typedef struct tile_work {
    const cgt_committed_scene *committed_scene;
    tile *t;
    tile_queue queue;
    cgt_counts *counts;
    prefetch_queues pending;
    uint32_t rasterised; /* since the last refresh */
} tile_work;

/* ---- objects ---- */

static void tile_refresh_depths(tile_work *w)
{
    tile_flush(&w->committed_scene->prims, w->t, &w->queue, w->counts);
    tile_update_far_distances(w->t);
    w->rasterised = 0;
}

/* Counts a vector of references of which some are drawn; refreshes what the tile knows after enough of them. */
CGT_SPU_INLINE void tile_count_references(tile_work *w, uint32_t count, uint32_t rasterised)
{
    w->counts->references += count;
    w->counts->cull_tests += count;
    w->counts->culled += count - rasterised;
    w->rasterised += rasterised;
    if (w->rasterised >= REFRESH_INTERVAL)
        tile_refresh_depths(w);
}

CGT_SPU_INLINE uint32_t tile_clamp_lanes(uint32_t count) { return count < CGT_LANES ? count : CGT_LANES; }

CGT_SPU_INLINE uint32_t tile_rasterise_spheres(tile_work *w, const tile_spheres *s)
{
    const cgt_primitives *prims = &w->committed_scene->prims;
    const unsigned small_lanes = s->small_lanes[1] & s->single_lanes;
    uint32_t rasterised = (uint32_t)__builtin_popcount(small_lanes);
    if (small_lanes & ~s->small_lanes[0])
        for (unsigned remaining = small_lanes; remaining; remaining &= remaining - 1)
            tile_rasterise_small_sphere(prims, w->t, s, __builtin_ctz(remaining), 4, &w->queue, w->counts);
    else
        for (unsigned remaining = small_lanes; remaining; remaining &= remaining - 1)
            tile_rasterise_small_sphere(prims, w->t, s, __builtin_ctz(remaining), 3, &w->queue, w->counts);
    for (unsigned remaining = (s->single_lanes | s->double_lanes) & ~small_lanes; remaining;
         remaining &= remaining - 1) {
        const int k = __builtin_ctz(remaining);
        tile_rect rect;
        if (!tile_clip_window(w->t, s, k, &rect))
            continue;
        rasterised++;
        if (s->single_lanes >> k & 1)
            tile_rasterise_sphere(prims, w->t, s, k, rect, &w->queue, w->counts);
        else
            tile_rasterise_double(prims, w->t, s->prim[k], rect, &w->queue, w->counts);
    }
    return rasterised;
}

/* At most TILE_MAX_VISIBLE references; parallel is a constant. Returns how many were drawn. */
CGT_SPU_INLINE uint32_t tile_test_spheres_by_kind(tile_work *w, const uint32_t *reference, uint32_t count,
                                                  bool parallel)
{
    vfloat sphere[4];
    vuint prim;
    tile_visible_spheres visible;
    tile_spheres s;
    uint32_t rasterised = 0;
    visible.count = 0;
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        tile_gather_spheres(&w->committed_scene->prims, reference + k, tile_clamp_lanes(count - k), sphere, &prim);
        if (parallel)
            tile_cull_parallel_spheres(w->t, sphere, prim, count - k, &visible);
        else
            tile_cull_spheres(w->t, sphere, prim, count - k, &visible);
    }
    if (visible.count)
        tile_ensure_pixels(w->t);
    for (uint32_t k = 0; k < visible.count; k += CGT_LANES) {
        if (parallel)
            tile_init_parallel_spheres(w->t, &visible, k, &s);
        else
            tile_init_spheres(w->t, &visible, k, &s);
        rasterised += tile_rasterise_spheres(w, &s);
    }
    return rasterised;
}

/* A function of its own: what perspective takes stays as short as it is. */
__attribute__((noinline)) static uint32_t tile_test_parallel_spheres(tile_work *w, const uint32_t *reference,
                                                                     uint32_t count)
{
    return tile_test_spheres_by_kind(w, reference, count, true);
}

static void tile_test_spheres(tile_work *w, const uint32_t *reference, uint32_t count)
{
    const bool parallel = w->t->parallel;
    tile_count_references(w, count,
                          parallel ? tile_test_parallel_spheres(w, reference, count)
                                   : tile_test_spheres_by_kind(w, reference, count, false));
}

CGT_SPU_INLINE uint32_t tile_rasterise_triangles(tile_work *w, const tile_triangles *s, tile_kind kind)
{
    const cgt_primitives *prims = &w->committed_scene->prims;
    uint32_t rasterised = 0;
    tile_ensure_pixels(w->t);
    for (unsigned remaining = s->single_lanes; remaining; remaining &= remaining - 1)
        rasterised += tile_rasterise_triangle(prims, w->t, s, __builtin_ctz(remaining), kind, &w->queue, w->counts);
    for (unsigned remaining = s->double_lanes; remaining; remaining &= remaining - 1) {
        const int k = __builtin_ctz(remaining);
        const tile_rect rect = {.x0 = s->x0[k], .x1 = s->x1[k], .y0 = s->y0[k], .y1 = s->y1[k]};
        if (!(tile_window_parts(s, k) & tile_visible_parts(w->t, s->min_distance[k])))
            continue;
        rasterised++;
        tile_rasterise_double(prims, w->t, s->prim[k], rect, &w->queue, w->counts);
    }
    return rasterised;
}

__attribute__((noinline)) static void tile_test_parallel_triangles(tile_work *w, const uint32_t *reference,
                                                                   uint32_t count)
{
    vfloat vertex[3][3];
    tile_triangles s;
    tile_load_references(reference, count, s.prim);
    tile_gather_triangles(&w->committed_scene->prims, s.prim, vertex);
    tile_init_parallel_triangles(w->t, vertex, tile_first_lanes(count), &s);
    tile_count_references(w, count,
                          s.single_lanes | s.double_lanes ? tile_rasterise_triangles(w, &s, TILE_PARALLEL) : 0);
}

static void tile_test_triangles(tile_work *w, const uint32_t *reference, uint32_t count)
{
    vfloat vertex[3][3];
    tile_triangles s;
    uint32_t rasterised = 0;
    if (w->t->parallel) {
        tile_test_parallel_triangles(w, reference, count);
        return;
    }
    tile_load_references(reference, count, s.prim);
    tile_gather_triangles(&w->committed_scene->prims, s.prim, vertex);
    tile_init_triangles(w->t, vertex, tile_first_lanes(count), &s);
    if (s.single_lanes | s.double_lanes)
        rasterised = w->t->linear ? tile_rasterise_triangles(w, &s, TILE_LINEAR)
                                  : tile_rasterise_triangles(w, &s, TILE_PERSPECTIVE);
    tile_count_references(w, count, rasterised);
}

/* Takes the first of the references that wait; what is left over moves up. */
static void tile_drain_spheres(void *owner, uint32_t count)
{
    tile_work *w = owner;
    prefetch_queue *q = &w->pending.spheres;
    for (uint32_t k = 0; k < count; k += TILE_MAX_VISIBLE)
        tile_test_spheres(w, q->reference + k, count - k < TILE_MAX_VISIBLE ? count - k : TILE_MAX_VISIBLE);
    prefetch_queue_remove(q, count);
}

/* The same, with the vertices of some vectors on their way. */
static void tile_drain_triangles(void *owner, uint32_t count)
{
    tile_work *w = owner;
    prefetch_queue *q = &w->pending.triangles;
    uint32_t prefetched = 0;
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        prefetched = prefetch_queue_vertices(q, &w->committed_scene->prims, k, count, prefetched);
        tile_test_triangles(w, q->reference + k, tile_clamp_lanes(count - k));
    }
    prefetch_queue_remove(q, count);
}

/* Takes the first of the clusters that wait: the triangles of those that the tile wants wait then. */
static void tile_drain_clusters(void *owner, uint32_t count)
{
    tile_work *w = owner;
    const cgt_cluster *cluster = w->committed_scene->cluster;
    prefetch_queue *q = &w->pending.clusters;
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        const uint32_t lane_count = tile_clamp_lanes(count - k);
        unsigned remaining = tile_visible_clusters(w->t, cluster, q->reference + k, lane_count);
        w->counts->references += lane_count;
        w->counts->cull_tests += lane_count;
        w->counts->culled += lane_count - spux_count_bits(remaining);
        for (; remaining; remaining &= remaining - 1) {
            const uint32_t number = q->reference[k + (uint32_t)__builtin_ctz(remaining)];
            if (w->pending.triangles.count > PREFETCH_QUEUE_CAPACITY - CGT_CLUSTER)
                tile_drain_triangles(w, PREFETCH_QUEUE_CAPACITY / 2);
            prefetch_append_members(&w->pending.triangles, &w->committed_scene->prims, number, cluster[number].valid);
        }
    }
    prefetch_queue_remove(q, count);
}

static const prefetch_drain_fns tile_drain_fns = {tile_drain_spheres, tile_drain_triangles, tile_drain_clusters};

/* Whole vectors: what is left over comes with the next slice. */
static void tile_drain_whole_vectors(tile_work *w)
{
    tile_drain_clusters(w, w->pending.clusters.count / CGT_LANES * CGT_LANES);
    tile_drain_spheres(w, w->pending.spheres.count / CGT_LANES * CGT_LANES);
    tile_drain_triangles(w, w->pending.triangles.count / CGT_LANES * CGT_LANES);
}

/* Runs of references, some looked up ahead, so that they come to the cache, too. */
typedef struct runs {
    const uint32_t *reference[MAX_RUNS];
    uint32_t count[MAX_RUNS], runs;
} runs;

static void tile_flush_runs(tile_work *w, runs *r)
{
    for (uint32_t k = 0; k < r->runs; k++)
        prefetch_append_run(&w->pending, w->committed_scene, r->reference[k], r->count[k], tile_drain_fns, w);
    r->runs = 0;
}

CGT_SPU_INLINE void tile_append_run(tile_work *w, runs *r, const uint32_t *reference, uint32_t count)
{
    const uint32_t last = r->runs - 1;
    for (uint32_t i = 0; i < count; i += 16)
        __builtin_prefetch(reference + i);
    if (r->runs && r->reference[last] + r->count[last] == reference) { /* cells side by side */
        r->count[last] += count;
        return;
    }
    if (r->runs == MAX_RUNS)
        tile_flush_runs(w, r);
    r->reference[r->runs] = reference;
    r->count[r->runs++] = count;
}

/* The references of the cells that the tile wants. */
static void tile_visit_cells(tile_work *w, const tile_march *m, const tile_slice *s, runs *r)
{
    const tile_cells c = tile_init_cells(w->t, m, s);
    const uint32_t *start = m->grid->start;
    for (uint32_t first = 0; first < c.count; first += CGT_LANES)
        for (unsigned remaining = tile_visible_cells(w->t, &c, first); remaining; remaining &= remaining - 1) {
            const uint32_t cell = tile_cell_index(&c, first + (uint32_t)__builtin_ctz(remaining));
            tile_append_run(w, r, m->grid->prim + start[cell], start[cell + 1] - start[cell]);
        }
}

/* Runs of whole rows where there are few references, else the cells that are wanted. */
static void tile_visit_slice(tile_work *w, const tile_march *m, const tile_slice *s)
{
    const uint32_t rows = tile_slice_run_count(m, s);
    uint32_t count, references = 0;
    runs r;
    r.runs = 0;
    for (uint32_t k = 0; k < rows && references < MIN_CELL_REFERENCES; k++) {
        tile_slice_get_run(m, s, k, &count);
        references += count;
    }
    if (m->brute_force || references < MIN_CELL_REFERENCES)
        for (uint32_t k = 0; k < rows; k++) {
            const uint32_t *reference = tile_slice_get_run(m, s, k, &count);
            tile_append_run(w, &r, reference, count);
        }
    else
        tile_visit_cells(w, m, s, &r);
    tile_flush_runs(w, &r);
    tile_drain_whole_vectors(w);
}

static void tile_march_grid(tile_work *w)
{
    tile_march m;
    tile_slice s;
    tile_march_init(w->t, &w->committed_scene->loose, &m);
    while (tile_march_next_slice(&m, &s)) {
        if (w->rasterised)
            tile_refresh_depths(w);
        if (s.near_t > (double)w->t->max_far_t) {
            w->counts->early_exits++;
            break;
        }
        w->counts->slices++;
        tile_visit_slice(w, &m, &s);
    }
    tile_drain_clusters(w, w->pending.clusters.count);
    tile_drain_spheres(w, w->pending.spheres.count);
    tile_drain_triangles(w, w->pending.triangles.count);
    tile_flush(&w->committed_scene->prims, w->t, &w->queue, w->counts);
}

/* ---- the tile ---- */

static void tile_trace_region(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                              const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts)
{
    tile t;
    tile_work w; /* large: not all of it is set */
    w.committed_scene = committed_scene;
    w.t = &t;
    w.queue.entries = 0;
    w.counts = counts;
    w.rasterised = 0;
    prefetch_queues_clear(&w.pending);
    tile_init(&t, committed_scene, camera, region);
    tile_march_grid(&w);
    counts->tiles++;
    counts->rays += (uint64_t)region->width * region->height;
    tile_resolve(committed_scene, &t, settings, region, counts);
}

void CGT_KERNEL(cgt_trace_tile)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                                const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts)
{
    for (uint32_t y = 0; y < region->height; y += TILE_EDGE)
        for (uint32_t x = 0; x < region->width; x += TILE_EDGE) {
            const cgt_region part = cgt_region_part(region, x, y, TILE_EDGE, TILE_EDGE);
            tile_trace_region(committed_scene, camera, settings, &part, counts);
        }
}
