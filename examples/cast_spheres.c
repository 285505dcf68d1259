/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Hits in a C program. Spheres fly around in an array of this program. In every frame they move, the scene is
 * committed, a camera draws them (as letters, one per sphere), and a single ray is traced. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <cgt/cgt.h>

enum { SPHERES = 8, FRAMES = 3, WIDTH = 72, HEIGHT = 24 };

typedef struct ball { /* any layout will do: the library is told the stride */
    float center[3];
    float radius;
    float speed;
} ball;

/* Called for each finished tile, by several threads at once. Tiles do not overlap. */
static cgt_visit draw_tile(void *user, const cgt_tile *tile)
{
    char(*picture)[WIDTH + 1] = user;
    for (uint32_t j = 0; j < tile->height; j++)
        for (uint32_t i = 0; i < tile->width; i++) {
            const size_t pixel = j * tile->row_stride + i;
            const uint32_t primitive = tile->primitive[pixel];
            const int lit = tile->normal[1][pixel] > 0.0f; /* from above */
            picture[tile->y + j][tile->x + i] =
                (char)(primitive == CGT_INVALID_ID ? '.' : (lit ? 'A' : 'a') + (int)primitive);
        }
    return CGT_VISIT_CONTINUE;
}

static void move(ball *balls, float time)
{
    for (int i = 0; i < SPHERES; i++) {
        const float angle = (float)i + time * balls[i].speed;
        balls[i].center[0] = 2.6f * cosf(angle);
        balls[i].center[1] = 1.1f * sinf(1.7f * angle);
        balls[i].center[2] = 2.6f * sinf(angle);
    }
}

/* Traces a camera's frame and one ray. */
static cgt_result trace(const cgt_scene *scene)
{
    char picture[HEIGHT][WIDTH + 1] = {{0}};
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.eye[2] = 9.0f;
    camera.fov = 32.0f;
    cgt_frame frame;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.visitor = draw_tile;
    frame.visitor_user = picture;
    frame.visitor_fields = CGT_FIELD_PRIMITIVE | CGT_FIELD_NORMAL;
    cgt_result result = cgt_trace_camera(scene, &camera, &frame, NULL);
    if (result)
        return result;
    for (int y = 0; y < HEIGHT; y++)
        puts(picture[y]);

    const float org[3] = {0.0f, 0.0f, 9.0f}, dir[3] = {0.25f, 0.0f, -1.0f};
    float t;
    uint32_t primitive;
    const cgt_rays rays = {.count = 1, .org = {&org[0], &org[1], &org[2]}, .dir = {&dir[0], &dir[1], &dir[2]}};
    const cgt_hits hits = {.t = &t, .primitive = &primitive};
    result = cgt_trace_rays(scene, &rays, &hits, NULL);
    if (result == CGT_OK && primitive == CGT_INVALID_ID)
        puts("the ray hits nothing\n");
    else if (result == CGT_OK)
        printf("the ray hits sphere %c at t = %g\n\n", 'A' + (int)primitive, (double)t);
    return result;
}

int main(void)
{
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    uint32_t geometry = CGT_INVALID_ID;
    ball balls[SPHERES];
    for (int i = 0; i < SPHERES; i++) {
        balls[i].radius = 0.4f + 0.05f * (float)i;
        balls[i].speed = 0.5f + 0.1f * (float)i;
    }
    move(balls, 0.0f);
    const cgt_spheres spheres = {.count = SPHERES,
                                 .centers = cgt_floats(balls[0].center, sizeof(ball)),
                                 .radii = cgt_floats(&balls[0].radius, sizeof(ball))};

    cgt_result result = cgt_context_create(NULL, &context);
    if (!result)
        result = cgt_scene_create(context, NULL, &scene);
    if (!result)
        result = cgt_scene_set_spheres(scene, &geometry, &spheres);
    for (int i = 0; i < FRAMES && !result; i++) {
        move(balls, (float)i); /* the scene reads this array; the commit rebuilds from it */
        result = cgt_scene_commit(scene);
        if (!result)
            result = trace(scene);
    }
    if (result) {
        char message[256];
        cgt_context_get_error_message(context, message, sizeof message);
        fprintf(stderr, "cast-spheres: %s %s\n", cgt_get_result_string(result), message);
    }
    cgt_scene_release(scene); /* NULL is fine */
    cgt_context_release(context);
    if (fflush(stdout) != 0) {
        perror("cast-spheres: standard output");
        return EXIT_FAILURE;
    }
    return result ? EXIT_FAILURE : EXIT_SUCCESS;
}
