/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What traces by a way: a scene of the library, or of Embree, over one frame at a time. All subjects call these
 * alone. */
#ifndef BENCH_TRACER_H
#define BENCH_TRACER_H

#include "common/bench_input.h"
#include "common/bench_table.h"
#include "rays/bench_planes.h"
#include "rays/bench_rays.h"
#include "rays/bench_shade.h"
#include "ways/bench_way.h"

typedef struct bench_tracer bench_tracer;
typedef struct embree_scene embree_scene;

/* One file, and all that traces it. */
typedef struct bench_session {
    const bench_settings *settings;
    const char *path;
    char scene[BENCH_NAME_SIZE]; /* the file's name without folder and ending */
    bench_input input;
    uint32_t count; /* spheres or vertices, in input.moving */
    cgt_context *context;
    bench_camera_axes axes;
    const cgt_camera *camera;
    bench_way way[BENCH_MOST_WAYS];
    bench_tracer *tracer; /* one for each way */
    size_t tracers;
    void *device; /* Embree's; NULL: there is no such way */
} bench_session;

/* Opens the context, and the ways over a file's frames, or over an input, which it takes over. Close after a failure,
 * too. Returns PROGRAM_OK, or PROGRAM_FAILED after a message. */
int bench_session_open(bench_session *session, const bench_settings *settings, const char *path);
int bench_session_open_input(bench_session *session, const bench_settings *settings, const char *path,
                             const bench_input *input);
void bench_session_close(bench_session *session);

/* The clock of rays (bench_clock_ms). */
double bench_session_ms(const bench_session *session);

/* A context: threads and variant of the settings. *context is NULL after a message. */
int bench_context_create(uint32_t threads, const char *variant, cgt_context **context);

/* Prints what failed and the library's message. Returns PROGRAM_FAILED. */
int bench_failed(const cgt_context *context, const char *what, cgt_result result);

/* The first tracer that is not left out, of the library where there is one; NULL: none. */
bench_tracer *bench_session_first(const bench_session *session);

/* ---- what is traced ---- */

typedef enum bench_query {
    BENCH_NEAREST,
    BENCH_ANY,
    BENCH_FOUR,       /* the first four hits */
    BENCH_PICTURE,    /* the camera's frame, in one call */
    BENCH_POINTS,     /* points against lights */
    BENCH_LIT_PICTURE /* a frame's hits against lights, in one call; the points are what Embree gets */
} bench_query;

/* Rays or points, as arrays. */
typedef struct bench_set {
    const char *kind, *order;
    bench_query query;
    cgt_rays rays;          /* of points org alone, and what they skip */
    const cgt_rays *embree; /* what Embree gets in place of rays: of points, t_min alone; NULL: the same */
    const cgt_light *light; /* of points, one after the other */
    uint32_t lights;
    const uint64_t *end; /* of each call, where calls is not 0; else they have as many rays as is asked */
    uint32_t calls;
    int one_by_one;  /* of Embree: whatever its way's packets are */
    double order_ms; /* what a renderer would pay for the order */
} bench_set;

#define BENCH_FOUR_HITS 4u

/* Results: as many as the set has rays, times lights, or hits. */
typedef struct bench_found {
    bench_planes planes; /* of pictures */
    uint64_t room;       /* that the arrays hold */
    float *t;
    uint32_t *primitive;
    uint8_t *occluded; /* any hit; Embree's nearest hits, too */
} bench_found;

/* The counts of a trace. */
typedef struct bench_counts {
    cgt_trace_statistics trace;
    cgt_research_trace_statistics research;
} bench_counts;

/* ---- tracers ---- */

typedef struct bench_engine {
    int (*open)(bench_tracer *tracer);
    void (*close)(bench_tracer *tracer);
    /* Moves the primitives where the tracer has a copy of its own; then builds over them. */
    void (*move)(bench_tracer *tracer);
    int (*commit)(bench_tracer *tracer);
    /* The camera's frame, into planes or, where picture is not NULL, shaded. */
    int (*picture)(bench_tracer *tracer, const bench_planes *planes, bench_picture *picture);
    /* Puts the last picture's hits into the planes, where it did not store them there. */
    void (*planes)(bench_tracer *tracer, const bench_planes *planes);
    /* Makes ready the rays of points to a light, where rays are needed. */
    int (*aim)(bench_tracer *tracer, const bench_set *set, uint32_t light);
    /* One call: rays first to first + count - 1 of the set, against the light that was aimed at. counts: NULL for
     * none. */
    int (*trace)(bench_tracer *tracer, const bench_set *set, uint64_t first, uint64_t count, uint32_t light,
                 const bench_found *found, bench_counts *counts);
    /* What a frame's secondary rays are handed to; form: below forms. */
    bench_rays_sink (*sink)(bench_tracer *tracer, int coherent, int nearest, int form);
    int forms; /* to trace ambient-occlusion rays, of which the fastest counts */
} bench_engine;

struct bench_tracer {
    const bench_engine *engine;
    const bench_way *way;
    const bench_session *session;
    bench_tracer *built_by; /* whose scene it traces: its own, or an earlier one's */
    char config[BENCH_NAME_SIZE];
    int left_out; /* there is no such structure */
    /* the library's */
    cgt_scene *scene;
    int has_geometry;
    uint32_t geometry, held; /* elements that it has */
    cgt_scene_statistics built;
    cgt_research_scene_statistics research;
    cgt_trace_options options, ray_options; /* of frames; of arrays of rays */
    cgt_research_trace_options research_options[2];
    int nearest; /* of the sink */
    embree_scene *embree;
};

/* Embree's streams are for any hit; four hits take a filter, which its own spheres and triangles call. */
static inline int bench_embree_takes(const bench_way *way, bench_query query)
{
    return (way->packet != 0 || (query != BENCH_NEAREST && query != BENCH_FOUR)) &&
           (query != BENCH_FOUR || way->user <= 0);
}

extern const bench_engine bench_library_engine;
#ifdef BENCH_HAS_EMBREE
extern const bench_engine bench_embree_engine;
int bench_embree_open(bench_session *session);
void bench_embree_close(bench_session *session);
#endif

/* Reads what the library says of its last commit. Leaves the tracer out, after a message, where that built another
 * structure than its way's. */
int bench_library_inspect(bench_tracer *tracer);

/* Adds the cells about a structure to a row, and ends it. */
void bench_library_cells(const bench_tracer *tracer, bench_table *table);

/* On standard error: what the library chose. */
int bench_library_describe(bench_tracer *tracer, const bench_planes *planes);

#endif
