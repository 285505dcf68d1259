/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See call_order.h. A counting sort: blocks find the keys of their points and count them, the counts of all blocks are
 * summed up, and blocks place their points. Stable, so the order is the same for any number of threads. */
#include "trace/order/call_order.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/float_environment.h"
#include "core/scratch_tasks.h"
#include "query/ray_intake.h"

#define SAMPLED_CHUNKS 16u /* that tell the bounds of the view */
#define SAMPLES 64u        /* points of each */
#define BLOCK (4u * CGT_RAYS_CHUNK)

/* Chunks lie close together where their bounds have at most so many times the sides of pieces of equal shares, and at
 * most so much of the sides of all. */
#define COHERENT_SIDES 1.5f
#define COHERENT_SHARE 0.8f

typedef struct order_job {
    const cgt_scene *scene;
    const cgt_rays *points;
    const cgt_light *light;
    cgt_light_view view;
    uint32_t (*place)[CGT_VIEW_KEYS]; /* of each block: how many points have a key, then where they go */
    uint32_t *number;
    uint16_t *key;
} order_job;

/* ---- the view ---- */

typedef struct view_bounds {
    float low[3], high[3];
} view_bounds;

static const view_bounds no_bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void widen(view_bounds *b, const float *at, int axes)
{
    for (int a = 0; a < axes; a++) {
        b->low[a] = fminf(b->low[a], at[a]);
        b->high[a] = fmaxf(b->high[a], at[a]);
    }
}

/* The sum of two sides; 0 of no points. */
static float sides_of(const view_bounds *b)
{
    const float x = b->high[0] - b->low[0], y = b->high[1] - b->low[1];
    return x >= 0 && y >= 0 ? x + y : 0;
}

/* What the view sees of a point, as light_apply_projection and light_unfold of the kernels say it but for rounding. */
static void view_point(const cgt_light_view *v, const float position[3], float seen[2])
{
    float from[3], sum = 0x1p-100f;
    for (int a = 0; a < 3; a++) {
        from[a] = position[a] - v->origin[a];
        sum += fabsf(from[a]);
    }
    for (uint32_t k = 0; k < 2; k++) {
        const float own = from[(v->main + 1 + k) % 3], other = from[(v->main + 2 - k) % 3];
        if (!v->is_point)
            seen[k] = own - v->slope[k] * from[v->main];
        else if (from[v->main] * v->sign >= 0)
            seen[k] = own / sum;
        else
            seen[k] = copysignf(1 - fabsf(other / sum), own);
    }
}

/* A sampled point. Returns whether it is live. */
static bool read_sample(const order_job *job, uint64_t i, float position[3])
{
    const ray_source source = ray_source_init(job->points, job->light);
    const cgt_ray ray = ray_read(&source, i);
    memcpy(position, ray.line.org, sizeof ray.line.org);
    return ray_classify(&ray, &RAY_NO_LIMITS) == RAY_PLAIN;
}

/* The number of sample k of chunk number `chunk` of those that are sampled. */
static uint64_t sample_number(const order_job *job, uint64_t chunk, uint64_t k)
{
    const uint64_t count = job->points->count, chunks = (count + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK;
    const uint64_t sampled = chunks < SAMPLED_CHUNKS ? chunks : SAMPLED_CHUNKS;
    const uint64_t first = chunks * chunk / sampled * CGT_RAYS_CHUNK;
    const uint64_t points = count - first < CGT_RAYS_CHUNK ? count - first : CGT_RAYS_CHUNK;
    return first + points * k / SAMPLES;
}

/* Axes and origin of the view, by the middle of the samples. */
static void aim_view(order_job *job, uint64_t sampled)
{
    cgt_light_view *v = &job->view;
    view_bounds bounds = no_bounds;
    float position[3], dir[3];
    for (uint64_t i = 0; i < sampled * SAMPLES; i++)
        if (read_sample(job, sample_number(job, i / SAMPLES, i % SAMPLES), position))
            widen(&bounds, position, 3);
    *v = (cgt_light_view){.is_point = job->light->kind == CGT_LIGHT_POINT};
    for (uint32_t a = 0; a < 3; a++) {
        const float middle = bounds.low[a] <= bounds.high[a] ? 0.5f * bounds.low[a] + 0.5f * bounds.high[a] : 0;
        const float light = job->light->position[a];
        dir[a] = v->is_point ? middle - light : light;
        v->origin[a] = v->is_point ? light : middle;
        v->main = fabsf(dir[a]) > fabsf(dir[v->main]) ? a : v->main;
    }
    v->sign = dir[v->main] < 0 ? -1 : 1;
    for (uint32_t k = 0; k < 2 && !v->is_point; k++)
        v->slope[k] = dir[(v->main + 1 + k) % 3] / dir[v->main];
}

/* Sets the view by samples. Returns whether chunks of the points lie close together as they are. */
static bool init_view(order_job *job)
{
    const uint64_t chunks = (job->points->count + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK;
    const uint64_t sampled = chunks < SAMPLED_CHUNKS ? chunks : SAMPLED_CHUNKS;
    const float equal = chunks ? COHERENT_SIDES / sqrtf((float)chunks) : 1;
    cgt_light_view *v = &job->view;
    view_bounds bounds = no_bounds;
    float sides = 0, points = 0, position[3], seen[2];
    aim_view(job, sampled);
    for (uint64_t chunk = 0; chunk < sampled; chunk++) {
        view_bounds own = no_bounds;
        for (uint64_t k = 0; k < SAMPLES; k++) {
            if (!read_sample(job, sample_number(job, chunk, k), position))
                continue;
            view_point(v, position, seen);
            widen(&own, seen, 2);
            widen(&bounds, seen, 2);
        }
        const uint64_t left = job->points->count - sample_number(job, chunk, 0);
        const float of_chunk = (float)(left < CGT_RAYS_CHUNK ? left : CGT_RAYS_CHUNK);
        sides += sides_of(&own) * of_chunk;
        points += of_chunk;
    }
    for (int k = 0; k < 2; k++) { /* bounds beyond the range of float are one cell */
        const float side = bounds.high[k] - bounds.low[k];
        v->low[k] = side > 0 ? bounds.low[k] : 0;
        v->scale[k] = side > 0 && side <= FLT_MAX ? (float)CGT_VIEW_EDGE / side : 0;
    }
    return chunks <= 1 || sides <= fminf(equal, COHERENT_SHARE) * sides_of(&bounds) * points;
}

/* ---- the sort ---- */

static uint32_t block_end(const order_job *job, uint32_t index)
{
    const uint64_t first = (uint64_t)index * BLOCK, left = job->points->count - first;
    return (uint32_t)(first + (left < BLOCK ? left : BLOCK));
}

static void count_block(void *argument, uint32_t index)
{
    const order_job *job = argument;
    const uint32_t end = block_end(job, index);
    uint32_t *count = job->place[index];
    memset(count, 0, sizeof job->place[index]);
    for (uint32_t i = index * BLOCK; i < end; i += CGT_RAYS_CHUNK) {
        const uint32_t last = end - i < CGT_RAYS_CHUNK ? end : i + CGT_RAYS_CHUNK;
        job->scene->context->kernel->light_keys(job->points, job->light, &job->view, i, last, job->key + i);
        for (uint32_t k = i; k < last; k++)
            count[job->key[k]]++;
    }
}

static void place_block(void *argument, uint32_t index)
{
    const order_job *job = argument;
    const uint32_t end = block_end(job, index);
    uint32_t *place = job->place[index];
    for (uint32_t i = index * BLOCK; i < end; i++)
        job->number[place[job->key[i]]++] = i;
}

/* From counts to places: cell by cell, and of each cell block by block. */
static void sum_up(const order_job *job, uint32_t blocks, cgt_call_order *o)
{
    uint32_t sum = 0;
    for (uint32_t key = 0; key < CGT_VIEW_KEYS; key++) {
        const uint32_t before = sum;
        for (uint32_t b = 0; b < blocks; b++) {
            const uint32_t count = job->place[b][key];
            job->place[b][key] = sum;
            sum += count;
        }
        o->live = key == CGT_VIEW_CELLS - 1 ? sum : o->live;
        o->invalid = key == CGT_VIEW_INVALID ? sum - before : o->invalid;
    }
}

/* Lays out the arrays of a call. */
static cgt_result reserve(order_job *job, uint32_t blocks, cgt_buffer *memory)
{
    cgt_context *c = job->scene->context;
    const size_t points = (size_t)blocks * BLOCK, of_points = points * (sizeof *job->number + sizeof *job->key);
    *memory = cgt_buffer_borrow(c);
    const cgt_result result = cgt_buffer_reserve(&c->memory, memory, of_points + blocks * sizeof *job->place, 1);
    if (result != CGT_OK) {
        cgt_buffer_give_back(c, *memory);
        return cgt_fail(c, result, "out of memory for the order of %zu points", (size_t)job->points->count);
    }
    job->number = memory->data;
    job->place = (uint32_t(*)[CGT_VIEW_KEYS])(void *)(job->number + points);
    job->key = (uint16_t *)(void *)(job->place + blocks);
    return CGT_OK;
}

cgt_result cgt_call_order_init(cgt_call_order *o, const cgt_scene *scene, const cgt_rays *points,
                               const cgt_light *light)
{
    const uint32_t blocks = (uint32_t)((points->count + BLOCK - 1) / BLOCK);
    order_job job = {.scene = scene, .points = points, .light = light};
    cgt_float_environment callers;
    *o = (cgt_call_order){.as_given = !points->count};
    if (!blocks)
        return CGT_OK;
    const cgt_result result = reserve(&job, blocks, &o->memory);
    if (result != CGT_OK)
        return result;
    cgt_float_environment_enter(&callers);
    const bool coherent = init_view(&job);
    cgt_float_environment_leave(&callers);
    if (coherent) /* the live ones as they are */
        job.view.scale[0] = job.view.scale[1] = 0;
    cgt_run_tasks(scene->context, count_block, &job, blocks);
    sum_up(&job, blocks, o);
    o->number = job.number;
    o->as_given = coherent && o->live == points->count;
    if (!o->as_given)
        cgt_run_tasks(scene->context, place_block, &job, blocks);
    return CGT_OK;
}

void cgt_call_order_release(cgt_call_order *o, const cgt_scene *scene)
{
    cgt_buffer_give_back(scene->context, o->memory);
}
