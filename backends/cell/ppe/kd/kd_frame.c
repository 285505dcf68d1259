/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames of the kd program: control blocks, events, and what comes back. */
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
    i->width = f->tables.rays.width;
    i->height = f->tables.rays.height;
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

static void fill_control(kd_frame *f, uint32_t spe)
{
    const cgt_control_block *const share = &f->share[spe];
    const uint32_t spes = f->run_options.spes, all = f->image.envelopes;
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
                          .half = f->half,
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
    c->doubts[1] = CGT_EA_DOUBTS + spe * 2 * f->half * (uint32_t)sizeof(cgt_doubt);
    c->report[1] = CGT_EA_REPORT + spe * (uint32_t)sizeof(cgt_kd_report);
}

/* ---- the PPE ---- */

/* A doubt of a secondary ray. */
static void decide_secondary(kd_frame *f, const cgt_doubt *doubt)
{
    const uint32_t number = doubt->pixel & ~CGT_KD_SECONDARY, lane = number % 4;
    cgt_kd_secondary_tile tile;
    uint8_t *const decided = f->array[KD_ARRAY_DECIDED];
    if (!f->batches || !f->tiles || number / 4 >= f->bytes[KD_ARRAY_SECONDARY] / sizeof tile ||
        !cgt_cell_read(f->run.cell, CGT_KD_EA(CGT_KD_SECONDARY_RAYS) + (uint64_t)(number / 4) * sizeof tile, &tile,
                       sizeof tile)) {
        f->broken = true;
        return;
    }
    if (decided[number / 8] >> number % 8 & 1)
        return;
    const uint32_t batch = number / 4 / f->tiles % f->batches;
    const cgt_ray ray = cgt_kd_frame_secondary_ray(f, &tile, batch, lane);
    if (cgt_kd_frame_is_mirror(f, batch)) {
        const size_t envelope = number / 4 / f->tiles / f->batches, k = number / 4 % f->tiles;
        uint32_t *const nearest = f->array[KD_ARRAY_REFLECTED];
        cgt_kd_doubts_keep(&f->doubts, &ray, doubt->object, &nearest[(envelope * f->tiles + k) * 4 + lane]);
        return;
    }
    if (cgt_kd_doubts_hit(&f->doubts, &ray, doubt->object))
        decided[number / 8] |= (uint8_t)(1u << number % 8);
}

static void read_doubts(kd_frame *f, unsigned spe, uint32_t half, uint32_t count)
{
    const uint64_t ea = CGT_EA_DOUBTS + (uint64_t)(spe * 2 + half) * f->half * sizeof(cgt_doubt);
    cgt_doubt line[CGT_DOUBTS_LINE];
    f->broken |= half > 1 || count > f->half;
    for (uint32_t at = 0; !f->broken && at < count; at += CGT_DOUBTS_LINE) {
        f->broken |= !cgt_cell_read(f->run.cell, ea + at * sizeof line[0], line, sizeof line);
        const uint32_t some = count - at < CGT_DOUBTS_LINE ? count - at : CGT_DOUBTS_LINE;
        for (uint32_t k = 0; k < some && !f->broken; k++) {
            f->doubts.doubts++;
            if (line[k].pixel & CGT_KD_SECONDARY)
                decide_secondary(f, &line[k]);
            else
                cgt_kd_doubts_add(&f->doubts, &line[k]);
        }
    }
}

static bool uses_mailboxes(const kd_frame *f) { return (f->share[0].flags & CGT_CONTROL_MAILBOX) != 0; }

/* An SPE has ended its phase: all go on where it is the last one. */
static void act_on_barrier(kd_frame *f, cgt_cell *cell)
{
    const uint32_t spes = f->run_options.spes;
    if (++f->waiting < spes)
        return;
    f->waiting = 0;
    f->assigner.next = f->fixed;
    for (unsigned i = 0; i < spes; i++) {
        f->messages[i]++;
        f->broken |= !cgt_cell_send_mailbox(cell, i, CGT_KD_PHASE);
        if (uses_mailboxes(f))
            f->broken |= !cgt_assigner_send(&f->assigner, cell, i);
    }
}

static void act(void *user, cgt_cell *cell, const cgt_ppe_event *event)
{
    kd_frame *const f = user;
    const unsigned spe = event->spe;
    switch (event->kind) {
    case CGT_PPE_MAILBOX:
        f->messages[spe]++;
        if (event->value == CGT_KD_PHASE)
            act_on_barrier(f, cell);
        else
            f->broken |= !uses_mailboxes(f) || !cgt_assigner_send(&f->assigner, cell, spe);
        return;
    case CGT_PPE_INTERRUPT:
        f->messages[spe]++;
        f->interrupts++;
        read_doubts(f, spe, event->value >> 16, event->value & 0xffff);
        cgt_cell_send_signal(cell, spe, 1, 1u << (event->value >> 16 & 1));
        return;
    case CGT_PPE_START:
    case CGT_PPE_STOPPED: return;
    }
}

/* ---- what comes back ---- */

static cgt_result check_reports(const kd_frame *f, cgt_kd_frame_result *r)
{
    for (unsigned i = 0; i < f->run_options.spes; i++) {
        const cgt_kd_report *const p = &f->report[i];
        if (p->state == CGT_KD_STATE_DONE)
            continue;
        if (p->state == CGT_KD_STATE_BROKEN) {
            snprintf(r->message, sizeof r->message,
                     "SPE %u: a tree of the scene is broken: it has loops, is too deep, or names what there is not", i);
            return CGT_ERROR_STOPPED;
        }
        if (p->state == CGT_KD_STATE_OTHER_TREE) {
            snprintf(r->message, sizeof r->message,
                     "SPE %u: the scene has %s, for the program %s, and this is the other one", i,
                     f->scene->bih ? "bounding interval hierarchies" : "kd-trees",
                     f->scene->bih ? "spe_bih" : "spe_kd");
            return CGT_ERROR_STOPPED;
        }
        snprintf(r->message, sizeof r->message, "SPE %u: the program %s %" PRIu32, i,
                 p->state == CGT_KD_STATE_BAD_CONTROL ? "does not know the control block"
                 : p->state == CGT_KD_STATE_CACHES    ? "has no room for so large caches, but for bytes:"
                                                      : "ended without a report, state",
                 p->value);
        return CGT_ERROR_STOPPED;
    }
    return CGT_OK;
}

static void gather(const kd_frame *f, cgt_kd_frame_result *r)
{
    for (unsigned i = 0; i < f->run_options.spes; i++) {
        const cgt_spe_result spe = cgt_cell_get_result(f->run.cell, i);
        r->spe[i] = (cgt_kd_frame_spe){.report = f->report[i],
                                       .cycles = spe.cycle,
                                       .waits = spe.counts.wait_cycles,
                                       .messages = f->messages[i] + f->assigner.messages[i],
                                       .counts = spe.counts};
        r->cycles = spe.cycle > r->cycles ? spe.cycle : r->cycles;
    }
    for (unsigned i = 0; i < f->run_options.spes; i++)
        r->spe[i].idle = r->cycles - r->spe[i].cycles;
    r->interrupts = f->interrupts;
}

/* ---- the run ---- */

static cgt_result run(kd_frame *f, cgt_kd_frame_result *r)
{
    const cgt_cell_frame_options *const o = &f->run_options;
    const cgt_cell_options cell = {
        .spes = o->spes, .ppe_cycles = o->ppe_cycles, .cycle_limit = o->cycle_limit, .watch_buffers = true};
    cgt_result result = cgt_cell_create(&cell, &f->run.cell);
    if (result == CGT_OK)
        result = cgt_kd_frame_map(f);
    for (unsigned i = 0; i < o->spes && result == CGT_OK; i++)
        result = cgt_cell_set_signal_or(f->run.cell, i, 1, true);
    if (result != CGT_OK) {
        snprintf(r->message, sizeof r->message, "the machine cannot be set up: %s", cgt_get_result_string(result));
        return result;
    }
    cgt_assign(o->assignment, o->share ? o->share : CGT_HYBRID_SHARE, f->image.envelopes, o->spes, f->share,
               &f->assigner);
    f->fixed = f->assigner.next;
    for (unsigned i = 0; i < o->spes; i++)
        fill_control(f, i);
    result =
        o->elf ? cgt_frame_run_simulated(&f->run, act, r->message) : cgt_frame_run_native(&f->run, act, r->message);
    if (result == CGT_OK)
        result = check_reports(f, r);
    if (result != CGT_OK)
        return result;
    gather(f, r);
    for (unsigned i = 0; i < o->spes; i++)
        read_doubts(f, i, f->report[i].rest_half, f->report[i].rest);
    result = cgt_kd_frame_write(f);
    r->doubts = f->doubts.doubts;
    r->exact = f->doubts.exact;
    r->changed = f->doubts.changed;
    if (result != CGT_OK)
        snprintf(r->message, sizeof r->message, "secondary rays of changed pixels: %s", cgt_get_result_string(result));
    else if (f->broken || f->doubts.bad) {
        snprintf(r->message, sizeof r->message, "the program does not keep the protocol of envelopes and doubts");
        result = CGT_ERROR_STOPPED;
    }
    return result;
}

/* ---- the call ---- */

static cgt_result trace(kd_frame *f, cgt_kd_frame_result *r)
{
    fill_image(f);
    f->tiles = f->image.tiles_x * f->image.tiles_y;
    f->batches = f->image.lights + f->image.ambient + f->image.mirror;
    f->half = f->options->cell.doubts_half ? f->options->cell.doubts_half : CGT_DOUBTS_HALF;
    const char *const wrong = cgt_kd_frame_check(f);
    if (wrong) {
        snprintf(r->message, sizeof r->message, "%s", wrong);
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    const cgt_result result = cgt_kd_frame_allocate(f, r->message);
    if (result != CGT_OK)
        return result;
    fill_infos(f);
    cgt_kd_doubts_init(&f->doubts, &f->tables.rays, f->scene, f->array[KD_ARRAY_NEAREST]);
    if (f->image.mirror)
        memset(f->array[KD_ARRAY_REFLECTED], 0xff, f->bytes[KD_ARRAY_REFLECTED]);
    return run(f, r);
}

cgt_result cgt_kd_frame_trace(const cgt_kd_scene *scene, const cgt_camera *camera, uint32_t width, uint32_t height,
                              const cgt_kd_frame_options *options, const cgt_kd_frame_output *output,
                              cgt_kd_frame_result *result)
{
    *result = (cgt_kd_frame_result){.cycles = 0};
    const char *const wrong = cgt_kd_frame_check_options(options);
    if (wrong) {
        snprintf(result->message, sizeof result->message, "%s", wrong);
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    kd_frame *const f = cgt_allocate(&scene->memory, sizeof *f);
    if (!f) {
        snprintf(result->message, sizeof result->message, "out of memory for a frame");
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    memset(f, 0, sizeof *f);
    f->scene = scene;
    f->options = options;
    f->output = output;
    f->run_options = options->cell;
    f->run_scene.memory = scene->memory;
    f->run.options = &f->run_options;
    f->run.scene = &f->run_scene;
    cgt_result code = cgt_camera_tables_init(&f->tables, &scene->memory, camera, width, height, result->message);
    if (code == CGT_OK) {
        code = trace(f, result);
        cgt_kd_frame_release(f);
    }
    cgt_free(&scene->memory, f, sizeof *f);
    return code;
}
