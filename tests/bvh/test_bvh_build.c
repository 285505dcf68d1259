/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Builds BVHs with one variant and checks their invariants (bvh_check.h). The scenes have extreme sizes and positions,
 * and primitives that no cell separates. The tree has the same bits for any number of threads, and whether a commit or
 * ray calls build it. Each allocation fails in turn, and a steady state allocates nothing. */
#define _POSIX_C_SOURCE 200809L
#include "grid/loose_scenes.h"
#include "support/suite.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"
#include "bvh/bvh_check.h"
#include "vector.h"

static cgt_context *contexts[2]; /* of one thread, and of two */

static void check_tree(const cgt_scene *scene, const char *what)
{
    const char *wrong = bvh_check(&scene->committed_scene);
    const cgt_research_scene_statistics research = research_of(scene);
    cgt_scene_statistics st;
    if (wrong)
        fail_msg("%s: %s", what, wrong);
    assert_int_equal(cgt_scene_get_statistics(scene, &st), CGT_OK);
    assert_int_equal(research.bvh_nodes, scene->committed_scene.bvh.nodes);
    assert_int_equal(research.bvh_leaves,
                     scene->committed_scene.bvh.sphere_blocks + scene->committed_scene.bvh.triangle_blocks);
    assert_int_equal(research.bvh_depth, scene->committed_scene.bvh.depth);
    assert_true(st.bytes >= st.bvh_bytes && !st.bvh_bytes == !research.bvh_nodes);
}

static cgt_scene_options options_of(cgt_structure structure)
{
    cgt_scene_options o;
    cgt_scene_options_init(&o);
    o.structure = structure;
    return o;
}

/* Traces this many rays, all of them invalid: they are cheap, but count as rays. */
static cgt_result trace_invalid_rays(const cgt_scene *scene, uint64_t rays)
{
    float *zero = calloc(rays, sizeof *zero);
    uint8_t *occluded = malloc(rays);
    const cgt_rays all = {.count = rays, .org = {zero, zero, zero}, .dir = {zero, zero, zero}};
    assert_true(zero && occluded);
    const cgt_result result = cgt_occluded_rays(scene, &all, occluded, NULL);
    free(zero);
    free(occluded);
    return result;
}

/* ---- scenes of both kinds ---- */

static void check_scene(const loose_scene *s, const char *what)
{
    const cgt_scene_options explicit_bvh = options_of(CGT_STRUCTURE_BVH), automatic = options_of(CGT_STRUCTURE_AUTO);
    cgt_scene *scene[4];
    for (int k = 0; k < 4; k++) {
        scene[k] = loose_add(s, contexts[k % 2], k < 2 ? &explicit_bvh : &automatic);
        assert_int_equal(cgt_scene_commit(scene[k]), CGT_OK);
        if (k >= 2)
            assert_int_equal(trace_invalid_rays(scene[k], scene[k]->committed_scene.valid / 8 + 1), CGT_OK);
        check_tree(scene[k], what);
        if (!bvh_equal(&scene[0]->committed_scene.bvh, &scene[k]->committed_scene.bvh))
            fail_msg("%s: tree %d differs", what, k);
    }
    for (int k = 0; k < 4; k++)
        cgt_scene_release(scene[k]);
}

/* With clusters, only scenes that get them. */
static bool is_tested(int what) { return what == LOOSE_TRIANGLES || !clusters_always(); }

TEST(test_scenes)
{
    test_random r = random_make(1);
    for (int kind = 0; kind < LOOSE_KINDS; kind++)
        for (int what = LOOSE_SPHERES; what <= LOOSE_BOTH; what++)
            for (uint32_t k = 0; k < 4 && is_tested(what); k++) {
                const uint32_t most[4] = {1, 40, 1000, test_scaled(20000)};
                loose_scene s = loose_make(&r, (loose_kind)kind, (loose_what)what, 1 + random_below(&r, most[k]));
                check_scene(&s, loose_name((loose_kind)kind));
                loose_free(&s);
            }
}

/* Many ranges, and keys that need bins. */
TEST(test_many)
{
    test_random r = random_make(2);
    for (int what = LOOSE_SPHERES; what <= LOOSE_BOTH; what++) {
        if (!is_tested(what))
            continue;
        loose_scene s = loose_make(&r, what == LOOSE_BOTH ? LOOSE_STADIUM : LOOSE_CLUSTERED, (loose_what)what,
                                   test_between(20000, 150000));
        check_scene(&s, "many");
        loose_free(&s);
    }
}

/* ---- primitives that cells do not separate ---- */

typedef void place(uint32_t i, uint32_t count, float sphere[4]);

static void at_one_position(uint32_t i, uint32_t count, float q[4])
{
    (void)count;
    q[0] = 0.25f;
    q[1] = -3;
    q[2] = 7;
    q[3] = i % 3 ? 0.5f : 0.75f;
}

/* Each half as far away as the previous one. */
static void by_powers(uint32_t i, uint32_t count, float q[4])
{
    (void)count;
    q[0] = ldexpf(1, 50 - (int)(i % 190));
    q[1] = q[2] = q[3] = 0;
}

static void by_powers_in_space(uint32_t i, uint32_t count, float q[4])
{
    (void)count;
    for (uint32_t a = 0; a < 3; a++)
        q[a] = ldexpf(1 + (float)(i % 7) / 8, 40 - (int)((i * 7 + a * 59) % 160));
    q[3] = 0;
}

static void on_a_line(uint32_t i, uint32_t count, float q[4])
{
    q[0] = (float)i / (float)count;
    q[1] = q[2] = 0;
    q[3] = 0.001f;
}

static void one_far_away(uint32_t i, uint32_t count, float q[4])
{
    on_a_line(i, count, q);
    q[1] = (float)(i % 71);
    if (!i)
        q[2] = 1e12f;
}

static void one_large(uint32_t i, uint32_t count, float q[4])
{
    on_a_line(i * 31 % count, count, q);
    q[1] = (float)(i % 71) / 71;
    q[3] = i ? 0.001f : 10;
}

static void two_heaps(uint32_t i, uint32_t count, float q[4])
{
    (void)count;
    q[0] = i % 2 ? 1 : nextafterf(1, 2);
    q[1] = q[2] = 0;
    q[3] = 1;
}

static void smallest_numbers(uint32_t i, uint32_t count, float q[4])
{
    (void)count;
    for (uint32_t a = 0; a < 3; a++)
        q[a] = 0x1p-149f * (float)((i >> a * 3) % 9);
    q[3] = 0x1p-149f * (float)(i % 3);
}

TEST(test_places)
{
    static const struct {
        place *place;
        const char *name;
    } places[] = {{at_one_position, "one place"},
                  {by_powers, "powers"},
                  {by_powers_in_space, "powers in space"},
                  {on_a_line, "line"},
                  {one_far_away, "far away"},
                  {one_large, "large"},
                  {two_heaps, "two heaps"},
                  {smallest_numbers, "denormal"}};
    const uint32_t counts[] = {1, CGT_LANES, CGT_LANES + 1, 5 * CGT_LANES, 999, test_between(5000, 70000)};
    if (clusters_always()) /* all places are spheres */
        skip();
    for (size_t p = 0; p < TEST_COUNT(places); p++)
        for (size_t n = 0; n < TEST_COUNT(counts); n++) {
            float(*sphere)[4] = malloc(counts[n] * sizeof *sphere);
            assert_non_null(sphere);
            for (uint32_t i = 0; i < counts[n]; i++)
                places[p].place(i, counts[n], sphere[i]);
            const cgt_spheres all = spheres_of((const float(*)[4])sphere, counts[n]);
            loose_scene s = {.spheres = {all}, .geometries = 1, .sphere = {true}};
            check_scene(&s, places[p].name);
            free(sphere);
        }
}

TEST(test_empty)
{
    const cgt_scene_options o = options_of(CGT_STRUCTURE_BVH);
    const float nowhere[1][4] = {{NAN, 0, 0, 1}};
    for (uint32_t count = 0; count < 2; count++) {
        cgt_scene *scene = scene_of(contexts[0], &o, nowhere, count);
        assert_null(scene->committed_scene.bvh.node);
        assert_int_equal(trace_invalid_rays(scene, 10), CGT_OK);
        cgt_scene_release(scene);
    }
}

/* ---- when rays build the BVH ---- */

TEST(test_threshold)
{
    test_random r = random_make(3);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, 8000);
    const cgt_scene_options o = options_of(CGT_STRUCTURE_AUTO), grid = options_of(CGT_STRUCTURE_LOOSE_GRID);
    cgt_scene *scene = scene_of(contexts[0], &o, (const float(*)[4])c.sphere, c.count);
    cgt_scene *grid_scene = scene_of(contexts[0], &grid, (const float(*)[4])c.sphere, c.count);
    for (int round = 0; round < 2; round++) {
        assert_int_equal(trace_invalid_rays(scene, 150), CGT_OK);
        assert_null(scene->committed_scene.bvh.node);
        assert_int_equal(trace_invalid_rays(scene, 150), CGT_OK);
        assert_non_null(scene->committed_scene.bvh.node);
        check_tree(scene, "threshold");
        assert_int_equal(cgt_scene_set_options(scene, &o), CGT_OK); /* forgets that rays alone came */
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
        assert_null(scene->committed_scene.bvh.node);
    }
    assert_int_equal(trace_invalid_rays(grid_scene, 20000), CGT_OK);
    assert_null(grid_scene->committed_scene.bvh.node);
    cgt_scene_release(grid_scene);
    cgt_scene_release(scene);
    cloud_free(&c);
}

static void *trace_on_thread(void *scene)
{
    for (int i = 0; i < 20; i++)
        if (trace_invalid_rays(scene, 300) != CGT_OK)
            return scene;
    return NULL;
}

TEST(test_several_threads)
{
    test_random r = random_make(4);
    const cgt_scene_options o = options_of(CGT_STRUCTURE_AUTO);
    for (uint32_t round = 0; round < test_between(2, 10); round++) {
        cloud c = cloud_make(&r, CLOUD_UNIFORM, 9000);
        cgt_scene *scene = scene_of(contexts[round % 2], &o, (const float(*)[4])c.sphere, c.count);
        pthread_t thread[4];
        void *failed = NULL;
        for (size_t i = 0; i < TEST_COUNT(thread); i++)
            assert_int_equal(pthread_create(&thread[i], NULL, trace_on_thread, scene), 0);
        for (size_t i = 0; i < TEST_COUNT(thread); i++) {
            assert_int_equal(pthread_join(thread[i], &failed), 0);
            assert_null(failed);
        }
        assert_non_null(scene->committed_scene.bvh.node);
        check_tree(scene, "several threads");
        cgt_scene_release(scene);
        cloud_free(&c);
    }
}

/* ---- memory ---- */

typedef struct memory {
    size_t calls, fail_at; /* the call that gets NULL, from 1; 0: none */
} memory;

static void *hook_allocate(void *user, size_t bytes, size_t alignment)
{
    memory *m = user;
    void *p = NULL;
    if (++m->calls == m->fail_at)
        return NULL;
    return posix_memalign(&p, alignment < sizeof p ? sizeof p : alignment, bytes) ? NULL : memset(p, 0xa5, bytes);
}

static void hook_release(void *user, void *p, size_t bytes)
{
    (void)user;
    (void)bytes;
    free(p);
}

static cgt_context *context_of(memory *m, uint32_t threads)
{
    cgt_context_options o;
    cgt_context *context;
    cgt_context_options_init(&o);
    o.threads = threads;
    o.variant = CGT_VARIANT_NAME;
    o.memory = (cgt_memory_hooks){m, hook_allocate, hook_release};
    assert_int_equal(cgt_context_create(&o, &context), CGT_OK);
    return context;
}

/* Builds a scene's BVH by rays; allocation number `fail` of the build fails. Returns whether there was such a one:
 * where it was the scratch of a further thread, the build needs it not. */
static bool build_failing(const loose_scene *s, const cgt_scene_options *o, size_t fail, uint32_t threads)
{
    memory m = {0};
    cgt_context *context = context_of(&m, threads);
    cgt_scene *scene = loose_add(s, context, o);
    const bool lazy = o->structure == CGT_STRUCTURE_AUTO;
    if (lazy)
        assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    const size_t fail_at = m.fail_at = m.calls + fail;
    cgt_result result = lazy ? trace_invalid_rays(scene, scene->committed_scene.valid) : cgt_scene_commit(scene);
    const bool failed = m.calls >= fail_at;
    assert_true(failed || result == CGT_OK);
    if (result != CGT_OK) {
        assert_int_equal(result, CGT_ERROR_OUT_OF_MEMORY);
        assert_true(cgt_context_get_error_message(context, NULL, 0) > 0);
        assert_true(!lazy || (!scene->committed_scene.bvh.node && scene->is_committed));
        m.fail_at = 0;
        result = lazy ? trace_invalid_rays(scene, scene->committed_scene.valid) : cgt_scene_commit(scene);
    }
    assert_int_equal(result, CGT_OK);
    check_tree(scene, "memory");
    cgt_scene_release(scene);
    cgt_context_release(context);
    return failed;
}

TEST(test_every_allocation_fails)
{
    test_random r = random_make(5);
    const cgt_scene_options o[2] = {options_of(CGT_STRUCTURE_AUTO), options_of(CGT_STRUCTURE_BVH)};
    for (int k = 0; k < 4; k++) {
        /* many primitives with threads: the grid's pairs take the place of the centres */
        loose_scene s = loose_make(&r, LOOSE_UNIFORM, clusters_always() ? LOOSE_TRIANGLES : LOOSE_BOTH,
                                   k < 2 ? 1000 : test_between(2000, 70000));
        size_t fail = 1;
        while (build_failing(&s, &o[k % 2], fail, 1 + (uint32_t)k / 2))
            fail++;
        assert_true(fail > 6);
        loose_free(&s);
    }
}

/* Primitives move, and nothing is allocated once the scene has been built in a similar state. */
TEST(test_steady_state)
{
    test_random r = random_make(6);
    cloud c = cloud_make(&r, CLOUD_UNIFORM, test_between(3000, 30000));
    memory m = {0};
    cgt_context *context = context_of(&m, 2);
    for (int lazy = 0; lazy < 2; lazy++) {
        const cgt_scene_options o = options_of(lazy ? CGT_STRUCTURE_AUTO : CGT_STRUCTURE_BVH);
        cgt_scene *scene = scene_of(context, &o, (const float(*)[4])c.sphere, c.count);
        size_t calls = 0;
        for (int frame = 0; frame < 12; frame++) {
            for (uint32_t i = 0; i < c.count; i++)
                c.sphere[i][frame % 3] += 0.01f * c.sphere[i][3] * random_float(&r, -1, 1);
            assert_int_equal(cgt_scene_commit(scene), CGT_OK);
            if (lazy)
                assert_int_equal(trace_invalid_rays(scene, c.count), CGT_OK);
            check_tree(scene, "steady state");
            if (!frame)
                calls = m.calls;
        }
        assert_int_equal(m.calls, calls);
        cgt_scene_release(scene);
    }
    cgt_context_release(context);
    cloud_free(&c);
}

int main(void)
{
    test_begin("test_bvh_build");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    for (uint32_t k = 0; k < 2; k++)
        contexts[k] = context_make(k + 1, CGT_VARIANT_NAME);
    const int failed = SUITE_RUN(NULL, NULL);
    for (uint32_t k = 0; k < 2; k++)
        cgt_context_release(contexts[k]);
    return failed;
}
