/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU compiler's header of this name: the vector types, and names for VMX types that an SPU cannot distinguish. */
#ifndef CGT_VEC_TYPES_H
#define CGT_VEC_TYPES_H

#include "spu_intrinsics.h"

#define vec_bchar16 vec_uchar16
#define vec_bshort8 vec_ushort8
#define vec_pixel8 vec_ushort8
#define vec_bint4 vec_uint4

#endif
