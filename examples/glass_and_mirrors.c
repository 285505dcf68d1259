/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whitted's picture in a C program: balls of glass and mirrors on a chequered floor, every frame built from scratch as
 * they roll. One frame becomes a PNG file.
 *   glass-and-mirrors PICTURE.png [FRAME] [BOUNCES] */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/picture.h>

enum { WIDTH = 960, HEIGHT = 540, GLASS_BALLS = 5, BALLS = 40, FRAMES = 100 };

enum { GLASS, MIRROR, RED, FLOOR, MATERIALS };

static const cgt_material materials[MATERIALS] = {
    [GLASS] = {.kind = CGT_MATERIAL_GLASS, .index = 1.5f, .absorption = {0.25f, 0.06f, 0.12f}, .gloss = 600},
    [MIRROR] = {.kind = CGT_MATERIAL_MIRROR, .color = {0.93f, 0.9f, 0.85f}, .gloss = 600},
    [RED] = {.kind = CGT_MATERIAL_MATTE, .gloss = 60}, /* colours of what is matt are the look's */
    [FLOOR] = {.kind = CGT_MATERIAL_MATTE},
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

enum { SIDE = 24, SQUARES = SIDE * SIDE };

static void make_floor(float corner[SQUARES * 4][3], uint32_t index[SQUARES * 2][3], float color[SQUARES * 2][3])
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
        for (uint32_t k = 0; k < 6; k++)
            color[2 * i + k / 3][k % 3] = (column + row) % 2 ? 0.75f : 0.2f;
    }
}

static cgt_spheres spheres_of(const balls *b, uint32_t mask)
{
    return (cgt_spheres){.count = b->count,
                         .centers = cgt_floats(b->center[0], sizeof b->center[0]),
                         .radii = cgt_floats(&b->center[0][3], sizeof b->center[0]),
                         .mask = mask};
}

static cgt_result render(int frame, uint32_t bounces, const cgt_image *image)
{
    static balls glass, others;
    static float corner[SQUARES * 4][3], color[SQUARES * 2][3];
    static uint32_t index[SQUARES * 2][3];
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    cgt_picture *picture = NULL;
    char message[256] = "";
    place(frame, &glass, &others);
    make_floor(corner, index, color);
    const cgt_spheres of_glass = spheres_of(&glass, LIGHT), opaque = spheres_of(&others, DARK);
    const cgt_triangles floor = {.count = SQUARES * 2,
                                 .indices = cgt_uint32s(index[0], 0),
                                 .vertex_count = SQUARES * 4,
                                 .vertices = cgt_floats(corner[0], 0),
                                 .mask = DARK};
    const cgt_look looks[] = {{.materials = glass.material},
                              {.materials = others.material, .color = {0.6f, 0.09f, 0.05f}},
                              {.material = FLOOR, .sheet = true, .colors = color[0]}};
    const cgt_picture_options options = {
        .width = WIDTH,
        .height = HEIGHT,
        .antialias = 2,
        .shading = CGT_SHADING_BOUNCES,
        .lighting = {.light_count = 2,
                     .lights = {{.light = {CGT_LIGHT_POINT, {5, 9, -7}}, .color = {0.75f, 0.72f, 0.65f}},
                                {.light = {CGT_LIGHT_POINT, {-8, 6, -3}}, .color = {0.25f, 0.28f, 0.33f}}},
                     .sky = 0.13f},
        .style = {.background = {0.75f, 0.8f, 0.85f}},
        .bounces = {.limit = bounces,
                    .material_count = MATERIALS,
                    .materials = materials,
                    .shadow_mask = DARK,
                    .glass_mask = LIGHT}};
    const cgt_camera camera = {.eye = {0.5f, 2.6f, -7.5f}, .target = {0, 0.7f, 0}, .fov = 42};
    cgt_result result = cgt_context_create(NULL, &context);
    if (!result)
        result = cgt_scene_create(context, NULL, &scene);
    if (!result)
        result = cgt_scene_set_spheres(scene, NULL, &of_glass);
    if (!result)
        result = cgt_scene_set_spheres(scene, NULL, &opaque);
    if (!result)
        result = cgt_scene_set_triangles(scene, NULL, &floor);
    if (!result)
        result = cgt_scene_commit(scene);
    if (result) {
        cgt_context_get_error_message(context, message, sizeof message);
    } else {
        result = cgt_picture_create(context, &options, &picture);
        if (!result)
            result = cgt_picture_draw(picture, scene, &camera, looks, 3, image, NULL);
        cgt_picture_get_error_message(picture, message, sizeof message);
    }
    if (result)
        fprintf(stderr, "glass-and-mirrors: %s\n", message);
    cgt_picture_release(picture);
    cgt_scene_release(scene);
    cgt_context_release(context);
    return result;
}

int main(int argc, char **argv)
{
    if (argc < 2 || argc > 4) {
        fprintf(stderr, "usage: glass-and-mirrors PICTURE.png [FRAME] [BOUNCES]\n");
        return 2;
    }
    const long frame = argc > 2 ? strtol(argv[2], NULL, 10) : 0, bounces = argc > 3 ? strtol(argv[3], NULL, 10) : 8;
    if (bounces < 0 || bounces > CGT_PICTURE_MAX_BOUNCES) {
        fprintf(stderr, "glass-and-mirrors: BOUNCES must be from 0 to %d\n", CGT_PICTURE_MAX_BOUNCES);
        return 2;
    }
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    const cgt_image image = {.bytes = rgb};
    const cgt_result result = render((int)(frame % FRAMES), (uint32_t)bounces, &image);
    const cgt_result written = result ? CGT_OK : cgt_write_png(argv[1], &image, WIDTH, HEIGHT);
    if (result)
        fprintf(stderr, "glass-and-mirrors: %s\n", cgt_get_result_string(result));
    if (written)
        fprintf(stderr, "glass-and-mirrors: cannot write %s: %s\n", argv[1], strerror(errno));
    return result || written ? 1 : 0;
}
