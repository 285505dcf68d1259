/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes for the tests of Whitted's tracing: some spheres and some boxes, with a material each. */
#ifndef WHITTED_SCENES_H
#define WHITTED_SCENES_H

#include "support/test.h"
#include "whitted/whitted_internal.h"

enum { WHITTED_SPHERES = 0, WHITTED_BOXES = 1, WHITTED_MOST = 256 };

typedef struct whitted_scene {
    cgt_context *context;
    cgt_scene *scene;
    uint32_t spheres, boxes;
    float sphere[WHITTED_MOST][4];
    uint8_t sphere_material[WHITTED_MOST];
    float corner[WHITTED_MOST * 8][3];
    uint32_t index[WHITTED_MOST * 12][3];
    uint32_t body[WHITTED_MOST * 12];
    uint8_t box_material[WHITTED_MOST * 12];
    cgt_spheres as_spheres;
    cgt_triangles as_triangles;
    whitted_geometry geometry[2];
    whitted w;
} whitted_scene;

/* Begins an empty scene; w has no lights, no sky, 8 bounces. material stays the caller's. */
void whitted_scene_begin(whitted_scene *s, const cgt_material *material, uint32_t materials);
void whitted_scene_add_sphere(whitted_scene *s, float x, float y, float z, float radius, uint8_t material);
/* A box, of any eight corners: bit a of a corner's number tells its side along axis a. inward: its normals. */
void whitted_scene_add_box(whitted_scene *s, const float corner[8][3], bool inward, uint8_t material);
void whitted_scene_add_cube(whitted_scene *s, const float low[3], const float high[3], bool inward, uint8_t material);
/* Commits it, by one thread and the widest variant, or the one named. */
void whitted_scene_commit(whitted_scene *s, const char *variant, uint32_t threads);
void whitted_scene_end(whitted_scene *s);

/* Traces rays; more than a wave of them, too. */
void whitted_scene_trace(const whitted_scene *s, uint32_t count, const float (*org)[3], const float (*dir)[3],
                         float (*light)[3]);

#endif
