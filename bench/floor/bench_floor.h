/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench floor: what the machine allows, and how close frames come to it.
 *   machine  bandwidth of memory                                       bench_floor_machine.c
 *   scatter  sorting a scene's primitives into cells                   bench_floor_scatter.c
 *   planes   the empty frame, and a scene's, by requested fields       bench_floor_planes.c
 *   tests    nanoseconds per test, primitive, resolved pixel, in L1    bench_floor_tests.c
 *   limit    the terms of a scene's limit                              bench_floor_limit.c
 *
 * The model: no frame of a scene takes less than
 *     empty     the frame of a scene that no ray hits: tiles set up, resolved and stored
 *   + read      the input's bytes once from memory
 *   + scatter   each primitive's number once into its cell
 *   + tests     the ray tests that remain where the scene holds only the visible primitives
 *   + objects   setting those primitives up, once for each tile in which they are drawn
 * all of them measured here, with the library's own code where it exists. Not part of the limit, but reported:
 *     resolve   exact t and the normal of each pixel that is hit, as the library computes them. */
#ifndef BENCH_FLOOR_H
#define BENCH_FLOOR_H

#include <stddef.h>
#include <stdint.h>

#include "common/bench.h"
#include "common/bench_table.h"
#include "rays/bench_planes.h"
#include "common/bench_threads.h"

/* The fields that a frame requests. */
typedef enum floor_fields {
    FLOOR_T,
    FLOOR_T_ID,
    FLOOR_T_ID_NORMAL, /* the fields of cgt-bench frame */
    FLOOR_T_ID_UV,
    FLOOR_EVERYTHING, /* t, id, normal, u, v */
    FLOOR_FIELDS
} floor_fields;

typedef struct floor_settings {
    bench_settings shared;
    bench_structure_settings structure;
    bench_precision_settings precision;
    uint32_t megabytes; /* of the memory that bandwidth is measured on */
    uint32_t spheres, triangles;
} floor_settings;

/* Nanoseconds in one thread; see bench_floor_tests.c. */
typedef struct floor_tests {
    double lane;      /* a ray against a primitive that is set up */
    double primitive; /* setting up and drawing a primitive, without its ray tests */
    double resolve;   /* t, id and normal of a pixel */
} floor_tests;

typedef struct floor_job {
    const floor_settings *settings;
    bench_table *table;
    cgt_context *context;
    bench_threads *threads;
    bench_choice choice;
    bench_planes planes;
    double read, write, stream;    /* bytes per nanosecond; stream: 0 where the compiler has no streaming stores */
    double empty_ms[FLOOR_FIELDS]; /* into planes */
    floor_tests tests[2];          /* of spheres, of triangles */
    char config[BENCH_NAME_SIZE];  /* of the last scene that was committed */
} floor_job;

/* A frame's times, shortest and median. */
typedef struct floor_time {
    double low, median;
} floor_time;

/* The destination of a committed scene's frames. */
typedef enum floor_target { FLOOR_PLANES, FLOOR_VISITOR, FLOOR_TARGETS } floor_target;

/* The functions below return an exit code unless they say otherwise, and print what failed. */

/* Memory bandwidth with all threads of the job. */
int floor_measure_memory(floor_job *job);

/* Nanoseconds per primitive of sorting primitives into cells of about eight. Positions are x, y, z, `width` floats
 * apart. Negative where memory is refused. */
double floor_measure_scatter(const floor_job *job, const float *position, uint32_t width, uint32_t count);

/* Times frames of a committed scene by the fields that they request, in turns; prints rows of `part`. low: NULL, or
 * gets the shortest times into planes. */
int floor_measure_fields(floor_job *job, const bench_scene *scene, const char *part, const char *name,
                         double low[FLOOR_FIELDS]);
int floor_measure_empty(floor_job *job);

/* Sets job->tests of both kinds. */
int floor_measure_tests(floor_job *job);

/* The rows of one file, or of a scene made in memory. */
int floor_measure_file(floor_job *job, const char *path);
int floor_measure_cloud(floor_job *job);
int floor_measure_mesh(floor_job *job);

/* A scene with the structure of the command line, before its first commit. */
cgt_result floor_open_scene(floor_job *job, bench_scene *scene, cgt_context *context, const float *moving,
                            const uint32_t *index, uint32_t triangles);

/* A row of the table. */
void floor_row(floor_job *job, const char *part, const char *scene, const char *item, uint32_t threads, double value,
               const char *unit);

#endif
