/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A frame by planes; see draw.h. Here: its memory, the camera's rays, the order of the steps. */
#include "draw/draw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "vector_range.h"

/* ---- Memory ------------------------------------------------------------------------------------------------- */

/* Bytes a ray: t, primitive, geometry and normal, or light; then what the lights need. */
static size_t bytes_a_ray(const drawing *d)
{
    const cgt_picture_options *const o = d->options;
    size_t bytes = 6 * sizeof(float);
    if (o->shading == CGT_SHADING_BOUNCES)
        return bytes;
    bytes += d->keeps_whole ? sizeof(uint32_t) : 0;
    bytes += o->lighting.ambient ? sizeof(float) : 0;
    for (uint32_t i = 0; i < o->lighting.light_count; i++)
        bytes += !o->lighting.lights[i].shadows ? 0 : draw_is_soft(&o->lighting.lights[i]) ? sizeof(float) : 1;
    return bytes;
}

/* The next plane of the memory, whose element `before` is its first. */
static void *take(uintptr_t *memory, size_t rays, size_t bytes, size_t before)
{
    void *const plane = (void *)(*memory - before * bytes);
    *memory += rays * bytes;
    return plane;
}

/* Cuts the memory into planes that begin at a row; those of bytes come last, so that all are aligned. */
static void lay_out(drawing *d, uint32_t first_row)
{
    const cgt_picture_options *o = d->options;
    const size_t rays = (size_t)d->ray_width * d->ray_height, before = (size_t)d->ray_width * first_row;
    const size_t size = sizeof(float);
    uintptr_t memory = (uintptr_t)d->memory;
    d->t = take(&memory, rays, size, before);
    d->primitive = take(&memory, rays, size, before);
    d->geometry = take(&memory, rays, size, before);
    if (o->shading == CGT_SHADING_BOUNCES) {
        d->light = take(&memory, rays, sizeof *d->light, before);
        return;
    }
    for (int c = 0; c < 3; c++)
        d->normal[c] = take(&memory, rays, size, before);
    d->rest_plane = d->keeps_whole ? take(&memory, rays, size, before) : NULL;
    d->sky_plane = o->lighting.ambient ? take(&memory, rays, size, before) : NULL;
    for (uint32_t i = 0; i < o->lighting.light_count; i++)
        d->reach_plane[i] = draw_is_soft(&o->lighting.lights[i]) ? take(&memory, rays, size, before) : NULL;
    for (uint32_t i = 0; i < o->lighting.light_count; i++) {
        const int is_hard = o->lighting.lights[i].shadows && !draw_is_soft(&o->lighting.lights[i]);
        d->occluded[i] = is_hard ? take(&memory, rays, 1, before) : NULL;
    }
}

size_t cgt_draw_row_bytes(const drawing *d) { return bytes_a_ray(d) * d->ray_width * d->antialias; }

void cgt_draw_move_planes(drawing *d, uint32_t first_row)
{
    d->first_plane_row = first_row;
    lay_out(d, first_row);
}

/* The rays of a pixel are shared by its rays of antialiasing, rounded up. */
static uint32_t share_of(uint32_t rays, const drawing *d)
{
    const uint32_t sharers = d->options->antialias * d->options->antialias;
    const uint32_t share = rays > sharers ? (rays + sharers - 1) / sharers : 1;
    return d->antialias == d->options->antialias ? share : share * draw_whole_rays(d->options);
}

int cgt_draw_init(drawing *d)
{
    const cgt_picture_options *o = d->options;
    d->ray_width = o->width * d->antialias;
    d->ray_height = o->height * d->antialias;
    d->share = 1.0f / (float)(o->antialias * o->antialias);
    if (o->shading == CGT_SHADING_PLAIN)
        return 0;
    const uint64_t rays = (uint64_t)d->ray_width * d->ray_height;
    const size_t bytes = bytes_a_ray(d);
    if (rays > SIZE_MAX / bytes)
        return -1;
    d->memory = malloc((size_t)rays * bytes);
    if (!d->memory)
        return -1;
    lay_out(d, 0);
    return 0;
}

/* Rows of rays above and below that shading looks at: by averages over neighbours, and by outlines. */
static uint32_t margin_of(const drawing *d)
{
    const cgt_picture_options *const o = d->options;
    if (o->shading != CGT_SHADING_FULL)
        return 0;
    const float line = o->style.outline > 0.0f ? fmaxf(1.0f, ceilf(o->style.outline * (float)o->antialias)) : 0.0f;
    const uint32_t neighbours = DRAW_NEIGHBOURS * d->antialias;
    return line > (float)neighbours ? (uint32_t)line : neighbours;
}

void cgt_draw_set_options(drawing *d, const cgt_picture_options *options)
{
    d->options = options;
    d->ambient = d->sky_plane ? share_of(options->lighting.ambient, d) : 0;
    d->light_samples = 0;
    for (uint32_t i = 0; i < options->lighting.light_count; i++)
        if (d->reach_plane[i])
            d->light_samples = share_of(options->lighting.light_samples, d);
    const uint32_t n = d->antialias, margin = margin_of(d);
    const uint32_t first = options->work.first_row * n, end = first + options->work.row_count * n;
    d->first_ray_row = first > margin ? first - margin : 0;
    d->ray_rows = (d->ray_height - end > margin ? end + margin : d->ray_height) - d->first_ray_row;
}

void cgt_draw_free(drawing *d)
{
    free(d->memory);
    free(d->uv_memory);
    free(d->more_sky);
    d->memory = d->uv_memory = d->more_sky = NULL;
}

/* ---- The camera --------------------------------------------------------------------------------------------- */

void cgt_draw_normalize(float v[3])
{
    picture_bring_near(v);
    const float length = sqrtf(picture_square(v));
    for (int c = 0; c < 3; c++)
        v[c] = length > 0.0f ? v[c] / length : 0.0f;
}

static void cross(const float a[3], const float b[3], float out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static bool is_zero(const float v[3]) { return v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f; }

cgt_camera cgt_draw_default_view(const cgt_camera *camera)
{
    cgt_camera seen = *camera, defaults;
    cgt_camera_init(&defaults);
    if (!is_zero(seen.up))
        return seen;
    if (is_zero(seen.eye) && is_zero(seen.target))
        memcpy(seen.eye, defaults.eye, sizeof seen.eye);
    memcpy(seen.up, defaults.up, sizeof seen.up);
    return seen;
}

void cgt_camera_get_axes(const cgt_camera *camera, float right[3], float up[3], float forward[3])
{
    cgt_camera seen = cgt_draw_default_view(camera);
    for (int c = 0; c < 3; c++)
        forward[c] = seen.target[c] - seen.eye[c];
    cgt_draw_normalize(forward);
    cgt_draw_normalize(seen.up);
    cross(forward, seen.up, right);
    cgt_draw_normalize(right);
    cross(right, forward, up);
}

void cgt_draw_half_picture(const cgt_camera *camera, float aspect, float right[3], float up[3], float forward[3])
{
    cgt_camera_get_axes(camera, right, up, forward);
    const float half = camera->projection == CGT_PROJECTION_PERSPECTIVE
                           ? tanf((camera->fov > 0.0f ? camera->fov : 45.0f) * 0.00872664626f)
                           : 0.5f * (camera->height > 0.0f ? camera->height : 2.0f);
    for (int c = 0; c < 3; c++) {
        right[c] *= half * aspect;
        up[c] *= half;
    }
}

/* The rays are for shading: those of the library differ in the last bits. */
void cgt_draw_begin(drawing *d, const cgt_camera *camera)
{
    d->camera = cgt_draw_default_view(camera);
    memcpy(d->origin, d->camera.eye, sizeof d->origin);
    cgt_draw_half_picture(camera, (float)d->options->width / (float)d->options->height, d->right, d->up, d->forward);
}

/* The picture's proportions are of no account but for rounding. */
void cgt_camera_get_key_light(const cgt_camera *camera, uint32_t width, uint32_t height, float direction[3])
{
    float axis[3][3], right = 0.0f, up = 0.0f;
    cgt_draw_half_picture(camera, (float)width / (float)height, axis[0], axis[1], axis[2]);
    for (int c = 0; c < 3; c++) {
        right += axis[0][c] * axis[0][c];
        up += axis[1][c] * axis[1][c];
    }
    for (int c = 0; c < 3; c++)
        direction[c] = 0.70f * axis[1][c] / sqrtf(up) - 0.45f * axis[0][c] / sqrtf(right) - 0.55f * axis[2][c];
}

/* ---- The frame ---------------------------------------------------------------------------------------------- */

/* Where on triangles and capsules the hits are, which spheres do not need. */
int cgt_draw_make_uv(drawing *d)
{
    const size_t rays = (size_t)d->ray_width * d->ray_height;
    if (!d->uv_memory)
        d->uv_memory = malloc(rays * 2 * sizeof(float)); /* cgt_draw_init has checked a larger size */
    uintptr_t memory = (uintptr_t)d->uv_memory;
    const size_t before = (size_t)d->ray_width * d->first_plane_row;
    d->u = memory ? take(&memory, rays, sizeof *d->u, before) : NULL;
    d->v = memory ? take(&memory, rays, sizeof *d->v, before) : NULL;
    return memory ? 0 : -1;
}

cgt_frame cgt_draw_frame(const drawing *d)
{
    cgt_frame frame;
    cgt_frame_init(&frame, d->ray_width, d->ray_height);
    frame.first_row = d->first_ray_row;
    frame.row_count = d->ray_rows;
    frame.t = d->t;
    frame.primitive = d->primitive;
    frame.geometry = d->geometry;
    for (int c = 0; c < 3; c++)
        frame.normal[c] = d->normal[c];
    return frame;
}

void cgt_draw_forget_light(drawing *d)
{
    d->samples = 0;
    d->sky = NULL;
    for (uint32_t i = 0; i < d->options->lighting.light_count; i++)
        d->reach[i] = NULL;
}

static cgt_visit watch_tile(void *user, const cgt_tile *tile)
{
    (void)tile;
    return draw_is_stopped(user) ? CGT_VISIT_STOP : CGT_VISIT_CONTINUE;
}

cgt_result cgt_draw_trace(drawing *d, const cgt_scene *scene, const cgt_trace_options *options)
{
    cgt_frame frame = cgt_draw_frame(d);
    if (d->has_triangles || d->has_halves) {
        if (cgt_draw_make_uv(d))
            return CGT_ERROR_OUT_OF_MEMORY;
        frame.u = d->u;
        frame.v = d->v;
    }
    if (d->options->work.stop) {
        frame.visitor = watch_tile;
        frame.visitor_user = d;
    }
    cgt_draw_forget_light(d);
    const bool is_hidden = d->behind && !d->camera.mask; /* a layer that the camera does not see */
    const cgt_result result = is_hidden ? CGT_OK : cgt_trace_camera(scene, &d->camera, &frame, options);
    if (result != CGT_OK)
        return result;
    if (d->behind) {
        const cgt_result hidden = cgt_draw_hide_layer(d);
        if (hidden != CGT_OK)
            return hidden;
    }
    return draw_is_stopped(d) ? CGT_ERROR_STOPPED : cgt_draw_trace_hard_lights(d, scene);
}

uint32_t cgt_draw_samples(const drawing *d) { return d->ambient > d->light_samples ? d->ambient : d->light_samples; }

/* How many of `more` rays are left of a whole, `done` of them being traced. */
static uint32_t rest_of(uint32_t whole, uint32_t done, uint32_t more)
{
    return whole <= done ? 0 : whole - done < more ? whole - done : more;
}

static cgt_result step_rays(drawing *d, const cgt_scene *scene, uint32_t samples)
{
    cgt_result result = cgt_draw_trace_sky(d, scene, rest_of(d->ambient, d->samples, samples));
    for (uint32_t i = 0; i < d->options->lighting.light_count && result == CGT_OK; i++)
        if (d->reach_plane[i])
            result = cgt_draw_trace_soft_light(d, scene, i, rest_of(d->light_samples, d->samples, samples));
    d->samples += rest_of(cgt_draw_samples(d), d->samples, samples);
    return result;
}

cgt_result cgt_draw_step(drawing *d, const cgt_scene *scene, uint32_t samples)
{
    const uint32_t more = rest_of(cgt_draw_samples(d), d->samples, samples);
    cgt_result result = step_rays(d, scene, more);
    if (result == CGT_OK && d->whole)
        result = step_rays(d->whole, scene, more * draw_whole_rays(d->options));
    return result == CGT_OK && d->whole ? cgt_draw_spread_whole(d) : result;
}

static void shade_row(void *argument, uint32_t index)
{
    drawing *d = argument;
    uint32_t hits = 0;
    const uint32_t y = d->options->work.first_row + index;
    if (!draw_is_stopped(d))
        hits = d->light ? cgt_draw_bounced_row(d, y) : cgt_draw_shade_row(d, y);
    atomic_fetch_add_explicit(&d->hits, hits, memory_order_relaxed);
}

cgt_result cgt_draw_shade(drawing *d)
{
    atomic_store_explicit(&d->hits, 0, memory_order_relaxed);
    const cgt_result result = cgt_context_run_tasks(d->context, shade_row, d, d->options->work.row_count);
    return result == CGT_OK && draw_is_stopped(d) ? CGT_ERROR_STOPPED : result;
}

cgt_result cgt_draw_tiles(drawing *d, const cgt_scene *scene, const cgt_trace_options *options)
{
    cgt_frame frame = cgt_draw_frame(d);
    atomic_store_explicit(&d->hits, 0, memory_order_relaxed);
    frame.visitor = cgt_draw_tile;
    frame.visitor_user = d;
    frame.visitor_fields = cgt_draw_tile_fields(d);
    return cgt_trace_camera(scene, &d->camera, &frame, options);
}
