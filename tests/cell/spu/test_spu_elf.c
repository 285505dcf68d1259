/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * ELF files for an SPU: a good one is loaded, with its functions; each kind of bad one is refused by its sentence and
 * leaves the local store alone; damaged ones never crash. */
#include "support/test.h"
#include "support/suite.h"

#include <stdlib.h>
#include <string.h>

#include "cell/spu/elf.h"
#include "cell/spu/isa/assemble.h"
#include "cell/spu/timing/timing.h"
#include "core/memory.h"

/* The file: header, two segments (text with the entry, data with zeros behind it), symbols, names, three sections. */
enum {
    SEGMENTS = 52,
    TEXT = 128,
    DATA = 160,
    SYMBOLS = 176,
    NAMES = 256,
    SECTIONS = 288,
    BYTES = 288 + 3 * 40,
    TEXT_ADDRESS = 0x80,
    DATA_ADDRESS = 0x1000
};

typedef struct image {
    uint8_t bytes[BYTES];
} image;

static void put16(image *f, size_t at, uint32_t value)
{
    f->bytes[at] = (uint8_t)(value >> 8);
    f->bytes[at + 1] = (uint8_t)value;
}
static void put32(image *f, size_t at, uint32_t value)
{
    put16(f, at, value >> 16);
    put16(f, at + 2, value & 0xffff);
}

static void put_segment(image *f, int i, uint32_t offset, uint32_t address, uint32_t size, uint32_t memory)
{
    const size_t at = SEGMENTS + 32 * (size_t)i;
    put32(f, at, 1);
    put32(f, at + 4, offset);
    put32(f, at + 8, address);
    put32(f, at + 16, size);
    put32(f, at + 20, memory);
}

static void put_symbol(image *f, int i, uint32_t name, uint32_t address, uint32_t size, uint8_t kind)
{
    const size_t at = SYMBOLS + 16 * (size_t)i;
    put32(f, at, name);
    put32(f, at + 4, address);
    put32(f, at + 8, size);
    f->bytes[at + 12] = kind;
}

static void put_header(image *f)
{
    static const uint8_t start[] = {0x7f, 'E', 'L', 'F', 1, 2, 1};
    memcpy(f->bytes, start, sizeof start);
    put16(f, 16, 2);
    put16(f, 18, 23);
    put32(f, 20, 1);
    put32(f, 24, TEXT_ADDRESS);
    put32(f, 28, SEGMENTS);
    put32(f, 32, SECTIONS);
    put16(f, 40, 52);
    put16(f, 42, 32);
    put16(f, 44, 2);
    put16(f, 46, 40);
    put16(f, 48, 3);
}

/* il 3, 7; brsl 0, add_one; stop 1; add_one: ai 3, 3, 1; bi 0 */
static void put_text(image *f)
{
    uint32_t word[8];
    cgt_spu_assembler p = {.word = word, .capacity = 8, .address = TEXT_ADDRESS};
    CGT_SPU_ASM(&p, il, .rt = 3, .imm = 7);
    CGT_SPU_ASM(&p, brsl, .rt = 0, .imm = 8);
    CGT_SPU_ASM(&p, stop, .imm = 1);
    CGT_SPU_ASM(&p, ai, .rt = 3, .ra = 3, .imm = 1);
    CGT_SPU_ASM(&p, bi, .ra = 0);
    assert_false(p.failed);
    for (uint32_t i = 0; i < p.count; i++)
        put32(f, TEXT + 4 * i, word[i]);
}

static image make(void)
{
    static const char names[] = "\0main\0add_one\0table";
    image f = {{0}};
    put_header(&f);
    put_segment(&f, 0, TEXT, TEXT_ADDRESS, 20, 20);
    put_segment(&f, 1, DATA, DATA_ADDRESS, 16, 32);
    put_text(&f);
    memset(f.bytes + DATA, 0x5a, 16);
    put_symbol(&f, 1, 1, TEXT_ADDRESS, 12, 0x12);
    put_symbol(&f, 2, 6, TEXT_ADDRESS + 12, 8, 0x12);
    put_symbol(&f, 3, 14, DATA_ADDRESS, 32, 0x11);
    memcpy(f.bytes + NAMES, names, sizeof names);
    put32(&f, SECTIONS + 40 + 4, 2); /* section 1: symbols, their names in section 2 */
    put32(&f, SECTIONS + 40 + 16, SYMBOLS);
    put32(&f, SECTIONS + 40 + 20, 4 * 16);
    put32(&f, SECTIONS + 40 + 24, 2);
    put32(&f, SECTIONS + 80 + 4, 3);
    put32(&f, SECTIONS + 80 + 16, NAMES);
    put32(&f, SECTIONS + 80 + 20, sizeof names);
    return f;
}

TEST(good_file)
{
    cgt_spu *const spu = *state;
    const image f = make();
    memset(spu->local_store, 0xcc, CGT_SPU_LOCAL_STORE);
    assert_int_equal(cgt_spu_load_elf(spu, f.bytes, sizeof f.bytes, "good"), CGT_OK);
    assert_int_equal(spu->pc, TEXT_ADDRESS);
    assert_int_equal(cgt_spu_load32(spu, DATA_ADDRESS + 12), 0x5a5a5a5a);
    assert_int_equal(cgt_spu_load32(spu, DATA_ADDRESS + 16), 0); /* behind the file's bytes: zeros */
    assert_int_equal(cgt_spu_load32(spu, DATA_ADDRESS + 32), 0xcccccccc);
    const cgt_spu_end end = cgt_spu_run(spu, NULL, UINT64_MAX);
    assert_int_equal(end.reason, CGT_SPU_STOPPED);
    assert_int_equal(spu->reg[3].word[0], 8);
    assert_int_equal(spu->timing->functions, 2);
    assert_string_equal(spu->timing->function[0].name, "main");
    assert_int_equal(spu->timing->function[0].counts.instructions, 3);
    assert_string_equal(spu->timing->function[1].name, "add_one");
    assert_int_equal(spu->timing->function[1].counts.instructions, 2);
}

TEST(symbols)
{
    image f = make();
    uint32_t address = 0;
    assert_true(cgt_spu_find_symbol(f.bytes, sizeof f.bytes, "table", &address));
    assert_int_equal(address, DATA_ADDRESS);
    assert_false(cgt_spu_find_symbol(f.bytes, sizeof f.bytes, "tables", &address));
    assert_false(cgt_spu_find_symbol(f.bytes, sizeof f.bytes, "", &address));
    f.bytes[0] = 0;
    assert_false(cgt_spu_find_symbol(f.bytes, sizeof f.bytes, "table", &address));
}

typedef struct damage {
    size_t at;
    uint32_t value;
    int bytes;
    cgt_result result;
    const char *text;
} damage;

TEST(bad_files)
{
    cgt_spu *const spu = *state;
    static const damage bad[] = {
        {0, 0x7f454c47, 4, CGT_ERROR_INVALID_ARGUMENT, "bad: no ELF file"},
        {4, 0x02020000, 4, CGT_ERROR_INVALID_ARGUMENT, "no big-endian ELF file of 32 bits"},
        {4, 0x01010000, 4, CGT_ERROR_INVALID_ARGUMENT, "no big-endian ELF file of 32 bits"},
        {18, 21, 2, CGT_ERROR_INVALID_ARGUMENT, "another machine than the SPU"},
        {16, 1, 2, CGT_ERROR_INVALID_ARGUMENT, "not a linked program"},
        {44, 0, 2, CGT_ERROR_INVALID_ARGUMENT, "without segments"},
        {44, 1000, 2, CGT_ERROR_INVALID_ARGUMENT, "table of segments lies outside"},
        {28, 0xfffffff0, 4, CGT_ERROR_INVALID_ARGUMENT, "table of segments lies outside"},
        {24, 0x40000, 4, CGT_ERROR_INVALID_ARGUMENT, "does not begin in the local store"},
        {24, 2, 4, CGT_ERROR_INVALID_ARGUMENT, "does not begin in the local store"},
        {SEGMENTS + 32 + 4, 0xfffffff8, 4, CGT_ERROR_INVALID_ARGUMENT, "segment 1 lies outside the file"},
        {SEGMENTS + 32 + 16, 40, 4, CGT_ERROR_INVALID_ARGUMENT, "segment 1 lies outside the file"},
        {SEGMENTS + 32 + 20, 0x3f001, 4, CGT_ERROR_TOO_LARGE, "segment 1, 258049 bytes at 0x1000, does not fit"},
        {SEGMENTS + 32 + 8, 0x40001, 4, CGT_ERROR_TOO_LARGE, "does not fit the local store"},
    };
    for (size_t i = 0; i < TEST_COUNT(bad); i++) {
        image f = make();
        memset(spu->local_store, 0xcc, CGT_SPU_LOCAL_STORE);
        if (bad[i].bytes == 2)
            put16(&f, bad[i].at, bad[i].value);
        else
            put32(&f, bad[i].at, bad[i].value);
        assert_int_equal(cgt_spu_load_elf(spu, f.bytes, sizeof f.bytes, "bad"), bad[i].result);
        if (!strstr(spu->message, bad[i].text))
            fail_msg("\"%s\" does not say \"%s\"", spu->message, bad[i].text);
        for (uint32_t at = 0; at < 0x2000; at += 4)
            assert_int_equal(cgt_spu_load32(spu, at), 0xcccccccc);
    }
    image f = make();
    put32(&f, SEGMENTS, 4);
    put32(&f, SEGMENTS + 32, 4);
    assert_int_equal(cgt_spu_load_elf(spu, f.bytes, sizeof f.bytes, "bad"), CGT_ERROR_INVALID_ARGUMENT);
    assert_string_equal(spu->message, "bad: an ELF file with nothing to load");
    assert_int_equal(cgt_spu_load_elf(spu, NULL, 0, "bad"), CGT_ERROR_INVALID_ARGUMENT);
}

/* Cut at every length, in memory of that length, and with bytes changed: whatever happens, nothing is read outside. */
TEST(damaged_files)
{
    cgt_spu *const spu = *state;
    test_random r = random_make(295);
    uint32_t address;
    for (size_t size = 0; size <= BYTES; size++) {
        const image f = make();
        uint8_t *const cut = malloc(size ? size : 1);
        assert_non_null(cut);
        memcpy(cut, f.bytes, size);
        (void)cgt_spu_load_elf(spu, cut, size, "cut");
        (void)cgt_spu_find_symbol(cut, size, "table", &address);
        free(cut);
    }
    for (uint32_t n = test_scaled(20000); n > 0; n--) {
        image f = make();
        for (uint32_t k = 1 + random_below(&r, 4); k > 0; k--)
            f.bytes[16 + random_below(&r, BYTES - 16)] = (uint8_t)random_bits(&r);
        uint8_t *const copy = malloc(BYTES);
        assert_non_null(copy);
        memcpy(copy, f.bytes, BYTES);
        (void)cgt_spu_load_elf(spu, copy, BYTES, "damaged");
        (void)cgt_spu_find_symbol(copy, BYTES, "table", &address);
        free(copy);
    }
}

/* ---- memory refused ---- */

static void *refuse(void *user, size_t bytes, size_t alignment)
{
    (void)user, (void)bytes, (void)alignment;
    return NULL;
}

TEST(without_memory)
{
    cgt_spu *const spu = *state;
    const image f = make();
    const cgt_memory_hooks hooks = spu->memory;
    spu->memory.allocate = refuse;
    assert_int_equal(cgt_spu_load_elf(spu, f.bytes, sizeof f.bytes, "good"), CGT_ERROR_OUT_OF_MEMORY);
    spu->memory = hooks;
    assert_int_equal(cgt_spu_run(spu, NULL, UINT64_MAX).reason, CGT_SPU_STOPPED); /* loaded all the same */
}

static int set_up(void **state)
{
    static cgt_spu spu;
    const cgt_memory_hooks memory = cgt_memory_default();
    *state = &spu;
    return cgt_spu_create(&spu, &memory, CGT_SPU_TIMED) == CGT_OK ? 0 : -1;
}
static int tear_down(void **state)
{
    cgt_spu_destroy(*state);
    return 0;
}

SEEDED_SUITE("test_spu_elf", set_up, tear_down)
