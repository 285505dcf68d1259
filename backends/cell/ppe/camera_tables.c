/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Columns and rows of canonical rays. */
#include "cell/ppe/camera_tables.h"

#include <inttypes.h>
#include <stdio.h>

#define TINY 0x1p-70f         /* cgt_camera_image.tiny */
#define MAX_DIRECTION 0x1p20f /* of a component: docs/reports/cell_sizes.md */

static cgt_result check(const cgt_camera_rays *c, char message[CGT_PPE_MESSAGE_BYTES])
{
    const char *wrong = NULL;
    if (c->orthographic)
        wrong = "an orthographic camera: the program of an SPE traces rays of one origin";
    for (int a = 0; a < 3 && !wrong; a++) {
        if (!(fabsf(c->eye[a]) <= CGT_SPE_MAX_COORDINATE))
            wrong = "the eye lies beyond 2^40, where the bounds of an SPU's single precision end";
        else if (!(fabsf(c->fwd[a]) + fabsf(c->right[a]) + fabsf(c->up[a]) <= MAX_DIRECTION))
            wrong = "the view is so wide that rays exceed 2^20, where the bounds of an SPU's single precision end";
    }
    if (!wrong)
        return CGT_OK;
    snprintf(message, CGT_PPE_MESSAGE_BYTES, "%s", wrong);
    return CGT_ERROR_INVALID_ARGUMENT;
}

/* No hit has a larger t: eye and spheres lie within 2^40 in each coordinate, so hits within 2^43 of the eye, and a
 * direction is at least as long as the unit vector fwd, but for rounding, since right and up are perpendicular to it. A
 * range may end here as well: the program's products of t, direction (2^20) and cells per unit (2^55 at most,
 * queue_grid_plan.c) then stay below 2^127. Beyond, an SPU's floats go on to 2^129 and saturate there, and the host,
 * which has infinity and NaN in their place, would compare otherwise. */
#define MAX_T 0x1p44f

static float limit_t(float t) { return fmaxf(-MAX_T, fminf(t, MAX_T)); }

/* Whether rows of four numbers hold one that an SPE's single precision does not add to nearest. */
static bool has_tiny(const float (*row)[4], uint32_t rows)
{
    bool found = false;
    for (uint32_t k = 0; k < rows; k++)
        for (int a = 0; a < 3; a++)
            found |= row[k][a] != 0 && fabsf(row[k][a]) < TINY;
    return found;
}

/* In the order of operations of query/camera.h. */
static void fill(cgt_camera_tables *t)
{
    const cgt_camera_rays *c = &t->rays;
    const uint32_t columns = (uint32_t)(t->column_bytes / 16), rows = (uint32_t)(t->row_bytes / 16);
    for (uint32_t k = 0; k < columns; k++) {
        const uint32_t x = k < c->width ? k : c->width - 1;
        const float px = ((float)x + 0.5f) * c->pixel[0] - 1;
        for (int a = 0; a < 3; a++)
            t->column[k][a] = cgt_spe_normal(c->fwd[a] + px * c->right[a]);
        t->column[k][3] = 0;
    }
    for (uint32_t k = 0; k < rows; k++) {
        const uint32_t y = k < c->height ? k : c->height - 1;
        const float py = 1 - ((float)y + 0.5f) * c->pixel[1];
        for (int a = 0; a < 3; a++)
            t->row[k][a] = cgt_spe_normal(py * c->up[a]);
        t->row[k][3] = 0;
    }
    t->image.tiny = has_tiny((const float(*)[4])t->column, columns) || has_tiny((const float(*)[4])t->row, rows);
    for (int a = 0; a < 3; a++)
        t->image.eye[a] = cgt_spe_normal(c->eye[a]);
    t->image.t_min = cgt_spe_normal(limit_t(c->t_min));
    t->image.t_max = cgt_spe_normal(limit_t(c->t_max));
}

cgt_result cgt_camera_tables_init(cgt_camera_tables *tables, const cgt_memory_hooks *memory, const cgt_camera *camera,
                                  uint32_t width, uint32_t height, char message[CGT_PPE_MESSAGE_BYTES])
{
    char reason[CGT_CAMERA_MESSAGE_BYTES] = "";
    *tables = (cgt_camera_tables){.memory = *memory};
    if (width == 0 || height == 0 || width > CGT_FRAME_MAX_EDGE || height > CGT_FRAME_MAX_EDGE) {
        snprintf(message, CGT_PPE_MESSAGE_BYTES,
                 "a picture of %" PRIu32 " x %" PRIu32 " pixels: an edge has 1 to %u of them", width, height,
                 CGT_FRAME_MAX_EDGE);
        return width && height ? CGT_ERROR_TOO_LARGE : CGT_ERROR_INVALID_ARGUMENT;
    }
    cgt_result result = cgt_camera_prepare(camera, width, height, &tables->rays, reason);
    if (result != CGT_OK) {
        snprintf(message, CGT_PPE_MESSAGE_BYTES, "the camera: %s", reason);
        return result;
    }
    result = check(&tables->rays, message);
    if (result != CGT_OK)
        return result;
    tables->column_bytes = (size_t)(width + 3) / 4 * 64;
    tables->row_bytes = (size_t)(height + 3) / 4 * 64;
    tables->column = cgt_allocate(memory, tables->column_bytes);
    tables->row = cgt_allocate(memory, tables->row_bytes);
    if (!tables->column || !tables->row) {
        cgt_camera_tables_release(tables);
        snprintf(message, CGT_PPE_MESSAGE_BYTES, "out of memory for the tables of a camera");
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    fill(tables);
    return CGT_OK;
}

void cgt_camera_tables_release(cgt_camera_tables *tables)
{
    if (tables->column)
        cgt_free(&tables->memory, tables->column, tables->column_bytes);
    if (tables->row)
        cgt_free(&tables->memory, tables->row, tables->row_bytes);
    tables->column = tables->row = NULL;
}
