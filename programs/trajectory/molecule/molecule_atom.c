/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Atoms of molecules. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/molecule_atom.h"
#include "trajectory/molecule/residues.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
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

/* The text of a field with a zero behind it; empty where there is none, or too much. */
static text_span copy_field(text_span field, char copy[FIELD_LONGEST + 1])
{
    const size_t length = text_length(field) > FIELD_LONGEST ? 0 : text_length(field);
    memcpy(copy, field.begin, length);
    copy[length] = '\0';
    return (text_span){copy, copy + length};
}

int field_double(text_span field, double *value)
{
    char copy[FIELD_LONGEST + 1];
    return text_double(copy_field(field, copy), value);
}

int field_float(text_span field, float *value)
{
    char copy[FIELD_LONGEST + 1];
    return text_float(copy_field(field, copy), value);
}

int field_place(const cgt_trajectory *t, size_t axis, text_span field, float *place)
{
    char copy[FIELD_LONGEST + 1];
    return trajectory_text_place(t, axis, copy_field(field, copy), place);
}

/* ---- Elements ----------------------------------------------------------------------------------------------- */

#define LAST_LIKELY 94u /* plutonium */

static int is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }
static int is_lower(char c) { return c >= 'a' && c <= 'z'; }

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

/* The letters in capitals, cut to 7. Returns how many there are. */
static size_t copy_capitals(text_span letters, char text[8])
{
    const size_t length = text_length(letters);
    size_t i = 0;
    for (; i < length && i < 7; i++)
        text[i] = (char)(is_lower(letters.begin[i]) ? letters.begin[i] - 'a' + 'A' : letters.begin[i]);
    text[i] = '\0';
    return length;
}

static uint32_t find_symbol(const char *text, size_t length)
{
    element_reading reading;
    const uint32_t element = element_find((text_span){text, text + length}, &reading);
    return reading == ELEMENT_SYMBOL || reading == ELEMENT_EITHER ? element : 0;
}

/* Ions under the names that CHARMM and AMBER give them, and their residues. */
static uint32_t find_ion(const char *name)
{
    static const struct {
        const char *name, *symbol;
    } ions[] = {{"SOD", "NA"}, {"CLA", "CL"}, {"POT", "K"},  {"CAL", "CA"}, {"CES", "CS"}, {"CIO", "CS"},
                {"LIT", "LI"}, {"RUB", "RB"}, {"BAR", "BA"}, {"CAD", "CD"}, {"IOD", "I"},  {"IM", "CL"},
                {"IP", "NA"},  {"CIM", "CL"}, {"CIP", "NA"}, {"CHL", "CL"}, {"ZIN", "ZN"}, {"MGO", "MG"}};
    for (size_t i = 0; i < sizeof ions / sizeof ions[0]; i++)
        if (strcmp(name, ions[i].name) == 0)
            return find_symbol(ions[i].symbol, strlen(ions[i].symbol));
    return 0;
}

/* Two letters that are more likely an element's symbol than the label of one of H, C, N, O, P, S. */
static int is_metal_or_halogen(const char *two)
{
    static const char likely[] = "CL CU CR NI SE SI SN SR PT ";
    return strchr("HCNOPSD", two[0]) == NULL || strstr(likely, (char[4]){two[0], two[1], ' ', '\0'}) != NULL;
}

/* Notes that a name was read in one of two ways. */
static uint32_t note_guess(cgt_trajectory *t, text_span name, text_span residue, uint32_t element)
{
    char quotes[2][TEXT_QUOTE_SIZE];
    if (t->guessed++ == 0)
        snprintf(t->guess, sizeof t->guess, "'%.20s' in '%.20s' as %s", text_quote(name, quotes[0]),
                 text_quote(residue, quotes[1]), element_symbol(element));
    return element;
}

/* One letter that labels begin with. */
static uint32_t find_label(char capital)
{
    return strchr("HCNOPSFBID", capital) != NULL ? find_symbol(&capital, 1) : 0;
}

uint32_t molecule_element(cgt_trajectory *t, text_span name, text_span residue, name_place place)
{
    char text[8], own[8];
    const text_span letters = letters_of(name);
    const size_t length = copy_capitals(letters, text), own_length = copy_capitals(letters_of(residue), own);
    if (length == 0)
        return 0;
    const uint32_t found = length >= 2 ? find_symbol(text, 2) : 0;
    const uint32_t two = found <= LAST_LIKELY ? found : 0;
    const uint32_t ion = find_ion(own);
    if (strcmp(text, own) == 0 && length == own_length && (length <= 2 || ion != 0))
        return ion != 0 ? ion : find_symbol(text, length);
    const uint32_t whole = length <= 2 ? find_symbol(text, length) : 0;
    const char last = name.end[-1];
    if ((last == '+' || last == '-' || (ion != 0 && ion == whole)) && whole != 0)
        return whole;
    if (residue_is_organic(residue))
        return find_label(text[0]);
    if (length == 1)
        return find_symbol(text, 1);
    if (strcmp(own, "MSE") == 0 || strcmp(own, "SEC") == 0 || strcmp(own, "CSE") == 0)
        return strcmp(text, "SE") == 0 ? two : find_label(text[0]);
    if (strcmp(text, "DUM") == 0)
        return 0;
    if (length == 2 && two != 0 && (place == NAME_OF_SYMBOL || is_lower(letters.begin[1])) &&
        !is_lower(letters.begin[0]))
        return two;
    /* names such as CLAA, of which topology builders make as many as they need */
    const int is_halogen = two != 0 && length == 4 && (strncmp(text, "CL", 2) == 0 || strncmp(text, "BR", 2) == 0);
    const int is_likely = length == 2 && two != 0 && is_metal_or_halogen(text);
    const int is_odd = place == NAME_OF_LABEL; /* programs do not always put symbols where they belong */
    const int may_be_label = strchr("HCNOPSD", text[0]) != NULL;
    if (is_halogen || (is_likely && (!is_odd || !may_be_label || strcmp(text, "CL") == 0)))
        return may_be_label || is_odd ? note_guess(t, name, residue, two) : two;
    const uint32_t label = find_label(text[0]);
    return length == 2 && two != 0 && label != 0 && place == NAME_ANYWHERE ? note_guess(t, name, residue, label)
                                                                           : label;
}

void molecule_tell_guesses(cgt_trajectory *t)
{
    if (t->guessed > 0)
        trajectory_warn(t, DOUBT_SYMBOL, 0,
                        "%" PRIu32
                        " atoms have names that are an element's symbol or the label of another; read was %s",
                        t->guessed, t->guess);
}

int molecule_store(cgt_trajectory *t, name_table *names, size_t i, text_span name, uint32_t element, float unit)
{
    char quote[TEXT_QUOTE_SIZE];
    const char *reason = "";
    trajectory_store *const s = &t->store;
    s->type[i] = name_table_type(names, name, &reason);
    if (s->type[i] > NAMES_MOST)
        trajectory_warn_names(t, t->text.line);
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
