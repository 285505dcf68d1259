/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * A second source file of test_spu_channels: SPU code that finds the host installed by the first, and whose critical
 * sections are safe from interrupts. */
#define SPU_MFCIO_INTERRUPT_SAFE
#include "spu_mfcio.h"

#include "simd/channels/spu_channels_unit.h"

unsigned unit_reserve_tag(void) { return mfc_tag_reserve(); }
unsigned unit_begin_critical_section(void) { return mfc_begin_critical_section(); }
void unit_end_critical_section(unsigned status) { mfc_end_critical_section(status); }

void unit_read_fpscr(uint32_t word[4])
{
    const vec_uint4 fpscr = spu_mffpscr();
    for (int i = 0; i < 4; i++)
        word[i] = fpscr[i];
}
