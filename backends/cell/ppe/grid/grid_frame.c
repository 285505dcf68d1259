/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of the grid program: control blocks, the id plane, and what comes back. */
#include "cell/ppe/grid/grid_frame.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "cell/ppe/frame_run.h"

#define MOST_ID_BYTES 0x80000000u /* of the id plane: from CGT_EA_IDS on */

typedef struct grid_frame {
    cgt_cell_frame run;
    const cgt_grid_frame_options *options;
    const cgt_grid_scene *scene;
    cgt_grid_image image;
    cgt_control_block control[CGT_MAX_SPES];
    cgt_grid_lighting light;
    uint32_t *ids, *output; /* the id plane, its rows row_bytes apart; the caller's */
    size_t id_bytes;
    uint32_t row_bytes;
} grid_frame;

/* ---- main memory ---- */

static uint32_t columns_of_strips(uint32_t width) { return (width + CGT_STRIP_WIDTH - 1) / CGT_STRIP_WIDTH; }

static void low_word(uint32_t word[2], uint32_t ea) { word[0] = 0, word[1] = ea; }

static void fill_control(cgt_cell_frame *run, uint32_t spe)
{
    grid_frame *const f = (grid_frame *)run;
    const cgt_grid_frame_options *const o = f->options;
    cgt_control_block *const b = &f->control[spe];
    *b = run->share[spe];
    b->magic = CGT_CONTROL_MAGIC;
    b->spe = spe;
    b->spes = o->cell.spes;
    b->width = run->tables.rays.width;
    b->height = run->tables.rays.height;
    b->strip_columns = columns_of_strips(b->width);
    b->row_bytes = f->row_bytes;
    b->half = run->half;
    b->flags |= (o->nested ? 0 : CGT_CONTROL_FLATTENED) | (o->retest ? 0 : CGT_CONTROL_REMEMBER) |
                (uint32_t)(o->cull ? o->cull : CGT_CULL_FRUSTUM) << CGT_CONTROL_CULL_SHIFT;
    low_word(b->scene, CGT_EA_SCENE);
    low_word(b->camera, CGT_EA_CAMERA);
    low_word(b->columns, CGT_EA_COLUMNS);
    low_word(b->rows, CGT_EA_ROWS);
    low_word(b->ids, CGT_EA_IDS);
    low_word(b->doubts, CGT_EA_DOUBTS + spe * 2 * run->half * (uint32_t)sizeof(cgt_doubt));
    if (f->light.image.sets) {
        low_word(b->light, CGT_EA_LIGHT);
        low_word(b->occluded, CGT_EA_OCCLUDED);
        b->occluded_bytes = (uint32_t)f->light.word_row;
    }
    low_word(b->report, CGT_EA_REPORT + spe * (uint32_t)sizeof(cgt_cell_report));
}

static cgt_result map(cgt_cell_frame *run)
{
    grid_frame *const f = (grid_frame *)run;
    const cgt_frame_region region[] = {{CGT_EA_CONTROL, f->control, sizeof f->control, false},
                                       {CGT_EA_SCENE, &f->image, sizeof f->image, false},
                                       {CGT_EA_LIGHT, &f->light.image, sizeof f->light.image, false},
                                       {CGT_EA_IDS, f->ids, f->id_bytes, true},
                                       {CGT_EA_OCCLUDED, f->light.word, f->light.word_bytes, true},
                                       {CGT_EA_OBJECTS, f->scene->object, f->scene->bytes, false}};
    return cgt_frame_map(run, region, sizeof region / sizeof region[0]);
}

/* ---- what comes back ---- */

static bool get_sphere(const void *scene, uint32_t object, cgt_decided_hit *hit)
{
    const cgt_grid_scene *const s = scene;
    if (object >= s->image.spheres)
        return false;
    const float *const q = s->object[object];
    *hit = (cgt_decided_hit){.primitive = {.kind = CGT_KIND_SPHERES, .sphere = {q[0], q[1], q[2], q[3]}}};
    return true;
}

static void take_doubt(cgt_cell_frame *run, const cgt_doubt *doubt)
{
    grid_frame *const f = (grid_frame *)run;
    if (f->light.image.sets && CGT_DOUBT_SET(doubt->object))
        cgt_grid_lighting_doubt(&f->light, doubt);
    else
        cgt_doubts_add(&run->doubts, doubt);
}

static cgt_result explain(const cgt_cell_frame *run, uint32_t spe, char message[CGT_CELL_MESSAGE_BYTES])
{
    static const char *const whys[] = {[CGT_REPORT_BAD_CONTROL] = "does not know the control block",
                                       [CGT_REPORT_SPHERES] = "has no room for so many spheres, but for",
                                       [CGT_REPORT_CELLS] = "has no room for so many voxels, but for",
                                       [CGT_REPORT_BAD_IMAGE] = "refuses the numbers of scene or camera; voxels:"};
    const cgt_spe_report *const p = &run->report[spe].grid;
    if (p->state == CGT_REPORT_OVERFLOW) {
        snprintf(message, CGT_CELL_MESSAGE_BYTES,
                 "too many spheres share cells: beside voxels of 16 references, %u bytes of them, local store has "
                 "room for %u more, %u bytes",
                 32 * CGT_GRID_CELLS, CGT_GRID_OVERFLOW, 8 * CGT_GRID_OVERFLOW);
        return CGT_ERROR_TOO_LARGE;
    }
    snprintf(message, CGT_CELL_MESSAGE_BYTES, "SPE %u: the program %s %" PRIu32, spe,
             p->state > CGT_REPORT_DONE && p->state <= CGT_REPORT_BAD_IMAGE ? whys[p->state]
                                                                            : "ended without a report, state",
             p->value);
    return CGT_ERROR_STOPPED;
}

static cgt_result finish(cgt_cell_frame *run, cgt_cell_frame_result *r)
{
    grid_frame *const f = (grid_frame *)run;
    const uint32_t width = run->tables.rays.width, height = run->tables.rays.height, stride = f->row_bytes / 4;
    for (uint32_t y = 0; y < height && !run->options->keep_doubts; y++)
        for (uint32_t x = 0; x < width; x++)
            if (cgt_doubts_finish(&run->doubts, x, y, &f->ids[(size_t)y * stride + x]) && f->light.image.sets)
                f->light.decided[(size_t)y * width + x] |= CGT_LIGHT_ALL;
    if (f->light.image.sets)
        cgt_grid_lighting_finish(&f->light, f->ids, stride, f->options->occluded);
    r->light_doubts = f->light.doubts;
    r->light_pixels = f->light.pixels;
    for (uint32_t y = 0; y < height; y++)
        memcpy(f->output + (size_t)y * width, f->ids + (size_t)y * stride, (size_t)width * 4);
    return CGT_OK;
}

/* ---- a frame ---- */

static const cgt_frame_program program = {.pieces = "strips",
                                          .map = map,
                                          .fill_control = fill_control,
                                          .take_doubt = take_doubt,
                                          .explain = explain,
                                          .finish = finish};

static cgt_result allocate(grid_frame *f, char message[CGT_CELL_MESSAGE_BYTES])
{
    const uint32_t width = f->run.tables.rays.width, height = f->run.tables.rays.height;
    f->row_bytes = (width + 31) / 32 * 128;
    f->id_bytes = (size_t)f->row_bytes * height;
    if (f->id_bytes > MOST_ID_BYTES) {
        snprintf(message, CGT_CELL_MESSAGE_BYTES, "%" PRIu32 " x %" PRIu32 " ids exceed the 2 GB of addresses for them",
                 width, height);
        return CGT_ERROR_TOO_LARGE;
    }
    f->ids = cgt_frame_allocate(&f->run, f->id_bytes, 0xff, message);
    return f->ids ? CGT_OK : CGT_ERROR_OUT_OF_MEMORY;
}

static cgt_result trace(grid_frame *f, const cgt_camera *camera, uint32_t width, uint32_t height,
                        cgt_cell_frame_result *r)
{
    const uint32_t strips = columns_of_strips(width) * ((height + CGT_STRIP_ROWS - 1) / CGT_STRIP_ROWS);
    cgt_result code = cgt_frame_begin(&f->run, camera, width, height, r->message);
    if (code == CGT_OK)
        code =
            cgt_grid_lighting_init(&f->light, f->run.memory, f->options->light, &f->run.tables, f->scene, r->message);
    f->light.decide = &f->run.doubts;
    if (code == CGT_OK)
        code = allocate(f, r->message);
    return code == CGT_OK ? cgt_frame_run(&f->run, strips, get_sphere, f->scene, r) : code;
}

cgt_result cgt_grid_frame_trace(const cgt_grid_scene *scene, const cgt_camera *camera, uint32_t width, uint32_t height,
                                const cgt_grid_frame_options *options, uint32_t *ids, cgt_cell_frame_result *result)
{
    *result = (cgt_cell_frame_result){.cycles = 0};
    const char *const wrong = cgt_frame_check_options(&options->cell);
    if (wrong)
        return cgt_frame_refuse(result, wrong);
    if ((unsigned)options->cull > CGT_CULL_BLOCKS)
        return cgt_frame_refuse(result, "culling is unknown");
    if (options->light && !options->occluded)
        return cgt_frame_refuse(result, "rays from hits want an array `occluded`");
    grid_frame f = {.run = {.program = &program, .options = &options->cell, .memory = &scene->memory},
                    .options = options,
                    .scene = scene,
                    .image = scene->image,
                    .output = ids};
    low_word(f.image.objects, CGT_EA_OBJECTS);
    const cgt_result code = trace(&f, camera, width, height, result);
    if (f.ids)
        cgt_free(&scene->memory, f.ids, f.id_bytes);
    cgt_grid_lighting_release(&f.light);
    cgt_frame_release(&f.run);
    return code;
}
