/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The functions of four floats: their loops, their truth and their bounds. */
#include <spu_intrinsics.h> /* first, as on an SPU: some headers use its keyword before they include it */

#include "headers/acosf4.h"
#include "headers/acoshf4.h"
#include "headers/asinf4.h"
#include "headers/asinhf4.h"
#include "headers/atan2f4.h"
#include "headers/atanf4.h"
#include "headers/atanhf4.h"
#include "headers/cosf4.h"
#include "headers/coshf4.h"
#include "headers/divf4.h"
#include "headers/erfcf4.h"
#include "headers/erff4.h"
#include "headers/exp2f4.h"
#include "headers/expf4.h"
#include "headers/expm1f4.h"
#include "headers/floorf4.h"
#include "headers/hypotf4.h"
#include "headers/isnanf4.h"
#include "headers/ldexpf4.h"
#include "headers/lgammaf4.h"
#include "headers/log1pf4.h"
#include "headers/log2f4.h"
#include "headers/logbf4.h"
#include "headers/logf4.h"
#include "headers/nearbyintf4.h"
#include "headers/nextafterf4.h"
#include "headers/powf4.h"
#include "headers/recipf4.h"
#include "headers/rintf4.h"
#include "headers/scalbnf4.h"
#include "headers/sincosf4.h"
#include "headers/sinf4.h"
#include "headers/sinhf4.h"
#include "headers/sqrtf4.h"
#include "headers/tanf4.h"
#include "headers/tanhf4.h"
#include "headers/tgammaf4.h"
#include "headers/truncf4.h"

#define CLIENT_FLOATS vec_float4
#define CLIENT_INTS vec_int4
#define CLIENT_MASKS vec_uint4
#include "simd/newlib_client/functions.h"

static inline vec_float4 sine(vec_float4 x)
{
    vec_float4 s, c;
    _sincosf4(x, &s, &c);
    return s;
}

static inline vec_float4 cosine(vec_float4 x)
{
    vec_float4 s, c;
    _sincosf4(x, &s, &c);
    return c;
}

OF_X(acosf4, acosl(x))
OF_X(acoshf4, acoshl(x))
OF_X(asinf4, asinl(x))
OF_X(asinhf4, asinhl(x))
OF_X_Y(atan2f4, atan2l(x, y))
OF_X(atanf4, atanl(x))
OF_X(atanhf4, atanhl(x))
OF_X(cosf4, cosl(x))
OF_X(coshf4, coshl(x))
OF_X_Y(divf4, x / y)
OF_X(erfcf4, erfcl(x))
OF_X(erff4, erfl(x))
OF_X(exp2f4, exp2l(x))
OF_X(expf4, expl(x))
OF_X(expm1f4, expm1l(x))
OF_X(floorf4, floorl(x))
OF_X_Y(hypotf4, hypotl(x, y))
MASK_OF_X(isnanf4, 0)
OF_X_N(ldexpf4, ldexpl(x, (int)y))
OF_X(lgammaf4, lgammal(x))
OF_X(log1pf4, log1pl(x))
OF_X(log2f4, log2l(x))
OF_X(logbf4, logbl(x))
OF_X(logf4, logl(x))
OF_X(nearbyintf4, truncl(x))
OF_X_Y(nextafterf4, nextafterf((float)x, (float)y))
OF_X_Y(powf4, powl(x, y))
OF_X(recipf4, 1 / x)
OF_X(rintf4, truncl(x))
OF_X_N(scalbnf4, ldexpl(x, (int)y))
FUNCTION(sincosf4_sin, vec_float4, sine(x[i]), sinl(x))
FUNCTION(sincosf4_cos, vec_float4, cosine(x[i]), cosl(x))
OF_X(sinf4, sinl(x))
OF_X(sinhf4, sinhl(x))
OF_X(sqrtf4, sqrtl(x))
OF_X(tanf4, tanl(x))
OF_X(tanhf4, tanhl(x))
OF_X(tgammaf4, tgammal(x))
OF_X(truncf4, truncl(x))

/* ---- bounds: exact, fused IEEE, unfused IEEE ---- */

/* clang-format off */
static const client_function functions[] = {
    {F(acosf4), {EVEN, -1, 1}, NO_Y, 0, 1.7, 1.5, 1.4, 0, ""},
    {F(acoshf4), {LOG, 1, 1e+18}, NO_Y, 0, 4.1, 5.9, 6.1, 0, ""},
    {F(asinf4), {EVEN, -1, 1}, NO_Y, 0, 4.1, 3.5, 4.1, 0, ""},
    {F(asinhf4), {SIGNED_LOG, 1e-18, 1e+18}, NO_Y, 0, 4.6, 8, 7.9, 0, ""},
    {F(atan2f4), {SIGNED_LOG, 1e-06, 1000000}, {SIGNED_LOG, 1e-06, 1000000}, 0, 5.6, 5, 6.2, 0, ""},
    {F(atanf4), {SIGNED_LOG, 1e-18, 1e+18}, NO_Y, 0, 4, 3.9, 3.7, 0, ""},
    {F(atanhf4), {EVEN, -0.999, 0.999}, NO_Y, 0, 8.4, 9.4, 9.4, 0, ""},
    {F(cosf4), {EVEN, -100, 100}, NO_Y, 1, 2.4, 1.2, 1.3, 0, "\"to an accuracy of single precision\", no number"},
    {F(coshf4), {EVEN, -87, 87}, NO_Y, 0, 3.7, 3.1, 3.6, 0, "\"to an accuracy of single precision\", no number"},
    {F(divf4), {LOG, 1e-18, 1e+18}, {SIGNED_LOG, 1e-18, 1e+18}, 0, 1, 3, 3.6, CLIENT_TRUNCATED,
     "\"truncated toward zero\". IEEE: a quotient that rounds up to a power of two comes out as that of two, seldom"},
    {NAMED("divf4, x < 0", divf4), {LOG, -1e+18, -1e-18}, {SIGNED_LOG, 1e-18, 1e+18}, 0, 2, 3, 3.6, 0,
     "the correction by the remainder takes no account of the dividend's sign"},
    {F(erfcf4), {EVEN, -4, 9}, NO_Y, 0, 200, 110, 100, CLIENT_CASTS,
     "no number; loses relative precision in the tail, where it falls to 1e-36"},
    {F(erff4), {EVEN, -5, 5}, NO_Y, 0, 4.3, 6.3, 6.3, CLIENT_CASTS, ""},
    {F(exp2f4), {EVEN, -125, 126}, NO_Y, 0, 3.4, 2.5, 2.9, 0, ""},
    {NAMED("exp2f4, x > 126", exp2f4), {EVEN, 126, 127.99}, NO_Y, 0, 3.4, 0, 0, CLIENT_SPU_ONLY,
     "goes through 2^128, an infinity in IEEE arithmetic"},
    {F(expf4), {EVEN, -86, 88}, NO_Y, 0, 2.2, 1.6, 1.5, 0, ""},
    {F(expm1f4), {EVEN, -20, 88}, NO_Y, 0, 5.5, 5.2, 5.2, 0,
     "\"accurate values, even where exp(x) - 1 would produce bad results\""},
    {F(floorf4), {SIGNED_LOG, 0.001, 10000000000}, NO_Y, 0, 0, 0, 0, 0, "\"rounds downwards to the nearest integer\""},
    {F(hypotf4), {SIGNED_LOG, 1e-18, 1e+18}, {SIGNED_LOG, 1e-18, 1e+18}, 0, 2.7, 2.1, 2.5, 0, ""},
    {F(isnanf4), {SIGNED_LOG, 1e-37, 1e+37}, NO_Y, 0, 0, 0, 0, CLIENT_MASK, "\"always returns 0\""},
    {F(ldexpf4), {SIGNED_LOG, 1e-10, 10000000000}, {INTEGERS, -80, 80}, 0, 0, 0, 0, 0, "\"multiplied by 2^exp\""},
    {F(lgammaf4), {EVEN, 0.01, 100}, NO_Y, 1, 7.6, 14, 14, CLIENT_CASTS, ""},
    {F(log1pf4), {EVEN, -0.99, 100}, NO_Y, 0, 9.2, 6.3, 6.3, 0, ""},
    {F(log2f4), {LOG, 1e-37, 1e+37}, NO_Y, 1, 3.6, 2.6, 3.3, 0, "a polynomial in x - 1: absolute precision around 1"},
    {F(logbf4), {SIGNED_LOG, 1e-37, 1e+37}, NO_Y, 0, 0, 0, 0, 0, "\"the exponent\""},
    {F(logf4), {LOG, 1e-37, 1e+37}, NO_Y, 1, 4.5, 2.8, 3, 0, "log2f4 times a constant"},
    {F(nearbyintf4), {SIGNED_LOG, 0.001, 10000000000}, NO_Y, 0, 0, 0, 0, 0, "\"aliased to truncf4\""},
    {F(nextafterf4), {SIGNED_LOG, 1e-37, 1e+37}, {SIGNED_LOG, 1e-37, 1e+37}, 0, 0, 0, 0, 0,
     "\"the next representable number\""},
    {F(powf4), {LOG, 0.001, 1000}, {EVEN, -10, 10}, 0, 300, 150, 150, 0,
     "\"2^(y*log2(x))\": the error of the exponent, up to 100, is that of the result"},
    {F(recipf4), {SIGNED_LOG, 1e-37, 1e+37}, NO_Y, 0, 1, 1.5, 2.3, CLIENT_TRUNCATED, "\"truncated toward zero\""},
    {F(rintf4), {SIGNED_LOG, 0.001, 10000000000}, NO_Y, 0, 0, 0, 0, 0, "\"aliased to truncf4\""},
    {F(scalbnf4), {SIGNED_LOG, 1e-10, 10000000000}, {INTEGERS, -80, 80}, 0, 0, 0, 0, 0, "\"multiplied by 2^n\""},
    {F(sincosf4_sin), {EVEN, -100, 100}, NO_Y, 1, 2.4, 1.3, 1.4, 0,
     "\"to an accuracy of single precision\", no number"},
    {F(sincosf4_cos), {EVEN, -100, 100}, NO_Y, 1, 2.4, 1.2, 1.4, 0,
     "\"to an accuracy of single precision\", no number"},
    {F(sinf4), {EVEN, -100, 100}, NO_Y, 1, 2.4, 1.2, 1.4, 0, "\"to an accuracy of single precision\", no number"},
    {F(sinhf4), {EVEN, -87, 87}, NO_Y, 0, 4.5, 3.3, 3.9, 0, "\"to an accuracy of single precision\", no number"},
    {F(sqrtf4), {LOG, 1e-37, 1e+37}, NO_Y, 0, 1, 2, 2.2, CLIENT_TRUNCATED,
     "\"complete accuracy\", corrected by whole ulp as truncation asks"},
    {F(tanf4), {EVEN, -1.5, 1.5}, NO_Y, 1, 5.9, 5.6, 5.1, 0, "\"to an accuracy of single precision\", no number"},
    {F(tanhf4), {EVEN, -7, 7}, NO_Y, 0, 4.2, 3.4, 3.7, 0, ""},
    {NAMED("tanhf4, |x| to 20", tanhf4), {EVEN, -20, 20}, NO_Y, 0, 4.2, 0, 0, CLIENT_SPU_ONLY,
     "divf4 at quotients next to 1: see there"},
    {F(tgammaf4), {EVEN, 0.01, 26}, NO_Y, 0, 390, 210, 210, 0,
     "through powf4, whose range x^(x - 1/2) leaves beyond 26"},
    {F(truncf4), {SIGNED_LOG, 0.001, 10000000000}, NO_Y, 0, 0, 0, 0, 0, "\"truncates towards zero\""},
};
/* clang-format on */

const client_table client_float_table = {functions, sizeof functions / sizeof functions[0], 4};
