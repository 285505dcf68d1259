/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Cells as triangles: polygons as fans, strips with every other triangle turned round. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/vtk/vtk_cells.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char name[] = "the cells";

void vtk_cells_clear(vtk_cells *c)
{
    c->triangles = c->numbers = c->cells = 0;
    c->needed = 0;
    memset(c->count, 0, sizeof c->count);
}

void vtk_cells_free(vtk_cells *c)
{
    free(c->index);
    free(c->number);
    free(c->end);
}

/* ---- Lists ------------------------------------------------------------------------------------------------------ */

static int no_memory(vtk_words *w) { return trajectory_fail(w->in.t, w->line, "not enough memory for the cells"); }

static int add_number(vtk_words *w, vtk_cells *c, double value)
{
    if (!(value >= 0.0 && value < (double)UINT32_MAX))
        return trajectory_fail(w->in.t, w->line, "%g is not the number of a point", value);
    if (c->numbers == c->number_capacity) {
        const size_t capacity = 2 * c->number_capacity + 1024;
        if (trajectory_grow(&c->number, capacity, sizeof *c->number))
            return no_memory(w);
        c->number_capacity = capacity;
    }
    const uint32_t point = (uint32_t)value;
    c->needed = point >= c->needed ? point + 1 : c->needed;
    c->number[c->numbers++] = point;
    return 1;
}

static int add_end(vtk_words *w, vtk_cells *c, uint64_t end)
{
    if (c->cells == c->end_capacity) {
        const size_t capacity = 2 * c->end_capacity + 1024;
        if (trajectory_grow(&c->end, capacity, sizeof *c->end))
            return no_memory(w);
        c->end_capacity = capacity;
    }
    c->end[c->cells++] = end;
    return 1;
}

static int read_numbers(vtk_words *w, vtk_cells *c, vtk_type type, uint64_t count)
{
    double value;
    for (uint64_t i = 0; i < count; i++)
        if (vtk_value(w, type, &value, name) < 0 || add_number(w, c, value) < 0)
            return -1;
    return 1;
}

/* The number of points of each cell, then the points. */
static int read_counted(vtk_words *w, vtk_cells *c, uint64_t cells, uint64_t numbers)
{
    double value;
    for (uint64_t i = 0; i < cells; i++) {
        if (numbers == 0 || vtk_value(w, VTK_I32, &value, name) < 0)
            return numbers > 0 ? -1 : trajectory_fail(w->in.t, w->line, "the cells have more points than their number");
        numbers--;
        if (!(value >= 0.0 && value <= (double)numbers))
            return trajectory_fail(w->in.t, w->line, "the cells have more points than their number");
        numbers -= (uint64_t)value;
        if (read_numbers(w, c, VTK_I32, (uint64_t)value) < 0 || add_end(w, c, c->numbers) < 0)
            return -1;
    }
    return numbers == 0 ? 1 : vtk_skip(w, VTK_I32, numbers, name);
}

/* OFFSETS, one more than there are cells, and CONNECTIVITY. */
static int read_offsets(vtk_words *w, vtk_cells *c, uint64_t offsets, uint64_t numbers)
{
    char word[VTK_WORD];
    vtk_type type;
    uint64_t before = 0;
    for (int i = 0; i < 2; i++) {
        if (vtk_word_inside(w, word, name) < 0)
            return -1;
        if (strcasecmp(word, i == 0 ? "OFFSETS" : "CONNECTIVITY") != 0 || vtk_read_type(w, &type) < 0)
            return w->in.t->failed ? -1 : trajectory_fail(w->in.t, w->line, "OFFSETS and CONNECTIVITY were expected");
        vtk_end_line(w, NULL);
        for (uint64_t k = 0; k < offsets && i == 0; k++) {
            double value;
            if (vtk_value(w, type, &value, name) < 0)
                return -1;
            if (!(value >= (double)before && value <= (double)numbers))
                return trajectory_fail(w->in.t, w->line, "the cells have more points than their number");
            before = (uint64_t)value;
            if (k > 0 && add_end(w, c, before) < 0)
                return -1;
        }
    }
    return read_numbers(w, c, type, numbers);
}

int vtk_cells_read_list(vtk_words *w, vtk_cells *c)
{
    uint64_t cells, numbers;
    c->cells = c->numbers = 0;
    if (vtk_count(w, &cells, name) < 0 || vtk_count(w, &numbers, name) < 0)
        return -1;
    vtk_end_line(w, NULL);
    const int next = getc(w->in.t->file);
    if (next != EOF && ungetc(next, w->in.t->file) != next)
        return trajectory_fail(w->in.t, w->line, "the file cannot be read");
    return next == 'O' ? read_offsets(w, c, cells, numbers) : read_counted(w, c, cells, numbers);
}

/* ---- Triangles -------------------------------------------------------------------------------------------------- */

static int add_triangle(vtk_words *w, vtk_cells *c, uint32_t first, uint32_t second, uint32_t third)
{
    const uint64_t most = w->in.t->options.max_count;
    if (c->triangles >= most)
        return trajectory_fail(w->in.t, w->line, "more triangles than the limit of %" PRIu64, most);
    if (c->triangles == c->triangle_capacity) {
        const size_t capacity = 2 * c->triangle_capacity + 1024;
        if (trajectory_grow(&c->index, capacity, 3 * sizeof *c->index))
            return no_memory(w);
        c->triangle_capacity = capacity;
    }
    uint32_t *const to = c->index + 3 * c->triangles++;
    to[0] = first;
    to[1] = second;
    to[2] = third;
    return 1;
}

static int add_cell(vtk_words *w, vtk_cells *c, vtk_kind kind, size_t begin, size_t end)
{
    const uint32_t *const p = c->number + begin;
    const size_t points = end - begin;
    int status = 1;
    c->count[kind] += points > 0;
    if (kind == VTK_PIXELS && points == 4)
        return add_triangle(w, c, p[0], p[1], p[3]) < 0 ? -1 : add_triangle(w, c, p[0], p[3], p[2]);
    for (size_t k = 2; k < points && kind == VTK_POLYGONS && status > 0; k++)
        status = add_triangle(w, c, p[0], p[k - 1], p[k]);
    for (size_t k = 2; k < points && kind == VTK_STRIPS && status > 0; k++)
        status =
            k % 2 == 0 ? add_triangle(w, c, p[k - 2], p[k - 1], p[k]) : add_triangle(w, c, p[k - 1], p[k - 2], p[k]);
    return status;
}

int vtk_cells_read(vtk_words *w, vtk_cells *c, vtk_kind kind)
{
    if (vtk_cells_read_list(w, c) < 0)
        return -1;
    for (size_t i = 0; i < c->cells; i++)
        if (add_cell(w, c, kind, i > 0 ? (size_t)c->end[i - 1] : 0, (size_t)c->end[i]) < 0)
            return -1;
    return 1;
}

int vtk_cells_read_types(vtk_words *w, vtk_cells *c)
{
    static const vtk_kind kinds[] = {VTK_OTHERS,   VTK_POINTS, VTK_POINTS,   VTK_LINES,  VTK_LINES,
                                     VTK_POLYGONS, VTK_STRIPS, VTK_POLYGONS, VTK_PIXELS, VTK_POLYGONS};
    uint64_t cells;
    double type;
    if (vtk_count(w, &cells, name) < 0)
        return -1;
    vtk_end_line(w, NULL);
    for (uint64_t i = 0; i < cells; i++) {
        if (vtk_value(w, VTK_I32, &type, name) < 0)
            return -1;
        if (i < c->cells && add_cell(w, c, type >= 0.0 && type < 10.0 ? kinds[(int)type] : VTK_OTHERS,
                                     i > 0 ? (size_t)c->end[i - 1] : 0, (size_t)c->end[i]) < 0)
            return -1;
    }
    return 1;
}
