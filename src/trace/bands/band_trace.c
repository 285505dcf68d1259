/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A call: its scratch memory, waves of tasks, and what bands' kernels are asked for. A chunk of rays: for each band the
 * rays that may meet it are scaled and go through its structure together; what they find is compared in the caller's
 * units. The values of the hits are computed at the end, from the caller's numbers. */
#include "trace/bands/band_trace.h"

#include "builders/bvh/bvh_on_demand.h"
#include "query/ray_intake.h"
#include "query/tile_limits.h"

#define RUNNER_SLOTS 16u /* of a caller's runner, whose threads are not known */

/* Points against a light go through a loose grid by tiles if there is no BVH, and tiles take no more work than this for
 * each point. */
#define MAX_LIGHT_WORK 128u

/* ---- a call ---- */

/* Planes for call->slot_rays, a multiple of 16. */
cgt_band_scratch cgt_band_slot(const cgt_band_call *call, uint32_t slot)
{
    const uint32_t rays = call->slot_rays;
    void *memory = (char *)call->memory + slot * CGT_BAND_SCRATCH_BYTES((size_t)rays);
    cgt_band_scratch s = {.capacity = rays, .best = memory};
    uint32_t *plane = (uint32_t *)(void *)(s.best + rays);
    float **const floats[] = {&s.org[0], &s.org[1], &s.org[2], &s.dir[0], &s.dir[1],
                              &s.dir[2], &s.t_min,  &s.t_max,  &s.t};
    uint32_t **const integers[] = {&s.mask, &s.skip_primitive, &s.skip_geometry, &s.ray, &s.primitive, &s.geometry};
    for (size_t i = 0; i < sizeof floats / sizeof floats[0]; i++, plane += rays)
        *floats[i] = (float *)(void *)plane;
    for (size_t i = 0; i < sizeof integers / sizeof integers[0]; i++, plane += rays)
        *integers[i] = plane;
    s.exponent = (int32_t *)(void *)plane;
    s.occluded = (uint8_t *)(plane + rays);
    return s;
}

cgt_result cgt_bands_begin(const cgt_scene *scene, const cgt_trace_settings *settings, uint64_t rays,
                           uint32_t max_chunk, cgt_band_call *call)
{
    const cgt_context *c = scene->context;
    *call = (cgt_band_call){.scene = scene, .settings = settings};
    const uint64_t chunks = (rays + max_chunk - 1) / max_chunk,
                   slots = c->threads ? 2 * (uint64_t)c->threads : RUNNER_SLOTS;
    const uint64_t chunk = rays < max_chunk ? rays : max_chunk;
    call->slots = (uint32_t)(chunks < 1 ? 1 : chunks < slots ? chunks : slots);
    call->slot_rays = (uint32_t)(chunk + 15) / 16 * 16 + 16;
    call->bytes = (size_t)call->slots * CGT_BAND_SCRATCH_BYTES((size_t)call->slot_rays);
    call->memory = cgt_allocate(&c->memory, call->bytes);
    return call->memory ? CGT_OK
                        : cgt_fail(scene->context, CGT_ERROR_OUT_OF_MEMORY,
                                   "trace: out of memory for rays through bands of magnitudes");
}

cgt_result cgt_bands_build_bvh(cgt_band_call *call, uint64_t rays)
{
    const struct cgt_bands *bands = call->scene->bands;
    cgt_result result = CGT_OK;
    for (uint32_t b = 0; b < bands->count && result == CGT_OK; b++)
        result = cgt_bvh_build_on_demand(bands->band[b].scene, rays, &call->use_bvh[b]);
    return result;
}

void cgt_bands_end(cgt_band_call *call)
{
    if (call->memory)
        cgt_free(&call->scene->context->memory, call->memory, call->bytes);
    call->memory = NULL;
}

typedef struct band_wave {
    cgt_scratch_task *task;
    void *argument;
    uint32_t first;
} band_wave;

static void run_task(void *argument, uint32_t index, cgt_scratch *scratch)
{
    const band_wave *w = argument;
    w->task(w->argument, w->first + index, scratch);
}

cgt_result cgt_bands_run(const cgt_band_call *call, cgt_scratch_task *task, void *argument, uint32_t count)
{
    cgt_result result = CGT_OK;
    for (uint32_t first = 0; first < count && result == CGT_OK; first += call->slots) {
        band_wave w = {task, argument, first};
        const uint32_t tasks = count - first < call->slots ? count - first : call->slots;
        result = cgt_run_scratch_tasks(call->scene->context, run_task, &w, tasks);
    }
    return result;
}

cgt_trace_settings cgt_band_settings(const cgt_trace_settings *settings)
{
    cgt_trace_settings s = *settings;
    s.precision = CGT_PRECISION_EXACT;
    s.triangle_test = CGT_TRIANGLE_TEST_AUTO;
    s.fields = CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY;
    s.light_tiles = s.use_bvh = false;
    return s;
}

void cgt_band_add_counts(cgt_counts *to, const cgt_counts *counts)
{
    uint64_t sum[CGT_COUNTS], value[CGT_COUNTS];
    cgt_counts added = *counts;
    added.rays = added.invalid_rays = added.hits = added.exact_values = 0; /* those of the call */
    memcpy(sum, to, sizeof sum);
    memcpy(value, &added, sizeof value);
    for (size_t i = 0; i < CGT_COUNTS; i++)
        sum[i] += value[i];
    memcpy(to, sum, sizeof sum);
}

/* ---- the caller's rays ---- */

/* Whether ray i of the chunk takes part, and which it is. */
static bool read_ray(const cgt_band_chunk *c, uint32_t i, cgt_band_ray *ray)
{
    const cgt_primitives *prims = &c->call->scene->committed_scene.prims;
    const ray_source source = ray_source_init(c->rays, c->light);
    ray->ray = ray_read(&source, c->first + i);
    if (ray_classify(&ray->ray, &RAY_NO_LIMITS) != RAY_PLAIN)
        return false;
    ray->mask = ray_read_mask(&source, c->first + i);
    ray->skip = ray_read_skip(prims, &source, c->first + i);
    return true;
}

/* ---- one band ---- */

/* Scaled rays of the chunk, from `first` to end - 1 in the scratch. */
typedef struct ray_list {
    uint32_t first, end;
} ray_list;

static void store_ray(const cgt_band_chunk *c, const cgt_band *band, const cgt_band_ray *ray, const cgt_scaled_ray *r,
                      uint32_t i, uint32_t to)
{
    const cgt_band_scratch *s = c->scratch;
    for (int a = 0; a < 3; a++) {
        s->org[a][to] = r->org[a];
        s->dir[a][to] = r->dir[a];
    }
    s->t_min[to] = r->t_min;
    s->t_max[to] = r->t_max;
    s->exponent[to] = r->exponent;
    s->ray[to] = i;
    s->mask[to] = ray->mask;
    if (c->rays->skip_primitive)
        cgt_band_scale_skip(band, ray->skip, &s->skip_primitive[to], &s->skip_geometry[to]);
}

static cgt_rays list_rays(const cgt_band_chunk *c, ray_list list)
{
    const cgt_band_scratch *s = c->scratch;
    const uint32_t k = list.first;
    return (cgt_rays){.count = list.end - k,
                      .org = {s->org[0] + k, s->org[1] + k, s->org[2] + k},
                      .dir = {s->dir[0] + k, s->dir[1] + k, s->dir[2] + k},
                      .t_min = s->t_min + k,
                      .t_max = s->t_max + k,
                      .mask = c->rays->mask ? s->mask + k : NULL,
                      .skip_primitive = c->rays->skip_primitive ? s->skip_primitive + k : NULL,
                      .skip_geometry = c->rays->skip_primitive ? s->skip_geometry + k : NULL};
}

/* Hits of any-hit rays. */
static void take_occluded(const cgt_band_chunk *c, const cgt_band *band, ray_list list)
{
    const cgt_band_scratch *s = c->scratch;
    for (uint32_t k = list.first; k < list.end; k++)
        if (s->occluded[k])
            s->best[s->ray[k]].prim = ((const uint32_t *)band->number.data)[0]; /* some primitive */
}

static void trace_any(const cgt_band_chunk *c, uint32_t b, ray_list list)
{
    const cgt_band *band = &c->call->scene->bands->band[b];
    const cgt_rays rays = list_rays(c, list);
    cgt_trace_settings settings = cgt_band_settings(c->call->settings);
    cgt_counts counts = {.scratch = c->counts->scratch};
    if (!rays.count)
        return;
    settings.use_bvh = c->call->use_bvh[b];
    c->call->scene->context->kernel->trace_rays(&band->scene->committed_scene, &rays, 0, rays.count, &settings, NULL,
                                                c->scratch->occluded + list.first, &counts);
    cgt_band_add_counts(c->counts, &counts);
    take_occluded(c, band, list);
}

/* Points against a light: by tiles, else as other rays. */
static void trace_points(const cgt_band_chunk *c, uint32_t b, ray_list list, const cgt_light *light)
{
    const cgt_band *band = &c->call->scene->bands->band[b];
    const cgt_kernel *kernel = c->call->scene->context->kernel;
    const cgt_committed_scene *scene = &band->scene->committed_scene;
    cgt_rays points = list_rays(c, list);
    cgt_trace_settings settings = cgt_band_settings(c->call->settings);
    cgt_counts counts = {.scratch = c->counts->scratch};
    if (!points.count)
        return;
    /* ranges are the caller's here, and none are faster */
    points.t_min = c->rays->t_min ? points.t_min : NULL;
    points.t_max = c->rays->t_max ? points.t_max : NULL;
    settings.use_bvh = c->call->use_bvh[b];
    settings.light_tiles = !settings.use_bvh && cgt_tile_supports_light(scene, light);
    settings.max_light_work = settings.light_tiles ? MAX_LIGHT_WORK : 0;
    const bool may_wait = c->waits && scene->structure == CGT_STRUCTURE_LOOSE_GRID && !settings.use_bvh;
    if (may_wait && !settings.light_tiles) {
        *c->waits = true;
        return;
    }
    if (!kernel->trace_light(scene, &points, light, 0, points.count, &settings, c->scratch->occluded, &counts)) {
        if (may_wait) {
            cgt_band_add_counts(c->counts, &counts);
            *c->waits = true;
            return;
        }
        settings.light_tiles = false;
        settings.max_light_work = 0;
        kernel->trace_light(scene, &points, light, 0, points.count, &settings, c->scratch->occluded, &counts);
    }
    cgt_band_add_counts(c->counts, &counts);
    take_occluded(c, band, list);
}

static void trace_closest(const cgt_band_chunk *c, uint32_t b, ray_list list)
{
    const cgt_primitives *prims = &c->call->scene->committed_scene.prims;
    const cgt_band *band = &c->call->scene->bands->band[b];
    const cgt_band_scratch *s = c->scratch;
    const cgt_rays rays = list_rays(c, list);
    const cgt_hits hits = {
        .t = s->t + list.first, .primitive = s->primitive + list.first, .geometry = s->geometry + list.first};
    cgt_trace_settings settings = cgt_band_settings(c->call->settings);
    cgt_counts counts = {.scratch = c->counts->scratch};
    if (!rays.count)
        return;
    settings.use_bvh = c->call->use_bvh[b];
    c->call->scene->context->kernel->trace_rays(&band->scene->committed_scene, &rays, 0, rays.count, &settings, &hits,
                                                NULL, &counts);
    cgt_band_add_counts(c->counts, &counts);
    for (uint32_t k = list.first; k < list.end; k++) {
        cgt_band_ray ray;
        if (s->primitive[k] == CGT_INVALID_ID)
            continue;
        read_ray(c, s->ray[k], &ray);
        cgt_band_accept(prims, band, &ray, cgt_band_primitive(band, s->geometry[k], s->primitive[k]), s->t[k],
                        s->exponent[k], &s->best[s->ray[k]], c->counts);
    }
}

void cgt_band_trace_chunk(const cgt_band_chunk *c, uint32_t b)
{
    const struct cgt_bands *bands = c->call->scene->bands;
    const cgt_band *band = &bands->band[b];
    const cgt_committed_scene *scene = &band->scene->committed_scene;
    const bool bvh = c->call->use_bvh[b] || scene->structure == CGT_STRUCTURE_BVH;
    const int dir_exponent = c->any_hit && bvh ? CGT_BAND_ANY_DIR_EXPONENT : CGT_BAND_DIR_EXPONENT;
    /* rays whose t is the band's, for any hit, from the start; others from the end */
    ray_list any = {0, 0}, closest = {c->scratch->capacity, c->scratch->capacity};
    cgt_light light;
    const bool points = cgt_band_scale_light(band, c->light, &light);
    if (!scene->valid)
        return;
    for (uint32_t i = 0; i < c->count; i++) {
        cgt_band_ray ray;
        cgt_scaled_ray r;
        cgt_band_best *best = &c->scratch->best[i];
        if ((c->any_hit && best->prim != CGT_INVALID_ID) || !read_ray(c, i, &ray))
            continue;
        const double t_end = cgt_band_end(&ray.ray, best);
        if (bands->count + bands->rest > 1 && cgt_band_misses_box(band, &ray.ray, t_end))
            continue;
        const cgt_band_state state = points && cgt_band_scale_point(band, &ray.ray, &r)
                                         ? CGT_BAND_SCALED
                                         : cgt_band_scale_ray(band, &ray.ray, t_end, dir_exponent, &r);
        if (state == CGT_BAND_SCALED)
            store_ray(c, band, &ray, &r, i, c->any_hit && !r.exponent ? any.end++ : --closest.first);
        else if (state == CGT_BAND_AS_GIVEN)
            cgt_band_decide(&c->call->scene->committed_scene.prims, band->number.data, band->count, &ray, c->any_hit,
                            best, c->counts);
    }
    if (points)
        trace_points(c, b, any, &light);
    else
        trace_any(c, b, any);
    trace_closest(c, b, closest);
}

void cgt_band_trace_rest(const cgt_band_chunk *c)
{
    const cgt_scene *scene = c->call->scene;
    const struct cgt_bands *bands = scene->bands;
    cgt_band_ray ray;
    for (uint32_t i = 0; bands->rest && i < c->count; i++)
        if (!(c->any_hit && c->scratch->best[i].prim != CGT_INVALID_ID) && read_ray(c, i, &ray))
            cgt_band_decide(&scene->committed_scene.prims, bands->rest_number.data, bands->rest, &ray, c->any_hit,
                            &c->scratch->best[i], c->counts);
}

/* ---- a chunk ---- */

static void count_rays(const cgt_band_chunk *c)
{
    const ray_source source = ray_source_init(c->rays, c->light);
    c->counts->rays += c->count;
    for (uint32_t i = 0; i < c->count; i++) {
        c->scratch->best[i] = (cgt_band_best){CGT_INVALID_ID, INFINITY};
        const cgt_ray ray = ray_read(&source, c->first + i);
        c->counts->invalid_rays += ray_classify(&ray, &RAY_NO_LIMITS) == RAY_INVALID;
    }
}

static void store_hits(const cgt_band_chunk *c, const cgt_hits *hits)
{
    const cgt_scene *scene = c->call->scene;
    uint32_t *prim = c->scratch->ray;
    for (uint32_t i = 0; i < c->count; i++)
        prim[i] = c->scratch->best[i].prim;
    scene->context->kernel->resolve_rays(&scene->committed_scene, c->rays, c->first, c->first + c->count, prim,
                                         c->call->settings, hits, c->counts);
}

bool cgt_bands_trace(const cgt_band_call *call, uint32_t slot, const cgt_rays *rays, const cgt_light *light,
                     uint64_t first, uint64_t end, const cgt_hits *hits, uint8_t *occluded, cgt_counts *counts)
{
    const cgt_band_scratch scratch = cgt_band_slot(call, slot);
    bool waits = false;
    const cgt_band_chunk c = {.call = call,
                              .scratch = &scratch,
                              .rays = rays,
                              .light = light,
                              .first = first,
                              .count = (uint32_t)(end - first),
                              .any_hit = hits == NULL,
                              .waits = call->by_tiles ? &waits : NULL,
                              .counts = counts};
    count_rays(&c);
    for (uint32_t b = 0; b < call->scene->bands->count && !waits; b++)
        cgt_band_trace_chunk(&c, b);
    if (waits) {
        counts->rays = counts->invalid_rays = 0; /* they are counted when they are traced */
        return false;
    }
    cgt_band_trace_rest(&c);
    if (hits) {
        store_hits(&c, hits);
        return true;
    }
    for (uint32_t i = 0; i < c.count; i++) {
        occluded[first + i] = scratch.best[i].prim != CGT_INVALID_ID;
        counts->hits += occluded[first + i];
    }
    return true;
}
