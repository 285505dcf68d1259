/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * libcgt beside Embree: the same rays through Embree's default mode, Embree's robust mode, and libcgt, on every hard
 * case, on pictures of the shipped trajectory, of clouds, closed meshes and random triangles, and on real meshes. The
 * exact oracle judges all of them. libcgt must decide all rays correctly, and its errors may nowhere exceed Embree's.
 *
 *   CGT_TABLE  file that gets the table, tab-separated; standard output gets it anyway */
#include "support/test.h"
#include "support/trajectory_told.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "embree/embree_opinion.h"
#include "embree/embree_scene.h"
#include "embree/mesh_rays.h"
#include "structures/scenes/picture.h"
#include "structures/scenes/random_soup.h"
#include <cgt/trajectory.h>

#define RAYS 1000u
#define LEAST_RAYS 400u
#define MOST_TESTS 256
#define WIDTH 64u /* of pictures */
#define HEIGHT 36u

/* The nearer of the two floats around the exact value is at most half an ulp off. cgt.h promises 0.51 ulp for t, so its
 * error may exceed that of the luckier of two neighbouring floats by 0.02. */
#define ALLOWANCE 0.02

enum { EMBREE, EMBREE_ROBUST, LIBCGT, CONFIGS };

static const char *const config_name[CONFIGS] = {"embree", "embree,robust", "libcgt"};

static FILE *table;
static hard_tally sum[CONFIGS];
static uint64_t tied[CONFIGS];

/* ---- answers ---- */

static void ask_embree(const hard_scene *s, enum RTCSceneFlags flags, full_hit *hit)
{
    embree_scene scene;
    assert_true(embree_scene_make(s, flags, &scene));
    for (uint32_t i = 0; i < s->rays; i++)
        hit[i] = embree_trace(&scene, &s->ray[i]);
    embree_scene_free(&scene);
}

/* Structures take turns from scene to scene. */
static void ask_libcgt(const hard_scene *s, full_hit *hit)
{
    static uint32_t turn;
    const cgt_scene_options made = structure_in_turn(turn++);
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene;
    if (hard_commit_with(context, s, &made, &scene) != CGT_OK)
        fail_msg("%s", context_message(context));
    memset(hit, 0x77, s->rays * sizeof *hit);
    assert_int_equal(trace_array(scene, s->ray, s->rays, hit, NULL), CGT_OK);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- requirements ---- */

static void check_right(const opinion *o, uint32_t rays)
{
    opinion_quantiles t;
    if (hard_errors(&o->tally) || o->tied)
        fail_msg("%s: %llu missed, %llu invented, %llu wrong, %llu ties not to the lowest id", o->config,
                 (unsigned long long)o->tally.missed, (unsigned long long)o->tally.invented,
                 (unsigned long long)o->tally.wrong, (unsigned long long)o->tied);
    assert_true(opinion_quantiles_of(o->t_error, NULL, rays, &t));
    if (t.worst > 0.51)
        fail_msg("%s: t is %g ulp off", o->config, t.worst);
}

/* Where a t rounds to the end of the range, two different hits may both be right, and their t cannot be compared. */
static bool is_same_hit(const opinion *a, const opinion *b, uint32_t i)
{
    return fabs(a->exact_t[i] - b->exact_t[i]) <= 0x1p-40 * fabs(a->exact_t[i]);
}

/* No error in the table is larger than Embree's: t ray by ray; for u and v, the median, 99th percentile and maximum
 * over the rays where both found the same triangle. */
static void check_not_worse(const opinion *cgt, const opinion *embree, uint32_t rays)
{
    uint8_t *matching = calloc((size_t)rays + 1, 1);
    opinion_quantiles a, b;
    assert_non_null(matching);
    for (uint32_t i = 0; i < rays; i++) {
        if (is_same_hit(cgt, embree, i) && cgt->t_error[i] > embree->t_error[i] + ALLOWANCE)
            fail_msg("ray %u: t is %g ulp off in %s, %g in %s", i, cgt->t_error[i], cgt->config, embree->t_error[i],
                     embree->config);
        matching[i] = is_same_hit(cgt, embree, i) && cgt->hit[i].geometry == embree->hit[i].geometry &&
                      cgt->hit[i].primitive == embree->hit[i].primitive;
    }
    assert_true(opinion_quantiles_of(cgt->uv_error, matching, rays, &a));
    assert_true(opinion_quantiles_of(embree->uv_error, matching, rays, &b));
    if (a.median > b.median + ALLOWANCE || a.p99 > b.p99 + ALLOWANCE || a.worst > b.worst + ALLOWANCE)
        fail_msg("u, v in 2^-24 where both hit the same: %g, %g, %g in %s, %g, %g, %g in %s", a.median, a.p99, a.worst,
                 cgt->config, b.median, b.p99, b.worst, embree->config);
    free(matching);
}

/* ---- one scene ---- */

static void print_rows(const char *row, const char *name, const opinion *o, uint32_t rays, const char *left_out)
{
    assert_true(opinion_print_row(stdout, row, name, o, rays, left_out));
    if (table)
        assert_true(opinion_print_row(table, row, name, o, rays, left_out));
}

/* first: the first of the configurations to run. Returns what Embree's robust mode found, or nothing. */
static hard_tally compare(const char *row, const char *name, const hard_scene *s, int first, const char *left_out)
{
    opinion o[CONFIGS] = {{.hit = NULL}};
    hard_truth truth;
    assert_true(hard_truth_make(s, &truth));
    for (int i = first; i < CONFIGS; i++) {
        assert_true(opinion_make(&o[i], config_name[i], s->rays));
        if (i == LIBCGT)
            ask_libcgt(s, o[i].hit);
        else
            ask_embree(s, i == EMBREE ? RTC_SCENE_FLAG_NONE : RTC_SCENE_FLAG_ROBUST, o[i].hit);
        opinion_judge(&o[i], s, &truth);
        print_rows(row, name, &o[i], s->rays, left_out);
        sum[i].rays += o[i].tally.rays;
        sum[i].hits += o[i].tally.hits;
        sum[i].missed += o[i].tally.missed;
        sum[i].invented += o[i].tally.invented;
        sum[i].wrong += o[i].tally.wrong;
        tied[i] += o[i].tied;
    }
    fflush(stdout);
    check_right(&o[LIBCGT], s->rays);
    for (int embree = first; embree < LIBCGT; embree++)
        check_not_worse(&o[LIBCGT], &o[embree], s->rays);
    const hard_tally robust = o[EMBREE_ROBUST].tally;
    for (int i = first; i < CONFIGS; i++)
        opinion_free(&o[i]);
    hard_truth_free(&truth);
    return robust;
}

/* Runs the whole scene and, where it differs, the scene without the input that Embree does not accept. */
static hard_tally compare_both(const char *row, const char *name, const hard_scene *s)
{
    embree_part part;
    char left_out[96] = "-";
    assert_false(s->failed);
    assert_true(embree_part_make(s, &part));
    if (part.primitives || part.rays) {
        compare(row, name, s, LIBCGT, "-");
        snprintf(left_out, sizeof left_out, "%u of %u primitives, %u of %u rays", (unsigned)part.primitives,
                 (unsigned)hard_scene_primitives(s), (unsigned)part.rays, (unsigned)s->rays);
    }
    const hard_tally robust = compare(row, name, &part.scene, EMBREE, left_out);
    hard_scene_free(&part.scene);
    return robust;
}

static uint32_t ray_count(void)
{
    const uint32_t scaled = test_scaled(RAYS);
    return scaled < LEAST_RAYS ? LEAST_RAYS : scaled;
}

static void test_case(void **state)
{
    const hard_case *hard = *state;
    hard_scene s;
    assert_true(hard_case_make(hard, ray_count(), &s));
    cgt_context *context = context_make(1, NULL);
    assert_int_equal(hard_follow(context, hard, &s), CGT_OK);
    cgt_context_release(context);
    compare_both(hard->row, hard->name, &s);
    hard_scene_free(&s);
}

/* ---- pictures ---- */

static cgt_camera look(const float eye[3], const float target[3], const float up[3], float fov)
{
    cgt_camera camera = {.fov = fov};
    memcpy(camera.eye, eye, sizeof camera.eye);
    memcpy(camera.target, target, sizeof camera.target);
    memcpy(camera.up, up, sizeof camera.up);
    return camera;
}

/* Compares a picture of the scene, and frees it. Two ray casters agree nearly everywhere; if not, one of them sees
 * another scene. Returns the number of hits. */
static uint64_t take_picture(const char *name, hard_scene *s, const cgt_camera *camera)
{
    picture_aim(s, camera, WIDTH, HEIGHT);
    const hard_tally robust = compare_both("picture", name, s);
    assert_true(robust.hits > s->rays / 200 && hard_errors(&robust) < s->rays / 20 + 1);
    hard_scene_free(s);
    return robust.hits;
}

static hard_scene scene_of_spheres(const float (*sphere)[4], uint32_t count)
{
    hard_scene s = {.place = {.scale = 1}};
    for (uint32_t i = 0; i < count; i++)
        hard_raw_sphere(&s, sphere[i]);
    return s;
}

static void trajectory_frames(void **state)
{
    (void)state;
    char error[512] = "";
    cgt_trajectory *file = told_open(CGT_DATA_DIR "/pour2k.lammpstrj", NULL, error, sizeof error);
    cgt_trajectory_frame f;
    uint32_t frames = 0;
    if (!file)
        fail_msg("%s", error);
    while (told_read(file, &f, error, sizeof error) == 1) {
        if (f.number % 12 != 3)
            continue;
        const cgt_camera camera =
            look((float[3]){30 - 0.2f * (float)f.number, -18, 14}, (float[3]){10, 6, 4}, (float[3]){0, 0, 1}, 40);
        hard_scene s = scene_of_spheres((const float(*)[4])f.xyzr, f.count);
        take_picture("trajectory", &s, &camera);
        frames++;
    }
    assert_string_equal(error, "");
    assert_int_equal(frames, 7);
    cgt_trajectory_close(file);
}

static void clouds(void **state)
{
    (void)state;
    static const cloud_kind kind[] = {CLOUD_UNIFORM, CLOUD_CLUSTERED, CLOUD_PLANAR, CLOUD_MIXED};
    for (size_t k = 0; k < TEST_COUNT(kind); k++) {
        test_random r = random_make(k);
        cloud c = cloud_make(&r, kind[k], 2000);
        float d[3], eye[3], up[3];
        random_direction(&r, d);
        random_direction(&r, up);
        for (int a = 0; a < 3; a++)
            eye[a] = c.middle[a] + 3 * c.reach * d[a];
        const cgt_camera camera = look(eye, c.middle, up, 45);
        hard_scene s = scene_of_spheres((const float(*)[4])c.sphere, c.count);
        take_picture(cloud_name(kind[k]), &s, &camera);
        cloud_free(&c);
    }
}

/* Views from inside, where all pixels hit, and outside, near the origin and where float is coarse. */
static void closed_meshes(void **state)
{
    (void)state;
    static const hard_place place[] = {HARD_HERE, HARD_FAR};
    for (int kind = 0; kind < CLOSED_KINDS; kind++)
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
            const uint64_t hits = take_picture(closed_mesh_name((closed_kind)kind), &s, &camera);
            assert_true(i % 2 || hits == WIDTH * HEIGHT);
        }
}

static void random_triangles(void **state)
{
    (void)state;
    for (int kind = 0; kind < SOUP_KINDS; kind++) {
        hard_scene s = soup_make((soup_kind)kind, 5000 + 10 * (uint64_t)kind, 2000);
        cgt_camera camera = soup_camera(&s);
        camera.fov = 70;
        take_picture(soup_name((soup_kind)kind), &s, &camera);
    }
}

/* Rays from far away at the outlines of spheres, where single precision cannot decide. */
static void outlines_from_afar(void **state)
{
    (void)state;
    test_random r = random_make(1000);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 300);
    hard_scene s = scene_of_spheres((const float(*)[4])c.sphere, c.count);
    for (s.wanted = 2 * ray_count(); hard_wants_ray(&s);) {
        const float *q = c.sphere[random_below(&r, c.count)];
        float org[3], target[3], d[3], e[3];
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
            org[a] = (float)(q[a] - away * d[a]);
            target[a] = (float)(q[a] + rim * (e[a] - de * d[a]));
        }
        hard_aim(&s, org, target, 1);
    }
    const hard_tally robust = compare_both("picture", "outlines from afar", &s);
    assert_true(robust.hits > s.rays / 3 && hard_errors(&robust) > 0); /* the rays were hard */
    hard_scene_free(&s);
    cloud_free(&c);
}

/* ---- real meshes ---- */

typedef struct real_mesh {
    const char *path, *name, *package;
    float eye[3], target[3]; /* relative to the bounds */
} real_mesh;

static const real_mesh meshes[] = {
    {"/usr/share/glmark2/models/bunny.obj", "bunny", "glmark2-data", {0.7f, 0.8f, 2.6f}, {0.5f, 0.45f, 0.5f}},
    {"/usr/share/glmark2/models/horse.3ds", "horse", "glmark2-data", {2.1f, 0.6f, 1.9f}, {0.5f, 0.5f, 0.5f}},
    {"/usr/share/assimp/models/OBJ/spider.obj", "spider", "assimp-testmodels", {0.9f, 2.6f, 1.7f}, {0.5f, 0.4f, 0.5f}},
    {"/usr/share/assimp/models/OBJ/WusonOBJ.obj", "Wuson", "assimp-testmodels", {1.5f, 0.8f, 2.2f}, {0.5f, 0.5f, 0.5f}},
    {"/usr/share/assimp/models/IFC/AC14-FZK-Haus.ifc",
     "house from inside",
     "assimp-testmodels",
     {0.45f, 0.25f, 0.4f},
     {0.9f, 0.28f, 0.7f}}};

static void test_mesh(void **state)
{
    const real_mesh *mesh = *state;
    hard_scene s;
    char name[64];
    if (!mesh_is_here(mesh->path)) {
        print_message("%s comes with the package %s\n", mesh->name, mesh->package);
        skip();
    }
    assert_true(mesh_read(mesh->path, ray_count(), &s));
    assert_true(mesh_aim_pixels(&s, mesh->eye, mesh->target));
    snprintf(name, sizeof name, "%s, pixels", mesh->name);
    compare_both("real mesh", name, &s);
    s.rays = 0;
    mesh_aim_edges(&s);
    snprintf(name, sizeof name, "%s, edges and vertices", mesh->name);
    compare_both("real mesh", name, &s);
    hard_scene_free(&s);
}

/* ---- totals ---- */

/* The totals; they also show that the rays are hard: single precision cannot decide all of them. */
static void test_sums(void **state)
{
    (void)state;
    for (int i = 0; i < CONFIGS; i++) {
        const opinion o = {.config = config_name[i], .tally = sum[i], .tied = tied[i]};
        print_rows("all rows", "all cases", &o, 0, "-");
    }
    assert_true(hard_errors(&sum[EMBREE]) > 0 && hard_errors(&sum[EMBREE_ROBUST]) > 0);
    assert_true(sum[EMBREE].hits > sum[EMBREE].rays / 4);
    /* two ray casters agree on most rays of the same scenes; if not, one of them sees other scenes */
    assert_true(hard_errors(&sum[EMBREE_ROBUST]) < sum[EMBREE_ROBUST].rays / 4);
}

static int run(void)
{
    static const struct CMUnitTest pictures[] = {cmocka_unit_test(trajectory_frames), cmocka_unit_test(clouds),
                                                 cmocka_unit_test(closed_meshes), cmocka_unit_test(random_triangles),
                                                 cmocka_unit_test(outlines_from_afar)};
    static struct CMUnitTest tests[MOST_TESTS];
    static char name[MOST_TESTS][160];
    const size_t cases = hard_case_count();
    size_t count = 0;
    if (cases + TEST_COUNT(meshes) + TEST_COUNT(pictures) + 1 > MOST_TESTS) {
        fprintf(stderr, "%zu cases are more than there is room for\n", cases);
        return 1;
    }
    for (; count < cases; count++) {
        const hard_case *hard = hard_case_at(count);
        snprintf(name[count], sizeof name[count], "%s: %s", hard->row, hard->name);
        tests[count] =
            (struct CMUnitTest){.name = name[count], .test_func = test_case, .initial_state = (void *)(uintptr_t)hard};
    }
    for (size_t i = 0; i < TEST_COUNT(meshes); i++)
        tests[count++] = (struct CMUnitTest){
            .name = meshes[i].name, .test_func = test_mesh, .initial_state = (void *)(uintptr_t)&meshes[i]};
    for (size_t i = 0; i < TEST_COUNT(pictures); i++)
        tests[count++] = pictures[i];
    tests[count++] = (struct CMUnitTest)cmocka_unit_test(test_sums);
    opinion_print_head(stdout);
    if (table)
        opinion_print_head(table);
    return _cmocka_run_group_tests("beside Embree", tests, count, NULL, NULL);
}

int main(void)
{
    const char *path = getenv("CGT_TABLE");
    test_begin("oracle_embree");
    if (path && *path) {
        table = fopen(path, "w");
        if (!table) {
            perror(path);
            return 1;
        }
    }
    if (!embree_begin())
        return 1;
    int failed = run();
    embree_end();
    if (table && (ferror(table) | fclose(table))) {
        fprintf(stderr, "%s: the table was not written\n", path);
        failed = 1;
    }
    return failed;
}
