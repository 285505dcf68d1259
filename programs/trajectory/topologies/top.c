/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * GROMACS' topologies (.top, with the .itp files that they include), which tell what atoms are and have no places:
 * sections "[ atoms ]" of molecules, and "[ molecules ]", how many of each follow each other. Bonds are those of
 * functions that GROMACS takes for chemical ones, constraints likewise, and both of a rigid water molecule. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/topologies/atom_facts.h"
#include "trajectory/topologies/top_lines.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_WORDS = 12 };

typedef enum top_section {
    TOP_OTHER,
    TOP_TYPES,
    TOP_MOLECULE,
    TOP_ATOMS,
    TOP_BONDS,
    TOP_CONSTRAINTS,
    TOP_SETTLES,
    TOP_MOLECULES
} top_section;

/* A row of [ atomtypes ]. */
typedef struct top_type {
    double mass, charge;
    uint32_t number; /* atomic; 0: not told */
} top_type;

/* A row of [ atoms ]: words by their numbers among those of all. */
typedef struct top_atom {
    uint32_t type, residue, name;
    int64_t resid;
    double charge, mass; /* NaN: those of the type */
} top_atom;

typedef struct top_molecule {
    size_t atom, atoms, bond, bonds; /* in the arrays of all */
    uint32_t residues;               /* that follow each other */
    int64_t last_resid;              /* the largest */
} top_molecule;

/* A row of [ molecules ]. */
typedef struct top_run {
    uint32_t molecule;
    uint64_t count;
} top_run;

typedef struct top_state {
    atom_facts facts; /* first: atom_facts.h */
    int was_read;
    top_lines lines;
    word_map words, type_names, molecule_names;
    top_type *type; /* of each type's name */
    top_atom *atom;
    uint32_t (*bond)[2]; /* of atoms within their molecule, from 0 */
    top_molecule *molecule;
    top_run *run;
    size_t atoms, bonds, runs, type_capacity, atom_capacity, bond_capacity, molecule_capacity, run_capacity;
    top_molecule *last; /* that is read; NULL: none */
} top_state;

static int top_begin(cgt_trajectory *t)
{
    top_state *const s = t->state;
    s->was_read = 0;
    return 1;
}

/* ---- Rows ------------------------------------------------------------------------------------------------------- */

/* Makes room for one element more, of `bytes` each. */
static int reserve(cgt_trajectory *t, const top_state *s, void *array, size_t *capacity, size_t count, size_t bytes)
{
    if (count < *capacity)
        return 1;
    const size_t more = 2 * count + 64;
    if (trajectory_grow(array, more, bytes))
        return top_lines_fail(t, &s->lines, "not enough memory");
    *capacity = more;
    return 1;
}

static int add_word(cgt_trajectory *t, word_map *map, text_span word, uint32_t *number)
{
    const top_state *const s = t->state;
    *number = word_map_add(map, word);
    return *number != WORD_NONE ? 1 : top_lines_fail(t, &s->lines, "not enough memory");
}

/* "CT C 6 12.01 0.0 A 0.34 0.46": between the name and mass, charge and kind of particle there may be a type for bonds,
 * an atomic number, both or none. */
static int read_type(cgt_trajectory *t, const text_span *word, size_t words)
{
    top_state *const s = t->state;
    top_type type = {.mass = NAN, .charge = NAN};
    uint64_t number;
    uint32_t name;
    for (size_t i = 3; i < words; i++) {
        double mass, charge;
        if (text_length(word[i]) != 1 || !strchr("ASVD", *word[i].begin) || !text_double(word[i - 2], &mass) ||
            !text_double(word[i - 1], &charge))
            continue;
        type.mass = mass;
        type.charge = charge;
        if (i > 3 && text_u64(word[i - 3], 118, &number))
            type.number = (uint32_t)number;
        break;
    }
    if (add_word(t, &s->type_names, word[0], &name) < 0 ||
        reserve(t, s, &s->type, &s->type_capacity, name, sizeof *s->type) < 0)
        return -1;
    s->type[name] = type;
    return 1;
}

static int begin_molecule(cgt_trajectory *t, text_span name)
{
    top_state *const s = t->state;
    uint32_t number;
    if (word_map_find(&s->molecule_names, name) != WORD_NONE)
        return top_lines_fail(t, &s->lines, "a second molecule of this name");
    if (add_word(t, &s->molecule_names, name, &number) < 0 ||
        reserve(t, s, &s->molecule, &s->molecule_capacity, number, sizeof *s->molecule) < 0)
        return -1;
    s->last = &s->molecule[number];
    *s->last = (top_molecule){.atom = s->atoms, .bond = s->bonds};
    return 1;
}

/* Of "17", or of "17A", with a letter for insertion; 0: none. */
static int64_t residue_number(text_span word)
{
    char digits[16];
    snprintf(digits, sizeof digits, "%.*s", (int)(text_length(word) < 10 ? text_length(word) : 10), word.begin);
    return strtoll(digits, NULL, 10);
}

/* "1 opls_116 1 SOL OW 1 -0.82 15.9994" */
static int read_atom(cgt_trajectory *t, const text_span *word, size_t words)
{
    top_state *const s = t->state;
    top_molecule *const m = s->last;
    top_atom a = {.charge = NAN, .mass = NAN};
    const top_atom before = m->atoms > 0 ? s->atom[s->atoms - 1] : a; /* a copy: the array moves where it grows */
    uint64_t number;
    if (words < 5 || !text_u64(word[0], UINT32_MAX, &number) || number != m->atoms + 1)
        return top_lines_fail(t, &s->lines,
                              "an atom has a number, 1 and so on, a type, and a residue's number and name");
    a.resid = residue_number(word[2]);
    if (s->atoms >= t->options.max_count)
        return top_lines_fail(t, &s->lines, "more atoms than the limit of %" PRIu64, t->options.max_count);
    if (add_word(t, &s->words, word[1], &a.type) < 0 || add_word(t, &s->words, word[3], &a.residue) < 0 ||
        add_word(t, &s->words, word[4], &a.name) < 0 ||
        reserve(t, s, &s->atom, &s->atom_capacity, s->atoms, sizeof *s->atom) < 0)
        return -1;
    if (words > 6 && !text_double(word[6], &a.charge))
        a.charge = NAN;
    if (words > 7 && !text_double(word[7], &a.mass))
        a.mass = NAN;
    m->residues += m->atoms == 0 || before.resid != a.resid || before.residue != a.residue;
    m->last_resid = m->atoms == 0 || a.resid > m->last_resid ? a.resid : m->last_resid;
    s->atom[s->atoms++] = a;
    m->atoms++;
    return 1;
}

static int add_bond(cgt_trajectory *t, uint64_t first, uint64_t second)
{
    top_state *const s = t->state;
    if (first < 1 || second < 1 || first > s->last->atoms || second > s->last->atoms)
        return top_lines_fail(t, &s->lines, "a bond to an atom that is not there");
    if (reserve(t, s, &s->bond, &s->bond_capacity, s->bonds, sizeof *s->bond) < 0)
        return -1;
    s->bond[s->bonds][0] = (uint32_t)first - 1;
    s->bond[s->bonds++][1] = (uint32_t)second - 1;
    s->last->bonds++;
    return 1;
}

/* Functions that are no chemical bonds: of [ bonds ] 6, a harmonic potential, 9, a table, and 10, a restraint; of
 * [ constraints ] 2 (GROMACS' manual, table of interactions). */
static int is_chemical(top_section section, uint64_t function)
{
    return section == TOP_BONDS ? function != 6 && function != 9 && function != 10 : function != 2;
}

static int read_bond(cgt_trajectory *t, top_section section, const text_span *word, size_t words)
{
    top_state *const s = t->state;
    uint64_t end[2] = {0, 0}, function = 1;
    const size_t ends = section == TOP_SETTLES ? 1 : 2;
    for (size_t i = 0; i < ends; i++)
        if (i >= words || !text_u64(word[i], UINT32_MAX, &end[i]))
            return top_lines_fail(t, &s->lines, "a bond has the numbers of two atoms");
    if (section == TOP_SETTLES)
        return add_bond(t, end[0], end[0] + 1) < 0 ? -1 : add_bond(t, end[0], end[0] + 2);
    if (words > 2)
        text_u64(word[2], UINT32_MAX, &function);
    return is_chemical(section, function) ? add_bond(t, end[0], end[1]) : 1;
}

/* As grompp: the name itself, or else the only one that is the same in letters of either case. */
static uint32_t find_molecule(const word_map *names, text_span name)
{
    const uint32_t found = word_map_find(names, name);
    uint32_t alike = WORD_NONE, count = 0;
    for (uint32_t i = 0; i < names->count && found == WORD_NONE; i++)
        if (strlen(names->word[i]) == text_length(name) &&
            strncasecmp(names->word[i], name.begin, text_length(name)) == 0) {
            alike = i;
            count++;
        }
    return count == 1 ? alike : found;
}

/* "SOL 216" */
static int read_run(cgt_trajectory *t, const text_span *word, size_t words)
{
    top_state *const s = t->state;
    char name[TEXT_QUOTE_SIZE];
    top_run run = {.molecule = find_molecule(&s->molecule_names, word[0])};
    if (run.molecule == WORD_NONE && s->lines.missing > 0)
        return top_lines_fail(
            t, &s->lines,
            "no molecule %s: the file includes %.200s, which is neither beside it nor where GROMACS has "
            "its force fields; the variable GMXLIB names their folder",
            text_quote(word[0], name), s->lines.first_missing);
    if (run.molecule == WORD_NONE)
        return top_lines_fail(t, &s->lines, "no molecule %s", text_quote(word[0], name));
    if (words < 2 || !text_u64(word[1], UINT32_MAX, &run.count))
        return top_lines_fail(t, &s->lines, "a molecule has a name and how many there are");
    if (reserve(t, s, &s->run, &s->run_capacity, s->runs, sizeof *s->run) < 0)
        return -1;
    s->run[s->runs++] = run;
    return 1;
}

/* ---- Sections --------------------------------------------------------------------------------------------------- */

/* "[ atoms ]" */
static top_section find_section(text_span line)
{
    static const char *const names[] = {NULL,    "atomtypes",   "moleculetype", "atoms",
                                        "bonds", "constraints", "settles",      "molecules"};
    line.begin++;
    const char *const end = memchr(line.begin, ']', text_length(line));
    line.end = end != NULL ? end : line.end;
    text_trim(&line);
    for (size_t i = 1; i < sizeof names / sizeof names[0]; i++)
        if (text_is(line, names[i]))
            return (top_section)i;
    return TOP_OTHER;
}

static int read_row(cgt_trajectory *t, top_section section, text_span line)
{
    top_state *const s = t->state;
    text_span word[MOST_WORDS];
    size_t words = 0;
    while (words < MOST_WORDS && text_word(&line, &word[words]))
        words++;
    if (section == TOP_TYPES)
        return read_type(t, word, words);
    if (section == TOP_MOLECULE)
        return begin_molecule(t, word[0]);
    if (section == TOP_MOLECULES)
        return read_run(t, word, words);
    if (s->last == NULL)
        return top_lines_fail(t, &s->lines, "a section of no molecule");
    return section == TOP_ATOMS ? read_atom(t, word, words) : read_bond(t, section, word, words);
}

static int read_sections(cgt_trajectory *t)
{
    top_state *const s = t->state;
    top_section section = TOP_OTHER;
    text_span line;
    int status;
    while ((status = top_lines_next(t, &s->lines, &line)) > 0) {
        if (*line.begin == '[')
            section = find_section(line);
        else if (section != TOP_OTHER && read_row(t, section, line) < 0)
            return -1;
    }
    return status;
}

/* ---- Atoms ------------------------------------------------------------------------------------------------------ */

static text_span word_of(const word_map *map, uint32_t number)
{
    return (text_span){map->word[number], map->word[number] + strlen(map->word[number])};
}

static int store_molecule(cgt_trajectory *t, const top_run *run, uint32_t first, int64_t resid)
{
    top_state *const s = t->state;
    const top_molecule *const m = &s->molecule[run->molecule];
    for (uint32_t i = 0; i < m->atoms; i++) {
        const top_atom *const a = &s->atom[m->atom + i];
        const uint32_t named = word_map_find(&s->type_names, word_of(&s->words, a->type));
        const top_type type = named != WORD_NONE ? s->type[named] : (top_type){.mass = NAN, .charge = NAN};
        char number[24];
        snprintf(number, sizeof number, "%" PRId64, m->residues == 1 ? resid : a->resid);
        const atom_fact fact = {.id = first + i,
                                .number = type.number,
                                .name = word_of(&s->words, a->name),
                                .residue = word_of(&s->words, a->residue),
                                .resid = {number, number + strlen(number)},
                                .segment = word_of(&s->molecule_names, run->molecule),
                                .charge = isnan(a->charge) ? type.charge : a->charge,
                                .mass = isnan(a->mass) ? type.mass : a->mass,
                                .has_mass = !isnan(a->mass) || !isnan(type.mass)};
        if (atom_facts_add(t, &s->facts, first + i, &fact) < 0)
            return -1;
    }
    for (size_t i = 0; i < m->bonds; i++)
        if (bond_list_add(&s->facts.bond, first + s->bond[m->bond + i][0], first + s->bond[m->bond + i][1]))
            return trajectory_fail(t, 0, "not enough memory for the bonds");
    return 1;
}

/* As GROMACS: molecules of one residue are numbered on, behind the largest number of others. */
static int store_molecules(cgt_trajectory *t)
{
    top_state *const s = t->state;
    int64_t resid = 0;
    uint64_t atoms = 0;
    for (size_t i = 0; i < s->runs; i++) {
        const top_molecule *const m = &s->molecule[s->run[i].molecule];
        if (m->residues > 1 && s->run[i].count > 0)
            resid = m->last_resid > resid ? m->last_resid : resid;
        if (m->atoms > 0 && s->run[i].count > (t->options.max_count - atoms) / m->atoms)
            return trajectory_fail(t, 0, "more atoms than the limit of %" PRIu64, t->options.max_count);
        atoms += m->atoms * s->run[i].count;
    }
    uint32_t first = 0;
    for (size_t i = 0; i < s->runs; i++) {
        const top_molecule *const m = &s->molecule[s->run[i].molecule];
        for (uint64_t k = 0; k < s->run[i].count && m->atoms > 0; k++) {
            resid += m->residues == 1;
            if (store_molecule(t, &s->run[i], first, resid) < 0)
                return -1;
            first += (uint32_t)m->atoms;
        }
    }
    return 1;
}

static int top_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    top_state *const s = t->state;
    if (s->was_read)
        return 0;
    if (atom_facts_begin(t, &s->facts) < 0 || read_sections(t) < 0)
        return -1;
    if (t->text.line == 0)
        return 0;
    if (s->runs == 0)
        return trajectory_fail(t, 0, "no section [ molecules ] with the molecules of the run");
    if (s->lines.missing > 0)
        trajectory_warn(t, DOUBT_INCLUDES, 0,
                        "includes %s, which is neither beside it nor where GROMACS has its force fields (GMXLIB names "
                        "their folder): what it tells of atoms is not known",
                        s->lines.first_missing);
    if (store_molecules(t) < 0)
        return -1;
    s->was_read = 1;
    const int status = atom_facts_finish(t, &s->facts, frame);
    frame->id = NULL; /* atoms have no numbers but their order */
    return status;
}

static void top_end(cgt_trajectory *t)
{
    top_state *const s = t->state;
    top_lines_free(&s->lines);
    word_map_free(&s->words);
    word_map_free(&s->type_names);
    word_map_free(&s->molecule_names);
    free(s->type);
    free(s->atom);
    free(s->bond);
    free(s->molecule);
    free(s->run);
    atom_facts_free(&s->facts);
}

const trajectory_format trajectory_format_top = {
    .lacks_places = 1,
    .state_size = sizeof(top_state),
    .begin = top_begin,
    .read = top_read,
    .end = top_end,
};
