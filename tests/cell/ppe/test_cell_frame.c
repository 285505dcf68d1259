/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of spheres on a Cell: ids are those of the library's EXACT, for any number of SPEs, assignment, loop, culling
 * and ring of doubts; what does not fit is refused. The program runs native; where SPE_GRID_ELF names it as the SPU's
 * own compiler made it, simulated as well: the same ids, reports and DMA. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cell/ppe/grid/frame.h"
#include "cell/programs/grid/spe_grid.h"
#include "support/test.h"

#define MOST_PIXELS (1400 * 100)

static uint32_t expected[MOST_PIXELS], found[MOST_PIXELS];
static cgt_sphere sphere[CGT_GRID_SPHERES + 1];
static cgt_cell_frame_result result;

/* ---- pictures ---- */

static void trace_exact(uint32_t count, const cgt_camera *camera, uint32_t width, uint32_t height)
{
    cgt_context *context;
    cgt_scene *scene;
    const cgt_spheres s = {.count = count,
                           .centers = &sphere[0].x,
                           .center_stride = sizeof sphere[0],
                           .radii = &sphere[0].r,
                           .radius_stride = sizeof sphere[0]};
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_add_spheres(scene, &s, NULL), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    cgt_frame frame;
    cgt_frame_init(&frame, width, height);
    frame.primitive = expected;
    assert_int_equal(cgt_trace_camera(scene, camera, &frame, NULL), CGT_OK);
    cgt_scene_release(scene);
    cgt_context_release(context);
}

static cgt_result run_of(uint32_t count, const cgt_camera *camera, uint32_t width, uint32_t height,
                         const cgt_cell_frame_options *o, cgt_cell_frame_result *r)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    cgt_grid_scene scene;
    char message[CGT_PPE_MESSAGE_BYTES] = "";
    const cgt_result made = cgt_grid_scene_init(&scene, &memory, sphere, count, NULL, message);
    if (made != CGT_OK) {
        snprintf(r->message, sizeof r->message, "%s", message);
        return made;
    }
    memset(found, 0x55, sizeof found);
    const cgt_result code = cgt_cell_frame_trace(&scene, camera, width, height, o, found, r);
    cgt_grid_scene_release(&scene);
    return code;
}

static void check(uint32_t count, const cgt_camera *camera, uint32_t width, uint32_t height,
                  const cgt_cell_frame_options *o)
{
    if (run_of(count, camera, width, height, o, &result) != CGT_OK)
        fail_msg("%s", result.message);
    for (uint32_t i = 0; i < width * height; i++)
        if (found[i] != expected[i])
            fail_msg("%u spheres, %u x %u, %u SPEs, assignment %d: pixel %u, %u has sphere %d, not %d", count, width,
                     height, o->spes, (int)o->assignment, i % width, i / width, (int)found[i], (int)expected[i]);
}

#ifdef SPE_GRID_ELF
static char elf[1 << 20];
static uint32_t raw[MOST_PIXELS];
static cgt_cell_frame_result other;

static size_t load_elf(void)
{
    FILE *const file = fopen(SPE_GRID_ELF, "rb");
    if (!file)
        fail_msg("%s: cannot be opened", SPE_GRID_ELF);
    const size_t size = fread(elf, 1, sizeof elf, file);
    fclose(file);
    return size;
}

/* Simulated as native, with what an order of SPEs cannot change. */
static void compare_simulated(uint32_t count, const cgt_camera *camera, uint32_t width, uint32_t height,
                              const cgt_cell_frame_options *native)
{
    cgt_cell_frame_options o = *native;
    o.keep_doubts = true;
    if (run_of(count, camera, width, height, &o, &other) != CGT_OK)
        fail_msg("%s", other.message);
    memcpy(raw, found, sizeof raw);
    o.function = NULL;
    o.elf = elf;
    o.elf_bytes = load_elf();
    o.untimed = true;
    if (run_of(count, camera, width, height, &o, &result) != CGT_OK)
        fail_msg("%s", result.message);
    assert_memory_equal(raw, found, sizeof raw);
    for (unsigned i = 0; i < o.spes; i++) {
        cgt_cell_frame_spe *const a = &result.spe[i], *const b = &other.spe[i];
        a->report.built = a->report.traced = b->report.built = b->report.traced = 0;
        a->counts.wait_cycles = b->counts.wait_cycles = 0;
        assert_memory_equal(&a->report, &b->report, sizeof a->report);
        assert_memory_equal(&a->counts, &b->counts, sizeof a->counts);
    }
}
#else
static void compare_simulated(uint32_t count, const cgt_camera *camera, uint32_t width, uint32_t height,
                              const cgt_cell_frame_options *native)
{
    (void)count, (void)camera, (void)width, (void)height, (void)native;
}
#endif

/* ---- scenes ---- */

static void make_random(test_random *r, uint32_t count, float largest)
{
    for (uint32_t i = 0; i < count; i++)
        sphere[i] = (cgt_sphere){random_float(r, -1, 1), random_float(r, -1, 1), random_float(r, -1, 1),
                                 random_float(r, 0.01f, largest)};
}

static cgt_camera make_camera(test_random *r)
{
    cgt_camera c;
    cgt_camera_init(&c);
    for (int a = 0; a < 3; a++)
        c.eye[a] = random_float(r, -3, 3);
    c.fov = random_float(r, 20, 100);
    return c;
}

static void random_scenes(void **state)
{
    (void)state;
    test_random r = random_make(3001);
    for (unsigned k = 0; k < 8; k++) {
        const uint32_t count = 1 + (uint32_t)random_bits(&r) % 300;
        make_random(&r, count, k % 2 ? 0.05f : 0.1f);
        const cgt_camera camera = make_camera(&r);
        const uint32_t width = 1 + (uint32_t)random_bits(&r) % 90, height = 1 + (uint32_t)random_bits(&r) % 60;
        const cgt_cell_frame_options o = {.spes = 1 + k,
                                          .function = spe_grid,
                                          .assignment = (cgt_assignment)(k % CGT_ASSIGNMENTS),
                                          .nested = k & 1,
                                          .retest = k % 3 == 1,
                                          .cull = (cgt_cull)(k % 4),
                                          .doubts_half = k & 2 ? 16 : 0};
        trace_exact(count, &camera, width, height);
        check(count, &camera, width, height, &o);
        if (o.assignment == CGT_ASSIGN_INTERLEAVED || o.assignment == CGT_ASSIGN_STATIC || o.spes == 1)
            compare_simulated(count, &camera, width, height, &o);
    }
}

/* Every sphere ten times: each hit is a tie, and the ring of doubts is full again and again. */
static void coincident_spheres(void **state)
{
    (void)state;
    test_random r = random_make(3002);
    make_random(&r, 20, 0.2f);
    for (uint32_t i = 20; i < 100; i++)
        sphere[i] = sphere[i % 20];
    cgt_camera camera;
    cgt_camera_init(&camera);
    const cgt_cell_frame_options o = {.spes = 2, .function = spe_grid, .retest = true, .doubts_half = 16};
    trace_exact(100, &camera, 61, 35);
    check(100, &camera, 61, 35, &o);
    assert_true(result.interrupts > 10 && result.doubts > 1000);
    compare_simulated(100, &camera, 61, 35, &o);
}

/* Without the PPE's decisions ids are wrong: of two equal spheres the later one is met first, the earlier one wins. */
static void doubts_matter(void **state)
{
    (void)state;
    test_random r = random_make(3003);
    make_random(&r, 300, 0.1f);
    for (uint32_t i = 1; i < 300; i += 2)
        sphere[i] = sphere[i - 1];
    cgt_camera camera;
    cgt_camera_init(&camera);
    cgt_cell_frame_options o = {.spes = 1, .function = spe_grid};
    trace_exact(300, &camera, 64, 48);
    check(300, &camera, 64, 48, &o);
    assert_true(result.changed > 0);
    o.keep_doubts = true;
    assert_int_equal(run_of(300, &camera, 64, 48, &o, &result), CGT_OK);
    assert_int_not_equal(memcmp(found, expected, sizeof(uint32_t) * 64 * 48), 0);
}

static void odd_pictures_and_scenes(void **state)
{
    (void)state;
    static const uint32_t size[][2] = {{1, 1}, {2, 3}, {5, 1}, {33, 7}, {1283, 5}};
    test_random r = random_make(3004);
    make_random(&r, 50, 0.3f);
    sphere[3].r = -1;
    sphere[4].x = NAN;
    sphere[5].r = 0;
    cgt_camera camera;
    cgt_camera_init(&camera);
    camera.t_min = 4.5f;
    camera.t_max = 5.2f;
    const cgt_cell_frame_options o = {.spes = 3, .function = spe_grid, .assignment = CGT_ASSIGN_DYNAMIC};
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
    sphere[0].r = -1;
    check(1, &camera, 8, 8, &o);
}

static void expect_refusal(cgt_result code, uint32_t count, const cgt_camera *camera, const cgt_cell_frame_options *o,
                           const char *words)
{
    assert_int_equal(run_of(count, camera, 16, 16, o, &result), code);
    if (!strstr(result.message, words))
        fail_msg("\"%s\" does not say \"%s\"", result.message, words);
}

static void refusals(void **state)
{
    (void)state;
    test_random r = random_make(3005);
    cgt_camera camera;
    cgt_camera_init(&camera);
    cgt_cell_frame_options o = {.spes = 1, .function = spe_grid};
    make_random(&r, CGT_GRID_SPHERES + 1, 0.02f);
    expect_refusal(CGT_ERROR_TOO_LARGE, CGT_GRID_SPHERES + 1, &camera, &o, "room for 2048 spheres, 32768 bytes");
    for (uint32_t i = 0; i < 1000; i++)
        sphere[i].x = sphere[i].y = sphere[i].z = 0;
    expect_refusal(CGT_ERROR_TOO_LARGE, 1000, &camera, &o, "room for 256 more, 2048 bytes");
    sphere[0].x = 0x1p41f;
    expect_refusal(CGT_ERROR_INVALID_ARGUMENT, 1, &camera, &o, "beyond 2^40");
    sphere[0].x = 0;
    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    expect_refusal(CGT_ERROR_INVALID_ARGUMENT, 1, &camera, &o, "orthographic");
    cgt_camera_init(&camera);
    o.spes = 17;
    expect_refusal(CGT_ERROR_INVALID_ARGUMENT, 1, &camera, &o, "1 to 16 SPEs");
}

int main(void)
{
    test_begin("test_cell_frame");
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_scenes), cmocka_unit_test(coincident_spheres),
                                       cmocka_unit_test(doubts_matter), cmocka_unit_test(odd_pictures_and_scenes),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
