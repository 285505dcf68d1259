/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Words and whole numbers that colours tell apart; see categories.h. */
#include "color/categories.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 256 };

/* ---- Words -------------------------------------------------------------------------------------------------- */

/* FNV-1a. */
static uint32_t hash_of(const char *text, size_t length)
{
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < length; i++)
        hash = (hash ^ (uint8_t)text[i]) * 16777619u;
    return hash;
}

/* The slot of a word, or the empty one where it would be. */
static uint32_t *slot_of(const categories *c, const char *text, size_t length)
{
    uint32_t at = hash_of(text, length) & (c->slots - 1);
    while (c->slot[at] &&
           (strncmp(c->word[c->slot[at] - 1], text, length) != 0 || c->word[c->slot[at] - 1][length] != '\0'))
        at = (at + 1) & (c->slots - 1);
    return &c->slot[at];
}

/* Room for one word more, in a table that is half empty. */
static int reserve_word(categories *c)
{
    if (c->words < c->word_room)
        return 0;
    const uint32_t room = c->word_room ? 2 * c->word_room : 64;
    char(*const word)[CATEGORY_WORD_SIZE] = realloc(c->word, (size_t)room * sizeof *word);
    c->word = word ? word : c->word;
    uint32_t *const slot = calloc((size_t)room * 2, sizeof *slot);
    if (!word || !slot) {
        free(slot);
        return -1;
    }
    free(c->slot);
    c->slot = slot;
    c->slots = 2 * room;
    c->word_room = room;
    for (uint32_t i = 0; i < c->words; i++)
        *slot_of(c, c->word[i], strlen(c->word[i])) = i + 1;
    return 0;
}

/* The number of a word, which is added where it is new; 0: no memory. */
static uint32_t take_word(categories *c, const char *text)
{
    if (reserve_word(c))
        return 0;
    uint32_t *const slot = slot_of(c, text, strlen(text));
    if (!*slot) {
        snprintf(c->word[c->words], sizeof *c->word, "%s", text);
        *slot = ++c->words;
    }
    return *slot;
}

void cgt_categories_take(categories *c, const expression *formula, const cgt_trajectory_frame *frame)
{
    const cgt_trajectory_column *const column = cgt_expression_words(formula, frame);
    c->has_words = column != NULL;
    if (!column)
        return;
    if (!c->number_of || column->words >= c->number_room) {
        const size_t room = 2 * (size_t)column->words + 1;
        uint32_t *const more = realloc(c->number_of, room * sizeof *more);
        c->number_of = more ? more : c->number_of;
        c->number_room = more ? room : c->number_room;
        c->failed |= !more;
    }
    for (uint32_t v = 0; v < column->words && !c->failed; v++)
        c->failed = !(c->number_of[v + 1] = take_word(c, column->word[v]));
}

int64_t cgt_categories_number(const categories *c, double value, int *is_known)
{
    const double most = 9007199254740992.0; /* 2^53: whole numbers beyond are not told apart */
    *is_known = fabs(value) <= most && value == floor(value);
    if (!*is_known || !c->has_words || c->failed)
        return *is_known ? (int64_t)value : 0;
    return value >= 1.0 && value < (double)c->number_room ? (int64_t)c->number_of[(size_t)value] : 0;
}

int cgt_categories_find(const categories *c, const char *text, size_t length, int64_t *number)
{
    if (c->has_words) {
        *number = c->slots ? *slot_of(c, text, length) : 0;
        return *number ? 0 : -1;
    }
    char *end;
    *number = strtoll(text, &end, 10);
    return end == text + length && length > 0 ? 0 : -1;
}

void cgt_categories_name(const categories *c, int64_t number, char *name, size_t size)
{
    if (!c->has_words)
        snprintf(name, size, "%" PRId64, number);
    else
        snprintf(name, size, "%s", number > 0 && number <= (int64_t)c->words ? c->word[number - 1] : "none");
}

/* ---- What is shown ------------------------------------------------------------------------------------------ */

/* Adds a number. Returns 0, or -1: no memory. */
static int add(category_set *s, int64_t number)
{
    if (2 * (s->count + 1) > s->room) {
        category_set more = {.room = s->room ? 2 * s->room : 64};
        more.number = malloc(more.room * sizeof *more.number);
        more.is_used = calloc(more.room, 1);
        if (!more.number || !more.is_used) {
            free(more.number);
            free(more.is_used);
            return -1;
        }
        for (size_t i = 0; i < s->room; i++)
            if (s->is_used[i])
                (void)add(&more, s->number[i]); /* it has room */
        free(s->number);
        free(s->is_used);
        *s = more;
    }
    size_t at = (size_t)((uint64_t)number * 0x9E3779B97F4A7C15u >> 32) & (s->room - 1);
    while (s->is_used[at] && s->number[at] != number)
        at = (at + 1) & (s->room - 1);
    s->count += !s->is_used[at];
    s->is_used[at] = 1;
    s->number[at] = number;
    return 0;
}

static void look_at(categories *c, double value, int64_t *last)
{
    int is_known;
    const int64_t number = cgt_categories_number(c, value, &is_known);
    if (!is_known && isfinite(value) && !c->has_fraction) {
        c->has_fraction = 1;
        c->fraction = value;
    }
    if (!is_known || number == *last)
        return;
    *last = number;
    c->failed |= add(&c->shown, number) != 0;
}

/* Neighbours are mostly of one kind. */
void cgt_categories_look(categories *c, const expression *formula, const expression *show, uint32_t count)
{
    double values[BLOCK], shown[BLOCK];
    int64_t last = INT64_MIN;
    for (uint32_t first = 0; first < count; first += BLOCK) {
        const uint32_t block = count - first < BLOCK ? count - first : BLOCK;
        cgt_expression_values(formula, first, block, values);
        if (show)
            cgt_expression_values(show, first, block, shown);
        for (uint32_t i = 0; i < block; i++)
            if (!show || cgt_expression_holds(shown[i]))
                look_at(c, values[i], &last);
    }
}

static int by_number(const void *a, const void *b)
{
    const int64_t *const x = a, *const y = b;
    return (*x > *y) - (*x < *y);
}

int64_t *cgt_categories_sort(const categories *c)
{
    const category_set *const s = &c->shown;
    int64_t *const sorted = s->count ? malloc(s->count * sizeof *sorted) : NULL;
    size_t count = 0;
    for (size_t i = 0; i < s->room && sorted; i++)
        if (s->is_used[i])
            sorted[count++] = s->number[i];
    if (!sorted)
        return NULL;
    qsort(sorted, count, sizeof *sorted, by_number);
    if (c->has_words && sorted[0] == 0) {
        memmove(sorted, sorted + 1, (count - 1) * sizeof *sorted);
        sorted[count - 1] = 0;
    }
    return sorted;
}

void cgt_categories_free(categories *c)
{
    free(c->word);
    free(c->slot);
    free(c->number_of);
    free(c->shown.number);
    free(c->shown.is_used);
    memset(c, 0, sizeof *c);
}
