/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Checks before a frame, and whole frames: a visitor of the camera's tiles sends each tile's rays on. */
#include <math.h>
#include <pthread.h>
#include <stddef.h>

#include "whitted/whitted_internal.h"

/* ---- Checks ------------------------------------------------------------------------------------------------- */

static bool in_range(const float *values, int count, float max)
{
    for (int i = 0; i < count; i++)
        if (!(values[i] >= 0.0f && values[i] <= max))
            return false;
    return true;
}

static const char *check_material(const cgt_material *m)
{
    if (m->kind != CGT_MATERIAL_MATTE && m->kind != CGT_MATERIAL_MIRROR && m->kind != CGT_MATERIAL_GLASS)
        return "a material is none of matte, mirror and glass";
    if (!in_range(m->color, 3, 1.0f))
        return "the colour of a material must be from 0 to 1";
    if (m->kind == CGT_MATERIAL_GLASS && !(m->index >= 1.0f && m->index <= 100.0f))
        return "the index of refraction of glass must be from 1 to 100";
    if (!in_range(m->absorption, 3, INFINITY))
        return "the absorption of a material must be 0 or more";
    if (!in_range(&m->gloss, 1, 1e6f))
        return "the gloss of a material must be from 0 to 1e6";
    return NULL;
}

/* Whether an array is of floats at multiples of 4, which hits are computed from, or is not there. */
static int is_plain(const cgt_array *a)
{
    return !a->data || (a->format == CGT_FORMAT_FLOAT && ((uintptr_t)a->data | a->stride) % sizeof(float) == 0);
}

/* Places and radii are read as they lie there. */
static bool has_origin_or_types(const whitted_geometry *g)
{
    const double *const origin = g->spheres ? g->spheres->origin : g->triangles->origin;
    return origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0 || (g->spheres && g->spheres->types.data);
}

static const char *check_geometry(const whitted *w, const whitted_geometry *g)
{
    if (!g->spheres == !g->triangles)
        return "a geometry must be either spheres or triangles";
    if (has_origin_or_types(g))
        return "a geometry must be without origin and types";
    if (g->spheres ? !is_plain(&g->spheres->centers) || !is_plain(&g->spheres->radii)
                   : !is_plain(&g->triangles->vertices))
        return "coordinates and radii of a geometry must be floats";
    const uint32_t count = g->spheres ? g->spheres->count : g->triangles->count;
    if (!g->material)
        return g->material_of_all < w->materials ? NULL : "a geometry has a material that does not exist";
    for (uint32_t i = 0; i < count; i++)
        if (g->material[i] >= w->materials)
            return "a primitive has a material that does not exist";
    return NULL;
}

const char *cgt_whitted_check(const whitted *w)
{
    const char *wrong = NULL;
    if (w->bounces > WHITTED_MAX_BOUNCES)
        return "there can be at most 64 bounces";
    if (!(w->faintest >= 0.0f && w->faintest <= 1.0f) || !(w->glass_shadow >= 0.0f && w->glass_shadow <= 1.0f))
        return "shares of light must be from 0 to 1";
    if (w->geometries < cgt_scene_get_geometries(w->scene))
        return "the scene has more geometries than are named";
    for (uint32_t i = 0; i < w->materials && !wrong; i++)
        wrong = check_material(&w->material[i]);
    for (uint32_t i = 0; i < w->geometries && !wrong; i++)
        wrong = check_geometry(w, &w->geometry[i]);
    for (uint32_t i = 0; i < w->lights && !wrong; i++) {
        const whitted_light *l = &w->light[i];
        if (!in_range(l->color, 3, INFINITY))
            wrong = "the brightness of a light must be 0 or more";
        for (int a = 0; a < 3; a++)
            if (!isfinite(l->light.position[a]))
                wrong = "the place of a light must be finite";
    }
    return wrong;
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

typedef struct frame_job {
    const whitted *w;
    const cgt_camera *camera;
    uint32_t width, height;
    float (*light)[3];
    pthread_mutex_t lock; /* of what follows */
    whitted_memory *idle;
    cgt_result result;
} frame_job;

static whitted_memory *take_memory(frame_job *job)
{
    pthread_mutex_lock(&job->lock);
    whitted_memory *m = job->idle;
    if (m)
        job->idle = m->next;
    pthread_mutex_unlock(&job->lock);
    return m ? m : cgt_whitted_memory_create(job->w->bounces);
}

static void give_back(frame_job *job, whitted_memory *m, cgt_result result)
{
    pthread_mutex_lock(&job->lock);
    if (m) {
        m->next = job->idle;
        job->idle = m;
    }
    if (result != CGT_OK)
        job->result = result;
    pthread_mutex_unlock(&job->lock);
}

/* The rays and hits of a rectangle of a tile. */
static cgt_result trace_part(frame_job *job, whitted_memory *m, const cgt_tile *tile, uint32_t x, uint32_t y,
                             uint32_t columns, uint32_t rows)
{
    float *const org[3] = {&m->org[0][0], &m->org[0][1], &m->org[0][2]};
    float *const dir[3] = {&m->dir[0][0], &m->dir[0][1], &m->dir[0][2]};
    uint32_t count = 0;
    for (uint32_t j = y; j < y + rows; j++)
        for (uint32_t i = x; i < x + columns; i++, count++) {
            const size_t from = j * tile->row_stride + i;
            m->hit[count] = (whitted_hit){tile->t[from], tile->primitive[from], tile->geometry[from]};
            m->pixel[count] = (tile->y + j) * job->width + tile->x + i;
        }
    const cgt_result result = cgt_camera_get_rays(job->camera, job->width, job->height, tile->x + x, tile->y + y,
                                                  columns, rows, sizeof m->org[0], org, dir);
    return result ? result : cgt_whitted_shade(job->w, m, count, job->light);
}

/* A tile, a wave at a time. */
static cgt_result trace_tile(frame_job *job, whitted_memory *m, const cgt_tile *tile)
{
    const uint32_t columns = tile->width < WHITTED_WAVE ? tile->width : WHITTED_WAVE, rows = WHITTED_WAVE / columns;
    cgt_result result = CGT_OK;
    for (uint32_t y = 0; y < tile->height; y += rows)
        for (uint32_t x = 0; x < tile->width && result == CGT_OK; x += columns) {
            const uint32_t right = tile->width - x, below = tile->height - y;
            result = trace_part(job, m, tile, x, y, right < columns ? right : columns, below < rows ? below : rows);
        }
    return result;
}

static cgt_visit visit(void *user, const cgt_tile *tile)
{
    frame_job *job = user;
    if (job->w->stop && job->w->stop(job->w->stop_user))
        return CGT_VISIT_STOP;
    whitted_memory *m = take_memory(job);
    const cgt_result result = m ? trace_tile(job, m, tile) : CGT_ERROR_OUT_OF_MEMORY;
    give_back(job, m, result);
    return result == CGT_OK ? CGT_VISIT_CONTINUE : CGT_VISIT_STOP;
}

cgt_result cgt_whitted_frame(const whitted *w, const cgt_camera *camera, uint32_t width, uint32_t height,
                             const cgt_frame *planes, float (*light)[3])
{
    frame_job job = {.w = w, .camera = camera, .width = width, .height = height, .light = light};
    cgt_frame frame;
    if (pthread_mutex_init(&job.lock, NULL))
        return CGT_ERROR_THREADS;
    if (planes)
        frame = *planes;
    else
        cgt_frame_init(&frame, width, height);
    frame.visitor = visit;
    frame.visitor_user = &job;
    frame.visitor_fields = (uint32_t)CGT_FIELD_T | (uint32_t)CGT_FIELD_PRIMITIVE | (uint32_t)CGT_FIELD_GEOMETRY;
    cgt_result result = cgt_trace_camera(w->scene, camera, &frame, w->trace);
    while (job.idle) {
        whitted_memory *m = job.idle;
        job.idle = m->next;
        cgt_whitted_memory_free(m);
    }
    pthread_mutex_destroy(&job.lock);
    return job.result ? job.result : result;
}
