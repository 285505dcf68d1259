/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Runs a program of an SPU for a test. */
#include "spu/spu_program.h"

#include "support/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cell/spu/elf.h"
#include "core/memory.h"

#define MOST_INSTRUCTIONS UINT64_C(2000000000) /* of one call: more is a program that hangs */
#define STOP_OF_EXIT 0x2000u                   /* stop code of the C library's exit(0) */

/* ---- the mailboxes ---- */

static cgt_channel_status read_channel(void *user, unsigned channel, uint64_t cycle, uint32_t *value)
{
    spu_program *p = user;
    (void)cycle;
    if (channel != EXCHANGE_INBOUND)
        return CGT_CHANNEL_ERROR;
    if (!p->unread)
        return CGT_CHANNEL_STALL;
    *value = p->inbound[2 - p->unread];
    p->unread--;
    return CGT_CHANNEL_DONE;
}

static cgt_channel_status write_channel(void *user, unsigned channel, uint64_t cycle, uint32_t value)
{
    spu_program *p = user;
    (void)cycle;
    if (channel != EXCHANGE_OUTBOUND)
        return CGT_CHANNEL_ERROR;
    p->area = value;
    return CGT_CHANNEL_DONE;
}

static uint32_t count_channel(void *user, unsigned channel, uint64_t cycle)
{
    const spu_program *p = user;
    (void)cycle;
    return channel == EXCHANGE_INBOUND ? p->unread : channel == EXCHANGE_OUTBOUND;
}

static cgt_spu_end run(spu_program *p)
{
    const cgt_spu_channels channels = {p, read_channel, write_channel, count_channel};
    return cgt_spu_run(&p->spu, &channels, p->spu.cycle + MOST_INSTRUCTIONS);
}

static void run_to_request(spu_program *p)
{
    const cgt_spu_end end = run(p);
    if (end.reason != CGT_SPU_STALLED || end.value != EXCHANGE_INBOUND || p->unread)
        fail_msg("%s: stopped for reason %d, value 0x%x, at 0x%x: %s", p->path, (int)end.reason, end.value, p->spu.pc,
                 p->spu.message);
}

/* ---- the calls ---- */

static void *read_file(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s: cannot be opened", path);
    void *bytes = malloc(CGT_SPU_LOCAL_STORE * 8);
    assert_non_null(bytes);
    *size = fread(bytes, 1, CGT_SPU_LOCAL_STORE * 8, file);
    fclose(file);
    return bytes;
}

void spu_program_begin(spu_program *p, const char *path)
{
    const cgt_memory_hooks memory = cgt_memory_default();
    size_t size;
    void *bytes = read_file(path, &size);
    *p = (spu_program){.path = path, .area = UINT32_MAX};
    assert_int_equal(cgt_spu_create(&p->spu, &memory, CGT_SPU_UNTIMED), CGT_OK);
    if (cgt_spu_load_elf(&p->spu, bytes, size, path) != CGT_OK)
        fail_msg("%s", p->spu.message);
    free(bytes);
    run_to_request(p);
    assert_true(p->area <= CGT_SPU_LOCAL_STORE - EXCHANGE_QUADS * sizeof(spu_quad));
}

void spu_program_call(spu_program *p, uint32_t number, spu_quad *record, uint32_t count, uint32_t quads)
{
    const size_t bytes = (size_t)count * quads * sizeof *record;
    assert_true(bytes <= EXCHANGE_QUADS * sizeof *record);
    memcpy(p->spu.local_store + p->area, record, bytes);
    cgt_spu_forget(&p->spu, p->area, bytes);
    p->inbound[0] = number;
    p->inbound[1] = count;
    p->unread = 2;
    run_to_request(p);
    memcpy(record, p->spu.local_store + p->area, bytes);
}

void spu_program_end(spu_program *p)
{
    p->inbound[1] = EXCHANGE_END;
    p->unread = 1;
    const cgt_spu_end end = run(p);
    if (end.reason != CGT_SPU_STOPPED || end.value != STOP_OF_EXIT)
        fail_msg("%s: ended for reason %d, value 0x%x: %s", p->path, (int)end.reason, end.value, p->spu.message);
    cgt_spu_destroy(&p->spu);
}
