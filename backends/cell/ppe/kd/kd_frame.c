/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of the kd program: the image of the frame, control blocks, and what comes back. */
#include "cell/ppe/kd/kd_frame.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cell/ppe/kd/kd_frame_memory.h"

/* ---- the images ---- */

/* Directions evenly spread over the sphere: latitudes in steps, longitudes by the golden angle. They are part of the
 * figures, so they are computed in double and rounded. */
static void fill_directions(float (*direction)[4])
{
    for (uint32_t k = 0; k < CGT_KD_DIRECTIONS; k++) {
        const double z = 1 - (2 * k + 1) / (double)CGT_KD_DIRECTIONS, r = sqrt(1 - z * z),
                     angle = k * 2.399963229728653;
        direction[k][0] = (float)(r * cos(angle));
        direction[k][1] = (float)(r * sin(angle));
        direction[k][2] = (float)z;
        direction[k][3] = 0;
    }
}

static cgt_kd_cache_size size_or(cgt_kd_cache_size size, cgt_kd_cache_size otherwise)
{
    return size.blocks ? size : otherwise;
}

static void fill_image(kd_frame *f)
{
    const cgt_kd_frame_options *const o = f->options;
    cgt_kd_frame_image *const i = &f->image;
    i->width = f->run.tables.rays.width;
    i->height = f->run.tables.rays.height;
    i->tiles_x = o->tiles_x ? o->tiles_x : CGT_KD_TILES_EDGE;
    i->tiles_y = o->tiles_y ? o->tiles_y : CGT_KD_TILES_EDGE;
    i->across = (i->width + 2 * i->tiles_x - 1) / (2 * i->tiles_x);
    i->envelopes = i->across * ((i->height + 2 * i->tiles_y - 1) / (2 * i->tiles_y));
    i->parts = f->scene->parts;
    i->batch = o->batch ? o->batch : 16;
    i->nodes = size_or(o->nodes, f->scene->bih ? CGT_KD_BIH_BLOCKS : CGT_KD_NODE_BLOCKS);
    i->references = size_or(o->references, CGT_KD_REFERENCE_BLOCKS);
    i->leaves = size_or(o->leaves, CGT_KD_LEAF_BLOCKS);
    i->triangles = size_or(o->triangles, CGT_KD_TRIANGLE_SLOTS);
    i->camera[1] = CGT_EA_CAMERA;
    i->columns[1] = CGT_EA_COLUMNS;
    i->rows[1] = CGT_EA_ROWS;
    i->lights = o->lights;
    i->ambient = o->ambient;
    i->scale = f->scene->scale;
    i->triangle_count = f->scene->triangles;
    i->light_t_min = o->light_t_min;
    i->ambient_t_min = o->ambient_t_min;
    i->ambient_t_max = o->ambient_t_max;
    i->mirror = o->mirror;
    i->mirror_t_min = o->mirror_t_min;
    i->mirror_t_max = o->mirror_t_max;
    for (uint32_t k = 0; k < o->lights; k++)
        for (int a = 0; a < 3; a++)
            i->light[k][a] = o->light[k][a];
    fill_directions(f->direction + 16);
}

static void fill_infos(kd_frame *f)
{
    cgt_kd_info *const info = f->array[KD_ARRAY_INFOS];
    for (uint32_t k = 0; k < f->image.envelopes; k++)
        info[k] =
            (cgt_kd_info){k, k % f->image.across * 2 * f->image.tiles_x, k / f->image.across * 2 * f->image.tiles_y, 0};
}

static void fill_control(cgt_cell_frame *run, uint32_t spe)
{
    kd_frame *const f = (kd_frame *)run;
    const cgt_control_block *const share = &run->share[spe];
    const uint32_t spes = run->options->spes, all = f->image.envelopes;
    const uint32_t low = (uint32_t)((uint64_t)all * spe / spes), high = (uint32_t)((uint64_t)all * (spe + 1) / spes);
    cgt_kd_control *const c = &f->control[spe];
    *c = (cgt_kd_control){.magic = CGT_KD_MAGIC,
                          .spe = spe,
                          .spes = spes,
                          .first = share->first,
                          .envelopes = share->strips,
                          .step = share->step,
                          .setup_first = low,
                          .setup_envelopes = high - low,
                          .half = run->half,
                          .frame = {0, CGT_KD_EA_FRAME},
                          .parts = {0, CGT_EA_SCENE},
                          .infos = {CGT_KD_INFOS, 0},
                          .rays = {CGT_KD_RAYS, 0},
                          .ray_infos = {CGT_KD_RAY_INFOS, 0},
                          .hits = {CGT_KD_HITS, 0},
                          .secondary = {CGT_KD_SECONDARY_RAYS, 0},
                          .occlusion = {CGT_KD_OCCLUSION, 0},
                          .triangles = {CGT_KD_TRIANGLES, 0}};
    c->flags = (share->flags & CGT_CONTROL_MAILBOX ? CGT_KD_MAILBOX : 0) | (f->scene->ropes ? CGT_KD_ROPES : 0) |
               (f->options->prefetch ? CGT_KD_PREFETCH : 0) | (f->scene->bih ? CGT_KD_BIH : 0);
    c->doubts[1] = CGT_EA_DOUBTS + spe * 2 * run->half * (uint32_t)sizeof(cgt_doubt);
    c->report[1] = CGT_EA_REPORT + spe * (uint32_t)sizeof(cgt_cell_report);
}

/* ---- doubts ---- */

/* A doubt of a secondary ray. */
static void decide_secondary(kd_frame *f, const cgt_doubt *doubt)
{
    const uint32_t number = doubt->pixel & ~CGT_KD_SECONDARY, lane = number % 4;
    cgt_kd_secondary_tile tile;
    uint8_t *const decided = f->array[KD_ARRAY_DECIDED];
    if (!f->batches || !f->tiles || number / 4 >= f->bytes[KD_ARRAY_SECONDARY] / sizeof tile ||
        !cgt_cell_read(f->run.cell, CGT_KD_EA(CGT_KD_SECONDARY_RAYS) + (uint64_t)(number / 4) * sizeof tile, &tile,
                       sizeof tile)) {
        f->run.broken = true;
        return;
    }
    if (decided[number / 8] >> number % 8 & 1)
        return;
    const uint32_t batch = number / 4 / f->tiles % f->batches;
    const cgt_ray ray = cgt_kd_frame_secondary_ray(f, &tile, batch, lane);
    if (cgt_kd_frame_is_mirror(f, batch)) {
        const size_t envelope = number / 4 / f->tiles / f->batches, k = number / 4 % f->tiles;
        uint32_t *const nearest = f->array[KD_ARRAY_REFLECTED];
        cgt_doubts_keep(&f->run.doubts, &ray, doubt->object, &nearest[(envelope * f->tiles + k) * 4 + lane]);
        return;
    }
    if (cgt_doubts_hit(&f->run.doubts, &ray, doubt->object))
        decided[number / 8] |= (uint8_t)(1u << number % 8);
}

static void take_doubt(cgt_cell_frame *run, const cgt_doubt *doubt)
{
    if (!(doubt->pixel & CGT_KD_SECONDARY)) {
        cgt_doubts_add(&run->doubts, doubt);
        return;
    }
    run->doubts.doubts++;
    decide_secondary((kd_frame *)run, doubt);
}

/* ---- what comes back ---- */

static cgt_result explain(const cgt_cell_frame *run, uint32_t spe, char message[CGT_CELL_MESSAGE_BYTES])
{
    const cgt_kd_report *const p = &run->report[spe].kd;
    const bool bih = ((const kd_frame *)run)->scene->bih;
    if (p->state == CGT_KD_STATE_BROKEN)
        snprintf(message, CGT_CELL_MESSAGE_BYTES,
                 "SPE %u: a tree of the scene is broken: it has loops, is too deep, or names what there is not", spe);
    else if (p->state == CGT_KD_STATE_OTHER_TREE)
        snprintf(message, CGT_CELL_MESSAGE_BYTES,
                 "SPE %u: the scene has %s, for the program %s, and this is the other one", spe,
                 bih ? "bounding interval hierarchies" : "kd-trees", bih ? "spe_bih" : "spe_kd");
    else
        snprintf(message, CGT_CELL_MESSAGE_BYTES, "SPE %u: the program %s %" PRIu32, spe,
                 p->state == CGT_KD_STATE_BAD_CONTROL ? "does not know the control block"
                 : p->state == CGT_KD_STATE_CACHES    ? "has no room for so large caches, but for bytes:"
                                                      : "ended without a report, state",
                 p->value);
    return CGT_ERROR_STOPPED;
}

static cgt_result finish(cgt_cell_frame *run, cgt_cell_frame_result *r)
{
    const cgt_result result = cgt_kd_frame_write((kd_frame *)run);
    if (result != CGT_OK)
        snprintf(r->message, sizeof r->message, "secondary rays of changed pixels: %s", cgt_get_result_string(result));
    return result;
}

/* ---- the call ---- */

static const cgt_frame_program program = {.has_phases = true,
                                          .pieces = "envelopes",
                                          .map = cgt_kd_frame_map,
                                          .fill_control = fill_control,
                                          .take_doubt = take_doubt,
                                          .explain = explain,
                                          .finish = finish};

static cgt_result trace(kd_frame *f, const cgt_camera *camera, uint32_t width, uint32_t height,
                        cgt_cell_frame_result *r)
{
    cgt_result result = cgt_frame_begin(&f->run, camera, width, height, r->message);
    if (result != CGT_OK)
        return result;
    fill_image(f);
    f->tiles = f->image.tiles_x * f->image.tiles_y;
    f->batches = f->image.lights + f->image.ambient + f->image.mirror;
    const char *const wrong = cgt_kd_frame_check(f);
    if (wrong)
        return cgt_frame_refuse(r, wrong);
    result = cgt_kd_frame_allocate(f, r->message);
    if (result != CGT_OK)
        return result;
    fill_infos(f);
    return cgt_frame_run(&f->run, f->image.envelopes, cgt_kd_scene_get, f->scene, r);
}

cgt_result cgt_kd_frame_trace(const cgt_kd_scene *scene, const cgt_camera *camera, uint32_t width, uint32_t height,
                              const cgt_kd_frame_options *options, const cgt_kd_frame_output *output,
                              cgt_cell_frame_result *result)
{
    *result = (cgt_cell_frame_result){.cycles = 0};
    const char *const wrong = cgt_kd_frame_check_options(options);
    if (wrong)
        return cgt_frame_refuse(result, wrong);
    kd_frame f = {.run = {.program = &program, .options = &options->cell, .memory = &scene->memory},
                  .scene = scene,
                  .options = options,
                  .output = output};
    const cgt_result code = trace(&f, camera, width, height, result);
    cgt_kd_frame_release(&f);
    return code;
}
