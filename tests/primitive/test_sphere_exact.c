/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * One sphere and hard rays through the public calls of every variant: hit or miss and t against wide arithmetic, the
 * ends of the range, and ties. */
#include "support/scenes.h"

#include <math.h>
#include <string.h>

#define RAYS 256

static cgt_context *context; /* of the variant under test */

/* A scene of one sphere; structures take turns. */
static cgt_scene *scene_of_one(const float sphere[4])
{
    static uint32_t turn;
    const cgt_scene_options made = structure_in_turn(turn++);
    return scene_of(context, &made, (const float(*)[4])sphere, 1);
}

static void for_each_variant(void (*test)(void))
{
    FOR_EACH_VARIANT(variant)
    {
        context = context_make(1, variant);
        test();
        cgt_context_release(context);
    }
}

/* Counts of a family of rays, to check that the intended cases occurred. */
typedef struct tally {
    uint64_t rays, hits, doubts, loose; /* loose: t farther off than the header states; allowed only for grazing rays */
} tally;

/* Traces the rays against one sphere and judges each by the truth. */
static tally judge(const float sphere[4], const truth_ray *ray, uint32_t count)
{
    ray_hit hit[RAYS];
    tally sum = {.rays = count};
    const truth_scene truth = {(const float(*)[4])sphere, 1};
    cgt_scene *scene = scene_of_one(sphere);
    rays_trace(scene, ray, count, hit, NULL);
    for (uint32_t i = 0; i < count; i++) {
        const char *wrong = truth_judge(&truth, &ray[i], hit[i].primitive, hit[i].t, &sum.doubts);
        if (wrong)
            fail_msg("%s (%s, t %a): sphere %a %a %a r %a, org %a %a %a, dir %a %a %a", wrong,
                     cgt_context_get_variant(context), (double)hit[i].t, (double)sphere[0], (double)sphere[1],
                     (double)sphere[2], (double)sphere[3], (double)ray[i].org[0], (double)ray[i].org[1],
                     (double)ray[i].org[2], (double)ray[i].dir[0], (double)ray[i].dir[1], (double)ray[i].dir[2]);
        if (hit[i].primitive == CGT_INVALID_ID)
            continue;
        sum.hits++;
        const truth_roots roots = truth_sphere(ray[i].org, ray[i].dir, sphere);
        const truth_real exact = (float)roots.near >= ray[i].t_min ? roots.near : roots.far;
        if (!roots.hit || truth_accepts_strictly(ray[i].org, ray[i].dir, sphere, exact, hit[i].t))
            continue;
        sum.loose++;
        /* grazing: the half chord is less than 2^-12 of the geometric mean of radius and distance */
        const double r = sphere[3];
        double distance = 0;
        for (int a = 0; a < 3; a++)
            distance += pow((double)sphere[a] - ray[i].org[a], 2);
        assert_true(roots.h < 0x1p-24 * r * (sqrt(distance) + r));
    }
    cgt_scene_release(scene);
    return sum;
}

static void add_tally(tally *sum, tally t)
{
    sum->rays += t.rays;
    sum->hits += t.hits;
    sum->doubts += t.doubts;
    sum->loose += t.loose;
}

static void print_tally(const char *what, tally t)
{
    print_message("%s, %s: %llu rays, %llu hits, %llu beyond double, %llu grazing with t off\n",
                  cgt_context_get_variant(context), what, (unsigned long long)t.rays, (unsigned long long)t.hits,
                  (unsigned long long)t.doubts, (unsigned long long)t.loose);
}

/* Directions that pass the centre at up to `width` times the outline's half width, of a random length. */
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

static void from_distance(float distance, float low_r, float high_r, const char *what)
{
    tally sum = {0};
    for (uint32_t round = 0; round < test_scaled(60); round++) {
        test_random r = random_make(round);
        truth_ray ray[RAYS];
        float sphere[4], org[3];
        for (int a = 0; a < 3; a++)
            sphere[a] = random_float(&r, -3, 3) * (round % 2 ? 1 : high_r);
        sphere[3] = random_log(&r, low_r, high_r);
        for (int i = 0; i < RAYS; i++) {
            any_origin(&r, sphere, distance, org);
            ray[i] = aim(&r, org, sphere, i % 3 ? 1.02f : 1.0001f, i % 5 ? 1 : random_log(&r, 1e-12f, 1e12f));
        }
        add_tally(&sum, judge(sphere, ray, RAYS));
    }
    print_tally(what, sum);
    assert_true(sum.hits > sum.rays / 4 && sum.doubts < sum.rays / 1000 + 2);
}

static void near_and_far_rays(void)
{
    from_distance(2, 0.5f, 2, "2 r");
    from_distance(1e1f, 0.5f, 2, "1e1 r");
    from_distance(1e2f, 0.5f, 2, "1e2 r");
    from_distance(1e3f, 0.5f, 2, "1e3 r");
    from_distance(1e4f, 0.5f, 2, "1e4 r");
    from_distance(1e5f, 0.5f, 2, "1e5 r");
    from_distance(1e6f, 0.5f, 2, "1e6 r");
    from_distance(1.00001f, 0.5f, 2, "at the surface");
    from_distance(0.5f, 0.5f, 2, "inside");
    from_distance(3, 1e4f, 1e8f, "huge");
    from_distance(1.00001f, 1e4f, 1e8f, "huge, at the surface");
    from_distance(3, 1e-8f, 1e-4f, "tiny");
    from_distance(3, 1e17f, 1e18f, "beyond 2^55");
    from_distance(3, 1e-30f, 1e-20f, "minute");
}

static void near_and_far(void **state)
{
    (void)state;
    for_each_variant(near_and_far_rays);
}

/* A direction scaled by a power of two divides t by it exactly. */
static void any_length_rays(void)
{
    test_random r = random_make(100);
    const float sphere[4] = {0.3f, -0.7f, 9.1f, 1.7f};
    cgt_scene *scene = scene_of_one(sphere);
    for (uint32_t round = 0; round < test_scaled(20); round++) {
        truth_ray ray[RAYS], scaled[RAYS];
        ray_hit hit[RAYS], scaled_hit[RAYS];
        for (int i = 0; i < RAYS; i++)
            ray[i] = aim(&r, (const float[3]){0, 0, 0}, sphere, 1.1f, 1);
        rays_trace(scene, ray, RAYS, hit, NULL);
        for (int k = -100; k <= 100; k += 10) {
            for (int i = 0; i < RAYS; i++) {
                scaled[i] = ray[i];
                for (int a = 0; a < 3; a++) {
                    scaled[i].dir[a] = ldexpf(ray[i].dir[a], k);
                    if (ldexpf(scaled[i].dir[a], -k) != ray[i].dir[a])
                        scaled[i].dir[a] = ray[i].dir[a] = 0;
                }
            }
            if (k < 0)
                rays_trace(scene, ray, RAYS, hit, NULL); /* some lost a component that became denormal */
            rays_trace(scene, scaled, RAYS, scaled_hit, NULL);
            for (int i = 0; i < RAYS; i++) {
                assert_int_equal(scaled_hit[i].primitive, hit[i].primitive);
                assert_true(same_bits(scaled_hit[i].t, ldexpf(hit[i].t, -k)));
                for (int a = 0; a < 3; a++)
                    assert_true(same_bits(scaled_hit[i].normal[a], hit[i].normal[a]));
            }
        }
    }
    cgt_scene_release(scene);
    for (int k = -30; k <= 30; k += 5) { /* 1e-30 to 1e30 */
        truth_ray ray[RAYS];
        for (int i = 0; i < RAYS; i++)
            ray[i] = aim(&r, (const float[3]){0, 0, 0}, sphere, 1.05f, (float)pow(10, k) * 0.1f);
        const tally t = judge(sphere, ray, RAYS);
        assert_true(t.hits > RAYS / 2);
    }
}

static void any_length(void **state)
{
    (void)state;
    for_each_variant(any_length_rays);
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

static void special_positions_rays(void)
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
    assert_true(t_of(s, (truth_ray){{0, 0, 3}, {0, 0, 1}, 0, INFINITY}) == 2);
    assert_true(t_of(s, (truth_ray){{0, 0, 3}, {0, 0, -1}, 0, INFINITY}) == 8);
    assert_true(t_of(s, (truth_ray){{0, 0, 7}, {0, 0, 1}, 0, INFINITY}) == INFINITY); /* behind */
    assert_true(t_of(s, (truth_ray){{0, 0, 7}, {0, 0, 1}, -3, INFINITY}) == -2);      /* within the given range */
    assert_true(t_of(s, (truth_ray){{0, 0, 7}, {0, 0, 1}, -100, INFINITY}) == -12);
    /* tangent: one ulp decides */
    const float tangent[4] = {1, 0, 8, 1}, wider[4] = {1, 0, 8, nextafterf(1, 2)},
                thinner[4] = {1, 0, 8, nextafterf(1, 0)};
    assert_true(t_of(tangent, (truth_ray){{0, 0, 0}, {0, 0, 1}, 0, INFINITY}) == 8);
    assert_true(t_of(wider, (truth_ray){{0, 0, 0}, {0, 0, 1}, 0, INFINITY}) < 8);
    assert_true(t_of(thinner, (truth_ray){{0, 0, 0}, {0, 0, 1}, 0, INFINITY}) == INFINITY);
}

static void special_positions(void **state)
{
    (void)state;
    for_each_variant(special_positions_rays);
}

/* A sphere of radius 0 is hit if double precision finds a distance of zero: always if d.d is a power of two; usually,
 * but not always, if its reciprocal is rounded; never if the line misses the point. */
static void zero_radius_rays(void)
{
    enum { ROUNDS = 300 };
    const float point[4] = {3, -2, 7, 0};
    test_random r = random_make(7);
    uint32_t through = 0;
    for (int i = 0; i < ROUNDS; i++) {
        truth_ray ray = {.t_min = 0, .t_max = INFINITY};
        const float k = ldexpf(1, (int)random_below(&r, 8) - 2);
        const bool diagonal = i % 2;
        for (int a = 0; a < 3; a++) {
            if (diagonal)
                ray.dir[a] = a == i % 3 ? 0 : random_below(&r, 2) ? 0.5f : -0.5f;
            else
                ray.dir[a] = (float)random_below(&r, 64) - 31.5f;
            ray.org[a] = point[a] - k * ray.dir[a]; /* exact */
        }
        const float t = t_of(point, ray);
        assert_true(t == k || (t == INFINITY && !diagonal));
        through += t == k;
        ray.org[i % 3] += 0x1p-10f; /* also exact */
        assert_true(t_of(point, ray) == INFINITY);
    }
    print_message("%s: %u of %d rays through a point hit it\n", cgt_context_get_variant(context), through, ROUNDS);
    assert_true(through > ROUNDS * 3 / 4);
    assert_true(t_of(point, (truth_ray){{3, -2, 7}, {0, 1, 0}, 0, INFINITY}) == 0);
    cgt_scene *scene = scene_of_one(point);
    const ray_hit hit = ray_trace(scene, (truth_ray){{3, -2, 0}, {0, 0, 2}, 0, INFINITY});
    assert_true(hit.t == 3.5f && hit.normal[0] == 0 && hit.normal[1] == 0 && hit.normal[2] == -1);
    cgt_scene_release(scene);
}

static void zero_radius(void **state)
{
    (void)state;
    for_each_variant(zero_radius_rays);
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

static void range_is_closed_rays(void)
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

static void range_is_closed_at_both_ends(void **state)
{
    (void)state;
    for_each_variant(range_is_closed_rays);
}

/* ---- ties ---- */

static void ties_rays(void)
{
    enum { N = 40 };
    test_random r = random_make(11);
    for (uint32_t round = 0; round < test_scaled(40); round++) {
        float sphere[2][N][4], q[4];
        cgt_scene *scene = NULL;
        for (int a = 0; a < 3; a++)
            q[a] = random_float(&r, -2, 2);
        q[3] = random_float(&r, 0.5f, 1);
        for (int g = 0; g < 2; g++)
            for (int i = 0; i < N; i++) {
                memcpy(sphere[g][i], q, sizeof q);
                if (random_below(&r, 2))
                    sphere[g][i][3] *= random_float(&r, 0.2f, 0.9f); /* inside the others */
            }
        const cgt_scene_options made = structure_in_turn(round);
        assert_int_equal(cgt_scene_create(context, &made, &scene), CGT_OK);
        uint32_t first[2] = {CGT_INVALID_ID, CGT_INVALID_ID}, id;
        for (uint32_t g = 0; g < 2; g++) {
            const cgt_spheres spheres = spheres_of((const float(*)[4])sphere[g], N);
            assert_int_equal(cgt_scene_add_spheres(scene, &spheres, &id), CGT_OK);
            for (uint32_t i = N; i-- > 0;)
                if (sphere[g][i][3] == q[3])
                    first[g] = i;
        }
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        truth_ray ray[RAYS];
        ray_hit hit[RAYS];
        for (int i = 0; i < RAYS; i++)
            ray[i] = aim(&r, (const float[3]){5, 6, 7}, q, 0.99f, 1);
        rays_trace(scene, ray, RAYS, hit, NULL);
        const uint32_t geometry = first[0] == CGT_INVALID_ID;
        for (int i = 0; i < RAYS; i++) {
            assert_int_equal(hit[i].geometry, geometry);
            assert_int_equal(hit[i].primitive, first[geometry]);
        }
        cgt_scene_release(scene);
    }
}

static void ties_go_to_the_lowest_id(void **state)
{
    (void)state;
    for_each_variant(ties_rays);
}

/* ---- normals ---- */

static void normals_rays(void)
{
    test_random r = random_make(13);
    for (uint32_t round = 0; round < test_scaled(60); round++) {
        float sphere[4], org[3];
        truth_ray ray[RAYS];
        ray_hit hit[RAYS];
        for (int a = 0; a < 3; a++)
            sphere[a] = random_float(&r, -100, 100);
        sphere[3] = random_log(&r, 1e-2f, 1e3f);
        any_origin(&r, sphere, random_log(&r, 0.01f, 100), org);
        for (int i = 0; i < RAYS; i++)
            ray[i] = aim(&r, org, sphere, 0.999f, random_log(&r, 1e-3f, 1e3f));
        cgt_scene *scene = scene_of_one(sphere);
        rays_trace(scene, ray, RAYS, hit, NULL);
        for (int i = 0; i < RAYS; i++) {
            const truth_roots roots = truth_sphere(ray[i].org, ray[i].dir, sphere);
            const truth_real t = (float)roots.near >= 0 ? roots.near : roots.far;
            assert_int_equal(hit[i].primitive, 0);
            for (int a = 0; a < 3; a++) { /* outwards, even if the ray comes from inside */
                const double n = (double)((ray[i].org[a] + t * ray[i].dir[a] - sphere[a]) / sphere[3]);
                assert_true(fabs(hit[i].normal[a] - n) < 0x1p-22);
            }
        }
        cgt_scene_release(scene);
    }
}

static void normals_point_outwards(void **state)
{
    (void)state;
    for_each_variant(normals_rays);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(near_and_far),
        cmocka_unit_test(any_length),
        cmocka_unit_test(special_positions),
        cmocka_unit_test(zero_radius),
        cmocka_unit_test(range_is_closed_at_both_ends),
        cmocka_unit_test(ties_go_to_the_lowest_id),
        cmocka_unit_test(normals_point_outwards),
    };
    test_begin("test_sphere_exact");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
