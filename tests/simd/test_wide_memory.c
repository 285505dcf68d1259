/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The words of vector.h that touch memory, for the variant that this is compiled for, next to pages that cannot be
 * touched; and those that move records and matrices. */
#define _GNU_SOURCE
#include "simd/lanes.h"
#include "support/suite.h"

#include "spux_double.h"

#include <math.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* ---- memory ---- */

/* A page that can be touched between two that cannot. */
typedef struct guarded {
    char *first, *end;
    size_t page;
} guarded;

static guarded guarded_make(void)
{
    guarded g = {.page = (size_t)sysconf(_SC_PAGESIZE)};
    char *p = mmap(NULL, 3 * g.page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(p != MAP_FAILED);
    assert_int_equal(mprotect(p + g.page, g.page, PROT_READ | PROT_WRITE), 0);
    g.first = p + g.page;
    g.end = g.first + g.page;
    return g;
}
static void guarded_free(const guarded *g) { munmap(g->first - g->page, 3 * g->page); }
static void guarded_fill(const guarded *g, test_random *r)
{
    for (char *p = g->first; p < g->end; p += sizeof(uint32_t)) {
        const uint32_t word = (uint32_t)random_bits(r);
        memcpy(p, &word, sizeof word);
    }
}
static uint32_t word_at(const char *p)
{
    uint32_t word;
    memcpy(&word, p, sizeof word);
    return word;
}

TEST(whole_loads_and_stores)
{
    test_random r = random_make(13);
    const guarded g = guarded_make();
    guarded_fill(&g, &r);
    for (size_t k = 0; k < 2 * CGT_LANES; k++) {
        char *const places[] = {g.first + 4 * k, g.end - CGT_VECTOR_BYTES - 4 * k};
        for (int w = 0; w < 2; w++) {
            char *p = places[w];
            const lanes a = any_words(&r);
            lanes d, e;
            memcpy(&e, p, sizeof e);
            d.f = spux_load_unaligned((const float *)p);
            check_bits("spux_load_unaligned", &d, &e);
            d.u = spux_load_unaligned_uint((const uint32_t *)p);
            check_bits("spux_load_unaligned_uint", &d, &e);
            if ((uintptr_t)p % CGT_VECTOR_BYTES == 0) {
                d.f = spux_load((const float *)p);
                check_bits("spux_load", &d, &e);
                d.u = spux_load_uint((const uint32_t *)p);
                check_bits("spux_load_uint", &d, &e);
                spux_store((float *)p, a.f);
                memcpy(&d, p, sizeof d);
                check_bits("spux_store", &d, &a);
                spux_store_uint((uint32_t *)p, e.u);
                memcpy(&d, p, sizeof d);
                check_bits("spux_store_uint", &d, &e);
            }
            spux_store_unaligned((float *)p, a.f);
            memcpy(&d, p, sizeof d);
            check_bits("spux_store_unaligned", &d, &a);
            spux_store_unaligned_uint((uint32_t *)p, e.u);
            memcpy(&d, p, sizeof d);
            check_bits("spux_store_unaligned_uint", &d, &e);
        }
    }
    guarded_free(&g);
}

/* A masked load and store at p, where every true lane lies in the page. */
static void check_masked(const guarded *g, char *p, unsigned bits, test_random *r)
{
    const vmask m = spux_mask_from_bits(bits);
    const lanes a = any_words(r);
    lanes d, e;
    for (int i = 0; i < CGT_LANES; i++)
        e.eu[i] = bits >> i & 1 ? word_at(p + 4 * i) : 0;
    d.f = spux_load_mask((const float *)p, m);
    check_bits("spux_load_mask", &d, &e);
    d.u = spux_load_mask_uint((const uint32_t *)p, m);
    check_bits("spux_load_mask_uint", &d, &e);
    for (int w = 0; w < 2; w++) {
        char before[3 * CGT_VECTOR_BYTES];
        char *const low = p - CGT_VECTOR_BYTES < g->first ? g->first : p - CGT_VECTOR_BYTES;
        char *const high = p + 2 * CGT_VECTOR_BYTES > g->end ? g->end : p + 2 * CGT_VECTOR_BYTES;
        memcpy(before, low, (size_t)(high - low));
        if (w)
            spux_store_mask((float *)p, a.f, m);
        else
            spux_store_mask_uint((uint32_t *)p, a.u, m);
        for (char *q = low; q < high; q += 4) {
            const ptrdiff_t lane = (q - p) / 4;
            const bool written = q >= p && lane < CGT_LANES && bits >> lane & 1;
            check_number("spux_store_mask", word_at(q), written ? a.eu[lane] : word_at(before + (q - low)));
        }
        memcpy(low, before, (size_t)(high - low));
    }
}

TEST(masked_lanes_are_not_touched)
{
    test_random r = random_make(14);
    const guarded g = guarded_make();
    guarded_fill(&g, &r);
    for (unsigned n = 0; n <= CGT_LANES; n++) {
        const unsigned first = (1u << n) - 1, last = CGT_ALL_LANES & ~first;
        check_masked(&g, g.end - 4 * n, first, &r);                       /* the rest lies beyond the page */
        check_masked(&g, g.end - 4 * n, first & any_bits(&r), &r);        /* or is not wanted */
        check_masked(&g, g.first - 4 * n, last, &r);                      /* the first ones lie before it */
        check_masked(&g, g.first - 4 * n, last & any_bits(&r), &r);       /* */
        check_masked(&g, g.first + 4 * n, any_bits(&r), &r);              /* all lie in it */
        check_masked(&g, g.first + g.page / 2 + 4 * n, any_bits(&r), &r); /* */
    }
    for (unsigned bits = 0; bits <= CGT_ALL_LANES; bits += bits < 256 ? 1 : 97)
        check_masked(&g, g.first + g.page / 2 + 4 * (bits % 7), bits, &r);
    guarded_free(&g);
}

TEST(compressed_store_ends_where_it_says)
{
    test_random r = random_make(15);
    const guarded g = guarded_make();
    for (unsigned bits = 0; bits <= CGT_ALL_LANES; bits++) {
        const unsigned count = (unsigned)__builtin_popcount(bits);
        const lanes a = any_words(&r);
        const vmask m = spux_mask_from_bits(bits);
        for (int w = 0; w < 2; w++) {
            char *p = w ? g.end - 4 * count : g.first + 64;
            memset(p, 0x5a, 4 * count + (w ? 0 : 64));
            check_number("spux_compress_store",
                         w ? spux_compress_store((float *)p, a.f, m) : spux_compress_store_uint((uint32_t *)p, a.u, m),
                         count);
            for (unsigned i = 0, n = 0; i < CGT_LANES; i++)
                if (bits >> i & 1)
                    check_number("spux_compress_store", word_at(p + 4 * n++), a.eu[i]);
            if (!w)
                check_number("spux_compress_store, behind", word_at(p + 4 * count), 0x5a5a5a5a);
        }
    }
    guarded_free(&g);
}

TEST(gathering)
{
    test_random r = random_make(16);
    const guarded g = guarded_make();
    guarded_fill(&g, &r);
    const int32_t words = (int32_t)(g.page / 4);
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        const int32_t base = (int32_t)random_below(&r, (uint32_t)words);
        lanes index, d, e;
        for (int i = 0; i < CGT_LANES; i++) {
            const int32_t at = random_below(&r, 8) ? (int32_t)random_below(&r, (uint32_t)words) : i % 2 ? 0 : words - 1;
            index.es[i] = at - base;
            e.eu[i] = word_at(g.first + 4 * at);
        }
        d.f = spux_gather((const float *)g.first + base, index.s);
        check_bits("spux_gather", &d, &e);
        d.u = spux_gather_uint((const uint32_t *)g.first + base, index.s);
        check_bits("spux_gather_uint", &d, &e);
    }
    guarded_free(&g);
}

TEST(halfwords_are_found)
{
    test_random r = random_make(18);
    const guarded g = guarded_make();
    for (uint32_t k = test_scaled(ROUNDS); k; k--) {
        const uint16_t x = (uint16_t)(random_below(&r, 2) ? random_bits(&r) : 0xffff);
        const uint64_t bits = random_bits(&r);
        const unsigned present = (unsigned)(bits & bits >> 16 & bits >> 32); /* few */
        uint16_t *p = (uint16_t *)(k % 2 ? g.first : g.end - 32) + (k % 4 == 1);
        uint32_t first = 16;
        for (uint32_t i = 16; i-- > 0;) {
            p[i] = present >> i & 1 ? x : (uint16_t)(x ^ 1u << random_below(&r, 16));
            first = present >> i & 1 ? i : first;
        }
        check_number("spux_find16", spux_find16(p, x), first);
    }
    guarded_free(&g);
}

/* ---- records and matrices ---- */

TEST(records)
{
    test_random r = random_make(17);
    const guarded g = guarded_make();
    guarded_fill(&g, &r);
    for (size_t stride = 4; stride < 10; stride++) {
        const float *base =
            (const float *)(g.end - 4 * ((CGT_LANES - 1) * stride + 4)); /* the last one ends the page */
        uint32_t at[CGT_LANES];
        lanes d[4], e;
        vfloat got[4];
        spux_load_records4(base, stride, got);
        for (int a = 0; a < 4; a++) {
            d[a].f = got[a];
            for (size_t k = 0; k < CGT_LANES; k++)
                e.eu[k] = word_at((const char *)(base + k * stride + (size_t)a));
            check_bits("spux_load_records4", &d[a], &e);
        }
        for (int k = 0; k < CGT_LANES; k++)
            at[k] = random_below(&r, (uint32_t)(g.page / 4 - 3));
        at[random_below(&r, CGT_LANES)] = (uint32_t)(g.page / 4 - 4);
        spux_load_records4_at((const float *)g.first, at, got);
        for (int a = 0; a < 4; a++) {
            d[a].f = got[a];
            for (int k = 0; k < CGT_LANES; k++)
                e.eu[k] = word_at(g.first + 4 * (at[k] + (uint32_t)a));
            check_bits("spux_load_records4_at", &d[a], &e);
        }
        vfloat eight[8];
        for (int k = 0; k < CGT_LANES; k++)
            at[k] = random_below(&r, (uint32_t)(g.page / 4 - 7));
        at[random_below(&r, CGT_LANES)] = (uint32_t)(g.page / 4 - 8);
        spux_load_records8_at((const float *)g.first, at, eight);
        for (int a = 0; a < 8; a++) {
            d[0].f = eight[a];
            for (int k = 0; k < CGT_LANES; k++)
                e.eu[k] = word_at(g.first + 4 * (at[k] + (uint32_t)a));
            check_bits("spux_load_records8_at", &d[0], &e);
        }
    }
    guarded_free(&g);
}

/* Records are what was stored, and what lies between them keeps its content. */
TEST(stored_records)
{
    float memory[CGT_LANES * 7];
    test_random r = random_make(44);
    for (size_t stride = 4; stride <= 7; stride++) {
        vfloat d[4];
        for (int a = 0; a < 4; a++)
            for (int k = 0; k < CGT_LANES; k++)
                d[a][k] = random_float(&r, -1, 1);
        for (size_t i = 0; i < TEST_COUNT(memory); i++)
            memory[i] = 7;
        spux_store_records4(memory, stride, d);
        for (size_t i = 0; i < CGT_LANES * stride; i++)
            assert_true(memory[i] == (i % stride < 4 ? d[i % stride][i / stride] : 7));
    }
}

TEST(bytes)
{
    uint8_t byte[CGT_LANES + 1];
    test_random r = random_make(45);
    for (int turn = 0; turn < 100; turn++) {
        for (size_t i = 0; i < TEST_COUNT(byte); i++)
            byte[i] = (uint8_t)random_below(&r, 256);
        const vuint v = spux_load_bytes(byte + turn % 2);
        for (int k = 0; k < CGT_LANES; k++)
            assert_int_equal(v[k], byte[turn % 2 + k]);
    }
}

TEST(streams_and_parts)
{
    _Alignas(CGT_VECTOR_BYTES) uint32_t to[3 * CGT_LANES] = {0};
    vuint v[2] = {spux_lane_index(), spu_add(spux_lane_index(), spux_vuint(CGT_LANES))};
    spux_unzip(v);
    spux_stream_uint(to + CGT_LANES, v[0]);
    spux_stream((float *)to + 2 * CGT_LANES, (vfloat)v[1]);
    spux_stream_end();
    for (uint32_t k = 0; k < CGT_LANES; k++) {
        check_number("before what is streamed", to[k], 0);
        check_number("spux_unzip, even", to[CGT_LANES + k], 2 * k);
        check_number("spux_unzip, odd", to[2 * CGT_LANES + k], 2 * k + 1);
    }
}

TEST(lines)
{
    enum { LINE = 16 };
    _Alignas(64) uint32_t from[LINE], to[3 * LINE] = {0};
    for (uint32_t k = 0; k < LINE; k++)
        from[k] = k + 1;
    spux_stream_line(to + LINE, from);
    spux_stream_end();
    for (uint32_t k = 0; k < 3 * LINE; k++)
        check_number("spux_stream_line", to[k], k / LINE == 1 ? k % LINE + 1 : 0);
}

/* Each word against C, lane by lane; any bits, and numbers about 1. */
TEST(doubles)
{
    test_random r = random_make(19);
    for (int round = 0; round < 2000; round++) {
        lanes a = any_words(&r), back;
        double d[CGT_LANES], root[CGT_LANES], size[CGT_LANES], chosen[CGT_LANES], sum[CGT_LANES];
        vdouble left[2], right[2];
        for (int k = 0; k < CGT_LANES; k++)
            a.ef[k] = round % 2 ? random_float(&r, -2, 2) : a.ef[k] == a.ef[k] ? a.ef[k] : (float)(k & 1);
        for (int h = 0; h < 2; h++) {
            const vdouble v = h ? spux_double_high(a.f) : spux_double_low(a.f), third = v / spux_vdouble(3);
            const vdouble s = spux_double_sqrt(spux_double_abs(third)), b = spux_double_abs(third);
            const vdouble c = spux_double_select(spux_vdouble(1), spux_vdouble(2), v);
            const vdouble added = spux_double_add_square(third, v);
            left[h] = v;
            right[h] = v * v; /* equal at 0 and 1, above or below it elsewhere */
            for (int k = 0; k < CGT_DOUBLES; k++) {
                d[h * CGT_DOUBLES + k] = third[k];
                root[h * CGT_DOUBLES + k] = s[k];
                size[h * CGT_DOUBLES + k] = b[k];
                chosen[h * CGT_DOUBLES + k] = c[k];
                sum[h * CGT_DOUBLES + k] = added[k];
            }
        }
        vdouble half[2];
        const unsigned above = spux_mask_bits(spux_double_cmpgt(left, right));
        for (int k = 0; k < CGT_LANES; k++) {
            const double it = (double)a.ef[k], third = it / 3, square = it * it;
            assert_true(sum[k] == third + square);
            assert_true((above >> k & 1) == (it > square));
            assert_true(d[k] == third && size[k] == fabs(third) && root[k] == sqrt(fabs(third)));
            assert_true(chosen[k] == (a.ef[k] > 0 ? 2 : 1));
            half[k / CGT_DOUBLES][k % CGT_DOUBLES] = third;
        }
        back.f = spux_float_of(half[0], half[1]);
        for (int k = 0; k < CGT_LANES; k++)
            assert_true(back.ef[k] == (float)((double)a.ef[k] / 3));
        const unsigned where = (unsigned)random_below(&r, CGT_ALL_LANES + 1);
        back.f = spux_float_where(half[0], half[1], spux_mask_from_bits(where));
        for (int k = 0; k < CGT_LANES; k++)
            assert_true(back.ef[k] == (where >> k & 1 ? (float)((double)a.ef[k] / 3) : 0));
        const float b = random_float(&r, -2, 2);
        for (int h = 0; h < 2; h++) {
            const vdouble added = spux_double_sum(a.ef + h * CGT_DOUBLES, b);
            for (int k = 0; k < CGT_DOUBLES; k++)
                assert_true(added[k] == (double)(a.ef[h * CGT_DOUBLES + k] + b));
        }
    }
}

/* Records of 8 doubles wherever they are, and back, some doubles apart. */
TEST(double_records)
{
    enum { FROM = 200, STRIDE = 11 };
    test_random r = random_make(20);
    double from[FROM], to[CGT_DOUBLES * STRIDE + 1];
    for (int i = 0; i < FROM; i++)
        from[i] = i + 1;
    for (int round = 0; round < 50; round++) {
        uint32_t at[CGT_DOUBLES];
        vdouble d[8];
        memset(to, 0, sizeof to);
        for (uint32_t k = 0; k < CGT_DOUBLES; k++)
            at[k] = random_below(&r, FROM - 7);
        spux_double_load8_at(from, at, d);
        for (uint32_t i = 0; i < 8; i++)
            for (uint32_t k = 0; k < CGT_DOUBLES; k++)
                assert_true(d[i][k] == from[at[k] + i]);
        spux_double_store8(to + 1, STRIDE, d);
        for (uint32_t k = 0; k < CGT_DOUBLES; k++)
            for (uint32_t i = 0; i < STRIDE; i++)
                assert_true(to[1 + k * STRIDE + i] == (i < 8 ? from[at[k] + i] : 0));
        assert_true(to[0] == 0);
    }
}

TEST(transposes)
{
    enum { EDGE = 16, STRIDE = 19 };
    static const size_t sizes[] = {4, 8, 16};
    for (size_t w = 0; w < TEST_COUNT(sizes); w++) {
        float from[EDGE * STRIDE], to[EDGE * STRIDE + 1];
        const size_t n = sizes[w];
        for (int i = 0; i < EDGE * STRIDE; i++) {
            from[i] = (float)(i + 1);
            to[i] = -1;
        }
        switch (n) {
        case 4: spux_transpose4(from, STRIDE, to + 1, EDGE); break;
        case 8: spux_transpose8(from, STRIDE, to + 1, EDGE); break;
        default: spux_transpose16(from, STRIDE, to + 1, EDGE);
        }
        assert_true(to[0] == -1);
        for (size_t y = 0; y < EDGE; y++)
            for (size_t x = 0; x < EDGE; x++)
                assert_true(to[1 + y * EDGE + x] == (x < n && y < n ? from[x * STRIDE + y] : -1));
    }
    vfloat row[CGT_LANES];
    vuint fours[BLOCK_ROWS];
    lanes l;
    for (uint32_t k = 0; k < BLOCK_ROWS; k++)
        fours[k] = spu_add(spux_lane_index(), spux_vuint(100 * k));
    spux_transpose_fours(fours);
    for (uint32_t k = 0; k < BLOCK_ROWS; k++) {
        l.u = fours[k];
        for (uint32_t i = 0; i < CGT_LANES; i++)
            check_number("spux_transpose_fours", l.eu[i], 100 * (i / 4) + 4 * k + i % 4);
    }
    for (int y = 0; y < CGT_LANES; y++) {
        for (int x = 0; x < CGT_LANES; x++)
            l.ef[x] = (float)(100 * y + x);
        row[y] = l.f;
    }
    spux_transpose(row);
    for (int y = 0; y < CGT_LANES; y++) {
        l.f = row[y];
        for (int x = 0; x < CGT_LANES; x++)
            assert_true(l.ef[x] == (float)(100 * x + y));
    }
}

VARIANT_SUITE("test_wide_memory", NULL, NULL)
