/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the SPU's instructions do to registers, written down once more from their definitions in the architecture: byte
 * by byte and bit by bit, in the SPU's order, without vectors. */
#ifndef SPU_DEFINITIONS_H
#define SPU_DEFINITIONS_H

#include "cell/spu/isa/isa.h"

/* a, b, c: 16 bytes of ra, rb, rc, byte 0 first; t: of rt, before and after. */
typedef void spu_definition(int32_t imm, const uint8_t *a, const uint8_t *b, const uint8_t *c, uint8_t *t);

/* NULL where the instruction touches memory, time, channels or the program counter, or is of double precision. */
spu_definition *spu_definition_of(cgt_spu_op op);

#endif
