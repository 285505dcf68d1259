/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Chemical elements as spheres, and type numbers for names. */
#ifndef TRAJECTORY_ELEMENTS_H
#define TRAJECTORY_ELEMENTS_H

#include "trajectory/trajectory_text.h"

#define ELEMENT_DEFAULT_RADIUS 2.0f /* Angstrom: elements missing from the table, and names that are no elements */

/* Van der Waals radius in Angstrom. The symbol's case does not matter, and a label's digits ("C12") are ignored. */
float element_radius(text_span symbol);

/* Names so far, in order of appearance: the first is type 1. */
#define NAMES_MOST 1024
#define NAME_LONGEST 15
typedef struct name_table {
    uint32_t count;
    uint32_t last; /* index of the name found last: neighbours in a file are alike */
    char name[NAMES_MOST][NAME_LONGEST + 1];
    float radius[NAMES_MOST];
} name_table;

/* Finds a name or adds it. Returns its type number from 1, or 0: the name is too long, or there are too many; *reason
 * gets a sentence. */
uint32_t name_table_find(name_table *names, text_span name, const char **reason);

#endif
