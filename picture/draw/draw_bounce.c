/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Mirrors and glass: pictures by Whitted's tracing (whitted/whitted.h), which gives each ray's light. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/draw_store.h"
#include "whitted/whitted.h"

static const float zenith[3] = {0.35f, 0.5f, 0.85f}; /* of the sky, times the background */
static const float faintest = 1.0f / 512.0f, glass_shadow = 0.6f;

/* Of a triangle whose vertices have colours, that of the first. */
static void color_of(void *user, uint32_t primitive, float rgb[3])
{
    static const float first = 0.0f;
    const picture_look *const look = user;
    float mixed[3];
    memcpy(rgb, look_color(look, primitive, &first, &first, 0, mixed), sizeof mixed);
}

static void set_light(const cgt_picture_options *o, whitted *w, whitted_light *lights)
{
    for (uint32_t i = 0; i < o->lighting.light_count; i++) {
        lights[i].light = o->lighting.lights[i].light;
        memcpy(lights[i].color, o->lighting.lights[i].color, sizeof lights[i].color);
    }
    w->light = lights;
    w->lights = o->lighting.light_count;
    for (int c = 0; c < 3; c++) {
        w->ambient[c] = o->lighting.sky;
        w->sky[1][c] = o->style.background[c];
        w->sky[0][c] = o->style.background[c] * zenith[c];
        w->rest[c] = 0.5f * o->style.background[c];
        w->up[c] = o->bounces.up[c];
    }
    if (w->up[0] == 0.0f && w->up[1] == 0.0f && w->up[2] == 0.0f)
        w->up[1] = 1.0f;
    cgt_draw_normalize(w->up);
}

/* The scene of a picture, for Whitted's tracing. */
static void set_geometries(const drawing *d, whitted_geometry *geometry)
{
    for (uint32_t i = 0; i < d->last_look; i++) {
        const picture_look *const l = &d->looks[i];
        geometry[i] = (whitted_geometry){
            .spheres = l->is_triangles || l->is_capsules ? NULL : &l->spheres, /* none of a free id */
            .triangles = l->is_triangles ? &l->triangles : NULL,
            .material = l->of.materials,
            .material_of_all = l->of.material,
            .body = l->of.bodies,
            .sheet = l->of.sheet,
            .color = color_of,
            .color_user = (void *)(uintptr_t)l};
    }
}

cgt_result cgt_draw_bounces(drawing *d, const cgt_scene *scene, const cgt_trace_options *options, const char **wrong)
{
    static const cgt_material matte = {.kind = CGT_MATERIAL_MATTE};
    const cgt_picture_options *o = d->options;
    whitted_light lights[CGT_PICTURE_MAX_LIGHTS];
    whitted_geometry *const geometry = calloc((size_t)d->last_look + 1, sizeof *geometry);
    whitted w = {.scene = scene,
                 .geometry = geometry,
                 .geometries = d->last_look,
                 .material = o->bounces.material_count ? o->bounces.materials : &matte,
                 .materials = o->bounces.material_count ? o->bounces.material_count : 1,
                 .bounces = o->bounces.limit,
                 .faintest = faintest,
                 .mask = d->camera.mask,
                 .shadow_mask = o->bounces.shadow_mask,
                 .glass_mask = o->bounces.glass_mask,
                 .glass_shadow = glass_shadow,
                 .stop = o->work.stop,
                 .stop_user = o->work.stop_user,
                 .trace = options};
    const cgt_frame frame = cgt_draw_frame(d);
    *wrong = NULL;
    if (!geometry)
        return CGT_ERROR_OUT_OF_MEMORY;
    set_geometries(d, geometry);
    set_light(o, &w, lights);
    *wrong = cgt_whitted_check(&w);
    const cgt_result result = *wrong ? CGT_ERROR_INVALID_ARGUMENT
                                     : cgt_whitted_frame(&w, &d->camera, d->ray_width, d->ray_height, &frame, d->light);
    free(geometry);
    return result;
}

/* From the light of a pixel's rays: those that hit nothing see the sky. Returns the hits. */
uint32_t cgt_draw_bounced_row(const drawing *d, uint32_t y)
{
    const uint32_t n = d->options->antialias;
    uint32_t hits = 0;
    for (uint32_t x = 0; x < d->options->width; x++) {
        pixel_sum sum = {.depth = INFINITY, .id = CGT_INVALID_ID};
        for (uint32_t k = 0; k < n * n; k++) {
            const size_t ray = (size_t)(y * n + k / n) * d->ray_width + x * n + k % n;
            const int is_hit = d->primitive[ray] != CGT_INVALID_ID;
            for (int c = 0; c < 3; c++) {
                sum.all[c] += d->light[ray][c];
                sum.hits[c] += is_hit ? d->light[ray][c] : 0.0f;
            }
            sum.count += (uint32_t)is_hit;
            sum.cover += (float)is_hit;
            if (d->t[ray] < sum.depth) {
                const uint32_t *const ids = draw_look(d, d->geometry[ray])->of.ids;
                sum.depth = d->t[ray];
                sum.id = ids ? ids[d->primitive[ray]] : d->primitive[ray];
            }
        }
        draw_store(d, &sum, x, y);
        hits += sum.count;
    }
    return hits;
}
