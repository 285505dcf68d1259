/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * PDB: records of fixed columns (wwPDB, "Atomic Coordinate Entry Format Description", version 3.3). Each MODEL is a
 * frame; in files without models each END ends one, as programs of molecular dynamics write them. All atoms are read,
 * HETATM and alternate locations too. CONECT gives bonds. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/molecule_atom.h"
#include "trajectory/trajectory_bonds.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

typedef struct pdb_state {
    name_table names; /* symbols of elements, or names of atoms; kept when rewinding, so that types stay the same */
    uint32_t count;
    int in_model, has_models;
    int64_t step;
    int has_element;
    uint32_t serial; /* of the last atom */
    int has_cell;
    double edge[3][3];
    bond_list conect; /* serial numbers, as read so far */
    bond_list bond;   /* of the frame */
    int slot[6];      /* of the columns below, 0: not wanted */
} pdb_state;

/* ---- Columns of the table ----------------------------------------------------------------------------------- */

typedef struct pdb_column {
    const char *name;
    trajectory_column_kind kind;
    size_t begin, width;
} pdb_column;

enum { PDB_COLUMNS = 6 };
static const pdb_column columns[PDB_COLUMNS] = {
    {"name", TRAJECTORY_WORD, 12, 4},   {"resname", TRAJECTORY_WORD, 17, 4},     {"chain", TRAJECTORY_WORD, 21, 1},
    {"resid", TRAJECTORY_WHOLE, 22, 4}, {"occupancy", TRAJECTORY_NUMBER, 54, 6}, {"b_factor", TRAJECTORY_NUMBER, 60, 6},
};

static int plan_columns(trajectory *t)
{
    pdb_state *const s = t->state;
    for (int i = 0; i < PDB_COLUMNS; i++) {
        s->slot[i] = columns_add_named(t, columns[i].name, columns[i].kind);
        if (s->slot[i] < 0)
            return -1;
    }
    return 1;
}

/* Stores the wanted columns of atom i; a blank field is no word, or no number. */
static int store_columns(trajectory *t, size_t i, text_span line)
{
    const pdb_state *const s = t->state;
    for (int k = 0; k < PDB_COLUMNS; k++) {
        if (s->slot[k] == 0)
            continue;
        const text_span field = field_at(line, columns[k].begin, columns[k].width);
        float *const value = columns_values(t, s->slot[k]) + i;
        const char *reason = "";
        if (columns[k].kind != TRAJECTORY_WORD) {
            *value = NAN;
            field_float(field, value);
            continue;
        }
        const uint32_t number = field.begin < field.end ? columns_word(t, s->slot[k], field, &reason) : 0;
        if (*reason != '\0')
            return trajectory_fail(t, t->text.line, "%s", reason);
        *value = (float)number;
    }
    return 1;
}

/* ---- Atoms -------------------------------------------------------------------------------------------------- */

static int is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/* By columns 77 and 78, else by the name, whose first two columns are for the symbol: " CA " is carbon, "CA "
 * calcium. */
static uint32_t find_element(text_span line, text_span name, text_span residue)
{
    element_reading reading;
    const text_span symbol = field_at(line, 76, 2);
    if (symbol.begin < symbol.end && is_letter(*symbol.begin)) {
        const uint32_t element = element_find(symbol, &reading);
        if (reading == ELEMENT_SYMBOL || reading == ELEMENT_EITHER)
            return element;
    }
    if (text_length(line) < 14 || is_letter(line.begin[12]))
        return molecule_element(name, residue);
    return is_letter(line.begin[13]) ? element_find((text_span){line.begin + 13, line.begin + 14}, &reading) : 0;
}

/* Beyond 99999 programs write letters or stars: such atoms count on. */
static uint32_t read_serial(const pdb_state *s, text_span field)
{
    uint64_t number;
    return text_u64(field, UINT32_MAX, &number) && text_length(field) > 0 ? (uint32_t)number : s->serial + 1;
}

static int read_places(trajectory *t, text_span line, float *place)
{
    char quote[TEXT_QUOTE_SIZE];
    for (size_t k = 0; k < 3; k++) {
        const text_span field = field_at(line, 30 + 8 * k, 8);
        if (!field_float(field, &place[k]))
            return trajectory_fail(t, t->text.line, "'%s' in columns %zu to %zu is not a coordinate",
                                   text_quote(field, quote), 31 + 8 * k, 38 + 8 * k);
    }
    return 1;
}

static int read_atom(trajectory *t, text_span line)
{
    pdb_state *const s = t->state;
    const size_t i = s->count;
    const text_span name = field_at(line, 12, 4), residue = field_at(line, 17, 4);
    const uint32_t element = find_element(line, name, residue);
    if (s->count >= t->options.max_count)
        return trajectory_fail(t, t->text.line, "more spheres than the limit of %" PRIu64, t->options.max_count);
    if (trajectory_reserve(t, i + 1, SIZE_MAX) < 0 || read_places(t, line, t->store.xyzr + 4 * i) < 0)
        return -1;
    const char *const symbol = element_symbol(element);
    text_span type = {symbol, symbol + strlen(symbol)};
    type = element == 0 ? name : type;
    if (text_length(type) == 0)
        type = MOLECULE_UNNAMED;
    s->serial = read_serial(s, field_at(line, 6, 5));
    t->store.id[i] = s->serial;
    s->has_element |= element != 0;
    s->count++;
    return molecule_store(t, &s->names, i, type, element, 1.0f) < 0 ? -1 : store_columns(t, i, line);
}

/* ---- Other records ------------------------------------------------------------------------------------------ */

/* A cell of 1 x 1 x 1 stands for none. */
static void read_cell(pdb_state *s, text_span line)
{
    double length[3], angle[3];
    s->has_cell = 1;
    for (size_t i = 0; i < 3; i++)
        s->has_cell &= field_double(field_at(line, 6 + 9 * i, 9), &length[i]) &&
                       field_double(field_at(line, 33 + 7 * i, 7), &angle[i]);
    s->has_cell = s->has_cell && !(length[0] == 1.0 && length[1] == 1.0 && length[2] == 1.0) &&
                  molecule_cell(length, angle, s->edge);
}

/* An atom and up to four others. */
static int read_conect(trajectory *t, text_span line)
{
    pdb_state *const s = t->state;
    uint64_t first, other;
    if (!text_u64(field_at(line, 6, 5), UINT32_MAX, &first))
        return 1;
    for (size_t i = 0; i < 4; i++)
        if (text_u64(field_at(line, 11 + 5 * i, 5), UINT32_MAX, &other) &&
            bond_list_add(&s->conect, (uint32_t)first, (uint32_t)other))
            return trajectory_fail(t, t->text.line, "not enough memory for the bonds");
    return 1;
}

/* The bonds of the frame's atoms; some may be to atoms that are not there. */
static int find_bonds(trajectory *t)
{
    pdb_state *const s = t->state;
    bond_list_clear(&s->bond);
    if (s->conect.count == 0)
        return 1;
    for (size_t i = 0; i < s->conect.count; i++)
        if (bond_list_add(&s->bond, s->conect.pair[2 * i], s->conect.pair[2 * i + 1]))
            return trajectory_fail(t, t->text.line, "not enough memory for the bonds");
    return bond_list_index(t, &s->bond, s->count) < 0 ? -1 : bond_list_resolve_present(t, &s->bond);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

static int is_record(text_span line, const char *name)
{
    const size_t length = strlen(name);
    return text_begins(line, name) && (text_length(line) == length || line.begin[length] == ' ' || length == 6);
}

/* Takes a line: 1 go on, 2 the frame is complete, -1. */
static int take_line(trajectory *t, text_span line)
{
    pdb_state *const s = t->state;
    if (is_record(line, "ATOM") || is_record(line, "HETATM"))
        return read_atom(t, line);
    if (is_record(line, "CONECT"))
        return s->has_models ? 1 : read_conect(t, line); /* those of models were read before */
    if (is_record(line, "CRYST1")) {
        read_cell(s, line);
    } else if (is_record(line, "MODEL")) {
        text_span number = {line.begin + 5, line.end};
        text_trim(&number);
        s->in_model = s->has_models = 1;
        s->step = text_i64(number, &s->step) ? s->step : (int64_t)t->next;
    } else if (is_record(line, "ENDMDL")) {
        s->in_model = 0;
        return 2;
    } else if (text_is(field_at(line, 0, 6), "END")) {
        return s->count > 0 && !s->in_model ? 2 : 1;
    }
    return 1;
}

/* Reads the lines of a frame: 1, 0 after the last frame, -1. */
static int read_lines(trajectory *t)
{
    pdb_state *const s = t->state;
    int state = 1;
    while (state == 1) {
        text_span line;
        const int status = trajectory_line(t, &line);
        if (status < 0)
            return -1;
        if (status == 0) {
            if (s->in_model)
                return trajectory_fail(t, t->text.line, "the file ends in a model: it is cut off");
            if (s->count > 0)
                trajectory_warn(t, DOUBT_NO_END, t->text.line, "no END after the last atom: the file may be cut off");
            if (s->count == 0 && t->next == 0 && !s->has_models && t->text.line > 0)
                return trajectory_fail(t, t->text.line, "no ATOM or HETATM in the whole file: this is not PDB");
            return s->count > 0;
        }
        state = take_line(t, line);
    }
    return state < 0 ? -1 : 1;
}

/* Bonds stand after all models. A regular file is searched for them first, so that the first model has them, too. */
static int find_conect(trajectory *t)
{
    pdb_state *const s = t->state;
    char reason[256];
    text_span line;
    int status, has_models = 0;
    bond_list_clear(&s->conect);
    if (!t->regular)
        return 1;
    while ((status = trajectory_line(t, &line)) > 0) {
        has_models |= text_begins(line, "MODEL");
        if (has_models && text_begins(line, "CONECT") && read_conect(t, line) < 0)
            return -1;
    }
    if (!has_models || status < 0)
        bond_list_clear(&s->conect);
    t->failed = 0; /* reading comes to the error again, after the frames before it */
    if (trajectory_input_rewind(&t->input, reason, sizeof reason))
        return trajectory_fail(t, 0, "%s", reason);
    t->file = t->text.file = t->input.stream;
    text_reader_restart(&t->text);
    return 1;
}

static int pdb_begin(trajectory *t)
{
    pdb_state *const s = t->state;
    s->in_model = s->has_models = s->has_cell = 0;
    return find_conect(t);
}

static int pdb_read(trajectory *t, trajectory_frame *frame)
{
    static const double origin[3] = {0, 0, 0};
    pdb_state *const s = t->state;
    s->count = s->serial = 0;
    s->has_element = 0;
    s->step = (int64_t)t->next;
    if (plan_columns(t) < 0 || trajectory_reserve(t, 0, SIZE_MAX) < 0)
        return -1;
    const int status = read_lines(t);
    if (status <= 0)
        return status;
    if (find_bonds(t) < 0)
        return -1;
    if (!s->has_models && t->path_count == 1)
        bond_list_clear(&s->conect);
    trajectory_frame_fill(t, frame, s->count);
    frame->step = s->step;
    frame->id = t->store.id;
    frame->type = t->store.type;
    frame->element = s->has_element ? t->store.element : NULL;
    frame->bonds = (uint32_t)s->bond.count;
    frame->bond = s->bond.count > 0 ? s->bond.pair : NULL;
    if (s->has_cell) {
        trajectory_frame_set_box(frame, origin, (const double(*)[3])s->edge);
        memset(frame->periodic, 1, sizeof frame->periodic);
    }
    return 1;
}

static void pdb_end(trajectory *t)
{
    pdb_state *const s = t->state;
    bond_list_free(&s->conect);
    bond_list_free(&s->bond);
}

const trajectory_format trajectory_format_pdb = {
    .is_series = 1,
    .state_size = sizeof(pdb_state),
    .begin = pdb_begin,
    .read = pdb_read, /* no skip: names are numbered in order of appearance, so that a skipped frame must be read */
    .end = pdb_end,
};
