/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Moved rays against wide arithmetic: the moved origin lies on the line but for its error, near the scene where the
 * line passes it; ends of the range stay on their sides. Then the error is made smaller until it does not hold. No
 * profile of tests/driver, whose `afar` judges the hits of such rays: this measures one function's bounds. */
#include <float.h>
#include <math.h>

#include "query/moved_ray.h"
#include "support/suite.h"
#include "support/oracle/truth.h"
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

SEEDED_SUITE("test_moved_ray", NULL, NULL)
