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
    {"acosf4", run_acosf4, true_acosf4, {EVEN, -1, 1}, {NONE, 0, 0}, 0,
     1.7, 1.5, 1.4, 0,
     ""},
    {"acoshf4", run_acoshf4, true_acoshf4, {LOG, 1, 1e+18}, {NONE, 0, 0}, 0,
     4.1, 5.9, 6.1, 0,
     ""},
    {"asinf4", run_asinf4, true_asinf4, {EVEN, -1, 1}, {NONE, 0, 0}, 0,
     4.1, 3.5, 4.1, 0,
     ""},
    {"asinhf4", run_asinhf4, true_asinhf4, {SIGNED_LOG, 1e-18, 1e+18}, {NONE, 0, 0}, 0,
     4.6, 8, 7.9, 0,
     ""},
    {"atan2f4", run_atan2f4, true_atan2f4, {SIGNED_LOG, 1e-06, 1000000}, {SIGNED_LOG, 1e-06, 1000000}, 0,
     5.6, 5, 6.2, 0,
     ""},
    {"atanf4", run_atanf4, true_atanf4, {SIGNED_LOG, 1e-18, 1e+18}, {NONE, 0, 0}, 0,
     4, 3.9, 3.7, 0,
     ""},
    {"atanhf4", run_atanhf4, true_atanhf4, {EVEN, -0.999, 0.999}, {NONE, 0, 0}, 0,
     8.4, 9.4, 9.4, 0,
     ""},
    {"cosf4", run_cosf4, true_cosf4, {EVEN, -100, 100}, {NONE, 0, 0}, 1,
     2.4, 1.2, 1.3, 0,
     "\"to an accuracy of single precision\", no number"},
    {"coshf4", run_coshf4, true_coshf4, {EVEN, -87, 87}, {NONE, 0, 0}, 0,
     3.7, 3.1, 3.6, 0,
     "\"to an accuracy of single precision\", no number"},
    {"divf4", run_divf4, true_divf4, {LOG, 1e-18, 1e+18}, {SIGNED_LOG, 1e-18, 1e+18}, 0,
     1, 3, 3.6, CLIENT_TRUNCATED,
     "\"truncated toward zero\". IEEE: a quotient that rounds up to a power of two comes out as that of two, seldom"},
    {"divf4, x < 0", run_divf4, true_divf4, {LOG, -1e+18, -1e-18}, {SIGNED_LOG, 1e-18, 1e+18}, 0,
     2, 3, 3.6, 0,
     "the correction by the remainder takes no account of the dividend's sign"},
    {"erfcf4", run_erfcf4, true_erfcf4, {EVEN, -4, 9}, {NONE, 0, 0}, 0,
     200, 110, 100, CLIENT_CASTS,
     "no number; loses relative precision in the tail, where it falls to 1e-36"},
    {"erff4", run_erff4, true_erff4, {EVEN, -5, 5}, {NONE, 0, 0}, 0,
     4.3, 6.3, 6.3, CLIENT_CASTS,
     ""},
    {"exp2f4", run_exp2f4, true_exp2f4, {EVEN, -125, 126}, {NONE, 0, 0}, 0,
     3.4, 2.5, 2.9, 0,
     ""},
    {"exp2f4, x > 126", run_exp2f4, true_exp2f4, {EVEN, 126, 127.99}, {NONE, 0, 0}, 0,
     3.4, 0, 0, CLIENT_SPU_ONLY,
     "goes through 2^128, an infinity in IEEE arithmetic"},
    {"expf4", run_expf4, true_expf4, {EVEN, -86, 88}, {NONE, 0, 0}, 0,
     2.2, 1.6, 1.5, 0,
     ""},
    {"expm1f4", run_expm1f4, true_expm1f4, {EVEN, -20, 88}, {NONE, 0, 0}, 0,
     5.5, 5.2, 5.2, 0,
     "\"accurate values, even where exp(x) - 1 would produce bad results\""},
    {"floorf4", run_floorf4, true_floorf4, {SIGNED_LOG, 0.001, 10000000000}, {NONE, 0, 0}, 0,
     0, 0, 0, 0,
     "\"rounds downwards to the nearest integer\""},
    {"hypotf4", run_hypotf4, true_hypotf4, {SIGNED_LOG, 1e-18, 1e+18}, {SIGNED_LOG, 1e-18, 1e+18}, 0,
     2.7, 2.1, 2.5, 0,
     ""},
    {"isnanf4", run_isnanf4, true_isnanf4, {SIGNED_LOG, 1e-37, 1e+37}, {NONE, 0, 0}, 0,
     0, 0, 0, CLIENT_MASK,
     "\"always returns 0\""},
    {"ldexpf4", run_ldexpf4, true_ldexpf4, {SIGNED_LOG, 1e-10, 10000000000}, {INTEGERS, -80, 80}, 0,
     0, 0, 0, 0,
     "\"multiplied by 2^exp\""},
    {"lgammaf4", run_lgammaf4, true_lgammaf4, {EVEN, 0.01, 100}, {NONE, 0, 0}, 1,
     7.6, 14, 14, CLIENT_CASTS,
     ""},
    {"log1pf4", run_log1pf4, true_log1pf4, {EVEN, -0.99, 100}, {NONE, 0, 0}, 0,
     9.2, 6.3, 6.3, 0,
     ""},
    {"log2f4", run_log2f4, true_log2f4, {LOG, 1e-37, 1e+37}, {NONE, 0, 0}, 1,
     3.6, 2.6, 3.3, 0,
     "a polynomial in x - 1: absolute precision around 1"},
    {"logbf4", run_logbf4, true_logbf4, {SIGNED_LOG, 1e-37, 1e+37}, {NONE, 0, 0}, 0,
     0, 0, 0, 0,
     "\"the exponent\""},
    {"logf4", run_logf4, true_logf4, {LOG, 1e-37, 1e+37}, {NONE, 0, 0}, 1,
     4.5, 2.8, 3, 0,
     "log2f4 times a constant"},
    {"nearbyintf4", run_nearbyintf4, true_nearbyintf4, {SIGNED_LOG, 0.001, 10000000000}, {NONE, 0, 0}, 0,
     0, 0, 0, 0,
     "\"aliased to truncf4\""},
    {"nextafterf4", run_nextafterf4, true_nextafterf4, {SIGNED_LOG, 1e-37, 1e+37}, {SIGNED_LOG, 1e-37, 1e+37}, 0,
     0, 0, 0, 0,
     "\"the next representable number\""},
    {"powf4", run_powf4, true_powf4, {LOG, 0.001, 1000}, {EVEN, -10, 10}, 0,
     300, 150, 150, 0,
     "\"2^(y*log2(x))\": the error of the exponent, up to 100, is that of the result"},
    {"recipf4", run_recipf4, true_recipf4, {SIGNED_LOG, 1e-37, 1e+37}, {NONE, 0, 0}, 0,
     1, 1.5, 2.3, CLIENT_TRUNCATED,
     "\"truncated toward zero\""},
    {"rintf4", run_rintf4, true_rintf4, {SIGNED_LOG, 0.001, 10000000000}, {NONE, 0, 0}, 0,
     0, 0, 0, 0,
     "\"aliased to truncf4\""},
    {"scalbnf4", run_scalbnf4, true_scalbnf4, {SIGNED_LOG, 1e-10, 10000000000}, {INTEGERS, -80, 80}, 0,
     0, 0, 0, 0,
     "\"multiplied by 2^n\""},
    {"sincosf4_sin", run_sincosf4_sin, true_sincosf4_sin, {EVEN, -100, 100}, {NONE, 0, 0}, 1,
     2.4, 1.3, 1.4, 0,
     "\"to an accuracy of single precision\", no number"},
    {"sincosf4_cos", run_sincosf4_cos, true_sincosf4_cos, {EVEN, -100, 100}, {NONE, 0, 0}, 1,
     2.4, 1.2, 1.4, 0,
     "\"to an accuracy of single precision\", no number"},
    {"sinf4", run_sinf4, true_sinf4, {EVEN, -100, 100}, {NONE, 0, 0}, 1,
     2.4, 1.2, 1.4, 0,
     "\"to an accuracy of single precision\", no number"},
    {"sinhf4", run_sinhf4, true_sinhf4, {EVEN, -87, 87}, {NONE, 0, 0}, 0,
     4.5, 3.3, 3.9, 0,
     "\"to an accuracy of single precision\", no number"},
    {"sqrtf4", run_sqrtf4, true_sqrtf4, {LOG, 1e-37, 1e+37}, {NONE, 0, 0}, 0,
     1, 2, 2.2, CLIENT_TRUNCATED,
     "\"complete accuracy\", corrected by whole ulp as truncation asks"},
    {"tanf4", run_tanf4, true_tanf4, {EVEN, -1.5, 1.5}, {NONE, 0, 0}, 1,
     5.9, 5.6, 5.1, 0,
     "\"to an accuracy of single precision\", no number"},
    {"tanhf4", run_tanhf4, true_tanhf4, {EVEN, -7, 7}, {NONE, 0, 0}, 0,
     4.2, 3.4, 3.7, 0,
     ""},
    {"tanhf4, |x| to 20", run_tanhf4, true_tanhf4, {EVEN, -20, 20}, {NONE, 0, 0}, 0,
     4.2, 0, 0, CLIENT_SPU_ONLY,
     "divf4 at quotients next to 1: see there"},
    {"tgammaf4", run_tgammaf4, true_tgammaf4, {EVEN, 0.01, 26}, {NONE, 0, 0}, 0,
     390, 210, 210, 0,
     "through powf4, whose range x^(x - 1/2) leaves beyond 26"},
    {"truncf4", run_truncf4, true_truncf4, {SIGNED_LOG, 0.001, 10000000000}, {NONE, 0, 0}, 0,
     0, 0, 0, 0,
     "\"truncates towards zero\""},
};
/* clang-format on */

const client_table client_float_table = {functions, sizeof functions / sizeof functions[0], 4};
