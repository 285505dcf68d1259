/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Tests rays against a box by slabs, with one variant, and compares with exact arithmetic. A ray that meets the
 * closed box within its range is never reported as a miss, whatever its direction; nearly all that miss are
 * reported. */
#include "support/oracle/oracle_line.h"
#include "support/suite.h"
#include "support/test.h"

#include <math.h>
#include <string.h>

#include "kernel/packet/ray_box.h"

typedef struct box {
    float low[3], high[3];
} box;

/* ---- the exact answer ---- */

/* The parameters of one slab, as fractions with a positive denominator. */
typedef struct fraction {
    dyadic p, q;
} fraction;

static bool is_above(const fraction *a, const fraction *b)
{
    const dyadic left = dyadic_mul(&a->p, &b->q), right = dyadic_mul(&b->p, &a->q);
    return dyadic_sub(&left, &right).sign > 0;
}

static fraction slab_end(float plane, float org, const dyadic *dir)
{
    const dyadic to = dyadic_of_float(plane), from = dyadic_of_float(org), p = dyadic_sub(&to, &from);
    return (fraction){dyadic_signed(&p, dir->sign), dyadic_signed(dir, dir->sign)};
}

/* Whether a t that rounds into the range leads to a point of the box. */
static bool box_is_hit(const truth_ray *ray, const box *b)
{
    const oracle_range range = oracle_range_make(ray->t_min, ray->t_max, 0);
    fraction first[4] = {{range.low.p, range.low.q}}, last[4] = {{range.high.p, range.high.q}};
    int ends = 1;
    for (int a = 0; a < 3; a++) {
        const dyadic d = dyadic_of_float(ray->dir[a]);
        if (d.sign == 0) {
            if (ray->org[a] < b->low[a] || ray->org[a] > b->high[a])
                return false;
            continue;
        }
        first[ends] = slab_end(d.sign > 0 ? b->low[a] : b->high[a], ray->org[a], &d);
        last[ends++] = slab_end(d.sign > 0 ? b->high[a] : b->low[a], ray->org[a], &d);
    }
    for (int i = 0; i < ends; i++)
        for (int j = 0; j < ends; j++)
            if (is_above(&first[i], &last[j]))
                return false;
    return true;
}

/* ---- vectors of rays ---- */

typedef struct tally {
    uint64_t rays, hit, missed, reported; /* reported: misses that the test found */
    uint64_t lost, not_numbers;           /* must be 0 */
} tally;

/* Checks that the ends of a ray's interval are numbers, unless they leave the range of float. */
static void check_numbers(const packet *p, const box *b, tally *sum)
{
    for (int a = 0; a < 3; a++) {
        vfloat near = spux_vfloat(-INFINITY), far = spux_vfloat(INFINITY);
        vmask outside = spux_mask_none();
        ray_box_slab(p, 0, a, b->low[a], b->high[a], &near, &far, &outside);
        for (int k = 0; k < CGT_LANES; k++) {
            const double reach = fmax(fabs((double)b->low[a] - p->org[a][k]), fabs((double)b->high[a] - p->org[a][k]));
            if (reach < 0x1p126 * fabs((double)p->dir[a][k]))
                sum->not_numbers += isnan(near[k]) || isnan(far[k]);
        }
    }
}

static void judge(const truth_ray ray[CGT_LANES], const box *b, tally *sum)
{
    packet p;
    memset(&p, 0, sizeof p);
    for (int k = 0; k < CGT_LANES; k++) {
        for (int a = 0; a < 3; a++) {
            p.org[a][k] = ray[k].org[a];
            p.dir[a][k] = ray[k].dir[a];
        }
        p.t_min[k] = ray[k].t_min;
        p.t_max[k] = ray[k].t_max;
    }
    check_numbers(&p, b, sum);
    const unsigned missed = spux_mask_bits(ray_box_missed(&p, 0, b->low, b->high));
    for (int k = 0; k < CGT_LANES; k++) {
        const bool hit = box_is_hit(&ray[k], b), reports_miss = missed >> k & 1;
        sum->rays++;
        sum->hit += hit;
        sum->missed += !hit;
        sum->reported += !hit && reports_miss;
        if (hit && reports_miss && !sum->lost++)
            print_message("lost: org %a %a %a dir %a %a %a range %a %a, box %a %a %a to %a %a %a\n",
                          (double)ray[k].org[0], (double)ray[k].org[1], (double)ray[k].org[2], (double)ray[k].dir[0],
                          (double)ray[k].dir[1], (double)ray[k].dir[2], (double)ray[k].t_min, (double)ray[k].t_max,
                          (double)b->low[0], (double)b->low[1], (double)b->low[2], (double)b->high[0],
                          (double)b->high[1], (double)b->high[2]);
    }
}

/* Rays one by one; a full vector is judged. */
typedef struct queue {
    truth_ray ray[CGT_LANES];
    int used;
    const box *b;
    tally sum;
} queue;

static void push(queue *q, const truth_ray *ray)
{
    q->ray[q->used++] = *ray;
    if (q->used == CGT_LANES) {
        judge(q->ray, q->b, &q->sum);
        q->used = 0;
    }
}

/* Judges the remaining rays, padded with the last one. */
static void flush(queue *q)
{
    while (q->used)
        push(q, &(const truth_ray){.org = {q->ray[0].org[0], q->ray[0].org[1], q->ray[0].org[2]},
                                   .dir = {q->ray[0].dir[0], q->ray[0].dir[1], q->ray[0].dir[2]},
                                   .t_min = q->ray[0].t_min,
                                   .t_max = q->ray[0].t_max});
}

static void expect_right(const char *what, const tally *t, double least_reported)
{
    print_message("%s: %llu rays, %llu hit the box; of %llu misses %.2f %% are reported\n", what,
                  (unsigned long long)t->rays, (unsigned long long)t->hit, (unsigned long long)t->missed,
                  t->missed ? 100. * (double)t->reported / (double)t->missed : 100.);
    assert_int_equal(t->lost, 0);
    assert_int_equal(t->not_numbers, 0);
    assert_true(t->hit * 20 > t->rays && t->missed * 20 > t->rays); /* hits and misses both occur */
    assert_true((double)t->reported >= least_reported * (double)t->missed);
}

/* ---- boxes ---- */

static box random_box(test_random *r)
{
    box b;
    const float size = random_log(r, 1e-3f, 1e3f);
    for (int a = 0; a < 3; a++) {
        const float p = random_float(r, -1, 1) * size, q = random_below(r, 8) ? random_float(r, -1, 1) * size : p;
        b.low[a] = p < q ? p : q;
        b.high[a] = p < q ? q : p;
    }
    return b;
}

/* Coordinates along an axis of the box: its ends, their neighbours, its centre, beyond. */
#define PLACES 11
static float place(const box *b, int a, int i)
{
    const float l = b->low[a], h = b->high[a], size = h - l > 0 ? h - l : 1;
    const float at[PLACES] = {l,
                              h,
                              nextafterf(l, -INFINITY),
                              nextafterf(l, INFINITY),
                              nextafterf(h, -INFINITY),
                              nextafterf(h, INFINITY),
                              0.5f * l + 0.5f * h,
                              l - size,
                              h + size,
                              l - 1e4f * size,
                              h + 0.01f * size};
    return at[i];
}

/* ---- tests ---- */

/* Axes and diagonals, with every kind of (nearly) zero in the other components, from faces, edges, corners, inside,
 * outside. */
TEST(directions_of_axes_and_diagonals)
{
    static const float nothing[] = {0.f, -0.f, 0x1p-149f, -0x1p-140f, 1e-30f, -1e-30f, 0x1p-101f, 0x1p-99f};
    static const float lengths[] = {1, 1e-6f, 1e6f, 0x1p-50f, 0x1p50f};
    test_random r = random_make(1);
    queue q = {.used = 0};
    for (uint32_t round = 1 + test_scaled(15); round; round--) {
        const box b = random_box(&r);
        q.b = &b;
        for (int towards = 0; towards < 27; towards++) {
            const int sign[3] = {towards % 3 - 1, towards / 3 % 3 - 1, towards / 9 - 1};
            if (!sign[0] && !sign[1] && !sign[2])
                continue;
            for (size_t n = 0; n < TEST_COUNT(nothing); n++)
                for (int from = 0; from < 6; from++) {
                    const float length = lengths[random_below(&r, TEST_COUNT(lengths))];
                    truth_ray ray = {.t_min = random_below(&r, 4) ? 0 : -INFINITY, .t_max = INFINITY};
                    for (int a = 0; a < 3; a++) {
                        ray.dir[a] = sign[a] ? (float)sign[a] * length : nothing[n];
                        ray.org[a] = place(&b, a, (int)random_below(&r, PLACES));
                    }
                    push(&q, &ray);
                }
        }
        flush(&q);
    }
    expect_right("axes and diagonals", &q.sum, 0.8);
}

/* Aimed at corners, edges and faces, or just past them, with ranges that end there. */
TEST(aimed_at_the_surface)
{
    test_random r = random_make(2);
    queue q = {.used = 0};
    for (uint32_t round = 20 + test_scaled(2500); round; round--) {
        const box b = random_box(&r);
        const float reach = random_log(&r, 1e-1f, 1e4f), length = random_log(&r, 1e-12f, 1e12f);
        q.b = &b;
        for (int i = 0; i < 16; i++) {
            truth_ray ray = {.t_min = 0, .t_max = INFINITY};
            for (int a = 0; a < 3; a++) {
                const float to = place(&b, a, (int)random_below(&r, 7));
                ray.org[a] = to + random_float(&r, -1, 1) * reach;
                ray.dir[a] = (to - ray.org[a]) * length;
            }
            const float t = 1 / length * (1 + random_float(&r, -1, 1) * random_log(&r, 1e-8f, 1));
            if (random_below(&r, 4) == 0)
                ray.t_max = t;
            else if (random_below(&r, 4) == 0)
                ray.t_min = t;
            push(&q, &ray);
        }
        flush(&q);
    }
    expect_right("aimed at the surface", &q.sum, 0.25);
}

/* Coordinates up to 2^55 and directions as short as 2^-55, where products overflow and underflow. */
TEST(extremes)
{
    test_random r = random_make(3);
    queue q = {.used = 0};
    for (uint32_t round = 20 + test_scaled(2500); round; round--) {
        const bool tiny = random_below(&r, 4) == 0; /* every t is a denormal */
        const int size = tiny ? -(int)random_below(&r, 10) - 130 : (int)random_below(&r, 190) - 140;
        const int aim = tiny ? (int)random_below(&r, 4) : (int)random_below(&r, 100) - 50;
        box b = random_box(&r);
        for (int a = 0; a < 3; a++) {
            b.low[a] = ldexpf(b.low[a], size - 10);
            b.high[a] = ldexpf(b.high[a], size - 10);
        }
        q.b = &b;
        for (int i = 0; i < 16; i++) {
            truth_ray ray = {.t_min = random_below(&r, 4) ? 0 : -INFINITY, .t_max = INFINITY};
            double longest = 0, dir[3];
            for (int a = 0; a < 3; a++) {
                const double to = place(&b, a, (int)random_below(&r, PLACES));
                ray.org[a] = !tiny && random_below(&r, 4)
                                 ? ldexpf(random_float(&r, -1, 1), (int)random_below(&r, 100) - 45)
                                 : place(&b, a, (int)random_below(&r, 7));
                dir[a] = to - ray.org[a];
                longest = fmax(longest, fabs(dir[a]));
            }
            for (int a = 0; a < 3; a++)
                ray.dir[a] = longest > 0 ? (float)ldexp(dir[a] / longest, aim) : 1;
            push(&q, &ray);
        }
        flush(&q);
    }
    expect_right("extremes", &q.sum, 0.3);
}

/* Rays that pass the box by at most a hundredth of its size. */
TEST(near_misses_are_reported)
{
    test_random r = random_make(4);
    tally sum = {0};
    for (uint32_t round = 50 + test_scaled(8000); round; round--) {
        truth_ray ray[CGT_LANES];
        const box b = random_box(&r);
        box grown = b;
        const float distance = random_log(&r, 1, 100);
        float size = 0;
        tally all = {0};
        for (int a = 0; a < 3; a++)
            size = fmaxf(size, b.high[a] - b.low[a]);
        for (int a = 0; a < 3; a++) {
            grown.low[a] -= 0.01f * size;
            grown.high[a] += 0.01f * size;
        }
        for (int k = 0; k < CGT_LANES; k++) { /* towards a point on the surface of the enlarged box */
            const int flat = (int)random_below(&r, 3);
            ray[k] = (truth_ray){.t_min = 0, .t_max = INFINITY};
            for (int a = 0; a < 3; a++) {
                const float to = a == flat ? random_below(&r, 2) ? grown.low[a] : grown.high[a]
                                           : random_float(&r, grown.low[a], grown.high[a]);
                ray[k].org[a] = b.low[a] + random_float(&r, -1, 1) * distance * size;
                ray[k].dir[a] = to - ray[k].org[a];
            }
        }
        judge(ray, &b, &all);
        sum.rays += all.rays;
        sum.hit += all.hit;
        sum.missed += all.missed;
        sum.reported += all.reported;
        sum.lost += all.lost;
        sum.not_numbers += all.not_numbers;
    }
    expect_right("near misses", &sum, 0.99);
}

VARIANT_SUITE("test_ray_box", NULL, NULL)
