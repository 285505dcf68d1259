/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Formulas over columns: binding names to a frame, and computing; see expression.h. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "data/expression/expression_steps.h"
#include "data/molecule/residue_names.h"
#include "options/numbers.h"
#include "data/frame_access.h"

enum { BLOCK = 64 }; /* elements that go through all steps together */

/* ---- Binding ------------------------------------------------------------------------------------------------ */

/* What every frame has, or has in fields of its own. Returns 1 where the name is one of them. */
static int bind_field(const char *name, const cgt_trajectory_frame *f, const float *speed, expression_source *s)
{
    const int spheres = f->kind == CGT_TRAJECTORY_SPHERES;
    const float *places = spheres ? f->xyzr : f->position;
    *s = (expression_source){.stride = 1};
    if (strlen(name) == 1 && *name >= 'x' && *name <= 'z') {
        s->value = places + (*name - 'x');
        s->stride = spheres ? 4 : 3;
        s->number = f->origin[*name - 'x'];
    } else if (strcmp(name, "radius") == 0 && spheres) {
        s->value = places + 3;
        s->stride = 4;
    } else if (strcmp(name, "speed") == 0 && speed) {
        s->value = speed;
    } else if (strcmp(name, "id") == 0 && f->id) {
        s->whole = f->id;
    } else if (strcmp(name, "type") == 0 && f->type) {
        s->whole = f->type;
    } else if (strcmp(name, "element") == 0 && f->element) {
        s->byte = f->element;
    } else if (strcmp(name, "index") == 0) {
        s->is_index = 1;
    } else if (strcmp(name, "step") == 0) {
        s->number = (double)f->step;
    } else if (strcmp(name, "time") == 0) {
        s->number = f->time;
    } else {
        return 0;
    }
    return 1;
}

/* "x, y, z, radius, c_pe": what there is. */
static void list_columns(const cgt_trajectory_frame *f, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "x, y, z");
    for (uint32_t i = 0; i < f->columns && used < size; i++)
        if (strlen(f->column[i].name) != 1 || !strchr("xyz", *f->column[i].name))
            used += (size_t)snprintf(text + used, size - used, ", %s", f->column[i].name);
}

static int refuse(const cgt_trajectory_frame *f, char *error, size_t size, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
static int refuse(const cgt_trajectory_frame *f, char *error, size_t size, const char *format, ...)
{
    va_list arguments;
    const size_t used = (size_t)snprintf(error, size, "frame %llu ", (unsigned long long)f->number);
    va_start(arguments, format);
    vsnprintf(error + (used < size ? used : size), used < size ? size - used : 0, format, arguments);
    va_end(arguments);
    return -1;
}

/* The list that makes this name needed, for the sentence; NULL: none. */
static const char *list_of(const expression *e, uint32_t name)
{
    for (uint32_t i = 0; i < e->word_count; i++)
        if (e->words[i].column == name && e->words[i].list != EXPRESSION_LISTS)
            return e->words[i].text;
    return NULL;
}

static int bind_name(expression *e, uint32_t i, const cgt_trajectory_frame *frame, const float *speed, char *error,
                     size_t size)
{
    char columns[512];
    const cgt_trajectory_column *column = frame_column(frame, e->names[i]);
    if (bind_field(e->names[i], frame, speed, &e->sources[i]))
        return 0;
    if (column && column->value) {
        e->sources[i] = (expression_source){.value = column->value, .stride = 1};
        return 0;
    }
    if (!column && strcmp(e->names[i], "site") == 0) { /* frames without sites have no such column */
        e->sources[i] = (expression_source){.stride = 1};
        return 0;
    }
    const char *const list = list_of(e, i);
    list_columns(frame, columns, sizeof columns);
    return refuse(frame, error, size, "has no column \"%s\"%s%s, but %s", e->names[i],
                  list ? ", by which to know " : "", list ? list : "", columns);
}

/* The column of words that a name is bound to, or NULL. */
static const cgt_trajectory_column *words_of(const expression *e, uint32_t name, const cgt_trajectory_frame *frame)
{
    const cgt_trajectory_column *const column = frame_column(frame, e->names[name]);
    const int is_bound = column && column->value && e->sources[name].value == column->value;
    return is_bound && column->kind == CGT_TRAJECTORY_WORD ? column : NULL;
}

const cgt_trajectory_column *cgt_expression_words(const expression *e, const cgt_trajectory_frame *frame)
{
    return cgt_expression_is_name(e) && e->steps[0].name < EXPRESSION_NAMES ? words_of(e, e->steps[0].name, frame)
                                                                            : NULL;
}

/* The number of a word in its column: 0 is a blank, -1 no sphere has. */
static double find_word(const cgt_trajectory_column *column, const char *text)
{
    for (uint32_t v = 0; v < column->words; v++)
        if (strcmp(column->word[v], text) == 0)
            return v + 1.0;
    return *text ? -1.0 : 0.0;
}

/* Which words of the column are in the list. */
static void fill_members(const cgt_trajectory_column *column, expression_list list, uint8_t *member)
{
    static const char *const atoms[] = {"N", "CA", "C", "O"};
    member[0] = 0;
    for (uint32_t v = 0; v < column->words && v < EXPRESSION_MEMBERS; v++) {
        const char *const word = column->word[v];
        int is_atom = 0;
        for (size_t i = 0; i < sizeof atoms / sizeof atoms[0]; i++)
            is_atom |= strcmp(word, atoms[i]) == 0;
        member[v + 1] = (uint8_t)(list == LIST_PROTEIN ? residue_is_protein(word)
                                  : list == LIST_WATER ? residue_is_water(word)
                                                       : is_atom);
    }
}

static int refuse_number(const char *column, const char *example, const cgt_trajectory_frame *frame, char *error,
                         size_t size)
{
    return refuse(frame, error, size, "has words in the column \"%s\": compare by == or != with one in quotes, \"%s\"",
                  column, example);
}

/* The same, with a word of the column. */
static int refuse_words(const char *column, const cgt_trajectory_column *words, const cgt_trajectory_frame *frame,
                        char *error, size_t size)
{
    return refuse_number(column, words->words ? words->word[0] : "A", frame, error, size);
}

static int bind_word(expression *e, uint32_t i, const cgt_trajectory_frame *frame, const float *speed, char *error,
                     size_t size)
{
    const expression_word *const word = &e->words[i];
    const char *const name = e->names[word->column];
    expression_source *const to = &e->sources[EXPRESSION_NAMES + i];
    const cgt_trajectory_column *const words = words_of(e, word->column, frame);
    const int is_element = e->sources[word->column].byte != NULL;
    if (word->list != EXPRESSION_LISTS) {
        if (!words)
            return refuse(frame, error, size, "has numbers in the column \"%s\", by which to know %s", name,
                          word->text);
        fill_members(words, word->list, e->members[word->list]);
        *to = (expression_source){.value = words->value, .stride = 1, .member = e->members[word->list]};
        return 0;
    }
    if (!words && !is_element) {
        if (word->is_quoted)
            return refuse(frame, error, size, "has numbers in the column \"%s\": it is never the word \"%s\"", name,
                          word->text);
        const int failed = bind_name(e, word->bare, frame, speed, error, size);
        if (!failed && words_of(e, word->bare, frame))
            return refuse_words(word->text, words_of(e, word->bare, frame), frame, error, size);
        *to = e->sources[word->bare];
        return failed;
    }
    if (!word->is_quoted && frame_column(frame, word->text))
        return refuse(frame, error, size, "has words in \"%s\", and a column \"%s\": write the word in quotes", name,
                      word->text);
    *to = (expression_source){.number = words ? find_word(words, word->text) : element_named(word->text)};
    if (!words && to->number == 0.0)
        return refuse(frame, error, size, "has chemical elements in the column \"%s\", and \"%s\" is none", name,
                      word->text);
    return 0;
}

/* Whether a step pushes a column of words; NULL: what is pushed is computed. */
static int has_words(const expression *e, const expression_step *s, const cgt_trajectory_frame *frame)
{
    return s && s->op == OP_NAME && s->name < EXPRESSION_NAMES && words_of(e, s->name, frame) != NULL;
}

/* Whether a step pushes one word, not a list of them. */
static int is_word(const expression *e, const expression_step *s)
{
    return s && s->op == OP_NAME && s->name >= EXPRESSION_NAMES &&
           e->words[s->name - EXPRESSION_NAMES].list == EXPRESSION_LISTS;
}

/* Columns of words are compared with words, and may be a condition, or all of a formula: other operations would take
 * places in a list that nobody sees. Goes through the steps with what pushed each value of the stack. */
static int check_numbers(const expression *e, const cgt_trajectory_frame *frame, char *error, size_t size)
{
    const expression_step *stack[EXPRESSION_STACK] = {NULL};
    uint32_t top = 0;
    for (uint32_t k = 0; k < e->step_count; k++) {
        const expression_step *const s = &e->steps[k];
        const uint32_t operands = s->op <= OP_NAME ? 0 : s->op <= OP_SIGN ? 1 : s->op <= OP_MOD ? 2 : 3;
        const expression_step **const first = stack + top - operands;
        const int is_equality = s->op == OP_EQUAL || s->op == OP_UNEQUAL;
        const int is_comparison = s->op >= OP_LESS && s->op <= OP_UNEQUAL;
        const int is_condition = s->op == OP_NOT || s->op == OP_AND || s->op == OP_OR;
        for (uint32_t i = s->op == OP_IF; i < operands && !is_condition; i++) {
            if (!has_words(e, first[i], frame) || (is_equality && i == 0 && is_word(e, first[1])))
                continue;
            const expression_step *const other = is_comparison ? first[1 - i] : NULL;
            const uint32_t name = first[i]->name;
            return other && other->op == OP_NUMBER
                       ? refuse_number(e->names[name], cgt_number(6, other->number).text, frame, error, size)
                       : refuse_words(e->names[name], words_of(e, name, frame), frame, error, size);
        }
        top -= operands;
        stack[top++] = operands ? NULL : s;
    }
    return 0;
}

int cgt_expression_bind(expression *e, const cgt_trajectory_frame *frame, const float *speed, char *error,
                        size_t error_size)
{
    for (uint32_t i = 0; i < e->name_count; i++)
        if (e->is_needed[i] && bind_name(e, i, frame, speed, error, error_size))
            return -1;
    for (uint32_t i = 0; i < e->word_count; i++)
        if (bind_word(e, i, frame, speed, error, error_size))
            return -1;
    return check_numbers(e, frame, error, error_size);
}

/* ---- Computing ---------------------------------------------------------------------------------------------- */

static double member_of(const expression_source *s, size_t k)
{
    const float word = s->value[k];
    return word >= 0.0f && word <= (float)EXPRESSION_MEMBERS ? (double)s->member[(size_t)word] : 0.0;
}

static void load(const expression_source *s, uint32_t first, uint32_t count, double *to)
{
    for (uint32_t i = 0; i < count; i++) {
        const size_t k = (size_t)first + i;
        to[i] = s->member     ? member_of(s, k)
                : s->value    ? (double)s->value[k * s->stride] + s->number
                : s->whole    ? (double)s->whole[k]
                : s->byte     ? (double)s->byte[k]
                : s->is_index ? (double)k
                              : s->number;
    }
}

static double apply_one(expression_op op, double a)
{
    switch (op) {
    case OP_NEGATE: return -a;
    case OP_NOT: return !cgt_expression_holds(a);
    case OP_SQRT: return sqrt(a);
    case OP_ABS: return fabs(a);
    case OP_EXP: return exp(a);
    case OP_LOG: return log(a);
    case OP_LOG10: return log10(a);
    case OP_SIN: return sin(a);
    case OP_COS: return cos(a);
    case OP_TAN: return tan(a);
    case OP_FLOOR: return floor(a);
    case OP_CEIL: return ceil(a);
    default: return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : a;
    }
}

static double apply_two(expression_op op, double a, double b)
{
    switch (op) {
    case OP_ADD: return a + b;
    case OP_SUBTRACT: return a - b;
    case OP_MULTIPLY: return a * b;
    case OP_DIVIDE: return a / b;
    case OP_POWER: return b == 2.0 ? a * a : pow(a, b);
    case OP_LESS: return a < b;
    case OP_AT_MOST: return a <= b;
    case OP_GREATER: return a > b;
    case OP_AT_LEAST: return a >= b;
    case OP_EQUAL: return a == b;
    case OP_UNEQUAL: return a != b;
    case OP_AND: return cgt_expression_holds(a) && cgt_expression_holds(b);
    case OP_OR: return cgt_expression_holds(a) || cgt_expression_holds(b);
    case OP_MIN: return fmin(a, b);
    case OP_MAX: return fmax(a, b);
    default: return fmod(a, b);
    }
}

/* The parser has seen to it that steps find their values on the stack. NOLINTBEGIN(clang-analyzer-core.*) */
static void run_block(const expression *e, uint32_t first, uint32_t count, double stack[EXPRESSION_STACK][BLOCK])
{
    uint32_t top = 0; /* values on the stack */
    for (uint32_t k = 0; k < e->step_count; k++) {
        const expression_step *step = &e->steps[k];
        if (step->op == OP_NUMBER || step->op == OP_NAME) {
            if (step->op == OP_NAME)
                load(&e->sources[step->name], first, count, stack[top]);
            else
                for (uint32_t i = 0; i < count; i++)
                    stack[top][i] = step->number;
            top++;
        } else if (step->op <= OP_SIGN) {
            for (uint32_t i = 0; i < count; i++)
                stack[top - 1][i] = apply_one(step->op, stack[top - 1][i]);
        } else if (step->op <= OP_MOD) {
            top--;
            for (uint32_t i = 0; i < count; i++)
                stack[top - 1][i] = apply_two(step->op, stack[top - 1][i], stack[top][i]);
        } else {
            top -= 2;
            for (uint32_t i = 0; i < count; i++)
                stack[top - 1][i] = cgt_expression_holds(stack[top - 1][i]) ? stack[top][i] : stack[top + 1][i];
        }
    }
}
/* NOLINTEND(clang-analyzer-core.*) */

void cgt_expression_values(const expression *e, uint32_t first, uint32_t count, double *values)
{
    double stack[EXPRESSION_STACK][BLOCK];
    for (uint32_t done = 0; done < count; done += BLOCK) {
        const uint32_t block = count - done < BLOCK ? count - done : BLOCK;
        run_block(e, first + done, block, stack);
        memcpy(values + done, stack[0], block * sizeof *values);
    }
}
