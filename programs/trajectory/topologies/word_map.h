/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Numbers of words, in the order in which they came. */
#ifndef WORD_MAP_H
#define WORD_MAP_H

#include <stddef.h>
#include <stdint.h>

#include "trajectory/text/text_reader.h"

enum { WORD_NONE = UINT32_MAX };

typedef struct word_map {
    char **word;
    uint32_t count, capacity;
    uint32_t *slot; /* 1 + number of a word with this hash, or a later slot has it; 0: free; more than twice `count` */
    uint32_t slots;
} word_map;

/* The number of a word; WORD_NONE: it has none. */
uint32_t word_map_find(const word_map *map, text_span word);

/* The same, which gives a word that has none the next number; WORD_NONE: there is no memory. */
uint32_t word_map_add(word_map *map, text_span word);
void word_map_free(word_map *map);

#endif
