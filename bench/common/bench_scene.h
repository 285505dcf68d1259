/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A scene over the moving spheres or triangles of a trajectory, and how a configuration of the library is named in a
 * table. */
#ifndef BENCH_SCENE_H
#define BENCH_SCENE_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/research.h>

typedef struct bench_scene {
    cgt_context *context; /* not owned */
    cgt_scene *scene;
    const float *moving;   /* x, y, z and radius of each sphere, or x, y, z of each vertex */
    const uint32_t *index; /* three vertices of each triangle; NULL: spheres */
    uint32_t triangles;
    int has_geometry; /* made by the first commit */
    uint32_t geometry;
    uint32_t held; /* spheres or vertices that the geometry has now */
} bench_scene;

/* threads: as in cgt_context_options. variant: NULL for the widest. */
cgt_result bench_context_create(uint32_t threads, const char *variant, cgt_context **context);

/* A scene over the spheres in `moving`. resolution: 0, 0, 0 for the library's choice. */
cgt_result bench_scene_create(bench_scene *scene, cgt_context *context, const float *moving,
                              const uint32_t resolution[3]);
void bench_scene_release(bench_scene *scene);

/* Call before the first commit: `moving` holds vertices of these triangles. index NULL: it holds spheres, the default.
 * */
void bench_scene_set_triangles(bench_scene *scene, const uint32_t *index, uint32_t triangles);

/* Commits `count` spheres or vertices, after an update of the geometry where the number changed. */
cgt_result bench_scene_commit(bench_scene *scene, uint32_t count);

/* Prints what failed and the library's message; context: NULL where none was created. Returns PROGRAM_FAILED. */
int bench_scene_failed(const cgt_context *context, const char *what, cgt_result result);

/* The settings of a kd-tree and its traversal; zero is the library's choice. */
typedef struct bench_kd_choice {
    cgt_kd_traversal traversal;
    cgt_kd_layout layout;
    uint32_t break_level; /* of MIXED */
} bench_kd_choice;

/* The settings of a trace. Zero and NULL are the library's choices. */
typedef struct bench_choice {
    const char *variant;
    uint32_t packet;
    cgt_tile_shape tile;
    cgt_loop loop;
    cgt_cull cull;
    cgt_mailbox mailbox;
    cgt_precision precision;
    int precision_named; /* 1: the name contains the default precision, too */
    cgt_triangle_test test;
    const char *grid;   /* resolution in words: "16x16x16", "auto*2" */
    bench_kd_choice kd; /* named for kd-trees only */
} bench_choice;

#define BENCH_NAME_SIZE 160

/* AUTO, of a scene that has no structure: "none". */
const char *bench_structure_name(cgt_structure structure);
const char *bench_kd_traversal_name(cgt_kd_traversal traversal);
const char *bench_kd_layout_name(cgt_kd_layout layout);
const char *bench_loop_name(cgt_loop loop);
const char *bench_cull_name(cgt_cull cull);
const char *bench_tile_name(cgt_tile_shape tile);
const char *bench_precision_name(cgt_precision precision);
const char *bench_triangle_test_name(cgt_triangle_test test);

/* The value of a name, as above: 0, or -1 where there is none. */
int bench_loop_find(const char *name, cgt_loop *loop);
int bench_cull_find(const char *name, cgt_cull *cull);
int bench_tile_find(const char *name, cgt_tile_shape *tile);
int bench_precision_find(const char *name, cgt_precision *precision);
int bench_triangle_test_find(const char *name, cgt_triangle_test *test);
int bench_structure_find(const char *name, cgt_structure *structure); /* AUTO is "auto" */
int bench_kd_traversal_find(const char *name, cgt_kd_traversal *traversal);
int bench_kd_layout_find(const char *name, cgt_kd_layout *layout);

/* A file's name without its folder and its ending. */
void bench_file_name(const char *path, char name[BENCH_NAME_SIZE]);

/* The structure's name, then ",key=value" for each setting that is not the library's default, in a fixed order. */
void bench_choice_name(const bench_choice *choice, cgt_structure structure, char name[BENCH_NAME_SIZE]);

/* The counts of a trace. */
typedef struct bench_counts {
    cgt_trace_statistics trace;
    cgt_research_trace_statistics research;
} bench_counts;

/* The trace options of a choice, which point to `research`. counts: NULL where nothing is counted. */
void bench_choice_options(const bench_choice *choice, bench_counts *counts, cgt_trace_options *options,
                          cgt_research_trace_options *research);

/* Changes the scene's structure. rays: what AUTO chooses for. resolution: as in bench_scene_create. */
cgt_result bench_scene_structure(const bench_scene *scene, cgt_structure structure, cgt_ray_kind rays,
                                 const bench_kd_choice *kd, const uint32_t resolution[3]);

/* One structure over a scene. */
typedef struct bench_build {
    cgt_structure structure;
    cgt_ray_kind rays; /* what AUTO is told */
    bench_kd_choice kd;
    int left_out;               /* the library does not build it */
    cgt_scene_statistics built; /* of the last commit */
    cgt_research_scene_statistics research;
} bench_build;

/* Builds it over `count` spheres or vertices, and measures the time. If the library has no such structure, prints a
 * message that names the file, and sets left_out. */
cgt_result bench_scene_build(bench_scene *scene, bench_build *build, uint32_t count, const uint32_t resolution[3],
                             const char *path, double *ms);

#endif
