/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Values of known hits, ray by ray. */
#include "cell/ppe/grid/grid_picture.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "exact/decide.h"

#define PLANES 4 /* t, and the normal's components */

/* The canonical t, and the unit normal. */
static void resolve(const cgt_camera_rays *rays, uint32_t x, uint32_t y, const float q[4], float value[PLANES])
{
    cgt_ray ray = {.t_min = rays->t_min, .t_max = rays->t_max};
    const cgt_sphere sphere = {q[0], q[1], q[2], q[3]};
    bool far;
    cgt_camera_pixel(rays, x, y, ray.line.org, ray.line.dir);
    const double t = cgt_canonical_sphere_t(&ray, sphere, &far);
    value[0] = (float)t;
    cgt_canonical_sphere_normal(&ray, sphere, t, value + 1);
}

/* A row of the picture into row `row` of the strip's planes, each of `plane` elements. */
static void resolve_row(const cgt_grid_scene *scene, const cgt_camera_rays *rays, uint32_t y, const uint32_t *id,
                        float *values, size_t plane)
{
    for (uint32_t x = 0; x < rays->width; x++) {
        float value[PLANES] = {INFINITY};
        if (id[x] != CGT_INVALID_ID)
            resolve(rays, x, y, scene->object[id[x]], value);
        for (int k = 0; k < PLANES; k++)
            values[(size_t)k * plane + x] = value[k];
    }
}

static cgt_result visit(const cgt_grid_picture *p, const cgt_grid_scene *scene, const uint32_t *ids, float *values)
{
    char reason[CGT_CAMERA_MESSAGE_BYTES];
    cgt_camera_rays rays;
    const size_t plane = (size_t)CGT_STRIP_ROWS * p->width;
    cgt_result result = cgt_camera_prepare(&p->camera, p->width, p->height, &rays, reason); /* as for the frame */
    for (uint32_t y = 0; y < p->height && result == CGT_OK; y += CGT_STRIP_ROWS) {
        const uint32_t rows = p->height - y < CGT_STRIP_ROWS ? p->height - y : CGT_STRIP_ROWS;
        const uint32_t *const id = ids + (size_t)y * p->width;
        for (uint32_t k = 0; k < rows; k++)
            resolve_row(scene, &rays, y + k, id + (size_t)k * p->width, values + (size_t)k * p->width, plane);
        const cgt_tile tile = {.y = y,
                               .width = p->width,
                               .height = rows,
                               .row_stride = p->width,
                               .t = values,
                               .primitive = id,
                               .normal = {values + plane, values + 2 * plane, values + 3 * plane}};
        if (p->visitor(p->user, &tile) == CGT_VISIT_STOP)
            result = CGT_ERROR_STOPPED;
    }
    return result;
}

static cgt_result trace(const cgt_grid_picture *p, const cgt_memory_hooks *memory, const cgt_grid_scene *scene,
                        cgt_cell_frame_result *result)
{
    const size_t id_bytes = (size_t)p->width * p->height * sizeof(uint32_t),
                 value_bytes = (size_t)PLANES * CGT_STRIP_ROWS * p->width * sizeof(float);
    uint32_t *const ids = cgt_allocate(memory, id_bytes ? id_bytes : 1);
    float *const values = cgt_allocate(memory, value_bytes ? value_bytes : 1);
    cgt_result code = CGT_ERROR_OUT_OF_MEMORY;
    if (ids && values)
        code = cgt_grid_frame_trace(scene, &p->camera, p->width, p->height, &p->options, ids, result);
    else
        snprintf(result->message, sizeof result->message, "out of memory for a picture of %" PRIu32 " x %" PRIu32,
                 p->width, p->height);
    if (code == CGT_OK)
        code = visit(p, scene, ids, values);
    if (values)
        cgt_free(memory, values, value_bytes ? value_bytes : 1);
    if (ids)
        cgt_free(memory, ids, id_bytes ? id_bytes : 1);
    return code;
}

cgt_result cgt_grid_picture_trace(const cgt_grid_picture *picture, cgt_cell_frame_result *result)
{
    const cgt_memory_hooks memory = picture->memory ? *picture->memory : cgt_memory_default();
    char message[CGT_PPE_MESSAGE_BYTES];
    cgt_grid_scene scene;
    *result = (cgt_cell_frame_result){.cycles = 0};
    /* the sizes of allocations, before a frame checks them */
    if (picture->width > CGT_FRAME_MAX_EDGE || picture->height > CGT_FRAME_MAX_EDGE) {
        snprintf(result->message, sizeof result->message,
                 "a picture of %" PRIu32 " x %" PRIu32 " pixels: an edge has 1 to %u of them", picture->width,
                 picture->height, CGT_FRAME_MAX_EDGE);
        return CGT_ERROR_TOO_LARGE;
    }
    cgt_result code = cgt_grid_scene_init(&scene, &memory, (const cgt_sphere *)(const void *)picture->sphere,
                                          picture->count, NULL, message);
    if (code != CGT_OK) {
        snprintf(result->message, sizeof result->message, "%s", message);
        return code;
    }
    code = trace(picture, &memory, &scene, result);
    cgt_grid_scene_release(&scene);
    return code;
}
