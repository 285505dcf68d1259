/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Small programs, see assemble.h. */
#include "cell/spu/isa/assemble.h"

void cgt_spu_emit_word(cgt_spu_assembler *p, uint32_t word)
{
    if (p->count < p->capacity)
        p->word[p->count++] = word;
    else
        p->failed = true;
}

void cgt_spu_emit(cgt_spu_assembler *p, cgt_spu_op op, cgt_spu_operands operands)
{
    uint32_t word;
    if (!cgt_spu_encode(op, &operands, &word))
        p->failed = true;
    cgt_spu_emit_word(p, word);
}

uint32_t cgt_spu_here(const cgt_spu_assembler *p) { return p->address + 4 * p->count; }

int32_t cgt_spu_distance(const cgt_spu_assembler *p, uint32_t address) { return (int32_t)(address - cgt_spu_here(p)); }

bool cgt_spu_assembler_load(const cgt_spu_assembler *p, cgt_spu *spu)
{
    if (p->failed || p->address % 4 || !cgt_spu_copy_in(spu, p->address, p->word, (size_t)p->count * 4))
        return false;
    spu->pc = p->address;
    return true;
}
