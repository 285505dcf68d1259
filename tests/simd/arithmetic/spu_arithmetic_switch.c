/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The SPU's mode and the compiler: a word with constant operands is not folded, and no word is moved into or out of
 * the two calls that switch the mode. Compiled at every optimisation level, these test CGT_SPU_HOLD. */
#include "simd/arithmetic/spu_arithmetic.h"

#include <fenv.h>
#include <string.h>

/* never inlined into its caller */
#if defined(__clang__)
#define APART static __attribute__((noinline))
#else
#define APART static __attribute__((noipa))
#endif

static uint32_t bits_of(float f)
{
    uint32_t u;
    memcpy(&u, &f, sizeof u);
    return u;
}

static void expect_all(const char *what, vec_uint4 got, uint32_t expected)
{
    for (int i = 0; i < 4; i++)
        if (got[i] != expected)
            fail_msg("%s: %08x, expected %08x", what, got[i], expected);
}

/* The words get literals, not parameters of a function; they are the public header's words. */
#define F(x) spu_splats(x)
#define B(f) bits_of(f)

void constants_are_not_folded(void **state)
{
    (void)state;
    const vec_int4 i = spu_splats(INT32_MAX);
    const vec_uint4 u = spu_splats(UINT32_MAX);
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    const vec_float4 got_add = spu_add(F(1.f), F(0x1.8p-24f)), got_sub = spu_sub(F(1.f), F(0x1p-40f));
    const vec_float4 got_mul = spu_mul(F(0.1f), F(3.f)), got_tiny = spu_mul(F(0x1p-100f), F(-0x1p-40f));
    const vec_float4 got_madd = spu_madd(F(0.1f), F(3.f), F(7.f));
    const vec_float4 got_msub = spu_msub(F(0.1f), F(3.f), F(0.3f));
    const vec_float4 got_nmsub = spu_nmsub(F(0.1f), F(3.f), F(7.f));
    const vec_float4 got_large = spu_add(F(0x1.fffffep127f), F(0x1.fffffep127f));
    const vec_float4 got_zero = spu_add(F(-0.f), F(-0.f)), got_denormal = spu_add(F(0x1p-127f), F(0.f));
    const vec_uint4 got_gt = spu_cmpgt(F(0x1p-127f), F(0.f)), got_eq = spu_cmpeq(F(0x1p-127f), F(0.f));
    const vec_float4 got_int = spu_convtf(i, 0), got_unsigned = spu_convtf(u, 0);
    const vec_int4 got_convts = spu_convts(F(0x1p-127f), 127);
    const vec_uint4 got_convtu = spu_convtu(F(0x1p40f), 0);
    const vec_float4 got_re = spu_re(F(3.f)), got_root = spu_rsqrte(F(3.f));
    cgt_spu_leave_arithmetic(saved);
    expect_all("add", (vec_uint4)got_add, ONE);
    expect_all("sub", (vec_uint4)got_sub, 0x3f7fffff);
    expect_all("mul", (vec_uint4)got_mul, cgt_spu_model_mul(B(0.1f), B(3.f)));
    expect_all("mul, too small", (vec_uint4)got_tiny, 0);
    expect_all("madd", (vec_uint4)got_madd, cgt_spu_model_madd(B(0.1f), B(3.f), B(7.f)));
    expect_all("msub", (vec_uint4)got_msub, cgt_spu_model_msub(B(0.1f), B(3.f), B(0.3f)));
    expect_all("nmsub", (vec_uint4)got_nmsub, cgt_spu_model_nmsub(B(0.1f), B(3.f), B(7.f)));
    expect_all("add, too large for the host", (vec_uint4)got_large, LARGEST);
    expect_all("add of -0", (vec_uint4)got_zero, 0);
    expect_all("add of a denormal", (vec_uint4)got_denormal, 0);
    expect_all("cmpgt of a denormal", got_gt, 0);
    expect_all("cmpeq of a denormal", got_eq, UINT32_MAX);
    expect_all("convtf of int", (vec_uint4)got_int, 0x4effffff);
    expect_all("convtf of unsigned", (vec_uint4)got_unsigned, 0x4f7fffff);
    expect_all("convts of a denormal", (vec_uint4)got_convts, 0);
    expect_all("convtu", got_convtu, UINT32_MAX);
    expect_all("re", (vec_uint4)got_re, re.model(B(3.f), 0, 0, 0));
    expect_all("rsqrte", (vec_uint4)got_root, rsqrte.model(B(3.f), 0, 0, 0));
}

/* ---- around the switch ---- */

static vec_float4 product(vec_float4 a, vec_float4 b) { return cgt_spu_mul_f32(a, b); }
APART vec_float4 product_elsewhere(vec_float4 a, vec_float4 b) { return cgt_spu_mul_f32(a, b); }

/* 0.1f * 3 lies between two floats, of which the upper is nearer */
#define TRUNCATED 0x3e999999u
#define ROUNDED 0x3e99999au

/* The same product before, between and after: it may be computed once for none of them, nor moved. Outside the mode the
 * fast forms round, which shows where an operation was performed; the portable form has no mode. */
void operations_stay_on_their_side_of_the_switch(void **state)
{
    (void)state;
#if defined(CGT_SPU_EXACT_X86) || defined(CGT_SPU_EXACT_AARCH64)
    const uint32_t outside = ROUNDED;
#else
    const uint32_t outside = TRUNCATED;
#endif
    const vec_float4 a = F(0.1f), b = F(3.f);
    for (int round = 0; round < 3; round++) { /* operands that a loop does not change */
        const vec_float4 before = product(a, b);
        const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
        const vec_float4 first = product(a, b), called = product_elsewhere(a, b), last = product(a, b);
        cgt_spu_leave_arithmetic(saved);
        const vec_float4 after = product(a, b);
        expect_all("before", (vec_uint4)before, outside);
        expect_all("first", (vec_uint4)first, TRUNCATED);
        expect_all("called", (vec_uint4)called, TRUNCATED);
        expect_all("last", (vec_uint4)last, TRUNCATED);
        expect_all("after", (vec_uint4)after, outside);
    }
    vec_float4 sum = F(0.f);
    cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    for (int i = 0; i < 8; i++) {
        sum = cgt_spu_add_f32(sum, product(a, b));
        cgt_spu_leave_arithmetic(saved);
        saved = cgt_spu_enter_arithmetic();
    }
    cgt_spu_leave_arithmetic(saved);
    uint32_t expected = 0;
    for (int i = 0; i < 8; i++)
        expected = cgt_spu_model_add(expected, TRUNCATED);
    expect_all("sum", (vec_uint4)sum, expected);
}

/* The host's results for a rounded product and a denormal one. Plain arithmetic, which the compiler may move across the
 * switch: hence a separate function. */
APART uint64_t host_products(void)
{
    volatile float tenth = 0.1f, three = 3.f, tiny = 0x1p-140f;
    const float rounded = tenth * three, denormal = tiny * three;
    return (uint64_t)bits_of(rounded) << 32 | bits_of(denormal);
}

/* Nested, and with flags set inside. */
void leaving_restores_the_state(void **state)
{
    (void)state;
    const uint64_t products = host_products();
    const int rounding = fegetround();
    feclearexcept(FE_ALL_EXCEPT);
    const cgt_spu_arithmetic outer = cgt_spu_enter_arithmetic();
    const cgt_spu_arithmetic inner = cgt_spu_enter_arithmetic();
    const vec_float4 overflowed = product(F(0x1p100f), F(0x1.fffffep100f));
    cgt_spu_leave_arithmetic(inner);
    const vec_float4 between = product(F(0.1f), F(3.f));
    cgt_spu_leave_arithmetic(outer);
    const int flags = fetestexcept(FE_ALL_EXCEPT);
    expect_all("overflowed", (vec_uint4)overflowed, LARGEST);
    expect_all("between", (vec_uint4)between, TRUNCATED);
    assert_int_equal(flags, 0);
    assert_int_equal(fegetround(), rounding);
    assert_true(host_products() == products);
}
