/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Atoms of molecules. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/molecule_atom.h"

#include <math.h>
#include <string.h>

/* ---- Fields ------------------------------------------------------------------------------------------------- */

text_span field_at(text_span line, size_t begin, size_t width)
{
    const size_t length = text_length(line);
    begin = begin < length ? begin : length;
    width = width < length - begin ? width : length - begin;
    text_span field = {line.begin + begin, line.begin + begin + width};
    text_trim(&field);
    return field;
}

#define FIELD_LONGEST 63

int field_double(text_span field, double *value)
{
    char copy[FIELD_LONGEST + 1];
    const size_t length = text_length(field);
    if (length == 0 || length > FIELD_LONGEST)
        return 0;
    memcpy(copy, field.begin, length);
    copy[length] = '\0';
    return text_double((text_span){copy, copy + length}, value);
}

int field_float(text_span field, float *value)
{
    char copy[FIELD_LONGEST + 1];
    const size_t length = text_length(field);
    if (length == 0 || length > FIELD_LONGEST)
        return 0;
    memcpy(copy, field.begin, length);
    copy[length] = '\0';
    return text_float((text_span){copy, copy + length}, value);
}

/* ---- Elements ----------------------------------------------------------------------------------------------- */

/* Residues whose atoms are H, C, N, O, P, S, and Se alone, and named by their places: amino acids with the names that
 * force fields give to their states, nucleotides, water. */
static const char *const residues[] = {
    "ALA", "ARG", "ASN", "ASP",  "CYS", "GLN",  "GLU", "GLY",  "HIS", "ILE",  "LEU",  "LYS",  "MET",  "PHE",
    "PRO", "SER", "THR", "TRP",  "TYR", "VAL",  "MSE", "HID",  "HIE", "HIP",  "HSD",  "HSE",  "HSP",  "CYX",
    "CYM", "ASH", "GLH", "LYN",  "ACE", "NME",  "NH2", "A",    "C",   "G",    "U",    "DA",   "DC",   "DG",
    "DT",  "DI",  "ADE", "CYT",  "GUA", "THY",  "URA", "SOL",  "HOH", "WAT",  "H2O",  "TIP3", "TIP4", "TIP5",
    "SPC", "TP3", "T3P", "DPPC", "DPP", "POPC", "POP", "DOPC", "DOP", "POPE", "DMPC", "CHL1", "CHOL"};

static int is_known_residue(text_span residue)
{
    for (size_t i = 0; i < sizeof residues / sizeof residues[0]; i++)
        if (text_is(residue, residues[i]))
            return 1;
    return 0;
}

static int is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/* The first run of letters. */
static text_span letters_of(text_span name)
{
    while (name.begin < name.end && !is_letter(*name.begin))
        name.begin++;
    const char *end = name.begin;
    while (end < name.end && is_letter(*end))
        end++;
    return (text_span){name.begin, end};
}

uint32_t molecule_element(text_span name, text_span residue)
{
    element_reading reading;
    const text_span letters = letters_of(name), own = letters_of(residue);
    const size_t length = text_length(letters);
    if (length == 0)
        return 0;
    const int is_ion = length == text_length(own) && memcmp(letters.begin, own.begin, length) == 0;
    if (!is_ion && is_known_residue(residue)) {
        if (text_is(residue, "MSE") && text_is(letters, "SE"))
            return 34;
        return element_find((text_span){letters.begin, letters.begin + 1}, &reading);
    }
    return element_find(letters, &reading);
}

int molecule_store(trajectory *t, name_table *names, size_t i, text_span name, uint32_t element, float unit)
{
    char quote[TEXT_QUOTE_SIZE];
    const char *reason = "";
    trajectory_store *const s = &t->store;
    s->type[i] = name_table_find(names, name, &reason);
    if (s->type[i] == 0)
        return trajectory_fail(t, t->text.line, "'%s': %s", text_quote(name, quote), reason);
    s->element[i] = (uint8_t)element;
    s->xyzr[4 * i + 3] = t->options.radius > 0.0f ? t->options.radius : element_radius(element) * unit;
    return 1;
}

/* ---- Boxes -------------------------------------------------------------------------------------------------- */

/* The cosine of an angle in degrees; a right angle has exactly 0. */
static double cos_degrees(double angle)
{
    const double degree = 3.14159265358979323846 / 180.0;
    return angle == 90.0 ? 0.0 : cos(degree * angle);
}

int molecule_cell(const double length[3], const double angle[3], double edge[3][3])
{
    for (int i = 0; i < 3; i++)
        if (!(length[i] > 0.0 && isfinite(length[i]) && angle[i] > 0.0 && angle[i] < 180.0))
            return 0;
    const double ca = cos_degrees(angle[0]), cb = cos_degrees(angle[1]), cg = cos_degrees(angle[2]);
    const double sg = sqrt(1.0 - cg * cg);
    const double cy = (ca - cb * cg) / sg;
    const double square = 1.0 - cb * cb - cy * cy;
    if (!(square > 0.0))
        return 0;
    const double edges[3][3] = {{length[0], 0, 0},
                                {length[1] * cg, length[1] * sg, 0},
                                {length[2] * cb, length[2] * cy, length[2] * sqrt(square)}};
    memcpy(edge, edges, sizeof edges);
    return 1;
}
