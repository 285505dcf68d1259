/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Going past cells and colours. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/vtk/vtk_passed.h"

#include <inttypes.h>
#include <string.h>
#include <strings.h>

static const char array[] = "an array";

int vtk_read_type(vtk_words *w, vtk_type *type)
{
    trajectory *const t = w->in.t;
    char word[VTK_WORD];
    if (vtk_word_inside(w, word, array) < 0)
        return -1;
    *type = vtk_find_type(word);
    return *type != VTK_NONE ? 1 : trajectory_fail(t, w->line, "arrays of %.40s cannot be read", word);
}

int vtk_skip_colors(vtk_words *w, int are_coordinates, uint64_t tuples, uint64_t fixed_parts)
{
    trajectory *const t = w->in.t;
    char name[VTK_WORD];
    uint64_t parts = fixed_parts;
    vtk_type type = w->is_binary ? VTK_U8 : VTK_F32;
    if (vtk_word_inside(w, name, array) < 0 || (fixed_parts == 0 && vtk_count(w, &parts, array) < 0) ||
        (are_coordinates && vtk_read_type(w, &type) < 0) || (fixed_parts > 0 && vtk_count(w, &tuples, array) < 0))
        return -1;
    vtk_end_line(w, NULL);
    if (parts > 65536)
        return trajectory_fail(t, w->line, "an array of %" PRIu64 " columns", parts);
    return vtk_skip(w, type, parts * tuples, array);
}

int vtk_skip_cells(vtk_words *w)
{
    trajectory *const t = w->in.t;
    char word[VTK_WORD];
    uint64_t cells, numbers;
    vtk_type type;
    if (vtk_count(w, &cells, "the cells") < 0 || vtk_count(w, &numbers, "the cells") < 0)
        return -1;
    vtk_end_line(w, NULL);
    const int c = getc(t->file);
    if (c != EOF && ungetc(c, t->file) != c)
        return trajectory_fail(t, w->line, "the file cannot be read");
    if (c != 'O')
        return vtk_skip(w, VTK_I32, numbers, "the cells");
    for (int i = 0; i < 2; i++) {
        if (vtk_word_inside(w, word, "the cells") < 0)
            return -1;
        if (strcasecmp(word, i == 0 ? "OFFSETS" : "CONNECTIVITY") != 0 || vtk_read_type(w, &type) < 0)
            return t->failed ? -1 : trajectory_fail(t, w->line, "OFFSETS and CONNECTIVITY were expected");
        vtk_end_line(w, NULL);
        if (vtk_skip(w, type, i == 0 ? cells : numbers, "the cells") < 0)
            return -1;
    }
    return 1;
}

int vtk_skip_cell_types(vtk_words *w)
{
    uint64_t cells;
    if (vtk_count(w, &cells, "the cells") < 0)
        return -1;
    vtk_end_line(w, NULL);
    return vtk_skip(w, VTK_I32, cells, "the cells");
}
