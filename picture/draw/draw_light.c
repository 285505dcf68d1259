/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What arrives at the hits of a frame: the sky, by the library's ambient occlusion; lights without extent, by its
 * shadows of a frame; lights with a size, by rays to points on their discs.
 *
 * The points follow interleaved sampling (Keller, Heidrich, "Interleaved Sampling", EGWR 2001): of one (0, m,
 * 2)-sequence, Sobol's first two dimensions, each pixel of a 4x4 block takes a run of its own, and the shading averages
 * over 5x5 pixels, whose outer rows and columns count half (draw_smooth.c): wherever it lies, such a window holds each
 * run as often as any other, so that 8 rays a pixel act as 128. The runs depend on the pixel's place alone. */
#include <math.h>
#include <stdlib.h>

#include "draw/draw.h"
#include "vector_range.h"

enum { ROWS = 16 }; /* of rays that go to a light together */

static const float pi = 3.14159265f;

/* ---- The sky ------------------------------------------------------------------------------------------------ */

/* The share of open rays once `more` follow `done`, from both shares: as one call would have it. */
static float add_shares(float share, uint32_t done, float more_share, uint32_t more)
{
    return (rintf(share * (float)done) + rintf(more_share * (float)more)) / (float)(done + more);
}

/* Adds a step's sky, of some rays, while that is in cache. */
typedef struct sky_step {
    const drawing *drawing;
    const float *more_sky;
    uint32_t samples;
} sky_step;

static cgt_visit add_sky(void *user, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height)
{
    const sky_step *step = user;
    const drawing *d = step->drawing;
    for (uint32_t y = y0; y < y0 + height; y++)
        for (uint32_t x = x0; x < x0 + width; x++) {
            const size_t k = (size_t)y * d->ray_width + x;
            d->sky_plane[k] = add_shares(d->sky_plane[k], d->samples, step->more_sky[k], step->samples);
        }
    return draw_is_stopped(d) ? CGT_VISIT_STOP : CGT_VISIT_CONTINUE;
}

static cgt_visit watch_sky(void *user, uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    (void)x, (void)y, (void)width, (void)height;
    return draw_is_stopped(user) ? CGT_VISIT_STOP : CGT_VISIT_CONTINUE;
}

/* The camera of the frame, with the mask of what casts shadows. */
static cgt_camera light_camera(const drawing *d)
{
    cgt_camera camera = d->camera;
    camera.mask = d->light_mask;
    return camera;
}

cgt_result cgt_draw_trace_sky(drawing *d, const cgt_scene *scene, uint32_t samples)
{
    cgt_frame frame = cgt_draw_frame(d);
    sky_step step = {.drawing = d, .samples = samples};
    cgt_ambient_options ambient;
    if (!samples)
        return CGT_OK;
    cgt_ambient_options_init(&ambient);
    ambient.samples = samples;
    ambient.first = d->samples;
    ambient.radius = d->options->lighting.ambient_radius; /* 0: infinite, here and there */
    ambient.visitor = watch_sky;
    ambient.visitor_user = d;
    if (d->samples) {
        if (!d->more_sky)
            d->more_sky = malloc((size_t)d->ray_width * d->ray_height * sizeof(float));
        if (!d->more_sky)
            return CGT_ERROR_OUT_OF_MEMORY;
        step.more_sky = d->more_sky;
        ambient.visitor = add_sky;
        ambient.visitor_user = &step;
    }
    d->sky = d->sky_plane;
    frame.primitive = (uint32_t *)draw_rest(d);
    const cgt_camera camera = light_camera(d);
    return cgt_ambient_occlusion(scene, &camera, &frame, &ambient, d->samples ? d->more_sky : d->sky_plane, NULL);
}

/* ---- Hard shadows ------------------------------------------------------------------------------------------- */

cgt_result cgt_draw_trace_hard_lights(drawing *d, const cgt_scene *scene)
{
    const cgt_frame frame = cgt_draw_frame(d);
    cgt_light lights[CGT_PICTURE_MAX_LIGHTS];
    uint8_t *occluded = NULL; /* the first plane: the others follow in the order of the lights */
    uint32_t count = 0;
    for (uint32_t i = 0; i < d->options->lighting.light_count; i++)
        if (d->occluded[i]) {
            occluded = count ? occluded : d->occluded[i];
            lights[count++] = d->options->lighting.lights[i].light;
        }
    const cgt_camera camera = light_camera(d);
    return count ? cgt_occluded_frame(scene, &camera, &frame, lights, count, NULL, occluded, NULL) : CGT_OK;
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
    const cgt_picture_light *light;
    uint32_t first, samples; /* of each run, in this step */
    uint32_t run;            /* points of a run: of all steps */
    float (*disc)[2];        /* 16 runs */
    float *org[3], *dir[3], *t_max;
    uint32_t *primitive, *geometry, *mask; /* mask: NULL where all cast shadows */
    uint8_t *occluded;
    uint32_t *ray; /* of each hit in the strip: its place in the planes, less that of the strip */
    uint32_t hits;
    void *memory;
} light_rays;

static int light_rays_init(light_rays *r, const drawing *d, const cgt_picture_light *light, uint32_t samples)
{
    const uint32_t run = d->light_samples;
    const size_t hits = (size_t)d->ray_width * ROWS, others = (hits + 32 * (size_t)run) * sizeof(float);
    const size_t a_ray = (d->light_mask ? 10 : 9) * sizeof(float) + 1;
    if (hits > (SIZE_MAX - others) / a_ray / samples)
        return -1;
    const size_t rays = hits * samples, masks = d->light_mask ? rays : 0;
    float *at = malloc(rays * a_ray + others);
    r->light = light;
    r->first = d->samples;
    r->samples = samples;
    r->run = run;
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
    r->mask = masks ? (uint32_t *)(void *)(at + 3 * rays) : NULL;
    at += 3 * rays + masks;
    r->ray = (uint32_t *)(void *)at;
    r->disc = (float(*)[2])(void *)(at + hits);
    r->occluded = (uint8_t *)(at + hits + 32 * (size_t)run);
    for (size_t i = 0; i < masks; i++)
        r->mask[i] = d->light_mask;
    for (uint32_t i = 0; i < 16 * run; i++) {
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
    const cgt_picture_light *l = r->light;
    const float(*disc)[2] = (const float(*)[2])(r->disc + (size_t)run[(y & 3) * 4 + (x & 3)] * r->run + r->first);
    const int lamp = l->light.kind == CGT_LIGHT_POINT;
    float org[3], dir[3], axis[3], a[3], b[3];
    draw_ray(d, x, y, org, dir);
    for (int c = 0; c < 3; c++) {
        org[c] += d->t[element] * dir[c];
        axis[c] = lamp ? l->light.position[c] - org[c] : l->light.position[c];
    }
    const int exponent = picture_bring_near(axis);
    const float length = sqrtf(picture_square(axis));
    for (int c = 0; c < 3; c++)
        axis[c] = length > 0.0f ? axis[c] / length : c == 2 ? 1.0f : 0.0f;
    basis(axis, a, b);
    const float radius = lamp ? l->size : tanf(l->size * pi / 180.0f), reach = lamp ? ldexpf(length, exponent) : 1.0f;
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

/* Whether a sphere's hit faces so far away from the light that the shading leaves it dark, whatever lies in between,
 * and its lit neighbours, too: draw_smooth.c averages where normals are less than 25.9 degrees apart. Triangles are
 * shaded by vertex normals and from both sides. */
static int is_averted(const drawing *d, const cgt_picture_light *l, size_t element, uint32_t x, uint32_t y)
{
    static const float steepest = -0.436f; /* minus the sine of that */
    float org[3], dir[3], to[3], towards = 0.0f;
    if (draw_look(d, d->geometry[element])->is_triangles)
        return 0;
    draw_ray(d, x, y, org, dir);
    for (int c = 0; c < 3; c++) {
        const float at = l->light.kind == CGT_LIGHT_POINT ? org[c] + d->t[element] * dir[c] : 0.0f;
        to[c] = l->light.position[c] - at;
    }
    picture_bring_near(to);
    for (int c = 0; c < 3; c++)
        towards += d->normal[c][element] * to[c];
    return towards <= 0.0f && towards * towards >= steepest * steepest * picture_square(to);
}

static cgt_result trace_strip(drawing *d, const cgt_scene *scene, light_rays *r, uint32_t y0, float *reach)
{
    const size_t first = (size_t)y0 * d->ray_width;
    const uint32_t end = d->first_ray_row + d->ray_rows, y1 = y0 + ROWS < end ? y0 + ROWS : end;
    const uint32_t *const rest = draw_rest(d);
    r->hits = 0;
    for (uint32_t y = y0 > d->first_ray_row ? y0 : d->first_ray_row; y < y1; y++)
        for (uint32_t x = 0; x < d->ray_width; x++) {
            const size_t element = (size_t)y * d->ray_width + x;
            if (!r->first)
                reach[element] = 1.0f;
            if (rest[element] != CGT_INVALID_ID && !is_averted(d, r->light, element, x, y))
                append_hit(r, d, x, y, element);
        }
    const cgt_rays rays = {.count = (uint64_t)r->hits * r->samples,
                           .org = {r->org[0], r->org[1], r->org[2]},
                           .dir = {r->dir[0], r->dir[1], r->dir[2]},
                           .t_max = r->t_max,
                           .mask = r->mask,
                           .skip_primitive = r->primitive,
                           .skip_geometry = r->geometry};
    const cgt_result result = rays.count ? cgt_occluded_rays(scene, &rays, r->occluded, NULL) : CGT_OK;
    for (uint32_t i = 0; i < r->hits && result == CGT_OK; i++) {
        uint32_t free_rays = r->samples;
        for (uint32_t k = 0; k < r->samples; k++)
            free_rays -= r->occluded[(size_t)i * r->samples + k];
        float *const at = &reach[first + r->ray[i]];
        *at = add_shares(*at, r->first, (float)free_rays / (float)r->samples, r->samples);
    }
    return result;
}

cgt_result cgt_draw_trace_soft_light(drawing *d, const cgt_scene *scene, uint32_t light, uint32_t samples)
{
    light_rays rays;
    if (!samples)
        return CGT_OK;
    if (light_rays_init(&rays, d, &d->options->lighting.lights[light], samples))
        return CGT_ERROR_OUT_OF_MEMORY;
    cgt_result result = CGT_OK;
    d->reach[light] = d->reach_plane[light];
    const uint32_t end = d->first_ray_row + d->ray_rows;
    for (uint32_t y = d->first_ray_row / ROWS * ROWS; y < end && result == CGT_OK; y += ROWS)
        result = draw_is_stopped(d) ? CGT_ERROR_STOPPED : trace_strip(d, scene, &rays, y, d->reach[light]);
    free(rays.memory);
    return result;
}
