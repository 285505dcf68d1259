/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Edges and random operands. */
#include "simd/spu_operands.h"

/* cut to the width of the type: each width has its own least, most, sign bit and neighbours among them */
static const uint64_t int_edges[] = {0,
                                     1,
                                     2,
                                     3,
                                     0x7f,
                                     0x80,
                                     0x81,
                                     0xfe,
                                     0xff,
                                     0x100,
                                     0x7fff,
                                     0x8000,
                                     0x8001,
                                     0xfffe,
                                     0xffff,
                                     0x10000,
                                     0x7fffffff,
                                     0x80000000,
                                     0x80000001,
                                     0xfffffffe,
                                     0xffffffff,
                                     UINT64_C(0x100000000),
                                     UINT64_C(0x7fffffffffffffff),
                                     UINT64_C(0x8000000000000000),
                                     UINT64_C(0x8000000000000001),
                                     UINT64_C(0xfffffffffffffffe),
                                     UINT64_C(0xffffffffffffffff),
                                     UINT64_C(0x5555555555555555),
                                     UINT64_C(0xaaaaaaaaaaaaaaaa),
                                     UINT64_C(0x0123456789abcdef),
                                     UINT64_C(0xfedcba9876543210)};

/* each with either sign */
static const uint32_t float_edges[] = {
    0x00000000, /* 0 */
    0x00000001, /* least denormal */
    0x00400000, /* 2^-127 */
    0x007fffff, /* most denormal */
    0x00800000, /* FLT_MIN */
    0x3f000000, /* 0.5 */
    0x3f7fffff, /* below 1 */
    0x3f800000, /* 1 */
    0x3f800001, /* above 1 */
    0x3f800002, /* the square of the last, rounded */
    0x3fc00000, /* 1.5 */
    0x4b000001, /* 2^23 + 1 */
    0x4effffff, /* below 2^31 */
    0x4f000000, /* 2^31 */
    0x4f7fffff, /* below 2^32 */
    0x4f800000, /* 2^32 */
    0x7f7fffff, /* FLT_MAX */
    0x7f800000, /* infinity */
    0x7fc00000, /* NaN */
    0x7f800001, /* signalling NaN */
};

static const uint64_t double_edges[] = {
    0,
    1,
    UINT64_C(0x000fffffffffffff), /* most denormal */
    UINT64_C(0x0010000000000000), /* DBL_MIN */
    UINT64_C(0x3690000000000000), /* 2^-150: half of the least float */
    UINT64_C(0x3690000000000001), /* above it */
    UINT64_C(0x380fffffe0000000), /* a denormal of float */
    UINT64_C(0x3810000000000000), /* FLT_MIN */
    UINT64_C(0x3fe0000000000000), /* 0.5 */
    UINT64_C(0x3fefffffffffffff), /* below 1 */
    UINT64_C(0x3ff0000000000000), /* 1 */
    UINT64_C(0x3ff0000000000001), /* above 1 */
    UINT64_C(0x3ff0000000000002), /* the square of the last, rounded */
    UINT64_C(0x3ff0000010000000), /* half-way between two floats */
    UINT64_C(0x47efffffe0000000), /* FLT_MAX */
    UINT64_C(0x47effffff0000000), /* the least that rounds to the infinity of float */
    UINT64_C(0x7fefffffffffffff), /* DBL_MAX */
    UINT64_C(0x7ff0000000000000), /* infinity */
    UINT64_C(0x7ff8000000000000), /* NaN */
    UINT64_C(0x7ff0000000000001), /* signalling NaN */
};

#define COUNT_MOST 200
static const uint32_t count_edges[] = {0x7fffffff, 0x80000000, 0x80000001, 0x7ffffff8,
                                       0xff00ff00, 0x0000ffe0, 0x00010000, 0x00ffffff};

static uint32_t edge_values(spu_type type, spu_role role)
{
    switch (role) {
    case SPU_COUNT: return 2 * COUNT_MOST + 1 + TEST_COUNT(count_edges);
    case SPU_0_TO_127: return 128;
    default: break;
    }
    return type == SPU_f32   ? 2 * TEST_COUNT(float_edges)
           : type == SPU_f64 ? 2 * TEST_COUNT(double_edges)
                             : TEST_COUNT(int_edges);
}

static uint64_t edge_value(spu_type type, spu_role role, uint32_t e)
{
    e %= edge_values(type, role);
    if (role == SPU_0_TO_127)
        return e;
    if (role == SPU_COUNT)
        return e <= 2 * COUNT_MOST ? (uint64_t)e - COUNT_MOST : count_edges[e - 2 * COUNT_MOST - 1];
    if (type == SPU_f32)
        return float_edges[e / 2] | (e & 1 ? 0x80000000 : 0);
    if (type == SPU_f64)
        return double_edges[e / 2] | (e & 1 ? UINT64_C(1) << 63 : 0);
    return int_edges[e];
}

uint32_t spu_edge_count(spu_kind kind, spu_role role) { return edge_values(kind.type, role); }

/* A scalar's value lies in element 0; the others are zero. */
static int used_elements(spu_kind kind) { return kind.is_scalar ? 1 : spu_elements(kind.type); }

spu_quad spu_edge(spu_kind kind, spu_role role, uint32_t e)
{
    spu_quad quad = {{0}};
    for (int i = 0; i < used_elements(kind); i++)
        spu_set(&quad, kind.type, i, edge_value(kind.type, role, e + (uint32_t)i));
    return quad;
}

/* Floats of either sign within 2^20 of 1, where sums and products lose bits and do not leave the range. */
static uint64_t near_one(test_random *r, spu_type type)
{
    const uint64_t bits = random_bits(r), exponent = random_below(r, 41);
    if (type == SPU_f32)
        return (bits & 0x807fffff) | (exponent + 127 - 20) << 23;
    return (bits & UINT64_C(0x800fffffffffffff)) | (exponent + 1023 - 20) << 52;
}

static uint64_t random_value(test_random *r, spu_type type, spu_role role)
{
    if (role == SPU_0_TO_127)
        return random_below(r, 128);
    const uint32_t choice = random_below(r, 4);
    if (choice == 0 || (choice == 1 && role == SPU_COUNT))
        return edge_value(type, role, random_below(r, edge_values(type, role)));
    if (choice == 1 && spu_is_float(type))
        return near_one(r, type);
    return choice == 1 ? random_below(r, 16) : random_bits(r);
}

spu_quad spu_random(test_random *r, spu_kind kind, spu_role role, const spu_quad *other)
{
    spu_quad quad = {{0}};
    const bool copies = other && role == SPU_DATA && random_below(r, 2);
    for (int i = 0; i < used_elements(kind); i++) {
        const bool copy = copies && random_below(r, 2);
        spu_set(&quad, kind.type, i, copy ? spu_get(other, kind.type, i) : random_value(r, kind.type, role));
    }
    return quad;
}

/* ---- the operands that an overload meets ---- */

#define LONG_LIST 64 /* a longer list of edges meets random partners, not all the edges of its partner */

void spu_random_operands(test_random *r, const spu_form *form, const spu_role role[3], spu_quad in[3])
{
    for (int k = 0; k < 3; k++)
        in[k] = k < form->operands ? spu_random(r, form->operand[k], role[k], k ? &in[0] : NULL) : (spu_quad){{0}};
}

static uint32_t edges(const spu_form *form, const spu_role role[3], int k)
{
    return spu_edge_count(form->operand[k], role[k]);
}

void spu_each_operands(test_random *r, const spu_form *form, const spu_role role[3], uint32_t rounds, spu_visit *visit,
                       void *user)
{
    spu_quad in[3];
    for (int k = 0; k < form->operands; k++)
        for (uint32_t e = 0; e < 4 * edges(form, role, k); e++) {
            spu_random_operands(r, form, role, in);
            in[k] = spu_edge(form->operand[k], role[k], e / 4);
            visit(user, in);
        }
    for (int k = 0; k < form->operands; k++)
        for (int l = 0; l < k; l++) {
            const uint32_t of_k = edges(form, role, k), of_l = edges(form, role, l);
            for (uint32_t e = 0; of_k <= LONG_LIST && of_l <= LONG_LIST && e < of_k * of_l; e++) {
                spu_random_operands(r, form, role, in);
                in[k] = spu_edge(form->operand[k], role[k], e / of_l);
                in[l] = spu_edge(form->operand[l], role[l], e % of_l);
                visit(user, in);
            }
        }
    for (; rounds; rounds--) {
        spu_random_operands(r, form, role, in);
        visit(user, in);
    }
}
