/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points inside meshes and spheres, on their surfaces too, through every structure, variant and number of threads. */
#include <cgt/all_hits.h>

#include <stdlib.h>
#include <string.h>

#include "all_hits/crossing_cases.h"
#include "support/scenes.h"
#include "support/suite.h"

#define POINTS 343u

static cgt_points points_of(float (*point)[3], uint32_t count)
{
    return (cgt_points){
        .count = count, .stride = sizeof *point, .position = {&point[0][0], &point[0][1], &point[0][2]}};
}

static uint32_t add_mesh(cgt_scene *scene, const float (*corner)[3], uint32_t triangles, uint32_t mask)
{
    const cgt_triangles t = {
        .count = triangles, .vertices = cgt_floats(corner[0], 0), .vertex_count = 3 * triangles, .mask = mask};
    uint32_t id = CGT_INVALID_ID;
    assert_int_equal(cgt_scene_set_triangles(scene, &id, &t), CGT_OK);
    return id;
}

static cgt_scene *scene_make(cgt_context *context, const test_way *way)
{
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, SCENE_OPTIONS(&way->scene), &scene), CGT_OK);
    return scene;
}

static void ask(const cgt_scene *scene, const cgt_points *points, cgt_inside_rule rule, uint8_t *inside)
{
    const cgt_inside_options how = {.rule = rule};
    memset(inside, 0x77, points->count);
    assert_int_equal(cgt_points_inside(scene, points, &how, inside, NULL), CGT_OK);
}

/* ---- cells that fill a cube ---- */

#define CELLS 48u

typedef float tetrahedron[12][3];

/* Kuhn's division: in each unit cube of a cube of edge 2, a tetrahedron for each order of the axes. All are oriented
 * outwards. */
static void make_cells(tetrahedron cell[CELLS])
{
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    static const int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    for (uint32_t c = 0; c < CELLS; c++) {
        const int *axes = order[c % 6];
        const bool even = (axes[1] - axes[0] + 3) % 3 == 1;
        float corner[4][3];
        for (int a = 0; a < 3; a++)
            corner[0][a] = (float)(c / 6 >> a & 1);
        for (int k = 1; k < 4; k++) {
            memcpy(corner[k], corner[k - 1], sizeof corner[k]);
            corner[k][axes[k - 1]] += 1;
        }
        for (int f = 0; f < 4; f++)
            for (int k = 0; k < 3; k++)
                memcpy(cell[c][3 * f + k], corner[face[f][even ? k : 2 - k]], sizeof corner[0]);
    }
}

/* Half units, from -1/2 to 5/2: on faces, edges and vertices of cells, and between. */
static void make_lattice(float point[POINTS][3])
{
    for (uint32_t i = 0; i < POINTS; i++) {
        point[i][0] = (float)(i % 7) / 2 - 0.5f;
        point[i][1] = (float)(i / 7 % 7) / 2 - 0.5f;
        point[i][2] = (float)(i / 49) / 2 - 0.5f;
    }
}

/* Moved by (h^4, h^5, h^6), a point of the lower faces is in the cube, one of the upper faces is not. */
static bool is_in_cube(const float p[3])
{
    return p[0] >= 0 && p[0] < 2 && p[1] >= 0 && p[1] < 2 && p[2] >= 0 && p[2] < 2;
}

TEST(a_point_is_in_one_cell)
{
    static tetrahedron cell[CELLS];
    float point[POINTS][3];
    uint8_t inside[POINTS];
    unsigned cells[POINTS] = {0};
    cgt_context *context = context_make(1, NULL);
    const cgt_points points = points_of(point, POINTS);
    make_cells(cell);
    make_lattice(point);
    for (uint32_t c = 0; c < CELLS; c++) {
        cgt_scene *scene = scene_make(context, way_in_turn(WAY_EACH, c));
        add_mesh(scene, cell[c], 4, 0);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        ask(scene, &points, (cgt_inside_rule)(c / 2 % 2), inside);
        for (uint32_t i = 0; i < POINTS; i++)
            cells[i] += inside[i];
        cgt_scene_release(scene);
    }
    for (uint32_t i = 0; i < POINTS; i++)
        assert_int_equal(cells[i], is_in_cube(point[i]));
    cgt_context_release(context);
}

/* As geometries, and as one: their common faces cancel. */
TEST(cells_together_are_the_cube)
{
    static tetrahedron cell[CELLS];
    float point[POINTS][3];
    uint8_t inside[POINTS];
    cgt_context *context = context_make(2, NULL);
    const cgt_points points = points_of(point, POINTS);
    make_cells(cell);
    make_lattice(point);
    for (uint32_t turn = 0; turn < 4 * TEST_STRUCTURES; turn++) {
        cgt_scene *scene = scene_make(context, way_in_turn(WAY_EACH, turn / 4));
        for (uint32_t c = 0; c < (turn & 1 ? CELLS : 1); c++)
            add_mesh(scene, cell[c], turn & 1 ? 4 : 4 * CELLS, 0);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        ask(scene, &points, turn & 2 ? CGT_INSIDE_WINDING : CGT_INSIDE_PARITY, inside);
        for (uint32_t i = 0; i < POINTS; i++)
            assert_int_equal(inside[i], is_in_cube(point[i]));
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

/* One more geometry than a ray sums up: cells side by side. */
TEST(many_geometries)
{
    enum { MANY = (1 << 16) + 1 };
    static tetrahedron cell[CELLS];
    float point[4][3];
    uint8_t inside[4];
    tetrahedron *many = malloc(MANY * sizeof *many);
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_make(context, way_in_turn(WAY_CHOSEN, 0));
    const cgt_points points = points_of(point, 4);
    assert_non_null(many);
    make_cells(cell);
    for (uint32_t i = 0; i < MANY; i++) {
        for (uint32_t k = 0; k < 36; k++)
            many[i][k / 3][k % 3] = cell[0][k / 3][k % 3] + (float)(k % 3 ? i / 256 * (k % 3 == 1) : i % 256);
        add_mesh(scene, many[i], 4, 0);
    }
    for (uint32_t k = 0; k < 4; k++) /* the centres of the first cell and the last one, and beside them */
        for (int a = 0; a < 3; a++) {
            const tetrahedron *at = &many[k & 1 ? MANY - 1 : 0];
            point[k][a] = ((*at)[0][a] + (*at)[1][a] + (*at)[2][a] + (*at)[3][a]) / 4 + (k & 2 && a == 2 ? 2 : 0);
        }
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    ask(scene, &points, CGT_INSIDE_WINDING, inside);
    for (uint32_t k = 0; k < 4; k++)
        assert_int_equal(inside[k], k < 2);
    cgt_scene_release(scene);
    cgt_context_release(context);
    free(many);
}

/* ---- spheres, meshes and masks ---- */

#define BALLS 40u
#define MESHES 2u

/* Whole numbers, and what the scene gets: these times a power of two. */
typedef struct mixed_world {
    float ball[BALLS][4], scaled_ball[BALLS][4];
    crossing_mesh mesh[MESHES];
    float (*corner[MESHES])[3];
    uint32_t mask[MESHES + 2]; /* of meshes, and of the two halves of the balls */
    float point[POINTS][3], scaled_point[POINTS][3];
    uint32_t point_mask[POINTS][3];
    int winding[POINTS][MESHES];
} mixed_world;

static void world_make(mixed_world *w, int exponent, test_random *r)
{
    for (uint32_t i = 0; i < 4 * BALLS; i++) {
        const float number = i % 4 < 3 ? (float)random_below(r, 25) - 12 : (float)random_below(r, 4);
        w->ball[i / 4][i % 4] = number;
        w->scaled_ball[i / 4][i % 4] = ldexpf(number, exponent);
    }
    for (uint32_t m = 0; m < MESHES; m++) {
        crossing_mesh *mesh = &w->mesh[m];
        assert_true(crossing_mesh_make(mesh, (closed_kind)random_below(r, CLOSED_KINDS), CROSSING_COARSE, r));
        w->corner[m] = malloc(3 * mesh->triangles * sizeof *w->corner[m]);
        assert_non_null(w->corner[m]);
        for (uint32_t i = 0; i < 9 * mesh->triangles; i++)
            w->corner[m][i / 3][i % 3] = ldexpf((float)mesh->corner[i / 9][i / 3 % 3][i % 3], exponent);
    }
    for (uint32_t m = 0; m < MESHES + 2; m++)
        w->mask[m] = 1 + random_below(r, 3);
    for (uint32_t i = 0; i < POINTS; i++) {
        int at[3];
        for (int a = 0; a < 3; a++) {
            at[a] = (int)random_below(r, 27) - 13;
            w->point[i][a] = (float)at[a];
            w->scaled_point[i][a] = ldexpf((float)at[a], exponent);
        }
        w->point_mask[i][0] = random_below(r, 4);
        for (uint32_t m = 0; m < MESHES; m++)
            assert_true(crossing_winding(&w->mesh[m], at, r, &w->winding[i][m]));
    }
}

static void world_free(mixed_world *w)
{
    for (uint32_t m = 0; m < MESHES; m++) {
        crossing_mesh_free(&w->mesh[m]);
        free(w->corner[m]);
    }
}

/* Whether a point moved by (h^4, h^5, h^6) is in a sphere; all are whole numbers. */
static bool is_in_ball(const float ball[4], const float p[3])
{
    const float c[3] = {ball[0] - p[0], ball[1] - p[1], ball[2] - p[2]};
    const float power = c[0] * c[0] + c[1] * c[1] + c[2] * c[2] - ball[3] * ball[3];
    if (power != 0)
        return power < 0;
    return c[0] != 0 ? c[0] > 0 : c[1] != 0 ? c[1] > 0 : c[2] > 0;
}

static bool is_inside_world(const mixed_world *w, uint32_t i, cgt_inside_rule rule)
{
    const uint32_t mask = w->point_mask[i][0] ? w->point_mask[i][0] : UINT32_MAX;
    bool inside = false;
    for (uint32_t m = 0; m < MESHES; m++)
        inside |= (w->mask[m] & mask) && (rule == CGT_INSIDE_PARITY ? w->winding[i][m] % 2 : w->winding[i][m]);
    for (uint32_t b = 0; b < BALLS; b++)
        inside |= (w->mask[MESHES + (b >= BALLS / 2)] & mask) && is_in_ball(w->ball[b], w->point[i]);
    return inside;
}

/* stray: a sphere so far out that the scene is cut into bands. */
static cgt_scene *scene_of_world(cgt_context *context, const test_way *way, const mixed_world *w, bool stray)
{
    static const float far_out[1][4] = {{0x1p90f, 0, 0, 1}};
    cgt_scene *scene = scene_make(context, way);
    for (uint32_t m = 0; m < MESHES; m++)
        add_mesh(scene, w->corner[m], w->mesh[m].triangles, w->mask[m]);
    for (uint32_t k = 0; k < 2; k++) {
        cgt_spheres half = spheres_of(w->scaled_ball + k * BALLS / 2, BALLS / 2);
        half.mask = w->mask[MESHES + k];
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &half), CGT_OK);
    }
    const cgt_spheres one = spheres_of(far_out, 1);
    if (stray)
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &one), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* Returns how many are inside. */
static uint32_t check_world(const cgt_scene *scene, mixed_world *w, const test_way *way, cgt_inside_rule rule)
{
    uint8_t inside[POINTS];
    uint32_t found = 0;
    cgt_points points = points_of(w->scaled_point, POINTS);
    points.mask = w->point_mask[0];
    ask(scene, &points, rule, inside);
    for (uint32_t i = 0; i < POINTS; i++) {
        const bool want = is_inside_world(w, i, rule);
        found += want;
        if (inside[i] != want)
            fail_msg("%s, rule %d: point %u at %g, %g, %g: %u, not %d", way->name, (int)rule, i, (double)w->point[i][0],
                     (double)w->point[i][1], (double)w->point[i][2], inside[i], want);
    }
    return found;
}

TEST(spheres_and_meshes_by_masks)
{
    static mixed_world w;
    const uint32_t cases = test_between(24, 60);
    uint32_t found = 0;
    test_random r = random_make(441);
    if (!CROSSING_JUDGE)
        return;
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1 + random_below(&r, 2), variant);
        for (uint32_t i = 0; i < cases; i++) {
            const test_way *way = way_in_turn(i % 2 ? WAY_EACH : WAY_CHOSEN, i / 2);
            world_make(&w, i % 4 ? 0 : i % 8 ? -140 : 80, &r);
            cgt_scene *scene = scene_of_world(context, way, &w, i % 5 == 0);
            for (int rule = 0; rule < 2; rule++)
                found += check_world(scene, &w, way, (cgt_inside_rule)rule);
            cgt_scene_release(scene);
            world_free(&w);
        }
        cgt_context_release(context);
    }
    assert_true(found > cases * POINTS / 8);
}

/* ---- what has no inside ---- */

/* Triangles that close nothing: any answer, but one. */
TEST(open_meshes_give_one_answer)
{
    enum { TRIANGLES = 300 };
    static float corner[3 * TRIANGLES][3], point[POINTS][3];
    uint8_t first[POINTS], inside[POINTS];
    uint32_t scenes = 0, found = 0;
    test_random r = random_make(442);
    for (uint32_t i = 0; i < 9 * TRIANGLES; i++)
        corner[i / 3][i % 3] = random_float(&r, -1, 1);
    for (uint32_t i = 0; i < 3 * POINTS; i++)
        point[i / 3][i % 3] = random_float(&r, -1, 1);
    const cgt_points points = points_of(point, POINTS);
    FOR_EACH_VARIANT(variant)
    {
        cgt_context *context = context_make(1 + scenes % 3, variant);
        FOR_EACH_WAY(way, WAY_EACH)
        {
            cgt_scene *scene = scene_make(context, way);
            add_mesh(scene, corner, TRIANGLES, 0);
            assert_int_equal(cgt_scene_commit(scene), CGT_OK);
            ask(scene, &points, CGT_INSIDE_WINDING, scenes++ ? inside : first);
            if (scenes > 1)
                assert_memory_equal(inside, first, POINTS);
            cgt_scene_release(scene);
        }
        cgt_context_release(context);
    }
    for (uint32_t i = 0; i < POINTS; i++)
        found += first[i];
    assert_true(found > POINTS / 4 && found < POINTS);
}

TEST(points_that_are_none)
{
    static const float ball[1][4] = {{0, 0, 0, 1}};
    float point[4][3] = {{0, 0, 0}, {NAN, 0, 0}, {0, INFINITY, 0}, {0, 0, 3}};
    uint8_t inside[4];
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = scene_of(context, NULL, ball, 1);
    cgt_trace_statistics statistics;
    const cgt_trace_options options = {.statistics = &statistics};
    const cgt_points points = points_of(point, 4);
    assert_int_equal(cgt_points_inside(scene, &points, NULL, inside, &options), CGT_OK);
    assert_int_equal(inside[0], 1);
    for (int i = 1; i < 4; i++)
        assert_int_equal(inside[i], 0);
    assert_int_equal(statistics.rays, 4);
    assert_int_equal(statistics.invalid_rays, 2);
    assert_int_equal(statistics.hits, 1);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

/* ---- crossings of spheres ---- */

/* In and out; not where a ray touches a sphere, or a point; from the surface, which the moved origin is off. */
TEST(spheres_are_crossed_twice_or_not)
{
    static const float ball[2][4] = {{0, 0, 0, 5}, {0, 0, 20, 0}};
    static const struct {
        float org[3], dir[3];
        uint32_t count, surface[2];
    } row[] = {
        {{0, 0, -9}, {0, 0, 1}, 2, {CGT_SURFACE_NEAR, CGT_SURFACE_FAR}},
        {{0, 0, 9}, {0, 0, 1}, 0, {0}},  /* a point */
        {{5, 0, -9}, {0, 0, 1}, 0, {0}}, /* touches */
        {{3, 4, -9}, {0, 0, 1}, 0, {0}},
        {{3, 0, -9}, {0, 0, 1}, 2, {CGT_SURFACE_NEAR, CGT_SURFACE_FAR}},
        {{1, 1, 1}, {1, 2, 3}, 1, {CGT_SURFACE_FAR}},
        {{-5, 0, 0}, {1, 0, 0}, 1, {CGT_SURFACE_FAR}}, /* from the side that is moved into the sphere */
        {{-5, 0, 0}, {-1, 0, 0}, 1, {CGT_SURFACE_FAR}},
        {{5, 0, 0}, {1, 0, 0}, 0, {0}}, /* from the side that is moved out of it */
        {{5, 0, 0}, {-1, 0, 0}, 2, {CGT_SURFACE_NEAR, CGT_SURFACE_FAR}},
        {{0, -5, 0}, {0, 1, 0}, 1, {CGT_SURFACE_FAR}},
        {{0, 0, 5}, {0, 0, -1}, 2, {CGT_SURFACE_NEAR, CGT_SURFACE_FAR}},
        {{0, 0, 5}, {1, 0, 0}, 0, {0}}, /* touches there, moved out of it */
        {{0, 0, -5}, {1, 0, 0}, 1, {CGT_SURFACE_FAR}},
        {{0, -3, -4}, {0, 4, -3}, 1, {CGT_SURFACE_FAR}},
    };
    static const cgt_all_hits_options all = {.crossings = true};
    cgt_context *context = context_make(1, NULL);
    FOR_EACH_WAY(way, WAY_EACH)
    {
        cgt_scene *scene = scene_of(context, SCENE_OPTIONS(&way->scene), ball, 2);
        for (size_t i = 0; i < TEST_COUNT(row); i++) {
            cgt_single_ray ray = {.t_max = 0};
            cgt_hit hit[3];
            uint32_t count;
            memcpy(ray.org, row[i].org, sizeof ray.org);
            memcpy(ray.dir, row[i].dir, sizeof ray.dir);
            assert_int_equal(cgt_trace_all_ray(scene, &ray, &all, hit, 3, &count, NULL, NULL), CGT_OK);
            if (count != row[i].count)
                fail_msg("%s, ray %zu: %u crossings, not %u", way->name, i, count, row[i].count);
            for (uint32_t k = 0; k < count; k++)
                assert_int_equal(hit[k].surface, row[i].surface[k]);
        }
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
}

SEEDED_SUITE("test_points_inside", NULL, NULL)
