/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Runs a frame's program on SPEs. */
#include <stdio.h>

#include "cell/machine/spufs.h"
#include "cell/ppe/frame_run.h"
#include "cell/spu/elf.h"

static uint64_t block_of(unsigned spe) { return CGT_EA_CONTROL + spe * sizeof(cgt_control_block); }

static cgt_result explain(const cgt_cell_frame *f, cgt_result result, char message[CGT_CELL_MESSAGE_BYTES])
{
    if (result != CGT_OK)
        snprintf(message, CGT_CELL_MESSAGE_BYTES, "%s", cgt_cell_get_message(f->cell));
    return result;
}

static cgt_result run_native(cgt_cell_frame *f, cgt_ppe_function *ppe, char message[CGT_CELL_MESSAGE_BYTES])
{
    cgt_spe_program program[CGT_MAX_SPES];
    for (unsigned i = 0; i < f->options->spes; i++)
        program[i] = (cgt_spe_program){.function = f->options->function, .argument = block_of(i)};
    return explain(f, cgt_cell_run_native(f->cell, program, ppe, f), message);
}

/* An SPU with the program. Must be destroyed in any case. */
static cgt_result load(cgt_cell_frame *f, cgt_spu *spu, char message[CGT_CELL_MESSAGE_BYTES])
{
    const cgt_cell_frame_options *o = f->options;
    cgt_result result = cgt_spu_create(spu, f->memory, o->untimed ? CGT_SPU_UNTIMED : CGT_SPU_TIMED);
    if (result != CGT_OK) {
        *spu = (cgt_spu){.pc = 0};
        snprintf(message, CGT_CELL_MESSAGE_BYTES, "out of memory for a simulated SPU");
        return result;
    }
    result = cgt_spu_load_elf(spu, o->elf, o->elf_bytes, "the SPEs' program");
    if (result != CGT_OK)
        snprintf(message, CGT_CELL_MESSAGE_BYTES, "%s", spu->message);
    return result;
}

static cgt_result run_real(cgt_cell_frame *f, cgt_ppe_function *ppe, char message[CGT_CELL_MESSAGE_BYTES])
{
    const cgt_cell_frame_options *o = f->options;
    cgt_spufs_program program[CGT_MAX_SPES];
    for (unsigned i = 0; i < o->spes; i++)
        program[i] = (cgt_spufs_program){.elf = o->elf, .elf_bytes = o->elf_bytes, .argument = block_of(i)};
    return explain(f, cgt_cell_run_spufs(f->cell, o->spufs, f->memory, program, ppe, f), message);
}

static cgt_result run_simulated(cgt_cell_frame *f, cgt_ppe_function *ppe, char message[CGT_CELL_MESSAGE_BYTES])
{
    const cgt_cell_frame_options *o = f->options;
    const size_t bytes = o->spes * sizeof(cgt_spu);
    cgt_spu *const spu = cgt_allocate(f->memory, bytes);
    cgt_spe_unit unit[CGT_MAX_SPES];
    cgt_result result = CGT_OK;
    unsigned made = 0;
    if (!spu) {
        snprintf(message, CGT_CELL_MESSAGE_BYTES, "out of memory for simulated SPUs");
        return CGT_ERROR_OUT_OF_MEMORY;
    }
    for (; made < o->spes && result == CGT_OK; made++) {
        result = load(f, &spu[made], message);
        unit[made] = cgt_cell_unit_of(&spu[made], made, block_of(made), 0);
    }
    if (result == CGT_OK)
        result = explain(f, cgt_cell_run_simulated(f->cell, unit, ppe, f), message);
    for (unsigned i = 0; i < made; i++) {
        if (o->inspect && result == CGT_OK)
            o->inspect(o->user, i, &spu[i]);
        cgt_spu_destroy(&spu[i]);
    }
    cgt_free(f->memory, spu, bytes);
    return result;
}

cgt_result cgt_frame_run_spes(cgt_cell_frame *f, cgt_ppe_function *ppe, char message[CGT_CELL_MESSAGE_BYTES])
{
    if (!f->options->elf)
        return run_native(f, ppe, message);
    return f->options->real ? run_real(f, ppe, message) : run_simulated(f, ppe, message);
}
