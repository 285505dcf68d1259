/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A simulated SPU as the processor of an SPE. */
#include "cell/machine/machine.h"

static cgt_spu_end run(void *user, const cgt_spu_channels *channels, uint64_t until_cycle)
{
    return cgt_spu_run(user, channels, until_cycle);
}

static uint64_t get_cycle(void *user) { return ((const cgt_spu *)user)->cycle; }

static void raise_cycle(void *user, uint64_t cycle)
{
    cgt_spu *const spu = user;
    if (cycle > spu->cycle)
        spu->cycle = cycle;
}

static void written(void *user, uint32_t lsa, uint32_t size) { cgt_spu_forget(user, lsa, size); }

static const char *get_message(void *user) { return ((const cgt_spu *)user)->message; }

static void set_register(cgt_spu *spu, unsigned number, uint64_t value)
{
    spu->reg[number] = (cgt_spu_register){{(uint32_t)(value >> 32), (uint32_t)value, 0, 0}};
}

cgt_spe_unit cgt_cell_unit_of(cgt_spu *spu, unsigned spe, uint64_t argument, uint64_t environment)
{
    set_register(spu, 3, spe);
    set_register(spu, 4, argument);
    set_register(spu, 5, environment);
    return (cgt_spe_unit){.user = spu,
                          .local_store = spu->local_store,
                          .store_bytes = CGT_SPU_LOCAL_STORE,
                          .order = CGT_STORE_BIG_ENDIAN,
                          .run = run,
                          .get_cycle = get_cycle,
                          .raise_cycle = raise_cycle,
                          .written = written,
                          .get_message = get_message};
}
