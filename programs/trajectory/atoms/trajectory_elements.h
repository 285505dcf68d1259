/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Chemical elements as spheres, and type numbers for names. */
#ifndef TRAJECTORY_ELEMENTS_H
#define TRAJECTORY_ELEMENTS_H

#include "data/molecule/element_radii.h"
#include "trajectory/text/text_reader.h"

/* How a name was understood. */
typedef enum element_reading {
    ELEMENT_NONE = 0, /* no element */
    ELEMENT_SYMBOL,   /* a symbol, perhaps with a number: "C", "C12", "cl" */
    ELEMENT_LABEL,    /* by its first letters: "OW", "HG11", "1HB" */
    ELEMENT_EITHER    /* read as a symbol, but may be a label: "CA" is calcium, or a carbon atom of a protein */
} element_reading;

/* The number of the element that a name stands for, from 1 for hydrogen; 0: none. The case does not matter. */
uint32_t element_find(text_span name, element_reading *reading);

/* The element of this atomic mass, or 0: none has it within 0.012 up to oxygen, beyond within 0.03. Whole numbers are
 * none: units in which atoms have a mass of 1 or 2 know no elements. */
uint32_t element_by_mass(double mass);

/* Names so far, in order of appearance: the first is type 1. */
#define NAMES_MOST 1024
#define NAME_BUCKETS 4096
#define NAME_LONGEST 63 /* as in cgt_trajectory_column */
typedef struct name_table {
    uint32_t count;
    uint32_t last;                 /* index of the name found last: neighbours in a file are alike */
    uint16_t bucket[NAME_BUCKETS]; /* 1 + index of a name with this hash, or a later bucket has it; 0: free */
    char name[NAMES_MOST][NAME_LONGEST + 1];
    float radius[NAMES_MOST];
    uint8_t element[NAMES_MOST]; /* atomic number; 0: none; a mark of trajectory_sites.h: no atom */
} name_table;

/* The type number of a name, or 0: it is not there. */
uint32_t name_table_peek(const name_table *names, text_span name);

/* Finds a name or adds it. Returns its type number from 1, or 0: the name is too long, or there are too many; *reason
 * gets a sentence. */
uint32_t name_table_find(name_table *names, text_span name, const char **reason);

/* The same for types of spheres: names that a full table has no room for share the type NAMES_MOST + 1. */
uint32_t name_table_type(name_table *names, text_span name, const char **reason);

#endif
