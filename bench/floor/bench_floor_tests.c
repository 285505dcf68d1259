/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The cost of a test with everything in the first-level cache, by the library's own path: frames of one tile of 64x64
 * pixels over a grid of one cell. A backdrop of primitives fills the picture. In front of it stands a stack of
 * others, each closer than all earlier ones, so that none is occluded and all are tested; every pixel is hit in all
 * of these frames.
 * The times that small and large primitives add to the backdrop's frame separate the two costs:
 *     stack - backdrop = primitive * (drawn in one - in the other) + lane * (ray tests in one - in the other)
 * The library's statistics count what is drawn and tested. What the backdrop's frame takes beyond the empty tile, and
 * beyond its own primitives and tests, is the resolve of its pixels. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "floor/bench_floor.h"
#include "common/bench_random.h"
#include "common/bench_timing.h"

enum { EDGE = 64, STACK = 64, BACK_EDGE = 8, BACK = BACK_EDGE * BACK_EDGE, MOST = BACK + STACK };
enum { ROUNDS = 25 };

#define ROUND_MS 0.5 /* length of a round, in which a frame is repeated */
#define FOV 4.5f     /* degrees: pixels of the same size as in a picture of 1280x720 */
#define SMALL 2.0f   /* pixels: radius */
#define LARGE 12.0f

enum { EMPTY, BACKDROP, SMALL_STACK, LARGE_STACK, FRAMES };

/* One frame that is measured repeatedly. */
typedef struct tests_frame {
    bench_scene scene;
    float moving[MOST * 9];
    uint32_t index[MOST * 3];
    uint32_t count; /* primitives */
    uint32_t passes;
    double ns; /* the shortest round's mean */
    double drawn, lanes, hits;
} tests_frame;

typedef struct tests_bench {
    floor_job *job;
    cgt_context *context; /* of one thread */
    cgt_camera camera;
    int triangles;
    bench_planes planes;
    tests_frame frame[FRAMES];
} tests_bench;

/* ---- Scenes -------------------------------------------------------------------------------------------------- */

/* Half the width of a pixel at distance 1. */
static float half_pixel(void) { return tanf(0.5f * FOV * 3.14159265f / 180.0f) / EDGE; }

/* Adds a primitive with a radius in pixels around the ray of a point of the picture, -1 to 1 in both directions. */
static void put(const tests_bench *bench, tests_frame *f, float x, float y, float depth, float pixels)
{
    static const float corner[3][2] = {{0.0f, 1.0f}, {-0.866f, -0.5f}, {0.866f, -0.5f}};
    const float half = half_pixel(), radius = 2.0f * pixels * half * fabsf(depth);
    const float centre[3] = {x * EDGE * half * depth, y * EDGE * half * depth, depth};
    const uint32_t i = f->count++;
    if (!bench->triangles) {
        memcpy(f->moving + 4 * (size_t)i, centre, sizeof centre);
        f->moving[4 * (size_t)i + 3] = radius;
        return;
    }
    for (uint32_t k = 0; k < 3; k++) {
        float *v = f->moving + 9 * (size_t)i + 3 * k;
        v[0] = centre[0] + radius * corner[k][0];
        v[1] = centre[1] + radius * corner[k][1];
        v[2] = centre[2];
        f->index[3 * (size_t)i + k] = 3 * i + k;
    }
}

/* Every primitive has its own depth, and covers a square of the picture. */
static void put_backdrop(const tests_bench *bench, tests_frame *f)
{
    const float pixels = (bench->triangles ? 1.5f : 0.82f) * EDGE / BACK_EDGE;
    for (int i = 0; i < BACK; i++) {
        const int column = i % BACK_EDGE, row = i / BACK_EDGE;
        put(bench, f, (2.0f * (float)column + 1.0f) / BACK_EDGE - 1.0f, (2.0f * (float)row + 1.0f) / BACK_EDGE - 1.0f,
            60.0f + 0.25f * (float)i, pixels);
    }
}

/* Each primitive is a twentieth closer than the one before, so that no two have the same depth anywhere. Positions are
 * random, within the picture. */
static void put_stack(const tests_bench *bench, tests_frame *f, float pixels)
{
    uint64_t state = bench_random_start;
    const float room = 1.0f - 2.2f * pixels / EDGE;
    for (int i = 0; i < STACK; i++) {
        const float x = room * (2.0f * bench_random(&state) - 1.0f), y = room * (2.0f * bench_random(&state) - 1.0f);
        put(bench, f, x, y, 2.0f * powf(0.95f, (float)(i - STACK)), pixels);
    }
}

static void make_objects(const tests_bench *bench, tests_frame *f, int which)
{
    f->count = 0;
    if (which == EMPTY) /* behind the eye */
        put(bench, f, 0.0f, 0.0f, -4.0f, LARGE);
    else
        put_backdrop(bench, f);
    if (which == SMALL_STACK || which == LARGE_STACK)
        put_stack(bench, f, which == SMALL_STACK ? SMALL : LARGE);
}

/* ---- Times --------------------------------------------------------------------------------------------------- */

static cgt_result trace(tests_bench *bench, tests_frame *f, bench_counts *counts)
{
    cgt_trace_options options;
    cgt_research_trace_options research;
    cgt_frame frame;
    cgt_result result = CGT_OK;
    bench_planes_frame(&bench->planes, &frame);
    bench_choice_options(&bench->job->choice, counts, &options, &research);
    for (uint32_t pass = 0; result == CGT_OK && pass < f->passes; pass++)
        result = cgt_trace_camera(f->scene.scene, &bench->camera, &frame, &options);
    return result;
}

/* Builds a frame's scene, counts its work, and finds how many passes make a round. */
static cgt_result open_frame(tests_bench *bench, int which)
{
    static const uint32_t one_cell[3] = {1, 1, 1};
    const cgt_structure requested = bench->job->settings->structure.requested[0];
    /* with a resolution AUTO would take the queue grid */
    const cgt_structure structure = requested == CGT_STRUCTURE_AUTO ? CGT_STRUCTURE_LOOSE_GRID : requested;
    tests_frame *f = &bench->frame[which];
    bench_counts counted;
    double ms = 0.0;
    memset(&counted, 0, sizeof counted);
    make_objects(bench, f, which);
    cgt_result result = floor_open_scene(bench->job, &f->scene, bench->context, f->moving,
                                         bench->triangles ? f->index : NULL, bench->triangles ? f->count : 0);
    if (result == CGT_OK)
        result = bench_scene_structure(&f->scene, structure, CGT_RAY_KIND_COHERENT, &bench->job->choice.kd, one_cell);
    if (result == CGT_OK)
        result = bench_scene_commit(&f->scene, bench->triangles ? 3 * f->count : f->count);
    f->passes = 1;
    if (result == CGT_OK)
        result = trace(bench, f, &counted);
    f->drawn = (double)counted.trace.packet_tests;
    f->lanes = (double)counted.trace.ray_tests;
    f->hits = (double)counted.trace.hits;
    f->ns = INFINITY;
    while (result == CGT_OK) {
        const double begin = bench_now_ms();
        result = trace(bench, f, NULL);
        ms = bench_now_ms() - begin;
        if (ms >= ROUND_MS || f->passes >= 1u << 20)
            break;
        f->passes *= 2;
    }
    return result;
}

/* The frames take turns, so that a slow moment affects all alike. */
static cgt_result time_frames(tests_bench *bench)
{
    cgt_result result = CGT_OK;
    for (int i = 0; result == CGT_OK && i < ROUNDS * FRAMES; i++) {
        tests_frame *f = &bench->frame[i % FRAMES];
        const double begin = bench_now_ms();
        result = trace(bench, f, NULL);
        f->ns = fmin(f->ns, 1e6 * (bench_now_ms() - begin) / f->passes);
    }
    return result;
}

/* Solves the two differences for the two unknowns, and derives the rest. NaN where the counts are not independent. A
 * cost below the noise may be negative. */
static void solve(const tests_frame *f, floor_tests *tests)
{
    const tests_frame *back = &f[BACKDROP], *small = &f[SMALL_STACK], *large = &f[LARGE_STACK];
    const double a = small->drawn - back->drawn, b = small->lanes - back->lanes, e = small->ns - back->ns;
    const double c = large->drawn - back->drawn, d = large->lanes - back->lanes, g = large->ns - back->ns;
    const double determinant = a * d - b * c;
    tests->primitive = determinant != 0.0 ? (e * d - b * g) / determinant : NAN;
    tests->lane = determinant != 0.0 ? (a * g - e * c) / determinant : NAN;
    const double drawing = back->drawn * tests->primitive + back->lanes * tests->lane;
    tests->resolve = (back->ns - f[EMPTY].ns - drawing) / back->hits;
}

static int measure_kind(tests_bench *bench, floor_tests *tests)
{
    cgt_result result = CGT_OK;
    for (int which = 0; result == CGT_OK && which < FRAMES; which++)
        result = open_frame(bench, which);
    if (result == CGT_OK)
        result = time_frames(bench);
    if (result == CGT_OK)
        solve(bench->frame, tests);
    const int code = result == CGT_OK ? PROGRAM_OK : bench_scene_failed(bench->context, "tests", result);
    for (int which = 0; which < FRAMES; which++)
        bench_scene_release(&bench->frame[which].scene);
    return code;
}

static int measure_kinds(tests_bench *bench)
{
    floor_job *job = bench->job;
    int code = PROGRAM_OK;
    for (int kind = 0; code == PROGRAM_OK && kind < 2; kind++) {
        const char *name = kind ? "triangles" : "spheres";
        floor_tests *tests = &job->tests[kind];
        bench->triangles = kind;
        code = measure_kind(bench, tests);
        if (code != PROGRAM_OK)
            break;
        floor_row(job, "tests", name, "ray test", 1, tests->lane, "ns");
        floor_row(job, "tests", name, "object drawn", 1, tests->primitive, "ns");
        floor_row(job, "tests", name, "pixel resolved", 1, tests->resolve, "ns");
    }
    return code;
}

int floor_measure_tests(floor_job *job)
{
    tests_bench *bench = calloc(1, sizeof *bench);
    if (!bench || bench_planes_create(&bench->planes, EDGE, EDGE)) {
        free(bench);
        program_error("out of memory");
        return PROGRAM_FAILED;
    }
    bench->job = job;
    cgt_camera_init(&bench->camera);
    memset(bench->camera.eye, 0, sizeof bench->camera.eye);
    memcpy(bench->camera.target, (const float[]){0.0f, 0.0f, 1.0f}, sizeof bench->camera.target);
    bench->camera.fov = FOV;
    const cgt_result result = bench_context_create(1, job->settings->shared.variant, &bench->context);
    const int code = result == CGT_OK ? measure_kinds(bench) : bench_scene_failed(NULL, "tests", result);
    cgt_context_release(bench->context);
    bench_planes_release(&bench->planes);
    free(bench);
    return code;
}
