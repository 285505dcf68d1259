/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The margins of a bounding interval hierarchy's planes, with one variant: a ray passes a plane at a t that is within
 * the interval of every node that the plane belongs to, whatever its origin, direction and the plane, in vectors of any
 * mix of directions, and one at a time. Then both margins are tightened until this fails. The test compiles the
 * traversal itself and links it in place of the library's. */
#include <math.h>
#include <string.h>

#include "support/random.h"
#include "support/suite.h"
#include "support/test.h"
#include "support/tightened.h"

static float error_scale = 1;
#define BIH_ERROR_SCALE error_scale
#include "papers/kernel/bih/bih_traverse.c"

#define ROUNDS test_between(4000, 40000)

typedef struct tally {
    uint64_t tests, failures;
} tally;

/* Numbers of all sizes, with zeros among them and neighbours of each other. */
static float any_size(test_random *r, int most)
{
    const uint32_t kind = random_below(r, 8);
    if (kind == 0)
        return random_below(r, 2) ? 0.f : -0.f;
    const int exponent = kind < 5 ? (int)random_below(r, 4) - 2 : (int)random_below(r, 2 * (uint32_t)most) - most;
    return ldexpf(random_float(r, -1, 1), exponent);
}

static float any_plane(test_random *r, float org)
{
    return random_below(r, 3) ? any_size(r, 54) : org * (1 + random_float(r, -1, 1) * 0x1p-18f);
}

/* A node whose only child begins and ends at the plane, but for the margin of planes. */
static cgt_bih_node clip_node(uint32_t axis, float plane)
{
    const float margin = (fabsf(plane) * CGT_BIH_MARGIN + CGT_BIH_LEAST_MARGIN) * error_scale;
    return cgt_bih_inner(axis, true, plane - margin, plane + margin, 2);
}

/* The nodes that end and begin at the plane: what lies there is in both children. */
static cgt_bih_node split_node(uint32_t axis, float plane)
{
    const float margin = (fabsf(plane) * CGT_BIH_MARGIN + CGT_BIH_LEAST_MARGIN) * error_scale;
    return cgt_bih_inner(axis, false, plane + margin, plane - margin, 2);
}

/* Whether ray i, which passes the plane at t, would lose what lies in it. */
static void judge(const packet *p, uint32_t i, uint32_t axis, float plane, double near, double far, tally *sum)
{
    const double dir = (double)p->dir[axis][i], delta = (double)plane - (double)p->org[axis][i];
    const double t = delta / dir;
    if (dir == 0 && delta != 0)
        return; /* never passes it */
    sum->tests++;
    if (dir == 0 ? !(near <= far) : !(near <= t && t <= far))
        sum->failures++;
}

static void check_vector(const packet *p, uint32_t axis, float plane, tally *sum)
{
    _Alignas(64) float near[3][CGT_LANES], far[3][CGT_LANES];
    const cgt_bih_node clip = clip_node(axis, plane), split = split_node(axis, plane);
    const bih_part whole = {spux_vfloat(-INFINITY), spux_vfloat(INFINITY)};
    tree_rays r;
    bih_part part[3];
    bih_rays_init(p, 0, &r);
    part[0] = bih_clip(&r, &clip, whole);
    bih_split(&r, &split, whole, part + 1);
    for (int k = 0; k < 3; k++) {
        spux_store(near[k], part[k].near);
        spux_store(far[k], part[k].far);
        for (uint32_t i = 0; i < CGT_LANES; i++)
            judge(p, i, axis, plane, (double)near[k][i], (double)far[k][i], sum);
    }
}

static void check_one(const packet *p, uint32_t i, uint32_t axis, float plane, tally *sum)
{
    const cgt_bih_node clip = clip_node(axis, plane), split = split_node(axis, plane);
    tree_ray_entry stack[1] = {{INFINITY, -INFINITY, 0}};
    bih_ray r;
    float near = -INFINITY, far = INFINITY;
    uint32_t top = 0;
    bih_ray_init(p, i, &r);
    bool passes = bih_ray_descend(&r, &clip, &near, &far, stack, &top) != CGT_INVALID_ID;
    judge(p, i, axis, plane, passes ? (double)near : INFINITY, (double)far, sum);
    near = -INFINITY;
    far = INFINITY;
    passes = bih_ray_descend(&r, &split, &near, &far, stack, &top) != CGT_INVALID_ID;
    judge(p, i, axis, plane, passes ? (double)near : INFINITY, (double)far, sum);
    judge(p, i, axis, plane, (double)stack[0].near, (double)stack[0].far, sum); /* the other child waits there */
}

static void check_rays(test_random *r, tally *sum)
{
    static packet p;
    const float org = any_size(r, 54);
    const bool same_signs = random_below(r, 2);
    for (uint32_t i = 0; i < CGT_LANES; i++)
        for (int a = 0; a < 3; a++) {
            p.org[a][i] = random_below(r, 2) ? org : any_size(r, 54);
            const float d = random_below(r, 16)  ? ldexpf(random_float(r, 0.1f, 1), (int)random_below(r, 60) - 30)
                            : random_below(r, 2) ? 0
                                                 : any_size(r, 54) * 0x1p-54f;
            p.dir[a][i] = same_signs ? fabsf(d) : random_below(r, 2) ? d : -d;
        }
    for (uint32_t axis = 0; axis < 3; axis++) {
        const float plane = any_plane(r, p.org[axis][0]);
        check_vector(&p, axis, plane, sum);
        for (uint32_t i = 0; i < CGT_LANES; i++)
            check_one(&p, i, axis, plane, sum);
    }
}

TEST(planes_are_never_missed)
{
    static tally tallies[STEPS];
    for (int step = 0; step < bound_steps(); step++) {
        test_random r = random_make(4321);
        for (uint32_t round = 0; round < ROUNDS; round++)
            check_rays(&r, &tallies[step]);
        if (step == 0)
            print_message("%llu planes passed\n", (unsigned long long)tallies[0].tests);
        assert_true(step > 0 || tallies[0].failures == 0);
        if (tallies[step].failures)
            break;
        error_scale *= 0.70710678f;
    }
    error_scale = 1;
    check_break("margins", tallies, sizeof tallies[0], offsetof(tally, failures), 0.004);
}

VARIANT_SUITE("test_bih_margins", NULL, NULL)
