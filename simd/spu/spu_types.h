/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The vector types of the SPU language extension on the compiler's own vectors (gcc and clang).
 *
 *   vec_TYPEn   n elements of TYPE, 16 bytes, element 0 first in memory on every host
 *   qword       a quadword without a type: vec_char16, as in the SPU's compiler
 *   vector      the keyword: `vector float` is vec_float4, `vector unsigned int` is vec_uint4. A macro here:
 *               CGT_SPU_NO_VECTOR_KEYWORD leaves the name free; __vector always exists.
 *
 * A comparison gives an unsigned vector of the same element size: all ones where true, else zero.
 *
 * A cast between two of these types keeps the 16 bytes of memory. On a big-endian host the result is the SPU's; on
 * a little-endian one only between types of one element size: (vec_uint4)(vec_float4) is the same, while element 0 of
 * (vec_uint4)(vec_double2) is the low half of the first double here and the high half on an SPU. spux_cast of
 * spu_intrinsics.h gives the SPU's result. */
#ifndef CGT_SPU_TYPES_H
#define CGT_SPU_TYPES_H

#include <stdint.h>

#ifndef __vector
#define __vector __attribute__((vector_size(16)))
#endif
#if !defined(vector) && !defined(CGT_SPU_NO_VECTOR_KEYWORD)
#define vector __vector
#endif

typedef unsigned char vec_uchar16 __attribute__((vector_size(16)));
typedef signed char vec_char16 __attribute__((vector_size(16)));
typedef unsigned short vec_ushort8 __attribute__((vector_size(16)));
typedef signed short vec_short8 __attribute__((vector_size(16)));
typedef unsigned int vec_uint4 __attribute__((vector_size(16)));
typedef signed int vec_int4 __attribute__((vector_size(16)));
typedef unsigned long long vec_ullong2 __attribute__((vector_size(16)));
typedef signed long long vec_llong2 __attribute__((vector_size(16)));
typedef float vec_float4 __attribute__((vector_size(16)));
typedef double vec_double2 __attribute__((vector_size(16)));
typedef vec_char16 qword;

/* Bits of spu_testsv's second operand. */
#define SPU_SV_NEG_DENORM 0x01
#define SPU_SV_POS_DENORM 0x02
#define SPU_SV_NEG_ZERO 0x04
#define SPU_SV_POS_ZERO 0x08
#define SPU_SV_NEG_INFINITY 0x10
#define SPU_SV_POS_INFINITY 0x20
#define SPU_SV_NAN 0x40

#define CGT_SPU_INLINE static inline __attribute__((always_inline, unused))

#endif
