/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The portable mapping: every word in plain C on the compiler's vectors, correct on hosts of either byte order.
 *
 *   cgt_spu_WORD_TYPE     the word for operands of TYPE (u8 s8 ... f64, see spu_words.h)
 *   cgt_spu_WORD_TYPE_x   the same with a scalar operand
 *
 * The other mappings include this file and replace groups of words: a mapping with words of its own defines
 * CGT_SPU_OWN_<GROUP> first. */
#ifndef CGT_SPU_PORTABLE_H
#define CGT_SPU_PORTABLE_H

#include <string.h>

#include "spu_types.h"

/* X(type, vector, element, mask vector, elements) for each type */
#define CGT_SPU_EACH_INT(X)                                                                                            \
    X(u8, vec_uchar16, unsigned char, vec_uchar16, 16)                                                                 \
    X(s8, vec_char16, signed char, vec_uchar16, 16)                                                                    \
    X(u16, vec_ushort8, unsigned short, vec_ushort8, 8)                                                                \
    X(s16, vec_short8, signed short, vec_ushort8, 8)                                                                   \
    X(u32, vec_uint4, unsigned int, vec_uint4, 4)                                                                      \
    X(s32, vec_int4, signed int, vec_uint4, 4)
#define CGT_SPU_EACH(X)                                                                                                \
    CGT_SPU_EACH_INT(X)                                                                                                \
    X(u64, vec_ullong2, unsigned long long, vec_ullong2, 2)                                                            \
    X(s64, vec_llong2, signed long long, vec_ullong2, 2)                                                               \
    X(f32, vec_float4, float, vec_uint4, 4)                                                                            \
    X(f64, vec_double2, double, vec_ullong2, 2)

#define CGT_SPU_TIMES_2(a) a, a
#define CGT_SPU_TIMES_4(a) a, a, a, a
#define CGT_SPU_TIMES_8(a) CGT_SPU_TIMES_4(a), CGT_SPU_TIMES_4(a)
#define CGT_SPU_TIMES_16(a) CGT_SPU_TIMES_8(a), CGT_SPU_TIMES_8(a)

#include "spu_portable_element.h"

#include "spu_portable_logic.h"

#include "spu_portable_float.h"

#include "spu_portable_integer.h"

#include "spu_portable_byte.h"

#include "spu_portable_shift.h"

#endif
