/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Formulas over columns; see expression.h. The parser, by recursive descent, writes steps for a stack machine, each of
 * which works on a block of elements at a time (expression_run.c). */
#include "picture/figures/expression.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture/figures/expression_steps.h"

typedef struct parser {
    expression *e;
    const char *text, *at;
    uint32_t depth, nesting; /* values on the stack; calls of the parser */
    char *error;
    size_t error_size;
    int failed;
} parser;

typedef struct function_row {
    const char *name;
    expression_op op;
    int arguments;
} function_row;

static const function_row functions[] = {
    {"sqrt", OP_SQRT, 1}, {"abs", OP_ABS, 1}, {"exp", OP_EXP, 1}, {"log", OP_LOG, 1},     {"log10", OP_LOG10, 1},
    {"sin", OP_SIN, 1},   {"cos", OP_COS, 1}, {"tan", OP_TAN, 1}, {"floor", OP_FLOOR, 1}, {"ceil", OP_CEIL, 1},
    {"sign", OP_SIGN, 1}, {"min", OP_MIN, 2}, {"max", OP_MAX, 2}, {"mod", OP_MOD, 2},     {"if", OP_IF, 3}};

static void fail(parser *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void fail(parser *p, const char *format, ...)
{
    char problem[256];
    va_list arguments;
    if (p->failed)
        return;
    p->failed = 1;
    va_start(arguments, format);
    vsnprintf(problem, sizeof problem, format, arguments);
    va_end(arguments);
    snprintf(p->error, p->error_size, "\"%s\", at character %zu: %s", p->text, (size_t)(p->at - p->text) + 1, problem);
}

static void emit(parser *p, expression_op op, uint32_t name, double number, int takes)
{
    expression *e = p->e;
    if (p->failed)
        return;
    if (e->step_count == EXPRESSION_STEPS || p->depth + 1 > EXPRESSION_STACK + (uint32_t)takes) {
        fail(p, "the formula is too long");
        return;
    }
    e->steps[e->step_count++] = (expression_step){op, name, number};
    p->depth += 1 - (uint32_t)takes;
}

static void skip_space(parser *p)
{
    while (isspace((unsigned char)*p->at))
        p->at++;
}

static int accept(parser *p, const char *token)
{
    skip_space(p);
    const size_t length = strlen(token);
    if (strncmp(p->at, token, length) != 0)
        return 0;
    p->at += length;
    return 1;
}

static void parse_or(parser *p);

/* ---- Names -------------------------------------------------------------------------------------------------- */

static size_t name_length(const char *at)
{
    size_t length = 0;
    if (!isalpha((unsigned char)*at) && *at != '_')
        return 0;
    while (isalnum((unsigned char)at[length]) || (at[length] && strchr("_.:[]", at[length])))
        length++;
    return length;
}

static uint32_t add_name(parser *p, const char *text, size_t length)
{
    expression *e = p->e;
    for (uint32_t i = 0; i < e->name_count; i++)
        if (strlen(e->names[i]) == length && strncmp(e->names[i], text, length) == 0)
            return i;
    if (e->name_count == EXPRESSION_NAMES || length >= EXPRESSION_NAME_SIZE) {
        fail(p, "there are too many names, or one is too long");
        return 0;
    }
    memcpy(e->storage[e->name_count], text, length);
    e->names[e->name_count] = e->storage[e->name_count];
    return e->name_count++;
}

static void parse_call(parser *p, const function_row *f)
{
    for (int i = 0; i < f->arguments && !p->failed; i++) {
        if (i && !accept(p, ","))
            fail(p, "%s takes %d values", f->name, f->arguments);
        parse_or(p);
    }
    if (!accept(p, ")"))
        fail(p, "a ) is missing after the %d value%s of %s", f->arguments, f->arguments == 1 ? "" : "s", f->name);
    emit(p, f->op, 0, 0.0, f->arguments);
}

static void parse_name(parser *p, size_t length)
{
    const char *name = p->at;
    p->at += length;
    const char *after = p->at;
    if (accept(p, "(")) {
        for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++)
            if (strlen(functions[i].name) == length && strncmp(functions[i].name, name, length) == 0) {
                parse_call(p, &functions[i]);
                return;
            }
        p->at = name;
        fail(p, "there is no function %.*s", (int)length, name);
        return;
    }
    p->at = after;
    if (length == 2 && strncmp(name, "pi", 2) == 0)
        emit(p, OP_NUMBER, 0, 3.14159265358979323846, 0);
    else
        emit(p, OP_NAME, add_name(p, name, length), 0.0, 0);
}

/* ---- The grammar, from what binds tightest ------------------------------------------------------------------ */

static void parse_primary(parser *p)
{
    skip_space(p);
    const size_t length = name_length(p->at);
    if (p->failed)
        return;
    if (length) {
        parse_name(p, length);
    } else if (isdigit((unsigned char)*p->at) || (*p->at == '.' && isdigit((unsigned char)p->at[1]))) {
        char *end;
        const double number = strtod(p->at, &end);
        p->at = end;
        emit(p, OP_NUMBER, 0, number, 0);
    } else if (accept(p, "(")) {
        parse_or(p);
        if (!accept(p, ")"))
            fail(p, "a ) is missing");
    } else {
        fail(p, *p->at ? "a number, a name or a ( is expected" : "the formula ends too early");
    }
}

static void parse_sign(parser *p);

static void parse_power(parser *p)
{
    parse_primary(p);
    if (accept(p, "^")) {
        parse_sign(p);
        emit(p, OP_POWER, 0, 0.0, 2);
    }
}

static void parse_sign(parser *p)
{
    if (++p->nesting > 200) /* of the stack of calls */
        fail(p, "the formula is nested too deeply");
    skip_space(p);
    if (p->failed) {
        p->nesting--;
        return;
    }
    if (accept(p, "-")) {
        parse_sign(p);
        emit(p, OP_NEGATE, 0, 0.0, 1);
    } else if (accept(p, "+")) {
        parse_sign(p);
    } else if (p->at[0] == '!' && p->at[1] != '=') {
        p->at++;
        parse_sign(p);
        emit(p, OP_NOT, 0, 0.0, 1);
    } else {
        parse_power(p);
    }
    p->nesting--;
}

typedef struct binary_row {
    const char *token;
    expression_op op;
} binary_row;

/* One level of operators that group from the left; rows end with NULL, longer tokens first. */
static void parse_level(parser *p, void (*operand)(parser *), const binary_row *rows)
{
    operand(p);
    while (!p->failed) {
        const binary_row *row = rows;
        while (row->token && !accept(p, row->token))
            row++;
        if (!row->token)
            return;
        operand(p);
        emit(p, row->op, 0, 0.0, 2);
    }
}

static void parse_product(parser *p)
{
    static const binary_row rows[] = {{"*", OP_MULTIPLY}, {"/", OP_DIVIDE}, {NULL, OP_NUMBER}};
    parse_level(p, parse_sign, rows);
}

static void parse_sum(parser *p)
{
    static const binary_row rows[] = {{"+", OP_ADD}, {"-", OP_SUBTRACT}, {NULL, OP_NUMBER}};
    parse_level(p, parse_product, rows);
}

static void parse_comparison(parser *p)
{
    static const binary_row rows[] = {{"<=", OP_AT_MOST}, {">=", OP_AT_LEAST}, {"==", OP_EQUAL}, {"!=", OP_UNEQUAL},
                                      {"<", OP_LESS},     {">", OP_GREATER},   {NULL, OP_NUMBER}};
    parse_level(p, parse_sum, rows);
}

static void parse_and(parser *p)
{
    static const binary_row rows[] = {{"&&", OP_AND}, {NULL, OP_NUMBER}};
    parse_level(p, parse_comparison, rows);
}

static void parse_or(parser *p)
{
    static const binary_row rows[] = {{"||", OP_OR}, {NULL, OP_NUMBER}};
    parse_level(p, parse_and, rows);
}

expression *expression_parse(const char *text, char *error, size_t error_size)
{
    expression *e = calloc(1, sizeof *e);
    if (!e) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    parser p = {.e = e, .text = text, .at = text, .error = error, .error_size = error_size};
    parse_or(&p);
    skip_space(&p);
    if (*p.at)
        fail(&p, "the formula should end here");
    if (!p.failed)
        return e;
    free(e);
    return NULL;
}

void expression_free(expression *e) { free(e); }

const char *const *expression_names(const expression *e, size_t *count)
{
    *count = e->name_count;
    return e->names;
}

int expression_uses(const expression *e, const char *name)
{
    for (uint32_t i = 0; i < e->name_count; i++)
        if (strcmp(e->names[i], name) == 0)
            return 1;
    return 0;
}
