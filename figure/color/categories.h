/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * What colours tell apart where they stand for no amount: the words of a column, numbered from 1 in the order in which
 * the run has them, or the whole numbers of a column or formula. A word has its number, and so its colour, by the words
 * before it in the data, whatever is shown and whichever frames were looked at. */
#ifndef CATEGORIES_H
#define CATEGORIES_H

#include <stddef.h>
#include <stdint.h>

#include "data/expression/expression.h"

enum { CATEGORY_WORD_SIZE = 64 };

/* A table of numbers without repeats, in no order. */
typedef struct category_set {
    int64_t *number;
    uint8_t *is_used;
    size_t count, room; /* room: a power of two, or 0 */
} category_set;

/* All zero at first. */
typedef struct categories {
    int takes_numbers; /* whole numbers are categories, too; set by the caller */
    int has_words;     /* the formula is a column of words in the frame that was taken last */
    int failed;        /* there was no memory */
    char (*word)[CATEGORY_WORD_SIZE];
    uint32_t words, word_room;
    uint32_t *slot; /* a hash table of words: their numbers, 0 none */
    uint32_t slots;
    uint32_t *number_of; /* by the number of a word in the frame: that in the run */
    size_t number_room;
    category_set shown; /* those that are drawn in some frame; 0: spheres without a word */
    int has_fraction;   /* a value that was looked at is no whole number: */
    double fraction;
} categories;

/* Takes the words of a frame that the formula is bound to. */
void cgt_categories_take(categories *c, const expression *formula, const cgt_trajectory_frame *frame);

/* The number of a value of the formula, 0 without a word; *is_known becomes 0 where it is no whole number. */
int64_t cgt_categories_number(const categories *c, double value, int *is_known);

/* Looks at spheres of the frame that was taken last for what is shown; show: NULL: all are. */
void cgt_categories_look(categories *c, const expression *formula, const expression *show, uint32_t count);

/* The c->shown.count numbers that are shown, in their order, but 0 of words last; to be freed. NULL: none, or no
 * memory. */
int64_t *cgt_categories_sort(const categories *c);

/* The number of a word, or of digits where there are no words. Returns 0, or -1: the run has no such word so far. */
int cgt_categories_find(const categories *c, const char *text, size_t length, int64_t *number);

/* What a legend calls a number. */
void cgt_categories_name(const categories *c, int64_t number, char *name, size_t size);

void cgt_categories_free(categories *c); /* it is all zero then */

#endif
