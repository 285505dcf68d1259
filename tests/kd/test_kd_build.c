/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The builder of kd-trees, before flattening: every primitive is in every leaf that it touches, decided exactly;
 * the tree is the same for any number of threads and any order of tasks; limits, degenerate scenes, refused memory. */
#define _POSIX_C_SOURCE 200809L
#include "kd/kd_build_cases.h"
#include "support/suite.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "papers/build/kd/split/kd_binned.h"
#include "structures/scenes/random_soup.h"

static cgt_context *one_thread;

/* Builds, and checks every leaf against every primitive. */
static void check_scene(const char *name, const cgt_scene *scene)
{
    cgt_buffer work = {NULL, 0};
    cgt_kd_raw raw;
    assert_int_equal(cgt_kd_build(one_thread, &work, &scene->committed_scene, &cgt_kd_default_costs, &raw), CGT_OK);
    const char *wrong = raw_tree_check(&raw, &scene->committed_scene, &cgt_kd_default_costs);
    if (wrong)
        fail_msg("%s: %s", name, wrong);
    cgt_buffer_release(&one_thread->memory, &work);
}

static cgt_scene *commit_soup(cgt_context *context, hard_scene *s)
{
    cgt_scene *scene = NULL;
    assert_int_equal(hard_commit(context, s, (const uint32_t[3]){0, 0, 0}, &scene), CGT_OK);
    return scene;
}

/* ---- scenes at random ---- */

TEST(test_leaves)
{
    for (int kind = 0; kind < SOUP_KINDS; kind++)
        for (uint32_t round = 0; round < 1 + test_scaled(4); round++) {
            hard_scene s = soup_make((soup_kind)kind, 100 * (uint64_t)kind + round, round % 2 ? 500 : 60);
            cgt_scene *scene = commit_soup(one_thread, &s);
            check_scene(soup_name((soup_kind)kind), scene);
            cgt_scene_release(scene);
            hard_scene_free(&s);
        }
    for (int kind = 0; kind < CLOUD_KINDS; kind++) {
        test_random r = random_make(2000 + (uint64_t)kind);
        cloud c = cloud_make(&r, (cloud_kind)kind, 300);
        cgt_scene *scene = scene_of(one_thread, NULL, (const float(*)[4])c.sphere, c.count);
        check_scene(cloud_name((cloud_kind)kind), scene);
        cgt_scene_release(scene);
        cloud_free(&c);
    }
}

/* Trees with a top, built chunk by chunk; in one scene from more than one chunk of primitives. */
TEST(test_large)
{
    const uint32_t count = 1500 + test_scaled(4500);
    for (int kind = 0; kind < SOUP_KINDS; kind++) {
        hard_scene s = soup_make((soup_kind)kind, 900 + (uint64_t)kind, kind == SOUP_MIXED ? count : count / 4);
        cgt_scene *scene = commit_soup(one_thread, &s);
        check_scene(soup_name((soup_kind)kind), scene);
        cgt_scene_release(scene);
        hard_scene_free(&s);
    }
}

/* ---- bins ---- */

/* What a node costs that is split there: items count on each side that they reach. The node is a cube of edge 16. */
static double cost_at(const cgt_kd_rules *rules, const cgt_kd_item *item, uint32_t count, uint32_t axis, float split)
{
    double below = 0, above = 0;
    for (uint32_t i = 0; i < count; i++) {
        below += item[i].low[axis] < split ? (double)item[i].weight : 0;
        above += item[i].high[axis] > split ? (double)item[i].weight : 0;
    }
    const double area_below = 256 + 32 * (double)split, area_above = 256 + 32 * (16 - (double)split);
    return rules->costs.inner + (area_below * below + area_above * above) / 768;
}

/* A cube has 16 bins along each axis. Items begin and end inside of bins, so that counting them tells what each plane
 * between two bins costs. */
TEST(bins_choose_the_cheapest_plane)
{
    const cgt_kd_rules rules = {.costs = {.inner = 0.4, .test = {1, 1}}};
    const cgt_kd_box box = {{0, 0, 0}, {16, 16, 16}};
    test_random r = random_make(800);
    uint32_t chosen = 0;
    for (uint32_t round = 0; round < 20 + test_scaled(500); round++) {
        cgt_kd_item item[40] = {{.high = {0.5f, 0.5f, 0.5f}, .weight = 1},
                                {.low = {15.5f, 15.5f, 15.5f}, .high = {16, 16, 16}, .weight = 1}};
        const uint32_t count = 14 + random_below(&r, 27), longest = 1 + random_below(&r, 16);
        for (uint32_t i = 2; i < count; i++) {
            item[i].weight = (float)(1 + random_below(&r, 3));
            for (int a = 0; a < 3; a++) {
                const uint32_t first = random_below(&r, 16), most = 16 - first < longest ? 16 - first : longest;
                item[i].low[a] = (float)first + 0.25f;
                item[i].high[a] = (float)(first + random_below(&r, most)) + 0.75f;
            }
        }
        cgt_float4 low = cgt_all4(INFINITY), high = cgt_all4(-INFINITY);
        cgt_kd_bins bins;
        const float weight = cgt_kd_bound_items(item, count, &low, &high);
        cgt_kd_plan_bins(&bins, low, high, count);
        assert_int_equal(bins.count, 16);
        cgt_kd_fill_bins(&bins, item, count);
        const cgt_kd_plane plane = cgt_kd_choose_binned(&rules, &bins, &box, weight);
        double least = (double)weight; /* of a leaf */
        for (uint32_t k = 0; k < 3 * 15; k++)
            least = fmin(least, cost_at(&rules, item, count, k % 3, (float)(1 + k / 3)));
        assert_true(fabs((double)plane.cost - least) <= 1e-4 * least);
        if (plane.axis == 3)
            continue;
        assert_true(fabs(cost_at(&rules, item, count, plane.axis, plane.split) - least) <= 1e-4 * least);
        chosen++;
    }
    assert_true(chosen > 10);
}

/* ---- degenerate scenes ---- */

TEST(test_degenerate)
{
    static const char *const name[DEGENERATE_KINDS] = {DEGENERATE_NAMES};
    for (int kind = 0; kind < DEGENERATE_KINDS; kind++)
        for (uint32_t count = 1; count <= 700; count = count < 4 ? count + 1 : 3 * count) {
            degenerate_scene d;
            degenerate_make(&d, (degenerate_kind)kind, count);
            cgt_scene *scene = degenerate_commit(one_thread, &d);
            check_scene(name[kind], scene);
            cgt_scene_release(scene);
            degenerate_free(&d);
        }
}

/* ---- the same tree ---- */

static uint64_t tree_of(cgt_context *context, const cgt_scene *scene)
{
    cgt_buffer work = {NULL, 0};
    cgt_kd_raw raw;
    assert_int_equal(cgt_kd_build(context, &work, &scene->committed_scene, &cgt_kd_default_costs, &raw), CGT_OK);
    const uint64_t hash = raw_tree_hash(&raw);
    cgt_buffer_release(&context->memory, &work);
    return hash;
}

static void check_same(cgt_context *other, const cgt_scene *scene)
{
    assert_true(tree_of(other, scene) == tree_of(one_thread, scene));
}

TEST(test_same_tree)
{
    for (int kind = 0; kind < SOUP_KINDS; kind++) {
        hard_scene s = soup_make((soup_kind)kind, 300 + (uint64_t)kind, 2500 + test_scaled(10000));
        cgt_scene *scene = commit_soup(one_thread, &s);
        static const uint32_t threads[] = {2, 3, 7};
        for (size_t i = 0; i < TEST_COUNT(threads); i++) {
            cgt_context *context = context_make(threads[i], NULL);
            check_same(context, scene);
            cgt_context_release(context);
        }
        unsigned batches = 0;
        cgt_context *context;
        cgt_context_options options;
        cgt_context_options_init(&options);
        options.tasks = (cgt_task_runner){&batches, run_backwards};
        assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
        check_same(context, scene);
        assert_true(batches > 8);
        cgt_context_release(context);
        cgt_scene_release(scene);
        hard_scene_free(&s);
    }
}

/* ---- limits ---- */

/* A fan: all triangles meet in a point, so that leaves there would be split forever. */
TEST(test_limits)
{
    degenerate_scene d;
    cgt_buffer work = {NULL, 0};
    cgt_kd_raw raw;
    cgt_kd_costs costs = {.inner = 1e-3, .test = {1, 1}, .empty_cut_off = 0};
    degenerate_make(&d, DEGENERATE_FAN, 300);
    cgt_scene *scene = degenerate_commit(one_thread, &d);
    assert_int_equal(cgt_kd_build(one_thread, &work, &scene->committed_scene, &costs, &raw), CGT_OK);
    const char *wrong = raw_tree_check(&raw, &scene->committed_scene, &costs);
    if (wrong)
        fail_msg("%s", wrong);
    assert_true(raw.limited_leaves > 0);
    costs.inner = 1e30; /* then a leaf is best, and no limit applies */
    assert_int_equal(cgt_kd_build(one_thread, &work, &scene->committed_scene, &costs, &raw), CGT_OK);
    assert_int_equal(raw.limited_leaves, 0);
    assert_true(cgt_kd_is_leaf(raw.node[0]));
    assert_int_equal(cgt_kd_count(raw.node[0]), scene->committed_scene.valid);
    cgt_buffer_release(&one_thread->memory, &work);
    cgt_scene_release(scene);
    degenerate_free(&d);
}

/* ---- memory ---- */

typedef struct counted {
    size_t calls, live, fail_at;
} counted;

static void *count_allocate(void *user, size_t bytes, size_t alignment)
{
    counted *c = user;
    void *memory = NULL;
    if (++c->calls == c->fail_at || posix_memalign(&memory, alignment, bytes))
        return NULL;
    memset(memory, 0xa5, bytes);
    c->live++;
    return memory;
}

static void count_release(void *user, void *memory, size_t bytes)
{
    counted *c = user;
    (void)bytes;
    c->live--;
    free(memory);
}

/* Each allocation of a build fails in turn; then the build succeeds, and a repeated build allocates nothing. */
static void check_memory(cgt_context *context, counted *c, const cgt_scene *scene)
{
    char text[256] = "";
    cgt_buffer work = {NULL, 0};
    cgt_kd_raw raw;
    size_t failures = 0;
    for (cgt_result result = CGT_ERROR_OUT_OF_MEMORY; result != CGT_OK; failures++) {
        c->calls = 0;
        c->fail_at = failures + 1;
        result = cgt_kd_build(context, &work, &scene->committed_scene, &cgt_kd_default_costs, &raw);
        if (result == CGT_OK)
            break;
        assert_int_equal(result, CGT_ERROR_OUT_OF_MEMORY);
        cgt_context_get_error_message(context, text, sizeof text);
        assert_non_null(strstr(text, "out of memory"));
    }
    assert_true(failures >= 1);
    const uint64_t hash = raw_tree_hash(&raw);
    c->calls = c->fail_at = 0;
    assert_int_equal(cgt_kd_build(context, &work, &scene->committed_scene, &cgt_kd_default_costs, &raw), CGT_OK);
    assert_int_equal(c->calls, 0);
    assert_true(raw_tree_hash(&raw) == hash);
    cgt_buffer_release(&context->memory, &work);
}

TEST(test_memory)
{
    counted c = {0, 0, 0};
    cgt_context *context;
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.threads = 2;
    options.memory = (cgt_memory_hooks){&c, count_allocate, count_release};
    assert_int_equal(cgt_context_create(&options, &context), CGT_OK);
    hard_scene s = soup_make(SOUP_MIXED, 5, 3000);
    cgt_scene *scene = commit_soup(context, &s);
    const size_t live = c.live;
    check_memory(context, &c, scene);
    assert_int_equal(c.live, live);
    cgt_scene_release(scene);
    cgt_context_release(context);
    assert_int_equal(c.live, 0);
    hard_scene_free(&s);
}

/* More primitives than a tree can number are refused before anything is read. */
TEST(test_too_many)
{
    static const uint32_t counts[] = {UINT32_MAX - 1, 0x80000000u, 0x40000000u, 0x20000000u};
    char text[256] = "";
    for (size_t i = 0; i < TEST_COUNT(counts); i++) {
        cgt_committed_scene committed_scene = {.valid = counts[i], .prims = {.count = counts[i]}};
        cgt_buffer work = {NULL, 0};
        cgt_kd_raw raw;
        assert_int_equal(cgt_kd_build(one_thread, &work, &committed_scene, &cgt_kd_default_costs, &raw),
                         CGT_ERROR_TOO_LARGE);
        cgt_context_get_error_message(one_thread, text, sizeof text);
        assert_non_null(strstr(text, "too many"));
        assert_null(work.data);
    }
}

int main(void)
{
    test_begin("test_kd_build");
    one_thread = context_make(1, NULL);
    const int failed = SUITE_RUN(NULL, NULL);
    cgt_context_release(one_thread);
    return failed;
}
