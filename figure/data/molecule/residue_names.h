/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Residues of molecules by their names, in capitals, as PDB, GROMACS, CHARMM and AMBER have them: of the readers and of
 * the figures, neither of which needs the other. */
#ifndef RESIDUE_NAMES_H
#define RESIDUE_NAMES_H

#include <string.h>

/* Words of a list have a blank before and behind. */
#define RESIDUE_ACIDS                                                                                                  \
    " ALA ARG ASN ASP CYS GLN GLU GLY HIS ILE LEU LYS MET PHE PRO SER THR TRP TYR VAL HID HIE HIP HSD "                \
    "HSE HSP CYX CYM ASH GLH LYN ACE NME NH2 HYP QLN SEP TPO PTR "
#define RESIDUE_OTHER_ACIDS                                                                                            \
    " MSE SEC PYL CSE NMA PGLU ARGN ASN1 ASP1 ASPH ASPP CYS1 CYS2 CYSH GLUH GLUP HIS1 HIS2 HISA HISB "                 \
    "HISD HISE HISH HISP LYSH PHEH PHEU TRPH TRPU TYRH TYRU "
#define RESIDUE_WATERS                                                                                                 \
    " HOH WAT H2O DOD SOL OH2 TIP TIP2 TIP3 TIP4 TIP5 TIP3P TIP4P TIP5P TP3 TP4 TP5 T3P T4P T5P T3H "                  \
    "T4H SPC SPCE OPC T4E T4EW TP4E T5E ICE SWM4 SWM6 SW4 "

static inline int residue_is_in(const char *list, const char *begin, size_t length)
{
    enum { LONGEST = 5 };
    char word[LONGEST + 3] = " ";
    if (length < 1 || length > LONGEST || memchr(begin, ' ', length) != NULL)
        return 0;
    memcpy(word + 1, begin, length);
    word[length + 1] = ' ';
    return strstr(list, word) != NULL;
}

/* Whether it is an amino acid of a protein in any state, or a cap at its end; or water. Unlike residue_is_organic of
 * the readers this takes no name for the letters in it: GLYC is glycerol. */
static inline int residue_is_protein(const char *residue)
{
    const size_t length = strlen(residue);
    const int is_end = length == 4 && (residue[0] == 'N' || residue[0] == 'C'); /* NALA, CALA: ends of a chain */
    return residue_is_in(RESIDUE_ACIDS, residue, length) || residue_is_in(RESIDUE_OTHER_ACIDS, residue, length) ||
           (is_end && residue_is_in(RESIDUE_ACIDS, residue + 1, 3));
}

static inline int residue_is_water(const char *residue)
{
    return residue_is_in(RESIDUE_WATERS, residue, strlen(residue));
}

#endif
