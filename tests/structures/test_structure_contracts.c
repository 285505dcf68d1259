/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What every structure promises, of scenes of all kinds: none, few and many primitives, of extreme sizes and positions,
 * coincident, flat and spoilt ones. A checker recounts what a commit has built (structure_check.h). It is the same, bit
 * by bit, for any number of threads and any order of tasks, when it is built again, by another variant, and, of the
 * BVH, where a scene with a grid is prepared for rays. Each allocation fails in turn; a steady state allocates nothing.
 * With one variant. What is one structure's own is tested in its folder. */
#define _POSIX_C_SOURCE 200809L
#define SUITE_TEARDOWN say_last
static int say_last(void **state);

#include "structures/scenes/loose_scenes.h"
#include "support/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "builders/order/cell_sort.h"
#include "structures/check/bvh_check.h"
#include "structures/check/structure_check.h"

/* ---- what is built, and how ---- */

enum { BUILDERS = 5 };
static cgt_context *builders[BUILDERS]; /* of 1, 2, 3 and 7 threads, and a runner that begins with the last task */
static cgt_context *other;              /* of the narrowest variant */

static const test_way prepared = {.name = "AUTO, prepared"};

static char last[160]; /* the scene to look at where a test has failed */

static int say_last(void **state)
{
    (void)state;
    print_message("last: %s\n", last);
    return 0;
}

/* Only the BVH depends on the variant. With clusters, only what is of them, and scenes that get them. */
static bool is_tested(const test_way *w, int what)
{
    const bool clusters = w->serves & WAY_CLUSTERS && what == LOOSE_TRIANGLES;
    return (clusters || !clusters_always()) &&
           (w->scene.structure == CGT_STRUCTURE_BVH || variant_is_outer(CGT_VARIANT_NAME));
}

static cgt_result build(const test_way *w, cgt_scene *scene)
{
    const cgt_result result = cgt_scene_commit(scene);
    return w == &prepared && result == CGT_OK ? cgt_scene_prepare(scene, CGT_RAY_KIND_INCOHERENT) : result;
}

static cgt_scene *build_new(const test_way *w, cgt_context *context, const loose_scene *s)
{
    cgt_scene *scene = loose_add(s, context, SCENE_OPTIONS(&w->scene));
    if (build(w, scene) != CGT_OK)
        fail_msg("%s", context_message(context));
    return scene;
}

static void expect_same(const cgt_scene *a, const cgt_scene *b, const char *what)
{
    if (!structure_same(&a->committed_scene, &b->committed_scene))
        fail_msg("another structure: %s", what);
}

/* Checks the first one, and that the others are the same. */
static void check_scene(const test_way *w, const loose_scene *s, const char *name)
{
    snprintf(last, sizeof last, "%s, %s, %u geometries, the first of %u", w->name, name, s->geometries,
             s->geometries ? s->sphere[0] ? s->spheres[0].count : s->triangles[0].count : 0);
    cgt_scene *first = build_new(w, builders[0], s);
    structure_check(first);
    for (uint32_t k = 1; k < BUILDERS; k++) {
        cgt_scene *again = build_new(w, builders[k], s);
        expect_same(first, again, "other threads");
        cgt_scene_release(again);
    }
    if (w->scene.structure == CGT_STRUCTURE_BVH) {
        cgt_scene *beside = build_new(&prepared, builders[1], s);
        if (!bvh_equal(&first->committed_scene.bvh, &beside->committed_scene.bvh))
            fail_msg("another BVH is prepared");
        cgt_scene_release(beside);
    } else {
        cgt_scene *again = build_new(w, other, s);
        expect_same(first, again, "another variant");
        assert_int_equal(cgt_scene_commit(again), CGT_OK);
        expect_same(first, again, "built again");
        cgt_scene_release(again);
    }
    cgt_scene_release(first);
}

/* ---- scenes ---- */

TEST(scenes_of_all_kinds)
{
    static const unsigned sets[] = {WAY_CELLS, WAY_LAYOUT};
    const uint32_t most[] = {1, 9, 40, 40 + test_scaled(260)};
    test_random r = random_make(1);
    uint32_t turn = 0;
    for (size_t set = 0; set < TEST_COUNT(sets); set++)
        FOR_EACH_WAY(w, sets[set])
    for (int kind = 0; kind < LOOSE_KINDS; kind++)
        for (int what = LOOSE_SPHERES; what <= LOOSE_BOTH; what++) {
            const uint32_t count = 1 + random_below(&r, most[turn++ % TEST_COUNT(most)]);
            if (!is_tested(w, what))
                continue;
            loose_scene s = loose_make(&r, (loose_kind)kind, (loose_what)what, count);
            check_scene(w, &s, loose_name((loose_kind)kind));
            loose_free(&s);
        }
}

/* Empty geometries, and scenes of which nothing is left. */
TEST(few_and_none)
{
    test_random r = random_make(2);
    FOR_EACH_WAY(w, WAY_EACH)
    for (uint32_t count = 0; count < 6; count++)
        for (int kind = LOOSE_COINCIDENT; kind <= LOOSE_SPOILED && is_tested(w, LOOSE_TRIANGLES); kind++) {
            loose_scene s = loose_make(&r, (loose_kind)kind, clusters_always() ? LOOSE_TRIANGLES : LOOSE_BOTH, count);
            check_scene(w, &s, loose_name((loose_kind)kind));
            loose_free(&s);
        }
}

/* More primitives than a task takes, than one thread counts at once, and than one bin of cells holds. */
TEST(many)
{
    static const struct {
        loose_kind kind;
        loose_what what;
        uint32_t count;
    } rows[] = {{LOOSE_UNIFORM, LOOSE_SPHERES, CGT_CELL_SORT_DIRECT_SERIAL + 5003},
                {LOOSE_CLUSTERED, LOOSE_BOTH, 57000},
                {LOOSE_STADIUM, LOOSE_TRIANGLES, 57000},
                {LOOSE_SPOILED, LOOSE_BOTH, 57000},
                {LOOSE_ORDERS, LOOSE_SPHERES, 57000},
                {LOOSE_COINCIDENT, LOOSE_SPHERES, 57000}};
    test_random r = random_make(3);
    FOR_EACH_WAY(w, WAY_EACH)
    for (size_t k = 0; k < TEST_COUNT(rows); k++) {
        /* in the checkers of these, every pair of a cell and a primitive takes its time */
        const bool is_slow = w->papers && w->scene.structure != CGT_STRUCTURE_BIH;
        const uint32_t count = test_between(17000, rows[k].count);
        if (!is_tested(w, rows[k].what) || (is_slow && k > 1))
            continue;
        loose_scene s = loose_make(&r, rows[k].kind, rows[k].what, is_slow ? 12000 : count);
        check_scene(w, &s, loose_name(rows[k].kind));
        loose_free(&s);
    }
}

/* ---- memory ---- */

typedef struct memory {
    size_t calls, live, fail_at; /* the call that gets NULL, from 1; 0: none */
} memory;

static void *hook_allocate(void *user, size_t bytes, size_t alignment)
{
    memory *m = user;
    void *p = NULL;
    if (++m->calls == m->fail_at ||
        posix_memalign(&p, alignment < sizeof p ? sizeof p : alignment, bytes ? bytes : 1) != 0)
        return NULL;
    m->live++;
    return memset(p, 0xa5, bytes);
}

static void hook_release(void *user, void *p, size_t bytes)
{
    (void)bytes;
    ((memory *)user)->live--;
    free(p);
}

/* Allocation number `fail` of a build fails. Then it succeeds, and builds the same without any. Returns whether there
 * was such a one; where it was the scratch of a further thread, the build does not need it. */
static bool build_failing(const test_way *w, const loose_scene *s, const cgt_scene *expected, size_t fail,
                          uint32_t threads)
{
    memory m = {0};
    const cgt_context_options options = {
        .threads = threads, .variant = CGT_VARIANT_NAME, .memory = {&m, hook_allocate, hook_release}};
    cgt_context *context = NULL;
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    cgt_scene *scene = loose_add(s, context, SCENE_OPTIONS(&w->scene));
    const size_t fail_at = m.fail_at = m.calls + fail;
    cgt_result result = build(w, scene);
    const bool failed = m.calls >= fail_at;
    assert_true(failed || result == CGT_OK);
    if (result != CGT_OK) {
        assert_int_equal(result, CGT_ERROR_OUT_OF_MEMORY);
        assert_non_null(strstr(context_message(context), "out of memory"));
    }
    for (int frame = 0; frame < 4; frame++) {
        const size_t calls = m.calls;
        m.fail_at = 0;
        assert_int_equal(build(w, scene), CGT_OK);
        assert_true(frame < 2 || m.calls == calls);
    }
    expect_same(scene, expected, "after a failure");
    cgt_scene_release(scene);
    cgt_context_release(context);
    assert_int_equal(m.live, 0);
    return failed;
}

static void fail_each(const test_way *w, uint32_t count, uint32_t threads)
{
    test_random r = random_make(4);
    loose_scene s = loose_make(&r, LOOSE_UNIFORM, clusters_always() ? LOOSE_TRIANGLES : LOOSE_BOTH, count);
    size_t fail = 1;
    snprintf(last, sizeof last, "%s, failing allocations", w->name);
    cgt_scene *expected = build_new(w, builders[0], &s);
    structure_check(expected);
    while (build_failing(w, &s, expected, fail, threads))
        fail++;
    assert_true(fail > 3);
    cgt_scene_release(expected);
    loose_free(&s);
}

TEST(every_allocation_fails)
{
    FOR_EACH_WAY(w, WAY_EACH)
    for (uint32_t threads = 1; threads <= 2 && is_tested(w, LOOSE_TRIANGLES); threads++)
        fail_each(w, threads == 1 ? 1000 : w->papers ? 3000 : test_between(2000, 70000), threads);
    fail_each(&prepared, 1000, 1);
    fail_each(&prepared, test_between(2000, 70000), 2);
}

int main(void)
{
    static const uint32_t threads[BUILDERS] = {1, 2, 3, 7};
    test_begin("test_structure_contracts");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    for (uint32_t k = 0; k < BUILDERS; k++) {
        cgt_context_options options = {.threads = threads[k], .variant = CGT_VARIANT_NAME};
        if (!threads[k])
            options.tasks = (cgt_task_runner){NULL, run_backwards};
        if (cgt_context_create(&options, &builders[k]) != CGT_OK)
            return 1;
    }
    other = context_make(1, cgt_get_variant_names()[0]);
    const int failed = SUITE_RUN(NULL, NULL);
    for (uint32_t k = 0; k < BUILDERS; k++)
        cgt_context_release(builders[k]);
    cgt_context_release(other);
    return failed;
}
