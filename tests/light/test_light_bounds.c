/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The bounds of points against a light, tile by tile. Points whose rays pass corners, edges and silhouettes to within
 * rounding, or that lie on surfaces, get the same result as by exact decisions. Then the bounds are tightened until one
 * does not: the unit roundoff of the tests, and the margin of tiles. Half of the scenes are wide: one primitive lies
 * far beyond the others. Triangles with vertices in the light's plane, and of the least floats, show why the margin is
 * not 0 there. The kernel's sources are compiled into the test, where they take the place of the library's.
 * For the variant that this is compiled for. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"
#include "support/tightened.h"

static float filter_u = 0x1p-24f, margin_used = 0x1p-17f, underflow_used = 0x1p-100f;
#define FILTER_ROUNDOFF filter_u
#define LIGHT_MARGIN margin_used
#define LIGHT_UNDERFLOW underflow_used
#include "kernel/light/light_grid.c"
#include "kernel/light/light_read.c"

#define PRIMITIVES 240u
#define COPIES 16u /* of each point, up to rounding: they fill a group, whose slopes then nearly coincide */
#define POINTS (64u * COPIES)
#define SHRUNK 11u /* steps, each to a quarter of the previous bound, then one to 0 */

typedef enum content { SPHERES, SPECKS, TRIANGLES, CAPSULES, CONTENTS } content;

typedef struct subject {
    cgt_context *context;
    cgt_scene *tiles, *bvh, *exact; /* the same scene in three structures */
    cloud spheres;
    float (*corner)[9];
    float (*stick)[7]; /* ends and radius of capsules */
    content what;
    bool wide;  /* the first primitive is far away */
    bool aimed; /* the rays are parallel, from near the others to the first */
    cgt_light light;
    float at[3][POINTS];
    uint8_t expected[POINTS];
    uint64_t hidden;
} subject;

/* ---- scenes ---- */

static cgt_scene *commit(const subject *s, cgt_structure structure)
{
    const cgt_spheres spheres = spheres_of((const float(*)[4])s->spheres.sphere, PRIMITIVES);
    const cgt_triangles triangles = {
        .count = PRIMITIVES, .vertex_count = 3 * PRIMITIVES, .vertices = cgt_floats(s->corner[0], 0)};
    const cgt_capsules sticks = {.count = PRIMITIVES,
                                 .vertex_count = PRIMITIVES,
                                 .vertices = cgt_floats(s->stick[0], sizeof s->stick[0]),
                                 .ends = cgt_floats(s->stick[0] + 3, sizeof s->stick[0]),
                                 .radii = cgt_floats(s->stick[0] + 6, sizeof s->stick[0])};
    cgt_scene_options options;
    cgt_scene *scene;
    cgt_scene_options_init(&options);
    options.structure = structure;
    assert_int_equal(cgt_scene_create(s->context, &options, &scene), CGT_OK);
    if (s->what == TRIANGLES)
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    else if (s->what == CAPSULES)
        assert_int_equal(cgt_scene_set_capsules(scene, NULL, &sticks), CGT_OK);
    else
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* A capsule in place of a sphere: thin or thick, maybe without a length, a radius or either. */
static void make_stick(test_random *r, const subject *s, uint32_t i)
{
    const float *sphere = s->spheres.sphere[i];
    const float length = random_below(r, 8) ? sphere[3] * random_log(r, 0.1f, 4) : 0;
    float axis[3];
    random_direction(r, axis);
    for (int a = 0; a < 3; a++) {
        s->stick[i][a] = sphere[a] - length * axis[a];
        s->stick[i][3 + a] = sphere[a] + length * axis[a];
    }
    s->stick[i][6] = random_below(r, 8) ? sphere[3] * random_log(r, 1e-3f, 1) : 0;
}

static void subject_begin(test_random *r, content what, bool wide, subject *s)
{
    static const cloud_kind kinds[] = {CLOUD_UNIFORM, CLOUD_FAR, CLOUD_LATTICE};
    memset(s, 0, sizeof *s);
    s->context = context_make(1, CGT_VARIANT_NAME);
    s->spheres = cloud_make(r, kinds[random_below(r, TEST_COUNT(kinds))], PRIMITIVES);
    s->what = what;
    s->corner = malloc(PRIMITIVES * sizeof *s->corner);
    s->stick = malloc(PRIMITIVES * sizeof *s->stick);
    assert_non_null(s->corner);
    assert_non_null(s->stick);
    for (uint32_t i = 0; i < PRIMITIVES; i++) {
        float *sphere = s->spheres.sphere[i];
        for (int k = 0; k < 9; k++) /* some are neighbours that share an edge */
            s->corner[i][k] =
                i % 4 == 1 && k >= 3 ? s->corner[i - 1][k] : sphere[k % 3] + sphere[3] * random_float(r, -1, 1);
        make_stick(r, s, i);
        if (what == SPECKS) /* nearly points: their windows are mostly margin */
            sphere[3] = s->spheres.reach * 0x1p-23f;
    }
    s->wide = wide;
    if (wide) {
        static const float away[3] = {1, -0.75f, 0.5f};
        const float far = ldexpf(s->spheres.reach + fabsf(s->spheres.middle[0]), 3 + (int)random_below(r, 20));
        for (int a = 0; a < 3; a++)
            s->spheres.sphere[0][a] += away[a] * far;
        for (int k = 0; k < 9; k++)
            s->corner[0][k] += away[k % 3] * far;
        for (int k = 0; k < 6; k++)
            s->stick[0][k] += away[k % 3] * far;
    }
}

/* Commits it as three structures. */
static void subject_commit(subject *s)
{
    s->tiles = commit(s, CGT_STRUCTURE_LOOSE_GRID);
    s->bvh = commit(s, CGT_STRUCTURE_BVH);
    s->exact = commit(s, s->what == CAPSULES ? CGT_STRUCTURE_BVH : CGT_STRUCTURE_QUEUE_GRID);
}

static void subject_free(subject *s)
{
    cgt_scene_release(s->tiles);
    cgt_scene_release(s->bvh);
    cgt_scene_release(s->exact);
    cgt_context_release(s->context);
    cloud_free(&s->spheres);
    free(s->corner);
    free(s->stick);
}

/* ---- queries ---- */

/* From any side. Half of the lights are directional, with coordinates of few bits, so that rays pass exactly through
 * corners. */
static void place_light(test_random *r, subject *s)
{
    const float far = s->spheres.reach * (float[]){2.5f, 4, 10}[random_below(r, 3)];
    const uint32_t axis = random_below(r, 3);
    s->light.kind = random_below(r, 2) ? CGT_LIGHT_POINT : CGT_LIGHT_DIRECTIONAL;
    for (uint32_t a = 0; a < 3; a++) {
        const float share = a == axis ? (random_below(r, 2) ? 1.f : -1.f) : random_float(r, -0.4f, 0.4f);
        s->light.position[a] =
            s->light.kind == CGT_LIGHT_POINT ? s->spheres.middle[a] + share * far : rintf(share * 64) / 64;
    }
    s->aimed = s->wide && s->light.kind == CGT_LIGHT_DIRECTIONAL && random_below(r, 2);
    for (int a = 0; a < 3 && s->aimed; a++)
        s->light.position[a] = (s->what == TRIANGLES  ? s->corner[0][a]
                                : s->what == CAPSULES ? s->stick[0][a]
                                                      : s->spheres.sphere[0][a]) -
                               s->spheres.middle[a];
}

/* The direction from a point to the light. */
static void direction_to_light(const subject *s, const float at[3], float d[3])
{
    for (int a = 0; a < 3; a++)
        d[a] = s->light.kind == CGT_LIGHT_POINT ? s->light.position[a] - at[a] : s->light.position[a];
}

/* A point of a sphere's silhouette as seen from the light, or that of a capsule next to a point of its axis. */
static void silhouette_point(test_random *r, const subject *s, const float center[3], float radius, const float *axis,
                             float e[3])
{
    float d[3], side[3], across[3], length = 0, dd = 0, along = 0;
    direction_to_light(s, center, d);
    random_direction(r, side);
    for (int a = 0; a < 3 && axis; a++)
        side[a] = d[(a + 1) % 3] * axis[(a + 2) % 3] - d[(a + 2) % 3] * axis[(a + 1) % 3];
    for (int a = 0; a < 3; a++) {
        dd += d[a] * d[a];
        along += d[a] * side[a];
    }
    for (int a = 0; a < 3; a++) {
        across[a] = side[a] - along / dd * d[a];
        length += across[a] * across[a];
    }
    /* rays to a point light touch the sphere a little before its centre */
    const float ahead = s->light.kind == CGT_LIGHT_POINT ? radius * radius / dd : 0;
    const float offset = length > 0 ? radius * sqrtf(1 - ahead) / sqrtf(length) : 0;
    for (int a = 0; a < 3; a++)
        e[a] = center[a] + ahead * d[a] + offset * across[a];
}

/* A corner, a point of an edge, or one of a silhouette as seen from the light. */
static void hard_point(test_random *r, const subject *s, float e[3])
{
    const uint32_t i = s->aimed ? 0 : random_below(r, PRIMITIVES), k = random_below(r, 3);
    const float *sphere = s->spheres.sphere[i], *stick = s->stick[i];
    const float share = random_below(r, 2) ? random_float(r, 0, 1) : 0;
    float axis[3], center[3];
    if (s->what == TRIANGLES)
        for (uint32_t a = 0; a < 3; a++) {
            const float *from = &s->corner[i][3 * k], *to = &s->corner[i][3 * ((k + 1) % 3)];
            e[a] = from[a] + share * (to[a] - from[a]);
        }
    else if (s->what == CAPSULES) {
        for (int a = 0; a < 3; a++) {
            axis[a] = stick[3 + a] - stick[a];
            center[a] = stick[a] + share * axis[a];
        }
        silhouette_point(r, s, center, stick[6], share > 0 ? axis : NULL, e);
    } else
        silhouette_point(r, s, sphere, sphere[3], NULL, e);
}

static void place_points(test_random *r, subject *s)
{
    for (uint32_t i = 0; i < POINTS; i += COPIES) {
        float e[3], d[3];
        hard_point(r, s, e);
        direction_to_light(s, e, d);
        float away = (float[]){0, 0.25f, 0.5f, 1}[random_below(r, 4)];
        if (s->aimed)
            away = 1;
        else if (s->light.kind == CGT_LIGHT_DIRECTIONAL)
            away *= s->spheres.reach;
        for (uint32_t k = 0; k < COPIES; k++)
            for (int a = 0; a < 3; a++) {
                float p = e[a] - away * d[a];
                for (uint32_t n = random_below(r, 3); n; n--)
                    p = nextafterf(p, random_below(r, 2) ? INFINITY : -INFINITY);
                s->at[a][i + k] = p;
            }
    }
}

static void find_truth(subject *s)
{
    static float dir[3][POINTS], t_max[POINTS];
    cgt_trace_statistics statistics;
    cgt_trace_options options;
    for (uint32_t i = 0; i < POINTS; i++) {
        float d[3];
        direction_to_light(s, (const float[]){s->at[0][i], s->at[1][i], s->at[2][i]}, d);
        for (int a = 0; a < 3; a++)
            dir[a][i] = d[a];
        t_max[i] = s->light.kind == CGT_LIGHT_POINT ? 1 : INFINITY;
    }
    const cgt_rays rays = {
        .count = POINTS, .org = {s->at[0], s->at[1], s->at[2]}, .dir = {dir[0], dir[1], dir[2]}, .t_max = t_max};
    cgt_trace_options_init(&options);
    options.precision = CGT_PRECISION_EXACT;
    options.statistics = &statistics;
    assert_int_equal(cgt_occluded_rays(s->exact, &rays, s->expected, &options), CGT_OK);
    s->hidden = statistics.hits;
}

/* ---- tests ---- */

typedef struct tally {
    uint64_t lost, invented;
} tally;

static void add_wrong(const subject *s, const cgt_scene *scene, tally *sum)
{
    static uint8_t got[POINTS];
    const cgt_points points = {.count = POINTS, .position = {s->at[0], s->at[1], s->at[2]}};
    const bool report = filter_u == 0x1p-24f && margin_used == 0x1p-17f && underflow_used == 0x1p-100f;
    cgt_trace_statistics statistics;
    cgt_trace_options options;
    cgt_trace_options_init(&options);
    options.statistics = &statistics;
    memset(got, 7, sizeof got);
    assert_int_equal(cgt_occluded_points(scene, &s->light, &points, got, &options), CGT_OK);
    assert_true(scene == s->tiles ? statistics.tiles > 0 : statistics.bvh_rays > 0);
    for (uint32_t i = 0; i < POINTS; i++) {
        assert_true(got[i] < 2);
        sum->lost += s->expected[i] > got[i];
        sum->invented += s->expected[i] < got[i];
        if (report && s->expected[i] != got[i] && sum->lost + sum->invented < 4)
            print_message("%s, content %d, light %a %a %a, kind %d: point %a %a %a is %s\n",
                          scene == s->tiles ? "tiles" : "BVH", (int)s->what, (double)s->light.position[0],
                          (double)s->light.position[1], (double)s->light.position[2], (int)s->light.kind,
                          (double)s->at[0][i], (double)s->at[1][i], (double)s->at[2][i],
                          got[i] ? "in the light" : "in shadow");
    }
}

/* Tightens each bound separately: tallies of the roundoff (0) and of the margin (1), for each step. */
static void tighten(test_random *r, content what, bool wide, bool shrink, tally sum[2][SHRUNK + 2], uint64_t *hidden)
{
    static subject s;
    const uint32_t stride = test_samples() ? 3 : 1; /* reaches the last step, too */
    subject_begin(r, what, wide, &s);
    subject_commit(&s);
    for (uint32_t k = 0; k < 4; k++) {
        place_light(r, &s);
        place_points(r, &s);
        find_truth(&s);
        *hidden += s.hidden;
        add_wrong(&s, s.bvh, &sum[0][0]);
        for (uint32_t bound = 0; bound < 2; bound++)
            for (uint32_t step = 0; step < (shrink ? SHRUNK + 2 : 1 - bound); step += stride) {
                const float factor = step > SHRUNK ? 0 : ldexpf(1, -2 * (int)step);
                *(bound ? &margin_used : &filter_u) *= factor;
                add_wrong(&s, s.tiles, &sum[bound][step]);
                filter_u = 0x1p-24f;
                margin_used = 0x1p-17f;
            }
    }
    subject_free(&s);
}

TEST(bounds_hold)
{
    const uint32_t turns = 2 + test_scaled(100);
    for (int what = 0; what < CONTENTS; what++) {
        test_random r = random_make(800 + (uint64_t)what);
        tally sum[2][SHRUNK + 2] = {{{0}}};
        uint64_t hidden = 0;
        for (uint32_t turn = 0; turn < turns; turn++)
            tighten(&r, (content)what, turn % 2, false, sum, &hidden);
        print_message("content %d: %llu of %llu in shadow\n", what, (unsigned long long)hidden, 4ull * turns * POINTS);
        assert_true(hidden > turns && hidden < 4ull * turns * POINTS);
        assert_int_equal(sum[0][0].lost, 0);
        assert_int_equal(sum[0][0].invented, 0);
    }
}

/* The first step with a wrong answer. */
static uint32_t first_wrong(const tally *sum, bool invented)
{
    uint32_t step = 0;
    while (step < SHRUNK + 2 && !(invented ? sum[step].invented : sum[step].lost))
        step++;
    return step;
}

static void break_bounds(bool wide)
{
    uint32_t of_margin = SHRUNK + 2;
    for (int what = 0; what < CONTENTS; what++) {
        test_random r = random_make(850 + (uint64_t)what);
        tally sum[2][SHRUNK + 2] = {{{0}}};
        uint64_t hidden = 0;
        for (uint32_t turn = 1 + test_scaled(5); turn; turn--)
            tighten(&r, (content)what, wide, true, sum, &hidden);
        const uint32_t lost = first_wrong(sum[0], false), invented = first_wrong(sum[0], true);
        const uint32_t missed = first_wrong(sum[1], false);
        print_message("content %d%s: the roundoff loses at 4^-%u and invents at 4^-%u, the margin loses at 4^-%u\n",
                      what, wide ? ", wide" : "", lost, invented, missed);
        of_margin = missed < of_margin ? missed : of_margin;
        for (int bound = 0; bound < 2; bound++)
            assert_true(sum[bound][0].lost + sum[bound][0].invented == 0);
        assert_int_equal(first_wrong(sum[1], true), SHRUNK + 2); /* a smaller margin cannot invent occlusion */
        assert_true(lost < SHRUNK + 2 && (what == SPECKS || invented < SHRUNK + 2));
    }
    assert_true(of_margin > 0 && of_margin < SHRUNK + 2);
}

TEST(bounds_break_where_they_are_tightened)
{
    break_bounds(false);
    break_bounds(true);
}

/* ---- beside the light, and next to the end of float ---- */

/* Blades from the plane across the rays that the light is in: of some vertices the reciprocal overflows. */
static void make_blades(test_random *r, subject *s)
{
    const int axis = (int)random_below(r, 3);
    const float forward = random_below(r, 2) ? 1.f : -1.f;
    s->light.kind = CGT_LIGHT_POINT;
    for (int a = 0; a < 3; a++)
        s->light.position[a] = a == axis ? 0 : random_float(r, -0.5f, 0.5f);
    for (uint32_t i = 0; i < PRIMITIVES; i++) {
        const float beside[] = {0, 0x1p-149f, 0x1p-140f, 0x1p-128f, -0x1p-140f, random_log(r, 1e-37f, 1e-3f)};
        const uint32_t first = random_below(r, 3);
        for (uint32_t k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++) {
                const float w = k ? random_float(r, 0.5f, 1) : beside[random_below(r, TEST_COUNT(beside))];
                const float v = k == 2
                                    ? s->corner[i][3 * ((first + 1) % 3) + (uint32_t)a] + random_float(r, -0.02f, 0.02f)
                                    : random_float(r, -1, 1);
                s->corner[i][3 * ((first + k) % 3) + (uint32_t)a] = a == axis ? forward * w : v;
            }
    }
}

/* Triangles of a few of the least floats, in a scene of usual size. */
static void make_motes(test_random *r, subject *s)
{
    s->light.kind = CGT_LIGHT_DIRECTIONAL;
    for (int a = 0; a < 3; a++)
        s->light.position[a] = (float)(2 * (int)random_below(r, 8) - 7) / 8; /* products lie between two floats */
    s->light.position[random_below(r, 3)] = random_below(r, 2) ? 1 : -1;
    for (uint32_t i = 1; i < PRIMITIVES; i++) {
        int place[3];
        for (int a = 0; a < 3; a++)
            place[a] = (int)random_below(r, 129) - 64;
        for (int k = 0; k < 9; k++)
            s->corner[i][k] = (float)(place[k % 3] + (int)random_below(r, 13)) * 0x1p-149f;
    }
}

static void place_motes(test_random *r, subject *s)
{
    for (uint32_t i = 0; i < POINTS; i++) {
        const float *e = &s->corner[1 + random_below(r, PRIMITIVES - 1)][3 * random_below(r, 3)];
        const float away = (float)random_below(r, 4) * 8 * 0x1p-149f;
        for (int a = 0; a < 3; a++)
            s->at[a][i] = e[a] - away * s->light.position[a];
    }
}

/* Blades or motes: what is wrong at the shipped bounds, and with neither margin nor underflow. */
static void judge_extremes(test_random *r, bool blades, tally sum[2])
{
    for (uint32_t turn = 3 + test_scaled(47); turn; turn--) {
        static subject s;
        subject_begin(r, TRIANGLES, false, &s);
        if (blades)
            make_blades(r, &s);
        else
            make_motes(r, &s);
        subject_commit(&s);
        if (blades)
            place_points(r, &s);
        else
            place_motes(r, &s);
        find_truth(&s);
        add_wrong(&s, s.tiles, &sum[0]);
        add_wrong(&s, s.bvh, &sum[0]);
        margin_used = blades ? 0 : margin_used;
        underflow_used = 0;
        add_wrong(&s, s.tiles, &sum[1]);
        margin_used = 0x1p-17f;
        underflow_used = 0x1p-100f;
        subject_free(&s);
    }
    print_message("without them, %llu are lost\n", (unsigned long long)sum[1].lost);
    assert_int_equal(sum[0].lost + sum[0].invented, 0);
}

TEST(vertices_in_the_plane_of_the_light)
{
    test_random r = random_make(870);
    tally sum[2] = {{0}};
    judge_extremes(&r, true, sum);
    assert_true(sum[1].lost > 0);
}

TEST(products_that_underflow)
{
    test_random r = random_make(880);
    tally sum[2] = {{0}};
    judge_extremes(&r, false, sum);
    /* a fused difference is rounded once, alike for a point and for what its ray touches */
    const vfloat factor = spux_vfloat(1 + 0x1p-12f), square = spux_vfloat(1 + 0x1p-11f);
    const bool is_fused = spux_hmax(spux_abs(spu_nmsub(factor, factor, square))) > 0;
    assert_true(is_fused || sum[1].lost > 0);
}

/* ---- boxes of cells ---- */

/* The least float of at least x, the largest of at most x. */
static float round_up(double x) { return (double)(float)x < x ? nextafterf((float)x, INFINITY) : (float)x; }
static float round_down(double x) { return -round_up(-x); }

/* A cell of any level, and a tile of rays along an axis that its box, in exact arithmetic, touches on all sides. */
static void make_cell(test_random *r, cgt_loose_grid *grid, tile_march *m, tile_slice *s, light_tile *t)
{
    cgt_loose_level *l = &grid->level[0];
    uint32_t at[3];
    double low[3], high[3];
    light_packet *p = &t->packet[0];
    for (int a = 0; a < 3; a++) {
        l->size[a] = 1 + random_below(r, random_below(r, 2) ? 1024 : 4);
        l->cell[a] = random_log(r, 1e-3f, 1e3f);
        l->low[a] = -random_float(r, -0.1f, 1.1f) * (float)l->size[a] * l->cell[a];
        l->reach[a] = random_below(r, 2) ? l->cell[a] * random_float(r, 0, 2) : 0;
        at[a] = random_below(r, l->size[a]);
        low[a] = (double)l->low[a] + at[a] * (double)l->cell[a] - (double)l->reach[a];
        high[a] = low[a] + (double)l->cell[a] + 2 * (double)l->reach[a];
    }
    p->axis[0] = (int)random_below(r, 3);
    p->axis[1] = (p->axis[0] + 1) % 3;
    p->axis[2] = (p->axis[0] + 2) % 3;
    p->sign = random_below(r, 2) ? 1.f : -1.f;
    t->far_w = round_up(p->sign > 0 ? low[p->axis[0]] : -high[p->axis[0]]);
    for (int a = 0; a < 2; a++) {
        t->lower[a] = round_down(high[p->axis[a + 1]]);
        t->upper[a] = round_up(low[p->axis[a + 1]]);
    }
    m->grid = grid;
    m->w = (uint32_t)p->axis[0];
    m->u = m->w == 0 ? 1 : 0;
    m->v = m->w == 2 ? 1 : 2;
    *s = (tile_slice){.cell = at[m->w], .low = {at[m->u], at[m->v]}, .high = {at[m->u], at[m->v]}};
}

/* Without the tile's margin: what a cell's box is widened by is enough for its own rounding. */
TEST(cells_break_where_they_are_tightened)
{
    static light_tile t;
    static cgt_loose_grid grid;
    test_random r = random_make(890);
    uint64_t lost[STEPS] = {0};
    for (uint32_t i = 0; i < LIGHT_PARTS * LIGHT_PARTS; i++)
        t.table.far[i] = INFINITY;
    for (uint32_t k = 300 + test_scaled(20700); k; k--) {
        tile_march m = {0};
        tile_slice s;
        make_cell(&r, &grid, &m, &s, &t);
        for (int step = 0; step < bound_steps(); step++) {
            light_slice l;
            light_cells cells;
            filter_u = 0x1p-24f * exp2f(-0.5f * (float)step);
            light_slice_init(&m, &s, &l);
            light_place_cells(&s, &l, 0, &cells);
            lost[step] += !(light_visible_cells(&t, &l, &cells) & 1);
        }
        filter_u = 0x1p-24f;
    }
    check_break("a cell left out", lost, sizeof *lost, 0, 0);
}

VARIANT_SUITE("test_light_bounds", NULL, NULL)
