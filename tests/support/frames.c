/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cameras, frames and rays for tests. */
#include "support/oracle/oracle.h"
#include "support/scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "query/camera.h"

cgt_camera camera_before(const cloud *c)
{
    cgt_camera camera;
    cgt_camera_init(&camera);
    memcpy(camera.eye, c->middle, sizeof camera.eye);
    memcpy(camera.target, c->middle, sizeof camera.target);
    camera.eye[2] += 4 * c->reach;
    return camera;
}

cgt_camera camera_random(test_random *r, const cloud *c)
{
    cgt_camera camera;
    float d[3];
    cgt_camera_init(&camera);
    random_direction(r, d);
    const float distance = c->reach * (random_below(r, 3) ? random_float(r, 1.5f, 6) : random_float(r, 0, 0.8f));
    for (int a = 0; a < 3; a++) {
        camera.eye[a] = c->middle[a] + distance * d[a];
        camera.target[a] = c->middle[a] + c->reach * random_float(r, -0.4f, 0.4f);
    }
    random_direction(r, camera.up);
    camera.fov = random_below(r, 4) ? random_float(r, 20, 80) : random_float(r, 1, 179);
    if (random_below(r, 4) == 0) {
        camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
        camera.height = c->reach * random_float(r, 0.3f, 4);
    }
    return camera;
}

planes planes_make(uint32_t width, uint32_t height)
{
    planes p = {.width = width, .height = height, .elements = (size_t)width * height};
    p.memory = malloc(6 * p.elements * sizeof(uint32_t));
    assert_non_null(p.memory);
    p.t = (float *)p.memory;
    p.primitive = p.memory + p.elements;
    p.geometry = p.memory + 2 * p.elements;
    for (int a = 0; a < 3; a++)
        p.normal[a] = (float *)(p.memory + (3 + (size_t)a) * p.elements);
    return p;
}

void planes_free(planes *p)
{
    free(p->memory);
    *p = (planes){0};
}

bool planes_equal(const planes *a, const planes *b)
{
    return a->elements == b->elements && memcmp(a->memory, b->memory, 6 * a->elements * sizeof(uint32_t)) == 0;
}

cgt_frame frame_of(const planes *p)
{
    cgt_frame frame;
    cgt_frame_init(&frame, p->width, p->height);
    frame.t = p->t;
    frame.primitive = p->primitive;
    frame.geometry = p->geometry;
    for (int a = 0; a < 3; a++)
        frame.normal[a] = p->normal[a];
    return frame;
}

void frame_trace(const cgt_scene *scene, const cgt_camera *camera, const planes *p, const cgt_trace_options *options)
{
    const cgt_frame frame = frame_of(p);
    memset(p->memory, 0x77, 6 * p->elements * sizeof(uint32_t));
    assert_int_equal(cgt_trace_camera(scene, camera, &frame, options), CGT_OK);
}

/* camera.h defines how a ray follows from these; a test compares them with the public formula in wide arithmetic. */
truth_ray *frame_rays(const cgt_camera *camera, uint32_t width, uint32_t height)
{
    cgt_camera_rays c;
    char message[160];
    truth_ray *rays = malloc((size_t)width * height * sizeof *rays);
    assert_non_null(rays);
    assert_int_equal(cgt_camera_prepare(camera, width, height, &c, message), CGT_OK);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            rays[(size_t)y * width + x] = camera_ray(&c, x, y);
    return rays;
}

void frame_judge(const planes *p, const truth_ray *rays, const float (*sphere)[4], uint32_t count)
{
    oracle_scene scene = {0};
    oracle_scene_add_spheres(&scene, 0, sphere, count);
    for (size_t i = 0; i < p->elements; i++) {
        const char *wrong = oracle_check(&scene, &rays[i], p->geometry[i], p->primitive[i], p->t[i]);
        if (wrong)
            fail_msg("pixel %zu: %s (sphere %u, t %a): org %a %a %a dir %a %a %a", i, wrong, p->primitive[i],
                     (double)p->t[i], (double)rays[i].org[0], (double)rays[i].org[1], (double)rays[i].org[2],
                     (double)rays[i].dir[0], (double)rays[i].dir[1], (double)rays[i].dir[2]);
    }
    oracle_scene_free(&scene);
}

/* ---- rays ---- */

truth_ray ray_random(test_random *r, const cloud *c)
{
    truth_ray ray = {.t_min = 0, .t_max = INFINITY};
    float target[3];
    const float length = random_below(r, 4) ? 1 : random_log(r, 1e-6f, 1e6f);
    const bool aimed = random_below(r, 4) != 0;
    const float away = random_below(r, 4) ? 1 : random_log(r, 1, 1e3f);
    random_direction(r, ray.dir);
    for (int a = 0; a < 3; a++) {
        ray.org[a] = c->middle[a] + c->reach * random_float(r, -2, 2) * away;
        target[a] = c->middle[a] + c->reach * random_float(r, -1, 1);
        if (aimed)
            ray.dir[a] = target[a] - ray.org[a];
        ray.dir[a] *= length;
    }
    if (random_below(r, 8) == 0)
        for (int a = 0, axis = (int)random_below(r, 3); a < 3; a++)
            ray.dir[a] = a == axis ? ray.dir[a] : 0;
    if (ray.dir[0] == 0 && ray.dir[1] == 0 && ray.dir[2] == 0)
        ray.dir[0] = -1;
    if (random_below(r, 4) == 0) {
        const float scale = c->reach / (fabsf(ray.dir[0]) + fabsf(ray.dir[1]) + fabsf(ray.dir[2]));
        ray.t_min = random_float(r, -1, 2) * scale;
        ray.t_max = ray.t_min + random_float(r, -0.5f, 3) * scale;
    }
    return ray;
}

cgt_hits hits_of(ray_hit *hits)
{
    cgt_hits h = {.stride = sizeof *hits, .t = &hits->t, .primitive = &hits->primitive, .geometry = &hits->geometry};
    for (int a = 0; a < 3; a++)
        h.normal[a] = &hits->normal[a];
    return h;
}

void rays_trace(const cgt_scene *scene, const truth_ray *rays, uint64_t count, ray_hit *hits,
                const cgt_trace_options *options)
{
    const cgt_rays r = ray_array(rays, count);
    const cgt_hits h = hits_of(hits);
    memset(hits, 0x77, (size_t)count * sizeof *hits);
    assert_int_equal(cgt_trace_rays(scene, &r, &h, options), CGT_OK);
}

ray_hit ray_trace(const cgt_scene *scene, truth_ray ray)
{
    ray_hit hit;
    rays_trace(scene, &ray, 1, &hit, NULL);
    return hit;
}
