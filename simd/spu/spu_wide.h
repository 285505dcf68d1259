/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The width of this build's variant, for spu_intrinsics.h: selection rows for vectors wider than four lanes. CGT_LANES
 * is defined only where a kernel is compiled; without it, and with 4, there are no such rows.
 *
 *   CGT_SPU_WIDE_F(word)      floats
 *   CGT_SPU_WIDE_SU(word)     signed and unsigned ints
 *   CGT_SPU_WIDE_FSU(word)    all three
 *   CGT_SPU_WIDE_FSUM(word)   all three, and masks where they have a type of their own */
#ifndef CGT_SPU_WIDE_H
#define CGT_SPU_WIDE_H

#if defined(CGT_LANES) && CGT_LANES == 8
#include "spu_avx2.h"
#elif defined(CGT_LANES) && CGT_LANES == 16
#include "spu_avx512.h"
#else
#define CGT_SPU_WIDE_F(word)
#define CGT_SPU_WIDE_SU(word)
#define CGT_SPU_WIDE_FSU(word)
#define CGT_SPU_WIDE_FSUM(word)
#endif

#endif
