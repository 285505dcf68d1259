/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Ambient occlusion of frames: cases with a known answer; a sum over the same rays by cgt_occluded_rays; the same bits
 * for any threads, variant and structure; the directions; odd pixels. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "query/ambient_directions.h"
#include "support/suite.h"
#include "support/scenes.h"

#define STRIDE 80u
#define PIXELS (STRIDE * 50u)

/* The part of the picture that is traced: on slow machines a fifteenth of the pixels, for samples a fortieth. Neither
 * is a whole number of blocks. */
#define SLOW (test_scaled(10) < 2)
#define WIDTH (test_samples() ? 11u : SLOW ? 19u : 75u)
#define HEIGHT (test_samples() ? 9u : SLOW ? 13u : 50u)
#define MANY (test_samples() ? 20u : SLOW ? 50u : 1000u) /* pixels of that part */
#define ROWS (STRIDE * HEIGHT)

/* Every structure, or every second one on slow machines. */
#define STEP (SLOW ? 2u : 1u)

/* ---- a frame with all required planes ---- */

typedef struct view {
    float t[PIXELS], normal[3][PIXELS], visibility[PIXELS];
    uint32_t primitive[PIXELS], geometry[PIXELS];
    cgt_camera camera;
    cgt_frame frame;
} view;

static void light_init_projection(view *v, const float eye[3], const float target[3])
{
    memset(v, 0x55, sizeof *v);
    cgt_camera_init(&v->camera);
    cgt_frame_init(&v->frame, WIDTH, HEIGHT);
    memcpy(v->camera.eye, eye, sizeof v->camera.eye);
    memcpy(v->camera.target, target, sizeof v->camera.target);
    v->frame.row_stride = STRIDE;
    v->frame.t = v->t;
    v->frame.primitive = v->primitive;
    v->frame.geometry = v->geometry;
    for (int a = 0; a < 3; a++)
        v->frame.normal[a] = v->normal[a];
}

static cgt_ambient_options ambient_of(uint32_t samples, float radius, uint32_t seed)
{
    cgt_ambient_options a;
    cgt_ambient_options_init(&a);
    assert_true(a.samples == 16 && a.radius == INFINITY && a.seed == 0);
    a.samples = samples;
    a.radius = radius;
    a.seed = seed;
    return a;
}

/* Traces the frame and its ambient visibility; memory outside the picture must not change. Returns the number of pixels
 * hit. */
static uint32_t look(const cgt_scene *scene, view *v, const cgt_ambient_options *ambient,
                     const cgt_trace_options *options)
{
    uint32_t hits = 0;
    memset(v->visibility, 0x55, sizeof v->visibility);
    assert_int_equal(cgt_trace_camera(scene, &v->camera, &v->frame, NULL), CGT_OK);
    assert_int_equal(cgt_ambient_occlusion(scene, &v->camera, &v->frame, ambient, v->visibility, options), CGT_OK);
    for (uint32_t i = 0; i < PIXELS; i++) {
        if (i % STRIDE >= WIDTH || i >= ROWS) {
            assert_memory_equal(&v->visibility[i], "\x55\x55\x55\x55", 4);
            continue;
        }
        assert_true(v->visibility[i] >= 0 && v->visibility[i] <= 1);
        hits += v->primitive[i] != CGT_INVALID_ID;
        if (v->primitive[i] == CGT_INVALID_ID)
            assert_true(v->visibility[i] == 1);
    }
    return hits;
}

static void expect_all(const view *v, float visibility)
{
    for (uint32_t i = 0; i < ROWS; i++)
        if (i % STRIDE < WIDTH && v->visibility[i] != visibility)
            fail_msg("pixel %u, %u sees %g of the sky, not %g", i % STRIDE, i / STRIDE, (double)v->visibility[i],
                     (double)visibility);
}

/* ---- scenes ---- */

/* A floor at y = 0: two triangles whose common edge lies far from the centre. */
static const float floor_corner[4][3] = {{-100, 0, -100}, {100, 0, -101}, {103, 0, 100}, {-100, 0, 90}};
static const uint32_t floor_index[2][3] = {{0, 1, 3}, {1, 2, 3}};

static cgt_scene *scene_make(cgt_context *context, uint32_t structure, bool with_floor, const float (*sphere)[4],
                             uint32_t spheres)
{
    const cgt_scene_options made = structure_in_turn(structure);
    const cgt_spheres balls = spheres_of(sphere, spheres);
    const cgt_triangles triangles = {.count = with_floor ? 2 : 0,
                                     .indices = cgt_uint32s(floor_index[0], 0),
                                     .vertex_count = 4,
                                     .vertices = cgt_floats(floor_corner[0], 0)};
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, &made, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &balls), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

static cgt_scene *box_make(cgt_context *context, uint32_t structure)
{
    static float corner[8][3];
    static const uint32_t index[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                          {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    const cgt_triangles triangles = {
        .count = 12, .indices = cgt_uint32s(index[0], 0), .vertex_count = 8, .vertices = cgt_floats(corner[0], 0)};
    const cgt_scene_options made = structure_in_turn(structure);
    cgt_scene *scene;
    for (uint32_t i = 0; i < 8; i++)
        for (uint32_t a = 0; a < 3; a++)
            corner[i][a] = i >> a & 1 ? 1.7f + (float)a : -1.3f;
    assert_int_equal(cgt_scene_create(context, &made, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* ---- known answers ---- */

TEST(isolated_points_are_open)
{
    static view v;
    const float ball[1][4] = {{0.3f, 0.1f, 0.2f, 1.1f}};
    const cgt_ambient_options ambient = ambient_of(33, INFINITY, 5);
    cgt_context *context = context_make(2, NULL);
    for (uint32_t k = test_sample_start(0, STEP); k < TEST_STRUCTURES; k += STEP)
        for (int orthographic = 0; orthographic < 2; orthographic++) {
            cgt_scene *scene = scene_make(context, k, true, NULL, 0);
            light_init_projection(&v, (float[]){1.3f, orthographic ? -4 : 3, 7}, (float[]){0, 0, 0.1f});
            v.camera.projection = orthographic ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
            assert_true(look(scene, &v, &ambient, NULL) > MANY);
            expect_all(&v, 1);
            cgt_scene_release(scene);
            scene = scene_make(context, k, false, ball, 1);
            light_init_projection(&v, (float[]){1, 2, 3}, (float[]){0, 0, 0});
            assert_true(look(scene, &v, &ambient, NULL) > MANY);
            expect_all(&v, 1);
            cgt_scene_release(scene);
            scene = scene_make(context, k, false, NULL, 0);
            assert_int_equal(look(scene, &v, NULL, NULL), 0);
            expect_all(&v, 1);
            cgt_scene_release(scene);
        }
    cgt_context_release(context);
}

TEST(points_inside_a_box_are_dark)
{
    static view v;
    const cgt_ambient_options ambient = ambient_of(50, INFINITY, 1);
    cgt_context *context = context_make(2, NULL);
    for (uint32_t k = test_sample_start(1, STEP); k < TEST_STRUCTURES; k += STEP) {
        cgt_scene *scene = box_make(context, k);
        light_init_projection(&v, (float[]){0.1f, 0.2f, 0.3f}, (float[]){1, 0.5f, -1});
        v.camera.fov = 100;
        assert_int_equal(look(scene, &v, &ambient, NULL), WIDTH * HEIGHT);
        expect_all(&v, 0);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

/* At distance d below the centre of a ball of radius r, a share of (r / d)^2 of the cosine-weighted sky is occluded;
 * within a radius that does not reach the ball, nothing. */
TEST(a_ball_occludes_its_share)
{
    static view v;
    const float ball[1][4] = {{0, 2, 0, 1}};
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_make(context, 0, true, ball, 1);
    light_init_projection(&v, (float[]){0, -30, 0.1f},
                          (float[]){0, 0, 0}); /* from below, through the floor's other side */
    v.camera.fov = 0.5f;
    cgt_ambient_options ambient = ambient_of(1024, INFINITY, 0);
    look(scene, &v, &ambient, NULL);
    expect_all(&v, 1); /* the lower side faces away from the ball */
    light_init_projection(&v, (float[]){0.5f, 0.25f, 0}, (float[]){0, 0, 0}); /* from between ball and floor */
    v.camera.fov = 0.5f;
    look(scene, &v, &ambient, NULL);
    for (uint32_t i = 0; i < ROWS; i++)
        if (i % STRIDE < WIDTH && fabsf(v.visibility[i] - 0.75f) > 0.01f)
            fail_msg("%g of the sky is open, not 3/4", (double)v.visibility[i]);
    ambient.radius = 0.99f;
    look(scene, &v, &ambient, NULL);
    expect_all(&v, 1);
    ambient.radius = 1.02f; /* reaches only the nearest part */
    look(scene, &v, &ambient, NULL);
    for (uint32_t i = 0; i < ROWS; i++)
        assert_true(i % STRIDE >= WIDTH || (v.visibility[i] < 1 && v.visibility[i] > 0.9f));
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- the same rays one by one ---- */

static float open_by_rays(const cgt_scene *scene, const view *v, const cgt_ambient_options *ambient, uint32_t x,
                          uint32_t y)
{
    static cgt_ambient_points points;
    static float dir[3][CGT_AMBIENT_SAMPLES], org[3][CGT_AMBIENT_SAMPLES], t_max[CGT_AMBIENT_SAMPLES];
    static uint32_t skip_prim[2][CGT_AMBIENT_SAMPLES];
    static uint8_t occluded[CGT_AMBIENT_SAMPLES];
    const uint32_t i = y * STRIDE + x;
    cgt_camera_rays camera;
    char message[160];
    float n[3], ahead = 0;
    uint32_t open = 0;
    assert_int_equal(cgt_camera_prepare(&v->camera, WIDTH, HEIGHT, &camera, message), CGT_OK);
    const truth_ray ray = camera_ray(&camera, x, y);
    for (int a = 0; a < 3; a++)
        ahead += v->normal[a][i] * ray.dir[a];
    for (int a = 0; a < 3; a++)
        n[a] = ahead > 0 ? -v->normal[a][i] : v->normal[a][i];
    cgt_ambient_points_init(ambient->first, ambient->samples, &points);
    cgt_ambient_directions(&points, ambient, x, y, n, (float *const[]){dir[0], dir[1], dir[2]});
    for (uint32_t k = 0; k < ambient->samples; k++) {
        for (int a = 0; a < 3; a++)
            org[a][k] = ray.org[a] + v->t[i] * ray.dir[a];
        t_max[k] = ambient->radius;
        skip_prim[0][k] = v->primitive[i];
        skip_prim[1][k] = v->geometry[i];
    }
    const cgt_rays rays = {.count = ambient->samples,
                           .org = {org[0], org[1], org[2]},
                           .dir = {dir[0], dir[1], dir[2]},
                           .t_max = t_max,
                           .skip_primitive = skip_prim[0],
                           .skip_geometry = skip_prim[1]};
    assert_int_equal(cgt_occluded_rays(scene, &rays, occluded, NULL), CGT_OK);
    for (uint32_t k = 0; k < ambient->samples; k++)
        open += !occluded[k];
    return (float)open / (float)ambient->samples;
}

TEST(visibility_is_the_share_of_open_rays)
{
    static view v, other;
    static const float ball[4][4] = {{0, 1, 0, 1}, {2.2f, 0.7f, 0, 0.7f}, {-1, 1.5f, 2, 0.5f}, {0, 3, 0, 1}};
    static const uint32_t samples[] = {1, 16, 100, 1024};
    static const float radii[] = {INFINITY, 1.5f, INFINITY, 3};
    for (size_t s = 0; s < TEST_COUNT(samples); s++) {
        const cgt_ambient_options ambient = ambient_of(samples[s], radii[s], 77 * (uint32_t)s);
        bool first = true;
        FOR_EACH_VARIANT(variant)
        for (uint32_t threads = 1; threads < 3; threads++)
            for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
                if (samples[s] > 50 && (k + threads) % 4 != s % 2) /* long runs take turns */
                    continue;
                if (samples[s] <= 50 && (k + threads) % STEP != test_sample_start((uint32_t)s, STEP))
                    continue;
                cgt_trace_statistics statistics;
                cgt_trace_options options;
                cgt_context *context = context_make(threads, variant);
                cgt_scene *scene = scene_make(context, k, true, ball, 4);
                view *const to = first ? &v : &other;
                light_init_projection(to, (float[]){2, 3, 8}, (float[]){0, 1, 0});
                to->camera.projection = s == 2 ? CGT_PROJECTION_ORTHOGRAPHIC : CGT_PROJECTION_PERSPECTIVE;
                to->camera.height = 6;
                options = (cgt_trace_options){0};
                options.precision = k % 2 ? CGT_PRECISION_EXACT : CGT_PRECISION_FAST;
                options.statistics = &statistics;
                const uint32_t hits = look(scene, to, &ambient, &options);
                assert_int_equal(statistics.rays, (uint64_t)hits * samples[s]);
                if (first) {
                    double sum = 0;
                    for (uint32_t i = 0; i < ROWS; i++) {
                        const uint32_t x = i % STRIDE, y = i / STRIDE;
                        if (x >= WIDTH || v.primitive[i] == CGT_INVALID_ID || (x + y) % 3)
                            continue;
                        sum += (double)v.visibility[i];
                        assert_true(v.visibility[i] == open_by_rays(scene, &v, &ambient, x, y));
                    }
                    assert_true(sum > MANY / 10 && sum < 0.97 * hits);
                } else
                    assert_memory_equal(v.visibility, other.visibility, sizeof v.visibility);
                first = false;
                cgt_scene_release(scene);
                cgt_context_release(context);
            }
    }
}

/* Calls that go on where others ended: open rays add up to those of one call, at any split. */
TEST(samples_may_come_in_parts)
{
    static view v, part;
    static const float ball[4][4] = {{0, 1, 0, 1}, {2.2f, 0.7f, 0, 0.7f}, {-1, 1.5f, 2, 0.5f}, {0, 3, 0, 1}};
    static const uint32_t splits[][4] = {{13, 3, 1, 7}, {1, 1, 21, 1}, {6, 6, 6, 6}};
    static uint32_t open[PIXELS];
    cgt_context *context = context_make(2, NULL);
    cgt_scene *scene = scene_make(context, 0, true, ball, 4);
    cgt_ambient_options ambient = ambient_of(24, 2, 5);
    ambient.first = 1000;
    light_init_projection(&v, (float[]){2, 3, 8}, (float[]){0, 1, 0});
    light_init_projection(&part, (float[]){2, 3, 8}, (float[]){0, 1, 0});
    look(scene, &v, &ambient, NULL);
    for (size_t s = 0; s < TEST_COUNT(splits); s++) {
        memset(open, 0, sizeof open);
        ambient.first = 1000;
        for (uint32_t k = 0; k < 4; k++) {
            ambient.samples = splits[s][k];
            look(scene, &part, &ambient, NULL);
            for (uint32_t i = 0; i < ROWS; i++)
                if (i % STRIDE < WIDTH)
                    open[i] += (uint32_t)lroundf(part.visibility[i] * (float)ambient.samples);
            ambient.first += ambient.samples;
        }
        assert_int_equal(ambient.first, 1024);
        for (uint32_t i = 0; i < ROWS; i++)
            if (i % STRIDE < WIDTH)
                assert_true((float)open[i] / 24.0f == v.visibility[i]);
    }
    ambient.first = UINT32_MAX - 5;
    assert_int_equal(cgt_ambient_occlusion(scene, &v.camera, &v.frame, &ambient, v.visibility, NULL),
                     CGT_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(context_message(context), "first"));
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* Normals may be records: the same bits as from planes. */
TEST(normals_may_lie_side_by_side)
{
    const float eye[3] = {1, 2, 4}, middle[3] = {0, 0, 0},
                sphere[2][4] = {{0, 0.5f, 0, 0.5f}, {0.8f, 0.3f, 0.2f, 0.3f}};
    cgt_context *context = context_make(2, NULL);
    cgt_scene *scene = scene_make(context, 0, true, sphere, 2);
    view *v = malloc(sizeof *v), *w = malloc(sizeof *w);
    float *records = malloc(sizeof v->normal);
    const cgt_ambient_options ambient = ambient_of(4, INFINITY, 0);
    assert_true(v && w && records);
    light_init_projection(v, eye, middle);
    light_init_projection(w, eye, middle);
    w->frame.vector_stride = 3;
    for (int a = 0; a < 3; a++)
        w->frame.normal[a] = records + a;
    assert_true(look(scene, v, &ambient, NULL) > MANY);
    look(scene, w, &ambient, NULL);
    assert_memory_equal(v->visibility, w->visibility, sizeof v->visibility);
    free(records);
    free(v);
    free(w);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

TEST(ambient_rays_use_the_camera_mask)
{
    static view v;
    static const float corner[4][3] = {{-9, 5, -9}, {9, 5, -9}, {9, 5, 9}, {-9, 5, 9}};
    static const uint32_t index[2][3] = {{0, 1, 2}, {0, 2, 3}};
    const cgt_triangles roof = {.count = 2,
                                .indices = cgt_uint32s(index[0], 0),
                                .vertex_count = 4,
                                .vertices = cgt_floats(corner[0], 0),
                                .mask = 2};
    const cgt_ambient_options ambient = ambient_of(16, INFINITY, 0);
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_make(context, 3, true, NULL, 0);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &roof), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    light_init_projection(&v, (float[]){0, 3, 3}, (float[]){0, 0, 0});
    v.camera.fov = 10;
    look(scene, &v, &ambient, NULL);
    for (uint32_t i = 0; i < ROWS; i++)
        assert_true(i % STRIDE >= WIDTH || v.visibility[i] < 0.8f);
    v.camera.mask = 1;
    look(scene, &v, &ambient, NULL);
    expect_all(&v, 1);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- directions ---- */

TEST(directions_are_cosine_weighted)
{
    static cgt_ambient_points points;
    static float dir[3][CGT_AMBIENT_SAMPLES];
    test_random r = random_make(9);
    const cgt_ambient_options ambient = ambient_of(CGT_AMBIENT_SAMPLES, INFINITY, 3);
    cgt_ambient_points_init(0, ambient.samples, &points);
    for (uint32_t k = 0; k < test_between(30, 300); k++) {
        float n[3], axes[2][3];
        double length = 0, mean[3] = {0}, square[2] = {0};
        for (int a = 0; a < 3; a++) {
            n[a] = k < 6 ? (float)((int)(k / 2) == a) * (k % 2 ? -1.f : 1.f) : random_float(&r, -1, 1);
            length += (double)n[a] * (double)n[a];
        }
        for (int a = 0; a < 3; a++)
            n[a] /= (float)sqrt(length);
        cgt_ambient_axes(n, axes);
        cgt_ambient_directions(&points, &ambient, k, 3 * k, n, (float *const[]){dir[0], dir[1], dir[2]});
        for (uint32_t i = 0; i < ambient.samples; i++) {
            double dot[3] = {0}, size = 0;
            for (int a = 0; a < 3; a++) {
                dot[0] += (double)dir[a][i] * (double)n[a];
                dot[1] += (double)dir[a][i] * (double)axes[0][a];
                dot[2] += (double)dir[a][i] * (double)axes[1][a];
                size += (double)dir[a][i] * (double)dir[a][i];
            }
            assert_true(fabs(size - 1) < 1e-5 && dot[0] > -1e-5);
            for (int a = 0; a < 3; a++)
                mean[a] += dot[a] / ambient.samples;
            for (int a = 0; a < 2; a++)
                square[a] += dot[1 + a] * dot[1 + a] / ambient.samples;
        }
        assert_true(fabs(mean[0] - 2.0 / 3) < 2e-3 && fabs(mean[1]) < 0.01 && fabs(mean[2]) < 0.01);
        assert_true(fabs(square[0] - 0.25) < 0.01 && fabs(square[1] - 0.25) < 0.01);
    }
}

TEST(seeds_and_pixels_differ)
{
    static cgt_ambient_points points;
    float dir[4][3][4] = {{{0}}};
    const float n[3] = {0, 0, 1};
    const cgt_ambient_options a = ambient_of(4, 1, 0), b = ambient_of(4, 1, 1);
    const struct {
        const cgt_ambient_options *of;
        uint32_t x, y;
    } which[4] = {{&a, 5, 6}, {&a, 6, 6}, {&a, 5, 7}, {&b, 5, 6}};
    cgt_ambient_points_init(0, 4, &points);
    for (int i = 0; i < 4; i++) {
        cgt_ambient_directions(&points, which[i].of, which[i].x, which[i].y, n,
                               (float *const[]){dir[i][0], dir[i][1], dir[i][2]});
        for (int k = 0; k < i; k++)
            assert_true(fabsf(dir[i][0][0] - dir[k][0][0]) + fabsf(dir[i][1][0] - dir[k][1][0]) > 1e-3f);
    }
}

/* Whether of 2^bits points each of 2^bits equal boxes of the unit square has one; across: 2^across boxes lie side by
 * side. */
static bool are_even(uint32_t (*point)[2], uint32_t bits, uint32_t across)
{
    const uint32_t up = bits - across;
    uint64_t seen[4] = {0};
    for (uint32_t i = 0; i < 1u << bits; i++) {
        const uint32_t x = (uint32_t)((uint64_t)point[i][0] >> (32 - across)),
                       y = (uint32_t)((uint64_t)point[i][1] >> (32 - up)), box = x << up | y;
        if (seen[box / 64] >> box % 64 & 1)
            return false;
        seen[box / 64] |= UINT64_C(1) << box % 64;
    }
    return true;
}

/* The first `samples` points of each pixel of a square, whose edge is a power of two and whose corner a multiple of
 * it. */
static void expect_even(const cgt_ambient_options *ambient, uint32_t x, uint32_t y, uint32_t edge, uint32_t samples)
{
    static cgt_ambient_points points;
    uint32_t point[256][2], count = 0, bits = 0;
    cgt_ambient_points_init(0, samples, &points);
    for (uint32_t i = 0; i < edge * edge; i++) {
        uint32_t scramble[2];
        cgt_ambient_scramble(ambient, x + i % edge, y + i / edge, scramble);
        for (uint32_t k = 0; k < samples; k++, count++)
            for (int a = 0; a < 2; a++)
                point[count][a] = points.coordinate[a][k] ^ scramble[a];
    }
    while (1u << bits < count)
        bits++;
    for (uint32_t across = 0; across <= bits; across++)
        if (!are_even(point, bits, across) && !(edge == 16 && across == 5)) /* no choice of bits has all */
            fail_msg("%u points of each pixel from (%u, %u) on, %u wide, are not even in 2^%u columns", samples, x, y,
                     edge, across);
}

TEST(pixels_of_a_square_share_the_sky)
{
    test_random r = random_make(23);
    for (uint32_t i = 0; i < test_between(20, 200); i++) {
        const cgt_ambient_options ambient = ambient_of(16, INFINITY, (uint32_t)random_bits(&r));
        const uint32_t x = random_below(&r, 4096) * 16, y = random_below(&r, 4096) * 16;
        const uint32_t within = 4 * random_below(&r, 4), two = 2 * random_below(&r, 8);
        for (uint32_t samples = 1; samples <= 4; samples *= 2) {
            expect_even(&ambient, x + within, y + 4, 4, samples);
            expect_even(&ambient, x + two, y + within, 2, samples);
        }
        expect_even(&ambient, x, y, 16, 1);
        expect_even(&ambient, x + within, y + two, 1, 256); /* a pixel alone, too */
    }
}

/* ---- odd pixels ---- */

TEST(odd_pixels_are_open)
{
    static view v;
    const float balls[2][4] = {{0, 0, 0, 1}, {0, 0, 0, 50}};
    const cgt_ambient_options ambient = ambient_of(9, INFINITY, 0);
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, balls, 2);
    light_init_projection(&v, (float[]){0, 0, 4}, (float[]){0, 0, 0});
    v.camera.fov = 10;
    look(scene, &v, &ambient, NULL);
    expect_all(&v, 0); /* inside the larger sphere */
    v.t[3] = NAN;
    v.t[4] = INFINITY;
    v.normal[1][5] = NAN;
    v.primitive[6] = CGT_INVALID_ID;
    assert_int_equal(cgt_ambient_occlusion(scene, &v.camera, &v.frame, &ambient, v.visibility, NULL), CGT_OK);
    for (uint32_t x = 0; x < WIDTH; x++)
        assert_true(v.visibility[x] == (x >= 3 && x <= 6 ? 1 : 0));
    v.primitive[7] = 2; /* ids of no primitive skip nothing */
    v.geometry[8] = CGT_INVALID_ID;
    assert_int_equal(cgt_ambient_occlusion(scene, &v.camera, &v.frame, &ambient, v.visibility, NULL), CGT_OK);
    assert_true(v.visibility[7] == 0 && v.visibility[8] == 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

SEEDED_SUITE("test_ambient_occlusion", NULL, NULL)
