/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * POSCAR and CONTCAR (one frame) and XDATCAR (a run) of VASP, as its wiki describes them: a title; a scale, which is
 * the volume of the cell where it is negative, or three, one for each axis; three edges; names of species, which
 * VASP 4 does not write; how many atoms each has; perhaps "Selective dynamics"; "Direct" or "Cartesian"; the
 * positions. Names and numbers may go on for several lines, and remarks stand behind what is read. What follows the
 * positions in a CONTCAR (velocities, predictors) is not read. A run goes on with "Direct configuration= N", with a
 * blank line where the first frame has one in that place, or with a whole header where the cell changes. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/molecule_atom.h"
#include "trajectory/atoms/trajectory_sites.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define MOST_SPECIES 256u
#define NAME 16u         /* bytes, the zero included */
#define BARE_RADIUS 1.0f /* Angstrom, of atoms without an element */

typedef struct vasp_species {
    char name[NAME];  /* "": not told */
    uint32_t element; /* 0: the name is none; or a mark of trajectory_sites.h */
} vasp_species;

typedef struct vasp_state {
    name_table names;
    double edge[3][3], scale[3];
    uint32_t species;
    uint32_t count[MOST_SPECIES];
    vasp_species kind[MOST_SPECIES];
    uint32_t atoms, unknown; /* those without an element */
    int has_element, is_run, was_read, is_cartesian;
    int is_by_blanks; /* a blank line begins each frame */
    int64_t step;
} vasp_state;

/* ---- Header ------------------------------------------------------------------------------------------------- */

/* Where the first of several numbers ends that touch, as Fortran writes them in fields that are full: each has as many
 * decimals as the last. NULL: the word is not such. */
static const char *end_of_touching(text_span word)
{
    const char *point = word.end;
    while (point > word.begin && point[-1] >= '0' && point[-1] <= '9')
        point--;
    const ptrdiff_t decimals = word.end - point;
    if (point == word.begin || point[-1] != '.' || decimals == 0)
        return NULL;
    const char *const first = memchr(word.begin, '.', text_length(word));
    return first != NULL && first < point - 1 && point - first > decimals ? first + 1 + decimals : NULL;
}

/* Removes a finite number from the front of a line: 1, or 0. */
static int take_number(text_span *line, double *value)
{
    text_span rest = *line, word;
    if (!text_word(&rest, &word))
        return 0;
    if (!text_double(word, value)) {
        const char *const end = end_of_touching(word);
        if (end == NULL || !text_double((text_span){word.begin, end}, value))
            return 0;
        rest.begin = end;
    }
    *line = rest;
    return isfinite(*value);
}

/* Removes the numbers that a line begins with, at most 3. Returns how many there are. */
static int take_numbers(text_span *line, double values[3])
{
    int count = 0;
    while (count < 3 && take_number(line, &values[count]))
        count++;
    return count;
}

static int read_cell(cgt_trajectory *t)
{
    vasp_state *const s = t->state;
    text_span line;
    if (trajectory_line_inside(t, &line, "before the scale") < 0)
        return -1;
    const int scales = take_numbers(&line, s->scale);
    if (scales != 1 && scales != 3)
        return trajectory_fail(t, t->text.line, "a scale, or three, was expected on the second line");
    for (int i = 0; i < 3; i++) {
        if (trajectory_line_inside(t, &line, "before the edges of the cell") < 0)
            return -1;
        if (take_numbers(&line, s->edge[i]) != 3)
            return trajectory_fail(t, t->text.line, "an edge of the cell has three numbers");
    }
    if (scales == 1) {
        double(*const e)[3] = s->edge;
        const double volume = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                              e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                              e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
        const double scale = s->scale[0] < 0.0 ? cbrt(-s->scale[0] / fabs(volume)) : s->scale[0];
        s->scale[0] = s->scale[1] = s->scale[2] = scale;
    }
    for (int i = 0; i < 9; i++)
        s->edge[i / 3][i % 3] *= s->scale[i % 3];
    for (int i = 0; i < 3; i++)
        if (!(s->scale[i] > 0.0 && isfinite(s->scale[i])))
            return trajectory_fail(t, t->text.line, "the scale of the cell is not above 0");
    return 1;
}

static int is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/* Takes the name of a species: an element's symbol, perhaps with a number, a charge or the name of its potential behind
 * it: "Fe1", "Fe3+", "H1.25", "Fe_pv", "O/1a2b3c". */
static vasp_species take_species(text_span word)
{
    vasp_species species = {.element = 0};
    element_reading reading;
    text_span letters = {word.begin, word.begin}, name = word;
    while (letters.end < word.end && is_letter(*letters.end))
        letters.end++;
    for (const char *p = word.begin; p < name.end; p++)
        name.end = *p == '_' || *p == '/' ? p : name.end;
    const uint32_t element = element_find(letters, &reading);
    if (reading == ELEMENT_SYMBOL || reading == ELEMENT_EITHER)
        species.element = element;
    else if (site_find(letters, (text_span){word.end, word.end}, (text_span){word.end, word.end}) == SITE_MARK)
        species.element = SITE_MARK;
    const int is_bare = text_length(name) == text_length(letters) && *element_symbol(species.element) != '\0';
    snprintf(species.name, sizeof species.name, "%.*s", (int)(is_bare ? 0 : text_length(name)), name.begin);
    if (is_bare)
        snprintf(species.name, sizeof species.name, "%s", element_symbol(species.element));
    return species;
}

/* Adds the names of a line, up to a remark. Returns whether all of them are elements. */
static int take_names(vasp_state *s, text_span line, uint32_t *count)
{
    text_span word;
    int are_known = 1;
    while (*count < MOST_SPECIES && text_word(&line, &word) && *word.begin != '!' && *word.begin != '#') {
        s->kind[*count] = take_species(word);
        are_known &= *element_symbol(s->kind[(*count)++].element) != '\0';
    }
    return are_known;
}

/* Adds the numbers of atoms of a line, up to a remark. */
static int take_counts(cgt_trajectory *t, text_span line, uint64_t *atoms)
{
    vasp_state *const s = t->state;
    text_span word;
    uint64_t number;
    while (text_word(&line, &word) && text_u64(word, UINT64_MAX, &number)) {
        if (s->species == MOST_SPECIES)
            return trajectory_fail(t, t->text.line, "more than %u species", MOST_SPECIES);
        if (trajectory_parse_count(t, word, &s->count[s->species]) < 0)
            return -1;
        *atoms += s->count[s->species++];
    }
    return 1;
}

/* Whether a line goes on with what the one before has: whole numbers alone. */
static int has_counts(text_span line)
{
    text_span word;
    uint64_t number;
    int count = 0;
    while (text_word(&line, &word) && *word.begin != '!' && *word.begin != '#') {
        if (!text_u64(word, UINT64_MAX, &number))
            return 0;
        count++;
    }
    return count > 0;
}

/* Reads names, which VASP 4 has in the title, if at all; *line becomes the first one with numbers. */
static int read_names(cgt_trajectory *t, text_span *line, uint32_t *named)
{
    vasp_state *const s = t->state;
    vasp_species kind[MOST_SPECIES];
    uint32_t more = 0;
    text_span rest = *line, word;
    uint64_t number;
    if (!text_word(&rest, &word) || text_u64(word, UINT64_MAX, &number))
        return 1;
    *named = 0;
    take_names(s, *line, named);
    while (1) {
        if (trajectory_line_inside(t, line, "before the numbers of atoms") < 0)
            return -1;
        memcpy(kind, s->kind, sizeof kind);
        more = *named;
        if (text_is_blank(*line) || has_counts(*line) || !take_names(s, *line, &more) || more == *named) {
            memcpy(s->kind, kind, sizeof kind);
            return 1;
        }
        *named = more;
    }
}

/* Reads names and numbers; *line becomes the one after them. */
static int read_species(cgt_trajectory *t, uint32_t titled, text_span *line)
{
    vasp_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    text_span rest, word;
    uint32_t named = titled;
    uint64_t atoms = 0, number;
    if (trajectory_line_inside(t, line, "before the numbers of atoms") < 0 || read_names(t, line, &named) < 0)
        return -1;
    rest = *line;
    if (text_word(&rest, &word) && !text_u64(word, UINT64_MAX, &number))
        return trajectory_fail(t, t->text.line, "'%s' is not a number of atoms", text_quote(word, quote));
    s->species = 0;
    do {
        if (take_counts(t, *line, &atoms) < 0)
            return -1;
        if (s->species == 0)
            return trajectory_fail(t, t->text.line, "numbers of atoms were expected");
        if (atoms > t->options.max_count)
            return trajectory_fail(t, t->text.line, "%" PRIu64 " atoms are more than the limit of %" PRIu64, atoms,
                                   t->options.max_count);
        if (trajectory_line_inside(t, line, "before the positions") < 0)
            return -1;
    } while (has_counts(*line));
    s->atoms = (uint32_t)atoms;
    for (uint32_t i = named == titled && titled != s->species ? 0 : named; i < s->species; i++)
        s->kind[i] = (vasp_species){.element = 0};
    return 1;
}

/* Reads a header, whose title is `title`; *line becomes the one after it. */
static int read_head(cgt_trajectory *t, text_span title, text_span *line)
{
    vasp_state *const s = t->state;
    uint32_t titled = 0;
    if (!take_names(s, title, &titled))
        titled = 0;
    return read_cell(t) < 0 ? -1 : read_species(t, titled, line);
}

/* Whether a line is "Direct configuration= 7", and its number. */
static int is_configuration(text_span line, int64_t *step)
{
    static const char word[] = "configuration=";
    const size_t length = sizeof word - 1;
    for (const char *p = line.begin; p + length <= line.end; p++) {
        if (memcmp(p, word, length) == 0) {
            text_span number = {p + length, line.end};
            text_trim(&number);
            if (!text_i64(number, step))
                *step = 0;
            return 1;
        }
    }
    return 0;
}

/* Reads the line that begins a frame of a run, where there is one: 1 a header's title follows, or is blank and read; 2
 * positions follow; 0 at the end of the file, -1. */
static int begin_next(cgt_trajectory *t, text_span *line)
{
    vasp_state *const s = t->state;
    int status, was_blank = 0;
    double numbers[3];
    while ((status = trajectory_line(t, line)) > 0 && text_is_blank(*line))
        was_blank = 1;
    if (status <= 0 || is_configuration(*line, &s->step))
        return status <= 0 ? status : 2;
    text_span rest = *line;
    const int count = was_blank ? take_numbers(&rest, numbers) : 0;
    if (count == 1 || (count == 3 && s->is_by_blanks)) {
        text_reader_back(&t->text); /* the scale behind a blank title, or a position */
        line->end = line->begin;
    }
    return count == 3 && s->is_by_blanks ? 2 : 1;
}

/* Reads up to the positions: 1, 0 at the end of the file, -1. */
static int begin_frame(cgt_trajectory *t)
{
    vasp_state *const s = t->state;
    text_span line;
    const int status = s->is_run ? begin_next(t, &line) : trajectory_line(t, &line);
    if (status <= 0)
        return status;
    if (status == 1) {
        if (read_head(t, line, &line) < 0)
            return -1;
        text_trim(&line);
        const int is_selective = line.begin < line.end && (*line.begin == 'S' || *line.begin == 's');
        if (is_selective && trajectory_line_inside(t, &line, "before the positions") < 0)
            return -1;
        s->is_by_blanks = text_is_blank(line);
        s->is_run = is_configuration(line, &s->step) || s->is_by_blanks;
    }
    text_trim(&line);
    s->is_cartesian = line.begin < line.end && strchr("CcKk", *line.begin) != NULL;
    return 1;
}

/* ---- Atoms -------------------------------------------------------------------------------------------------- */

/* What is behind a position: the symbol of its atom, where the header has none. The marks of "Selective dynamics" may
 * be before it. Else the species is a type with a number. */
static vasp_species behind(const vasp_state *s, uint32_t species, text_span rest)
{
    static const char *const marks[] = {"T", "F", ".TRUE.", ".FALSE.", "t", "f"};
    text_span word, after = rest;
    int count = 0;
    while (count < 3 && text_word(&after, &word)) {
        int is_mark = 0;
        for (size_t k = 0; k < sizeof marks / sizeof marks[0]; k++)
            is_mark |= text_is(word, marks[k]);
        if (!is_mark)
            break;
        count++;
    }
    vasp_species found = s->kind[species];
    rest = count == 3 ? after : rest;
    if (text_word(&rest, &word) && is_letter(*word.begin)) {
        const vasp_species own = take_species(word);
        found = own.element != 0 ? own : found;
    }
    if (found.name[0] == '\0')
        snprintf(found.name, sizeof found.name, "%" PRIu32, species + 1);
    return found;
}

/* Tells once that atoms have no element, and why. */
static void tell_unknown(cgt_trajectory *t)
{
    const vasp_state *const s = t->state;
    const char *odd = "";
    for (uint32_t i = 0; i < s->species && *odd == '\0'; i++)
        odd = s->count[i] > 0 && s->kind[i].element == 0 ? s->kind[i].name : "";
    if (s->unknown > 0 && *odd != '\0')
        trajectory_warn(t, DOUBT_SPECIES, 0,
                        "%" PRIu32 " of %" PRIu32 " atoms have no element: '%s' is the name of none", s->unknown,
                        s->atoms, odd);
    else if (s->unknown > 0)
        trajectory_warn(t, DOUBT_SPECIES, 0, "%" PRIu32 " of %" PRIu32 " atoms have no element: the file names none",
                        s->unknown, s->atoms);
}

static int read_atom(cgt_trajectory *t, uint32_t i, uint32_t species)
{
    vasp_state *const s = t->state;
    text_span line;
    double p[3];
    if (trajectory_line_inside(t, &line, "in the positions") < 0 || trajectory_reserve(t, (size_t)i + 1, s->atoms) < 0)
        return -1;
    if (take_numbers(&line, p) != 3)
        return trajectory_fail(t, t->text.line, "a position has three numbers");
    for (size_t k = 0; k < 3; k++)
        t->store.xyzr[4 * (size_t)i + k] = trajectory_place(
            t, k,
            s->is_cartesian ? s->scale[k] * p[k] : p[0] * s->edge[0][k] + p[1] * s->edge[1][k] + p[2] * s->edge[2][k]);
    const vasp_species kind = s->kind[species].element != 0 ? s->kind[species] : behind(s, species, line);
    s->has_element |= kind.element != 0 && kind.element != SITE_MARK;
    s->unknown += kind.element == 0;
    if (molecule_store(t, &s->names, i, (text_span){kind.name, kind.name + strlen(kind.name)}, kind.element, 1.0f) < 0)
        return -1;
    if (kind.element == 0 && !(t->options.radius > 0.0f))
        t->store.xyzr[4 * (size_t)i + 3] = BARE_RADIUS;
    return 1;
}

/* ---- The format --------------------------------------------------------------------------------------------- */

static int vasp_begin(cgt_trajectory *t)
{
    vasp_state *const s = t->state;
    s->is_run = s->was_read = 0;
    return 1;
}

static int vasp_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    static const double origin[3] = {0, 0, 0};
    vasp_state *const s = t->state;
    if (s->was_read && !s->is_run)
        return 0;
    s->step = (int64_t)t->next;
    const int status = begin_frame(t);
    if (status <= 0)
        return status;
    uint32_t i = 0;
    s->unknown = 0;
    s->has_element = 0;
    if (trajectory_reserve(t, 0, s->atoms) < 0)
        return -1;
    for (uint32_t species = 0; species < s->species; species++)
        for (uint32_t k = 0; k < s->count[species]; k++)
            if (read_atom(t, i++, species) < 0)
                return -1;
    if (!t->text.has_feed)
        trajectory_warn_open(t, t->text.line);
    s->was_read = 1;
    tell_unknown(t);
    trajectory_frame_fill(t, frame, s->atoms);
    frame->step = s->step;
    frame->type = t->store.type;
    frame->element = s->has_element ? t->store.element : NULL;
    trajectory_frame_set_box(frame, origin, (const double(*)[3])s->edge);
    memset(frame->periodic, 1, sizeof frame->periodic);
    return 1;
}

const trajectory_format trajectory_format_vasp = {
    .is_series = 1,
    .is_followed = 1,
    .state_size = sizeof(vasp_state),
    .begin = vasp_begin,
    .read = vasp_read, /* no skip: names are numbered in order of appearance */
};
