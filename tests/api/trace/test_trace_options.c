/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every machine gives the same bits, by a hash that all share. The statistics of a trace. Options and threads change no
 * bit: tests/driver compares them. */
#include "support/scenes.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- a picture ---- */

typedef struct picture {
    cloud spheres;
    cgt_camera camera;
    planes expected, got;
} picture;

static picture picture_make(uint64_t stream, cloud_kind kind, uint32_t count, uint32_t width, uint32_t height)
{
    test_random r = random_make(stream);
    picture p = {.spheres = cloud_make(&r, kind, count)};
    p.camera = camera_random(&r, &p.spheres);
    p.expected = planes_make(width, height);
    p.got = planes_make(width, height);
    cgt_context *context = context_make(1, "portable");
    cgt_scene *scene = scene_of(context, NULL, (const float(*)[4])p.spheres.sphere, p.spheres.count);
    frame_trace(scene, &p.camera, &p.expected, NULL);
    cgt_scene_release(scene);
    cgt_context_release(context);
    return p;
}

static void picture_free(picture *p)
{
    planes_free(&p->expected);
    planes_free(&p->got);
    cloud_free(&p->spheres);
}

static cgt_scene *structured(cgt_context *context, cgt_structure structure, const cloud *spheres)
{
    test_scene_options o = {0};
    o.structure = structure;
    return scene_of(context, SCENE_OPTIONS(&o), (const float(*)[4])spheres->sphere, spheres->count);
}

/* ---- every machine ---- */

/* Numbers from neither a library nor rounding: the same scene on every machine, whatever the seed. */
static float fixed_number(uint32_t *state, int bits)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)((int32_t)(*state >> 8) - (1 << 23)) * ldexpf(1, bits - 23);
}

static uint64_t hash(uint64_t h, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        h = (h ^ (word >> 8 * i & 255)) * UINT64_C(1099511628211);
    return h;
}

static uint32_t bits_of(float f)
{
    uint32_t u;
    memcpy(&u, &f, sizeof u);
    return u;
}

TEST(every_machine_gives_the_same_bits)
{
    enum { N = 700, RAYS = 3000 };
    uint32_t s = 12345;
    static float sphere[N][4];
    static truth_ray ray[RAYS];
    static ray_hit hit[RAYS];
    for (int i = 0; i < N; i++) {
        for (int a = 0; a < 3; a++)
            sphere[i][a] = fixed_number(&s, 4);
        sphere[i][3] = 0.25f + fabsf(fixed_number(&s, 0));
    }
    for (int i = 0; i < RAYS; i++) {
        for (int a = 0; a < 3; a++) {
            ray[i].org[a] = fixed_number(&s, 5);
            ray[i].dir[a] = fixed_number(&s, 3) - ray[i].org[a];
        }
        ray[i].t_min = 0;
        ray[i].t_max = INFINITY;
    }
    FOR_EACH_VARIANT(variant)
    for (uint32_t k = 0; k < TEST_STRUCTURES; k++) {
        cgt_context *context = context_make(2, variant);
        cgt_scene *scene =
            structured(context, structure_in_turn(k).structure, &(cloud){.count = N, .sphere = (float(*)[4])sphere});
        uint64_t h = UINT64_C(14695981039346656037);
        uint32_t hits = 0;
        rays_trace(scene, ray, RAYS, hit, NULL);
        for (int i = 0; i < RAYS; i++) {
            h = hash(hash(h, bits_of(hit[i].t)), hit[i].primitive);
            for (int a = 0; a < 3; a++)
                h = hash(h, bits_of(hit[i].normal[a]));
            hits += hit[i].primitive != CGT_INVALID_ID;
        }
        print_message("%s, structure %u: %u of %d rays hit, hash 0x%016llx\n", variant, k, hits, RAYS,
                      (unsigned long long)h);
        assert_true(h == UINT64_C(0x68da6853de4acb43)); /* recorded on x86-64; depends only on sphere_double.h */
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
}

/* ---- options and statistics ---- */

static cgt_trace_statistics count(const cgt_scene *scene, picture *p, test_trace_options o)
{
    cgt_trace_statistics s;
    cgt_research_trace_statistics r;
    memset(&s, 0xee, sizeof s);
    memset(&r, 0xee, sizeof r);
    o.statistics = &s;
    o.research_statistics = &r;
    frame_trace(scene, &p->camera, &p->got, TRACE_OPTIONS(&o));
    assert_true(planes_equal(&p->got, &p->expected));
    assert_int_equal(s.rays, p->got.elements);
    uint64_t hits = 0;
    for (size_t i = 0; i < p->got.elements; i++)
        hits += p->got.primitive[i] != CGT_INVALID_ID;
    assert_int_equal(s.hits, hits);
    assert_int_equal(s.invalid_rays, 0);
    assert_int_equal(r.loop, o.loop == CGT_LOOP_AUTO ? r.loop : o.loop);
    assert_int_equal(r.tile, o.tile == CGT_TILE_SHAPE_AUTO ? CGT_TILE_SHAPE_SQUARE : o.tile);
    assert_int_equal(r.packet_size, o.tile == CGT_TILE_SHAPE_STRIP ? 4 : o.packet ? o.packet : r.packet_size);
    assert_true(s.trace_ms >= 0 && s.packets > 0 && r.slices >= s.packets && r.cells > 0 && r.references > 0);
    assert_true(r.culled <= r.cull_tests && r.mailbox_skipped <= r.references && s.double_tests <= s.ray_tests);
    assert_true(s.packet_tests + r.culled + r.mailbox_skipped == r.references);
    assert_true(r.early_exits <= s.packets);
    assert_true(o.cull != CGT_CULL_NONE ? r.cull_tests == r.references - r.mailbox_skipped : r.cull_tests == 0);
    assert_true(o.mailbox != CGT_MAILBOX_OFF ? r.mailbox_skipped > 0 : r.mailbox_skipped == 0);
    return s;
}

TEST(statistics_add_up)
{
    picture p = picture_make(300, CLOUD_UNIFORM, 2000, test_between(64, 160), test_between(36, 90));
    uint64_t tests[2][3];
    for (uint32_t threads = 1; threads <= 3; threads += 2) {
        cgt_context *context = context_make(threads, NULL);
        cgt_scene *scene = structured(context, CGT_STRUCTURE_QUEUE_GRID, &p.spheres);
        for (int cull = 0; cull < 3; cull++) {
            test_trace_options o = {0};
            o.cull = (cgt_cull)(CGT_CULL_NONE + cull);
            const cgt_trace_statistics s = count(scene, &p, o);
            tests[threads / 2][cull] = s.ray_tests;
            o.mailbox = CGT_MAILBOX_OFF;
            count(scene, &p, o);
            o.loop = CGT_LOOP_FLATTENED;
            count(scene, &p, o);
            o.loop = CGT_LOOP_NESTED;
            for (o.packet = 4; o.packet <= 16; o.packet *= 2)
                count(scene, &p, o);
            o.packet = 0;
            o.tile = CGT_TILE_SHAPE_STRIP;
            count(scene, &p, o);
        }
        cgt_scene_release(scene);
        cgt_context_release(context);
    }
    for (int cull = 0; cull < 3; cull++)
        assert_int_equal(tests[0][cull], tests[1][cull]); /* the number of threads does not matter */
    print_message("ray tests: %llu without culling, %llu by frustum, %llu by blocks\n", (unsigned long long)tests[0][0],
                  (unsigned long long)tests[0][1], (unsigned long long)tests[0][2]);
    assert_true(tests[0][0] > tests[0][1] && tests[0][1] > tests[0][2]);
    picture_free(&p);
}

/* Tiles are used unless an option concerns packets. */
TEST(tiles_are_counted)
{
    picture p = picture_make(310, CLOUD_UNIFORM, 500, 160, 90);
    cgt_context *context = context_make(1, NULL);
    cgt_scene *scene = structured(context, CGT_STRUCTURE_LOOSE_GRID, &p.spheres);
    const cgt_camera camera = {.eye = {0, 0, -4}, .up = {0, 1, 0}, .fov = 45, .t_max = INFINITY};
    for (int k = 0; k < 6; k++) {
        cgt_trace_statistics s;
        test_trace_options o = {0};
        o.statistics = &s;
        o.packet = k == 1 ? 8 : 0;
        o.tile = k == 2 ? CGT_TILE_SHAPE_STRIP : CGT_TILE_SHAPE_AUTO;
        o.loop = k == 3 ? CGT_LOOP_NESTED : CGT_LOOP_AUTO;
        o.cull = k == 4 ? CGT_CULL_FRUSTUM : CGT_CULL_AUTO;
        o.mailbox = k == 5 ? CGT_MAILBOX_OFF : CGT_MAILBOX_AUTO;
        frame_trace(scene, &camera, &p.got, TRACE_OPTIONS(&o));
        assert_int_equal(s.rays, 160 * 90);
        assert_int_equal(s.tiles, k ? 0 : 3 * 2);
        assert_int_equal(s.packets != 0, k != 0);
    }
    cgt_scene_release(scene);
    cgt_context_release(context);
    picture_free(&p);
}

SEEDED_SUITE("test_trace_options", NULL, NULL)
