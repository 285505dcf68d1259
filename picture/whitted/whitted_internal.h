/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the parts of Whitted's tracing share: rays, hits, memory. See whitted.h. */
#ifndef WHITTED_INTERNAL_H
#define WHITTED_INTERNAL_H

#include <stdbool.h>

#include <cgt/bounces.h>

#include "whitted/whitted.h"

/* A body of glass: a sphere of a geometry, or a closed mesh. */
typedef struct whitted_body {
    uint32_t geometry, number;
    uint32_t primitive; /* of it, whose material it has: of a mesh, where the ray entered */
} whitted_body;

/* Where a ray starts: whether it runs outside or inside of the primitive that it leaves. The camera leaves none. */
typedef enum whitted_side { WHITTED_CAMERA = 0, WHITTED_OUTSIDE, WHITTED_INSIDE } whitted_side;

typedef struct whitted_ray {
    double from[3];       /* the place that it leaves, org is a float next to it */
    float org[3], dir[3]; /* dir: of unit length but for rounding; the camera's of any */
    float t_min, t_max;
    uint32_t skip_primitive, skip_geometry; /* the one that it leaves; CGT_INVALID_ID: none */
    uint32_t mask;                          /* of geometries; 0: all */
    float weight[3];                        /* share of its light that reaches the pixel */
    float reach;                            /* the place that it leaves is nearer to org than this: units of dir */
    uint32_t pixel;
    whitted_side side;
    uint8_t nested;
    whitted_body inside[WHITTED_NESTED]; /* `nested` bodies in the order in which it entered them */
} whitted_ray;

typedef struct whitted_hit {
    float t;
    uint32_t primitive, geometry;
} whitted_hit;

/* A ray that goes on from a surface; t_max below 0: there is none. */
typedef struct whitted_leaving {
    float org[3], dir[3];
    float t_max, share;
} whitted_leaving;

/* What a ray has hit: first what the library is told, then what it finds. */
typedef struct whitted_surface {
    whitted_body body;
    const cgt_material *material;
    float inside, outside; /* indices of refraction; inside 0: opaque */
    uint32_t front;        /* it was hit from outside */
    double position[3];
    double normal[3]; /* outward, of unit length; 0: there is no surface */
    double length;    /* of the way from the ray's start: world units, 0 or more */
    float start[3];   /* a float next to position */
    whitted_leaving reflected, refracted;
} whitted_surface;

/* A place that lights may reach. */
typedef struct whitted_lit {
    double from[3];               /* position is a float next to it */
    float position[3], normal[3]; /* towards the viewer's side */
    float eye[3];                 /* unit vector from it to where the ray came from */
    float matte[3];               /* weight times albedo */
    float shine[3];               /* weight of highlights */
    float gloss;
    float reach;        /* world units */
    float t_min, t_max; /* of the ray to a light */
    uint32_t mask;
    uint32_t pixel, primitive, geometry;
    whitted_side side;
    uint8_t nested;
    whitted_body inside[WHITTED_NESTED];
} whitted_lit;

struct whitted_memory {
    uint32_t levels;
    whitted_memory *next;                      /* of a list of idle ones */
    whitted_ray *ray[WHITTED_MAX_BOUNCES + 1]; /* of each bounce: twice WHITTED_WAVE */
    whitted_hit hit[WHITTED_WAVE];
    whitted_surface surface[WHITTED_WAVE];
    whitted_ray again[WHITTED_WAVE]; /* rays that passed a ghost */
    whitted_hit again_hit[WHITTED_WAVE];
    uint32_t again_index[WHITTED_WAVE];
    whitted_lit lit[WHITTED_WAVE];
    whitted_ray contact[WHITTED_WAVE]; /* short rays to a light */
    whitted_hit contact_hit[WHITTED_WAVE];
    uint32_t contact_of[WHITTED_WAVE];
    uint8_t occluded[WHITTED_WAVE], dimmed[WHITTED_WAVE];
    /* of a tile */
    float org[WHITTED_WAVE][3], dir[WHITTED_WAVE][3];
    uint32_t pixel[WHITTED_WAVE];
};

/* Adds to a count, where there are any. */
#define WHITTED_COUNT(w, field, n)                                                                                     \
    do {                                                                                                               \
        if ((w)->counts)                                                                                               \
            atomic_fetch_add_explicit(&(w)->counts->field, (n), memory_order_relaxed);                                 \
    } while (0)

/* The material of a primitive. */
const cgt_material *cgt_whitted_material_of(const whitted *w, uint32_t geometry, uint32_t primitive);

/* Of the bodies of a list the one that fills the place: see whitted.h. without: the place in the list of one that does
 * not count; -1: all do. NULL: none. */
const whitted_body *cgt_whitted_medium(const whitted *w, const whitted_body *inside, int nested, int without);

/* Finds the surfaces of `count` hits, and the rays that go on from there. */
cgt_result cgt_whitted_surfaces(const whitted *w, const whitted_ray *ray, whitted_hit *hit, uint32_t count,
                                whitted_surface *surface);

/* A bound of how far the float nearest to a place can be from it, and how far behind its start a ray that leaves the
 * place looks for surfaces: world units. */
float cgt_whitted_reach(const double position[3]);

/* Whether the ray has the body in its list, and where. */
int cgt_whitted_find(const whitted_ray *ray, whitted_body body);

/* The nearest hits that are no ghosts, and their surfaces; changes t_min of rays that passed some. */
cgt_result cgt_whitted_nearest(const whitted *w, whitted_memory *memory, whitted_ray *ray, uint32_t count,
                               whitted_hit *hit, whitted_surface *surface);

/* Rays of the camera whose hits are known: memory->org, dir, pixel and hit are set. light[pixel] gets their light. */
cgt_result cgt_whitted_shade(const whitted *w, whitted_memory *memory, uint32_t count, float (*light)[3]);

/* Adds what the lights bring to memory->lit. */
cgt_result cgt_whitted_light_up(const whitted *w, whitted_memory *memory, uint32_t count, float (*light)[3]);

#endif
