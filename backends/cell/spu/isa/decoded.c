/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The cache of decoded instructions, see decoded.h. */
#include "cell/spu/isa/decoded.h"

void cgt_spu_decode(cgt_spu *spu, uint32_t address)
{
    cgt_spu_operands o;
    const cgt_spu_op op = cgt_spu_disassemble(cgt_spu_load32(spu, address), &o);
    const unsigned use = cgt_spu_isa[op].use;
    spu->decoded[address / 4] = (cgt_spu_decoded){
        .imm = o.imm,
        .op = (uint8_t)op,
        .class = cgt_spu_isa[op].class,
        .rt = (uint8_t)o.rt,
        .ra = (uint8_t)o.ra,
        .rb = (uint8_t)o.rb,
        .rc = (uint8_t)o.rc,
        .writes = use & CGT_SPU_WRITES_T ? (uint8_t)o.rt : CGT_SPU_REGISTER_SINK,
        .read = {use & CGT_SPU_READS_A ? (uint8_t)o.ra : CGT_SPU_REGISTER_READY,
                 use & CGT_SPU_READS_B ? (uint8_t)o.rb : CGT_SPU_REGISTER_READY,
                 use & CGT_SPU_READS_C   ? (uint8_t)o.rc
                 : use & CGT_SPU_READS_T ? (uint8_t)o.rt
                                         : CGT_SPU_REGISTER_READY},
        .branch = (int16_t)o.branch,
    };
    if (address < spu->code_low)
        spu->code_low = address;
    if (address + 4 > spu->code_high)
        spu->code_high = address + 4;
}

void cgt_spu_forget(cgt_spu *spu, uint32_t address, size_t size)
{
    const uint32_t end = size < CGT_SPU_LOCAL_STORE - address ? address + (uint32_t)size : CGT_SPU_LOCAL_STORE;
    const uint32_t from = address > spu->code_low ? address : spu->code_low;
    const uint32_t to = end < spu->code_high ? end : spu->code_high;
    for (uint32_t at = from / 4; at * 4 < to; at++)
        spu->decoded[at].op = CGT_SPU_OP_UNDECODED;
}
