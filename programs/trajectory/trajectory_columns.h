/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The columns of a frame: their names, and the values of those that the program wants. A reader begins a frame's table,
 * adds the columns that its file has, and stores values in the places that it gets for the wanted ones. What a frame
 * has in fields of its own, such as x and vx, is added to the table at the end. */
#ifndef TRAJECTORY_COLUMNS_H
#define TRAJECTORY_COLUMNS_H

#include <cgt/trajectory.h>
#include "trajectory/atoms/trajectory_elements.h"

typedef struct wanted_column {
    char *name;
    float *value; /* capacity of the trajectory's store */
    size_t capacity;
    int is_used;       /* the frame has the column */
    name_table *words; /* of columns of words, kept from frame to frame until rewinding; NULL: none so far */
} wanted_column;

typedef struct trajectory_columns {
    wanted_column *wanted;
    uint32_t wanted_count;
    cgt_trajectory_column *column; /* of the frame; names are offsets until columns_finish */
    uint32_t count, capacity;
    uint32_t *slot; /* of each column: the place of its values, 0 for those not wanted */
    size_t *name_at;
    char *names;
    size_t names_used, names_capacity;
    int has_words; /* a column of words is wanted, so that no frame may be skipped unread */
} trajectory_columns;

/* Forgets the last frame's table. */
void columns_begin(cgt_trajectory *t);

/* Adds a column that the file has; one whose name the table already has is left out. Returns the slot of its values, 0
 * where they are not wanted, or -1: no memory, noted. */
int columns_add(cgt_trajectory *t, text_span name, cgt_trajectory_column_kind kind);

/* The same, with the name as a string. */
int columns_add_named(cgt_trajectory *t, const char *name, cgt_trajectory_column_kind kind);

/* Whether values of a column of this name are wanted. */
int columns_want(const cgt_trajectory *t, const char *name);

/* The name of part i of a list of `parts` values named `name`: velocities are vx vy vz and forces fx fy fz, whatever
 * the file calls them, positions x y z. */
void columns_part_name(const char *name, uint64_t parts, uint64_t i, char *text, size_t size);

/* Where the values of a slot from columns_add go. */
float *columns_values(const cgt_trajectory *t, int slot);

/* Stores the number of a word as value i of a slot: 0 where it is empty or, with a warning, where words have no room
 * for it. */
void columns_store_word(cgt_trajectory *t, int slot, size_t i, text_span word);

/* Makes the words of a slot those of another column. */
void columns_set_words(cgt_trajectory *t, int slot, const cgt_trajectory_column *from);

/* Makes room for `count` values in each wanted column that the frame has. Returns 0, or -1: no memory. */
int columns_reserve(cgt_trajectory *t, size_t count);

/* Adds what the frame has in fields (x y z, radius, vx vy vz, id, type, element), and hands the table to the frame.
 * Returns 1 or -1. */
int columns_finish(cgt_trajectory *t, cgt_trajectory_frame *frame);

/* Forgets the numbers of all words. */
void columns_forget_words(trajectory_columns *c);

void columns_free(trajectory_columns *c);

#endif
