/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The thesis' tracer as an SPE's program, compiled for the host: with kd-trees, and with bounding interval
 * hierarchies. */
#ifndef SPE_KD_H
#define SPE_KD_H

/* argument: the effective address of the SPE's cgt_kd_control. Returns 0, or 1 after a report that says why. */
int spe_kd(unsigned long long spe, unsigned long long argument, unsigned long long environment);
int spe_bih(unsigned long long spe, unsigned long long argument, unsigned long long environment);

#endif
