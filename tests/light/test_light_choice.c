/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which way points against a light go, by work that is counted: scattered points take no more than a tree needs and a
 * sample of tiles; frames that are alike take the same work from the second on; what calls take adds up until a tree is
 * worth its price; the statistics tell why; and whichever way is taken, the answers are those of the BVH. */
#include "light/lit_scene.h"
#include "support/suite.h"

static bool is_slow(void) { return test_scaled(10) < 2; }

#define POINTS 20000u /* few for each primitive: more would be served by tiles where there are 4 lanes */
#define PRIMS 150000u
#define PIECE (LIT_EDGE * LIT_EDGE)

static bool way_is(const lit_scene *s, const char *text) { return strstr(s->research.light_way, text) != NULL; }

TEST(scattered_points_take_no_more_than_a_tree)
{
    static lit_scene s;
    test_random r = random_make(1);
    uint32_t handed_over = 0;
    cgt_context *context = context_make(1, NULL);
    lit_scene_make(&r, PRIMS, POINTS, &s);
    lit_scatter(&r, &s);
    cgt_scene *truth = lit_commit(context, &s, CGT_STRUCTURE_BVH),
              *tiles = lit_commit(context, &s, CGT_STRUCTURE_LOOSE_GRID);
    for (uint32_t k = 0; k < TEST_COUNT(lit_lights); k++) {
        const cgt_light *light = &lit_lights[k];
        cgt_scene *scene = lit_commit(context, &s, CGT_STRUCTURE_AUTO);
        const double by_tree = lit_trace(truth, light, &s, 0, s.points, s.expected);
        const double by_tiles = lit_trace(tiles, light, &s, 0, s.points, s.got);
        assert_memory_equal(s.got, s.expected, s.points);
        const double first = lit_trace(scene, light, &s, 0, s.points, s.got);
        assert_memory_equal(s.got, s.expected, s.points);
        const bool gave_up = s.research.given_up;
        assert_true(way_is(&s, gave_up ? "some points took too much" : "took less"));
        assert_int_equal(cgt_scene_prepare(scene, CGT_RAY_KIND_INCOHERENT), CGT_OK);
        const double second = lit_trace(scene, light, &s, 0, s.points, s.got);
        assert_memory_equal(s.got, s.expected, s.points);
        assert_true(s.research.given_up <= s.points); /* nothing is given up twice */
        assert_true(s.statistics.bvh_rays >= s.research.given_up);
        /* a scene whose points gave up remembers it, and takes the tree that is there */
        assert_true(way_is(&s, s.research.given_up ? "some points took too much" : "took less") ||
                    (gave_up && way_is(&s, "there is a BVH") && s.statistics.bvh_rays == s.points));
        print_message("light %u: %.1f by the tree, %.1f by tiles, %.1f, then %.1f; %llu given up\n", k, by_tree,
                      by_tiles, first, second, (unsigned long long)s.research.given_up);
        handed_over += s.research.given_up > 0;
        /* the better way, a sample of tiles, and at worst what the tree costs, two for each primitive */
        assert_true(first <= fmin(by_tree, by_tiles) + 2.5 * s.prims / s.points + 3);
        assert_true(second <= fmin(by_tree, by_tiles) + 4); /* a fifth of the points ask tiles, for twice the tree */
        cgt_scene_release(scene);
    }
    assert_true(handed_over || !lit_has_16_lanes(context));
    cgt_scene_release(tiles);
    cgt_scene_release(truth);
    lit_scene_free(&s);
    cgt_context_release(context);
}

/* Other rays pay for nearly all of the tree. */
static void pay_for_tree(const cgt_scene *scene, lit_scene *s)
{
    const float *const *at = (const float *const *)s->at;
    const cgt_rays rays = {.count = s->prims / 32 - 100, .org = {at[0], at[1], at[2]}, .dir = {at[1], at[2], at[0]}};
    assert_true(rays.count < s->points);
    assert_int_equal(cgt_occluded_rays(scene, &rays, s->got, NULL), CGT_OK);
}

/* Points that give up tiles: frames swing neither in work nor in way. After two for the tree alone there is no grid,
 * but for one commit in 32, which asks anew. Where a camera comes, too, there is one. */
TEST(frames_that_are_alike_take_the_same_work)
{
    static lit_scene s;
    test_random r = random_make(6);
    uint64_t references[2] = {0}, given_up[2] = {0}; /* of grids after a commit without, and with one */
    uint32_t grids = 0;
    bool was_grid = false;
    cgt_camera camera;
    cgt_context *context = context_make(1, NULL);
    if (!lit_has_16_lanes(context)) {
        cgt_context_release(context);
        skip();
    }
    lit_scene_make(&r, PRIMS, POINTS, &s);
    lit_scatter(&r, &s);
    cgt_camera_init(&camera);
    planes p = planes_make(4, 4);
    cgt_scene *scene = lit_commit(context, &s, CGT_STRUCTURE_AUTO), *truth = lit_commit(context, &s, CGT_STRUCTURE_BVH);
    lit_trace(truth, &lit_lights[0], &s, 0, s.points, s.expected);
    for (uint32_t frame = 0; frame < 70; frame++) {
        const bool has_camera = frame >= 66;
        cgt_scene_statistics chosen;
        cgt_scene_get_statistics(scene, &chosen);
        const bool is_grid = chosen.structure == CGT_STRUCTURE_LOOSE_GRID;
        grids += is_grid;
        if (has_camera)
            frame_trace(scene, &camera, &p, NULL);
        pay_for_tree(scene, &s);
        lit_trace(scene, &lit_lights[0], &s, 0, s.points, s.got);
        assert_memory_equal(s.got, s.expected, s.points);
        if (is_grid) {
            uint64_t *const read = &references[was_grid], *const left = &given_up[was_grid];
            *read = *read ? *read : s.research.references;
            *left = *left ? *left : s.research.given_up;
            assert_int_equal(s.research.references, *read);
            assert_int_equal(s.research.given_up, *left);
            assert_true(*left > s.points / 3 && s.statistics.bvh_rays >= *left);
            /* few points go through the tree at once */
            lit_trace(scene, &lit_lights[0], &s, 0, 2000, s.got);
            assert_true(way_is(&s, "there is a BVH") && s.statistics.bvh_rays == 2000);
        } else
            assert_true(way_is(&s, "do not serve") && s.statistics.bvh_rays == s.points);
        was_grid = is_grid;
        if (frame == 65)
            assert_int_equal(grids, 2 + 2);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    }
    assert_int_equal(grids, 2 + 2 + 3);
    assert_true(references[1] < references[0]); /* what is known asks less */
    cgt_scene_release(scene);
    cgt_scene_release(truth);
    planes_free(&p);
    lit_scene_free(&s);
    cgt_context_release(context);
}

/* Moves the spheres that are near a place away. */
static void keep_clear(lit_scene *s, const float place[3], float distance)
{
    for (uint32_t i = 0; i < s->prims; i++) {
        float square = 0;
        for (int a = 0; a < 3; a++)
            square += (s->sphere[i][a] - place[a]) * (s->sphere[i][a] - place[a]);
        if (sqrtf(square) < distance + s->sphere[i][3])
            s->sphere[i][0] = 0.95f;
    }
}

/* No axes of one tile serve them: tiles of fewer points do, and share references. */
TEST(points_all_around_a_light_share_tiles)
{
    static lit_scene s;
    test_random r = random_make(8);
    cgt_context *context = context_make(1, NULL);
    lit_scene_make(&r, 2000, PIECE, &s);
    keep_clear(&s, (const float[]){0, 0, 0}, 0.1f);
    for (uint32_t i = 0; i < s.points; i++) {
        const float high = 3.14159265f * ((float)(i / LIT_EDGE) + 0.5f) / LIT_EDGE,
                    around = 6.2831853f * ((float)(i % LIT_EDGE) + 0.5f) / LIT_EDGE;
        s.at[0][i] = 0.6f * sinf(high) * cosf(around);
        s.at[1][i] = 0.6f * sinf(high) * sinf(around);
        s.at[2][i] = 0.6f * cosf(high);
    }
    cgt_scene *scene = lit_commit(context, &s, CGT_STRUCTURE_LOOSE_GRID),
              *truth = lit_commit(context, &s, CGT_STRUCTURE_BVH);
    lit_trace(truth, &lit_lights[1], &s, 0, s.points, s.expected);
    const double work = lit_trace(scene, &lit_lights[1], &s, 0, s.points, s.got);
    const double references = (double)s.research.references / s.points * context->kernel->lanes / 16;
    assert_memory_equal(s.got, s.expected, s.points);
    print_message("%.2f work, %.2f references a point in %llu tiles\n", work, references,
                  (unsigned long long)s.statistics.tiles);
    assert_true(s.statistics.tiles > 1 && references < 3); /* 27 one ray at a time */
    cgt_scene_release(scene);
    cgt_scene_release(truth);
    lit_scene_free(&s);
    cgt_context_release(context);
}

/* A frame's shadows from a light. */
static void cast(const cgt_scene *scene, const cgt_camera *camera, const planes *p, const cgt_light *light,
                 lit_scene *s, uint8_t *occluded)
{
    const cgt_frame frame = frame_of(p);
    cgt_research_trace_options research;
    cgt_trace_options options;
    lit_count(s, &options, &research);
    assert_int_equal(cgt_occluded_frame(scene, camera, &frame, light, 1, NULL, occluded, &options), CGT_OK);
}

/* In a small scene a light that leaves tiles for a tree takes no other light along; where no tree may be, none does. */
TEST(lights_of_small_frames_choose_for_themselves)
{
    static lit_scene s;
    static const cgt_light lights[] = {{CGT_LIGHT_POINT, {0, 0, 0}}, {CGT_LIGHT_POINT, {2, 3, 4}}};
    const uint32_t edge = 512;
    test_random r = random_make(9);
    cgt_context *context = context_make(1, NULL);
    cgt_camera camera;
    uint64_t through_tree[2];
    lit_scene_make(&r, 500, edge * edge, &s);
    keep_clear(&s, lights[0].position, 0.05f);
    cgt_camera_init(&camera);
    planes p = planes_make(edge, edge);
    cgt_scene *scene = lit_commit(context, &s, CGT_STRUCTURE_AUTO), *truth = lit_commit(context, &s, CGT_STRUCTURE_BVH),
              *tiles = lit_commit(context, &s, CGT_STRUCTURE_LOOSE_GRID);
    frame_trace(scene, &camera, &p, NULL);
    for (uint32_t k = 0; k < 2; k++) {
        cast(truth, &camera, &p, &lights[k], &s, s.expected);
        cast(scene, &camera, &p, &lights[k], &s, s.got);
        assert_memory_equal(s.got, s.expected, s.points);
        through_tree[k] = s.statistics.bvh_rays;
        print_message("light %u: %llu of %llu rays through the tree\n", k, (unsigned long long)through_tree[k],
                      (unsigned long long)s.statistics.rays);
        cast(tiles, &camera, &p, &lights[k], &s, s.got);
        assert_memory_equal(s.got, s.expected, s.points);
        assert_int_equal(s.research.given_up, 0);
        assert_true(s.research.references < 4 * s.statistics.rays);
    }
    assert_int_equal(through_tree[1], 0);
    cgt_scene_release(scene);
    cgt_scene_release(truth);
    cgt_scene_release(tiles);
    planes_free(&p);
    lit_scene_free(&s);
    cgt_context_release(context);
}

TEST(tiles_stay_where_they_serve)
{
    static lit_scene s;
    test_random r = random_make(2);
    cgt_context *context = context_make(1, NULL);
    lit_scene_make(&r, PRIMS, POINTS, &s);
    lit_lay_in_tiles(&s);
    cgt_scene *scene = lit_commit(context, &s, CGT_STRUCTURE_AUTO);
    for (uint32_t frame = 0; frame < 2; frame++) {
        for (uint32_t k = 0; k < TEST_COUNT(lit_lights); k++) {
            lit_trace(scene, &lit_lights[k], &s, 0, s.points - s.points % PIECE, s.got);
            assert_true(way_is(&s, "took less") && s.research.given_up == 0 && s.statistics.bvh_rays == 0);
        }
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    }
    const cgt_light far = {CGT_LIGHT_POINT, {1e10f, 0, 0}};
    lit_trace(scene, &far, &s, 0, s.points, s.got);
    assert_true(way_is(&s, "do not serve") && s.statistics.tiles == 0);
    cgt_scene_release(scene);
    lit_scene_free(&s);
    cgt_context_release(context);
}

/* Small calls, none of which would pay for a tree, pay for it together. */
TEST(work_of_small_calls_adds_up)
{
    static lit_scene s;
    test_random r = random_make(7);
    uint32_t calls = 0;
    cgt_context *context = context_make(1, NULL);
    lit_scene_make(&r, PRIMS, POINTS, &s);
    lit_scatter(&r, &s);
    cgt_scene *scene = lit_commit(context, &s, CGT_STRUCTURE_AUTO), *truth = lit_commit(context, &s, CGT_STRUCTURE_BVH);
    double work = 0;
    do {
        const uint32_t first = calls % 20 * 300;
        lit_trace(truth, &lit_lights[1], &s, first, 300, s.expected);
        work += 300 * lit_trace(scene, &lit_lights[1], &s, first, 300, s.got);
        assert_memory_equal(s.got + first, s.expected + first, 300);
        calls++;
    } while (!s.statistics.bvh_rays && calls < 1000);
    print_message("%u calls, %.1f work for each primitive\n", calls, work / s.prims);
    assert_true(calls > 1 && calls < 1000 && work < 6.0 * s.prims);
    cgt_scene_release(scene);
    cgt_scene_release(truth);
    lit_scene_free(&s);
    cgt_context_release(context);
}

/* Some calls that take more than a tree would, among many that take less, are not worth one. */
TEST(dense_calls_among_others_build_no_tree)
{
    static lit_scene tiles, dense;
    test_random r = random_make(7), same = random_make(7);
    cgt_context *context = context_make(1, NULL);
    lit_scene_make(&r, PRIMS, POINTS, &tiles);
    lit_scene_make(&same, PRIMS, POINTS, &dense);
    lit_lay_in_tiles(&tiles);
    lit_scatter(&r, &dense);
    cgt_scene *scene = lit_commit(context, &tiles, CGT_STRUCTURE_AUTO);
    for (uint32_t call = 0; call < 60; call++) {
        lit_trace(scene, &lit_lights[1], &dense, call % 20 * 300, 300, dense.got);
        assert_true(way_is(&dense, "took less") && dense.statistics.bvh_rays == 0);
        lit_trace(scene, &lit_lights[1], &tiles, call % (tiles.points / PIECE) * PIECE, PIECE, tiles.got);
    }
    cgt_scene_release(scene);
    lit_scene_free(&tiles);
    lit_scene_free(&dense);
    cgt_context_release(context);
}

/* Nine of ten spheres lie in clumps: tiles make tables of open groups there (kernel/light/light_table.h), and skip
 * cells by them. */
static void gather_in_clumps(test_random *r, lit_scene *s)
{
    float middle[16][3];
    for (int k = 0; k < 16; k++)
        for (int a = 0; a < 3; a++)
            middle[k][a] = random_float(r, -0.8f, 0.8f);
    for (uint32_t i = 0; i < s->prims; i++)
        for (int a = 0; a < 3 && i % 10; a++)
            s->sphere[i][a] = middle[i % 16][a] + 0.12f * (random_float(r, -1, 1) + random_float(r, -1, 1));
}

TEST(tables_of_open_groups_change_no_answer)
{
    static lit_scene s;
    test_random r = random_make(4);
    lit_scene_make(&r, PRIMS, POINTS, &s);
    gather_in_clumps(&r, &s);
    lit_lay_in_tiles(&s);
    FOR_EACH_VARIANT(variant)
    {
        uint64_t cells = 0;
        cgt_context *context = context_make(1, variant);
        cgt_scene *truth = lit_commit(context, &s, CGT_STRUCTURE_BVH),
                  *tiles = lit_commit(context, &s, CGT_STRUCTURE_LOOSE_GRID);
        for (uint32_t k = 0; k < TEST_COUNT(lit_lights); k++) {
            lit_trace(truth, &lit_lights[k], &s, 0, s.points, s.expected);
            const double work = lit_trace(tiles, &lit_lights[k], &s, 0, s.points, s.got);
            print_message("%s, light %u: work %.1f, %llu cells\n", variant, k, work,
                          (unsigned long long)s.research.cells);
            assert_memory_equal(s.got, s.expected, s.points);
            cells += s.statistics.tiles ? s.research.cells : 0;
        }
        assert_true(cells > 0); /* tables were in use */
        cgt_scene_release(tiles);
        cgt_scene_release(truth);
        cgt_context_release(context);
    }
    lit_scene_free(&s);
}

/* The light in the first sphere, all points outside: no primitive is looked at for a ray. Then a point each time that
 * this rule must leave alone: in the sphere, on its surface, not finite, skipping it, with another mask or range. */
TEST(a_light_in_a_sphere_takes_no_tests)
{
    enum { INSIDE, SURFACE, NO_NUMBER, SKIPPING, MASKED, ENDS, KINDS };
    static const uint32_t places[] = {1, PIECE / 2 + 3, PIECE + 19}; /* the last is in a part of a vector */
    static const float ball[4] = {0.1f, 0.2f, 0.1f, 0.3f};
    const cgt_light light = {CGT_LIGHT_POINT, {0.15f, 0.1f, 0.2f}};
    static lit_scene s;
    test_random r = random_make(8);
    lit_scene_make(&r, 600, PIECE + 21, &s);
    lit_lay_in_tiles(&s);
    keep_clear(&s, ball, 2 * ball[3]);
    memcpy(s.sphere[0], ball, sizeof ball);
    s.mask = 5;
    uint32_t *number = malloc(s.points * sizeof *number);
    float *t_max = malloc(s.points * sizeof *t_max);
    assert_true(number && t_max);
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        cgt_scene *scene[2] = {lit_commit(context, &s, CGT_STRUCTURE_BVH),
                               lit_commit(context, &s, CGT_STRUCTURE_LOOSE_GRID)};
        lit_trace(scene[1], &light, &s, 0, s.points, s.got);
        for (uint32_t i = 0; i < s.points; i++)
            assert_int_equal(s.got[i], 1);
        assert_int_equal(s.statistics.hits, s.points);
        assert_int_equal(s.research.references + s.statistics.ray_tests, 0);
        for (uint32_t k = 0; k < KINDS * TEST_COUNT(places); k++) {
            const uint32_t kind = k % KINDS, i = places[k / KINDS];
            const float away = kind == INSIDE ? 0.5f : kind == SURFACE ? 1 : 1.1f;
            cgt_points points = {.count = s.points, .position = {s.at[0], s.at[1], s.at[2]}};
            for (uint32_t j = 0; j < s.points; j++) {
                number[j] = 7;
                t_max[j] = 1;
            }
            number[i] = kind == SKIPPING ? 0 : kind == MASKED ? 2 : 7;
            t_max[i] = 0;
            points.skip_primitive = kind == MASKED || kind == ENDS ? NULL : number;
            points.mask = kind == MASKED ? number : NULL;
            points.t_max = kind == ENDS ? t_max : NULL;
            float kept[3];
            for (int a = 0; a < 3; a++) {
                kept[a] = s.at[a][i];
                s.at[a][i] = kind == NO_NUMBER ? NAN : ball[a] + (a == 2 ? away * ball[3] : 0);
            }
            assert_int_equal(cgt_occluded_points(scene[0], &light, &points, s.expected, NULL), CGT_OK);
            assert_int_equal(cgt_occluded_points(scene[1], &light, &points, s.got, NULL), CGT_OK);
            assert_memory_equal(s.got, s.expected, s.points);
            assert_true(kind <= SURFACE || !s.got[i]);
            for (int a = 0; a < 3; a++)
                s.at[a][i] = kept[a];
        }
        cgt_scene_release(scene[0]);
        cgt_scene_release(scene[1]);
        cgt_context_release(context);
    }
    free(number);
    free(t_max);
    lit_scene_free(&s);
}

/* Calls of any sizes, lights and orders, one after the other on one scene, on one thread and on three. */
TEST(no_way_changes_an_answer)
{
    static lit_scene s;
    test_random r = random_make(3);
    for (uint32_t threads = 1; threads <= 3; threads += 2) {
        cgt_context *context = context_make(threads, NULL);
        lit_scene_make(&r, PRIMS, POINTS, &s);
        cgt_scene *truth = lit_commit(context, &s, CGT_STRUCTURE_BVH),
                  *scene = lit_commit(context, &s, CGT_STRUCTURE_AUTO);
        for (uint32_t call = 0; call < (is_slow() ? 6u : 24u); call++) {
            cgt_light light = lit_lights[random_below(&r, TEST_COUNT(lit_lights))];
            if (random_below(&r, 4) == 0)
                for (int a = 0; a < 3; a++)
                    light.position[a] = random_float(&r, -1, 1);
            if (random_below(&r, 2))
                lit_scatter(&r, &s);
            else
                lit_lay_in_tiles(&s);
            const uint32_t count = 1 + random_below(&r, random_below(&r, 2) ? s.points : 5000);
            lit_trace(truth, &light, &s, 0, count, s.expected);
            lit_trace(scene, &light, &s, 0, count, s.got);
            assert_memory_equal(s.got, s.expected, count);
            if (random_below(&r, 8) == 0)
                assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        }
        cgt_scene_release(scene);
        cgt_scene_release(truth);
        lit_scene_free(&s);
        cgt_context_release(context);
    }
}

SEEDED_SUITE("test_light_choice", NULL, NULL)
