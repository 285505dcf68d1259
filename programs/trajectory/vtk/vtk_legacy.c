/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Points of legacy VTK files (VTK File Formats, "Simple Legacy Formats", versions 1 to 5): datasets POLYDATA and
 * UNSTRUCTURED_GRID, text or binary. Where all cells are faces they are triangles, such as the walls of LIGGGHTS; else
 * points are spheres, and faces, lines and volumes are told. Arrays of POINT_DATA are columns; radius or diameter, id,
 * type and v or velocity go to the frame. Each file is one frame, as LIGGGHTS and others write them. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/binary/atom_array.h"
#include "trajectory/vtk/vtk_cells.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define PART 4096u /* points read at a time, so that memory grows with the file */

typedef struct vtk_state {
    vtk_words w;
    uint32_t count;
    int has_points;
    int in_points;   /* arrays are those of points: between POINT_DATA and CELL_DATA */
    uint64_t tuples; /* of the arrays */
    int was_read;
    int has_id, has_type, has_velocity, has_radius;
    double time;
    vtk_cells cells;
    /* Of the first file of a series, which all others have, too. */
    int has_first;
    uint32_t *first; /* 3 points of each triangle */
    size_t first_triangles, first_capacity;
    float *position; /* 3 each */
    size_t position_capacity;
} vtk_state;

static const char header[] = "the header";
static const char array[] = "an array";

/* ---- Header ------------------------------------------------------------------------------------------------- */

static int vtk_begin(cgt_trajectory *t)
{
    vtk_state *const s = t->state;
    const vtk_state before = *s;
    memset(s, 0, sizeof *s);
    s->cells = before.cells;
    s->has_first = before.has_first;
    s->first = before.first;
    s->first_triangles = before.first_triangles;
    s->first_capacity = before.first_capacity;
    s->position = before.position;
    s->position_capacity = before.position_capacity;
    vtk_cells_clear(&s->cells);
    binary_begin(&s->w.in, t, 1);
    s->w.line = 1;
    return 1;
}

/* Reads the lines up to the dataset's kind: 1, 0 where the file is empty, -1. */
static int read_header(cgt_trajectory *t)
{
    vtk_state *const s = t->state;
    char line[VTK_WORD], word[VTK_WORD];
    if (!vtk_end_line(&s->w, line))
        return ferror(t->file) ? trajectory_fail(t, 0, "the file cannot be read") : 0;
    if (strncasecmp(line, "# vtk DataFile Version", 22) != 0)
        return trajectory_fail(t, 1, "not a legacy VTK file: it does not begin with # vtk DataFile Version");
    vtk_end_line(&s->w, NULL); /* the title */
    if (vtk_word_inside(&s->w, word, header) < 0)
        return -1;
    s->w.is_binary = strcasecmp(word, "BINARY") == 0;
    if (!s->w.is_binary && strcasecmp(word, "ASCII") != 0)
        return trajectory_fail(t, s->w.line, "ASCII or BINARY was expected on the third line");
    if (vtk_word_inside(&s->w, word, header) < 0)
        return -1;
    if (strcasecmp(word, "DATASET") != 0 || vtk_word_inside(&s->w, word, header) < 0)
        return t->failed ? -1 : trajectory_fail(t, s->w.line, "DATASET was expected");
    if (strcasecmp(word, "POLYDATA") != 0 && strcasecmp(word, "UNSTRUCTURED_GRID") != 0)
        return trajectory_fail(t, s->w.line,
                               "the dataset is neither POLYDATA nor UNSTRUCTURED_GRID, which alone are read");
    return 1;
}

/* ---- Arrays ------------------------------------------------------------------------------------------------- */

/* Reads or skips the values of an array; a line has been read to its end, or to what follows a blank. */
static int read_values(cgt_trajectory *t, const char *name, uint32_t parts, uint64_t tuples, vtk_type type,
                       atom_use use)
{
    vtk_state *const s = t->state;
    atom_array a = {.use = use};
    const int is_known = type != VTK_BIT && type != VTK_STRING;
    const int is_of_points = is_known && (use == ATOM_PLACE || (s->in_points && s->has_points && tuples == s->count));
    if (use == ATOM_PLACE && !is_known)
        return trajectory_fail(t, s->w.line, "points have to be numbers");
    if (parts == 0)
        return trajectory_fail(t, s->w.line, "the array %.40s has no columns, or too many", name);
    if (tuples > UINT64_MAX / 8 / parts)
        return trajectory_fail(t, s->w.line, "the array %.40s of %" PRIu32 " columns and %" PRIu64 " rows is too large",
                               name, parts, tuples);
    if (is_of_points && parts <= ATOM_MOST_PARTS && atom_array_plan(t, &a, name, parts, vtk_is_whole(type)) < 0)
        return -1;
    vtk_end_line(&s->w, NULL);
    if (!a.is_wanted)
        return vtk_skip(&s->w, type, parts * tuples, array);
    if (columns_reserve(t, s->count))
        return trajectory_fail(t, s->w.line, "not enough memory for the column %s", name);
    for (uint32_t i = 0; i < s->count; i++) {
        const uint32_t part = s->count - i < PART ? s->count - i : PART;
        if (use == ATOM_PLACE && i % PART == 0 && trajectory_reserve(t, (size_t)i + part, s->count) < 0)
            return -1;
        for (uint32_t k = 0; k < parts; k++) {
            double value;
            if (vtk_value(&s->w, type, &value, array) < 0)
                return -1;
            atom_array_store(t, &a, i, k, value);
        }
    }
    s->has_id |= a.use == ATOM_ID;
    s->has_type |= a.use == ATOM_TYPE;
    s->has_velocity |= a.use == ATOM_VELOCITY;
    s->has_radius |= a.use == ATOM_RADIUS || a.use == ATOM_DIAMETER;
    return 1;
}

static int read_points(cgt_trajectory *t)
{
    vtk_state *const s = t->state;
    vtk_type type;
    uint64_t count;
    if (s->has_points)
        return trajectory_fail(t, s->w.line, "a second list of points");
    if (vtk_count(&s->w, &count, "the points") < 0 || vtk_read_type(&s->w, &type) < 0 ||
        binary_check_count(&s->w.in, count) < 0)
        return -1;
    s->count = (uint32_t)count;
    s->has_points = 1;
    if (trajectory_reserve(t, 0, s->count) < 0 || read_values(t, "points", 3, count, type, ATOM_PLACE) < 0)
        return -1;
    return 1;
}

/* METADATA, of the array before: up to a blank line. */
static void skip_metadata(cgt_trajectory *t)
{
    vtk_state *const s = t->state;
    char line[VTK_WORD];
    vtk_end_line(&s->w, line); /* its own */
    while (vtk_end_line(&s->w, line) && line[0] != '\0') {
    }
}

/* "FIELD name arrays", then name, columns, rows, type and values of each. */
static int read_field(cgt_trajectory *t)
{
    vtk_state *const s = t->state;
    char word[VTK_WORD];
    uint64_t arrays, parts, tuples;
    if (vtk_word_inside(&s->w, word, array) < 0 || vtk_count(&s->w, &arrays, array) < 0)
        return -1;
    for (uint64_t i = 0; i < arrays; i++) {
        vtk_type type;
        if (vtk_word_inside(&s->w, word, array) < 0)
            return -1;
        if (strcasecmp(word, "METADATA") == 0) {
            skip_metadata(t);
            i--;
            continue;
        }
        if (vtk_count(&s->w, &parts, array) < 0 || vtk_count(&s->w, &tuples, array) < 0 ||
            vtk_read_type(&s->w, &type) < 0)
            return -1;
        const int is_time = parts == 1 && tuples == 1 && type != VTK_BIT && type != VTK_STRING &&
                            (strcasecmp(word, "TIME") == 0 || strcasecmp(word, "TimeValue") == 0);
        if (is_time && !s->in_points) {
            vtk_end_line(&s->w, NULL);
            if (vtk_value(&s->w, type, &s->time, array) < 0)
                return -1;
        } else if (read_values(t, word, parts > UINT32_MAX ? 0 : (uint32_t)parts, tuples, type, ATOM_NONE) < 0) {
            return -1;
        }
    }
    return 1;
}

/* "SCALARS name type [columns]" and a line "LOOKUP_TABLE name". */
static int read_scalars(cgt_trajectory *t)
{
    vtk_state *const s = t->state;
    char name[VTK_WORD], word[VTK_WORD];
    vtk_type type;
    uint64_t parts = 1;
    if (vtk_word_inside(&s->w, name, array) < 0 || vtk_read_type(&s->w, &type) < 0)
        return -1;
    if (vtk_word_of_line(&s->w, word) > 0 && !text_u64((text_span){word, word + strlen(word)}, 65536, &parts))
        return trajectory_fail(t, s->w.line, "'%.40s' is not a number of columns", word);
    if (vtk_word_inside(&s->w, word, array) < 0)
        return -1;
    if (strcasecmp(word, "LOOKUP_TABLE") != 0)
        return trajectory_fail(t, s->w.line, "LOOKUP_TABLE was expected after SCALARS");
    return read_values(t, name, (uint32_t)parts, s->tuples, type, ATOM_NONE);
}

/* "VECTORS name type" and the like. */
static int read_vectors(cgt_trajectory *t, uint32_t parts)
{
    vtk_state *const s = t->state;
    char name[VTK_WORD];
    vtk_type type;
    if (vtk_word_inside(&s->w, name, array) < 0 || vtk_read_type(&s->w, &type) < 0)
        return -1;
    return read_values(t, name, parts, s->tuples, type, ATOM_NONE);
}

/* ---- The format --------------------------------------------------------------------------------------------- */

static int begin_data(cgt_trajectory *t, int is_of_points)
{
    vtk_state *const s = t->state;
    if (vtk_count(&s->w, &s->tuples, header) < 0)
        return -1;
    s->in_points = is_of_points;
    if (is_of_points && s->has_points && s->tuples != s->count)
        return trajectory_fail(t, s->w.line, "data of %" PRIu64 " points, but there are %" PRIu32, s->tuples, s->count);
    return 1;
}

static int is_one_of(const char *word, const char *const *words)
{
    for (; *words != NULL; words++)
        if (strcasecmp(word, *words) == 0)
            return 1;
    return 0;
}

/* Reads what a keyword begins. */
static int read_part(cgt_trajectory *t, const char *word)
{
    static const char *const cells[] = {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"}; /* by vtk_kind */
    static const char *const vectors[] = {"VECTORS", "NORMALS", NULL};
    static const char *const ids[] = {"GLOBAL_IDS", "PEDIGREE_IDS", NULL};
    vtk_state *const s = t->state;
    for (int kind = VTK_POINTS; kind <= VTK_STRIPS; kind++)
        if (strcasecmp(word, cells[kind]) == 0)
            return vtk_cells_read(&s->w, &s->cells, (vtk_kind)kind);
    if (strcasecmp(word, "CELLS") == 0)
        return vtk_cells_read_list(&s->w, &s->cells);
    if (is_one_of(word, vectors) || is_one_of(word, ids))
        return read_vectors(t, is_one_of(word, ids) ? 1 : 3);
    if (strcasecmp(word, "POINTS") == 0)
        return read_points(t);
    if (strcasecmp(word, "CELL_TYPES") == 0)
        return vtk_cells_read_types(&s->w, &s->cells);
    if (strcasecmp(word, "POINT_DATA") == 0 || strcasecmp(word, "CELL_DATA") == 0)
        return begin_data(t, strcasecmp(word, "POINT_DATA") == 0);
    if (strcasecmp(word, "FIELD") == 0)
        return read_field(t);
    if (strcasecmp(word, "SCALARS") == 0)
        return read_scalars(t);
    if (strcasecmp(word, "TENSORS") == 0 || strcasecmp(word, "TENSORS6") == 0)
        return read_vectors(t, strcasecmp(word, "TENSORS") == 0 ? 9 : 6);
    if (strcasecmp(word, "COLOR_SCALARS") == 0 || strcasecmp(word, "TEXTURE_COORDINATES") == 0)
        return vtk_skip_colors(&s->w, strcasecmp(word, "TEXTURE_COORDINATES") == 0, s->tuples, 0);
    if (strcasecmp(word, "LOOKUP_TABLE") == 0)
        return vtk_skip_colors(&s->w, 0, 0, 4);
    if (strcasecmp(word, "METADATA") == 0) {
        skip_metadata(t);
        return 1;
    }
    return trajectory_fail(t, s->w.line, "'%.40s' is no part of a legacy VTK file", word);
}

/* Makes the triangles those of the first file, which has to have the same ones. */
static int keep_triangles(cgt_trajectory *t, size_t triangles)
{
    vtk_state *const s = t->state;
    if (s->has_first && (triangles != s->first_triangles ||
                         (triangles > 0 && memcmp(s->first, s->cells.index, 3 * triangles * sizeof *s->first) != 0)))
        return trajectory_fail(t, s->w.line, "the triangles are not those of the first file");
    if (triangles > s->first_capacity) {
        if (trajectory_grow(&s->first, triangles, 3 * sizeof *s->first))
            return trajectory_fail(t, s->w.line, "not enough memory for %zu triangles", triangles);
        s->first_capacity = triangles;
    }
    if (triangles > 0)
        memcpy(s->first, s->cells.index, 3 * triangles * sizeof *s->first);
    s->first_triangles = triangles;
    s->has_first = 1;
    return 1;
}

static int fill_triangles(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    vtk_state *const s = t->state;
    if (s->cells.needed > s->count)
        return trajectory_fail(t, s->w.line, "a cell has point %" PRIu32 ", but there are %" PRIu32,
                               s->cells.needed - 1, s->count);
    if (s->count > s->position_capacity || s->position == NULL) {
        if (trajectory_grow(&s->position, (size_t)s->count + 1, 3 * sizeof *s->position))
            return trajectory_fail(t, s->w.line, "not enough memory for %" PRIu32 " points", s->count);
        s->position_capacity = s->count;
    }
    for (size_t i = 0; i < s->count; i++)
        memcpy(s->position + 3 * i, t->store.xyzr + 4 * i, 3 * sizeof *s->position);
    trajectory_frame_fill_triangles(t, frame, s->count, (uint32_t)s->first_triangles);
    frame->index = s->first;
    frame->position = s->position;
    frame->time = s->time;
    return 1;
}

/* What is drawn is told where it is not all. */
static void tell_cells(cgt_trajectory *t)
{
    const vtk_state *const s = t->state;
    const uint64_t *const n = s->cells.count;
    const uint64_t faces = n[VTK_POLYGONS] + n[VTK_STRIPS] + n[VTK_PIXELS], all = faces + n[VTK_LINES] + n[VTK_OTHERS];
    if (all > 0)
        trajectory_warn(t, DOUBT_SHAPES, 0,
                        "%" PRIu64 " cells are not drawn, but their points are (faces: %" PRIu64 ", lines: %" PRIu64
                        ", volumes and others: %" PRIu64 ")",
                        all, faces, n[VTK_LINES], n[VTK_OTHERS]);
}

static int vtk_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    vtk_state *const s = t->state;
    char word[VTK_WORD];
    if (s->was_read)
        return 0;
    s->time = NAN;
    int status = read_header(t);
    if (status <= 0)
        return status;
    while ((status = vtk_word(&s->w, word)) > 0)
        if (read_part(t, word) < 0)
            return -1;
    if (status < 0 || ferror(t->file))
        return status < 0 ? -1 : trajectory_fail(t, 0, "the file cannot be read");
    if (!s->has_points)
        return trajectory_fail(t, s->w.line, "the file ends before its POINTS");
    s->was_read = 1;
    const uint64_t *const cells = s->cells.count;
    const int are_faces = s->cells.triangles > 0 && cells[VTK_POINTS] + cells[VTK_LINES] + cells[VTK_OTHERS] == 0;
    if (keep_triangles(t, are_faces ? s->cells.triangles : 0) < 0)
        return -1;
    if (are_faces)
        return fill_triangles(t, frame);
    tell_cells(t);
    for (size_t i = 0; i < s->count && !s->has_radius; i++)
        t->store.xyzr[4 * i + 3] = trajectory_default_radius(t);
    trajectory_frame_fill(t, frame, s->count);
    frame->time = s->time;
    frame->has_radius = s->has_radius;
    frame->id = s->has_id ? t->store.id : NULL;
    frame->type = s->has_type ? t->store.type : NULL;
    frame->velocity = s->has_velocity ? t->store.velocity : NULL;
    return 1;
}

static void vtk_end(cgt_trajectory *t)
{
    vtk_state *const s = t->state;
    vtk_cells_free(&s->cells);
    free(s->first);
    free(s->position);
}

const trajectory_format trajectory_format_vtk = {
    .is_binary = 1,
    .is_series = 1,
    .state_size = sizeof(vtk_state),
    .begin = vtk_begin,
    .read = vtk_read,
    .end = vtk_end,
};
