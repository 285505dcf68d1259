/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Primitives by sort, before they become geometries: between judge_families.c and judge_scene.c. */
#ifndef JUDGE_HEAP_H
#define JUDGE_HEAP_H

#include "oracle/judge/judge.h"

typedef struct judge_heap {
    judge_scene *scene;
    test_random *r;
    uint32_t n; /* a number of primitives for the family */
    uint32_t count[JUDGE_KINDS];
    float data[JUDGE_KINDS][JUDGE_PRIMITIVES / 2][9];
} judge_heap;

/* Makes the scene's geometries of them, and bounds. */
void judge_heap_store(judge_heap *h);

#endif
