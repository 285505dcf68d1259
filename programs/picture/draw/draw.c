/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Draws a frame; see draw.h. Here: its memory, the camera's rays, the order of the steps. */
#include "picture/draw/draw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/parallel.h"

/* ---- Memory ------------------------------------------------------------------------------------------------- */

static int is_soft(const draw_light *light) { return light->shadows && light->size > 0.0f; }

/* Bytes a ray: t, primitive, geometry and normal; then what the lights need. */
static size_t bytes_a_ray(const draw_settings *s)
{
    size_t bytes = 6 * sizeof(float);
    bytes += s->ambient ? sizeof(float) : 0;
    for (uint32_t i = 0; i < s->light_count; i++)
        bytes += !s->lights[i].shadows ? 0 : is_soft(&s->lights[i]) ? sizeof(float) : 1;
    return bytes;
}

static float *take(char **memory, size_t rays)
{
    float *plane = (float *)(void *)*memory;
    *memory += rays * sizeof(float);
    return plane;
}

/* Cuts the memory into planes; those of bytes come last, so that all are aligned. */
static void lay_out(drawing *d, size_t rays)
{
    const draw_settings *s = &d->settings;
    char *memory = d->memory;
    d->t = take(&memory, rays);
    d->primitive = (uint32_t *)(void *)take(&memory, rays);
    d->geometry = (uint32_t *)(void *)take(&memory, rays);
    for (int c = 0; c < 3; c++)
        d->normal[c] = take(&memory, rays);
    d->sky = s->ambient ? take(&memory, rays) : NULL;
    for (uint32_t i = 0; i < s->light_count; i++)
        d->reach[i] = is_soft(&s->lights[i]) ? take(&memory, rays) : NULL;
    for (uint32_t i = 0; i < s->light_count; i++) {
        const int is_hard = s->lights[i].shadows && !is_soft(&s->lights[i]);
        d->occluded[i] = is_hard ? (uint8_t *)memory : NULL;
        memory += is_hard ? rays : 0;
    }
}

int draw_init(drawing *d, const draw_settings *settings, const srgb_tables *tables)
{
    d->settings = *settings;
    d->tables = tables;
    d->ray_width = settings->width * settings->samples;
    d->ray_height = settings->height * settings->samples;
    d->share = 1.0f / (float)(settings->samples * settings->samples);
    if (settings->tiles)
        return 0;
    const uint64_t rays = (uint64_t)d->ray_width * d->ray_height;
    const size_t bytes = bytes_a_ray(settings);
    if (rays > SIZE_MAX / bytes)
        return -1;
    d->memory = malloc((size_t)rays * bytes);
    if (settings->front > 0.0f)
        d->behind = malloc((size_t)settings->width * settings->height * (sizeof(image_pixel) + 4));
    if (!d->memory || (settings->front > 0.0f && !d->behind))
        return -1;
    lay_out(d, (size_t)rays);
    return 0;
}

void draw_free(drawing *d)
{
    free(d->memory);
    free(d->uv_memory);
    free(d->behind);
    d->memory = d->uv_memory = d->behind = NULL;
}

/* ---- The camera --------------------------------------------------------------------------------------------- */

static void normalize(float v[3])
{
    const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int c = 0; c < 3; c++)
        v[c] = length > 0.0f ? v[c] / length : 0.0f;
}

static void cross(const float a[3], const float b[3], float out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

void draw_camera_axes(const cgt_camera *camera, float right[3], float up[3], float forward[3])
{
    for (int c = 0; c < 3; c++)
        forward[c] = camera->target[c] - camera->eye[c];
    normalize(forward);
    cross(forward, camera->up, right);
    normalize(right);
    cross(right, forward, up);
}

void draw_half_picture(const cgt_camera *camera, float aspect, float right[3], float up[3], float forward[3])
{
    draw_camera_axes(camera, right, up, forward);
    const float half = camera->projection == CGT_PROJECTION_PERSPECTIVE
                           ? tanf((camera->fov > 0.0f ? camera->fov : 45.0f) * 0.00872664626f)
                           : 0.5f * (camera->height > 0.0f ? camera->height : 2.0f);
    for (int c = 0; c < 3; c++) {
        right[c] *= half * aspect;
        up[c] *= half;
    }
}

/* The rays are for shading: those of the library differ in the last bits. */
void draw_begin(drawing *d, const cgt_camera *camera)
{
    d->camera = *camera;
    memcpy(d->origin, camera->eye, sizeof d->origin);
    draw_half_picture(camera, (float)d->settings.width / (float)d->settings.height, d->right, d->up, d->forward);
    atomic_store_explicit(&d->hits, 0, memory_order_relaxed);
}

/* ---- The frame ---------------------------------------------------------------------------------------------- */

static void shade_row(void *argument, uint32_t index)
{
    drawing *d = argument;
    atomic_fetch_add_explicit(&d->hits, draw_shade_row(d, index), memory_order_relaxed);
}

static int is_stopped(const drawing *d) { return d->settings.stop && *d->settings.stop; }

static int has_triangles(const drawing *d)
{
    int has = 0;
    for (uint32_t i = 0; i < DRAW_MAX_SURFACES; i++)
        has |= d->surfaces[i].triangle != NULL;
    return has;
}

/* Where on triangles the hits are, which spheres do not need. */
static int make_uv(drawing *d)
{
    const size_t rays = (size_t)d->ray_width * d->ray_height;
    if (!d->uv_memory)
        d->uv_memory = malloc(rays * 2 * sizeof(float)); /* draw_init has checked a larger size */
    d->u = d->uv_memory;
    d->v = d->u ? d->u + rays : NULL;
    return d->u ? 0 : -1;
}

cgt_result draw_planes(drawing *d, const cgt_scene *scene, const cgt_camera *camera, const cgt_trace_options *options)
{
    cgt_frame frame;
    draw_begin(d, camera);
    cgt_frame_init(&frame, d->ray_width, d->ray_height);
    frame.t = d->t;
    frame.primitive = d->primitive;
    frame.geometry = d->geometry;
    for (int c = 0; c < 3; c++)
        frame.normal[c] = d->normal[c];
    if (has_triangles(d)) {
        if (make_uv(d))
            return CGT_ERROR_OUT_OF_MEMORY;
        frame.u = d->u;
        frame.v = d->v;
    }
    cgt_result result = cgt_trace_camera(scene, camera, &frame, options);
    if (result == CGT_OK && !is_stopped(d))
        result = draw_trace_lights(d, scene);
    if (result != CGT_OK)
        return result;
    if (is_stopped(d))
        return CGT_ERROR_STOPPED;
    parallel_run(d->settings.threads, shade_row, d, d->settings.height);
    return CGT_OK;
}

static cgt_result draw_tiles(drawing *d, const cgt_scene *scene, const cgt_camera *camera,
                             const cgt_trace_options *options)
{
    cgt_frame frame;
    draw_begin(d, camera);
    cgt_frame_init(&frame, d->ray_width, d->ray_height);
    frame.visitor = draw_tile;
    frame.visitor_user = d;
    frame.visitor_fields = draw_tile_fields(d);
    return cgt_trace_camera(scene, camera, &frame, options);
}

cgt_result draw_frame(drawing *d, const cgt_scene *scene, const cgt_camera *camera, const cgt_trace_options *options)
{
    return d->settings.tiles ? draw_tiles(d, scene, camera, options)
           : d->behind       ? draw_layers(d, scene, camera, options)
                             : draw_planes(d, scene, camera, options);
}
