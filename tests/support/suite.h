/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cmocka, and tests that join the suite of their file where they are written, so that none is forgotten:
 *     TEST(bytes_are_little_endian)
 *     {
 *         assert_int_equal(...);
 *     }
 *     SUITE(NULL, NULL)
 * They run in the order of the file. Define SUITE_SETUP, SUITE_TEARDOWN before including this to have a function called
 * before, after each. */
#ifndef SUITE_H
#define SUITE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#ifndef SUITE_SETUP
#define SUITE_SETUP NULL
#endif
#ifndef SUITE_TEARDOWN
#define SUITE_TEARDOWN NULL
#endif

enum { SUITE_MOST = 64 };
/* A file whose tests are all left out, for a library that is not there, has an empty suite. */
__attribute__((unused)) static struct CMUnitTest suite[SUITE_MOST];
__attribute__((unused)) static size_t suite_count;

#define TEST(name)                                                                                                     \
    static void name(void **state);                                                                                    \
    __attribute__((constructor)) static void name##_joins(void)                                                        \
    {                                                                                                                  \
        if (suite_count == SUITE_MOST)                                                                                 \
            abort();                                                                                                   \
        suite[suite_count++] = (struct CMUnitTest){#name, name, SUITE_SETUP, SUITE_TEARDOWN, NULL};                    \
    }                                                                                                                  \
    static void name(void **state __attribute__((unused)))

/* Runs the file's tests between a set-up and a teardown, which may be NULL. */
#define SUITE_RUN(setup, teardown) _cmocka_run_group_tests("suite", suite, suite_count, setup, teardown)
#define SUITE(setup, teardown)                                                                                         \
    int main(void) { return SUITE_RUN(setup, teardown); }

/* The same, with the seed of support/test.h. */
#define SEEDED_SUITE(name, setup, teardown)                                                                            \
    int main(void)                                                                                                     \
    {                                                                                                                  \
        test_begin(name);                                                                                              \
        return SUITE_RUN(setup, teardown);                                                                             \
    }

/* The same for a test that is compiled once per variant. */
#define VARIANT_SUITE(name, setup, teardown)                                                                           \
    int main(void)                                                                                                     \
    {                                                                                                                  \
        test_begin(name);                                                                                              \
        return test_variant_runs(CGT_VARIANT_NAME) ? SUITE_RUN(setup, teardown) : TEST_SKIPPED;                        \
    }

static inline void assert_near(double a, double b, double within)
{
    if (!(fabs(a - b) <= within))
        fail_msg("%.9g is not %.9g within %g", a, b, within);
}

#endif
