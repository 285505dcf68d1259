/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A processor made of a list of steps. */
#include "cell/support/fake_spu.h"

#include <string.h>

#include "support/test.h"

void fake_init(fake_spu *spu, const fake_step *steps)
{
    memset(spu, 0, sizeof *spu);
    spu->steps = steps;
}

uint32_t fake_load32(const fake_spu *spu, uint32_t lsa)
{
    const uint8_t *const b = spu->store + lsa;
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

void fake_store32(fake_spu *spu, uint32_t lsa, uint32_t value)
{
    for (unsigned i = 0; i < 4; i++)
        spu->store[lsa + i] = (uint8_t)(value >> (24 - 8 * i));
}

static void keep(fake_spu *spu, uint32_t value)
{
    spu->value = value;
    if (spu->reads < TEST_COUNT(spu->read)) {
        spu->read[spu->reads] = value;
        spu->when[spu->reads++] = spu->cycle;
    }
}

static cgt_channel_status access_channel(fake_spu *spu, const fake_step *s, const cgt_spu_channels *c)
{
    uint32_t value = s->operation == FAKE_SEND ? spu->value : s->value;
    if (s->operation != FAKE_READ)
        return c->write(c->user, s->channel, spu->cycle, value);
    const cgt_channel_status status = c->read(c->user, s->channel, spu->cycle, &value);
    if (status == CGT_CHANNEL_DONE)
        keep(spu, value);
    return status;
}

/* one step; returns whether the run goes on */
static bool step(fake_spu *spu, const cgt_spu_channels *c, cgt_spu_end *end)
{
    const fake_step *const s = &spu->steps[spu->next];
    uint64_t cycles = 1;
    spu->next++;
    switch (s->operation) {
    case FAKE_STOP: *end = (cgt_spu_end){CGT_SPU_STOPPED, s->value}; return false;
    case FAKE_HALT: *end = (cgt_spu_end){CGT_SPU_HALTED, 0}; return false;
    case FAKE_WORK: cycles = s->value; break;
    case FAKE_CALL: s->call(spu); break;
    case FAKE_COUNT: keep(spu, c->count(c->user, s->channel, spu->cycle)); break;
    case FAKE_WRITE:
    case FAKE_SEND:
    case FAKE_READ: {
        const cgt_channel_status status = access_channel(spu, s, c);
        if (status != CGT_CHANNEL_DONE) {
            spu->next--;
            *end = (cgt_spu_end){status == CGT_CHANNEL_STALL ? CGT_SPU_STALLED : CGT_SPU_ERROR, s->channel};
            return false;
        }
    }
    }
    spu->cycle += cycles;
    return true;
}

static cgt_spu_end run(void *user, const cgt_spu_channels *channels, uint64_t until_cycle)
{
    fake_spu *const spu = user;
    cgt_spu_end end = {CGT_SPU_CYCLES, 0};
    while (spu->cycle < until_cycle && step(spu, channels, &end)) {
    }
    return end;
}

static uint64_t get_cycle(void *user) { return ((const fake_spu *)user)->cycle; }

static void raise_cycle(void *user, uint64_t cycle)
{
    fake_spu *const spu = user;
    assert_true(cycle >= spu->cycle);
    spu->cycle = cycle;
}

static const char *get_message(void *user)
{
    (void)user;
    return "no message";
}

cgt_spe_unit fake_unit(fake_spu *spu)
{
    return (cgt_spe_unit){.user = spu,
                          .local_store = spu->store,
                          .store_bytes = sizeof spu->store,
                          .order = CGT_STORE_BIG_ENDIAN,
                          .run = run,
                          .get_cycle = get_cycle,
                          .raise_cycle = raise_cycle,
                          .get_message = get_message};
}

cgt_cell *fake_run(fake_spu *spu, uint32_t *memory, uint32_t words, const cgt_cell_options *options, cgt_result *result)
{
    cgt_cell *cell;
    const cgt_spe_unit unit = fake_unit(spu);
    assert_int_equal(cgt_cell_create(options, &cell), CGT_OK);
    assert_int_equal(cgt_cell_add_memory(cell, 0x10000, memory, words, 4, true), CGT_OK);
    *result = cgt_cell_run_simulated(cell, &unit, NULL, NULL);
    return cell;
}
