/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Paths between mirrors, traced by programs/whitted and in long double; see path_error.h. */
#include "support/reference/path_error.h"

#include <math.h>
#include <string.h>

#include "support/random.h"
#include "whitted/whitted_internal.h"

enum { BALLS = 36, PLANES = 4 }; /* triangles of two squares */

typedef struct path {
    uint32_t length;
    whitted_ray ray[PATH_BOUNCES + 1];
    whitted_hit hit[PATH_BOUNCES + 1];
} path;

static const cgt_material mirror = {.kind = CGT_MATERIAL_MIRROR, .color = {1, 1, 1}};

/* Squares at y = -1 and 1, whose normals face each other. */
static const float corner[8][3] = {{-900, -1, -900}, {900, -1, -900}, {-900, -1, 900}, {900, -1, 900},
                                   {-900, 1, -900},  {900, 1, -900},  {-900, 1, 900},  {900, 1, 900}};
static const uint32_t triangle[PLANES][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}};

enum { OF_BALLS = 0, OF_PLANES = 1 };

static void watch(void *user, uint32_t bounce, const whitted_ray *ray, const whitted_hit *hit)
{
    path *p = user;
    p->ray[bounce] = *ray;
    p->hit[bounce] = *hit;
    p->length = bounce + 1;
}

/* Moves a ray to its next mirror, whichever the program met, and reflects it there. Returns the distance of the
 * program's place from it. */
static double follow(const path *p, uint32_t bounce, const float (*ball)[4], long double at[3], long double d[3])
{
    const whitted_hit *hit = &p->hit[bounce];
    long double n[3] = {0, 0, 0}, t, along = 0, error = 0;
    if (hit->geometry == OF_PLANES) {
        n[1] = d[1] > 0 ? -1 : 1;
        t = (-n[1] - at[1]) / d[1];
    } else {
        const float *s = ball[hit->primitive];
        long double from[3], b = 0, c = -(long double)s[3] * (long double)s[3], a = 0;
        for (int k = 0; k < 3; k++) {
            from[k] = at[k] - (long double)s[k];
            a += d[k] * d[k], b += from[k] * d[k], c += from[k] * from[k];
        }
        t = (-b - sqrtl(b * b - a * c)) / a;
        for (int k = 0; k < 3; k++)
            n[k] = (from[k] + t * d[k]) / (long double)s[3];
    }
    for (int k = 0; k < 3; k++)
        at[k] += t * d[k], along += n[k] * d[k];
    for (int k = 0; k < 3; k++) {
        d[k] -= 2 * along * n[k];
        const long double off = at[k] - (long double)p->ray[bounce + 1].org[k];
        error += off * off;
    }
    return (double)(sqrtl(error) * 0x1p23L / 4);
}

static cgt_result trace_paths(whitted *w, whitted_memory *memory, const float (*ball)[4], bool balls, uint32_t rays,
                              uint64_t stream, path_errors *errors)
{
    static const float slant = 0.1f;
    test_random r = random_make(stream);
    cgt_result result = CGT_OK;
    path p;
    w->watch = watch;
    w->watch_user = &p;
    for (uint32_t i = 0; i < rays && result == CGT_OK; i++) {
        float org[1][3], dir[1][3], light[1][3];
        long double at[3], d[3];
        for (int a = 0; a < 3; a++) {
            org[0][a] = random_float(&r, -0.05f, 0.05f);
            dir[0][a] = random_float(&r, -1, 1) * (a == 1 || balls ? 1.0f : slant);
            at[a] = (long double)org[0][a], d[a] = (long double)dir[0][a];
        }
        if (fabsf(dir[0][1]) < 0.3f)
            continue;
        memset(&p, 0, sizeof p);
        result = cgt_whitted_trace(w, memory, 1, (const float(*)[3])org, (const float(*)[3])dir, light);
        errors->rays++;
        for (uint32_t k = 0; k + 1 < p.length && p.hit[k].primitive != CGT_INVALID_ID; k++) {
            const double error = follow(&p, k, ball, at, d);
            if (!(error < PATH_PARTED)) { /* NaN: the exact path misses the ball */
                errors->parted[k]++;
                break;
            }
            errors->paths[k]++;
            errors->sum[k] += error;
            errors->worst[k] = fmax(errors->worst[k], error);
        }
    }
    return result;
}

cgt_result path_errors_measure(bool balls, uint32_t rays, uint64_t stream, const char *variant, path_errors *errors)
{
    const cgt_context_options options = {.threads = 1, .variant = variant};
    float ball[BALLS][4];
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    memset(errors, 0, sizeof *errors);
    for (int i = 0; i < BALLS; i++) {
        const float one[4] = {(float)(i % 6) - 2.5f, 0, (float)(i / 6) - 2.5f, 0.4f};
        memcpy(ball[i], one, sizeof one);
    }
    const cgt_spheres spheres = {.count = balls ? BALLS : 0,
                                 .centers = cgt_floats(ball[0], sizeof ball[0]),
                                 .radii = cgt_floats(&ball[0][3], sizeof ball[0])};
    const cgt_triangles planes = {.count = PLANES,
                                  .indices = cgt_uint32s(triangle[0], 0),
                                  .vertex_count = 8,
                                  .vertices = cgt_floats(corner[0], 0)};
    const whitted_geometry geometry[] = {{.spheres = &spheres}, {.triangles = &planes, .sheet = true}};
    whitted w = {.geometry = geometry,
                 .geometries = 2,
                 .material = &mirror,
                 .materials = 1,
                 .up = {0, 1, 0},
                 .bounces = PATH_BOUNCES};
    cgt_result result = cgt_context_create(&options, &context);
    if (result == CGT_OK)
        result = cgt_scene_create(context, NULL, &scene);
    if (result == CGT_OK)
        result = cgt_scene_set_spheres(scene, NULL, &spheres);
    if (result == CGT_OK)
        result = cgt_scene_set_triangles(scene, NULL, &planes);
    if (result == CGT_OK)
        result = cgt_scene_commit(scene);
    w.scene = scene;
    whitted_memory *memory = result == CGT_OK ? cgt_whitted_memory_create(PATH_BOUNCES) : NULL;
    if (result == CGT_OK)
        result = memory ? trace_paths(&w, memory, (const float(*)[4])ball, balls, rays, stream, errors)
                        : CGT_ERROR_OUT_OF_MEMORY;
    cgt_whitted_memory_free(memory);
    cgt_scene_release(scene);
    cgt_context_release(context);
    return result;
}
