/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Real meshes as scenes. */
#define _POSIX_C_SOURCE 200809L
#include "embree/mesh_rays.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "primitive/edge_point.h"
#include "support/ray_arrays.h"
#include "support/trajectory_told.h"
#include <cgt/trajectory.h>

#define SQUARE 8u

bool mesh_is_here(const char *path)
{
#ifdef CGT_HAVE_MESHES
    const bool reads = true;
#else
    const bool reads = false;
#endif
    const bool exists = access(path, R_OK) == 0;
    if (!reads || !exists)
        printf("%s: %s\n", path, reads ? "not there" : "this build does not read meshes");
    return reads && exists;
}

/* ---- files ---- */

static bool take(hard_scene *s, const cgt_trajectory_frame *frame)
{
    hard_geometry *g = &s->geometry[0];
    /* the sizes cannot overflow: the reader holds as many bytes */
    g->vertex = malloc(((size_t)frame->count + 1) * sizeof *g->vertex);
    g->index = malloc(((size_t)frame->triangles + 1) * sizeof *g->index);
    s->geometries = 1;
    if (!g->vertex || !g->index)
        return false;
    memcpy(g->vertex, frame->position, (size_t)frame->count * sizeof *g->vertex);
    memcpy(g->index, frame->index, (size_t)frame->triangles * sizeof *g->index);
    g->vertices = frame->count;
    g->triangles = frame->triangles;
    return true;
}

bool mesh_read(const char *path, uint32_t rays, hard_scene *s)
{
    char error[512] = "no triangles";
    cgt_trajectory_frame frame;
    bool done = false;
    *s = (hard_scene){.wanted = rays, .place = {.scale = 1}, .random = random_make(rays)};
    cgt_trajectory *file = told_open(path, NULL, error, sizeof error);
    if (file && told_read(file, &frame, error, sizeof error) == 1 && frame.triangles) {
        done = take(s, &frame);
        snprintf(error, sizeof error, "%s: out of memory", path);
    }
    if (!done)
        fprintf(stderr, "%s: %s\n", path, error);
    cgt_trajectory_close(file);
    return done;
}

/* ---- rays ---- */

static void find_bounds(const hard_scene *s, float low[3], float high[3])
{
    const hard_geometry *g = &s->geometry[0];
    for (int a = 0; a < 3; a++) {
        low[a] = INFINITY;
        high[a] = -INFINITY;
    }
    for (uint32_t i = 0; i < g->vertices; i++)
        for (int a = 0; a < 3; a++) {
            low[a] = fminf(low[a], g->vertex[i][a]);
            high[a] = fmaxf(high[a], g->vertex[i][a]);
        }
}

cgt_camera mesh_camera(const hard_scene *s, const float eye[3], const float target[3])
{
    cgt_camera camera;
    float low[3], high[3];
    find_bounds(s, low, high);
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++) {
        camera.eye[a] = low[a] + eye[a] * (high[a] - low[a]);
        camera.target[a] = low[a] + target[a] * (high[a] - low[a]);
    }
    memcpy(camera.up, (float[3]){0.03f, 1, 0.02f}, sizeof camera.up);
    return camera;
}

bool mesh_aim_pixels(hard_scene *s, const float eye[3], const float target[3])
{
    const cgt_camera camera = mesh_camera(s, eye, target);
    cgt_camera_rays pixels;
    char message[160];
    if (cgt_camera_prepare(&camera, 1280, 720, &pixels, message) != CGT_OK) {
        fprintf(stderr, "%s\n", message);
        return false;
    }
    while (hard_wants_ray(s)) {
        const uint32_t x = SQUARE * random_below(&s->random, 1280 / SQUARE);
        const uint32_t y = SQUARE * random_below(&s->random, 720 / SQUARE);
        for (uint32_t i = 0; i < SQUARE * SQUARE; i++) {
            const truth_ray ray = camera_ray(&pixels, x + i % SQUARE, y + i / SQUARE);
            hard_raw_ray(s, &ray);
        }
    }
    return !s->failed;
}

void mesh_aim_edges(hard_scene *s)
{
    float low[3], high[3];
    find_bounds(s, low, high);
    while (hard_wants_ray(s)) {
        float org[3], target[3];
        if (!edge_point(s, target))
            return;
        for (int a = 0; a < 3; a++)
            org[a] = random_float(&s->random, 1.5f * low[a] - 0.5f * high[a], 1.5f * high[a] - 0.5f * low[a]);
        hard_aim(s, org, target, 1);
    }
}
