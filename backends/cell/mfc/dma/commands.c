/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The table of MFC commands: operation codes as in spu_mfcio.h, the name of the word that gives each, and what it
 * is. */
#include <stddef.h>

#include "cell/mfc/mfc_internal.h"

/* base, with a fence, with a barrier */
#define ROWS(code, name, kind, list)                                                                                   \
    {(code), name, kind, list, false, false}, {(code) | 2, name "f", kind, list, true, false},                         \
    {                                                                                                                  \
        (code) | 1, name "b", kind, list, false, true                                                                  \
    }

static const cgt_mfc_operation operations[] = {
    ROWS(0x20, "mfc_put", CGT_MFC_PUT, false),
    ROWS(0x24, "mfc_putl", CGT_MFC_PUT, true),
    ROWS(0x30, "mfc_putr", CGT_MFC_PUT, false), /* with a result for a processor that computes in memory: a put */
    ROWS(0x34, "mfc_putrl", CGT_MFC_PUT, true),
    ROWS(0x40, "mfc_get", CGT_MFC_GET, false),
    ROWS(0x44, "mfc_getl", CGT_MFC_GET, true),
    ROWS(0xa0, "mfc_sndsig", CGT_MFC_SIGNAL, false),
    {0x80, "mfc_sdcrt", CGT_MFC_CACHE, false, false, false},
    {0x81, "mfc_sdcrtst", CGT_MFC_CACHE, false, false, false},
    {0x89, "mfc_sdcrz", CGT_MFC_ZERO, false, false, false},
    {0x8d, "mfc_sdcrst", CGT_MFC_CACHE, false, false, false},
    {0x8f, "mfc_sdcrf", CGT_MFC_CACHE, false, false, false},
    {0xb0, "mfc_putlluc", CGT_MFC_ATOMIC, false, false, false},
    {0xb4, "mfc_putllc", CGT_MFC_ATOMIC, false, false, false},
    {0xb8, "mfc_putqlluc", CGT_MFC_LINE, false, false, false},
    {0xd0, "mfc_getllar", CGT_MFC_ATOMIC, false, false, false},
    {0xc0, "mfc_barrier", CGT_MFC_BARRIER, false, false, false},
    {0xc8, "mfc_eieio", CGT_MFC_ORDER, false, false, false},
    {0xcc, "mfc_sync", CGT_MFC_ORDER, false, false, false},
};

const cgt_mfc_operation *cgt_mfc_find_operation(uint32_t opcode)
{
    for (size_t i = 0; i < sizeof operations / sizeof operations[0]; i++)
        if (operations[i].opcode == opcode)
            return &operations[i];
    return NULL;
}
