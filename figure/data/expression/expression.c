/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Formulas over columns; see expression.h. The parser, by recursive descent, writes steps for a stack machine, each of
 * which works on a block of elements at a time (expression_run.c). */
#include "data/expression/expression.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "data/expression/expression_steps.h"
#include "options/numbers.h"

enum { MOST_NESTING = 200 }; /* of the stack of calls */

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

/* Of ASCII alone, whatever the locale is. */
static int is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
static int is_digit(char c) { return c >= '0' && c <= '9'; }
static int is_alpha(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
static int is_alnum(char c) { return is_alpha(c) || is_digit(c); }

static void skip_space(parser *p)
{
    while (is_space(*p->at))
        p->at++;
}

static size_t name_length(const char *at)
{
    size_t length = 0;
    if (!is_alpha(*at) && *at != '_')
        return 0;
    while (is_alnum(at[length]) || (at[length] && strchr("_.:[]", at[length])))
        length++;
    return length;
}

static int accept(parser *p, const char *token)
{
    skip_space(p);
    const size_t length = strlen(token);
    if (strncmp(p->at, token, length) != 0 || (is_alpha(*token) && name_length(p->at) != length))
        return 0;
    p->at += length;
    return 1;
}

static void parse_or(parser *p);

/* ---- Names -------------------------------------------------------------------------------------------------- */

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

/* A word more. Returns its source, or 0 with an error. */
static uint32_t add_word(parser *p, const expression_word *word, const char *text, size_t length)
{
    expression *e = p->e;
    if (e->word_count == EXPRESSION_WORDS || length >= EXPRESSION_NAME_SIZE) {
        fail(p, "there are too many words, or one is too long");
        return 0;
    }
    e->words[e->word_count] = *word;
    memcpy(e->words[e->word_count].text, text, length);
    return EXPRESSION_NAMES + e->word_count++;
}

static const struct {
    const char *name, *column;
    expression_list list;
} lists[] = {
    {"protein", "resname", LIST_PROTEIN}, {"water", "resname", LIST_WATER}, {"backbone", "name", LIST_BACKBONE}};

/* A name that stands for a list of words; the backbone is that of proteins. Returns whether it is one. */
static int parse_list(parser *p, const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        if (strlen(lists[i].name) != length || strncmp(lists[i].name, name, length) != 0)
            continue;
        const uint32_t column = add_name(p, lists[i].column, strlen(lists[i].column));
        const expression_word word = {.column = column, .list = lists[i].list};
        p->e->is_needed[column] = 1;
        emit(p, OP_NAME, add_word(p, &word, name, length), 0.0, 0);
        if (lists[i].list == LIST_BACKBONE) {
            parse_list(p, "protein", strlen("protein"));
            emit(p, OP_AND, 0, 0.0, 2);
        }
        return 1;
    }
    return 0;
}

/* A word in quotes or a bare name, on the right of == and != after the name of a column. Returns 0 where there is
 * neither, but a formula. */
static int parse_word(parser *p, uint32_t column)
{
    skip_space(p);
    const char quote = *p->at;
    expression_word word = {.column = column, .list = EXPRESSION_LISTS};
    if (quote == '"' || quote == '\'') {
        const char *const text = p->at + 1, *const end = strchr(text, quote);
        if (!end) {
            fail(p, "the quote at the end of the word is missing");
            return 1;
        }
        word.is_quoted = 1;
        emit(p, OP_NAME, add_word(p, &word, text, (size_t)(end - text)), 0.0, 0);
        p->at = end + 1;
        return 1;
    }
    const char *const text = p->at;
    const size_t length = name_length(text);
    p->at += length;
    skip_space(p);
    if (!length || (*p->at && strchr("(+-*/^", *p->at)) || (length == 2 && strncmp(text, "pi", 2) == 0)) {
        p->at = text;
        return 0;
    }
    word.bare = add_name(p, text, length);
    emit(p, OP_NAME, add_word(p, &word, text, length), 0.0, 0);
    return 1;
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
    else if (!parse_list(p, name, length)) {
        const uint32_t column = add_name(p, name, length);
        p->e->is_needed[column] = 1;
        emit(p, OP_NAME, column, 0.0, 0);
    }
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
    } else if (is_digit(*p->at) || (*p->at == '.' && is_digit(p->at[1]))) {
        char *end;
        const double number = cgt_scan_double(p->at, &end);
        p->at = end;
        emit(p, OP_NUMBER, 0, number, 0);
    } else if (accept(p, "(")) {
        parse_or(p);
        if (!accept(p, ")"))
            fail(p, "a ) is missing");
    } else if (*p->at == '"' || *p->at == '\'') {
        fail(p, "a word stands on the right of == or !=, after the name of a column");
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
    if (++p->nesting > MOST_NESTING)
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

/* The operator that comes next, of rows that end with NULL, longer tokens first. */
static const binary_row *accept_row(parser *p, const binary_row *rows)
{
    while (rows->token && !accept(p, rows->token))
        rows++;
    return rows;
}

/* One level of operators that group from the left. */
static void parse_level(parser *p, void (*operand)(parser *), const binary_row *rows)
{
    operand(p);
    while (!p->failed) {
        const binary_row *row = accept_row(p, rows);
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
    const expression *const e = p->e;
    const uint32_t first = e->step_count;
    parse_sum(p);
    while (!p->failed) {
        const binary_row *row = accept_row(p, rows);
        const int is_equality = row->op == OP_EQUAL || row->op == OP_UNEQUAL;
        const int is_name = e->step_count == first + 1 && e->steps[first].op == OP_NAME;
        if (!row->token)
            return;
        if (!is_equality || !is_name || e->steps[first].name >= EXPRESSION_NAMES ||
            !parse_word(p, e->steps[first].name))
            parse_sum(p);
        emit(p, row->op, 0, 0.0, 2);
    }
}

static void parse_not(parser *p)
{
    if (!accept(p, "not")) {
        parse_comparison(p);
        return;
    }
    if (++p->nesting > MOST_NESTING)
        fail(p, "the formula is nested too deeply");
    else
        parse_not(p);
    p->nesting--;
    emit(p, OP_NOT, 0, 0.0, 1);
}

static void parse_and(parser *p)
{
    static const binary_row rows[] = {{"&&", OP_AND}, {"and", OP_AND}, {NULL, OP_NUMBER}};
    parse_level(p, parse_not, rows);
}

static void parse_or(parser *p)
{
    static const binary_row rows[] = {{"||", OP_OR}, {"or", OP_OR}, {NULL, OP_NUMBER}};
    parse_level(p, parse_and, rows);
}

expression *cgt_expression_parse(const char *text, char *error, size_t error_size)
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

void cgt_expression_free(expression *e) { free(e); }

const char *const *cgt_expression_names(const expression *e, size_t *count)
{
    *count = e->name_count;
    return e->names;
}

int cgt_expression_is_name(const expression *e) { return e->step_count == 1 && e->steps[0].op == OP_NAME; }

int cgt_expression_uses(const expression *e, const char *name)
{
    for (uint32_t i = 0; i < e->name_count; i++)
        if (strcmp(e->names[i], name) == 0)
            return 1;
    return 0;
}
