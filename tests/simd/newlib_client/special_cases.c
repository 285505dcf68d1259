/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The headers' promises at single points. Floats are given as bits, as the SPU's know no infinities and no NaN.
 *
 * Promises that the sources do not keep on any machine are not here: acoshd2 of an infinity or NaN and atanhd2(1) go
 * through log2d2, which takes infinities and zero for ordinary numbers; tgammad2 compares x with the truncated |x| when
 * it looks for negative integers, and has no case for zero. */
#include <spu_intrinsics.h>

#include "headers/acosd2.h"
#include "headers/acoshd2.h"
#include "headers/acoshf4.h"
#include "headers/asind2.h"
#include "headers/asinhd2.h"
#include "headers/asinhf4.h"
#include "headers/divd2.h"
#include "headers/divf4.h"
#include "headers/erfcd2.h"
#include "headers/erfd2.h"
#include "headers/hypotd2.h"
#include "headers/lgammad2.h"
#include "headers/recipf4.h"
#include "headers/sqrtf4.h"
#include "headers/tanhd2.h"
#include "headers/tanhf4.h"
#include "headers/tgammad2.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "simd/newlib_client/client.h"

/* ---- floats, in the SPU's arithmetic ---- */

typedef vec_float4 (*float_function)(vec_float4 x, vec_float4 y);

#define OF_X(name)                                                                                                     \
    static vec_float4 call_##name(vec_float4 x, vec_float4 y)                                                          \
    {                                                                                                                  \
        (void)y;                                                                                                       \
        return _##name(x);                                                                                             \
    }
OF_X(acoshf4)
OF_X(asinhf4)
OF_X(recipf4)
OF_X(sqrtf4)
OF_X(tanhf4)
#undef OF_X
static vec_float4 call_divf4(vec_float4 x, vec_float4 y) { return _divf4(x, y); }

static const struct {
    const char *name;
    float_function call;
    uint32_t x, y, want;
} float_cases[] = {
    /* "underflow and overflow results are clamped to Smin and Smax", "a quotient of correctly signed Smax", "resulting
     * denorm quotients will be coerced to +0" */
    {"divf4(1, 0)", call_divf4, 0x3f800000, 0, 0x7fffffff},
    {"divf4(-1, 0)", call_divf4, 0xbf800000, 0, 0xffffffff},
    {"divf4(1, denormal)", call_divf4, 0x3f800000, 0x007fffff, 0x7fffffff},
    {"divf4(2^127, 2^-127)", call_divf4, 0x7f000000, 0x00800000, 0x7fffffff},
    {"divf4(2^-126, 2^2)", call_divf4, 0x00800000, 0x40800000, 0},
    {"divf4(2^128, 2^127)", call_divf4, 0x7f800000, 0x7f000000, 0x40000000}, /* "the extended range" */
    {"divf4(6, 3)", call_divf4, 0x40c00000, 0x40400000, 0x40000000},
    {"recipf4(0)", call_recipf4, 0, 0, 0x7fffffff},
    {"recipf4(3)", call_recipf4, 0x40400000, 0, 0x3eaaaaaa},
    {"recipf4(2^128)", call_recipf4, 0x7f800000, 0, 0},
    {"sqrtf4(4)", call_sqrtf4, 0x40800000, 0, 0x40000000},
    {"sqrtf4(2^128)", call_sqrtf4, 0x7f800000, 0, 0x5f800000},
    {"sqrtf4(-4)", call_sqrtf4, 0xc0800000, 0, 0}, /* "the input is negative, then set the result to zero" */
    {"acoshf4(1)", call_acoshf4, 0x3f800000, 0, 0},
    {"asinhf4(+0)", call_asinhf4, 0, 0, 0},
    {"asinhf4(-0)", call_asinhf4, 0x80000000, 0, 0x80000000},
    {"tanhf4(+0)", call_tanhf4, 0, 0, 0},
    {"tanhf4(-0)", call_tanhf4, 0x80000000, 0, 0x80000000},
};

static __attribute__((noinline)) vec_uint4 call_float(float_function call, vec_uint4 x, vec_uint4 y)
{
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    const vec_uint4 got = (vec_uint4)call((vec_float4)x, (vec_float4)y);
    cgt_spu_leave_arithmetic(saved);
    return got;
}

/* exponent 0 is zero for any fraction: corrections by an ulp leave one there */
static bool same_float(uint32_t got, uint32_t want)
{
    return got == want || ((want & 0x7fffffff) == 0 && (got & 0xff800000) == want);
}

static unsigned check_floats(void)
{
    unsigned bad = 0;
    for (size_t i = 0; i < sizeof float_cases / sizeof float_cases[0]; i++) {
        const uint32_t x = float_cases[i].x, y = float_cases[i].y, want = float_cases[i].want;
        /* the neighbours have other operands, so that a word that mixes elements is detected */
        const vec_uint4 got = call_float(float_cases[i].call, (vec_uint4){0x40a00000, x, 0x3f000000, x},
                                         (vec_uint4){0x3f800000, y, 0x40000000, y});
        if (!same_float(got[1], want) || !same_float(got[3], want)) {
            printf("BAD  %s: %08x, %08x for %08x\n", float_cases[i].name, got[1], got[3], want);
            bad++;
        }
    }
    return bad;
}

/* ---- doubles ---- */

typedef vec_double2 (*double_function)(vec_double2 x, vec_double2 y);

#define OF_X(name)                                                                                                     \
    static vec_double2 call_##name(vec_double2 x, vec_double2 y)                                                       \
    {                                                                                                                  \
        (void)y;                                                                                                       \
        return _##name(x);                                                                                             \
    }
OF_X(acosd2)
OF_X(acoshd2)
OF_X(asind2)
OF_X(asinhd2)
OF_X(erfcd2)
OF_X(erfd2)
OF_X(lgammad2)
OF_X(tanhd2)
OF_X(tgammad2)
#undef OF_X
static vec_double2 call_divd2(vec_double2 x, vec_double2 y) { return _divd2(x, y); }
static vec_double2 call_hypotd2(vec_double2 x, vec_double2 y) { return _hypotd2(x, y); }

static const struct {
    const char *name;
    double_function call;
    double x, y, want;
} double_cases[] = {
    {"acosd2(2)", call_acosd2, 2, 0, NAN},
    {"asind2(-2)", call_asind2, -2, 0, NAN},
    {"acoshd2(1)", call_acoshd2, 1, 0, 0},
    {"acoshd2(0.5)", call_acoshd2, 0.5, 0, NAN},
    {"asinhd2(+0)", call_asinhd2, 0, 0, 0},
    {"asinhd2(-0)", call_asinhd2, -0.0, 0, -0.0},
    {"asinhd2(inf)", call_asinhd2, INFINITY, 0, INFINITY},
    {"asinhd2(-inf)", call_asinhd2, -INFINITY, 0, -INFINITY},
    {"asinhd2(NaN)", call_asinhd2, NAN, 0, NAN},
    /* "handles Inf or NaN operands and results correctly" */
    {"divd2(1, 0)", call_divd2, 1, 0, INFINITY},
    {"divd2(-1, 0)", call_divd2, -1, 0, -INFINITY},
    {"divd2(0, 0)", call_divd2, 0, 0, NAN},
    {"divd2(1, inf)", call_divd2, 1, INFINITY, 0},
    {"divd2(inf, inf)", call_divd2, INFINITY, INFINITY, NAN},
    {"divd2(NaN, 1)", call_divd2, NAN, 1, NAN},
    {"divd2(1e300, 1e-300)", call_divd2, 1e300, 1e-300, INFINITY},
    {"erfd2(+0)", call_erfd2, 0, 0, 0},
    {"erfd2(-0)", call_erfd2, -0.0, 0, -0.0},
    {"erfd2(inf)", call_erfd2, INFINITY, 0, 1},
    {"erfd2(-inf)", call_erfd2, -INFINITY, 0, -1},
    {"erfd2(NaN)", call_erfd2, NAN, 0, NAN},
    {"erfcd2(+0)", call_erfcd2, 0, 0, 1},
    {"erfcd2(inf)", call_erfcd2, INFINITY, 0, 0},
    {"erfcd2(-inf)", call_erfcd2, -INFINITY, 0, 2},
    {"erfcd2(NaN)", call_erfcd2, NAN, 0, NAN},
    {"hypotd2(-3, 0)", call_hypotd2, -3, 0, 3},
    {"hypotd2(-inf, NaN)", call_hypotd2, -INFINITY, NAN, INFINITY},
    {"lgammad2(1)", call_lgammad2, 1, 0, 0},
    {"lgammad2(2)", call_lgammad2, 2, 0, 0},
    {"lgammad2(0)", call_lgammad2, 0, 0, INFINITY},
    {"lgammad2(-3)", call_lgammad2, -3, 0, INFINITY},
    {"lgammad2(inf)", call_lgammad2, INFINITY, 0, INFINITY},
    {"lgammad2(NaN)", call_lgammad2, NAN, 0, NAN},
    {"tanhd2(+0)", call_tanhd2, 0, 0, 0},
    {"tanhd2(-0)", call_tanhd2, -0.0, 0, -0.0},
    {"tanhd2(inf)", call_tanhd2, INFINITY, 0, 1},
    {"tanhd2(-inf)", call_tanhd2, -INFINITY, 0, -1},
    {"tgammad2(-inf)", call_tgammad2, -INFINITY, 0, NAN},
    {"tgammad2(inf)", call_tgammad2, INFINITY, 0, INFINITY},
};

static bool same(double got, double want)
{
    return isnan(want) ? isnan(got) : got == want && !signbit(got) == !signbit(want);
}

static __attribute__((noinline)) vec_double2 call_double(double_function call, vec_double2 x, vec_double2 y)
{
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    const vec_double2 got = call(x, y);
    cgt_spu_leave_arithmetic(saved);
    return got;
}

static unsigned check_doubles(void)
{
    unsigned bad = 0;
    for (size_t i = 0; i < sizeof double_cases / sizeof double_cases[0]; i++) {
        const double x = double_cases[i].x, y = double_cases[i].y, want = double_cases[i].want;
        const double first = call_double(double_cases[i].call, (vec_double2){x, 1.5}, (vec_double2){y, 0.75})[0];
        const double second = call_double(double_cases[i].call, (vec_double2){1.5, x}, (vec_double2){0.75, y})[1];
        if (!same(first, want) || !same(second, want)) {
            printf("BAD  %s: %g, %g for %g\n", double_cases[i].name, first, second, want);
            bad++;
        }
    }
    return bad;
}

unsigned client_check_special_cases(void)
{
    unsigned bad = 0;
#if defined(CGT_SPU_EXACT)
    bad += check_floats();
#else
    (void)check_floats;
#endif
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ || defined(CLIENT_CASTS_DONE)
    bad += check_doubles();
#else
    (void)check_doubles;
#endif
    return bad;
}
