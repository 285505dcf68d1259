/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows of text into the arrays of a frame. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/trajectory_row.h"

#include <inttypes.h>
#include <string.h>

void row_plan_clear(row_plan *plan)
{
    plan->columns = 0;
    plan->open_ended = 0;
    plan->scaled = 0;
    plan->roles = 0;
}

int row_plan_add(trajectory *t, row_plan *plan, row_role role)
{
    if (plan->columns == ROW_MOST_COLUMNS) {
        return trajectory_fail(t, t->text.line, "more than %d columns", ROW_MOST_COLUMNS);
    }
    const unsigned bit = ROW_BIT(role);
    plan->role[plan->columns++] = (uint8_t)(plan->roles & bit ? ROW_UNUSED : role);
    plan->roles |= bit;
    return 1;
}

/* ---- One row ------------------------------------------------------------------------------------------------ */

static int parse_u32(text_span word, uint32_t *value)
{
    uint64_t number;
    if (!text_u64(word, UINT32_MAX, &number)) {
        return 0;
    }
    *value = (uint32_t)number;
    return 1;
}

/* Parses a word according to its role. Returns NULL, or what the word should have been. */
static const char *parse_value(const row_plan *plan, row_role role, text_span word, row *r)
{
    float number;
    switch (role) {
    case ROW_UNUSED: return NULL;
    case ROW_NAME: r->name = word; return NULL;
    case ROW_ID: return parse_u32(word, &r->id) ? NULL : "an id from 0 to 4294967295";
    case ROW_TYPE: return parse_u32(word, &r->type) ? NULL : "a type from 0 to 4294967295";
    case ROW_DIAMETER:
        if (!text_float(word, &number)) {
            return "a number";
        }
        if (!(plan->roles & ROW_BIT(ROW_RADIUS))) {
            r->value[ROW_RADIUS] = 0.5f * number;
        }
        return NULL;
    case ROW_X:
    case ROW_Y:
    case ROW_Z:
        if (plan->scaled) {
            return text_double(word, &r->fraction[role - ROW_X]) ? NULL : "a number";
        }
        break;
    case ROW_RADIUS:
    case ROW_VX:
    case ROW_VY:
    case ROW_VZ: break;
    }
    return text_float(word, &r->value[role]) ? NULL : "a number";
}

static int parse_row(trajectory *t, const row_plan *plan, text_span line, row *r)
{
    char quote[TEXT_QUOTE_SIZE];
    text_span word;
    for (uint32_t column = 0; column < plan->columns; column++) {
        if (!text_word(&line, &word)) {
            return trajectory_fail(t, t->text.line, "%" PRIu32 " columns where %" PRIu32 " are expected", column,
                                   plan->columns);
        }
        const char *expected = parse_value(plan, (row_role)plan->role[column], word, r);
        if (expected != NULL) {
            return trajectory_fail(t, t->text.line, "column %" PRIu32 ": '%s' is not %s", column + 1,
                                   text_quote(word, quote), expected);
        }
    }
    if (!plan->open_ended && text_word(&line, &word)) {
        return trajectory_fail(t, t->text.line, "more than the expected %" PRIu32 " columns: '%s'", plan->columns,
                               text_quote(word, quote));
    }
    return 1;
}

static void store_row(trajectory_store *s, size_t i, unsigned roles, const row *r)
{
    memcpy(s->xyzr + 4 * i, r->value + ROW_X, 4 * sizeof *s->xyzr);
    if (roles & ROW_BIT(ROW_ID)) {
        s->id[i] = r->id;
    }
    if (roles & (ROW_BIT(ROW_TYPE) | ROW_BIT(ROW_NAME))) {
        s->type[i] = r->type;
    }
    if ((roles & ROW_VELOCITY) == ROW_VELOCITY) {
        memcpy(s->velocity + 3 * i, r->value + ROW_VX, 3 * sizeof *s->velocity);
    }
}

/* ---- All rows of a frame ------------------------------------------------------------------------------------ */

/* Reads the next row's line. A simulator killed and restarted leaves half a frame and then a new one. */
static int next_row(trajectory *t, uint32_t done, uint32_t count, text_span *line)
{
    const int status = trajectory_line(t, line);
    if (status == 0) {
        return trajectory_fail(t, t->text.line, "the file ends after %" PRIu32 " of %" PRIu32 " spheres: it is cut off",
                               done, count);
    }
    if (status > 0 && text_begins(*line, "ITEM:")) {
        return trajectory_fail(t, t->text.line,
                               "a new section after %" PRIu32 " of %" PRIu32 " spheres: the frame is cut off", done,
                               count);
    }
    return status;
}

int rows_read(trajectory *t, const row_plan *plan, uint32_t count, row_finish *finish, trajectory_frame *frame)
{
    if (trajectory_reserve(t, 0, count) < 0) {
        return -1;
    }
    for (uint32_t i = 0; i < count; i++) {
        text_span line;
        row r;
        if (next_row(t, i, count, &line) < 0 || parse_row(t, plan, line, &r) < 0 || finish(t, &r) < 0 ||
            trajectory_reserve(t, (size_t)i + 1, count) < 0) {
            return -1;
        }
        store_row(&t->store, i, plan->roles, &r);
    }
    const unsigned roles = plan->roles;
    frame->xyzr = t->store.xyzr;
    frame->id = roles & ROW_BIT(ROW_ID) ? t->store.id : NULL;
    frame->type = roles & (ROW_BIT(ROW_TYPE) | ROW_BIT(ROW_NAME)) ? t->store.type : NULL;
    frame->velocity = (roles & ROW_VELOCITY) == ROW_VELOCITY ? t->store.velocity : NULL;
    return 1;
}

int rows_skip(trajectory *t, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        text_span line;
        if (next_row(t, i, count, &line) < 0) {
            return -1;
        }
    }
    return 1;
}
