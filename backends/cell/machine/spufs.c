/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Runs a cell on real SPEs: a thread of the host in spu_run for each, the PPE's function on the calling one. */
#define _GNU_SOURCE
#include "cell/machine/spufs.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cell/machine/spufs_internal.h"
#include "core/memory.h"

#define POLL_MILLISECONDS 1

/* Bits of spu_run's result and of its event (asm/spu.h of Linux). */
enum { STATUS_STOP = 2, STATUS_HALT = 4, STATUS_INSTRUCTION = 0x20, STATUS_CHANNEL = 0x40 };
enum { EVENT_ALIGNMENT = 8, EVENT_ERROR = 0x10, EVENT_STORAGE = 0x20, EVENT_INVALID_DMA = 0x40 };

/* ---- the SPEs' threads ---- */

static void *run_context(void *argument)
{
    cgt_spufs_context *const c = argument;
    cgt_spufs *const s = c->all;
    const uint8_t number = (uint8_t)c->spe;
    pthread_mutex_lock(&s->gate);
    const bool closed = s->closed;
    pthread_mutex_unlock(&s->gate);
    if (closed)
        return NULL;
    do {
        c->event = 0;
        c->status = s->calls->run(s->calls->user, c->folder, &c->pc, &c->event);
        c->error = errno;
    } while (c->status == -1 && c->error == EINTR);
    while (write(s->wake[1], &number, 1) < 0 && errno == EINTR) {
    }
    return NULL;
}

/* What ended a program other than its stop; NULL: that did. */
static const char *describe_end(const cgt_spufs_context *c)
{
    if (c->status == -1)
        return strerror(c->error);
    if (c->event & EVENT_ALIGNMENT)
        return "a DMA is not aligned";
    if (c->event & EVENT_STORAGE)
        return "a DMA went to an address that is no memory, or not writable";
    if (c->event & EVENT_INVALID_DMA)
        return "a DMA command is invalid";
    if (c->event & EVENT_ERROR)
        return "the SPE raised an error";
    if (c->status & STATUS_HALT)
        return "the program halted";
    if (c->status & STATUS_INSTRUCTION)
        return "there is no such instruction";
    if (c->status & STATUS_CHANNEL)
        return "there is no such channel";
    return c->status & STATUS_STOP ? NULL : "the program did not stop by itself";
}

/* ---- the PPE ---- */

static void serve(cgt_spufs *s, cgt_ppe_event_kind kind, unsigned spe, uint32_t value)
{
    __sync_synchronize(); /* what the SPE put to memory before its message */
    if (s->cell->ppe)
        s->cell->ppe(s->cell->user, s->cell, &(cgt_ppe_event){.kind = kind, .spe = spe, .value = value});
    __sync_synchronize();
}

static void empty_mailboxes(cgt_spufs *s)
{
    uint32_t value;
    for (unsigned i = 0; i < s->contexts; i++) {
        while (cgt_spufs_read(&s->context[i], CGT_SPUFS_MBOX, &value))
            serve(s, CGT_PPE_MAILBOX, i, value);
        while (cgt_spufs_read(&s->context[i], CGT_SPUFS_IBOX, &value))
            serve(s, CGT_PPE_INTERRUPT, i, value);
    }
}

static void end_context(cgt_spufs *s, unsigned spe)
{
    cgt_spufs_context *const c = &s->context[spe];
    cgt_spe_result *const result = &s->cell->spe[spe].result;
    const char *const reason = describe_end(c);
    if (reason) {
        cgt_cell_fail(s->cell, "SPE %u: at 0x%05x: %s", spe, (unsigned)c->pc, reason);
        return;
    }
    result->stopped = true;
    result->code = (uint32_t)c->status >> 16 & 0x3fff;
    serve(s, CGT_PPE_STOPPED, spe, result->code);
}

/* Until all have ended: the others of one that failed may, too. */
static void run_ppe(cgt_spufs *s)
{
    struct pollfd watched[CGT_MAX_SPES + 1] = {{.fd = s->wake[0], .events = POLLIN}};
    for (unsigned i = 0; i < s->contexts; i++)
        watched[i + 1] = (struct pollfd){.fd = s->context[i].file[CGT_SPUFS_IBOX], .events = POLLIN};
    serve(s, CGT_PPE_START, 0, 0);
    for (unsigned running = s->contexts; running;) {
        uint8_t number;
        (void)poll(watched, s->contexts + 1, POLL_MILLISECONDS);
        empty_mailboxes(s);
        if (!(watched[0].revents & POLLIN) || read(s->wake[0], &number, 1) != 1)
            continue;
        empty_mailboxes(s); /* what came just before the end */
        end_context(s, number);
        running--;
    }
}

/* Starts all threads or none. */
static cgt_result run_threads(cgt_spufs *s)
{
    unsigned started = 0;
    pthread_mutex_lock(&s->gate);
    while (started < s->contexts &&
           !pthread_create(&s->context[started].thread, NULL, run_context, &s->context[started]))
        started++;
    s->closed = started < s->contexts;
    pthread_mutex_unlock(&s->gate);
    if (s->closed)
        cgt_cell_fail(s->cell, "SPE %u: the system refused a thread", started);
    else
        run_ppe(s);
    for (unsigned i = 0; i < started; i++)
        pthread_join(s->context[i].thread, NULL);
    return s->closed ? CGT_ERROR_THREADS : s->cell->failed ? CGT_ERROR_STOPPED : CGT_OK;
}

/* ---- a run ---- */

static cgt_result run_contexts(cgt_spufs *s, const cgt_memory_hooks *memory, const cgt_spufs_program *program)
{
    cgt_result result = CGT_OK;
    for (unsigned i = 0; i < s->cell->options.spes && result == CGT_OK; i++) {
        cgt_spufs_context *const c = &s->context[s->contexts++];
        *c = (cgt_spufs_context){.all = s, .spe = i, .folder = -1};
        for (int k = 0; k < CGT_SPUFS_FILES; k++)
            c->file[k] = -1;
        result = cgt_spufs_open(c, memory, &program[i]);
    }
    if (result == CGT_OK)
        result = cgt_spufs_map(s->cell, &s->memory);
    if (result == CGT_OK) {
        s->cell->spufs = s;
        result = run_threads(s);
        s->cell->spufs = NULL;
        cgt_spufs_unmap(s->cell, &s->memory);
    }
    for (unsigned i = 0; i < s->contexts; i++)
        cgt_spufs_close(&s->context[i]);
    return result;
}

static cgt_result run(cgt_spufs *s, const cgt_memory_hooks *memory, const cgt_spufs_program *program)
{
    if (pipe(s->wake)) {
        cgt_cell_fail(s->cell, "the system refused a pipe");
        return CGT_ERROR_THREADS;
    }
    cgt_result result = CGT_ERROR_THREADS;
    if (pthread_mutex_init(&s->gate, NULL)) {
        cgt_cell_fail(s->cell, "the system refused a lock");
    } else {
        result = run_contexts(s, memory, program);
        pthread_mutex_destroy(&s->gate);
    }
    close(s->wake[0]);
    close(s->wake[1]);
    return result;
}

cgt_result cgt_cell_run_spufs(cgt_cell *cell, const cgt_spufs_calls *calls, const cgt_memory_hooks *memory,
                              const cgt_spufs_program *program, cgt_ppe_function *ppe, void *user)
{
    cgt_spufs *const s = cgt_allocate(memory, sizeof *s);
    cgt_cell_reset(cell, ppe, user);
    if (!s) {
        cgt_cell_fail(cell, "out of memory for real SPEs");
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    memset(s, 0, sizeof *s);
    s->calls = calls ? calls : &cgt_spufs_linux;
    s->cell = cell;
    const cgt_result result = run(s, memory, program);
    cgt_free(memory, s, sizeof *s);
    return result;
}

/* ---- the PPE's calls ---- */

bool cgt_spufs_send_mailbox(cgt_spufs *s, unsigned spe, uint32_t value)
{
    return cgt_spufs_write(&s->context[spe], CGT_SPUFS_WBOX, value);
}

void cgt_spufs_send_signal(cgt_spufs *s, unsigned spe, unsigned number, uint32_t value)
{
    if (!cgt_spufs_write(&s->context[spe], number == 1 ? CGT_SPUFS_SIGNAL1 : CGT_SPUFS_SIGNAL2, value))
        cgt_cell_fail(s->cell, "SPE %u: signal %u could not be sent: %s", spe, number, strerror(errno));
}
