/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * PSF of CHARMM, X-PLOR and NAMD, which tells what atoms are and has no places: sections begin with a count and a
 * keyword, "8 !NATOM", and end by that count. Of each atom there are a number, segment, residue, names, charge and
 * mass; bonds are pairs of numbers. Other sections are passed over. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/topologies/atom_facts.h"

#include <inttypes.h>
#include <string.h>

enum { MOST_WORDS = 12 };

typedef struct psf_state {
    atom_facts facts; /* first: atom_facts.h */
    int was_read;
} psf_state;

static int psf_begin(cgt_trajectory *t)
{
    psf_state *const s = t->state;
    s->was_read = 0;
    return 1;
}

/* A charge or a mass: types may be whole numbers. */
static int is_fraction(text_span word)
{
    double number;
    return text_double(word, &number) && memchr(word.begin, '.', text_length(word)) != NULL;
}

/* "1 MAIN 5 ALA CA CT1 0.07 12.011 0", perhaps without the segment. */
static int read_atom(cgt_trajectory *t, uint32_t i)
{
    psf_state *const s = t->state;
    text_span line, word[MOST_WORDS];
    size_t words = 0;
    if (trajectory_line_inside(t, &line, "in the atoms") < 0)
        return -1;
    while (words < MOST_WORDS && text_word(&line, &word[words]))
        words++;
    const int lacks_segment = words > 6 && is_fraction(word[5]) && is_fraction(word[6]);
    const size_t first = lacks_segment ? 1 : 2; /* of the residue */
    uint64_t id;
    atom_fact a;
    if (words < first + 6 || !text_u64(word[0], UINT32_MAX, &id) || !text_double(word[first + 4], &a.charge) ||
        !text_double(word[first + 5], &a.mass))
        return trajectory_fail(t, t->text.line, "an atom has a number, a residue, names, a charge and a mass");
    a.id = (uint32_t)id;
    a.segment = first == 2 ? word[1] : (text_span){word[0].end, word[0].end};
    a.resid = word[first];
    a.residue = word[first + 1];
    a.name = word[first + 2];
    a.has_mass = 1;
    a.number = 0;
    return atom_facts_add(t, &s->facts, i, &a);
}

static int read_atoms(cgt_trajectory *t, uint64_t count)
{
    psf_state *const s = t->state;
    if (s->facts.count > 0)
        return trajectory_fail(t, t->text.line, "a second section of atoms");
    for (uint64_t i = 0; i < count; i++)
        if (i >= t->options.max_count || read_atom(t, (uint32_t)i) < 0)
            return t->failed ? -1
                             : trajectory_fail(t, t->text.line, "more atoms than the limit of %" PRIu64,
                                               t->options.max_count);
    return 1;
}

/* Pairs of atoms, several on a line. */
static int read_bonds(cgt_trajectory *t, uint64_t count)
{
    psf_state *const s = t->state;
    text_span line = {NULL, NULL}, word;
    uint64_t id[2];
    for (uint64_t i = 0; i < 2 * count; i++) {
        while (!text_word(&line, &word))
            if (trajectory_line_inside(t, &line, "in the bonds") < 0)
                return -1;
        if (!text_u64(word, UINT32_MAX, &id[i % 2]))
            return trajectory_fail(t, t->text.line, "a bond has the numbers of two atoms");
        if (i % 2 == 1 && bond_list_add(&s->facts.bond, (uint32_t)id[0], (uint32_t)id[1]))
            return trajectory_fail(t, t->text.line, "not enough memory for the bonds");
    }
    return 1;
}

static int psf_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    psf_state *const s = t->state;
    text_span line, rest, word;
    uint64_t count;
    if (s->was_read)
        return 0;
    int status = trajectory_line(t, &line);
    if (status <= 0)
        return status;
    if (!text_begins(line, "PSF"))
        return trajectory_fail(t, t->text.line, "not a PSF file: it does not begin with PSF");
    if (atom_facts_begin(t, &s->facts) < 0)
        return -1;
    while ((status = trajectory_line(t, &line)) > 0) {
        rest = line;
        if (!text_word(&rest, &word) || !text_u64(word, UINT64_MAX, &count) || !text_word(&rest, &word))
            continue;
        if ((text_is(word, "!NATOM") && read_atoms(t, count) < 0) ||
            (text_begins(word, "!NBOND") && read_bonds(t, count) < 0))
            return -1;
    }
    s->was_read = 1;
    return status < 0 ? -1 : atom_facts_finish(t, &s->facts, frame);
}

static void psf_end(cgt_trajectory *t)
{
    psf_state *const s = t->state;
    atom_facts_free(&s->facts);
}

const trajectory_format trajectory_format_psf = {
    .lacks_places = 1,
    .state_size = sizeof(psf_state),
    .begin = psf_begin,
    .read = psf_read,
    .end = psf_end,
};
