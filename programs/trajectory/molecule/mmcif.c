/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * CIF: of macromolecules (mmCIF, PDBx), a frame for each model, and of small molecules and crystals, a frame for each
 * block, whose fractional coordinates become all atoms of the cell by the symmetry that is given. All atoms are read,
 * alternate locations and groups of disorder too. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/cif_crystal.h"
#include "trajectory/molecule/cif_tags.h"
#include "trajectory/molecule/cif_tokens.h"
#include "trajectory/molecule/molecule_atom.h"
#include "trajectory/atoms/trajectory_atoms.h"
#include "trajectory/atoms/trajectory_sites.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define WORD 32u /* bytes of a name, its zero included */

static const struct {
    const char *name;
    cgt_trajectory_column_kind kind;
} columns[CIF_COLUMNS] = {{"name", CGT_TRAJECTORY_WORD},        {"resname", CGT_TRAJECTORY_WORD},
                          {"chain", CGT_TRAJECTORY_WORD},       {"resid", CGT_TRAJECTORY_WHOLE},
                          {"occupancy", CGT_TRAJECTORY_NUMBER}, {"b_factor", CGT_TRAJECTORY_NUMBER},
                          {"altloc", CGT_TRAJECTORY_WORD}};

enum { GROUP_TAGS = 8 };

/* Tags of a loop that name its row's space group. */
typedef struct cif_group_tags {
    uint32_t count, rows;
    uint32_t at[GROUP_TAGS]; /* in the loop */
    char tag[GROUP_TAGS][CIF_TAG_SIZE];
} cif_group_tags;

typedef struct cif_atom {
    char value[CIF_ROLES][WORD]; /* "" for those without */
} cif_atom;

typedef struct mmcif_state {
    cif_tokens tokens;
    name_table names;
    int rows;      /* of the loop, a cif_rows */
    int is_single; /* tags of an atom outside of loops were read */
    cif_tags tags; /* of the loop or the single atom */
    cif_group_tags groups;
    cif_atom atom;   /* the last one read */
    int has_pending; /* it begins the next frame */
    uint32_t count;
    int has_element;
    uint32_t numbered; /* atoms that have an id */
    cif_crystal crystal;
    uint32_t partial, lost; /* atoms that are there in part, and those without a place */
    residue_run residues;   /* of the frame */
    int slot[CIF_COLUMNS];
} mmcif_state;

/* ---- Loops -------------------------------------------------------------------------------------------------- */

static void copy_word(text_span text, char word[WORD])
{
    const size_t length = text_length(text) < WORD - 1 ? text_length(text) : WORD - 1;
    memcpy(word, text.begin, length);
    word[length] = '\0';
}

/* Reads the tags of a loop. Returns the kind of the token after them (its text in *text), or -1. */
static int read_tags(cgt_trajectory *t, text_span *text)
{
    mmcif_state *const s = t->state;
    char tag[CIF_TAG_SIZE];
    int kind;
    cif_group_tags *const g = &s->groups;
    s->tags.count = g->count = g->rows = 0;
    while ((kind = cif_next(t, &s->tokens, text)) == CIF_TAG) {
        cif_tag_copy(*text, tag);
        const uint32_t at = s->tags.count;
        if (cif_tags_add(&s->tags, tag) != CIF_ROLES)
            continue;
        if (cif_crystal_names_group(tag) && g->count < GROUP_TAGS && at < CIF_MOST_TAGS) {
            g->at[g->count] = at;
            memcpy(g->tag[g->count++], tag, CIF_TAG_SIZE);
        } else {
            cif_crystal_note(&s->crystal, tag);
        }
    }
    s->rows = kind > 0 ? cif_tags_rows(t, &s->tags) : 0;
    if (s->rows == CIF_ROWS_OTHER && g->count > 0 && s->tags.count <= CIF_MOST_TAGS)
        s->rows = CIF_ROWS_OPERATIONS;
    return s->rows < 0 ? -1 : kind;
}

/* ---- Atoms -------------------------------------------------------------------------------------------------- */

/* An operation, or a centring, by its role. */
static int add_operation(cgt_trajectory *t, int role, text_span text)
{
    mmcif_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    const char *const reason = role == CIF_OPERATION ? cif_crystal_add_operation(&s->crystal, text)
                                                     : cif_crystal_add_centring(&s->crystal, text);
    return reason == NULL ? 1 : trajectory_fail(t, t->text.line, "'%s': %s", text_quote(text, quote), reason);
}

/* Takes value i of a row that names the space group. Of several groups none is known to count. */
static void take_group_name(mmcif_state *s, uint32_t i, text_span text)
{
    const cif_group_tags *const g = &s->groups;
    for (uint32_t k = 0; k < g->count; k++)
        if (g->at[k] == i && g->rows > 0)
            cif_crystal_note(&s->crystal, g->tag[k]);
        else if (g->at[k] == i)
            cif_crystal_take(&s->crystal, g->tag[k], text);
}

/* Reads the values of an atom or an operation, the first of which is there. Returns 1 or -1. */
static int read_values(cgt_trajectory *t, text_span first)
{
    mmcif_state *const s = t->state;
    memset(&s->atom, 0, sizeof s->atom);
    for (uint32_t i = 0; i < s->tags.count; i++) {
        text_span text = first;
        if (i > 0) {
            const int kind = cif_next(t, &s->tokens, &text);
            if (kind < 0)
                return -1;
            if (kind != CIF_VALUE)
                return trajectory_fail(t, t->text.line, "%" PRIu32 " of %" PRIu32 " values of a row%s", i,
                                       s->tags.count, kind == CIF_END ? ": the file is cut off" : "");
        }
        const int is_missing = text_is(text, ".") || text_is(text, "?");
        if ((s->tags.role[i] == CIF_OPERATION || s->tags.role[i] == CIF_CENTRING) && !is_missing &&
            add_operation(t, s->tags.role[i], text) < 0)
            return -1;
        if (s->tags.role[i] < CIF_OPERATION && !is_missing)
            copy_word(text, s->atom.value[s->tags.role[i]]);
        if (!is_missing)
            take_group_name(s, i, text);
    }
    s->groups.rows++;
    return 1;
}

static text_span value_of(const mmcif_state *s, cif_role role)
{
    const char *const value = s->atom.value[role];
    return (text_span){value, value + strlen(value)};
}

static void store_columns(cgt_trajectory *t, size_t i)
{
    const mmcif_state *const s = t->state;
    for (int k = 0; k < CIF_COLUMNS; k++) {
        if (s->slot[k] == 0)
            continue;
        const text_span text = value_of(s, (cif_role)k);
        if (columns[k].kind == CGT_TRAJECTORY_WORD) {
            columns_store_word(t, s->slot[k], i, text);
        } else {
            double number = NAN;
            cif_number(text, &number);
            columns_values(t, s->slot[k])[i] = (float)number;
        }
    }
}

/* Reads the place of an atom: 1, 0 it has none, -1. */
static int store_place(cgt_trajectory *t, size_t i)
{
    mmcif_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    if (s->tags.is_fractional && cif_crystal_reserve(&s->crystal, i))
        return trajectory_fail(t, 0, "not enough memory for the atoms");
    for (int k = 0; k < 3; k++) {
        const text_span text = value_of(s, (cif_role)((s->tags.is_fractional ? CIF_FRACT_X : CIF_X) + k));
        double value;
        if (text_length(text) == 0)
            return 0;
        if (!cif_number(text, &value))
            return trajectory_fail(t, t->text.line, "'%s' is not a coordinate", text_quote(text, quote));
        t->store.xyzr[4 * i + (size_t)k] = trajectory_place(t, (size_t)k, value);
        if (s->tags.is_fractional)
            s->crystal.place[i][k] = value;
    }
    return 1;
}

/* Whether an atom of a crystal is there in part: an occupancy below 1, or a group of disorder. */
static int is_partial(const mmcif_state *s)
{
    double occupancy = 1.0;
    cif_number(value_of(s, CIF_OCCUPANCY), &occupancy);
    const text_span group = value_of(s, CIF_GROUP);
    return occupancy < 1.0 || (text_length(group) > 0 && !text_is(group, "0"));
}

/* Stores the residue of an atom, and its place among several: groups of disorder exclude each other. Returns the mark
 * of trajectory_sites.h where it is no atom, or 0. element: of its symbol. */
static uint32_t store_residue(cgt_trajectory *t, size_t i, uint32_t element)
{
    mmcif_state *const s = t->state;
    char key[4 * WORD];
    snprintf(key, sizeof key, "%s %s %s", s->atom.value[CIF_CHAIN], s->atom.value[CIF_SEQUENCE],
             s->atom.value[CIF_RESIDUE]);
    const char *place = s->atom.value[s->tags.is_fractional ? CIF_GROUP : CIF_PLACE];
    place += *place == '-';
    atoms_set_place(t, i, s->tags.is_fractional && *place == '0' ? '\0' : *place);
    const text_span name = value_of(s, CIF_NAME), symbol = value_of(s, CIF_ELEMENT), residue = value_of(s, CIF_RESIDUE);
    const text_span none = {name.end, name.end}, known = text_length(symbol) > 0 ? symbol : name;
    const int is_denied = element != 0 && !text_is(residue, "DUM");
    uint32_t site = 0;
    if (!s->tags.is_fractional)
        site = atoms_set_residue(t, &s->residues, i, (text_span){key, key + strlen(key)}, residue, name);
    if (site == 0 && text_length(residue) == 0)
        site = site_find(known, none, none);
    return text_is(value_of(s, CIF_FLAG), "dum") ? SITE_MARK : is_denied ? 0 : site;
}

static int store_atom(cgt_trajectory *t)
{
    mmcif_state *const s = t->state;
    const size_t i = s->count;
    element_reading reading;
    uint64_t id;
    if (s->count >= t->options.max_count)
        return trajectory_fail(t, t->text.line, "more spheres than the limit of %" PRIu64, t->options.max_count);
    if (trajectory_reserve(t, i + 1, SIZE_MAX) < 0)
        return -1;
    const int status = store_place(t, i);
    if (status <= 0) {
        s->lost += status == 0;
        return status < 0 ? -1 : 1;
    }
    s->partial += s->tags.is_fractional && is_partial(s);
    const text_span symbol = value_of(s, CIF_ELEMENT), name = value_of(s, CIF_NAME);
    const uint32_t known = text_length(symbol) > 0 ? element_find(symbol, &reading) : 0;
    const uint32_t site = store_residue(t, i, known);
    const uint32_t element = site != 0 ? site
                             : text_length(symbol) > 0
                                 ? known
                                 : molecule_element(t, name, value_of(s, CIF_RESIDUE), NAME_ANYWHERE);
    if (text_u64(value_of(s, CIF_ID), UINT64_MAX, &id)) {
        if (id > UINT32_MAX)
            trajectory_warn(t, DOUBT_WIDE_IDS, t->text.line, TRAJECTORY_WIDE_IDS);
        t->store.id[i] = (uint32_t)id;
        s->numbered++;
    } else { /* those of others stay */
        t->store.id[i] = UINT32_MAX - (uint32_t)i;
    }
    s->has_element |= element != 0;
    s->count++;
    const char *const letters = element_symbol(element);
    text_span type = *letters != '\0' ? (text_span){letters, letters + strlen(letters)} : name;
    type = text_length(type) > 0 ? type : MOLECULE_UNNAMED;
    store_columns(t, i);
    return molecule_store(t, &s->names, i, type, element, 1.0f);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Takes a row of the loop: 1 stored, 2 it is an atom and begins the next model, -1. */
static int take_row(cgt_trajectory *t, text_span first)
{
    mmcif_state *const s = t->state;
    char model[WORD];
    memcpy(model, s->atom.value[CIF_MODEL], WORD);
    if (read_values(t, first) < 0)
        return -1;
    if (s->rows == CIF_ROWS_OPERATIONS)
        return 1;
    if (s->count > 0 && strcmp(model, s->atom.value[CIF_MODEL]) != 0) {
        s->has_pending = 1;
        return 2;
    }
    return store_atom(t);
}

/* Takes a tag outside of loops, and its value. Returns the kind of that token, or -1. A single atom may stand so. */
static int take_single(cgt_trajectory *t, text_span text)
{
    mmcif_state *const s = t->state;
    char tag[CIF_TAG_SIZE], quote[TEXT_QUOTE_SIZE];
    cif_tag_copy(text, tag);
    text_quote(text, quote);
    s->tags.count = s->is_single ? s->tags.count : 0;
    const int role = cif_tags_add(&s->tags, tag), is_taken = role < CIF_OPERATION;
    if (is_taken && !s->is_single)
        memset(&s->atom, 0, sizeof s->atom);
    if (!is_taken || s->tags.count == CIF_MOST_TAGS)
        s->tags.count--;
    s->is_single |= is_taken;
    const int kind = cif_next(t, &s->tokens, &text);
    if (kind != CIF_VALUE)
        return kind < 0 ? -1 : trajectory_fail(t, t->text.line, "the tag %s has no value", quote);
    if (text_is(text, ".") || text_is(text, "?"))
        return kind;
    if (role == CIF_ROLES)
        cif_crystal_take(&s->crystal, tag, text);
    if (is_taken && s->tags.role[s->tags.count - 1] == role)
        copy_word(text, s->atom.value[role]);
    return (role == CIF_OPERATION || role == CIF_CENTRING) && add_operation(t, role, text) < 0 ? -1 : kind;
}

/* Whether a tag goes on with the single atom. */
static int goes_on(int kind, text_span text)
{
    return kind == CIF_TAG && text_length(text) > 11 && strncasecmp(text.begin, "_atom_site", 10) == 0 &&
           (text.begin[10] == '.' || text.begin[10] == '_');
}

/* Takes a token that is no value of a row: 1 go on, 2 the frame is complete, -1. */
static int take_token(cgt_trajectory *t, int kind, text_span text)
{
    mmcif_state *const s = t->state;
    s->rows = CIF_ROWS_OTHER;
    if (s->is_single && !goes_on(kind, text)) {
        s->is_single = 0;
        const int status = cif_tags_rows(t, &s->tags);
        if (status < 0 || (status > 0 && store_atom(t) < 0))
            return -1;
    }
    while (kind == CIF_LOOP) {
        kind = read_tags(t, &text);
        if (kind == CIF_VALUE && s->rows != CIF_ROWS_OTHER) {
            if (s->rows == CIF_ROWS_ATOMS && s->count > 0)
                return trajectory_fail(t, t->text.line, "a second loop of atoms in a block");
            return take_row(t, text);
        }
        s->rows = CIF_ROWS_OTHER;
    }
    if (kind == CIF_TAG)
        kind = take_single(t, text);
    if (kind == CIF_DATA && s->count == 0)
        cif_crystal_clear(&s->crystal);
    return kind < 0 ? -1 : kind == CIF_DATA && s->count > 0 ? 2 : kind == CIF_END ? 3 : 1;
}

/* Reads up to the end of a frame: 1, 0 after the last, -1. */
static int read_tokens(cgt_trajectory *t)
{
    mmcif_state *const s = t->state;
    int state = 1;
    if (s->has_pending) {
        s->has_pending = 0;
        state = store_atom(t);
    }
    while (state == 1) {
        text_span text = {NULL, NULL};
        const int kind = cif_next(t, &s->tokens, &text);
        if (kind < 0)
            return -1;
        state = kind == CIF_VALUE && s->rows != CIF_ROWS_OTHER ? take_row(t, text) : take_token(t, kind, text);
    }
    return state < 0 ? -1 : s->count > 0;
}

static int mmcif_begin(cgt_trajectory *t)
{
    mmcif_state *const s = t->state;
    s->tokens = (cif_tokens){{NULL, NULL}};
    s->rows = s->has_pending = s->is_single = 0;
    memset(&s->atom, 0, sizeof s->atom);
    cif_crystal_clear(&s->crystal);
    return 1;
}

/* Tells what a reader of the picture should know of the crystal. */
static void tell_crystal(cgt_trajectory *t)
{
    const mmcif_state *const s = t->state;
    if (s->partial > 0)
        trajectory_warn(t, DOUBT_DISORDER, 0,
                        "%" PRIu32 " of %" PRIu32 " listed atoms are there in part, by occupancy or as a group of "
                        "disorder: all are read",
                        s->partial, s->count);
}

enum { MOST_LISTED = 2000 }; /* atoms that are compared with each other's images */

/* Takes the symmetry that is named, but not listed, from tables, and tells what is done. */
static void take_group(cgt_trajectory *t, const double edge[3][3])
{
    mmcif_state *const s = t->state;
    const char *what;
    if (cif_crystal_is_listed(&s->crystal, &what))
        return;
    int is_taken = s->count <= MOST_LISTED && cif_crystal_apply_group(&s->crystal, edge);
    if (is_taken && cif_crystal_lists_images(t, &s->crystal, edge, s->count)) {
        s->crystal.operations = 0;
        is_taken = 0;
    }
    if (is_taken)
        trajectory_warn(t, DOUBT_SYMMETRY, 0,
                        "the space group is '%s', whose operations are not listed: they are those of the tables", what);
    else
        trajectory_warn(t, DOUBT_SYMMETRY, 0,
                        "the space group is '%s', but its operations are not listed: only the listed atoms are read",
                        what);
}

/* Makes the atoms of a crystal and its cell. */
static int finish_cell(cgt_trajectory *t, double edge[3][3], int *has_cell)
{
    mmcif_state *const s = t->state;
    const double *const length = s->crystal.length;
    const int is_unit = length[0] == 1.0 && length[1] == 1.0 && length[2] == 1.0; /* stands for none */
    *has_cell = cif_crystal_cell(&s->crystal, edge) && (s->tags.is_fractional || !is_unit);
    if (s->lost > 0)
        trajectory_warn(t, DOUBT_LOST, 0, "%" PRIu32 " atoms without coordinates are left out", s->lost);
    if (!s->tags.is_fractional && s->crystal.has_cell && !*has_cell && !is_unit)
        trajectory_warn(t, DOUBT_CELL, 0, "the edges and angles of the cell are those of none: it is left out");
    if (!s->tags.is_fractional)
        return 1;
    const char *const reason = cif_crystal_center(&s->crystal);
    if (reason != NULL)
        return trajectory_fail(t, t->text.line, "%s", reason);
    if (*has_cell)
        take_group(t, (const double(*)[3])edge);
    tell_crystal(t);
    return cif_crystal_fill(t, &s->crystal, s->slot, CIF_COLUMNS, &s->count);
}

static int mmcif_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    static const double origin[3] = {0, 0, 0};
    mmcif_state *const s = t->state;
    double edge[3][3];
    int has_cell;
    s->count = s->partial = s->lost = 0;
    s->has_element = 0;
    if (!s->has_pending)
        cif_crystal_clear(&s->crystal);
    s->numbered = 0;
    for (int i = 0; i < CIF_COLUMNS; i++) {
        s->slot[i] = columns_add_named(t, columns[i].name, columns[i].kind);
        if (s->slot[i] < 0)
            return -1;
    }
    if (trajectory_reserve(t, 0, SIZE_MAX) < 0)
        return -1;
    const int status = read_tokens(t);
    if (status <= 0)
        return status < 0 || t->next > 0 || t->text.line == 0
                   ? status
                   : trajectory_fail(t, t->text.line, "no _atom_site with the coordinates of atoms");
    molecule_tell_guesses(t);
    if (finish_cell(t, edge, &has_cell) < 0)
        return -1;
    trajectory_frame_fill(t, frame, s->count);
    if (s->numbered > 0 && s->numbered < s->count && !s->tags.is_fractional)
        trajectory_warn(t, DOUBT_NO_IDS, 0, "%" PRIu32 " of %" PRIu32 " atoms have no number: they get some below 2^32",
                        s->count - s->numbered, s->count);
    frame->id = s->numbered > 0 && !s->tags.is_fractional ? t->store.id : NULL;
    frame->type = t->store.type;
    frame->element = s->has_element ? t->store.element : NULL;
    if (has_cell) {
        trajectory_frame_set_box(frame, origin, (const double(*)[3])edge);
        memset(frame->periodic, 1, sizeof frame->periodic);
    }
    return 1;
}

static void mmcif_end(cgt_trajectory *t)
{
    mmcif_state *const s = t->state;
    free(s->crystal.place);
}

const trajectory_format trajectory_format_mmcif = {
    .is_series = 1,
    .state_size = sizeof(mmcif_state),
    .begin = mmcif_begin,
    .end = mmcif_end,
    .read = mmcif_read, /* no skip: names are numbered in order of appearance, so that a skipped frame must be read */
};
