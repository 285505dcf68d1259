/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Counts per function, see timing.h. */
#include "cell/spu/timing/timing.h"

#include <stdlib.h>
#include <string.h>

#include "core/memory.h"

const char *const cgt_spu_cause_names[CGT_SPU_CAUSES] = {"dual",       "single",    "dependency", "double",
                                                         "mispredict", "hint_wait", "channel"};

void cgt_spu_timing_init(cgt_spu_timing *timing)
{
    *timing = (cgt_spu_timing){.hint_branch = 1};
    cgt_spu_timing_enter(timing, 0);
    timing->last = timing->counts;
}

void cgt_spu_timing_release(cgt_spu_timing *timing, const cgt_memory_hooks *memory)
{
    cgt_free(memory, timing->function, timing->functions * sizeof *timing->function);
    timing->function = NULL;
    timing->functions = 0;
}

static int compare_addresses(const void *a, const void *b)
{
    const cgt_spu_function *fa = a, *fb = b;
    if (fa->address != fb->address)
        return fa->address < fb->address ? -1 : 1;
    if (fa->size != fb->size)
        return fa->size > fb->size ? -1 : 1;
    return strcmp(fa->name, fb->name); /* a file's order of symbols must not matter */
}

cgt_result cgt_spu_timing_set_functions(cgt_spu_timing *timing, const cgt_memory_hooks *memory,
                                        const cgt_spu_function *function, uint32_t functions)
{
    cgt_spu_function *copy = NULL;
    cgt_spu_timing_release(timing, memory);
    timing->other = (cgt_spu_counts){0};
    if (functions) {
        copy = cgt_allocate(memory, functions * sizeof *copy);
        if (!copy)
            functions = 0;
    }
    timing->function = copy;
    timing->functions = functions;
    if (copy) {
        memcpy(copy, function, functions * sizeof *copy);
        qsort(copy, functions, sizeof *copy, compare_addresses);
    }
    uint32_t end = 0;
    for (uint32_t i = 0; i < functions; i++) {
        if (copy[i].address < end)
            copy[i].size = 0; /* within another */
        else
            end = copy[i].address + copy[i].size;
        copy[i].counts = (cgt_spu_counts){0};
    }
    cgt_spu_timing_enter(timing, 0);
    timing->last = timing->counts;
    return copy || !function ? CGT_OK : CGT_ERROR_OUT_OF_MEMORY;
}

/* The last function that begins at or before an address and was not dropped; NULL where there is none. */
static cgt_spu_function *find_before(cgt_spu_timing *timing, uint32_t address)
{
    uint32_t low = 0, high = timing->functions;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (timing->function[middle].address <= address)
            low = middle + 1;
        else
            high = middle;
    }
    while (low > 0 && timing->function[low - 1].size == 0)
        low--;
    return low > 0 ? &timing->function[low - 1] : NULL;
}

void cgt_spu_timing_enter(cgt_spu_timing *timing, uint32_t address)
{
    cgt_spu_function *const f = find_before(timing, address);
    if (f && address - f->address < f->size) {
        timing->low = f->address;
        timing->size = f->size;
        timing->counts = &f->counts;
        return;
    }
    timing->low = address;
    timing->size = timing->functions ? 4 : CGT_SPU_LOCAL_STORE - address;
    timing->counts = &timing->other;
}

uint64_t cgt_spu_counts_cycles(const cgt_spu_counts *counts)
{
    uint64_t sum = 0;
    for (int i = 0; i < CGT_SPU_CAUSES; i++)
        sum += counts->cycles[i];
    return sum;
}

cgt_spu_counts cgt_spu_timing_total(const cgt_spu_timing *timing)
{
    cgt_spu_counts total = timing->other;
    for (uint32_t i = 0; i < timing->functions; i++) {
        const cgt_spu_counts *const c = &timing->function[i].counts;
        total.instructions += c->instructions;
        total.mispredicts += c->mispredicts;
        for (int k = 0; k < CGT_SPU_CLASSES; k++)
            total.classes[k] += c->classes[k];
        for (int k = 0; k < CGT_SPU_CAUSES; k++)
            total.cycles[k] += c->cycles[k];
    }
    return total;
}
