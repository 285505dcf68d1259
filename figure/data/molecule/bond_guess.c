/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Bonds by covalent radii; see bond_guess.h. */
#include "data/molecule/bond_guess.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "data/molecule/near_pairs.h"
#include "sequence/periodic_box.h"

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

/* ---- Pairs --------------------------------------------------------------------------------------------------- */

typedef struct guess {
    const cgt_trajectory_frame *frame;
    const periodic_box *box;
    bond_taker *take;             /* of pairs; NULL: take_image is asked */
    image_bond_taker *take_image; /* of bonds to other images than the nearest */
    uint32_t *pair;               /* then those of the frame, sorted */
    size_t pairs;
    void *user;
    float *xyzr;    /* the atoms in the box, then their images near its boundaries */
    uint32_t *atom; /* of each of them */
    size_t count, capacity;
} guess;

/* A vector between two places of the file. */
static void between(const guess *g, uint32_t from, uint32_t to, double step[3])
{
    for (size_t c = 0; c < 3; c++)
        step[c] = (double)g->frame->xyzr[4 * (size_t)to + c] - (double)g->frame->xyzr[4 * (size_t)from + c];
}

/* Whether the frame has the pair a <= b: readers leave out those of two places that one atom may have. */
static int is_bonded(const guess *g, uint32_t a, uint32_t b)
{
    const uint32_t pair[2] = {a, b};
    return a == b || bsearch(pair, g->pair, g->pairs, sizeof pair, cgt_compare_bonds) != NULL;
}

/* Tells a bond that is not to the nearest image. Each is found from both of its ends, where one is in the box: that of
 * the smaller number tells it, and of an atom and its own image the one whose first count is above 0. */
static int take_other(const guess *g, uint32_t first, uint32_t second)
{
    const uint32_t i = g->atom[first] < g->atom[second] ? first : second, k = i == first ? second : first;
    const uint32_t a = g->atom[i], b = g->atom[k];
    double step[3], count[3], drawn[3];
    int differs = 0, sign = 0;
    if ((a != b && i >= g->frame->count) || !is_bonded(g, a, b))
        return 0;
    between(g, a, b, step);
    cgt_periodic_box_count(g->box, step, drawn);
    for (size_t c = 0; c < 3; c++)
        step[c] -= (double)g->xyzr[4 * (size_t)k + c] - (double)g->xyzr[4 * (size_t)i + c];
    for (int e = 0; e < 3; e++) {
        count[e] = rint(cgt_periodic_box_share(g->box, e, step));
        differs |= count[e] != drawn[e];
        sign = sign ? sign : (count[e] > 0.0) - (count[e] < 0.0);
    }
    return differs && (a != b || sign > 0) ? g->take_image(g->user, a, b, count) : 0;
}

/* Tells a near pair, whose ends may be images. */
static int take_pair(void *user, uint32_t first, uint32_t second, float square)
{
    const guess *const g = user;
    const uint32_t a = g->atom[first], b = g->atom[second];
    const float ra = covalent_radius(g->frame->element[a]), rb = covalent_radius(g->frame->element[b]);
    const float least = nearest * g->frame->angstrom, most = (ra + rb + tolerance) * g->frame->angstrom;
    if ((first >= g->frame->count && second >= g->frame->count) || !(ra > 0.0f) || !(rb > 0.0f) ||
        square < least * least || square > most * most)
        return 0;
    if (!g->take)
        return take_other(g, first, second);
    return a == b ? 0 : g->take(g->user, a, b);
}

/* ---- Images --------------------------------------------------------------------------------------------------- */

static int reserve(guess *g, size_t count)
{
    if (count <= g->capacity)
        return 0;
    const size_t capacity = count + count / 4 + 64;
    if (capacity > UINT32_MAX || capacity > SIZE_MAX / (4 * sizeof *g->xyzr))
        return -1;
    float *const xyzr = realloc(g->xyzr, capacity * 4 * sizeof *xyzr);
    g->xyzr = xyzr ? xyzr : g->xyzr;
    uint32_t *const atom = realloc(g->atom, capacity * sizeof *atom);
    g->atom = atom ? atom : g->atom;
    if (!xyzr || !atom)
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

/* The longest bond that atoms of these elements may have. */
static float longest_bond(const cgt_trajectory_frame *f)
{
    float largest = 0.0f;
    for (uint32_t i = 0; i < f->count; i++)
        largest = fmaxf(largest, covalent_radius(f->element[i]));
    return (2.0f * largest + tolerance) * f->angstrom;
}

/* Tells the bonds up to a length. Returns 0, or -1: no memory. */
static int find_bonds(guess *g, const periodic_box *box, float longest)
{
    int failed = place_atoms(g, box);
    g->box = box;
    for (int e = 0; e < 3 && !failed; e++)
        failed = add_images(g, box, e, (double)longest);
    failed = failed || cgt_near_pairs_find(g->xyzr, (uint32_t)g->count, longest, take_pair, g);
    free(g->xyzr);
    free(g->atom);
    return failed ? -1 : 0;
}

int cgt_guess_bonds(const cgt_trajectory_frame *f, bond_taker *take, void *user)
{
    guess g = {.frame = f, .take = take, .user = user};
    const periodic_box box = cgt_periodic_box_of(f);
    return find_bonds(&g, &box, longest_bond(f));
}

int cgt_guess_image_bonds(const cgt_trajectory_frame *f, image_bond_taker *take, void *user)
{
    guess g = {.frame = f, .take_image = take, .user = user};
    const periodic_box box = cgt_periodic_box_of(f);
    const int is_guessed =
        f->bond_source == CGT_TRAJECTORY_BONDS_GUESSED || f->bond_source == CGT_TRAJECTORY_BONDS_BOTH;
    if (!is_guessed || !f->element)
        return 0;
    /* Two images that an atom is bonded to are at most two bonds apart, and two images at least the least height. */
    const float longest = longest_bond(f);
    if (box.sure > (double)longest)
        return 0;
    g.pair = malloc(((size_t)f->bonds + 1) * 2 * sizeof *g.pair);
    if (!g.pair)
        return -1;
    if (f->bonds)
        memcpy(g.pair, f->bond, (size_t)f->bonds * 2 * sizeof *g.pair);
    g.pairs = cgt_sort_bonds(g.pair, f->bonds);
    const int failed = find_bonds(&g, &box, longest);
    free(g.pair);
    return failed;
}

/* ---- Sorting ------------------------------------------------------------------------------------------------- */

int cgt_compare_bonds(const void *a, const void *b)
{
    const uint32_t *const left = a, *const right = b;
    const int i = left[0] == right[0];
    return (left[i] > right[i]) - (left[i] < right[i]);
}

size_t cgt_sort_bonds(uint32_t *pair, size_t count)
{
    size_t unique = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t first = pair[2 * i], second = pair[2 * i + 1];
        pair[2 * i] = first < second ? first : second;
        pair[2 * i + 1] = first < second ? second : first;
    }
    if (count > 1)
        qsort(pair, count, 2 * sizeof *pair, cgt_compare_bonds);
    for (size_t i = 0; i < count; i++) {
        if (unique > 0 && cgt_compare_bonds(pair + 2 * (unique - 1), pair + 2 * i) == 0)
            continue;
        pair[2 * unique] = pair[2 * i];
        pair[2 * unique + 1] = pair[2 * i + 1];
        unique++;
    }
    return unique;
}
