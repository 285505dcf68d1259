/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Where SPEs lie among the effective addresses; for the host and for SPE programs. */
#ifndef CGT_SPE_ADDRESSES_H
#define CGT_SPE_ADDRESSES_H

#include <stdint.h>

/* Effective addresses of an SPE: its local store, and in its problem state the signal registers (Cell Broadband Engine
 * Architecture: offsets 0x1400c and 0x1c00c there). Memory of the program lies elsewhere. */
#define CGT_SPE_EA(spe) (UINT64_C(0xe0000000) + (uint64_t)(spe)*0x80000)
#define CGT_SPE_SIGNAL_EA(spe, number) (CGT_SPE_EA(spe) + 0x40000 + ((number) == 1 ? 0x1400c : 0x1c00c))

#endif
