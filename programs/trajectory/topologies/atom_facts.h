/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What formats without places share, those of topologies: names, residues, charges, masses and all bonds. */
#ifndef ATOM_FACTS_H
#define ATOM_FACTS_H

#include "trajectory/molecule/molecule_atom.h"
#include "trajectory/atoms/trajectory_atoms.h"

typedef struct atom_fact {
    uint32_t id, number; /* number: atomic; 0: not told */
    text_span name, residue, resid, segment;
    double charge, mass;
    int has_mass;
} atom_fact;

enum { FACT_COLUMNS = 6 };

typedef struct atom_facts {
    name_table names;
    uint32_t count;
    int has_element;
    residue_run residues;
    bond_list bond; /* ids */
    int slot[FACT_COLUMNS];
} atom_facts;

/* Begins the frame. Returns 1 or -1. */
int atom_facts_begin(cgt_trajectory *t, atom_facts *f);

/* Stores atom i. Returns 1 or -1. */
int atom_facts_add(cgt_trajectory *t, atom_facts *f, uint32_t i, const atom_fact *a);

/* Completes the frame: bonds between ids become those of atoms. Returns 1 or -1: there are no atoms, or a bond is to
 * one that is not there. */
int atom_facts_finish(cgt_trajectory *t, atom_facts *f, cgt_trajectory_frame *frame);
void atom_facts_free(atom_facts *f);

#endif
