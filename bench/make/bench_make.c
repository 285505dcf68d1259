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
#include <cgt/trajectory.h>

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

static int has_ending(const char *path)
{
    const size_t length = strlen(path);
    return length > 7 && !strcmp(path + length - 7, ".frames");
}

/* Writes the frames to a file. Returns 0, or -1 with a text. */
static int write_frames(const char *name, uint32_t frames, bench_procedural *scene, char error[PROGRAM_ERROR_SIZE])
{
    cgt_trajectory_writer *writer;
    cgt_result result = scene->index
                            ? cgt_trajectory_writer_open_triangles(name, NULL, scene->index, scene->triangles, &writer)
                            : cgt_trajectory_writer_open(name, NULL, &writer);
    for (uint32_t frame = 0; result == CGT_OK && frame < frames; frame++) {
        bench_procedural_move(scene, frame);
        result = scene->index ? cgt_trajectory_writer_add_vertices(writer, scene->now, scene->count)
                              : cgt_trajectory_writer_add(writer, scene->now, scene->count);
    }
    if (result == CGT_OK)
        result = cgt_trajectory_writer_finish(writer);
    if (result != CGT_OK)
        cgt_trajectory_writer_get_error_message(writer, error, PROGRAM_ERROR_SIZE);
    cgt_trajectory_writer_close(writer);
    return result == CGT_OK ? 0 : -1;
}

/* Writes the file of a scene, whole or not at all, and frees the scene's memory. */
static int write_scene(const bench_settings *settings, bench_procedural *scene)
{
    char error[PROGRAM_ERROR_SIZE] = "", ignored[PROGRAM_ERROR_SIZE];
    out_file file;
    const char *name = out_file_begin(&file, settings->paths[1], error, sizeof error);
    int failed = !name || write_frames(name, (uint32_t)settings->frames, scene, error);
    if (name && out_file_end(&file, !failed, failed ? ignored : error, PROGRAM_ERROR_SIZE))
        failed = 1;
    bench_procedural_release(scene);
    if (failed)
        program_error("%s", error);
    return failed ? PROGRAM_FAILED : PROGRAM_OK;
}

/* Makes the scene of a name: 0, 1 where there is none, or -1 where memory is refused. */
static int make_scene(const char *name, bench_procedural *scene)
{
    for (size_t i = 0; i < sizeof clouds / sizeof clouds[0]; i++)
        if (!strcmp(name, clouds[i].name))
            return bench_procedural_cloud(scene, clouds[i].spheres, clouds[i].clustered);
    for (size_t i = 0; i < sizeof all_blobs / sizeof all_blobs[0]; i++)
        if (!strcmp(name, all_blobs[i].name))
            return bench_procedural_balls(scene, &all_blobs[i].balls);
    return 1;
}

int bench_make(const bench_settings *settings)
{
    const char *name = settings->paths[0], *path = settings->paths[1];
    bench_procedural scene;
    if (!has_ending(path)) {
        program_error("'%s': the file's name must end in .frames", path);
        return PROGRAM_USAGE;
    }
    const int failed = make_scene(name, &scene);
    if (failed > 0)
        program_error("no scene %s: cgt-bench make --help lists them", name);
    else if (failed)
        program_error("out of memory for %s", name);
    return failed > 0 ? PROGRAM_USAGE : failed ? PROGRAM_FAILED : write_scene(settings, &scene);
}
