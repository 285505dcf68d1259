/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of spheres on a Cell: ids are those of the library's EXACT, for any number of SPEs, assignment, loop, culling
 * and ring of doubts; what does not fit is refused. The program runs native; where SPE_GRID_ELF names it as the SPU's
 * own compiler made it, simulated as well: the same ids, reports and DMA. */
#include <math.h>
#include <string.h>

#include "cell/ppe/cell_frames.h"
#include "support/suite.h"
#include "cell/programs/grid/spe_grid.h"

#define MOST_PIXELS (1400 * 100)

static uint32_t expected[MOST_PIXELS], found[MOST_PIXELS];

/* ---- pictures ---- */

static void trace_exact(uint32_t count, const cgt_camera *camera, uint32_t width, uint32_t height)
{
    cgt_context *context;
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    cgt_scene *const scene = cell_library_scene(context, &cell_sphere[0].x, count);
    cgt_frame frame;
    cgt_frame_init(&frame, width, height);
    frame.primitive = expected;
    assert_int_equal(cgt_trace_camera(scene, camera, &frame, NULL), CGT_OK);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

static cgt_result run_of(uint32_t count, const cgt_camera *camera, uint32_t width, uint32_t height,
                         const cgt_grid_frame_options *o, cgt_cell_frame_result *r)
{
    memset(found, 0x55, sizeof found);
    return cell_grid_trace(count, camera, width, height, o, found, r);
}

static void check(uint32_t count, const cgt_camera *camera, uint32_t width, uint32_t height,
                  const cgt_grid_frame_options *o)
{
    if (run_of(count, camera, width, height, o, &cell_result) != CGT_OK)
        fail_msg("%s", cell_result.message);
    for (uint32_t i = 0; i < width * height; i++)
        if (found[i] != expected[i])
            fail_msg("%u spheres, %u x %u, %u SPEs, assignment %d: pixel %u, %u has sphere %d, not %d", count, width,
                     height, o->cell.spes, (int)o->cell.assignment, i % width, i / width, (int)found[i],
                     (int)expected[i]);
}

/* Simulated as native, with what an order of SPEs cannot change. */
static void compare_simulated(uint32_t count, const cgt_camera *camera, uint32_t width, uint32_t height,
                              const cgt_grid_frame_options *native)
{
    static uint32_t raw[MOST_PIXELS];
    static cgt_cell_frame_result other;
    cgt_grid_frame_options o = *native;
    o.cell.keep_doubts = true;
    cgt_grid_frame_options simulated = o;
    if (!cell_simulate(&simulated.cell, SPE_GRID_ELF))
        return;
    if (run_of(count, camera, width, height, &o, &other) != CGT_OK)
        fail_msg("%s", other.message);
    memcpy(raw, found, sizeof raw);
    if (run_of(count, camera, width, height, &simulated, &cell_result) != CGT_OK)
        fail_msg("%s", cell_result.message);
    assert_memory_equal(raw, found, sizeof raw);
    cell_compare_spes(&cell_result, &other, o.cell.spes, false);
}

/* ---- scenes ---- */

TEST(random_scenes)
{
    test_random r = random_make(3001);
    for (unsigned k = 0; k < 8; k++) {
        const uint32_t count = 1 + (uint32_t)random_bits(&r) % 300;
        cell_random_spheres(&r, count, k % 2 ? 0.05f : 0.1f);
        const cgt_camera camera = cell_random_camera(&r, 3);
        const uint32_t width = 1 + (uint32_t)random_bits(&r) % 90, height = 1 + (uint32_t)random_bits(&r) % 60;
        const cgt_grid_frame_options o = {.cell = {.spes = 1 + k,
                                                   .function = spe_grid,
                                                   .assignment = (cgt_assignment)(k % CGT_ASSIGNMENTS),
                                                   .doubts_half = k & 2 ? 16 : 0},
                                          .nested = k & 1,
                                          .retest = k % 3 == 1,
                                          .cull = (cgt_cull)(k % 4)};
        trace_exact(count, &camera, width, height);
        check(count, &camera, width, height, &o);
        compare_simulated(count, &camera, width, height, &o);
    }
}

/* Every sphere ten times: each hit is a tie, and the ring of doubts is full again and again. */
TEST(coincident_spheres)
{
    test_random r = random_make(3002);
    cell_random_spheres(&r, 20, 0.2f);
    for (uint32_t i = 20; i < 100; i++)
        cell_sphere[i] = cell_sphere[i % 20];
    cgt_camera camera;
    cgt_camera_init(&camera);
    const cgt_grid_frame_options o = {.cell = {.spes = 2, .function = spe_grid, .doubts_half = 16}, .retest = true};
    trace_exact(100, &camera, 61, 35);
    check(100, &camera, 61, 35, &o);
    assert_true(cell_result.interrupts > 10 && cell_result.doubts > 1000);
    compare_simulated(100, &camera, 61, 35, &o);
}

/* Without the PPE's decisions ids are wrong: of two equal spheres the later one is met first, the earlier one wins. */
TEST(doubts_matter)
{
    test_random r = random_make(3003);
    cell_random_spheres(&r, 300, 0.1f);
    for (uint32_t i = 1; i < 300; i += 2)
        cell_sphere[i] = cell_sphere[i - 1];
    cgt_camera camera;
    cgt_camera_init(&camera);
    cgt_grid_frame_options o = {.cell = {.spes = 1, .function = spe_grid}};
    trace_exact(300, &camera, 64, 48);
    check(300, &camera, 64, 48, &o);
    assert_true(cell_result.changed > 0);
    o.cell.keep_doubts = true;
    assert_int_equal(run_of(300, &camera, 64, 48, &o, &cell_result), CGT_OK);
    assert_int_not_equal(memcmp(found, expected, sizeof(uint32_t) * 64 * 48), 0);
}

TEST(odd_pictures_and_scenes)
{
    static const uint32_t size[][2] = {{1, 1}, {2, 3}, {5, 1}, {33, 7}, {1283, 5}};
    test_random r = random_make(3004);
    cell_random_spheres(&r, 50, 0.3f);
    cell_sphere[3].r = -1;
    cell_sphere[4].x = NAN;
    cell_sphere[5].r = 0;
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.t_min = 4.5f;
    camera.t_max = 5.2f;
    const cgt_grid_frame_options o = {.cell = {.spes = 3, .function = spe_grid, .assignment = CGT_ASSIGN_DYNAMIC}};
    for (unsigned k = 0; k < TEST_COUNT(size); k++) {
        trace_exact(50, &camera, size[k][0], size[k][1]);
        check(50, &camera, size[k][0], size[k][1], &o);
    }
    for (uint32_t count = 1; count < 4; count++) { /* spheres much larger than a cell */
        trace_exact(count, &camera, 16, 16);
        check(count, &camera, 16, 16, &o);
    }
    for (unsigned i = 0; i < 64; i++)
        expected[i] = CGT_INVALID_ID;
    check(0, &camera, 8, 8, &o);
    cell_sphere[0].r = -1;
    check(1, &camera, 8, 8, &o);
}

static void expect_refusal(cgt_result code, uint32_t count, const cgt_camera *camera, const cgt_grid_frame_options *o,
                           const char *words)
{
    cell_expect(run_of(count, camera, 16, 16, o, &cell_result), cell_result.message, code, words);
}

TEST(refusals)
{
    test_random r = random_make(3005);
    cgt_camera camera;
    cgt_camera_init(&camera);
    cgt_grid_frame_options o = {.cell = {.spes = 1, .function = spe_grid}};
    cell_random_spheres(&r, CGT_GRID_SPHERES + 1, 0.02f);
    expect_refusal(CGT_ERROR_TOO_LARGE, CGT_GRID_SPHERES + 1, &camera, &o, "room for 2048 spheres, 32768 bytes");
    for (uint32_t i = 0; i < 1000; i++)
        cell_sphere[i].x = cell_sphere[i].y = cell_sphere[i].z = 0;
    expect_refusal(CGT_ERROR_TOO_LARGE, 1000, &camera, &o, "room for 256 more, 2048 bytes");
    cell_sphere[0].x = 0x1p41f;
    expect_refusal(CGT_ERROR_INVALID_ARGUMENT, 1, &camera, &o, "beyond 2^40");
    cell_sphere[0].x = 0;
    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    expect_refusal(CGT_ERROR_INVALID_ARGUMENT, 1, &camera, &o, "orthographic");
    cgt_camera_init(&camera);
    o.cell.spes = 17;
    expect_refusal(CGT_ERROR_INVALID_ARGUMENT, 1, &camera, &o, "1 to 16 SPEs");
}

SEEDED_SUITE("test_cell_frame", NULL, NULL)
