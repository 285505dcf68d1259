/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Operands that find mistakes: for every operand of a form a list of edges, and random values.
 *
 *   data    the edges of its type; edge e of a vector has edge e + i in element i, so that no two elements are alike
 *   count   of a shift or rotation, index of an element: -200 to 200, and the extremes
 *   scale, special   everything from 0 to 127 */
#ifndef SPU_OPERANDS_H
#define SPU_OPERANDS_H

#include "simd/spu_reference.h"
#include "support/test.h"

typedef enum spu_role { SPU_DATA, SPU_COUNT, SPU_0_TO_127 } spu_role;

uint32_t spu_edge_count(spu_kind kind, spu_role role);
spu_quad spu_edge(spu_kind kind, spu_role role, uint32_t e);

/* Edges, numbers near 1 and any bits, mixed; with other not NULL, some elements have the bits of other's. */
spu_quad spu_random(test_random *r, spu_kind kind, spu_role role, const spu_quad *other);

/* Random operands of a form, which often share elements with the first: equal values are what comparisons and borrows
 * turn on. */
void spu_random_operands(test_random *r, const spu_form *form, const spu_role role[3], spu_quad in[3]);

/* Visits all edges of each operand with random partners, all pairs of edges, where their lists are short, and `rounds`
 * random operands. */
typedef void spu_visit(void *user, const spu_quad in[3]);
void spu_each_operands(test_random *r, const spu_form *form, const spu_role role[3], uint32_t rounds, spu_visit *visit,
                       void *user);

#endif
