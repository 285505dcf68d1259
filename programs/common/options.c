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

static const char separators[] = ", ";

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

int option_find(const char *const *names, const char *name, char *error, size_t error_size)
{
    int which = 0;
    while (names[which] && strcmp(name, names[which]) != 0)
        which++;
    if (names[which])
        return which;
    size_t used = (size_t)snprintf(error, error_size, "\"%.80s\" is not ", name);
    for (which = 0; names[which] && used < error_size; which++)
        used += (size_t)snprintf(error + used, error_size - used, "%s%s",
                                 !which             ? ""
                                 : names[which + 1] ? ", "
                                                    : " or ",
                                 names[which]);
    return -1;
}

int option_next(const char **list, char item[OPTION_ITEM_SIZE])
{
    if (!*list)
        return 0;
    const size_t length = strcspn(*list, ",");
    snprintf(item, OPTION_ITEM_SIZE, "%.*s", length < OPTION_ITEM_SIZE ? (int)length : OPTION_ITEM_SIZE, *list);
    *list = (*list)[length] ? *list + length + 1 : NULL;
    return 1;
}

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

/* ---- Values ------------------------------------------------------------------------------------------------- */

static int set_word(const option_row *row, const char *text, void *to, char *error, size_t size)
{
    const int word = row->names ? option_find(row->names, text, error, size) : cgt_find_word(row->words, text);
    if (word < 0) {
        if (!row->names)
            refuse_word(text, row->words, error, size);
        return -1;
    }
    if (row->type == OPTION_NAME)
        *(const char **)to = text;
    else
        *(int *)to = (int)row->first + word;
    return 0;
}

static int set_list(const option_row *row, const char *list, int *chosen, char *error, size_t size)
{
    char item[OPTION_ITEM_SIZE];
    while (option_next(&list, item)) {
        const int which = option_find(row->names, item, error, size);
        if (which < 0)
            return -1;
        chosen[which] = 1;
    }
    return 0;
}

static int set_double(const option_row *row, const char *text, double *to, char *error, size_t size)
{
    float value;
    if (cgt_read_float(text, (float)row->low, (float)row->high, &value, error, size))
        return -1;
    *to = (double)value;
    return 0;
}

static int set_value(const option_row *row, const char *text, void *options, char *error, size_t size)
{
    void *const to = (char *)options + row->at;
    if (row->given)
        *(int *)(void *)((char *)options + row->given - 1) = 1;
    if (row->given_bool)
        *(bool *)(void *)((char *)options + row->given_bool - 1) = true;
    if (row->value && !text && !(text = row->otherwise))
        return 0;
    switch (row->type) {
    case OPTION_FLAG: *(int *)to = (int)row->first; return 0;
    case OPTION_BOOL: *(bool *)to = true; return 0;
    case OPTION_TEXT: *(const char **)to = text; return 0;
    case OPTION_WORD:
    case OPTION_NAME: return set_word(row, text, to, error, size);
    case OPTION_LIST: return set_list(row, text, to, error, size);
    case OPTION_FLOAT: return cgt_read_float(text, (float)row->low, (float)row->high, to, error, size);
    case OPTION_DOUBLE: return set_double(row, text, to, error, size);
    case OPTION_U32: return cgt_read_u32(text, (uint32_t)row->first, (uint32_t)row->last, to, error, size);
    case OPTION_U64: return cgt_read_u64(text, row->first, row->last, to, error, size);
    case OPTION_PARSED: return row->parse(text, to, error, size);
    case OPTION_REFUSED: snprintf(error, size, "%s", row->help); return -1;
    }
    return 0;
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
    snprintf(text + s->settings_size, more + 1, value ? "%s = %s\n" : "%s\n", name, value);
    s->settings_size += more;
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
    if (set_value(row, value, s->options, error, sizeof error)) {
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
