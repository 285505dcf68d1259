/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Whitted's tracing (T. Whitted, "An Improved Illumination Model for Shaded Display", 1980): shadows of several lights,
 * mirrors, and glass with Fresnel's reflectance, Beer's law and total internal reflection.
 *
 * Rays go in waves: all of a bounce of a tile together. A ray starts at a float next to the place that it leaves,
 * without an offset, and does not find the primitive that it leaves. What it hits is told by state, not by distance:
 *
 *   A ray carries the bodies of glass that it is in, in the order in which it entered them: a sphere, or a closed
 *   mesh. A hit from outside enters a body that the ray is not in, a hit from inside leaves one that it is in. Any
 *   other hit is a ghost: the rounded start lies beyond a surface that the ray has passed already. Ghosts are passed.
 *   Since the start may as well lie beyond a surface that the ray has not passed, the search begins `reach` behind it:
 *   a bound of that rounding; of surfaces that near, those behind the place itself, which is known in double, are
 *   ghosts, too. Gaps between surfaces and bodies between them may so be as thin as the distance of two floats.
 *   A ray inside the sphere that it left or entered meets that sphere again at its far root, computed in double.
 *
 *   Overlapping bodies: the medium of a place is that of the body of the highest priority of those that the ray is in
 *   (C. Schmidt, B. Budge, "Simple Nested Dielectrics in Ray Traced Images", 2002); of equal ones, the one entered
 *   last. A ray that enters or leaves another one of them crosses no boundary of media. */
#ifndef WHITTED_H
#define WHITTED_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cgt/picture.h>

enum {
    WHITTED_NESTED = 6,       /* bodies that a ray can be in; one that enters more ends there, and is counted */
    WHITTED_MAX_BOUNCES = 64, /* of a path */
    WHITTED_WAVE = 4096       /* rays that are traced at once; a tile has as many pixels */
};

/* A geometry of the scene, by its id there: spheres or triangles, of floats without an origin and radii by type. */
typedef struct whitted_geometry {
    const cgt_spheres *spheres;     /* one of the two */
    const cgt_triangles *triangles; /* of GLASS: closed bodies, normals outward; see cgt_find_bodies */
    const uint8_t *material;        /* of each primitive; NULL: all have `material_of_all` */
    uint8_t material_of_all;
    const uint32_t *body; /* triangles: the number of the closed body of each; NULL: all are one */
    bool sheet;           /* opaque triangles that are not closed: both sides are surfaces */
    /* MATTE: the albedo of a hit, in place of the material's. NULL: none */
    void (*color)(void *user, uint32_t primitive, float rgb[3]);
    void *color_user;
} whitted_geometry;

typedef struct whitted_light {
    cgt_light light;
    float color[3]; /* brightness of a matt white surface that faces it */
} whitted_light;

/* Counts of a frame; threads add to them. */
typedef struct whitted_counts {
    atomic_uint_fast64_t rays[WHITTED_MAX_BOUNCES + 1]; /* of each bounce; 0: the camera's */
    atomic_uint_fast64_t shadow_rays;
    atomic_uint_fast64_t ghosts;   /* hits that were passed */
    atomic_uint_fast64_t too_deep; /* rays that ended inside WHITTED_NESTED bodies, or at a hundred ghosts in a row */
    atomic_uint_fast64_t cut;      /* paths that ended at the limit of bounces */
    atomic_uint_fast64_t faint;    /* paths that ended since they were fainter than `faintest` */
} whitted_counts;

struct whitted_ray;
struct whitted_hit;

/* All that a frame needs; threads share it and change only the counts. */
typedef struct whitted {
    const cgt_scene *scene; /* committed */
    const whitted_geometry *geometry;
    uint32_t geometries;
    const cgt_material *material;
    uint32_t materials;
    const whitted_light *light;
    uint32_t lights;
    float ambient[3];       /* light from everywhere on matt surfaces */
    float sky[2][3];        /* what a ray that leaves the scene sees: straight up, and at or below the horizon */
    float up[3];            /* unit vector */
    uint32_t bounces;       /* at most WHITTED_MAX_BOUNCES; 0: camera rays alone */
    float rest[3];          /* light of paths that end at a limit, in place of what they would see */
    float faintest;         /* paths of which less than this share reaches the eye end; 0: none ends */
    uint32_t mask;          /* geometries that rays meet; 0: all */
    uint32_t shadow_mask;   /* geometries that cast shadows; 0: all */
    uint32_t glass_mask;    /* those that cast light shadows; 0: none */
    float glass_shadow;     /* the share of light that passes these, whatever lies in the way */
    whitted_counts *counts; /* NULL: none */
    /* Gets each ray of whitted_trace and what it met, for study; see whitted_internal.h. NULL: none */
    void (*watch)(void *user, uint32_t bounce, const struct whitted_ray *ray, const struct whitted_hit *hit);
    void *watch_user;
    bool (*stop)(
        const void *user); /* asked before each tile: other than 0 ends cgt_whitted_frame with STOPPED. NULL: none */
    const void *stop_user;
    const cgt_trace_options *trace; /* of the camera's rays of cgt_whitted_frame; NULL: the defaults */
} whitted;

/* Returns NULL, or a sentence that tells what is wrong with materials, geometries, lights or limits: an index of
 * refraction below 1, a NaN, a material that does not exist. It takes as long as it takes to read the materials. */
const char *cgt_whitted_check(const whitted *w);

/* Memory of one thread's waves, made once and used for any number of tiles. */
typedef struct whitted_memory whitted_memory;

/* 3.3 MB, and 1.4 MB for each of bounces + 1 levels: all that a thread ever holds. NULL: out of memory. */
whitted_memory *cgt_whitted_memory_create(uint32_t bounces);
void cgt_whitted_memory_free(whitted_memory *memory);

/* Rays of a camera: count is at most WHITTED_WAVE; org and dir are arrays of three floats a ray. light[i] gets the
 * light of ray i, linear. The bits depend on the arguments alone, not on threads or variant. */
cgt_result cgt_whitted_trace(const whitted *w, whitted_memory *memory, uint32_t count, const float (*org)[3],
                             const float (*dir)[3], float (*light)[3]);

/* A whole frame: width * height pixels of three floats, linear, by the threads of the scene's context. planes: what
 * else is wanted of the camera's hits, as of cgt_trace_camera; its visitor is not called. NULL: nothing. Each thread
 * that traces holds one whitted_memory during the call. Where it cannot have it, the call ends with OUT_OF_MEMORY, and
 * light is set in part. */
cgt_result cgt_whitted_frame(const whitted *w, const cgt_camera *camera, uint32_t width, uint32_t height,
                             const cgt_frame *planes, float (*light)[3]);

#endif
