/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whitted's picture in a C program: balls of glass and mirrors on a chequered floor, every frame built from scratch as
 * they roll. One frame becomes a PPM file.
 *   glass-and-mirrors PICTURE.ppm [FRAME] [BOUNCES] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/cgt.h>

#include <cgt/picture.h>
#include "whitted/whitted.h"

enum { WIDTH = 960, HEIGHT = 540, SAMPLES = 2, GLASS_BALLS = 5, BALLS = 40, FRAMES = 100 };

enum { GLASS, MIRROR, RED, FLOOR, MATERIALS };

static const cgt_material materials[MATERIALS] = {
    [GLASS] = {.kind = CGT_MATERIAL_GLASS, .index = 1.5f, .absorption = {0.25f, 0.06f, 0.12f}, .gloss = 600},
    [MIRROR] = {.kind = CGT_MATERIAL_MIRROR, .color = {0.93f, 0.9f, 0.85f}, .gloss = 600},
    [RED] = {.kind = CGT_MATERIAL_MATTE, .color = {0.6f, 0.09f, 0.05f}, .gloss = 60},
    [FLOOR] = {.kind = CGT_MATERIAL_MATTE, .color = {0.7f, 0.7f, 0.7f}},
};

/* What throws light shadows, and what dark ones. */
enum { DARK = 1, LIGHT = 2 };

typedef struct balls {
    uint32_t count;
    float center[BALLS][4]; /* with the radius */
    uint8_t material[BALLS];
} balls;

/* Where the balls are: a few large ones of glass, small ones on circles around them. */
static void place(int frame, balls *glass, balls *others)
{
    const float turn = 6.28318531f * (float)frame / (float)FRAMES;
    static const float large[GLASS_BALLS][3] = {
        {-1.2f, 0.3f, 1}, {1.15f, -0.2f, 0.85f}, {0.1f, 1.7f, 0.5f}, {0, -1.5f, 0.4f}, {-2.3f, -1.1f, 0.45f}};
    glass->count = GLASS_BALLS;
    for (int i = 0; i < GLASS_BALLS; i++) {
        const float ball[4] = {large[i][0], large[i][2] + 0.15f * fabsf(sinf(turn + (float)i)), large[i][1],
                               large[i][2]};
        memcpy(glass->center[i], ball, sizeof ball);
        glass->material[i] = GLASS;
    }
    others->count = BALLS;
    for (int i = 0; i < BALLS; i++) {
        const float angle = 2.39996323f * (float)i + turn, away = 0.62f * sqrtf((float)i + 8);
        const float radius = 0.14f + 0.1f * (float)(i % 3);
        const float ball[4] = {away * cosf(angle), radius, away * sinf(angle), radius};
        memcpy(others->center[i], ball, sizeof ball);
        others->material[i] = i % 2 ? MIRROR : RED;
    }
}

static void chequer(void *user, uint32_t primitive, float rgb[3])
{
    const uint32_t side = *(const uint32_t *)user, square = primitive / 2;
    const float albedo = (square % side + square / side) % 2 ? 0.75f : 0.2f;
    rgb[0] = rgb[1] = rgb[2] = albedo;
}

enum { SIDE = 24, SQUARES = SIDE * SIDE };

static void make_floor(float corner[SQUARES * 4][3], uint32_t index[SQUARES * 2][3])
{
    for (uint32_t i = 0; i < SQUARES; i++) {
        const uint32_t column = i % SIDE, row = i / SIDE;
        const float x = (float)column - 0.5f * SIDE, z = (float)row - 0.5f * SIDE;
        for (uint32_t k = 0; k < 4; k++) {
            corner[4 * i + k][0] = x + (float)(k & 1);
            corner[4 * i + k][1] = 0;
            corner[4 * i + k][2] = z + (float)(k >> 1);
        }
        const uint32_t first = 4 * i, two[2][3] = {{first, first + 2, first + 1}, {first + 1, first + 2, first + 3}};
        memcpy(index[2 * i], two, sizeof two);
    }
}

static cgt_spheres spheres_of(const balls *b, uint32_t mask)
{
    return (cgt_spheres){.count = b->count,
                         .centers = b->center[0],
                         .center_stride = sizeof b->center[0],
                         .radii = &b->center[0][3],
                         .radius_stride = sizeof b->center[0],
                         .mask = mask};
}

static int store(const char *path, float (*light)[3])
{
    static cgt_srgb_tables tables;
    FILE *file = fopen(path, "wb");
    int written = file && fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT) > 0;
    cgt_srgb_tables_init(&tables);
    for (int y = 0; y < HEIGHT && written; y++)
        for (int x = 0; x < WIDTH && written; x++) {
            uint8_t rgb[3];
            for (int c = 0; c < 3; c++) {
                float sum = 0;
                for (int s = 0; s < SAMPLES * SAMPLES; s++)
                    sum += light[(y * SAMPLES + s / SAMPLES) * WIDTH * SAMPLES + x * SAMPLES + s % SAMPLES][c];
                rgb[c] = cgt_srgb_encode(&tables, sum / (SAMPLES * SAMPLES));
            }
            written = fwrite(rgb, sizeof rgb, 1, file) == 1;
        }
    if (file && fclose(file))
        written = 0;
    return written ? 0 : -1;
}

static cgt_result render(int frame, uint32_t bounces, float (*light)[3])
{
    static balls glass, others;
    static float corner[SQUARES * 4][3];
    static uint32_t index[SQUARES * 2][3], side = SIDE;
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    place(frame, &glass, &others);
    make_floor(corner, index);
    const cgt_spheres of_glass = spheres_of(&glass, LIGHT), opaque = spheres_of(&others, DARK);
    const cgt_triangles floor = {
        .count = SQUARES * 2, .indices = index[0], .vertex_count = SQUARES * 4, .vertices = corner[0], .mask = DARK};
    const whitted_geometry geometry[] = {
        {.spheres = &of_glass, .material = glass.material},
        {.spheres = &opaque, .material = others.material},
        {.triangles = &floor, .material_of_all = FLOOR, .sheet = true, .color = chequer, .color_user = &side}};
    const whitted_light lamps[] = {{{CGT_LIGHT_POINT, {5, 9, -7}}, {0.75f, 0.72f, 0.65f}},
                                   {{CGT_LIGHT_POINT, {-8, 6, -3}}, {0.25f, 0.28f, 0.33f}}};
    whitted w = {.geometry = geometry,
                 .geometries = 3,
                 .material = materials,
                 .materials = MATERIALS,
                 .light = lamps,
                 .lights = 2,
                 .ambient = {0.12f, 0.13f, 0.15f},
                 .sky = {{0.15f, 0.3f, 0.6f}, {0.75f, 0.8f, 0.85f}},
                 .up = {0, 1, 0},
                 .bounces = bounces,
                 .faintest = 1.0f / 512,
                 .shadow_mask = DARK,
                 .glass_mask = LIGHT,
                 .glass_shadow = 0.6f};
    cgt_camera camera;
    cgt_camera_init(&camera);
    const float eye[3] = {0.5f, 2.6f, -7.5f}, target[3] = {0, 0.7f, 0};
    memcpy(camera.eye, eye, sizeof eye);
    memcpy(camera.target, target, sizeof target);
    camera.fov = 42;
    const char *wrong = cgt_whitted_check(&w);
    if (wrong)
        fprintf(stderr, "glass-and-mirrors: %s\n", wrong);
    cgt_result result = wrong ? CGT_ERROR_INVALID_ARGUMENT : cgt_context_create(NULL, &context);
    if (!result)
        result = cgt_scene_create(context, NULL, &scene);
    if (!result)
        result = cgt_scene_add_spheres(scene, &of_glass, NULL);
    if (!result)
        result = cgt_scene_add_spheres(scene, &opaque, NULL);
    if (!result)
        result = cgt_scene_add_triangles(scene, &floor, NULL);
    if (!result)
        result = cgt_scene_commit(scene);
    w.scene = scene;
    if (!result)
        result = cgt_whitted_frame(&w, &camera, WIDTH * SAMPLES, HEIGHT * SAMPLES, NULL, light);
    cgt_scene_release(scene);
    cgt_context_release(context);
    return result;
}

int main(int argc, char **argv)
{
    if (argc < 2 || argc > 4) {
        fprintf(stderr, "usage: glass-and-mirrors PICTURE.ppm [FRAME] [BOUNCES]\n");
        return 2;
    }
    const long frame = argc > 2 ? strtol(argv[2], NULL, 10) : 0, bounces = argc > 3 ? strtol(argv[3], NULL, 10) : 8;
    if (bounces < 0 || bounces > WHITTED_MAX_BOUNCES) {
        fprintf(stderr, "glass-and-mirrors: BOUNCES must be from 0 to %d\n", WHITTED_MAX_BOUNCES);
        return 2;
    }
    float(*light)[3] = malloc((size_t)WIDTH * HEIGHT * SAMPLES * SAMPLES * sizeof *light);
    const cgt_result result = light ? render((int)(frame % FRAMES), (uint32_t)bounces, light) : CGT_ERROR_OUT_OF_MEMORY;
    if (result)
        fprintf(stderr, "glass-and-mirrors: %s\n", cgt_get_result_string(result));
    const int failed = result || store(argv[1], light);
    if (failed && !result)
        fprintf(stderr, "glass-and-mirrors: cannot write %s\n", argv[1]);
    free(light);
    return failed ? 1 : 0;
}
