/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Rows of text into the arrays of a frame. */
#define _POSIX_C_SOURCE 200809L
#include "trajectory/text/text_rows.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

void row_plan_clear(row_plan *plan)
{
    plan->columns = 0;
    plan->open_ended = 0;
    plan->scaled = 0;
    plan->labels = NULL;
    plan->names = NULL;
    plan->names_may_be_types = 0;
    plan->place = NULL;
    plan->roles = 0;
    plan->has_element = 0;
    plan->serial = 0;
}

int row_plan_add(cgt_trajectory *t, row_plan *plan, row_role role, text_span name, cgt_trajectory_column_kind kind)
{
    if (plan->columns == ROW_MOST_COLUMNS)
        return trajectory_fail(t, t->text.line, "more than %d columns", ROW_MOST_COLUMNS);
    const unsigned bit = ROW_BIT(role);
    const int slot = columns_add(t, name, kind);
    if (slot < 0)
        return -1;
    plan->slot[plan->columns] = (uint16_t)slot;
    plan->kind[plan->columns] = (uint8_t)kind;
    plan->role[plan->columns++] = (uint8_t)(plan->roles & bit ? ROW_UNUSED : role);
    plan->roles |= bit;
    return 1;
}

/* ---- One row ------------------------------------------------------------------------------------------------ */

/* A whole number; a program that formats all columns alike writes 1.0. */
static int parse_u64(text_span word, uint64_t max, uint64_t *value)
{
    double number;
    if (text_u64(word, max, value))
        return 1;
    const double exact = 9007199254740992.0; /* 2^53: whole numbers below are exact */
    if (memchr(word.begin, '.', text_length(word)) == NULL || !text_double(word, &number) ||
        !(number >= 0.0 && number < exact && number == floor(number) && (uint64_t)number <= max))
        return 0;
    *value = (uint64_t)number;
    return 1;
}

static int parse_u32(text_span word, uint32_t *value)
{
    uint64_t number;
    if (!parse_u64(word, UINT32_MAX, &number))
        return 0;
    *value = (uint32_t)number;
    return 1;
}

/* Simulators with ids of 64 bits use them beyond 2^32 only where there are as many atoms, or where atoms are created
 * all the time; those of one frame rarely differ by a multiple of 2^32. */
static int parse_id(cgt_trajectory *t, text_span word, uint32_t *id)
{
    uint64_t number;
    if (!parse_u64(word, UINT64_MAX, &number))
        return 0;
    if (number > UINT32_MAX)
        trajectory_warn(t, DOUBT_WIDE_IDS, t->text.line, TRAJECTORY_WIDE_IDS);
    *id = (uint32_t)number;
    return 1;
}

/* A type is a number, or a label where the plan allows it. */
static int parse_type(const row_plan *plan, text_span word, uint32_t *type)
{
    const char *reason;
    double number;
    if (parse_u32(word, type))
        return 1;
    if (plan->labels == NULL || text_double(word, &number))
        return 0;
    *type = name_table_find(plan->labels, word, &reason);
    return *type != 0;
}

/* Parses a word according to its role. Returns NULL, or what the word should have been. */
static const char *parse_value(cgt_trajectory *t, const row_plan *plan, row_role role, text_span word, row *r)
{
    float number;
    switch (role) {
    case ROW_UNUSED: return NULL;
    case ROW_NAME: r->name = word; return NULL;
    case ROW_ID: return parse_id(t, word, &r->id) ? NULL : "an id, a whole number of 64 bits";
    case ROW_TYPE: return parse_type(plan, word, &r->type) ? NULL : "a type from 0 to 4294967295";
    case ROW_NUMBER: return parse_u32(word, &r->number) ? NULL : "an atomic number";
    case ROW_DIAMETER:
        if (!text_float(word, &number))
            return "a number";
        if (!(plan->roles & ROW_BIT(ROW_RADIUS)))
            r->value[ROW_RADIUS] = 0.5f * number;
        return NULL;
    case ROW_X:
    case ROW_Y:
    case ROW_Z:
        if (plan->scaled & (1u << (role - ROW_X)))
            return text_double(word, &r->fraction[role - ROW_X]) ? NULL : "a number";
        return trajectory_text_place(t, role - ROW_X, word, &r->value[role]) ? NULL : "a number";
    case ROW_RADIUS:
    case ROW_VX:
    case ROW_VY:
    case ROW_VZ: break;
    }
    return text_float(word, &r->value[role]) ? NULL : "a number";
}

/* A logical value, as extended .xyz writes it. */
static int parse_logical(text_span word, float *value)
{
    static const char *const names[] = {"F", "False", "false", "FALSE", "T", "True", "true", "TRUE"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (text_is(word, names[i])) {
            *value = i < 4 ? 0.0f : 1.0f;
            return 1;
        }
    }
    return 0;
}

/* Stores value i of a column that is wanted under its name. Returns NULL, or what the word should have been. */
static const char *store_wanted(cgt_trajectory *t, const row_plan *plan, uint32_t column, text_span word, size_t i,
                                const row *r)
{
    const int slot = plan->slot[column];
    float *const value = columns_values(t, slot) + i;
    switch (plan->kind[column]) {
    case CGT_TRAJECTORY_WORD: columns_store_word(t, slot, i, word); return NULL;
    case CGT_TRAJECTORY_WHOLE:
        if (plan->role[column] == ROW_TYPE) { /* the word may be a label */
            *value = (float)r->type;
            return NULL;
        }
        return text_float(word, value) || parse_logical(word, value) ? NULL : "a whole number";
    default: return text_float(word, value) ? NULL : "a number";
    }
}

static int parse_row(cgt_trajectory *t, const row_plan *plan, text_span line, size_t i, row *r)
{
    char quote[TEXT_QUOTE_SIZE];
    text_span word;
    for (uint32_t column = 0; column < plan->columns; column++) {
        if (!text_word(&line, &word))
            return trajectory_fail(t, t->text.line, "%" PRIu32 " columns where %" PRIu32 " are expected", column,
                                   plan->columns);
        const char *expected = parse_value(t, plan, (row_role)plan->role[column], word, r);
        if (expected == NULL && plan->slot[column] != 0)
            expected = store_wanted(t, plan, column, word, i, r);
        if (expected != NULL)
            return trajectory_fail(t, t->text.line, "column %" PRIu32 ": '%s' is not %s", column + 1,
                                   text_quote(word, quote), expected);
    }
    if (!plan->open_ended && text_word(&line, &word))
        return trajectory_fail(t, t->text.line, "more than the expected %" PRIu32 " columns: '%s'", plan->columns,
                               text_quote(word, quote));
    return 1;
}

void row_store(trajectory_store *s, size_t i, unsigned roles, const row *r)
{
    memcpy(s->xyzr + 4 * i, r->value + ROW_X, 4 * sizeof *s->xyzr);
    if (roles & ROW_BIT(ROW_ID))
        s->id[i] = r->id;
    if (roles & ROW_TYPES)
        s->type[i] = r->type;
    if (roles & ROW_ELEMENTS)
        s->element[i] = r->element;
    if ((roles & ROW_VELOCITY) == ROW_VELOCITY)
        memcpy(s->velocity + 3 * i, r->value + ROW_VX, 3 * sizeof *s->velocity);
}

void rows_fill(cgt_trajectory *t, const row_plan *plan, cgt_trajectory_frame *frame)
{
    const unsigned roles = plan->roles;
    frame->xyzr = t->store.xyzr;
    frame->id = roles & ROW_BIT(ROW_ID) ? t->store.id : NULL;
    frame->type = roles & ROW_TYPES ? t->store.type : NULL;
    frame->velocity = (roles & ROW_VELOCITY) == ROW_VELOCITY ? t->store.velocity : NULL;
    frame->has_radius = (roles & (ROW_BIT(ROW_RADIUS) | ROW_BIT(ROW_DIAMETER))) != 0;
    frame->element = plan->has_element ? t->store.element : NULL;
}

/* ---- Rows of numbers ---------------------------------------------------------------------------------------- */

/* A whole number of 0 or more; what is none becomes 0. */
static uint64_t to_whole(double number)
{
    return number >= 0.0 && number < 18446744073709549568.0 ? (uint64_t)number : 0;
}

static void take_number(const cgt_trajectory *t, const row_plan *plan, row_role role, double number, row *r)
{
    switch (role) {
    case ROW_UNUSED: return;
    case ROW_ID: r->id = (uint32_t)to_whole(number); return;
    case ROW_TYPE: r->type = (uint32_t)to_whole(number); return;
    case ROW_NUMBER: r->number = (uint32_t)to_whole(number); return;
    case ROW_NAME:
        if (!(plan->roles & ROW_BIT(ROW_TYPE)))
            r->type = (uint32_t)to_whole(number);
        return;
    case ROW_DIAMETER:
        if (!(plan->roles & ROW_BIT(ROW_RADIUS)))
            r->value[ROW_RADIUS] = 0.5f * (float)number;
        return;
    case ROW_X:
    case ROW_Y:
    case ROW_Z:
        if (plan->scaled & (1u << (role - ROW_X)))
            r->fraction[role - ROW_X] = number;
        else
            r->value[role] = trajectory_place(t, role - ROW_X, number);
        return;
    case ROW_RADIUS:
    case ROW_VX:
    case ROW_VY:
    case ROW_VZ: break;
    }
    r->value[role] = (float)number;
}

int row_store_numbers(cgt_trajectory *t, row_plan *plan, size_t i, const double *numbers, row_finish *finish)
{
    row r = {0};
    for (uint32_t column = 0; column < plan->columns; column++) {
        const row_role role = (row_role)plan->role[column];
        take_number(t, plan, role, numbers[column], &r);
        if (role == ROW_ID && numbers[column] > (double)UINT32_MAX)
            trajectory_warn(t, DOUBT_WIDE_IDS, 0, TRAJECTORY_WIDE_IDS);
        if (plan->slot[column] != 0)
            columns_values(t, plan->slot[column])[i] = (float)numbers[column];
    }
    if (finish(t, &r) < 0)
        return -1;
    row_store(&t->store, i, plan->roles, &r);
    return 1;
}

/* ---- Names -------------------------------------------------------------------------------------------------- */

int row_name(cgt_trajectory *t, name_table *names, text_span name, row *r, uint32_t *type, float *radius)
{
    char quote[TEXT_QUOTE_SIZE];
    const char *reason = "";
    const uint32_t known = names->count;
    *type = name_table_type(names, name, &reason);
    if (*type > NAMES_MOST) {
        element_reading reading;
        r->element = (uint8_t)element_find(name, &reading);
        *radius = element_radius(r->element);
        trajectory_warn_names(t, t->text.line);
        return 1;
    }
    if (*type == 0)
        return trajectory_fail(t, t->text.line, "'%s': %s", text_quote(name, quote), reason);
    *radius = names->radius[*type - 1];
    r->element = names->element[*type - 1];
    if (names->count > known) {
        element_reading reading;
        const char *symbol = element_symbol(element_find(name, &reading));
        if (*element_symbol(r->element) == '\0')
            return 1;
        if (reading == ELEMENT_LABEL)
            trajectory_warn(t, DOUBT_LABEL, t->text.line,
                            "'%s' is no element: such names are read as labels of atoms, this one as %s",
                            text_quote(name, quote), symbol);
        else if (reading == ELEMENT_EITHER)
            trajectory_warn(t, DOUBT_SYMBOL, t->text.line,
                            "'%s' is read as the element %s; as the label of an atom in a molecule it would be %c",
                            text_quote(name, quote), symbol, symbol[0]);
    }
    return 1;
}

int row_atomic_number(cgt_trajectory *t, name_table *names, row *r, uint32_t *type, float *radius)
{
    const char *symbol = element_symbol(r->number);
    const char *name = *symbol != '\0' ? symbol : "X";
    return row_name(t, names, (text_span){name, name + strlen(name)}, r, type, radius);
}

/* ---- All rows of a frame ------------------------------------------------------------------------------------ */

/* Reads the next row's line. A simulator killed and restarted leaves half a frame and then a new one. */
static int next_row(cgt_trajectory *t, uint32_t done, uint32_t count, text_span *line)
{
    const int status = trajectory_line(t, line);
    if (status == 0)
        return trajectory_fail(t, t->text.line, "the file ends after %" PRIu32 " of %" PRIu32 " spheres: it is cut off",
                               done, count);
    if (status > 0 && text_begins(*line, "ITEM:"))
        return trajectory_fail(t, t->text.line,
                               "a new section after %" PRIu32 " of %" PRIu32 " spheres: the frame is cut off", done,
                               count);
    return status;
}

/* Reads row i by itself, whatever its form. */
static int read_row(cgt_trajectory *t, row_plan *plan, uint32_t i, uint32_t count, row_finish *finish)
{
    text_span line;
    row r;
    r.element = 0;
    if (next_row(t, i, count, &line) < 0 || trajectory_reserve(t, (size_t)i + 1, count) < 0 ||
        parse_row(t, plan, line, i, &r) < 0 || finish(t, &r) < 0)
        return -1;
    plan->has_element |= r.element != 0;
    row_store(&t->store, i, plan->roles, &r);
    return 1;
}

int rows_read(cgt_trajectory *t, row_plan *plan, uint32_t count, row_finish *finish, cgt_trajectory_frame *frame)
{
    if (trajectory_reserve(t, 0, count) < 0)
        return -1;
    const int is_fast = rows_can_be_fast(t, plan);
    for (uint32_t i = 0; i < count;) {
        const int64_t rows = is_fast ? rows_read_fast(t, plan, i, count) : 0;
        if (rows < 0)
            return -1;
        i += (uint32_t)rows;
        plan->serial -= rows < plan->serial ? (uint32_t)rows : plan->serial;
        if (rows == 0) {
            if (read_row(t, plan, i, count, finish) < 0)
                return -1;
            i++;
        }
    }
    rows_fill(t, plan, frame);
    return 1;
}

/* Labels of types are numbered in order of appearance, those of rows that are skipped, too. */
static void number_label(const row_plan *plan, text_span line, uint32_t column)
{
    text_span word = {line.begin, line.begin};
    uint32_t type;
    for (uint32_t i = 0; i <= column; i++)
        if (!text_word(&line, &word))
            return;
    parse_type(plan, word, &type);
}

int rows_skip(cgt_trajectory *t, const row_plan *plan, uint32_t count)
{
    uint32_t column = 0;
    while (column < plan->columns && plan->role[column] != ROW_TYPE)
        column++;
    const int has_type = plan->labels != NULL && column < plan->columns;
    for (uint32_t i = 0; i < count; i++) {
        text_span line;
        if (next_row(t, i, count, &line) < 0)
            return -1;
        if (has_type)
            number_label(plan, line, column);
    }
    return 1;
}
