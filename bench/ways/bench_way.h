/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ways: structures of the library with their settings, and settings of Embree. */
#ifndef BENCH_WAY_H
#define BENCH_WAY_H

#include "common/bench.h"

/* Of the names of -S the first are the library's structures. */
enum { BENCH_MOST_WAYS = 160, BENCH_LIBRARY_NAMES = 7 };

typedef enum bench_quality { EMBREE_LOW, EMBREE_MEDIUM, EMBREE_REFIT, EMBREE_QUALITIES } bench_quality;

typedef struct bench_way {
    int embree;      /* 0: the library */
    size_t built_by; /* number of the way whose structure it traces: its own, or an earlier one's */
    /* the library's */
    cgt_structure structure;
    cgt_ray_kind rays; /* what AUTO is told */
    bench_choice choice;
    /* Embree's */
    int is_candidate; /* of those that belong to "embree" only the fastest has a row */
    bench_quality quality;
    int user; /* spheres as user geometry, not by Embree's own type */
    int robust;
    uint32_t packet; /* rays traced together; 0: a stream; BENCH_NATIVE_PACKET: as many as Embree has vectors for */
    int coherent;    /* as Embree is told */
} bench_way;

#define BENCH_NATIVE_PACKET UINT32_MAX

/* The names of -S, ended by NULL; AUTO is the first. */
const char *const *bench_way_names(void);

/* Whether Embree is there, and can be limited to an instruction set. */
int bench_embree_is_here(void);
int bench_embree_has_isa(const char *name);

/* The ways that the settings name, or their subject's own, over a file of spheres or triangles. Returns how many. */
size_t bench_ways_make(const bench_settings *settings, int triangles, bench_way ways[BENCH_MOST_WAYS]);

/* The configuration's name: the structure's, then ",key=value" for each setting that is not the library's choice, in a
 * fixed order. built: what AUTO became, or the way's structure. */
void bench_way_name(const bench_way *way, cgt_structure built, char name[BENCH_NAME_SIZE]);

#endif
