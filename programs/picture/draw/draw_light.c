/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What arrives at the hits of a frame: the sky, by the library's ambient occlusion; lights without extent, by its
 * shadows of a frame; lights with a size, by rays to points on their discs.
 *
 * The points follow interleaved sampling (Keller, Heidrich, "Interleaved Sampling", EGWR 2001): of one (0, m,
 * 2)-sequence, Sobol's first two dimensions, each pixel of a 4x4 block takes a run of its own, and the shading averages
 * over 4x4 pixels, wherever they begin: such a window holds each run once, so that 8 rays a pixel act as 128. The runs
 * depend on the pixel's place alone. */
#include <math.h>
#include <stdlib.h>

#include "picture/draw/draw.h"

enum { ROWS = 16 }; /* of rays that go to a light together */

static const float pi = 3.14159265f;

/* ---- The sky ------------------------------------------------------------------------------------------------ */

/* The rays of a pixel are shared by its samples; each has one at least. */
static uint32_t share_of(uint32_t rays, uint32_t samples)
{
    const uint32_t share = rays / (samples * samples);
    return share ? share : 1;
}

static cgt_frame planes_of(const drawing *d)
{
    cgt_frame frame;
    cgt_frame_init(&frame, d->ray_width, d->ray_height);
    frame.t = d->t;
    frame.primitive = d->primitive;
    frame.geometry = d->geometry;
    for (int c = 0; c < 3; c++)
        frame.normal[c] = d->normal[c];
    return frame;
}

static cgt_result trace_sky(drawing *d, const cgt_scene *scene, const cgt_frame *frame)
{
    cgt_ambient_options ambient;
    cgt_ambient_options_init(&ambient);
    ambient.samples = share_of(d->settings.ambient, d->settings.samples);
    ambient.radius = d->settings.ambient_radius; /* 0: infinite, here and there */
    return cgt_ambient_occlusion(scene, &d->camera, frame, &ambient, d->sky, NULL);
}

/* ---- Hard shadows ------------------------------------------------------------------------------------------- */

static cgt_result trace_hard_lights(drawing *d, const cgt_scene *scene, const cgt_frame *frame)
{
    cgt_light lights[DRAW_MAX_LIGHTS];
    uint8_t *occluded = NULL; /* the first plane: the others follow in the order of the lights */
    uint32_t count = 0;
    for (uint32_t i = 0; i < d->settings.light_count; i++)
        if (d->occluded[i]) {
            occluded = count ? occluded : d->occluded[i];
            lights[count++] = d->settings.lights[i].light;
        }
    return count ? cgt_occluded_frame(scene, &d->camera, frame, lights, count, NULL, occluded, NULL) : CGT_OK;
}

/* ---- Soft shadows ------------------------------------------------------------------------------------------- */

/* Point i of Sobol's sequence in its first two dimensions, each 0 to below 1. */
static void sobol(uint32_t i, float point[2])
{
    uint32_t x = 0, y = 0, direction = 1u << 31;
    for (uint32_t bit = 0; bit < 32; bit++, direction ^= direction >> 1) {
        if (!(i >> bit))
            break;
        if (i >> bit & 1) {
            x ^= 1u << (31 - bit);
            y ^= direction;
        }
    }
    point[0] = (float)(x >> 8) * 0x1p-24f;
    point[1] = (float)(y >> 8) * 0x1p-24f;
}

/* From the square to the disc of radius 1 (Shirley, Chiu, "A Low Distortion Map Between Disk and Square", 1997). */
static void to_disc(float point[2])
{
    const float a = 2.0f * point[0] - 1.0f, b = 2.0f * point[1] - 1.0f;
    float r, phi;
    if (a == 0.0f && b == 0.0f) {
        point[0] = point[1] = 0.0f;
        return;
    }
    if (fabsf(a) > fabsf(b)) {
        r = a;
        phi = pi / 4.0f * (b / a);
    } else {
        r = b;
        phi = pi / 2.0f - pi / 4.0f * (a / b);
    }
    point[0] = r * cosf(phi);
    point[1] = r * sinf(phi);
}

/* The rays of a strip of the frame to one light, in arrays that are filled and traced once a strip. */
typedef struct light_rays {
    const draw_light *light;
    uint32_t samples;
    float (*disc)[2]; /* 16 runs of `samples` points */
    float *org[3], *dir[3], *t_max;
    uint32_t *primitive, *geometry;
    uint8_t *occluded;
    uint32_t *ray; /* of each hit in the strip: its place in the planes, less that of the strip */
    uint32_t hits;
    void *memory;
} light_rays;

static int light_rays_init(light_rays *r, const drawing *d, const draw_light *light)
{
    const uint32_t samples = share_of(d->settings.light_samples, d->settings.samples);
    const size_t hits = (size_t)d->ray_width * ROWS, rays = hits * samples; /* at most 2^20 * 2^8 */
    float *at = malloc((rays * 9 + hits + 32 * (size_t)samples) * sizeof(float) + rays);
    r->light = light;
    r->samples = samples;
    r->memory = at;
    if (!at)
        return -1;
    for (int c = 0; c < 3; c++, at += 2 * rays) {
        r->org[c] = at;
        r->dir[c] = at + rays;
    }
    r->t_max = at;
    r->primitive = (uint32_t *)(void *)(at + rays);
    r->geometry = (uint32_t *)(void *)(at + 2 * rays);
    r->ray = (uint32_t *)(void *)(at + 3 * rays);
    r->disc = (float(*)[2])(void *)(at + 3 * rays + hits);
    r->occluded = (uint8_t *)(at + 3 * rays + hits + 32 * (size_t)samples);
    for (uint32_t i = 0; i < 16 * samples; i++) {
        sobol(i, r->disc[i]);
        to_disc(r->disc[i]);
    }
    return 0;
}

/* Two unit vectors that make a right-handed frame with the unit vector n (Duff et al., "Building an Orthonormal Basis,
 * Revisited", JCGT 2017). */
static void basis(const float n[3], float a[3], float b[3])
{
    const float sign = n[2] < 0.0f ? -1.0f : 1.0f, k = -1.0f / (sign + n[2]), m = n[0] * n[1] * k;
    a[0] = 1.0f + sign * n[0] * n[0] * k;
    a[1] = sign * m;
    a[2] = -sign * n[0];
    b[0] = m;
    b[1] = sign + n[1] * n[1] * k;
    b[2] = -n[1];
}

/* Appends the rays of a hit: to points on the light's disc, which faces it. */
static void append_hit(light_rays *r, const drawing *d, uint32_t x, uint32_t y, size_t element)
{
    /* The order of Bayer's matrix: neighbours take runs that lie far apart. */
    static const uint8_t run[16] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    const draw_light *l = r->light;
    const float(*disc)[2] = (const float(*)[2])(r->disc + (size_t)run[(y & 3) * 4 + (x & 3)] * r->samples);
    const int lamp = l->light.kind == CGT_LIGHT_POINT;
    float org[3], dir[3], axis[3], a[3], b[3], length = 0.0f;
    draw_ray(d, x, y, org, dir);
    for (int c = 0; c < 3; c++) {
        org[c] += d->t[element] * dir[c];
        axis[c] = lamp ? l->light.position[c] - org[c] : l->light.position[c];
        length += axis[c] * axis[c];
    }
    length = sqrtf(length);
    for (int c = 0; c < 3; c++)
        axis[c] = length > 0.0f ? axis[c] / length : c == 2 ? 1.0f : 0.0f;
    basis(axis, a, b);
    const float radius = lamp ? l->size : tanf(l->size * pi / 180.0f), reach = lamp ? length : 1.0f;
    const size_t first = (size_t)r->hits * r->samples;
    for (uint32_t i = 0; i < r->samples; i++) {
        for (int c = 0; c < 3; c++) {
            r->org[c][first + i] = org[c];
            r->dir[c][first + i] = axis[c] * reach + radius * (disc[i][0] * a[c] + disc[i][1] * b[c]);
        }
        r->t_max[first + i] = lamp ? 1.0f : INFINITY;
        r->primitive[first + i] = d->primitive[element];
        r->geometry[first + i] = d->geometry[element];
    }
    r->ray[r->hits++] = (uint32_t)(element - (size_t)y / ROWS * ROWS * d->ray_width);
}

/* Whether a sphere's hit faces away from the light: the shading leaves it dark, whatever lies in between. Triangles are
 * shaded by vertex normals and from both sides. */
static int is_averted(const drawing *d, const draw_light *l, size_t element, uint32_t x, uint32_t y)
{
    float org[3], dir[3], towards = 0.0f;
    if (d->surfaces[d->geometry[element]].triangle)
        return 0;
    draw_ray(d, x, y, org, dir);
    for (int c = 0; c < 3; c++) {
        const float at = l->light.kind == CGT_LIGHT_POINT ? org[c] + d->t[element] * dir[c] : 0.0f;
        towards += d->normal[c][element] * (l->light.position[c] - at);
    }
    return towards <= 0.0f;
}

static cgt_result trace_strip(drawing *d, const cgt_scene *scene, light_rays *r, uint32_t y0, float *reach)
{
    const size_t first = (size_t)y0 * d->ray_width;
    const uint32_t y1 = y0 + ROWS < d->ray_height ? y0 + ROWS : d->ray_height;
    r->hits = 0;
    for (uint32_t y = y0; y < y1; y++)
        for (uint32_t x = 0; x < d->ray_width; x++) {
            const size_t element = (size_t)y * d->ray_width + x;
            reach[element] = 1.0f;
            if (d->primitive[element] != CGT_INVALID_ID && !is_averted(d, r->light, element, x, y))
                append_hit(r, d, x, y, element);
        }
    const cgt_rays rays = {.count = (uint64_t)r->hits * r->samples,
                           .org = {r->org[0], r->org[1], r->org[2]},
                           .dir = {r->dir[0], r->dir[1], r->dir[2]},
                           .t_max = r->t_max,
                           .skip_primitive = r->primitive,
                           .skip_geometry = r->geometry};
    const cgt_result result = rays.count ? cgt_occluded_rays(scene, &rays, r->occluded, NULL) : CGT_OK;
    for (uint32_t i = 0; i < r->hits && result == CGT_OK; i++) {
        uint32_t free_rays = r->samples;
        for (uint32_t k = 0; k < r->samples; k++)
            free_rays -= r->occluded[(size_t)i * r->samples + k];
        reach[first + r->ray[i]] = (float)free_rays / (float)r->samples;
    }
    return result;
}

static cgt_result trace_soft_light(drawing *d, const cgt_scene *scene, const draw_light *light, float *reach)
{
    light_rays rays;
    if (light_rays_init(&rays, d, light))
        return CGT_ERROR_OUT_OF_MEMORY;
    cgt_result result = CGT_OK;
    for (uint32_t y = 0; y < d->ray_height && result == CGT_OK; y += ROWS)
        result = d->settings.stop && *d->settings.stop ? CGT_ERROR_STOPPED : trace_strip(d, scene, &rays, y, reach);
    free(rays.memory);
    return result;
}

cgt_result draw_trace_lights(drawing *d, const cgt_scene *scene)
{
    const cgt_frame frame = planes_of(d);
    cgt_result result = d->sky ? trace_sky(d, scene, &frame) : CGT_OK;
    if (result == CGT_OK)
        result = trace_hard_lights(d, scene, &frame);
    for (uint32_t i = 0; i < d->settings.light_count && result == CGT_OK; i++) {
        const draw_light *light = &d->settings.lights[i];
        if (light->shadows && light->size > 0.0f)
            result = trace_soft_light(d, scene, light, d->reach[i]);
    }
    return result;
}
