/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * LAMMPS dump text: sections that begin with "ITEM:"; the last of a frame has the rows of atoms. Every section is
 * parsed anew: columns, count and box may change from frame to frame. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_row.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

/* The box in LAMMPS' form: a corner and three edges. */
typedef struct lammps_box {
    double origin[3];
    double edge[3][3]; /* edge[i] is the box vector a, b or c */
    double low[3];     /* bounds of the parallelepiped */
    double high[3];
} lammps_box;

/* Sections of a frame. */
enum { HAS_STEP = 1, HAS_COUNT = 2, HAS_BOX = 4, HAS_OTHER = 8 };

typedef struct lammps_state {
    row_plan plan;
    unsigned seen; /* HAS_ bits of the current frame */
    int64_t step;
    uint32_t count;
    lammps_box box;
} lammps_state;

/* ---- Box ---------------------------------------------------------------------------------------------------- */

/* Reads one line of `count` finite numbers. */
static int read_numbers(trajectory *t, int count, double *values)
{
    text_span line, word;
    char quote[TEXT_QUOTE_SIZE];
    if (trajectory_line_inside(t, &line, "in the box bounds") < 0) {
        return -1;
    }
    for (int i = 0; i < count; i++) {
        if (!text_word(&line, &word)) {
            return trajectory_fail(t, t->text.line, "%d numbers where the box bounds need %d", i, count);
        }
        if (!text_double(word, &values[i]) || !isfinite(values[i])) {
            return trajectory_fail(t, t->text.line, "'%s' is not a bound of a box", text_quote(word, quote));
        }
    }
    if (!text_is_blank(line)) {
        return trajectory_fail(t, t->text.line, "more than the %d numbers of the box bounds", count);
    }
    return 1;
}

/* The file has the bounds of the parallelepiped; its corner and lengths follow from them and the tilt. */
static void box_from_bounds(lammps_box *box, double bounds[3][3])
{
    const double xy = bounds[0][2], xz = bounds[1][2], yz = bounds[2][2];
    const double below[3] = {fmin(fmin(0.0, xy), fmin(xz, xy + xz)), fmin(0.0, yz), 0.0};
    const double above[3] = {fmax(fmax(0.0, xy), fmax(xz, xy + xz)), fmax(0.0, yz), 0.0};
    const double tilt[3][3] = {{0, 0, 0}, {xy, 0, 0}, {xz, yz, 0}};
    memcpy(box->edge, tilt, sizeof tilt);
    for (int i = 0; i < 3; i++) {
        box->low[i] = bounds[i][0];
        box->high[i] = bounds[i][1];
        box->origin[i] = bounds[i][0] - below[i];
        box->edge[i][i] = (bounds[i][1] - above[i]) - box->origin[i];
    }
}

/* A general box: each line has a box vector and one coordinate of the corner. */
static void box_from_vectors(lammps_box *box, double lines[3][4])
{
    for (int i = 0; i < 3; i++) {
        memcpy(box->edge[i], lines[i], sizeof box->edge[i]);
        box->origin[i] = lines[i][3];
    }
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = box->high[axis] = box->origin[axis];
        for (int i = 0; i < 3; i++) {
            box->low[axis] += fmin(0.0, box->edge[i][axis]);
            box->high[axis] += fmax(0.0, box->edge[i][axis]);
        }
    }
}

/* flags: what follows "ITEM: BOX BOUNDS", such as "pp pp ff" or "xy xz yz pp pp pp". */
static int read_box(trajectory *t, text_span flags)
{
    lammps_state *const s = t->state;
    text_span word;
    text_word(&flags, &word);
    const int general = text_is(word, "abc");
    const int tilted = text_is(word, "xy");
    const int numbers = general ? 4 : tilted ? 3 : 2;
    double lines[3][4] = {{0}}, bounds[3][3] = {{0}};
    for (int i = 0; i < 3; i++) {
        if (read_numbers(t, numbers, lines[i]) < 0) {
            return -1;
        }
        memcpy(bounds[i], lines[i], sizeof bounds[i]);
        if (!general && lines[i][0] > lines[i][1]) {
            return trajectory_fail(t, t->text.line, "the lower bound of the box is above the upper one");
        }
    }
    if (general) {
        box_from_vectors(&s->box, lines);
    } else {
        box_from_bounds(&s->box, bounds);
    }
    s->seen |= HAS_BOX;
    return 1;
}

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
    {"vx", ROW_VX}, {"vy", ROW_VY},     {"vz", ROW_VZ},
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

/* Returns the first position in the preferred order that has all three columns, or NULL. */
static const lammps_position *choose_position(const trajectory *t, text_span columns)
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
    for (int i = 0; i < POSITIONS; i++) {
        if (found[order[i]] == 7) {
            return &positions[order[i]];
        }
    }
    return NULL;
}

static row_role column_role(text_span word, const lammps_position *position)
{
    for (int axis = 0; axis < 3; axis++) {
        if (text_is(word, position->name[axis])) {
            return (row_role)(ROW_X + axis);
        }
    }
    for (size_t i = 0; i < sizeof plain_columns / sizeof plain_columns[0]; i++) {
        if (text_is(word, plain_columns[i].name)) {
            return plain_columns[i].role;
        }
    }
    return ROW_UNUSED;
}

static int plan_columns(trajectory *t, text_span columns)
{
    lammps_state *const s = t->state;
    const lammps_position *position = choose_position(t, columns);
    if (position == NULL) {
        return trajectory_fail(t, t->text.line,
                               "no columns x y z, xu yu zu, xs ys zs or xsu ysu zsu: the spheres have no place");
    }
    if (position->scaled && !(s->seen & HAS_BOX)) {
        return trajectory_fail(t, t->text.line, "scaled coordinates without BOX BOUNDS before them");
    }
    row_plan_clear(&s->plan);
    s->plan.scaled = position->scaled;
    text_span word;
    while (text_word(&columns, &word)) {
        if (row_plan_add(t, &s->plan, column_role(word, position)) < 0) {
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
        return check_first(t, HAS_BOX) < 0 ? -1 : read_box(t, line);
    }
    if (take_heading(&line, "ITEM: UNITS") || take_heading(&line, "ITEM: TIME")) {
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

static int finish_row(trajectory *t, row *r)
{
    const lammps_state *const s = t->state;
    if (s->plan.scaled) {
        for (int axis = 0; axis < 3; axis++) {
            double sum = s->box.origin[axis];
            for (int i = 0; i < 3; i++) {
                sum += r->fraction[i] * s->box.edge[i][axis];
            }
            r->value[ROW_X + axis] = (float)sum;
        }
    }
    if (!(s->plan.roles & (ROW_BIT(ROW_RADIUS) | ROW_BIT(ROW_DIAMETER)))) {
        r->value[ROW_RADIUS] = t->options.radius > 0.0f ? t->options.radius : DEFAULT_RADIUS;
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
    const lammps_state *const s = t->state;
    const int status = read_head(t);
    if (status <= 0) {
        return status;
    }
    trajectory_frame_fill(t, frame, s->count);
    frame->step = s->step;
    for (int axis = 0; axis < 3 && (s->seen & HAS_BOX); axis++) {
        frame->box_min[axis] = clamp_to_float(s->box.low[axis]);
        frame->box_max[axis] = clamp_to_float(s->box.high[axis]);
    }
    return rows_read(t, &s->plan, s->count, finish_row, frame);
}

static int lammps_skip(trajectory *t)
{
    const lammps_state *const s = t->state;
    const int status = read_head(t);
    return status <= 0 ? status : rows_skip(t, s->count);
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
