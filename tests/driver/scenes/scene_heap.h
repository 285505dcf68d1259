/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Groups of families of scenes, and primitives by sort before they become a scene's geometries. */
#ifndef SCENE_HEAP_H
#define SCENE_HEAP_H

#include "driver/judge/judge.h"

typedef struct scene_heap {
    judge_scene *scene;
    test_random *r;
    uint32_t n; /* a number of primitives for the family */
    uint32_t count[JUDGE_KINDS];
    uint32_t seam; /* so many triangles are closed by themselves, and the others are; 0: not known */
    float data[JUDGE_KINDS][JUDGE_PRIMITIVES / 2][9];
} scene_heap;

/* Room for one more. */
float *scene_heap_add(scene_heap *h, oracle_kind kind);

typedef struct scene_group {
    uint32_t families;
    const char *(*name)(uint32_t family);
    void (*make)(scene_heap *h, uint32_t family);
} scene_group;

extern const scene_group hard_scenes; /* of capsules above all, and of closed bodies */
extern const scene_group kind_scenes; /* of all sorts, each spoilt in one way */
extern const scene_group cloud_scenes, soup_scenes, mesh_scenes, band_scenes;
extern const scene_group odd_scenes;      /* long, thin, huge, far apart, equal ones at any scale */
extern const scene_group view_scenes;     /* hard for tiles of frames */
extern const scene_group afar_scenes;     /* tiny ones, for rays of their own */
extern const scene_group crossing_scenes; /* closed meshes on lattices, for rays of their own */
extern const scene_group capsule_scenes;  /* a few, for rays at their seams and silhouettes */
extern const scene_group long_scenes;     /* that rays hit more often than a list holds */
extern const scene_group case_scenes;     /* the hard cases by name, for rays of their own */
extern const scene_group sheet_scenes;    /* neighbours in order: clusters */
extern const scene_group large_scenes;    /* thousands of primitives: builders use several tasks */
extern const scene_group even_scenes;     /* in which single precision decides well */
extern const scene_group flat_scenes, dense_scenes, speck_scenes; /* for rays in planes, to lamps, through points */
extern const scene_group column_scenes;                           /* for points that skip what is above them */

#define SCENE_GROUPS 4

/* A scene of one of up to SCENE_GROUPS groups: its family is the number's remainder, unless `family` says another.
 * n: most primitives of a sort, for the family. */
#define SCENE_ANY_FAMILY UINT32_MAX
void scene_make(judge_scene *s, test_random random, const scene_group *const *groups, uint32_t number, uint32_t family,
                uint32_t n);

#endif
