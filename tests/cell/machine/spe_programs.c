/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPE programs in C, as they would be compiled for an SPU. */
#define CGT_SPU_EXACT
#include "cell/machine/spe_program.h"

#include "cell/machine/spe_programs.h"

typedef struct store {
    _Alignas(128) vec_float4 data[SQUARES_FLOATS / 4];
    _Alignas(128) uint32_t line[32];
    _Alignas(128) uint32_t token[4];
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

/* argument: how many SPEs. The token is a word that is copied from store to store and grows by one each time. */
CGT_SPE_MAIN(ring)
{
    const unsigned next = (unsigned)((spe + 1) % argument);
    uint32_t *const token = s()->token, *const signal = &s()->line[3]; /* at the register's low four bits */
    for (unsigned i = 0; i < RING_ROUNDS; i++) {
        if (spe != 0 || i > 0)
            (void)spu_read_signal1();
        token[0]++;
        *signal = 1;
        mfc_put(token, CGT_SPE_EA(next) + (unsigned)((char *)token - (char *)s()), 16, 2, 0, 0);
        mfc_sndsigf(signal, CGT_SPE_SIGNAL_EA(next, 1), 2, 0, 0);
        wait_for(2);
    }
    if (spe == 0)
        (void)spu_read_signal1(); /* the token comes home */
    return (int)token[0];
}
