/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The vector types of the SPU language extension on the compiler's own vectors (gcc and clang).
 *
 *   vec_TYPEn   n elements of TYPE, 16 bytes, element 0 first in memory on every host
 *
 * A comparison gives an unsigned vector of the same element size: all ones where true, else zero. */
#ifndef CGT_SPU_TYPES_H
#define CGT_SPU_TYPES_H

#include <stdint.h>

typedef uint8_t vec_uchar16 __attribute__((vector_size(16)));
typedef int8_t vec_char16 __attribute__((vector_size(16)));
typedef uint16_t vec_ushort8 __attribute__((vector_size(16)));
typedef int16_t vec_short8 __attribute__((vector_size(16)));
typedef uint32_t vec_uint4 __attribute__((vector_size(16)));
typedef int32_t vec_int4 __attribute__((vector_size(16)));
typedef float vec_float4 __attribute__((vector_size(16)));

#define CGT_SPU_INLINE static inline __attribute__((always_inline, unused))

#endif
