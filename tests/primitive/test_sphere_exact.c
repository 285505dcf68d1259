/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One sphere and hard rays through the public calls of every variant, against the exact oracle: hit or miss, t and
 * normals, the ends of the range, and ties. */
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <string.h>

#include "support/oracle/oracle.h"

#define RAYS 256

static cgt_context *context; /* of the variant under test */

/* A scene of one sphere; structures take turns. */
static cgt_scene *scene_of_one(const float sphere[4])
{
    static uint32_t turn;
    const cgt_scene_options made = structure_in_turn(turn++);
    return scene_of(context, &made, (const float(*)[4])sphere, 1);
}

/* cgt.h: t within 0.51 ulp, the normal as a vector within 2^-23 + 2^-48 c / r. */
static void check_values(const float sphere[4], const truth_ray *ray, const ray_hit *hit, const oracle_hit *truth)
{
    double distance = 0, off = 0;
    for (int a = 0; a < 3; a++) {
        const double c = (double)sphere[a] - ray->org[a], n = (double)(truth->normal[a] - hit->normal[a]);
        distance += c * c;
        off += n * n;
    }
    if (!(oracle_ulp(truth->t, hit->t) <= 0.51))
        fail_msg("t is %g ulp off", oracle_ulp(truth->t, hit->t));
    if (!(sqrt(off) <= 0x1p-23 + (sphere[3] > 0 ? 0x1p-48 * sqrt(distance) / sphere[3] : 0)))
        fail_msg("the normal is %g off", sqrt(off));
}

/* Traces the rays against one sphere and judges each. Returns the number of hits. */
static uint32_t judge(const float sphere[4], const truth_ray *ray, uint32_t count)
{
    ray_hit hit[RAYS];
    oracle_primitive p = {.kind = ORACLE_SPHERE};
    const oracle_scene scene_of_truth = {.primitive = &p, .count = 1};
    uint32_t hits = 0;
    memcpy(p.data, sphere, 4 * sizeof *sphere);
    cgt_scene *scene = scene_of_one(sphere);
    rays_trace(scene, ray, count, hit, NULL);
    for (uint32_t i = 0; i < count; i++) {
        oracle_hit truth;
        const oracle_verdict verdict =
            oracle_judge(&scene_of_truth, &ray[i], hit[i].geometry, hit[i].primitive, &truth);
        if (verdict != ORACLE_RIGHT)
            fail_msg("%s: verdict %d, t %a: sphere %a %a %a r %a, org %a %a %a, dir %a %a %a",
                     cgt_context_get_variant(context), (int)verdict, (double)hit[i].t, (double)sphere[0],
                     (double)sphere[1], (double)sphere[2], (double)sphere[3], (double)ray[i].org[0],
                     (double)ray[i].org[1], (double)ray[i].org[2], (double)ray[i].dir[0], (double)ray[i].dir[1],
                     (double)ray[i].dir[2]);
        if (hit[i].geometry == CGT_INVALID_ID)
            continue;
        check_values(sphere, &ray[i], &hit[i], &truth);
        hits++;
    }
    cgt_scene_release(scene);
    return hits;
}

/* Directions that pass the centre at up to `width` times the outline's half width. */
static truth_ray aim(test_random *r, const float org[3], const float sphere[4], float width, float length)
{
    truth_ray ray = {.t_min = 0, .t_max = INFINITY};
    float d[3];
    double cc = 0, dc = 0, square = 0;
    random_direction(r, d);
    for (int a = 0; a < 3; a++) {
        const double c = (double)sphere[a] - org[a];
        cc += c * c;
        dc += c * d[a];
    }
    for (int a = 0; a < 3 && cc > 0; a++) {
        d[a] = (float)(d[a] - dc / cc * ((double)sphere[a] - org[a]));
        square += (double)d[a] * d[a];
    }
    const double rr = (double)sphere[3] * sphere[3], outline = cc > rr * (1 + 1e-7) ? 1 / sqrt(1 - rr / cc) : 1;
    const double k = random_below(r, 4) ? random_float(r, 0, width)
                     : width > 1        ? 1 + 1e-6 * random_float(r, -1, 1)
                                        : width;
    const double reach = k * sphere[3] * outline / sqrt(square > 0 ? square : 1);
    for (int a = 0; a < 3; a++) {
        ray.org[a] = org[a];
        ray.dir[a] = (float)((sphere[a] + reach * d[a] - org[a]) * length);
    }
    if (ray.dir[0] == 0 && ray.dir[1] == 0 && ray.dir[2] == 0)
        ray.dir[1] = length;
    return ray;
}

static void any_origin(test_random *r, const float sphere[4], float distance, float org[3])
{
    float d[3];
    random_direction(r, d);
    for (int a = 0; a < 3; a++)
        org[a] = (float)(sphere[a] + (double)distance * sphere[3] * d[a]);
}

/* ---- accuracy ---- */

TEST(any_distance_and_size)
{
    static const struct {
        float distance, low_r, high_r; /* the distance in radii */
    } rows[] = {{2, 0.5f, 2},       {1e1f, 0.5f, 2},        {1e2f, 0.5f, 2},   {1e3f, 0.5f, 2},
                {1e4f, 0.5f, 2},    {1e5f, 0.5f, 2},        {1e6f, 0.5f, 2},   {1.00001f, 0.5f, 2}, /* at the surface */
                {0.5f, 0.5f, 2},                                                                    /* inside */
                {3, 1e4f, 1e8f},    {1.00001f, 1e4f, 1e8f}, {3, 1e-8f, 1e-4f}, {3, 1e17f, 1e18f},   /* beyond 2^55 */
                {3, 1e-30f, 1e-20f}};
    for (size_t row = 0; row < TEST_COUNT(rows); row++) {
        uint32_t hits = 0, rays = 0;
        for (uint32_t round = 0; round < test_scaled(60); round++, rays += RAYS) {
            test_random r = random_make(round);
            truth_ray ray[RAYS];
            float sphere[4], org[3];
            for (int a = 0; a < 3; a++)
                sphere[a] = random_float(&r, -3, 3) * (round % 2 ? 1 : rows[row].high_r);
            sphere[3] = random_log(&r, rows[row].low_r, rows[row].high_r);
            for (int i = 0; i < RAYS; i++) {
                any_origin(&r, sphere, rows[row].distance, org);
                ray[i] = aim(&r, org, sphere, i % 3 ? 1.02f : 1.0001f, i % 5 ? 1 : random_log(&r, 1e-12f, 1e12f));
            }
            hits += judge(sphere, ray, RAYS);
        }
        assert_true(hits > rays / 4);
    }
}

/* Of any length; a direction scaled by a power of two divides t by it exactly. */
TEST(any_length)
{
    test_random r = random_make(100);
    const float sphere[4] = {0.3f, -0.7f, 9.1f, 1.7f};
    cgt_scene *scene = scene_of_one(sphere);
    for (uint32_t round = 0; round < test_scaled(20); round++)
        for (int k = -100; k <= 100; k += 10) {
            truth_ray ray[RAYS], scaled[RAYS];
            ray_hit hit[RAYS], scaled_hit[RAYS];
            for (int i = 0; i < RAYS; i++) {
                ray[i] = scaled[i] = aim(&r, (const float[3]){0, 0, 0}, sphere, 1.1f, 1);
                for (int a = 0; a < 3; a++) {
                    scaled[i].dir[a] = ldexpf(ray[i].dir[a], k);
                    if (ldexpf(scaled[i].dir[a], -k) != ray[i].dir[a]) /* has become denormal */
                        scaled[i].dir[a] = ray[i].dir[a] = 0;
                }
            }
            rays_trace(scene, ray, RAYS, hit, NULL);
            rays_trace(scene, scaled, RAYS, scaled_hit, NULL);
            for (int i = 0; i < RAYS; i++) {
                hit[i].t = ldexpf(hit[i].t, -k);
                assert_memory_equal(&scaled_hit[i], &hit[i], sizeof hit[i]);
            }
        }
    cgt_scene_release(scene);
    for (int k = -30; k <= 30; k += 5) { /* 1e-30 to 1e30 */
        truth_ray ray[RAYS];
        for (int i = 0; i < RAYS; i++)
            ray[i] = aim(&r, (const float[3]){0, 0, 0}, sphere, 1.05f, (float)pow(10, k) * 0.1f);
        assert_true(judge(sphere, ray, RAYS) > RAYS / 2);
    }
}

/* ---- special positions ---- */

static float t_of(const float sphere[4], truth_ray ray)
{
    cgt_scene *scene = scene_of_one(sphere);
    const ray_hit hit = ray_trace(scene, ray);
    assert_true((hit.primitive == CGT_INVALID_ID) == (hit.t == INFINITY));
    cgt_scene_release(scene);
    return hit.t;
}

TEST(special_positions)
{
    const float s[4] = {0, 0, 0, 5}, shifted[4] = {96, -32, 64, 5};
    static const float away[][3] = {{1, 0, 0}, {3, 4, 0},  {-1, -2, 0.5f}, {4, -3, 0},
                                    {0, 0, 1}, {-4, 3, 1}, {-3, -4, 0}};
    for (size_t i = 0; i < TEST_COUNT(away); i++) { /* an origin on the surface: rays outwards, inwards, tangential */
        const float *d = away[i];
        assert_true(t_of(s, (truth_ray){{3, 4, 0}, {d[0], d[1], d[2]}, 0, INFINITY}) == 0);
        assert_true(t_of(shifted, (truth_ray){{99, -28, 64}, {d[0], d[1], d[2]}, 0, INFINITY}) == 0);
    }
    assert_true(t_of(s, (truth_ray){{0, 0, 0}, {0, 0, 2}, 0, INFINITY}) == 2.5f); /* at the centre: the far side */
    assert_true(t_of(s, (truth_ray){{0, 0, 3}, {0, 0, -1}, 0, INFINITY}) == 8);
    assert_true(t_of(s, (truth_ray){{0, 0, 7}, {0, 0, 1}, 0, INFINITY}) == INFINITY); /* behind */
    assert_true(t_of(s, (truth_ray){{0, 0, 7}, {0, 0, 1}, -3, INFINITY}) == -2);      /* within the given range */
    assert_true(t_of(s, (truth_ray){{0, 0, 7}, {0, 0, 1}, -100, INFINITY}) == -12);
    /* tangent: one ulp decides */
    const truth_ray along = {{0, 0, 0}, {0, 0, 1}, 0, INFINITY};
    assert_true(t_of((const float[4]){1, 0, 8, 1}, along) == 8);
    assert_true(t_of((const float[4]){1, 0, 8, nextafterf(1, 2)}, along) < 8);
    assert_true(t_of((const float[4]){1, 0, 8, nextafterf(1, 0)}, along) == INFINITY);
}

/* Rays through a sphere of radius 0 and past it. Its normal points to the origin of the ray. */
TEST(zero_radius)
{
    const float point[4] = {3, -2, 7, 0};
    test_random r = random_make(7);
    truth_ray ray[RAYS];
    for (int i = 0; i < RAYS; i++) {
        const float k = ldexpf(1, (int)random_below(&r, 8) - 2);
        ray[i] = (truth_ray){.t_min = 0, .t_max = INFINITY};
        for (int a = 0; a < 3; a++) {
            ray[i].dir[a] = i % 4 < 2 ? (float)random_below(&r, 64) - 31.5f : a == i % 3 ? 0 : 0.5f;
            ray[i].org[a] = point[a] - k * ray[i].dir[a]; /* exact */
        }
        ray[i].org[i % 3] += i % 2 ? 0x1p-10f : 0;
    }
    assert_int_equal(judge(point, ray, RAYS), RAYS / 2);
}

/* ---- range ---- */

static void check_range(const cgt_scene *scene, truth_ray ray, float t)
{
    const float step = t == 0 ? -0x1p-149f : nextafterf(t, -INFINITY);
    ray.t_max = t;
    assert_true(ray_trace(scene, ray).t == t); /* closed above */
    if (step >= ray.t_min) {
        ray.t_max = step;
        assert_true(ray_trace(scene, ray).t == INFINITY);
    }
    ray.t_max = INFINITY;
    ray.t_min = t;
    assert_true(ray_trace(scene, ray).t == t); /* and below */
    ray.t_max = t;
    assert_true(ray_trace(scene, ray).t == t); /* a range of one number */
    ray.t_min = nextafterf(t, INFINITY);
    assert_true(ray_trace(scene, ray).t == INFINITY); /* above the end */
    ray.t_max = INFINITY;
    const float next = ray_trace(scene, ray).t; /* the other root, or none */
    assert_true(next > t);
    if (next == INFINITY)
        return;
    ray.t_min = next;
    assert_true(ray_trace(scene, ray).t == next);
    ray.t_min = nextafterf(next, INFINITY);
    assert_true(ray_trace(scene, ray).t == INFINITY);
}

TEST(range_is_closed_at_both_ends)
{
    test_random r = random_make(9);
    uint32_t hits = 0;
    for (uint32_t round = 0; round < test_scaled(150); round++) {
        float sphere[4], org[3];
        for (int a = 0; a < 3; a++)
            sphere[a] = random_float(&r, -100, 100);
        sphere[3] = random_log(&r, 1e-3f, 1e3f);
        cgt_scene *scene = scene_of_one(sphere);
        for (int i = 0; i < 16; i++) {
            any_origin(&r, sphere, random_log(&r, 0.1f, 1e4f), org);
            const truth_ray ray = aim(&r, org, sphere, 1, random_log(&r, 1e-3f, 1e3f));
            const float t = ray_trace(scene, ray).t;
            if (t != INFINITY)
                check_range(scene, ray, t), hits++;
        }
        cgt_scene_release(scene);
    }
    assert_true(hits > test_scaled(150) * 8);
}

/* ---- ties ---- */

/* Copies of one sphere in two geometries, and smaller ones inside: the first copy of the first geometry wins. */
TEST(ties_go_to_the_lowest_id)
{
    enum { N = 40 };
    test_random r = random_make(11);
    for (uint32_t round = 0; round < test_scaled(40); round++) {
        float sphere[2][N][4], q[4] = {0, 0, 0, random_float(&r, 0.5f, 1)};
        uint32_t first[2] = {CGT_INVALID_ID, CGT_INVALID_ID};
        const cgt_scene_options made = structure_in_turn(round);
        cgt_scene *scene = NULL;
        for (int a = 0; a < 3; a++)
            q[a] = random_float(&r, -2, 2);
        assert_int_equal(cgt_scene_create(context, &made, &scene), CGT_OK);
        for (uint32_t g = 0; g < 2; g++) {
            for (uint32_t i = N; i-- > 0;) {
                memcpy(sphere[g][i], q, sizeof q);
                if (random_below(&r, 2))
                    sphere[g][i][3] *= random_float(&r, 0.2f, 0.9f);
                else
                    first[g] = i;
            }
            const cgt_spheres spheres = spheres_of((const float(*)[4])sphere[g], N);
            assert_int_equal(cgt_scene_add_spheres(scene, &spheres, NULL), CGT_OK);
        }
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        truth_ray ray[RAYS];
        ray_hit hit[RAYS];
        for (int i = 0; i < RAYS; i++)
            ray[i] = aim(&r, (const float[3]){5, 6, 7}, q, 0.99f, 1);
        rays_trace(scene, ray, RAYS, hit, NULL);
        const uint32_t geometry = first[0] == CGT_INVALID_ID;
        for (int i = 0; i < RAYS; i++)
            assert_true(hit[i].geometry == geometry && hit[i].primitive == first[geometry]);
        cgt_scene_release(scene);
    }
}

int main(void)
{
    int failed = 0;
    test_begin("test_sphere_exact");
    FOR_EACH_VARIANT(variant)
    {
        context = context_make(1, variant);
        failed += _cmocka_run_group_tests(variant, suite, suite_count, NULL, NULL);
        cgt_context_release(context);
    }
    return failed;
}
