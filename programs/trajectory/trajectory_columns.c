/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Columns by their names. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_columns.h"
#include "trajectory/trajectory_internal.h"
#include "trajectory/atoms/trajectory_topology.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- Which ones are wanted ---------------------------------------------------------------------------------- */

static void free_wanted(trajectory_columns *c)
{
    for (uint32_t i = 0; i < c->wanted_count; i++) {
        free(c->wanted[i].name);
        free(c->wanted[i].value);
        free(c->wanted[i].words);
    }
    free(c->wanted);
    c->wanted = NULL;
    c->wanted_count = 0;
}

cgt_result cgt_trajectory_want_columns(cgt_trajectory *t, const char *const *names, size_t count)
{
    if (t == NULL)
        return CGT_ERROR_OUT_OF_MEMORY;
    if (!t->is_open || t->failed)
        return t->error;
    trajectory_columns *const c = &t->columns;
    if (count > CGT_TRAJECTORY_MOST_COLUMNS)
        return trajectory_result(t,
                                 trajectory_refuse(t, t->path, CGT_ERROR_FILE, "more than 256 columns are asked for"));
    free_wanted(c);
    c->wanted = calloc(count + 1, sizeof *c->wanted);
    int missing = c->wanted == NULL;
    for (size_t i = 0; i < count && !missing; i++) {
        c->wanted[i].name = strdup(names[i]);
        missing = c->wanted[i].name == NULL;
        c->wanted_count++;
    }
    if (missing) {
        free_wanted(c);
        return trajectory_result(t, trajectory_refuse(t, t->path, CGT_ERROR_OUT_OF_MEMORY, "not enough memory"));
    }
    return t->topology != NULL ? topology_want_columns(t, names, count) : CGT_OK;
}

const cgt_trajectory_column *cgt_trajectory_find_column(const cgt_trajectory_frame *frame, const char *name)
{
    for (uint32_t i = 0; i < frame->columns; i++)
        if (strcmp(frame->column[i].name, name) == 0)
            return &frame->column[i];
    return NULL;
}

void columns_forget_words(trajectory_columns *c)
{
    for (uint32_t i = 0; i < c->wanted_count; i++) {
        free(c->wanted[i].words);
        c->wanted[i].words = NULL;
    }
}

void columns_free(trajectory_columns *c)
{
    free_wanted(c);
    free(c->column);
    free(c->slot);
    free(c->name_at);
    free(c->names);
}

/* ---- The table of a frame ----------------------------------------------------------------------------------- */

void columns_begin(cgt_trajectory *t)
{
    trajectory_columns *const c = &t->columns;
    c->count = 0;
    c->names_used = 0;
    c->has_words = 0;
    for (uint32_t i = 0; i < c->wanted_count; i++)
        c->wanted[i].is_used = 0;
}

static int grow_table(trajectory_columns *c, size_t name_length)
{
    if (c->count == c->capacity) {
        const uint32_t capacity = c->capacity == 0 ? 16 : 2 * c->capacity;
        if (trajectory_grow(&c->column, capacity, sizeof *c->column) ||
            trajectory_grow(&c->slot, capacity, sizeof *c->slot) ||
            trajectory_grow(&c->name_at, capacity, sizeof *c->name_at))
            return -1;
        c->capacity = capacity;
    }
    if (c->names_capacity - c->names_used <= name_length) {
        const size_t capacity = 2 * (c->names_used + name_length) + 256;
        if (trajectory_grow(&c->names, capacity, 1))
            return -1;
        c->names_capacity = capacity;
    }
    return 0;
}

static int has_column(const trajectory_columns *c, text_span name)
{
    for (uint32_t i = 0; i < c->count; i++)
        if (text_is(name, c->names + c->name_at[i]))
            return 1;
    return 0;
}

int columns_want(const cgt_trajectory *t, const char *name)
{
    for (uint32_t i = 0; i < t->columns.wanted_count; i++)
        if (strcmp(t->columns.wanted[i].name, name) == 0)
            return 1;
    return 0;
}

/* The place of a wanted column's values, from 1; 0: not wanted. */
static uint32_t find_wanted(trajectory_columns *c, text_span name)
{
    for (uint32_t i = 0; i < c->wanted_count; i++)
        if (!c->wanted[i].is_used && text_is(name, c->wanted[i].name))
            return i + 1;
    return 0;
}

int columns_add(cgt_trajectory *t, text_span name, cgt_trajectory_column_kind kind)
{
    trajectory_columns *const c = &t->columns;
    const size_t length = text_length(name);
    /* Nobody can ask for a name with a zero byte in it. Files may have thousands of columns: only a table of a few is
     * searched for a name that it has already. */
    if (memchr(name.begin, '\0', length) != NULL || (c->count < 64 && has_column(c, name)))
        return 0;
    if (grow_table(c, length))
        return trajectory_fail(t, t->text.line, "not enough memory for the names of the columns");
    char *const copy = c->names + c->names_used;
    memcpy(copy, name.begin, length);
    copy[length] = '\0';
    c->name_at[c->count] = c->names_used;
    c->names_used += length + 1;
    c->column[c->count] = (cgt_trajectory_column){.kind = kind};
    const uint32_t slot = find_wanted(c, name);
    c->slot[c->count++] = slot;
    if (slot == 0)
        return 0;
    wanted_column *const w = &c->wanted[slot - 1];
    w->is_used = 1;
    if (kind == CGT_TRAJECTORY_WORD) {
        c->has_words = 1;
        w->words = w->words != NULL ? w->words : calloc(1, sizeof *w->words);
        if (w->words == NULL)
            return trajectory_fail(t, t->text.line, "not enough memory for the words of a column");
    }
    return (int)slot;
}

int columns_add_named(cgt_trajectory *t, const char *name, cgt_trajectory_column_kind kind)
{
    return columns_add(t, (text_span){name, name + strlen(name)}, kind);
}

void columns_part_name(const char *name, uint64_t parts, uint64_t i, char *text, size_t size)
{
    static const struct {
        const char *name, *letters;
    } known[] = {{"pos", ""},         {"velo", "v"},  {"vel", "v"},    {"v", "v"}, {"velocity", "v"},
                 {"velocities", "v"}, {"force", "f"}, {"forces", "f"}, {"f", "f"}};
    const char *letters = NULL;
    for (size_t k = 0; k < sizeof known / sizeof known[0] && parts == 3; k++)
        letters = strcasecmp(name, known[k].name) == 0 ? known[k].letters : letters;
    if (parts == 1)
        snprintf(text, size, "%s", name);
    else if (letters != NULL)
        snprintf(text, size, "%s%c", letters, "xyz"[i]);
    else if (parts == 3)
        snprintf(text, size, "%s_%c", name, "xyz"[i]);
    else
        snprintf(text, size, "%s_%u", name, (unsigned)i + 1);
}

float *columns_values(const cgt_trajectory *t, int slot) { return t->columns.wanted[slot - 1].value; }

void columns_store_word(cgt_trajectory *t, int slot, size_t i, text_span word)
{
    const wanted_column *const w = &t->columns.wanted[slot - 1];
    const char *reason = "";
    char quote[TEXT_QUOTE_SIZE];
    const uint32_t number = text_length(word) > 0 ? name_table_find(w->words, word, &reason) : 0;
    if (*reason != '\0')
        trajectory_warn(t, DOUBT_WORDS, t->text.line, "the column %.40s has no words such as '%s': %s", w->name,
                        text_quote(word, quote), reason);
    w->value[i] = (float)number;
}

void columns_set_words(cgt_trajectory *t, int slot, const cgt_trajectory_column *from)
{
    name_table *const words = t->columns.wanted[slot - 1].words;
    if (words->count == from->words && memcmp(words->name, from->word, from->words * sizeof words->name[0]) == 0)
        return;
    memset(words, 0, sizeof *words);
    for (uint32_t i = 0; i < from->words; i++) {
        const char *reason;
        name_table_find(words, (text_span){from->word[i], from->word[i] + strlen(from->word[i])}, &reason);
    }
}

int columns_reserve(cgt_trajectory *t, size_t count)
{
    trajectory_columns *const c = &t->columns;
    for (uint32_t i = 0; i < c->wanted_count; i++) {
        wanted_column *const w = &c->wanted[i];
        if (!w->is_used || (w->capacity >= count && w->value != NULL))
            continue;
        const size_t capacity = t->store.capacity > count ? t->store.capacity : count;
        if (trajectory_grow(&w->value, capacity + (capacity == 0), sizeof *w->value))
            return -1;
        w->capacity = capacity;
    }
    return 0;
}

/* ---- What the frame has in fields --------------------------------------------------------------------------- */

/* Adds a column whose values lie in an array, `stride` apart, less `origin`. */
static int add_floats(cgt_trajectory *t, const char *name, const float *values, size_t stride, uint32_t count,
                      double origin)
{
    const int slot = columns_add_named(t, name, CGT_TRAJECTORY_NUMBER);
    if (slot <= 0)
        return slot;
    if (columns_reserve(t, count))
        return trajectory_fail(t, 0, "not enough memory for the column %s", name);
    float *const to = columns_values(t, slot);
    for (size_t i = 0; i < count; i++)
        to[i] = origin == 0.0 ? values[stride * i] : (float)((double)values[stride * i] + origin);
    return 0;
}

static int add_vectors(cgt_trajectory *t, const char *const names[3], const float *values, size_t stride,
                       uint32_t count, const double origin[3])
{
    int failed = 0;
    for (int axis = 0; axis < 3 && values != NULL && failed == 0; axis++)
        failed = add_floats(t, names[axis], values + axis, stride, count, origin[axis]);
    return failed;
}

/* Adds a column of whole numbers: 32 bits each in `wide`, or where that is NULL bytes. */
static int add_whole(cgt_trajectory *t, const char *name, const uint32_t *wide, const uint8_t *bytes, uint32_t count)
{
    const int slot = wide != NULL || bytes != NULL ? columns_add_named(t, name, CGT_TRAJECTORY_WHOLE) : 0;
    if (slot <= 0)
        return slot;
    if (columns_reserve(t, count))
        return trajectory_fail(t, 0, "not enough memory for the column %s", name);
    float *const to = columns_values(t, slot);
    for (size_t i = 0; i < count; i++)
        to[i] = wide != NULL ? (float)wide[i] : (float)bytes[i];
    return 0;
}

static int add_fields(cgt_trajectory *t, const cgt_trajectory_frame *f)
{
    static const double nowhere[3];
    static const char *const places[3] = {"x", "y", "z"}, *const velocities[3] = {"vx", "vy", "vz"};
    const int is_spheres = f->kind == CGT_TRAJECTORY_SPHERES;
    if (add_vectors(t, places, is_spheres ? f->xyzr : f->position, is_spheres ? 4 : 3, f->count, f->origin) < 0 ||
        (is_spheres && add_floats(t, "radius", f->xyzr + 3, 4, f->count, 0.0) < 0) ||
        add_vectors(t, velocities, f->velocity, 3, f->count, nowhere) < 0 ||
        add_whole(t, "id", f->id, NULL, f->count) < 0 || add_whole(t, "type", f->type, NULL, f->count) < 0)
        return -1;
    return add_whole(t, "element", NULL, f->element, f->count) < 0
               ? -1
               : add_whole(t, "site", NULL, t->sites > 0 ? t->store.site : NULL, f->count);
}

int columns_finish(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    trajectory_columns *const c = &t->columns;
    if (add_fields(t, frame) < 0 || (t->topology != NULL && topology_add_columns(t, frame) < 0) ||
        columns_reserve(t, frame->count))
        return t->failed ? -1 : trajectory_fail(t, 0, "not enough memory for the columns");
    for (uint32_t i = 0; i < c->count; i++) {
        cgt_trajectory_column *const column = &c->column[i];
        column->name = c->names + c->name_at[i];
        if (c->slot[i] == 0)
            continue;
        const wanted_column *const w = &c->wanted[c->slot[i] - 1];
        column->value = w->value;
        if (column->kind == CGT_TRAJECTORY_WORD) {
            column->words = w->words->count;
            column->word = (const char(*)[NAME_LONGEST + 1]) w->words->name;
        }
    }
    frame->columns = c->count;
    frame->column = c->column;
    return 1;
}
