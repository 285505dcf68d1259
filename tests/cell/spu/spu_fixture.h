/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An SPU, and an assembler that writes a program for it at PROGRAM: for tests whose programs are a few instructions. */
#ifndef SPU_FIXTURE_H
#define SPU_FIXTURE_H

#include <string.h>

#include "support/test.h"

#include "cell/spu/isa/assemble.h"
#include "core/memory.h"

#define PROGRAM 0x400 /* where the programs of this file stand */
#define WORDS 64
#define SPU_FIXTURE static inline __attribute__((unused))

typedef struct fixture {
    cgt_spu spu;
    uint32_t word[WORDS];
    cgt_spu_assembler p;
} fixture;

SPU_FIXTURE fixture *begin(void **state)
{
    fixture *f = *state;
    memset(f->spu.reg, 0, sizeof f->spu.reg);
    memset(f->spu.local_store, 0, CGT_SPU_LOCAL_STORE);
    cgt_spu_forget(&f->spu, 0, CGT_SPU_LOCAL_STORE);
    f->spu.cycle = f->spu.instructions = 0;
    f->spu.srr0 = 0;
    f->spu.interrupts = false;
    f->p = (cgt_spu_assembler){.word = f->word, .capacity = WORDS, .address = PROGRAM};
    return f;
}

SPU_FIXTURE void load(fixture *f) { assert_true(cgt_spu_assembler_load(&f->p, &f->spu)); }

SPU_FIXTURE cgt_spu_end run(fixture *f, const cgt_spu_channels *channels)
{
    load(f);
    return cgt_spu_run(&f->spu, channels, UINT64_MAX);
}

SPU_FIXTURE void expect_stop(fixture *f, cgt_spu_end end, uint32_t code)
{
    if (end.reason != CGT_SPU_STOPPED)
        fail_msg("no stop, but reason %d: %s", (int)end.reason, f->spu.message);
    assert_int_equal(end.value, code);
}

SPU_FIXTURE void expect_error(fixture *f, cgt_spu_end end, uint32_t pc, const char *text)
{
    assert_int_equal(end.reason, CGT_SPU_ERROR);
    assert_int_equal(f->spu.pc, pc);
    if (!strstr(f->spu.message, text))
        fail_msg("\"%s\" does not say \"%s\"", f->spu.message, text);
}

SPU_FIXTURE int set_up(void **state)
{
    static fixture f;
    const cgt_memory_hooks memory = cgt_memory_default();
    *state = &f;
    return cgt_spu_create(&f.spu, &memory, CGT_SPU_UNTIMED) == CGT_OK ? 0 : -1;
}
SPU_FIXTURE int tear_down(void **state)
{
    fixture *f = *state;
    cgt_spu_destroy(&f->spu);
    return 0;
}

#endif
