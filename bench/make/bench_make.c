/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench make: procedural scenes as .frames, so that every figure can be reproduced without a simulator.
 *   cloudN   N spheres evenly distributed over a box of 3.56 x 2 x 2, their radii 0.3 to 0.5 of the mean spacing,
 *            each on a small closed path of its own
 *   clustersN  such spheres, smaller, in 64 clusters of different sizes, dense in their middles
 *   blobsN   N triangles in one or several bumpy balls of meridians and parallels, every vertex on the path of its
 *            parallel; at the poles lie triangles without an area
 *   stadium  a ball of 20,000 triangles and radius 1 on the ground of a bowl of 2,000 triangles and radius 1,000
 * The same file on every machine with IEEE arithmetic and the same sinf. */
#include <stdio.h>
#include <string.h>

#include "common/bench.h"
#include "common/out_file.h"
#include "make/bench_procedural.h"
#include "trajectory/trajectory.h"

typedef struct make_settings {
    const char *scene, *path;
    uint32_t frames;
} make_settings;

typedef struct cloud {
    const char *name;
    uint32_t spheres;
    int clustered;
} cloud;

static const cloud clouds[] = {{"cloud2k", 2000, 0},
                               {"cloud20k", 20000, 0},
                               {"cloud200k", 200000, 0},
                               {"cloud1m", 1000000, 0},
                               {"clusters1m", 1000000, 1}};

typedef struct blobs {
    const char *name;
    bench_balls balls;
} blobs;

static const blobs all_blobs[] = {{"blobs2k", {20, 10, 5, 0.4f, {1.5f, 0.8f, 0.9f}, 0.0f}},
                                  {"blob100k", {1, 316, 158, 1.25f, {0.0f, 0.0f, 0.0f}, 0.0f}},
                                  {"blobs1m", {16, 250, 125, 0.5f, {1.4f, 0.7f, 0.8f}, 0.0f}},
                                  {"stadium", {1, 100, 100, 1.0f, {0.0f, 0.0f, 0.0f}, 1000.0f}}};

#define SCENES "cloud2k, cloud20k, cloud200k, cloud1m, clusters1m, blobs2k, blob100k, blobs1m, stadium"

static const struct argp_option options[] = {{"frames", 'n', "COUNT", 0, "frames to write (default 6)", 0},
                                             {NULL, 0, NULL, 0, NULL, 0}};

static int has_ending(const char *path)
{
    const size_t length = strlen(path);
    return length > 7 && !strcmp(path + length - 7, ".frames");
}

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
        else if (!has_ending(settings->path))
            argp_error(state, "'%s': the file's name must end in .frames", settings->path);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* Writes the frames to a file. Returns 0, or -1 with a text. */
static int write_frames(const char *name, uint32_t frames, bench_procedural *scene, char error[PROGRAM_ERROR_SIZE])
{
    char ignored[PROGRAM_ERROR_SIZE];
    frames_writer *writer =
        scene->index ? frames_writer_open_triangles(name, scene->index, scene->triangles, error, PROGRAM_ERROR_SIZE)
                     : frames_writer_open(name, error, PROGRAM_ERROR_SIZE);
    int failed = !writer;
    for (uint32_t frame = 0; !failed && frame < frames; frame++) {
        bench_procedural_move(scene, frame);
        failed = (scene->index ? frames_writer_add_vertices(writer, scene->now, scene->count, error, PROGRAM_ERROR_SIZE)
                               : frames_writer_add(writer, scene->now, scene->count, error, PROGRAM_ERROR_SIZE)) != 0;
    }
    if (frames_writer_close(writer, failed ? ignored : error, PROGRAM_ERROR_SIZE))
        failed = 1;
    return failed ? -1 : 0;
}

/* Writes the file of a scene, whole or not at all, and frees the scene's memory. */
static int write_scene(const make_settings *settings, bench_procedural *scene)
{
    char error[PROGRAM_ERROR_SIZE] = "", ignored[PROGRAM_ERROR_SIZE];
    out_file file;
    const char *name = out_file_begin(&file, settings->path, error, sizeof error);
    int failed = !name || write_frames(name, settings->frames, scene, error);
    if (name && out_file_end(&file, !failed, failed ? ignored : error, PROGRAM_ERROR_SIZE))
        failed = 1;
    bench_procedural_release(scene);
    if (failed)
        program_error("%s", error);
    return failed ? PROGRAM_FAILED : PROGRAM_OK;
}

static int out_of_memory(const make_settings *settings)
{
    program_error("out of memory for %s", settings->scene);
    return PROGRAM_FAILED;
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
    bench_procedural scene;
    if (argp_parse(&parser, argc, argv, 0, NULL, &settings))
        return PROGRAM_USAGE;
    for (size_t i = 0; i < sizeof clouds / sizeof clouds[0]; i++)
        if (!strcmp(settings.scene, clouds[i].name))
            return bench_procedural_cloud(&scene, clouds[i].spheres, clouds[i].clustered)
                       ? out_of_memory(&settings)
                       : write_scene(&settings, &scene);
    for (size_t i = 0; i < sizeof all_blobs / sizeof all_blobs[0]; i++)
        if (!strcmp(settings.scene, all_blobs[i].name))
            return bench_procedural_balls(&scene, &all_blobs[i].balls) ? out_of_memory(&settings)
                                                                       : write_scene(&settings, &scene);
    program_error("no scene %s: " SCENES, settings.scene);
    return PROGRAM_USAGE;
}
