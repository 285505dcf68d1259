/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A camera's frame tile by tile: spheres of a loose grid, front to back, to the pixels that they may reach. The hits are
 * those that every other way finds. */
#include "../tile_serves.h"
#include "tile_double.h"
#include "tile_draw.h"
#include "tile_march.h"
#include "tile_resolve.h"

#define DRAWN 32u /* spheres after which it pays to look how far the parts still see */

#define WAITING 256u /* references */
#define RUNS 16u     /* of references, looked up together */

typedef struct tile_work {
    const cgt_world *world;
    tile *t;
    tile_queue queue;
    cgt_counts *counts;
    uint32_t waiting[WAITING]; /* references */
    uint32_t waits;
    uint32_t drawn; /* since the last refresh */
} tile_work;

/* ---- objects ---- */

static void settle(tile_work *w)
{
    tile_flush(&w->world->objects, w->t, &w->queue, w->counts);
    tile_far_update(w->t);
    w->drawn = 0;
}

CGT_SPU_INLINE void draw(tile_work *w, const tile_spheres *s)
{
    const cgt_objects *objects = &w->world->objects;
    for (unsigned left = s->fast | s->slow; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        tile_box box;
        if (!tile_clip(w->t, s, k, &box)) {
            w->counts->culled++;
            continue;
        }
        w->drawn++;
        if (s->fast >> k & 1)
            tile_sphere_draw(objects, w->t, s, k, box, &w->queue, w->counts);
        else
            tile_double_draw(objects, w->t, s->object[k], box.y0, box.y1, &w->queue, w->counts);
    }
}

static void take(tile_work *w, const uint32_t *reference, uint32_t count)
{
    vfloat sphere[4];
    tile_spheres s;
    tile_spheres_fetch(&w->world->objects, reference, count, sphere, s.object);
    tile_spheres_make(w->t, sphere, count < CGT_LANES ? (1u << count) - 1 : CGT_ALL_LANES, &s);
    w->counts->references += count;
    w->counts->cull_tests += count;
    w->counts->culled += count - spux_count_bits(s.fast | s.slow);
    if (!(s.fast | s.slow))
        return;
    draw(w, &s);
    if (w->drawn >= DRAWN)
        settle(w);
}

/* Takes the first of what waits; the rest moves up. */
static void take_waiting(tile_work *w, uint32_t count)
{
    for (uint32_t k = 0; k < count; k += CGT_LANES)
        take(w, w->waiting + k, count - k < CGT_LANES ? count - k : CGT_LANES);
    w->waits -= count;
    memmove(w->waiting, w->waiting + count, w->waits * sizeof *w->waiting);
}

/* References wait until their spheres have come to the cache. */
static void wait_run(tile_work *w, const uint32_t *reference, uint32_t count)
{
    const cgt_object_array *array = w->world->objects.array;
    const bool one = w->world->objects.arrays == 1;
    while (count) {
        const uint32_t room = WAITING - w->waits, some = count < room ? count : room;
        for (uint32_t k = 0; k < some; k++) {
            w->waiting[w->waits + k] = reference[k];
            if (one)
                __builtin_prefetch(cgt_array_point(array, reference[k]));
        }
        w->waits += some;
        reference += some;
        count -= some;
        if (w->waits == WAITING)
            take_waiting(w, WAITING / 2);
    }
}

/* The references of a slice: some runs ahead, so that they come to the cache, too. */
static void take_slice(tile_work *w, const tile_march *m, const tile_slice *s)
{
    const uint32_t runs = tile_slice_runs(m, s);
    for (uint32_t first = 0; first < runs; first += RUNS) {
        const uint32_t some = runs - first < RUNS ? runs - first : RUNS;
        const uint32_t *reference[RUNS];
        uint32_t count[RUNS];
        for (uint32_t k = 0; k < some; k++) {
            reference[k] = tile_slice_run(m, s, first + k, &count[k]);
            for (uint32_t i = 0; i < count[k]; i += 16)
                __builtin_prefetch(reference[k] + i);
        }
        for (uint32_t k = 0; k < some; k++)
            wait_run(w, reference[k], count[k]);
    }
    take_waiting(w, w->waits / CGT_LANES * CGT_LANES); /* whole vectors: what is left comes with the next slice */
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
    take_waiting(w, w->waits);
    tile_flush(&w->world->objects, w->t, &w->queue, w->counts);
}

/* ---- the tile ---- */

/* Distance from the eye to the farthest corner of the world's bounds, rounded up. */
static float farthest_corner(const cgt_world *world, const float eye[3])
{
    double square = 0;
    for (int a = 0; a < 3; a++) {
        const double low = fabs((double)world->low[a] - (double)eye[a]);
        const double high = fabs((double)world->high[a] - (double)eye[a]), most = low > high ? low : high;
        square += most * most;
    }
    return (float)(sqrt(square) * (1 + 0x1p-20));
}

/* The radius that the tile's gap is for. Larger spheres are slow, and smaller ones are left open where something lies
 * within the gap behind them, which is rarer: so the largest radius of which there is a good share of the objects, where
 * that is small beside the scene, else that of most objects. Levels go from large to small. */
static float usual_radius(const cgt_world *world, float farthest)
{
    const cgt_loose_level *level = world->loose.level, *most = level;
    for (const cgt_loose_level *l = level; l < level + world->loose.levels; l++) {
        const float reach = fminf(l->reach[0], fminf(l->reach[1], l->reach[2]));
        if (l->objects >= world->valid / 64 && reach < farthest * 0.125f)
            return reach;
        most = l->objects > most->objects ? l : most;
    }
    return fminf(most->reach[0], fminf(most->reach[1], most->reach[2]));
}

static void tile_make(tile *t, const cgt_world *world, const cgt_camera_rays *camera, const cgt_region *r)
{
    const float c = farthest_corner(world, camera->eye), far_t = c * (1 + 0x1p-18f);
    t->rays = camera;
    t->columns = r->width;
    t->rows = r->height;
    tile_camera_make(camera, &t->camera);
    tile_tables_make(t, r->x, r->y);
    tile_norms_make(t);
    tile_cone_make(t);
    tile_gap_make(t, c, usual_radius(world, c), far_t);
    tile_open(t, far_t);
    tile_far_update(t);
}

static void trace_one(const cgt_world *world, const cgt_camera_rays *camera, const cgt_trace_settings *settings,
                      const cgt_region *region, cgt_counts *counts)
{
    tile t;
    tile_work w; /* large: not all of it is set */
    w.world = world;
    w.t = &t;
    w.queue.entries = 0;
    w.counts = counts;
    w.waits = w.drawn = 0;
    tile_make(&t, world, camera, region);
    march(&w);
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
    if (!cgt_tile_serves(world, camera, settings)) {
        CGT_KERNEL(cgt_trace_region)(world, camera, settings, region, counts);
        return;
    }
    for (uint32_t y = 0; y < region->height; y += TILE_EDGE)
        for (uint32_t x = 0; x < region->width; x += TILE_EDGE) {
            const cgt_region part = region_part(region, x, y);
            trace_one(world, camera, settings, &part, counts);
        }
}
