/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays from hits on the PPE. */
#include "cell/ppe/grid/grid_light.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define LEAST 0x1p-70f              /* of a light's coordinates and of directions, but 0 (grid_nearest.h) */
#define MOST_T 0x1p44f              /* no hit has a larger t */
#define MOST_WORD_BYTES 0x40000000u /* from CGT_EA_OCCLUDED on */

/* ---- the image ---- */

/* Half a sphere of directions, evenly: a spiral that turns by the golden angle (Vogel, "A better way to construct the
 * sunflower head", 1979), turned by the seed. Products of complex numbers, which every host rounds alike. */
static void fill_directions(cgt_light_image *image, uint32_t count, uint32_t seed)
{
    const double golden[2] = {-0.7373688780783197, 0.6754902942615238};
    const double s = (double)(uint32_t)(seed * 2654435769u) * 0x1p-32, ss = 1 + s * s;
    double turn[2] = {(1 - s * s) / ss, 2 * s / ss};
    for (uint32_t k = 0; k < count; k++) {
        const double z = (k + 0.5) / count, r = sqrt(1 - z * z);
        const double d[3] = {r * turn[0], r * turn[1], z};
        float *const to = image->direction[image->shadow + k];
        for (int a = 0; a < 3; a++)
            to[a] = fabs(d[a]) < (double)LEAST ? 0 : (float)d[a];
        const double next[2] = {turn[0] * golden[0] - turn[1] * golden[1], turn[0] * golden[1] + turn[1] * golden[0]};
        turn[0] = next[0];
        turn[1] = next[1];
    }
}

static const char *check(const cgt_grid_light *l)
{
    if ((uint64_t)l->ambient + l->shadow > CGT_LIGHT_SETS || (uint64_t)l->ambient + l->shadow == 0)
        return "rays from hits: 1 to 16 of a pixel, the one to the light included";
    if (!(l->radius >= 0))
        return "rays from hits: their radius is 0 or more";
    for (int a = 0; a < 3 && l->shadow; a++) {
        const float p = fabsf(l->position[a]);
        if (!(p <= CGT_SPE_MAX_COORDINATE) || (p != 0 && p < LEAST))
            return "a light's coordinates are 0, or from 2^-70 to 2^40 in size";
    }
    return NULL;
}

static void fill_image(cgt_light_image *image, const cgt_grid_light *from)
{
    image->sets = from->ambient + from->shadow;
    image->shadow = from->shadow;
    image->t_max = from->radius > 0 && from->radius < MOST_T ? from->radius : MOST_T;
    image->t_max = image->t_max < FLT_MIN ? FLT_MIN : image->t_max;
    for (int a = 0; a < 3; a++)
        image->position[a] = from->shadow ? from->position[a] : 0;
    fill_directions(image, from->ambient, from->seed);
}

cgt_result cgt_grid_lighting_init(cgt_grid_lighting *light, const cgt_memory_hooks *memory, const cgt_grid_light *from,
                                  const cgt_camera_tables *tables, const cgt_grid_scene *scene,
                                  char message[CGT_PPE_MESSAGE_BYTES])
{
    const uint32_t width = tables->rays.width, height = tables->rays.height;
    *light = (cgt_grid_lighting){.memory = *memory, .tables = tables, .scene = scene};
    if (!from)
        return CGT_OK;
    const char *const wrong = check(from);
    if (wrong) {
        snprintf(message, CGT_PPE_MESSAGE_BYTES, "%s", wrong);
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    fill_image(&light->image, from);
    light->word_row = ((size_t)(width + 3) / 4 * ((light->image.sets + 1) / 2) + 31) / 32 * 128;
    light->word_bytes = light->word_row * ((height + 3) / 4);
    if (light->word_bytes > MOST_WORD_BYTES) {
        snprintf(message, CGT_PPE_MESSAGE_BYTES,
                 "%" PRIu32 " x %" PRIu32 " pixels with %" PRIu32
                 " rays from hits exceed the 1 GB of addresses for them",
                 width, height, light->image.sets);
        return CGT_ERROR_TOO_LARGE;
    }
    light->decided_bytes = (size_t)width * height * sizeof *light->decided;
    light->word = cgt_allocate(memory, light->word_bytes);
    light->decided = cgt_allocate(memory, light->decided_bytes);
    if (light->word && light->decided) {
        memset(light->word, 0, light->word_bytes);
        memset(light->decided, 0, light->decided_bytes);
        return CGT_OK;
    }
    cgt_grid_lighting_release(light);
    snprintf(message, CGT_PPE_MESSAGE_BYTES, "out of memory for rays from the hits of %" PRIu32 " x %" PRIu32 " pixels",
             width, height);
    return CGT_ERROR_OUT_OF_MEMORY;
}

void cgt_grid_lighting_release(cgt_grid_lighting *light)
{
    if (light->word)
        cgt_free(&light->memory, light->word, light->word_bytes);
    if (light->decided)
        cgt_free(&light->memory, light->decided, light->decided_bytes);
    light->word = light->decided = NULL;
}

/* ---- rays ---- */

bool cgt_grid_lighting_ray(const cgt_grid_lighting *light, uint32_t x, uint32_t y, uint32_t id, uint32_t set,
                           cgt_ray *ray)
{
    const cgt_light_image *const l = &light->image;
    const cgt_camera_image *const camera = &light->tables->image;
    float eye[3], dir[3], normal[3];
    bool has_direction = false;
    cgt_camera_pixel(&light->tables->rays, x, y, eye, dir);
    for (int a = 0; a < 3; a++)
        dir[a] = cgt_spe_normal(dir[a]);
    *ray = (cgt_ray){.t_max = set < l->shadow ? 1 : l->t_max};
    cgt_grid_light_hit(camera->eye, dir, camera->t_min, light->scene->object[id], ray->line.org, normal);
    const bool away = set >= l->shadow && cgt_grid_light_looks_away(normal, l->direction[set]);
    for (int a = 0; a < 3; a++) {
        const float d = set < l->shadow ? l->position[a] - ray->line.org[a] : l->direction[set][a];
        ray->line.dir[a] = away ? -d : d;
        has_direction |= d != 0;
    }
    return has_direction;
}

static bool meets(cgt_grid_lighting *light, const cgt_ray *ray, uint32_t object)
{
    return light->scene->object[object][3] >= 0 && cgt_doubts_hit(light->decide, ray, object);
}

static bool meets_any(cgt_grid_lighting *light, const cgt_ray *ray, uint32_t own)
{
    for (uint32_t i = 0; i < light->scene->image.spheres; i++)
        if (i != own && meets(light, ray, i))
            return true;
    return false;
}

/* ---- doubts and results ---- */

void cgt_grid_lighting_doubt(cgt_grid_lighting *light, const cgt_doubt *doubt)
{
    const uint32_t x = doubt->pixel & 0xffff, y = doubt->pixel >> 16, set = CGT_DOUBT_SET(doubt->object) - 1;
    const uint32_t object = CGT_DOUBT_OBJECT(doubt->object), own = CGT_DOUBT_OWN(doubt->object);
    const uint32_t spheres = light->scene->image.spheres;
    cgt_ray ray;
    light->doubts++;
    if (x >= light->tables->rays.width || y >= light->tables->rays.height || set >= light->image.sets ||
        own >= spheres || (object >= spheres && object != CGT_DOUBT_ALL)) {
        light->decide->bad++;
        return;
    }
    uint32_t *const decided = &light->decided[(size_t)y * light->tables->rays.width + x];
    if (*decided >> set & 1 || object == own || !cgt_grid_lighting_ray(light, x, y, own, set, &ray))
        return;
    if (object == CGT_DOUBT_ALL ? meets_any(light, &ray, own) : meets(light, &ray, object))
        *decided |= 1u << set;
}

/* A pixel's bits as SPEs sent them. */
static uint32_t bits_of(const cgt_grid_lighting *light, uint32_t x, uint32_t y)
{
    const uint32_t sets = light->image.sets, words = (sets + 1) / 2, place = y % 4 * 4 + x % 4;
    const uint32_t *const word = light->word + light->word_row / 4 * (y / 4) + x / 4 * words;
    uint32_t bits = 0;
    for (uint32_t set = 0; set < sets; set++)
        bits |= (word[set / 2] >> (set & 1 ? 15 - place : 31 - place) & 1) << set;
    return bits;
}

static uint32_t trace_pixel(cgt_grid_lighting *light, uint32_t x, uint32_t y, uint32_t id)
{
    uint32_t bits = 0;
    light->pixels++;
    for (uint32_t set = 0; set < light->image.sets; set++) {
        cgt_ray ray;
        if (cgt_grid_lighting_ray(light, x, y, id, set, &ray) && meets_any(light, &ray, id))
            bits |= 1u << set;
    }
    return bits;
}

void cgt_grid_lighting_finish(cgt_grid_lighting *light, const uint32_t *ids, size_t stride, uint32_t *occluded)
{
    const uint32_t width = light->tables->rays.width, height = light->tables->rays.height;
    const uint32_t *decided = light->decided;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++, decided++, occluded++) {
            const uint32_t id = ids[y * stride + x];
            if (id == CGT_INVALID_ID)
                *occluded = 0;
            else
                *occluded = *decided & CGT_LIGHT_ALL ? trace_pixel(light, x, y, id) : *decided | bits_of(light, x, y);
        }
}
