/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays along ropes, single and in packets, with one variant: the leaves on a ray cover it without a gap and without
 * repetition, by arithmetic that shares no code with the library. */
#include "support/suite.h"
#include "support/oracle/dyadic.h"
#include "structures/check/kd_check.h"
#include "kd/kd_rope_cases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kd/near_times.h"
#include "query/trace_settings.h"

static void visit(uint32_t first, unsigned lanes, uint32_t leaf);
#define ROPE_VISIT(first, lanes, leaf) visit(first, lanes, leaf)
#include "papers/kernel/kd/kd_rope_packet.h"
#include "papers/kernel/kd/kd_rope_single.h"

#define RAYS 64u

static cgt_context *context;

static int setup(void **state)
{
    (void)state;
    context = context_make(1, NULL);
    return 0;
}
static int teardown(void **state)
{
    (void)state;
    cgt_context_release(context);
    return 0;
}

/* ---- packets ---- */

static void fill_packet(packet *p, const truth_ray ray[RAYS], bool any_hit)
{
    memset(p, 0, sizeof *p);
    p->lanes = RAYS;
    p->any_hit = any_hit;
    for (uint32_t k = 0; k < RAYS; k++) {
        float dd = 0;
        for (int a = 0; a < 3; a++) {
            p->org[a][k] = ray[k].org[a];
            p->dir[a][k] = ray[k].dir[a];
            dd += ray[k].dir[a] * ray[k].dir[a];
        }
        p->rdd[k] = 1 / dd;
        p->t_min[k] = ray[k].t_min;
        p->t_max[k] = ray[k].t_max;
        p->low[k] = p->high[k] = ray[k].t_min > ray[k].t_max ? -INFINITY : ray[k].t_max;
        p->prim[k] = CGT_INVALID_ID;
        p->rays += p->high[k] != -INFINITY;
    }
}

static void print_ray(const truth_ray *ray)
{
    print_message("org %a %a %a, dir %a %a %a, range %a %a\n", (double)ray->org[0], (double)ray->org[1],
                  (double)ray->org[2], (double)ray->dir[0], (double)ray->dir[1], (double)ray->dir[2],
                  (double)ray->t_min, (double)ray->t_max);
}

/* ---- leaves ---- */

/* Parameters as fractions with a positive denominator. */
typedef struct fraction {
    dyadic p, q;
} fraction;

static int order(const fraction *a, const fraction *b)
{
    const dyadic left = dyadic_mul(&a->p, &b->q), right = dyadic_mul(&b->p, &a->q);
    return dyadic_sub(&left, &right).sign;
}

static fraction whole(float t) { return (fraction){dyadic_of_float(t), dyadic_make(1, 0)}; }

/* The part of a line in a closed box; false if it is empty. A direction is not zero, so ends are finite. */
static bool part_in_box(const truth_ray *ray, const float low[3], const float high[3], fraction *near, fraction *far)
{
    bool found = false;
    for (int a = 0; a < 3; a++) {
        const dyadic d = dyadic_of_float(ray->dir[a]), o = dyadic_of_float(ray->org[a]);
        if (d.sign == 0) {
            if (ray->org[a] < low[a] || ray->org[a] > high[a])
                return false;
            continue;
        }
        for (int end = 0; end < 2; end++) {
            const dyadic plane = dyadic_of_float((d.sign > 0) == end ? high[a] : low[a]), to = dyadic_sub(&plane, &o);
            const fraction t = {dyadic_signed(&to, d.sign), dyadic_signed(&d, d.sign)};
            if (end == 0 ? !found || order(&t, near) > 0 : !found || order(&t, far) < 0)
                *(end ? far : near) = t;
        }
        found = true;
    }
    return order(near, far) <= 0;
}

#define MOST_VISITS 4096u
static struct visits {
    uint32_t count[RAYS];
    uint32_t leaf[RAYS][MOST_VISITS];
} visits;

static void visit(uint32_t first, unsigned lanes, uint32_t leaf)
{
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t k = first + (uint32_t)__builtin_ctz(lanes);
        assert_true(visits.count[k] < MOST_VISITS);
        visits.leaf[k][visits.count[k]++] = leaf;
    }
}

static bool comes_twice(const uint32_t *leaf, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < i; k++)
            if (leaf[i] == leaf[k])
                return true;
    return false;
}

typedef struct cover {
    uint64_t rays, misses, leaves, touched; /* touched: the ray meets the leaf at one point only */
} cover;

/* NULL, or the fault in the leaves that ray k visited; it may stop at `high`. */
static const char *judge_leaves(const cgt_kd_tree *tree, const truth_ray *ray, uint32_t k, float high, cover *sum)
{
    fraction near, far, reached, in, out;
    const uint32_t count = visits.count[k], *leaf = visits.leaf[k];
    bool late = false;
    sum->rays++;
    if (!part_in_box(ray, tree->low, tree->high, &near, &far)) {
        sum->misses++;
        return count ? "leaves are visited, but the ray misses the root" : NULL;
    }
    reached = near;
    if (ray->t_min > -INFINITY) {
        const fraction first = whole(ray->t_min);
        if (order(&first, &near) > 0)
            reached = first;
        if (order(&first, &far) > 0)
            return NULL; /* the root is behind the range */
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!part_in_box(ray, tree->leaf[leaf[i]].low, tree->leaf[leaf[i]].high, &in, &out))
            return "a leaf that the ray does not touch";
        if (order(&in, &reached) > 0)
            return "a gap before a leaf";
        if (order(&out, &reached) > 0)
            reached = out;
        sum->touched += order(&in, &out) == 0;
        sum->leaves++;
    }
    if (high < INFINITY) {
        const fraction last = whole(high);
        late = order(&reached, &last) > 0;
    }
    if (!late && (!count || order(&reached, &far) < 0))
        return "the end of the ray is not covered";
    return comes_twice(leaf, count) ? "a leaf is visited twice" : NULL;
}

static void judge_packet(const rope_case *c, const truth_ray ray[RAYS], const packet *p, cover *sum)
{
    for (uint32_t k = 0; k < RAYS; k++) {
        if (p->high[k] == -INFINITY)
            continue; /* stopped early, or never started */
        const char *wrong = judge_leaves(&c->papers.kd, &ray[k], k, p->high[k], sum);
        if (!wrong)
            continue;
        print_ray(&ray[k]);
        fail_msg("%s, %u leaves, high %a", wrong, visits.count[k], (double)p->high[k]);
    }
}

TEST(leaves_cover_the_rays)
{
    test_random r = random_make(2);
    cover sum[2] = {{0}, {0}};
    packet *p = aligned_alloc(64, (sizeof *p + 63) / 64 * 64);
    leaf_tests *l = aligned_alloc(64, (sizeof *l + 63) / 64 * 64);
    assert_true(p && l);
    for (uint32_t round = 6 + test_scaled(120); round; round--) {
        rope_case *c = rope_case_make(&r, context, (rope_place)(round % ROPE_PLACES));
        const char *fault = kd_check(&c->papers.kd, &c->committed_scene);
        const bool any_hit = random_below(&r, 4) == 0;
        truth_ray ray[RAYS];
        cgt_counts counts = {0};
        const cgt_trace_settings settings = {.mailbox = random_below(&r, 2)};
        if (fault)
            fail_msg("%s", fault);
        for (uint32_t k = 0; k < RAYS; k++)
            ray[k] = rope_case_ray(&r, c);
        for (int packets = 0; packets < 2; packets++) {
            memset(visits.count, 0, sizeof visits.count);
            fill_packet(p, ray, any_hit);
            leaf_tests_init(&c->committed_scene, p, &settings, &counts, l);
            for (uint32_t i = 0; i < RAYS; i += packets ? CGT_LANES : 1)
                (packets ? rope_trace_vector : rope_trace_ray)(&c->papers.kd, l, i);
            judge_packet(c, ray, p, &sum[packets]);
        }
        assert_int_equal(counts.rope_loops, 0);
        rope_case_free(c);
    }
    for (int i = 0; i < 2; i++) {
        print_message("%s: %llu rays, %llu miss the root, %llu leaves, %llu of them at one point\n",
                      i ? "packets" : "single", (unsigned long long)sum[i].rays, (unsigned long long)sum[i].misses,
                      (unsigned long long)sum[i].leaves, (unsigned long long)sum[i].touched);
        assert_true(sum[i].misses * 50 > sum[i].rays && sum[i].misses * 2 < sum[i].rays);
        assert_true(sum[i].leaves > sum[i].rays / 2 && sum[i].touched > 0);
    }
    free(p);
    free(l);
}

/* ---- faces ---- */

/* A leaf that each ray could leave through either of two faces, with a rope for each axis. */
static void set_leaf(packet *p, uint32_t k, const cgt_plane_time t[2], uint32_t swap, cgt_kd_leaf *leaf)
{
    for (uint32_t a = 0; a < 3; a++) {
        const cgt_plane_time of = a == 2 ? (cgt_plane_time){0x1p54f, 0, 1} : t[a ^ swap];
        p->org[a][k] = of.org;
        p->dir[a][k] = of.dir;
        leaf->low[a] = -0x1p54f;
        leaf->high[a] = of.plane;
        for (uint32_t side = 0; side < 2; side++)
            leaf->rope[2 * a + side] = leaf->packet_rope[2 * a + side] = 10 * a + side;
    }
}

TEST(faces_at_nearly_the_same_time)
{
    test_random r = random_make(3);
    packet *p = aligned_alloc(64, (sizeof *p + 63) / 64 * 64);
    uint64_t by_axis[2] = {0, 0};
    assert_non_null(p);
    memset(p, 0, sizeof *p);
    for (uint32_t round = 200 + test_scaled(20000); round; round--) {
        cgt_kd_leaf leaf = {.first = 0};
        cgt_plane_time t[2];
        rope_packet many;
        rope_ray one;
        const int k = near_times_make(&r, t);
        const uint32_t swap = random_below(&r, 2), axis = (k > 0) ^ swap, lane = random_below(&r, CGT_LANES);
        if (k == 0)
            continue; /* either face is right */
        for (uint32_t i = 0; i < CGT_LANES; i++)
            set_leaf(p, i, t, swap, &leaf);
        rope_ray_init(p, lane, &one);
        assert_int_equal(rope_ray_leave(p, lane, &one, &leaf), 10 * axis + 1);
        assert_int_equal(one.last.axis, axis);
        rope_packet_init(p, 0, &many);
        for (uint32_t i = 0; i < CGT_LANES; i++)
            many.node[i] = 99;
        rope_packet_leave(&many, &leaf, 1u << lane);
        for (uint32_t i = 0; i < CGT_LANES; i++)
            assert_int_equal(many.node[i], i == lane ? 10 * axis + 1 : 99);
        assert_int_equal(many.axis[lane], axis);
        by_axis[axis]++;
    }
    assert_true(by_axis[0] > 10 && by_axis[1] > 10);
    free(p);
}

VARIANT_SUITE("test_kd_ropes", setup, teardown)
