/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Round shapes beside the spheres. Bonds and trails are capsules. Arrows and the edges of boxes are triangles with
 * smooth normals: a scene with capsules needs a BVH, which costs more than they do where there are few of them. */
#ifndef STICKS_H
#define STICKS_H

#include <stddef.h>
#include <stdint.h>

typedef struct sticks {
    uint32_t count;  /* of capsules */
    float *end;      /* 2 x 3 a capsule */
    float *radius;   /* of each */
    uint16_t *entry; /* of a palette, 2 a capsule: of its halves */
    size_t capacity;
    uint32_t vertices, triangles; /* of the mesh of all other shapes */
    float *position, *normal;     /* 3 a vertex */
    uint32_t *index;              /* 3 a triangle */
    uint16_t *mesh_entry;         /* of a palette, a triangle */
    size_t vertex_capacity, triangle_capacity;
    uint32_t sides; /* of a cylinder; 3 or more */
    /* The thinnest radius that is seen at a place: spread times its distance from the eye, and least. */
    double eye[3], spread, least;
    int failed; /* memory ran out, or there are more than 2^30 capsules or vertices: what was added since is missing */
} sticks;

/* Removes everything and keeps the memory and what is thinnest. */
void cgt_sticks_clear(sticks *s, uint32_t sides);
void cgt_sticks_free(sticks *s);

/* A radius at a place, or the thinnest that is seen there. */
float cgt_sticks_visible(const sticks *s, const float place[3], float radius);

/* A capsule from a to b, whose halves have an entry each; nothing where a and b are equal or not finite. */
void cgt_sticks_add(sticks *s, const float a[3], const float b[3], float radius, uint16_t entry_a, uint16_t entry_b);

/* A cylinder from a to b without its caps; nothing where a and b are equal or not finite. */
void cgt_sticks_add_cylinder(sticks *s, const float a[3], const float b[3], float radius, uint16_t entry);

/* A cone with its base around a, closed by a disc, and its tip at b. */
void cgt_sticks_add_cone(sticks *s, const float a[3], const float b[3], float radius, uint16_t entry);

/* A ball. */
void cgt_sticks_add_ball(sticks *s, const float center[3], float radius, uint16_t entry);

#endif
