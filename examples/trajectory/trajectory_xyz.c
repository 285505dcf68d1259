/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * .xyz: a count, a comment, then the rows. Plain rows are a name or a type and x y z; further columns have no agreed
 * meaning and are ignored. Extended files describe the columns in the comment (Properties=) and may give the box
 * (Lattice=, Origin=). A name that is a whole number is a type. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_elements.h"
#include "trajectory/trajectory_row.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

typedef struct xyz_state {
    row_plan plan;
    name_table names; /* kept when rewinding, so that types stay the same */
    uint32_t count;
    int64_t step;
    int has_step;
    int has_box;
    float box_min[3];
    float box_max[3];
} xyz_state;

/* ---- The comment -------------------------------------------------------------------------------------------- */

/* Finds key=value, the value in quotes or up to a blank. Returns 1 or 0. */
static int find_value(text_span comment, const char *key, text_span *value)
{
    const size_t length = strlen(key);
    for (const char *p = comment.begin; p + length < comment.end; p++) {
        const int starts = p == comment.begin || p[-1] == ' ' || p[-1] == '\t';
        if (!starts || memcmp(p, key, length) != 0 || p[length] != '=') {
            continue;
        }
        const char *begin = p + length + 1;
        const char *end;
        if (begin < comment.end && *begin == '"') {
            begin++;
            end = memchr(begin, '"', (size_t)(comment.end - begin));
            end = end == NULL ? comment.end : end;
        } else {
            for (end = begin; end < comment.end && *end != ' ' && *end != '\t'; end++) {
            }
        }
        value->begin = begin;
        value->end = end;
        return 1;
    }
    return 0;
}

/* Reads `count` finite numbers. Words are copied, since a quote may follow the number. */
static int parse_vector(text_span text, int count, double *values)
{
    for (int i = 0; i < count; i++) {
        text_span word;
        char copy[64];
        if (!text_word(&text, &word) || text_length(word) >= sizeof copy) {
            return 0;
        }
        memcpy(copy, word.begin, text_length(word));
        copy[text_length(word)] = '\0';
        const text_span number = {copy, copy + text_length(word)};
        if (!text_double(number, &values[i]) || !isfinite(values[i])) {
            return 0;
        }
    }
    return text_is_blank(text);
}

/* Parses the box from Lattice= and Origin=. The comment is free text: anything unreadable is no box. */
static void read_lattice(xyz_state *s, text_span comment)
{
    text_span text;
    double edge[9], origin[3] = {0, 0, 0};
    s->has_box = find_value(comment, "Lattice", &text) && parse_vector(text, 9, edge) &&
                 (!find_value(comment, "Origin", &text) || parse_vector(text, 3, origin));
    for (int axis = 0; axis < 3 && s->has_box; axis++) {
        double low = origin[axis], high = origin[axis];
        for (int i = 0; i < 3; i++) {
            low += fmin(0.0, edge[3 * i + axis]);
            high += fmax(0.0, edge[3 * i + axis]);
        }
        s->box_min[axis] = (float)low;
        s->box_max[axis] = (float)high;
        s->has_box = isfinite(s->box_min[axis]) && isfinite(s->box_max[axis]);
    }
}

/* Parses the step from "Timestep: 100", as LAMMPS writes it, or Timestep=100. */
static void read_step(xyz_state *s, text_span comment)
{
    static const char key[] = "Timestep";
    s->has_step = 0;
    text_span value, word;
    if (find_value(comment, key, &value)) {
        s->has_step = text_i64(value, &s->step);
        return;
    }
    while (text_word(&comment, &word)) {
        if (text_is(word, "Timestep:")) {
            s->has_step = text_word(&comment, &word) && text_i64(word, &s->step);
            return;
        }
    }
}

/* ---- Columns ------------------------------------------------------------------------------------------------ */

typedef struct xyz_property {
    const char *name;
    uint32_t columns;
    row_role role; /* of the first column; the others have the next roles */
} xyz_property;

static const xyz_property properties[] = {
    {"species", 1, ROW_NAME},      {"element", 1, ROW_NAME}, {"pos", 3, ROW_X},     {"radius", 1, ROW_RADIUS},
    {"diameter", 1, ROW_DIAMETER}, {"velo", 3, ROW_VX},      {"vel", 3, ROW_VX},    {"velocity", 3, ROW_VX},
    {"velocities", 3, ROW_VX},     {"id", 1, ROW_ID},        {"type", 1, ROW_TYPE},
};

/* The role of a property. kind: S text, R number, I whole number, L true or false. */
static row_role property_role(text_span name, text_span kind, uint64_t columns)
{
    for (size_t i = 0; i < sizeof properties / sizeof properties[0]; i++) {
        const xyz_property *const p = &properties[i];
        if (!text_is(name, p->name) || p->columns != columns) {
            continue;
        }
        if (p->role == ROW_TYPE && text_is(kind, "S")) {
            return ROW_NAME;
        }
        const char *expected = p->role == ROW_NAME ? "S" : p->role == ROW_ID || p->role == ROW_TYPE ? "I" : "R";
        if (text_is(kind, expected) || (*expected == 'R' && text_is(kind, "I"))) {
            return p->role;
        }
    }
    return ROW_UNUSED;
}

/* Removes the part up to the next colon from the front of list. */
static int take_part(text_span *list, text_span *part)
{
    if (list->begin >= list->end) {
        return 0;
    }
    const char *colon = memchr(list->begin, ':', text_length(*list));
    part->begin = list->begin;
    part->end = colon != NULL ? colon : list->end;
    list->begin = colon != NULL ? colon + 1 : list->end;
    return part->begin < part->end;
}

static int plan_properties(trajectory *t, text_span list)
{
    xyz_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    while (list.begin < list.end) {
        text_span name, kind, number = {NULL, NULL};
        uint64_t columns = 0;
        if (!take_part(&list, &name) || !take_part(&list, &kind) || !take_part(&list, &number) ||
            !text_u64(number, ROW_MOST_COLUMNS, &columns) || columns == 0) {
            return trajectory_fail(t, t->text.line, "Properties= is not a list of name:kind:columns");
        }
        const row_role role = property_role(name, kind, columns);
        for (uint64_t i = 0; i < columns; i++) {
            const int offset = role != ROW_UNUSED ? (int)i : 0;
            if (row_plan_add(t, &s->plan, (row_role)((int)role + offset)) < 0) {
                return -1;
            }
        }
        if (text_is(name, "pos") && role != ROW_X) {
            return trajectory_fail(t, t->text.line, "Properties=: '%s' must be pos:R:3", text_quote(name, quote));
        }
    }
    if ((s->plan.roles & ROW_POSITION) != ROW_POSITION) {
        return trajectory_fail(t, t->text.line, "Properties= has no pos:R:3: the spheres have no place");
    }
    return 1;
}

static int plan_plain(trajectory *t)
{
    static const row_role plain[] = {ROW_NAME, ROW_X, ROW_Y, ROW_Z};
    xyz_state *const s = t->state;
    for (size_t i = 0; i < sizeof plain / sizeof plain[0]; i++) {
        if (row_plan_add(t, &s->plan, plain[i]) < 0) {
            return -1;
        }
    }
    s->plan.open_ended = 1;
    return 1;
}

/* ---- The format --------------------------------------------------------------------------------------------- */

/* Reads count and comment: 1, 0 at the end of the file, -1. */
static int read_head(trajectory *t)
{
    xyz_state *const s = t->state;
    text_span line, word, list;
    do { /* blank lines between frames */
        const int status = trajectory_line(t, &line);
        if (status <= 0) {
            return status;
        }
    } while (!text_word(&line, &word));
    if (!text_is_blank(line)) {
        return trajectory_fail(t, t->text.line, "the number of spheres must stand alone on its line");
    }
    if (trajectory_parse_count(t, word, &s->count) < 0 || trajectory_line_inside(t, &line, "before the comment") < 0) {
        return -1;
    }
    read_lattice(s, line);
    read_step(s, line);
    row_plan_clear(&s->plan);
    return find_value(line, "Properties", &list) ? plan_properties(t, list) : plan_plain(t);
}

/* The type and the radius that a name stands for; *radius stays where the name is a number. */
static int read_name(trajectory *t, text_span name, uint32_t *type, float *radius)
{
    xyz_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    const char first = *name.begin;
    if ((first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.') {
        uint64_t number;
        if (!text_u64(name, UINT32_MAX, &number)) {
            return trajectory_fail(t, t->text.line, "'%s' is not the name of an element, or a type",
                                   text_quote(name, quote));
        }
        *type = (uint32_t)number;
        return 1;
    }
    const char *reason = "";
    const uint32_t found = name_table_find(&s->names, name, &reason);
    if (found == 0) {
        return trajectory_fail(t, t->text.line, "'%s': %s", text_quote(name, quote), reason);
    }
    *type = found;
    *radius = s->names.radius[found - 1];
    return 1;
}

static int finish_row(trajectory *t, row *r)
{
    const xyz_state *const s = t->state;
    const unsigned roles = s->plan.roles;
    float radius = DEFAULT_RADIUS;
    if (roles & ROW_BIT(ROW_NAME)) {
        uint32_t type = 0;
        if (read_name(t, r->name, &type, &radius) < 0) {
            return -1;
        }
        if (!(roles & ROW_BIT(ROW_TYPE))) {
            r->type = type;
        }
    }
    if (!(roles & (ROW_BIT(ROW_RADIUS) | ROW_BIT(ROW_DIAMETER)))) {
        r->value[ROW_RADIUS] = t->options.radius > 0.0f ? t->options.radius : radius;
    }
    return 1;
}

static int xyz_begin(trajectory *t)
{
    (void)t;
    return 1;
}

static int xyz_read(trajectory *t, trajectory_frame *frame)
{
    const xyz_state *const s = t->state;
    const int status = read_head(t);
    if (status <= 0) {
        return status;
    }
    trajectory_frame_fill(t, frame, s->count);
    if (s->has_step) {
        frame->step = s->step;
    }
    if (s->has_box) {
        memcpy(frame->box_min, s->box_min, sizeof frame->box_min);
        memcpy(frame->box_max, s->box_max, sizeof frame->box_max);
    }
    return rows_read(t, &s->plan, s->count, finish_row, frame);
}

/* Types are numbered in order of appearance, so a skipped frame must be read, too. */
static int xyz_skip(trajectory *t)
{
    trajectory_frame frame;
    return xyz_read(t, &frame);
}

static void xyz_end(trajectory *t) { (void)t; }

static const char *const endings[] = {".xyz", ".extxyz", NULL};

const trajectory_format trajectory_format_xyz = {
    .endings = endings,
    .state_size = sizeof(xyz_state),
    .begin = xyz_begin,
    .read = xyz_read,
    .skip = xyz_skip,
    .end = xyz_end,
};
