/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the calls of the library must answer about a scene, by whole numbers (support/oracle/oracle_line.h): all
 * surfaces along a ray in their order, crossings, what is inside. Shares nothing with the library. */
#ifndef JUDGE_H
#define JUDGE_H

#include "support/oracle/oracle.h"
#include "support/oracle/oracle_filter.h"
#include "support/random.h"

#define JUDGE_PRIMITIVES 18432u
#define JUDGE_GEOMETRIES 9u
#define JUDGE_KINDS 3

/* ---- scenes: driver/scenes makes them ---- */

typedef struct judge_geometry {
    oracle_kind kind;
    uint32_t first, count; /* of the scene's primitives */
    uint32_t mask;         /* as given: 0 is all bits */
} judge_geometry;

/* Whether it is made for a camera at the origin that sees 64x64 pixels along z, by 90 degrees or with a height of 2. */
typedef enum scene_aims { SCENE_AIMS_NOT, SCENE_AIMS_CONE, SCENE_AIMS_PARALLEL } scene_aims;

typedef struct judge_scene {
    const char *family;
    uint32_t number;
    test_random random;
    bool closed;     /* all geometries of triangles are */
    float scale;     /* about its size */
    float middle[3]; /* about where it is */
    float step;      /* of the lattice that some points are on */
    uint32_t axis;   /* most of it lies in the plane through the origin across that axis; 3: it does not */
    scene_aims aims;
    uint32_t count, geometries, of_kind[JUDGE_KINDS];
    oracle_primitive primitive[JUDGE_PRIMITIVES]; /* by geometry */
    oracle_bounds bounds[JUDGE_PRIMITIVES / ORACLE_BLOCK];
    judge_geometry geometry[JUDGE_GEOMETRIES];
    int low, high; /* coordinates are multiples of 2^low, and below 2^high */
} judge_scene;

/* Finds bounds and bits, when geometries and primitives are there. */
void judge_scene_measure(judge_scene *s);

/* Lets [low, high) hold the exponents of a number's bits. */
void judge_widen_bits(float f, int *low, int *high);

/* Not finite, or a negative radius: never hit. */
bool judge_is_broken(const oracle_primitive *p);

/* ---- rays: driver/rays makes them ---- */

typedef struct judge_ray {
    truth_ray line;
    uint32_t mask, skip_primitive, skip_geometry;
} judge_ray;

/* ---- what is right: judge_truth.c ---- */

typedef struct judge_hit {
    uint32_t index;
    bool far;        /* cgt_surface */
    bool doubtful;   /* t rounds into the range, or just not: both are right */
    bool has_values; /* of `values`, u, v and the normal, not t alone */
    oracle_hit values;
} judge_hit;

/* Hits of rays, ray by ray. Start with {0}, end with free(hit). */
typedef struct judge_pool {
    judge_hit *hit;
    uint32_t count, room;
} judge_pool;

typedef struct judge_truth {
    uint32_t first, count; /* of the pool; in order */
} judge_truth;

typedef enum judge_question {
    JUDGE_ALL,       /* all hits */
    JUDGE_CROSSINGS, /* hits that are crossings */
    JUDGE_NEAREST,   /* up to the first one that is not doubtful */
    JUDGE_SHADOW     /* one that is not doubtful, if there is one, or all that are */
} judge_question;

judge_truth judge_trace(const judge_scene *s, const judge_ray *ray, judge_question question, bool values,
                        judge_pool *pool);

/* Whether a point, moved by (h^4, h^5, h^6), is in a body that a mask sees; parity: by that rule, not by winding. */
bool judge_inside(const judge_scene *s, const float point[3], uint32_t mask, bool parity);

/* ---- answers ---- */

/* Where the next answer of a ray is in the pool, or -1 where it is wrong; moves *at behind it. far: of its surface, or
 * -1 for any; t: NaN for any. */
int64_t judge_next(const judge_scene *s, const judge_pool *pool, const judge_truth *truth, uint32_t *at,
                   uint32_t geometry, uint32_t primitive, int far, float t);

/* Whether nothing that is certain is left from `at` on. */
bool judge_is_end(const judge_pool *pool, const judge_truth *truth, uint32_t at);

/* A hit as the library gives it. */
typedef struct judge_answer {
    float t;
    uint32_t primitive, geometry;
    float normal[3], uv[2];
} judge_answer;

/* NULL, or what is wrong with the values of a hit, those that cgt_precision promises: t alone if the pool has no
 * more. */
const char *judge_values(const judge_scene *s, const judge_ray *ray, const judge_hit *right,
                         const judge_answer *answer);

/* The same of a ray's nearest hit, or none. fast: of the ids alone. */
const char *judge_nearest(const judge_scene *s, const judge_pool *pool, const judge_truth *truth, const judge_ray *ray,
                          bool fast, const judge_answer *answer);

#endif
