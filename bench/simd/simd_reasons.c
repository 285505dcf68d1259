/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * cgt-bench simd: mapped words that take more time than their native forms, and the reasons. */
#include "simd/simd_rows.h"

#include <string.h>

typedef struct reason {
    const char *variants; /* with spaces between; "*": all */
    const char *words;    /* with spaces between; "*": all */
    const char *kinds;    /* of the first operand, with spaces between; "*": all */
    int count;            /* a simd_count, or ANY_COUNT */
    const char *text;
} reason;

#define ANY_COUNT (-1)
#define EXACT "sse+exact neon+exact avx2+exact avx512+exact"

/* The first match is used. */
static const reason reasons[] = {
    {"portable", "*", "*", ANY_COUNT, "plain C"},
    {"portable+exact", "*", "*", ANY_COUNT, "the SPU's arithmetic in integers, element by element"},
    {EXACT, "spu_re spu_rsqrte", "*", ANY_COUNT, "the SPU's estimates: its tables and its interpolation, in integers"},
    {EXACT, "*", "*", ANY_COUNT,
     "the SPU's arithmetic: exponent 255 is looked for, zeros become +0, "
     "rounding is held"},

    /* scalars */
    {"*", "spu_extract spu_insert", "*", SIMD_VARIABLE, "any position: the vector goes through memory"},
    {"*", "spu_promote", "*", ANY_COUNT, "all elements hold the scalar; an SPU leaves the others open"},

    /* conversion */
    {"*", "spu_convts", "*", ANY_COUNT, "saturates, and takes NaN to 0"},
    {"*", "spu_convtu", "*", ANY_COUNT, "saturates, and takes negative numbers and NaN to 0"},

    /* arithmetic */
    {"*", "spu_nmadd spu_nmsub", "f64", ANY_COUNT, "negates what has been rounded: a zero's sign is the SPU's"},
    {"*", "spu_mulo", "u16", ANY_COUNT, "the scalar goes to halfwords, and from there to words"},
    {"*", "spu_rsqrte", "*", ANY_COUNT, "clears the sign first, as an SPU does"},
    {"neon", "spu_re spu_rsqrte", "*", ANY_COUNT, "a step of Newton's: the table alone has eight bits"},

    /* comparison, bits */
    {"*", "spu_testsv", "*", ANY_COUNT,
     "any of seven classes; the native form knows that all that is not finite "
     "is meant"},
    {"sse", "spu_cmpgt", "u8", ANY_COUNT, "the compiler's own comparison: subtracts and compares with zero twice"},
    {"avx512", "spu_cmpgt", "u8 u16 u32", ANY_COUNT,
     "the compiler's own comparison, which does without mask registers"},
    {"*", "spu_gather", "*", ANY_COUNT, "the SPU's order of bits, and the result in a vector"},
    {"*", "spu_sel", "*", ANY_COUNT, "bit by bit; spux_select chooses by lanes"},
    {"*", "spu_shuffle", "*", SIMD_VARIABLE, "patterns may have constant bytes, and count bytes as an SPU does"},
    {"*", "spu_maskb spu_maskh spu_maskw", "*", ANY_COUNT, "the SPU's order of bits"},

    /* logic */
    {"sse", "spu_and spu_or spu_xor", "*", ANY_COUNT, "the same instructions and, once in four, a copy of a register"},
    {"avx512", "spu_orc spu_nand spu_nor spu_eqv", "*", ANY_COUNT,
     "the compiler takes a second instruction for the not"},

    /* shifts */
    {"*", "spu_sl spu_sr spu_sra spu_rlmask spu_rlmaska", "*", ANY_COUNT,
     "counts modulo twice the width; from the width on nothing or the sign is "
     "left"},
    {"*", "spu_rl", "*", ANY_COUNT, "counts modulo the width"},
    {"*", "spu_slqw spu_srqw spu_rlqw spu_rlmaskqw", "*", ANY_COUNT, "counts modulo 8"},
    {"neon",
     "spu_slqwbyte spu_srqwbyte spu_rlqwbyte spu_rlmaskqwbyte "
     "spu_slqwbytebc spu_srqwbytebc spu_rlqwbytebc spu_rlmaskqwbytebc "
     "spu_shuffle",
     "*", SIMD_CONSTANT,
     "a table look-up for any count or pattern; for this one there is an "
     "instruction"},
    {"*", "spu_rlqwbyte spu_rlqwbytebc", "*", SIMD_CONSTANT,
     "a byte shuffle for any count; half a turn has a quicker one"},
    {"*",
     "spu_slqwbyte spu_srqwbyte spu_rlqwbyte spu_rlmaskqwbyte "
     "spu_slqwbytebc spu_srqwbytebc spu_rlqwbytebc spu_rlmaskqwbytebc",
     "*", SIMD_VARIABLE,
     "any count, in the SPU's order of bytes; the native form moves whole "
     "elements within 16 bytes"},

    /* extension words */
    {"avx512", "spux_mask_first", "*", ANY_COUNT, "any count, not only up to 16"},
    {"avx2", "spux_any spux_all", "*", ANY_COUNT, "to a bool and from there to a number"},
    {"neon", "spux_min spux_max", "vfloat", ANY_COUNT, "b where a and b do not compare: fmin gives the other one"},
};

static bool has(const char *list, const char *name)
{
    const size_t length = strlen(name);
    if (strcmp(list, "*") == 0)
        return true;
    for (const char *p = list; *p; p += *p == ' ') {
        const size_t n = strcspn(p, " ");
        if (n == length && strncmp(p, name, n) == 0)
            return true;
        p += n;
    }
    return false;
}

const char *simd_reason(const char *variant, const simd_row *row)
{
    for (size_t i = 0; i < sizeof reasons / sizeof reasons[0]; i++)
        if (has(reasons[i].variants, variant) && has(reasons[i].words, row->word) &&
            has(reasons[i].kinds, simd_kind_name(row->operand[0])) &&
            (reasons[i].count == ANY_COUNT || reasons[i].count == (int)row->count))
            return reasons[i].text;
    return NULL;
}
