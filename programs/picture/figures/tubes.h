/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cylinders, cones and balls as triangles with smooth normals: bonds, edges of boxes, arrows, trails. */
#ifndef TUBES_H
#define TUBES_H

#include <stddef.h>
#include <stdint.h>

typedef struct tubes {
    uint32_t vertices, triangles;
    float *position, *normal; /* 3 a vertex */
    uint32_t *index;          /* 3 a triangle */
    uint16_t *entry;          /* of a palette, a triangle */
    size_t vertex_capacity, triangle_capacity;
    uint32_t sides; /* of a cylinder; 3 or more */
    /* The thinnest radius that is seen at a place: spread times its distance from the eye, and least. */
    double eye[3], spread, least;
    int failed; /* memory ran out, or there are more than 2^31 vertices: what was added since is missing */
} tubes;

/* Removes everything and keeps the memory and what is thinnest. */
void tubes_clear(tubes *t, uint32_t sides);
void tubes_free(tubes *t);

/* A radius at a place, or the thinnest that is seen there. */
float tubes_visible(const tubes *t, const float place[3], float radius);

/* A cylinder from a to b without its caps; nothing where a and b are equal or not finite. */
void tubes_add_cylinder(tubes *t, const float a[3], const float b[3], float radius, uint16_t entry);

/* A tube through `count` places with a radius at each, closed at both ends; nothing where there are fewer than two. All
 * are finite, and no two neighbours are equal. */
void tubes_add_path(tubes *t, const float (*place)[3], const float *radius, uint32_t count, uint16_t entry);

/* A cone with its base around a, closed by a disc, and its tip at b. */
void tubes_add_cone(tubes *t, const float a[3], const float b[3], float radius, uint16_t entry);

/* A ball. */
void tubes_add_ball(tubes *t, const float center[3], float radius, uint16_t entry);

#endif
