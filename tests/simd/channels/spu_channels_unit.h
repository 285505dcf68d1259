/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The interface of the second source file of test_spu_channels. */
#ifndef SPU_CHANNELS_UNIT_H
#define SPU_CHANNELS_UNIT_H

#include <stdint.h>

unsigned unit_reserve_tag(void);
unsigned unit_begin_critical_section(void);
void unit_end_critical_section(unsigned status);
void unit_read_fpscr(uint32_t word[4]);

#endif
