/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of triangles, and of triangles and spheres, by tiles are the same, bit for bit, as by packets through the
 * queue grid. For the variant that this is compiled for. */
#include "hard_cases/hard_run.h"
#include "support/suite.h"
#include "tile/tile_compare.h"

#include <math.h>

static const uint32_t sizes[][2] = {{1, 1}, {65, 3}, {3, 70}, {64, 64}, {65, 63}, {100, 65}};

/* More than a tile: the last of the sizes, or a third of it if samples suffice. */
static const uint32_t *large_size(void)
{
    static const uint32_t small[] = {66, 34};
    return test_samples() ? small : sizes[5];
}

static cgt_camera looking(const float eye[3], const float target[3], const float up[3], float fov)
{
    cgt_camera camera;
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++) {
        camera.eye[a] = eye[a];
        camera.target[a] = target[a];
        camera.up[a] = up[a];
    }
    camera.fov = fov;
    return camera;
}

static dual_scene dual_scene_make(hard_scene *s, double per_cell)
{
    const cgt_scene_options options = {.structure = CGT_STRUCTURE_QUEUE_GRID};
    cgt_scene *scene;
    assert_false(s->failed);
    assert_int_equal(hard_commit_with(context, s, &options, &scene), CGT_OK);
    return dual_scene_of(scene, per_cell);
}

static void dual_scene_end(dual_scene *b, hard_scene *s)
{
    dual_scene_free(b);
    hard_scene_free(s);
}

/* ---- closed meshes ---- */

TEST(frames_of_closed_meshes)
{
    static const hard_place place[] = {{.scale = 1}, {.scale = 1e-3, .offset = {10, -3, 5}}};
    for (int kind = 0; kind < CLOSED_KINDS; kind++) {
        frames_tally tally = {0};
        for (uint32_t i = 0; i < 2 + test_scaled(6); i++) {
            hard_scene s = {.place = place[i % 4 == 3], .random = random_make(400 + 100 * (uint64_t)kind + i)};
            double from[3], to[3];
            float eye[3], target[3], up[3];
            const uint32_t details[] = {test_samples() ? 14 : 24, 6, 16, 12}, *large = large_size();
            const uint32_t *size = i % 2 ? large : sizes[random_below(&s.random, 6)];
            hard_closed_mesh(&s, (closed_kind)kind, details[i % 4]);
            closed_mesh_inside(&(closed_mesh){.kind = (closed_kind)kind}, &s.random, from);
            hard_direction(&s, to);
            for (int a = 0; a < 3; a++) {
                to[a] += from[a];
                if (i % 2) /* the opposite orientation, from farther away */
                    to[a] = 4 * to[a] - 3 * from[a];
            }
            hard_put(&s, i % 2 ? to : from, eye);
            hard_put(&s, i % 2 ? from : to, target);
            random_direction(&s.random, up);
            dual_scene b = dual_scene_make(&s, 4);
            cgt_camera camera = looking(eye, target, up, i % 2 ? 45 : 90);
            const frames_tally before = tally;
            compare_frame(&b, &camera, size[0], size[1], closed_mesh_name((closed_kind)kind), &tally);
            if (i % 2 == 0 && tally.served > before.served)
                assert_int_equal(tally.counts.hits - before.counts.hits, size[0] * size[1]);
            make_orthographic(&s.random, (float)s.place.scale * random_log(&s.random, 0.1f, 4), &camera);
            compare_frame(&b, &camera, size[0], size[1], closed_mesh_name((closed_kind)kind), &tally);
            dual_scene_end(&b, &s);
        }
        print_tally(closed_mesh_name((closed_kind)kind), &tally);
        assert_true(tally.served > 0 && tally.parallel > 0);
    }
}

/* ---- random triangles ---- */

/* Triangles of any size from a fraction of a pixel to beyond the scene; slivers, and copies. */
static void add_triangles(hard_scene *s, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double v[3][3];
        const double size = i % 8 ? (double)random_log(&s->random, 1e-3f, 0.3f) : hard_real(s, 0.5, 30);
        hard_point(s, -1, 1, v[0]);
        for (int k = 1; k < 3; k++) {
            double d[3];
            hard_direction(s, d);
            for (int a = 0; a < 3; a++)
                v[k][a] = v[0][a] + size * d[a];
        }
        if (i % 5 == 1) { /* a sliver */
            const double share = hard_real(s, -0.5, 1.5), width = (double)random_log(&s->random, 1e-9f, 1e-2f);
            for (int a = 0; a < 3; a++)
                v[2][a] = v[0][a] + share * (v[1][a] - v[0][a]) + width * (v[2][a] - v[0][a]);
        }
        hard_triangle(s, v);
        if (i % 7 == 2)
            hard_triangle(s, v);
    }
}

/* Cameras inside a scene and outside; some in a triangle's plane or very close to it; ranges. */
static cgt_camera camera_for(hard_scene *s)
{
    test_random *r = &s->random;
    double from[3], to[3];
    float eye[3], target[3], up[3], v[3][3];
    hard_point(s, -1, 1, from);
    hard_point(s, -1, 1, to);
    if (random_below(r, 2))
        for (int a = 0; a < 3; a++)
            from[a] *= 4;
    hard_put(s, from, eye);
    hard_put(s, to, target);
    random_direction(r, up);
    if (random_below(r, 4) == 0 && hard_any_triangle(s, v)) {
        const float factor = random_below(r, 2) ? 2 : 0.3f;
        for (int a = 0; a < 3; a++)
            eye[a] = v[0][a] + factor * (v[1][a] - v[0][a]) - 0.25f * factor * (v[2][a] - v[0][a]);
    }
    cgt_camera camera = looking(eye, target, up, random_below(r, 3) ? random_float(r, 20, 120) : random_log(r, 1, 20));
    const float scale = (float)s->place.scale;
    if (random_below(r, 3) == 0)
        make_orthographic(r, scale * random_log(r, 0.03f, 6), &camera);
    if (random_below(r, 4) == 0)
        camera.t_min = scale * random_float(r, 0, 2);
    if (random_below(r, 4) == 0)
        camera.t_max = camera.t_min + scale * random_log(r, 1e-2f, 10);
    return camera;
}

static void add_spheres(hard_scene *s, uint32_t count)
{
    hard_new_geometry(s);
    for (uint32_t i = 0; i < count; i++) {
        double center[3];
        hard_point(s, -1, 1, center);
        hard_sphere(s, center, (double)random_log(&s->random, 1e-3f, i % 16 ? 0.2f : 3));
    }
}

static void frames_of_soups(uint64_t nontemporal, bool mixed, const char *what)
{
    static const hard_place place[] = {
        {.scale = 1}, {.scale = 1e4}, {.scale = 1e-3, .offset = {10, -3, 5}}, {.scale = 0x1p-34}, {.scale = 0x1p36}};
    frames_tally tally = {0};
    for (uint32_t round = 0; round < 1 + test_scaled(14); round++) {
        hard_scene s = {.place = place[round % 5], .random = random_make(nontemporal + round)};
        add_triangles(&s, 1 + random_below(&s.random, round % 2 ? 40 : 600));
        if (mixed) {
            add_spheres(&s, 1 + random_below(&s.random, 200));
            hard_new_geometry(&s);
            add_triangles(&s, 20);
        }
        dual_scene b = dual_scene_make(&s, (double)random_float(&s.random, 0.5f, 16));
        for (uint32_t i = 0; i < 3; i++) {
            const uint32_t *size = sizes[random_below(&s.random, TEST_COUNT(sizes))];
            const cgt_camera camera = camera_for(&s);
            compare_frame(&b, &camera, size[0], size[1], what, &tally);
        }
        dual_scene_end(&b, &s);
    }
    print_tally(what, &tally);
    assert_true(tally.served > 0); /* fewer than frames: a narrow picture may have too wide a field of view */
}

TEST(frames_of_triangles) { frames_of_soups(500, false, "triangles"); }

TEST(frames_of_both_kinds) { frames_of_soups(600, true, "both kinds"); }

/* ---- fine meshes ---- */

/* A wavy sheet of n x n squares that fills a tile, each triangle covering a few pixels: fewer triangles than a tile can
 * list, and more. */
static void add_sheet(hard_scene *s, uint32_t n)
{
    for (uint32_t i = 0; i < 2 * n * n; i++) {
        double v[3][3];
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t corner = i % 2 ? 3 - k : k, x = i / 2 % n + corner % 2, y = i / 2 / n + corner / 2;
            v[k][0] = 2. * x / n - 1;
            v[k][1] = 2. * y / n - 1;
            v[k][2] = 0.1 * sin(7 * v[k][0]) * cos(5 * v[k][1]);
        }
        hard_triangle(s, v);
    }
}

TEST(frames_of_fine_meshes)
{
    static const uint32_t squares[] = {8, 22, 31, 32, 33, 45};
    static const float eye[3] = {0.2f, 0.1f, 2.6f}, target[3] = {0.01f, 0.02f, 0}, up[3] = {0, 1, 0};
    frames_tally tally = {0};
    for (size_t k = 0; k < TEST_COUNT(squares); k++) {
        hard_scene s = {.place = {.scale = 1}, .random = random_make(700 + k)};
        const uint32_t frames = test_samples() ? 2 : 6;
        add_sheet(&s, squares[k]);
        dual_scene b = dual_scene_make(&s, 4);
        for (uint32_t i = 0; i < frames; i++) {
            const cgt_camera camera = looking(eye, target, up, 40 + 2 * (float)i);
            compare_frame(&b, &camera, 64, 64, "fine mesh", &tally);
        }
        dual_scene_end(&b, &s);
    }
    print_tally("fine meshes", &tally);
    assert_int_equal(tally.served, tally.frames);
    assert_true(tally.counts.hits > 2000 * tally.frames);
}

/* ---- large layers ---- */

/* More triangles, all larger than the picture and close in depth, than are rasterised between two updates of the
 * farthest distances. */
TEST(frames_of_large_layers)
{
    const uint32_t *pixels = large_size();
    frames_tally tally = {0};
    for (uint32_t round = 0; round < 1 + test_scaled(2); round++) {
        hard_scene s = {.place = {.scale = 1}, .random = random_make(800 + round)};
        const float eye[3] = {0.1f, 0.2f, 4}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
        const double apart = (double)random_log(&s.random, 1e-3f, 1);
        cgt_camera camera = looking(eye, target, up, 30);
        for (uint32_t i = 0; i < 280; i++) {
            double v[3][3];
            for (int k = 0; k < 3; k++) {
                const double angle = 2.0943951 * k + hard_real(&s, 0, 1), size = hard_real(&s, 5, 40);
                v[k][0] = size * cos(angle);
                v[k][1] = size * sin(angle);
                v[k][2] = apart * hard_real(&s, -1, 1);
            }
            hard_triangle(&s, v);
        }
        dual_scene b = dual_scene_make(&s, 4);
        compare_frame(&b, &camera, pixels[0], pixels[1], "large layers", &tally);
        make_orthographic(&s.random, 3, &camera);
        compare_frame(&b, &camera, pixels[0], pixels[1], "large layers", &tally);
        dual_scene_end(&b, &s);
    }
    print_tally("large layers", &tally);
    assert_int_equal(tally.served, tally.frames);
    assert_true(tally.counts.hits > 1000);
}

/* ---- edges through pixels ---- */

/* Height fields, one behind the other and one of them doubled, with vertices on the rays of every fourth pixel, exactly
 * or except for rounding. */
TEST(frames_of_edges_on_rays)
{
    frames_tally tally = {0};
    for (uint32_t round = 0; round < 2 + test_scaled(8); round++) {
        hard_scene s = {.place = {.scale = 1}, .random = random_make(700 + round)};
        const bool plain = round % 2, parallel = round % 4 > 1; /* plain: along an axis */
        const float eye[3] = {0, 0, plain ? 0.f : 0.3f}, up[3] = {0, 1, plain ? 0.f : 0.2f};
        const float target[3] = {plain ? 0.f : 0.7f, 0, plain ? 1.f : 2.f};
        cgt_camera camera = looking(eye, target, up, 90);
        camera.projection = parallel ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
        const cgt_camera_rays rays = rays_of(&camera, 64, 64);
        double vertex[2][17][17][3];
        for (int layer = 0; layer < 2; layer++)
            for (int y = 0; y < 17; y++)
                for (int x = 0; x < 17; x++) {
                    const float px = ((float)(4 * x) + 0.5f) * rays.pixel[0] - 1;
                    const float py = 1 - ((float)(4 * y) + 0.5f) * rays.pixel[1];
                    const double t = plain ? 1 + random_below(&s.random, 4) : hard_real(&s, 1, 2);
                    const float *from = parallel ? rays.eye : rays.fwd;
                    for (int a = 0; a < 3; a++) {
                        const double sum = (double)((from[a] + px * rays.right[a]) + py * rays.up[a]);
                        vertex[layer][y][x][a] =
                            parallel ? sum + t * (double)rays.fwd[a] : (double)rays.eye[a] + t * sum;
                    }
                }
        for (int layer = 0; layer < 3; layer++)
            for (int y = 0; y < 16; y++)
                for (int x = 0; x < 16; x++) {
                    double v[2][3][3];
                    for (int k = 0; k < 6; k++) {
                        static const int corner[6][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 1}, {1, 0}};
                        memcpy(v[k / 3][k % 3], vertex[layer / 2][y + corner[k][1]][x + corner[k][0]], sizeof v[0][0]);
                    }
                    hard_triangle(&s, v[0]);
                    hard_triangle(&s, v[1]);
                }
        dual_scene b = dual_scene_make(&s, 4);
        compare_frame(&b, &camera, 64, 64, "edges on rays", &tally);
        dual_scene_end(&b, &s);
    }
    print_tally("edges on rays", &tally);
    assert_int_equal(tally.served, tally.frames);
    assert_true(tally.counts.double_tests > 1000 && tally.counts.hits > 1000);
}

VARIANT_SUITE("test_tile_mesh_frames", make_context, release_context)
