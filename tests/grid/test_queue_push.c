/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Pushes 16-bit and 32-bit references to voxel queues with one variant, compares with a plain queue of 16, and
 * counts the SIMD words. Chapman: "pushing an element onto a queue requires only 6 SIMD logical instructions". */
#include "support/test.h"
#include "support/suite.h"

#include <string.h>

#include "vector.h"

static struct words {
    unsigned loads, stores, shuffles;
} words;

#define CGT_QUEUE_LOAD(p) (words.loads++, *(const vec_ushort8 *)(const void *)(p))
#define CGT_QUEUE_STORE(p, v)                                                                                          \
    do {                                                                                                               \
        words.stores++;                                                                                                \
        const vec_ushort8 v_ = (v);                                                                                    \
        memcpy((p), &v_, sizeof v_);                                                                                   \
    } while (0)
#define CGT_QUEUE_SHUFFLE(a, b, pattern) (words.shuffles++, spu_shuffle(a, b, pattern))
#include "papers/kernel/grid/queue_push.h"

#define CELLS 12u

/* ---- a grid of queues, and a plain model of the same pushes ---- */

typedef struct queues {
    bool is_wide; /* references of 32 bits */
    _Alignas(64) cgt_voxel narrow[CELLS];
    _Alignas(64) cgt_voxel32 wide[CELLS];
    uint32_t model[CELLS][CGT_QUEUE_LENGTH];
} queues;

static queues queues_make(bool is_wide)
{
    queues q;
    memset(&q, 0xff, sizeof q);
    q.is_wide = is_wide;
    for (uint32_t c = 0; c < CELLS; c++)
        for (int i = 0; i < CGT_QUEUE_LENGTH; i++)
            q.model[c][i] = is_wide ? UINT32_MAX : CGT_QUEUE_NONE;
    return q;
}

static void model_push(queues *q, uint32_t cell, uint32_t reference)
{
    memmove(&q->model[cell][1], &q->model[cell][0], (CGT_QUEUE_LENGTH - 1) * sizeof(uint32_t));
    q->model[cell][0] = reference;
}

static void push1(queues *q, uint32_t cell, uint32_t reference)
{
    if (q->is_wide)
        queue_push1_32(&q->wide[cell], spu_splats(reference));
    else
        queue_push1(&q->narrow[cell], spu_splats((uint16_t)reference));
    model_push(q, cell, reference);
}

static void push8(queues *q, const uint32_t cell[8], uint32_t reference)
{
    if (q->is_wide)
        queue_push8_32(q->wide, cell, reference);
    else
        queue_push8(q->narrow, cell, spu_splats((uint16_t)reference));
    for (uint32_t c = 0; c < CELLS; c++) {
        bool touched = false;
        for (int k = 0; k < 8; k++)
            touched |= cell[k] == c;
        if (touched)
            model_push(q, c, reference);
    }
}

static void check(const queues *q)
{
    for (uint32_t c = 0; c < CELLS; c++)
        for (int i = 0; i < CGT_QUEUE_LENGTH; i++) {
            const uint32_t got = q->is_wide ? q->wide[c].reference[i] : q->narrow[c].reference[i];
            if (got != q->model[c][i])
                fail_msg("%d bits, cell %u, place %d: reference %#x, expected %#x", q->is_wide ? 32 : 16, c, i, got,
                         q->model[c][i]);
        }
}

/* ---- tests ---- */

static void expect_words(unsigned loads, unsigned shuffles, unsigned stores)
{
    assert_int_equal(words.loads, loads);
    assert_int_equal(words.shuffles, shuffles);
    assert_int_equal(words.stores, stores);
    words = (struct words){0};
}

TEST(six_words_per_push)
{
    queues q = queues_make(false);
    words = (struct words){0};
    push1(&q, 3, 7);
    expect_words(2, 2, 2);
    push8(&q, (const uint32_t[8]){0, 1, 2, 3, 4, 5, 6, 7}, 8);
    expect_words(16, 16, 16);
    push8(&q, (const uint32_t[8]){5, 5, 5, 5, 5, 5, 5, 5}, 9); /* no branch on duplicates: the same number */
    expect_words(16, 16, 16);
    check(&q);
}

/* From the 17th push on, the oldest reference is lost. */
TEST(newest_comes_first)
{
    static const struct {
        bool is_wide;
        uint32_t first;
    } row[] = {{false, 0},      {false, 1000},      {false, 0xff00},   {true, 0},
               {true, 0x10000}, {true, 0xfffe0000}, {true, 0xffffff00}}; /* neither half may be lost or swapped */
    for (size_t k = 0; k < TEST_COUNT(row); k++) {
        queues q = queues_make(row[k].is_wide);
        for (uint32_t i = 0; i < 40; i++) {
            push1(&q, 5, row[k].first + i);
            check(&q);
        }
    }
}

TEST(equal_corners_hold_the_reference_once)
{
    test_random r = random_make(1);
    for (uint32_t round = 2 + test_scaled(800); round; round--) {
        queues q = queues_make(round % 2);
        for (uint32_t prim = 0; prim < 60; prim++) {
            uint32_t cell[8];
            const uint32_t kinds = 1 + random_below(&r, CELLS), high = q.is_wide ? 0xabcd0000 : 65534;
            for (int k = 0; k < 8; k++)
                cell[k] = random_below(&r, kinds);
            push8(&q, cell, random_below(&r, 2) ? prim : high - prim);
            check(&q);
        }
    }
}

VARIANT_SUITE("test_queue_push", NULL, NULL)
