/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * LAMMPS data files, as write_data and read_data know them: a title, a header (counts and box), then sections of rows,
 * each under a keyword and a blank line. One frame. Which columns the atoms have tells the style behind their keyword,
 * "Atoms # full"; where it is missing, what the rows allow. Bonds refer to ids, in any order. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/atoms/trajectory_bonds.h"
#include "trajectory/atoms/trajectory_sites.h"
#include "trajectory/lammps/lammps_parts.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_TYPES 1024u

typedef struct data_state {
    lammps_frame frame; /* first: lammps_columns.h */
    uint32_t atoms, bonds;
    uint64_t types;      /* of atoms, by the header; 0: not told */
    uint64_t left_out;   /* rows of atoms beyond those that the header counts */
    uint64_t first_left; /* line of the first of them */
    uint64_t lost_bonds; /* of atoms that were left out */
    double bounds[3][4]; /* low, high, tilt of each axis */
    double vectors[3][4];
    int is_general;
    int has_atoms;               /* the section was read */
    int was_read;                /* the one frame was */
    double mass[MOST_TYPES + 1]; /* of types, 0: not given */
    bond_list bond;
} data_state;

/* ---- Header ------------------------------------------------------------------------------------------------- */

/* Reads the `count` numbers that a line of the header begins with. */
static int take_numbers(cgt_trajectory *t, text_span *line, int count, double *values)
{
    char quote[TEXT_QUOTE_SIZE];
    for (int i = 0; i < count; i++) {
        text_span word = {line->end, line->end};
        if (!text_word(line, &word) || !text_double(word, &values[i]) || !isfinite(values[i]))
            return trajectory_fail(t, t->text.line, "'%s' is not a bound of a box", text_quote(word, quote));
    }
    return 1;
}

/* "0 10 xlo xhi", "1.5 0 0 xy xz yz", "1 0 0 avec": 1 taken, 0 something else, -1. */
static int read_box_line(cgt_trajectory *t, text_span line)
{
    static const struct {
        const char *words;
        int count;
    } kinds[] = {{"xlo xhi", 2}, {"ylo yhi", 2}, {"zlo zhi", 2}, {"xy xz yz", 3},
                 {"avec", 3},    {"bvec", 3},    {"cvec", 3},    {"abc origin", 3}};
    data_state *const s = t->state;
    for (int k = 0; k < 8; k++) {
        const size_t length = strlen(kinds[k].words);
        double v[3] = {0};
        if (text_length(line) < length || memcmp(line.end - length, kinds[k].words, length) != 0)
            continue;
        if (take_numbers(t, &line, kinds[k].count, v) < 0)
            return -1;
        for (int i = 0; i < kinds[k].count; i++)
            if (k < 3)
                s->bounds[k][i] = v[i];
            else if (k == 3)
                s->bounds[i][2] = v[i];
            else if (k < 7)
                s->vectors[k - 4][i] = v[i];
            else
                s->vectors[i][3] = v[i];
        s->is_general |= k > 3;
        s->frame.has_box = 1;
        return 1;
    }
    return 0;
}

static int read_header_line(cgt_trajectory *t, text_span words)
{
    data_state *const s = t->state;
    char copy[256] = ""; /* with one blank between words, whatever the file has there */
    size_t length = 0;
    text_span word;
    while (text_word(&words, &word) && length < sizeof copy)
        length += (size_t)snprintf(copy + length, sizeof copy - length, "%s%.*s", length > 0 ? " " : "",
                                   (int)text_length(word), word.begin);
    const text_span line = {copy, copy + strlen(copy)};
    text_span rest = line;
    const int is_box = read_box_line(t, line);
    if (is_box != 0)
        return is_box;
    text_word(&rest, &word);
    text_trim(&rest);
    if (text_is(rest, "atom types") && !text_u64(word, UINT64_MAX, &s->types))
        s->types = 0;
    if (text_is(rest, "atoms"))
        return trajectory_parse_count(t, word, &s->atoms);
    return text_is(rest, "bonds") ? trajectory_parse_count(t, word, &s->bonds) : 1;
}

/* Tilted boxes are given by their corner and lengths; a dump has the bounds around them. */
static void make_box(data_state *s)
{
    lammps_box *const box = &s->frame.box;
    if (s->is_general) {
        lammps_make_box(box, 1, s->vectors);
        return;
    }
    const double xy = s->bounds[0][2], xz = s->bounds[1][2], yz = s->bounds[2][2];
    double lines[3][4];
    memcpy(lines, s->bounds, sizeof lines);
    lines[0][0] += fmin(fmin(0.0, xy), fmin(xz, xy + xz));
    lines[0][1] += fmax(fmax(0.0, xy), fmax(xz, xy + xz));
    lines[1][0] += fmin(0.0, yz);
    lines[1][1] += fmax(0.0, yz);
    lammps_make_box(box, 0, lines);
}

/* ---- Atoms -------------------------------------------------------------------------------------------------- */

static int read_atoms(cgt_trajectory *t, text_span keyword)
{
    data_state *const s = t->state;
    cgt_trajectory_frame unused;
    char heading[LAMMPS_HEADING_SIZE], columns[LAMMPS_COLUMNS_SIZE];
    snprintf(heading, sizeof heading, "%.*s", (int)text_length(keyword), keyword.begin);
    if (lammps_data_columns(t, (text_span){heading, heading + strlen(heading)}, s->types, columns) < 0 ||
        lammps_plan_columns(t, (text_span){columns, columns + strlen(columns)}) < 0)
        return -1;
    s->frame.plan.open_ended = 1; /* comments */
    s->has_atoms = 1;
    return rows_read(t, &s->frame.plan, s->atoms, lammps_finish_row, &unused);
}

/* ---- Other sections ----------------------------------------------------------------------------------------- */

/* The type of a word, a number or a label: 0 for none. */
static uint64_t find_type(const data_state *s, text_span word)
{
    uint64_t type;
    return text_u64(word, MOST_TYPES, &type) ? type : name_table_peek(&s->frame.labels, word);
}

/* "1 hw": the labels of types stand in the order of their numbers, before they are used. */
static int label_row(cgt_trajectory *t, text_span line)
{
    data_state *const s = t->state;
    text_span word, label;
    const char *reason;
    uint64_t type;
    if (text_word(&line, &word) && text_u64(word, MOST_TYPES, &type) && text_word(&line, &label) &&
        type == s->frame.labels.count + 1u)
        name_table_find(&s->frame.labels, label, &reason);
    return 1;
}

/* "1 12.011 # C"; anything else is left out: masses only tell elements. */
static void read_mass(data_state *s, text_span line)
{
    text_span word, mass;
    uint64_t type;
    double value;
    if (text_word(&line, &word) && (type = find_type(s, word)) > 0 && text_word(&line, &mass) &&
        text_double(mass, &value) && isfinite(value))
        s->mass[type] = value;
}

/* "number type first second": ids, which are looked up at the end. */
static int read_bond(cgt_trajectory *t, text_span line)
{
    data_state *const s = t->state;
    text_span word;
    uint64_t numbers[4];
    for (int i = 0; i < 4; i++)
        if (!text_word(&line, &word) || (!text_u64(word, UINT64_MAX, &numbers[i]) && i != 1))
            return trajectory_fail(t, t->text.line, "a bond has a number, a type and the ids of two atoms");
    if (s->left_out > 0 && (bond_list_find(&s->bond, (uint32_t)numbers[2]) == BOND_NONE ||
                            bond_list_find(&s->bond, (uint32_t)numbers[3]) == BOND_NONE)) {
        s->lost_bonds++;
        return 1;
    }
    return bond_list_add(&s->bond, (uint32_t)numbers[2], (uint32_t)numbers[3])
               ? trajectory_fail(t, t->text.line, "not enough memory for the bonds")
               : 1;
}

/* Reads the rows of a section up to the next keyword, which *line then has: 1, 0 at the end of the file, -1. is_first:
 * no row of it was read before. */
static int read_rows(cgt_trajectory *t, text_span *line, int is_first, int (*take)(cgt_trajectory *t, text_span line))
{
    while (1) {
        const int status = trajectory_line(t, line);
        if (status <= 0 || lammps_is_keyword(*line, is_first))
            return status;
        const text_span words = lammps_without_comment(*line);
        is_first &= words.begin == words.end;
        if (words.begin < words.end && take != NULL && take(t, words) < 0)
            return -1;
    }
}

static int mass_row(cgt_trajectory *t, text_span line)
{
    read_mass(t->state, line);
    return 1;
}

/* A row of atoms beyond those that the header counts. */
static int left_out_row(cgt_trajectory *t, text_span line)
{
    data_state *const s = t->state;
    (void)line;
    if (s->left_out++ == 0)
        s->first_left = t->text.line;
    return 1;
}

static int velocity_row(cgt_trajectory *t, text_span line)
{
    data_state *const s = t->state;
    text_span word;
    uint64_t id;
    float v[3];
    if (!text_word(&line, &word) || !text_u64(word, UINT64_MAX, &id))
        return trajectory_fail(t, t->text.line, "a velocity begins with the id of its atom");
    for (int i = 0; i < 3; i++)
        if (!text_word(&line, &word) || !text_float(word, &v[i]))
            return trajectory_fail(t, t->text.line, "a velocity has three numbers");
    const uint32_t at = bond_list_find(&s->bond, (uint32_t)id);
    if (at == BOND_NONE && s->left_out > 0)
        return 1;
    if (at == BOND_NONE)
        return trajectory_fail(t, t->text.line, "no atom has the id %" PRIu64, id);
    if (!(s->frame.plan.roles & ROW_BIT(ROW_VX))) /* atoms that are not listed have none */
        memset(t->store.velocity, 0, 3 * sizeof(float) * (size_t)s->atoms);
    memcpy(t->store.velocity + 3 * (size_t)at, v, sizeof v);
    s->frame.plan.roles |= ROW_VELOCITY;
    return 1;
}

/* Reads a section: 1, *line has the next keyword; 0 at the end of the file, -1. */
static int read_section(cgt_trajectory *t, text_span *line)
{
    data_state *const s = t->state;
    const text_span keyword = *line, words = lammps_without_comment(keyword);
    int (*take)(cgt_trajectory * t, text_span line) = NULL;
    const int is_atoms = text_is(words, "Atoms");
    take = text_is(words, "Masses") ? mass_row : text_is(words, "Bonds") ? read_bond : NULL;
    if (text_is(words, "Atom Type Labels")) { /* those of this file, whatever files before it had */
        memset(&s->frame.labels, 0, sizeof s->frame.labels);
        take = label_row;
    }
    take = text_is(words, "Velocities") && s->has_atoms ? velocity_row : take;
    char copy[LAMMPS_HEADING_SIZE];
    snprintf(copy, sizeof copy, "%.*s", (int)text_length(keyword), keyword.begin);
    text_span blank;
    const int status = trajectory_line(t, &blank);
    if (status < 0 || (status == 0 && !is_atoms))
        return status;
    if (status > 0 && !text_is_blank(blank))
        return trajectory_fail(t, t->text.line, "a blank line must follow the keyword of a section");
    if (is_atoms && s->has_atoms)
        return trajectory_fail(t, t->text.line, "a second section of atoms");
    if (is_atoms && s->atoms > 0 &&
        (read_atoms(t, (text_span){copy, copy + strlen(copy)}) < 0 || bond_list_index(t, &s->bond, s->atoms) < 0))
        return -1;
    s->has_atoms |= is_atoms;
    const int more = read_rows(t, line, !is_atoms, is_atoms ? left_out_row : take);
    if (is_atoms && s->left_out > 0)
        trajectory_warn(t, DOUBT_ROWS, s->first_left,
                        "rows of atoms beyond the %" PRIu32 " that the header counts are left out: %" PRIu64, s->atoms,
                        s->left_out);
    return more;
}

/* ---- The format --------------------------------------------------------------------------------------------- */

static int data_begin(cgt_trajectory *t)
{
    data_state *const s = t->state;
    s->was_read = 0;
    return 1;
}

/* Reads title and header; *line gets the first keyword. 1, 0 at the end of the file, -1. */
static int read_head(cgt_trajectory *t, text_span *line)
{
    data_state *const s = t->state;
    s->atoms = s->bonds = 0;
    s->types = s->left_out = s->lost_bonds = 0;
    s->frame.has_box = s->is_general = s->has_atoms = 0;
    row_plan_clear(&s->frame.plan);
    memset(s->frame.unwrapped, 0, sizeof s->frame.unwrapped);
    memset(s->bounds, 0, sizeof s->bounds);
    memset(s->vectors, 0, sizeof s->vectors);
    memset(s->mass, 0, sizeof s->mass);
    for (int axis = 0; axis < 3; axis++) { /* read_data's default */
        s->bounds[axis][0] = -0.5;
        s->bounds[axis][1] = 0.5;
    }
    bond_list_clear(&s->bond);
    int status = trajectory_line(t, line); /* the title */
    while (status > 0 && (status = trajectory_line(t, line)) > 0) {
        const int is_indented = line->begin < line->end && (*line->begin == ' ' || *line->begin == '\t');
        if (lammps_is_keyword(*line, is_indented)) /* other words behind a blank are remarks */
            return 1;
        const text_span words = lammps_without_comment(*line);
        if (words.begin < words.end && read_header_line(t, words) < 0)
            return -1;
    }
    return status;
}

/* The element of a type by its mass, or the mark of what is no atom; 0: none. */
static uint32_t element_of(const data_state *s, uint32_t type)
{
    const double mass = type <= MOST_TYPES ? s->mass[type] : 0.0;
    return mass > 0.0 && mass < SITE_LIGHTEST ? SITE_MARK : element_by_mass(mass);
}

/* Elements follow from the masses where most atoms have that of an element: units where a mass is 1 or 2 know none.
 * Others have none, which is told. */
static void set_elements(cgt_trajectory *t)
{
    data_state *const s = t->state;
    uint32_t elements = 0, odd = 0, odd_type = 0;
    for (uint32_t i = 0; i < s->atoms; i++) {
        const uint32_t element = element_of(s, t->store.type[i]);
        elements += element != 0 && element != SITE_MARK;
        odd_type = element == 0 && odd == 0 ? t->store.type[i] : odd_type;
        odd += element == 0;
    }
    if (elements <= odd)
        return;
    if (odd > 0)
        trajectory_warn(t, DOUBT_SPECIES, 0,
                        "%" PRIu32 " of %" PRIu32 " atoms have no element: the mass of type %" PRIu32
                        " is that of none",
                        odd, s->atoms, odd_type);
    const int has_radius = (s->frame.plan.roles & (ROW_BIT(ROW_RADIUS) | ROW_BIT(ROW_DIAMETER))) != 0;
    s->frame.plan.has_element = 1;
    for (size_t i = 0; i < s->atoms; i++) {
        t->store.element[i] = (uint8_t)element_of(s, t->store.type[i]);
        if (!has_radius && t->options.radius == 0.0f)
            t->store.xyzr[4 * i + 3] = element_radius(t->store.element[i]);
    }
}

static int data_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    data_state *const s = t->state;
    text_span line;
    if (s->was_read)
        return 0;
    int status = read_head(t, &line);
    const int is_empty = status == 0 && t->text.line == 0;
    while (status > 0)
        status = read_section(t, &line);
    if (status < 0 || is_empty)
        return status;
    if (!s->has_atoms && (s->atoms > 0 || !s->frame.has_box))
        return trajectory_fail(t, t->text.line, "the file ends before the section Atoms");
    if (s->bond.count + s->lost_bonds < s->bonds)
        return trajectory_fail(t, t->text.line, "the file ends after %zu of %" PRIu32 " bonds: it is cut off",
                               s->bond.count, s->bonds);
    if (trajectory_reserve(t, 0, 0) < 0 || bond_list_resolve(t, &s->bond) < 0)
        return -1;
    s->was_read = 1;
    set_elements(t);
    trajectory_frame_fill(t, frame, s->atoms);
    if (s->frame.has_box) {
        make_box(s);
        memset(s->frame.box.periodic, -1, sizeof s->frame.box.periodic);
    }
    lammps_set_box(t, frame);
    rows_fill(t, &s->frame.plan, frame);
    frame->bonds = (uint32_t)s->bond.count;
    frame->bond = s->bond.count > 0 ? s->bond.pair : NULL;
    frame->bond_source = s->bond.count > 0 ? CGT_TRAJECTORY_BONDS_LISTED : CGT_TRAJECTORY_BONDS_UNKNOWN;
    return 1;
}

static void data_end(cgt_trajectory *t)
{
    data_state *const s = t->state;
    bond_list_free(&s->bond);
}

const trajectory_format trajectory_format_lammps_data = {
    .is_series = 1,
    .state_size = sizeof(data_state),
    .begin = data_begin,
    .read = data_read,
    .end = data_end,
};
