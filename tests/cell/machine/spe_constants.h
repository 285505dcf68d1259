/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What the SPE programs of the tests and those who run them agree on (spe_programs.h). */
#ifndef SPE_CONSTANTS_H
#define SPE_CONSTANTS_H

#define SQUARES_FLOATS 256
#define COUNTER_ROUNDS 25
#define STRIPS_END 0xffffffffu
#define RING_ROUNDS 10

#endif
