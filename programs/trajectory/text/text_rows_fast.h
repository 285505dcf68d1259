/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows of a usual form, many at a time. */
#ifndef TEXT_ROWS_FAST_H
#define TEXT_ROWS_FAST_H

#include "trajectory/text/text_rows.h"

/* Whether rows of the plan may be of a usual form: no wanted columns of words, no atomic numbers. */
int rows_can_be_fast(const trajectory *t, const row_plan *plan);

/* Reads rows of a usual form from the lines that the reader holds, from row `done` on, up to `count`. Returns how many,
 * 0 where the next row is not of that form, or no whole line is there; -1: no memory, or the file cannot be read. The
 * other rows are the caller's, one by one: they may be right, too. The results do not depend on the number of
 * threads. */
int64_t rows_read_fast(trajectory *t, row_plan *plan, uint32_t done, uint32_t count);

#endif
