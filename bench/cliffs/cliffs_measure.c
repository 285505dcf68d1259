/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Measures a scene within bounded time: each call begins with few rays and grows by four until it takes too long. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cliffs/bench_cliffs.h"
#include "common/bench_timing.h"
#include "query/camera.h"

enum { MOST_RUNS = 5, SINGLE_STEPS = 2, ARRAYS = 8 };

#define MOST_COORDINATE 1.844e18f /* of origins and directions: Embree's documented range */
#define LIGHT_T_MIN 1e-4f         /* of Embree's shadow rays, of the way to the light */

static uint64_t rays_of(uint32_t step) { return (uint64_t)CLIFFS_RAYS << 2 * step; }

/* ---- scene and rays ---- */

/* Whether Embree takes a ray; the others are left out. */
static bool is_for_embree(const truth_ray *ray)
{
    for (int a = 0; a < 3; a++)
        if (!(fabsf(ray->org[a]) <= MOST_COORDINATE && fabsf(ray->dir[a]) <= MOST_COORDINATE))
            return false;
    return ray->t_min >= 0 && !isnan(ray->t_max);
}

/* Fills arrays, `count` elements each, with rays; from: where they begin. */
static cgt_rays put_rays(const truth_ray *rays, uint32_t count, bool is_for, float *from)
{
    static const truth_ray off = {.dir = {0, 0, 1}, .t_min = 1};
    for (uint32_t i = 0; i < count; i++) {
        const truth_ray *ray = is_for && !is_for_embree(&rays[i]) ? &off : &rays[i];
        const float value[ARRAYS] = {ray->org[0], ray->org[1], ray->org[2], ray->dir[0],
                                     ray->dir[1], ray->dir[2], ray->t_min,  ray->t_max};
        for (size_t k = 0; k < ARRAYS; k++)
            from[k * count + i] = value[k];
    }
    return (cgt_rays){.count = count,
                      .org = {from, from + count, from + 2 * (size_t)count},
                      .dir = {from + 3 * (size_t)count, from + 4 * (size_t)count, from + 5 * (size_t)count},
                      .t_min = from + 6 * (size_t)count,
                      .t_max = from + 7 * (size_t)count};
}

/* The rays as arrays. */
static int make_rays(cliffs_input *input)
{
    const uint32_t count = (uint32_t)rays_of(input->settings->steps - 1);
    truth_ray *rays = malloc(count * sizeof *rays);
    float *from = input->arrays = malloc(count * sizeof(float[2 * ARRAYS + 1]));
    uint32_t valid = 0;
    if (!rays || !from) {
        free(rays);
        return -1;
    }
    cliff_make_rays(&input->scene, input->cliff, input->disturbed, rays, count);
    input->rays = put_rays(rays, count, false, from);
    input->embree = put_rays(rays, count, true, from + ARRAYS * (size_t)count);
    input->light_of_embree = (cgt_rays){.t_min = from + 2 * ARRAYS * (size_t)count};
    for (uint32_t i = 0; i < count; i++)
        from[2 * ARRAYS * (size_t)count + i] = LIGHT_T_MIN;
    for (uint32_t i = 0; i < CLIFFS_RAYS; i++)
        valid += is_for_embree(&rays[i]);
    input->is_for_embree = 2 * valid > CLIFFS_RAYS;
    free(rays);
    return 0;
}

/* A frame of the scene's primitives, for tracers. Release after a failure, too. */
static int make_frame(const cliff_scene *scene, bench_input *input)
{
    const bool spheres = scene->base == CLIFF_CLOUD, sticks = scene->base == CLIFF_STICKS;
    const uint32_t each = spheres ? 1 : sticks ? 2 : 3, elements = each * scene->count;
    const size_t bytes = (size_t)scene->count * cliff_floats(scene) * sizeof(float);
    *input = (bench_input){.kind = spheres || sticks ? CGT_TRAJECTORY_SPHERES : CGT_TRAJECTORY_TRIANGLES,
                           .frames = 1,
                           .count = malloc(sizeof *input->count),
                           .data = calloc(1, sizeof *input->data),
                           .is_soup = each == 3,
                           .triangles = each == 3 ? scene->count : 0,
                           .index = spheres ? NULL : malloc((size_t)elements * sizeof *input->index),
                           .most = elements,
                           .moving = malloc(bytes)};
    if (!input->count || !input->data || !input->moving || !(input->index || spheres) ||
        !(input->data[0] = malloc(bytes))) {
        input->frames = input->data ? 1 : 0;
        return -1;
    }
    input->count[0] = elements;
    memcpy(input->data[0], scene->data, bytes);
    for (uint32_t i = 0; i < elements && !spheres; i++)
        input->index[i] = sticks ? 2 * i : i;
    return 0;
}

static int make_found(bench_found *found, size_t most)
{
    found->room = most;
    found->t = found->planes.t = calloc(most, sizeof *found->t);
    found->primitive = found->planes.primitive = calloc(most, sizeof *found->primitive);
    found->occluded = calloc(most, 1);
    return found->t && found->primitive && found->occluded ? 0 : -1;
}

int cliffs_input_make(cliffs_input *input, const bench_settings *settings, const cliff *c, bool disturbed,
                      uint32_t count)
{
    bench_input frame;
    memset(input, 0, sizeof *input);
    input->settings = settings;
    input->cliff = c;
    input->disturbed = disturbed;
    const bool is_made = cliff_make(&input->scene, c, disturbed, count);
    const int failed = !is_made || make_rays(input) || make_found(&input->found, (size_t)input->rays.count);
    if (failed || make_frame(&input->scene, &frame)) {
        if (!failed)
            bench_input_release(&frame);
        program_error("out of memory for %u primitives", (unsigned)count);
        return PROGRAM_FAILED;
    }
    input->light.kind = CGT_LIGHT_POINT;
    memcpy(input->light.position, input->scene.light, sizeof input->light.position);
    int code = bench_session_open_input(&input->session, settings, c->name, &frame);
    input->session.camera = &input->scene.camera;
    for (size_t i = 0; i < input->session.tracers && code == PROGRAM_OK; i++) {
        bench_tracer *t = &input->session.tracer[i];
        t->engine->move(t);
        code = t->engine->commit(t);
    }
    return code;
}

void cliffs_input_free(cliffs_input *input)
{
    for (uint32_t k = 0; k < CLIFFS_STEPS; k++) {
        free((float *)(uintptr_t)input->points[k].rays.org[0]);
        free((uint32_t *)(uintptr_t)input->points[k].rays.skip_primitive);
    }
    bench_session_close(&input->session);
    cliff_free(&input->scene);
    free(input->arrays);
    free(input->found.t);
    free(input->found.primitive);
    free(input->found.occluded);
}

/* ---- points to be lit ---- */

static int keep_points(cliffs_input *input, const cliff_points *points, bench_set *set)
{
    const size_t count = points->count;
    float *at = malloc((3 * count + 1) * sizeof *at);
    uint32_t *skip = malloc((count + 1) * sizeof *skip);
    *set = (bench_set){.query = BENCH_POINTS,
                       .rays = {.count = count, .org = {at, at + count, at + 2 * count}, .skip_primitive = skip},
                       .embree = &input->light_of_embree,
                       .light = &input->light,
                       .lights = 1};
    if (!at || !skip)
        return -1;
    for (size_t i = 0; i < count; i++) {
        for (size_t a = 0; a < 3; a++)
            at[a * count + i] = points->point[i].position[a];
        skip[i] = points->point[i].primitive;
    }
    return 0;
}

/* The points that are visible in each step's picture, up to the first picture that takes too long. */
static int make_points(cliffs_input *input)
{
    const bench_tracer *t = bench_session_first(&input->session);
    for (uint32_t k = 0; k < input->settings->steps && !input->points[k].lights && !t->way->embree; k++) {
        const double begin = bench_now_ms();
        cliff_points points;
        int failed = !cliff_make_points(&input->scene, t->scene, CLIFFS_WIDTH << k, CLIFFS_HEIGHT << k, &points);
        if (!failed) {
            failed = keep_points(input, &points, &input->points[k]);
            cliff_points_free(&points);
        }
        if (failed) {
            program_error("cliffs: no points to be lit");
            return PROGRAM_FAILED;
        }
        if (4 * (bench_now_ms() - begin) > input->settings->limit_ms)
            break;
    }
    return PROGRAM_OK;
}

/* ---- calls ---- */

static bench_set set_of(const cliffs_input *input, cliff_call call, uint32_t step)
{
    bench_set set = {.query = call == CLIFF_CAMERA     ? BENCH_PICTURE
                              : call == CLIFF_OCCLUDED ? BENCH_ANY
                                                       : BENCH_NEAREST,
                     .rays = input->rays,
                     .embree = &input->embree,
                     .one_by_one = 1};
    set.rays.count = rays_of(step);
    return call == CLIFF_LIGHT ? input->points[step] : set;
}

/* A step's picture. The library's own camera: scenes may be of any scale. */
static int set_camera(cliffs_input *input, uint32_t step)
{
    const uint32_t width = CLIFFS_WIDTH << step, height = CLIFFS_HEIGHT << step;
    char message[CGT_CAMERA_MESSAGE_BYTES];
    bench_camera_axes *axes = &input->session.axes;
    cgt_camera_rays rays;
    if (cgt_camera_prepare(input->session.camera, width, height, &rays, message) != CGT_OK) {
        program_error("%s", message);
        return PROGRAM_FAILED;
    }
    *axes = (bench_camera_axes){.width = width, .height = height, .step = {rays.pixel[0], rays.pixel[1]}};
    memcpy(axes->eye, rays.eye, sizeof axes->eye);
    memcpy(axes->fwd, rays.fwd, sizeof axes->fwd);
    memcpy(axes->right, rays.right, sizeof axes->right);
    memcpy(axes->up, rays.up, sizeof axes->up);
    input->found.planes.width = width;
    input->found.planes.height = height;
    return PROGRAM_OK;
}

/* Whether Embree takes the camera's rays, or those from a step's points to the light. */
static bool is_seen_by_embree(const cliffs_input *input, cliff_call call, uint32_t step)
{
    const cgt_rays *points = &input->points[step].rays;
    for (int a = 0; a < 3; a++) {
        if (!(fabsf((call == CLIFF_CAMERA ? input->session.camera->eye : input->light.position)[a]) <=
              MOST_COORDINATE / 2))
            return false;
        for (uint64_t i = 0; i < points->count && call == CLIFF_LIGHT; i++)
            if (!(fabsf(points->org[a][i]) <= MOST_COORDINATE / 2))
                return false;
    }
    return true;
}

/* Not timed. *leaves_out: the way or the scene has no such rays. */
static int prepare(cliffs_input *input, bench_tracer *t, cliff_call call, uint32_t step, bool *leaves_out)
{
    bench_session *s = &input->session;
    if (call == CLIFF_CAMERA && set_camera(input, step))
        return PROGRAM_FAILED;
    *leaves_out =
        t->way->embree && (call == CLIFF_CAMERA || call == CLIFF_LIGHT) && !is_seen_by_embree(input, call, step);
    if (call == CLIFF_LIGHT) {
        const int code = make_points(input);
        *leaves_out |= !input->points[step].lights;
        return code != PROGRAM_OK || *leaves_out ? code : t->engine->aim(t, &input->points[step], 0);
    }
    if (call >= CLIFF_SINGLE && t->way->embree)
        *leaves_out = !input->is_for_embree;
    else if (call == CLIFF_SINGLE) /* right after a commit; AUTO may have a BVH for what follows */
        return t->engine->commit(t);
    else if (call > CLIFF_SINGLE && cgt_scene_prepare(t->scene, CGT_RAY_KIND_INCOHERENT) != CGT_OK)
        return bench_failed(s->context, "rays", CGT_ERROR_OUT_OF_MEMORY);
    return PROGRAM_OK;
}

static int run(cliffs_input *input, bench_tracer *t, cliff_call call, const bench_set *set)
{
    int code = PROGRAM_OK;
    if (call == CLIFF_COMMIT)
        return t->engine->commit(t);
    if (call != CLIFF_SINGLE || t->way->embree)
        return t->engine->trace(t, set, 0, set->rays.count, 0, &input->found, NULL);
    for (uint64_t i = 0; i < set->rays.count && code == PROGRAM_OK; i++)
        code = t->engine->trace(t, set, i, 1, 0, &input->found, NULL);
    return code;
}

static uint64_t count_hits(cliffs_input *input, bench_tracer *t, cliff_call call, const bench_set *set)
{
    const bool has_flags = call == CLIFF_LIGHT || call == CLIFF_OCCLUDED || (t->way->embree && call != CLIFF_CAMERA);
    uint64_t hits = 0;
    if (call == CLIFF_CAMERA)
        t->engine->planes(t, &input->found.planes);
    for (uint64_t i = 0; i < set->rays.count && call != CLIFF_COMMIT; i++)
        hits += has_flags ? input->found.occluded[i] : input->found.primitive[i] != CGT_INVALID_ID;
    return hits;
}

/* The shortest of a few runs that together stay within the limit. Of one thread the processor's time, which other
 * programs on the machine do not add to. */
static int measure_step(cliffs_input *input, bench_tracer *t, cliff_call call, uint32_t step, cliffs_times *times)
{
    const int is_one_thread = cgt_context_get_threads(input->session.context) == 1;
    const double limit = input->settings->limit_ms;
    double spent = 0, least = 0;
    bench_set set = {0};
    for (int k = 0; k < MOST_RUNS && (k == 0 || spent + least < limit); k++) {
        bool leaves_out;
        if (prepare(input, t, call, step, &leaves_out))
            return PROGRAM_FAILED;
        if (leaves_out)
            return PROGRAM_OK;
        set = set_of(input, call, step);
        const double begin = bench_clock_ms(is_one_thread);
        if (run(input, t, call, &set))
            return PROGRAM_FAILED;
        const double ms = bench_clock_ms(is_one_thread) - begin;
        least = k == 0 || ms < least ? ms : least;
        spent += ms;
    }
    times->hits[step] = count_hits(input, t, call, &set);
    times->rays[step] = call == CLIFF_COMMIT ? 0 : set.rays.count;
    times->ms[step] = least;
    times->steps = step + 1;
    return PROGRAM_OK;
}

static uint32_t steps_of(const bench_settings *settings, cliff_call call)
{
    if (call == CLIFF_COMMIT)
        return 1;
    return call == CLIFF_SINGLE && settings->steps > SINGLE_STEPS ? SINGLE_STEPS : settings->steps;
}

int cliffs_measure(cliffs_input *input, bench_tracer *t, cliffs_result *result)
{
    const bench_settings *s = input->settings;
    int code = PROGRAM_OK;
    memset(result, 0, sizeof *result);
    for (int call = 0; call < CLIFF_CALLS; call++) {
        cliffs_times *times = &result->call[call];
        if ((input->disturbed && !cliff_concerns(input->cliff, (cliff_call)call)) ||
            !bench_is_chosen(s->call, CLIFF_CALLS, call))
            continue;
        for (uint32_t k = 0; k < steps_of(s, (cliff_call)call) && k == times->steps && code == PROGRAM_OK &&
                             (k == 0 || 4 * times->ms[k - 1] <= s->limit_ms);
             k++)
            code = measure_step(input, t, (cliff_call)call, k, times);
    }
    return code;
}
