/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Hundreds of primitives, enough for deep trees, levels and streams: clouds, soups,
 * closed meshes, and coordinates of any magnitude. */
#include <math.h>
#include <string.h>

#include "driver/scenes/scene_heap.h"
#include "structures/scenes/band_scenes.h"
#include "structures/scenes/random_soup.h"
#include "support/closed_meshes.h"

static uint32_t below(scene_heap *h, uint32_t n) { return random_below(h->r, n); }
static float real(scene_heap *h, float low, float high) { return random_float(h->r, low, high); }

static void add(scene_heap *h, oracle_kind kind, const float *data)
{
    memcpy(scene_heap_add(h, kind), data, (size_t)oracle_floats(kind) * sizeof *data);
}

/* ---- clouds ---- */

/* What becomes of sphere i and triangle i of a cloud about the origin, which reaches so far. */
typedef void change(scene_heap *h, uint32_t i, float reach, float sphere[4], float triangle[9]);

/* Most triangles in one plane across an axis through the origin, and all spheres, as points. */
static void flat(scene_heap *h, uint32_t i, float reach, float sphere[4], float triangle[9])
{
    (void)reach;
    h->scene->axis = h->scene->number % 3;
    sphere[h->scene->axis] = sphere[3] = 0;
    for (uint32_t k = h->scene->axis; i % 8 && k < 9; k += 3)
        triangle[k] = 0;
}

/* All but every tenth in a small part of the whole. */
static void dense(scene_heap *h, uint32_t i, float reach, float sphere[4], float triangle[9])
{
    const float amount = i % 10 ? ldexpf(1, -12 - 3 * (int)(h->scene->number % 6)) : 1;
    (void)reach;
    for (int k = 0; k < 9; k++)
        triangle[k] *= amount;
    for (int k = 0; k < 4; k++)
        sphere[k] *= amount;
}

/* Clumps of spheres that are nearly points: smaller than what slabs lose by rounding. */
static void specks(scene_heap *h, uint32_t i, float reach, float sphere[4], float triangle[9])
{
    (void)reach, (void)triangle;
    for (int a = 0; a < 3; a++)
        sphere[a] = i < 16 ? ((float)below(h, 1 << 17) - 0x1p16f) * 0x1p-16f : h->data[ORACLE_SPHERE][i % 16][a];
    sphere[3] = 0x1p-30f;
}

/* Most overlap most others. */
static void overlapping(scene_heap *h, uint32_t i, float reach, float sphere[4], float triangle[9])
{
    (void)i, (void)triangle;
    for (int a = 0; a < 3; a++)
        sphere[a] = real(h, -reach, reach);
    sphere[3] = reach * real(h, 0.4f, 1.2f);
}

/* A sphere and a triangle above it in each column of a lattice: what a ray meets depends on what it skips. */
static void columns(scene_heap *h, uint32_t i, float reach, float sphere[4], float triangle[9])
{
    enum { SIDE = 96 };
    static const float corner[3][2] = {{-0.25f, -0.25f}, {0.25f, -0.25f}, {0, 0.25f}};
    const float place[2] = {(float)(i % SIDE) - SIDE / 2, (float)(i / SIDE) - SIDE / 2};
    (void)reach;
    for (int k = 0; k < 9; k++)
        triangle[k] = k % 3 < 2 ? place[k % 3] + corner[k / 3][k % 3] : 2;
    sphere[0] = place[0];
    sphere[1] = place[1];
    sphere[2] = 0;
    sphere[3] = 0.25f;
    h->scene->scale = SIDE / 2;
}

enum { SPHERES = 1, TRIANGLES = 2, CAPSULES = 4, ANY = 0 };

static const struct {
    const char *name;
    cloud_kind kind;
    change *change;
    unsigned sorts; /* as bits */
} clouds[] = {{"uniform", CLOUD_UNIFORM, NULL, ANY},
              {"clustered", CLOUD_CLUSTERED, NULL, ANY},
              {"planar", CLOUD_PLANAR, NULL, ANY},
              {"mixed sizes", CLOUD_MIXED, NULL, ANY},
              {"far from the origin", CLOUD_FAR, NULL, ANY},
              {"lattice", CLOUD_LATTICE, NULL, ANY},
              {"line", CLOUD_LINE, NULL, ANY},
              {"overlapping", CLOUD_UNIFORM, overlapping, SPHERES},
              {"flat", CLOUD_UNIFORM, flat, ANY},
              {"dense", CLOUD_UNIFORM, dense, ANY},
              {"specks", CLOUD_UNIFORM, specks, SPHERES},
              {"columns", CLOUD_UNIFORM, columns, SPHERES | TRIANGLES}};
enum { CLOUDS = 8, FLAT = CLOUDS, DENSE, SPECKS, COLUMNS };

static const char *name_of_cloud(uint32_t family) { return clouds[family].name; }

/* Three vertices around a sphere; every fourth triangle shares an edge with the one before. */
static void triangle_near(scene_heap *h, const float sphere[4], uint32_t i, float triangle[9])
{
    for (int k = 0; k < 9; k++)
        if (i % 4 != 1 || k < 3)
            triangle[k] = sphere[k % 3] + 3 * sphere[3] * real(h, -1, 1);
}

static void make_cloud(scene_heap *h, uint32_t family)
{
    static const float scales[] = {1, 0x1p-50f, 1, 0x1p30f, 0x1p-80f};
    const float scale = clouds[family].change ? 1 : scales[h->scene->number / 3 % 5];
    const unsigned sorts = clouds[family].sorts ? clouds[family].sorts : 1 + below(h, 7);
    cloud c = cloud_make(h->r, clouds[family].kind, h->n);
    float triangle[9] = {0}, v[9], capsule[7];
    h->scene->scale = scale * c.reach;
    for (int a = 0; a < 3; a++)
        h->scene->middle[a] = clouds[family].change ? 0 : scale * c.middle[a];
    for (uint32_t i = 0; i < h->n; i++) {
        float *const sphere = c.sphere[i];
        for (int a = 0; a < 3; a++)
            sphere[a] -= clouds[family].change ? c.middle[a] : 0;
        triangle_near(h, sphere, i, triangle);
        memcpy(v, triangle, sizeof v);
        if (clouds[family].change)
            clouds[family].change(h, i, c.reach, sphere, v);
        for (int k = 0; k < 9; k++)
            v[k] *= scale;
        for (int k = 0; k < 4; k++)
            sphere[k] *= scale;
        memcpy(capsule, v, 6 * sizeof *capsule);
        capsule[6] = 0.5f * sphere[3];
        if (sorts & SPHERES)
            add(h, ORACLE_SPHERE, sphere);
        if (sorts & TRIANGLES)
            add(h, ORACLE_TRIANGLE, v);
        if (sorts & CAPSULES)
            add(h, ORACLE_CAPSULE, capsule);
    }
    cloud_free(&c);
}

const scene_group cloud_scenes = {CLOUDS, name_of_cloud, make_cloud};

/* Of one family each, for rays of their own. */
#define GROUP(group, number)                                                                                           \
    static const char *name_##group(uint32_t family) { return name_of_cloud(number + family); }                        \
    static void make_##group(scene_heap *h, uint32_t family) { make_cloud(h, number + family); }                       \
    const scene_group group = {1, name_##group, make_##group}
GROUP(even_scenes, CLOUD_UNIFORM);
GROUP(flat_scenes, FLAT);
GROUP(dense_scenes, DENSE);
GROUP(speck_scenes, SPECKS);
GROUP(column_scenes, COLUMNS);

/* ---- soups ---- */

static const char *name_of_soup(uint32_t family) { return soup_name((soup_kind)family); }

static void add_soup(scene_heap *h, uint32_t family, uint32_t count, float scale)
{
    hard_scene s = soup_make((soup_kind)family, random_bits(h->r), count);
    for (uint32_t g = 0; g < s.geometries; g++) {
        for (uint32_t i = 0; i < s.geometry[g].spheres; i++) {
            float sphere[4];
            for (int k = 0; k < 4; k++)
                sphere[k] = scale * s.geometry[g].sphere[i][k];
            add(h, ORACLE_SPHERE, sphere);
        }
        for (uint32_t i = 0; i < s.geometry[g].triangles; i++) {
            float triangle[9];
            for (int k = 0; k < 9; k++)
                triangle[k] = scale * s.geometry[g].vertex[s.geometry[g].index[i][k / 3]][k % 3];
            add(h, ORACLE_TRIANGLE, triangle);
        }
    }
    h->scene->scale = scale;
    hard_scene_free(&s);
}

static void make_soup(scene_heap *h, uint32_t family)
{
    static const float scales[] = {1, 1e-3f, 1e4f, 1, 0x1p-30f, 0x1p40f, 1};
    add_soup(h, family, h->n, scales[h->scene->number / 2 % 7]);
}

static void make_large(scene_heap *h, uint32_t family) { add_soup(h, family, 6000, 1); }

const scene_group soup_scenes = {SOUP_KINDS, name_of_soup, make_soup};
const scene_group large_scenes = {SOUP_KINDS, name_of_soup, make_large};

/* ---- closed meshes: every edge is one of two triangles ---- */

static const char *name_of_mesh(uint32_t family) { return closed_mesh_name((closed_kind)family); }

static void make_mesh(scene_heap *h, uint32_t family)
{
    static const uint32_t most[CLOSED_KINDS] = {6, 3, 2, 20, 60}, least[CLOSED_KINDS] = {1, 1, 1, 4, 3};
    static const double places[][2] = {{1, 0},    {1, 100},    {1e-6, 0},   {1e6, 0},  {0x1p-50, 0},
                                       {1e-3, 1}, {0x1p50, 0}, {2, 148376}, {1000, 1}, {1e-4, 0}};
    const double *const place = places[below(h, 10)], scale = place[0], shift = place[1];
    closed_mesh mesh;
    assert_true(
        closed_mesh_make(&mesh, (closed_kind)family, least[family] + below(h, most[family] - least[family] + 1)));
    assert_true(closed_mesh_is_closed(&mesh));
    for (uint32_t i = 0; i < mesh.triangles; i++) {
        float triangle[9];
        for (int k = 0; k < 9; k++)
            triangle[k] = (float)(scale * mesh.vertex[mesh.index[i][k / 3]][k % 3] + shift);
        add(h, ORACLE_TRIANGLE, triangle);
    }
    h->scene->closed = true;
    h->scene->scale = (float)scale;
    for (int a = 0; a < 3; a++)
        h->scene->middle[a] = (float)shift;
    closed_mesh_free(&mesh);
}

const scene_group mesh_scenes = {CLOSED_KINDS, name_of_mesh, make_mesh};

/* ---- bands ---- */

static const char *name_of_bands(uint32_t family)
{
    static const char *const name[BAND_KINDS] = {"one scale", "strays", "any magnitude", "flat strays",
                                                 "nearly denormal"};
    return name[family];
}

static void make_bands(scene_heap *h, uint32_t family)
{
    const bool capsules = below(h, 3) == 0;
    band_scene s = band_scene_make(h->r, (band_kind)family, below(h, h->n + 1), 1 + below(h, h->n));
    for (uint32_t i = 0; i < s.spheres; i++)
        add(h, ORACLE_SPHERE, s.sphere[i]);
    for (uint32_t i = 0; i < s.triangles; i++)
        add(h, ORACLE_TRIANGLE, s.vertex[3 * i]);
    for (uint32_t i = 0; i < s.spheres && i < s.triangles && capsules; i++) {
        float capsule[7];
        memcpy(capsule, s.vertex[3 * i], 6 * sizeof *capsule);
        capsule[6] = s.sphere[i][3];
        add(h, ORACLE_CAPSULE, capsule);
    }
    h->scene->scale = 0; /* of any magnitude */
    band_scene_free(&s);
}

const scene_group band_scenes = {BAND_KINDS, name_of_bands, make_bands};
