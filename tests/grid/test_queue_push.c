/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The push to voxel queues, for the variant that this is compiled for: against a plain queue of 16, and its SIMD words
 * counted. Chapman: "pushing an element onto a queue requires only 6 SIMD logical instructions". */
#include "support/test.h"

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
#include "kernel/builders/queue_push.h"

#define CELLS 12

/* A grid of queues and what a plain program makes of the same pushes. */
typedef struct queues {
    _Alignas(64) cgt_voxel voxel[CELLS];
    uint16_t model[CELLS][CGT_QUEUE_LENGTH];
} queues;

static void clear(queues *q)
{
    memset(q->voxel, 0xff, sizeof q->voxel);
    memset(q->model, 0xff, sizeof q->model);
}

static void model_push(queues *q, uint32_t cell, uint16_t reference)
{
    memmove(&q->model[cell][1], &q->model[cell][0], (CGT_QUEUE_LENGTH - 1) * sizeof(uint16_t));
    q->model[cell][0] = reference;
}

static void check(const queues *q)
{
    for (int c = 0; c < CELLS; c++)
        for (int i = 0; i < CGT_QUEUE_LENGTH; i++)
            assert_int_equal(q->voxel[c].reference[i], q->model[c][i]);
}

static void six_words_per_push(void **state)
{
    (void)state;
    queues q;
    const uint32_t cell[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    clear(&q);
    words = (struct words){0};
    queue_push1(&q.voxel[3], spu_splats((uint16_t)7));
    assert_int_equal(words.loads, 2);
    assert_int_equal(words.shuffles, 2);
    assert_int_equal(words.stores, 2);
    words = (struct words){0};
    queue_push8(q.voxel, cell, spu_splats((uint16_t)8));
    assert_int_equal(words.loads + words.shuffles + words.stores, 48);
    assert_int_equal(words.loads, 16);
    assert_int_equal(words.shuffles, 16);
    assert_int_equal(words.stores, 16);
    words = (struct words){0};
    queue_push8(q.voxel, (const uint32_t[8]){5, 5, 5, 5, 5, 5, 5, 5}, spu_splats((uint16_t)9));
    assert_int_equal(words.loads + words.shuffles + words.stores, 48); /* the same without a branch on duplicates */
}

static void newest_comes_first(void **state)
{
    (void)state;
    queues q;
    clear(&q);
    for (uint16_t i = 0; i < CGT_QUEUE_LENGTH; i++) {
        queue_push1(&q.voxel[1], spu_splats((uint16_t)(1000 + i)));
        for (uint16_t k = 0; k < CGT_QUEUE_LENGTH; k++)
            assert_int_equal(q.voxel[1].reference[k], k <= i ? 1000 + i - k : (int)CGT_QUEUE_NONE);
    }
    queue_push1(&q.voxel[1], spu_splats((uint16_t)2000)); /* the 17th */
    assert_int_equal(q.voxel[1].reference[0], 2000);
    assert_int_equal(q.voxel[1].reference[15], 1001); /* 1000, the oldest, is out */
    for (int c = 0; c < CELLS; c++)
        for (int k = 0; k < CGT_QUEUE_LENGTH && c != 1; k++)
            assert_int_equal(q.voxel[c].reference[k], CGT_QUEUE_NONE);
}

static void equal_corners_hold_the_reference_once(void **state)
{
    (void)state;
    test_random r = random_make(1);
    for (uint32_t round = test_scaled(400); round; round--) {
        queues q;
        clear(&q);
        for (uint16_t prim = 0; prim < 60; prim++) {
            uint32_t cell[8];
            const uint32_t kinds = 1 + random_below(&r, CELLS);
            const uint16_t reference = random_below(&r, 2) ? prim : (uint16_t)(65534 - prim);
            for (int k = 0; k < 8; k++)
                cell[k] = random_below(&r, kinds);
            queue_push8(q.voxel, cell, spu_splats(reference));
            for (uint32_t c = 0; c < CELLS; c++) {
                bool touched = false;
                for (int k = 0; k < 8; k++)
                    touched |= cell[k] == c;
                if (touched)
                    model_push(&q, c, reference);
            }
            check(&q);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(six_words_per_push), cmocka_unit_test(newest_comes_first),
                                       cmocka_unit_test(equal_corners_hold_the_reference_once)};
    test_begin("test_queue_push");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
