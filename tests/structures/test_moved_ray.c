/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Moved rays against wide arithmetic: the moved origin lies on the line but for its error, near the scene where the
 * line passes it; ends of the range stay on their sides. Then the error is made smaller until it does not hold. Last,
 * all calls decide what is smaller than that error. */
#include <float.h>
#include <math.h>

#include "query/moved_ray.h"
#include "support/suite.h"
#include "support/oracle/oracle.h"
#include "support/ray_arrays.h"
#include "support/scenes.h"
#include "support/test.h"
#include "support/tightened.h"

/* A ray from up to 2^30 away, so that wide arithmetic loses nothing, towards a scene of size 2^size. */
static cgt_ray make_ray(test_random *r, int size, cgt_committed_scene *committed_scene)
{
    cgt_ray ray = {.t_min = random_below(r, 2) ? 0 : -INFINITY, .t_max = INFINITY};
    const float far = random_log(r, 1, 0x1p30f), length = ldexpf(1, (int)random_below(r, 200) - 100);
    float d[3];
    random_direction(r, d);
    committed_scene->scale = ldexpf(1, -size);
    for (int a = 0; a < 3; a++) {
        const float aim = random_float(r, -1, 1);
        committed_scene->low[a] = -ldexpf(random_float(r, 0.5f, 1), size);
        committed_scene->high[a] = ldexpf(random_float(r, 0.5f, 1), size);
        ray.line.org[a] = ldexpf(aim - d[a] * far, size);
        ray.line.dir[a] = d[a] * length;
    }
    if (random_below(r, 2))
        ray.t_min = ldexpf(far / length * random_float(r, 0.999f, 1.001f), size);
    return ray;
}

typedef struct tally {
    uint64_t off; /* origins off by more than their error */
} tally;

/* Checks the range of a moved ray, and that its origin is near. */
static void check_range(const moved_ray *m, const cgt_ray *ray)
{
    const truth_real begin = (truth_real)ray->t_min * m->speed - (truth_real)m->way;
    if (fabsf(ray->t_min) < INFINITY) {
        assert_true((truth_real)m->near_out < begin && begin < (truth_real)m->near_in);
        const double width = (double)m->near_in - (double)m->near_out;
        assert_true(width <= (fabs(ray->t_min * m->speed) + fabs(m->way)) * 0x1p-18 + 0x1p-80 * (1 + m->speed));
    }
    assert_true(m->far_out >= m->far_in && m->near_out <= m->near_in);
    for (int a = 0; a < 3; a++)
        assert_true(fabs(m->org[a]) < 16.5);
}

TEST(moved_rays_stay_on_their_lines)
{
    tally of[STEPS] = {{0}};
    test_random r = random_make(1);
    uint32_t ready = 0;
    const uint32_t rays = 2000 + test_scaled(18000);
    for (uint32_t i = 0; i < rays; i++) {
        cgt_committed_scene committed_scene = {0};
        const cgt_ray ray = make_ray(&r, (int)random_below(&r, 60) - 30, &committed_scene);
        moved_ray m = {.way = 0};
        const moved_state moved = moved_ray_init(&m, &committed_scene, &ray);
        assert_true(moved != MOVED_TOO_FAR);
        if (moved == MOVED_MISS)
            continue;
        truth_real off = 0;
        ready++;
        check_range(&m, &ray);
        if (i % 2 && m.way != 0) { /* to the same place by its t */
            const float at = (float)(m.way / m.speed);
            if (moved_ray_init_at(&m, &committed_scene, &ray, &at) != MOVED_READY)
                continue;
            assert_true(m.way == (double)at * m.speed);
        }
        for (int a = 0; a < 3; a++) {
            const truth_real x = (truth_real)ray.line.org[a] * committed_scene.scale + (truth_real)m.way * m.dir[a];
            off += x > m.start[a] ? x - m.start[a] : m.start[a] - x;
        }
        double scale = 1;
        for (int step = 0; step < bound_steps(); step++, scale *= 0.70710678)
            of[step].off += off > (truth_real)(m.start_error * scale);
    }
    print_message("%u of %u rays pass the scene\n", ready, rays);
    assert_true(ready > rays / 4);
    check_break("origins", of, sizeof of[0], offsetof(tally, off), 0.5);
}

/* What the largest floats and the least lead to. */
TEST(ends_of_float)
{
    const cgt_committed_scene committed_scene = {.low = {-1, -1, -1}, .high = {1, 1, 1}, .scale = 1};
    static const float size[] = {0x1p-149f, 0x1p-126f, 1, 0x1p100f, FLT_MAX};
    for (size_t i = 0; i < TEST_COUNT(size); i++)
        for (size_t k = 0; k < TEST_COUNT(size); k++) {
            cgt_ray ray = {.line = {.org = {0.5f, -size[i], 0.25f}, .dir = {0, size[k], 0}}, .t_max = INFINITY};
            moved_ray m = {.way = 0};
            const double t = ((double)size[i] - 1) / (double)size[k]; /* beyond the largest float there is no hit */
            const moved_state moved = moved_ray_init(&m, &committed_scene, &ray);
            if (t > 0x1p130)
                assert_int_equal(moved, MOVED_MISS);
            else if (t < 0x1p127)
                assert_int_equal(moved, MOVED_READY);
            if (moved != MOVED_READY)
                continue;
            assert_true(m.start[0] == 0.5f && m.start[2] == 0.25f && m.dir[1] >= 1 && m.dir[1] < 2);
            assert_true(m.start_error < 0x1p-19f);
            ray.line.org[1] = 2;
            assert_int_equal(moved_ray_init(&m, &committed_scene, &ray), MOVED_MISS);
            ray.line.org[1] = -size[i];
            ray.line.org[2] = FLT_MAX;
            assert_int_equal(moved_ray_init(&m, &committed_scene, &ray), MOVED_MISS);
        }
}

/* ---- primitives at moved origins ---- */

#define TINY 32u   /* in one leaf or two, each with a ray of its own */
#define COPIES 64u /* of the rays: as many go as streams */
#define SIZE 0x1p-12f

/* Tiny spheres and triangles near a place that the foot of a ray from afar is near, too, and where floats are coarse:
 * the moved origin is off by more than leaves allow for at that distance. The last two primitives are the scene's ends,
 * so that its middle is the origin. */
typedef struct tiny {
    float sphere[TINY + 2][4], corner[TINY + 2][9];
    truth_ray ray[TINY * COPIES];
} tiny;

static double along(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double random_real(test_random *r) { return (double)random_float(r, -1, 1); }

/* A vector of this length, across d. */
static void random_across(test_random *r, const double d[3], double length, double v[3])
{
    float any[3];
    random_direction(r, any);
    const double share = ((double)any[0] * d[0] + (double)any[1] * d[1] + (double)any[2] * d[2]) / along(d, d);
    for (int a = 0; a < 3; a++)
        v[a] = (double)any[a] - share * d[a];
    const double scale = length / sqrt(along(v, v));
    for (int a = 0; a < 3; a++)
        v[a] *= scale;
}

/* Aims a ray at a place from afar. foot: where it passes, off by what floats of the origin are. */
static void aim_from_afar(test_random *r, const float dir[3], const double place[3], truth_ray *ray, double foot[3])
{
    const double far = (double)random_log(r, 0x1p9f, 0x1p12f);
    double d[3], to[3];
    *ray = (truth_ray){.t_max = INFINITY};
    for (int a = 0; a < 3; a++) {
        d[a] = (double)dir[a];
        ray->dir[a] = dir[a];
        ray->org[a] = (float)(place[a] - far * d[a]);
        to[a] = place[a] - (double)ray->org[a];
    }
    const double t = along(to, d) / along(d, d);
    for (int a = 0; a < 3; a++)
        foot[a] = (double)ray->org[a] + t * d[a];
}

/* A sphere and a triangle whose silhouettes pass the ray at a few times the error of its origin. */
static void make_tiny_pair(test_random *r, const double d[3], const double foot[3], float sphere[4], float corner[9])
{
    double side[3], edge[3], offset[3], square = 0, share = 0;
    random_across(r, d, (double)SIZE, side);
    for (int a = 0; a < 3; a++) {
        sphere[a] = (float)(foot[a] + side[a]);
        offset[a] = (double)sphere[a] - foot[a];
    }
    share = along(offset, d) / along(d, d);
    for (int a = 0; a < 3; a++)
        square += (offset[a] - share * d[a]) * (offset[a] - share * d[a]);
    sphere[3] = (float)(sqrt(square) + random_real(r) * 0x1p-25);
    random_across(r, d, (double)SIZE, edge);
    for (int a = 0; a < 3; a++) {
        const double at = foot[a] + 0x1p-25 * random_real(r);
        corner[a] = (float)(at + edge[a]);
        corner[3 + a] = (float)(at - edge[a]);
        corner[6 + a] = (float)(at + side[a]);
    }
}

static void make_tiny(test_random *r, tiny *s)
{
    float dir[3];
    double d[3], place[3];
    random_direction(r, dir);
    for (int a = 0; a < 3; a++)
        d[a] = (double)dir[a];
    random_across(r, d, (double)random_float(r, 1.2f, 1.8f), place);
    for (uint32_t i = 0; i < TINY; i++) {
        double to[3], foot[3];
        for (int a = 0; a < 3; a++)
            to[a] = place[a] + 4 * (double)SIZE * random_real(r);
        aim_from_afar(r, dir, to, &s->ray[i], foot);
        make_tiny_pair(r, d, foot, s->sphere[i], s->corner[i]);
    }
    for (uint32_t i = TINY; i < TINY * COPIES; i++)
        s->ray[i] = s->ray[i % TINY];
    for (uint32_t i = TINY; i < TINY + 2; i++)
        for (int k = 0; k < 9; k++) {
            const float end = i == TINY ? -1.9f : 1.9f;
            s->corner[i][k] = end - (k / 3 == k % 3 ? copysignf(0x1p-10f, end) : 0);
            if (k < 4)
                s->sphere[i][k] = k < 3 ? end : 0x1p-20f;
        }
}

static void judge_tiny(const cgt_scene *scene, const oracle_scene *truth, const truth_ray *rays, uint32_t count)
{
    static full_hit hit[TINY * COPIES];
    static uint8_t occluded[TINY * COPIES];
    const cgt_rays array = ray_array(rays, count);
    assert_int_equal(trace_array(scene, rays, count, hit, NULL), CGT_OK);
    assert_int_equal(cgt_occluded_rays(scene, &array, occluded, NULL), CGT_OK);
    for (uint32_t i = 0; i < count; i++) {
        const cgt_single_ray one = single_ray(&rays[i]);
        cgt_hit found = {.primitive = hit[i % TINY].primitive};
        oracle_hit exact;
        if (i < TINY) {
            assert_int_equal(oracle_judge(truth, &rays[i], hit[i].geometry, hit[i].primitive, &exact), ORACLE_RIGHT);
            assert_int_equal(cgt_trace_ray(scene, &one, &found, NULL), CGT_OK);
        }
        assert_int_equal(hit[i].primitive, found.primitive);
        assert_int_equal(occluded[i], hit[i].primitive != CGT_INVALID_ID);
    }
}

TEST(tiny_primitives_at_moved_origins)
{
    static tiny s;
    cgt_context *context = context_make(1, NULL);
    test_random r = random_make(2);
    const uint32_t scenes = 4 + test_scaled(16);
    for (uint32_t i = 0; i < 2 * scenes; i++) {
        const cgt_spheres spheres = spheres_of((const float(*)[4])s.sphere, TINY + 2);
        const cgt_triangles triangles = {
            .count = TINY + 2, .vertex_count = 3 * (TINY + 2), .vertices = cgt_floats(&s.corner[0][0], 0)};
        cgt_scene_options options;
        cgt_scene *scene;
        oracle_scene truth = {0};
        cgt_scene_options_init(&options);
        options.structure = CGT_STRUCTURE_BVH;
        make_tiny(&r, &s);
        assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
        if (i % 2) {
            oracle_scene_add_spheres(&truth, 0, (const float(*)[4])s.sphere, TINY + 2);
            assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
        } else {
            oracle_scene_add_triangles(&truth, 0, (const float(*)[3])(const void *)s.corner, 3 * (TINY + 2), NULL,
                                       TINY + 2);
            assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
        }
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        judge_tiny(scene, &truth, s.ray, TINY);
        judge_tiny(scene, &truth, s.ray, TINY * COPIES);
        oracle_scene_free(&truth);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

SEEDED_SUITE("test_moved_ray", NULL, NULL)
