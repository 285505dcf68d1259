/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Scenes of some families, rays of some families, and calls that find hits, each judged by whole numbers. A profile
 * says which, and how hard they must have been. Each scene is loaded a few times, in another way, variant and number of
 * threads, from arrays of another form: all loads must give the same bits. */
#ifndef DRIVER_H
#define DRIVER_H

#include <cgt/all_hits.h>

#include "driver/judge/judge.h"
#include "driver/rays/lines.h"
#include "driver/scenes/scene_heap.h"
#include "support/scenes.h"

#define DRIVER_RAYS 1024u
#define DRIVER_LISTED 40u /* rays whose hits are all asked for */
#define DRIVER_POINTS 48u
#define DRIVER_LIT 4097u       /* points against a light */
#define DRIVER_PIXELS 16640u   /* of a frame: more than two tiles by two */
#define DRIVER_SMALL 512u      /* of the frames of most profiles */
#define DRIVER_JUDGED 640u     /* of the points, or of the pixels: all, */
#define DRIVER_SAMPLE 40u      /* but about as many pixels in profiles with more, */
#define DRIVER_LIT_SAMPLE 256u /* and of the points as many */
#define DRIVER_LIGHTS 2u
#define DRIVER_SAMPLES 3u
#define DRIVER_LIST 2048u /* hits of a ray, for calls that list them */

/* ---- what was asked, and how hard it was ---- */

#define DRIVER_COUNTERS(X)                                                                                             \
    X(SCENES, "scenes")                                                                                                \
    X(CALLS, "calls")                                                                                                  \
    X(JUDGED, "rays judged") /* whose right answer was found: pixels, shadows, points and all */                       \
    X(ANSWERS, "answers")    /* of the library, that were compared with it */                                          \
    X(VALUES, "values")                                                                                                \
    X(DOUBTFUL, "rays in doubt")                                                                                       \
    X(HITS, "hits")                                                                                                    \
    X(CROSSINGS, "crossings")                                                                                          \
    X(INSIDE, "points inside")                                                                                         \
    X(PIXELS, "pixels")                                                                                                \
    X(SEEN, "pixels with a hit")                                                                                       \
    X(SHADOWS, "shadow rays")                                                                                          \
    X(OCCLUDED, "occluded")                                                                                            \
    X(LIT, "points against a light")                                                                                   \
    X(LIT_OCCLUDED, "of them occluded")                                                                                \
    X(LIT_TILES, "tiles of them")                                                                                      \
    X(BOUNCES, "bounces")                                                                                              \
    X(OWN, "far sides of what a ray is in")                                                                            \
    X(MASKED, "rays with a mask")                                                                                      \
    X(SKIPPING, "rays that skip what they hit")                                                                        \
    X(CUT, "ranges cut at hits")                                                                                       \
    X(LOADS, "loads")                                                                                                  \
    X(BANDS, "loads in bands")                                                                                         \
    X(APART, "loads in bands with primitives apart")                                                                   \
    X(RELOADS, "loads over others")                                                                                    \
    X(CLUSTERS, "loads with clusters")                                                                                 \
    X(REFUSED, "loads refused")                                                                                        \
    X(TRACED, "rays traced") /* of arrays and frames, and their statistics: */                                         \
    X(INVALID, "invalid")                                                                                              \
    X(BVH, "through a BVH")                                                                                            \
    X(PACKETS, "packets")                                                                                              \
    X(TILES, "tiles")                                                                                                  \
    X(SPLIT, "packets split")                                                                                          \
    X(TESTS, "tests")                                                                                                  \
    X(DOUBLE, "decided in double")                                                                                     \
    X(EXACT, "decided exactly")                                                                                        \
    X(EXACT_VALUES, "values found exactly")                                                                            \
    X(FAST, "values of FAST")                                                                                          \
    X(FAST_OFF, "values far off")                                                                                      \
    X(WATERTIGHT, "by the watertight test")                                                                            \
    X(LEAKS, "leaks of it")                                                                                            \
    X(UNBOUNDED, "by a triangle test without a bound")                                                                 \
    X(UNBOUNDED_WRONG, "wrong by it")

typedef enum driver_counter {
#define X(name, text) COUNT_##name,
    DRIVER_COUNTERS(X)
#undef X
        COUNTERS
} driver_counter;

/* ---- profiles: profiles.c ---- */

typedef struct driver_run driver_run;

/* A group of calls: what is right about them is found before the first load, and asked of each. */
typedef struct driver_call {
    void (*begin)(driver_run *run); /* or NULL */
    void (*ask)(driver_run *run);
} driver_call;

extern const driver_call call_nearest, call_lists, call_inside, call_frames, call_points, call_bounces;

/* What a test must have counted: at least so much for each of another counter. */
typedef struct driver_show {
    driver_counter of, for_each;
    double least;
} driver_show;

#define DRIVER_ANY_WAY ~0u

typedef struct driver_profile {
    const char *name;
    uint32_t scenes; /* of a test */
    const scene_group *groups[SCENE_GROUPS];
    uint32_t primitives;         /* of a sort, at most, for families that ask */
    line_maker *lines[6];        /* those of a scene, one after another */
    uint32_t rays;               /* of a scene, at most */
    uint32_t lit;                /* points against a light, at most; 0: few */
    uint32_t pixels;             /* of large frames, at most; 0: all frames are small */
    uint32_t masks, skips, cuts; /* one ray of so many has a mask, skips a primitive, ends or begins at a hit */
    const driver_call *calls[4];
    unsigned ways;  /* a set of support/ways.h, or any; 0: AUTO first, and half of the others */
    uint32_t loads; /* of a scene */
    driver_show shows[8];
} driver_profile;

extern const driver_profile driver_profiles[];
extern const uint32_t driver_profile_count;

/* ---- a scene in the library: load.c ---- */

/* One of the numbers in arrays that name vertices or types; at: NULL if there is none. */
typedef struct driver_number {
    char *at;
    size_t bytes;
    uint32_t below, primitive; /* numbers below it name something */
    const char *what;
} driver_number;

/* A context, a structure, and a way to load arrays. */
typedef struct driver_setup {
    const char *variant;
    uint32_t threads; /* 0: one that runs tasks backwards */
    uint32_t number;  /* of the scene's setups */
    uint32_t first_variant;
    const test_way *way;
    cgt_context *context;
    cgt_scene *scene;
    char name[96];
    void *block[72]; /* the arrays, each of its own size */
    uint32_t blocks;
    driver_number named;
} driver_setup;

/* Loads the run's scene. Its random numbers choose, and are used up. */
void driver_setup_make(driver_run *run);

/* Options of a call: the papers' where the way is of theirs, and now and then elsewhere. */
test_trace_options driver_options(driver_run *run, cgt_precision precision);
void driver_setup_free(driver_setup *setup);
void driver_contexts_free(void);

/* ---- a run ---- */

/* All hits, or crossings, of the first rays: what is right, and what the first setup has answered. */
typedef struct driver_lists {
    judge_truth right[DRIVER_LISTED];
    uint32_t count[DRIVER_LISTED], first_count[DRIVER_LISTED];
    cgt_hit hit[DRIVER_LISTED][DRIVER_LIST], first[DRIVER_LISTED][DRIVER_LIST];
    cgt_hit nearest[DRIVER_RAYS]; /* of the other rays: the first one */
} driver_lists;

struct driver_run {
    const driver_profile *profile;
    uint32_t family; /* as given */
    judge_scene scene;
    driver_setup setup;
    judge_pool pool;
    uint32_t rays;
    bool cuts; /* some ranges end at hits: else no call may need them */
    judge_ray ray[DRIVER_RAYS];
    judge_truth right[DRIVER_RAYS]; /* all hits of those that are listed, up to the nearest of the others */
    full_hit first[DRIVER_RAYS];
    driver_lists hits, crossings;
    float point[DRIVER_POINTS][3];
    uint32_t point_mask[DRIVER_POINTS];
    uint8_t inside[2][DRIVER_POINTS], first_inside[2][DRIVER_POINTS];
    struct driver_view *view;
    uint64_t count[COUNTERS];
    uint64_t bad, bad_scenes; /* answers, scenes */
    uint32_t scene_bad;       /* answers of this scene */
};

driver_run *driver_run_make(const driver_profile *profile);
void driver_run_free(driver_run *run);

/* Makes a scene, loads it in some ways and asks all calls of the profile, by a stream of random numbers. family:
 * SCENE_ANY_FAMILY, or one of the profile's. */
void driver_run_scene(driver_run *run, test_random random, uint32_t number, uint32_t family);

/* ---- between the files of calls ---- */

/* Prints what is wrong, and how to see it again. ray: NULL if there is none. */
__attribute__((format(printf, 4, 5))) void driver_fail(driver_run *run, const judge_ray *ray, const char *call,
                                                       const char *format, ...);

/* Whether a call succeeded; a failure is wrong. */
bool driver_succeeds(driver_run *run, cgt_result result, const char *call);

/* What is right about a ray, and its doubts, counted. */
judge_truth driver_trace(driver_run *run, const judge_ray *ray, judge_question question, bool values);

/* Adds up the statistics of a call. */
void driver_count(driver_run *run, const cgt_trace_statistics *statistics);

/* The same of a call whose rays and hits are known. */
void driver_check_statistics(driver_run *run, const cgt_trace_statistics *statistics, uint64_t rays, uint64_t hits);

/* Whether any hit of a ray that is occluded so is right. */
bool driver_is_occluded(const driver_run *run, const judge_truth *right, uint8_t occluded);

bool driver_has_crossings(const driver_run *run);

/* A ray or a point sees and skips what the profile says. Of a ray with a hit, most skip that. */
void driver_filter(driver_run *run, judge_ray *ray, const judge_truth *right);

cgt_rays driver_ray_array(const judge_ray *rays, uint32_t count);

/* A ray alone. False where that is another one: a t_max of 0 stands for infinity, and is taken for it now and then. */
bool driver_single(const judge_ray *ray, cgt_single_ray *single);

struct driver_view *driver_view_make(void);

#endif
