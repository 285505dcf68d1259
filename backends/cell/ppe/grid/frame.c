/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames on a Cell: memory, events, and the run. */
#include "cell/ppe/grid/frame.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "cell/ppe/grid/doubts.h"
#include "cell/ppe/grid/frame_run.h"

/* ---- main memory ---- */

static uint32_t columns_of_strips(uint32_t width) { return (width + CGT_STRIP_WIDTH - 1) / CGT_STRIP_WIDTH; }
static uint32_t count_strips(uint32_t width, uint32_t height)
{
    return columns_of_strips(width) * ((height + CGT_STRIP_ROWS - 1) / CGT_STRIP_ROWS);
}

static void low_word(uint32_t word[2], uint32_t ea) { word[0] = 0, word[1] = ea; }

static void fill_block(const frame *f, uint32_t spe, cgt_control_block *b)
{
    const cgt_cell_frame_options *o = f->options;
    *b = (cgt_control_block){.magic = CGT_CONTROL_MAGIC,
                             .spe = spe,
                             .spes = o->spes,
                             .width = f->tables.rays.width,
                             .height = f->tables.rays.height,
                             .strip_columns = columns_of_strips(f->tables.rays.width),
                             .row_bytes = f->row_bytes,
                             .half = f->half};
    b->flags = (o->nested ? 0 : CGT_CONTROL_FLATTENED) | (o->retest ? 0 : CGT_CONTROL_REMEMBER) |
               (uint32_t)(o->cull ? o->cull : CGT_CULL_FRUSTUM) << CGT_CONTROL_CULL_SHIFT;
    low_word(b->scene, CGT_EA_SCENE);
    low_word(b->camera, CGT_EA_CAMERA);
    low_word(b->columns, CGT_EA_COLUMNS);
    low_word(b->rows, CGT_EA_ROWS);
    low_word(b->ids, CGT_EA_IDS);
    low_word(b->doubts, CGT_EA_DOUBTS + spe * 2 * f->half * (uint32_t)sizeof(cgt_doubt));
    if (f->light.image.sets) {
        low_word(b->light, CGT_EA_LIGHT);
        low_word(b->occluded, CGT_EA_OCCLUDED);
        b->occluded_bytes = (uint32_t)f->light.word_row;
    }
    low_word(b->report, CGT_EA_REPORT + spe * (uint32_t)sizeof(cgt_spe_report));
}

static cgt_result add_memory(frame *f)
{
    cgt_camera_tables *const t = &f->tables;
    struct {
        uint64_t ea;
        void *memory;
        uint64_t bytes;
        bool writable;
    } region[] = {{CGT_EA_CONTROL, f->control, sizeof f->control, false},
                  {CGT_EA_REPORT, f->report, sizeof f->report, true},
                  {CGT_EA_CAMERA, &t->image, sizeof t->image, false},
                  {CGT_EA_SCENE, &f->image, sizeof f->image, false},
                  {CGT_EA_COLUMNS, t->column, t->column_bytes, false},
                  {CGT_EA_ROWS, t->row, t->row_bytes, false},
                  {CGT_EA_DOUBTS, f->ring, f->ring_bytes, true},
                  {CGT_EA_LIGHT, &f->light.image, sizeof f->light.image, false},
                  {CGT_EA_IDS, f->ids, f->id_bytes, true},
                  {CGT_EA_OCCLUDED, f->light.word, f->light.word_bytes, true},
                  {CGT_EA_OBJECTS, f->scene->object, f->scene->bytes, false}};
    for (size_t i = 0; i < sizeof region / sizeof region[0]; i++) {
        if (!region[i].bytes)
            continue;
        const cgt_result result =
            cgt_cell_add_memory(f->cell, region[i].ea, region[i].memory, region[i].bytes / 4, 4, region[i].writable);
        if (result != CGT_OK)
            return result;
    }
    return CGT_OK;
}

/* ---- the PPE ---- */

static void read_doubts(frame *f, unsigned spe, uint32_t half, uint32_t count)
{
    const uint64_t ea = CGT_EA_DOUBTS + (uint64_t)(spe * 2 + half) * f->half * sizeof(cgt_doubt);
    cgt_doubt line[CGT_DOUBTS_LINE];
    f->broken |= half > 1 || count > f->half;
    for (uint32_t at = 0; !f->broken && at < count; at += CGT_DOUBTS_LINE) {
        f->broken |= !cgt_cell_read(f->cell, ea + at * sizeof line[0], line, sizeof line);
        if (!f->broken)
            cgt_doubts_add(&f->doubts, line, count - at < CGT_DOUBTS_LINE ? count - at : CGT_DOUBTS_LINE);
    }
}

static void act(void *user, cgt_cell *cell, const cgt_ppe_event *event)
{
    frame *const f = user;
    const bool mailboxes = (f->control[0].flags & CGT_CONTROL_MAILBOX) != 0;
    const unsigned spe = event->spe;
    switch (event->kind) {
    case CGT_PPE_START:
        for (unsigned i = 0; i < f->options->spes && mailboxes; i++)
            f->broken |= !cgt_assigner_send(&f->assigner, cell, i);
        return;
    case CGT_PPE_MAILBOX:
        f->assigner.messages[spe]++;
        f->broken |= !mailboxes || !cgt_assigner_send(&f->assigner, cell, spe);
        return;
    case CGT_PPE_INTERRUPT:
        f->assigner.messages[spe]++;
        f->interrupts++;
        read_doubts(f, spe, event->value >> 16, event->value & 0xffff);
        cgt_cell_send_signal(cell, spe, 1, 1u << (event->value >> 16 & 1));
        return;
    case CGT_PPE_STOPPED: return;
    }
}

/* ---- the run ---- */

static cgt_result check_reports(frame *f, cgt_cell_frame_result *r)
{
    static const char *const whys[] = {[CGT_REPORT_BAD_CONTROL] = "does not know the control block",
                                       [CGT_REPORT_SPHERES] = "has no room for so many spheres, but for",
                                       [CGT_REPORT_CELLS] = "has no room for so many voxels, but for",
                                       [CGT_REPORT_BAD_IMAGE] = "refuses the numbers of scene or camera; voxels:"};
    for (unsigned i = 0; i < f->options->spes; i++) {
        const cgt_spe_report *p = &f->report[i];
        if (p->state == CGT_REPORT_DONE)
            continue;
        if (p->state == CGT_REPORT_OVERFLOW) {
            snprintf(r->message, sizeof r->message,
                     "too many spheres share cells: beside voxels of 16 references, %u bytes of them, local store has "
                     "room for %u more, %u bytes",
                     32 * CGT_GRID_CELLS, CGT_GRID_OVERFLOW, 8 * CGT_GRID_OVERFLOW);
            return CGT_ERROR_TOO_LARGE;
        }
        snprintf(r->message, sizeof r->message, "SPE %u: the program %s %" PRIu32, i,
                 p->state > CGT_REPORT_DONE && p->state <= CGT_REPORT_BAD_IMAGE ? whys[p->state]
                                                                                : "ended without a report, state",
                 p->value);
        return CGT_ERROR_STOPPED;
    }
    return CGT_OK;
}

static void gather(frame *f, cgt_cell_frame_result *r)
{
    for (unsigned i = 0; i < f->options->spes; i++) {
        const cgt_spe_result spe = cgt_cell_get_result(f->cell, i);
        r->spe[i] = (cgt_cell_frame_spe){.report = f->report[i],
                                         .cycles = spe.cycle,
                                         .waits = spe.counts.wait_cycles,
                                         .messages = f->assigner.messages[i],
                                         .counts = spe.counts,
                                         .waited = spe.waits};
        r->cycles = spe.cycle > r->cycles ? spe.cycle : r->cycles;
    }
    for (unsigned i = 0; i < f->options->spes; i++)
        r->spe[i].idle = r->cycles - r->spe[i].cycles;
    r->interrupts = f->interrupts;
}

static cgt_result run(frame *f, uint32_t *ids, cgt_cell_frame_result *r)
{
    const cgt_cell_frame_options *o = f->options;
    const cgt_cell_options cell = {.spes = o->spes,
                                   .timing = o->timing,
                                   .ppe_cycles = o->ppe_cycles,
                                   .cycle_limit = o->cycle_limit,
                                   .watch_buffers = true};
    const uint32_t width = f->tables.rays.width, height = f->tables.rays.height;
    cgt_result result = cgt_cell_create(&cell, &f->cell);
    if (result == CGT_OK)
        result = add_memory(f);
    for (unsigned i = 0; i < o->spes && result == CGT_OK; i++) {
        fill_block(f, i, &f->control[i]);
        result = cgt_cell_set_signal_or(f->cell, i, 1, true);
    }
    if (result != CGT_OK) {
        snprintf(r->message, sizeof r->message, "the machine cannot be set up: %s", cgt_get_result_string(result));
        return result;
    }
    cgt_assign(o->assignment, o->share ? o->share : CGT_HYBRID_SHARE, count_strips(width, height), o->spes, f->control,
               &f->assigner);
    result = o->elf ? cgt_frame_run_simulated(f, act, r->message) : cgt_frame_run_native(f, act, r->message);
    if (result == CGT_OK)
        result = check_reports(f, r);
    if (result != CGT_OK)
        return result;
    gather(f, r);
    for (unsigned i = 0; i < o->spes; i++)
        read_doubts(f, i, f->report[i].rest_half, f->report[i].rest);
    if (!o->keep_doubts)
        cgt_doubts_finish(&f->doubts, f->ids, f->row_bytes / 4);
    if (f->light.image.sets)
        cgt_frame_light_finish(&f->light, f->ids, f->row_bytes / 4, o->occluded);
    r->doubts = f->doubts.doubts;
    r->light_doubts = f->light.doubts;
    r->light_pixels = f->light.pixels;
    r->exact = f->doubts.exact + f->light.exact;
    r->changed = f->doubts.changed;
    if (f->broken || f->doubts.bad || f->light.bad) {
        snprintf(r->message, sizeof r->message, "the program does not keep the protocol of strips and doubts");
        return CGT_ERROR_STOPPED;
    }
    for (uint32_t y = 0; y < height; y++)
        memcpy(ids + (size_t)y * width, f->ids + (size_t)y * f->row_bytes / 4, (size_t)width * 4);
    return CGT_OK;
}

/* ---- a frame ---- */

static const char *check_options(const cgt_cell_frame_options *o)
{
    if (o->spes < 1 || o->spes > CGT_MAX_SPES)
        return "a frame needs 1 to 16 SPEs";
    if (!o->function == !o->elf)
        return "a frame needs a program: a function or an ELF file, not both";
    if ((unsigned)o->assignment >= CGT_ASSIGNMENTS || o->share > 100)
        return "the assignment is unknown, or its share is above 100 percent";
    if (o->doubts_half % CGT_DOUBTS_LINE || o->doubts_half > 32768)
        return "half a ring of doubts is a multiple of 16 up to 32,768";
    if ((unsigned)o->cull > CGT_CULL_BLOCKS)
        return "culling is unknown";
    if (o->light && !o->occluded)
        return "rays from hits want an array `occluded`";
    return NULL;
}

static cgt_result allocate(frame *f, cgt_cell_frame_result *r)
{
    const uint32_t width = f->tables.rays.width, height = f->tables.rays.height;
    f->row_bytes = (width + 31) / 32 * 128;
    f->half = f->options->doubts_half ? f->options->doubts_half : CGT_DOUBTS_HALF;
    f->id_bytes = (size_t)f->row_bytes * height;
    f->nearest_bytes = (size_t)width * height * 4;
    f->ring_bytes = (size_t)f->options->spes * 2 * f->half * sizeof(cgt_doubt);
    if (f->id_bytes > CGT_FRAME_MAX_BYTES) {
        snprintf(r->message, sizeof r->message, "%" PRIu32 " x %" PRIu32 " ids exceed the 2 GB of addresses for them",
                 width, height);
        return CGT_ERROR_TOO_LARGE;
    }
    const cgt_memory_hooks *const memory = &f->scene->memory;
    f->ids = cgt_allocate(memory, f->id_bytes);
    f->nearest = cgt_allocate(memory, f->nearest_bytes);
    f->ring = cgt_allocate(memory, f->ring_bytes);
    if (f->ids && f->nearest && f->ring)
        return CGT_OK;
    snprintf(r->message, sizeof r->message, "out of memory for a frame of %" PRIu32 " x %" PRIu32 " pixels", width,
             height);
    return CGT_ERROR_OUT_OF_MEMORY;
}

static void release(frame *f)
{
    const cgt_memory_hooks *const memory = &f->scene->memory;
    cgt_cell_destroy(f->cell);
    if (f->ids)
        cgt_free(memory, f->ids, f->id_bytes);
    if (f->nearest)
        cgt_free(memory, f->nearest, f->nearest_bytes);
    if (f->ring)
        cgt_free(memory, f->ring, f->ring_bytes);
    cgt_frame_light_release(&f->light);
    cgt_camera_tables_release(&f->tables);
}

cgt_result cgt_cell_frame_trace(const cgt_grid_scene *scene, const cgt_camera *camera, uint32_t width, uint32_t height,
                                const cgt_cell_frame_options *options, uint32_t *ids, cgt_cell_frame_result *result)
{
    *result = (cgt_cell_frame_result){.cycles = 0};
    const char *const wrong = check_options(options);
    if (wrong) {
        snprintf(result->message, sizeof result->message, "%s", wrong);
        return CGT_ERROR_INVALID_ARGUMENT;
    }
    frame f = {.scene = scene, .options = options, .image = scene->image};
    cgt_result code = cgt_camera_tables_init(&f.tables, &scene->memory, camera, width, height, result->message);
    if (code != CGT_OK)
        return code;
    low_word(f.image.objects, CGT_EA_OBJECTS);
    code = cgt_frame_light_init(&f.light, &scene->memory, options->light, &f.tables, scene, result->message);
    if (code == CGT_OK)
        code = allocate(&f, result);
    if (code == CGT_OK) {
        memset(f.ids, 0xff, f.id_bytes);
        memset(f.ring, 0, f.ring_bytes);
        cgt_doubts_init(&f.doubts, &f.tables.rays, scene, f.nearest);
        f.doubts.light = f.light.image.sets ? &f.light : NULL;
        code = run(&f, ids, result);
    }
    release(&f);
    return code;
}
