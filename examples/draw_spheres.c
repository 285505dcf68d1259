/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A spiral of spheres, drawn into spheres.png: shadows, and 16 rays a pixel to the sky. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <cgt/picture.h>

enum { SPHERES = 400, WIDTH = 1280, HEIGHT = 720 };

int main(void)
{
    static float center[SPHERES][3], color[SPHERES][3];
    static uint8_t rgb[HEIGHT][WIDTH][3];
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    cgt_picture *picture = NULL;
    const cgt_spheres spheres = {.count = SPHERES, .centers = cgt_floats(center[0], 0), .radius = 0.16f};
    const cgt_look look = {.colors = color[0]};
    const cgt_camera camera = {.eye = {0, -7, 3}, .up = {0, 0, 1}}; /* looks at the origin */
    const cgt_picture_options options = {
        .width = WIDTH, .height = HEIGHT, .antialias = 2, .shading = CGT_SHADING_FULL, .lighting = {.ambient = 16}};
    const cgt_image image = {.bytes = rgb[0][0]};

    for (int i = 0; i < SPHERES; i++) {
        const float angle = 2.4f * (float)i, away = 0.15f * sqrtf((float)i);
        const float place[3] = {away * cosf(angle), away * sinf(angle), 0.6f * sinf(2.0f * away)};
        memcpy(center[i], place, sizeof place);
        cgt_get_map_color(cgt_find_colormap("viridis"), (float)i / SPHERES, color[i]);
        for (int c = 0; c < 3; c++)
            color[i][c] = cgt_srgb_to_linear(color[i][c]);
    }
    cgt_context_create(NULL, &context);
    cgt_scene_create(context, NULL, &scene);
    cgt_scene_set_spheres(scene, NULL, &spheres);
    cgt_scene_commit(scene);
    cgt_picture_create(context, &options, &picture);
    if (cgt_picture_draw(picture, scene, &camera, &look, 1, &image, NULL) != CGT_OK ||
        cgt_write_png("spheres.png", &image, WIDTH, HEIGHT) != CGT_OK)
        fputs("no picture\n", stderr);
    cgt_picture_release(picture);
    cgt_scene_release(scene);
    cgt_context_release(context);
    return 0;
}
