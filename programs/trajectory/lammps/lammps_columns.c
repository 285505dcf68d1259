/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The columns of LAMMPS dumps. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/lammps/lammps_parts.h"

#include <string.h>

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
static position_choice choose_position(const cgt_trajectory *t, text_span columns)
{
    unsigned found[POSITIONS] = {0};
    text_span word;
    while (text_word(&columns, &word)) {
        for (int p = 0; p < POSITIONS; p++)
            for (int axis = 0; axis < 3; axis++)
                found[p] |= (unsigned)text_is(word, positions[p].name[axis]) << axis;
    }
    const int *const order = t->options.wrapped ? wrapped_first : unwrapped_first;
    position_choice choice = {{POSITIONS, POSITIONS, POSITIONS}};
    for (int i = POSITIONS - 1; i >= 0; i--)
        for (int axis = 0; axis < 3; axis++)
            choice.form[axis] = found[order[i]] >> axis & 1 ? order[i] : choice.form[axis];
    for (int i = POSITIONS - 1; i >= 0; i--)
        if (found[order[i]] == 7)
            choice = (position_choice){{order[i], order[i], order[i]}};
    return choice;
}

static row_role column_role(text_span word, const position_choice *choice, int has_type)
{
    for (int axis = 0; axis < 3; axis++)
        if (choice->form[axis] < POSITIONS && text_is(word, positions[choice->form[axis]].name[axis]))
            return (row_role)(ROW_X + axis);
    if (text_is(word, "typelabel"))
        return has_type ? ROW_UNUSED : ROW_TYPE;
    for (size_t i = 0; i < sizeof plain_columns / sizeof plain_columns[0]; i++)
        if (text_is(word, plain_columns[i].name))
            return plain_columns[i].role;
    return ROW_UNUSED;
}

static cgt_trajectory_column_kind column_kind(text_span word, int is_binary)
{
    static const char *const words[] = {"element", "typelabel"};
    static const char *const whole[] = {"id", "mol", "proc", "procp1", "type", "ix", "iy", "iz"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (text_is(word, words[i]))
            return is_binary ? CGT_TRAJECTORY_WHOLE : CGT_TRAJECTORY_WORD;
    for (size_t i = 0; i < sizeof whole / sizeof whole[0]; i++)
        if (text_is(word, whole[i]))
            return CGT_TRAJECTORY_WHOLE;
    return CGT_TRAJECTORY_NUMBER;
}

/* Scaled coordinates need the box, and all three of them where its edges are not along the axes: the place along one
 * axis then depends on the fractions along others. */
static int check_scaled(cgt_trajectory *t, unsigned scaled)
{
    const lammps_frame *const s = t->state;
    if (scaled != 0 && !(s->has_box))
        return trajectory_fail(t, t->text.line, "scaled coordinates without BOX BOUNDS before them");
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < 3; i++) {
            if ((scaled >> axis & 1) && !(scaled >> i & 1) && s->box.edge[i][axis] != 0.0)
                return trajectory_fail(t, t->text.line,
                                       "in a tilted box either all coordinates or none must be scaled");
        }
    }
    return 1;
}

/* Notes what else the columns might have meant, and checks them. */
static int check_position(cgt_trajectory *t, const position_choice *choice)
{
    lammps_frame *const s = t->state;
    const int *const form = choice->form;
    if (form[0] == POSITIONS || form[1] == POSITIONS)
        return trajectory_fail(t, t->text.line,
                               "no columns x y z, xu yu zu, xs ys zs or xsu ysu zsu: the spheres have no place");
    s->flat = form[2] == POSITIONS;
    if (s->flat && t->text.line > 0 && !t->text.has_feed)
        return trajectory_fail(t, t->text.line, "the file ends in the list of columns: it is cut off");
    if (s->flat)
        trajectory_warn(t, DOUBT_FLAT, t->text.line, "there is no column z: z is 0 for all spheres");
    if (form[0] != form[1] || (!s->flat && form[0] != form[2]))
        trajectory_warn(t, DOUBT_MIXED_COLUMNS, t->text.line, "positions are taken from the columns %s %s %s",
                        positions[form[0]].name[0], positions[form[1]].name[1],
                        s->flat ? "" : positions[form[2]].name[2]);
    for (int axis = 0; axis < 3; axis++) {
        const int scaled = form[axis] < POSITIONS && positions[form[axis]].scaled;
        s->plan.scaled |= scaled ? 1u << axis : 0u;
        s->unwrapped[axis] = form[axis] == UNWRAPPED || form[axis] == SCALED_UNWRAPPED;
    }
    return check_scaled(t, s->plan.scaled);
}

/* From fractions of the box to places. */
static void place_row(const cgt_trajectory *t, row *r)
{
    const lammps_frame *const s = t->state;
    for (int axis = 0; axis < 3; axis++) {
        if (!(s->plan.scaled >> axis & 1))
            continue;
        double sum = s->box.origin[axis];
        for (int i = 0; i < 3; i++)
            sum += s->plan.scaled >> i & 1 ? r->fraction[i] * s->box.edge[i][axis] : 0.0;
        r->value[ROW_X + axis] = trajectory_place(t, (size_t)axis, sum);
    }
    if (s->flat)
        r->value[ROW_Z] = trajectory_place(t, 2, 0.0);
}

int lammps_plan_columns(cgt_trajectory *t, text_span columns)
{
    lammps_frame *const s = t->state;
    const position_choice choice = choose_position(t, columns);
    row_plan_clear(&s->plan);
    if (check_position(t, &choice) < 0)
        return -1;
    s->plan.labels = &s->labels;
    s->plan.names = &s->elements;
    s->plan.place = s->plan.scaled != 0 || s->flat ? place_row : NULL;
    int has_type = 0;
    text_span word, rest = columns;
    while (text_word(&rest, &word))
        has_type |= text_is(word, "type");
    while (text_word(&columns, &word))
        if (row_plan_add(t, &s->plan, column_role(word, &choice, has_type), word, column_kind(word, s->is_binary)) < 0)
            return -1;
    return 1;
}

/* ---- What a frame is made of -------------------------------------------------------------------------------- */

int lammps_finish_row(cgt_trajectory *t, row *r)
{
    lammps_frame *const s = t->state;
    float radius = DEFAULT_RADIUS;
    place_row(t, r);
    if ((s->plan.roles & ROW_BIT(ROW_NAME)) && !s->is_binary) {
        uint32_t type;
        if (row_name(t, &s->elements, r->name, r, &type, &radius) < 0)
            return -1;
        if (!(s->plan.roles & ROW_BIT(ROW_TYPE)))
            r->type = type;
    }
    if (!(s->plan.roles & (ROW_BIT(ROW_RADIUS) | ROW_BIT(ROW_DIAMETER))))
        r->value[ROW_RADIUS] = t->options.radius > 0.0f ? t->options.radius : radius;
    return 1;
}

void lammps_set_box(const cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    const lammps_frame *const s = t->state;
    if (s->has_box) {
        trajectory_frame_set_box(frame, s->box.origin, s->box.edge);
        memcpy(frame->periodic, s->box.periodic, sizeof frame->periodic);
        memcpy(frame->unwrapped, s->unwrapped, sizeof frame->unwrapped);
    }
}
