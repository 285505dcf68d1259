/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bonds that files do not list, by the rule of bond_guess.h. Where a format lists some bonds, as .pdb does, those
 * within amino acids, nucleotides and water are guessed nevertheless, and so are those of any other residue of which it
 * lists none; what it lists is added. Two of the places that an atom may have are never bonded. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_guess.h"
#include "data/molecule/bond_guess.h"
#include "trajectory/atoms/trajectory_atoms.h"
#include "trajectory/atoms/trajectory_topology.h"

#include <stdlib.h>

/* ---- Which atoms may be bonded ------------------------------------------------------------------------------- */

typedef struct guess {
    const cgt_trajectory *t;
    const cgt_trajectory_frame *frame;
    bond_list *bonds;
    uint8_t *is_told; /* of each residue: its bonds are those that the file lists; NULL: of none */
} guess;

/* Marks the residues whose bonds are listed: no amino acid, nucleotide or water, and one of its bonds is in the list,
 * or it is an atom alone, such as an ion. Returns 0, or -1: no memory. */
static int mark_residues(guess *g)
{
    const uint32_t *const residue = g->t->store.residue;
    const cgt_trajectory_frame *const f = g->frame;
    if (f->bonds == 0 || f->count == 0 || !g->t->store.has_residues)
        return 0;
    const size_t residues = (size_t)RESIDUE_NUMBER(residue[f->count - 1]) + 1;
    g->is_told = calloc(residues, 1);
    if (g->is_told == NULL)
        return -1;
    for (uint32_t i = 0; i < f->count; i++) {
        const int is_alone =
            (i == 0 || residue[i - 1] != residue[i]) && (i + 1 == f->count || residue[i + 1] != residue[i]);
        if (is_alone && !RESIDUE_IS_STANDARD(residue[i]))
            g->is_told[RESIDUE_NUMBER(residue[i])] = 1;
    }
    for (uint32_t i = 0; i < f->bonds; i++) {
        const uint32_t a = residue[f->bond[2 * (size_t)i]], b = residue[f->bond[2 * (size_t)i + 1]];
        if (a == b && !RESIDUE_IS_STANDARD(a))
            g->is_told[RESIDUE_NUMBER(a)] = 1;
    }
    return 0;
}

static int may_be_bonded(const guess *g, uint32_t a, uint32_t b)
{
    const trajectory_store *const s = &g->t->store;
    if (s->has_places && s->place[a] != '\0' && s->place[b] != '\0' && s->place[a] != s->place[b])
        return 0;
    return g->is_told == NULL ||
           !(g->is_told[RESIDUE_NUMBER(s->residue[a])] || g->is_told[RESIDUE_NUMBER(s->residue[b])]);
}

static int take_bond(void *user, uint32_t a, uint32_t b)
{
    const guess *const g = user;
    return may_be_bonded(g, a, b) ? bond_list_add(g->bonds, a, b) : 0;
}

/* ---- A frame ---------------------------------------------------------------------------------------------------- */

/* Adds the guessed bonds to t->bonds. Returns 0, or -1: no memory. */
static int find_bonds(cgt_trajectory *t, const cgt_trajectory_frame *f)
{
    guess g = {.t = t, .frame = f, .bonds = &t->bonds};
    const int failed = mark_residues(&g) || cgt_guess_bonds(f, take_bond, &g);
    free(g.is_told);
    return failed ? -1 : 0;
}

int bonds_complete(cgt_trajectory *t, cgt_trajectory_frame *f)
{
    const int is_listed = f->bond_source != CGT_TRAJECTORY_BONDS_UNKNOWN;
    if (!t->options.all_bonds || f->kind != CGT_TRAJECTORY_SPHERES || f->element == NULL ||
        (t->topology != NULL && t->topology->has_bonds) || (is_listed && !t->format->lists_some))
        return 1;
    bond_list_clear(&t->bonds);
    int failed = find_bonds(t, f);
    for (uint32_t i = 0; i < f->bonds && !failed; i++)
        failed = bond_list_add(&t->bonds, f->bond[2 * (size_t)i], f->bond[2 * (size_t)i + 1]);
    if (failed)
        return trajectory_fail(t, 0, "not enough memory for the bonds");
    bond_list_sort(&t->bonds);
    f->bonds = (uint32_t)t->bonds.count;
    f->bond = t->bonds.count > 0 ? t->bonds.pair : NULL;
    f->bond_source = is_listed ? CGT_TRAJECTORY_BONDS_BOTH : CGT_TRAJECTORY_BONDS_GUESSED;
    return 1;
}
