/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One scene that is loaded in several ways, and asked by all calls: what the loops of judge_calls.c and judge_frames.c
 * share. */
#ifndef JUDGE_RUN_H
#define JUDGE_RUN_H

#include <cgt/all_hits.h>

#include "oracle/judge/judge.h"
#include "support/scenes.h"

#define JUDGE_RAYS 40u
#define JUDGE_POINTS 48u
#define JUDGE_PIXELS 512u
#define JUDGE_LIGHTS 2u
#define JUDGE_SAMPLES 3u
#define JUDGE_LIST (2 * JUDGE_PRIMITIVES)

/* A context, a structure, and a way to load arrays. */
typedef struct judge_setup {
    const char *variant;
    uint32_t threads, number; /* of the scene's setups */
    const test_way *way;
    cgt_context *context;
    cgt_scene *scene;
    char name[96];
    void *block[32]; /* the arrays, each of its own size */
    uint32_t blocks;
} judge_setup;

/* Loads a scene. The random numbers choose, and are used up. */
void judge_setup_make(judge_setup *setup, const judge_scene *s, test_random *r);
void judge_setup_free(judge_setup *setup);
void judge_contexts_free(void);

/* All hits, or crossings, of the rays: what is right, and what the first setup has answered. */
typedef struct judge_lists {
    judge_truth right[JUDGE_RAYS];
    uint32_t count[JUDGE_RAYS], first_count[JUDGE_RAYS];
    cgt_hit hit[JUDGE_RAYS][JUDGE_LIST], first[JUDGE_RAYS][JUDGE_LIST];
} judge_lists;

typedef struct judge_counts {
    uint64_t rays;     /* whose right answer was found by whole numbers: pixels, shadows, points and all */
    uint64_t answers;  /* of the library, that were compared with it */
    uint64_t doubtful; /* rays with a hit that is in doubt */
    uint64_t hits, crossings, inside, pixels, shadows, occluded, values;
    uint64_t calls, scenes, bad, bad_scenes;
} judge_counts;

typedef struct judge_run {
    judge_scene scene;
    judge_setup setup;
    judge_pool pool;
    judge_ray ray[JUDGE_RAYS];
    judge_lists hits, crossings;
    float point[JUDGE_POINTS][3];
    uint32_t point_mask[JUDGE_POINTS];
    uint8_t inside[2][JUDGE_POINTS], first_inside[2][JUDGE_POINTS];
    struct judge_view *view;
    judge_counts counts;
    uint32_t scene_bad; /* answers of this scene that are wrong */
} judge_run;

/* Prints what is wrong, and how to see it again. ray: NULL if there is none. */
__attribute__((format(printf, 4, 5))) void judge_fail(judge_run *run, const judge_ray *ray, const char *call,
                                                      const char *format, ...);

/* Whether a call succeeded; a failure is wrong. */
bool judge_succeeds(judge_run *run, cgt_result result, const char *call);

/* Counts the doubts of a truth that was just found. */
void judge_count(judge_run *run, const judge_truth *truth);

/* ---- between judge_calls.c and judge_lists.c ---- */

bool judge_has_crossings(const judge_run *run);
cgt_rays judge_ray_array(const judge_ray *rays, uint32_t count);
cgt_rays judge_asked_rays(const judge_run *run);

/* A ray alone. False where that is another one: a t_max of 0 stands for infinity. */
bool judge_single(const judge_ray *ray, cgt_single_ray *single);

void judge_all_hits_ask(judge_run *run);
void judge_crossings_ask(judge_run *run);

/* ---- all calls ---- */

/* Makes rays and points with their truths, before the first setup; asks a setup. */
void judge_rays_begin(judge_run *run);
void judge_rays_ask(judge_run *run);

/* The same for a camera, lights and ambient occlusion. */
void judge_frames_begin(judge_run *run);
void judge_frames_ask(judge_run *run);
struct judge_view *judge_view_make(void);

#endif
