/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points that skip primitives, and groups some of whose rays are occluded before the others. Each point has a column of
 * its own towards the light, with up to two primitives of two geometries in it and nothing of its neighbours, so that
 * what it meets is known without another structure. Vectors of rays whose ids are read together (ray_packet.h) name one
 * geometry; others name several, numbers that no geometry has, or none. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/scenes.h"
#include "support/suite.h"

#define SIDE 96u /* columns along each axis: more than 8192 primitives are sorted, fewer are not */
#define SMALL_SIDE 40u
#define MOST (SIDE * SIDE)
#define HEIGHT 4096.f /* of a point light, in spacings: neighbours' rays stay apart */
#define RADIUS 0.25f

/* Geometry 0 has spheres, geometry 1 spheres or triangles, each for some of the columns, in any order. */
typedef struct columns {
    uint32_t side, count;
    cgt_light light;
    bool with_triangles;
    uint32_t number[2][MOST]; /* of column k's primitive in each geometry; CGT_INVALID_ID: it has none */
    uint32_t prims[2];
    float sphere[2][MOST][4], corner[MOST][9];
    float at[3][MOST];
    uint32_t primitive[MOST], geometry[MOST]; /* that points skip */
    uint8_t got[MOST + 1], expected[MOST];
} columns;

/* The place of a column's primitive. */
static void place(const columns *c, uint32_t column, uint32_t geometry, float to[3])
{
    const float share = 0.0005f * (float)(1 + geometry), height = 2 * (float)(1 + geometry);
    for (int a = 0; a < 3; a++)
        to[a] = c->light.kind == CGT_LIGHT_POINT ? c->at[a][column] + share * (c->light.position[a] - c->at[a][column])
                                                 : c->at[a][column] + (a == 2 ? height : 0);
}

static void add_primitive(columns *c, test_random *r, uint32_t column, uint32_t geometry)
{
    static const float corners[3][2] = {{-RADIUS, -RADIUS}, {RADIUS, -RADIUS}, {0, RADIUS}};
    const uint32_t number = c->prims[geometry]++;
    float middle[3];
    place(c, column, geometry, middle);
    c->number[geometry][column] = number;
    for (int a = 0; a < 3; a++)
        c->sphere[geometry][number][a] = middle[a];
    c->sphere[geometry][number][3] = RADIUS * random_float(r, 0.5f, 1);
    for (int k = 0; k < 9 && geometry; k++)
        c->corner[number][k] = middle[k % 3] + (k % 3 < 2 ? corners[k / 3][k % 3] : 0);
}

/* Of 256 columns 64 are full, so that their vectors are occluded at once, and the others have gaps. */
static void make_columns(columns *c, test_random *r, uint32_t side, bool is_point, bool with_triangles)
{
    c->side = side;
    c->count = side * side;
    c->with_triangles = with_triangles;
    c->prims[0] = c->prims[1] = 0;
    c->light = (cgt_light){.kind = is_point ? CGT_LIGHT_POINT : CGT_LIGHT_DIRECTIONAL,
                           .position = {0, 0, is_point ? HEIGHT : 1}};
    for (uint32_t k = 0; k < c->count; k++) {
        c->at[0][k] = (float)(k % side) - 0.5f * (float)side;
        c->at[1][k] = (float)(k / side) - 0.5f * (float)side;
        c->at[2][k] = 0;
        c->number[0][k] = c->number[1][k] = CGT_INVALID_ID;
    }
    /* numbers run backwards in one geometry: they are no columns' */
    for (uint32_t k = 0; k < c->count; k++)
        if (k / 64 % 4 == 0 || random_below(r, 8))
            add_primitive(c, r, c->count - 1 - k, 0);
    for (uint32_t k = 0; k < c->count; k++)
        if (k / 64 % 4 && random_below(r, 2))
            add_primitive(c, r, k, 1);
}

static cgt_scene *commit(cgt_context *context, const columns *c, cgt_structure structure)
{
    const cgt_spheres first = spheres_of(c->sphere[0], c->prims[0]), second = spheres_of(c->sphere[1], c->prims[1]);
    const cgt_triangles triangles = {
        .count = c->prims[1], .vertex_count = 3 * c->prims[1], .vertices = cgt_floats(c->corner[0], 0)};
    cgt_scene_options options;
    cgt_scene *scene;
    cgt_scene_options_init(&options);
    options.structure = structure;
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &first), CGT_OK);
    if (c->with_triangles)
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    else
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &second), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* What points skip. */
typedef enum skip_kind {
    SKIP_OWN,     /* their column's of geometry 0 */
    SKIP_OTHER,   /* their column's of geometry 1 */
    SKIP_SOME,    /* either, a neighbour's or none, by turns of 64 points: vectors of one geometry */
    SKIP_ANY,     /* the same point by point */
    SKIP_UNKNOWN, /* numbers and geometries that there are none of, among others */
    SKIP_KINDS
} skip_kind;

static void set_skip(columns *c, test_random *r, skip_kind kind, uint32_t k)
{
    const uint32_t turn = kind == SKIP_SOME ? k / 64 : random_below(r, 1000);
    const uint32_t geometry = kind == SKIP_OWN ? 0 : kind == SKIP_OTHER ? 1 : turn % 2;
    const uint32_t neighbour = (k + 1) % c->count;
    c->geometry[k] = geometry;
    c->primitive[k] = c->number[geometry][kind >= SKIP_SOME && random_below(r, 4) == 0 ? neighbour : k];
    if (kind >= SKIP_SOME && random_below(r, 8) == 0)
        c->primitive[k] = CGT_INVALID_ID;
    if (kind == SKIP_UNKNOWN && random_below(r, 2)) { /* beyond geometry 0 they would be the column's of geometry 1 */
        const bool beyond = random_below(r, 4) && c->number[1][k] != CGT_INVALID_ID;
        c->geometry[k] = beyond ? 0 : 2 + random_below(r, 2);
        c->primitive[k] = beyond ? c->prims[0] + c->number[1][k] : c->number[0][k];
    }
}

/* A call without skip_geometry takes geometry 0 for all. */
static void find_expected(columns *c, bool with_geometry)
{
    for (uint32_t k = 0; k < c->count; k++) {
        c->expected[k] = 0;
        for (uint32_t g = 0; g < 2; g++) {
            const bool skipped = c->primitive[k] == c->number[g][k] && (with_geometry ? c->geometry[k] : 0) == g;
            c->expected[k] |= c->number[g][k] != CGT_INVALID_ID && !skipped;
        }
    }
}

/* Returns the number of tiles. */
static uint64_t check(columns *c, const cgt_scene *scene, const char *name, uint32_t count, bool with_geometry)
{
    const cgt_points points = {.count = count,
                               .position = {c->at[0], c->at[1], c->at[2]},
                               .skip_primitive = c->primitive,
                               .skip_geometry = with_geometry ? c->geometry : NULL};
    cgt_trace_statistics statistics;
    cgt_trace_options options;
    cgt_trace_options_init(&options);
    options.statistics = &statistics;
    memset(c->got, 0x77, sizeof c->got);
    find_expected(c, with_geometry);
    assert_int_equal(cgt_occluded_points(scene, &c->light, &points, c->got, &options), CGT_OK);
    for (uint32_t k = 0; k < count; k++)
        if (c->got[k] != c->expected[k])
            fail_msg(
                "%s, %u columns, light %d, triangles %d: point %u of %u skips %u of %u (%d); its column has %u and "
                "%u: %u",
                name, c->count, (int)c->light.kind, c->with_triangles, k, count, c->primitive[k], c->geometry[k],
                with_geometry, c->number[0][k], c->number[1][k], c->got[k]);
    assert_int_equal(c->got[count], 0x77);
    return statistics.tiles;
}

TEST(columns_hide_what_is_not_skipped)
{
    static const cgt_structure structures[] = {CGT_STRUCTURE_LOOSE_GRID, CGT_STRUCTURE_AUTO, CGT_STRUCTURE_BVH};
    static columns c;
    uint64_t tiles = 0, occluded = 0, points = 0;
    for (uint32_t way = 0; way < 8; way++) {
        test_random r = random_make(40 + way);
        if (test_samples() && way % 4 != test_sample_start(40, 4))
            continue;
        make_columns(&c, &r, way & 1 ? SIDE : SMALL_SIDE, way & 2, way & 4);
        FOR_EACH_VARIANT(variant)
        {
            cgt_context *context = context_make(1 + way % 3, variant);
            for (uint32_t k = 0; k < TEST_COUNT(structures); k++) {
                cgt_scene *scene = commit(context, &c, structures[k]);
                for (uint32_t kind = 0; kind < SKIP_KINDS; kind++) {
                    for (uint32_t i = 0; i < c.count; i++)
                        set_skip(&c, &r, (skip_kind)kind, i);
                    tiles += check(&c, scene, variant, c.count, true);
                    tiles += check(&c, scene, variant, c.count - 1 - random_below(&r, 64), kind % 2);
                    for (uint32_t i = 0; i < c.count; i++)
                        occluded += c.expected[i];
                    points += c.count;
                }
                cgt_scene_release(scene);
            }
            cgt_context_release(context);
        }
    }
    print_message("%llu of %llu points in shadow, %llu tiles\n", (unsigned long long)occluded,
                  (unsigned long long)points, (unsigned long long)tiles);
    assert_true(tiles && occluded > points / 8 && occluded < points - points / 8);
}

SEEDED_SUITE("test_light_skips", NULL, NULL)
