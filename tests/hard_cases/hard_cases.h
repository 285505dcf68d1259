/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The hard cases of ray casting, by name: scenes with rays on which single precision fails, on which structures lose
 * primitives, where conventions matter. Float input, reproducible from the seed. Each is a test and a row of cgt-bench
 * accuracy.
 *
 * Two rows of the literature are tested elsewhere: splits through the origin and primitives in the splitting plane by
 * the kd-tree's tests, exits through edges and corners of a leaf by those of its ropes. */
#ifndef HARD_CASES_H
#define HARD_CASES_H

#include "hard_cases/hard_scene.h"

/* What makes a case hard. At least one ray, primitive or cell must show the trait, or the case tests nothing. */
typedef enum hard_trait {
    HARD_DOUBLE = 1,     /* single precision leaves decisions open (double_tests) */
    HARD_EXACT = 2,      /* double leaves decisions open as well (exact_tests) */
    HARD_FAST_FAILS = 4, /* with CGT_PRECISION_FAST some hits are missed, invented or wrong */
    HARD_OVERFLOW = 8,   /* voxels overflow */
    HARD_SPREAD = 16,    /* primitives are referenced by several cells */
    HARD_SKIPPED = 32,   /* primitives are skipped */
    HARD_FLAT = 64,      /* triangles without an area */
    HARD_SPLITS = 128,   /* packets split */
    HARD_INVALID = 256,  /* rays are invalid */
    HARD_MISSES = 512    /* rays aimed near primitives miss */
} hard_trait;

/* The result of the first trace for a ray. */
typedef struct hard_found {
    float t; /* infinite: a miss */
    float normal[3];
} hard_found;

typedef struct hard_case {
    const char *row;  /* the difficulty */
    const char *name; /* the case within it */
    void (*make)(hard_scene *s);
    hard_place place;
    unsigned traits; /* hard_trait values, combined */
    /* NULL, or rewrites ray i of the scene from its first hit: the case is traced twice */
    void (*follow)(hard_scene *s, uint32_t i, const hard_found *found);
} hard_case;

size_t hard_case_count(void);
const hard_case *hard_case_at(size_t i);

/* Makes a case with `rays` rays; reproducible from the seed and the case. False if memory is refused. */
bool hard_case_make(const hard_case *c, uint32_t rays, hard_scene *s);

/* Rewrites the rays of a case with `follow`, given the hits of the first trace. */
void hard_case_follow(const hard_case *c, hard_scene *s, const hard_found *found);

/* One table of cases per topic. */
typedef struct hard_table {
    const hard_case *first;
    size_t count;
} hard_table;
#define HARD_TABLE(cases)                                                                                              \
    {                                                                                                                  \
        (cases), sizeof(cases) / sizeof((cases)[0])                                                                    \
    }
extern const hard_table hard_cases_edges, hard_cases_grid, hard_cases_input, hard_cases_rays, hard_cases_spheres,
    hard_cases_triangles;

/* Transformations of the scene. */
#define HARD_HERE                                                                                                      \
    {                                                                                                                  \
        1, { 0, 0, 0 }                                                                                                 \
    }
#define HARD_TINY                                                                                                      \
    {                                                                                                                  \
        1e-6, { 0, 0, 0 }                                                                                              \
    }
#define HARD_LARGE                                                                                                     \
    {                                                                                                                  \
        1e6, { 0, 0, 0 }                                                                                               \
    }
#define HARD_2M50                                                                                                      \
    {                                                                                                                  \
        0x1p-50, { 0, 0, 0 }                                                                                           \
    }
#define HARD_2P50                                                                                                      \
    {                                                                                                                  \
        0x1p50, { 0, 0, 0 }                                                                                            \
    }
#define HARD_FAR                                                                                                       \
    {                                                                                                                  \
        2, { 148376, 1234, -223423 }                                                                                   \
    }

#endif
