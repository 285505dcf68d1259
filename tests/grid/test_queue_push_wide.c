/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The push to voxel queues of 32-bit references, for the variant that this is compiled for, beside a plain queue. */
#include "support/test.h"

#include <string.h>

#include "kernel/builders/queue_push.h"

#define CELLS 12

/* A grid of queues and what a plain program makes of the same pushes. */
typedef struct queues {
    _Alignas(64) cgt_voxel32 voxel[CELLS];
    uint32_t model[CELLS][CGT_QUEUE_LENGTH];
} queues;

static void clear(queues *q)
{
    memset(q->voxel, 0xff, sizeof q->voxel);
    memset(q->model, 0xff, sizeof q->model);
}

static void model_push(queues *q, uint32_t cell, uint32_t reference)
{
    memmove(&q->model[cell][1], &q->model[cell][0], (CGT_QUEUE_LENGTH - 1) * sizeof(uint32_t));
    q->model[cell][0] = reference;
}

static void check(const queues *q)
{
    for (int c = 0; c < CELLS; c++)
        for (int i = 0; i < CGT_QUEUE_LENGTH; i++)
            assert_int_equal(q->voxel[c].reference[i], q->model[c][i]);
}

static void newest_comes_first(void **state)
{
    (void)state;
    static const uint32_t base[] = {0, 0x10000, 0xfffe0000, 0xffffff00}; /* neither half may be lost or swapped */
    for (size_t b = 0; b < TEST_COUNT(base); b++) {
        queues q;
        clear(&q);
        for (uint32_t i = 0; i < 40; i++) { /* from the 17th on the oldest goes out */
            queue_push1_32(&q.voxel[5], spu_splats(base[b] + i));
            model_push(&q, 5, base[b] + i);
            check(&q);
        }
    }
}

static void equal_corners_hold_the_reference_once(void **state)
{
    (void)state;
    test_random r = random_make(1);
    for (uint32_t round = 2 + test_scaled(400); round; round--) {
        queues q;
        clear(&q);
        for (uint32_t prim = 0; prim < 60; prim++) {
            uint32_t cell[8];
            const uint32_t kinds = 1 + random_below(&r, CELLS), high = random_below(&r, 2) ? 0 : 0xabcd0000;
            for (int k = 0; k < 8; k++)
                cell[k] = random_below(&r, kinds);
            queue_push8_32(q.voxel, cell, high + prim);
            for (uint32_t c = 0; c < CELLS; c++) {
                bool touched = false;
                for (int k = 0; k < 8; k++)
                    touched |= cell[k] == c;
                if (touched)
                    model_push(&q, c, high + prim);
            }
            check(&q);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(newest_comes_first),
                                       cmocka_unit_test(equal_corners_hold_the_reference_once)};
    test_begin("test_queue_push_wide");
    if (!test_variant_runs(CGT_VARIANT_NAME))
        return TEST_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
