/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An SPE program in C (spe_programs.h), for the host and for an SPU's compiler.
 * strips: rows whose numbers come by mailbox. */
#define CGT_SPU_EXACT
#include "cell/machine/spe_program.h"

#include "cell/machine/spe_constants.h"

typedef struct store {
    _Alignas(128) uint32_t line[32];
} store;
CGT_SPE_STORE(store, s)

static void wait_for(unsigned tag)
{
    mfc_write_tag_mask(1u << tag);
    mfc_read_tag_status_all();
}

CGT_SPE_MAIN(strips)
{
    for (;;) {
        const unsigned row = spu_read_in_mbox();
        if (row == STRIPS_END)
            return 0;
        mfc_get(s()->line, argument + 128 * row, 128, 1, 0, 0);
        wait_for(1);
        for (unsigned i = 0; i < 32; i++)
            s()->line[i] += row;
        mfc_putf(s()->line, argument + 128 * row, 128, 1, 0, 0);
        wait_for(1);
        spu_write_out_mbox(row);
    }
}
