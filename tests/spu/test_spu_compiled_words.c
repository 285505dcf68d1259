/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Every overload of simd/spu/spu_words.h three times over: the SPU's own compiler and header make a program of it
 * (words_program.c, SPU_PROGRAM), the simulator runs that, and the mapping of this row, in exact mode, has to give the
 * same bits, on edges, on pairs of them and on random operands.
 *
 * What may differ:
 *   promote           only one element is defined
 *   NaN               of doubles, and of spu_roundtf: one is as good as another, as among hosts
 *   denormal operands of double arithmetic, of spu_extend and spu_roundtf: an SPU takes them for zeros, a
 *                     host computes with them
 * madd, msub, nmsub and nmadd of doubles round once on an SPU. Where the mapping rounds twice, the C library's fma
 * takes its place here. */
#include "support/test.h"
#include "support/suite.h"

#include <math.h>
#include <string.h>

#include "simd/spu_operands.h"
#include "simd/spu_overloads.h"
#include "spu/spu_program.h"

#define RANDOM_ROUNDS 4000
#define RECORD 4 /* quads: three operands, the result */
#define BATCH (EXCHANGE_QUADS / RECORD)

/* ---- the mapping: one function per overload ---- */

typedef spu_quad spu_call(const spu_quad operand[3]);

#define CALL1(word, r, a)                                                                                              \
    static spu_quad call_##word##_##r##_##a(const spu_quad operand[3])                                                 \
    {                                                                                                                  \
        return store_##r(spu_##word(load_##a(&operand[0])));                                                           \
    }
#define CALL2(word, r, a, b)                                                                                           \
    static spu_quad call_##word##_##r##_##a##_##b(const spu_quad operand[3])                                           \
    {                                                                                                                  \
        return store_##r(spu_##word(load_##a(&operand[0]), load_##b(&operand[1])));                                    \
    }
#define CALL3(word, r, a, b, c)                                                                                        \
    static spu_quad call_##word##_##r##_##a##_##b##_##c(const spu_quad operand[3])                                     \
    {                                                                                                                  \
        return store_##r(spu_##word(load_##a(&operand[0]), load_##b(&operand[1]), load_##c(&operand[2])));             \
    }
CGT_SPU_WORDS(CALL1, CALL2, CALL3)

#define CALL_NAME1(word, r, a) call_##word##_##r##_##a,
#define CALL_NAME2(word, r, a, b) call_##word##_##r##_##a##_##b,
#define CALL_NAME3(word, r, a, b, c) call_##word##_##r##_##a##_##b##_##c,
static spu_call *const calls[] = {CGT_SPU_WORDS(CALL_NAME1, CALL_NAME2, CALL_NAME3)};
static const spu_row rows[] = {CGT_SPU_WORDS(SPU_ROW1, SPU_ROW2, SPU_ROW3)};

/* ---- an overload and the records that wait for it ---- */

typedef struct overload {
    uint32_t number; /* in the table */
    spu_form form;
    spu_role role[3];
    bool is_float; /* computes with floats: in the arithmetic mode; doubles must not be in it */
    spu_program *program;
    test_random random;
    spu_quad record[BATCH][RECORD];
    uint32_t records;
    uint32_t calls, excused, wrong; /* so far */
} overload;

static bool is_denormal(uint64_t bits, spu_type type)
{
    const uint64_t magnitude = type == SPU_f64 ? bits & (UINT64_MAX >> 1) : bits & 0x7fffffff;
    return magnitude && magnitude < (type == SPU_f64 ? UINT64_C(1) << 52 : UINT64_C(1) << 23);
}

/* Whether an element of the operands that element i of a result of doubles, or of extend and roundtf, comes from is
 * denormal. */
static bool has_denormal(const overload *o, const spu_quad *operand, int i)
{
    const bool converts = !strcmp(o->form.word, "extend") || !strcmp(o->form.word, "roundtf");
    for (int k = 0; k < o->form.operands; k++) {
        const spu_type type = o->form.operand[k].type;
        if (type != SPU_f64 && !(type == SPU_f32 && converts))
            continue;
        const int element = !converts ? i : type == SPU_f32 ? 2 * i : i / 2;
        if (is_denormal(spu_get(&operand[k], type, element), type))
            return true;
    }
    return false;
}

static bool is_nan(uint64_t bits, spu_type type)
{
    return type == SPU_f64 ? (bits & (UINT64_MAX >> 1)) > UINT64_C(0x7ff) << 52 : (bits & 0x7fffffff) > 0x7f800000;
}

/* Whether element i may differ. */
static bool is_excused(const overload *o, const spu_quad *operand, int i, uint64_t got, uint64_t expected)
{
    if (!strcmp(o->form.word, "promote")) {
        const int elements = spu_elements(o->form.result.type);
        return i != (int)(spu_get(&operand[1], SPU_s32, 0) % (uint64_t)elements);
    }
    const spu_type type = o->form.result.type;
    if ((type == SPU_f64 || !strcmp(o->form.word, "roundtf")) && is_nan(got, type) && is_nan(expected, type))
        return true;
    return has_denormal(o, operand, i);
}

/* A multiply-add of doubles, rounded once. */
static spu_quad fused_result(const overload *o, const spu_quad operand[3])
{
    const vec_double2 a = load_f64(&operand[0]), b = load_f64(&operand[1]), c = load_f64(&operand[2]);
    const bool subtracts = spu_is_word_of(o->form.word, " msub nmsub ");
    const bool is_negated = spu_is_word_of(o->form.word, " nmsub nmadd ");
    vec_double2 result;
    for (int i = 0; i < 2; i++) {
        const double sum = fma(a[i], b[i], subtracts ? -c[i] : c[i]);
        result[i] = is_negated ? -sum : sum;
    }
    return store_f64(result);
}

static spu_quad expected_result(const overload *o, const spu_quad operand[3])
{
    if (!CGT_SPU_FUSED_DOUBLE && o->form.operands == 3 && o->form.operand[0].type == SPU_f64 &&
        spu_is_word_of(o->form.word, " madd msub nmsub nmadd "))
        return fused_result(o, operand);
    const cgt_spu_arithmetic saved = o->is_float ? cgt_spu_enter_arithmetic() : (cgt_spu_arithmetic){0};
    const spu_quad expected = calls[o->number](operand);
    if (o->is_float)
        cgt_spu_leave_arithmetic(saved);
    return expected;
}

static void compare(overload *o, const spu_quad record[RECORD])
{
    const spu_quad expected = expected_result(o, record);
    o->calls++;
    const spu_type type = o->form.result.type;
    const int elements = o->form.result.is_scalar ? 1 : spu_elements(type);
    for (int i = 0; i < elements; i++) {
        const uint64_t a = spu_get(&record[3], type, i), b = spu_get(&expected, type, i);
        if (a == b)
            continue;
        if (is_excused(o, record, i, a, b)) {
            o->excused++;
            continue;
        }
        if (o->wrong++ < 3)
            spu_report(&o->form, record, &record[3], &expected, i);
        return;
    }
}

static void flush(overload *o)
{
    if (!o->records)
        return;
    spu_program_call(o->program, o->number, o->record[0], o->records, RECORD);
    for (uint32_t i = 0; i < o->records; i++)
        compare(o, o->record[i]);
    o->records = 0;
}

static void add(void *user, const spu_quad in[3])
{
    overload *const o = user;
    if (o->records == BATCH)
        flush(o);
    spu_quad *const record = o->record[o->records++];
    memcpy(record, in, 3 * sizeof *in);
    memset(&record[3], 0, sizeof record[3]);
}

static void check_overload(overload *o)
{
    spu_each_operands(&o->random, &o->form, o->role, test_scaled(RANDOM_ROUNDS), add, o);
    flush(o);
}

/* ---- tests ---- */

static void overload_begin(overload *o, uint32_t number, spu_program *program)
{
    *o = (overload){
        .number = number, .form = spu_form_of(&rows[number]), .program = program, .random = random_make(number + 1)};
    for (int k = 0; k < o->form.operands; k++)
        o->role[k] = spu_role_of(&rows[number], k);
    o->is_float = spu_is_left_to_exact(&rows[number]);
}

TEST(every_overload)
{
    static overload o;
    spu_program program;
    uint64_t called = 0, excused = 0;
    uint32_t failed = 0;
    spu_program_begin(&program, SPU_PROGRAM);
    for (uint32_t i = 0; i < TEST_COUNT(rows); i++) {
        overload_begin(&o, i, &program);
        check_overload(&o);
        called += o.calls;
        excused += o.excused;
        failed += o.wrong != 0;
        if (o.wrong)
            print_error("spu_%s: %u of %u calls differ\n", o.form.text, o.wrong, o.calls);
        if (o.excused && strcmp(o.form.word, "promote") != 0)
            print_message("spu_%s: %u elements differ as they may\n", o.form.text, o.excused);
    }
    spu_program_end(&program);
    print_message("%u overloads, %llu calls, %llu elements that may differ do\n", (unsigned)TEST_COUNT(rows),
                  (unsigned long long)called, (unsigned long long)excused);
    assert_int_equal(TEST_COUNT(rows), SPU_OVERLOADS);
    assert_int_equal(failed, 0);
}

VARIANT_SUITE("test_spu_compiled_words", NULL, NULL)
