/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Embree as an independent reference: the shipped trajectory, closed meshes, real meshes and random scenes, pixel by
 * pixel. Where the two disagree, exact arithmetic decides. libcgt must be right each time; how often Embree is wrong
 * is printed. */
#include "support/test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "embree/embree_opinion.h"
#include "embree/embree_scene.h"
#include "embree/mesh_rays.h"
#include "structures/scenes/picture.h"
#include "structures/scenes/random_soup.h"
#include "hard_cases/hard_run.h"
#include "trajectory/trajectory.h"

#define WIDTH 240
#define HEIGHT 136

/* ---- comparison ---- */

typedef struct tally {
    uint64_t rays, hits, same, missed, invented, other, t_off;
} tally;

/* A scene for both ray casters and for the oracle. */
typedef struct subject {
    const hard_scene *scene;
    hard_truth truth; /* only the scene: the oracle runs where the two disagree */
    embree_scene embree;
} subject;

static subject subject_make(const hard_scene *s)
{
    subject w = {.scene = s};
    hard_scene without_rays = *s;
    without_rays.rays = 0;
    assert_true(hard_truth_make(&without_rays, &w.truth));
    assert_true(embree_scene_make(s, RTC_SCENE_FLAG_ROBUST, &w.embree));
    return w;
}

static void subject_free(subject *w)
{
    hard_truth_free(&w->truth);
    embree_scene_free(&w->embree);
}

static void fail_ray(const truth_ray *ray, const full_hit *cgt_hit, const full_hit *embree_hit, const char *what)
{
    fail_msg("%s: geometry %d, primitive %d at %a; Embree: geometry %d, primitive %d at %a; org %a %a %a dir %a %a %a",
             what, (int)cgt_hit->geometry, (int)cgt_hit->primitive, (double)cgt_hit->t, (int)embree_hit->geometry,
             (int)embree_hit->primitive, (double)embree_hit->t, (double)ray->org[0], (double)ray->org[1],
             (double)ray->org[2], (double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2]);
}

/* libcgt must give the hit of exact arithmetic; classifies Embree's answer. */
static void judge_difference(const subject *w, const truth_ray *ray, const full_hit *cgt_hit,
                             const full_hit *embree_hit, tally *sum)
{
    static const char *const name[] = {"right", "missed", "invented", "wrong"};
    oracle_hit exact;
    const oracle_verdict verdict = oracle_judge(&w->truth.scene, ray, cgt_hit->geometry, cgt_hit->primitive, &exact);
    if (verdict != ORACLE_RIGHT)
        fail_ray(ray, cgt_hit, embree_hit, name[verdict]);
    if (exact.index != ORACLE_NONE && oracle_ulp(exact.t, cgt_hit->t) > 0.51)
        fail_ray(ray, cgt_hit, embree_hit, "t is off");
    sum->missed += embree_hit->geometry == CGT_INVALID_ID;
    sum->invented += cgt_hit->geometry == CGT_INVALID_ID;
    sum->other += cgt_hit->geometry != CGT_INVALID_ID && embree_hit->geometry != CGT_INVALID_ID;
}

/* The same primitive with other numbers: libcgt must be within the bounds of cgt.h. In ROBUST, u and v are off by one
 * rounding plus what double loses on a triangle that is far away or seen edge-on: here less than another rounding. */
static void judge_values(const subject *w, const truth_ray *ray, const full_hit *cgt_hit, const full_hit *embree_hit,
                         tally *sum)
{
    oracle_hit exact = {.index = ORACLE_NONE};
    const oracle_primitive *named = opinion_named(&w->truth.scene, cgt_hit);
    if (!named || !oracle_hits(named, ray, &exact))
        fail_ray(ray, cgt_hit, embree_hit, "both are wrong");
    if (!(oracle_ulp(exact.t, cgt_hit->t) <= 0.51))
        fail_ray(ray, cgt_hit, embree_hit, "t is off");
    for (int k = 0; k < 2; k++)
        if (!(fabs((double)(exact.uv[k] - (truth_real)cgt_hit->uv[k])) <= 0x1p-23))
            fail_ray(ray, cgt_hit, embree_hit, "u or v is off");
    sum->t_off += oracle_ulp(exact.t, embree_hit->t) > 1;
}

static void judge(const subject *w, const truth_ray *ray, const full_hit *cgt_hit, tally *sum)
{
    const full_hit embree_hit = embree_trace(&w->embree, ray);
    const bool same = cgt_hit->geometry == embree_hit.geometry && cgt_hit->primitive == embree_hit.primitive;
    sum->rays++;
    sum->hits += cgt_hit->geometry != CGT_INVALID_ID;
    sum->same += same;
    if (!same)
        judge_difference(w, ray, cgt_hit, &embree_hit, sum);
    else if (cgt_hit->t != embree_hit.t || cgt_hit->uv[0] != embree_hit.uv[0] || cgt_hit->uv[1] != embree_hit.uv[1])
        judge_values(w, ray, cgt_hit, &embree_hit, sum);
}

/* Structures take turns from scene to scene. */
static const test_scene_options *next_structure(void)
{
    static const test_scene_options structure[] = {
        {.structure = CGT_STRUCTURE_KD},
        {.structure = CGT_STRUCTURE_QUEUE_GRID},
        {.structure = CGT_STRUCTURE_LOOSE_GRID},
        {.structure = CGT_STRUCTURE_BVH},
        {.structure = CGT_STRUCTURE_KD_ROPES},
        {.structure = CGT_STRUCTURE_KD, .kd_layout = CGT_KD_LAYOUT_MIXED},
        {.structure = CGT_STRUCTURE_KD_ROPES, .kd_layout = CGT_KD_LAYOUT_BREADTH_FIRST},
    };
    static size_t turn;
    return &structure[turn++ % TEST_COUNT(structure)];
}

/* Traces and compares a frame of the scene. */
static void compare(cgt_context *context, hard_scene *s, const cgt_camera *camera, tally *sum)
{
    picture q = picture_make(WIDTH, HEIGHT);
    cgt_scene *scene;
    const test_scene_options *next = next_structure();
    if (hard_commit_with(context, s, SCENE_OPTIONS(next), &scene) != CGT_OK)
        fail_msg("%s", context_message(context));
    picture_aim(s, camera, WIDTH, HEIGHT);
    picture_trace(scene, camera, NULL, &q);
    subject w = subject_make(s);
    for (uint32_t i = 0; i < s->rays; i++)
        judge(&w, &s->ray[i], &q.hit[i], sum);
    subject_free(&w);
    cgt_scene_release(scene);
    picture_free(&q);
}

/* share: at most one ray in `share` may differ. Two ray casters agree nearly everywhere on the same scene; if not, one
 * of them sees another scene. */
static void print_tally(const char *what, const tally *t, uint64_t share)
{
    print_message("%s: %llu rays, %llu hits; Embree: %llu same, %llu missed, %llu invented, %llu another primitive, "
                  "%llu of the same with t beyond 1 ulp\n",
                  what, (unsigned long long)t->rays, (unsigned long long)t->hits, (unsigned long long)t->same,
                  (unsigned long long)t->missed, (unsigned long long)t->invented, (unsigned long long)t->other,
                  (unsigned long long)t->t_off);
    assert_true(t->hits > t->rays / 200);
    assert_true(t->same > t->rays - t->rays / share);
    assert_int_equal(t->same + t->missed + t->invented + t->other, t->rays);
}

/* ---- scenes ---- */

static hard_scene scene_of_spheres(const float (*sphere)[4], uint32_t count)
{
    hard_scene s = {.place = {.scale = 1}};
    for (uint32_t i = 0; i < count; i++)
        hard_raw_sphere(&s, sphere[i]);
    assert_false(s.failed);
    return s;
}

static cgt_camera look(const float eye[3], const float target[3], const float up[3], float fov)
{
    cgt_camera camera;
    cgt_camera_init(&camera);
    memcpy(camera.eye, eye, sizeof camera.eye);
    memcpy(camera.target, target, sizeof camera.target);
    memcpy(camera.up, up, sizeof camera.up);
    camera.fov = fov;
    return camera;
}

static void trajectory_frames(void **state)
{
    (void)state;
    char error[512] = "";
    trajectory *file = trajectory_open(CGT_DATA_DIR "/pour2k.lammpstrj", NULL, error, sizeof error);
    if (!file)
        fail_msg("%s", error);
    cgt_context *context = context_make(2, NULL);
    trajectory_frame f;
    tally sum = {0};
    while (trajectory_read(file, &f, error, sizeof error) == 1) {
        if (f.number % 12 != 3)
            continue;
        const cgt_camera camera =
            look((float[3]){30 - 0.2f * (float)f.number, -18, 14}, (float[3]){10, 6, 4}, (float[3]){0, 0, 1}, 40);
        hard_scene s = scene_of_spheres((const float(*)[4])f.xyzr, f.count);
        compare(context, &s, &camera, &sum);
        hard_scene_free(&s);
    }
    assert_string_equal(error, "");
    assert_int_equal(sum.rays, 7 * WIDTH * HEIGHT);
    print_tally("trajectory", &sum, 200);
    cgt_context_release(context);
    trajectory_close(file);
}

static void random_spheres(void **state)
{
    (void)state;
    static const cloud_kind kind[] = {CLOUD_UNIFORM, CLOUD_CLUSTERED, CLOUD_PLANAR, CLOUD_MIXED};
    cgt_context *context = context_make(2, NULL);
    for (size_t k = 0; k < TEST_COUNT(kind); k++) {
        tally sum = {0};
        for (uint32_t round = 0; round < test_scaled(2); round++) {
            test_random r = random_make(round * TEST_COUNT(kind) + k);
            cloud c = cloud_make(&r, kind[k], 2000);
            float d[3], eye[3], up[3];
            random_direction(&r, d);
            random_direction(&r, up);
            for (int a = 0; a < 3; a++)
                eye[a] = c.middle[a] + 3 * c.reach * d[a];
            const cgt_camera camera = look(eye, c.middle, up, 45);
            hard_scene s = scene_of_spheres((const float(*)[4])c.sphere, c.count);
            compare(context, &s, &camera, &sum);
            hard_scene_free(&s);
            cloud_free(&c);
        }
        print_tally(cloud_name(kind[k]), &sum, 200);
    }
    cgt_context_release(context);
}

/* Views from inside and outside, near the origin and where float is coarse. */
static void closed_meshes(void **state)
{
    (void)state;
    static const hard_place place[] = {HARD_HERE, HARD_FAR};
    cgt_context *context = context_make(2, NULL);
    for (int kind = 0; kind < CLOSED_KINDS; kind++) {
        tally sum = {0};
        for (uint32_t i = 0; i < 4; i++) {
            hard_scene s = {.place = place[i / 2], .random = random_make(100 * (uint64_t)kind + i)};
            double from[3], to[3];
            float eye[3], target[3], up[3];
            hard_closed_mesh(&s, (closed_kind)kind, 24);
            closed_mesh_inside(&(closed_mesh){.kind = (closed_kind)kind}, &s.random, from);
            hard_direction(&s, to);
            for (int a = 0; a < 3; a++) {
                to[a] += from[a];
                if (i % 2) /* the other way round, from farther out */
                    to[a] = 4 * to[a] - 3 * from[a];
            }
            hard_put(&s, i % 2 ? to : from, eye);
            hard_put(&s, i % 2 ? from : to, target);
            random_direction(&s.random, up);
            const cgt_camera camera = look(eye, target, up, i % 2 ? 45 : 90);
            const uint64_t hits = sum.hits;
            compare(context, &s, &camera, &sum);
            if (i % 2 == 0 && sum.hits - hits != WIDTH * HEIGHT)
                fail_msg("%s: %llu of %u pixels hit from inside", closed_mesh_name((closed_kind)kind),
                         (unsigned long long)(sum.hits - hits), WIDTH * HEIGHT);
            hard_scene_free(&s);
        }
        print_tally(closed_mesh_name((closed_kind)kind), &sum, 20);
    }
    cgt_context_release(context);
}

static void random_triangles(void **state)
{
    (void)state;
    cgt_context *context = context_make(2, NULL);
    for (int kind = 0; kind < SOUP_KINDS; kind++) {
        tally sum = {0};
        for (uint32_t round = 0; round < test_scaled(2); round++) {
            hard_scene s = soup_make((soup_kind)kind, 5000 + 10 * (uint64_t)kind + round, 2000);
            cgt_camera camera = soup_camera(&s);
            camera.fov = 70;
            compare(context, &s, &camera, &sum);
            hard_scene_free(&s);
        }
        print_tally(soup_name((soup_kind)kind), &sum, 20);
    }
    cgt_context_release(context);
}

/* ---- real meshes ---- */

typedef struct real_mesh {
    const char *path, *name, *package;
    float eye[3], target[3]; /* relative to the bounds */
} real_mesh;

static const real_mesh meshes[] = {
    {"/usr/share/glmark2/models/bunny.obj", "bunny", "glmark2-data", {0.7f, 0.8f, 2.6f}, {0.5f, 0.45f, 0.5f}},
    {"/usr/share/glmark2/models/cat.3ds", "cat", "glmark2-data", {2.1f, 0.7f, 1.9f}, {0.5f, 0.5f, 0.5f}},
    {"/usr/share/assimp/models/OBJ/spider.obj", "spider", "assimp-testmodels", {0.9f, 2.6f, 1.7f}, {0.5f, 0.4f, 0.5f}},
    {"/usr/share/assimp/models/OBJ/WusonOBJ.obj", "Wuson", "assimp-testmodels", {1.5f, 0.8f, 2.2f}, {0.5f, 0.5f, 0.5f}},
    {"/usr/share/assimp/models/IFC/AC14-FZK-Haus.ifc",
     "house from inside",
     "assimp-testmodels",
     {0.45f, 0.25f, 0.4f},
     {0.9f, 0.28f, 0.7f}}};

/* The same picture through each kd-tree, ray by ray and in packets: where one is right, the others return the same
 * bits. */
static void compare_trees(cgt_context *context, hard_scene *s, const cgt_camera *camera, tally *sum)
{
    static const cgt_structure structure[] = {CGT_STRUCTURE_KD, CGT_STRUCTURE_KD_ROPES};
    static const cgt_kd_traversal traversal[] = {CGT_KD_TRAVERSAL_SINGLE, CGT_KD_TRAVERSAL_PACKET};
    picture q = picture_make(WIDTH, HEIGHT);
    full_hit *first = NULL;
    picture_aim(s, camera, WIDTH, HEIGHT);
    subject w = subject_make(s);
    for (int way = 0; way < 4; way++) {
        const test_scene_options options = {.structure = structure[way / 2]};
        const test_trace_options trace = {.kd_traversal = traversal[way % 2]};
        cgt_scene *scene;
        if (hard_commit_with(context, s, SCENE_OPTIONS(&options), &scene) != CGT_OK)
            fail_msg("%s", context_message(context));
        picture_trace(scene, camera, TRACE_OPTIONS(&trace), &q);
        cgt_scene_release(scene);
        if (first) {
            for (uint32_t i = 0; i < s->rays; i++)
                if (memcmp(&first[i], &q.hit[i], sizeof q.hit[i]) != 0)
                    fail_ray(&s->ray[i], &q.hit[i], &first[i], "differs from the first kd-tree, here under Embree");
            continue;
        }
        for (uint32_t i = 0; i < s->rays; i++)
            judge(&w, &s->ray[i], &q.hit[i], sum);
        first = malloc((s->rays + (size_t)1) * sizeof *first);
        assert_non_null(first);
        memcpy(first, q.hit, s->rays * sizeof *first);
    }
    free(first);
    subject_free(&w);
    picture_free(&q);
}

static void real_meshes(void **state)
{
    (void)state;
    uint32_t available = 0;
    cgt_context *context = context_make(2, NULL);
    for (size_t i = 0; i < TEST_COUNT(meshes); i++) {
        tally sum = {0};
        hard_scene s;
        if (!mesh_is_here(meshes[i].path)) {
            print_message("%s comes with the package %s\n", meshes[i].name, meshes[i].package);
            continue;
        }
        assert_true(mesh_read(meshes[i].path, 1, &s));
        const cgt_camera camera = mesh_camera(&s, meshes[i].eye, meshes[i].target);
        compare_trees(context, &s, &camera, &sum);
        print_tally(meshes[i].name, &sum, 20);
        hard_scene_free(&s);
        available++;
    }
    cgt_context_release(context);
    if (!available)
        skip();
}

/* Rays from far away at the outlines of spheres, where single precision cannot decide. */
static void outlines_from_afar(void **state)
{
    (void)state;
    const uint32_t count = test_scaled(30000);
    test_random r = random_make(1000);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 300);
    hard_scene s = scene_of_spheres((const float(*)[4])c.sphere, c.count);
    cgt_context *context = context_make(2, NULL);
    cgt_scene *scene;
    const test_scene_options *next = next_structure();
    assert_int_equal(hard_commit_with(context, &s, SCENE_OPTIONS(next), &scene), CGT_OK);
    subject w = subject_make(&s);
    tally sum = {0};
    for (uint32_t i = 0; i < count; i++) {
        const float *q = c.sphere[random_below(&r, c.count)];
        truth_ray ray = {.t_min = 0, .t_max = INFINITY};
        float d[3], e[3];
        double de = 0, ee = 0;
        random_direction(&r, d);
        random_direction(&r, e);
        for (int a = 0; a < 3; a++)
            de += (double)d[a] * e[a];
        for (int a = 0; a < 3; a++)
            ee += (e[a] - de * d[a]) * (e[a] - de * d[a]);
        const double away = random_log(&r, 10, 1e4f) * c.reach,
                     rim = q[3] * (1 + random_float(&r, -1e-5f, 1e-5f)) / sqrt(ee);
        for (int a = 0; a < 3; a++) {
            ray.org[a] = (float)(q[a] - away * d[a]);
            ray.dir[a] = (float)(q[a] + rim * (e[a] - de * d[a]) - ray.org[a]);
        }
        full_hit hit;
        assert_int_equal(trace_array(scene, &ray, 1, &hit, NULL), CGT_OK);
        judge(&w, &ray, &hit, &sum);
    }
    print_message("outlines from afar: %llu rays, %llu hits; Embree: %llu missed, %llu invented, %llu another sphere\n",
                  (unsigned long long)sum.rays, (unsigned long long)sum.hits, (unsigned long long)sum.missed,
                  (unsigned long long)sum.invented, (unsigned long long)sum.other);
    assert_true(sum.hits > count / 3);
    assert_true(sum.missed + sum.invented + sum.other > 0); /* the rays were hard */
    subject_free(&w);
    hard_scene_free(&s);
    cgt_scene_release(scene);
    cgt_context_release(context);
    cloud_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(trajectory_frames), cmocka_unit_test(random_spheres),
                                       cmocka_unit_test(closed_meshes),     cmocka_unit_test(random_triangles),
                                       cmocka_unit_test(real_meshes),       cmocka_unit_test(outlines_from_afar)};
    test_begin("oracle_embree");
    if (!embree_begin())
        return 1;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    embree_end();
    return failed;
}
