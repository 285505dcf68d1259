/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Sites that are no atoms, by their names in GROMACS, Amber, CHARMM, OpenMM, NMR structures and quantum chemistry. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/atoms/trajectory_sites.h"
#include "data/molecule/residue_names.h"
#include "trajectory/molecule/residues.h"
#include "trajectory/trajectory_internal.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define SITE_RADIUS 0.5f /* Angstrom: lies within the oxygen of water, and is seen where that is small */

/* ---- Names ------------------------------------------------------------------------------------------------------ */

enum { LONGEST = 15 };

/* The text in capitals, cut off where it is longer than any name below. */
static void copy_capitals(text_span from, char to[LONGEST + 1])
{
    const size_t length = text_length(from) < LONGEST ? text_length(from) : LONGEST;
    for (size_t i = 0; i < length; i++)
        to[i] = from.begin[i] >= 'a' && from.begin[i] <= 'z' ? (char)(from.begin[i] - 'a' + 'A') : from.begin[i];
    to[length] = '\0';
}

/* Words of a list have a blank before and behind. */
static int is_in(const char *list, const char *word)
{
    char wanted[LONGEST + 3];
    snprintf(wanted, sizeof wanted, " %s ", word);
    return *word != '\0' && strstr(list, wanted) != NULL;
}

/* Whether a name is one of these, perhaps with two more letters or digits: EP, EPW, EP1, LPA, MW, VS1. */
static int has_stem(const char *name)
{
    static const char stems[] = " EP LP MW VS ";
    const char stem[3] = {name[0], name[0] != '\0' ? name[1] : '\0', '\0'};
    return strlen(stem) == 2 && is_in(stems, stem) && strlen(name) <= 4;
}

/* Ghosts have the name of an element in them: Gh(O), Gh.C, @O, O-Bq, BqH, "C:". */
static int is_ghost(const char *name)
{
    const size_t length = strlen(name);
    return name[0] == '@' || (length > 1 && name[length - 1] == ':') || strncmp(name, "GH(", 3) == 0 ||
           strncmp(name, "GH.", 3) == 0 || strncmp(name, "GH-", 3) == 0 || strncmp(name, "BQ", 2) == 0 ||
           strstr(name, "-BQ") != NULL || strstr(name, "-GH") != NULL;
}

/* By the residue: charges of water beside O and H, pseudo-atoms of amino acids and nucleotides (QB, MG1). */
static int is_site_of(const char *name, const char *residue, text_span given)
{
    static const char of_water[] = " M OM IW MP L1 L2 Q ";
    if (strcmp(residue, "DUM") == 0)
        return 1;
    if (residue_is_water(residue))
        return is_in(of_water, name) || strncmp(name, "DO", 2) == 0;
    const int is_pseudo = name[0] == 'Q' || (name[0] == 'M' && name[1] != '\0');
    return is_pseudo && residue_is_organic(given);
}

uint32_t site_find(text_span name, text_span residue, text_span before)
{
    static const char anywhere[] = " X XX BQ GH GHOST DU DUM DUMMY VIRT VSITE MCH3 MNH3 ", bare[] = " VA VAC VACANCY ";
    char own[LONGEST + 1], of[LONGEST + 1], last[LONGEST + 1];
    copy_capitals(name, own);
    copy_capitals(residue, of);
    copy_capitals(before, last);
    const int is_drude = own[0] == 'D' && *last != '\0' && strcmp(own + 1, last) == 0;
    if (is_in(anywhere, own) || has_stem(own) || is_drude)
        return SITE_MARK;
    if (*of != '\0')
        return is_site_of(own, of, residue) ? SITE_MARK : 0;
    if (strcmp(own, "M") == 0)
        return SITE_OF_WATER;
    return is_in(bare, own) || is_ghost(own) ? SITE_MARK : 0;
}

/* ---- Frames ----------------------------------------------------------------------------------------------------- */

static int is_marked(uint8_t element) { return element == SITE_MARK || element == SITE_OF_WATER; }

void sites_finish(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    trajectory_store *const s = &t->store;
    const size_t n = frame->count;
    t->sites = 0;
    if (frame->kind != CGT_TRAJECTORY_SPHERES || frame->element == NULL || n == 0 ||
        (memchr(s->element, SITE_MARK, n) == NULL && memchr(s->element, SITE_OF_WATER, n) == NULL))
        return;
    size_t atoms = 0;
    for (size_t i = 0; i < n; i++)
        atoms += s->element[i] != 0 && !is_marked(s->element[i]);
    for (size_t i = 0; i < n; i++) {
        const uint8_t element = s->element[i], before = i > 0 ? s->element[i - 1] : 0;
        s->site[i] = atoms > 0 && (element == SITE_MARK || (element == SITE_OF_WATER && (before == 1 || before == 8)));
        t->sites += s->site[i];
        s->element[i] = is_marked(element) ? 0 : element;
    }
    if (atoms == 0)
        frame->element = NULL;
    sites_set_radii(t, frame);
}

void sites_set_radii(cgt_trajectory *t, const cgt_trajectory_frame *frame)
{
    for (size_t i = 0; i < frame->count && t->sites > 0 && !frame->has_radius && !(t->options.radius > 0.0f); i++)
        if (t->store.site[i])
            t->store.xyzr[4 * i + 3] = SITE_RADIUS * frame->angstrom;
}

/* ---- Leaving them out ------------------------------------------------------------------------------------------- */

/* Moves the rows of an array together, those of sites left out; NULL has none. */
static void compact(const cgt_trajectory *t, size_t count, void *array, size_t bytes)
{
    unsigned char *const rows = array;
    size_t to = 0;
    for (size_t i = 0; i < count && rows != NULL; i++)
        if (!t->store.site[i]) {
            memmove(rows + to * bytes, rows + i * bytes, bytes);
            to++;
        }
}

/* The bonds between atoms, by their new numbers, which id has for them. */
static int compact_bonds(cgt_trajectory *t, cgt_trajectory_frame *frame, const uint32_t *number)
{
    bond_list kept = {0};
    int failed = 0;
    for (size_t i = 0; i < frame->bonds && !failed; i++) {
        const uint32_t a = frame->bond[2 * i], b = frame->bond[2 * i + 1];
        if (!t->store.site[a] && !t->store.site[b])
            failed = bond_list_add(&kept, number[a], number[b]);
    }
    bond_list_free(&t->bonds);
    t->bonds = kept;
    frame->bonds = (uint32_t)kept.count;
    frame->bond = kept.count > 0 ? kept.pair : NULL;
    return failed;
}

int sites_leave_out(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    trajectory_store *const s = &t->store;
    const size_t count = frame->count;
    if (!t->options.leave_out_sites || t->sites == 0)
        return 1;
    uint32_t *const number = malloc(count * sizeof *number);
    uint32_t atoms = 0;
    for (size_t i = 0; i < count && number != NULL; i++) {
        number[i] = atoms;
        atoms += !s->site[i];
    }
    const int failed = number == NULL || compact_bonds(t, frame, number);
    free(number);
    if (failed)
        return trajectory_fail(t, 0, "not enough memory to leave out what is no atom");
    trajectory_warn(t, DOUBT_SITES, 0,
                    "%" PRIu32
                    " of %zu spheres are no atoms (virtual sites, lone pairs, dummies, ghosts): they are left "
                    "out",
                    t->sites, count);
    for (uint32_t k = 0; k < t->columns.wanted_count; k++)
        if (t->columns.wanted[k].is_used)
            compact(t, count, t->columns.wanted[k].value, sizeof(float));
    compact(t, count, s->xyzr, 4 * sizeof *s->xyzr);
    compact(t, count, s->id, sizeof *s->id);
    compact(t, count, s->type, sizeof *s->type);
    compact(t, count, s->velocity, 3 * sizeof *s->velocity);
    compact(t, count, s->element, sizeof *s->element);
    frame->count = atoms;
    return 1;
}
