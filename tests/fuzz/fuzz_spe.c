/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Fuzz target: hostile programs on up to 16 simulated SPEs. The input makes a program: DMA commands and lists with any
 * addresses, sizes, tags and codes, accesses of any channel, mailboxes that nobody reads or fills, branches, words of
 * any bits; and a PPE that answers to anyone. A run ends with success or a sentence, reads and writes the regions of
 * the cell alone, and is the same when it is repeated. */
#include <stdlib.h>
#include <string.h>

#include "cell/machine/machine.h"
#include "cell/spu/isa/assemble.h"
#include "core/memory.h"
#include "fuzz/fuzz.h"
#include "spu_mfcio.h"

#define WORDS 512u /* of a program */
#define LISTS 0x4000u
#define LIST_WORDS 32u
#define MEMORY_EA UINT64_C(0x10000)
#define CONSTANT_EA UINT64_C(0x20000)
#define MEMORY_WORDS 1024u
#define CONSTANT_WORDS 256u
#define CYCLES 100000u

typedef struct code {
    uint32_t word[WORDS], list[LIST_WORDS];
    cgt_spu_assembler assembler;
    unsigned spes;
    cgt_spu_mode mode;
} code;

/* Mostly what commands take, or next to it. */
static uint32_t any_number(fuzz_bytes *b)
{
    static const uint32_t numbers[] = {
        0,          1,          2,          4,          8,          12,         16,         128,
        1024,       0x1000,     LISTS,      0x4080,     16384,      16400,      0x10000,    0x10080,
        0x10ff0,    0x20000,    0x203f0,    0x3fff0,    0x3fff8,    0x40000,    0xe0000000, 0xe0004000,
        0xe0080000, 0xe005400c, 0xe7800000, 0x7fffffff, 0x80000000, 0xfffffff0, 0xffffffff, 31};
    const uint32_t number = numbers[fuzz_below(b, sizeof numbers / sizeof numbers[0])];
    switch (fuzz_below(b, 8)) {
    case 0: return fuzz_word(b);
    case 1: return number + fuzz_byte(b) - 128;
    default: return number;
    }
}

static void write_channel(cgt_spu_assembler *p, unsigned channel, uint32_t value)
{
    CGT_SPU_ASM(p, ilhu, .rt = 13, .imm = (int32_t)(value >> 16));
    CGT_SPU_ASM(p, iohl, .rt = 13, .imm = (int32_t)(value & 0xffff));
    CGT_SPU_ASM(p, wrch, .rt = 13, .ra = channel);
}

/* A command that may be right: half of the numbers are taken from those that are. */
static void add_command(fuzz_bytes *b, cgt_spu_assembler *p)
{
    static const uint32_t commands[] = {MFC_GET_CMD,     MFC_PUT_CMD,    MFC_GETF_CMD,    MFC_PUTB_CMD,
                                        MFC_GETL_CMD,    MFC_PUTL_CMD,   MFC_GETLLAR_CMD, MFC_PUTLLC_CMD,
                                        MFC_PUTLLUC_CMD, MFC_SNDSIG_CMD, MFC_BARRIER_CMD, MFC_SYNC_CMD};
    const uint8_t how = fuzz_byte(b);
    const uint32_t command = commands[fuzz_below(b, sizeof commands / sizeof commands[0])], good_ea = MEMORY_EA;
    write_channel(p, MFC_LSA, how & 1 ? any_number(b) : LISTS + 128);
    write_channel(p, MFC_EAH, how & 2 ? any_number(b) : 0);
    write_channel(p, MFC_EAL,
                  how & 4                                              ? any_number(b)
                  : command == MFC_GETL_CMD || command == MFC_PUTL_CMD ? LISTS
                                                                       : good_ea);
    write_channel(p, MFC_Size, how & 8 ? any_number(b) : 128);
    write_channel(p, MFC_TagID, how & 16 ? any_number(b) : 3);
    write_channel(p, MFC_Cmd, how >= 224 ? fuzz_word(b) : command);
}

static void add_step(fuzz_bytes *b, cgt_spu_assembler *p)
{
    switch (fuzz_below(b, 8)) {
    case 0: write_channel(p, fuzz_below(b, 128), any_number(b)); break;
    case 1: CGT_SPU_ASM(p, rdch, .rt = fuzz_below(b, 128), .ra = fuzz_below(b, 128)); break;
    case 2: CGT_SPU_ASM(p, rchcnt, .rt = 12, .ra = fuzz_below(b, 128)); break;
    case 3:
        write_channel(p, MFC_WrTagMask, 1u << 3);
        write_channel(p, MFC_WrTagUpdate, fuzz_below(b, 3));
        CGT_SPU_ASM(p, rdch, .rt = 12, .ra = MFC_RdTagStat);
        break;
    case 4: cgt_spu_emit_word(p, fuzz_word(b)); break;
    case 5: CGT_SPU_ASM(p, brnz, .rt = 12, .imm = cgt_spu_distance(p, 4 * fuzz_below(b, 200))); break;
    default: add_command(b, p); break;
    }
}

static void make_code(fuzz_bytes *b, code *c)
{
    const uint8_t spes = fuzz_byte(b);
    c->assembler = (cgt_spu_assembler){.word = c->word, .capacity = WORDS - 1};
    c->spes = spes < 192 ? 1 + spes % 2 : 1 + spes % CGT_MAX_SPES;
    c->mode = fuzz_byte(b) & 1 ? CGT_SPU_TIMED : CGT_SPU_UNTIMED;
    for (uint32_t i = 0; i < LIST_WORDS; i++)
        c->list[i] = any_number(b);
    while (b->left && c->assembler.count + 24 < WORDS)
        add_step(b, &c->assembler);
    FUZZ_CHECK(!c->assembler.failed, "a step that cannot be assembled");
    CGT_SPU_ASM(&c->assembler, stop, .imm = 1);
}

/* Answers with what it got, to a number that may be no SPE's. */
static void answer(void *user, cgt_cell *cell, const cgt_ppe_event *event)
{
    uint32_t *const events = user;
    uint32_t word = event->value;
    ++*events;
    if (event->kind == CGT_PPE_MAILBOX)
        (void)cgt_cell_send_mailbox(cell, (event->spe + word) % 20, word);
    else if (event->kind == CGT_PPE_INTERRUPT)
        cgt_cell_send_signal(cell, word % 20, word % 3, word);
    (void)cgt_cell_write(cell, MEMORY_EA + word, &word, sizeof word);
}

typedef struct outcome {
    cgt_result result;
    char message[CGT_CELL_MESSAGE_BYTES];
    uint32_t events, *memory, *constant;
} outcome;

static void run(code *c, outcome *o)
{
    const cgt_memory_hooks hooks = cgt_memory_default();
    cgt_spu *const spu = fuzz_allocate(c->spes * sizeof *spu);
    cgt_spe_unit unit[CGT_MAX_SPES];
    cgt_cell *cell;
    o->events = 0;
    o->memory = memset(fuzz_allocate(4 * MEMORY_WORDS), 0x11, 4 * MEMORY_WORDS);
    o->constant = memset(fuzz_allocate(4 * CONSTANT_WORDS), 0x22, 4 * CONSTANT_WORDS);
    FUZZ_CHECK(cgt_cell_create(&(cgt_cell_options){.spes = c->spes, .cycle_limit = CYCLES}, &cell) == CGT_OK &&
                   cgt_cell_add_memory(cell, MEMORY_EA, o->memory, MEMORY_WORDS, 4, true) == CGT_OK &&
                   cgt_cell_add_memory(cell, CONSTANT_EA, o->constant, CONSTANT_WORDS, 4, false) == CGT_OK,
               "no cell");
    for (unsigned i = 0; i < c->spes; i++) {
        FUZZ_CHECK(cgt_spu_create(&spu[i], &hooks, c->mode) == CGT_OK, "no SPU");
        for (uint32_t k = 0; k < LIST_WORDS; k++)
            cgt_spu_store32(&spu[i], LISTS + 4 * k, c->list[k]);
        FUZZ_CHECK(cgt_spu_assembler_load(&c->assembler, &spu[i]), "no program");
        unit[i] = cgt_cell_unit_of(&spu[i], i, MEMORY_EA, CONSTANT_EA);
    }
    o->result = cgt_cell_run_simulated(cell, unit, answer, &o->events);
    memcpy(o->message, cgt_cell_get_message(cell), sizeof o->message);
    cgt_cell_destroy(cell);
    for (unsigned i = 0; i < c->spes; i++)
        cgt_spu_destroy(&spu[i]);
    free(spu);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static code c; /* of one input at a time */
    static outcome o, again;
    fuzz_bytes b = fuzz_bytes_of(data, size);
    make_code(&b, &c);
    run(&c, &o);
    FUZZ_CHECK(o.result == CGT_OK || o.result == CGT_ERROR_STOPPED, "%d: %s", (int)o.result, o.message);
    FUZZ_CHECK((o.result == CGT_OK) == !*o.message, "%d, and the message: %s", (int)o.result, o.message);
    for (uint32_t i = 0; i < CONSTANT_WORDS; i++)
        FUZZ_CHECK(o.constant[i] == 0x22222222, "word %u of memory that is read only is written", i);
    run(&c, &again);
    FUZZ_CHECK(again.result == o.result && !strcmp(again.message, o.message) && again.events == o.events &&
                   !memcmp(again.memory, o.memory, 4 * MEMORY_WORDS),
               "another run ends in another way: %s / %s", o.message, again.message);
    free(o.memory), free(o.constant);
    free(again.memory), free(again.constant);
    return 0;
}
