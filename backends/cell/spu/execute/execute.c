/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The interpreter: one switch over the rows of the instruction set, once timed and once not. Compiled once per row of
 * the variant table (execute.h).
 *
 * Floats are computed in the SPU's mode of the host's arithmetic (simd/spu_arithmetic_mode.h), all else in integers. So
 * the mode is on for the whole loop, and off while channels are called. */
#include "cell/spu/execute/execute.h"

#include <stdio.h>

#include "cell/spu/execute/double.h"
#include "cell/spu/execute/elements.h"
#include "cell/spu/execute/quads.h"
#include "cell/spu/timing/issue.h"
#include "spu_arithmetic_mode.h"
#include "spu_exact.h"

#define ADDRESS (CGT_SPU_LOCAL_STORE - 4) /* the bits of an instruction's address */
#define QUADWORD (CGT_SPU_LOCAL_STORE - 16)

enum { CHANNEL_MACHINE_STATUS = 13, CHANNEL_WRITE_SRR0 = 14, CHANNEL_READ_SRR0 = 15, CHANNEL_EVENTS = 0 };

/* What the loop shares with its helpers; the rest is in local variables. */
typedef struct loop {
    cgt_spu *spu;
    const cgt_spu_channels *channels;
    cgt_spu_arithmetic host; /* the caller's floating-point mode */
} loop;

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

static const char *bad_address(uint32_t address)
{
    return address % 4 ? "it jumps to an address that is no multiple of 4" : "it jumps beyond the local store";
}

/* ---- channels ---- */

typedef enum { ACCESS_READ, ACCESS_WRITE, ACCESS_COUNT } access;

/* The SPU's own channels. Returns false where it is another one. */
static bool own_channel(cgt_spu *spu, access kind, unsigned channel, uint32_t *value, cgt_channel_status *status)
{
    *status = CGT_CHANNEL_DONE;
    if (channel < CHANNEL_MACHINE_STATUS || channel > CHANNEL_READ_SRR0)
        return false;
    if (kind == ACCESS_COUNT)
        *value = 1;
    else if (channel == CHANNEL_WRITE_SRR0 && kind == ACCESS_WRITE)
        spu->srr0 = *value & ADDRESS;
    else if (channel == CHANNEL_READ_SRR0 && kind == ACCESS_READ)
        *value = spu->srr0;
    else if (channel == CHANNEL_MACHINE_STATUS && kind == ACCESS_READ)
        *value = spu->interrupts;
    else
        *status = CGT_CHANNEL_ERROR;
    return true;
}

static __attribute__((noinline)) cgt_channel_status use_channel(const loop *l, access kind, unsigned channel,
                                                                uint64_t cycle, uint32_t *value)
{
    const cgt_spu_channels *const c = l->channels;
    cgt_channel_status status;
    if (own_channel(l->spu, kind, channel, value, &status))
        return status;
    if (!c)
        return CGT_CHANNEL_ERROR;
    cgt_spu_leave_arithmetic(l->host);
    if (kind == ACCESS_COUNT)
        *value = c->count(c->user, channel, cycle);
    else
        status =
            kind == ACCESS_READ ? c->read(c->user, channel, cycle, value) : c->write(c->user, channel, cycle, *value);
    (void)cgt_spu_enter_arithmetic();
    return status;
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
    cgt_spu_issue_hint(timing, &issue, (pc + (uint32_t)d->branch) & ADDRESS, (target)&ADDRESS, instructions)

#define LINK ((pc + 4) & ADDRESS)
#define GO(target) next = (target)&ADDRESS
#define GO_IF(condition, target)                                                                                       \
    if (condition)                                                                                                     \
    GO(target)
/* to an address in a register; the hardware would drop the bits that make it an error here */
#define JUMP_IF(condition, target)                                                                                     \
    if (condition) {                                                                                                   \
        next = (target);                                                                                               \
        if (next & ~ADDRESS)                                                                                           \
            goto bad_jump;                                                                                             \
        if (d->rb & CGT_SPU_FEATURE_DISABLE)                                                                           \
            spu->interrupts = false;                                                                                   \
        if (d->rb & CGT_SPU_FEATURE_ENABLE)                                                                            \
            spu->interrupts = true;                                                                                    \
    }
#define CALL_IF_EVENT(target)                                                                                          \
    const uint32_t to = (target);                                                                                      \
    uint32_t events = 0;                                                                                               \
    if (use_channel(&l, ACCESS_COUNT, CHANNEL_EVENTS, at, &events) != CGT_CHANNEL_DONE)                                \
        goto bad_channel;                                                                                              \
    JUMP_IF(events, to)                                                                                                \
    PUT_FIRST(LINK)

#define STOP(code)                                                                                                     \
    end = (cgt_spu_end){CGT_SPU_STOPPED, code};                                                                        \
    goto ended
#define HALT_IF(condition)                                                                                             \
    if (condition) {                                                                                                   \
        end = (cgt_spu_end){CGT_SPU_HALTED, 0};                                                                        \
        goto ended;                                                                                                    \
    }

#define READ_CHANNEL PUT_FIRST(value)
#define COUNT_CHANNEL PUT_FIRST(value)
#define WRITE_CHANNEL (void)0

/* ---- the loop ---- */

static inline bool is_access(unsigned op, access *kind)
{
    *kind = op == cgt_spu_op_rdch ? ACCESS_READ : op == cgt_spu_op_wrch ? ACCESS_WRITE : ACCESS_COUNT;
    return op == cgt_spu_op_rdch || op == cgt_spu_op_wrch || op == cgt_spu_op_rchcnt;
}

#define LEAVE(reason, value)                                                                                           \
    do {                                                                                                               \
        end = (cgt_spu_end){reason, value};                                                                            \
        goto leave;                                                                                                    \
    } while (0)

static inline __attribute__((always_inline)) cgt_spu_end run(loop l, uint64_t until, const bool timed)
{
    cgt_spu *const spu = l.spu;
    cgt_spu_timing *const timing = spu->timing;
    cgt_spu_register *const reg = spu->reg;
    uint32_t pc = spu->pc, next = pc, value = 0;
    uint64_t cycle = spu->cycle, instructions = spu->instructions;
    cgt_spu_end end;
    for (;; pc = next) {
        const cgt_spu_decoded *const d = &spu->decoded[pc / 4];
        if (__builtin_expect(d->op <= CGT_SPU_OP_END, 0)) {
            if (d->op == CGT_SPU_OP_UNDECODED)
                cgt_spu_decode(spu, pc);
            if (d->op == CGT_SPU_OP_UNDEFINED)
                end = fail(spu, pc, "there is no such instruction");
            if (d->op == CGT_SPU_OP_END)
                end = fail(spu, pc, "the program runs off the end of the local store");
            if (d->op <= CGT_SPU_OP_END)
                goto leave;
        }
        /* when it issues */
        cgt_spu_issue issue = {.cycle = cycle};
        if (timed)
            issue = cgt_spu_issue_find(timing, d, pc, cycle, instructions);
        if (__builtin_expect(issue.cycle >= until, 0)) {
            if (timed && cycle < until) {
                cgt_spu_issue_wait(timing, &issue, cycle, until);
                cycle = until;
            }
            LEAVE(CGT_SPU_CYCLES, 0);
        }
        const uint64_t at = issue.cycle;
        access kind;
        if (__builtin_expect(is_access(d->op, &kind), 0)) {
            spu->pc = pc;
            spu->cycle = at;
            value = kind == ACCESS_WRITE ? reg[d->rt].word[0] : 0;
            const cgt_channel_status status = use_channel(&l, kind, d->ra, at, &value);
            if (status == CGT_CHANNEL_ERROR)
                goto bad_channel;
            if (status == CGT_CHANNEL_STALL) {
                if (timed && at > cycle) {
                    cgt_spu_issue_wait(timing, &issue, cycle, at);
                    cycle = at;
                }
                LEAVE(CGT_SPU_STALLED, d->ra);
            }
        }
        cycle = timed ? cgt_spu_issue_commit(timing, d, pc, cycle, &issue) : cycle + 1;
        instructions++;
        next = pc + 4;
        /* what it does */
        cgt_spu_register *const rt = &reg[d->rt];
        const cgt_spu_register *const ra = &reg[d->ra], *const rb = &reg[d->rb], *const rc = &reg[d->rc];
        const int32_t imm = d->imm;
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
        if (timed && __builtin_expect(next != pc + 4 || issue.hinted, 0))
            cycle = cgt_spu_issue_resolve(timing, &issue, pc, next, cycle);
        (void)rc;
    }
bad_jump:
    end = fail(spu, pc, bad_address(next));
    goto leave;
bad_channel:
    end = fail(spu, pc, l.channels ? "the channel does not allow it" : "there are no channels");
    goto leave;
ended:
    pc = next;
leave:
    spu->pc = pc;
    spu->cycle = cycle;
    spu->instructions = instructions;
    return end;
}

cgt_spu_end CGT_SPU_JOIN(cgt_spu_execute, CGT_VARIANT)(cgt_spu *spu, const cgt_spu_channels *channels,
                                                       uint64_t until_cycle)
{
    const loop l = {spu, channels, cgt_spu_enter_arithmetic()};
    const cgt_spu_end end = spu->timing ? run(l, until_cycle, true) : run(l, until_cycle, false);
    cgt_spu_leave_arithmetic(l.host);
    return end;
}
