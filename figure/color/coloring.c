/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The colour of each sphere or triangle; see coloring.h. */
#include "color/coloring.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "color/given_colors.h"

/* ---- Palettes ------------------------------------------------------------------------------------------------ */

static void set_entry(coloring *c, size_t entry, const float srgb[3])
{
    for (int k = 0; k < 3; k++)
        c->palette[entry][k] = cgt_srgb_to_linear(srgb[k]);
}

int cgt_coloring_init(coloring *c, coloring_by by, const cgt_colormap *map, double min, double max)
{
    float srgb[3];
    memset(c, 0, sizeof *c);
    c->by = by;
    c->min = min;
    c->max = max;
    c->axis = 2;
    c->capacity = 1;
    c->index = calloc(1, sizeof *c->index);
    if (!c->index)
        return -1;
    if (!map)
        map = cgt_find_colormap(NULL);
    for (uint32_t i = 0; i < COLORING_STEPS; i++) {
        if (by == COLORING_TYPE || by == COLORING_CATEGORY)
            cgt_get_type_color(i + 1, srgb);
        else if (by == COLORING_ELEMENT)
            cgt_get_element_color(i, srgb);
        else
            cgt_get_map_color(map, (float)i / (float)(COLORING_STEPS - 1), srgb);
        set_entry(c, i, srgb);
    }
    cgt_get_unknown_color(srgb);
    set_entry(c, COLORING_UNKNOWN, srgb);
    return 0;
}

void cgt_coloring_set_table(coloring *c, const color_table *table)
{
    float srgb[3];
    if (coloring_has_kinds(c->by) || c->by == COLORING_PLAIN)
        return;
    for (uint32_t i = 0; i < COLORING_STEPS; i++) {
        cgt_color_table_get(table, (float)i / (float)(COLORING_STEPS - 1), srgb);
        set_entry(c, i, srgb);
    }
}

int cgt_coloring_init_plain(coloring *c, const float srgb[3])
{
    if (cgt_coloring_init(c, COLORING_PLAIN, NULL, 0.0, 0.0))
        return -1;
    set_entry(c, 0, srgb);
    return 0;
}

/* Which of those that have a colour of their own a kind is; given_count: none. */
static uint32_t find_given(const coloring *c, int64_t kind)
{
    uint32_t i = 0;
    while (i < c->given_count && c->given[i] != kind)
        i++;
    return i;
}

/* Types and categories count from 1, elements from 0 for none. Beyond the palette they begin again. No word is
 * unknown. */
uint16_t cgt_coloring_entry_of_kind(const coloring *c, int64_t kind)
{
    const uint32_t given = find_given(c, kind);
    if (given < c->given_count)
        return (uint16_t)(COLORING_GIVEN + given);
    const int64_t from = c->by == COLORING_ELEMENT ? 0 : COLORING_STEPS - 1;
    if (c->by == COLORING_CATEGORY && c->categories->has_words && kind == 0)
        return COLORING_UNKNOWN;
    const int64_t rest = (kind % COLORING_STEPS + from) % COLORING_STEPS;
    return (uint16_t)(rest < 0 ? rest + COLORING_STEPS : rest);
}

void cgt_coloring_set_kind(coloring *c, int64_t kind, const float srgb[3])
{
    const uint32_t i = find_given(c, kind);
    if (i == PARTICLE_KINDS)
        return;
    c->given[i] = kind;
    c->given_count += i == c->given_count;
    set_entry(c, COLORING_GIVEN + i, srgb);
}

void cgt_coloring_free(coloring *c)
{
    free(c->index);
    c->index = NULL;
    c->capacity = 0;
}

static int reserve(coloring *c, uint32_t count)
{
    if (count <= c->capacity)
        return 0;
    /* Cannot overflow: the frame itself holds at least twelve bytes for each two bytes here. */
    uint16_t *index = realloc(c->index, (size_t)count * sizeof *index);
    if (!index)
        return -1;
    c->index = index;
    c->capacity = count;
    return 0;
}

/* The entry of a measured value, in double, so that differences of large ids or floats are exact enough. */
static uint16_t entry_of(const coloring *c, double value)
{
    if (!(value - value == 0.0)) /* NaN and infinities */
        return COLORING_UNKNOWN;
    double min = c->min, max = c->max;
    if (c->logarithmic) {
        if (!(value > 0.0)) /* below every range */
            return 0;
        value = log(value);
        min = log(min);
        max = log(max);
    }
    const double span = max - min, x = span > 0.0 ? (value - min) / span : 0.0;
    const double step = x * (COLORING_STEPS - 1) + 0.5;
    if (!(step > 0.0))
        return 0;
    return step < COLORING_STEPS - 1 ? (uint16_t)step : COLORING_STEPS - 1;
}

/* The entry of primitive i, or of vertex i. */
static uint16_t entry_at(const coloring *c, const cgt_trajectory_frame *frame, const float *speeds, uint32_t i)
{
    switch (c->by) {
    case COLORING_TYPE: return frame->type ? cgt_coloring_entry_of_kind(c, frame->type[i]) : 0;
    case COLORING_ID: return entry_of(c, (double)(frame->id ? frame->id[i] : i));
    case COLORING_SPEED: return speeds ? entry_of(c, (double)speeds[i]) : COLORING_UNKNOWN;
    case COLORING_HEIGHT: return entry_of(c, (double)frame_place(frame, i)[c->axis] + frame->origin[c->axis]);
    case COLORING_ELEMENT: return frame->element ? cgt_coloring_entry_of_kind(c, frame->element[i]) : 0;
    case COLORING_AUTO:
    case COLORING_VALUE:
    case COLORING_CATEGORY:
    case COLORING_RGB:
    case COLORING_PLAIN: break;
    }
    return 0;
}

static uint16_t entry_of_category(const coloring *c, double value)
{
    int is_known;
    const int64_t number = cgt_categories_number(c->categories, value, &is_known);
    return is_known ? cgt_coloring_entry_of_kind(c, number) : COLORING_UNKNOWN;
}

static void apply_formula(coloring *c, uint32_t count)
{
    enum { BLOCK = 256 };
    double values[BLOCK];
    const int is_category = c->by == COLORING_CATEGORY;
    for (uint32_t first = 0; first < count; first += BLOCK) {
        const uint32_t block = count - first < BLOCK ? count - first : BLOCK;
        cgt_expression_values(c->formula, first, block, values);
        for (uint32_t i = 0; i < block; i++)
            c->index[first + i] = is_category ? entry_of_category(c, values[i]) : entry_of(c, values[i]);
    }
}

int cgt_coloring_apply(coloring *c, const cgt_trajectory_frame *frame, const float *speeds)
{
    c->per_vertex = frame->kind == CGT_TRAJECTORY_TRIANGLES &&
                    (c->by == COLORING_SPEED || c->by == COLORING_HEIGHT || c->by == COLORING_VALUE);
    const uint32_t count = c->per_vertex ? frame->count : frame_primitives(frame);
    if (reserve(c, count))
        return -1;
    if (c->by == COLORING_CATEGORY)
        cgt_categories_take(c->categories, c->formula, frame);
    if (c->by == COLORING_CATEGORY && c->categories->failed)
        return -1;
    if (c->by == COLORING_VALUE || c->by == COLORING_CATEGORY)
        apply_formula(c, count);
    else if (c->by == COLORING_RGB)
        cgt_coloring_give(c, frame);
    else
        for (uint32_t i = 0; i < count; i++)
            c->index[i] = entry_at(c, frame, speeds, i);
    return 0;
}
