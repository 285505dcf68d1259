/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Mirrored and refracted rays from what rays have hit, as arrays (T. Whitted, "An Improved Illumination Model for
 * Shaded Display", 1980): cut into chunks, each a task. */
#include <cgt/bounces.h>

#include <float.h>

#include "dispatch/kernel.h"
#include "model/primitives.h"
#include "query/ray_intake.h"
#include "scene/scene.h"
#include "trace/bounce/optics.h"
#include "trace/bounce/surface.h"
#include "trace/trace_call.h"

enum { REFLECTED, REFRACTED, DIRECTIONS };

typedef struct bounce_job {
    const cgt_scene *scene;
    const cgt_rays *rays;
    const cgt_hits *hits;
    cgt_media media;                      /* strides and indices filled in, and so are those of the next */
    cgt_surfaces surfaces;                /* all NULL: not wanted */
    cgt_bounced_rays bounced[DIRECTIONS]; /* org[0] NULL: not wanted */
    ray_source source;
    size_t hit_stride;
    cgt_trace_counter *counter;
} bounce_job;

/* ---- elements of arrays ---- */

static uint32_t read_number(const uint32_t *array, size_t stride, uint64_t i)
{
    return *(const uint32_t *)(const void *)((const char *)array + i * stride);
}

static void write_float(float *array, size_t stride, uint64_t i, float value)
{
    if (array)
        memcpy((char *)array + i * stride, &value, sizeof value);
}

static void write_number(uint32_t *array, size_t stride, uint64_t i, uint32_t value)
{
    if (array)
        memcpy((char *)array + i * stride, &value, sizeof value);
}

static void write_double(double *array, size_t stride, uint64_t i, double value)
{
    if (array)
        memcpy((char *)array + i * stride, &value, sizeof value);
}

/* ---- a ray ---- */

/* What is read of a ray and its hit. */
typedef struct bounce_input {
    cgt_double_ray ray;
    cgt_primitive prim;
    uint32_t primitive, geometry;
    float t;
    double inside, outside; /* inside 0: opaque */
} bounce_input;

typedef enum bounce_state { BOUNCE_MISS, BOUNCE_INVALID, BOUNCE_HIT } bounce_state;

static bool is_index(float index) { return index > 0.0f && index <= FLT_MAX; }

/* The indices on both sides. Returns false where one is none. */
static bool read_media(const cgt_media *m, uint64_t i, bounce_input *in)
{
    float inside = m->inside, outside = m->outside;
    if (m->inside_of_ray)
        inside = ray_element(m->inside_of_ray, m->stride, i);
    else if (m->inside_of_primitive && in->geometry < m->geometries && m->inside_of_primitive[in->geometry])
        inside = m->inside_of_primitive[in->geometry][in->primitive];
    if (m->outside_of_ray)
        outside = ray_element(m->outside_of_ray, m->stride, i);
    in->inside = (double)inside;
    in->outside = outside == 0.0f ? 1.0 : (double)outside;
    return (inside == 0.0f || is_index(inside)) && (outside == 0.0f || is_index(outside));
}

/* Whether ray i has hit the primitive that it skips: a sphere or a capsule from inside, at its far root. */
static bool is_own(const bounce_job *job, uint64_t i, const bounce_input *in)
{
    const cgt_rays *r = job->rays;
    return r->skip_primitive && in->prim.kind != CGT_KIND_TRIANGLES &&
           ray_number(&job->source, r->skip_primitive, i) == in->primitive &&
           (r->skip_geometry ? ray_number(&job->source, r->skip_geometry, i) : 0) == in->geometry;
}

/* One of radius 0 has none: a place has no normal there. */
static bool has_surface(const cgt_primitive *p)
{
    return p->kind == CGT_KIND_TRIANGLES || (p->kind == CGT_KIND_SPHERES ? p->sphere.r : p->capsule.r) > 0.0f;
}

static bounce_state read_input(const bounce_job *job, uint64_t i, bounce_input *in)
{
    const cgt_rays *r = job->rays;
    const cgt_primitives *prims = &job->scene->committed_scene.prims;
    float org[3], dir[3];
    in->primitive = read_number(job->hits->primitive, job->hit_stride, i);
    if (in->primitive == CGT_INVALID_ID)
        return BOUNCE_MISS;
    in->geometry = job->hits->geometry ? read_number(job->hits->geometry, job->hit_stride, i) : 0;
    in->t = ray_element(job->hits->t, job->hit_stride, i);
    for (int a = 0; a < 3; a++) {
        org[a] = ray_component(&job->source, r->org[a], i);
        dir[a] = ray_component(&job->source, r->dir[a], i);
    }
    const uint32_t number = cgt_primitives_number(prims, in->geometry, in->primitive);
    if (number == CGT_INVALID_ID || !(fabsf(in->t) <= FLT_MAX) || !cgt_double_ray_init(org, dir, &in->ray) ||
        !read_media(&job->media, i, in))
        return BOUNCE_INVALID;
    in->prim = cgt_primitives_get(prims, number);
    if (!has_surface(&in->prim))
        return BOUNCE_INVALID;
    if (is_own(job, i, in)) /* whichever root the rounding of t is nearer to */
        in->t = INFINITY;
    return BOUNCE_HIT;
}

/* A new ray before it is stored. */
typedef struct bounce_output {
    float org[3], dir[3];
    float t_max, share;
    uint32_t primitive, geometry;
} bounce_output;

static const bounce_output no_ray = {
    .dir = {0, 0, 1}, .t_max = -1, .primitive = CGT_INVALID_ID, .geometry = CGT_INVALID_ID};

static void store_ray(const cgt_bounced_rays *to, uint64_t i, const bounce_output *out)
{
    if (!to->org[0])
        return;
    for (int a = 0; a < 3; a++) {
        write_float(to->org[a], to->vector_stride, i, out->org[a]);
        write_float(to->dir[a], to->vector_stride, i, out->dir[a]);
    }
    write_float(to->t_min, to->stride, i, 0);
    write_float(to->t_max, to->stride, i, out->t_max);
    write_number(to->skip_primitive, to->stride, i, out->primitive);
    write_number(to->skip_geometry, to->stride, i, out->geometry);
    write_float(to->share, to->stride, i, out->share);
}

static void store_surface(const cgt_surfaces *to, uint64_t i, const bounce_surface *s, const float start[3])
{
    for (int a = 0; a < 3; a++) {
        write_float(to->start[a], to->stride, i, start[a]);
        write_double(to->position[a], to->stride, i, s->position[a]);
        write_double(to->normal[a], to->stride, i, s->normal[a]);
    }
    write_double(to->length, to->stride, i, s->length);
    write_number(to->front, to->stride, i, s->front);
}

/* A ray that leaves the surface inside or outside of it; `place` has its origin. dir: of unit length but for
 * rounding. */
static void leave(const bounce_input *in, const bounce_output *place, const double dir[3], double share, bool inside,
                  bounce_output *out)
{
    const double length = sqrt(optics_dot(dir, dir));
    cgt_double_ray ray;
    *out = *place;
    for (int a = 0; a < 3; a++)
        out->dir[a] = (float)(dir[a] / length);
    out->share = (float)share;
    out->t_max = INFINITY;
    if (inside && in->prim.kind != CGT_KIND_TRIANGLES && cgt_double_ray_init(out->org, out->dir, &ray))
        out->t_max = (float)cgt_far_root(&in->prim, &ray);
}

/* The rays that go on from a surface. Those that do not, stay as they are. */
static void bounce(const bounce_input *in, const bounce_surface *s, const bounce_output *place,
                   bounce_output out[DIRECTIONS])
{
    double d[3], n[3], to[3], share = 1.0;
    const double here = s->front ? in->outside : in->inside, there = s->front ? in->inside : in->outside;
    for (int a = 0; a < 3; a++) {
        d[a] = in->ray.dir[a] / in->ray.length;
        n[a] = s->front ? s->normal[a] : -s->normal[a];
    }
    if (in->inside > 0.0 && here == there) { /* no boundary */
        leave(in, place, d, 1.0, s->front, &out[REFRACTED]);
        return;
    }
    if (in->inside > 0.0 && optics_refract(d, n, here / there, to, &share))
        leave(in, place, to, 1.0 - share, s->front, &out[REFRACTED]);
    optics_reflect(d, n, to);
    leave(in, place, to, share, !s->front, &out[REFLECTED]);
}

static bounce_state bounce_one(const bounce_job *job, uint64_t i)
{
    static const bounce_surface no_surface;
    bounce_output out[DIRECTIONS] = {no_ray, no_ray}, place = {.share = 0};
    bounce_input in;
    bounce_surface surface = no_surface;
    bounce_state state = read_input(job, i, &in);
    if (state == BOUNCE_HIT) {
        state = cgt_find_surface(&in.prim, &in.ray, in.t, &surface) ? BOUNCE_HIT : BOUNCE_INVALID;
        cgt_round_place(surface.position, in.ray.org, place.org);
        place.primitive = in.primitive;
        place.geometry = in.geometry;
        for (int a = 0; a < 3; a++)
            if (!(fabsf(place.org[a]) <= FLT_MAX))
                state = BOUNCE_INVALID;
    }
    if (state == BOUNCE_HIT)
        bounce(&in, &surface, &place, out);
    else
        surface = no_surface;
    store_surface(&job->surfaces, i, &surface, state == BOUNCE_HIT ? place.org : no_ray.org);
    store_ray(&job->bounced[REFLECTED], i, &out[REFLECTED]);
    store_ray(&job->bounced[REFRACTED], i, &out[REFRACTED]);
    return state;
}

static void bounce_chunk(void *argument, uint32_t index)
{
    const bounce_job *job = argument;
    const uint64_t first = (uint64_t)index * CGT_RAYS_CHUNK, remaining = job->rays->count - first;
    const uint64_t end = first + (remaining < CGT_RAYS_CHUNK ? remaining : CGT_RAYS_CHUNK);
    cgt_counts counts = {.rays = end - first};
    for (uint64_t i = first; i < end; i++) {
        const bounce_state state = bounce_one(job, i);
        counts.hits += state == BOUNCE_HIT;
        counts.invalid_rays += state == BOUNCE_INVALID;
    }
    cgt_trace_counter_add(job->counter, &counts);
}

/* ---- the call ---- */

static cgt_result prepare_media(cgt_context *c, const cgt_media *media, bounce_job *job)
{
    if (!media)
        return CGT_OK;
    job->media = *media;
    job->media.stride = ray_stride(media->stride);
    if (media->inside != 0.0f && !is_index(media->inside))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "media: inside must be 0, or finite and above 0");
    if (media->outside != 0.0f && !is_index(media->outside))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "media: outside must be 0, or finite and above 0");
    return cgt_check_strides(c, "media", media->stride, 0, job->rays->count);
}

static cgt_result prepare_surfaces(cgt_context *c, const cgt_surfaces *surfaces, bounce_job *job)
{
    if (!surfaces)
        return CGT_OK;
    job->surfaces = *surfaces;
    job->surfaces.stride = surfaces->stride ? surfaces->stride : sizeof(double);
    for (int a = 1; a < 3; a++)
        if (!surfaces->position[a] != !surfaces->position[0] || !surfaces->normal[a] != !surfaces->normal[0] ||
            !surfaces->start[a] != !surfaces->start[0])
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "surfaces: position, normal and start: all three or none");
    if (surfaces->stride % sizeof(double))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "surfaces: stride is not a multiple of 8");
    return cgt_check_strides(c, "surfaces", job->surfaces.stride, 0, job->rays->count);
}

static cgt_result prepare_bounced(cgt_context *c, const char *what, const cgt_bounced_rays *rays, bounce_job *job,
                                  cgt_bounced_rays *to)
{
    if (!rays)
        return CGT_OK;
    *to = *rays;
    to->stride = ray_stride(rays->stride);
    to->vector_stride = ray_vector_stride(rays->vector_stride, rays->stride);
    if (job->rays->count && !rays->t_max)
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: t_max must not be NULL", what);
    for (int a = 0; a < 3 && job->rays->count; a++)
        if (!rays->org[a] || !rays->dir[a])
            return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "%s: org and dir must not be NULL", what);
    return cgt_check_strides(c, what, rays->stride, rays->vector_stride, job->rays->count);
}

static cgt_result check_input(cgt_context *c, const bounce_job *job)
{
    const cgt_hits *h = job->hits;
    const cgt_result result = cgt_check_rays(c, job->rays);
    if (result == CGT_OK && job->rays->count && (!h->t || !h->primitive))
        return cgt_fail(c, CGT_ERROR_INVALID_ARGUMENT, "hits: t and primitive must not be NULL");
    return result == CGT_OK ? cgt_check_strides(c, "hits", h->stride, h->vector_stride, job->rays->count) : result;
}

cgt_result cgt_bounce_rays(const cgt_scene *scene, const cgt_rays *rays, const cgt_hits *hits, const cgt_media *media,
                           const cgt_surfaces *surfaces, const cgt_bounced_rays *reflected,
                           const cgt_bounced_rays *refracted, const cgt_trace_options *options)
{
    if (!scene || !rays || !hits)
        return cgt_fail_null(scene, __func__);
    cgt_context *c = scene->context;
    cgt_trace_counter counter;
    cgt_trace_settings settings;
    bounce_job job = {.scene = scene,
                      .rays = rays,
                      .hits = hits,
                      .source = ray_source_init(rays, NULL),
                      .hit_stride = ray_stride(hits->stride),
                      .counter = &counter};
    cgt_result result = cgt_trace_prepare(scene, options, false, &settings, &counter);
    if (result == CGT_OK)
        result = check_input(c, &job);
    if (result == CGT_OK)
        result = prepare_media(c, media, &job);
    if (result == CGT_OK)
        result = prepare_surfaces(c, surfaces, &job);
    if (result == CGT_OK)
        result = prepare_bounced(c, "reflected", reflected, &job, &job.bounced[REFLECTED]);
    if (result == CGT_OK)
        result = prepare_bounced(c, "refracted", refracted, &job, &job.bounced[REFRACTED]);
    if (result != CGT_OK)
        return result;
    cgt_run_tasks(c, bounce_chunk, &job, (uint32_t)((rays->count + CGT_RAYS_CHUNK - 1) / CGT_RAYS_CHUNK));
    cgt_trace_store_statistics(options, &settings, &counter);
    return CGT_OK;
}
