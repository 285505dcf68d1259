/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points inside of bodies. A point is in a sphere if it is one of the few that a BVH finds around it. Where there is no
 * BVH, and for triangles, a ray from the point to the outside crosses surfaces (exact/crossing.h), whose sides are
 * summed up for each geometry. */
#include <cgt/all_hits.h>

#include "core/scratch_tasks.h"
#include "query/ray_intake.h"
#include "trace/hit_lists.h"

#define LISTS 512u                 /* that are filled together */
#define LIST_HITS 16u              /* of a ray at a time */
#define WINDOW (UINT32_C(1) << 14) /* geometries whose sums a ray fills; more take more rays */

static const cgt_inside_options default_inside;

void cgt_inside_options_init(cgt_inside_options *options) { *options = default_inside; }

typedef struct inside_job {
    const cgt_scene *scene;
    cgt_rays points; /* origins and masks */
    cgt_inside_rule rule;
    uint8_t *inside;
    cgt_trace_settings settings;
    cgt_band_call bands;
    cgt_trace_counter *counter;
} inside_job;

/* What a point's crossings have made of a geometry. */
typedef struct inside_sum {
    uint32_t stamp; /* of the ray that has written it; of any other one it is 0 */
    int32_t sum;
} inside_sum;

typedef struct inside_point {
    uint64_t number;
    cgt_ray ray;
} inside_point;

typedef struct inside_chunk {
    const inside_job *job;
    ray_source source;
    bool use_bvh;
    bool direct;         /* spheres are looked up */
    inside_point *point; /* that are asked for together */
    cgt_hit_list *list;  /* of each */
    cgt_listed_hit *hit; /* LIST_HITS of each list */
    uint32_t points;
    inside_sum *sum; /* of geometries first_array on */
    uint32_t sums, first_array;
    uint32_t stamp;
    cgt_counts *counts;
} inside_chunk;

/* ---- rays ---- */

/* Towards the nearest face of the scene's bounds, where little lies on the way; neighbours agree but for those in the
 * middle. Aside from the axis, so that rays along walls and edges are rare. Of a length that keeps t finite. */
static void choose_direction(const cgt_committed_scene *s, const float org[3], float dir[3])
{
    static const float aside[3] = {0.171875f, 0.2890625f, 0.234375f};
    double least = INFINITY;
    int axis = 0;
    float side = 1;
    for (int a = 0; a < 3; a++) {
        const double below = (double)org[a] - (double)s->low[a], above = (double)s->high[a] - (double)org[a];
        const double way = below < above ? below : above;
        if (way < least) {
            least = way;
            axis = a;
            side = below < above ? -1 : 1;
        }
    }
    for (int a = 0; a < 3; a++)
        dir[a] = a == axis ? side * 16 : aside[a];
}

static bool is_beyond(const cgt_committed_scene *s, const float org[3])
{
    bool beyond = !s->valid;
    for (int a = 0; a < 3; a++)
        beyond |= org[a] < s->low[a] || org[a] > s->high[a];
    return beyond;
}

static void fill_lists(const inside_chunk *c, cgt_hit_list *list, uint32_t count)
{
    const inside_job *job = c->job;
    cgt_list_rays(job->scene, &job->settings, &job->bands, list, count, c->counts);
}

/* Lists of all points, of a range from 0 to t_max. */
static void list_points(inside_chunk *c, cgt_list_kind kind, uint32_t capacity, float t_max)
{
    for (uint32_t k = 0; k < c->points; k++) {
        inside_point *p = &c->point[k];
        p->ray.t_max = t_max;
        c->list[k] = (cgt_hit_list){.kind = kind,
                                    .without_spheres = c->direct && kind == CGT_LIST_CROSSINGS,
                                    .prims = &c->job->scene->committed_scene.prims,
                                    .ray = &p->ray,
                                    .skip = CGT_INVALID_ID,
                                    .mask = ray_read_mask(&c->source, p->number),
                                    .hit = c->hit + (size_t)k * LIST_HITS,
                                    .capacity = capacity,
                                    .wants_more = capacity > 1};
    }
    fill_lists(c, c->list, c->points);
}

/* Ends with a point that is inside, or keeps it. */
static void settle_point(inside_chunk *c, uint32_t k, bool inside, uint32_t *kept)
{
    c->counts->double_tests += c->list[k].double_tests;
    c->counts->exact_tests += c->list[k].exact_tests;
    c->counts->hits += inside;
    c->job->inside[c->point[k].number] = inside;
    if (!inside)
        c->point[(*kept)++] = c->point[k];
}

/* ---- sums ---- */

/* Adds a crossing. Returns by how much the number of geometries grows that the point is in. */
static int add_crossing(inside_chunk *c, const cgt_hit_list *list, const cgt_listed_hit *h)
{
    const cgt_primitive_array *array = cgt_primitives_array(list->prims, h->prim);
    const uint32_t number = (uint32_t)(array - list->prims->array) - c->first_array;
    if (number >= c->sums || (list->without_spheres && array->kind == CGT_KIND_SPHERES))
        return 0;
    inside_sum *of = &c->sum[number];
    if (of->stamp != c->stamp)
        *of = (inside_sum){.stamp = c->stamp};
    const int32_t before = of->sum;
    const bool parity = array->kind == CGT_KIND_TRIANGLES && c->job->rule == CGT_INSIDE_PARITY;
    of->sum = parity ? !before : before + cgt_hit_list_side(list, h);
    return (of->sum != 0) - (before != 0);
}

/* Whether crossings say so, of geometries first_array on. */
static bool is_crossed(inside_chunk *c, cgt_hit_list *list)
{
    int bodies = 0;
    c->stamp++;
    for (;;) {
        for (uint32_t k = 0; k < list->count; k++)
            bodies += add_crossing(c, list, &list->hit[k]);
        if (!list->more || !cgt_hit_list_go_on(list))
            return bodies > 0;
        list->count = 0;
        list->more = false;
        fill_lists(c, list, 1);
    }
}

/* ---- points ---- */

static void look_up_spheres(inside_chunk *c)
{
    uint32_t kept = 0;
    list_points(c, CGT_LIST_CONTAINERS, 1, 0);
    for (uint32_t k = 0; k < c->points; k++)
        settle_point(c, k, c->list[k].count > 0, &kept);
    c->points = kept;
}

static void cross_surfaces(inside_chunk *c)
{
    uint32_t kept = 0;
    list_points(c, CGT_LIST_CROSSINGS, LIST_HITS, INFINITY);
    for (uint32_t k = 0; k < c->points; k++)
        settle_point(c, k, is_crossed(c, &c->list[k]), &kept);
    c->points = kept;
}

static void find_inside(inside_chunk *c)
{
    const cgt_primitives *prims = &c->job->scene->committed_scene.prims;
    if (c->direct && prims->spheres)
        look_up_spheres(c);
    if (!c->direct || prims->triangles)
        for (c->first_array = 0; c->first_array < prims->arrays && c->points; c->first_array += WINDOW)
            cross_surfaces(c);
    c->points = 0;
}

/* Reads a point to those that are asked for, if it is not settled at once. */
static void begin_point(inside_chunk *c, uint64_t i)
{
    const cgt_committed_scene *s = &c->job->scene->committed_scene;
    inside_point *p = &c->point[c->points];
    uint32_t farthest = 0;
    *p = (inside_point){.number = i};
    for (int a = 0; a < 3; a++) {
        p->ray.line.org[a] = ray_component(&c->source, c->job->points.org[a], i);
        farthest = ray_larger(farthest, ray_magnitude(p->ray.line.org[a]));
    }
    c->counts->rays++;
    c->counts->invalid_rays += farthest >= RAY_NOT_FINITE;
    c->job->inside[i] = 0;
    if (farthest >= RAY_NOT_FINITE || is_beyond(s, p->ray.line.org))
        return;
    choose_direction(s, p->ray.line.org, p->ray.line.dir);
    c->counts->bvh_rays += c->use_bvh;
    c->points++;
}

static void inside_task(void *argument, uint32_t index, cgt_scratch *scratch)
{
    const inside_job *job = argument;
    const uint32_t arrays = job->scene->committed_scene.prims.arrays;
    cgt_counts counts = {.scratch = scratch};
    const uint64_t first = (uint64_t)index * CGT_RAYS_CHUNK, left = job->points.count - first,
                   end = first + (left < CGT_RAYS_CHUNK ? left : CGT_RAYS_CHUNK);
    inside_chunk c = {.job = job,
                      .source = ray_source_init(&job->points, NULL),
                      .use_bvh = cgt_lists_use_bvh(job->scene, &job->settings, &job->bands),
                      .direct = !job->scene->in_bands && job->settings.use_bvh,
                      .sums = arrays < WINDOW ? arrays : WINDOW,
                      .counts = &counts};
    c.point = cgt_scratch_take(scratch, LISTS * sizeof *c.point);
    c.list = cgt_scratch_take(scratch, LISTS * sizeof *c.list);
    c.hit = cgt_scratch_take(scratch, LISTS * LIST_HITS * sizeof *c.hit);
    c.sum = cgt_scratch_take(scratch, c.sums * sizeof *c.sum);
    memset(c.sum, 0, c.sums * sizeof *c.sum);
    for (uint64_t i = first; i < end;) {
        while (i < end && c.points < LISTS)
            begin_point(&c, i++);
        find_inside(&c);
    }
    cgt_scratch_return(scratch, c.point);
    cgt_trace_counter_add(job->counter, &counts);
}

cgt_result cgt_points_inside(const cgt_scene *scene, const cgt_points *points, const cgt_inside_options *how,
                             uint8_t *inside, const cgt_trace_options *options)
{
    cgt_trace_counter counter;
    if (!scene || !points || (!inside && points->count))
        return cgt_fail_null(scene, __func__);
    cgt_context *c = scene->context;
    inside_job job = {.scene = scene,
                      .points = {.count = points->count,
                                 .stride = points->stride,
                                 .vector_stride = points->vector_stride,
                                 .org = {points->position[0], points->position[1], points->position[2]},
                                 .mask = points->mask},
                      .rule = how ? how->rule : default_inside.rule,
                      .inside = inside,
                      .counter = &counter};
    cgt_result result = cgt_trace_prepare(scene, options, false, &job.settings, &counter);
    if (result == CGT_OK)
        result = cgt_check_crossings(scene);
    if (result == CGT_OK && (unsigned)job.rule > CGT_INSIDE_WINDING)
        result = cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "inside options: rule %d is unknown", (int)job.rule);
    if (result == CGT_OK)
        result = cgt_check_points(c, points);
    if (result == CGT_OK)
        result = cgt_ready_lists(scene, points->count, &job.settings, &job.bands);
    if (result == CGT_OK)
        result = cgt_run_scratch_tasks(c, inside_task, &job,
                                       (uint32_t)((points->count + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK));
    if (result == CGT_OK)
        cgt_trace_store_statistics(options, &job.settings, &counter);
    return result;
}
