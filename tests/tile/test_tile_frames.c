/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames by tiles are the same, bit for bit, as by packets through the queue grid; and the march over the grid skips no
 * primitive that a ray hits. For the variant that this is compiled for. */
#include "hard_cases/hard_run.h"
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

static const uint32_t sizes[][2] = {{1, 1}, {3, 70}, {64, 64}, {65, 63}, {100, 65}};

/* A huge sphere, one around the eye, points, and a copy. */
static void add_special_spheres(cloud *c, const float eye[3])
{
    for (int a = 0; a < 3; a++) {
        c->sphere[0][a] = c->middle[a] - 30 * c->reach;
        c->sphere[1][a] = eye[a] + 1e-3f * c->reach;
    }
    c->sphere[0][3] = 49 * c->reach;
    for (uint32_t i = 2; i < 6; i++)
        c->sphere[i][3] = 0;
    memcpy(c->sphere[7], c->sphere[6], sizeof c->sphere[7]);
}

/* Clouds of every kind, from outside and from inside; ranges; spheres around the eye. */
TEST(frames_of_clouds)
{
    uint32_t parallel = 0;
    for (int kind = 0; kind < CLOUD_KINDS; kind++) {
        test_random r = random_make(300 + (uint64_t)kind);
        frames_tally tally = {0};
        for (uint32_t round = 0; round < test_scaled(8); round++) {
            cloud c = cloud_make(&r, (cloud_kind)kind, 1 + random_below(&r, round % 4 ? 300 : 3000));
            cgt_camera camera = camera_random(&r, &c);
            if (round % 4 == 1 && c.count > 20)
                add_special_spheres(&c, camera.eye);
            dual_scene b = dual_scene_of(queue_scene((const float(*)[4])c.sphere, c.count),
                                         round % 2 ? random_float(&r, 0.5f, 16) : 0);
            for (uint32_t i = 0; i < 3; i++) {
                const uint32_t *size = sizes[random_below(&r, TEST_COUNT(sizes))];
                camera = camera_random(&r, &c);
                camera.projection = i ? CGT_PROJECTION_PERSPECTIVE : camera.projection;
                if (i == 2)
                    make_orthographic(&r, c.reach * random_log(&r, 0.01f, 8), &camera);
                if (random_below(&r, 4) == 0)
                    camera.t_min = c.reach * random_float(&r, 0, 4);
                if (random_below(&r, 4) == 0)
                    camera.t_max = camera.t_min + c.reach * random_log(&r, 1e-3f, 100);
                compare_frame(&b, &camera, size[0], size[1], cloud_name((cloud_kind)kind), &tally);
            }
            dual_scene_free(&b);
            cloud_free(&c);
        }
        print_tally(cloud_name((cloud_kind)kind), &tally);
        assert_true(tally.served > 0);
        parallel += tally.parallel; /* fewer than frames: adjacent float origins may be several pixels apart */
    }
    assert_true(parallel > 0);
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

/* A whole frame by tiles into 8 planes aligned to cache lines, with or without non-temporal stores. */
static void trace_lines(const cgt_committed_scene *committed_scene, const cgt_camera_rays *rays, uint32_t width,
                        uint32_t height, bool nontemporal, uint32_t *to)
{
    const size_t pixels = (size_t)width * height;
    const cgt_trace_settings settings = {.packet = 8,
                                         .precision = CGT_PRECISION_EXACT,
                                         .fields = CGT_FIELD_T | CGT_FIELD_PRIMITIVE | CGT_FIELD_GEOMETRY |
                                                   CGT_FIELD_NORMAL | CGT_FIELD_UV};
    cgt_scratch *scratch = cgt_scratch_init(aligned_alloc(CGT_ALIGNMENT, CGT_SCRATCH_BYTES));
    cgt_counts counts = {.scratch = scratch};
    cgt_region r = {.width = width, .height = height, .row_stride = width, .nontemporal = nontemporal};
    memset(to, nontemporal ? 0x55 : 0x77, 8 * pixels * sizeof *to);
    for (size_t k = 0; k < CGT_PLANES; k++)
        r.plane[k] = to + k * pixels;
    CGT_KERNEL(cgt_trace_tile)(committed_scene, rays, &settings, &r, &counts);
    free(scratch);
}

static void compare_lines(const dual_scene *b, const cgt_camera *camera)
{
    const uint32_t width = 192, height = 128;
    const size_t bytes = 8 * (size_t)width * height * sizeof(uint32_t);
    const cgt_camera_rays rays = rays_of(camera, width, height);
    uint32_t *memory = aligned_alloc(64, 2 * bytes), *other = memory + bytes / sizeof *memory;
    const cgt_committed_scene committed_scene = b->loose->committed_scene;
    assert_non_null(memory);
    trace_lines(&committed_scene, &rays, width, height, false, memory);
    trace_lines(&committed_scene, &rays, width, height, true, other);
    assert_memory_equal(memory, other, bytes);
    free(memory);
}

/* Primitives in few tiles or none, so that other tiles stay empty. */
TEST(frames_of_sky)
{
    test_random r = random_make(360);
    frames_tally tally = {0};
    for (uint32_t round = 0; round < 6; round++) {
        cloud c = cloud_make(&r, CLOUD_UNIFORM, 100);
        cgt_camera camera = camera_before(&c);
        dual_scene b = dual_scene_of(queue_scene((const float(*)[4])c.sphere, c.count), 0);
        for (int a = 0; a < 3; a++) { /* to the side, with the cloud in a corner, or behind */
            const float away = camera.target[a] - camera.eye[a];
            camera.eye[a] -= 8 * away;
            camera.target[a] += (a == 0 ? 2 * c.reach : 0) - (round % 3 == 2 ? 20 * away : 0);
        }
        if (round > 2)
            make_orthographic(&r, 12 * c.reach, &camera);
        compare_frame(&b, &camera, 192, 128, "sky", &tally);
        compare_lines(&b, &camera);
        dual_scene_free(&b);
        cloud_free(&c);
    }
    print_tally("sky", &tally);
    assert_true(tally.served == tally.frames && tally.counts.hits > 0);
    assert_true(tally.counts.hits < tally.counts.rays / 8);
}

/* Scenes and pictures of sizes from 2^-36 to 2^36. */
TEST(orthographic_frames_at_every_scale)
{
    static const int exponent[] = {-36, -24, -8, 8, 24, 36};
    test_random r = random_make(350);
    frames_tally tally = {0};
    for (uint32_t round = 0; round < 6 + test_scaled(18); round++) {
        const float scale = ldexpf(1, exponent[round % 6]);
        cloud c = cloud_make(&r, round % 12 < 6 ? CLOUD_UNIFORM : CLOUD_MIXED, 200);
        for (uint32_t i = 0; i < 4 * c.count; i++)
            c.sphere[i / 4][i % 4] *= scale;
        for (int a = 0; a < 3; a++)
            c.middle[a] *= scale;
        c.reach *= scale;
        cgt_camera camera = round % 3 ? camera_random(&r, &c) : camera_before(&c);
        dual_scene b = dual_scene_of(queue_scene((const float(*)[4])c.sphere, c.count), 0);
        make_orthographic(&r, 2 * c.reach, &camera);
        compare_frame(&b, &camera, 70, 66, "scales", &tally);
        camera.height *= 0x1p-6f;
        compare_frame(&b, &camera, 70, 66, "scales", &tally);
        dual_scene_free(&b);
        cloud_free(&c);
    }
    print_tally("scales", &tally);
    assert_true(tally.parallel >= tally.frames / 2 && tally.counts.hits > 0);
}

/* Centres without adjacent radii, and one radius for all: layouts that no vector load reads. */
TEST(frames_of_two_geometries)
{
    test_random r = random_make(330);
    frames_tally tally = {0};
    for (uint32_t round = 0; round < test_scaled(4); round++) {
        cloud c = cloud_make(&r, CLOUD_UNIFORM, 400);
        float center[200][3];
        cgt_scene *scene;
        for (uint32_t i = 0; i < 200; i++)
            memcpy(center[i], c.sphere[200 + i], sizeof center[i]);
        const cgt_spheres second = {.count = 200, .centers = cgt_floats(center[0], 0), .radius = 0.1f * c.reach};
        cgt_spheres first = spheres_of((const float(*)[4])c.sphere, 200);
        const cgt_scene_options options = {.structure = CGT_STRUCTURE_QUEUE_GRID};
        assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &first), CGT_OK);
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &second), CGT_OK);
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        dual_scene b = dual_scene_of(scene, 0);
        cgt_camera camera = camera_before(&c);
        compare_frame(&b, &camera, 90, 40, "two geometries", &tally);
        make_orthographic(&r, c.reach, &camera);
        compare_frame(&b, &camera, 90, 40, "two geometries", &tally);
        dual_scene_free(&b);
        cloud_free(&c);
    }
    print_tally("two geometries", &tally);
    assert_true(tally.served == tally.frames && tally.counts.hits > 0);
}

/* The picture's height for a share of the scene's extent. */
static float height_of(const cgt_committed_scene *committed_scene, float share)
{
    float most = 0;
    for (int a = 0; a < 3; a++)
        most = fmaxf(most, committed_scene->high[a] - committed_scene->low[a]);
    const float height = most * share;
    return height > 0 && height < INFINITY ? height : 1;
}

/* Cameras at the origins of the hard rays, looking along them; then orthographic ones there. */
TEST(frames_of_hard_cases)
{
    frames_tally tally = {0};
    test_random r = random_make(335);
    uint32_t cases = 0;
    /* slow machines: smaller pictures, and one ray of each case for each opening angle below */
    const bool small = test_samples();
    const uint32_t width = small ? 13 : 21, height = small ? 11 : 23, rays_of_case = small ? 3 : 3 + test_scaled(5);
    for (size_t i = 0; i < hard_case_count(); i++) {
        const hard_case *h = hard_case_at(i);
        hard_scene s;
        cgt_scene *scene;
        const cgt_scene_options options = {.structure = CGT_STRUCTURE_QUEUE_GRID};
        assert_true(hard_case_make(h, rays_of_case, &s));
        assert_int_equal(hard_commit_with(context, &s, &options, &scene), CGT_OK);
        if (!scene->committed_scene.valid) {
            cgt_scene_release(scene);
            hard_scene_free(&s);
            continue;
        }
        cases++;
        dual_scene b = dual_scene_of(scene, 0);
        for (uint32_t k = 0; k < s.rays; k++) {
            cgt_camera camera;
            cgt_camera_rays rays;
            char message[160];
            const truth_ray *ray = &s.ray[k];
            cgt_camera_init(&camera);
            for (int a = 0; a < 3; a++) {
                camera.eye[a] = ray->org[a];
                camera.target[a] = ray->org[a] + ray->dir[a];
            }
            camera.up[0] = 0.3f;
            camera.fov = k % 3 ? 20.f * (float)(k % 3) : 1;
            if (cgt_camera_prepare(&camera, width, height, &rays, message) == CGT_OK)
                compare_frame(&b, &camera, width, height, h->name, &tally);
            make_orthographic(&r, height_of(&scene->committed_scene, random_log(&r, 1e-3f, 4)), &camera);
            if (cgt_camera_prepare(&camera, width, height, &rays, message) == CGT_OK)
                compare_frame(&b, &camera, width, height, h->name, &tally);
        }
        dual_scene_free(&b);
        hard_scene_free(&s);
    }
    print_tally("hard cases", &tally);
    assert_true(cases >= 3 && tally.served >= 3 && tally.parallel >= 3);
}

/* A wall that all rays hit at the same t, and another just behind it. If the range ends or begins there, double
 * precision must decide every pixel. */
TEST(frames_of_walls_where_ranges_end)
{
    const float wall = 3, behind = nextafterf(wall, 4), beyond = nextafterf(behind, 4), before = nextafterf(wall, 0);
    const float end[][2] = {{0, wall},          {0, before},        {0, behind},        {wall, INFINITY},
                            {behind, INFINITY}, {beyond, INFINITY}, {before, INFINITY}, {0, INFINITY}};
    const float z[2] = {-wall, -behind};
    float vertex[2][4][3];
    frames_tally tally = {0};
    uint64_t hits[sizeof end / sizeof end[0]];
    cgt_scene *scene;
    for (int w = 0; w < 2; w++)
        for (int k = 0; k < 4; k++) {
            vertex[w][k][0] = k & 1 ? 5.f : -5.f;
            vertex[w][k][1] = k & 2 ? 5.f : -5.f;
            vertex[w][k][2] = z[w];
        }
    const uint32_t index[4][3] = {{4, 5, 6}, {7, 6, 5}, {0, 1, 2}, {3, 2, 1}}; /* the nearer wall has higher indices */
    const cgt_triangles walls = {
        .count = 4, .indices = cgt_uint32s(index[0], 0), .vertex_count = 8, .vertices = cgt_floats(vertex[0][0], 0)};
    const cgt_scene_options options = {.structure = CGT_STRUCTURE_QUEUE_GRID};
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &walls), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    dual_scene b = dual_scene_of(scene, 0);
    for (size_t i = 0; i < sizeof end / sizeof end[0]; i++) {
        const uint64_t so_far = tally.counts.hits;
        cgt_camera camera;
        cgt_camera_init(&camera);
        camera.eye[2] = 0;
        camera.target[2] = -1;
        camera.t_min = end[i][0];
        camera.t_max = end[i][1];
        compare_frame(&b, &camera, 70, 66, "walls", &tally);
        hits[i] = tally.counts.hits - so_far;
    }
    print_tally("walls", &tally);
    assert_true(hits[7] > 0 && hits[0] == hits[7] && hits[1] == 0 && hits[2] == hits[7]);
    assert_true(hits[3] == hits[7] && hits[4] == hits[7] && hits[5] == 0 && hits[6] == hits[7]);
    dual_scene_free(&b);
}

/* ---- the march ---- */

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

VARIANT_SUITE("test_tile_frames", make_context, release_context)
