/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An SPE program in C (spe_programs.h), for the host and for an SPU's compiler.
 * squares: a get, floats in the SPU's arithmetic, a put. */
#define CGT_SPU_EXACT
#include "cell/machine/spe_program.h"

#include "cell/machine/spe_constants.h"

typedef struct store {
    _Alignas(128) vec_float4 data[SQUARES_FLOATS / 4];
} store;
CGT_SPE_STORE(store, s)

static void wait_for(unsigned tag)
{
    mfc_write_tag_mask(1u << tag);
    mfc_read_tag_status_all();
}

CGT_SPE_MAIN(squares)
{
    const unsigned long long ea = argument + spe * sizeof s()->data;
    mfc_get(s()->data, ea, sizeof s()->data, 3, 0, 0);
    wait_for(3);
    for (unsigned i = 0; i < SQUARES_FLOATS / 4; i++)
        s()->data[i] = spu_mul(s()->data[i], s()->data[i]);
    mfc_putf(s()->data, ea, sizeof s()->data, 3, 0, 0);
    wait_for(3);
    spu_write_out_mbox((unsigned)spe);
    return 7;
}
