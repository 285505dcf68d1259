/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres over the pixels of a tile: the bounds of single precision hold against wide arithmetic. Then they are
 * tightened, by lowering FILTER_ROUNDOFF below the unit roundoff, until they break. For the variant that this is
 * compiled for. */
#include "support/oracle/truth.h"

#include "vector.h"

static float filter_u = 0x1p-24f;
#define FILTER_ROUNDOFF filter_u
#include "kernel/tile_draw/tile_sphere_draw.h"
#include "kernel/tile_draw/tile_parallel_spheres.h"
#include "kernel/tile_frame/tile_init.c"

#include "tile/tile_bounds.h"

/* ---- one tile ---- */

static void tile_of(tile *t, const tile_case *at, float c, float r)
{
    begin_tile(t, at);
    if (t->parallel)
        tile_init_parallel_depth_error(t, c, r, 2 * c);
    else
        tile_init_sphere_depth_error(t, c, r, 2 * c);
    tile_init_pixels(t, 2 * c);
    tile_ensure_pixels(t);
}

/* ---- bounds ---- */

/* The true hits of a sphere at each pixel of a tile, with depths as in tile.h. */
typedef struct tile_truth {
    bool hit[TILE_PIXELS];
    truth_real depth[TILE_PIXELS];
} tile_truth;

static void find_truth(const tile *t, const float sphere[4], tile_truth *truth)
{
    for (uint32_t y = 0; y < t->rows; y++)
        for (uint32_t x = 0; x < t->columns; x++) {
            const uint32_t i = tile_index(x, y);
            const cgt_ray ray = tile_pixel_ray(t, i);
            const truth_roots root = truth_sphere(ray.line.org, ray.line.dir, sphere);
            const truth_real px = t->column[x], py = t->row[y];
            truth->hit[i] = root.hit && root.near >= 0;
            truth->depth[i] = root.near * (1 + t->camera.a * px * px + t->camera.b * py * py);
        }
}

/* Rasterises a sphere over an empty tile: stored pixels are certain, queued ones undecided. */
static void judge_sphere(tile *t, const float sphere[4], const tile_truth *truth, tally *sum)
{
    static tile_queue queue;
    static bool undecided[TILE_PIXELS];
    const cgt_primitive_array array = {.kind = CGT_KIND_SPHERES,
                                       .point = (const char *)sphere,
                                       .point_stride = 16,
                                       .radius = (const char *)(sphere + 3),
                                       .radius_stride = 16,
                                       .count = 1};
    const cgt_primitives prims = {.array = &array, .arrays = 1, .count = 1, .spheres = 1};
    const uint32_t reference = 0;
    const vfloat zero = spux_vfloat(0);
    vfloat v[4];
    tile_visible_spheres found;
    tile_spheres s;
    cgt_counts counts = {0};
    found.count = 0;
    queue.entries = 0;
    memset(undecided, 0, sizeof undecided);
    const vuint prim = load_references(&reference, 1);
    gather_scene_spheres(&prims, prim, v);
    assert_int_equal(spux_mask_bits(spu_cmpeq(v[3], zero)) != 0, sphere[3] == 0);
    s.single_lanes = s.double_lanes = s.small_lanes[0] = s.small_lanes[1] = 0;
    if (t->parallel)
        tile_cull_parallel_spheres(t, v, prim, 1, &found);
    else
        tile_cull_spheres(t, v, prim, 1, &found);
    if (found.count && t->parallel)
        tile_init_parallel_spheres(t, &found, 0, &s);
    else if (found.count)
        tile_init_spheres(t, &found, 0, &s);
    sum->double_lanes += s.double_lanes & 1;
    if (s.double_lanes & 1)
        return;
    tile_rect rect;
    if (s.single_lanes & s.small_lanes[1] & 1)
        tile_rasterise_small_sphere(&prims, t, &s, 0, s.small_lanes[0] & 1 ? 3 : 4, &queue, &counts);
    else if (s.single_lanes & 1 && tile_clip_window(t, &s.window, 0, s.min_distance[0], &rect))
        tile_rasterise_sphere(&prims, t, &s, 0, rect, &queue, &counts);
    for (uint32_t k = 0; k < queue.entries; k++)
        undecided[queue.pixel[k]] = true;
    for (uint32_t y = 0; y < t->rows; y++)
        for (uint32_t x = 0; x < t->columns; x++) {
            const uint32_t i = tile_index(x, y);
            const bool certain = t->prim[i] == 0;
            sum->lanes++;
            sum->hits += truth->hit[i];
            sum->certain += certain;
            sum->undecided += undecided[i];
            sum->lost += truth->hit[i] && !certain && !undecided[i];
            sum->invented += certain && !truth->hit[i];
            sum->outside += certain && truth->hit[i] &&
                            !((truth_real)t->z[i] <= truth->depth[i] &&
                              truth->depth[i] <= (truth_real)t->z[i] + (truth_real)t->depth_error);
        }
}

static tile_case at;
static float sphere[4],
    typical; /* typical: the radius for which the tile's depth error is set, relative to the sphere's */

/* A sphere whose silhouette crosses the tile; usually a ray is as close to tangential as float allows. */
static bool make_case(test_random *r, bool parallel)
{
    float away[3], side[3], along = 0, square = 0, length = 0;
    at = make_camera_case(r, parallel);
    const float *d = at.line.dir;
    const float size = random_below(r, 2) ? random_log(r, 1e-4f, 0.5f) : random_float(r, 0.01f, 0.3f);
    random_direction(r, away);
    for (int a = 0; a < 3; a++) {
        along += d[a] * away[a];
        square += d[a] * d[a];
    }
    for (int a = 0; a < 3; a++) {
        side[a] = away[a] - along / square * d[a];
        length += side[a] * side[a];
    }
    const float distance = at.scale * random_float(r, 0.5f, 3) / sqrtf(square);
    const float out = random_below(r, 4) ? 1 : random_float(r, 0, 2);
    sphere[3] = random_below(r, 20) ? distance * sqrtf(square) * size : 0;
    for (int a = 0; a < 3; a++)
        sphere[a] = at.line.org[a] + distance * d[a] + out * sphere[3] * side[a] / sqrtf(length);
    typical = random_below(r, 2) ? 1 : random_float(r, 0.5f, 2);
    return cgt_tile_supports_camera(&at.rays);
}

static void judge_case(uint32_t form, bool fresh, tally *sum)
{
    static tile t;
    static tile_truth truth;
    float square = 0;
    (void)form;
    for (int a = 0; a < 3; a++)
        square += (sphere[a] - at.rays.eye[a]) * (sphere[a] - at.rays.eye[a]);
    tile_of(&t, &at, sqrtf(square) * (1 + 0x1p-20f) + sphere[3], sphere[3] * typical);
    if (fresh)
        find_truth(&t, sphere, &truth);
    judge_sphere(&t, sphere, &truth, sum);
}

static const double least[3] = {0x1p-10, 0x1p-11, 0x1p-11};

TEST(bounds_hold) { check_bounds(360, false, 1, 6000); }

TEST(bounds_of_parallel_rays_hold) { check_bounds(370, true, 1, 6000); }

TEST(bounds_break_where_they_are_tightened) { check_tightened_bounds(380, false, 1, least); }

TEST(bounds_of_parallel_rays_break_where_they_are_tightened) { check_tightened_bounds(390, true, 1, least); }

/* ---- which frames ---- */

TEST(serves_frames_that_it_supports)
{
    cgt_camera camera;
    cgt_camera_init(&camera);
    cgt_camera_rays rays;
    make_case_rays(&camera, 64, &rays);
    assert_true(cgt_tile_supports_camera(&rays));
    rays.eye[1] = 0x1p56f;
    assert_false(cgt_tile_supports_camera(&rays));
    camera.fov = 0.01f;
    make_case_rays(&camera, 64, &rays);
    assert_false(cgt_tile_supports_camera(&rays));
    camera.fov = 179.9f;
    make_case_rays(&camera, 64, &rays);
    assert_false(cgt_tile_supports_camera(&rays));
    camera.fov = 160;
    make_case_rays(&camera, 64, &rays);
    assert_true(cgt_tile_supports_camera(&rays));
    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    make_case_rays(&camera, 64, &rays);
    assert_true(cgt_tile_supports_camera(&rays));
    rays.eye[1] = 0x1p20f; /* adjacent float origins are several pixels apart */
    assert_false(cgt_tile_supports_camera(&rays));
    camera.height = 0x1p-41f;
    make_case_rays(&camera, 64, &rays);
    assert_false(cgt_tile_supports_camera(&rays));
    camera.height = 0x1p42f;
    make_case_rays(&camera, 64, &rays);
    assert_false(cgt_tile_supports_camera(&rays));
}

VARIANT_SUITE("test_tile_spheres", NULL, NULL)
