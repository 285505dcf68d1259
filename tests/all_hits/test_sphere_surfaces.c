/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points on spheres, and rays from them: spheres and boxes on one lattice of whole numbers, and the polynomials of
 * exact/crossing.h evaluated in 128 bits for a real h, squares included. h = 2^-7 is small enough there: linear terms
 * are below 2^6 or whole, so that 2 h^4 outweighs 2^6 h^5, and 2 h^6 all squares, which are below 2 h^8. */
#include <cgt/all_hits.h>

#include <string.h>

#include "all_hits/crossing_cases.h"
#include "support/scenes.h"
#include "support/suite.h"

#if CROSSING_JUDGE

#define BALLS 24u
#define BOXES 6u
#define SIDES 12u
#define POINTS 256u
#define RAYS 128u

__extension__ typedef __int128 wide;
#define UNIT ((wide)1 << 42) /* one, in units of h^6 */

/* Whole numbers; the scene gets them times 2^exponent. */
typedef struct lattice_world {
    int ball[BALLS][4], box[BOXES][2][3], point[POINTS][3];
    float sphere[BALLS][4], corner[BOXES][3 * SIDES][3], place[POINTS][3];
    int exponent;
} lattice_world;

/* ---- the judge ---- */

static void move(const int p[3], wide moved[3])
{
    for (int a = 0; a < 3; a++)
        moved[a] = p[a] * UNIT + ((wide)1 << (14 - 7 * a));
}

static bool is_in_ball(const int ball[4], const wide p[3])
{
    const wide r = ball[3] * UNIT;
    wide power = -r * r;
    for (int a = 0; a < 3; a++) {
        const wide c = ball[a] * UNIT - p[a];
        power += c * c;
    }
    return power < 0;
}

static bool is_in_box(int (*box)[3], const wide p[3])
{
    bool inside = true;
    for (int a = 0; a < 3; a++)
        inside &= p[a] > box[0][a] * UNIT && p[a] < box[1][a] * UNIT;
    return inside;
}

/* Whether the line meets a ball at two places. Touching ones are moved off it, or cross it at one place. */
static bool meets_twice(const int ball[4], const int org[3], const int dir[3])
{
    int64_t dd = 0, dc = 0, power = -(int64_t)ball[3] * ball[3];
    for (int a = 0; a < 3; a++) {
        const int64_t c = ball[a] - org[a];
        dd += (int64_t)dir[a] * dir[a];
        dc += dir[a] * c;
        power += c * c;
    }
    return dc * dc > dd * power;
}

/* Whether the ball lies ahead of an origin outside of it: both places do. */
static bool is_ahead(const int ball[4], const int org[3], const int dir[3])
{
    int dc = 0;
    for (int a = 0; a < 3; a++)
        dc += dir[a] * (ball[a] - org[a]);
    return dc > 0;
}

/* ---- worlds ---- */

static void make_box(int (*box)[3], float (*corner)[3], int exponent)
{
    static const int face[SIDES][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (uint32_t i = 0; i < 3 * SIDES; i++)
        for (int a = 0; a < 3; a++)
            corner[i][a] = ldexpf((float)box[face[i / 3][i % 3] >> a & 1][a], exponent);
}

/* Balls through many points of the lattice: radii 1 to 5 around 0 to 8. Points: those, and any of the lattice. */
static void world_make(lattice_world *w, int exponent, test_random *r)
{
    static const int on_unit[][3] = {{5, 0, 0}, {0, 5, 0}, {0, 0, 5}, {3, 4, 0}, {0, 3, 4}, {4, 0, 3}};
    w->exponent = exponent;
    for (uint32_t i = 0; i < 4 * BALLS; i++)
        w->ball[i / 4][i % 4] = i % 4 < 3 ? (int)random_below(r, 9) : (int)random_below(r, 6);
    for (uint32_t i = 0; i < BALLS; i++)
        for (int a = 0; a < 4; a++)
            w->sphere[i][a] = ldexpf((float)w->ball[i][a], exponent);
    for (uint32_t b = 0; b < BOXES; b++) {
        for (int a = 0; a < 3; a++) {
            w->box[b][0][a] = (int)random_below(r, 8);
            w->box[b][1][a] = w->box[b][0][a] + 1 + (int)random_below(r, 3);
        }
        make_box(w->box[b], w->corner[b], exponent);
    }
    for (uint32_t i = 0; i < POINTS; i++) {
        const int *const ball = w->ball[random_below(r, BALLS)], *const on = on_unit[random_below(r, 6)];
        const int signs = (int)random_below(r, 16), axis = (int)random_below(r, 3);
        for (int a = 0; a < 3; a++) {
            w->point[i][a] = ball[a] + (ball[3] == 5 ? on[a] : a == axis ? ball[3] : 0) * (signs >> a & 1 ? 1 : -1);
            if (signs > 12)
                w->point[i][a] = (int)random_below(r, 15) - 3;
            w->place[i][a] = ldexpf((float)w->point[i][a], exponent);
        }
    }
}

static cgt_scene *scene_of_world(cgt_context *context, const test_way *way, const lattice_world *w)
{
    const cgt_spheres spheres = spheres_of(w->sphere, BALLS);
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&way->scene), &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    for (uint32_t b = 0; b < BOXES; b++) {
        const cgt_triangles box = {
            .count = SIDES, .vertices = cgt_floats(w->corner[b][0], 0), .vertex_count = 3 * SIDES};
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &box), CGT_OK);
    }
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* ---- points ---- */

/* Returns how many are on a sphere. */
static uint32_t check_points(const cgt_scene *scene, lattice_world *w, const test_way *way, cgt_inside_rule rule)
{
    uint8_t inside[POINTS];
    uint32_t on_spheres = 0;
    const cgt_inside_options how = {.rule = rule};
    const cgt_points points = {
        .count = POINTS, .stride = sizeof w->place[0], .position = {&w->place[0][0], &w->place[0][1], &w->place[0][2]}};
    assert_int_equal(cgt_points_inside(scene, &points, &how, inside, NULL), CGT_OK);
    for (uint32_t i = 0; i < POINTS; i++) {
        bool want = false, on_sphere = false;
        wide p[3];
        move(w->point[i], p);
        for (uint32_t k = 0; k < BALLS; k++) {
            int power = -w->ball[k][3] * w->ball[k][3];
            for (int a = 0; a < 3; a++)
                power += (w->ball[k][a] - w->point[i][a]) * (w->ball[k][a] - w->point[i][a]);
            on_sphere |= power == 0;
            want |= is_in_ball(w->ball[k], p);
        }
        for (uint32_t k = 0; k < BOXES; k++)
            want |= is_in_box(w->box[k], p);
        on_spheres += on_sphere;
        if (inside[i] != want)
            fail_msg("%s, rule %d: point %d, %d, %d is %u, not %d", way->name, (int)rule, w->point[i][0],
                     w->point[i][1], w->point[i][2], inside[i], want);
    }
    return on_spheres;
}

/* ---- crossings ---- */

/* Of each ray: crossings of each ball, and boxes; and the sums of their sides. */
typedef struct crossing_counts {
    int balls[RAYS][BALLS], ball_sum[RAYS][BALLS], box_sum[RAYS][BOXES];
} crossing_counts;

static cgt_visit count_hits(void *user, uint64_t ray, const cgt_hit *hits, uint32_t count)
{
    crossing_counts *c = user;
    for (uint32_t k = 0; k < count; k++) {
        const int side = hits[k].surface == CGT_SURFACE_FAR ? 1 : -1;
        if (hits[k].geometry) {
            c->box_sum[ray][hits[k].geometry - 1] += side;
            continue;
        }
        c->balls[ray][hits[k].primitive]++;
        c->ball_sum[ray][hits[k].primitive] += side;
    }
    return CGT_VISIT_CONTINUE;
}

typedef struct lattice_rays {
    int org[RAYS][3], dir[RAYS][3];
    float number[RAYS][8];
} lattice_rays;

/* From points of the world; half of them along a tangent of a ball there, if it is on one. */
static void make_rays(const lattice_world *w, lattice_rays *rays, test_random *r)
{
    for (uint32_t i = 0; i < RAYS; i++) {
        const int *const from = w->point[random_below(r, POINTS)], *const ball = w->ball[random_below(r, BALLS)];
        int d[3], c[3];
        for (int a = 0; a < 3; a++) {
            d[a] = (int)random_below(r, 7) - 3;
            c[a] = ball[a] - from[a];
        }
        for (int a = 0; a < 3; a++) {
            rays->org[i][a] = from[a];
            rays->dir[i][a] = i % 2 ? d[a] : c[(a + 1) % 3] * d[(a + 2) % 3] - c[(a + 2) % 3] * d[(a + 1) % 3];
        }
        if (!rays->dir[i][0] && !rays->dir[i][1] && !rays->dir[i][2])
            rays->dir[i][i % 3] = 1;
        for (int a = 0; a < 3; a++) {
            rays->number[i][a] = ldexpf((float)from[a], w->exponent);
            rays->number[i][3 + a] = (float)rays->dir[i][a];
        }
        rays->number[i][6] = i % 5 ? 0 : -INFINITY;
        rays->number[i][7] = INFINITY;
    }
}

/* Returns how many begin where they touch a ball, moved into it. */
static uint32_t check_rays(const cgt_scene *scene, const lattice_world *w, lattice_rays *rays, const test_way *way)
{
    static crossing_counts c;
    uint32_t begins = 0;
    const cgt_all_hits_options all = {.crossings = true};
    float *const n = rays->number[0];
    const cgt_rays asked = {.count = RAYS,
                            .stride = sizeof rays->number[0],
                            .org = {n, n + 1, n + 2},
                            .dir = {n + 3, n + 4, n + 5},
                            .t_min = n + 6,
                            .t_max = n + 7};
    memset(&c, 0, sizeof c);
    assert_int_equal(cgt_visit_all_rays(scene, &asked, &all, 0, count_hits, &c, NULL), CGT_OK);
    for (uint32_t i = 0; i < RAYS; i++) {
        const bool line = rays->number[i][6] < 0;
        wide p[3];
        move(rays->org[i], p);
        for (uint32_t k = 0; k < BALLS; k++) {
            const bool twice = meets_twice(w->ball[k], rays->org[i], rays->dir[i]),
                       inside = !line && is_in_ball(w->ball[k], p);
            const int want = inside ? 1 : twice && (line || is_ahead(w->ball[k], rays->org[i], rays->dir[i])) ? 2 : 0;
            begins += inside && !twice;
            if (c.balls[i][k] != want || c.ball_sum[i][k] != inside)
                fail_msg("%s: ray from %d, %d, %d along %d, %d, %d: ball %d, %d, %d, %d has %d crossings, not %d, of "
                         "sum %d",
                         way->name, rays->org[i][0], rays->org[i][1], rays->org[i][2], rays->dir[i][0], rays->dir[i][1],
                         rays->dir[i][2], w->ball[k][0], w->ball[k][1], w->ball[k][2], w->ball[k][3], c.balls[i][k],
                         want, c.ball_sum[i][k]);
        }
        for (uint32_t k = 0; k < BOXES; k++)
            assert_int_equal(c.box_sum[i][k], !line && is_in_box((int(*)[3])w->box[k], p));
    }
    return begins;
}

TEST(spheres_and_boxes_on_one_lattice)
{
    static const int exponents[] = {0, -1, 3, 100, -100, -149};
    static lattice_world w;
    static lattice_rays rays;
    const uint32_t cases = test_between(24, 120);
    uint32_t on_spheres = 0, begins = 0;
    test_random r = random_make(443);
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1 + random_below(&r, 2), variant);
        for (uint32_t i = 0; i < cases; i++) {
            const test_way *way = way_in_turn(i % 2 ? WAY_EACH : WAY_CHOSEN, i / 2);
            world_make(&w, exponents[random_below(&r, TEST_COUNT(exponents))], &r);
            make_rays(&w, &rays, &r);
            cgt_scene *scene = scene_of_world(context, way, &w);
            for (int rule = 0; rule < 2; rule++)
                on_spheres += check_points(scene, &w, way, (cgt_inside_rule)rule);
            begins += check_rays(scene, &w, &rays, way);
            cgt_scene_release(scene);
        }
        cgt_context_release(context);
    }
    print_message("%u points on spheres, %u rays touch the sphere that they begin in\n", on_spheres, begins);
    assert_true(on_spheres > 50 * cases && begins > cases);
}

#endif

/* The ray that is chosen for this point touches the sphere there: no structure may see another side of it. */
TEST(a_point_whose_ray_touches_its_sphere)
{
    static const float ball[][4] = {{10, 430, -1213, 1287}, {-5000, 0, 0, 1}, {0, 9000, 0, 1},
                                    {0, -9000, 0, 1},       {0, 0, -9000, 1}, {0, 0, 9000, 1}};
    static const float at[3] = {0, 0, 0};
    static const cgt_all_hits_options all = {.crossings = true};
    const cgt_points point = {.count = 1, .position = {&at[0], &at[1], &at[2]}};
    const cgt_single_ray ray = {.dir = {16, 0.2890625f, 0.234375f}};
    cgt_context *context = context_make(1, NULL);
    FOR_EACH_WAY(way, WAY_EACH)
    {
        const uint32_t primitive = 0, far = CGT_SURFACE_FAR;
        cgt_all_hits_options after = all;
        uint8_t inside = 9;
        cgt_hit hit[2];
        uint32_t count;
        bool more;
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&way->scene), ball, TEST_COUNT(ball));
        assert_int_equal(cgt_points_inside(scene, &point, NULL, &inside, NULL), CGT_OK);
        assert_int_equal(inside, 1);
        assert_int_equal(cgt_trace_all_ray(scene, &ray, &all, hit, 2, &count, &more, NULL), CGT_OK);
        assert_int_equal(count, 1);
        assert_int_equal(hit[0].surface, CGT_SURFACE_FAR);
        assert_true(hit[0].t == 0);
        after.after_primitive = &primitive;
        after.after_surface = &far;
        assert_int_equal(cgt_trace_all_ray(scene, &ray, &after, hit, 2, &count, &more, NULL), CGT_OK);
        assert_int_equal(count, 0);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

SEEDED_SUITE("test_sphere_surfaces", NULL, NULL)
