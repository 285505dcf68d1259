/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Traces a camera's frame tile by tile: primitives of a loose grid, front to back, are rasterised over the pixels that
 * they may reach. The hits are the same as those of all other structures.
 *
 *   slice of cells    tile_march.h                     which cells the rays may need
 *   visible cells     tile_cull.h                      boxes against windows and occlusion
 *   references        prefetch_queue.h                 wait for the caches
 *   visible prims     tile_spheres.h, tile_triangles.h windows and occlusion, a vector at a time; tile_capsules.h, too
 *   pixels            tile_sphere_draw.h, ...          certain hits are stored, undecided ones queued
 *   the queue         tile_decide.c                    decided exactly
 *   planes            tile_resolve.c                   t, u, v and normals */
#include "kernel/packet/packet.h"
#include "kernel/tile/prefetch_queue.h"
#include "kernel/tile_draw/tile_capsule_pairs.h"
#include "kernel/tile_draw/tile_parallel_triangles.h"
#include "kernel/tile_draw/tile_sphere_draw.h"
#include "kernel/tile_draw/tile_triangle_draw.h"
#include "kernel/tile_frame/tile_cull.h"
#include "kernel/tile_frame/tile_planes.h"
#include "query/tile_limits.h"

#define REFRESH_INTERVAL 128u /* rasterised primitives between updates of the parts' far distances */
#define DOUBLE_SPHERES 64u    /* what a sphere in double precision counts for, which takes longer than an update */

#define MIN_CELL_REFERENCES 96u /* slices with fewer references: culling cells costs more than it saves */
#define MAX_RUNS 16u            /* of references, prefetched together */

typedef struct tile_work {
    const cgt_committed_scene *committed_scene;
    tile *t;
    tile_queue queue;
    cgt_counts *counts;
    prefetch_queues pending;
    prefetch_owner prefetch; /* of `pending` */
    uint32_t rasterised;     /* since the last refresh */
} tile_work;

/* ---- primitives ---- */

static void tile_refresh_depths(tile_work *w)
{
    CGT_KERNEL(cgt_tile_flush)(&w->committed_scene->prims, w->t, &w->queue, w->counts);
    tile_update_far_distances(w->t);
    w->rasterised = 0;
}

/* Counts references, of which some were rasterised; updates the far distances after enough of them. */
CGT_SPU_INLINE void tile_count_references(tile_work *w, uint32_t count, uint32_t rasterised)
{
    w->counts->references += count;
    w->counts->cull_tests += count;
    w->counts->culled += count - rasterised;
    w->rasterised += rasterised;
    if (w->rasterised >= REFRESH_INTERVAL)
        tile_refresh_depths(w);
}

CGT_SPU_INLINE uint32_t tile_rasterise_spheres(tile_work *w, const tile_spheres *s)
{
    const cgt_primitives *prims = &w->committed_scene->prims;
    /* small windows: without clipping */
    const unsigned small_lanes = s->small_lanes[1] & s->single_lanes;
    uint32_t rasterised = (uint32_t)__builtin_popcount(small_lanes);
    if (small_lanes & ~s->small_lanes[0])
        for (unsigned remaining = small_lanes; remaining; remaining &= remaining - 1)
            tile_rasterise_small_sphere(prims, w->t, s, __builtin_ctz(remaining), 4, &w->queue, w->counts);
    else
        for (unsigned remaining = small_lanes; remaining; remaining &= remaining - 1)
            tile_rasterise_small_sphere(prims, w->t, s, __builtin_ctz(remaining), 3, &w->queue, w->counts);
    /* all others, in single or double precision */
    for (unsigned remaining = (s->single_lanes | s->double_lanes) & ~small_lanes; remaining;
         remaining &= remaining - 1) {
        const int k = __builtin_ctz(remaining);
        tile_rect rect;
        if (!tile_clip_window(w->t, &s->window, k, s->min_distance[k], &rect))
            continue;
        rasterised++;
        if (s->single_lanes >> k & 1)
            tile_rasterise_sphere(prims, w->t, s, k, rect, &w->queue, w->counts);
        else {
            CGT_KERNEL(cgt_tile_rasterise_double)(prims, w->t, s->prim[k], rect, &w->queue, w->counts);
            w->rasterised += DOUBLE_SPHERES - 1;
            if (w->rasterised >= REFRESH_INTERVAL)
                tile_refresh_depths(w);
        }
    }
    return rasterised;
}

/* At most TILE_MAX_VISIBLE references; `parallel` is a constant. Returns how many were rasterised. */
CGT_SPU_INLINE uint32_t tile_test_spheres_by_kind(tile_work *w, const uint32_t *reference, uint32_t count,
                                                  bool parallel)
{
    vfloat sphere[4];
    tile_visible_spheres visible;
    tile_spheres s;
    uint32_t rasterised = 0;
    visible.count = 0;
    /* cull all vectors first: the visible ones fill vectors of their own */
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        const vuint prim = load_references(reference + k, count - k);
        gather_scene_spheres(&w->committed_scene->prims, prim, sphere);
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

/* Not inlined: keeps the code for perspective short. */
__attribute__((noinline)) static uint32_t tile_test_parallel_spheres(tile_work *w, const uint32_t *reference,
                                                                     uint32_t count)
{
    return tile_test_spheres_by_kind(w, reference, count, true);
}

static void tile_test_spheres(void *owner, const uint32_t *reference, uint32_t count)
{
    tile_work *w = owner;
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
        const tile_rect rect = tile_window_rect(&s->window, k);
        if (!(tile_window_parts(&s->window, k) & tile_visible_parts(w->t, s->min_distance[k])))
            continue;
        rasterised++;
        CGT_KERNEL(cgt_tile_rasterise_double)(prims, w->t, s->prim[k], rect, &w->queue, w->counts);
    }
    return rasterised;
}

__attribute__((noinline)) static void tile_test_parallel_triangles(tile_work *w, const uint32_t *reference,
                                                                   uint32_t count)
{
    vfloat vertex[3][3];
    tile_triangles s;
    spux_store_uint(s.prim, load_references(reference, count));
    gather_scene_triangles(&w->committed_scene->prims, s.prim, vertex);
    tile_init_parallel_triangles(w->t, vertex, first_lanes(count), &s);
    tile_count_references(w, count,
                          s.single_lanes | s.double_lanes ? tile_rasterise_triangles(w, &s, TILE_PARALLEL) : 0);
}

static void tile_test_triangles(void *owner, const uint32_t *reference, uint32_t count)
{
    tile_work *w = owner;
    vfloat vertex[3][3];
    tile_triangles s;
    uint32_t rasterised = 0;
    if (w->t->parallel) {
        tile_test_parallel_triangles(w, reference, count);
        return;
    }
    spux_store_uint(s.prim, load_references(reference, count));
    gather_scene_triangles(&w->committed_scene->prims, s.prim, vertex);
    tile_init_triangles(w->t, vertex, first_lanes(count), &s);
    if (s.single_lanes | s.double_lanes)
        rasterised = w->t->linear ? tile_rasterise_triangles(w, &s, TILE_LINEAR)
                                  : tile_rasterise_triangles(w, &s, TILE_PERSPECTIVE);
    tile_count_references(w, count, rasterised);
}

/* Not inlined: most scenes have none. */
__attribute__((noinline)) static void tile_test_capsules(void *owner, const uint32_t *reference, uint32_t count)
{
    tile_work *w = owner;
    const cgt_primitives *prims = &w->committed_scene->prims;
    tile_capsules s;
    const tile_capsule_draw draw = {prims, w->t, &s, reference, &w->queue, w->counts};
    tile_cull_capsules(w->t, reference, count, prims, &s);
    if (s.visible)
        tile_ensure_pixels(w->t);
    tile_count_references(w, count,
                          w->t->parallel ? tile_draw_capsules(&draw, true) : tile_draw_capsules(&draw, false));
}

/* In a crowd, such as of capsules one within the other, brings the nearest one to the front: most others are then known
 * to lie behind it, where they would be decided in double, one after the other, as the nearest ones so far. */
static void tile_order_crowd(void *owner, uint32_t *reference, uint32_t count)
{
    const tile_work *w = owner;
    uint32_t nearest = 0;
    float least = INFINITY;
    if (!w->queue.has_overflowed)
        return;
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        const uint32_t lanes = count - k < CGT_LANES ? count - k : CGT_LANES;
        _Alignas(CGT_VECTOR_BYTES) float distance[CGT_LANES];
        vfloat d[7];
        gather_scene_capsules(&w->committed_scene->prims, reference + k, lanes, d);
        spux_store(distance, tile_order_capsules(w->t, d));
        for (uint32_t i = 0; i < lanes; i++)
            if (distance[i] < least) {
                least = distance[i];
                nearest = k + i;
            }
    }
    const uint32_t first = reference[0];
    reference[0] = reference[nearest];
    reference[nearest] = first;
}

/* The visible ones of at most a vector of clusters, as bits. */
static unsigned tile_test_clusters(void *owner, const uint32_t *reference, uint32_t count)
{
    tile_work *w = owner;
    const unsigned visible = tile_visible_clusters(w->t, w->committed_scene->cluster, reference, count);
    w->counts->references += count;
    w->counts->cull_tests += count;
    w->counts->culled += count - spux_count_bits(visible);
    return visible;
}

static bool tile_is_done(const void *owner)
{
    (void)owner;
    return false;
}

static const prefetch_tests tile_tests = {TILE_MAX_VISIBLE, tile_test_spheres,  tile_test_triangles, tile_test_clusters,
                                          tile_is_done,     tile_test_capsules, tile_order_crowd};

/* Drains whole vectors: the remainder is tested with the next slice. */
static void tile_drain_whole_vectors(tile_work *w)
{
    prefetch_drain_clusters(&w->prefetch, &tile_tests, w->pending.clusters.count / CGT_LANES * CGT_LANES);
    prefetch_drain_spheres(&w->prefetch, &tile_tests, w->pending.spheres.count / CGT_LANES * CGT_LANES);
    prefetch_drain_triangles(&w->prefetch, &tile_tests, w->pending.triangles.count / CGT_LANES * CGT_LANES);
    if (w->pending.capsules.count >= CGT_LANES)
        prefetch_drain_capsules(&w->prefetch, &tile_tests, w->pending.capsules.count / CGT_LANES * CGT_LANES);
}

/* Runs of references whose cache lines are prefetched before the first one is read. */
typedef struct runs {
    const uint32_t *reference[MAX_RUNS];
    uint32_t count[MAX_RUNS], runs;
} runs;

static void tile_flush_runs(tile_work *w, runs *r)
{
    for (uint32_t k = 0; k < r->runs; k++)
        prefetch_append_run(&w->prefetch, &tile_tests, r->reference[k], r->count[k]);
    r->runs = 0;
}

CGT_SPU_INLINE void tile_append_run(tile_work *w, runs *r, const uint32_t *reference, uint32_t count)
{
    const uint32_t last = r->runs - 1;
    for (size_t i = 0; i < count; i += 16)
        __builtin_prefetch(reference + i);
    if (r->runs && r->reference[last] + r->count[last] == reference) { /* cells side by side: one run */
        r->count[last] += count;
        return;
    }
    if (r->runs == MAX_RUNS)
        tile_flush_runs(w, r);
    r->reference[r->runs] = reference;
    r->count[r->runs++] = count;
}

/* Collects the references of the slice's visible cells. */
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

/* Collects whole rows of cells if there are few references, otherwise the visible cells. */
static void tile_visit_slice(tile_work *w, const tile_march *m, const tile_slice *s)
{
    const uint32_t rows = tile_slice_run_count(m, s);
    uint32_t count, references = 0;
    runs r;
    r.runs = 0;
    /* are there few references? */
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
    prefetch_drain_all(&w->prefetch, &tile_tests);
    CGT_KERNEL(cgt_tile_flush)(&w->committed_scene->prims, w->t, &w->queue, w->counts);
}

/* ---- the tile ---- */

__attribute__((noinline)) static void tile_trace_region(const cgt_committed_scene *committed_scene,
                                                        const cgt_camera_rays *camera,
                                                        const cgt_trace_settings *settings, const cgt_region *region,
                                                        tile_seam *seam, cgt_counts *counts)
{
    tile *t = cgt_scratch_take(counts->scratch, sizeof *t);
    tile_work *w = cgt_scratch_take(counts->scratch, sizeof *w); /* large: set field by field */
    w->committed_scene = committed_scene;
    w->t = t;
    w->queue.entries = 0;
    w->queue.has_overflowed = false;
    w->counts = counts;
    w->rasterised = 0;
    w->prefetch = (prefetch_owner){committed_scene, &w->pending, w};
    prefetch_queues_clear(&w->pending);
    CGT_KERNEL(cgt_tile_init)(t, committed_scene, camera, region);
    tile_march_grid(w);
    counts->tiles++;
    counts->rays += (uint64_t)region->width * region->height;
    CGT_KERNEL(cgt_tile_resolve)(committed_scene, t, settings, region, seam, counts);
    cgt_scratch_return(counts->scratch, t);
}

/* A row of tiles side by side, which share lines of the planes. */
static void tile_trace_row(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                           const cgt_trace_settings *settings, const cgt_region *row, cgt_counts *counts)
{
    tile_seam *seam = cgt_scratch_take(counts->scratch, sizeof *seam); /* large: set field by field */
    for (uint32_t x = 0; x < row->width; x += TILE_EDGE) {
        const cgt_region part = cgt_region_part(row, x, 0, TILE_EDGE, TILE_EDGE);
        seam->left = x > 0;
        seam->right = x + TILE_EDGE < row->width;
        tile_trace_region(committed_scene, camera, settings, &part,
                          tile_resolves_array(&committed_scene->prims) ? seam : NULL, counts);
    }
    cgt_scratch_return(counts->scratch, seam);
}

void CGT_KERNEL(cgt_trace_tile)(const cgt_committed_scene *committed_scene, const cgt_camera_rays *camera,
                                const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts)
{
    for (uint32_t y = 0; y < region->height; y += TILE_EDGE) {
        const cgt_region row = cgt_region_part(region, 0, y, region->width, TILE_EDGE);
        if (row.width <= TILE_EDGE)
            tile_trace_region(committed_scene, camera, settings, &row, NULL, counts);
        else
            tile_trace_row(committed_scene, camera, settings, &row, counts);
    }
}
