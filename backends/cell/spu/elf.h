/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Programs for an SPU: ELF files of 32 bits, big-endian, machine 23, as spu-elf-gcc links them. */
#ifndef CGT_CELL_ELF_H
#define CGT_CELL_ELF_H

#include "cell/spu/spu.h"

/* Copies a program into the local store and sets the program counter to its entry. What the program does not cover
 * keeps its bytes. A timed SPU counts by the functions of the file's symbols from now on.
 *   bytes   the file; needed during the call only
 *   size    in bytes
 *   name    of the file, for messages
 * Returns CGT_OK, or with a sentence in spu->message, and the local store as it was:
 *   CGT_ERROR_INVALID_ARGUMENT   no ELF file, not for an SPU, not linked, or damaged
 *   CGT_ERROR_TOO_LARGE          a part of it lies outside the local store
 *   CGT_ERROR_OUT_OF_MEMORY      for the functions; all else is loaded */
cgt_result cgt_spu_load_elf(cgt_spu *spu, const void *bytes, size_t size, const char *name);

/* Finds the address of a symbol of the file. Returns false where there is none, or no symbols, or no ELF file. */
bool cgt_spu_find_symbol(const void *bytes, size_t size, const char *symbol, uint32_t *address);

#endif
