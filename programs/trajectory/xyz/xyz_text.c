/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * .xyz: a count, a comment, then the rows. Plain rows are a name or a type and x y z; further columns have no agreed
 * meaning and are ignored. Extended files describe the columns in the comment (Properties=) and may give the box
 * (Lattice=, Origin=). A name that is a whole number is a type;
 * atomic numbers are known by their property, Z or numbers. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/xyz/xyz_comment.h"
#include "trajectory/atoms/trajectory_elements.h"
#include "trajectory/text/text_rows.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

typedef struct xyz_state {
    row_plan plan;
    name_table names;
    uint32_t count;
    int64_t step;
    int has_step;
    int is_plain; /* the last frame has no Properties= */
    int has_box;
    double origin[3];
    double edge[3][3];
    int8_t periodic[3];
    double time;
} xyz_state;

/* ---- The comment -------------------------------------------------------------------------------------------- */

/* Tells of a value that cannot be read, unless it is blank. Returns 0: no box. */
static int refuse_box(cgt_trajectory *t, const char *key, text_span value, const char *expected)
{
    char quote[TEXT_QUOTE_SIZE];
    if (!text_is_blank(value))
        trajectory_warn(t, DOUBT_LATTICE, t->text.line, "%s'%s' is not %s: the frame has no box", key,
                        text_quote(value, quote), expected);
    return 0;
}

/* Parses the box from Lattice=, nine numbers or the three of a box at right angles, and Origin=. The comment is free
 * text: anything unreadable is no box, and no error. */
static void read_lattice(cgt_trajectory *t, text_span comment)
{
    xyz_state *const s = t->state;
    text_span text;
    double length[3];
    memset(s->origin, 0, sizeof s->origin);
    s->has_box = comment_find(comment, "Lattice", &text);
    if (s->has_box && comment_numbers(text, 3, length)) {
        memset(s->edge, 0, sizeof s->edge);
        for (int i = 0; i < 3; i++)
            s->edge[i][i] = length[i];
    } else if (s->has_box && !comment_numbers(text, 9, &s->edge[0][0])) {
        s->has_box = refuse_box(t, "Lattice=", text, "nine numbers, or three");
    }
    if (s->has_box && comment_find(comment, "Origin", &text) && !comment_numbers(text, 3, s->origin))
        s->has_box = refuse_box(t, "Origin=", text, "three numbers");
}

/* Parses pbc="T T F" or pbc=[T, T, F]: which edges are periodic. A single value is that of all. */
static void read_periodic(xyz_state *s, text_span comment)
{
    text_span text, word;
    int count = 0;
    memset(s->periodic, -1, sizeof s->periodic);
    if (!comment_find(comment, "pbc", &text))
        return;
    for (; count < 3 && comment_word(&text, &word); count++)
        s->periodic[count] = strchr("Tt1", *word.begin) != NULL ? 1 : strchr("Ff0", *word.begin) != NULL ? 0 : -1;
    if (count == 1)
        s->periodic[1] = s->periodic[2] = s->periodic[0];
}

/* Finds the word after `key`, "Timestep:", which stands alone. */
static int find_after(text_span comment, const char *key, text_span *word)
{
    text_span value;
    while (comment_next(&comment, word, &value))
        if (text_is(*word, key))
            return comment_next(&comment, word, &value);
    return 0;
}

/* Parses the time from Time=0.5, or "Time: 0.5" of LAMMPS. */
static void read_time(xyz_state *s, text_span comment)
{
    text_span text;
    if (!(comment_find(comment, "Time", &text) || find_after(comment, "Time:", &text)) ||
        !comment_numbers(text, 1, &s->time))
        s->time = NAN;
}

/* The whole number at the front of a value, which a comma may end: 1 or 0. */
static int take_step(text_span value, int64_t *step)
{
    text_span word;
    char copy[32] = "";
    if (!comment_word(&value, &word) || text_length(word) >= sizeof copy)
        return 0;
    memcpy(copy, word.begin, text_length(word));
    return text_i64((text_span){copy, copy + text_length(word)}, step);
}

/* Parses the step from "Timestep: 100", as LAMMPS writes it, Timestep=100, Step=100, or " i = 100, time = 50.000" of
 * CP2K, whose key is too short to be looked for anywhere else. */
static void read_step(xyz_state *s, text_span comment)
{
    static const char *const keys[][2] = {{"Timestep", "Timestep:"}, {"Step", "Step:"}};
    text_span value, key, rest = comment;
    s->has_step = 0;
    for (int i = 0; i < 2 && !s->has_step; i++)
        s->has_step = (comment_find(comment, keys[i][0], &value) || find_after(comment, keys[i][1], &value)) &&
                      take_step(value, &s->step);
    if (!s->has_step)
        s->has_step = comment_next(&rest, &key, &value) && text_is(key, "i") && take_step(value, &s->step);
}

/* ---- Columns ------------------------------------------------------------------------------------------------ */

typedef struct xyz_property {
    const char *name;
    uint32_t columns;
    row_role role; /* of the first column; the others have the next roles */
} xyz_property;

static const xyz_property properties[] = {
    {"species", 1, ROW_NAME},
    {"element", 1, ROW_NAME},
    {"pos", 3, ROW_X},
    {"radius", 1, ROW_RADIUS},
    {"diameter", 1, ROW_DIAMETER},
    {"velo", 3, ROW_VX},
    {"vel", 3, ROW_VX},
    {"velocity", 3, ROW_VX},
    {"velocities", 3, ROW_VX},
    {"id", 1, ROW_ID},
    {"type", 1, ROW_TYPE},
    {"Z", 1, ROW_NUMBER},
    {"numbers", 1, ROW_NUMBER},
    {"atomic_number", 1, ROW_NUMBER},
    {"atomic_numbers", 1, ROW_NUMBER},
};

/* The role of a property. kind: S text, R number, I whole number, L true or false. */
static row_role property_role(text_span name, text_span kind, uint64_t columns)
{
    for (size_t i = 0; i < sizeof properties / sizeof properties[0]; i++) {
        const xyz_property *const p = &properties[i];
        if (!text_is(name, p->name) || p->columns != columns)
            continue;
        if (p->role == ROW_TYPE && text_is(kind, "S"))
            return ROW_NAME;
        const char *expected = p->role == ROW_NAME ? "S" : p->role >= ROW_ID ? "I" : "R";
        if (text_is(kind, expected) || ((*expected == 'R' || *expected == 'S') && text_is(kind, "I")))
            return p->role;
    }
    return ROW_UNUSED;
}

/* Removes the part up to the next colon from the front of list. */
static int take_part(text_span *list, text_span *part)
{
    if (list->begin >= list->end)
        return 0;
    const char *colon = memchr(list->begin, ':', text_length(*list));
    part->begin = list->begin;
    part->end = colon != NULL ? colon : list->end;
    list->begin = colon != NULL ? colon + 1 : list->end;
    return part->begin < part->end;
}

static int plan_property(cgt_trajectory *t, row_role role, text_span name, text_span kind, uint64_t columns)
{
    xyz_state *const s = t->state;
    const cgt_trajectory_column_kind values = text_is(kind, "S")   ? CGT_TRAJECTORY_WORD
                                              : text_is(kind, "R") ? CGT_TRAJECTORY_NUMBER
                                                                   : CGT_TRAJECTORY_WHOLE;
    char whole[256], copy[280];
    snprintf(whole, sizeof whole, "%.*s", (int)(text_length(name) < 255 ? text_length(name) : 255), name.begin);
    for (uint64_t i = 0; i < columns; i++) {
        columns_part_name(whole, columns, i, copy, sizeof copy);
        const text_span part = {copy, copy + strlen(copy)};
        const row_role part_role = role != ROW_UNUSED ? (row_role)((int)role + (int)i) : ROW_UNUSED;
        if (row_plan_add(t, &s->plan, part_role, part, values) < 0)
            return -1;
    }
    return 1;
}

static int plan_properties(cgt_trajectory *t, text_span list)
{
    xyz_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    text_trim(&list);
    while (list.begin < list.end) {
        text_span name, kind, number = {NULL, NULL};
        uint64_t columns = 0;
        if (!take_part(&list, &name) || !take_part(&list, &kind) || !take_part(&list, &number) ||
            !text_u64(number, ROW_MOST_COLUMNS, &columns) || columns == 0)
            return trajectory_fail(t, t->text.line, "Properties= is not a list of name:kind:columns");
        const row_role role = property_role(name, kind, columns);
        if (plan_property(t, role, name, kind, columns) < 0)
            return -1;
        if (text_is(name, "pos") && role != ROW_X)
            return trajectory_fail(t, t->text.line, "Properties=: '%s' must be pos:R:3", text_quote(name, quote));
    }
    if ((s->plan.roles & ROW_POSITION) != ROW_POSITION)
        return trajectory_fail(t, t->text.line, "Properties= has no pos:R:3: the spheres have no place");
    return 1;
}

static int plan_plain(cgt_trajectory *t)
{
    static const row_role plain[] = {ROW_NAME, ROW_X, ROW_Y, ROW_Z};
    static const char *const names[] = {"name", "x", "y", "z"};
    xyz_state *const s = t->state;
    for (size_t i = 0; i < sizeof plain / sizeof plain[0]; i++) {
        const text_span name = {names[i], names[i] + strlen(names[i])};
        if (row_plan_add(t, &s->plan, plain[i], name, i == 0 ? CGT_TRAJECTORY_WORD : CGT_TRAJECTORY_NUMBER) < 0)
            return -1;
    }
    s->plan.open_ended = 1;
    s->is_plain = 1;
    return 1;
}

/* ---- The format --------------------------------------------------------------------------------------------- */

/* Whether the line begins with a number that is no whole one. After the rows of a plain frame that is the list of
 * frequencies in files of the QM9 set; SMILES and InChI follow on lines of their own. */
static int begins_tail(text_span line)
{
    text_span word;
    double number;
    uint64_t whole;
    return text_word(&line, &word) && !text_u64(word, UINT64_MAX, &whole) && text_double(word, &number);
}

/* The next line with a word on it, which a frame begins with: 1, 0, -1. */
static int next_head_line(cgt_trajectory *t, text_span *line)
{
    const xyz_state *const s = t->state;
    int in_tail = 0;
    while (1) {
        const int status = trajectory_line(t, line);
        if (status <= 0)
            return status;
        text_span rest = *line, word;
        uint64_t count;
        if (!text_word(&rest, &word))
            continue; /* blank lines between frames */
        if (!in_tail && !(s->is_plain && begins_tail(*line)))
            return 1;
        if (in_tail && text_u64(word, UINT64_MAX, &count) && text_is_blank(rest))
            return 1;
        if (!in_tail)
            trajectory_warn(
                t, DOUBT_TAIL, t->text.line,
                "lines after the rows are taken for remarks, as in files of the QM9 set, up to the next line "
                "that is a number of spheres");
        in_tail = 1;
    }
}

/* "2 angstroem": one word after the count, which is no number, is no part of it. */
static int check_count_line(cgt_trajectory *t, text_span rest)
{
    char quote[TEXT_QUOTE_SIZE];
    text_span word;
    if (!text_word(&rest, &word))
        return 1;
    const int is_letter = (*word.begin >= 'a' && *word.begin <= 'z') || (*word.begin >= 'A' && *word.begin <= 'Z');
    if (!is_letter || !text_is_blank(rest))
        return trajectory_fail(t, t->text.line, "the number of spheres must stand alone on its line");
    trajectory_warn(t, DOUBT_COUNT_WORDS, t->text.line,
                    "'%s' after the number of spheres is taken for a remark: coordinates stay as they are",
                    text_quote(word, quote));
    return 1;
}

/* Reads count and comment: 1, 0 at the end of the file, -1. */
static int read_head(cgt_trajectory *t)
{
    xyz_state *const s = t->state;
    text_span line, word, list;
    const int status = next_head_line(t, &line);
    if (status <= 0)
        return status;
    text_word(&line, &word);
    if (check_count_line(t, line) < 0)
        return -1;
    if (trajectory_parse_count(t, word, &s->count) < 0 || trajectory_line_inside(t, &line, "before the comment") < 0)
        return -1;
    read_lattice(t, line);
    read_periodic(s, line);
    read_time(s, line);
    read_step(s, line);
    row_plan_clear(&s->plan);
    s->plan.names = &s->names;
    s->plan.names_may_be_types = 1;
    s->is_plain = 0;
    return comment_find(line, "Properties", &list) ? plan_properties(t, list) : plan_plain(t);
}

/* The type and the radius that a name stands for; *radius stays where the name is a number. */
static int read_name(cgt_trajectory *t, text_span name, row *r, uint32_t *type, float *radius)
{
    xyz_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    double number;
    uint64_t whole;
    if (text_u64(name, UINT32_MAX, &whole)) {
        *type = (uint32_t)whole;
        return 1;
    }
    /* "1HB" is a name, "1.5" and "4294967296" are numbers that are no type */
    const char first = *name.begin;
    if (first == '-' || first == '+' || first == '.' || (first >= '0' && first <= '9' && text_double(name, &number)))
        return trajectory_fail(t, t->text.line, "'%s' is not the name of an element, or a type",
                               text_quote(name, quote));
    return row_name(t, &s->names, name, r, type, radius);
}

static int finish_row(cgt_trajectory *t, row *r)
{
    xyz_state *const s = t->state;
    const unsigned roles = s->plan.roles;
    float radius = DEFAULT_RADIUS;
    uint64_t whole; /* a name that is a type tells no element, which the atomic number does */
    if (roles & ROW_BIT(ROW_NAME)) {
        uint32_t type = 0;
        if (read_name(t, r->name, r, &type, &radius) < 0)
            return -1;
        if (!(roles & ROW_BIT(ROW_TYPE)))
            r->type = type;
    }
    if (roles & ROW_BIT(ROW_NUMBER) && (!(roles & ROW_BIT(ROW_NAME)) || text_u64(r->name, UINT32_MAX, &whole))) {
        uint32_t type = 0;
        if (row_atomic_number(t, &s->names, r, &type, &radius) < 0)
            return -1;
        if (!(roles & (ROW_BIT(ROW_TYPE) | ROW_BIT(ROW_NAME))))
            r->type = type;
    }
    if (!(roles & (ROW_BIT(ROW_RADIUS) | ROW_BIT(ROW_DIAMETER))))
        r->value[ROW_RADIUS] = t->options.radius > 0.0f ? t->options.radius : radius;
    return 1;
}

static int xyz_begin(cgt_trajectory *t)
{
    xyz_state *const s = t->state;
    s->is_plain = 0;
    return 1;
}

static int xyz_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    xyz_state *const s = t->state;
    const int status = read_head(t);
    if (status <= 0)
        return status;
    trajectory_frame_fill(t, frame, s->count);
    if (s->has_step)
        frame->step = s->step;
    frame->time = s->time;
    memcpy(frame->periodic, s->periodic, sizeof frame->periodic);
    if (s->has_box)
        trajectory_frame_set_box(frame, s->origin, s->edge);
    return rows_read(t, &s->plan, s->count, finish_row, frame);
}

const trajectory_format trajectory_format_xyz = {
    .is_series = 1,
    .is_followed = 1,
    .gives_arrays = 1,
    .state_size = sizeof(xyz_state),
    .begin = xyz_begin,
    .read = xyz_read, /* no skip: names are numbered in order of appearance, so that a skipped frame must be read */
};
