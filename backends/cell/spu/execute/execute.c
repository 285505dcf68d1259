/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The interpreter: one switch over the rows of the instruction set, once timed and once not. Compiled once per row of
 * the variant table (execute.h).
 *
 * Floats are computed in the SPU's mode of the host's arithmetic (simd/spu/spu_arithmetic_mode.h), all else in
 * integers. So the mode is on for the whole loop, and off while channels are called. */
#include "cell/spu/execute/execute.h"

#include <stdio.h>

#include "cell/spu/execute/double.h"
#include "cell/spu/execute/elements.h"
#include "cell/spu/execute/quads.h"
#include "cell/spu/timing/issue.h"
#include "spu/spu_arithmetic_mode.h"
#include "spu/spu_exact.h"

#define ADDRESS (CGT_SPU_LOCAL_STORE - 4) /* the bits of an instruction's address */
#define QUADWORD (CGT_SPU_LOCAL_STORE - 16)

enum { CHANNEL_MACHINE_STATUS = 13, CHANNEL_WRITE_SRR0 = 14, CHANNEL_READ_SRR0 = 15, CHANNEL_EVENTS = 0 };

/* What all instructions of a run share. */
typedef struct loop {
    cgt_spu *spu;
    const cgt_spu_channels *channels;
    cgt_spu_arithmetic host; /* the caller's floating-point mode */
} loop;

/* One instruction. */
typedef struct step {
    uint32_t pc, next;
    uint32_t value; /* what rdch or rchcnt reads */
    cgt_spu_issue issue;
    uint64_t instructions; /* with this one */
    cgt_spu_end end;       /* where it ends the run */
} step;

typedef enum outcome { GOES_ON, ENDS, JUMPS_BADLY, LACKS_CHANNEL } outcome;

/* ---- memory ---- */

static inline void load_quadword(const cgt_spu *spu, uint32_t address, cgt_spu_register *rt)
{
    uint32_t word[4];
    memcpy(word, spu->local_store + (address & QUADWORD), sizeof word);
#if CGT_SPU_BYTE_SWAP
    for (int i = 0; i < 4; i++)
        word[i] = __builtin_bswap32(word[i]);
#endif
    memcpy(rt, word, sizeof word);
}

static inline void store_quadword(cgt_spu *spu, uint32_t address, const cgt_spu_register *rt)
{
    const uint32_t at = address & QUADWORD;
    uint32_t word[4];
    memcpy(word, rt, sizeof word);
#if CGT_SPU_BYTE_SWAP
    for (int i = 0; i < 4; i++)
        word[i] = __builtin_bswap32(word[i]);
#endif
    memcpy(spu->local_store + at, word, sizeof word);
    if (__builtin_expect(at + 16 > spu->code_low && at < spu->code_high, 0))
        cgt_spu_forget(spu, at, 16);
}

/* ---- errors ---- */

static __attribute__((noinline)) cgt_spu_end fail(cgt_spu *spu, uint32_t pc, const char *reason)
{
    if (pc < CGT_SPU_LOCAL_STORE && pc % 4 == 0) {
        const uint32_t word = cgt_spu_load32(spu, pc);
        cgt_spu_operands operands;
        const char *name = cgt_spu_isa[cgt_spu_disassemble(word, &operands)].name;
        snprintf(spu->message, sizeof spu->message, "at 0x%05x: instruction 0x%08x (%s): %s", (unsigned)pc,
                 (unsigned)word, name, reason);
    } else {
        snprintf(spu->message, sizeof spu->message, "at 0x%05x: %s", (unsigned)pc, reason);
    }
    return (cgt_spu_end){CGT_SPU_ERROR, 0};
}

static const char *bad_jump(uint32_t address)
{
    return address % 4 ? "it jumps to an address that is no multiple of 4" : "it jumps beyond the local store";
}

static const char *bad_channel(const loop *l)
{
    return l->channels ? "the channel does not allow it" : "there are no channels";
}

/* ---- channels ---- */

typedef enum access { ACCESS_READ, ACCESS_WRITE, ACCESS_COUNT } access;

typedef struct answer {
    cgt_channel_status status;
    uint32_t value;
} answer;

/* Of the channels that the SPU keeps itself; everything else about them is an error. */
static answer use_own_channel(cgt_spu *spu, access kind, unsigned channel, uint32_t value)
{
    if (kind == ACCESS_COUNT)
        return (answer){CGT_CHANNEL_DONE, 1};
    if (channel == CHANNEL_MACHINE_STATUS && kind == ACCESS_READ)
        return (answer){CGT_CHANNEL_DONE, spu->interrupts};
    if (channel == CHANNEL_READ_SRR0 && kind == ACCESS_READ)
        return (answer){CGT_CHANNEL_DONE, spu->srr0};
    if (channel != CHANNEL_WRITE_SRR0 || kind != ACCESS_WRITE)
        return (answer){CGT_CHANNEL_ERROR, 0};
    spu->srr0 = value & ADDRESS;
    return (answer){CGT_CHANNEL_DONE, 0};
}

/* value: what is written */
static __attribute__((noinline)) answer use_channel(const loop *l, access kind, unsigned channel, uint64_t cycle,
                                                    uint32_t value)
{
    const cgt_spu_channels *const c = l->channels;
    answer got = {CGT_CHANNEL_DONE, 0};
    if (channel >= CHANNEL_MACHINE_STATUS && channel <= CHANNEL_READ_SRR0)
        return use_own_channel(l->spu, kind, channel, value);
    if (!c)
        return (answer){CGT_CHANNEL_ERROR, 0};
    cgt_spu_leave_arithmetic(l->host);
    if (kind == ACCESS_COUNT)
        got.value = c->count(c->user, channel, cycle);
    else if (kind == ACCESS_READ)
        got.status = c->read(c->user, channel, cycle, &got.value);
    else
        got.status = c->write(c->user, channel, cycle, value);
    (void)cgt_spu_enter_arithmetic();
    return got;
}

/* ---- the words of the rows ---- */

#define U8 cgt_spu_as_u8
#define S8 cgt_spu_as_s8
#define U16 cgt_spu_as_u16
#define S16 cgt_spu_as_s16
#define U32 cgt_spu_as_u32
#define S32 cgt_spu_as_s32
#define F32 cgt_spu_as_f32
#define LOW_S16 cgt_spu_low_s16
#define SPLAT(a) cgt_spu_splat((uint32_t)(a))
#define SPLAT16(a) cgt_spu_splat16((uint32_t)(a))
#define PUT(v) cgt_spu_put(rt, (vec_uint4)(v))
#define PUT_FIRST(a) cgt_spu_put(rt, (vec_uint4){a, 0, 0, 0})

/* a, b, t: the word of each register */
#define EACH_WORD(result)                                                                                              \
    for (int i = 0; i < 4; i++) {                                                                                      \
        const uint32_t a = ra->word[i], b = rb->word[i], t = rt->word[i];                                              \
        (void)a, (void)b, (void)t;                                                                                     \
        rt->word[i] = (result);                                                                                        \
    }

#define LOAD(address) load_quadword(spu, address, rt)
#define STORE(address) store_quadword(spu, address, rt)
#define HINT(target, counts)                                                                                           \
    if (timed && (counts))                                                                                             \
    cgt_spu_issue_hint(spu->timing, &s->issue, (pc + (uint32_t)d->branch) & ADDRESS, (target)&ADDRESS, s->instructions)

#define LINK ((pc + 4) & ADDRESS)
#define GO(target) s->next = (target)&ADDRESS
#define GO_IF(condition, target)                                                                                       \
    if (condition)                                                                                                     \
    GO(target)
/* to an address in a register; the hardware would drop the bits that make it an error here */
#define JUMP_IF(condition, target)                                                                                     \
    if (condition) {                                                                                                   \
        s->next = (target);                                                                                            \
        if (s->next & ~ADDRESS)                                                                                        \
            return JUMPS_BADLY;                                                                                        \
        switch_interrupts(spu, d->rb);                                                                                 \
    }
#define CALL_IF_EVENT(target)                                                                                          \
    const uint32_t to = (target);                                                                                      \
    const answer events = use_channel(l, ACCESS_COUNT, CHANNEL_EVENTS, s->issue.cycle, 0);                             \
    if (events.status != CGT_CHANNEL_DONE)                                                                             \
        return LACKS_CHANNEL;                                                                                          \
    JUMP_IF(events.value, to)                                                                                          \
    PUT_FIRST(LINK)

#define STOP(code)                                                                                                     \
    s->end = (cgt_spu_end){CGT_SPU_STOPPED, code};                                                                     \
    return ENDS
#define HALT_IF(condition)                                                                                             \
    if (condition) {                                                                                                   \
        s->end = (cgt_spu_end){CGT_SPU_HALTED, 0};                                                                     \
        return ENDS;                                                                                                   \
    }

/* the access itself has happened before the instruction was counted: it might stall */
#define READ_CHANNEL PUT_FIRST(s->value)
#define COUNT_CHANNEL PUT_FIRST(s->value)
#define WRITE_CHANNEL (void)0

static inline void switch_interrupts(cgt_spu *spu, unsigned features)
{
    if (features & CGT_SPU_FEATURE_DISABLE)
        spu->interrupts = false;
    if (features & CGT_SPU_FEATURE_ENABLE)
        spu->interrupts = true;
}

/* ---- one instruction ---- */

static inline __attribute__((always_inline)) outcome execute_one(const loop *l, cgt_spu *spu, const cgt_spu_decoded *d,
                                                                 step *s, const bool timed)
{
    const uint32_t pc = s->pc;
    cgt_spu_register *const rt = &spu->reg[d->rt];
    const cgt_spu_register *const ra = &spu->reg[d->ra], *const rb = &spu->reg[d->rb], *const rc = &spu->reg[d->rc];
    const int32_t imm = d->imm;
    s->next = pc + 4;
    switch (d->op) {
#define CGT_SPU_ROW(name, format, opcode, class, use, ...)                                                             \
    case cgt_spu_op_##name: {                                                                                          \
        __VA_ARGS__;                                                                                                   \
        break;                                                                                                         \
    }
#include "cell/spu/isa/rows.h"
#undef CGT_SPU_ROW
    default: __builtin_unreachable();
    }
    return GOES_ON;
}

/* What was not decoded is; returns false, with the end, where it is no instruction. */
static __attribute__((noinline)) bool decode(cgt_spu *spu, uint32_t pc, cgt_spu_end *end)
{
    const cgt_spu_decoded *const d = &spu->decoded[pc / 4];
    if (d->op == CGT_SPU_OP_UNDECODED)
        cgt_spu_decode(spu, pc);
    if (d->op == CGT_SPU_OP_UNDEFINED)
        *end = fail(spu, pc, "there is no such instruction");
    if (d->op == CGT_SPU_OP_END)
        *end = fail(spu, pc, "the program runs off the end of the local store");
    return d->op > CGT_SPU_OP_END;
}

/* The access of rdch, wrch or rchcnt, in the cycle `at`; returns false, with the end, where it does not happen. */
static __attribute__((noinline)) bool access_channel(const loop *l, const cgt_spu_decoded *d, uint32_t pc, uint64_t at,
                                                     uint32_t *value, cgt_spu_end *end)
{
    const access kind = d->op == cgt_spu_op_rdch ? ACCESS_READ : d->op == cgt_spu_op_wrch ? ACCESS_WRITE : ACCESS_COUNT;
    l->spu->pc = pc;
    l->spu->cycle = at;
    const answer got = use_channel(l, kind, d->ra, at, l->spu->reg[d->rt].word[0]);
    *value = got.value;
    if (got.status == CGT_CHANNEL_DONE)
        return true;
    *end = got.status == CGT_CHANNEL_STALL ? (cgt_spu_end){CGT_SPU_STALLED, d->ra} : fail(l->spu, pc, bad_channel(l));
    return false;
}

/* ---- the loop ---- */

/* Counts a wait in which the run ends; the instruction issues later. */
static inline uint64_t wait_until(cgt_spu_timing *timing, cgt_spu_issue issue, uint64_t cycle, uint64_t end)
{
    if (!timing || cycle >= end)
        return cycle;
    cgt_spu_issue_wait(timing, &issue, cycle, end);
    return end;
}

static inline __attribute__((always_inline)) cgt_spu_end run(const loop *l, uint64_t until, const bool timed)
{
    cgt_spu *const spu = l->spu;
    cgt_spu_timing *const timing = timed ? spu->timing : NULL;
    step s = {.pc = spu->pc, .instructions = spu->instructions};
    uint64_t cycle = spu->cycle;
    outcome result = GOES_ON;
    cgt_spu_end end; /* apart from the step, which stays in registers */
    uint32_t value = 0;
    for (;; s.pc = s.next) {
        const cgt_spu_decoded *const d = &spu->decoded[s.pc / 4];
        if (__builtin_expect(d->op <= CGT_SPU_OP_END, 0) && !decode(spu, s.pc, &end))
            break;
        s.issue = timed ? cgt_spu_issue_find(timing, d, s.pc, cycle, s.instructions) : (cgt_spu_issue){.cycle = cycle};
        if (__builtin_expect(s.issue.cycle >= until, 0)) {
            end = (cgt_spu_end){CGT_SPU_CYCLES, 0};
            cycle = wait_until(timing, s.issue, cycle, until);
            break;
        }
        if (__builtin_expect(d->op >= cgt_spu_op_rdch, 0)) {
            if (!access_channel(l, d, s.pc, s.issue.cycle, &value, &end)) {
                if (end.reason == CGT_SPU_STALLED)
                    cycle = wait_until(timing, s.issue, cycle, s.issue.cycle);
                break;
            }
            s.value = value;
        }
        cycle = timed ? cgt_spu_issue_commit(timing, d, s.pc, cycle, &s.issue) : cycle + 1;
        s.instructions++;
        result = execute_one(l, spu, d, &s, timed);
        if (__builtin_expect(result != GOES_ON, 0))
            break;
        if (timed && __builtin_expect(s.next != s.pc + 4 || s.issue.hinted, 0))
            cycle = cgt_spu_issue_resolve(timing, &s.issue, s.pc, s.next, cycle);
    }
    if (result == ENDS)
        end = s.end;
    if (result == JUMPS_BADLY)
        end = fail(spu, s.pc, bad_jump(s.next));
    if (result == LACKS_CHANNEL)
        end = fail(spu, s.pc, bad_channel(l));
    spu->pc = result == ENDS ? s.next : s.pc;
    spu->cycle = cycle;
    spu->instructions = s.instructions;
    return end;
}

cgt_spu_end CGT_SPU_JOIN(cgt_spu_execute, CGT_VARIANT)(cgt_spu *spu, const cgt_spu_channels *channels,
                                                       uint64_t until_cycle)
{
    const loop l = {spu, channels, cgt_spu_enter_arithmetic()};
    const cgt_spu_end end = spu->timing ? run(&l, until_cycle, true) : run(&l, until_cycle, false);
    cgt_spu_leave_arithmetic(l.host);
    return end;
}
