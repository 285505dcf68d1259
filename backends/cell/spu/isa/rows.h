/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All rows of the instruction set, for whoever has defined CGT_SPU_ROW (isa.h). */
#include "cell/spu/isa/rows_element.h" /* sums, products, bytes */

#include "cell/spu/isa/rows_compare.h"

#include "cell/spu/isa/rows_logic.h" /* and constants */

#include "cell/spu/isa/rows_shift.h"

#include "cell/spu/isa/rows_quad.h"

#include "cell/spu/isa/rows_float.h"

#include "cell/spu/isa/rows_memory.h"

#include "cell/spu/isa/rows_control.h"
