/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A context of spufs: its files, and a program in them. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "cell/machine/spufs_internal.h"
#include "cell/spu/elf.h"

/* ---- Linux ---- */

#if defined(SYS_spu_create) && defined(SYS_spu_run)
#define CREATE_EVENTS_ENABLED 1 /* errors end spu_run with their bits, in place of a signal (asm/spu.h) */

static int linux_create(void *user, unsigned spe)
{
    char path[64];
    (void)user;
    snprintf(path, sizeof path, "/spu/cgt-%ld-%u", (long)getpid(), spe);
    return (int)syscall(SYS_spu_create, path, CREATE_EVENTS_ENABLED, 0700);
}

static int linux_run(void *user, int folder, uint32_t *pc, uint32_t *event)
{
    (void)user;
    return (int)syscall(SYS_spu_run, folder, pc, event);
}
#else
static int linux_create(void *user, unsigned spe)
{
    (void)user, (void)spe;
    errno = ENOSYS;
    return -1;
}

static int linux_run(void *user, int folder, uint32_t *pc, uint32_t *event)
{
    (void)user, (void)folder, (void)pc, (void)event;
    errno = ENOSYS;
    return -1;
}
#endif

const cgt_spufs_calls cgt_spufs_linux = {.create = linux_create, .run = linux_run};

/* ---- files ---- */

static const struct {
    const char *name;
    int flags;
} files[CGT_SPUFS_FILES] = {[CGT_SPUFS_MEM] = {"mem", O_RDWR},
                            [CGT_SPUFS_REGS] = {"regs", O_RDWR},
                            [CGT_SPUFS_MBOX] = {"mbox", O_RDONLY | O_NONBLOCK},
                            [CGT_SPUFS_IBOX] = {"ibox", O_RDONLY | O_NONBLOCK},
                            [CGT_SPUFS_WBOX] = {"wbox", O_WRONLY | O_NONBLOCK},
                            [CGT_SPUFS_SIGNAL1] = {"signal1", O_WRONLY},
                            [CGT_SPUFS_SIGNAL2] = {"signal2", O_WRONLY}};

static cgt_result fail_file(const cgt_spufs_context *c, const char *file)
{
    cgt_cell_fail(c->all->cell, "SPE %u: the file %s of its context: %s", c->spe, file, strerror(errno));
    return CGT_ERROR_UNSUPPORTED;
}

/* Writes all; false with errno. */
static bool write_all(int file, const void *bytes, size_t count)
{
    const char *from = bytes;
    while (count) {
        const ssize_t written = write(file, from, count);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        from += written;
        count -= (size_t)written;
    }
    return true;
}

/* The mode of a signal register: 1 gathers values. */
static cgt_result set_signal_type(const cgt_spufs_context *c, unsigned number)
{
    const char *const name = number == 1 ? "signal1_type" : "signal2_type";
    const char *const mode = c->all->cell->spe[c->spe].gathers[number - 1] ? "1" : "0";
    const int file = openat(c->folder, name, O_WRONLY | O_CLOEXEC);
    const bool written = file >= 0 && write_all(file, mode, 1);
    const cgt_result result = written ? CGT_OK : fail_file(c, name);
    if (file >= 0)
        close(file);
    return result;
}

static cgt_result create(cgt_spufs_context *c)
{
    cgt_cell *const cell = c->all->cell;
    c->folder = c->all->calls->create(c->all->calls->user, c->spe);
    if (c->folder >= 0)
        return CGT_OK;
    if (errno == ENOSYS)
        cgt_cell_fail(cell, "there are no SPEs: this system has no spu_create, which Linux for a Cell has");
    else if (errno == ENOENT)
        cgt_cell_fail(cell, "there are no SPEs: /spu is missing; mount -t spufs none /spu");
    else
        cgt_cell_fail(cell, "SPE %u: spu_create: %s", c->spe, strerror(errno));
    return CGT_ERROR_UNSUPPORTED;
}

/* ---- the program ---- */

static cgt_result load(cgt_spufs_context *c, const cgt_memory_hooks *memory, const cgt_spufs_program *program)
{
    uint8_t regs[CGT_SPU_REGISTERS][16];
    cgt_cell *const cell = c->all->cell;
    cgt_spu spu;
    if (cgt_spu_create(&spu, memory, CGT_SPU_UNTIMED) != CGT_OK) {
        cgt_cell_fail(cell, "SPE %u: out of memory for its program", c->spe);
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    cgt_result result = cgt_spu_load_elf(&spu, program->elf, program->elf_bytes, "the SPEs' program");
    if (result != CGT_OK)
        cgt_cell_fail(cell, "%s", spu.message);
    else if (!write_all(c->file[CGT_SPUFS_MEM], spu.local_store, CGT_SPU_LOCAL_STORE))
        result = fail_file(c, "mem");
    c->pc = spu.pc;
    (void)cgt_cell_unit_of(&spu, c->spe, program->argument, program->environment); /* what main takes */
    for (int k = 0; k < CGT_SPU_REGISTERS * 16; k++)
        regs[k / 16][k % 16] = (uint8_t)(spu.reg[k / 16].word[k % 16 / 4] >> (24 - 8 * (k % 4)));
    cgt_spu_destroy(&spu);
    if (result == CGT_OK && !write_all(c->file[CGT_SPUFS_REGS], regs, sizeof regs))
        result = fail_file(c, "regs");
    return result;
}

cgt_result cgt_spufs_open(cgt_spufs_context *context, const cgt_memory_hooks *memory, const cgt_spufs_program *program)
{
    cgt_result result = create(context);
    for (int i = 0; i < CGT_SPUFS_FILES && result == CGT_OK; i++) {
        context->file[i] = openat(context->folder, files[i].name, files[i].flags | O_CLOEXEC);
        if (context->file[i] < 0)
            result = fail_file(context, files[i].name);
    }
    for (unsigned k = 1; k <= 2 && result == CGT_OK; k++)
        result = set_signal_type(context, k);
    return result == CGT_OK ? load(context, memory, program) : result;
}

void cgt_spufs_close(cgt_spufs_context *context)
{
    for (int i = 0; i < CGT_SPUFS_FILES; i++)
        if (context->file[i] >= 0)
            close(context->file[i]);
    if (context->folder >= 0)
        close(context->folder);
}

bool cgt_spufs_read(const cgt_spufs_context *context, cgt_spufs_file file, uint32_t *value)
{
    return read(context->file[file], value, sizeof *value) == (ssize_t)sizeof *value;
}

bool cgt_spufs_write(const cgt_spufs_context *context, cgt_spufs_file file, uint32_t value)
{
    return write(context->file[file], &value, sizeof value) == (ssize_t)sizeof value;
}
