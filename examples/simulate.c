/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A simulation with a picture: simulate >picture.pgm. 100,000 particles move in doubles, far from the origin. In each
 * step the scene is built from them as they are, and some look ahead; in the end a camera draws all with shadows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <cgt/cgt.h>

enum { PARTICLES = 100000, STEPS = 10, LOOKS = 10000, WIDTH = 640, HEIGHT = 480, PIXELS = WIDTH * HEIGHT };

static struct particle { /* any layout will do: the library is told where the numbers are, and how far apart */
    double x[3], v[3];
    int type;
} p[PARTICLES];
static const double middle[3] = {4.0e8, -7.0e8, 1.0e9}; /* of the box: floats are 32 to 64 apart there */
static const float radii[3] = {0.02f, 0.03f, 0.05f};    /* by type */
static cgt_context *context;
static cgt_scene *scene;

/* Ends the program with a sentence where a call has failed. */
static void check(cgt_result result, const char *what)
{
    if (result == CGT_OK)
        return;
    char message[256];
    cgt_context_get_error_message(context, message, sizeof message);
    fprintf(stderr, "simulate: %s: %s %s\n", what, cgt_get_result_string(result), message);
    exit(EXIT_FAILURE);
}

static void add_particles(void)
{
    static cgt_spheres s; /* zeros: the default of every field */
    for (int i = 0; i < PARTICLES; i++)
        for (int a = 0; a < 3; a++) {
            p[i].x[a] = middle[a] + 10.0 * rand() / RAND_MAX - 5.0;
            p[i].v[a] = 2.0 * rand() / RAND_MAX - 1.0;
            p[i].type = i % 3;       /* radius number 0, 1 or 2 */
            s.origin[a] = middle[a]; /* cameras, rays and lights are relative to it */
        }
    s.count = PARTICLES;
    s.centers = cgt_doubles(p[0].x, 0);
    s.types = cgt_uint32s((const uint32_t *)&p[0].type, 0);
    s.centers.stride = s.types.stride = sizeof p[0];
    s.radii = cgt_floats(radii, 0), s.type_count = 3;
    check(cgt_scene_set_spheres(scene, NULL, &s), "particles");
}

/* Traces a ray from some particles, past themselves, along their flight. */
static void look_ahead(void)
{
    static float org[3][LOOKS], dir[3][LOOKS], t[LOOKS];
    static uint32_t self[LOOKS];
    static cgt_rays rays;
    static cgt_hits hits;
    int seen = 0;
    rays.count = LOOKS, rays.skip_primitive = self, hits.t = t;
    for (int a = 0; a < 3; a++)
        rays.org[a] = org[a], rays.dir[a] = dir[a];
    for (int i = 0; i < LOOKS; i++) {
        for (int a = 0; a < 3; a++)
            org[a][i] = (float)(p[i].x[a] - middle[a]), dir[a][i] = (float)p[i].v[a];
        self[i] = (uint32_t)i;
    }
    check(cgt_trace_rays(scene, &rays, &hits, NULL), "look ahead");
    for (int i = 0; i < LOOKS; i++)
        seen += t[i] < INFINITY; /* else there is nothing */
    fprintf(stderr, "%d of %d particles see another one\n", seen, LOOKS);
}

/* A pixel is bright where the lamp shines. */
static void draw(void)
{
    static float t[PIXELS];
    static uint32_t primitive[PIXELS], geometry[PIXELS];
    static uint8_t shadow[PIXELS];
    static const cgt_light lamp = {CGT_LIGHT_DIRECTIONAL, {0.36f, 0.8f, 0.48f}};
    static cgt_camera camera; /* zeros: it looks at the origin */
    cgt_frame frame;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    camera.eye[2] = 20;
    frame.t = t, frame.primitive = primitive, frame.geometry = geometry;
    check(cgt_trace_camera(scene, &camera, &frame, NULL), "picture");
    check(cgt_occluded_frame(scene, &camera, &frame, &lamp, 1, NULL, shadow, NULL), "shadows");
    printf("P5 %d %d 255\n", WIDTH, HEIGHT);
    for (int i = 0; i < PIXELS; i++)
        putchar(!(t[i] < INFINITY) ? 10 : shadow[i] ? 70 : 230);
}

int main(void)
{
    check(cgt_context_create(NULL, &context), "context"); /* if it fails, it is there to tell why */
    check(cgt_scene_create(context, NULL, &scene), "scene");
    add_particles();
    for (int step = 0; step < STEPS; step++) {
        for (int i = 0; i < 3 * PARTICLES; i++)
            p[i / 3].x[i % 3] += 0.01 * p[i / 3].v[i % 3];
        check(cgt_scene_commit(scene), "commit"); /* reads the particles as they are now */
        look_ahead();
    }
    draw();
    cgt_scene_release(scene);
    cgt_context_release(context);
    return fflush(stdout) == 0 && !ferror(stdout) ? EXIT_SUCCESS : EXIT_FAILURE;
}
