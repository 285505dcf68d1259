/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's doubles, which the simulator computes in integers, against the host's own, in all four rounding modes, with
 * the flags that they raise. What the SPU does otherwise than IEEE is put around the host's operation: denormal
 * operands are zeros, one NaN, results negated behind the rounding. */
#include "support/test.h"
#include "support/suite.h"

#include <fenv.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cell/spu/execute/double.h"
#include "cell/spu/isa/assemble.h"
#include "core/memory.h"

enum { CASES = 60000 };
#define SIGN 0x8000000000000000u
#define ONLY_NAN 0x7ff8000000000000u

static const int host_modes[4] = {FE_TONEAREST, FE_TOWARDZERO, FE_UPWARD, FE_DOWNWARD};

static uint64_t bits_of(double a)
{
    uint64_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}
static double number_of(uint64_t bits)
{
    double a;
    memcpy(&a, &bits, sizeof a);
    return a;
}

static uint64_t random_double(test_random *r)
{
    static const uint64_t edges[] = {0,
                                     SIGN,
                                     1,
                                     0x000fffffffffffffu,
                                     0x0010000000000000u,
                                     0x8010000000000001u,
                                     0x7fefffffffffffffu,
                                     0xffefffffffffffffu,
                                     0x7ff0000000000000u,
                                     0xfff0000000000000u,
                                     0x7ff8000000000001u,
                                     0x7ff0000000000001u,
                                     0x3ff0000000000000u,
                                     0xbff0000000000000u,
                                     0x3ff0000000000001u,
                                     0x3fefffffffffffffu,
                                     0x47efffffffffffffu, /* beyond the largest float */
                                     0x47efffffe0000000u, /* the largest float */
                                     0x3810000000000000u, /* the least normal float */
                                     0x380fffffffffffffu,
                                     0x36a0000000000000u /* the least denormal float */};
    const uint64_t bits = random_bits(r);
    switch (random_below(r, 5)) {
    case 0: return edges[random_below(r, TEST_COUNT(edges))];
    case 1: return (bits & 0x800fffffffffffffu) | (uint64_t)(960 + random_below(r, 128)) << 52; /* near 1 */
    case 2: return (bits & 0x800f000000000000u) | (uint64_t)(1000 + random_below(r, 48)) << 52; /* many ties */
    case 3: return (bits & 0x800fffffffffffffu) | (uint64_t)(1 + random_below(r, 60)) << 52;    /* tiny */
    default: return bits;
    }
}

/* ---- what is expected ---- */

static bool is_denormal(uint64_t a) { return !(a << 1 >> 53) && a << 1; }
static bool is_nan(uint64_t a) { return a << 1 > 0xffe0000000000000u; }
static bool is_signalling(uint64_t a) { return is_nan(a) && !(a >> 51 & 1); }

typedef struct expectation {
    uint64_t result;
    uint32_t flags;
    bool underflow_unclear; /* the host tells by the rounded result whether it is tiny */
} expectation;

static uint32_t host_flags(void)
{
    uint32_t flags = 0;
    flags |= fetestexcept(FE_OVERFLOW) ? CGT_SPU_DOUBLE_OVERFLOW : 0;
    flags |= fetestexcept(FE_UNDERFLOW) ? CGT_SPU_DOUBLE_UNDERFLOW : 0;
    flags |= fetestexcept(FE_INEXACT) ? CGT_SPU_DOUBLE_INEXACT : 0;
    flags |= fetestexcept(FE_INVALID) ? CGT_SPU_DOUBLE_INVALID : 0;
    return flags;
}

/* The sum is that of the name's operation: 'a' a + b, 's' a - b, 'm' a * b, 'f' a * b + c. */
static expectation expect(char operation, uint64_t a, uint64_t b, uint64_t c, int mode)
{
    expectation e = {0};
    uint64_t *const operands[3] = {&a, &b, &c};
    const bool product_is_bad = operation == 'f' && ((a << 1 == 0xffe0000000000000u && (!(b << 1) || is_denormal(b))) ||
                                                     (b << 1 == 0xffe0000000000000u && (!(a << 1) || is_denormal(a))));
    for (int i = 0; i < (operation == 'f' ? 3 : 2); i++) {
        if (is_denormal(*operands[i])) {
            e.flags |= CGT_SPU_DOUBLE_DENORMAL;
            *operands[i] &= SIGN;
        }
        if (is_nan(*operands[i]))
            e.flags |= CGT_SPU_DOUBLE_NAN | (is_signalling(*operands[i]) ? CGT_SPU_DOUBLE_INVALID : 0);
    }
    if (e.flags & CGT_SPU_DOUBLE_NAN) {
        e.flags |= product_is_bad ? CGT_SPU_DOUBLE_INVALID : 0;
        e.result = ONLY_NAN;
        return e;
    }
    const volatile double x = number_of(a), y = number_of(b), z = number_of(c);
    volatile double result = 0;
    fesetround(host_modes[mode]);
    feclearexcept(FE_ALL_EXCEPT);
    switch (operation) {
    case 'a': result = x + y; break;
    case 's': result = x - y; break;
    case 'm': result = x * y; break;
    default: result = fma(x, y, z); break;
    }
    const uint32_t raised = host_flags();
    fesetround(FE_TONEAREST);
    e.flags |= raised;
    e.result = raised & CGT_SPU_DOUBLE_INVALID ? ONLY_NAN : bits_of(result);
    e.underflow_unclear = (e.result & ~SIGN) == 0x0010000000000000u;
    return e;
}

/* ---- the instruction ---- */

static void run_one(cgt_spu *spu, cgt_spu_op op)
{
    uint32_t word[4];
    cgt_spu_assembler p = {.word = word, .capacity = 4};
    CGT_SPU_ASM(&p, fscrwr, .ra = 7);
    cgt_spu_emit(&p, op,
                 (cgt_spu_operands){.rt = 3, .ra = 4, .rb = op == cgt_spu_op_fesd || op == cgt_spu_op_frds ? 0 : 5});
    CGT_SPU_ASM(&p, fscrrd, .rt = 8);
    CGT_SPU_ASM(&p, stop, .imm = 1);
    assert_true(cgt_spu_assembler_load(&p, spu));
    assert_int_equal(cgt_spu_run(spu, NULL, UINT64_MAX).reason, CGT_SPU_STOPPED);
}

static void set(cgt_spu_register *r, int half, uint64_t a)
{
    r->word[2 * half] = (uint32_t)(a >> 32);
    r->word[2 * half + 1] = (uint32_t)a;
}
static uint64_t get(const cgt_spu_register *r, int half)
{
    return (uint64_t)r->word[2 * half] << 32 | r->word[2 * half + 1];
}

static void compare(const char *name, const cgt_spu *spu, int half, const expectation *e, uint64_t a, uint64_t b,
                    uint64_t c, int mode)
{
    const uint64_t result = get(&spu->reg[3], half);
    const uint32_t ignored = e->underflow_unclear ? CGT_SPU_DOUBLE_UNDERFLOW : 0;
    const uint32_t flags = spu->reg[8].word[1 + half];
    if (result != e->result || (flags & ~ignored) != (e->flags & ~ignored))
        fail_msg("%s of %016llx %016llx %016llx, mode %d: %016llx, flags %04x, instead of %016llx, flags %04x", name,
                 (unsigned long long)a, (unsigned long long)b, (unsigned long long)c, mode, (unsigned long long)result,
                 (unsigned)flags, (unsigned long long)e->result, (unsigned)e->flags);
}

typedef struct kind {
    cgt_spu_op op;
    char operation;
    bool subtracts, negates;
} kind;

TEST(arithmetic)
{
    static const kind kinds[] = {{cgt_spu_op_dfa, 'a', false, false}, {cgt_spu_op_dfs, 's', false, false},
                                 {cgt_spu_op_dfm, 'm', false, false}, {cgt_spu_op_dfma, 'f', false, false},
                                 {cgt_spu_op_dfms, 'f', true, false}, {cgt_spu_op_dfnms, 'f', true, true},
                                 {cgt_spu_op_dfnma, 'f', false, true}};
    cgt_spu *const spu = *state;
    test_random r = random_make(292);
    for (uint32_t n = test_scaled(CASES); n > 0; n--) {
        const kind *const k = &kinds[random_below(&r, TEST_COUNT(kinds))];
        uint64_t a[2], b[2], c[2];
        int mode[2];
        for (int half = 0; half < 2; half++) {
            mode[half] = (int)random_below(&r, 4);
            a[half] = random_double(&r);
            b[half] = random_double(&r);
            c[half] = random_double(&r);
            if (k->operation == 'f' && random_below(&r, 3) == 0) /* a sum that almost cancels */
                c[half] = bits_of(-number_of(a[half]) * number_of(b[half])) + random_below(&r, 3) - 1;
            set(&spu->reg[4], half, a[half]);
            set(&spu->reg[5], half, b[half]);
            set(&spu->reg[3], half, c[half]);
        }
        spu->reg[7] = (cgt_spu_register){{(uint32_t)mode[0] << 10 | (uint32_t)mode[1] << 8, 0, 0, 0}};
        run_one(spu, k->op);
        for (int half = 0; half < 2; half++) {
            const uint64_t addend = c[half] ^ (k->subtracts ? SIGN : 0);
            expectation e = expect(k->operation, a[half], b[half], addend, mode[half]);
            if (k->negates && e.result != ONLY_NAN)
                e.result ^= SIGN;
            compare(cgt_spu_isa[k->op].name, spu, half, &e, a[half], b[half], addend, mode[half]);
        }
    }
}

TEST(from_single)
{
    cgt_spu *const spu = *state;
    test_random r = random_make(293);
    for (uint32_t n = test_scaled(CASES / 4); n > 0; n--) {
        uint32_t word[2];
        for (int half = 0; half < 2; half++) {
            word[half] = (uint32_t)random_bits(&r);
            if (random_below(&r, 4) == 0)
                word[half] &= 0x807fffff; /* a denormal */
            if (random_below(&r, 8) == 0)
                word[half] |= 0x7f800000;
            if (random_below(&r, 16) == 0)
                word[half] &= 0xff800000;
            set(&spu->reg[4], half, (uint64_t)word[half] << 32 | (uint32_t)random_bits(&r));
        }
        spu->reg[7] = (cgt_spu_register){{0, 0, 0, 0}};
        run_one(spu, cgt_spu_op_fesd);
        for (int half = 0; half < 2; half++) {
            float f;
            memcpy(&f, &word[half], sizeof f);
            expectation e = {.result = bits_of((double)f)};
            if (f != f) {
                e.result = ONLY_NAN;
                e.flags = CGT_SPU_DOUBLE_NAN | (word[half] & 0x400000 ? 0 : CGT_SPU_DOUBLE_INVALID);
            } else if (!(word[half] & 0x7f800000) && word[half] << 1) {
                e.result = (uint64_t)(word[half] >> 31) << 63;
                e.flags = CGT_SPU_DOUBLE_DENORMAL;
            }
            compare("fesd", spu, half, &e, word[half], 0, 0, 0);
        }
    }
}

static expectation expect_single(uint64_t a, int mode)
{
    expectation e = {0};
    if (is_nan(a)) {
        e.result = (uint64_t)0x7fc00000 << 32;
        e.flags = CGT_SPU_DOUBLE_NAN | (is_signalling(a) ? CGT_SPU_DOUBLE_INVALID : 0);
        return e;
    }
    if (is_denormal(a)) {
        e.flags |= CGT_SPU_DOUBLE_DENORMAL;
        a &= SIGN;
    }
    const volatile double x = number_of(a);
    fesetround(host_modes[mode]);
    feclearexcept(FE_ALL_EXCEPT);
    const volatile float f = (float)x;
    e.flags |= host_flags();
    fesetround(FE_TONEAREST);
    const float rounded = f;
    uint32_t word;
    memcpy(&word, &rounded, sizeof word);
    e.result = (uint64_t)word << 32;
    e.underflow_unclear = (word & 0x7fffffff) == 0x00800000;
    return e;
}

TEST(to_single)
{
    cgt_spu *const spu = *state;
    test_random r = random_make(294);
    for (uint32_t n = test_scaled(CASES / 4); n > 0; n--) {
        uint64_t a[2];
        int mode[2];
        for (int half = 0; half < 2; half++) {
            mode[half] = (int)random_below(&r, 4);
            a[half] = random_double(&r);
            if (random_below(&r, 2)) /* near the range of floats, and its denormals */
                a[half] = (a[half] & 0x800fffffffffffffu) | (uint64_t)(860 + random_below(&r, 300)) << 52;
            if (random_below(&r, 4) == 0)
                a[half] &= 0xfffffffff0000000u; /* ties */
            set(&spu->reg[4], half, a[half]);
        }
        spu->reg[7] = (cgt_spu_register){{(uint32_t)mode[0] << 10 | (uint32_t)mode[1] << 8, 0, 0, 0}};
        run_one(spu, cgt_spu_op_frds);
        for (int half = 0; half < 2; half++) {
            const expectation e = expect_single(a[half], mode[half]);
            compare("frds", spu, half, &e, a[half], 0, 0, mode[half]);
        }
    }
}

/* fscrwr keeps the bits that exist, and fscrrd reads them. */
TEST(status_register)
{
    cgt_spu *const spu = *state;
    memset(&spu->reg[4], 0, sizeof spu->reg[4]);
    memset(&spu->reg[5], 0, sizeof spu->reg[5]);
    spu->reg[7] = (cgt_spu_register){{UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX}};
    run_one(spu, cgt_spu_op_dfa);
    assert_int_equal(spu->reg[8].word[0], 0x0f07);
    assert_int_equal(spu->reg[8].word[1], 0x3f07);
    assert_int_equal(spu->reg[8].word[2], 0x3f07);
    assert_int_equal(spu->reg[8].word[3], 0x0f07);
}

static int set_up(void **state)
{
    static cgt_spu spu;
    const cgt_memory_hooks memory = cgt_memory_default();
    *state = &spu;
    return cgt_spu_create(&spu, &memory, CGT_SPU_UNTIMED) == CGT_OK ? 0 : -1;
}
static int tear_down(void **state)
{
    cgt_spu_destroy(*state);
    return 0;
}

SEEDED_SUITE("test_spu_double", set_up, tear_down)
