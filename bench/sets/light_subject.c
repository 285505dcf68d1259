/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench light: points in several orders against lights anywhere. Lights are given by shares of the scene's box, or
 * found in the scene. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/bench_random.h"
#include "sets/light_points.h"

enum { MOST_LIGHTS = 8, HOLES_TRIED = 64, FIRST_FOUND = 4, FIRST_DIRECTION = 6, ROW = 13, PLACES };

/* The first ones by shares of the box, then those that are found, then directions. */
const char *const bench_light_places[] = {"outside", "near", "inside", "edge", "hole",    "surface", "+x", "-x",
                                          "+y",      "-y",   "+z",     "-z",   "slanted", "row",     NULL};

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
    const bench_session *session = &s->job->session;
    const uint32_t width = session->input.index ? 3 : 4;
    float least = INFINITY;
    for (uint32_t i = 0; i < session->count; i++) {
        const float *p = session->input.moving + (size_t)i * width;
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
    const bench_camera_axes *axes = &s->job->session.axes;
    const bench_planes *planes = &s->job->planes;
    const uint32_t width = axes->width, height = axes->height;
    cgt_light light = light_by_share(s, shares[2]);
    for (uint32_t k = 0; k < width * height; k++) {
        const uint32_t pixel = (height / 2 * width + width / 2 + k) % (width * height);
        float dir[3];
        if (!(planes->t[pixel] < INFINITY))
            continue;
        bench_camera_direction(axes, pixel % width, pixel / width, dir);
        for (int a = 0; a < 3; a++)
            light.position[a] = axes->eye[a] + 0.9999f * planes->t[pixel] * dir[a];
        break;
    }
    return light;
}

/* Places the lights; returns how many. */
static uint32_t place_lights(const light_scene *s, int which, cgt_light light[MOST_LIGHTS])
{
    static const float slanted[3] = {1.0f, 2.0f, -1.5f};
    const int axis = which - FIRST_DIRECTION;
    memset(light, 0, MOST_LIGHTS * sizeof *light);
    if (which < FIRST_FOUND)
        light[0] = light_by_share(s, shares[which]);
    else if (which < FIRST_DIRECTION)
        light[0] = which == FIRST_FOUND ? light_in_hole(s) : light_on_surface(s);
    else if (which < ROW) {
        light[0].kind = CGT_LIGHT_DIRECTIONAL;
        for (int a = 0; a < 3; a++)
            light[0].position[a] = axis == 6 ? slanted[a] : axis / 2 != a ? 0 : axis % 2 ? -1.0f : 1.0f;
    }
    for (uint32_t k = 0; k < MOST_LIGHTS && which == ROW; k++) {
        const float share[3] = {-0.2f + 0.2f * (float)k, 1.3f, -0.3f};
        light[k] = light_by_share(s, share);
    }
    return which == ROW ? MOST_LIGHTS : 1;
}

static void find_bounds(light_scene *s)
{
    const bench_session *session = &s->job->session;
    const uint32_t width = session->input.index ? 3 : 4;
    for (int a = 0; a < 3; a++) {
        s->low[a] = INFINITY;
        s->high[a] = -INFINITY;
        for (uint32_t i = 0; i < session->count; i++) {
            const float x = session->input.moving[(size_t)i * width + (size_t)a];
            s->low[a] = x < s->low[a] ? x : s->low[a];
            s->high[a] = x > s->high[a] ? x : s->high[a];
        }
    }
}

/* One order of points against all places. */
static int run_order(sets_job *job, const light_scene *scene, light_order order)
{
    static const uint64_t all = UINT64_MAX;
    light_points points;
    cgt_rays embree = {.count = 0};
    if (light_points_make(scene, order, &points))
        return sets_out_of_memory();
    embree.t_min = points.offset; /* it skips no primitive */
    int code = PROGRAM_OK;
    for (int place = 0; place < PLACES && code == PROGRAM_OK; place++) {
        cgt_light light[MOST_LIGHTS];
        if (!bench_is_chosen(job->settings->kind, PLACES, place))
            continue;
        const bench_set set = {.kind = bench_light_places[place],
                               .order = bench_light_orders[order],
                               .query = order == LIGHT_FRAME ? BENCH_LIT_PICTURE : BENCH_POINTS,
                               .rays = {.count = points.count,
                                        .org = {points.position[0], points.position[1], points.position[2]},
                                        .skip_primitive = points.primitive},
                               .embree = points.offset ? &embree : NULL,
                               .light = light,
                               .lights = place_lights(scene, place, light),
                               .end = points.end,
                               .calls = order == LIGHT_FRAME ? 0 : points.calls};
        code = sets_measure(job, &set, &all, 1, 1);
    }
    light_points_release(&points);
    return code;
}

static int run_file(sets_job *job)
{
    light_scene scene = {.job = job};
    int code = PROGRAM_OK;
    find_bounds(&scene);
    for (int order = 0; order < LIGHT_ORDERS && code == PROGRAM_OK; order++)
        if (bench_is_chosen(job->settings->order, LIGHT_ORDERS, order))
            code = run_order(job, &scene, (light_order)order);
    return code;
}

int bench_light(const bench_settings *settings) { return sets_run(settings, run_file); }
