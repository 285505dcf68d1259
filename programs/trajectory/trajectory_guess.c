/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bonds that files do not list. Two atoms are bonded where they are no farther apart than their covalent radii and 0.45
 * Angstrom more, through periodic boundaries, too. Where a format lists some bonds, as .pdb does, those within amino
 * acids, nucleotides and water are guessed nevertheless, and so are those of any other residue of which it lists none;
 * what it lists is added. Two of the places that an atom may have are never bonded. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_guess.h"
#include "data/near_pairs.h"
#include "sequence/periodic_box.h"
#include "trajectory/trajectory_atoms.h"
#include "trajectory/trajectory_topology.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Covalent radii ------------------------------------------------------------------------------------------ */

/* Angstrom, in order of atomic numbers: B. Cordero, V. Gomez, A. E. Platero-Prats, M. Reves, J. Echeverria, E.
 * Cremades, F. Barragan, S. Alvarez, "Covalent radii revisited", Dalton Trans. (2008), 2832-2838, table 2; of carbon
 * sp3, of manganese, iron and cobalt low spin. */
static const float covalent[] = {
    0.31f, 0.28f, 1.28f, 0.96f, 0.84f, 0.76f, 0.71f, 0.66f, 0.57f, 0.58f, 1.66f, 1.41f, 1.21f, 1.11f, 1.07f, 1.05f,
    1.02f, 1.06f, 2.03f, 1.76f, 1.70f, 1.60f, 1.53f, 1.39f, 1.39f, 1.32f, 1.26f, 1.24f, 1.32f, 1.22f, 1.22f, 1.20f,
    1.19f, 1.20f, 1.20f, 1.16f, 2.20f, 1.95f, 1.90f, 1.75f, 1.64f, 1.54f, 1.47f, 1.46f, 1.42f, 1.39f, 1.45f, 1.44f,
    1.42f, 1.39f, 1.39f, 1.38f, 1.39f, 1.40f, 2.44f, 2.15f, 2.07f, 2.04f, 2.03f, 2.01f, 1.99f, 1.98f, 1.98f, 1.96f,
    1.94f, 1.92f, 1.92f, 1.89f, 1.90f, 1.87f, 1.87f, 1.75f, 1.70f, 1.62f, 1.51f, 1.44f, 1.41f, 1.36f, 1.36f, 1.32f,
    1.45f, 1.46f, 1.48f, 1.40f, 1.50f, 1.50f, 2.60f, 2.21f, 2.15f, 2.06f, 2.00f, 1.96f, 1.90f, 1.87f, 1.80f, 1.69f};
static const float tolerance = 0.45f, nearest = 0.4f; /* Angstrom, as Open Babel has them; nearer atoms are one */

/* 0: no element, or none that the table has. */
static float covalent_radius(uint8_t element)
{
    return element > 0 && element <= sizeof covalent / sizeof covalent[0] ? covalent[element - 1] : 0.0f;
}

/* ---- Which atoms may be bonded ------------------------------------------------------------------------------- */

typedef struct guess {
    const cgt_trajectory *t;
    const cgt_trajectory_frame *frame;
    bond_list *bonds;
    uint8_t *is_told; /* of each residue: its bonds are those that the file lists; NULL: of none */
    float *xyzr;      /* the atoms in the box, then their images near its boundaries */
    uint32_t *atom;   /* of each of them */
    size_t count, capacity;
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

/* Adds a near pair, whose ends may be images. */
static int take_pair(void *user, uint32_t first, uint32_t second, float square)
{
    guess *const g = user;
    const uint32_t a = g->atom[first], b = g->atom[second];
    const float ra = covalent_radius(g->frame->element[a]), rb = covalent_radius(g->frame->element[b]);
    const float least = nearest * g->frame->angstrom, most = (ra + rb + tolerance) * g->frame->angstrom;
    if ((first >= g->frame->count && second >= g->frame->count) || a == b || !(ra > 0.0f) || !(rb > 0.0f) ||
        square < least * least || square > most * most || !may_be_bonded(g, a, b))
        return 0;
    return bond_list_add(g->bonds, a, b);
}

/* ---- Images --------------------------------------------------------------------------------------------------- */

static int reserve(guess *g, size_t count)
{
    if (count <= g->capacity)
        return 0;
    const size_t capacity = count + count / 4 + 64;
    if (capacity > UINT32_MAX || trajectory_grow(&g->xyzr, capacity, 4 * sizeof *g->xyzr) ||
        trajectory_grow(&g->atom, capacity, sizeof *g->atom))
        return -1;
    g->capacity = capacity;
    return 0;
}

static void set(guess *g, size_t at, uint32_t atom, const double place[3])
{
    for (int c = 0; c < 3; c++)
        g->xyzr[4 * at + (size_t)c] = (float)place[c];
    g->xyzr[4 * at + 3] = 0.0f;
    g->atom[at] = atom;
}

/* Moves the atoms into the box. */
static int place_atoms(guess *g, const periodic_box *box)
{
    if (reserve(g, (size_t)g->frame->count + 1))
        return -1;
    for (uint32_t i = 0; i < g->frame->count; i++) {
        const float *const from = g->frame->xyzr + 4 * (size_t)i;
        const double p[3] = {(double)from[0], (double)from[1], (double)from[2]};
        double place[3] = {p[0], p[1], p[2]};
        for (int e = 0; e < 3; e++) {
            const double whole = floor(cgt_periodic_box_share(box, e, p));
            for (int c = 0; c < 3 && isfinite(whole); c++)
                place[c] -= whole * box->edge[e][c];
        }
        set(g, i, i, place);
    }
    g->count = g->frame->count;
    return 0;
}

enum { MOST_IMAGES = 4 }; /* on each side: of cells so small that more are needed, some bonds are missing */

/* Adds images of all that is there, along one edge, as far as bonds reach. */
static int add_images(guess *g, const periodic_box *box, int e, double longest)
{
    const double height = cgt_periodic_box_height(box, e);
    const size_t before = g->count;
    if (!(height > 0.0))
        return 0;
    const double reach = longest / height; /* in shares of the edge */
    for (size_t i = 0; i < before; i++) {
        const double p[3] = {(double)g->xyzr[4 * i], (double)g->xyzr[4 * i + 1], (double)g->xyzr[4 * i + 2]};
        const double share = cgt_periodic_box_share(box, e, p);
        for (int step = -MOST_IMAGES; step <= MOST_IMAGES; step++) {
            double place[3];
            if (step == 0 || !(share + step >= -reach && share + step <= 1.0 + reach))
                continue;
            for (int c = 0; c < 3; c++)
                place[c] = p[c] + step * box->edge[e][c];
            if (reserve(g, g->count + 1))
                return -1;
            set(g, g->count++, g->atom[i], place);
        }
    }
    return 0;
}

/* ---- A frame ---------------------------------------------------------------------------------------------------- */

/* Adds the guessed bonds to t->bonds. Returns 0, or -1: no memory. */
static int find_bonds(cgt_trajectory *t, const cgt_trajectory_frame *f)
{
    guess g = {.t = t, .frame = f, .bonds = &t->bonds};
    const periodic_box box = cgt_periodic_box_of(f);
    float largest = 0.0f;
    for (uint32_t i = 0; i < f->count; i++)
        largest = fmaxf(largest, covalent_radius(f->element[i]));
    const float longest = (2.0f * largest + tolerance) * f->angstrom;
    int failed = mark_residues(&g) || place_atoms(&g, &box);
    for (int e = 0; e < 3 && !failed; e++)
        failed = add_images(&g, &box, e, (double)longest);
    failed = failed || cgt_near_pairs_find(g.xyzr, (uint32_t)g.count, longest, take_pair, &g);
    free(g.is_told);
    free(g.xyzr);
    free(g.atom);
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
