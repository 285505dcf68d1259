/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A mesh whose neighbours follow one another: a wavy sheet, rolled up, so that it shows several layers from any
 * direction. Rows run along the roll; squares grow from row to row and along each row. */
#ifndef ROLLED_SHEET_H
#define ROLLED_SHEET_H

#include <stdint.h>

/* All triangles, row by row. */
void rolled_sheet(float (*sheet)[3][3], uint32_t count, double phase);

/* Triangles that are skipped: all or every other one of some clusters, and single ones. Some lie far away, where boxes
 * must not reach. Those and NaNs are few, since their clusters do not count as neighbours. */
void rolled_sheet_spoil(float (*sheet)[3][3], uint32_t count);

/* Clusters eight times as long as necessary, which serve grids alone. */
void rolled_sheet_loosen(float (*sheet)[3][3], uint32_t count);

#endif
