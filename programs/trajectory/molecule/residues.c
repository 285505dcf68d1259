/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Residues of elements that are named by their places; see residues.h. */
#include "trajectory/molecule/residues.h"

#include "data/molecule/residue_names.h"

static const char nucleotides[] = " A C G U T I DA DC DG DT DU DI RA RC RG RU ADE CYT GUA THY URA ";

int residue_is_organic(text_span residue)
{
    const size_t length = text_length(residue);
    const char *const name = residue.begin;
    if (length < 1 || length > 4)
        return 0;
    for (size_t at = 0; at + 3 <= length; at++)
        if (residue_is_in(RESIDUE_ACIDS, name + at, 3))
            return 1;
    const int is_end = length > 1 && (name[length - 1] == '3' || name[length - 1] == '5') && name[0] != 'T';
    const size_t letters = is_end ? length - 1 : length; /* DA5, DA3: ends of a chain */
    return residue_is_in(nucleotides, name, letters) || residue_is_in(RESIDUE_WATERS, name, letters);
}
