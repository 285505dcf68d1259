/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of triangles on a Cell by the kd program: ids are those of the library's EXACT, for any number of SPEs,
 * assignment, envelope, size of caches, ring of doubts, number of parts, in kd-trees with a stack and along ropes, and
 * in bounding interval hierarchies; secondary rays are occluded as cgt_occluded_rays says of the same rays, and
 * reflected ones meet what cgt_trace_rays says. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "cell/programs/kd/spe_kd.h"
#include "support/suite.h"
#include "cell/ppe/kd_library.h"

/* ---- scenes ---- */

static void make_random(test_random *r, uint32_t count, float size)
{
    kd_triangles = count;
    for (uint32_t i = 0; i < count; i++) {
        float center[3];
        for (int a = 0; a < 3; a++)
            center[a] = random_float(r, -1, 1);
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                kd_corner[i][k][a] = center[a] + random_float(r, -size, size);
    }
}

/* A hilly square of n x n quads, whose edges and vertices many rays meet. */
static void make_hills(test_random *r, uint32_t n)
{
    static float height[64][64];
    kd_triangles = 2 * n * n;
    for (uint32_t y = 0; y <= n; y++)
        for (uint32_t x = 0; x <= n; x++)
            height[y][x] = random_float(r, -0.1f, 0.1f);
    for (uint32_t k = 0; k < kd_triangles; k++) {
        const uint32_t x = k / 2 % n, y = k / 2 / n;
        static const uint32_t at[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
        for (int c = 0; c < 3; c++) {
            const uint32_t i = x + at[k % 2][c][0], j = y + at[k % 2][c][1];
            kd_corner[k][c][0] = 2 * (float)i / (float)n - 1;
            kd_corner[k][c][1] = 2 * (float)j / (float)n - 1;
            kd_corner[k][c][2] = height[j][i];
        }
    }
}

/* Of run k of a test: all three in turn. */
static cgt_structure structure_of(unsigned k)
{
    static const cgt_structure structure[] = {CGT_STRUCTURE_KD, CGT_STRUCTURE_KD_ROPES, CGT_STRUCTURE_BIH};
    return structure[k % 3];
}

static cgt_kd_frame_options make_options(test_random *r, unsigned k, cgt_structure structure)
{
    static const cgt_kd_cache_size nodes[] = {{0}, {1, 1}, {4, 3}}, references[] = {{0}, {1, 2}, {2, 4}},
                                   leaves[] = {{0}, {1, 0}, {2, 1}}, slots[] = {{0}, {1, 0}, {16, 8}, {8, 2}, {1, 10}};
    cgt_kd_frame_options o = {.cell = {.spes = 1 + k % 8, .function = kd_library_program(structure)}};
    o.cell.assignment = (cgt_assignment)(k % CGT_ASSIGNMENTS);
    o.cell.doubts_half = k & 2 ? 16 : 0;
    o.tiles_x = 1 + (uint32_t)random_bits(r) % 8;
    o.tiles_y = 1 + (uint32_t)random_bits(r) % 8;
    o.nodes = nodes[random_bits(r) % 3];
    o.references = references[random_bits(r) % 3];
    o.leaves = leaves[random_bits(r) % 3];
    o.triangles = slots[random_bits(r) % 5];
    o.batch = (uint32_t)random_bits(r) % 33;
    o.prefetch = random_bits(r) & 1;
    return o;
}

static void add_secondary(test_random *r, uint32_t parts, cgt_kd_frame_options *o)
{
    o->lights = (uint32_t)random_bits(r) % 3;
    o->ambient = (uint32_t)random_bits(r) % 4;
    for (uint32_t k = 0; k < o->lights; k++)
        for (int a = 0; a < 3; a++)
            o->light[k][a] = random_float(r, -3, 3);
    o->light_t_min = 0x1p-10f;
    o->ambient_t_min = 0x1p-10f;
    o->ambient_t_max = 1;
    o->mirror = parts == 1 && random_bits(r) & 1;
    o->mirror_t_min = 0x1p-10f;
    o->mirror_t_max = 0x1p20f;
}

TEST(random_scenes)
{
    test_random r = random_make(3011);
    for (unsigned k = 0, count = test_between(12, 36); k < count; k++) {
        const uint32_t parts = k / 3 % 3 == 2 ? 2 + k % 4 : 1;
        const cgt_structure structure = structure_of(k);
        make_random(&r, 1 + (uint32_t)random_bits(&r) % 600, k % 2 ? 0.1f : 0.4f);
        kd_library q = kd_library_make(parts, structure, (cgt_kd_layout)(k % 4));
        const cgt_camera camera = cell_random_camera(&r, 3);
        const uint32_t width = 1 + (uint32_t)random_bits(&r) % 60, height = 1 + (uint32_t)random_bits(&r) % 40;
        cgt_kd_frame_options o = make_options(&r, k, structure);
        if (k >= 9)
            add_secondary(&r, parts, &o);
        kd_library_check(&q, &camera, width, height, &o);
        kd_library_release(&q);
    }
}

/* Rays through edges and vertices, from the centre of the square along its axes; every triangle twice. */
TEST(hard_scenes)
{
    test_random r = random_make(3012);
    for (unsigned k = 0; k < 9; k++) {
        const cgt_structure structure = structure_of(k / 3);
        const uint32_t parts = k == 5 || k == 7 ? 3 : 1;
        make_hills(&r, 8 + 2 * k);
        if (k & 1) {
            memcpy(kd_corner[kd_triangles], kd_corner[0], kd_triangles * sizeof kd_corner[0]);
            kd_triangles *= 2;
        }
        if (k & 2)
            for (uint32_t i = 0; i < kd_triangles; i++)
                for (int c = 0; c < 3; c++)
                    kd_corner[i][c][2] = 0;
        kd_library q = kd_library_make(parts, structure, CGT_KD_LAYOUT_DEPTH_FIRST);
        cgt_camera camera;
        cgt_camera_init(&camera);
        camera.eye[0] = camera.eye[1] = 0;
        camera.eye[2] = 2;
        camera.fov = 45;
        cgt_kd_frame_options o = make_options(&r, k, structure);
        add_secondary(&r, parts, &o);
        kd_library_check(&q, &camera, 64, 64, &o);
        if (k & 1) /* each hit is a tie, and the ring is full again and again */
            assert_true(cell_result.doubts > 1000 || o.cell.keep_doubts);
        kd_library_release(&q);
    }
}

/* Between two hilly mirrors, of which each triangle is there twice: each reflected ray ends in a tie. */
TEST(reflections)
{
    test_random r = random_make(3019);
    for (unsigned k = 0; k < 3; k++) {
        make_hills(&r, 14);
        for (uint32_t copies = 0; copies < 2; copies++, kd_triangles *= 2)
            memcpy(kd_corner[kd_triangles], kd_corner[0], kd_triangles * sizeof kd_corner[0]);
        for (uint32_t i = kd_triangles / 2; i < kd_triangles; i++)
            for (int c = 0; c < 3; c++)
                kd_corner[i][c][2] += 2;
        kd_library q = kd_library_make(1, structure_of(k), CGT_KD_LAYOUT_AUTO);
        cgt_camera camera;
        cgt_camera_init(&camera);
        camera.eye[0] = 0.1f;
        camera.eye[2] = 1.5f;
        cgt_kd_frame_options o = make_options(&r, k, structure_of(k));
        o.mirror = true;
        o.mirror_t_min = 0x1p-10f;
        o.mirror_t_max = 0x1p20f;
        kd_library_check(&q, &camera, 48, 48, &o);
        print_message("%llu doubts\n", (unsigned long long)cell_result.doubts);
        assert_true(cell_result.doubts > 48 * 48);
        kd_library_release(&q);
    }
}

/* Without the PPE's decisions ids are wrong. */
TEST(doubts_matter)
{
    test_random r = random_make(3013);
    make_hills(&r, 44);
    for (unsigned k = 0; k < 3; k++) {
        kd_library q = kd_library_make(1, structure_of(k), CGT_KD_LAYOUT_AUTO);
        cgt_camera camera;
        cgt_camera_init(&camera);
        camera.eye[2] = 2;
        const cgt_kd_frame_options o = {.cell = {.spes = 2, .function = kd_library_program(structure_of(k))}};
        const uint32_t edge = test_samples() ? 48 : 96;
        kd_library_check(&q, &camera, edge, edge, &o);
        assert_int_equal(kd_library_run(&q, &camera, edge, edge, &o, &cell_result), CGT_OK);
        assert_true(cell_result.changed > 0);
        kd_library_release(&q);
    }
}

/* Vertices of any bits: right, or refused with a sentence. */
TEST(fuzzed_scenes)
{
    test_random r = random_make(3016);
    const unsigned count = test_between(32, 240);
    unsigned traced = 0;
    for (unsigned k = 0; k < count; k++) {
        const uint32_t kind = k % 4;
        kd_triangles = 1 + (uint32_t)random_bits(&r) % 12;
        for (uint32_t i = 0; i < 9 * kd_triangles; i++) {
            float *const x = &kd_corner[i / 9][i % 9 / 3][i % 3];
            const uint32_t bits = (uint32_t)random_bits(&r);
            if (kind == 0)
                memcpy(x, &bits, sizeof *x); /* infinities, NaN, subnormal numbers, any magnitude */
            else
                *x = ldexpf(random_float(&r, -1, 1), (int)(bits % (kind == 1 ? 60 : 4)) - (kind == 3 ? 100 : 20));
        }
        const cgt_structure structure = structure_of(k / 4);
        kd_library q = kd_library_make(1, structure, CGT_KD_LAYOUT_AUTO);
        const cgt_camera camera = cell_random_camera(&r, 3);
        cgt_kd_frame_options o = make_options(&r, k, structure);
        if (kind >= 2)
            add_secondary(&r, 1, &o);
        const cgt_result code = kd_library_run(&q, &camera, 20, 10, &o, &cell_result);
        if (code == CGT_OK) {
            kd_library_check(&q, &camera, 20, 10, &o);
            traced++;
        } else {
            assert_int_equal(code, CGT_ERROR_INVALID_ARGUMENT);
            assert_true(strlen(cell_result.message) > 10);
        }
        kd_library_release(&q);
    }
    assert_true(traced > count / 5);
}

/* What lays local store out, damaged: the program refuses it. */
TEST(damaged_images)
{
    static _Alignas(128) cgt_kd_control control;
    static _Alignas(128) cgt_kd_report report;
    static _Alignas(128) cgt_camera_image camera;
    static _Alignas(128) struct {
        cgt_kd_frame_image image;
        float direction[CGT_KD_DIRECTIONS][4];
    } frame;
    const cgt_kd_frame_image good = {.width = 8,
                                     .height = 8,
                                     .tiles_x = 4,
                                     .tiles_y = 4,
                                     .across = 1,
                                     .envelopes = 1,
                                     .batch = 16,
                                     .nodes = {1, 1},
                                     .references = {1, 2},
                                     .leaves = {1, 0},
                                     .triangles = {1, 0},
                                     .camera = {0, CGT_EA_CAMERA}};
    const struct {
        size_t word;
        uint32_t value;
    } damage[] = {{offsetof(cgt_kd_frame_image, width), 0},      {offsetof(cgt_kd_frame_image, height), 32769},
                  {offsetof(cgt_kd_frame_image, tiles_x), 0},    {offsetof(cgt_kd_frame_image, tiles_x), 17},
                  {offsetof(cgt_kd_frame_image, tiles_y), ~0u},  {offsetof(cgt_kd_frame_image, parts), 17},
                  {offsetof(cgt_kd_frame_image, batch), 0},      {offsetof(cgt_kd_frame_image, batch), 33},
                  {offsetof(cgt_kd_frame_image, nodes), 3},      {offsetof(cgt_kd_frame_image, nodes), 256},
                  {offsetof(cgt_kd_frame_image, nodes) + 4, 12}, {offsetof(cgt_kd_frame_image, references) + 4, 1},
                  {offsetof(cgt_kd_frame_image, leaves), 0},     {offsetof(cgt_kd_frame_image, triangles) + 4, 14},
                  {offsetof(cgt_kd_frame_image, lights), 5},     {offsetof(cgt_kd_frame_image, ambient), 65},
                  {offsetof(cgt_kd_frame_image, mirror), 2}};
    for (unsigned k = 0; k <= TEST_COUNT(damage); k++) {
        const cgt_cell_options options = {.spes = 1};
        const cgt_spe_program program = {.function = spe_kd, .argument = CGT_EA_CONTROL};
        cgt_cell *cell;
        control = (cgt_kd_control){.magic = CGT_KD_MAGIC,
                                   .half = k < TEST_COUNT(damage) ? 16 : 15,
                                   .frame = {0, CGT_KD_EA_FRAME},
                                   .report = {0, CGT_EA_REPORT}};
        report.state = CGT_KD_STATE_NONE;
        frame.image = good;
        if (k < TEST_COUNT(damage))
            memcpy((char *)&frame.image + damage[k].word, &damage[k].value, sizeof damage[k].value);
        assert_int_equal(cgt_cell_create(&options, &cell), CGT_OK);
        cgt_cell_add_memory(cell, CGT_EA_CONTROL, &control, sizeof control / 4, 4, false);
        cgt_cell_add_memory(cell, CGT_EA_REPORT, &report, sizeof report / 4, 4, true);
        cgt_cell_add_memory(cell, CGT_EA_CAMERA, &camera, sizeof camera / 4, 4, false);
        cgt_cell_add_memory(cell, CGT_KD_EA_FRAME, &frame, CGT_KD_FRAME_BYTES / 4, 4, false);
        assert_int_equal(cgt_cell_run_native(cell, &program, NULL, NULL), CGT_OK);
        cgt_cell_destroy(cell);
        if (report.state != CGT_KD_STATE_BAD_CONTROL)
            fail_msg("damage %u: state %u", k, (unsigned)report.state);
    }
}

typedef struct failing_memory {
    unsigned left; /* calls that succeed */
    long blocks;
} failing_memory;

static void *fail_later(void *user, size_t bytes, size_t alignment)
{
    failing_memory *const m = user;
    if (m->left == 0)
        return NULL;
    m->left--;
    m->blocks++;
    return aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

static void count_free(void *user, void *memory, size_t bytes)
{
    failing_memory *const m = user;
    (void)bytes;
    m->blocks--;
    free(memory);
}

/* Each allocation fails in turn: an error with a sentence, and nothing is lost. */
static void memory_fails_with(cgt_structure structure)
{
    test_random r = random_make(3017);
    cgt_camera camera;
    cgt_camera_init(&camera);
    make_random(&r, 40, 0.5f);
    kd_library q = kd_library_make(1, structure, CGT_KD_LAYOUT_AUTO);
    const cgt_scene *const scene = q.scene[0];
    const cgt_kd_frame_options o = {.cell = {.spes = 1, .function = kd_library_program(structure)},
                                    .mirror = true,
                                    .mirror_t_min = 0x1p-10f,
                                    .mirror_t_max = 1};
    static uint32_t ids[16 * 16];
    const cgt_kd_frame_output output = {.ids = ids};
    cgt_result code = CGT_ERROR_OUT_OF_MEMORY;
    unsigned failures = 0;
    for (unsigned k = 0; code != CGT_OK; k++, failures++) {
        failing_memory m = {.left = k};
        const cgt_memory_hooks hooks = {.user = &m, .allocate = fail_later, .release = count_free};
        cgt_kd_scene image;
        code = cgt_kd_scene_init(&image, &hooks, &scene, 1, cell_result.message);
        if (code == CGT_OK) {
            code = cgt_kd_frame_trace(&image, &camera, 16, 16, &o, &output, &cell_result);
            cgt_kd_scene_release(&image);
        }
        assert_int_equal(m.blocks, 0);
        assert_true(code == CGT_OK || (code == CGT_ERROR_OUT_OF_MEMORY && strstr(cell_result.message, "memory")));
    }
    assert_true(failures > 8);
    kd_library_release(&q);
}

TEST(memory_fails)
{
    memory_fails_with(CGT_STRUCTURE_KD_ROPES);
    memory_fails_with(CGT_STRUCTURE_BIH);
}

/* The program knows no masks: a camera that hides something is refused. */
TEST(masks_are_refused)
{
    test_random r = random_make(3018);
    static uint32_t ids[4 * 4];
    const cgt_kd_frame_output output = {.ids = ids};
    const cgt_kd_frame_options o = {.cell = {.spes = 1, .function = kd_library_program(CGT_STRUCTURE_KD)}};
    const cgt_memory_hooks hooks = {
        .allocate = fail_later, .release = count_free, .user = &(failing_memory){.left = 99}};
    cgt_camera camera;
    cgt_kd_scene image;
    cgt_triangles t;
    cgt_camera_init(&camera);
    make_random(&r, 40, 0.5f);
    kd_library q = kd_library_make(1, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_AUTO);
    uint32_t geometry = 0;
    assert_true(cgt_scene_get_triangles(q.scene[0], geometry, &t));
    t.mask = 1;
    assert_int_equal(cgt_scene_set_triangles(q.scene[0], &geometry, &t), CGT_OK);
    assert_int_equal(cgt_scene_commit(q.scene[0]), CGT_OK);
    const cgt_scene *const scene = q.scene[0];
    assert_int_equal(cgt_kd_scene_init(&image, &hooks, &scene, 1, cell_result.message), CGT_OK);
    for (camera.mask = 1; camera.mask <= 2; camera.mask++) {
        const cgt_result code = cgt_kd_frame_trace(&image, &camera, 4, 4, &o, &output, &cell_result);
        assert_int_equal(code, camera.mask == 1 ? CGT_OK : CGT_ERROR_INVALID_ARGUMENT);
    }
    assert_non_null(strstr(cell_result.message, "mask"));
    cgt_kd_scene_release(&image);
    kd_library_release(&q);
}

TEST(odd_pictures_and_scenes)
{
    static const uint32_t size[][2] = {{1, 1}, {2, 3}, {5, 1}, {33, 7}};
    test_random r = random_make(3014);
    make_random(&r, 50, 0.5f);
    kd_corner[3][1][0] = NAN;
    memcpy(kd_corner[4][1], kd_corner[4][0], sizeof kd_corner[4][0]); /* without area */
    cgt_camera camera;
    cgt_camera_init(&camera);
    cgt_kd_frame_options o = {.cell = {.spes = 3, .assignment = CGT_ASSIGN_DYNAMIC}, .lights = 1};
    o.light_t_min = 0x1p-8f;
    o.light[0][1] = 4;
    for (unsigned k = 0; k < 2 * TEST_COUNT(size); k++) {
        kd_library q = kd_library_make(1 + k / 2, structure_of(k), CGT_KD_LAYOUT_AUTO);
        o.cell.function = kd_library_program(structure_of(k));
        kd_library_check(&q, &camera, size[k / 2][0], size[k / 2][1], &o);
        kd_library_release(&q);
    }
    for (unsigned k = 1; k < 3; k++) {
        kd_library most = kd_library_make(CGT_KD_PARTS, structure_of(k), CGT_KD_LAYOUT_AUTO);
        o.cell.spes = CGT_MAX_SPES;
        o.cell.function = kd_library_program(structure_of(k));
        kd_library_check(&most, &camera, 40, 40, &o);
        kd_library_release(&most);
    }
    for (unsigned k = 0; k < 6; k++) { /* parts without triangles, too */
        kd_triangles = k % 3;
        kd_library q = kd_library_make(2, structure_of(k / 3 * 2), CGT_KD_LAYOUT_AUTO);
        o.cell.function = kd_library_program(structure_of(k / 3 * 2));
        kd_library_check(&q, &camera, 16, 16, &o);
        kd_library_release(&q);
    }
}

static void expect_refusal(const kd_library *q, const cgt_camera *camera, const cgt_kd_frame_options *o,
                           const char *words)
{
    cell_expect(kd_library_run(q, camera, 16, 16, o, &cell_result), cell_result.message, CGT_ERROR_INVALID_ARGUMENT,
                words);
}

TEST(refusals)
{
    test_random r = random_make(3015);
    cgt_camera camera;
    cgt_camera_init(&camera);
    make_random(&r, 10, 0.5f);
    kd_library q = kd_library_make(1, CGT_STRUCTURE_KD_ROPES, CGT_KD_LAYOUT_AUTO);
    const cgt_kd_frame_options good = {.cell = {.spes = 1, .function = spe_kd}};
    cgt_kd_frame_options o = good;
    o.cell.spes = 17;
    expect_refusal(&q, &camera, &o, "1 to 16 SPEs");
    o = good;
    o.tiles_x = 65;
    expect_refusal(&q, &camera, &o, "64 tiles");
    o = good;
    o.nodes = (cgt_kd_cache_size){3, 4};
    expect_refusal(&q, &camera, &o, "a power of two");
    o.nodes = (cgt_kd_cache_size){64, 9};
    expect_refusal(&q, &camera, &o, "131,072 bytes");
    o = good;
    o.lights = 1;
    expect_refusal(&q, &camera, &o, "between 0 and 1");
    o.light_t_min = 0.5f;
    o.light[0][2] = NAN;
    expect_refusal(&q, &camera, &o, "at most 2^19");
    o = good;
    o.mirror = true;
    expect_refusal(&q, &camera, &o, "reflected rays begin above 0");
    camera.eye[0] = 0x1p-110f;
    expect_refusal(&q, &camera, &good, "at least 2^-100");
    camera.eye[0] = 0;
    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    expect_refusal(&q, &camera, &good, "orthographic");
    cgt_camera_init(&camera);
    kd_library_release(&q);
    for (uint32_t i = 0; i < kd_triangles; i++)
        for (int c = 0; c < 9; c++)
            kd_corner[i][c / 3][c % 3] *= 0x1p41f;
    q = kd_library_make(1, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_AUTO);
    expect_refusal(&q, &camera, &good, "beyond 2^40");
    kd_library_release(&q);
    make_random(&r, 10, 0.5f);
    q = kd_library_make(1, CGT_STRUCTURE_KD_ROPES, CGT_KD_LAYOUT_AUTO);
    kd_library p = kd_library_make(1, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_AUTO);
    cgt_scene *const scene = p.scene[0];
    q.scene[q.parts++] = scene;
    expect_refusal(&q, &camera, &good, "some with ropes and some without");
    q.parts--;
    kd_library_release(&q);
    kd_library_release(&p);
}

/* The other program, hierarchies beside kd-trees, reflections with several parts, nodes that a DMA does not hold. */
TEST(refusals_of_hierarchies)
{
    test_random r = random_make(3018);
    cgt_camera camera;
    cgt_camera_init(&camera);
    make_random(&r, 40, 0.5f);
    kd_library q = kd_library_make(1, CGT_STRUCTURE_BIH, CGT_KD_LAYOUT_AUTO);
    kd_library p = kd_library_make(1, CGT_STRUCTURE_KD, CGT_KD_LAYOUT_AUTO);
    cgt_kd_frame_options o = {.cell = {.spes = 1, .function = spe_kd}};
    cell_expect(kd_library_run(&q, &camera, 16, 16, &o, &cell_result), cell_result.message, CGT_ERROR_STOPPED,
                "for the program spe_bih");
    o.cell.function = spe_bih;
    cell_expect(kd_library_run(&p, &camera, 16, 16, &o, &cell_result), cell_result.message, CGT_ERROR_STOPPED,
                "for the program spe_kd");
    o.nodes = (cgt_kd_cache_size){1, 11};
    expect_refusal(&q, &camera, &o, "1,024 of a bounding interval hierarchy");
    o.nodes.log2 = 10;
    kd_library_check(&q, &camera, 16, 16, &o);
    cgt_scene *const scene = p.scene[0];
    q.scene[q.parts++] = scene;
    expect_refusal(&q, &camera, &o, "of both kinds");
    q.parts--;
    kd_library_release(&q);
    kd_library_release(&p);
    q = kd_library_make(2, CGT_STRUCTURE_BIH, CGT_KD_LAYOUT_AUTO);
    o.mirror = true;
    o.mirror_t_min = 0x1p-10f;
    o.mirror_t_max = 1;
    expect_refusal(&q, &camera, &o, "one part");
    kd_library_release(&q);
}

SEEDED_SUITE("test_cell_kd", NULL, NULL)
