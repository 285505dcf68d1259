/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * newlib's math functions for the SPU, compiled by this machine's compiler against simd/spu_intrinsics.h, and the
 * bounds of their errors. */
#ifndef CLIENT_H
#define CLIENT_H

#include <stddef.h>

/* x and y are vectors of the function's type, y of ints where it takes an int; out likewise */
typedef void (*client_run)(const void *x, const void *y, void *out, size_t vectors);

typedef enum client_spread {
    NONE,       /* no such operand */
    EVEN,       /* evenly from low to high */
    LOG,        /* evenly over the orders of magnitude, positive */
    SIGNED_LOG, /* likewise, either sign */
    INTEGERS    /* whole numbers, in a vector of ints */
} client_spread;

typedef struct client_range {
    client_spread spread;
    double low, high;
} client_range;

/* The requirements on one function for a range of operands. Errors count in ulp (units in the last place) of the larger
 * of the true value and `floor`, which is 0 except for functions that lose relative precision where they cross zero.
 *
 * The headers document few bounds in numbers. `says` quotes what a header does say; a bound that does not follow from
 * that is one and a half times the largest error met in eight builds, with 400,000 random operands a function on x86-64
 * and fewer on AArch64 and big-endian POWER under emulation: wide enough for another seed, narrow enough that a wrong
 * element, sign, bit or rounding shows. */
typedef struct client_function {
    const char *name;
    client_run run;
    long double (*truth)(long double x, long double y);
    client_range x, y;
    double floor;
    double exact;   /* bound in the SPU's arithmetic; doubles truncate, too, in its fast forms */
    double fused;   /* bound in the host's arithmetic where madd rounds once */
    double unfused; /* the same where it rounds twice */
    unsigned flags;
    const char *says;
} client_function;

#define CLIENT_MASK 1u      /* the result is a mask: the truth is -1 or 0 */
#define CLIENT_CASTS 2u     /* casts between element sizes: an unchanged source is right on big-endian hosts alone */
#define CLIENT_TRUNCATED 4u /* in the SPU's arithmetic the truth, truncated: no result is larger, or off by an ulp */
#define CLIENT_SPU_ONLY 8u  /* holds in the SPU's arithmetic alone; `says` why */

typedef struct client_table {
    const client_function *functions;
    size_t count;
    size_t element; /* bytes: 4 or 8 */
} client_table;

extern const client_table client_float_table, client_double_table;

/* The values that the headers promise at single points: infinities, zeros, numbers out of a domain. Prints each that is
 * wrong and returns how many are. */
unsigned client_check_special_cases(void);

#endif
