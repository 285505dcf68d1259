/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * When an instruction issues: the rules of the model, instruction by instruction.
 *
 *   - Instructions issue in order. Two issue in one cycle where the first lies at a multiple of 8 and goes to the even
 *     pipe, the second lies behind it and goes to the odd pipe, and both are ready. Else the second waits one cycle.
 *   - An instruction waits until what it reads is ready.
 *   - Behind a double-precision instruction nothing issues for DOUBLE_STALL cycles, nor in its own.
 *   - A branch is predicted not to be taken. One hint at a time says otherwise for one address, until the next hint.
 *     The branch waits for a hint that is not yet in effect; a hint that is too near is ignored.
 *   - Behind a wrong prediction nothing issues until MISPREDICT cycles after the branch.
 *
 * Not modelled: contention for the local store, which has one port (loads, DMA and instruction fetch; hbrp), and that a
 * fetch crosses lines. */
#ifndef CGT_CELL_ISSUE_H
#define CGT_CELL_ISSUE_H

#include "cell/spu/timing/model.h"
#include "cell/spu/timing/timing.h"

#define CGT_SPU_ISSUE static inline __attribute__((always_inline))

typedef struct cgt_spu_issue {
    uint64_t cycle; /* in which it issues */
    uint64_t ready; /* the first one in which its operands allow it */
    bool paired;    /* in the same cycle as the last one */
    bool hinted;    /* predicted to go on at the hint's target */
} cgt_spu_issue;

CGT_SPU_ISSUE uint64_t cgt_spu_later(uint64_t a, uint64_t b) { return a > b ? a : b; }

/* Finds when an instruction issues and changes nothing but the counts' function. cycle: the first one that is free. */
CGT_SPU_ISSUE cgt_spu_issue cgt_spu_issue_find(cgt_spu_timing *t, const cgt_spu_decoded *d, uint32_t pc, uint64_t cycle,
                                               uint64_t instructions)
{
    if (pc - t->low >= t->size)
        cgt_spu_timing_enter(t, pc);
    const uint64_t two = cgt_spu_later(t->ready[d->read[0]], t->ready[d->read[1]]);
    const uint64_t ready = cgt_spu_later(two, t->ready[d->read[2]]);
    cgt_spu_issue issue = {.ready = ready};
    uint64_t earliest = ready;
    if (__builtin_expect(pc == t->hint_branch, 0)) {
        issue.hinted = instructions - t->hint_instruction >= CGT_SPU_MODEL_HINT_NEAREST;
        if (issue.hinted)
            earliest = cgt_spu_later(ready, t->hint_cycle + CGT_SPU_MODEL_HINT_READY);
    }
    issue.paired = t->pair_open && (pc & 4) && cgt_spu_pipes[d->class].odd && earliest < cycle;
    issue.cycle = issue.paired ? cycle - 1 : cgt_spu_later(cycle, earliest);
    return issue;
}

/* Counts cycles in which nothing issued. The next instruction cannot pair across them. */
CGT_SPU_ISSUE void cgt_spu_issue_wait(cgt_spu_timing *t, const cgt_spu_issue *issue, uint64_t from, uint64_t to)
{
    const uint64_t ready = issue->ready < from ? from : issue->ready < to ? issue->ready : to;
    t->counts->cycles[CGT_SPU_DEPENDENCY] += ready - from;
    t->counts->cycles[CGT_SPU_HINT_WAIT] += to - ready;
    t->pair_open = false;
}

/* Issues; returns the next free cycle. */
CGT_SPU_ISSUE uint64_t cgt_spu_issue_commit(cgt_spu_timing *t, const cgt_spu_decoded *d, uint32_t pc, uint64_t cycle,
                                            const cgt_spu_issue *issue)
{
    const cgt_spu_pipe pipe = cgt_spu_pipes[d->class];
    if (issue->paired) {
        t->last->cycles[CGT_SPU_SINGLE]--;
        t->counts->cycles[CGT_SPU_DUAL]++;
        t->pair_open = false;
    } else {
        if (issue->cycle != cycle)
            cgt_spu_issue_wait(t, issue, cycle, issue->cycle);
        t->counts->cycles[CGT_SPU_SINGLE]++;
        t->pair_open = !(pc & 4) && !pipe.odd;
        cycle = issue->cycle + 1;
    }
    t->counts->instructions++;
    t->counts->classes[d->class]++;
    t->last = t->counts;
    t->ready[d->writes] = issue->cycle + pipe.latency;
    if (__builtin_expect(d->class == CGT_SPU_FPD, 0)) {
        t->counts->cycles[CGT_SPU_DOUBLE] += CGT_SPU_MODEL_DOUBLE_STALL;
        t->pair_open = false;
        cycle += CGT_SPU_MODEL_DOUBLE_STALL;
    }
    return cycle;
}

/* The instruction goes on at next; returns the next free cycle. */
CGT_SPU_ISSUE uint64_t cgt_spu_issue_resolve(cgt_spu_timing *t, const cgt_spu_issue *issue, uint32_t pc, uint32_t next,
                                             uint64_t cycle)
{
    const uint32_t predicted = issue->hinted ? t->hint_target : pc + 4;
    if (__builtin_expect(next == predicted, 1))
        return cycle;
    const uint64_t resumed = issue->cycle + CGT_SPU_MODEL_MISPREDICT;
    t->counts->cycles[CGT_SPU_MISPREDICT] += resumed - cycle;
    t->counts->mispredicts++;
    t->pair_open = false;
    return resumed;
}

CGT_SPU_ISSUE void cgt_spu_issue_hint(cgt_spu_timing *t, const cgt_spu_issue *issue, uint32_t branch, uint32_t target,
                                      uint64_t instructions)
{
    t->hint_branch = branch;
    t->hint_target = target;
    t->hint_cycle = issue->cycle;
    t->hint_instruction = instructions;
}

#endif
