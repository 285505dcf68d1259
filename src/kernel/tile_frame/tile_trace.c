/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's frame tile by tile: objects of a loose grid, front to back, to the pixels that they may reach. The hits are
 * those that every other way finds. */
#include "query/tile_limits.h"
#include "kernel/tile_frame/tile_cells.h"
#include "kernel/tile_draw/tile_double.h"
#include "kernel/tile_draw/tile_sphere_draw.h"
#include "kernel/tile_frame/tile_make.h"
#include "kernel/tile_frame/tile_resolve.h"
#include "kernel/tile_draw/tile_triangle_draw.h"
#include "kernel/tile/prefetch_queue.h"

#define DRAWN 128u /* objects after which it pays to look how far the parts still see */

#define FEW 96u  /* references of a slice: to look at cells costs more */
#define RUNS 16u /* of references, looked up together */

typedef struct tile_work {
    const cgt_world *world;
    tile *t;
    tile_queue queue;
    cgt_counts *counts;
    waiting_lists waits;
    uint32_t drawn; /* since the last refresh */
} tile_work;

/* ---- objects ---- */

static void settle(tile_work *w)
{
    tile_flush(&w->world->objects, w->t, &w->queue, w->counts);
    tile_far_update(w->t);
    w->drawn = 0;
}

/* Counts a vector of references of which some are drawn; refreshes what the tile knows after enough of them. */
CGT_SPU_INLINE void count_taken(tile_work *w, uint32_t count, uint32_t drawn)
{
    w->counts->references += count;
    w->counts->cull_tests += count;
    w->counts->culled += count - drawn;
    w->drawn += drawn;
    if (w->drawn >= DRAWN)
        settle(w);
}

CGT_SPU_INLINE uint32_t some_lanes(uint32_t count) { return count < CGT_LANES ? count : CGT_LANES; }

CGT_SPU_INLINE uint32_t draw_spheres(tile_work *w, const tile_spheres *s)
{
    const cgt_objects *objects = &w->world->objects;
    const unsigned small = s->small[1] & s->fast;
    uint32_t drawn = (uint32_t)__builtin_popcount(small);
    if (small & ~s->small[0])
        for (unsigned left = small; left; left &= left - 1)
            tile_sphere_draw_small(objects, w->t, s, __builtin_ctz(left), 4, &w->queue, w->counts);
    else
        for (unsigned left = small; left; left &= left - 1)
            tile_sphere_draw_small(objects, w->t, s, __builtin_ctz(left), 3, &w->queue, w->counts);
    for (unsigned left = (s->fast | s->slow) & ~small; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        tile_box box;
        if (!tile_clip(w->t, s, k, &box))
            continue;
        drawn++;
        if (s->fast >> k & 1)
            tile_sphere_draw(objects, w->t, s, k, box, &w->queue, w->counts);
        else
            tile_double_draw(objects, w->t, s->object[k], box, &w->queue, w->counts);
    }
    return drawn;
}

/* At most TILE_FOUND references; parallel is a constant. Returns how many were drawn. */
CGT_SPU_INLINE uint32_t find_spheres(tile_work *w, const uint32_t *reference, uint32_t count, bool parallel)
{
    vfloat sphere[4];
    vuint object;
    tile_found found;
    tile_spheres s;
    uint32_t drawn = 0;
    found.count = 0;
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        tile_spheres_fetch(&w->world->objects, reference + k, some_lanes(count - k), sphere, &object);
        if (parallel)
            tile_parallel_spheres_find(w->t, sphere, object, count - k, &found);
        else
            tile_spheres_find(w->t, sphere, object, count - k, &found);
    }
    if (found.count)
        tile_open_pixels(w->t);
    for (uint32_t k = 0; k < found.count; k += CGT_LANES) {
        if (parallel)
            tile_parallel_spheres_make(w->t, &found, k, &s);
        else
            tile_spheres_make(w->t, &found, k, &s);
        drawn += draw_spheres(w, &s);
    }
    return drawn;
}

/* A function of its own: what perspective takes stays as short as it is. */
__attribute__((noinline)) static uint32_t take_parallel_spheres(tile_work *w, const uint32_t *reference, uint32_t count)
{
    return find_spheres(w, reference, count, true);
}

static void take_spheres(tile_work *w, const uint32_t *reference, uint32_t count)
{
    const bool parallel = w->t->parallel;
    count_taken(w, count,
                parallel ? take_parallel_spheres(w, reference, count) : find_spheres(w, reference, count, false));
}

CGT_SPU_INLINE uint32_t draw_triangles(tile_work *w, const tile_triangles *s, tile_kind kind)
{
    const cgt_objects *objects = &w->world->objects;
    uint32_t drawn = 0;
    tile_open_pixels(w->t);
    for (unsigned left = s->fast; left; left &= left - 1)
        drawn += tile_triangle_draw(objects, w->t, s, __builtin_ctz(left), kind, &w->queue, w->counts);
    for (unsigned left = s->slow; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        const tile_box box = {.x0 = s->x0[k], .x1 = s->x1[k], .y0 = s->y0[k], .y1 = s->y1[k]};
        if (!(tile_window_parts(s, k) & tile_parts_open(w->t, s->nearest[k])))
            continue;
        drawn++;
        tile_double_draw(objects, w->t, s->object[k], box, &w->queue, w->counts);
    }
    return drawn;
}

__attribute__((noinline)) static void take_parallel_triangles(tile_work *w, const uint32_t *reference, uint32_t count)
{
    vfloat vertex[3][3];
    tile_triangles s;
    tile_triangles_objects(reference, count, s.object);
    tile_triangles_fetch(&w->world->objects, s.object, vertex);
    tile_parallel_triangles_make(w->t, vertex, tile_first_lanes(count), &s);
    count_taken(w, count, s.fast | s.slow ? draw_triangles(w, &s, TILE_PARALLEL) : 0);
}

static void take_triangles(tile_work *w, const uint32_t *reference, uint32_t count)
{
    vfloat vertex[3][3];
    tile_triangles s;
    uint32_t drawn = 0;
    if (w->t->parallel) {
        take_parallel_triangles(w, reference, count);
        return;
    }
    tile_triangles_objects(reference, count, s.object);
    tile_triangles_fetch(&w->world->objects, s.object, vertex);
    tile_triangles_make(w->t, vertex, tile_first_lanes(count), &s);
    if (s.fast | s.slow)
        drawn = w->t->linear ? draw_triangles(w, &s, TILE_LINEAR) : draw_triangles(w, &s, TILE_PERSPECTIVE);
    count_taken(w, count, drawn);
}

/* Takes the first of the references that wait; what is left over moves up. */
static void take_waiting_spheres(void *owner, uint32_t count)
{
    tile_work *w = owner;
    waiting *q = &w->waits.spheres;
    for (uint32_t k = 0; k < count; k += TILE_FOUND)
        take_spheres(w, q->reference + k, count - k < TILE_FOUND ? count - k : TILE_FOUND);
    waiting_remove(q, count);
}

/* The same, with the vertices of some vectors on their way. */
static void take_waiting_triangles(void *owner, uint32_t count)
{
    tile_work *w = owner;
    waiting *q = &w->waits.triangles;
    uint32_t asked = 0;
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        asked = waiting_ask(q, &w->world->objects, k, count, asked);
        take_triangles(w, q->reference + k, some_lanes(count - k));
    }
    waiting_remove(q, count);
}

/* Takes the first of the clusters that wait: the triangles of those that the tile wants wait then. */
static void take_waiting_clusters(void *owner, uint32_t count)
{
    tile_work *w = owner;
    const cgt_cluster *cluster = w->world->cluster;
    waiting *q = &w->waits.clusters;
    for (uint32_t k = 0; k < count; k += CGT_LANES) {
        const uint32_t some = some_lanes(count - k);
        unsigned left = tile_clusters_wanted(w->t, cluster, q->reference + k, some);
        w->counts->references += some;
        w->counts->cull_tests += some;
        w->counts->culled += some - spux_count_bits(left);
        for (; left; left &= left - 1) {
            const uint32_t number = q->reference[k + (uint32_t)__builtin_ctz(left)];
            if (w->waits.triangles.count > WAITING - CGT_CLUSTER)
                take_waiting_triangles(w, WAITING / 2);
            waiting_add_cluster(&w->waits.triangles, &w->world->objects, number, cluster[number].valid);
        }
    }
    waiting_remove(q, count);
}

static const waiting_takers takers = {take_waiting_spheres, take_waiting_triangles, take_waiting_clusters};

/* Whole vectors: what is left over comes with the next slice. */
static void take_vectors(tile_work *w)
{
    take_waiting_clusters(w, w->waits.clusters.count / CGT_LANES * CGT_LANES);
    take_waiting_spheres(w, w->waits.spheres.count / CGT_LANES * CGT_LANES);
    take_waiting_triangles(w, w->waits.triangles.count / CGT_LANES * CGT_LANES);
}

/* Runs of references, some looked up ahead, so that they come to the cache, too. */
typedef struct runs {
    const uint32_t *reference[RUNS];
    uint32_t count[RUNS], runs;
} runs;

static void take_runs(tile_work *w, runs *r)
{
    for (uint32_t k = 0; k < r->runs; k++)
        waiting_run(&w->waits, w->world, r->reference[k], r->count[k], takers, w);
    r->runs = 0;
}

CGT_SPU_INLINE void add_run(tile_work *w, runs *r, const uint32_t *reference, uint32_t count)
{
    const uint32_t last = r->runs - 1;
    for (uint32_t i = 0; i < count; i += 16)
        __builtin_prefetch(reference + i);
    if (r->runs && r->reference[last] + r->count[last] == reference) { /* cells side by side */
        r->count[last] += count;
        return;
    }
    if (r->runs == RUNS)
        take_runs(w, r);
    r->reference[r->runs] = reference;
    r->count[r->runs++] = count;
}

/* The references of the cells that the tile wants. */
static void take_cells(tile_work *w, const tile_march *m, const tile_slice *s, runs *r)
{
    const tile_cells c = tile_cells_make(w->t, m, s);
    const uint32_t *start = m->grid->start;
    for (uint32_t first = 0; first < c.count; first += CGT_LANES)
        for (unsigned left = tile_cells_wanted(w->t, &c, first); left; left &= left - 1) {
            const uint32_t cell = tile_cells_index(&c, first + (uint32_t)__builtin_ctz(left));
            add_run(w, r, m->grid->object + start[cell], start[cell + 1] - start[cell]);
        }
}

/* Runs of whole rows where there are few references, else the cells that are wanted. */
static void take_slice(tile_work *w, const tile_march *m, const tile_slice *s)
{
    const uint32_t rows = tile_slice_runs(m, s);
    uint32_t count, references = 0;
    runs r;
    r.runs = 0;
    for (uint32_t k = 0; k < rows && references < FEW; k++) {
        tile_slice_run(m, s, k, &count);
        references += count;
    }
    if (m->everything || references < FEW)
        for (uint32_t k = 0; k < rows; k++) {
            const uint32_t *reference = tile_slice_run(m, s, k, &count);
            add_run(w, &r, reference, count);
        }
    else
        take_cells(w, m, s, &r);
    take_runs(w, &r);
    take_vectors(w);
}

static void march(tile_work *w)
{
    tile_march m;
    tile_slice s;
    tile_march_make(w->t, &w->world->loose, &m);
    while (tile_march_next(&m, &s)) {
        if (w->drawn)
            settle(w);
        if (s.near_t > (double)w->t->farthest_t) {
            w->counts->early_exits++;
            break;
        }
        w->counts->slices++;
        take_slice(w, &m, &s);
    }
    take_waiting_clusters(w, w->waits.clusters.count);
    take_waiting_spheres(w, w->waits.spheres.count);
    take_waiting_triangles(w, w->waits.triangles.count);
    tile_flush(&w->world->objects, w->t, &w->queue, w->counts);
}

/* ---- the tile ---- */

static void trace_one(const cgt_world *world, const cgt_camera_rays *camera, const cgt_trace_settings *settings,
                      const cgt_region *region, cgt_counts *counts)
{
    tile t;
    tile_work w; /* large: not all of it is set */
    w.world = world;
    w.t = &t;
    w.queue.entries = 0;
    w.counts = counts;
    w.drawn = 0;
    waiting_clear(&w.waits);
    tile_make(&t, world, camera, region);
    march(&w);
    counts->tiles++;
    counts->rays += (uint64_t)region->width * region->height;
    tile_resolve(world, &t, settings, region, counts);
}

/* The part of a region that begins at (x, y) in it. */
static cgt_region region_part(const cgt_region *r, uint32_t x, uint32_t y)
{
    const size_t first = (size_t)y * r->row_stride + x;
    cgt_region q = *r;
    q.x += x;
    q.y += y;
    q.width = r->width - x < TILE_EDGE ? r->width - x : TILE_EDGE;
    q.height = r->height - y < TILE_EDGE ? r->height - y : TILE_EDGE;
    q.t = r->t ? r->t + first : NULL;
    q.primitive = r->primitive ? r->primitive + first : NULL;
    q.geometry = r->geometry ? r->geometry + first : NULL;
    for (int a = 0; a < 3; a++)
        q.normal[a] = r->normal[a] ? r->normal[a] + first : NULL;
    q.u = r->u ? r->u + first : NULL;
    q.v = r->v ? r->v + first : NULL;
    return q;
}

void CGT_KERNEL(cgt_trace_tile)(const cgt_world *world, const cgt_camera_rays *camera,
                                const cgt_trace_settings *settings, const cgt_region *region, cgt_counts *counts)
{
    if (!cgt_tile_serves(world, camera)) {
        CGT_KERNEL(cgt_trace_region)(world, camera, settings, region, counts);
        return;
    }
    for (uint32_t y = 0; y < region->height; y += TILE_EDGE)
        for (uint32_t x = 0; x < region->width; x += TILE_EDGE) {
            const cgt_region part = region_part(region, x, y);
            trace_one(world, camera, settings, &part, counts);
        }
}
