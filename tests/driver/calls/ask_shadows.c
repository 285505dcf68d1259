/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shadows of a frame's pixels, and ambient occlusion of them. Directions are those that the API defines; what the rays
 * hit is judged. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "driver/calls/view.h"
#include "query/ambient_directions.h"

/* ---- lights ---- */

/* Among the primitives, beside them, or farther than tiles take. */
static void place_light(judge_scene *s, float p[3])
{
    const uint32_t how = random_below(&s->random, 4);
    float at[3], out[3];
    line_place(s, how == 2 ? at : p);
    if (how == 2)
        line_place_beside(s, at, p);
    if (how < 3)
        return;
    const float far = s->scale * random_log(&s->random, 1, 1e7f);
    random_direction(&s->random, out);
    for (int a = 0; a < 3; a++)
        p[a] = s->middle[a] + far * out[a];
}

static void make_lights(driver_run *run, driver_view *w)
{
    test_random *r = &run->scene.random;
    for (uint32_t k = 0; k < DRIVER_LIGHTS; k++) {
        cgt_light *l = &w->light[k];
        l->kind = (cgt_light_kind)random_below(r, 2);
        do
            if (l->kind == CGT_LIGHT_DIRECTIONAL)
                random_direction(r, l->position);
            else
                place_light(&run->scene, l->position);
        while (!isfinite(l->position[0] + l->position[1] + l->position[2]));
        for (int a = 0; a < 3 && random_below(r, 3) == 0; a++)
            l->position[a] = (float)random_below(r, 5) - 2;
        for (uint32_t a = 0, along = random_below(r, 18); a < 3 && along < 3; a++)
            l->position[a] = a == along ? l->position[a] : 0;
        if (l->kind == CGT_LIGHT_DIRECTIONAL && l->position[0] == 0 && l->position[1] == 0 && l->position[2] == 0)
            l->position[2] = 1;
    }
    cgt_shadow_options_init(&w->shadows);
    w->shadows.t_min = random_below(r, 3) ? 0 : random_float(r, 0, 0.1f);
}

judge_ray driver_ray_to(const cgt_light *light, const float from[3])
{
    const bool is_point = light->kind == CGT_LIGHT_POINT;
    judge_ray ray = {
        .line.t_max = is_point ? 1 : INFINITY, .skip_primitive = ORACLE_NONE, .skip_geometry = ORACLE_NONE};
    for (int a = 0; a < 3; a++) {
        ray.line.org[a] = from[a];
        ray.line.dir[a] = is_point ? light->position[a] - from[a] : light->position[a];
    }
    return ray;
}

static void find_shadows(driver_run *run, driver_view *w)
{
    float p[3];
    for (uint32_t k = 0; k < DRIVER_LIGHTS; k++)
        for (uint32_t i = 0; i < w->pixels; i++) {
            judge_ray *ray = &w->to_light[k][i];
            w->shadow[k][i] = (judge_truth){0};
            *ray = (judge_ray){.line = {.t_max = -1}};
            if (!driver_is_hit(w, i))
                continue;
            driver_position(w, i, p);
            *ray = driver_ray_to(&w->light[k], p);
            ray->mask = w->camera.mask;
            ray->line.t_min = w->shadows.t_min;
            ray->skip_primitive = w->got.primitive[i];
            ray->skip_geometry = w->got.geometry[i];
            if (!driver_is_one_of(w->every, i))
                continue;
            w->shadow[k][i] = driver_trace(run, ray, JUDGE_SHADOW, false);
            run->count[COUNT_SHADOWS]++;
            run->count[COUNT_OCCLUDED] += w->shadow[k][i].count > 0;
        }
}

static uint8_t shadow_of_frame[DRIVER_LIGHTS * DRIVER_PIXELS];

static void check_shadows(driver_run *run, driver_view *w, const cgt_frame *frame)
{
    memset(shadow_of_frame, 9, (size_t)DRIVER_LIGHTS * w->pixels);
    if (!driver_succeeds(run,
                         cgt_occluded_frame(run->setup.scene, &w->camera, frame, w->light, DRIVER_LIGHTS, &w->shadows,
                                            shadow_of_frame, NULL),
                         "cgt_occluded_frame"))
        return;
    run->count[COUNT_ANSWERS] += (uint64_t)DRIVER_LIGHTS * w->pixels;
    for (uint32_t k = 0; k < DRIVER_LIGHTS; k++)
        for (uint32_t i = 0; i < w->pixels; i++) {
            const uint8_t got = shadow_of_frame[k * w->pixels + i];
            if (got > 1 || (driver_is_one_of(w->every, i) && !driver_is_occluded(run, &w->shadow[k][i], got)))
                driver_fail(run, &w->to_light[k][i], "cgt_occluded_frame", "pixel %u, %u, light %u: %u",
                            (unsigned)(i % w->width), (unsigned)(i / w->width), (unsigned)k, got);
        }
}

/* The same rays in an array, where neighbours go the same way. */
static void check_shadow_rays(driver_run *run, driver_view *w)
{
    static uint8_t occluded[DRIVER_PIXELS];
    const uint32_t k = random_below(&run->scene.random, DRIVER_LIGHTS);
    const cgt_rays rays = driver_ray_array(w->to_light[k], w->pixels);
    memset(occluded, 0x5a, sizeof occluded);
    if (!driver_succeeds(run, cgt_occluded_rays(run->setup.scene, &rays, occluded, NULL), "cgt_occluded_rays"))
        return;
    run->count[COUNT_ANSWERS] += w->pixels;
    for (uint32_t i = 0; i < w->pixels; i++)
        if (occluded[i] != shadow_of_frame[k * w->pixels + i])
            driver_fail(run, &w->to_light[k][i], "cgt_occluded_rays", "the shadow ray of pixel %u, %u: %u",
                        (unsigned)(i % w->width), (unsigned)(i / w->width), occluded[i]);
}

/* ---- places that are none ---- */

/* A frame's t, some of which leads to no place or beyond all numbers, in planes with gaps; and the points of its
 * hits. */
typedef struct spoilt_frame {
    cgt_frame frame;
    bool skips;
    float t[2 * DRIVER_PIXELS];
    uint32_t primitive[2 * DRIVER_PIXELS], geometry[2 * DRIVER_PIXELS];
    uint32_t points;
    judge_ray point[DRIVER_PIXELS];
    size_t at[DRIVER_PIXELS]; /* of its pixel in the planes */
} spoilt_frame;

static void spoil(driver_run *run, const driver_view *w, spoilt_frame *s)
{
    static const float bad[] = {NAN, FLT_MAX, -FLT_MAX};
    test_random *const r = &run->scene.random;
    cgt_frame_init(&s->frame, w->width, w->height);
    s->frame.row_stride = w->width + random_below(r, w->width);
    s->skips = random_below(r, 2);
    s->frame.t = s->t;
    s->frame.primitive = s->skips ? s->primitive : NULL;
    s->frame.geometry = s->skips ? s->geometry : NULL;
    s->points = 0;
    for (uint32_t i = 0; i < w->pixels; i++) {
        const size_t at = i / w->width * s->frame.row_stride + i % w->width;
        const bool spoils = driver_is_hit(w, i) && random_below(r, 16) == 0;
        s->t[at] = spoils ? bad[random_below(r, TEST_COUNT(bad))] : w->got.t[i];
        s->primitive[at] = w->got.primitive[i];
        s->geometry[at] = w->got.geometry[i];
        if (!driver_is_hit(w, i))
            continue;
        judge_ray *const p = &s->point[s->points];
        *p = (judge_ray){.line.t_min = w->shadows.t_min, .mask = w->camera.mask};
        driver_place(&w->ray[i].line, s->t[at], p->line.org);
        p->skip_primitive = w->got.primitive[i];
        p->skip_geometry = w->got.geometry[i];
        s->at[s->points++] = at;
    }
}

/* Shadows of such a frame are those of its points, with one of them as the light's place, and so are the counts. */
static void check_spoilt(driver_run *run, driver_view *w)
{
    static spoilt_frame s;
    static uint8_t got[2 * DRIVER_PIXELS], want[DRIVER_PIXELS];
    cgt_light light = w->light[0];
    cgt_trace_statistics by_frame, by_points;
    spoil(run, w, &s);
    memset(want, 0x5a, sizeof want);
    const judge_ray *const p = s.point;
    if (light.kind == CGT_LIGHT_POINT && s.points)
        memcpy(light.position, p[random_below(&run->scene.random, s.points)].line.org, sizeof light.position);
    if (!isfinite(light.position[0] + light.position[1] + light.position[2]))
        return;
    const cgt_points points = {.count = s.points,
                               .stride = sizeof *p,
                               .position = {&p->line.org[0], &p->line.org[1], &p->line.org[2]},
                               .t_min = &p->line.t_min,
                               .mask = &p->mask,
                               .skip_primitive = s.skips ? &p->skip_primitive : NULL,
                               .skip_geometry = s.skips ? &p->skip_geometry : NULL};
    memset(got, 9, sizeof got);
    if (!driver_succeeds(run,
                         cgt_occluded_frame(run->setup.scene, &w->camera, &s.frame, &light, 1, &w->shadows, got,
                                            &(cgt_trace_options){.statistics = &by_frame}),
                         "cgt_occluded_frame") ||
        !driver_succeeds(run,
                         cgt_occluded_points(run->setup.scene, &light, &points, want,
                                             &(cgt_trace_options){.statistics = &by_points}),
                         "cgt_occluded_points"))
        return;
    for (uint32_t i = 0; i < s.points; i++) {
        if (got[s.at[i]] != want[i])
            driver_fail(run, &p[i], "cgt_occluded_frame", "%u, its point %u", got[s.at[i]], want[i]);
        got[s.at[i]] = 0;
    }
    for (uint32_t i = 0; i < s.frame.row_stride * w->height; i++)
        if (got[i] != (i % s.frame.row_stride < w->width ? 0 : 9))
            driver_fail(run, NULL, "cgt_occluded_frame", "%u where no hit is", got[i]);
    if (by_frame.rays != s.points || by_frame.hits != by_points.hits || by_frame.invalid_rays != by_points.invalid_rays)
        driver_fail(run, NULL, "cgt_occluded_frame", "%llu rays, %llu hits, %llu invalid; %u, %llu, %llu by points",
                    (unsigned long long)by_frame.rays, (unsigned long long)by_frame.hits,
                    (unsigned long long)by_frame.invalid_rays, (unsigned)s.points, (unsigned long long)by_points.hits,
                    (unsigned long long)by_points.invalid_rays);
    run->count[COUNT_INVALID] += by_frame.invalid_rays;
    run->count[COUNT_ANSWERS] += w->pixels;
}

/* ---- ambient occlusion ---- */

static void find_open(driver_run *run, driver_view *w, const cgt_ambient_points *points, uint32_t i)
{
    float dir[3][DRIVER_SAMPLES], n[3], p[3], ahead = 0;
    w->open[0][i] = w->open[1][i] = w->ambient.samples;
    if (!driver_is_hit(w, i))
        return;
    for (int a = 0; a < 3; a++)
        ahead += w->got.normal[a][i] * w->ray[i].line.dir[a];
    for (int a = 0; a < 3; a++)
        n[a] = ahead > 0 ? -w->got.normal[a][i] : w->got.normal[a][i];
    if (!isfinite(n[0] + n[1] + n[2]))
        return;
    cgt_ambient_directions(points, &w->ambient, i % w->width, i / w->width, n,
                           (float *const[]){dir[0], dir[1], dir[2]});
    driver_position(w, i, p);
    for (uint32_t k = 0; k < w->ambient.samples; k++) {
        const float radius = w->ambient.radius == 0 ? INFINITY : w->ambient.radius;
        judge_ray ray = {.line = {.t_max = radius}, .mask = w->camera.mask};
        for (int a = 0; a < 3; a++) {
            ray.line.org[a] = p[a];
            ray.line.dir[a] = dir[a][k];
        }
        ray.skip_primitive = w->got.primitive[i];
        ray.skip_geometry = w->got.geometry[i];
        const uint32_t before = run->pool.count;
        const judge_truth right = driver_trace(run, &ray, JUDGE_SHADOW, false);
        w->open[0][i] -= right.count > 0;
        w->open[1][i] -= !judge_is_end(&run->pool, &right, 0);
        run->pool.count = before;
    }
}

static void find_ambient(driver_run *run, driver_view *w)
{
    static cgt_ambient_points points;
    test_random *r = &run->scene.random;
    w->ambient = (cgt_ambient_options){.samples = 1 + random_below(r, DRIVER_SAMPLES),
                                       .radius = random_below(r, 2) ? 0 : run->scene.scale * random_float(r, 0.1f, 2),
                                       .seed = random_below(r, 100),
                                       .first = random_below(r, 9)};
    cgt_ambient_points_init(w->ambient.first, w->ambient.samples, &points);
    for (uint32_t i = 0; i < w->pixels; i++)
        if (driver_is_one_of(w->every, i))
            find_open(run, w, &points, i);
}

static void check_ambient(driver_run *run, driver_view *w, const cgt_frame *frame)
{
    static float visibility[DRIVER_PIXELS];
    memset(visibility, 0x5a, sizeof visibility);
    if (!driver_succeeds(run, cgt_ambient_occlusion(run->setup.scene, &w->camera, frame, &w->ambient, visibility, NULL),
                         "cgt_ambient_occlusion"))
        return;
    run->count[COUNT_ANSWERS] += w->pixels;
    if (!run->setup.number)
        memcpy(w->first_visibility, visibility, w->pixels * sizeof *visibility);
    else if (memcmp(w->first_visibility, visibility, w->pixels * sizeof *visibility) != 0)
        driver_fail(run, NULL, "cgt_ambient_occlusion", "not the bits of the first setup");
    for (uint32_t i = 0; i < w->pixels; i++) {
        if (!driver_is_one_of(w->every, i))
            continue;
        const float all = (float)w->ambient.samples, low = (float)w->open[0][i] / all,
                    high = (float)w->open[1][i] / all;
        if (!(visibility[i] >= low && visibility[i] <= high))
            driver_fail(run, &w->ray[i], "cgt_ambient_occlusion", "pixel %u, %u sees %g of the sky, not %g to %g",
                        (unsigned)(i % w->width), (unsigned)(i / w->width), (double)visibility[i], (double)low,
                        (double)high);
    }
}

/* ---- all of it ---- */

void driver_shadows_begin(driver_run *run, driver_view *w)
{
    make_lights(run, w);
    w->has_ambient = random_below(&run->scene.random, 3) == 0;
}

/* Puts some lights to where a pixel hits, or a few steps of a float beside that: rays to them end at a surface. The
 * first has points of its own by now (ask_points.c). */
static void move_lights(driver_run *run, driver_view *w)
{
    test_random *const r = &run->scene.random;
    for (uint32_t k = 1; k < DRIVER_LIGHTS; k++) {
        const uint32_t i = random_below(r, w->pixels);
        float p[3];
        if (w->light[k].kind != CGT_LIGHT_POINT || random_below(r, 3) || !driver_is_hit(w, i))
            continue;
        driver_position(w, i, p);
        for (int a = 0; a < 3; a++)
            p[a] *= 1 + ((float)random_below(r, 17) - 8) * 0x1p-23f;
        if (isfinite(p[0] + p[1] + p[2]))
            memcpy(w->light[k].position, p, sizeof p);
    }
}

void driver_shadows_find(driver_run *run, driver_view *w)
{
    move_lights(run, w);
    find_shadows(run, w);
    if (w->has_ambient)
        find_ambient(run, w);
}

void driver_shadows_ask(driver_run *run, driver_view *w, const cgt_frame *frame)
{
    check_shadows(run, w, frame);
    check_shadow_rays(run, w);
    if (random_below(&run->scene.random, 3) == 0)
        check_spoilt(run, w);
    if (w->has_ambient)
        check_ambient(run, w, frame);
}
