/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: kinds of operands, and the numbers that the words are
 * measured on. Integers are random bits, floats random between 1/2 and 4: no
 * word meets a denormal, and no conversion overflows. */
#include "simd/simd_rows.h"

#include <stdint.h>
#include <string.h>

/* ---- kinds ---- */

typedef struct kind {
    const char *name;
    int bytes;    /* of an element */
    int elements; /* 0: as many as the variant has lanes; 1 and scalar: a single number */
    bool is_float;
} kind;

static const kind kinds[] = {
    [SIMD_NONE] = {"", 1, 1, false},
    [SIMD_u8] = {"u8", 1, 16, false},
    [SIMD_s8] = {"s8", 1, 16, false},
    [SIMD_u16] = {"u16", 2, 8, false},
    [SIMD_s16] = {"s16", 2, 8, false},
    [SIMD_u32] = {"u32", 4, 4, false},
    [SIMD_s32] = {"s32", 4, 4, false},
    [SIMD_u64] = {"u64", 8, 2, false},
    [SIMD_s64] = {"s64", 8, 2, false},
    [SIMD_f32] = {"f32", 4, 4, true},
    [SIMD_f64] = {"f64", 8, 2, true},
    [SIMD_x_u8] = {"x_u8", 1, 1, false},
    [SIMD_x_s8] = {"x_s8", 1, 1, false},
    [SIMD_x_u16] = {"x_u16", 2, 1, false},
    [SIMD_x_s16] = {"x_s16", 2, 1, false},
    [SIMD_x_u32] = {"x_u32", 4, 1, false},
    [SIMD_x_s32] = {"x_s32", 4, 1, false},
    [SIMD_x_u64] = {"x_u64", 8, 1, false},
    [SIMD_x_s64] = {"x_s64", 8, 1, false},
    [SIMD_x_f32] = {"x_f32", 4, 1, true},
    [SIMD_x_f64] = {"x_f64", 8, 1, true},
    [SIMD_n_scale] = {"n_scale", 4, 1, false},
    [SIMD_n_special] = {"n_special", 4, 1, false},
    [SIMD_vf] = {"vfloat", 4, 0, true},
    [SIMD_vi] = {"vint", 4, 0, false},
    [SIMD_vu] = {"vuint", 4, 0, false},
    [SIMD_vm] = {"vmask", 4, 0, false},
};

const char *simd_kind_name(simd_kind k) { return kinds[k].name; }

int simd_kind_elements(simd_kind k, int lanes) { return kinds[k].elements ? kinds[k].elements : lanes; }

/* masks of sixteen lanes are sixteen bits */
static bool is_mask_register(simd_kind k, int lanes) { return k == SIMD_vm && lanes == 16; }

size_t simd_kind_bytes(simd_kind k, int lanes)
{
    if (is_mask_register(k, lanes))
        return 2;
    return (size_t)kinds[k].bytes * (size_t)simd_kind_elements(k, lanes);
}

static bool is_wide(simd_kind k) { return k >= SIMD_vf; }

int simd_row_vectors(const simd_row *row, int lanes)
{
    const bool wide = is_wide(row->result) || is_wide(row->operand[0]) || is_wide(row->operand[1]);
    return SIMD_BYTES / (wide ? 4 * lanes : 16);
}

int simd_row_lanes(const simd_row *row, int lanes)
{
    int most = simd_kind_elements(row->operand[0], lanes);
    for (int i = 1; i < 3; i++)
        if (row->operand[i] && simd_kind_elements(row->operand[i], lanes) > most && most == 1)
            most = simd_kind_elements(row->operand[i], lanes);
    return most > 1 ? most : simd_kind_elements(row->result, lanes);
}

/* ---- numbers ---- */

/* splitmix64 */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

/* Operands whose numbers have a meaning: step * k. The elements that are meant
 * are those of operand `like`. */
typedef enum role_unit {
    BY_NUMBER,        /* k below count */
    BY_WIDTH,         /* k below the bits of an element */
    BY_ELEMENT,       /* k below the elements */
    BY_ELEMENT_BYTES, /* likewise, times the bytes of an element: shifts that move
                       whole elements */
    BY_MASK           /* all ones or zero */
} role_unit;
typedef struct role {
    const char *word;
    int operand;
    role_unit unit;
    int step;
    int count;
    int like;
} role;

static const role roles[] = {
    {"spu_extract", 1, BY_ELEMENT, 1, 0, 0},
    {"spu_insert", 2, BY_ELEMENT, 1, 0, 1},
    {"spu_promote", 1, BY_NUMBER, 1, 2, 0},
    {"spu_sl", 1, BY_WIDTH, 1, 0, 0},
    {"spu_sr", 1, BY_WIDTH, 1, 0, 0},
    {"spu_sra", 1, BY_WIDTH, 1, 0, 0},
    {"spu_rl", 1, BY_WIDTH, 1, 0, 0},
    {"spu_rlmask", 1, BY_WIDTH, -1, 0, 0},
    {"spu_rlmaska", 1, BY_WIDTH, -1, 0, 0},
    {"spu_slqw", 1, BY_NUMBER, 1, 8, 0},
    {"spu_srqw", 1, BY_NUMBER, 1, 8, 0},
    {"spu_rlqw", 1, BY_NUMBER, 1, 8, 0},
    {"spu_rlmaskqw", 1, BY_NUMBER, -1, 8, 0},
    {"spu_slqwbyte", 1, BY_ELEMENT_BYTES, 1, 0, 0},
    {"spu_srqwbyte", 1, BY_ELEMENT_BYTES, 1, 0, 0},
    {"spu_rlqwbyte", 1, BY_ELEMENT_BYTES, 1, 0, 0},
    {"spu_rlmaskqwbyte", 1, BY_ELEMENT_BYTES, -1, 0, 0},
    {"spu_slqwbytebc", 1, BY_ELEMENT_BYTES, 8, 0, 0},
    {"spu_srqwbytebc", 1, BY_ELEMENT_BYTES, 8, 0, 0},
    {"spu_rlqwbytebc", 1, BY_ELEMENT_BYTES, 8, 0, 0},
    {"spu_rlmaskqwbytebc", 1, BY_ELEMENT_BYTES, -8, 0, 0},
    {"spu_shuffle", 2, BY_NUMBER, 1, 32, 0},
    {"spu_sel", 2, BY_MASK, 1, 0, 0},
    {"spu_gather", 0, BY_MASK, 1, 0, 0},
    {"spux_permute", 1, BY_ELEMENT, 1, 0, 0},
    {"spux_gather", 0, BY_NUMBER, 1, 256, 0},
    {"spux_load_unaligned", 0, BY_NUMBER, 1, 16, 0},
    {"spux_mask_first", 0, BY_NUMBER, 1, 17, 0},
};

static const role *find_role(const simd_row *row, int operand)
{
    for (size_t i = 0; i < sizeof roles / sizeof roles[0]; i++)
        if (roles[i].operand == operand && strcmp(roles[i].word, row->word) == 0)
            return &roles[i];
    return NULL;
}

static int64_t role_value(const role *r, const simd_row *row, int lanes, uint64_t random)
{
    const simd_kind like = row->operand[r->like];
    const int bytes = kinds[like].bytes, elements = simd_kind_elements(like, lanes);
    switch (r->unit) {
    case BY_WIDTH: return r->step * (int64_t)(random % (8u * (unsigned)bytes));
    case BY_ELEMENT: return r->step * (int64_t)(random % (unsigned)elements);
    case BY_ELEMENT_BYTES: return r->step * bytes * (int64_t)(random % (unsigned)elements);
    case BY_MASK: return -(int64_t)(random & 1);
    default: return r->step * (int64_t)(random % (unsigned)r->count);
    }
}

static double number(uint64_t random) { return 0.5 + (double)(random >> 11) * (0x1p-53 * 3.5); }

static void put_element(unsigned char *to, const kind *k, bool is_number, uint64_t random, int64_t integer)
{
    if (k->is_float && !is_number) {
        const double d = number(random);
        const float f = (float)d;
        memcpy(to, k->bytes == 4 ? (const void *)&f : (const void *)&d, (size_t)k->bytes);
        return;
    }
    const uint64_t bits = is_number ? (uint64_t)integer : random;
    const uint8_t u8 = (uint8_t)bits;
    const uint16_t u16 = (uint16_t)bits;
    const uint32_t u32 = (uint32_t)bits;
    switch (k->bytes) {
    case 1: memcpy(to, &u8, 1); break;
    case 2: memcpy(to, &u16, 2); break;
    case 4: memcpy(to, &u32, 4); break;
    default: memcpy(to, &bits, 8); break;
    }
}

static void fill_array(unsigned char array[SIMD_BYTES], const simd_row *row, int operand, int lanes)
{
    const simd_kind this_kind = row->operand[operand];
    const role *r = find_role(row, operand);
    kind k = kinds[this_kind];
    if (is_mask_register(this_kind, lanes))
        k.bytes = 2;
    const bool is_mask = this_kind == SIMD_vm && !is_mask_register(this_kind, lanes);
    uint64_t state = (uint64_t)operand * 12345 + 1;
    for (size_t at = 0; at < SIMD_BYTES; at += (size_t)k.bytes) {
        const uint64_t random = next(&state);
        const int64_t integer = is_mask ? -(int64_t)(random & 1) : r ? role_value(r, row, lanes, random) : 0;
        put_element(array + at, &k, is_mask || r, random, integer);
    }
}

void simd_fill(simd_memory *memory, const simd_row *row, int lanes)
{
    const kind floats = kinds[SIMD_f32];
    uint64_t state = 99;
    fill_array(memory->a, row, 0, lanes);
    fill_array(memory->b, row, 1, lanes);
    fill_array(memory->c, row, 2, lanes);
    memset(memory->result, 0, sizeof memory->result);
    for (size_t at = 0; at < SIMD_BYTES; at += 4)
        put_element(memory->table + at, &floats, false, next(&state), 0);
}
