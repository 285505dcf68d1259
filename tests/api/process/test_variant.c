/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The choice of a variant on CPUs other than this machine's: src/dispatch/variant.c is compiled into this program, with
 * simulated CPU features. A row whose flags need a feature that the CPU lacks is not chosen and cannot be forced. */
#define _POSIX_C_SOURCE 200809L
#include "support/test.h"
#include "support/suite.h"

#include <stdio.h>
#include <string.h>

static const char *cpu_features; /* each with a space on both sides */

__attribute__((unused)) static bool cpu_supports(const char *feature)
{
    char word[32];
    snprintf(word, sizeof word, " %s ", feature);
    return strstr(cpu_features, word) != NULL;
}
#define __builtin_cpu_supports(feature) cpu_supports(feature)
#include "dispatch/variant.c"

#define SSE " sse4.1 "
#define AVX2 SSE " avx2  fma  bmi "
#define AVX512 AVX2 " avx512f  avx512bw  avx512dq  avx512vl "

static bool in_build(const char *name)
{
    for (const char *const *v = cgt_get_variant_names(); *v; v++)
        if (strcmp(*v, name) == 0)
            return true;
    return false;
}

static void keep_message(void *user, cgt_log_level level, const char *message)
{
    (void)level;
    snprintf(user, 200, "%s", message);
}

/* A variant of this build is refused as one that the CPU cannot run, and the message says so. */
static void check_refused(const char *name)
{
    char logged[200] = "", message[200] = "", expected[200];
    cgt_context *context;
    cgt_context_options options;
    cgt_context_options_init(&options);
    options.variant = name;
    options.log = (cgt_log_hook){logged, keep_message};
    assert_int_equal(cgt_context_create(&options, &context), CGT_ERROR_UNSUPPORTED);
    cgt_context_get_error_message(context, message, sizeof message);
    cgt_context_release(context);
    snprintf(expected, sizeof expected, "variant %s: this CPU lacks instructions that it needs", name);
    assert_string_equal(message, expected);
    assert_string_equal(logged, expected);
}

static void check_widest(const char *features, const char *expected)
{
    static const char *const wide[] = {"sse", "avx2", "avx512"};
    cgt_variant_state state;
    char unknown[CGT_VARIANT_NAME_BYTES];
    bool runs = true;
    cpu_features = features;
    if (in_build(expected)) {
        const cgt_kernel *kernel = cgt_variant_find(NULL, &state, unknown);
        assert_non_null(kernel);
        assert_string_equal(kernel->name, expected);
        assert_int_equal(state, CGT_VARIANT_RUNS);
    }
    runs = strcmp(expected, "portable") != 0;
    for (size_t i = 0; i < TEST_COUNT(wide); i++) {
        if (!runs && in_build(wide[i]))
            check_refused(wide[i]);
        runs &= strcmp(expected, wide[i]) != 0;
    }
}

TEST(the_widest_variant_of_the_cpu_is_chosen)
{
    if (!in_build("sse")) {
        print_message("no variant of this build depends on the CPU\n");
        skip();
    }
    check_widest("", "portable");
    check_widest(SSE, "sse");
    check_widest(AVX2, "avx2");
    check_widest(AVX512, "avx512");
    check_widest(AVX512 " avx9 ", "avx512");
}

/* Each feature is required: without it the next narrower row is the widest. */
TEST(every_feature_is_required)
{
    if (!in_build("sse"))
        skip();
    check_widest(SSE " avx2  fma ", "sse");
    check_widest(SSE " avx2  bmi ", "sse");
    check_widest(SSE " fma  bmi ", "sse");
    check_widest(AVX2 " avx512f  avx512bw  avx512dq ", "avx2");
    check_widest(AVX2 " avx512f  avx512bw  avx512vl ", "avx2");
    check_widest(AVX2 " avx512f  avx512dq  avx512vl ", "avx2");
    check_widest(AVX2 " avx512bw  avx512dq  avx512vl ", "avx2");
    check_widest(SSE " avx2  bmi  avx512f  avx512bw  avx512dq  avx512vl ", "sse");
}

TEST(names_not_in_the_build_are_unknown)
{
    cgt_variant_state found;
    char unknown[CGT_VARIANT_NAME_BYTES];
    cpu_features = AVX512;
    for (size_t i = 0; i < ROWS; i++) {
        const cgt_kernel *kernel = cgt_variant_find(table[i].name, &found, unknown);
        assert_true(in_build(table[i].name) == (kernel != NULL));
        assert_true((found == CGT_VARIANT_ABSENT) == (kernel == NULL));
        assert_true(!kernel || strcmp(kernel->name, table[i].name) == 0);
    }
    assert_null(cgt_variant_find("", &found, unknown));
    assert_int_equal(found, CGT_VARIANT_ABSENT);
    assert_null(cgt_variant_find("avx", &found, unknown));
    assert_int_equal(found, CGT_VARIANT_ABSENT);
}

/* Rows go from narrow to wide, with the lanes that they state. */
TEST(rows_ascend)
{
    uint32_t lanes = 0;
    size_t listed = 0;
    for (size_t i = 0; i < ROWS; i++) {
        if (!table[i].kernel)
            continue;
        assert_string_equal(table[i].name, table[i].kernel->name);
        assert_string_equal(table[i].name, names[listed++]);
        assert_true(table[i].kernel->lanes >= lanes);
        lanes = table[i].kernel->lanes;
    }
    assert_true(listed >= 1 && names[listed] == NULL);
}

int main(void)
{
    test_begin("test_variant");
    unsetenv("CGT_DISABLE_CPU");
    return SUITE_RUN(NULL, NULL);
}
