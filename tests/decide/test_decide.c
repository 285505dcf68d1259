/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Decisions in double, backed by the exact stage, agree with exact arithmetic. The canonical t is within 0.51 ulp, and
 * resolving whole packets returns its bits. */
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <string.h>

#include "decide/double_cases.h"
#include "support/oracle/oracle_line.h"
#include "support/ray_arrays.h"

/* ---- decisions ---- */

typedef struct decision_counts {
    uint64_t hits, misses, exact, ties, behind;
    double ulp;
} decision_counts;

/* Compares hit or miss, the root, and t. */
static bool judge_decision(const oracle_primitive *q, const truth_ray *ray, cgt_decided_hit *hit,
                           decision_counts *count)
{
    const cgt_ray of = double_case_ray_of(ray);
    oracle_hit exact;
    *hit = (cgt_decided_hit){.primitive = double_case_shape_of(q)};
    const bool is_hit = oracle_hits(q, ray, &exact), decided = cgt_decide_hit(&of, hit, &count->exact);
    if (decided != is_hit) { /* at the end of the range t may round either way: both answers are right */
        const oracle_scene scene = {.primitive = q, .count = 1};
        assert_int_equal(oracle_judge(&scene, ray, decided ? 0 : ORACLE_NONE, decided ? 0 : ORACLE_NONE, &exact),
                         ORACLE_RIGHT);
    }
    ++*(decided ? &count->hits : &count->misses);
    if (!decided)
        return false;
    assert_int_equal(hit->far, exact.far);
    count->ulp = fmax(count->ulp, oracle_ulp(exact.t, (float)hit->t));
    return true;
}

/* Two primitives on one ray. The second is sometimes equal to the first, and sometimes shares with it the vertex that
 * the ray is aimed at. */
static void judge_pair(test_random *r, double_family f, decision_counts *count)
{
    oracle_primitive q[2];
    truth_ray ray;
    cgt_decided_hit hit[2];
    oracle_root roots[2][2];
    oracle_line line;
    double_case_make(r, f, random_below(r, 2), &q[0], &ray);
    double_case_shape(r, f == HUGE_OR_TINY ? ANYWHERE : f, random_below(r, 2), &q[1]);
    if (random_below(r, 4) == 0)
        q[1] = q[0];
    else if (f != HUGE_OR_TINY && random_below(r, 2) && q[0].kind == ORACLE_TRIANGLE && q[1].kind == q[0].kind)
        memcpy(q[1].data, q[0].data, 6 * sizeof(float)); /* a common edge */
    const bool first = judge_decision(&q[0], &ray, &hit[0], count),
               second = judge_decision(&q[1], &ray, &hit[1], count);
    if (!first || !second)
        return;
    assert_true(oracle_line_make(&ray, &line));
    for (int i = 0; i < 2; i++)
        oracle_roots(&line, &q[i], roots[i]);
    const cgt_ray of = double_case_ray_of(&ray);
    const int order = oracle_compare(&roots[0][hit[0].far], &roots[1][hit[1].far]);
    assert_int_equal(cgt_decide_order(&of, &hit[0], &hit[1], &count->exact), order);
    assert_int_equal(cgt_decide_order(&of, &hit[1], &hit[0], &count->exact), -order);
    count->ties += order == 0;
}

TEST(decisions_are_exact)
{
    for (int f = 0; f < DOUBLE_FAMILIES; f++) {
        test_random r = random_make(30 + (uint64_t)f);
        decision_counts count = {0};
        for (uint32_t round = 200 + test_scaled(8000); round; round--)
            judge_pair(&r, (double_family)f, &count);
        print_message("%s: %llu hits, %llu misses, %llu decided exactly, %llu ties, t within %.4f ulp\n",
                      double_family_name((double_family)f), (unsigned long long)count.hits,
                      (unsigned long long)count.misses, (unsigned long long)count.exact, (unsigned long long)count.ties,
                      count.ulp);
        assert_true(count.hits > 50 && count.misses > 50 && count.ties > 5);
        assert_true(count.ulp > 0.4 && count.ulp <= 0.51);
        assert_true(f != LATTICE || count.exact > 20);
    }
}

/* ---- the resolve of packets ---- */

enum { RAYS = 300 };

static cgt_scene *scene_of_one(cgt_context *context, const oracle_primitive *q)
{
    const cgt_spheres sphere = {.count = 1, .centers = cgt_floats(q->data, 0), .radii = cgt_floats(&q->data[3], 0)};
    const cgt_triangles triangle = {.count = 1, .vertex_count = 3, .vertices = cgt_floats(q->data, 0)};
    static uint32_t turn;
    const cgt_scene_options made = structure_in_turn(turn++);
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, &made, &scene), CGT_OK);
    if (q->kind == ORACLE_SPHERE)
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &sphere), CGT_OK);
    else
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangle), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

static uint64_t expect_canonical(const cgt_scene *scene, const oracle_primitive *q, const truth_ray *ray)
{
    static full_hit hit[RAYS];
    const cgt_primitive primitive = double_case_shape_of(q);
    uint64_t hits = 0;
    assert_int_equal(trace_array(scene, ray, RAYS, hit, NULL), CGT_OK);
    for (int i = 0; i < RAYS; i++) {
        const cgt_ray of = double_case_ray_of(&ray[i]);
        cgt_decided_hit decided = {.primitive = primitive};
        uint64_t exact = 0;
        bool far;
        const bool is_hit = cgt_decide_hit(&of, &decided, &exact);
        assert_int_equal(hit[i].primitive, is_hit ? 0 : CGT_INVALID_ID);
        if (!is_hit)
            continue;
        const double t = q->kind == ORACLE_SPHERE ? cgt_canonical_sphere_t(&of, primitive.sphere, &far)
                                                  : cgt_canonical_triangle_t(&of, &primitive.triangle);
        assert_true(same_bits(hit[i].t, (float)t) || (t == 0 && hit[i].t == 0));
        hits++;
    }
    return hits;
}

TEST(packets_hand_out_the_canonical_bits)
{
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1, variant);
        uint64_t hits = 0, rays = 0;
        for (uint32_t round = 0; round < 2 * DOUBLE_FAMILIES + test_scaled(120); round++) {
            test_random r = random_make(40 + round);
            const double_family f = (double_family)(round % DOUBLE_FAMILIES);
            oracle_primitive q;
            truth_ray ray[RAYS];
            double_case_shape(&r, f, round / DOUBLE_FAMILIES % 2, &q);
            for (int i = 0; i < RAYS; i++)
                ray[i] = double_case_ray(&r, f, &q);
            cgt_scene *scene = scene_of_one(context, &q);
            hits += expect_canonical(scene, &q, ray);
            rays += RAYS;
            cgt_scene_release(scene);
        }
        assert_true(hits * 10 > rays);
        cgt_context_release(context);
    }
}

/* From inside, where the range begins at minus infinity and the near root is below the range of float. */
TEST(near_roots_below_the_range_of_float)
{
    const float r = 0x1p110f * (1 + 0x1p-23f);
    const oracle_primitive inside[] = {{ORACLE_SPHERE, 0, 0, {-0x1p110f, 0, 0, r}},
                                       {ORACLE_CAPSULE, 0, 0, {-0x1p110f, 0, 0, -0x1p111f, 0, 0, r}}};
    const truth_ray ray = {.dir = {0x1p-20f, 0, 0}, .t_min = -INFINITY, .t_max = INFINITY};
    decision_counts count = {0};
    for (size_t k = 0; k < TEST_COUNT(inside); k++) {
        cgt_decided_hit hit;
        assert_true(judge_decision(&inside[k], &ray, &hit, &count));
        assert_true(hit.far && count.ulp <= 0.51);
    }
}

SEEDED_SUITE("test_decide", NULL, NULL)
