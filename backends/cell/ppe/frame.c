/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Frames on a Cell: memory, the PPE's acts, and the run. */
#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "cell/ppe/frame_run.h"

/* Reports of both programs begin alike. */
_Static_assert((int)CGT_REPORT_DONE == (int)CGT_KD_STATE_DONE, "state");
_Static_assert(offsetof(cgt_spe_report, rest) == offsetof(cgt_kd_report, rest), "place of the last doubts");

/* ---- memory ---- */

const char *cgt_frame_check_options(const cgt_cell_frame_options *o)
{
    if (o->spes < 1 || o->spes > CGT_MAX_SPES)
        return "a frame needs 1 to 16 SPEs";
    if (!o->function == !o->elf)
        return "a frame needs a program: a function or an ELF file, not both";
    if ((unsigned)o->assignment >= CGT_ASSIGNMENTS || o->share > 100)
        return "the assignment is unknown, or its share is above 100 percent";
    if (o->doubts_half % CGT_DOUBTS_LINE || o->doubts_half > 32768)
        return "half a ring of doubts is a multiple of 16 up to 32,768";
    return NULL;
}

cgt_result cgt_frame_refuse(cgt_cell_frame_result *result, const char *sentence)
{
    snprintf(result->message, sizeof result->message, "%s", sentence);
    return CGT_ERROR_INVALID_ARGUMENT;
}

void *cgt_frame_allocate(const cgt_cell_frame *f, size_t bytes, int byte, char message[CGT_CELL_MESSAGE_BYTES])
{
    void *const memory = cgt_allocate(f->memory, bytes);
    if (memory)
        memset(memory, byte, bytes);
    else
        snprintf(message, CGT_CELL_MESSAGE_BYTES, "out of memory for a frame of %" PRIu32 " x %" PRIu32 " pixels",
                 f->tables.rays.width, f->tables.rays.height);
    return memory;
}

cgt_result cgt_frame_begin(cgt_cell_frame *f, const cgt_camera *camera, uint32_t width, uint32_t height,
                           char message[CGT_CELL_MESSAGE_BYTES])
{
    f->half = f->options->doubts_half ? f->options->doubts_half : CGT_DOUBTS_HALF;
    return cgt_camera_tables_init(&f->tables, f->memory, camera, width, height, message);
}

void cgt_frame_release(cgt_cell_frame *f)
{
    cgt_cell_destroy(f->cell);
    if (f->doubts.nearest)
        cgt_free(f->memory, f->doubts.nearest, f->nearest_bytes);
    if (f->ring)
        cgt_free(f->memory, f->ring, f->ring_bytes);
    cgt_camera_tables_release(&f->tables);
}

static cgt_result allocate(cgt_cell_frame *f, cgt_doubts_object *get, const void *scene,
                           char message[CGT_CELL_MESSAGE_BYTES])
{
    const cgt_camera_rays *const rays = &f->tables.rays;
    f->ring_bytes = (size_t)f->options->spes * 2 * f->half * sizeof(cgt_doubt);
    f->nearest_bytes = (size_t)rays->width * rays->height * sizeof(uint32_t);
    f->doubts = (cgt_doubts){.rays = rays, .get = get, .scene = scene};
    f->doubts.nearest = cgt_frame_allocate(f, f->nearest_bytes, 0xff, message);
    if (f->doubts.nearest)
        f->ring = cgt_frame_allocate(f, f->ring_bytes, 0, message);
    return f->ring ? CGT_OK : CGT_ERROR_OUT_OF_MEMORY;
}

cgt_result cgt_frame_map(cgt_cell_frame *f, const cgt_frame_region *region, size_t regions)
{
    cgt_result result = CGT_OK;
    for (size_t i = 0; i < regions && result == CGT_OK; i++)
        if (region[i].bytes)
            result = cgt_cell_add_memory(f->cell, region[i].ea, (void *)(uintptr_t)region[i].memory,
                                         region[i].bytes / 4, 4, region[i].writable);
    return result;
}

/* The machine, and what SPEs of any program see. */
static cgt_result make_cell(cgt_cell_frame *f)
{
    const cgt_cell_frame_options *const o = f->options;
    const cgt_camera_tables *const t = &f->tables;
    const cgt_cell_options cell = {.spes = o->spes,
                                   .timing = o->timing,
                                   .ppe_cycles = o->ppe_cycles,
                                   .cycle_limit = o->cycle_limit,
                                   .watch_buffers = true};
    const cgt_frame_region region[] = {{CGT_EA_REPORT, f->report, sizeof f->report, true},
                                       {CGT_EA_CAMERA, &t->image, sizeof t->image, false},
                                       {CGT_EA_COLUMNS, t->column, t->column_bytes, false},
                                       {CGT_EA_ROWS, t->row, t->row_bytes, false},
                                       {CGT_EA_DOUBTS, f->ring, f->ring_bytes, true}};
    cgt_result result = cgt_cell_create(&cell, &f->cell);
    if (result == CGT_OK)
        result = cgt_frame_map(f, region, sizeof region / sizeof region[0]);
    if (result == CGT_OK)
        result = f->program->map(f);
    for (unsigned i = 0; i < o->spes && result == CGT_OK; i++)
        result = cgt_cell_set_signal_or(f->cell, i, 1, true);
    return result;
}

/* ---- the PPE ---- */

static void read_doubts(cgt_cell_frame *f, unsigned spe, uint32_t half, uint32_t count)
{
    const uint64_t ea = CGT_EA_DOUBTS + (uint64_t)(spe * 2 + half) * f->half * sizeof(cgt_doubt);
    cgt_doubt line[CGT_DOUBTS_LINE];
    f->broken |= half > 1 || count > f->half;
    for (uint32_t at = 0; !f->broken && at < count; at += CGT_DOUBTS_LINE) {
        f->broken |= !cgt_cell_read(f->cell, ea + at * sizeof line[0], line, sizeof line);
        const uint32_t some = count - at < CGT_DOUBTS_LINE ? count - at : CGT_DOUBTS_LINE;
        for (uint32_t k = 0; k < some && !f->broken; k++)
            f->program->take_doubt(f, &line[k]);
    }
}

static bool uses_mailboxes(const cgt_cell_frame *f) { return (f->share[0].flags & CGT_CONTROL_MAILBOX) != 0; }

static void send_piece(cgt_cell_frame *f, unsigned spe)
{
    f->broken |= !uses_mailboxes(f) || !cgt_assigner_send(&f->assigner, f->cell, spe);
}

/* An SPE has ended its phase: all go on where it is the last one. */
static void act_on_barrier(cgt_cell_frame *f)
{
    if (++f->waiting < f->options->spes)
        return;
    f->waiting = 0;
    f->assigner.next = f->assigner.fixed;
    for (unsigned i = 0; i < f->options->spes; i++) {
        f->assigner.messages[i]++;
        f->broken |= !cgt_cell_send_mailbox(f->cell, i, CGT_KD_PHASE);
        if (uses_mailboxes(f))
            send_piece(f, i);
    }
}

static void act(void *user, cgt_cell *cell, const cgt_ppe_event *event)
{
    cgt_cell_frame *const f = user;
    const unsigned spe = event->spe;
    switch (event->kind) {
    case CGT_PPE_START:
        for (unsigned i = 0; i < f->options->spes && uses_mailboxes(f) && !f->program->has_phases; i++)
            send_piece(f, i);
        return;
    case CGT_PPE_MAILBOX:
        f->assigner.messages[spe]++;
        if (f->program->has_phases && event->value == CGT_KD_PHASE)
            act_on_barrier(f);
        else
            send_piece(f, spe);
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

static void gather(const cgt_cell_frame *f, cgt_cell_frame_result *r)
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

/* The cell runs, and all SPEs say that they are done. */
static cgt_result run_cell(cgt_cell_frame *f, uint32_t pieces, char message[CGT_CELL_MESSAGE_BYTES])
{
    const cgt_cell_frame_options *const o = f->options;
    cgt_result result = make_cell(f);
    if (result != CGT_OK) {
        snprintf(message, CGT_CELL_MESSAGE_BYTES, "the machine cannot be set up: %s", cgt_get_result_string(result));
        return result;
    }
    cgt_assign(o->assignment, o->share ? o->share : CGT_HYBRID_SHARE, pieces, o->spes, f->share, &f->assigner);
    for (unsigned i = 0; i < o->spes; i++)
        f->program->fill_control(f, i);
    result = cgt_frame_run_spes(f, act, message);
    for (unsigned i = 0; i < o->spes && result == CGT_OK; i++)
        if (f->report[i].grid.state != CGT_REPORT_DONE)
            result = f->program->explain(f, i, message);
    return result;
}

cgt_result cgt_frame_run(cgt_cell_frame *f, uint32_t pieces, cgt_doubts_object *get, const void *scene,
                         cgt_cell_frame_result *r)
{
    cgt_result result = allocate(f, get, scene, r->message);
    if (result == CGT_OK)
        result = run_cell(f, pieces, r->message);
    if (result != CGT_OK)
        return result;
    gather(f, r);
    for (unsigned i = 0; i < f->options->spes; i++)
        read_doubts(f, i, f->report[i].grid.rest_half, f->report[i].grid.rest);
    result = f->program->finish(f, r);
    r->doubts = f->doubts.doubts;
    r->exact = f->doubts.exact;
    r->changed = f->doubts.changed;
    if (result == CGT_OK && (f->broken || f->doubts.bad)) {
        snprintf(r->message, sizeof r->message, "the program does not keep the protocol of %s and doubts",
                 f->program->pieces);
        result = CGT_ERROR_STOPPED;
    }
    return result;
}
