/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Triangles for tests of the kd program, see kd_library.h. */
#include "cell/ppe/kd_library.h"

#include <string.h>

#include "cell/programs/kd/spe_kd.h"

float kd_corner[KD_MOST_TRIANGLES][3][3];
uint32_t kd_triangles;

static uint32_t expected[KD_MOST_PIXELS], found[KD_MOST_PIXELS];
static float direction[KD_MOST_PIXELS][3];
static float rays[KD_MOST_BATCHES * KD_MOST_PIXELS][6];
static uint8_t occluded[KD_MOST_BATCHES * KD_MOST_PIXELS];
static uint32_t reflected[KD_MOST_PIXELS];

/* ---- scenes of the library ---- */

/* Triangles first to end - 1, committed. */
static cgt_scene *make_scene(cgt_context *context, const cgt_scene_options *options, uint32_t first, uint32_t end)
{
    cgt_scene *scene;
    const cgt_triangles t = {.count = end - first,
                             .vertex_count = 3 * (end - first),
                             .vertices = cgt_floats(end > first ? &kd_corner[first][0][0] : NULL, 0)};
    assert_int_equal(cgt_scene_create(context, options, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_triangles(scene, NULL, &t), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

cgt_spe_function *kd_library_program(cgt_structure structure)
{
    return structure == CGT_STRUCTURE_BIH ? spe_bih : spe_kd;
}

kd_library kd_library_make(uint32_t parts, cgt_structure structure, cgt_kd_layout layout)
{
    const cgt_research_scene_options research = {.kd_layout = layout, .kd_break_level = 3};
    const cgt_scene_options o = {.structure = structure, .research = &research};
    kd_library q = {.parts = parts};
    assert_int_equal(cgt_context_create(NULL, &q.context), CGT_OK);
    for (uint32_t k = 0; k < parts; k++)
        q.scene[k] = make_scene(q.context, &o, kd_triangles * k / parts, kd_triangles * (k + 1) / parts);
    q.all = make_scene(q.context, NULL, 0, kd_triangles);
    return q;
}

void kd_library_release(kd_library *q)
{
    for (uint32_t k = 0; k < q->parts; k++)
        cgt_scene_release(q->scene[k]);
    cgt_scene_release(q->all);
    cgt_context_release(q->context);
}

/* ---- runs ---- */

cgt_result kd_library_run(const kd_library *q, const cgt_camera *camera, uint32_t width, uint32_t height,
                          const cgt_kd_frame_options *o, cgt_cell_frame_result *r)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    const cgt_kd_frame_output output = {found, direction, rays, occluded, reflected};
    const cgt_scene *scene[CGT_KD_PARTS];
    cgt_kd_scene image;
    for (uint32_t k = 0; k < q->parts; k++)
        scene[k] = q->scene[k];
    memset(found, 0x55, sizeof found);
    cgt_result code = cgt_kd_scene_init(&image, &memory, scene, q->parts, r->message);
    if (code == CGT_OK) {
        code = cgt_kd_frame_trace(&image, camera, width, height, o, &output, r);
        cgt_kd_scene_release(&image);
    }
    return code;
}

void kd_library_compare_ids(const kd_library *q, const cgt_camera *camera, uint32_t width, uint32_t height)
{
    cgt_frame frame;
    cgt_frame_init(&frame, width, height);
    frame.primitive = expected;
    const cgt_trace_options exact = {.precision = CGT_PRECISION_EXACT};
    assert_int_equal(cgt_trace_camera(q->all, camera, &frame, &exact), CGT_OK);
    for (uint32_t i = 0; i < width * height && cell_result.spe[0].report.kd.envelopes; i++) {
        float org[3], dir[3];
        assert_int_equal(cgt_camera_get_ray(camera, width, height, i % width, i / width, org, dir), CGT_OK);
        assert_memory_equal(direction[i], dir, sizeof dir);
    }
    for (uint32_t i = 0; i < width * height; i++)
        if (found[i] != expected[i])
            fail_msg("%u triangles in %u parts, %u x %u: pixel %u, %u has triangle %d, not %d", kd_triangles, q->parts,
                     width, height, i % width, i / width, (int)found[i], (int)expected[i]);
}

/* A batch of secondary rays against the library's answer; a ray is there where the pixel has a hit. ids: of the nearest
 * triangles, or NULL. */
static void compare_batch(const kd_library *q, float (*ray)[6], const uint8_t *bit, const uint32_t *ids,
                          const float range[2], uint32_t pixels)
{
    static uint8_t right[KD_MOST_PIXELS];
    static uint32_t right_ids[KD_MOST_PIXELS];
    static float limit[KD_MOST_PIXELS][6]; /* t_min and t_max, as far apart as rays */
    const cgt_trace_options exact = {.precision = CGT_PRECISION_EXACT};
    const cgt_rays r = {.count = pixels,
                        .stride = sizeof ray[0],
                        .org = {&ray[0][0], &ray[0][1], &ray[0][2]},
                        .dir = {&ray[0][3], &ray[0][4], &ray[0][5]},
                        .t_min = &limit[0][0],
                        .t_max = &limit[0][1]};
    for (uint32_t i = 0; i < pixels; i++) {
        const bool none = bit[i] == CGT_KD_NO_RAY;
        if (none != (found[i] == CGT_INVALID_ID))
            fail_msg("pixel %u: a secondary ray without a hit, or none with one", i);
        limit[i][0] = range[0];
        limit[i][1] = none ? -1 : range[1];
        if (none)
            ray[i][3] = 1; /* a direction of a ray that is off */
    }
    assert_int_equal(cgt_occluded_rays(q->all, &r, right, &exact), CGT_OK);
    for (uint32_t i = 0; i < pixels; i++)
        if (bit[i] != CGT_KD_NO_RAY && bit[i] != right[i])
            fail_msg("pixel %u: a secondary ray has %u, not %u", i, bit[i], right[i]);
    if (!ids)
        return;
    assert_int_equal(cgt_trace_rays(q->all, &r, &(cgt_hits){.primitive = right_ids}, &exact), CGT_OK);
    for (uint32_t i = 0; i < pixels; i++)
        if (ids[i] != right_ids[i])
            fail_msg("pixel %u: a reflected ray has triangle %d, not %d", i, (int)ids[i], (int)right_ids[i]);
}

static void compare_secondary(const kd_library *q, const cgt_kd_frame_options *o, uint32_t pixels)
{
    const float light[2] = {o->light_t_min, 1}, ambient[2] = {o->ambient_t_min, o->ambient_t_max},
                mirror[2] = {o->mirror_t_min, o->mirror_t_max};
    for (uint32_t b = 0; b < o->lights + o->ambient + o->mirror; b++) {
        const bool last = b == o->lights + o->ambient;
        compare_batch(q, rays + (size_t)b * pixels, occluded + (size_t)b * pixels, last ? reflected : NULL,
                      last            ? mirror
                      : b < o->lights ? light
                                      : ambient,
                      pixels);
    }
}

/* Simulated as native, with what an order of SPEs cannot change. */
static void compare_simulated(const kd_library *q, const cgt_camera *camera, uint32_t width, uint32_t height,
                              const cgt_kd_frame_options *native)
{
    static uint32_t raw_ids[KD_MOST_PIXELS], raw_reflected[KD_MOST_PIXELS];
    static float raw_rays[KD_MOST_BATCHES * KD_MOST_PIXELS][6];
    static uint8_t raw_occluded[KD_MOST_BATCHES * KD_MOST_PIXELS];
    static cgt_cell_frame_result other;
    cgt_kd_frame_options o = *native;
    const size_t batches = o.lights + o.ambient + o.mirror;
    o.cell.keep_doubts = true;
    cgt_kd_frame_options simulated = o;
    if (!cell_simulate(&simulated.cell, o.cell.function == spe_bih ? SPE_BIH_ELF : SPE_KD_ELF))
        return;
    if (kd_library_run(q, camera, width, height, &o, &other) != CGT_OK)
        fail_msg("%s", other.message);
    memcpy(raw_ids, found, sizeof raw_ids);
    memcpy(raw_rays, rays, sizeof raw_rays);
    memcpy(raw_occluded, occluded, sizeof raw_occluded);
    memcpy(raw_reflected, reflected, sizeof raw_reflected);
    if (kd_library_run(q, camera, width, height, &simulated, &cell_result) != CGT_OK)
        fail_msg("%s", cell_result.message);
    assert_memory_equal(raw_ids, found, sizeof raw_ids[0] * width * height);
    assert_memory_equal(raw_rays, rays, sizeof raw_rays[0] * width * height * batches);
    assert_memory_equal(raw_occluded, occluded, width * height * batches);
    if (o.mirror)
        assert_memory_equal(raw_reflected, reflected, sizeof raw_reflected[0] * width * height);
    cell_compare_spes(&cell_result, &other, o.cell.spes, true);
}

void kd_library_check(const kd_library *q, const cgt_camera *camera, uint32_t width, uint32_t height,
                      const cgt_kd_frame_options *o)
{
    if (kd_library_run(q, camera, width, height, o, &cell_result) != CGT_OK)
        fail_msg("%s", cell_result.message);
    kd_library_compare_ids(q, camera, width, height);
    compare_secondary(q, o, width * height);
    for (unsigned i = 0; i < o->cell.spes; i++)
        assert_int_equal(cell_result.spe[i].report.kd.loops, 0);
    compare_simulated(q, camera, width, height, o);
}
