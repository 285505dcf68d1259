/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words of vector.h and spux_double.h on four lanes, one function each, that transform a record. The same text is
 * compiled for an SPU and for the host, and must leave the same record.
 *
 *   SPUX_CALLS(X)   one X(name, bits) per function call_name; bits: of the elements that it sees in `memory`, which a
 *                   host of another byte order has to know. Everything else is words of 32 bits */
#ifndef SPUX_CALLS_H
#define SPUX_CALLS_H

#include "spux_double.h"

typedef struct spux_record {
    union {
        vuint quad[8];
        uint32_t word[32];
        float number[32];
        uint16_t half[64];
        uint8_t byte[128];
    } memory;
    vuint a, b, m; /* operands; the sign bits of m are a mask */
    vuint at;      /* elements of an address, 0 to 15 in each lane */
    vuint result[4];
} spux_record;

#define SPUX_QUADS 16

static inline vfloat spux_a(const spux_record *r) { return (vfloat)r->a; }
static inline vfloat spux_b(const spux_record *r) { return (vfloat)r->b; }
static inline vmask spux_m(const spux_record *r) { return (vmask)spu_cmpgt(spux_vint(0), (vint)r->m); }
static inline void spux_put(spux_record *r, vuint v) { r->result[0] = v; }

/* Floats of ordinary size, on which IEEE and an SPU agree. */
static inline vfloat spux_tame(vuint bits)
{
    const vuint exponent = spu_add(spu_and(spu_sr(bits, 23), spux_vuint(63)), spux_vuint(95));
    return (vfloat)spu_or(spu_and(bits, spux_vuint(0x807fffff)), spu_sl(exponent, 23));
}
static inline void spux_put_doubles(spux_record *r, int k, vdouble d)
{
    for (int i = 0; i < 2; i++) {
        uint64_t bits;
        const double x = d[i];
        memcpy(&bits, &x, sizeof bits);
        r->result[k][2 * i] = (uint32_t)(bits >> 32);
        r->result[k][2 * i + 1] = (uint32_t)bits;
    }
}

#define SPUX_CALL(name) static void call_##name(spux_record *r)

/* ---- masks ---- */

SPUX_CALL(mask_bits) { spux_put(r, spux_vuint(spux_mask_bits(spux_m(r)))); }
SPUX_CALL(mask_from_bits) { spux_put(r, spux_mask_from_bits(r->at[0])); }
SPUX_CALL(mask_first) { spux_put(r, spux_mask_first(r->at[0] & 7)); }
SPUX_CALL(count_bits) { spux_put(r, spux_vuint(spux_count_bits(r->at[0]))); }
SPUX_CALL(any) { spux_put(r, spux_vuint(spux_any(spux_m(r)))); }
SPUX_CALL(all) { spux_put(r, spux_vuint(spux_all(spux_m(r)))); }
SPUX_CALL(none) { spux_put(r, spux_vuint(spux_none(spux_m(r)))); }
SPUX_CALL(complement) { spux_put(r, spux_not(spux_m(r))); }

/* ---- arithmetic ---- */

SPUX_CALL(div) { spux_put(r, (vuint)spux_div(spux_a(r), spux_b(r))); }
SPUX_CALL(sqrt) { spux_put(r, (vuint)spux_sqrt(spux_a(r))); }
SPUX_CALL(rsqrte) { spux_put(r, (vuint)spux_rsqrte(spux_a(r))); }
SPUX_CALL(cmpge) { spux_put(r, spux_cmpge(spux_a(r), spux_b(r))); }
SPUX_CALL(abs) { spux_put(r, (vuint)spux_abs(spux_a(r))); }
SPUX_CALL(truncate) { spux_put(r, (vuint)spux_truncate(spux_a(r))); }
SPUX_CALL(min)
{
    r->result[0] = (vuint)spux_min(spux_a(r), spux_b(r));
    r->result[1] = (vuint)spux_min((vint)r->a, (vint)r->b);
    r->result[2] = spux_min(r->a, r->b);
}
SPUX_CALL(max)
{
    r->result[0] = (vuint)spux_max(spux_a(r), spux_b(r));
    r->result[1] = (vuint)spux_max((vint)r->a, (vint)r->b);
    r->result[2] = spux_max(r->a, r->b);
}
SPUX_CALL(hmin)
{
    r->result[0] = (vuint)spux_vfloat(spux_hmin(spux_a(r)));
    r->result[1] = spux_vuint(spux_hmin(r->b));
}
SPUX_CALL(hmax)
{
    r->result[0] = (vuint)spux_vfloat(spux_hmax(spux_a(r)));
    r->result[1] = spux_vuint(spux_hmax(r->b));
}

/* ---- between lanes ---- */

SPUX_CALL(select) { spux_put(r, spux_select(r->a, r->b, spux_m(r))); }
SPUX_CALL(permute) { spux_put(r, spux_permute(r->a, r->b)); }
SPUX_CALL(compress) { spux_put(r, spux_compress(r->a, spux_m(r))); }
SPUX_CALL(unzip)
{
    vuint v[2] = {r->a, r->b};
    spux_unzip(v);
    r->result[0] = v[0];
    r->result[1] = v[1];
}
SPUX_CALL(transpose)
{
    vfloat row[4];
    for (int i = 0; i < 4; i++)
        row[i] = (vfloat)r->memory.quad[i];
    spux_transpose(row);
    for (int i = 0; i < 4; i++)
        r->result[i] = (vuint)row[i];
}

/* ---- memory ---- */

SPUX_CALL(load_unaligned) { spux_put(r, spux_load_unaligned_uint(&r->memory.word[r->at[0]])); }
SPUX_CALL(store_unaligned) { spux_store_unaligned_uint(&r->memory.word[r->at[0]], r->a); }
SPUX_CALL(load_mask) { spux_put(r, spux_load_mask_uint(&r->memory.word[r->at[0]], spux_m(r))); }
SPUX_CALL(store_mask) { spux_store_mask_uint(&r->memory.word[r->at[0]], r->a, spux_m(r)); }
SPUX_CALL(compress_store)
{
    spux_put(r, spux_vuint(spux_compress_store_uint(&r->memory.word[r->at[0]], r->a, spux_m(r))));
}
SPUX_CALL(gather) { spux_put(r, spux_gather_uint(&r->memory.word[r->at[0]], (vint)r->at)); }
SPUX_CALL(load_bytes) { spux_put(r, spux_load_bytes(&r->memory.byte[r->at[0]])); }
SPUX_CALL(find16)
{
    spux_put(r, spux_vuint(spux_find16(&r->memory.half[r->at[0]], r->memory.half[r->at[1] + r->at[2]])));
}
SPUX_CALL(load_records4)
{
    vfloat d[4];
    spux_load_records4(&r->memory.number[r->at[0] & 3], 1 + (r->at[1] & 7), d);
    for (int i = 0; i < 4; i++)
        r->result[i] = (vuint)d[i];
}
SPUX_CALL(load_records4_at)
{
    vfloat d[4];
    const uint32_t at[4] = {r->at[0], r->at[1], r->at[2], r->at[3]};
    spux_load_records4_at(r->memory.number, at, d);
    for (int i = 0; i < 4; i++)
        r->result[i] = (vuint)d[i];
}
SPUX_CALL(load_records8_at)
{
    vfloat d[8];
    const uint32_t at[4] = {r->at[0], r->at[1], r->at[2], r->at[3]};
    spux_load_records8_at(r->memory.number, at, d);
    for (int i = 0; i < 4; i++)
        r->result[i] = spu_xor((vuint)d[i], spu_add((vuint)d[i + 4], spux_vuint(1)));
}
SPUX_CALL(store_records4)
{
    const vfloat d[4] = {spux_a(r), spux_b(r), (vfloat)r->m, (vfloat)r->at};
    spux_store_records4(&r->memory.number[r->at[0] & 3], 4 + (r->at[1] & 3), d);
}
SPUX_CALL(transpose_memory) { spux_transpose4(&r->memory.number[r->at[0] & 3], 4, &r->memory.number[r->at[1]], 4); }

/* ---- doubles ---- */

SPUX_CALL(double_of_float)
{
    spux_put_doubles(r, 0, spux_double_low(spux_tame(r->a)));
    spux_put_doubles(r, 1, spux_double_high(spux_tame(r->a)));
}
SPUX_CALL(double_arithmetic)
{
    const vdouble x = spux_double_low(spux_tame(r->a)), y = spux_double_low(spux_tame(r->b));
    spux_put_doubles(r, 0, x * y + y);
    spux_put_doubles(r, 1, x - y * x);
    spux_put_doubles(r, 2, spux_double_add_square(y, x));
    spux_put_doubles(r, 3, spux_double_select(x, y, x * y));
}
SPUX_CALL(float_of_double)
{
    const vdouble x = spux_double_low(spux_tame(r->a)), y = spux_double_low(spux_tame(r->b));
    const vdouble low = x + y, high = spux_double_abs(x - y);
    r->result[0] = (vuint)spux_float_of(low, high);
    r->result[1] = (vuint)spux_float_where(low, high, spux_m(r));
    r->result[2] = spux_double_above0(low, high);
    r->result[3] = spux_double_cmpgt((vdouble[2]){x, low}, (vdouble[2]){y, high});
}
SPUX_CALL(double_sqrt)
{
    const vdouble x = spux_double_low(spux_tame(r->a)), y = spux_double_low(spux_tame(r->b));
    spux_put_doubles(r, 0, spux_double_sqrt(spux_double_abs(x)));
    spux_put_doubles(r, 1, spux_double_sqrt(x * x + y * y));
}
SPUX_CALL(double_divide)
{
    const vdouble x = spux_double_low(spux_tame(r->a)), y = spux_double_low(spux_tame(r->b));
    spux_put_doubles(r, 0, x / y);
    spux_put_doubles(r, 1, (x + y) / (x * y));
}

/* clang-format off */
#define SPUX_CALLS(X)                                                                                                  \
    X(mask_bits, 32) X(mask_from_bits, 32) X(mask_first, 32) X(count_bits, 32) X(any, 32) X(all, 32) X(none, 32)       \
    X(complement, 32) X(div, 32) X(sqrt, 32) X(rsqrte, 32) X(cmpge, 32) X(abs, 32) X(truncate, 32) X(min, 32)          \
    X(max, 32)                                                                                                         \
    X(hmin, 32) X(hmax, 32) X(select, 32) X(permute, 32) X(compress, 32) X(unzip, 32) X(transpose, 32)                 \
    X(load_unaligned, 32) X(store_unaligned, 32) X(load_mask, 32) X(store_mask, 32) X(compress_store, 32)              \
    X(gather, 32) X(load_bytes, 8) X(find16, 16) X(load_records4, 32) X(load_records4_at, 32)                          \
    X(load_records8_at, 32) X(store_records4, 32) X(transpose_memory, 32) X(double_of_float, 32)                       \
    X(double_arithmetic, 32) X(float_of_double, 32) X(double_sqrt, 32) X(double_divide, 32)
/* clang-format on */

#endif
