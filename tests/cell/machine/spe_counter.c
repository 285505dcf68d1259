/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * An SPE program in C (spe_programs.h), for the host and for an SPU's compiler.
 * counter: a word that several SPEs raise. */
#define CGT_SPU_EXACT
#include "cell/machine/spe_program.h"

#include "cell/machine/spe_constants.h"

typedef struct store {
    _Alignas(128) uint32_t line[32];
} store;
CGT_SPE_STORE(store, s)

CGT_SPE_MAIN(counter)
{
    for (unsigned i = 0; i < COUNTER_ROUNDS; i++)
        do {
            mfc_getllar(s()->line, argument, 0, 0);
            mfc_read_atomic_status();
            s()->line[0]++;
            mfc_putllc(s()->line, argument, 0, 0);
        } while (mfc_read_atomic_status() != 0);
    return 0;
}
