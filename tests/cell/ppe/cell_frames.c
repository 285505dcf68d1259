/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * See cell_frames.h. */
#include "cell/ppe/cell_frames.h"

#include <stdio.h>
#include <string.h>

cgt_sphere cell_sphere[CGT_GRID_SPHERES + 1];
cgt_cell_frame_result cell_result;

void cell_random_spheres(test_random *r, uint32_t count, float largest)
{
    for (uint32_t i = 0; i < count; i++)
        cell_sphere[i] = (cgt_sphere){random_float(r, -1, 1), random_float(r, -1, 1), random_float(r, -1, 1),
                                      random_float(r, 0.01f, largest)};
}

cgt_camera cell_random_camera(test_random *r, float far)
{
    cgt_camera c;
    cgt_camera_init(&c);
    for (int a = 0; a < 3; a++)
        c.eye[a] = random_float(r, -far, far);
    c.fov = random_float(r, 20, 100);
    return c;
}

cgt_scene *cell_library_scene(cgt_context *context, const float *sphere, uint32_t count)
{
    cgt_scene *scene;
    const cgt_spheres s = {.count = count,
                           .centers = cgt_floats(sphere, 4 * sizeof *sphere),
                           .radii = cgt_floats(sphere + 3, 4 * sizeof *sphere)};
    assert_int_equal(cgt_scene_create(context, NULL, &scene), CGT_OK);
    assert_int_equal(cgt_scene_set_spheres(scene, NULL, &s), CGT_OK);
    assert_int_equal(cgt_scene_commit(scene), CGT_OK);
    return scene;
}

cgt_result cell_grid_trace(uint32_t spheres, const cgt_camera *camera, uint32_t width, uint32_t height,
                           const cgt_grid_frame_options *options, uint32_t *ids, cgt_cell_frame_result *result)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    cgt_grid_scene scene;
    cgt_result code = cgt_grid_scene_init(&scene, &memory, cell_sphere, spheres, NULL, result->message);
    if (code == CGT_OK) {
        code = cgt_grid_frame_trace(&scene, camera, width, height, options, ids, result);
        cgt_grid_scene_release(&scene);
    }
    return code;
}

void cell_expect(cgt_result got, const char *message, cgt_result code, const char *words)
{
    if (got != code || !strstr(message, words))
        fail_msg("%d, \"%s\", not %d with \"%s\"", (int)got, message, (int)code, words);
}

bool cell_simulate(cgt_cell_frame_options *o, const char *path)
{
    static char elf[1 << 20];
    if (!path || (o->spes > 1 && (o->assignment == CGT_ASSIGN_DYNAMIC || o->assignment == CGT_ASSIGN_HYBRID)))
        return false;
    FILE *const file = fopen(path, "rb");
    if (!file)
        fail_msg("%s: cannot be opened", path);
    o->elf_bytes = fread(elf, 1, sizeof elf, file);
    fclose(file);
    o->function = NULL;
    o->elf = elf;
    o->untimed = true;
    return true;
}

static void forget_times(cgt_cell_frame_spe *spe, bool kd)
{
    if (kd)
        spe->report.kd.setup = spe->report.kd.traced = 0;
    else
        spe->report.grid.built = spe->report.grid.traced = 0;
    spe->counts.wait_cycles = 0;
}

void cell_compare_spes(cgt_cell_frame_result *a, cgt_cell_frame_result *b, unsigned spes, bool kd)
{
    for (unsigned i = 0; i < spes; i++) {
        forget_times(&a->spe[i], kd);
        forget_times(&b->spe[i], kd);
        assert_memory_equal(&a->spe[i].report, &b->spe[i].report, sizeof a->spe[i].report);
        assert_memory_equal(&a->spe[i].counts, &b->spe[i].counts, sizeof a->spe[i].counts);
    }
}
