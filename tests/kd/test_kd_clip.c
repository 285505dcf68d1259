/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bounds of clipped triangles contain the exact part, as exact arithmetic decides, and are not much larger. */
#include <math.h>
#include <string.h>

#include "exact/valid_primitive.h"
#include "support/suite.h"
#include "papers/build/kd/split/kd_clip.h"
#include "structures/check/kd_touch.h"
#include "support/test.h"

#define CASES 8000

typedef enum place {
    PLACE_LATTICE,
    PLACE_CANCELS,
    PLACE_UNIT,
    PLACE_FAR,
    PLACE_WIDE,
    PLACE_HUGE,
    PLACE_TINY,
    PLACES
} place;

static float number(test_random *r, place where)
{
    switch (where) {
    case PLACE_LATTICE: return (float)((int)random_below(r, 9) - 4);
    case PLACE_CANCELS: { /* close to 1, -1 or 0: differences nearly cancel */
        const float step = (float)random_below(r, 8) * 0x1p-23f;
        return random_below(r, 4) ? (random_below(r, 2) ? 1 + step : -1 - step) : step;
    }
    case PLACE_UNIT: return random_float(r, -1, 1);
    case PLACE_FAR: return 1000 + random_float(r, -1, 1);
    case PLACE_WIDE: return random_log(r, 0x1p-100f, 0x1p50f) * (random_below(r, 2) ? 1 : -1);
    case PLACE_HUGE: return random_float(r, -0x1p55f, 0x1p55f);
    default: return random_float(r, -0x1p-140f, 0x1p-140f);
    }
}

static cgt_primitive random_triangle(test_random *r, place where)
{
    cgt_primitive primitive = {.kind = CGT_KIND_TRIANGLES};
    do
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                primitive.triangle.v[k][a] = number(r, where);
    while (cgt_primitive_check(&primitive) != CGT_PRIMITIVE_VALID);
    return primitive;
}

/* Coordinates from the same range, or the triangle's own, so that the box touches it exactly. */
static kd_box random_box(test_random *r, place where, const cgt_triangle *q)
{
    kd_box box;
    for (int a = 0; a < 3; a++) {
        float x[2];
        for (int k = 0; k < 2; k++) {
            x[k] = number(r, where);
            if (random_below(r, 4) == 0)
                x[k] = q->v[random_below(r, 3)][a];
        }
        if (x[0] == x[1])
            x[1] = nextafterf(x[1], INFINITY);
        box.low[a] = fminf(x[0], x[1]);
        box.high[a] = fmaxf(x[0], x[1]);
    }
    return box;
}

static void fail_clip(const char *what, const cgt_triangle *q, const kd_box *box)
{
    for (int k = 0; k < 3; k++)
        print_message("vertex %a %a %a\n", (double)q->v[k][0], (double)q->v[k][1], (double)q->v[k][2]);
    print_message("box %a %a %a to %a %a %a\n", (double)box->low[0], (double)box->low[1], (double)box->low[2],
                  (double)box->high[0], (double)box->high[1], (double)box->high[2]);
    fail_msg("%s", what);
}

/* No part of the triangle inside the box may lie outside the bounds. */
static void check_outside(const cgt_primitive *primitive, const kd_box *box, const cgt_kd_box *bounds)
{
    for (int a = 0; a < 3; a++) {
        kd_box lower = *box, upper = *box;
        lower.high[a] = nextafterf(bounds->low[a], -INFINITY);
        upper.low[a] = nextafterf(bounds->high[a], INFINITY);
        if (lower.low[a] <= lower.high[a] && kd_touches(primitive, &lower))
            fail_clip("a part is below the bounds", &primitive->triangle, box);
        if (upper.low[a] <= upper.high[a] && kd_touches(primitive, &upper))
            fail_clip("a part is above the bounds", &primitive->triangle, box);
    }
}

/* Counts the faces where the bounds are tight: the clipped part reaches to just inside of them. */
static uint32_t count_tight(const cgt_primitive *primitive, const kd_box *box, const cgt_kd_box *bounds)
{
    uint32_t tight = 0;
    for (int a = 0; a < 3; a++) {
        kd_box lower = *box, upper = *box;
        float largest = fmaxf(fabsf(bounds->low[a]), fabsf(bounds->high[a]));
        for (int k = 0; k < 3; k++)
            largest = fmaxf(largest, fabsf(primitive->triangle.v[k][a]));
        lower.high[a] = fminf(box->high[a], bounds->low[a] + 0x1p-20f * largest + 0x1p-147f);
        upper.low[a] = fmaxf(box->low[a], bounds->high[a] - 0x1p-20f * largest - 0x1p-147f);
        tight += kd_touches(primitive, &lower);
        tight += kd_touches(primitive, &upper);
    }
    return tight;
}

TEST(test_boxes)
{
    uint32_t touched = 0, tight = 0, refused = 0;
    for (int where = 0; where < PLACES; where++) {
        test_random r = random_make((uint64_t)where);
        for (uint32_t i = 0; i < 100 + test_scaled(CASES); i++) {
            const cgt_primitive primitive = random_triangle(&r, (place)where);
            const kd_box box = random_box(&r, (place)where, &primitive.triangle);
            cgt_kd_box clip, bounds;
            memcpy(&clip, &box, sizeof clip);
            bounds = clip;
            const bool nonempty = cgt_kd_clip_box(&primitive.triangle, &clip, &bounds);
            if (!kd_touches(&primitive, &box)) {
                refused += !nonempty;
                continue;
            }
            if (!nonempty)
                fail_clip("the part is not empty", &primitive.triangle, &box);
            check_outside(&primitive, &box, &bounds);
            touched++;
            tight += count_tight(&primitive, &box, &bounds);
        }
    }
    print_message("%u boxes touch, %u of %u bounds are tight; %u do not touch and are rejected\n", touched, tight,
                  6 * touched, refused);
    assert_true(touched > 100);
    assert_true(refused > 100);
    assert_true(tight > 5.9 * touched);
}

TEST(test_sides)
{
    uint32_t cut = 0, tight = 0;
    for (int where = 0; where < PLACES; where++) {
        test_random r = random_make(100 + (uint64_t)where);
        for (uint32_t i = 0; i < 100 + test_scaled(CASES); i++) {
            const cgt_primitive primitive = random_triangle(&r, (place)where);
            const uint32_t axis = random_below(&r, 3);
            const float split = number(&r, (place)where);
            const float *x = &primitive.triangle.v[0][axis];
            if (split < fminf(x[0], fminf(x[3], x[6])) || split > fmaxf(x[0], fmaxf(x[3], x[6])))
                continue;
            cgt_kd_bounds4 side[2];
            cgt_kd_clip_sides(&primitive.triangle, axis, split, side);
            for (int s = 0; s < 2; s++) {
                kd_box box = {{-0x1p56f, -0x1p56f, -0x1p56f}, {0x1p56f, 0x1p56f, 0x1p56f}};
                cgt_kd_box bounds;
                for (int a = 0; a < 3; a++) {
                    bounds.low[a] = side[s].low[a];
                    bounds.high[a] = side[s].high[a];
                }
                (s ? bounds.low : bounds.high)[axis] = split;
                (s ? box.low : box.high)[axis] = split;
                check_outside(&primitive, &box, &bounds);
                cut++;
                tight += count_tight(&primitive, &box, &bounds);
            }
        }
    }
    print_message("%u parts, %u of %u bounds are tight\n", cut, tight, 6 * cut);
    assert_true(cut > 100);
    assert_true(tight > 5.9 * cut);
}

/* Planes are numbered without gaps in ascending order; below and above are strict. */
TEST(test_planes)
{
    test_random r = random_make(7);
    for (uint32_t i = 0; i < 1000 + test_scaled(200000); i++) {
        const float x = i < 8 ? ((const float[]){0, -0.0f, 0x1p-149f, -0x1p-149f, 0x1p55f, -0x1p55f, 1, -1})[i]
                              : random_any_float(&r);
        if (!(fabsf(x) <= 0x1p55f))
            continue;
        const int32_t below = cgt_kd_plane_below(x), above = cgt_kd_plane_above(x);
        assert_true(cgt_kd_plane_at(below) < x && cgt_kd_plane_at(above) > x);
        assert_true(cgt_kd_plane_at(below + 1) >= x && cgt_kd_plane_at(above - 1) <= x);
        for (int32_t k = below; k <= above; k++) {
            const float plane = cgt_kd_plane_at(k);
            assert_int_equal(cgt_kd_plane_number(plane), k);
            assert_true(same_bits(cgt_kd_round_split(plane), plane));
            assert_true(k == below || plane > cgt_kd_plane_at(k - 1));
        }
    }
}

SEEDED_SUITE("test_kd_clip", NULL, NULL)
