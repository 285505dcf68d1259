/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * The colour of each sphere or triangle; see coloring.h. */
#include "picture/color/coloring.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "picture/color/srgb.h"

/* ---- Elements ------------------------------------------------------------------------------------------------ */

/* Jmol's table argbsCpk (org.jmol.viewer.JmolConstants, later org.jmol.util; shown at jmol.sourceforge.net/jscolors),
 * all 109 of them, in order of atomic numbers, from hydrogen to meitnerium. They follow the models of Corey, Pauling
 * and Koltun: hydrogen white, carbon grey, nitrogen blue, oxygen red, sulphur yellow. */
static const uint32_t element_rgb[] = {
    0xffffff, 0xd9ffff, 0xcc80ff, 0xc2ff00, 0xffb5b5, 0x909090, 0x3050f8, 0xff0d0d, 0x90e050, 0xb3e3f5, 0xab5cf2,
    0x8aff00, 0xbfa6a6, 0xf0c8a0, 0xff8000, 0xffff30, 0x1ff01f, 0x80d1e3, 0x8f40d4, 0x3dff00, 0xe6e6e6, 0xbfc2c7,
    0xa6a6ab, 0x8a99c7, 0x9c7ac7, 0xe06633, 0xf090a0, 0x50d050, 0xc88033, 0x7d80b0, 0xc28f8f, 0x668f8f, 0xbd80e3,
    0xffa100, 0xa62929, 0x5cb8d1, 0x702eb0, 0x00ff00, 0x94ffff, 0x94e0e0, 0x73c2c9, 0x54b5b5, 0x3b9e9e, 0x248f8f,
    0x0a7d8c, 0x006985, 0xc0c0c0, 0xffd98f, 0xa67573, 0x668080, 0x9e63b5, 0xd47a00, 0x940094, 0x429eb0, 0x57178f,
    0x00c900, 0x70d4ff, 0xffffc7, 0xd9ffc7, 0xc7ffc7, 0xa3ffc7, 0x8fffc7, 0x61ffc7, 0x45ffc7, 0x30ffc7, 0x1fffc7,
    0x00ff9c, 0x00e675, 0x00d452, 0x00bf38, 0x00ab24, 0x4dc2ff, 0x4da6ff, 0x2194d6, 0x267dab, 0x266696, 0x175487,
    0xd0d0e0, 0xffd123, 0xb8b8d0, 0xa6544d, 0x575961, 0x9e4fb5, 0xab5c00, 0x754f45, 0x428296, 0x420066, 0x007d00,
    0x70abfa, 0x00baff, 0x00a1ff, 0x008fff, 0x0080ff, 0x006bff, 0x545cf2, 0x785ce3, 0x8a4fe3, 0xa136d4, 0xb31fd4,
    0xb31fba, 0xb30da6, 0xbd0d87, 0xc70066, 0xcc0059, 0xd1004f, 0xd90045, 0xe00038, 0xe6002e, 0xeb0026};

/* The colour of an element by its atomic number, sRGB from 0 to 1; of 0 and of numbers beyond the table a light
 * pink. */
static void element_color(uint32_t number, float srgb[3])
{
    const uint32_t known = number > 0 && number <= sizeof element_rgb / sizeof element_rgb[0];
    const uint32_t rgb = known ? element_rgb[number - 1] : 0xff69b4;
    for (int c = 0; c < 3; c++)
        srgb[c] = (float)(rgb >> (16 - 8 * c) & 255u) / 255.0f;
}

/* ---- Palettes ------------------------------------------------------------------------------------------------ */

static void set_entry(coloring *c, size_t entry, const float srgb[3])
{
    for (int k = 0; k < 3; k++)
        c->palette[entry][k] = srgb_to_linear(srgb[k]);
}

int coloring_init(coloring *c, coloring_by by, const colormap *map, double min, double max)
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
        map = colormap_find(colormap_names()[0]);
    for (uint32_t i = 0; i < COLORING_STEPS; i++) {
        if (by == COLORING_TYPE)
            colormap_type(i + 1, srgb);
        else if (by == COLORING_ELEMENT)
            element_color(i, srgb);
        else
            colormap_at(map, (float)i / (float)(COLORING_STEPS - 1), srgb);
        set_entry(c, i, srgb);
    }
    colormap_unknown(srgb);
    set_entry(c, COLORING_UNKNOWN, srgb);
    return 0;
}

int coloring_init_plain(coloring *c, const float srgb[3])
{
    if (coloring_init(c, COLORING_PLAIN, NULL, 0.0, 0.0))
        return -1;
    set_entry(c, 0, srgb);
    return 0;
}

/* Types count from 1, elements from 0 for none. Beyond the palette they begin again. */
uint16_t coloring_entry_of_kind(const coloring *c, uint32_t kind)
{
    const uint32_t from = c->by == COLORING_ELEMENT ? 0 : COLORING_STEPS - 1;
    return (uint16_t)((kind % COLORING_STEPS + from) % COLORING_STEPS);
}

void coloring_set_kind(coloring *c, uint32_t kind, const float srgb[3])
{
    set_entry(c, coloring_entry_of_kind(c, kind), srgb);
}

void coloring_free(coloring *c)
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
    case COLORING_TYPE: return frame->type ? coloring_entry_of_kind(c, frame->type[i]) : 0;
    case COLORING_ID: return entry_of(c, (double)(frame->id ? frame->id[i] : i));
    case COLORING_SPEED: return speeds ? entry_of(c, (double)speeds[i]) : COLORING_UNKNOWN;
    case COLORING_HEIGHT: return entry_of(c, (double)frame_place(frame, i)[c->axis] + frame->origin[c->axis]);
    case COLORING_ELEMENT: return frame->element ? coloring_entry_of_kind(c, frame->element[i]) : 0;
    case COLORING_AUTO:
    case COLORING_VALUE:
    case COLORING_PLAIN: break;
    }
    return 0;
}

static void apply_formula(coloring *c, uint32_t count)
{
    enum { BLOCK = 256 };
    double values[BLOCK];
    for (uint32_t first = 0; first < count; first += BLOCK) {
        const uint32_t block = count - first < BLOCK ? count - first : BLOCK;
        expression_values(c->formula, first, block, values);
        for (uint32_t i = 0; i < block; i++)
            c->index[first + i] = entry_of(c, values[i]);
    }
}

int coloring_apply(coloring *c, const cgt_trajectory_frame *frame, const float *speeds)
{
    c->per_vertex = frame->kind == CGT_TRAJECTORY_TRIANGLES &&
                    (c->by == COLORING_SPEED || c->by == COLORING_HEIGHT || c->by == COLORING_VALUE);
    const uint32_t count = c->per_vertex ? frame->count : frame_primitives(frame);
    if (reserve(c, count))
        return -1;
    if (c->by == COLORING_VALUE)
        apply_formula(c, count);
    else
        for (uint32_t i = 0; i < count; i++)
            c->index[i] = entry_at(c, frame, speeds, i);
    return 0;
}
