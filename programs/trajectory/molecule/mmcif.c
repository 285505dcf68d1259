/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * mmCIF (PDBx): the loop _atom_site, a frame for each model, and the cell. All atoms are read, alternate locations
 * too. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/molecule/cif_tokens.h"
#include "trajectory/molecule/molecule_atom.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <strings.h>

#define MOST_TAGS 256u
#define WORD 32u /* bytes of a name, its zero included */

/* Values of an atom that are used; the wanted columns are the first ones. */
typedef enum cif_role {
    CIF_NAME,
    CIF_RESIDUE,
    CIF_CHAIN,
    CIF_SEQUENCE,
    CIF_OCCUPANCY,
    CIF_B,
    CIF_COLUMNS,
    CIF_X = CIF_COLUMNS,
    CIF_Y,
    CIF_Z,
    CIF_ELEMENT,
    CIF_ID,
    CIF_MODEL,
    CIF_ROLES
} cif_role;

/* Tags by role; label_ is used where a file has no auth_. */
static const struct {
    const char *tag;
    cif_role role;
} tags[] = {
    {"auth_atom_id", CIF_NAME},
    {"label_atom_id", CIF_NAME},
    {"auth_comp_id", CIF_RESIDUE},
    {"label_comp_id", CIF_RESIDUE},
    {"auth_asym_id", CIF_CHAIN},
    {"label_asym_id", CIF_CHAIN},
    {"auth_seq_id", CIF_SEQUENCE},
    {"label_seq_id", CIF_SEQUENCE},
    {"occupancy", CIF_OCCUPANCY},
    {"B_iso_or_equiv", CIF_B},
    {"Cartn_x", CIF_X},
    {"Cartn_y", CIF_Y},
    {"Cartn_z", CIF_Z},
    {"type_symbol", CIF_ELEMENT},
    {"id", CIF_ID},
    {"pdbx_PDB_model_num", CIF_MODEL},
};

static const struct {
    const char *name;
    trajectory_column_kind kind;
} columns[CIF_COLUMNS] = {{"name", TRAJECTORY_WORD},        {"resname", TRAJECTORY_WORD},
                          {"chain", TRAJECTORY_WORD},       {"resid", TRAJECTORY_WHOLE},
                          {"occupancy", TRAJECTORY_NUMBER}, {"b_factor", TRAJECTORY_NUMBER}};

typedef struct cif_atom {
    char value[CIF_ROLES][WORD]; /* "" for those without */
} cif_atom;

typedef struct mmcif_state {
    cif_tokens tokens;
    name_table names;
    int in_loop;         /* of atoms */
    int is_single;       /* tags of an atom outside of loops were read */
    uint32_t tags;       /* of the loop */
    int role[MOST_TAGS]; /* CIF_ROLES: unused */
    cif_atom atom;       /* the last one read */
    int has_pending;     /* it begins the next frame */
    uint32_t count;
    int has_element, has_id;
    double length[3], angle[3];
    int slot[CIF_COLUMNS];
} mmcif_state;

/* ---- The cell ----------------------------------------------------------------------------------------------- */

static double *find_cell_number(mmcif_state *s, const char *tag)
{
    static const char *const names[6] = {"_cell.length_a",    "_cell.length_b",   "_cell.length_c",
                                         "_cell.angle_alpha", "_cell.angle_beta", "_cell.angle_gamma"};
    for (int i = 0; i < 6; i++)
        if (strcasecmp(tag, names[i]) == 0)
            return i < 3 ? &s->length[i] : &s->angle[i - 3];
    return NULL;
}

/* A number may have its error behind it: 10.5(2). */
static int read_number(text_span text, double *value)
{
    const char *const bracket = memchr(text.begin, '(', text_length(text));
    text.end = bracket != NULL ? bracket : text.end;
    return field_double(text, value);
}

/* ---- Loops -------------------------------------------------------------------------------------------------- */

static void copy_word(text_span text, char word[WORD])
{
    const size_t length = text_length(text) < WORD - 1 ? text_length(text) : WORD - 1;
    memcpy(word, text.begin, length);
    word[length] = '\0';
}

/* Plans a column of the loop. An auth_ tag comes before the label_ tag of the same role. */
static void plan_tag(mmcif_state *s, const char *name)
{
    int role = CIF_ROLES;
    for (size_t i = 0; i < sizeof tags / sizeof tags[0]; i++) {
        if (strcasecmp(name, tags[i].tag) != 0)
            continue;
        role = tags[i].role;
        const int is_label = strncasecmp(name, "label_", 6) == 0;
        for (uint32_t k = 0; k < s->tags; k++) {
            if (s->role[k] == role && is_label) {
                role = CIF_ROLES; /* the auth_ one was before */
                break;
            }
            s->role[k] = s->role[k] == role ? CIF_ROLES : s->role[k];
        }
    }
    s->role[s->tags++] = role;
}

static const char category[] = "_atom_site.";

/* Plans a tag of atoms: 1, 0 another tag, -1. */
static int take_tag(trajectory *t, text_span text)
{
    mmcif_state *const s = t->state;
    const size_t length = sizeof category - 1;
    if (text_length(text) <= length || strncasecmp(text.begin, category, length) != 0)
        return 0;
    if (s->tags == MOST_TAGS)
        return trajectory_fail(t, t->text.line, "more than 256 tags in a loop");
    char name[WORD];
    copy_word((text_span){text.begin + length, text.end}, name);
    plan_tag(s, name);
    return 1;
}

static int check_tags(trajectory *t)
{
    const mmcif_state *const s = t->state;
    unsigned found = 0;
    for (uint32_t i = 0; i < s->tags; i++)
        found |= 1u << s->role[i];
    return (found >> CIF_X & 7u) == 7u
               ? 1
               : trajectory_fail(t, t->text.line,
                                 "_atom_site has no Cartn_x, Cartn_y, Cartn_z: the atoms have no place");
}

/* Reads the tags of a loop. Returns the kind of the token after them (its text in *text), or -1. */
static int read_tags(trajectory *t, text_span *text)
{
    mmcif_state *const s = t->state;
    int kind;
    s->tags = 0;
    s->in_loop = 0;
    while ((kind = cif_next(t, &s->tokens, text)) == CIF_TAG) {
        if (text_begins(*text, "_atom_site_fract_x"))
            return trajectory_fail(t, t->text.line,
                                   "coordinates are fractions of the cell: a CIF of small molecules, not mmCIF");
        const int is_taken = take_tag(t, *text);
        if (is_taken < 0)
            return -1;
        s->in_loop |= is_taken;
    }
    return kind > 0 && s->in_loop && check_tags(t) < 0 ? -1 : kind;
}

/* ---- Atoms -------------------------------------------------------------------------------------------------- */

/* Reads the values of an atom, the first of which is there. Returns 1 or -1. */
static int read_values(trajectory *t, text_span first)
{
    mmcif_state *const s = t->state;
    memset(&s->atom, 0, sizeof s->atom);
    for (uint32_t i = 0; i < s->tags; i++) {
        text_span text = first;
        if (i > 0) {
            const int kind = cif_next(t, &s->tokens, &text);
            if (kind < 0)
                return -1;
            if (kind != CIF_VALUE)
                return trajectory_fail(t, t->text.line, "%" PRIu32 " of %" PRIu32 " values of an atom%s", i, s->tags,
                                       kind == CIF_END ? ": the file is cut off" : "");
        }
        const int is_missing = text_is(text, ".") || text_is(text, "?");
        if (s->role[i] < CIF_ROLES && !is_missing)
            copy_word(text, s->atom.value[s->role[i]]);
    }
    return 1;
}

static text_span value_of(const mmcif_state *s, cif_role role)
{
    const char *const value = s->atom.value[role];
    return (text_span){value, value + strlen(value)};
}

static int store_columns(trajectory *t, size_t i)
{
    const mmcif_state *const s = t->state;
    for (int k = 0; k < CIF_COLUMNS; k++) {
        if (s->slot[k] == 0)
            continue;
        const text_span text = value_of(s, (cif_role)k);
        float *const value = columns_values(t, s->slot[k]) + i;
        const char *reason = "";
        double number = NAN;
        if (columns[k].kind != TRAJECTORY_WORD) {
            read_number(text, &number);
            *value = (float)number;
            continue;
        }
        *value = (float)(text.begin < text.end ? columns_word(t, s->slot[k], text, &reason) : 0);
        if (*reason != '\0')
            return trajectory_fail(t, t->text.line, "%s", reason);
    }
    return 1;
}

static int store_atom(trajectory *t)
{
    mmcif_state *const s = t->state;
    const size_t i = s->count;
    element_reading reading;
    char quote[TEXT_QUOTE_SIZE];
    uint64_t id;
    if (s->count >= t->options.max_count)
        return trajectory_fail(t, t->text.line, "more spheres than the limit of %" PRIu64, t->options.max_count);
    if (trajectory_reserve(t, i + 1, SIZE_MAX) < 0)
        return -1;
    for (int k = 0; k < 3; k++) {
        text_span text = value_of(s, (cif_role)(CIF_X + k));
        const char *const bracket = memchr(text.begin, '(', text_length(text));
        text.end = bracket != NULL ? bracket : text.end;
        if (!field_float(text, &t->store.xyzr[4 * i + (size_t)k]))
            return trajectory_fail(t, t->text.line, "'%s' is not a coordinate", text_quote(text, quote));
    }
    const text_span symbol = value_of(s, CIF_ELEMENT), name = value_of(s, CIF_NAME);
    const uint32_t element = text_length(symbol) > 0
                                 ? element_find(symbol, &reading)
                                 : molecule_element(t, name, value_of(s, CIF_RESIDUE), NAME_ANYWHERE);
    const int has_id = text_u64(value_of(s, CIF_ID), UINT64_MAX, &id);
    t->store.id[i] = has_id ? (uint32_t)id : (uint32_t)i;
    s->has_id &= has_id;
    s->has_element |= element != 0;
    s->count++;
    const char *const known = element_symbol(element);
    text_span type = element != 0 ? (text_span){known, known + strlen(known)} : name;
    type = text_length(type) > 0 ? type : MOLECULE_UNNAMED;
    return molecule_store(t, &s->names, i, type, element, 1.0f) < 0 ? -1 : store_columns(t, i);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Takes an atom of the loop: 1 stored, 2 it begins the next model, -1. */
static int take_atom(trajectory *t, text_span first)
{
    mmcif_state *const s = t->state;
    char model[WORD];
    memcpy(model, s->atom.value[CIF_MODEL], WORD);
    if (read_values(t, first) < 0)
        return -1;
    if (s->count > 0 && strcmp(model, s->atom.value[CIF_MODEL]) != 0) {
        s->has_pending = 1;
        return 2;
    }
    return store_atom(t);
}

/* Takes a tag outside of loops, and its value. Returns the kind of that token, or -1. A single atom may stand so. */
static int take_single(trajectory *t, text_span text)
{
    mmcif_state *const s = t->state;
    char tag[WORD];
    copy_word(text, tag);
    double *const number = find_cell_number(s, tag);
    if (!s->is_single)
        s->tags = 0;
    const int is_taken = take_tag(t, text);
    if (is_taken > 0 && !s->is_single)
        memset(&s->atom, 0, sizeof s->atom);
    s->is_single |= is_taken > 0;
    const int kind = is_taken < 0 ? -1 : cif_next(t, &s->tokens, &text);
    if (kind == CIF_VALUE && number != NULL && !read_number(text, number))
        *number = NAN;
    const int is_missing = text_is(text, ".") || text_is(text, "?");
    if (kind == CIF_VALUE && is_taken && s->role[s->tags - 1] < CIF_ROLES && !is_missing)
        copy_word(text, s->atom.value[s->role[s->tags - 1]]);
    return kind != CIF_VALUE && kind > 0 ? trajectory_fail(t, t->text.line, "the tag %s has no value", tag) : kind;
}

/* Takes a token that is no value of an atom: 1 go on, 2 the frame is complete, -1. */
static int take_token(trajectory *t, int kind, text_span text)
{
    mmcif_state *const s = t->state;
    s->in_loop = 0;
    if (s->is_single && !(kind == CIF_TAG && text_length(text) > 11 && strncasecmp(text.begin, category, 11) == 0)) {
        s->is_single = 0;
        if (check_tags(t) < 0 || store_atom(t) < 0)
            return -1;
    }
    while (kind == CIF_LOOP) {
        kind = read_tags(t, &text);
        if (kind == CIF_VALUE && s->in_loop) {
            if (s->count > 0)
                return trajectory_fail(t, t->text.line, "a second loop of atoms in a block");
            return take_atom(t, text);
        }
        s->in_loop = 0;
    }
    if (kind == CIF_TAG)
        kind = take_single(t, text);
    return kind < 0 ? -1 : kind == CIF_DATA && s->count > 0 ? 2 : kind == CIF_END ? 3 : 1;
}

/* Reads up to the end of a frame: 1, 0 after the last, -1. */
static int read_tokens(trajectory *t)
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
        state = kind == CIF_VALUE && s->in_loop ? take_atom(t, text) : take_token(t, kind, text);
    }
    return state < 0 ? -1 : s->count > 0;
}

static int mmcif_begin(trajectory *t)
{
    mmcif_state *const s = t->state;
    s->tokens = (cif_tokens){{NULL, NULL}};
    s->in_loop = s->has_pending = s->is_single = 0;
    memset(&s->atom, 0, sizeof s->atom);
    memset(s->length, 0, sizeof s->length);
    memset(s->angle, 0, sizeof s->angle);
    return 1;
}

static int mmcif_read(trajectory *t, trajectory_frame *frame)
{
    static const double origin[3] = {0, 0, 0};
    mmcif_state *const s = t->state;
    double edge[3][3];
    s->count = 0;
    s->has_element = 0;
    s->has_id = 1;
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
    trajectory_frame_fill(t, frame, s->count);
    frame->id = s->has_id ? t->store.id : NULL;
    frame->type = t->store.type;
    frame->element = s->has_element ? t->store.element : NULL;
    const int is_unit = s->length[0] == 1.0 && s->length[1] == 1.0 && s->length[2] == 1.0; /* stands for none */
    if (!is_unit && molecule_cell(s->length, s->angle, edge)) {
        trajectory_frame_set_box(frame, origin, (const double(*)[3])edge);
        memset(frame->periodic, 1, sizeof frame->periodic);
    }
    return 1;
}

const trajectory_format trajectory_format_mmcif = {
    .is_series = 1,
    .state_size = sizeof(mmcif_state),
    .begin = mmcif_begin,
    .read = mmcif_read, /* no skip: names are numbered in order of appearance, so that a skipped frame must be read */
};
