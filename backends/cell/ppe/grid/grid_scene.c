/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The image of a scene of spheres, planned as libcgt plans its queue grid. */
#include "cell/ppe/grid/grid_scene.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "exact/valid_primitive.h"
#include "papers/model/queue_grid.h"

static cgt_result refuse_spheres(uint32_t count, char message[CGT_PPE_MESSAGE_BYTES])
{
    snprintf(message, CGT_PPE_MESSAGE_BYTES,
             "%" PRIu32 " spheres take %" PRIu64 " bytes of an SPE's local store: beside %u bytes of voxels, %u of "
             "scanlines and the program there is room for %u spheres, %u bytes",
             count, UINT64_C(16) * count, 32 * CGT_GRID_CELLS, 2 * CGT_STRIP_ROWS * CGT_STRIP_PIECE * 4,
             CGT_GRID_SPHERES, 16 * CGT_GRID_SPHERES);
    return CGT_ERROR_TOO_LARGE;
}

static cgt_result check_resolution(const uint32_t n[3], char message[CGT_PPE_MESSAGE_BYTES])
{
    if (n[0] == 0 || n[1] == 0 || n[2] == 0) {
        snprintf(message, CGT_PPE_MESSAGE_BYTES, "a resolution of %" PRIu32 " x %" PRIu32 " x %" PRIu32 " has no cells",
                 n[0], n[1], n[2]);
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    if (n[0] <= CGT_GRID_MAX_EDGE && n[1] <= CGT_GRID_MAX_EDGE && n[2] <= CGT_GRID_MAX_EDGE &&
        n[0] * n[1] * n[2] <= CGT_GRID_CELLS)
        return CGT_OK;
    snprintf(message, CGT_PPE_MESSAGE_BYTES,
             "%" PRIu32 " x %" PRIu32 " x %" PRIu32
             " voxels of 32 bytes exceed an SPE's local store: there is room for "
             "%u, %u bytes, and at most %u along an axis",
             n[0], n[1], n[2], CGT_GRID_CELLS, 32 * CGT_GRID_CELLS, CGT_GRID_MAX_EDGE);
    return CGT_ERROR_TOO_LARGE;
}

/* Copies the spheres, and adds up their bounds, one float outwards of what is rounded. False: too far out. */
static bool copy_spheres(cgt_grid_scene *scene, const cgt_sphere *sphere, uint32_t count, cgt_primitive_bounds *b)
{
    memset(scene->object, 0, scene->bytes);
    for (uint32_t i = count; i < scene->bytes / sizeof *scene->object; i++)
        scene->object[i][3] = -1;
    for (uint32_t i = 0; i < count; i++) {
        float *const to = scene->object[i];
        to[3] = -1;
        if (cgt_sphere_check(sphere[i]) != CGT_PRIMITIVE_VALID)
            continue;
        to[0] = sphere[i].x;
        to[1] = sphere[i].y;
        to[2] = sphere[i].z;
        to[3] = sphere[i].r == 0 ? 0 : sphere[i].r; /* -0 is a radius, too */
        for (int a = 0; a < 3; a++) {
            const float low = nextafterf(to[a] - to[3], -INFINITY), high = nextafterf(to[a] + to[3], INFINITY);
            b->min[a] = b->valid && b->min[a] < low ? b->min[a] : low;
            b->max[a] = b->valid && b->max[a] > high ? b->max[a] : high;
            b->magnitude = fmaxf(b->magnitude, fmaxf(fabsf(low), fabsf(high)));
        }
        b->valid++;
    }
    return b->magnitude <= CGT_SPE_MAX_COORDINATE;
}

static void plan(cgt_grid_image *image, const cgt_primitive_bounds *b, const uint32_t resolution[3])
{
    char reason[128];
    int exponent = 0;
    const cgt_primitives prims = {.count = b->valid};
    cgt_queue_grid grid = {.prims = &prims};
    cgt_queue_grid_plan(&grid, b, resolution, reason); /* cannot fail: the resolution is within the limits */
    for (int a = 0; a < 3; a++) {
        image->resolution[a] = grid.resolution[a];
        image->org[a] = grid.org[a];
        image->rcell[a] = grid.rcell[a];
        image->cell_error[a] = grid.cell_error[a];
    }
    frexpf(b->magnitude, &exponent);
    image->scale = ldexpf(1, exponent < -100 ? 100 : -exponent);
}

cgt_result cgt_grid_scene_init(cgt_grid_scene *scene, const cgt_memory_hooks *memory, const cgt_sphere *sphere,
                               uint32_t count, const uint32_t resolution[3], char message[CGT_PPE_MESSAGE_BYTES])
{
    static const uint32_t chapmans[3] = {16, 16, 16};
    const uint32_t *const cells = resolution ? resolution : chapmans;
    *scene = (cgt_grid_scene){.memory = *memory, .image = {.resolution = {1, 1, 1}, .rcell = {1, 1, 1}, .scale = 1}};
    const cgt_result fits = check_resolution(cells, message);
    if (fits != CGT_OK)
        return fits;
    if (count > CGT_GRID_SPHERES)
        return refuse_spheres(count, message);
    if (count == 0)
        return CGT_OK;
    scene->bytes = (count + 7) / 8 * 8 * sizeof *scene->object;
    scene->object = cgt_allocate(memory, scene->bytes);
    if (!scene->object) {
        snprintf(message, CGT_PPE_MESSAGE_BYTES, "out of memory for the image of %" PRIu32 " spheres", count);
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    cgt_primitive_bounds bounds = {.valid = 0};
    if (!copy_spheres(scene, sphere, count, &bounds)) {
        snprintf(message, CGT_PPE_MESSAGE_BYTES,
                 "spheres reach beyond 2^40, where the bounds of an SPU's single precision end");
        cgt_grid_scene_release(scene);
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    if (bounds.valid) {
        scene->image.spheres = count;
        plan(&scene->image, &bounds, cells);
    }
    return CGT_OK;
}

void cgt_grid_scene_release(cgt_grid_scene *scene)
{
    if (scene->object)
        cgt_free(&scene->memory, scene->object, scene->bytes);
    scene->object = NULL;
}
