/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every typed overload of every word (the table simd/spu/spu_words.h) against its definition (spu_reference.h), for the
 * mapping of the variant that this is compiled for: on edge operands, on all pairs of them, and on random ones. Each
 * call also says that the result has the type of the table and that each operand is evaluated once.
 *
 * With CGT_SPU_EXACT single precision follows the SPU's arithmetic, which test_spu_arithmetic.c knows: the overloads
 * that compute with floats are counted here, not called. */
#include "support/test.h"

#include "simd/spu_operands.h"
#include "simd/spu_overloads.h"

#define RANDOM_ROUNDS 6000

/* ---- one function per overload ---- */

/* Calls the word, counts how often it evaluates each operand. */
typedef spu_quad spu_call(const spu_quad operand[3], int evaluated[3]);

/* The type of the result is checked on plain operands: clang warns of side effects in what _Generic looks at. */
#define HAS_TYPE(call, type) _Static_assert(_Generic((call), TYPE_##type : 1, default : 0), "the result is no " #type)
#define CALL1(word, r, a)                                                                                              \
    static spu_quad call_##word##_##r##_##a(const spu_quad operand[3], int evaluated[3])                               \
    {                                                                                                                  \
        const TYPE_##a x = load_##a(&operand[0]);                                                                      \
        HAS_TYPE(spu_##word(x), r);                                                                                    \
        return store_##r(spu_##word((evaluated[0]++, x)));                                                             \
    }
#define CALL2(word, r, a, b)                                                                                           \
    static spu_quad call_##word##_##r##_##a##_##b(const spu_quad operand[3], int evaluated[3])                         \
    {                                                                                                                  \
        const TYPE_##a x = load_##a(&operand[0]);                                                                      \
        const TYPE_##b y = load_##b(&operand[1]);                                                                      \
        HAS_TYPE(spu_##word(x, y), r);                                                                                 \
        return store_##r(spu_##word((evaluated[0]++, x), (evaluated[1]++, y)));                                        \
    }
#define CALL3(word, r, a, b, c)                                                                                        \
    static spu_quad call_##word##_##r##_##a##_##b##_##c(const spu_quad operand[3], int evaluated[3])                   \
    {                                                                                                                  \
        const TYPE_##a x = load_##a(&operand[0]);                                                                      \
        const TYPE_##b y = load_##b(&operand[1]);                                                                      \
        const TYPE_##c z = load_##c(&operand[2]);                                                                      \
        HAS_TYPE(spu_##word(x, y, z), r);                                                                              \
        return store_##r(spu_##word((evaluated[0]++, x), (evaluated[1]++, y), (evaluated[2]++, z)));                   \
    }
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wunevaluated-expression"
#endif
CGT_SPU_WORDS(CALL1, CALL2, CALL3)

#define CALL_NAME1(word, r, a) call_##word##_##r##_##a,
#define CALL_NAME2(word, r, a, b) call_##word##_##r##_##a##_##b,
#define CALL_NAME3(word, r, a, b, c) call_##word##_##r##_##a##_##b##_##c,
static spu_call *const calls[] = {CGT_SPU_WORDS(CALL_NAME1, CALL_NAME2, CALL_NAME3)};
static const spu_row rows[] = {CGT_SPU_WORDS(SPU_ROW1, SPU_ROW2, SPU_ROW3)};

/* ---- a form with its operands' roles ---- */

typedef struct overload {
    spu_form form;
    spu_role role[3];
    spu_call *call;
    test_random random;
    bool has_failed;
} overload;

static overload overload_of(size_t i)
{
    overload o = {.form = spu_form_of(&rows[i]), .call = calls[i], .random = random_make(i + 1)};
    for (int k = 0; k < o.form.operands; k++)
        o.role[k] = spu_role_of(&rows[i], k);
    return o;
}

/* ---- one comparison ---- */

/* After its first failure an overload is skipped; the test continues with the others of the word. */
static void check(overload *o, const spu_quad in[3])
{
    if (o->has_failed)
        return;
    int evaluated[3] = {0};
    const spu_quad got = o->call(in, evaluated);
    const spu_quad expected = spu_reference_result(&o->form, in);
    const int wrong = spu_reference_mismatch(&o->form, in, &got, &expected);
    if (wrong >= 0)
        spu_report(&o->form, in, &got, &expected, wrong);
    o->has_failed = wrong >= 0;
    for (int k = 0; k < 3; k++)
        if (evaluated[k] != (k < o->form.operands)) {
            print_error("spu_%s evaluates operand %d %d times\n", o->form.text, k + 1, evaluated[k]);
            o->has_failed = true;
        }
}

/* ---- the operands that an overload meets ---- */

/* All codes of a pattern in all places. */
static void check_shuffle_codes(overload *o)
{
    spu_quad in[3];
    for (int code = 0; code < 256; code++) {
        spu_random_operands(&o->random, &o->form, o->role, in);
        for (int k = 0; k < 16; k++) {
            for (int i = 0; i < 16; i++)
                in[2].byte[i] = (uint8_t)(i == k ? code : i);
            check(o, in);
        }
    }
}

static void visit(void *user, const spu_quad in[3]) { check(user, in); }

static void check_overload(overload *o)
{
    spu_each_operands(&o->random, &o->form, o->role, test_scaled(RANDOM_ROUNDS), visit, o);
    if (!strcmp(o->form.word, "shuffle"))
        check_shuffle_codes(o);
}

/* ---- one test per word ---- */

static uint32_t called, counted; /* overloads */

/* state is the word */
static void every_overload_of(void **state)
{
    bool has_failed = false;
    for (size_t i = 0; i < TEST_COUNT(rows); i++) {
        if (strcmp(rows[i].word, *state) != 0)
            continue;
        counted++;
        if (spu_is_left_to_exact(&rows[i]))
            continue;
        overload o = overload_of(i);
        called++;
        check_overload(&o);
        has_failed |= o.has_failed;
    }
    assert_false(has_failed);
}

/* The words in the order of the table; a word may stand in several rows that are not neighbours. */
static uint32_t list_words(const char *words[], uint32_t capacity)
{
    uint32_t count = 0;
    for (size_t i = 0; i < TEST_COUNT(rows); i++) {
        uint32_t w = 0;
        while (w < count && strcmp(words[w], rows[i].word) != 0)
            w++;
        if (w == count && count < capacity)
            words[count++] = rows[i].word;
    }
    return count;
}

/* Last of all tests. */
static void nothing_is_left_out(void **state)
{
    const char *words[SPU_WORDS + 1];
    const uint32_t count = list_words(words, SPU_WORDS + 1);
    (void)state;
    assert_int_equal(TEST_COUNT(rows), SPU_OVERLOADS);
    assert_int_equal(count, SPU_WORDS);
    print_message("%s: %u overloads of %u words, %u of them called\n", CGT_VARIANT_NAME, counted, count, called);
    assert_int_equal(counted, SPU_OVERLOADS);
#ifndef CGT_SPU_EXACT
    assert_int_equal(called, SPU_OVERLOADS);
#endif
}

int main(void)
{
    static const char *words[SPU_WORDS];
    struct CMUnitTest tests[SPU_WORDS + 1];
    test_begin("test_spu_words");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    const uint32_t count = list_words(words, SPU_WORDS);
    for (uint32_t w = 0; w < SPU_WORDS; w++)
        tests[w] = (struct CMUnitTest){w < count ? words[w] : "absent", every_overload_of, NULL, NULL,
                                       (void *)(uintptr_t)(w < count ? words[w] : "")};
    tests[SPU_WORDS] = (struct CMUnitTest)cmocka_unit_test(nothing_is_left_out);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
