/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Atoms without places. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/topologies/atom_facts.h"
#include "trajectory/atoms/trajectory_sites.h"

#include <math.h>
#include <string.h>

static const struct {
    const char *name;
    cgt_trajectory_column_kind kind;
} columns[FACT_COLUMNS] = {{"name", CGT_TRAJECTORY_WORD},     {"resname", CGT_TRAJECTORY_WORD},
                           {"segment", CGT_TRAJECTORY_WORD},  {"resid", CGT_TRAJECTORY_WHOLE},
                           {"charge", CGT_TRAJECTORY_NUMBER}, {"mass", CGT_TRAJECTORY_NUMBER}};

int atom_facts_begin(cgt_trajectory *t, atom_facts *f)
{
    f->count = 0;
    f->has_element = 0;
    bond_list_clear(&f->bond);
    for (int k = 0; k < FACT_COLUMNS; k++)
        if ((f->slot[k] = columns_add_named(t, columns[k].name, columns[k].kind)) < 0)
            return -1;
    return trajectory_reserve(t, 0, SIZE_MAX);
}

static void store_columns(cgt_trajectory *t, const atom_facts *f, uint32_t i, const atom_fact *a)
{
    const text_span words[3] = {a->name, a->residue, a->segment};
    double resid = NAN;
    for (int k = 0; k < 3; k++)
        if (f->slot[k] > 0)
            columns_store_word(t, f->slot[k], i, words[k]);
    field_double(a->resid, &resid);
    const double numbers[3] = {resid, a->charge, a->has_mass ? a->mass : NAN};
    for (int k = 0; k < 3; k++)
        if (f->slot[3 + k] > 0)
            columns_values(t, f->slot[3 + k])[i] = (float)numbers[k];
}

/* The atomic number that the file tells, or that of the mass; 0: neither. Atoms whose hydrogens are heavier at their
 * cost may have the mass of a lighter element, O of OH that of N, C of CH that of Be: C, N and O go by their names. */
static uint32_t find_number(const atom_fact *a)
{
    if (a->number != 0 || !a->has_mass)
        return a->number;
    const uint32_t found = element_by_mass(a->mass);
    const char letter = text_length(a->name) > 0 ? *a->name.begin : 'X';
    const int is_other = strchr("CNO", letter) != NULL && *element_symbol(found) != letter;
    return found > 1 && found <= 8 && is_other ? 0 : found;
}

int atom_facts_add(cgt_trajectory *t, atom_facts *f, uint32_t i, const atom_fact *a)
{
    char key[64];
    if (trajectory_reserve(t, (size_t)i + 1, SIZE_MAX) < 0)
        return -1;
    snprintf(key, sizeof key, "%.*s %.*s", (int)(text_length(a->segment) < 20 ? text_length(a->segment) : 20),
             a->segment.begin, (int)(text_length(a->resid) < 20 ? text_length(a->resid) : 20), a->resid.begin);
    const uint32_t site =
        atoms_set_residue(t, &f->residues, i, (text_span){key, key + strlen(key)}, a->residue, a->name);
    const uint32_t number = find_number(a);
    const int is_massless = a->has_mass && a->mass < SITE_LIGHTEST;
    const int is_atom = a->number != 0 || (a->has_mass && a->mass >= 1.0); /* whatever its name is */
    const uint32_t element = is_massless || (site != 0 && !is_atom) ? SITE_MARK
                             : number != 0                          ? number
                                           : molecule_element(t, a->name, a->residue, NAME_ANYWHERE);
    atoms_set_place(t, i, '\0');
    t->store.id[i] = a->id;
    for (int k = 0; k < 3; k++)
        t->store.xyzr[4 * (size_t)i + (size_t)k] = NAN;
    f->has_element |= element != 0;
    f->count = i + 1;
    const text_span name = text_length(a->name) > 0 ? a->name : MOLECULE_UNNAMED;
    store_columns(t, f, i, a);
    return molecule_store(t, &f->names, i, name, element, 1.0f);
}

int atom_facts_finish(cgt_trajectory *t, atom_facts *f, cgt_trajectory_frame *frame)
{
    if (f->count == 0)
        return trajectory_fail(t, t->text.line, "the file has no atoms");
    if (bond_list_index(t, &f->bond, f->count) < 0 || bond_list_resolve(t, &f->bond) < 0)
        return -1;
    molecule_tell_guesses(t);
    trajectory_frame_fill(t, frame, f->count);
    frame->id = t->store.id;
    frame->type = t->store.type;
    frame->element = f->has_element ? t->store.element : NULL;
    frame->bonds = (uint32_t)f->bond.count;
    frame->bond = f->bond.count > 0 ? f->bond.pair : NULL;
    frame->bond_source = CGT_TRAJECTORY_BONDS_LISTED;
    return 1;
}

void atom_facts_free(atom_facts *f) { bond_list_free(&f->bond); }
