/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * LAMMPS dump text: sections that begin with "ITEM:"; the last of a frame has the rows of atoms. Every section is
 * parsed anew: columns, count and box may change from frame to frame. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/lammps/lammps_parts.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* Sections of a frame. */
enum { HAS_STEP = 1, HAS_COUNT = 2, HAS_BOX = 4, HAS_OTHER = 8 };

typedef struct lammps_state {
    lammps_frame frame;
    unsigned seen; /* HAS_ bits of the current frame */
    int64_t step;
    uint32_t count;
    double time;
} lammps_state;

/* ---- Sections ----------------------------------------------------------------------------------------------- */

/* Reads the one word of the line that follows a section's heading. */
static int read_value(cgt_trajectory *t, text_span *word)
{
    text_span line;
    if (trajectory_line_inside(t, &line, "in the middle of a frame") < 0)
        return -1;
    if (!text_word(&line, word) || !text_is_blank(line))
        return trajectory_fail(t, t->text.line, "one value was expected on this line");
    return 1;
}

static int read_step(cgt_trajectory *t)
{
    lammps_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    text_span word;
    if (read_value(t, &word) < 0)
        return -1;
    if (!text_i64(word, &s->step))
        return trajectory_fail(t, t->text.line, "'%s' is not a time step", text_quote(word, quote));
    s->seen |= HAS_STEP;
    return 1;
}

static int read_count(cgt_trajectory *t)
{
    lammps_state *const s = t->state;
    text_span word;
    if (read_value(t, &word) < 0 || trajectory_parse_count(t, word, &s->count) < 0)
        return -1;
    s->seen |= HAS_COUNT;
    return 1;
}

/* Removes `heading` from the front of a line. Returns 1, or 0 where the line does not begin with it. */
static int take_heading(text_span *line, const char *heading)
{
    const size_t length = strlen(heading);
    if (!text_begins(*line, heading) || (text_length(*line) > length && line->begin[length] != ' '))
        return 0;
    line->begin += length;
    return 1;
}

/* Refuses a second section of a kind: the frame before had no atoms, so something is lost. */
static int check_first(cgt_trajectory *t, unsigned section)
{
    const lammps_state *const s = t->state;
    if (s->seen & section)
        return trajectory_fail(t, t->text.line, "the frame before this line has no ITEM: ATOMS");
    return 1;
}

/* Reads a section. Returns 1, 2 for the heading of the atoms, or -1. */
static int read_section(cgt_trajectory *t, text_span line)
{
    lammps_state *const s = t->state;
    char quote[TEXT_QUOTE_SIZE];
    text_span word;
    if (take_heading(&line, "ITEM: TIMESTEP"))
        return check_first(t, HAS_STEP) < 0 ? -1 : read_step(t);
    if (take_heading(&line, "ITEM: NUMBER OF ATOMS"))
        return check_first(t, HAS_COUNT) < 0 ? -1 : read_count(t);
    if (take_heading(&line, "ITEM: BOX BOUNDS")) {
        if (check_first(t, HAS_BOX) < 0 || lammps_read_box(t, line, &s->frame.box) < 0)
            return -1;
        s->seen |= HAS_BOX;
        s->frame.has_box = 1;
        return 1;
    }
    if (take_heading(&line, "ITEM: TIME")) {
        s->seen |= HAS_OTHER;
        if (read_value(t, &word) < 0)
            return -1;
        s->time = text_double(word, &s->time) ? s->time : NAN;
        return 1;
    }
    if (take_heading(&line, "ITEM: UNITS")) {
        s->seen |= HAS_OTHER;
        return read_value(t, &word);
    }
    if (!take_heading(&line, "ITEM: ATOMS"))
        return trajectory_fail(t, t->text.line, "'%s' is not a section of a LAMMPS dump of atoms",
                               text_quote(line, quote));
    if (!(s->seen & HAS_STEP) || !(s->seen & HAS_COUNT))
        return trajectory_fail(t, t->text.line, "ITEM: ATOMS without %s before it",
                               s->seen & HAS_STEP ? "NUMBER OF ATOMS" : "TIMESTEP");
    return lammps_plan_columns(t, line) < 0 ? -1 : 2;
}

/* Reads a frame up to its atoms: 1, 0 at the end of the file, -1. */
static int read_head(cgt_trajectory *t)
{
    lammps_state *const s = t->state;
    s->seen = 0;
    s->frame.has_box = 0;
    s->time = NAN;
    while (1) {
        text_span line;
        const int status = trajectory_line(t, &line);
        if (status < 0)
            return -1;
        if (status == 0)
            return s->seen == 0 ? 0 : trajectory_fail(t, t->text.line, "the file ends before ITEM: ATOMS");
        if (s->seen == 0 && text_is_blank(line))
            continue;
        const int section = read_section(t, line);
        if (section < 0)
            return -1;
        if (section == 2)
            return 1;
    }
}

/* ---- The format --------------------------------------------------------------------------------------------- */

static int lammps_begin(cgt_trajectory *t)
{
    (void)t;
    return 1;
}

static int lammps_read(cgt_trajectory *t, cgt_trajectory_frame *frame)
{
    lammps_state *const s = t->state;
    const int status = read_head(t);
    if (status <= 0)
        return status;
    trajectory_frame_fill(t, frame, s->count);
    frame->step = s->step;
    frame->time = s->time;
    lammps_set_box(t, frame);
    return rows_read(t, &s->frame.plan, s->count, lammps_finish_row, frame);
}

static int lammps_skip(cgt_trajectory *t)
{
    lammps_state *const s = t->state;
    cgt_trajectory_frame unused;
    const int status = read_head(t);
    if (status <= 0)
        return status;
    /* Words are numbered in order of appearance, so that frames with some must be read. */
    if (!(s->frame.plan.roles & ROW_BIT(ROW_NAME)) && !t->columns.has_words)
        return rows_skip(t, &s->frame.plan, s->count);
    return rows_read(t, &s->frame.plan, s->count, lammps_finish_row, &unused);
}

const trajectory_format trajectory_format_lammps = {
    .is_series = 1,
    .is_followed = 1,
    .gives_arrays = 1,
    .state_size = sizeof(lammps_state),
    .begin = lammps_begin,
    .read = lammps_read,
    .skip = lammps_skip,
};
