/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The header of this name of the SPU's compiler: the vector types, and names for those of VMX code that an SPU does
 * not tell apart. */
#ifndef CGT_VEC_TYPES_H
#define CGT_VEC_TYPES_H

#include "spu_intrinsics.h"

#define vec_bchar16 vec_uchar16
#define vec_bshort8 vec_ushort8
#define vec_pixel8 vec_ushort8
#define vec_bint4 vec_uint4

#endif
