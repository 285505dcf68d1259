/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The truth about rays, spheres, triangles and capsules: hit or miss and the order of hits are decided exactly on the
 * float input, in integers of any width; t, u, v and the normal are computed from those in binary128. It shares nothing
 * with the library: neither formulas nor arithmetic nor structures. */
#ifndef ORACLE_H
#define ORACLE_H

#include <stdbool.h>
#include <stdint.h>

#include "support/oracle/truth.h"

#define ORACLE_NONE UINT32_MAX

typedef enum oracle_kind { ORACLE_SPHERE, ORACLE_TRIANGLE, ORACLE_CAPSULE } oracle_kind;

typedef struct oracle_primitive {
    oracle_kind kind;
    uint32_t geometry, primitive; /* ids, for ties and for verdicts */
    float data[9];                /* x, y, z, r; three vertices; or two points and r */
} oracle_primitive;

/* How many of its floats count. */
static inline int oracle_floats(oracle_kind kind) { return kind == ORACLE_SPHERE ? 4 : kind == ORACLE_CAPSULE ? 7 : 9; }

/* The primitives may be the caller's own array. Results are right without bounds too, but large scenes take ten times
 * as long. */
typedef struct oracle_scene {
    const oracle_primitive *primitive;
    uint32_t count;
    const struct oracle_bounds *bounds; /* of the primitives, by the functions below; or NULL */
} oracle_scene;

/* ---- Scenes of their own memory: start with {0}, add geometries, end with oracle_scene_free ---- */

/* Invalid input or lack of memory ends the program with a message: a test cannot continue. */
void oracle_scene_add_spheres(oracle_scene *scene, uint32_t geometry, const float (*sphere)[4], uint32_t count);

/* index: NULL for 3i, 3i + 1, 3i + 2 */
void oracle_scene_add_triangles(oracle_scene *scene, uint32_t geometry, const float (*vertex)[3], uint32_t vertex_count,
                                const uint32_t (*index)[3], uint32_t count);

void oracle_scene_add_capsules(oracle_scene *scene, uint32_t geometry, const float (*capsule)[7], uint32_t count);

void oracle_scene_free(oracle_scene *scene);

/* ---- Hits ---- */

typedef struct oracle_hit {
    uint32_t index;       /* in the scene; ORACLE_NONE: no hit */
    bool far;             /* the second root of a sphere or capsule */
    truth_real t;         /* to within a few units in the last place of truth_real, like u, v and a triangle's normal */
    truth_real uv[2];     /* 0 on spheres; of a capsule along its axis, and 0 */
    truth_real normal[3]; /* of unit length; opposite to the ray for a point, which has none */
} oracle_hit;

/* The closest hit by the contract of cgt.h, by brute force over the scene. Primitives that are not finite, spheres of
 * negative radius and triangles without area take no part. A ray that is not finite or has no direction hits
 * nothing. */
oracle_hit oracle_trace(const oracle_scene *scene, const truth_ray *ray);

/* The same for one primitive; false where it is not hit in the ray's range. The hit's index is 0. */
bool oracle_hits(const oracle_primitive *primitive, const truth_ray *ray, oracle_hit *hit);

/* The verdict on an answer. */
typedef enum oracle_verdict {
    ORACLE_RIGHT = 0,
    ORACLE_MISSED,   /* there is a hit, and none was given */
    ORACLE_INVENTED, /* a hit was given, and there is none */
    ORACLE_WRONG     /* another primitive is closer, or wins the tie */
} oracle_verdict;

/* Judges the primitive that an answer names (geometry ORACLE_NONE: no hit). Where t lies within 2^-6 ulp of the point
 * where the end of the range rounds, hit and miss are both right; nothing else is in doubt. *truth: the exact hit;
 * where such a doubt makes another answer right, that answer's hit. */
oracle_verdict oracle_judge(const oracle_scene *scene, const truth_ray *ray, uint32_t geometry, uint32_t primitive,
                            oracle_hit *truth);

/* Judges an answer and its t, which must be within 0.51 ulp. Returns NULL, or a description of the error. */
const char *oracle_check(const oracle_scene *scene, const truth_ray *ray, uint32_t geometry, uint32_t primitive,
                         float t);

/* Distance of a float from an exact value in ulp of the exact value rounded to float (denormals: 2^-149); infinity
 * where the float is not finite. */
double oracle_ulp(truth_real exact, float got);

/* Angle in radians between an exact normal and a given one; infinity if the given one is no direction. */
double oracle_angle(const truth_real exact[3], const float got[3]);

#endif
