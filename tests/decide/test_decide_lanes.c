/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Vectors of decisions in double (kernel/primitive/decide_lanes.h) against decide.h, whose own answers test_decide.c
 * compares with the oracle: what they call a hit or a miss is one, nearest or any; what they leave open is little. */
#include "decide/double_cases.h"
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <string.h>

#include "exact/triangle_double.h"
#include "exact/valid_primitive.h"
#include "kernel/primitive/decide_lanes.h"

/* How two triangles of a lane lie to each other. */
typedef enum pair_kind {
    PAIR_ANY,
    PAIR_EQUAL,    /* the same vertices, turned */
    PAIR_IN_PLANE, /* in one axis plane */
    PAIR_CLOSE,    /* moved by a few units in the last place */
    PAIR_KINDS
} pair_kind;

typedef struct lane_test {
    cgt_ray ray;
    cgt_triangle triangle, best;
    bool is_first;
} lane_test;

typedef struct tally {
    uint64_t tests, decided, in_plane, in_plane_decided;
} tally;

static void flatten_triangle(cgt_triangle *t, int axis, float at)
{
    for (int k = 0; k < 3; k++)
        t->v[k][axis] = at;
}

static void make_best(test_random *r, pair_kind kind, lane_test *l)
{
    const int axis = (int)random_below(r, 3), turn = (int)random_below(r, 3);
    if (kind == PAIR_IN_PLANE) {
        flatten_triangle(&l->triangle, axis, l->triangle.v[0][axis]);
        flatten_triangle(&l->best, axis, l->triangle.v[0][axis]);
    } else if (kind == PAIR_EQUAL)
        for (int k = 0; k < 3; k++)
            memcpy(l->best.v[k], l->triangle.v[(k + turn) % 3], sizeof l->best.v[k]);
    else if (kind == PAIR_CLOSE)
        for (int k = 0; k < 9; k++)
            l->best.v[k / 3][k % 3] =
                nextafterf(l->triangle.v[k / 3][k % 3], random_below(r, 2) ? INFINITY : -INFINITY);
}

static void make_test(test_random *r, double_family family, pair_kind kind, lane_test *l)
{
    oracle_primitive shape, other;
    truth_ray ray;
    double_case_make(r, family, false, &shape, &ray);
    double_case_shape(r, family, false, &other);
    l->triangle = double_case_shape_of(&shape).triangle;
    l->best = double_case_shape_of(&other).triangle;
    l->ray = double_case_ray_of(&ray);
    l->is_first = random_below(r, 2);
    make_best(r, kind, l);
    if (random_below(r, 4) == 0) { /* along the triangle */
        const int axis = (int)random_below(r, 3);
        l->ray.line.dir[axis] = 0;
        l->ray.line.org[axis] = l->triangle.v[0][axis];
        l->ray.line.dir[(axis + 1) % 3] += l->ray.line.dir[(axis + 1) % 3] == 0;
    }
    if (random_below(r, 4) == 0) { /* from it, or to it */
        cgt_decided_hit hit = {.primitive = {.kind = CGT_KIND_TRIANGLES, .triangle = l->triangle}};
        uint64_t exact = 0;
        l->ray.t_min = -FLT_MAX;
        l->ray.t_max = FLT_MAX;
        if (cgt_decide_hit(&l->ray, &hit, &exact))
            *(random_below(r, 2) ? &l->ray.t_min : &l->ray.t_max) = (float)hit.t;
    }
}

static void put_lane(decide_tests *q, uint32_t k, const lane_test *l)
{
    decide_set_ray(q, k, &l->ray);
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 3; a++) {
            q->triangle.v[i][a][k] = l->triangle.v[i][a];
            q->best.v[i][a][k] = l->best.v[i][a];
        }
    q->is_first |= (unsigned)l->is_first << k;
}

/* 1: the triangle beats the best, which the ray is known to hit; -1: it does not. */
static int decide_one(const lane_test *l, bool has_rival, double *t)
{
    cgt_decided_hit hit = {.primitive = {.kind = CGT_KIND_TRIANGLES, .triangle = l->triangle}};
    cgt_decided_hit best = {.primitive = {.kind = CGT_KIND_TRIANGLES, .triangle = l->best}};
    uint64_t exact = 0;
    if (!cgt_decide_hit(&l->ray, &hit, &exact))
        return -1;
    *t = hit.t;
    if (!has_rival)
        return 1;
    cgt_decide_t(&l->ray, &best);
    const cgt_exact_root a = {&hit.primitive, hit.far}, b = {&best.primitive, best.far};
    const int order = cgt_exact_compare(&l->ray.line, &a, &b);
    return order < 0 || (order == 0 && l->is_first) ? 1 : -1;
}

static void judge_lane(const lane_test *l, const decide_tests *q, const decide_results *r, uint32_t k)
{
    const bool hit = r->hit >> k & 1, missed = r->missed >> k & 1, has_rival = q->has_rival >> k & 1;
    double t = 0;
    const int truth = hit || missed ? decide_one(l, has_rival, &t) : 0;
    if ((hit && missed) || (hit && truth < 0) || (missed && truth > 0))
        fail_msg("lane %u is called a %s%s", k, hit ? "hit" : "miss", has_rival ? ", against another" : "");
    if (hit && !q->any_hit && r->t[k] != (float)t)
        fail_msg("lane %u: t %a, and not %a", k, (double)r->t[k], t);
}

static void run_vector(test_random *r, double_family family, pair_kind kind, bool any_hit, tally *sum)
{
    lane_test lane[CGT_LANES];
    decide_tests q;
    decide_results result;
    memset(&q, 0, sizeof q);
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        uint64_t exact = 0;
        make_test(r, family, kind, &lane[k]);
        put_lane(&q, k, &lane[k]);
        cgt_decided_hit best = {.primitive = {.kind = CGT_KIND_TRIANGLES, .triangle = lane[k].best}};
        if (!any_hit && cgt_decide_hit(&lane[k].ray, &best, &exact))
            q.has_rival |= 1u << k;
    }
    q.any_hit = any_hit;
    q.lanes = CGT_ALL_LANES;
    q.is_free = CGT_ALL_LANES & ~q.has_rival;
    CGT_KERNEL(cgt_decide_lanes)(&q, &result);
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        judge_lane(&lane[k], &q, &result, k);
        const bool shares = kind == PAIR_EQUAL || kind == PAIR_IN_PLANE, settled = shares && q.has_rival >> k & 1;
        sum->tests++;
        sum->decided += (result.hit | result.missed) >> k & 1;
        sum->in_plane += settled && !lane[k].is_first;
        sum->in_plane_decided += settled && !lane[k].is_first && result.missed >> k & 1;
    }
}

TEST(vectors_decide_as_one_by_one)
{
    const uint32_t vectors = test_scaled(4000);
    for (int family = 0; family < DOUBLE_FAMILIES; family++) {
        tally sum = {0};
        test_random r = random_make(60 + (uint64_t)family);
        for (uint32_t i = 0; family != GRAZING && i < vectors; i++)
            run_vector(&r, (double_family)family, (pair_kind)(i % PAIR_KINDS), i % 3 == 0, &sum);
        print_message("%s: %.3f of %.0f tests are decided\n", double_family_name((double_family)family),
                      (double)sum.decided / (double)(sum.tests + !sum.tests), (double)sum.tests);
        assert_true(2 * sum.decided >= sum.tests);
        assert_int_equal(sum.in_plane_decided, sum.in_plane); /* without a look at the edges */
    }
}

/* A triangle that is flat across an axis, and rays that do not move along it. */
TEST(rays_in_the_plane_miss)
{
    test_random r = random_make(70);
    for (uint32_t i = 0; i < 300; i++) {
        decide_tests q;
        decide_results result;
        memset(&q, 0, sizeof q);
        for (uint32_t k = 0; k < CGT_LANES; k++) {
            const int axis = (int)(i % 3);
            lane_test l;
            make_test(&r, ANYWHERE, PAIR_ANY, &l);
            flatten_triangle(&l.triangle, axis, l.triangle.v[0][axis]);
            l.ray.line.dir[axis] = i % 2 ? 0.f : -0.f;
            l.ray.line.org[axis] = l.triangle.v[0][axis];
            put_lane(&q, k, &l);
        }
        q.lanes = q.is_free = CGT_ALL_LANES;
        CGT_KERNEL(cgt_decide_lanes)(&q, &result);
        assert_int_equal(result.missed & CGT_ALL_LANES, CGT_ALL_LANES);
    }
}

/* The plane y = x / 2: it holds both triangles, or misses a vertex of one by a step of the lattice, or by less. */
TEST(planes_on_a_lattice_are_told)
{
    test_random r = random_make(71);
    for (uint32_t i = 0; i < 3000; i++) {
        cgt_triangle t[2];
        for (int k = 0; k < 18; k++) {
            float *v = t[k / 9].v[k % 9 / 3];
            if (k % 3 == 0)
                v[0] = (float)((int)random_below(&r, 4096) * 2 - 4096) / 4096;
            v[1] = v[0] / 2;
            v[2] = k % 3 ? v[2] : (float)((int)random_below(&r, 8192) - 4096) / 4096;
        }
        const bool in_plane = i % 3 == 0;
        if (i % 3 == 1)
            t[1].v[random_below(&r, 3)][1] += 0x1p-12f;
        else if (i % 3 == 2)
            t[1].v[random_below(&r, 3)][1] += 0x1p-24f; /* no multiple: never told */
        if (cgt_triangle_has_area(&t[0]) && cgt_triangle_has_area(&t[1]))
            assert_int_equal(cgt_triangles_share_lattice_plane(&t[0], &t[1]), in_plane);
    }
}

/* A vertex off the plane y = x / 2 by so little that differences in double are rounded onto it. */
TEST(planes_off_the_lattice_are_not_told)
{
    const cgt_triangle p = {{{1, 0.5f, 1}, {-1, -0.5f, 0.5f}, {0.25f, 0.125f, -1}}};
    cgt_triangle q = p;
    q.v[0][0] = q.v[0][1] = 0x1p-100f;
    assert_true(cgt_triangles_share_lattice_plane(&p, &p));
    assert_false(cgt_triangles_share_lattice_plane(&p, &q));
}

VARIANT_SUITE("test_decide_lanes", NULL, NULL)
