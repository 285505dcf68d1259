/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The march over a loose grid visits each primitive that a ray hits once, in the order of slices, and with windows and
 * occlusion leaves few tests. No profile of tests/driver, which sees hits and not the way to them. For the variant that
 * this is compiled for. */
#include "support/suite.h"
#include "tile/tile_compare.h"

#include "kernel/tile/tile_march.h"
#include "kernel/tile_frame/tile_init.c"

static cgt_scene *queue_scene(const float (*sphere)[4], uint32_t count)
{
    cgt_scene_options options;
    cgt_scene_options_init(&options);
    options.structure = CGT_STRUCTURE_QUEUE_GRID;
    return scene_of(context, &options, sphere, count);
}

TEST(frame_of_many_tiles)
{
    test_random r = random_make(320);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 2000);
    frames_tally tally = {0};
    cgt_camera camera = camera_before(&c);
    dual_scene b = dual_scene_of(queue_scene((const float(*)[4])c.sphere, c.count), 8);
    compare_frame(&b, &camera, 200, 130, "many tiles", &tally);
    make_orthographic(&r, 2 * c.reach, &camera);
    compare_frame(&b, &camera, 200, 130, "many tiles", &tally);
    print_tally("many tiles", &tally);
    assert_int_equal(tally.served, 2);
    /* culling and windows work: far fewer tests than primitives x rays */
    assert_true(tally.counts.ray_tests < tally.counts.rays * 100);
    dual_scene_free(&b);
    cloud_free(&c);
}

/* Every primitive that a ray hits is visited exactly once, in a slice whose near_t is at most the hit's t. */
TEST(march_visits_what_rays_hit)
{
    static tile t;
    uint64_t hits = 0, visits = 0, prims = 0;
    test_random r = random_make(340);
    for (uint32_t round = 0; round < 5 + test_scaled(120); round++) {
        cloud c = cloud_make(&r, (cloud_kind)(round % CLOUD_KINDS), 1 + random_below(&r, 400));
        cgt_camera camera = camera_random(&r, &c);
        camera.projection = CGT_PROJECTION_PERSPECTIVE;
        if (round % 3 == 2)
            make_orthographic(&r, c.reach * random_float(&r, 0.3f, 4), &camera);
        tile_march m;
        tile_slice s;
        float near[401] = {0};
        uint32_t seen[401] = {0};
        const uint32_t edge = random_below(&r, 3) ? 200 + random_below(&r, 2000) : 12;
        const cgt_camera_rays rays = rays_of(&camera, edge, edge);
        dual_scene b =
            dual_scene_of(queue_scene((const float(*)[4])c.sphere, c.count), round % 2 ? random_float(&r, 0.5f, 8) : 0);
        t.rays = &rays;
        t.columns = t.rows = 12;
        tile_init_camera(&rays, &t.camera);
        tile_init_parallel(&t);
        tile_init_tables(&t, random_below(&r, edge - 11), random_below(&r, edge - 11));
        tile_init_norms(&t);
        tile_march_init(&t, &b.loose->committed_scene.loose, &m);
        float before = 0;
        while (tile_march_next_slice(&m, &s)) {
            assert_true((float)s.near_t >= before);
            before = (float)s.near_t;
            for (uint32_t i = 0; i < tile_slice_run_count(&m, &s); i++) {
                uint32_t count;
                const uint32_t *reference = tile_slice_get_run(&m, &s, i, &count);
                for (uint32_t k = 0; k < count; k++, visits++) {
                    near[reference[k]] = before;
                    seen[reference[k]]++;
                }
            }
        }
        for (uint32_t k = 0; k < c.count; k++) {
            assert_true(seen[k] <= 1);
            for (uint32_t p = 0; p < 144; p++) {
                uint64_t exact = 0;
                const cgt_ray ray = tile_pixel_ray(&t, tile_index(p % 12, p / 12));
                cgt_decided_hit hit = {.primitive = cgt_primitives_get(&b.scene->committed_scene.prims, k)};
                if (!cgt_decide_hit(&ray, &hit, &exact))
                    continue;
                hits++;
                assert_int_equal(seen[k], 1);
                assert_true((double)near[k] <= hit.t * (1 + 1e-6));
            }
        }
        prims += c.count;
        dual_scene_free(&b);
        cloud_free(&c);
    }
    print_message("%llu primitives, %llu visits, %llu hits\n", (unsigned long long)prims, (unsigned long long)visits,
                  (unsigned long long)hits);
    assert_true(hits > 100 && visits < prims);
}

VARIANT_SUITE("test_tile_march", make_context, release_context)
