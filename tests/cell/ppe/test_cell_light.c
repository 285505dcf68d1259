/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rays from the hits of a Cell's frame: what they meet is what cgt_occluded_points and cgt_occluded_rays say of the same
 * rays, for any number of SPEs. The program runs native; where SPE_GRID_ELF names it as the SPU's own compiler made it,
 * simulated as well: the same bits, reports and DMA. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cell/ppe/grid/frame.h"
#include "cell/programs/grid/spe_grid.h"
#include "support/test.h"

#define MOST_PIXELS (360 * 40)
#define MOST_SPHERES 500

static uint32_t id[MOST_PIXELS], occluded[MOST_PIXELS];
static float org[3][MOST_PIXELS], dir[3][MOST_PIXELS], t_max[MOST_PIXELS];
static uint32_t own[MOST_PIXELS], pixel[MOST_PIXELS];
static uint8_t expected[MOST_PIXELS];
static cgt_sphere sphere[MOST_SPHERES];
static cgt_cell_frame_result result;

/* What one frame needs. */
typedef struct picture {
    uint32_t spheres, width, height;
    cgt_camera camera;
    cgt_cell_light light;
} picture;

/* ---- the same rays through the library ---- */

static cgt_scene *make_scene(const picture *p, cgt_context **context)
{
    cgt_scene *scene;
    const cgt_spheres s = {.count = p->spheres,
                           .centers = &sphere[0].x,
                           .center_stride = sizeof sphere[0],
                           .radii = &sphere[0].r,
                           .radius_stride = sizeof sphere[0]};
    assert_int_equal(cgt_context_create(NULL, context), CGT_OK);
    assert_int_equal(cgt_scene_create(*context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_add_spheres(scene, &s, NULL), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

/* The rays of a set, of all pixels with hits. Returns how many. */
static uint32_t list_rays(const picture *p, const cgt_frame_light *light, uint32_t set)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < p->width * p->height; i++) {
        cgt_ray ray;
        if (id[i] == CGT_INVALID_ID)
            continue;
        if (!cgt_frame_light_ray(light, i % p->width, i / p->width, id[i], set, &ray))
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

static void check_set(const picture *p, const cgt_scene *scene, const cgt_frame_light *light, uint32_t set)
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

static cgt_result trace(const picture *p, cgt_cell_frame_options o, cgt_cell_frame_result *r)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    cgt_grid_scene scene;
    char message[CGT_PPE_MESSAGE_BYTES] = "";
    assert_int_equal(cgt_grid_scene_init(&scene, &memory, sphere, p->spheres, NULL, message), CGT_OK);
    o.light = &p->light;
    o.occluded = occluded;
    memset(occluded, 0x55, sizeof occluded);
    const cgt_result code = cgt_cell_frame_trace(&scene, &p->camera, p->width, p->height, &o, id, r);
    cgt_grid_scene_release(&scene);
    return code;
}

#ifdef SPE_GRID_ELF
static char elf[1 << 20];
static uint32_t native_bits[MOST_PIXELS];
static cgt_cell_frame_result native;

static void compare_simulated(const picture *p, cgt_cell_frame_options o)
{
    FILE *const file = fopen(SPE_GRID_ELF, "rb");
    if (!file)
        fail_msg("%s: cannot be opened", SPE_GRID_ELF);
    o.elf_bytes = fread(elf, 1, sizeof elf, file);
    fclose(file);
    if (trace(p, o, &native) != CGT_OK)
        fail_msg("%s", native.message);
    memcpy(native_bits, occluded, sizeof native_bits);
    o.function = NULL;
    o.elf = elf;
    o.untimed = true;
    if (trace(p, o, &result) != CGT_OK)
        fail_msg("%s", result.message);
    assert_memory_equal(native_bits, occluded, sizeof native_bits);
    assert_int_equal(native.light_doubts, result.light_doubts);
    for (unsigned i = 0; i < o.spes; i++) {
        cgt_cell_frame_spe *const a = &result.spe[i], *const b = &native.spe[i];
        a->report.built = a->report.traced = b->report.built = b->report.traced = 0;
        a->counts.wait_cycles = b->counts.wait_cycles = 0;
        assert_memory_equal(&a->report, &b->report, sizeof a->report);
        assert_memory_equal(&a->counts, &b->counts, sizeof a->counts);
    }
}
#else
static void compare_simulated(const picture *p, cgt_cell_frame_options o) { (void)p, (void)o; }
#endif

static void check(const picture *p, cgt_cell_frame_options o)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    char message[CGT_PPE_MESSAGE_BYTES] = "";
    cgt_context *context;
    cgt_grid_scene image;
    cgt_camera_tables tables;
    cgt_frame_light light;
    if (trace(p, o, &result) != CGT_OK)
        fail_msg("%s", result.message);
    assert_int_equal(cgt_grid_scene_init(&image, &memory, sphere, p->spheres, NULL, message), CGT_OK);
    assert_int_equal(cgt_camera_tables_init(&tables, &memory, &p->camera, p->width, p->height, message), CGT_OK);
    assert_int_equal(cgt_frame_light_init(&light, &memory, &p->light, &tables, &image, message), CGT_OK);
    cgt_scene *const scene = make_scene(p, &context);
    for (uint32_t set = 0; set < light.image.sets; set++)
        check_set(p, scene, &light, set);
    for (uint32_t i = 0; i < p->width * p->height; i++)
        assert_true(id[i] != CGT_INVALID_ID || occluded[i] == 0);
    cgt_scene_release(scene);
    cgt_context_release(context);
    cgt_frame_light_release(&light);
    cgt_camera_tables_release(&tables);
    cgt_grid_scene_release(&image);
}

/* ---- tests ---- */

static void make_spheres(test_random *r, uint32_t count, float largest)
{
    for (uint32_t i = 0; i < count; i++)
        sphere[i] = (cgt_sphere){random_float(r, -1, 1), random_float(r, -1, 1), random_float(r, -1, 1),
                                 random_float(r, 0.01f, largest)};
}

static uint64_t count_occluded(const picture *p, uint32_t set)
{
    uint64_t n = 0;
    for (uint32_t i = 0; i < p->width * p->height; i++)
        n += occluded[i] >> set & 1;
    return n;
}

static void random_scenes(void **state)
{
    (void)state;
    test_random r = random_make(3201);
    for (unsigned k = 0; k < 8; k++) {
        picture p = {.spheres = 1 + (uint32_t)random_bits(&r) % 400,
                     .width = 1 + (uint32_t)random_bits(&r) % 90,
                     .height = 1 + (uint32_t)random_bits(&r) % 40};
        make_spheres(&r, p.spheres, k % 2 ? 0.05f : 0.15f);
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
        const cgt_cell_frame_options o = {.spes = 1 + k % 3, .function = spe_grid, .retest = k & 1};
        check(&p, o);
        compare_simulated(&p, o);
    }
}

/* A light amid spheres that many share, most of whose rays are ties with the spheres that they start from: the PPE decides
 * them, and all rays of pixels that it changed. */
static void doubtful_rays(void **state)
{
    (void)state;
    test_random r = random_make(3202);
    picture p = {
        .spheres = 120, .width = 61, .height = 35, .light = {.shadow = true, .ambient = 3, .position = {0.1f}}};
    make_spheres(&r, 40, 0.2f);
    for (uint32_t i = 40; i < 120; i++)
        sphere[i] = sphere[i - 40];
    cgt_camera_init(&p.camera);
    const cgt_cell_frame_options o = {.spes = 2, .function = spe_grid, .retest = true, .doubts_half = 16};
    check(&p, o);
    assert_true(result.light_doubts > 1000 && result.interrupts > 10 && result.light_pixels > 0);
    compare_simulated(&p, o);
}

/* Directions beyond the limits of an SPU's bounds: the PPE traces these rays. */
static void far_and_near_lights(void **state)
{
    (void)state;
    static const float place[][3] = {{0x1p30f, 0, 0x1p38f}, {0, 0, 0}, {-0x1p22f, 1, 1}};
    test_random r = random_make(3203);
    picture p = {.spheres = 100, .width = 33, .height = 30, .light = {.shadow = true}};
    make_spheres(&r, 100, 0.2f);
    cgt_camera_init(&p.camera);
    const cgt_cell_frame_options o = {.spes = 1, .function = spe_grid};
    for (unsigned k = 0; k < TEST_COUNT(place); k++) {
        memcpy(p.light.position, place[k], sizeof place[k]);
        check(&p, o);
    }
}

/* A plain shadow, so that the others are known to compare something: a small sphere before a large one. */
static void shadow_falls(void **state)
{
    (void)state;
    picture p = {
        .spheres = 2, .width = 64, .height = 36, .light = {.shadow = true, .position = {0, 0, 4}, .ambient = 1}};
    sphere[0] = (cgt_sphere){0, 0, -1, 1};
    sphere[1] = (cgt_sphere){0, 0.2f, 1.5f, 0.2f};
    cgt_camera_init(&p.camera);
    p.camera.eye[1] = 2;
    p.camera.eye[2] = 4;
    check(&p, (cgt_cell_frame_options){.spes = 1, .function = spe_grid});
    assert_true(count_occluded(&p, 0) > 10);
    uint64_t hits = 0;
    for (uint32_t i = 0; i < p.width * p.height; i++)
        hits += id[i] != CGT_INVALID_ID;
    assert_true(count_occluded(&p, 0) < hits);
}

static void expect_refusal(picture *p, const char *words)
{
    assert_int_equal(trace(p, (cgt_cell_frame_options){.spes = 1, .function = spe_grid}, &result),
                     CGT_ERROR_INVALID_ARGUMENT);
    if (!strstr(result.message, words))
        fail_msg("\"%s\" does not say \"%s\"", result.message, words);
}

static void refusals(void **state)
{
    (void)state;
    picture p = {.spheres = 1, .width = 4, .height = 4};
    cgt_camera_init(&p.camera);
    expect_refusal(&p, "1 to 16 of a pixel");
    p.light = (cgt_cell_light){.shadow = true, .ambient = 16};
    expect_refusal(&p, "1 to 16 of a pixel");
    p.light = (cgt_cell_light){.ambient = 1, .radius = NAN};
    expect_refusal(&p, "radius");
    p.light = (cgt_cell_light){.shadow = true, .position = {0x1p-71f}};
    expect_refusal(&p, "2^-70");
    p.light = (cgt_cell_light){.shadow = true, .position = {INFINITY}};
    expect_refusal(&p, "2^40");
}

int main(void)
{
    test_begin("test_cell_light");
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_scenes), cmocka_unit_test(doubtful_rays),
                                       cmocka_unit_test(far_and_near_lights), cmocka_unit_test(shadow_falls),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
