/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench make: procedural scenes as .frames, so that every figure can be made again without a simulator.
 *   cloudN   N spheres spread evenly over a box of 3.56 x 2 x 2, their radii 0.3 to 0.5 of the mean spacing, each on a
 *            small closed path of its own
 *   clustersN  such spheres, smaller, in 64 clusters of different sizes, dense in their middles
 *   blobsN   N triangles in one or several bumpy balls of meridians and parallels, every vertex on the path of its
 *            parallel; at the poles lie triangles without an area
 *   stadium  a ball of 20,000 triangles and radius 1 on the ground of a bowl of 2,000 triangles and radius 1,000
 * The same file on every machine with IEEE arithmetic and the same sinf. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "bench_random.h"
#include "trajectory.h"

typedef struct make_settings {
    const char *scene, *path;
    uint32_t frames;
} make_settings;

typedef struct cloud {
    const char *name;
    uint32_t spheres;
    int clustered;
} cloud;

enum { CLUSTERS = 64 };

static const cloud clouds[] = {{"cloud2k", 2000, 0},
                               {"cloud20k", 20000, 0},
                               {"cloud200k", 200000, 0},
                               {"cloud1m", 1000000, 0},
                               {"clusters1m", 1000000, 1}};

/* Balls at random places within `spread` of the origin, each of meridians x parallels x 2 triangles. */
typedef struct blobs {
    const char *name;
    uint32_t balls, meridians, parallels;
    float radius, spread[3];
    float bowl; /* radius of a bowl around them; 0: none */
} blobs;

enum { BOWL_MERIDIANS = 40, BOWL_PARALLELS = 25 };

static const blobs all_blobs[] = {{"blobs2k", 20, 10, 5, 0.4f, {1.5f, 0.8f, 0.9f}, 0.0f},
                                  {"blob100k", 1, 316, 158, 1.25f, {0.0f, 0.0f, 0.0f}, 0.0f},
                                  {"blobs1m", 16, 250, 125, 0.5f, {1.4f, 0.7f, 0.8f}, 0.0f},
                                  {"stadium", 1, 100, 100, 1.0f, {0.0f, 0.0f, 0.0f}, 1000.0f}};

#define SCENES "cloud2k, cloud20k, cloud200k, cloud1m, clusters1m, blobs2k, blob100k, blobs1m, stadium"

static const struct argp_option options[] = {{"frames", 'n', "COUNT", 0, "frames to write (default 6)", 0},
                                             {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state)
{
    make_settings *settings = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    switch (key) {
    case 'n':
        if (program_parse_u32(argument, 1, 1000000, &settings->frames, error, sizeof error))
            argp_error(state, "-n: %s", error);
        return 0;
    case ARGP_KEY_ARG:
        if (state->arg_num == 0)
            settings->scene = argument;
        else if (state->arg_num == 1)
            settings->path = argument;
        else
            argp_error(state, "one SCENE and one FILE, not %s too", argument);
        return 0;
    case ARGP_KEY_END:
        if (state->arg_num < 2)
            argp_error(state, "SCENE and FILE.frames are wanted");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* A random number around 0 of variance 1, nearly Gaussian. */
static float bell(uint64_t *state)
{
    float sum = -6;
    for (int i = 0; i < 12; i++)
        sum += bench_random(state);
    return sum;
}

/* Places the spheres, x y z r each, and their phases. The start of the random sequence is for the clusters. */
static void place(float *rest, float *phase, const cloud *scene, float spacing)
{
    static const float half[3] = {1.78f, 1, 1}, half_of_middles[3] = {1.5f, 0.8f, 0.9f};
    float cluster[CLUSTERS][4]; /* middle and spread */
    uint64_t state = bench_random_start;
    for (int k = 0; k < CLUSTERS; k++) {
        for (int a = 0; a < 3; a++)
            cluster[k][a] = (bench_random(&state) * 2 - 1) * half_of_middles[a];
        cluster[k][3] = 0.02f + 0.2f * bench_random(&state);
    }
    for (uint32_t i = 0; i < scene->spheres; i++) {
        float *q = rest + 4 * (size_t)i;
        q[3] = 0.5f * spacing * (0.6f + 0.4f * bench_random(&state)) * (scene->clustered ? 0.6f : 1.0f);
        const float *c = scene->clustered ? cluster[(int)(bench_random(&state) * CLUSTERS)] : NULL;
        for (int a = 0; a < 3; a++)
            q[a] = c ? c[a] + c[3] * bell(&state) : (bench_random(&state) * 2 - 1) * half[a];
        phase[i] = 6.28f * bench_random(&state);
    }
}

static void move(float *now, const float *rest, const float *phase, uint32_t count, float reach, uint32_t frame)
{
    for (uint32_t i = 0; i < count; i++) {
        const float *q = rest + 4 * (size_t)i, p = phase[i] + 0.35f * (float)frame;
        float *d = now + 4 * (size_t)i;
        d[0] = q[0] + reach * sinf(p);
        d[1] = q[1] + reach * cosf(p * 1.3f);
        d[2] = q[2] + reach * sinf(p * 0.7f + 1);
        d[3] = q[3];
    }
}

/* Closes a file; where anything failed, error has the text, and no half file stays. writer may be NULL. */
static int finish(frames_writer *writer, const char *path, int failed, char error[PROGRAM_ERROR_SIZE])
{
    char ignored[PROGRAM_ERROR_SIZE];
    const int open = writer != NULL;
    if (frames_writer_close(writer, failed ? ignored : error, PROGRAM_ERROR_SIZE))
        failed = 1;
    if (!failed)
        return PROGRAM_OK;
    program_error("%s", error);
    if (open)
        remove(path);
    return PROGRAM_FAILED;
}

static int write_cloud(const make_settings *settings, const cloud *scene)
{
    const uint32_t count = scene->spheres;
    const float spacing = cbrtf(14.2f / (float)count);
    float *memory = calloc(count, 9 * sizeof(float));
    if (!memory) {
        program_error("out of memory for %u spheres", (unsigned)count);
        return PROGRAM_FAILED;
    }
    float *rest = memory, *now = rest + 4 * (size_t)count, *phase = now + 4 * (size_t)count;
    char error[PROGRAM_ERROR_SIZE] = "";
    frames_writer *writer = frames_writer_open(settings->path, error, sizeof error);
    int failed = !writer;
    place(rest, phase, scene, spacing);
    for (uint32_t frame = 0; !failed && frame < settings->frames; frame++) {
        move(now, rest, phase, count, 0.3f * spacing, frame);
        failed = frames_writer_add(writer, now, count, error, sizeof error) != 0;
    }
    free(memory);
    return finish(writer, settings->path, failed, error);
}

/* ---- Blobs --------------------------------------------------------------------------------------------------- */

typedef struct mesh {
    uint32_t points, triangles;
    float *rest, *now, *phase; /* x y z each; one phase a point */
    uint32_t *index;           /* three points a triangle */
} mesh;

/* The points of one ball, parallel by parallel from the pole at +y. */
static void add_points(mesh *m, const blobs *scene, const float centre[3])
{
    for (uint32_t j = 0; j <= scene->parallels; j++)
        for (uint32_t i = 0; i < scene->meridians; i++) {
            const float theta = 3.14159265f * (float)j / (float)scene->parallels;
            const float phi = 6.2831853f * (float)i / (float)scene->meridians;
            const float bumps =
                1 + 0.08f * sinf(5 * phi) * sinf(4 * theta) + 0.03f * sinf(17 * phi + 3) * sinf(13 * theta);
            const float r = scene->radius * bumps;
            float *q = m->rest + 3 * (size_t)m->points;
            q[0] = centre[0] + r * sinf(theta) * cosf(phi);
            q[1] = centre[1] + r * cosf(theta);
            q[2] = centre[2] + r * sinf(theta) * sinf(phi);
            m->phase[m->points++] = theta * 4;
        }
}

/* Its triangles, over the points from `first` on: two for each mesh of meridians and parallels. */
static void add_triangles(mesh *m, uint32_t meridians, uint32_t parallels, uint32_t first)
{
    for (uint32_t j = 0; j < parallels; j++)
        for (uint32_t i = 0; i < meridians; i++) {
            const uint32_t a = first + j * meridians + i;
            const uint32_t b = first + j * meridians + (i + 1) % meridians;
            const uint32_t c = a + meridians, d = b + meridians;
            uint32_t *q = m->index + 3 * (size_t)m->triangles;
            memcpy(q, (const uint32_t[]){a, c, b, b, c, d}, 6 * sizeof *q);
            m->triangles += 2;
        }
}

/* A bowl below the balls, which rises towards its rim. */
static void add_bowl(mesh *m, const blobs *scene)
{
    const uint32_t first = m->points;
    for (uint32_t j = 0; j <= BOWL_PARALLELS; j++)
        for (uint32_t i = 0; i < BOWL_MERIDIANS; i++) {
            const float share = (float)j / (float)BOWL_PARALLELS;
            const float phi = 6.2831853f * (float)i / (float)BOWL_MERIDIANS;
            float *q = m->rest + 3 * (size_t)m->points;
            q[0] = scene->bowl * share * cosf(phi);
            q[1] = scene->bowl * 0.3f * share * share - 1.2f * scene->radius;
            q[2] = scene->bowl * share * sinf(phi);
            m->phase[m->points++] = share * 4;
        }
    add_triangles(m, BOWL_MERIDIANS, BOWL_PARALLELS, first);
}

static void place_blobs(mesh *m, const blobs *scene)
{
    uint64_t state = bench_random_start;
    for (uint32_t k = 0; k < scene->balls; k++) {
        float centre[3];
        for (int c = 0; c < 3; c++)
            centre[c] = (bench_random(&state) * 2 - 1) * scene->spread[c];
        const uint32_t first = m->points;
        add_points(m, scene, centre);
        add_triangles(m, scene->meridians, scene->parallels, first);
    }
    if (scene->bowl > 0.0f)
        add_bowl(m, scene);
}

static void move_points(const mesh *m, uint32_t frame)
{
    const float reach = 0.02f;
    for (uint32_t i = 0; i < m->points; i++) {
        const float *q = m->rest + 3 * (size_t)i, p = m->phase[i] + 0.35f * (float)frame;
        float *d = m->now + 3 * (size_t)i;
        d[0] = q[0] + reach * sinf(p);
        d[1] = q[1] + reach * cosf(p * 1.3f);
        d[2] = q[2] + reach * sinf(p * 0.7f + 1);
    }
}

static int write_mesh(const make_settings *settings, const blobs *scene, mesh *m)
{
    char error[PROGRAM_ERROR_SIZE] = "";
    place_blobs(m, scene);
    frames_writer *writer = frames_writer_open_triangles(settings->path, m->index, m->triangles, error, sizeof error);
    int failed = !writer;
    for (uint32_t frame = 0; !failed && frame < settings->frames; frame++) {
        move_points(m, frame);
        failed = frames_writer_add_vertices(writer, m->now, m->points, error, sizeof error) != 0;
    }
    return finish(writer, settings->path, failed, error);
}

static int write_blobs(const make_settings *settings, const blobs *scene)
{
    const size_t bowl_points = scene->bowl > 0.0f ? (BOWL_PARALLELS + 1) * BOWL_MERIDIANS : 0;
    const size_t bowl_triangles = scene->bowl > 0.0f ? 2 * BOWL_PARALLELS * BOWL_MERIDIANS : 0;
    const size_t points = bowl_points + (size_t)scene->balls * (scene->parallels + 1) * scene->meridians;
    const size_t triangles = bowl_triangles + (size_t)scene->balls * scene->parallels * scene->meridians * 2;
    float *memory = calloc(points, 7 * sizeof(float));
    uint32_t *index = calloc(triangles, 3 * sizeof *index);
    int code = PROGRAM_FAILED;
    if (memory && index) {
        mesh m = {0, 0, memory, memory + 3 * points, memory + 6 * points, index};
        code = write_mesh(settings, scene, &m);
    } else {
        program_error("out of memory for %zu triangles", triangles);
    }
    free(index);
    free(memory);
    return code;
}

/* ---- Command ------------------------------------------------------------------------------------------------- */

int bench_make(int argc, char **argv)
{
    static const struct argp parser = {.options = options,
                                       .parser = parse,
                                       .args_doc = "SCENE FILE.frames",
                                       .doc = "Writes a procedural scene of moving spheres or triangles. SCENE: " SCENES
                                              "."};
    make_settings settings = {NULL, NULL, 6};
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    for (size_t i = 0; i < sizeof clouds / sizeof clouds[0]; i++)
        if (!strcmp(settings.scene, clouds[i].name))
            return write_cloud(&settings, &clouds[i]);
    for (size_t i = 0; i < sizeof all_blobs / sizeof all_blobs[0]; i++)
        if (!strcmp(settings.scene, all_blobs[i].name))
            return write_blobs(&settings, &all_blobs[i]);
    program_error("no scene %s: " SCENES, settings.scene);
    return PROGRAM_USAGE;
}
