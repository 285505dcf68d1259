/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Which spheres of a frame have labels, and what these say: a text with columns and formulas in braces, such as
 * "{name}{resid}". A column of words gives its word, element the symbol, all else a number of six digits. */
#ifndef LABEL_RULES_H
#define LABEL_RULES_H

#include <stddef.h>
#include <stdint.h>

#include "data/expression/expression.h"
#include "data/particles.h"

enum { LABEL_PARTS = 5, LABEL_SIZE = 64, LABELS_MOST = 300 };

typedef struct label_part {
    char before[LABEL_SIZE]; /* text */
    char name[LABEL_SIZE];   /* what is in the braces, */
    expression *value;       /* and as a formula */
} label_part;

/* All zero: there are none. */
typedef struct label_rules {
    expression *which; /* spheres of value 0 or NaN have none; NULL: nor have others */
    label_part part[LABEL_PARTS];
    uint32_t parts;
    char after[LABEL_SIZE];
    int is_id; /* in place of a text: ids, or indices where there are none */
} label_rules;

typedef struct particle_label {
    float place[3], radius;
    char text[LABEL_SIZE];
} particle_label;

/* The labels of a frame, in an array that is kept from frame to frame. */
typedef struct label_list {
    particle_label *list;
    uint32_t count;   /* at most LABELS_MOST */
    uint64_t matched; /* spheres that should have one */
} label_list;

/* Splits a text into its parts. Returns 0, or -1 with a sentence; free the rules in any case. */
int cgt_label_rules_split(label_rules *rules, const char *text, char *error, size_t error_size);
void cgt_label_rules_free(label_rules *rules);

/* Finds the labels of spheres that are drawn; all formulas are bound to the frame. Returns 0, or -1: no memory. */
int cgt_label_rules_apply(const label_rules *rules, const particle_rules *drawn, const cgt_trajectory_frame *frame,
                          label_list *labels);

#endif
