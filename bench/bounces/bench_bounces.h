/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench bounces: the waves of Whitted's tracing, by structure and order, beside Embree.
 *   command line, loops, rows                bench_bounces.c
 *   the waves, recorded while they are made  bounces_waves.c
 *   orders of the rays of a wave             bounces_order.c
 *   the library's structures                 bounces_library.c
 *   Embree, where it is installed            bounces_embree.c */
#ifndef BENCH_BOUNCES_H
#define BENCH_BOUNCES_H

#include "common/bench.h"
#include "common/bench_input.h"
#include "common/bench_embree.h"
#include "common/bench_threads.h"

enum {
    BOUNCES = 4,                 /* that are measured, 1 to 4; the camera's rays are measured elsewhere */
    BOUNCES_MOST_RAYS = 1 << 20, /* of a wave; what comes later is counted and left out */
    BOUNCES_CALL = 4096          /* rays that programs/whitted traces in a call */
};

/* ---- waves ---- */

typedef struct bounces_ray {
    float org[3], dir[3], t_min, t_max;
    float offset;  /* Embree's t_min: it has no primitive to ignore */
    uint32_t skip; /* the primitive that the ray leaves; CGT_INVALID_ID: none */
} bounces_ray;

typedef struct bounces_wave {
    bounces_ray *ray; /* BOUNCES_MOST_RAYS; NULL before the first */
    uint64_t count, left_out;
} bounces_wave;

typedef struct bounces_waves {
    bounces_wave bounce[BOUNCES + 1]; /* 0 stays empty */
    int failed;                       /* memory was refused */
} bounces_waves;

enum { BOUNCES_MIRROR, BOUNCES_GLASS, BOUNCES_MATERIALS };
extern const char *const bounces_material_names[BOUNCES_MATERIALS];

/* Traces a frame of the input's moving primitives, all of one material, and keeps the rays of each bounce. */
cgt_result bounces_waves_make(bounces_waves *waves, const bench_input *input, uint32_t count, int material,
                              const bench_settings *settings);
void bounces_waves_release(bounces_waves *waves);

/* ---- orders ---- */

typedef enum bounces_order {
    BOUNCES_WAVES,         /* as made, in calls of BOUNCES_CALL rays: as programs/whitted traces them */
    BOUNCES_MADE,          /* as made, in one call */
    BOUNCES_OCTANT,        /* within each call of BOUNCES_CALL by the octant of the direction */
    BOUNCES_WAVE_MORTON,   /* within each call by octant, then by Morton code of the origin */
    BOUNCES_ORIGIN,        /* by Morton code of the origin, then by octant, in one call */
    BOUNCES_OCTANT_MORTON, /* by octant, then by Morton code of the origin, in one call */
    BOUNCES_ORDERS
} bounces_order;
extern const char *const bounces_order_names[BOUNCES_ORDERS];

/* Rays in the arrays that both programs read, and room for what they find. */
typedef struct bounces_rays {
    uint64_t count;
    float *org[3], *dir[3], *t_min, *t_max, *offset;
    uint32_t *skip;
    float *t;
    uint32_t *primitive;
    uint8_t *hit;
    double ms; /* what ordering them took, one thread */
    void *memory;
} bounces_rays;

/* 0, or -1 where memory is refused. */
int bounces_rays_make(const bounces_wave *wave, bounces_order order, bounces_rays *rays);
void bounces_rays_release(bounces_rays *rays);

/* ---- the library ---- */

enum { BOUNCES_STRUCTURES = 4 };
extern const char *const bounces_structure_names[BOUNCES_STRUCTURES];

typedef struct bounces_structure {
    bench_scene scene;
    int is_built;
    double build_ms; /* median of a few commits */
} bounces_structure;

/* Leaves is_built 0, without an error, where the library has no such structure. */
cgt_result bounces_structure_build(bounces_structure *structure, int which, cgt_context *context,
                                   const bench_input *input, uint32_t count, uint32_t rounds);
cgt_result bounces_structure_trace(const bounces_structure *structure, const bounces_rays *rays, uint64_t call,
                                   double *ms);

/* ---- Embree ---- */

enum { BOUNCES_MOST_WAYS = 12 };

/* Ways to trace: single rays and packets, spheres as its own type and as user geometry. */
int bounces_embree_ways(const embree_scenes *embree);
const char *bounces_embree_way(const embree_scenes *embree, int way);
double bounces_embree_build_ms(const embree_scenes *embree, int way);
double bounces_embree_trace(const embree_scenes *embree, int way, const bounces_rays *rays);

#endif
