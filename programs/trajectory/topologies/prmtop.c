/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Amber's prmtop (parm7), which tells what atoms are and has no places: sections "%FLAG NAME" with the format of their
 * fields, "%FORMAT(20a4)". Bonds are three times the atoms' numbers. Those between two hydrogens of water hold its
 * angle, and are none. */
#define _POSIX_C_SOURCE 200809L
#include "data/molecule/residue_names.h"
#include "trajectory/molecule/residues.h"
#include "trajectory/topologies/atom_facts.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sections that are read. */
typedef enum prmtop_section {
    PRMTOP_NAMES,
    PRMTOP_CHARGES,
    PRMTOP_NUMBERS,
    PRMTOP_MASSES,
    PRMTOP_RESIDUES,
    PRMTOP_STARTS,
    PRMTOP_BONDS_H,
    PRMTOP_BONDS,
    PRMTOP_SECTIONS
} prmtop_section;

static const char *const flags[PRMTOP_SECTIONS] = {
    "ATOM_NAME",     "CHARGE",          "ATOMIC_NUMBER",      "MASS",
    "RESIDUE_LABEL", "RESIDUE_POINTER", "BONDS_INC_HYDROGEN", "BONDS_WITHOUT_HYDROGEN"};

enum { LABEL = 16 };

typedef struct prmtop_list {
    char (*label)[LABEL]; /* fields, without blanks around them */
    size_t count, capacity;
} prmtop_list;

typedef struct prmtop_state {
    atom_facts facts; /* first: atom_facts.h */
    int was_read;
    prmtop_list list[PRMTOP_SECTIONS];
} prmtop_state;

static int prmtop_begin(cgt_trajectory *t)
{
    prmtop_state *const s = t->state;
    s->was_read = 0;
    return 1;
}

/* ---- Sections --------------------------------------------------------------------------------------------------- */

static int add_field(cgt_trajectory *t, prmtop_list *list, text_span field)
{
    if (list->count == list->capacity) {
        const size_t capacity = 2 * list->capacity + 1024;
        if (trajectory_grow(&list->label, capacity, sizeof *list->label))
            return trajectory_fail(t, t->text.line, "not enough memory for the atoms");
        list->capacity = capacity;
    }
    const size_t length = text_length(field) < LABEL ? text_length(field) : LABEL - 1;
    memcpy(list->label[list->count], field.begin, length);
    list->label[list->count++][length] = '\0';
    return 1;
}

/* The width of fields in "%FORMAT(20a4)" or "%FORMAT(5E16.8)"; 0: there is none. */
static size_t take_width(text_span line)
{
    const char *p = memchr(line.begin, '(', text_length(line));
    while (p != NULL && p < line.end && ((*p >= '0' && *p <= '9') || *p == '('))
        p++;
    size_t width = 0;
    for (p = p != NULL && p < line.end ? p + 1 : line.end; p < line.end && *p >= '0' && *p <= '9' && width < 100; p++)
        width = 10 * width + (size_t)(*p - '0');
    return width < 100 ? width : 0;
}

/* Cuts the lines of a section into fields. */
static int take_fields(cgt_trajectory *t, prmtop_list *list, size_t width, text_span line)
{
    while (line.end > line.begin && (line.end[-1] == '\r' || line.end[-1] == ' '))
        line.end--;
    for (size_t at = 0; at < text_length(line); at += width)
        if (add_field(t, list, field_at(line, at, width)) < 0)
            return -1;
    return 1;
}

static int read_sections(cgt_trajectory *t)
{
    prmtop_state *const s = t->state;
    prmtop_list *list = NULL;
    text_span line, word;
    size_t width = 0;
    int status;
    while ((status = trajectory_line(t, &line)) > 0) {
        text_span rest = line;
        if (text_begins(line, "%FLAG")) {
            list = NULL;
            width = 0;
            text_word(&rest, &word);
            const int is_named = text_word(&rest, &word);
            for (int i = 0; i < PRMTOP_SECTIONS && is_named; i++)
                list = text_is(word, flags[i]) ? &s->list[i] : list;
        } else if (text_begins(line, "%FORMAT") && list != NULL) {
            if ((width = take_width(line)) == 0)
                return trajectory_fail(t, t->text.line, "no width of fields, as in %%FORMAT(20a4)");
        } else if (list != NULL && width > 0 && (line.begin == line.end || *line.begin != '%') &&
                   take_fields(t, list, width, line) < 0) {
            return -1;
        }
    }
    return status;
}

/* ---- Atoms ------------------------------------------------------------------------------------------------------ */

static text_span field_of(const prmtop_state *s, prmtop_section section, size_t i)
{
    const char *const label = i < s->list[section].count ? s->list[section].label[i] : "";
    return (text_span){label, label + strlen(label)};
}

static uint64_t number_of(const prmtop_state *s, prmtop_section section, size_t i)
{
    uint64_t number = 0;
    text_u64(field_of(s, section, i), UINT32_MAX, &number);
    return number;
}

static int store_atoms(cgt_trajectory *t)
{
    prmtop_state *const s = t->state;
    const size_t atoms = s->list[PRMTOP_NAMES].count;
    size_t residue = 0;
    if (atoms > t->options.max_count)
        return trajectory_fail(t, 0, "%zu atoms are more than the limit of %" PRIu64, atoms, t->options.max_count);
    for (size_t i = 0; i < atoms; i++) {
        char resid[24];
        while (residue + 1 < s->list[PRMTOP_STARTS].count && number_of(s, PRMTOP_STARTS, residue + 1) <= i + 1)
            residue++;
        snprintf(resid, sizeof resid, "%zu", residue + 1);
        const uint64_t number = number_of(s, PRMTOP_NUMBERS, i);
        atom_fact a = {.id = (uint32_t)i,
                       .number = number <= 118 ? (uint32_t)number : 0,
                       .name = field_of(s, PRMTOP_NAMES, i),
                       .residue = field_of(s, PRMTOP_RESIDUES, residue),
                       .resid = {resid, resid + strlen(resid)},
                       .segment = {resid, resid},
                       .charge = NAN};
        a.has_mass = text_double(field_of(s, PRMTOP_MASSES, i), &a.mass);
        if (text_double(field_of(s, PRMTOP_CHARGES, i), &a.charge))
            a.charge /= 18.2223; /* Amber's unit */
        if (atom_facts_add(t, &s->facts, (uint32_t)i, &a) < 0)
            return -1;
    }
    return 1;
}

static int is_hydrogen_of_water(const cgt_trajectory *t, const prmtop_state *s, uint64_t i)
{
    const uint32_t residue = t->store.residue[i];
    return t->store.element[i] == 1 && residue_is_water(field_of(s, PRMTOP_RESIDUES, RESIDUE_NUMBER(residue)).begin);
}

/* Three numbers a bond: both atoms times three, and a type. */
static int add_bonds(cgt_trajectory *t, prmtop_section section)
{
    prmtop_state *const s = t->state;
    for (size_t i = 0; i + 2 < s->list[section].count; i += 3) {
        uint64_t end[2];
        for (size_t k = 0; k < 2; k++) {
            if (!text_u64(field_of(s, section, i + k), UINT32_MAX, &end[k]) || end[k] / 3 >= s->facts.count)
                return trajectory_fail(t, 0, "bond %zu of %s is to an atom that is not there", i / 3 + 1,
                                       flags[section]);
            end[k] /= 3;
        }
        if (is_hydrogen_of_water(t, s, end[0]) && is_hydrogen_of_water(t, s, end[1]))
            continue;
        if (bond_list_add(&s->facts.bond, (uint32_t)end[0], (uint32_t)end[1]))
            return trajectory_fail(t, 0, "not enough memory for the bonds");
    }
    return 1;
}

static int prmtop_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    prmtop_state *const s = t->state;
    if (s->was_read)
        return 0;
    for (int i = 0; i < PRMTOP_SECTIONS; i++)
        s->list[i].count = 0;
    if (atom_facts_begin(t, &s->facts) < 0 || read_sections(t) < 0)
        return -1;
    if (t->text.line == 0)
        return 0;
    if (s->list[PRMTOP_RESIDUES].count == 0 || s->list[PRMTOP_RESIDUES].count > s->list[PRMTOP_NAMES].count)
        return trajectory_fail(t, 0, "no residues, or more than atoms");
    if (store_atoms(t) < 0 || add_bonds(t, PRMTOP_BONDS_H) < 0 || add_bonds(t, PRMTOP_BONDS) < 0)
        return -1;
    s->was_read = 1;
    const int status = atom_facts_finish(t, &s->facts, frame);
    frame->id = NULL; /* atoms have no numbers but their order */
    return status;
}

static void prmtop_end(cgt_trajectory *t)
{
    prmtop_state *const s = t->state;
    for (int i = 0; i < PRMTOP_SECTIONS; i++)
        free(s->list[i].label);
    atom_facts_free(&s->facts);
}

const trajectory_format trajectory_format_prmtop = {
    .lacks_places = 1,
    .state_size = sizeof(prmtop_state),
    .begin = prmtop_begin,
    .read = prmtop_read,
    .end = prmtop_end,
};
