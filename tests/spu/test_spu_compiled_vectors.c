/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words of vector.h as the SPU has them (simd/spux/spux_spu.h, spux_four.h), compiled by its own compiler and run
 * by the simulator, against the plain C of spux_four.h over the portable mapping in exact mode, bit by bit: words of
 * vectors and of memory at every alignment, doubles included. SPU_PROGRAM is the path of the program made of
 * spux_program.c. */
#include "support/test.h"
#include "support/suite.h"

#include <string.h>

#include "simd/spu_operands.h"
#include "spu/spu_program.h"
#include "spu/spux_calls.h"

#define ROUNDS 4096
#define BATCH (EXCHANGE_QUADS / SPUX_QUADS)

typedef struct spux_function {
    const char *name;
    spu_type memory; /* type of the elements there */
    void (*call)(spux_record *r);
} spux_function;

#define TYPE_OF(bits) ((bits) == 8 ? SPU_u8 : (bits) == 16 ? SPU_u16 : SPU_u32)
#define FUNCTION(name, bits) {#name, TYPE_OF(bits), call_##name},
static const spux_function functions[] = {SPUX_CALLS(FUNCTION)};

/* ---- records of both sides ---- */

/* Quads of a record that are memory come first. */
static spu_type type_of_quad(const spux_function *f, int quad) { return quad < 8 ? f->memory : SPU_u32; }

static void to_host(const spux_function *f, const spu_quad quad[SPUX_QUADS], spux_record *r)
{
    for (int i = 0; i < SPUX_QUADS; i++)
        spu_to_host(&quad[i], type_of_quad(f, i), (char *)r + 16 * i);
}
static void from_host(const spux_function *f, const spux_record *r, spu_quad quad[SPUX_QUADS])
{
    for (int i = 0; i < SPUX_QUADS; i++)
        quad[i] = spu_from_host((const char *)r + 16 * i, type_of_quad(f, i));
}

static void randomize(test_random *r, spu_quad quad[SPUX_QUADS])
{
    const spu_kind number = {SPU_f32, false}, bits = {SPU_u32, false};
    const bool repeats = random_below(r, 2); /* memory of few values, for what looks for one */
    for (int i = 0; i < 8; i++) {
        quad[i] = spu_random(r, number, SPU_DATA, NULL);
        for (int k = 0; repeats && k < 16; k++)
            quad[i].byte[k] = (uint8_t)random_below(r, 2);
    }
    quad[8] = spu_random(r, number, SPU_DATA, NULL);
    quad[9] = spu_random(r, number, SPU_DATA, random_below(r, 2) ? &quad[8] : NULL);
    quad[10] = spu_random(r, bits, SPU_DATA, NULL);
    for (int i = 0; i < 4; i++)
        spu_set(&quad[11], SPU_u32, i, random_below(r, 16));
    memset(&quad[12], 0, 4 * sizeof *quad);
}

/* ---- one function ---- */

static void report(const spux_function *f, int quad, const spu_quad *got, const spu_quad *expected)
{
    char text[48];
    print_error("spux_%s, quad %d\n", f->name, quad);
    print_error("    got       %s\n", spu_text(got, type_of_quad(f, quad), 16, text));
    print_error("    expected  %s\n", spu_text(expected, type_of_quad(f, quad), 16, text));
}

static uint32_t check_batch(spu_program *program, uint32_t number, test_random *random)
{
    static spu_quad before[BATCH][SPUX_QUADS], after[BATCH][SPUX_QUADS];
    const spux_function *f = &functions[number];
    uint32_t wrong = 0;
    for (int k = 0; k < BATCH; k++)
        randomize(random, before[k]);
    memcpy(after, before, sizeof after);
    spu_program_call(program, number, after[0], BATCH, SPUX_QUADS);
    for (int k = 0; k < BATCH; k++) {
        spux_record r;
        spu_quad expected[SPUX_QUADS];
        to_host(f, before[k], &r);
        f->call(&r);
        from_host(f, &r, expected);
        for (int i = 0; i < SPUX_QUADS; i++)
            if (memcmp(&after[k][i], &expected[i], sizeof expected[i]) != 0 && wrong++ < 3)
                report(f, i, &after[k][i], &expected[i]);
    }
    return wrong;
}

TEST(every_word)
{
    spu_program program;
    uint32_t failed = 0;
    spu_program_begin(&program, SPU_PROGRAM);
    for (uint32_t i = 0; i < TEST_COUNT(functions); i++) {
        test_random random = random_make(i + 1);
        uint32_t wrong = 0;
        for (uint32_t n = test_scaled(ROUNDS / BATCH); n; n--)
            wrong += check_batch(&program, i, &random);
        if (wrong)
            print_error("spux_%s: %u quads differ\n", functions[i].name, wrong);
        failed += wrong != 0;
    }
    spu_program_end(&program);
    assert_int_equal(failed, 0);
}

SEEDED_SUITE("test_spu_compiled_vectors", NULL, NULL)
