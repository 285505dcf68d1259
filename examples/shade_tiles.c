/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A shaded picture in a C program, 8 bits for each of red, green, blue and alpha: what a window or an encoder takes. A
 * visitor shades each tile while its hits are in the cache. No plane of floats is ever stored, which costs less than a
 * pass over planes. A picture needs no more than single precision: FAST. The picture becomes a PAM file.
 *   shade-tiles PICTURE.pam */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <cgt/cgt.h>

enum { BALLS = 300, WIDTH = 640, HEIGHT = 384 };

typedef struct ball {
    float center[3], radius;
} ball;

typedef struct picture {
    uint32_t rgba[HEIGHT][WIDTH]; /* bytes red, green, blue, alpha */
    uint32_t color[BALLS];        /* red, green and blue of each ball, 8 bits each, from the lowest on */
} picture;

static const float sun[3] = {0.48f, 0.8f, 0.36f}; /* the direction to it: a unit vector */

/* Light of 0 to 1 times a colour's byte at `shift`, in place. */
static uint32_t shade_channel(float light, uint32_t color, int shift)
{
    return (uint32_t)(light * (float)(color >> shift & 255) + 0.5f) << shift;
}

/* Lambert's law, and a little light everywhere; alpha is 0 where nothing is hit. */
static uint32_t shade(const float normal[3], uint32_t color)
{
    const float dot = normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2];
    const float light = 0.15f + 0.85f * (dot > 0 ? dot : 0);
    const float low = light < 1 ? light : 1;
    return shade_channel(low, color, 0) | shade_channel(low, color, 8) | shade_channel(low, color, 16) | 255u << 24;
}

/* Called for each finished tile, by several threads at once. Tiles do not overlap. */
static cgt_visit shade_tile(void *user, const cgt_tile *tile)
{
    picture *p = user;
    for (uint32_t j = 0; j < tile->height; j++)
        for (uint32_t i = 0; i < tile->width; i++) {
            const size_t k = j * tile->row_stride + i;
            const float normal[3] = {tile->normal[0][k], tile->normal[1][k], tile->normal[2][k]};
            const uint32_t number = tile->primitive[k];
            p->rgba[tile->y + j][tile->x + i] = number == CGT_INVALID_ID ? 0 : shade(normal, p->color[number]);
        }
    return CGT_VISIT_CONTINUE;
}

/* Balls on a sphere about the origin, and a colour for each. */
static void place(ball *balls, picture *p)
{
    for (int i = 0; i < BALLS; i++) {
        const float y = 1 - 2 * ((float)i + 0.5f) / BALLS, angle = 2.39996323f * (float)i, ring = sqrtf(1 - y * y);
        balls[i] = (ball){.center = {2 * ring * cosf(angle), 2 * y, 2 * ring * sinf(angle)}, .radius = 0.17f};
        p->color[i] = 0;
        for (int k = 0; k < 3; k++)
            p->color[i] |= (uint32_t)(155 + 100 * cosf(0.1f * (float)i + 2.1f * (float)k)) << 8 * k;
    }
}

static cgt_result draw(cgt_scene *scene, const ball *balls, picture *p)
{
    const cgt_spheres spheres = {.count = BALLS,
                                 .centers = cgt_floats(balls[0].center, sizeof(ball)),
                                 .radii = cgt_floats(&balls[0].radius, sizeof(ball))};
    const cgt_trace_options options = {.precision = CGT_PRECISION_FAST};
    cgt_camera camera;
    cgt_frame frame;
    cgt_camera_init(&camera);
    camera.eye[2] = 7;
    camera.fov = 40;
    cgt_frame_init(&frame, WIDTH, HEIGHT);
    frame.visitor = shade_tile;
    frame.visitor_user = p;
    frame.visitor_fields = CGT_FIELD_PRIMITIVE | CGT_FIELD_NORMAL;
    cgt_result result = cgt_scene_set_spheres(scene, NULL, &spheres);
    if (!result)
        result = cgt_scene_commit(scene);
    return result ? result : cgt_trace_camera(scene, &camera, &frame, &options);
}

static int store(const picture *p, const char *path)
{
    FILE *file = fopen(path, "wb");
    int written = file && fprintf(file, "P7\nWIDTH %d\nHEIGHT %d\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n",
                                  WIDTH, HEIGHT) > 0;
    for (int y = 0; written && y < HEIGHT; y++) {
        unsigned char row[WIDTH][4];
        for (int x = 0; x < WIDTH; x++)
            for (int k = 0; k < 4; k++)
                row[x][k] = (unsigned char)(p->rgba[y][x] >> 8 * k); /* on any machine in this order */
        written = fwrite(row, sizeof row, 1, file) == 1;
    }
    if (file && fclose(file) != 0)
        written = 0;
    if (!written)
        perror(path);
    return written;
}

int main(int argc, char **argv)
{
    static picture p; /* too large for a stack */
    ball balls[BALLS];
    cgt_context *context = NULL;
    cgt_scene *scene = NULL;
    if (argc != 2) {
        fputs("usage: shade-tiles PICTURE.pam\n", stderr);
        return 2;
    }
    place(balls, &p);
    cgt_result result = cgt_context_create(NULL, &context);
    if (!result)
        result = cgt_scene_create(context, NULL, &scene);
    if (!result)
        result = draw(scene, balls, &p);
    if (result) {
        char message[256];
        cgt_context_get_error_message(context, message, sizeof message);
        fprintf(stderr, "shade-tiles: %s\n", message);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
    return !result && store(&p, argv[1]) ? 0 : 1;
}
