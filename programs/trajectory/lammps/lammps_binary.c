/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Binary LAMMPS dumps, as tools/binary2txt of LAMMPS reads them. For each frame the step, the count, the box, the
 * number of columns, then chunks of doubles, one from each process. Since 2020 a frame begins with a negative number,
 * the length of a magic word that follows, a mark of the byte order and a revision; since revision 2 units, time and
 * names of the columns are there, too. Older files have no names. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/binary/binary_reader.h"
#include "trajectory/lammps/lammps_parts.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAGIC_LONGEST 64
#define WORDS_LONGEST (1u << 16) /* bytes of the names of all columns */
#define MOST_CHUNKS (1u << 24)

typedef struct binary_state {
    lammps_frame frame; /* first: lammps_columns.h */
    binary_reader in;
    int has_order; /* the byte order is known */
    int64_t step;
    uint64_t count;
    double time;
    uint32_t columns; /* numbers in a row */
    int is_atom;      /* the magic word is that of dump atom */
    char *names;      /* of the columns, of the last frame; "" where it has none */
    double *row;
    unsigned char *bytes; /* of it in the file */
} binary_state;

static const char head[] = "the header of a frame";

/* ---- Header ------------------------------------------------------------------------------------------------- */

static int64_t to_signed(uint64_t bits)
{
    int64_t value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static int is_magic_length(int64_t value) { return value < 0 && value >= -MAGIC_LONGEST; }

/* Whether the numbers after the step make sense in this order: the count, and whether the box is tilted. */
static int is_order(const unsigned char *bytes, int is_big, uint64_t most)
{
    return binary_get_u64(bytes, is_big) <= most && binary_get_u32(bytes + 8, is_big) <= 2;
}

/* Reads magic word, byte order and revision. */
static int read_magic(cgt_trajectory *t, size_t length, uint32_t *revision)
{
    binary_state *const s = t->state;
    char magic[MAGIC_LONGEST + 1] = "";
    uint32_t order;
    uint64_t step;
    if (binary_bytes(&s->in, magic, length, head) < 0 || binary_u32(&s->in, &order, head) < 0 ||
        binary_u32(&s->in, revision, head) < 0 || binary_u64(&s->in, &step, head) < 0)
        return -1;
    if (strncmp(magic, "DUMP", 4) != 0 || order != 1)
        return trajectory_fail(t, 0, "not a binary LAMMPS dump of this kind: the first word is not DUMP...");
    s->is_atom = strcmp(magic, "DUMPATOM") == 0;
    s->step = to_signed(step);
    return 1;
}

/* Reads a frame's first numbers, from the step to the count and the box's kind: 1, 0 at the end, -1. */
static int read_start(cgt_trajectory *t, uint32_t *revision, uint32_t *kind)
{
    binary_state *const s = t->state;
    unsigned char bytes[20];
    const int status = binary_bytes_or_end(&s->in, bytes, 8, head);
    if (status <= 0)
        return status;
    *revision = 0;
    s->is_atom = 0;
    const int64_t little = to_signed(binary_get_u64(bytes, 0)), big = to_signed(binary_get_u64(bytes, 1));
    if (!s->has_order && (is_magic_length(little) || is_magic_length(big))) {
        s->in.is_big = is_magic_length(big);
        s->has_order = 1;
    }
    const int64_t first = s->in.is_big ? big : little;
    if (s->has_order && is_magic_length(first)) {
        if (read_magic(t, (size_t)-first, revision) < 0)
            return -1;
    }
    if (binary_bytes(&s->in, bytes + 8, 12, head) < 0)
        return -1;
    if (!s->has_order) {
        s->in.is_big = !is_order(bytes + 8, 0, t->options.max_count) && is_order(bytes + 8, 1, t->options.max_count);
        s->has_order = 1;
    }
    if (*revision == 0)
        s->step = to_signed(binary_get_u64(bytes, s->in.is_big));
    s->count = binary_get_u64(bytes + 8, s->in.is_big);
    *kind = binary_get_u32(bytes + 16, s->in.is_big);
    if (*kind > 2)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": not a binary LAMMPS dump, or damaged", t->next);
    return binary_check_count(&s->in, s->count);
}

static int read_doubles(cgt_trajectory *t, double *values, int count)
{
    binary_state *const s = t->state;
    for (int i = 0; i < count; i++) {
        if (binary_f64(&s->in, &values[i], head) < 0)
            return -1;
        if (!isfinite(values[i]))
            return trajectory_fail(t, 0, "frame %" PRIu64 ": a bound of the box is not a number", t->next);
    }
    return 1;
}

/* kind: 0 along the axes, 1 tilted, 2 three vectors and the corner. */
static int read_box(cgt_trajectory *t, uint32_t kind)
{
    binary_state *const s = t->state;
    lammps_box *const box = &s->frame.box;
    int32_t boundary[6];
    double values[12], lines[3][4] = {{0}};
    for (int i = 0; i < 6; i++)
        if (binary_i32(&s->in, &boundary[i], head) < 0)
            return -1;
    for (int axis = 0; axis < 3; axis++)
        box->periodic[axis] = boundary[2 * axis] == 0 && boundary[2 * axis + 1] == 0;
    if (read_doubles(t, values, kind == 0 ? 6 : kind == 1 ? 9 : 12) < 0)
        return -1;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            lines[i][k] = kind == 2 ? values[3 * i + k] : k < 2 ? values[2 * i + k] : kind == 1 ? values[6 + i] : 0.0;
        lines[i][3] = kind == 2 ? values[9 + i] : 0.0;
        if (kind < 2 && lines[i][0] > lines[i][1])
            return trajectory_fail(t, 0, "frame %" PRIu64 ": the lower bound of the box is above the upper one",
                                   t->next);
    }
    lammps_make_box(box, kind == 2, lines);
    s->frame.has_box = 1;
    return 1;
}

/* A string after its length; *text is allocated. */
static int read_string(cgt_trajectory *t, char **text)
{
    binary_state *const s = t->state;
    int32_t length;
    if (binary_i32(&s->in, &length, head) < 0)
        return -1;
    if (length < 0 || (uint32_t)length > WORDS_LONGEST)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": a string of %" PRId32 " bytes: damaged", t->next, length);
    free(*text);
    *text = malloc((size_t)length + 1);
    if (*text == NULL)
        return trajectory_fail(t, 0, "not enough memory");
    (*text)[length] = '\0';
    return binary_bytes(&s->in, *text, (size_t)length, head);
}

/* Units, time and names, since revision 2. */
static int read_extras(cgt_trajectory *t)
{
    binary_state *const s = t->state;
    unsigned char has_time;
    if (read_string(t, &s->names) < 0 || binary_bytes(&s->in, &has_time, 1, head) < 0 ||
        (has_time && binary_f64(&s->in, &s->time, head) < 0))
        return -1;
    return read_string(t, &s->names);
}

/* Old files: the columns are not named. Those of dump atom are known by their number. */
static const char *guess_columns(cgt_trajectory *t)
{
    const binary_state *const s = t->state;
    const char *names = s->columns == 5 ? "id type xs ys zs" : s->columns == 8 ? "id type xs ys zs ix iy iz" : NULL;
    if (names != NULL && !s->is_atom)
        trajectory_warn(t, DOUBT_OLD_COLUMNS, 0,
                        "the file does not name its %" PRIu32 " columns: they are taken for %s", s->columns, names);
    return names;
}

static int plan_columns(cgt_trajectory *t)
{
    binary_state *const s = t->state;
    const char *names = s->names != NULL && *s->names != '\0' ? s->names : guess_columns(t);
    if (names == NULL)
        return trajectory_fail(t, 0,
                               "the file does not name its %" PRIu32
                               " columns, which only LAMMPS since 2020 does: turn "
                               "it into text with LAMMPS' binary2txt, and add the names",
                               s->columns);
    s->frame.is_binary = 1;
    if (lammps_plan_columns(t, (text_span){names, names + strlen(names)}) < 0)
        return -1;
    if (s->frame.plan.columns != s->columns)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu32 " names of %" PRIu32 " columns", t->next,
                               s->frame.plan.columns, s->columns);
    const int missing =
        trajectory_grow(&s->row, s->columns, sizeof *s->row) || trajectory_grow(&s->bytes, s->columns, 8);
    return missing ? trajectory_fail(t, 0, "not enough memory") : 1;
}

/* Reads a frame's header: 1, 0 at the end of the file, -1. */
static int read_head(cgt_trajectory *t)
{
    binary_state *const s = t->state;
    uint32_t revision, kind;
    const int status = read_start(t, &revision, &kind);
    if (status <= 0)
        return status;
    s->time = NAN;
    free(s->names);
    s->names = NULL;
    if (read_box(t, kind) < 0 || binary_u32(&s->in, &s->columns, head) < 0 || (revision >= 2 && read_extras(t) < 0))
        return -1;
    if (s->columns == 0 || s->columns > ROW_MOST_COLUMNS)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu32 " columns: damaged", t->next, s->columns);
    return 1;
}

/* ---- Rows --------------------------------------------------------------------------------------------------- */

static int read_row(cgt_trajectory *t, size_t i)
{
    binary_state *const s = t->state;
    if (binary_bytes(&s->in, s->bytes, 8 * (size_t)s->columns, "the rows of a frame") < 0)
        return -1;
    for (uint32_t k = 0; k < s->columns; k++)
        s->row[k] = binary_get_f64(s->bytes + 8 * (size_t)k, s->in.is_big);
    return row_store_numbers(t, &s->frame.plan, i, s->row, lammps_finish_row);
}

/* Reads or skips the chunks, which together have all rows. */
static int read_chunks(cgt_trajectory *t, int skips)
{
    binary_state *const s = t->state;
    uint32_t chunks;
    uint64_t done = 0;
    if (binary_u32(&s->in, &chunks, head) < 0)
        return -1;
    if (chunks > MOST_CHUNKS)
        return trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu32 " chunks: damaged", t->next, chunks);
    for (uint32_t chunk = 0; chunk < chunks; chunk++) {
        uint32_t numbers;
        if (binary_u32(&s->in, &numbers, head) < 0 ||
            binary_expect(&s->in, 8 * (uint64_t)numbers, "the rows of a frame") < 0)
            return -1;
        const uint64_t rows = numbers / s->columns;
        if (numbers % s->columns != 0 || rows > s->count - done)
            return trajectory_fail(t, 0, "frame %" PRIu64 ": a chunk of %" PRIu32 " numbers does not fit: damaged",
                                   t->next, numbers);
        if (skips && binary_skip(&s->in, 8 * (uint64_t)numbers, "the rows of a frame") < 0)
            return -1;
        for (uint64_t i = 0; i < rows && !skips; i++)
            if (trajectory_reserve(t, (size_t)(done + i) + 1, (size_t)s->count) < 0 ||
                read_row(t, (size_t)(done + i)) < 0)
                return -1;
        done += rows;
    }
    return done == s->count ? 1
                            : trajectory_fail(t, 0, "frame %" PRIu64 ": %" PRIu64 " rows of %" PRIu64 ": damaged",
                                              t->next, done, s->count);
}

/* ---- The format --------------------------------------------------------------------------------------------- */

static int binary_start(cgt_trajectory *t)
{
    binary_state *const s = t->state;
    binary_begin(&s->in, t, 0);
    s->has_order = 0;
    return 1;
}

static int binary_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    binary_state *const s = t->state;
    const int status = read_head(t);
    if (status <= 0)
        return status;
    if (plan_columns(t) < 0 || trajectory_reserve(t, 0, (size_t)s->count) < 0 || read_chunks(t, 0) < 0)
        return -1;
    trajectory_frame_fill(t, frame, (uint32_t)s->count);
    frame->step = s->step;
    frame->time = s->time;
    lammps_set_box(t, frame);
    rows_fill(t, &s->frame.plan, frame);
    return 1;
}

static int binary_skip_frame(cgt_trajectory *t)
{
    const int status = read_head(t);
    return status <= 0 ? status : read_chunks(t, 1);
}

static void binary_end(cgt_trajectory *t)
{
    binary_state *const s = t->state;
    free(s->names);
    free(s->row);
    free(s->bytes);
}

const trajectory_format trajectory_format_lammps_binary = {
    .is_binary = 1,
    .is_series = 1,
    .state_size = sizeof(binary_state),
    .begin = binary_start,
    .read = binary_read,
    .skip = binary_skip_frame,
    .end = binary_end,
};
