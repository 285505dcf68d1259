/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Residues of molecules by their names, in capitals, as PDB, GROMACS, CHARMM and AMBER have them. */
#ifndef RESIDUES_H
#define RESIDUES_H

#include "trajectory/text/text_reader.h"

/* Whether a residue is of H, C, N, O, P and S alone, named by their places: an amino acid, with the letter or digit for
 * its state or its end that force fields put behind or before (HISE, LYSH, CYS2, NALA), a nucleotide, water. */
int residue_is_organic(text_span residue);

#endif
