/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays from the hits of a Cell's frame: what they meet is what cgt_occluded_points and cgt_occluded_rays say of the
 * same rays, for any number of SPEs. The program runs native; where SPE_GRID_ELF names it as the SPU's own compiler
 * made it, simulated as well: the same bits, reports and DMA. */
#include <math.h>
#include <string.h>

#include "cell/ppe/cell_frames.h"
#include "support/suite.h"
#include "cell/programs/grid/spe_grid.h"

#define MOST_PIXELS (360 * 40)

static uint32_t id[MOST_PIXELS], occluded[MOST_PIXELS];
static float org[3][MOST_PIXELS], dir[3][MOST_PIXELS], t_max[MOST_PIXELS];
static uint32_t own[MOST_PIXELS], pixel[MOST_PIXELS];
static uint8_t expected[MOST_PIXELS];

/* What one frame needs. */
typedef struct picture {
    uint32_t spheres, width, height;
    cgt_camera camera;
    cgt_grid_light light;
} picture;

/* ---- the same rays through the library ---- */

/* The rays of a set, of all pixels with hits. Returns how many. */
static uint32_t list_rays(const picture *p, const cgt_grid_lighting *light, uint32_t set)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < p->width * p->height; i++) {
        cgt_ray ray;
        if (id[i] == CGT_INVALID_ID)
            continue;
        if (!cgt_grid_lighting_ray(light, i % p->width, i / p->width, id[i], set, &ray))
            continue;
        for (int a = 0; a < 3; a++) {
            org[a][n] = ray.line.org[a];
            dir[a][n] = ray.line.dir[a];
        }
        t_max[n] = ray.t_max;
        own[n] = id[i];
        pixel[n++] = i;
    }
    return n;
}

static void check_set(const picture *p, const cgt_scene *scene, const cgt_grid_lighting *light, uint32_t set)
{
    const uint32_t n = list_rays(p, light, set);
    const cgt_rays rays = {.count = n,
                           .org = {org[0], org[1], org[2]},
                           .dir = {dir[0], dir[1], dir[2]},
                           .t_max = t_max,
                           .skip_primitive = own};
    const cgt_points points = {.count = n, .position = {org[0], org[1], org[2]}, .skip_primitive = own};
    cgt_light lamp = {.kind = CGT_LIGHT_POINT};
    memcpy(lamp.position, p->light.position, sizeof lamp.position);
    if (p->light.shadow && set == 0)
        assert_int_equal(cgt_occluded_points(scene, &lamp, &points, expected, NULL), CGT_OK);
    else
        assert_int_equal(cgt_occluded_rays(scene, &rays, expected, NULL), CGT_OK);
    for (uint32_t k = 0; k < n; k++)
        if ((occluded[pixel[k]] >> set & 1) != expected[k])
            fail_msg("%u spheres, set %u, pixel %u, %u of sphere %u: %u, not %u", p->spheres, set, pixel[k] % p->width,
                     pixel[k] / p->width, own[k], occluded[pixel[k]] >> set & 1, expected[k]);
}

/* ---- frames ---- */

static cgt_result trace(const picture *p, cgt_grid_frame_options o, cgt_cell_frame_result *r)
{
    o.light = &p->light;
    o.occluded = occluded;
    memset(occluded, 0x55, sizeof occluded);
    return cell_grid_trace(p->spheres, &p->camera, p->width, p->height, &o, id, r);
}

static void compare_simulated(const picture *p, cgt_grid_frame_options o)
{
    static uint32_t native_bits[MOST_PIXELS];
    static cgt_cell_frame_result native;
    cgt_grid_frame_options simulated = o;
    if (!cell_simulate(&simulated.cell, SPE_GRID_ELF))
        return;
    if (trace(p, o, &native) != CGT_OK)
        fail_msg("%s", native.message);
    memcpy(native_bits, occluded, sizeof native_bits);
    if (trace(p, simulated, &cell_result) != CGT_OK)
        fail_msg("%s", cell_result.message);
    assert_memory_equal(native_bits, occluded, sizeof native_bits);
    assert_int_equal(native.light_doubts, cell_result.light_doubts);
    cell_compare_spes(&cell_result, &native, o.cell.spes, false);
}

static void check(const picture *p, cgt_grid_frame_options o)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    char message[CGT_PPE_MESSAGE_BYTES] = "";
    cgt_context *context;
    cgt_grid_scene image;
    cgt_camera_tables tables;
    cgt_grid_lighting light;
    if (trace(p, o, &cell_result) != CGT_OK)
        fail_msg("%s", cell_result.message);
    assert_int_equal(cgt_grid_scene_init(&image, &memory, cell_sphere, p->spheres, NULL, message), CGT_OK);
    assert_int_equal(cgt_camera_tables_init(&tables, &memory, &p->camera, p->width, p->height, message), CGT_OK);
    assert_int_equal(cgt_grid_lighting_init(&light, &memory, &p->light, &tables, &image, message), CGT_OK);
    assert_int_equal(cgt_context_create(NULL, &context), CGT_OK);
    cgt_scene *const scene = cell_library_scene(context, &cell_sphere[0].x, p->spheres);
    for (uint32_t set = 0; set < light.image.sets; set++)
        check_set(p, scene, &light, set);
    for (uint32_t i = 0; i < p->width * p->height; i++)
        assert_true(id[i] != CGT_INVALID_ID || occluded[i] == 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
    cgt_grid_lighting_release(&light);
    cgt_camera_tables_release(&tables);
    cgt_grid_scene_release(&image);
}

/* ---- tests ---- */

static uint64_t count_occluded(const picture *p, uint32_t set)
{
    uint64_t n = 0;
    for (uint32_t i = 0; i < p->width * p->height; i++)
        n += occluded[i] >> set & 1;
    return n;
}

TEST(random_scenes)
{
    test_random r = random_make(3201);
    for (unsigned k = 0; k < 8; k++) {
        picture p = {.spheres = 1 + (uint32_t)random_bits(&r) % 400,
                     .width = 1 + (uint32_t)random_bits(&r) % 90,
                     .height = 1 + (uint32_t)random_bits(&r) % 40};
        cell_random_spheres(&r, p.spheres, k % 2 ? 0.05f : 0.15f);
        cgt_camera_init(&p.camera);
        p.camera.fov = random_float(&r, 20, 90);
        for (int a = 0; a < 3; a++) {
            p.camera.eye[a] = random_float(&r, -2, 2);
            p.light.position[a] = random_float(&r, -3, 3);
        }
        p.light.shadow = k % 4 != 3;
        p.light.ambient = k % 3 == 0 ? CGT_LIGHT_SETS - p.light.shadow : k;
        p.light.radius = k % 2 ? 0.3f : 0;
        p.light.seed = k;
        const cgt_grid_frame_options o = {.cell = {.spes = 1 + k % 3, .function = spe_grid}, .retest = k & 1};
        check(&p, o);
        compare_simulated(&p, o);
    }
}

/* A light amid spheres that many share, most of whose rays are ties with the spheres that they start from: the PPE
 * decides them, and all rays of pixels that it changed. */
TEST(doubtful_rays)
{
    test_random r = random_make(3202);
    picture p = {
        .spheres = 120, .width = 61, .height = 35, .light = {.shadow = true, .ambient = 3, .position = {0.1f}}};
    cell_random_spheres(&r, 40, 0.2f);
    for (uint32_t i = 40; i < 120; i++)
        cell_sphere[i] = cell_sphere[i - 40];
    cgt_camera_init(&p.camera);
    const cgt_grid_frame_options o = {.cell = {.spes = 2, .function = spe_grid, .doubts_half = 16}, .retest = true};
    check(&p, o);
    assert_true(cell_result.light_doubts > 1000 && cell_result.interrupts > 10 && cell_result.light_pixels > 0);
    compare_simulated(&p, o);
}

/* Directions beyond the limits of an SPU's bounds: the PPE traces these rays. */
TEST(far_and_near_lights)
{
    static const float place[][3] = {{0x1p30f, 0, 0x1p38f}, {0, 0, 0}, {-0x1p22f, 1, 1}};
    test_random r = random_make(3203);
    picture p = {.spheres = 100, .width = 33, .height = 30, .light = {.shadow = true}};
    cell_random_spheres(&r, 100, 0.2f);
    cgt_camera_init(&p.camera);
    const cgt_grid_frame_options o = {.cell = {.spes = 1, .function = spe_grid}};
    for (unsigned k = 0; k < TEST_COUNT(place); k++) {
        memcpy(p.light.position, place[k], sizeof place[k]);
        check(&p, o);
    }
}

/* A plain shadow, so that the others are known to compare something: a small sphere before a large one. */
TEST(shadow_falls)
{
    picture p = {
        .spheres = 2, .width = 64, .height = 36, .light = {.shadow = true, .position = {0, 0, 4}, .ambient = 1}};
    cell_sphere[0] = (cgt_sphere){0, 0, -1, 1};
    cell_sphere[1] = (cgt_sphere){0, 0.2f, 1.5f, 0.2f};
    cgt_camera_init(&p.camera);
    p.camera.eye[1] = 2;
    p.camera.eye[2] = 4;
    check(&p, (cgt_grid_frame_options){.cell = {.spes = 1, .function = spe_grid}});
    assert_true(count_occluded(&p, 0) > 10);
    uint64_t hits = 0;
    for (uint32_t i = 0; i < p.width * p.height; i++)
        hits += id[i] != CGT_INVALID_ID;
    assert_true(count_occluded(&p, 0) < hits);
}

static void expect_refusal(picture *p, const char *words)
{
    const cgt_result got = trace(p, (cgt_grid_frame_options){.cell = {.spes = 1, .function = spe_grid}}, &cell_result);
    cell_expect(got, cell_result.message, CGT_ERROR_INVALID_ARGUMENT, words);
}

TEST(refusals)
{
    picture p = {.spheres = 1, .width = 4, .height = 4};
    cgt_camera_init(&p.camera);
    expect_refusal(&p, "1 to 16 of a pixel");
    p.light = (cgt_grid_light){.shadow = true, .ambient = 16};
    expect_refusal(&p, "1 to 16 of a pixel");
    p.light = (cgt_grid_light){.ambient = 1, .radius = NAN};
    expect_refusal(&p, "radius");
    p.light = (cgt_grid_light){.shadow = true, .position = {0x1p-71f}};
    expect_refusal(&p, "2^-70");
    p.light = (cgt_grid_light){.shadow = true, .position = {INFINITY}};
    expect_refusal(&p, "2^40");
}

SEEDED_SUITE("test_cell_light", NULL, NULL)
