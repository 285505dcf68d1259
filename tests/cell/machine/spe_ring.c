/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An SPE program in C (spe_programs.h), for the host and for an SPU's compiler.
 * ring: a token that goes from local store to local store, with signals. */
#define CGT_SPU_EXACT
#include "cell/machine/spe_program.h"

#include "cell/machine/spe_constants.h"

typedef struct store {
    _Alignas(128) uint32_t token[4];
    _Alignas(16) uint32_t signal[4]; /* the last word: at the low four bits of the register's address */
} store;
CGT_SPE_STORE(store, s)

static void wait_for(unsigned tag)
{
    mfc_write_tag_mask(1u << tag);
    mfc_read_tag_status_all();
}

CGT_SPE_MAIN(ring)
{
    const unsigned next = (unsigned)((spe + 1) % argument);
    uint32_t *const token = s()->token, *const signal = &s()->signal[3];
    for (unsigned i = 0; i < RING_ROUNDS; i++) {
        if (spe != 0 || i > 0)
            (void)spu_read_signal1();
        token[0]++;
        *signal = 1;
        mfc_put(token, CGT_SPE_EA(next) + cgt_spe_local_address(token), 16, 2, 0, 0);
        mfc_sndsigf(signal, CGT_SPE_SIGNAL_EA(next, 1), 2, 0, 0);
        wait_for(2);
    }
    if (spe == 0)
        (void)spu_read_signal1(); /* the token comes home */
    return (int)token[0];
}
