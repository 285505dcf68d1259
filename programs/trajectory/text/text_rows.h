/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows of text: one sphere a line, its values in columns. A plan holds the meaning of each column; LAMMPS dumps and
 * extended .xyz build it from their headers. */
#ifndef TEXT_ROWS_H
#define TEXT_ROWS_H

#include "trajectory/atoms/trajectory_elements.h"
#include "trajectory/trajectory_internal.h"

typedef enum row_role {
    ROW_UNUSED = 0, /* any word */
    ROW_X,
    ROW_Y,
    ROW_Z,
    ROW_RADIUS,
    ROW_VX,
    ROW_VY,
    ROW_VZ,
    ROW_DIAMETER,
    ROW_ID,
    ROW_TYPE,
    ROW_NAME,  /* an element's name, or a type's */
    ROW_NUMBER /* an atomic number */
} row_role;

#define ROW_BIT(role) (1u << (role))
#define ROW_POSITION (ROW_BIT(ROW_X) | ROW_BIT(ROW_Y) | ROW_BIT(ROW_Z))
#define ROW_VELOCITY (ROW_BIT(ROW_VX) | ROW_BIT(ROW_VY) | ROW_BIT(ROW_VZ))

#define ROW_TYPES (ROW_BIT(ROW_TYPE) | ROW_BIT(ROW_NAME) | ROW_BIT(ROW_NUMBER))

#define ROW_ELEMENTS (ROW_BIT(ROW_NAME) | ROW_BIT(ROW_NUMBER))

#define ROW_MOST_COLUMNS 4096

struct row;

typedef struct row_plan {
    uint32_t columns;       /* of each row */
    int open_ended;         /* further columns are allowed and ignored */
    unsigned scaled;        /* 1 << axis: x, y or z is a fraction of the box, kept as a double */
    name_table *names;      /* those of ROW_NAME */
    int names_may_be_types; /* a whole number is one */
    /* Completes the place of a row from the state alone, on any thread; NULL: it is complete. */
    void (*place)(const cgt_trajectory *t, struct row *r);
    name_table *labels; /* types may be words: numbered here; NULL: they may not */
    unsigned roles;     /* ROW_BIT of each role present */
    uint8_t role[ROW_MOST_COLUMNS];
    uint8_t kind[ROW_MOST_COLUMNS];  /* cgt_trajectory_column_kind */
    uint16_t slot[ROW_MOST_COLUMNS]; /* of columns that are wanted under their names; 0: not wanted */
    uint32_t serial;                 /* so many rows are for one thread: among them is one of an unusual form */
    int has_element;                 /* some row has an element */
} row_plan;

/* The values of a row; those without a column are not set. */
typedef struct row {
    float value[ROW_VZ + 1]; /* by role: x, y, z, radius, velocity */
    double fraction[3];      /* x, y, z where the plan is scaled */
    uint32_t number;         /* atomic number */
    uint32_t id;
    uint32_t type;
    uint8_t element; /* atomic number; 0: none */
    text_span name;
} row;

void row_plan_clear(row_plan *plan);

/* Stores the values of row i that the roles have. */
void row_store(trajectory_store *s, size_t i, unsigned roles, const row *r);

/* Adds a column; a repeated role becomes an unused one. Returns 1 or -1: too many columns, no memory. */
int row_plan_add(cgt_trajectory *t, row_plan *plan, row_role role, text_span name, cgt_trajectory_column_kind kind);

/* The type number, the radius and the element that a name stands for; names count as elements or as labels of atoms,
 * and a doubt is noted. Returns 1 or -1. */
int row_name(cgt_trajectory *t, name_table *names, text_span name, row *r, uint32_t *type, float *radius);

/* The same for an atomic number: its symbol is the name. 0 and numbers of no element have a name of their own, X. */
int row_atomic_number(cgt_trajectory *t, name_table *names, row *r, uint32_t *type, float *radius);

/* Completes a row before it is stored: box, type, radius. Returns 1 or -1. */
typedef int row_finish(cgt_trajectory *t, row *r);

/* Reads `count` rows into the store and completes the frame. Returns 1 or -1. */
int rows_read(cgt_trajectory *t, row_plan *plan, uint32_t count, row_finish *finish, cgt_trajectory_frame *frame);

/* Stores row i from the numbers of its columns, and completes it. Numbers stand for names, too. Returns 1 or -1. */
int row_store_numbers(cgt_trajectory *t, row_plan *plan, size_t i, const double *numbers, row_finish *finish);

/* Hands the arrays of all rows to the frame. */
void rows_fill(cgt_trajectory *t, const row_plan *plan, cgt_trajectory_frame *frame);

/* Skips `count` rows, whose labels of types are numbered nevertheless. Returns 1 or -1. */
int rows_skip(cgt_trajectory *t, const row_plan *plan, uint32_t count);

/* ---- Rows of a usual form, many at a time (text_rows_fast.c) ---- */

/* Whether rows of the plan may be of a usual form: no wanted columns of words, no atomic numbers. */
int rows_can_be_fast(const cgt_trajectory *t, const row_plan *plan);

/* Reads rows of a usual form from the lines that the reader holds, from row `done` on, up to `count`. Returns how many,
 * 0 where the next row is not of that form, or no whole line is there; -1: no memory, or the file cannot be read. The
 * other rows are the caller's, one by one: they may be right, too. The results do not depend on the number of
 * threads. */
int64_t rows_read_fast(cgt_trajectory *t, row_plan *plan, uint32_t done, uint32_t count);

#endif
