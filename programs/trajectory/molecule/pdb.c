/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * PDB: records of fixed columns (wwPDB, "Atomic Coordinate Entry Format Description", version 3.3). Each MODEL is a
 * frame; in files without models each END ends one, as programs of molecular dynamics write them. All atoms are read,
 * HETATM and alternate locations too. CONECT gives bonds. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/molecule_atom.h"
#include "trajectory/atoms/trajectory_atoms.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* Numbers of atoms beyond 99999: hexadecimal (186a0), hybrid-36 (A0000), else counted on. */
typedef enum pdb_spelling { PDB_DECIMAL, PDB_HEX, PDB_HYBRID } pdb_spelling;

typedef struct pdb_state {
    name_table names; /* symbols of elements, or names of atoms */
    uint32_t count;
    int in_model, has_models, was_searched;
    int64_t step;
    int has_element;
    uint32_t serial;       /* of the last atom */
    pdb_spelling spelling; /* of the frame, as far as it shows */
    size_t common;         /* bonds of CONECT outside of models, which all of them have: sorted */
    uint32_t before;       /* the first atom of the last CONECT */
    int is_left;           /* names of the frame begin in column 13, whatever their symbols */
    int has_cell;          /* of the last CRYST1, which holds up to the next one */
    double edge[3][3];
    bond_list conect;     /* serial numbers, as read so far */
    bond_list bond;       /* of the frame */
    residue_run residues; /* of the frame */
    int slot[7];          /* of the columns below, 0: not wanted */
} pdb_state;

/* ---- Columns of the table ----------------------------------------------------------------------------------- */

typedef struct pdb_column {
    const char *name;
    cgt_trajectory_column_kind kind;
    size_t begin, width;
} pdb_column;

enum { PDB_COLUMNS = 7 };
static const pdb_column columns[PDB_COLUMNS] = {
    {"name", CGT_TRAJECTORY_WORD, 12, 4},        {"resname", CGT_TRAJECTORY_WORD, 17, 4},
    {"chain", CGT_TRAJECTORY_WORD, 21, 1},       {"resid", CGT_TRAJECTORY_WHOLE, 22, 4},
    {"occupancy", CGT_TRAJECTORY_NUMBER, 54, 6}, {"b_factor", CGT_TRAJECTORY_NUMBER, 60, 6},
    {"altloc", CGT_TRAJECTORY_WORD, 16, 1},
};

static int plan_columns(cgt_trajectory *t)
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
static void store_columns(cgt_trajectory *t, size_t i, text_span line)
{
    const pdb_state *const s = t->state;
    for (int k = 0; k < PDB_COLUMNS; k++) {
        if (s->slot[k] == 0)
            continue;
        const text_span field = field_at(line, columns[k].begin, columns[k].width);
        if (columns[k].kind == CGT_TRAJECTORY_WORD) {
            columns_store_word(t, s->slot[k], i, field);
        } else {
            float *const value = columns_values(t, s->slot[k]) + i;
            *value = NAN;
            field_float(field, value);
        }
    }
}

/* ---- Atoms -------------------------------------------------------------------------------------------------- */

static int is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/* By columns 77 and 78, else by the name, whose first two columns are for the symbol: " CA " is carbon, "CA " calcium.
 * Files whose names begin in column 13 with what is no symbol ("N   ") do not keep to that. site: the mark where the
 * name is that of no atom, which a symbol may deny, but for dummies. */
static uint32_t find_element(cgt_trajectory *t, text_span line, text_span name, text_span residue, uint32_t site)
{
    pdb_state *const s = t->state;
    element_reading reading;
    const text_span symbol = field_at(line, 76, 2);
    if (symbol.begin < symbol.end && is_letter(*symbol.begin) && !text_is(residue, "DUM")) {
        const uint32_t element = element_find(symbol, &reading);
        if (reading == ELEMENT_SYMBOL || reading == ELEMENT_EITHER)
            return element;
    }
    if (site != 0)
        return site;
    const size_t length = text_length(name);
    const int is_early = text_length(line) > 12 && is_letter(line.begin[12]);
    if (is_early && length < 4) {
        element_find((text_span){name.begin, name.begin + (length < 2 ? length : 2)}, &reading);
        s->is_left |= length < 2 || (reading != ELEMENT_SYMBOL && reading != ELEMENT_EITHER);
    }
    return molecule_element(t, name, residue,
                            !is_early                   ? NAME_OF_LABEL
                            : length < 4 && !s->is_left ? NAME_OF_SYMBOL
                                                        : NAME_ANYWHERE);
}

/* ---- Numbers of atoms --------------------------------------------------------------------------------------- */

/* The digits of a base at most 36, letters of one case: 1, or 0. */
static int parse_digits(text_span word, uint32_t base, uint64_t *value)
{
    *value = 0;
    for (const char *p = word.begin; p < word.end; p++) {
        const uint32_t digit = *p >= '0' && *p <= '9'   ? (uint32_t)(*p - '0')
                               : *p >= 'a' && *p <= 'z' ? (uint32_t)(*p - 'a') + 10
                               : *p >= 'A' && *p <= 'Z' ? (uint32_t)(*p - 'A') + 10
                                                        : base;
        if (digit >= base)
            return 0;
        *value = *value * base + digit;
    }
    return word.begin < word.end && *value <= UINT32_MAX;
}

/* A0000 follows 99999, and a0000 ZZZZZ. */
static int parse_hybrid(text_span word, uint64_t *value)
{
    const uint64_t letters = 36 * 36 * 36 * 36;
    if (text_length(word) != 5 || !is_letter(*word.begin) || !parse_digits(word, 36, value))
        return 0;
    *value += 100000 - 10 * letters + (*word.begin >= 'a' ? 26 * letters : 0);
    return 1;
}

/* Before the first atom of a frame: each is read as if it were alone, since the same atoms have to get the same numbers
 * and elements in all of them. */
static void begin_atoms(pdb_state *s)
{
    s->serial = s->before = 0;
    s->spelling = PDB_DECIMAL;
    s->is_left = 0;
}

/* Beyond 99999 programs write letters or stars, begin at 0 again, or take a column more. */
static uint32_t read_serial(pdb_state *s, text_span line)
{
    const int is_wide = text_length(line) > 5 && line.begin[5] >= '1' && line.begin[5] <= '9';
    const text_span field = is_wide ? field_at(line, 5, 6) : field_at(line, 6, 5);
    uint64_t number;
    const uint32_t next = s->serial + 1;
    if (parse_digits(field, 10, &number)) {
        uint64_t hex;
        if (s->spelling == PDB_HEX && s->serial > 99999 && parse_digits(field, 16, &hex) && hex > 99999)
            return (uint32_t)hex;
        /* modulo 100000, perhaps with a TER between */
        const uint32_t turn = s->serial / 100000 + (s->serial % 100000 > 99900 && number < 100);
        const int goes_on = turn > 0 && number < 100000 && number + 100000 * (uint64_t)turn - s->serial < 100;
        return goes_on ? (uint32_t)(number + 100000 * (uint64_t)turn) : (uint32_t)number;
    }
    if (field.begin == field.end || !((*field.begin >= '0' && *field.begin <= '9') || is_letter(*field.begin)))
        return next;
    if (s->spelling == PDB_DECIMAL)
        s->spelling = is_letter(*field.begin) ? PDB_HYBRID : PDB_HEX;
    const int is_number = s->spelling == PDB_HEX ? parse_digits(field, 16, &number) : parse_hybrid(field, &number);
    return is_number ? (uint32_t)number : next;
}

static int read_places(cgt_trajectory *t, text_span line, float *place)
{
    char quote[TEXT_QUOTE_SIZE];
    for (size_t k = 0; k < 3; k++) {
        const text_span field = field_at(line, 30 + 8 * k, 8);
        if (!field_place(t, k, field, &place[k]))
            return trajectory_fail(t, t->text.line, "'%s' in columns %zu to %zu is not a coordinate",
                                   text_quote(field, quote), 31 + 8 * k, 38 + 8 * k);
    }
    return 1;
}

static int read_atom(cgt_trajectory *t, text_span line)
{
    pdb_state *const s = t->state;
    const size_t i = s->count;
    const text_span name = field_at(line, 12, 4), residue = field_at(line, 17, 4);
    if (s->count >= t->options.max_count)
        return trajectory_fail(t, t->text.line, "more spheres than the limit of %" PRIu64, t->options.max_count);
    if (trajectory_reserve(t, i + 1, SIZE_MAX) < 0 || read_places(t, line, t->store.xyzr + 4 * i) < 0)
        return -1;
    const text_span place = field_at(line, 16, 1);
    atoms_set_place(t, i, text_length(place) > 0 ? *place.begin : '\0');
    const uint32_t site = atoms_set_residue(t, &s->residues, i, field_at(line, 17, 10), residue, name);
    const uint32_t element = find_element(t, line, name, residue, site);
    const char *const symbol = element_symbol(element);
    text_span type = *symbol != '\0' ? (text_span){symbol, symbol + strlen(symbol)} : name;
    if (text_length(type) == 0)
        type = MOLECULE_UNNAMED;
    s->serial = read_serial(s, line);
    t->store.id[i] = s->serial;
    s->has_element |= element != 0;
    s->count++;
    store_columns(t, i, line);
    return molecule_store(t, &s->names, i, type, element, 1.0f);
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

/* A number of CONECT near another, in the spelling of the atoms. Hexadecimal without a letter is what is nearer. */
static int parse_bonded(cgt_trajectory *t, text_span field, uint64_t near, uint64_t *value)
{
    const pdb_state *const s = t->state;
    uint64_t hex;
    const int is_decimal = parse_digits(field, 10, value);
    if (s->spelling == PDB_HYBRID && !is_decimal)
        return parse_hybrid(field, value);
    if (s->spelling != PDB_HEX || !parse_digits(field, 16, &hex) || hex < 100000)
        return is_decimal;
    if (is_decimal) {
        const uint64_t far = near > *value ? near - *value : *value - near,
                       far_hex = near > hex ? near - hex : hex - near;
        if (far <= far_hex)
            return 1;
        trajectory_warn(t, DOUBT_HEX, t->text.line,
                        "numbers of bonds such as %" PRIu64 " may be decimal or hexadecimal: the nearer atom is taken",
                        *value);
    }
    *value = hex;
    return 1;
}

/* The widths of `count` numbers that fill a line: 5 columns each, 6 for those of six digits, which no blank sets apart.
 * Of several ways the one whose atoms are nearest to the first. Returns how many numbers there are. */
static size_t cut_wide(text_span rest, uint64_t number[5])
{
    const size_t length = text_length(rest), count = (length + 5) / 6;
    uint64_t best = UINT64_MAX;
    if (count < 2 || count > 5 || length < 5 * count)
        return 0;
    for (unsigned wide = 0; wide < 1u << count; wide++) {
        uint64_t found[5], sum = 0;
        size_t at = 0, i = 0;
        for (; i < count; i++) {
            const size_t width = 5 + (wide >> i & 1u);
            const text_span field = field_at(rest, at, width);
            at += width;
            if (at > length || rest.begin[at - 1] == ' ' || !parse_digits(field, 10, &found[i]) ||
                (width == 6 && found[i] < 100000 && length < 6 * count))
                break;
            sum += found[i] > found[0] ? found[i] - found[0] : found[0] - found[i];
        }
        if (i == count && at == length && sum < best) {
            best = sum;
            memcpy(number, found, sizeof found);
        }
    }
    return best < UINT64_MAX ? count : 0;
}

/* An atom and up to four others. */
static int read_conect(cgt_trajectory *t, text_span line)
{
    pdb_state *const s = t->state;
    uint64_t number[5] = {0};
    text_span rest = {line.begin + 6, line.end};
    while (rest.end > rest.begin && (rest.end[-1] == ' ' || rest.end[-1] == '\r'))
        rest.end--;
    size_t count =
        s->spelling == PDB_DECIMAL && s->serial > 99999 && text_length(rest) <= 30 ? cut_wide(rest, number) : 0;
    if (count == 0) {
        if (!parse_bonded(t, field_at(line, 6, 5), s->before, &number[0]))
            return 1;
        for (size_t i = 0; i < 4; i++)
            count += (size_t)parse_bonded(t, field_at(line, 11 + 5 * i, 5), number[0], &number[count + 1]);
        count++;
    }
    s->before = (uint32_t)number[0];
    for (size_t i = 1; i < count; i++)
        if (bond_list_add(&s->conect, (uint32_t)number[0], (uint32_t)number[i]))
            return trajectory_fail(t, t->text.line, "not enough memory for the bonds");
    return 1;
}

/* The bonds of the frame's atoms; some may be to atoms that are not there. */
static int find_bonds(cgt_trajectory *t)
{
    pdb_state *const s = t->state;
    bond_list_clear(&s->bond);
    if (s->conect.count == 0)
        return 1;
    int missing = bond_list_index(t, &s->bond, s->count) < 0 ||
                  bond_list_select(&s->bond, s->conect.pair, s->common); /* of the models, which may be many */
    for (size_t i = s->common; i < s->conect.count && !missing; i++)
        missing = bond_list_add(&s->bond, s->conect.pair[2 * i], s->conect.pair[2 * i + 1]);
    if (missing)
        return t->failed ? -1 : trajectory_fail(t, t->text.line, "not enough memory for the bonds");
    return bond_list_resolve_present(t, &s->bond);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

static int is_end(text_span line) { return text_is(field_at(line, 0, 6), "END"); }

static int is_record(text_span line, const char *name)
{
    const size_t length = strlen(name);
    return text_begins(line, name) && (text_length(line) == length || line.begin[length] == ' ' || length == 6);
}

/* Takes a line: 1 go on, 2 the frame is complete, -1. */
static int take_line(cgt_trajectory *t, text_span line)
{
    pdb_state *const s = t->state;
    if (is_record(line, "ATOM") || is_record(line, "HETATM"))
        return read_atom(t, line);
    if (is_record(line, "CONECT")) {
        if (s->has_models && !s->in_model && !s->was_searched)
            trajectory_warn(t, DOUBT_LATE_BONDS, t->text.line,
                            "bonds after the models come too late in a stream: a file has them in all models");
        return s->has_models && !s->in_model ? 1 : read_conect(t, line); /* those of all models were read before */
    }
    if (is_record(line, "CRYST1")) {
        read_cell(s, line);
    } else if (is_record(line, "MODEL")) {
        if (s->in_model && s->count > 0) { /* the one before has no ENDMDL */
            text_reader_back(&t->text);
            s->in_model = 0;
            return 2;
        }
        text_span number = {line.begin + 5, line.end};
        text_trim(&number);
        s->in_model = s->has_models = 1;
        s->step = text_i64(number, &s->step) ? s->step : (int64_t)t->next;
    } else if (is_record(line, "ENDMDL")) {
        const int ends = s->in_model || s->count > 0; /* else an END has ended it */
        s->in_model = 0;
        return ends ? 2 : 1;
    } else if (is_end(line)) {
        s->in_model = 0;
        return s->count > 0 ? 2 : 1;
    }
    return 1;
}

/* Reads the lines of a frame: 1, 0 after the last frame, -1. */
static int read_lines(cgt_trajectory *t)
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

/* Bonds stand after all models. What can be read twice is searched for them first, so that the first model has them,
 * too; those inside of a model are its own. */
static int find_conect(cgt_trajectory *t)
{
    pdb_state *const s = t->state;
    char reason[256];
    text_span line;
    int status, has_models = 0, is_inside = 0;
    pdb_spelling spelling = PDB_DECIMAL; /* of the models so far */
    bond_list_clear(&s->conect);
    s->common = 0;
    s->was_searched = t->input.can_rewind && t->options.follow == 0.0;
    if (!s->was_searched)
        return 1;
    while ((status = trajectory_line(t, &line)) > 0) {
        is_inside = is_record(line, "MODEL") || (is_inside && !is_record(line, "ENDMDL") && !is_end(line));
        has_models |= is_inside;
        if (is_record(line, "MODEL"))
            begin_atoms(s);
        if (is_inside && (is_record(line, "ATOM") || is_record(line, "HETATM")))
            s->serial = read_serial(s, line);
        spelling = s->spelling != PDB_DECIMAL ? s->spelling : spelling;
        s->spelling = is_inside ? s->spelling : spelling;
        if (has_models && !is_inside && is_record(line, "CONECT") && read_conect(t, line) < 0)
            return -1;
    }
    if (!has_models || status < 0)
        bond_list_clear(&s->conect);
    bond_list_sort(&s->conect);
    s->common = s->conect.count;
    t->failed = 0; /* reading comes to the error again, after the frames before it */
    if (trajectory_input_rewind(&t->input, reason, sizeof reason))
        return trajectory_fail(t, 0, "%s", reason);
    t->file = t->text.file = t->input.stream;
    text_reader_restart(&t->text);
    return 1;
}

static int pdb_begin(cgt_trajectory *t)
{
    pdb_state *const s = t->state;
    s->in_model = s->has_models = s->has_cell = 0;
    return find_conect(t);
}

static int pdb_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    static const double origin[3] = {0, 0, 0};
    pdb_state *const s = t->state;
    s->count = 0;
    begin_atoms(s);
    s->has_element = 0;
    s->step = (int64_t)t->next;
    if (plan_columns(t) < 0 || trajectory_reserve(t, 0, SIZE_MAX) < 0)
        return -1;
    const int status = read_lines(t);
    if (status <= 0)
        return status;
    if (find_bonds(t) < 0)
        return -1;
    s->conect.count = s->has_models ? s->common : 0;
    molecule_tell_guesses(t);
    trajectory_frame_fill(t, frame, s->count);
    frame->step = s->step;
    frame->id = t->store.id;
    frame->type = t->store.type;
    frame->element = s->has_element ? t->store.element : NULL;
    frame->bonds = (uint32_t)s->bond.count;
    frame->bond = s->bond.count > 0 ? s->bond.pair : NULL;
    frame->bond_source = s->bond.count > 0 ? CGT_TRAJECTORY_BONDS_LISTED : CGT_TRAJECTORY_BONDS_UNKNOWN;
    if (s->has_cell) {
        trajectory_frame_set_box(frame, origin, (const double(*)[3])s->edge);
        memset(frame->periodic, 1, sizeof frame->periodic);
    }
    return 1;
}

static void pdb_end(cgt_trajectory *t)
{
    pdb_state *const s = t->state;
    bond_list_free(&s->conect);
    bond_list_free(&s->bond);
}

const trajectory_format trajectory_format_pdb = {
    .is_series = 1,
    .lists_some = 1, /* wwPDB, CONECT: not those within amino acids, nucleotides and water */
    .state_size = sizeof(pdb_state),
    .begin = pdb_begin,
    .read = pdb_read, /* no skip: names are numbered in order of appearance, so that a skipped frame must be read */
    .end = pdb_end,
};
