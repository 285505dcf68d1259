/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Procedural scenes in memory: clouds of spheres and bumpy balls of triangles, every sphere and vertex on a small
 * closed path. cgt-bench make writes them to files. The same numbers on every machine with IEEE arithmetic and the
 * same sinf. */
#ifndef BENCH_PROCEDURAL_H
#define BENCH_PROCEDURAL_H

#include <stdint.h>

typedef struct bench_procedural {
    uint32_t count;     /* spheres or vertices */
    uint32_t triangles; /* 0: spheres */
    uint32_t width;     /* floats of an element: 4, x y z r, of a sphere; 3 of a vertex */
    float *now;         /* the elements as bench_procedural_move last placed them */
    uint32_t *index;    /* three vertices of each triangle; NULL: spheres */
    float *rest, *phase;
    float reach; /* of the paths */
} bench_procedural;

/* Balls at random places within `extent` of the origin, each of meridians x parallels x 2 triangles. */
typedef struct bench_balls {
    uint32_t balls, meridians, parallels;
    float radius, extent[3];
    float bowl; /* radius of a bowl around them; 0: none */
} bench_balls;

/* The functions that make a scene return 0, or -1 where memory is refused or the size is too large; the scene stands at
 * frame 0 then. */

/* Spheres evenly distributed over a box of 3.56 x 2 x 2, their radii 0.3 to 0.5 of the mean spacing; clustered: smaller
 * ones, in 64 clusters of different sizes, dense in their middles. */
int bench_procedural_cloud(bench_procedural *scene, uint32_t spheres, int clustered);

int bench_procedural_balls(bench_procedural *scene, const bench_balls *balls);

void bench_procedural_move(bench_procedural *scene, uint32_t frame);

/* Call it after a failure as well. */
void bench_procedural_release(bench_procedural *scene);

#endif
