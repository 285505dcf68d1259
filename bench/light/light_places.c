/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where lights stand: given by shares of the scene's box, or found in the scene. */
#include "light/bench_light.h"

#include <math.h>

#include "common/bench_random.h"

enum { HOLES_TRIED = 64, FIRST_DIRECTION = 6, FIRST_FOUND = 4, ROW = LIGHT_PLACES - 1 };

/* The first ones by shares of the box, then those that are found, then directions. */
const char *const light_place_names[LIGHT_PLACES] = {"outside", "near", "inside", "edge", "hole", "surface", "+x",
                                                     "-x",      "+y",   "-y",     "+z",   "-z",   "slanted", "row"};

static const float shares[FIRST_FOUND][3] = {
    {1.34f, 2.5f, -2.0f}, {0.67f, 0.7f, -0.1f}, {0.5f, 0.5f, 0.5f}, {0.53f, 0.95f, 0.6f}};

static cgt_light light_by_share(const light_scene *s, const float share[3])
{
    cgt_light light = {.kind = CGT_LIGHT_POINT};
    for (int a = 0; a < 3; a++)
        light.position[a] = s->low[a] + share[a] * (s->high[a] - s->low[a]);
    return light;
}

/* How far a place lies from all spheres, or from all vertices. */
static float clearance(const light_scene *s, const float at[3])
{
    const uint32_t width = s->input.index ? 3 : 4;
    float least = INFINITY;
    for (uint32_t i = 0; i < s->count; i++) {
        const float *p = s->input.moving + (size_t)i * width;
        const float d[3] = {p[0] - at[0], p[1] - at[1], p[2] - at[2]};
        const float distance = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - (width == 4 ? p[3] : 0);
        least = distance < least ? distance : least;
    }
    return least;
}

/* The middle of the largest of some holes. */
static cgt_light light_in_hole(const light_scene *s)
{
    uint64_t random = bench_random_start;
    cgt_light best = {.kind = CGT_LIGHT_POINT};
    float most = -INFINITY;
    for (int k = 0; k < HOLES_TRIED; k++) {
        float share[3];
        for (int a = 0; a < 3; a++)
            share[a] = 0.2f + 0.6f * bench_random(&random);
        const cgt_light light = light_by_share(s, share);
        const float clear = clearance(s, light.position);
        if (clear > most) {
            most = clear;
            best = light;
        }
    }
    return best;
}

/* Just before the hit of a pixel near the picture's middle. */
static cgt_light light_on_surface(const light_scene *s)
{
    const uint32_t width = s->axes.width, height = s->axes.height;
    cgt_light light = light_by_share(s, shares[2]);
    for (uint32_t k = 0; k < width * height; k++) {
        const uint32_t pixel = (height / 2 * width + width / 2 + k) % (width * height);
        float dir[3];
        if (!(s->planes.t[pixel] < INFINITY))
            continue;
        bench_camera_direction(&s->axes, pixel % width, pixel / width, dir);
        for (int a = 0; a < 3; a++)
            light.position[a] = s->axes.eye[a] + 0.9999f * s->planes.t[pixel] * dir[a];
        break;
    }
    return light;
}

void light_place_make(const light_scene *scene, int which, light_place *place)
{
    static const float slanted[3] = {1.0f, 2.0f, -1.5f};
    *place = (light_place){.name = light_place_names[which], .count = 1};
    if (which < FIRST_FOUND)
        place->light[0] = light_by_share(scene, shares[which]);
    else if (which < FIRST_DIRECTION)
        place->light[0] = which == FIRST_FOUND ? light_in_hole(scene) : light_on_surface(scene);
    else if (which < ROW) {
        const int axis = which - FIRST_DIRECTION;
        place->light[0].kind = CGT_LIGHT_DIRECTIONAL;
        for (int a = 0; a < 3; a++)
            place->light[0].position[a] = axis == 6 ? slanted[a] : axis / 2 != a ? 0 : axis % 2 ? -1.0f : 1.0f;
    } else {
        place->count = LIGHT_MOST;
        for (uint32_t k = 0; k < LIGHT_MOST; k++) {
            const float share[3] = {-0.2f + 0.2f * (float)k, 1.3f, -0.3f};
            place->light[k] = light_by_share(scene, share);
        }
    }
}
