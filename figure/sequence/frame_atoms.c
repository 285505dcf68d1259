/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Elements by type, and guessed bonds; see frame_atoms.h. */
#include "sequence/frame_atoms.h"

#include <stdlib.h>
#include <string.h>

#include "data/molecule/bond_guess.h"
#include "data/molecule/element_radii.h"
#include "options/numbers.h"

static int fail_memory(const cgt_trajectory_frame *f, char *error, size_t error_size)
{
    return cgt_refuse(error, error_size, "out of memory for the atoms of frame %llu", (unsigned long long)f->number);
}

void cgt_frame_atoms_set(frame_atoms *a, const atom_type *type, uint32_t types, int wants_bonds)
{
    memcpy(a->type, type, types * sizeof *type);
    a->types = types;
    a->wants_bonds = wants_bonds;
}

/* ---- Elements ----------------------------------------------------------------------------------------------- */

static int reserve(frame_atoms *a, size_t count)
{
    if (a->element && count <= a->room)
        return 0;
    free(a->element);
    free(a->xyzr);
    a->element = malloc(count + 1);
    a->xyzr = malloc((count + 1) * 4 * sizeof *a->xyzr);
    a->room = count;
    if (a->element && a->xyzr)
        return 0;
    free(a->element);
    a->element = NULL;
    return -1;
}

/* The element of a type; -1: nothing is said of it. */
static int element_of(const frame_atoms *a, uint32_t type)
{
    int element = -1;
    for (uint32_t k = 0; k < a->types; k++)
        element = a->type[k].type == type ? a->type[k].element : element;
    return element;
}

/* Neighbours in a file are mostly of few types. */
static int set_elements(frame_atoms *a, cgt_trajectory_frame *f, char *error, size_t error_size)
{
    if (!f->type)
        return cgt_refuse(error, error_size, "--type-element: frame %llu has no types", (unsigned long long)f->number);
    if (reserve(a, f->count))
        return fail_memory(f, error, error_size);
    f->angstrom = f->angstrom > 0.0f ? f->angstrom : 1.0f;
    memcpy(a->xyzr, f->xyzr, (size_t)f->count * 4 * sizeof *a->xyzr);
    uint32_t type = 0;
    int element = element_of(a, type);
    for (uint32_t i = 0; i < f->count; i++) {
        element = f->type[i] == type ? element : element_of(a, f->type[i]);
        type = f->type[i];
        a->element[i] = element >= 0 ? (uint8_t)element : f->element ? f->element[i] : 0;
        if (element >= 0 && !f->has_radius)
            a->xyzr[4 * (size_t)i + 3] = element_radius((uint32_t)element) * f->angstrom;
    }
    f->element = a->element;
    f->xyzr = a->xyzr;
    return 0;
}

/* ---- Bonds -------------------------------------------------------------------------------------------------- */

static int take_bond(void *user, uint32_t first, uint32_t second)
{
    frame_atoms *const a = user;
    if (a->bonds == a->bond_room) {
        const size_t room = a->bond_room ? 2 * a->bond_room : 1024;
        uint32_t *const more = room <= UINT32_MAX ? realloc(a->bond, room * 2 * sizeof *more) : NULL;
        if (!more)
            return -1;
        a->bond = more;
        a->bond_room = room;
    }
    a->bond[2 * (size_t)a->bonds] = first;
    a->bond[2 * (size_t)a->bonds + 1] = second;
    a->bonds++;
    return 0;
}

/* Those that were guessed by other elements are guessed anew. */
static int needs_bonds(const frame_atoms *a, const cgt_trajectory_frame *f)
{
    return a->wants_bonds && f->element &&
           (f->bond_source == CGT_TRAJECTORY_BONDS_UNKNOWN ||
            (f->bond_source == CGT_TRAJECTORY_BONDS_GUESSED && a->types));
}

int cgt_frame_atoms_complete(frame_atoms *a, cgt_trajectory_frame *f, char *error, size_t error_size)
{
    if (f->kind != CGT_TRAJECTORY_SPHERES)
        return 0;
    if (a->types && set_elements(a, f, error, error_size))
        return -1;
    if (!needs_bonds(a, f))
        return 0;
    a->bonds = 0;
    if (cgt_guess_bonds(f, take_bond, a))
        return fail_memory(f, error, error_size);
    a->bonds = (uint32_t)cgt_sort_bonds(a->bond, a->bonds);
    f->bonds = a->bonds;
    f->bond = a->bonds ? a->bond : NULL;
    f->bond_source = CGT_TRAJECTORY_BONDS_GUESSED;
    return 0;
}

void cgt_frame_atoms_free(frame_atoms *a)
{
    free(a->element);
    free(a->xyzr);
    free(a->bond);
    memset(a, 0, sizeof *a);
}
