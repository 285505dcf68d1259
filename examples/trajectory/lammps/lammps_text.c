/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * LAMMPS dump text: sections that begin with "ITEM:"; the last of a frame has the rows of atoms. Every section is
 * parsed anew: columns, count and box may change from frame to frame. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/lammps/lammps_box.h"
#include "trajectory/text/text_rows.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

/* Sections of a frame. */
enum { HAS_STEP = 1, HAS_COUNT = 2, HAS_BOX = 4, HAS_OTHER = 8 };

typedef struct lammps_state {
    row_plan plan;
    unsigned seen; /* HAS_ bits of the current frame */
    int64_t step;
    uint32_t count;
    lammps_box box;
    double time;
    int flat;            /* the frame has no column z: z is 0 */
    int has_read;        /* rows of some frame were read, so that it is known whether types are words */
    name_table elements; /* kept when rewinding, as labels are, so that types stay the same */
    name_table labels;   /* of types */
} lammps_state;

/* A bound beyond a float's range stays finite. */
static float clamp_to_float(double value)
{
    return value > (double)FLT_MAX ? FLT_MAX : value < -(double)FLT_MAX ? -FLT_MAX : (float)value;
}

/* ---- Columns ------------------------------------------------------------------------------------------------ */

typedef struct lammps_column {
    const char *name;
    row_role role;
} lammps_column;

static const lammps_column plain_columns[] = {
    {"id", ROW_ID}, {"type", ROW_TYPE}, {"radius", ROW_RADIUS}, {"diameter", ROW_DIAMETER},
    {"vx", ROW_VX}, {"vy", ROW_VY},     {"vz", ROW_VZ},         {"element", ROW_NAME},
};

/* Four forms of a position. */
typedef struct lammps_position {
    const char *name[3];
    int scaled;
} lammps_position;

enum { PLAIN, UNWRAPPED, SCALED, SCALED_UNWRAPPED, POSITIONS };
static const lammps_position positions[POSITIONS] = {
    [PLAIN] = {{"x", "y", "z"}, 0},
    [UNWRAPPED] = {{"xu", "yu", "zu"}, 0},
    [SCALED] = {{"xs", "ys", "zs"}, 1},
    [SCALED_UNWRAPPED] = {{"xsu", "ysu", "zsu"}, 1},
};
static const int unwrapped_first[POSITIONS] = {UNWRAPPED, SCALED_UNWRAPPED, PLAIN, SCALED};
static const int wrapped_first[POSITIONS] = {PLAIN, SCALED, UNWRAPPED, SCALED_UNWRAPPED};

/* Where x, y and z are read from: a form of position each, POSITIONS for none. */
typedef struct position_choice {
    int form[3];
} position_choice;

/* All three columns of the first form that has them; else each from the first form that has it: xu yu z. */
static position_choice choose_position(const trajectory *t, text_span columns)
{
    unsigned found[POSITIONS] = {0};
    text_span word;
    while (text_word(&columns, &word)) {
        for (int p = 0; p < POSITIONS; p++) {
            for (int axis = 0; axis < 3; axis++) {
                found[p] |= (unsigned)text_is(word, positions[p].name[axis]) << axis;
            }
        }
    }
    const int *const order = t->options.wrapped ? wrapped_first : unwrapped_first;
    position_choice choice = {{POSITIONS, POSITIONS, POSITIONS}};
    for (int i = POSITIONS - 1; i >= 0; i--) {
        for (int axis = 0; axis < 3; axis++) {
            choice.form[axis] = found[order[i]] >> axis & 1 ? order[i] : choice.form[axis];
        }
    }
    for (int i = POSITIONS - 1; i >= 0; i--) {
        if (found[order[i]] == 7) {
            choice = (position_choice){{order[i], order[i], order[i]}};
        }
    }
    return choice;
}

static row_role column_role(text_span word, const position_choice *choice, int has_type)
{
    for (int axis = 0; axis < 3; axis++) {
        if (choice->form[axis] < POSITIONS && text_is(word, positions[choice->form[axis]].name[axis])) {
            return (row_role)(ROW_X + axis);
        }
    }
    if (text_is(word, "typelabel")) {
        return has_type ? ROW_UNUSED : ROW_TYPE;
    }
    for (size_t i = 0; i < sizeof plain_columns / sizeof plain_columns[0]; i++) {
        if (text_is(word, plain_columns[i].name)) {
            return plain_columns[i].role;
        }
    }
    return ROW_UNUSED;
}

static trajectory_column_kind column_kind(text_span word)
{
    static const char *const words[] = {"element", "typelabel"};
    static const char *const whole[] = {"id", "mol", "proc", "procp1", "type", "ix", "iy", "iz"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (text_is(word, words[i])) {
            return TRAJECTORY_WORD;
        }
    }
    for (size_t i = 0; i < sizeof whole / sizeof whole[0]; i++) {
        if (text_is(word, whole[i])) {
            return TRAJECTORY_WHOLE;
        }
    }
    return TRAJECTORY_NUMBER;
}

/* Scaled coordinates need the box, and all three of them where its edges are not along the axes: the place along one
 * axis then depends on the fractions along others. */
static int check_scaled(trajectory *t, unsigned scaled)
{
    const lammps_state *const s = t->state;
    if (scaled != 0 && !(s->seen & HAS_BOX)) {
        return trajectory_fail(t, t->text.line, "scaled coordinates without BOX BOUNDS before them");
    }
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < 3; i++) {
            if ((scaled >> axis & 1) && !(scaled >> i & 1) && s->box.edge[i][axis] != 0.0) {
                return trajectory_fail(t, t->text.line,
                                       "in a tilted box either all coordinates or none must be scaled");
            }
        }
    }
    return 1;
}

/* Notes what else the columns might have meant, and checks them. */
static int check_position(trajectory *t, const position_choice *choice)
{
    lammps_state *const s = t->state;
    const int *const form = choice->form;
    if (form[0] == POSITIONS || form[1] == POSITIONS) {
        return trajectory_fail(t, t->text.line,
                               "no columns x y z, xu yu zu, xs ys zs or xsu ysu zsu: the spheres have no place");
    }
    s->flat = form[2] == POSITIONS;
    if (s->flat && !t->text.has_feed) {
        return trajectory_fail(t, t->text.line, "the file ends in the list of columns: it is cut off");
    }
    if (s->flat) {
        trajectory_warn(t, DOUBT_FLAT, t->text.line, "there is no column z: z is 0 for all spheres");
    }
    if (form[0] != form[1] || (!s->flat && form[0] != form[2])) {
        trajectory_warn(t, DOUBT_MIXED_COLUMNS, t->text.line, "positions are taken from the columns %s %s %s",
                        positions[form[0]].name[0], positions[form[1]].name[1],
                        s->flat ? "" : positions[form[2]].name[2]);
    }
    for (int axis = 0; axis < 3; axis++) {
        const int scaled = form[axis] < POSITIONS && positions[form[axis]].scaled;
        s->plan.scaled |= scaled ? 1u << axis : 0u;
    }
    return check_scaled(t, s->plan.scaled);
}

static int plan_columns(trajectory *t, text_span columns)
{
    lammps_state *const s = t->state;
    const position_choice choice = choose_position(t, columns);
    row_plan_clear(&s->plan);
    if (check_position(t, &choice) < 0) {
        return -1;
    }
    s->plan.labels = &s->labels;
    int has_type = 0;
    text_span word, rest = columns;
    while (text_word(&rest, &word)) {
        has_type |= text_is(word, "type");
    }
    while (text_word(&columns, &word)) {
        if (row_plan_add(t, &s->plan, column_role(word, &choice, has_type), word, column_kind(word)) < 0) {
            return -1;
        }
    }
    return 1;
}

/* ---- Sections ----------------------------------------------------------------------------------------------- */

/* Reads the one word of the line that follows a section's heading. */
static int read_value(trajectory *t, text_span *word)
{
    text_span line;
    if (trajectory_line_inside(t, &line, "in the middle of a frame") < 0) {
        return -1;
    }
    if (!text_word(&line, word) || !text_is_blank(line)) {
        return trajectory_fail(t, t->text.line, "one value was expected on this line");
    }
    return 1;
}

static int read_step(trajectory *t)
{
    lammps_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    text_span word;
    if (read_value(t, &word) < 0) {
        return -1;
    }
    if (!text_i64(word, &s->step)) {
        return trajectory_fail(t, t->text.line, "'%s' is not a time step", text_quote(word, quote));
    }
    s->seen |= HAS_STEP;
    return 1;
}

static int read_count(trajectory *t)
{
    lammps_state *const s = t->state;
    text_span word;
    if (read_value(t, &word) < 0 || trajectory_parse_count(t, word, &s->count) < 0) {
        return -1;
    }
    s->seen |= HAS_COUNT;
    return 1;
}

/* Removes `heading` from the front of a line. Returns 1, or 0 where the line does not begin with it. */
static int take_heading(text_span *line, const char *heading)
{
    const size_t length = strlen(heading);
    if (!text_begins(*line, heading) || (text_length(*line) > length && line->begin[length] != ' ')) {
        return 0;
    }
    line->begin += length;
    return 1;
}

/* Refuses a second section of a kind: the frame before had no atoms, so something is lost. */
static int check_first(trajectory *t, unsigned section)
{
    const lammps_state *const s = t->state;
    if (s->seen & section) {
        return trajectory_fail(t, t->text.line, "the frame before this line has no ITEM: ATOMS");
    }
    return 1;
}

/* Reads a section. Returns 1, 2 for the heading of the atoms, or -1. */
static int read_section(trajectory *t, text_span line)
{
    lammps_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    text_span word;
    if (take_heading(&line, "ITEM: TIMESTEP")) {
        return check_first(t, HAS_STEP) < 0 ? -1 : read_step(t);
    }
    if (take_heading(&line, "ITEM: NUMBER OF ATOMS")) {
        return check_first(t, HAS_COUNT) < 0 ? -1 : read_count(t);
    }
    if (take_heading(&line, "ITEM: BOX BOUNDS")) {
        if (check_first(t, HAS_BOX) < 0 || lammps_read_box(t, line, &s->box) < 0) {
            return -1;
        }
        s->seen |= HAS_BOX;
        return 1;
    }
    if (take_heading(&line, "ITEM: TIME")) {
        s->seen |= HAS_OTHER;
        if (read_value(t, &word) < 0) {
            return -1;
        }
        s->time = text_double(word, &s->time) ? s->time : NAN;
        return 1;
    }
    if (take_heading(&line, "ITEM: UNITS")) {
        s->seen |= HAS_OTHER;
        return read_value(t, &word);
    }
    if (!take_heading(&line, "ITEM: ATOMS")) {
        return trajectory_fail(t, t->text.line, "'%s' is not a section of a LAMMPS dump of atoms",
                               text_quote(line, quote));
    }
    if (!(s->seen & HAS_STEP) || !(s->seen & HAS_COUNT)) {
        return trajectory_fail(t, t->text.line, "ITEM: ATOMS without %s before it",
                               s->seen & HAS_STEP ? "NUMBER OF ATOMS" : "TIMESTEP");
    }
    return plan_columns(t, line) < 0 ? -1 : 2;
}

/* Reads a frame up to its atoms: 1, 0 at the end of the file, -1. */
static int read_head(trajectory *t)
{
    lammps_state *const s = t->state;
    s->seen = 0;
    s->time = NAN;
    while (1) {
        text_span line;
        const int status = trajectory_line(t, &line);
        if (status < 0) {
            return -1;
        }
        if (status == 0) {
            return s->seen == 0 ? 0 : trajectory_fail(t, t->text.line, "the file ends before ITEM: ATOMS");
        }
        if (s->seen == 0 && text_is_blank(line)) {
            continue;
        }
        const int section = read_section(t, line);
        if (section < 0) {
            return -1;
        }
        if (section == 2) {
            return 1;
        }
    }
}

/* ---- The format --------------------------------------------------------------------------------------------- */

/* From fractions of the box to places. */
static void place_row(const lammps_state *s, row *r)
{
    for (int axis = 0; axis < 3; axis++) {
        if (!(s->plan.scaled >> axis & 1)) {
            continue;
        }
        double sum = s->box.origin[axis];
        for (int i = 0; i < 3; i++) {
            sum += s->plan.scaled >> i & 1 ? r->fraction[i] * s->box.edge[i][axis] : 0.0;
        }
        r->value[ROW_X + axis] = (float)sum;
    }
    if (s->flat) {
        r->value[ROW_Z] = 0.0f;
    }
}

static int finish_row(trajectory *t, row *r)
{
    lammps_state *const s = t->state;
    float radius = DEFAULT_RADIUS;
    place_row(s, r);
    if (s->plan.roles & ROW_BIT(ROW_NAME)) {
        uint32_t type;
        if (row_name(t, &s->elements, r->name, r, &type, &radius) < 0) {
            return -1;
        }
        if (!(s->plan.roles & ROW_BIT(ROW_TYPE))) {
            r->type = type;
        }
    }
    if (!(s->plan.roles & (ROW_BIT(ROW_RADIUS) | ROW_BIT(ROW_DIAMETER)))) {
        r->value[ROW_RADIUS] = t->options.radius > 0.0f ? t->options.radius : radius;
    }
    return 1;
}

static int lammps_begin(trajectory *t)
{
    (void)t;
    return 1;
}

static int lammps_read(trajectory *t, trajectory_frame *frame)
{
    lammps_state *const s = t->state;
    const int status = read_head(t);
    if (status <= 0) {
        return status;
    }
    s->has_read |= s->count > 0;
    trajectory_frame_fill(t, frame, s->count);
    frame->step = s->step;
    frame->time = s->time;
    for (int axis = 0; axis < 3 && (s->seen & HAS_BOX); axis++) {
        frame->box_min[axis] = clamp_to_float(s->box.low[axis]);
        frame->box_max[axis] = clamp_to_float(s->box.high[axis]);
    }
    if (s->seen & HAS_BOX) {
        memcpy(frame->box_origin, s->box.origin, sizeof frame->box_origin);
        memcpy(frame->box_edge, s->box.edge, sizeof frame->box_edge);
        memcpy(frame->periodic, s->box.periodic, sizeof frame->periodic);
    }
    return rows_read(t, &s->plan, s->count, finish_row, frame);
}

static int lammps_skip(trajectory *t)
{
    lammps_state *const s = t->state;
    trajectory_frame unused;
    const int status = read_head(t);
    if (status <= 0) {
        return status;
    }
    /* Words are numbered in order of appearance, so that frames with some must be read. */
    const int has_words = s->labels.count > 0 || s->plan.roles & ROW_BIT(ROW_NAME) || t->columns.has_words;
    if (s->count == 0 || (s->has_read && !has_words)) {
        return rows_skip(t, s->count);
    }
    s->has_read = 1;
    return rows_read(t, &s->plan, s->count, finish_row, &unused);
}

static void lammps_end(trajectory *t) { (void)t; }

static const char *const endings[] = {".lammpstrj", ".dump", NULL};

const trajectory_format trajectory_format_lammps = {
    .endings = endings,
    .state_size = sizeof(lammps_state),
    .begin = lammps_begin,
    .read = lammps_read,
    .skip = lammps_skip,
    .end = lammps_end,
};
