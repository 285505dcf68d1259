/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pictures by a Cell: primitive, t and normal of each pixel have the bits of cgt_trace_camera. First random scenes,
 * from inside of spheres, with points and ranges. Then the spheres of every hard case that fits, each seen from the
 * origins of its hard rays along them, from wide pictures down to ones so narrow that all of it is a silhouette. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cell/ppe/cell_frames.h"
#include "support/suite.h"
#include "cell/ppe/grid/grid_picture.h"
#include "cell/programs/grid/spe_grid.h"
#include "hard_cases/hard_run.h"
#include "support/test.h"

#define MOST_PIXELS (160 * 90)

/* A frame's planes; the Cell's strips are copied into one. */
typedef struct planes {
    uint32_t width;
    float t[MOST_PIXELS], normal[3][MOST_PIXELS];
    uint32_t primitive[MOST_PIXELS];
} planes;

static planes expected, found;
static struct {
    uint64_t frames, refused, doubts, exact, changed, hits;
} total;

static cgt_visit copy_strip(void *user, const cgt_tile *tile)
{
    planes *const to = user;
    for (uint32_t y = 0; y < tile->height; y++) {
        const size_t from = y * tile->row_stride, at = (size_t)(tile->y + y) * to->width + tile->x;
        memcpy(to->primitive + at, tile->primitive + from, tile->width * sizeof(uint32_t));
        memcpy(to->t + at, tile->t + from, tile->width * sizeof(float));
        for (int a = 0; a < 3; a++)
            memcpy(to->normal[a] + at, tile->normal[a] + from, tile->width * sizeof(float));
    }
    return CGT_VISIT_CONTINUE;
}

static cgt_result trace_library(cgt_scene *scene, const cgt_camera *camera, uint32_t width, uint32_t height)
{
    cgt_frame frame;
    cgt_frame_init(&frame, width, height);
    frame.primitive = expected.primitive;
    frame.t = expected.t;
    for (int a = 0; a < 3; a++)
        frame.normal[a] = expected.normal[a];
    return cgt_trace_camera(scene, camera, &frame, NULL);
}

/* Returns whether the Cell takes the scene; what it takes has the library's bits. */
static bool compare(const char *what, cgt_scene *scene, const float *sphere, uint32_t count, const cgt_camera *camera,
                    uint32_t width, uint32_t height)
{
    if (trace_library(scene, camera, width, height) != CGT_OK)
        return false; /* no camera */
    cgt_grid_picture picture = {
        .sphere = sphere,
        .count = count,
        .camera = *camera,
        .width = width,
        .height = height,
        .options = {.cell = {.spes = 1 + (unsigned)(total.frames % 3),
                             .function = spe_grid,
                             .assignment = (cgt_assignment)(total.frames / 2 % CGT_ASSIGNMENTS)},
                    .nested = total.frames & 1,
                    .cull = (cgt_cull)(total.frames % 4)},
        .visitor = copy_strip,
        .user = &found};
    found.width = width;
    const cgt_result code = cgt_grid_picture_trace(&picture, &cell_result);
    if (code == CGT_ERROR_TOO_LARGE || code == CGT_ERROR_INVALID_ARGUMENT) {
        assert_true(cell_result.message[0] != '\0');
        total.refused++;
        return false;
    }
    if (code != CGT_OK)
        fail_msg("%s: %s", what, cell_result.message);
    total.frames++;
    total.doubts += cell_result.doubts;
    total.exact += cell_result.exact;
    total.changed += cell_result.changed;
    for (uint32_t i = 0; i < width * height; i++) {
        bool same = found.primitive[i] == expected.primitive[i] && !memcmp(&found.t[i], &expected.t[i], 4);
        for (int a = 0; a < 3; a++)
            same &= !memcmp(&found.normal[a][i], &expected.normal[a][i], 4);
        total.hits += found.primitive[i] != CGT_INVALID_ID;
        if (!same)
            fail_msg("%s: pixel %u, %u of %u x %u, fov %.9g: sphere %d at %.9g, not %d at %.9g", what, i % width,
                     i / width, width, height, (double)camera->fov, (int)found.primitive[i], (double)found.t[i],
                     (int)expected.primitive[i], (double)expected.t[i]);
    }
    return true;
}

/* ---- random scenes ---- */

TEST(random_scenes)
{
    cgt_context *const context = *state;
    static float sphere[300][4];
    test_random r = random_make(3010);
    const uint64_t frames = total.frames;
    for (uint32_t k = 0; k < 4 + test_scaled(20); k++) {
        const uint32_t count = 1 + random_below(&r, 300), width = 1 + random_below(&r, 160),
                       height = 1 + random_below(&r, 90);
        for (uint32_t i = 0; i < count; i++) {
            for (int a = 0; a < 3; a++)
                sphere[i][a] = random_float(&r, -1, 1);
            const float radius = random_log(&r, 0.01f, k % 3 ? 0.2f : 1.5f); /* around the eye as well */
            sphere[i][3] = i % 50 == 7 ? 0 : i % 50 == 8 ? -1 : i % 50 == 9 ? NAN : radius;
        }
        cgt_camera camera;
        cgt_camera_init(&camera);
        for (int a = 0; a < 3; a++)
            camera.eye[a] = random_float(&r, k % 2 ? -1 : -3, k % 2 ? 1 : 3);
        /* a point in the middle of the picture */
        for (int a = 0; a < 3; a++)
            camera.target[a] = count > 7 ? sphere[7][a] : 0;
        camera.fov = random_float(&r, 10, 120);
        camera.t_min = random_below(&r, 2) ? 0 : random_float(&r, 0, 2);
        camera.t_max = random_below(&r, 2) ? INFINITY : camera.t_min + random_float(&r, 0, 3);
        cgt_scene *const scene = cell_library_scene(context, sphere[0], count);
        compare("random", scene, sphere[0], count, &camera, width, height);
        cgt_scene_release(scene);
    }
    assert_true(total.frames > frames && total.hits > 0 && (total.doubts > 0 || test_samples()));
}

/* ---- hard cases ---- */

/* The spheres of all geometries, in the order of ids; NULL: none. */
static float *gather_spheres(const hard_scene *s, uint32_t *count)
{
    *count = 0;
    for (uint32_t g = 0; g < s->geometries; g++)
        *count += s->geometry[g].spheres;
    if (*count == 0)
        return NULL;
    float *const all = malloc(*count * 4 * sizeof *all), *to = all;
    assert_non_null(all);
    for (uint32_t g = 0; g < s->geometries; g++) {
        if (s->geometry[g].spheres)
            memcpy(to, s->geometry[g].sphere, s->geometry[g].spheres * 4 * sizeof *to);
        to += s->geometry[g].spheres * 4;
    }
    return all;
}

/* Along the ray, a picture of a few pixels; the narrower, the more of them graze what the ray grazes. */
static bool look_along(const char *name, cgt_scene *scene, const float *sphere, uint32_t count, const truth_ray *ray,
                       float fov)
{
    cgt_camera camera;
    float length = 0;
    cgt_camera_init(&camera);
    for (int a = 0; a < 3; a++)
        length = fmaxf(length, fabsf(ray->dir[a]));
    for (int a = 0; a < 3; a++) {
        const float unit = ray->dir[a] / length;
        camera.eye[a] = ray->org[a];
        /* as far as the eye is from the origin, so that the sum keeps the direction */
        camera.target[a] = ray->org[a] + unit * fmaxf(1, fabsf(ray->org[0]) + fabsf(ray->org[1]) + fabsf(ray->org[2]));
        camera.up[a] = 0;
    }
    int least = 0;
    for (int a = 1; a < 3; a++)
        least = fabsf(ray->dir[a]) < fabsf(ray->dir[least]) ? a : least;
    camera.up[least] = 1;
    camera.fov = fov;
    camera.t_min = fmaxf(0, ray->t_min);
    return compare(name, scene, sphere, count, &camera, 9, 7);
}

TEST(hard_cases)
{
    cgt_context *const context = *state;
    static const float fov[] = {60, 0.5f, 1e-3f, 1e-5f};
    const uint32_t rays = 2 + test_scaled(10);
    uint32_t cases = 0;
    memset(&total, 0, sizeof total);
    for (size_t i = 0; i < hard_case_count(); i++) {
        const hard_case *const c = hard_case_at(i);
        hard_scene s;
        uint32_t count;
        bool fits = false;
        assert_true(hard_case_make(c, rays, &s));
        float *const sphere = gather_spheres(&s, &count);
        if (sphere) {
            cgt_scene *const scene = cell_library_scene(context, sphere, count);
            for (uint32_t k = 0; k < s.rays; k++)
                for (size_t f = 0; f < TEST_COUNT(fov); f++)
                    fits |= look_along(c->name, scene, sphere, count, &s.ray[k], fov[f]);
            cgt_scene_release(scene);
            if (!fits)
                print_message("%s, %s: refused: %s\n", c->row, c->name, cell_result.message);
            cases += fits;
        }
        free(sphere);
        hard_scene_free(&s);
    }
    print_message("%u cases, %llu pictures, %llu refused: %llu hits, %llu doubts, %llu decided in whole numbers, %llu "
                  "pixels changed\n",
                  cases, (unsigned long long)total.frames, (unsigned long long)total.refused,
                  (unsigned long long)total.hits, (unsigned long long)total.doubts, (unsigned long long)total.exact,
                  (unsigned long long)total.changed);
    assert_true(cases > 15);
    assert_true(total.doubts > total.frames && total.exact > 0 && total.changed > 0);
}

/* ---- refusals ---- */

static cgt_visit stop_at_once(void *user, const cgt_tile *tile)
{
    (void)user, (void)tile;
    return CGT_VISIT_STOP;
}

TEST(refusals)
{
    cgt_grid_picture p = {
        .width = 8, .height = 8, .options = {.cell = {.spes = 1, .function = spe_grid}}, .visitor = stop_at_once};
    cgt_camera_init(&p.camera);
    assert_int_equal(cgt_grid_picture_trace(&p, &cell_result), CGT_ERROR_STOPPED);
    assert_string_equal(cell_result.message, "");
    static const uint32_t size[][2] = {{0, 8}, {8, 0}, {32769, 1}, {1, 32769}};
    for (unsigned k = 0; k < TEST_COUNT(size); k++) {
        p.width = size[k][0];
        p.height = size[k][1];
        assert_int_not_equal(cgt_grid_picture_trace(&p, &cell_result), CGT_OK);
        assert_non_null(strstr(cell_result.message, "an edge has 1 to 32768"));
    }
}

static int start(void **state) { return cgt_context_create(NULL, (cgt_context **)state) == CGT_OK ? 0 : -1; }
static int end(void **state)
{
    cgt_context_release(*state);
    return 0;
}

SEEDED_SUITE("test_cell_picture", start, end)
