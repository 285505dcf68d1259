/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Shadows in a C program: a spiral of balls on a floor under a lamp. A camera frame gives what each pixel sees; one
 * call tells which of it the lamp does not reach. The picture becomes a PPM file.
 *   cast-shadows PICTURE.ppm */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <cgt/cgt.h>

enum { BALLS = 28, FLOOR = 1, WIDTH = 640, HEIGHT = 384, PIXELS = WIDTH * HEIGHT };

typedef struct picture {
    float t[PIXELS], normal[3][PIXELS];
    float position[3][PIXELS]; /* where a pixel's ray hits */
    uint32_t primitive[PIXELS], geometry[PIXELS];
    uint8_t occluded[PIXELS];
    uint8_t rgb[PIXELS][3];
} picture;

typedef struct ball {
    float center[3], radius;
} ball;

static const float lamp[3] = {3.0f, 6.0f, 2.5f}, eye[3] = {0.0f, 4.0f, 8.0f}; /* the eye looks at the origin */

static cgt_result add_geometries(cgt_scene *scene, ball *balls)
{
    static const float corner[4][3] = {{-7, 0, -7}, {7, 0, -7}, {7, 0, 7}, {-7, 0, 7}};
    static const uint32_t index[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (int i = 0; i < BALLS; i++) {
        const float angle = 0.55f * (float)i, distance = 0.25f + 0.11f * (float)i;
        balls[i].radius = 0.18f + 0.008f * (float)i;
        balls[i].center[0] = distance * cosf(angle);
        balls[i].center[1] = balls[i].radius + 0.03f * (float)(BALLS - 1 - i);
        balls[i].center[2] = distance * sinf(angle);
    }
    const cgt_spheres spheres = {.count = BALLS,
                                 .centers = cgt_floats(balls[0].center, sizeof(ball)),
                                 .radii = cgt_floats(&balls[0].radius, sizeof(ball))};
    const cgt_triangles triangles = {
        .count = 2, .indices = cgt_uint32s(index[0], 0), .vertex_count = 4, .vertices = cgt_floats(corner[0], 0)};
    const cgt_result result = cgt_scene_set_spheres(scene, NULL, &spheres);    /* geometry 0 */
    return result ? result : cgt_scene_set_triangles(scene, NULL, &triangles); /* geometry 1: FLOOR */
}

/* The rays to the lamp skip the primitive that their pixel sees: they need no offset. */
static cgt_result trace(const cgt_scene *scene, const cgt_camera *camera, picture *p)
{
    const cgt_light light = {.position = {lamp[0], lamp[1], lamp[2]}, .kind = CGT_LIGHT_POINT};
    cgt_frame frame;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.t = p->t;
    frame.primitive = p->primitive;
    frame.geometry = p->geometry;
    for (int a = 0; a < 3; a++) {
        frame.normal[a] = p->normal[a];
        frame.position[a] = p->position[a];
    }
    const cgt_result result = cgt_trace_camera(scene, camera, &frame, NULL);
    return result ? result : cgt_occluded_frame(scene, camera, &frame, &light, 1, NULL, p->occluded, NULL);
}

/* Lambert's law where the lamp is visible, a little light everywhere. */
static float brightness(const picture *p, int i)
{
    float to_lamp[3], dot = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        to_lamp[k] = lamp[k] - p->position[k][i];
        dot += to_lamp[k] * p->normal[k][i];
        square += to_lamp[k] * to_lamp[k];
    }
    const int away = p->geometry[i] != FLOOR && dot < 0; /* a ball's own other side; a floor has two sides */
    return 0.12f + (p->occluded[i] || away ? 0 : 0.85f * fabsf(dot) / sqrtf(square));
}

static void draw(picture *p)
{
    for (int i = 0; i < PIXELS; i++) {
        const int hit = p->primitive[i] != CGT_INVALID_ID;
        const float light = hit ? brightness(p, i) : 0.05f, hue = 0.4f * (float)p->primitive[i];
        for (int k = 0; k < 3; k++) {
            const int uncoloured = !hit || p->geometry[i] == FLOOR;
            const float colour = uncoloured ? 0.9f : 0.6f + 0.4f * cosf(hue + 2.1f * (float)k);
            p->rgb[i][k] = (uint8_t)(255 * sqrtf(light * colour)); /* roughly the screen's gamma */
        }
    }
}

static int store(const picture *p, const char *path)
{
    FILE *file = fopen(path, "wb");
    int written = file && fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT) > 0;
    written = written && fwrite(p->rgb, sizeof p->rgb, 1, file) == 1;
    if (file && fclose(file) != 0)
        written = 0;
    if (!written)
        perror(path);
    return written;
}

static void report(const picture *p)
{
    int hits = 0, shadowed = 0;
    for (int i = 0; i < PIXELS; i++) {
        hits += p->primitive[i] != CGT_INVALID_ID;
        shadowed += p->occluded[i];
    }
    printf("%d of %d points do not see the lamp\n", shadowed, hits);
}

int main(int argc, char **argv)
{
    static picture p; /* too large for a stack */
    ball balls[BALLS];
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    cgt_camera camera;
    if (argc != 2) {
        fputs("usage: cast-shadows PICTURE.ppm\n", stderr);
        return 2;
    }
    cgt_camera_init(&camera);
    for (int k = 0; k < 3; k++)
        camera.eye[k] = eye[k];
    camera.fov = 38;

    cgt_result result = cgt_context_create(NULL, &context);
    if (!result)
        result = cgt_scene_create(context, NULL, &scene);
    if (!result)
        result = add_geometries(scene, balls);
    if (!result)
        result = cgt_scene_commit(scene);
    if (!result)
        result = trace(scene, &camera, &p);
    if (result) {
        char message[256];
        cgt_context_get_error_message(context, message, sizeof message);
        fprintf(stderr, "cast-shadows: %s %s\n", cgt_get_result_string(result), message);
    } else {
        draw(&p);
        report(&p);
    }
    const int written = !result && store(&p, argv[1]);
    cgt_scene_release(scene);
    cgt_context_release(context);
    if (fflush(stdout) != 0) {
        perror("cast-shadows: standard output");
        return EXIT_FAILURE;
    }
    return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
