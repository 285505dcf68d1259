/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Lists of residues. */
#include "trajectory/molecule/residues.h"

#include <string.h>

/* Words of a list have a blank before and behind. */
static const char acids[] = " ALA ARG ASN ASP CYS GLN GLU GLY HIS ILE LEU LYS MET PHE PRO SER THR TRP TYR VAL HID HIE "
                            "HIP HSD HSE HSP CYX CYM ASH GLH LYN ACE NME NH2 HYP QLN SEP TPO PTR ";
static const char others[] =
    " MSE SEC PYL CSE NMA PGLU ARGN ASN1 ASP1 ASPH ASPP CYS1 CYS2 CYSH GLUH GLUP HIS1 HIS2 HISA "
    "HISB HISD HISE HISH HISP LYSH PHEH PHEU TRPH TRPU TYRH TYRU ";
static const char waters[] = " HOH WAT H2O DOD SOL OH2 TIP TIP2 TIP3 TIP4 TIP5 TIP3P TIP4P TIP5P TP3 TP4 TP5 T3P T4P "
                             "T5P T3H T4H SPC SPCE OPC T4E T4EW TP4E T5E ICE SWM4 SWM6 SW4 ";
static const char nucleotides[] = " A C G U T I DA DC DG DT DU DI RA RC RG RU ADE CYT GUA THY URA ";

enum { LONGEST = 5 };

static int is_in(const char *list, const char *begin, size_t length)
{
    char word[LONGEST + 3] = " ";
    if (length < 1 || length > LONGEST || memchr(begin, ' ', length) != NULL)
        return 0;
    memcpy(word + 1, begin, length);
    word[length + 1] = ' ';
    return strstr(list, word) != NULL;
}

int residue_is_organic(text_span residue)
{
    const size_t length = text_length(residue);
    const char *const name = residue.begin;
    if (length < 1 || length > 4)
        return 0;
    for (size_t at = 0; at + 3 <= length; at++)
        if (is_in(acids, name + at, 3))
            return 1;
    const int is_end = length > 1 && (name[length - 1] == '3' || name[length - 1] == '5') && name[0] != 'T';
    const size_t letters = is_end ? length - 1 : length; /* DA5, DA3: ends of a chain */
    return is_in(nucleotides, name, letters) || is_in(waters, name, letters);
}

int residue_is_protein(const char *residue)
{
    const size_t length = strlen(residue);
    const int is_end = length == 4 && (residue[0] == 'N' || residue[0] == 'C'); /* NALA, CALA: ends of a chain */
    return is_in(acids, residue, length) || is_in(others, residue, length) || (is_end && is_in(acids, residue + 1, 3));
}

int residue_is_water(const char *residue) { return is_in(waters, residue, strlen(residue)); }
