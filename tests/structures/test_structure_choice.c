/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which structure a scene gets: the requested one, also when it changes between commits; and what AUTO chooses, with
 * its reason. */
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "structures/scenes/picture.h"
#include "structures/scenes/random_soup.h"
#include "support/closed_meshes.h"
#include "hard_cases/hard_run.h"

#define WIDTH 45u
#define HEIGHT 31u

static test_scene_options of_structure(cgt_structure structure)
{
    test_scene_options o = {0};
    o.structure = structure;
    return o;
}

static cgt_scene_statistics statistics_of(const cgt_scene *scene)
{
    cgt_scene_statistics st;
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    return st;
}

/* ---- from one structure to another ---- */

/* Scales half of the coordinates, so that the shape of the scene changes with its size. */
static void move(hard_scene *s, float factor)
{
    for (uint32_t g = 0; g < s->geometries; g++) {
        for (uint32_t i = 0; i < s->geometry[g].spheres; i++)
            s->geometry[g].sphere[i][i % 3] *= factor;
        for (uint32_t i = 0; i < s->geometry[g].vertices; i++)
            s->geometry[g].vertex[i][i % 3] *= factor;
    }
}

static void check_as_one_cell(cgt_context *context, const hard_scene *s, const cgt_scene *scene,
                              const cgt_camera *camera, picture q[2])
{
    cgt_scene *fresh;
    if (hard_commit_with(context, s, SCENE_OPTIONS(&one_cell.scene), &fresh) != CGT_OK)
        fail_msg("%s", context_message(context));
    picture_trace(scene, camera, NULL, &q[0]);
    picture_trace(fresh, camera, NULL, &q[1]);
    assert_memory_equal(q[0].hit, q[1].hit, WIDTH * HEIGHT * sizeof *q[0].hit);
    cgt_scene_release(fresh);
}

/* One scene through many commits: other options, moved data, both, or an error in between. */
TEST(a_scene_changes_its_structure)
{
    static const cgt_structure first[] = {CGT_STRUCTURE_AUTO,       CGT_STRUCTURE_QUEUE_GRID, CGT_STRUCTURE_KD,
                                          CGT_STRUCTURE_AUTO,       CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_KD_ROPES,
                                          CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_BVH}; /* the fourth is not set */
    const uint32_t steps = 8 + test_scaled(72);
    cgt_context *context = context_make(2, NULL);
    hard_scene s = soup_make(SOUP_MIXED, 17, 700);
    picture q[2] = {picture_make(WIDTH, HEIGHT), picture_make(WIDTH, HEIGHT)};
    test_random r = random_make(4711);
    test_scene_options o = of_structure(CGT_STRUCTURE_KD_ROPES);
    uint32_t built[CGT_STRUCTURE_BIH + 1] = {0};
    cgt_scene *scene;
    assert_int_equal(hard_commit_with(context, &s, SCENE_OPTIONS(&o), &scene), CGT_OK);
    for (uint32_t step = 0; step < steps; step++) {
        const cgt_camera camera = soup_camera(&s);
        if (step % 4 != 3) {
            o = structure_random(&r);
            o.structure = step < TEST_COUNT(first) ? first[step] : o.structure;
            assert_int_equal(cgt_scene_set_options(scene, SCENE_OPTIONS(&o)), CGT_OK);
        }
        if (step % 3)
            move(&s, step % 2 ? 0.75f : 1.25f);
        const cgt_frame frame = frame_of(&q[0].p);
        if (step % 4 != 3)
            assert_int_equal(cgt_trace_camera(scene, &camera, &frame, NULL), CGT_ERROR_NOT_COMMITTED);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        const cgt_scene_statistics st = statistics_of(scene);
        const cgt_research_scene_statistics research = research_of(scene);
        assert_true(o.structure == CGT_STRUCTURE_AUTO || st.structure == o.structure);
        const bool tree = st.structure == CGT_STRUCTURE_KD || st.structure == CGT_STRUCTURE_KD_ROPES;
        assert_int_equal(research.kd_leaves != 0, tree);
        const bool wide = st.structure == CGT_STRUCTURE_BVH;
        assert_int_equal(research.bvh_leaves != 0, wide);
        const bool intervals = st.structure == CGT_STRUCTURE_BIH;
        assert_int_equal(research.bih_leaves != 0, intervals);
        assert_int_equal(research.cells == 0, tree || wide || intervals);
        assert_int_equal(research.levels != 0, st.structure == CGT_STRUCTURE_LOOSE_GRID);
        built[st.structure]++;
        check_as_one_cell(context, &s, scene, &camera, q);
    }
    for (uint32_t k = 1; k <= TEST_STRUCTURES; k++)
        assert_true(built[k] > 0);
    for (int k = 0; k < 2; k++)
        picture_free(&q[k]);
    cgt_scene_release(scene);
    hard_scene_free(&s);
    cgt_context_release(context);
}

/* ---- what AUTO chooses ---- */

/* Commits with AUTO, and checks the hits. */
static cgt_structure choose(const hard_scene *s, cgt_ray_kind rays, uint32_t *levels)
{
    cgt_context *context = context_make(1, NULL);
    test_scene_options o = of_structure(CGT_STRUCTURE_AUTO);
    const cgt_camera camera = camera_before(&(cloud){.reach = 1});
    picture q[2] = {picture_make(WIDTH, HEIGHT), picture_make(WIDTH, HEIGHT)};
    cgt_scene *scene;
    o.rays = rays;
    assert_int_equal(hard_commit_with(context, s, SCENE_OPTIONS(&o), &scene), CGT_OK);
    check_as_one_cell(context, s, scene, &camera, q);
    const cgt_scene_statistics st = statistics_of(scene);
    print_message("%s\n", st.reason);
    assert_true(st.reason[0] && memchr(st.reason, 0, sizeof st.reason));
    assert_int_equal(strstr(st.reason, "kd-tree") != NULL, research_of(scene).kd_leaves != 0);
    *levels = research_of(scene).levels;
    picture_free(&q[0]);
    picture_free(&q[1]);
    cgt_scene_release(scene);
    cgt_context_release(context);
    return st.structure;
}

/* An even cloud of small spheres. */
static hard_scene even_cloud(uint32_t count)
{
    hard_scene s = {.place = {.scale = 1}, .random = random_make(5)};
    for (uint32_t i = 0; i < count; i++) {
        double center[3];
        hard_point(&s, -1, 1, center);
        hard_sphere(&s, center, 0.02);
    }
    assert_false(s.failed);
    return s;
}

TEST(incoherent_rays_get_a_tree)
{
    hard_scene s = even_cloud(2000);
    uint32_t levels;
    assert_int_equal(choose(&s, CGT_RAY_KIND_INCOHERENT, &levels), CGT_STRUCTURE_BVH);
    assert_int_equal(choose(&s, CGT_RAY_KIND_COHERENT, &levels), CGT_STRUCTURE_LOOSE_GRID);
    hard_scene_free(&s);
}

/* A fine mesh in a coarse one that is hundreds of times as large. */
TEST(a_teapot_in_a_stadium_gets_a_level_of_its_own)
{
    hard_scene s = {.place = {.scale = 1}, .random = random_make(6)};
    closed_mesh stadium, teapot;
    assert_true(closed_mesh_make(&stadium, (closed_kind)0, 8) && closed_mesh_make(&teapot, (closed_kind)0, 40));
    hard_mesh(&s, &stadium, 1, (double[3]){0, 0, 0});
    hard_mesh(&s, &teapot, 1.0 / 300, (double[3]){0.1, 0.05, 0.2});
    closed_mesh_free(&stadium);
    closed_mesh_free(&teapot);
    assert_false(s.failed);
    uint32_t levels;
    assert_int_equal(choose(&s, CGT_RAY_KIND_COHERENT, &levels), CGT_STRUCTURE_LOOSE_GRID);
    assert_true(levels > 1);
    hard_scene_free(&s);
}

SEEDED_SUITE("test_structure_choice", NULL, NULL)
