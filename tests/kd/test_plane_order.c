/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The order of two planes along a ray, and its integer stage by itself, against dyadic arithmetic, which shares no code
 * with either. Times are equal or differ in the last place; floats include denormals and the ends of the range. */
#include "support/oracle/dyadic.h"
#include "support/suite.h"
#include "support/test.h"

#include <math.h>

#include "kd/near_times.h"

typedef struct tally {
    uint64_t pairs, before, equal, after;
} tally;

static int true_order(const cgt_plane_time *a, const cgt_plane_time *b)
{
    const dyadic pa = dyadic_of_float(a->plane), oa = dyadic_of_float(a->org), da = dyadic_of_float(a->dir);
    const dyadic pb = dyadic_of_float(b->plane), ob = dyadic_of_float(b->org), db = dyadic_of_float(b->dir);
    const dyadic to_a = dyadic_sub(&pa, &oa), to_b = dyadic_sub(&pb, &ob);
    const dyadic left = dyadic_mul(&to_a, &db), right = dyadic_mul(&to_b, &da);
    return dyadic_sub(&left, &right).sign * da.sign * db.sign;
}

static void judge(tally *sum, cgt_plane_time a, cgt_plane_time b)
{
    const int order = true_order(&a, &b);
    const int got[] = {cgt_plane_order(&a, &b), -cgt_plane_order(&b, &a), cgt_plane_order_exact(&a, &b),
                       -cgt_plane_order_exact(&b, &a)};
    for (size_t i = 0; i < TEST_COUNT(got); i++)
        if (got[i] != order)
            fail_msg("call %zu: %d, expected %d: (%a - %a) / %a, (%a - %a) / %a", i, got[i], order, (double)a.plane,
                     (double)a.org, (double)a.dir, (double)b.plane, (double)b.org, (double)b.dir);
    sum->pairs++;
    sum->before += order < 0;
    sum->equal += order == 0;
    sum->after += order > 0;
}

static void report(const char *what, const tally *sum)
{
    print_message("%s: %llu pairs, %llu before, %llu equal, %llu after\n", what, (unsigned long long)sum->pairs,
                  (unsigned long long)sum->before, (unsigned long long)sum->equal, (unsigned long long)sum->after);
}

static float finite_float(test_random *r)
{
    for (;;) {
        const float f = random_any_float(r);
        if (isfinite(f))
            return f;
    }
}

static float not_zero(test_random *r, float (*make)(test_random *))
{
    for (;;) {
        const float f = make(r);
        if (f != 0)
            return f;
    }
}

static cgt_plane_time make_time(test_random *r, float (*make)(test_random *))
{
    cgt_plane_time t;
    t.plane = make(r);
    t.org = make(r);
    t.dir = not_zero(r, make);
    return t;
}

/* A float next to another, or itself. */
static float beside(test_random *r, float f)
{
    const uint32_t side = random_below(r, 3);
    const float next = nextafterf(f, side ? INFINITY : -INFINITY);
    return side == 2 || !isfinite(next) ? f : next;
}

static cgt_plane_time time_beside(test_random *r, cgt_plane_time t)
{
    t.plane = beside(r, t.plane);
    t.org = beside(r, t.org);
    t.dir = beside(r, t.dir);
    t.dir = t.dir == 0 ? 0x1p-149f : t.dir;
    return t;
}

/* ---- tests ---- */

static void judge_family(const char *what, uint64_t stream, float (*make)(test_random *))
{
    test_random r = random_make(stream);
    tally sum = {0};
    for (uint32_t round = 100 + test_scaled(40000); round; round--) {
        const cgt_plane_time a = make_time(&r, make), b = make_time(&r, make), near = time_beside(&r, a);
        judge(&sum, a, b);
        judge(&sum, a, near);
        judge(&sum, a, (cgt_plane_time){b.plane, a.org, a.dir}); /* two planes of one axis */
    }
    report(what, &sum);
    assert_true(sum.before > sum.pairs / 8 && sum.after > sum.pairs / 8 && sum.equal > 0);
}

static float ordinary(test_random *r) { return random_float(r, -100, 100); }
static float denormal(test_random *r)
{
    return ldexpf((float)random_below(r, 1u << 23), -149) * (random_below(r, 2) ? 1.f : -1.f);
}
static float extreme(test_random *r)
{
    static const float edge[] = {0.f,        -0.f,     0x1p-149f,       -0x1p-149f,       0x1.fffffcp-127f, 0x1p-126f,
                                 -0x1p-126f, 1.f,      0x1.fffffep127f, -0x1.fffffep127f, 0x1p127f,         -0x1p127f,
                                 0x1p-75f,   -0x1p75f, 0x1.000002p0f,   0x1.fffffep-1f};
    return edge[random_below(r, TEST_COUNT(edge))];
}
static float whole(test_random *r) { return (float)random_below(r, 9) - 4; }

TEST(any_floats) { judge_family("any floats", 1, finite_float); }
TEST(ordinary_numbers) { judge_family("ordinary numbers", 2, ordinary); }
TEST(denormals) { judge_family("denormals", 3, denormal); }
TEST(ends_of_the_range) { judge_family("ends of the range", 4, extreme); }
TEST(small_whole_numbers) { judge_family("small whole numbers", 5, whole); }

/* Equal by construction, at any scale: t = k (m / n) with (m f, n f) for several f; then one number is moved by one
 * ulp. */
TEST(equal_times)
{
    test_random r = random_make(6);
    tally same = {0}, beside_same = {0};
    for (uint32_t round = 100 + test_scaled(40000); round; round--) {
        cgt_plane_time t[2];
        const int steps = 1 + (int)random_below(&r, 4095), speed = 1 + (int)random_below(&r, 4095);
        for (int i = 0; i < 2; i++) {
            const int factor = (1 + (int)random_below(&r, 255)) * (random_below(&r, 2) ? 1 : -1);
            const int exponent = (int)random_below(&r, 180) - 110, from = (int)random_below(&r, 1 << 20);
            t[i].org = ldexpf((float)from, exponent);
            t[i].plane = ldexpf((float)(from + steps * factor), exponent);
            t[i].dir = ldexpf((float)(speed * factor), exponent - 3);
        }
        judge(&same, t[0], t[1]);
        judge(&beside_same, time_beside(&r, t[0]), t[1]);
        judge(&beside_same, t[0], time_beside(&r, t[1]));
    }
    report("equal times", &same);
    report("next to equal times", &beside_same);
    assert_int_equal(same.equal, same.pairs);
    assert_true(beside_same.before > 0 && beside_same.after > 0);
}

TEST(nearly_equal_times)
{
    test_random r = random_make(8);
    tally sum = {0};
    for (uint32_t round = 100 + test_scaled(40000); round; round--) {
        cgt_plane_time t[2];
        const int k = near_times_make(&r, t);
        assert_int_equal(true_order(&t[0], &t[1]), (k > 0) - (k < 0));
        if (random_below(&r, 2))
            t[0] = (cgt_plane_time){-t[0].plane, -t[0].org, -t[0].dir};
        judge(&sum, t[0], t[1]);
    }
    report("nearly equal times", &sum);
    assert_true(sum.before > sum.pairs / 8 && sum.after > sum.pairs / 8 && sum.equal > sum.pairs / 16);
}

/* The end of a range against a plane crossed at about the same t. */
TEST(bounds_of_ranges)
{
    test_random r = random_make(7);
    tally sum = {0};
    for (uint32_t round = 100 + test_scaled(40000); round; round--) {
        const cgt_plane_time plane = make_time(&r, random_below(&r, 2) ? ordinary : whole);
        const float t = (float)(((double)plane.plane - plane.org) / plane.dir);
        judge(&sum, plane, (cgt_plane_time){beside(&r, t), 0, 1});
        judge(&sum, plane, (cgt_plane_time){t, 0, 1});
    }
    report("bounds of ranges", &sum);
    assert_true(sum.before > sum.pairs / 8 && sum.after > sum.pairs / 8 && sum.equal > sum.pairs / 64);
}

SEEDED_SUITE("test_plane_order", NULL, NULL)
