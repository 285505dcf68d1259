/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Measures newlib's SPU math functions against the libm of this machine and holds them to their bounds. Compiled in
 * each arithmetic and for each mapping; CLIENT_CASTS_DONE says that the sources went through casts.awk.
 *
 *   CGT_TEST_SEED   seed of the operands; printed
 *   CGT_TEST_SCALE  factor for their number, default 1 */
#include <spu_intrinsics.h>

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "simd/newlib_client/client.h"

#define VECTORS 1024u /* per round */
#define MOST_ELEMENTS (4 * VECTORS)

/* ---- random operands ---- */

static uint64_t random_state;

static uint64_t random_bits(void)
{
    uint64_t z = random_state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

static double random_fraction(void) { return (double)(random_bits() >> 11) * 0x1p-53; }

/* operand number i of a round; the first are the ends of the range and what lies between */
static double operand(const client_range *range, size_t i)
{
    const double low = range->low, high = range->high;
    const double t = i == 0 ? 0 : i == 1 ? 1 : i == 2 ? 0.5 : random_fraction();
    double value = 0;
    switch (range->spread) {
    case NONE: return 0;
    case EVEN: value = low + t * (high - low); break;
    case INTEGERS: value = floor(low + t * (high - low)); break;
    case LOG:
    case SIGNED_LOG: value = copysign(exp(log(fabs(low)) + t * (log(fabs(high)) - log(fabs(low)))), low); break;
    }
    if (range->spread == SIGNED_LOG && random_bits() & 1)
        value = -value;
    return value;
}

/* ---- elements ---- */

typedef union element_block {
    vec_float4 align;
    float f[MOST_ELEMENTS];
    int32_t n[MOST_ELEMENTS];
    double d[MOST_ELEMENTS / 2];
    int64_t l[MOST_ELEMENTS / 2];
} element_block;

static element_block xs, ys, outs;

static void fill(element_block *block, size_t element, const client_range *range, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const double value = operand(range, i);
        if (element == 4 && range->spread == INTEGERS)
            block->n[i] = (int32_t)value;
        else if (element == 4)
            block->f[i] = (float)value;
        else if (range->spread == INTEGERS)
            block->l[i] = (int64_t)value;
        else
            block->d[i] = value;
    }
}

static long double get(const element_block *block, size_t element, const client_range *range, size_t i)
{
    if (range->spread == INTEGERS)
        return element == 4 ? (long double)block->n[i] : (long double)block->l[i];
    return element == 4 ? (long double)block->f[i] : (long double)block->d[i];
}

/* the SPU's floats: exponent 0 is zero, exponent 255 an ordinary one */
static long double float_result(uint32_t bits)
{
    const uint32_t exponent = bits >> 23 & 255, fraction = bits & 0x7fffff;
#if defined(CGT_SPU_EXACT)
    const long double size = exponent == 0 ? 0 : ldexpl((long double)(fraction | 0x800000), (int)exponent - 150);
    return bits >> 31 ? -size : size;
#else
    float value;
    (void)exponent, (void)fraction;
    memcpy(&value, &bits, sizeof value);
    return value;
#endif
}

static long double result(const client_function *function, size_t element, size_t i)
{
    if (function->flags & CLIENT_MASK) {
        const int64_t mask = element == 4 ? outs.n[i] : outs.l[i];
        return mask == 0 || mask == -1 ? (long double)mask : (long double)NAN;
    }
    return element == 4 ? float_result((uint32_t)outs.n[i]) : (long double)outs.d[i];
}

/* ---- measuring ---- */

/* No arithmetic here: the mode is not that of the host's compiler. */
static void run_in_mode(const client_function *function, size_t vectors)
{
    const cgt_spu_arithmetic saved = cgt_spu_enter_arithmetic();
    function->run(&xs, &ys, &outs, vectors);
    cgt_spu_leave_arithmetic(saved);
}

/* the error in ulp; infinite if the result is not a number */
static double error_in_ulp(long double truth, long double got, double floor, size_t element)
{
    const int digits = element == 4 ? 24 : 53, lowest = element == 4 ? -125 : -1021;
    const long double size = fmaxl(fabsl(truth), (long double)floor), error = fabsl(got - truth);
    int exponent;
    if (truth == got)
        return 0;
    if (!(error < (long double)INFINITY))
        return (double)INFINITY;
    frexpl(size, &exponent);
    if (size == 0 || exponent < lowest)
        exponent = lowest;
    return (double)ldexpl(error, digits - exponent);
}

/* whether the result is no larger than the truth, where it must be the truth truncated */
static bool is_cut(const client_function *function, long double truth, long double got)
{
#if defined(CGT_SPU_EXACT)
    return !(function->flags & CLIENT_TRUNCATED) || fabsl(got) <= fabsl(truth);
#else
    (void)function, (void)truth, (void)got;
    return true;
#endif
}

typedef struct measure {
    double worst, x, y, got, truth; /* the largest error and where it was */
    uint64_t count, right;          /* operands; results within half an ulp */
} measure;

static measure measure_function(const client_function *function, size_t element, uint32_t rounds)
{
    const size_t count = VECTORS * (16 / element);
    measure m = {.worst = -1};
    for (uint32_t round = 0; round < rounds; round++) {
        fill(&xs, element, &function->x, count);
        fill(&ys, element, &function->y, count);
        run_in_mode(function, VECTORS);
        for (size_t i = 0; i < count; i++) {
            const long double x = get(&xs, element, &function->x, i), y = get(&ys, element, &function->y, i);
            const long double truth = function->truth(x, y), got = result(function, element, i);
            const double error =
                is_cut(function, truth, got) ? error_in_ulp(truth, got, function->floor, element) : (double)INFINITY;
            m.count++;
            m.right += error <= 0.5;
            if (error > m.worst)
                m = (measure){error, (double)x, (double)y, (double)got, (double)truth, m.count, m.right};
        }
    }
    return m;
}

static double bound_of(const client_function *function, size_t element)
{
#if defined(CGT_SPU_EXACT)
    (void)element;
    return function->exact;
#else
    return (element == 4 ? CGT_SPU_FUSED : CGT_SPU_FUSED_DOUBLE) ? function->fused : function->unfused;
#endif
}

/* the reason why a function is not held to its bound here, or NULL */
static const char *left_out(const client_function *function)
{
#if __BYTE_ORDER__ != __ORDER_BIG_ENDIAN__ && !defined(CLIENT_CASTS_DONE)
    if (function->flags & CLIENT_CASTS)
        return "casts between element sizes need a big-endian host";
#endif
#if !defined(CGT_SPU_EXACT)
    if (function->flags & CLIENT_SPU_ONLY)
        return function->says;
#endif
    (void)function;
    return NULL;
}

static bool check(const client_function *function, size_t element, uint32_t rounds)
{
    const double bound = bound_of(function, element);
    const measure m = measure_function(function, element, rounds);
    const bool good = m.worst <= bound;
    printf("%-4s %-18s %10.4g ulp of %-6g %6.2f %% within 1/2  worst at (%.9g, %.9g): %.17g, truth %.17g\n",
           good ? "ok" : "BAD", function->name, m.worst, bound, 100.0 * (double)m.right / (double)m.count, m.x, m.y,
           m.got, m.truth);
    if (!good)
        printf("     %s: its header says: %s\n", function->name, *function->says ? function->says : "nothing");
    return good;
}

static unsigned check_table(const client_table *table, uint32_t rounds, unsigned *checked)
{
    unsigned bad = 0;
    for (size_t i = 0; i < table->count; i++) {
        const client_function *const function = &table->functions[i];
        const char *const why = left_out(function);
        if (why) {
            printf("-    %-18s left out: %s\n", function->name, why);
        } else {
            bad += !check(function, table->element, rounds);
            (*checked)++;
        }
    }
    return bad;
}

int main(void)
{
    const char *const seed = getenv("CGT_TEST_SEED"), *const scale = getenv("CGT_TEST_SCALE");
    const double factor = scale && *scale ? strtod(scale, NULL) : 1;
    random_state = seed && *seed ? strtoull(seed, NULL, 0) : 20260117;
    printf("CGT_TEST_SEED=%llu CGT_TEST_SCALE=%g\n", (unsigned long long)random_state, factor);
    const uint32_t rounds = factor * 20 >= 1 ? (uint32_t)(factor * 20) : 1;
    unsigned checked = 0;
    unsigned bad = check_table(&client_float_table, rounds, &checked);
    bad += check_table(&client_double_table, rounds, &checked);
    bad += client_check_special_cases();
    printf("%u rows of functions checked, %u bad\n", checked, bad);
    return bad > 0;
}
