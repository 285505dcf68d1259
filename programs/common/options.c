/* SPDX-FileCopyrightText: 2026 The libcgt authors
 * SPDX-License-Identifier: MIT
 *
 * Command lines by a table; see options.h. */
#include "common/options.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/option_help.h"
#include "common/program.h"
#include "options/numbers.h"

typedef struct options_state {
    const option_table *table;
    const char *program;
    void *options;
    options_given *given; /* NULL: not wanted */
    size_t settings_size; /* of given->settings, without its end */
    int has_no_memory;    /* for them */
} options_state;

/* ---- Words -------------------------------------------------------------------------------------------------- */

/* For the completion of a shell: the words of an option, by its name or letter, in one line. */
static void print_words(const option_table *table, const char *name)
{
    for (size_t i = 0; i < table->count; i++) {
        const option_row *row = &table->rows[i];
        if (!row->name || (strcmp(name, row->name) != 0 && (name[0] != row->letter || name[1])))
            continue;
        for (const char *c = row->words; c && *c; c++)
            if (*c != ',')
                putchar(*c);
        for (size_t k = 0; row->names && row->names[k]; k++)
            printf(k ? " %s" : "%s", row->names[k]);
        if (row->words || row->names)
            putchar('\n');
    }
}

/* ---- The command line --------------------------------------------------------------------------------------- */

static void refuse(const options_state *s, const char *format, ...) __attribute__((format(printf, 2, 3), noreturn));

/* Ends the program with a sentence. */
static void refuse(const options_state *s, const char *format, ...)
{
    va_list arguments;
    fflush(stdout);
    fprintf(stderr, "%s: ", s->program);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    option_print_hint(s->program, stderr);
    exit(program_exit(PROGRAM_USAGE));
}

/* Writes down an option that was given: "name = value" or "name". */
static void note_setting(options_state *s, const char *name, const char *value)
{
    const size_t more = strlen(name) + (value ? strlen(value) + 3 : 0) + 1;
    char *const text = s->has_no_memory ? NULL : realloc(s->given->settings, s->settings_size + more + 1);
    s->has_no_memory = !text;
    if (!text)
        return;
    s->given->settings = text;
    snprintf(text + s->settings_size, more, value ? "%s = %s" : "%s", name, value);
    cgt_join_lines(text + s->settings_size);
    s->settings_size += more;
    memcpy(text + s->settings_size - 1, "\n", 2);
}

/* Rows of the table, then those of every program, then __words. */
static const option_row *row_at(const option_table *table, size_t i)
{
    static const option_row words = {.name = "__words", .value = "OPTION"};
    return i < table->count                          ? &table->rows[i]
           : i - table->count < OPTION_STANDARD_ROWS ? &option_standard_rows[i - table->count]
                                                     : &words;
}

static size_t count_rows(const option_table *table) { return table->count + OPTION_STANDARD_ROWS + 1; }

/* The options of every program. All of them end it. */
static void do_standard(const options_state *s, size_t which, const char *value)
{
    switch (which) {
    case OPTION_HELP: option_print_help(s->table, s->program, stdout); break;
    case OPTION_USAGE: option_print_usage(s->table, s->program, stdout); break;
    case OPTION_VERSION: printf("%s (libcgt %s)\n", program_name(), CGT_VERSION_STRING); break;
    default: print_words(s->table, value); break;
    }
    exit(program_exit(PROGRAM_OK));
}

static void take_option(options_state *s, size_t i, const char *value)
{
    const option_row *const row = row_at(s->table, i);
    char error[PROGRAM_ERROR_SIZE] = "";
    if (i >= s->table->count)
        do_standard(s, i - s->table->count, value);
    if (cgt_option_set(row, value, s->options, error, sizeof error)) {
        if (s->table->names_letters && row->letter)
            refuse(s, "-%c: %s", row->letter, error);
        refuse(s, "--%s: %s", row->name, error);
    }
    if (row->is_running || !s->given)
        return;
    s->given->is_given[i] = 1;
    note_setting(s, row->name, value);
}

/* Names may be shortened as long as one option alone begins so. */
static size_t find_name(const options_state *s, const char *name, size_t length)
{
    const size_t count = count_rows(s->table);
    size_t found = count, matches = 0;
    for (size_t i = 0; i < count; i++) {
        const char *const known = row_at(s->table, i)->name;
        if (!known || strncmp(known, name, length) != 0)
            continue;
        if (!known[length])
            return i;
        found = i;
        matches++;
    }
    if (matches == 0)
        refuse(s, "unrecognized option '--%.*s'", (int)length, name);
    if (matches == 1)
        return found;
    char list[PROGRAM_ERROR_SIZE];
    size_t used = 0;
    for (size_t i = 0; i < s->table->count + OPTION_STANDARD_ROWS && used < sizeof list; i++) {
        const char *const known = row_at(s->table, i)->name;
        if (known && strncmp(known, name, length) == 0)
            used += (size_t)snprintf(list + used, sizeof list - used, " '--%s'", known);
    }
    refuse(s, "option '--%.*s' is ambiguous; possibilities:%s", (int)length, name, list);
}

/* --name, --name=value, --name value. Returns how many of the arguments it took. */
static int take_long(options_state *s, char **arguments, int count)
{
    const char *const name = arguments[0] + 2, *value = strchr(name, '=');
    const size_t i = find_name(s, name, value ? (size_t)(value - name) : strlen(name));
    const option_row *const row = row_at(s->table, i);
    const int is_apart = row->value && !row->is_optional && !value;
    if (value && !row->value)
        refuse(s, "option '--%s' doesn't allow an argument", row->name);
    if (is_apart && count < 2)
        refuse(s, "option '--%s' requires an argument", row->name);
    take_option(s, i, value ? value + 1 : is_apart ? arguments[1] : NULL);
    return 1 + is_apart;
}

/* -a, -ab, -avalue, -a value. Returns how many of the arguments it took. */
static int take_letters(options_state *s, char **arguments, int count)
{
    for (const char *letter = arguments[0] + 1; *letter; letter++) {
        size_t i = 0;
        while (i < count_rows(s->table) && row_at(s->table, i)->letter != *letter)
            i++;
        if (i == count_rows(s->table))
            refuse(s, "invalid option -- '%c'", *letter);
        const option_row *const row = row_at(s->table, i);
        if (!row->value) {
            take_option(s, i, NULL);
            continue;
        }
        const int is_apart = !letter[1] && !row->is_optional;
        if (is_apart && count < 2)
            refuse(s, "option requires an argument -- '%c'", *letter);
        take_option(s, i, letter[1] ? letter + 1 : is_apart ? arguments[1] : NULL);
        return 1 + is_apart;
    }
    return 1;
}

void options_parse(const option_table *table, void *options, int argc, char **argv, options_given *given)
{
    options_state s = {.table = table, .options = options, .given = given};
    char error[PROGRAM_ERROR_SIZE] = "";
    int operands = 1; /* in argv, from 1 on: there is room before the argument that is read */
    s.program = table->program ? table->program : program_name();
    if (given) {
        memset(given, 0, sizeof *given);
        given->settings = calloc(1, 1);
        s.has_no_memory = !given->settings;
    }
    for (int i = 1, all = 0; i < argc;) {
        if (!all && strcmp(argv[i], "--") == 0) {
            all = 1;
            i++;
        } else if (all || argv[i][0] != '-' || argv[i][1] == '\0') {
            all |= table->is_command;
            char *const operand = argv[i]; /* exchanged: a caller may have to free them all */
            argv[i++] = argv[operands];
            argv[operands++] = operand;
        } else {
            i += (argv[i][1] == '-' ? take_long : take_letters)(&s, argv + i, argc - i);
        }
    }
    if (given && s.has_no_memory) {
        free(given->settings);
        given->settings = NULL;
    }
    if (table->finish(options, (const char **)(void *)(argv + 1), (size_t)(operands - 1), error, sizeof error))
        refuse(&s, "%s", error);
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
    return cgt_read_doubles(text, 3, to, error, error_size);
}
