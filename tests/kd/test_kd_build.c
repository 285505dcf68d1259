/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The builder of kd-trees: the plane that it chooses among bins, and its limits. */
#include <math.h>
#include <string.h>

#include "papers/build/kd/kd_build.h"
#include "papers/build/kd/split/kd_binned.h"
#include "scene/scene.h"
#include "structures/scenes/loose_scenes.h"
#include "support/suite.h"

static cgt_context *one_thread;

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

/* ---- limits ---- */

/* A fan: all triangles meet in a point, so that leaves there would be split forever. */
TEST(test_limits)
{
    test_random r = random_make(1);
    loose_scene fan = loose_make(&r, LOOSE_FAN, LOOSE_TRIANGLES, 300);
    cgt_buffer work = {NULL, 0};
    cgt_kd_raw raw;
    cgt_kd_costs costs = {.inner = 1e-3, .test = {1, 1}, .empty_cut_off = 0};
    cgt_scene *scene = loose_add(&fan, one_thread, NULL);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    assert_int_equal(cgt_kd_build(one_thread, &work, &scene->committed_scene, &costs, &raw), CGT_OK);
    assert_true(raw.limited_leaves > 0);
    costs.inner = 1e30; /* then a leaf is best, and no limit applies */
    assert_int_equal(cgt_kd_build(one_thread, &work, &scene->committed_scene, &costs, &raw), CGT_OK);
    assert_int_equal(raw.limited_leaves, 0);
    assert_true(cgt_kd_is_leaf(raw.node[0]));
    assert_int_equal(cgt_kd_count(raw.node[0]), scene->committed_scene.valid);
    cgt_buffer_release(&one_thread->memory, &work);
    cgt_scene_release(scene);
    loose_free(&fan);
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
