/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Chapman's tracer as an SPE's program, compiled for the host. */
#ifndef SPE_GRID_H
#define SPE_GRID_H

/* argument: the effective address of the SPE's cgt_control_block. Returns 0, or 1 after a report that says why. */
int spe_grid(unsigned long long spe, unsigned long long argument, unsigned long long environment);

#endif
