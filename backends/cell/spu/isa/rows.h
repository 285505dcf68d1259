/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * All rows of the instruction set, for whoever has defined CGT_SPU_ROW (isa.h). */
#include "cell/spu/isa/rows/element.h" /* sums, products, bytes */

#include "cell/spu/isa/rows/compare.h"

#include "cell/spu/isa/rows/logic.h" /* and constants */

#include "cell/spu/isa/rows/shift.h"

#include "cell/spu/isa/rows/quad.h"

#include "cell/spu/isa/rows/float.h"

#include "cell/spu/isa/rows/memory.h"

#include "cell/spu/isa/rows/control.h"
