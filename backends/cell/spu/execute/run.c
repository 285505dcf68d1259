/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt_spu_run: which interpreter, and what is the same for all. */
#include <stdio.h>

#include "cell/spu/execute/execute.h"
#include "cell/spu/timing/timing.h"

cgt_spu_execute_fn cgt_spu_execute_portable, cgt_spu_execute_sse, cgt_spu_execute_neon, cgt_spu_execute_avx2;

static bool any_cpu(void) { return true; }
#ifdef CGT_CELL_HAVE_SSE
static bool cpu_has_sse(void) { return __builtin_cpu_supports("sse4.1"); }
#endif
#ifdef CGT_CELL_HAVE_AVX2
static bool cpu_has_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi");
}
#endif

const cgt_spu_row cgt_spu_rows[] = {
    {"portable", cgt_spu_execute_portable, any_cpu},
#ifdef CGT_CELL_HAVE_SSE
    {"sse", cgt_spu_execute_sse, cpu_has_sse},
#endif
#ifdef CGT_CELL_HAVE_NEON
    {"neon", cgt_spu_execute_neon, any_cpu},
#endif
#ifdef CGT_CELL_HAVE_AVX2
    {"avx2", cgt_spu_execute_avx2, cpu_has_avx2},
#endif
    {NULL, NULL, NULL},
};

static const cgt_spu_row *find_row(void)
{
    const cgt_spu_row *found = cgt_spu_rows;
    for (const cgt_spu_row *row = cgt_spu_rows; row->name; row++)
        if (row->runs())
            found = row;
    return found;
}

/* What the channels' owner added to the time since the last run. */
static void count_channel_wait(cgt_spu *spu)
{
    cgt_spu_timing *const t = spu->timing;
    if (spu->cycle > t->next_cycle) {
        cgt_spu_timing_enter(t, spu->pc);
        t->counts->cycles[CGT_SPU_CHANNEL] += spu->cycle - t->next_cycle;
        t->pair_open = false;
    }
}

cgt_spu_end cgt_spu_run(cgt_spu *spu, const cgt_spu_channels *channels, uint64_t until_cycle)
{
    spu->message[0] = 0;
    if (spu->pc % 4 || spu->pc > CGT_SPU_LOCAL_STORE) {
        snprintf(spu->message, sizeof spu->message, "at 0x%05x: no address of an instruction", (unsigned)spu->pc);
        return (cgt_spu_end){CGT_SPU_ERROR, 0};
    }
    if (spu->timing)
        count_channel_wait(spu);
    const cgt_spu_row *row = spu->row ? spu->row : find_row();
    const cgt_spu_end end = row->execute(spu, channels, until_cycle);
    if (spu->timing)
        spu->timing->next_cycle = spu->cycle;
    return end;
}
