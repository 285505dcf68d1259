/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of triangles on a Cell by the kd program: ids are those of the library's EXACT, for any number of SPEs,
 * assignment, envelope, size of caches, ring of doubts, number of parts, with a stack and along ropes; secondary rays
 * are occluded as cgt_occluded_rays says of the same rays. The program runs native; where SPE_KD_ELF names it as the
 * SPU's own compiler made it, simulated as well: the same ids, rays, reports and DMA. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgt/research.h>

#include "cell/ppe/kd_frame.h"
#include "cell/programs/kd/spe_kd.h"
#include "support/test.h"

#define MOST_PIXELS (96 * 96)
#define MOST_TRIANGLES 4096u
#define MOST_BATCHES 6u

static float corner[MOST_TRIANGLES][3][3];
static uint32_t triangles;
static uint32_t expected[MOST_PIXELS], found[MOST_PIXELS];
static float direction[MOST_PIXELS][3];
static float rays[MOST_BATCHES * MOST_PIXELS][6];
static uint8_t occluded[MOST_BATCHES * MOST_PIXELS];
static cgt_kd_frame_result result;

/* ---- scenes of the library ---- */

typedef struct library {
    cgt_context *context;
    cgt_scene *scene[CGT_KD_PARTS], *all;
    uint32_t parts;
} library;

static cgt_scene *make_scene(cgt_context *context, const cgt_research_scene_options *research, uint32_t first,
                             uint32_t count)
{
    cgt_scene *scene;
    const cgt_scene_options o = {.structure = research ? CGT_STRUCTURE_KD : CGT_STRUCTURE_AUTO, .research = research};
    const cgt_triangles t = {.count = count,
                             .vertex_count = 3 * count,
                             .vertices = count ? &corner[first][0][0] : NULL};
    assert_int_equal(cgt_scene_create(context, &o, &scene), CGT_OK);
    assert_int_equal(cgt_scene_add_triangles(scene, &t, NULL), CGT_OK);
    return scene;
}

/* The triangles in equal parts, with or without ropes; and all of them for the library. */
static library make_library(uint32_t parts, bool ropes, cgt_kd_layout layout)
{
    const cgt_research_scene_options research = {.kd_layout = layout, .kd_break_level = 3};
    library q = {.parts = parts};
    assert_int_equal(cgt_context_create(NULL, &q.context), CGT_OK);
    for (uint32_t k = 0; k < parts; k++) {
        const uint32_t first = (uint32_t)((uint64_t)triangles * k / parts),
                       end = (uint32_t)((uint64_t)triangles * (k + 1) / parts);
        cgt_scene_options o = {.structure = ropes ? CGT_STRUCTURE_KD_ROPES : CGT_STRUCTURE_KD, .research = &research};
        const cgt_triangles t = {.count = end - first,
                                 .vertex_count = 3 * (end - first),
                                 .vertices = end > first ? &corner[first][0][0] : NULL};
        assert_int_equal(cgt_scene_create(q.context, &o, &q.scene[k]), CGT_OK);
        assert_int_equal(cgt_scene_add_triangles(q.scene[k], &t, NULL), CGT_OK);
        assert_int_equal(cgt_scene_commit(q.scene[k]), CGT_OK);
    }
    q.all = make_scene(q.context, NULL, 0, triangles);
    assert_int_equal(cgt_scene_commit(q.all), CGT_OK);
    return q;
}

static void release_library(library *q)
{
    for (uint32_t k = 0; k < q->parts; k++)
        cgt_scene_release(q->scene[k]);
    cgt_scene_release(q->all);
    cgt_context_release(q->context);
}

/* ---- runs ---- */

static cgt_result run_of(const library *q, const cgt_camera *camera, uint32_t width, uint32_t height,
                         const cgt_kd_frame_options *o, cgt_kd_frame_result *r)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    const cgt_kd_frame_output output = {found, direction, rays, occluded};
    const cgt_scene *scene[CGT_KD_PARTS];
    cgt_kd_scene image;
    char message[CGT_PPE_MESSAGE_BYTES] = "";
    for (uint32_t k = 0; k < q->parts; k++)
        scene[k] = q->scene[k];
    memset(found, 0x55, sizeof found);
    cgt_result code = cgt_kd_scene_init(&image, &memory, scene, q->parts, message);
    if (code != CGT_OK) {
        snprintf(r->message, sizeof r->message, "%s", message);
        return code;
    }
    code = cgt_kd_frame_trace(&image, camera, width, height, o, &output, r);
    cgt_kd_scene_release(&image);
    return code;
}

static void compare_ids(const library *q, const cgt_camera *camera, uint32_t width, uint32_t height)
{
    cgt_frame frame;
    cgt_frame_init(&frame, width, height);
    frame.primitive = expected;
    const cgt_trace_options exact = {.precision = CGT_PRECISION_EXACT};
    assert_int_equal(cgt_trace_camera(q->all, camera, &frame, &exact), CGT_OK);
    for (uint32_t i = 0; i < width * height && result.spe[0].report.envelopes; i++) {
        float org[3], dir[3];
        assert_int_equal(cgt_camera_get_ray(camera, width, height, i % width, i / width, org, dir), CGT_OK);
        assert_memory_equal(direction[i], dir, sizeof dir);
    }
    for (uint32_t i = 0; i < width * height; i++)
        if (found[i] != expected[i])
            fail_msg("%u triangles in %u parts, %u x %u: pixel %u, %u has triangle %d, not %d", triangles, q->parts,
                     width, height, i % width, i / width, (int)found[i], (int)expected[i]);
}

/* The library's answer for the same rays; a ray is there where the pixel has a hit. */
static void compare_secondary(const library *q, const cgt_kd_frame_options *o, uint32_t pixels)
{
    const cgt_trace_options exact = {.precision = CGT_PRECISION_EXACT};
    static uint8_t right[MOST_PIXELS];
    for (uint32_t b = 0; b < o->lights + o->ambient; b++) {
        const float(*from)[6] = (const float(*)[6])rays + (size_t)b * pixels;
        const cgt_rays r = {.count = pixels,
                            .stride = sizeof rays[0],
                            .org = {&from[0][0], &from[0][1], &from[0][2]},
                            .dir = {&from[0][3], &from[0][4], &from[0][5]}};
        cgt_rays ranged = r;
        static float range[MOST_PIXELS][6];
        for (uint32_t i = 0; i < pixels; i++) {
            const bool none = occluded[b * pixels + i] == CGT_KD_NO_RAY;
            range[i][0] = b < o->lights ? o->light_t_min : o->ambient_t_min;
            range[i][1] = none ? -1 : b < o->lights ? 1 : o->ambient_t_max;
            if (none)
                rays[(size_t)b * pixels + i][3] = 1;
            if (none != (found[i] == CGT_INVALID_ID))
                fail_msg("batch %u, pixel %u: a ray without a hit, or none with one", b, i);
        }
        ranged.t_min = &range[0][0];
        ranged.t_max = &range[0][1];
        assert_int_equal(cgt_occluded_rays(q->all, &ranged, right, &exact), CGT_OK);
        for (uint32_t i = 0; i < pixels; i++)
            if (occluded[b * pixels + i] != CGT_KD_NO_RAY && occluded[b * pixels + i] != right[i])
                fail_msg("batch %u, pixel %u: occluded %u, not %u", b, i, occluded[b * pixels + i], right[i]);
    }
}

#ifdef SPE_KD_ELF
static char elf[1 << 20];
static uint32_t raw_ids[MOST_PIXELS];
static float raw_rays[MOST_BATCHES * MOST_PIXELS][6];
static uint8_t raw_occluded[MOST_BATCHES * MOST_PIXELS];
static cgt_kd_frame_result other;

static size_t load_elf(void)
{
    FILE *const file = fopen(SPE_KD_ELF, "rb");
    if (!file)
        fail_msg("%s: cannot be opened", SPE_KD_ELF);
    const size_t size = fread(elf, 1, sizeof elf, file);
    fclose(file);
    return size;
}

/* Simulated as native, with what an order of SPEs cannot change. */
static void compare_simulated(const library *q, const cgt_camera *camera, uint32_t width, uint32_t height,
                              const cgt_kd_frame_options *native)
{
    cgt_kd_frame_options o = *native;
    const size_t batches = o.lights + o.ambient;
    if (o.cell.spes > 1 && (o.cell.assignment == CGT_ASSIGN_DYNAMIC || o.cell.assignment == CGT_ASSIGN_HYBRID))
        return;
    o.cell.keep_doubts = true;
    if (run_of(q, camera, width, height, &o, &other) != CGT_OK)
        fail_msg("%s", other.message);
    memcpy(raw_ids, found, sizeof raw_ids);
    memcpy(raw_rays, rays, sizeof raw_rays);
    memcpy(raw_occluded, occluded, sizeof raw_occluded);
    o.cell.function = NULL;
    o.cell.elf = elf;
    o.cell.elf_bytes = load_elf();
    o.cell.untimed = true;
    if (run_of(q, camera, width, height, &o, &result) != CGT_OK)
        fail_msg("%s", result.message);
    assert_memory_equal(raw_ids, found, sizeof raw_ids[0] * width * height);
    assert_memory_equal(raw_rays, rays, sizeof raw_rays[0] * width * height * batches);
    assert_memory_equal(raw_occluded, occluded, width * height * batches);
    for (unsigned i = 0; i < o.cell.spes; i++) {
        cgt_kd_frame_spe *const a = &result.spe[i], *const b = &other.spe[i];
        a->report.setup = a->report.traced = b->report.setup = b->report.traced = 0;
        a->counts.wait_cycles = b->counts.wait_cycles = 0;
        assert_memory_equal(&a->report, &b->report, sizeof a->report);
        assert_memory_equal(&a->counts, &b->counts, sizeof a->counts);
    }
}
#else
static void compare_simulated(const library *q, const cgt_camera *camera, uint32_t width, uint32_t height,
                              const cgt_kd_frame_options *native)
{
    (void)q, (void)camera, (void)width, (void)height, (void)native;
}
#endif

static void check(const library *q, const cgt_camera *camera, uint32_t width, uint32_t height,
                  const cgt_kd_frame_options *o)
{
    if (run_of(q, camera, width, height, o, &result) != CGT_OK)
        fail_msg("%s", result.message);
    compare_ids(q, camera, width, height);
    compare_secondary(q, o, width * height);
    for (unsigned i = 0; i < o->cell.spes; i++)
        assert_int_equal(result.spe[i].report.loops, 0);
    compare_simulated(q, camera, width, height, o);
}

/* ---- scenes ---- */

static void make_random(test_random *r, uint32_t count, float size)
{
    triangles = count;
    for (uint32_t i = 0; i < count; i++) {
        float center[3];
        for (int a = 0; a < 3; a++)
            center[a] = random_float(r, -1, 1);
        for (int k = 0; k < 3; k++)
            for (int a = 0; a < 3; a++)
                corner[i][k][a] = center[a] + random_float(r, -size, size);
    }
}

/* A hilly square of n x n quads, whose edges and vertices many rays meet. */
static void make_hills(test_random *r, uint32_t n)
{
    static float height[64][64];
    triangles = 2 * n * n;
    for (uint32_t y = 0; y <= n; y++)
        for (uint32_t x = 0; x <= n; x++)
            height[y][x] = random_float(r, -0.1f, 0.1f);
    for (uint32_t k = 0; k < triangles; k++) {
        const uint32_t x = k / 2 % n, y = k / 2 / n;
        static const uint32_t at[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
        for (int c = 0; c < 3; c++) {
            const uint32_t i = x + at[k % 2][c][0], j = y + at[k % 2][c][1];
            corner[k][c][0] = 2 * (float)i / (float)n - 1;
            corner[k][c][1] = 2 * (float)j / (float)n - 1;
            corner[k][c][2] = height[j][i];
        }
    }
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

static cgt_kd_frame_options make_options(test_random *r, unsigned k)
{
    static const cgt_kd_cache_size nodes[] = {{0}, {1, 1}, {4, 3}}, references[] = {{0}, {1, 2}, {2, 4}},
                                   leaves[] = {{0}, {1, 0}, {2, 1}}, slots[] = {{0}, {1, 0}, {8, 2}};
    cgt_kd_frame_options o = {.cell = {.spes = 1 + k % 8, .function = spe_kd}};
    o.cell.assignment = (cgt_assignment)(k % CGT_ASSIGNMENTS);
    o.cell.doubts_half = k & 2 ? 16 : 0;
    o.tiles_x = 1 + (uint32_t)random_bits(r) % 8;
    o.tiles_y = 1 + (uint32_t)random_bits(r) % 8;
    o.nodes = nodes[random_bits(r) % 3];
    o.references = references[random_bits(r) % 3];
    o.leaves = leaves[random_bits(r) % 3];
    o.triangles = slots[random_bits(r) % 3];
    o.batch = (uint32_t)random_bits(r) % 33;
    o.prefetch = random_bits(r) & 1;
    return o;
}

static void add_secondary(test_random *r, cgt_kd_frame_options *o)
{
    o->lights = (uint32_t)random_bits(r) % 3;
    o->ambient = (uint32_t)random_bits(r) % 4;
    for (uint32_t k = 0; k < o->lights; k++)
        for (int a = 0; a < 3; a++)
            o->light[k][a] = random_float(r, -3, 3);
    o->light_t_min = 0x1p-10f;
    o->ambient_t_min = 0x1p-10f;
    o->ambient_t_max = 1;
}

static void random_scenes(void **state)
{
    (void)state;
    test_random r = random_make(3011);
    for (unsigned k = 0; k < 24; k++) {
        const uint32_t parts = k % 3 == 2 ? 2 + k % 4 : 1;
        make_random(&r, 1 + (uint32_t)random_bits(&r) % 600, k % 2 ? 0.1f : 0.4f);
        library q = make_library(parts, k & 1, (cgt_kd_layout)(k % 4));
        const cgt_camera camera = make_camera(&r);
        const uint32_t width = 1 + (uint32_t)random_bits(&r) % 60, height = 1 + (uint32_t)random_bits(&r) % 40;
        cgt_kd_frame_options o = make_options(&r, k);
        if (k >= 8)
            add_secondary(&r, &o);
        check(&q, &camera, width, height, &o);
        release_library(&q);
    }
}

/* Rays through edges and vertices, from the centre of the square along its axes; every triangle twice. */
static void hard_scenes(void **state)
{
    (void)state;
    test_random r = random_make(3012);
    for (unsigned k = 0; k < 6; k++) {
        make_hills(&r, 8 + 2 * k);
        if (k & 1) {
            memcpy(corner[triangles], corner[0], triangles * sizeof corner[0]);
            triangles *= 2;
        }
        if (k & 2)
            for (uint32_t i = 0; i < triangles; i++)
                for (int c = 0; c < 3; c++)
                    corner[i][c][2] = 0;
        library q = make_library(k == 5 ? 3 : 1, k >= 3, CGT_KD_LAYOUT_DEPTH_FIRST);
        cgt_camera camera;
        cgt_camera_init(&camera);
        camera.eye[0] = camera.eye[1] = 0;
        camera.eye[2] = 2;
        camera.fov = 45;
        cgt_kd_frame_options o = make_options(&r, k);
        add_secondary(&r, &o);
        check(&q, &camera, 64, 64, &o);
        if (k & 1) /* each hit is a tie, and the ring is full again and again */
            assert_true(result.doubts > 1000 || o.cell.keep_doubts);
        release_library(&q);
    }
}

/* Without the PPE's decisions ids are wrong. */
static void doubts_matter(void **state)
{
    (void)state;
    test_random r = random_make(3013);
    make_random(&r, 300, 0.3f);
    for (uint32_t i = 0; i < 150; i++) /* the later one of equals is met first in some leaves */
        memcpy(corner[299 - i], corner[i], sizeof corner[0]);
    library q = make_library(2, false, CGT_KD_LAYOUT_AUTO);
    cgt_camera camera;
    cgt_camera_init(&camera);
    cgt_kd_frame_options o = {.cell = {.spes = 2, .function = spe_kd}};
    assert_int_equal(run_of(&q, &camera, 64, 48, &o, &result), CGT_OK);
    compare_ids(&q, &camera, 64, 48);
    const uint64_t doubts = result.doubts;
    assert_true(doubts > 0);
    release_library(&q);
}

static void odd_pictures_and_scenes(void **state)
{
    (void)state;
    static const uint32_t size[][2] = {{1, 1}, {2, 3}, {5, 1}, {33, 7}};
    test_random r = random_make(3014);
    make_random(&r, 50, 0.5f);
    corner[3][1][0] = NAN;
    memcpy(corner[4][1], corner[4][0], sizeof corner[4][0]); /* without area */
    cgt_camera camera;
    cgt_camera_init(&camera);
    cgt_kd_frame_options o = {.cell = {.spes = 3, .function = spe_kd, .assignment = CGT_ASSIGN_DYNAMIC}, .lights = 1};
    o.light_t_min = 0x1p-8f;
    o.light[0][1] = 4;
    for (unsigned k = 0; k < TEST_COUNT(size); k++) {
        library q = make_library(1 + k, k & 1, CGT_KD_LAYOUT_AUTO);
        check(&q, &camera, size[k][0], size[k][1], &o);
        release_library(&q);
    }
    for (triangles = 0; triangles < 3; triangles++) { /* parts without triangles, too */
        library q = make_library(2, false, CGT_KD_LAYOUT_AUTO);
        check(&q, &camera, 16, 16, &o);
        release_library(&q);
    }
}

static void expect_refusal(const library *q, const cgt_camera *camera, const cgt_kd_frame_options *o, const char *words)
{
    assert_int_equal(run_of(q, camera, 16, 16, o, &result), CGT_ERROR_INVALID_ARGUMENT);
    if (!strstr(result.message, words))
        fail_msg("\"%s\" does not say \"%s\"", result.message, words);
}

static void refusals(void **state)
{
    (void)state;
    test_random r = random_make(3015);
    cgt_camera camera;
    cgt_camera_init(&camera);
    make_random(&r, 10, 0.5f);
    library q = make_library(1, true, CGT_KD_LAYOUT_AUTO);
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
    camera.eye[0] = 0x1p-110f;
    expect_refusal(&q, &camera, &good, "at least 2^-100");
    camera.eye[0] = 0;
    camera.projection = CGT_PROJECTION_ORTHOGRAPHIC;
    expect_refusal(&q, &camera, &good, "orthographic");
    cgt_camera_init(&camera);
    release_library(&q);
    for (uint32_t i = 0; i < triangles; i++)
        for (int c = 0; c < 9; c++)
            corner[i][c / 3][c % 3] *= 0x1p41f;
    q = make_library(1, false, CGT_KD_LAYOUT_AUTO);
    expect_refusal(&q, &camera, &good, "beyond 2^40");
    release_library(&q);
    make_random(&r, 10, 0.5f);
    q = make_library(1, true, CGT_KD_LAYOUT_AUTO);
    library p = make_library(1, false, CGT_KD_LAYOUT_AUTO);
    cgt_scene *const scene = p.scene[0];
    q.scene[q.parts++] = scene;
    expect_refusal(&q, &camera, &good, "some with ropes and some without");
    q.parts--;
    release_library(&q);
    release_library(&p);
}

int main(void)
{
    test_begin("test_cell_kd");
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_scenes), cmocka_unit_test(hard_scenes),
                                       cmocka_unit_test(doubts_matter), cmocka_unit_test(odd_pictures_and_scenes),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
