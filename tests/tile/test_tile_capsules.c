/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of capsules, alone and among spheres and triangles, by tiles are the same, bit for bit, as by streams through
 * the BVH. For the variant that this is compiled for. */
#include "support/suite.h"
#include "tile/tile_compare.h"

#include "kernel/tile_draw/tile_capsules.h"
#include "kernel/tile_frame/tile_planes.h"

static const uint32_t sizes[][2] = {{1, 1}, {65, 3}, {3, 70}, {64, 64}, {65, 63}, {100, 65}};

enum { MOST = 600 };

/* What is in a scene, in units of its scale. */
typedef struct capsule_scene {
    float capsule[MOST][7], sphere[MOST][4], vertex[3 * MOST][3];
    uint32_t capsules, spheres, triangles;
    float scale;
} capsule_scene;

typedef void place_capsule(capsule_scene *s, test_random *r, uint32_t i, float c[7]);

static void real_point(test_random *r, float reach, float p[3])
{
    for (int a = 0; a < 3; a++)
        p[a] = random_float(r, -reach, reach);
}

/* Bonds of like size. */
static void place_bond(capsule_scene *s, test_random *r, uint32_t i, float c[7])
{
    (void)s, (void)i;
    real_point(r, 1, c);
    for (int a = 0; a < 3; a++)
        c[3 + a] = c[a] + random_float(r, -0.1f, 0.1f);
    c[6] = 0.02f;
}

/* Each begins where another ends, with its radius: balls at the joints are hit at the same t. */
static void place_chain(capsule_scene *s, test_random *r, uint32_t i, float c[7])
{
    place_bond(s, r, i, c);
    if (i)
        memcpy(c, s->capsule[i - 1] + 3, 3 * sizeof *c);
    for (int a = 0; a < 3; a++)
        c[3 + a] = c[a] + random_float(r, -0.2f, 0.2f);
}

/* Of any length and radius; some thick, without a length or without a radius. */
static void place_any(capsule_scene *s, test_random *r, uint32_t i, float c[7])
{
    const float length = random_log(r, 1e-4f, 4);
    (void)s;
    real_point(r, 1, c);
    for (int a = 0; a < 3; a++)
        c[3 + a] = i % 17 == 3 ? c[a] : c[a] + length * random_float(r, -1, 1);
    c[6] = i % 19 == 4 ? 0 : random_log(r, 1e-5f, i % 64 == 9 ? 3 : 0.1f);
}

/* Along the axes, so that some are seen along theirs. */
static void place_upright(capsule_scene *s, test_random *r, uint32_t i, float c[7])
{
    const uint32_t axis = random_below(r, 3);
    (void)s, (void)i;
    for (int a = 0; a < 3; a++)
        c[a] = c[3 + a] = ((float)random_below(r, 9) - 4) / 4;
    c[3 + axis] += (float)(1 + random_below(r, 4)) / 4;
    c[6] = 0.0625f;
}

/* Copies, which the lower number wins, and ones that are all but copies. */
static void place_copy(capsule_scene *s, test_random *r, uint32_t i, float c[7])
{
    place_bond(s, r, i, c);
    if (i < 16)
        return;
    memcpy(c, s->capsule[i % 16], 7 * sizeof *c);
    const uint32_t k = random_below(r, 21);
    if (k < 7)
        c[k] = nextafterf(c[k], 4);
    if (k == 20) { /* the ends exchanged */
        memcpy(c, s->capsule[i % 16] + 3, 3 * sizeof *c);
        memcpy(c + 3, s->capsule[i % 16], 3 * sizeof *c);
    }
}

/* Long ones side by side, as the first one leans. */
static void place_parallel(capsule_scene *s, test_random *r, uint32_t i, float c[7])
{
    real_point(r, 1, c);
    for (int a = 0; a < 3; a++)
        c[3 + a] = c[a] + (i ? s->capsule[0][3 + a] - s->capsule[0][a] : random_float(r, -2, 2));
    c[6] = 0.005f;
}

/* One within the other, the smallest first, so that a tile's queue overflows. */
static void place_coaxial(capsule_scene *s, test_random *r, uint32_t i, float c[7])
{
    (void)s, (void)r;
    memcpy(c, (const float[6]){-0.5f, 0, 0, 0.5f, 0, 0}, 6 * sizeof *c);
    c[6] = 0.2f + 0x1p-20f * (float)i;
}

static const struct {
    const char *name;
    place_capsule *place;
} kinds[] = {{"bonds", place_bond},      {"chains", place_chain}, {"any", place_any},
             {"upright", place_upright}, {"copies", place_copy},  {"parallel", place_parallel},
             {"coaxial", place_coaxial}};

/* mixture: 1 spheres, of which some are balls at ends; 2 triangles. */
static void fill_scene(capsule_scene *s, test_random *r, place_capsule *place, uint32_t mixture, float scale)
{
    const uint32_t most = test_samples() ? MOST / 4 : MOST; /* emulators are slow */
    s->capsules = 1 + random_below(r, most);
    s->spheres = mixture & 1 ? 1 + random_below(r, most) : 0;
    s->triangles = mixture & 2 ? 1 + random_below(r, 100) : 0;
    s->scale = scale;
    for (uint32_t i = 0; i < s->capsules; i++)
        place(s, r, i, s->capsule[i]);
    for (uint32_t i = 0; i < s->spheres; i++) {
        real_point(r, 1, s->sphere[i]);
        if (i < s->capsules)
            memcpy(s->sphere[i], s->capsule[i] + 3, 3 * sizeof s->sphere[i][0]);
        s->sphere[i][3] = i % 3 ? 0.04f : i < s->capsules ? s->capsule[i][6] : 0.1f;
    }
    for (uint32_t i = 0; i < 3 * s->triangles; i++)
        for (int a = 0; a < 3; a++)
            s->vertex[i][a] = (i % 3 ? s->vertex[i - 1][a] : 0) + random_float(r, -1, 1);
    for (uint32_t i = 0; i < 7 * s->capsules; i++)
        s->capsule[i / 7][i % 7] *= scale;
    for (uint32_t i = 0; i < 4 * s->spheres; i++)
        s->sphere[i / 4][i % 4] *= scale;
    for (uint32_t i = 0; i < 9 * s->triangles; i++)
        s->vertex[i / 3][i % 3] *= scale;
}

static dual_scene commit_scene(const capsule_scene *s, double per_cell)
{
    const cgt_capsules capsules = {.count = s->capsules,
                                   .vertex_count = s->capsules,
                                   .vertices = cgt_floats(s->capsule[0], sizeof s->capsule[0]),
                                   .ends = cgt_floats(s->capsule[0] + 3, sizeof s->capsule[0]),
                                   .radii = cgt_floats(s->capsule[0] + 6, sizeof s->capsule[0])};
    const cgt_spheres spheres = spheres_of((const float(*)[4])s->sphere, s->spheres);
    const cgt_triangles triangles = {
        .count = s->triangles, .vertex_count = 3 * s->triangles, .vertices = cgt_floats(s->vertex[0], 0)};
    const cgt_scene_options options = {.structure = CGT_STRUCTURE_BVH};
    cgt_scene *scene;
    assert_int_equal(cgt_scene_create(context, &options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_capsules(scene, NULL, &capsules), CGT_OK);
    if (s->spheres)
        assert_int_equal(cgt_scene_set_spheres(scene, NULL, &spheres), CGT_OK);
    if (s->triangles)
        assert_int_equal(cgt_scene_set_triangles(scene, NULL, &triangles), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return dual_scene_of(scene, per_cell);
}

/* Around the scene, inside it, in a capsule, on an axis; with ranges. */
static cgt_camera view_of(const capsule_scene *s, test_random *r)
{
    const float *c = s->capsule[random_below(r, s->capsules)], share = random_float(r, -2, 3);
    const uint32_t how = random_below(r, 6);
    cgt_camera camera;
    cgt_camera_init(&camera);
    real_point(r, s->scale * (how < 2 ? 4 : 1), camera.eye);
    real_point(r, s->scale * 0.5f, camera.target);
    random_direction(r, camera.up);
    for (int a = 0; a < 3 && how >= 4; a++) { /* on the axis, along it or anywhere */
        camera.eye[a] = c[a] + share * (c[3 + a] - c[a]);
        camera.target[a] = how == 5 && c[3 + a] != c[a] ? camera.eye[a] + (c[3 + a] - c[a]) : camera.target[a];
    }
    camera.fov = random_below(r, 3) ? random_float(r, 20, 120) : random_log(r, 1, 20);
    if (random_below(r, 3) == 0)
        make_orthographic(r, s->scale * random_log(r, 0.03f, 6), &camera);
    if (random_below(r, 4) == 0)
        camera.t_min = s->scale * random_float(r, 0, 2);
    if (random_below(r, 4) == 0)
        camera.t_max = camera.t_min + s->scale * random_log(r, 1e-2f, 10);
    return camera;
}

TEST(frames_of_every_kind)
{
    static capsule_scene s;
    static const float scale[] = {1, 1, 0x1p-36f, 1e-3f, 0x1p36f, 100};
    for (uint32_t kind = 0; kind < TEST_COUNT(kinds); kind++) {
        test_random r = random_make(900 + kind);
        frames_tally tally = {0};
        for (uint32_t round = 0; round < (test_samples() ? 1 : 2) + test_scaled(22); round++) {
            fill_scene(&s, &r, kinds[kind].place, round % 4, scale[random_below(&r, TEST_COUNT(scale))]);
            dual_scene b = commit_scene(&s, round % 3 ? 0 : random_float(&r, 0.5f, 16));
            for (uint32_t i = 0; i < 3; i++) {
                const uint32_t *size = sizes[random_below(&r, TEST_COUNT(sizes))];
                const cgt_camera camera = view_of(&s, &r);
                cgt_camera_rays rays;
                char message[CGT_CAMERA_MESSAGE_BYTES];
                if (cgt_camera_prepare(&camera, size[0], size[1], &rays, message) == CGT_OK)
                    compare_frame(&b, &camera, size[0], size[1], kinds[kind].name, &tally);
            }
            dual_scene_free(&b);
        }
        print_tally(kinds[kind].name, &tally);
        assert_true(tally.served > tally.frames / 4 && tally.counts.hits > 0);
        assert_true(tally.parallel > 0 || test_samples());
    }
}

/* As many capsules as there may be, and nothing else. */
static dual_scene commit_most(place_capsule *place, uint64_t seed)
{
    static capsule_scene s;
    test_random r = random_make(seed);
    s = (capsule_scene){.capsules = MOST, .scale = 1};
    for (uint32_t i = 0; i < MOST; i++)
        place(&s, &r, i, s.capsule[i]);
    return commit_scene(&s, 0);
}

/* Windows and occlusion work, far fewer tests than capsules and rays; and single precision decides nearly all. */
TEST(frame_of_many_tiles)
{
    frames_tally tally = {0};
    cgt_camera camera;
    dual_scene b = commit_most(place_bond, 920);
    cgt_camera_init(&camera);
    camera.eye[2] = 4;
    compare_frame(&b, &camera, 200, 130, "many tiles", &tally);
    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    compare_frame(&b, &camera, 200, 130, "many tiles", &tally);
    print_tally("many tiles", &tally);
    assert_int_equal(tally.served, 2);
    assert_true(tally.counts.hits > tally.counts.rays / 8 && tally.counts.ray_tests < tally.counts.rays * 8);
    assert_true(tally.counts.double_tests < tally.counts.hits / 16);
    dual_scene_free(&b);
}

/* Each of a crowd is nearer than those before it: brought to the front, the nearest spares most others a decision. */
TEST(crowds_begin_with_the_nearest)
{
    frames_tally tally = {0};
    cgt_camera camera;
    dual_scene b = commit_most(place_coaxial, 925);
    cgt_camera_init(&camera);
    camera.eye[2] = 3;
    camera.fov = 40;
    compare_frame(&b, &camera, 64, 64, "a crowd", &tally);
    print_tally("a crowd", &tally);
    assert_int_equal(tally.served, 1);
    assert_true(tally.counts.double_tests < tally.counts.hits * MOST / 4 * 3); /* else each of them for each hit */
    dual_scene_free(&b);
}

/* No point of a capsule is nearer to the eye than the least distance, and all of its points that are seen lie in the
 * window. */
TEST(windows_hold_capsules)
{
    static capsule_scene s;
    static tile t;
    test_random r = random_make(930);
    uint64_t seen = 0, small = 0;
    for (uint32_t round = 0; round < (test_samples() ? 2 : 4) + test_scaled(36); round++) {
        fill_scene(&s, &r, round % 2 ? place_any : place_bond, 0, 1);
        dual_scene b = commit_scene(&s, 0);
        const cgt_committed_scene *w = &b.loose->committed_scene;
        const cgt_camera camera = view_of(&s, &r);
        const cgt_camera_rays rays = rays_of(&camera, TILE_EDGE, TILE_EDGE);
        const cgt_region region = {.width = TILE_EDGE, .height = TILE_EDGE};
        if (!cgt_tile_supports(w, &rays)) {
            dual_scene_free(&b);
            continue;
        }
        CGT_KERNEL(cgt_tile_init)(&t, w, &rays, &region);
        tile_ensure_pixels(&t);
        for (uint32_t first = 0; first < s.capsules; first += CGT_LANES) {
            uint32_t number[CGT_LANES];
            tile_capsules v;
            const uint32_t count = s.capsules - first < CGT_LANES ? s.capsules - first : CGT_LANES;
            for (uint32_t k = 0; k < count; k++)
                number[k] = first + k;
            tile_cull_capsules(&t, number, count, &w->prims, &v);
            for (uint32_t k = 0; k < count; k++)
                for (uint32_t i = 0; i < 40; i++) {
                    cgt_ray ray;
                    const uint32_t pixel = random_below(&r, TILE_PIXELS);
                    cgt_decided_hit hit = {.primitive = cgt_primitives_get(&w->prims, first + k)};
                    uint64_t exact = 0;
                    ray = tile_pixel_ray(&t, pixel);
                    if (!cgt_decide_hit(&ray, &hit, &exact))
                        continue;
                    double square = 0;
                    for (int a = 0; a < 3; a++)
                        square += (double)ray.line.dir[a] * (double)ray.line.dir[a];
                    const uint32_t x = tile_column(pixel), y = tile_row(pixel);
                    if (!(v.visible >> k & 1) || x < v.window.x0[k] || x > v.window.x1[k] || y < v.window.y0[k] ||
                        y > v.window.y1[k] || hit.t * sqrt(square) < (double)v.min_distance[k])
                        fail_msg("capsule %u: pixel %u, %u, distance %a", first + k, x, y, hit.t * sqrt(square));
                    seen++;
                    small += v.window.x1[k] - v.window.x0[k] < TILE_EDGE / 2;
                }
        }
        dual_scene_free(&b);
    }
    print_message("%llu hits, %llu in small windows\n", (unsigned long long)seen, (unsigned long long)small);
    assert_true(seen > 0 && small > 0);
}

VARIANT_SUITE("test_tile_capsules", make_context, release_context)
