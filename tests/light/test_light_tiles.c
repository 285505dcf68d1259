/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The points that a camera sees against one light, in scenes large enough for tiles through the loose grid. The result
 * is that of cgt_occluded_rays through another structure, for any light, order and number of points, ranges, masks,
 * skipped primitives and strides, every variant and number of threads. Tiles are used exactly where they apply. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"

/* With an emulator or sanitizers: a sample. */
static bool is_slow(void) { return test_scaled(10) < 2; }

#define SIDE 64u
#define POINTS (SIDE * SIDE + 1)           /* the pixels of a frame, and one more */
#define LARGE (is_slow() ? 8400u : 10000u) /* primitives: enough that points are always sorted */
#define SMALL 2000u

/* ---- scenes ---- */

typedef enum content { SPHERES = 1, TRIANGLES = 2, BOTH = 3 } content;

typedef struct crowd {
    cloud balls;
    float (*corner)[9];
    content what;
    const char *name;
} crowd;

/* Triangles as large as the spheres that they replace; two of four share an edge. */
static crowd crowd_make(test_random *r, cloud_kind kind, content what, uint32_t prims)
{
    crowd c = {.balls = cloud_make(r, kind, prims), .what = what, .name = cloud_name(kind)};
    c.corner = malloc(prims * sizeof *c.corner);
    assert_non_null(c.corner);
    for (uint32_t i = 0; i < prims; i++)
        for (int k = 0; k < 9; k++)
            c.corner[i][k] = i % 4 == 1 && k >= 3
                                 ? c.corner[i - 1][k]
                                 : c.balls.sphere[i][k % 3] + 1.5f * c.balls.sphere[i][3] * random_float(r, -1, 1);
    return c;
}

static void crowd_free(crowd *c)
{
    free(c->corner);
    cloud_free(&c->balls);
}

/* A geometry of each kind, with masks that share a bit. BOTH: every primitive is in one of the two. */
static cgt_scene *crowd_commit(cgt_context *context, const crowd *c, cgt_structure structure)
{
    const uint32_t half = c->what == BOTH ? c->balls.count / 2 : 0;
    cgt_spheres spheres = spheres_of((const float(*)[4])c->balls.sphere, c->balls.count - half);
    const cgt_triangles triangles = {.count = c->balls.count - half,
                                     .vertex_count = 3 * (c->balls.count - half),
                                     .vertices = cgt_floats(c->corner[half], 0),
                                     .mask = 6};
    cgt_scene_options options;
    cgt_scene *scene;
    spheres.mask = 5;
    cgt_scene_options_init(&options);
    options.structure = structure;
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    if (c->what & SPHERES)
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    if (c->what & TRIANGLES)
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* ---- queries ---- */

typedef struct point {
    float at[3], t_min, t_max;
    uint32_t mask, primitive, geometry;
} point;

/* Octants of directional light and the axes follow. */
typedef enum light_kind {
    LIGHT_NEAR,
    LIGHT_FAR,
    LIGHT_VERY_FAR, /* too far for tiles */
    LIGHT_AMONG,
    LIGHT_IN_OBJECT,
    LIGHT_ON_SURFACE, /* at one of the points */
    LIGHT_BEHIND,
    LIGHT_AT_EYE,
    LIGHT_ON_AXIS,
    LIGHT_OCTANT,
    LIGHT_AXIS = LIGHT_OCTANT + 8,
    LIGHT_KINDS = LIGHT_AXIS + 6
} light_kind;

typedef struct query {
    cgt_camera camera;
    point plain[POINTS]; /* in the frame's order */
    point p[POINTS];
    uint8_t expected[POINTS]; /* the expected results */
    cgt_trace_statistics by_rays;
    cgt_light light;
    uint32_t count;
    bool shuffled, ranges, masks, skips, packed; /* packed: arrays without gaps */
} query;

/* The points that a frame's pixels see; pixels without a hit get a point behind the primitives. */
static void look(query *q, test_random *r, const cgt_scene *scene, const crowd *c)
{
    planes p = planes_make(SIDE, SIDE);
    q->camera = random_below(r, 3) ? camera_before(&c->balls) : camera_random(r, &c->balls);
    if (random_below(r, 2) && q->camera.projection == CGT_PROJECTION_PERSPECTIVE) /* a closer view of a part */
        q->camera.fov /= 4;
    truth_ray *ray = frame_rays(&q->camera, SIDE, SIDE);
    frame_trace(scene, &q->camera, &p, NULL);
    for (uint32_t i = 0; i < POINTS; i++) {
        const uint32_t pixel = i < SIDE * SIDE ? i : SIDE;
        const truth_ray *of = &ray[pixel];
        const bool hit = p.primitive[pixel] != CGT_INVALID_ID;
        float length = 0;
        for (int a = 0; a < 3; a++)
            length += of->dir[a] * of->dir[a];
        const float t = hit ? p.t[pixel] : 4 * c->balls.reach / sqrtf(length);
        point *to = &q->plain[i];
        for (int a = 0; a < 3; a++)
            to->at[a] = of->org[a] + t * of->dir[a];
        to->primitive = p.primitive[pixel];
        to->geometry = p.geometry[pixel];
    }
    free(ray);
    planes_free(&p);
}

static void place_light(query *q, test_random *r, const crowd *c, uint32_t kind)
{
    const float *middle = c->balls.middle, reach = c->balls.reach;
    const float *prim = c->balls.sphere[random_below(r, c->balls.count)];
    const float *on = q->plain[random_below(r, SIDE * SIDE)].at;
    const uint32_t axis = random_below(r, 3);
    float away[3];
    random_direction(r, away);
    q->light.kind = kind < LIGHT_OCTANT ? CGT_LIGHT_POINT : CGT_LIGHT_DIRECTIONAL;
    for (uint32_t a = 0; a < 3; a++) {
        const float inside = random_float(r, -1, 1), eye = q->camera.eye[a];
        float *const to = &q->light.position[a];
        switch (kind) {
        case LIGHT_NEAR: *to = on[a] + 0.05f * (eye - on[a]) + 0.02f * reach * inside; break;
        case LIGHT_FAR: *to = middle[a] + 8 * reach * away[a]; break;
        case LIGHT_VERY_FAR: *to = middle[a] + 1e6f * (reach + fabsf(middle[a])) * (inside < 0 ? -1.f : 1.f); break;
        case LIGHT_AMONG: *to = middle[a] + reach * inside; break;
        case LIGHT_IN_OBJECT: *to = prim[a] + 0.5f * prim[3] * inside; break;
        case LIGHT_ON_SURFACE: *to = on[a]; break;
        case LIGHT_BEHIND: *to = middle[a] - 3 * (eye - middle[a]) + reach * inside; break;
        case LIGHT_AT_EYE: *to = eye; break;
        case LIGHT_ON_AXIS: *to = middle[a] + (a == axis ? (away[a] < 0 ? -5 : 5) * reach : 0); break;
        default:
            *to = kind < LIGHT_AXIS ? ((kind - LIGHT_OCTANT) >> a & 1 ? -1.f : 1.f) * random_float(r, 0.05f, 2)
                                    : (float)((kind - LIGHT_AXIS) / 2 == a) * (kind % 2 ? -3.f : 0x1p-10f);
        }
    }
}

static void shuffle(query *q, test_random *r)
{
    for (uint32_t i = POINTS; --i;) {
        const uint32_t k = random_below(r, i + 1);
        const point other = q->p[i];
        q->p[i] = q->p[k];
        q->p[k] = other;
    }
}

/* Varies the arrays by number; successive numbers differ widely. */
static void vary_query(query *q, test_random *r, uint32_t number)
{
    static const uint32_t counts[] = {SIDE * SIDE, POINTS, 1025, SIDE * SIDE, 999, 15, SIDE * SIDE, 2055, 1};
    const bool ends = q->light.kind == CGT_LIGHT_POINT;
    q->count = counts[number % TEST_COUNT(counts)];
    q->shuffled = number % 5 == 4;
    q->ranges = number % 4 == 3;
    q->masks = number % 7 == 5;
    q->skips = number % 4 != 1;
    q->packed = number % 3 != 2;
    memcpy(q->p, q->plain, sizeof q->p);
    for (uint32_t i = 0; i < POINTS; i++) {
        point *p = &q->p[i];
        p->t_min = (float[]){1e-4f, 1e-4f, 0, -0.5f}[number % 8 == 3 ? random_below(r, 4) : random_below(r, 3)];
        p->t_max = (float[]){1, 1, 0.9f, -1, 1.5f}[number % 8 == 3 ? random_below(r, 5) : random_below(r, 4)];
        if (!ends && p->t_max == 1)
            p->t_max = INFINITY;
        p->mask = (uint32_t[]){4, 1, 2, 0, UINT32_MAX}[random_below(r, 5)];
        if (number % 11 == 10)
            p->primitive = random_below(r, 4) ? p->primitive + 1 : CGT_INVALID_ID;
    }
    if (q->shuffled)
        shuffle(q, r);
    if (number % 13 == 6) /* an invalid ray, or an extreme one */
        for (uint32_t k = 0; k < 8; k++)
            q->p[random_below(r, q->count)].at[k % 3] = (float[]){NAN, INFINITY, 0x1p70f, -0x1p-140f}[k % 4];
}

/* ---- expected results ---- */

static void find_expected(query *q, const cgt_scene *scene)
{
    static float dir[3][POINTS * 8], ends[POINTS * 8]; /* as widely strided as the points */
    const point *p = q->p;
    cgt_trace_options options;
    for (uint32_t i = 0; i < q->count; i++) {
        ends[8 * i] = 1;
        for (int a = 0; a < 3; a++)
            dir[a][8 * i] = q->light.kind == CGT_LIGHT_POINT ? q->light.position[a] - p[i].at[a] : q->light.position[a];
    }
    const cgt_rays rays = {.count = q->count,
                           .stride = sizeof *p,
                           .org = {&p->at[0], &p->at[1], &p->at[2]},
                           .dir = {dir[0], dir[1], dir[2]},
                           .t_min = q->ranges ? &p->t_min : NULL,
                           .t_max = q->ranges                          ? &p->t_max
                                    : q->light.kind == CGT_LIGHT_POINT ? ends
                                                                       : NULL,
                           .mask = q->masks ? &p->mask : NULL,
                           .skip_primitive = q->skips ? &p->primitive : NULL,
                           .skip_geometry = q->skips ? &p->geometry : NULL};
    cgt_trace_options_init(&options);
    options.statistics = &q->by_rays;
    assert_int_equal(cgt_occluded_rays(scene, &rays, q->expected, &options), CGT_OK);
}

static cgt_points points_of(const query *q)
{
    static float at[3][POINTS], t_min[POINTS], t_max[POINTS];
    static uint32_t mask[POINTS], primitive[POINTS], geometry[POINTS];
    const point *p = q->p;
    cgt_points points = {.count = q->count,
                         .stride = sizeof *p,
                         .position = {&p->at[0], &p->at[1], &p->at[2]},
                         .t_min = &p->t_min,
                         .t_max = &p->t_max,
                         .mask = &p->mask,
                         .skip_primitive = &p->primitive,
                         .skip_geometry = &p->geometry};
    if (q->packed) {
        points = (cgt_points){q->count, 0, 0, {at[0], at[1], at[2]}, t_min, t_max, mask, primitive, geometry};
        for (uint32_t i = 0; i < q->count; i++) {
            for (int a = 0; a < 3; a++)
                at[a][i] = p[i].at[a];
            t_min[i] = p[i].t_min;
            t_max[i] = p[i].t_max;
            mask[i] = p[i].mask;
            primitive[i] = p[i].primitive;
            geometry[i] = p[i].geometry;
        }
    }
    if (!q->ranges)
        points.t_min = points.t_max = NULL;
    if (!q->masks)
        points.mask = NULL;
    if (!q->skips)
        points.skip_primitive = points.skip_geometry = NULL;
    return points;
}

/* Returns the number of tiles. */
static uint64_t check(const query *q, const cgt_scene *scene, const crowd *c, const char *variant, uint32_t kind)
{
    static uint8_t got[POINTS + 1];
    const cgt_points points = points_of(q);
    cgt_trace_statistics by_points;
    cgt_trace_options options;
    cgt_trace_options_init(&options);
    options.statistics = &by_points;
    memset(got, 0x77, sizeof got);
    assert_int_equal(cgt_occluded_points(scene, &q->light, &points, got, &options), CGT_OK);
    for (uint32_t i = 0; i < q->count; i++)
        if (got[i] != q->expected[i])
            fail_msg(
                "%s, %u %s primitives of content %d, light %u at %a %a %a, kind %d; point %u of %u, at %a %a %a, "
                "range %a %a, mask %x, skipping %u of %u (shuffled %d, ranges %d, masks %d, skips %d, packed %d) %s",
                variant, c->balls.count, c->name, (int)c->what, kind, (double)q->light.position[0],
                (double)q->light.position[1], (double)q->light.position[2], (int)q->light.kind, i, q->count,
                (double)q->p[i].at[0], (double)q->p[i].at[1], (double)q->p[i].at[2], (double)q->p[i].t_min,
                (double)q->p[i].t_max, q->p[i].mask, q->p[i].primitive, q->p[i].geometry, q->shuffled, q->ranges,
                q->masks, q->skips, q->packed, q->expected[i] ? "is in the light" : "is in shadow");
    assert_int_equal(got[q->count], 0x77);
    assert_int_equal(by_points.rays, q->count);
    assert_int_equal(by_points.hits, q->by_rays.hits);
    assert_int_equal(by_points.invalid_rays, q->by_rays.invalid_rays);
    assert_true(by_points.exact_tests <= by_points.double_tests && by_points.double_tests <= by_points.ray_tests);
    return by_points.tiles;
}

/* Whether tiles must be used: light from outside onto the whole frame, in its order, and some rays hit the scene. */
static bool tiles_are_required(const query *q, uint32_t number, uint32_t kind)
{
    const bool outside = kind == LIGHT_FAR || kind == LIGHT_BEHIND || kind >= LIGHT_OCTANT;
    return outside && q->count >= SIDE * SIDE && q->by_rays.hits > q->count / 50 && !q->shuffled && number % 8 != 3 &&
           number % 13 != 6;
}

/* ---- every scene and light ---- */

#define MOST_VARIANTS 8u

typedef struct tally {
    uint64_t points, occluded_points, with_tiles, without;
} tally;

/* Checks a scene with every step-th kind of light. */
static void check_scene(uint32_t number, uint32_t step, tally *sum)
{
    static const cloud_kind kinds[] = {CLOUD_UNIFORM, CLOUD_CLUSTERED, CLOUD_MIXED,
                                       CLOUD_PLANAR,  CLOUD_FAR,       CLOUD_LATTICE};
    static query q;
    test_random r = random_make(900 + number);
    crowd c = crowd_make(&r, kinds[number % TEST_COUNT(kinds)], (content)(1 + (number + number / 6) % 3),
                         number % 5 == 4 ? SMALL : LARGE);
    const char *name[MOST_VARIANTS];
    cgt_context *context[MOST_VARIANTS][2], *other = context_make(2, NULL);
    cgt_scene *scene[MOST_VARIANTS][2], *truth = crowd_commit(other, &c, CGT_STRUCTURE_BVH);
    uint32_t variants = 0;
    FOR_EACH_VARIANT(variant)
    {
        assert_true(variants < MOST_VARIANTS);
        name[variants] = variant;
        for (uint32_t k = 0; k < 2; k++) { /* on slow machines one of the two */
            const bool left_out = is_slow() && k != (number + variants) % 2;
            context[variants][k] = left_out ? NULL : context_make(k ? 3 : 1, variant);
            scene[variants][k] =
                left_out ? NULL
                         : crowd_commit(context[variants][k], &c, k ? CGT_STRUCTURE_AUTO : CGT_STRUCTURE_LOOSE_GRID);
        }
        variants++;
    }
    look(&q, &r, truth, &c);
    for (uint32_t kind = test_sample_start(number, step); kind < LIGHT_KINDS; kind += step) {
        const uint32_t way = number * LIGHT_KINDS + kind;
        place_light(&q, &r, &c, kind);
        vary_query(&q, &r, way);
        find_expected(&q, truth);
        for (uint32_t v = 0; v < variants; v++) {
            for (uint32_t k = 0; k < 2; k++) {
                if (!scene[v][k])
                    continue;
                const uint64_t tiles = check(&q, scene[v][k], &c, name[v], kind);
                if (k == 0 && tiles_are_required(&q, way, kind) && !tiles)
                    fail_msg("%s: no tiles: %u %s primitives of content %d, light %u; %u points, ranges %d, masks %d, "
                             "skips %d",
                             name[v], c.balls.count, c.name, (int)c.what, kind, q.count, q.ranges, q.masks, q.skips);
                sum->with_tiles += tiles != 0;
                sum->without += tiles == 0;
            }
        }
        sum->points += q.count;
        sum->occluded_points += q.by_rays.hits;
    }
    for (uint32_t v = 0; v < variants; v++)
        for (uint32_t k = 0; k < 2; k++)
            if (scene[v][k]) {
                cgt_scene_release(scene[v][k]);
                cgt_context_release(context[v][k]);
            }
    cgt_scene_release(truth);
    cgt_context_release(other);
    crowd_free(&c);
}

TEST(results_match_rays)
{
    const bool few = test_scaled(100) < 3;
    const uint32_t scenes = few ? 2 : test_between(5, 18), step = few         ? 5
                                                                  : is_slow() ? 3
                                                                              : 1; /* of 23 kinds of lights */
    tally sum = {0};
    for (uint32_t k = 0; k < scenes; k++)
        check_scene(scenes < 18 ? (test_sample_start(0, 18) + 5 * k) % 18 : k, step, &sum);
    print_message("%llu of %llu points in shadow; %llu calls with tiles, %llu without\n",
                  (unsigned long long)sum.occluded_points, (unsigned long long)sum.points,
                  (unsigned long long)sum.with_tiles, (unsigned long long)sum.without);
    assert_true(sum.occluded_points && sum.occluded_points < sum.points && sum.with_tiles);
    if (!is_slow()) { /* enough rounds to cover everything */
        assert_true(sum.occluded_points > sum.points / 20 && sum.occluded_points < sum.points - sum.points / 20);
        assert_true(sum.with_tiles > sum.without / 8 && sum.without > sum.with_tiles / 50);
    }
}

SEEDED_SUITE("test_light_tiles", NULL, NULL)
