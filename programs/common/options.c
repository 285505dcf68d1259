/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Command lines by a table; see options.h. argp, which is part of glibc, reads them. */
#define _GNU_SOURCE
#include "common/options.h"

#include <argp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program.h"

enum { KEY_ROWS = 256, KEY_WORDS = KEY_ROWS + OPTIONS_MOST }; /* of row i without a letter: KEY_ROWS + i */

typedef struct options_state {
    const option_table *table;
    void *options;
    const char **operands;
    size_t operand_count;
    options_given *given;
    FILE *settings; /* NULL: no memory, or not wanted */
} options_state;

/* ---- Words -------------------------------------------------------------------------------------------------- */

static const char separators[] = ", ";

/* The number of a word in a list; -1: it is not there. */
static int find_word(const char *list, const char *word)
{
    const size_t length = strlen(word);
    for (int i = 0; *list; i++) {
        const size_t size = strcspn(list, separators);
        if (size == length && memcmp(list, word, size) == 0)
            return i;
        list += size + strspn(list + size, separators);
    }
    return -1;
}

/* "is not A, B or C". */
static void refuse_word(const char *text, const char *list, char *error, size_t size)
{
    size_t used = (size_t)snprintf(error, size, "\"%.80s\" is not ", text);
    for (const char *between = ""; *list && used < size;) {
        const size_t length = strcspn(list, separators);
        used += (size_t)snprintf(error + used, size - used, "%s%.*s", between, (int)length, list);
        list += length + strspn(list + length, separators);
        between = list[strcspn(list, separators)] ? ", " : " or ";
    }
}

/* For the completion of a shell: the words of an option, by its name or letter, in one line. */
static void print_words(const option_table *table, const char *name)
{
    for (size_t i = 0; i < table->count; i++) {
        const option_row *row = &table->rows[i];
        if (!row->name || !row->words || (strcmp(name, row->name) != 0 && (name[0] != row->letter || name[1])))
            continue;
        for (const char *c = row->words; *c; c++)
            if (*c != ',')
                putchar(*c);
        putchar('\n');
    }
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

static int set_word(const option_row *row, const char *text, void *to, char *error, size_t size)
{
    const int word = find_word(row->words, text);
    if (word < 0) {
        refuse_word(text, row->words, error, size);
        return -1;
    }
    if (row->type == OPTION_NAME)
        *(const char **)to = text;
    else
        *(int *)to = (int)row->first + word;
    return 0;
}

static int set_double(const option_row *row, const char *text, double *to, char *error, size_t size)
{
    float value;
    if (program_parse_float(text, (float)row->low, (float)row->high, &value, error, size))
        return -1;
    *to = (double)value;
    return 0;
}

static int set_value(const option_row *row, const char *text, void *options, char *error, size_t size)
{
    void *const to = (char *)options + row->at;
    if (row->given)
        *(int *)(void *)((char *)options + row->given - 1) = 1;
    if (row->value && !text && !(text = row->otherwise))
        return 0;
    switch (row->type) {
    case OPTION_FLAG: *(int *)to = (int)row->first; return 0;
    case OPTION_TEXT: *(const char **)to = text; return 0;
    case OPTION_WORD:
    case OPTION_NAME: return set_word(row, text, to, error, size);
    case OPTION_FLOAT: return program_parse_float(text, (float)row->low, (float)row->high, to, error, size);
    case OPTION_DOUBLE: return set_double(row, text, to, error, size);
    case OPTION_U32: return program_parse_u32(text, (uint32_t)row->first, (uint32_t)row->last, to, error, size);
    case OPTION_U64: return program_parse_u64(text, row->first, row->last, to, error, size);
    case OPTION_PARSED: return row->parse(text, to, error, size);
    }
    return 0;
}

/* ---- By argp ------------------------------------------------------------------------------------------------ */

static int key_of(const option_table *table, size_t i)
{
    return table->rows[i].letter ? table->rows[i].letter : KEY_ROWS + (int)i;
}

static void take_option(options_state *s, size_t i, const char *arg, struct argp_state *state)
{
    const option_row *row = &s->table->rows[i];
    char error[PROGRAM_ERROR_SIZE] = "";
    if (set_value(row, arg, s->options, error, sizeof error)) {
        if (s->table->names_letters && row->letter)
            argp_error(state, "-%c: %s", row->letter, error);
        argp_error(state, "--%s: %s", row->name, error);
    }
    if (row->is_running || !s->given)
        return;
    s->given->is_given[i] = 1;
    if (s->settings)
        fprintf(s->settings, arg ? "%s = %s\n" : "%s\n", row->name, arg);
}

static error_t parse_key(int key, char *arg, struct argp_state *state)
{
    options_state *s = state->input;
    char error[PROGRAM_ERROR_SIZE] = "";
    switch (key) {
    case KEY_WORDS: print_words(s->table, arg); exit(program_exit(PROGRAM_OK));
    case ARGP_KEY_ARGS:
        s->operands = (const char **)(void *)(state->argv + state->next);
        s->operand_count = (size_t)(state->argc - state->next);
        return 0;
    case ARGP_KEY_END:
        if (s->table->finish(s->options, s->operands, s->operand_count, error, sizeof error))
            argp_error(state, "%s", error);
        return 0;
    default: break;
    }
    for (size_t i = 0; i < s->table->count; i++)
        if (s->table->rows[i].name && key_of(s->table, i) == key) {
            take_option(s, i, arg, state);
            return 0;
        }
    return ARGP_ERR_UNKNOWN;
}

void options_parse(const option_table *table, void *options, int argc, char **argv, options_given *given)
{
    static struct argp_option rows[OPTIONS_MOST + 2]; /* the last of zeros ends them */
    const struct argp parser = {rows, parse_key, table->arguments, table->text, NULL, NULL, NULL};
    options_state state = {.table = table, .options = options, .given = given};
    size_t size = 0;
    for (size_t i = 0; i < table->count; i++) {
        const option_row *row = &table->rows[i];
        rows[i] = (struct argp_option){row->name,  row->name ? key_of(table, i) : 0,
                                       row->value, row->is_optional ? OPTION_ARG_OPTIONAL : 0,
                                       row->help,  row->group};
    }
    rows[table->count] = (struct argp_option){"__words", KEY_WORDS, "OPTION", OPTION_HIDDEN, NULL, 0};
    if (given) {
        memset(given, 0, sizeof *given);
        state.settings = open_memstream(&given->settings, &size);
    }
    argp_parse(&parser, argc, argv, 0, NULL, &state);
    if (given && state.settings && fclose(state.settings) != 0) {
        free(given->settings);
        given->settings = NULL;
    }
}

void options_print_others(const option_table *table, const options_given *given)
{
    for (size_t i = 0; i < table->count; i++) {
        const option_row *row = &table->rows[i];
        if (row->name && !given->is_given[i] && !row->is_running)
            printf(row->value ? "# %s = %s\n" : "# %s\n", row->name, row->value);
    }
}

int option_parse_origin(const char *text, void *to, char *error, size_t error_size)
{
    return program_parse_doubles(text, 3, to, error, error_size);
}
