/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The functions of two doubles: their loops, their truth and their bounds. */
#include <spu_intrinsics.h> /* first, as on an SPU: some headers use its keyword before they include it */

#include "headers/acosd2.h"
#include "headers/acoshd2.h"
#include "headers/asind2.h"
#include "headers/asinhd2.h"
#include "headers/atan2d2.h"
#include "headers/atand2.h"
#include "headers/atanhd2.h"
#include "headers/cosd2.h"
#include "headers/coshd2.h"
#include "headers/divd2.h"
#include "headers/erfcd2.h"
#include "headers/erfd2.h"
#include "headers/exp2d2.h"
#include "headers/expd2.h"
#include "headers/expm1d2.h"
#include "headers/floord2.h"
#include "headers/hypotd2.h"
#include "headers/isnand2.h"
#include "headers/ldexpd2.h"
#include "headers/lgammad2.h"
#include "headers/log10d2.h"
#include "headers/log1pd2.h"
#include "headers/log2d2.h"
#include "headers/logd2.h"
#include "headers/nextafterd2.h"
#include "headers/powd2.h"
#include "headers/recipd2.h"
#include "headers/signbitd2.h"
#include "headers/sincosd2.h"
#include "headers/sind2.h"
#include "headers/sinhd2.h"
#include "headers/sqrtd2.h"
#include "headers/tand2.h"
#include "headers/tanhd2.h"
#include "headers/tgammad2.h"
#include "headers/truncd2.h"

#define CLIENT_FLOATS vec_double2
#define CLIENT_INTS vec_llong2
#define CLIENT_MASKS vec_ullong2
#include "simd/newlib_client/functions.h"

static inline vec_double2 sine(vec_double2 x)
{
    vec_double2 s, c;
    _sincosd2(x, &s, &c);
    return s;
}

static inline vec_double2 cosine(vec_double2 x)
{
    vec_double2 s, c;
    _sincosd2(x, &s, &c);
    return c;
}

OF_X(acosd2, acosl(x))
OF_X(acoshd2, acoshl(x))
OF_X(asind2, asinl(x))
OF_X(asinhd2, asinhl(x))
OF_X_Y(atan2d2, atan2l(x, y))
OF_X(atand2, atanl(x))
OF_X(atanhd2, atanhl(x))
OF_X(cosd2, cosl(x))
OF_X(coshd2, coshl(x))
OF_X_Y(divd2, x / y)
OF_X(erfcd2, erfcl(x))
OF_X(erfd2, erfl(x))
OF_X(exp2d2, exp2l(x))
OF_X(expd2, expl(x))
OF_X(expm1d2, expm1l(x))
OF_X(floord2, floorl(x))
OF_X_Y(hypotd2, hypotl(x, y))
MASK_OF_X(isnand2, 0)
OF_X_N(ldexpd2, ldexpl(x, (int)y))
OF_X(lgammad2, lgammal(x))
OF_X(log10d2, log10l(x))
OF_X(log1pd2, log1pl(x))
OF_X(log2d2, log2l(x))
OF_X(logd2, logl(x))
OF_X_Y(nextafterd2, nextafter((double)x, (double)y))
OF_X_Y(powd2, powl(x, y))
OF_X(recipd2, 1 / x)
FUNCTION(sincosd2_sin, vec_double2, sine(x[i]), sinl(x))
FUNCTION(sincosd2_cos, vec_double2, cosine(x[i]), cosl(x))
OF_X(sind2, sinl(x))
OF_X(sinhd2, sinhl(x))
OF_X(sqrtd2, sqrtl(x))
MASK_OF_X(signbitd2, signbit(x) ? -1 : 0)
OF_X(tand2, tanl(x))
OF_X(tanhd2, tanhl(x))
OF_X(tgammad2, tgammal(x))
OF_X(truncd2, truncl(x))

/* ---- bounds: exact, fused IEEE, unfused IEEE ---- */

/* clang-format off */
static const client_function functions[] = {
    {F(acosd2), {EVEN, -1, 1}, NO_Y, 0, 3.3, 1.8, 2.1, CLIENT_CASTS, ""},
    {F(acoshd2), {LOG, 1, 1e+100}, NO_Y, 0, 6.6, 3.7, 3.7, CLIENT_CASTS, ""},
    {F(asind2), {EVEN, -1, 1}, NO_Y, 0, 4, 3.4, 3.9, CLIENT_CASTS, ""},
    {F(asinhd2), {SIGNED_LOG, 1e-100, 1e+100}, NO_Y, 0, 25, 11, 13, CLIENT_CASTS, ""},
    {F(atan2d2), {SIGNED_LOG, 1e-06, 1000000}, {SIGNED_LOG, 1e-06, 1000000}, 0, 7.6, 4.8, 5.6, CLIENT_CASTS, ""},
    {F(atand2), {SIGNED_LOG, 1e-100, 1e+100}, NO_Y, 0, 5.3, 4.5, 4.6, CLIENT_CASTS, ""},
    {F(atanhd2), {EVEN, -0.999, 0.999}, NO_Y, 0, 7.1, 6.2, 6.2, CLIENT_CASTS, ""},
    {F(cosd2), {EVEN, -100, 100}, NO_Y, 1, 2.4, 1.3, 1.4, CLIENT_CASTS,
     "\"to an accuracy of double precision\", no number"},
    {F(coshd2), {EVEN, -700, 700}, NO_Y, 0, 5.3, 4.1, 4.2, CLIENT_CASTS,
     "\"to an accuracy of double precision\", no number"},
    {F(divd2), {SIGNED_LOG, 1e-100, 1e+100}, {SIGNED_LOG, 1e-100, 1e+100}, 0, 2.7, 0.501, 2.2, CLIENT_CASTS,
     "\"maximum error about 0.5 ulp\"; needs the fused madd and rounding to nearest"},
    {F(erfcd2), {EVEN, -4, 25}, NO_Y, 0, 1.9e+03, 1.9e+03, 1.9e+03, CLIENT_CASTS,
     "\"would benefit from a rational approximation in 1.2 < x < 2.0 and around x = 2.5\""},
    {F(erfd2), {EVEN, -5, 5}, NO_Y, 0, 7.9, 7.5, 8.6, CLIENT_CASTS, ""},
    {F(exp2d2), {EVEN, -1000, 1000}, NO_Y, 0, 3.5, 1.9, 2.3, CLIENT_CASTS, ""},
    {F(expd2), {EVEN, -700, 700}, NO_Y, 0, 3.4, 3.6, 3.5, CLIENT_CASTS, ""},
    {F(expm1d2), {EVEN, -20, 700}, NO_Y, 0, 6.5, 3.6, 5.4, CLIENT_CASTS,
     "\"accurate values, even where exp(x) - 1 would produce bad results\""},
    {F(floord2), {SIGNED_LOG, 0.001, 10000000000}, NO_Y, 0, 0, 0, 0, CLIENT_CASTS, ""},
    {F(hypotd2), {SIGNED_LOG, 1e-100, 1e+100}, {SIGNED_LOG, 1e-100, 1e+100}, 0, 3.4, 1.3, 1.9, 0, ""},
    {F(isnand2), {SIGNED_LOG, 1e-300, 1e+300}, NO_Y, 0, 0, 0, 0, CLIENT_MASK | CLIENT_CASTS, ""},
    {F(ldexpd2), {SIGNED_LOG, 1e-10, 10000000000}, {INTEGERS, -900, 900}, 0, 0, 0, 0, CLIENT_CASTS, ""},
    {F(lgammad2), {EVEN, 0.01, 100}, NO_Y, 1, 110, 48, 52, CLIENT_CASTS, ""},
    {F(log10d2), {LOG, 1e-300, 1e+300}, NO_Y, 1, 3.3, 1.8, 1.8, CLIENT_CASTS, ""},
    {F(log1pd2), {EVEN, -0.99, 100}, NO_Y, 1, 4.5e+04, 2.4e+04, 2.4e+04, CLIENT_CASTS,
     "below 0 it is log(1 + x): absolute precision there"},
    {F(log2d2), {LOG, 1e-300, 1e+300}, NO_Y, 1, 1.9, 1.4, 1.3, CLIENT_CASTS, ""},
    {F(logd2), {LOG, 1e-300, 1e+300}, NO_Y, 1, 4, 2, 2, CLIENT_CASTS, ""},
    {F(nextafterd2), {SIGNED_LOG, 1e-300, 1e+300}, {SIGNED_LOG, 1e-300, 1e+300}, 0, 0, 0, 0, CLIENT_CASTS, ""},
    {F(powd2), {LOG, 0.001, 1000}, {EVEN, -10, 10}, 0, 290, 150, 150, CLIENT_CASTS, "\"2^(y*log2(x))\": as powf4"},
    {F(recipd2), {SIGNED_LOG, 1e-300, 1e+300}, NO_Y, 0, 3, 0.501, 1.9, CLIENT_CASTS,
     "\"99.95% correctly rounded\"; needs the fused madd and rounding to nearest"},
    {F(sincosd2_sin), {EVEN, -100, 100}, NO_Y, 1, 2.5, 1.5, 1.5, CLIENT_CASTS,
     "\"to an accuracy of double precision\", no number"},
    {F(sincosd2_cos), {EVEN, -100, 100}, NO_Y, 1, 2.5, 1.4, 1.4, CLIENT_CASTS,
     "\"to an accuracy of double precision\", no number"},
    {F(sind2), {EVEN, -100, 100}, NO_Y, 1, 2.4, 1.4, 1.4, CLIENT_CASTS,
     "\"to an accuracy of double precision\", no number"},
    {F(sinhd2), {EVEN, -700, 700}, NO_Y, 0, 6, 4.3, 4.1, CLIENT_CASTS,
     "\"to an accuracy of double precision\", no number"},
    {F(sqrtd2), {LOG, 1e-300, 1e+300}, NO_Y, 0, 1.5, 0.501, 1.3, 0, "needs the fused madd"},
    {F(signbitd2), {SIGNED_LOG, 1e-300, 1e+300}, NO_Y, 0, 0, 0, 0, CLIENT_MASK | CLIENT_CASTS, ""},
    {F(tand2), {EVEN, -1.5, 1.5}, NO_Y, 1, 7, 5, 6, CLIENT_CASTS, "\"to an accuracy of double precision\", no number"},
    {F(tanhd2), {EVEN, -20, 20}, NO_Y, 0, 4.8, 3.4, 4.8, CLIENT_CASTS, ""},
    {F(tgammad2), {EVEN, 0.01, 140}, NO_Y, 0, 2.2e+03, 1.1e+03, 1.1e+03, CLIENT_CASTS,
     "through powers, which lose precision as powd2 does"},
    {F(truncd2), {SIGNED_LOG, 0.001, 10000000000}, NO_Y, 0, 0, 0, 0, CLIENT_CASTS, ""},
};
/* clang-format on */

const client_table client_double_table = {functions, sizeof functions / sizeof functions[0], 8};
