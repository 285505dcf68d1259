/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All hits of rays. Each ray gets a list of its first hits (query/hit_list.h), and another one after its last, as long
 * as somebody wants more. Hits of many rays form a batch, whose values are computed as those of nearest hits. */
#include <cgt/all_hits.h>

#include "core/scratch_tasks.h"
#include "query/ray_intake.h"
#include "scene/scene.h"
#include "trace/hit_lists.h"

#define LIST_HITS 64u     /* of a ray at a time */
#define LIST_MEMORY 6144u /* hits of all lists that are filled together */
#define MOST_LISTS 1024u
#define BATCH 256u /* hits whose values are computed together */

static const cgt_all_hits_options default_all;

void cgt_all_hits_options_init(cgt_all_hits_options *options) { *options = default_all; }

/* Where hits go: to rows, or to a visitor. */
typedef struct all_target {
    const cgt_hit_rows *rows; /* NULL: none */
    cgt_hits_visitor *visitor;
    void *user;
} all_target;

typedef struct all_job {
    const cgt_scene *scene;
    const cgt_rays *rays;
    cgt_all_hits_options all;
    all_target to;
    cgt_trace_settings settings;
    cgt_band_call bands;
    cgt_visits visits;
    cgt_trace_counter *counter;
} all_job;

/* Hits that wait for their values: the ray of each as an array has it, and the hit. */
typedef struct all_batch {
    float org[3][BATCH], dir[3][BATCH], t_min[BATCH], t_max[BATCH];
    uint32_t prim[BATCH];
    uint64_t ray[BATCH];
    uint32_t place[BATCH]; /* among the hits of the ray */
    cgt_hit hit[BATCH];
    uint32_t count;
} all_batch;

/* A ray that is being traced, and its list. */
typedef struct all_ray {
    uint64_t number;
    cgt_ray ray;
    uint32_t hits; /* before those of the list */
} all_ray;

/* The rays of a task, some at a time. */
typedef struct all_chunk {
    all_job *job;
    ray_source source;
    all_batch *batch;
    all_ray *ray;
    cgt_hit_list *list; /* of each of these rays */
    cgt_listed_hit *hit;
    uint32_t lists, room; /* lists in use, and how many there may be */
    uint32_t of_list;     /* hits that there is room for in each */
    bool use_bvh;
    cgt_counts *counts;
} all_chunk;

/* ---- values ---- */

/* Whether the ray leaves a body there. */
static bool is_far_surface(const cgt_hit_list *list, const cgt_listed_hit *hit)
{
    return list->kind == CGT_LIST_CROSSINGS ? cgt_hit_list_side(list, hit) > 0 : hit->far;
}

/* The range of a far root begins at infinity: no near root is in it, so that the far one is what is computed. */
static void batch_append(all_batch *b, const cgt_hit_list *list, uint32_t of, uint64_t number, uint32_t place)
{
    const cgt_ray *ray = list->ray;
    const cgt_listed_hit *hit = &list->hit[of];
    const uint32_t i = b->count++;
    for (int a = 0; a < 3; a++) {
        b->org[a][i] = ray->line.org[a];
        b->dir[a][i] = ray->line.dir[a];
    }
    b->t_min[i] = hit->far ? INFINITY : ray->t_min;
    b->t_max[i] = ray->t_max;
    b->prim[i] = hit->prim;
    b->ray[i] = number;
    b->place[i] = place;
    b->hit[i] = (cgt_hit){.surface = is_far_surface(list, hit) ? CGT_SURFACE_FAR : CGT_SURFACE_NEAR};
}

static void batch_resolve(const all_job *job, all_batch *b, cgt_counts *counts)
{
    const uint32_t fields = job->settings.fields;
    const bool normal = fields & CGT_FIELD_NORMAL, uv = fields & CGT_FIELD_UV;
    cgt_hit *h = b->hit;
    const cgt_rays rays = {.count = b->count,
                           .org = {b->org[0], b->org[1], b->org[2]},
                           .dir = {b->dir[0], b->dir[1], b->dir[2]},
                           .t_min = b->t_min,
                           .t_max = b->t_max};
    const cgt_hits hits = {
        .stride = sizeof *h,
        .t = &h->t,
        .primitive = &h->primitive,
        .geometry = &h->geometry,
        .normal = {normal ? h->normal : NULL, normal ? h->normal + 1 : NULL, normal ? h->normal + 2 : NULL},
        .u = uv ? &h->u : NULL,
        .v = uv ? &h->v : NULL};
    job->scene->context->kernel->resolve_rays(&job->scene->committed_scene, &rays, 0, b->count, b->prim, &job->settings,
                                              &hits, counts);
}

static void store(void *plane, size_t offset, const void *value)
{
    if (plane)
        memcpy((char *)plane + offset, value, sizeof(uint32_t));
}

static void store_row_hit(const cgt_hit_rows *rows, uint64_t element, const cgt_hit *h)
{
    const cgt_hits *to = &rows->hits;
    const size_t i = (size_t)element, offset = i * ray_stride(to->stride);
    store(to->t, offset, &h->t);
    store(to->primitive, offset, &h->primitive);
    store(to->geometry, offset, &h->geometry);
    for (int a = 0; a < 3; a++)
        store(to->normal[a], i * ray_vector_stride(to->vector_stride, to->stride), &h->normal[a]);
    store(to->u, offset, &h->u);
    store(to->v, offset, &h->v);
    store(rows->surface, offset, &h->surface);
}

/* Passes the hits of each ray to the visitor. */
static void visit_batch(all_job *job, const all_batch *b)
{
    for (uint32_t i = 0, end; i < b->count && !cgt_visits_stopped(&job->visits); i = end) {
        for (end = i + 1; end < b->count && end < i + LIST_HITS && b->ray[end] == b->ray[i]; end++)
            continue;
        cgt_visits_enter(&job->visits);
        cgt_visits_leave(&job->visits, job->to.visitor(job->to.user, b->ray[i], b->hit + i, end - i));
    }
}

static void batch_flush(const all_chunk *c)
{
    all_batch *b = c->batch;
    if (!b->count)
        return;
    batch_resolve(c->job, b, c->counts);
    if (c->job->to.rows)
        for (uint32_t i = 0; i < b->count; i++)
            store_row_hit(c->job->to.rows, b->ray[i] * c->job->to.rows->capacity + b->place[i], &b->hit[i]);
    else
        visit_batch(c->job, b);
    b->count = 0;
}

/* ---- rays ---- */

/* Sets the hit after which the ray's hits begin. Returns false where there is no such hit. */
static bool set_after(const all_chunk *c, uint64_t i, cgt_hit_list *list)
{
    const cgt_all_hits_options *all = &c->job->all;
    const cgt_rays after = {.skip_primitive = all->after_primitive, .skip_geometry = all->after_geometry};
    const ray_source s = {.rays = &after, .stride = ray_stride(all->after_stride)};
    if (!all->after_primitive || ray_number(&s, all->after_primitive, i) == CGT_INVALID_ID)
        return true;
    const uint32_t prim = ray_read_skip(list->prims, &s, i);
    const uint32_t surface = all->after_surface ? ray_number(&s, all->after_surface, i) : CGT_SURFACE_NEAR;
    return prim != CGT_INVALID_ID && surface <= CGT_SURFACE_FAR && cgt_hit_list_set_after(list, prim, surface != 0);
}

/* How many hits a list is to hold, and whether to look for more. */
static void begin_list(const all_chunk *c, const all_ray *ray, cgt_hit_list *list)
{
    const cgt_hit_rows *rows = c->job->to.rows;
    const uint32_t wanted = rows ? rows->capacity - ray->hits : UINT32_MAX;
    list->capacity = wanted < c->of_list ? wanted : c->of_list;
    list->wants_more = wanted > c->of_list || (rows && rows->more);
    list->count = 0;
    list->more = false;
}

/* Puts a list's hits into the batch. Returns whether another list is to follow, which is begun then. */
static bool take_list(const all_chunk *c, all_ray *ray, cgt_hit_list *list)
{
    const cgt_hit_rows *rows = c->job->to.rows;
    if (c->batch->count + list->count > BATCH)
        batch_flush(c);
    for (uint32_t k = 0; k < list->count; k++)
        batch_append(c->batch, list, k, ray->number, ray->hits + k);
    ray->hits += list->count;
    if (!list->more || (rows && ray->hits == rows->capacity))
        return false;
    if (!cgt_hit_list_go_on(list))
        return false;
    begin_list(c, ray, list);
    return true;
}

static void end_ray(const all_chunk *c, uint64_t i, uint32_t hits, bool more)
{
    const cgt_hit_rows *rows = c->job->to.rows;
    if (rows)
        rows->count[i] = hits;
    if (rows && rows->more)
        rows->more[i] = more;
}

/* Reads a ray to the next list, if it can hit anything. */
static void begin_ray(all_chunk *c, uint64_t i)
{
    const cgt_primitives *prims = &c->job->scene->committed_scene.prims;
    all_ray *ray = &c->ray[c->lists];
    cgt_hit_list *list = &c->list[c->lists];
    *ray = (all_ray){.number = i, .ray = ray_read(&c->source, i)};
    *list = (cgt_hit_list){.kind = c->job->all.crossings ? CGT_LIST_CROSSINGS : CGT_LIST_HITS,
                           .prims = prims,
                           .ray = &ray->ray,
                           .skip = ray_read_skip(prims, &c->source, i),
                           .mask = ray_read_mask(&c->source, i),
                           .hit = c->hit + (size_t)c->lists * c->of_list};
    ray_state state = ray_classify(&ray->ray, &RAY_NO_LIMITS);
    if (state == RAY_PLAIN && !set_after(c, i, list))
        state = RAY_INVALID;
    c->counts->rays++;
    c->counts->invalid_rays += state == RAY_INVALID;
    if (state != RAY_PLAIN) {
        end_ray(c, i, 0, false);
        return;
    }
    c->counts->bvh_rays += c->use_bvh;
    begin_list(c, ray, list);
    c->lists++;
}

/* Fills the lists, and keeps those whose rays go on. */
static void trace_lists(all_chunk *c)
{
    uint32_t kept = 0;
    cgt_list_rays(c->job->scene, &c->job->settings, &c->job->bands, c->list, c->lists, c->counts);
    for (uint32_t k = 0; k < c->lists; k++) {
        cgt_hit_list *list = &c->list[k], *to = &c->list[kept];
        if (!take_list(c, &c->ray[k], list)) {
            c->counts->double_tests += list->double_tests;
            c->counts->exact_tests += list->exact_tests;
            end_ray(c, c->ray[k].number, c->ray[k].hits, list->more);
            continue;
        }
        cgt_listed_hit *memory = to->hit;
        c->ray[kept] = c->ray[k];
        *to = *list;
        to->ray = &c->ray[kept].ray;
        to->hit = memory;
        kept++;
    }
    c->lists = kept;
}

static void trace_chunk(void *argument, uint32_t index, cgt_scratch *scratch)
{
    all_job *job = argument;
    cgt_counts counts = {.scratch = scratch};
    const cgt_hit_rows *rows = job->to.rows;
    const uint64_t first = (uint64_t)index * CGT_RAYS_CHUNK, left = job->rays->count - first,
                   end = first + (left < CGT_RAYS_CHUNK ? left : CGT_RAYS_CHUNK);
    all_chunk c = {.job = job,
                   .source = ray_source_init(job->rays, NULL),
                   .batch = cgt_scratch_take(scratch, sizeof(all_batch)),
                   .ray = cgt_scratch_take(scratch, MOST_LISTS * sizeof(all_ray)),
                   .list = cgt_scratch_take(scratch, MOST_LISTS * sizeof(cgt_hit_list)),
                   .hit = cgt_scratch_take(scratch, LIST_MEMORY * sizeof(cgt_listed_hit)),
                   .of_list = rows && rows->capacity < LIST_HITS ? rows->capacity : LIST_HITS,
                   .use_bvh = cgt_lists_use_bvh(job->scene, &job->settings, &job->bands),
                   .counts = &counts};
    c.room = LIST_MEMORY / c.of_list < MOST_LISTS ? LIST_MEMORY / c.of_list : MOST_LISTS;
    c.batch->count = 0;
    for (uint64_t i = first; (i < end || c.lists) && !cgt_visits_stopped(&job->visits);) {
        while (i < end && c.lists < c.room)
            begin_ray(&c, i++);
        trace_lists(&c);
    }
    if (!cgt_visits_stopped(&job->visits))
        batch_flush(&c);
    cgt_scratch_return(scratch, c.batch);
    cgt_trace_counter_add(job->counter, &counts);
}

/* ---- calls ---- */

static cgt_result check_rows(cgt_context *c, const cgt_hit_rows *rows, uint64_t rays, uint32_t *fields)
{
    void *const plane[CGT_PLANES] = CGT_PLANES_OF(&rows->hits);
    if (!rows->capacity)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "rows: capacity is 0");
    if (!rows->count && rays)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "rows: count must not be NULL");
    if (rays > UINT64_MAX / rows->capacity)
        return cgt_fail(c, CGT_ERROR_TOO_LARGE, "rows: count times capacity leaves the address space");
    const cgt_result result = cgt_check_planes(c, "rows", plane);
    *fields = cgt_planes_fields(plane);
    return result == CGT_OK
               ? cgt_check_strides(c, "rows", rows->hits.stride, rows->hits.vector_stride, rays * rows->capacity)
               : result;
}

static cgt_result trace_all(all_job *job, const cgt_all_hits_options *all, const cgt_trace_options *options)
{
    cgt_context *c = job->scene->context;
    cgt_trace_counter counter;
    const uint32_t fields = job->settings.fields;
    job->counter = &counter;
    cgt_visits_begin(&job->visits);
    job->all = all ? *all : default_all;
    cgt_result result = cgt_trace_prepare(job->scene, options, false, &job->settings, &counter);
    job->settings.fields = fields | CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY;
    if (result == CGT_OK && job->all.crossings)
        result = cgt_check_crossings(job->scene);
    if (result == CGT_OK)
        result = cgt_check_rays(c, job->rays);
    if (result == CGT_OK)
        result = cgt_check_strides(c, "after", job->all.after_stride, 0, job->rays->count);
    if (result == CGT_OK && job->to.rows) {
        result = check_rows(c, job->to.rows, job->rays->count, &job->settings.fields);
        job->settings.fields |= CGT_FIELD_T;
    }
    if (result == CGT_OK)
        result = cgt_ready_lists(job->scene, job->rays->count, &job->settings, &job->bands);
    if (result == CGT_OK)
        result = cgt_run_scratch_tasks(c, trace_chunk, job,
                                       (uint32_t)((job->rays->count + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK));
    job->counter = NULL;
    if (result == CGT_OK)
        result = cgt_visits_end(c, &job->visits, "visit all rays: the visitor stopped the trace");
    if (result == CGT_OK)
        cgt_trace_store_statistics(options, &job->settings, &counter);
    return result;
}

cgt_result cgt_trace_all_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_all_hits_options *all,
                              const cgt_hit_rows *rows, const cgt_trace_options *options)
{
    if (!scene || !rays || !rows)
        return cgt_fail_null(scene, __func__);
    all_job job = {.scene = scene, .rays = rays, .to = {.rows = rows}};
    return trace_all(&job, all, options);
}

cgt_result cgt_visit_all_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_all_hits_options *all,
                              uint32_t fields, cgt_hits_visitor *visitor, void *user, const cgt_trace_options *options)
{
    const uint32_t known = CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY | CGT_FIELD_NORMAL | CGT_FIELD_UV;
    if (!scene || !rays || !visitor)
        return cgt_fail_null(scene, __func__);
    if (fields & ~known)
        return cgt_fail(scene->context, CGT_ERROR_INVALID_ARGUMENT, "visit all rays: fields has unknown bits");
    all_job job = {.scene = scene, .rays = rays, .to = {.visitor = visitor, .user = user}};
    job.settings.fields = fields;
    return trace_all(&job, all, options);
}

cgt_result cgt_trace_all_ray(const cgt_scene *scene, const cgt_single_ray *ray, const cgt_all_hits_options *all,
                             cgt_hit *hits, uint32_t capacity, uint32_t *count, bool *more,
                             const cgt_trace_options *options)
{
    if (!scene || !ray || !hits || !count)
        return cgt_fail_null(scene, __func__);
    const float t_max = cgt_end_of_ray(ray);
    const cgt_rays rays = cgt_array_of_ray(ray, &t_max);
    uint8_t is_more = 0;
    const cgt_hit_rows rows = {.capacity = capacity,
                               .hits = {.stride = sizeof *hits,
                                        .t = &hits->t,
                                        .primitive = &hits->primitive,
                                        .geometry = &hits->geometry,
                                        .normal = {hits->normal, hits->normal + 1, hits->normal + 2},
                                        .u = &hits->u,
                                        .v = &hits->v},
                               .surface = &hits->surface,
                               .count = count,
                               .more = more ? &is_more : NULL};
    const cgt_result result = cgt_trace_all_rays(scene, &rays, all, &rows, options);
    if (result == CGT_OK && more)
        *more = is_more;
    return result;
}
