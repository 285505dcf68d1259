/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Spheres over the pixels of a tile: the bounds of single precision hold against wide arithmetic. Then they are
 * tightened, by lowering FILTER_ROUNDOFF below the unit roundoff, until they break. For the variant that this is
 * compiled for. */
#include "support/test.h"
#include "support/oracle/truth.h"
#include "support/tightened.h"

#include <math.h>
#include <string.h>

#include "vector.h"

static float filter_u = 0x1p-24f;
#define FILTER_ROUNDOFF filter_u
#include "kernel/tile_draw/tile_sphere_draw.h"
#include "kernel/tile_draw/tile_parallel_spheres.h"
#include "kernel/tile_frame/tile_init.c"

#include "query/tile_limits.h"

static cgt_camera_rays rays_of(const cgt_camera *camera, uint32_t width, uint32_t height)
{
    cgt_camera_rays rays;
    char message[160];
    assert_int_equal(cgt_camera_prepare(camera, width, height, &rays, message), CGT_OK);
    return rays;
}

/* ---- one tile ---- */

/* Initialises a tile as cgt_tile_init does. */
static void tile_of(tile *t, const cgt_camera_rays *rays, uint32_t x, uint32_t y, uint32_t columns, uint32_t rows,
                    float c, float r)
{
    t->rays = rays;
    t->columns = columns;
    t->rows = rows;
    tile_init_camera(rays, &t->camera);
    tile_init_parallel(t);
    tile_init_tables(t, x, y);
    tile_init_norms(t);
    tile_init_cone(t);
    if (t->parallel)
        tile_init_parallel_depth_error(t, c, r, 2 * c);
    else
        tile_init_sphere_depth_error(t, c, r, 2 * c);
    tile_init_pixels(t, 2 * c);
    tile_ensure_pixels(t);
}

/* ---- bounds ---- */

typedef struct tally {
    uint64_t lanes, hits, certain, undecided, double_lanes;
    uint64_t lost, invented, outside; /* must be 0 */
} tally;

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

/* A camera, and a sphere whose silhouette crosses a tile of 8x8 pixels; usually a ray is as close to tangential as
 * float allows. */
static void make_case(test_random *r, bool parallel, cgt_camera_rays *rays, uint32_t at[2], float sphere[4])
{
    cgt_camera camera;
    float away[3];
    const float scale = random_below(r, 3) ? 1 : random_log(r, 1e-6f, 1e6f);
    const float size = random_below(r, 2) ? random_log(r, 1e-4f, 0.5f) : random_float(r, 0.01f, 0.3f);
    const float offset = random_below(r, 2) ? 0 : random_log(r, 0.1f, 1e4f);
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++) {
        camera.eye[a] = scale * random_float(r, -1, 1) * offset;
        camera.target[a] = camera.eye[a] + scale * (a == 1 ? 2 : random_float(r, -1, 1));
    }
    random_direction(r, camera.up);
    camera.fov = random_below(r, 2) ? random_float(r, 20, 100) : random_log(r, 0.5f, 160);
    if (parallel) {
        camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
        camera.height = scale * (random_below(r, 2) ? random_float(r, 0.5f, 4) : random_log(r, 1e-3f, 30));
        if (random_below(r, 3) == 0) /* along an axis */
            for (int a = 0; a < 3; a++) {
                camera.target[a] = camera.eye[a] + (a == 2 ? scale : 0);
                camera.up[a] = a == 1;
            }
    }
    const uint32_t edge = 8 + random_below(r, random_below(r, 2) ? 1000 : 20);
    *rays = rays_of(&camera, edge, edge);
    at[0] = random_below(r, edge - 7);
    at[1] = random_below(r, edge - 7);
    const float px = ((float)(at[0] + random_below(r, 8)) + 0.5f) * rays->pixel[0] - 1;
    const float py = 1 - ((float)(at[1] + random_below(r, 8)) + 0.5f) * rays->pixel[1];
    float side[3], along = 0, square = 0;
    const cgt_exact_ray line = tile_pixel_line(rays, parallel, px, py);
    const float *d = line.dir;
    random_direction(r, away);
    for (int a = 0; a < 3; a++) {
        along += d[a] * away[a];
        square += d[a] * d[a];
    }
    float length = 0;
    for (int a = 0; a < 3; a++) {
        side[a] = away[a] - along / square * d[a];
        length += side[a] * side[a];
    }
    const float distance = scale * random_float(r, 0.5f, 3) / sqrtf(square);
    const float out = random_below(r, 4) ? 1 : random_float(r, 0, 2);
    sphere[3] = random_below(r, 20) ? distance * sqrtf(square) * size : 0;
    for (int a = 0; a < 3; a++)
        sphere[a] = line.org[a] + distance * d[a] + out * sphere[3] * side[a] / sqrtf(length);
}

static float distance_of(const cgt_camera_rays *rays, const float sphere[4])
{
    float square = 0;
    for (int a = 0; a < 3; a++)
        square += (sphere[a] - rays->eye[a]) * (sphere[a] - rays->eye[a]);
    return sqrtf(square) * (1 + 0x1p-20f) + sphere[3];
}

/* typical: the radius for which the tile's depth error is set, relative to the sphere's. */
static void judge_case(const cgt_camera_rays *rays, const uint32_t at[2], const float sphere[4], float typical,
                       tile_truth *truth, bool fresh, tally *sum)
{
    static tile t;
    tile_of(&t, rays, at[0], at[1], 8, 8, distance_of(rays, sphere), sphere[3] * typical);
    if (fresh)
        find_truth(&t, sphere, truth);
    judge_sphere(&t, sphere, truth, sum);
}

static void check_bounds(uint64_t stream, bool parallel)
{
    static tile_truth truth;
    test_random r = random_make(stream);
    tally sum = {0};
    for (uint32_t k = 50 + test_scaled(6000); k; k--) {
        cgt_camera_rays rays;
        uint32_t at[2];
        float sphere[4];
        make_case(&r, parallel, &rays, at, sphere);
        const float typical = random_below(&r, 2) ? 1 : random_float(&r, 0.5f, 2);
        if (cgt_tile_supports_camera(&rays))
            judge_case(&rays, at, sphere, typical, &truth, true, &sum);
    }
    print_message("%llu lanes, %llu hits, %llu certain, %llu undecided, %llu spheres in double; lost %llu, "
                  "invented %llu, outside %llu\n",
                  (unsigned long long)sum.lanes, (unsigned long long)sum.hits, (unsigned long long)sum.certain,
                  (unsigned long long)sum.undecided, (unsigned long long)sum.double_lanes, (unsigned long long)sum.lost,
                  (unsigned long long)sum.invented, (unsigned long long)sum.outside);
    assert_int_equal(sum.lost, 0);
    assert_int_equal(sum.invented, 0);
    assert_int_equal(sum.outside, 0);
    assert_true(sum.certain > 100 && sum.undecided > 20 && sum.hits > 100 &&
                sum.lanes - sum.certain - sum.undecided > 100);
}

static void bounds_hold(void **state)
{
    (void)state;
    check_bounds(360, false);
}

static void bounds_of_parallel_rays_hold(void **state)
{
    (void)state;
    check_bounds(370, true);
}

static void check_tightened_bounds(uint64_t stream, bool parallel)
{
    static tile_truth truth;
    test_random r = random_make(stream);
    tally sum[STEPS] = {{0}};
    for (uint32_t k = 300 + test_scaled(2000); k; k--) {
        cgt_camera_rays rays;
        uint32_t at[2];
        float sphere[4], scale = 0x1p-24f;
        make_case(&r, parallel, &rays, at, sphere);
        const float typical = random_below(&r, 2) ? 1 : random_float(&r, 0.5f, 2);
        if (!cgt_tile_supports_camera(&rays))
            continue;
        for (int step = 0; step < STEPS; step++, scale *= 0.70710678f) {
            filter_u = scale;
            judge_case(&rays, at, sphere, typical, &truth, step == 0, &sum[step]);
        }
        filter_u = 0x1p-24f;
    }
    /* the bounds are worst cases: random rays come within a few orders of magnitude */
    check_break("a hit lost", sum, sizeof *sum, offsetof(tally, lost), 0x1p-10);
    check_break("a hit invented", sum, sizeof *sum, offsetof(tally, invented), 0x1p-11);
    check_break("depth outside", sum, sizeof *sum, offsetof(tally, outside), 0x1p-11);
}

static void bounds_break_where_they_are_tightened(void **state)
{
    (void)state;
    check_tightened_bounds(380, false);
}

static void bounds_of_parallel_rays_break_where_they_are_tightened(void **state)
{
    (void)state;
    check_tightened_bounds(390, true);
}

/* ---- which frames ---- */

static void serves_frames_that_it_supports(void **state)
{
    (void)state;
    cgt_camera camera;
    cgt_camera_init(&camera);
    cgt_camera_rays rays = rays_of(&camera, 64, 64);
    assert_true(cgt_tile_supports_camera(&rays));
    rays.eye[1] = 0x1p56f;
    assert_false(cgt_tile_supports_camera(&rays));
    camera.fov = 0.01f;
    rays = rays_of(&camera, 64, 64);
    assert_false(cgt_tile_supports_camera(&rays));
    camera.fov = 179.9f;
    rays = rays_of(&camera, 64, 64);
    assert_false(cgt_tile_supports_camera(&rays));
    camera.fov = 160;
    rays = rays_of(&camera, 64, 64);
    assert_true(cgt_tile_supports_camera(&rays));
    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    rays = rays_of(&camera, 64, 64);
    assert_true(cgt_tile_supports_camera(&rays));
    rays.eye[1] = 0x1p20f; /* adjacent float origins are several pixels apart */
    assert_false(cgt_tile_supports_camera(&rays));
    camera.height = 0x1p-41f;
    rays = rays_of(&camera, 64, 64);
    assert_false(cgt_tile_supports_camera(&rays));
    camera.height = 0x1p42f;
    rays = rays_of(&camera, 64, 64);
    assert_false(cgt_tile_supports_camera(&rays));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(serves_frames_that_it_supports),
        cmocka_unit_test(bounds_hold),
        cmocka_unit_test(bounds_of_parallel_rays_hold),
        cmocka_unit_test(bounds_break_where_they_are_tightened),
        cmocka_unit_test(bounds_of_parallel_rays_break_where_they_are_tightened),
    };
    test_begin("test_tile_spheres");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
