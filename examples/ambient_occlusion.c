/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ambient occlusion in a C program: a heap of balls on a floor under an overcast sky. The brightness of a pixel is the
 * share of the sky that it sees. The picture becomes a PPM file.
 *   ambient-occlusion PICTURE.ppm [SAMPLES] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <cgt/cgt.h>

enum { LAYERS = 4, BALLS = 16 + 9 + 4 + 1, FLOOR = 1, WIDTH = 640, HEIGHT = 384, PIXELS = WIDTH * HEIGHT };

/* Planes begin at cache lines and rows are whole lines: the library stores these fastest. */
typedef struct picture {
    _Alignas(64) float t[PIXELS];
    _Alignas(64) float normal[3][PIXELS];
    _Alignas(64) uint32_t primitive[PIXELS], geometry[PIXELS];
    float visibility[PIXELS];
    uint8_t rgb[PIXELS][3];
} picture;

/* A pyramid of touching balls of radius 1: four by four, each layer in the hollows of the one below. */
static void pile_up(float center[BALLS][3])
{
    int ball = 0;
    for (int layer = 0; layer < LAYERS; layer++)
        for (int i = 0; i < (LAYERS - layer) * (LAYERS - layer); i++, ball++) {
            const int side = LAYERS - layer, row = i / side;
            center[ball][0] = (float)(2 * (i % side) - side + 1);
            center[ball][1] = 1 + (float)layer * 1.41421356f;
            center[ball][2] = (float)(2 * row - side + 1);
        }
}

static cgt_result add_geometries(cgt_scene *scene, const float center[BALLS][3])
{
    static const float corner[4][3] = {{-20, 0, -20}, {20, 0, -20}, {20, 0, 20}, {-20, 0, 20}};
    static const uint32_t index[2][3] = {{0, 1, 2}, {0, 2, 3}};
    const cgt_spheres spheres = {.count = BALLS, .centers = cgt_floats(center[0], 0), .radius = 1};
    const cgt_triangles triangles = {
        .count = 2, .indices = cgt_uint32s(index[0], 0), .vertex_count = 4, .vertices = cgt_floats(corner[0], 0)};
    const cgt_result result = cgt_scene_set_spheres(scene, NULL, &spheres);    /* geometry 0 */
    return result ? result : cgt_scene_set_triangles(scene, NULL, &triangles); /* geometry 1: FLOOR */
}

/* Traces the closest hits, and from their planes the visibility of the sky. */
static cgt_result trace(const cgt_scene *scene, const cgt_camera *camera, uint32_t samples, picture *p)
{
    cgt_frame frame;
    cgt_ambient_options ambient;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.t = p->t;
    frame.primitive = p->primitive;
    frame.geometry = p->geometry;
    for (int a = 0; a < 3; a++)
        frame.normal[a] = p->normal[a];
    cgt_ambient_options_init(&ambient);
    ambient.samples = samples;
    const cgt_result result = cgt_trace_camera(scene, camera, &frame, NULL);
    return result ? result : cgt_ambient_occlusion(scene, camera, &frame, &ambient, p->visibility, NULL);
}

static void draw(picture *p)
{
    for (int i = 0; i < PIXELS; i++) {
        const int uncoloured = p->primitive[i] == CGT_INVALID_ID || p->geometry[i] == FLOOR;
        for (int k = 0; k < 3; k++) {
            const float colour =
                uncoloured ? 0.9f : 0.6f + 0.4f * cosf(0.9f * (float)p->primitive[i] + 2.1f * (float)k);
            p->rgb[i][k] = (uint8_t)(255 * sqrtf(p->visibility[i] * colour)); /* roughly the screen's gamma */
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
    double sum = 0;
    int hits = 0;
    for (int i = 0; i < PIXELS; i++)
        if (p->primitive[i] != CGT_INVALID_ID) {
            sum += (double)p->visibility[i];
            hits++;
        }
    printf("%d pixels see %.1f %% of the sky\n", hits, hits ? 100 * sum / hits : 0);
}

int main(int argc, char **argv)
{
    static picture p; /* too large for a stack */
    float center[BALLS][3];
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    cgt_scene_options options;
    cgt_camera camera;
    char *end = NULL;
    const unsigned long samples = argc == 3 ? strtoul(argv[2], &end, 10) : 64;
    if (argc < 2 || argc > 3 || (end && (*end || !samples || samples > 1024))) {
        fputs("usage: ambient-occlusion PICTURE.ppm [SAMPLES]: 1 to 1024, 64 unless given\n", stderr);
        return 2;
    }
    pile_up(center);
    cgt_camera_init(&camera);
    camera.eye[0] = 5;
    camera.eye[1] = 9;
    camera.eye[2] = 14;
    camera.target[1] = 2;
    camera.fov = 38;
    cgt_scene_options_init(&options);
    options.rays = CGT_RAY_KIND_INCOHERENT; /* most rays are those towards the sky */

    cgt_result result = cgt_context_create(NULL, &context);
    if (!result)
        result = cgt_scene_create(context, &options, &scene);
    if (!result)
        result = add_geometries(scene, (const float(*)[3])center);
    if (!result)
        result = cgt_scene_commit(scene);
    if (!result)
        result = trace(scene, &camera, (uint32_t)samples, &p);
    if (result) {
        char message[256];
        cgt_context_get_error_message(context, message, sizeof message);
        fprintf(stderr, "ambient-occlusion: %s %s\n", cgt_get_result_string(result), message);
    } else {
        draw(&p);
        report(&p);
    }
    const int written = !result && store(&p, argv[1]);
    cgt_scene_release(scene);
    cgt_context_release(context);
    if (fflush(stdout) != 0) {
        perror("ambient-occlusion: standard output");
        return EXIT_FAILURE;
    }
    return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
