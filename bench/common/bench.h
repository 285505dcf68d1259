/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench measures subjects by ways: a way is a structure of the library with its settings, or a setting of Embree.
 *
 *   common/    settings and the table of options, files, tables, the clock
 *   ways/      ways, and what traces by them: the library, and Embree where it is installed
 *   rays/      the rays of a frame's hits, planes and pictures
 *   frame/     a frame as a renderer spends it
 *   sets/      sets of rays or points, traced by all ways in turns: the subjects rays, light and bounces
 *   cliffs/, accuracy/, cell/, make/   the other subjects */
#ifndef BENCH_H
#define BENCH_H

#include <stddef.h>
#include <stdint.h>

#include <cgt/research.h>

#include "common/program.h"

#define BENCH_MOST_PIXELS ((uint64_t)1 << 28)
#define BENCH_MOST_AO_RAYS 1024u
#define BENCH_NAME_SIZE 160

enum {
    BENCH_MOST_FILES = 32,
    BENCH_MOST_VARIANTS = 16,
    BENCH_MOST_NAMED = 16, /* ways on the command line */
    BENCH_MOST_KINDS = 16,
    BENCH_MOST_ORDERS = 8,
    BENCH_MOST_BATCHES = 32,
    BENCH_MOST_COUNTS = 8,
    BENCH_MOST_CALLS = 8
};

/* Subjects are bits, so that an option can belong to several. */
typedef enum bench_subject {
    BENCH_ACCURACY = 1,
    BENCH_BOUNCES = 2,
    BENCH_CELL = 4,
    BENCH_CLIFFS = 8,
    BENCH_FRAME = 16,
    BENCH_LIGHT = 32,
    BENCH_MAKE = 64,
    BENCH_RAYS = 128
} bench_subject;

/* The settings of a trace, and of the structure that it goes through. Zero and NULL are the library's choices. */
typedef struct bench_choice {
    const char *variant;
    uint32_t packet;
    cgt_tile_shape tile;
    cgt_loop loop;
    cgt_cull cull;
    cgt_mailbox mailbox;
    cgt_precision precision;
    int precision_named; /* 1: the configuration's name has the default precision, too */
    cgt_triangle_test test;
    cgt_kd_traversal kd_traversal;
    cgt_kd_layout kd_layout;
    uint32_t kd_break;      /* of MIXED */
    uint32_t resolution[3]; /* of a queue grid */
} bench_choice;

/* All options. */
typedef struct bench_settings {
    bench_subject subject;
    const char *paths[BENCH_MOST_FILES];
    size_t files, least_files, most_files;
    cgt_camera camera;
    uint32_t width, height;
    uint64_t frames; /* read of a file; 0: all */
    float radius;    /* for files without one; 0: the reader's default */
    int wrapped;
    uint32_t threads, repeat;
    int verbose;
    const char *json_path; /* NULL: none */
    bench_choice choice;
    int way[BENCH_MOST_NAMED]; /* numbers of bench_way_names */
    size_t ways;               /* 0: the subject's own */
    int no_embree;
    uint32_t embree_packet; /* rays; 0: the widest packets that Embree has vectors for */
    const char *embree_isa;
    int embree_robust;

    /* secondary rays */
    int lit; /* 1: the light was given */
    float light[3];
    uint32_t ao; /* ambient-occlusion rays from every hit */

    /* frame */
    int nearest, shade, orthographic, all;
    const char *output;

    /* rays, light, bounces; 1: named; none: the default */
    int kind[BENCH_MOST_KINDS], order[BENCH_MOST_ORDERS], query[3];
    uint64_t batch[BENCH_MOST_BATCHES]; /* rays in a call, ascending; UINT64_MAX: all of the set */
    size_t batches;
    uint32_t rays, random; /* of a set, at most; random rays. accuracy: of each case */
    int traversals, layouts;

    /* cliffs */
    uint32_t count[BENCH_MOST_COUNTS], counts; /* primitives */
    int call[BENCH_MOST_CALLS];
    const char *text; /* scenes or cases whose names contain it; NULL: all */
    uint32_t limit_ms, steps, worst;
    int list;

    /* accuracy */
    int part[3];
    uint64_t seed;
    int seeded;

    /* cell */
    uint64_t cycles;
    int cell_frames, cell_kd, profile;
    const char *bih_path, *section;
    uint32_t spheres;
} bench_settings;

/* Parses the options of a subject; ends the program on errors, as options_parse does. program: "cgt-bench NAME". */
void bench_parse(bench_settings *settings, bench_subject subject, const char *program, int argc, char **argv);

/* Which of a subject's kinds, orders, calls or parts are chosen: those that are named, or all. */
int bench_is_chosen(const int *chosen, int count, int which);

/* Names of values, ended by NULL; number 0 of an enum of the library is "auto". */
extern const char *const bench_rays_kinds[], *const bench_rays_orders[], *const bench_queries[];
extern const char *const bench_light_places[], *const bench_light_orders[];
extern const char *const bench_materials[], *const bench_wave_orders[];
extern const char *const bench_structures[], *const bench_loops[], *const bench_tiles_names[],
                                                                       *const bench_precisions[];
extern const char *const bench_triangle_tests[], *const bench_culls[];
extern const char *const bench_kd_traversals[], *const bench_kd_layouts[];

/* A file's name without its folder and its ending. */
void bench_file_name(const char *path, char name[BENCH_NAME_SIZE]);

/* The subjects: they return an exit code. */
int bench_accuracy(const bench_settings *settings);
int bench_bounces(const bench_settings *settings);
int bench_cell(const bench_settings *settings);
int bench_cliffs(const bench_settings *settings);
int bench_frame(const bench_settings *settings);
int bench_light(const bench_settings *settings);
int bench_make(const bench_settings *settings);
int bench_rays_of_kinds(const bench_settings *settings);

#endif
