/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Programs may flush denormals, use any rounding mode, and trap exceptions: every task of every structure computes the
 * same bits, on the library's threads and on those of a caller's runner, and the caller's environment is left
 * unchanged. */
#define _GNU_SOURCE /* feenableexcept */
#include "api/calls.h"
#include "support/suite.h"

#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

/* ---- environments ---- */

typedef struct environment {
    const char *name;
    int rounding;
    bool flushed; /* denormal operands and results are zero */
    bool traps;   /* a division by zero, an overflow or an invalid operation ends the program */
} environment;

static const environment environments[] = {
    {"flushed denormals", FE_TONEAREST, true, false},
#ifdef __GLIBC__
    {"traps", FE_TONEAREST, false, true},
#endif
#ifdef FE_UPWARD
    {"upwards", FE_UPWARD, false, false},
    {"upwards, flushed denormals", FE_UPWARD, true, false},
#endif
#ifdef FE_DOWNWARD
    {"downwards", FE_DOWNWARD, false, false},
#endif
#ifdef FE_TOWARDZERO
    {"towards zero", FE_TOWARDZERO, false, false},
#endif
};

/* Only the bits that control arithmetic: exception flags change as it runs. */
static uint64_t control_bits(void)
{
#if defined(__SSE__)
    return _mm_getcsr() & 0xffc0u;
#elif defined(__aarch64__)
    uint64_t fpcr;
    __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr));
    return fpcr;
#else
    return (uint64_t)fegetround();
#endif
}

static void flush_denormals(void)
{
#if defined(__SSE__)
    _mm_setcsr(_mm_getcsr() | 0x8040u);
#elif defined(__aarch64__)
    __asm__ volatile("msr fpcr, %0" : : "r"(control_bits() | UINT64_C(1) << 24));
#endif
}

/* fesetenv of MinGW-w64 leaves the mode of SSE as it is. */
typedef struct callers_environment {
    fenv_t all;
#ifdef __SSE__
    unsigned sse;
#endif
} callers_environment;

static void leave(const callers_environment *before)
{
    assert_int_equal(fesetenv(&before->all), 0);
#ifdef __SSE__
    _mm_setcsr(before->sse);
#endif
}

static void enter(const environment *e, callers_environment *before)
{
    assert_int_equal(fegetenv(&before->all), 0);
#ifdef __SSE__
    before->sse = _mm_getcsr();
#endif
    if (!e)
        return;
    assert_int_equal(fesetround(e->rounding), 0);
    if (e->flushed)
        flush_denormals();
#ifdef __GLIBC__
    if (e->traps)
        feenableexcept(FE_DIVBYZERO | FE_OVERFLOW | FE_INVALID); /* -1 where the machine has none: nothing to test */
#endif
}

/* Runs the tasks in reverse on the calling thread, each in the runner's own environment. */
static void run_in_environment(void *user, cgt_task *task, void *argument, uint32_t count)
{
    callers_environment before;
    enter(user, &before);
    const uint64_t control = control_bits();
    for (uint32_t i = count; i-- > 0;) {
        task(argument, i);
        assert_true(control_bits() == control);
    }
    leave(&before);
}

/* ---- the scene ---- */

#define SPHERES 20000u /* several chunks per task, and a kd-tree with a top */
#define TRIANGLES 9000u
#define EDGE 20u
#define PIXELS (EDGE * EDGE)

static float sphere[SPHERES][4], vertex[TRIANGLES * 3][3];

/* A third of all x are denormal, so that trees split there. */
static float any_x(test_random *r, uint32_t i)
{
    if (i % 3 == 0)
        return random_float(r, -1, -0.1f);
    return i % 3 == 1 ? (float)((int)random_below(r, 2001) - 1000) * 0x1p-149f : random_float(r, 0.1f, 1);
}

static void make_scene(void)
{
    test_random r = random_make(1);
    for (uint32_t i = 0; i < SPHERES; i++) {
        sphere[i][0] = any_x(&r, i);
        for (int a = 1; a < 3; a++)
            sphere[i][a] = random_float(&r, 0, 0.5f);
        sphere[i][3] = i % 5 ? 0 : i % 2 ? 0x1p-140f : 0x1p-8f;
    }
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        const float x = any_x(&r, i), y = random_float(&r, 0, 0.5f), z = random_float(&r, 0, 0.5f);
        for (uint32_t k = 0; k < 3; k++) {
            vertex[3 * i + k][0] = x + (i % 2 ? (float)k * 0x1p-148f : random_float(&r, 0, 0.01f));
            vertex[3 * i + k][1] = y + random_float(&r, 0, 0.02f);
            vertex[3 * i + k][2] = z + random_float(&r, 0, 0.02f);
        }
    }
}

/* ---- calls that run tasks ---- */

/* Every second ray starts at a denormal distance from its target. */
static float org[3][PIXELS], dir[3][PIXELS];

static api_world make_world(void)
{
    api_world w = {.sphere = (const float(*)[4])sphere,
                   .spheres = SPHERES,
                   .vertex = (const float(*)[3])vertex,
                   .triangles = TRIANGLES,
                   .org = {org[0], org[1], org[2]},
                   .dir = {dir[0], dir[1], dir[2]},
                   .rays = PIXELS,
                   .width = EDGE,
                   .height = EDGE,
                   .samples = 4,
                   .light = {{.position = {0x1p-140f, 1.5f, 0.25f}},
                             {.kind = CGT_LIGHT_DIRECTIONAL, .position = {0x1p-140f, 1, 0.25f}}}};
    make_scene();
    cgt_camera_init(&w.camera);
    memcpy(w.camera.eye, (const float[3]){-0.3f, 0.25f, 2.5f}, sizeof w.camera.eye);
    memcpy(w.camera.target, (const float[3]){0.01f, 0.25f, 0.25f}, sizeof w.camera.target);
    w.camera.fov = 30;
    for (uint32_t i = 0; i < PIXELS; i++)
        for (uint32_t a = 0; a < 3; a++) {
            org[a][i] = i % 2 ? sphere[i][a] : a == i % 3 ? -3 : sphere[5 * i][a];
            dir[a][i] = i % 2 ? (float)((int)((i + a) % 7) - 3) + 0.25f : a == i % 3 ? 1 : 0x1p-140f;
        }
    return w;
}

/* Visitors are the caller's code: they run in the environment of the call. */
static cgt_visit is_callers(const void *user)
{
    return control_bits() == *(const uint64_t *)user ? CGT_VISIT_CONTINUE : CGT_VISIT_STOP;
}

static cgt_visit visit(void *user, const cgt_tile *tile)
{
    (void)tile;
    return is_callers(user);
}

static cgt_visit visit_pixels(void *user, uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    (void)x, (void)y, (void)width, (void)height;
    return is_callers(user);
}

static cgt_visit visit_hits(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    (void)ray, (void)hits, (void)count;
    return is_callers(user);
}

static void call_visitors(const cgt_scene *scene, const api_world *world, api_results *r)
{
    static uint8_t occluded[PIXELS];
    static float visibility[PIXELS];
    uint64_t control = control_bits();
    const cgt_shadow_options shadows = {.visitor = visit_pixels, .visitor_user = &control};
    const cgt_ambient_options ambient = {.samples = 1, .visitor = visit_pixels, .visitor_user = &control};
    const cgt_rays rays = {.count = 20,
                           .org = {world->org[0], world->org[1], world->org[2]},
                           .dir = {world->dir[0], world->dir[1], world->dir[2]}};
    cgt_frame frame;
    cgt_frame_init(&frame, EDGE, EDGE);
    frame.visitor = visit;
    frame.visitor_user = &control;
    assert_int_equal(cgt_trace_camera(scene, &world->camera, &frame, NULL), CGT_OK);
    assert_int_equal(cgt_visit_all_rays(scene, &rays, NULL, 0, visit_hits, &control, NULL), CGT_OK);
    for (uint32_t lights = 0; lights < 2; lights++)
        assert_int_equal(
            cgt_occluded_frame(scene, &world->camera, &r->frame, world->light, lights, &shadows, occluded, NULL),
            CGT_OK);
    assert_int_equal(cgt_ambient_occlusion(scene, &world->camera, &r->frame, &ambient, visibility, NULL), CGT_OK);
}

/* The structure's elements, compared bit by bit. */
typedef struct counts {
    uint64_t count[8];
    double cost;
    float bounds[6];
} counts;

static counts count(const cgt_scene *scene)
{
    counts c = {.cost = research_of(scene).kd_cost};
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    const cgt_research_scene_statistics research = research_of(scene);
    const uint64_t count[8] = {research.references,   research.kd_nodes, research.kd_leaves,    research.kd_depth,
                               st.skipped_not_finite, st.skipped_radius, st.skipped_degenerate, st.structure_bytes};
    memcpy(c.count, count, sizeof count);
    memcpy(c.bounds, st.bounds_min, sizeof st.bounds_min);
    memcpy(c.bounds + 3, st.bounds_max, sizeof st.bounds_max);
    return c;
}

static api_results *trace_all(cgt_context *context, const api_world *world, const test_way *w, counts *c)
{
    const uint64_t control = control_bits();
    cgt_scene *scene = api_scene_make(world, context, SCENE_OPTIONS(&w->scene));
    api_results *r = scene ? api_results_make(world, scene) : NULL;
    assert_non_null(r);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    *c = count(scene);
    assert_int_equal(api_trace_all(r), CGT_OK);
    call_visitors(scene, world, r);
    cgt_scene_release(scene);
    assert_true(control_bits() == control);
    return r;
}

/* ---- tests ---- */

/* The context's threads are created in the environment and inherit it. */
static void check_environment(const api_world *world, const test_way *w, const environment *e, bool runner,
                              const api_results *expected, const counts *counted)
{
    environment runners = *e;
    cgt_context_options options;
    cgt_context *context;
    callers_environment before;
    counts c;
    cgt_context_options_init(&options);
    options.threads = 3;
    if (runner)
        options.tasks = (cgt_task_runner){&runners, run_in_environment};
    enter(e, &before);
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    if (runner)
        leave(&before); /* only the tasks see it */
    api_results *got = trace_all(context, world, w, &c);
    cgt_context_release(context);
    leave(&before);
    if (!api_results_equal(got, expected) || memcmp(&c, counted, sizeof c) != 0)
        fail_msg("%s, %s, %s: the bits differ", w->name, e->name, runner ? "runner" : "threads");
    api_results_free(got);
}

TEST(every_task_computes_the_same_bits)
{
    api_world world = make_world();
    const size_t step = test_samples() ? 6 : 2;
    for (uint32_t i = 0; i <= way_count(WAY_BUILDER); i++) {
        const test_way *w = i ? way_in_turn(WAY_BUILDER, i - 1) : way_next(NULL, WAY_CHOSEN); /* the BVH on demand */
        counts c;
        cgt_context *context = context_make(1, NULL);
        world.triangles = i % 4 == 1 ? 0 : TRIANGLES;
        api_results *expected = trace_all(context, &world, w, &c);
        cgt_context_release(context);
        for (size_t k = 0; k < TEST_COUNT(environments); k++)
            for (int runner = 0; runner < 2; runner++)
                if ((k == 0 && !test_samples()) || (i + k + (size_t)runner) % step == 0)
                    check_environment(&world, w, &environments[k], runner, expected, &c);
        api_results_free(expected);
    }
}

/* A denormal is not 0, whatever the caller's environment makes of it: a range's end, a light's direction, a radius. */
TEST(denormal_arguments_are_not_zero)
{
    static const float ball[1][4] = {{0, 0, 0.75f, 0.5f}}, zero[1] = {0};
    const cgt_single_ray ray = {.dir = {0, 0, 1}, .t_max = 0x1p-140f};
    const cgt_light light = {.kind = CGT_LIGHT_DIRECTIONAL, .position = {0, 0, 0x1p-127f}}; /* t is 2^125 */
    const cgt_points points = {.count = 1, .position = {zero, zero, zero}};
    const cgt_ambient_options ambient = {.radius = 0x1p-140f};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, ball, 1);
    for (size_t k = 0; k < TEST_COUNT(environments); k++) {
        float t[1], normal[3][1], visibility[1] = {0};
        uint32_t primitive[1], geometry[1], count = 9;
        uint8_t occluded = 9;
        cgt_hit hit[4];
        cgt_camera camera;
        cgt_frame frame;
        callers_environment before;
        cgt_camera_init(&camera);
        cgt_frame_init(&frame, 1, 1);
        frame.t = t, frame.primitive = primitive, frame.geometry = geometry;
        for (int a = 0; a < 3; a++)
            frame.normal[a] = normal[a];
        enter(&environments[k], &before);
        const cgt_result all = cgt_trace_all_ray(scene, &ray, NULL, hit, 4, &count, NULL, NULL);
        const cgt_result lit = cgt_occluded_points(scene, &light, &points, &occluded, NULL);
        const cgt_result drawn = cgt_trace_camera(scene, &camera, &frame, NULL);
        const cgt_result open = cgt_ambient_occlusion(scene, &camera, &frame, &ambient, visibility, NULL);
        leave(&before);
        if (all || lit || drawn || open || count || occluded != 1 || visibility[0] != 1)
            fail_msg("%s: %d %d %d %d, %u hits, occluded %u, sees %g", environments[k].name, (int)all, (int)lit,
                     (int)drawn, (int)open, count, occluded, (double)visibility[0]);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_float_environment", NULL, NULL)
